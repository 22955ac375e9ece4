/* bake_cuts.c: cuts large triangles along lines at which other triangles touch or cross them -> trees of cuts. */
#include "bake.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../common/fvec.h"
#include "bake_triangle.h"

enum { DEPTH = 16, LINES = 512, FEW = 4, SHARE = 2 };
#define TOUCH  0.01  /* of the smallest edge: points nearer to a plane count as on it */
#define BESIDE 0.005 /* of the smallest edge: lines nearer to an edge cut nothing off */
#define SHORT  0.05f /* of the smallest edge: shorter lines are ignored in the first pass */
#define FEWER  4.0f  /* times longer in each further pass, if there are too many cuts */

/* A point on a triangle's plane, m, and a line between two points. */
typedef struct spot {
    double x, y;
} spot;

typedef struct line {
    spot end[2];
    double length;
} line;

typedef struct cutter {
    bake *b;
    lmb_vec3 *low, *high; /* bounds of each triangle */
    double touch, beside, shortest, side; /* side: longer edges are halved before many lines cut them */
    lmb_triangle own;
    double origin[3], u[3], v[3], n[3]; /* of the current triangle */
    line lines[DEPTH + 1][LINES];       /* of a node and all above it */
    report *r;
} cutter;

/* --- trees -------------------------------------------------------------------------------------------------------- */

uint32_t bake_first(const bake *b, uint32_t word)
{
    const uint32_t low = word & ((1u << LMB_TRANSFER_EDGE_BIT) - 1u);
    return word >> LMB_TRANSFER_EDGE_BIT != LMB_TRANSFER_CUT
               ? low
               : b->section[LMB_TRANSFER_CUTS].data[LMB_TRANSFER_CUT_WORDS * (size_t)low] &
                     ((1u << LMB_TRANSFER_EDGE_BIT) - 1u);
}

float bake_part_of(const bake *b, uint32_t word)
{
    const uint32_t low = word & ((1u << LMB_TRANSFER_EDGE_BIT) - 1u);
    float part = 0.5f;
    if (word >> LMB_TRANSFER_EDGE_BIT == LMB_TRANSFER_CUT) {
        memcpy(&part, &b->section[LMB_TRANSFER_CUTS].data[LMB_TRANSFER_CUT_WORDS * (size_t)low + 1], sizeof part);
    }
    return part;
}

lmb_vec3 bake_cut_at(const bake_cut *c, const lmb_vec3 corner[3])
{
    const lmb_vec3 a = corner[c->from], b = corner[(c->from + 1) % 3];
    return c->part == 0.5f ? mul3(add3(a, b), 0.5f) : add3(mul3(a, 1.0f - c->part), mul3(b, c->part));
}

int bake_divide(bake *b, bake_words *nodes, size_t node, const bake_cut *c, uint32_t *first, report *r)
{
    bake_words *cuts = &b->section[LMB_TRANSFER_CUTS];
    *first = (uint32_t)nodes->count;
    if (!bake_put(nodes, 0, r) || !bake_put(nodes, 0, r)) {
        return 0;
    }
    const uint32_t word = (uint32_t)c->from << LMB_TRANSFER_EDGE_BIT | *first;
    if (c->part == 0.5f && !c->is_wall) {
        nodes->data[node] = word;
        return 1;
    }
    nodes->data[node] =
        LMB_TRANSFER_CUT << LMB_TRANSFER_EDGE_BIT | (uint32_t)(cuts->count / LMB_TRANSFER_CUT_WORDS);
    return bake_put(cuts, word | (c->is_wall ? LMB_TRANSFER_WALL : 0), r) && bake_put_float(cuts, c->part, r);
}

/* Adds two more nodes, both leaves. */
static int add_nodes(cutter *c, uint32_t *first)
{
    bake *b = c->b;
    if (b->cut_count + 2 > b->cut_cap) {
        const uint32_t cap = 2 * b->cut_cap + 256;
        bake_cut *data = realloc(b->cut, cap * sizeof *data);
        if (data == NULL) {
            return report_fail(c->r, "not enough memory for %u cuts", (unsigned)cap);
        }
        b->cut = data;
        b->cut_cap = cap;
    }
    memset(&b->cut[b->cut_count], 0, 2 * sizeof *b->cut);
    *first = b->cut_count;
    b->cut_count += 2;
    return 1;
}

