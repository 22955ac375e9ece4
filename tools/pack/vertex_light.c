/* vertex_light.c: vertices and elements, visibility of lamps, links between elements, and the encoded words. */
#include "vertex_light.h"

#include <stdlib.h>
#include <string.h>

#include "../common/progress.h"

enum { SAMPLES = 32, ELEMENT_SAMPLES = 8, MOST_LINKS = 129 /* one more to make it even */ };
#define OVER  0.004 /* m: height above a surface of points that receive light */
#define TRUST 0.5   /* of directions: a point with more back faces around it is inside a solid */

/* A vertex or an element. */
typedef struct receiver {
    dvec at, normal;
    double albedo[3], area;
    dvec sample[SAMPLES], face[SAMPLES];
    double weight[SAMPLES]; /* sum to 1 */
    int samples;
    uint32_t place;
    const lmb_material *material;
} receiver;

typedef struct piece {
    dvec middle;
    double area, albedo[3];
    uint32_t element;
} piece;

typedef struct baking {
    vl_mesh m;
    vl_sight sight;
    vl_lattice lattice;
    receiver *receiver; /* vertices, then elements */
    uint32_t vertices, elements, hidden, hull;
    uint32_t (*corner)[3]; /* of a triangle: vertices */
    piece *piece;          /* of a triangle */
    uint32_t *words, count, cap, link_words;
    int32_t units_log2, origin[3];
} baking;

/* --- vertices ----------------------------------------------------------------------------------------------------- */

static dvec inner(const vl_mesh *m, const vl_triangle *t, double a, double b, double c)
{
    return dvec_add(dvec_add(dvec_mul(m->place[t->p[0]], a), dvec_mul(m->place[t->p[1]], b)),
                    dvec_mul(m->place[t->p[2]], c));
}

static double area_of(const vl_mesh *m, const vl_triangle *t)
{
    return 0.5 * dvec_length(dvec_turn(m->place[t->p[0]], m->place[t->p[1]], m->place[t->p[2]]));
}

enum { INSIDES = 7 };
static const double inside[INSIDES][3] = {{0.34, 0.33, 0.33}, {0.9, 0.05, 0.05}, {0.05, 0.9, 0.05}, {0.05, 0.05, 0.9},
                                          {0.48, 0.48, 0.04}, {0.04, 0.48, 0.48}, {0.48, 0.04, 0.48}};

/* Drops triangles that objects on them hide completely. */
static void drop_buried(baking *b)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < b->m.triangles; ++i) {
        const vl_triangle t = b->m.triangle[i];
        int seen = 0;
        for (int k = 0; k < INSIDES && !seen; ++k) {
            const dvec p = dvec_add(inner(&b->m, &t, inside[k][0], inside[k][1], inside[k][2]), dvec_mul(t.face, OVER));
            seen = vl_buried(&b->sight, p, t.face) < TRUST;
        }
        if (seen) {
            b->m.triangle[kept++] = t;
        }
    }
    b->hidden += b->m.triangles - kept;
    b->m.triangles = kept;
}

static int places_see(baking *b, const vl_triangle *t)
{
    for (int k = 0; k < INSIDES; ++k) {
        const dvec p = dvec_add(inner(&b->m, t, inside[k][0], inside[k][1], inside[k][2]), dvec_mul(t->face, OVER));
        for (uint32_t i = 0; i < b->lattice.all; ++i) {
            const dvec lamp = vl_lattice_place(&b->lattice, i);
            if (b->lattice.valid[i] && dvec_dot(t->face, dvec_sub(lamp, p)) > 0.0 && vl_sees(&b->sight, p, lamp)) {
                return 1;
            }
        }
    }
    return 0;
}

/* Drops a side of a two-sided triangle if no lamp place sees it but some see the other side: outer sides of walls, and
 * faces inside walls made of slabs. These would otherwise take most vertices and elements of a room. Both sides of a
 * triangle are adjacent in the list. */
static void drop_far_sides(baking *b)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < b->m.triangles;) {
        const vl_triangle front = b->m.triangle[i++];
        if (!front.is_two_sided) {
            b->m.triangle[kept++] = front;
            continue;
        }
        const vl_triangle back = b->m.triangle[i++];
        const int sees_front = places_see(b, &front), sees_back = places_see(b, &back);
        if (sees_front || !sees_back) {
            b->m.triangle[kept++] = front;
        }
        if (sees_back) {
            b->m.triangle[kept++] = back;
        }
    }
    b->hidden += b->m.triangles - kept;
    b->m.triangles = kept;
}

