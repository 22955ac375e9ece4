/* relight_maps.c: compares irradiance of maps by every filter with the sum over all texels of a picture, and measures
 * the effect of a tiny, very bright sun on each.
 *
 * The sun is a disc of 0.53 degrees that gives a surface facing it ten times the map's mean irradiance. The sun is
 * added to the cube's texels in proportion to the part of each that it covers: 1 to 4 texels, which become thousands of
 * times as bright as the sky and exceed the range of coded worlds. The result depends on the sun's place among the
 * texels, so SUNS places in the sky are tried, one at a time. */
#include <math.h>
#include <string.h>

#include "../../src/probe/cube.h"
#include "../truth_scene.h"
#include "relight_stage.h"

enum { FINE = 32 }; /* samples each way in a texel near the sun */
enum { SUNS = 9, SPOTS = 64 };
static const double sun_radius = 0.5 * 0.53 * PI / 180.0, sun_times = 10.0;

/* Texels to which a sun was added, and their old values. */
typedef struct sun_spots {
    double way[3];
    int count;
    float *texel[SPOTS], was[SPOTS][3];
} sun_spots;

/* A golden-angle spiral from near the horizon to near the zenith; the last sun lies on an edge between two faces of the
 * cube, where texels are half as wide as the map's. */
static void set_way(double way[3], int i)
{
    static const double edge[3] = {2.0 / 3.0, 1.0 / 3.0, -2.0 / 3.0};
    const double y = (i + 0.5) / (SUNS - 1), round = sqrt(fabs(1.0 - y * y)), a = 2.399963229728653 * i + 0.3;
    way[0] = i < SUNS - 1 ? round * sin(a) : edge[0];
    way[1] = i < SUNS - 1 ? y : edge[1];
    way[2] = i < SUNS - 1 ? round * cos(a) : edge[2];
}

typedef struct sums {
    double normal[3][TEXELS], light[3][TEXELS];
} sums;

static void set_normals(sums *s)
{
    for (int i = 0; i < TEXELS; ++i) {
        const lmb_vec3 n = cube_direction(i / (SIDE * SIDE), i % SIDE, i / SIDE % SIDE, SIDE);
        s->normal[0][i] = (double)n.x;
        s->normal[1][i] = (double)n.y;
        s->normal[2][i] = (double)n.z;
    }
}

/* Adds light of `flux` from d to all normals. */
static void add_light(sums *s, const double d[3], const double flux[3])
{
    for (int i = 0; i < TEXELS; ++i) {
        const double cosine = d[0] * s->normal[0][i] + d[1] * s->normal[1][i] + d[2] * s->normal[2][i];
        const double lit = cosine > 0.0 ? cosine : 0.0;
        s->light[0][i] += lit * flux[0];
        s->light[1][i] += lit * flux[1];
        s->light[2][i] += lit * flux[2];
    }
}

/* Adds all texels of the picture. Returns their mean irradiance: a quarter of the integral over all directions. */
static double add_picture(sums *s, const image *p)
{
    double all = 0.0;
    for (int y = 0; y < p->height; ++y) {
        const double area = sky_area(y, p->height);
        for (int x = 0; x < p->width; ++x) {
            const float *texel = p->pixels + 3 * (y * p->width + x);
            const double flux[3] = {area * (double)texel[0], area * (double)texel[1], area * (double)texel[2]};
            double d[3];
            sky_direction(d, x + 0.5, y + 0.5, p->height);
            add_light(s, d, flux);
            all += flux[0] + flux[1] + flux[2];
        }
    }
    return all / 12.0;
}

