/* test_plan_frame.c: floor 8: what a plan tells of a frame against what the frame then does; budgets. */
#include <lambent/lambent.h>

#include "../world.h"

enum { FRAME = 32, MAP = 16, FACES = 7, ELEMENTS = 64, BLOCKERS = 96 };
#include "../bounce_frame.h"

void test_plan_frame(void);

#if LMB_PLAN && LMB_TREES

static lmb_plan plan;
static lmb_stats stats;
static lmb_light lamps[2];
static float other[FRAME * FRAME * 3];

/* A floor, a wall and a block; a lamp over them and one that looks away. */
static lmb_frame set_frame(void)
{
    const lmb_view v = look(vec3(1.2f, 0.9f, 2.2f), vec3(-0.1f, -0.4f, 0), 60, FRAME);
    world_begin(0.7f, 0.6f, 0.5f);
    world_quad(vec3(0, -1, 0), Z, X);
    world_quad(vec3(0, 0, -1), X, Y);
    world_box(vec3(0.2f, -0.7f, 0.1f), 0.3f);
    lamps[0] = spot(vec3(0.3f, 1.4f, 0.8f), vec3(-0.2f, -1, -0.5f), 20, 40);
    lamps[1] = lamps[0];
    lamps[1].direction = vec3(0, 1, 0);
    world.scene.lights = lamps;
    world.scene.light_count = LMB_MAX_LIGHTS > 1 ? 2 : 1;
    CHECK(world_end() == LMB_OK);
    lmb_frame f = bounce_frame(&v, 1);
    f.error = f.visible = 0.1f;
    f.stats = &stats;
    memset(&stats, 0, sizeof stats);
    return f;
}

