/* bake_share.h: shares the steps of a bake among slices, which exchange results through files. */
#ifndef BAKE_SHARE_H
#define BAKE_SHARE_H

#include "../common/byte_buffer.h"
#include "../common/report.h"
#include "../common/slice.h"
#include "bake.h"

/* The state of one slice. */
struct bake_share {
    slice slice;
    uint64_t job;
    const char *folder; /* ends with a separator */
    int32_t step;
    double load[SLICE_MOST]; /* weight assigned to each slice so far */
    uint8_t is_late[SLICE_MOST]; /* waiting for this slice timed out */
    double unit_s;           /* time of this machine per weight of 1 */
    double made, all;        /* weights: made by this slice; of all steps */
};

/* A step of a bake: independent batches.
 *
 *   make  computes a batch on this machine
 *   put   writes the results of a batch that other batches need
 *   get   reads results that another slice wrote with put. Returns 0 if they are invalid; make may be called after it
 *
 * make returns 1, or 0 with `r` set. */
typedef struct bake_step {
    int32_t batches;
    double (*weight)(const void *user, int32_t batch); /* NULL: all equal */
    int (*make)(void *user, int32_t batch, report *r);
    void (*put)(const void *user, int32_t batch, byte_buffer *to);
    int (*get)(void *user, int32_t batch, byte_reader *from);
    void *user;
} bake_step;

/* bake_past: the end of batch number `batch` if `all` items are split into batches of `size`. */
static inline uint32_t bake_past(int32_t batch, uint32_t size, uint32_t all)
{
    const uint32_t past = ((uint32_t)batch + 1) * size;
    return past < all ? past : all;
}

/* bake_share_step: runs all batches. Without slices (`s` NULL) they run in order. Otherwise each batch goes to the
 * slice with the least work. A slice writes the batches that it computes to a file in the folder, and reads the
 * files of the others. If a file does not arrive in time, the slice computes those batches too. Returns 1, or 0 with
 * `r` set. */
int bake_share_step(bake_share *s, const bake_step *step, report *r);

/* Half floats from bake_short, of which many are 0. `count`: a multiple of 8. */
void bake_put_halves(byte_buffer *to, const uint16_t *row, size_t count);
int bake_get_halves(uint16_t *row, size_t count, byte_reader *from);

#endif
