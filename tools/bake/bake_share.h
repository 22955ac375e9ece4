/* bake_share.h: steps of a bake shared out among slices, which pass on in files what each has made. */
#ifndef BAKE_SHARE_H
#define BAKE_SHARE_H

#include "../common/byte_buffer.h"
#include "../common/report.h"
#include "../common/slice.h"
#include "bake.h"

/* What a slice knows of the others. */
struct bake_share {
    slice slice;
    uint64_t job;
    const char *folder; /* with its last separator */
    int32_t step;
    double load[SLICE_MOST]; /* what was dealt to each so far, by weight */
    uint8_t is_late[SLICE_MOST]; /* was waited for in vain */
    double unit_s;           /* that this machine takes for a weight of 1 */
    double made, all;        /* weights: by this slice, in all steps */
};

/* A step: batches that need nothing of each other.
 *   make  a batch, by this machine
 *   put   what others need of it
 *   get   the same of a batch that another one made: 0 where it is not what put has written; make may follow
 * make: 1, or 0 with `r` set. */
typedef struct bake_step {
    int32_t batches;
    double (*weight)(const void *user, int32_t batch); /* NULL: all alike */
    int (*make)(void *user, int32_t batch, report *r);
    void (*put)(const void *user, int32_t batch, byte_buffer *to);
    int (*get)(void *user, int32_t batch, byte_reader *from);
    void *user;
} bake_step;

/* bake_past: the first of `all` things that comes after a batch of `size`. */
static inline uint32_t bake_past(int32_t batch, uint32_t size, uint32_t all)
{
    const uint32_t past = ((uint32_t)batch + 1) * size;
    return past < all ? past : all;
}

/* bake_share_step: all batches. Without slices (`s` NULL) they are made in order. Else each goes to the slice that has the
 * least to do; a slice makes its own, writes them to a file of the folder, and reads those of others there. What does not
 * come in time it makes itself. 1, or 0 with `r` set. */
int bake_share_step(bake_share *s, const bake_step *step, report *r);

/* Halves of floats as bake_short makes them, of which many are 0. `count`: a multiple of 8. */
void bake_put_halves(byte_buffer *to, const uint16_t *row, size_t count);
int bake_get_halves(uint16_t *row, size_t count, byte_reader *from);

#endif
