/* test_many_lights.c: many lights: the cells of a stream, the tree over them, a tile's cut, shadows. [V3 V29] */
#include <stdlib.h>

#include "../world.h"

void test_many_lights(void);

enum { LIGHTS = 6000, CELLS = 512 };

static lmb_light lights[LIGHTS], shuffled[LIGHTS];
static const lmb_vec3 box_low = {-2, -1, -3}, box_high = {2, 3, 1};

/* --- making them -------------------------------------------------------------------------------------------------- */

/* A tree with separate memory. */
typedef struct grove {
    lmb_many_lights many_lights;
    void *memory;
    size_t bytes;
} grove;

static void grove_begin(grove *g, uint32_t cells, float max)
{
    g->bytes = lmb_many_lights_bytes(cells);
    g->memory = malloc(g->bytes);
    memset(g->memory, 0xa5, g->bytes);
    CHECK(lmb_many_lights_init(&g->many_lights, cells, box_low, box_high, max, g->memory, g->bytes) == LMB_OK);
}

static void grove_make(grove *g, uint32_t cells, float max, const lmb_light *l, uint32_t count)
{
    grove_begin(g, cells, max);
    CHECK(lmb_many_lights_add(&g->many_lights, l, count) == LMB_OK && lmb_many_lights_build(&g->many_lights) == LMB_OK);
    uint32_t unset = 0; /* as grove_begin left it; lanes read past the last node */
    for (size_t i = 0; i < (size_t)g->many_lights.plane_step * LMB_MANY_LIGHTS_PLANES; ++i) {
        uint32_t word;
        memcpy(&word, &g->many_lights.plane[i], sizeof word);
        unset += word == 0xa5a5a5a5u;
    }
    CHECK_MSG(unset == 0 || g->many_lights.cell_count == 0, "%u words of %u nodes", (unsigned)unset,
              (unsigned)g->many_lights.node_count);
}

static void grove_free(grove *g) { free(g->memory); }

/* Lights anywhere, in clusters of millimetres, at one point, on the box's sides, at zeros of both signs, duplicated,
 * and of equal power at different points. */
static void make_lights(uint32_t count, test_rng *r)
{
    for (uint32_t i = 0; i < count; ++i) {
        lmb_light *l = &lights[i];
        /* Separate statements: the compiler chooses the evaluation order of arguments. */
        const float z = test_uniform(r, -3, 1), y = test_uniform(r, -1, 3), x = test_uniform(r, -2, 2);
        *l = point_light(vec3(x, y, z));
        const uint32_t kind = test_random(r) % 8u;
        if (kind < 3 && i > 0) {
            l->position = add3(mul3(lights[i - 1].position, 0.999f), vec3(test_uniform(r, 0, 1e-3f), 0, 0));
        } else if (kind == 3) {
            l->position = vec3(i % 2 ? 0.0f : -0.0f, i % 3 ? -0.0f : 0.0f, 0.5f);
        } else if (kind == 4) {
            l->position.x = i % 2 ? 2.0f : -2.0f;
        }
        for (int c = 0; c < 3; ++c) {
            l->intensity[c] = kind == 3 || kind == 6 ? 0.999f : test_uniform(r, 0.0f, 1.0f);
        }
        if (kind == 5 && i > 0) {
            *l = lights[i - 1];
        }
    }
}

/* Spots of all widths and directions, some with hard edges, and suns, some in similar directions, among the points. */
static void make_kinds(uint32_t count, test_rng *r)
{
    make_lights(count, r);
    for (uint32_t i = 0; i < count; ++i) {
        lmb_light *l = &lights[i];
        const float z = test_uniform(r, -1, 1), y = test_uniform(r, -1, 1), x = test_uniform(r, -1, 1);
        const uint32_t kind = test_random(r) % 4u;
        l->direction = vec3(x, y, z);
        l->direction = mul3(l->direction, 1.0f / maxf(length3(l->direction), 0.01f));
        if (i % 5u == 1 && absf(length3(lights[i - 1].direction) - 1.0f) < 1e-3f) {
            l->direction = lights[i - 1].direction;
        }
        l->kind = kind == 3 && i % 4u == 0 ? LMB_LIGHT_DIRECTIONAL : kind > 0 ? LMB_LIGHT_SPOT : LMB_LIGHT_POINT;
        l->cos_outer = test_uniform(r, 0.1f, 0.95f);
        l->cos_inner = i % 3u == 0 ? l->cos_outer : test_uniform(r, l->cos_outer, 1.0f);
        for (int c = 0; c < 3 && l->kind == LMB_LIGHT_DIRECTIONAL; ++c) {
            l->intensity[c] *= 0.1f;
        }
        if (absf(length3(l->direction) - 1.0f) > 1e-3f) {
            l->kind = LMB_LIGHT_POINT;
        }
    }
}

static void shuffle(uint32_t count, test_rng *r)
{
    memcpy(shuffled, lights, count * sizeof *lights);
    for (uint32_t i = count - 1; i > 0; --i) {
        const uint32_t j = test_random(r) % (i + 1);
        const lmb_light swap = shuffled[i];
        shuffled[i] = shuffled[j];
        shuffled[j] = swap;
    }
}

/* --- the stream --------------------------------------------------------------------------------------------------- */

static int is_same_tree(const lmb_many_lights *a, const lmb_many_lights *b)
{
    return a->node_count == b->node_count && a->cell_count == b->cell_count && a->doubled == b->doubled &&
           a->total == b->total && a->lights == b->lights &&
           memcmp(a->node, b->node, a->node_count * sizeof *a->node) == 0 &&
           memcmp(a->plane, b->plane, a->plane_step * LMB_MANY_LIGHTS_PLANES * sizeof *a->plane) == 0;
}

