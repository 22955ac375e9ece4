/* hard_pillar.c: round objects in low sun on a wide floor: light that they reflect to the floor, in closed form.
 *
 * The objects are convex and the floor is flat, so a point of the floor sees a facet wholly or not at all, and each
 * facet is lit wholly or not at all: the truth is Lambert's sum over the lit facets. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hard.h"

#define PI 3.14159265358979323846
#define ALBEDO 0.7
#define SUN 10.0  /* W/m2 perpendicular to the rays */
#define NEAR 2.0  /* m from an object's middle: the floor that is compared */

/* Texels of map and tree as wide as those of 1,024 and 256 over 30 m, the tool's defaults. */
enum { SIDE = 48, MAP = 256, TREE = 64 };
#define GROUND 3.75 /* m: half the floor's width */

enum { CYLINDER, CONE, BALL, THINGS };

typedef struct pillar {
    int kind, facets;
    double radius, high, height_deg, around_deg; /* the sun's elevation and azimuth */
} pillar;

static dvec on_rim(const pillar *p, int i, double radius, double y)
{
    const double a = 2.0 * PI * i / p->facets + 0.3;
    return dvec_of(radius * cos(a), y, -radius * sin(a));
}

/* Adds sides and a lid. */
static void put_sides(hard_stage *h, const pillar *p)
{
    const double top = p->kind == CONE ? 0.0 : p->radius;
    for (int i = 0; i < p->facets; ++i) {
        const dvec a = on_rim(p, i, p->radius, 0), b = on_rim(p, i + 1, p->radius, 0),
                   c = on_rim(p, i + 1, top, p->high), d = on_rim(p, i, top, p->high);
        hard_triangle(h, a, b, c);
        if (top > 0.0) {
            hard_triangle(h, a, c, d);
            hard_triangle(h, d, c, dvec_of(0, p->high, 0));
        }
    }
}

/* Makes the object and a floor of two triangles. Returns the direction of the light. */
static dvec make_pillar(hard_stage *h, const pillar *p)
{
    const double e = p->height_deg * PI / 180, a = p->around_deg * PI / 180;
    const dvec along = dvec_of(-cos(e) * cos(a), -sin(e), -cos(e) * sin(a));
    hard_begin(h, ALBEDO);
    hard_quad(h, dvec_of(0, 0, 0), dvec_of(0, 0, GROUND), dvec_of(GROUND, 0, 0));
    if (p->kind == BALL) {
        hard_ball(h, dvec_of(0, p->radius, 0), p->radius, p->facets);
    } else {
        put_sides(h, p);
    }
    hard_sun(h, along, SUN);
    hard_end(h);
    return along;
}

static double truth_at(const hard_stage *h, dvec at, dvec along)
{
    double sum = 0.0;
    for (uint32_t i = 2; i < h->count; ++i) {
        const dvec *c = h->world[i], n = dvec_unit(dvec_turn(c[0], c[1], c[2]));
        const double cosine = -dvec_dot(n, along);
        if (cosine > 0.0 && dvec_dot(n, dvec_sub(at, c[0])) > 0.0) {
            sum += hard_true_factor(at, dvec_of(0, 1, 0), c, 3) * cosine;
        }
    }
    return sum * SUN * ALBEDO;
}

/* Relative to the mean truth; worst: of a pixel, relative to the truth plus a twentieth of the mean. */
typedef struct off_truth {
    double trim, rmse, worst;
} off_truth;

