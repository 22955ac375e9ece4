/* test_plan_frame.c: layer 8: a plan's predictions against the frame's actual work; budgets. */
#include <lambent/lambent.h>

#include "../world.h"

enum { FRAME = 32, MAP = 16, FACES = 7, ELEMENTS = 64, BVH = 96 };
#include "../../tools/render/ladder.h"
#include "../bounce_frame.h"

void test_plan_frame(void);

#if LMB_PLAN && LMB_TREES

static lmb_plan plan;
static lmb_stats stats;
static lmb_light lights[2];
static float other[FRAME * FRAME * 3];

/* A floor, a wall and a block; one light above them and one that points away. */
static lmb_frame set_frame(void)
{
    const lmb_view v = look(vec3(1.2f, 0.9f, 2.2f), vec3(-0.1f, -0.4f, 0), 60, FRAME);
    world_begin(0.7f, 0.6f, 0.5f);
    world_quad(vec3(0, -1, 0), Z, X);
    world_quad(vec3(0, 0, -1), X, Y);
    world_box(vec3(0.2f, -0.7f, 0.1f), 0.3f);
    lights[0] = spot(vec3(0.3f, 1.4f, 0.8f), vec3(-0.2f, -1, -0.5f), 20, 40);
    lights[1] = lights[0];
    lights[1].direction = vec3(0, 1, 0);
    world.scene.lights = lights;
    world.scene.light_count = LMB_MAX_LIGHTS > 1 ? 2 : 1;
    CHECK(world_end() == LMB_OK);
    lmb_frame f = bounce_frame(&v, 1);
    f.error = f.visibility = 0.1f;
    f.stats = &stats;
    memset(&stats, 0, sizeof stats);
    return f;
}

static void make_plan(const lmb_frame *f, const ladder_facts *facts)
{
    const double pairs = facts != NULL ? facts->pairs : 0.0, segments = facts != NULL ? facts->segments : 0.0;
    CHECK(lmb_render_begin(&render, f) == LMB_OK && lmb_plan_frame(&plan, &render, pairs, segments) == LMB_OK);
}

static void finish(void)
{
    while (lmb_render_step(&render, 64) == LMB_MORE) {
    }
    CHECK(render.failed == LMB_OK && render.stage == LMB_STAGE_DONE);
}

static int why_of(lmb_plan_stage stage) { return plan.row[stage].why; }

/* --- counts ------------------------------------------------------------------------------------------------------- */

static lmb_survey places;

/* Sampling all tiles of a small frame gives the exact pairs and segments. */
static void look_at(ladder_facts *out, const lmb_frame *f, lmb_tile_sample *at)
{
    lmb_frame quiet = *f;
    quiet.stats = NULL;
    memset(out, 0, sizeof *out);
    memset(&places, 0, sizeof places);
    CHECK(lmb_render_frame(&render, &quiet) == LMB_OK);
    for (int32_t i = 0; i < FRAME / LMB_TILE * (FRAME / LMB_TILE); ++i) {
        places.x[places.count] = (uint16_t)(i % (FRAME / LMB_TILE) * LMB_TILE);
        places.y[places.count++] = (uint16_t)(i / (FRAME / LMB_TILE) * LMB_TILE);
    }
    CHECK(lmb_render_sample(at, &render, &scratch, &places, 0.0) == LMB_OK && at->places == places.count);
    out->pairs = at->pairs;
    out->segments = at->segments;
}

