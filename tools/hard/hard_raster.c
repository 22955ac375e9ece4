/* hard_raster.c: hard cases of coverage and depth; the references are integers of 64 and 128 bits. */
#include <math.h>
#include <string.h>

#include "hard.h"
#include "hard_wide.h"

/* A corner in the flat view: 1/256 px from the frame's middle, y down; depth in 2^-23. */
typedef struct flat_corner {
    int64_t x, y, d;
} flat_corner;

enum { SIDE = HARD_SIDE, HALF = SIDE / 2 };

static dvec flat_place(const flat_corner *c)
{
    return dvec_of((double)c->x / 256.0, -(double)c->y / 256.0, -2.0 + (double)c->d / 8388608.0);
}

static void put_flat(hard_stage *s, const flat_corner c[3])
{
    hard_triangle(s, flat_place(&c[0]), flat_place(&c[1]), flat_place(&c[2]));
}

static int64_t area_of(const flat_corner c[3])
{
    return (c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[2].x - c[0].x) * (c[1].y - c[0].y);
}

/* The top-left rule by definition: a pixel on an edge belongs to the triangle for which it is a left or top edge. */
static int covers(const flat_corner c[3], int64_t x, int64_t y)
{
    const int64_t turn = area_of(c) > 0 ? 1 : -1;
    for (int i = 0; i < 3; ++i) {
        const flat_corner *a = &c[i], *b = &c[(i + 1) % 3];
        const int64_t ex = (a->y - b->y) * turn, ey = (b->x - a->x) * turn; /* increases to the right; downwards */
        const int64_t e = ex * (x - a->x) + ey * (y - a->y);
        if (e < 0 || (e == 0 && !(ex > 0 || (ex == 0 && ey > 0)))) {
            return 0;
        }
    }
    return area_of(c) != 0;
}

static int64_t centre(int32_t pixel) { return ((int64_t)pixel - HALF) * 256 + 128; }

/* --- meshes: each pixel once -------------------------------------------------------------------------------------- */

static uint8_t hits[SIDE * SIDE];

static void count_hits(hard_stage *s)
{
    memset(hits, 0, sizeof hits);
    for (uint32_t t = 0; t < s->count; ++t) {
        hard_draw(s, t, 1);
        for (int32_t i = 0; i < SIDE * SIDE; ++i) {
            hits[i] = (uint8_t)(hits[i] + (s->id[hard_at(s, i % SIDE, i / SIDE)] != 0));
        }
    }
}

/* The number of pixels not covered exactly once. */
static double not_once(void)
{
    int wrong = 0;
    for (int i = 0; i < SIDE * SIDE; ++i) {
        wrong += hits[i] != 1;
    }
    return wrong;
}

enum { LATTICE = 20 };

/* Corners and edges through pixel centres: a lattice of n x n corners, `step` px apart, each moved by up to one px in
 * half px; about every other square is divided by the other diagonal. Returns the number of pixels not covered exactly
 * once. */
static double off_centres(hard_stage *s, int n, int64_t step, uint64_t seed)
{
    flat_corner at[LATTICE][LATTICE];
    uint64_t rng = seed;
    for (int i = 0; i < n * n; ++i) {
        flat_corner *c = &at[i / n][i % n];
        c->x = (i % n - n / 2) * step * 256 + 128 + 128 * ((int64_t)(hard_random(&rng) % 5) - 2);
        c->y = (i / n - n / 2) * step * 256 + 128 + 128 * ((int64_t)(hard_random(&rng) % 5) - 2);
        c->d = 4194304;
    }
    hard_begin(s, 1.0);
    for (int i = 0; i < (n - 1) * (n - 1); ++i) {
        const int x = i % (n - 1), y = i / (n - 1), turned = (int)(hard_random(&rng) & 1u);
        const flat_corner q[4] = {at[y][x], at[y + 1][x], at[y + 1][x + 1], at[y][x + 1]};
        const flat_corner one[3] = {q[0], q[1], q[turned ? 3 : 2]}, other[3] = {q[turned], q[2], q[3]};
        put_flat(s, one);
        put_flat(s, other);
    }
    hard_end(s);
    hard_look_flat(s, SIDE);
    count_hits(s);
    return not_once();
}

/* Small triangles, and triangles over 64 px, which the library draws by another path. */
static void through_centres(hard_list *l)
{
    double large = 0.0;
    for (uint64_t i = 0; i < 60; ++i) {
        large += off_centres(l->stage, 4, 70 + (int64_t)i, i);
    }
    const double fine = off_centres(l->stage, LATTICE, 4, 1);
    hard_put(l, HARD_EXACT, "shared edges through pixel centres: not taken once", fine, 0, "px");
    hard_put(l, HARD_EXACT, "of triangles over 64 px: not taken once", large, 0, "px");
}

