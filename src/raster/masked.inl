/* masked.inl: a triangle with a mask into one tile: coverage, depth test, alpha test, id. Layer 3.
 *
 * Lanes are pixels. Same values as fill.c. */
#if defined(LANE_PLAIN)
#define MASKED_SEEN_KERNEL NULL
#define MASKED_PARTS_KERNEL NULL
#define MASKED_KERNEL NULL
#else
#define MASKED_SEEN_KERNEL KERNEL(masked_seen)
#if LMB_CULLING
#define MASKED_PARTS_KERNEL KERNEL(masked_parts)
#else
#define MASKED_PARTS_KERNEL NULL
#endif
#define MASKED_KERNEL KERNEL(fill_masked)

/* A value given at the corners. */
LANE_INLINE lane masked_mix(const float corner[3], lane b1, lane b2)
{
    return lane_add(lane_splat(corner[0]), lane_add(lane_mul(lane_splat(corner[1] - corner[0]), b1),
                                                    lane_mul(lane_splat(corner[2] - corner[0]), b2)));
}

/* Barycentrics of pixels (x, y) on the plane, not clamped, and the slopes of their rays to the plane. */
LANE_INLINE void masked_plane(lane *c1, lane *c2, lane *slope, const lmb_masked_job *j, lane x, lane y)
{
    const lmb_rays *r = j->rays;
    const lane3 corner = lane3_of(j->corner), plane = lane3_of(j->plane), zero = lane3_splat(0.0f, 0.0f, 0.0f);
    const lane3 ax = lane3_of(r->perspective ? r->rx : r->ox), ay = lane3_of(r->perspective ? r->ry : r->oy);
    const lane3 step = lane3_add(lane3_scale(ax, x), lane3_scale(ay, y)); /* the other two steps are 0 */
    const lane3 origin = lane3_add(lane3_of(r->origin), r->perspective ? zero : step);
    const lane3 ray = lane3_add(lane3_of(r->direction), r->perspective ? step : zero);
    *slope = lane3_dot(plane, ray);
    const lane_mask along = lane_lt(lane_mul(*slope, *slope), lane_splat(1e-36f));
    const lane w = lane_div(lane3_dot(plane, lane3_sub(corner, origin)), lane_pick(along, lane_splat(1e-18f), *slope));
    const lane held = lane_pick(lane_le(w, w), lane_hold(w, lane_splat(j->w_min), lane_splat(j->w_max)), w);
    const lane3 q = lane3_sub(lane3_add(origin, lane3_scale(ray, held)), corner);
    *c1 = lane3_dot(q, lane3_of(j->g1));
    *c2 = lane3_dot(q, lane3_of(j->g2));
}

/* The same of pixels k .. k + LANES - 1, clamped to the triangle. Returns those that are numbers. */
LANE_INLINE lane_mask masked_point(lane *b1, lane *b2, const lmb_masked_job *j, int k)
{
    lane c1, c2, slope;
    const lane zero = lane_splat(0.0f), one = lane_splat(1.0f);
    masked_plane(&c1, &c2, &slope, j, lane_column(k), lane_row(k));
    *b1 = lane_hold(c1, zero, one);
    *b2 = lane_hold(c2, zero, lane_sub(one, *b1));
    return mask_and(lane_le(c1, c1), lane_le(c2, c2));
}

/* A level and how it wraps. */
typedef struct masked_level {
    const lmb_texture *texture;
    lanei width, height;
} masked_level;

LANE_INLINE lane masked_share(lanei texel)
{
    return lane_mul(lane_from_int(lanei_and(lanei_shift(texel, 24), lanei_splat(255))), lane_splat(1.0f / 255.0f));
}

LANE_INLINE lanei masked_texel(const masked_level *l, lanei x, lanei y)
{
    const lmb_texture *t = l->texture;
    const lanei row = lanei_mul(texture_wrap(y, l->height, t->wrap_t), l->width);
    return lanei_gather_rgba(t->texels, lanei_add(row, texture_wrap(x, l->width, t->wrap_s)));
}

