/* test_reuse.c: layer 8: frames that keep unchanged data, against new ones: random edits, the same bytes. */
#include <lambent/lambent.h>

#include "../world.h"

void test_reuse(void);

#if LMB_PLAN && LMB_TREES

/* Sanitizers make frames about 20 times slower. */
#if defined(__SANITIZE_ADDRESS__)
enum { EDITS = 30 };
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
enum { EDITS = 30 };
#else
enum { EDITS = 400 };
#endif
#else
enum { EDITS = 400 };
#endif

enum { FRAME = 24, MAP = 16, LIGHTS = LMB_MAX_LIGHTS < 3 ? 1 : 3, FACES = 6 * LIGHTS, ELEMENTS = 64 };
enum { POINTS = 4 * MAP * MAP / 64 * FACES, TRIANGLES = 64 };

/* All memory of a frame. */
typedef struct state {
    uint32_t map[FACES * MAP * MAP * 2], depth[FRAME * FRAME], id[FRAME * FRAME];
    uint32_t tree[FACES * (MAP * MAP * 19 + 64)], bvh[TRIANGLES * 29 + 2048], elements[ELEMENTS * 44 + 64];
    lmb_point points[POINTS];
    uint32_t cells[MAP * MAP / 64 + 1];
    lmb_groups groups;
    lmb_band_scratch scratch;
    uint64_t lattice[FRAME * FRAME / 64 * 192], live_tree[1 << 15];
    lmb_live live;
    lmb_live_scratch live_scratch;
    lmb_render render;
    float out[FRAME * FRAME * 3];
} state;

static state kept, fresh;
static lmb_light lights[LIGHTS];
static lmb_frame how; /* the current settings */
static test_rng rng;

static void give_memory(lmb_frame *f, state *s)
{
    const uint32_t side = MAP / 8;
    f->map_memory = s->map;
    f->map_bytes = sizeof s->map;
    f->groups = &s->groups;
    f->scratch = &s->scratch;
    f->points.data = s->points;
    f->points.cap = POINTS;
    f->points.cells = s->cells;
    f->points.cell_cap = side * side + 1;
    f->eye = target_of(LMB_DEPTH32F, FRAME, s->depth, s->id);
    CHECK(lmb_tree_init(&f->tree, FACES, MAP, s->tree, sizeof s->tree) == LMB_OK);
    CHECK(lmb_bvh_init(&f->bvh, TRIANGLES, s->bvh, sizeof s->bvh) == LMB_OK);
    CHECK(lmb_elements_init(&f->elements, ELEMENTS, s->elements, sizeof s->elements) == LMB_OK);
    CHECK(lmb_surface_init(&f->out, LMB_RGB32F, FRAME, FRAME, s->out, sizeof s->out) == LMB_OK);
    f->live = &s->live;
    s->scratch.live = &s->live_scratch;
    CHECK(lmb_lattice_init(&f->lattice, FRAME, FRAME, s->lattice, sizeof s->lattice) == LMB_OK);
    CHECK(lmb_live_init(f->live, FACES, lmb_live_side(FACES, MAP), ELEMENTS, s->live_tree, sizeof s->live_tree) == LMB_OK);
}

static void set_scene(void)
{
    world_begin(0.7f, 0.6f, 0.5f);
    world_quad(vec3(0, -1, 0), Z, X);
    world_quad(vec3(0, 0, -1), X, Y);
    world_quad(vec3(-1, 0, 0), Y, Z);
    world_part();
    world_box(vec3(0.2f, -0.6f, 0.1f), 0.3f);
    world.scene.lights = lights;
    world.scene.light_count = LIGHTS;
    lights[0] = spot(vec3(0.2f, 1.5f, 0.8f), vec3(-0.1f, -1, -0.4f), 20, 40);
    for (int i = 1; i < LIGHTS; ++i) {
        lights[i] = i == 1 ? point_light(vec3(0.8f, 0.9f, 0.9f)) : sun(vec3(-0.5f, -1, -0.6f));
    }
    CHECK(world_end() == LMB_OK);
    how.kernels = picked_kernels();
    how.scene = &world.scene;
    how.view = look(vec3(1.5f, 0.8f, 2.5f), vec3(-0.2f, -0.3f, 0), 45, FRAME);
    how.shadow_map = MAP;
    how.grouping.method = LMB_GROUP_CUT;
    how.occlusion = LMB_OCCLUSION_EXACT;
    how.error = how.visibility = 0.1f;
    how.bounces = 2;
}

/* --- edits: each raises the revision that tells of it --------------------------------------------------------- */

static void move_object(void)
{
    world.instance[1].to_world.m[12 + test_random(&rng) % 3] += test_uniform(&rng, -0.2f, 0.2f);
    CHECK(world_end() == LMB_OK);
    ++world.scene.revision;
}

