/* main_contact.c: measures how `lambent relight --contact` darkens the ground and neighbouring objects,
 * against path-traced pictures.
 *
 *     measure-contact FOLDER MAP [TURN [MODEL]]
 *
 * Writes pictures to FOLDER. MAP is a sphere's picture, twice as wide as high; TURN turns it, in degrees. A ball, a box
 * and a ring (or a model), matte and 1 m in size, stand on an endless matte ground under the upper half of the map. The
 * truth has up to five reflections. Figures, each with and without --contact and with the truth's noise removed: for
 * the ground, the RMSE of the change that the objects cause, over the root mean square of the true change and over the
 * ground's mean; for the objects, RMSE over their mean. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../src/base/vertex.h"
#include "../../tools/model/model.h"
#include "../../tools/picture/picture.h"
#include "../../tools/picture/picture_read.h"
#include "../../tools/relight/verb_relight.h"
#include "../pfm_file.h"
#include "../truth/path.h"

#define PI 3.141592653589793

int test_passed, test_failed, test_skipped;

enum { SIDE = 64, PIXELS = SIDE * SIDE, STRATA = 24, SAMPLES = STRATA * STRATA, BOUNCES = 4, HALVES = 2, MOST = 8192 };

static const double albedos[4][3] = {{0.7, 0.7, 0.7}, {0.7, 0.4, 0.3}, {0.3, 0.5, 0.7}, {0.5, 0.45, 0.4}};
enum { GROUND = 3 };

typedef struct stage {
    made_scene scene;
    path_tracer tracer;
    stored_picture map;
    double *sums;      /* running sum of the light of the pixels */
    int drawn; /* number of pictures; kept pictures are not written again */
    double plain[3];   /* the ground's radiance without objects */
    float truth[HALVES][3 * PIXELS]; /* two halves with different paths */
    int8_t seen[PIXELS]; /* material; -1: the map */
} stage;

/* --- the objects -------------------------------------------------------------------------------------------------- */

static void add(made_scene *s, svec a, svec b, svec c, int material)
{
    if (s->triangles < MOST) {
        s->corners[3 * s->triangles] = a;
        s->corners[3 * s->triangles + 1] = b;
        s->corners[3 * s->triangles + 2] = c;
        s->materials[s->triangles++] = (uint8_t)material;
    }
}

static void add_four(made_scene *s, svec a, svec b, svec c, svec d, int material)
{
    add(s, a, b, c, material);
    add(s, a, c, d, material);
}

static svec round_ball(double u, double v)
{
    return at(-1.0 + 0.5 * sin(PI * v) * cos(2 * PI * u), 0.5 - 0.5 * cos(PI * v), -0.2 - 0.5 * sin(PI * v) * sin(2 * PI * u));
}

static svec ring(double u, double v)
{
    const double r = 0.42 + 0.17 * cos(2 * PI * v);
    return at(1.05 + r * cos(2 * PI * u), 0.17 + 0.17 * sin(2 * PI * v), 0.3 - r * sin(2 * PI * u));
}

static void add_round(made_scene *s, svec (*of)(double, double), int across, int down, int material)
{
    for (int i = 0; i < across * down; ++i) {
        const double u = (double)(i % across) / across, v = (double)(i / across) / down, x = u + 1.0 / across, y = v + 1.0 / down;
        add_four(s, of(u, v), of(x, v), of(x, y), of(u, y), material);
    }
}

static svec in_box(int face, double s, double t)
{
    const double p[6][3] = {{1, -t, -s}, {-1, -t, s}, {s, 1, t}, {s, -1, -t}, {s, -t, 1}, {-s, -t, -1}};
    const double x = 0.3 * p[face][0], z = 0.3 * p[face][2];
    return at(0.15 + 0.8 * x + 0.6 * z, 0.45 + 0.45 * p[face][1], -0.5 - 0.6 * x + 0.8 * z);
}

static void add_box(made_scene *s, int n, int material)
{
    for (int i = 0; i < 6 * n * n; ++i) {
        const int face = i / (n * n);
        const double u = 2.0 * (i % n) / n - 1, v = 2.0 * (i / n % n) / n - 1, w = 2.0 / n;
        add_four(s, in_box(face, u, v), in_box(face, u, v + w), in_box(face, u + w, v + w), in_box(face, u + w, v), material);
    }
}

