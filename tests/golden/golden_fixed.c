/* golden_fixed.c: a small room in integers: visible surfaces, light, and the picture in bands. */
#include "golden_cases.h"

#include <string.h>

#include <lambent/fixed.h>

#include "../small_fixed.h"

enum { ROWS = 20 };

typedef struct fixed_space {
    uint32_t file[SMALL_FIXED_WORDS], memory[6400], pixel[GOLDEN_WIDTH * ROWS];
    uint16_t depth[GOLDEN_WIDTH * ROWS];
    lmb_fixed scene;
    lmb_fixed_frame frame;
} fixed_space;

GOLDEN_FITS(fixed_space, first);

/* The variants of small_fixed_frame. */
uint64_t case_fixed(int variant)
{
    fixed_space *s = golden_first();
    uint64_t h = GOLDEN_START;
    memset(&s->frame, 0, sizeof s->frame);
    lmb_status status = lmb_fixed_open(&s->scene, s->file, small_fixed(s->file));
    status = status != LMB_OK ? status
                              : lmb_fixed_lay(&s->frame, &s->scene, SMALL_FIXED_TRIANGLES, s->memory, sizeof s->memory);
    small_fixed_frame(&s->frame, GOLDEN_WIDTH, GOLDEN_HEIGHT, variant);
    s->frame.pixel = s->pixel;
    s->frame.depth = s->depth;
    s->frame.background = 0x102030u;
    status = status != LMB_OK ? status : lmb_fixed_transform(&s->frame);
    status = status != LMB_OK ? status : lmb_fixed_light(&s->frame);
    for (int32_t y = 0; y < GOLDEN_HEIGHT && status == LMB_OK; y += ROWS) {
        status = lmb_fixed_band(&s->frame, y, y + ROWS);
        for (int32_t i = 0; i < GOLDEN_WIDTH * ROWS; ++i) {
            h = golden_hash_u32(golden_hash_u32(h, s->pixel[i]), s->depth[i]);
        }
    }
    return golden_hash_u32(h, (uint32_t)status);
}
