/* hard_bounce.c: hard cases of bounced light: form factors, corners, sealed rooms, scales, many lights; the references
 * are closed forms and sums in double. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hard.h"

#define PI 3.14159265358979323846

enum { SIDE = HARD_SIDE };

static lmb_vec3 narrow(dvec v) { return (lmb_vec3){(float)v.x, (float)v.y, (float)v.z}; }

/* --- one disc, one quad ------------------------------------------------------------------------------------------- */

/* Receivers around a disc, at distances down to a millionth of the size: E M / A is a share of the flux, and 0 from
 * behind. */
static void one_disc(hard_list *l)
{
    uint64_t rng = 21;
    double max = 0.0, behind = 0.0;
    for (int i = 0; i < 50000; ++i) {
        const dvec axis = hard_direction(&rng), n = hard_direction(&rng);
        const dvec at = dvec_mul(hard_direction(&rng), pow(10.0, hard_uniform(&rng, -6.0, 1.0)));
        const double area = pow(10.0, hard_uniform(&rng, -6.0, 2.0));
        const double e = (double)lmb_disc_factor(narrow(at), narrow(n), (lmb_vec3){0, 0, 0}, narrow(axis), (float)area);
        const double r = dvec_length(at);
        max = e >= 0.0 ? fmax(max, e * area) : HUGE_VAL;
        behind += e != 0.0 && (dvec_dot(at, axis) < -1e-6 * r || dvec_dot(at, n) > 1e-6 * r);
    }
    hard_put(l, HARD_BOUNDED, "a receiver inside, touching, beside a disc: its share of the flux", max, 1.00001, "");
    hard_put(l, HARD_EXACT, "behind it, or turned away: lit", behind, 0, "pairs");
}

/* Maximum error of the form factor of a quad, for receivers `height` quad sizes above the plane, randomly rotated. */
static double quad_error(double height, uint64_t seed, double tilt)
{
    uint64_t rng = seed;
    double worst = 0.0;
    for (int i = 0; i < 4000; ++i) {
        const dvec u = dvec_of(hard_uniform(&rng, 0.3, 1.0), 0, hard_uniform(&rng, -0.3, 0.3)),
                   v = dvec_of(hard_uniform(&rng, -0.3, 0.3), 0, -hard_uniform(&rng, 0.3, 1.0));
        const dvec corner[4] = {dvec_sub(dvec_mul(u, -1), v), dvec_sub(u, v), dvec_add(u, v), dvec_sub(v, u)};
        const lmb_vec3 at = narrow(dvec_of(hard_uniform(&rng, -2, 2), height, hard_uniform(&rng, -2, 2)));
        const dvec down = dvec_of(0, -1, 0), place = dvec_of((double)at.x, (double)at.y, (double)at.z);
        const dvec n = dvec_unit(dvec_add(dvec_mul(down, 1.0 - tilt), dvec_mul(hard_direction(&rng), tilt)));
        const double area = 4.0 * dvec_length(dvec_cross(u, v));
        const lmb_vec3 face = narrow(n);
        const dvec read = dvec_of((double)face.x, (double)face.y, (double)face.z);
        const double got =
            (double)lmb_quad_factor(at, face, face, (lmb_vec3){0, 0, 0}, (lmb_vec3){0, 1, 0}, narrow(u), narrow(v)) *
            area;
        worst = fmax(worst, fabs(got - hard_true_factor(place, read, corner, 4)));
    }
    return worst;
}

static void one_quad(hard_list *l)
{
    hard_put(l, HARD_BOUNDED, "a receiver a size from a quad: form factor off by", quad_error(1.0, 22, 1.0), 2e-6, "");
    hard_put(l, HARD_BOUNDED, "a hundredth of its size", quad_error(0.01, 23, 1.0), 1e-5, "");
    hard_put(l, HARD_BOUNDED, "four thousandths, seen at right angles", quad_error(0.004, 24, 0.01), 1e-4, "");
    hard_put(l, HARD_BOUNDED, "a hundred sizes", quad_error(100.0, 25, 0.5), 1e-6, "");
}

/* --- surfaces of uniform radiosity -------------------------------------------------------------------------------- */

/* Compares receiver pixels (triangles up to `ids`) with `radiosity` times the form factor of an evenly lit
 * rectangle. */
typedef struct even_errors {
    double worst, mean, pixels;
} even_errors;

