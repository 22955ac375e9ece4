/* shadow.inl: tests pixels of a tile against a shadow map by lanes, and adds the light of lit pixels. Layer 4. */

/* Masks the lanes whose direction d belongs to a face of a cube map. Chooses faces as choose_shadow_face does. */
LANE_INLINE lane_mask shadow_is_in_face(lane3 d, int32_t face)
{
    const lane x = lane_abs(d.x), y = lane_abs(d.y), z = lane_abs(d.z), zero = lane_splat(0.0f);
    const lane_mask first = mask_and(lane_le(y, x), lane_le(z, x)), second = lane_le(z, y);
    const lane_mask axis = face < 2    ? first
                           : face < 4 ? mask_and(mask_not(first), second)
                                      : mask_and(mask_not(first), mask_not(second));
    const lane_mask negative = lane_lt(face < 2 ? d.x : face < 4 ? d.y : d.z, zero);
    return mask_and(axis, face % 2 != 0 ? negative : mask_not(negative));
}

LANE_INLINE lanei shadow_texel(const lmb_shadow_job *job, lanei x, lanei y)
{
    const lanei in_tile = lanei_splat(LMB_TILE - 1);
    const lanei tile = lanei_add(lanei_mul(lanei_shift(y, 3), lanei_splat(job->row)),
                                 lanei_mul(lanei_shift(x, 3), lanei_splat(job->tile)));
    const lanei at = lanei_add(tile, lanei_add(lanei_mul(lanei_and(y, in_tile), lanei_splat(job->step)),
                                               lanei_and(x, in_tile)));
    return job->is_16 ? lane_to_int(lane_gather_u16((const uint16_t *)job->id, at))
                      : lanei_gather_i32((const int32_t *)job->id, at);
}

/* The texel to the left of a place (or above it), and the next texel; both inside the map. */
LANE_INLINE void shadow_texels(lanei out[2], lane at, int32_t last)
{
    const lane from = lane_sub(at, lane_splat(0.5f)); /* above -1 */
    const lanei zero = lanei_splat(0), one = lanei_splat(1), down = lane_to_int(from);
    const lanei first = lanei_pick(lane_lt(from, lane_splat(0.0f)), lanei_sub(down, one), down);
    out[0] = lanei_max(first, zero);
    out[1] = lanei_min(lanei_add(first, one), lanei_splat(last));
}

/* Returns the requested pixels in the job's face that are certainly lit. A pixel is certainly lit if it lies outside
 * the map, or if all four texels around it show the pixel's own triangle. *in: the pixels in the face. seen: the ids of
 * the four texels around each pixel. Uses the formulas of find_place and four_ids. */
static uint32_t KERNEL(shadow_own)(uint32_t *in, uint32_t (*seen)[LMB_SHADOW_PIXELS], const lmb_tile *tile, int first,
                                   uint32_t asked, const lmb_shadow_job *job)
{
    const lmb_view *v = job->view;
    const lane zero = lane_splat(0.0f), half = lane_splat(0.5f), size = lane_splat(job->size);
    const int32_t last = (int32_t)job->size - 1;
    uint32_t out = 0;
    *in = 0;
    for (int i = 0; i < LMB_SHADOW_PIXELS; i += LANES) {
        const int k = first + i;
        const uint32_t some = asked >> i & ALL_LANES;
        if (some == 0) {
            continue;
        }
        const lane3 p = lane3_load(tile->position, k), d = lane3_sub(p, lane3_of(v->eye));
        const lane w = lane_sub(zero, lane3_dot(lane3_of(v->back), d));
        const lane unit = v->kind == LMB_PERSPECTIVE ? w : lane_splat(1.0f);
        const lane right = lane_div(lane3_dot(lane3_of(v->right), d), lane_mul(unit, lane_splat(v->half_width))),
                   up = lane_div(lane3_dot(lane3_of(v->up), d), lane_mul(unit, lane_splat(v->half_height)));
        const lane x = lane_mul(lane_add(lane_mul(right, half), half), size),
                   y = lane_mul(lane_sub(half, lane_mul(up, half)), size);
        lane_mask face = mask_of_bits(some);
        if (job->face >= 0) {
            face = mask_and(face, shadow_is_in_face(lane3_sub(p, lane3_of(job->light)), job->face));
        }
        const lane_mask inside =
            mask_and(mask_and(mask_and(face, lane_lt(zero, unit)), mask_and(lane_le(zero, x), lane_le(zero, y))),
                     mask_and(lane_le(x, size), lane_le(y, size)));
        const lanei id = lanei_load((const int32_t *)(const void *)(tile->id + k));
        lanei column[2], row[2];
        shadow_texels(column, lane_keep(inside, x), last);
        shadow_texels(row, lane_keep(inside, y), last);
        lane_mask own = inside;
        for (int q = 0; q < 4; ++q) {
            const lanei shown = shadow_texel(job, column[q & 1], row[q >> 1]);
            lanei_store((int32_t *)(void *)(seen[q] + i), shown);
            own = mask_and(own, lanei_equal(id, shown));
        }
        const uint32_t found = mask_bits(face);
        *in |= found << i;
        out |= (found & (~mask_bits(inside) | mask_bits(own))) << i;
    }
    return out;
}

