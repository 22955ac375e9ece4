/* main_lights.c: measures baked light with lights that were unknown at bake time: measure-lights SCENE
 * [options of `lambent play`]
 *
 * Draws twenty lights from a fixed seed, one at a time. A light is placed at a reachable point of the scene's box:
 * visible from the eye or an earlier point, with free space around, so that no light lies inside a solid. Kinds
 * take turns: point, spot, sun. A sun shines on such a point; if walls block every sun direction, a spot replaces
 * the sun. Directions are uniform over the sphere. Powers are log-uniform over two decades. Each light is drawn
 * with the options and with the best settings. An error is divided by the mean of the best picture, or by 5 % of
 * the median of these means if that is larger. The last line has the means over all lights, the worst, and how many
 * lights were under those 5 %. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../src/base/poly.h"
#include "../../src/base/vec.h"
#include "../../tools/play/play_check.h"
#include "../../tools/play/play_options.h"
#include "../../tools/play/play_space.h"
#include "../test.h"

int test_passed, test_failed, test_skipped;

enum { LIGHTS = 20, SEED = 1, TRIES = 64, AROUND = 26, PATIENCE = 100000 };
#define ROOM 0.02f /* of the box's diagonal: free distance around a light */
#define FAR  0.25f /* of the diagonal: distance at which a light of medium power gives 1 W/m2 */
#define DIM  0.05  /* of the median of means */

typedef struct drawn {
    lmb_light light;
    metrics error; /* against the best settings */
} drawn;

typedef struct dice {
    test_rng rng;
    play_space space;
    lmb_vec3 low, size, place[LIGHTS + 1]; /* the eye, then one place per light */
    int places;
    float diagonal;
} dice;

/* --- lights ------------------------------------------------------------------------------------------------------- */

static lmb_vec3 any_direction(test_rng *rng)
{
    const float z = test_uniform(rng, -1.0f, 1.0f), turn = test_uniform(rng, 0.0f, 2.0f * LMB_PI);
    const float flat = sqrtf(maxf(0.0f, 1.0f - z * z));
    return vec3(flat * cosf(turn), flat * sinf(turn), z);
}

/* Returns whether the corners, edges and faces of a cube around the point are visible from the point. */
static int has_room(dice *d, lmb_vec3 at)
{
    lmb_vec3 around[AROUND];
    int n = 0;
    for (int i = 0; i < 27; ++i) {
        const lmb_vec3 step = vec3((float)(i % 3 - 1), (float)(i / 3 % 3 - 1), (float)(i / 9 - 1));
        if (i != 13) {
            around[n++] = add3(at, mul3(step, ROOM * d->diagonal));
        }
    }
    return play_space_sees(&d->space, at, around, n);
}

static int is_reached(dice *d, lmb_vec3 at)
{
    int seen = 0;
    for (int i = 0; i < d->places && !seen; ++i) {
        seen = play_space_sees(&d->space, d->place[i], &at, 1);
    }
    return seen && has_room(d, at);
}

static int find_place(dice *d, report *r)
{
    for (int i = 0; i < PATIENCE; ++i) {
        const float x = test_uniform(&d->rng, 0, 1), y = test_uniform(&d->rng, 0, 1), z = test_uniform(&d->rng, 0, 1);
        const lmb_vec3 at = add3(d->low, vec3(x * d->size.x, y * d->size.y, z * d->size.z));
        if (is_reached(d, at)) {
            d->place[d->places++] = at;
            return 1;
        }
    }
    return report_fail(r, "no room for lights");
}

/* Finds a direction from which the sun reaches a point; returns 0 if none was found. */
static int shines_in(lmb_vec3 *direction, dice *d, lmb_vec3 at)
{
    for (int i = 0; i < TRIES; ++i) {
        *direction = any_direction(&d->rng);
        const lmb_vec3 out = sub3(at, mul3(*direction, 2.0f * d->diagonal));
        if (play_space_sees(&d->space, at, &out, 1)) {
            return 1;
        }
    }
    return 0;
}

static int roll(lmb_light *out, dice *d, int number, report *r)
{
    memset(out, 0, sizeof *out);
    if (!find_place(d, r)) {
        return 0;
    }
    out->position = d->place[d->places - 1];
    out->kind = (uint32_t)number % 3; /* LMB_LIGHT_* */
    if (out->kind == LMB_LIGHT_DIRECTIONAL && !shines_in(&out->direction, d, out->position)) {
        out->kind = LMB_LIGHT_SPOT;
    }
    if (out->kind != LMB_LIGHT_DIRECTIONAL) {
        out->direction = any_direction(&d->rng);
    }
    const float outer = test_uniform(&d->rng, 15.0f, 60.0f), inner = outer * test_uniform(&d->rng, 0.5f, 1.0f);
    out->cos_outer = cosf(outer * LMB_PI / 180.0f);
    out->cos_inner = cosf(inner * LMB_PI / 180.0f);
    const float way = out->kind == LMB_LIGHT_DIRECTIONAL ? 1.0f : FAR * d->diagonal;
    const float power = powf(10.0f, test_uniform(&d->rng, -1.0f, 1.0f)) * way * way;
    for (int c = 0; c < 3; ++c) {
        out->intensity[c] = power * test_uniform(&d->rng, 0.5f, 1.0f);
    }
    return 1;
}

