/* mix_near.c: indirect light on the object, shared between samples of a pixel and between frames. */
#include "mix_near.h"

#include <math.h>
#include <string.h>

#include "mix_carry.h"
#include "mix_frames.h"
#include "mix_turn.h"

#define ENOUGH 0.5f /* of the weights of pixels around a place */

/* Within half a leaf, and with normals within about twelve degrees. */
static int is_near(const mix_near *n, const lmb_tile *tile, int k, float leaf)
{
    float far = 0.0f, turn = 0.0f;
    for (int c = 0; c < 3; ++c) {
        const float d = n->tile.position[c][k] - tile->position[c][k];
        far += d * d;
        turn += n->tile.normal[c][k] * tile->normal[c][k];
    }
    return n->tile.id[k] != 0 && far <= 0.25f * leaf * leaf && turn >= 0.98f;
}

/* --- from the previous frame -------------------------------------------------------------------------------------- */

/* Does a pixel of the previous frame show the same part of the object? */
static int is_same(const mix_lit *lit, lmb_vec3 p, lmb_vec3 n, float leaf)
{
    const lmb_vec3 d = {lit->position.x - p.x, lit->position.y - p.y, lit->position.z - p.z};
    return lit->is_known && d.x * d.x + d.y * d.y + d.z * d.z <= leaf * leaf &&
           lit->normal.x * n.x + lit->normal.y * n.y + lit->normal.z * n.z >= 0.98f;
}

/* Interpolates the light of a place on the object between sample positions of the previous frame. Without the exact
 * sample positions, carried light would drift from frame to frame. */
static int get_pixel(float rgb[3], const mix_job *j, lmb_vec3 p, lmb_vec3 n)
{
    const mix_job *last = j->kept->last;
    const lmb_pinhole *c = &last->frame.camera;
    const lmb_vec3 at = mix_move(&j->to_last, p), to = mix_turn(&j->to_last, n);
    float x, y, sum = 0.0f, found[3] = {0, 0, 0};
    if (!mix_carry_see(&x, &y, last, at)) {
        return 0;
    }
    for (int i = 0; i < 9; ++i) {
        const int32_t px = (int32_t)floorf(x + 0.5f) + i % 3 - 1, py = (int32_t)floorf(y + 0.5f) + i / 3 - 1;
        if (px < 0 || py < 0 || px >= c->width || py >= c->height) {
            continue;
        }
        const mix_lit *lit = &last->lit[(size_t)py * (size_t)c->width + (size_t)px];
        const float weight = fmaxf(1.0f - fabsf(x - lit->x), 0.0f) * fmaxf(1.0f - fabsf(y - lit->y), 0.0f);
        if (weight > 0.0f && is_same(lit, at, to, j->world->voxels.leaf)) {
            sum += weight;
            for (int k = 0; k < 3; ++k) {
                found[k] += weight * lit->rgb[k];
            }
        }
    }
    for (int k = 0; k < 3 && sum >= ENOUGH; ++k) {
        rgb[k] = found[k] / sum;
    }
    return sum >= ENOUGH;
}

static lmb_vec3 of_planes(const float planes[3][LMB_TILE_PIXELS], int k)
{
    const lmb_vec3 out = {planes[0][k], planes[1][k], planes[2][k]};
    return out;
}

/* The position in the photo of a tile of the views' frame. */
static int find_origin(int32_t at[2], const mix_job *j, const lmb_tile *tile)
{
    lmb_view view;
    const int ok = j->lit != NULL && lmb_photo_view(&view, &at[0], &at[1], &j->frame.camera, &j->axes) == LMB_OK;
    at[0] = ok ? tile->x - at[0] : 0;
    at[1] = ok ? tile->y - at[1] : 0;
    return ok;
}

/* Carries all requested pixels that the previous frame has. Returns the pixels left to trace. */
static uint64_t carry(mix_near *near, const mix_job *j, const lmb_tile *tile, uint64_t asked)
{
    int32_t from[2];
    const int knows = find_origin(from, j, tile) && mix_carry_knows(j, from[0], from[1]);
    for (int k = 0; k < LMB_TILE_PIXELS && knows; ++k) {
        float rgb[3];
        if ((asked >> k & 1) != 0 && get_pixel(rgb, j, of_planes(tile->position, k), of_planes(tile->normal, k))) {
            asked &= ~((uint64_t)1 << k);
            for (int c = 0; c < 3; ++c) {
                near->light.rgb[c][k] = rgb[c];
            }
        }
    }
    return asked;
}

static void keep(const mix_job *j, const lmb_tile *tile, const lmb_irradiance *light, uint64_t which)
{
    const int32_t width = j->picture.width, height = j->picture.height;
    int32_t from[2];
    const int has_room = find_origin(from, j, tile);
    for (int k = 0; k < LMB_TILE_PIXELS && has_room; ++k) {
        const int32_t x = from[0] + k % LMB_TILE, y = from[1] + k / LMB_TILE;
        if ((which >> k & 1) != 0 && x < width && y < height) {
            mix_lit *to = &j->lit[(size_t)y * (size_t)width + (size_t)x];
            to->position = of_planes(tile->position, k);
            to->normal = of_planes(tile->normal, k);
            to->is_known = mix_carry_see(&to->x, &to->y, j, to->position);
            for (int c = 0; c < 3; ++c) {
                to->rgb[c] = light->rgb[c][k];
            }
        }
    }
}

/* --- traced ------------------------------------------------------------------------------------------------------- */

static void trace(mix_near *near, const mix_job *j, const lmb_tile *tile, uint64_t asked)
{
    int of[LMB_TILE_PIXELS], count = 0;
    lmb_irradiance light;
    memset(&light, 0, sizeof light);
    memset(&near->asked, 0, sizeof near->asked);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        if ((asked >> k & 1) != 0) {
            mix_put_place(&near->asked, count, tile, k);
            of[count++] = k;
        }
    }
    if (count > 0) {
        mix_cones_tile(&light, j, &near->asked);
    }
    for (int n = 0; n < count; ++n) {
        for (int c = 0; c < 3; ++c) {
            near->light.rgb[c][of[n]] = light.rgb[c][n];
        }
    }
}

void mix_cones_near(lmb_irradiance *inout, const mix_job *j, const lmb_tile *tile, mix_near *near)
{
    uint64_t asked = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        if (tile->id[k] != 0 && !is_near(near, tile, k, j->world->voxels.leaf)) {
            asked |= (uint64_t)1 << k;
        }
    }
    trace(near, j, tile, carry(near, j, tile, asked));
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        if ((asked >> k & 1) != 0) {
            mix_put_place(&near->tile, k, tile, k);
        }
    }
    keep(j, tile, &near->light, asked);
    for (int k = 0; k < 3 * LMB_TILE_PIXELS; ++k) {
        if (tile->id[k % LMB_TILE_PIXELS] != 0) {
            inout->rgb[k / LMB_TILE_PIXELS][k % LMB_TILE_PIXELS] +=
                near->light.rgb[k / LMB_TILE_PIXELS][k % LMB_TILE_PIXELS];
        }
    }
}