#define BEHIND 1e-3 /* m: tolerance for points behind a hull triangle, because places are rounded */

static int is_hull(const baking *b, const vl_triangle *t)
{
    const dvec at = b->m.place[t->p[0]];
    for (uint32_t i = 0; i < b->m.triangles; ++i) {
        for (int k = 0; k < 3; ++k) {
            if (dvec_dot(t->face, dvec_sub(b->m.place[b->m.triangle[i].p[k]], at)) < -BEHIND) {
                return 0;
            }
        }
    }
    return 1;
}

/* Moves triangles with the whole scene in front of them to the start; the order is otherwise kept. */
static int put_hull_first(baking *b, report *r)
{
    vl_triangle *sorted = malloc(b->m.triangles * sizeof *sorted);
    unsigned char *hull = malloc(b->m.triangles);
    const int ok = (sorted != NULL && hull != NULL) || report_fail(r, "not enough memory for triangles");
    uint32_t count = 0;
    for (uint32_t i = 0; ok && i < b->m.triangles; ++i) {
        hull[i] = (unsigned char)is_hull(b, &b->m.triangle[i]);
        b->hull += hull[i];
    }
    for (int which = 1; ok && which >= 0; --which) {
        for (uint32_t i = 0; i < b->m.triangles; ++i) {
            if (hull[i] == which) {
                sorted[count++] = b->m.triangle[i];
            }
        }
    }
    if (ok) {
        memcpy(b->m.triangle, sorted, count * sizeof *sorted);
    }
    free(sorted);
    free(hull);
    return ok;
}

static uint32_t vertex_of(baking *b, const vl_triangle *t, int k)
{
    uint32_t i = 0;
    for (; i < b->vertices; ++i) {
        const receiver *v = &b->receiver[i];
        if (v->place == t->p[k] && v->material == t->material && dvec_dot(v->normal, t->n[k]) > 0.999) {
            return i;
        }
    }
    b->receiver[i].place = t->p[k];
    b->receiver[i].at = b->m.place[t->p[k]];
    b->receiver[i].normal = t->n[k];
    b->receiver[i].material = t->material;
    b->vertices += 1;
    return i;
}

/* Averages the surface's colours around a vertex, with larger weights near it. */
static void add_albedo(receiver *v, const vl_mesh *m, const vl_triangle *t, int k)
{
    enum { STEPS = 12 };
    const double area = area_of(m, t);
    for (int i = 0; i < STEPS; ++i) {
        for (int j = 0; i + j < STEPS; ++j) {
            const double x = (i + 1.0 / 3.0) / STEPS, y = (j + 1.0 / 3.0) / STEPS, own = 1.0 - x - y;
            double weight[3], colour[3];
            weight[k] = own, weight[(k + 1) % 3] = x, weight[(k + 2) % 3] = y;
            vl_albedo(colour, m, t, weight);
            for (int c = 0; c < 3; ++c) {
                v->albedo[c] += area * own * colour[c];
            }
            v->area += area * own;
        }
    }
}

/* Samples of light around a vertex, without those that objects on the surface bury. */
static void add_samples(receiver *v, const baking *b, const vl_triangle *t)
{
    static const double pulls[4] = {0.08, 0.3, 0.55, 0.85};
    const dvec middle = inner(&b->m, t, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0);
    for (int step = 0; step < 4 && v->samples < SAMPLES; ++step) {
        const dvec p = dvec_add(dvec_mix(v->at, middle, pulls[step]), dvec_mul(t->face, OVER));
        if (vl_buried(&b->sight, p, t->face) < TRUST) {
            const double own = 1.0 - pulls[step] * 2.0 / 3.0;
            v->face[v->samples] = t->face;
            v->weight[v->samples] = own * own * (0.1 + pulls[step]) * area_of(&b->m, t);
            v->sample[v->samples++] = p;
        }
    }
}

static void even_weights(receiver *v)
{
    double sum = 0.0;
    for (int k = 0; k < v->samples; ++k) {
        sum += v->weight[k];
    }
    for (int k = 0; k < v->samples; ++k) {
        v->weight[k] /= sum;
    }
}

