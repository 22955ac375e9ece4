/* render_world.h: the surroundings of a scene: a sky or an environment map, as lights and background, and a ground. */
#ifndef RENDER_WORLD_H
#define RENDER_WORLD_H

#include <lambent/lambent.h>

#include "../common/report.h"

/* Zeroed: none. Release it with world_free. */
typedef struct world {
    lmb_env env; /* texels NULL: no world */
    void *env_memory;
    lmb_light *lights; /* distant lights, one per part of the sky that is not black, without the sun */
    uint32_t count;
    lmb_light sun, fading; /* fading: of the world before, in a blend */
    int has_sun, has_fading, is_sky, has_ground;
    uint32_t ground_id; /* id of the first triangle of the ground, which comes last */
    /* Copies of the scene's arrays with the ground appended. */
    lmb_mesh *meshes;
    lmb_material *materials;
    lmb_instance *instances;
    float *corners;
    size_t bytes;
} world;

/* world_sky: a clear sky with a sun of 3 W/m2 from the front left and above. view_frame looks from the right, so
 * that the sides of a box differ and the shadow is visible. world_read: reads an environment map in the formats of
 * world_read_cube; a small bright area in it becomes the sun. Return 1, or 0 with `r` set. */
int world_sky(world *out, report *r);
int world_read(world *out, const char *path, int is_quiet, report *r);

/* world_put_ground: adds a grey disc below the scene, unless the scene has a floor or is one, the eye is inside or
 * below, or the disc is too large or too far from the origin. world_light: call it afterwards; makes the lights and
 * leaves out those that the ground hides. Return 1, or 0 with `r` set. */
int world_put_ground(world *inout, lmb_scene *scene, lmb_vec3 eye, report *r);
int world_light(world *inout, report *r);

/* world_blend: sets the light of `inout`, which world_light has made, to that of two worlds with equal faces and
 * without lights, with a share of b. Suns that are near each other become one between them. `b` may be NULL with a
 * share of 0. [S20 S28] */
void world_blend(world *inout, const world *a, const world *b, float share);

void world_free(world *w);

#endif
