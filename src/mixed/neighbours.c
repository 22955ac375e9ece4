/* neighbours.c: the points nearest to one: a picture's on its own grid, others by cells of space. Layer 6.     [M3] */
#include <string.h>

#include "../base/memory_check.h"
#include "../base/vec.h"
#include "cloud.h"

#if LMB_MIXED

/* The k nearest so far, the nearest first, of equals the lower number. */
typedef struct nearest {
    float d2[LMB_NEAREST_CAP];
    uint32_t which[LMB_NEAREST_CAP];
    int32_t k, count;
} nearest;

static int goes_before(const nearest *n, int32_t i, uint32_t which, float d2)
{
    return d2 < n->d2[i] || (d2 == n->d2[i] && which < n->which[i]);
}

static void take(nearest *n, uint32_t which, float d2)
{
    int32_t i = n->count < n->k ? n->count : n->k - 1;
    if (n->count == n->k && !goes_before(n, i, which, d2)) {
        return;
    }
    for (; i > 0 && goes_before(n, i - 1, which, d2); --i) {
        n->d2[i] = n->d2[i - 1];
        n->which[i] = n->which[i - 1];
    }
    n->d2[i] = d2;
    n->which[i] = which;
    n->count += n->count < n->k;
}

static float distance2(lmb_vec3 a, lmb_vec3 b)
{
    const lmb_vec3 d = sub3(a, b);
    return dot3(d, d);
}

/* --- on the picture's grid ---------------------------------------------------------------------------------------- */

int32_t lmb_cloud_nearest(int32_t *out, int32_t k, const lmb_cloud *cloud, int32_t x, int32_t y)
{
    nearest n = {{0}, {0}, mini(k, LMB_NEAREST_CAP), 0};
    if (out == NULL || n.k < 1 || !is_measured(cloud, x, y)) {
        return 0;
    }
    const int32_t w = cloud->camera.width, h = cloud->camera.height;
    const lmb_vec3 at = lmb_cloud_point(cloud, x, y);
    for (int32_t j = maxi(y - 2, 0); j <= mini(y + 2, h - 1); ++j) {
        for (int32_t i = maxi(x - 2, 0); i <= mini(x + 2, w - 1); ++i) {
            if ((i != x || j != y) && cloud->inverse[(size_t)j * (size_t)w + (size_t)i] > 0.0f) {
                take(&n, (uint32_t)(j * w + i), distance2(lmb_cloud_point(cloud, i, j), at));
            }
        }
    }
    for (int32_t i = 0; i < n.count; ++i) {
        out[i] = (int32_t)n.which[i];
    }
    return n.count;
}

/* --- in cells of space -------------------------------------------------------------------------------------------- */

enum { CELLS = LMB_POINT_CELLS * LMB_POINT_CELLS * LMB_POINT_CELLS };

size_t lmb_point_grid_bytes(uint32_t count)
{
    return count > 0x10000000u ? 0 : (CELLS + 1 + (size_t)count) * sizeof(uint32_t);
}

static int is_point(lmb_vec3 p) { return is_sane(p.x) && is_sane(p.y) && is_sane(p.z); }

static int32_t cell_along(float v, float low, float cell)
{
    return (int32_t)clampf((v - low) / cell, 0.0f, (float)(LMB_POINT_CELLS - 1));
}

static uint32_t cell_of(const lmb_point_grid *g, lmb_vec3 p)
{
    const int32_t x = cell_along(p.x, g->low.x, g->cell), y = cell_along(p.y, g->low.y, g->cell),
                  z = cell_along(p.z, g->low.z, g->cell);
    return (uint32_t)((z * LMB_POINT_CELLS + y) * LMB_POINT_CELLS + x);
}

static void fit_cells(lmb_point_grid *g, uint32_t count)
{
    lmb_vec3 low = vec3(0, 0, 0), high = low;
    g->count = 0;
    for (uint32_t i = 0; i < count; ++i) {
        if (is_point(g->point[i])) {
            low = g->count == 0 ? g->point[i] : min3(low, g->point[i]);
            high = g->count == 0 ? g->point[i] : max3(high, g->point[i]);
            ++g->count;
        }
    }
    g->low = low;
    g->cell = maxf(largest3(sub3(high, low)) / (float)LMB_POINT_CELLS, 1e-6f);
}

