/* verbs.inl: part of the checks of lanes (tests/lanes): one backend's verbs over one input. The including file,
 * test_verbs_BACKEND.c, defines VERBS_RUN(name). */
#include <string.h>

#include "../../src/lane/lane.h"

static inline void put_lane(uint32_t *row, lane a)
{
    float v[LANES];
    lane_store(v, a);
    memcpy(row, v, sizeof v);
}

static inline void put_lanei(uint32_t *row, lanei a)
{
    int32_t v[LANES];
    lanei_store(v, a);
    memcpy(row, v, sizeof v);
}

/* Masks have no common form in memory, so the values picked by a mask are compared. */
static inline void put_mask(uint32_t *row, lane_mask a)
{
    put_lane(row, lane_pick(a, lane_splat(1.0f), lane_splat(-2.0f)));
}

static inline void run_floats(verb_output *out, const verb_input *in, int k)
{
    lane a = lane_load(in->a + k), b = lane_load(in->b + k), c = lane_load(in->c + k);
    lane3 p, q;
    p.x = q.z = a;
    p.y = q.x = b;
    p.z = q.y = c;
    put_lane(out->row[VERB_splat] + k, lane_splat(in->a[0]));
    put_lane(out->row[VERB_load] + k, a);
    put_lane(out->row[VERB_add] + k, lane_add(a, b));
    put_lane(out->row[VERB_sub] + k, lane_sub(a, b));
    put_lane(out->row[VERB_mul] + k, lane_mul(a, b));
    put_lane(out->row[VERB_div] + k, lane_div(a, b));
    put_lane(out->row[VERB_sqrt] + k, lane_sqrt(a));
    put_lane(out->row[VERB_min] + k, lane_min(a, b));
    put_lane(out->row[VERB_max] + k, lane_max(a, b));
    put_lane(out->row[VERB_dot] + k, lane3_dot(p, q));
    put_lane(out->row[VERB_trunc] + k, lane_trunc(lane_load(in->whole + k)));
    put_lane(out->row[VERB_part] + k, lane_part(lane_max(lane_load(in->whole + k), lane_splat(0.0f))));
    put_lanei(out->row[VERB_to_int] + k, lane_to_int(lane_load(in->whole + k)));
    put_lane(out->row[VERB_column] + k, lane_column(k));
    put_lane(out->row[VERB_row] + k, lane_row(k));
}

static inline void run_masks(verb_output *out, const verb_input *in, int k)
{
    lane a = lane_load(in->a + k), b = lane_load(in->b + k);
    lane_mask own = mask_of_bits(in->bits >> k), less = lane_lt(a, b);
    put_mask(out->row[VERB_lt] + k, less);
    put_mask(out->row[VERB_le] + k, lane_le(a, b));
    put_lane(out->row[VERB_pick] + k, lane_pick(own, a, b));
    put_lane(out->row[VERB_keep] + k, lane_keep(own, a));
    put_mask(out->row[VERB_mask_and] + k, mask_and(own, less));
    put_mask(out->row[VERB_mask_or] + k, mask_or(own, less));
    put_mask(out->row[VERB_mask_not] + k, mask_not(less));
    put_mask(out->row[VERB_mask_of_bits] + k, own);
    uint32_t bits = mask_bits(less), not_bits = mask_bits(mask_not(less));
    for (int i = 0; i < LANES; ++i) { /* and nothing past LANES */
        const uint32_t past = (bits | not_bits) >> (LANES - 1) << 2;
        out->row[VERB_mask_bits][k + i] = (bits >> i & 1u) | (not_bits >> i & 1u) << 1 | past;
    }
}

