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
} mix_patch;

/* Patches by way; each way that has some has a light of 1 W/sr among the job's last ones, whose map tells what sees it. */
typedef struct mix_sources {
    mix_patch *piece;
    int32_t first[MIX_WAYS + 1]; /* by light: pieces first[i] .. first[i + 1] - 1 */
    lmb_vec3 axis[MIX_WAYS];     /* by light: the mean normal of what it stands for */
} mix_sources;

/* mix_sources_find: set j->sources, and the lights, `out`, of those ways that send something. The job's lights have their
 * maps. Returns how many there are, or -1 with `r` set. */
int32_t mix_sources_find(lmb_light out[MIX_WAYS], mix_job *j, report *r);

/* mix_sources_at: W/m2 that patches of one light send to a place, nothing being in their way. */
void mix_sources_at(float out[3], const mix_sources *s, int32_t light, lmb_vec3 at, lmb_vec3 normal);

/* mix_sources_tile: add what the job's light i, of the last ones, brings to a tile. Where `photo`, a tile that gets less
 * than a code of 8 bits shows gets nothing. */
void mix_sources_tile(lmb_irradiance *inout, const mix_job *j, const lmb_view *view, const lmb_tile *tile, int32_t i,
                      int photo);

/* mix_sources_texels: make the first points of one face of the shadow map of such a light, size x size, those of what it sends.
 * elsewhere: W that it sends to where no surface is, by channel, which is added to. */
void mix_sources_texels(lmb_texel *inout, int32_t size, double elsewhere[3], const mix_job *j, int32_t i,
                        int32_t face);

#endif
