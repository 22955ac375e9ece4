/* test_zeros.c: every public call with zeroed structs, null pointers and absurd numbers: it returns a status.
 *
 * tests/scripts/zeros.awk generates the table of calls from the headers, so none is missing. With the sanitizers (make
 * asan), this also checks for out-of-bounds access and undefined behaviour. */
#include <lambent/lambent.h>

#include "../../tools/demo/demo_scene.h"
#include "../../tools/render/ladder.h"
#include "../small_pack.h"
#include "../small_transfer.h"
#include "../sphere_relief.h"

void test_zeros(void);

#if LMB_TREES && LMB_DRAW && LMB_PROBES && LMB_VOXELS && LMB_MIXED && LMB_RELIEF && LMB_PLAN && LMB_TRANSFER

/* --- arguments ---------------------------------------------------------------------------------------------------- */

enum { ZERO, NOTHING, GOOD }; /* the target of a pointer; NOTHING: the pointer is NULL */

typedef struct argument {
    const char *type, *name;
    int kind;     /* of a pointer */
    void *memory; /* to be freed */
    int64_t whole;
    double value; /* of a number, and of the components of a vector */
} argument;

typedef struct parameter {
    const char *type, *name;
    int is_pointer;
} parameter;

typedef struct call {
    const char *name;
    int (*make)(argument *);
    int is_status, count;
    parameter parameter[12];
} call;

enum { ARRAY = 1 << 22 }; /* bytes of an array of unknown length */

static const char *at_call = ""; /* the current call */

static int calls_for(const char *name) { return strcmp(at_call, name) == 0; }

static const void *good_one(const argument *a, size_t *bytes);

/* A separate copy, so that a sanitizer detects its end. */
static void *pointer(argument *a, size_t bytes)
{
    size_t size;
    const void *good = good_one(a, &size);
    if (a->kind == NOTHING) {
        return NULL;
    }
    if (strcmp(a->type, "lmb_kernels") == 0) {
        return (void *)(uintptr_t)picked_kernels();
    }
    bytes = bytes > 0 && strcmp(a->type, "lmb_cluster") != 0 ? bytes : ARRAY; /* there are `count` clusters */
    a->memory = calloc(1, bytes);
    if (a->memory == NULL) {
        abort();
    }
    if (a->kind == GOOD && good != NULL) {
        memcpy(a->memory, good, size < bytes ? size : bytes);
    }
    return a->memory;
}

static int64_t whole(const argument *a) { return a->whole; }
static double number(const argument *a) { return a->value; }

static lmb_vec3 vector(const argument *a)
{
    const float v = (float)a->value;
    return strcmp(a->name, "up") == 0 ? vec3(0, v, 0) : strcmp(a->name, "target") == 0 ? vec3(v, v, 0) : vec3(v, v, v);
}

#include "calls.inc"

/* --- one good struct of each kind --------------------------------------------------------------------------------- */

enum { WIDE = 64, HIGH = 32, SIDE = 64, SMALL = 8, MIN = 4096 };

static struct {
    lmb_render begun, render; /* render: at LMB_STAGE_BANDS */
    lmb_points points;        /* of a face, not yet joined */
    lmb_surface metres;
    lmb_tile tile;
    lmb_many_lights many_lights, stream; /* built; not yet built */
    lmb_many_lights suns;
    lmb_live_sky live_sky;
    lmb_cloud cloud;
    lmb_planes planes;
    lmb_real_mesh mesh;
    lmb_env env;
    lmb_voxels voxels;
    lmb_cones cones;
    lmb_bins bins;
    lmb_cone_scratch cone_scratch;
    lmb_world world;
    lmb_world_pictures pictures;
    lmb_probe_table table;
    lmb_probe_blur blur;
    lmb_probe_cube cube;
    lmb_probe_lights lights;
    lmb_probe_cache cache;
    lmb_probe probe;
    lmb_survey survey;
    lmb_tile_sample query;
    lmb_groups groups;
    lmb_band_scratch scratch;
    lmb_glossy glossy;
    lmb_cut cut;
    lmb_live live;
    lmb_live_receiver live_receiver;
    lmb_irradiance irradiance[2];
    lmb_cut_params cut_params;
    lmb_element_scratch receiver;
    lmb_relight relight;
    lmb_occluder occluder;
    lmb_hull hull;
    lmb_frame_settings settings;
    lmb_transfer transfer;
    lmb_transfer_light transfer_light;
    lmb_gouraud gouraud;
    lmb_draw_target draw_target;
    lmb_draw_state draw_state;
    lmb_draw_vertices draw_vertices;
    lmb_draw_indices draw_indices;
    lmb_draw_lit draw_lit;
    lmb_draw_lighting draw_lighting;
    lmb_blit_image blit_image;
    lmb_blit_how blit_how;
    uint32_t *transfer_file;
    size_t transfer_bytes;
    lmb_pack pack;
    lmb_scene pack_scene;
    uint32_t *pack_file;
    size_t pack_bytes;
    lmb_fixed fixed;
    lmb_fixed_frame fixed_frame;
} g;

