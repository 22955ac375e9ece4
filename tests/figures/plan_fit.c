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

double plan_work(const plan_scene *s, const plan_run *r)
{
    double op[LMB_OPS], sum = 0.0;
    ops_of(op, s, r);
    for (int i = 0; i < LMB_OPS; ++i) {
        sum += op[i] * (double)lmb_model.units[i];
    }
    return sum;
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

/* Mean logarithm of how far predicted errors are from measured ones. Not its square: without the worst 1 % of pixels an
 * error jumps where that share is all that is wrong, and a few settings there would pull all the rest. */
static double miss(const plan_model *m, const plan_scene *s, int count)
{
    double sum = 0.0, n = 0.0;
    for (int i = 0; i < count; ++i) {
        for (int k = 0; k < s[i].runs && s[i].fits; ++k) {
            const plan_run *r = &s[i].run[k];
            if (r->s.tree <= s[i].facts.tree) {
                sum += fabs(log((double)lmb_model_error(m, &s[i].facts, &r->s) / r->error));
                n += 1.0;
            }
        }
    }
    return sum / n;
}

static void fit_errors(plan_model *m, const plan_scene *s, int count)
{
    float *const free_numbers[] = {&m->cut, &m->map, &m->step};
    for (double reach = 1.5; reach > 1.01; reach = sqrt(reach)) {
        for (int turn = 0; turn < 20; ++turn) {
            for (int i = 0; i < 3; ++i) {
                const float was = *free_numbers[i];
                double best = miss(m, s, count);
                float taken = was;
                for (int up = 0; up < 2; ++up) {
                    *free_numbers[i] = (float)((double)was * (up ? reach : 1.0 / reach));
                    const double now = miss(m, s, count);
                    if (now < best) {
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
    fputs("/* plan_model.inc: what operations cost, in pairs gathered, and how errors add. Made by `make plan-model`. "
          "*/\n"
          "{\n    {", out);
    for (int i = 0; i < LMB_OPS; ++i) {
        fprintf(out, "%s%#.4gf", i > 0 ? ", " : "", (double)m.units[i] + 1e-3);
    }
    fprintf(out, "},\n    %#.4gf, %#.4gf, %#.4gf,\n}\n", (double)m.cut, (double)m.map, (double)m.step);
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

static void print_spreads(const spread *pairs, const spread *segments, const spread *error, const spread *time)
{
    print_spread("pairs", pairs, 1.1);
    if (segments->count > 0.0) {
        print_spread("segments", segments, 1.1);
    }
    printf("\n                ");
    print_spread("error", error, 1.5);
    if (time->count > 0.0) {
        print_spread("time", time, 1.3);
    }
    printf("\n");
}

static void add_to(spread *all, const spread *s)
{
    all->inside += s->inside;
    all->count += s->count;
    all->log_sum += s->log_sum;
    all->worst = s->worst > all->worst ? s->worst : all->worst;
}

/* Of pairs of settings, those that work puts in the order in which time has them. */
static double ranked(const plan_scene *s)
{
    double right = 0.0, all = 0.0;
    for (int i = 0; i < s->runs; ++i) {
        for (int k = 0; k < i; ++k) {
            const double work = plan_work(s, &s->run[i]) - plan_work(s, &s->run[k]);
            const double time = plan_seconds(&s->run[i]) - plan_seconds(&s->run[k]);
            right += work * time > 0.0 ? 1.0 : 0.0;
            all += 1.0;
        }
    }
    return all > 0.0 ? right / all : 0.0;
}

enum { PAIRS, SEGMENTS, ERRORS, TIME, SPREADS };

static void report_scene(spread out[SPREADS], const plan_scene *s)
{
    double unit = 0.0;
    for (int k = 0; k < s->runs; ++k) {
        unit += predicted(s, &s->run[k]).work / plan_seconds(&s->run[k]) / (double)s->runs;
    }
    for (int k = 0; k < s->runs; ++k) {
        const plan_run *r = &s->run[k];
        const lmb_choice c = predicted(s, r);
        if (r->s.tree > s->facts.tree) { /* nobody looked at such a tree: none is chosen */
            continue;
        }
        count_in(&out[PAIRS], c.op[LMB_OP_PAIRS] / r->pairs, 1.1);
        if (r->segments > 0.0 && c.op[LMB_OP_SEGMENTS] > 0.0) {
            count_in(&out[SEGMENTS], c.op[LMB_OP_SEGMENTS] / r->segments, 1.1);
        }
        count_in(&out[ERRORS], (double)c.error / r->error, 1.5);
        count_in(&out[TIME], c.work / unit / plan_seconds(r), 1.3);
    }
    printf("%-15s%s", s->name, s->fits ? "*" : " ");
    print_spreads(&out[PAIRS], &out[SEGMENTS], &out[ERRORS], &out[TIME]);
    printf("                  work and time in one order: %.0f %% of pairs of settings\n", 100.0 * ranked(s));
}

/* How many of the other scenes miss a bar. */
int plan_report(const plan_scene *s, int count)
{
    spread all[SPREADS];
    int missed = 0;
    memset(all, 0, sizeof all);
    printf("predicted over measured\n");
    for (int i = 0; i < count; ++i) {
        spread own[SPREADS];
        memset(own, 0, sizeof own);
        report_scene(own, &s[i]);
        for (int k = 0; k < TIME && !s[i].fits; ++k) {
            add_to(&all[k], &own[k]);
        }
        missed += !s[i].fits && (own[PAIRS].inside < own[PAIRS].count || own[SEGMENTS].inside < own[SEGMENTS].count ||
                                 own[ERRORS].inside < own[ERRORS].count);
    }
    printf("* the model is fitted to these\n");
    if (all[PAIRS].count > 0.0) {
        printf("the others       ");
        print_spreads(&all[PAIRS], &all[SEGMENTS], &all[ERRORS], &all[TIME]);
    }
    return missed;
}
