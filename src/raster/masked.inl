/* masked.inl: a triangle with a mask into one tile: coverage, depth test, alpha test, id. Layer 3.
 *
 * Lanes are pixels. Same values as fill.c. */
#if defined(LANE_PLAIN)
#define MASKED_KERNEL NULL
#else
#define MASKED_KERNEL KERNEL(fill_masked)

/* A value given at the corners. */
LANE_INLINE lane masked_mix(const float corner[3], lane b1, lane b2)
{
    return lane_add(lane_splat(corner[0]), lane_add(lane_mul(lane_splat(corner[1] - corner[0]), b1),
                                                    lane_mul(lane_splat(corner[2] - corner[0]), b2)));
}

/* Barycentrics of pixels k .. k + LANES - 1 on the plane, clamped to the triangle. Returns those that are numbers. */
LANE_INLINE lane_mask masked_point(lane *b1, lane *b2, const lmb_masked_job *j, int k)
{
    const lmb_rays *r = j->rays;
    const lane x = lane_column(k), y = lane_row(k), zero = lane_splat(0.0f), one = lane_splat(1.0f);
    const lane3 corner = lane3_of(j->corner), plane = lane3_of(j->plane);
    const lane3 origin = lane3_add(
        lane3_of(r->origin), lane3_add(lane3_scale(lane3_of(r->ox), x), lane3_scale(lane3_of(r->oy), y)));
    const lane3 ray = lane3_add(
        lane3_of(r->direction), lane3_add(lane3_scale(lane3_of(r->rx), x), lane3_scale(lane3_of(r->ry), y)));
    const lane slope = lane3_dot(plane, ray);
    const lane_mask along = lane_lt(lane_mul(slope, slope), lane_splat(1e-36f));
    const lane w = lane_div(lane3_dot(plane, lane3_sub(corner, origin)), lane_pick(along, lane_splat(1e-18f), slope));
    const lane held = lane_hold(w, lane_splat(j->w_min), lane_splat(j->w_max));
    const lane3 q = lane3_sub(lane3_add(origin, lane3_scale(ray, held)), corner);
    const lane c1 = lane3_dot(q, lane3_of(j->g1)), c2 = lane3_dot(q, lane3_of(j->g2));
    *b1 = lane_hold(c1, zero, one);
    *b2 = lane_hold(c2, zero, lane_sub(one, *b1));
    return mask_and(lane_le(w, w), mask_and(lane_le(c1, c1), lane_le(c2, c2)));
}

/* A level and how it wraps. */
typedef struct masked_level {
    const lmb_texture *texture;
    lanei width, height;
} masked_level;

LANE_INLINE lane masked_alpha(const masked_level *l, lanei x, lanei y)
{
    const lmb_texture *t = l->texture;
    const lanei row = lanei_mul(texture_wrap(y, l->height, t->wrap_t), l->width);
    const lanei at = lanei_add(row, texture_wrap(x, l->width, t->wrap_s));
    const lanei code = lanei_and(lanei_shift(lanei_gather_rgba(t->texels, at), 24), lanei_splat(255));
    return lane_mul(lane_from_int(code), lane_splat(1.0f / 255.0f));
}

/* Alpha of level 0. */
LANE_INLINE lane masked_sample(const masked_level *l, lane u, lane v)
{
    const lmb_texture *t = l->texture;
    const lane half = lane_splat(0.5f), one = lane_splat(1.0f);
    lane x = lane_mul(texture_reduce(u, t->wrap_s), lane_from_int(l->width));
    lane y = lane_mul(texture_reduce(v, t->wrap_t), lane_from_int(l->height));
    if (t->filter == LMB_NEAREST) {
        return masked_alpha(l, lane_to_int(x), lane_to_int(y));
    }
    x = lane_sub(x, half);
    y = lane_sub(y, half);
    const lane x0 = texture_floor(x), y0 = texture_floor(y), fx = lane_sub(x, x0), fy = lane_sub(y, y0);
    const lane gx = lane_sub(one, fx), gy = lane_sub(one, fy);
    const lanei ix = lane_to_int(x0), iy = lane_to_int(y0), jx = lanei_add(ix, lanei_splat(1)),
                jy = lanei_add(iy, lanei_splat(1));
    lane out = lane_mul(lane_mul(gx, gy), masked_alpha(l, ix, iy));
    out = lane_add(out, lane_mul(lane_mul(fx, gy), masked_alpha(l, jx, iy)));
    out = lane_add(out, lane_mul(lane_mul(gx, fy), masked_alpha(l, ix, jy)));
    return lane_add(out, lane_mul(lane_mul(fx, fy), masked_alpha(l, jx, jy)));
}

LANE_INLINE lane_mask masked_nearer(const lmb_fill_tile *tile, const lmb_fill_job *job, int at, lane d)
{
    if (tile->depth_format == LMB_DEPTH32F) {
        return lane_lt(lane_load_rows((const float *)tile->depth + at, tile->depth_step), d);
    }
    return lane_lt(lane_load_u16((const uint16_t *)tile->depth + at, tile->depth_step), fill_depth_16(d, job));
}

/* Returns the pixels k .. k + LANES - 1 at which the surface is opaque. */
LANE_INLINE lane_mask masked_opaque(const lmb_masked_job *job, const masked_level *level, int k)
{
    lane b1, b2;
    const lane_mask sane = masked_point(&b1, &b2, job, k);
    const lane a = masked_sample(level, masked_mix(job->u, b1, b2), masked_mix(job->v, b1, b2));
    return mask_and(sane, lane_le(lane_splat(job->cutoff), lane_mul(a, masked_mix(job->alpha, b1, b2))));
}

static void KERNEL(fill_masked)(const lmb_fill_tile *tile, const lmb_fill_job *job, const lmb_masked_job *masked)
{
    const masked_level level = {masked->texture, lanei_splat(masked->texture->width),
                                lanei_splat(masked->texture->height)};
    const lane d_min = lane_splat(job->d_min), d_max = lane_splat(job->d_max);
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        const int column = k % LMB_TILE, y = k / LMB_TILE;
        const lanei e0 = lanei_affine(job->e[0], job->ex[0], job->ey[0], k),
                    e1 = lanei_affine(job->e[1], job->ex[1], job->ey[1], k),
                    e2 = lanei_affine(job->e[2], job->ex[2], job->ey[2], k);
        const lane row = lane_add(lane_splat(job->d), lane_mul(lane_splat(job->dy), lane_row(k)));
        const lane at = lane_hold(lane_add(row, lane_mul(lane_splat(job->dx), lane_column(k))), d_min, d_max);
        const lane d = lane_min(lane_mul(at, lane_splat(masked->behind)), at);
        lane_mask in = lanei_not_negative(lanei_or(lanei_or(e0, e1), e2));
        in = mask_and(in, masked_nearer(tile, job, y * tile->depth_step + column, d));
        if ((mask_bits(in) & ALL_LANES) == 0) {
            continue;
        }
        in = masked->is_solid ? in : mask_and(in, masked_opaque(masked, &level, k));
        if ((mask_bits(in) & ALL_LANES) != 0) {
            fill_pixels(tile, job, column, y, job->id, d, &in);
        }
    }
}
#endif
