/* relight_glossy.c: compares cubes of rough reflection with sums over everything that a place sees.
 *
 * Truth for a direction r is the integral of D(h) G(l) / 4 with n = v = r (the lobe of lmb_glossy at normal incidence)
 * over texels of the true surroundings or of the map, in double, divided by the lobe's own integral. Texels near r are
 * split into FINE x FINE. The true surroundings are the path-traced faces of 64 x 64. Lobes of roughness under 0.3 are
 * no wider than those texels, so for them the world is ray-traced with four rays for each texel of 192 x 192. Cubes
 * are sampled bilinearly, as pixels do, in DIRECTIONS spread evenly over the sphere; a cube of twice the side shows
 * the loss between texels. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../src/probe/cube.h"
#include "../truth_scene.h"
#include "relight_stage.h"

enum { DIRECTIONS = 192, FINE = 6, ROUGHS = 7, WORLDS = PLACES + SKIES, BEYOND = 128, SHARP = 192,
       NARROW = 2 /* number of the narrow roughnesses */ };
static const float roughness[ROUGHS] = {0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.7f, 1.0f};

/* The domain of a sum: texels of a cube's strip or of a map. */
typedef struct source {
    const image *picture;
    int is_cube;
    double width; /* rad: the widest texel */
    double *to;   /* x, y, z, solid angle of each texel */
} source;

/* Direction of point (x, y) in the picture; returns its solid angle per texel area, sr. */
static double place_of(double d[3], const source *s, double x, double y)
{
    const int n = s->picture->width, h = s->picture->height;
    if (!s->is_cube) {
        sky_direction(d, x, y, h);
        return sky_area((int)y, h);
    }
    const int face = (int)y / n;
    const double a = 2.0 * x / n - 1.0, b = 2.0 * (y - face * n) / n - 1.0, length = sqrt(1.0 + a * a + b * b);
    const lmb_vec3 p = cube_point(face, (float)a, (float)b);
    d[0] = (double)p.x / length;
    d[1] = (double)p.y / length;
    d[2] = (double)p.z / length;
    return 4.0 / ((double)n * n * length * length * length);
}

static void set_source(source *s, const image *picture)
{
    const int count = picture->width * picture->height;
    s->picture = picture;
    s->is_cube = picture->height == 6 * picture->width;
    s->width = s->is_cube ? 2.0 / picture->width : PI / picture->height;
    s->to = malloc(4 * (size_t)count * sizeof *s->to);
    if (s->to == NULL) {
        printf("not enough memory\n");
        exit(1);
    }
    for (int i = 0; i < count; ++i) {
        s->to[4 * i + 3] = place_of(s->to + 4 * i, s, i % picture->width + 0.5, i / picture->width + 0.5);
    }
}

/* Radiance that `at` sees along d in truth/env_relight: pictures 0 the ground, 1 the sphere around it. */
static void see(float out[3], const image pictures[2], lmb_vec3 at, const double d[3])
{
    const double far = 150.0, o[3] = {(double)at.x, (double)at.y, (double)at.z};
    const double fall = d[1] < 0.0 ? -o[1] / d[1] : 1e9, x = o[0] + fall * d[0], z = o[2] + fall * d[2];
    if (x * x + z * z <= far * far) {
        relight_read(out, &pictures[0], (float)(0.5 + x / 200.0), (float)(0.5 + z / 200.0), 0);
        return;
    }
    const double b = o[0] * d[0] + o[1] * d[1] + o[2] * d[2], c = o[0] * o[0] + o[1] * o[1] + o[2] * o[2] - far * far,
                 t = sqrt(b * b - c) - b;
    const double q[3] = {o[0] + t * d[0], o[1] + t * d[1], o[2] + t * d[2]};
    relight_read(out, &pictures[1], (float)(0.5 + atan2(q[0], -q[2]) / (2.0 * PI)), (float)(acos(q[1] / far) / PI), 1);
}

/* The surroundings as a strip of six faces. */
static void see_all(image *out, const image pictures[2], lmb_vec3 at)
{
    out->width = SHARP;
    out->height = 6 * SHARP;
    out->channels = 3;
    out->pixels = calloc(3 * 6 * SHARP * SHARP, sizeof *out->pixels);
    const source strip = {out, 1, 0.0, NULL};
    for (int i = 0; i < 4 * 6 * SHARP * SHARP && out->pixels != NULL; ++i) {
        const int at_texel = i / 4;
        double d[3];
        float seen[3];
        place_of(d, &strip, at_texel % SHARP + 0.25 + 0.5 * (i % 2), at_texel / SHARP + 0.25 + 0.5 * (i / 2 % 2));
        see(seen, pictures, at, d);
        for (int k = 0; k < 3; ++k) {
            out->pixels[3 * at_texel + k] += 0.25f * seen[k];
        }
    }
}