static int rising(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Computes both figures from the pixels' squared errors. */
static void sum_up(off_truth *out, double *square, int count)
{
    const int kept = count - count / 100;
    double sum = 0.0, all = 0.0;
    qsort(square, (size_t)count, sizeof *square, rising);
    for (int i = 0; i < count; ++i) {
        sum += i < kept ? square[i] : 0.0;
        all += square[i];
    }
    out->trim = sqrt(sum / kept);
    out->rmse = sqrt(all / count);
}

/* Compares the floor as seen from above, in front of and behind the object. */
static void measure(off_truth *out, hard_stage *h, const pillar *p)
{
    static double want[SIDE * SIDE], got[SIDE * SIDE], square[SIDE * SIDE];
    const dvec along = make_pillar(h, p);
    double mean = 0.0;
    int count = 0;
    hard_look(h, dvec_of(-0.5 * along.x, 4.5, -0.5 * along.z), dvec_of(0, 0, 0), 50, SIDE);
    h->tree_size = TREE;
    const lmb_status status = hard_frame(h, LMB_SHOW_INDIRECT, MAP, 0.02f);
    h->tree_size = 0;
    for (int i = 0; i < SIDE * SIDE; ++i) {
        const uint32_t id = h->id[hard_at(h, i % SIDE, i / SIDE)];
        if (id == 1 || id == 2) {
            dvec normal;
            const dvec at = hard_surface(&normal, h, i % SIDE, i / SIDE, id);
            if (dvec_length(at) <= NEAR) {
                want[count] = truth_at(h, at, along);
                got[count] = (double)h->out[3 * i + 1] * PI / ALBEDO;
                mean += want[count++];
            }
        }
    }
    mean /= count;
    out->worst = status == LMB_OK ? 0.0 : HUGE_VAL;
    for (int i = 0; i < count; ++i) {
        const double off = (got[i] - want[i]) / mean;
        square[i] = off * off;
        out->worst = fmax(out->worst, got[i] / (want[i] + 0.05 * mean));
    }
    sum_up(out, square, count);
}

enum { FACETS = 3, SUNS = 3, MOST = 64 /* slices of a ball */ };

typedef struct pillar_set {
    int facets[FACETS];
    double suns[SUNS], around[SUNS], radius, high;
} pillar_set;

/* The means of trim and rmse, and the worst pixel. */
static void measure_set(off_truth *out, hard_stage *h, int kind, const pillar_set *set)
{
    memset(out, 0, sizeof *out);
    for (int i = 0; i < FACETS * SUNS; ++i) {
        const int facets = set->facets[i / SUNS];
        const pillar p = {kind, kind == BALL && facets > MOST ? MOST : facets, set->radius, set->high,
                          set->suns[i % SUNS], set->around[(i + i / SUNS) % SUNS]};
        off_truth one;
        measure(&one, h, &p);
        out->trim += one.trim / (FACETS * SUNS);
        out->rmse += one.rmse / (FACETS * SUNS);
        out->worst = fmax(out->worst, one.worst);
    }
}

typedef struct pillar_row {
    int kind, set;
    const char *name[3];
    double bound[3];
} pillar_row;

void hard_pillar(hard_list *list)
{
    /* The first set chose constants of src/tree/facets.c; the second one chose nothing. */
    static const pillar_set set[2] = {{{8, 28, 256}, {3, 15, 45}, {0, 33, 71}, 0.3, 1.8},
                                      {{11, 40, 150}, {6, 22, 60}, {12, 50, 200}, 0.22, 1.3}};
    static const pillar_row rows[2 * THINGS] = {
        {CYLINDER, 0, {"floor by pillars: trim", "rmse", "brightest pixel"}, {0.072, 0.19, 4.2}},
        {CONE, 0, {"floor by cones: trim", "rmse", "brightest pixel"}, {0.075, 0.205, 2.3}},
        {BALL, 0, {"floor by balls: trim", "rmse", "brightest pixel"}, {0.091, 0.15, 2}},
        {CYLINDER, 1, {"held out pillars: trim", "rmse", "brightest pixel"}, {0.111, 0.36, 1.5}},
        {CONE, 1, {"held out cones: trim", "rmse", "brightest pixel"}, {0.115, 0.6, 1.8}},
        {BALL, 1, {"held out balls: trim", "rmse", "brightest pixel"}, {0.119, 0.215, 1.5}},
    };
    for (int i = 0; i < 2 * THINGS; ++i) {
        const pillar_row *r = &rows[i];
        off_truth off;
        measure_set(&off, list->stage, r->kind, &set[r->set]);
        hard_put(list, HARD_MEASURED, r->name[0], off.trim, r->bound[0], "");
        hard_put(list, HARD_MEASURED, r->name[1], off.rmse, r->bound[1], "");
        hard_put(list, HARD_MEASURED, r->name[2], off.worst, r->bound[2], "times");
    }
}