static int roll_all(drawn all[LIGHTS], const render_options *o, report *r)
{
    render_job j;
    dice d;
    memset(&j, 0, sizeof j);
    memset(&d, 0, sizeof d);
    j.o = *o;
    j.o.transfer = NULL;
    int ok = render_job_load(&j, r) && render_job_set(&j, r) && play_space_make(&d.space, &j.scene, o->kernels, r);
    d.rng.state = SEED;
    if (ok) {
        d.low = j.scene.bounds_min;
        d.size = sub3(j.scene.bounds_max, d.low);
        d.diagonal = length3(d.size);
        d.place[0] = j.middle.eye;
        d.places = 1;
    }
    for (int i = 0; i < LIGHTS && ok; ++i) {
        ok = roll(&all[i].light, &d, i, r);
    }
    play_space_free(&d.space);
    render_job_free(&j);
    return ok;
}

/* --- pictures ----------------------------------------------------------------------------------------------------- */

static int draw(drawn *out, const render_options *o, report *r)
{
    render_job j;
    play_check check;
    int32_t stage;
    memset(&j, 0, sizeof j);
    memset(&check, 0, sizeof check);
    j.o = *o;
    j.o.lights[0] = out->light;
    j.o.light_count = 1;
    int ok = render_job_load(&j, r) && render_job_set(&j, r);
    if (ok) {
        render_job_eye(&j, &j.frame, &j.linear, 0);
        const lmb_status status = workers_reuse(&j.workers, &stage, j.render, &j.frame);
        ok = status == LMB_OK || report_fail(r, "drawing stopped: %s", lmb_status_name(status));
    }
    ok = ok && play_check_frame(&out->error, &check, &j, 0, r);
    play_check_free(&check);
    render_job_free(&j);
    return ok;
}

static int rising(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median_mean(const drawn all[LIGHTS])
{
    double mean[LIGHTS];
    for (int i = 0; i < LIGHTS; ++i) {
        mean[i] = all[i].error.truth_mean;
    }
    qsort(mean, LIGHTS, sizeof *mean, rising);
    return 0.5 * (mean[(LIGHTS - 1) / 2] + mean[LIGHTS / 2]);
}

/* In the form of --light. */
static void tell_light(const lmb_light *l)
{
    static const char *const names[] = {"point", "spot", "sun"};
    const lmb_vec3 p = l->position, d = l->direction;
    const double degrees = 180.0 / (double)LMB_PI;
    printf("%s:%.3f,%.3f,%.3f:%.3f,%.3f,%.3f:%.3g,%.3g,%.3g", names[l->kind], (double)p.x, (double)p.y, (double)p.z,
           (double)d.x, (double)d.y, (double)d.z, (double)l->intensity[0], (double)l->intensity[1],
           (double)l->intensity[2]);
    if (l->kind == LMB_LIGHT_SPOT) {
        printf(":%.2f,%.2f", degrees * acos((double)l->cos_inner), degrees * acos((double)l->cos_outer));
    }
}

static void tell(const drawn all[LIGHTS])
{
    const double median = median_mean(all);
    double trim = 0.0, rmse = 0.0, worst = 0.0;
    int dim = 0;
    for (int i = 0; i < LIGHTS; ++i) {
        const metrics *e = &all[i].error;
        const int is_dim = e->truth_mean < DIM * median;
        const double per = is_dim ? e->truth_mean / (DIM * median) : 1.0;
        printf("light %2d: trim %.4f rmse %.4f mean %.4f%s  ", i, per * e->trim, per * e->rmse, e->mean,
               is_dim ? " dim" : "");
        tell_light(&all[i].light);
        printf("\n");
        trim += per * e->trim / LIGHTS;
        rmse += per * e->rmse / LIGHTS;
        worst = fmax(worst, per * e->trim);
        dim += is_dim;
    }
    printf("lights: trim %.4f rmse %.4f worst %.4f dim %d\n", trim, rmse, worst, dim);
    CHECK(median > 0.0);
}

int main(int argc, char **argv)
{
    static play_options o;
    static drawn all[LIGHTS];
    report r = {""};
    const int asked = play_options_parse(&o, argc, argv, &r);
    if (asked != OPTIONS_RUN) {
        return options_answer(asked, &play_table, &r);
    }
    o.render.show = LMB_SHOW_INDIRECT;
    int ok = roll_all(all, &o.render, &r);
    for (int i = 0; i < LIGHTS && ok; ++i) {
        ok = draw(&all[i], &o.render, &r);
    }
    if (ok) {
        tell(all);
    } else {
        printf("FAIL %s\n", r.text);
    }
    printf("%d passed, %d failed, %d skipped\n", test_passed, test_failed + !ok, test_skipped);
    return test_failed > 0 || !ok;
}
