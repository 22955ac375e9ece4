/* test_draw_light.c: light at vertices: OpenGL's formula against binary64; a frame's light against the picture. */
#include <lambent/lambent.h>

#include "../examples/room.h"
#include "../test.h"

#include <math.h>
#include <stdlib.h>

void test_draw_light(void);

#if LMB_DRAW

/* --- OpenGL's formula --------------------------------------------------------------------------------------------- */

static void random_triple(float *out, test_rng *r, float low, float high)
{
    for (int i = 0; i < 3; ++i) {
        out[i] = test_uniform(r, low, high);
    }
}

static void random_lamp(lmb_draw_lamp *l, test_rng *r)
{
    memset(l, 0, sizeof *l);
    random_triple(l->position, r, -3, 3);
    l->position[3] = test_random(r) % 3 == 0 ? 0.0f : test_random(r) % 3 == 0 ? 2.0f : 1.0f;
    random_triple(l->ambient, r, 0, 0.1f);
    random_triple(l->diffuse, r, 0, 0.5f);
    random_triple(l->specular, r, 0, 0.5f);
    random_triple(l->spot_direction, r, -1, 1);
    l->spot_exponent = test_random(r) % 3 == 0 ? 0.0f : test_uniform(r, 0, 40);
    l->spot_cos = test_random(r) % 2 ? -1.0f : test_uniform(r, 0, 0.9f);
    l->attenuation[0] = test_uniform(r, 0.1f, 1);
    l->attenuation[1] = test_uniform(r, 0, 0.3f);
    l->attenuation[2] = test_uniform(r, 0, 0.1f);
}

static void random_material(lmb_draw_material *m, test_rng *r)
{
    random_triple(m->emission, r, 0, 0.1f);
    random_triple(m->ambient, r, 0, 0.5f);
    random_triple(m->diffuse, r, 0, 1);
    random_triple(m->specular, r, 0, 1);
    m->diffuse[3] = test_uniform(r, 0, 1);
    m->shininess = test_random(r) % 4 == 0 ? 0.0f : test_uniform(r, 0, 128);
}

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void unit(double v[3])
{
    const double length = sqrt(dot(v, v));
    for (int i = 0; i < 3 && length > 0; ++i) {
        v[i] /= length;
    }
}

/* Adds a lamp as in OpenGL 1.5, section 2.14.1. Returns 0 if a step of the formula is too close to decide. */
static int add_lamp(double matt[3], double shine[3], const lmb_draw_lamp *l, const lmb_draw_material *m,
                    const double at[3], const double normal[3], const double eye[3])
{
    double to[3], half[3], axis[3], by = 1, sure = 1;
    for (int i = 0; i < 3; ++i) {
        to[i] = (double)l->position[3] == 0 ? (double)l->position[i] : (double)l->position[i] / (double)l->position[3] - at[i];
        axis[i] = (double)l->spot_direction[i];
    }
    if ((double)l->position[3] != 0) {
        const double d = sqrt(dot(to, to));
        by = 1 / ((double)l->attenuation[0] + (double)l->attenuation[1] * d + (double)l->attenuation[2] * d * d);
    }
    unit(to);
    unit(axis);
    for (int i = 0; i < 3; ++i) {
        half[i] = to[i] + eye[i];
    }
    unit(half);
    if ((double)l->spot_cos > -1) {
        const double cosine = -dot(to, axis);
        sure = fabs(cosine - (double)l->spot_cos) > 1e-5;
        by *= cosine >= (double)l->spot_cos ? pow(fmax(cosine, 0), (double)l->spot_exponent) : 0;
    }
    const double facing = dot(normal, to);
    const double gloss = facing > 0 ? pow(fmax(dot(normal, half), 0), (double)m->shininess) : 0;
    for (int i = 0; i < 3; ++i) {
        matt[i] += by * ((double)l->ambient[i] * (double)m->ambient[i] + fmax(facing, 0) * (double)l->diffuse[i] * (double)m->diffuse[i]);
        shine[i] += by * gloss * (double)l->specular[i] * (double)m->specular[i];
    }
    return sure && (fabs(facing) > 1e-5);
}