/* --- lines -------------------------------------------------------------------------------------------------------- */

static double along(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void to_plane(double out[3], const cutter *c, lmb_vec3 p)
{
    const double d[3] = {(double)p.x - c->origin[0], (double)p.y - c->origin[1], (double)p.z - c->origin[2]};
    out[0] = along(d, c->u);
    out[1] = along(d, c->v);
    out[2] = along(d, c->n);
}

/* Returns how far a point lies inside the edge that starts at corner k; the corners are counter-clockwise. */
static double within(const spot corner[3], int k, spot p)
{
    const spot a = corner[k], b = corner[(k + 1) % 3];
    const double x = b.x - a.x, y = b.y - a.y, length = sqrt(x * x + y * y);
    return length > 0.0 ? (x * (p.y - a.y) - y * (p.x - a.x)) / length : 0.0;
}

static spot between(spot a, spot b, double part)
{
    const spot out = {a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)};
    return out;
}

static double distance(spot a, spot b) { return sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y)); }

/* Clips a line to the triangle. Returns 0 if too little is left or it runs along an edge. */
static int clip(line *out, const cutter *c, const spot corner[3], const line *of)
{
    *out = *of;
    for (int k = 0; k < 3; ++k) {
        const double d[2] = {within(corner, k, out->end[0]), within(corner, k, out->end[1])};
        if (d[0] <= c->beside && d[1] <= c->beside) {
            return 0;
        }
        for (int i = 0; i < 2; ++i) {
            if (d[i] < 0.0) {
                out->end[i] = between(out->end[i], out->end[1 - i], d[i] / (d[i] - d[1 - i]));
            }
        }
    }
    out->length = distance(out->end[0], out->end[1]);
    return out->length >= c->shortest;
}

static void add_line(const cutter *c, line *to, int *count, const spot corner[3], spot a, spot b)
{
    line whole, own;
    whole.end[0] = a;
    whole.end[1] = b;
    whole.length = 0.0;
    if (!clip(&own, c, corner, &whole)) {
        return;
    }
    int at = *count;
    if (*count == LINES) { /* drop the shortest */
        at = 0;
        for (int i = 1; i < LINES; ++i) {
            at = to[i].length < to[at].length ? i : at;
        }
        if (to[at].length >= own.length) {
            return;
        }
    } else {
        ++*count;
    }
    to[at] = own;
}

/* Adds the line in which another triangle meets the plane of the current one. */
static void meet(cutter *c, int *count, const spot corner[3], const lmb_triangle *with)
{
    double p[3][3];
    spot found[3];
    int on = 0, some = 0;
    for (int k = 0; k < 3; ++k) {
        to_plane(p[k], c, with->corner[k]);
        p[k][2] = fabs(p[k][2]) <= c->touch ? 0.0 : p[k][2];
        on += p[k][2] == 0.0;
    }
    if (on == 3) {
        return; /* lies in the plane: its neighbours meet the plane instead */
    }
    for (int k = 0; k < 3; ++k) {
        const double *a = p[k], *b = p[(k + 1) % 3];
        if (a[2] == 0.0) {
            found[some].x = a[0];
            found[some++].y = a[1];
        } else if (a[2] * b[2] < 0.0) {
            const double part = a[2] / (a[2] - b[2]);
            found[some].x = a[0] + part * (b[0] - a[0]);
            found[some++].y = a[1] + part * (b[1] - a[1]);
        }
    }
    if (some == 2) {
        add_line(c, c->lines[0], count, corner, found[0], found[1]);
    }
}

/* --- cuts --------------------------------------------------------------------------------------------------------- */

static int longest_edge(const spot corner[3], double *length)
{
    int from = 0;
    for (int k = 1; k < 3; ++k) {
        if (distance(corner[k], corner[(k + 1) % 3]) > distance(corner[from], corner[(from + 1) % 3])) {
            from = k;
        }
    }
    *length = distance(corner[from], corner[(from + 1) % 3]);
    return from;
}

