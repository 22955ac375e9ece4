/* multisample.c: several samples of coverage and direct light per pixel, bounced light once per surface. Layer 8. */
#include <string.h>

#include "../base/vec.h"
#include "../raster/target.h"
#include "../raster/tile.h"
#include "stages.h"
#include "requires.h"

#if LMB_MULTISAMPLE

/* Sets the view of one sample, and the rows for it in the shared memory. Both are in scratch, to save stack. */
static void set_sample(lmb_multisample *m, const lmb_frame *f, int32_t sample, int32_t band)
{
    m->view = f->view;
    lmb_view_sample(&m->view, f->samples, sample);
    lmb_target_rows(&m->window, &m->eye, sample, 1);
    m->window.y0 = band * LMB_TILE;
}

lmb_status lmb_multisample_check(const lmb_frame *f, const lmb_band_scratch *s)
{
    if (f->samples == 1) {
        return LMB_OK;
    }
    const lmb_multisample *m = s->multisample;
    if ((f->samples != 4 && f->samples != 8 && f->samples != 16) || m == NULL || m->eye.depth.data == NULL ||
        m->eye.id.data == NULL || m->eye.depth.width != f->view.frame_width ||
        m->eye.depth.height != f->samples * LMB_TILE || f->view.sample_x != 0 || f->view.sample_y != 0) {
        return LMB_ERR_ARG;
    }
    lmb_target first;
    lmb_target_rows(&first, &m->eye, 0, 1);
    return lmb_target_check(&first, &f->view, lmb_scene_triangles(f->scene));
}

lmb_status lmb_multisample_draw(const lmb_render *r, lmb_band_scratch *s, int32_t band)
{
    const lmb_frame *f = &r->frame;
    lmb_multisample *m = s->multisample;
    lmb_status status = LMB_OK;
    for (int32_t i = 0; i < f->samples && status == LMB_OK; ++i) {
        set_sample(m, f, i, band);
        lmb_surface_clear(&m->window.depth);
        lmb_surface_clear(&m->window.id);
        status = lmb_draw(&m->window, f->kernels, &m->view, f->scene, 1, r->triangles, LMB_CULL_BACK | LMB_BLEND, NULL);
    }
    return status;
}

/* --- bounced light of a sample, taken from the same surface nearby ------------------------------------------------ */

/* Does pixel j of tile b continue the surface at pixel i of tile a? */
static int are_on_one_surface(const lmb_tile *a, int i, const lmb_tile *b, int j)
{
    if (a->id[i] == b->id[j]) {
        return 1;
    }
    const lmb_vec3 n = tile_vec(a->face, i), d = sub3(tile_vec(b->position, j), tile_vec(a->position, i));
    const float height = dot3(n, d);
    return b->id[j] != 0 && dot3(tile_vec(a->normal, i), tile_vec(b->normal, j)) >= TILE_COS_25 &&
           height * height <= TILE_FLAT * TILE_FLAT * dot3(d, d);
}

static void take_light(lmb_irradiance *out, int to, const lmb_irradiance *in, int from)
{
    for (int c = 0; c < 3; ++c) {
        out->rgb[c][to] = in->rgb[c][from];
    }
}

/* The pixel with the surface of the sample in pixel k at its middle: k, a neighbour, or -1. */
static int find_middle(const lmb_tile *middle, const lmb_tile *sample, int k)
{
    static const int8_t near[9][2] = {{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}};
    for (int i = 0; i < 9; ++i) {
        const int x = k % LMB_TILE + near[i][0], y = k / LMB_TILE + near[i][1];
        if (x >= 0 && x < LMB_TILE && y >= 0 && y < LMB_TILE &&
            are_on_one_surface(sample, k, middle, y * LMB_TILE + x)) {
            return y * LMB_TILE + x;
        }
    }
    return -1;
}

/* A surface that no pixel's middle shows, gathered for an earlier sample of pixel k or of a neighbour; or -1. */
static int find_extra(const lmb_multisample *m, int k)
{
    for (int i = 0; i < m->extras; ++i) {
        const int dx = m->extra_pixel[i] % LMB_TILE - k % LMB_TILE, dy = m->extra_pixel[i] / LMB_TILE - k / LMB_TILE;
        if (dx * dx <= 1 && dy * dy <= 1 && are_on_one_surface(&m->tile, k, &m->extra, i)) {
            return i;
        }
    }
    return -1;
}

