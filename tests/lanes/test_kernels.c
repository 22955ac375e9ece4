/* test_kernels.c: every kernel on every available backend against scalar's, on random and hard inputs.
 *
 * Surfaces end at the end of their memory, so that a sanitizer finds reads past them; bytes around
 * outputs must stay unchanged. */
#include <lambent/lambent.h>

#include <string.h>

#include "../../src/base/codec.h"
#include "../../src/base/vec.h"
#include "../../src/lane/kernels.h"
#include "../../src/occlusion/occlude.h"
#include "../../src/probe/world.h"
#include "../../src/raster/texture.h"
#include "../small_relief.h"
#include "seed.h"

void test_kernels(void);

enum { CANARY = 0x5a };
#define ROUNDS tries(400, 1500)

/* --- comparing ---------------------------------------------------------------------------------------------------- */

static uint32_t bits_of(float v)
{
    uint32_t bits;
    memcpy(&bits, &v, sizeof bits);
    return bits;
}

static int is_nan(uint32_t bits) { return (bits & 0x7fffffffu) > 0x7f800000u; }

/* Index of the first of n floats with different bits, or -1; all NaNs are equal. */
static int differ(const float *want, const float *got, int n)
{
    for (int i = 0; i < n; ++i) {
        const uint32_t a = bits_of(want[i]), b = bits_of(got[i]);
        if (a != b && !(is_nan(a) && is_nan(b))) {
            return i;
        }
    }
    return -1;
}

/* The current backend, kernel and seed. */
typedef struct trial {
    const lmb_kernels *kernels;
    const char *kernel;
    uint32_t seed;
} trial;

/* Returns 1, or 0 after printing the difference and the command that repeats the case. */
static int same_floats(const trial *t, const char *what, const float *want, const float *got, int n)
{
    int i = differ(want, got, n);
    if (i >= 0) {
        printf("%s %s: %s[%d]: want %08x %g, got %08x %g; repeat: LANES_SEED=%u tests lanes\n", t->kernels->name,
               t->kernel, what, i, (unsigned)bits_of(want[i]), (double)want[i], (unsigned)bits_of(got[i]),
               (double)got[i], (unsigned)t->seed);
    }
    return i < 0;
}

static int same_bytes(const trial *t, const char *what, const void *want, const void *got, size_t n)
{
    for (size_t i = 0; i < n; ++i) {
        if (((const uint8_t *)want)[i] != ((const uint8_t *)got)[i]) {
            printf("%s %s: %s, byte %u: want %02x, got %02x; repeat: LANES_SEED=%u tests lanes\n", t->kernels->name,
                   t->kernel, what, (unsigned)i, ((const uint8_t *)want)[i], ((const uint8_t *)got)[i],
                   (unsigned)t->seed);
            return 0;
        }
    }
    return 1;
}

/* --- random inputs ------------------------------------------------------------------------------------------------ */

static float hard_float(test_rng *r)
{
    uint32_t bits = hard_bits[test_random(r) % HARD_COUNT];
    float v;
    memcpy(&v, &bits, sizeof v);
    return v;
}

/* One number in `rare` is hard; 0: none. */
static float number(test_rng *r, float lo, float hi, uint32_t rare)
{
    return rare && test_random(r) % rare == 0 ? hard_float(r) : test_uniform(r, lo, hi);
}

static lmb_vec3 place(test_rng *r, float reach, uint32_t rare)
{
    return vec3(number(r, -reach, reach, rare), number(r, -reach, reach, rare), number(r, -reach, reach, rare));
}

static lmb_vec3 direction(test_rng *r) { return normalize3(place(r, 1.0f, 0)); }

/* Any direction, or one along an axis. */
static lmb_vec3 direction_of_axis(test_rng *r)
{
    const lmb_vec3 axis[3] = {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}};
    return test_random(r) % 4u ? direction(r) : axis[test_random(r) % 3u];
}

static void numbers(float *out, int n, test_rng *r, float lo, float hi, uint32_t rare)
{
    for (int i = 0; i < n; ++i) {
        out[i] = number(r, lo, hi, rare);
    }
}

static void set_pixel(float planes[3][LMB_TILE_PIXELS], int k, lmb_vec3 v)
{
    planes[0][k] = v.x;
    planes[1][k] = v.y;
    planes[2][k] = v.z;
}

/* Pixels anywhere, some without a surface. */
static void make_tile(lmb_tile *t, test_rng *r, uint32_t rare)
{
    memset(t, 0, sizeof *t);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        set_pixel(t->position, k, place(r, 3.0f, rare));
        set_pixel(t->face, k, direction(r));
        set_pixel(t->normal, k, rare && test_random(r) % 9u == 0 ? place(r, 1.0f, 2) : direction(r));
        t->id[k] = test_random(r) % 4u ? 1u + test_random(r) % 3u : test_random(r) % 2u ? 0u : 0x7fffffffu;
        t->hits += t->id[k] != 0;
    }
    numbers(t->albedo[0], 3 * LMB_TILE_PIXELS, r, 0.0f, 1.0f, rare);
    numbers(t->depth, LMB_TILE_PIXELS, r, 0.1f, 9.0f, rare);
    numbers(t->uv[0], 2 * LMB_TILE_PIXELS, r, -2.0f, 2.0f, rare);
}

/* One whole flat surface, as needed for the gather's shared visibility. */
static void make_flat_tile(lmb_tile *t, test_rng *r)
{
    const lmb_vec3 at = place(r, 2.0f, 0), n = direction(r);
    const lmb_vec3 u = normalize3(cross3(n, direction(r))), v = cross3(n, u);
    const float pixel = test_uniform(r, 0.01f, 0.1f);
    make_tile(t, r, 0);
    t->hits = LMB_TILE_PIXELS;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        set_pixel(t->position, k, add3(at, add3(mul3(u, pixel * (float)(k % 8)), mul3(v, pixel * (float)(k / 8)))));
        set_pixel(t->face, k, n);
        set_pixel(t->normal, k, n);
        t->id[k] = 1;
    }
}

/* A mask of all of a tile's pixels, a few, or none. */
static uint64_t random_pixels(const trial *t, test_rng *r)
{
    const uint64_t all = (uint64_t)test_random(r) << 32 | test_random(r);
    return t->seed % 5u == 0 ? UINT64_MAX : all & all >> (t->seed % 40u);
}

/* --- resolve, direct, blend --------------------------------------------------------------------------------------- */

/* An output with guard bytes around it. */
#define GUARDED(type) \
    struct { \
        uint8_t before[64]; \
        type it; \
        uint8_t after[64]; \
    }

typedef struct float_pair {
    float a[16], b[16];
} float_pair;

#define GUARD(pair) memset(&(pair), CANARY, sizeof(pair))

static int canaries_stay(const uint8_t before[64], const uint8_t after[64])
{
    for (int i = 0; i < 64; ++i) {
        if (before[i] != CANARY || after[i] != CANARY) {
            return 0;
        }
    }
    return 1;
}

/* The data of a batch, with streams that kernels never read. */
typedef struct batch_world {
    lmb_instance instance;
    lmb_mesh mesh;
    lmb_material material;
} batch_world;

static void make_world(batch_world *w, test_rng *r, uint32_t rare)
{
    static const int16_t normals[2] = {0, 0};
    static const uint8_t colours[4] = {0, 0, 0, 0};
    static const float uvs[2] = {0.0f, 0.0f};
    memset(w, 0, sizeof *w);
    numbers(w->instance.to_world.m, 16, r, -2.0f, 2.0f, rare);
    w->instance.first_id = 1u + test_random(r) % 3u;
    w->mesh.triangle_count = 1u + test_random(r) % 40u;
    w->mesh.normals = test_random(r) % 2u ? normals : NULL;
    w->mesh.colours = test_random(r) % 2u ? colours : NULL;
    w->mesh.uvs = test_random(r) % 2u ? uvs : NULL;
    numbers(w->material.albedo, 3, r, 0.0f, 1.0f, rare);
}

/* Fills the batch with random numbers: those of the mesh for resolve_setup, of set-up triangles for resolve. */
static void make_batch(lmb_resolve_batch *b, const batch_world *w, test_rng *r, uint32_t rare)
{
    lmb_vec3 *vectors[] = {&b->rays.origin, &b->rays.ox, &b->rays.oy, &b->rays.direction,
                           &b->rays.rx,     &b->rays.ry, &b->rays.eye};
    memset(b, 0, sizeof *b);
    b->instance = &w->instance;
    b->mesh = &w->mesh;
    b->material = &w->material;
    for (size_t i = 0; i < sizeof vectors / sizeof *vectors; ++i) {
        *vectors[i] = place(r, 2.0f, rare);
    }
    b->rays.back = direction(r);
    b->rays.near_m = 0.1f;
    b->rays.perspective = test_random(r) % 4u != 0;
    b->count = 1 + (int32_t)(test_random(r) % LMB_SLOTS);
    numbers(b->corner[0][0], 9 * LMB_SLOTS, r, -2.0f, 2.0f, rare);
    numbers(b->uv[0][0], 6 * LMB_SLOTS, r, -4.0f, 4.0f, rare);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        b->slot[k] = (int32_t)(test_random(r) % ((uint32_t)b->count + 1)) - 1;
    }
}

/* Compares only the used slots of a batch's array of rows. */
static int same_slots(const trial *t, const char *what, const float *want, const float *got, int rows, int32_t count)
{
    int equal = 1;
    for (int i = 0; i < rows && equal; ++i) {
        equal = same_floats(t, what, want + i * LMB_SLOTS, got + i * LMB_SLOTS, count);
    }
    return equal;
}

static int trial_resolve_shown(const trial *t, test_rng r)
{
    uint32_t id[LMB_TILE_PIXELS];
    uint64_t want = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        id[k] = test_random(&r) % 2u ? 0u : test_random(&r) % 2u ? 0x80000000u : 1u + test_random(&r) % 9u;
        want |= (uint64_t)(id[k] != 0) << k;
    }
    const uint64_t a = lmb_kernels_scalar.resolve_shown(id), b = t->kernels->resolve_shown(id);
    return same_bytes(t, "scalar's", &want, &a, sizeof a) && same_bytes(t, "shown", &want, &b, sizeof b);
}

