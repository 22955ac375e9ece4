/* relight_export.c: lobes by roughness, harmonics, a table of lobes and direction maps, for other programs. */
#include "relight_export.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <lambent/relight.h>

#include "../../platform/host/pool.h"
#include "../common/frame_name.h"
#include "../common/fvec.h"
#include "../common/progress.h"
#include "../common/text_buffer.h"
#include "../picture/picture.h"

#define PI   3.14159265f
#define WIDE 0.3f /* roughness: lobes wider than 8 pixels of the map, 3 degrees each */
#define MAX_PIXEL_RAD 0.5f /* between neighbours of a transform image; more is a jump */

enum { LEVELS = 6, LEAST_SIDE = 8, DFG_SIDE = 128, DFG_SAMPLES = 512, HARMONICS = 9, FINE_RAYS = 3 };

/* --- lobes -------------------------------------------------------------------------------------------------------- */

/* One cube of a wide lobe: each texel sums over the whole map. */
typedef struct wide_lobe {
    const float *map;
    const lmb_probe_table *table;
    float *planes;
    float a2;
    int32_t side;
} wide_lobe;

static lmb_vec3 texel_direction(int32_t n, int32_t i)
{
    const float s = (float)(2 * (i % n) + 1) / (float)n - 1.0f, t = (float)(2 * (i / n % n) + 1) / (float)n - 1.0f;
    const lmb_vec3 to[6] = {{1, -t, -s}, {-1, -t, s}, {s, 1, t}, {s, -1, -t}, {s, -t, 1}, {-s, -t, -1}},
                   d = to[i / (n * n)];
    const float per = 1.0f / sqrtf(d.x * d.x + d.y * d.y + d.z * d.z);
    return (lmb_vec3){d.x * per, d.y * per, d.z * per};
}

/* The lobe seen along the normal: GGX with Smith masking at the half vector. */
static float lobe_weight(float cosine, float a2)
{
    const float d = 0.5f * (1.0f + cosine) * (a2 - 1.0f) + 1.0f;
    return cosine / (d * d * (cosine + sqrtf(cosine * cosine * (1.0f - a2) + a2)));
}

static void wide_job(void *user, int row, int thread)
{
    const wide_lobe *l = user;
    const lmb_probe_table *t = l->table;
    const size_t count = (size_t)t->width * (size_t)t->height, texels = 6 * (size_t)l->side * (size_t)l->side;
    (void)thread;
    for (int32_t i = row * l->side; i < (row + 1) * l->side; ++i) {
        const lmb_vec3 n = texel_direction(l->side, i);
        float all = 1e-30f, sum[3] = {0.0f, 0.0f, 0.0f};
        for (size_t k = 0; k < count; ++k) {
            const float step = 2.0f / 65535.0f;
            const float cosine = n.x * ((float)t->direction[k] * step - 1.0f) +
                                 n.y * ((float)t->direction[count + k] * step - 1.0f) +
                                 n.z * ((float)t->direction[2 * count + k] * step - 1.0f);
            if (cosine > 0.0f) {
                const float weight = lobe_weight(cosine, l->a2) * t->area[k / (size_t)t->width];
                all += weight;
                sum[0] += weight * l->map[k];
                sum[1] += weight * l->map[count + k];
                sum[2] += weight * l->map[2 * count + k];
            }
        }
        for (size_t c = 0; c < 3; ++c) {
            l->planes[c * texels + (size_t)i] = sum[c] / all;
        }
    }
}

/* Narrow lobes are sampled with a few rays; with these, wide lobes would miss lamps. */
static int see_lobe(float *planes, relight_light *w, const relight_options *o, lmb_vec3 at, lmb_probe_rays *rays,
                    float roughness, int32_t side)
{
    if (roughness < WIDE) {
        return relight_light_reflect(w, o, planes, side, rays, at, roughness);
    }
    wide_lobe l = {w->map, &w->table[0], planes, roughness * roughness * roughness * roughness, side};
    if (!relight_light_see(w, o, at)) {
        return 0;
    }
    pool_run(pool_threads(o->threads), 6 * side, wide_job, &l);
    return 1;
}