static double off_code(double v, uint8_t code) { return fabs(255 * fmin(fmax(v, 0), 1) - code); }

/* One vertex against the formula: the largest difference in codes; 0 if a step is close. */
static double try_formula(test_rng *r)
{
    lmb_draw_lamp lamps[LMB_DRAW_LAMPS];
    lmb_draw_lighting how;
    uint8_t colours[4], seconds[4], back_colours[4], back_seconds[4];
    const uint8_t own[4] = {200, 90, 30, 120};
    float at[3], normal[3];
    memset(&how, 0, sizeof how);
    how.lamps = lamps;
    how.count = test_random(r) % (LMB_DRAW_LAMPS + 1);
    for (uint32_t i = 0; i < how.count; ++i) {
        random_lamp(&lamps[i], r);
    }
    for (int i = 0; i < 16; ++i) {
        how.to_eye.m[i] = i % 4 == 3 ? (float)(i == 15) : test_uniform(r, -1, 1) + (float)(i % 5 == 0);
    }
    random_triple(how.ambient, r, 0, 0.3f);
    random_material(&how.material[0], r);
    random_material(&how.material[1], r);
    random_triple(at, r, -2, 2);
    random_triple(normal, r, -1, 1);
    how.tracks = (uint8_t)(test_random(r) % 16);
    how.is_local = (uint8_t)(test_random(r) % 2);
    const int apart = test_random(r) % 2 == 0;
    const lmb_draw_vertices v = {.positions = at, .colours = own, .count = 1};
    const lmb_draw_lit out = {colours, apart ? seconds : NULL, back_colours, apart ? back_seconds : NULL};
    CHECK(lmb_draw_light(&out, &how, &v, normal) == LMB_OK);
    const float *m = how.to_eye.m;
    double place[3], turned[3], eye[3] = {0, 0, 1}, worst = 0;
    for (int i = 0; i < 3; ++i) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        place[i] = (double)m[i] * (double)at[0] + (double)m[4 + i] * (double)at[1] + (double)m[8 + i] * (double)at[2] + (double)m[12 + i];
        turned[i] = 0;
        for (int k = 0; k < 3; ++k) { /* cofactors: the inverse transpose times the determinant */
            const int c = (k + 1) % 3, d = (k + 2) % 3;
            turned[i] += ((double)m[4 * c + a] * (double)m[4 * d + b] - (double)m[4 * c + b] * (double)m[4 * d + a]) * (double)normal[k];
        }
    }
    const double volume = (double)m[0] * ((double)m[5] * (double)m[10] - (double)m[9] * (double)m[6]) -
                          (double)m[4] * ((double)m[1] * (double)m[10] - (double)m[9] * (double)m[2]) +
                          (double)m[8] * ((double)m[1] * (double)m[6] - (double)m[5] * (double)m[2]);
    unit(turned);
    if (fabs(volume) < 0.05) {
        return 0;
    }
    for (int i = 0; i < 3; ++i) {
        eye[i] = how.is_local ? -place[i] : eye[i];
    }
    unit(eye);
    for (int back = 0; back < 2; ++back) {
        lmb_draw_material mine = how.material[back];
        double matt[3], shine[3] = {0, 0, 0}, n[3];
        int sure = 1;
        for (int i = 0; i < 3; ++i) {
            const float own_colour = (float)(own[i] / 255.0);
            mine.emission[i] = how.tracks & LMB_DRAW_TRACK_EMISSION ? own_colour : mine.emission[i];
            mine.ambient[i] = how.tracks & LMB_DRAW_TRACK_AMBIENT ? own_colour : mine.ambient[i];
            mine.diffuse[i] = how.tracks & LMB_DRAW_TRACK_DIFFUSE ? own_colour : mine.diffuse[i];
            mine.specular[i] = how.tracks & LMB_DRAW_TRACK_SPECULAR ? own_colour : mine.specular[i];
            matt[i] = (double)mine.emission[i] + (double)mine.ambient[i] * (double)how.ambient[i];
            n[i] = (back ? -1 : 1) * (volume < 0 ? -1 : 1) * turned[i];
        }
        for (uint32_t i = 0; i < how.count; ++i) {
            sure &= add_lamp(matt, shine, &lamps[i], &mine, place, n, eye);
        }
        const uint8_t *got = back ? back_colours : colours, *shone = back ? back_seconds : seconds;
        for (int i = 0; i < 3 && sure; ++i) {
            worst = fmax(worst, off_code(apart ? matt[i] : matt[i] + shine[i], got[i]));
            worst = fmax(worst, apart ? off_code(shine[i], shone[i]) : 0);
        }
        const double alpha = how.tracks & LMB_DRAW_TRACK_DIFFUSE ? own[3] / 255.0 : (double)mine.diffuse[3];
        worst = fmax(worst, off_code(alpha, got[3]));
    }
    return worst;
}