/* Counts the points of each cell, then puts them there: first[c + 1] is where cell c's next point goes, and in the end
 * where the cell ends. */
static void sort_points(lmb_point_grid *g, uint32_t count)
{
    uint32_t sum = 0;
    memset(g->first, 0, (CELLS + 1) * sizeof *g->first);
    for (uint32_t i = 0; i < count; ++i) {
        if (is_point(g->point[i])) {
            ++g->first[cell_of(g, g->point[i]) + 1];
        }
    }
    for (uint32_t c = 1; c <= CELLS; ++c) {
        const uint32_t n = g->first[c];
        g->first[c] = sum;
        sum += n;
    }
    for (uint32_t i = 0; i < count; ++i) {
        if (is_point(g->point[i])) {
            g->order[g->first[cell_of(g, g->point[i]) + 1]++] = i;
        }
    }
}

lmb_status lmb_point_grid_init(lmb_point_grid *out, const lmb_vec3 *points, uint32_t count, void *memory, size_t bytes)
{
    if (out == NULL || (points == NULL && count > 0)) {
        return LMB_ERR_ARG;
    }
    const lmb_status status = check_memory(memory, bytes, lmb_point_grid_bytes(count));
    if (status != LMB_OK) {
        return status;
    }
    out->point = points;
    out->first = (uint32_t *)memory;
    out->order = out->first + CELLS + 1;
    fit_cells(out, count);
    sort_points(out, count);
    return LMB_OK;
}

static void search_cell(nearest *n, const lmb_point_grid *g, const int32_t c[3], lmb_vec3 at)
{
    const int32_t cell = (c[2] * LMB_POINT_CELLS + c[1]) * LMB_POINT_CELLS + c[0];
    for (uint32_t i = g->first[cell]; i < g->first[cell + 1]; ++i) {
        take(n, g->order[i], distance2(g->point[g->order[i]], at));
    }
}

/* The cells `ring` steps away from the middle one, in the greatest of the three axes. */
static void search_ring(nearest *n, const lmb_point_grid *g, const int32_t middle[3], int32_t ring, lmb_vec3 at)
{
    int32_t c[3];
    for (c[2] = maxi(middle[2] - ring, 0); c[2] <= mini(middle[2] + ring, LMB_POINT_CELLS - 1); ++c[2]) {
        const int side_z = c[2] == middle[2] - ring || c[2] == middle[2] + ring;
        for (c[1] = maxi(middle[1] - ring, 0); c[1] <= mini(middle[1] + ring, LMB_POINT_CELLS - 1); ++c[1]) {
            const int side = side_z || c[1] == middle[1] - ring || c[1] == middle[1] + ring;
            for (c[0] = middle[0] - ring; c[0] <= middle[0] + ring; c[0] += side || ring == 0 ? 1 : 2 * ring) {
                if (c[0] >= 0 && c[0] < LMB_POINT_CELLS) {
                    search_cell(n, g, c, at);
                }
            }
        }
    }
}

/* What lies beyond ring r is farther than r cells from a place in the middle cell; a place outside all cells is that
 * much farther still, so the bound holds for it too. */
int32_t lmb_point_grid_nearest(uint32_t *out, int32_t k, const lmb_point_grid *grid, lmb_vec3 at)
{
    nearest n = {{0}, {0}, mini(k, LMB_NEAREST_CAP), 0};
    if (out == NULL || grid == NULL || grid->first == NULL || n.k < 1 || !is_point(at)) {
        return 0;
    }
    const int32_t middle[3] = {cell_along(at.x, grid->low.x, grid->cell), cell_along(at.y, grid->low.y, grid->cell),
                               cell_along(at.z, grid->low.z, grid->cell)};
    for (int32_t ring = 0; ring < LMB_POINT_CELLS; ++ring) {
        const float safe = (float)(ring - 1) * grid->cell;
        if (n.count == n.k && ring > 0 && safe * safe > n.d2[n.k - 1]) {
            break;
        }
        search_ring(&n, grid, middle, ring, at);
    }
    for (int32_t i = 0; i < n.count; ++i) {
        out[i] = n.which[i];
    }
    return n.count;
}

#endif
