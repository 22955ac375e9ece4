/* lane.h: small formulas over the lane verbs that several kernels share. Include after a machine's lane header. Floor 2. */
#ifndef LMB_LANE_H
#define LMB_LANE_H

typedef struct lane3 {
    lane x, y, z;
} lane3;

static inline lane3 lane3_load(const float (*p)[LMB_TILE_PIXELS], int k)
{
    lane3 r;
    r.x = lane_load(p[0] + k);
    r.y = lane_load(p[1] + k);
    r.z = lane_load(p[2] + k);
    return r;
}

static inline lane3 lane3_splat(float x, float y, float z)
{
    lane3 r;
    r.x = lane_splat(x);
    r.y = lane_splat(y);
    r.z = lane_splat(z);
    return r;
}

static inline lane3 lane3_sub(lane3 a, lane3 b)
{
    a.x = lane_sub(a.x, b.x);
    a.y = lane_sub(a.y, b.y);
    a.z = lane_sub(a.z, b.z);
    return a;
}

static inline lane3 lane3_scale(lane3 a, lane s)
{
    a.x = lane_mul(a.x, s);
    a.y = lane_mul(a.y, s);
    a.z = lane_mul(a.z, s);
    return a;
}

static inline lane lane3_dot(lane3 a, lane3 b)
{
    return lane_add(lane_add(lane_mul(a.x, b.x), lane_mul(a.y, b.y)), lane_mul(a.z, b.z));
}

#endif
