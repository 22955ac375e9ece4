/* gouraud.h: frames for the smallest processors: light at the corners of the triangles that a transfer's baker divided
 * surfaces into, interpolated between them; RGB565, 16-bit depth, no binary64, no kernels, integers along rows.
 *
 *     lmb_gouraud_map(..)      the shadow map of each light
 *     lmb_transfer_clear, lmb_transfer_collect, lmb_transfer_send, lmb_transfer_receivers: bounced light
 *     lmb_gouraud_begin(..)    clears the picture
 *     lmb_gouraud_draw(..)     triangles, in pieces of any size
 *
 * Compared with lmb_render_frame, shadows are as sharp as corners are close; textures are replaced by their mean
 * colour; normal maps, holes and lobes are ignored. Pixels are the same on every target.
 *
 * Stability: experimental. */
#ifndef LMB_GOURAUD_H
#define LMB_GOURAUD_H

#include "transfer.h"

enum {
    LMB_GOURAUD_MAX_SIDE = 512, /* px of a picture's side, texels of a map's */
    LMB_GOURAUD_KEPT = 64       /* cached corners of a mesh that are not transformed again */
};

/* Scratch: 7 KiB. The contents are private to the library. */
typedef struct lmb_gouraud_scratch {
    uint32_t part[LMB_TRANSFER_MAX_HALVINGS + 1][17];
    uint32_t corner[LMB_GOURAUD_KEPT][16];
} lmb_gouraud_scratch;

/* A frame, and your memory for it. Set members that you do not use to 0. */
typedef struct lmb_gouraud {
    const lmb_scene *scene;          /* checked */
    const lmb_transfer *transfer;    /* opened, and baked from the scene */
    const lmb_transfer_light *light; /* after lmb_transfer_receivers */
    const lmb_shadow_map *maps;      /* one a light, from lmb_gouraud_map; NULL: no direct light */
    float (*direct)[3];              /* per receiver: direct light */
    lmb_gouraud_scratch *scratch;
    lmb_view view;                   /* the frame is the picture */
    lmb_surface out;                 /* LMB_RGB565 */
    uint16_t *depth;                 /* per pixel, row by row: larger is nearer, 0 is nothing */
    float exposure_ev;
} lmb_gouraud;

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_gouraud_map: clear and draw a shadow map, of triangles that face the light or are double-sided.
 *
 *   map  from lmb_shadow_map_init, of up to LMB_GOURAUD_MAX_SIDE texels, with 16- or 32-bit ids. Its surfaces become
 *        LMB_LINEAR.
 * Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_gouraud_map(lmb_shadow_map *map, lmb_gouraud_scratch *scratch, const lmb_scene *scene);

/* lmb_gouraud_begin: clear picture, depth and the receivers' direct light. Returns LMB_OK; LMB_ERR_ARG; LMB_ERR_FORMAT
 * (not RGB565); or LMB_ERR_CAPACITY (over LMB_GOURAUD_MAX_SIDE). */
lmb_status lmb_gouraud_begin(const lmb_gouraud *frame);

/* lmb_gouraud_draw: draw triangles first_id .. first_id + count - 1 of the scene that lmb_gouraud_begin accepted.
 * Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_gouraud_draw(const lmb_gouraud *frame, uint32_t first_id, uint32_t count);

#ifdef __cplusplus
}
#endif
#endif
