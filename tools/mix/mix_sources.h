/* mix_sources.h: light from the object: emission, and the lights' light reflected by metal. [M20 M25] */
#ifndef MIX_SOURCES_H
#define MIX_SOURCES_H

#include "mix_job.h"

enum { MIX_WAYS = 6 /* ways, directions that a surface can face: +x -x +y -y +z -z */ };

/* A patch of the object's surface. Emission is Lambertian; metal reflects by a lobe about the mirror direction. */
typedef struct mix_patch {
    lmb_vec3 at, normal;
    lmb_vec3 from;    /* metal: unit, towards the light that it reflects */
    float flux[3];    /* W: emitted; or arriving, times F0 */
    float arrives[3]; /* W; emitted: 0 */
    float alpha2;     /* of the lobe; 0: it emits */
    float area;       /* m2, of the surface that the patch represents */
    lmb_vec3 on;      /* the brightest surface point in it */
} mix_patch;

/* Neighbouring patches first .. past - 1 of one way: a pixel sees all of those that face it, or none. */
typedef struct mix_bundle {
    int32_t first, past;
    int32_t far_first, far_past; /* merged patches that replace them from `reach` m on */
    lmb_vec3 middle;
    float reach;
} mix_bundle;

/* Patches sorted by way. Each way with patches has a light of 1 W/sr among the job's last ones, which gives lobes a
 * light direction. The light has no shadow map: right under a ball on a floor, the ball's light would lie in the
 * floor. */
typedef struct mix_sources {
    mix_patch *piece;
    int32_t first[MIX_WAYS + 1]; /* by light: patches first[i] .. first[i + 1] - 1; the merged ones come last */
    mix_bundle *bundle;
    int32_t bundles[MIX_WAYS + 1]; /* by light, likewise */
    lmb_bvh bvh; /* of the scene */
    float noise; /* m: maximum rounding error of a bundle's position */
    double sent[3]; /* W, total */
} mix_sources;

/* mix_sources_find: sets j->sources and writes the lights of the ways with patches to `out`. The job's lights must have
 * their maps. Returns the number of lights, or -1 with `r` set. */
int32_t mix_sources_find(lmb_light out[MIX_WAYS], mix_job *j, report *r);

/* mix_sources_at: irradiance by the patches of one light, W/m2, without occlusion. */
void mix_sources_at(float out[3], const mix_sources *s, int32_t light, lmb_vec3 at, lmb_vec3 normal);

/* mix_sources_tile: adds the irradiance by the job's light i, one of the last ones, to a tile. If `photo`, a tile that
 * changes by less than one 8-bit code is skipped. */
void mix_sources_tile(lmb_irradiance *inout, const mix_job *j, const lmb_tile *tile, int32_t i, int photo);

/* mix_sources_points: turns the flux of points into their reflected part of the object's light. On entry it must be
 * their reflected part of pi W/m2, and `white` the same for white surfaces. Adds the power that arrives at them to
 * `arrives`, W, by channel. */
void mix_sources_points(lmb_texel *inout, const lmb_texel *white, size_t count, double arrives[3], const mix_job *j);

/* mix_white_env: an environment of 1 W/(m2 sr). Returns 0 if the side or the memory is unsuitable. */
int mix_white_env(lmb_env *out, int32_t side, void *memory, size_t bytes);

#endif
