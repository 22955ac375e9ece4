/* test_relief.c: a sphere carried by a cube, against the sphere itself. Requirements P1-P12. */
#include "../world.h"

#include <stdlib.h>

#include "../../src/base/codec.h"
#include "../../tools/relief_bake.h"
#include "../../tools/relief_draw.h"
#include "../../tools/relief_model.h"

void test_relief(void);

enum { TEXELS = 64, FRAME = 128, STACKS = 48, SLICES = 96, VIEWS = 26, MAP = 256 };

/* --- a relief ----------------------------------------------------------------------------------------------------- */

/* Around a sphere of radius 1. */
static float cube_positions[24], cube_normals[24], cube_colours[24];
static uint32_t cube_indices[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                    2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};

static triangle_mesh cube(float half)
{
    triangle_mesh m = {8, 12, cube_positions, cube_normals, cube_colours, cube_indices};
    for (int i = 0; i < 24; ++i) {
        cube_positions[i] = i / 3 >> i % 3 & 1 ? half : -half;
        cube_normals[i] = cube_positions[i] / (half * 1.7320508f);
        cube_colours[i] = 0.25f;
    }
    return m;
}

typedef struct stage {
    triangle_mesh sphere; /* of `world`, with smooth normals */
    relief_scene complex;
    relief_bake bake;
    file_bytes file;
    lmb_relief relief;
} stage;

/* Colours that differ all around. */
static void paint(triangle_mesh *m)
{
    for (uint32_t i = 0; i < 3 * m->vertex_count; ++i) {
        m->colours[i] = 0.5f + 0.4f * m->positions[i];
    }
}

static stage *stage_make(int32_t format)
{
    report r = {""};
    stage *s = calloc(1, sizeof *s);
    lmb_vec3 direction[VIEWS];
    const triangle_mesh simple = cube(1.05f);
    if (s == NULL) {
        abort();
    }
    world_begin(1.0f, 1.0f, 1.0f);
    world_sphere(vec3(0, 0, 0), 1.0f, STACKS, SLICES);
    CHECK(world_end() == LMB_OK);
    CHECK(relief_flatten(&s->sphere, &world.scene, &r));
    paint(&s->sphere);
    CHECK(relief_scene_of(&s->complex, &s->sphere, &r));
    relief_directions(direction, VIEWS);
    s->bake.format = format;
    for (int i = 0; i < VIEWS; ++i) {
        const lmb_view v = relief_fit(&s->sphere, direction[i], TEXELS);
        CHECK(relief_add(&s->bake, &s->complex.scene, &v, &r));
    }
    CHECK(relief_encode(&s->file, &s->bake, &simple, 0.0f, &r));
    CHECK_MSG(lmb_relief_open(&s->relief, s->file.data, s->file.size) == LMB_OK, "%s", r.text);
    return s;
}

static void stage_free(stage *s)
{
    triangle_mesh_free(&s->sphere);
    relief_scene_free(&s->complex);
    relief_bake_free(&s->bake);
    file_free(&s->file);
    free(s);
}

static relief_shot shot_of(const stage *s, const lmb_view *view)
{
    relief_shot shot;
    memset(&shot, 0, sizeof shot);
    shot.kernels = lmb_kernels_pick();
    shot.view = *view;
    shot.relief = &s->relief;
    return shot;
}

static relief_frame shoot(const relief_shot *shot)
{
    report r = {""};
    relief_frame f;
    CHECK_MSG(relief_shoot(&f, shot, &r), "%s", r.text);
    return f;
}

/* --- surface ------------------------------------------------------------------------------------------------------ */

/* m along the view's axis to the sphere through the middle of a pixel; 0: the ray passes it by `by` m. */
static float sphere_depth(float *by, lmb_vec3 *normal, const lmb_view *v, int32_t x, int32_t y)
{
    const float sx = ((float)(2 * x + 1) / (float)v->frame_width - 1.0f) * v->half_width,
                sy = (1.0f - (float)(2 * y + 1) / (float)v->frame_height) * v->half_height;
    const lmb_vec3 ray = normalize3(sub3(add3(mul3(v->right, sx), mul3(v->up, sy)), v->back));
    const float b = dot3(v->eye, ray), c = dot3(v->eye, v->eye) - b * b;
    *by = sqrtf(c) - 1.0f;
    if (c >= 1.0f) {
        return 0.0f;
    }
    *normal = add3(v->eye, mul3(ray, -b - sqrtf(1.0f - c)));
    return -dot3(v->back, sub3(*normal, v->eye));
}

typedef struct errors {
    int wrong, pixels; /* covered and should not be, or the other way, beyond `edge` */
    double depth, normal, colour; /* worst off the edge; normal: 1 - cosine */
} errors;

