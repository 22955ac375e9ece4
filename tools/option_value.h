/* option_value.h: the values of command lines' options. Each returns 1, or 0 where the text is none. */
#ifndef OPTION_VALUE_H
#define OPTION_VALUE_H

#include <stdint.h>

#include <lambent/types.h>

/* A number under 1e30; *p stops behind it. */
int option_float(const char **p, float *out);

/* `count` numbers with commas between; *p stops behind them. */
int option_floats(const char **p, float *out, int count);

/* The whole text. */
int option_vec3(const char *text, lmb_vec3 *out);
int option_int(const char *text, int32_t low, int32_t high, int32_t *out);

#endif
