/* fuzz_fixed.c: opens a blob of light at vertices; if it opens, draws frames in bands of two
 * heights, prepared or not. */
#include <stdlib.h>
#include <string.h>

#include <lambent/fixed.h>

#include "../small_fixed.h"
#include "fuzz.h"

enum { WIDTH = 48, HEIGHT = 32, READY = 64 };

static uint32_t pixel[2][WIDTH * HEIGHT];
static lmb_fixed_ready ready[READY];
static uint16_t depth[WIDTH * HEIGHT];

static void draw(lmb_fixed_frame *f, int which)
{
    small_fixed_frame(f, WIDTH, HEIGHT, which);
    f->depth = depth;
    fuzz_require(lmb_fixed_transform(f) == LMB_OK);
    fuzz_require(f->seen_count <= f->seen_cap);
    fuzz_require(lmb_fixed_light(f) == LMB_OK);
    f->pixel = pixel[0];
    fuzz_require(lmb_fixed_band(f, 0, HEIGHT) == LMB_OK);
    f->ready = ready;
    f->ready_cap = which < 5 ? READY : READY / 8;
    fuzz_require(lmb_fixed_prepare(f) == LMB_OK);
    for (int32_t y = 0; y < HEIGHT; y += 5) {
        f->pixel = pixel[1] + WIDTH * y;
        fuzz_require(lmb_fixed_band(f, y, y + 5 < HEIGHT ? y + 5 : HEIGHT) == LMB_OK);
    }
    fuzz_require(memcmp(pixel[0], pixel[1], sizeof pixel[0]) == 0);
}

void fuzz_lmf(const uint8_t *data, size_t size)
{
    lmb_fixed s;
    lmb_fixed_frame f;
    uint32_t *copy = malloc(size + 4);
    if (copy == NULL) {
        return;
    }
    memcpy(copy, data, size);
    const lmb_status opened = lmb_fixed_open(&s, copy, size);
    fuzz_require(opened == LMB_OK || opened == LMB_ERR_FORMAT || opened == LMB_ERR_BUILD);
    if (opened == LMB_OK) {
        const size_t bytes = lmb_fixed_memory(&s, s.triangles / 2);
        void *memory = calloc(1, bytes);
        memset(&f, 0, sizeof f);
        if (memory != NULL) {
            fuzz_require(lmb_fixed_lay(&f, &s, s.triangles / 2, memory, bytes - 1) == LMB_ERR_CAPACITY);
            fuzz_require(lmb_fixed_lay(&f, &s, s.triangles / 2, memory, bytes) == LMB_OK);
            draw(&f, 1);
            draw(&f, 6);
            draw(&f, 3);
        }
        free(memory);
    }
    free(copy);
}