/* Any order and slices give the same bytes, with few cells (one) and many (one per light). */
static void check_order(test_rng *r)
{
    static const uint32_t cells[] = {1, 7, CELLS, 2 * LIGHTS, 8, CELLS, 2 * LIGHTS};
    for (int k = 0; k < COUNT(cells); ++k) {
        grove a, b;
        if (k < 4) {
            make_lights(LIGHTS, r);
        } else {
            make_kinds(LIGHTS, r);
        }
        grove_make(&a, cells[k], 3.0f * LIGHTS, lights, LIGHTS);
        for (int again = 0; again < 3; ++again) {
            shuffle(LIGHTS, r);
            grove_begin(&b, cells[k], 3.0f * LIGHTS);
            for (uint32_t i = 0, n; i < LIGHTS; i += n) {
                n = 1u + test_random(r) % 900u;
                n = n < LIGHTS - i ? n : LIGHTS - i;
                CHECK(lmb_many_lights_add(&b.many_lights, shuffled + i, n) == LMB_OK);
            }
            CHECK(lmb_many_lights_build(&b.many_lights) == LMB_OK);
            CHECK_MSG(is_same_tree(&a.many_lights, &b.many_lights), "%u cells, order %d", (unsigned)cells[k], again);
            grove_free(&b);
        }
        CHECK(a.many_lights.cell_count <= cells[k] && a.many_lights.lights == LIGHTS);
        grove_free(&a);
    }
}

/* Quanta lose nothing when cells merge. */
static void check_sums(test_rng *r)
{
    grove g;
    int64_t want[3] = {0, 0, 0}, got[3] = {0, 0, 0}, moment = 0, in_cells = 0, count = 0;
    make_lights(LIGHTS, r);
    grove_make(&g, 100, 3.0f * LIGHTS, lights, LIGHTS);
    for (int i = 0; i < LIGHTS; ++i) {
        int64_t sum = 0;
        for (int c = 0; c < 3; ++c) {
            const int64_t quanta = (int64_t)(lights[i].intensity[c] / g.many_lights.quantum);
            want[c] += quanta;
            sum += quanta;
        }
        moment += ((sum >> 24) + 1) * (int64_t)((lights[i].position.y - box_low.y) / g.many_lights.step);
    }
    for (uint32_t i = 0; i < g.many_lights.cell_count; ++i) {
        for (int c = 0; c < 3; ++c) {
            got[c] += g.many_lights.cell[i].intensity[c];
        }
        in_cells += g.many_lights.cell[i].moment[1];
        count += g.many_lights.cell[i].lights;
    }
    CHECK(g.many_lights.doubled > 10 && count == LIGHTS);
    CHECK(want[0] == got[0] && want[1] == got[1] && want[2] == got[2] &&
          g.many_lights.total == want[0] + want[1] + want[2]);
    CHECK(moment == in_cells);
    grove_free(&g);
}

/* The cell side is the smallest that fits: the same with room for exactly these cells, larger with one cell less. */
static void check_side(test_rng *r)
{
    grove a, b, c;
    make_lights(LIGHTS, r);
    grove_make(&a, CELLS, 3.0f * LIGHTS, lights, LIGHTS);
    grove_make(&b, a.many_lights.cell_count, 3.0f * LIGHTS, lights, LIGHTS);
    grove_make(&c, a.many_lights.cell_count - 1, 3.0f * LIGHTS, lights, LIGHTS);
    CHECK(a.many_lights.doubled > 0);
    CHECK_MSG(b.many_lights.doubled == a.many_lights.doubled && c.many_lights.doubled > a.many_lights.doubled,
              "%u %u %u", (unsigned)a.many_lights.doubled, (unsigned)b.many_lights.doubled,
              (unsigned)c.many_lights.doubled);
    CHECK(b.many_lights.cell_count == a.many_lights.cell_count && c.many_lights.cell_count < a.many_lights.cell_count);
    grove_free(&a);
    grove_free(&b);
    grove_free(&c);
}

/* The random choice picks light i with a probability proportional to its intensity: 1 to 3, over 4,000 pairs. */
static void check_lots(test_rng *r)
{
    int strong = 0;
    for (int i = 0; i < 4000; ++i) {
        grove g;
        lmb_light l[2];
        l[0] = point_light(vec3(test_uniform(r, -2, 2), 0, 0));
        l[1] = point_light(vec3(0, 2, test_uniform(r, -3, 1)));
        for (int c = 0; c < 3; ++c) {
            l[i % 2].intensity[c] *= 3.0f;
        }
        grove_make(&g, 1, 100.0f, l, 2);
        CHECK(g.many_lights.node_count == 1 &&
              memcmp(&g.many_lights.node[0].strongest.position, &l[i % 2].position, sizeof(lmb_vec3)) == 0);
        CHECK(fabs((double)g.many_lights.node[0].share - 0.75) < 1e-6);
        strong += memcmp(&g.many_lights.node[0].median.position, &l[i % 2].position, sizeof(lmb_vec3)) == 0;
        grove_free(&g);
    }
    CHECK_MSG(abs(strong - 3000) < 110, "%d of 4000", strong); /* four standard deviations of 27 */
}

