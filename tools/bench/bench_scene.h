/* bench_scene.h: the fixed raster workload: meshes, cameras and cases that other rasterizers were measured with. */
#ifndef BENCH_SCENE_H
#define BENCH_SCENE_H

#include <lambent/lambent.h>

#include "../common/report.h"
#include "../picture/image.h"

enum { BENCH_DEPTH = 0, BENCH_GOURAUD, BENCH_TEXTURED };
enum { BENCH_BUNNY = 0, BENCH_SPONZA_INSIDE, BENCH_SPONZA_LIGHT, BENCH_FILL_PASS, BENCH_FILL_FAIL };

typedef struct bench_case {
    const char *name;
    int scene, look;
    int32_t width, height;
    int cull;
} bench_case;

extern const bench_case bench_cases[];
extern const int bench_case_count;

/* One case's scene, ready to draw. Release it with bench_scene_free; do not copy it. */
typedef struct bench_scene {
    lmb_mesh mesh;
    lmb_material material;
    lmb_texture texture;
    lmb_instance instance;
    lmb_scene scene;
    lmb_view view;
    file_bytes file; /* the mesh file; the mesh uses the arrays in place */
    void *made;      /* colours, texels or quads */
} bench_scene;

/* bench_scene_load: `folder` must contain bunny.mesh and sponza.mesh (the fill cases need neither). A mesh file is
 * little-endian: vertex and triangle counts (uint32), then positions and normals (3 floats each), texture coordinates
 * (2), indices (3 uint32). Returns 1, or 0 with `r` set and nothing allocated. */
int bench_scene_load(bench_scene *out, const bench_case *c, const char *folder, report *r);
void bench_scene_free(bench_scene *s);

#endif
