/* world.c: the world's pictures -> coded texels and mip levels, in the caller's memory. Layer 5.            [S1-S4] */
#include <string.h>

#include "../base/halve.h"
#include "../base/memory_check.h"
#include "../base/poly.h"
#include "cube.h"
#include "world.h"

/* --- sizes -------------------------------------------------------------------------------------------------------- */

static size_t world_texel_bytes(int32_t format)
{
    return format == LMB_WORLD_LOG8 ? 4 : format == LMB_WORLD_LOG16 ? 8 : 16;
}

static int are_pictures_valid(const lmb_world_pictures *p, int32_t format)
{
    return p != NULL && format >= LMB_WORLD_F32 && format <= LMB_WORLD_LOG8 && p->face_size >= 1 &&
           p->face_size <= 4096 &&
           (p->ground == NULL || (p->ground_width >= 1 && p->ground_width <= 8192 && p->ground_height >= 1 &&
                                  p->ground_height <= 8192));
}

/* Sets the levels of the faces from texel *end on and advances *end; returns their number. */
static int32_t lay_out_cube(lmb_world_level out[LMB_WORLD_LEVELS], size_t *end, const lmb_world_pictures *p)
{
    int32_t count = 0;
    for (int32_t n = p->face_size; n >= 1 && count < LMB_WORLD_LEVELS; n /= 2) {
        const lmb_world_level level = {(uint32_t)*end, n, n};
        out[count++] = level;
        *end += 6 * (size_t)(n + 2) * (size_t)(n + 2);
    }
    return count;
}

/* The same for the ground; 0 without a ground. */
static int32_t lay_out_ground(lmb_world_level out[LMB_WORLD_LEVELS], size_t *end, const lmb_world_pictures *p)
{
    int32_t count = 0;
    for (int32_t x = p->ground_width, y = p->ground_height; p->ground != NULL && count < LMB_WORLD_LEVELS;) {
        const lmb_world_level level = {(uint32_t)*end, x, y};
        out[count++] = level;
        *end += (size_t)x * (size_t)y;
        if (x == 1 && y == 1) {
            break;
        }
        x = maxi(x / 2, 1);
        y = maxi(y / 2, 1);
    }
    return count;
}

/* Sets the calm levels; the first is shared with the cube. */
static void set_calm(lmb_world_level out[LMB_WORLD_LEVELS], size_t *end, const lmb_world_pictures *p)
{
    const size_t whole = 6 * (size_t)(p->face_size + 2) * (size_t)(p->face_size + 2);
    size_t next = *end;
    const int32_t count = lay_out_cube(out, &next, p);
    for (int32_t i = 1; i < count; ++i) {
        out[i].at -= (uint32_t)whole;
    }
    out[0].at = 0;
    *end = p->face_size < LMB_WORLD_NARROW ? *end : next - whole;
}

size_t lmb_world_bytes(const lmb_world_pictures *pictures, int32_t format)
{
    lmb_world_level level[LMB_WORLD_LEVELS];
    size_t texels = 0;
    if (!are_pictures_valid(pictures, format)) {
        return 0;
    }
    lay_out_cube(level, &texels, pictures);
    lay_out_ground(level, &texels, pictures);
    set_calm(level, &texels, pictures);
    return texels * world_texel_bytes(format);
}

/* --- texels ------------------------------------------------------------------------------------------------------- */

/* Rounds radiance too dark for any reflection to 0, so products stay far from denormals. */
static float sane_radiance(float c) { return c > 1e-12f && c < 1e30f ? c : 0.0f; }

static float sane_alpha(float a) { return a > 1e-5f ? minf(a, 1.0f) : 0.0f; }

/* The texels of a level that one texel of the next level covers, in a cube face or in the ground. */
typedef struct {
    halve_taps x, y;
} texel_box;

static texel_box box_of_texel(const lmb_world_level *from, int32_t x, int32_t y)
{
    const texel_box b = {halve_axis(from->width, x), halve_axis(from->height, y)};
    return b;
}

/* Reads texel x y of a level; face: of a cube. */
typedef void (*read_texel)(float rgba[4], const lmb_world *w, const lmb_world_level *from, int32_t face, int32_t x,
                           int32_t y);

