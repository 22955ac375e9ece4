/* relight_stage.c: worlds, filters, errors and times of the relight figures. */
#include "relight_stage.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "../../src/base/vec.h"
#include "../../tools/picture/picture_read.h"
#include "../../tools/picture/world_read.h"
#include "../truth_scene.h"

const char *const filter_names[FILTERS] = {"cosine", "sh9", "sh16", "sh25", "blur", "blur1", "blur2"};
const lmb_vec3 relight_places[PLACES] = {{10, 1, -15}, {-20, 0.5f, 5}, {30, 3, 10}, {5, 0.3f, -35}, {-45, 6, -30}};
const char *const sky_names[SKIES] = {"venice_sunset_1024x512", "forest_slope_512x256", "potsdamer_platz_512x256",
                                      "studio_small_03_512x256", "dikhololo_night_512x256"};

static void *take(size_t bytes)
{
    void *p = calloc(1, bytes);
    if (p == NULL) {
        printf("not enough memory\n");
        exit(1);
    }
    return p;
}

void relight_stage_make(relight_stage *s)
{
    s->kernels = lmb_kernels_pick();
    for (int i = 0; i < 3; ++i) {
        const size_t bytes = lmb_probe_table_bytes(WIDTH >> i, HEIGHT >> i);
        s->table_memory[i] = take(bytes);
        CHECK(lmb_probe_table_init(&s->table[i], WIDTH >> i, HEIGHT >> i, -180.0f, s->table_memory[i], bytes) ==
              LMB_OK);
    }
    for (int32_t terms = 0; terms <= 2; ++terms) {
        const size_t bytes = lmb_probe_blur_bytes(&s->table[2], terms);
        s->blur_memory[terms] = take(bytes);
        CHECK(lmb_probe_blur_init(&s->blur[terms], &s->table[2], terms, s->blur_memory[terms], bytes) == LMB_OK);
    }
}

void relight_stage_free(relight_stage *s)
{
    for (int i = 0; i < 3; ++i) {
        free(s->table_memory[i]);
        free(s->blur_memory[i]);
    }
    free(s->world_memory);
    free(s->ground);
}

/* --- worlds ------------------------------------------------------------------------------------------------------- */

void relight_set_world(relight_stage *s, const lmb_world_pictures *pictures, int32_t format)
{
    const size_t bytes = lmb_world_bytes(pictures, format);
    free(s->world_memory);
    s->world_memory = take(bytes);
    CHECK(lmb_world_init(&s->world, pictures, format, s->world_memory, bytes) == LMB_OK);
}

/* Six faces, stacked vertically. */
static void take_faces(lmb_world_pictures *p, const image *cube)
{
    p->face_size = cube->width;
    for (int i = 0; i < 6; ++i) {
        p->face[i] = cube->pixels + 3 * (size_t)i * (size_t)cube->width * (size_t)cube->width;
    }
}

static void take_ground(relight_stage *s, lmb_world_pictures *p, const image *ground)
{
    const size_t pixels = (size_t)ground->width * (size_t)ground->height;
    free(s->ground);
    s->ground = take(4 * pixels * sizeof *s->ground);
    for (size_t i = 0; i < pixels; ++i) {
        memcpy(s->ground + 4 * i, ground->pixels + 3 * i, 3 * sizeof *s->ground);
        s->ground[4 * i + 3] = 1.0f;
    }
    p->ground = s->ground;
    p->ground_width = ground->width;
    p->ground_height = ground->height;
    p->ground_x = p->ground_z = -100.0f;
    p->ground_width_m = p->ground_depth_m = 200.0f;
}

int relight_take_centre(relight_stage *s)
{
    image cube = {0}, ground = {0};
    lmb_world_pictures p;
    memset(&p, 0, sizeof p);
    p.centre.y = 1.5f;
    p.radius = 150.0f;
    const int ok = truth_picture(&cube, "env_relight", "centre_radiance.pfm") &&
                   truth_picture(&ground, "env_relight", "ground.pfm");
    if (ok) {
        take_faces(&p, &cube);
        take_ground(s, &p, &ground);
        relight_set_world(s, &p, LMB_WORLD_F32);
    }
    image_free(&cube);
    image_free(&ground);
    return ok;
}

int relight_take_place(relight_stage *s, int place)
{
    image cube = {0};
    char file[40];
    lmb_world_pictures p;
    memset(&p, 0, sizeof p);
    p.radius = 1.0f;
    snprintf(file, sizeof file, "pos%d_radiance.pfm", place + 1);
    const int ok = truth_picture(&cube, "env_relight", file);
    if (ok) {
        take_faces(&p, &cube);
        relight_set_world(s, &p, LMB_WORLD_F32);
    }
    image_free(&cube);
    return ok;
}

/* --- outdoor maps ------------------------------------------------------------------------------------------------- */

static int read_picture(image *out, const char *path, report *r)
{
    file_bytes bytes;
    stored_picture p;
    int ok = file_read(&bytes, path, r);
    if (ok) {
        ok = picture_read(&p, bytes.data, bytes.size, path, r);
        file_free(&bytes);
    }
    if (ok) {
        *out = p.light; /* Radiance files store light */
    }
    return ok;
}