static void test_formula(void)
{
    test_rng r = {41};
    double worst = 0;
    for (int n = 0; n < tries(2000, 40000); ++n) {
        worst = fmax(worst, try_formula(&r));
    }
    CHECK_MSG(worst < 0.51, "%g", worst);
}

/* Without normals all vertices face the eye. Normals keep their length if they are raw. */
static void test_normals(void)
{
    const lmb_draw_lamp lamp = {
        .position = {0, 0, 1, 0}, .diffuse = {1, 1, 1}, .spot_cos = -1, .attenuation = {1, 0, 0}};
    static const float at[3], half[3] = {0, 0, 0.5f}, none[3];
    lmb_draw_lighting how;
    uint8_t c[4];
    const lmb_draw_lit out = {.colours = c};
    const lmb_draw_vertices v = {.positions = at, .count = 1};
    memset(&how, 0, sizeof how);
    how.lamps = &lamp;
    how.count = 1;
    how.to_eye.m[0] = how.to_eye.m[5] = how.to_eye.m[10] = how.to_eye.m[15] = 1;
    how.material[0].diffuse[0] = 0.8f;
    CHECK(lmb_draw_light(&out, &how, &v, NULL) == LMB_OK && c[0] == 204);
    CHECK(lmb_draw_light(&out, &how, &v, half) == LMB_OK && c[0] == 204);
    how.is_raw = 1;
    CHECK(lmb_draw_light(&out, &how, &v, half) == LMB_OK && c[0] == 102);
    CHECK(lmb_draw_light(&out, &how, &v, none) == LMB_OK && c[0] == 0);
}

/* Each out-of-range number is refused and nothing is written. */
static void test_lighting_refused(void)
{
    lmb_draw_lamp lamp;
    lmb_draw_lighting how;
    test_rng r = {9};
    static const float at[7];
    uint8_t c[4] = {1, 2, 3, 4};
    lmb_draw_lit out = {.colours = c};
    const lmb_draw_vertices v = {.positions = at, .count = 1};
    for (int i = 0; i < 20; ++i) {
        random_lamp(&lamp, &r);
        memset(&how, 0, sizeof how);
        how.lamps = &lamp;
        how.count = 1;
        float *const bad[] = {&lamp.position[3],           &lamp.ambient[1],     &lamp.diffuse[0],
                              &lamp.specular[2],           &lamp.spot_exponent,  &lamp.spot_cos,
                              &lamp.spot_direction[1],     &lamp.attenuation[0], &lamp.attenuation[2],
                              &how.ambient[0],             &how.to_eye.m[7],     &how.material[1].emission[0],
                              &how.material[0].ambient[0], &how.material[1].diffuse[3], &how.material[0].shininess};
        CHECK(i > 0 || lmb_draw_light(&out, &how, &v, at) == LMB_OK);
        memcpy(c, "abcd", 4);
        if (i < 15) {
            *bad[i] = (float)NAN;
        }
        lamp.spot_exponent = i == 15 ? 129 : i == 4 ? lamp.spot_exponent : 1;
        how.material[1].shininess = i == 16 ? -1 : how.material[1].shininess;
        how.count = i == 17 ? 9 : 1;
        how.tracks = i == 18 ? 16 : 0;
        out.back_seconds = i == 19 ? c : NULL;
        CHECK_MSG(lmb_draw_light(&out, &how, &v, at) == LMB_ERR_ARG && memcmp(c, "abcd", 4) == 0, "number %d", i);
    }
    memset(&how, 0, sizeof how);
    out.back_seconds = NULL;
    CHECK(lmb_draw_light(&out, &how, &v, (const float *)(const void *)((const char *)at + 1)) == LMB_ERR_ALIGN);
    CHECK(lmb_draw_light(NULL, &how, &v, NULL) == LMB_ERR_ARG && lmb_draw_light(&out, NULL, &v, NULL) == LMB_ERR_ARG &&
          lmb_draw_light(&out, &how, NULL, NULL) == LMB_ERR_ARG);
    out.colours = NULL;
    CHECK(lmb_draw_light(&out, &how, &v, NULL) == LMB_ERR_ARG && memcmp(c, "abcd", 4) == 0);
}