static void test_counts(void)
{
    static lmb_tile_sample at, twice;
    ladder_facts facts;
    const lmb_frame f = set_frame();
    look_at(&facts, &f, &at);
    make_plan(&f, &facts);
    const double triangles =
        plan.row[LMB_PLAN_MAPS].op[LMB_OP_TRIANGLES] + plan.row[LMB_PLAN_VIEW].op[LMB_OP_TRIANGLES];
    const double pairs = plan.row[LMB_PLAN_GATHER].op[LMB_OP_PAIRS];
    const double segments = plan.row[LMB_PLAN_OCCLUSION].op[LMB_OP_SEGMENTS];
    finish();
    CHECK_MSG(triangles == (double)stats.triangles, "%.0f of %u", triangles, (unsigned)stats.triangles);
    CHECK_MSG(fabs(pairs / (double)stats.pairs - 1.0) < 1e-5, "%.0f of %.0f", pairs, (double)stats.pairs);
    CHECK_MSG(fabs(segments / (double)stats.segments - 1.0) < 1e-5, "%.0f of %.0f", segments, (double)stats.segments);
    CHECK(plan.row[LMB_PLAN_BVH].op[LMB_OP_BVH] == 16.0 && plan.work > 0.0 && plan.bytes > sizeof scratch);
    CHECK(lmb_plan_frame(&plan, &render, 0.0, 0.0) == LMB_ERR_ARG); /* it has progressed */
    /* Errors of samples: zero against the same; a tenth of each pixel gives a tenth, or more if the light is uneven. */
    twice = at;
    CHECK(ladder_error(&twice, &at, 0.0f) == 0.0f);
    for (int i = 0; i < at.places * LMB_TILE_PIXELS; ++i) {
        for (int c = 0; c < 3; ++c) {
            twice.light[i][c] *= at.light[i][c] > 0.0f ? 1.1f : 1.0f;
        }
    }
    const float error = ladder_error(&twice, &at, 0.0f);
    CHECK(error > 0.08f && error < 0.2f);
    /* The bound exceeds the error, depending on the spread of places; with few places, or dark ones, there is none. */
    CHECK(ladder_error(&twice, &at, 0.0f) == error && ladder_error(&twice, &at, 2.0f) > 1.02f * error);
    twice.places = 3;
    CHECK(ladder_error(&twice, &at, 1.0f) < 0.0f);
    memset(&twice, 0, sizeof twice);
    twice.places = at.places;
    CHECK(ladder_error(&at, &twice, 1.0f) < 0.0f);
    CHECK(lmb_render_sample(&twice, &render, &scratch, &places, 1.0) == LMB_OK && twice.places < at.places);
}

/* A sample writes all channels of the pixels of its places, and nothing behind them. */
static void test_written_light(void)
{
    static lmb_tile_sample at;
    ladder_facts facts;
    const lmb_frame f = set_frame();
    for (int i = 0; i < LMB_SAMPLE_PIXELS; ++i) {
        at.light[i][0] = at.light[i][1] = at.light[i][2] = -7.0f;
    }
    look_at(&facts, &f, &at);
    const int written = at.places * LMB_TILE_PIXELS;
    int kept = 0, others = 0;
    for (int i = 0; i < LMB_SAMPLE_PIXELS; ++i) {
        for (int c = 0; c < 3; ++c) {
            kept += i < written && at.light[i][c] == -7.0f;
            others += i >= written && at.light[i][c] != -7.0f;
        }
    }
    CHECK_MSG(written > 0 && written < LMB_SAMPLE_PIXELS && kept == 0 && others == 0, "%d, %d", kept, others);
}

/* A pixel counts if both samples have a surface there, even one whose red is 0. The mean is that of the second. */
static void test_known_error(void)
{
    static lmb_tile_sample a, b;
    static const float pixels[][2][3] = {{{0, 2.5f, 1}, {0, 2, 1}}, {{0, 1, 1}, {0.5f, 1, 1}}, {{0.5f, 1, 1}, {0, 1, 1}},
                                         {{1, 1, 1.5f}, {1, 1, 1}}};
    a.places = b.places = 4;
    for (int i = 0; i < LMB_SAMPLE_PIXELS; ++i) {
        for (int c = 0; c < 3; ++c) {
            a.light[i][c] = b.light[i][c] = -1.0f;
        }
    }
    for (int i = 0; i < 4; ++i) {
        memcpy(a.light[i * LMB_TILE_PIXELS], pixels[i][0], sizeof pixels[i][0]);
        memcpy(b.light[i * LMB_TILE_PIXELS], pixels[i][1], sizeof pixels[i][1]);
    }
    memcpy(a.light[1], pixels[3][0], sizeof pixels[3][0]); /* a surface in one of them */
    memcpy(b.light[2], pixels[3][0], sizeof pixels[3][0]);
    /* Each of four pixels differs by 0.5 in one channel; the twelve channels have a mean of 10.5 / 12. */
    const double want = sqrt(1.0 / 12.0) / (10.5 / 12.0), error = (double)ladder_error(&a, &b, 0.0f);
    CHECK_MSG(fabs(error - want) < 1e-5, "%g, not %g", error, want);
}

