/* option_value.h: parses option values. Each call returns 1, or 0 if the text is invalid. */
#ifndef OPTION_VALUE_H
#define OPTION_VALUE_H

#include <stdint.h>

#include <lambent/scene.h>

/* A number under 1e30; sets *p behind it. */
int option_float(const char **p, float *out);

/* `count` numbers with commas between; sets *p behind them. */
int option_floats(const char **p, float *out, int count);

/* These parse the whole text. */
int option_vec3(const char *text, lmb_vec3 *out);
int option_int(const char *text, int32_t low, int32_t high, int32_t *out);

int option_number(const char *text, float low, float high, float *out);
int option_size(const char *text, int32_t *width, int32_t *height); /* WxH, 1 .. LMB_MAX_SIDE */

/* One of `words`, which end with NULL; returns the entry of `values`, or the index if `values` is NULL. */
int option_word(const char *text, const char *const *words, const int32_t *values, int32_t *out);

/* spot|point|sun:PX,PY,PZ:DX,DY,DZ:R,G,B[:INNER,OUTER][:SIZE]. SIZE: m, for a sun degrees; *size is 0 if absent;
 * `size` NULL: not allowed. Returns NULL, or the name of the first wrong part in that line (KIND: the word). */
const char *option_light(const char *text, lmb_light *out, float *size);

/* Samples per pixel: words and their int32_t values. */
extern const char *const option_samples[];
extern const char *const option_vertex_colours[]; /* indexed by MODEL_COLOURS_ */
extern const char *const option_tones[]; /* their indices are PICTURE_CURVED and PICTURE_CLIPPED */
extern const int32_t option_sample_values[];

/* Parses exposure in stops as float, -60 .. 60, or NaN for `auto`. */
#define OPTION_STOPS_WANTS "stops, -60 .. 60, or auto"
int option_stops(const char *text, void *at);

#endif
