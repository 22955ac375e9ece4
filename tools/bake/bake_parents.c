/* bake_parents.c: which clusters predict others: first a few that are far apart, then more and more between them. */
#include "bake.h"

#include <stdlib.h>

#include "../common/fvec.h"

enum { FIRST = 32, GROUPS = 256, AXES = 3, ROUNDS = 24 };
#define TURN 64.0f /* normals at a right angle count as this squared distance in cells */

/* Squared distance, in cells. */
static float apart(const bake_cluster *x, const bake_cluster *y, float cell)
{
    const lmb_vec3 d = sub3(x->at, y->at);
    return dot3(d, d) / (cell * cell) + TURN * (1.0f - dot3(x->target.normal, y->target.normal));
}

void bake_generations(bake_cluster *c, uint32_t count, float cell)
{
    uint32_t generation = 0;
    for (uint32_t i = 0; i < count; ++i) {
        c[i].generation = UINT32_MAX;
    }
    for (float reach = (float)FIRST; reach > 1.0f; reach *= 0.5f, ++generation) {
        for (uint32_t i = 0; i < count; ++i) {
            int is_near = c[i].generation != UINT32_MAX;
            for (uint32_t k = 0; k < count && !is_near; ++k) {
                is_near = c[k].generation <= generation && apart(&c[i], &c[k], cell) < reach * reach;
            }
            c[i].generation = is_near ? c[i].generation : generation;
        }
    }
    for (uint32_t i = 0; i < count; ++i) {
        c[i].generation = c[i].generation < generation ? c[i].generation : generation;
    }
}

/* --- shares: a row as a sum of the parents' rows, by least squares over few sums ---------------------------------- */

typedef struct fit {
    const float *row[BAKE_PARENTS + 1]; /* of the parents, then the child: AXES x GROUPS sums */
    float product[BAKE_PARENTS][BAKE_PARENTS + 1];
} fit;

static void set_row(float *out, const uint16_t *row, uint32_t elements)
{
    const uint32_t each = elements / GROUPS > 0 ? elements / GROUPS : 1;
    memset(out, 0, AXES * GROUPS * sizeof *out);
    for (uint32_t a = 0; a < AXES; ++a) {
        for (uint32_t i = 0; i < elements; ++i) {
            out[a * GROUPS + i / each] += bake_long(row[a * (size_t)elements + i]);
        }
    }
}

/* Optimizes one share after the other, with all others fixed: none below 0, each at most 1. */
static void solve(fit *f, float share[BAKE_PARENTS], int parents)
{
    for (int i = 0; i < parents; ++i) {
        for (int k = 0; k <= parents; ++k) {
            const float *y = f->row[k < parents ? k : BAKE_PARENTS];
            float sum = 0.0f;
            for (int g = 0; g < AXES * GROUPS; ++g) {
                sum += f->row[i][g] * y[g];
            }
            f->product[i][k < parents ? k : BAKE_PARENTS] = sum;
        }
    }
    for (int round = 0; round < ROUNDS; ++round) {
        for (int i = 0; i < parents; ++i) {
            float rest = f->product[i][BAKE_PARENTS], others = 0.0f;
            for (int k = 0; k < parents; ++k) {
                rest -= k != i ? share[k] * f->product[i][k] : 0.0f;
                others += k != i ? share[k] : 0.0f;
            }
            share[i] = f->product[i][i] > 0.0f ? clampf(rest / f->product[i][i], 0.0f, 1.0f - others) : 0.0f;
        }
    }
}

/* Finds the nearest clusters of former generations, which are the first `count`. Returns how many. */
static int nearest(uint32_t best[BAKE_PARENTS], const bake_cluster *c, uint32_t count, const bake_cluster *of,
                   float cell)
{
    float far[BAKE_PARENTS];
    int found = 0;
    for (uint32_t i = 0; i < count && c[i].generation < of->generation; ++i) {
        const float d = apart(&c[i], of, cell);
        if (c[i].target.zone != of->target.zone) {
            continue;
        }
        if (found == BAKE_PARENTS && d >= far[BAKE_PARENTS - 1]) {
            continue;
        }
        found += found < BAKE_PARENTS;
        int at = found - 1;
        for (; at > 0 && far[at - 1] > d; --at) {
            far[at] = far[at - 1];
            best[at] = best[at - 1];
        }
        far[at] = d;
        best[at] = i;
    }
    return found;
}

int bake_parents(bake *b, report *r)
{
    enum { SUMS = AXES * GROUPS };
    fit f;
    float *sums = malloc(((size_t)b->cluster_count + 1) * SUMS * sizeof *sums); /* a cluster has many children */
    if (sums == NULL) {
        return report_fail(r, "not enough memory for clusters");
    }
    for (uint32_t i = 0; i < b->cluster_count; ++i) {
        bake_target *t = &b->cluster[i].target;
        t->zone = bake_zone_of(b, t->row, AXES);
        const int parents = nearest(t->parent, b->cluster, i, &b->cluster[i], b->set.cluster_m);
        memset(t->share, 0, sizeof t->share);
        set_row(sums + SUMS * (size_t)i, t->row, b->set.elements);
        f.row[BAKE_PARENTS] = sums + SUMS * (size_t)i;
        for (int k = 0; k < parents; ++k) {
            f.row[k] = sums + SUMS * (size_t)t->parent[k];
        }
        solve(&f, t->share, parents);
        for (int k = 0; k < BAKE_PARENTS; ++k) { /* as the file stores them */
            t->share[k] = (float)(uint32_t)(t->share[k] * 255.0f) * (1.0f / 255.0f);
            t->parent[k] = t->share[k] > 0.0f ? t->parent[k] : 0;
        }
    }
    free(sums);
    return 1;
}