static void check_refusals(void)
{
    grove g;
    lmb_many_lights before;
    lmb_light l[6];
    const float bad[] = {(float)NAN, (float)INFINITY, -1.0f};
    grove_begin(&g, 4, 100.0f);
    before = g.many_lights;
    const size_t bytes = lmb_many_lights_bytes(4);
    CHECK(lmb_many_lights_bytes(0) == 0 && lmb_many_lights_bytes((1u << 22) + 1) == 0);
    CHECK(lmb_many_lights_init(NULL, 4, box_low, box_high, 1, g.memory, bytes) == LMB_ERR_ARG);
    CHECK(lmb_many_lights_init(&g.many_lights, 4, box_high, box_low, 1, g.memory, bytes) == LMB_ERR_ARG);
    CHECK(lmb_many_lights_init(&g.many_lights, 4, box_low, vec3(2e6f, 5, 5), 1, g.memory, bytes) == LMB_ERR_ARG);
    CHECK(lmb_many_lights_init(&g.many_lights, 4, box_low, box_high, 0, g.memory, bytes) == LMB_ERR_ARG);
    CHECK(lmb_many_lights_init(&g.many_lights, 4, box_low, box_high, (float)NAN, g.memory, bytes) == LMB_ERR_ARG);
    CHECK(lmb_many_lights_init(&g.many_lights, 4, box_low, box_high, 1, (uint8_t *)g.memory + 2, bytes) ==
          LMB_ERR_ALIGN);
    CHECK(lmb_many_lights_init(&g.many_lights, 4, box_low, box_high, 1, g.memory, bytes - 1) == LMB_ERR_CAPACITY);
    CHECK(memcmp(&before, &g.many_lights, sizeof before) == 0);
    for (int i = 0; i < 3; ++i) { /* invalid numbers, and a place out of bounds */
        l[i] = point_light(vec3(0, 0, 0));
        l[i].intensity[i] = bad[i];
    }
    l[3] = point_light(vec3(0, 3.001f, 0));
    l[4] = point_light(vec3((float)NAN, 0, 0));
    l[5] = point_light(vec3(0, 0, 0));
    memset(l[5].intensity, 0, sizeof l[5].intensity);
    CHECK(lmb_many_lights_add(&g.many_lights, l, 6) == LMB_OK && g.many_lights.dropped == 6 &&
          g.many_lights.lights == 0 && g.many_lights.cell_count == 0);
    l[0] = l[1] = l[2] = spot(vec3(0, 0, 0), Y, 10, 20);
    l[0].direction = vec3(0, 2, 0);
    l[1].cos_outer = l[1].cos_inner + 0.1f;
    l[2].cos_outer = (float)NAN;
    l[3] = sun(vec3((float)NAN, 0, 0));
    CHECK(lmb_many_lights_add(&g.many_lights, l, 4) == LMB_OK && g.many_lights.dropped == 10 &&
          g.many_lights.lights == 0);
    l[0] = l[1] = sun(vec3(0, -1, 0)); /* invalid kinds */
    l[0].kind = LMB_LIGHT_DIRECTIONAL + 1;
    l[1].kind = -1;
    CHECK(lmb_many_lights_add(&g.many_lights, l, 2) == LMB_OK && g.many_lights.dropped == 12 &&
          g.many_lights.lights == 0);
    l[0] = point_light(vec3(0, 0, 0));
    l[1] = point_light(vec3(1, 0, 0));
    l[1].intensity[2] = 1e6f;
    CHECK(lmb_many_lights_add(&g.many_lights, l, 2) == LMB_ERR_CAPACITY && g.many_lights.lights == 1);
    CHECK(lmb_many_lights_add(NULL, l, 1) == LMB_ERR_ARG &&
          lmb_many_lights_add(&g.many_lights, NULL, 1) == LMB_ERR_ARG);
    CHECK(lmb_many_lights_build(&g.many_lights) == LMB_OK && lmb_many_lights_build(&g.many_lights) == LMB_ERR_ARG);
    CHECK(lmb_many_lights_add(&g.many_lights, l, 1) == LMB_ERR_ARG); /* the stream has ended */
    grove_free(&g);
    grove_begin(&g, 2, 100.0f); /* fewer cells than kinds */
    l[0] = point_light(vec3(0, 0, 0));
    l[1] = spot(vec3(0, 0, 0), Y, 10, 20);
    l[2] = sun(Y);
    CHECK(lmb_many_lights_add(&g.many_lights, l, 3) == LMB_ERR_CAPACITY && g.many_lights.lights == 2);
    grove_free(&g);
}

/* --- the tree ----------------------------------------------------------------------------------------------------- */

static float plane_at(const lmb_many_lights *m, int plane, uint32_t i)
{
    return m->plane[(uint32_t)plane * m->plane_step + i];
}

/* Children divide their parent's cells in order, lie in the parent's box, and sum to the parent's light. */
static void check_parts(const lmb_many_lights *m, uint32_t i)
{
    const lmb_many_lights_node *node = &m->node[i];
    uint32_t from = node->from, count = 0;
    double light = 0.0;
    for (uint32_t k = node->first; k < node->first + node->children; ++k) {
        CHECK(m->node[k].from == from && m->node[k].past > from && k > i && k < m->node_count);
        from = m->node[k].past;
        count += m->node[k].lights;
        light += (double)m->node[k].intensity[1];
        for (int a = 0; a < 3; ++a) {
            const float off =
                absf(plane_at(m, LMB_MANY_LIGHTS_MIDDLE + a, k) - plane_at(m, LMB_MANY_LIGHTS_MIDDLE + a, i));
            CHECK(off + plane_at(m, LMB_MANY_LIGHTS_HALF + a, k) <= plane_at(m, LMB_MANY_LIGHTS_HALF + a, i) + 1e-6f);
        }
    }
    CHECK(from == node->past && count == node->lights);
    CHECK(fabs(light / (double)node->intensity[1] - 1.0) < 1e-6);
}

static void check_tree(test_rng *r)
{
    grove g;
    uint32_t leaves = 0;
    make_lights(LIGHTS, r);
    grove_make(&g, CELLS, 3.0f * LIGHTS, lights, LIGHTS);
    const lmb_many_lights *m = &g.many_lights;
    CHECK(m->node_count < 2 * m->cell_count && m->node[0].from == 0 && m->node[0].past == m->cell_count);
    for (uint32_t i = 0; i < m->node_count; ++i) {
        leaves += m->node[i].children == 0;
        CHECK(m->node[i].children != 1 && m->node[i].children <= 8);
        CHECK(m->node[i].children > 0 || m->node[i].past == m->node[i].from + 1);
        for (int a = 0; a < 3; ++a) {
            CHECK(absf(plane_at(m, LMB_MANY_LIGHTS_POSITION + a, i) - plane_at(m, LMB_MANY_LIGHTS_MIDDLE + a, i)) <=
                  plane_at(m, LMB_MANY_LIGHTS_HALF + a, i) + 1e-6f);
        }
        if (m->node[i].children > 0) {
            check_parts(m, i);
        }
    }
    CHECK(leaves == m->cell_count);
    grove_free(&g);
}