static inline void run_integers(verb_output *out, const verb_input *in, int k)
{
    lanei i = lanei_load(in->i + k), j = lanei_load(in->j + k);
    put_lanei(out->row[VERB_i_splat] + k, lanei_splat(in->i[0]));
    put_lanei(out->row[VERB_i_add] + k, lanei_add(i, j));
    put_lanei(out->row[VERB_i_or] + k, lanei_or(i, j));
    put_lanei(out->row[VERB_i_and] + k, lanei_and(i, j));
    put_lanei(out->row[VERB_i_mul] + k, lanei_mul(lanei_load(in->m + k), lanei_load(in->n + k)));
    put_lanei(out->row[VERB_i_shift] + k, lanei_shift(i, in->shift));
    put_lanei(out->row[VERB_i_sub] + k, lanei_sub(i, j));
    put_lanei(out->row[VERB_i_min] + k, lanei_min(i, j));
    put_lanei(out->row[VERB_i_max] + k, lanei_max(i, j));
    put_lanei(out->row[VERB_i_pick] + k, lanei_pick(mask_of_bits(in->bits >> k), i, j));
    put_mask(out->row[VERB_i_lt] + k, lanei_lt(i, j));
    put_lane(out->row[VERB_from_int] + k, lane_from_int(i));
    put_mask(out->row[VERB_i_not_negative] + k, lanei_not_negative(i));
    put_mask(out->row[VERB_i_equal] + k, lanei_equal(i, j));
    put_mask(out->row[VERB_i_within] + k, lanei_within(i, 1 + (in->j[0] & 0x3fffffff)));
    put_lanei(out->row[VERB_halves] + k, lanei_halves(i, lanei_load(in->m + k)));
    put_lanei(out->row[VERB_add_halves] + k, lanei_add_halves(i, lanei_load(in->m + k)));
    put_lanei(out->row[VERB_affine] + k, lanei_affine(in->i[0], in->m[0] >> 12, in->n[0] >> 12, k));
}

static inline void run_doubles(verb_output *out, const verb_input *in, int k)
{
    laned a = laned_from(lane_load(in->whole + k)), i = laned_from_int(lanei_load(in->i + k));
    laned_store(out->d[VERB_D_splat] + k, laned_splat(1.0 / 3.0));
    laned_store(out->d[VERB_D_add] + k, laned_add(a, i));
    laned_store(out->d[VERB_D_sub] + k, laned_sub(a, laned_mul(i, laned_splat(1e-9))));
    laned_store(out->d[VERB_D_mul] + k, laned_mul(a, i));
    laned_store(out->d[VERB_D_div] + k, laned_div(a, laned_add(laned_mul(i, i), laned_splat(1.0))));
    laned_store(out->d[VERB_D_from_int] + k, i);
    laned_store(out->d[VERB_D_load] + k, laned_load(out->d[VERB_D_mul] + k));
    put_lane(out->row[VERB_from_double] + k, lane_from_double(laned_mul(i, laned_splat(1.0 / 3.0))));
}

/* Three pairs of rows with the values of all lanes; the sums are combined into one number. */
static inline void run_sums(verb_output *out, const verb_input *in, int k)
{
    for (int i = k; i < k + LANES; ++i) {
        lane_sums sums = sums_zero();
        uint16_t row[2][4];
        int32_t v[3];
        for (int j = 0; j < 3; ++j) {
            for (int c = 0; c < 8; ++c) {
                row[c / 4][c % 4] = (uint16_t)(c % 4 < 3 ? in->table_u16[(in->at[i] + 5 * j + c) % VERB_TABLE] : 0);
            }
            sums = sums_add(sums, pair_load(row[0], row[1]),
                            j == 0 ? in->bits : j == 1 ? (uint32_t)in->i[i] : (uint32_t)in->m[i] * 0x10001u);
        }
        sums_store(v, sums);
        out->row[VERB_sums][i] = (uint32_t)v[0] + 3u * (uint32_t)v[1] + 5u * (uint32_t)v[2];
    }
}

static inline void run_memory(verb_output *out, const verb_input *in, int k)
{
    const int p = k / 8 * in->step + k % 8;
    lanei at = lanei_load(in->at + k);
    lane_mask own = mask_of_bits(in->bits >> k);
    put_lane(out->row[VERB_gather_f32] + k, lane_gather_f32(in->table_f32, at));
    put_lane(out->row[VERB_gather_u16] + k, lane_gather_u16(in->table_u16, at));
    put_lane(out->row[VERB_table] + k, lane_table(in->table_f32, lanei_and(at, lanei_splat(15))));
    lanei_store((int32_t *)out->row[VERB_gather_rgba] + k, lanei_gather_rgba(in->table_rgba, at));
    put_lanei(out->row[VERB_gather_i32] + k, lanei_gather_i32((const int32_t *)in->surface_u32,
                                                             lanei_min(at, lanei_splat(VERB_SURFACE - 1))));
    put_lane(out->row[VERB_load_rows] + k, lane_load_rows(in->surface_f32 + p, in->step));
    put_lane(out->row[VERB_load_u16] + k, lane_load_u16(in->surface_u16 + p, in->step));
    lane_store_rows(out->stored_f32 + p, in->step, lane_load(in->a + k));
    lane_store_u16(out->stored_u16 + p, in->step, lane_load(in->code + k));
    lane_put_u16(out->put_u16 + p, in->step, in->id & 0xffffu, own);
    lane_put_u32(out->put_u32 + p, in->step, in->id, own);
}

