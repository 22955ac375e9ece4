/* resolve_plain.inl: colours of a tile's pixels in plain C of four lanes. Layer 3.
 *
 * The values are those of resolve.inl. Compilers turn the loops over slots, and over a row's pixels, into vectors; four
 * lanes in a struct stay single values there. */

/* As lowest_bit_64, in one instruction if there is one. */
LANE_INLINE int plain_lowest(uint64_t bits)
{
#if defined(__GNUC__)
    return __builtin_ctzll(bits);
#else
    return lowest_bit_64(bits);
#endif
}

/* --- slots -------------------------------------------------------------------------------------------------------- */

enum { PLAIN_PLACES = 256 };

/* The slot of an id; LMB_SLOTS if there is none left. place: the slot plus 1 of the last id at each place, or 0. */
LANE_INLINE int plain_slot_of(uint8_t place[PLAIN_PLACES], lmb_resolve_batch *out, uint32_t id)
{
    const uint32_t at = id % PLAIN_PLACES;
    int slot = place[at] - 1;
    if (slot >= 0 && out->id[slot] == id) {
        return slot;
    }
    if (slot >= 0) {
        for (slot = 0; slot < out->count; ++slot) {
            if (out->id[slot] == id) {
                return slot;
            }
        }
    }
    slot = out->count;
    if (slot < LMB_SLOTS) {
        out->id[slot] = id;
        out->count = slot + 1;
        place[at] = (uint8_t)(slot + 1);
    }
    return slot;
}

static uint64_t KERNEL(resolve_slots)(lmb_resolve_batch *out, const uint32_t id[LMB_TILE_PIXELS], uint64_t left)
{
    const uint32_t first = out->instance->first_id, count = out->mesh->triangle_count;
    uint64_t taken = 0;
    uint8_t place[PLAIN_PLACES];
    memset(place, 0, sizeof place);
    memset(out->slot, 0xff, sizeof out->slot);
    out->count = 0;
    for (; left != 0; left &= left - 1) {
        const int k = plain_lowest(left);
        if (id[k] - first < count) {
            const int slot = plain_slot_of(place, out, id[k]);
            const uint64_t fits = slot < LMB_SLOTS;
            out->slot[k] = slot < LMB_SLOTS ? slot : -1;
            taken |= fits << k;
        }
    }
    return taken;
}

/* --- planes of eight triangles ------------------------------------------------------------------------------------ */

enum { PLAIN_SET = LMB_SLOTS < 8 ? LMB_SLOTS : 8 };
typedef char plain_sets_fit[LMB_SLOTS % PLAIN_SET == 0 ? 1 : -1]; /* the last set is whole */

typedef struct plain_planes {
    float e1[3][PLAIN_SET], e2[3][PLAIN_SET], n[3][PLAIN_SET];
    float longest[PLAIN_SET], inverse[PLAIN_SET], nn[PLAIN_SET], share[PLAIN_SET], length[PLAIN_SET];
} plain_planes;

LANE_INLINE float plain_dot(float ax, float ay, float az, float bx, float by, float bz)
{
    return ax * bx + ay * by + az * bz;
}

/* A place in the world. */
LANE_INLINE lmb_vec3 plain_world(const lmb_mat4 *m, float (*corner)[LMB_SLOTS], int k)
{
    return transform_point(m, vec3(corner[0][k], corner[1][k], corner[2][k]));
}

LANE_INLINE float plain_along(lmb_vec3 back, lmb_vec3 seen) { return dot3(back, seen) * -1.0f; }