#if defined(LANE_HAS_BLOCKS)
/* Reads the four texels at (x, y) for the lanes `in`, if all lie in one block of the texture. */
LANE_INLINE int masked_block(lanei texel[4], const masked_level *l, lanei x, lanei y, lane_mask in)
{
    const lmb_texture *t = l->texture;
    const int32_t left = mini(lanei_lowest_of(in, x), t->width - 8), top = mini(lanei_lowest_of(in, y), t->height - 4);
    const lanei dx = lanei_sub(x, lanei_splat(left)), dy = lanei_sub(y, lanei_splat(top));
    const lanei fits =
        lanei_or(lanei_or(dx, dy), lanei_or(lanei_sub(lanei_splat(6), dx), lanei_sub(lanei_splat(2), dy)));
    if (left < 0 || top < 0 || mask_bits(mask_and(in, lanei_not_negative(fits))) != mask_bits(in)) {
        return 0;
    }
    const size_t step = 4 * (size_t)t->width;
    const lanei_block b = lanei_block_of(t->texels + (size_t)top * step + 4 * (size_t)left, step);
    const lanei at = lanei_add(lanei_mul(dy, lanei_splat(8)), dx);
    texel[0] = lanei_block_at(b, at);
    texel[1] = lanei_block_at(b, lanei_add(at, lanei_splat(1)));
    texel[2] = lanei_block_at(b, lanei_add(at, lanei_splat(8)));
    texel[3] = lanei_block_at(b, lanei_add(at, lanei_splat(9)));
    return 1;
}
#endif

/* The four texels at and after (x, y), of the lanes `in` at least. */
LANE_INLINE void masked_four(lanei texel[4], const masked_level *l, lanei x, lanei y, lane_mask in)
{
    const lanei one = lanei_splat(1), right = lanei_sub(l->width, lanei_splat(2)),
                bottom = lanei_sub(l->height, lanei_splat(2));
    const lanei inside = lanei_or(lanei_or(x, y), lanei_or(lanei_sub(right, x), lanei_sub(bottom, y)));
#if defined(LANE_HAS_BLOCKS)
    if (masked_block(texel, l, x, y, in)) {
        return;
    }
#else
    (void)in;
#endif
    if ((mask_bits(lanei_not_negative(inside)) & ALL_LANES) == ALL_LANES) { /* none wraps */
        const uint8_t *texels = l->texture->texels;
        const lanei at = lanei_add(lanei_mul(y, l->width), x), below = lanei_add(at, l->width);
        texel[0] = lanei_gather_rgba(texels, at);
        texel[1] = lanei_gather_rgba(texels, lanei_add(at, one));
        texel[2] = lanei_gather_rgba(texels, below);
        texel[3] = lanei_gather_rgba(texels, lanei_add(below, one));
        return;
    }
    const lanei next = lanei_add(x, one), below = lanei_add(y, one);
    texel[0] = masked_texel(l, x, y);
    texel[1] = masked_texel(l, next, y);
    texel[2] = masked_texel(l, x, below);
    texel[3] = masked_texel(l, next, below);
}

/* Alpha of level 0, of the lanes `in` at least. */
LANE_INLINE lane masked_sample(const masked_level *l, lane u, lane v, lane_mask in)
{
    const lmb_texture *t = l->texture;
    const lane half = lane_splat(0.5f), one = lane_splat(1.0f);
    lane x = lane_mul(texture_reduce(u, t->wrap_s), lane_from_int(l->width));
    lane y = lane_mul(texture_reduce(v, t->wrap_t), lane_from_int(l->height));
    if (t->filter == LMB_NEAREST) {
        return masked_share(masked_texel(l, lane_to_int(x), lane_to_int(y)));
    }
    x = lane_sub(x, half);
    y = lane_sub(y, half);
    const lane x0 = texture_floor(x), y0 = texture_floor(y), fx = lane_sub(x, x0), fy = lane_sub(y, y0);
    const lane gx = lane_sub(one, fx), gy = lane_sub(one, fy);
    lanei texel[4];
    masked_four(texel, l, lane_to_int(x0), lane_to_int(y0), in);
    lane out = lane_mul(lane_mul(gx, gy), masked_share(texel[0]));
    out = lane_add(out, lane_mul(lane_mul(fx, gy), masked_share(texel[1])));
    out = lane_add(out, lane_mul(lane_mul(gx, fy), masked_share(texel[2])));
    return lane_add(out, lane_mul(lane_mul(fx, fy), masked_share(texel[3])));
}

LANE_INLINE lane_mask masked_nearer(const lmb_fill_tile *tile, const lmb_fill_job *job, int at, lane d)
{
    if (tile->depth_format == LMB_DEPTH32F) {
        return lane_lt(lane_load_rows((const float *)tile->depth + at, tile->depth_step), d);
    }
    return lane_lt(lane_load_u16((const uint16_t *)tile->depth + at, tile->depth_step), fill_depth_16(d, job));
}

/* Returns those of the pixels `in`, of k .. k + LANES - 1, at which the surface is opaque. */
LANE_INLINE lane_mask masked_opaque(const lmb_masked_job *job, const masked_level *level, int k, lane_mask in)
{
    lane b1, b2;
    const lane_mask sane = masked_point(&b1, &b2, job, k);
    in = mask_and(in, sane);
    const lane a = masked_sample(level, masked_mix(job->u, b1, b2), masked_mix(job->v, b1, b2), in);
    return mask_and(in, lane_le(lane_splat(job->cutoff), lane_mul(a, masked_mix(job->alpha, b1, b2))));
}