static even_errors against_even(const hard_stage *s, uint32_t ids, double albedo, const dvec corner[4],
                                double radiosity, double min)
{
    even_errors e = {0, 0, 0};
    for (int32_t i = 0; i < SIDE * SIDE; ++i) {
        const int32_t x = i % SIDE, y = i / SIDE;
        const uint32_t id = s->id[hard_at(s, x, y)];
        dvec normal;
        if (id == 0 || id > ids) {
            continue;
        }
        const dvec at = hard_surface(&normal, s, x, y, id);
        const double want = radiosity * hard_true_factor(at, normal, corner, 4);
        const double off = fabs((double)s->out[3 * i] * PI / albedo - want) / want;
        if (want > min * radiosity) {
            e.worst = fmax(e.worst, off);
            e.mean += off;
            ++e.pixels;
        }
    }
    e.mean = hard_share(e.mean, e.pixels);
    return e;
}

/* A floor and a wall on it, both in the sun: light of the wall on the floor, up to the corner. */
static void corner_scene(hard_stage *s, dvec c[4], double albedo)
{
    c[0] = dvec_of(-1, 0, 0), c[1] = dvec_of(1, 0, 0), c[2] = dvec_of(1, 2, 0), c[3] = dvec_of(-1, 2, 0);
    hard_begin(s, albedo);
    hard_quad(s, dvec_of(0, 0, 1), dvec_of(1, 0, 0), dvec_of(0, 0, -1));
    hard_quad(s, dvec_of(0, 1, 0), dvec_of(1, 0, 0), dvec_of(0, 1, 0));
    hard_sun(s, dvec_of(0, -0.6, -0.8), 2.0);
    hard_end(s);
    hard_look(s, dvec_of(0.3, 1.6, 2.9), dvec_of(0, 0, 0.9), 50.0, SIDE);
}

static void corner(hard_list *l)
{
    hard_stage *s = l->stage;
    dvec c[4];
    corner_scene(s, c, 0.5);
    hard_frame(s, LMB_SHOW_INDIRECT, 256, 0.002f);
    even_errors e = against_even(s, 2, 0.5, c, 0.5 * 2.0 * 0.8, 0.001);
    hard_put(l, HARD_MEASURED, "a concave corner, lit evenly: worst pixel of the floor", 100 * e.worst, 6, "%");
    hard_put(l, HARD_MEASURED, "mean", 100 * e.mean, 0.7, "%");
    /* Grazing light: the wall's foot, with the sun at 89 degrees from the wall's plane. */
    hard_sun(s, dvec_of(0, -0.9998477, -0.0174524), 2.0);
    hard_end(s);
    hard_frame(s, LMB_SHOW_INDIRECT, 256, 0.002f);
    e = against_even(s, 2, 0.5, c, 0.5 * 2.0 * 0.0174524, 0.001);
    hard_put(l, HARD_MEASURED, "the same, lit at 89 degrees: mean", 100 * e.mean, 10, "%");
}

/* Relative error of the mean light on a ceiling from a bright patch of `texels` on a black floor, over eight positions
 * within a texel. */
static double bright_patch(hard_stage *s, double texels)
{
    const double half = 0.5 * texels * 4.0 / 256.0;
    double got = 0.0, want = 0.0;
    for (int step = 0; step < 8; ++step) {
        const double x = 0.2 + step * 0.37 * 4.0 / 256.0, z = -0.1 + step * 0.61 * 4.0 / 256.0;
        const dvec c[4] = {{x - half, 0.001, z - half},
                           {x + half, 0.001, z - half},
                           {x + half, 0.001, z + half},
                           {x - half, 0.001, z + half}};
        hard_begin(s, 0.5);
        hard_quad(s, dvec_of(-1, 1, 0), dvec_of(0.9, 0, 0), dvec_of(0, 0, 1)); /* the ceiling, not in the sun's way */
        hard_part(s, 0.9);
        hard_quad(s, dvec_of(x, 0.001, z), dvec_of(half, 0, 0), dvec_of(0, 0, -half));
        hard_part(s, 0.0);
        hard_quad(s, dvec_of(0, 0, 0), dvec_of(2, 0, 0), dvec_of(0, 0, -2));
        hard_sun(s, dvec_of(0, -1, 0), 2.0);
        hard_end(s);
        hard_look(s, dvec_of(-1, 0.4, 0.1), dvec_of(-1, 1, 0), 90.0, SIDE);
        hard_frame(s, LMB_SHOW_INDIRECT, 256, 0.002f);
        for (int32_t i = 0; i < SIDE * SIDE; i += 7) {
            const uint32_t id = s->id[hard_at(s, i % SIDE, i / SIDE)];
            dvec normal;
            if (id == 1 || id == 2) {
                const dvec at = hard_surface(&normal, s, i % SIDE, i / SIDE, id);
                got += (double)s->out[3 * i] * PI / 0.5;
                want += 0.9 * 2.0 * hard_true_factor(at, normal, c, 4);
            }
        }
    }
    return 100.0 * fabs(got / want - 1.0);
}