static errors against_sphere(const relief_frame *f, const lmb_view *v, float edge)
{
    errors e = {0, 0, 0.0, 0.0, 0.0};
    for (int32_t i = 0; i < f->width * f->height; ++i) {
        float by;
        lmb_vec3 n = {0, 0, 0};
        const float depth = sphere_depth(&by, &n, v, i % f->width, i / f->width);
        const float *got = f->normal + 3 * i, *albedo = f->albedo + 3 * i;
        if (absf(by) < edge) {
            continue;
        }
        e.wrong += (f->depth[i] > 0.0f) != (depth > 0.0f);
        if (f->depth[i] > 0.0f && depth > 0.0f) {
            const double off[3] = {(double)(albedo[0] - 0.5f - 0.4f * n.x), (double)(albedo[1] - 0.5f - 0.4f * n.y),
                                   (double)(albedo[2] - 0.5f - 0.4f * n.z)};
            e.depth = fmax(e.depth, fabs((double)(f->depth[i] - depth)));
            e.normal = fmax(e.normal, 1.0 - (double)dot3(n, vec3(got[0], got[1], got[2])));
            e.colour = fmax(e.colour, fmax(fabs(off[0]), fmax(fabs(off[1]), fabs(off[2]))));
            ++e.pixels;
        }
    }
    return e;
}

/* P2-P6 P12: the cube's pixels show the sphere, and nothing past its edge. Texels are 0.033 m wide, pixels 0.026. */
static void carries_a_sphere(const stage *s, double depth, double normal, double colour)
{
    const lmb_vec3 eyes[3] = {{1.9f, 1.1f, 2.6f}, {-2.2f, 0.3f, 2.4f}, {0.4f, -3.1f, 1.1f}};
    for (int i = 0; i < 3; ++i) {
        const lmb_view v = look(eyes[i], vec3(0, 0, 0), 45.0, FRAME);
        const relief_shot shot = shot_of(s, &v);
        relief_frame f = shoot(&shot);
        const errors e = against_sphere(&f, &v, 0.02f);
        CHECK_MSG(e.pixels > 4000 && e.wrong <= 8 && e.depth < depth && e.normal < normal && e.colour < colour,
                  "%d pixels, %d wrong, depth %g, normal %g, colour %g", e.pixels, e.wrong, e.depth, e.normal,
                  e.colour);
        CHECK(f.stats.hits + f.stats.missed + f.stats.holes == f.stats.pixels && f.stats.holes < f.stats.pixels / 100);
        relief_frame_free(&f);
    }
}

/* P5: one look from the cube is far from the sphere, which is what going on is for. */
static void once_is_worse(const stage *s)
{
    const lmb_view v = look(vec3(1.9f, 1.1f, 2.6f), vec3(0, 0, 0), 45.0, FRAME);
    relief_shot shot = shot_of(s, &v);
    shot.how.steps = 1;
    relief_frame f = shoot(&shot);
    const errors e = against_sphere(&f, &v, 0.02f);
    CHECK_MSG(e.depth > 0.05 && e.wrong > 100, "depth %g, wrong %d", e.depth, e.wrong);
    relief_frame_free(&f);
}

/* A reference view from its own place: the picture that is stored. */
static void is_its_own_view(const stage *s, int32_t which)
{
    lmb_view v = s->bake.picture[which].view;
    v.eye = add3(v.eye, v.back); /* so that all of the cube lies before it */
    v.far_m += 2.0f;
    relief_shot shot = shot_of(s, &v), plain = shot;
    shot.how.pick = LMB_RELIEF_EYE_RAY;
    shot.how.sampling = 1;
    plain.relief = NULL;
    plain.scene = &s->complex.scene;
    relief_frame got = shoot(&shot), want = shoot(&plain);
    int covered = 0, wrong = 0;
    float depth = 0.0f;
    for (int i = 0; i < TEXELS * TEXELS; ++i) {
        const uint8_t *colour = s->bake.picture[which].texels + 4 * (TEXELS * TEXELS + i);
        wrong += (got.depth[i] > 0.0f) != (want.depth[i] > 0.0f);
        if (got.depth[i] > 0.0f && want.depth[i] > 0.0f) {
            ++covered;
            depth = maxf(depth, absf(got.depth[i] - want.depth[i]));
            for (int c = 0; c < 3; ++c) {
                wrong += got.albedo[3 * i + c] != lmb_srgb_linear[colour[c]];
            }
        }
    }
    CHECK_MSG(covered > 2000 && wrong == 0 && depth < 1e-5f, "%d covered, %d wrong, depth %g", covered, wrong,
              (double)depth);
    relief_frame_free(&got);
    relief_frame_free(&want);
}