/* --- light -------------------------------------------------------------------------------------------------------- */

static lmb_many_lights_scratch scratch;

/* A flat tile 0.3 m wide, facing up. */
static void make_floor_tile(lmb_tile *t, lmb_vec3 at)
{
    memset(t, 0, sizeof *t);
    t->hits = LMB_TILE_PIXELS;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        set_plane(t->position, k, add3(at, vec3(0.04f * (float)(k % 8), 0, 0.04f * (float)(k / 8))));
        set_plane(t->face, k, Y);
        set_plane(t->normal, k, Y);
        t->id[k] = 1;
    }
}

/* The same with a loop over all lights. */
static void sum_lights(double out[LMB_TILE_PIXELS], const lmb_tile *tile, uint32_t count, const lmb_bvh *bvh)
{
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        out[k] = 0.0;
    }
    const lmb_view v = look(vec3(0, 5, 0), vec3(0, 0, 0), 60, 64);
    lmb_traversal traversal;
    memset(&traversal, 0, sizeof traversal);
    for (uint32_t i = 0; i < count; ++i) {
        lmb_irradiance e;
        memset(&e, 0, sizeof e);
        CHECK(lmb_direct_tile(&e, picked_kernels(), tile, &v, &world.scene, &lights[i], NULL) == LMB_OK);
        const uint64_t occluded =
            bvh == NULL ? 0
            : lights[i].kind == LMB_LIGHT_DIRECTIONAL
                ? lmb_occluded_sun(picked_kernels(), &traversal, bvh, tile, UINT64_MAX, mul3(lights[i].direction, -1))
                : lmb_occluded_tile(picked_kernels(), &traversal, bvh, tile, UINT64_MAX, lights[i].position,
                                    lmb_tile_noise(tile, UINT64_MAX));
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            out[k] += (occluded >> k & 1u) != 0 || tile->id[k] == 0 ? 0.0 : (double)e.rgb[1][k];
        }
    }
}

/* Root mean squared error over the mean, green channel. */
static double off(const lmb_irradiance *e, const double want[LMB_TILE_PIXELS])
{
    double sum = 0.0, mean = 0.0;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        sum += ((double)e->rgb[1][k] - want[k]) * ((double)e->rgb[1][k] - want[k]);
        mean += want[k] / LMB_TILE_PIXELS;
    }
    return sqrt(sum / LMB_TILE_PIXELS) / mean;
}

static double light_tile(lmb_irradiance *e, const lmb_tile *tile, const lmb_many_lights *many_lights,
                         const lmb_bvh *bvh, float error, const double want[LMB_TILE_PIXELS])
{
    const lmb_many_lights_query how = {many_lights, bvh, error, 0, 0, NULL};
    memset(e, 0, sizeof *e);
    memset(&scratch, 0x5a, sizeof scratch); /* the contents do not matter */
    scratch.nodes = scratch.tests = 0;
    CHECK(lmb_many_lights_direct_tile(e, picked_kernels(), &scratch, tile, &how) == LMB_OK);
    return off(e, want);
}

/* Checks that each entry is at least as bad as its two children, so that the worst is on top. Returns the number of
 * entries. */
static int32_t check_heap(void)
{
    for (int32_t i = 1; i < scratch.open; ++i) {
        CHECK_MSG(scratch.entry[(i - 1) / 2].key >= scratch.entry[i].key, "entry %d of %d", (int)i, (int)scratch.open);
    }
    return scratch.open;
}

/* Checks the sums that the last tile's cut keeps and the stopping criteria: both limits hold, and no node was split
 * needlessly. */
static void check_stop(float asked)
{
    double error = 0.0, light = 0.0;
    for (int32_t i = 0; i < scratch.open + scratch.closed; ++i) {
        const int32_t at = i < scratch.open ? i : LMB_MANY_LIGHTS_CUT - 1 - (i - scratch.open);
        error += (double)scratch.entry[at].error;
        light += (double)scratch.entry[at].light;
        CHECK(i >= scratch.open || scratch.entry[at].light <= asked * scratch.light);
        CHECK(i < scratch.open || scratch.entry[at].error == 0.0f);
    }
    CHECK_MSG(fabs((double)scratch.error - error) <= 1e-4 * error + 1e-6 * light, "%g, %g", (double)scratch.error,
              error);
    CHECK_MSG(fabs((double)scratch.light / light - 1.0) < 1e-4, "%g, %g", (double)scratch.light, light);
    CHECK(error <= 16.01 * (double)asked * light && scratch.allowed == asked);
    check_heap();
}

/* Without shadows: lights in separate cells, all selected, give the sum of lmb_direct_tile. Cuts stay within the
 * requested error, and a larger error needs fewer nodes. */
