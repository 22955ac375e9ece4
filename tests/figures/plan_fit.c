/* plan_fit.c: the model's numbers: units of work by least squares that are nowhere below 0; what errors are multiplied
 * by, by search. */
#include <math.h>
#include <string.h>

#include "plan_rows.h"

/* --- units of work ------------------------------------------------------------------------------------------------ */

/* Normal equations. */
typedef struct normal {
    double a[LMB_OPS][LMB_OPS], b[LMB_OPS];
} normal;

static void add_row(normal *n, const double *op, double seconds, double weight)
{
    for (int i = 0; i < LMB_OPS; ++i) {
        for (int k = 0; k < LMB_OPS; ++k) {
            n->a[i][k] += weight * weight * op[i] * op[k];
        }
        n->b[i] += weight * weight * op[i] * seconds;
    }
}

/* What the model in the repository makes of a run's settings. */
static lmb_choice predicted(const plan_scene *s, const plan_run *r)
{
    lmb_choice c;
    memset(&c, 0, sizeof c);
    c.settings = r->s;
    lmb_model_cost(&c, &lmb_model, &s->facts, 0);
    return c;
}

/* A run's operations, as counted where they are. */
static void ops_of(double op[LMB_OPS], const plan_scene *s, const plan_run *r)
{
    const lmb_choice c = predicted(s, r);
    memcpy(op, c.op, sizeof c.op);
    op[LMB_OP_PAIRS] = r->pairs;
    op[LMB_OP_SEGMENTS] = r->segments;
}

/* Each stage's time by its own operations, weighted so that each frame counts the same. */
static void add_run(normal *n, const plan_scene *s, const plan_run *r)
{
    double op[LMB_OPS], part[LMB_OPS];
    const double texels = s->facts.faces * (double)r->s.light_map * (double)r->s.light_map;
    const double weight = 1.0 / plan_seconds(r);
    ops_of(op, s, r);
    memset(part, 0, sizeof part);
    part[LMB_OP_TRIANGLES] = s->facts.faces * s->facts.triangles;
    part[LMB_OP_TEXELS] = texels;
    add_row(n, part, r->seconds[LMB_STAGE_LIGHT_MAP], weight);
    memset(part, 0, sizeof part);
    part[LMB_OP_BLOCKERS] = op[LMB_OP_BLOCKERS];
    add_row(n, part, r->seconds[LMB_STAGE_BLOCKERS], weight);
    memset(part, 0, sizeof part);
    part[LMB_OP_RESOLVED] = texels;
    part[LMB_OP_SUMMED] = op[LMB_OP_SUMMED];
    add_row(n, part, r->seconds[LMB_STAGE_POINTS], weight);
    memset(part, 0, sizeof part);
    part[LMB_OP_TRIANGLES] = s->facts.triangles;
    part[LMB_OP_TEXELS] = s->facts.tiles * LMB_TILE_PIXELS;
    add_row(n, part, r->seconds[LMB_STAGE_VIEW], weight);
    memset(part, 0, sizeof part);
    part[LMB_OP_RESOLVED] = op[LMB_OP_RESOLVED] - texels;
    part[LMB_OP_CUTS] = op[LMB_OP_CUTS];
    part[LMB_OP_PAIRS] = op[LMB_OP_PAIRS];
    part[LMB_OP_SEGMENTS] = op[LMB_OP_SEGMENTS];
    part[LMB_OP_STORED] = op[LMB_OP_STORED];
    add_row(n, part, r->seconds[LMB_STAGE_BANDS], weight);
}

/* Coordinate descent. Lights are not in irradiance, elements and lobes in no scene: those keep their share. */
static void solve(double x[LMB_OPS], const normal *n)
{
    memset(x, 0, LMB_OPS * sizeof *x);
    for (int turn = 0; turn < 20000; ++turn) {
        for (int i = 0; i < LMB_OPS; ++i) {
            double rest = n->b[i];
            for (int k = 0; k < LMB_OPS; ++k) {
                rest -= k != i ? n->a[i][k] * x[k] : 0.0;
            }
            x[i] = n->a[i][i] > 0.0 && rest > 0.0 ? rest / n->a[i][i] : 0.0;
        }
    }
}

static void fit_units(plan_model *m, const plan_scene *s, int count)
{
    static normal n;
    double x[LMB_OPS];
    memset(&n, 0, sizeof n);
    for (int i = 0; i < count; ++i) {
        for (int k = 0; k < s[i].runs && s[i].fits; ++k) {
            add_run(&n, &s[i], &s[i].run[k]);
        }
    }
    solve(x, &n);
    const double unit = x[LMB_OP_PAIRS] > 0.0 ? x[LMB_OP_PAIRS] : 1e-9;
    for (int i = 0; i < LMB_OPS; ++i) {
        if (n.a[i][i] > 0.0) {
            m->units[i] = (float)(x[i] / unit);
        }
    }
}

/* --- errors ------------------------------------------------------------------------------------------------------- */