/* Chooses a cut through a corner if the line passes close to one. Otherwise the cut runs from a crossed edge to the
 * opposite corner, so that the line passes through a corner of the remaining parts. Returns 0 if the line cuts
 * nothing off. */
static int choose_cut(bake_cut *out, const cutter *c, const spot corner[3], const line *by)
{
    const double x = (by->end[1].x - by->end[0].x) / by->length, y = (by->end[1].y - by->end[0].y) / by->length;
    double side[3], best = HUGE_VAL;
    out->from = -1;
    for (int k = 0; k < 3; ++k) {
        side[k] = x * (corner[k].y - by->end[0].y) - y * (corner[k].x - by->end[0].x);
        side[k] = fabs(side[k]) <= c->beside ? 0.0 : side[k];
    }
    for (int k = 0; k < 3; ++k) {
        const int to = (k + 1) % 3, other = (k + 2) % 3;
        if (side[k] * side[to] >= 0.0) {
            continue;
        }
        const double part = side[k] / (side[k] - side[to]);
        const double length = side[other] == 0.0 ? -1.0 : distance(between(corner[k], corner[to], part), corner[other]);
        if (length < best && part > 1e-4 && part < 1.0 - 1e-4) {
            best = length;
            out->from = k;
            out->part = (float)part;
            out->is_wall = side[other] == 0.0;
        }
    }
    return out->from >= 0;
}

static int divide(cutter *c, uint32_t node, const spot corner[3], int count, int depth);

/* Distributes the lines to both parts. */
static int enter_parts(cutter *c, uint32_t node, const bake_cut *cut, const spot corner[3], int count, int depth)
{
    const int from = cut->from, to = (from + 1) % 3;
    const spot mid = between(corner[from], corner[to], (double)cut->part);
    uint32_t first;
    if (!add_nodes(c, &first)) {
        return 0;
    }
    c->b->cut[node] = *cut;
    c->b->cut[node].first = first;
    for (uint32_t h = 0; h < 2; ++h) {
        spot half[3];
        int own = 0;
        memcpy(half, corner, sizeof half);
        half[h == 0 ? to : from] = mid;
        for (int i = 0; i < count; ++i) {
            own += clip(&c->lines[depth + 1][own], c, half, &c->lines[depth][i]);
        }
        if (!divide(c, first + h, half, own, depth + 1)) {
            return 0;
        }
    }
    return 1;
}

static int divide(cutter *c, uint32_t node, const spot corner[3], int count, int depth)
{
    line *lines = c->lines[depth];
    bake_cut cut;
    double longest;
    memset(&cut, 0, sizeof cut);
    if (count == 0 || depth == DEPTH) {
        return 1;
    }
    const int edge = longest_edge(corner, &longest);
    if (count > FEW && longest > c->side) {
        cut.from = edge;
        cut.part = 0.5f;
        return enter_parts(c, node, &cut, corner, count, depth);
    }
    int best = 0;
    for (int i = 1; i < count; ++i) {
        best = lines[i].length > lines[best].length ? i : best;
    }
    if (!choose_cut(&cut, c, corner, &lines[best])) {
        lines[best] = lines[count - 1];
        return divide(c, node, corner, count - 1, depth);
    }
    return enter_parts(c, node, &cut, corner, count, depth);
}

/* --- triangles ---------------------------------------------------------------------------------------------------- */

static void set_vector(double out[3], lmb_vec3 v)
{
    out[0] = (double)v.x;
    out[1] = (double)v.y;
    out[2] = (double)v.z;
}

static void set_axes(cutter *c, spot corner[3], lmb_vec3 normal)
{
    double p[3];
    lmb_vec3 u = sub3(c->own.corner[1], c->own.corner[0]);
    u = normalize3(sub3(u, mul3(normal, dot3(u, normal))));
    set_vector(c->origin, c->own.corner[0]);
    set_vector(c->u, u);
    set_vector(c->v, cross3(normal, u));
    set_vector(c->n, normal);
    for (int k = 0; k < 3; ++k) {
        to_plane(p, c, c->own.corner[k]);
        corner[k].x = p[0];
        corner[k].y = p[1];
    }
}