static void check_light(test_rng *r)
{
    static const float asked[] = {0.003f, 0.02f, 0.1f, 0.5f}, max[] = {0.93f, 0.4f, 0.2f, 0.17f}; /* of all nodes */
    static lmb_tile tile;
    double want[LMB_TILE_PIXELS];
    lmb_irradiance e, again;
    grove g, twice;
    uint32_t nodes = UINT32_MAX;
    make_lights(300, r);
    make_floor_tile(&tile, vec3(-0.5f, -0.9f, -1.2f));
    sum_lights(want, &tile, 300, NULL);
    grove_make(&g, 400, 900.0f, lights, 300);
    CHECK(light_tile(&e, &tile, &g.many_lights, NULL, 1e-7f, want) < 1e-5);
    const uint32_t all = scratch.nodes;
    CHECK(all > 200 && all <= g.many_lights.cell_count);
    for (int i = 0; i < COUNT(asked); ++i) {
        const double error = light_tile(&e, &tile, &g.many_lights, NULL, asked[i], want);
        printf("  error %.3f: %3u nodes of %u, off by %.4f\n", (double)asked[i], (unsigned)scratch.nodes, (unsigned)all,
               error);
        CHECK_MSG(error < (double)asked[i], "%g at %g", error, (double)asked[i]);
        CHECK(scratch.nodes < nodes && (float)scratch.nodes < max[i] * (float)all);
        check_stop(asked[i]);
        nodes = scratch.nodes;
    }
    for (int i = 0; i < 300; ++i) { /* twice the light gives exactly twice the sum */
        for (int c = 0; c < 3; ++c) {
            lights[i].intensity[c] *= 2.0f;
        }
    }
    light_tile(&again, &tile, &g.many_lights, NULL, 0.02f, want);
    grove_make(&twice, 400, 1800.0f, lights, 300);
    light_tile(&e, &tile, &twice.many_lights, NULL, 0.02f, want);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        CHECK(e.rgb[1][k] == 2.0f * again.rgb[1][k] && again.rgb[1][k] > 0.0f);
    }
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) { /* back-facing surface: smooth normals do not leak light */
        set_plane(tile.face, k, k % 2 ? vec3(0, -1, 0) : Y);
    }
    light_tile(&again, &tile, &twice.many_lights, NULL, 0.02f, want);
    for (int k = 1; k < LMB_TILE_PIXELS; k += 2) { /* and adjacent pixels do not matter */
        tile.id[k] = 0;
    }
    light_tile(&e, &tile, &twice.many_lights, NULL, 0.02f, want);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        CHECK(k % 2 ? again.rgb[1][k] == 0.0f : again.rgb[1][k] == e.rgb[1][k]);
    }
    grove_free(&g);
    grove_free(&twice);
}

static void set_ranges(uint32_t count, test_rng *r)
{
    for (uint32_t i = 0; i < count; ++i) {
        lights[i].range = i % 4u == 0 ? 0.0f : test_uniform(r, 0.2f, 3.0f);
    }
}

/* Ranges: any order, all nodes used, cuts within the error, and no light that ends before the tile. A single light
 * equals lmb_direct_tile. */
static void check_ranges(void)
{
    test_rng own = {23}, *const r = &own;
    static const float asked[] = {0.003f, 0.02f, 0.1f};
    static lmb_tile tile;
    double want[LMB_TILE_PIXELS];
    lmb_irradiance e;
    grove g, other;
    make_floor_tile(&tile, vec3(-0.5f, -0.9f, -1.2f));
    make_kinds(LIGHTS, r);
    set_ranges(LIGHTS, r);
    shuffle(LIGHTS, r);
    grove_make(&g, CELLS, 3.0f * LIGHTS, lights, LIGHTS);
    grove_make(&other, CELLS, 3.0f * LIGHTS, shuffled, LIGHTS);
    CHECK(is_same_tree(&g.many_lights, &other.many_lights) && g.many_lights.ranged == other.many_lights.ranged);
    grove_free(&g);
    grove_free(&other);
    for (int kinds = 0; kinds < 2; ++kinds) {
        if (kinds) {
            make_kinds(300, r);
        } else {
            make_lights(300, r);
        }
        for (int i = 0; i < 300; ++i) { /* all positions differ, so each light has a cell */
            lights[i].position = vec3(test_uniform(r, -2, 2), lights[i].position.y, lights[i].position.z);
        }
        set_ranges(300, r);
        sum_lights(want, &tile, 300, NULL);
        grove_make(&g, 400, 900.0f, lights, 300);
        CHECK_MSG(light_tile(&e, &tile, &g.many_lights, NULL, 1e-7f, want) < 1e-5, "%g", off(&e, want));
        const uint32_t all = scratch.nodes;
        CHECK(all < 200); /* only the lights in range */
        for (int i = 0; i < COUNT(asked); ++i) {
            const double error = light_tile(&e, &tile, &g.many_lights, NULL, asked[i], want);
            printf("  ranges, error %.3f: %3u nodes of %u, off by %.4f\n", (double)asked[i], (unsigned)scratch.nodes,
                   (unsigned)all, error);
            CHECK_MSG(error < (double)asked[i], "%g at %g", error, (double)asked[i]);
        }
        grove_free(&g);
    }
    lights[0] = point_light(vec3(-0.3f, 0, -1.1f));
    for (int i = 0; i < 8; ++i) {
        lights[0].range = 0.5f + 0.1f * (float)i; /* the tile is 0.9 m below */
        lights[1] = spot(lights[0].position, vec3(0, -1, 0), 10, 60);
        lights[1].range = lights[0].range;
        sum_lights(want, &tile, 2, NULL);
        grove_make(&g, 8, 90.0f, lights, 2);
        light_tile(&e, &tile, &g.many_lights, NULL, 0.02f, want);
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            const double by = fabs((double)e.rgb[1][k] - want[k]);
            CHECK_MSG(want[k] > 0.0 ? by < 3e-6 * (1.0 + want[k]) : e.rgb[1][k] == 0.0f,
                      "range %g, pixel %d: %g, not %g", (double)lights[0].range, k, (double)e.rgb[1][k], want[k]);
        }
        grove_free(&g);
    }
}

