/* picture.c: a linear frame -> the file format its name asks for. */
#include "picture.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <lambent/lambent.h>

int picture_format(const char *path)
{
    static const char *const endings[] = {".png", ".ppm", ".pfm", ".hdr"};
    size_t n = strlen(path);
    for (int i = 0; i < 4 && n > 4; ++i) {
        int same = 1;
        for (size_t k = 0; k < 4; ++k) {
            same &= tolower((unsigned char)path[n - 4 + k]) == endings[i][k];
        }
        if (same) {
            return PICTURE_PNG + i;
        }
    }
    return PICTURE_UNKNOWN;
}

int picture_is_linear(int format) { return format == PICTURE_PFM || format == PICTURE_HDR; }

int picture_option(const char *text, void *at) { return picture_format(*(const char **)at = text) != PICTURE_UNKNOWN; }

/* A histogram of the brightest channel in eighths of a stop: no sorting, no memory. */
float picture_auto_exposure(const image *p)
{
    enum { STEPS = 512, MIDDLE = 256 };
    uint32_t counts[STEPS] = {0}, lit = 0, above = 0;
    size_t pixels = (size_t)p->width * (size_t)p->height;
    for (size_t i = 0; i < pixels; ++i) {
        const float *v = p->pixels + 3 * i;
        float max = v[0] > v[1] ? v[0] : v[1];
        max = v[2] > max ? v[2] : max;
        if (max > 1e-9f && max < 1e9f) {
            ++counts[(int)(log2((double)max) * 8.0 + MIDDLE)];
            ++lit;
        }
    }
    for (int step = STEPS - 1; step >= 0; --step) {
        above += counts[step];
        if (above * 100u >= lit && lit > 0) {
            return -(float)(step + 1 - MIDDLE) / 8.0f;
        }
    }
    return 0.0f;
}

/* By the library's own tone curve, tile by tile. */
uint8_t *picture_codes(const image *p, float exposure_ev)
{
    const lmb_kernels *kernels = lmb_kernels_pick();
    size_t pixels = (size_t)p->width * (size_t)p->height;
    uint8_t *rgba = malloc(pixels * 4);
    lmb_surface out;
    if (rgba == NULL || lmb_surface_init(&out, LMB_RGBA8, p->width, p->height, rgba, pixels * 4) != LMB_OK) {
        free(rgba);
        return NULL;
    }
    for (int32_t y = 0; y < p->height; y += LMB_TILE) {
        for (int32_t x = 0; x < p->width; x += LMB_TILE) {
            lmb_radiance tile;
            memset(&tile, 0, sizeof tile);
            for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
                int32_t px = x + k % LMB_TILE, py = y + k / LMB_TILE;
                for (int c = 0; c < 3 && px < p->width && py < p->height; ++c) {
                    tile.rgb[c][k] = p->pixels[((size_t)py * (size_t)p->width + (size_t)px) * 3 + (size_t)c];
                }
            }
            lmb_store_tile(&out, kernels, 0, 0, &tile, x, y, exposure_ev);
        }
    }
    for (size_t i = 0; i < pixels; ++i) { /* to RGB, in place */
        rgba[3 * i] = rgba[4 * i];
        rgba[3 * i + 1] = rgba[4 * i + 1];
        rgba[3 * i + 2] = rgba[4 * i + 2];
    }
    return rgba;
}

int picture_write(const char *path, const image *p, float exposure_ev, report *r)
{
    file_bytes file = {NULL, 0};
    int format = picture_format(path), ok;
    if (picture_is_linear(format)) {
        ok = format == PICTURE_PFM ? pfm_encode(&file, p, r) : hdr_encode(&file, p, r);
    } else {
        uint8_t *rgb = picture_codes(p, exposure_ev);
        if (rgb == NULL) {
            return report_fail(r, "%s: not enough memory for the picture; try a smaller --size", path);
        }
        ok = format == PICTURE_PNG ? png_encode(&file, rgb, p->width, p->height, r)
                                   : ppm_encode(&file, rgb, p->width, p->height, r);
        free(rgb);
    }
    ok = ok && file_write(path, file.data, file.size, r);
    file_free(&file);
    return ok;
}