static void change_light(void)
{
    lmb_light *l = &lights[test_random(&rng) % LIGHTS];
    if (test_random(&rng) % 3 == 0) {
        l->intensity[0] = l->intensity[1] = l->intensity[2] = test_random(&rng) % 2 == 0 ? 0.0f : 4.0f;
    } else {
        l->position.x = test_uniform(&rng, -0.9f, 0.9f);
    }
    ++l->revision;
}

/* From one face to six and back: this moves the other shadow maps in memory. */
static void change_kind(void)
{
    const lmb_light was = lights[0];
    lights[0] = was.kind == LMB_LIGHT_SPOT ? point_light(vec3(0.2f, 1.5f, 0.8f))
                                                 : spot(vec3(0.2f, 1.5f, 0.8f), vec3(-0.1f, -1, -0.4f), 20, 40);
    memcpy(lights[0].intensity, was.intensity, sizeof was.intensity);
    lights[0].revision = was.revision + 1;
}

static void change_lights(void)
{
    world.scene.light_count = test_random(&rng) % (LIGHTS + 1);
    ++world.scene.lights_revision;
}

static void change_camera(void)
{
    how.view = look(vec3(test_uniform(&rng, 0.5f, 2.0f), 0.8f, 2.5f), vec3(-0.2f, -0.3f, 0), 45, FRAME);
}

static void change_instances(void)
{
    world.scene.instance_count = 3 - world.scene.instance_count;
    lmb_scene_bounds(&world.scene.bounds_min, &world.scene.bounds_max, &world.scene);
    CHECK(lmb_scene_check(&world.scene) == LMB_OK);
    ++world.scene.revision;
}

static void change_appearance(void)
{
    lmb_material *m = &world.material[test_random(&rng) % 2];
    float *c = test_random(&rng) % 3 == 0 ? m->emission : test_random(&rng) % 2 == 0 ? m->specular : m->albedo;
    c[test_random(&rng) % 3] = test_random(&rng) % 2 == 0 ? 0.0f : test_uniform(&rng, 0.1f, 0.9f);
    m->roughness = 0.4f;
    ++world.scene.appearance_revision;
}

static void turn_black(void)
{
    for (int i = 0; i < 2; ++i) {
        memset(world.material[i].albedo, 0, sizeof world.material[i].albedo);
        memset(world.material[i].emission, 0, sizeof world.material[i].emission);
    }
    ++world.scene.appearance_revision;
}

static void change_exposure(void) { how.exposure_ev = test_uniform(&rng, -2.0f, 2.0f); }

static void change_rules(void)
{
    how.error = test_uniform(&rng, 0.05f, 0.4f);
    how.visibility = test_random(&rng) % 2 == 0 ? 0.1f : 0.3f;
    how.bounces = how.grouping.method == LMB_GROUP_CUT ? 1 + (int32_t)(test_random(&rng) % 3) : 1;
    how.gather_step = how.grouping.method == LMB_GROUP_CUT && test_random(&rng) % 2 == 0 ? LMB_GATHER_LIVE : 1;
}

static void change_grouping(void)
{
    const int cut = test_random(&rng) % 2 == 0;
    how.grouping.method = cut ? LMB_GROUP_CUT : LMB_GROUP_ZONES;
    how.gather_step = cut ? how.gather_step : 1;
    how.occlusion = cut ? (test_random(&rng) % 2 == 0 ? LMB_OCCLUSION_EXACT : LMB_OCCLUSION_NONE) : LMB_OCCLUSION_VIEW;
    how.bounces = 1;
}

static void change_show(void) { how.show = (int32_t)(test_random(&rng) % 4); }
static void change_map(void) { how.shadow_map = how.shadow_map == MAP ? MAP / 2 : MAP; }
static void change_nothing(void) {}

/* --- against fresh frames ----------------------------------------------------------------------------------------- */

static void draw_reused(void)
{
    lmb_frame f = how;
    give_memory(&f, &kept);
    f.tree.size = f.grouping.method == LMB_GROUP_CUT && f.shadow_map < MAP ? f.shadow_map : f.tree.size;
    memset(kept.out, 0x5a, sizeof kept.out);
    memset(&kept.scratch, 0x5a, sizeof kept.scratch);
    kept.scratch.live = &kept.live_scratch;
    lmb_status status = lmb_render_reuse(&kept.render, &f);
    while (status == LMB_OK && kept.render.stage < LMB_STAGE_DONE) {
        status = lmb_render_step(&kept.render, 1 + (int32_t)(test_random(&rng) % 9));
        status = status == LMB_MORE ? LMB_OK : status;
    }
    CHECK_MSG(status == LMB_OK, "%s", lmb_status_name(status));
}

static void draw_fresh(int run_all)
{
    lmb_frame f = how;
    give_memory(&f, &fresh);
    f.tree.size = f.grouping.method == LMB_GROUP_CUT && f.shadow_map < MAP ? f.shadow_map : f.tree.size;
    f.run_all = run_all;
    memset(fresh.out, 0xa5, sizeof fresh.out);
    CHECK(lmb_render_frame(&fresh.render, &f) == LMB_OK);
}

