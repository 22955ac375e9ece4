/* mend.c: corrects single pixels of a warped tile that disagree with their neighbours. Layer 5.                   [P12]
 *
 * Near a depth discontinuity that no view captures well, single rays slip between the texels of two views or hit a
 * surface that another view shows elsewhere. Simple models also have gaps of one pixel. A one-pixel speck is
 * conspicuous, although an edge that is a pixel off is the larger error. So the neighbours count more than the pixel's
 * own ray: the pixel gets the surface that most neighbours agree on, intersected with its ray. */
#include "mend.h"

#include "../base/vec.h"
#include "../raster/plane.h"
#include "../raster/tile.h"

#if LMB_RELIEF

#define NEAR_BY 4.0f  /* max depth difference of two pixels on one surface, in pixel sides */
#define MIN_RAY_COSINE 0.05f /* cosine to the ray below which a plane gives no depth */

enum { MAX_MEND_PASSES = 3 }; /* a corrected pixel can correct the next one */

/* The neighbours of a pixel that lie in the tile. */
typedef struct mend_around {
    lmb_vec3 origin, along; /* ray of the middle pixel, from the eye; `along` goes 1 m along the axis */
    float same;             /* m of depth */
    float depth[8];         /* m, of the neighbour's plane at that ray */
    int at[8];
    int hits;               /* neighbours with a surface; they come first */
} mend_around;

typedef struct mender {
    lmb_tile *tile;
    const lmb_relief_job *job;
    lmb_rays rays;
} mender;

uint64_t lmb_relief_beside(int k)
{
    const int x = k % LMB_TILE, y = k / LMB_TILE;
    const uint64_t row = x == 0 ? 3u : x == LMB_TILE - 1 ? 3u : 7u;
    const uint64_t rows = (row | row << 8 | row << 16) << (x > 0 ? x - 1 : 0);
    return (y == 0 ? rows >> 8 : rows << 8 * (y - 1)) & ~((uint64_t)1 << k);
}

/* Depth at which the plane of pixel k meets the ray. If the plane is nearly parallel to the ray: the depth of pixel
 * k. */
static float depth_at_neighbour(const mender *m, const mend_around *a, int k)
{
    const lmb_tile *t = m->tile;
    const lmb_vec3 to = sub3(sub3(tile_vec(t->position, k), m->job->eye), a->origin), n = tile_vec(t->normal, k);
    const float along = dot3(n, a->along), own = t->depth[k];
    return along < -MIN_RAY_COSINE ? clampf(dot3(n, to) / along, own - a->same, own + a->same) : own;
}

static void look_around(mend_around *out, const mender *m, uint64_t shown, int k)
{
    const lmb_rays *r = &m->rays;
    const float x = (float)(k % LMB_TILE), y = (float)(k / LMB_TILE);
    out->origin = add3(r->origin, add3(mul3(r->ox, x), mul3(r->oy, y)));
    out->along = add3(r->direction, add3(mul3(r->rx, x), mul3(r->ry, y)));
    out->hits = 0;
    for (uint64_t bits = lmb_relief_beside(k) & shown; bits != 0; bits &= bits - 1) {
        const int at = lowest_bit_64(bits);
        out->same = NEAR_BY * m->job->pixel * (m->job->perspective ? m->tile->depth[at] : 1.0f);
        out->at[out->hits] = at;
        out->depth[out->hits++] = depth_at_neighbour(m, out, at);
    }
}

/* Counts the neighbours with a surface at a depth. */
static int agree(const mend_around *a, float depth)
{
    int n = 0;
    for (int i = 0; i < a->hits; ++i) {
        n += absf(a->depth[i] - depth) <= a->same;
    }
    return n;
}

/* Counts the neighbours that share the most common surface. */
static int most_agree(const mend_around *a)
{
    int max = 0;
    for (int i = 0; i < a->hits; ++i) {
        max = maxi(max, agree(a, a->depth[i]));
    }
    return max;
}

