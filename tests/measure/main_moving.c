/* main_moving.c: draws sixty frames of a light, or a crate, that moves by 1 cm or 0.5 cm a frame. Checks
 * that no frame depends on earlier ones, and measures how much of the change between frames is due to
 * the cut. [V34, stability]
 *
 * Brute force gathers every texel separately, with a visibility test for every pixel. `steps` is the RMSE
 * between successive frames over all frames, minus that of brute force; `worst` is the largest value of one
 * frame; `flicker` is the RMSE of the change of a frame's error. All are relative to the mean. Ends with `N
 * passed, N failed, N skipped`. */
#include <stdlib.h>

#include "../../tools/model/model.h"
#include "../shared_file.h"
#include "../world.h"

int test_passed, test_failed, test_skipped;

enum { SIDE = 48, MAP = 64, FRAMES = 60, FLOATS = SIDE * SIDE * 3, TRIANGLES = 256 };

static const struct setting {
    const char *name;
    float error, visibility;
    double max; /* limit of `steps` */
} settings[] = {
    {"brute force", 1e-12f, 1e-12f, 0.0}, /* a cut holds all MAP^2 texels */
    {"0.02, 0.02", 0.02f, 0.02f, 0.01},
    {"0.1, 0.04", 0.1f, 0.04f, 0.01},
    {"0.3, 0.1", 0.3f, 0.1f, 0.01},
};
enum { BRUTE, SETTINGS = sizeof settings / sizeof *settings };

/* --- a frame and its memory --------------------------------------------------------------------------------------- */

typedef struct state {
    uint32_t map[2 * MAP * MAP], depth[SIDE * SIDE], id[SIDE * SIDE];
    uint32_t tree[128 * MAP * MAP / 4 + 512], bvh[TRIANGLES * 128];
    lmb_band_scratch scratch;
    lmb_render render;
} state;

static state kept, fresh;
static float pictures[SETTINGS][2][FLOATS], other[FLOATS];

static void set_frame(lmb_frame *f, state *s, float *out, const lmb_scene *scene, const lmb_view *view,
                      const struct setting *how)
{
    memset(f, 0, sizeof *f);
    f->kernels = lmb_kernels_pick();
    f->scene = scene;
    f->view = *view;
    f->show = LMB_SHOW_INDIRECT;
    f->shadow_map = MAP;
    f->grouping.method = LMB_GROUP_CUT;
    f->occlusion = LMB_OCCLUSION_EXACT;
    f->error = how->error;
    f->visibility = how->visibility;
    f->map_memory = s->map;
    f->map_bytes = sizeof s->map;
    f->eye = target_of(LMB_DEPTH32F, SIDE, s->depth, s->id);
    f->scratch = &s->scratch;
    CHECK(lmb_tree_init(&f->tree, 1, MAP, s->tree, sizeof s->tree) == LMB_OK);
    CHECK(lmb_bvh_init(&f->bvh, TRIANGLES, s->bvh, sizeof s->bvh) == LMB_OK);
    CHECK(lmb_surface_init(&f->out, LMB_RGB32F, SIDE, SIDE, out, FLOATS * sizeof *out) == LMB_OK);
}

/* Stops at the first frame that fails. */
static void draw(state *s, float *out, const lmb_scene *scene, const lmb_view *view, const struct setting *how)
{
    lmb_frame f;
    set_frame(&f, s, out, scene, view, how);
    const lmb_status status = lmb_render_frame(&s->render, &f);
    if (status != LMB_OK) {
        printf("FAIL %s: %s\n", how->name, lmb_status_name(status));
        exit(1);
    }
}

/* --- scenes that move --------------------------------------------------------------------------------------------- */

typedef struct moving {
    const char *name;
    lmb_scene *scene;
    lmb_light light;
    lmb_view view;
    float step_m; /* a frame, along x */
    int crate;    /* the crate moves, not the light */
} moving;

static void set_room(moving *m, const char *name, int crate)
{
    world_begin(0.7f, 0.6f, 0.5f);
    world_quad(vec3(0, -1, 0), Z, X);
    world_quad(vec3(0, 1, 0), X, Z);
    world_quad(vec3(0, 0, -1), X, Y);
    world_quad(vec3(-1, 0, 0), Y, Z);
    world_quad(vec3(1, 0, 0), Z, Y);
    world_box(vec3(0.45f, -0.75f, 0.2f), 0.25f);
    world_part();
    world_box(vec3(-0.55f, -0.7f, -0.3f), 0.3f);
    world.material[1].albedo[0] = 0.2f;
    CHECK(world_end() == LMB_OK);
    m->name = name;
    m->scene = &world.scene;
    m->light = spot(vec3(-0.3f, 0.9f, 0.1f), vec3(0.1f, -1, -0.15f), 20, 42);
    m->view = look(vec3(0, 0, 3.2f), vec3(0, 0, 0), 40, SIDE);
    m->step_m = 0.01f;
    m->crate = crate;
}