static void make_plan(const lmb_frame *f, const lmb_facts *facts)
{
    CHECK(lmb_render_begin(&render, f) == LMB_OK && lmb_plan_frame(&plan, &render, facts) == LMB_OK);
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

/* A look at all tiles of a small frame knows all of its pairs and segments. */
static void look_at(lmb_facts *out, const lmb_frame *f, lmb_look *at)
{
    lmb_frame quiet = *f;
    quiet.stats = NULL;
    memset(out, 0, sizeof *out);
    CHECK(lmb_render_frame(&render, &quiet) == LMB_OK);
    CHECK(lmb_render_survey(&places, &render, &scratch) == LMB_OK);
    CHECK(lmb_render_look(at, &render, &scratch, &places) == LMB_OK);
    out->tree = f->tree.size;
    out->shown = places.shown;
    for (int i = 0; i < LMB_FACT_TREES * LMB_FACT_RUNGS; ++i) {
        out->pairs[0][i / LMB_FACT_RUNGS][i % LMB_FACT_RUNGS] = (float)(at->pairs / at->pixels);
        out->segments[0][i / LMB_FACT_RUNGS][i % LMB_FACT_RUNGS] = (float)(at->segments / at->pixels);
    }
    out->open_pairs = 1.0f;
}

static void test_counts(void)
{
    static lmb_look at, twice;
    lmb_facts facts;
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
    CHECK(plan.row[LMB_PLAN_BLOCKERS].op[LMB_OP_BLOCKERS] == 16.0 && plan.work > 0.0 && plan.bytes > sizeof scratch);
    CHECK(lmb_plan_frame(&plan, &render, NULL) == LMB_ERR_ARG); /* it has gone on */
    /* Errors of looks: none against itself; a tenth of each pixel is a tenth, or more where light is uneven. */
    twice = at;
    CHECK(lmb_look_error(&twice, &at) == 0.0f);
    for (int i = 0; i < at.tiles * LMB_TILE_PIXELS; ++i) {
        for (int c = 0; c < 3; ++c) {
            twice.light[i][c] *= at.light[i][c] > 0.0f ? 1.1f : 1.0f;
        }
    }
    CHECK(lmb_look_error(&twice, &at) > 0.08f && lmb_look_error(&twice, &at) < 0.2f);
}

/* The same pixels by a picture that is gathered at every other one: as much light within a fiftieth. */
static void test_sparse_look(void)
{
    static lmb_look each, other_one;
    lmb_facts facts;
    lmb_frame f = set_frame();
    double sum[2] = {0.0, 0.0};
    f.gather_step = 2;
    look_at(&facts, &f, &other_one);
    render.frame.gather_step = 1;
    CHECK(lmb_render_look(&each, &render, &scratch, &places) == LMB_OK);
    for (int i = 0; i < LMB_LOOK_PIXELS; ++i) {
        sum[0] += (double)maxf(each.light[i][1], 0.0f);
        sum[1] += (double)maxf(other_one.light[i][1], 0.0f);
    }
    CHECK(each.pixels == other_one.pixels && other_one.pairs < 0.9 * each.pairs && sum[0] > 0.0);
    CHECK_MSG(fabs(sum[1] / sum[0] - 1.0) < 0.02, "%g of it", sum[1] / sum[0]);
    CHECK_MSG(lmb_look_error(&other_one, &each) > 0.0f && lmb_look_error(&other_one, &each) < 0.3f, "%g",
              (double)lmb_look_error(&other_one, &each));
}

/* Later bounces, of what shines the first too, lobes and what shines: their operations and bytes; after the frame, what
 * is kept. */
static void test_rows(void)
{
    lmb_frame f = set_frame();
    f.bounces = 3;
    world.material[0].specular[1] = 0.5f;
    world.material[0].roughness = 0.5f;
    world.material[0].emission[0] = 1.0f;
    memset(&render, 0, sizeof render);
    CHECK(lmb_render_next(&render, &f) == LMB_OK && lmb_plan_frame(&plan, &render, NULL) == LMB_OK);
    const lmb_plan_row *bounces = &plan.row[LMB_PLAN_BOUNCES];
    CHECK(bounces->why == LMB_WHY_RUNS && bounces->op[LMB_OP_ELEMENTS] == 16.0);
    CHECK(bounces->op[LMB_OP_CUTS] == 3.0 * ELEMENTS / LMB_TILE_PIXELS && bounces->work > 0.0);
    CHECK(bounces->bytes == lmb_elements_bytes(ELEMENTS));
    CHECK(plan.row[LMB_PLAN_LOBES].op[LMB_OP_LOBES] == FRAME * FRAME);
    CHECK(plan.row[LMB_PLAN_SHINE].op[LMB_OP_STORED] == FRAME * FRAME);
    finish();
    CHECK(lmb_render_next(&render, &f) == LMB_OK && lmb_plan_frame(&plan, &render, NULL) == LMB_OK);
    CHECK(bounces->why == LMB_WHY_KEPT && bounces->work == 0.0 && bounces->bytes == lmb_elements_bytes(ELEMENTS));
    memset(lamps[0].intensity, 0, sizeof lamps[0].intensity);
    memset(lamps[1].intensity, 0, sizeof lamps[1].intensity);
    make_plan(&f, NULL);
    CHECK(why_of(LMB_PLAN_DIRECT) == LMB_WHY_NO_LIGHT);
}

/* Groups in place of a tree: the points' bytes are theirs. */
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

enum { LARGE = 368 /* 2,116 tiles, of which 2,048 are asked and 192, or 80 blocks of four, looked at */ };
static uint32_t large_depth[LARGE * LARGE], large_id[LARGE * LARGE];
static float large_picture[LARGE * LARGE * 3];

/* Drawn whole, and its operations told by a look, by one step. */
static void survey_at(int32_t step)
{
    static lmb_look at;
    static lmb_survey again;
    lmb_frame f = set_frame();
    f.view = look(vec3(1.2f, 0.9f, 2.2f), vec3(-0.1f, -0.4f, 0), 60, LARGE);
    f.eye = target_of(LMB_DEPTH32F, LARGE, large_depth, large_id);
    CHECK(lmb_surface_init(&f.out, LMB_RGB32F, LARGE, LARGE, large_picture, sizeof large_picture) == LMB_OK);
    f.gather_step = step;
    CHECK(lmb_render_frame(&render, &f) == LMB_OK);
    render.frame.error = render.frame.visible = 0.8f;
    CHECK(lmb_render_survey(&places, &render, &scratch) == LMB_OK);
    CHECK(lmb_render_survey(&again, &render, &scratch) == LMB_OK);
    CHECK(places.count == again.count);
    CHECK(memcmp(places.weight, again.weight, sizeof(float) * (size_t)places.count) == 0);
    CHECK(places.tiles == (step > 1 ? LMB_SPARSE_TILES : 1) && places.surveyed * places.tiles <= LMB_SURVEY);
    CHECK(places.count >= (step > 1 ? LMB_LOOK_BLOCKS : LMB_LOOK_TILES) - 1 && places.count < places.surveyed / 2);
    render.frame.error = render.frame.visible = 0.1f;
    CHECK(lmb_render_look(&at, &render, &scratch, &places) == LMB_OK);
    const double of_all = (double)places.shown * LARGE * LARGE / at.pixels;
    const double pairs = at.pairs * of_all / (double)stats.pairs;
    const double segments = at.segments * of_all / (double)stats.segments;
    CHECK_MSG(fabs(pairs - 1.0) < 0.05 && fabs(segments - 1.0) < 0.1, "step %d: pairs %.3f, segments %.3f", (int)step,
              pairs, segments);
    render.frame.gather_step = 2; /* of single tiles there is no block */
    CHECK(lmb_render_look(&at, &render, &scratch, &places) == (step > 1 ? LMB_OK : LMB_ERR_ARG));
    CHECK(lmb_render_look(&at, &render, &scratch, NULL) == LMB_ERR_ARG);
    CHECK(lmb_render_survey(NULL, &render, &scratch) == LMB_ERR_ARG);
    CHECK(lmb_render_survey(&places, NULL, &scratch) == LMB_ERR_ARG);
}

static void test_surveys(void)
{
    survey_at(1);
    survey_at(4);
}

/* --- reasons ------------------------------------------------------------------------------------------------------ */

static void test_reasons(void)
{
    lmb_frame f = set_frame();
    make_plan(&f, NULL);
    CHECK(why_of(LMB_PLAN_GATHER) == LMB_WHY_RUNS && plan.row[LMB_PLAN_GATHER].proof == LMB_PROOF_RUNS);
    CHECK(why_of(LMB_PLAN_LOBES) == LMB_WHY_NO_LOBE && why_of(LMB_PLAN_SHINE) == LMB_WHY_NO_EMISSION);
    CHECK(plan.row[LMB_PLAN_LOBES].proof == LMB_PROOF_EXACT && why_of(LMB_PLAN_BOUNCES) == LMB_WHY_NOT_ASKED);
    CHECK(LMB_MAX_LIGHTS == 1 || (plan.light[1] == LMB_WHY_PAST && plan.faces == 2 && plan.faces_drawn == 1));
    f.show = LMB_SHOW_DIRECT;
    make_plan(&f, NULL);
    CHECK(why_of(LMB_PLAN_GATHER) == LMB_WHY_NOT_SHOWN && why_of(LMB_PLAN_DIRECT) == LMB_WHY_RUNS);
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
    CHECK(lmb_render_next(&render, &f) == LMB_OK);
    finish();
    CHECK(lmb_render_next(&render, &f) == LMB_OK && lmb_plan_frame(&plan, &render, NULL) == LMB_OK);
    CHECK(why_of(LMB_PLAN_MAPS) == LMB_WHY_KEPT && why_of(LMB_PLAN_POINTS) == LMB_WHY_KEPT);
    CHECK(why_of(LMB_PLAN_BLOCKERS) == LMB_WHY_KEPT && why_of(LMB_PLAN_VIEW) == LMB_WHY_KEPT);
    CHECK(why_of(LMB_PLAN_GATHER) == LMB_WHY_RUNS && plan.row[LMB_PLAN_MAPS].work == 0.0);
}

/* Two quads at a right angle have two planes with all on their fronts; the block takes that away. */
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
    f.everything = 1;
    make_plan(&f, NULL);
    CHECK(why_of(LMB_PLAN_OCCLUSION) == LMB_WHY_RUNS);
}