/* Equal nodes: a square lit from above, and a ceiling close to it. */
static void facing(hard_list *l)
{
    const dvec c[4] = {{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}};
    hard_stage *s = l->stage;
    hard_begin(s, 0.5);
    hard_quad(s, dvec_of(3, 0.25, 0), dvec_of(2, 0, 0), dvec_of(0, 0, 1)); /* beside the square, facing down */
    hard_quad(s, dvec_of(0, 0, 0), dvec_of(1, 0, 0), dvec_of(0, 0, -1));
    hard_sun(s, dvec_of(0, -1, 0), 2.0);
    hard_end(s);
    hard_look(s, dvec_of(3, -2.5, 0.1), dvec_of(2.5, 0.25, 0), 50.0, SIDE);
    hard_frame(s, LMB_SHOW_INDIRECT, 256, 0.002f);
    const even_errors e = against_even(s, 2, 0.5, c, 0.5 * 2.0, 0.0005);
    hard_put(l, HARD_MEASURED, "cuts of equal nodes, grazing receivers: mean", 100 * e.mean, 4, "%");
    hard_put(l, HARD_MEASURED, "worst pixel", 100 * e.worst, 10, "%");
    hard_put(l, HARD_MEASURED, "a bright patch of four texels: mean off", bright_patch(s, 4.0), 4, "%");
    hard_put(l, HARD_MEASURED, "of half a texel: mean off", bright_patch(s, 0.5), 60, "%");
}

/* --- sealed rooms ------------------------------------------------------------------------------------------------- */

/* Mean bounced irradiance inside a closed box in the sun, as a share of the sun's. */
static double inside_box(hard_stage *s, double thickness)
{
    double sum = 0.0;
    hard_begin(s, 0.5);
    hard_box(s, dvec_of(0, 1, 0), dvec_of(1, 1, 1));
    if (thickness > 0.0) {
        hard_box(s, dvec_of(0, 1, 0), dvec_of(1 - thickness, 1 - thickness, 1 - thickness));
    }
    hard_quad(s, dvec_of(0, -0.001, 0), dvec_of(4, 0, 0), dvec_of(0, 0, -4));
    hard_quad(s, dvec_of(0, 2, -3), dvec_of(4, 0, 0), dvec_of(0, 2, 0));
    hard_sun(s, dvec_of(0.4, -0.8, -0.45), 2.0);
    hard_end(s);
    hard_look(s, dvec_of(0.8, 1.7, 0.8), dvec_of(-0.3, 0.5, -0.3), 80.0, SIDE);
    s->view.near_m = 0.01f;
    hard_frame(s, LMB_SHOW_INDIRECT, 256, 0.002f);
    for (int i = 0; i < SIDE * SIDE; ++i) {
        sum += (double)s->out[3 * i] * PI / 0.5;
    }
    return sum / (SIDE * SIDE) / 2.0;
}

static void sealed(hard_list *l)
{
    hard_put(l, HARD_BOUNDED, "a closed box of 5 cm in the sun: light inside", inside_box(l->stage, 0.05), 1e-4,
             "of the sun's");
    hard_put(l, HARD_BOUNDED, "of 1 mm, a tenth of a texel", inside_box(l->stage, 0.001), 1e-4, "of the sun's");
    hard_put(l, HARD_BOUNDED, "of one leaf", inside_box(l->stage, 0.0), 1e-4, "of the sun's");
}

/* --- scales ------------------------------------------------------------------------------------------------------- */

static double scaled_light(hard_stage *s, double scale, int exactly)
{
    static float first[SIDE * SIDE * 3];
    dvec c[4];
    double worst = 0.0, unlike = 0.0;
    corner_scene(s, c, 0.5);
    hard_frame(s, LMB_SHOW_INDIRECT, 128, 0.002f);
    memcpy(first, s->out, sizeof first);
    hard_sun(s, dvec_of(0, -0.6, -0.8), 2.0 * scale);
    hard_end(s);
    hard_frame(s, LMB_SHOW_INDIRECT, 128, 0.002f);
    for (int i = 0; i < SIDE * SIDE * 3; ++i) {
        const double want = (double)first[i] * scale, got = (double)s->out[i];
        unlike += got != want;
        worst = fmax(worst, fabs(got - want) / (want > 0.0 ? want : 1.0));
    }
    return exactly ? unlike : worst;
}

