/* io_ppm.c: RGB pictures as binary PPM (P6). */
#include "../common/io_bytes.h"
#include "image.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int ppm_encode(file_bytes *out, const uint8_t *rgb, int32_t width, int32_t height, report *r)
{
    char header[40]; /* two numbers of at most 9 digits */
    size_t n, header_bytes;

    out->data = NULL;
    out->size = 0;
    if (width < 1 || height < 1 || !picture_fits((uint64_t)width, (uint64_t)height))
        return report_fail(r, "PPM: cannot write %d x %d pixels; 1 to 2^28 fit", (int)width, (int)height);
    snprintf(header, sizeof header, "P6\n%d %d\n255\n", (int)width, (int)height);
    header_bytes = strlen(header);
    n = (size_t)width * (size_t)height * 3;
    out->data = malloc(header_bytes + n);
    if (!out->data) return report_fail(r, "PPM: out of memory for %zu bytes", header_bytes + n);
    memcpy(out->data, header, header_bytes);
    memcpy(out->data + header_bytes, rgb, n);
    out->size = header_bytes + n;
    return 1;
}
