/* main_simplify.c: measures simplified meshes (rhino_60k at 3,000 triangles, stanford_bunny at 2,000, lucy_100k at
 * 4,000) in the modes near and around, and the time for a million triangles.
 *
 *     simplify
 *
 * `out`: share of the original's vertices more than 1e-5 outside the simple mesh, and the farthest one; `off`: mean and
 * maximum distance from the original's vertices to the simple mesh; `back`: the same from the simple mesh to the
 * original. All are relative to the diagonal. `missed` and `extra`: pixels that only the original or only the simple
 * mesh covers in 24 orthographic views of 512 x 512, relative to the original's. Seconds are those of one core. Bars:
 * the requested triangles; near: `off` by 0.1 % in the mean; around: 0.01 % missed, 4 % extra; a million in 15 s. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "../../tools/mesh/simplify.h"
#include "../../tools/mesh/triangle_tree.h"
#include "../../tools/model/model.h"
#include "../shared_file.h"

int test_passed, test_failed, test_skipped;

enum { SIDE = 512, VIEWS = 24 };

typedef struct distances {
    double mean, max; /* from one mesh's vertices to the other mesh, relative to the diagonal */
    double out_share, out_most;
} distances;

/* --- models --- */

/* Reads the first mesh of a model, without transformations; the samples have only one. */
static int read_mesh(triangle_mesh *out, const char *path)
{
    model m;
    model_notes notes;
    report r;
    uint32_t i;
    memset(&notes, 0, sizeof notes);
    memset(&r, 0, sizeof r);
    memset(out, 0, sizeof *out);
    if (!model_load(&m, path, NULL, &notes, &r)) {
        printf("%s\n", r.text);
        return 0;
    }
    out->vertex_count = m.scene.meshes[0].vertex_count;
    out->triangle_count = m.scene.meshes[0].triangle_count;
    out->positions = malloc(out->vertex_count * 3 * sizeof(float));
    out->indices = malloc(out->triangle_count * 3 * sizeof(uint32_t));
    memcpy(out->positions, m.scene.meshes[0].positions, out->vertex_count * 3 * sizeof(float));
    for (i = 0; i < 3 * out->triangle_count; ++i)
        out->indices[i] = m.scene.meshes[0].index_format == LMB_INDEX_U16
                              ? ((const uint16_t *)m.scene.meshes[0].indices)[i]
                              : ((const uint32_t *)m.scene.meshes[0].indices)[i];
    model_free(&m);
    return 1;
}

static void put_middle(float *to, const float *p, const float *q)
{
    int k;
    for (k = 0; k < 3; ++k)
        to[k] = 0.5f * p[k] + 0.5f * q[k];
}

/* Splits each triangle into four, with six new vertices for each original triangle. */
static triangle_mesh in_four(const triangle_mesh *m)
{
    static const uint32_t parts[12] = {0, 3, 5, 3, 1, 4, 5, 4, 2, 3, 4, 5};
    triangle_mesh out;
    uint32_t t, k;
    memset(&out, 0, sizeof out);
    out.vertex_count = 6 * m->triangle_count;
    out.triangle_count = 4 * m->triangle_count;
    out.positions = malloc(out.vertex_count * 3 * sizeof(float));
    out.indices = malloc(out.triangle_count * 3 * sizeof(uint32_t));
    for (t = 0; t < m->triangle_count; ++t) {
        float *p = out.positions + 18 * (size_t)t;
        for (k = 0; k < 3; ++k)
            memcpy(p + 3 * k, m->positions + 3 * (size_t)m->indices[3 * t + k], 3 * sizeof(float));
        for (k = 0; k < 3; ++k)
            put_middle(p + 9 + 3 * k, p + 3 * k, p + 3 * ((k + 1) % 3));
        for (k = 0; k < 12; ++k)
            out.indices[12 * (size_t)t + k] = 6 * t + parts[k];
    }
    return out;
}