/* Later bounces (with emission the first too), lobes and emission: their operations and bytes; after the frame, the
 * kept data. */
static void test_rows(void)
{
    lmb_frame f = set_frame();
    f.bounces = 3;
    world.material[0].specular[1] = 0.5f;
    world.material[0].roughness = 0.5f;
    world.material[0].emission[0] = 1.0f;
    memset(&render, 0, sizeof render);
    CHECK(lmb_render_reuse(&render, &f) == LMB_OK && lmb_plan_frame(&plan, &render, 0.0, 0.0) == LMB_OK);
    const lmb_plan_row *bounces = &plan.row[LMB_PLAN_BOUNCES];
    CHECK(bounces->why == LMB_WHY_RUNS && bounces->op[LMB_OP_ELEMENTS] == 16.0);
    CHECK(bounces->op[LMB_OP_CUTS] == 3.0 * ELEMENTS / LMB_TILE_PIXELS && bounces->work > 0.0);
    CHECK(bounces->bytes == lmb_elements_bytes(ELEMENTS));
    CHECK(plan.row[LMB_PLAN_LOBES].op[LMB_OP_LOBES] == FRAME * FRAME);
    CHECK(plan.row[LMB_PLAN_EMISSION].op[LMB_OP_STORED] == FRAME * FRAME);
    finish();
    CHECK(lmb_render_reuse(&render, &f) == LMB_OK && lmb_plan_frame(&plan, &render, 0.0, 0.0) == LMB_OK);
    CHECK(bounces->why == LMB_WHY_REUSED && bounces->work == 0.0 && bounces->bytes == lmb_elements_bytes(ELEMENTS));
    memset(lights[0].intensity, 0, sizeof lights[0].intensity);
    memset(lights[1].intensity, 0, sizeof lights[1].intensity);
    make_plan(&f, NULL);
    CHECK(why_of(LMB_PLAN_DIRECT) == LMB_WHY_NO_LIGHT);
}

/* Groups instead of a tree: the points' bytes belong to the groups. */
static void test_groups(void)
{
    static uint32_t memory[4096 * 32];
    static lmb_groups groups;
    lmb_frame f = set_frame();
    const size_t all = lmb_points_bytes(MAP * MAP * 2, MAP);
    CHECK(all <= sizeof memory);
    CHECK(lmb_points_init(&f.points, MAP * MAP * 2, MAP, memory, sizeof memory) == LMB_OK);
    CHECK(lmb_points_init(&f.points, MAP * MAP * 2, MAP, memory, all - 1) == LMB_ERR_CAPACITY);
    f.groups = &groups;
    f.occlusion = LMB_OCCLUSION_NONE;
    f.grouping.method = LMB_GROUP_ZONES;
    f.grouping.block = 1;
    make_plan(&f, NULL);
    const lmb_plan_row *points = &plan.row[LMB_PLAN_POINTS];
    CHECK_MSG(points->why == LMB_WHY_RUNS && points->op[LMB_OP_SUMMED] == (double)(plan.faces_drawn * MAP * MAP) &&
                  points->bytes >= MAP * MAP * 2 * sizeof(lmb_point) && points->bytes < all + 2 * sizeof groups,
              "%g %g", points->op[LMB_OP_SUMMED], (double)points->bytes);
}

/* --- surveys ------------------------------------------------------------------------------------------------------ */

enum { LARGE = 368 /* 2,116 tiles; 192, or 80 blocks of four, are sampled */ };
static uint32_t large_depth[LARGE * LARGE], large_id[LARGE * LARGE];
static float large_picture[LARGE * LARGE * 3];

/* The first sixteen places of any survey cover all sixteen parts of the frame, except for some at uneven borders. */
static void check_spread(void)
{
    int parts = 0;
    for (int i = 0; i < 16; ++i) {
        parts |= 1 << (places.x[i] * 4 / LARGE + 4 * (places.y[i] * 4 / LARGE));
    }
    CHECK_MSG(count_bits_64((uint64_t)parts) >= 11, "%#x", (unsigned)parts);
    for (int i = 0; i < places.count; ++i) {
        for (int k = 0; k < i; ++k) {
            CHECK(places.x[i] != places.x[k] || places.y[i] != places.y[k]);
        }
    }
}

