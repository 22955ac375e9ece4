/* plane_mesh.c: the real scene as square cells of planes and of other measured points. Layer 6.               [M4] */
#include <string.h>

#include "../base/memory_check.h"
#include "planes.h"

#if LMB_MIXED

#define MIN_CELL_COSINE 0.25f /* min cosine at which a cell's mean normal is used */
#define MAX_DEPTH_SHARE 0.15f /* max depth difference between a cell's corner and middle, as a share of the distance */

enum { CELL_FLOATS = 12, CELL_COLOURS = 16, CELL_INDICES = 6 };

static int32_t cells_of_side(int32_t size, int32_t step) { return (size + step - 1) / step; }

size_t lmb_real_mesh_bytes(int32_t width, int32_t height, int32_t step)
{
    if (lmb_cloud_bytes(width, height) == 0 || step < 1 || step > 64) {
        return 0;
    }
    const size_t cells = (size_t)cells_of_side(width, step) * (size_t)cells_of_side(height, step);
    const size_t each =
        CELL_FLOATS * sizeof(float) + CELL_COLOURS + CELL_INDICES * sizeof(uint32_t) + sizeof(int32_t) + 4;
    return cells > (size_t)-1 / each ? 0 : cells * each; /* 32-bit targets */
}

/* --- one cell ----------------------------------------------------------------------------------------------------- */

/* Pixels x0 .. x1 - 1 by y0 .. y1 - 1. */
typedef struct cell_box {
    int32_t x0, y0, x1, y1;
} cell_box;

static cell_box box_of_cell(const lmb_pinhole *c, int32_t step, int32_t i, int32_t j)
{
    const cell_box b = {i * step, j * step, mini((i + 1) * step, c->width), mini((j + 1) * step, c->height)};
    return b;
}

/* The most common label of the cell, if it is a plane and covers half of the pixels; else 0. */
static uint8_t plane_of_cell(const lmb_planes *planes, const lmb_pinhole *c, cell_box b)
{
    int32_t count[LMB_MAX_PLANES + 1] = {0}, best = 0;
    for (int32_t y = b.y0; y < b.y1; ++y) {
        for (int32_t x = b.x0; x < b.x1; ++x) {
            const int32_t label = planes->label[y * c->width + x];
            ++count[label];
            best = label != 0 && (best == 0 || count[label] > count[best]) ? label : best;
        }
    }
    return 2 * count[best] >= (b.x1 - b.x0) * (b.y1 - b.y0) ? (uint8_t)best : 0;
}

/* Mean of points without a plane: the one nearest to the middle, and those at about the same distance. */
typedef struct mean {
    float q;
    lmb_vec3 normal;
    int32_t count;
} mean;

static void add_point(mean *m, const lmb_cloud *cloud, int32_t at, float nearest)
{
    const float q = cloud->inverse[at];
    if (q > 0.0f && absf(q - nearest) <= 4.0f * lmb_cloud_sigma(cloud, nearest) + 0.02f * nearest) {
        m->q += q;
        m->normal = add3(m->normal, cloud->normal[at]);
        ++m->count;
    }
}

static float middle_inverse(const lmb_planes *planes, const lmb_cloud *cloud, cell_box b)
{
    float best = 0.0f;
    int32_t min = 0x7fffffff;
    for (int32_t y = b.y0; y < b.y1; ++y) {
        for (int32_t x = b.x0; x < b.x1; ++x) {
            const int32_t at = y * cloud->camera.width + x;
            const int32_t i = 2 * x + 1 - b.x0 - b.x1, j = 2 * y + 1 - b.y0 - b.y1, far = i * i + j * j;
            if (planes->label[at] == 0 && cloud->inverse[at] > 0.0f && far < min) {
                min = far;
                best = cloud->inverse[at];
            }
        }
    }
    return best;
}

static mean mean_of_cell(const lmb_planes *planes, const lmb_cloud *cloud, cell_box b)
{
    mean m = {0.0f, {0, 0, 0}, 0};
    const float nearest = middle_inverse(planes, cloud, b);
    for (int32_t y = b.y0; y < b.y1 && nearest > 0.0f; ++y) {
        for (int32_t x = b.x0; x < b.x1; ++x) {
            const int32_t at = y * cloud->camera.width + x;
            if (planes->label[at] == 0) {
                add_point(&m, cloud, at, nearest);
            }
        }
    }
    m.q = m.count > 0 ? m.q / (float)m.count : 0.0f;
    m.normal = normalize3(m.normal);
    return m;
}