/* The room that the ports show. */
static const uint32_t fixed_file[] = {
#include "../../platform/demo/room_data.inc"
};
static const int32_t fixed_places[2][3] = {{0, 400, 700}, {0, 300, -300}};

/* Memory for a valid argument; 0 frees all. */
static void *room(size_t bytes)
{
    static void *all[64];
    static int count;
    for (; bytes == 0 && count > 0; --count) {
        free(all[count - 1]);
    }
    CHECK(count < COUNT(all));
    return bytes > 0 ? all[count++] = calloc(1, bytes) : NULL;
}

static void make_frame(void)
{
    lmb_frame f;
    const size_t map = lmb_shadow_map_bytes(1, SIDE, LMB_ID32) * 2, tree = lmb_tree_bytes(6, SIDE),
                 points = lmb_points_bytes(MIN, SIDE / 8), bvh = lmb_bvh_bytes(MIN * 4),
                 elements = lmb_elements_bytes(MIN);
    memset(&f, 0, sizeof f);
    f.kernels = picked_kernels();
    f.scene = demo_scene();
    f.view = demo_view(WIDE, HIGH);
    f.shadow_map = SIDE;
    f.grouping.method = LMB_GROUP_CUT;
    f.occlusion = LMB_OCCLUSION_EXACT;
    f.error = f.visibility = 0.1f;
    f.bounces = 2;
    f.map_memory = room(map);
    f.map_bytes = map;
    f.groups = &g.groups;
    f.scratch = &g.scratch;
    CHECK(lmb_tree_init(&f.tree, 6, SIDE, room(tree), tree) == LMB_OK);
    const size_t live = lmb_live_bytes(6, lmb_live_side(6, SIDE), MIN);
    CHECK(lmb_live_init(&g.live, 6, lmb_live_side(6, SIDE), MIN, room(live), live) == LMB_OK);
    CHECK(lmb_points_init(&f.points, MIN, SIDE / 8, room(points), points) == LMB_OK);
    CHECK(lmb_bvh_init(&f.bvh, MIN * 4, room(bvh), bvh) == LMB_OK);
    CHECK(lmb_elements_init(&f.elements, MIN, room(elements), elements) == LMB_OK);
    CHECK(lmb_surface_init(&f.eye.depth, LMB_DEPTH32F, WIDE, HIGH, room(WIDE * HIGH * 4), WIDE * HIGH * 4) == LMB_OK);
    CHECK(lmb_surface_init(&f.eye.id, LMB_ID32, WIDE, HIGH, room(WIDE * HIGH * 4), WIDE * HIGH * 4) == LMB_OK);
    CHECK(lmb_surface_init(&f.out, LMB_RGB32F, WIDE, HIGH, room(WIDE * HIGH * 12), WIDE * HIGH * 12) == LMB_OK);
    CHECK(lmb_render_begin(&g.render, &f) == LMB_OK);
    g.begun = g.render;
    while (g.render.stage < LMB_STAGE_BANDS && lmb_render_step(&g.render, 100) == LMB_MORE) {
    }
    CHECK(g.render.stage == LMB_STAGE_BANDS);
    CHECK(lmb_resolve_tile(&g.tile, f.kernels, &f.view, f.scene, &f.eye, 0, 0) == LMB_OK && g.tile.hits > 0);
    lmb_grouping zones;
    memset(&zones, 0, sizeof zones);
    lmb_points *const two[2] = {&g.render.frame.points, &g.points};
    CHECK(lmb_points_init(&g.points, MIN, SIDE / 8, room(points), points) == LMB_OK);
    for (int i = 0; i < 2; ++i) {
        CHECK(lmb_points_collect(two[i], f.kernels, &g.scratch.tile, f.scene, &f.scene->lights[0], &g.render.maps[0], 0,
                                 0, SIDE / 8, &zones) == LMB_OK);
    }
    CHECK(lmb_discs_join(&g.render.frame.points, &g.render.maps[0], &zones) == LMB_OK);
    CHECK(lmb_group_points(&g.groups, &g.render.frame.points, &zones, NULL) == LMB_OK);
    ladder_places(&g.survey, &g.render.frame.view, 4);
    CHECK(lmb_render_sample(&g.query, &g.render, &g.scratch, &g.survey, 0.0) == LMB_OK);
    CHECK(lmb_surface_init(&g.metres, LMB_R32F, WIDE, HIGH, room(WIDE * HIGH * 4), WIDE * HIGH * 4) == LMB_OK);
    CHECK(lmb_bins_build(&g.bins, picked_kernels(), &g.render.frame.view, demo_scene(), 1, 100, 0, NULL, NULL) == LMB_OK);
    const lmb_cut_params cut_params = {.error = 0.1f, .visibility = 0.1f, .bvh = &g.render.frame.bvh};
    const lmb_element_scratch receiver = {f.kernels, &g.cut, &g.scratch.tile, &g.irradiance[0], &g.irradiance[1]};
    const lmb_occluder occluder = {&g.render.frame.view, &g.render.frame.eye.depth, LMB_OCCLUSION_VIEW, 8};
    g.settings.kernels = picked_kernels();
    g.settings.scene = f.scene;
    g.settings.view = f.view;
    g.settings.shadow_map = SIDE;
    g.settings.show = LMB_SHOW_DIRECT; /* otherwise it needs more than ARRAY bytes */
    g.cut_params = cut_params;
    g.receiver = receiver;
    g.occluder = occluder;
}

