/* crease.c: the sides and the exact shape of a shadow map texel in which two planes show. Layer 6.        [V15]
 *
 * A texel's centre selects one surface, but near an edge the texel shows two. Along the line through two texel centres,
 * a plane's 1 / w (positional lights) or w (suns) is linear, so two planes meet at a difference of 0. If that is
 * between the centres, the edge is there. What one texel loses the other gains, so light through the map is conserved.
 * Distant receivers use a rectangle with these sides. For near ones, the shape is the part of the texel's own cell and
 * of neighbouring cells that shows its plane, each cut along the lines where planes meet, in any direction. */
#include "tree.h"

#include <string.h>

#include "../base/vec.h"
#include "../direct/footprint.h"
#include "facets.h"

#if LMB_TREES

/* share of 1 / w at the centre: if a corner has less, the plane runs away from the light */
#define MIN_CORNER_SHARE 0.25f

/* A point of the map, in the plane at distance 1 (m for suns). */
typedef struct crease_place {
    float x, y;
} crease_place;

static crease_place middle_of(const lmb_view *v, int32_t size, int32_t x, int32_t y)
{
    crease_place out;
    out.x = (float)(2 * x + 1 - size) / (float)size * v->half_width;
    out.y = (float)(size - 2 * y - 1) / (float)size * v->half_height;
    return out;
}

/* Shared by the slopes of all planes over one point: a ray of the map, or for suns the offset across it. */
static inline lmb_vec3 ray_at(const lmb_view *v, crease_place s)
{
    const lmb_vec3 across = add3(mul3(v->right, s.x), mul3(v->up, s.y));
    return v->kind == LMB_PERSPECTIVE ? sub3(across, v->back) : across;
}

/* 1 / w or w of the texel's plane along a ray. */
static inline float slope_along(const lmb_view *v, const lmb_texel *t, lmb_vec3 ray)
{
    const lmb_vec3 p = sub3(t->position, v->eye);
    return v->kind == LMB_PERSPECTIVE ? dot3(t->normal, ray) / dot3(t->normal, p)
                                      : dot3(t->normal, sub3(p, ray)) / -dot3(t->normal, v->back);
}

/* Difference of these between planes a and b: how far a is in front of b, over a point of the map. */
static inline float before_at(const lmb_view *v, const lmb_texel *a, const lmb_texel *b, crease_place s)
{
    const lmb_vec3 ray = ray_at(v, s);
    return slope_along(v, a, ray) - slope_along(v, b, ray);
}

static int same_plane(const lmb_texel *a, const lmb_texel *b)
{
    const lmb_vec3 d = sub3(b->position, a->position);
    return dot3(a->normal, b->normal) > 0.9999f && absf(dot3(a->normal, d)) < 1e-3f * length3(d);
}

/* --- sides -------------------------------------------------------------------------------------------------------- */

/* Two neighbours and their centres. */
typedef struct crease_pair {
    lmb_texel *a, *b;
    crease_place from, to;
} crease_pair;

/* Line where the two planes meet, as a share of the way from a to b; 0: not between the centres. */
static float planes_meet(const lmb_view *v, const crease_pair *p)
{
    const float here = before_at(v, p->a, p->b, p->from), there = before_at(v, p->a, p->b, p->to);
    const float share = here / (here - there);
    return here * there < 0.0f && share > 0.0f && share < 1.0f ? share : 0.0f;
}

/* Extends texel a towards b up to their common edge, and b towards a. Extents are rounded so that no gap remains
 * between the two, and so that neither looks like a whole texel. A texel with facets keeps the whole cell. */
static void set_crease_edge(const lmb_view *v, const crease_pair *p, int a_side, int b_side)
{
    const int several = facets_are_several(p->a) || facets_are_several(p->b);
    const float share = several || same_plane(p->a, p->b) ? 0.0f : planes_meet(v, p);
    if (share > 0.0f) {
        int at = (int)(share * 256.0f);
        at = at == 127 ? 126 : at == 128 ? 129 : at;
        p->a->side[a_side] = (uint8_t)mini(at + 1, 255);
        p->b->side[b_side] = (uint8_t)mini(256 - at, 255);
    }
}

