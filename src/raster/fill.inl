/* fill.inl: one triangle into one tile: coverage, depth test, id. Layer 3.
 *
 * Per pixel: three edge sums, the depth plane clamped to the triangle's range, a strict "nearer than" test. The order
 * (d + dy y) + dx x is the contract; a vector only changes how many x run at once. */

/* NaN becomes 0, for example if far is no farther than near. */
static inline lane fill_depth_16(lane d, const lmb_fill_job *job)
{
    lane code = lane_add(lane_mul(d, lane_splat(job->d_scale)), lane_splat(job->d_bias));
    return lane_trunc(lane_max(lane_min(lane_splat(65535.0f), code), lane_splat(0.0f)));
}

static inline void fill_id(const lmb_fill_tile *tile, int at, uint32_t id, lane_mask pass)
{
    if (tile->id_format == LMB_ID32) {
        lane_put_u32((uint32_t *)tile->id + at, tile->id_step, id, pass);
    } else if (tile->id_format == LMB_ID16) {
        lane_put_u16((uint16_t *)tile->id + at, tile->id_step, id, pass);
    }
}

static inline lane_mask fill_depth(const lmb_fill_tile *tile, const lmb_fill_job *job, int at, lane d, lane_mask in)
{
    if (tile->depth_format == LMB_DEPTH32F) {
        float *p = (float *)tile->depth + at;
        lane old = lane_load_rows(p, tile->depth_step);
        lane_mask pass = mask_and(in, lane_lt(old, d));
        lane_store_rows(p, tile->depth_step, lane_pick(pass, d, old));
        return pass;
    }
    uint16_t *p = (uint16_t *)tile->depth + at;
    lane old = lane_load_u16(p, tile->depth_step);
    lane code = fill_depth_16(d, job);
    lane_mask pass = mask_and(in, lane_lt(old, code));
    lane_store_u16(p, tile->depth_step, lane_pick(pass, code, old));
    return pass;
}

/* Plain C has separate code for float depth with 32-bit ids, in which gcc merges the lanes into vectors. */
LANE_INLINE int fill_joins(const lmb_fill_tile *tile)
{
#if defined(LANE_PLAIN) && LANES > 1
    return tile->depth_format == LMB_DEPTH32F && tile->id_format == LMB_ID32;
#else
    (void)tile;
    return 0;
#endif
}

/* A vector of pixels from (column, y) of the tile on: stores nearer depths, and their ids. in: NULL for all. */
LANE_INLINE void fill_pixels(const lmb_fill_tile *tile, const lmb_fill_job *job, int column, int y, uint32_t id, lane d,
                             const lane_mask *in)
{
    const int at = y * tile->depth_step + column, id_at = y * tile->id_step + column;
#if defined(LANE_PLAIN) && LANES > 1
    if (fill_joins(tile)) {
        float *p = (float *)tile->depth + at;
        d = in != NULL ? lane_pick(*in, d, lane_load(p)) : d;
        lane_put_larger_u32(p, (uint32_t *)tile->id + id_at, id, d);
        return;
    }
    if (tile->depth_format == LMB_DEPTH16 && tile->id_format == LMB_ID16) {
        const lane code = lane_add(lane_mul(d, lane_splat(job->d_scale)), lane_splat(job->d_bias));
        lane_put_larger_u16((uint16_t *)tile->depth + at, (uint16_t *)tile->id + id_at, id,
                            lane_max(lane_min(lane_splat(65535.0f), code), lane_splat(0.0f)),
                            in != NULL ? *in : mask_of_bits(0xffffu));
        return;
    }
#endif
    const lane_mask pass = fill_depth(tile, job, at, d, in != NULL ? *in : mask_of_bits(0xffffu));
    fill_id(tile, id_at, id, pass);
}