/* --- light -------------------------------------------------------------------------------------------------------- */

/* P7-P9 P11: over a floor, both ways: what the sphere shadows, what shadows it, and which hides which. */
static void shadows(const stage *s)
{
    const lmb_view v = look(vec3(0.0f, 2.0f, 5.0f), vec3(0, 0, 0), 60.0, FRAME);
    const lmb_light light = sun(vec3(0.2f, -1.0f, -0.1f));
    relief_shot shot = shot_of(s, &v), truth;
    world_begin(0.5f, 0.5f, 0.5f);
    world_quad(vec3(0.0f, -1.2f, 0.0f), vec3(0, 0, 3), vec3(3, 0, 0));
    world_quad(vec3(-0.9f, 1.6f, 0.0f), vec3(0, 0, 0.8f), vec3(0.6f, 0, 0));
    CHECK(world_end() == LMB_OK);
    shot.scene = &world.scene;
    shot.light = &light;
    shot.light_map = MAP;
    relief_frame got = shoot(&shot);
    world_sphere(vec3(0, 0, 0), 1.0f, STACKS, SLICES);
    CHECK(world_end() == LMB_OK);
    truth = shot;
    truth.relief = NULL;
    relief_frame want = shoot(&truth);
    int same = 0, dark = 0, apart = 0;
    for (int i = 0; i < FRAME * FRAME; ++i) {
        same += got.lit[i] == want.lit[i];
        dark += want.depth[i] > 0.0f && !want.lit[i];
        apart += fabsf(got.depth[i] - want.depth[i]) > 0.02f;
    }
    CHECK_MSG(dark > 1000 && same > FRAME * FRAME * 98 / 100 && apart < FRAME * FRAME / 100,
              "%d dark, %d of %d the same, %d apart", dark, same, FRAME * FRAME, apart);
    relief_frame_free(&got);
    relief_frame_free(&want);
}

/* Light that a floor sends up arrives on a relief as on the sphere. */
static void receives_bounce(const stage *s)
{
    static uint32_t depth[FRAME * FRAME], id[FRAME * FRAME];
    static lmb_tile tile;
    static lmb_groups groups;
    static lmb_gather_scratch scratch;
    const lmb_view v = look(vec3(0.0f, -0.5f, 4.0f), vec3(0, 0, 0), 40.0, FRAME);
    lmb_irradiance bounced[2];
    lmb_scene simple;
    memset(&groups, 0, sizeof groups);
    memset(bounced, 0, sizeof bounced);
    groups.count = 1;
    set_group(&groups, 0, vec3(0, -3, 0), Y, 1.0f, 0.6f);
    groups.flux[0][0] = 10.0f;
    lmb_relief_scene(&simple, &s->relief);
    for (int i = 0; i < 2; ++i) {
        const lmb_scene *scene = i == 0 ? &simple : &s->complex.scene;
        lmb_target t = target_of(LMB_DEPTH32F, FRAME, depth, id);
        lmb_surface_clear(&t.depth);
        lmb_surface_clear(&t.id);
        CHECK(lmb_draw(&t, lmb_kernels_pick(), &v, scene, 1, WORLD_TRIANGLES, 0, NULL) == LMB_OK);
        CHECK(lmb_resolve_tile(&tile, lmb_kernels_pick(), &v, scene, &t, 64, 80) == LMB_OK);
        if (i == 0) {
            CHECK(lmb_relief_tile(&tile, NULL, lmb_kernels_pick(), &s->relief, &v, NULL) == LMB_OK);
        }
        CHECK(lmb_gather_tile(&bounced[i], lmb_kernels_pick(), &scratch, &tile, &groups, NULL, NULL) == LMB_OK);
    }
    for (int k = 0; k < LMB_TILE_PIXELS; k += 9) {
        const double a = (double)bounced[0].rgb[0][k], b = (double)bounced[1].rgb[0][k];
        CHECK_MSG(b > 0.001 && fabs(a - b) < 0.01 * b, "%g, not %g", a, b);
    }
}

/* --- the file ----------------------------------------------------------------------------------------------------- */

/* What a machine of the other byte order would have written. */
static void turn_words(uint8_t *p, size_t count, size_t size)
{
    for (size_t i = 0; i < count; ++i) {
        for (size_t k = 0; k < size / 2; ++k) {
            const uint8_t v = p[i * size + k];
            p[i * size + k] = p[i * size + size - 1 - k];
            p[i * size + size - 1 - k] = v;
        }
    }
}

