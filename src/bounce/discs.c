/* discs.c: first points -> discs: mean neighbour distances, and points much closer than that join. Layer 5.
 *                                                                                      [V8 V9 V10 V11 V12 V14 V15]
 * Neighbours are found through the map's cells. The search covers the requested number of cells, or as many as a radius
 * in space can span. */
#include <string.h>

#include "../base/poly.h"
#include "../raster/tile.h"
#include "group.h"

#if LMB_BOUNCE

#define SIN_25 0.42261826f
#define MAX_RIM_SINE 1e-3f         /* sine: a point this far below the plane still counts as on it */
#define LINK_IS_KEPT 0x80000000u   /* flag in a link: the other bits are the disc's new index */

enum { MAX_REACH_CELLS = 32 }; /* cells visited in each direction */

typedef struct neighbourhood {
    lmb_points *points;
    uint32_t side;
    float threshold, join;
    int32_t cells;        /* search radius in cells; 0: derived from `threshold` and `view` */
    const lmb_view *view; /* the view of the face, or of another face of the map */
    int32_t hemisphere;   /* 1: neighbours lie above the point's surface [V10] */
} neighbourhood;

/* The points in the cells around a point, in the map's order. */
typedef struct disc_neighbour {
    const neighbourhood *n;
    lmb_vec3 from; /* position of the point when the search began */
    int32_t x0, x1, x, y, y1, step; /* the current cell, and the last ones */
    uint32_t at, end;               /* next point of the current cell */
    lmb_point *q;                   /* current point: the one before `at` */
    lmb_vec3 away;                  /* from `from` to it, */
    float d;                        /* m */
} disc_neighbour;

/* Advances a->q to the next point. Returns 0 after the last one. */
static int next_around(disc_neighbour *a)
{
    const uint32_t side = a->n->side;
    while (a->at == a->end && a->y <= a->y1) {
        if ((uint32_t)a->x < side && (uint32_t)a->y < side) {
            const uint32_t *cell = &a->n->points->cells[(uint32_t)a->y * side + (uint32_t)a->x];
            a->at = cell[0];
            a->end = cell[1];
        }
        a->x += a->step;
        if (a->x > a->x1) {
            a->x = a->x0;
            a->y += a->step;
        }
    }
    if (a->at == a->end) {
        return 0;
    }
    a->q = &a->n->points->data[a->at++];
    a->away = sub3(a->q->position, a->from);
    a->d = length3(a->away);
    return 1;
}

/* 1 if a->q is a neighbour of p. Neighbours face the same way [V9], or lie in the hemisphere above p's surface and may
 * face any way [V10]. Points of the surface itself lie on the rim of the hemisphere, within rounding. In both cases the
 * distance is within the threshold. */
static int is_neighbour(const neighbourhood *n, const lmb_point *p, const disc_neighbour *a)
{
    const int meets =
        n->hemisphere ? dot3(p->normal, a->away) >= -MAX_RIM_SINE * a->d : dot3(p->normal, a->q->normal) >= TILE_COS_25;
    return meets && (n->threshold <= 0.0f || a->d <= n->threshold);
}

/* Sets up a search over the cells that can hold points within `radius` m of p, or over n->cells; at most `max` cells
 * away. If that is more than MAX_REACH_CELLS each way, it visits every second, third .. cell.
 *
 * A point at depth w m and tangent t on the map that moves by e m, |e| <= radius, changes its tangent by |e_x - t e_w|
 * / (w + e_w), which is at most radius sqrt(1 + t^2) / (w - radius). t is an upper and w a lower bound: both are taken
 * at the corner of a square through the far side of the cell. */
static void around_point(disc_neighbour *a, const neighbourhood *n, const lmb_point *p, float radius, int32_t max)
{
    const int32_t side = (int32_t)n->side, x = p->cell_x, y = p->cell_y;
    float cells = 0.5f * (float)side * radius / n->view->half_width;
    if (n->view->kind == LMB_PERSPECTIVE) {
        const float t = (float)(2 * maxi(maxi(x, y) + 1, side - mini(x, y)) - side) / (float)side * n->view->half_width,
                    stretch = sqrtf(1.0f + 2.0f * t * t),
                    beyond = length3(sub3(p->position, n->view->eye)) / stretch - radius;
        cells = beyond > 0.0f ? cells * stretch / beyond : (float)side;
    }
    /* Both points may lie anywhere in their cells; and rounding. */
    int32_t reach = n->cells > 0 ? n->cells : cells < (float)side ? (int32_t)cells + 2 : side;
    reach = mini(reach, max);
    a->n = n;
    a->from = p->position;
    a->step = (reach + MAX_REACH_CELLS - 1) / MAX_REACH_CELLS;
    reach = reach / a->step * a->step;
    a->x = a->x0 = x - reach;
    a->x1 = x + reach;
    a->y = y - reach;
    a->y1 = y + reach;
    a->at = a->end = 0;
}

