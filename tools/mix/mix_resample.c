/* mix_resample.c: resamples registered depth to the photo's size, with edges aligned to the photo's. */
#include "mix_frame.h"

#include <math.h>
#include <stdlib.h>

#define EDGE  0.05f /* relative: samples that differ by more lie on two surfaces */
#define ALIKE 0.08f /* scale of a colour difference that separates two surfaces */

enum { COARSEST = 16 /* photo pixels per sample, each way */ };

/* One of the four samples around a pixel. */
typedef struct sample {
    float inverse, weight, alike; /* 1/m, 0: not measured; bilinear weight; weight by colour */
} sample;

static int32_t inside(int32_t v, int32_t count) { return v < 0 ? 0 : v >= count ? count - 1 : v; }

static float difference(const float *a, const float *b)
{
    float sum = 0.0f;
    for (int c = 0; c < 3; ++c) {
        const float d = sqrtf(fmaxf(a[c], 0.0f)) - sqrtf(fmaxf(b[c], 0.0f)); /* about display values */
        sum += d * d;
    }
    return sum;
}

/* If the samples lie on one surface, their weighted mean; else only those on the surface of the sample with the most
 * similar colour. */
static float depth_of(const sample s[4])
{
    int best = -1;
    float sum = 0.0f, weight = 0.0f;
    for (int i = 0; i < 4; ++i) {
        best = s[i].inverse > 0.0f && (best < 0 || s[i].alike > s[best].alike) ? i : best;
    }
    for (int i = 0; i < 4 && best >= 0; ++i) {
        if (s[i].inverse > 0.0f && fabsf(s[i].inverse - s[best].inverse) <= EDGE * s[best].inverse) {
            sum += s[i].weight * s[i].inverse;
            weight += s[i].weight;
        }
    }
    return weight > 0.0f ? weight / sum : best >= 0 ? 1.0f / s[best].inverse : 0.0f;
}

static float pixel_of(const mix_frame *f, const image *in, int32_t x, int32_t y, float scale)
{
    const float px = (float)in->width / (float)f->light.width, py = (float)in->height / (float)f->light.height,
                at[2] = {((float)x + 0.5f) * px - 0.5f, ((float)y + 0.5f) * py - 0.5f};
    const int32_t x0 = (int32_t)floorf(at[0]), y0 = (int32_t)floorf(at[1]);
    const float *own = f->light.pixels + 3 * ((size_t)y * (size_t)f->light.width + (size_t)x);
    float nearest = 0.0f, max = 0.0f;
    sample s[4];
    for (int i = 0; i < 4; ++i) {
        const int32_t ix = x0 + i % 2, iy = y0 + i / 2, sx = inside(ix, in->width), sy = inside(iy, in->height),
                      lx = inside((int32_t)(((float)sx + 0.5f) / px), f->light.width),
                      ly = inside((int32_t)(((float)sy + 0.5f) / py), f->light.height);
        const float d = scale * in->pixels[(size_t)in->channels * ((size_t)sy * (size_t)in->width + (size_t)sx)];
        const float *colour = f->light.pixels + 3 * ((size_t)ly * (size_t)f->light.width + (size_t)lx);
        s[i].inverse = d > 0.0f && d < INFINITY ? 1.0f / d : 0.0f;
        s[i].weight = fmaxf(1.0f - fabsf(at[0] - (float)ix), 0.0f) * fmaxf(1.0f - fabsf(at[1] - (float)iy), 0.0f);
        s[i].alike = (s[i].weight + 0.05f) * expf(-difference(own, colour) / (ALIKE * ALIKE));
        nearest = s[i].weight > max ? s[i].inverse : nearest;
        max = fmaxf(max, s[i].weight);
    }
    return nearest > 0.0f ? depth_of(s) : 0.0f; /* a hole stays one */
}

int mix_resample(mix_frame *f, const image *in, float scale)
{
    const int32_t w = f->light.width, h = f->light.height;
    f->depth = malloc((size_t)w * (size_t)h * sizeof *f->depth);
    for (int32_t i = 0; f->depth != NULL && i < w * h; ++i) {
        f->depth[i] = pixel_of(f, in, i % w, i / w, scale);
    }
    return f->depth != NULL;
}

int mix_has_shape(const mix_frame *f, const image *in)
{
    const double wide = (double)in->width * (double)f->light.height, high = (double)in->height * (double)f->light.width,
                 max = (double)(f->light.height > f->light.width ? f->light.height : f->light.width);
    return fabs(wide - high) <= 0.5 * max && /* half a sample, because sizes are rounded */
           COARSEST * in->width >= f->light.width && COARSEST * in->height >= f->light.height;
}
