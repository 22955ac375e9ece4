/* test_sky.c: a clear sky against the published formula, far light as lights, a frame's background, and sky light on
 * surfaces against closed forms: an open plane, a wall, a room with a window. */
#include "../folder.h"

#include "../world.h"
#include "../laid_out.h"
#include "../torus.h"
#include "../../tools/picture/picture.h"
#include "../../tools/picture/world_read.h"

void test_sky(void);

enum { SIDE = 32, LIGHTS = 6 * SIDE * SIDE };

static uint16_t env_memory[6 * 4 * SIDE * SIDE * 2];
static lmb_light lights[LIGHTS];

static lmb_env cube(void)
{
    lmb_env env;
    CHECK(lmb_env_init(&env, SIDE, env_memory, sizeof env_memory) == LMB_OK);
    return env;
}

static void fill(const lmb_env *env, float value)
{
    const float rgb[3] = {value, value, value};
    for (int32_t i = 0; i < LIGHTS; ++i) {
        lmb_env_set(env, i / (SIDE * SIDE), i % SIDE, i / SIDE % SIDE, rgb);
    }
    lmb_env_mips(env);
}

/* --- the sky ------------------------------------------------------------------------------------------------------ */

static double perez(const double k[5], double height, double turn)
{
    const double angle = acos(turn);
    return (1 + k[0] * exp(k[1] / height)) * (1 + k[2] * exp(k[3] * angle) + k[4] * turn * turn);
}

/* Luminance from the paper, kcd/m2. */
static double luminance(lmb_vec3 d, lmb_vec3 sun, double t)
{
    const double k[5] = {0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771,
                         -0.0670 * t + 0.3703};
    const double chi = (4.0 / 9 - t / 120) * (PI - 2 * acos((double)sun.y));
    const double zenith = (4.0453 * t - 4.9710) * tan(chi) - 0.2155 * t + 2.4192;
    return zenith * perez(k, (double)d.y, (double)dot3(d, sun)) / perez(k, 1.0, (double)sun.y);
}

static void check_sky(float turbidity)
{
    static const float ground[3] = {1, 2, 3};
    const lmb_vec3 sun = normalize3(vec3(0.45f, 0.8f, 0.4f));
    const lmb_env env = cube();
    float rgb[3];
    CHECK(lmb_env_sky(&env, sun, turbidity, 1.0f, ground) == LMB_OK);
    for (int i = 0; i < 40; ++i) {
        /* Texel centres, because light is interpolated in between. */
        const float s = (float)(2 * (i * 7 % SIDE) + 1 - SIDE) / SIDE, u = (float)(2 * (i * 5 % SIDE) + 1 - SIDE) / SIDE;
        const lmb_vec3 d = normalize3(i % 2 ? vec3(s, 1.0f, u) : vec3(1.0f, (float)(i / 2 % 4 * 2 + 1) / SIDE, u));
        lmb_env_sample(rgb, &env, d, 0.0f);
        const double bright = 0.2126 * (double)rgb[0] + 0.7152 * (double)rgb[1] + 0.0722 * (double)rgb[2];
        const double want = luminance(d, sun, (double)turbidity);
        CHECK_MSG(fabs(bright / want - 1) < 0.004, "turbidity %g, %d: %.4f, not %.4f kcd/m2", (double)turbidity, i, bright,
                  want);
    }
    lmb_env_sample(rgb, &env, vec3(0, -1, 0), 0.0f);
    CHECK(rgb[0] == 1 && rgb[1] == 2 && rgb[2] == 3);
    lmb_env_sample(rgb, &env, normalize3(vec3(-0.45f, 0.8f, -0.4f)), 0.0f);
    CHECK_MSG(rgb[2] > 1.5f * rgb[0], "away from the sun the sky is blue, not %g %g %g", (double)rgb[0], (double)rgb[1],
              (double)rgb[2]);
}

