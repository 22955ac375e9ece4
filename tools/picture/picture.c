/* picture.c: writes a linear image in the format that the file name selects. */
#include "picture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <lambent/lambent.h>

#include "../common/ending.h"

/* `-` is a PNG, `pfm:-` a PFM. */
static int stdout_format(const char *path)
{
    static const char *const names[] = {"png:-", "ppm:-", "pfm:-", "hdr:-"};
    for (int i = 0; i < 4; ++i) {
        if (strcmp(path, names[i]) == 0) {
            return PICTURE_PNG + i;
        }
    }
    return strcmp(path, "-") == 0 ? PICTURE_PNG : PICTURE_UNKNOWN;
}

int picture_format(const char *path)
{
    static const char *const endings[] = {".png", ".ppm", ".pfm", ".hdr"};
    if (file_is_stdout(path)) {
        return stdout_format(path);
    }
    for (int i = 0; i < 4 && strlen(path) > 4; ++i) {
        if (has_ending(path, endings[i])) {
            return PICTURE_PNG + i;
        }
    }
    return PICTURE_UNKNOWN;
}

int picture_is_linear(int format) { return format == PICTURE_PFM || format == PICTURE_HDR; }

int picture_option(const char *text, void *at) { return picture_format(*(const char **)at = text) != PICTURE_UNKNOWN; }

#define SHOULDER    0.76f  /* Khronos PBR Neutral: 0.8, less the reflectance of 0.04 that the toe removes */
#define FADES       0.15f  /* how fast bright colours fade to white: Khronos PBR Neutral's desaturation */
#define MEDIAN_EV   -1.25f  /* half of the pixels are darker than 0.42 */
#define SHOULDER_EV 0.375f /* the brightest hundredth lies on the shoulder: makes middle tones brighter */
#define DARKEST_EV  -5.5f  /* half of them are brighter than code 40 of 255, even if the brightest are then white */

enum { STEPS = 512, MIDDLE = 256, STEPS_PER_STOP = 8 };

/* Histogram of pixel brightness in eighths of a stop: needs no sort and no memory. */
typedef struct brightness {
    uint32_t counts[STEPS], lit;
} brightness;

static void add_brightness(brightness *b, float v)
{
    if (v > 1e-9f && v < 1e9f) {
        ++b->counts[(int)(log2((double)v) * STEPS_PER_STOP + MIDDLE)];
        ++b->lit;
    }
}

/* Stops that bring the brightest of a share of the lit pixels to 1. */
static float stops_to_one(const brightness *b, uint32_t share)
{
    uint32_t above = 0;
    for (int step = STEPS - 1; step >= 0; --step) {
        above += b->counts[step];
        if (above * (uint64_t)share >= b->lit && b->lit > 0) {
            return -(float)(step + 1 - MIDDLE) / STEPS_PER_STOP;
        }
    }
    return 0.0f;
}

float picture_auto_exposure(const image *p, int tone)
{
    brightness peak = {{0}, 0}, luminance = {{0}, 0};
    const size_t pixels = (size_t)p->width * (size_t)p->height;
    for (size_t i = 0; i < pixels; ++i) {
        const float *v = p->pixels + 3 * i;
        add_brightness(&peak, fmaxf(v[0], fmaxf(v[1], v[2])));
        add_brightness(&luminance, 0.2126f * v[0] + 0.7152f * v[1] + 0.0722f * v[2]);
    }
    const float highest = stops_to_one(&peak, 100) + (tone == PICTURE_CURVED ? SHOULDER_EV : 0.0f);
    if (tone != PICTURE_CURVED || luminance.lit == 0) {
        return highest;
    }
    const float median = stops_to_one(&luminance, 2);
    return fmaxf(fminf(highest, median + MEDIAN_EV), median + DARKEST_EV);
}

/* Khronos PBR Neutral's shoulder, of one pixel. */
static void curve(float rgb[3])
{
    const float peak = fmaxf(rgb[0], fmaxf(rgb[1], rgb[2])), room = 1.0f - SHOULDER;
    if (!(peak > SHOULDER)) {
        return;
    }
    const float bent = 1.0f - room * room / (peak + room - SHOULDER);
    const float faded = 1.0f - 1.0f / (FADES * (peak - bent) + 1.0f);
    for (int c = 0; c < 3; ++c) {
        const float scaled = rgb[c] / peak * bent;
        rgb[c] = scaled + (bent - scaled) * faded;
    }
}

