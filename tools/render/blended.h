/* blended.h: draws BLEND materials sorted: every pixel mixes its layers from back to front. */
#ifndef BLENDED_H
#define BLENDED_H

#include <lambent/lambent.h>

#include "../common/workers.h"

enum { BLENDED_MAX_LAYERS = 32 }; /* of a sample; the nearest ones count */

/* Results for all eyes side by side. Only pixels with a mark were drawn sorted. blended_free frees everything. */
typedef struct blended {
    int32_t width, height;
    uint8_t *mark;  /* 0: no layer; BLENDED_SHOWN; with BLENDED_OVER if a sample has more layers than the maximum */
    float *cover;   /* share of the pixel that surfaces cover; a layer covers the share alpha */
    float *unlit;   /* three numbers a pixel: the light of unlit materials in it */
    size_t bytes;   /* most memory that was allocated at one time */
} blended;

enum { BLENDED_SHOWN = 1, BLENDED_OVER = 2 };

#if !defined(OPTIONS_WITHOUT_HELP)

/* blended_is_any: returns whether an instance has a BLEND material. */
int blended_is_any(const lmb_scene *scene);

/* blended_draw: draws the pixels that show BLEND materials again into frame->out, which holds a finished picture of
 * the frame in LMB_RGB32F, linear.
 *
 *   inout  of a picture with this width and height, or zeros before the first eye
 *   x0     the eye's first column in that picture
 * `r` finished the frame, and is as before afterwards. A layer is lit as an opaque surface of its material; alpha
 * weighs its whole light. Layers of equal depth are sorted by id, the smaller one in front. If a sample has more than
 * BLENDED_MAX_LAYERS layers, the farthest are left out.
 * Returns LMB_OK, LMB_ERR_CAPACITY if memory is short, or an error of a stage. */
lmb_status blended_draw(blended *inout, workers *c, int32_t *stage, lmb_render *r, const lmb_frame *frame,
                        int32_t width, int32_t height, int32_t x0);

/* blended_over: the number of pixels from which layers were left out. */
uint32_t blended_over(const blended *b);

void blended_free(blended *b);

#else /* the web page mixes no layers */

static inline int blended_is_any(const lmb_scene *scene) { return scene == NULL; }
static inline lmb_status blended_draw(blended *inout, workers *c, int32_t *stage, lmb_render *r, const lmb_frame *frame,
                                      int32_t width, int32_t height, int32_t x0)
{
    (void)inout, (void)c, (void)stage, (void)r, (void)frame, (void)width, (void)height, (void)x0;
    return LMB_ERR_ARG;
}
static inline uint32_t blended_over(const blended *b) { return b->mark != NULL; }
static inline void blended_free(blended *b) { (void)b; }

#endif
#endif