static const lmb_axes straight = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
static const lmb_pinhole camera = {WIDE, HIGH, 60, 60, 31.5f, 23.5f};

static void make_photo(void)
{
    float *depth = room(WIDE * HIGH * sizeof *depth);
    const size_t cloud = lmb_cloud_bytes(WIDE, HIGH), planes = lmb_planes_bytes(WIDE, HIGH),
                 mesh = lmb_real_mesh_bytes(WIDE, HIGH, 4), env = lmb_env_bytes(SMALL);
    for (int i = 0; i < WIDE * HIGH; ++i) {
        depth[i] = i / WIDE < HIGH / 2 ? 3.0f : 3.0f * 60.0f / (60.0f + 2.0f * (float)(i / WIDE - HIGH / 2));
    }
    CHECK(lmb_cloud_init(&g.cloud, &camera, depth, room(cloud), cloud) == LMB_OK);
    CHECK(lmb_cloud_normals(&g.cloud, 0, LMB_MAX_SIDE) == LMB_OK);
    CHECK(lmb_planes_find(&g.planes, &g.cloud, room(planes), planes) == LMB_OK && g.planes.count > 1);
    CHECK(lmb_real_mesh_build(&g.mesh, &g.cloud, &g.planes, 4, &straight, room(mesh), mesh) == LMB_OK);
    CHECK(lmb_env_init(&g.env, SMALL, room(env), env) == LMB_OK);
}

static void make_voxels(void)
{
    const lmb_scene *scene = demo_scene();
    const size_t bytes = lmb_voxels_bytes(3 * MIN, LMB_VOXELS_THREE), many_lights = lmb_many_lights_bytes(16);
    const lmb_voxel_part part = {scene, 1, lmb_scene_triangles(scene), {1, 1}};
    CHECK(lmb_voxels_init(&g.voxels, 3 * MIN, LMB_VOXELS_THREE, room(bytes), bytes) == LMB_OK);
    CHECK(lmb_voxels_build(&g.voxels, &scene->bounds_min, &scene->bounds_max, 5, &part, 1) == LMB_OK);
    CHECK(lmb_cones_init(&g.cones, &g.voxels, 7) == LMB_OK);
    CHECK(lmb_many_lights_init(&g.many_lights, 16, vec3(-9, -9, -9), vec3(9, 9, 9), 1e4f, room(many_lights),
                               many_lights) == LMB_OK);
    CHECK(lmb_many_lights_init(&g.stream, 16, vec3(-9, -9, -9), vec3(9, 9, 9), 1e4f, room(many_lights), many_lights) ==
          LMB_OK);
    for (int i = 0; i < 3; ++i) {
        const lmb_light l = point_light(vec3((float)i, 1, 1));
        CHECK(lmb_many_lights_add(&g.many_lights, &l, 1) == LMB_OK);
    }
    CHECK(lmb_many_lights_build(&g.many_lights) == LMB_OK && g.many_lights.lights == 3);
    const size_t sky = lmb_live_sky_bytes(16);
    lmb_light sun = point_light(vec3(0, 1, 0));
    sun.kind = LMB_LIGHT_DIRECTIONAL;
    sun.direction = vec3(0, -1, 0);
    CHECK(lmb_many_lights_init(&g.suns, 16, vec3(0, 0, 0), vec3(0, 0, 0), 1e4f, room(many_lights), many_lights) ==
          LMB_OK);
    CHECK(lmb_many_lights_add(&g.suns, &sun, 1) == LMB_OK && lmb_many_lights_build(&g.suns) == LMB_OK);
    CHECK(lmb_live_sky_init(&g.live_sky, 16, room(sky), sky) == LMB_OK);
    lmb_hull_find(&g.hull, scene);
}