static const struct edit {
    const char *name;
    void (*make)(void);
} edits[] = {
    {"object moves", move_object}, {"light changes", change_light}, {"its kind", change_kind},
    {"lights come and go", change_lights},
    {"camera", change_camera},     {"instances come and go", change_instances}, {"look", change_appearance},
    {"black", turn_black},         {"exposure", change_exposure},       {"rules", change_rules},
    {"grouping", change_grouping}, {"show", change_show},               {"map", change_map},
    {"nothing", change_nothing},
};

typedef struct counted_heap {
    int bvh, points, bounces, view, maps, texels, dark, no_bounce;
} counted_heap;

static void count(counted_heap *t)
{
    const lmb_render *r = &kept.render;
    t->bvh += (r->reuses & LMB_REUSE_BVH) != 0;
    t->points += (r->reuses & LMB_REUSE_POINTS) != 0;
    t->bounces += (r->reuses & LMB_REUSE_BOUNCES) != 0;
    t->view += (r->reuses & LMB_REUSE_VIEW) != 0;
    t->no_bounce += (r->skips & LMB_SKIP_BOUNCE) != 0;
    for (uint32_t i = 0; i < world.scene.light_count; ++i) {
        t->maps += (r->light_state[i] & LMB_SHADOW_MAP_REUSED) != 0;
        t->texels += (r->light_state[i] & LMB_LIGHT_TEXELS_REUSED) != 0;
        t->dark += (r->light_state[i] & LMB_LIGHT_DARK) != 0;
    }
}

static void test_edits(void)
{
    counted_heap t;
    int wrong = 0;
    memset(&t, 0, sizeof t);
    rng.state = 23;
    set_scene();
    for (int i = 0; i < EDITS && wrong == 0; ++i) {
        const struct edit *e = &edits[test_random(&rng) % (uint32_t)COUNT(edits)];
        e->make();
        draw_reused();
        draw_fresh(i & 1);
        count(&t);
        wrong += memcmp(kept.out, fresh.out, sizeof kept.out) != 0;
        CHECK_MSG(wrong == 0, "edit %d: %s", i, e->name);
    }
    if (EDITS >= 100) {
        CHECK_MSG(t.bvh > 20 && t.points > 5 && t.bounces > 10 && t.view > 50 && t.maps > 50 && t.texels > 20 &&
                      t.dark > 10 && t.no_bounce > 10,
                  "%d %d %d %d %d %d %d %d", t.bvh, t.points, t.bounces, t.view, t.maps, t.texels, t.dark, t.no_bounce);
    }
}

/* A change without a new revision is not noticed: the maps are those of the last frame. */
static void test_is_reused(void)
{
    rng.state = 3;
    memset(&how, 0, sizeof how);
    set_scene();
    memset(&kept.render, 0, sizeof kept.render);
    draw_reused();
    lights[0].position.x += 0.3f;
    draw_reused();
    draw_fresh(0);
    CHECK(memcmp(kept.out, fresh.out, sizeof kept.out) != 0);
    ++lights[0].revision;
    draw_reused();
    CHECK(memcmp(kept.out, fresh.out, sizeof kept.out) == 0);
    CHECK((kept.render.light_state[0] & LMB_SHADOW_MAP_REUSED) == 0);
    CHECK(LIGHTS == 1 || kept.render.light_state[1] == (LMB_SHADOW_MAP_REUSED | LMB_LIGHT_TEXELS_REUSED));
    CHECK((kept.render.reuses & LMB_REUSE_BVH) != 0 && (kept.render.reuses & LMB_REUSE_VIEW) != 0);
    CHECK((kept.render.reuses & LMB_REUSE_BOUNCES) == 0);
}

/* An abandoned frame, stopped anywhere, leaves no partial data behind. */
static void test_given_up(void)
{
    int reused_some = 0;
    rng.state = 5;
    memset(&how, 0, sizeof how);
    set_scene();
    draw_reused();
    for (int steps = 0; steps < 30; ++steps) {
        lmb_frame f = how;
        give_memory(&f, &kept);
        lights[0].position.x += steps % 2 ? 0.2f : -0.2f;
        ++lights[0].revision;
        move_object();
        CHECK(lmb_render_reuse(&kept.render, &f) == LMB_OK);
        for (int i = 0; i < steps && kept.render.stage < LMB_STAGE_DONE; ++i) {
            CHECK(lmb_render_step(&kept.render, 1) >= 0);
        }
        draw_reused();
        reused_some += kept.render.reuses != 0;
        draw_fresh(0);
        CHECK_MSG(memcmp(kept.out, fresh.out, sizeof kept.out) == 0, "given up after %d steps", steps);
    }
    CHECK(reused_some > 0 && reused_some < 30);
}

void test_reuse(void)
{
    memset(&how, 0, sizeof how);
    test_edits();
    test_is_reused();
    test_given_up();
    CHECK(lmb_render_reuse(NULL, &how) == LMB_ERR_ARG && lmb_render_reuse(&kept.render, NULL) == LMB_ERR_ARG);
}

#else

void test_reuse(void) {}

#endif