static void check_refusals(void)
{
    static const float ground[3] = {0, 0, 0};
    const lmb_env env = cube(), none = {NULL, 0, 0, {0}};
    CHECK(lmb_env_sky(&none, Y, 3, 1, ground) == LMB_ERR_ARG && lmb_env_sky(&env, Y, 3, 1, NULL) == LMB_ERR_ARG);
    CHECK(lmb_env_sky(&env, vec3(0, 0, 0), 3, 1, ground) == LMB_ERR_ARG);
    CHECK(lmb_env_sky(&env, Y, 3, -1, ground) == LMB_ERR_ARG && lmb_env_sky(&env, Y, 3, NAN, ground) == LMB_ERR_ARG);
    CHECK(lmb_env_sky(&env, Y, NAN, 1, ground) == LMB_OK);
    CHECK(lmb_env_sky(&env, vec3(NAN, 1, 0), 3, 1, ground) == LMB_ERR_ARG);
    /* A sun below the horizon counts as one just above it, so there is no negative light. */
    CHECK(lmb_env_sky(&env, vec3(1, -1, 0), 3, 1, ground) == LMB_OK);
    for (size_t i = 0; i < 4 * LIGHTS; ++i) {
        CHECK(env_memory[i] < 0x7c00);
    }
    fill(&env, 1.0f);
    CHECK(lmb_env_lights(lights, LIGHTS - 1, &env, 0) == 0 && lmb_env_lights(lights, LIGHTS, &env, 6) == 0 &&
          lmb_env_lights(lights, LIGHTS, &env, -1) == 0 && lmb_env_lights(NULL, 9, &env, 5) == 0);
}

/* --- as lights ---------------------------------------------------------------------------------------------------- */

static double sum_of(uint32_t count)
{
    double sum = 0;
    for (uint32_t i = 0; i < count; ++i) {
        sum += (double)lights[i].intensity[1];
        CHECK(fabs((double)length3(lights[i].direction) - 1) < 1e-6 && lights[i].kind == LMB_LIGHT_DIRECTIONAL);
    }
    return sum;
}

static void check_lights(void)
{
    const lmb_env env = cube();
    fill(&env, 1.0f);
    for (int32_t level = 0; level < 5; ++level) {
        const uint32_t count = lmb_env_lights(lights, LIGHTS, &env, level), n = SIDE >> level;
        CHECK(count == 6 * n * n);
        CHECK_MSG(fabs(sum_of(count) / (4 * PI) - 1) < 0.6 / (n * n), "%u texels: %.5f of a sphere's 4 pi", (unsigned)n,
                  sum_of(count) / (4 * PI));
    }
    fill(&env, 0.0f);
    CHECK(lmb_env_lights(lights, LIGHTS, &env, 0) == 0);
}

static void check_sun(void)
{
    static const float bright[3] = {9000, 9000, 9000};
    const lmb_env env = cube();
    lmb_light sun;
    fill(&env, 1.0f);
    CHECK(!lmb_env_take_sun(&sun, &env));
    lmb_env_set(&env, 2, 20, 9, bright);
    const double before = sum_of(lmb_env_lights(lights, LIGHTS, &env, 0));
    CHECK(lmb_env_take_sun(&sun, &env));
    const double after = sum_of(lmb_env_lights(lights, LIGHTS, &env, 0));
    const lmb_vec3 to = normalize3(vec3(9.0f / SIDE, 1.0f, -13.0f / SIDE));
    CHECK_MSG(fabs(after + (double)sun.intensity[1] - before) < 1e-3 * before, "%.4f and %.4f, of %.4f", after,
              (double)sun.intensity[1], before);
    CHECK(sun.intensity[1] > 0.6f * (float)before && dot3(sun.direction, to) < -0.9999f);
    CHECK(!lmb_env_take_sun(&sun, &env));
    CHECK(!lmb_env_take_sun(NULL, &env));
}

/* --- a picture of the whole sphere ----------------------------------------------------------------------------------- */

enum { ACROSS = 128, DOWN = 64, MOST_ACROSS = 512 };

