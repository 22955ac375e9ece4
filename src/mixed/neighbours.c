/* neighbours.c: the points of a picture nearest to one of them. Layer 6.                                      [M3] */
#include "../base/vec.h"
#include "cloud.h"

#if LMB_MIXED

/* The k nearest so far, nearest first; ties go to the lower index. */
typedef struct nearest {
    float d2[NEAREST_CAP];
    uint32_t which[NEAREST_CAP];
    int32_t k, count;
} nearest;

static int goes_before(const nearest *n, int32_t i, uint32_t which, float d2)
{
    return d2 < n->d2[i] || (d2 == n->d2[i] && which < n->which[i]);
}

static void take_nearest(nearest *n, uint32_t which, float d2)
{
    int32_t i = n->count < n->k ? n->count : n->k - 1;
    if (n->count == n->k && !goes_before(n, i, which, d2)) {
        return;
    }
    for (; i > 0 && goes_before(n, i - 1, which, d2); --i) {
        n->d2[i] = n->d2[i - 1];
        n->which[i] = n->which[i - 1];
    }
    n->d2[i] = d2;
    n->which[i] = which;
    n->count += n->count < n->k;
}

static float distance2(lmb_vec3 a, lmb_vec3 b)
{
    const lmb_vec3 d = sub3(a, b);
    return dot3(d, d);
}

int32_t lmb_cloud_nearest(int32_t *out, int32_t k, const lmb_cloud *cloud, int32_t x, int32_t y)
{
    nearest n = {{0}, {0}, mini(k, NEAREST_CAP), 0};
    if (out == NULL || n.k < 1 || !is_measured(cloud, x, y)) {
        return 0;
    }
    const int32_t w = cloud->camera.width, h = cloud->camera.height;
    const lmb_vec3 at = lmb_cloud_point(cloud, x, y);
    for (int32_t j = maxi(y - 2, 0); j <= mini(y + 2, h - 1); ++j) {
        for (int32_t i = maxi(x - 2, 0); i <= mini(x + 2, w - 1); ++i) {
            if ((i != x || j != y) && cloud->inverse[(size_t)j * (size_t)w + (size_t)i] > 0.0f) {
                take_nearest(&n, (uint32_t)(j * w + i), distance2(lmb_cloud_point(cloud, i, j), at));
            }
        }
    }
    for (int32_t i = 0; i < n.count; ++i) {
        out[i] = (int32_t)n.which[i];
    }
    return n.count;
}

#endif