static void other_order(const stage *s)
{
    lmb_relief r;
    uint32_t *copy = malloc(s->file.size), head[LMB_RELIEF_HEADER_WORDS];
    memcpy(copy, s->file.data, s->file.size);
    memcpy(head, copy, sizeof head);
    uint8_t *p = (uint8_t *)copy;
    turn_words(p + 4, LMB_RELIEF_HEADER_WORDS - 1, 4);
    turn_words(p + head[5], (size_t)head[4] * LMB_RELIEF_VIEW_WORDS, 4);
    turn_words(p + head[8], 3 * (size_t)head[6], 4);
    turn_words(p + head[9], 2 * (size_t)head[6], 2);
    turn_words(p + head[11], 3 * (size_t)head[7], 2);
    CHECK(lmb_relief_open(&r, copy, s->file.size) == LMB_ERR_FORMAT);
    CHECK(lmb_relief_swap(copy, s->file.size) == LMB_OK);
    CHECK(memcmp(copy, s->file.data, s->file.size) == 0);
    CHECK(lmb_relief_swap(copy, s->file.size) == LMB_OK && memcmp(copy, s->file.data, s->file.size) == 0);
    free(copy);
}

/* Cut anywhere, or with any word of its head or of a view's record out of range, a file is refused. */
static void bad_files(const stage *s)
{
    static const struct { int word; uint32_t value; } bad[] = {
        {0, 0}, {1, 5}, {2, 0xffffffffu}, {3, 2}, {4, 0}, {4, 0x10000u}, {5, 2}, {5, 0xfffffff0u}, {6, 0x0fffffffu},
        {7, 0x0fffffffu}, {8, 65}, {8, 0xfffffff0u}, {9, 0}, {10, 0xfffffff0u}, {11, 0xfffffff0u}, {12, 0}, {12, 3},
        {13, 0x7fc00000u}, {16, 0x7f800000u}, {19, 0}, {28, 0}, {29, 0xbf800000u}, {30, 0}, {31, 0x7f800000u}, {32, 2},
        {33, 1}, {33, 0x80000000u}, {34, 5000}, {35, 0xfffffff0u}, {35, 3}};
    const lmb_relief none = s->relief;
    lmb_relief r = none;
    uint32_t *copy = malloc(s->file.size);
    for (size_t n = 0; n < s->file.size; n = 2 * n + 7) {
        CHECK(lmb_relief_open(&r, s->file.data, n) == LMB_ERR_FORMAT);
    }
    for (int i = 0; i < COUNT(bad); ++i) {
        memcpy(copy, s->file.data, s->file.size);
        copy[bad[i].word] = bad[i].value;
        CHECK_MSG(lmb_relief_open(&r, copy, s->file.size) == LMB_ERR_FORMAT, "word %d as %u", bad[i].word,
                  (unsigned)bad[i].value);
    }
    CHECK(lmb_relief_open(&r, (const uint8_t *)copy + 1, s->file.size - 1) == LMB_ERR_ALIGN);
    CHECK(lmb_relief_open(NULL, copy, s->file.size) == LMB_ERR_ARG && lmb_relief_open(&r, NULL, 4) == LMB_ERR_ARG);
    CHECK(memcmp(&r, &none, sizeof r) == 0);
    free(copy);
}

static void bad_arguments(const stage *s)
{
    static lmb_tile tile;
    const lmb_view v = look(vec3(0, 0, 4), vec3(0, 0, 0), 40.0, FRAME);
    const lmb_relief_how bad[] = {{33, 0, 0, 0, 0}, {-1, 0, 0, 0, 0}, {0, 2, 0, 0, 0}, {0, 0, 2, 0, 0},
                                  {0, 0, 0, 9, 0}, {0, 0, 0, 0, 4}};
    for (int i = 0; i < COUNT(bad); ++i) {
        CHECK(lmb_relief_tile(&tile, NULL, lmb_kernels_pick(), &s->relief, &v, &bad[i]) == LMB_ERR_ARG);
    }
    CHECK(lmb_relief_tile(NULL, NULL, lmb_kernels_pick(), &s->relief, &v, NULL) == LMB_ERR_ARG);
    CHECK(lmb_relief_tile(&tile, NULL, lmb_kernels_pick(), NULL, &v, NULL) == LMB_ERR_ARG);
}

void test_relief(void)
{
    stage *s = stage_make(LMB_RELIEF_FULL);
    carries_a_sphere(s, 0.01, 0.001, 0.01);
    once_is_worse(s);
    is_its_own_view(s, 0);
    is_its_own_view(s, 9);
    is_its_own_view(s, 25);
    receives_bounce(s);
    shadows(s);
    other_order(s);
    bad_files(s);
    bad_arguments(s);
    stage_free(s);
    s = stage_make(LMB_RELIEF_PACKED);
    carries_a_sphere(s, 0.01, 0.001, 0.045);
    other_order(s);
    stage_free(s);
}
