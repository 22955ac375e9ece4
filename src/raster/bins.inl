/* bins.inl: a batch's set-up in two halves: corners on the screen, which bins store, then edges and planes. Layer 3.
 *
 * The sums are those of setup.inl, value by value. */

/* Both are below 2^15. */
LANE_INLINE lanei bin_pair(lanei x, lanei y) { return lanei_add(x, lanei_mul(y, lanei_splat(65536))); }

/* Triangles k .. k + LANES - 1, from their corners. */
LANE_INLINE void bin_store(lmb_bin_batch *to, const lmb_setup_job *job, const setup_sides *sides,
                           lane_mask in, const setup_corner *a, const setup_corner *b, const setup_corner *c, int k)
{
    setup_box box;
    const uint32_t small = setup_find_box(&box, &to->sets, job, sides, in, a, b, c, k);
    const uint32_t whole = mask_bits(mask_and(sides->sane, mask_not(sides->any)));
    lmb_bin_block *block = &to->block;
    if (whole == 0) {
        return;
    }
    to->sets.small |= small << k;
    to->whole |= whole << k;
    lanei_store(to->y0 + k, box.y0);
    lanei_store(to->y1 + k, box.y1);
    lanei_store(block->x + k, a->x);
    lanei_store(block->y + k, a->y);
    lanei_store(block->to_b + k, bin_pair(box.bx, box.by));
    lanei_store(block->to_c + k, bin_pair(box.cx, box.cy));
    lane_store(block->d[0] + k, a->d);
    lane_store(block->d[1] + k, b->d);
    lane_store(block->d[2] + k, c->d);
    if (whole != small) {
        lanei_store(to->b[0] + k, b->x);
        lanei_store(to->b[1] + k, b->y);
        lanei_store(to->c[0] + k, c->x);
        lanei_store(to->c[1] + k, c->y);
    }
}

#if LANES > 1
NOINLINE void bin_snap_lanes(lmb_bin_batch *out, const lmb_setup_job *job, const setup_corners *corners, int k)
{
    const lane_mask in = mask_of_bits(out->sets.in >> k);
    setup_sides sides = {in, mask_not(in), {in, in, in, in, in}};
    const setup_corner a = setup_transform(&sides, job, corners->position[0], k),
                       b = setup_transform(&sides, job, corners->position[1], k),
                       c = setup_transform(&sides, job, corners->position[2], k);
    bin_store(out, job, &sides, in, &a, &b, &c, k);
}

static void KERNEL(bin_snap)(lmb_bin_batch *out, const lmb_setup_job *job, const lmb_mesh *mesh, uint32_t first,
                             uint32_t count)
{
    setup_corners corners;
    setup_begin(&out->sets, setup_fetch(&corners, mesh, first, count));
    out->whole = 0;
    for (int k = 0; k < LMB_BATCH && out->sets.in >> k != 0; k += LANES) {
        bin_snap_lanes(out, job, &corners, k);
    }
}
#else
static void KERNEL(bin_snap)(lmb_bin_batch *out, const lmb_setup_job *job, const lmb_mesh *mesh, uint32_t first,
                             uint32_t count)
{
    const setup_sides inside = setup_inside();
    setup_corner c[3];
    setup_begin(&out->sets, 0);
    out->whole = 0;
    for (uint32_t k = 0; k < count; ++k) {
        if (setup_whole(c, &out->sets, job, mesh, first + k, k)) {
            bin_store(out, job, &inside, inside.sane, &c[0], &c[1], &c[2], (int)k);
        }
    }
}
#endif

LANE_INLINE setup_corner bin_corner(lanei x, lanei y, lanei pair, const float *d)
{
    const lanei down = lanei_shift(lanei_add(pair, lanei_splat(32768)), 16);
    setup_corner c;
    c.x = lanei_add(x, lanei_sub(pair, lanei_mul(down, lanei_splat(65536))));
    c.y = lanei_add(y, down);
    c.d = lane_load(d);
    return c;
}

/* The corners of triangles k .. k + LANES - 1. */
LANE_INLINE void bin_corners(setup_corner c[3], const lmb_bin_block *block, int k)
{
    c[0].x = lanei_load(block->x + k);
    c[0].y = lanei_load(block->y + k);
    c[0].d = lane_load(block->d[0] + k);
    c[1] = bin_corner(c[0].x, c[0].y, lanei_load(block->to_b + k), block->d[1] + k);
    c[2] = bin_corner(c[0].x, c[0].y, lanei_load(block->to_c + k), block->d[2] + k);
}

static void KERNEL(bin_setup)(lmb_batch *out, const lmb_setup_job *job, const lmb_bin_block *block, uint32_t count)
{
    setup_begin(&out->sets, (1u << count) - 1);
    for (int k = 0; k < LMB_BATCH && out->sets.in >> k != 0; k += LANES) {
        const lane_mask in = mask_of_bits(out->sets.in >> k), none = mask_of_bits(0);
        const setup_sides inside = {in, none, {none, none, none, none, none}};
        setup_corner c[3];
        bin_corners(c, block, k);
        setup_triangles(out, job, &inside, in, &c[0], &c[1], &c[2], k);
        lanei_store((int32_t *)out->id + k, lanei_load((const int32_t *)block->id + k));
    }
}

/* Range of a window's tiles from the lowest of `low` to the highest of -minus_high, 24.8. */
LANE_INLINE void bin_tiles(int32_t *first, int32_t *last, lane low, lane minus_high, int32_t origin, int32_t min,
                           int32_t max)
{
    const int32_t first_px = ((int32_t)lane_lowest(low) + 255 - origin) >> 8,
                  last_px = (-(int32_t)lane_lowest(minus_high) - origin) >> 8;
    *first = ((first_px > min ? first_px : min) - min) / LMB_TILE;
    *last = ((last_px < max ? last_px : max) - min) / LMB_TILE;
}

/* 24.8 numbers are exact in binary32. */
static float KERNEL(bin_box)(lmb_tile_box *out, const lmb_setup_job *job, const lmb_bin_block *block)
{
    const lane zero = lane_splat(0.0f);
    lane x0 = lane_splat(3e38f), y0 = x0, x1 = x0, y1 = x0, d = x0;
    for (int k = 0; k < LMB_BATCH; k += LANES) {
        setup_corner c[3];
        bin_corners(c, block, k);
        x0 = lane_min(x0, lane_from_int(setup_min3(c[0].x, c[1].x, c[2].x)));
        y0 = lane_min(y0, lane_from_int(setup_min3(c[0].y, c[1].y, c[2].y)));
        x1 = lane_min(x1, lane_sub(zero, lane_from_int(setup_max3(c[0].x, c[1].x, c[2].x))));
        y1 = lane_min(y1, lane_sub(zero, lane_from_int(setup_max3(c[0].y, c[1].y, c[2].y))));
        d = lane_min(d, lane_sub(zero, lane_max(c[0].d, lane_max(c[1].d, c[2].d))));
    }
    bin_tiles(&out->x0, &out->x1, x0, x1, job->origin_x, job->x0, job->x1);
    bin_tiles(&out->y0, &out->y1, y0, y1, job->origin_y, job->y0, job->y1);
    return -lane_lowest(d);
}
