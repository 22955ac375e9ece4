/* bake_rows.c: light that arrives from each element at some points: form factor times visible share. */
#include "bake.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/pool.h"
#include "../common/fvec.h"
#include "../common/progress.h"
#include "bake_triangle.h"

#define PI 3.14159274f
#define DISC2 100.0f /* squared distance from which a part is a disc, over squared reach: 0.5 % error at most */
enum { CHUNK = 64, CUTS = 4, FEW = 4 };

/* Splits from which on quarters that are all visible or all hidden are not split further: most nearby elements are.
 * Without this rule, 256 parts of each of the nearest elements took two thirds of all tests. */
enum { ALIKE = 3 };

/* An element nearer than this (squared distance over squared reach) is split in four, and so on. Nearby geometry
 * hides part of an element, and the nearest light counts most. */
static const float cut2[CUTS] = {36.0f, 9.0f, 2.5f, 0.7f};
#define APART2 6.25f /* likewise: nearer than this, each triangle of an element counts separately */

/* Scratch of one thread. */
typedef struct rows_sight {
    lmb_traversal traversal;
    uint32_t own[CHUNK]; /* by point: the triangle that blocked it last */
    uint64_t tests;      /* of former jobs */
} rows_sight;

typedef struct rows {
    const bake *b;
    const lmb_tile *tile;
    const lmb_vec3 *at, *normal;
    float *const *row;
    float *times;
    int count, axes, own, parts; /* elements of part `own` of `parts` */
    rows_sight *sight; /* one per thread */
} rows;

/* An element or part, seen from all points. */
typedef struct part {
    lmb_vec3 corner[3];
    lmb_vec3 middle;
    float area, reach2;
} part;

/* --- form factors ------------------------------------------------------------------------------------------------- */

/* Form factor of a distant part wholly in front of the point; *to: the direction to it. */
static float disc_factor(lmb_vec3 *to, const bake_element *e, const part *p, lmb_vec3 d, float d2)
{
    const float cosine = -dot3(d, e->normal) * e->facing, per = 1.0f / sqrtf(d2);
    *to = mul3(d, per);
    return cosine > 0.0f ? cosine * per * p->area / (PI * d2 + p->area) : 0.0f;
}

static float factor_along(const bake_element *e, const part *p, lmb_vec3 at, lmb_vec3 face, lmb_vec3 along)
{
    return lmb_polygon_factor(at, face, along, p->corner, 3, e->normal);
}

/* Writes out[0 .. axes - 1]; returns 0 if no light arrives. */
static int factors(float out[3], const bake_element *e, const part *p, lmb_vec3 at, lmb_vec3 n, int axes)
{
    const lmb_vec3 d = sub3(p->middle, at);
    const float d2 = dot3(d, d);
    if (d2 > DISC2 * p->reach2 || !e->is_one) {
        lmb_vec3 to = vec3(0.0f, 0.0f, 0.0f);
        const float f = d2 > 0.0f ? disc_factor(&to, e, p, d, d2) : 0.0f, cosine = f > 0.0f ? dot3(to, n) : 0.0f;
        out[0] = axes == 1 ? f * cosine : f * to.x;
        out[1] = f * to.y;
        out[2] = f * to.z;
        return f > 0.0f && cosine > 0.0f;
    }
    if (axes == 1) {
        out[0] = factor_along(e, p, at, n, n);
        return out[0] > 0.0f;
    }
    const lmb_vec3 all = lmb_triangle_vector(at, n, p->corner, e->normal);
    out[0] = all.x;
    out[1] = all.y;
    out[2] = all.z;
    return out[0] != 0.0f || out[1] != 0.0f || out[2] != 0.0f;
}

/* --- visibility --------------------------------------------------------------------------------------------------- */

/* Number of splits of an element for a point. */
static int cuts_for(const bake_element *e, lmb_vec3 at)
{
    const lmb_vec3 d = sub3(e->middle, at);
    int cuts = 0;
    while (cuts < CUTS && e->is_one && dot3(d, d) < cut2[cuts] * e->reach2) {
        ++cuts;
    }
    return cuts;
}

/* A part as the points see it. */
typedef struct seen {
    float f[CHUNK][3];
    uint64_t lit, hidden; /* points that its light would reach; those of them from which it is hidden */
} seen;