/* Of any pixels, and of pixels that have only the codes 0 and 255. */
static inline void run_codes(verb_output *out, const verb_input *in, int k)
{
    lanei x, y, at = lanei_load(in->at + k), corner[4], from;
    const int n = 1 + (int)(in->id % LANES);
    int32_t v[LANES], w[LANES];
    for (int i = 0; i < LANES; ++i) {
        const uint32_t a = in->surface_u32[(k + i) % VERB_SURFACE], b = (uint32_t)in->i[k + i];
        v[i] = (int32_t)(in->step == 8 ? a : (a & 0x01010101u) * 255u);
        w[i] = (int32_t)(in->step == 8 ? b : (b & 0x01010101u) * 255u);
    }
    x = lanei_load(v);
    y = lanei_load(w);
    put_lanei(out->row[VERB_codes_times] + k, codes_times(x, y));
    put_lanei(out->row[VERB_codes_over] + k, codes_over(x, y));
    put_lanei(out->row[VERB_codes_plus] + k, codes_plus(x, y));
    put_lanei(out->row[VERB_codes_same] + k, codes_same(x, y));
    for (int i = 0; i < 4; ++i) {
        corner[i] = i == 0 ? x : i == 1 ? y : lanei_gather_rgba(in->table_rgba, lanei_shift(at, i - 2));
    }
    put_lanei(out->row[VERB_codes_between] + k, codes_between(corner, y, lanei_shift(x, 8)));
    from = lanei_shift(at, 1);
    for (int i = 0; i < 4; ++i) {
        const lanei past = lanei_splat(i % 2 + i / 2 * (VERB_TABLE / 2 - 1));
        corner[i] = lanei_gather_rgba(in->table_rgba, lanei_add(from, past));
    }
    x = codes_between(corner, x, y);
#ifdef LANE_GATHERS_PAIRS
    lanei_gather_pairs(corner, in->table_rgba, 4 * (VERB_TABLE / 2 - 1), from);
    x = codes_between_pairs(corner, lanei_load(v), y);
#endif
    put_lanei(out->row[VERB_gather_pairs] + k, x);
    x = lanei_load(v);
    if (n < LANES && k == 0) { /* backends have different LANES: compare with the verb for all */
        const uint32_t first = (1u << n) - 1u;
        lanei_store_some((uint8_t *)out->stored_some, n, y);
        lanei_store(v, lanei_load_some((const uint8_t *)v, n));
        put_lanei(out->row[VERB_load_some],
                  lanei_sub(lanei_load(v), lanei_pick(mask_of_bits(first), x, lanei_splat(0))));
        for (int i = 0; i < n; ++i) {
            out->stored_some[i] ^= (uint32_t)w[i];
        }
    }
}

void VERBS_RUN(verb_output *out, const verb_input *in)
{
    memcpy(out->stored_f32, in->surface_f32, sizeof out->stored_f32);
    memcpy(out->stored_u16, in->surface_u16, sizeof out->stored_u16);
    memcpy(out->put_u16, in->surface_u16, sizeof out->put_u16);
    memcpy(out->put_u32, in->surface_u32, sizeof out->put_u32);
    memset(out->row[VERB_load_some], 0, sizeof out->row[VERB_load_some]);
    memset(out->stored_some, 0, sizeof out->stored_some);
    for (int k = 0; k < VERB_LANES; k += LANES) {
        run_floats(out, in, k);
        run_masks(out, in, k);
        run_integers(out, in, k);
        run_doubles(out, in, k);
        run_memory(out, in, k);
        run_codes(out, in, k);
        run_sums(out, in, k);
    }
}
