/* real_tile.c: the photo's surfaces as tiles that can be lit. Layer 6.     [M4] */
#include <string.h>

#include "../raster/tile.h"
#include "planes.h"

#if LMB_MIXED

void lmb_pinhole_round(lmb_pinhole *camera)
{
    if (camera == NULL) {
        return;
    }
    camera->cx = floorf(2.0f * camera->cx + 0.5f) * 0.5f;
    camera->cy = floorf(2.0f * camera->cy + 0.5f) * 0.5f;
}

/* A side of the frame, in pixels, with the optical axis in the middle. The photo starts at *at; both are whole
 * tiles. */
static int32_t frame_side(int32_t *at, float centre, int32_t pixels)
{
    const int32_t size = (pixels + LMB_TILE - 1) / LMB_TILE * LMB_TILE;
    const int32_t twice = (int32_t)floorf(2.0f * centre + 1.5f); /* 2 (centre + 0.5), an integer */
    *at = size > twice ? (size - twice + LMB_TILE - 1) / LMB_TILE * LMB_TILE : 0;
    return 2 * *at + twice;
}

/* Half of the picture's width at 1 m. Extreme focal lengths overflow or underflow binary32. */
static int is_field(float half) { return half > 1e-30f && half < 1e30f; }

lmb_status lmb_photo_view(lmb_view *out, int32_t *x0, int32_t *y0, const lmb_pinhole *camera, const lmb_axes *axes)
{
    if (out == NULL || x0 == NULL || y0 == NULL || camera == NULL || axes == NULL ||
        lmb_cloud_bytes(camera->width, camera->height) == 0 || !(camera->fx > 0.0f) || !(camera->fy > 0.0f) ||
        !(absf(camera->cx) < (float)LMB_MAX_SIDE) || !(absf(camera->cy) < (float)LMB_MAX_SIDE)) {
        return LMB_ERR_ARG;
    }
    memset(out, 0, sizeof *out);
    out->right = axes->right;
    out->up = axes->up;
    out->back = axes->back;
    out->kind = LMB_PERSPECTIVE;
    out->near_m = 0.01f;
    out->far_m = 1000.0f;
    out->frame_width = frame_side(x0, camera->cx, camera->width);
    out->frame_height = frame_side(y0, camera->cy, camera->height);
    out->half_width = 0.5f * (float)out->frame_width / camera->fx;
    out->half_height = 0.5f * (float)out->frame_height / camera->fy;
    return out->frame_width <= LMB_MAX_FRAME && out->frame_height <= LMB_MAX_FRAME && is_field(out->half_width) &&
                   is_field(out->half_height)
               ? LMB_OK
               : LMB_ERR_ARG;
}

/* Corner k of cell c, which lies on the cell's plane. */
static lmb_vec3 cell_corner(const lmb_real_mesh *mesh, int32_t c, int32_t k)
{
    const float *at = mesh->positions + 12 * (size_t)c + 3 * (size_t)k;
    return vec3(at[0], at[1], at[2]);
}

typedef struct surface {
    lmb_vec3 position, face, normal; /* in scene space */
    float depth;
    uint32_t id;
} surface;

/* Inputs of a tile. */
typedef struct tile_maker {
    const lmb_cloud *cloud;
    const lmb_planes *planes;
    const lmb_real_mesh *mesh;
    const lmb_axes *axes;
} tile_maker;

/* Pixels without a plane are moved onto their cell, so that the cell does not shadow those that noise put behind it.
 * Pixels far from the cell, beyond an edge, stay at the measured point. */
static void put_on_cell(surface *s, const tile_maker *m, int32_t c, lmb_vec3 ray, float q)
{
    const lmb_vec3 a = cell_corner(m->mesh, c, 0);
    const lmb_vec3 n = normalize3(cross3(sub3(cell_corner(m->mesh, c, 1), a), sub3(cell_corner(m->mesh, c, 2), a)));
    const float on = dot3(n, ray) / dot3(n, a); /* 1 / distance of the cell's plane */
    if (on > 0.0f && absf(on - q) <= 4.0f * lmb_cloud_sigma(m->cloud, q) + 0.02f * q) {
        s->position = mul3(ray, 1.0f / on);
        s->depth = 1.0f / on;
        s->face = dot3(n, ray) > 0.0f ? mul3(n, -1.0f) : n;
    }
}

static int surface_at(surface *s, const tile_maker *m, int32_t x, int32_t y)
{
    const lmb_pinhole *camera = &m->cloud->camera;
    const int32_t at = y * camera->width + x;
    const lmb_vec3 ray = lmb_axes_turn(m->axes, lmb_cloud_ray(camera, (float)x, (float)y));
    const float q = m->cloud->inverse[at];
    const uint8_t label = m->planes->label[at];
    int32_t c = m->mesh->cell[y / m->mesh->step * m->mesh->columns + x / m->mesh->step];
    if (!(q > 0.0f)) {
        return 0;
    }
    s->depth = 1.0f / q;
    s->position = mul3(ray, s->depth);
    s->normal = lmb_axes_turn(m->axes, m->cloud->normal[at]);
    if (!(dot3(s->normal, ray) < 0.0f)) {
        s->normal = mul3(normalize3(ray), -1.0f);
    }
    s->face = s->normal;
    if (label != 0 && (c < 0 || m->mesh->label[c] != label)) {
        c = m->mesh->plane_cell[label - 1];
    } else if (label == 0 && c >= 0 && m->mesh->label[c] == 0) {
        put_on_cell(s, m, c, ray, q);
        s->normal = dot3(s->normal, s->face) > 0.0f ? s->normal : s->face;
    }
    s->id = c >= 0 ? 1 + 2 * (uint32_t)c : 1;
    return 1;
}

static void put_real_pixel(lmb_tile *out, int32_t k, const surface *s)
{
    tile_set_vec(out->position, k, s->position);
    tile_set_vec(out->face, k, s->face);
    tile_set_vec(out->normal, k, s->normal);
    out->depth[k] = s->depth;
    out->id[k] = s->id;
    ++out->hits;
}

lmb_status lmb_real_tile(lmb_tile *out, const lmb_cloud *cloud, const lmb_planes *planes, const lmb_real_mesh *mesh,
                         const lmb_axes *axes, int32_t x, int32_t y)
{
    const tile_maker m = {cloud, planes, mesh, axes};
    if (out == NULL || axes == NULL || !are_labels(planes, cloud) || mesh == NULL || mesh->cell == NULL || x < 0 ||
        y < 0 || x % LMB_TILE != 0 || y % LMB_TILE != 0 || x >= cloud->camera.width || y >= cloud->camera.height) {
        return LMB_ERR_ARG;
    }
    memset(out, 0, sizeof *out);
    out->x = x;
    out->y = y;
    for (int32_t k = 0; k < LMB_TILE_PIXELS; ++k) {
        surface s;
        const int32_t px = x + k % LMB_TILE, py = y + k / LMB_TILE;
        if (px < cloud->camera.width && py < cloud->camera.height && surface_at(&s, &m, px, py)) {
            put_real_pixel(out, k, &s);
        }
    }
    return LMB_OK;
}

#endif
