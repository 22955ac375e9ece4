/* test_verbs_scalar.c: the scalar lanes against plain C, and other backends' rows against the scalar ones. */
#include "../../src/lane/lane_scalar.h"

#include <lambent/raster.h>

#include "seed.h"
#include "verbs.h"

#define VERBS_RUN verbs_scalar
#include "verbs.inl"

void test_verbs_scalar(void);

enum { BITS, FLOAT };
static const struct verb {
    const char *name;
    int results;
} verbs[] = {
#define VERB_LINE(name, results) {#name, results},
    VERBS(VERB_LINE)
#undef VERB_LINE
};

/* --- inputs ------------------------------------------------------------------------------------------------------- */

static float float_of(uint32_t bits)
{
    float v;
    memcpy(&v, &bits, sizeof v);
    return v;
}

static uint32_t bits_of(float v)
{
    uint32_t bits;
    memcpy(&bits, &v, sizeof bits);
    return bits;
}

static int32_t signed_under(test_rng *r, int bits)
{
    int32_t v = (int32_t)(test_random(r) & ((UINT32_C(1) << bits) - 1u));
    return test_random(r) & 1u ? v : -v;
}

static uint32_t any_float(test_rng *r)
{
    return test_random(r) % 4u ? test_random(r) : hard_bits[test_random(r) % HARD_COUNT];
}

static void make_memory(verb_input *in, test_rng *r)
{
    for (int k = 0; k < VERB_TABLE; ++k) {
        uint32_t bits = any_float(r);
        memcpy(&in->table_f32[k], &bits, sizeof bits);
        for (int c = 0; c < 4; ++c) {
            in->table_rgba[4 * k + c] = (uint8_t)test_random(r);
        }
        in->table_u16[k] = (uint16_t)(k % 5 == 0 ? 65535u : test_random(r));
    }
    for (int k = 0; k < VERB_SURFACE; ++k) {
        in->surface_u32[k] = any_float(r);
        memcpy(&in->surface_f32[k], &in->surface_u32[k], sizeof in->surface_f32[k]);
        in->surface_u16[k] = (uint16_t)(k % 7 == 0 ? 65535u : test_random(r));
    }
    in->bits = test_random(r);
    in->id = test_random(r);
    in->step = test_random(r) % 2u ? 8 : 11;
}

static void make_input(verb_input *in, test_rng *r)
{
    for (int k = 0; k < VERB_LANES; ++k) {
        const uint32_t a = any_float(r), b = any_float(r), c = any_float(r);
        const int wide = (int)(test_random(r) % 31u);
        memcpy(&in->a[k], &a, sizeof a);
        memcpy(&in->b[k], test_random(r) % 8u ? &b : &a, sizeof b);
        memcpy(&in->c[k], &c, sizeof c);
        in->whole[k] = (float)signed_under(r, (int)(test_random(r) % 24u)) * test_uniform(r, 0.0f, 127.0f);
        in->code[k] = (float)(test_random(r) % 5u ? test_random(r) & 65535u : 65535u);
        in->i[k] = signed_under(r, (int)(test_random(r) % 31u));
        in->j[k] = test_random(r) & 1u ? in->i[k] : signed_under(r, 30);
        in->m[k] = signed_under(r, wide);
        in->n[k] = signed_under(r, 30 - wide);
        in->at[k] = (int32_t)(test_random(r) % VERB_TABLE);
    }
    in->shift = (int32_t)(test_random(r) & 31u);
    make_memory(in, r);
}

/* Every combination of two hard floats, in a and b. */
static void make_hard(verb_input *in, test_rng *r, uint32_t pair)
{
    make_input(in, r);
    for (uint32_t k = 0; k < VERB_LANES; ++k) {
        const uint32_t n = pair + k;
        memcpy(&in->a[k], &hard_bits[n % HARD_COUNT], sizeof in->a[k]);
        memcpy(&in->b[k], &hard_bits[n / HARD_COUNT % HARD_COUNT], sizeof in->b[k]);
    }
}

/* --- other backends ----------------------------------------------------------------------------------------------- */

static int same(uint32_t a, uint32_t b, int results)
{
    const int nan_a = (a & 0x7fffffffu) > 0x7f800000u, nan_b = (b & 0x7fffffffu) > 0x7f800000u;
    return a == b || (results == FLOAT && nan_a && nan_b);
}

