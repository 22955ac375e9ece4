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
        lane_put_u32((uint32_t *)tile->id + at, tile->id_step, id, pass);
    } else if (tile->id_format == LMB_ID16) {
        lane_put_u16((uint16_t *)tile->id + at, tile->id_step, id, pass);
    }
}

static inline lane_mask fill_depth(const lmb_fill_tile *tile, const lmb_fill_job *job, int at, lane d, lane_mask in)
{
    if (tile->depth_format == LMB_DEPTH32F) {
        float *p = (float *)tile->depth + at;
        lane old = lane_load_rows(p, tile->depth_step);
        lane_mask pass = mask_and(in, lane_lt(old, d));
        lane_store_rows(p, tile->depth_step, lane_pick(pass, d, old));
        return pass;
    }
    uint16_t *p = (uint16_t *)tile->depth + at;
    lane old = lane_load_u16(p, tile->depth_step);
    lane code = fill_depth_16(d, job);
    lane_mask pass = mask_and(in, lane_lt(old, code));
    lane_store_u16(p, tile->depth_step, lane_pick(pass, code, old));
    return pass;
}

/* Vectors beside each other in a row of tiles' pixels, and rows that one covers. */
enum { FILL_ACROSS = LANES < LMB_TILE ? LMB_TILE / LANES : 1, FILL_ROWS = LANES < LMB_TILE ? 1 : LANES / LMB_TILE };

static void KERNEL(fill)(const lmb_fill_tile *tile, const lmb_fill_job *job)
{
    lanei edge[3][FILL_ACROSS];
    lane step_d[FILL_ACROSS];
    for (int i = 0; i < FILL_ACROSS; ++i) {
        for (int e = 0; e < 3; ++e) {
            edge[e][i] = lanei_affine(job->e[e], job->ex[e], job->ey[e], i * LANES);
        }
        step_d[i] = lane_mul(lane_splat(job->dx), lane_column(i * LANES));
    }
    const lane d_min = lane_splat(job->d_min), d_max = lane_splat(job->d_max);
    for (int y = 0; y < LMB_TILE; y += FILL_ROWS) {
        const lane row_d = lane_add(lane_splat(job->d), lane_mul(lane_splat(job->dy), lane_row(y * LMB_TILE)));
        for (int i = 0; i < FILL_ACROSS; ++i) {
            lanei e = lanei_add(edge[0][i], lanei_splat(job->ey[0] * y));
            e = lanei_or(e, lanei_add(edge[1][i], lanei_splat(job->ey[1] * y)));
            e = lanei_or(e, lanei_add(edge[2][i], lanei_splat(job->ey[2] * y)));
            lane_mask in = lanei_not_negative(e);
            if (mask_bits(in)) {
                lane d = lane_min(lane_max(lane_add(row_d, step_d[i]), d_min), d_max);
                lane_mask pass = fill_depth(tile, job, y * tile->depth_step + i * LANES, d, in);
                fill_id(tile, y * tile->id_step + i * LANES, job->id, pass);
            }
        }
    }
}