/* Length of the box's diagonal, and its middle. */
static double diagonal(const triangle_mesh *m, dvec *middle)
{
    dvec low = dvec_of(HUGE_VAL, HUGE_VAL, HUGE_VAL), high = dvec_mul(low, -1);
    uint32_t v;
    for (v = 0; v < m->vertex_count; ++v) {
        const dvec p = dvec_read(m->positions + 3 * (size_t)v);
        low = dvec_of(fmin(low.x, p.x), fmin(low.y, p.y), fmin(low.z, p.z));
        high = dvec_of(fmax(high.x, p.x), fmax(high.y, p.y), fmax(high.z, p.z));
    }
    *middle = dvec_mix(low, high, 0.5);
    return dvec_length(dvec_sub(high, low));
}

/* --- distances --- */

static distances measure(const triangle_mesh *from, const triangle_mesh *to, double size)
{
    triangle_tree tree;
    counted_heap t = {0, 0};
    distances d = {0, 0, 0, 0};
    uint32_t v, guess = 0;
    if (!triangle_tree_build(&tree, to, &t))
        exit(1);
    for (v = 0; v < from->vertex_count; ++v) {
        const dvec p = dvec_read(from->positions + 3 * (size_t)v);
        const nearest n = triangle_tree_nearest(&tree, p, guess);
        const double far = sqrt(n.distance2) / size;
        guess = n.triangle;
        d.mean += far / from->vertex_count;
        d.max = fmax(d.max, far);
        if (nearest_is_outside(&n, p) && far > 1e-5) {
            d.out_share += 1.0 / from->vertex_count;
            d.out_most = fmax(d.out_most, far);
        }
    }
    triangle_tree_free(&tree, &t);
    return d;
}

/* --- silhouettes --- */

typedef struct view {
    dvec right, up, middle;
    double scale; /* pixels a metre */
} view;

/* View i of directions that lie on a spiral over the sphere. */
static view view_of(int i, dvec middle, double size)
{
    const double z = 1 - (2 * i + 1) / (double)VIEWS, r = sqrt(1 - z * z), turn = i * 2.399963229728653;
    const dvec back = dvec_of(r * cos(turn), r * sin(turn), z);
    view v;
    v.right = dvec_unit(dvec_cross(fabs(back.y) < 0.9 ? dvec_of(0, 1, 0) : dvec_of(1, 0, 0), back));
    v.up = dvec_cross(back, v.right);
    v.middle = middle;
    v.scale = 0.9 * SIDE / size;
    return v;
}

static double side_of(const double p[2], const double q[2], double x, double y)
{
    return (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]);
}

/* Marks the pixels with their middle in the triangle or on an edge. The triangle may face either way. */
static void cover(uint8_t *mask, double c[3][2])
{
    const double way = side_of(c[0], c[1], c[2][0], c[2][1]) > 0 ? 1 : -1;
    const int x0 = (int)fmax(0, ceil(fmin(c[0][0], fmin(c[1][0], c[2][0]))));
    const int x1 = (int)fmin(SIDE - 1, floor(fmax(c[0][0], fmax(c[1][0], c[2][0]))));
    const int y0 = (int)fmax(0, ceil(fmin(c[0][1], fmin(c[1][1], c[2][1]))));
    const int y1 = (int)fmin(SIDE - 1, floor(fmax(c[0][1], fmax(c[1][1], c[2][1]))));
    int x, y;
    for (y = y0; y <= y1; ++y)
        for (x = x0; x <= x1; ++x)
            if (way * side_of(c[0], c[1], x, y) >= 0 && way * side_of(c[1], c[2], x, y) >= 0
                && way * side_of(c[2], c[0], x, y) >= 0)
                mask[y * SIDE + x] = 1;
}