/* The lobe's weight of a direction with cosine c to r. */
static double lobe(double c, double a2)
{
    if (c <= 0.0) {
        return 0.0;
    }
    const double t = 0.5 * (1.0 + c) * (a2 - 1.0) + 1.0;
    return a2 / (t * t) * c / (c + sqrt(a2 + (1.0 - a2) * c * c));
}

/* The mean of the lobe over texel i. */
static double lobe_over(const source *s, int i, const double r[3], double a2)
{
    const int w = s->picture->width;
    double sum = 0.0;
    for (int k = 0; k < FINE * FINE; ++k) {
        double d[3];
        place_of(d, s, i % w + (k % FINE + 0.5) / FINE, i / w + (k / FINE + 0.5) / FINE);
        sum += lobe(d[0] * r[0] + d[1] * r[1] + d[2] * r[2], a2);
    }
    return sum / (FINE * FINE);
}

static void truth_at(float out[3], const source *s, const double r[3], double a2)
{
    const double near = cos(5.0 * s->width);
    const int count = s->picture->width * s->picture->height;
    double sum[3] = {0, 0, 0}, whole = 0.0;
    for (int i = 0; i < count; ++i) {
        const double *d = s->to + 4 * i, c = d[0] * r[0] + d[1] * r[1] + d[2] * r[2];
        if (c > 0.0) {
            const double weight = (c > near ? lobe_over(s, i, r, a2) : lobe(c, a2)) * d[3];
            const float *texel = s->picture->pixels + 3 * i;
            whole += weight;
            for (int k = 0; k < 3; ++k) {
                sum[k] += weight * (double)texel[k];
            }
        }
    }
    for (int k = 0; k < 3; ++k) {
        out[k] = (float)(sum[k] / whole);
    }
}

/* A golden-angle spiral from pole to pole. */
static void direction_at(double d[3], int i)
{
    const double y = 1.0 - (2.0 * i + 1.0) / DIRECTIONS, round = sqrt(1.0 - y * y), a = 2.399963229728653 * i;
    d[0] = round * sin(a);
    d[1] = y;
    d[2] = round * cos(a);
}

/* --- cubes -------------------------------------------------------------------------------------------------------- */

typedef struct glossy {
    relight_stage *stage;
    lmb_probe_rays rays;
    float planes[3 * 6 * BEYOND * BEYOND];
    float bordered[4 * 6 * (BEYOND + 2) * (BEYOND + 2)];
    float truth[ROUGHS][3 * DIRECTIONS];
    double rmse[WORLDS][ROUGHS][2]; /* with the default side for a roughness, and with twice that */
    double seconds[ROUGHS];
    lmb_vec3 at;
    float roughness;
    int32_t side;
} glossy;

static void reflect(void *context)
{
    glossy *g = context;
    const lmb_world_query query = {&g->stage->world, 0.0f, 0};
    lmb_probe_reflect(g->planes, g->side, g->stage->kernels, &g->rays, &query, g->at, g->roughness);
}

static void look_up(float out[3], const lmb_probe_cube *cube, const double d[3])
{
    const lmb_vec3 v = vec3((float)d[0], (float)d[1], (float)d[2]);
    const int n = cube->side, row = n + 2;
    float s, t;
    const int face = cube_face(&s, &t, v);
    const float x = 0.5f * (s + 1.0f) * (float)n + 0.5f, y = 0.5f * (t + 1.0f) * (float)n + 0.5f;
    const int left = mini((int)x, n), top = mini((int)y, n);
    const float fx = x - (float)left, fy = y - (float)top;
    const float *a = cube->texel + 4 * ((face * row + top) * row + left), *b = a + 4 * row;
    for (int k = 0; k < 3; ++k) {
        out[k] = (a[k] * (1.0f - fx) + a[k + 4] * fx) * (1.0f - fy) + (b[k] * (1.0f - fx) + b[k + 4] * fx) * fy;
    }
}

static double error_of(glossy *g, const float *truth)
{
    lmb_probe_cube cube;
    float seen[3 * DIRECTIONS];
    CHECK(lmb_probe_cube_init(&cube, g->planes, g->side, g->bordered, sizeof g->bordered) == LMB_OK);
    for (int i = 0; i < DIRECTIONS; ++i) {
        double d[3];
        float rgb[3];
        direction_at(d, i);
        look_up(rgb, &cube, d);
        for (int k = 0; k < 3; ++k) {
            seen[k * DIRECTIONS + i] = rgb[k];
        }
    }
    return relight_compare(seen, truth, DIRECTIONS).rmse;
}

