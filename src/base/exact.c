/* exact.c: tests at run time the properties of the target that exact.h cannot check. Layer 1.
 *
 * Operands are volatile, so that the results come from compiled code and not from the compiler's arithmetic. */
#include "exact.h"

#include <stdint.h>

#include "vec.h"

static int are_same(const volatile float *got, const float *right, int32_t count)
{
    int same = 1;
    for (int32_t i = 0; i < count; ++i) {
        same &= got[i] == right[i];
    }
    return same;
}

/* 1 + 2^-12 squared is 1 + 2^-11 + 2^-24: rounding drops the last term, a fused multiply-subtract keeps it. */
static int float_is_plain(void)
{
    static const float zeros[3] = {0.0f, 0.0f, 0.0f};
    volatile float v_a = 1.000244140625f, v_c = 1.00048828125f, v_big = 16777216.0f, v_one = 1.0f;
    float a = v_a, c = v_c, big = v_big, one = v_one;
    volatile float got[3] = {a * a - c, -c + a * a, (big + one) - big};
    return are_same(got, zeros, 3);
}

/* As operands and as results: denormals must not be flushed to 0. */
static int denormals_are_kept(void)
{
    static const float right[3] = {0x1p-127f, 0x1p-40f, 0x1p-141f};
    volatile float tiny = 0x1p-140f, half = 0.5f, min = FLT_MIN, huge = 0x1p+100f;
    volatile float got[3] = {min * half, tiny * huge, tiny * half};
    return are_same(got, right, 3);
}

static int double_is_binary64(void)
{
    volatile double big = 9007199254740992.0, one = 1.0;
    double sum = big + one;
    volatile double excess = sum - big;
    return DBL_MANT_DIG == 53 && DBL_MAX_EXP == 1024 && excess == 0.0;
}

static int integers_are_usual(void)
{
    volatile int32_t a = -5;
    volatile int64_t b = -INT64_C(0x500000001);
    volatile float up = 2.75f, down = -2.75f;
    return a >> 1 == -3 && b >> 32 == -6 && (int32_t)up == 2 && (int32_t)down == -2;
}

/* An edge function: clang 14 on 32-bit MIPS inverts the sign. */
static int edges_have_their_sign(void)
{
    volatile int32_t v = 300000;
    int32_t a = v, b = v, c = v, d = v - 1;
    int64_t area = (int64_t)a * b - (int64_t)c * d;
    return area == 300000;
}

/* Roots close to the middle of two floats, where an estimate rounds wrong; and floors. */
static int roots_and_floors_are_exact(void)
{
    static const float of[8] = {2.0f,     0x1.fffffep-1f, 0x1.000002p+0f, 0x1.fffffep+1f,
                                0x1p-140f, -0.3333f,       -7.0f,          -8388607.5f};
    static const float right[8] = {0x1.6a09e6p+0f, 0x1.fffffep-1f, 1.0f,  0x1.fffffep+0f,
                                   0x1p-70f,       -1.0f,          -7.0f, -8388608.0f};
    volatile float got[8];
    for (int i = 0; i < 8; ++i) {
        volatile float v = of[i];
        got[i] = i < 5 ? sqrtf(v) : floorf(v);
    }
    return are_same(got, right, 8);
}

/* Constant operands too: x / 3 is not x * (1 / 3), -0 + 0 is not -0, and (x + 2^24) - 2^24 is not x. */
static int constants_are_not_folded(void)
{
    volatile float v_five = 5.0f, v_minus = -0.0f, v_one = 1.0f;
    float five = v_five, minus = v_minus, one = v_one;
    volatile float third = five / 3.0f, zero = minus + 0.0f, sum = (one + 16777216.0f) - 16777216.0f;
    return third == 0x1.aaaaaap+0f && 1.0f / zero > 0.0f && sum == 0.0f;
}

static lmb_vec3 returned(lmb_vec3 v) { return v; }

/* Three floats are returned in two registers of two: tcc 0.9.27 on x86-64 stores both whole, and the fourth float
 * overwrites the local beside the struct. Stack alignment decides which of these two locals is beside it. */
static int neighbours_are_kept(void)
{
    volatile float v_one = 1.0f;
    const lmb_vec3 ones[2] = {{v_one, v_one, v_one}, {v_one, v_one, v_one}};
    float sum = 0.0f, first = v_one + 2.0f;
    sum += returned(returned(ones[0])).x;
    float second = v_one + 4.0f;
    sum += returned(returned(ones[0])).x;
    return sum == 2.0f && first == 3.0f && second == 5.0f;
}

int lmb_base_is_exact(void)
{
    return float_is_plain() && denormals_are_kept() && double_is_binary64() && integers_are_usual() &&
           edges_have_their_sign() && roots_and_floors_are_exact() && constants_are_not_folded() &&
           neighbours_are_kept();
}