/* Vectors per row of a tile, and rows per vector. */
enum { FILL_ACROSS = LANES < LMB_TILE ? LMB_TILE / LANES : 1, FILL_ROWS = LANES < LMB_TILE ? 1 : LANES / LMB_TILE };

/* Tiled depth has specialised code: floats without ids and with 32-bit ones, and 16-bit codes without. Backends with
 * one lane do not, because code size matters there. */
enum { FILL_ANY, FILL_PLAIN, FILL_ID32, FILL_CODES };

LANE_INLINE int fill_kind(const lmb_fill_window *w)
{
    const lmb_fill_tile *tile = &w->first;
    if (LANES == 1 || tile->depth_step != LMB_TILE) {
        return FILL_ANY;
    }
    if (tile->depth_format != LMB_DEPTH32F) {
        /* No depth is above 1, and products and sums round monotonically, so no code is above that of 1. */
        const int is_held = LMB_CULLING && w->d_scale + w->d_bias < 65536.0f;
        return is_held && tile->id_format == LMB_FORMAT_NONE ? FILL_CODES : FILL_ANY;
    }
    if (tile->id_format == LMB_FORMAT_NONE) {
        return FILL_PLAIN;
    }
    return tile->id_format == LMB_ID32 && tile->id_step == LMB_TILE ? FILL_ID32 : FILL_ANY;
}

/* The tile's formats as constants, for the compiler. */
LANE_INLINE lmb_fill_tile fill_first(const lmb_fill_window *w, int kind)
{
    lmb_fill_tile tile = w->first;
    if (kind != FILL_ANY) {
        tile.depth_format = kind == FILL_CODES ? LMB_DEPTH16 : LMB_DEPTH32F;
        tile.id_format = kind == FILL_ID32 ? LMB_ID32 : LMB_FORMAT_NONE;
/* gcc -O2 would merge four plain stores, and the next load would wait for them: 1.8 times slower. */
#if !defined(LANE_PLAIN)
        tile.depth_step = LMB_TILE;
        tile.id_step = LMB_TILE;
#endif
    }
    return tile;
}

/* A triangle in registers. */
typedef struct fill_triangle {
    lanei step[3][FILL_ACROSS]; /* ex times the column, plus ey times the second row of a vector that covers two */
    lane step_d[FILL_ACROSS];
    lane d_min, d_max;
    float per_row;
    int32_t ex[3], ey[3];
    uint32_t id;
    int codes; /* 1: the target's kind is FILL_CODES */
} fill_triangle;

/* Rows and vectors of a tile that the triangle's box covers. */
typedef struct fill_box {
    int32_t first_row, last_row, first, last;
} fill_box;

/* d + dy y at the rows of a vector that starts in row y. `row` is y, for backends narrower than a row. If all rows are
 * drawn, it is counted in float, because a conversion depends on the old value of the register. */
LANE_INLINE lane fill_row_depth(float d, float per_row, int32_t y, float row)
{
#if LANES >= LMB_TILE
    (void)row;
    return lane_add(lane_splat(d), lane_mul(lane_splat(per_row), lane_row(y * LMB_TILE)));
#else
    (void)y;
    return lane_splat(d + per_row * row);
#endif
}

/* 1: branch around vectors without a covered pixel. If masks are hardware predicates, the branch costs more than it
 * saves. */
LANE_INLINE int fill_skips(lane_mask in)
{
#if defined(LANE_PLAIN)
    return mask_bits(in) == 0;
#else
    (void)in;
    return 0;
#endif
}

