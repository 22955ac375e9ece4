/* hard_relief.c: hard cases of reliefs: a ball carried by a cube, against the ball; views that miss everything. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../relief/relief_bake.h"
#include "../relief/relief_draw.h"
#include "../relief/relief_model.h"
#include "hard.h"

enum { TEXELS = 64, FRAME = 64, VIEWS = 26, SLICES = 64 };

typedef struct relief_stage {
    triangle_mesh ball; /* radius 1 */
    relief_scene complex;
    lmb_relief relief;
    file_bytes file;
    const lmb_kernels *kernels;
} relief_stage;

static float cube_positions[24], cube_normals[24], cube_colours[24];
static uint32_t cube_indices[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                    2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};

static triangle_mesh cube(float half)
{
    const triangle_mesh m = {8, 12, cube_positions, cube_normals, cube_colours, cube_indices};
    for (int i = 0; i < 24; ++i) {
        cube_positions[i] = i / 3 >> i % 3 & 1 ? half : -half;
        cube_normals[i] = cube_positions[i] / (half * 1.7320508f);
        cube_colours[i] = 0.5f;
    }
    return m;
}

/* Bakes a relief of the ball from the first `views` of 26 views and an existing scene. */
static int bake(relief_stage *s, int views)
{
    const triangle_mesh simple = cube(1.05f);
    lmb_vec3 direction[VIEWS];
    relief_bake b;
    report r = {""};
    int ok = 1;
    memset(&b, 0, sizeof b);
    b.format = LMB_RELIEF_FULL;
    relief_directions(direction, VIEWS);
    for (int i = 0; i < views && ok; ++i) {
        const lmb_view v = relief_fit(&s->ball, direction[i], TEXELS);
        ok = relief_add(&b, &s->complex.scene, &v, &r);
    }
    file_free(&s->file);
    ok = ok && relief_encode(&s->file, &b, &simple, &r) &&
         lmb_relief_open(&s->relief, s->file.data, s->file.size) == LMB_OK;
    relief_bake_free(&b);
    return ok;
}

typedef struct relief_count {
    double wrong, deep, pixels, not_kinds, not_finite;
} relief_count;

/* Distance along the axis to the ball; 0: the ray misses it. *by: distance of the ray from the outline. */
static double ball_depth(double *by, const lmb_view *v, int32_t x, int32_t y)
{
    dvec from, ray = hard_ray(&from, v, x + 0.5, y + 0.5);
    const double length = dvec_length(ray), b = dvec_dot(from, ray) / length, c = dvec_dot(from, from) - b * b;
    *by = fabs(sqrt(c) - 1.0);
    return c >= 1.0 ? 0.0 : (-b - sqrt(1.0 - c)) / length;
}

static void judge(relief_count *n, const relief_stage *s, const hard_stage *h)
{
    relief_shot shot;
    relief_frame f;
    report r = {""};
    memset(&shot, 0, sizeof shot);
    shot.kernels = s->kernels;
    shot.view = h->view;
    shot.relief = &s->relief;
    if (!relief_shoot(&f, &shot, &r)) {
        n->not_finite = HUGE_VAL;
        return;
    }
    for (int32_t i = 0; i < FRAME * FRAME; ++i) {
        double by;
        const double want = ball_depth(&by, &h->view, i % FRAME, i / FRAME), got = (double)f.depth[i];
        n->not_finite += !(got >= 0.0 && got < 1e6) || !(f.albedo[3 * i] >= 0.0f && f.albedo[3 * i] <= 1.0f);
        if (by > 0.03) {
            ++n->pixels;
            n->wrong += (got > 0.0) != (want > 0.0);
            n->deep = got > 0.0 && want > 0.0 ? fmax(n->deep, fabs(got - want)) : n->deep;
        }
    }
    n->not_kinds += f.stats.hits + f.stats.missed + f.stats.holes != f.stats.pixels;
    relief_frame_free(&f);
}

/* Draws from all directions, `distance` from the middle, aiming `aside` beside it. */
static relief_count look_around(relief_stage *s, hard_stage *h, double distance, double aside, double fov)
{
    relief_count n = {0, 0, 0, 0, 0};
    uint64_t rng = 31;
    for (int i = 0; i < 6; ++i) {
        const dvec at = hard_direction(&rng), past = dvec_unit(dvec_cross(at, hard_direction(&rng)));
        hard_look(h, dvec_mul(at, distance), dvec_mul(past, aside), fov, FRAME);
        h->view.near_m = 0.01f;
        judge(&n, s, h);
    }
    return n;
}

static void whole(hard_list *l, relief_stage *s)
{
    const relief_count far = look_around(s, l->stage, 3.5, 0.0, 40.0);
    const relief_count near = look_around(s, l->stage, 2.0, 1.0, 60.0); /* outside the cube, along the ball's side */
    hard_put(l, HARD_MEASURED, "silhouettes of a ball carried by a cube: wrong beyond a texel",
             100 * hard_share(far.wrong, far.pixels), 0.05, "%");
    hard_put(l, HARD_MEASURED, "its depth: worst", 1000 * far.deep, 15, "mm of 1 m");
    hard_put(l, HARD_MEASURED, "by grazing views, from near: wrong beyond a texel",
             100 * hard_share(near.wrong, near.pixels), 0.05, "%");
    hard_put(l, HARD_MEASURED, "its depth: worst", 1000 * near.deep, 15, "mm of 1 m");
    hard_put(l, HARD_EXACT, "pixels of no kind, or no numbers",
             far.not_kinds + near.not_kinds + far.not_finite + near.not_finite, 0, "px");
}

static void few_views(hard_list *l, relief_stage *s)
{
    relief_count n = {0, 0, 0, 0, 0};
    const int ok = bake(s, 1);
    if (ok) {
        n = look_around(s, l->stage, 3.5, 0.0, 40.0);
    }
    hard_put(l, HARD_EXACT, "one view of 26, the others see nothing: pixels of no kind, or no numbers",
             ok ? n.not_kinds + n.not_finite : HUGE_VAL, 0, "px");
    n = look_around(s, l->stage, 1.02, 0.0, 90.0); /* between the cube and the ball */
    hard_put(l, HARD_EXACT, "an eye inside the cube: the same", ok ? n.not_kinds + n.not_finite : HUGE_VAL, 0, "px");
}

void hard_relief(hard_list *l)
{
    relief_stage *s = calloc(1, sizeof *s);
    hard_stage *h = l->stage;
    report r = {""};
    if (s == NULL) {
        return;
    }
    s->kernels = h->kernels;
    hard_begin(h, 0.5);
    hard_ball(h, dvec_of(0, 0, 0), 1.0, SLICES);
    hard_end(h);
    if (relief_flatten(&s->ball, &h->scene, &r) && relief_scene_of(&s->complex, &s->ball, &r) && bake(s, VIEWS)) {
        whole(l, s);
        few_views(l, s);
    } else {
        hard_put(l, HARD_EXACT, "baking a ball: failed", 1, 0, "");
    }
    triangle_mesh_free(&s->ball);
    relief_scene_free(&s->complex);
    file_free(&s->file);
    free(s);
}