/* --- a frame's light ---------------------------------------------------------------------------------------------- */

enum { WIDE = 96, HIGH = 72 };
static const lmb_mat4 here = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};

typedef struct lit_room {
    lmb_mesh mesh[2];
    lmb_material material[2];
    lmb_instance place[2];
    lmb_light light;
    lmb_scene scene;
    lmb_frame frame;
    void *block;
} lit_room;
static lmb_render lit_state;

static int32_t smoke_kind = LMB_LIGHT_SPOT; /* of the room's lamp */
static lmb_many_lights *smoke_many;         /* NULL, or gets the lamp instead of the scene */

/* Draws a frame of the examples' room. */
static lmb_status light_room(lit_room *room, lmb_frame_settings *s)
{
    room->scene = room_scene(room->mesh, room->material, room->place, &room->light);
    room->light.kind = smoke_kind;
    if (smoke_many != NULL) {
        CHECK(lmb_many_lights_add(smoke_many, &room->light, 1) == LMB_OK);
        CHECK(lmb_many_lights_build(smoke_many) == LMB_OK);
        room->scene.light_count = 0;
        s->many_lights = smoke_many;
    }
    s->kernels = lmb_kernels_pick();
    s->scene = &room->scene;
    CHECK(lmb_view_look_at(&s->view, room_eye, room_middle, room_up, 0.8f, WIDE, HIGH) == LMB_OK);
    room->block = malloc(lmb_frame_bytes(s));
    const lmb_status status = lmb_frame_init(&room->frame, s, room->block, lmb_frame_bytes(s));
    return status != LMB_OK ? status : lmb_render_frame(&lit_state, &room->frame);
}

/* The picture's code at the projection of a world position. */
static int seen_at(const lit_room *room, const float at[3], int channel)
{
    lmb_draw_state s;
    CHECK(lmb_draw_state_init(&s, WIDE, HIGH) == LMB_OK && lmb_draw_view(&s, &room->frame.view, &here) == LMB_OK);
    float clip[4];
    for (int i = 0; i < 4; ++i) {
        const float *m = s.to_clip.m;
        clip[i] = m[i] * at[0] + m[4 + i] * at[1] + m[8 + i] * at[2] + m[12 + i];
    }
    const int x = (int)((clip[0] / clip[3] * 0.5f + 0.5f) * WIDE), y = (int)((0.5f - clip[1] / clip[3] * 0.5f) * HIGH);
    return ((const uint8_t *)room->frame.out.data)[(y * WIDE + x) * 4 + channel];
}

/* Points of the room's surfaces, in light, at its border, and in the block's shadow: vertices match the picture
 * there. */
