/* mix_lobes.h: objects that reflect like metal, or have highlights like plastic. [M20] */
#ifndef MIX_LOBES_H
#define MIX_LOBES_H

#include "mix_mirror.h"

/* The memory that one tile's lobes are computed in. */
typedef struct mix_lobes {
    lmb_glossy lobes;
    uint64_t plastic; /* pixels of the lobes */
    mix_mirror mirror;
    float seen[3][LMB_TILE_PIXELS];
    lmb_irradiance one; /* of one light */
} mix_lobes;

/* mix_lobes_read: sets up the object's materials, with glossy lobes for metals. */
void mix_lobes_read(mix_job *j);

/* mix_lobes_sheen: gives a material the lobe of a smooth non-metal, such as plastic, that the object has in its file.
 * Returns whether it has one. mix_lobes_take: sets j->shiny, where such lobes reflect lights and the environment, but
 * neither the photo nor light onto it. Returns 1, or 0 with `r` set. */
int mix_lobes_sheen(lmb_material *inout, const model *object, uint32_t i);
int mix_lobes_take(mix_job *j, report *r);

/* mix_lobes_bounces: sets j->bounces, the scene that is used for bounced light. In it, metals reflect their light
 * diffusely. Light that they reflect from given lights is excluded (mix_sources.h). */
int mix_lobes_bounces(mix_job *j, report *r);

/* mix_lobes_lights: adds the lights to a tile of the object and to its lobes. The tile is one of `samples` samples of
 * the picture, and each uses a separate part of a guessed sun. mix_lobes_finish: completes the radiance: the part that
 * lobes leave to diffuse light, the reflected photo with the object (mix_mirror.h), and emission. */
void mix_lobes_lights(mix_lobes *out, lmb_irradiance *inout, const mix_job *j, const lmb_view *view,
                      const lmb_tile *object, int32_t sample, int32_t samples);
void mix_lobes_finish(lmb_radiance *inout, mix_lobes *s, const mix_job *j, const lmb_view *view,
                      const lmb_tile *object);

#endif