static int trial_resolve_slots(const trial *t, test_rng r)
{
    static lmb_resolve_batch want, got;
    batch_world w;
    uint32_t id[LMB_TILE_PIXELS];
    uint64_t left = 0;
    const uint32_t kinds = 1u + test_random(&r) % 50u, done = test_random(&r) % kinds;
    make_world(&w, &r, 0);
    make_batch(&want, &w, &r, 0);
    got = want;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        id[k] = test_random(&r) % 16u ? test_random(&r) % kinds : 0xffffffffu - test_random(&r) % 2u;
        left |= (uint64_t)(id[k] > done) << k;
    }
    const uint64_t a = lmb_kernels_scalar.resolve_slots(&want, id, left), b = t->kernels->resolve_slots(&got, id, left);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int taken = (int)(a >> k & 1u), own = id[k] - w.instance.first_id < w.mesh.triangle_count;
        CHECK(taken == (want.slot[k] >= 0) && (!taken || (own && want.id[want.slot[k]] == id[k])));
        CHECK(taken || !own || (left >> k & 1u) == 0 || want.count == LMB_SLOTS);
    }
    return same_bytes(t, "taken", &a, &b, sizeof a) &&
           same_bytes(t, "count", &want.count, &got.count, sizeof want.count) &&
           same_bytes(t, "slot", want.slot, got.slot, sizeof want.slot) &&
           same_bytes(t, "id", want.id, got.id, sizeof *want.id * (size_t)want.count);
}

static int trial_resolve_setup(const trial *t, test_rng r)
{
    static lmb_resolve_batch want, got;
    const uint32_t rare = t->seed % 2u ? 12u : 0;
    batch_world w;
    make_world(&w, &r, rare);
    make_batch(&want, &w, &r, rare);
    for (int k = 0; k < LMB_SLOTS; ++k) {
        for (int i = 0; i < 9; ++i) {
            want.normal[i / 3][i % 3][k] = (float)((int32_t)(test_random(&r) % 65536u) - 32768);
        }
        for (int i = 0; i < 3; ++i) {
            want.colour[i][k] = test_random(&r);
        }
        for (int i = 0; i < 3 && test_random(&r) % 8u == 0; ++i) { /* a triangle without area */
            want.corner[2][i][k] = want.corner[1][i][k];
        }
    }
    got = want;
    lmb_kernels_scalar.resolve_setup(&want);
    t->kernels->resolve_setup(&got);
    return same_slots(t, "corner", want.corner[0][0], got.corner[0][0], 9, want.count) &&
           same_slots(t, "plane", want.plane[0], got.plane[0], 3, want.count) &&
           same_slots(t, "face", want.face[0], got.face[0], 3, want.count) &&
           same_slots(t, "w_min", want.w_min, got.w_min, 1, want.count) &&
           same_slots(t, "w_max", want.w_max, got.w_max, 1, want.count) &&
           same_slots(t, "normal", want.normal[0][0], got.normal[0][0], 9, want.count) &&
           same_slots(t, "albedo", want.albedo[0][0], got.albedo[0][0], 9, want.count) &&
           same_slots(t, "uv", want.uv[0][0], got.uv[0][0], 6, want.count);
}

static int trial_resolve(const trial *t, test_rng r)
{
    static GUARDED(lmb_tile) want, got;
    static lmb_resolve_batch batch;
    const uint32_t rare = t->seed % 2u ? 12u : 0;
    batch_world w;
    GUARD(want);
    GUARD(got);
    make_tile(&want.it, &r, rare);
    got.it = want.it;
    make_world(&w, &r, rare);
    make_batch(&batch, &w, &r, rare);
    numbers(batch.normal[0][0], 9 * LMB_SLOTS, &r, -1.0f, 1.0f, rare);
    numbers(batch.albedo[0][0], 9 * LMB_SLOTS, &r, 0.0f, 1.0f, rare);
    numbers(batch.w_min, LMB_SLOTS, &r, 0.1f, 2.0f, rare);
    numbers(batch.w_max, LMB_SLOTS, &r, 2.0f, 9.0f, rare);
    for (int k = 0; k < LMB_SLOTS; ++k) {
        const lmb_vec3 plane = direction(&r), face = direction(&r);
        const int edge_on = test_random(&r) % 8u == 0; /* from some column on, or everywhere */
        batch.plane[0][k] = edge_on ? 0.0f : plane.x;
        batch.plane[1][k] = edge_on ? 0.0f : plane.y;
        batch.plane[2][k] = edge_on ? 1.0f : plane.z;
        batch.face[0][k] = face.x;
        batch.face[1][k] = face.y;
        batch.face[2][k] = face.z;
    }
    if (test_random(&r) % 4u == 0) {
        batch.rays.direction.z =
            -(float)(test_random(&r) % 8u) * (batch.rays.rx.z = (float)(test_random(&r) % 2u) * 0.125f);
        batch.rays.ry.z = 0.0f;
    }
    /* A tile's first batch behaves as if the tile had been cleared. */
    batch.is_first = (int16_t)(t->kernels->lanes >= LMB_TILE && test_random(&r) % 2u);
    if (batch.is_first) {
        memset(&want.it, 0, offsetof(lmb_tile, id));
    }
    lmb_kernels_scalar.resolve(&want.it, &batch);
    t->kernels->resolve(&got.it, &batch);
    CHECK(canaries_stay(got.before, got.after));
    return same_floats(t, "position", want.it.position[0], got.it.position[0], 3 * LMB_TILE_PIXELS) &&
           same_floats(t, "face", want.it.face[0], got.it.face[0], 3 * LMB_TILE_PIXELS) &&
           same_floats(t, "normal", want.it.normal[0], got.it.normal[0], 3 * LMB_TILE_PIXELS) &&
           same_floats(t, "albedo", want.it.albedo[0], got.it.albedo[0], 3 * LMB_TILE_PIXELS) &&
           same_floats(t, "depth", want.it.depth, got.it.depth, LMB_TILE_PIXELS) &&
           same_floats(t, "uv", want.it.uv[0], got.it.uv[0], 2 * LMB_TILE_PIXELS) &&
           same_bytes(t, "id and the rest", want.it.id, got.it.id, sizeof want.it - offsetof(lmb_tile, id));
}

/* Compares with the sampler for single pixels. The image ends at the end of its memory. */
static int trial_texture(const trial *t, test_rng r)
{
    static lmb_tile want, got;
    static lmb_resolve_batch batch;
    const uint32_t rare = t->seed % 2u ? 12u : 0;
    batch_world w;
    lmb_texture texture;
    memset(&texture, 0, sizeof texture);
    make_tile(&want, &r, 0);
    numbers(want.uv[0], 2 * LMB_TILE_PIXELS, &r, -3.0f, 3.0f, rare);
    make_world(&w, &r, 0);
    make_batch(&batch, &w, &r, 0);
    got = want;
    texture.width = (uint16_t)(1u + test_random(&r) % 9u);
    texture.height = (uint16_t)(1u + test_random(&r) % 9u);
    texture.levels = 1;
    texture.wrap_s = (uint8_t)(test_random(&r) % 3u);
    texture.wrap_t = (uint8_t)(test_random(&r) % 3u);
    texture.filter = test_random(&r) % 2u ? LMB_NEAREST : LMB_BILINEAR;
    const size_t bytes = lmb_texture_bytes(texture.width, texture.height, 1);
    uint8_t *texels = malloc(bytes);
    for (size_t i = 0; i < bytes; ++i) {
        texels[i] = (uint8_t)test_random(&r);
    }
    texture.texels = texels;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        float texel[4];
        lmb_texture_sample(texel, &texture, want.uv[0][k], want.uv[1][k], 0.0f);
        for (int c = 0; c < 3 && batch.slot[k] >= 0; ++c) {
            want.albedo[c][k] *= texel[c];
        }
    }
    t->kernels->texture(&got, &batch, &texture);
    free(texels);
    return same_bytes(t, "tile", &want, &got, sizeof want);
}

static int trial_direct(const trial *t, test_rng r)
{
    static GUARDED(lmb_irradiance) want, got;
    static lmb_tile tile;
    const uint32_t rare = t->seed % 2u ? 12u : 0;
    lmb_direct_job job;
    GUARD(want);
    GUARD(got);
    make_tile(&tile, &r, rare);
    job.position = place(&r, 3.0f, rare);
    job.direction = direction(&r);
    numbers(job.intensity, 3, &r, 0.0f, 9.0f, rare);
    job.cos_outer = test_uniform(&r, 0.0f, 0.9f);
    job.cone_scale = number(&r, 1.0f, 1e6f, rare);
    job.kind = (int32_t)(t->seed / 2u % 3u);
    job.range2 = t->seed / 6u % 2u ? 0.0f : number(&r, 0.01f, 30.0f, 0);
    lmb_kernels_scalar.direct(&want.it, &tile, &job);
    t->kernels->direct(&got.it, &tile, &job);
    CHECK(canaries_stay(got.before, got.after));
    return same_floats(t, "rgb", want.it.rgb[0], got.it.rgb[0], 3 * LMB_TILE_PIXELS);
}

static int trial_blend(const trial *t, test_rng r)
{
    static GUARDED(lmb_radiance) want, got;
    static lmb_irradiance direct, indirect;
    static lmb_tile tile;
    const uint32_t rare = t->seed % 2u ? 12u : 0, which = t->seed / 2u % 4u;
    GUARD(want);
    GUARD(got);
    make_tile(&tile, &r, rare);
    numbers(direct.rgb[0], 3 * LMB_TILE_PIXELS, &r, 0.0f, 9.0f, rare);
    numbers(indirect.rgb[0], 3 * LMB_TILE_PIXELS, &r, 0.0f, 9.0f, rare);
    lmb_kernels_scalar.blend(&want.it, &tile, which & 1u ? NULL : &direct, which & 2u ? NULL : &indirect);
    t->kernels->blend(&got.it, &tile, which & 1u ? NULL : &direct, which & 2u ? NULL : &indirect);
    CHECK(canaries_stay(got.before, got.after));
    return same_floats(t, "rgb", want.it.rgb[0], got.it.rgb[0], 3 * LMB_TILE_PIXELS);
}

/* --- gather ------------------------------------------------------------------------------------------------------- */

/* A viewer's depth map: a slope with steps and holes. It ends at the end of its memory. */
typedef struct seen {
    lmb_view view;
    lmb_surface depth;
    lmb_occluder occluder;
    lmb_march_job job;
    void *memory;
} seen;

