/* image.c: releases pictures. */
#include "image.h"

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