/* Mean of the texels of a box, weighted by alpha. */
static void mean_of_box(float out[4], const lmb_world *w, const lmb_world_level *from, int32_t face, texel_box b,
                        read_texel read)
{
    const float whole = (float)b.x.whole * (float)b.y.whole;
    float sum[4] = {0};
    for (int32_t j = 0; j < b.y.count; ++j) {
        for (int32_t i = 0; i < b.x.count; ++i) {
            float rgba[4];
            read(rgba, w, from, face, b.x.first + i, b.y.first + j);
            const float weight = (float)b.x.part[i] * (float)b.y.part[j] * rgba[3];
            for (int c = 0; c < 3; ++c) {
                sum[c] += rgba[c] * weight;
            }
            sum[3] += weight;
        }
    }
    for (int c = 0; c < 3; ++c) {
        out[c] = sum[3] > 0.0f ? sum[c] / sum[3] : 0.0f;
    }
    out[3] = sum[3] / whole;
}

/* --- faces -------------------------------------------------------------------------------------------------------- */

static void take_faces(lmb_world *w, const lmb_world_pictures *p)
{
    const int32_t n = p->face_size;
    for (int32_t i = 0; i < 6 * n * n; ++i) {
        const int32_t face = i / (n * n), x = i % n, y = i / n % n;
        float rgba[4] = {0};
        for (int c = 0; c < 3 && p->face[face] != NULL; ++c) {
            rgba[c] = sane_radiance(p->face[face][3 * (size_t)(y * n + x) + (size_t)c]);
            rgba[3] = p->alpha[face] != NULL ? sane_alpha(p->alpha[face][y * n + x]) : 1.0f;
        }
        lmb_world_put(w, lmb_world_face_texel(&w->cube[0], face, x, y), rgba);
    }
}

static void read_face(float rgba[4], const lmb_world *w, const lmb_world_level *from, int32_t face, int32_t x,
                      int32_t y)
{
    lmb_world_texel(rgba, w, lmb_world_face_texel(from, face, x, y));
}

static void halve_faces(lmb_world *w, const lmb_world_level *to, const lmb_world_level *from)
{
    const int32_t n = to->width;
    for (int32_t i = 0; i < 6 * n * n; ++i) {
        const int32_t face = i / (n * n), x = i % n, y = i / n % n;
        float rgba[4];
        mean_of_box(rgba, w, from, face, box_of_texel(from, x, y), read_face);
        lmb_world_put(w, lmb_world_face_texel(to, face, x, y), rgba);
    }
}

/* Copies each border texel from the interior texel in the same direction. */
static void set_level_border(lmb_world *w, const lmb_world_level *l)
{
    const int32_t n = l->width;
    for (int32_t i = 0; i < 6 * (n + 2) * (n + 2); ++i) {
        const int32_t face = i / ((n + 2) * (n + 2)), x = i % (n + 2) - 1, y = i / (n + 2) % (n + 2) - 1;
        if (x < 0 || y < 0 || x >= n || y >= n) {
            const cube_place p = cube_border(face, x, y, n);
            float rgba[4];
            lmb_world_texel(rgba, w, lmb_world_face_texel(l, p.face, p.x, p.y));
            lmb_world_put(w, lmb_world_face_texel(l, face, x, y), rgba);
        }
    }
}

static void read_calm(float rgba[4], const lmb_world *w, const lmb_world_level *from, int32_t face, int32_t x,
                      int32_t y)
{
    (void)from;
    lmb_world_calm_texel(rgba, w, face, x, y);
}

/* Updates each texel of the first calm level that covers part of a peak: sets it to the mean without the peak's light.
 * If the side is odd, texel i ends inside texel 2 i + 2. */
static void calm_part(lmb_world *w, const lmb_world_peak *peak)
{
    const int32_t last = w->calm[1].width - 1, odd = w->calm[0].width % 2;
    int32_t from[2], to[2];
    lmb_world_peak_texels(from, to, w, peak);
    for (int32_t y = (from[1] - odd) / 2; y <= mini((to[1] - 1) / 2, last); ++y) {
        for (int32_t x = (from[0] - odd) / 2; x <= mini((to[0] - 1) / 2, last); ++x) {
            float rgba[4];
            mean_of_box(rgba, w, &w->calm[0], peak->face, box_of_texel(&w->calm[0], x, y), read_calm);
            lmb_world_put(w, lmb_world_face_texel(&w->calm[1], peak->face, x, y), rgba);
        }
    }
}

static void make_calm(lmb_world *w)
{
    for (int32_t i = 1; i < w->cube_levels; ++i) {
        halve_faces(w, &w->calm[i], &w->calm[i - 1]);
        for (int32_t k = 0; k < w->peaks && i == 1; ++k) {
            calm_part(w, &w->peak[k]);
        }
        set_level_border(w, &w->calm[i]);
    }
}

/* --- ground ------------------------------------------------------------------------------------------------------- */