static void test_surfaces(int32_t gather_step, int32_t show)
{
    static const float at[6][3] = {{-0.5f, 0, 0.3f},    {-0.3f, 0, 0.6f},   {0.4f, 0.7f, -0.2f},
                                   {-0.4f, 1.2f, -1.0f}, {-1.0f, 0.8f, 0.0f}, {-0.2f, 0, -0.7f}};
    static const float normals[6][3] = {{0, 1, 0}, {0, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
    static const uint8_t own[2][4] = {{231, 231, 231, 9}, {231, 89, 89, 9}}; /* sRGB of .8 and .1 */
    uint8_t colours[6][4], lit[6][4];
    lit_room room;
    lmb_frame_settings s;
    memset(&s, 0, sizeof s);
    s.show = show;
    s.gather_step = gather_step;
    CHECK(light_room(&room, &s) == LMB_OK);
    for (int i = 0; i < 6; ++i) {
        memcpy(colours[i], own[i == 4], sizeof colours[i]);
    }
    const lmb_draw_vertices v = {.positions = at, .colours = colours[0], .count = 6};
    CHECK(lmb_render_vertices(lit[0], &lit_state, room.frame.scratch, &v, normals[0], &here) == LMB_OK);
    int worst = 0, least = 255;
    for (int k = 0; k < 18; ++k) {
        const int seen = seen_at(&room, at[k / 3], k % 3);
        worst = abs(seen - lit[k / 3][k % 3]) > worst ? abs(seen - lit[k / 3][k % 3]) : worst;
        least = lit[k / 3][0] < least ? lit[k / 3][0] : least;
    }
    CHECK_MSG(worst <= 6 && (least > 5 || show == LMB_SHOW_DIRECT), "gather_step %d, show %d: %d codes off", gather_step,
              show, worst);
    CHECK(lit[0][3] == 9 && lit[0][0] > 60);
    if (show == LMB_SHOW_DIRECT) { /* each independently, and in place */
        const lmb_draw_vertices last = {.positions = at[5], .colours = colours[5], .count = 1};
        CHECK(lmb_render_vertices(colours[5], &lit_state, room.frame.scratch, &last, normals[5], &here) == LMB_OK);
        CHECK(memcmp(colours[5], lit[5], 4) == 0);
    }
    free(room.block);
}

/* Smoke below the lamp has a quarter of a facing plane's light; in the block's shadow it has the bounced light only. */
static void test_smoke(void)
{
    static const float at[2][3] = {{0, 1.5f, 0}, {0.3f, 0.3f, -0.6f}};
    static const uint8_t full[4] = {255, 255, 255, 255};
    uint8_t lit[2][4], bounced[2][4], grey[4];
    lit_room room;
    lmb_frame_settings s;
    const lmb_draw_vertices v = {.positions = at, .count = 2};
    memset(&s, 0, sizeof s);
    s.show = LMB_SHOW_DIRECT;
    CHECK(light_room(&room, &s) == LMB_OK);
    CHECK(lmb_render_vertices(lit[0], &lit_state, room.frame.scratch, &v, NULL, &here) == LMB_OK);
    const double e = 12.0 / 1.0 / 4 / 3.14159265358979; /* 12 W/sr at 1 m */
    const double code = 255 * (1.055 * pow(e, 1 / 2.4) - 0.055);
    CHECK_MSG(fabs(lit[0][0] - code) < 1.01, "%d for %g", lit[0][0], code);
    CHECK(lit[1][0] == 0);
    const lmb_mat4 lower = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -0.5f, 0, 1}};
    const lmb_draw_vertices one = {.positions = at, .colours = full, .count = 1};
    CHECK(lmb_render_vertices(grey, &lit_state, room.frame.scratch, &one, NULL, &lower) == LMB_OK);
    CHECK_MSG(grey[0] < lit[0][0] && grey[0] > lit[0][0] / 2, "%d", grey[0]);
    free(room.block);
    s.show = LMB_SHOW_FULL;
    CHECK(light_room(&room, &s) == LMB_OK);
    CHECK(lmb_render_vertices(bounced[0], &lit_state, room.frame.scratch, &v, NULL, &here) == LMB_OK);
    CHECK_MSG(bounced[1][0] > 20 && bounced[0][0] >= lit[0][0], "%d %d", bounced[1][0], bounced[0][0]);
    free(room.block);
}

/* Smoke in a sun, and in the lamp among lights without maps, which is the mean of six sides: here one of them faces the
 * lamp. */
