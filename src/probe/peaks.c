/* peaks.c: finds small lights in a world's cube, which sampling would miss or count twice. Layer 5.         [S8 S14]
 *
 * Within each quarter by quarter of a face, light over four times the mean is a peak. The mean is then recomputed with
 * light clamped to this limit, CLAMP_ROUNDS times. So the sun is found at any brightness, and half of a wide window is
 * not. Peaks are summed in 32nds by 32nds of a face, from the texels of each. */
#include "world.h"

#include "../base/poly.h"
#include "cube.h"

enum { WIDE_PARTS = 4, NARROW_PARTS = LMB_WORLD_NARROW, CLAMP_ROUNDS = 3 };

static const float min_peak_contrast = 4.0f; /* times the mean of the surroundings */
static const float least_part = 1e-4f; /* of all light: dimmer lights are not peaks */

static float solid_angle_of_texel(int32_t x, int32_t y, int32_t n)
{
    const float s = cube_coordinate(x, n), t = cube_coordinate(y, n), l2 = 1.0f + s * s + t * t;
    return 4.0f / ((float)n * (float)n * (l2 * sqrtf(l2)));
}

static float brightest_channel(const float rgba[4]) { return rgba[3] * maxf(rgba[0], maxf(rgba[1], rgba[2])); }

static void world_texel_at(float out[4], const lmb_world *w, int32_t face, int32_t x, int32_t y)
{
    lmb_world_texel(out, w, lmb_world_face_texel(&w->cube[0], face, x, y));
}

/* First texel of part i of `parts` in a row of n. */
static int32_t part_from(int32_t i, int32_t parts, int32_t n) { return i * n / parts; }

static int32_t part_of_face(int32_t x, int32_t parts, int32_t n) { return (parts * x + parts - 1) / n; }

/* Mean of a part's texels, each clamped to `limit`. */
static float mean_under(const lmb_world *w, const cube_place *part, float limit)
{
    const int32_t n = w->cube[0].width, x0 = part_from(part->x, WIDE_PARTS, n),
                  x1 = part_from(part->x + 1, WIDE_PARTS, n), y0 = part_from(part->y, WIDE_PARTS, n),
                  y1 = part_from(part->y + 1, WIDE_PARTS, n);
    float sum = 0.0f;
    for (int32_t y = y0; y < y1; ++y) {
        for (int32_t x = x0; x < x1; ++x) {
            float rgba[4];
            world_texel_at(rgba, w, part->face, x, y);
            sum += minf(brightest_channel(rgba), limit);
        }
    }
    return sum / (float)((x1 - x0) * (y1 - y0));
}

/* Light over this limit is a peak. */
static float limit_of(const lmb_world *w, const cube_place *part)
{
    float limit = 1e30f;
    for (int i = 0; i < CLAMP_ROUNDS; ++i) {
        limit = min_peak_contrast * mean_under(w, part, limit);
    }
    return limit;
}

/* Share of a texel's light over the limit. */
static float part_over(const float rgba[4], float limit)
{
    const float light = brightest_channel(rgba);
    return light > limit ? 1.0f - limit / light : 0.0f;
}

/* Sums the peak in one 32nd by 32nd. */
static void sum_peak(lmb_world_peak *inout, const lmb_world *w)
{
    const int32_t n = w->cube[0].width;
    for (int32_t y = part_from(inout->y, NARROW_PARTS, n); y < part_from(inout->y + 1, NARROW_PARTS, n); ++y) {
        for (int32_t x = part_from(inout->x, NARROW_PARTS, n); x < part_from(inout->x + 1, NARROW_PARTS, n); ++x) {
            float rgba[4];
            world_texel_at(rgba, w, inout->face, x, y);
            const float over = part_over(rgba, inout->limit), area = solid_angle_of_texel(x, y, n),
                        light = over * area * rgba[3];
            if (over > 0.0f) {
                inout->to =
                    add3(inout->to, mul3(cube_direction(inout->face, x, y, n), light * brightest_channel(rgba)));
                inout->area += area;
                for (int c = 0; c < 3; ++c) {
                    inout->flux[c] += light * rgba[c];
                }
            }
        }
    }
    inout->to = inout->area > 0.0f ? normalize3(inout->to) : inout->to;
}