/* Writes one cube for each of LEVELS roughness values from 0 to 1; each cube has half the side of the previous one. */
static int write_lobes(relight_light *w, const relight_options *o, lmb_vec3 at, report *r)
{
    float *planes = malloc(18 * (size_t)o->side * (size_t)o->side * sizeof *planes);
    lmb_probe_rays *rays = malloc(sizeof *rays);
    int ok = planes != NULL && rays != NULL;
    ok = ok || report_fail(r, "%s: out of memory", o->lobes);
    for (int32_t i = 0; ok && i < LEVELS; ++i) {
        const int32_t side = o->side >> i > LEAST_SIDE ? o->side >> i : LEAST_SIDE;
        const float roughness = (float)i / (LEVELS - 1);
        char name[4096];
        progress_tell("lobes", (double)i / LEVELS);
        ok = (see_lobe(planes, w, o, at, rays, roughness, side) || report_fail(r, "--at: numbers over 1,000,000 m")) &&
             frame_numbered(name, sizeof name, o->lobes, i, r) && relight_write_planes(name, planes, side, 6 * side, r);
        if (ok && !o->view.is_quiet) {
            report_say("%s  roughness %.1f, %d x %d a face\n", name, (double)roughness, (int)side, (int)side);
        }
    }
    free(planes);
    free(rays);
    return ok && report_flush(r);
}

/* --- harmonics ---------------------------------------------------------------------------------------------------- */

/* In the order of most programs: 1; y, z, x; xy, yz, 3 z2 - 1, xz, x2 - y2. */
static void basis(float out[HARMONICS], float x, float y, float z)
{
    const float b[HARMONICS] = {0.282094792f,
                                0.488602512f * y,
                                0.488602512f * z,
                                0.488602512f * x,
                                1.092548431f * x * y,
                                1.092548431f * y * z,
                                0.315391565f * (3.0f * z * z - 1.0f),
                                1.092548431f * x * z,
                                0.546274215f * (x * x - y * y)};
    memcpy(out, b, sizeof b);
}

static void project(double out[HARMONICS][3], const float *map, const lmb_probe_table *t)
{
    const size_t count = (size_t)t->width * (size_t)t->height;
    memset(out, 0, HARMONICS * sizeof *out);
    for (size_t i = 0; i < count; ++i) {
        float d[3], b[HARMONICS];
        for (size_t c = 0; c < 3; ++c) {
            d[c] = (float)t->direction[c * count + i] * (2.0f / 65535.0f) - 1.0f;
        }
        basis(b, d[0], d[1], d[2]);
        for (int k = 0; k < HARMONICS; ++k) {
            for (size_t c = 0; c < 3; ++c) {
                out[k][c] += (double)(b[k] * map[c * count + i] * t->area[i / (size_t)t->width]);
            }
        }
    }
}

static void add_list(text_buffer *b, const char *name, double (*sum)[3], const double by[3])
{
    text_buffer_add(b, "  \"%s\": [", name);
    for (int k = 0; k < HARMONICS; ++k) {
        const double times = by[k == 0 ? 0 : k < 4 ? 1 : 2];
        text_buffer_add(b, "%s\n    [%.7g, %.7g, %.7g]", k > 0 ? "," : "", sum[k][0] * times, sum[k][1] * times,
                        sum[k][2] * times);
    }
    text_buffer_plain(b, "\n  ]");
}

/* Writes radiance, as a LightProbe of three.js, and irradiance, which is the sum over the same functions of a
 * normal. */