static void see_part(seen *out, const rows *w, const bake_element *e, const part *p, float share, uint64_t points,
                     int worker)
{
    const lmb_vec3 q = e->is_one ? p->middle : e->place;
    out->lit = out->hidden = 0;
    for (uint64_t bits = points; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit(bits);
        out->lit |= (uint64_t)(factors(out->f[k], e, p, w->at[k], w->normal[k], w->axes) != 0) << k;
        for (int a = 0; a < w->axes; ++a) {
            out->f[k][a] *= share;
        }
    }
    if (out->lit != 0) {
        const float noise = lmb_tile_noise(w->tile, out->lit) + lmb_place_noise(q, 0.0f);
        rows_sight *s = &w->sight[worker];
        out->hidden = lmb_occluded_again(w->b->kernels, &s->traversal, s->own, &w->b->bvh, w->tile, out->lit, q, noise);
    }
}

static void add_seen(const rows *w, uint32_t j, const seen *s, uint64_t points)
{
    for (uint64_t bits = points & s->lit & ~s->hidden; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit(bits);
        for (int a = 0; a < w->axes; ++a) {
            w->row[w->axes * k + a][j] += s->f[k][a];
        }
    }
}

static void make_quarters(part out[4], const part *p)
{
    lmb_vec3 mid[3];
    for (int k = 0; k < 3; ++k) {
        mid[k] = mul3(add3(p->corner[k], p->corner[(k + 1) % 3]), 0.5f);
    }
    for (int k = 0; k < 4; ++k) {
        const part quarter = {{k < 3 ? p->corner[k] : mid[0], k < 3 ? mid[k] : mid[1], mid[(k + 2) % 3]},
                              {0.0f, 0.0f, 0.0f}, 0.25f * p->area, 0.25f * p->reach2};
        out[k] = quarter;
        out[k].middle = triangle_middle(out[k].corner);
    }
}

/* Adds a part in quarters, for points that need more than `level` splits; points[l]: those that need l. From ALIKE
 * splits on, quarters that are all visible or all hidden are not split further. */
static void add_quarters(const rows *w, const bake_element *e, uint32_t j, const part *p,
                         const uint64_t points[CUTS + 1], int level, int worker)
{
    const uint64_t here = points[level + 1];
    uint64_t finer[CUTS + 1] = {0, 0, 0, 0, 0}, visible = 0, hidden = 0, deeper = 0;
    part quarter[4];
    seen s[4];
    for (int l = level + 2; l <= CUTS; ++l) {
        deeper |= points[l];
    }
    const uint64_t asked = here | (level + 1 >= ALIKE ? deeper : 0);
    make_quarters(quarter, p);
    for (int k = 0; k < 4 && asked != 0; ++k) {
        see_part(&s[k], w, e, &quarter[k], 1.0f, asked, worker);
        visible |= s[k].lit & ~s[k].hidden;
        hidden |= s[k].hidden;
    }
    const uint64_t done = here | (asked & ~(visible & hidden));
    for (int k = 0; k < 4 && asked != 0; ++k) {
        add_seen(w, j, &s[k], done);
    }
    for (int l = level + 2; l <= CUTS; ++l) {
        finer[l] = points[l] & ~done;
    }
    for (int k = 0; k < 4 && (deeper & ~done) != 0; ++k) {
        add_quarters(w, e, j, &quarter[k], finer, level + 1, worker);
    }
}

/* Adds a triangle for the points of `of` in front of it, each with the splits that it needs. */
static void add_triangle(const rows *w, const bake_element *e, uint32_t j, uint64_t of, int worker)
{
    uint64_t points[CUTS + 1] = {0, 0, 0, 0, 0};
    part whole;
    for (uint64_t bits = of; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit(bits);
        if (!e->is_one || dot3(sub3(e->middle, w->at[k]), e->normal) < 0.0f) {
            points[w->b->by_middles ? 0 : cuts_for(e, w->at[k])] |= (uint64_t)1 << k;
        }
    }
    memcpy(whole.corner, e->corner, sizeof whole.corner);
    whole.middle = e->middle;
    whole.area = e->area;
    whole.reach2 = e->reach2;
    if (points[0] != 0) {
        seen s;
        see_part(&s, w, e, &whole, e->open, points[0], worker);
        add_seen(w, j, &s, points[0]);
    }
    if ((of & ~points[0]) != 0) {
        add_quarters(w, e, j, &whole, points, 0, worker);
    }
}