static int make_vertices(baking *b, report *r)
{
    b->corner = calloc(b->m.triangles, sizeof *b->corner);
    b->receiver = calloc(3 * (size_t)b->m.triangles + LMB_FIXED_MAX_ELEMENTS, sizeof *b->receiver);
    if (b->corner == NULL || b->receiver == NULL) {
        return report_fail(r, "not enough memory for vertices");
    }
    for (uint32_t i = 0; i < b->m.triangles; ++i) {
        const vl_triangle *t = &b->m.triangle[i];
        for (int k = 0; k < 3; ++k) {
            const uint32_t own = vertex_of(b, t, k);
            b->corner[i][k] = own;
            add_albedo(&b->receiver[own], &b->m, t, k);
            add_samples(&b->receiver[own], b, t);
        }
    }
    for (uint32_t i = 0; i < b->vertices; ++i) {
        even_weights(&b->receiver[i]);
        for (int c = 0; c < 3; ++c) {
            b->receiver[i].albedo[c] /= b->receiver[i].area;
        }
    }
    return 1;
}

/* --- elements ----------------------------------------------------------------------------------------------------- */

#define NORMAL_M 0.8 /* m per unit change of a normal */

static void features(double out[6], const baking *b, uint32_t triangle)
{
    const dvec p = b->piece[triangle].middle, n = b->m.triangle[triangle].face;
    out[0] = p.x, out[1] = p.y, out[2] = p.z;
    out[3] = NORMAL_M * n.x, out[4] = NORMAL_M * n.y, out[5] = NORMAL_M * n.z;
}

/* Area times squared spread of an element's triangles, and the axis of largest spread. */
static double spread_of(int *axis, double *middle, const baking *b, uint32_t element)
{
    double area = 0.0, sum[6] = {0}, square[6] = {0}, f[6];
    for (uint32_t i = 0; i < b->m.triangles; ++i) {
        if (b->piece[i].element == element) {
            features(f, b, i);
            area += b->piece[i].area;
            for (int k = 0; k < 6; ++k) {
                sum[k] += b->piece[i].area * f[k];
                square[k] += b->piece[i].area * f[k] * f[k];
            }
        }
    }
    double best = -1.0;
    for (int k = 0; k < 6; ++k) {
        const double own = square[k] - sum[k] * sum[k] / area;
        if (own > best) {
            best = own;
            *axis = k;
            *middle = sum[k] / area;
        }
    }
    return best;
}

static int split_worst(baking *b)
{
    int worst_axis = 0, axis = 0;
    double worst = 1e-9, worst_middle = 0.0, middle = 0.0;
    uint32_t which = LMB_FIXED_MAX_ELEMENTS;
    for (uint32_t e = 0; e < b->elements; ++e) {
        const double own = spread_of(&axis, &middle, b, e);
        if (own > worst) {
            worst = own, worst_axis = axis, worst_middle = middle, which = e;
        }
    }
    if (which == LMB_FIXED_MAX_ELEMENTS) {
        return 0;
    }
    for (uint32_t i = 0; i < b->m.triangles; ++i) {
        double f[6];
        features(f, b, i);
        if (b->piece[i].element == which && f[worst_axis] > worst_middle) {
            b->piece[i].element = b->elements;
        }
    }
    b->elements += 1;
    return 1;
}