/* W/m2 over the whole cube. */
static double light_of(const lmb_world_pictures *w)
{
    const int n = w->face_size;
    double sum = 0;
    for (int i = 0; i < 6 * n * n; ++i) {
        const double s = (2 * (i % n) + 1.0) / n - 1, t = (2 * (i / n % n) + 1.0) / n - 1;
        sum += (double)w->face[i / (n * n)][3 * (i % (n * n))] * 4 / (n * n) / pow(1 + s * s + t * t, 1.5);
    }
    return sum;
}

/* The mean direction of the light of a cube, unit. */
static void direction_of_light(double out[3], const lmb_world_pictures *w)
{
    const int n = w->face_size;
    double length = 0;
    memset(out, 0, 3 * sizeof *out);
    for (int i = 0; i < 6 * n * n; ++i) {
        const double s = (2 * (i % n) + 1.0) / n - 1, t = (2 * (i / n % n) + 1.0) / n - 1,
                     light = (double)w->face[i / (n * n)][3 * (i % (n * n))] / pow(1 + s * s + t * t, 2.0);
        const double to[6][3] = {{1, -t, -s}, {-1, -t, s}, {s, 1, t}, {s, -1, -t}, {s, -t, 1}, {-s, -t, -1}};
        for (int c = 0; c < 3; ++c) {
            out[c] += light * to[i / (n * n)][c];
        }
    }
    for (int c = 0; c < 3; ++c) {
        length += out[c] * out[c];
    }
    for (int c = 0; c < 3; ++c) {
        out[c] /= sqrt(length);
    }
}

/* A sun of one pixel keeps its light and direction at any position, also at the poles. */
static void check_picture_sun(const char *path, int wide, int x, int y)
{
    static float pixels[3 * MOST_ACROSS * MOST_ACROSS / 2];
    const int high = wide / 2;
    const image p = {wide, high, 3, pixels};
    lmb_world_pictures got;
    world_pictures own;
    report r = {""};
    memset(&got, 0, sizeof got);
    memset(&own, 0, sizeof own);
    pixels[3 * (wide * y + x)] = 1000;
    CHECK(picture_write(path, &p, 0, PICTURE_CLIPPED, &r) && world_read_cube(&got, &own, path, &r));
    const double want = 1000 * (2 * PI / wide) * (cos(PI * y / high) - cos(PI * (y + 1) / high)), light = light_of(&got);
    CHECK_MSG(fabs(light / want - 1) < 0.001, "a sun at pixel %d, %d: %.5f, not %.5f W/m2", x, y, light, want);
    const double north = PI * (y + 0.5) / high, east = 2 * PI * (x + 0.5) / wide;
    double to[3];
    direction_of_light(to, &got);
    const double along = -to[0] * sin(north) * sin(east) + to[1] * cos(north) + to[2] * sin(north) * cos(east);
    CHECK_MSG(along > cos(PI / high), "a sun at pixel %d, %d: %.2f pixels off", x, y, acos(fmin(along, 1)) * high / PI);
    pixels[3 * (wide * y + x)] = 0;
    world_pictures_free(&own);
    remove(path);
}

/* Suns of one pixel in a dim world, with few pixels to a texel: the samples of a texel must be dense enough that their
 * light is right on average. Without scaling, 8 x 8 samples have .0097 rms, 4 x 4 have .0148, and 2 x 2 have .0278. */
