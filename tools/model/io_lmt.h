/* io_lmt.h: opens baked light transfers: a .lmt, or the one in a packed scene. */
#ifndef IO_LMT_H
#define IO_LMT_H

#include <lambent/lambent.h>
#include <string.h>

#include "../common/io_file.h"

/* lmt_open: opens the transfer in a file, which must outlive it. Returns 1, or 0 with `r` set. */
int lmt_open(lmb_transfer *out, const file_bytes *file, const char *path, report *r);

/* A division of a triangle: a point of the edge between corners `from` and `to` replaces `to` in the first half and
 * `from` in the second. */
typedef struct lmt_halving {
    int from, to, is_wall;
    uint32_t first; /* of two halves, which are adjacent */
    float part;     /* of the edge, at which it is divided */
} lmt_halving;

/* Reads entry `at` of LMB_TRANSFER_DIVISIONS, which is no leaf. */
static inline lmt_halving lmt_halving_of(const lmb_transfer *t, uint32_t at)
{
    const uint32_t low_bits = (1u << LMB_TRANSFER_EDGE_BIT) - 1u;
    uint32_t word = t->section[LMB_TRANSFER_DIVISIONS][at];
    lmt_halving h = {0, 0, 0, 0, 0.5f};
    if (word >> LMB_TRANSFER_EDGE_BIT == LMB_TRANSFER_CUT) {
        const uint32_t *cut = t->section[LMB_TRANSFER_CUTS] + LMB_TRANSFER_CUT_WORDS * (size_t)(word & low_bits);
        word = cut[0];
        h.is_wall = (word & LMB_TRANSFER_WALL) != 0;
        memcpy(&h.part, &cut[1], sizeof h.part);
    }
    h.from = (int)(word >> LMB_TRANSFER_EDGE_BIT & 3u);
    h.to = h.from == 2 ? 0 : h.from + 1;
    h.first = word & low_bits;
    return h;
}

#endif
