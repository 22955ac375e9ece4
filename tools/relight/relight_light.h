/* relight_light.h: a world, as one place of it sees it or as several do, and the light at its places. */
#ifndef RELIGHT_LIGHT_H
#define RELIGHT_LIGHT_H

#include "../picture/world_read.h"
#include "relight_options.h"

/* All that the work needs; large, and one of it. Zero it before use. */
typedef struct relight_light {
    world_pictures pictures;
    lmb_world world[RELIGHT_WORLDS];
    void *world_memory[RELIGHT_WORLDS], *table_memory[3], *blur_memory;
    lmb_probe_table table[3]; /* of the map, its half and its quarter */
    lmb_probe_lights lights;
    lmb_probe_blur blur;
    float map[3 * RELIGHT_WIDTH * RELIGHT_HEIGHT], half[3 * RELIGHT_WIDTH * RELIGHT_HEIGHT / 4];
    float line[RELIGHT_WIDTH + RELIGHT_WIDTH * RELIGHT_HEIGHT / 16];
    float cube[3 * 6 * RELIGHT_MAX_FACES * RELIGHT_MAX_FACES]; /* planes */
    float one[3 * RELIGHT_WIDTH * RELIGHT_HEIGHT]; /* what one of several worlds gives */
} relight_light;

/* relight_light_make: read the world and make all that serves every place. relight_light_at: what a place sees, into
 * `map`, and its irradiance by the filter, n x n x 6, into `cube`. 1, or 0 with `r` set. */
int relight_light_make(relight_light *out, relight_options *o, report *r);
int relight_light_at(relight_light *inout, const relight_options *o, lmb_vec3 at, int32_t n, report *r);
/* relight_light_filter: of `map` as it is. 1, or 0. */
int relight_light_filter(relight_light *inout, const relight_options *o, int32_t n);
/* relight_light_see: into `map`, what a place sees by all worlds, each by its share. 1, or 0. */
int relight_light_see(relight_light *inout, const relight_options *o, lmb_vec3 at);
/* relight_light_map: the same into another map by its table; `one`: scratch as large as that. 1, or 0. */
int relight_light_map(float *map, float *one, const lmb_probe_table *table, const relight_light *w, const relight_options *o,
                      lmb_vec3 at);
/* relight_light_reflect: lmb_probe_reflect of all worlds, n <= RELIGHT_MAX_FACES if they are several. Uses `cube`. 1, or 0. */
int relight_light_reflect(relight_light *inout, const relight_options *o, float *planes, int32_t n,
                          lmb_probe_rays *rays, lmb_vec3 at, float roughness);
/* relight_light_nearest: the world that was taken nearest to a place. */
const lmb_world *relight_light_nearest(const relight_light *w, const relight_options *o, lmb_vec3 at);
void relight_light_free(relight_light *w);

/* relight_write_planes: planes of R, G and B as a picture. 1, or 0 with `r` set. */
int relight_write_planes(const char *path, const float *planes, int32_t width, int32_t height, report *r);

#endif