/* One column of vectors down the rows. e: the edges at the tile's pixel (0, first_row); d: the depth at (0, 0). */
LANE_INLINE void fill_column(const lmb_fill_tile *tile, const lmb_fill_job *coding, const fill_triangle *t,
                              const int32_t e[3], float d, const fill_box *box, int32_t i)
{
    const lanei down0 = lanei_splat(t->ey[0] * FILL_ROWS), down1 = lanei_splat(t->ey[1] * FILL_ROWS),
                down2 = lanei_splat(t->ey[2] * FILL_ROWS);
    lanei e0 = lanei_add(lanei_splat(e[0]), t->step[0][i]), e1 = lanei_add(lanei_splat(e[1]), t->step[1][i]),
          e2 = lanei_add(lanei_splat(e[2]), t->step[2][i]);
    for (int32_t y = box->first_row; y <= box->last_row; y += FILL_ROWS) {
        lane_mask in = lanei_not_negative(lanei_or(lanei_or(e0, e1), e2));
        lane depth = lane_add(fill_row_depth(d, t->per_row, y, (float)y), t->step_d[i]);
        depth = lane_hold(depth, t->d_min, t->d_max);
        if (tile->depth_format == LMB_DEPTH32F && tile->id_format == LMB_FORMAT_NONE) {
            float *p = (float *)tile->depth + y * tile->depth_step + i * LANES;
            lane old = lane_load_rows(p, tile->depth_step);
            lane_store_rows(p, tile->depth_step, lane_pick(in, lane_max(depth, old), old));
        } else if (fill_joins(tile) || !fill_skips(in)) {
            fill_pixels(tile, coding, i * LANES, y, t->id, depth, &in);
        }
        e0 = lanei_add(e0, down0);
        e1 = lanei_add(e1, down1);
        e2 = lanei_add(e2, down2);
    }
}

/* Rows of two vectors. */
enum { FILL_PAIR = LANES > 1 ? 2 * LANES / LMB_TILE : 1 };

#if LANES > 1
/* Codes of depths of the triangle, before clamping to 16 bits. */
LANE_INLINE lane fill_code(lane d, const fill_triangle *t, const lmb_fill_job *job, int clamped)
{
    if (clamped) {
        d = lane_hold(d, t->d_min, t->d_max);
    }
    return lane_add(lane_mul(d, lane_splat(job->d_scale)), lane_splat(job->d_bias));
}

/* The steps of a pair for lane_raise_u16: of the even columns, then of the odd ones. */
LANE_INLINE void fill_set_pairs(fill_triangle *t, float dx)
{
#if defined(LANE_PAIRS)
    static const float column[2 * LANES] = {0, 2, 4, 6, 1, 3, 5, 7};
    for (int i = 0; i < FILL_ACROSS; ++i) {
        t->step_d[i] = lane_mul(lane_splat(dx), lane_load(column + i * LANES));
        t->step[0][i] = lanei_affine(t->ex[0] * i, 2 * t->ex[0], 0, 0);
        t->step[1][i] = lanei_affine(t->ex[1] * i, 2 * t->ex[1], 0, 0);
        t->step[2][i] = lanei_affine(t->ex[2] * i, 2 * t->ex[2], 0, 0);
    }
#else
    (void)t, (void)dx;
#endif
}

/* Column and row of the second vector of a pair. */
enum { FILL_NEXT_COLUMN = FILL_ACROSS - 1, FILL_NEXT_ROW = FILL_ACROSS > 1 ? 0 : FILL_ROWS };

#if defined(LANE_PAIRS)
/* Raises a row to the codes of row + dx x. sums: not negative for pixels inside; NULL: all are. In loops over the
 * lanes, because gcc makes branches of the verbs for one lane here. */
LANE_INLINE void fill_codes_row(uint16_t *p, float row, const fill_triangle *t, const lmb_fill_job *job,
                                const lanei *sums, int clamped)
{
    lane code[2];
    for (int k = 0; k < 2; ++k) {
        for (int i = 0; i < LANES; ++i) {
            float d = row + t->step_d[k].v[i];
            if (clamped) {
                d = maxf(d, job->d_min);
                d = minf(d, job->d_max);
            }
            d = d * job->d_scale + job->d_bias;
            code[k].v[i] = sums == NULL || sums[k].v[i] >= 0 ? d : 0.0f;
        }
    }
    lane_raise_u16(p, code[0], code[1]);
}