static void finish_element(baking *b, uint32_t e)
{
    receiver *out = &b->receiver[b->vertices + e];
    double nearest = 1e30;
    uint32_t first[SAMPLES];
    for (uint32_t i = 0; i < b->m.triangles; ++i) {
        const piece *p = &b->piece[i];
        if (p->element == e) {
            out->area += p->area;
            out->at = dvec_add(out->at, dvec_mul(p->middle, p->area));
            out->normal = dvec_add(out->normal, dvec_mul(b->m.triangle[i].face, p->area));
            for (int c = 0; c < 3; ++c) {
                out->albedo[c] += p->albedo[c] * p->area;
            }
        }
    }
    out->at = dvec_mul(out->at, 1.0 / out->area);
    out->normal = dvec_unit(out->normal);
    for (int c = 0; c < 3; ++c) {
        out->albedo[c] /= out->area;
    }
    /* receive light in the largest triangles */
    for (;;) {
        uint32_t best = b->m.triangles;
        for (uint32_t i = 0; i < b->m.triangles; ++i) {
            int is_new = b->piece[i].element == e && (best == b->m.triangles || b->piece[i].area > b->piece[best].area);
            for (int k = 0; k < out->samples && is_new; ++k) {
                is_new = first[k] != i;
            }
            best = is_new ? i : best;
        }
        if (best == b->m.triangles || out->samples == ELEMENT_SAMPLES) {
            break;
        }
        first[out->samples] = best;
        out->weight[out->samples] = b->piece[best].area;
        out->face[out->samples] = b->m.triangle[best].face;
        out->sample[out->samples++] = dvec_add(b->piece[best].middle, dvec_mul(b->m.triangle[best].face, OVER));
    }
    even_weights(out);
    /* move to the sample nearest to the mean, on the surface */
    const dvec mean = out->at;
    for (int k = 0; k < out->samples; ++k) {
        const dvec off = dvec_sub(b->piece[first[k]].middle, mean);
        if (dvec_dot(off, off) < nearest) {
            nearest = dvec_dot(off, off);
            out->at = b->piece[first[k]].middle;
        }
    }
}

static int make_elements(baking *b, uint32_t wanted, report *r)
{
    b->piece = calloc(b->m.triangles, sizeof *b->piece);
    if (b->piece == NULL) {
        return report_fail(r, "not enough memory for elements");
    }
    for (uint32_t i = 0; i < b->m.triangles; ++i) {
        piece *p = &b->piece[i];
        const vl_triangle *t = &b->m.triangle[i];
        p->middle = inner(&b->m, t, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0);
        p->area = area_of(&b->m, t);
        for (int k = 0; k < 3; ++k) {
            for (int c = 0; c < 3; ++c) {
                p->albedo[c] += b->receiver[b->corner[i][k]].albedo[c] / 3.0;
            }
        }
    }
    b->elements = 1;
    while (b->elements < wanted && split_worst(b)) {
    }
    for (uint32_t e = 0; e < b->elements; ++e) {
        finish_element(b, e);
    }
    return 1;
}

/* --- words -------------------------------------------------------------------------------------------------------- */

static int put(baking *b, uint32_t word, report *r)
{
    if (b->count == b->cap) {
        const uint32_t cap = b->cap > 0 ? 2 * b->cap : 4096;
        uint32_t *more = realloc(b->words, cap * sizeof *more);
        if (more == NULL) {
            return report_fail(r, "not enough memory for %u words", (unsigned)cap);
        }
        b->words = more;
        b->cap = cap;
    }
    b->words[b->count++] = word;
    return 1;
}

static uint32_t byte_of(double v, double low, double high)
{
    const double at = floor(v + 0.5);
    return (uint32_t)(int32_t)(at < low ? low : at > high ? high : at) & 255u;
}

static uint32_t unit_of(const baking *b, double v, int axis)
{
    return (uint32_t)((int32_t)floor(ldexp(v, b->units_log2) + 0.5) - b->origin[axis]);
}

static void set_units(baking *b)
{
    double low[3] = {1e30, 1e30, 1e30}, high[3] = {-1e30, -1e30, -1e30}, reach = 0.0, half = 0.0;
    for (uint32_t i = 0; i < b->m.places; ++i) {
        const double at[3] = {b->m.place[i].x, b->m.place[i].y, b->m.place[i].z};
        for (int k = 0; k < 3; ++k) {
            low[k] = at[k] < low[k] ? at[k] : low[k];
            high[k] = at[k] > high[k] ? at[k] : high[k];
            reach = fabs(at[k]) > reach ? fabs(at[k]) : reach;
        }
    }
    for (int k = 0; k < 3; ++k) {
        half = 0.5 * (high[k] - low[k]) > half ? 0.5 * (high[k] - low[k]) : half;
    }
    for (b->units_log2 = 16; b->units_log2 > 0 && ldexp(half, b->units_log2) > LMB_FIXED_REACH - 2; --b->units_log2) {
    }
    for (int k = 0; k < 3; ++k) {
        b->origin[k] = ldexp(reach, b->units_log2) > LMB_FIXED_REACH - 2
                           ? (int32_t)floor(ldexp(0.5 * (low[k] + high[k]), b->units_log2))
                           : 0;
    }
}

