/* fill_tiny.inl: triangles of a few pixels into float depths with 32-bit ids, in plain C of four lanes. Layer 3.
 *
 * A row of four lanes takes as long for one pixel as for four, and most triangles of a mesh cover three or four pixels.
 * So the pixels inside a box are found as a set of bits, and each is tested by itself. Same sums as fill.inl. */

/* The three edges are fields of one number. If a field is negative, its top bit is set and the fields above are smaller
 * by one. So a top bit is set if and only if an edge is negative. */
enum { TINY_FIELD = 21, TINY_STEP = 4096 /* limit of two edges' steps per px; the third's are at most twice that */ };
#define TINY_TOP(n) ((uint64_t)1 << ((n) * TINY_FIELD - 1))
#define TINY_TOPS   (TINY_TOP(1) | TINY_TOP(2) | TINY_TOP(3))

/* The top bits of pixel i of a row, at bits 13 + i of each field. */
#define TINY_BITS(i) (((row + (uint64_t)(i) * ex) & TINY_TOPS) >> (LMB_TILE - 1 - (i)))

LANE_INLINE uint64_t tiny_pack(int32_t a, int32_t b, int32_t c)
{
    return (uint64_t)(int64_t)a + ((uint64_t)(int64_t)b << TINY_FIELD) + ((uint64_t)(int64_t)c << (2 * TINY_FIELD));
}

/* 1 if a box has at most 8 x 8 px, and the edges' fields hold all sums: a window may cut a box of longer edges. */
LANE_INLINE int tiny_is(const lmb_batch *t, int k)
{
    const uint32_t steps = (uint32_t)(t->ex[0][k] + TINY_STEP) | (uint32_t)(t->ex[1][k] + TINY_STEP) |
                           (uint32_t)(t->ey[0][k] + TINY_STEP) | (uint32_t)(t->ey[1][k] + TINY_STEP);
    return t->x1[k] - t->x0[k] < LMB_TILE && t->y1[k] - t->y0[k] < LMB_TILE && steps < 2 * TINY_STEP;
}

/* The pixels inside triangle k. Bit 0 is the box's first pixel; rows are 8 bits. */
LANE_INLINE uint64_t tiny_inside(const lmb_batch *t, int k, int32_t right, int32_t down)
{
    const int32_t wide = t->x1[k] - t->x0[k], high = LMB_TILE * (t->y1[k] - t->y0[k]);
    const uint64_t ex = tiny_pack(t->ex[0][k], t->ex[1][k], t->ex[2][k]),
                   ey = tiny_pack(t->ey[0][k], t->ey[1][k], t->ey[2][k]);
    uint64_t row = tiny_pack(t->e[0][k], t->e[1][k], t->e[2][k]) + ex * (uint64_t)right + ey * (uint64_t)down;
    uint64_t outside = 0;
    for (int32_t j = 0; j <= high; j += LMB_TILE) {
        uint64_t tops = TINY_BITS(0) | TINY_BITS(1) | TINY_BITS(2) | TINY_BITS(3);
        if (wide > 3) {
            tops |= TINY_BITS(4) | TINY_BITS(5) | TINY_BITS(6) | TINY_BITS(7);
        }
        tops = tops >> (TINY_FIELD - LMB_TILE) | tops >> (2 * TINY_FIELD - LMB_TILE) |
               tops >> (3 * TINY_FIELD - LMB_TILE);
        outside |= (tops & 0xffu) << j;
        row += ey;
    }
    return ~outside & (~(uint64_t)0 >> (LMB_TILE_PIXELS - LMB_TILE - high)) &
           (uint64_t)(0xffu >> (LMB_TILE - 1 - wide)) * UINT64_C(0x0101010101010101);
}

/* As lowest_bit_64, in one instruction if there is one. */
LANE_INLINE int tiny_lowest(uint64_t bits)
{
#if defined(__GNUC__)
    return __builtin_ctzll(bits);
#else
    return lowest_bit_64(bits);
#endif
}

static const float tiny_number[LMB_TILE] = {0, 1, 2, 3, 4, 5, 6, 7};

/* Draws `pixels` of the tile that starts at pixel (x, y). */
LANE_INLINE void tiny_tile(const lmb_fill_window *w, const lmb_batch *t, int k, int32_t x, int32_t y, uint64_t pixels)
{
    const ptrdiff_t down = (y - w->y0) >> 3, across = (x - w->x0) >> 3;
    const ptrdiff_t at_tile = down * w->depth_row + across * w->depth_tile;
    float *depth = (float *)(void *)((uint8_t *)w->first.depth + at_tile);
    uint32_t *id = (uint32_t *)(void *)((uint8_t *)w->first.id + at_tile);
    const double d_row = t->dy[k] * ((y * 256 + w->origin_y) * (1.0 / 256.0));
    const float d = (float)(t->d[k] + t->dx[k] * ((x * 256 + w->origin_x) * (1.0 / 256.0)) + d_row);
    const float dx = (float)t->dx[k], dy = (float)t->dy[k], low = t->d_min[k], high = t->d_max[k];
    const uint32_t own = t->id[k];
    for (; pixels != 0; pixels &= pixels - 1) {
        const int at = tiny_lowest(pixels);
        float here = (d + dy * tiny_number[at >> 3]) + dx * tiny_number[at & 7];
        here = here > low ? here : low;
        here = here < high ? here : high;
        /* Whether a pixel is nearer is as good as random, so no branch. */
        const float old = depth[at];
        const uint32_t was = id[at], passes = 0u - (uint32_t)(old < here);
        depth[at] = old < here ? here : old;
        id[at] = was ^ ((was ^ own) & passes);
    }
}

/* Draws triangle k, with a box of at most 8 x 8 px, into one to four tiles. */
NOINLINE void tiny_fill(const lmb_fill_window *w, const lmb_batch *t, int k)
{
    const int32_t x = t->x0[k] & ~(LMB_TILE - 1), y = t->y0[k] & ~(LMB_TILE - 1), right = t->x0[k] - x,
                  down = t->y0[k] - y;
    const uint64_t inside = tiny_inside(t, k, right, down);
    const uint64_t here = (uint64_t)(0xffu >> right) * UINT64_C(0x0101010101010101);
    const uint64_t left = (inside & here) << right, other = (inside & ~here) >> ((LMB_TILE - right) & 63);
    const int above = LMB_TILE * down, below = LMB_TILE_PIXELS - above;
    const uint64_t part[4] = {left << above, other << above, above != 0 ? left >> below : 0,
                              above != 0 ? other >> below : 0};
    const int n = t->y1[k] >> 3 != t->y0[k] >> 3 ? 4 : t->x1[k] >> 3 != t->x0[k] >> 3 ? 2 : 1;
    for (int i = 0; i < n; ++i) {
        if (part[i] != 0) {
            tiny_tile(w, t, k, x + (i & 1) * LMB_TILE, y + (i >> 1) * LMB_TILE, part[i]);
        }
    }
}
