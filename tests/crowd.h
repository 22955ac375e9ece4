/* crowd.h: a test's random scenes: crowds of small triangles at all depths, behind and before walls of large ones, through
 * the near plane and outside the frame. */
#ifndef CROWD_H
#define CROWD_H

#include <string.h>

#include <lambent/raster.h>

#include "test.h"

#if LMB_CULLING
enum { SIDE = 136, CROWD = 700, WALLS = 70, CLUSTERS = 32 };

typedef struct stage {
    float crowd[9 * CROWD], walls[9 * WALLS];
    lmb_mesh mesh[2];
    lmb_material material[2];
    lmb_instance instance[3];
    lmb_scene scene;
    lmb_view view;
    lmb_cluster cluster[CLUSTERS];
} stage;

static stage st;

/* A triangle within `size` of a place. */
static void put_triangle(test_rng *r, float *out, const float *at, float size)
{
    for (int i = 0; i < 9; ++i) {
        out[i] = at[i % 3] + test_uniform(r, -size, size);
    }
}

static void make_crowd(test_rng *r)
{
    float at[3] = {0, 0, 0};
    for (int i = 0; i < CROWD; ++i) {
        if (i % LMB_CLUSTER == 0) { /* somewhere else: seen, beside the frame, or behind the viewer */
            at[0] = test_uniform(r, -9, 9);
            at[1] = test_uniform(r, -9, 9);
            at[2] = test_uniform(r, -30, 2);
        }
        put_triangle(r, st.crowd + 9 * i, at, i % 7 == 0 ? 2.0f : 0.4f);
    }
}

/* Most face the viewer and cover much of the frame. */
static void make_walls(test_rng *r)
{
    for (int i = 0; i < WALLS; ++i) {
        float *p = st.walls + 9 * i;
        const float z = test_uniform(r, -25, -3);
        const float at[3] = {test_uniform(r, -3, 3), test_uniform(r, -3, 3), z};
        put_triangle(r, p, at, i % 3 == 0 ? 20.0f : 4.0f);
        if (i % 5 != 0) {
            p[2] = z;
            p[5] = z + test_uniform(r, -0.5f, 0.5f);
            p[8] = z + test_uniform(r, -0.5f, 0.5f);
        }
    }
}

static void make_stage(test_rng *r, int32_t kind)
{
    static const lmb_mat4 unit = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
    memset(&st, 0, sizeof st);
    make_crowd(r);
    make_walls(r);
    st.mesh[0].positions = st.crowd;
    st.mesh[0].triangle_count = CROWD;
    st.mesh[1].positions = st.walls;
    st.mesh[1].triangle_count = WALLS;
    for (int i = 0; i < 2; ++i) {
        st.mesh[i].vertex_count = 3 * st.mesh[i].triangle_count;
        st.material[i].texture = -1;
    }
    st.material[1].flags = LMB_DOUBLE_SIDED;
    for (int i = 0; i < 3; ++i) {
        st.instance[i].to_world = unit;
    }
    st.instance[0].mesh = st.instance[0].material = 1; /* not in the meshes' order */
    st.instance[2].to_world.m[0] = -1.0f;
    st.instance[2].to_world.m[14] = -2.0f;
    st.instance[0].first_id = 1;
    st.instance[1].first_id = 1 + WALLS;
    st.instance[2].first_id = 1 + WALLS + CROWD;
    st.scene.meshes = st.mesh;
    st.scene.materials = st.material;
    st.scene.instances = st.instance;
    st.scene.mesh_count = st.scene.material_count = 2;
    st.scene.instance_count = 3;
    st.view.kind = kind;
    st.view.right.x = st.view.up.y = st.view.back.z = 1.0f;
    st.view.half_width = st.view.half_height = kind == LMB_ORTHOGRAPHIC ? 6.0f : 0.8f;
    st.view.near_m = 0.5f;
    st.view.far_m = 40.0f;
    st.view.frame_width = st.view.frame_height = SIDE;
}
#endif

#endif