/* [V8]: the mean over the neighbours. If there are none, the size of the quad. */
static float mean_distance(const neighbourhood *n, const lmb_point *p)
{
    disc_neighbour a;
    float sum = 0.0f, count = 0.0f;
    around_point(&a, n, p, n->threshold, (int32_t)n->side);
    while (next_around(&a)) {
        if (a.q != p && is_neighbour(n, p, &a)) {
            sum += a.d;
            count += 1.0f;
        }
    }
    return count > 0.0f ? sum / count : length3(p->axis_u) + length3(p->axis_v);
}

static void widen_disc(lmb_point *p, float times)
{
    p->axis_u = mul3(p->axis_u, times);
    p->axis_v = mul3(p->axis_v, times);
}

/* Merges q into p: flux and area add up, the rest is averaged. */
static void join_point(lmb_point *p, const lmb_point *q)
{
    float a = lmb_disc_power(p), b = lmb_disc_power(q), whole = a + b, share = whole > 0.0f ? b / whole : 0.5f;
    float area_p = lmb_disc_area(p), area_q = lmb_disc_area(q);
    float grow = area_p > 0.0f ? sqrtf((area_p + area_q) / area_p) : 1.0f;
    p->position = add3(p->position, mul3(sub3(q->position, p->position), share));
    p->normal = normalize3(add3(mul3(p->normal, 1.0f - share), mul3(q->normal, share)));
    for (int c = 0; c < 3; ++c) {
        p->flux[c] += q->flux[c];
        p->albedo[c] += (q->albedo[c] - p->albedo[c]) * share;
    }
    widen_disc(p, grow);
}

static void join_neighbours(const neighbourhood *n, uint32_t i)
{
    lmb_point *p = &n->points->data[i];
    const lmb_vec3 normal = p->normal; /* of the disc's first point, as are distances [V12] */
    const float within = n->join * p->distance;
    disc_neighbour a;
    around_point(&a, n, p, within, MAX_REACH_CELLS);
    while (next_around(&a)) {
        if (a.q > p && a.q->link == a.at - 1 && dot3(normal, a.q->normal) >= TILE_COS_25 && a.d < within) {
            join_point(p, a.q);
            a.q->link = i;
        }
    }
}

/* --- fewer discs than points [V14] -----------------------------------------------------------------------------------
 *
 * One of `thin` points becomes a disc: those in cells with x + a y = 0 (mod thin). That is a lattice with one cell in
 * `thin`. `a` puts the lattice cells farthest apart, so they spread evenly: thin = 10 gives squares of side sqrt 10
 * along (3, -1) and (1, 3). Each other point joins the nearest disc of its surface, so no flux is lost. If the surface
 * has no disc in reach, the point becomes one. */

/* Squared length of the shortest step of the lattice, which repeats after `thin` rows. */
static int32_t shortest_step(int32_t a, int32_t thin)
{
    int32_t shortest = thin * thin;
    for (int32_t y = 1; y < thin; ++y) {
        int32_t x = a * y % thin;
        x = mini(x, thin - x);
        shortest = mini(shortest, x * x + y * y);
    }
    return shortest;
}

static int32_t lattice_of(int32_t thin)
{
    int32_t best = 0;
    for (int32_t a = 1; a < thin; ++a) {
        best = shortest_step(a, thin) > shortest_step(best, thin) ? a : best;
    }
    return best;
}

/* Upper bound of the distance to the nearest lattice cell, in cells along x or y. Counted for each thin up to
 * LMB_MAX_THIN: steps are at least 0.81 sqrt thin long, and no cell is farther than 0.71 sqrt thin from one. This
 * returns sqrt thin, rounded up. */
static int32_t lattice_reach(int32_t thin)
{
    int32_t reach = 1;
    while (reach * reach < thin) {
        ++reach;
    }
    return reach;
}

/* 1 if a->q is on p's surface: the normals agree, and the chord leaves the plane by no more than on a surface that
 * turns by 25 degrees. */
static int is_point_on_surface(const lmb_point *p, const disc_neighbour *a)
{
    return dot3(p->normal, a->q->normal) >= TILE_COS_25 && absf(dot3(p->normal, a->away)) <= SIN_25 * a->d;
}

/* The nearest disc (a point that links to itself) on the surface of point i, or i. */
static uint32_t nearest_disc(const neighbourhood *n, uint32_t i)
{
    const lmb_point *p = &n->points->data[i];
    disc_neighbour a;
    uint32_t nearest = i;
    float min = 0.0f;
    around_point(&a, n, p, 0.0f, MAX_REACH_CELLS);
    while (next_around(&a)) {
        if (a.q->link == a.at - 1 && is_point_on_surface(p, &a) && (nearest == i || a.d < min)) {
            nearest = a.at - 1;
            min = a.d;
        }
    }
    return nearest;
}