/* Corners of slots from .. from + PLAIN_SET - 1 into the world, then the edges, and corner 0 from the eye. */
LANE_INLINE void plain_place(plain_planes *p, lmb_resolve_batch *b, int from)
{
    const lmb_mat4 m = b->instance->to_world;
    const lmb_vec3 eye = b->rays.eye, back = b->rays.back;
    const float near_m = b->rays.near_m;
    for (int i = 0; i < PLAIN_SET; ++i) {
        const int k = from + i;
        const lmb_vec3 first = plain_world(&m, b->corner[0], k), second = plain_world(&m, b->corner[1], k),
                       third = plain_world(&m, b->corner[2], k);
        const lmb_vec3 seen = sub3(first, eye), e1 = sub3(second, first), e2 = sub3(third, first);
        const float w0 = plain_along(back, seen), w1 = plain_along(back, sub3(second, eye)),
                    w2 = plain_along(back, sub3(third, eye));
        const float low = maxf(minf(minf(w0, w1), w2), near_m);
        b->w_min[k] = low;
        b->w_max[k] = maxf(maxf(maxf(w0, w1), w2), low);
        b->corner[0][0][k] = seen.x, b->corner[0][1][k] = seen.y, b->corner[0][2][k] = seen.z;
        p->e1[0][i] = e1.x, p->e1[1][i] = e1.y, p->e1[2][i] = e1.z;
        p->e2[0][i] = e2.x, p->e2[1][i] = e2.y, p->e2[2][i] = e2.z;
        const float longest = sqrtf(maxf(dot3(e1, e1), dot3(e2, e2)));
        p->longest[i] = longest;
        p->inverse[i] = 1.0f / longest;
    }
}

/* Scaled edges and normals. Quotients that are not used may be infinite. */
LANE_INLINE void plain_scale(plain_planes *p)
{
    for (int i = 0; i < PLAIN_SET; ++i) {
        const float shrink = 1e-12f < p->longest[i] ? p->inverse[i] : 0.0f;
        const float ax = p->e1[0][i] * shrink, ay = p->e1[1][i] * shrink, az = p->e1[2][i] * shrink;
        const float bx = p->e2[0][i] * shrink, by = p->e2[1][i] * shrink, bz = p->e2[2][i] * shrink;
        const float nx = ay * bz - az * by, ny = az * bx - ax * bz, nz = ax * by - ay * bx;
        const float nn = plain_dot(nx, ny, nz, nx, ny, nz);
        p->e1[0][i] = ax, p->e1[1][i] = ay, p->e1[2][i] = az;
        p->e2[0][i] = bx, p->e2[1][i] = by, p->e2[2][i] = bz;
        p->n[0][i] = nx, p->n[1][i] = ny, p->n[2][i] = nz;
        p->nn[i] = nn;
        p->share[i] = shrink / nn;
        p->length[i] = 1.0f / sqrtf(nn);
    }
}

/* Planes of perspective views that need only colours: face[0] is the plane's height above the eye. */
NOINLINE void plain_set_planes(lmb_resolve_batch *b, int from)
{
    plain_planes p;
    const lmb_vec3 back = b->rays.back;
    plain_place(&p, b, from);
    plain_scale(&p);
    for (int i = 0; i < PLAIN_SET; ++i) {
        const int k = from + i;
        const float ax = p.e1[0][i], ay = p.e1[1][i], az = p.e1[2][i], bx = p.e2[0][i], by = p.e2[1][i],
                    bz = p.e2[2][i], nx = p.n[0][i], ny = p.n[1][i], nz = p.n[2][i];
        const float gain = 1e-24f < p.nn[i] ? p.share[i] : 0.0f, scale = p.length[i];
        b->corner[1][0][k] = (by * nz - bz * ny) * gain;
        b->corner[1][1][k] = (bz * nx - bx * nz) * gain;
        b->corner[1][2][k] = (bx * ny - by * nx) * gain;
        b->corner[2][0][k] = (ny * az - nz * ay) * gain;
        b->corner[2][1][k] = (nz * ax - nx * az) * gain;
        b->corner[2][2][k] = (nx * ay - ny * ax) * gain;
        const float sx = nx * scale, sy = ny * scale, sz = nz * scale;
        const float px = 1e-24f < p.nn[i] ? sx : back.x, py = 1e-24f < p.nn[i] ? sy : back.y,
                    pz = 1e-24f < p.nn[i] ? sz : back.z;
        b->plane[0][k] = px, b->plane[1][k] = py, b->plane[2][k] = pz;
        b->face[0][k] = plain_dot(px, py, pz, b->corner[0][0][k], b->corner[0][1][k], b->corner[0][2][k]);
    }
}

/* A channel of a corner's code, times the material's. As resolve_albedo. */
LANE_INLINE float plain_channel(uint32_t code, int shift, float own)
{
    const float v = (float)(int32_t)(code >> shift & 255u);
    return own * (v * (1.0f / 256.0f) + v * (float)(1.0 / 65280.0));
}

