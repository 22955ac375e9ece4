/* option_value.c: parses numbers, vectors and words of command lines. */
#include "option_value.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

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

int option_number(const char *text, float low, float high, float *out)
{
    return option_floats(&text, out, 1) && *text == '\0' && *out >= low && *out <= high;
}

int option_size(const char *text, int32_t *width, int32_t *height)
{
    char *end;
    const long w = strtol(text, &end, 10);
    if (end == text || (*end != 'x' && *end != 'X')) {
        return 0;
    }
    text = end + 1;
    const long h = strtol(text, &end, 10);
    if (end == text || *end != '\0' || w < 1 || h < 1 || w > LMB_MAX_SIDE || h > LMB_MAX_SIDE) {
        return 0;
    }
    *width = (int32_t)w;
    *height = (int32_t)h;
    return 1;
}

int option_word(const char *text, const char *const *words, const int32_t *values, int32_t *out)
{
    for (int i = 0; words[i] != NULL; ++i) {
        if (strcmp(text, words[i]) == 0) {
            *out = values != NULL ? values[i] : i;
            return 1;
        }
    }
    return 0;
}

const char *const option_vertex_colours[] = {"srgb", "linear", NULL};
const char *const option_tones[] = {"filmic", "linear", NULL};
const char *const option_samples[] = {"1", "4", "8", "16", NULL};
const int32_t option_sample_values[] = {1, 4, 8, 16};

int option_stops(const char *text, void *at)
{
    float *ev = at;
    *ev = NAN;
    return strcmp(text, "auto") == 0 || option_number(text, -60.0f, 60.0f, ev);
}

/* A colon and numbers, up to the next colon or the end. */
static int light_part(const char **p, float *out, int count)
{
    return *(*p)++ == ':' && option_floats(p, out, count) && (**p == ':' || **p == '\0');
}

static double length_of(const float d[3])
{
    return sqrt((double)d[0] * (double)d[0] + (double)d[1] * (double)d[1] + (double)d[2] * (double)d[2]);
}

/* KIND:P:D:RGB[:INNER,OUTER][:SIZE]; a single number at the end is the size. */
const char *option_light(const char *text, lmb_light *out, float *size)
{
    static const char *const kinds[] = {"spot:", "point:", "sun:"};
    static const int32_t values[] = {LMB_LIGHT_SPOT, LMB_LIGHT_POINT, LMB_LIGHT_DIRECTIONAL};
    float p[3], d[3], *c = out->intensity, cone[2] = {0.0f, 45.0f}, wide = 0.0f;
    memset(out, 0, sizeof *out);
    out->kind = -1;
    for (int i = 0; i < 3 && out->kind < 0; ++i) {
        const size_t n = strlen(kinds[i]);
        if (strncmp(text, kinds[i], n) == 0) {
            out->kind = values[i];
            text += n - 1;
        }
    }
    if (out->kind < 0) {
        return "KIND";
    }
    if (!light_part(&text, p, 3)) {
        return "PX,PY,PZ";
    }
    double length;
    if (!light_part(&text, d, 3) || ((length = length_of(d)) < 1e-20 && out->kind != LMB_LIGHT_POINT)) {
        return "DX,DY,DZ";
    }
    if (!light_part(&text, c, 3) || c[0] < 0.0f || c[1] < 0.0f || c[2] < 0.0f) {
        return "R,G,B";
    }
    if (strchr(text, ',') != NULL && (!light_part(&text, cone, 2) || cone[0] < 0.0f || cone[1] < cone[0] ||
                                      cone[1] <= 0.0f || cone[1] > 89.0f)) {
        return "INNER,OUTER";
    }
    if (*text != '\0' && (size == NULL || !light_part(&text, &wide, 1) || *text != '\0' || !(wide > 0.0f) ||
                          wide > (out->kind == LMB_LIGHT_DIRECTIONAL ? 90.0f : 1e6f))) {
        return size != NULL ? "SIZE" : "INNER,OUTER";
    }
    if (size != NULL) {
        *size = wide;
    }
    length = length < 1e-20 ? 1.0 : length;
    out->position = (lmb_vec3){p[0], p[1], p[2]};
    out->direction = (lmb_vec3){(float)((double)d[0] / length), (float)((double)d[1] / length),
                                (float)((double)d[2] / length)};
    out->cos_inner = (float)cos((double)cone[0] * 3.14159265358979 / 180.0);
    out->cos_outer = (float)cos((double)cone[1] * 3.14159265358979 / 180.0);
    return NULL;
}