static void draw(uint8_t *mask, const triangle_mesh *m, const view *v)
{
    uint32_t t;
    int k;
    memset(mask, 0, SIDE * SIDE);
    for (t = 0; t < m->triangle_count; ++t) {
        double corners[3][2];
        for (k = 0; k < 3; ++k) {
            const float *p = m->positions + 3 * (size_t)m->indices[3 * (size_t)t + (size_t)k];
            const dvec d = dvec_mul(dvec_sub(dvec_read(p), v->middle), v->scale);
            corners[k][0] = dvec_dot(d, v->right) + 0.5 * SIDE - 0.5;
            corners[k][1] = dvec_dot(d, v->up) + 0.5 * SIDE - 0.5;
        }
        cover(mask, corners);
    }
}

static void compare_views(const triangle_mesh *in, const triangle_mesh *out, double *missed, double *extra)
{
    static uint8_t a[SIDE * SIDE], b[SIDE * SIDE];
    dvec middle;
    const double size = diagonal(in, &middle);
    double covered = 0;
    int i, k;
    *missed = *extra = 0;
    for (i = 0; i < VIEWS; ++i) {
        const view v = view_of(i, middle, size);
        draw(a, in, &v);
        draw(b, out, &v);
        for (k = 0; k < SIDE * SIDE; ++k) {
            covered += a[k];
            *missed += a[k] && !b[k];
            *extra += b[k] && !a[k];
        }
    }
    *missed /= covered;
    *extra /= covered;
}

/* --- figures --- */

static double seconds(void) { return (double)clock() / CLOCKS_PER_SEC; }

static void pass_if(int good, const char *what)
{
    test_passed += good;
    test_failed += !good;
    if (!good)
        printf("FAIL %s\n", what);
}

static void try_mesh(const char *name, const triangle_mesh *in, uint32_t triangles, int around)
{
    triangle_mesh out;
    simplify_facts facts;
    report r = {""};
    dvec middle;
    const double size = diagonal(in, &middle), start = seconds();
    double missed, extra, took;
    distances off, back;
    if (!simplify_mesh(&out, in, triangles, around, &facts, &r)) {
        pass_if(0, r.text);
        return;
    }
    took = seconds() - start;
    off = measure(in, &out, size);
    back = measure(&out, in, size);
    compare_views(in, &out, &missed, &extra);
    printf("%-18s %-6s %7u %5u %5.2f s %4u MB  %6.2f %5.2f   %6.3f %5.2f   %6.3f %5.2f   %7.4f %6.3f\n", name,
           around ? "around" : "near", (unsigned)in->triangle_count, (unsigned)out.triangle_count, took,
           (unsigned)(facts.memory_bytes >> 20), 100 * off.out_share, 100 * off.out_most, 100 * off.mean, 100 * off.max,
           100 * back.mean, 100 * back.max, 100 * missed, 100 * extra);
    pass_if(out.triangle_count <= triangles, "triangles");
    pass_if(around ? missed <= 1e-4 && extra <= 0.04 : off.mean <= 1e-3, "distance or silhouette");
    pass_if(took < 15, "seconds");
    triangle_mesh_free(&out);
}

static void try_model(const char *file, uint32_t triangles, int finer)
{
    char path[SHARED_PATH];
    triangle_mesh in, next;
    const char *name = strchr(file, '/') ? strrchr(file, '/') + 1 : file;
    if (!shared_file(path, file) || !read_mesh(&in, path))
        return;
    for (; finer > 0; --finer) {
        next = in_four(&in);
        triangle_mesh_free(&in);
        in = next;
    }
    try_mesh(name, &in, triangles, SIMPLIFY_NEAR);
    try_mesh(name, &in, triangles, SIMPLIFY_AROUND);
    triangle_mesh_free(&in);
}

int main(void)
{
    printf("%-47s out, most      off, most      back, most    missed  extra\n", "in % of the diagonal, of the pixels");
    try_model("data/meshes/rhino_60k.ply", 3000, 0);
    try_model("data/meshes/stanford_bunny.obj", 2000, 0);
    try_model("data/meshes/lucy_100k.ply", 4000, 0);
    try_model("data/meshes/stanford_bunny.obj", 2000, 2);
    printf("%d passed, %d failed, %d skipped\n", test_passed, test_failed, test_skipped);
    return test_failed > 0;
}
