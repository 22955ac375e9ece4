/* test_relief.c: a sphere represented by a cube, against the real sphere. Requirements P1-P12. */
#include "../sphere_relief.h"

#include "../../src/base/codec.h"

void test_relief(void);

/* --- surface ------------------------------------------------------------------------------------------------------ */

/* m along the view's axis to the sphere at a pixel's centre; 0 if the ray misses it by `by` m. */
static float sphere_depth(float *by, lmb_vec3 *normal, const lmb_view *v, int32_t x, int32_t y)
{
    const float sx = ((float)(2 * x + 1) / (float)v->frame_width - 1.0f) * v->half_width,
                sy = (1.0f - (float)(2 * y + 1) / (float)v->frame_height) * v->half_height;
    const lmb_vec3 ray = normalize3(sub3(add3(mul3(v->right, sx), mul3(v->up, sy)), v->back));
    const float b = dot3(v->eye, ray), c = dot3(v->eye, v->eye) - b * b;
    *by = sqrtf(c) - 1.0f;
    if (c >= 1.0f) {
        return 0.0f;
    }
    *normal = add3(v->eye, mul3(ray, -b - sqrtf(1.0f - c)));
    return -dot3(v->back, sub3(*normal, v->eye));
}

typedef struct errors {
    int wrong, pixels; /* wrongly covered or uncovered, beyond `edge` */
    double depth, normal, colour; /* worst away from the edge; normal: 1 - cosine */
} errors;

static errors against_sphere(const relief_frame *f, const lmb_view *v, float edge)
{
    errors e = {0, 0, 0.0, 0.0, 0.0};
    for (int32_t i = 0; i < f->width * f->height; ++i) {
        float by;
        lmb_vec3 n = {0, 0, 0};
        const float depth = sphere_depth(&by, &n, v, i % f->width, i / f->width);
        const float *got = f->normal + 3 * i, *albedo = f->albedo + 3 * i;
        if (absf(by) < edge) {
            continue;
        }
        e.wrong += (f->depth[i] > 0.0f) != (depth > 0.0f);
        if (f->depth[i] > 0.0f && depth > 0.0f) {
            const double off[3] = {(double)(albedo[0] - 0.5f - 0.4f * n.x), (double)(albedo[1] - 0.5f - 0.4f * n.y),
                                   (double)(albedo[2] - 0.5f - 0.4f * n.z)};
            e.depth = fmax(e.depth, fabs((double)(f->depth[i] - depth)));
            e.normal = fmax(e.normal, 1.0 - (double)dot3(n, vec3(got[0], got[1], got[2])));
            e.colour = fmax(e.colour, fmax(fabs(off[0]), fmax(fabs(off[1]), fabs(off[2]))));
            ++e.pixels;
        }
    }
    return e;
}

/* P2-P6 P12: the cube's pixels show the sphere and nothing beyond the silhouette. Texels are 0.033 m wide, pixels
 * 0.026. */
static void carries_a_sphere(const stage *s, double depth, double normal, double colour)
{
    const lmb_vec3 eyes[3] = {{1.9f, 1.1f, 2.6f}, {-2.2f, 0.3f, 2.4f}, {0.4f, -3.1f, 1.1f}};
    for (int i = 0; i < 3; ++i) {
        const lmb_view v = look(eyes[i], vec3(0, 0, 0), 45.0, FRAME);
        const relief_shot shot = shot_of(s, &v);
        relief_frame f = shoot(&shot);
        const errors e = against_sphere(&f, &v, 0.02f);
        CHECK_MSG(e.pixels > 4000 && e.wrong <= 8 && e.depth < depth && e.normal < normal && e.colour < colour,
                  "%d pixels, %d wrong, depth %g, normal %g, colour %g", e.pixels, e.wrong, e.depth, e.normal,
                  e.colour);
        CHECK(f.stats.hits + f.stats.missed + f.stats.holes == f.stats.pixels && f.stats.holes < f.stats.pixels / 100);
        relief_frame_free(&f);
    }
}

/* P5: a single step from the cube is far from the sphere, so more steps are needed. */
static void once_is_worse(const stage *s)
{
    const lmb_view v = look(vec3(1.9f, 1.1f, 2.6f), vec3(0, 0, 0), 45.0, FRAME);
    relief_shot shot = shot_of(s, &v);
    shot.how.steps = 1;
    relief_frame f = shoot(&shot);
    const errors e = against_sphere(&f, &v, 0.02f);
    CHECK_MSG(e.depth > 0.05 && e.wrong > 100, "depth %g, wrong %d", e.depth, e.wrong);
    relief_frame_free(&f);
}