static void take_ground(lmb_world *w, const lmb_world_pictures *p)
{
    const size_t texels = (size_t)p->ground_width * (size_t)p->ground_height;
    for (size_t i = 0; i < texels; ++i) {
        const float *from = p->ground + 4 * i;
        const float rgba[4] = {sane_radiance(from[0]), sane_radiance(from[1]), sane_radiance(from[2]),
                               sane_alpha(from[3])};
        lmb_world_put(w, w->ground[0].at + i, rgba);
    }
}

static void read_ground(float rgba[4], const lmb_world *w, const lmb_world_level *from, int32_t face, int32_t x,
                        int32_t y)
{
    (void)face;
    lmb_world_texel(rgba, w, from->at + (size_t)y * (size_t)from->width + (size_t)x);
}

static void halve_ground(lmb_world *w, const lmb_world_level *to, const lmb_world_level *from)
{
    for (int32_t y = 0; y < to->height; ++y) {
        for (int32_t x = 0; x < to->width; ++x) {
            float rgba[4];
            mean_of_box(rgba, w, from, 0, box_of_texel(from, x, y), read_ground);
            lmb_world_put(w, to->at + (size_t)y * (size_t)to->width + (size_t)x, rgba);
        }
    }
}

/* --- all ---------------------------------------------------------------------------------------------------------- */

static int is_camera_inside(const lmb_world_pictures *p)
{
    const lmb_vec3 c = p->centre;
    if (!is_place(c) || !is_place(p->middle) || !is_place(p->low) || !is_place(p->high) ||
        (p->has_floor && !(is_sane(p->ground_y) && c.y > p->ground_y))) {
        return 0;
    }
    if (p->shape == LMB_WORLD_SPHERE) {
        return is_sane(p->radius) && p->radius > 0.0f && length3(sub3(c, p->middle)) < p->radius;
    }
    return p->shape == LMB_WORLD_BOX && c.x > p->low.x && c.y > p->low.y && c.z > p->low.z && c.x < p->high.x &&
           c.y < p->high.y && c.z < p->high.z;
}

static int ground_is_valid(const lmb_world_pictures *p)
{
    return p->ground == NULL || (is_sane(p->ground_x) && is_sane(p->ground_z) && is_sane(p->ground_y) &&
                                 is_sane(p->ground_width_m) && is_sane(p->ground_depth_m) &&
                                 p->ground_width_m > 0.0f && p->ground_depth_m > 0.0f);
}

static void set_codes(lmb_world *w)
{
    for (int i = 0; i < 256; ++i) {
        w->log8[i] = lmb_world_decode((float)i * (1.0f / 255.0f));
        w->log16[0][i] = lmb_exp2((3.0f * ((float)(256 * i) * (1.0f / 65535.0f)) - 1.0f) * LMB_WORLD_LOG2_10);
        w->log16[1][i] = lmb_exp2(3.0f * ((float)i * (1.0f / 65535.0f)) * LMB_WORLD_LOG2_10);
    }
}

lmb_status lmb_world_init(lmb_world *out, const lmb_world_pictures *pictures, int32_t format, void *memory,
                          size_t bytes)
{
    size_t end = 0;
    if (out == NULL || pictures == NULL) {
        return LMB_ERR_ARG;
    }
    if (format < LMB_WORLD_F32 || format > LMB_WORLD_LOG8) {
        return LMB_ERR_FORMAT;
    }
    if (!are_pictures_valid(pictures, format) || !is_camera_inside(pictures) || !ground_is_valid(pictures)) {
        return LMB_ERR_ARG;
    }
    const lmb_status status = check_memory(memory, bytes, lmb_world_bytes(pictures, format));
    if (status != LMB_OK) {
        return status;
    }
    out->texels = memory;
    out->format = format;
    out->pictures = *pictures;
    set_codes(out);
    out->cube_levels = lay_out_cube(out->cube, &end, pictures);
    out->ground_levels = lay_out_ground(out->ground, &end, pictures);
    set_calm(out->calm, &end, pictures);
    take_faces(out, pictures);
    set_level_border(out, &out->cube[0]);
    for (int32_t i = 1; i < out->cube_levels; ++i) {
        halve_faces(out, &out->cube[i], &out->cube[i - 1]);
        set_level_border(out, &out->cube[i]);
    }
    if (lmb_world_find_peaks(out) > 0) {
        make_calm(out);
    }
    for (int32_t i = 0; i < out->ground_levels; ++i) {
        if (i == 0) {
            take_ground(out, pictures);
        } else {
            halve_ground(out, &out->ground[i], &out->ground[i - 1]);
        }
    }
    return LMB_OK;
}
