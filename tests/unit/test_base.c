/* test_base.c: layer 1: elementary functions, codecs, surfaces, scene checks, mips.
 *
 * Accuracy is measured against libm in double; one hash over all outputs of a fixed sweep compares machines. */
#include <math.h>
#include <string.h>

#include <lambent/scene.h>
#include <lambent/surface.h>

#include "../../src/base/codec.h"
#include "../../src/base/poly.h"
#include "../../src/base/vec.h"
#include "../../src/base/vertex.h"
#include "../../src/raster/target.h"
#include "../test.h"

void test_base(void);

/* Hash of all functions' bits over the inputs of sweep_hash; the same on every compiler, machine and byte order. */
#define SWEEP_HASH UINT64_C(0x7516e50e8a1c5dd6)

/* ---- elementary functions ---- */

/* The largest error so far and the input. */
typedef struct worst {
    double error;
    float at;
} worst;

static void note(worst *w, double error, float at)
{
    if (!(fabs(error) <= w->error)) { /* NaN counts as worst */
        w->error = fabs(error);
        w->at = at;
    }
}

static void judge(const char *name, worst w, double bound)
{
    printf("  %-22s worst error %.3g at %.9g, bound %.3g\n", name, w.error, (double)w.at, bound);
    CHECK_MSG(w.error < bound, "%s: %g at %.9g", name, w.error, (double)w.at);
}

/* Every `step`th float of lo .. hi, both positive. */
#define EACH_FLOAT(u, lo, hi, step) for (u = float_bits(lo); u <= float_bits(hi); u += (step))

static void sweep_sine(void)
{
    worst near_sin = {0, 0}, near_cos = {0, 0}, full_sin = {0, 0}, full_cos = {0, 0}, tangent = {0, 0};
    uint32_t u;
    EACH_FLOAT(u, 1e-12f, 0.785398f, 1009)
    {
        float x = bits_float(u);
        note(&near_sin, (double)lmb_sin(x) - sin((double)x), x);
        note(&near_cos, (double)lmb_cos(-x) - cos((double)x), x);
    }
    EACH_FLOAT(u, 0.5f, 64.0f, 97)
    {
        float x = bits_float(u);
        note(&full_sin, (double)lmb_sin(-x) + sin((double)x), x);
        note(&full_cos, (double)lmb_cos(x) - cos((double)x), x);
        note(&tangent, (double)lmb_tan(x) / tan((double)x) - 1.0, x);
    }
    judge("sin, |x| <= pi/4", near_sin, 6e-8);
    judge("cos, |x| <= pi/4", near_cos, 6e-8);
    judge("sin, |x| <= 64", full_sin, 8e-8);
    judge("cos, |x| <= 64", full_cos, 8e-8);
    judge("tan, relative", tangent, 2.5e-7);
}

static void sweep_arc(void)
{
    worst wa = {0, 0}, wt = {0, 0};
    test_rng rng = {7};
    uint32_t u;
    int i;
    EACH_FLOAT(u, 1e-9f, 1.0f, 331)
    {
        float x = bits_float(u);
        note(&wa, (double)lmb_acos(x) - acos((double)x), x);
        note(&wa, (double)lmb_acos(-x) - acos((double)-x), -x);
    }
    for (i = 0; i < 1000000; ++i) {
        float y = test_uniform(&rng, -1.0f, 1.0f), x = test_uniform(&rng, -1.0f, 1.0f);
        note(&wt, (double)lmb_atan2(y, x) - atan2((double)y, (double)x), y / x);
        y *= i & 1 ? 1e-6f : 1e-18f;
        note(&wt, (double)lmb_atan2(y, x) - atan2((double)y, (double)x), y / x);
        note(&wt, (double)lmb_atan2(x, y) - atan2((double)x, (double)y), x / y);
    }
    judge("acos", wa, 2.6e-7);
    judge("atan2", wt, 2e-7);
}

static void sweep_powers(void)
{
    worst wl = {0, 0}, we = {0, 0};
    uint32_t u;
    EACH_FLOAT(u, FLT_MIN, FLT_MAX, 4099)
    {
        double truth = log2((double)bits_float(u));
        note(&wl, (double)lmb_log2(bits_float(u)) - truth, 0.0f); /* absolute first: half an ulp of 128 at most */
    }
    CHECK_MSG(wl.error < 8e-6, "log2, absolute: %g", wl.error);
    wl.error = 0.0;
    EACH_FLOAT(u, 0.25f, 4.0f, 31)
    {
        double truth = log2((double)bits_float(u));
        if (truth != 0.0)
            note(&wl, (double)lmb_log2(bits_float(u)) / truth - 1.0, bits_float(u));
    }
    EACH_FLOAT(u, 1e-9f, 126.0f, 499)
    {
        float x = bits_float(u);
        note(&we, (double)lmb_exp2(x) / exp2((double)x) - 1.0, x);
        note(&we, (double)lmb_exp2(-x) / exp2((double)-x) - 1.0, -x);
    }
    judge("log2, relative", wl, 1.4e-7);
    judge("exp2, relative", we, 9.5e-8);
}

static void angles_at_their_ends(void)
{
    float half_pi = 0.5f * LMB_PI;
    CHECK(lmb_sin(0.0f) == 0.0f && lmb_cos(0.0f) == 1.0f && lmb_tan(0.0f) == 0.0f);
    CHECK(lmb_sqrt(2.0f) == 0x1.6a09e6p+0f && lmb_sqrt(0x1p-140f) == 0x1p-70f && lmb_sqrt(INFINITY) == INFINITY);
    CHECK(lmb_sqrt(-1.0f) == 0.0f && lmb_sqrt(NAN) == 0.0f && lmb_sqrt(-INFINITY) == 0.0f && float_bits(lmb_sqrt(-0.0f)) == 0);
    CHECK(lmb_sin(65.0f) == 0.0f && lmb_cos(-65.0f) == 1.0f && lmb_sin(NAN) == 0.0f && lmb_cos(INFINITY) == 1.0f);
    CHECK(lmb_acos(1.0f) == 0.0f && lmb_acos(0.0f) == half_pi && lmb_acos(-1.0f) == LMB_PI);
    CHECK(lmb_acos(2.0f) == 0.0f && lmb_acos(-2.0f) == LMB_PI && lmb_acos(NAN) == 0.0f);
    CHECK(lmb_atan2(0.0f, 1.0f) == 0.0f && lmb_atan2(1.0f, 0.0f) == half_pi && lmb_atan2(0.0f, -1.0f) == LMB_PI);
    CHECK(lmb_atan2(-1.0f, 0.0f) == -half_pi && lmb_atan2(-0.0f, -1.0f) == LMB_PI && lmb_atan2(0.0f, 0.0f) == 0.0f);
    CHECK(lmb_atan2(1.0f, 1.0f) == 0.5f * half_pi && lmb_atan2(-3.0f, 3.0f) == -0.5f * half_pi);
    CHECK(lmb_atan2(2.0f, -2.0f) == (float)(0.75 * 3.14159265358979));
    CHECK(lmb_atan2(INFINITY, INFINITY) == 0.5f * half_pi);
    CHECK(lmb_atan2(1.0f, -INFINITY) == LMB_PI && lmb_atan2(NAN, 1.0f) == 0.0f && lmb_atan2(1.0f, NAN) == 0.0f);
    CHECK(lmb_atan2(FLT_MAX, FLT_MIN) == half_pi && lmb_atan2(0x1p-149f, 0x1p-149f) == 0.5f * half_pi);
}

