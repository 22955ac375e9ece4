/* grey.c: shows numbers that are not light as greys in display formats. */
#include "grey.h"

#include <math.h>
#include <stdlib.h>

int image_widen(image *p, report *r)
{
    const size_t n = (size_t)p->width * (size_t)p->height;
    float *wide = malloc(3 * n * sizeof *wide);
    if (wide == NULL) {
        return report_fail(r, "not enough memory for the picture; try a smaller --size");
    }
    for (size_t i = 0; i < n; ++i) {
        wide[3 * i] = wide[3 * i + 1] = wide[3 * i + 2] = p->pixels[i];
    }
    free(p->pixels);
    p->pixels = wide;
    p->channels = 3;
    return 1;
}

void grey_depths(image *p)
{
    const size_t n = (size_t)p->width * (size_t)p->height;
    float far_m = 1e-30f;
    for (size_t i = 0; i < n; ++i) {
        far_m = fmaxf(far_m, p->pixels[i]);
    }
    for (size_t i = 0; i < n; ++i) {
        const float d = p->pixels[i];
        p->pixels[i] = d > 0.0f ? 1.0f - 0.9f * d / far_m : 0.0f;
    }
}

void grey_distances(image *p, float *nearest_m, float *farthest_m)
{
    const size_t n = (size_t)p->width * (size_t)p->height;
    float near_m = 1e30f, far_m = 0.0f;
    for (size_t i = 0; i < n; ++i) {
        const float d = p->pixels[i];
        near_m = d > 0.0f ? fminf(near_m, d) : near_m;
        far_m = fmaxf(far_m, d);
    }
    for (size_t i = 0; i < n; ++i) {
        const float d = p->pixels[i], part = far_m > near_m ? (d - near_m) / (far_m - near_m) : 0.0f;
        p->pixels[i] = d > 0.0f ? (float)srgb_decode((int)(255.0f - 200.0f * part)) : 0.0f;
    }
    *nearest_m = near_m;
    *farthest_m = far_m;
}

void grey_shares(image *p)
{
    for (size_t i = 0; i < (size_t)p->width * (size_t)p->height; ++i) {
        p->pixels[i] = (float)srgb_decode((int)(p->pixels[i] * 255.0f + 0.5f));
    }
}

void grey_normals(image *p)
{
    for (size_t i = 0; i < 3 * (size_t)p->width * (size_t)p->height; ++i) {
        p->pixels[i] = 0.5f + 0.5f * p->pixels[i];
    }
}
