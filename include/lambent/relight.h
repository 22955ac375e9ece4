/* relight.h: objects drawn in the light of the world around them, with the world as background. [S15-S17, S21-S24]
 *
 *     lmb_draw(&relight.eye, ...);                    the objects, depth and ids
 *     for each band: lmb_relight_band(&relight, scratch, out, band);
 *
 * Each instance of the scene has a probe: cubes of irradiance and of reflected radiance at its position. An object of
 * several instances has one for each (face, shirt, helmet), or shares one. The scene's lights are added, with shadows
 * of the objects on each other.
 *
 * Stability: experimental. Tags like [S15] are requirements in src/SOURCES.md. */
#ifndef LMB_RELIGHT_H
#define LMB_RELIGHT_H

#include "compose.h"
#include "probe.h"

enum { LMB_RELIGHT_BOTH = 0, LMB_RELIGHT_NORMAL = 1, LMB_RELIGHT_GLOSSY = 2 }; /* the part to show: both parts sum to
                                                                                  BOTH [S24] */

/* The light of an instance. */
typedef struct lmb_probe {
    lmb_probe_cube irradiance; /* by normal */
    lmb_probe_cube glossy;     /* by reflected direction; texel NULL: pixels sample the world itself [S17] */
} lmb_probe;

/* Scratch for a band; one for each thread. */
typedef struct lmb_relight_scratch {
    lmb_tile tile;
    lmb_irradiance light, one;
    lmb_glossy glossy;
    lmb_radiance radiance;
    lmb_probe_rays rays;
} lmb_relight_scratch;

typedef struct lmb_relight {
    const lmb_kernels *kernels;
    const lmb_scene *scene;    /* checked; materials' lobes reflect the world */
    const lmb_shadow_map *maps; /* of the scene's lights, drawn; NULL: they cast no shadows */
    const lmb_world *world;    /* NULL: black behind the objects, and in lobes without a `glossy` cube */
    int32_t blend;             /* see lmb_probe_remap */
    const lmb_probe *probes;
    const uint16_t *probe_of;  /* by instance: index of the probe */
    uint32_t probe_count;
    lmb_view view;
    lmb_target eye;            /* depth and ids, drawn: the whole frame, or the band's rows */
    int32_t show;              /* LMB_RELIGHT_ */
    float exposure_ev;
} lmb_relight;

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_relight_band: draw rows 8 band .. 8 band + 7.
 *
 *   out  the whole frame, or 8 rows that receive the band.
 * Returns LMB_OK, LMB_ERR_ARG (null, band outside, an instance's probe past probe_count or without irradiance) or
 * LMB_ERR_FORMAT. Bands in any order, on any threads. */
lmb_status lmb_relight_band(const lmb_relight *r, lmb_relight_scratch *scratch, const lmb_surface *out, int32_t band);

#ifdef __cplusplus
}
#endif
#endif