static void make_probe(void)
{
    const size_t table = lmb_probe_table_bytes(32, 16), cube = lmb_probe_cube_bytes(SMALL);
    const lmb_probe_policy policy = {0.1f, 2};
    lmb_world_pictures *p = &g.pictures;
    for (int i = 0; i < 6; ++i) {
        p->face[i] = room(SMALL * SMALL * 3 * sizeof(float));
    }
    p->face_size = SMALL;
    p->radius = 5.0f;
    const size_t world_bytes = lmb_world_bytes(p, LMB_WORLD_F32);
    CHECK(lmb_world_init(&g.world, p, LMB_WORLD_F32, room(world_bytes), world_bytes) == LMB_OK);
    CHECK(lmb_probe_table_init(&g.table, 32, 16, 0.0f, room(table), table) == LMB_OK);
    const size_t blur = lmb_probe_blur_bytes(&g.table, 1);
    CHECK(lmb_probe_blur_init(&g.blur, &g.table, 1, room(blur), blur) == LMB_OK);
    CHECK(lmb_probe_cube_init(&g.cube, room(6 * SMALL * SMALL * 12), SMALL, room(cube), cube) == LMB_OK);
    CHECK(lmb_probe_reduce(&g.lights, picked_kernels(), room(32 * 16 * 12), &g.table) == LMB_OK);
    CHECK(lmb_probe_cache_init(&g.cache, 4, &policy) == LMB_OK);
    g.probe.irradiance = g.probe.glossy = g.cube;
    lmb_relight *r = &g.relight;
    r->kernels = picked_kernels();
    r->scene = demo_scene();
    r->maps = g.render.maps;
    r->world = &g.world;
    r->probes = &g.probe;
    r->probe_of = room(r->scene->instance_count * sizeof *r->probe_of);
    r->probe_count = 1;
    r->view = g.render.frame.view;
    r->eye = g.render.frame.eye;
}

static void make_transfer(void)
{
    g.transfer_file = room(4 * SMALL_TRANSFER_WORDS(lmb_scene_triangles(demo_scene())));
    g.transfer_bytes = small_transfer(g.transfer_file, demo_scene());
    CHECK(lmb_transfer_open(&g.transfer, g.transfer_file, g.transfer_bytes) == LMB_OK);
    const size_t bytes = lmb_transfer_light_bytes(&g.transfer);
    CHECK(lmb_transfer_light_init(&g.transfer_light, &g.transfer, room(bytes), bytes) == LMB_OK);
    g.gouraud.scene = demo_scene();
    g.transfer_light.place = room(g.transfer.count[LMB_TRANSFER_AREAS] * sizeof *g.transfer_light.place);
    g.gouraud.transfer = &g.transfer;
    g.gouraud.light = &g.transfer_light;
    g.gouraud.direct = room(SMALL_RECEIVERS * sizeof *g.gouraud.direct);
    g.gouraud.scratch = room(sizeof *g.gouraud.scratch);
    g.gouraud.depth = room(24 * 16 * sizeof *g.gouraud.depth);
    g.gouraud.view = demo_view(24, 16);
    CHECK(lmb_surface_init(&g.gouraud.out, LMB_RGB565, 24, 16, room(24 * 16 * 2), 24 * 16 * 2) == LMB_OK);
}

static void make_pack(void)
{
    g.pack_file = room(4 * SMALL_PACK_WORDS);
    g.pack_bytes = small_pack(g.pack_file);
    CHECK(lmb_pack_open(&g.pack, g.pack_file, g.pack_bytes) == LMB_OK);
    const size_t bytes = lmb_pack_bytes(&g.pack);
    CHECK(lmb_pack_scene(&g.pack_scene, &g.pack, room(bytes), bytes) == LMB_OK);
}