static int put_receiver(baking *b, const receiver *v, report *r)
{
    const uint32_t x = unit_of(b, v->at.x, 0), y = unit_of(b, v->at.y, 1), z = unit_of(b, v->at.z, 2);
    const uint32_t nx = byte_of(127.0 * v->normal.x, -127, 127), ny = byte_of(127.0 * v->normal.y, -127, 127),
                   nz = byte_of(127.0 * v->normal.z, -127, 127);
    uint32_t root[3];
    for (int c = 0; c < 3; ++c) {
        root[c] = byte_of(255.0 * sqrt(v->albedo[c]), 0, 255);
    }
    return put(b, (x & 0xffffu) | y << 16, r) && put(b, (z & 0xffffu) | nx << 16 | ny << 24, r) &&
           put(b, nz | root[0] << 8 | root[1] << 16 | root[2] << 24, r);
}

/* --- links -------------------------------------------------------------------------------------------------------- */

static lmb_vec3 narrowed(dvec v)
{
    lmb_vec3 out = {dvec_narrow(v.x), dvec_narrow(v.y), dvec_narrow(v.z)};
    return out;
}

/* The form factor of each element as seen by a receiver. */
static void factors(double *out, baking *b, const receiver *v)
{
    for (uint32_t e = 0; e < b->elements; ++e) {
        out[e] = 0.0;
    }
    for (int k = 0; k < v->samples; ++k) {
        for (uint32_t i = 0; i < b->m.triangles; ++i) {
            const vl_triangle *t = &b->m.triangle[i];
            lmb_vec3 corner[3];
            for (int c = 0; c < 3; ++c) {
                corner[c] = narrowed(b->m.place[t->p[c]]);
            }
            const double f = (double)lmb_polygon_factor(narrowed(v->sample[k]), narrowed(v->face[k]),
                                                        narrowed(v->normal), corner, 3, narrowed(t->face));
            if (f <= 1e-6) {
                continue;
            }
            int seen = 0;
            for (int c = 0; c < 3; ++c) {
                const dvec to = inner(&b->m, t, c == 0 ? 0.6 : 0.2, c == 1 ? 0.6 : 0.2, c == 2 ? 0.6 : 0.2);
                seen += vl_sees(&b->sight, v->sample[k], dvec_add(to, dvec_mul(t->face, OVER)));
            }
            out[b->piece[i].element] += f * seen / 3.0 * v->weight[k];
        }
    }
}

/* Cost of replacing element `from` by `to`: carried light times squared distance of positions and normals. */
static double cost_of(const baking *b, uint32_t from, uint32_t to, double carried)
{
    const receiver *x = &b->receiver[b->vertices + from], *y = &b->receiver[b->vertices + to];
    const dvec way = dvec_sub(x->at, y->at), turn = dvec_sub(x->normal, y->normal);
    return carried * (dvec_dot(way, way) + NORMAL_M * NORMAL_M * dvec_dot(turn, turn));
}

/* Reduces the number of links: repeatedly the element with the smallest cost gives its light to the nearest one.
 * Dropping the smallest links instead would lose far walls near the lamp: a fifth of the light. */
static void merge_links(double *f, const baking *b, uint32_t most_links)
{
    uint32_t nearest[LMB_FIXED_MAX_ELEMENTS], count = 0;
    double cost[LMB_FIXED_MAX_ELEMENTS];
    for (uint32_t e = 0; e < b->elements; ++e) {
        count += f[e] > 0.0;
        nearest[e] = b->elements;
    }
    for (; count > most_links; --count) {
        uint32_t least_of = b->elements;
        for (uint32_t e = 0; e < b->elements; ++e) {
            if (f[e] <= 0.0) {
                continue;
            }
            if (nearest[e] == b->elements || f[nearest[e]] <= 0.0) {
                nearest[e] = b->elements;
                for (uint32_t k = 0; k < b->elements; ++k) {
                    if (k != e && f[k] > 0.0 &&
                        (nearest[e] == b->elements || cost_of(b, e, k, 1.0) < cost_of(b, e, nearest[e], 1.0))) {
                        nearest[e] = k;
                    }
                }
            }
            cost[e] = cost_of(b, e, nearest[e], f[e]);
            least_of = least_of == b->elements || cost[e] < cost[least_of] ? e : least_of;
        }
        f[nearest[least_of]] += f[least_of];
        f[least_of] = 0.0;
    }
}