static int write_harmonics(const relight_light *w, const relight_options *o, report *r)
{
    static const double one[3] = {1.0, 1.0, 1.0},
                        cosine[3] = {3.141592653589793, 2.094395102393195, 0.7853981633974483};
    double sum[HARMONICS][3];
    text_buffer b;
    memset(&b, 0, sizeof b);
    project(sum, w->map, &w->table[0]);
    text_buffer_plain(
        &b, "{\n  \"functions\": [\"0.282095\", \"0.488603 y\", \"0.488603 z\", \"0.488603 x\", \"1.092548 x y\", "
            "\"1.092548 y z\", \"0.315392 (3 z^2 - 1)\", \"1.092548 x z\", \"0.546274 (x^2 - y^2)\"],\n");
    add_list(&b, "radiance", sum, one);
    text_buffer_plain(&b, ",\n");
    add_list(&b, "irradiance", sum, cosine);
    text_buffer_plain(&b, "\n}\n");
    const int ok = text_buffer_write(&b, o->harmonics, r);
    text_buffer_free(&b);
    return ok;
}

/* --- a table of lobes --------------------------------------------------------------------------------------------- */

static float reversed(uint32_t i)
{
    uint32_t v = 0;
    for (int k = 0; k < 32; ++k, i >>= 1) {
        v = v << 1 | (i & 1);
    }
    return (float)v * 2.3283064e-10f;
}

/* Samples a half vector from the visible normals (Heitz 2018). x points towards the viewer. */
static lmb_vec3 half_vector(float facing, float alpha, float u, float turn)
{
    const float wide = alpha * sqrtf(fmaxf(1.0f - facing * facing, 0.0f)),
                per = 1.0f / sqrtf(wide * wide + facing * facing);
    const float x = wide * per, z = facing * per, radius = sqrtf(u), a = radius * lmb_cos(turn), up = 0.5f * (1.0f + z);
    const float round = sqrtf(fmaxf(1.0f - a * a, 0.0f)), b = (1.0f - up) * round + up * radius * lmb_sin(turn);
    const float c = sqrtf(fmaxf(1.0f - a * a - b * b, 0.0f));
    const lmb_vec3 n = {alpha * (c * x - b * z), alpha * a, fmaxf(c * z + b * x, 0.0f)};
    const float length = 1.0f / sqrtf(n.x * n.x + n.y * n.y + n.z * n.z);
    return (lmb_vec3){n.x * length, n.y * length, n.z * length};
}

/* GGX with height-correlated Smith: the reflected share of uniform white light is F0 out[0] + out[1]. Other programs
 * have no LMB_MIN_ALPHA, so the smoothest rows are those of a mirror. */
static void reflect_white(float out[2], float facing, float roughness)
{
    const float alpha = fmaxf(roughness * roughness, 1e-6f), a2 = alpha * alpha;
    const float side = sqrtf(fmaxf(1.0f - facing * facing, 0.0f)), seen = sqrtf(facing * facing * (1.0f - a2) + a2);
    double scale = 0.0, bias = 0.0;
    for (uint32_t i = 0; i < DFG_SAMPLES; ++i) {
        const lmb_vec3 h = half_vector(facing, alpha, ((float)i + 0.5f) / DFG_SAMPLES, 2.0f * PI * reversed(i));
        const float vh = side * h.x + facing * h.z, nl = 2.0f * vh * h.z - facing;
        if (nl > 0.0f && vh > 0.0f) {
            const float all = nl * (facing + seen) / (nl * seen + facing * sqrtf(nl * nl * (1.0f - a2) + a2));
            const float by = 1.0f - vh, fresnel = by * by * by * by * by;
            scale += (double)(all * (1.0f - fresnel));
            bias += (double)(all * fresnel);
        }
    }
    out[0] = (float)(scale / DFG_SAMPLES);
    out[1] = (float)(bias / DFG_SAMPLES);
}