static void seen_init(seen *s, test_rng *r)
{
    const int32_t width = 9 + (int32_t)(test_random(r) % 40u), height = 9 + (int32_t)(test_random(r) % 40u);
    const int format = test_random(r) % 2u ? LMB_DEPTH16 : LMB_DEPTH32F;
    const lmb_vec3 eye = vec3(0.0f, 0.0f, 5.0f), target = vec3(0.1f, 0.2f, 0.0f), up = vec3(0.0f, 1.0f, 0.0f);
    lmb_view_look_at(&s->view, eye, target, up, 1.0f, width, height);
    s->view.near_m = 0.1f;
    s->view.far_m = 20.0f;
    if (test_random(r) % 4u == 0) {
        s->view.kind = LMB_ORTHOGRAPHIC;
        s->view.half_width = s->view.half_height = 3.0f;
    }
    const size_t bytes = lmb_surface_bytes(format, width, height), count = bytes / (size_t)lmb_pixel_bytes(format);
    s->memory = malloc(bytes);
    lmb_surface_init(&s->depth, format, width, height, s->memory, bytes);
    if (test_random(r) % 2u) {
        s->depth.layout = LMB_LINEAR;
        s->depth.stride_bytes = (width + 7) / 8 * 8 * lmb_pixel_bytes(format);
    }
    for (size_t i = 0; i < count; ++i) {
        float d = i / 16u % 3u ? 0.02f + 0.00002f * (float)i : test_random(r) % 4u ? 0.03f : 0.0f;
        if (format == LMB_DEPTH16) {
            ((uint16_t *)s->memory)[i] = (uint16_t)(d * 60000.0f);
        } else {
            ((float *)s->memory)[i] = d;
        }
    }
    s->occluder.view = &s->view;
    s->occluder.depth = &s->depth;
    s->occluder.kind = test_random(r) % 2u ? LMB_OCCLUSION_VIEW : LMB_OCCLUSION_VIEW_WORLD;
    s->occluder.steps = 1 + (int32_t)(test_random(r) % 20u);
    CHECK(lmb_march_setup(&s->job, &s->occluder) == 1);
}

/* Previous sums, including zeros of both signs: a zero's sign must not depend on the other lanes of the vector. */
static void make_sums(float out[3][LMB_TILE_PIXELS], test_rng *r)
{
    float *sum = out[0];
    for (int k = 0; k < 3 * LMB_TILE_PIXELS; ++k) {
        const uint32_t kind = test_random(r) % 4u;
        sum[k] = kind == 0 ? 0.0f : kind == 1 ? -0.0f : test_uniform(r, 0.0f, 3.0f);
    }
}

static void make_groups(lmb_groups *g, test_rng *r, uint32_t rare)
{
    memset(g, 0, sizeof *g);
    g->count = (int32_t)(test_random(r) % 12u);
    for (int32_t k = 0; k < g->count; ++k) {
        const lmb_vec3 p = place(r, 3.0f, rare), n = direction(r);
        const float at[3] = {p.x, p.y, p.z}, axis[3] = {n.x, n.y, n.z};
        for (int c = 0; c < 3; ++c) {
            g->position[c][k] = at[c];
            g->normal[c][k] = axis[c];
            g->flux[c][k] = number(r, 0.0f, 5.0f, rare);
        }
        g->area[k] = number(r, 0.0f, 1.0f, rare);
        g->radius[k] = number(r, 0.0f, 1.5f, rare);
    }
}

static void make_gather_tile(lmb_tile *tile, const trial *t, test_rng *r, uint32_t rare)
{
    if (t->seed % 3u == 0) {
        make_flat_tile(tile, r);
    } else {
        make_tile(tile, r, rare);
    }
}

static int trial_gather(const trial *t, test_rng r)
{
    static GUARDED(lmb_irradiance) want, got;
    static lmb_groups groups;
    static lmb_tile tile;
    const uint32_t rare = t->seed % 2u ? 20u : 0;
    seen s;
    GUARD(want);
    GUARD(got);
    seen_init(&s, &r);
    make_gather_tile(&tile, t, &r, rare);
    make_groups(&groups, &r, rare);
    make_sums(want.it.rgb, &r);
    got.it = want.it;
    static GUARDED(lmb_gather_scratch) near_want, near_got;
    const size_t bytes = sizeof(uint64_t) * (size_t)groups.count;
    GUARD(near_want);
    GUARD(near_got);
    const lmb_march_job *march = t->seed % 4u ? &s.job : NULL;
    lmb_kernels_scalar.gather(&want.it, &near_want.it, &tile, &groups, march);
    t->kernels->gather(&got.it, &near_got.it, &tile, &groups, march);
    CHECK(canaries_stay(got.before, got.after));
    CHECK(canaries_stay(near_got.before, near_got.after));
    int equal = same_bytes(t, "near pixels", near_want.it.near_pixels, near_got.it.near_pixels, bytes) &&
                same_floats(t, "rgb", want.it.rgb[0], got.it.rgb[0], 3 * LMB_TILE_PIXELS);
    free(s.memory);
    return equal;
}

static lmb_point make_disc(test_rng *r, lmb_vec3 around, uint32_t rare)
{
    lmb_point p;
    memset(&p, 0, sizeof p);
    p.position = add3(around, place(r, 0.5f, rare));
    p.normal = direction(r);
    p.axis_u = mul3(normalize3(cross3(p.normal, direction(r))), test_uniform(r, 0.01f, 0.4f));
    p.axis_v = mul3(cross3(p.normal, p.axis_u), test_uniform(r, 0.3f, 2.0f));
    numbers(p.flux, 3, r, 0.0f, 5.0f, rare);
    return p;
}

static int trial_gather_near(const trial *t, test_rng r)
{
    static GUARDED(lmb_irradiance) want, got;
    static lmb_tile tile;
    const uint32_t rare = t->seed % 2u ? 20u : 0, count = 1u + test_random(&r) % 9u;
    seen s;
    GUARD(want);
    GUARD(got);
    seen_init(&s, &r);
    make_gather_tile(&tile, t, &r, rare);
    make_sums(want.it.rgb, &r);
    got.it = want.it;
    lmb_point *discs = malloc(count * sizeof *discs);
    const lmb_vec3 around = vec3(tile.position[0][27], tile.position[1][27], tile.position[2][27]);
    for (uint32_t i = 0; i < count; ++i) {
        discs[i] = make_disc(&r, around, rare);
    }
    const uint64_t pixels = random_pixels(t, &r);
    const lmb_march_job *march = t->seed % 4u ? &s.job : NULL;
    lmb_kernels_scalar.gather_near(&want.it, pixels, &tile, discs, count, march);
    t->kernels->gather_near(&got.it, pixels, &tile, discs, count, march);
    CHECK(canaries_stay(got.before, got.after));
    int equal = same_floats(t, "rgb", want.it.rgb[0], got.it.rgb[0], 3 * LMB_TILE_PIXELS);
    free(discs);
    free(s.memory);
    return equal;
}

typedef struct pair_memory {
    float of[3][LMB_GATHER_PAIRS];
} pair_memory;

static lmb_emitter make_emitter(const trial *t, test_rng *r, uint32_t rare)
{
    lmb_emitter e;
    e.position = place(r, 3.0f, rare);
    e.back = direction(r);
    e.area_pi = number(r, 0.0f, 1.0f, rare);
    numbers(e.flux, 3, r, 0.0f, 5.0f, rare);
    e.visible = random_pixels(t, r);
    return e;
}

/* The emitters end at the end of their memory: fewer than a block, more, or none. Pixels that do not see an
 * emitter get no light from it. */
static int trial_gather_cut(const trial *t, test_rng r)
{
    static GUARDED(lmb_irradiance) want, got;
    static GUARDED(pair_memory) pairs;
    static lmb_tile tile;
    const uint32_t rare = t->seed % 2u ? 20u : 0;
    const int32_t count = (int32_t)(test_random(&r) % (t->seed % 8u ? 12u : LMB_CUT_BLOCK + 1u));
    uint64_t lit = 0;
    int kept = 1;
    GUARD(want);
    GUARD(got);
    GUARD(pairs);
    make_gather_tile(&tile, t, &r, rare);
    make_sums(want.it.rgb, &r);
    const lmb_irradiance before = got.it = want.it;
    lmb_emitter *emitters = malloc((size_t)count * sizeof *emitters + 1);
    for (int32_t i = 0; i < count; ++i) {
        emitters[i] = make_emitter(t, &r, rare);
        lit |= emitters[i].visible;
    }
    lmb_kernels_scalar.gather_cut(&want.it, pairs.it.of, &tile, emitters, count);
    t->kernels->gather_cut(&got.it, pairs.it.of, &tile, emitters, count);
    free(emitters);
    CHECK(canaries_stay(got.before, got.after));
    CHECK(canaries_stay(pairs.before, pairs.after));
    for (int i = 0; i < 3 * LMB_TILE_PIXELS; ++i) {
        const int c = i / LMB_TILE_PIXELS, k = i % LMB_TILE_PIXELS;
        kept &= (lit >> k & 1u) != 0 || bits_of(before.rgb[c][k]) == bits_of(got.it.rgb[c][k]);
    }
    return kept && same_floats(t, "rgb", want.it.rgb[0], got.it.rgb[0], 3 * LMB_TILE_PIXELS);
}

/* A node anywhere or at the patch; the box has a volume, or is flat, a line or a point. */
static void make_bounded_node(lmb_node_bounds *out, int k, test_rng *r, const lmb_pixel_cluster *p, uint32_t rare)
{
    const uint32_t flat = test_random(r) % 8u;
    const lmb_vec3 centre = test_random(r) % 8u ? place(r, 3.0f, rare) : p->centre, normal = direction(r);
    const lmb_vec3 middle = add3(centre, place(r, 0.1f, rare)), other = direction(r);
    const lmb_vec3 across = normalize3(sub3(other, mul3(normal, dot3(normal, other))));
    const float at[3] = {centre.x, centre.y, centre.z}, n[3] = {normal.x, normal.y, normal.z};
    const float m[3] = {middle.x, middle.y, middle.z}, a[3] = {across.x, across.y, across.z};
    for (int c = 0; c < 3; ++c) {
        out->node[LMB_BOUNDS_CENTRE + c][k] = at[c];
        out->node[LMB_BOUNDS_NORMAL + c][k] = n[c];
        out->node[LMB_BOUNDS_MIDDLE + c][k] = m[c];
        out->node[LMB_BOUNDS_ACROSS + c][k] = a[c];
        out->node[LMB_BOUNDS_HALF + c][k] = flat >> c & 1u ? 0.0f : number(r, 0.0f, 0.3f, rare);
    }
    out->node[LMB_BOUNDS_RADIUS][k] = number(r, 0.0f, 0.5f, rare);
    out->node[LMB_BOUNDS_AGREEMENT][k] = number(r, 0.0f, 1.0f, rare);
    out->node[LMB_BOUNDS_FLUX][k] = test_random(r) % 8u ? number(r, 0.0f, 5.0f, rare) : 0.0f;
    out->node[LMB_BOUNDS_AREA][k] = number(r, 0.0f, 0.5f, rare);
    out->node[LMB_BOUNDS_COSINE][k] = test_random(r) % 3u ? number(r, -1.0f, 1.0f, rare) : 1.0f;
}

