/* laid_out.h: frames of a few settings, each in a block of its own: the last one frees the one before. */
#ifndef TEST_LAID_OUT_H
#define TEST_LAID_OUT_H

#include <lambent/lambent.h>

#include <stdlib.h>
#include <string.h>

#include "test.h"

static lmb_frame frame;
static void *frame_block;

static inline lmb_frame_settings draft_settings(const lmb_scene *scene, lmb_view view)
{
    lmb_frame_settings s;
    memset(&s, 0, sizeof s);
    s.kernels = picked_kernels();
    s.scene = scene;
    s.view = view;
    s.format = LMB_RGB32F;
    s.quality = LMB_QUALITY_DRAFT;
    s.shadow_map = 128;
    return s;
}

static inline void lay_out(const lmb_frame_settings *s)
{
    const size_t bytes = lmb_frame_bytes(s);
    free(frame_block);
    frame_block = malloc(bytes);
    CHECK(bytes > 0 && frame_block != NULL && lmb_frame_init(&frame, s, frame_block, bytes) == LMB_OK);
}

static inline void free_laid_out(void)
{
    free(frame_block);
    frame_block = NULL;
}

#endif