static void powers_at_their_ends(void)
{
    int k;
    for (k = -126; k <= 127; ++k) {
        float power = bits_float((uint32_t)(k + 127) << 23);
        CHECK(lmb_exp2((float)k) == power && lmb_log2(power) == (float)k);
    }
    CHECK(lmb_exp2(-1000.0f) == FLT_MIN && lmb_exp2(NAN) == FLT_MIN && lmb_exp2(-INFINITY) == FLT_MIN);
    CHECK(lmb_exp2(1000.0f) == lmb_exp2(127.99f) && lmb_exp2(INFINITY) <= FLT_MAX);
    CHECK(lmb_log2(0.0f) == -126.0f && lmb_log2(-1.0f) == -126.0f && lmb_log2(NAN) == -126.0f);
    CHECK(lmb_log2(0x1p-140f) == -126.0f && lmb_log2(INFINITY) == 128.0f && lmb_log2(FLT_MAX) == 128.0f);
}

/* ---- codecs ---- */

static int srgb_truth(float linear)
{
    double x = (double)linear, c = x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1.0 / 2.4) - 0.055;
    return (int)floor(255.0 * c + 0.5);
}

static void srgb_codes(void)
{
    uint32_t u;
    int c, wrong = 0;
    EACH_FLOAT(u, 1e-5f, 1.0f, 61)
        wrong += lmb_srgb_encode(bits_float(u)) != srgb_truth(bits_float(u));
    CHECK_MSG(wrong == 0, "%d floats coded otherwise than the curve rounds", wrong);
    for (c = 0; c < 256; ++c) {
        double truth = c <= 10 ? c / 255.0 / 12.92 : pow((c / 255.0 + 0.055) / 1.055, 2.4);
        CHECK_MSG(lmb_srgb_encode(lmb_srgb_decode((uint8_t)c)) == c, "code %d", c);
        CHECK_MSG(fabs((double)lmb_srgb_decode((uint8_t)c) - truth) <= truth * 6e-8, "code %d", c);
    }
    CHECK(lmb_srgb_encode(-1.0f) == 0 && lmb_srgb_encode(0.0f) == 0 && lmb_srgb_encode(NAN) == 0);
    CHECK(lmb_srgb_encode(1.0f) == 255 && lmb_srgb_encode(7.0f) == 255 && lmb_srgb_encode(INFINITY) == 255);
}

/* Tests both sides of each threshold: the rounding of the curve changes only there. */
static void srgb_thresholds(void)
{
    int c;
    for (c = 1; c < 256; ++c) {
        uint32_t lo = float_bits(lmb_srgb_decode((uint8_t)(c - 1))), hi = float_bits(lmb_srgb_decode((uint8_t)c));
        while (hi - lo > 1) {
            uint32_t mid = lo + (hi - lo) / 2;
            if (lmb_srgb_encode(bits_float(mid)) < c)
                lo = mid;
            else
                hi = mid;
        }
        CHECK_MSG(srgb_truth(bits_float(lo)) == c - 1 && srgb_truth(bits_float(hi)) == c, "threshold %d", c);
    }
}

/* A point of the cube -side .. side, one coordinate per statement: C leaves the evaluation order of arguments open. */
static lmb_vec3 random_point(test_rng *rng, float side)
{
    lmb_vec3 p;
    p.x = test_uniform(rng, -side, side);
    p.y = test_uniform(rng, -side, side);
    p.z = test_uniform(rng, -side, side);
    return p;
}

/* Angle between a and the float vector b, from the cross product in double: an arc cosine is too imprecise. */
static double angle_between(const double a[3], lmb_vec3 b)
{
    double x = a[1] * (double)b.z - a[2] * (double)b.y, y = a[2] * (double)b.x - a[0] * (double)b.z;
    double z = a[0] * (double)b.y - a[1] * (double)b.x;
    double dot = a[0] * (double)b.x + a[1] * (double)b.y + a[2] * (double)b.z;
    return atan2(sqrt(x * x + y * y + z * z), dot);
}

static void octahedral_normals(void)
{
    static const lmb_vec3 hard[] = {{0, 0, 1},   {0, 0, -1},      {1, 0, 0},       {0, -1, 0},
                                    {1, 1, 1},   {-1, 1, -1e-6f}, {1e-7f, 1, -1},  {-1, -1e-6f, -1e-6f},
                                    {1, -1, -1}, {-1, -1, -1},    {-0.0f, 0, -1},  {0.5f, -0.5f, 0}};
    static const lmb_vec3 bad[] = {{0, 0, 0}, {NAN, 0, 0}, {0, INFINITY, 0}, {1e-30f, 0, 0}};
    worst w = {0, 0};
    test_rng rng = {3};
    int16_t code[2], min[2] = {-32768, -32768};
    int i, wide = 0;
    for (i = 0; i < 1000000; ++i) {
        lmb_vec3 n = random_point(&rng, 1.0f);
        double d[3];
        if (i % 5 == 0) /* a face's centre is the worst case */
            n = vec3(n.x < 0 ? -1 : 1, n.y < 0 ? -1.001f : 1, n.z < 0 ? -0.999f : 1.002f + 0.001f * n.z);
        if (i < 12)
            n = hard[i];
        n = normalize3(n);
        if (dot3(n, n) < 0.5f)
            continue;
        d[0] = (double)n.x, d[1] = (double)n.y, d[2] = (double)n.z;
        lmb_octahedral_encode(code, n);
        wide += code[0] == -32768 || code[1] == -32768;
        note(&w, angle_between(d, lmb_octahedral_decode(code)), (float)i);
    }
    judge("octahedral, rad", w, 4.4e-5);
    CHECK(wide == 0);
    for (i = 0; i < 4; ++i) {
        lmb_octahedral_encode(code, bad[i]);
        CHECK(code[0] == 0 && code[1] == 0);
    }
    CHECK(lmb_octahedral_decode(min).z == -1.0f);
    for (i = 0; i < 1000; ++i) { /* axes: rounding must not leave the square */
        float length = test_uniform(&rng, 0.1f, 9.0f);
        lmb_octahedral_encode(code, vec3(-length, 0.0f, 0.0f));
        wide += code[0] != -32767 || code[1] != 0;
        lmb_octahedral_encode(code, vec3(0.0f, -length, 0.0f));
        wide += code[0] != 0 || code[1] != -32767;
    }
    CHECK(wide == 0);
}

