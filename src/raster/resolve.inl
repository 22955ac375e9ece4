/* resolve.inl: one triangle's attributes for the pixels of a tile that carry its id.
 *
 * The position is where the pixel's ray meets the triangle's own plane: no depth read back, no snapping error off the
 * plane. On a plane seen edge-on the quotient is clamped to the triangle's own range of w. */

static inline lane3 resolve_affine(lmb_vec3 at, lmb_vec3 per_x, lmb_vec3 per_y, lane x, lane y)
{
    lane3 r;
    r.x = lane_add(lane_splat(at.x), lane_add(lane_mul(lane_splat(per_x.x), x), lane_mul(lane_splat(per_y.x), y)));
    r.y = lane_add(lane_splat(at.y), lane_add(lane_mul(lane_splat(per_x.y), x), lane_mul(lane_splat(per_y.y), y)));
    r.z = lane_add(lane_splat(at.z), lane_add(lane_mul(lane_splat(per_x.z), x), lane_mul(lane_splat(per_y.z), y)));
    return r;
}

static inline void resolve_put(float *p, lane_mask mine, lane value)
{
    lane_store(p, lane_pick(mine, value, lane_load(p)));
}

/* Differences from corner 0, so that three equal corners give exactly their value. */
static inline lane resolve_mix(const float corner[3], lane b1, lane b2)
{
    return lane_add(lane_splat(corner[0]), lane_add(lane_mul(b1, lane_splat(corner[1] - corner[0])),
                                                    lane_mul(b2, lane_splat(corner[2] - corner[0]))));
}

/* The interpolated normal, unit length, on the face normal's side; the face normal where it vanishes. */
static inline lane3 resolve_normal(const lmb_resolve_job *job, lane b1, lane b2)
{
    const lmb_vec3 *c = job->normal;
    const lane zero = lane_splat(0.0f), one = lane_splat(1.0f), tiny = lane_splat(1e-12f);
    const lane3 face = lane3_splat(job->face.x, job->face.y, job->face.z);
    lane3 n;
    n.x = resolve_mix((const float[3]){c[0].x, c[1].x, c[2].x}, b1, b2);
    n.y = resolve_mix((const float[3]){c[0].y, c[1].y, c[2].y}, b1, b2);
    n.z = resolve_mix((const float[3]){c[0].z, c[1].z, c[2].z}, b1, b2);
    lane d2 = lane3_dot(n, n);
    lane_mask fine = lane_lt(tiny, d2);
    lane scale = lane_div(one, lane_sqrt(lane_pick(fine, d2, one)));
    scale = lane_pick(lane_lt(lane3_dot(n, face), zero), lane_sub(zero, scale), scale);
    n = lane3_scale(n, scale);
    n.x = lane_pick(fine, n.x, face.x);
    n.y = lane_pick(fine, n.y, face.y);
    n.z = lane_pick(fine, n.z, face.z);
    return n;
}

static inline void resolve_vector(lmb_tile *out, const lmb_resolve_job *job, int k, lane_mask mine)
{
    const lane zero = lane_splat(0.0f), one = lane_splat(1.0f);
    const lane x = lane_column(k), y = lane_row(k);
    const lane3 origin = resolve_affine(job->origin, job->ox, job->oy, x, y);
    const lane3 ray = resolve_affine(job->direction, job->rx, job->ry, x, y);
    const lane3 plane = lane3_splat(job->plane.x, job->plane.y, job->plane.z);
    const lane3 corner = lane3_splat(job->corner.x, job->corner.y, job->corner.z);

    lane slope = lane3_dot(plane, ray);
    slope = lane_pick(lane_lt(lane_mul(slope, slope), lane_splat(1e-36f)), lane_splat(1e-18f), slope);
    lane w = lane_div(lane3_dot(plane, lane3_sub(corner, origin)), slope);
    w = lane_min(lane_max(w, lane_splat(job->w_min)), lane_splat(job->w_max));
    lane3 p;
    p.x = lane_add(origin.x, lane_mul(ray.x, w));
    p.y = lane_add(origin.y, lane_mul(ray.y, w));
    p.z = lane_add(origin.z, lane_mul(ray.z, w));

    const lane3 q = lane3_sub(p, corner);
    lane b1 = lane3_dot(q, lane3_splat(job->g1.x, job->g1.y, job->g1.z));
    lane b2 = lane3_dot(q, lane3_splat(job->g2.x, job->g2.y, job->g2.z));
    b1 = lane_min(lane_max(b1, zero), one);
    b2 = lane_min(lane_max(b2, zero), lane_sub(one, b1));

    const lane3 n = job->smooth ? resolve_normal(job, b1, b2) : lane3_splat(job->face.x, job->face.y, job->face.z);
    resolve_put(out->depth + k, mine, w);
    resolve_put(out->position[0] + k, mine, lane_add(p.x, lane_splat(job->eye.x)));
    resolve_put(out->position[1] + k, mine, lane_add(p.y, lane_splat(job->eye.y)));
    resolve_put(out->position[2] + k, mine, lane_add(p.z, lane_splat(job->eye.z)));
    resolve_put(out->face[0] + k, mine, lane_splat(job->face.x));
    resolve_put(out->face[1] + k, mine, lane_splat(job->face.y));
    resolve_put(out->face[2] + k, mine, lane_splat(job->face.z));
    resolve_put(out->normal[0] + k, mine, n.x);
    resolve_put(out->normal[1] + k, mine, n.y);
    resolve_put(out->normal[2] + k, mine, n.z);
    for (int c = 0; c < 3; ++c) {
        resolve_put(out->albedo[c] + k, mine, resolve_mix(job->albedo[c], b1, b2));
    }
    resolve_put(out->uv[0] + k, mine, resolve_mix(job->uv[0], b1, b2));
    resolve_put(out->uv[1] + k, mine, resolve_mix(job->uv[1], b1, b2));
}

static uint64_t KERNEL(resolve)(lmb_tile *out, const lmb_resolve_job *job)
{
    const lanei id = lanei_splat((int32_t)job->id);
    uint64_t pixels = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        lane_mask mine = lanei_equal(lanei_load((const int32_t *)out->id + k), id);
        const uint64_t bits = mask_bits(mine);
        if (bits != 0) {
            resolve_vector(out, job, k, mine);
            pixels |= bits << k;
        }
    }
    return pixels;
}
