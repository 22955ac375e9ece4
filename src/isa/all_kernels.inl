/* all_kernels.inl: every kernel by one backend's verbs, and their table. Layer 9.
 *
 * The including file defines KERNEL(name), and BACKEND: the name for lmb_kernels_named. */
#include "../lane/kernels.h"
#include "../lane/lane.h"

#include "../raster/setup.inl"
#include "../raster/fill.inl"
#include "../raster/fill_small.inl"
#include "../raster/fill_large.inl"
#if LMB_CULLING
#include "../raster/culled.inl"
#include "../raster/bins.inl"
#endif
#include "../raster/resolve.inl"
#include "../raster/texture.inl"
#if LMB_TREES
#include "../raster/masked.inl"
#endif
#include "../direct/direct.inl"
#if LMB_SHADOW_LANES
#include "../direct/shadow.inl"
#endif
#if LMB_BOUNCE
#include "../bounce/gather.inl"
#endif
#include "../frame/blend.inl"
#include "../frame/encode.inl"
#if LMB_TREES
#include "../tree/gather_cut.inl"
#include "../tree/node_bounds.inl"
#include "../tree/many_lights.inl"
#include "../occlusion/crossed.inl"
#include "../occlusion/sun.inl"
#endif
#if LMB_LIVE
#include "../live/live_sum.inl"
#include "../frame/live_fill.inl"
#endif
#if LMB_LOBES
#include "../direct/lobe.inl"
#endif
#if LMB_TREES
#include "../tree/gather_glossy.inl"
#endif
#if LMB_DRAW_LANES
#include "../draw/draw_lanes.inl"
#include "../draw/draw_area.inl"
#include "../draw/draw_small.inl"
#endif
#if LMB_TRANSFER
#include "../direct/texel.inl"
#include "../transfer/links.inl"
#include "../transfer/coverage.inl"
#include "../transfer/halve.inl"
#include "../transfer/tile.inl"
#endif
#if LMB_PROBES
#include "../probe/remap.inl"
#include "../probe/share.inl"
#include "../probe/cosine.inl"
#include "../probe/blur.inl"
#endif
#if LMB_VOXELS
#include "../mixed/cone.inl"
#endif
#if LMB_RELIEF
#include "../relief/warp.inl"
#endif

static float KERNEL(probe)(float one_and_bit)
{
    float r[LANES];
    lane a = lane_splat(one_and_bit);
    lane_store(r, lane_sub(lane_mul(a, a), lane_splat(1.00048828125f)));
    return r[0];
}

const lmb_kernels KERNEL(lmb_kernels) = {
    BACKEND,
    LANES,
    KERNEL(setup),
    KERNEL(fill_small),
    KERNEL(fill_large),
    KERNEL(resolve_shown),
    KERNEL(resolve_slots),
    KERNEL(resolve_setup),
    KERNEL(resolve),
    KERNEL(texture),
    KERNEL(direct),
#if LMB_SHADOW_LANES
    KERNEL(shadow_own),
    KERNEL(shadow_ask),
    KERNEL(direct_shown),
    KERNEL(direct_add),
#endif
#if LMB_BOUNCE
    KERNEL(gather),
    KERNEL(gather_near),
#endif
    KERNEL(blend),
    KERNEL(encode),
    KERNEL(probe),
#if LMB_CULLING
    KERNEL(culled_small),
    KERNEL(culled_large),
    KERNEL(culled_box),
    KERNEL(bin_snap),
    KERNEL(bin_setup),
    KERNEL(bin_box),
#endif
#if LMB_TREES
    MASKED_SEEN_KERNEL,
    MASKED_PARTS_KERNEL,
    MASKED_KERNEL,
    KERNEL(gather_cut),
    KERNEL(node_bounds),
    KERNEL(crossed),
    KERNEL(segments),
    KERNEL(through),
    KERNEL(meets),
    KERNEL(meets_one),
    KERNEL(sun_crossed),
    KERNEL(sun_meets),
    KERNEL(many_lights_bounds),
    KERNEL(glossy_cut),
    KERNEL(many_lights_irradiance),
#endif
#if LMB_LOBES
    KERNEL(glossy_direct),
#endif
#if LMB_TRANSFER
    KERNEL(transfer_links),
    KERNEL(transfer_directed_links),
    KERNEL(texel_powers),
    KERNEL(transfer_share),
    KERNEL(transfer_halve),
    KERNEL(transfer_side),
    KERNEL(transfer_leaf),
#endif
#if LMB_PROBES
    KERNEL(remap),
    KERNEL(see),
    KERNEL(world_radiance),
    KERNEL(share),
    KERNEL(cosine),
    KERNEL(blur),
#endif
#if LMB_VOXELS
    KERNEL(cone),
#endif
#if LMB_RELIEF
    KERNEL(relief_rank),
    KERNEL(relief_warp),
#endif
#if LMB_LIVE
    KERNEL(live_values),
    KERNEL(live_places),
    KERNEL(live_sums),
    KERNEL(live_targets),
    KERNEL(live_sky),
    KERNEL(live_picks),
    KERNEL(live_above),
    KERNEL(live_ahead),
    KERNEL(live_share),
    KERNEL(live_boxes),
    KERNEL(live_beyond),
    KERNEL(live_crossed),
    KERNEL(live_fill),
#endif
#if LMB_DRAW_LANES
    KERNEL(draw_cover),
    KERNEL(draw_test),
    KERNEL(draw_paint),
#if defined(LANE_PLAIN)
    NULL,
    NULL,
    NULL,
    NULL,
    NULL,
    NULL,
    NULL,
#else
    KERNEL(draw_sheet),
    KERNEL(draw_area),
#if LANES <= LMB_TILE
    KERNEL(draw_small),
#elif LMB_HAVE_AVX2
    lmb_draw_small_avx2,
#else
    NULL,
#endif
    KERNEL(draw_shares),
    KERNEL(draw_steps),
    KERNEL(draw_dots),
    KERNEL(draw_put),
#endif
    KERNEL(draw_fill),
#endif
};