/* Returns 1, or 0 after printing the first difference. */
static int same_output(const char *backend, uint32_t seed, const verb_input *in, const verb_output *want,
                       const verb_output *got)
{
    for (int v = 0; v < VERB_COUNT; ++v) {
        for (int k = 0; k < VERB_LANES; ++k) {
            if (!same(want->row[v][k], got->row[v][k], verbs[v].results)) {
                printf("%s: %s, lane %d, of a %08x b %08x i %d j %d: want %08x, got %08x; ", backend, verbs[v].name, k,
                       (unsigned)bits_of(in->a[k]), (unsigned)bits_of(in->b[k]), (int)in->i[k], (int)in->j[k],
                       (unsigned)want->row[v][k], (unsigned)got->row[v][k]);
                printf("repeat: LANES_SEED=%u tests lanes\n", (unsigned)seed);
                return 0;
            }
        }
    }
    const char *place = memcmp(want->stored_f32, got->stored_f32, sizeof want->stored_f32) ? "store_rows"
                        : memcmp(want->stored_u16, got->stored_u16, sizeof want->stored_u16) ? "store_u16"
                        : memcmp(want->put_u16, got->put_u16, sizeof want->put_u16) ? "put_u16"
                        : memcmp(want->put_u32, got->put_u32, sizeof want->put_u32) ? "put_u32"
                        : memcmp(want->stored_some, got->stored_some, sizeof want->stored_some) ? "store_some"
                        : memcmp(want->d, got->d, sizeof want->d) ? "binary64" : NULL;
    if (place != NULL) {
        printf("%s: %s leaves other memory than scalar; repeat: LANES_SEED=%u tests lanes\n", backend, place,
               (unsigned)seed);
    }
    return place == NULL;
}

void verbs_compare(const char *backend, void (*run)(verb_output *out, const verb_input *in))
{
    const seed_range range = seeds(4000);
    static verb_input in;
    static verb_output want, got;
    if (lmb_kernels_named(backend) == NULL) {
        SKIP("%s: this processor has none", backend);
        return;
    }
    for (uint32_t seed = range.first; seed - range.first < range.count; ++seed) {
        test_rng r = seed_rng(seed);
        if (seed * VERB_LANES < HARD_COUNT * HARD_COUNT + VERB_LANES) {
            make_hard(&in, &r, (seed - 1) * VERB_LANES);
        } else {
            make_input(&in, &r);
        }
        memset(&want, 0, sizeof want);
        memset(&got, 0, sizeof got);
        verbs_scalar(&want, &in);
        run(&got, &in);
        int equal = same_output(backend, seed, &in, &want, &got);
        CHECK(equal);
        if (!equal) {
            return;
        }
    }
}

/* --- the promises in the comments of the scalar lanes ------------------------------------------------------------- */

static void test_rules(void)
{
    const float nan = float_of(0x7fc12345u), values[] = {0.0f, -0.0f, 1.0f, nan};
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            const float a = values[i], b = values[j];
            float lo[LANES], hi[LANES];
            lane_store(lo, lane_min(lane_splat(a), lane_splat(b)));
            lane_store(hi, lane_max(lane_splat(a), lane_splat(b)));
            CHECK(bits_of(lo[LANES - 1]) == bits_of(a < b ? a : b));
            CHECK(bits_of(hi[LANES - 1]) == bits_of(a > b ? a : b));
        }
    }
    CHECK(mask_bits(lane_lt(lane_splat(-1.0f), lane_splat(1.0f))) == (1u << LANES) - 1u);
    CHECK(mask_bits(lane_lt(lane_splat(nan), lane_splat(1.0f))) == 0);
    CHECK(mask_bits(mask_of_bits(1u << (LANES - 1) | 1u << LANES)) == 1u << (LANES - 1));
}

static int32_t half_of(int32_t a) { return (a & 0xffff) - ((a & 0x8000) << 1); }

static void test_rows(int32_t step)
{
    static verb_input in;
    static verb_output out;
    test_rng r = seed_rng(1);
    make_input(&in, &r);
    in.step = step;
    verbs_scalar(&out, &in);
    for (int k = 0; k < VERB_LANES; ++k) {
        const int p = k / 8 * step + k % 8, mine = in.bits >> k & 1u;
        CHECK(out.row[VERB_column][k] == bits_of((float)(k % 8)) && out.row[VERB_row][k] == bits_of((float)(k / 8)));
        CHECK(out.row[VERB_i_mul][k] == (uint32_t)in.m[k] * (uint32_t)in.n[k]);
        CHECK(out.row[VERB_halves][k] == (((uint32_t)in.i[k] & 0xffffu) | (uint32_t)in.m[k] << 16));
        CHECK(out.row[VERB_add_halves][k] == (uint32_t)half_of(in.i[k]) * (uint32_t)half_of(in.m[k]) +
                                                 (uint32_t)(in.i[k] >> 16) * (uint32_t)(in.m[k] >> 16));
        CHECK(out.row[VERB_load_u16][k] == bits_of((float)in.surface_u16[p]));
        CHECK(out.stored_u16[p] == (uint16_t)in.code[k]);
        CHECK(out.put_u32[p] == (mine ? in.id : in.surface_u32[p]));
        CHECK(out.put_u16[p] == (mine ? (uint16_t)in.id : in.surface_u16[p]));
    }
    for (int p = 8; p < step; ++p) {
        CHECK(out.stored_u16[p] == in.surface_u16[p] && out.put_u16[p] == in.surface_u16[p] &&
              out.put_u32[p] == in.surface_u32[p]);
    }
}

void test_verbs_scalar(void)
{
    test_rules();
    test_rows(8);
    test_rows(11);
}