static float flux_of(const lmb_world_peak *p) { return p->flux[0] + p->flux[1] + p->flux[2]; }

/* Inserts a peak, strongest first; if the list is full, the weakest is dropped. */
static void keep_peak(lmb_world *inout, const lmb_world_peak *peak)
{
    int32_t i = inout->peaks;
    if (i < LMB_WORLD_PEAKS) {
        ++inout->peaks;
    } else if (flux_of(peak) <= flux_of(&inout->peak[--i])) {
        return;
    }
    for (; i > 0 && flux_of(&inout->peak[i - 1]) < flux_of(peak); --i) {
        inout->peak[i] = inout->peak[i - 1];
    }
    inout->peak[i] = *peak;
}

/* Finds the peaks of one quarter by quarter. Returns the mean light of the part. */
static float find_in_part(lmb_world *inout, const cube_place *part)
{
    const float limit = limit_of(inout, part);
    for (int32_t i = 0; i < NARROW_PARTS / WIDE_PARTS * (NARROW_PARTS / WIDE_PARTS); ++i) {
        lmb_world_peak peak = {{0, 0, 0}, {0, 0, 0}, 0, limit, part->face, part->x * (NARROW_PARTS / WIDE_PARTS),
                               part->y};
        peak.x += i % (NARROW_PARTS / WIDE_PARTS);
        peak.y = peak.y * (NARROW_PARTS / WIDE_PARTS) + i / (NARROW_PARTS / WIDE_PARTS);
        sum_peak(&peak, inout);
        if (flux_of(&peak) > 1e-10f && flux_of(&peak) < 1e30f) {
            keep_peak(inout, &peak);
        }
    }
    return mean_under(inout, part, 1e30f);
}

int32_t lmb_world_find_peaks(lmb_world *inout)
{
    float sum = 0.0f;
    inout->peaks = 0;
    for (int32_t i = 0; i < 6 * WIDE_PARTS * WIDE_PARTS && inout->cube[0].width >= NARROW_PARTS; ++i) {
        const cube_place part = {i / (WIDE_PARTS * WIDE_PARTS), i % WIDE_PARTS, i / WIDE_PARTS % WIDE_PARTS};
        sum += find_in_part(inout, &part);
    }
    const float all = sum * (4.0f * LMB_PI / (float)(6 * WIDE_PARTS * WIDE_PARTS));
    while (inout->peaks > 0 && flux_of(&inout->peak[inout->peaks - 1]) < least_part * all) {
        --inout->peaks;
    }
    return inout->peaks;
}

void lmb_world_calm_texel(float out[4], const lmb_world *world, int32_t face, int32_t x, int32_t y)
{
    const int32_t n = world->cube[0].width, across = part_of_face(x, NARROW_PARTS, n),
                  down = part_of_face(y, NARROW_PARTS, n);
    world_texel_at(out, world, face, x, y);
    for (int32_t i = 0; i < world->peaks; ++i) {
        const lmb_world_peak *p = &world->peak[i];
        if (p->face == face && p->x == across && p->y == down) {
            const float stays = 1.0f - part_over(out, p->limit);
            for (int c = 0; c < 3; ++c) {
                out[c] *= stays;
            }
        }
    }
}

void lmb_world_peak_texels(int32_t from[2], int32_t to[2], const lmb_world *world, const lmb_world_peak *peak)
{
    const int32_t n = world->cube[0].width;
    from[0] = part_from(peak->x, NARROW_PARTS, n);
    from[1] = part_from(peak->y, NARROW_PARTS, n);
    to[0] = part_from(peak->x + 1, NARROW_PARTS, n);
    to[1] = part_from(peak->y + 1, NARROW_PARTS, n);
}
