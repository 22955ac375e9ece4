/* pixel_cluster.c: the pixels of one surface in a tile -> their box and their normals' cone. Layer 6. */
#include "pixel_cluster.h"

#include "../base/vec.h"
#include "../raster/tile.h"
#include "box.h"

#if LMB_TREES

#define PLACE_NOISE 2.3841858e-7f /* 2^-22 of the largest coordinate: four times the rounding of a position */

/* Sine of an angle under 90 degrees; otherwise 1. */
static float sine_of(float cosine) { return cosine > 0.0f ? sqrtf(maxf(1.0f - cosine * cosine, 0.0f)) : 1.0f; }

/* The direction of positions along columns or rows of the tile, whichever is longer. */
static lmb_vec3 mean_normal_of(const lmb_tile *tile, uint64_t pixels)
{
    const lmb_vec3 first = tile_vec(tile->position, lowest_bit_64(pixels));
    lmb_vec3 sum = vec3(0, 0, 0), by_column = vec3(0, 0, 0), by_row = vec3(0, 0, 0);
    float column = 0.0f, row = 0.0f;
    for (uint64_t bits = pixels; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        const lmb_vec3 d = sub3(tile_vec(tile->position, k), first);
        sum = add3(sum, d);
        by_column = add3(by_column, mul3(d, (float)(k % LMB_TILE)));
        by_row = add3(by_row, mul3(d, (float)(k / LMB_TILE)));
        column += (float)(k % LMB_TILE);
        row += (float)(k / LMB_TILE);
    }
    const lmb_vec3 mean = mul3(sum, 1.0f / (float)count_bits_64(pixels));
    return longer3(sub3(by_column, mul3(mean, column)), sub3(by_row, mul3(mean, row)));
}

/* face: mean of the face normals. */
static void set_cluster_box(lmb_pixel_cluster *out, const lmb_tile *tile, uint64_t pixels, lmb_vec3 face)
{
    box_span box = box_begin(tile_vec(tile->position, lowest_bit_64(pixels)), face,
                             box_across(face, mean_normal_of(tile, pixels)));
    float largest = 0.0f;
    for (uint64_t bits = pixels; bits != 0; bits &= bits - 1) {
        const lmb_vec3 at = tile_vec(tile->position, lowest_bit_64(bits));
        box_add_point(&box, at);
        largest = maxf(largest, largest3(at));
    }
    for (int i = 0; i < 3; ++i) {
        out->axis[i] = box.axis[i];
        out->half[i] = box_half(&box, i);
    }
    out->centre = box_middle(&box);
    out->noise = PLACE_NOISE * largest;
    out->thick = 0.0f;
    for (uint64_t bits = pixels; bits != 0; bits &= bits - 1) {
        const lmb_vec3 d = sub3(tile_vec(tile->position, lowest_bit_64(bits)), out->centre);
        out->thick = maxf(out->thick, absf(dot3(out->normal, d)));
    }
}

void lmb_pixel_cluster_of(lmb_pixel_cluster *out, const lmb_tile *tile, uint64_t pixels)
{
    lmb_vec3 sum = vec3(0, 0, 0), faces = vec3(0, 0, 0);
    float cosine = 1.0f, face = 1.0f;
    for (uint64_t bits = pixels; bits != 0; bits &= bits - 1) {
        sum = add3(sum, tile_vec(tile->normal, lowest_bit_64(bits)));
        faces = add3(faces, tile_vec(tile->face, lowest_bit_64(bits)));
    }
    out->pixels = pixels;
    out->normal = normalize3(sum);
    set_cluster_box(out, tile, pixels, normalize3(faces));
    for (uint64_t bits = pixels; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        cosine = minf(cosine, dot3(out->normal, tile_vec(tile->normal, k)));
        face = minf(face, dot3(out->normal, tile_vec(tile->face, k)));
    }
    out->sine = sine_of(cosine);
    out->face_sine = sine_of(minf(face, cosine));
}

float lmb_pixel_cluster_reach(const lmb_pixel_cluster *p, lmb_vec3 along)
{
    float sum = 0.0f;
    for (int i = 0; i < 3; ++i) {
        sum += absf(dot3(p->axis[i], along)) * p->half[i];
    }
    return sum;
}

float lmb_pixel_cluster_distance2(const lmb_pixel_cluster *p, lmb_vec3 at)
{
    const lmb_vec3 to = sub3(at, p->centre);
    float sum = 0.0f;
    for (int i = 0; i < 3; ++i) {
        const float gap = maxf(absf(dot3(p->axis[i], to)) - p->half[i], 0.0f);
        sum += gap * gap;
    }
    return sum;
}

#endif
