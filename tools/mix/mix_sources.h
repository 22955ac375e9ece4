/* mix_sources.h: light that an object sends on: what it emits, and what its metal throws on of the lights' light. [M20 M25] */
#ifndef MIX_SOURCES_H
#define MIX_SOURCES_H

#include "mix_job.h"

enum { MIX_WAYS = 6 /* of an object's surface: along +x -x +y -y +z -z */ };

/* A part of its surface. What emits sends by the cosine; metal by its lobe about the mirror direction. */
typedef struct mix_patch {
    lmb_vec3 at, normal;
    lmb_vec3 from;    /* metal: unit, towards the light that it reflects */
    float flux[3];    /* W: emitted; or what arrives times F0 */
    float arrives[3]; /* W; emitted: 0 */
    float alpha2;     /* of the lobe; 0: it emits */
    float area;       /* m2, what a patch stands for */
    lmb_vec3 on;      /* the place of the surface in it that sends most */
} mix_patch;

/* Patches first .. past - 1 of one way, side by side: a pixel sees all of them that face it, or none. */
typedef struct mix_bundle {
    int32_t first, past;
    int32_t far_first, far_past; /* pieces that stand for them from `reach` m on */
    lmb_vec3 middle;
    float reach;
} mix_bundle;

/* Patches by way; each way that has some has a light of 1 W/sr among the job's last ones, which tells lobes where it comes
 * from. No map is drawn from that: right under a ball on a floor a light of the ball would lie in the floor. */
typedef struct mix_sources {
    mix_patch *piece;
    int32_t first[MIX_WAYS + 1]; /* by light: pieces first[i] .. first[i + 1] - 1; behind the last ones those for afar */
    mix_bundle *bundle;
    int32_t bundles[MIX_WAYS + 1]; /* by light, likewise */
    lmb_bvh bvh; /* of the scene */
    float noise; /* m: how far off the surface rounding may have put a bundle's place */
    double sent[3]; /* W, all that they send */
} mix_sources;

/* mix_sources_find: set j->sources, and the lights, `out`, of those ways that send something. The job's lights have their
 * maps. Returns how many there are, or -1 with `r` set. */
int32_t mix_sources_find(lmb_light out[MIX_WAYS], mix_job *j, report *r);

/* mix_sources_at: W/m2 that patches of one light send to a place, nothing being in their way. */
void mix_sources_at(float out[3], const mix_sources *s, int32_t light, lmb_vec3 at, lmb_vec3 normal);

/* mix_sources_tile: add what the job's light i, of the last ones, brings to a tile. Where `photo`, a tile that gets less
 * than a code of 8 bits shows gets nothing. */
void mix_sources_tile(lmb_irradiance *inout, const mix_job *j, const lmb_tile *tile, int32_t i, int photo);

/* mix_sources_points: make the flux of points what they reflect of all that is sent. It is to be what they reflect of pi
 * W/m2, and `white` what they would if they were white. Added: W that arrives at them, by channel. */
void mix_sources_points(lmb_texel *inout, const lmb_texel *white, size_t count, double arrives[3], const mix_job *j);

/* mix_white_env: 1 W/(m2 sr) from everywhere. 0: no such side, or memory. */
int mix_white_env(lmb_env *out, int32_t side, void *memory, size_t bytes);

#endif