/* One long edge through pixel centres on one side, `n` short ones on the other, with corners exactly on it or as near
 * as the grid allows. */
static void put_t_junctions(hard_stage *s, uint64_t *rng, int n, int exactly)
{
    const flat_corner a = {-6144, -6144, 4194304}, b = {6144, 6144, 4194304}, c = {6144, -6144, 4194304},
                      d = {-6144, 6144, 4194304};
    const flat_corner lower[3] = {a, d, b};
    flat_corner last = a;
    hard_begin(s, 1.0);
    put_flat(s, lower);
    for (int i = 1; i <= n; ++i) {
        flat_corner next = b;
        if (i < n) {
            const double t = exactly ? (double)(i * (4096 / n)) / 4096.0 : (i + hard_uniform(rng, -0.3, 0.3)) / n;
            next.x = (int64_t)floor(-6144.0 + 12288.0 * t + 0.5);
            next.y = (int64_t)floor(-6144.0 + 12288.0 * t + (exactly ? 0.5 : hard_uniform(rng, 0.0, 1.0)));
        }
        const flat_corner part[3] = {c, last, next};
        put_flat(s, part);
        last = next;
    }
    hard_end(s);
}

/* The number of pixels in both triangles together not covered exactly once; *far_px: their maximum distance from the
 * edge. */
static double edge_faults(double *far_px)
{
    int wrong = 0;
    *far_px = 0.0;
    for (int32_t i = 0; i < SIDE * SIDE; ++i) {
        const int64_t x = centre(i % SIDE), y = centre(i / SIDE);
        if (x > -6144 && x < 6144 && y > -6144 && y < 6144 && hits[i] != 1) {
            ++wrong;
            *far_px = fmax(*far_px, fabs((double)(x - y)) / sqrt(2.0) / 256.0);
        }
    }
    return wrong;
}

static void t_junctions(hard_list *l)
{
    hard_stage *s = l->stage;
    uint64_t rng = 2;
    double far_px, max = 0.0, faults = 0.0;
    put_t_junctions(s, &rng, 16, 1);
    hard_look_flat(s, SIDE);
    count_hits(s);
    hard_put(l, HARD_EXACT, "T-junctions on the edge: not taken once", edge_faults(&far_px), 0, "px");
    for (int i = 0; i < 20; ++i) {
        put_t_junctions(s, &rng, 16, 0);
        count_hits(s);
        faults += edge_faults(&far_px);
        max = fmax(max, far_px);
    }
    /* The diagonal of 1/256 px. */
    hard_put(l, HARD_BOUNDED, "T-junctions beside it: fault off the edge", faults > 0.0 ? max : HUGE_VAL,
             sqrt(2.0) / 256.0, "px");
}

/* 2^20 triangles of 1/4 x 1/8 px: a mesh of 4096 placed 256 times. Each centre lies on a corner of the lattice, which
 * the rule assigns to one of six triangles. */
static double wrong_specks(const hard_stage *s)
{
    int wrong = 0;
    for (int32_t i = 0; i < SIDE * SIDE; ++i) {
        const int32_t x = i % SIDE, y = i / SIDE;
        const uint32_t id = s->id[hard_at(s, x, y)];
        const uint32_t block = (id - 1) / 4096, cell = (id - 1) % 4096 / 2, upper = (id - 1) & 1u;
        const int64_t cx = ((int64_t)(block % 16) * 4 - HALF) * 256 + (int64_t)(cell % 32) * 32,
                      cy = ((int64_t)(block / 16) * 4 - HALF) * 256 + (int64_t)(cell / 32) * 16;
        const flat_corner a = {cx, cy, 0}, b = {cx, cy + 16, 0}, c = {cx + 32, cy + 16, 0}, d = {cx + 32, cy, 0};
        const flat_corner t[3] = {a, upper ? c : b, upper ? d : c};
        wrong += id == 0 || !covers(t, centre(x), centre(y));
    }
    return wrong;
}

static void million_specks(hard_list *l)
{
    static lmb_instance place[256];
    hard_stage *s = l->stage;
    hard_begin(s, 1.0);
    for (int i = 0; i < 2048; ++i) {
        const int64_t x = i % 32 * 32, y = i / 32 * 16;
        const flat_corner one[3] = {{x, y, 4194304}, {x, y + 16, 4194304}, {x + 32, y + 16, 4194304}},
                          other[3] = {{x, y, 4194304}, {x + 32, y + 16, 4194304}, {x + 32, y, 4194304}};
        put_flat(s, one);
        put_flat(s, other);
    }
    hard_end(s);
    for (uint32_t i = 0; i < 256; ++i) {
        place[i] = s->instance[0];
        place[i].to_world.m[12] = (float)((int)(i % 16) * 4 - HALF);
        place[i].to_world.m[13] = -(float)((int)(i / 16) * 4 - HALF);
        place[i].first_id = 1 + 4096 * i;
    }
    s->scene.instances = place;
    s->scene.instance_count = 256;
    hard_look_flat(s, SIDE);
    hard_draw(s, 0, UINT32_MAX);
    hard_put(l, HARD_EXACT, "a million triangles of 1/32 px2: another than the rule's", wrong_specks(s), 0, "px");
}

