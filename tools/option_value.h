/* option_value.h: command lines' options and their values. Each returns 1, or 0 where the text is none. */
#ifndef OPTION_VALUE_H
#define OPTION_VALUE_H

#include <stdint.h>

#include <lambent/scene.h>

#include "report.h"

/* A number under 1e30; *p stops behind it. */
int option_float(const char **p, float *out);

/* `count` numbers with commas between; *p stops behind them. */
int option_floats(const char **p, float *out, int count);

/* The whole text. */
int option_vec3(const char *text, lmb_vec3 *out);
int option_int(const char *text, int32_t low, int32_t high, int32_t *out);

int option_number(const char *text, float low, float high, float *out);
int option_size(const char *text, int32_t *width, int32_t *height); /* WxH, 1 .. LMB_MAX_SIDE */

/* One of `words`, which end with NULL: its value, or its place among them where `values` is NULL. */
int option_word(const char *text, const char *const *words, const int32_t *values, int32_t *out);

/* spot|point|sun:PX,PY,PZ:DX,DY,DZ:R,G,B[:INNER,OUTER] */
int option_light(const char *text, lmb_light *out);

/* A verb's table of options has entries that begin with this. */
typedef struct option_name {
    const char *name, *wants;
} option_name;

/* option_find: which entry argv[at] names; argv[0] is the verb. -1 with `r` set where there is none, or no value behind
 * it. option_refuse: the value is none; 0 with `r` set. */
int option_find(const void *table, size_t entry_bytes, size_t count, char **argv, int at, report *r);
int option_refuse(const option_name *of, const char *value, report *r);

#endif