/* Every code is reproduced, except on the rim of the square, where two codes share a point, and decodes to a unit
 * vector. */
static void octahedral_codes(void)
{
    int x, y, wrong = 0, lengths = 0;
    for (y = -32767; y <= 32767; y += 127) {
        for (x = -32767; x <= 32767; x += 129) {
            int16_t code[2], back[2];
            lmb_vec3 n;
            code[0] = (int16_t)x;
            code[1] = (int16_t)y;
            n = lmb_octahedral_decode(code);
            lmb_octahedral_encode(back, n);
            lengths += absf(dot3(n, n) - 1.0f) > 5e-7f;
            if (x != -32767 && x != 32767 && y != -32767 && y != 32767)
                wrong += back[0] != x || back[1] != y;
        }
    }
    CHECK_MSG(wrong == 0 && lengths == 0, "%d codes changed, %d lengths off", wrong, lengths);
}

/* ---- one hash over everything ---- */

static uint64_t hash_word(uint64_t hash, uint32_t v)
{
    int i;
    for (i = 0; i < 4; ++i)
        hash = (hash ^ ((v >> (8 * i)) & 255u)) * UINT64_C(0x100000001b3);
    return hash;
}

static uint64_t hash_float(uint64_t hash, float v) { return hash_word(hash, float_bits(v)); }

static uint64_t sweep_hash(void)
{
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    test_rng rng = {11};
    lmb_view view;
    int i;
    for (i = 0; i < 200000; ++i) {
        float any = bits_float(test_random(&rng)), angle = test_uniform(&rng, -64.0f, 64.0f);
        float x = test_uniform(&rng, -1.0f, 1.0f), y = test_uniform(&rng, -1.0f, 1.0f);
        lmb_vec3 n = vec3(x, y, test_uniform(&rng, -1.0f, 1.0f));
        int16_t code[2];
        hash = hash_float(hash_float(hash_float(hash, lmb_sin(angle)), lmb_cos(angle)), lmb_tan(angle));
        hash = hash_float(hash_float(hash_float(hash, lmb_sin(any)), lmb_acos(x)), lmb_atan2(y, x));
        hash = hash_float(hash_float(hash_float(hash, lmb_log2(any)), lmb_exp2(any)), lmb_exp2(2.0f * angle));
        hash = hash_word(hash_word(hash, lmb_srgb_encode(absf(x))), lmb_srgb_encode(any));
        lmb_octahedral_encode(code, n);
        n = lmb_octahedral_decode(code);
        hash = hash_word(hash_word(hash, (uint16_t)code[0]), (uint16_t)code[1]);
        hash = hash_float(hash_float(hash_float(hash, n.x), n.y), n.z);
        if (i % 100 == 0 &&
            lmb_view_look_at(&view, mul3(n, angle), n, vec3(y, 1.0f, x), 2.0f + y, 640, 480) == LMB_OK) {
            hash = hash_float(hash_float(hash_float(hash, view.right.x), view.up.y), view.back.z);
            hash = hash_float(hash_float(hash, view.half_width), view.half_height);
        }
    }
    for (i = 0; i < 256; ++i)
        hash = hash_float(hash, lmb_srgb_decode((uint8_t)i));
    return hash;
}

static void backends_agree(void)
{
    uint64_t hash = sweep_hash();
    CHECK_MSG(hash == SWEEP_HASH, "hash of all functions is 0x%08x%08x", (unsigned)(hash >> 32),
              (unsigned)(hash & 0xffffffffu));
}

static void names_and_build(void)
{
    CHECK(lmb_build_check() == LMB_OK);
    CHECK(strcmp(lmb_status_name(LMB_OK), "LMB_OK") == 0);
    CHECK(strcmp(lmb_status_name(LMB_MORE), "LMB_MORE") == 0);
    CHECK(strcmp(lmb_status_name(LMB_ERR_BUILD), "LMB_ERR_BUILD") == 0);
    CHECK(strcmp(lmb_status_name(LMB_ERR_ARG), "LMB_ERR_ARG") == 0);
    CHECK(strcmp(lmb_status_name(LMB_ERR_CAPACITY), "LMB_ERR_CAPACITY") == 0);
    CHECK(strcmp(lmb_status_name(LMB_ERR_ALIGN), "LMB_ERR_ALIGN") == 0);
    CHECK(strcmp(lmb_status_name(LMB_ERR_FORMAT), "LMB_ERR_FORMAT") == 0);
    CHECK(strcmp(lmb_status_name(LMB_ERR_SCENE), "LMB_ERR_SCENE") == 0);
    CHECK(strcmp(lmb_status_name((lmb_status)-7), "?") == 0);
}

/* ---- surfaces ---- */

#define ROOM_WORDS 16384
static uint32_t room_a[ROOM_WORDS], room_b[ROOM_WORDS];