/* Returns 0 and counts a skip if the file is missing. */
static int set_cornell(moving *m, model *loaded)
{
    char path[SHARED_PATH];
    model_notes notes;
    report r = {""};
    memset(&notes, 0, sizeof notes);
    if (!shared_file(path, "truth/cornell/scene.gltf")) {
        return 0;
    }
    if (!model_load(loaded, path, NULL, &notes, &r) || loaded->camera_count == 0 || loaded->scene.light_count != 1) {
        CHECK_MSG(0, "%s", r.text);
        return 0;
    }
    const model_camera *c = &loaded->cameras[0];
    m->name = "cornell, light";
    m->scene = &loaded->scene;
    m->light = loaded->scene.lights[0];
    m->view = look(c->eye, sub3(c->eye, c->back), (double)c->yfov_rad * 180 / PI, SIDE);
    m->view.near_m = c->near_m;
    m->step_m = 0.005f; /* the box is half a metre wide; the light hangs in the middle */
    m->light.position.x -= m->step_m * FRAMES / 2;
    m->crate = 0;
    return 1;
}

static void move(moving *m, int frame)
{
    m->scene->lights = &m->light;
    m->scene->light_count = 1;
    if (frame > 0 && m->crate) {
        world.instance[1].to_world.m[12] += m->step_m;
        CHECK(world_end() == LMB_OK);
    } else if (frame > 0) {
        m->light.position.x += m->step_m;
    }
}

/* --- figures ------------------------------------------------------------------------------------------------------ */

typedef struct figures {
    double steps, flicker, worst; /* sums of squares; the largest RMSE beyond brute force */
} figures;

static double square_of_step(const float *now, const float *before)
{
    double sum = 0.0;
    for (int i = 0; i < FLOATS; ++i) {
        const double d = (double)now[i] - (double)before[i];
        sum += d * d;
    }
    return sum / FLOATS;
}

static double square_of_flicker(int setting, int now)
{
    double sum = 0.0;
    for (int i = 0; i < FLOATS; ++i) {
        const double d = (double)pictures[setting][now][i] - (double)pictures[setting][1 - now][i] -
                         ((double)pictures[BRUTE][now][i] - (double)pictures[BRUTE][1 - now][i]);
        sum += d * d;
    }
    return sum / FLOATS;
}

static void add_step(figures figure[SETTINGS], int now)
{
    const double brute = square_of_step(pictures[BRUTE][now], pictures[BRUTE][1 - now]);
    for (int s = 0; s < SETTINGS; ++s) {
        const double step = square_of_step(pictures[s][now], pictures[s][1 - now]);
        figure[s].steps += step;
        figure[s].flicker += square_of_flicker(s, now);
        figure[s].worst = fmax(figure[s].worst, sqrt(step) - sqrt(brute));
    }
}

static void tell(const moving *m, const figures figure[SETTINGS], double mean)
{
    const double brute = sqrt(figure[BRUTE].steps / (FRAMES - 1));
    printf("%s: brute force changes by %.4f of the mean a frame\n", m->name, brute / mean);
    for (int s = BRUTE + 1; s < SETTINGS; ++s) {
        const double more = (sqrt(figure[s].steps / (FRAMES - 1)) - brute) / mean;
        printf("  %-20s steps %+.4f  worst %+.4f  flicker %.4f\n", settings[s].name, more, figure[s].worst / mean,
               sqrt(figure[s].flicker / (FRAMES - 1)) / mean);
        CHECK_MSG(more <= settings[s].max, "%s, %s: %g", m->name, settings[s].name, more);
    }
}

/* Draws into memory filled with noise instead of the last frame. */
static int is_same_fresh(const moving *m, int setting, const float *picture)
{
    memset(&fresh, 0x5a, sizeof fresh);
    draw(&fresh, other, m->scene, &m->view, &settings[setting]);
    return memcmp(other, picture, sizeof other) == 0;
}

static void run(moving *m)
{
    figures figure[SETTINGS];
    double mean = 0.0;
    int unlike = 0;
    memset(figure, 0, sizeof figure);
    for (int frame = 0; frame < FRAMES; ++frame) {
        const int now = frame & 1;
        move(m, frame);
        for (int s = 0; s < SETTINGS; ++s) {
            draw(&kept, pictures[s][now], m->scene, &m->view, &settings[s]);
        }
        unlike += !is_same_fresh(m, 1 + frame % (SETTINGS - 1), pictures[1 + frame % (SETTINGS - 1)][now]);
        for (int i = 0; i < FLOATS; ++i) {
            mean += (double)pictures[BRUTE][now][i] / FLOATS / FRAMES;
        }
        if (frame > 0) {
            add_step(figure, now);
        }
    }
    tell(m, figure, mean);
    CHECK_MSG(unlike == 0, "%s: %d frames depend on what was drawn before", m->name, unlike);
}

int main(void)
{
    static model loaded;
    moving m;
    memset(&m, 0, sizeof m);
    set_room(&m, "room, light", 0);
    run(&m);
    set_room(&m, "room, crate", 1);
    run(&m);
    if (set_cornell(&m, &loaded)) {
        run(&m);
    }
    model_free(&loaded);
    printf("%d passed, %d failed, %d skipped\n", test_passed, test_failed, test_skipped);
    return test_failed > 0;
}
