/* gouraud_fill.h: a triangle with colours at its corners into a picture, or its id into a map. Layer 10. */
#ifndef LMB_GOURAUD_FILL_H
#define LMB_GOURAUD_FILL_H

#include <lambent/gouraud.h>

/* Where triangles go: a picture where `pixel` is, else a map. Rows follow one another. */
typedef struct gouraud_target {
    uint16_t *pixel, *depth16;
    float *depth;
    void *id;
    int32_t id_format;
    int32_t width, height;
    int32_t pixel_step, step; /* from row to row: of pixels, and of all others */
} gouraud_target;

/* How the world lies before a view, as in raster/draw.c. */
typedef struct gouraud_view {
    float row[3][4];
    float scale_x, scale_y, near_m, far_m, depth_scale;
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

void lmb_gouraud_view_of(gouraud_view *out, const lmb_view *v, const lmb_mat4 *to_world);

/* All but its colour; returns what it is outside of. */
uint32_t lmb_gouraud_project(gouraud_point *out, const gouraud_view *v, lmb_vec3 p);

/* Of a point that is outside of nothing: its place; and all of it. */
void lmb_gouraud_point_of(int32_t *x, int32_t *y, float *d, const gouraud_target *t, const gouraud_point *p);
gouraud_corner lmb_gouraud_place(const gouraud_target *t, const gouraud_point *p);

/* How: colours mixed; that of the first corner; or mixed, and grown by a sixteenth of a pixel: halves of an edge lie on
 * the whole one only as well as corners are placed, and no gap may show between them. */
enum { GOURAUD_MIXED, GOURAUD_FLAT, GOURAUD_GROWN };

/* A triangle that is outside of nothing; and one that may be, `any`: of what its corners are outside. */
void lmb_gouraud_fill(const gouraud_target *t, const gouraud_corner c[3], uint32_t id, int how);
void lmb_gouraud_clip(const gouraud_target *t, const gouraud_point p[3], uint32_t any, uint32_t id, int how);

#endif
