/* glb_write.h: writes a scene with baked light as a GLB for other engines: one buffer, and one node for each object, in
 * object space. */
#ifndef GLB_WRITE_H
#define GLB_WRITE_H

#include "../common/io_file.h"
#include "model.h"

/* A vertex as the file stores it. */
typedef struct glb_vertex {
    float position[3], normal[3];   /* in object space */
    float uv[MODEL_UV_SETS][2];     /* TEXCOORD_0 and following */
    float tangent[4];               /* TANGENT */
    float light_uv[2];              /* the TEXCOORD_ of the lightmap */
    uint16_t light[4];              /* COLOR_1: times the scale; alpha is 65535 */
    uint16_t colour[4];             /* COLOR_0, in 65535ths */
} glb_vertex;

/* Triangles of one instance of the scene. Only their fronts are visible. */
typedef struct glb_mesh {
    glb_vertex *vertex;
    uint32_t *index;
    uint32_t vertex_count, index_count, vertex_cap, index_cap;
    uint32_t instance;
} glb_mesh;

typedef struct glb_light {
    const char *form;          /* asset.extras.lambent.light: "vertex-colours" or "lightmap" */
    float scale;               /* W/m2 of a colour of 1 */
    const file_bytes *picture; /* a PNG, by light_uv; NULL: none */
} glb_light;

/* glb_write: writes these meshes, sorted by instance, with the materials, textures, lights and cameras of the model
 * and the scene. If the model has a source, the rest of the document is written too: names, nodes, maps, extras,
 * extensions. Returns 1, or 0 with `r` set. */
int glb_write(const char *path, const lmb_scene *scene, const model *loaded, const glb_mesh *mesh, uint32_t mesh_count,
              const glb_light *light, report *r);

#endif
