/* mend_normals.c: replaces normals without length by normals of faces. Meshes may share streams, so a vertex stays
 * marked until a mesh that draws it is processed. */
#include <string.h>

#include "mend_normals.h"
#include "smooth_normals.h"

static int is_marked(const lmb_mesh *m, uint32_t vertex) { return m->normals[2 * (size_t)vertex] == BUILD_NO_NORMAL; }

/* Adds the normal of a triangle to the sum of each marked vertex. */
static void add_triangle(double *sums, const lmb_mesh *m, const uint32_t vertex[3])
{
    double normal[3], weight[3];
    const float *corner[3];
    int i, k;
    for (i = 0; i < 3; ++i)
        corner[i] = (const float *)m->positions + 3 * (size_t)vertex[i];
    if (!corner_weights(normal, weight, corner))
        return;
    for (i = 0; i < 3; ++i)
        for (k = 0; k < 3 && is_marked(m, vertex[i]); ++k)
            sums[3 * (size_t)vertex[i] + (size_t)k] += weight[i] * normal[k];
}

static void set_normal(const lmb_mesh *m, uint32_t vertex, const double v[3])
{
    uint32_t zeros = 0;
    lmb_octahedral_encode((int16_t *)(uintptr_t)m->normals + 2 * (size_t)vertex, build_normal(v, &zeros));
}

/* Counts the marked vertices of a triangle. Returns 0 if there are none, or if an index is out of range. */
static uint32_t marked_of(const lmb_mesh *m, uint32_t triangle, uint32_t vertex[3])
{
    uint32_t i, count = 0;
    for (i = 0; i < 3; ++i) {
        vertex[i] = lmb_mesh_index(m, 3 * triangle + i);
        if (vertex[i] >= m->vertex_count)
            return 0;
        count += (uint32_t)is_marked(m, vertex[i]);
    }
    return count;
}

static void mend_mesh(const lmb_mesh *m, double *sums)
{
    uint32_t vertex[3], i, k;
    memset(sums, 0, 3 * (size_t)m->vertex_count * sizeof *sums);
    for (i = 0; i < m->triangle_count; ++i)
        if (marked_of(m, i, vertex))
            add_triangle(sums, m, vertex);
    for (i = 0; i < m->triangle_count; ++i) {
        if (!marked_of(m, i, vertex))
            continue;
        for (k = 0; k < 3; ++k)
            if (is_marked(m, vertex[k]))
                set_normal(m, vertex[k], sums + 3 * (size_t)vertex[k]);
    }
}

int mend_normals(model_build *b)
{
    static const double up[3] = {0, 1, 0};
    uint32_t i, v, largest = 0;
    double *sums;
    if (b->marked_normals == 0)
        return 1;
    build_note_count(b, "normals without length, made from the faces there", b->marked_normals);
    for (i = 0; i < b->mesh_count; ++i)
        if (b->meshes[i].normals && b->meshes[i].vertex_count > largest)
            largest = b->meshes[i].vertex_count;
    sums = (double *)build_scratch(b, largest, 3 * sizeof *sums);
    if (!sums)
        return 0;
    for (i = 0; i < b->mesh_count; ++i)
        if (b->meshes[i].normals && b->meshes[i].position_format == LMB_POSITION_F32)
            mend_mesh(&b->meshes[i], sums);
    for (i = 0; i < b->mesh_count; ++i)
        for (v = 0; b->meshes[i].normals && v < b->meshes[i].vertex_count; ++v)
            if (is_marked(&b->meshes[i], v))
                set_normal(&b->meshes[i], v, up);
    return 1;
}
