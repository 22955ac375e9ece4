/* discs.c: first points -> discs: mean neighbour distances, and points much closer than that join. Floor 6.
 *                                                                                      [V8 V9 V10 V11 V12 V14 V15]
 * Neighbours are looked up in map space: the points of the eight cells around and of the own one. */
#include <lambent/bounce.h>

#include "../base/vec.h"

#define COS_25 0.90630779f
#define SIN_25 0.42261826f
#define RIM 1e-3f          /* sine of the angle under the plane at which a point still counts as on it */
#define KEPT 0x80000000u   /* in a link: what stands beside is the disc's next place */

typedef struct neighbourhood {
    lmb_points *points;
    uint32_t side, face;
    float threshold, join;
    int32_t hemisphere; /* 1: what counts as a neighbour lies over the point's surface [V10] */
} neighbourhood;

/* Points of the cells up to `reach` beside cell (x, y), in its row: a run, since rows are contiguous. */
static void cell_run(uint32_t *begin, uint32_t *end, const neighbourhood *n, int32_t x, int32_t y, int32_t reach)
{
    int32_t x0 = maxi(x - reach, 0), x1 = mini(x + reach, (int32_t)n->side - 1);
    *begin = n->points->cells[(uint32_t)y * n->side + (uint32_t)x0];
    *end = n->points->cells[(uint32_t)y * n->side + (uint32_t)x1 + 1];
}

/* Is q, at `away` from p, d m off, one of p's neighbours? Those face the same way [V9], or are met in one of the
 * directions of the hemisphere over p's surface, whichever way they face [V10]: the surface's own points lie on the
 * hemisphere's rim, give or take the rounding. Either way within the threshold. */
static int is_neighbour(const neighbourhood *n, const lmb_point *p, const lmb_point *q, lmb_vec3 away, float d)
{
    const int meets = n->hemisphere ? dot3(p->normal, away) >= -RIM * d : dot3(p->normal, q->normal) >= COS_25;
    return meets && (n->threshold <= 0.0f || d <= n->threshold);
}

/* [V8]: the mean over the neighbours; without any, the quad's own size. */
static float mean_distance(const neighbourhood *n, uint32_t i)
{
    const lmb_point *p = &n->points->data[i];
    float sum = 0.0f;
    uint32_t count = 0;
    for (int32_t y = maxi(p->cell_y - 1, 0); y <= mini(p->cell_y + 1, (int32_t)n->side - 1); ++y) {
        uint32_t begin, end;
        cell_run(&begin, &end, n, p->cell_x, y, 1);
        for (uint32_t j = begin; j < end; ++j) {
            const lmb_point *q = &n->points->data[j];
            lmb_vec3 away = sub3(q->position, p->position);
            float d = length3(away);
            if (j != i && is_neighbour(n, p, q, away, d)) {
                sum += d;
                ++count;
            }
        }
    }
    return count > 0 ? sum / (float)count : length3(p->axis_u) + length3(p->axis_v);
}

static float power(const lmb_point *p) { return p->flux[0] + p->flux[1] + p->flux[2]; }

/* Sum q into p: flux and area add up, the rest is their mean. */
static void join_point(lmb_point *p, const lmb_point *q)
{
    float a = power(p), b = power(q), whole = a + b, share = whole > 0.0f ? b / whole : 0.5f;
    float area_p = length3(cross3(p->axis_u, p->axis_v)), area_q = length3(cross3(q->axis_u, q->axis_v));
    float grow = area_p > 0.0f ? sqrtf((area_p + area_q) / area_p) : 1.0f;
    p->position = add3(p->position, mul3(sub3(q->position, p->position), share));
    p->normal = normalize3(add3(mul3(p->normal, 1.0f - share), mul3(q->normal, share)));
    for (int c = 0; c < 3; ++c) {
        p->flux[c] += q->flux[c];
        p->albedo[c] += (q->albedo[c] - p->albedo[c]) * share;
    }
    p->axis_u = mul3(p->axis_u, grow);
    p->axis_v = mul3(p->axis_v, grow);
}

static void join_neighbours(const neighbourhood *n, uint32_t i)
{
    lmb_point *p = &n->points->data[i];
    const lmb_point at = *p; /* distances are from the disc's first point [V12] */
    for (int32_t y = maxi(at.cell_y - 1, 0); y <= mini(at.cell_y + 1, (int32_t)n->side - 1); ++y) {
        uint32_t begin, end;
        cell_run(&begin, &end, n, at.cell_x, y, 1);
        for (uint32_t j = begin > i ? begin : i + 1; j < end; ++j) {
            lmb_point *q = &n->points->data[j];
            if (q->link == j && dot3(at.normal, q->normal) >= COS_25 &&
                length3(sub3(at.position, q->position)) < n->join * at.distance) {
                join_point(p, q);
                q->link = i;
            }
        }
    }
}

/* --- fewer discs than points [V14] -----------------------------------------------------------------------------------
 *
 * Of `thin` points one becomes a disc: those of the cells with x + a y = 0 (mod thin). That is a lattice with one cell
 * in `thin`, and `a` is the one that puts its cells farthest apart, so they spread evenly: thin = 10 gives the squares
 * of side sqrt 10 along (3, -1) and (1, 3). The other points join the nearest disc of their surface, so nothing is
 * lost; where a surface has none in reach, its point becomes one. */

/* Squared length of the lattice's shortest step; after `thin` rows the lattice repeats. */
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