/* Draws the whole frame, and predicts its operations from samples. */
static void test_surveys(void)
{
    static lmb_tile_sample at;
    lmb_frame f = set_frame();
    f.view = look(vec3(1.2f, 0.9f, 2.2f), vec3(-0.1f, -0.4f, 0), 60, LARGE);
    f.eye = target_of(LMB_DEPTH32F, LARGE, large_depth, large_id);
    CHECK(lmb_surface_init(&f.out, LMB_RGB32F, LARGE, LARGE, large_picture, sizeof large_picture) == LMB_OK);
    CHECK(lmb_render_frame(&render, &f) == LMB_OK);
    ladder_places(&places, &f.view, LMB_SAMPLE_TILES);
    CHECK(places.count == LMB_SAMPLE_TILES);
    check_spread();
    CHECK(lmb_render_sample(&at, &render, &scratch, &places, 0.0) == LMB_OK);
    const double of_all = (double)(LARGE / LMB_TILE * (LARGE / LMB_TILE)) / (double)at.places;
    const double pairs = at.pairs * of_all / (double)stats.pairs;
    const double segments = at.segments * of_all / (double)stats.segments;
    CHECK_MSG(fabs(pairs - 1.0) < 0.1 && fabs(segments - 1.0) < 0.2, "pairs %.3f, segments %.3f", pairs,
              segments);
    CHECK(lmb_render_sample(&at, &render, &scratch, NULL, 0.0) == LMB_ERR_ARG);
    render.frame.gather_step = LMB_GATHER_LIVE; /* depends on the whole frame */
    CHECK(lmb_render_sample(&at, &render, &scratch, &places, 0.0) == LMB_ERR_ARG);
}

/* --- reasons ------------------------------------------------------------------------------------------------------ */

static void test_reasons(void)
{
    lmb_frame f = set_frame();
    make_plan(&f, NULL);
    CHECK(why_of(LMB_PLAN_GATHER) == LMB_WHY_RUNS && plan.row[LMB_PLAN_GATHER].proof == LMB_PROOF_RUNS);
    CHECK(why_of(LMB_PLAN_LOBES) == LMB_WHY_NO_LOBE && why_of(LMB_PLAN_EMISSION) == LMB_WHY_NO_EMISSION);
    CHECK(plan.row[LMB_PLAN_LOBES].proof == LMB_PROOF_EXACT && why_of(LMB_PLAN_BOUNCES) == LMB_WHY_NOT_ASKED);
    CHECK(LMB_MAX_LIGHTS == 1 || (plan.light[1] == LMB_WHY_PAST && plan.faces == 2 && plan.faces_drawn == 1));
    f.show = LMB_SHOW_DIRECT;
    make_plan(&f, NULL);
    CHECK(why_of(LMB_PLAN_GATHER) == LMB_WHY_NOT_SHOWN && why_of(LMB_PLAN_DIRECT) == LMB_WHY_RUNS);
    /* The range ends before all surfaces, so there is no shadow map. */
    const lmb_vec3 was = lights[0].position;
    for (int near = 0; near < 2; ++near) {
        lights[0].position.y = world.scene.bounds_max.y + 3.0f;
        lights[0].range = near ? 3.1f : 2.9f;
        make_plan(&f, NULL);
        CHECK(near ? plan.light[0] != LMB_WHY_NO_LIGHT && plan.faces_drawn > 0
                   : plan.light[0] == LMB_WHY_NO_LIGHT && plan.faces_drawn == 0);
    }
    lights[0].position = was;
    lights[0].range = 0.0f;
    f.show = LMB_SHOW_INDIRECT;
    f.occlusion = LMB_OCCLUSION_NONE;
    make_plan(&f, NULL);
    CHECK(why_of(LMB_PLAN_DIRECT) == LMB_WHY_NOT_SHOWN && why_of(LMB_PLAN_OCCLUSION) == LMB_WHY_NOT_ASKED);
    memset(world.material[0].albedo, 0, sizeof world.material[0].albedo);
    make_plan(&f, NULL);
    CHECK(why_of(LMB_PLAN_GATHER) == LMB_WHY_BLACK && why_of(LMB_PLAN_POINTS) == LMB_WHY_BLACK);
    world.scene.light_count = 0;
    make_plan(&f, NULL);
    CHECK(why_of(LMB_PLAN_GATHER) == LMB_WHY_NO_LIGHT && why_of(LMB_PLAN_MAPS) == LMB_WHY_NO_LIGHT);
    f = set_frame();
    world.scene.instance_count = 0;
    make_plan(&f, NULL);
    CHECK(why_of(LMB_PLAN_GATHER) == LMB_WHY_EMPTY && why_of(LMB_PLAN_VIEW) == LMB_WHY_EMPTY);
    for (int i = 0; i < LMB_WHYS; ++i) {
        CHECK(lmb_why_name(i)[0] != '?');
    }
    CHECK(lmb_why_name(-1)[0] == '?' && lmb_why_name(LMB_WHYS)[0] == '?' && lmb_op_name(LMB_OPS)[0] == '?');
    CHECK(lmb_plan_stage_name(LMB_PLAN_STAGES)[0] == '?' && lmb_plan_units(LMB_OP_PAIRS) > 0.0);
}

