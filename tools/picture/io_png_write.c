/* io_png_write.c: RGB and RGBA images as PNG; each row uses the filter with the smallest bytes. */
#include "image.h"
#include "io_png.h"

#include <stdlib.h>
#include <string.h>

enum { IDAT_MAX = 1 << 18 };

/* Filters one row; the sum of magnitudes measures how small the bytes are. */
static uint64_t filter_row(uint8_t *out, const uint8_t *row, const uint8_t *above, size_t n, size_t pixel, int filter)
{
    uint64_t sum = 0;
    size_t i;
    for (i = 0; i < n; ++i) {
        int left = i < pixel ? 0 : row[i - pixel], corner = i < pixel ? 0 : above[i - pixel];
        int guess = filter == PNG_SUB       ? left
                    : filter == PNG_UP      ? above[i]
                    : filter == PNG_AVERAGE ? (left + above[i]) / 2
                    : filter == PNG_PAETH   ? png_paeth(left, above[i], corner)
                                            : 0;
        out[i] = (uint8_t)(row[i] - guess);
        sum += out[i] < 128 ? out[i] : 256u - out[i];
    }
    return sum;
}

/* All rows, each after the number of a filter; the first one tried is `first`. `trial` holds one row; `zeros` is the
 * row above the first. */
static void filter_rows(uint8_t *out, const uint8_t *rgb, size_t n, size_t pixel, int32_t height, uint8_t *trial,
                        const uint8_t *zeros, int first)
{
    const uint8_t *above = zeros;
    int32_t y;
    for (y = 0; y < height; ++y, above = rgb, rgb += n, out += 1 + n) {
        uint64_t best = UINT64_MAX;
        int filter;
        for (filter = first; filter < PNG_FILTERS; ++filter) {
            uint64_t sum = filter_row(trial, rgb, above, n, pixel, filter);
            if (sum < best) {
                best = sum;
                out[0] = (uint8_t)filter;
                memcpy(out + 1, trial, n);
            }
        }
    }
}

/* Returns the byte behind the chunk. */
static uint8_t *put_chunk(uint8_t *to, const char *type, const uint8_t *body, size_t n)
{
    put_u32_be(to, (uint32_t)n);
    memcpy(to + 4, type, 4);
    if (n > 0) memcpy(to + 8, body, n);
    put_u32_be(to + 8 + n, png_crc(to + 4, 4 + n));
    return to + PNG_CHUNK_FRAME + n;
}

/* Signature, header, image data in pieces, end; NULL if memory is short. */
static uint8_t *assemble(size_t *out_size, const uint8_t *packed, size_t n, int32_t width, int32_t height, int alpha)
{
    uint8_t header[PNG_HEADER_BYTES] = {0, 0, 0, 0, 0, 0, 0, 0, 8, alpha ? 6 : 2, 0, 0, 0}; /* 8 bits, RGBA or RGB */
    size_t pieces = n / IDAT_MAX + 1, i;
    uint8_t *data = malloc(PNG_SIGNATURE_BYTES + PNG_HEADER_BYTES + n + (pieces + 2) * PNG_CHUNK_FRAME), *to = data;

    if (!data) return NULL;
    put_u32_be(header, (uint32_t)width);
    put_u32_be(header + 4, (uint32_t)height);
    memcpy(to, PNG_SIGNATURE, PNG_SIGNATURE_BYTES);
    to = put_chunk(to + PNG_SIGNATURE_BYTES, "IHDR", header, PNG_HEADER_BYTES);
    for (i = 0; i < n; i += IDAT_MAX) to = put_chunk(to, "IDAT", packed + i, n - i < IDAT_MAX ? n - i : IDAT_MAX);
    to = put_chunk(to, "IEND", NULL, 0);
    *out_size = (size_t)(to - data);
    return data;
}

static int encode(file_bytes *out, const uint8_t *pixels, int32_t width, int32_t height, int alpha, int quick,
                  report *r)
{
    const size_t pixel = alpha ? 4 : 3;
    uint8_t *rows, *packed;
    size_t n, size, packed_size;

    out->data = NULL;
    out->size = 0;
    if (width < 1 || height < 1 || !picture_fits((uint64_t)width, (uint64_t)height))
        return report_fail(r, "PNG: cannot write %d x %d pixels; 1 to 2^28 fit", (int)width, (int)height);
    n = (size_t)width * pixel;
    size = (size_t)height * (1 + n);
    rows = calloc(1, size + 2 * n); /* at the end, one row to try filters in and one of zeros */
    if (rows) filter_rows(rows, pixels, n, pixel, height, rows + size, rows + size + n,
                          quick ? PNG_PAETH : 0);
    if (rows && (quick ? deflate_zlib_quick : deflate_zlib)(&packed, &packed_size, rows, size)) {
        out->data = assemble(&out->size, packed, packed_size, width, height, alpha);
        free(packed);
    }
    free(rows);
    return out->data ? 1 : report_fail(r, "PNG: out of memory for %d x %d pixels", (int)width, (int)height);
}

int png_encode(file_bytes *out, const uint8_t *rgb, int32_t width, int32_t height, report *r)
{
    return encode(out, rgb, width, height, 0, 0, r);
}

int png_encode_quick(file_bytes *out, const uint8_t *rgb, int32_t width, int32_t height, report *r)
{
    return encode(out, rgb, width, height, 0, 1, r);
}

int png_encode_alpha(file_bytes *out, const uint8_t *rgba, int32_t width, int32_t height, report *r)
{
    return encode(out, rgba, width, height, 1, 0, r);
}