/* Solid angle of the sun within texel (x, y) of a face, sr. */
static double sun_within(const double way[3], int face, int x, int y, int n)
{
    const double step = 2.0 / (n * FINE);
    double sum = 0.0;
    for (int i = 0; i < FINE * FINE; ++i) {
        const double s = (x * FINE + i % FINE + 0.5) * step - 1.0, t = (y * FINE + i / FINE + 0.5) * step - 1.0,
                     length2 = 1.0 + s * s + t * t, length = sqrt(length2);
        const lmb_vec3 p = cube_point(face, (float)s, (float)t);
        const double c = ((double)p.x * way[0] + (double)p.y * way[1] + (double)p.z * way[2]) / length;
        sum += c > cos(sun_radius) ? step * step / (length2 * length) : 0.0;
    }
    return sum;
}

static double texel_area(int x, int y, int n)
{
    const double s = (2.0 * x + 1.0) / n - 1.0, t = (2.0 * y + 1.0) / n - 1.0, length2 = 1.0 + s * s + t * t;
    return 4.0 / ((double)n * n * length2 * sqrt(length2));
}

/* Adds a sun of `irradiance` on a facing surface, W/m2. */
static void add_sun(sun_spots *spots, const relight_sky *sky, double irradiance)
{
    const int n = sky->pictures.face_size;
    const double radiance = irradiance / (PI * sun_radius * sun_radius), *way = spots->way;
    double all = 0.0;
    spots->count = 0;
    for (int i = 0; i < 6 * n * n; ++i) {
        const int face = i / (n * n), x = i % n, y = i / n % n;
        const lmb_vec3 d = cube_direction(face, x, y, n);
        const double c = (double)d.x * way[0] + (double)d.y * way[1] + (double)d.z * way[2];
        const double part = c > 0.99 ? sun_within(way, face, x, y, n) : 0.0;
        if (part > 0.0 && spots->count < SPOTS) {
            float *texel = spots->texel[spots->count] = sky->face[face] + 3 * (i % (n * n));
            memcpy(spots->was[spots->count++], texel, sizeof *spots->was);
            for (int k = 0; k < 3; ++k) {
                texel[k] += (float)(radiance * part / texel_area(x, y, n));
            }
            all += part * radiance;
        }
    }
    CHECK_MSG(fabs(all / irradiance - 1.0) < 0.01, "the sun's light: %g of %g", all, irradiance);
}

static void remove_sun(const sun_spots *spots)
{
    for (int i = 0; i < spots->count; ++i) {
        memcpy(spots->texel[i], spots->was[i], sizeof *spots->was);
    }
}

static void truth_of(float truth[3 * TEXELS], const sums *s)
{
    for (int i = 0; i < 3 * TEXELS; ++i) {
        truth[i] = (float)s->light[i % 3][i / 3];
    }
}

/* [FILTERS]: the sum over cosines, of a world in 16-bit codes. */
typedef struct map_errors {
    relight_error of[FILTERS + 1];
    double from_cosine; /* RMSE of sh9 against cosine */
} map_errors;

static void filter_all(map_errors *e, relight_stage *s, const relight_sky *sky, const float *truth)
{
    static float cosine[3 * TEXELS];
    const lmb_vec3 origin = {0, 0, 0};
    relight_set_world(s, &sky->pictures, LMB_WORLD_F32);
    for (int f = 0; f < FILTERS; ++f) {
        relight_update(s, f, origin, SIDE);
        e->of[f] = relight_compare(s->cube, truth, TEXELS);
        for (int i = 0; i < 3 * TEXELS && f == COSINE; ++i) {
            cosine[i] = s->cube[i % 3 * TEXELS + i / 3];
        }
        if (f == SH_9) {
            e->from_cosine = relight_compare(s->cube, cosine, TEXELS).rmse;
        }
    }
    relight_set_world(s, &sky->pictures, LMB_WORLD_LOG16);
    relight_update(s, COSINE, origin, SIDE);
    e->of[FILTERS] = relight_compare(s->cube, truth, TEXELS);
}

/* Means and worst values over all suns. */
typedef struct sun_errors {
    double mean[FILTERS + 1], worst[FILTERS + 1], largest[FILTERS + 1], min[FILTERS + 1], from_cosine;
} sun_errors;

