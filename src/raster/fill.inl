/* fill.inl: one triangle into one tile: coverage, depth test, id.
 *
 * Per pixel: three edge sums, the depth plane clamped to the triangle's own range, a strict "nearer than" test. The
 * order (d + dy y) + dx x is the contract; a vector only changes how many x run at once. */

static inline lane fill_depth_16(lane d, const lmb_fill_job *job)
{
    lane code = lane_add(lane_mul(d, lane_splat(job->d_scale)), lane_splat(job->d_bias));
    return lane_trunc(lane_max(lane_min(code, lane_splat(65535.0f)), lane_splat(0.0f)));
}

static inline void fill_id(const lmb_fill_tile *tile, int at, uint32_t id, lane_mask pass)
{
    if (tile->id_format == LMB_ID32) {
        lane_put_u32((uint32_t *)tile->id + at, id, pass);
    } else if (tile->id_format == LMB_ID16) {
        lane_put_u16((uint16_t *)tile->id + at, id, pass);
    }
}

static inline lane_mask fill_depth(const lmb_fill_tile *tile, const lmb_fill_job *job, int at, lane d, lane_mask in)
{
    if (tile->depth_format == LMB_DEPTH32F) {
        float *p = (float *)tile->depth + at;
        lane old = lane_load(p);
        lane_mask pass = mask_and(in, lane_lt(old, d));
        lane_store(p, lane_pick(pass, d, old));
        return pass;
    }
    uint16_t *p = (uint16_t *)tile->depth + at;
    lane old = lane_load_u16(p);
    lane code = fill_depth_16(d, job);
    lane_mask pass = mask_and(in, lane_lt(old, code));
    lane_store_u16(p, lane_pick(pass, code, old));
    return pass;
}

static void KERNEL(fill)(const lmb_fill_tile *tile, const lmb_fill_job *job)
{
    int32_t step[3][LMB_TILE];
    float step_d[LMB_TILE];
    for (int x = 0; x < LMB_TILE; ++x) {
        for (int e = 0; e < 3; ++e) {
            step[e][x] = job->e[e] + job->ex[e] * x;
        }
        step_d[x] = job->dx * (float)x;
    }
    const lane d_min = lane_splat(job->d_min), d_max = lane_splat(job->d_max);
    for (int y = 0; y < LMB_TILE; ++y) {
        const lane row_d = lane_splat(job->d + job->dy * (float)y);
        for (int x = 0; x < LMB_TILE; x += LANES) {
            lanei e = lanei_add(lanei_load(step[0] + x), lanei_splat(job->ey[0] * y));
            e = lanei_or(e, lanei_add(lanei_load(step[1] + x), lanei_splat(job->ey[1] * y)));
            e = lanei_or(e, lanei_add(lanei_load(step[2] + x), lanei_splat(job->ey[2] * y)));
            lane_mask in = lanei_not_negative(e);
            if (mask_bits(in)) {
                lane d = lane_min(lane_max(lane_add(row_d, lane_load(step_d + x)), d_min), d_max);
                lane_mask pass = fill_depth(tile, job, y * tile->depth_step + x, d, in);
                fill_id(tile, y * tile->id_step + x, job->id, pass);
            }
        }
    }
}
