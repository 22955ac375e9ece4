/* light_export.h: `lambent bake --to`: bounced light in formats for other engines. */
#ifndef LIGHT_EXPORT_H
#define LIGHT_EXPORT_H

#include "../model/glb_write.h"
#include "bake.h"
#include "light_solve.h"

enum { LIGHT_TRANSFER, LIGHT_COLOURS, LIGHT_MAP, LIGHT_PROBES };

/* A corner of a triangle, in world space and in object space. */
typedef struct light_corner {
    lmb_vec3 at, normal;
    lmb_vec3 own_at, own_normal;
    float uv[MODEL_UV_SETS][2], tangent[4], colour[4];
    int has_wide_colour; /* of a mesh in LMB_COLOUR_RGBA16 */
} light_corner;

/* light_corners: returns the corners of the front or back of triangle `id`, counter-clockwise seen from that side in
 * world space. `source` NULL: the model has no source. */
int light_corners(light_corner out[3], lmb_vec3 *face, const lmb_scene *scene, const model_source *source, uint32_t id,
                  uint32_t back);
light_corner light_along(const light_corner *a, const light_corner *b, float part);
light_corner light_between(const light_corner *a, const light_corner *b); /* in the middle */

/* A growing mesh. Corners with equal bytes share a vertex. light_mesh_put returns 1, or 0 with `r` set. */
enum { LIGHT_SLOTS = 1 << 16 };
typedef struct light_mesh {
    glb_mesh mesh;
    int32_t *slot, *next; /* vertices by the hash of their bytes */
    int is_mirrored;      /* the transform of the object is mirrored */
} light_mesh;

int light_mesh_begin(light_mesh *m, const lmb_scene *scene, uint32_t instance, report *r);
void light_mesh_end(light_mesh *m); /* frees everything except `mesh` */
int light_mesh_put(light_mesh *m, const glb_vertex triangle[3], report *r);
void light_vertex_of(glb_vertex *out, const light_corner *c);

/* light_colours, light_picture: write a GLB. light_probes: writes a JSON and a file of numbers, then works like
 * light_check. All return 1, or 0 with `r` set. */
int light_colours(const char *path, light_solve *s, const model *loaded, report *r);
int light_picture(const char *path, light_solve *s, const model *loaded, int32_t side, report *r);
int light_probes(const char *path, light_solve *s, bake *b, float step_m, int is_quiet, report *r);

/* light_probe_normal: returns normal k for sampling the light at a probe, and a weight; the weights sum to 4 pi.
 * light_probe_add: adds the irradiance at normal k to the spherical harmonics of radiance, R, G and B for each. */
enum { LIGHT_PROBE_NORMALS = 14 };
lmb_vec3 light_probe_normal(int k, float *weight);
void light_probe_add(float inout[27], int k, const float e[3]);

/* light_probes_fit: checks that the lattice has few enough places. Call it before a bake, which takes minutes.
 * Returns 1, or 0 with `r` set. */
int light_probes_fit(const lmb_scene *scene, float step_m, report *r);

/* Light at a place of the scene as a format stores it, W/m2. */
typedef struct light_source {
    const lmb_scene *scene;
    void (*light)(float out[3], const void *user, uint32_t id, lmb_vec3 at, lmb_vec3 normal);
    const void *user;
} light_source;

/* light_check: reads the file back, renders one view and prints the error against the light that it was baked from.
 * light_compare: the same for any format. */
int light_check(const char *path, light_solve *s, const char *form, int is_quiet, report *r);
int light_compare(const char *path, light_solve *s, const light_source *of, const char *form, int is_quiet, report *r);

#endif