/* A reference view from the same position gives the stored picture. */
static void is_its_own_view(const stage *s, int32_t which)
{
    lmb_view v = s->bake.picture[which].view;
    v.eye = add3(v.eye, v.back); /* puts the whole cube in front of the eye */
    v.far_m += 2.0f;
    relief_shot shot = shot_of(s, &v), plain = shot;
    shot.how.pick = LMB_RELIEF_EYE_RAY;
    shot.how.sampling = 1;
    plain.relief = NULL;
    plain.scene = &s->complex.scene;
    relief_frame got = shoot(&shot), want = shoot(&plain);
    int covered = 0, wrong = 0;
    float depth = 0.0f;
    for (int i = 0; i < TEXELS * TEXELS; ++i) {
        const uint8_t *colour = s->bake.picture[which].texels + 4 * (TEXELS * TEXELS + i);
        wrong += (got.depth[i] > 0.0f) != (want.depth[i] > 0.0f);
        if (got.depth[i] > 0.0f && want.depth[i] > 0.0f) {
            ++covered;
            depth = maxf(depth, absf(got.depth[i] - want.depth[i]));
            for (int c = 0; c < 3; ++c) {
                wrong += got.albedo[3 * i + c] != lmb_srgb_linear[colour[c]];
            }
        }
    }
    CHECK_MSG(covered > 2000 && wrong == 0 && depth < 1e-5f, "%d covered, %d wrong, depth %g", covered, wrong,
              (double)depth);
    relief_frame_free(&got);
    relief_frame_free(&want);
}

/* --- the file ----------------------------------------------------------------------------------------------------- */

/* As written by a machine of the other byte order. */
static void turn_words(uint8_t *p, size_t count, size_t size)
{
    for (size_t i = 0; i < count; ++i) {
        for (size_t k = 0; k < size / 2; ++k) {
            const uint8_t v = p[i * size + k];
            p[i * size + k] = p[i * size + size - 1 - k];
            p[i * size + size - 1 - k] = v;
        }
    }
}

static void other_order(const stage *s)
{
    lmb_relief r;
    uint32_t *copy = malloc(s->file.size), head[LMB_RELIEF_HEADER_WORDS];
    memcpy(copy, s->file.data, s->file.size);
    memcpy(head, copy, sizeof head);
    uint8_t *p = (uint8_t *)copy;
    turn_words(p + 4, LMB_RELIEF_HEADER_WORDS - 1, 4);
    turn_words(p + head[5], (size_t)head[4] * LMB_RELIEF_VIEW_WORDS, 4);
    turn_words(p + head[8], 3 * (size_t)head[6], 4);
    turn_words(p + head[9], 2 * (size_t)head[6], 2);
    turn_words(p + head[11], 3 * (size_t)head[7], 2);
    CHECK(lmb_relief_open(&r, copy, s->file.size) == LMB_ERR_FORMAT);
    CHECK(lmb_relief_swap(copy, s->file.size) == LMB_OK);
    CHECK(memcmp(copy, s->file.data, s->file.size) == 0);
    CHECK(lmb_relief_swap(copy, s->file.size) == LMB_OK && memcmp(copy, s->file.data, s->file.size) == 0);
    free(copy);
}

/* Arrays that overlap. In a file of the other byte order, shared bytes would be swapped twice. */
static void overlaps(const stage *s)
{
    static const int offset[] = {8, 9, 10, 11, 35, 55}; /* arrays of the simple model, texels of two views */
    const lmb_relief none = s->relief;
    lmb_relief r = none;
    uint32_t *copy = malloc(s->file.size);
    memcpy(copy, s->file.data, s->file.size);
    CHECK(copy[4] > 1 && lmb_relief_open(&r, copy, s->file.size) == LMB_OK);
    const uint32_t records = copy[5];
    for (int i = 0; i < COUNT(offset); ++i) {
        const uint32_t was = copy[offset[i]];
        for (int k = 0; k < COUNT(offset); ++k) {
            copy[offset[i]] = k == i ? records : copy[offset[k]];
            CHECK_MSG(lmb_relief_open(&r, copy, s->file.size) == LMB_ERR_FORMAT, "word %d as %d", offset[i],
                      k == i ? 5 : offset[k]);
        }
        copy[offset[i]] = was;
    }
    const uint32_t size[] = {12 * copy[6], 4 * copy[6], 4 * copy[6], 6 * copy[7]};
    for (int i = 0; i < COUNT(size); ++i) { /* a word of another array */
        const uint32_t was = copy[8 + i];
        for (int k = 0; k < COUNT(size); ++k) {
            copy[8 + i] = (k == i ? records + 4 * LMB_RELIEF_VIEW_WORDS * copy[4] : copy[8 + k] + size[k]) - 4;
            CHECK_MSG(lmb_relief_open(&r, copy, s->file.size) == LMB_ERR_FORMAT, "word %d: the end of %d", 8 + i, 8 + k);
            copy[8 + i] = (k == i ? copy[35] : copy[8 + k]) + 4 - size[i];
            CHECK_MSG(lmb_relief_open(&r, copy, s->file.size) == LMB_ERR_FORMAT, "word %d: the start of %d", 8 + i, 8 + k);
        }
        copy[8 + i] = was;
    }
    copy[10] = 0; /* without colours the offset is 0 */
    CHECK(lmb_relief_open(&r, copy, s->file.size) == LMB_OK);
    copy[9] += 4 * copy[6]; /* the normals take the place of the colours, and two triangles the place before them */
    copy[7] = 2;
    copy[11] = copy[9] - 12;
    CHECK(lmb_relief_open(&r, copy, s->file.size) == LMB_OK);
    copy[11] += 4;
    CHECK(lmb_relief_open(&r, copy, s->file.size) == LMB_ERR_FORMAT);
    copy[9] = copy[8];
    turn_words((uint8_t *)copy + records, (size_t)copy[4] * LMB_RELIEF_VIEW_WORDS, 4);
    turn_words((uint8_t *)copy + 4, LMB_RELIEF_HEADER_WORDS - 1, 4);
    CHECK(lmb_relief_swap(copy, s->file.size) == LMB_ERR_FORMAT);
    free(copy);
}

