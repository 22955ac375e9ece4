/* discs.c: first points -> discs: mean neighbour distances, and points much closer than that join. Floor 6.
 *                                                                                              [V8 V9 V11 V12 V15]
 * Neighbours are looked up in map space: the points of the eight cells around and of the own one. */
#include <lambent/bounce.h>

#include "../base/vec.h"

#define COS_25 0.90630779f
#define JOINED 0xffffffffu /* link of a point that has become part of a disc */

typedef struct neighbourhood {
    lmb_points *points;
    uint32_t side, face;
    float threshold, join;
} neighbourhood;

/* Points of the cells around cell (x, y): calls one row of three cells a run, since rows are contiguous. */
static void cell_run(uint32_t *begin, uint32_t *end, const neighbourhood *n, int32_t x, int32_t y)
{
    int32_t x0 = maxi(x - 1, 0), x1 = mini(x + 1, (int32_t)n->side - 1);
    *begin = n->points->cells[(uint32_t)y * n->side + (uint32_t)x0];
    *end = n->points->cells[(uint32_t)y * n->side + (uint32_t)x1 + 1];
}

/* [V8]: the mean over neighbours that face the same way and lie within the threshold [V9]; else the quad's own size. */
static float mean_distance(const neighbourhood *n, uint32_t i)
{
    const lmb_point *p = &n->points->data[i];
    float sum = 0.0f;
    uint32_t count = 0;
    for (int32_t y = maxi(p->cell_y - 1, 0); y <= mini(p->cell_y + 1, (int32_t)n->side - 1); ++y) {
        uint32_t begin, end;
        cell_run(&begin, &end, n, p->cell_x, y);
        for (uint32_t j = begin; j < end; ++j) {
            const lmb_point *q = &n->points->data[j];
            float d = length3(sub3(p->position, q->position));
            if (j != i && dot3(p->normal, q->normal) >= COS_25 && (n->threshold <= 0.0f || d <= n->threshold)) {
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
        cell_run(&begin, &end, n, at.cell_x, y);
        for (uint32_t j = begin > i ? begin : i + 1; j < end; ++j) {
            lmb_point *q = &n->points->data[j];
            if (q->link != JOINED && dot3(at.normal, q->normal) >= COS_25 &&
                length3(sub3(at.position, q->position)) < n->join * at.distance) {
                join_point(p, q);
                q->link = JOINED;
            }
        }
    }
}

lmb_status lmb_discs_join(lmb_points *points, const lmb_light_map *map, const lmb_grouping *grouping)
{
    neighbourhood n;
    if (points == NULL || map == NULL || points->faces == 0) {
        return LMB_ERR_ARG;
    }
    int32_t block = grouping != NULL && grouping->block != 0 ? grouping->block : LMB_TILE;
    n.points = points;
    n.side = (uint32_t)(map->size / block);
    n.face = points->faces;
    n.threshold = grouping != NULL ? grouping->neighbour_m : 0.0f;
    n.join = grouping != NULL && grouping->join > 0.0f ? grouping->join : 0.5f;
    uint32_t first = points->cells[0], kept = first;
    for (uint32_t i = first; i < points->count; ++i) {
        points->data[i].distance = mean_distance(&n, i);
        points->data[i].link = 0;
    }
    for (uint32_t i = first; i < points->count; ++i) {
        if (points->data[i].link != JOINED) {
            join_neighbours(&n, i);
        }
    }
    for (uint32_t i = first; i < points->count; ++i) {
        if (points->data[i].link != JOINED) {
            points->data[kept++] = points->data[i];
        }
    }
    points->count = kept;
    return LMB_OK;
}
