/* accuracy.h: compares the library with the slow rasterizers on one scene, pixel by pixel: figures. */
#ifndef ACCURACY_H
#define ACCURACY_H

#include <lambent/lambent.h>

/* Depth errors in ulps of the reference's depth in binary32. */
typedef struct error_count {
    uint64_t pixels, only_one; /* covered by both; by only one */
    uint64_t none, one, two, four; /* of `pixels`: equal to the rounded reference; within 1, 2, 4 ulps */
    double worst;
} error_count;

typedef struct accuracy {
    error_count alone;   /* each triangle drawn separately: every pixel that it covers, hidden or not */
    error_count frame;   /* the picture of all triangles */
    uint64_t outside;    /* single triangles: depth outside the range of the triangle's corner depths */
    uint64_t past_bound; /* single triangles: depth error beyond the bound of binary32 rounding */
    uint64_t unlike;     /* pixels that differ from the first backend, or in the picture from the merged triangles */
    uint64_t fights;     /* of frame.pixels: another triangle in front */
    double fight_gap;    /* maximum distance, in ulps, by which it lies behind the reference's */
    /* The picture against the exact reference, which does not snap to 24.8. */
    uint64_t exact_only_one, exact_other, exact_same; /* covered by one; another triangle in front; the same triangle */
    double exact_mean, exact_max;                     /* relative difference of depth if the triangle is the same */
    int backends;
} accuracy;

/* Needs one mesh with float positions and 32-bit or no indices, and an identity transform. Returns 1, or
 * 0 if there is no memory. */
int accuracy_measure(accuracy *out, const lmb_view *view, const lmb_scene *scene, int cull);

#endif
