/* glb_write.h: a scene with baked light as a GLB, for other engines: one buffer, one mesh an object, in world metres. */
#ifndef GLB_WRITE_H
#define GLB_WRITE_H

#include "../common/io_file.h"
#include "model.h"

/* As it lies in the file. */
typedef struct glb_vertex {
    float position[3], normal[3]; /* world */
    float uv[2];                  /* TEXCOORD_0 */
    float light_uv[2];            /* TEXCOORD_1 */
    uint16_t light[4];            /* COLOR_1: of the scale; the fourth 65535 */
    uint8_t colour[4];            /* COLOR_0 */
} glb_vertex;

/* Triangles of one object and material, whose front alone shows. */
typedef struct glb_mesh {
    glb_vertex *vertex;
    uint32_t *index;
    uint32_t vertex_count, index_count, vertex_cap, index_cap;
    uint32_t material;
} glb_mesh;

typedef struct glb_light {
    const char *form;          /* asset.extras.lambent.light: "vertex-colours" or "lightmap" */
    float scale;               /* W/m2: what a colour of 1 stands for */
    const file_bytes *picture; /* a PNG, by light_uv; NULL: none */
} glb_light;

/* glb_write: materials and textures, lights and cameras of the model and its scene with these meshes. 1, or 0 with `r`
 * set. */
int glb_write(const char *path, const lmb_scene *scene, const model *loaded, const glb_mesh *mesh, uint32_t mesh_count,
              const glb_light *light, report *r);

#endif