/* --- slivers ------------------------------------------------------------------------------------------------------ */

static flat_corner random_corner(uint64_t *rng)
{
    flat_corner c;
    c.x = (int64_t)(hard_random(rng) % 24576) - 12288;
    c.y = (int64_t)(hard_random(rng) % 24576) - 12288;
    c.d = 8192 + (int64_t)(hard_random(rng) % 8380000);
    return c;
}

/* Up to 135 px long, with the third corner 1 to 4 sub-pixels off the line of the others. */
static void make_sliver(flat_corner c[3], uint64_t *rng)
{
    c[0] = random_corner(rng);
    c[1] = random_corner(rng);
    c[2] = random_corner(rng);
    const double t = hard_uniform(rng, 0.05, 0.95);
    c[2].x = (int64_t)floor((double)c[0].x + t * (double)(c[1].x - c[0].x)) + (int64_t)(hard_random(rng) % 4);
    c[2].y = (int64_t)floor((double)c[0].y + t * (double)(c[1].y - c[0].y)) + (int64_t)(hard_random(rng) % 4);
}

/* The error of a drawn depth against the plane through the corners, as a share of the error that binary32 explains:
 * 2^-24 of 7, and of 35 times the slope per px (derived in tests/reference/accuracy.c). The numerator is exact: 128
 * bits. */
static double depth_error(const flat_corner c[3], int64_t x, int64_t y, float drawn)
{
    const int64_t area = area_of(c), bx = c[1].x - c[0].x, by = c[1].y - c[0].y, cx = c[2].x - c[0].x,
                  cy = c[2].y - c[0].y, bd = c[1].d - c[0].d, cd = c[2].d - c[0].d;
    const int64_t dx = bd * cy - cd * by, dy = cd * bx - bd * cx;
    const int64_t d = (int64_t)ldexp((double)drawn, 40);
    const double slope = (fabs((double)dx) + fabs((double)dy)) * 256.0 / fabs((double)area) / 8388608.0;
    hard_wide n = {0, 0};
    hard_wide_multiply_add(&n, d, area); /* in 2^-40; the rest is in 2^-23 */
    hard_wide_multiply_add(&n, -c[0].d * 131072, area);
    hard_wide_multiply_add(&n, -dx * 131072, x - c[0].x);
    hard_wide_multiply_add(&n, -dy * 131072, y - c[0].y);
    return fabs(hard_wide_to_double(n) / (double)area) * ldexp(1.0, -40) / ldexp(7.0 + 35.0 * slope, -24);
}

typedef struct sliver_count {
    double pixels, wrong, outside, worst;
} sliver_count;

static void judge_sliver(sliver_count *n, const hard_stage *s, const flat_corner c[3])
{
    const double low = (double)(c[0].d < c[1].d ? c[0].d : c[1].d), high = (double)(c[0].d > c[1].d ? c[0].d : c[1].d);
    const double min = fmin(low, (double)c[2].d) / 8388608.0, max = fmax(high, (double)c[2].d) / 8388608.0;
    for (int32_t i = 0; i < SIDE * SIDE; ++i) {
        const int32_t x = i % SIDE, y = i / SIDE;
        const int drawn = s->id[hard_at(s, x, y)] != 0;
        n->wrong += drawn != covers(c, centre(x), centre(y));
        if (drawn) {
            const float d = hard_depth(s, x, y);
            n->outside += (double)d < min || (double)d > max;
            n->worst = fmax(n->worst, depth_error(c, centre(x), centre(y), d));
            ++n->pixels;
        }
    }
}

static void slivers(hard_list *l)
{
    hard_stage *s = l->stage;
    sliver_count n = {0, 0, 0, 0};
    uint64_t rng = 3;
    hard_look_flat(s, SIDE);
    for (int i = 0; i < 2500; ++i) {
        flat_corner c[3];
        make_sliver(c, &rng);
        hard_begin(s, 1.0);
        put_flat(s, c);
        hard_end(s);
        hard_draw(s, 0, 1);
        judge_sliver(&n, s, c);
    }
    hard_put(l, HARD_EXACT, "slivers down to 1/256 px: wrong coverage, of 64-bit integers'",
             n.pixels > 200 ? n.wrong : HUGE_VAL, 0, "px");
    hard_put(l, HARD_EXACT, "their depth outside their corners'", n.outside, 0, "px");
    hard_put(l, HARD_BOUNDED, "their plane against 128-bit integers", n.worst, 1, "of the bound");
}