LANE_INLINE lane masked_depth(const lmb_fill_job *job, const lmb_masked_job *masked, int k)
{
    const lane row = lane_add(lane_splat(job->d), lane_mul(lane_splat(job->dy), lane_row(k)));
    const lane at = lane_hold(lane_add(row, lane_mul(lane_splat(job->dx), lane_column(k))), lane_splat(job->d_min),
                              lane_splat(job->d_max));
    return lane_min(lane_mul(at, lane_splat(masked->behind)), at);
}

/* 1 if the tile lies inside all edges. */
LANE_INLINE int masked_is_inside(const lmb_fill_job *job)
{
    return (job->ex[0] | job->ex[1] | job->ex[2] | job->ey[0] | job->ey[1] | job->ey[2]) == 0;
}

static uint64_t KERNEL(masked_seen)(const lmb_fill_tile *tile, const lmb_fill_job *job, const lmb_masked_job *masked)
{
    const int is_inside = masked_is_inside(job);
    uint64_t seen = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        const int at = k / LMB_TILE * tile->depth_step + k % LMB_TILE;
        lane_mask in = masked_nearer(tile, job, at, masked_depth(job, masked, k));
        if (!is_inside) {
            const lanei e0 = lanei_affine(job->e[0], job->ex[0], job->ey[0], k),
                        e1 = lanei_affine(job->e[1], job->ex[1], job->ey[1], k),
                        e2 = lanei_affine(job->e[2], job->ex[2], job->ey[2], k);
            in = mask_and(in, lanei_not_negative(lanei_or(lanei_or(e0, e1), e2)));
        }
        seen |= (uint64_t)(mask_bits(in) & ALL_LANES) << k;
    }
    return seen;
}

/* --- pairs of rows ------------------------------------------------------------------------------------------------ */

#if LMB_CULLING
/* The texels that a pair of a tile's rows can sample show whether it is all hole or all solid. */
enum { MASKED_PAIRS = LMB_TILE / 2, MASKED_CORNERS = 4 * MASKED_PAIRS };
enum { MASKED_ANY, MASKED_HOLE, MASKED_SOLID };
#define MASKED_MARGIN (1.0f / 64.0f) /* texels, and of the tile's extent, for rounding */
#define MAX_MASKED_TURNS 16.0f       /* of a repeated texture */
#define MIN_MASKED_SLOPE 0.05f       /* limits of a tile's slopes, of the first pixel's */
#define MAX_MASKED_SLOPE 20.0f

/* Texture coordinates along one axis at the corners of pairs 0 .. 3, and the texels that the pairs can sample. */
typedef struct masked_axis {
    float at[MASKED_CORNERS];
    uint16_t low[MASKED_PAIRS], high[MASKED_PAIRS];
} masked_axis;

/* Sets the texels. Returns the pairs without samples that wrap along the axis, one bit each. */
static uint32_t KERNEL(masked_spans)(masked_axis *inout, int32_t size, int32_t wrap)
{
    const float *at = inout->at, turn = (float)(int32_t)clampf(at[0], -MAX_MASKED_TURNS, MAX_MASKED_TURNS);
    const float base = wrap != LMB_WRAP_REPEAT ? 0.0f : at[0] < turn ? turn - 1.0f : turn;
    float low[MASKED_PAIRS], high[MASKED_PAIRS], all_low = at[0], all_high = at[0];
    for (int i = 0; i < MASKED_PAIRS; ++i) {
        const float *p = at + 4 * i;
        low[i] = minf(minf(p[0], p[1]), minf(p[2], p[3]));
        high[i] = maxf(maxf(p[0], p[1]), maxf(p[2], p[3]));
        all_low = minf(all_low, low[i]);
        all_high = maxf(all_high, high[i]);
    }
    const float texels = (float)size, wider = MASKED_MARGIN * (1.0f + (all_high - all_low) * texels);
    uint32_t inside = 0;
    for (int i = 0; i < MASKED_PAIRS; ++i) {
        const float first = (low[i] - base) * texels - 0.5f - wider, last = (high[i] - base) * texels - 0.5f + wider;
        if (first >= 0.0f && last < texels - 1.0f) {
            inout->low[i] = (uint16_t)first;
            inout->high[i] = (uint16_t)((int32_t)last + 1);
            inside |= 1u << i;
        }
    }
    return inside;
}

