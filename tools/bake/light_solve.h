/* light_solve.h: the bounced light of a scene, solved once from a transfer; you can evaluate it at any point. */
#ifndef LIGHT_SOLVE_H
#define LIGHT_SOLVE_H

#include "../render/render_job.h"

enum { SOLVE_PLACES = LMB_TILE_PIXELS };

typedef struct light_solve {
    render_job job; /* light stages done; `frame` has the light and a view of the scene */
    lmb_transfer_scratch scratch;
    lmb_tile tile;
} light_solve;

/* A point on a surface. */
typedef struct light_place {
    lmb_vec3 at, face, normal; /* m; unit normals: of the triangle's side; for shading */
    uint32_t id;
} light_place;

/* light_begin: `o` has the scene's name, lights, bounces and threads; `lmt`, the baked file, is moved into `s`.
 * light_end releases it. light_at: irradiance at up to SOLVE_PLACES places, W/m2. Return 1, or 0 with `r` set. */
int light_begin(light_solve *s, const render_options *o, const lmb_scene *scene, const model *loaded, file_bytes *lmt,
                report *r);
void light_end(light_solve *s);
void light_at(float (*out)[3], light_solve *s, const light_place *place, int count);

#endif