static void make_fixed(void)
{
    lmb_fixed_frame *f = &g.fixed_frame;
    CHECK(lmb_fixed_open(&g.fixed, fixed_file, sizeof fixed_file) == LMB_OK);
    const size_t bytes = lmb_fixed_memory(&g.fixed, g.fixed.triangles);
    CHECK(lmb_fixed_lay(f, &g.fixed, g.fixed.triangles, room(bytes), bytes) == LMB_OK);
    f->view.width = WIDE, f->view.height = HIGH;
    f->view.focal = 1000, f->view.near_units = 128;
    CHECK(lmb_fixed_look_at(&f->view, fixed_places[0], fixed_places[1]) == LMB_OK);
    f->lamp.position[1] = 1000;
    f->lamp.intensity[0] = f->lamp.intensity[1] = f->lamp.intensity[2] = 9000;
    f->pixel = room(WIDE * HIGH * sizeof *f->pixel);
    f->depth = room(WIDE * HIGH * sizeof *f->depth);
}

static const stage *relief;

typedef struct known {
    const char *type;
    const void *data;
    size_t bytes;
} known;

/* Arguments that one call needs different from the others. */
static int good_for_call(known *out, const argument *a)
{
    if (calls_for("lmb_plan_frame") || calls_for("lmb_render_part") || calls_for("lmb_render_parts_done")) {
        *out = (known){"lmb_render", &g.begun, sizeof g.begun};
    } else if (calls_for("lmb_many_lights_add") || calls_for("lmb_many_lights_build")) {
        *out = (known){"lmb_many_lights", &g.stream, sizeof g.stream};
    } else if (calls_for("lmb_many_lights_sky") && strcmp(a->name, "many_lights") == 0) {
        *out = (known){"lmb_many_lights", &g.suns, sizeof g.suns};
    } else if (calls_for("lmb_gbuffer_band") && strcmp(a->name, "depth") == 0) {
        *out = (known){"lmb_surface", &g.metres, sizeof g.metres};
    } else if (calls_for("lmb_depth_linearize")) {
        *out = (known){"lmb_surface", &g.render.frame.eye.depth, sizeof g.render.frame.eye.depth};
    } else if (calls_for("lmb_relief_open") || calls_for("lmb_relief_swap")) {
        *out = (known){"void", relief->file.data, relief->file.size};
    } else if (calls_for("lmb_transfer_open")) {
        *out = (known){"void", g.transfer_file, g.transfer_bytes};
    } else if (calls_for("lmb_fixed_open")) {
        *out = (known){"void", fixed_file, sizeof fixed_file};
    } else if (calls_for("lmb_fixed_look_at")) {
        *out = (known){"int32_t", fixed_places[strcmp(a->name, "target") == 0], sizeof fixed_places[0]};
    } else if (calls_for("lmb_pack_open")) {
        *out = (known){"void", g.pack_file, g.pack_bytes};
    } else if (calls_for("lmb_blit") || calls_for("lmb_text")) {
        *out = (known){"lmb_surface", &g.draw_target.colour, sizeof g.draw_target.colour};
    } else if (calls_for("lmb_pack_pose") || calls_for("lmb_pack_view")) {
        *out = (known){"lmb_scene", &g.pack_scene, sizeof g.pack_scene};
    } else {
        return 0;
    }
    return strcmp(out->type, a->type) == 0;
}