/* Part of a pair, of up to 4 x 4 texels inside the texture. */
NOINLINE int KERNEL(masked_texels)(const lmb_masked_job *j, const masked_axis *x, const masked_axis *y, int pair)
{
    static const int32_t column[16] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3},
                         row[16] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
    const lmb_texture *t = j->texture;
    const int32_t right = x->high[pair] - x->low[pair], down = y->high[pair] - y->low[pair];
    const lanei first = lanei_splat(y->low[pair] * t->width + x->low[pair]), width = lanei_splat(t->width);
    uint32_t hole = ALL_LANES, solid = ALL_LANES;
    if (right > 3 || down > 3) {
        return MASKED_ANY;
    }
    for (int i = 0; i < 16; i += LANES) {
        const lanei cx = lanei_min(lanei_load(column + i), lanei_splat(right)),
                    cy = lanei_min(lanei_load(row + i), lanei_splat(down));
        const lanei at = lanei_add(first, lanei_add(lanei_mul(cy, width), cx));
        const lanei code = lanei_and(lanei_shift(lanei_gather_rgba(t->texels, at), 24), lanei_splat(255));
        hole &= mask_bits(lanei_lt(code, lanei_splat(j->hole)));
        solid &= mask_bits(lanei_lt(lanei_splat(j->solid - 1), code));
    }
    return (hole & ALL_LANES) == ALL_LANES    ? MASKED_HOLE
           : (solid & ALL_LANES) == ALL_LANES ? MASKED_SOLID
                                              : MASKED_ANY;
}

/* Texture coordinates at corners k .. k + LANES - 1 of the pairs. Returns 0 if the plane's horizon is near: the
 * coordinates of pixels may not lie between those of the corners. A separate function, because a loop would keep the
 * vectors of all iterations on the stack. */
NOINLINE int KERNEL(masked_corners)(masked_axis *x, masked_axis *y, const lmb_masked_job *j, int k)
{
    static const float column[MASKED_CORNERS] = {0, 7, 0, 7, 0, 7, 0, 7, 0, 7, 0, 7, 0, 7, 0, 7},
                       row[MASKED_CORNERS] = {0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7};
    const float first = dot3(j->plane, j->rays->direction), square = first * first;
    lane c1, c2, slope;
    masked_plane(&c1, &c2, &slope, j, lane_load(column + k), lane_load(row + k));
    lane_store(x->at + k, masked_mix(j->u, c1, c2));
    lane_store(y->at + k, masked_mix(j->v, c1, c2));
    slope = lane_mul(slope, lane_splat(first));
    const lane_mask is_far = mask_and(lane_lt(lane_splat(MIN_MASKED_SLOPE * square), slope),
                                      lane_lt(slope, lane_splat(MAX_MASKED_SLOPE * square)));
    return (mask_bits(is_far) & ALL_LANES) == ALL_LANES;
}

static void KERNEL(masked_parts)(lmb_masked_parts *out, const lmb_masked_job *j, uint64_t seen)
{
    masked_axis x, y;
    out->hole = out->solid = 0;
    out->gain = -1;
    for (int k = 0; k < MASKED_CORNERS; k += LANES) {
        if (!KERNEL(masked_corners)(&x, &y, j, k)) {
            return;
        }
    }
    const uint32_t inside = KERNEL(masked_spans)(&x, j->texture->width, j->texture->wrap_s) &
                            KERNEL(masked_spans)(&y, j->texture->height, j->texture->wrap_t);
    for (int i = 0, last = -1, part = MASKED_ANY; i < MASKED_PAIRS; ++i) {
        if ((inside >> i & 1u) != 0 && (seen >> (16 * i) & 0xffffu) != 0) {
            const int same = last >= 0 && x.low[i] == x.low[last] && x.high[i] == x.high[last] &&
                             y.low[i] == y.low[last] && y.high[i] == y.high[last];
            part = same ? part : KERNEL(masked_texels)(j, &x, &y, i);
            out->hole |= part == MASKED_HOLE ? (uint64_t)0xffffu << (16 * i) : 0;
            out->solid |= part == MASKED_SOLID ? (uint64_t)0xffffu << (16 * i) : 0;
            out->gain += part != MASKED_ANY;
            last = i;
        }
    }
}
#endif

static void KERNEL(fill_masked)(const lmb_fill_tile *tile, const lmb_fill_job *job, const lmb_masked_job *masked,
                                uint64_t seen, uint64_t solid)
{
    const masked_level level = {masked->texture, lanei_splat(masked->texture->width),
                                lanei_splat(masked->texture->height)};
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        const uint32_t bits = (uint32_t)(seen >> k) & ALL_LANES;
        if (bits == 0) {
            continue;
        }
        lane_mask in = mask_of_bits(bits);
        in = (solid >> k & 1u) != 0 ? in : masked_opaque(masked, &level, k, in);
        if ((mask_bits(in) & ALL_LANES) != 0) {
            fill_pixels(tile, job, k % LMB_TILE, k / LMB_TILE, job->id, masked_depth(job, masked, k), &in);
        }
    }
}
#endif
