/* mix_between.c: light of a tile's pixels between those that were traced, weighted by surface. */
#include "mix_between.h"

#include "../common/fvec.h"

/* For each of 8 rows or columns: the fraction of the distance from the first to the last. Both ends are traced, so
 * tiles need no neighbours; where tiles meet, two traced rows meet, so there is no seam. */
static const float share[LMB_TILE] = {0.0f,        1.0f / 7.0f, 2.0f / 7.0f, 3.0f / 7.0f,
                                      4.0f / 7.0f, 5.0f / 7.0f, 6.0f / 7.0f, 1.0f};

#define ALIKE    0.90f /* min cosine between the normals of a pixel and a corner */
#define FLAT     0.3f  /* max height over the other's plane, as a share of the distance */
#define ENOUGH   0.25f /* min total weight, of 1, of a pixel's corners */
#define CONTRAST 0.4f  /* max difference of their light, as a share of the brightest */

static lmb_vec3 tile_vec(const float axis[3][LMB_TILE_PIXELS], int k)
{
    return vec3(axis[0][k], axis[1][k], axis[2][k]);
}

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

/* The four corners around a pixel. */
typedef struct between {
    int corner[4];
    float weight[4], sum;
} between;

static between between_of(const lmb_tile *tile, int k)
{
    const int x = k % LMB_TILE, y = k / LMB_TILE;
    between b;
    b.sum = 0.0f;
    for (int i = 0; i < 4; ++i) {
        const float sx = i & 1 ? share[x] : 1.0f - share[x], sy = i & 2 ? share[y] : 1.0f - share[y];
        b.corner[i] = (LMB_TILE - 1) * (LMB_TILE * (i >> 1) + (i & 1));
        b.weight[i] = sx * sy;
        if (b.weight[i] > 0.0f) {
            b.weight[i] *= agreement(tile, k, b.corner[i]);
        }
        b.sum += b.weight[i];
    }
    return b;
}

static int is_corner(int k)
{
    const int x = k % LMB_TILE, y = k / LMB_TILE;
    return x % (LMB_TILE - 1) == 0 && y % (LMB_TILE - 1) == 0;
}

uint64_t mix_between_pixels(const lmb_tile *tile)
{
    uint64_t out = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        if (tile->id[k] != 0 && (is_corner(k) || !(between_of(tile, k).sum >= ENOUGH))) {
            out |= (uint64_t)1 << k;
        }
    }
    return out;
}

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
            low = minf(low, brightness(light, b->corner[i]));
            high = maxf(high, brightness(light, b->corner[i]));
        }
    }
    return high - low <= CONTRAST * high;
}

/* The heaviest corner's light plus the mean difference of the others: exact if all are equal. */
static void blend(lmb_irradiance *inout, int k, const between *b)
{
    int max = 0;
    for (int i = 1; i < 4; ++i) {
        max = b->weight[i] > b->weight[max] ? i : max;
    }
    for (int c = 0; c < 3; ++c) {
        const float first = inout->rgb[c][b->corner[max]];
        float rest = 0.0f;
        for (int i = 0; i < 4; ++i) {
            rest += b->weight[i] > 0.0f ? b->weight[i] * (inout->rgb[c][b->corner[i]] - first) : 0.0f;
        }
        inout->rgb[c][k] = first + rest / b->sum;
    }
}

uint64_t mix_between_fill(lmb_irradiance *inout, const lmb_tile *tile, uint64_t known)
{
    uint64_t uneven = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        if (tile->id[k] != 0 && (known >> k & 1u) == 0) {
            const between b = between_of(tile, k);
            if (is_even(&b, inout)) {
                blend(inout, k, &b);
            } else {
                uneven |= (uint64_t)1 << k;
            }
        }
    }
    return uneven;
}