/* Gathers the rest of the sample's pixels, and stores them for later samples while there is room. */
NOINLINE lmb_status gather_left(const lmb_render *r, lmb_band_scratch *s, uint64_t left)
{
    lmb_multisample *m = s->multisample;
    lmb_tile *tile = &s->together;
    int count = 0;
    memset(tile, 0, sizeof *tile);
    for (uint64_t bits = left; bits != 0; bits &= bits - 1) {
        tile_put_pixel(tile, count++, &m->tile, lowest_bit_64(bits));
    }
    memset(&s->indirect, 0, sizeof s->indirect);
    lmb_render_onto_triangles(tile, &r->frame);
    const lmb_status status = lmb_render_gather(&s->indirect, NULL, r, s, tile, NULL);
    count = 0;
    for (uint64_t bits = left; bits != 0; bits &= bits - 1, ++count) {
        const int k = lowest_bit_64(bits);
        take_light(&m->light, k, &s->indirect, count);
        if (m->extras < LMB_TILE_PIXELS) {
            tile_put_pixel(&m->extra, m->extras, tile, count);
            take_light(&m->extra_light, m->extras, &s->indirect, count);
            m->extra_pixel[m->extras++] = (uint8_t)k;
        }
    }
    memset(tile, 0, sizeof *tile);
    return status;
}

static lmb_status find_light(const lmb_render *r, lmb_band_scratch *s)
{
    lmb_multisample *m = s->multisample;
    uint64_t left = 0;
    memset(&m->light, 0, sizeof m->light);
    memset(m->middle_of, -1, sizeof m->middle_of);
    for (uint64_t bits = requires_bounce(&r->frame) ? tile_pixels(&m->tile) : 0; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits), middle = find_middle(&s->tile, &m->tile, k);
        const int extra = middle < 0 ? find_extra(m, k) : -1;
        m->middle_of[k] = (int16_t)middle;
        if (middle >= 0) {
            take_light(&m->light, k, &m->middle, middle);
        } else if (extra >= 0) {
            take_light(&m->light, k, &m->extra_light, extra);
        } else {
            left |= (uint64_t)1 << k;
        }
    }
    return left != 0 ? gather_left(r, s, left) : LMB_OK;
}

/* --- a tile ------------------------------------------------------------------------------------------------------- */

/* Adds the bounced light that lobes reflect, if a pixel's middle shows the sample's surface. */
static void add_lobes(lmb_glossy *inout, const lmb_multisample *m)
{
    for (uint64_t bits = inout->pixels; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits), middle = m->middle_of[k];
        for (int c = 0; c < 3 && middle >= 0 && (m->lobe_pixels >> middle & 1u) != 0; ++c) {
            inout->rgb[c][k] += m->lobes.rgb[c][middle];
        }
    }
}

static void add_sample(lmb_radiance *sum, const lmb_radiance *one, float weight, float white)
{
    for (int c = 0; c < 3; ++c) {
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            const float value = one->rgb[c][k];
            sum->rgb[c][k] += weight * (value > white ? white : value);
        }
    }
}

static lmb_status light_frame_sample(const lmb_render *r, lmb_band_scratch *s)
{
    lmb_multisample *m = s->multisample;
    const lmb_view *view = &m->view;
    lmb_status status = find_light(r, s);
    lmb_glossy *glossy =
        requires_glossy(r) && lmb_glossy_tile(&s->glossy, &m->tile, view, r->frame.scene) ? &s->glossy : NULL;
    if (status == LMB_OK) {
        status = lmb_render_direct(r, glossy, s, &m->tile, view);
    }
    if (status == LMB_OK && glossy != NULL) {
        add_lobes(glossy, m);
    }
    return status == LMB_OK ? lmb_render_radiance(r, glossy, s, &m->tile, view, &m->light) : status;
}

lmb_status lmb_multisample_light(const lmb_render *r, lmb_band_scratch *s, const lmb_irradiance *middle,
                                 const lmb_glossy *lobes, int32_t band, float white)
{
    const lmb_frame *f = &r->frame;
    lmb_multisample *m = s->multisample;
    lmb_status status = LMB_OK;
    m->extras = 0;
    m->lobe_pixels = lobes != NULL ? lobes->pixels : 0;
    m->middle = *middle;
    if (lobes != NULL) {
        memcpy(m->lobes.rgb, lobes->rgb, sizeof m->lobes.rgb);
    }
    memset(&m->sum, 0, sizeof m->sum);
    for (int32_t i = 0; i < f->samples && status == LMB_OK; ++i) {
        set_sample(m, f, i, band);
        status = lmb_resolve_tile(&m->tile, f->kernels, &m->view, f->scene, &m->window, s->tile.x, s->tile.y);
        if (status == LMB_OK) {
            status = light_frame_sample(r, s);
        }
        add_sample(&m->sum, &s->radiance, 1.0f / (float)f->samples, white);
    }
    s->radiance = m->sum;
    return status;
}

#endif
