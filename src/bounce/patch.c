/* patch.c: the pixels of one surface in a tile -> their box and their normals' cone. Floor 6. */
#include "patch.h"

#include "../base/vec.h"
#include "../raster/tile.h"

#if LMB_TREES

/* Of an angle under 90 degrees; 1 over. */
static float sine_of(float cosine) { return cosine > 0.0f ? sqrtf(maxf(1.0f - cosine * cosine, 0.0f)) : 1.0f; }

void lmb_patch_of(lmb_patch *out, const lmb_tile *tile, uint64_t pixels)
{
    lmb_vec3 sum = vec3(0, 0, 0), low, high;
    float cosine = 1.0f, face = 1.0f;
    tile_box(&low, &high, tile, pixels);
    for (uint64_t bits = pixels; bits != 0; bits &= bits - 1) {
        sum = add3(sum, tile_vec(tile->normal, lowest_bit_64(bits)));
    }
    out->pixels = pixels;
    out->centre = mul3(add3(low, high), 0.5f);
    out->half = mul3(sub3(high, low), 0.5f);
    out->normal = normalize3(sum);
    for (uint64_t bits = pixels; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        cosine = minf(cosine, dot3(out->normal, tile_vec(tile->normal, k)));
        face = minf(face, dot3(out->normal, tile_vec(tile->face, k)));
    }
    out->sine = sine_of(cosine);
    out->face_sine = sine_of(minf(face, cosine));
}

#endif