/* Scales the longest side to 1 m and places the model at 0, 0, 0. */
static int add_model(made_scene *s, const char *path)
{
    model m;
    model_notes notes = {0};
    report r = {""};
    lmb_vec3 low, high;
    if (!model_load(&m, path, NULL, &notes, &r)) {
        printf("FAIL %s: %s\n", path, r.text);
        return 0;
    }
    lmb_scene_bounds(&low, &high, &m.scene);
    const double size = 1.0 / fmax(fmax((double)high.x - (double)low.x, (double)high.y - (double)low.y), (double)high.z - (double)low.z);
    for (uint32_t i = 0; i < m.scene.instance_count; ++i) {
        const lmb_mesh *mesh = &m.scene.meshes[m.scene.instances[i].mesh];
        for (uint32_t t = 0; t < mesh->triangle_count; ++t) {
            svec p[3];
            for (uint32_t k = 0; k < 3; ++k) {
                const lmb_vec3 c = transform_point(&m.scene.instances[i].to_world, mesh_position(mesh, mesh_index(mesh, 3 * t + k)));
                p[k] = at(size * ((double)c.x - 0.5 * ((double)low.x + (double)high.x)), size * ((double)c.y - (double)low.y),
                          size * ((double)c.z - 0.5 * ((double)low.z + (double)high.z)));
            }
            add(s, p[0], p[1], p[2], 1);
        }
    }
    model_free(&m);
    return s->triangles < MOST;
}

static int build(made_scene *s, const char *model_path)
{
    memset(s, 0, sizeof *s);
    s->corners = malloc(3 * MOST * sizeof *s->corners);
    s->materials = malloc(MOST);
    if (s->corners == NULL || s->materials == NULL) {
        return 0;
    }
    if (model_path == NULL) {
        add_round(s, round_ball, 32, 20, 0);
        add_box(s, 10, 1);
        add_round(s, ring, 40, 16, 2);
    } else if (!add_model(s, model_path)) {
        return 0;
    }
    memcpy(s->albedo, albedos, sizeof albedos);
    s->material_count = 3;
    s->eye = at(0.2, 1.5, 3.4);
    s->target = at(0, 0.35, 0);
    s->up = at(0, 1, 0);
    s->fov_deg = 45;
    return 1;
}

/* --- truth -------------------------------------------------------------------------------------------------------- */

/* Turns the map about the vertical by moving columns. */
static int turn_map(image *map, double degrees)
{
    const size_t w = (size_t)map->width, by = (size_t)(degrees / 360.0 * (double)w + 0.5) % w;
    float *row = malloc(3 * w * sizeof *row);
    for (int32_t y = 0; row != NULL && y < map->height; ++y) {
        float *to = map->pixels + 3 * w * (size_t)y;
        memcpy(row, to, 3 * w * sizeof *row);
        memcpy(to, row + 3 * by, 3 * (w - by) * sizeof *row);
        memcpy(to + 3 * (w - by), row, 3 * by * sizeof *row);
    }
    free(row);
    return row != NULL;
}

static double random_of(test_rng *r) { return test_random(r) * (1.0 / 4294967296.0); }

static const float *map_pixel(const stage *s, int i) { return s->map.light.pixels + 3 * (size_t)i; }

/* Only the upper half emits light. Sums the power of each pixel, and the irradiance of the ground. */
static int sum_map(stage *s)
{
    const int w = s->map.width, half = w * s->map.height / 2;
    double sum = 0.0, down[3] = {0, 0, 0};
    s->sums = malloc((size_t)half * sizeof *s->sums);
    for (int i = 0; s->sums != NULL && i < half; ++i) {
        const double top = cos(PI * (i / w) / s->map.height), low = cos(PI * (i / w + 1) / s->map.height);
        const double angle = 2 * PI / w * (top - low), cosine_there = cos(PI * (i / w + 0.5) / s->map.height);
        const float *p = map_pixel(s, i);
        sum += angle * (double)(p[0] + p[1] + p[2]);
        s->sums[i] = sum;
        for (int c = 0; c < 3; ++c) {
            down[c] += angle * cosine_there * (double)p[c];
        }
    }
    for (int c = 0; c < 3; ++c) {
        s->plain[c] = albedos[GROUND][c] * down[c] / PI;
    }
    return s->sums != NULL && sum > 0.0;
}