static void surface_sizes(void)
{
    lmb_surface s, before;
    unsigned char *bytes = (unsigned char *)room_a;
    CHECK(lmb_pixel_bytes(LMB_RGB565) == 2 && lmb_pixel_bytes(LMB_RGB32F) == 12 && lmb_pixel_bytes(LMB_ID32) == 4 &&
          lmb_pixel_bytes(LMB_RGB565_BE) == 2);
    CHECK(lmb_pixel_bytes(LMB_FORMAT_NONE) == 0 && lmb_pixel_bytes(LMB_ID32 + 1) == 0 && lmb_pixel_bytes(-1) == 0);
    CHECK(lmb_surface_bytes(LMB_RGB565, 3, 5) == 40 && lmb_surface_bytes(LMB_RGBA8, 3, 5) == 60);
    CHECK(lmb_surface_bytes(LMB_DEPTH32F, 9, 1) == 512 && lmb_surface_bytes(LMB_DEPTH16, 8, 8) == 128);
    CHECK(lmb_depth_bytes(640, 481) == 640 * 488 * 4 && lmb_surface_bytes(LMB_RGB32F, 8192, 8192) == 805306368u);
    CHECK(lmb_surface_bytes(LMB_RGBA8, 0, 5) == 0 && lmb_surface_bytes(LMB_RGBA8, 8193, 5) == 0);
    CHECK(lmb_surface_bytes(LMB_DEPTH32F, 2147483647, 2147483647) == 0 && lmb_surface_bytes(99, 4, 4) == 0);
    memset(&s, 0x5a, sizeof s);
    before = s;
    CHECK(lmb_surface_init(&s, LMB_RGBA8, 4, 4, NULL, 64) == LMB_ERR_ARG);
    CHECK(lmb_surface_init(NULL, LMB_RGBA8, 4, 4, room_a, 64) == LMB_ERR_ARG);
    CHECK(lmb_surface_init(&s, LMB_RGBA8, -4, 4, room_a, 64) == LMB_ERR_ARG);
    CHECK(lmb_surface_init(&s, 12, 4, 4, room_a, 64) == LMB_ERR_FORMAT);
    CHECK(lmb_surface_init(&s, LMB_RGBA8, 4, 4, bytes + 2, 64) == LMB_ERR_ALIGN);
    CHECK(lmb_surface_init(&s, LMB_RGBA8, 4, 4, room_a, 63) == LMB_ERR_CAPACITY);
    CHECK(memcmp(&s, &before, sizeof s) == 0);
    CHECK(lmb_surface_init(&s, LMB_ID16, 9, 9, room_a, 512) == LMB_OK);
    CHECK(s.layout == LMB_TILED && s.stride_bytes == 256 && s.width == 9 && s.format == LMB_ID16 && s.reserved == 0);
    CHECK(lmb_surface_init(&s, LMB_RGB555, 3, 2, room_a, 16) == LMB_OK);
    CHECK(s.layout == LMB_LINEAR && s.stride_bytes == 8);
}

/* Offset of pixel (x, y) in a tiled surface of 4-byte values according to types.h. */
static size_t tiled_place(int32_t x, int32_t y, int32_t width)
{
    int32_t tiles = (width + 7) / 8;
    return (size_t)(((y / 8) * tiles + x / 8) * 64 + (y % 8) * 8 + x % 8);
}

static void depth_layouts(void)
{
    lmb_surface tiled, linear;
    static uint32_t rows[21 * 19];
    int32_t x, y, wrong = 0;
    CHECK(lmb_surface_init(&tiled, LMB_ID32, 21, 19, room_a, sizeof room_a) == LMB_OK);
    linear = tiled;
    linear.data = room_b;
    linear.layout = LMB_LINEAR;
    linear.stride_bytes = 24 * 4;
    memset(room_a, 0xee, sizeof room_a);
    memset(room_b, 0xee, sizeof room_b);
    CHECK(lmb_surface_clear(&tiled) == LMB_OK && lmb_surface_clear(&linear) == LMB_OK);
    for (x = 0; x < ROOM_WORDS; ++x)
        wrong += room_a[x] != (x < 24 * 24 ? 0u : 0xeeeeeeeeu) || room_a[x] != room_b[x];
    CHECK(wrong == 0);
    for (y = 0; y < 19; ++y)
        for (x = 0; x < 21; ++x)
            room_a[tiled_place(x, y, 21)] = room_b[y * 24 + x] = (uint32_t)(y * 1000 + x);
    CHECK(lmb_depth_linearize(rows, sizeof rows - 1, &tiled) == LMB_ERR_CAPACITY);
    CHECK(lmb_depth_linearize(NULL, sizeof rows, &tiled) == LMB_ERR_ARG);
    CHECK(lmb_depth_linearize(rows, sizeof rows, &tiled) == LMB_OK);
    for (x = 0; x < 21 * 19; ++x)
        wrong += rows[x] != (uint32_t)(x / 21 * 1000 + x % 21);
    CHECK(lmb_depth_linearize(rows, sizeof rows, &linear) == LMB_OK);
    for (x = 0; x < 21 * 19; ++x)
        wrong += rows[x] != (uint32_t)(x / 21 * 1000 + x % 21);
    CHECK(wrong == 0);
    CHECK(lmb_surface_hash(&tiled) == lmb_surface_hash(&linear) && lmb_surface_hash(&tiled) != 0);
    CHECK(lmb_surface_diff(&x, &y, &tiled, &linear) == 0);
    room_a[tiled_place(21, 3, 21)] = 5; /* padding is ignored */
    CHECK(lmb_surface_diff(&x, &y, &tiled, &linear) == 0 && lmb_surface_hash(&tiled) == lmb_surface_hash(&linear));
    room_a[tiled_place(20, 9, 21)] ^= 1;
    room_a[tiled_place(3, 10, 21)] ^= 1;
    CHECK(lmb_surface_diff(&x, &y, &tiled, &linear) == 1 && x == 20 && y == 9);
    CHECK(lmb_surface_hash(&tiled) != lmb_surface_hash(&linear));
}

/* Colour rows keep their padding, also if upside down. */
static void colour_rows(void)
{
    lmb_surface s, flipped;
    unsigned char *bytes = (unsigned char *)room_a;
    int32_t x, y, wrong = 0;
    memset(room_a, 0xee, sizeof room_a);
    CHECK(lmb_surface_init(&s, LMB_RGB565, 5, 3, room_a, sizeof room_a) == LMB_OK && s.stride_bytes == 12);
    CHECK(lmb_surface_clear(&s) == LMB_OK);
    for (y = 0; y < 4; ++y)
        for (x = 0; x < 12; ++x)
            wrong += bytes[y * 12 + x] != (y < 3 && x < 10 ? 0 : 0xee);
    CHECK(wrong == 0);
    for (y = 0; y < 3; ++y)
        for (x = 0; x < 5; ++x) {
            uint16_t v = (uint16_t)(y * 256 + x + 1), w = (uint16_t)((2 - y) * 256 + x + 1);
            memcpy(bytes + y * 12 + x * 2, &v, 2);
            memcpy((unsigned char *)room_b + y * 12 + x * 2, &w, 2);
        }
    flipped = s;
    flipped.data = (unsigned char *)room_b + 24;
    flipped.stride_bytes = -12;
    CHECK(lmb_surface_hash(&s) == lmb_surface_hash(&flipped) && lmb_surface_diff(&x, &y, &s, &flipped) == 0);
    CHECK(lmb_surface_clear(&flipped) == LMB_OK && lmb_surface_diff(&x, &y, &s, &flipped) == 1 && x == 0 && y == 0);
}