/* Compares the weights of nodes that do not face away; other bytes depend on the backend. */
static int trial_node_bounds(const trial *t, test_rng r)
{
    static GUARDED(lmb_node_bounds) want, got;
    lmb_pixel_cluster p;
    const uint32_t rare = t->seed % 2u ? 20u : 0;
    const int32_t count = (int32_t)(test_random(&r) % LMB_BOUNDS_NODES) + 1, conservative = t->seed % 4u < 2u;
    int equal = 1;
    GUARD(want);
    GUARD(got);
    p.pixels = ~(uint64_t)0;
    p.centre = place(&r, 2.0f, 0);
    p.normal = direction(&r);
    p.axis[0] = t->seed % 7u ? p.normal : direction(&r);
    const lmb_vec3 other = direction(&r);
    p.axis[1] = normalize3(sub3(other, mul3(p.axis[0], dot3(p.axis[0], other))));
    p.axis[2] = cross3(p.axis[0], p.axis[1]);
    for (int c = 0; c < 3; ++c) {
        p.half[c] = test_uniform(&r, 0.0f, 0.3f);
    }
    p.thick = test_uniform(&r, 0.0f, 0.3f);
    p.noise = test_uniform(&r, 0.0f, 1e-5f);
    p.sine = t->seed % 3u ? 0.0f : test_uniform(&r, 0.0f, 1.0f);
    p.face_sine = maxf(p.sine, t->seed % 5u ? 0.0f : test_uniform(&r, 0.0f, 1.0f));
    for (int k = 0; k < LMB_BOUNDS_NODES; ++k) {
        make_bounded_node(&want.it, k, &r, &p, rare);
    }
    got.it = want.it;
    const uint32_t own = count < 32 ? (1u << count) - 1u : ~0u;
    const uint32_t faces = lmb_kernels_scalar.node_bounds(&want.it, count, &p, conservative) & own,
                   also = t->kernels->node_bounds(&got.it, count, &p, conservative) & own;
    CHECK(canaries_stay(got.before, got.after));
    for (int k = 0; k < count; ++k) {
        if (faces >> k & 1u) {
            equal &= same_floats(t, "value", &want.it.value[k], &got.it.value[k], 1) &&
                     same_floats(t, "most", &want.it.upper[k], &got.it.upper[k], 1) &&
                     same_floats(t, "error", &want.it.error[k], &got.it.error[k], 1);
        }
    }
    return equal && same_bytes(t, "faces", &faces, &also, sizeof faces) &&
           same_floats(t, "node", want.it.node[0], got.it.node[0], LMB_BOUNDS_PLANES * LMB_BOUNDS_NODES);
}

/* --- glossy reflection -------------------------------------------------------------------------------------------- */

/* Sharp and wide lobes, with previous sums. Pixels without lobes have random values too. */
static void make_glossy(lmb_glossy *out, const trial *t, test_rng *r, uint32_t rare)
{
    memset(out, 0, sizeof *out);
    out->pixels = random_pixels(t, r);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const float roughness = test_uniform(r, 0.1f, 1.0f), alpha = roughness * roughness;
        set_pixel(out->towards, k, direction(r));
        out->alpha2[k] = rare && test_random(r) % rare == 0 ? hard_float(r) : alpha * alpha;
    }
    numbers(out->specular[0], 3 * LMB_TILE_PIXELS, r, 0.0f, 1.0f, rare);
    numbers(out->facing, LMB_TILE_PIXELS, r, 0.001f, 1.0f, rare);
    make_sums(out->rgb, r);
}

/* The light must be the same on every backend; emitters that light no pixel of `lit` must leave the sums and
 * all other bytes unchanged. */
static int same_glossy(const trial *t, const lmb_glossy *want, const lmb_glossy *got, const lmb_glossy *before,
                       uint64_t lit)
{
    int kept = 1;
    for (int i = 0; i < 3 * LMB_TILE_PIXELS; ++i) {
        const int c = i / LMB_TILE_PIXELS, k = i % LMB_TILE_PIXELS;
        kept &= (lit >> k & 1u) != 0 || bits_of(before->rgb[c][k]) == bits_of(got->rgb[c][k]);
    }
    CHECK_MSG(kept, "%s %s lights pixels that it should not", t->kernels->name, t->kernel);
    return kept && same_floats(t, "rgb", want->rgb[0], got->rgb[0], 3 * LMB_TILE_PIXELS) &&
           same_bytes(t, "lobes", before, got, offsetof(lmb_glossy, rgb));
}

static int trial_glossy_direct(const trial *t, test_rng r)
{
    static GUARDED(lmb_glossy) want, got;
    static lmb_irradiance lit;
    static lmb_tile tile;
    const uint32_t rare = t->seed % 2u ? 20u : 0;
    lmb_light light;
    GUARD(want);
    GUARD(got);
    memset(&light, 0, sizeof light);
    make_gather_tile(&tile, t, &r, rare);
    make_glossy(&want.it, t, &r, rare);
    numbers(lit.rgb[0], 3 * LMB_TILE_PIXELS, &r, 0.0f, 9.0f, rare);
    light.position = place(&r, 3.0f, rare);
    light.direction = direction(&r);
    light.kind = (int32_t)(t->seed / 2u % 3u);
    const lmb_glossy before = got.it = want.it;
    lmb_kernels_scalar.glossy_direct(&want.it, &tile, &lit, &light);
    t->kernels->glossy_direct(&got.it, &tile, &lit, &light);
    CHECK(canaries_stay(got.before, got.after));
    return same_glossy(t, &want.it, &got.it, &before, before.pixels);
}

/* The emitters end at the end of their memory. */
static int trial_glossy_cut(const trial *t, test_rng r)
{
    static GUARDED(lmb_glossy) want, got;
    static lmb_tile tile;
    const uint32_t rare = t->seed % 2u ? 20u : 0;
    const int32_t count = (int32_t)(test_random(&r) % 10u);
    uint64_t lit = 0;
    GUARD(want);
    GUARD(got);
    make_gather_tile(&tile, t, &r, rare);
    make_glossy(&want.it, t, &r, rare);
    const lmb_glossy before = got.it = want.it;
    lmb_emitter *emitters = malloc((size_t)count * sizeof *emitters + 1);
    for (int32_t i = 0; i < count; ++i) {
        emitters[i] = make_emitter(t, &r, rare);
        lit |= emitters[i].visible;
    }
    lmb_kernels_scalar.glossy_cut(&want.it, &tile, emitters, count);
    t->kernels->glossy_cut(&got.it, &tile, emitters, count);
    free(emitters);
    CHECK(canaries_stay(got.before, got.after));
    return same_glossy(t, &want.it, &got.it, &before, lit & before.pixels);
}

/* --- occlusion ---------------------------------------------------------------------------------------------------- */

/* Some planes pass through the pixels' own positions, so that sides are 0. */
static int trial_crossed(const trial *t, test_rng r)
{
    static lmb_tile tile;
    lmb_cross_job job;
    const uint32_t rare = t->seed % 2u ? 20u : 0;
    make_gather_tile(&tile, t, &r, rare);
    job.at = place(&r, 2.0f, rare);
    for (int i = 0; i < 3; ++i) {
        const int k = (int)(test_random(&r) % LMB_TILE_PIXELS);
        const lmb_vec3 p = vec3(tile.position[0][k], tile.position[1][k], tile.position[2][k]);
        job.edge[i] = t->seed % 3u ? direction(&r) : cross3(sub3(p, job.at), direction(&r));
    }
    job.normal = direction(&r);
    job.beyond = test_uniform(&r, -1.0f, 1.0f);
    const uint64_t pixels = random_pixels(t, &r);
    const uint64_t want = lmb_kernels_scalar.crossed(&tile, pixels, &job),
                   got = t->kernels->crossed(&tile, pixels, &job);
    return (want & ~pixels) == 0 && same_bytes(t, "pixels", &want, &got, sizeof want);
}

/* Some points lie in the pixels' own planes along an axis, so that differences are 0. */
static int trial_segments(const trial *t, test_rng r)
{
    static GUARDED(lmb_segments) want, got;
    static lmb_tile tile;
    const uint32_t rare = t->seed % 2u ? 20u : 0;
    lmb_vec3 at = place(&r, 2.0f, rare);
    GUARD(want);
    GUARD(got);
    make_gather_tile(&tile, t, &r, rare);
    at.x = t->seed % 3u ? at.x : tile.position[0][test_random(&r) % LMB_TILE_PIXELS];
    at.z = t->seed % 7u ? at.z : tile.position[2][test_random(&r) % LMB_TILE_PIXELS];
    lmb_kernels_scalar.segments(&want.it, &tile, at);
    t->kernels->segments(&got.it, &tile, at);
    CHECK(canaries_stay(got.before, got.after));
    return same_floats(t, "at", &want.it.at.x, &got.it.at.x, 3) &&
           same_floats(t, "per", want.it.per[0], got.it.per[0], 3 * LMB_TILE_PIXELS);
}

/* Boxes of all sizes, some around the segments' common end, some flat, some empty. */
static void make_boxes(lmb_boxes *out, test_rng *r, lmb_vec3 end, uint32_t rare)
{
    memset(out, 0, sizeof *out);
    for (int i = 0; i < LMB_BOXES; ++i) {
        const float half = test_random(r) % 4u == 0 ? 0.0f : test_uniform(r, -0.1f, 1.5f);
        const lmb_vec3 middle = test_random(r) % 3u ? place(r, 2.0f, rare) : end;
        const float at[3] = {middle.x, middle.y, middle.z};
        for (int c = 0; c < 3; ++c) {
            out->low[c][i] = at[c] - half * test_uniform(r, 0.0f, 1.0f);
            out->high[c][i] = at[c] + half * test_uniform(r, 0.0f, 1.0f);
        }
    }
}

static int trial_through(const trial *t, test_rng r)
{
    static lmb_segments segments;
    static lmb_tile tile;
    static lmb_boxes boxes;
    const uint32_t rare = t->seed % 2u ? 20u : 0;
    make_gather_tile(&tile, t, &r, rare);
    lmb_kernels_scalar.segments(&segments, &tile, place(&r, 2.0f, rare));
    make_boxes(&boxes, &r, segments.at, rare);
    const int i = (int)(test_random(&r) % LMB_BOXES);
    const uint64_t pixels = random_pixels(t, &r);
    const uint64_t want = lmb_kernels_scalar.through(&segments, pixels, &boxes, i),
                   got = t->kernels->through(&segments, pixels, &boxes, i);
    return (want & ~pixels) == 0 && same_bytes(t, "pixels", &want, &got, sizeof want);
}

/* 1 / d, limited in size. */
static float per(float d) { return 1.0f / (absf(d) < 1e-20f ? (d < 0.0f ? -1e-20f : 1e-20f) : d); }