void lmb_crease_find(const lmb_tree *tree, uint32_t face)
{
    const int32_t size = tree->size;
    const lmb_view *v = &tree->view[face];
    lmb_texel *all = tree->texel + (size_t)face * (size_t)size * (size_t)size;
    for (int32_t i = 0; i < size * size; ++i) {
        const int32_t x = i % size, y = i / size;
        crease_pair p;
        p.a = &all[i];
        if (!(flux_sum(p.a->flux) > 0.0f)) {
            continue;
        }
        p.from = middle_of(v, size, x, y);
        if (x + 1 < size && flux_sum(p.a[1].flux) > 0.0f) {
            p.b = p.a + 1;
            p.to = middle_of(v, size, x + 1, y);
            set_crease_edge(v, &p, SIDE_RIGHT, SIDE_LEFT);
        }
        if (y + 1 < size && flux_sum(p.a[size].flux) > 0.0f) {
            p.b = p.a + size;
            p.to = middle_of(v, size, x, y + 1);
            set_crease_edge(v, &p, SIDE_DOWN, SIDE_UP);
        }
    }
}

/* --- shapes ------------------------------------------------------------------------------------------------------- */

/* The planes in one texel's cell: the texel's own, then each neighbour's that meets it, once. */
typedef struct crease_cell {
    const lmb_texel *plane[CREASE_PARTS];
    int planes;
} crease_cell;

static const lmb_texel *neighbour_texel(const lmb_tree *tree, lmb_node_ref at, int side)
{
    return tree_texel(tree, at.face, at.x + (side == SIDE_RIGHT) - (side == SIDE_LEFT),
                      at.y + (side == SIDE_DOWN) - (side == SIDE_UP));
}

static void cell_of_texel(crease_cell *out, const lmb_tree *tree, lmb_node_ref at)
{
    const lmb_texel *own = tree_texel(tree, at.face, at.x, at.y);
    out->plane[0] = own;
    out->planes = 1;
    for (int side = 0; side < 4; ++side) {
        if (own->side[side] != SIDE_WHOLE) {
            const lmb_texel *other = neighbour_texel(tree, at, side);
            int known = 0;
            for (int i = 0; i < out->planes; ++i) {
                known |= same_plane(out->plane[i], other);
            }
            out->plane[out->planes] = other;
            out->planes += !known;
        }
    }
}

/* Clips a polygon of the map to the part where plane a shows in front of plane b: the side of their common line with
 * a's centre. Returns the number of corners. */
static int clip_to(crease_place *inout, int corners, const lmb_view *v, const lmb_texel *a, const lmb_texel *b,
                   crease_place middle)
{
    crease_place out[CREASE_CORNERS];
    float h[CREASE_CORNERS];
    int count = 0;
    const float inner = before_at(v, a, b, middle);
    for (int i = 0; i < corners; ++i) {
        h[i] = before_at(v, a, b, inout[i]);
    }
    for (int i = 0; i < corners; ++i) {
        const int next = i + 1 < corners ? i + 1 : 0;
        const crease_place p = inout[i], q = inout[next];
        const float hp = h[i], hq = h[next];
        const int p_in = hp * inner >= 0.0f, q_in = hq * inner >= 0.0f;
        if (p_in && count < CREASE_CORNERS) {
            out[count++] = p;
        }
        if (p_in != q_in && count < CREASE_CORNERS) {
            const float share = hp / (hp - hq);
            out[count].x = p.x + (q.x - p.x) * share;
            out[count++].y = p.y + (q.y - p.y) * share;
        }
    }
    memcpy(inout, out, (size_t)count * sizeof *out);
    return count;
}