static void add_errors(sun_errors *to, const map_errors *e)
{
    for (int f = 0; f <= FILTERS; ++f) {
        const relight_error *one = &e->of[f];
        to->mean[f] += one->rmse / SUNS;
        to->worst[f] = one->rmse > to->worst[f] ? one->rmse : to->worst[f];
        to->largest[f] = one->largest > to->largest[f] ? one->largest : to->largest[f];
        to->min[f] = one->min < to->min[f] ? one->min : to->min[f];
    }
    to->from_cosine += e->from_cosine / SUNS;
}

static void measure_suns(sun_errors *out, relight_stage *s, const relight_sky *sky, const sums *map, double irradiance)
{
    static sums sum;
    static float truth[3 * TEXELS];
    const double flux[3] = {irradiance, irradiance, irradiance};
    for (int i = 0; i < SUNS; ++i) {
        sun_spots spots;
        map_errors one;
        set_way(spots.way, i);
        sum = *map;
        add_light(&sum, spots.way, flux);
        truth_of(truth, &sum);
        add_sun(&spots, sky, irradiance);
        filter_all(&one, s, sky, truth);
        remove_sun(&spots);
        add_errors(out, &one);
    }
}

static void print_map(const char *name, const map_errors *plain, const sun_errors *sunny)
{
    for (int f = 0; f <= FILTERS; ++f) {
        const relight_error *a = &plain->of[f];
        printf("| %s | %s | %.2f | %.1f | %.1f | %.2f | %.2f | %.1f | %.1f |\n", name,
               f == FILTERS ? "cosine, 16-bit codes" : filter_names[f], 100.0 * a->rmse, 100.0 * a->largest,
               100.0 * a->min, 100.0 * sunny->mean[f], 100.0 * sunny->worst[f], 100.0 * sunny->largest[f],
               100.0 * sunny->min[f]);
    }
    printf("| %s | sh9 from cosine | %.2f | | | %.2f | | | |\n", name, 100.0 * plain->from_cosine,
           100.0 * sunny->from_cosine);
}

static void measure(relight_stage *s, const relight_sky *sky, const char *name)
{
    static sums sum;
    static float truth[3 * TEXELS];
    map_errors plain;
    sun_errors sunny;
    memset(&sum, 0, sizeof sum);
    memset(&sunny, 0, sizeof sunny);
    set_normals(&sum);
    const double mean = add_picture(&sum, &sky->picture);
    truth_of(truth, &sum);
    filter_all(&plain, s, sky, truth);
    measure_suns(&sunny, s, sky, &sum, sun_times * mean);
    print_map(name, &plain, &sunny);
    CHECK_MSG(plain.of[COSINE].rmse <= 0.006, "%s, cosine: %.4f", name, plain.of[COSINE].rmse);
    CHECK_MSG(sunny.worst[COSINE] <= 0.01, "%s, cosine with a sun: %.4f", name, sunny.worst[COSINE]);
    if (strncmp(name, "studio", 6) != 0) { /* if one softbox is most of the light, nine harmonics are 11 % off */
        CHECK_MSG(plain.of[SH_9].rmse <= 0.0205, "%s, sh9: %.4f", name, plain.of[SH_9].rmse);
        CHECK_MSG(plain.from_cosine <= 0.02, "%s, sh9 from cosine: %.4f", name, plain.from_cosine);
    }
}

void relight_tell_maps(relight_stage *s)
{
    printf("Outdoor maps, percent: rmse of the mean, largest error and least value of the largest; the same with a sun "
           "of %.0f times the\nmean irradiance, at each of %d places.\n\n"
           "| map | filter | rmse | largest | least | with a sun: rmse | worst | largest | least |\n"
           "|---|---|---|---|---|---|---|---|---|\n", sun_times, SUNS);
    for (int i = 0; i < SKIES; ++i) {
        relight_sky sky;
        if (relight_sky_load(&sky, i)) {
            measure(s, &sky, sky_names[i]);
        }
        relight_sky_free(&sky);
    }
    printf("\n");
}