/* FNV-1a of the little-endian values 1, 0x01020304, 0, 0xffffffff, computed here from the definition; the machine's
 * byte order must not matter. */
static void hash_is_portable(void)
{
    static const unsigned char bytes[16] = {1, 0, 0, 0, 4, 3, 2, 1, 0, 0, 0, 0, 255, 255, 255, 255};
    uint64_t want = UINT64_C(0xcbf29ce484222325);
    const uint16_t letters = 0x6261; /* "ab" */
    lmb_surface s;
    int i;
    for (i = 0; i < 16; ++i)
        want = (want ^ bytes[i]) * UINT64_C(0x100000001b3);
    room_a[0] = 1, room_a[1] = 0x01020304u, room_a[2] = 0, room_a[3] = 0xffffffffu;
    CHECK(lmb_surface_init(&s, LMB_R32F, 4, 1, room_a, 16) == LMB_OK);
    CHECK(lmb_surface_hash(&s) == want && want == UINT64_C(0x59eeec518779a75c));
    memcpy(room_a, bytes, sizeof bytes);
    CHECK(lmb_surface_init(&s, LMB_RGBA8, 4, 1, room_a, 16) == LMB_OK && lmb_surface_hash(&s) == want);
    memcpy(room_b, &letters, sizeof letters);
    CHECK(lmb_surface_init(&s, LMB_RGB565, 1, 1, room_b, 4) == LMB_OK);
    CHECK(lmb_surface_hash(&s) == UINT64_C(0x089c4407b545986a)); /* FNV-1a's published value for "ab" */
    memcpy(room_b, "ab", 2);
    CHECK(lmb_surface_init(&s, LMB_RGB565_BE, 1, 1, room_b, 4) == LMB_OK);
    CHECK(lmb_surface_hash(&s) == UINT64_C(0x089c4407b545986a)); /* bytes in memory order */
}

static void surfaces_refused(void)
{
    lmb_surface s, t, bad;
    int32_t x = -1, y = -1;
    CHECK(lmb_surface_init(&s, LMB_RGBA8, 4, 4, room_a, 64) == LMB_OK);
    CHECK(lmb_surface_init(&t, LMB_BGRA8, 4, 4, room_b, 64) == LMB_OK);
    CHECK(lmb_surface_diff(&x, &y, &s, &t) == LMB_ERR_FORMAT && lmb_surface_diff(&x, &y, &s, NULL) == LMB_ERR_ARG);
    CHECK(lmb_surface_init(&t, LMB_RGBA8, 4, 3, room_b, 64) == LMB_OK);
    CHECK(lmb_surface_diff(&x, &y, &s, &t) == LMB_ERR_ARG && lmb_surface_diff(NULL, &y, &s, &s) == LMB_ERR_ARG);
    CHECK(x == -1 && y == -1);
    CHECK(lmb_depth_linearize(room_b, 64, &s) == LMB_ERR_FORMAT);
    CHECK(lmb_surface_clear(NULL) == LMB_ERR_ARG && lmb_surface_hash(NULL) == 0);
    bad = s;
    bad.layout = LMB_TILED;
    CHECK(lmb_surface_clear(&bad) == LMB_ERR_ARG);
    bad = s;
    bad.stride_bytes = 15;
    CHECK(lmb_surface_clear(&bad) == LMB_ERR_ARG && lmb_surface_hash(&bad) == 0);
    bad.stride_bytes = -15;
    CHECK(lmb_surface_clear(&bad) == LMB_ERR_ARG);
    bad = s;
    bad.data = NULL;
    CHECK(lmb_surface_clear(&bad) == LMB_ERR_ARG && lmb_surface_hash(&bad) == 0);
    CHECK(lmb_surface_init(&bad, LMB_DEPTH32F, 9, 9, room_a, 1024) == LMB_OK);
    bad.stride_bytes = 64 * 4;
    CHECK(lmb_surface_clear(&bad) == LMB_ERR_ARG);
}

/* ---- views ---- */

static void views(void)
{
    lmb_view v = {.sample_x = 0};
    lmb_vec3 eye = vec3(0, 0, 5), up = vec3(0, 1, 0), origin = vec3(0, 0, 0);
    test_rng rng = {5};
    int i, looks = 0;
    CHECK(lmb_view_look_at(&v, eye, origin, up, 0.5f * LMB_PI, 640, 480) == LMB_OK);
    CHECK(v.right.x == 1.0f && v.up.y == 1.0f && v.back.z == 1.0f && v.kind == LMB_PERSPECTIVE && v.near_m > 0.0f);
    CHECK(absf(v.half_height - 1.0f) < 3e-7f && absf(v.half_width - 4.0f / 3.0f) < 4e-7f && v.frame_width == 640);
    CHECK(absf(lmb_depth_view_z(&v, v.near_m / 8.0f) - 8.0f) < 1e-6f && lmb_depth_view_z(&v, 0.0f) == 0.0f);
    v.kind = LMB_ORTHOGRAPHIC, v.near_m = 1.0f, v.far_m = 9.0f;
    CHECK(lmb_depth_view_z(&v, 1.0f) == 1.0f && lmb_depth_view_z(&v, 0.25f) == 7.0f);
    v.frame_width = -1;
    CHECK(lmb_view_look_at(&v, eye, eye, up, 1.0f, 640, 480) == LMB_ERR_ARG);
    CHECK(lmb_view_look_at(&v, eye, origin, vec3(0, 0, -3), 1.0f, 640, 480) == LMB_ERR_ARG);
    CHECK(lmb_view_look_at(&v, eye, origin, vec3(0, 0, 0), 1.0f, 640, 480) == LMB_ERR_ARG);
    CHECK(lmb_view_look_at(&v, vec3(NAN, 0, 0), origin, up, 1.0f, 640, 480) == LMB_ERR_ARG);
    CHECK(lmb_view_look_at(&v, eye, origin, up, 0.0f, 640, 480) == LMB_ERR_ARG);
    CHECK(lmb_view_look_at(&v, eye, origin, up, LMB_PI, 640, 480) == LMB_ERR_ARG);
    CHECK(lmb_view_look_at(&v, eye, origin, up, NAN, 640, 480) == LMB_ERR_ARG);
    CHECK(lmb_view_look_at(&v, eye, origin, up, 1.0f, 0, 480) == LMB_ERR_ARG);
    CHECK(lmb_view_look_at(&v, eye, origin, up, 1.0f, 640, LMB_MAX_FRAME + 1) == LMB_ERR_ARG);
    CHECK(lmb_view_look_at(NULL, eye, origin, up, 1.0f, 640, 480) == LMB_ERR_ARG && v.frame_width == -1);
    CHECK(lmb_view_look_at(&v, eye, origin, up, 1.0f, LMB_MAX_FRAME, LMB_MAX_FRAME) == LMB_OK && lmb_view_is_valid(&v));
    for (i = 0; i < 1000; ++i) { /* orthonormal and right-handed, even with `up` almost along the view */
        lmb_vec3 to = random_point(&rng, 9.0f), tilt = random_point(&rng, 1e-3f);
        if (lmb_view_look_at(&v, eye, to, i & 1 ? up : add3(sub3(to, eye), tilt), 1.0f, 64, 64) != LMB_OK)
            continue;
        ++looks;
        CHECK(absf(dot3(v.right, v.up)) < 5e-7f && absf(dot3(v.right, v.back)) < 5e-7f &&
              absf(dot3(v.up, v.back)) < 5e-7f && length3(sub3(cross3(v.right, v.up), v.back)) < 1e-6f);
    }
    CHECK_MSG(looks > 990, "%d views", looks);
}

