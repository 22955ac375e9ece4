/* upsample.c: a tile's light from some of its pixels, weighted by surface. Layer 8.                       [ours] */
#include <lambent/compose.h>

#include "../raster/tile.h"

/* The sampled rows or columns of 8. For each of the 8: the sampled one before it, and the fraction of the distance to
 * the next. Both ends are sampled, so tiles need no neighbours; where tiles meet, two sampled rows meet, so there is no
 * seam. */
typedef struct grid {
    int32_t n, at[4];
    int32_t before[LMB_TILE];
    float share[LMB_TILE];
} grid;

static const grid half = {4, {0, 2, 5, 7}, {0, 0, 1, 1, 1, 2, 2, 2},
                          {0.0f, 0.5f, 0.0f, 1.0f / 3.0f, 2.0f / 3.0f, 0.0f, 0.5f, 1.0f}};
static const grid quarter = {2, {0, 7, 0, 0}, {0, 0, 0, 0, 0, 0, 0, 0},
                             {0.0f, 1.0f / 7.0f, 2.0f / 7.0f, 3.0f / 7.0f, 4.0f / 7.0f, 5.0f / 7.0f, 6.0f / 7.0f,
                              1.0f}};

static const grid *grid_of(int32_t step) { return step == 2 ? &half : step == 4 ? &quarter : NULL; }

/* --- a pixel between samples -------------------------------------------------------------------------------------- */

#define ALIKE    0.90f /* min cosine between the normals of a pixel and a sample */
#define FLAT     0.3f  /* max height over the other's plane, as a share of the distance */
#define ENOUGH   0.25f /* min total weight, of 1, of a pixel's samples */
#define CONTRAST 0.4f  /* max difference of their light, as a share of the brightest */

/* 0 .. 1: how well pixel s agrees with the surface of pixel k. */
static float agreement(const lmb_tile *tile, int k, int s)
{
    const lmb_vec3 d = sub3(tile_vec(tile->position, s), tile_vec(tile->position, k));
    const float over = absf(dot3(tile_vec(tile->face, k), d)), under = absf(dot3(tile_vec(tile->face, s), d));
    const float bend = (1.0f - dot3(tile_vec(tile->normal, k), tile_vec(tile->normal, s))) * (1.0f / (1.0f - ALIKE));
    const float reach = FLAT * length3(d), lift = maxf(over, under);
    if (tile->id[s] == 0 || !(lift <= reach) || !(bend < 1.0f)) {
        return 0.0f;
    }
    return (reach > 0.0f ? 1.0f - lift / reach : 1.0f) * (1.0f - maxf(bend, 0.0f));
}

/* The four samples around a pixel. */
typedef struct between {
    int sample[4];
    float weight[4], sum;
} between;

static between between_of(const grid *g, const lmb_tile *tile, int k)
{
    const int32_t x = k % LMB_TILE, y = k / LMB_TILE;
    between b;
    b.sum = 0.0f;
    for (int i = 0; i < 4; ++i) {
        const float sx = i & 1 ? g->share[x] : 1.0f - g->share[x], sy = i & 2 ? g->share[y] : 1.0f - g->share[y];
        b.weight[i] = sx * sy;
        b.sample[i] = 0;
        if (b.weight[i] > 0.0f) {
            b.sample[i] = (int)(LMB_TILE * g->at[g->before[y] + (i >> 1)] + g->at[g->before[x] + (i & 1)]);
            b.weight[i] *= agreement(tile, k, b.sample[i]);
        }
        b.sum += b.weight[i];
    }
    return b;
}

static int is_sample(const grid *g, int k)
{
    const int32_t x = k % LMB_TILE, y = k / LMB_TILE;
    return (g->share[x] == 0.0f || g->share[x] == 1.0f) && (g->share[y] == 0.0f || g->share[y] == 1.0f);
}

uint64_t lmb_sparse_pixels(const lmb_tile *tile, int32_t step)
{
    const grid *g = grid_of(step);
    uint64_t out = 0;
    for (int k = 0; tile != NULL && k < LMB_TILE_PIXELS; ++k) {
        if (tile->id[k] != 0 && (g == NULL || is_sample(g, k) || !(between_of(g, tile, k).sum >= ENOUGH))) {
            out |= (uint64_t)1 << k;
        }
    }
    return out;
}

/* --- light -------------------------------------------------------------------------------------------------------- */

static float brightness(const lmb_irradiance *light, int s)
{
    return light->rgb[0][s] + light->rgb[1][s] + light->rgb[2][s];
}

/* Does the light vary little? */
static int is_even(const between *b, const lmb_irradiance *light)
{
    float low = 3e38f, high = 0.0f;
    for (int i = 0; i < 4; ++i) {
        if (b->weight[i] > 0.0f) {
            low = minf(low, brightness(light, b->sample[i]));
            high = maxf(high, brightness(light, b->sample[i]));
        }
    }
    return high - low <= CONTRAST * high;
}

/* The heaviest sample's light plus the mean difference of the others: exact if all are equal. */
static void mix(lmb_irradiance *inout, int k, const between *b)
{
    int max = 0;
    for (int i = 1; i < 4; ++i) {
        max = b->weight[i] > b->weight[max] ? i : max;
    }
    for (int c = 0; c < 3; ++c) {
        const float first = inout->rgb[c][b->sample[max]];
        float rest = 0.0f;
        for (int i = 0; i < 4; ++i) {
            rest += b->weight[i] > 0.0f ? b->weight[i] * (inout->rgb[c][b->sample[i]] - first) : 0.0f;
        }
        inout->rgb[c][k] = first + rest / b->sum;
    }
}

uint64_t lmb_upsample_tile(lmb_irradiance *inout, const lmb_tile *tile, uint64_t known, int32_t step)
{
    const grid *g = grid_of(step);
    uint64_t uneven = 0;
    if (inout == NULL || tile == NULL) {
        return 0;
    }
    for (int k = 0; g != NULL && k < LMB_TILE_PIXELS; ++k) {
        if (tile->id[k] != 0 && (known >> k & 1u) == 0) {
            const between b = between_of(g, tile, k);
            if (is_even(&b, inout)) {
                mix(inout, k, &b);
            } else {
                uneven |= (uint64_t)1 << k;
            }
        }
    }
    return uneven;
}