static void check_picture_suns(const char *path)
{
    enum { WIDE = 96, HIGH = 48, SUNS = 25 };
    static const float dim = 0.01f, bright = 50000.0f;
    static float pixels[3 * WIDE * HIGH];
    const image p = {WIDE, HIGH, 3, pixels};
    double square = 0.0;
    for (int i = 0; i < 3 * WIDE * HIGH; ++i) {
        pixels[i] = dim;
    }
    for (int n = 0; n < SUNS; ++n) {
        const int x = n * 37 % WIDE, y = 4 + n * 17 % (HIGH - 8);
        lmb_world_pictures got;
        world_pictures own;
        report r = {""};
        memset(&got, 0, sizeof got);
        memset(&own, 0, sizeof own);
        pixels[3 * (WIDE * y + x)] = bright;
        CHECK(picture_write(path, &p, 0, PICTURE_CLIPPED, &r) && world_read_cube(&got, &own, path, &r));
        const double sun = (double)bright * (2 * PI / WIDE) * (cos(PI * y / HIGH) - cos(PI * (y + 1) / HIGH));
        const double off = light_of(&got) / (sun + 4 * PI * (double)dim) - 1;
        square += off * off / SUNS;
        pixels[3 * (WIDE * y + x)] = dim;
        world_pictures_free(&own);
        remove(path);
    }
    printf("  suns of one pixel: %.4f rms\n", sqrt(square));
    CHECK_MSG(sqrt(square) < 0.0005, "suns of one pixel: %.4f rms", sqrt(square));
}

/* A missing face is none, also if the struct has held another world. */
static void check_missing_face(const char *face, const char *prefix)
{
    static float pixels[3 * 2 * 2];
    const image p = {2, 2, 3, pixels};
    lmb_world_pictures got;
    world_pictures own;
    report r = {""};
    memset(&got, 0, sizeof got);
    memset(&own, 0, sizeof own);
    got.face[1] = got.alpha[1] = pixels;
    CHECK(picture_write(face, &p, 0, PICTURE_CLIPPED, &r) && world_read_cube(&got, &own, prefix, &r));
    CHECK(got.face[0] != NULL && got.face[1] == NULL && got.alpha[1] == NULL);
    world_pictures_free(&own);
    remove(face);
}

/* --- on surfaces -------------------------------------------------------------------------------------------------- */

static void *tree_memory;

/* The tree of a white sky of 1 W/(m2 sr) in the upper half, one light per texel. */
static lmb_many_lights white_sky(void)
{
    const lmb_env env = cube();
    lmb_many_lights tree;
    fill(&env, 1.0f);
    const uint32_t count = lmb_env_lights(lights, LIGHTS, &env, 0);
    const size_t bytes = lmb_many_lights_bytes(8192);
    tree_memory = malloc(bytes);
    CHECK(lmb_many_lights_init(&tree, 8192, vec3(0, 0, 0), vec3(0, 0, 0), 64, tree_memory, bytes) == LMB_OK);
    for (uint32_t i = 0; i < count; ++i) {
        if (lights[i].direction.y < 0) {
            CHECK(lmb_many_lights_add(&tree, &lights[i], 1) == LMB_OK);
        }
    }
    CHECK(lmb_many_lights_build(&tree) == LMB_OK);
    return tree;
}

/* A frame that shows the irradiance from a sky. */
static void draw_sky_light(lmb_frame_settings *s, const lmb_many_lights *sky)
{
    static lmb_render r;
    s->many_lights = sky;
    s->show = LMB_SHOW_INDIRECT;
    lay_out(s);
    frame.gather_many_lights = 1;
    frame.many_lights_error = 0.01f;
    memset(&r, 0, sizeof r);
    CHECK(lmb_render_frame(&r, &frame) == LMB_OK);
}

/* The centre pixel's irradiance, viewed from above `at`. gather_step: 0, or LMB_GATHER_LIVE. */
static float irradiance_at(const lmb_many_lights *sky, lmb_vec3 at, float from, int32_t samples, int32_t gather_step)
{
    lmb_view view;
    CHECK(lmb_view_look_at(&view, add3(at, vec3(0, from, 0)), at, Z, 0.02f, 8, 8) == LMB_OK);
    lmb_frame_settings s = draft_settings(&world.scene, view);
    s.samples = samples;
    s.gather_step = gather_step;
    s.quality = gather_step != 0 ? LMB_QUALITY_DEFAULT : s.quality; /* more segments: so few pixels do not average */
    draw_sky_light(&s, sky);
    const float *p = (const float *)frame.out.data + 3 * (4 * 8 + 4);
    return p[1] * (float)PI / 0.01f; /* the albedo: almost no bounced light */
}

