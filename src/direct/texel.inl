/* texel.inl: the power through texels of a row of a shadow map, of a light of 1 W/sr, or 1 W/m2 of suns. Layer 4. */
#ifndef LMB_MAP_TEXEL_INL
#define LMB_MAP_TEXEL_INL

/* Solid angle of a texel of side p at distance 1, with the centre l away: p^2 / l^3 times the second-order term of the
 * integral of 1 / |x|^3 over the square. Differences of corner formulas cancel in binary32; this does not. */
LANE_INLINE lane texel_solid_angle(float p, lane x, float y)
{
    const lane one = lane_splat(1.0f), l2 = lane_add(lane_add(one, lane_mul(x, x)), lane_splat(y * y));
    const lane order = lane_sub(lane_mul(lane_splat(9.0f), lane_sub(l2, one)), lane_splat(6.0f));
    const lane more = lane_div(lane_mul(lane_splat(p * p * (1.0f / 24.0f)), order), lane_mul(l2, l2));
    return lane_mul(lane_div(lane_splat(p * p), lane_mul(l2, lane_sqrt(l2))), lane_add(one, more));
}

/* Fall-off of a spot towards the point (x, y) at distance 1. */
LANE_INLINE lane texel_spot(const lmb_texel_row *row, lane x, float y)
{
    const lane zero = lane_splat(0.0f), one = lane_splat(1.0f), outer = lane_splat(row->cos_outer);
    const lmb_vec3 right = row->right, up = row->up, back = row->back;
    lane3 ray;
    ray.x = lane_sub(lane_add(lane_mul(lane_splat(right.x), x), lane_splat(up.x * y)), lane_splat(back.x));
    ray.y = lane_sub(lane_add(lane_mul(lane_splat(right.y), x), lane_splat(up.y * y)), lane_splat(back.y));
    ray.z = lane_sub(lane_add(lane_mul(lane_splat(right.z), x), lane_splat(up.z * y)), lane_splat(back.z));
    const lane cosine = lane_div(lane3_dot(lane3_of(row->direction), ray), lane_sqrt(lane3_dot(ray, ray)));
    lane t = one;
    if (row->cone > 1e-6f) {
        t = lane_div(lane_sub(cosine, outer), lane_splat(row->cone));
        t = lane_min(lane_max(t, zero), one);
    }
    t = lane_mul(lane_mul(t, t), lane_sub(lane_splat(3.0f), lane_mul(lane_splat(2.0f), t)));
    return lane_keep(lane_lt(outer, cosine), t);
}

/* Averaged over the 2x2 quarter centres of a texel. */
LANE_INLINE lane texel_spot_share(const lmb_texel_row *row, lane sx)
{
    lane share = lane_splat(0.0f);
    for (int q = 0; q < 4; ++q) {
        const lane x = lane_add(sx, lane_splat((q & 1 ? 0.25f : -0.25f) * row->side_x));
        share = lane_add(share, texel_spot(row, x, row->sy + (q & 2 ? 0.25f : -0.25f) * row->side_y));
    }
    return lane_mul(share, lane_splat(0.25f));
}

static void KERNEL(texel_powers)(float *out, const float *sx, int32_t count, const lmb_texel_row *row)
{
    for (int32_t i = 0; i < count; i += LANES) {
        const lane x = lane_load(sx + i);
        lane power = row->is_far ? lane_splat(row->side_x * row->side_y) : texel_solid_angle(row->side_x, x, row->sy);
        if (row->is_coned) {
            power = lane_mul(power, texel_spot_share(row, x));
        }
#if LMB_TREES
        if (row->finer_half > 0.0f) {
            const lane_mask finer =
                lane_lt(lane_abs(lane_sub(x, lane_splat(row->finer_x))), lane_splat(row->finer_half));
            power = lane_keep(mask_not(finer), power);
        }
#endif
        lane_store(out + i, power);
    }
}

#endif
