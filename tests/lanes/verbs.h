/* verbs.h: every lane verb applied to one set of inputs; each backend's rows are compared with scalar's. */
#ifndef TEST_VERBS_H
#define TEST_VERBS_H

#include <stdint.h>

#include "../../src/lane/backends.h"

/* Pixels of an input: the vector of the widest backend. As two rows in memory: the values of both and those between. */
enum { VERB_LANES = 16, VERB_SURFACE = 22, VERB_TABLE = 40 };

typedef struct verb_input {
    float a[VERB_LANES], b[VERB_LANES], c[VERB_LANES]; /* any bits */
    float whole[VERB_LANES];                           /* in the range of int32 */
    float code[VERB_LANES];                            /* 0 .. 65535, whole */
    int32_t i[VERB_LANES], j[VERB_LANES];              /* i|, |j| < 2^30, with many equal pairs */
    int32_t m[VERB_LANES], n[VERB_LANES];              /* |m n| < 2^31 */
    int32_t at[VERB_LANES];                            /* 0 .. VERB_TABLE - 1 */
    int32_t shift;                                     /* 0 .. 31 */
    int32_t step;                                      /* distance of rows: 8 or 11 */
    float table_f32[VERB_TABLE], surface_f32[VERB_SURFACE];
    uint16_t table_u16[VERB_TABLE], surface_u16[VERB_SURFACE];
    uint32_t surface_u32[VERB_SURFACE];
    uint8_t table_rgba[4 * VERB_TABLE];
    uint32_t bits, id;
} verb_input;

/* X(name, results): FLOAT: all NaNs are equal, because processors produce different ones. */
#define VERBS(X) \
    X(splat, BITS) X(load, BITS) X(add, FLOAT) X(sub, FLOAT) X(mul, FLOAT) X(div, FLOAT) X(sqrt, FLOAT) X(min, BITS) \
    X(max, BITS) X(lt, BITS) X(le, BITS) X(pick, BITS) X(keep, BITS) X(mask_and, BITS) X(mask_or, BITS) \
    X(mask_not, BITS) X(mask_bits, BITS) X(mask_of_bits, BITS) X(i_splat, BITS) X(i_add, BITS) X(i_or, BITS) \
    X(i_and, BITS) X(i_mul, BITS) X(i_shift, BITS) X(i_not_negative, BITS) X(i_equal, BITS) X(to_int, BITS) \
    X(trunc, BITS) X(gather_f32, BITS) X(gather_u16, BITS) X(load_rows, BITS) X(load_u16, BITS) X(column, BITS) \
    X(row, BITS) X(affine, BITS) X(dot, FLOAT) X(i_sub, BITS) X(i_min, BITS) X(i_max, BITS) X(i_pick, BITS) \
    X(i_lt, BITS) X(from_int, BITS) X(table, BITS) X(gather_rgba, BITS) X(gather_i32, BITS) X(sums, BITS) \
    X(from_double, BITS) X(codes_times, BITS) X(codes_over, BITS) X(codes_plus, BITS) X(codes_same, BITS) \
    X(codes_between, BITS) X(gather_pairs, BITS) X(load_some, BITS) X(part, BITS) X(i_within, BITS) \
    X(halves, BITS) X(add_halves, BITS)
enum {
#define VERB_NAME(name, results) VERB_##name,
    VERBS(VERB_NAME)
#undef VERB_NAME
    VERB_COUNT
};

/* Verbs of binary64, on ordinary values. */
enum { VERB_D_splat, VERB_D_add, VERB_D_sub, VERB_D_mul, VERB_D_div, VERB_D_from_int, VERB_D_load, VERB_D_COUNT };

typedef struct verb_output {
    uint32_t row[VERB_COUNT][VERB_LANES];
    float stored_f32[VERB_SURFACE];
    uint16_t stored_u16[VERB_SURFACE], put_u16[VERB_SURFACE];
    uint32_t put_u32[VERB_SURFACE], stored_some[VERB_SURFACE];
    double d[VERB_D_COUNT][VERB_LANES];
} verb_output;

/* verbs_sse2 ...: the backends of the build. */
#define VERBS_OF(upper, lower) void verbs_##lower(verb_output *out, const verb_input *in);
LMB_BACKENDS(VERBS_OF)
#undef VERBS_OF

/* Runs hard and random inputs and compares each backend's rows with scalar's. `run` is called only if the
 * backend runs on this processor. */
void verbs_compare(const char *backend, void (*run)(verb_output *out, const verb_input *in));

#endif
