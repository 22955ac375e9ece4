/* plan_fit.c: fits the model's numbers: non-negative least squares over units of work. */
#include <math.h>
#include <string.h>

#include "plan_rows.h"

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

/* Counts a run's operations, with measured numbers where the run has them. */
static void ops_of(double op[LMB_OPS], const plan_scene *s, const plan_run *r)
{
    ladder_choice c;
    memset(&c, 0, sizeof c);
    c.settings = r->s;
    ladder_cost_of(&c, &s->facts, r->pairs, r->segments, 0);
    memcpy(op, c.op, sizeof c.op);
}

/* Fits each stage's time by its own operations; the weights make all frames count equally. */
static void add_run(normal *n, const plan_scene *s, const plan_run *r)
{
    double op[LMB_OPS], part[LMB_OPS];
    const double texels = s->facts.faces * (double)r->s.shadow_map * (double)r->s.shadow_map;
    const double weight = 1.0 / plan_seconds(r);
    ops_of(op, s, r);
    memset(part, 0, sizeof part);
    part[LMB_OP_TRIANGLES] = s->facts.faces * s->facts.triangles;
    part[LMB_OP_TEXELS] = texels;
    add_row(n, part, r->seconds[LMB_STAGE_SHADOW_MAP], weight);
    memset(part, 0, sizeof part);
    part[LMB_OP_BVH] = op[LMB_OP_BVH];
    add_row(n, part, r->seconds[LMB_STAGE_BVH], weight);
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

/* Coordinate descent. Lights do not occur in irradiance, and elements and lobes in no scene; those keep their share. */
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

static void fit_units(float units[LMB_OPS], const plan_scene *s, int count)
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
            units[i] = (float)(x[i] / unit);
        }
    }
}

void plan_fit(const plan_scene *s, int count, FILE *out)
{
    float units[LMB_OPS];
    if (count == 0) {
        return;
    }
    for (int i = 0; i < LMB_OPS; ++i) {
        units[i] = (float)lmb_plan_units(i);
    }
    fit_units(units, s, count);
    fputs("/* plan_model.inc: what operations cost, in pairs gathered. Made by `make plan-model`. */\n"
          "{\n    {", out);
    for (int i = 0; i < LMB_OPS; ++i) {
        fprintf(out, "%s%#.4gf", i > 0 ? ", " : "", (double)units[i] + 1e-3);
    }
    fputs("},\n}\n", out);
}