/* Pixels that differ from `times` the picture at albedo 0.5: light is proportional to the albedos of wall and floor. */
static double scaled_albedo(hard_stage *s, double albedo, double times)
{
    static float first[SIDE * SIDE * 3];
    dvec c[4];
    double unlike = 0.0;
    corner_scene(s, c, 0.5);
    hard_frame(s, LMB_SHOW_INDIRECT, 128, 0.002f);
    memcpy(first, s->out, sizeof first);
    corner_scene(s, c, albedo);
    hard_frame(s, LMB_SHOW_INDIRECT, 128, 0.002f);
    for (int i = 0; i < SIDE * SIDE * 3; ++i) {
        unlike += (double)s->out[i] != (double)first[i] * times;
    }
    return unlike;
}

static void scales(hard_list *l)
{
    hard_stage *s = l->stage;
    hard_put(l, HARD_EXACT, "light x 2^-20 and x 2^20: other bits",
             scaled_light(s, ldexp(1, -20), 1) + scaled_light(s, ldexp(1, 20), 1), 0, "values");
    hard_put(l, HARD_MEASURED, "light x 1e-6 and x 1e6: off by",
             1e6 * fmax(scaled_light(s, 1e-6, 0), scaled_light(s, 1e6, 0)), 1000, "ppm");
    hard_put(l, HARD_EXACT, "albedo 0: light left", scaled_albedo(s, 0.0, 0.0), 0, "values");
    hard_put(l, HARD_EXACT, "albedo 1 and 2, of 0.5: not 4 and 16 times",
             scaled_albedo(s, 1.0, 4.0) + scaled_albedo(s, 2.0, 16.0), 0, "values");
}

/* --- a million lights --------------------------------------------------------------------------------------------- */

enum { LIGHTS = 1000000, CELLS = 4096, RECEIVERS = 4 };

static double true_sum(const lmb_light *light, const lmb_tile *tile, int k)
{
    double sum = 0.0;
    for (int i = 0; i < LIGHTS; ++i) {
        const double x = (double)light[i].position.x - (double)tile->position[0][k],
                     y = (double)light[i].position.y - (double)tile->position[1][k],
                     z = (double)light[i].position.z - (double)tile->position[2][k], d2 = x * x + y * y + z * z;
        sum += y > 0.0 ? (double)light[i].intensity[0] * y / (d2 * sqrt(d2)) : 0.0;
    }
    return sum;
}

static void floor_tile(lmb_tile *t)
{
    memset(t, 0, sizeof *t);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        t->position[0][k] = 0.02f * (float)(k % 8);
        t->position[2][k] = 0.02f * (float)(k / 8);
        t->normal[1][k] = t->face[1][k] = t->depth[k] = 1.0f;
        t->id[k] = 1;
    }
    t->hits = LMB_TILE_PIXELS;
}

static void million_lights(hard_list *l)
{
    static lmb_many_lights_scratch scratch;
    hard_stage *s = l->stage;
    const size_t bytes = lmb_many_lights_bytes(CELLS);
    lmb_light *light = calloc(LIGHTS, sizeof *light);
    void *memory = malloc(bytes);
    lmb_many_lights many_lights;
    lmb_many_lights_query query;
    uint64_t rng = 26;
    double worst = light != NULL && memory != NULL ? 0.0 : HUGE_VAL;
    memset(&query, 0, sizeof query);
    for (int i = 0; i < LIGHTS && worst == 0.0; ++i) {
        light[i].position =
            narrow(dvec_of(hard_uniform(&rng, -5, 5), hard_uniform(&rng, 0.3, 3), hard_uniform(&rng, -5, 5)));
        light[i].intensity[0] = light[i].intensity[1] = light[i].intensity[2] =
            (float)pow(10.0, hard_uniform(&rng, -6, 0));
    }
    if (worst == 0.0 && lmb_many_lights_init(&many_lights, CELLS, (lmb_vec3){-5, 0, -5}, (lmb_vec3){5, 3, 5}, 1e6f,
                                             memory, bytes) == LMB_OK) {
        lmb_many_lights_add(&many_lights, light, LIGHTS);
        lmb_many_lights_build(&many_lights);
        query.many_lights = &many_lights;
        memset(&s->lit, 0, sizeof s->lit);
        floor_tile(&s->tile);
        lmb_many_lights_direct_tile(&s->lit, s->kernels, &scratch, &s->tile, &query);
        for (int i = 0; i < RECEIVERS; ++i) {
            const int k = i * 21;
            worst = fmax(worst, fabs((double)s->lit.rgb[0][k] / true_sum(light, &s->tile, k) - 1.0));
        }
    }
    hard_put(l, HARD_MEASURED, "a million lights without shadows, against a sum in double", 100.0 * worst, 2, "%");
    free(light);
    free(memory);
}

void hard_bounce(hard_list *l)
{
    one_disc(l);
    one_quad(l);
    corner(l);
    facing(l);
    sealed(l);
    scales(l);
    million_lights(l);
}