LANE_INLINE void fill_codes_rows(uint16_t *p, const lmb_fill_job *job, const fill_triangle *t, const int32_t e[3],
                                 float d, int32_t first, int32_t last)
{
    lanei at[3][2], sums[2];
    for (int n = 0; n < 3; ++n) {
        at[n][0] = lanei_add(lanei_splat(e[n]), t->step[n][0]);
        at[n][1] = lanei_add(lanei_splat(e[n]), t->step[n][1]);
    }
    for (int32_t y = first; y <= last; ++y) {
        for (int k = 0; k < 2; ++k) {
            for (int i = 0; i < LANES; ++i) {
                sums[k].v[i] = at[0][k].v[i] | at[1][k].v[i] | at[2][k].v[i];
                at[0][k].v[i] += t->ey[0];
                at[1][k].v[i] += t->ey[1];
                at[2][k].v[i] += t->ey[2];
            }
        }
        fill_codes_row(p + y * LMB_TILE, d + t->per_row * (float)y, t, job, sums, 1);
    }
}

LANE_INLINE void fill_codes_inside(uint16_t *p, const lmb_fill_job *job, const fill_triangle *t, int clamped)
{
    for (int32_t y = 0; y < LMB_TILE; ++y) {
        fill_codes_row(p + y * LMB_TILE, job->d + t->per_row * (float)y, t, job, NULL, clamped);
    }
}
#else
/* Rows first .. last of a tile of codes. e: the edges at the tile's pixel (0, first); first is a multiple of
 * FILL_PAIR. */
LANE_INLINE void fill_codes_rows(uint16_t *p, const lmb_fill_job *job, const fill_triangle *t, const int32_t e[3],
                                 float d, int32_t first, int32_t last)
{
    const lanei down0 = lanei_splat(t->ey[0] * FILL_PAIR), down1 = lanei_splat(t->ey[1] * FILL_PAIR),
                down2 = lanei_splat(t->ey[2] * FILL_PAIR);
    lanei a0 = lanei_add(lanei_splat(e[0]), t->step[0][0]), a1 = lanei_add(lanei_splat(e[1]), t->step[1][0]),
          a2 = lanei_add(lanei_splat(e[2]), t->step[2][0]);
    const int32_t to[3] = {t->ey[0] * FILL_NEXT_ROW, t->ey[1] * FILL_NEXT_ROW, t->ey[2] * FILL_NEXT_ROW};
    lanei b0 = lanei_add(lanei_splat(e[0] + to[0]), t->step[0][FILL_NEXT_COLUMN]),
          b1 = lanei_add(lanei_splat(e[1] + to[1]), t->step[1][FILL_NEXT_COLUMN]),
          b2 = lanei_add(lanei_splat(e[2] + to[2]), t->step[2][FILL_NEXT_COLUMN]);
    for (int32_t y = first; y <= last; y += FILL_PAIR) {
        const lane_mask in_a = lanei_not_negative(lanei_or(lanei_or(a0, a1), a2)),
                        in_b = lanei_not_negative(lanei_or(lanei_or(b0, b1), b2));
        const lane row = fill_row_depth(d, t->per_row, y, (float)y),
                   next = FILL_NEXT_ROW > 0 ? fill_row_depth(d, t->per_row, y + FILL_NEXT_ROW, 0.0f) : row;
        lane_raise_u16(p + y * LMB_TILE, lane_keep(in_a, fill_code(lane_add(row, t->step_d[0]), t, job, 1)),
                       lane_keep(in_b, fill_code(lane_add(next, t->step_d[FILL_NEXT_COLUMN]), t, job, 1)));
        a0 = lanei_add(a0, down0);
        a1 = lanei_add(a1, down1);
        a2 = lanei_add(a2, down2);
        b0 = lanei_add(b0, down0);
        b1 = lanei_add(b1, down1);
        b2 = lanei_add(b2, down2);
    }
}

