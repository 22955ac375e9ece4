/* main_steady.c: measures whether moving light stays steady. measure-steady [residual|halving|shift|bend]
 * SCENE [options of `lambent play`]
 *
 * Measures grey irradiance of bounced light at points that are tracked from frame to frame. Except for shifts, a value
 * is divided by the best settings' light at the point plus 1 % of its mean.
 *
 * `residual`: r = frame - best, at twenty times along the paths: the 99.9th percentiles of |r(t) - r(t-1)| and of
 * |r(t+1) - 2 r(t) + r(t-1)|, and beside them those of the best light's own steps.
 *
 * `halving`: only the light moves, over one frame's time at four times: the largest change of any pixel
 * between frames 1, 1/2 .. 1/64 of it apart. A change that does not shrink to 0.6 with each step is a pop; the
 * place of the largest is printed.
 *
 * `shift`: the camera moves sideways by 1/4 .. 16 px at the distance of the surface ahead: RMSE of the change at a
 * point beyond that of the best light, without the worst 1 %, relative to the mean. The bar is 2 %.
 *
 * `bend`, only if you name it: a light or the camera moves by 0.05 % of the scene's diagonal a frame (a sun's direction
 * by 0.001, a pan by 0.0005 rad): |l(t+1) - 2 l(t) + l(t-1)|, divided by the mean of the three plus 5 % of the frame's
 * mean; the values that 95, 99 and 99.9 of 100 places stay under. Nothing else is drawn, so it is fast at full size.
 *
 * Ends with `N passed, N failed, N skipped`. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../src/base/vec.h"
#include "../test.h"
#include "steady_frame.h"

int test_passed, test_failed, test_skipped;

enum { PAIRS = 20, FINEST = 64, LEVELS = 7, TIMES = 4 };
#define SHRINKS 0.6
#define SHIFTED 0.02

static steady_stage stage;

static int stop(const report *r)
{
    printf("FAIL %s\n", r->text);
    printf("%d passed, %d failed, %d skipped\n", test_passed, test_failed + 1, test_skipped);
    return 1;
}

/* --- sorted errors ------------------------------------------------------------------------------------------------ */

typedef struct list {
    float *value;
    size_t count, cap;
} list;

static int list_make(list *l, size_t cap)
{
    l->value = malloc(cap * sizeof *l->value);
    l->count = 0;
    l->cap = cap;
    return l->value != NULL;
}

static void list_add(list *l, float v)
{
    if (l->count < l->cap) {
        l->value[l->count++] = v;
    }
}