static const void *good_one(const argument *a, size_t *bytes)
{
    known own;
    if (good_for_call(&own, a)) {
        *bytes = own.bytes;
        return own.data;
    }
    const lmb_frame *f = &g.render.frame;
    static lmb_many_lights_query many_lights_query;
    static lmb_world_query world_query;
    static lmb_voxel_part part;
    static lmb_cone_trace trace;
    many_lights_query.many_lights = &g.many_lights;
    world_query.world = &g.world;
    part.scene = demo_scene();
    part.first_id = part.count = 1;
    trace.kernels = picked_kernels();
    trace.voxels = &g.voxels;
    trace.scratch = &g.cone_scratch;
    const known all[] = {
        {"lmb_axes", &straight, sizeof straight},
        {"lmb_bins", &g.bins, sizeof g.bins},
        {"lmb_bvh", &f->bvh, sizeof f->bvh},
        {"lmb_cloud", &g.cloud, sizeof g.cloud},
        {"lmb_cone_trace", &trace, sizeof trace},
        {"lmb_cone_width", g.cones.width, sizeof *g.cones.width},
        {"lmb_cones", &g.cones, sizeof g.cones},
        {"lmb_cut_params", &g.cut_params, sizeof g.cut_params},
        {"lmb_elements", &f->elements, sizeof f->elements},
        {"lmb_env", &g.env, sizeof g.env},
        {"lmb_frame", f, sizeof *f},
        {"lmb_frame_settings", &g.settings, sizeof g.settings},
        {"lmb_groups", &g.groups, sizeof g.groups},
        {"lmb_hull", &g.hull, sizeof g.hull},
        {"lmb_fixed", &g.fixed, sizeof g.fixed},
        {"lmb_light", f->scene->lights, sizeof *f->scene->lights},
        {"lmb_shadow_map", g.render.maps, sizeof *g.render.maps},
        {"lmb_tile_sample", &g.query, sizeof g.query},
        {"lmb_many_lights", &g.many_lights, sizeof g.many_lights},
        {"lmb_many_lights_query", &many_lights_query, sizeof many_lights_query},
        {"lmb_occluder", &g.occluder, sizeof g.occluder},
        {"lmb_pack", &g.pack, sizeof g.pack},
        {"lmb_pinhole", &camera, sizeof camera},
        {"lmb_planes", &g.planes, sizeof g.planes},
        {"lmb_points", &g.points, sizeof g.points},
        {"lmb_probe_blur", &g.blur, sizeof g.blur},
        {"lmb_probe_cache", &g.cache, sizeof g.cache},
        {"lmb_probe_cube", &g.cube, sizeof g.cube},
        {"lmb_probe_lights", &g.lights, sizeof g.lights},
        {"lmb_probe_policy", &g.cache.policy, sizeof g.cache.policy},
        {"lmb_probe_table", &g.table, sizeof g.table},
        {"lmb_real_mesh", &g.mesh, sizeof g.mesh},
        {"lmb_element_scratch", &g.receiver, sizeof g.receiver},
        {"lmb_relief", &relief->relief, sizeof relief->relief},
        {"lmb_relight", &g.relight, sizeof g.relight},
        {"lmb_render", &g.render, sizeof g.render},
        {"lmb_scene", f->scene, sizeof *f->scene},
        {"lmb_mesh", f->scene->meshes, sizeof *f->scene->meshes},
        {"lmb_surface", &f->out, sizeof f->out},
        {"lmb_survey", &g.survey, sizeof g.survey},
        {"lmb_target", &f->eye, sizeof f->eye},
        {"lmb_tile", &g.tile, sizeof g.tile},
        {"lmb_transfer", &g.transfer, sizeof g.transfer},
        {"lmb_transfer_light", &g.transfer_light, sizeof g.transfer_light},
        {"lmb_gouraud", &g.gouraud, sizeof g.gouraud},
        {"lmb_fixed_frame", &g.fixed_frame, sizeof g.fixed_frame},
        {"lmb_fixed_view", &g.fixed_frame.view, sizeof g.fixed_frame.view},
        {"lmb_tree", &f->tree, sizeof f->tree},
        {"lmb_live", &g.live, sizeof g.live},
        {"lmb_live_sky", &g.live_sky, sizeof g.live_sky},
        {"lmb_live_receiver", &g.live_receiver, sizeof g.live_receiver},
        {"lmb_draw_target", &g.draw_target, sizeof g.draw_target},
        {"lmb_draw_state", &g.draw_state, sizeof g.draw_state},
        {"lmb_draw_vertices", &g.draw_vertices, sizeof g.draw_vertices},
        {"lmb_draw_indices", &g.draw_indices, sizeof g.draw_indices},
        {"lmb_draw_lit", &g.draw_lit, sizeof g.draw_lit},
        {"lmb_draw_lighting", &g.draw_lighting, sizeof g.draw_lighting},
        {"lmb_blit_image", &g.blit_image, sizeof g.blit_image},
        {"lmb_blit_how", &g.blit_how, sizeof g.blit_how},
        {"lmb_view", &f->view, sizeof f->view},
        {"lmb_voxel_part", &part, sizeof part},
        {"lmb_voxels", &g.voxels, sizeof g.voxels},
        {"lmb_world", &g.world, sizeof g.world},
        {"lmb_world_query", &world_query, sizeof world_query},
        {"lmb_world_pictures", &g.pictures, sizeof g.pictures},
    };
    for (int i = 0; i < COUNT(all); ++i) {
        if (strcmp(all[i].type, a->type) == 0) {
            *bytes = all[i].bytes;
            return all[i].data;
        }
    }
    return NULL; /* scratch or output: zeros are fine */
}

/* --- calls -------------------------------------------------------------------------------------------------------- */