/* Picks a direction in proportion to power. Longitude as in relight: a = atan2(x, -z), from
 * -180 degrees, north on top. */
static void pick(svec *to, double weight[3], const stage *s, double wanted, test_rng *r)
{
    const int w = s->map.width, half = w * s->map.height / 2;
    wanted *= s->sums[half - 1];
    int low = 0, high = half - 1;
    while (low < high) {
        const int middle = (low + high) / 2;
        if (s->sums[middle] < wanted) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    const double top = cos(PI * (low / w) / s->map.height), under = cos(PI * (low / w + 1) / s->map.height);
    const double y = under + random_of(r) * (top - under), a = (low % w + random_of(r)) * 2 * PI / w - PI, out = sqrt(1 - y * y);
    const float *p = map_pixel(s, low);
    for (int c = 0; c < 3; ++c) {
        weight[c] = s->sums[half - 1] * (double)p[c] / (double)(p[0] + p[1] + p[2]);
    }
    *to = at(out * sin(a), y, -out * cos(a));
}

static int meet(const stage *s, path_point *out, svec from, svec along)
{
    const int hit = path_hit(&s->tracer, out, from, along);
    const double far = along.y < 0.0 ? -from.y / along.y : -1.0;
    if (far > 0.0 && (!hit || dot_of(less(out->at, from), along) > far)) {
        out->at = plus(from, times(along, far));
        out->at.y = 1e-6;
        out->normal = at(0, 1, 0);
        out->material = GROUND;
        return 1;
    }
    return hit;
}

/* Adds the map's light that a point reflects, sampled by one shadow ray. */
static void add_sky(double rgb[3], const stage *s, const path_point *p, const double share[3], double wanted,
                    test_rng *r)
{
    svec to;
    double light[3];
    pick(&to, light, s, wanted, r);
    const double cosine_there = dot_of(to, p->normal);
    if (cosine_there > 0.0 && path_sees(&s->tracer, p->at, to, 1e30)) {
        for (int c = 0; c < 3; ++c) {
            rgb[c] += share[c] * albedos[p->material][c] / PI * cosine_there * light[c];
        }
    }
}

/* Traces the k-th path; its first rays use the k-th stratum. */
static void trace(double rgb[3], const stage *s, path_point p, int k, test_rng *r)
{
    double share[3] = {1, 1, 1};
    double wanted = (k + random_of(r)) / SAMPLES, u = (k % STRATA + random_of(r)) / STRATA,
           v = (k / STRATA + random_of(r)) / STRATA;
    for (int b = 0; b <= BOUNCES; ++b) {
        path_point next;
        add_sky(rgb, s, &p, share, wanted, r);
        if (!meet(s, &next, p.at, path_scattered(p.normal, u, v))) {
            return;
        }
        for (int c = 0; c < 3; ++c) {
            share[c] *= albedos[p.material][c];
        }
        p = next;
        wanted = random_of(r);
        u = random_of(r);
        v = random_of(r);
    }
}

static void trace_picture(stage *s, int half_of)
{
    const svec forward = unit(less(s->scene.target, s->scene.eye)), right = unit(cross_of(forward, s->scene.up)),
               up = cross_of(right, forward);
    const double half = tan(0.5 * s->scene.fov_deg * PI / 180.0);
    test_rng random = {7 + (uint32_t)half_of};
    for (int i = 0; i < PIXELS; ++i) {
        const svec across = times(right, half * (2 * (i % SIDE + 0.5) / SIDE - 1)), down = times(up, half * (1 - 2 * (i / SIDE + 0.5) / SIDE));
        double sum[3] = {0, 0, 0};
        path_point p;
        s->seen[i] = -1;
        if (meet(s, &p, s->scene.eye, unit(plus(forward, plus(across, down))))) {
            s->seen[i] = (int8_t)p.material;
            for (int k = 0; k < SAMPLES; ++k) {
                trace(sum, s, p, k, &random);
            }
        }
        for (int c = 0; c < 3; ++c) {
            s->truth[half_of][3 * i + c] = (float)(sum[c] / SAMPLES);
        }
    }
}

/* --- the input of relight ----------------------------------------------------------------------------------------- */

static int write_floats(const char *path, int width, int height, const float *rgb)
{
    report r = {""};
    image p = {width, height, 3, NULL};
    p.pixels = malloc(3 * sizeof(float) * (size_t)width * (size_t)height);
    if (p.pixels == NULL) {
        return 0;
    }
    memcpy(p.pixels, rgb, 3 * sizeof(float) * (size_t)width * (size_t)height);
    const int ok = picture_write(path, &p, 0.0f, PICTURE_CLIPPED, &r);
    image_free(&p);
    return ok;
}

static int write_objects(const stage *s, const char *folder)
{
    char path[600];
    snprintf(path, sizeof path, "%s/objects.mtl", folder);
    FILE *m = fopen(path, "w");
    snprintf(path, sizeof path, "%s/objects.obj", folder);
    FILE *f = fopen(path, "w");
    for (int i = 0; m != NULL && i < GROUND; ++i) {
        fprintf(m, "newmtl m%d\nKd %g %g %g\n", i, albedos[i][0], albedos[i][1], albedos[i][2]);
    }
    if (f != NULL) {
        fprintf(f, "mtllib objects.mtl\n");
    }
    for (uint32_t i = 0; f != NULL && i < s->scene.triangles; ++i) {
        const svec *c = s->scene.corners + 3 * i;
        fprintf(f, "usemtl m%d\nv %.9g %.9g %.9g\nv %.9g %.9g %.9g\nv %.9g %.9g %.9g\nf -3 -2 -1\n", s->scene.materials[i],
                c[0].x, c[0].y, c[0].z, c[1].x, c[1].y, c[1].z, c[2].x, c[2].y, c[2].z);
    }
    return m != NULL && f != NULL && (fclose(m) == 0) + (fclose(f) == 0) == 2;
}

/* The map's lower half becomes the ground, far away. */
static int write_world(stage *s, const char *folder)
{
    char path[600];
    const int half = s->map.width * s->map.height / 2;
    float ground[3 * 64];
    for (int i = 0; i < 3 * half; ++i) {
        s->map.light.pixels[3 * half + i] = (float)s->plain[i % 3];
    }
    for (int i = 0; i < 3 * 64; ++i) {
        ground[i] = (float)s->plain[i % 3];
    }
    snprintf(path, sizeof path, "%s/world.pfm", folder);
    const int ok = write_floats(path, s->map.width, s->map.height, s->map.light.pixels);
    snprintf(path, sizeof path, "%s/ground.pfm", folder);
    return ok && write_floats(path, 8, 8, ground);
}

/* Places the objects by the middle of the bottom of their bounding box. */
static int relight(stage *s, const char *folder, const char *contact, image *out)
{
    char world[600], ground[600], object[600], at_text[80], drawn[600];
    ++s->drawn;
    svec low = at(1e9, 1e9, 1e9), high = at(-1e9, -1e9, -1e9);
    for (uint32_t i = 0; i < 3 * s->scene.triangles; ++i) {
        const svec c = s->scene.corners[i];
        low = at(fmin(low.x, c.x), fmin(low.y, c.y), fmin(low.z, c.z));
        high = at(fmax(high.x, c.x), fmax(high.y, c.y), fmax(high.z, c.z));
    }
    snprintf(world, sizeof world, "%s/world.pfm", folder);
    snprintf(ground, sizeof ground, "%s/ground.pfm", folder);
    snprintf(object, sizeof object, "%s/objects.obj", folder);
    snprintf(drawn, sizeof drawn, "%s/drawn_%d.pfm", folder, s->drawn);
    snprintf(at_text, sizeof at_text, "%.9g,%.9g,%.9g", 0.5 * (low.x + high.x), low.y, 0.5 * (low.z + high.z));
    char *argv[] = {"relight", "--world", world, "--world-centre", "0,1,0", "--world-sphere", "0,0,0,100000", "--ground", ground,
                    "--ground-size", "40000,40000", "--object", object, "--at", at_text, "--f0", "0", "--roughness", "1",
                    "--eye", "0.2,1.5,3.4", "--target", "0,0.35,0", "--size", "64x64", "-q", "-o", drawn, (char *)contact, NULL};
    return verb_relight((int)(sizeof argv / sizeof *argv) - (contact != NULL ? 1 : 2), argv) == 0 && pfm_file(out, drawn);
}

/* --- figures ------------------------------------------------------------------------------------------------------ */

typedef struct figure {
    double rms, mean, object;
} figure;

/* Multiplies the two halves of the paths instead of squaring one: the product of independent noise has mean 0. */
static figure judge(const stage *s, const float *ours)
{
    double wrong = 0.0, change = 0.0, size = 0.0, object = 0.0, mean = 0.0;
    int ground = 0, objects = 0;
    for (int i = 0; i < 3 * PIXELS; ++i) {
        const double a = (double)s->truth[0][i], b = (double)s->truth[1][i], o = (double)ours[i], plain = s->plain[i % 3];
        if (s->seen[i / 3] == GROUND) {
            wrong += (o - a) * (o - b);
            change += (a - plain) * (b - plain);
            size += fabs(0.5 * (a + b) - plain);
            ++ground;
        } else if (s->seen[i / 3] >= 0) {
            object += (o - a) * (o - b);
            mean += 0.5 * (a + b);
            ++objects;
        }
    }
    wrong = fmax(wrong, 0.0);
    return (figure){sqrt(wrong / change), sqrt(wrong / ground) / (size / ground), sqrt(fmax(object, 0.0) / objects) / (mean / objects)};
}

static void measure(stage *s, const char *folder, const char *file, double degrees)
{
    char path[600];
    report r = {""};
    file_bytes bytes;
    if (!file_read(&bytes, file, &r) || !picture_read(&s->map, bytes.data, bytes.size, file, &r) ||
        s->map.light.pixels == NULL || s->map.light.channels != 3 || !turn_map(&s->map.light, degrees) ||
        !sum_map(s)) {
        printf("FAIL %s: %s\n", file, r.text);
        ++test_failed;
        return;
    }
    for (int i = 0; i < HALVES; ++i) {
        trace_picture(s, i);
    }
    const char *name = strrchr(file, '/') != NULL ? strrchr(file, '/') + 1 : file;
    snprintf(path, sizeof path, "%s/%.60s.truth.pfm", folder, name);
    image without = {0, 0, 0, NULL}, with = {0, 0, 0, NULL};
    if (write_floats(path, SIDE, SIDE, s->truth[0]) && write_objects(s, folder) && write_world(s, folder) &&
        relight(s, folder, NULL, &without) && relight(s, folder, "--contact", &with)) {
        const figure a = judge(s, without.pixels), b = judge(s, with.pixels);
        printf("%-30s ground's change %.3f -> %.3f (over its mean %.3f -> %.3f), objects %.4f -> %.4f\n", name, a.rms, b.rms,
               a.mean, b.mean, a.object, b.object);
        snprintf(path, sizeof path, "%s/%.60s.contact.pfm", folder, name);
        CHECK(write_floats(path, SIDE, SIDE, with.pixels));
        CHECK_MSG(b.rms <= 0.15 && b.object <= 0.05, "%s", name);
    } else {
        printf("FAIL %s: not drawn\n", name);
        ++test_failed;
    }
    image_free(&without);
    image_free(&with);
    free(s->sums);
    stored_picture_free(&s->map);
    file_free(&bytes);
}

int main(int argc, char **argv)
{
    static stage s;
    if (argc < 3 || argc > 5 || !build(&s.scene, argc > 4 ? argv[4] : NULL) || !path_open(&s.tracer, &s.scene)) {
        return 2;
    }
    measure(&s, argv[1], argv[2], argc > 3 ? fmod(strtod(argv[3], NULL) + 3600.0, 360.0) : 0.0);
    path_close(&s.tracer);
    scene_drop(&s.scene);
    printf("%d passed, %d failed, %d skipped\n", test_passed, test_failed, test_skipped);
    return test_failed != 0;
}