/* Makes a receiver's row, and appends the links to `links`. */
static int put_links(baking *b, uint32_t row[2], const receiver *v, uint32_t most_links, baking *links, report *r)
{
    double f[LMB_FIXED_MAX_ELEMENTS], all = 0.0, largest = 0.0;
    uint32_t chosen[MOST_LINKS], count = 0, weight[MOST_LINKS], sum = 0;
    factors(f, b, v);
    for (uint32_t e = 0; e < b->elements; ++e) {
        all += f[e];
    }
    merge_links(f, b, most_links);
    for (uint32_t e = 0; e < b->elements; ++e) {
        largest = f[e] > largest ? f[e] : largest;
    }
    for (uint32_t e = 0; e < b->elements && largest > 0.0; ++e) {
        weight[count] = (uint32_t)floor(255.0 * f[e] / largest + 0.5);
        sum += weight[count];
        chosen[count] = e;
        count += weight[count] > 0;
    }
    if (count % 2 == 1) {
        weight[count] = 0;
        chosen[count++] = 0;
    }
    all = all > 0.999 ? 0.999 : all;
    row[0] = links->count | count << 24;
    row[1] = sum > 0 ? (uint32_t)floor(ldexp(all / sum, LMB_FIXED_SCALE)) : 0;
    for (uint32_t k = 0; k < count; k += 2) {
        if (!put(links, weight[k] << 8 | chosen[k] | (weight[k + 1] << 8 | chosen[k + 1]) << 16, r)) {
            return 0;
        }
    }
    return 1;
}

/* --- lamps -------------------------------------------------------------------------------------------------------- */

/* Writes one bit per lamp place. If the lamp is behind the surface, which it does not light, the bit counts as
 * visible. */
static int put_seen(baking *b, const receiver *v, report *r)
{
    const uint32_t words = (b->lattice.all + 31) / 32;
    for (uint32_t w = 0; w < words; ++w) {
        uint32_t bits = 0;
        for (uint32_t i = 32 * w; i < 32 * w + 32 && i < b->lattice.all; ++i) {
            const dvec lamp = vl_lattice_place(&b->lattice, i);
            double seen = 0.0;
            for (int k = 0; k < v->samples && b->lattice.valid[i]; ++k) {
                const int behind = dvec_dot(v->face[k], dvec_sub(lamp, v->sample[k])) < 0.0;
                seen += behind || vl_sees(&b->sight, v->sample[k], lamp) ? v->weight[k] : 0.0;
            }
            bits |= (uint32_t)(seen > 0.5) << (i & 31u);
        }
        if (!put(b, bits, r)) {
            return 0;
        }
    }
    return 1;
}

static int put_valid(baking *b, report *r)
{
    for (uint32_t w = 0; w < (b->lattice.all + 31) / 32; ++w) {
        uint32_t bits = 0;
        for (uint32_t i = 32 * w; i < 32 * w + 32 && i < b->lattice.all; ++i) {
            bits |= (uint32_t)b->lattice.valid[i] << (i & 31u);
        }
        if (!put(b, bits, r)) {
            return 0;
        }
    }
    return 1;
}

