/* direct.inl: irradiance of one light at each pixel of a tile, without shadows. Layer 4. */

static inline lane direct_falloff(const lmb_direct_job *job, lane cosine)
{
    const lane zero = lane_splat(0.0f), one = lane_splat(1.0f);
    lane t = lane_mul(lane_sub(cosine, lane_splat(job->cos_outer)), lane_splat(job->cone_scale));
    t = lane_min(lane_max(t, zero), one);
    return lane_mul(lane_mul(t, t), lane_sub(lane_splat(3.0f), lane_mul(lane_splat(2.0f), t)));
}

/* light_within for a lane. */
static inline lane direct_within(lane d2, lane range2)
{
    const lane one = lane_splat(1.0f);
    const lane t = lane_min(lane_div(lane_max(d2, lane_mul(range2, lane_splat(0x1p-40f))), range2), one);
    return lane_sub(one, lane_mul(t, t));
}

static void KERNEL(direct)(lmb_irradiance *out, const lmb_tile *tile, const lmb_direct_job *job)
{
    const lane zero = lane_splat(0.0f), one = lane_splat(1.0f);
    const lane3 travel = lane3_splat(job->direction.x, job->direction.y, job->direction.z);
    const lane3 from = lane3_splat(job->position.x, job->position.y, job->position.z);
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        lane3 n = lane3_load(tile->normal, k), face = lane3_load(tile->face, k);
        lane3 to; /* towards the light, unit */
        lane e = one;
        if (light_kind_is(job->kind, LIGHT_FAR)) {
            to = lane3_sub(lane3_splat(0.0f, 0.0f, 0.0f), travel);
        } else {
            to = lane3_sub(from, lane3_load(tile->position, k));
            const lane d2 = lane3_dot(to, to);
            lane inverse2 = lane_div(one, lane_max(d2, lane_splat(1e-24f)));
            to = lane3_scale(to, lane_sqrt(inverse2));
            e = inverse2;
            if (LMB_TREES && job->range2 > 0.0f) {
                e = lane_mul(e, direct_within(d2, lane_splat(job->range2)));
            }
            if (light_kind_is(job->kind, LIGHT_CONED)) {
                e = lane_mul(e, direct_falloff(job, lane_sub(zero, lane3_dot(to, travel))));
            }
        }
        /* The face normal keeps light from the back off pixels with smooth normals. */
        lane cosine = lane_keep(lane_lt(zero, lane3_dot(face, to)), lane_max(lane3_dot(n, to), zero));
        e = lane_mul(e, cosine);
        for (int c = 0; c < 3; ++c) {
            lane_store(out->rgb[c] + k, lane_mul(e, lane_splat(job->intensity[c])));
        }
    }
}
