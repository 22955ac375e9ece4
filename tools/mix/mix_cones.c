/* mix_cones.c: indirect light by cone tracing, at some pixels of a row of tiles. */
#include "mix_between.h"
#include "mix_carry.h"
#include "mix_world.h"

#include <math.h>
#include <string.h>

/* The pixels between which the others are interpolated. A tile that is due traces all of these again, and a third of
 * the pixels that noise, an edge or curvature keeps from being interpolated: another third each time. */
#define CORNERS ((uint64_t)1 | (uint64_t)1 << 7 | (uint64_t)1 << 56 | (uint64_t)1 << 63)
#define THIRD   (uint64_t)0x9249249249249249u /* of the pixels; shift by one and by two for the other thirds */

/* If the ratio of light with the object to light without it varies by more than this between traced pixels, all are
 * traced: the dark spot under a ball is narrower than the pixel step. */
#define STEEP 1.25f

/* Environment light without occlusion. A scene without an object needs nothing else. */
static void add_around(lmb_irradiance *inout, const lmb_env *env, const lmb_tile *tile)
{
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        if (tile->id[k] != 0) {
            float rgb[3];
            const lmb_vec3 n = {tile->normal[0][k], tile->normal[1][k], tile->normal[2][k]};
            lmb_env_irradiance(rgb, env, n);
            for (int c = 0; c < 3; ++c) {
                inout->rgb[c][k] += rgb[c];
            }
        }
    }
}

static void add_cones(lmb_irradiance *inout, const mix_job *j, const lmb_tile *tile, int32_t world)
{
    const lmb_cone_trace trace = mix_trace(j, world);
    lmb_tile room;
    lmb_cones_diffuse(inout, NULL, &trace, &j->world->cones, mix_tile_there(&room, j, tile));
}

/* Raises points over the voxels of their surface by RAISED leaves. A curved surface fills the voxels around its points
 * unevenly, which drew stripes. Points that face down stay, or they would be under the floor. */
#define RAISED 0.75f

void mix_cones_tile(lmb_irradiance *inout, const mix_job *j, const lmb_tile *tile)
{
    lmb_tile raised = *tile;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const float down = raised.face[1][k] < 0.0f ? raised.face[1][k] : 0.0f;
        for (int c = 0; c < 3; ++c) {
            raised.position[c][k] += RAISED * j->world->voxels.leaf * (1.0f + down) * raised.face[c][k];
        }
    }
    add_cones(inout, j, &raised, LMB_VOXEL_WITH);
}

void mix_put_place(lmb_tile *to, int n, const lmb_tile *from, int k)
{
    for (int c = 0; c < 3; ++c) {
        to->position[c][n] = from->position[c][k];
        to->face[c][n] = from->face[c][k];
        to->normal[c][n] = from->normal[c][k];
    }
    to->depth[n] = from->depth[k];
    to->id[n] = from->id[k];
}

/* Traces the collected pixels and writes their light back to their tiles. */
static void flush(mix_batch *b, const mix_job *j)
{
    for (int32_t world = 0; world < 2 && b->gathered > 0; ++world) {
        lmb_irradiance light;
        memset(&light, 0, sizeof light);
        add_cones(&light, j, &b->together, world);
        for (int32_t k = 0; k < b->gathered; ++k) {
            for (int c = 0; c < 3; ++c) {
                b->light[world][b->from[k] / LMB_TILE_PIXELS].rgb[c][b->from[k] % LMB_TILE_PIXELS] = light.rgb[c][k];
            }
        }
    }
    memset(&b->together, 0, sizeof b->together);
    b->gathered = 0;
}

static void put_pixel(mix_batch *b, const mix_job *j, int32_t tile, int32_t pixel)
{
    const lmb_tile *from = &b->real[tile];
    lmb_tile *to = &b->together;
    const int32_t k = b->gathered;
    mix_put_place(to, k, from, pixel);
    b->from[k] = tile * LMB_TILE_PIXELS + pixel;
    if (++b->gathered == LMB_TILE_PIXELS) {
        flush(b, j);
    }
}