/* Mean square of the logarithm of predicted over measured. */
static double miss(const plan_model *m, const plan_scene *s, int count)
{
    double sum = 0.0, n = 0.0;
    for (int i = 0; i < count; ++i) {
        for (int k = 0; k < s[i].runs && s[i].fits; ++k) {
            const plan_run *r = &s[i].run[k];
            double pairs, segments;
            lmb_model_light(&pairs, &segments, m, &s[i].facts, &r->s, s[i].facts.tiles * LMB_TILE_PIXELS);
            const double e = log((double)lmb_model_error(m, &s[i].facts, &r->s) / r->error), p = log(pairs / r->pairs);
            sum += e * e + p * p;
            n += 1.0;
        }
    }
    return sum / n;
}

static void fit_errors(plan_model *m, const plan_scene *s, int count)
{
    float *const free_numbers[] = {&m->finer, &m->cut, &m->map, &m->step, &m->least_fall, &m->most_fall};
    for (double reach = 1.5; reach > 1.01; reach = sqrt(reach)) {
        for (int turn = 0; turn < 20; ++turn) {
            for (int i = 0; i < 6; ++i) {
                const float was = *free_numbers[i];
                double best = miss(m, s, count);
                float taken = was;
                for (int up = 0; up < 2; ++up) {
                    *free_numbers[i] = (float)((double)was * (up ? reach : 1.0 / reach));
                    const double now = miss(m, s, count);
                    if (now < best && (i < 4 || *free_numbers[i] >= 1.05f)) {
                        best = now;
                        taken = *free_numbers[i];
                    }
                }
                *free_numbers[i] = taken;
            }
        }
    }
}

void plan_fit(const plan_scene *s, int count, FILE *out)
{
    plan_model m = lmb_model;
    if (count == 0) {
        return;
    }
    fit_units(&m, s, count);
    fit_errors(&m, s, count);
    fputs("/* plan_model.inc: what operations cost, in pairs gathered, and how errors add. Made by `make plan-model`. */\n"
          "{\n    {", out);
    for (int i = 0; i < LMB_OPS; ++i) {
        fprintf(out, "%s%#.4gf", i > 0 ? ", " : "", (double)m.units[i] + 1e-3);
    }
    fprintf(out, "},\n    %#.4gf,\n    %#.4gf, %#.4gf, %#.4gf,\n    %#.4gf, %#.4gf,\n}\n", (double)m.finer,
            (double)m.cut, (double)m.map, (double)m.step, (double)m.least_fall, (double)m.most_fall);
}

/* --- report ------------------------------------------------------------------------------------------------------- */

typedef struct spread {
    double inside, count, log_sum, worst;
} spread;

static void count_in(spread *s, double ratio, double bar)
{
    const double off = ratio > 1.0 ? ratio : 1.0 / ratio;
    s->inside += off <= bar ? 1.0 : 0.0;
    s->count += 1.0;
    s->log_sum += log(ratio);
    s->worst = off > s->worst ? off : s->worst;
}

static void print_spread(const char *what, const spread *s, double bar)
{
    printf("  %-9s mean %.3f, worst %.2f, within %.2f: %3.0f %%", what, exp(s->log_sum / s->count), s->worst, bar,
           s->inside / s->count * 100.0);
}

/* How many of the other scenes miss a bar. */
int plan_report(const plan_scene *s, int count)
{
    int missed = 0;
    printf("predicted over measured\n");
    for (int i = 0; i < count; ++i) {
        spread pairs = {0, 0, 0, 0}, segments = pairs, error = pairs, time = pairs, beyond = pairs;
        double unit = 0.0;
        for (int k = 0; k < s[i].runs; ++k) {
            unit += predicted(&s[i], &s[i].run[k]).work / plan_seconds(&s[i].run[k]);
        }
        unit /= (double)s[i].runs;
        for (int k = 0; k < s[i].runs; ++k) {
            const plan_run *r = &s[i].run[k];
            const lmb_choice c = predicted(&s[i], r);
            if (r->s.tree > s[i].facts.tree) { /* nobody looked at such a tree: none is chosen */
                count_in(&beyond, c.op[LMB_OP_PAIRS] / r->pairs, 1.1);
                continue;
            }
            count_in(&pairs, c.op[LMB_OP_PAIRS] / r->pairs, 1.1);
            if (r->segments > 0.0 && c.op[LMB_OP_SEGMENTS] > 0.0) {
                count_in(&segments, c.op[LMB_OP_SEGMENTS] / r->segments, 1.1);
            }
            count_in(&error, (double)c.error / r->error, 1.5);
            count_in(&time, c.work / unit / plan_seconds(r), 1.3);
        }
        printf("%-15s%s", s[i].name, s[i].fits ? "*" : " ");
        print_spread("pairs", &pairs, 1.1);
        if (segments.count > 0.0) {
            print_spread("segments", &segments, 1.1);
        }
        printf("\n                ");
        print_spread("error", &error, 1.5);
        print_spread("time", &time, 1.3);
        printf("  %.3g units/s\n                  trees beyond the look's: pairs worst %.2f\n", unit, beyond.worst);
        missed += !s[i].fits && (pairs.inside < pairs.count || error.inside < error.count);
    }
    printf("* the model is fitted to these\n");
    return missed;
}
