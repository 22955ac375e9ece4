/* render_world.h: what lies around a scene: a sky or a picture of one, as lights and as background, and a ground. */
#ifndef RENDER_WORLD_H
#define RENDER_WORLD_H

#include <lambent/lambent.h>

#include "../common/report.h"

/* Zeroed: none. world_free releases it. */
typedef struct world {
    lmb_env env; /* texels NULL: no world */
    void *env_memory;
    lmb_light *lights; /* from afar, one for each piece of the sky that is not black; the sun is not among them */
    uint32_t count;
    lmb_light sun;
    int has_sun, is_sky, has_ground;
    uint32_t ground_id; /* its first triangle's: the last ones are its own */
    /* A scene's arrays with the ground behind what they had. */
    lmb_mesh *meshes;
    lmb_material *materials;
    lmb_instance *instances;
    float *corners;
    size_t bytes;
} world;

/* world_sky: a clear sky with a sun of 3 W/m2 from the upper left of the front; view_frame looks from its right, so that
 * the sides of a box differ and its shadow is seen. world_read: a picture of all directions, as
 * world_read_cube takes them; what is small and bright in it becomes the sun. 1, or 0 with `r` set. */
int world_sky(world *out, report *r);
int world_read(world *out, const char *path, int is_quiet, report *r);

/* world_put_ground: a grey disc under the scene, unless it has a floor of its own or is one, the eye is inside or
 * below, or it is too large or too far from the origin.
 * world_light: its lights, after that; what a ground hides is none. Each 1, or 0 with `r` set. */
int world_put_ground(world *inout, lmb_scene *scene, lmb_vec3 eye, report *r);
int world_light(world *inout, report *r);

void world_free(world *w);

#endif