static int trial_meets(const trial *t, test_rng r)
{
    static lmb_boxes boxes;
    const uint32_t rare = t->seed % 2u ? 20u : 0;
    const lmb_vec3 at = place(&r, 2.0f, 0), low = place(&r, 2.0f, 0);
    const float end[3] = {at.x, at.y, at.z}, from[3] = {low.x, low.y, low.z};
    lmb_pyramid p;
    for (int c = 0; c < 3; ++c) {
        p.at[c] = end[c];
        p.per_low[c] = per(t->seed % 5u == 0 && c == 1 ? 0.0f : from[c] - end[c]);
        p.per_high[c] = per(from[c] + test_uniform(&r, 0.0f, 1.0f) - end[c]);
    }
    make_boxes(&boxes, &r, at, rare);
    const uint32_t want = lmb_kernels_scalar.meets(&p, &boxes), got = t->kernels->meets(&p, &boxes);
    return want >> LMB_BOXES == 0 && same_bytes(t, "boxes", &want, &got, sizeof want);
}

/* Segments forwards or backwards along each axis; some have no extent in y. */
static int trial_meets_one(const trial *t, test_rng r)
{
    static lmb_boxes boxes;
    const uint32_t rare = t->seed % 2u ? 20u : 0;
    const lmb_vec3 at = place(&r, 2.0f, 0), to = place(&r, 2.0f, 0);
    const float d[3] = {to.x - at.x, t->seed % 5u == 0 ? 0.0f : to.y - at.y, to.z - at.z};
    const int32_t high = 3 * LMB_BOXES;
    lmb_segment s;
    s.at = at;
    s.per = vec3(per(d[0]), per(d[1]), per(d[2]));
    for (int c = 0; c < 3; ++c) {
        s.enter[c] = c * LMB_BOXES + (d[c] < 0.0f ? high : 0);
        s.leave[c] = c * LMB_BOXES + (d[c] < 0.0f ? 0 : high);
    }
    make_boxes(&boxes, &r, at, rare);
    const uint32_t want = lmb_kernels_scalar.meets_one(&s, &boxes), got = t->kernels->meets_one(&s, &boxes);
    return want >> LMB_BOXES == 0 && same_bytes(t, "boxes", &want, &got, sizeof want);
}

static int trial_sun_meets(const trial *t, test_rng r)
{
    static lmb_boxes boxes;
    const uint32_t rare = t->seed % 2u ? 20u : 0;
    const lmb_vec3 to = direction(&r), low = place(&r, 2.0f, 0);
    const float d[3] = {to.x, t->seed % 5u == 0 ? 0.0f : to.y, to.z}, from[3] = {low.x, low.y, low.z};
    lmb_sun_sweep s;
    for (int c = 0; c < 3; ++c) {
        s.low[c] = from[c];
        s.high[c] = from[c] + test_uniform(&r, 0.0f, 1.0f);
        s.per[c] = per(d[c]);
    }
    make_boxes(&boxes, &r, low, rare);
    const uint32_t want = lmb_kernels_scalar.sun_meets(&s, &boxes), got = t->kernels->sun_meets(&s, &boxes);
    return want >> LMB_BOXES == 0 && same_bytes(t, "boxes", &want, &got, sizeof want);
}

static int trial_sun_crossed(const trial *t, test_rng r)
{
    static lmb_tile tile;
    const uint32_t rare = t->seed % 2u ? 20u : 0;
    lmb_sun_job job;
    make_gather_tile(&tile, t, &r, rare);
    job.at = place(&r, 2.0f, rare);
    job.normal = direction(&r);
    for (int i = 0; i < 3; ++i) {
        job.edge[i] = place(&r, 2.0f, rare);
        job.offset[i] = number(&r, -0.5f, 2.0f, rare);
    }
    job.beyond = number(&r, -2.0f, 2.0f, rare);
    const uint64_t pixels = random_pixels(t, &r);
    const uint64_t want = lmb_kernels_scalar.sun_crossed(&tile, pixels, &job),
                   got = t->kernels->sun_crossed(&tile, pixels, &job);
    return (want & ~pixels) == 0 && same_bytes(t, "pixels", &want, &got, sizeof want);
}

/* --- many lights -------------------------------------------------------------------------------------------------- */

/* Planes of nodes of exactly the length that kernels may read, and the part of a tile that requests the bounds. */
static int trial_many_lights_bounds(const trial *t, test_rng r)
{
    enum { STEP = 64 };
    static GUARDED(float_pair) want, got;
    float plane[LMB_MANY_LIGHTS_PLANES][STEP], inside[2][16];
    static lmb_many_lights_node node[STEP];
    lmb_many_lights many_lights;
    lmb_many_lights_job job;
    const uint32_t rare = t->seed % 2u ? 20u : 0, count = 1u + test_random(&r) % 8u;
    const uint32_t first = test_random(&r) % (STEP - 16 - 8);
    memset(&many_lights, 0, sizeof many_lights);
    many_lights.plane = plane[0];
    many_lights.plane_step = STEP;
    many_lights.node = node;
    for (int i = 0; i < STEP; ++i) {
        node[i].kind = t->seed % 3u;
    }
    numbers(plane[0], LMB_MANY_LIGHTS_PLANES * STEP, &r, -3.0f, 3.0f, rare);
    numbers(plane[LMB_MANY_LIGHTS_HALF], 3 * STEP, &r, 0.0f, 0.5f, rare);
    numbers(plane[LMB_MANY_LIGHTS_POWER], STEP, &r, 0.0f, 5.0f, rare);
    numbers(plane[LMB_MANY_LIGHTS_RANGE], STEP, &r, 0.0f, 9.0f, rare);
    numbers(plane[LMB_MANY_LIGHTS_RANGE + 1], STEP, &r, 9.0f, 30.0f, rare);
    many_lights.ranged = t->seed / 6u % 2u;
    job.middle = place(&r, 2.0f, 0);
    job.half = vec3(test_uniform(&r, 0.0f, 0.3f), test_uniform(&r, 0.0f, 0.3f), test_uniform(&r, 0.0f, 0.3f));
    job.normal = direction(&r);
    job.bend = t->seed % 3u ? 0.0f : test_uniform(&r, 0.0f, 0.4f);
    GUARD(want);
    GUARD(got);
    numbers(plane[LMB_MANY_LIGHTS_AXIS], 5 * STEP, &r, -1.0f, 1.0f, rare);
    numbers(plane[LMB_MANY_LIGHTS_OUTER], STEP, &r, 0.0f, 1.0f, rare);
    lmb_kernels_scalar.many_lights_bounds(want.it.a, want.it.b, inside[0], &many_lights, first, count, &job);
    t->kernels->many_lights_bounds(got.it.a, got.it.b, inside[1], &many_lights, first, count, &job);
    CHECK(canaries_stay(got.before, got.after));
    return same_floats(t, "error", want.it.a, got.it.a, (int)count) &&
           same_floats(t, "light", want.it.b, got.it.b, (int)count) &&
           same_floats(t, "inside", inside[0], inside[1], (int)count);
}

static lmb_active_light make_active_light(test_rng *r, uint32_t rare)
{
    lmb_active_light light;
    light.position = place(r, 3.0f, rare);
    numbers(light.intensity, 3, r, 0.0f, 5.0f, rare);
    light.spread = test_random(r) % 2u ? 0.0f : number(r, 0.0f, 0.5f, rare);
    light.share[0] = test_uniform(r, 0.5f, 1.0f);
    light.share[1] = 1.0f - light.share[0];
    for (int i = 0; i < 2; ++i) {
        light.seen[i] = (uint64_t)test_random(r) << 32 | test_random(r);
        light.source[i].position = place(r, 3.0f, rare);
        light.source[i].direction = direction(r);
        light.source[i].cos_outer = test_uniform(r, 0.0f, 1.0f);
        light.per[i] = test_uniform(r, 1.0f, 20.0f);
        light.source[i].range2 = test_random(r) % 2u ? 0.0f : test_uniform(r, 0.1f, 30.0f);
    }
    light.kind = test_random(r) % 3u;
    return light;
}

static int trial_many_lights_irradiance(const trial *t, test_rng r)
{
    static GUARDED(lmb_irradiance) want, got;
    static lmb_tile tile;
    lmb_active_light light[9];
    const uint32_t rare = t->seed % 2u ? 20u : 0;
    const int32_t count = (int32_t)(test_random(&r) % 10u);
    GUARD(want);
    GUARD(got);
    make_gather_tile(&tile, t, &r, rare);
    make_sums(want.it.rgb, &r);
    got.it = want.it;
    for (int32_t i = 0; i < count; ++i) {
        light[i] = make_active_light(&r, rare);
    }
    const uint64_t pixels = random_pixels(t, &r);
    lmb_kernels_scalar.many_lights_irradiance(&want.it, &tile, pixels, light, count);
    t->kernels->many_lights_irradiance(&got.it, &tile, pixels, light, count);
    CHECK(canaries_stay(got.before, got.after));
    return same_floats(t, "rgb", want.it.rgb[0], got.it.rgb[0], 3 * LMB_TILE_PIXELS);
}

/* --- encode ------------------------------------------------------------------------------------------------------- */

/* Values near thresholds and random ones, against a search through the table. */
static int trial_encode(const trial *t, test_rng r)
{
    lmb_radiance in;
    uint32_t want[LMB_TILE_PIXELS], got[LMB_TILE_PIXELS];
    const float gain = t->seed % 3u ? 1.0f : test_uniform(&r, 0.1f, 8.0f);
    for (int c = 0; c < 3; ++c) {
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            uint32_t bits = bits_of(lmb_srgb_threshold[1u + test_random(&r) % 255u]) + test_random(&r) % 5u - 2u;
            memcpy(&in.rgb[c][k], &bits, sizeof bits);
            if (test_random(&r) % 2u) {
                in.rgb[c][k] = number(&r, -0.1f, 1.2f, 6);
            }
            want[k] = (c > 0 ? want[k] : 255u << 24) | (uint32_t)lmb_srgb_encode(in.rgb[c][k] * gain) << 8 * c;
        }
    }
    t->kernels->encode(got, &in, gain);
    return same_bytes(t, "code", want, got, sizeof want);
}

/* --- probes ------------------------------------------------------------------------------------------------------- */

enum { WORLD_FACE = 12, WORLD_GROUND = 20, WORLD_WORDS = 40000, PROBE_HEIGHT = 8, PROBE_COUNT = 128 };