static int write_dfg(const relight_options *o, report *r)
{
    enum { TEXELS = DFG_SIDE * DFG_SIDE };
    float *planes = calloc(3 * TEXELS, sizeof *planes);
    if (planes == NULL) {
        return report_fail(r, "%s: out of memory", o->dfg);
    }
    for (int32_t i = 0; i < TEXELS; ++i) {
        float both[2];
        reflect_white(both, ((float)(i % DFG_SIDE) + 0.5f) / DFG_SIDE, ((float)(i / DFG_SIDE) + 0.5f) / DFG_SIDE);
        planes[i] = both[0];
        planes[TEXELS + i] = both[1];
    }
    const int ok = relight_write_planes(o->dfg, planes, DFG_SIDE, DFG_SIDE, r);
    free(planes);
    return ok;
}

/* --- maps of directions ------------------------------------------------------------------------------------------- */

/* A table of any height and start, or with the directions of a picture. */
typedef struct own_table {
    lmb_probe_table table;
    void *memory;
    float *map, *one;
} own_table;

static void own_table_free(own_table *t)
{
    free(t->memory);
    free(t->map);
    free(t->one);
}

static int make_table(own_table *t, int32_t height, float start, report *r)
{
    const size_t bytes = lmb_probe_table_bytes(2 * height, height), pixels = 2 * (size_t)height * (size_t)height;
    t->memory = malloc(bytes + 1);
    t->map = malloc(3 * pixels * sizeof *t->map);
    t->one = malloc(3 * pixels * sizeof *t->one);
    return (t->memory != NULL && t->map != NULL && t->one != NULL &&
            lmb_probe_table_init(&t->table, 2 * height, height, start, t->memory, bytes) == LMB_OK) ||
           report_fail(r, "--map: out of memory");
}

/* Sets the directions of the map's pixels to a picture's vectors, of any length but 0. */
static int take_vectors(lmb_probe_table *t, const image *from, const char *path, report *r)
{
    const size_t count = (size_t)t->width * (size_t)t->height;
    for (size_t i = 0; i < count; ++i) {
        const float *v = from->pixels + 3 * i, length = sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        if (!(length > 1e-12f && length < 1e12f)) {
            return report_fail(r, "%s: pixel %u,%u is no direction", path, (unsigned)(i % (size_t)t->width),
                               (unsigned)(i / (size_t)t->width));
        }
        const float per = fabsf(length - 1.0f) > 1e-4f ? 1.0f / length : 1.0f; /* keeps unit codes that were saved */
        for (size_t c = 0; c < 3; ++c) {
            t->direction[c * count + i] = (uint16_t)fminf(fmaxf(v[c] * per, -1.0f) * 32767.5f + 32768.0f, 65535.0f);
        }
    }
    return 1;
}

/* The longitude of a transform image's left edge, by its first pixel at the horizon, to a hundredth of a degree: lights
 * that are summed apart are added by longitude and latitude. */
static float left_edge(const image *from)
{
    const float *v = from->pixels + 3 * (size_t)from->width * (size_t)(from->height / 2);
    const float edge = roundf(100.0f * (atan2f(v[0], -v[2]) * 57.2957795f - 180.0f / (float)from->width));
    return isfinite(edge) ? 0.01f * (edge < -18000.0f ? edge + 36000.0f : edge) : -180.0f;
}

static int load_table(own_table *t, const relight_options *o, report *r)
{
    image vectors;
    if (o->vectors_in == NULL) {
        return make_table(t, o->map_height, o->azimuth, r);
    }
    file_bytes file;
    if (!file_read(&file, o->vectors_in, r)) {
        return 0;
    }
    const int is_read = pfm_decode(&vectors, file.data, file.size, o->vectors_in, r);
    file_free(&file);
    if (!is_read) {
        return 0;
    }
    int ok = (vectors.channels == 3 && lmb_probe_table_bytes(vectors.width, vectors.height) > 0) ||
             report_fail(r, "%s: no transform image: it has 3 channels, and is 8 .. 512 high, by 8, and twice as wide",
                         o->vectors_in);
    ok = ok && make_table(t, vectors.height, left_edge(&vectors), r) &&
         take_vectors(&t->table, &vectors, o->vectors_in, r);
    image_free(&vectors);
    return ok;
}