/* Texel a's part of a cell with all planes known. The centre of a selects the side of each line. */
static int shape_in(crease_place *out, const crease_cell *c, const lmb_view *v, int32_t size, lmb_node_ref at,
                    crease_place middle, const lmb_texel *a)
{
    const crease_place m = middle_of(v, size, at.x, at.y);
    const float px = v->half_width / (float)size, py = v->half_height / (float)size;
    int corners = 4;
    /* Unrolled: gcc 12.2 for Helium miscompiles the condition i == 1 || i == 2 in a loop, and selects 1, 2 and 3. */
    out[0].x = out[3].x = m.x - px;
    out[1].x = out[2].x = m.x + px;
    out[0].y = out[1].y = m.y - py;
    out[2].y = out[3].y = m.y + py;
    for (int i = 0; i < c->planes; ++i) {
        if (c->plane[i] != a && !same_plane(c->plane[i], a)) {
            corners = clip_to(out, corners, v, a, c->plane[i], middle);
        }
    }
    return corners;
}

static int represents(const crease_cell *c, const lmb_texel *a)
{
    int found = 0;
    for (int i = 0; i < c->planes; ++i) {
        found |= c->plane[i] == a;
    }
    return found;
}

/* Part 0: in the texel's own cell; 1 .. 4: in the neighbours' cells. */
static int corners_of_part(crease_place out[CREASE_CORNERS], const lmb_tree *tree, lmb_node_ref at, int part)
{
    const lmb_view *v = &tree->view[at.face];
    const lmb_texel *own = tree_texel(tree, at.face, at.x, at.y);
    const int side = part - 1;
    lmb_node_ref where = at;
    crease_cell c;
    if (part > 0) {
        if (own->side[side] == SIDE_WHOLE) {
            return 0;
        }
        where.x = (uint16_t)(at.x + (side == SIDE_RIGHT) - (side == SIDE_LEFT));
        where.y = (uint16_t)(at.y + (side == SIDE_DOWN) - (side == SIDE_UP));
    }
    cell_of_texel(&c, tree, where);
    return represents(&c, own) ? shape_in(out, &c, v, tree->size, where, middle_of(v, tree->size, at.x, at.y), own) : 0;
}

/* 1 if the plane runs away from the light at the texel's centre, or between the centre and a corner. */
NOINLINE int is_steep(const lmb_view *v, const lmb_texel *own, crease_place middle, const crease_place *corner,
                      int corners)
{
    if (v->kind != LMB_PERSPECTIVE) {
        return corners > 0 && dot3(own->normal, v->back) < GRAZE;
    }
    const float there = slope_along(v, own, ray_at(v, middle));
    int steep = corners > 0 && !(there > 0.0f);
    for (int i = 0; i < corners; ++i) {
        steep |= slope_along(v, own, ray_at(v, corner[i])) < MIN_CORNER_SHARE * there;
    }
    return steep;
}

float lmb_crease_share(const lmb_tree *tree, lmb_node_ref at)
{
    const lmb_view *v = &tree->view[at.face];
    const lmb_texel *own = tree_texel(tree, at.face, at.x, at.y);
    const crease_place middle = middle_of(v, tree->size, at.x, at.y);
    const float wide = 2.0f * v->half_width / (float)tree->size, high = 2.0f * v->half_height / (float)tree->size;
    float twice = 0.0f;
    for (int part = 0; part < CREASE_PARTS; ++part) {
        crease_place p[CREASE_CORNERS];
        const int corners = corners_of_part(p, tree, at, part);
        if (is_steep(v, own, middle, p, corners)) {
            return -1.0f;
        }
        for (int i = 0; i < corners; ++i) {
            const int k = i + 1 < corners ? i + 1 : 0;
            twice += (p[i].x - p[0].x) * (p[k].y - p[0].y) - (p[k].x - p[0].x) * (p[i].y - p[0].y);
        }
    }
    return 0.5f * twice / (wide * high);
}

int lmb_crease_part(lmb_vec3 corner[CREASE_CORNERS], const lmb_tree *tree, lmb_node_ref at, int part)
{
    const lmb_texel *own = tree_texel(tree, at.face, at.x, at.y);
    crease_place flat[CREASE_CORNERS];
    const int corners = corners_of_part(flat, tree, at, part);
    for (int i = 0; i < corners; ++i) {
        corner[i] = footprint_over(&tree->view[at.face], own->position, own->normal, flat[i].x, flat[i].y);
    }
    return corners;
}

#endif