/* --- dim lights --------------------------------------------------------------------------------------------------- */

static double largest_change(void)
{
    double most = 0.0;
    for (int i = 0; i < FRAME * FRAME * 3; ++i) {
        const double d = fabs((double)picture[i] - (double)other[i]);
        most = d > most ? d : most;
    }
    return most;
}

/* The lamp is 2.4 m over the floor, nothing is nearer than 1.2 m: E = 5 / d^2. */
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
    lamps[0].position = vec3(0.2f, -0.4f, 0.1f); /* on the block: no bound */
    CHECK(lmb_render_frame(&render, &f) == LMB_OK && render.light_state[0] == 0);
}

/* --- budgets ------------------------------------------------------------------------------------------------------ */

static lmb_facts some_facts(void)
{
    lmb_facts f;
    memset(&f, 0, sizeof f);
    f.triangles = 1000.0;
    f.faces = f.lights = f.bounces = 1.0;
    f.tiles = 4800.0;
    f.shown = 1.0f;
    f.wanted_map = 512;
    f.tree = 256;
    for (int i = 0; i < LMB_FACT_TREES * LMB_FACT_RUNGS; ++i) {
        const int tree = i / LMB_FACT_RUNGS, rung = i % LMB_FACT_RUNGS;
        for (int step = 0; step < LMB_FACT_STEPS; ++step) {
            f.pairs[step][tree][rung] = 4000.0f / (float)(1 << (rung + tree / 2 + step));
            f.segments[step][tree][rung] = f.pairs[step][tree][rung];
            f.error[step][tree][rung] =
                0.004f * (float)(1 << rung) + 0.01f * (float)tree + 0.006f * (float)(step * (step + 1));
        }
    }
    f.open_error = 0.3f;
    f.open_pairs = 1.1f;
    return f;
}