static int save_vectors(own_table *t, const relight_options *o, report *r)
{
    const size_t numbers = 3 * (size_t)t->table.width * (size_t)t->table.height;
    for (size_t i = 0; i < numbers; ++i) {
        t->map[i] = (float)t->table.direction[i] * (2.0f / 65535.0f) - 1.0f;
    }
    return relight_write_planes(o->vectors_out, t->map, t->table.width, t->table.height, r);
}

static lmb_vec3 pixel_direction(const lmb_probe_table *t, int32_t x, int32_t y)
{
    const float step = 2.0f / 65535.0f;
    const size_t count = (size_t)t->width * (size_t)t->height, i = (size_t)y * (size_t)t->width + (size_t)x;
    return vec3((float)t->direction[i] * step - 1.0f, (float)t->direction[count + i] * step - 1.0f,
                (float)t->direction[2 * count + i] * step - 1.0f);
}

/* The change of direction over one of `pixels` between two of them. None at a jump, as between faces of a cube in a
 * transform image. */
static lmb_vec3 change_between(lmb_vec3 from, lmb_vec3 to, int32_t pixels)
{
    const lmb_vec3 d = mul3(sub3(to, from), 1.0f / (float)pixels);
    return dot3(d, d) < MAX_PIXEL_RAD * MAX_PIXEL_RAD ? d : vec3(0.0f, 0.0f, 0.0f);
}

/* Ray `part` of FINE_RAYS x FINE_RAYS in a pixel of the map. */
static lmb_vec3 ray_in_pixel(const lmb_probe_table *t, size_t pixel, int part)
{
    const int32_t x = (int32_t)(pixel % (size_t)t->width), y = (int32_t)(pixel / (size_t)t->width);
    const int32_t top = y > 0 ? y - 1 : y, low = y + 1 < t->height ? y + 1 : y;
    const lmb_vec3 across = change_between(pixel_direction(t, (x + t->width - 1) % t->width, y),
                                           pixel_direction(t, (x + 1) % t->width, y), 2),
                   down = change_between(pixel_direction(t, x, top), pixel_direction(t, x, low), low - top);
    const float u = ((float)(part % FINE_RAYS) + 0.5f) / FINE_RAYS - 0.5f,
                v = ((float)(part / FINE_RAYS) + 0.5f) / FINE_RAYS - 0.5f;
    return normalize3(add3(pixel_direction(t, x, y), add3(mul3(across, u), mul3(down, v))));
}

/* Sets 64 pixels of the map to the mean of their rays through a cube. Returns 1, or 0 if the kernel refuses. */
static int see_pixels(own_table *t, lmb_relight_scratch *s, const lmb_kernels *kernels, const lmb_probe_cube *cube,
                      size_t first)
{
    const size_t count = (size_t)t->table.width * (size_t)t->table.height;
    int ok = 1;
    memset(&s->light, 0, sizeof s->light);
    for (int part = 0; ok && part < FINE_RAYS * FINE_RAYS; ++part) {
        for (size_t i = 0; i < LMB_TILE_PIXELS; ++i) {
            const lmb_vec3 d = ray_in_pixel(&t->table, first + i, part);
            s->tile.normal[0][i] = d.x;
            s->tile.normal[1][i] = d.y;
            s->tile.normal[2][i] = d.z;
        }
        ok = lmb_probe_light_tile(&s->light, kernels, &s->rays, &s->tile, ~(uint64_t)0, cube) == LMB_OK;
    }
    for (size_t i = 0; i < 3 * LMB_TILE_PIXELS; ++i) {
        t->map[i / LMB_TILE_PIXELS * count + first + i % LMB_TILE_PIXELS] =
            s->light.rgb[i / LMB_TILE_PIXELS][i % LMB_TILE_PIXELS] * (1.0f / (FINE_RAYS * FINE_RAYS));
    }
    return ok;
}