/* Points that do not become discs have the link LMB_NOBODY. All of them choose a disc by the initial positions before
 * any point joins. */
static void thin_out(const neighbourhood *n, uint32_t first, int32_t thin)
{
    lmb_point *data = n->points->data;
    const uint32_t count = n->points->count;
    neighbourhood lattice = *n;
    lattice.cells = lattice_reach(thin);
    for (uint32_t i = first; i < count; ++i) {
        data[i].link = data[i].link == i ? i : nearest_disc(&lattice, i);
    }
    for (uint32_t i = first; i < count; ++i) {
        if (data[i].link != i) {
            join_point(&data[data[i].link], &data[i]);
        }
    }
}

/* Closes the gaps left by joined points and updates the owners of texels. A disc links to itself. The link of a joined
 * point is the index of the disc, or of a point that joined one in turn (thinned out first, then near another disc). */
static void close_gaps(lmb_points *points, uint32_t first, const lmb_shadow_map *map)
{
    lmb_point *data = points->data;
    const uint32_t texels = points->owner != NULL ? (uint32_t)map->size * (uint32_t)map->size : 0;
    uint32_t kept = first;
    for (uint32_t i = first; i < points->count; ++i) {
        data[i].link = data[data[i].link].link;
    }
    for (uint32_t i = first; i < points->count; ++i) {
        data[i].link = data[i].link == i ? LINK_IS_KEPT | kept++ : data[i].link;
    }
    for (uint32_t t = points->owner_count - texels; t < points->owner_count; ++t) {
        uint32_t *owner = &points->owner[t];
        if (*owner != LMB_NOBODY) {
            const uint32_t link = data[*owner].link;
            *owner = (link & LINK_IS_KEPT ? link : data[link].link) & ~LINK_IS_KEPT;
        }
    }
    kept = first;
    for (uint32_t i = first; i < points->count; ++i) {
        if (data[i].link & LINK_IS_KEPT) {
            data[kept++] = data[i];
        }
    }
    points->count = kept;
}

/* [V12]: scales discs to a radius of `radius` times their mean distance. */
static void set_radius(lmb_points *points, uint32_t first, float radius)
{
    for (uint32_t i = first; radius > 0.0f && i < points->count; ++i) {
        lmb_point *p = &points->data[i];
        const float area = lmb_disc_area(p);
        widen_disc(p, area > 0.0f ? radius * p->distance * sqrtf(LMB_PI / area) : 1.0f);
    }
}

/* 1 if the points were collected in blocks of this size: the last cell then ends at the last point. */
static int has_cells(const lmb_points *points, const lmb_shadow_map *map, int32_t block)
{
    const uint32_t side = block > 0 && block <= LMB_TILE ? (uint32_t)(map->size / block) : 0;
    return side > 0 && side * side < points->cell_cap && points->cells[side * side] == points->count;
}

lmb_status lmb_discs_join(lmb_points *points, const lmb_shadow_map *map, const lmb_grouping *grouping)
{
    lmb_grouping g;
    neighbourhood n;
    memset(&g, 0, sizeof g);
    g = grouping != NULL ? *grouping : g;
    g.block = g.block != 0 ? g.block : LMB_TILE;
    if (points == NULL || map == NULL || points->faces == 0 || (uint32_t)g.thin > LMB_MAX_THIN ||
        !has_cells(points, map, g.block)) {
        return LMB_ERR_ARG;
    }
    n.points = points;
    n.side = (uint32_t)(map->size / g.block);
    n.view = &map->view[0]; /* faces of a map differ only in their axes */
    n.threshold = g.neighbour_m;
    n.cells = g.neighbour_cells > 0 || g.neighbour_m > 0.0f ? g.neighbour_cells : 1;
    n.join = g.join > 0.0f ? g.join : 0.5f;
    n.hemisphere = (g.flags & LMB_NEAR_HEMISPHERE) != 0;
    const uint32_t first = points->cells[0];
    const int32_t thin = maxi(g.thin, 1), a = lattice_of(thin);
    for (uint32_t i = first; i < points->count; ++i) {
        lmb_point *p = &points->data[i];
        p->distance = mean_distance(&n, p);
        p->link = (p->cell_x + a * p->cell_y) % thin == 0 ? i : LMB_NOBODY;
    }
    thin_out(&n, first, thin);
    for (uint32_t i = first; i < points->count; ++i) {
        if (points->data[i].link == i) {
            join_neighbours(&n, i);
        }
    }
    close_gaps(points, first, map);
    set_radius(points, first, g.radius);
    return LMB_OK;
}

#endif