/* Far more lights in a room than a cut can hold, and too small an error: the cut stops at its capacity. */
static void check_full_cut(test_rng *r)
{
    static lmb_tile tile;
    double want[LMB_TILE_PIXELS];
    lmb_irradiance e;
    grove g;
    make_lights(LIGHTS, r);
    make_floor_tile(&tile, vec3(0, 0, -1));
    tile.id[9] = 0;
    sum_lights(want, &tile, LIGHTS, NULL);
    grove_make(&g, 2 * LIGHTS, 3.0f * LIGHTS, lights, LIGHTS);
    const double error = light_tile(&e, &tile, &g.many_lights, NULL, 1e-7f, want);
    CHECK_MSG(scratch.nodes <= LMB_MANY_LIGHTS_CUT && scratch.nodes > LMB_MANY_LIGHTS_CUT - 8, "%u",
              (unsigned)scratch.nodes);
    CHECK_MSG(error < 0.02, "%g", error);
    CHECK(check_heap() > LMB_MANY_LIGHTS_CUT / 2);
    CHECK(e.rgb[0][9] == 0.0f && e.rgb[0][8] > 0.0f);
    grove_free(&g);
}

/* --- shadows ------------------------------------------------------------------------------------------------------ */

static void table_over_floor(lmb_bvh *out)
{
    static uint64_t memory[1000];
    world_begin(0.5f, 0.5f, 0.5f);
    world_quad(vec3(0, -0.9f, -1), mul3(Z, 2), mul3(X, 2));
    world_quad(vec3(0.1f, 0, -1), mul3(Z, 0.7f), mul3(X, 0.7f));
    CHECK(world_end() == LMB_OK);
    CHECK(lmb_bvh_init(out, 4, memory, sizeof memory) == LMB_OK);
    CHECK(lmb_bvh_build(out, &world.scene) == LMB_OK);
}

/* A plate above a floor, with lights above and below the plate. */
static void check_shadows(test_rng *r)
{
    static lmb_tile tile;
    lmb_bvh bvh;
    lmb_irradiance e;
    double want[LMB_TILE_PIXELS], worst = 0.0;
    grove g;
    table_over_floor(&bvh);
    make_lights(1000, r);
    grove_make(&g, 1500, 3000.0f, lights, 1000);
    for (int i = 0; i < 64; ++i) {
        make_floor_tile(&tile, vec3(-1.9f + 0.45f * (float)(i % 8), -0.9f, -2.9f + 0.45f * (float)(i / 8)));
        sum_lights(want, &tile, 1000, &bvh);
        worst = fmax(worst, light_tile(&e, &tile, &g.many_lights, &bvh, 0.02f, want));
        CHECK(scratch.tests > 0 && scratch.tests <= 2 * scratch.nodes);
    }
    printf("  1000 lights, a plate: worst of 64 tiles off by %.4f\n", worst);
    CHECK_MSG(worst < 0.06, "%g", worst);
    grove_free(&g);
    /* Enclosed: exactly dark. */
    world_begin(0.5f, 0.5f, 0.5f);
    world_box(vec3(0, 1, -1), 0.3f);
    CHECK(world_end() == LMB_OK);
    static uint64_t more[1000];
    CHECK(lmb_bvh_init(&bvh, 12, more, sizeof more) == LMB_OK);
    CHECK(lmb_bvh_build(&bvh, &world.scene) == LMB_OK);
    for (int i = 0; i < 100; ++i) {
        lights[i].position = vec3(test_uniform(r, -0.2f, 0.2f), test_uniform(r, 0.8f, 1.2f),
                                  test_uniform(r, -1.2f, -0.8f));
    }
    grove_make(&g, 200, 300.0f, lights, 100);
    light_tile(&e, &tile, &g.many_lights, &bvh, 0.02f, want);
    CHECK(e.rgb[0][0] == 0.0f && e.rgb[1][27] == 0.0f && e.rgb[2][63] == 0.0f && scratch.tests > 0);
    grove_free(&g);
}

/* One sun among weak lights, over a tile with only the four corners in shadow: every pixel tests the strong light. */
static void check_corners(void)
{
    static uint64_t memory[2000];
    static lmb_tile tile;
    lmb_bvh bvh;
    lmb_irradiance e;
    double want[LMB_TILE_PIXELS];
    grove g;
    world_begin(0.5f, 0.5f, 0.5f);
    make_floor_tile(&tile, vec3(0, -0.9f, -1));
    for (int i = 0; i < 4; ++i) {
        world_quad(vec3(i & 1 ? 0.28f : 0, 0, i & 2 ? -0.72f : -1), mul3(Z, 0.01f), mul3(X, 0.01f));
    }
    CHECK(world_end() == LMB_OK);
    CHECK(lmb_bvh_init(&bvh, 8, memory, sizeof memory) == LMB_OK);
    CHECK(lmb_bvh_build(&bvh, &world.scene) == LMB_OK);
    lights[0] = sun(vec3(0, -1, 0));
    lights[1] = point_light(vec3(1, 2, 0));
    for (int c = 0; c < 3; ++c) {
        lights[1].intensity[c] = 0.01f;
    }
    grove_make(&g, 8, 10.0f, lights, 2);
    sum_lights(want, &tile, 2, &bvh);
    CHECK(want[0] < 0.1 * want[1] && want[63] < 0.1 * want[1]);
    const double error = light_tile(&e, &tile, &g.many_lights, &bvh, 0.02f, want);
    CHECK_MSG(error < 1e-5, "%g", error);
    grove_free(&g);
}

/* 300 spots, then a mixture, then only suns: with one cell per light and all selected, the result is their sum; cuts
 * stay within the requested error. A plate above the floor combines cones and shadows. */