/* Single points see a small hole by few segments: test_live.c checks their mean. */
static void check_at(const lmb_many_lights *sky, const char *what, lmb_vec3 at, float from, double want, double bar)
{
    for (int live = 0; live <= (LMB_LIVE && want > 0.1); ++live) {
        const int32_t step = live ? LMB_GATHER_LIVE : 0;
        const double one = (double)irradiance_at(sky, at, from, 1, step),
                     four = (double)irradiance_at(sky, at, from, 4, step);
        CHECK_MSG(fabs(one / want - 1) < bar, "%s, live %d: %.4f, not %.4f W/m2", what, live, one, want);
        CHECK_MSG(fabs(four / one - 1) < 0.02, "%s, live %d: by four samples %.4f, by one %.4f", what, live, four, one);
    }
}

static void check_open(const lmb_many_lights *sky)
{
    world_begin(0.01f, 0.01f, 0.01f);
    world_quad(vec3(0, 0, 0), mul3(Z, 50), mul3(X, 50));
    world_end();
    check_at(sky, "an open plane", vec3(0, 0, 0), 2, PI, 0.02);
}

/* A frame whose sky does not bounce: without elements, the sky is still gathered. */
static void check_sky_only(const lmb_many_lights *sky)
{
    static lmb_render r;
    lmb_view view;
    world_begin(0.01f, 0.01f, 0.01f);
    world_quad(vec3(0, 0, 0), mul3(Z, 50), mul3(X, 50));
    world_end();
    CHECK(lmb_view_look_at(&view, vec3(0, 2, 0), vec3(0, 0, 0), Z, 0.02f, 8, 8) == LMB_OK);
    lmb_frame_settings s = draft_settings(&world.scene, view);
    s.many_lights = sky;
    s.show = LMB_SHOW_INDIRECT;
    lay_out(&s);
    frame.gather_many_lights = 1;
    frame.elements.data = NULL;
    memset(&r, 0, sizeof r);
    CHECK(lmb_render_frame(&r, &frame) == LMB_OK);
    const double got = (double)((const float *)frame.out.data)[3 * (4 * 8 + 4) + 1] * PI / 0.01;
    CHECK_MSG(fabs(got / PI - 1) < 0.05, "a sky without elements: %.4f, not %.4f W/m2", got, PI);
}

/* Close to an infinite wall, half of the sky is hidden. */
static void check_wall(const lmb_many_lights *sky)
{
    world_begin(0.01f, 0.01f, 0.01f);
    world_quad(vec3(0, 0, 0), mul3(Z, 50), mul3(X, 50));
    world_quad(vec3(0, 25, 0), mul3(Y, 25), mul3(Z, 50));
    world_end();
    check_at(sky, "beside a wall", vec3(0.25f, 0, 0), 2, PI / 2, 0.03);
}

/* A room of 4 x 3 x 4 m with a hole of `half` x 2 in the ceiling: form factors from the library's polygons. */
static void check_window(const lmb_many_lights *sky, const char *what, float half, double bar)
{
    const float rest = 0.5f * (2 - half);
    world_begin(0.01f, 0.01f, 0.01f);
    world_quad(vec3(0, 0, 0), mul3(Z, 2), mul3(X, 2));
    for (int i = 0; i < 2; ++i) {
        const float side = i ? -1.0f : 1.0f;
        world_quad(vec3(2 * side, 1.5f, 0), mul3(Y, 1.5f), mul3(Z, 2));
        world_quad(vec3(0, 1.5f, 2 * side), mul3(Y, 1.5f), mul3(X, 2));
        world_quad(vec3(side * (half + rest), 3, 0), mul3(Z, 2), mul3(X, rest));
        world_quad(vec3(0, 3, side * (half + rest)), mul3(Z, rest), mul3(X, half));
    }
    world_end();
    const lmb_vec3 at = vec3(0.7f, 0, 0.4f);
    const lmb_vec3 corner[4] = {vec3(-half, 3, -half), vec3(half, 3, -half), vec3(half, 3, half), vec3(-half, 3, half)};
    const float factor = lmb_polygon_factor(at, Y, Y, corner, 4, vec3(0, -1, 0));
    check_at(sky, what, at, 1, PI * (double)absf(factor), bar);
}