/* Plane through a mean point, with the mean normal. If the normal is unknown or edge-on, the plane faces the camera. */
static void mean_slope(float slope[3], const mean *m, const lmb_pinhole *c, cell_box b)
{
    const lmb_vec3 ray = lmb_cloud_ray(c, 0.5f * (float)(b.x0 + b.x1 - 1), 0.5f * (float)(b.y0 + b.y1 - 1));
    const float facing = dot3(m->normal, ray), scale = facing != 0.0f ? m->q / facing : 0.0f;
    slope[0] = m->normal.x * scale;
    slope[1] = m->normal.y * scale;
    slope[2] = -m->normal.z * scale;
    const float reach = 0.5f * (absf(slope[0]) * (float)(b.x1 - b.x0) / c->fx +
                                absf(slope[1]) * (float)(b.y1 - b.y0) / c->fy);
    if (facing > -MIN_CELL_COSINE * length3(ray) || reach > MAX_DEPTH_SHARE * m->q) {
        slope[0] = slope[1] = 0.0f;
        slope[2] = m->q;
    }
}

/* --- the mesh ----------------------------------------------------------------------------------------------------- */

/* Inputs of the mesh. */
typedef struct mesh_maker {
    const lmb_cloud *cloud;
    const lmb_planes *planes;
    const lmb_axes *axes;
} mesh_maker;

/* Range of inverse distances of a label's pixels. */
typedef struct mesh_span {
    float low, high;
} mesh_span;

static void add_span(mesh_span *s, const mesh_maker *m, cell_box b, uint8_t label)
{
    for (int32_t y = b.y0; y < b.y1; ++y) {
        for (int32_t x = b.x0; x < b.x1; ++x) {
            const int32_t at = y * m->cloud->camera.width + x;
            const float q = m->cloud->inverse[at];
            if (m->planes->label[at] == label && q > 0.0f) {
                s->low = minf(s->low, q);
                s->high = maxf(s->high, q);
            }
        }
    }
}

/* At a grazing angle a plane's depth changes fast between its last pixel and the corner of a cell. The corner is
 * clamped to the pixels of all cells that meet there. All these cells use the same pixels, so no gap opens. */
static float near_plane_pixels(float inverse, const mesh_maker *m, int32_t step, int32_t x, int32_t y, uint8_t label)
{
    const lmb_pinhole *c = &m->cloud->camera;
    const int32_t i = cells_of_side(x, step), j = cells_of_side(y, step);
    const cell_box around = {maxi(i - 1, 0) * step, maxi(j - 1, 0) * step, mini((i + 1) * step, c->width),
                             mini((j + 1) * step, c->height)};
    mesh_span s = {1e30f, 0.0f};
    add_span(&s, m, around, label);
    return s.high > 0.0f ? clampf(inverse, (1.0f - MAX_DEPTH_SHARE) * s.low, (1.0f + MAX_DEPTH_SHARE) * s.high)
                         : inverse;
}

/* Writes a cell with corners at pixel corners, counter-clockwise as seen by the camera. */
static void put_mesh_cell(lmb_real_mesh *out, const mesh_maker *m, const float slope[3], cell_box b, uint8_t label)
{
    const int32_t xs[4] = {b.x0, b.x0, b.x1, b.x1}, ys[4] = {b.y0, b.y1, b.y1, b.y0};
    float *at = out->positions + (size_t)CELL_FLOATS * (size_t)out->count;
    static const uint32_t corner[CELL_INDICES] = {0, 1, 2, 0, 2, 3};
    for (int32_t k = 0; k < 4; ++k) {
        const lmb_vec3 ray = lmb_cloud_ray(&m->cloud->camera, (float)xs[k] - 0.5f, (float)ys[k] - 0.5f);
        const float inverse =
            maxf(near_plane_pixels(plane_inverse(slope, ray.x, ray.y), m, out->step, xs[k], ys[k], label), 1e-3f);
        const lmb_vec3 p = lmb_axes_turn(m->axes, mul3(ray, 1.0f / inverse));
        at[3 * k] = p.x;
        at[3 * k + 1] = p.y;
        at[3 * k + 2] = p.z;
    }
    for (int32_t k = 0; k < CELL_INDICES; ++k) {
        out->indices[CELL_INDICES * out->count + k] = 4 * (uint32_t)out->count + corner[k];
    }
    memset(out->colours + (size_t)CELL_COLOURS * (size_t)out->count, 255, CELL_COLOURS);
    out->label[out->count] = label;
    if (label != 0 && out->plane_cell[label - 1] < 0) {
        out->plane_cell[label - 1] = out->count;
    }
    ++out->count;
}