/* Every matrix entry has the right place and sign. */
static void points_are_transformed(void)
{
    const lmb_mat4 t = {{1, 2, 4, 0, 8, 16, 32, 0, 64, 128, 256, 0, 512, 1024, 2048, 1}};
    const lmb_vec3 p = transform_point(&t, vec3(1, 3, 5));
    CHECK(p.x == 1 + 24 + 320 + 512 && p.y == 2 + 48 + 640 + 1024 && p.z == 4 + 96 + 1280 + 2048);
}

/* ---- scenes ---- */

typedef struct small_scene {
    lmb_scene scene;
    lmb_mesh meshes[2];
    lmb_material material;
    lmb_texture texture;
    lmb_instance instances[2];
    lmb_light light;
} small_scene;

static const float corner_positions[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
static const uint32_t corner_words[3] = {0, 0, 0};
static const uint32_t corner_indices[6] = {0, 1, 2, 0, 2, 3};

static void make_scene(small_scene *s)
{
    int i;
    memset(s, 0, sizeof *s);
    for (i = 0; i < 2; ++i) {
        s->meshes[i].positions = corner_positions;
        s->meshes[i].vertex_count = 4;
        s->meshes[i].triangle_count = i ? 1 : 2;
        s->meshes[i].indices = corner_indices;
        s->meshes[i].index_format = i ? LMB_INDEX_NONE : LMB_INDEX_U32;
        s->instances[i].mesh = (uint32_t)i;
        s->instances[i].first_id = i ? 3 : 1;
        s->instances[i].to_world.m[0] = s->instances[i].to_world.m[5] = 1.0f;
        s->instances[i].to_world.m[10] = s->instances[i].to_world.m[15] = 1.0f;
    }
    s->instances[1].to_world.m[12] = -10.0f;
    s->texture.texels = (const uint8_t *)corner_words;
    s->texture.width = s->texture.height = 1;
    s->texture.levels = 1;
    s->material.texture = 0;
    s->scene.meshes = s->meshes;
    s->scene.materials = &s->material;
    s->scene.textures = &s->texture;
    s->scene.instances = s->instances;
    s->scene.lights = &s->light;
    s->scene.mesh_count = s->scene.instance_count = 2;
    s->scene.material_count = s->scene.texture_count = s->scene.light_count = 1;
}

/* A valid scene with one change is refused for the right reason. */
#define BAD(change, status) \
    do { \
        small_scene s; \
        make_scene(&s); \
        change; \
        CHECK(lmb_scene_check(&s.scene) == (status)); \
    } while (0)

static void scenes_refused(void)
{
    const unsigned char *odd = (const unsigned char *)corner_indices + 2;
    BAD((void)0, LMB_OK);
    CHECK(lmb_scene_check(NULL) == LMB_ERR_ARG);
    BAD(s.scene.meshes = NULL, LMB_ERR_ARG);
    BAD(s.scene.lights = NULL, LMB_ERR_ARG);
    BAD(s.scene.bounds_max.y = NAN, LMB_ERR_ARG);
    BAD(s.meshes[0].positions = NULL, LMB_ERR_ARG);
    BAD(s.meshes[0].indices = NULL, LMB_ERR_ARG);
    BAD(s.meshes[1].indices = NULL, LMB_OK);
    BAD(s.meshes[0].triangle_count = 0x55555556u, LMB_ERR_ARG);
    BAD((s.meshes[0].position_format = LMB_POSITION_I16, s.meshes[0].position_scale.x = INFINITY), LMB_ERR_ARG);
    BAD((s.meshes[0].uvs = corner_words, s.meshes[0].uv_format = LMB_UV_U16, s.meshes[0].uv_scale[1] = NAN),
        LMB_ERR_ARG);
    BAD(s.meshes[0].positions = odd, LMB_ERR_ALIGN);
    BAD(s.meshes[0].normals = (const int16_t *)(const void *)odd, LMB_ERR_ALIGN);
    BAD(s.meshes[0].uvs = odd, LMB_ERR_ALIGN);
    BAD(s.meshes[0].colours = odd, LMB_ERR_ALIGN);
    BAD(s.meshes[0].colour_format = LMB_COLOUR_RGBA16 + (LMB_TEXTURE_FORMATS ? 1 : 0), LMB_ERR_FORMAT);
    BAD(s.meshes[0].indices = odd, LMB_ERR_ALIGN);
    BAD(s.texture.texels = odd, LMB_ERR_ALIGN);
    BAD(s.meshes[0].position_format = 2, LMB_ERR_FORMAT);
    BAD(s.meshes[0].uv_format = 2, LMB_ERR_FORMAT);
    BAD(s.meshes[0].index_format = 3, LMB_ERR_FORMAT);
    BAD(s.texture.wrap_t = 3, LMB_ERR_FORMAT);
    BAD(s.texture.filter = 3, LMB_ERR_FORMAT);
    BAD(s.light.kind = 3, LMB_ERR_FORMAT);
    BAD(s.light.kind = -1, LMB_ERR_FORMAT);
    BAD(s.meshes[1].triangle_count = 2, LMB_ERR_SCENE);
    BAD(s.texture.texels = NULL, LMB_ERR_ARG);
    BAD(s.texture.levels = 2, LMB_ERR_ARG);
    BAD(s.texture.width = 0, LMB_ERR_ARG);
    BAD(s.material.albedo[2] = NAN, LMB_ERR_ARG);
    BAD(s.material.texture = 1, LMB_ERR_SCENE);
    BAD(s.material.texture = -2, LMB_ERR_SCENE);
    BAD(s.light.intensity[0] = INFINITY, LMB_ERR_ARG);
    BAD(s.instances[1].to_world.m[7] = NAN, LMB_ERR_ARG);
    BAD(s.instances[1].mesh = 2, LMB_ERR_SCENE);
    BAD(s.instances[1].material = 1, LMB_ERR_SCENE);
    BAD(s.instances[0].first_id = 0, LMB_ERR_SCENE);
    BAD(s.instances[1].first_id = 4, LMB_ERR_SCENE);
    BAD((s.meshes[0].triangle_count = 0x55555555u, s.instances[1].mesh = 0, s.instances[1].first_id = 0x55555556u),
        LMB_ERR_ARG);
}

static void scene_extent(void)
{
    static const float wild[5][3] = {{1, 2, 3}, {NAN, 0, 0}, {0, -1048576.0f, 0}, {0, 0, INFINITY}, {-1, 5, 2}};
    lmb_vec3 lo, hi;
    small_scene s;
    make_scene(&s);
    CHECK(lmb_scene_triangles(&s.scene) == 3 && lmb_scene_triangles(NULL) == 0);
    lmb_scene_bounds(&lo, &hi, &s.scene);
    CHECK(lo.x == -10.0f && lo.y == 0.0f && lo.z == 0.0f && hi.x == 1.0f && hi.y == 2.0f && hi.z == 3.0f);
    s.meshes[0].positions = wild;
    s.meshes[0].vertex_count = 5;
    s.scene.instance_count = 1;
    lmb_scene_bounds(&lo, &hi, &s.scene);
    CHECK(lo.x == -1.0f && lo.y == 2.0f && lo.z == 2.0f && hi.x == 1.0f && hi.y == 5.0f && hi.z == 3.0f);
    s.scene.instance_count = 0;
    lmb_scene_bounds(&lo, &hi, &s.scene);
    CHECK(lo.x == 0.0f && lo.z == 0.0f && hi.x == 0.0f && hi.y == 0.0f && lmb_scene_triangles(&s.scene) == 0);
}

static void scene_that_emits(void)
{
    small_scene s;
    make_scene(&s);
    CHECK(!lmb_scene_emits(&s.scene) && !lmb_scene_emits(NULL));
    CHECK(!lmb_scene_is_glossy(&s.scene) && !lmb_scene_is_glossy(NULL));
    s.material.emission[2] = 1e-38f;
    CHECK(lmb_scene_emits(&s.scene) && !lmb_scene_is_glossy(&s.scene));
    s.material.specular[0] = 1e-38f;
    CHECK(lmb_scene_is_glossy(&s.scene));
    s.scene.material_count = 0;
    CHECK(!lmb_scene_emits(&s.scene) && !lmb_scene_is_glossy(&s.scene));
}

/* Streams are arrays of 32-bit words for alignment; the halves are written separately. */
static void vertex_streams(void)
{
    static union {
        int16_t i[8];
        uint16_t u[8];
        uint32_t w[4];
    } positions = {{1, 2, 3, 0, -4, 32767, -32768, 0}}, uvs, indices;
    static const uint8_t colours[8] = {0, 0, 0, 0, 255, 51, 0, 102};
    lmb_mesh m;
    lmb_vec3 p;
    float uv[2], colour[4];
    memset(&m, 0, sizeof m);
    uvs.u[2] = 65535, uvs.u[3] = 13107;
    indices.u[0] = 7, indices.u[1] = 65535;
    m.positions = positions.w;
    m.position_format = LMB_POSITION_I16;
    m.position_scale = vec3(0.5f, 2.0f, 1.0f);
    m.position_offset = vec3(10.0f, 0.0f, 1.0f);
    p = mesh_position(&m, 1);
    CHECK(p.x == 8.0f && p.y == 65534.0f && p.z == -32767.0f);
    mesh_uv(&m, 1, uv);
    mesh_colour(&m, 1, colour);
    CHECK(uv[0] == 0.0f && uv[1] == 0.0f && colour[0] == 1.0f && colour[3] == 1.0f && mesh_index(&m, 9) == 9);
    CHECK(mesh_normal(&m, 1).x == 0.0f && mesh_normal(&m, 1).z == 0.0f);
    m.uvs = uvs.w;
    m.uv_format = LMB_UV_U16;
    m.uv_scale[0] = 0.3f, m.uv_scale[1] = 10.0f;
    m.colours = colours;
    m.normals = positions.i;
    m.indices = indices.w;
    m.index_format = LMB_INDEX_U16;
    mesh_uv(&m, 1, uv);
    mesh_colour(&m, 1, colour);
    CHECK(uv[0] == 0.3f && uv[1] == 2.0f && colour[0] == 1.0f && colour[1] == 0.2f && colour[3] == 0.4f);
    CHECK(mesh_index(&m, 0) == 7 && mesh_index(&m, 1) == 65535 && mesh_normal(&m, 0).z > 0.99f);
#if LMB_TEXTURE_FORMATS
    static const union {
        uint16_t code[8];
        uint32_t word[4];
    } wide = {{0, 0, 0, 0, 65535, 1142, 6554, 13107}};
    m.colours = (const uint8_t *)wide.code;
    m.colour_format = LMB_COLOUR_RGBA16;
    mesh_colour(&m, 1, colour);
    CHECK(colour[0] == 1.0f && fabsf(colour[1] - 0.00030366f) < 1e-8f && fabsf(colour[2] - 0.0100015f) < 1e-7f);
    CHECK(colour[3] == 0.2f);
#endif
    m.index_format = LMB_INDEX_U32;
    indices.w[1] = 123456789u;
    CHECK(mesh_index(&m, 1) == 123456789u);
}

/* ---- mips ---- */

static void mip_sizes(void)
{
    uint8_t texel[4] = {1, 2, 3, 4};
    CHECK(lmb_texture_level_count(1, 1) == 1 && lmb_texture_level_count(5, 3) == 3);
    CHECK(lmb_texture_level_count(8192, 1) == 14 && lmb_texture_level_count(0, 1) == 0);
    CHECK(lmb_texture_level_count(8193, 1) == 0);
    CHECK(lmb_texture_bytes(5, 3, 1) == 60 && lmb_texture_bytes(5, 3, 2) == 68 && lmb_texture_bytes(5, 3, 3) == 72);
    CHECK(lmb_texture_bytes(5, 3, 4) == 0 && lmb_texture_bytes(5, 3, 0) == 0 && lmb_texture_bytes(-5, 3, 1) == 0);
    CHECK(lmb_texture_mips(NULL, 4, 4, 2) == LMB_ERR_ARG && lmb_texture_mips(texel, 1, 1, 2) == LMB_ERR_ARG);
    CHECK(lmb_texture_mips(texel, 1, 1, 1) == LMB_OK && texel[3] == 4);
}

/* A constant image is constant on every level, for any colour and size. */
static void mips_of_constants(void)
{
    static const int32_t sizes[6][2] = {{1, 1}, {7, 1}, {1, 6}, {5, 3}, {16, 16}, {13, 11}};
    uint8_t *texels = (uint8_t *)room_a;
    int32_t i, c, levels, wrong = 0;
    size_t k, bytes;
    for (i = 0; i < 6; ++i) {
        for (c = 0; c < 256; ++c) {
            levels = lmb_texture_level_count(sizes[i][0], sizes[i][1]);
            bytes = lmb_texture_bytes(sizes[i][0], sizes[i][1], levels);
            memset(texels, 0xee, bytes + 4);
            memset(texels, c, (size_t)sizes[i][0] * (size_t)sizes[i][1] * 4);
            wrong += lmb_texture_mips(texels, sizes[i][0], sizes[i][1], levels) != LMB_OK;
            for (k = 0; k < bytes + 4; ++k)
                wrong += texels[k] != (k < bytes ? c : 0xee);
        }
    }
    CHECK_MSG(wrong == 0, "%d bytes", (int)wrong);
}

static void mips_of_checkers(void)
{
    uint8_t *t = (uint8_t *)room_a;
    int32_t i;
    for (i = 0; i < 16; ++i) { /* black and white, opaque: half the light is code 188, not 128 */
        memset(t + i * 4, (i + i / 4) % 2 ? 255 : 0, 3);
        t[i * 4 + 3] = 255;
    }
    CHECK(lmb_texture_mips(t, 4, 4, 3) == LMB_OK);
    CHECK(t[64] == 188 && t[67] == 255 && t[64 + 4 * 3] == 188 && t[64 + 16] == 188 && t[64 + 19] == 255);
    for (i = 0; i < 4; ++i) { /* invisible white next to red: the colour stays red */
        t[i * 4] = 255;
        t[i * 4 + 1] = t[i * 4 + 2] = i % 2 ? 255 : 0;
        t[i * 4 + 3] = i % 2 ? 0 : 255;
    }
    CHECK(lmb_texture_mips(t, 2, 2, 2) == LMB_OK);
    CHECK(t[16] == 255 && t[17] == 0 && t[18] == 0 && t[19] == 128);
    for (i = 0; i < 3; ++i) /* 3 x 1: each texel is a third of level 1 */
        memset(t + i * 4, i == 2 ? 0 : 255, 3), t[i * 4 + 3] = (uint8_t)(i == 2 ? 51 : 255);
    CHECK(lmb_texture_mips(t, 3, 1, 2) == LMB_OK && t[12] == lmb_srgb_encode(510.0f / 561.0f) && t[15] == 187);
    memset(t, 0, 8); /* 1 x 4: the neighbour of a row's only texel is the texel itself, not the next row's */
    memset(t + 8, 255, 8);
    CHECK(lmb_texture_mips(t, 1, 4, 2) == LMB_OK && t[16] == 0 && t[19] == 0 && t[20] == 255 && t[23] == 255);
    for (i = 0; i < 4; ++i) /* all invisible: the colour is still the mean */
        memset(t + i * 4, 200, 3), t[i * 4 + 3] = 0;
    CHECK(lmb_texture_mips(t, 2, 2, 2) == LMB_OK && t[16] == 200 && t[18] == 200 && t[19] == 0);
}

/* A lit band at the last columns or rows contributes its covered share in each mip level: no side loses its last
 * texels. */
static void mips_of_odd_sides(void)
{
    static const int32_t sizes[][2] = {{3, 3}, {7, 5}, {96, 96}, {255, 3}, {100, 75}, {1, 33}, {47, 1}, {9, 16}};
    uint8_t *t = (uint8_t *)room_a;
    for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; ++s) {
        for (int32_t turn = 0; turn < 4; ++turn) {
            const int32_t w = sizes[s][0], h = sizes[s][1], levels = lmb_texture_level_count(w, h);
            const int32_t side = turn < 2 ? w : h, band = (side + 2) / 3;
            for (int32_t i = 0; i < w * h; ++i) {
                const int32_t at = turn < 2 ? i % w : i / w, lit = turn % 2 ? at < band : at >= side - band;
                memset(t + 4 * i, lit ? 255 : 0, 3);
                t[4 * i + 3] = 255;
            }
            CHECK(lmb_texture_mips(t, w, h, levels) == LMB_OK);
            const uint8_t *last = t + lmb_texture_bytes(w, h, levels) - 4;
            const float mean = lmb_srgb_decode(last[0]), want = (float)band / (float)side;
            CHECK_MSG(mean > want - 0.02f && mean < want + 0.02f && last[3] == 255, "%dx%d, turn %d: %.3f, not %.3f",
                      (int)w, (int)h, (int)turn, (double)mean, (double)want);
        }
    }
    memset(t, 0, 16 * 9);
    for (int32_t i = 0; i < 9; ++i) /* a normal map's codes: unweighted means, here of a ramp */
        t[4 * i] = (uint8_t)(100 + 9 * (i % 3) + 3 * (i / 3)), t[4 * i + 1] = (uint8_t)(i == 8 ? 90 : 0);
    CHECK(lmb_normal_map_mips(t, 3, 3, 2) == LMB_OK && t[36] == 112 && t[37] == 10);
}

void test_base(void)
{
    names_and_build();
    points_are_transformed();
    sweep_sine();
    sweep_arc();
    sweep_powers();
    angles_at_their_ends();
    powers_at_their_ends();
    srgb_codes();
    srgb_thresholds();
    octahedral_normals();
    octahedral_codes();
    backends_agree();
    surface_sizes();
    depth_layouts();
    colour_rows();
    hash_is_portable();
    surfaces_refused();
    views();
    scenes_refused();
    scene_extent();
    scene_that_emits();
    vertex_streams();
    mip_sizes();
    mips_of_constants();
    mips_of_checkers();
    mips_of_odd_sides();
}