/* A torus under the sky with few samples; all lengths times `scale`. */
static uint64_t scaled_hash(const lmb_many_lights *sky, float scale, int32_t gather_step)
{
    static torus t;
    lmb_view view;
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    torus_make(&t);
    for (int i = 0; i < 3 * TORUS_VERTICES; ++i) {
        t.positions[i] *= scale;
    }
    for (int i = 0; i < 12; ++i) {
        t.floor[i] *= scale;
    }
    t.scene.light_count = 0;
    lmb_scene_bounds(&t.scene.bounds_min, &t.scene.bounds_max, &t.scene);
    CHECK(lmb_view_look_at(&view, mul3(vec3(3, 3, 5), scale), mul3(vec3(0, 0.5f, 0), scale), Y, 0.7f, 64, 48) == LMB_OK);
    lmb_frame_settings s = draft_settings(&t.scene, view);
    s.gather_step = gather_step;
    draw_sky_light(&s, sky);
    for (int32_t y = 0; y < 48; ++y) {
        const uint8_t *row = (const uint8_t *)frame.out.data + y * frame.out.stride_bytes;
        for (int i = 0; i < 64 * 12; ++i) {
            hash = (hash ^ row[i]) * UINT64_C(0x100000001b3);
        }
    }
    return hash;
}

/* Nothing depends on the metre: scaling by powers of two changes no bit. */
static void check_scales(const lmb_many_lights *sky, int32_t gather_step)
{
    static const float scales[] = {1.0f / 256, 65536};
    const uint64_t want = scaled_hash(sky, 1, gather_step);
    for (int i = 0; i < COUNT(scales); ++i) {
        CHECK_MSG(scaled_hash(sky, scales[i], gather_step) == want, "%g times as large: other bits", (double)scales[i]);
    }
}

#if LMB_LIVE
enum { WIDE = 144, HIGH = 112 };
static float picture[2][3 * WIDE * HIGH];

/* A room with a hole in the ceiling of 2 m, seen from inside. */
static lmb_frame_settings room_settings(const lmb_many_lights *sky, int32_t gather_step)
{
    lmb_view view;
    CHECK(lmb_view_look_at(&view, vec3(-1.6f, 1.2f, -1.7f), vec3(1, 0.8f, 1), Y, 1.2f, WIDE, HIGH) == LMB_OK);
    lmb_frame_settings s = draft_settings(&world.scene, view);
    s.many_lights = sky;
    s.show = LMB_SHOW_INDIRECT;
    s.gather_step = gather_step;
    s.quality = LMB_QUALITY_DEFAULT;
    return s;
}

static void begin_room(float albedo)
{
    world_begin(albedo, albedo, albedo);
    world_quad(vec3(0, 0, 0), mul3(Z, 2), mul3(X, 2));
    for (int i = 0; i < 2; ++i) {
        const float side = i ? -1.0f : 1.0f;
        world_quad(vec3(2 * side, 1.5f, 0), mul3(Y, 1.5f), mul3(Z, 2));
        world_quad(vec3(0, 1.5f, 2 * side), mul3(Y, 1.5f), mul3(X, 2));
        world_quad(vec3(side * 1.5f, 3, 0), mul3(Z, 2), mul3(X, 0.5f));
        world_quad(vec3(0, 3, side * 1.5f), mul3(Z, 0.5f), mul3(X, 1));
    }
    world_quad(vec3(0.2f, 0.8f, 0.6f), mul3(Z, 0.5f), mul3(X, 0.6f));
    world_end();
}