static void test_kept(void)
{
    const lmb_frame f = set_frame();
    memset(&render, 0, sizeof render);
    CHECK(lmb_render_reuse(&render, &f) == LMB_OK);
    finish();
    CHECK(lmb_render_reuse(&render, &f) == LMB_OK && lmb_plan_frame(&plan, &render, 0.0, 0.0) == LMB_OK);
    CHECK(why_of(LMB_PLAN_MAPS) == LMB_WHY_REUSED && why_of(LMB_PLAN_POINTS) == LMB_WHY_REUSED);
    CHECK(why_of(LMB_PLAN_BVH) == LMB_WHY_REUSED && why_of(LMB_PLAN_VIEW) == LMB_WHY_REUSED);
    CHECK(why_of(LMB_PLAN_GATHER) == LMB_WHY_RUNS && plan.row[LMB_PLAN_MAPS].work == 0.0);
}

/* Two quads at a right angle have two planes with everything in front; the block changes that. */
static void test_convex(void)
{
    lmb_frame f = set_frame();
    make_plan(&f, NULL);
    CHECK(why_of(LMB_PLAN_OCCLUSION) == LMB_WHY_RUNS);
    world.count = 4;
    world.first = 0;
    CHECK(world_end() == LMB_OK);
    make_plan(&f, NULL);
    CHECK(why_of(LMB_PLAN_OCCLUSION) == LMB_WHY_CONVEX);
    f.run_all = 1;
    make_plan(&f, NULL);
    CHECK(why_of(LMB_PLAN_OCCLUSION) == LMB_WHY_RUNS);
}

/* --- dim lights --------------------------------------------------------------------------------------------------- */

static double largest_change(void)
{
    double max = 0.0;
    for (int i = 0; i < FRAME * FRAME * 3; ++i) {
        const double d = fabs((double)picture[i] - (double)other[i]);
        max = d > max ? d : max;
    }
    return max;
}

/* The light is 2.4 m above the floor and at least 1.2 m from everything: E = 5 / d^2. */
static void test_dim(void)
{
    lmb_frame f = set_frame();
    world.scene.light_count = 1;
    f.bounces = 2;
    CHECK(lmb_render_frame(&render, &f) == LMB_OK && render.dimmed == 0.0f);
    memcpy(other, picture, sizeof other);
    f.dim = 100.0f;
    CHECK(lmb_render_frame(&render, &f) == LMB_OK && render.light_state[0] == LMB_LIGHT_DIM);
    const float bound = render.dimmed;
    CHECK_MSG(largest_change() > 0.0 && largest_change() <= (double)bound, "%g of %g", largest_change(), (double)bound);
    f.dim = bound * 0.999f;
    CHECK(lmb_render_frame(&render, &f) == LMB_OK && render.light_state[0] == 0 && largest_change() == 0.0);
    f.dim = bound;
    make_plan(&f, NULL);
    CHECK(plan.light[0] == LMB_WHY_DIM && plan.row[LMB_PLAN_GATHER].why == LMB_WHY_DIM);
    CHECK(plan.row[LMB_PLAN_GATHER].proof == LMB_PROOF_BOUND && plan.row[LMB_PLAN_GATHER].bound == bound);
    CHECK(plan.row[LMB_PLAN_MAPS].why == LMB_WHY_RUNS);
    world.material[0].specular[1] = 0.5f; /* lobes reflect more than the bound includes */
    ++world.scene.appearance_revision;
    CHECK(lmb_render_frame(&render, &f) == LMB_OK && render.is_glossy && render.light_state[0] == 0 && render.dimmed == 0.0f);
    world.material[0].specular[1] = 0.0f;
    ++world.scene.appearance_revision;
    CHECK(lmb_render_frame(&render, &f) == LMB_OK && render.light_state[0] == LMB_LIGHT_DIM);
    lights[0].position = vec3(0.2f, -0.4f, 0.1f); /* on the block: no bound */
    CHECK(lmb_render_frame(&render, &f) == LMB_OK && render.light_state[0] == 0);
}