/* Tests pairs of a pixel and a triangle as ask_from does. Sets masks of pairs. */
static void KERNEL(shadow_ask)(lmb_shadow_answers *out, const lmb_shadow_pairs *pairs, const lmb_tile *tile)
{
    const lane zero = lane_splat(0.0f);
    memset(out, 0, sizeof *out);
    for (int i = 0; i < pairs->count; i += LANES) {
        const lanei pixel = lanei_load(pairs->pixel + i);
        lane3 p, corner[3];
        p.x = lane_gather_f32(tile->position[0], pixel);
        p.y = lane_gather_f32(tile->position[1], pixel);
        p.z = lane_gather_f32(tile->position[2], pixel);
        for (int c = 0; c < 3; ++c) {
            corner[c].x = lane_load(pairs->corner[c][0] + i);
            corner[c].y = lane_load(pairs->corner[c][1] + i);
            corner[c].z = lane_load(pairs->corner[c][2] + i);
            corner[c] = lane3_sub(corner[c], p);
        }
        const lane3 from_eye = lane3_sub(p, lane3_of(pairs->eye)),
                    towards = pairs->is_far ? lane3_of(pairs->light) : lane3_sub(lane3_of(pairs->light), p);
        const lane noise = lane_add(lane_mul(lane_splat(SHADOW_NOISE_PIXEL), lane_sqrt(lane3_dot(from_eye, from_eye))),
                                    lane_mul(lane_splat(SHADOW_NOISE_PLACE), lane_sqrt(lane3_dot(p, p))));
        const lane3 n = lane3_cross(lane3_sub(corner[1], corner[0]), lane3_sub(corner[2], corner[0]));
        const lane nn = lane3_dot(n, n);
        const lane_mask some = lane_lt(lane_splat(1e-36f), nn);
        const lane length = lane_sqrt(lane_pick(some, nn, lane_splat(1.0f)));
        const lane height = lane_div(lane3_dot(n, corner[0]), length), rise = lane_div(lane3_dot(n, towards), length);
        const lane_mask through = lane_le(lane_abs(height), noise);
        const lane e0 = lane3_dot(towards, lane3_cross(corner[1], corner[2])),
                   e1 = lane3_dot(towards, lane3_cross(corner[2], corner[0])),
                   e2 = lane3_dot(towards, lane3_cross(corner[0], corner[1]));
        const lane_mask plus = mask_and(mask_and(lane_le(zero, e0), lane_le(zero, e1)), lane_le(zero, e2)),
                        minus = mask_and(mask_and(lane_le(e0, zero), lane_le(e1, zero)), lane_le(e2, zero));
        const lane_mask over = mask_and(some, mask_or(plus, minus));
        const lane sum = lane_add(lane_add(e0, e1), e2);
        lane_mask ahead = mask_and(lane_lt(zero, lane_mul(height, rise)),
                                   mask_or(lane_lt(zero, sum), lane_lt(sum, zero)));
        if (pairs->is_wide) {
            ahead = mask_and(ahead, lane_lt(lane_abs(height), lane_abs(rise)));
        }
        const uint32_t bits = mask_bits(over), shadows = bits & mask_bits(ahead);
        out->through |= (mask_bits(mask_and(some, through)) & ALL_LANES) << i;
        out->shadows |= (shadows & ALL_LANES) << i;
        out->over |= (bits & ~shadows & ALL_LANES) << i;
    }
}

/* Pixels with a surface and light. */
static uint64_t KERNEL(direct_shown)(const lmb_irradiance *light, const lmb_tile *tile)
{
    const lane zero = lane_splat(0.0f);
    uint64_t out = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        lane_mask dark = lane_le(lane_load(light->rgb[0] + k), zero);
        dark = mask_and(dark, lane_le(lane_load(light->rgb[1] + k), zero));
        dark = mask_and(dark, lane_le(lane_load(light->rgb[2] + k), zero));
        dark = mask_or(dark, lanei_equal(lanei_load((const int32_t *)(const void *)(tile->id + k)), lanei_splat(0)));
        out |= (uint64_t)(~mask_bits(dark) & ALL_LANES) << k;
    }
    return out;
}

/* Adds the light of some pixels. */
static void KERNEL(direct_add)(lmb_irradiance *inout, const lmb_irradiance *light, uint64_t some)
{
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        const lane_mask own = mask_of_bits((uint32_t)(some >> k) & ALL_LANES);
        for (int c = 0; c < 3; ++c) {
            const lane before = lane_load(inout->rgb[c] + k);
            lane_store(inout->rgb[c] + k,
                       lane_pick(own, lane_add(before, lane_load(light->rgb[c] + k)), before));
        }
    }
}
