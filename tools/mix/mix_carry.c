/* mix_carry.c: indirect light at a frame's pixels, kept for the next frame. */
#include "mix_carry.h"

#include <math.h>
#include <string.h>

#include "mix_world.h"

enum { AGAIN = 24 /* frames after which a tile is traced again */, BESIDE = 2 /* px, to each side */ };

/* Pixels of two frames show the same place if their distances agree and the cosine between their normals is over
 * this. */
#define ALIKE 0.7f
#define ENOUGH 0.5f /* of the weights of four pixels around a place */
#define SMOOTH 0.9f /* minimum cosine between normals of pixels on one surface */
#define FLAT 0.3f   /* maximum distance from the other pixel's plane, as a share of the distance between the pixels */

int mix_carry_take(mix_job *j, report *r)
{
    const size_t pixels = (size_t)j->frame.light.width * (size_t)j->frame.light.height;
    if (j->kept == NULL) {
        return 1;
    }
    j->carried = mix_take(j, pixels * sizeof *j->carried, r);
    j->lit = mix_take(j, pixels * sizeof *j->lit, r);
    if (j->kept->last != NULL && j->kept->last->carried != NULL) {
        const lmb_mat4 back = mix_back(&j->from_world);
        j->to_last = mix_product(&j->kept->last->from_world, &back);
    }
    return j->carried != NULL && j->lit != NULL;
}

/* If the voxels are new, or the light has changed, all tiles are traced again. Otherwise tiles with old and new light
 * would lie side by side. */
static int has_last(const mix_job *j)
{
    const mix_job *last = j->kept != NULL ? j->kept->last : NULL;
    return last != NULL && last->carried != NULL && j->carried != NULL && last->world == j->world &&
           !j->kept->is_other_light;
}

static int32_t turn_of(const mix_job *j, int32_t x, int32_t y)
{
    return x / LMB_TILE * 5 + y / LMB_TILE * 3 + j->kept->frames;
}

int mix_carry_knows(const mix_job *j, int32_t x, int32_t y) { return has_last(j) && turn_of(j, x, y) % AGAIN != 0; }

int mix_carry_turn(const mix_job *j, int32_t x, int32_t y) { return turn_of(j, x, y) / AGAIN; }