/* A world of random pictures between guard bytes; in some, faces are missing or ground is blank. */
static int make_surroundings(lmb_world *out, uint32_t *memory, const trial *t, test_rng *r)
{
    static float face[6][WORLD_FACE * WORLD_FACE * 3], ground[WORLD_GROUND * WORLD_GROUND * 4];
    lmb_world_pictures p;
    memset(&p, 0, sizeof p);
    p.face_size = 1 + (int32_t)(test_random(r) % WORLD_FACE);
    for (int i = 0; i < 6; ++i) {
        numbers(face[i], WORLD_FACE * WORLD_FACE * 3, r, 0.0f, 120.0f, t->seed % 2u ? 20u : 0);
        p.face[i] = test_random(r) % 8u ? face[i] : NULL;
    }
    numbers(ground, WORLD_GROUND * WORLD_GROUND * 4, r, 0.0f, 2.0f, t->seed % 2u ? 20u : 0);
    p.ground = t->seed % 5u ? ground : NULL;
    p.ground_width = 1 + (int32_t)(test_random(r) % WORLD_GROUND);
    p.ground_height = 1 + (int32_t)(test_random(r) % WORLD_GROUND);
    p.ground_x = p.ground_z = test_uniform(r, -20.0f, 0.0f);
    p.ground_width_m = test_uniform(r, 1.0f, 40.0f);
    p.ground_depth_m = test_uniform(r, 1.0f, 40.0f);
    p.ground_y = test_uniform(r, -2.0f, 0.0f);
    p.centre = vec3(0.0f, 1.0f, 0.0f);
    p.has_floor = t->seed % 4u == 1u;
    p.shape = t->seed % 3u ? LMB_WORLD_SPHERE : LMB_WORLD_BOX;
    p.radius = test_uniform(r, 2.0f, 30.0f);
    p.low = vec3(-8.0f, -3.0f, -5.0f);
    p.high = vec3(9.0f, 7.0f, 12.0f);
    const int32_t format = (int32_t)(t->seed % 7u % 3u);
    return lmb_world_bytes(&p, format) <= WORLD_WORDS * sizeof *memory &&
           lmb_world_init(out, &p, format, memory, lmb_world_bytes(&p, format)) == LMB_OK;
}

typedef struct probe_map {
    float rgb[3 * PROBE_COUNT];
} probe_map;

static int trial_remap(const trial *t, test_rng r)
{
    static uint32_t texels[WORLD_WORDS], directions[4096];
    static GUARDED(probe_map) want, got;
    lmb_world world;
    lmb_probe_table table;
    GUARD(want);
    GUARD(got);
    const lmb_vec3 at = vec3(test_uniform(&r, -12.0f, 12.0f), test_uniform(&r, -3.0f, 9.0f),
                             test_uniform(&r, -12.0f, 12.0f));
    const int32_t blend = t->seed % 4u == 3u;
    const float start = test_uniform(&r, -180.0f, 0.0f);
    const lmb_status made =
        lmb_probe_table_init(&table, 2 * PROBE_HEIGHT, PROBE_HEIGHT, start, directions, sizeof directions);
    CHECK(made == LMB_OK && make_surroundings(&world, texels, t, &r));
    CHECK(lmb_probe_remap(want.it.rgb, &lmb_kernels_scalar, &world, &table, at, blend) == LMB_OK);
    CHECK(lmb_probe_remap(got.it.rgb, t->kernels, &world, &table, at, blend) == LMB_OK);
    CHECK(canaries_stay(got.before, got.after));
    return same_floats(t, "rgb", want.it.rgb, got.it.rgb, 3 * PROBE_COUNT);
}

typedef struct probe_normals {
    float xyz[3][LMB_TILE_PIXELS];
} probe_normals;

/* Rays from inside and outside the world, and samples by direction only; some smoothed, some of means. */
static int trial_see(const trial *t, test_rng r)
{
    static uint32_t texels[WORLD_WORDS];
    static GUARDED(probe_normals) want[2], got[2];
    static probe_normals origin, direction;
    lmb_world world;
    lmb_world_job job;
    for (int i = 0; i < 2; ++i) {
        GUARD(want[i]);
        GUARD(got[i]);
    }
    CHECK(make_surroundings(&world, texels, t, &r));
    lmb_world_ask(&job, &world, LMB_WORLD_ALL, test_uniform(&r, 0.0f, 1.0f), t->seed % 4u == 3u);
    job.means = t->seed % 5u == 2u;
    numbers(origin.xyz[0], 3 * LMB_TILE_PIXELS, &r, -12.0f, 12.0f, t->seed % 4u ? 0 : 20u);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        lmb_vec3 d = vec3(test_uniform(&r, -1.0f, 1.0f), test_uniform(&r, -1.0f, 1.0f), test_uniform(&r, -1.0f, 1.0f));
        d = k % 9 == 0 ? vec3(0.0f, k % 2 ? 1.0f : -1.0f, 0.0f) : normalize3(d);
        direction.xyz[0][k] = d.x;
        direction.xyz[1][k] = d.y;
        direction.xyz[2][k] = d.z;
    }
    lmb_kernels_scalar.see(want[0].it.xyz, origin.xyz, direction.xyz, &job);
    t->kernels->see(got[0].it.xyz, origin.xyz, direction.xyz, &job);
    lmb_kernels_scalar.world_radiance(want[1].it.xyz, direction.xyz, &job);
    t->kernels->world_radiance(got[1].it.xyz, direction.xyz, &job);
    CHECK(canaries_stay(got[0].before, got[0].after) && canaries_stay(got[1].before, got[1].after));
    return same_floats(t, "seen", want[0].it.xyz[0], got[0].it.xyz[0], 3 * LMB_TILE_PIXELS) &&
           same_floats(t, "looked", want[1].it.xyz[0], got[1].it.xyz[0], 3 * LMB_TILE_PIXELS);
}

typedef struct probe_shares {
    float rgbw[LMB_PROBE_BORDERED + 1][4];
} probe_shares;

static int trial_share(const trial *t, test_rng r)
{
    static GUARDED(probe_shares) want, got;
    static uint32_t memory[4096];
    static float map[3 * PROBE_COUNT];
    lmb_probe_table table;
    GUARD(want);
    GUARD(got);
    const float start = test_uniform(&r, -180.0f, 0.0f);
    CHECK(lmb_probe_table_init(&table, 2 * PROBE_HEIGHT, PROBE_HEIGHT, start, memory, sizeof memory) == LMB_OK);
    numbers(map, 3 * PROBE_COUNT, &r, 0.0f, 9.0f, t->seed % 4u ? 0 : 20u);
    numbers(want.it.rgbw[0], 4 * (LMB_PROBE_BORDERED + 1), &r, 0.0f, 1.0f, 0);
    got.it = want.it;
    lmb_kernels_scalar.share(want.it.rgbw, map, &table);
    t->kernels->share(got.it.rgbw, map, &table);
    CHECK(canaries_stay(got.before, got.after));
    return same_floats(t, "shares", want.it.rgbw[0], got.it.rgbw[0], 4 * (LMB_PROBE_BORDERED + 1));
}

static int trial_cosine(const trial *t, test_rng r)
{
    static GUARDED(probe_normals) want, got;
    static probe_normals normal;
    static lmb_probe_lights lights;
    static float at[3 * LMB_PROBE_TEXELS];
    GUARD(want);
    GUARD(got);
    numbers(normal.xyz[0], 3 * LMB_TILE_PIXELS, &r, -1.0f, 1.0f, t->seed % 2u ? 20u : 0);
    numbers(lights.rgbw[0], 4 * LMB_PROBE_TEXELS, &r, 0.0f, 9.0f, t->seed % 4u ? 0 : 20u);
    numbers(at, 3 * LMB_PROBE_TEXELS, &r, -1.0f, 1.0f, 0);
    numbers(lights.peak[0], 6 * LMB_PROBE_PEAKS, &r, -1.0f, 1.0f, 0);
    lights.peaks = (int32_t)(t->seed % (LMB_PROBE_PEAKS + 1));
    lmb_kernels_scalar.cosine(want.it.xyz, normal.xyz, &lights, at);
    t->kernels->cosine(got.it.xyz, normal.xyz, &lights, at);
    CHECK(canaries_stay(got.before, got.after));
    return same_floats(t, "rgb", want.it.xyz[0], got.it.xyz[0], 3 * LMB_TILE_PIXELS);
}

typedef struct probe_row {
    float v[32];
} probe_row;

/* The last column of the maps is at the end of their memory. */
static int trial_blur(const trial *t, test_rng r)
{
    static GUARDED(probe_row) want, got;
    lmb_blur_job job;
    float column[32], row[32], line[128];
    GUARD(want);
    GUARD(got);
    job.height = t->seed % 2u ? 8 : 16;
    job.width = 2 * job.height;
    job.over = t->seed % 3u == 0;
    float *map = malloc((size_t)(job.width * job.height) * sizeof *map);
    numbers(map, job.width * job.height, &r, 0.0f, 9.0f, t->seed % 4u ? 0 : 20u);
    numbers(column, 32, &r, -1.0f, 1.0f, 0);
    numbers(row, 32, &r, -1.0f, 1.0f, 0);
    numbers(want.it.v, 32, &r, 0.0f, 1.0f, 0);
    got.it = want.it;
    job.map = map;
    job.column = column;
    job.row = row;
    lmb_kernels_scalar.blur(want.it.v, line, &job);
    t->kernels->blur(got.it.v, line, &job);
    free(map);
    CHECK(canaries_stay(got.before, got.after));
    return same_floats(t, "row", want.it.v, got.it.v, 32);
}

/* --- voxels ------------------------------------------------------------------------------------------------------- */

enum { TREE_VOXELS = 4689 + 8 * 200, TREE_DEPTH = 6, TREE_STEPS = 12 };

/* A tree of random numbers, which need not correspond to a scene. */
typedef struct voxel_tree {
    float child[TREE_VOXELS], cover[TREE_VOXELS][LMB_VOXEL_COVER], light[TREE_VOXELS][LMB_VOXEL_LIGHT];
} voxel_tree;

static void make_voxels(voxel_tree *v, test_rng *r)
{
    uint32_t next = 4689;
    memset(v, 0, sizeof *v);
    for (uint32_t at = 593; at < TREE_VOXELS; ++at) {
        const int has = test_random(r) % (at < 4689 ? 16u : 3u) == 0;
        if (has && next + 8 <= TREE_VOXELS) {
            v->child[at] = (float)next;
            next += 8;
        }
    }
    for (uint32_t at = 8; at < TREE_VOXELS; ++at) {
        if (test_random(r) % 2u == 0) {
            numbers(v->cover[at], LMB_VOXEL_COVER, r, 0.0f, 1.0f, 0);
            numbers(v->light[at], LMB_VOXEL_LIGHT, r, 0.0f, 9.0f, 0);
            for (int k = 8; k < 11; ++k) {
                v->cover[at][k] -= 0.5f;
            }
        }
    }
}

