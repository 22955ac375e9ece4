/* all_kernels.inl: every kernel by one machine's verbs. KERNEL(name) and MACHINE are the including file's. */
#include "../lane/kernels.h"
#include "../lane/lane.h"

#include "../raster/fill.inl"
#include "../raster/resolve.inl"
#include "../light/direct.inl"
#include "../bounce/gather.inl"
#include "../compose/blend.inl"

static float KERNEL(probe)(float one_and_bit)
{
    float r[LANES];
    lane a = lane_splat(one_and_bit);
    lane_store(r, lane_sub(lane_mul(a, a), lane_splat(1.00048828125f)));
    return r[0];
}
