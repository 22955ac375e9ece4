/* image.c: shared by all image code: release, and the sRGB curve. */
#include "image.h"

#include <math.h>
#include <stdlib.h>

void image_free(image *img)
{
    if (!img) return;
    free(img->pixels);
    img->pixels = NULL;
    img->width = img->height = img->channels = 0;
}

void bitmap_free(bitmap *map)
{
    if (!map) return;
    free(map->texels);
    map->texels = NULL;
    map->width = map->height = 0;
}

double srgb_curve(double code) { return code <= 0.04045 ? code / 12.92 : pow((code + 0.055) / 1.055, 2.4); }

double srgb_decode(int code) { return srgb_curve(code / 255.0); }

void srgb_table(float light_of[256])
{
    for (int code = 0; code < 256; ++code) {
        light_of[code] = (float)srgb_decode(code);
    }
}