static void check_kinds(test_rng *r)
{
    static const float asked[] = {0.01f, 0.04f};
    static const char *const names[] = {"spots", "mixed", "suns"};
    static lmb_tile tile;
    lmb_bvh bvh;
    lmb_irradiance e;
    double want[LMB_TILE_PIXELS];
    table_over_floor(&bvh);
    for (int set = 0; set < 3; ++set) {
        grove g;
        uint32_t all = 0, taken[2] = {0, 0};
        double exact = 0.0, worst[2] = {0.0, 0.0}, sum[2] = {0.0, 0.0};
        make_kinds(300, r);
        for (int i = 0; i < 300; ++i) { /* all differ in position and direction, so each light has a cell */
            lights[i].position = vec3(test_uniform(r, -2, 2), lights[i].position.y, lights[i].position.z);
            const int turned = absf(length3(lights[i].direction) - 1.0f) < 1e-3f;
            lights[i].kind = set == 1 || !turned ? lights[i].kind : set == 0 ? LMB_LIGHT_SPOT : LMB_LIGHT_DIRECTIONAL;
        }
        grove_make(&g, 400, 900.0f, lights, 300);
        CHECK(g.many_lights.lights == 300 && g.many_lights.node[0].lights == 300);
        for (uint32_t i = 0; i < g.many_lights.node_count; ++i) { /* for suns the mean is a direction too */
            const lmb_many_lights_node *n = &g.many_lights.node[i];
            CHECK(n->kind != LMB_LIGHT_DIRECTIONAL || absf(length3(n->position) - 1.0f) < 1e-4f);
        }
        for (int i = 0; i < 64; ++i) {
            make_floor_tile(&tile, vec3(-1.9f + 0.45f * (float)(i % 8), -0.9f, -2.9f + 0.45f * (float)(i / 8)));
            sum_lights(want, &tile, 300, &bvh);
            exact = fmax(exact, light_tile(&e, &tile, &g.many_lights, &bvh, 1e-7f, want));
            all += scratch.nodes;
            for (int k = 0; k < COUNT(asked); ++k) {
                const double error = light_tile(&e, &tile, &g.many_lights, &bvh, asked[k], want);
                worst[k] = fmax(worst[k], error);
                sum[k] += error / 64.0;
                taken[k] += scratch.nodes;
            }
        }
        printf("  300 %s: %.0f nodes a tile; ", names[set], all / 64.0);
        for (int k = 0; k < COUNT(asked); ++k) {
            printf("at %.2f %.0f, off by %.4f, worst %.4f; ", (double)asked[k], taken[k] / 64.0, sum[k], worst[k]);
            CHECK_MSG(sum[k] < (double)asked[k] && worst[k] < 4.0 * (double)asked[k], "%s: %g, %g", names[set], sum[k],
                      worst[k]);
        }
        printf("all: %.1e\n", exact);
        CHECK_MSG(exact < 0.01, "%g", exact);
        CHECK(taken[1] < taken[0] && taken[0] < all);
        grove_free(&g);
    }
}

/* --- bounced light ------------------------------------------------------------------------------------------------ */

enum { ELEMENTS = 4096, BOUNCING = 100 };

static lmb_cut cut;

/* A room with a box in it and lights of all kinds inside. */
static lmb_bvh make_room(test_rng *r)
{
    static uint64_t memory[1000];
    lmb_bvh b;
    world_begin(0.5f, 0.6f, 0.7f);
    world_box(vec3(0, 1, -1), 2.0f);
    world_box(vec3(0.3f, 0, -1), 0.6f);
    CHECK(world_end() == LMB_OK);
    CHECK(lmb_bvh_init(&b, 24, memory, sizeof memory) == LMB_OK);
    CHECK(lmb_bvh_build(&b, &world.scene) == LMB_OK);
    make_kinds(BOUNCING, r);
    for (int i = 0; i < BOUNCING; ++i) {
        lights[i].position = add3(vec3(0, 1, -1), mul3(sub3(lights[i].position, vec3(0, 1, -1)), 0.9f));
    }
    return b;
}

static void *make_elements(lmb_elements *e)
{
    void *memory = malloc(lmb_elements_bytes(ELEMENTS));
    CHECK(lmb_elements_init(e, ELEMENTS, memory, lmb_elements_bytes(ELEMENTS)) == LMB_OK);
    CHECK(lmb_elements_build(e, &world.scene, NULL) == LMB_OK && e->count > ELEMENTS / 8);
    return memory;
}

/* Every light at every element, green channel only. */
static void light_elements(const lmb_elements *e, const lmb_bvh *b)
{
    static lmb_tile tile;
    double sum[LMB_TILE_PIXELS];
    for (uint32_t i = 0; i < e->count; i += LMB_TILE_PIXELS) {
        memset(&tile, 0, sizeof tile);
        for (uint32_t k = 0; k < LMB_TILE_PIXELS && i + k < e->count; ++k) {
            const lmb_element *x = &e->data[i + k];
            const lmb_vec3 *c = x->corner;
            const lmb_vec3 middle = mul3(add3(c[0], add3(c[1], c[2])), 1.0f / 3.0f);
            lmb_vec3 across = cross3(sub3(c[1], c[0]), sub3(c[2], c[0]));
            /* the first bits of the key are the side that the element faces */
            const float along[3] = {across.x, across.y, across.z}, side = (x->key >> 27) & 1u ? -1.0f : 1.0f;
            across = mul3(across, side * along[x->key >> 28] < 0.0f ? -1.0f : 1.0f);
            set_plane(tile.position, (int)k, middle);
            set_plane(tile.normal, (int)k, mul3(across, 1.0f / length3(across)));
            set_plane(tile.face, (int)k, mul3(across, 1.0f / length3(across)));
            tile.id[k] = 1;
        }
        sum_lights(sum, &tile, BOUNCING, b);
        for (uint32_t k = 0; k < LMB_TILE_PIXELS && i + k < e->count; ++k) {
            e->data[i + k].fresh[0] = e->data[i + k].fresh[2] = 0.0f;
            e->data[i + k].fresh[1] = (float)sum[k];
        }
    }
}

/* Elements receive the same from the tree of lights as from all lights, and a floor in the room receives the light that
 * they reflect. */