NOINLINE void plain_set_albedo(lmb_resolve_batch *b, int from)
{
    for (int c = 0; c < 3; ++c) {
        const float own = b->material->albedo[c];
        for (int i = 0; i < PLAIN_SET; ++i) {
            const int k = from + i;
            const float v = plain_channel(b->colour[0][k], 8 * c, own);
            b->albedo[0][c][k] = v;
            b->albedo[1][c][k] = plain_channel(b->colour[1][k], 8 * c, own) - v;
            b->albedo[2][c][k] = plain_channel(b->colour[2][k], 8 * c, own) - v;
        }
    }
}

/* The same for colours of 16 bits, which are decoded already. */
NOINLINE void plain_set_wide_albedo(lmb_resolve_batch *b, int from)
{
    for (int c = 0; c < 3; ++c) {
        const float own = b->material->albedo[c];
        for (int k = from; k < from + PLAIN_SET; ++k) {
            const float v = own * b->albedo[0][c][k];
            b->albedo[0][c][k] = v;
            b->albedo[1][c][k] = own * b->albedo[1][c][k] - v;
            b->albedo[2][c][k] = own * b->albedo[2][c][k] - v;
        }
    }
}

/* --- pixels ------------------------------------------------------------------------------------------------------- */

/* Rays of a tile's pixels. The limits are read from memory: compilers make branches of constant ones. */
typedef struct plain_rays {
    float at[3][LMB_TILE_PIXELS];
    float zero, one;
} plain_rays;

NOINLINE void plain_set_rays(plain_rays *out, const lmb_rays *r)
{
    float x[LMB_TILE];
    out->zero = 0.0f;
    out->one = 1.0f;
    for (int i = 0; i < LMB_TILE; ++i) {
        x[i] = (float)i;
    }
    for (int c = 0; c < 3; ++c) {
        const float *direction = &r->direction.x, *rx = &r->rx.x, *ry = &r->ry.x;
        const float at = direction[c], per_x = rx[c], per_y = ry[c];
        for (int row = 0; row < LMB_TILE; ++row) {
            const float down = per_y * (float)row;
            float *to = out->at[c] + LMB_TILE * row;
            for (int i = 0; i < LMB_TILE; ++i) {
                to[i] = at + (per_x * x[i] + down);
            }
        }
    }
}

/* Barycentrics of pixel k in slot s. */
LANE_INLINE void plain_point(float *b1, float *b2, const lmb_resolve_batch *b, const plain_rays *ray, int k, int s)
{
    const float rx = ray->at[0][k], ry = ray->at[1][k], rz = ray->at[2][k];
    float slope = plain_dot(b->plane[0][s], b->plane[1][s], b->plane[2][s], rx, ry, rz);
    slope = slope * slope < 1e-36f ? 1e-18f : slope;
    const float w = minf(maxf(b->face[0][s] / slope, b->w_min[s]), b->w_max[s]);
    const float qx = rx * w - b->corner[0][0][s], qy = ry * w - b->corner[0][1][s], qz = rz * w - b->corner[0][2][s];
    const float first = plain_dot(qx, qy, qz, b->corner[1][0][s], b->corner[1][1][s], b->corner[1][2][s]);
    const float second = plain_dot(qx, qy, qz, b->corner[2][0][s], b->corner[2][1][s], b->corner[2][2][s]);
    const float held = minf(maxf(first, ray->zero), ray->one);
    *b1 = held;
    *b2 = minf(maxf(second, ray->zero), ray->one - held);
}

/* A mix of the corners' values in slot s. */
LANE_INLINE float plain_mix(const float *first, const float *second, const float *third, int s, const float at[2])
{
    return first[s] + (at[0] * second[s] + at[1] * third[s]);
}

LANE_INLINE float plain_channel_at(const lmb_resolve_batch *b, int c, int s, const float at[2], float zero)
{
    return maxf(zero, plain_mix(b->albedo[0][c], b->albedo[1][c], b->albedo[2][c], s, at));
}