static float along(lmb_vec3 a, lmb_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/* Position and orientation of a pixel's place in the previous frame. */
typedef struct there {
    float x, y, inverse;
    lmb_vec3 normal; /* in that frame's camera space */
} there;

static lmb_vec3 to_camera(const mix_job *j, lmb_vec3 v)
{
    const lmb_vec3 out = {along(j->axes.right, v), along(j->axes.up, v), along(j->axes.back, v)};
    return out;
}

static there project(const mix_job *last, lmb_vec3 p)
{
    const lmb_vec3 at = to_camera(last, p);
    const lmb_pinhole *c = &last->frame.camera;
    const there out = {c->cx - c->fx * at.x / at.z, c->cy + c->fy * at.y / at.z, -1.0f / at.z, {0, 0, 0}};
    return out;
}

static there look(const mix_job *j, const mix_job *last, const lmb_tile *real, int k)
{
    const lmb_vec3 p = {real->position[0][k], real->position[1][k], real->position[2][k]},
                   n = {real->normal[0][k], real->normal[1][k], real->normal[2][k]};
    there out = project(last, mix_move(&j->to_last, p));
    out.normal = to_camera(last, mix_turn(&j->to_last, n));
    return out;
}

static int is_seen(const there *t) { return t->inverse > 0.0f && fabsf(t->x) < 1e6f && fabsf(t->y) < 1e6f; }

int mix_carry_see(float *x, float *y, const mix_job *last, lmb_vec3 at)
{
    const there t = project(last, at);
    *x = t.x;
    *y = t.y;
    return is_seen(&t);
}

/* Does a pixel of the previous frame show the same place? */
static int is_same(const mix_job *last, const there *t, int32_t x, int32_t y)
{
    const lmb_pinhole *c = &last->frame.camera;
    if (x < 0 || y < 0 || x >= c->width || y >= c->height) {
        return 0;
    }
    const size_t i = (size_t)y * (size_t)c->width + (size_t)x;
    return last->carried[i].is_known && mix_agree(last->cloud.inverse[i], t->inverse) &&
           along(last->cloud.normal[i], t->normal) > ALIKE;
}

static int get_pixel(mix_carried *out, const mix_job *last, const there *t)
{
    const int32_t w = last->frame.camera.width, u = (int32_t)floorf(t->x), v = (int32_t)floorf(t->y);
    const float s = t->x - (float)u, f = t->y - (float)v;
    float sum = 0.0f;
    int all_lit = 1;
    memset(out, 0, sizeof *out);
    for (int32_t i = 0; i < 4; ++i) {
        const int32_t x = u + (i & 1), y = v + (i >> 1);
        const float weight = (i & 1 ? s : 1.0f - s) * (i >> 1 ? f : 1.0f - f);
        if (weight > 0.0f && is_same(last, t, x, y)) {
            const mix_carried *from = &last->carried[(size_t)y * (size_t)w + (size_t)x];
            sum += weight;
            all_lit &= from->direct[0] >= 0.0f;
            for (int c = 0; c < 6; ++c) {
                out->rgb[c / 3][c % 3] += weight * from->rgb[c / 3][c % 3];
            }
            for (int c = 0; c < 3; ++c) {
                out->direct[c] += weight * from->direct[c];
            }
        }
    }
    for (int c = 0; c < 6 && sum > 0.0f; ++c) {
        out->rgb[c / 3][c % 3] /= sum;
    }
    for (int c = 0; c < 3 && sum > 0.0f; ++c) {
        out->direct[c] = all_lit ? out->direct[c] / sum : -1.0f;
    }
    return sum >= ENOUGH;
}

/* If noise hides a place or turns its normal, the light of the nearest pixel on the same surface. A new trace would be
 * 0.1 to 0.2 dB more accurate, but such pixels would be most of the traced ones. */
static int get_near(mix_carried *out, const mix_job *last, const there *t)
{
    const int32_t w = last->frame.camera.width, u = (int32_t)floorf(t->x + 0.5f), v = (int32_t)floorf(t->y + 0.5f);
    float near2 = 2.0f * (BESIDE + 1) * (BESIDE + 1);
    int is_found = 0;
    for (int32_t y = v - BESIDE; y <= v + BESIDE; ++y) {
        for (int32_t x = u - BESIDE; x <= u + BESIDE; ++x) {
            const float dx = (float)x - t->x, dy = (float)y - t->y, d2 = dx * dx + dy * dy;
            if (d2 < near2 && is_same(last, t, x, y)) {
                near2 = d2;
                is_found = 1;
                *out = last->carried[(size_t)y * (size_t)w + (size_t)x];
            }
        }
    }
    return is_found;
}

uint64_t mix_carry_get(lmb_irradiance *without, lmb_irradiance *with, mix_direct *direct, const mix_job *j,
                       const lmb_tile *real)
{
    const mix_job *last = j->kept != NULL ? j->kept->last : NULL;
    uint64_t known = 0;
    memset(direct, 0, sizeof *direct);
    for (int k = 0; k < LMB_TILE_PIXELS && has_last(j); ++k) {
        mix_carried one;
        if (real->id[k] == 0) {
            continue;
        }
        const there t = look(j, last, real, k);
        if (is_seen(&t) && (get_pixel(&one, last, &t) || get_near(&one, last, &t))) {
            known |= (uint64_t)1 << k;
            direct->known |= (uint64_t)(one.direct[0] >= 0.0f) << k;
            for (int c = 0; c < 3; ++c) {
                without->rgb[c][k] = one.rgb[0][c];
                with->rgb[c][k] = one.rgb[1][c];
                direct->light.rgb[c][k] = one.direct[0] >= 0.0f ? one.direct[c] : 0.0f;
            }
        }
    }
    return known;
}

static int is_beside(const lmb_tile *t, int a, int b)
{
    const lmb_vec3 n = {t->normal[0][a], t->normal[1][a], t->normal[2][a]},
                   m = {t->normal[0][b], t->normal[1][b], t->normal[2][b]},
                   d = {t->position[0][b] - t->position[0][a], t->position[1][b] - t->position[1][a],
                        t->position[2][b] - t->position[2][a]};
    const float over = fmaxf(fabsf(along(n, d)), fabsf(along(m, d)));
    return along(n, m) > SMOOTH && over * over <= FLAT * FLAT * along(d, d);
}

/* The nearest carried pixel around k on the same surface, or -1. */
static int find_beside(const lmb_tile *t, uint64_t carried, int k)
{
    const int x = k % LMB_TILE, y = k / LMB_TILE;
    int best = -1, near2 = 2 * BESIDE * BESIDE + 1;
    for (int v = y > BESIDE ? y - BESIDE : 0; v <= y + BESIDE && v < LMB_TILE; ++v) {
        for (int u = x > BESIDE ? x - BESIDE : 0; u <= x + BESIDE && u < LMB_TILE; ++u) {
            const int i = v * LMB_TILE + u, d2 = (u - x) * (u - x) + (v - y) * (v - y);
            if ((carried >> i & 1) != 0 && d2 < near2 && is_beside(t, k, i)) {
                best = i;
                near2 = d2;
            }
        }
    }
    return best;
}

uint64_t mix_carry_spread(lmb_irradiance *without, lmb_irradiance *with, const lmb_tile *real, uint64_t carried,
                          uint64_t wanted)
{
    uint64_t found = 0;
    for (int k = 0; carried != 0 && k < LMB_TILE_PIXELS; ++k) {
        const int from = (wanted >> k & 1) != 0 && real->id[k] != 0 ? find_beside(real, carried, k) : -1;
        for (int c = 0; c < 3 && from >= 0; ++c) {
            without->rgb[c][k] = without->rgb[c][from];
            with->rgb[c][k] = with->rgb[c][from];
        }
        found |= (uint64_t)(from >= 0) << k;
    }
    return found;
}

void mix_carry_put(const mix_job *j, const lmb_tile *real, const lmb_irradiance *without, const lmb_irradiance *with)
{
    const int32_t width = j->picture.width, height = j->picture.height;
    for (int k = 0; k < LMB_TILE_PIXELS && j->carried != NULL; ++k) {
        const int32_t x = real->x + k % LMB_TILE, y = real->y + k / LMB_TILE;
        if (x < width && y < height && real->id[k] != 0) {
            mix_carried *to = &j->carried[(size_t)y * (size_t)width + (size_t)x];
            to->is_known = 1;
            to->direct[0] = -1.0f;
            for (int c = 0; c < 3; ++c) {
                to->rgb[0][c] = without->rgb[c][k];
                to->rgb[1][c] = with->rgb[c][k];
            }
        }
    }
}

void mix_carry_put_direct(const mix_job *j, const lmb_tile *real, const mix_direct *direct)
{
    const int32_t width = j->picture.width, height = j->picture.height;
    for (int k = 0; k < LMB_TILE_PIXELS && j->carried != NULL; ++k) {
        const int32_t x = real->x + k % LMB_TILE, y = real->y + k / LMB_TILE;
        for (int c = 0; c < 3 && x < width && y < height && (direct->known >> k & 1) != 0; ++c) {
            j->carried[(size_t)y * (size_t)width + (size_t)x].direct[c] = direct->light.rgb[c][k];
        }
    }
}