void picture_expose(image *p, float exposure_ev, int tone)
{
    const size_t pixels = (size_t)p->width * (size_t)p->height;
    const float by = exp2f(exposure_ev);
    for (size_t i = 0; i < pixels; ++i) {
        float *rgb = p->pixels + 3 * i;
        for (int c = 0; c < 3; ++c) {
            rgb[c] = fminf(rgb[c] * by, 3e38f);
        }
        if (tone == PICTURE_CURVED) {
            curve(rgb);
        }
    }
}

static int copy_of(image *out, const image *p)
{
    const size_t bytes = (size_t)p->width * (size_t)p->height * 3 * sizeof(float);
    *out = *p;
    out->pixels = malloc(bytes);
    if (out->pixels != NULL) {
        memcpy(out->pixels, p->pixels, bytes);
    }
    return out->pixels != NULL;
}

/* Display codes, computed tile by tile. */
static uint8_t *codes_of(const image *p, float exposure_ev)
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

uint8_t *picture_codes(const image *p, float exposure_ev, int tone)
{
    image shown;
    if (tone == PICTURE_CLIPPED) {
        return codes_of(p, exposure_ev);
    }
    if (!copy_of(&shown, p)) {
        return NULL;
    }
    picture_expose(&shown, exposure_ev, tone);
    uint8_t *codes = codes_of(&shown, 0.0f);
    image_free(&shown);
    return codes;
}

int picture_encode(file_bytes *out, int format, const image *p, float exposure_ev, int tone, report *r)
{
    memset(out, 0, sizeof *out);
    if (picture_is_linear(format)) {
        return format == PICTURE_PFM ? pfm_encode(out, p, r) : hdr_encode(out, p, r);
    }
    uint8_t *rgb = picture_codes(p, exposure_ev, tone);
    const int ok = rgb == NULL            ? report_fail(r, "not enough memory for the picture; try a smaller --size")
                   : format == PICTURE_PNG ? png_encode(out, rgb, p->width, p->height, r)
                                           : ppm_encode(out, rgb, p->width, p->height, r);
    free(rgb);
    return ok;
}

int picture_write(const char *path, const image *p, float exposure_ev, int tone, report *r)
{
    file_bytes file = {NULL, 0};
    report own = {""};
    int ok = picture_encode(&file, picture_format(path), p, exposure_ev, tone, &own) ||
             report_fail(r, "%s: %s", path, own.text);
    ok = ok && file_write(path, file.data, file.size, r);
    file_free(&file);
    return ok;
}

/* Unpremultiplies: light as if the surface filled the pixel. */
static int divide_by(image *out, const image *p, const float *alpha)
{
    const size_t pixels = (size_t)p->width * (size_t)p->height;
    *out = *p;
    out->pixels = malloc(pixels * 3 * sizeof *out->pixels);
    for (size_t i = 0; out->pixels != NULL && i < 3 * pixels; ++i) {
        out->pixels[i] = alpha[i / 3] > 0.0f ? p->pixels[i] / alpha[i / 3] : 0.0f;
    }
    return out->pixels != NULL;
}

int picture_encode_alpha(file_bytes *out, const image *p, const float *alpha, float exposure_ev, int tone, report *r)
{
    const size_t pixels = (size_t)p->width * (size_t)p->height;
    image whole;
    memset(out, 0, sizeof *out);
    uint8_t *rgb = divide_by(&whole, p, alpha) ? picture_codes(&whole, exposure_ev, tone) : NULL;
    uint8_t *rgba = malloc(4 * pixels);
    int ok = rgb != NULL && rgba != NULL;
    for (size_t i = 0; ok && i < pixels; ++i) {
        memcpy(rgba + 4 * i, rgb + 3 * i, 3);
        rgba[4 * i + 3] = (uint8_t)(alpha[i] * 255.0f + 0.5f);
    }
    ok = ok ? png_encode_alpha(out, rgba, p->width, p->height, r)
            : report_fail(r, "not enough memory for the picture; try a smaller --size");
    free(rgba);
    free(rgb);
    image_free(&whole);
    return ok;
}