/* Draws into picture[i]; the frame's pieces in `units`, if they are not 0. */
static double draw_room(int i, const lmb_many_lights *sky, int32_t gather_step, int32_t units, int32_t threads)
{
    static lmb_render r;
    double sum = 0;
    lmb_frame_settings s = room_settings(sky, gather_step);
    s.threads = threads;
    lay_out(&s);
    frame.gather_many_lights = 1;
    memset(&r, 0, sizeof r);
    lmb_status status = units == 0 ? lmb_render_frame(&r, &frame) : lmb_render_begin(&r, &frame);
    for (status = units > 0 && status == LMB_OK ? LMB_MORE : status; status == LMB_MORE;) {
        status = lmb_render_step(&r, units);
    }
    CHECK(status == LMB_OK);
    memcpy(picture[i], frame.out.data, sizeof picture[i]);
    for (int k = 0; k < 3 * WIDE * HIGH; ++k) {
        sum += (double)picture[i][k];
    }
    return sum;
}

/* Single points: the light of cuts, also if it is reflected once; the same bytes by steps; a second picture. */
static void check_live(const lmb_many_lights *sky)
{
    static lmb_render r;
    for (int i = 0; i < 2; ++i) {
        double off = 0;
        begin_room(i ? 0.8f : 0.01f);
        const double whole = draw_room(0, sky, 0, 0, 1), live = draw_room(1, sky, LMB_GATHER_LIVE, 0, 1);
        for (int k = 0; k < 3 * WIDE * HIGH; ++k) {
            off += (double)((picture[0][k] - picture[1][k]) * (picture[0][k] - picture[1][k]));
        }
        off = sqrt(off * 3 * WIDE * HIGH) / whole;
        CHECK_MSG(fabs(live / whole - 1) < 0.03 && off < 0.14, "live light of a sky, %d: %.4f of it, rmse %.4f", i,
                  live / whole, off);
    }
    memcpy(picture[0], picture[1], sizeof picture[0]);
    for (int32_t units = 1; units < 100; units += 13) {
        draw_room(1, sky, LMB_GATHER_LIVE, units, 2);
        CHECK_MSG(memcmp(picture[0], picture[1], sizeof picture[0]) == 0, "other bytes in steps of %d", (int)units);
    }
    /* Without the sky, and with it again. */
    lmb_frame_settings s = room_settings(sky, LMB_GATHER_LIVE);
    lay_out(&s);
    memset(&r, 0, sizeof r);
    CHECK(frame.live_sky != NULL && lmb_render_frame(&r, &frame) == LMB_OK);
    CHECK(memcmp(frame.out.data, picture[0], sizeof picture[0]) != 0);
    frame.gather_many_lights = 1;
    lmb_status status = lmb_render_again(&r, &frame);
    CHECK(status == LMB_OK);
    for (status = LMB_MORE; status == LMB_MORE;) {
        status = lmb_render_step(&r, 1000);
    }
    CHECK(status == LMB_OK && memcmp(frame.out.data, picture[0], sizeof picture[0]) == 0);
}

/* A tree of suns and other lights, and one that outgrew the frame, are gathered by cuts. */
static void check_other_lights(const lmb_many_lights *sky)
{
    static uint64_t memory[1 << 14];
    static lmb_render r;
    lmb_many_lights mixed;
    begin_room(0.5f);
    lights[0].kind = LMB_LIGHT_POINT;
    lights[0].position = vec3(0, 2, 0);
    CHECK(lmb_many_lights_init(&mixed, 64, vec3(-2, 0, -2), vec3(2, 3, 2), 64, memory, sizeof memory) == LMB_OK);
    CHECK(lmb_many_lights_add(&mixed, lights, 40) == LMB_OK && lmb_many_lights_build(&mixed) == LMB_OK);
    lmb_frame_settings s = room_settings(&mixed, LMB_GATHER_LIVE);
    lay_out(&s);
    CHECK(frame.live_sky == NULL);
    const double whole = draw_room(0, &mixed, 0, 0, 1), live = draw_room(1, &mixed, LMB_GATHER_LIVE, 0, 1);
    CHECK_MSG(fabs(live / whole - 1) < 0.03, "other lights: %.4f", live / whole);
    const double more = draw_room(0, sky, 0, 0, 1);
    CHECK(lmb_many_lights_init(&mixed, 64, vec3(-2, 0, -2), vec3(2, 3, 2), 64, memory, sizeof memory) == LMB_OK);
    CHECK(lmb_many_lights_add(&mixed, lights + 1, 9) == LMB_OK && lmb_many_lights_build(&mixed) == LMB_OK);
    s = room_settings(&mixed, LMB_GATHER_LIVE);
    lay_out(&s);
    CHECK(frame.live_sky != NULL);
    frame.many_lights = sky;
    frame.gather_many_lights = 1;
    memset(&r, 0, sizeof r);
    CHECK(lmb_render_frame(&r, &frame) == LMB_OK);
    double sum = 0;
    for (int k = 0; k < 3 * WIDE * HIGH; ++k) {
        sum += (double)((const float *)frame.out.data)[k];
    }
    CHECK_MSG(fabs(sum / more - 1) < 0.03, "more suns than room: %.4f", sum / more);
}
#endif

