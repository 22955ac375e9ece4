/* test_raster.c: layer 3: coverage against exact integers, meshes without cracks, depth, windows, culling, holes.
 *
 * The coverage reference is separate integer code. Views are chosen so that the snapped vertices are known: an
 * orthographic frame of 64 px at 1 m per pixel, in which every step of the transform is exact, and perspective views
 * with the documented rounding to 1/256 px. */
#include <math.h>
#include <string.h>

#include <lambent/raster.h>

#include "../laid_surface.h"
#include "../test.h"

void test_raster(void);

enum { FRAME = 64, WINDOW = 32, CAP = 96, PIXELS = 128 * 128 };
#define RANDOM_TRIANGLES tries(50000, 1000000)
#define CUTS             tries(300, 5000)
#define DEPTHS           tries(400, 5000)

/* One mesh in one instance, with scene and view. */
typedef struct stage {
    float positions[9 * CAP];
    lmb_mesh mesh;
    lmb_material material;
    lmb_instance instance;
    lmb_scene scene;
    lmb_view view;
    lmb_stats stats;
} stage;

static stage st;
static uint32_t depth_memory[2][PIXELS], id_memory[2][PIXELS];

static const lmb_instance plain_instance = {{{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}, 0, 0, 1, 0};

static void set_stage(uint32_t triangles)
{
    memset(&st.mesh, 0, sizeof st.mesh);
    st.mesh.positions = st.positions;
    st.mesh.vertex_count = 3 * triangles;
    st.mesh.triangle_count = triangles;
    memset(&st.material, 0, sizeof st.material);
    st.material.alpha = 1.0f;
    st.material.texture = -1;
    st.instance = plain_instance;
    memset(&st.scene, 0, sizeof st.scene);
    st.scene.meshes = &st.mesh;
    st.scene.materials = &st.material;
    st.scene.instances = &st.instance;
    st.scene.mesh_count = st.scene.material_count = st.scene.instance_count = 1;
    memset(&st.stats, 0, sizeof st.stats);
}

/* Eye at the origin along -Z; all numbers are powers of two. Orthographic: 1 m per pixel. */
static lmb_view axis_view(int32_t kind, int32_t side)
{
    lmb_view v = {.sample_x = 0};
    memset(&v, 0, sizeof v);
    v.right.x = v.up.y = v.back.z = 1.0f;
    v.kind = kind;
    v.half_width = v.half_height = kind == LMB_ORTHOGRAPHIC ? (float)side * 0.5f : 1.0f;
    v.near_m = 0.5f;
    v.far_m = 128.5f;
    v.frame_width = v.frame_height = side;
    return v;
}

/* A cleared window in memory 0 or 1; depth only if id_format is LMB_FORMAT_NONE. */
static lmb_target window_of(int which, int32_t depth_format, int32_t id_format, int32_t layout, const int32_t box[4])
{
    lmb_target t;
    memset(&t, 0, sizeof t);
    t.depth = surface_of(depth_format, layout, box[2], box[3], depth_memory[which]);
    lmb_surface_clear(&t.depth);
    if (id_format != LMB_FORMAT_NONE) {
        t.id = surface_of(id_format, layout, box[2], box[3], id_memory[which]);
        lmb_surface_clear(&t.id);
    }
    t.x0 = box[0];
    t.y0 = box[1];
    return t;
}

static size_t place(const lmb_surface *s, int32_t x, int32_t y)
{
    size_t step = (size_t)s->stride_bytes / (size_t)lmb_pixel_bytes(s->format);
    return s->layout == LMB_LINEAR ? (size_t)y * step + (size_t)x
                                   : (size_t)(y / 8) * step + (size_t)(x / 8 * 64 + y % 8 * 8 + x % 8);
}

static uint32_t id_at(const lmb_surface *s, int32_t x, int32_t y)
{
    size_t at = place(s, x, y);
    return s->format == LMB_ID16 ? ((const uint16_t *)s->data)[at] : ((const uint32_t *)s->data)[at];
}

static float depth_at(const lmb_surface *s, int32_t x, int32_t y) { return ((const float *)s->data)[place(s, x, y)]; }

static uint32_t code_at(const lmb_surface *s, int32_t x, int32_t y)
{
    return ((const uint16_t *)s->data)[place(s, x, y)];
}

static lmb_status draw(const lmb_target *t, uint32_t first, uint32_t count, uint32_t flags)
{
    return lmb_draw(t, picked_kernels(), &st.view, &st.scene, first, count, flags, &st.stats);
}

static int32_t random_between(test_rng *r, int32_t lo, int32_t hi)
{
    return lo + (int32_t)(test_random(r) % (uint32_t)(hi - lo + 1));
}

/* ---- coverage: single triangles, against integers ---- */

/* In 1/256 px from the frame's centre, y down. */
typedef struct grid_point {
    int64_t x, y;
} grid_point;

static int64_t cross_at(const grid_point *a, const grid_point *b, int64_t x, int64_t y)
{
    return (b->x - a->x) * (y - a->y) - (b->y - a->y) * (x - a->x);
}

/* With positive area in y-down coordinates, the inside is to the right of each edge. A left edge then goes up and a top
 * edge goes right; pixel centres on these two are inside. */
static int edge_takes(const grid_point *a, const grid_point *b, int64_t x, int64_t y)
{
    int64_t e = cross_at(a, b, x, y);
    return e > 0 || (e == 0 && (b->y < a->y || (b->y == a->y && b->x > a->x)));
}

static void orient(grid_point p[3])
{
    if (cross_at(&p[0], &p[1], p[2].x, p[2].y) < 0) {
        grid_point t = p[1];
        p[1] = p[2];
        p[2] = t;
    }
}

static int64_t centre(int32_t pixel) { return (int64_t)(pixel - FRAME / 2) * 256 + 128; }

/* First and last pixel of a span that may contain centres, within the window. */
static void pixel_span(int32_t *first, int32_t *last, int64_t a, int64_t b, int64_t c, int32_t from)
{
    int64_t lo = a < b ? a : b, hi = a > b ? a : b;
    lo = lo < c ? lo : c;
    hi = hi > c ? hi : c;
    *first = *last = from;
    while (*first < from + WINDOW && centre(*first) < lo) {
        ++*first;
    }
    *last = from + WINDOW - 1;
    while (*last >= from && centre(*last) > hi) {
        --*last;
    }
}

/* One row per window row: 1 if the triangle covers the pixel. */
static void cover_exactly(uint32_t out[WINDOW * WINDOW], const grid_point corner[3], int32_t x0, int32_t y0)
{
    grid_point p[3] = {corner[0], corner[1], corner[2]};
    int32_t left, right, top, bottom;
    memset(out, 0, sizeof(uint32_t) * WINDOW * WINDOW);
    orient(p);
    if (cross_at(&p[0], &p[1], p[2].x, p[2].y) == 0) {
        return;
    }
    pixel_span(&left, &right, p[0].x, p[1].x, p[2].x, x0);
    pixel_span(&top, &bottom, p[0].y, p[1].y, p[2].y, y0);
    for (int32_t y = top; y <= bottom; ++y) {
        for (int32_t x = left; x <= right; ++x) {
            int64_t cx = centre(x), cy = centre(y);
            out[(y - y0) * WINDOW + x - x0] = edge_takes(&p[0], &p[1], cx, cy) && edge_takes(&p[1], &p[2], cx, cy) &&
                                              edge_takes(&p[2], &p[0], cx, cy);
        }
    }
}

static void put_corner(int k, float x, float y, float z)
{
    st.positions[3 * k] = x;
    st.positions[3 * k + 1] = y;
    st.positions[3 * k + 2] = z;
}

/* One metre is one pixel: 24.8 is exact in float up to 2^16 px. */
static void put_grid_point(int k, grid_point p, float z)
{
    put_corner(k, (float)p.x / 256.0f, (float)-p.y / 256.0f, z);
}

static grid_point random_point(test_rng *r, int32_t reach_px, int32_t step)
{
    grid_point p;
    int32_t reach = reach_px * 256 / step, phase = step == 256 ? 128 : 0;
    p.x = (int64_t)random_between(r, -reach, reach) * step + phase;
    p.y = (int64_t)random_between(r, -reach, reach) * step + phase;
    return p;
}

/* On the line between two corners, or up to two steps off. */
static grid_point near_line(test_rng *r, const grid_point *a, const grid_point *b)
{
    int64_t t = random_between(r, -64, 128);
    grid_point p;
    p.x = a->x + (b->x - a->x) * t / 64 + random_between(r, -2, 2);
    p.y = a->y + (b->y - a->y) * t / 64 + random_between(r, -2, 2);
    return p;
}

static int is_within(int64_t v, int64_t reach) { return v >= -reach && v <= reach; }

static int is_within_guard(const grid_point *p) { return is_within(p->x, 16380 * 256) && is_within(p->y, 16380 * 256); }

enum { SMALL, CENTRES, HALVES, SLIVER, LARGE, HUGE_SPAN, HUGE_SLIVER, CENTRES_AFAR, KINDS };

static void random_triangle(grid_point p[3], test_rng *r, int kind)
{
    static const int32_t reach[KINDS] = {20, 34, 34, 40, 200, 16380, 16380, 4000};
    static const int32_t step[KINDS] = {1, 256, 128, 1, 1, 1, 1, 256};
    grid_point at = kind == SMALL ? random_point(r, 20, 1) : (grid_point){0, 0};
    for (int k = 0; k < 3; ++k) {
        p[k] = random_point(r, kind == SMALL ? random_between(r, 1, 20) : reach[kind], step[kind]);
        p[k].x += at.x;
        p[k].y += at.y;
    }
    if (kind == HUGE_SLIVER || kind == HUGE_SPAN) { /* must cross the window to be visible */
        p[1] = random_point(r, 30, 1);
    }
    if (kind == SLIVER || kind == HUGE_SLIVER) {
        do {
            p[2] = near_line(r, &p[0], &p[1]);
        } while (!is_within_guard(&p[2]));
    }
}

/* Perspective: snaps as the header documents, with the same binary32 operations. */
static grid_point random_projected(test_rng *r, int k)
{
    float w = test_uniform(r, 0.0f, 1.0f) < 0.5f ? test_uniform(r, 0.6f, 4.0f) : test_uniform(r, 1.0f, 100.0f);
    float x = test_uniform(r, -1.5f, 1.5f) * w, y = test_uniform(r, -1.5f, 1.5f) * w, inverse = 1.0f / w;
    grid_point p;
    put_corner(k, x, y, -w);
    p.x = (int64_t)floorf(x * inverse * (FRAME * 128.0f) + 0.5f);
    p.y = (int64_t)floorf(0.5f - y * inverse * (FRAME * 128.0f));
    return p;
}

static int equals_exactly(const lmb_target *t, const grid_point p[3])
{
    static uint32_t expected[WINDOW * WINDOW], rows[WINDOW * WINDOW];
    cover_exactly(expected, p, t->x0, t->y0);
    lmb_depth_linearize(rows, sizeof rows, &t->id);
    return memcmp(rows, expected, sizeof rows) == 0;
}

static void test_coverage(void)
{
    test_rng r = {2024};
    int wrong[KINDS + 1] = {0}, shown = 0;
    int64_t covered = 0;
    set_stage(1);
    for (int n = 0; n < RANDOM_TRIANGLES; ++n) {
        int kind = n % (KINDS + 2);
        const int32_t box[4] = {random_between(&r, 0, 4) * 8, random_between(&r, 0, 4) * 8, WINDOW, WINDOW};
        grid_point p[3];
        kind = kind > KINDS ? KINDS : kind;
        st.view = axis_view(kind == KINDS ? LMB_PERSPECTIVE : LMB_ORTHOGRAPHIC, FRAME);
        if (kind < KINDS) {
            random_triangle(p, &r, kind);
        }
        for (int k = 0; k < 3; ++k) {
            if (kind == KINDS) {
                p[k] = random_projected(&r, k);
            } else {
                put_grid_point(k, p[k], -2.0f - (float)k);
            }
        }
        lmb_target t = window_of(0, LMB_DEPTH32F, LMB_ID32, n / 16 % 2 ? LMB_TILED : LMB_LINEAR, box);
        st.stats.triangles_drawn = 0;
        draw(&t, 1, 1, 0);
        covered += st.stats.triangles_drawn;
        if (!equals_exactly(&t, p)) {
            ++wrong[kind];
            if (shown++ < 3) {
                printf("  triangle %d, kind %d: (%d %d) (%d %d) (%d %d)\n", n, kind, (int)p[0].x, (int)p[0].y,
                       (int)p[1].x, (int)p[1].y, (int)p[2].x, (int)p[2].y);
            }
        }
    }
    for (int kind = 0; kind <= KINDS; ++kind) {
        CHECK_MSG(wrong[kind] == 0, "kind %d: %d triangles differ", kind, wrong[kind]);
    }
    CHECK(st.stats.triangles == (uint32_t)RANDOM_TRIANGLES && st.stats.triangles_dropped == 0);
    CHECK(covered > RANDOM_TRIANGLES * 9 / 10);
}

/* ---- coverage of clipped triangles, except within the rounding of clipping from an edge ---- */

typedef struct plane_point {
    double x, y, w; /* px from the centre times w, y down; w in m */
} plane_point;

/* Position of a pixel relative to a triangle that may extend behind the eye. */
enum { OUTSIDE, INSIDE, TOO_CLOSE };

static void cross_lines(double l[3], const plane_point *a, const plane_point *b)
{
    l[0] = a->y * b->w - a->w * b->y;
    l[1] = a->w * b->x - a->x * b->w;
    l[2] = a->x * b->y - a->y * b->x;
}

/* Homogeneous edge functions l_i . c over the determinant are barycentrics; the sum of all three is 1 / w at the
 * pixel. */
static int where_is(const plane_point v[3], double x, double y, double slack_px)
{
    double near_line_px = -1.0 / (double)st.view.near_m, gx = 0, gy = 0;
    int all = 1;
    double l[3][3], det;
    for (int i = 0; i < 3; ++i) {
        cross_lines(l[i], &v[(i + 1) % 3], &v[(i + 2) % 3]);
    }
    det = l[0][0] * v[0].x + l[0][1] * v[0].y + l[0][2] * v[0].w;
    for (int i = 0; i < 3; ++i) {
        double e = (l[i][0] * x + l[i][1] * y + l[i][2]) / det, slope = hypot(l[i][0], l[i][1]) / fabs(det);
        if (!(fabs(e) > slack_px * slope)) {
            return TOO_CLOSE;
        }
        all &= e > 0;
        near_line_px += e;
        gx += l[i][0] / det;
        gy += l[i][1] / det;
    }
    if (st.view.kind == LMB_PERSPECTIVE && all && fabs(near_line_px) <= slack_px * hypot(gx, gy)) {
        return TOO_CLOSE;
    }
    return all && (st.view.kind == LMB_ORTHOGRAPHIC || near_line_px < 0) ? INSIDE : OUTSIDE;
}

static void project(plane_point v[3])
{
    const double scale = FRAME / 2;
    for (int k = 0; k < 3; ++k) {
        const float *p = st.positions + 3 * k;
        v[k].x = (double)p[0] / (double)st.view.half_width * scale;
        v[k].y = -(double)p[1] / (double)st.view.half_height * scale;
        v[k].w = st.view.kind == LMB_PERSPECTIVE ? -(double)p[2] : 1.0;
    }
}

/* Counts the pixels that are clearly inside or outside, and those of them drawn wrongly. */
static void judge_clipped(int32_t *clear, int32_t *wrong, double slack_px)
{
    const int32_t box[4] = {16, 16, WINDOW, WINDOW};
    plane_point v[3];
    lmb_target t = window_of(0, LMB_DEPTH32F, LMB_ID32, LMB_TILED, box);
    draw(&t, 1, 1, 0);
    project(v);
    for (int32_t y = 0; y < WINDOW; ++y) {
        for (int32_t x = 0; x < WINDOW; ++x) {
            int at = where_is(v, x + 16 + 0.5 - FRAME / 2, y + 16 + 0.5 - FRAME / 2, slack_px);
            *clear += at != TOO_CLOSE;
            *wrong += at != TOO_CLOSE && (at == INSIDE) != (id_at(&t.id, x, y) == 1);
        }
    }
}

/* Vertices within 8 m and a near plane of 0.25 m: a cut is off by under 2^-24 x 16 / 0.25 of 16384 px. */
static void test_near_plane(void)
{
    test_rng r = {5};
    int32_t clear = 0, wrong = 0;
    set_stage(1);
    st.view = axis_view(LMB_PERSPECTIVE, FRAME);
    st.view.near_m = 0.25f;
    for (int n = 0; n < CUTS; ++n) {
        for (int k = 0; k < 3; ++k) {
            put_corner(k, test_uniform(&r, -4, 4), test_uniform(&r, -4, 4), test_uniform(&r, -8, k ? 8.0f : -0.3f));
        }
        judge_clipped(&clear, &wrong, 0.07);
    }
    CHECK_MSG(wrong == 0, "%d of %d clear pixels", wrong, clear);
    CHECK(clear > CUTS * WINDOW * WINDOW * 9 / 10);
}

/* Up to 2^18 px away at 1 m per pixel: two cuts, each rounded to 2^-24 of 2^19, then the snap. */
static void test_guard_band(void)
{
    test_rng r = {6};
    int32_t clear = 0, wrong = 0;
    set_stage(1);
    st.view = axis_view(LMB_ORTHOGRAPHIC, FRAME);
    for (int n = 0; n < CUTS; ++n) {
        float reach = n % 2 ? 262144.0f : 40000.0f;
        for (int k = 0; k < 3; ++k) {
            float own = n % 3 == k ? 20.0f : reach;
            put_corner(k, test_uniform(&r, -own, own), test_uniform(&r, -own, own), -1.0f - (float)k);
        }
        judge_clipped(&clear, &wrong, 0.15);
    }
    CHECK_MSG(wrong == 0, "%d of %d clear pixels", wrong, clear);
    CHECK(clear > CUTS * WINDOW * WINDOW * 9 / 10);
}

/* ---- meshes: every pixel once ---- */

static uint8_t hits[FRAME * FRAME];

/* Draws each triangle by itself into a cleared target. */
static void count_hits(uint32_t triangles)
{
    const int32_t box[4] = {0, 0, FRAME, FRAME};
    memset(hits, 0, sizeof hits);
    for (uint32_t n = 1; n <= triangles; ++n) {
        lmb_target t = window_of(0, LMB_DEPTH32F, LMB_ID32, LMB_LINEAR, box);
        draw(&t, n, 1, 0);
        for (int i = 0; i < FRAME * FRAME; ++i) {
            hits[i] = (uint8_t)(hits[i] + (id_memory[0][i] == n));
        }
    }
}

typedef struct grid_triangle {
    grid_point p[3];
} grid_triangle;

static grid_triangle grid_mesh[CAP];

/* Returns a point strictly inside, or 0 if there is none. */
static int point_inside(grid_point *out, test_rng *r, const grid_triangle *t, int64_t step)
{
    int64_t a = random_between(r, 1, 98), b = random_between(r, 1, 99 - (int32_t)a), c = 100 - a - b;
    grid_point p[3] = {t->p[0], t->p[1], t->p[2]};
    orient(p);
    out->x = (a * p[0].x + b * p[1].x + c * p[2].x) / 100 / step * step + (step == 256 ? 128 : 0);
    out->y = (a * p[0].y + b * p[1].y + c * p[2].y) / 100 / step * step + (step == 256 ? 128 : 0);
    return cross_at(&p[0], &p[1], out->x, out->y) > 0 && cross_at(&p[1], &p[2], out->x, out->y) > 0 &&
           cross_at(&p[2], &p[0], out->x, out->y) > 0;
}

/* Two triangles form a rectangle; then random triangles are repeatedly split in three at an inner point. */
static int split_rectangle(test_rng *r, const int64_t box[4], int64_t step)
{
    grid_point a = {box[0], box[1]}, b = {box[2], box[1]}, c = {box[2], box[3]}, d = {box[0], box[3]};
    int count = 2;
    grid_mesh[0] = (grid_triangle){{a, b, c}};
    grid_mesh[1] = (grid_triangle){{a, c, d}};
    for (int tries = 0; tries < 60 && count + 2 <= CAP; ++tries) {
        grid_triangle *t = &grid_mesh[random_between(r, 0, count - 1)], whole = *t;
        grid_point p;
        if (point_inside(&p, r, &whole, step)) {
            *t = (grid_triangle){{whole.p[0], whole.p[1], p}};
            grid_mesh[count++] = (grid_triangle){{whole.p[1], whole.p[2], p}};
            grid_mesh[count++] = (grid_triangle){{p, whole.p[0], whole.p[2]}};
        }
    }
    return count;
}

static void put_grid_mesh(int count)
{
    for (int i = 0; i < 3 * count; ++i) {
        put_grid_point(i, grid_mesh[i / 3].p[i % 3], -3.0f);
    }
    set_stage((uint32_t)count);
    st.view = axis_view(LMB_ORTHOGRAPHIC, FRAME);
}

static int wrong_hits(const int64_t box[4])
{
    int wrong = 0;
    for (int i = 0; i < FRAME * FRAME; ++i) {
        int64_t x = centre(i % FRAME), y = centre(i / FRAME);
        wrong += hits[i] != (x >= box[0] && x < box[2] && y >= box[1] && y < box[3]);
    }
    return wrong;
}

/* Edges on, between and off pixel centres, in steps of 1/256 px, half pixels, and whole pixels. */
static void test_split_meshes(void)
{
    static const int64_t steps[3] = {1, 128, 256};
    test_rng r = {7};
    int wrong = 0;
    for (int n = 0; n < tries(48, 300); ++n) {
        int64_t box[4];
        for (int k = 0; k < 4; ++k) {
            int64_t at = random_between(&r, 4, 28) * 256 + (n % 2 ? 128 : random_between(&r, 0, 255));
            box[k] = k < 2 ? -at : at;
        }
        int count = split_rectangle(&r, box, steps[n % 3]);
        put_grid_mesh(count);
        count_hits((uint32_t)count);
        wrong += wrong_hits(box);
    }
    CHECK_MSG(wrong == 0, "%d pixels not hit once", wrong);
}

/* The rectangle and the splits extend past the guard band: neighbours must be clipped alike. */
static void test_split_afar(void)
{
    test_rng r = {8};
    int wrong = 0;
    for (int n = 0; n < tries(30, 200); ++n) {
        int64_t far_px = n % 2 ? 20000 : 65000, box[4] = {-far_px * 256, -far_px * 256, far_px * 256, far_px * 256};
        int count = split_rectangle(&r, box, 1);
        put_grid_mesh(count);
        count_hits((uint32_t)count);
        wrong += wrong_hits(box);
    }
    CHECK_MSG(wrong == 0, "%d pixels not hit once", wrong);
}

enum { CELLS = 6, SPOKES = 12 };
#define GROUND_HALF 15.0f

/* A jittered grid on the ground, 1 m below the eye, in front of and behind it. */
static void put_ground(test_rng *r)
{
    static float at[CELLS + 1][CELLS + 1][2];
    int v = 0;
    for (int j = 0; j <= CELLS; ++j) {
        for (int i = 0; i <= CELLS; ++i) {
            float jitter = i % CELLS && j % CELLS ? 0.2f : 0.0f, cell = 2.0f * GROUND_HALF / CELLS;
            at[j][i][0] = -GROUND_HALF + cell * ((float)i + test_uniform(r, -jitter, jitter));
            at[j][i][1] = -GROUND_HALF + cell * ((float)j + test_uniform(r, -jitter, jitter));
        }
    }
    for (int n = 0; n < CELLS * CELLS; ++n) {
        static const int corner[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
        for (int k = 0; k < 6; ++k, ++v) {
            const float *p = at[n / CELLS + corner[k][1]][n % CELLS + corner[k][0]];
            put_corner(v, p[0], -1.0f, p[1]);
        }
    }
}

/* Intersection of the pixel's ray with the ground: -1 far from the mesh, 1 well inside, 0 close to a border. */
static int ground_at(int32_t x, int32_t y)
{
    const lmb_view *v = &st.view;
    double sx = (x + 0.5 - FRAME / 2) / (FRAME / 2) * (double)v->half_width;
    double sy = -(y + 0.5 - FRAME / 2) / (FRAME / 2) * (double)v->half_height;
    double dx = (double)v->right.x * sx + (double)v->up.x * sy - (double)v->back.x;
    double dy = (double)v->right.y * sx + (double)v->up.y * sy - (double)v->back.y;
    double dz = (double)v->right.z * sx + (double)v->up.z * sy - (double)v->back.z;
    double w = dy < 0 ? -1.0 / dy : 1e9, reach = fmax(fabs(dx * w), fabs(dz * w));
    return reach > (double)GROUND_HALF * 1.1 ? -1 : reach < (double)GROUND_HALF * 0.9;
}

static void test_ground(void)
{
    test_rng r = {9};
    int holes = 0, doubles = 0, extra = 0, seen = 0;
    for (int n = 0; n < tries(30, 300); ++n) {
        lmb_vec3 eye = {0, 0, 0}, up = {0, 1, 0};
        lmb_vec3 target = {test_uniform(&r, -1, 1), test_uniform(&r, -0.8f, 0.2f), test_uniform(&r, -1, 1)};
        put_ground(&r);
        set_stage(2 * CELLS * CELLS);
        lmb_view_look_at(&st.view, eye, target, up, test_uniform(&r, 0.5f, 2.0f), FRAME, FRAME);
        st.view.near_m = 0.001f;
        count_hits(2 * CELLS * CELLS);
        for (int i = 0; i < FRAME * FRAME; ++i) {
            int at = ground_at(i % FRAME, i / FRAME);
            holes += at > 0 && hits[i] == 0;
            doubles += hits[i] > 1;
            extra += at < 0 && hits[i] > 0;
            seen += at > 0;
        }
    }
    CHECK_MSG(holes == 0 && doubles == 0 && extra == 0, "%d holes, %d twice, %d outside", holes, doubles, extra);
    CHECK(seen > 30 * FRAME * FRAME / 4);
}

/* A fan around a visible corner, with a rim about `radius` away in the plane of the first two axes. Two triangles share
 * each spoke in opposite directions. */
static void put_fan(test_rng *r, float x, float y, float radius, int on_ground)
{
    float rim[SPOKES][2];
    for (int k = 0; k < SPOKES; ++k) {
        float angle = ((float)k + test_uniform(r, 0.1f, 0.9f)) * (6.2831853f / SPOKES);
        float away = test_uniform(r, 1, 2) * radius;
        rim[k][0] = x + away * cosf(angle);
        rim[k][1] = y + away * sinf(angle);
    }
    for (int k = 0; k < SPOKES; ++k) {
        const float middle[2] = {x, y}, *corner[3] = {middle, rim[k], rim[(k + 1) % SPOKES]};
        for (int c = 0; c < 3; ++c) {
            float second = corner[c][1];
            put_corner(3 * k + c, corner[c][0], on_ground ? -1.0f : second, on_ground ? second : -3.0f);
        }
    }
    set_stage(SPOKES);
}

/* Every spoke is clipped far outside: if the two sides were rounded differently, a pixel centre would be missed or hit
 * twice. */
static void test_fans(void)
{
    test_rng r = {17};
    int wrong = 0;
    for (int n = 0; n < tries(60, 600); ++n) {
        put_fan(&r, test_uniform(&r, -20, 20), test_uniform(&r, -20, 20), n % 2 ? 20000.0f : 100000.0f, 0);
        st.view = axis_view(LMB_ORTHOGRAPHIC, FRAME);
        count_hits(SPOKES);
        for (int i = 0; i < FRAME * FRAME; ++i) {
            wrong += hits[i] != 1;
        }
    }
    CHECK_MSG(wrong == 0, "%d pixels not hit once", wrong);
}

/* The same on the ground; the near plane clips the spokes that extend behind the eye. */
static void test_ground_fans(void)
{
    test_rng r = {18};
    int wrong = 0, seen = 0;
    for (int n = 0; n < tries(60, 600); ++n) {
        lmb_vec3 eye = {0, 0, 0}, up = {0, 1, 0}, target = {test_uniform(&r, -1, 1), -0.6f, -1.5f};
        put_fan(&r, test_uniform(&r, -2, 2), test_uniform(&r, -4, -2), n % 2 ? 40.0f : 1000.0f, 1);
        lmb_view_look_at(&st.view, eye, target, up, 1.2f, FRAME, FRAME);
        st.view.near_m = n % 3 ? 0.1f : 0.001f;
        count_hits(SPOKES);
        for (int i = 0; i < FRAME * FRAME; ++i) {
            int at = ground_at(i % FRAME, i / FRAME);
            wrong += hits[i] > 1 || (at > 0 && hits[i] == 0);
            seen += at > 0;
        }
    }
    CHECK_MSG(wrong == 0, "%d pixels not hit once", wrong);
    CHECK(seen > 60 * FRAME * FRAME / 4);
}

/* ---- depth ---- */

/* Snapped corners, px from the centre, with the depth of the header's formula in binary32. */
typedef struct depth_plane {
    double x[3], y[3], d[3], dx, dy, lo, hi;
} depth_plane;

static double solve_plane(depth_plane *p)
{
    double bx = p->x[1] - p->x[0], by = p->y[1] - p->y[0], cx = p->x[2] - p->x[0], cy = p->y[2] - p->y[0];
    double det = bx * cy - by * cx, bd = p->d[1] - p->d[0], cd = p->d[2] - p->d[0];
    p->dx = (bd * cy - cd * by) / det;
    p->dy = (cd * bx - bd * cx) / det;
    p->lo = fmin(p->d[0], fmin(p->d[1], p->d[2]));
    p->hi = fmax(p->d[0], fmax(p->d[1], p->d[2]));
    return det;
}

/* Half of them have corners on pixel centres, so that rounding could leave the corners' depth range. */
static void random_depth_triangle(depth_plane *p, test_rng *r, int perspective)
{
    int32_t step = test_random(r) & 1 ? 256 : 1;
    for (int k = 0; k < 3; ++k) {
        grid_point g = random_point(r, 30, step);
        float w = test_uniform(r, 0.6f, 100.0f), d = (128.5f - w) * (1.0f / 128.0f);
        if (perspective) {
            g = random_projected(r, k);
            w = -st.positions[3 * k + 2];
            d = 0.5f * (1.0f / w);
        } else {
            put_grid_point(k, g, -w);
        }
        p->x[k] = (double)g.x / 256.0;
        p->y[k] = (double)g.y / 256.0;
        p->d[k] = (double)d;
    }
}

/* The plane steps in binary32 from the value at a tile's first pixel, up to 7 px either way. With s the sum of the
 * slopes, this value and the two sums round numbers under hi + 7 s, slopes and products round 7 s: 3 hi + 35 s half
 * ulps. */
static double depth_slack(const depth_plane *p)
{
    return ldexp(3.0 * p->hi + 35.0 * (fabs(p->dx) + fabs(p->dy)), -24);
}

typedef struct depth_count {
    int64_t pixels, plane, range, gentle_worst;
} depth_count;

static void judge_depth(depth_count *n, const lmb_target *t, const depth_plane *p)
{
    for (int32_t y = 0; y < FRAME; ++y) {
        for (int32_t x = 0; x < FRAME; ++x) {
            if (id_at(&t->id, x, y)) {
                double d = (double)depth_at(&t->depth, x, y);
                double cx = x + 0.5 - FRAME / 2, cy = y + 0.5 - FRAME / 2;
                double plane = p->d[0] + p->dx * (cx - p->x[0]) + p->dy * (cy - p->y[0]);
                double clamped = fmin(fmax(plane, p->lo), p->hi);
                ++n->pixels;
                n->range += d < p->lo || d > p->hi;
                n->plane += fabs(d - clamped) > depth_slack(p);
                if (8.0 * (fabs(p->dx) + fabs(p->dy)) < p->hi - p->lo) { /* in ulps of the nearest corner */
                    n->gentle_worst += fabs(d - clamped) > ldexp(p->hi, -23) * 4.0;
                }
            }
        }
    }
}

static void test_depth_plane(void)
{
    const int32_t box[4] = {0, 0, FRAME, FRAME};
    test_rng r = {10};
    for (int perspective = 0; perspective < 2; ++perspective) {
        depth_count n = {0, 0, 0, 0};
        set_stage(1);
        st.view = axis_view(perspective ? LMB_PERSPECTIVE : LMB_ORTHOGRAPHIC, FRAME);
        for (int i = 0; i < DEPTHS; ++i) {
            depth_plane p;
            random_depth_triangle(&p, &r, perspective);
            if (solve_plane(&p) != 0) {
                lmb_target t = window_of(0, LMB_DEPTH32F, LMB_ID32, LMB_TILED, box);
                draw(&t, 1, 1, 0);
                judge_depth(&n, &t, &p);
            }
        }
        CHECK_MSG(n.plane == 0, "%d of %d off the plane", (int)n.plane, (int)n.pixels);
        CHECK_MSG(n.range == 0, "%d of %d outside the corners' depths", (int)n.range, (int)n.pixels);
        CHECK_MSG(n.gentle_worst == 0, "%d of %d over 4 ulp", (int)n.gentle_worst, (int)n.pixels);
        CHECK(n.pixels > 20 * DEPTHS);
    }
}

/* A rectangle of the frame at distance w. */
static void put_wall(int first_corner, float left, float right, float w)
{
    const float x[6] = {left, right, right, left, right, left}, y[6] = {-40, -40, 40, -40, 40, 40};
    for (int k = 0; k < 6; ++k) {
        put_corner(first_corner + k, x[k], y[k], -w);
    }
}

static int all_ids(const lmb_target *t, uint32_t lo, uint32_t hi)
{
    int good = 1;
    for (int i = 0; i < FRAME * FRAME; ++i) {
        uint32_t id = id_at(&t->id, i % FRAME, i / FRAME);
        good &= id >= lo && id <= hi;
    }
    return good;
}

static void test_depth_order(void)
{
    const int32_t box[4] = {0, 0, FRAME, FRAME};
    for (int variant = 0; variant < 4; ++variant) {
        int32_t format = variant & 1 ? LMB_DEPTH16 : LMB_DEPTH32F;
        put_wall(0, -40, 40, 9.0f);
        put_wall(6, -40, 40, 3.0f);
        put_wall(12, -40, 40, 3.0f);
        set_stage(6);
        st.view = axis_view(variant & 2 ? LMB_PERSPECTIVE : LMB_ORTHOGRAPHIC, FRAME);
        lmb_target t = window_of(0, format, LMB_ID32, LMB_TILED, box);
        draw(&t, 1, 6, 0);
        CHECK(all_ids(&t, 3, 4)); /* nearer wins; at equal depth the first stays */
        draw(&t, 1, 2, 0);
        CHECK(all_ids(&t, 3, 4)); /* the farther one comes last */
        t = window_of(0, format, LMB_ID32, LMB_TILED, box);
        draw(&t, 5, 2, 0);
        draw(&t, 3, 2, 0);
        CHECK(all_ids(&t, 5, 6)); /* the first drawn stays, not the lower id */
    }
}

static void random_soup(test_rng *r, uint32_t triangles, float span, float far_w)
{
    for (uint32_t k = 0; k < 3 * triangles; ++k) {
        put_corner((int)k, test_uniform(r, -span, span), test_uniform(r, -span, span), test_uniform(r, -far_w, -0.6f));
    }
    set_stage(triangles);
}

/* 16-bit codes follow the header's formula of the float depth, so the order is the same except for equal codes. */
static void test_depth16(void)
{
    const int32_t box[4] = {0, 0, FRAME, FRAME};
    test_rng r = {11};
    for (int variant = 0; variant < tries(8, 40); ++variant) {
        int perspective = variant & 1, off = 0, none = 0;
        double far_d, worst = 0;
        random_soup(&r, 40, 30.0f, 60.0f);
        st.view = axis_view(perspective ? LMB_PERSPECTIVE : LMB_ORTHOGRAPHIC, FRAME);
        far_d = perspective ? (double)st.view.near_m / (double)st.view.far_m : 0.0;
        lmb_target t32 = window_of(0, LMB_DEPTH32F, LMB_ID32, LMB_TILED, box);
        lmb_target t16 = window_of(1, LMB_DEPTH16, LMB_ID16, variant & 2 ? LMB_TILED : LMB_LINEAR, box);
        draw(&t32, 1, 40, 0);
        draw(&t16, 1, 40, 0);
        for (int i = 0; i < FRAME * FRAME; ++i) {
            double d = (double)depth_at(&t32.depth, i % FRAME, i / FRAME);
            double code = code_at(&t16.depth, i % FRAME, i / FRAME);
            double exact = 1.0 + 65534.0 * (d - far_d) / (1.0 - far_d);
            none += (d == 0.0) != (code == 0.0);
            off += d > 0.0 && !(fabs(code - exact) <= 1.01);
            worst = d > 0.0 ? fmax(worst, fabs(code - exact)) : worst;
        }
        CHECK_MSG(none == 0 && off == 0, "%d nothing, %d off by up to %g codes", none, off, worst);
    }
}

static void test_view_z(void)
{
    lmb_view p = axis_view(LMB_PERSPECTIVE, FRAME), o = axis_view(LMB_ORTHOGRAPHIC, FRAME);
    double worst_p = 0, worst_o = 0;
    for (float w = 0.5f; w < 128.0f; w *= 1.01f) {
        worst_p = fmax(worst_p, fabs((double)(lmb_depth_view_z(&p, 0.5f / w) / w) - 1.0));
        worst_o = fmax(worst_o, fabs((double)lmb_depth_view_z(&o, (128.5f - w) / 128.0f) - (double)w));
    }
    CHECK_MSG(worst_p < 2.4e-7, "%g", worst_p);
    CHECK_MSG(worst_o < 128 * 1.2e-7, "%g", worst_o);
    CHECK(lmb_depth_view_z(&p, 0.0f) == 0.0f && lmb_depth_view_z(NULL, 0.5f) == 0.0f);
}

/* lmb_depth_view_z of a drawn pixel is the distance of the wall. */
static void test_wall_z(void)
{
    const int32_t box[4] = {0, 0, FRAME, FRAME};
    for (int perspective = 0; perspective < 2; ++perspective) {
        put_wall(0, -40, 40, 7.0f);
        set_stage(2);
        st.view = axis_view(perspective ? LMB_PERSPECTIVE : LMB_ORTHOGRAPHIC, FRAME);
        lmb_target t = window_of(0, LMB_DEPTH32F, LMB_ID32, LMB_LINEAR, box);
        draw(&t, 1, 2, 0);
        for (int i = 0; i < FRAME; i += 7) {
            double z = (double)lmb_depth_view_z(&st.view, depth_at(&t.depth, i, FRAME - 1 - i));
            CHECK_MSG(fabs(z - 7.0) < 2e-5, "%g", z);
        }
    }
}

/* ---- windows, layouts, formats, ranges ---- */

enum { WIDE = 104, TALL = 77 };

static void set_wide_view(int perspective)
{
    lmb_vec3 eye = {0.3f, 0.1f, 1.0f}, target = {0, 0, -5}, up = {0, 1, 0};
    lmb_view_look_at(&st.view, eye, target, up, 1.1f, WIDE, TALL);
    if (!perspective) {
        st.view.kind = LMB_ORTHOGRAPHIC;
        st.view.half_width = 14.0f;
        st.view.half_height = 10.0f;
    }
    st.view.near_m = 1.8f; /* the near plane cuts some */
    st.view.far_m = 80.0f;
}

static int window_differs(const lmb_target *whole, const lmb_target *t)
{
    int wrong = 0;
    for (int32_t y = 0; y < t->depth.height && y + t->y0 < TALL; ++y) {
        for (int32_t x = 0; x < t->depth.width && x + t->x0 < WIDE; ++x) {
            int32_t fx = x + t->x0, fy = y + t->y0;
            wrong += t->depth.format == LMB_DEPTH16
                         ? code_at(&whole->depth, fx, fy) != code_at(&t->depth, x, y)
                         : memcmp((const float *)whole->depth.data + place(&whole->depth, fx, fy),
                                  (const float *)t->depth.data + place(&t->depth, x, y), 4) != 0;
            wrong += t->id.data != NULL && id_at(&whole->id, fx, fy) != id_at(&t->id, x, y);
        }
    }
    return wrong;
}

/* Tiles the frame with windows of one size. */
static int tiling_differs(const lmb_target *whole, int32_t id_format, int32_t layout, int32_t width, int32_t height)
{
    int wrong = 0;
    int32_t step_x = (width + 7) / 8 * 8, step_y = (height + 7) / 8 * 8;
    for (int32_t y = 0; y < TALL; y += step_y) {
        for (int32_t x = 0; x < WIDE; x += step_x) {
            int32_t right = WIDE + 7 - x, bottom = TALL + 7 - y;
            const int32_t box[4] = {x, y, width < right ? width : right, height < bottom ? height : bottom};
            lmb_target t = window_of(1, whole->depth.format, id_format, layout, box);
            wrong += draw(&t, 1, 60, LMB_CULL_BACK) != LMB_OK;
            wrong += window_differs(whole, &t);
        }
    }
    return wrong;
}

static void test_windows(void)
{
    static const int32_t sizes[][2] = {{8, 8}, {16, 24}, {40, 8}, {104, 8}, {64, 64}, {13, 9}, {104, 77}, {48, 77}};
    static const int32_t ids[3] = {LMB_ID32, LMB_ID16, LMB_FORMAT_NONE};
    const int32_t all[4] = {0, 0, WIDE, TALL};
    test_rng r = {12};
    for (int variant = 0; variant < 4; ++variant) {
        random_soup(&r, 60, 9.0f, 12.0f);
        set_wide_view(variant & 1);
        lmb_target whole = window_of(0, variant & 2 ? LMB_DEPTH16 : LMB_DEPTH32F, LMB_ID32, LMB_TILED, all);
        CHECK(draw(&whole, 1, 60, LMB_CULL_BACK) == LMB_OK);
        for (size_t s = 0; s < sizeof sizes / sizeof *sizes; ++s) {
            for (int kind = 0; kind < 6; ++kind) {
                int wrong = tiling_differs(&whole, ids[kind % 3], kind / 3, sizes[s][0], sizes[s][1]);
                CHECK_MSG(wrong == 0, "%d x %d windows, id kind %d, layout %d: %d differ", (int)sizes[s][0],
                          (int)sizes[s][1], kind % 3, kind / 3, wrong);
            }
        }
    }
}

/* Half of the triangles cover a few pixels, so they are filled in batches. */
static void mixed_soup(test_rng *r, uint32_t triangles, float far_w)
{
    random_soup(r, triangles, 9.0f, far_w);
    for (uint32_t k = 0; k < triangles; k += 2) {
        float *p = st.positions + 9 * k;
        for (int i = 3; i < 9; ++i) {
            p[i] = p[i % 3] + test_uniform(r, -0.06f, 0.06f) * far_w;
        }
    }
}

/* Tiled codes without ids, which have a separate code path, against linear codes with ids; *seen: visible pixels. */
static int codes_differ(const lmb_kernels *kernels, const lmb_kernels *plain, int32_t x, int32_t *seen)
{
    const int32_t box[4] = {x, 8, WIDE - x - 3, TALL - 8};
    lmb_target a = window_of(0, LMB_DEPTH16, LMB_ID32, LMB_LINEAR, box),
               b = window_of(1, LMB_DEPTH16, LMB_FORMAT_NONE, LMB_TILED, box);
    int wrong = lmb_draw(&a, plain, &st.view, &st.scene, 1, 96, 0, NULL) != LMB_OK;
    wrong += lmb_draw(&b, kernels, &st.view, &st.scene, 1, 96, 0, NULL) != LMB_OK;
    for (int32_t i = 0; i < box[2] * box[3]; ++i) {
        const uint32_t code = code_at(&a.depth, i % box[2], i / box[2]);
        wrong += code != code_at(&b.depth, i % box[2], i / box[2]);
        *seen += code != 0;
    }
    return wrong;
}

/* Rows of tiles that are far apart, as in surfaces larger than caches: the same pixels. */
static void test_distant_rows(void)
{
    enum { ROW = (1 << 20) / 64 * 64, ROWS = (TALL + 7) / 8 };
    static const int32_t formats[3][2] = {{LMB_DEPTH32F, LMB_FORMAT_NONE}, {LMB_DEPTH32F, LMB_ID32},
                                          {LMB_DEPTH16, LMB_FORMAT_NONE}};
    const int32_t all[4] = {0, 0, WIDE, TALL};
    void *memory[2] = {calloc(ROWS, ROW), calloc(ROWS, ROW)}; /* most pages are never touched */
    test_rng r = {17};
    for (int32_t i = 0; lmb_kernels_at(i) != NULL; ++i) {
        for (int k = 0; k < 3; ++k) {
            random_soup(&r, CAP, 5.0f, 12.0f);
            for (int at = 0; at < 9 * CAP; at += 9) { /* all so small that a batch draws them together */
                for (int c = 3; c < 9; ++c) {
                    st.positions[at + c] = st.positions[at + c % 3] + test_uniform(&r, -0.6f, 0.6f);
                }
            }
            set_wide_view(k == 0);
            lmb_target near = window_of(0, formats[k][0], formats[k][1], LMB_TILED, all), far = near;
            far.depth.data = memory[0];
            far.id.data = near.id.data != NULL ? memory[1] : NULL;
            far.depth.stride_bytes = far.id.stride_bytes = ROW;
            lmb_surface_clear(&far.depth);
            lmb_surface_clear(&far.id);
            CHECK(lmb_draw(&near, lmb_kernels_at(i), &st.view, &st.scene, 1, CAP, 0, NULL) == LMB_OK);
            CHECK(lmb_draw(&far, lmb_kernels_at(i), &st.view, &st.scene, 1, CAP, 0, NULL) == LMB_OK);
            CHECK_MSG(window_differs(&near, &far) == 0, "%s, formats %d", lmb_kernels_name(lmb_kernels_at(i)), k);
        }
    }
    free(memory[0]);
    free(memory[1]);
}

/* A wall on the near plane has depth 1, so its code must be 65535 even if scale and bias round up to 65536. */
static void test_code_of_one(const lmb_kernels *kernels, const lmb_kernels *plain, float far_m)
{
    static const float wall[] = {-90, -90, -1.8f, 90, -90, -1.8f, 0, 180, -1.8f};
    const lmb_vec3 eye = {0, 0, 0}, target = {0, 0, -1}, up = {0, 1, 0};
    int32_t seen = 0;
    for (int i = 0; i < 9; ++i) {
        st.positions[i] = wall[i];
    }
    lmb_view_look_at(&st.view, eye, target, up, 1.1f, WIDE, TALL);
    st.view.near_m = 1.8f;
    st.view.far_m = far_m;
    CHECK(codes_differ(kernels, plain, 0, &seen) == 0);
    CHECK_MSG(seen == (WIDE - 3) * (TALL - 8), "%s, far %g: %d", lmb_kernels_name(kernels), (double)far_m, (int)seen);
}

/* If no depth lies between near and far, scale and bias are not numbers, and all codes must be 0. */
static void test_codes_of_nothing(const lmb_kernels *kernels, const lmb_kernels *plain)
{
    const float far_m[] = {INFINITY, nextafterf(1.1e-30f, 1.0f)};
    for (int i = 0; i < 2; ++i) {
        int32_t seen = 0;
        set_wide_view(0);
        st.view.near_m = i ? 1.1e-30f : 1.8f;
        st.view.far_m = far_m[i];
        CHECK(codes_differ(kernels, plain, 0, &seen) == 0);
    }
}

/* If far is barely beyond near, codes of 1 round up to 65536. In orthographic views, surfaces beyond far have negative
 * codes. */
static void test_codes(void)
{
    static const float far_m[] = {1.8000002f, 1.800002f, 1.80003f, 1.801f, 1.9f, 3.5999f, 3.6f, 3.7f, 11.0f, 80.0f, 1e6f, 3e38f};
    const lmb_kernels *plain = lmb_kernels_named("scalar");
    test_rng r = {15};
    for (int32_t i = 0; lmb_kernels_at(i) != NULL; ++i) {
        int32_t seen = 0;
        for (size_t k = 0; k < 4 * sizeof far_m / sizeof *far_m; ++k) {
            mixed_soup(&r, 96, fminf(far_m[k / 4] - 0.79f, 12.0f));
            set_wide_view(k & 1);
            st.view.far_m = far_m[k / 4];
            const int wrong = codes_differ(lmb_kernels_at(i), plain, k & 2 ? 16 : 0, &seen);
            CHECK_MSG(wrong == 0, "%s, far %g, perspective %d: %d differ", lmb_kernels_name(lmb_kernels_at(i)),
                      (double)st.view.far_m, (int)(k & 1), wrong);
        }
        CHECK_MSG(seen > 30000, "%d", (int)seen);
        test_codes_of_nothing(lmb_kernels_at(i), plain);
        test_code_of_one(lmb_kernels_at(i), plain, 1.801f);
        test_code_of_one(lmb_kernels_at(i), plain, 11.0f);
    }
}

/* Ids in order, in ranges of any size, also past the end. */
static void test_ranges(void)
{
    const int32_t all[4] = {0, 0, WIDE, TALL};
    test_rng r = {13};
    for (int n = 0; n < tries(6, 40); ++n) {
        static lmb_instance parts[4];
        random_soup(&r, 60, 9.0f, 12.0f);
        set_wide_view(n & 1);
        for (uint32_t i = 0; i < 4; ++i) { /* four copies of the mesh, some mirrored */
            parts[i] = plain_instance;
            parts[i].to_world.m[0] = i & 1 ? -1.0f : 1.0f;
            parts[i].to_world.m[5] = i & 2 ? -1.0f : 1.0f;
            parts[i].first_id = 1 + 60 * i;
        }
        st.scene.instances = parts;
        st.scene.instance_count = 4;
        lmb_target whole = window_of(0, LMB_DEPTH32F, LMB_ID32, LMB_TILED, all);
        lmb_target t = window_of(1, LMB_DEPTH32F, LMB_ID32, LMB_TILED, all);
        draw(&whole, 1, UINT32_MAX, LMB_CULL_BACK);
        CHECK(st.stats.triangles == 240);
        for (uint32_t first = 1; first <= 240;) {
            uint32_t count = (uint32_t)random_between(&r, 1, n < tries(2, 20) ? 7 : 100);
            draw(&t, first, count, LMB_CULL_BACK);
            first += count;
        }
        CHECK(st.stats.triangles == 480);
        CHECK(window_differs(&whole, &t) == 0);
    }
    lmb_target t = window_of(1, LMB_DEPTH32F, LMB_ID32, LMB_TILED, all);
    CHECK(draw(&t, 241, 10, 0) == LMB_OK && draw(&t, 1, 0, 0) == LMB_OK && all_ids(&t, 0, 0));
}

/* ---- culling ---- */

/* A counter-clockwise triangle over the centre; turned: seen from behind. */
static uint32_t seen_with(uint32_t material_flags, uint32_t draw_flags, int turned, int mirrored)
{
    const int32_t box[4] = {0, 0, FRAME, FRAME};
    float x = turned ? -9.0f : 9.0f;
    put_corner(0, -x, -9, -3);
    put_corner(1, x, -9, -3);
    put_corner(2, 0, 9, -3);
    set_stage(1);
    st.material.flags = material_flags;
    st.instance.to_world.m[mirrored == 2 ? 5 : 0] = mirrored ? -1.0f : 1.0f;
    lmb_target t = window_of(0, LMB_DEPTH32F, LMB_ID32, LMB_TILED, box);
    draw(&t, 1, 1, draw_flags);
    return id_at(&t.id, FRAME / 2, FRAME / 2);
}

/* A mirroring transform flips the winding, not the front side (glTF 2.0, 3.7.4). A mirrored front face seen from the
 * front therefore stays a front face. */
static void test_culling(void)
{
    for (int i = 0; i < 12; ++i) {
        int turned = i & 1, mirrored = (i >> 1) % 3;
        st.view = axis_view(i < 6 ? LMB_ORTHOGRAPHIC : LMB_PERSPECTIVE, FRAME);
        st.view.half_width = st.view.half_height = 16.0f;
        CHECK(seen_with(0, LMB_CULL_BACK, turned, mirrored) == (turned ? 0u : 1u));
        CHECK(seen_with(LMB_DOUBLE_SIDED, LMB_CULL_BACK, turned, mirrored) == 1);
        CHECK(seen_with(0, 0, turned, mirrored) == 1);
    }
}

/* ---- bad input ---- */

static void put_neighbours(void)
{
    for (int k = 0; k < 8; ++k) {
        float x = -32.0f + 8.0f * (float)k;
        put_corner(3 * k, x, -30, -3);
        put_corner(3 * k + 1, x + 7.5f, -30, -3);
        put_corner(3 * k + 2, x, 30, -3);
    }
    set_stage(8);
    st.view = axis_view(LMB_ORTHOGRAPHIC, FRAME);
}

/* Bad triangles are dropped and counted; the pixels of the others do not change. */
static void check_bad(uint32_t dropped, const char *what)
{
    const int32_t box[4] = {0, 0, FRAME, FRAME};
    lmb_target t = window_of(1, LMB_DEPTH32F, LMB_ID32, LMB_TILED, box);
    CHECK_MSG(draw(&t, 1, 8, 0) == LMB_OK, "%s", what);
    CHECK_MSG(st.stats.triangles == 8 && st.stats.triangles_dropped == dropped, "%s: %u dropped", what,
              (unsigned)st.stats.triangles_dropped);
    int wrong = 0;
    for (int i = 0; i < FRAME * FRAME; ++i) {
        uint32_t good = id_memory[0][i];
        wrong += id_memory[1][i] != (good == 3 ? 0 : good);
        wrong += good != 3 && depth_memory[1][i] != depth_memory[0][i];
    }
    CHECK_MSG(wrong == 0, "%s: %d pixels", what, wrong);
}

static void test_bad_vertices(void)
{
    const int32_t box[4] = {0, 0, FRAME, FRAME};
    const struct { /* not static: tcc rejects NAN as a constant */
        float value;
        const char *name;
    } bad[] = {{NAN, "nan"},    {INFINITY, "infinity"}, {-INFINITY, "-infinity"},
               {1e30f, "1e30"}, {-3e38f, "-3e38"},     {1048576.0f, "2^20"}};
    for (size_t n = 0; n < sizeof bad / sizeof *bad; ++n) {
        for (int axis = 0; axis < 3; ++axis) {
            put_neighbours();
            lmb_target t = window_of(0, LMB_DEPTH32F, LMB_ID32, LMB_TILED, box);
            draw(&t, 1, 8, 0);
            put_neighbours();
            st.positions[3 * 7 + axis] = bad[n].value;
            check_bad(1, bad[n].name);
        }
    }
    put_neighbours();
    memcpy(st.positions + 3 * 7, st.positions + 3 * 6, 3 * sizeof(float));
    check_bad(0, "no area");
}

static void test_bad_indices(void)
{
    static uint32_t wide[24];
    static uint32_t narrow_memory[12];
    uint16_t *narrow = (uint16_t *)(void *)narrow_memory;
    static const uint32_t bad[] = {24, 25, 65535, 0x7fffffffu, 0xffffffffu};
    for (size_t n = 0; n < 2 * sizeof bad / sizeof *bad; ++n) {
        put_neighbours();
        for (uint32_t k = 0; k < 24; ++k) {
            wide[k] = k == 7 ? bad[n / 2] : k;
            narrow[k] = (uint16_t)wide[k];
        }
        st.mesh.indices = n % 2 ? (const void *)wide : narrow;
        st.mesh.index_format = n % 2 ? LMB_INDEX_U32 : LMB_INDEX_U16;
        check_bad(1, "index");
    }
}

static void test_bad_arguments(void)
{
    const int32_t box[4] = {0, 0, FRAME, FRAME};
    put_neighbours();
    const lmb_kernels *k = picked_kernels();
    lmb_target t = window_of(0, LMB_DEPTH32F, LMB_ID32, LMB_TILED, box);
    CHECK(lmb_draw(NULL, k, &st.view, &st.scene, 1, 8, 0, NULL) == LMB_ERR_ARG);
    CHECK(lmb_draw(&t, NULL, &st.view, &st.scene, 1, 8, 0, NULL) == LMB_ERR_ARG);
    CHECK(lmb_draw(&t, k, NULL, &st.scene, 1, 8, 0, NULL) == LMB_ERR_ARG);
    CHECK(lmb_draw(&t, k, &st.view, NULL, 1, 8, 0, NULL) == LMB_ERR_ARG);
    CHECK(all_ids(&t, 0, 0));
    CHECK(lmb_draw(&t, k, &st.view, &st.scene, 1, 8, 0, NULL) == LMB_OK); /* no stats */
}

/* Memory around and in the target holds a pattern; a refused draw changes none of it. */
static void check_refused(lmb_target *t, lmb_status expected, const char *what)
{
    memset(depth_memory[0], 0xa5, sizeof depth_memory[0]);
    memset(id_memory[0], 0xa5, sizeof id_memory[0]);
    lmb_status status = draw(t, 1, 8, 0);
    size_t touched = 0;
    for (size_t i = 0; i < PIXELS; ++i) {
        touched += depth_memory[0][i] != 0xa5a5a5a5u || id_memory[0][i] != 0xa5a5a5a5u;
    }
    CHECK_MSG(status == expected, "%s: %s", what, lmb_status_name(status));
    CHECK_MSG(touched == 0, "%s: %d values written", what, (int)touched);
}

static void test_bad_targets(void)
{
    const int32_t box[4] = {8, 8, 32, 32};
    put_neighbours();
    const lmb_target good = window_of(0, LMB_DEPTH32F, LMB_ID32, LMB_TILED, box);
    lmb_target t = good;
#define REFUSED(change, status) \
    do { \
        t = good; \
        change; \
        check_refused(&t, status, #change); \
    } while (0)
    REFUSED(t.depth.data = NULL, LMB_ERR_ARG);
    REFUSED(t.x0 = 4, LMB_ERR_ARG);
    REFUSED(t.y0 = 12, LMB_ERR_ARG);
    REFUSED(t.x0 = -8, LMB_ERR_ARG);
    REFUSED(t.x0 = 40, LMB_ERR_ARG);
    REFUSED(t.y0 = 48, LMB_ERR_ARG);
    REFUSED(t.depth.format = LMB_RGBA8, LMB_ERR_FORMAT);
    REFUSED(t.depth.format = LMB_ID32, LMB_ERR_FORMAT);
    REFUSED(t.id.format = LMB_DEPTH32F, LMB_ERR_FORMAT);
    REFUSED(t.id.format = LMB_RGB565, LMB_ERR_FORMAT);
    REFUSED(t.id.width = 24, LMB_ERR_ARG);
    REFUSED(t.id.height = 40, LMB_ERR_ARG);
    REFUSED(t.depth.width = t.id.width = 2147483647, LMB_ERR_ARG);
    REFUSED(t.x0 = 2147483640, LMB_ERR_ARG);
    REFUSED(t.depth.stride_bytes = 1 << 29, LMB_ERR_ARG); /* eight of these rows overflow 32 bits */
    REFUSED(t.id.stride_bytes = 1 << 29, LMB_ERR_ARG);
    REFUSED(t.id.format = LMB_ID16; st.mesh.triangle_count = 65536, LMB_ERR_CAPACITY);
    st.mesh.triangle_count = 8;
    REFUSED(t.depth.format = LMB_DEPTH16; st.view.far_m = 0.1f, LMB_ERR_ARG); /* orthographic views also need far */
    st.view = axis_view(LMB_PERSPECTIVE, FRAME);
    REFUSED(t.depth.format = LMB_DEPTH16; st.view.far_m = 0.1f, LMB_ERR_FORMAT);
    REFUSED(t.depth.format = LMB_DEPTH16; st.view.far_m = NAN, LMB_ERR_FORMAT);
#undef REFUSED
}

static void test_bad_views(void)
{
    const int32_t box[4] = {8, 8, 32, 32};
    put_neighbours();
    const lmb_view good = st.view;
    lmb_target t = window_of(0, LMB_DEPTH32F, LMB_ID32, LMB_TILED, box);
#define REFUSED(change) \
    do { \
        st.view = good; \
        change; \
        check_refused(&t, LMB_ERR_ARG, #change); \
    } while (0)
    REFUSED(st.view.half_width = 0.0f);
    REFUSED(st.view.half_height = -1.0f);
    REFUSED(st.view.half_width = NAN);
    REFUSED(st.view.half_width = 1e-39f); /* 1 / half_width is infinite */
    REFUSED(st.view.near_m = 1e-39f);
    REFUSED(st.view.near_m = 0.0f);
    REFUSED(st.view.near_m = NAN);
    REFUSED(st.view.far_m = st.view.near_m);
    REFUSED(st.view.frame_width = 0);
    REFUSED(st.view.frame_height = LMB_MAX_FRAME + 1);
    REFUSED(st.view.kind = 2);
#undef REFUSED
}

/* A window that ends inside a tile stays within its surface's memory. */
static void test_canaries(void)
{
    test_rng r = {14};
    for (int n = 0; n < 24; ++n) {
        int32_t formats[2] = {n & 1 ? LMB_DEPTH16 : LMB_DEPTH32F, n & 2 ? LMB_ID16 : LMB_ID32};
        const int32_t size[2] = {random_between(&r, 1, 104), random_between(&r, 1, 77)};
        uint8_t *depth = (uint8_t *)depth_memory[1] + 64, *id = (uint8_t *)id_memory[1] + 64;
        size_t bytes[2];
        bytes[0] = lmb_surface_bytes(formats[0], size[0], size[1]);
        bytes[1] = lmb_surface_bytes(formats[1], size[0], size[1]);
        lmb_target t;
        random_soup(&r, 60, 30.0f, 12.0f);
        set_wide_view(n & 4);
        memset(depth_memory[1], 0xa5, sizeof depth_memory[1]);
        memset(id_memory[1], 0xa5, sizeof id_memory[1]);
        memset(&t, 0, sizeof t);
        t.depth = surface_of(formats[0], n & 8 ? LMB_TILED : LMB_LINEAR, size[0], size[1], depth);
        t.id = surface_of(formats[1], n & 8 ? LMB_TILED : LMB_LINEAR, size[0], size[1], id);
        lmb_surface_clear(&t.depth);
        lmb_surface_clear(&t.id);
        CHECK(draw(&t, 1, 60, 0) == LMB_OK);
        int touched = 0;
        for (int i = 0; i < 64; ++i) {
            touched += depth[-1 - i] != 0xa5 || id[-1 - i] != 0xa5 || depth[bytes[0] + (size_t)i] != 0xa5 ||
                       id[bytes[1] + (size_t)i] != 0xa5;
        }
        CHECK_MSG(touched == 0, "%d x %d", (int)size[0], (int)size[1]);
    }
}

/* Each row was or could have been a bug. The near plane cuts a triangle far from its corners: the remaining w is only
 * rounding, and the vertex must still land on the guard band. Pixels off the edges carry the id exactly if the exact
 * triangle covers them. */
static void test_hard_cuts(void)
{
    static const struct {
        float near_m;
        float p[9];
    } rows[] = {
        {0.01f, {0, 0, -1e5f, 0.1f, 0.1f, -0.005f, 0.2f, -0.1f, -0.005f}},
        {0.01f, {50, 0, -1e5f, 0.5f, 0.5f, -0.002f, -0.5f, 0.5f, -0.002f}},
        {0.01f, {0, 0, -1e6f, 0.1f, 0.1f, -0.005f, 0.2f, -0.1f, -0.005f}}, /* rounding gives w = 0: no guard flag */
        {0.01f, {3e5f, 1e5f, -1e6f, 0.01f, 0.003f, -0.005f, -0.02f, 0.01f, -0.005f}}, /* loses x instead */
        {0.01f, {0, 0, -1e6f, 0.3f, 0.1f, -0.005f, 3.0f, -1.0f, -0.005f}},
        {1e-5f, {0, 0, -1000, 0, 0, 1000, 5, 5, -10}}, /* an edge through the eye: w = x = y = 0 */
        {1e-5f, {0, 0, -1000, 0, 0, 1000, -5, 5, -10}},
        {1e-5f, {0, 0, -1000, 0, 0, 1000, 5, -5, -10}},
        {1e-5f, {0, 0, -1000, 0, 0, 1000, -5, -5, -10}},
        {1e-5f, {5, 5, -10, 0, 0, -1000, 0, 0, 1000}},
        {1e-5f, {0, -3, -1000, 0, 3, 1000, 5, 5, -10}},
        {1e-4f, {3, 0, -1e6f, 1e6f, 0, 1e6f, 0, 1e6f, 1e6f}},
        {1e-6f, {1, 1, -1e6f, -1, -1, 1e6f, 0.001f, 0, 0}},
    };
    const int32_t box[4] = {0, 0, FRAME, FRAME};
    for (size_t n = 0; n < sizeof rows / sizeof *rows; ++n) {
        memcpy(st.positions, rows[n].p, sizeof rows[n].p);
        set_stage(1);
        st.view = axis_view(LMB_PERSPECTIVE, FRAME);
        st.view.near_m = rows[n].near_m;
        lmb_target t = window_of(0, LMB_DEPTH32F, LMB_ID32, LMB_TILED, box);
        CHECK(draw(&t, 1, 1, 0) == LMB_OK);
        int bad = 0, wrong = 0;
        plane_point v[3];
        project(v);
        for (int i = 0; i < FRAME * FRAME; ++i) {
            float d = depth_at(&t.depth, i % FRAME, i / FRAME);
            int at = where_is(v, i % FRAME + 0.5 - FRAME / 2, i / FRAME + 0.5 - FRAME / 2, 0.5);
            bad += !(d >= 0.0f && d <= 1.0f);
            wrong += at != TOO_CLOSE && (at == INSIDE) != (id_at(&t.id, i % FRAME, i / FRAME) == 1);
        }
        CHECK_MSG(bad == 0 && wrong == 0, "row %d: %d depths outside 0 .. 1, %d pixels wrong", (int)n, bad, wrong);
    }
}

/* ---- alpha masks ---- */

/* 4 x 4 blocks of texels, so that some tiles lie inside one. */
enum { BLOCK = 32, MASK = 4 * BLOCK };

static uint32_t mask_memory[MASK * MASK];
static float mask_uvs[6 * CAP];
static lmb_texture mask_texture;

static void set_mask(test_rng *r, uint32_t triangles)
{
    uint8_t *texel = (uint8_t *)mask_memory;
    for (int i = 0; i < 16; ++i) {
        const uint8_t alpha = (uint8_t)(test_random(r) & 1 ? 255 : 0);
        for (int k = 0; k < BLOCK * BLOCK; ++k) {
            texel[4 * ((i / 4 * BLOCK + k / BLOCK) * MASK + i % 4 * BLOCK + k % BLOCK) + 3] = alpha;
        }
    }
    for (uint32_t i = 0; i < 6 * triangles; ++i) {
        mask_uvs[i] = test_uniform(r, -1.0f, 2.0f);
    }
    memset(&mask_texture, 0, sizeof mask_texture);
    mask_texture.texels = texel;
    mask_texture.width = mask_texture.height = MASK;
    mask_texture.levels = 1;
    st.mesh.uvs = mask_uvs;
    st.scene.textures = &mask_texture;
    st.scene.texture_count = 1;
    st.material.texture = 0;
    st.material.alpha_cutoff = 0.5f;
}

/* 1 opaque, 0 a hole, -1 within rounding of a texel border. */
static int texel_at(double u, double v)
{
    double x = (u - floor(u)) * 4.0, y = (v - floor(v)) * 4.0;
    if (fabs(x - floor(x + 0.5)) < 1e-3 || fabs(y - floor(y + 0.5)) < 1e-3) {
        return -1;
    }
    return ((const uint8_t *)mask_memory)[4 * BLOCK * ((int)y * MASK + (int)x) + 3] == 255;
}

typedef struct mask_count {
    int wrong, holes, solid;
} mask_count;

/* The uvs are attributes of the unmasked draw, which test_textures checks against rays in double. */
static void judge_mask(mask_count *n, const lmb_target *unmasked, const lmb_target *masked)
{
    static lmb_tile tile;
    for (int32_t at = 0; at < FRAME / 8 * (FRAME / 8); ++at) {
        int32_t x0 = at % 8 * 8, y0 = at / 8 * 8;
        lmb_resolve_tile(&tile, picked_kernels(), &st.view, &st.scene, unmasked, x0, y0);
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            uint32_t id = id_at(&masked->id, x0 + k % 8, y0 + k / 8);
            float d = depth_at(&masked->depth, x0 + k % 8, y0 + k / 8);
            int opaque = tile.id[k] ? texel_at((double)tile.uv[0][k], (double)tile.uv[1][k]) : 0;
            if (opaque >= 0) {
                n->wrong += id != (opaque ? tile.id[k] : 0);
                n->wrong += d != (opaque ? depth_at(&unmasked->depth, x0 + k % 8, y0 + k / 8) : 0.0f);
                n->holes += tile.id[k] && !opaque;
                n->solid += opaque;
            }
        }
    }
}

static void test_masks(void)
{
    const int32_t box[4] = {0, 0, FRAME, FRAME};
    test_rng r = {15};
    mask_count n = {0, 0, 0};
    for (int i = 0; i < tries(40, 200); ++i) {
        random_soup(&r, 1, i & 1 ? 3.0f : 30.0f, i & 1 ? 4.0f : 60.0f);
        if (i % 8 == 5) { /* a floor close below the eye: its horizon is less than half a pixel above a tile */
            const float fall = test_uniform(&r, 0.2f, 0.48f) * 2.0f / (float)FRAME, z = test_uniform(&r, -0.9f, -0.6f);
            const float floor_at[9] = {-60, -0.3f + fall * z, z, 60, -0.3f + fall * z, z, 0, -0.3f - 120 * fall, -120};
            memcpy(st.positions, floor_at, sizeof floor_at);
        }
        st.view = axis_view(i & 1 ? LMB_PERSPECTIVE : LMB_ORTHOGRAPHIC, FRAME);
        set_mask(&r, 1);
        lmb_target unmasked = window_of(0, LMB_DEPTH32F, LMB_ID32, LMB_TILED, box);
        draw(&unmasked, 1, 1, 0);
        st.material.flags = LMB_ALPHA_MASK;
        int32_t id_format = i & 2 ? LMB_ID16 : LMB_ID32;
        lmb_target masked = window_of(1, LMB_DEPTH32F, id_format, i & 4 ? LMB_TILED : LMB_LINEAR, box);
        draw(&masked, 1, 1, 0);
        judge_mask(&n, &unmasked, &masked);
    }
    CHECK_MSG(n.wrong == 0, "%d wrong, %d holes, %d solid", n.wrong, n.holes, n.solid);
    CHECK(n.holes > 2000 && n.solid > 2000);
}

/* Masked, in layers: windows, formats and splits give the same picture, and an opaque mask changes nothing. Every
 * triangle is drawn twice: at equal depths the first stays. Samples are off the pixel centre in most cases. */
static void test_mask_layers(void)
{
    const int32_t box[4] = {0, 0, WIDE, TALL};
    test_rng r = {16};
    for (int i = 0; i < 6; ++i) {
        random_soup(&r, 60, 9.0f, 12.0f);
        memcpy(st.positions + 9 * 30, st.positions, 9 * 30 * sizeof *st.positions);
        set_wide_view(i & 1);
        st.view.sample_x = LMB_MULTISAMPLE ? 48 * (i % 3) : 0;
        st.view.sample_y = LMB_MULTISAMPLE ? -112 * (i % 2) : 0;
        set_mask(&r, 60);
        st.material.flags = LMB_ALPHA_MASK;
        lmb_target whole = window_of(0, i & 2 ? LMB_DEPTH16 : LMB_DEPTH32F, LMB_ID32, LMB_TILED, box);
        draw(&whole, 1, 60, LMB_CULL_BACK);
        CHECK(tiling_differs(&whole, LMB_ID16, LMB_LINEAR, 24, 16) == 0);
        CHECK(tiling_differs(&whole, LMB_FORMAT_NONE, LMB_TILED, 8, 8) == 0);
        st.material.alpha_cutoff = 0.0f;
        whole = window_of(0, i & 2 ? LMB_DEPTH16 : LMB_DEPTH32F, LMB_ID32, LMB_TILED, box);
        draw(&whole, 1, 60, LMB_CULL_BACK);
        st.material.flags = 0;
        CHECK(tiling_differs(&whole, LMB_ID32, LMB_TILED, 104, 77) == 0);
    }
}

void test_raster(void)
{
    test_coverage();
    test_near_plane();
    test_guard_band();
    test_split_meshes();
    test_split_afar();
    test_ground();
    test_fans();
    test_ground_fans();
    test_depth_plane();
    test_depth_order();
    test_depth16();
    test_view_z();
    test_wall_z();
    test_windows();
    test_codes();
    test_distant_rows();
    test_ranges();
    test_culling();
    test_bad_vertices();
    test_bad_indices();
    test_bad_arguments();
    test_bad_targets();
    test_bad_views();
    test_canaries();
    test_hard_cuts();
    test_masks();
    test_mask_layers();
}