/* A valid number for an argument, chosen by name. */
static void set_number(argument *a)
{
    static const struct {
        const char *name;
        int value;
    } all[] = {
        {"x", 0},       {"y", 0},      {"camera", 0},      {"x0", 0},         {"y0", 0},        {"face", 0},   {"into", 0}, {"first", 0},
        {"tile_y0", 0}, {"band", 0},   {"part", 0},       {"p", 0},         {"from", 0},   {"k", 4},    {"slots", 4},
        {"step", 4},    {"depth", 5},  {"id_format", LMB_ID32}, {"n", SIDE}, {"side", SMALL}, {"size", SIDE},
        {"width", WIDE}, {"height", HIGH}, {"max", SIDE}, {"terms", 9}, {"c", 0}, {"field", 0}, {"level", 0},
        {"bytes", ARRAY}, {"units", 100}, {"pixels", -1}, {"known", 1}, {"last", 0}, {"cells", 16}, {"corners", 3},
    };
    static const struct {
        const char *call, *name;
        int value;
    } own[] = {
        {"lmb_probe_blur_init", "terms", 1},
        {"lmb_voxels_init", "cap", 5000},
        {"lmb_cones_init", "count", 7},
        {"lmb_live_collect", "light", 0},
        {"lmb_view_sample", "samples", 4},
        {"lmb_draw_list", "primitive", LMB_DRAW_QUADS},
        {"lmb_clusters_build", "count", 1 << 17},
        {"lmb_pack_place_light", "i", 0},
    };
    a->whole = 1;
    a->value = 0.5;
    for (int i = 0; i < COUNT(all); ++i) {
        a->whole = strcmp(a->name, all[i].name) == 0 ? all[i].value : a->whole;
    }
    for (int i = 0; i < COUNT(own); ++i) {
        a->whole = calls_for(own[i].call) && strcmp(a->name, own[i].name) == 0 ? own[i].value : a->whole;
    }
    if (calls_for("lmb_transfer_open") && strcmp(a->name, "bytes") == 0) {
        a->whole = (int64_t)g.transfer_bytes; /* exact, without a spare byte */
    }
    if (calls_for("lmb_fixed_open") && strcmp(a->name, "bytes") == 0) {
        a->whole = (int64_t)sizeof fixed_file;
    }
    if (calls_for("lmb_pack_open") && strcmp(a->name, "bytes") == 0) {
        a->whole = (int64_t)g.pack_bytes;
    }
}

/* Sizes of memory, which only the caller can guarantee. */
static int is_vouched_for(const char *name)
{
    return strcmp(name, "bytes") == 0 || strcmp(name, "count") == 0 || strcmp(name, "cap") == 0 ||
           strcmp(name, "from") == 0;
}

/* Makes the call with pointers of `kind` and, if they are GOOD, valid numbers, but with argument `odd` of kind
 * `odd_kind` or with the absurd number. */
static int make_call(const call *c, int kind, int odd, int odd_kind, int64_t whole_absurd, double absurd)
{
    argument a[12];
    at_call = c->name;
    for (int i = 0; i < c->count; ++i) {
        memset(&a[i], 0, sizeof a[i]);
        a[i].type = c->parameter[i].type;
        a[i].name = c->parameter[i].name;
        a[i].kind = i == odd ? odd_kind : kind;
        if (kind == GOOD) {
            set_number(&a[i]);
        }
        if (i == odd) {
            a[i].whole = whole_absurd;
            a[i].value = absurd;
        }
    }
    const int status = c->make(a);
    for (int i = 0; i < c->count; ++i) {
        free(a[i].memory);
    }
    return status;
}

static int is_pointer(const call *c, int i) { return c->parameter[i].is_pointer; }

static void absurd_numbers(const call *c, int i)
{
    static const int64_t wholes[] = {0, -1, 7, INT32_MAX, INT32_MIN};
    static const double reals[] = {0.0, -1.0, (double)NAN, (double)INFINITY, -(double)INFINITY, 3e38, 1e-44};
    for (int k = 0; k < COUNT(wholes); ++k) {
        make_call(c, GOOD, i, GOOD, wholes[k], 0.5);
    }
    for (int k = 0; k < COUNT(reals); ++k) {
        make_call(c, GOOD, i, GOOD, 1, reals[k]);
    }
}

static int pointers_of(const call *c)
{
    int n = 0;
    for (int i = 0; i < c->count; ++i) {
        n += is_pointer(c, i);
    }
    return n;
}

/* Zeros that are no error: no pixel, no face or an empty scene, so there is nothing to do. */
static int may_be_empty(const char *name)
{
    static const char *const all[] = {
        "lmb_gather_tile", "lmb_compose_tile",    "lmb_compose_emission",  "lmb_compose_glossy",  "lmb_direct_tile",
        "lmb_glossy_direct", "lmb_shadow_map_clear", "lmb_shadow_map_draw", "lmb_shadow_map_rows", "lmb_around_scale",
        "lmb_delta_tile",  "lmb_scene_check",     "lmb_clusters_build",
    };
    int is_one = 0;
    for (int i = 0; i < COUNT(all); ++i) {
        is_one |= strcmp(name, all[i]) == 0;
    }
    return is_one;
}

