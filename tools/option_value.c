/* option_value.c: numbers and vectors of command lines. */
#include "option_value.h"

#include <math.h>
#include <stdlib.h>

int option_float(const char **p, float *out)
{
    char *end;
    double v = strtod(*p, &end);
    if (end == *p || !(fabs(v) < 1e30)) {
        return 0;
    }
    *out = (float)v;
    *p = end;
    return 1;
}

int option_floats(const char **p, float *out, int count)
{
    for (int i = 0; i < count; ++i) {
        if ((i > 0 && *(*p)++ != ',') || !option_float(p, &out[i])) {
            return 0;
        }
    }
    return 1;
}

int option_vec3(const char *text, lmb_vec3 *out)
{
    float v[3];
    if (!option_floats(&text, v, 3) || *text != '\0') {
        return 0;
    }
    out->x = v[0];
    out->y = v[1];
    out->z = v[2];
    return 1;
}

int option_int(const char *text, int32_t low, int32_t high, int32_t *out)
{
    char *end;
    long v = strtol(text, &end, 10);
    if (end == text || *end != '\0' || v < low || v > high) {
        return 0;
    }
    *out = (int32_t)v;
    return 1;
}
