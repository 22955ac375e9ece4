/* relief_sky.h: light and background of a picture of reliefs from a world around it: a sky or an environment map. */
#ifndef RELIEF_SKY_H
#define RELIEF_SKY_H

#include "../render/light_stream.h"
#include "../render/render_world.h"

/* Zeroed: none. Release it with relief_sky_free. Do not move it. */
typedef struct relief_sky {
    world around;        /* take the sun from here; `stream` and `irradiance` do not include it */
    lmb_env irradiance;  /* without occlusion, by normal, W/m2 */
    light_stream stream; /* the same light as lights, for occlusion by other geometry */
    void *memory;
    lmb_scene ground;    /* a disc below the reliefs; no instances: none */
    lmb_instance on_ground;
} relief_sky;

/* Scratch of one thread. Zero it first. */
typedef struct relief_sky_scratch {
    lmb_many_lights_scratch lights;
    lmb_tile tile;
} relief_sky_scratch;

/* relief_sky_open: reads a world, or makes a sky if `path` is "sky".
 *
 *   below  NULL: no ground. Otherwise a grey disc goes below this scene, unless the eye is inside or below
 *   eye    of the first picture
 * Returns 1, or 0 with `r` set and nothing allocated. */
int relief_sky_open(relief_sky *out, const char *path, const lmb_scene *below, lmb_vec3 eye, int is_quiet, report *r);
void relief_sky_free(relief_sky *s);

/* relief_sky_tile: adds the sky's irradiance to a tile's pixels. Pixels of `of_relief`, a bit each, are occluded
 * by `plain`, the others by `both`. With an empty `plain` (no nodes) nothing occludes. A relief does not occlude
 * itself. */
lmb_status relief_sky_tile(lmb_irradiance *inout, relief_sky_scratch *scratch, const relief_sky *s,
                           const lmb_kernels *kernels, const lmb_tile *tile, uint64_t of_relief, const lmb_bvh *plain,
                           const lmb_bvh *both);

/* relief_sky_behind: the radiance seen through the centre of a pixel at the view's sample. */
void relief_sky_behind(float rgb[3], const relief_sky *s, const lmb_view *view, int32_t x, int32_t y);

#endif
