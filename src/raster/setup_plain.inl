/* setup_plain.inl: a batch of triangles in plain C of four lanes: corners in loops, then triangles one by one. Layer 3.
 *
 * The values are those of setup.inl. Compilers turn the loops over the corners into vectors; four lanes in a struct
 * stay single values there. A triangle that shows no pixel is left before edges and depth. */

/* A batch's transformed corners, [corner][triangle]. is_out: bit 0: not sane; bits 1 .. 5: outside the near plane,
 * left, right, top, bottom. */
typedef struct plain_corners {
    int32_t x[3][LMB_BATCH], y[3][LMB_BATCH]; /* 24.8 */
    float d[3][LMB_BATCH];
    uint8_t is_out[3][LMB_BATCH];
} plain_corners;

/* No pointer to the same bytes: otherwise gcc -O2 makes no vectors. */
#if defined(__GNUC__)
#define PLAIN_ALONE __restrict__
#else
#define PLAIN_ALONE
#endif

enum { PLAIN_INSANE = 1, PLAIN_OUTSIDE = 62 };

LANE_INLINE float plain_row(const float row[4], float x, float y, float z)
{
    return row[0] * x + row[1] * y + row[2] * z + row[3];
}

/* Comparisons are sums of bits: compilers join these into vectors, but no branches. */
LANE_INLINE uint32_t plain_insane(float v)
{
    return 1u - ((uint32_t)(v > -1048576.0f) & (uint32_t)(v < 1048576.0f));
}

/* Only corners that are not used are beyond `limit`, or not numbers. */
LANE_INLINE float plain_hold(float v, float limit)
{
    v = v > -limit ? v : -limit;
    return v < limit ? v : limit;
}

LANE_INLINE int32_t plain_floor(float v)
{
    const int32_t i = (int32_t)v;
    return i - (v < (float)i);
}

/* Transforms corner i of each triangle, as setup_project and setup_snap do. */
LANE_INLINE void plain_transform(plain_corners *PLAIN_ALONE out, const setup_corners *PLAIN_ALONE in,
                                 const lmb_setup_job *job, int i, int orthographic)
{
    const lmb_setup_job j = *job;
    /* Past the guard band by less than a px. Limits that are constants would become branches. */
    const float limit_x = j.guard_x * j.snap_x + 128.0f, limit_y = j.guard_y * j.snap_y + 128.0f;
    for (int k = 0; k < LMB_BATCH; ++k) {
        const float px = in->position[i][0][k], py = in->position[i][1][k], pz = in->position[i][2][k];
        const float along_x = plain_row(j.row[0], px, py, pz), along_y = plain_row(j.row[1], px, py, pz),
                    along = plain_row(j.row[2], px, py, pz);
        const float x = along_x * j.scale_x, y = along_y * j.scale_y;
        const float z = orthographic ? (j.far_m - along) * j.depth_scale : j.near_m, w = orthographic ? 1.0f : along;
        const float wide = j.guard_x * w, high = j.guard_y * w;
        const uint32_t is_out = plain_insane(along_x) | plain_insane(along_y) | plain_insane(along) |
                                (uint32_t)(w - z < 0.0f) << 1 | (uint32_t)(wide + x < 0.0f) << 2 |
                                (uint32_t)(wide - x < 0.0f) << 3 | (uint32_t)(high - y < 0.0f) << 4 |
                                (uint32_t)(high + y < 0.0f) << 5;
        const float inverse = orthographic ? 1.0f : 1.0f / (w > j.near_m ? w : j.near_m);
        out->x[i][k] = plain_floor(plain_hold(x * inverse * j.snap_x + 0.5f, limit_x));
        out->y[i][k] = plain_floor(plain_hold(0.5f - y * inverse * j.snap_y, limit_y));
        out->d[i][k] = z * inverse;
        out->is_out[i][k] = (uint8_t)is_out;
    }
}

NOINLINE void plain_transform_all(plain_corners *out, const setup_corners *in, const lmb_setup_job *job)
{
    for (int i = 0; i < 3; ++i) {
        if (job->orthographic) {
            plain_transform(out, in, job, i, 1);
        } else {
            plain_transform(out, in, job, i, 0);
        }
    }
}

typedef struct plain_corner {
    int32_t x, y; /* 24.8 */
    float d;
} plain_corner;

/* As setup_edge_lanes, from pixel (x, y). */
LANE_INLINE void plain_edge(lmb_batch *b, int i, int k, const plain_corner *from, const plain_corner *to, int32_t x,
                            int32_t y)
{
    const int32_t ex = from->y - to->y, ey = to->x - from->x;
    const int32_t rule = ex > 0 || (ex == 0 && ey > 0) ? 0 : 1;
    b->ex[i][k] = ex;
    b->ey[i][k] = ey;
    b->e[i][k] = (ex * (x - from->x) + ey * (y - from->y) - rule) >> 8;
}

