/* relight_light.h: a world seen from one or more places, and the light at a place in it. */
#ifndef RELIGHT_LIGHT_H
#define RELIGHT_LIGHT_H

#include "../picture/world_series.h"
#include "relight_options.h"

/* All working memory; large, so allocate one. Zero it before use. */
typedef struct relight_light {
    world_pictures pictures;
    world_series series; /* of a numbered --world */
    world_moment moment; /* of its series */
    lmb_world world[RELIGHT_WORLDS];
    void *world_memory[RELIGHT_WORLDS], *table_memory[3], *blur_memory;
    lmb_probe_table table[3]; /* of the map, half the map and a quarter */
    lmb_probe_lights lights;
    lmb_probe_blur blur;
    float map[3 * RELIGHT_WIDTH * RELIGHT_HEIGHT], half[3 * RELIGHT_WIDTH * RELIGHT_HEIGHT / 4];
    float line[RELIGHT_WIDTH + RELIGHT_WIDTH * RELIGHT_HEIGHT / 16];
    float cube[3 * 6 * RELIGHT_MAX_FACES * RELIGHT_MAX_FACES]; /* planes */
    float one[3 * RELIGHT_WIDTH * RELIGHT_HEIGHT]; /* the part of one of several worlds */
} relight_light;

/* relight_light_make: reads the world and prepares the data for all places; call it first. relight_light_at: renders
 * the view from a place into `map`, and filters the irradiance, n x n x 6, into `cube`. They return 1, or 0 with `r`
 * set. */
int relight_light_make(relight_light *out, relight_options *o, report *r);
/* relight_light_change: replaces the only world, seen from the same centre. Returns 1, or 0 with `r` set. [S20 S28] */
int relight_light_change(relight_light *inout, relight_options *o, const char *name, report *r);
/* relight_light_next: the same with the series' world of picture k. *changed: whether it is another one. */
int relight_light_next(relight_light *inout, int *changed, relight_options *o, int32_t k, report *r);
int relight_light_at(relight_light *inout, const relight_options *o, lmb_vec3 at, int32_t n, report *r);
/* relight_light_filter: filters `map` as it is. Returns 1, or 0 on failure. */
int relight_light_filter(relight_light *inout, const relight_options *o, int32_t n);
/* relight_light_see: renders the weighted sum of all worlds at a place into `map`. Returns 1, or 0 on failure. */
int relight_light_see(relight_light *inout, const relight_options *o, lmb_vec3 at);
/* relight_light_map: the same into a map of yours with a table for it; `one`: scratch of the same size. Returns 1, or 0
 * on failure. */
int relight_light_map(float *map, float *one, const lmb_probe_table *table, const relight_light *w,
                      const relight_options *o, lmb_vec3 at);
/* relight_light_reflect: lmb_probe_reflect over all worlds; if there are several, n must be at most RELIGHT_MAX_FACES.
 * Uses `cube`. Returns 1, or 0 on failure. */
int relight_light_reflect(relight_light *inout, const relight_options *o, float *planes, int32_t n,
                          lmb_probe_rays *rays, lmb_vec3 at, float roughness);
/* relight_light_nearest: the world with the centre nearest to a place. */
const lmb_world *relight_light_nearest(const relight_light *w, const relight_options *o, lmb_vec3 at);
void relight_light_free(relight_light *w);

/* relight_write_planes: writes planes of R, G and B as a picture. Returns 1, or 0 with `r` set. */
int relight_write_planes(const char *path, const float *planes, int32_t width, int32_t height, report *r);

#endif