static void build_cell(lmb_real_mesh *out, const mesh_maker *from, int32_t i, int32_t j)
{
    const lmb_pinhole *c = &from->cloud->camera;
    const cell_box b = box_of_cell(c, out->step, i, j);
    const uint8_t label = plane_of_cell(from->planes, c, b);
    out->cell[j * out->columns + i] = -1;
    if (label != 0) {
        out->cell[j * out->columns + i] = out->count;
        put_mesh_cell(out, from, from->planes->plane[label - 1].slope, b, label);
        return;
    }
    const mean m = mean_of_cell(from->planes, from->cloud, b);
    if (4 * m.count >= (b.x1 - b.x0) * (b.y1 - b.y0)) {
        float slope[3];
        mean_slope(slope, &m, c, b);
        out->cell[j * out->columns + i] = out->count;
        put_mesh_cell(out, from, slope, b, 0);
    }
}

lmb_status lmb_real_mesh_build(lmb_real_mesh *out, const lmb_cloud *cloud, const lmb_planes *planes, int32_t step,
                               const lmb_axes *axes, void *memory, size_t bytes)
{
    const mesh_maker from = {cloud, planes, axes};
    if (out == NULL || axes == NULL || cloud == NULL || planes == NULL || cloud->inverse == NULL ||
        planes->label == NULL || step < 1 || step > 64) {
        return LMB_ERR_ARG;
    }
    const lmb_pinhole *c = &cloud->camera;
    const lmb_status status = check_memory(memory, bytes, lmb_real_mesh_bytes(c->width, c->height, step));
    if (status != LMB_OK) {
        return status;
    }
    out->step = step;
    out->columns = cells_of_side(c->width, step);
    out->rows = cells_of_side(c->height, step);
    out->count = 0;
    const size_t cells = (size_t)out->columns * (size_t)out->rows;
    out->positions = (float *)memory;
    out->indices = (uint32_t *)(void *)(out->positions + CELL_FLOATS * cells);
    out->cell = (int32_t *)(out->indices + CELL_INDICES * cells);
    out->colours = (uint8_t *)(out->cell + cells);
    out->label = out->colours + CELL_COLOURS * cells;
    for (int32_t p = 0; p < LMB_MAX_PLANES; ++p) {
        out->plane_cell[p] = -1;
    }
    for (int32_t j = 0; j < out->rows; ++j) {
        for (int32_t i = 0; i < out->columns; ++i) {
            build_cell(out, &from, i, j);
        }
    }
    return LMB_OK;
}

lmb_mesh lmb_real_mesh_draw(const lmb_real_mesh *mesh)
{
    lmb_mesh m;
    memset(&m, 0, sizeof m);
    if (mesh == NULL) {
        return m;
    }
    m.positions = mesh->positions;
    m.colours = mesh->colours;
    m.indices = mesh->indices;
    m.vertex_count = 4 * (uint32_t)mesh->count;
    m.triangle_count = 2 * (uint32_t)mesh->count;
    m.index_format = LMB_INDEX_U32;
    return m;
}

void lmb_real_mesh_colour(const lmb_real_mesh *mesh, int32_t c, const float albedo[3])
{
    if (mesh == NULL || albedo == NULL || c < 0 || c >= mesh->count) {
        return;
    }
    for (int32_t k = 0; k < CELL_COLOURS; ++k) {
        const float a = k % 4 == 3 ? 1.0f : clampf(albedo[k % 4], 0.0f, 1.0f);
        mesh->colours[CELL_COLOURS * c + k] = (uint8_t)(a * 255.0f + 0.5f);
    }
}

#endif