/* --- budgets ------------------------------------------------------------------------------------------------------ */

/* Errors fall to a third per rung; the finest was not checked. */
static ladder_facts some_facts(void)
{
    ladder_facts f;
    memset(&f, 0, sizeof f);
    f.triangles = 1000.0;
    f.faces = f.lights = f.bounces = 1.0;
    f.tiles = 4800.0;
    f.wanted_map = 512;
    f.max = 1024;
    for (int i = 0; i < LADDER_RUNGS; ++i) {
        f.rung[i].places = 80;
        f.rung[i].pairs = f.rung[i].segments = 1000.0f * (float)(1 << i);
        f.rung[i].error = i > 0 ? f.rung[i - 1].error / 3.0f : 0.81f;
    }
    f.rung[LADDER_RUNGS - 1].error = f.rung[LADDER_RUNGS - 2].error = -1.0f;
    return f;
}

static void test_budgets(void)
{
    ladder_facts facts = some_facts();
    ladder_choice c;
    for (int i = 0; i < LADDER_RUNGS - 2; ++i) {
        const ladder_budget errors = {0.0, 1.01f * facts.rung[i].error, 0};
        CHECK(ladder_choose(&c, &facts, &errors, 0));
        CHECK_MSG(c.meets && c.rung == i && c.error <= errors.error, "%g: %d", (double)errors.error, (int)c.rung);
        const ladder_budget work = {c.work, 0.0f, 0}, both = {0.5 * c.work, errors.error, 0};
        CHECK(ladder_choose(&c, &facts, &work, 0) && c.meets && c.rung == i);
        CHECK(ladder_choose(&c, &facts, &both, 0) && !c.meets && (i == 0 || c.rung < i));
    }
    /* An unchecked rung is chosen only if no other is left, and does not meet the budget. */
    const ladder_budget fine = {0.0, 0.001f, 0}, few = {0.0, 0.0f, 1u << 20}, none = {1.0, 0.0f, 0};
    CHECK(ladder_choose(&c, &facts, &fine, 0) && !c.meets && c.rung == LADDER_RUNGS - 2 &&
          c.error < 0.0f);
    CHECK(ladder_choose(&c, &facts, &few, 0) && c.meets && c.bytes <= few.bytes);
    CHECK(ladder_choose(&c, &facts, &few, 2u << 20) && !c.meets && c.bytes > 2u << 20);
    CHECK(ladder_choose(&c, &facts, &none, 0) && !c.meets && c.rung == 0 && c.work > 1.0);
    facts.rung[4].places = 0; /* counts as more than the rung before */
    ladder_choice before;
    ladder_cost(&before, &facts, 3, 0);
    ladder_cost(&c, &facts, 4, 0);
    CHECK(c.op[LMB_OP_PAIRS] > 1.5 * before.op[LMB_OP_PAIRS] && c.op[LMB_OP_PAIRS] < 3.0 * before.op[LMB_OP_PAIRS]);
    facts.max = 64;
    ladder_at(&c.settings, &facts, LADDER_RUNGS - 1);
    CHECK(c.settings.tree == 64 && c.settings.shadow_map == 64);
    facts.max = LMB_TILE;
    CHECK(ladder_choose(&c, &facts, &none, 0));
    facts.max = LMB_TILE - 1;
    CHECK(!ladder_choose(&c, &facts, &none, 0));
    facts.max = 0;
    CHECK(!ladder_choose(&c, &facts, &none, 0));
}

void test_plan_frame(void)
{
    test_counts();
    test_written_light();
    test_known_error();
    test_rows();
    test_groups();
    test_surveys();
    test_reasons();
    test_kept();
    test_convex();
    test_dim();
    test_budgets();
}

#else

void test_plan_frame(void) {}

#endif