static void test_call(const call *c)
{
    const int zeros = make_call(c, ZERO, -1, 0, 0, 0.0), nothing = make_call(c, NOTHING, -1, 0, 0, 0.0);
    if (c->is_status && pointers_of(c) > 0) {
        CHECK_MSG(nothing < 0, "%s(NULL, ..): %s", c->name, lmb_status_name((lmb_status)nothing));
        CHECK_MSG(zeros < 0 || may_be_empty(c->name), "%s of zeros: %s", c->name, lmb_status_name((lmb_status)zeros));
        const int good = make_call(c, GOOD, -1, 0, 0, 0.0);
        CHECK_MSG(good >= 0, "%s as it should be: %s", c->name, lmb_status_name((lmb_status)good));
    }
    for (int i = 0; i < c->count; ++i) {
        if (is_pointer(c, i)) {
            make_call(c, ZERO, i, NOTHING, 0, 0.0);
            make_call(c, GOOD, i, ZERO, 0, 0.0);
            make_call(c, GOOD, i, NOTHING, 0, 0.0);
        } else if (!is_vouched_for(c->parameter[i].name)) {
            absurd_numbers(c, i);
        }
    }
}

/* Absurd values in more than one argument, or inside a struct. */
static void test_named(void)
{
    const float min = LMB_ALBEDO_MIN, max = LMB_ALBEDO_MAX;
    const float albedo[3] = {lmb_real_albedo(INFINITY, INFINITY), lmb_real_albedo(NAN, 1.0f),
                             lmb_real_albedo(1.0f, NAN)};
    for (int i = 0; i < 3; ++i) {
        CHECK_MSG(albedo[i] >= min && albedo[i] <= max, "%d: %g", i, (double)albedo[i]);
    }
    lmb_axes bent = straight;
    float rgb[3 * WIDE] = {0};
    CHECK(lmb_env_fold(&g.env, rgb, WIDE, 1, &bent) == LMB_OK);
    bent.up.y = NAN;
    CHECK(lmb_env_fold(&g.env, rgb, WIDE, 1, &bent) == LMB_ERR_ARG);
    lmb_render none;
    memset(&none, 0, sizeof none);
    CHECK(lmb_render_step(&none, 1) == LMB_ERR_ARG && lmb_render_has_parts(&none) == 0);
}

static void make_drawing(void)
{
    static uint32_t colours[WIDE * HIGH], texels[4];
    static float depth[WIDE * HIGH];
    static const float corners[4][3] = {{0, 0, 0.5f}, {0, 8, 0.5f}, {8, 8, 0.5f}, {8, 0, 0.5f}};
    static const uint8_t order[4] = {0, 1, 2, 3};
    static uint8_t lit[4][4];
    CHECK(lmb_surface_init(&g.draw_target.colour, LMB_RGBA8, WIDE, HIGH, colours, sizeof colours) == LMB_OK);
    CHECK(lmb_surface_init(&g.draw_target.depth, LMB_DEPTH32F, WIDE, HIGH, depth, sizeof depth) == LMB_OK);
    CHECK(lmb_draw_state_init(&g.draw_state, WIDE, HIGH) == LMB_OK && lmb_draw_pixels(&g.draw_state) == LMB_OK);
    g.draw_state.flags = LMB_DRAW_DEPTH_TEST | LMB_DRAW_BLEND;
    g.draw_vertices.positions = corners;
    g.draw_vertices.count = 4;
    g.draw_indices = (lmb_draw_indices){order, 4, LMB_DRAW_INDEX_U8};
    for (int i = 0; i < 16; i += 5) {
        g.draw_lighting.to_eye.m[i] = 1.0f;
    }
    g.draw_lit.colours = lit[0];
    g.blit_image = (lmb_blit_image){texels, NULL, 2, 2, 8, LMB_RGBA8};
    g.blit_how = (lmb_blit_how){{0, 0, 2, 2}, 1, 0, 0, 255};
}

void test_zeros(void)
{
    stage *s = stage_make(LMB_RELIEF_FULL, 0);
    relief = s;
    make_frame();
    make_photo();
    make_voxels();
    make_probe();
    make_transfer();
    make_pack();
    make_fixed();
    make_drawing();
    for (int i = 0; i < COUNT(calls); ++i) {
        test_call(&calls[i]);
    }
    test_named();
    stage_free(s);
    room(0);
}

#else

void test_zeros(void) {}

#endif