static void put_pixels(mix_batch *b, const mix_job *j, int32_t tile, uint64_t pixels)
{
    for (int32_t k = 0; k < LMB_TILE_PIXELS; ++k) {
        if ((pixels >> k & 1) != 0 && b->real[tile].id[k] != 0) {
            put_pixel(b, j, tile, k);
        }
    }
}

static int is_steep(const mix_batch *b, int32_t i, uint64_t known)
{
    float low = INFINITY, high = 0.0f;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        float sum[2] = {0.0f, 0.0f};
        for (int c = 0; c < 6; ++c) {
            sum[c / 3] += b->light[c / 3][i].rgb[c % 3][k];
        }
        if ((known >> k & 1) != 0 && b->real[i].id[k] != 0 && sum[0] > 0.0f) {
            low = fminf(low, sum[1] / sum[0]);
            high = fmaxf(high, sum[1] / sum[0]);
        }
    }
    return high > STEEP * low;
}

/* Fills the pixels of a tile by interpolation; carried pixels keep their light. *more: the pixels that must be
 * traced. */
static void fill_between(uint64_t more[1], mix_batch *b, int32_t i, uint64_t known, uint64_t carried)
{
    const lmb_irradiance kept[2] = {b->light[0][i], b->light[1][i]};
    const int steep = is_steep(b, i, known);
    *more = 0;
    for (int32_t world = 0; world < 2; ++world) {
        *more |= mix_between_fill(&b->light[world][i], &b->real[i], known);
        for (int k = 0; k < 3 * LMB_TILE_PIXELS; ++k) {
            if ((carried >> k % LMB_TILE_PIXELS & 1) != 0) {
                b->light[world][i].rgb[k / LMB_TILE_PIXELS][k % LMB_TILE_PIXELS] =
                    kept[world].rgb[k / LMB_TILE_PIXELS][k % LMB_TILE_PIXELS];
            }
        }
    }
    *more = (steep ? ~known : *more) & ~carried;
}

/* The pixels carried from the previous frame; if the tile is due, only those that are not traced this time. */
static uint64_t take_carried(mix_batch *b, const mix_job *j, int32_t i, uint64_t known)
{
    const lmb_tile *real = &b->real[i];
    uint64_t carried = mix_carry_get(&b->light[0][i], &b->light[1][i], &b->direct[i], j, real);
    if (carried == 0 || mix_carry_knows(j, real->x, real->y)) {
        return carried | mix_carry_spread(&b->light[0][i], &b->light[1][i], real, carried, known & ~carried);
    }
    carried &= known & ~(CORNERS | THIRD << mix_carry_turn(j, real->x, real->y) % 3);
    b->direct[i].known &= carried;
    return carried;
}

void mix_cones_batch(mix_batch *b, const mix_job *j)
{
    uint64_t known[MIX_BATCH], carried[MIX_BATCH], more;
    memset(b->light, 0, sizeof b->light);
    memset(b->direct, 0, sizeof b->direct);
    if (j->world == NULL) {
        for (int32_t i = 0; i < 2 * b->count; ++i) {
            add_around(&b->light[i / b->count][i % b->count], &j->env[0], &b->real[i % b->count]);
        }
        return;
    }
    memset(&b->together, 0, sizeof b->together);
    b->gathered = 0;
    for (int32_t i = 0; i < b->count; ++i) {
        known[i] = mix_between_pixels(&b->real[i]);
        carried[i] = take_carried(b, j, i, known[i]);
        put_pixels(b, j, i, known[i] & ~carried[i]);
    }
    flush(b, j);
    for (int32_t i = 0; i < b->count; ++i) {
        fill_between(&more, b, i, known[i], carried[i]);
        put_pixels(b, j, i, more);
    }
    flush(b, j);
    for (int32_t i = 0; i < b->count; ++i) {
        mix_carry_put(j, &b->real[i], &b->light[0][i], &b->light[1][i]);
    }
}