/* --- depth order -------------------------------------------------------------------------------------------------- */

/* Pairs of walls at random distances, with the nearer drawn last or first. Returns the largest gap, in units of
 * `quantum` of the distance, at which the order is lost. */
static double lost_gap(hard_stage *s, int32_t format, uint64_t seed)
{
    double max = 0.0;
    uint64_t rng = seed;
    hard_look(s, dvec_of(0, 0, 0), dvec_of(0, 0, -1), 60.0, 8);
    s->view.near_m = 0.125f;
    s->view.far_m = 1024.0f;
    lmb_surface_init(&s->eye.depth, format, 8, 8, s->depth, sizeof s->depth);
    for (int i = 0; i < 4000; ++i) {
        const double w = (double)(float)(0.125 * pow(2.0, hard_uniform(&rng, 0.1, 13.0)));
        const double quantum = format == LMB_DEPTH16 ? w * w / 0.125 / 65534.0 : w / 8388608.0;
        const double gap = quantum * pow(2.0, hard_uniform(&rng, -3.0, 3.0)), far = (double)(float)(w + gap);
        const int nearer = (int)(hard_random(&rng) & 1u); /* which is drawn first */
        hard_begin(s, 1.0);
        for (int k = 0; k < 2; ++k) {
            const double z = k == nearer ? w : far;
            hard_triangle(s, dvec_of(-8 * z, -8 * z, -z), dvec_of(8 * z, -8 * z, -z), dvec_of(0, 8 * z, -z));
        }
        hard_end(s);
        hard_draw(s, 0, 2);
        if (far > w && s->id[hard_at(s, 4, 4)] != (uint32_t)nearer + 1) {
            max = fmax(max, (far - w) / quantum);
        }
    }
    lmb_surface_init(&s->eye.depth, LMB_DEPTH32F, 8, 8, s->depth, sizeof s->depth);
    return max;
}

static void depth_order(hard_list *l)
{
    hard_put(l, HARD_BOUNDED, "random pairs of walls, float depth: order lost at", lost_gap(l->stage, LMB_DEPTH32F, 4),
             3, "x 2^-23");
    hard_put(l, HARD_BOUNDED, "the same, 16-bit depth", lost_gap(l->stage, LMB_DEPTH16, 5), 1.01, "steps");
}

/* A slanted square of exact corners; `turn` selects the diagonal. */
static void put_slanted(hard_stage *s, int turn)
{
    const flat_corner q[4] = {
        {-6000, -6000, 1000003}, {-6000, 6001, 4000002}, {6001, 6001, 7000019}, {6001, -6000, 4000020}};
    const flat_corner one[3] = {q[0], q[1], q[turn ? 3 : 2]}, other[3] = {q[turn], q[2], q[3]};
    put_flat(s, one);
    put_flat(s, other);
}

/* The same square twice, then once more with other triangles: if depths are equal, the first one stays. */
static void coplanar(hard_list *l)
{
    static float first[SIDE * SIDE];
    hard_stage *s = l->stage;
    double other = 0.0, gap = 0.0, both = 0.0;
    hard_begin(s, 1.0);
    put_slanted(s, 0);
    put_slanted(s, 0);
    put_slanted(s, 1);
    hard_end(s);
    hard_look_flat(s, SIDE);
    hard_draw(s, 0, 4);
    memcpy(first, s->depth, sizeof first);
    for (int i = 0; i < SIDE * SIDE; ++i) {
        other += s->id[i] > 2;
    }
    hard_draw(s, 4, 2);
    for (int32_t i = 0; i < SIDE * SIDE; ++i) {
        const double a = (double)first[hard_at(s, i % SIDE, i / SIDE)], b = (double)hard_depth(s, i % SIDE, i / SIDE);
        gap = a > 0.0 && b > 0.0 ? fmax(gap, fabs(a - b) * 16777216.0) : gap;
        both += a > 0.0 && b > 0.0;
    }
    hard_put(l, HARD_EXACT, "coplanar layers of the same corners: the later one shows", both > 1000 ? other : HUGE_VAL,
             0, "px");
    hard_put(l, HARD_BOUNDED, "of other triangles: depths apart by", gap, 14, "x 2^-24");
}

void hard_raster(hard_list *l)
{
    through_centres(l);
    t_junctions(l);
    million_specks(l);
    slivers(l);
    depth_order(l);
    coplanar(l);
    hard_views(l);
}
