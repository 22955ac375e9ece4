/* mix_swift.h: many placements of objects in one photo. Everything about the photo is computed once. The blocked part
 * of the environment is computed once for each object. Light is simpler than in mix_draw.h: there are no voxels, and an
 * object reflects light once, in the mean colour. */
#ifndef MIX_SWIFT_H
#define MIX_SWIFT_H

#include "mix_block.h"
#include "mix_grain.h"
#include "mix_labels.h"

enum { MIX_SWIFT_LIGHTS = 64, MIX_TOGETHER = 16 /* objects in a picture */ };

/* A mesh that some placements share. */
typedef struct mix_thing {
    const char *path;
    model object;
    mix_block block;
} mix_thing;

/* A placement: the mesh in the photo's scene space. */
typedef struct mix_spot {
    int32_t thing;
    lmb_mat4 placed;
    float scale;
    int32_t plane; /* under or behind it, or -1 */
    float lift;    /* 1/m: inverse depth of the plane at the foot, minus that of the whole plane */
    int hangs;
} mix_spot;

/* Of the photo. */
typedef struct mix_swift {
    mix_job *j; /* planes, real mesh, environment, lights */
    const mix_thing *things;
    uint64_t *lit;         /* by pixel: lights that reach it, a bit each */
    struct mix_area *area; /* by tile */
    uint8_t *codes;        /* 3 per pixel, for display formats; or NULL */
    float exposure_ev;
    int32_t columns, rows; /* of tiles */
} mix_swift;

/* mix_swift_begin: computes everything about the photo; j has planes, the real mesh and light. Memory is j's. */
int mix_swift_begin(mix_swift *out, mix_job *j, const mix_thing *things, report *r);

/* The memory of one thread. */
typedef struct mix_swift_desk mix_swift_desk;
mix_swift_desk *mix_swift_desk_make(const mix_swift *s, report *r);
void mix_swift_desk_free(mix_swift_desk *d);

/* mix_swift_draw: draws and writes a picture with `count` placements and, if `labels` is not NULL, its labels. Returns
 * 1, or 0 with `r` set. */
int mix_swift_draw(mix_swift_desk *d, const mix_swift *s, const mix_spot *spots, int32_t count, const char *out,
                   const char *labels, report *r);

#endif
