/* fixed_part.h: shared by the parts of a frame by integers. Layer 8. */
#ifndef LMB_FIXED_PART_H
#define LMB_FIXED_PART_H

#include <lambent/fixed.h>

enum { FIXED_NEAR = 1, FIXED_OUTSIDE = 31, FIXED_USED = 32, FIXED_CUT = 0x8000 };

typedef struct fixed_receiver {
    int32_t at[3], normal[3];
    uint32_t albedo[3];
} fixed_receiver;

static inline int32_t fixed_half(uint32_t word, int high)
{
    return (int32_t)(int16_t)(high ? word >> 16 : word & 0xffffu);
}

static inline int32_t fixed_byte(uint32_t word, int shift) { return (int32_t)(int8_t)(word >> shift & 255u); }

static inline void fixed_place_of(int32_t at[3], const uint32_t *w)
{
    at[0] = fixed_half(w[0], 0);
    at[1] = fixed_half(w[0], 1);
    at[2] = fixed_half(w[1], 0);
}

static inline void fixed_receiver_at(fixed_receiver *out, const lmb_fixed *s, uint32_t i)
{
    const uint32_t *w = s->receiver + LMB_FIXED_RECEIVER_WORDS * i;
    fixed_place_of(out->at, w);
    out->normal[0] = fixed_byte(w[1], 16);
    out->normal[1] = fixed_byte(w[1], 24);
    out->normal[2] = fixed_byte(w[2], 0);
    for (int c = 0; c < 3; ++c) {
        out->albedo[c] = w[2] >> (8 + 8 * c) & 255u;
    }
}

/* Limits of colours and depths. With rounding, filled values then stay within FIXED_TOP, to which a dither adds 7
 * codes, and within 16 bits. */
enum { FIXED_LEAST = 1, FIXED_MOST = 247, FIXED_TOP = 0xf8ff, FIXED_LEAST_DEPTH = 16, FIXED_MOST_DEPTH = 65519 };

/* A band: rows first .. past - 1 of a picture. */
typedef struct fixed_band {
    void *pixel;     /* 4 or 2 bytes a pixel, by format */
    uint16_t *depth; /* null: only the hull */
    int32_t width, first, past, format;
} fixed_band;

/* lmb_fixed_clip: clips a triangle that is partly outside to up to FIXED_CORNERS corners. Returns their number. */
enum { FIXED_CORNERS = 9 };
int lmb_fixed_clip(lmb_fixed_vertex out[FIXED_CORNERS], const lmb_fixed_frame *f, uint32_t triangle);

/* lmb_fixed_set_up: corners in either winding, within a guard band of 12 times the sides in 1/16 px. Sets up rows first
 * .. past - 1 of a picture of this width. Without depth if a band without depth fills it. Returns 0, and no rows, if it
 * covers none. */
int lmb_fixed_set_up(lmb_fixed_ready *out, const lmb_fixed_vertex *c0, const lmb_fixed_vertex *c1,
                     const lmb_fixed_vertex *c2, int32_t width, int32_t first, int32_t past, int has_depth);

/* lmb_fixed_fill: fills the triangle's rows in the band. If the band has no depth, all pixels are drawn. */
void lmb_fixed_fill(const fixed_band *b, const lmb_fixed_ready *r);

/* lmb_fixed_clear: sets all pixels of the band to 0x00RRGGBB. */
void lmb_fixed_clear(const fixed_band *b, uint32_t colour);

#endif