/* How far the lattice's nearest cell may be, in cells along x or y. Counted for each thin up to LMB_MAX_THIN: steps are
 * 0.81 sqrt thin or longer, and no cell is farther than 0.71 sqrt thin from one; this is sqrt thin, rounded up. */
static int32_t lattice_reach(int32_t thin)
{
    int32_t reach = 1;
    while (reach * reach < thin) {
        ++reach;
    }
    return reach;
}

/* On p's surface? The normals agree, and a chord of a surface that turns by 25 degrees leaves its plane by no more. */
static int is_same_surface(const lmb_point *p, const lmb_point *q)
{
    lmb_vec3 away = sub3(q->position, p->position);
    return dot3(p->normal, q->normal) >= COS_25 && absf(dot3(p->normal, away)) <= SIN_25 * length3(away);
}

/* The nearest disc (a point that links to itself) of point i's surface, or i. */
static uint32_t nearest_disc(const neighbourhood *n, uint32_t i, int32_t reach)
{
    const lmb_point *p = &n->points->data[i];
    uint32_t nearest = i;
    float least = 0.0f;
    for (int32_t y = maxi(p->cell_y - reach, 0); y <= mini(p->cell_y + reach, (int32_t)n->side - 1); ++y) {
        uint32_t begin, end;
        cell_run(&begin, &end, n, p->cell_x, y, reach);
        for (uint32_t j = begin; j < end; ++j) {
            const lmb_point *q = &n->points->data[j];
            if (q->link == j && is_same_surface(p, q)) {
                const float d = length3(sub3(q->position, p->position));
                if (nearest == i || d < least) {
                    nearest = j;
                    least = d;
                }
            }
        }
    }
    return nearest;
}

/* Every point chooses first, from where the points are; then they join. */
static void thin_out(const neighbourhood *n, uint32_t first, int32_t thin)
{
    const int32_t a = lattice_of(thin), reach = lattice_reach(thin);
    lmb_point *data = n->points->data;
    const uint32_t count = n->points->count;
    for (uint32_t i = first; i < count; ++i) {
        data[i].link = (data[i].cell_x + a * data[i].cell_y) % thin == 0 ? i : LMB_NOBODY;
    }
    for (uint32_t i = first; i < count; ++i) {
        data[i].link = data[i].link == i ? i : nearest_disc(n, i, reach);
    }
    for (uint32_t i = first; i < count; ++i) {
        if (data[i].link != i) {
            join_point(&data[data[i].link], &data[i]);
        }
    }
}

/* Close the gaps that joined points leave, and tell their texels. Links: a disc's is its own number, a joined point's
 * that of the disc, or of a point that has joined one in turn (thinned out first, then near another disc). */
static void close_gaps(lmb_points *points, uint32_t first, const lmb_light_map *map)
{
    lmb_point *data = points->data;
    const uint32_t texels = points->owner != NULL ? (uint32_t)map->size * (uint32_t)map->size : 0;
    uint32_t kept = first;
    for (uint32_t i = first; i < points->count; ++i) {
        data[i].link = data[data[i].link].link;
    }
    for (uint32_t i = first; i < points->count; ++i) {
        data[i].link = data[i].link == i ? KEPT | kept++ : data[i].link;
    }
    for (uint32_t t = points->owner_count - texels; t < points->owner_count; ++t) {
        uint32_t *owner = &points->owner[t];
        if (*owner != LMB_NOBODY) {
            const uint32_t link = data[*owner].link;
            *owner = (link & KEPT ? link : data[link].link) & ~KEPT;
        }
    }
    kept = first;
    for (uint32_t i = first; i < points->count; ++i) {
        if (data[i].link & KEPT) {
            data[kept++] = data[i];
        }
    }
    points->count = kept;
}

/* Were the points collected by blocks of this size? Their cells say where the last one ends. */
static int has_cells(const lmb_points *points, const lmb_light_map *map, int32_t block)
{
    const uint32_t side = block > 0 && block <= LMB_TILE ? (uint32_t)(map->size / block) : 0;
    return side > 0 && side * side < points->cell_cap && points->cells[side * side] == points->count;
}

lmb_status lmb_discs_join(lmb_points *points, const lmb_light_map *map, const lmb_grouping *grouping)
{
    neighbourhood n;
    const int32_t thin = grouping != NULL ? grouping->thin : 0,
                  block = grouping != NULL && grouping->block != 0 ? grouping->block : LMB_TILE;
    if (points == NULL || map == NULL || points->faces == 0 || thin < 0 || thin > LMB_MAX_THIN ||
        !has_cells(points, map, block)) {
        return LMB_ERR_ARG;
    }
    n.points = points;
    n.side = (uint32_t)(map->size / block);
    n.face = points->faces;
    n.threshold = grouping != NULL ? grouping->neighbour_m : 0.0f;
    n.join = grouping != NULL && grouping->join > 0.0f ? grouping->join : 0.5f;
    n.hemisphere = grouping != NULL && (grouping->flags & LMB_NEAR_HEMISPHERE) != 0;
    const uint32_t first = points->cells[0];
    for (uint32_t i = first; i < points->count; ++i) {
        points->data[i].distance = mean_distance(&n, i);
        points->data[i].link = i;
    }
    if (thin > 1) {
        thin_out(&n, first, thin);
    }
    for (uint32_t i = first; i < points->count; ++i) {
        if (points->data[i].link == i) {
            join_neighbours(&n, i);
        }
    }
    close_gaps(points, first, map);
    return LMB_OK;
}