/* Renders a map finer than the gathered one from a cube of the world. The cube's texels are not finer than the world's,
 * which would add light to small lamps. */
static int see_fine(own_table *t, relight_light *w, const relight_options *o, lmb_vec3 at, report *r)
{
    const int32_t own = o->place.face_size, fine = t->table.height > 128 ? 256 : 128;
    const int32_t n = o->worlds > 1 ? RELIGHT_MAX_FACES : own > fine ? fine : own < LEAST_SIDE ? LEAST_SIDE : own;
    const size_t bytes = lmb_probe_cube_bytes(n), count = (size_t)t->table.width * (size_t)t->table.height;
    float *planes = malloc(18 * (size_t)n * (size_t)n * sizeof *planes);
    void *texels = malloc(bytes);
    lmb_relight_scratch *s = calloc(1, sizeof *s);
    lmb_probe_cube cube;
    int ok = (planes != NULL && texels != NULL && s != NULL) || report_fail(r, "%s: out of memory", o->map);
    ok = ok && (relight_light_reflect(w, o, planes, n, &s->rays, at, 0.0f) ||
                report_fail(r, "--at: numbers over 1,000,000 m"));
    ok = ok && lmb_probe_cube_init(&cube, planes, n, texels, bytes) == LMB_OK;
    for (size_t first = 0; ok && first < count; first += LMB_TILE_PIXELS) {
        ok = see_pixels(t, s, o->kernels, &cube, first);
    }
    free(planes);
    free(texels);
    free(s);
    return ok;
}

static int see_map(own_table *t, relight_light *w, const relight_options *o, lmb_vec3 at, report *r)
{
    if (t->table.height > RELIGHT_HEIGHT) {
        return see_fine(t, w, o, at, r);
    }
    return relight_light_map(t->map, t->one, &t->table, w, o, at) || report_fail(r, "--at: numbers over 1,000,000 m");
}

static int write_maps(relight_light *w, const relight_options *o, lmb_vec3 at, report *r)
{
    own_table t;
    memset(&t, 0, sizeof t);
    int ok = load_table(&t, o, r) && (o->vectors_out == NULL || save_vectors(&t, o, r));
    if (ok && o->map != NULL) {
        ok = see_map(&t, w, o, at, r) && relight_write_planes(o->map, t.map, t.table.width, t.table.height, r);
    }
    own_table_free(&t);
    return ok;
}

/* --- all of it ---------------------------------------------------------------------------------------------------- */

int relight_exports(const relight_options *o)
{
    return o->map != NULL || o->vectors_out != NULL || o->lobes != NULL || o->harmonics != NULL || o->dfg != NULL;
}

int relight_export_check(const relight_options *o, report *r)
{
    if (o->vectors_out != NULL && picture_format(o->vectors_out) != PICTURE_PFM) {
        return report_fail(r, "--save-vectors: directions have signs: give it a .pfm");
    }
    if (o->vectors_in != NULL && (o->map_height != RELIGHT_HEIGHT || o->azimuth != -180.0f)) {
        return report_fail(r, "--vectors has the map's size and directions: leave out --map-height and --azimuth");
    }
    if (o->worlds > 1 && o->side > RELIGHT_MAX_FACES && o->lobes != NULL) {
        return report_fail(r, "--lobes of several worlds have at most 64 texels a side: give --side 64");
    }
    return 1;
}

int relight_export(relight_light *w, const relight_options *o, lmb_vec3 at, report *r)
{
    if ((o->map != NULL || o->vectors_out != NULL) && !write_maps(w, o, at, r)) {
        return 0;
    }
    if (o->harmonics != NULL && !((relight_light_see(w, o, at) || report_fail(r, "--at: numbers over 1,000,000 m")) &&
                                  write_harmonics(w, o, r))) {
        return 0;
    }
    return (o->lobes == NULL || write_lobes(w, o, at, r)) && (o->dfg == NULL || write_dfg(o, r));
}
