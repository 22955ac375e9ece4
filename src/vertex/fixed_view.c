/* fixed_view.c: a camera's axes. Layer 8. */
#include <lambent/fixed.h>

#include "fixed_part.h"
#include "number.h"

static uint32_t far2_of(const int32_t v[3])
{
    return (uint32_t)(v[0] * v[0]) + (uint32_t)(v[1] * v[1]) + (uint32_t)(v[2] * v[2]);
}

/* Scales to the length LMB_FIXED_ONE, within 2^-12; components are below 2^15. Returns 0 if the length is 0. */
static int make_one(int32_t v[3])
{
    uint32_t far2 = far2_of(v);
    if (far2 >= 1u << 30) {
        v[0] >>= 1, v[1] >>= 1, v[2] >>= 1;
        far2 = far2_of(v);
    }
    if (far2 == 0) {
        return 0;
    }
    const int32_t k = (zeros_above(far2) - 2) >> 1;
    const uint32_t m = far2 << (2 * k), per = high_of(inverse_cube(m) << 2, m << 2); /* 2^30 / (length << k) */
    for (int i = 0; i < 3; ++i) {
        v[i] = (v[i] * (1 << k) * (int32_t)(per >> 1) + 16384) >> 15;
    }
    return 1;
}

static int is_far(const int32_t v[3], int32_t reach)
{
    for (int i = 0; i < 3; ++i) {
        if (v[i] < -reach || v[i] > reach) {
            return 1;
        }
    }
    return 0;
}

lmb_status lmb_fixed_look_at(lmb_fixed_view *inout, const int32_t eye[3], const int32_t target[3])
{
    if (inout == NULL || eye == NULL || target == NULL || is_far(eye, LMB_FIXED_EYE) ||
        is_far(target, LMB_FIXED_REACH)) {
        return LMB_ERR_ARG;
    }
    int32_t back[3] = {eye[0] - target[0], eye[1] - target[1], eye[2] - target[2]};
    if (!make_one(back)) {
        return LMB_ERR_ARG;
    }
    /* half, to stay below 2^14 */
    int32_t right[3] = {back[2] >> 1, 0, -back[0] >> 1};
    if (!make_one(right)) {
        return LMB_ERR_ARG;
    }
    for (int i = 0; i < 3; ++i) {
        const int a = i == 2 ? 0 : i + 1, b = i == 0 ? 2 : i - 1;
        inout->eye[i] = eye[i];
        inout->axis[0][i] = right[i];
        inout->axis[1][i] = (back[a] * right[b] - back[b] * right[a]) >> 14;
        inout->axis[2][i] = back[i];
    }
    return LMB_OK;
}