static void check_background(void)
{
    static lmb_render r;
    const lmb_env env = cube();
    lmb_view view;
    float want[3];
    fill(&env, 0.0f);
    CHECK(lmb_env_sky(&env, vec3(0.5f, 0.6f, 0.2f), 3, 1, want) == LMB_OK || 1);
    lmb_env_mips(&env);
    world_begin(0.5f, 0.5f, 0.5f);
    world_quad(vec3(0, 0, -3), mul3(X, 0.5f), mul3(Y, 0.5f));
    world_end();
    CHECK(lmb_view_look_at(&view, vec3(0, 0, 0), vec3(0, 0.2f, -3), Y, 1.0f, 32, 32) == LMB_OK);
    lmb_frame_settings s = draft_settings(&world.scene, view);
    lay_out(&s);
    frame.background = &env;
    memset(&r, 0, sizeof r);
    CHECK(lmb_render_frame(&r, &frame) == LMB_OK);
    const float *p = (const float *)frame.out.data;
    const lmb_vec3 up = add3(mul3(view.back, -1.0f), add3(mul3(view.up, view.half_height * 31.0f / 32),
                                                          mul3(view.right, view.half_width / 32)));
    lmb_env_sample(want, &env, up, view.half_height / 32);
    for (int c = 0; c < 3; ++c) {
        CHECK_MSG(fabsf(p[3 * 16 + c] - want[c]) < 1e-4f * want[c] && want[c] > 0, "above: %g, not %g", (double)p[3 * 16 + c],
                  (double)want[c]);
    }
    CHECK(p[3 * (17 * 32 + 16)] == 0.0f); /* a surface without light */
}

void test_sky(void)
{
    check_sky(2.0f);
    check_sky(3.0f);
    check_sky(8.0f);
    check_refusals();
    check_lights();
    check_sun();
    check_background();
    folder place;
    folder_open(&place);
    for (int i = 0; i < DOWN; i += tries(9, 1)) {
        check_picture_sun(folder_file(&place, "world.pfm"), ACROSS, i * 41 % ACROSS, i);
    }
    check_picture_sun(folder_file(&place, "world.pfm"), MOST_ACROSS, 0, 0); /* no sample meets this pixel */
    check_picture_suns(folder_file(&place, "suns.pfm"));
    char prefix[FOLDER_PATH];
    snprintf(prefix, sizeof prefix, "%s", folder_file(&place, "part_"));
    check_missing_face(folder_file(&place, "part_px.pfm"), prefix);
    folder_close(&place);
    const lmb_many_lights sky = white_sky();
    check_open(&sky);
    check_sky_only(&sky);
    check_scales(&sky, 1);
#if LMB_LIVE
    check_scales(&sky, LMB_GATHER_LIVE);
    check_live(&sky);
    check_other_lights(&sky);
#endif
    check_wall(&sky);
    check_window(&sky, "a hole of 2 m", 1.0f, 0.03);
    check_window(&sky, "a hole of 0.6 m", 0.3f, 0.12);
    free(tree_memory);
    free_laid_out();
}