static void measure(glossy *g, int world, lmb_vec3 at, const image *picture, int from, int to)
{
    source s;
    set_source(&s, picture);
    g->at = at;
    for (int i = from; i < to; ++i) {
        const double alpha = (double)roughness[i] * (double)roughness[i];
        g->roughness = roughness[i];
        for (int k = 0; k < DIRECTIONS; ++k) {
            double d[3];
            direction_at(d, k);
            truth_at(g->truth[i] + 3 * k, &s, d, alpha * alpha);
        }
        for (int twice = 0; twice < 2; ++twice) {
            g->side = lmb_probe_glossy_side(roughness[i]) << twice;
            reflect(g);
            g->rmse[world][i][twice] = error_of(g, g->truth[i]);
        }
    }
    free(s.to);
}

static void measure_times(glossy *g)
{
    for (int i = 0; i < ROUGHS; ++i) {
        g->roughness = roughness[i];
        g->side = lmb_probe_glossy_side(roughness[i]);
        g->seconds[i] = relight_seconds(reflect, g);
    }
}

static int measure_place(glossy *g, int place, const image pictures[2])
{
    char file[40];
    image seen = {0}, sharp = {0};
    snprintf(file, sizeof file, "pos%d_radiance.pfm", place + 1);
    see_all(&sharp, pictures, relight_places[place]);
    const int ok = sharp.pixels != NULL && truth_picture(&seen, "env_relight", file);
    if (ok) {
        measure(g, place, relight_places[place], &sharp, 0, NARROW);
        measure(g, place, relight_places[place], &seen, NARROW, ROUGHS);
    }
    image_free(&seen);
    image_free(&sharp);
    return ok;
}

static int measure_places(glossy *g)
{
    char path[SHARED_PATH];
    image pictures[2] = {{0}, {0}};
    int measured = 0;
    if (shared_file(path, "truth/env_relight/ground.pfm") && relight_take_centre(g->stage) &&
        truth_picture(&pictures[0], "env_relight", "ground.pfm") &&
        truth_picture(&pictures[1], "env_relight", "far_sphere.pfm")) {
        while (measured < PLACES && measure_place(g, measured, pictures)) {
            ++measured;
        }
        measure_times(g);
    }
    image_free(&pictures[0]);
    image_free(&pictures[1]);
    return measured == PLACES;
}

static int measure_sky(glossy *g, int which)
{
    const lmb_vec3 origin = {0, 0, 0};
    relight_sky sky;
    const int ok = relight_sky_load(&sky, which);
    if (ok) {
        relight_set_world(g->stage, &sky.pictures, LMB_WORLD_F32);
        measure(g, PLACES + which, origin, &sky.picture, 0, ROUGHS);
    }
    relight_sky_free(&sky);
    return ok;
}

static void print_row(const glossy *g, int i)
{
    double sum[2] = {0, 0}, worst = 0.0;
    for (int p = 0; p < PLACES; ++p) {
        for (int k = 0; k < 2; ++k) {
            sum[k] += g->rmse[p][i][k];
        }
        worst = g->rmse[p][i][0] > worst ? g->rmse[p][i][0] : worst;
    }
    printf("| %.1f | %d | %.2f | %.2f (%.2f) | %.2f |", (double)roughness[i], (int)lmb_probe_glossy_side(roughness[i]),
           1e3 * g->seconds[i], 20.0 * sum[0], 20.0 * sum[1], 100.0 * worst);
    for (int p = PLACES; p < WORLDS; ++p) {
        printf(" %.2f (%.2f) |", 100.0 * g->rmse[p][i][0], 100.0 * g->rmse[p][i][1]);
        worst = p < PLACES + TUNED && g->rmse[p][i][0] > worst ? g->rmse[p][i][0] : worst;
    }
    printf("\n");
    CHECK_MSG(i < NARROW || worst <= 0.06, "roughness %.1f: %.4f", (double)roughness[i], worst);
}

void relight_tell_glossy(relight_stage *s)
{
    static glossy g;
    g.stage = s;
    int all = measure_places(&g);
    for (int i = 0; i < SKIES; ++i) {
        all = measure_sky(&g, i) && all;
    }
    if (!all) {
        return;
    }
    printf("What rough surfaces mirror, rmse in percent of the mean; in brackets with a cube of twice the side.\n\n"
           "| roughness | side | ms, %s | five places | worst | %s | %s | %s | %s | %s |\n"
           "|---|---|---|---|---|---|---|---|---|---|\n",
           lmb_kernels_name(s->kernels), sky_names[0], sky_names[1], sky_names[2], sky_names[3], sky_names[4]);
    for (int i = 0; i < ROUGHS; ++i) {
        print_row(&g, i);
    }
    printf("\n");
}