int relight_sky_load(relight_sky *sky, int which)
{
    char path[SHARED_PATH], name[80];
    world_pictures own;
    report r = {""};
    memset(sky, 0, sizeof *sky);
    memset(&own, 0, sizeof own);
    snprintf(name, sizeof name, "data/env/%s.hdr", sky_names[which]);
    if (!shared_file(path, name)) {
        return 0;
    }
    const int ok = read_picture(&sky->picture, path, &r) && world_read_cube(&sky->pictures, &own, path, &r);
    CHECK_MSG(ok, "%s", r.text);
    memcpy(sky->face, own.face, sizeof sky->face);
    sky->pictures.radius = 1.0f;
    return ok;
}

void relight_sky_free(relight_sky *sky)
{
    image_free(&sky->picture);
    for (int i = 0; i < 6; ++i) {
        free(sky->face[i]);
    }
}

void sky_direction(double d[3], double x, double y, int height)
{
    const double a = PI * x / height - PI, down = PI * y / height;
    d[0] = sin(down) * sin(a);
    d[1] = cos(down);
    d[2] = -sin(down) * cos(a);
}

double sky_area(int y, int height) { return PI / height * (cos(PI * y / height) - cos(PI * (y + 1) / height)); }

void relight_read(float out[3], const image *p, float u, float v, int wraps)
{
    const float w = (float)p->width, h = (float)p->height;
    const float x = wraps ? u * w - 0.5f : clampf(u * w - 0.5f, 0.0f, w - 1.0f),
                y = clampf(v * h - 0.5f, 0.0f, h - 1.0f);
    const float x0 = floorf(x), y0 = floorf(y), fx = x - x0, fy = y - y0;
    const int left = x0 < 0.0f ? p->width - 1 : (int)x0, top = (int)y0, under = mini(top + 1, p->height - 1);
    const int right = left + 1 < p->width ? left + 1 : wraps ? 0 : left;
    const float *a = p->pixels + 3 * (top * p->width + left), *b = p->pixels + 3 * (top * p->width + right),
                *c = p->pixels + 3 * (under * p->width + left), *d = p->pixels + 3 * (under * p->width + right);
    for (int i = 0; i < 3; ++i) {
        const float above = a[i] + (b[i] - a[i]) * fx, below = c[i] + (d[i] - c[i]) * fx;
        out[i] = above + (below - above) * fy;
    }
}

/* --- filters ------------------------------------------------------------------------------------------------------ */

static void blur(relight_stage *s, int32_t terms, int32_t n)
{
    lmb_probe_halve(s->half, s->map, &s->table[0]);
    lmb_probe_halve(s->half, s->half, &s->table[1]);
    lmb_probe_blur_map(s->blurred, s->kernels, s->line, s->half, &s->blur[terms]);
    lmb_probe_map_cube(s->cube, n, s->blurred, &s->table[2]);
}

void relight_filter(relight_stage *s, int filter, int32_t n)
{
    static const int32_t terms[] = {0, LMB_SH_9, LMB_SH_16, LMB_SH_25};
    if (filter >= BLUR) {
        blur(s, filter - BLUR, n);
    } else if (filter == COSINE) {
        lmb_probe_reduce(&s->lights, s->kernels, s->map, &s->table[0]);
        lmb_probe_cosine(s->cube, n, s->kernels, &s->lights, &s->table[0]);
    } else {
        lmb_probe_sh(s->harmonics, s->map, &s->table[0]);
        lmb_probe_sh_cube(s->cube, n, (const float (*)[LMB_SH_25])s->harmonics, terms[filter]);
    }
}

void relight_update(relight_stage *s, int filter, lmb_vec3 at, int32_t n)
{
    lmb_probe_remap(s->map, s->kernels, &s->world, &s->table[0], at, 0);
    relight_filter(s, filter, n);
}

/* --- figures ------------------------------------------------------------------------------------------------------ */

relight_error relight_compare(const float *cube, const float *truth, int texels)
{
    relight_error e = {0.0, 0.0, 0.0};
    double sum = 0.0, mean = 0.0, peak = 0.0;
    for (int i = 0; i < 3 * texels; ++i) {
        const double want = (double)truth[i], is = (double)cube[i % 3 * texels + i / 3], d = fabs(is - want);
        sum += d * d;
        mean += want;
        peak = want > peak ? want : peak;
        e.largest = d > e.largest ? d : e.largest;
        e.min = is < e.min || i == 0 ? is : e.min;
    }
    e.largest /= peak;
    e.min /= peak;
    e.rmse = sqrt(sum * 3 * texels) / mean;
    return e;
}

static double seconds_now(void) { return (double)clock() / CLOCKS_PER_SEC; }

static double seconds_of(int calls, void (*work)(void *), void *context)
{
    const double from = seconds_now();
    for (int i = 0; i < calls; ++i) {
        work(context);
    }
    return seconds_now() - from;
}

/* Samples of half a millisecond, or of one call if that is longer, for a tenth of a second. */
double relight_seconds(void (*work)(void *), void *context)
{
    const double first = seconds_of(1, work, context), from = seconds_now();
    const int calls = first < 0.0005 ? 1 + (int)(0.0005 / (first + 1e-6)) : 1;
    double min = first;
    for (int i = 0; i < 5 || seconds_now() - from < 0.1; ++i) {
        const double s = seconds_of(calls, work, context) / calls;
        min = s < min ? s : min;
    }
    return min;
}