static int rising(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

/* The value that a `share` of the list does not exceed. */
static double quantile(list *l, double share)
{
    qsort(l->value, l->count, sizeof *l->value, rising);
    return l->count > 0 ? (double)l->value[(size_t)(share * (double)(l->count - 1))] : 0.0;
}

/* Root mean square without the worst 1 %. */
static double trimmed_rmse(list *l)
{
    double sum = 0.0;
    quantile(l, 1.0);
    const size_t kept = l->count - l->count / 100;
    for (size_t i = 0; i < kept; ++i) {
        sum += (double)l->value[i];
    }
    return kept > 0 ? sqrt(sum / (double)kept) : 0.0;
}

static float mean_of(const float *rgb, int32_t pixels)
{
    double sum = 0.0;
    for (int32_t i = 0; i < 3 * pixels; ++i) {
        sum += (double)rgb[i];
    }
    return (float)(sum / (3.0 * (double)pixels));
}

/* --- residuals along the paths ------------------------------------------------------------------------------------ */

enum { STEP, BEND, BEST_STEP, BEST_BEND, LISTS };

static void add_residuals(list lists[LISTS], const steady_frame frame[3])
{
    const steady_frame *now = &frame[1];
    const int32_t pixels = now->width * now->height;
    const float floor_w = 0.01f * mean_of(now->best, pixels);
    for (int32_t i = 0; i < pixels; ++i) {
        float light[3], best[3], r[3];
        int known = 1;
        for (int t = 0; t < 3 && known; ++t) {
            known = steady_look(&light[t], &best[t], &frame[t], now, i);
            r[t] = light[t] - best[t];
        }
        if (known) {
            const float per = 1.0f / (best[1] + floor_w);
            list_add(&lists[STEP], absf(r[1] - r[0]) * per);
            list_add(&lists[BEND], absf(r[2] - 2.0f * r[1] + r[0]) * per);
            list_add(&lists[BEST_STEP], absf(best[1] - best[0]) * per);
            list_add(&lists[BEST_BEND], absf(best[2] - 2.0f * best[1] + best[0]) * per);
        }
    }
}

/* Twenty times, half a second apart: one whole turn of the default paths. */
static int measure_residuals(steady_frame frame[3], report *r)
{
    list lists[LISTS];
    const size_t most = (size_t)PAIRS * (size_t)frame->width * (size_t)frame->height;
    int ok = 1;
    memset(lists, 0, sizeof lists);
    for (int i = 0; i < LISTS && ok; ++i) {
        ok = list_make(&lists[i], most) || report_fail(r, "out of memory");
    }
    for (int pair = 0; pair < PAIRS && ok; ++pair) {
        const int32_t k = 1 + (int32_t)((float)pair * 0.5f * stage.o.fps);
        for (int t = 0; t < 3 && ok; ++t) {
            ok = play_motion_set(&stage.motion, k + t - 1, r) && steady_draw(&frame[t], &stage, r);
        }
        if (ok) {
            add_residuals(lists, frame);
        }
    }
    if (ok) {
        printf("residual   99.9 of 100 places: step %.4f, bend %.4f   (the best light's own: %.4f, %.4f)\n",
               quantile(&lists[STEP], 0.999), quantile(&lists[BEND], 0.999), quantile(&lists[BEST_STEP], 0.999),
               quantile(&lists[BEST_BEND], 0.999));
        printf("residual   median:             step %.4f, bend %.4f   (the best light's own: %.4f, %.4f)\n",
               quantile(&lists[STEP], 0.5), quantile(&lists[BEND], 0.5), quantile(&lists[BEST_STEP], 0.5),
               quantile(&lists[BEST_BEND], 0.5));
        CHECK(lists[STEP].count > most / 10);
    }
    for (int i = 0; i < LISTS; ++i) {
        free(lists[i].value);
    }
    return ok;
}

/* --- steps halved ------------------------------------------------------------------------------------------------- */

/* The largest change of a pixel between two frames, and its place. */
typedef struct change {
    double size;
    int32_t at, pixel;
} change;

static void keep_largest(change *c, const float *a, const float *b, int32_t pixels, float floor_w, int32_t at)
{
    for (int32_t i = 0; i < pixels; ++i) {
        const float x = a[3 * i] + a[3 * i + 1] + a[3 * i + 2], y = b[3 * i] + b[3 * i + 1] + b[3 * i + 2];
        const double size = (double)(absf(x - y) / (0.5f * (x + y) + 3.0f * floor_w));
        if (size > c->size) {
            c->size = size;
            c->at = at;
            c->pixel = i;
        }
    }
}

/* Draws all frames of one frame's time; finds the largest change at each step. */
static int halve(change level[LEVELS], float *kept, steady_frame *frame, int32_t first, report *r)
{
    const int32_t pixels = frame->width * frame->height;
    const size_t floats = 3 * (size_t)pixels;
    for (int32_t k = 0; k <= FINEST; ++k) {
        if (!play_motion_set(&stage.motion, first + k, r) || !steady_draw(frame, &stage, r)) {
            return 0;
        }
        memcpy(kept + (size_t)k * floats, frame->light, floats * sizeof *kept);
    }
    const float floor_w = 0.01f * mean_of(kept, pixels);
    for (int l = 0; l < LEVELS; ++l) {
        const int32_t step = FINEST >> l;
        for (int32_t k = 0; k + step <= FINEST; k += step) {
            keep_largest(&level[l], kept + (size_t)k * floats, kept + (size_t)(k + step) * floats, pixels, floor_w,
                         first + k);
        }
    }
    return 1;
}

static void tell_halving(const change level[LEVELS], int32_t width)
{
    printf("halving    largest change:");
    for (int l = 0; l < LEVELS; ++l) {
        printf(" %.5f", level[l].size);
    }
    printf("\nhalving    shrinks to:    ");
    for (int l = 1; l < LEVELS; ++l) {
        printf(" %.3f", level[l].size / level[l - 1].size);
    }
    printf("   at 1/64: frame %.4f, pixel %d,%d\n", (double)level[LEVELS - 1].at / FINEST,
           (int)(level[LEVELS - 1].pixel % width), (int)(level[LEVELS - 1].pixel / width));
    for (int l = 1; l < LEVELS; ++l) {
        CHECK_MSG(level[l].size <= SHRINKS * level[l - 1].size, "1/%d of a frame: %g after %g", 1 << l, level[l].size,
                  level[l - 1].size);
    }
}

static int measure_halving(steady_frame *frame, report *r)
{
    change level[LEVELS];
    const float swing = stage.motion.swing;
    const size_t floats = 3 * (size_t)frame->width * (size_t)frame->height;
    float *kept = malloc((FINEST + 1) * floats * sizeof *kept);
    int ok = kept != NULL || report_fail(r, "out of memory");
    memset(level, 0, sizeof level);
    stage.motion.swing = 0.0f;
    stage.motion.moves = KEY_LIGHT;
    stage.o.fps *= FINEST;
    for (int t = 0; t < TIMES && ok; ++t) {
        ok = halve(level, kept, frame, FINEST * (5 + 71 * t), r);
    }
    stage.o.fps /= FINEST;
    stage.motion.swing = swing;
    stage.motion.moves = stage.o.move;
    free(kept);
    if (ok) {
        tell_halving(level, frame->width);
    }
    return ok;
}

/* --- shifts of the camera ----------------------------------------------------------------------------------------- */

/* Metres a pixel at the distance of the surface ahead. */
static float pixel_m(const steady_frame *f)
{
    const int32_t middle = f->height / 2 * f->width + f->width / 2;
    const float away = length3(sub3(f->place[middle], f->view.eye));
    return 2.0f * f->view.half_width * (f->view.kind == LMB_PERSPECTIVE ? away : 1.0f) / (float)f->width;
}

static int measure_shift(const steady_frame *rest, steady_frame *frame, float pixels, report *r)
{
    const int32_t all = rest->width * rest->height;
    list squares, own;
    stage.job.middle = stage.motion.view_at_rest;
    stage.job.middle.eye = add3(stage.job.middle.eye, mul3(stage.job.middle.right, pixels * pixel_m(rest)));
    memset(&own, 0, sizeof own);
    int ok = (list_make(&squares, (size_t)all) && list_make(&own, (size_t)all)) || report_fail(r, "out of memory");
    ok = ok && steady_draw(frame, &stage, r);
    for (int32_t i = 0; i < all && ok; ++i) {
        float light[2], best[2];
        if (steady_look(&light[0], &best[0], rest, rest, i) && steady_look(&light[1], &best[1], frame, rest, i)) {
            const float d = (light[1] - light[0]) - (best[1] - best[0]);
            list_add(&squares, d * d);
            list_add(&own, (best[1] - best[0]) * (best[1] - best[0]));
        }
    }
    if (ok) {
        const double mean = (double)mean_of(rest->best, all), error = trimmed_rmse(&squares) / mean;
        printf("shift      %5.2f px: %.4f   (the best light's own: %.4f; %.0f %% of the pixels)\n", (double)pixels, error,
               trimmed_rmse(&own) / mean, 100.0 * (double)squares.count / (double)all);
        CHECK_MSG(error <= SHIFTED, "a shift by %g px: %g", (double)pixels, error);
    }
    free(squares.value);
    free(own.value);
    return ok;
}

static int measure_shifts(steady_frame frame[2], report *r)
{
    static const float shifts[] = {0.25f, 1.0f, 3.0f, 8.0f, 16.0f};
    if (!play_motion_set(&stage.motion, 0, r)) {
        return 0;
    }
    stage.job.middle = stage.motion.view_at_rest;
    if (!steady_draw(&frame[0], &stage, r)) {
        return 0;
    }
    for (int i = 0; i < 5; ++i) {
        if (!measure_shift(&frame[0], &frame[1], shifts[i], r)) {
            return 0;
        }
    }
    return 1;
}

/* --- bends: small steps of the light or the camera ---------------------------------------------------------------- */

enum { BEND_FRAMES = 6 };
#define BEND_M    0.0005f /* step of a light or of the camera, as a share of the scene's diagonal */
#define BEND_RAD  0.0005f /* step of a pan */
#define BEND_SUN  0.001f  /* step of a sun's direction */
#define BEND_DARK 0.05f   /* of the mean light, added to the local light */

/* Moves all lights, or the camera, `steps` steps from rest. */
static int move_by(const char *what, float steps, report *r)
{
    const lmb_scene *s = &stage.job.scene;
    const float by = BEND_M * length3(sub3(s->bounds_max, s->bounds_min)) * steps, turn = BEND_RAD * steps;
    const lmb_vec3 way = normalize3(vec3(1.0f, 0.2f, 0.6f));
    lmb_view *v = &stage.job.middle;
    if (!play_motion_set(&stage.motion, 0, r)) {
        return 0;
    }
    *v = stage.motion.view_at_rest;
    if (strcmp(what, "dolly") == 0) {
        v->eye = add3(v->eye, mul3(v->back, -by));
    } else if (strcmp(what, "pan") == 0) {
        v->right = normalize3(add3(v->right, mul3(v->back, turn)));
        v->back = cross3(v->right, v->up);
    }
    for (uint32_t i = 0; i < s->light_count && strcmp(what, "light") == 0; ++i) {
        lmb_light *l = &stage.motion.light[i];
        const lmb_light *rest = &stage.motion.light_at_rest[i];
        if (l->kind == LMB_LIGHT_POINT || l->kind == LMB_LIGHT_SPOT) {
            l->position = add3(rest->position, mul3(way, by));
        } else {
            l->direction = normalize3(add3(rest->direction, mul3(way, BEND_SUN * steps)));
        }
        ++l->revision;
    }
    return 1;
}

static void add_bends(list *out, const steady_frame *before, const steady_frame *now, const steady_frame *after,
                      float floor_w)
{
    for (int32_t i = 0; i < now->width * now->height; ++i) {
        float light[3], none;
        if (steady_look(&light[0], &none, before, now, i) && steady_look(&light[1], &none, now, now, i) &&
            steady_look(&light[2], &none, after, now, i)) {
            list_add(out, absf(light[0] - 2.0f * light[1] + light[2]) /
                              ((light[0] + light[1] + light[2]) * (1.0f / 3.0f) + floor_w));
        }
    }
}

static int measure_bends(steady_frame frame[3], const char *what, report *r)
{
    const int32_t pixels = frame[0].width * frame[0].height;
    list bends;
    int ok = list_make(&bends, (size_t)(BEND_FRAMES - 2) * (size_t)pixels) || report_fail(r, "out of memory");
    for (int t = 0; t < BEND_FRAMES && ok; ++t) {
        ok = move_by(what, (float)t, r) && steady_draw(&frame[t % 3], &stage, r);
        if (ok && t >= 2) {
            add_bends(&bends, &frame[(t - 2) % 3], &frame[(t - 1) % 3], &frame[t % 3],
                      BEND_DARK * mean_of(frame[(t - 1) % 3].light, pixels));
        }
    }
    if (ok) {
        const double p95 = quantile(&bends, 0.95), p99 = quantile(&bends, 0.99), p999 = quantile(&bends, 0.999);
        printf("bend       %-6s %.4f %.4f %.4f\n", what, p95, p99, p999);
        CHECK(bends.count > (size_t)(BEND_FRAMES - 2) * (size_t)pixels / 10);
    }
    free(bends.value);
    return ok;
}

/* ------------------------------------------------------------------------------------------------------------------ */

static int make_stage(report *r)
{
    stage.o.render.show = LMB_SHOW_IRRADIANCE;
    stage.job.o = stage.o.render;
    return play_motion_read(&stage.motion, &stage.o, r) && render_job_load(&stage.job, r) &&
           play_motion_find(&stage.motion, &stage.job, r) && render_job_set(&stage.job, r) &&
           play_motion_make(&stage.motion, r);
}

static int is_asked(const char *only, const char *what) { return only == NULL || strcmp(only, what) == 0; }

static int measure(const char *only, report *r)
{
    steady_frame with[3], without[3];
    int ok = make_stage(r);
    const int32_t w = stage.job.o.view.width, h = stage.job.o.view.height;
    memset(with, 0, sizeof with);
    memset(without, 0, sizeof without);
    for (int i = 0; i < 3; ++i) {
        ok = ok && ((steady_frame_make(&with[i], w, h, 1) && steady_frame_make(&without[i], w, h, 0)) ||
                    report_fail(r, "out of memory"));
    }
    for (int i = 0; i < 3 && ok && only != NULL && strcmp(only, "bend") == 0; ++i) {
        static const char *const what[] = {"light", "pan", "dolly"};
        ok = measure_bends(without, what[i], r);
    }
    ok = ok && (!is_asked(only, "halving") || measure_halving(&without[0], r)) &&
         (!is_asked(only, "shift") || measure_shifts(with, r)) &&
         (!is_asked(only, "residual") || measure_residuals(with, r));
    for (int i = 0; i < 3; ++i) {
        steady_frame_free(&with[i]);
        steady_frame_free(&without[i]);
    }
    return ok;
}

int main(int argc, char **argv)
{
    static const char *const parts[] = {"residual", "halving", "shift", "bend"};
    report r = {""};
    const char *only = NULL;
    for (int i = 0; i < 4 && argc > 1 && only == NULL; ++i) {
        only = strcmp(argv[1], parts[i]) == 0 ? parts[i] : NULL;
    }
    argc -= only != NULL;
    argv += only != NULL;
    const int asked = play_options_parse(&stage.o, argc, argv, &r);
    if (asked != OPTIONS_RUN) {
        return options_answer(asked, &play_table, &r);
    }
    const int ok = measure(only, &r);
    play_check_free(&stage.check);
    play_motion_free(&stage.motion);
    render_job_free(&stage.job);
    if (!ok) {
        return stop(&r);
    }
    printf("%d passed, %d failed, %d skipped\n", test_passed, test_failed, test_skipped);
    return test_failed > 0;
}