/* A file cut anywhere, or with any header or view word out of range, is refused. */
static void bad_files(const stage *s)
{
    static const struct { int word; uint32_t value; } bad[] = {
        {0, 0}, {1, 5}, {2, 0xffffffffu}, {3, 2}, {4, 0}, {4, 0x10000u}, {5, 2}, {5, 0xfffffff0u}, {6, 0x0fffffffu},
        {7, 0x0fffffffu}, {8, 65}, {8, 0xfffffff0u}, {9, 0}, {10, 0xfffffff0u}, {11, 0xfffffff0u}, {12, 0}, {12, 3},
        {13, 1}, {14, 1}, {16, 0x7f800000u}, {19, 0}, {28, 0}, {29, 0xbf800000u}, {30, 0}, {31, 0x7f800000u},
        {32, 2},
        {33, 1}, {33, 0x80000000u}, {34, 5000}, {35, 0xfffffff0u}, {35, 3}};
    const lmb_relief none = s->relief;
    lmb_relief r = none;
    uint32_t *copy = malloc(s->file.size);
    for (size_t n = 0; n < s->file.size; n = 2 * n + 7) {
        CHECK(lmb_relief_open(&r, s->file.data, n) == LMB_ERR_FORMAT);
    }
    for (int i = 0; i < COUNT(bad); ++i) {
        memcpy(copy, s->file.data, s->file.size);
        copy[bad[i].word] = bad[i].value;
        CHECK_MSG(lmb_relief_open(&r, copy, s->file.size) == LMB_ERR_FORMAT, "word %d as %u", bad[i].word,
                  (unsigned)bad[i].value);
    }
    static const int offsets[] = {5, 8, 9, 10, 11, 35};
    for (int i = 0; i < COUNT(offsets); ++i) { /* begins in the file, ends beyond it */
        memcpy(copy, s->file.data, s->file.size);
        copy[offsets[i]] = (uint32_t)s->file.size - 4u;
        CHECK_MSG(lmb_relief_open(&r, copy, s->file.size) == LMB_ERR_FORMAT, "word %d", offsets[i]);
    }
    CHECK(lmb_relief_open(&r, (const uint8_t *)copy + 1, s->file.size - 1) == LMB_ERR_ALIGN);
    CHECK(lmb_relief_open(NULL, copy, s->file.size) == LMB_ERR_ARG && lmb_relief_open(&r, NULL, 4) == LMB_ERR_ARG);
    CHECK(memcmp(&r, &none, sizeof r) == 0);
    for (int word = 33; word <= 34; ++word) { /* the minimum side */
        memcpy(copy, s->file.data, s->file.size);
        copy[word] = 2;
        CHECK(lmb_relief_open(&r, copy, s->file.size) == LMB_OK);
    }
    free(copy);
}

static void bad_arguments(const stage *s)
{
    static lmb_tile tile;
    const lmb_view v = look(vec3(0, 0, 4), vec3(0, 0, 0), 40.0, FRAME);
    const lmb_relief_how bad[] = {{33, 0, 0, 0, 0}, {-1, 0, 0, 0, 0}, {0, 2, 0, 0, 0}, {0, 0, 2, 0, 0},
                                  {0, 0, 0, 9, 0}, {0, 0, 0, 0, 4}};
    for (int i = 0; i < COUNT(bad); ++i) {
        CHECK(lmb_relief_tile(&tile, picked_kernels(), &s->relief, &v, &bad[i], NULL) == LMB_ERR_ARG);
    }
    CHECK(lmb_relief_tile(NULL, picked_kernels(), &s->relief, &v, NULL, NULL) == LMB_ERR_ARG);
    CHECK(lmb_relief_tile(&tile, picked_kernels(), NULL, &v, NULL, NULL) == LMB_ERR_ARG);
}

void test_relief(void)
{
    stage *s = stage_make(LMB_RELIEF_FULL, 0);
    carries_a_sphere(s, 0.01, 0.001, 0.01);
    once_is_worse(s);
    is_its_own_view(s, 0);
    is_its_own_view(s, 9);
    is_its_own_view(s, 25);
    other_order(s);
    bad_files(s);
    overlaps(s);
    bad_arguments(s);
    stage_free(s);
    s = stage_make(LMB_RELIEF_PACKED, 0);
    carries_a_sphere(s, 0.01, 0.001, 0.045);
    other_order(s);
    stage_free(s);
}