static int are_apart(const cutter *c, uint32_t a, uint32_t b)
{
    const float t = (float)c->touch;
    const lmb_vec3 al = c->low[a], ah = c->high[a], bl = c->low[b], bh = c->high[b];
    return al.x > bh.x + t || bl.x > ah.x + t || al.y > bh.y + t || bl.y > ah.y + t || al.z > bh.z + t ||
           bl.z > ah.z + t;
}

static int cut_triangle(cutter *c, uint32_t id)
{
    bake *b = c->b;
    lmb_triangle with;
    lmb_vec3 normal;
    spot corner[3];
    uint32_t first;
    float area;
    int count = 0;
    if (!lmb_triangle_fetch(&c->own, b->scene, id) || !lmb_triangle_shape(&normal, &area, &c->own) ||
        bake_is_small(b, c->own.corner)) {
        return 1;
    }
    set_axes(c, corner, normal);
    for (uint32_t i = 1; i <= lmb_scene_triangles(b->scene); ++i) {
        if (i != id && !are_apart(c, id, i) && lmb_triangle_fetch(&with, b->scene, i)) {
            meet(c, &count, corner, &with);
        }
    }
    if (count == 0) {
        return 1;
    }
    if (!add_nodes(c, &first)) {
        return 0;
    }
    b->cut_root[id - 1] = first;
    return divide(c, first, corner, count, 0);
}

static void set_boxes(cutter *c)
{
    for (uint32_t id = 1; id <= lmb_scene_triangles(c->b->scene); ++id) {
        lmb_triangle t;
        c->low[id] = vec3(1e30f, 1e30f, 1e30f);
        c->high[id] = vec3(-1e30f, -1e30f, -1e30f);
        for (int k = 0; lmb_triangle_fetch(&t, c->b->scene, id) && k < 3; ++k) {
            c->low[id] = min3(c->low[id], t.corner[k]);
            c->high[id] = max3(c->high[id], t.corner[k]);
        }
    }
}

/* Cuts all triangles, with fewer lines if there are more cuts than the elements can follow. */
static int cut_all(cutter *c)
{
    bake *b = c->b;
    const uint32_t all = lmb_scene_triangles(b->scene);
    c->shortest = (double)b->cut_shortest;
    do {
        memset(b->cut_root, 0, ((size_t)all + 1) * sizeof *b->cut_root);
        b->cut_count = 2; /* node 0 means none */
        for (uint32_t id = 1; id <= all; ++id) {
            if (!cut_triangle(c, id)) {
                return 0;
            }
            if (b->cut_count > b->set.elements / SHARE && b->cut_count > 2 * SHARE) {
                break;
            }
        }
        b->cut_shortest = (float)c->shortest;
        c->shortest *= 2.0;
    } while (b->cut_count > b->set.elements / SHARE && b->cut_count > 2 * SHARE);
    return 1;
}

int bake_cuts(bake *b, report *r)
{
    const size_t all = lmb_scene_triangles(b->scene);
    cutter *c = calloc(1, sizeof *c);
    uint32_t first;
    int ok = c != NULL;
    free(b->cut_root);
    b->cut_root = calloc(all + 1, sizeof *b->cut_root);
    b->cut_shortest = b->cut_shortest > 0.0f ? FEWER * b->cut_shortest : SHORT * b->set.smallest_m;
    b->cut_count = 0;
    if (ok) {
        c->b = b;
        c->r = r;
        c->touch = TOUCH * (double)b->set.smallest_m;
        c->beside = BESIDE * (double)b->set.smallest_m;
        c->side = (double)sqrtf(b->area / (float)b->set.elements);
        c->low = malloc((all + 1) * sizeof *c->low);
        c->high = malloc((all + 1) * sizeof *c->high);
    }
    ok = (ok && b->cut_root != NULL && c->low != NULL && c->high != NULL) ||
         report_fail(r, "not enough memory for %.0f triangles", (double)all);
    if (ok) {
        set_boxes(c);
        ok = add_nodes(c, &first) && cut_all(c);
    }
    if (c != NULL) {
        free(c->low);
        free(c->high);
    }
    free(c);
    return ok;
}