static void test_budgets(void)
{
    const lmb_facts facts = some_facts();
    lmb_choice last, c;
    memset(&last, 0, sizeof last);
    for (int i = 0; i < 8; ++i) {
        const lmb_budget errors = {0.0, 0.02f * (float)(1 << i), 0};
        CHECK(lmb_plan_choose(&c, &facts, &errors, 0, 4096) == LMB_OK);
        CHECK_MSG(c.meets && c.error <= errors.error && (i == 0 || c.work <= last.work), "%g: %g, %g",
                  (double)errors.error, (double)c.error, c.work);
        CHECK(c.settings.visible == LMB_FACT_VISIBLE * c.settings.error);
        last = c;
        const lmb_budget work = {c.work, 0.0f, 0};
        CHECK(lmb_plan_choose(&c, &facts, &work, 0, 4096) == LMB_OK && c.meets && c.work <= work.work);
        CHECK_MSG(c.error <= last.error * 1.03f, "%g, %g", (double)c.error, (double)last.error);
    }
    const lmb_budget few = {0.0, 0.0f, 1u << 20}, none = {1.0, 0.0f, 0};
    CHECK(lmb_plan_choose(&c, &facts, &few, 0, 4096) == LMB_OK && c.meets);
    CHECK(c.bytes <= few.bytes && c.settings.tree < 128);
    CHECK(lmb_plan_choose(&c, &facts, &few, 2u << 20, 4096) == LMB_OK && !c.meets && c.bytes > 2u << 20);
    CHECK(lmb_plan_choose(&c, &facts, &none, 0, 4096) == LMB_OK && !c.meets && c.work > 1.0);
    CHECK(lmb_plan_choose(&c, &facts, &none, 0, 4) == LMB_ERR_ARG && lmb_plan_choose(NULL, &facts, &none, 0, 64) < 0);
}

void test_plan_frame(void)
{
    test_counts();
    test_sparse_look();
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