/* A whole tile of codes. */
LANE_INLINE void fill_codes_inside(uint16_t *p, const lmb_fill_job *job, const fill_triangle *t, int clamped)
{
    for (int32_t y = 0; y < LMB_TILE; y += FILL_PAIR) {
        const lane row = fill_row_depth(job->d, t->per_row, y, (float)y),
                   next = FILL_NEXT_ROW > 0 ? fill_row_depth(job->d, t->per_row, y + FILL_NEXT_ROW, 0.0f) : row;
        lane_raise_u16(p + y * LMB_TILE, fill_code(lane_add(row, t->step_d[0]), t, job, clamped),
                       fill_code(lane_add(next, t->step_d[FILL_NEXT_COLUMN]), t, job, clamped));
    }
}
#endif
#endif

/* A tile that no edge crosses. `clamped`: the plane may leave the triangle's range. */
LANE_INLINE void fill_inside(const lmb_fill_tile *tile, const lmb_fill_job *job, const fill_triangle *t, int clamped)
{
    float row = 0.0f;
#if LANES > 1
    if (t->codes) {
        fill_codes_inside((uint16_t *)tile->depth, job, t, clamped);
        return;
    }
#endif
    for (int32_t y = 0; y < LMB_TILE; y += FILL_ROWS, row += (float)FILL_ROWS) {
        const lane at = fill_row_depth(job->d, t->per_row, y, row);
        for (int32_t i = 0; i < FILL_ACROSS; ++i) {
            lane depth = lane_add(at, t->step_d[i]);
            if (clamped) {
                depth = lane_hold(depth, t->d_min, t->d_max);
            }
            if (tile->depth_format == LMB_DEPTH32F && tile->id_format == LMB_FORMAT_NONE) {
                float *p = (float *)tile->depth + y * tile->depth_step + i * LANES;
                lane_store_rows(p, tile->depth_step, lane_max(depth, lane_load_rows(p, tile->depth_step)));
            } else {
                fill_pixels(tile, job, i * LANES, y, t->id, depth, NULL);
            }
        }
    }
}

/* 1 if the plane is within the range at the tile's corners, and so at all pixels (sums round monotonically). */
LANE_INLINE int fill_in_range(const lmb_fill_job *job)
{
    const float right = job->dx * (float)(LMB_TILE - 1), bottom = job->d + job->dy * (float)(LMB_TILE - 1),
                top = job->d;
    const float a = top, b = top + right, c = bottom, d = bottom + right;
    const float low = minf(minf(a, b), minf(c, d)), high = maxf(maxf(a, b), maxf(c, d));
    return low >= job->d_min && high <= job->d_max;
}

LANE_INLINE void fill_set(fill_triangle *t, const int32_t ex[3], const int32_t ey[3], const lmb_fill_job *job, int kind)
{
    t->per_row = job->dy;
    t->d_min = lane_splat(job->d_min);
    t->d_max = lane_splat(job->d_max);
    t->id = job->id;
    t->codes = kind == FILL_CODES;
    t->ex[0] = ex[0], t->ex[1] = ex[1], t->ex[2] = ex[2];
    t->ey[0] = ey[0], t->ey[1] = ey[1], t->ey[2] = ey[2];
    for (int i = 0; i < FILL_ACROSS; ++i) {
        t->step_d[i] = lane_mul(lane_splat(job->dx), lane_column(i * LANES));
        t->step[0][i] = lanei_affine(0, ex[0], ey[0], i * LANES);
        t->step[1][i] = lanei_affine(0, ex[1], ey[1], i * LANES);
        t->step[2][i] = lanei_affine(0, ex[2], ey[2], i * LANES);
    }
#if LANES > 1
    if (kind == FILL_CODES) {
        fill_set_pairs(t, job->dx);
    }
#endif
}