/* Adds each triangle of an element like a separate element. */
static void add_apart(const rows *w, uint32_t j, uint64_t points, int worker)
{
    const bake_element *of = &w->b->element[j];
    for (uint32_t i = of->first_part; i < of->first_part + of->parts; ++i) {
        const bake_part *p = &w->b->part[i];
        bake_element e;
        if (!(p->open > 0.0f)) {
            continue;
        }
        memset(&e, 0, sizeof e);
        memcpy(e.corner, p->corner, sizeof e.corner);
        e.middle = p->middle;
        e.normal = p->normal;
        e.area = p->area;
        e.open = p->open;
        e.facing = 1.0f;
        e.is_one = 1;
        for (int k = 0; k < 3; ++k) {
            const lmb_vec3 d = sub3(p->corner[k], e.middle);
            e.reach2 = maxf(e.reach2, dot3(d, d));
        }
        add_triangle(w, &e, j, points, worker);
    }
}

/* Returns the points too near to treat an element as a disc. Points behind a single triangle receive nothing. */
static uint64_t near_points(const rows *w, const bake_element *e)
{
    const float reach2 = (e->is_one ? cut2[0] : APART2) * e->reach2;
    uint64_t near = 0;
    for (int k = 0; k < w->count && !w->b->by_middles; ++k) {
        const lmb_vec3 d = sub3(e->middle, w->at[k]);
        near |= (uint64_t)(dot3(d, d) < reach2 && (!e->is_one || dot3(d, e->normal) < 0.0f)) << k;
    }
    return near;
}

static void element_job(void *user, int index, int worker)
{
    const rows *w = user;
    const uint32_t per = w->b->set.elements / CHUNK, first = (uint32_t)(w->own + index * w->parts) * per;
    const uint64_t all = ~(uint64_t)0 >> (CHUNK - w->count);
    if (worker == 0) {
        progress_again();
    }
    bake_bound(&w->sight[worker].traversal);
    memset(w->sight[worker].own, 0, sizeof w->sight[worker].own); /* the number of tests must not depend on threads */
    for (uint32_t j = first; j < first + per; ++j) {
        const bake_element *e = &w->b->element[j];
        for (int k = 0; k < w->axes * w->count; ++k) {
            w->row[k][j] = 0.0f;
        }
        if (w->times != NULL) {
            w->times[j] = 1.0f;
        }
        if (!(e->area > 0.0f) || e->is_dark) {
            continue;
        }
        const uint64_t near = near_points(w, e);
        if (w->times != NULL && near == 0) {
            w->times[j] = j % FEW == j / FEW % FEW ? (float)FEW : 0.0f;
            if (w->times[j] == 0.0f) {
                continue;
            }
        }
        if (!e->is_one && near != 0) {
            add_apart(w, j, near, worker);
        }
        add_triangle(w, e, j, e->is_one ? all : all & ~near, worker);
    }
    w->sight[worker].tests += w->sight[worker].traversal.spent;
}

static void set_tile(lmb_tile *tile, const lmb_vec3 *at, const lmb_vec3 *normal, int count)
{
    memset(tile, 0, sizeof *tile);
    tile->hits = count;
    for (int k = 0; k < count; ++k) {
        const float p[3] = {at[k].x, at[k].y, at[k].z}, n[3] = {normal[k].x, normal[k].y, normal[k].z};
        for (int c = 0; c < 3; ++c) {
            tile->position[c][k] = p[c];
            tile->normal[c][k] = tile->face[c][k] = n[c];
        }
        tile->depth[k] = 1.0f;
        tile->id[k] = 1;
    }
}

int bake_rows_part(const bake *b, const lmb_vec3 *at, const lmb_vec3 *normal, int count, int axes, float *const *row,
                   float *times, int own, int parts, report *r)
{
    lmb_tile *tile = malloc(sizeof *tile);
    rows_sight *sight = calloc((size_t)b->set.threads, sizeof *sight);
    const int ok = tile != NULL && sight != NULL;
    uint64_t unheard = 0;
    if (ok) {
        rows w = {b, tile, at, normal, row, times, count, axes, own, parts, sight};
        set_tile(tile, at, normal, count);
        pool_run(b->set.threads, (CHUNK - own + parts - 1) / parts, element_job, &w);
        for (int k = 0; k < b->set.threads; ++k) {
            bake_count_coarse(b, sight[k].traversal.coarse);
            *(b->tests != NULL ? b->tests : &unheard) += sight[k].tests;
        }
    }
    free(tile);
    free(sight);
    return ok || report_fail(r, "not enough memory for %d points", count);
}

int bake_rows(const bake *b, const lmb_vec3 *at, const lmb_vec3 *normal, int count, int axes, float *const *row,
              float *times, report *r)
{
    return bake_rows_part(b, at, normal, count, axes, row, times, 0, 1, r);
}

int bake_rows_has(const bake *b, uint32_t element, int own, int parts)
{
    return (int)(element / (b->set.elements / CHUNK)) % parts == own;
}