/* A depth below 6 truncates the same tree, so that every level is the last in some case. */
static int trial_cone(const trial *t, test_rng r)
{
    static GUARDED(lmb_cone_seen) want, got;
    static voxel_tree *tree;
    static lmb_tile tile;
    static float direction[3][LMB_TILE_PIXELS];
    lmb_cone_step step[TREE_STEPS];
    lmb_cone_job job;
    GUARD(want);
    GUARD(got);
    if (tree == NULL) {
        test_rng own = {7};
        tree = malloc(sizeof *tree);
        make_voxels(tree, &own);
    }
    memset(&job, 0, sizeof job);
    job.child = tree->child;
    job.cover = tree->cover[0];
    job.light = tree->light[0];
    job.step = step;
    job.steps = 1 + (int32_t)(t->seed % TREE_STEPS);
    job.depth = 4 + (int32_t)(test_random(&r) % (TREE_DEPTH - 3));
    job.low = place(&r, 3.0f, 0);
    job.leaf = test_uniform(&r, 0.02f, 0.3f);
    job.per_leaf = 1.0f / job.leaf;
    job.faced = (int32_t)(t->seed / TREE_STEPS % 2);
    make_tile(&tile, &r, t->seed % 4u ? 0 : 20u);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        set_pixel(direction, k, direction_of_axis(&r));
    }
    for (int i = 0; i < job.steps; ++i) {
        step[i].at = test_uniform(&r, 0.0f, 6.0f);
        step[i].length = test_uniform(&r, 0.1f, 8.0f);
        step[i].apart = test_random(&r) % 2u ? test_uniform(&r, 0.01f, 1.0f) : 0.0f;
        step[i].level = (int32_t)(test_random(&r) % (uint32_t)(job.depth - 1));
        step[i].finer = test_random(&r) % 4u ? test_uniform(&r, 0.0f, 1.0f) : 1.0f;
    }
    lmb_kernels_scalar.cone(&want.it, &job, &tile, direction);
    t->kernels->cone(&got.it, &job, &tile, direction);
    CHECK(canaries_stay(got.before, got.after));
    return same_floats(t, "rgb", want.it.rgb[0], got.it.rgb[0], 3 * LMB_TILE_PIXELS) &&
           same_floats(t, "open", want.it.open, got.it.open, LMB_TILE_PIXELS);
}

/* --- reliefs ------------------------------------------------------------------------------------------------------ */

enum { RELIEF_SIDE = 16 };

/* Pixels near the cube around a sphere, far from it, or without a surface. */
static void make_relief_tile(lmb_tile *tile, test_rng *r, uint32_t rare)
{
    make_tile(tile, r, rare);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        if (test_random(r) % 8u) {
            const lmb_vec3 d = direction(r);
            set_pixel(tile->position, k, mul3(d, test_uniform(r, 0.9f, 1.3f)));
            set_pixel(tile->normal, k, d);
        }
    }
}

static lmb_view relief_eye(test_rng *r)
{
    lmb_view v = small_view((int)(test_random(r) % SMALL_VIEWS), RELIEF_SIDE);
    if (test_random(r) % 2u) {
        lmb_view_look_at(&v, mul3(direction(r), 4.0f), place(r, 0.3f, 0), vec3(0.1f, 1.0f, 0.2f), 0.7f, 64, 48);
    }
    return v;
}

static int trial_relief(const trial *t, test_rng r)
{
    static uint32_t file[SMALL_WORDS(RELIEF_SIDE)];
    static GUARDED(lmb_tile) want, got;
    static lmb_relief relief;
    const size_t bytes = small_relief(file, (int32_t)(t->seed & 1u), RELIEF_SIDE);
    const lmb_relief_how how = {(int32_t)(t->seed % 7u), (int32_t)(t->seed >> 1 & 1u), (int32_t)(t->seed >> 2 & 1u),
                                (int32_t)(t->seed % 9u), (int32_t)(t->seed % 4u)};
    lmb_relief_stats stats[2];
    if (t->seed % 5u == 0) { /* texels that no baker writes */
        for (size_t i = SMALL_WORDS(RELIEF_SIDE) - SMALL_VIEWS * 3 * RELIEF_SIDE * RELIEF_SIDE; i < bytes / 4; ++i) {
            file[i] = test_random(&r);
        }
    }
    CHECK(lmb_relief_open(&relief, file, bytes) == LMB_OK);
    const lmb_view view = relief_eye(&r);
    memset(stats, 0, sizeof stats);
    GUARD(want);
    GUARD(got);
    make_relief_tile(&want.it, &r, t->seed % 4u ? 0 : 25u);
    got.it = want.it;
    CHECK(lmb_relief_tile(&want.it, &lmb_kernels_scalar, &relief, &view, &how, &stats[0]) == LMB_OK);
    CHECK(lmb_relief_tile(&got.it, t->kernels, &relief, &view, &how, &stats[1]) == LMB_OK);
    CHECK(canaries_stay(got.before, got.after));
    return same_floats(t, "position", want.it.position[0], got.it.position[0], 3 * LMB_TILE_PIXELS) &&
           same_floats(t, "normal", want.it.normal[0], got.it.normal[0], 3 * LMB_TILE_PIXELS) &&
           same_floats(t, "albedo", want.it.albedo[0], got.it.albedo[0], 3 * LMB_TILE_PIXELS) &&
           same_floats(t, "depth", want.it.depth, got.it.depth, LMB_TILE_PIXELS) &&
           same_bytes(t, "ids", want.it.id, got.it.id, sizeof got.it.id) &&
           same_bytes(t, "counts", &stats[0], &stats[1], sizeof stats[0]);
}

/* --- baked light -------------------------------------------------------------------------------------------------- */

enum { NODES = 200, LINKS = 150, RUN = 40, PAST_RUN = RUN + 16, HALVES = 400 };

static void make_nodes(uint16_t node[NODES][4], const trial *t, test_rng *r)
{
    for (int i = 0; i < 4 * NODES; ++i) {
        node[i / 4][i % 4] = (uint16_t)(i % 4 == 3 ? 0u : t->seed % 3u == 0 ? 65535u : test_random(r) & 0xffffu);
    }
}

/* A weight of either sign, from the remaining total of weights; sometimes all of the rest. */
static uint32_t take_weight(uint32_t *left, test_rng *r)
{
    const uint32_t size = test_random(r) % 20u == 0 ? *left : test_random(r) % (*left / 8u + 1u);
    *left -= size;
    return (test_random(r) % 2u ? size : 0u - size) & 0xffffu;
}

static int64_t signed_weight(uint32_t code) { return (int64_t)(code & 0x7fffu) - (int64_t)(code & 0x8000u); }

/* Compares with sums of 64 bits, also for scalar. */
static int trial_transfer_links(const trial *t, test_rng r)
{
    static uint16_t node[NODES][4];
    uint32_t link[LINKS], left = 32767, count = t->seed % 2u ? test_random(&r) % 5u : test_random(&r) % LINKS;
    int64_t sum[3] = {0, 0, 0};
    int32_t want[3], scalar[3], got[3];
    make_nodes(node, t, &r);
    for (uint32_t i = 0; i < count; ++i) {
        link[i] = test_random(&r) % NODES | take_weight(&left, &r) << 16;
        for (int c = 0; c < 3; ++c) {
            sum[c] += signed_weight(link[i] >> 16) * node[link[i] & 0xffffu][c];
        }
    }
    for (int c = 0; c < 3; ++c) {
        want[c] = (int32_t)sum[c];
        CHECK(want[c] == sum[c]);
    }
    lmb_kernels_scalar.transfer_links(scalar, link, count, node);
    t->kernels->transfer_links(got, link, count, node);
    return same_bytes(t, "scalar's", want, scalar, sizeof want) && same_bytes(t, "sums", want, got, sizeof want);
}

static int trial_transfer_directed_links(const trial *t, test_rng r)
{
    static uint16_t node[NODES][4];
    uint32_t link[2 * LINKS], left[3] = {32767, 32767, 32767};
    uint32_t count = t->seed % 2u ? test_random(&r) % 5u : test_random(&r) % LINKS;
    int32_t want[3][3], scalar[3][3], got[3][3];
    make_nodes(node, t, &r);
    memset(want, 0, sizeof want);
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t x = take_weight(&left[0], &r), y = take_weight(&left[1], &r), z = take_weight(&left[2], &r);
        link[2 * i] = test_random(&r) % NODES | x << 16;
        link[2 * i + 1] = y | z << 16;
        for (int c = 0; c < 3; ++c) {
            want[0][c] += (int32_t)(signed_weight(x) * node[link[2 * i] & 0xffffu][c]);
            want[1][c] += (int32_t)(signed_weight(y) * node[link[2 * i] & 0xffffu][c]);
            want[2][c] += (int32_t)(signed_weight(z) * node[link[2 * i] & 0xffffu][c]);
        }
    }
    lmb_kernels_scalar.transfer_directed_links(scalar, link, count, node);
    t->kernels->transfer_directed_links(got, link, count, node);
    return same_bytes(t, "scalar's", want, scalar, sizeof want) && same_bytes(t, "sums", want, got, sizeof want);
}

static int trial_texel_powers(const trial *t, test_rng r)
{
    static float sx[PAST_RUN], want[PAST_RUN], got[PAST_RUN];
    const int32_t count = 1 + (int32_t)(test_random(&r) % RUN);
    lmb_texel_row row;
    memset(&row, 0, sizeof row);
    row.right = direction_of_axis(&r);
    row.up = direction_of_axis(&r);
    row.back = direction_of_axis(&r);
    row.direction = direction_of_axis(&r);
    row.cos_outer = test_uniform(&r, 0.0f, 1.0f);
    row.cone = test_random(&r) % 4u ? test_uniform(&r, 0.0f, 0.3f) : 0.0f;
    row.side_x = test_uniform(&r, 0.001f, 0.1f);
    row.side_y = test_uniform(&r, 0.001f, 0.1f);
    row.sy = test_uniform(&r, -1.5f, 1.5f);
    row.finer_x = test_uniform(&r, -1.0f, 1.0f);
    row.finer_half = test_random(&r) % 2u ? test_uniform(&r, 0.0f, 1.0f) : 0.0f;
    row.is_far = (int32_t)(t->seed % 2u);
    row.is_coned = (int32_t)(t->seed / 2u % 2u);
    numbers(sx, PAST_RUN, &r, -1.5f, 1.5f, 0);
    lmb_kernels_scalar.texel_powers(want, sx, count, &row);
    t->kernels->texel_powers(got, sx, count, &row);
    return same_floats(t, "power", want, got, count);
}

static void make_shown(lmb_transfer_shown *s, uint32_t id, test_rng *r, uint32_t rare)
{
    s->id = id;
    for (int k = 0; k < 3; ++k) {
        numbers(s->corner[k], 3, r, -2.0f, 2.0f, rare);
    }
    numbers(s->per, 3, r, 0.1f, 1.0f, rare);
    numbers(s->cosine, 3, r, -1.0f, 1.0f, 0);
    numbers(s->near, 3, r, -1.0f, 1.0f, rare);
}

