/* gouraud_fill.h: a triangle with colours at its corners into a picture, or the id into a map. Layer 8. */
#ifndef LMB_GOURAUD_FILL_H
#define LMB_GOURAUD_FILL_H

#include <lambent/gouraud.h>

#include "../base/vec.h"

/* Target of triangles: a picture if `pixel` is set, otherwise a map. Rows are linear. */
typedef struct gouraud_target {
    uint16_t *pixel, *depth16;
    float *depth;
    void *id;
    int32_t id_format;
    int32_t width, height;
    int32_t pixel_step, step; /* from row to row: of pixels, and of the others */
    float half[2], middle[2]; /* set by lmb_gouraud_size: of the frame, 1/16 px; middle includes GOURAUD_BIAS */
} gouraud_target;

/* Added to coordinates so that truncation rounds down. A half more rounds to nearest. */
enum { GOURAUD_BIAS = 16384 };

/* The transform of the world, or of a mesh, to a view, as in raster/draw.c. x and y are relative to half the frame. */
typedef struct gouraud_view {
    float row[3][4];
    float near_m, far_m, depth_scale;
    int is_far; /* orthographic */
} gouraud_view;

/* Bits: outside the near plane, left, right, top, bottom; all of them for points that are never drawn. */
enum { GOURAUD_OUTSIDE = 31, GOURAUD_GUARD = 2 /* times the frame: the range of coordinates */ };

/* Before the division. */
typedef struct gouraud_point {
    float x, y, z, w;
    float colour[3]; /* sRGB codes, 0 .. 255 */
} gouraud_point;

/* On the target: 1/16 px from the upper left corner. */
typedef struct gouraud_corner {
    int32_t x, y;
    float d;
    float colour[3];
} gouraud_corner;

void lmb_gouraud_size(gouraud_target *t, int32_t width, int32_t height);
void lmb_gouraud_view_of(gouraud_view *out, const lmb_view *v, const lmb_mat4 *to_world);

/* Changes rows for positions into rows for stored numbers, with scale and offset. */
void lmb_gouraud_scale(float rows[3][4], lmb_vec3 scale, lmb_vec3 offset);

/* The planes that a point is outside of; for points outside some limit. */
uint32_t lmb_gouraud_outside(const gouraud_point *p);

static inline float gouraud_along(const float row[4], lmb_vec3 p)
{
    return row[0] * p.x + row[1] * p.y + row[2] * p.z + row[3];
}

/* Sets all but the colour. Returns the planes that the point is outside of. */
static inline uint32_t gouraud_project(gouraud_point *out, const gouraud_view *v, lmb_vec3 p)
{
    const float w = gouraud_along(v->row[2], p);
    out->x = gouraud_along(v->row[0], p);
    out->y = gouraud_along(v->row[1], p);
    out->z = v->is_far ? (v->far_m - w) * v->depth_scale : v->near_m;
    out->w = v->is_far ? 1.0f : w;
    const float guard = (float)GOURAUD_GUARD * out->w;
    const int is_inside =
        out->z <= out->w && out->x <= guard && -guard <= out->x && out->y <= guard && -guard <= out->y && out->w < 1e6f;
    return is_inside ? 0 : lmb_gouraud_outside(out);
}

/* The target position of a point inside all planes; lmb_gouraud_place converts colours too. */
static inline void gouraud_point_of(int32_t *x, int32_t *y, float *d, const gouraud_target *t, const gouraud_point *p)
{
    const float inverse = 1.0f / p->w;
    *x = (int32_t)(p->x * inverse * t->half[0] + t->middle[0]) - GOURAUD_BIAS;
    *y = (int32_t)(t->middle[1] - p->y * inverse * t->half[1]) - GOURAUD_BIAS;
    *d = p->z * inverse; /* at most 1: raster/setup.c */
}
gouraud_corner lmb_gouraud_place(const gouraud_target *t, const gouraud_point *p);

/* Fill modes: interpolated colours; the colour of the first corner; interpolated, and grown by a sixteenth of a pixel.
 * Rounding moves the halves of an edge off the whole edge, and no gap may show between them. */
enum { GOURAUD_MIXED, GOURAUD_FLAT, GOURAUD_GROWN };

/* fill: a triangle inside all planes. clip: any triangle; `any`: planes that some corner is outside of. */
void lmb_gouraud_fill(const gouraud_target *t, const gouraud_corner c[3], uint32_t id, int how);
void lmb_gouraud_clip(const gouraud_target *t, const gouraud_point p[3], uint32_t any, uint32_t id, int how);

#endif