/* One pixel after the other. */
LANE_INLINE void plain_pixels(lmb_tile *out, const lmb_resolve_batch *b, const plain_rays *ray, int colours, int uvs)
{
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int s = b->slot[k];
        float at[2];
        if (s < 0) {
            continue;
        }
        plain_point(&at[0], &at[1], b, ray, k, s);
        out->albedo[0][k] = colours ? plain_channel_at(b, 0, s, at, ray->zero) : b->material->albedo[0];
        out->albedo[1][k] = colours ? plain_channel_at(b, 1, s, at, ray->zero) : b->material->albedo[1];
        out->albedo[2][k] = colours ? plain_channel_at(b, 2, s, at, ray->zero) : b->material->albedo[2];
        if (uvs) {
            out->uv[0][k] = plain_mix(b->uv[0][0], b->uv[1][0], b->uv[2][0], s, at);
            out->uv[1][k] = plain_mix(b->uv[0][1], b->uv[1][1], b->uv[2][1], s, at);
        }
    }
}

/* Up to this many slots are taken row by row. */
enum { PLAIN_FEW = 4 };

/* The pixels of slot s in a row that starts at pixel k; eight are computed. */
LANE_INLINE void plain_slot_row(lmb_tile *out, const lmb_resolve_batch *b, const plain_rays *ray, int k, int s,
                                int colours, int uvs)
{
    const int32_t *slot = b->slot + k;
    float b1[LMB_TILE], b2[LMB_TILE];
    for (int i = 0; i < LMB_TILE; ++i) {
        plain_point(&b1[i], &b2[i], b, ray, k + i, s);
    }
    for (int c = 0; c < 3; ++c) {
        float *to = out->albedo[c] + k;
        const float own = b->material->albedo[c], first = b->albedo[0][c][s], second = b->albedo[1][c][s],
                    third = b->albedo[2][c][s], zero = ray->zero;
        for (int i = 0; i < LMB_TILE; ++i) {
            const float v = colours ? maxf(zero, first + (b1[i] * second + b2[i] * third)) : own;
            to[i] = slot[i] == s ? v : to[i];
        }
    }
    for (int c = 0; uvs && c < 2; ++c) {
        float *to = out->uv[c] + k;
        const float first = b->uv[0][c][s], second = b->uv[1][c][s], third = b->uv[2][c][s];
        for (int i = 0; i < LMB_TILE; ++i) {
            const float v = first + (b1[i] * second + b2[i] * third);
            to[i] = slot[i] == s ? v : to[i];
        }
    }
}

LANE_INLINE void plain_slots_by_rows(lmb_tile *out, const lmb_resolve_batch *b, const plain_rays *ray, int colours,
                                     int uvs)
{
    for (int k = 0; k < LMB_TILE_PIXELS; k += LMB_TILE) {
        uint32_t slots = 0;
        for (int i = 0; i < LMB_TILE; ++i) {
            slots |= 1u << (b->slot[k + i] + 1); /* bit 0: none of these */
        }
        for (slots >>= 1; slots != 0; slots &= slots - 1) {
            plain_slot_row(out, b, ray, k, lowest_bit(slots), colours, uvs);
        }
    }
}

LANE_INLINE void plain_resolve_of(lmb_tile *out, const lmb_resolve_batch *b, int colours, int uvs)
{
    plain_rays ray;
    plain_set_rays(&ray, &b->rays);
    if (b->count <= PLAIN_FEW) {
        plain_slots_by_rows(out, b, &ray, colours, uvs);
    } else {
        plain_pixels(out, b, &ray, colours, uvs);
    }
}

NOINLINE void plain_resolve_colours(lmb_tile *out, const lmb_resolve_batch *b) { plain_resolve_of(out, b, 1, 0); }
NOINLINE void plain_resolve_uvs(lmb_tile *out, const lmb_resolve_batch *b) { plain_resolve_of(out, b, 0, 1); }
NOINLINE void plain_resolve_both(lmb_tile *out, const lmb_resolve_batch *b) { plain_resolve_of(out, b, 1, 1); }
NOINLINE void plain_resolve_none(lmb_tile *out, const lmb_resolve_batch *b) { plain_resolve_of(out, b, 0, 0); }

LANE_INLINE void plain_resolve(lmb_tile *out, const lmb_resolve_batch *b)
{
    if (b->mesh->colours != NULL) {
        (b->mesh->uvs != NULL ? plain_resolve_both : plain_resolve_colours)(out, b);
    } else {
        (b->mesh->uvs != NULL ? plain_resolve_uvs : plain_resolve_none)(out, b);
    }
}
