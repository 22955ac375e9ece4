/* accuracy.h: one scene by the library and by the slow rasterizers, pixel by pixel: figures. */
#ifndef ACCURACY_H
#define ACCURACY_H

#include <lambent/lambent.h>

/* Depth's errors in ulps: of the reference's depth, as binary32 would hold it. */
typedef struct error_count {
    uint64_t pixels, only_one; /* covered by both; by one only */
    uint64_t none, one, two, four; /* of `pixels`: the reference's depth rounded; within 1, 2, 4 ulps */
    double worst;
} error_count;

typedef struct accuracy {
    error_count alone;   /* each triangle drawn by itself: every pixel it covers, hidden or not */
    error_count frame;   /* the picture of all */
    uint64_t outside;    /* alone: depth outside the triangle's own corner depths */
    uint64_t past_bound; /* alone: depth further off than binary32's steps explain */
    uint64_t unlike;     /* pixels unlike the first backend's, or in the picture unlike its triangles put together */
    uint64_t fights;     /* of frame.pixels: another triangle in front */
    double fight_gap;    /* how far behind the reference's own it lies at most, ulps */
    /* The picture against the exact reference's, which knows no 24.8. */
    uint64_t exact_only_one, exact_other, exact_same; /* covered by one; another triangle in front; the same one */
    double exact_mean, exact_max;                     /* depth's relative difference where it is the same one */
    int backends;
} accuracy;

/* One mesh of float positions and 32-bit (or no) indices, placed where it stands. 1, or 0 without memory. */
int accuracy_measure(accuracy *out, const lmb_view *view, const lmb_scene *scene, int cull);

#endif