static void check_bounce(test_rng *r)
{
    static lmb_tile tile, own;
    static lmb_irradiance received, fresh;
    const lmb_bvh b = make_room(r);
    lmb_elements e, brute;
    grove g;
    void *memory = make_elements(&e), *other = make_elements(&brute);
    const lmb_element_scratch receiver = {picked_kernels(), &cut, &own, &received, &fresh};
    double off_sum = 0.0, sum = 0.0;
    grove_make(&g, BOUNCING, 3.0f * BOUNCING, lights, BOUNCING);
    const lmb_many_lights_query how = {&g.many_lights, &b, 0.02f, 0, 0, NULL};
    const int32_t tiles = lmb_elements_tiles(&e);
    CHECK(lmb_many_lights_elements(&e, &receiver, &scratch, &how, tiles / 2, tiles) == LMB_OK);
    CHECK(lmb_many_lights_elements(&e, &receiver, &scratch, &how, 0, tiles / 2) == LMB_OK);
    light_elements(&brute, &b);
    for (uint32_t i = 0; i < e.count; ++i) {
        off_sum += (double)e.data[i].area * fabs((double)e.data[i].fresh[1] - (double)brute.data[i].fresh[1]);
        sum += (double)e.data[i].area * (double)brute.data[i].fresh[1];
    }
    printf("  %u elements, %d lights: off by %.4f\n", (unsigned)e.count, BOUNCING, off_sum / sum);
    CHECK_MSG(off_sum < 0.02 * sum && sum > 0.0, "%g of %g", off_sum, sum);
    CHECK(lmb_many_lights_elements_done(&e) == LMB_OK && lmb_many_lights_elements_done(&brute) == LMB_OK);
    CHECK(lmb_elements_send(&e, 1) == LMB_OK && lmb_elements_send(&brute, 1) == LMB_OK);
    CHECK(e.level > brute.level && brute.level > 0.0f); /* of three channels, and of green only */
    const lmb_cut_params cut_params = {.error = 0.01f, .visibility = 0.01f, .bvh = &b};
    double mean = 0.0, wrong = 0.0;
    for (int i = 0; i < 16; ++i) {
        lmb_irradiance a, c;
        memset(&a, 0, sizeof a);
        memset(&c, 0, sizeof c);
        make_floor_tile(&tile, vec3(-1.8f + 0.9f * (float)(i % 4), -0.99f, -2.8f + 0.9f * (float)(i / 4)));
        CHECK(lmb_gather_cut(&a, receiver.kernels, &cut, &tile, &e.tree, &cut_params) == LMB_OK);
        CHECK(lmb_gather_cut(&c, receiver.kernels, &cut, &tile, &brute.tree, &cut_params) == LMB_OK);
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            mean += (double)c.rgb[1][k];
            wrong += fabs((double)a.rgb[1][k] - (double)c.rgb[1][k]);
        }
    }
    printf("  what they reflect: off by %.4f\n", wrong / mean);
    CHECK_MSG(mean > 0.0 && wrong < 0.02 * mean, "%g of %g", wrong, mean);
    CHECK(lmb_many_lights_elements(NULL, &receiver, &scratch, &how, 0, 1) == LMB_ERR_ARG);
    CHECK(lmb_many_lights_elements(&e, &receiver, &scratch, &how, 0, tiles + 1) == LMB_ERR_ARG);
    CHECK(lmb_many_lights_elements(&e, NULL, &scratch, &how, 0, 1) == LMB_ERR_ARG);
    CHECK(lmb_many_lights_elements(&e, &receiver, NULL, &how, 0, 1) == LMB_ERR_ARG);
    CHECK(lmb_many_lights_elements(&e, &receiver, &scratch, NULL, 0, 1) == LMB_ERR_ARG);
    CHECK(lmb_many_lights_elements_done(NULL) == LMB_ERR_ARG);
    grove_free(&g);
    free(memory);
    free(other);
}

static void check_tile_refusals(void)
{
    static lmb_tile tile;
    lmb_irradiance e;
    grove g;
    grove_make(&g, 4, 1.0f, lights, 0);
    const lmb_many_lights_query how = {&g.many_lights, NULL, 0, 0, 0, NULL}, none = {NULL, NULL, 0, 0, 0, NULL};
    make_floor_tile(&tile, vec3(0, 0, 0));
    memset(&e, 0, sizeof e);
    CHECK(lmb_many_lights_direct_tile(&e, picked_kernels(), &scratch, &tile, &how) == LMB_OK && e.rgb[0][0] == 0.0f);
    CHECK(lmb_many_lights_direct_tile(NULL, picked_kernels(), &scratch, &tile, &how) == LMB_ERR_ARG);
    CHECK(lmb_many_lights_direct_tile(&e, NULL, &scratch, &tile, &how) == LMB_ERR_ARG);
    CHECK(lmb_many_lights_direct_tile(&e, picked_kernels(), NULL, &tile, &how) == LMB_ERR_ARG);
    CHECK(lmb_many_lights_direct_tile(&e, picked_kernels(), &scratch, NULL, &how) == LMB_ERR_ARG);
    CHECK(lmb_many_lights_direct_tile(&e, picked_kernels(), &scratch, &tile, NULL) == LMB_ERR_ARG);
    CHECK(lmb_many_lights_direct_tile(&e, picked_kernels(), &scratch, &tile, &none) == LMB_ERR_ARG);
    grove_free(&g);
}

void test_many_lights(void)
{
    test_rng r = {11};
    check_order(&r);
    check_sums(&r);
    check_side(&r);
    check_lots(&r);
    check_refusals();
    check_tree(&r);
    check_light(&r);
    check_ranges();
    check_full_cut(&r);
    check_shadows(&r);
    check_corners();
    check_kinds(&r);
    check_bounce(&r);
    check_tile_refusals();
}
