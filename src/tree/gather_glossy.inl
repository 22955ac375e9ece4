/* gather_glossy.inl: a cut of the light tree -> radiance from the glossy lobes of pixels that see its nodes. Layer 6.
 *
 * Lanes are pixels.
 *
 * Include gather.inl, for the disc, and lobe.inl first. */

/* Solid angle of a disc. On the axis of a facing disc it is consistent with disc_fraction: pi s / (1 + s), s = A / (pi
 * r^2). */
static inline lane glossy_angle(lane b, lane i, lane area_pi)
{
    const lane s = lane_mul(area_pi, i), pi = lane_splat(3.14159265f);
    const lane cosine = lane_mul(lane_max(b, lane_splat(0.0f)), lane_sqrt(i));
    return lane_mul(pi, lane_mul(cosine, lane_div(s, lane_add(lane_splat(1.0f), s))));
}

static inline lane3 glossy_emitter(lane3 sum, const lobe_pixels *px, lane3 at, lane3 face, const lmb_emitter *e)
{
    const lane zero = lane_splat(0.0f), one = lane_splat(1.0f);
    const lane3 to = lane3_sub(lane3_of(e->position), at), back = lane3_of(e->back);
    const lane r2 = lane_max(lane3_dot(to, to), lane_splat(1e-24f)), i = lane_div(one, r2);
    const lane a = lane3_dot(px->n, to), b = lane3_dot(back, to);
    const lane area_pi = lane_splat(e->area_pi);
    const lane_mask over = disc_faces(a, b, r2);
    lane top, bottom;
    lane3 light;
    disc_fraction(&top, &bottom, lane_keep(over, a), lane_keep(over, b), i, lane3_dot(px->n, back), area_pi);
    const lane_mask faces = mask_and(over, lane_lt(zero, lane3_dot(face, to)));
    const lane weight = lane_keep(faces, disc_value(top, bottom, i));
    light.x = lane_mul(weight, lane_splat(e->flux[0]));
    light.y = lane_mul(weight, lane_splat(e->flux[1]));
    light.z = lane_mul(weight, lane_splat(e->flux[2]));
    return lobe_add(sum, px, lane3_scale(to, lane_sqrt(i)), glossy_angle(b, i, area_pi), light);
}

static void KERNEL(glossy_cut)(lmb_glossy *inout, const lmb_tile *tile, const lmb_emitter *emitters, int32_t count)
{
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        const uint32_t own = (uint32_t)(inout->pixels >> k) & ALL_LANES;
        if (own == 0) {
            continue;
        }
        const lobe_pixels px = lobe_load(inout, tile, k);
        const lane3 at = lane3_load(tile->position, k), face = lane3_load(tile->face, k);
        lane3 sum = lobe_sum(inout, k);
        for (int32_t j = 0; j < count; ++j) {
            const uint32_t sees = (uint32_t)(emitters[j].visible >> k) & own;
            if (sees != 0) {
                sum = lane3_pick(mask_of_bits(sees), glossy_emitter(sum, &px, at, face, &emitters[j]), sum);
            }
        }
        lobe_store(inout, k, sum);
    }
}
