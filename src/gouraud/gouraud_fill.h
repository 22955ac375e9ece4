/* gouraud_fill.h: a triangle with colours at its corners into a picture, or its id into a map. Layer 10. */
#ifndef LMB_GOURAUD_FILL_H
#define LMB_GOURAUD_FILL_H

#include <lambent/gouraud.h>

#include "../base/vec.h"

/* Where triangles go: a picture where `pixel` is, else a map. Rows follow one another. */
typedef struct gouraud_target {
    uint16_t *pixel, *depth16;
    float *depth;
    void *id;
    int32_t id_format;
    int32_t width, height;
    int32_t pixel_step, step; /* from row to row: of pixels, and of all others */
    float half[2], middle[2]; /* lmb_gouraud_size's: of the frame, 1/16 px; the middle with what GOURAUD_BIAS says */
} gouraud_target;

/* Added to coordinates, so that cutting their fraction off rounds them down. A half is for the nearest. */
enum { GOURAUD_BIAS = 16384 };

/* How the world, or a mesh, lies before a view, as in raster/draw.c; x and y in parts of the frame's half. */
typedef struct gouraud_view {
    float row[3][4];
    float near_m, far_m, depth_scale;
    int is_far; /* orthographic */
} gouraud_view;

/* Outside the near plane, left, right, top, bottom; of what is never drawn all. */
enum { GOURAUD_OUTSIDE = 31, GOURAUD_GUARD = 2 /* times the frame, which coordinates keep within */ };

/* Before the division. */
typedef struct gouraud_point {
    float x, y, z, w;
    float colour[3]; /* sRGB codes, 0 .. 255 */
} gouraud_point;

/* On the target: 1/16 px from its upper left corner. */
typedef struct gouraud_corner {
    int32_t x, y;
    float d;
    float colour[3];
} gouraud_corner;

void lmb_gouraud_size(gouraud_target *t, int32_t width, int32_t height);
void lmb_gouraud_view_of(gouraud_view *out, const lmb_view *v, const lmb_mat4 *to_world);

/* Rows of positions, from here on of numbers that scale and offset make positions of. */
void lmb_gouraud_scale(float rows[3][4], lmb_vec3 scale, lmb_vec3 offset);

/* What a point that is not within all bounds is outside of. */
uint32_t lmb_gouraud_outside(const gouraud_point *p);

static inline float gouraud_along(const float row[4], lmb_vec3 p)
{
    return row[0] * p.x + row[1] * p.y + row[2] * p.z + row[3];
}

/* All but its colour; returns what it is outside of. */
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

/* The place of a point that is outside of nothing; and all of it. */
static inline void gouraud_point_of(int32_t *x, int32_t *y, float *d, const gouraud_target *t, const gouraud_point *p)
{
    const float inverse = 1.0f / p->w;
    *x = (int32_t)(p->x * inverse * t->half[0] + t->middle[0]) - GOURAUD_BIAS;
    *y = (int32_t)(t->middle[1] - p->y * inverse * t->half[1]) - GOURAUD_BIAS;
    *d = p->z * inverse; /* at most 1: raster/setup.c */
}
gouraud_corner lmb_gouraud_place(const gouraud_target *t, const gouraud_point *p);

/* How: colours mixed; that of the first corner; or mixed, and grown by a sixteenth of a pixel: halves of an edge lie on
 * the whole one only as well as corners are placed, and no gap may show between them. */
enum { GOURAUD_MIXED, GOURAUD_FLAT, GOURAUD_GROWN };

/* A triangle that is outside of nothing; and one that may be, `any`: of what its corners are outside. */
void lmb_gouraud_fill(const gouraud_target *t, const gouraud_corner c[3], uint32_t id, int how);
void lmb_gouraud_clip(const gouraud_target *t, const gouraud_point p[3], uint32_t any, uint32_t id, int how);

#endif