static int put_all(baking *b, const vertex_light_options *o, report *r)
{
    const uint32_t all = b->vertices + b->elements;
    uint32_t header[LMB_FIXED_HEADER_WORDS] = {0x4c4d4600u | LMB_FIXED_VERSION, 0};
    baking links;
    int ok = 1;
    memset(&links, 0, sizeof links);
    header[2] = (uint32_t)b->units_log2;
    header[3] = b->vertices, header[4] = b->m.triangles, header[5] = b->elements;
    for (int k = 0; k < 3; ++k) {
        header[7 + k] = (uint32_t)b->lattice.count[k];
        header[10 + k] = unit_of(b, b->lattice.first[k], k);
        header[14 + k] = (uint32_t)b->origin[k];
    }
    header[17] = b->hull;
    header[13] = (uint32_t)floor(ldexp(b->lattice.spacing, b->units_log2) + 0.5);
    for (uint32_t i = 0; i < LMB_FIXED_HEADER_WORDS && ok; ++i) {
        ok = put(b, header[i], r);
    }
    for (uint32_t i = 0; i < all && ok; ++i) {
        ok = put_receiver(b, &b->receiver[i], r);
    }
    for (uint32_t i = 0; i < b->m.triangles && ok; ++i) {
        ok = put(b, b->corner[i][0] | b->corner[i][1] << 16, r) && put(b, b->corner[i][2], r);
    }
    for (uint32_t i = 0; i < all && ok; ++i) {
        uint32_t row[2];
        /* elements need half the links, because their light is reflected once more */
        ok = put_links(b, row, &b->receiver[i], i < b->vertices ? o->links : (o->links + 1) / 2, &links, r) &&
             put(b, row[0], r) && put(b, row[1], r);
        progress_tell("links", (double)i / all);
    }
    b->link_words = links.count;
    for (uint32_t i = 0; i < links.count && ok; ++i) {
        ok = put(b, links.words[i], r);
    }
    free(links.words);
    ok = ok && put_valid(b, r);
    for (uint32_t i = 0; i < all && ok; ++i) {
        ok = put_seen(b, &b->receiver[i], r);
        progress_tell("lamps", (double)i / all);
    }
    if (ok) {
        b->words[1] = b->count;
        b->words[6] = b->link_words;
    }
    return ok;
}

int vertex_light_make(uint32_t **words, uint32_t *count, vertex_light_facts *facts, const lmb_scene *scene,
                      const vertex_light_options *options, report *r)
{
    vertex_light_options o = *options;
    baking b;
    lmb_fixed opened;
    memset(&b, 0, sizeof b);
    memset(facts, 0, sizeof *facts);
    *words = NULL;
    *count = 0;
    o.vertices = o.vertices > 0 ? o.vertices : 600;
    o.elements = o.elements > 0 && o.elements <= LMB_FIXED_MAX_ELEMENTS ? o.elements : 192;
    o.links = o.links > 0 && o.links < MOST_LINKS ? o.links : 32;
    o.places = o.places > 0 ? o.places : 512;
    int ok = vl_mesh_build(&b.m, scene, o.vertices, r) && vl_sight_begin(&b.sight, &b.m, r) &&
             vl_lattice_make(&b.lattice, &b.m, &b.sight, o.places, r);
    if (ok) {
        drop_far_sides(&b);
        ok = vl_mesh_divide(&b.m, &b.sight, &b.lattice, o.vertices, r);
    }
    if (ok) {
        drop_buried(&b);
        set_units(&b);
        ok = b.m.triangles > 0 || report_fail(r, "no triangle of the scene can be seen");
        ok = ok && put_hull_first(&b, r);
    }
    ok = ok && make_vertices(&b, r) && make_elements(&b, o.elements, r);
    if (ok && (b.vertices > LMB_FIXED_MAX_VERTICES || b.m.triangles > LMB_FIXED_MAX_TRIANGLES)) {
        ok = report_fail(r, "%u vertices: more than %d", (unsigned)b.vertices, (int)LMB_FIXED_MAX_VERTICES);
    }
    ok = ok && put_all(&b, &o, r);
    if (ok && lmb_fixed_open(&opened, b.words, 4 * (size_t)b.count) != LMB_OK) {
        ok = report_fail(r, "the blob that was made is refused");
    }
    if (ok) {
        *words = b.words;
        *count = b.count;
        b.words = NULL;
        facts->vertices = b.vertices;
        facts->triangles = b.m.triangles;
        facts->elements = b.elements;
        facts->links = 2 * b.link_words;
        facts->places = b.lattice.all;
        facts->hidden = b.hidden;
        facts->hull = b.hull;
        for (uint32_t i = 0; i < b.lattice.all; ++i) {
            facts->valid += b.lattice.valid[i];
        }
        facts->unit_m = ldexp(1.0, -b.units_log2);
        facts->spacing_m = b.lattice.spacing;
    }
    free(b.words);
    free(b.receiver);
    free(b.corner);
    free(b.piece);
    free(b.lattice.valid);
    vl_sight_end(&b.sight);
    vl_mesh_free(&b.m);
    return ok;
}
