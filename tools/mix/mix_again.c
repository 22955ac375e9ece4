/* mix_again.c: the result of a frame, kept per pixel and reused for another photo of the same scene. */
#include "mix_again.h"

#include "mix_frames.h"

#include <string.h>

int mix_again_take(mix_job *j, report *r)
{
    const size_t pixels = (size_t)j->frame.light.width * (size_t)j->frame.light.height;
    if (j->kept == NULL || j->o.specular > 0.0f || j->o.show != MIX_FINAL) {
        return 1;
    }
    j->answer = mix_take(j, pixels * sizeof *j->answer, r);
    j->is_settled = mix_is_settled(j->kept);
    return j->answer != NULL;
}

static void keep_pixel(mix_answer *out, int k, const lmb_irradiance *without, const lmb_irradiance *with,
                       const lmb_radiance *object, const float *covered, int is_real)
{
    for (int c = 0; c < 3; ++c) {
        out->light[0][c] = is_real ? without->rgb[c][k] : 0.0f;
        out->light[1][c] = is_real ? with->rgb[c][k] : 0.0f;
        out->object[c] = object->rgb[c][k];
    }
    out->covered = covered[k];
}

void mix_again_keep(mix_job *j, const lmb_tile *real, const lmb_irradiance *without, const lmb_irradiance *with,
                    const lmb_radiance *object, const float *covered)
{
    const int32_t width = j->picture.width, height = j->picture.height;
    for (int k = 0; k < LMB_TILE_PIXELS && j->answer != NULL; ++k) {
        const int32_t x = real->x + k % LMB_TILE, y = real->y + k / LMB_TILE;
        if (x < width && y < height) {
            keep_pixel(&j->answer[(size_t)y * (size_t)width + (size_t)x], k, without, with, object, covered,
                       real->id[k] != 0);
        }
    }
}

/* The stored result of a pixel. NULL: the depth is new, or the pixel lies outside the photo. */
static const mix_answer *kept_of(const mix_job *j, const lmb_tile *real, int k)
{
    const int32_t x = real->x + k % LMB_TILE, y = real->y + k / LMB_TILE, width = j->frame.light.width;
    const size_t at = (size_t)y * (size_t)width + (size_t)x;
    return x < width && y < j->frame.light.height && !j->kept->depth.fresh[at] ? &j->kept->last->answer[at] : NULL;
}

int mix_again_light(lmb_irradiance *without, lmb_irradiance *with, const mix_job *j, const lmb_tile *real)
{
    int fresh = 0;
    if (!j->is_settled) {
        return 0;
    }
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const mix_answer *a = kept_of(j, real, k);
        for (int c = 0; c < 3 && a != NULL; ++c) {
            without->rgb[c][k] = a->light[0][c];
            with->rgb[c][k] = a->light[1][c];
        }
        fresh += a == NULL;
    }
    return fresh == 0;
}

void mix_again_object(lmb_radiance *object, float *covered, const mix_job *j, const lmb_tile *real)
{
    for (int k = 0; k < LMB_TILE_PIXELS && j->is_settled; ++k) {
        const mix_answer *a = kept_of(j, real, k);
        for (int c = 0; c < 3 && a != NULL; ++c) {
            object->rgb[c][k] = a->object[c];
        }
        covered[k] = a != NULL ? a->covered : covered[k];
    }
}

/* As many pixels as a tile has, fewer at the end. */
static void draw_run(mix_job *j, size_t at, int32_t count)
{
    const mix_answer *a = &j->answer[at];
    lmb_tile tile;
    lmb_irradiance light[2], soft;
    lmb_radiance photo;
    memset(tile.id, 0, sizeof tile.id);
    memset(&light, 0, sizeof light);
    memset(&photo, 0, sizeof photo);
    for (int32_t k = 0; k < count; ++k) {
        tile.id[k] = 1;
        for (int c = 0; c < 3; ++c) {
            light[0].rgb[c][k] = a[k].light[0][c];
            light[1].rgb[c][k] = a[k].light[1][c];
            photo.rgb[c][k] = j->frame.light.pixels[3 * (at + (size_t)k) + (size_t)c];
        }
    }
    lmb_delta_tile(&photo, &tile, &light[0], mix_soften(&soft, &light[1], &light[0], j->softens));
    for (int32_t k = 0; k < count; ++k) {
        for (int c = 0; c < 3; ++c) {
            j->picture.pixels[3 * (at + (size_t)k) + (size_t)c] =
                mix_over(photo.rgb[c][k], a[k].object[c], a[k].covered);
        }
    }
}

void mix_again_draw(mix_job *j)
{
    const size_t pixels = (size_t)j->picture.width * (size_t)j->picture.height;
    for (size_t i = 0; i < pixels; i += LMB_TILE_PIXELS) {
        draw_run(j, i, (int32_t)(pixels - i < LMB_TILE_PIXELS ? pixels - i : LMB_TILE_PIXELS));
    }
}