static void test_smoke_by_kind(void)
{
    static const float at[1][3] = {{0, 1.5f, 0}};
    const lmb_draw_vertices v = {.positions = at, .count = 1};
    const size_t bytes = lmb_many_lights_bytes(16);
    void *memory = malloc(bytes);
    lmb_many_lights many;
    const lmb_vec3 low = {-3, -3, -3}, high = {3, 3, 3};
    CHECK(lmb_many_lights_init(&many, 16, low, high, 500.0f, memory, bytes) == LMB_OK);
    for (int kind = 0; kind < (LMB_TREES ? 2 : 1); ++kind) {
        uint8_t lit[4];
        lit_room room;
        lmb_frame_settings s;
        memset(&s, 0, sizeof s);
        s.show = LMB_SHOW_DIRECT;
        smoke_kind = kind == 0 ? LMB_LIGHT_DIRECTIONAL : LMB_LIGHT_SPOT;
        smoke_many = kind == 0 ? NULL : &many;
        CHECK(light_room(&room, &s) == LMB_OK);
        CHECK(lmb_render_vertices(lit, &lit_state, room.frame.scratch, &v, NULL, &here) == LMB_OK);
        const double e = 12.0 / (kind == 0 ? 4 : 6) / 3.14159265358979; /* 12 W/m2 */
        const double code = 255 * (1.055 * pow(e, 1 / 2.4) - 0.055);
        CHECK_MSG(fabs(lit[0] - code) < 2.01, "kind %d: %d for %g", kind, lit[0], code);
        free(room.block);
    }
    smoke_kind = LMB_LIGHT_SPOT;
    smoke_many = NULL;
    free(memory);
}

static void test_vertices_refused(void)
{
    static const float at[2][3] = {{(float)NAN, 0, 0}, {0, 1, 0}};
    static const float normals[2][3] = {{0, 1, 0}, {0, 0, 0}};
    static uint8_t c[2][4];
    lit_room room;
    lmb_frame_settings s;
    lmb_draw_vertices v = {.positions = at, .count = 2};
    memset(&s, 0, sizeof s);
    s.show = LMB_SHOW_DIRECT;
    CHECK(light_room(&room, &s) == LMB_OK);
    lmb_band_scratch *scratch = room.frame.scratch;
    CHECK(lmb_render_vertices(c[0], &lit_state, scratch, &v, normals[0], &here) == LMB_OK);
    CHECK(c[0][0] == 0 && c[0][3] == 255 && c[1][0] == 0); /* no place; no normal */
    lmb_mat4 odd = here;
    odd.m[2] = (float)NAN;
    memset(c, 7, sizeof c);
    CHECK(lmb_render_vertices(NULL, &lit_state, scratch, &v, NULL, &here) == LMB_ERR_ARG);
    CHECK(lmb_render_vertices(c[0], NULL, scratch, &v, NULL, &here) == LMB_ERR_ARG);
    CHECK(lmb_render_vertices(c[0], &lit_state, NULL, &v, NULL, &here) == LMB_ERR_ARG);
    CHECK(lmb_render_vertices(c[0], &lit_state, scratch, NULL, NULL, &here) == LMB_ERR_ARG);
    CHECK(lmb_render_vertices(c[0], &lit_state, scratch, &v, NULL, NULL) == LMB_ERR_ARG);
    CHECK(lmb_render_vertices(c[0], &lit_state, scratch, &v, NULL, &odd) == LMB_ERR_ARG);
    lit_state.stage = LMB_STAGE_VIEW;
    CHECK(lmb_render_vertices(c[0], &lit_state, scratch, &v, NULL, &here) == LMB_ERR_ARG);
    lit_state.stage = LMB_STAGE_DONE;
    v.position_format = LMB_DRAW_F32X4 + 1;
    CHECK(lmb_render_vertices(c[0], &lit_state, scratch, &v, NULL, &here) == LMB_ERR_FORMAT);
    v.position_format = LMB_DRAW_F32;
    CHECK(lmb_render_vertices(c[0], &lit_state, scratch, &v, (const float *)(const void *)((const char *)at + 2),
                              &here) == LMB_ERR_ALIGN);
    CHECK(c[0][0] == 7 && c[1][3] == 7);
    free(room.block);
}

void test_draw_light(void)
{
    test_formula();
    test_normals();
    test_lighting_refused();
    test_surfaces(0, LMB_SHOW_DIRECT);
    test_surfaces(0, LMB_SHOW_FULL);
    if (LMB_LIVE) {
        test_surfaces(LMB_GATHER_LIVE, LMB_SHOW_FULL);
    }
    test_smoke();
    test_smoke_by_kind();
    test_vertices_refused();
}

#else
void test_draw_light(void) { SKIP("a build without fixed-function drawing"); }
#endif