LANE_INLINE void plain_depth(lmb_batch *out, int k, const plain_corner *a, const plain_corner *b, const plain_corner *c,
                             int32_t area)
{
    const double ad = (double)a->d, bd = (double)b->d - ad, cd = (double)c->d - ad;
    const double bx = b->x - a->x, by = b->y - a->y, cx = c->x - a->x, cy = c->y - a->y, per_px = 256.0 / area;
    const double dx = (bd * cy - cd * by) * per_px, dy = (cd * bx - bd * cx) * per_px;
    out->d[k] = ad - dx * (a->x * (1.0 / 256.0)) - dy * (a->y * (1.0 / 256.0));
    out->dx[k] = dx;
    out->dy[k] = dy;
    out->d_min[k] = minf(a->d, minf(b->d, c->d));
    out->d_max[k] = maxf(a->d, maxf(b->d, c->d));
}

LANE_INLINE int32_t plain_min3(int32_t a, int32_t b, int32_t c) { return mini(a, mini(b, c)); }
LANE_INLINE int32_t plain_max3(int32_t a, int32_t b, int32_t c) { return maxi(a, maxi(b, c)); }

/* Triangle k, which no plane cuts: as setup_find_box and setup_edges. */
LANE_INLINE void plain_triangle(lmb_batch *out, const lmb_setup_job *job, int k, const plain_corner *a,
                                const plain_corner *b, const plain_corner *c)
{
    const uint32_t bit = 1u << k;
    const int32_t x0 = plain_min3(a->x, b->x, c->x), x1 = plain_max3(a->x, b->x, c->x);
    const int32_t y0 = plain_min3(a->y, b->y, c->y), y1 = plain_max3(a->y, b->y, c->y);
    if (x1 - x0 >= LMB_SMALL_24_8 || y1 - y0 >= LMB_SMALL_24_8) {
        out->sets.other |= bit;
        return;
    }
    const int32_t area = (b->x - a->x) * (c->y - a->y) - (c->x - a->x) * (b->y - a->y);
    const int turned = area < 0;
    if (area == 0 || (job->cull != 0 && turned != (job->cull > 0))) {
        return;
    }
    out->sets.drawn |= bit;
    const int32_t px0 = maxi((x0 + (255 - job->origin_x)) >> 8, job->x0),
                  px1 = mini((x1 - job->origin_x) >> 8, job->x1),
                  py0 = maxi((y0 + (255 - job->origin_y)) >> 8, job->y0),
                  py1 = mini((y1 - job->origin_y) >> 8, job->y1);
    if (px1 < px0 || py1 < py0) {
        return;
    }
    const plain_corner *second = turned ? c : b, *third = turned ? b : c;
    const int32_t x = (px0 >> 3) * (LMB_TILE * 256) + job->origin_x, y = (py0 >> 3) * (LMB_TILE * 256) + job->origin_y;
    out->sets.small |= bit;
    out->x0[k] = px0, out->x1[k] = px1;
    out->y0[k] = py0, out->y1[k] = py1;
    plain_edge(out, 0, k, a, second, x, y);
    plain_edge(out, 1, k, second, third, x, y);
    plain_edge(out, 2, k, third, a, x, y);
    plain_depth(out, k, a, second, third, turned ? -area : area);
}

LANE_INLINE plain_corner plain_corner_of(const plain_corners *in, int i, int k)
{
    plain_corner c;
    c.x = in->x[i][k];
    c.y = in->y[i][k];
    c.d = in->d[i][k];
    return c;
}

static void KERNEL(setup)(lmb_batch *out, const lmb_setup_job *job, const lmb_mesh *mesh, uint32_t first,
                          uint32_t count)
{
    setup_corners fetched;
    plain_corners at;
    setup_begin(&out->sets, setup_fetch(&fetched, mesh, first, count));
    plain_transform_all(&at, &fetched, job);
    for (uint32_t bits = out->sets.in; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit(bits);
        const uint32_t a = at.is_out[0][k], b = at.is_out[1][k], c = at.is_out[2][k], any = a | b | c, all = a & b & c;
        if (any != 0) {
            out->sets.dropped |= (any & PLAIN_INSANE) << k;
            out->sets.other |= (uint32_t)((any & PLAIN_INSANE) == 0 && (all & PLAIN_OUTSIDE) == 0) << k;
            continue;
        }
        const plain_corner corner[3] = {plain_corner_of(&at, 0, k), plain_corner_of(&at, 1, k),
                                        plain_corner_of(&at, 2, k)};
        plain_triangle(out, job, k, &corner[0], &corner[1], &corner[2]);
    }
}