/* Sets pixel k to the mean of the largest group of neighbours that agree. */
static void take_surface(const mender *m, const mend_around *a, int k)
{
    lmb_tile *t = m->tile;
    const lmb_tile *in = t;
    lmb_vec3 normal = vec3(0.0f, 0.0f, 0.0f), albedo = normal;
    float depth = 0.0f, n = 0.0f;
    int best = 0;
    for (int i = 1; i < a->hits; ++i) {
        best = agree(a, a->depth[i]) > agree(a, a->depth[best]) ? i : best;
    }
    for (int i = 0; i < a->hits; ++i) {
        if (absf(a->depth[i] - a->depth[best]) <= a->same) {
            normal = add3(normal, tile_vec(in->normal, a->at[i]));
            albedo = add3(albedo, tile_vec(in->albedo, a->at[i]));
            depth += a->depth[i];
            n += 1.0f;
        }
    }
    depth = depth / n;
    normal = normalize3(normal);
    tile_set_vec(t->position, k, add3(m->job->eye, add3(a->origin, mul3(a->along, depth))));
    tile_set_vec(t->face, k, normal);
    tile_set_vec(t->normal, k, normal);
    tile_set_vec(t->albedo, k, mul3(albedo, 1.0f / n));
    t->depth[k] = depth;
    t->id[k] = t->id[a->at[best]];
}

/* Do at least two neighbours have about the same depth? One of them may be a speck too. */
static int has_equals(const mender *m, uint64_t beside, int k)
{
    const float own = m->tile->depth[k], same = NEAR_BY * m->job->pixel * (m->job->perspective ? own : 1.0f);
    int found = 0;
    for (; beside != 0 && found < 2; beside &= beside - 1) {
        found += absf(m->tile->depth[lowest_bit_64(beside)] - own) <= same;
    }
    return found > 1;
}

/* Mask of the tile's pixels that lie in the picture. */
static uint64_t in_picture(const lmb_tile *t, const lmb_view *view)
{
    uint64_t out = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        out |= (uint64_t)(t->x + k % LMB_TILE < view->frame_width && t->y + k / LMB_TILE < view->frame_height) << k;
    }
    return out;
}

/* Mask of the pixels that show a surface and were not left to the simple model. */
static uint64_t showing(const lmb_tile *t, uint64_t missed)
{
    uint64_t out = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        out |= (uint64_t)(t->id[k] != 0) << k;
    }
    return out & ~missed;
}

/* Runs one pass over all pixels, reading the result of the previous pass. Returns 1 if a pixel became a hit. A pixel of
 * the simple model is corrected only from surfaces, an empty pixel from any neighbour. A pixel that no view shows, away
 * from all surfaces, lies beside the model if a view shows all of it; photos show a part only, and it stays. A hit is a
 * speck if the simple model covers a pixel beside it; a model that covers one pixel is all of the hit. */
static int mend_all(mender *m, lmb_relief_found *found, uint64_t inside)
{
    const uint64_t hit = found->hit, all = showing(m->tile, found->missed), covered = showing(m->tile, 0);
    mend_around a;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const uint64_t own = (uint64_t)1 << k, beside = lmb_relief_beside(k) & inside, shown = beside & hit;
        const uint64_t known = (all & own) != 0 ? shown : beside & all;
        const int pixels = count_bits_64(beside), hits = count_bits_64(shown), is_hit = (hit & own) != 0;
        if ((inside & own) == 0) {
            continue;
        }
        if (!is_hit && known != 0 && count_bits_64(known) + (pixels >= 5) >= pixels) {
            look_around(&a, m, known, k);
            take_surface(m, &a, k);
            found->hit |= own;
            found->missed &= ~own;
        } else if (m->job->outside && m->tile->id[k] != 0 && hits == 0 && pixels >= 5 &&
                   (!is_hit || (beside & covered) != 0)) {
            found->hit &= ~own;
            found->missed |= own;
        } else if (is_hit && hits > 2 && !has_equals(m, shown, k)) {
            look_around(&a, m, hit, k);
            if (most_agree(&a) > 2 + 2 * agree(&a, m->tile->depth[k])) {
                take_surface(m, &a, k);
            }
        }
    }
    return (found->hit & ~hit) != 0;
}

void lmb_relief_mend(lmb_tile *inout, lmb_relief_found *found, const lmb_relief_job *job, const lmb_view *view)
{
    const uint64_t inside = in_picture(inout, view);
    mender m;
    int pass = found->hit != 0 ? 0 : MAX_MEND_PASSES;
    m.tile = inout;
    m.job = job;
    lmb_resolve_rays(&m.rays, view, inout->x, inout->y);
    while (pass < MAX_MEND_PASSES && mend_all(&m, found, inside)) {
        ++pass;
    }
}

#endif