static int trial_transfer_share(const trial *t, test_rng r)
{
    static float want[LMB_TRANSFER_SHARING][LMB_TRANSFER_BLOCK_CELLS];
    static float got[LMB_TRANSFER_SHARING][LMB_TRANSFER_BLOCK_CELLS];
    static lmb_transfer_shown shown[LMB_TRANSFER_SHARING];
    const int32_t count = 2 + (int32_t)(test_random(&r) % (LMB_TRANSFER_SHARING - 1u));
    const int32_t none = (int32_t)(test_random(&r) % (2u * LMB_TRANSFER_SHARING));
    const int32_t cells = 1 + (int32_t)(test_random(&r) % LMB_TRANSFER_CELLS);
    const float at[2] = {number(&r, 0.0f, 4.0f, 0), number(&r, 0.0f, 4.0f, 0)};
    for (int32_t i = 0; i < count; ++i) {
        make_shown(&shown[i], i == none ? 0 : (uint32_t)i + 1, &r, t->seed % 3u ? 0 : 25u);
    }
    lmb_kernels_scalar.transfer_share(want, shown, count, at, cells);
    t->kernels->transfer_share(got, shown, count, at, cells);
    for (int32_t k = 0; k < cells * cells; ++k) {
        const int32_t at_cell = k / cells * LMB_TRANSFER_CELLS + k % cells;
        float all = 0.0f;
        for (int32_t i = 0; i < count; ++i) {
            all += got[i][at_cell];
            CHECK(same_floats(t, "shares", &want[i][at_cell], &got[i][at_cell], 1));
        }
        CHECK_MSG(t->seed % 3u == 0 || absf(all - 1.0f) < 1e-5f, "shares of a cell: %g in all", (double)all);
    }
    return 1;
}

static int trial_transfer_halve(const trial *t, test_rng r)
{
    static float light[LMB_TILE_PIXELS], want[2][LMB_TILE_PIXELS], got[2][LMB_TILE_PIXELS];
    const uint32_t rows = test_random(&r) % 256u;
    float line[3];
    numbers(line, 3, &r, -1.0f, 1.0f, t->seed % 3u ? 0 : 9u);
    line[0] *= 4.0f;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        light[k] = test_random(&r) % 4u ? (float)(test_random(&r) % 16777217u) : 0.0f;
    }
    memcpy(want[1], light, sizeof light);
    memcpy(got[1], light, sizeof light);
    const uint32_t a = lmb_kernels_scalar.transfer_halve(want[0], want[1], line, rows),
                   b = t->kernels->transfer_halve(got[0], got[1], line, rows);
    CHECK(a == b);
    uint32_t has = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int y = k / LMB_TILE;
        if ((rows >> y & 1u) != 0) {
            CHECK(got[0][k] + got[1][k] == light[k] && got[0][k] >= 0.0f && got[1][k] >= 0.0f);
            CHECK(same_floats(t, "first half", &want[0][k], &got[0][k], 1));
            CHECK(same_floats(t, "second half", &want[1][k], &got[1][k], 1));
            has |= (got[0][k] > 0.0f ? 1u : 0u) << y | (got[1][k] > 0.0f ? 1u : 0u) << (LMB_TILE + y);
        }
    }
    CHECK(b == has);
    return 1;
}

/* Compares b1 and b2 at the given pixels. */
static int same_weights(const trial *t, uint64_t pixels, float want[2][LMB_TILE_PIXELS],
                        float got[2][LMB_TILE_PIXELS])
{
    for (int k = 0; k < 2 * LMB_TILE_PIXELS; ++k) {
        const int i = k / LMB_TILE_PIXELS, p = k % LMB_TILE_PIXELS;
        if ((pixels >> p & 1u) != 0 && !same_floats(t, i ? "b2" : "b1", &want[i][p], &got[i][p], 1)) {
            return 0;
        }
    }
    return 1;
}

static int trial_transfer_side(const trial *t, test_rng r)
{
    static lmb_tile tile;
    static float want[2][LMB_TILE_PIXELS], got[2][LMB_TILE_PIXELS];
    const uint32_t rare = t->seed % 3u ? 0 : 25u;
    const uint64_t left = random_pixels(t, &r) | (uint64_t)1 << test_random(&r) % LMB_TILE_PIXELS;
    lmb_transfer_triangle triangle;
    memset(&triangle, 0, sizeof triangle);
    triangle.corner = place(&r, 2.0f, rare);
    triangle.along[0] = place(&r, 1.0f, rare);
    triangle.along[1] = place(&r, 1.0f, rare);
    make_tile(&tile, &r, rare);
    const uint64_t a = lmb_kernels_scalar.transfer_side(want, &tile, left, &triangle),
                   b = t->kernels->transfer_side(got, &tile, left, &triangle);
    CHECK((a & ~left) == 0 && (a & (left & (0 - left))) != 0);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        CHECK((a >> k & 1u) == 0 || tile.id[k] == tile.id[lowest_bit_64(left)]);
        CHECK((a >> k & 1u) == 0 || (want[0][k] >= 0.0f && want[1][k] >= 0.0f && want[0][k] + want[1][k] < 1.0001f));
    }
    return same_bytes(t, "pixels", &a, &b, sizeof a) && same_weights(t, a, want, got);
}

static int trial_transfer_leaf(const trial *t, test_rng r)
{
    static GUARDED(lmb_irradiance) want, got;
    static GUARDED(lmb_glossy) want_lobes, got_lobes;
    static lmb_tile tile;
    static float weight[2][LMB_TILE_PIXELS];
    const uint32_t rare = t->seed % 3u ? 0 : 25u;
    const uint64_t left = random_pixels(t, &r) | (uint64_t)1 << test_random(&r) % LMB_TILE_PIXELS;
    lmb_transfer_leaf leaf;
    float by[3][3];
    GUARD(want);
    GUARD(got);
    GUARD(want_lobes);
    GUARD(got_lobes);
    numbers(want.it.rgb[0], 3 * LMB_TILE_PIXELS, &r, 0.0f, 9.0f, 0);
    got.it = want.it;
    make_tile(&tile, &r, rare);
    numbers(weight[0], 2 * LMB_TILE_PIXELS, &r, 0.0f, 0.5f, 0);
    numbers(leaf.corner[0], 27, &r, -0.5f, 3.0f, rare);
    for (int i = 0; i < 9; ++i) {
        by[i / 3][i % 3] = (float)((int32_t)(test_random(&r) % 7u) - (i / 3 ? 3 : 2));
    }
    leaf.weight = (const float(*)[3])by;
    leaf.is_directed = (int32_t)(test_random(&r) % 2u);
    make_glossy(&want_lobes.it, t, &r, rare);
    const lmb_glossy before = got_lobes.it = want_lobes.it;
    const int has_lobes = test_random(&r) % 4u != 0;
    const uint64_t a = lmb_kernels_scalar.transfer_leaf(&want.it, has_lobes ? &want_lobes.it : NULL, weight, &tile,
                                                        left, &leaf),
                   b = t->kernels->transfer_leaf(&got.it, has_lobes ? &got_lobes.it : NULL, weight, &tile, left, &leaf);
    CHECK((a & ~left) == 0 && (a & (left & (0 - left))) != 0 && canaries_stay(got.before, got.after) &&
          canaries_stay(got_lobes.before, got_lobes.after));
    return same_bytes(t, "pixels", &a, &b, sizeof a) &&
           same_glossy(t, &want_lobes.it, &got_lobes.it, &before, a & before.pixels) &&
           same_floats(t, "rgb", want.it.rgb[0], got.it.rgb[0], 3 * LMB_TILE_PIXELS);
}

/* --- all kernels -------------------------------------------------------------------------------------------------- */

static const struct kernel {
    const char *name;
    int (*run)(const trial *t, test_rng r);
} kernels[] = {
    {"resolve_shown", trial_resolve_shown},
    {"resolve_slots", trial_resolve_slots},
    {"resolve_setup", trial_resolve_setup},
    {"resolve", trial_resolve},
    {"texture", trial_texture},
    {"direct", trial_direct},
    {"gather", trial_gather},
    {"gather_near", trial_gather_near},
    {"gather_cut", trial_gather_cut},
    {"weigh", trial_node_bounds},
    {"gloss_direct", trial_glossy_direct},
    {"gloss_cut", trial_glossy_cut},
    {"crossed", trial_crossed},
    {"segments", trial_segments},
    {"through", trial_through},
    {"meets", trial_meets},
    {"meets_one", trial_meets_one},
    {"sun_crossed", trial_sun_crossed},
    {"sun_meets", trial_sun_meets},
    {"many_bounds", trial_many_lights_bounds},
    {"many_shine", trial_many_lights_irradiance},
    {"blend", trial_blend},
    {"encode", trial_encode},
    {"remap", trial_remap},
    {"see", trial_see},
    {"share", trial_share},
    {"cosine", trial_cosine},
    {"blur", trial_blur},
    {"cone", trial_cone},
    {"relief", trial_relief},
    {"links", trial_transfer_links},
    {"directed_links", trial_transfer_directed_links},
    {"texel_powers", trial_texel_powers},
    {"transfer_share", trial_transfer_share},
    {"transfer_halve", trial_transfer_halve},
    {"transfer_side", trial_transfer_side},
    {"transfer_leaf", trial_transfer_leaf},
};

static void test_backend(const lmb_kernels *backend)
{
    const seed_range range = seeds(ROUNDS);
    volatile float one_and_bit = 1.000244140625f;
    CHECK_MSG(backend->probe(one_and_bit) == 0.0f, "%s is compiled with fused multiply-adds", backend->name);
    CHECK(lmb_kernels_named(backend->name) == backend && LMB_TILE_PIXELS % backend->lanes == 0);
    for (size_t i = 0; i < sizeof kernels / sizeof *kernels; ++i) {
        int equal = 1;
        for (uint32_t k = 0; k < range.count && equal; ++k) {
            const trial t = {backend, kernels[i].name, range.first + k};
            equal = kernels[i].run(&t, seed_rng(t.seed));
            CHECK_MSG(equal, "%s of %s", kernels[i].name, backend->name);
        }
    }
}

void test_kernels(void)
{
    const lmb_kernels *backend;
    for (int32_t i = 0; (backend = lmb_kernels_at(i)) != NULL; ++i) {
        test_backend(backend);
    }
    CHECK(lmb_kernels_pick() == lmb_kernels_at(0) && lmb_kernels_at(-1) == NULL);
    CHECK(lmb_kernels_named(NULL) == NULL && lmb_kernels_named("") == NULL && lmb_kernels_named("scalar2") == NULL);
    CHECK(lmb_kernels_named("scalar") == &lmb_kernels_scalar);
    CHECK(lmb_build_check() == LMB_OK);
}
