/* test_mix.c: the steps of `lambent mix` on a photo of a floor and a wall that is known: where the object stands, what
 * the surfaces reflect, and what happens where there is nothing to stand on. [M4 M5 M7 M24] */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../tools/mix/mix_job.h"
#include "../test.h"

void test_mix(void);

enum { WIDTH = 96, HEIGHT = 72, PIXELS = WIDTH * HEIGHT };

static const float GREY = 0.3f;
static const lmb_pinhole camera = {WIDTH, HEIGHT, 80.0f, 80.0f, 47.5f, 35.5f};
static char square[] = "tests/fuzz/corpus/obj/quads.obj"; /* upright, a unit wide and high */

/* A job with a grey photo, and what more its command line says. */
static mix_job *begin(char *const *more, int count)
{
    char *argv[24] = {"mix", "--frame", "known", "--voxels", "4", "--shadow-map", "64", "-o", "known.pfm"};
    report r = {""};
    mix_job *j = calloc(1, sizeof *j);
    if (j == NULL) {
        abort();
    }
    memcpy(argv + 9, more, (size_t)count * sizeof *more);
    CHECK_MSG(mix_options_parse(&j->o, 9 + count, argv, &r), "%s", r.text);
    j->frame.camera = camera;
    j->frame.light.width = WIDTH;
    j->frame.light.height = HEIGHT;
    j->frame.light.channels = 3;
    j->frame.light.pixels = malloc(3 * PIXELS * sizeof(float));
    j->frame.depth = malloc(PIXELS * sizeof(float));
    for (int i = 0; i < 3 * PIXELS; ++i) {
        j->frame.light.pixels[i] = GREY;
    }
    return j;
}

/* A wall `far` ahead; a floor half a metre under the camera, unless it is to be left out. */
static void set_depth(mix_job *j, float far, int has_floor)
{
    for (int i = 0; i < PIXELS; ++i) {
        const lmb_vec3 ray = lmb_cloud_ray(&camera, (float)(i % WIDTH), (float)(i / WIDTH));
        const float floor = has_floor && ray.y < -0.01f ? -0.5f / ray.y : 1e9f;
        j->frame.depth[i] = floor < far ? floor : far;
    }
}

static int place(mix_job *j)
{
    report r = {""};
    return mix_find_planes(j, &r) && mix_place(j, &r);
}

/* --- where it stands ---------------------------------------------------------------------------------------------- */

static void stands_on_floor(void)
{
    char *object[] = {"--object", square};
    mix_job *j = begin(object, 2);
    set_depth(j, 2.5f, 1);
    CHECK(place(j) && j->faces_up && j->inside && j->floor >= 0);
    CHECK_MSG(fabsf(j->anchor.y + 0.5f) < 1e-3f && fabsf(j->gap_m) < 1e-3f, "%g %g", (double)j->anchor.y,
              (double)j->gap_m);
    /* In units of the floor's shorter side, a sixth; less where the picture has no room. */
    CHECK_MSG(j->scale > 0.05f && j->scale < 0.4f, "%g", (double)j->scale);
    mix_job_free(j);
}

/* The measured floor is 4 mm lower than the plane is by then: the gap says so. */
static void gap_is_seen(void)
{
    char *object[] = {"--object", square};
    mix_job *j = begin(object, 2);
    report r = {""};
    set_depth(j, 2.5f, 1);
    CHECK(mix_find_planes(j, &r));
    for (int i = 0; i < PIXELS; ++i) {
        j->frame.depth[i] += 0.004f;
    }
    CHECK(mix_place(j, &r));
    CHECK_MSG(fabsf(j->gap_m - 0.004f) < 5e-4f, "%g", (double)j->gap_m);
    mix_job_free(j);
}

/* A size that was asked for is kept, and said to be too large. */
static void size_is_kept(void)
{
    char *object[] = {"--object", square, "--scale", "1.5"};
    mix_job *j = begin(object, 4);
    set_depth(j, 2.5f, 1);
    CHECK(place(j) && j->scale == 1.5f && !j->inside);
    mix_job_free(j);
}

/* One wall, no floor: on the wall, and it is known to be none that faces up. */
static void no_floor(void)
{
    char *object[] = {"--object", square};
    mix_job *j = begin(object, 2);
    set_depth(j, 2.5f, 0);
    CHECK(place(j) && !j->faces_up && j->floor == 0 && j->up.z > 0.999f && j->inside);
    mix_job_free(j);
    j = begin(object, 2);
    memset(j->frame.depth, 0, PIXELS * sizeof(float));
    CHECK(!place(j));
    mix_job_free(j);
}

/* --- what the photo says ------------------------------------------------------------------------------------------ */

/* Surroundings of GREY give pi GREY, and a light from above gives the floor alone 0.7 of that more: there the photo's
 * GREY is that of an albedo of 1 / 1.7, and 1, which nothing has, on the wall. */
static void albedo_is_told(void)
{
    char light[80];
    char *more[] = {"--object", square, "--at", "48,68", "--scale", "0.01", "--light", light};
    report r = {""};
    const double power = 0.7 * 3.14159265 * (double)GREY;
    snprintf(light, sizeof light, "sun:0,0,0:0,-1,0:%.6f,%.6f,%.6f", power, power, power);
    mix_job *j = begin(more, 8);
    set_depth(j, 2.5f, 1);
    CHECK_MSG(place(j) && mix_light(j, &r) && mix_voxels(j, &r), "%s", r.text);
    int cells[2] = {0}, wrong[2] = {0};
    for (int32_t c = 0; c < j->real.count; ++c) {
        const int is_floor = j->real.label[c] == j->floor + 1, want = is_floor ? 150 : 242;
        const uint8_t *colour = j->real.colours + 16 * c;
        cells[is_floor]++;
        wrong[is_floor] += colour[0] < want - 2 || colour[0] > want + 2 || colour[1] != colour[0];
    }
    /* A row of cells goes over the edge between both. */
    CHECK_MSG(cells[0] > 100 && cells[1] > 50 && wrong[0] + wrong[1] <= WIDTH / 4, "%d of %d, %d of %d", wrong[0],
              cells[0], wrong[1], cells[1]);
    mix_job_free(j);
}

/* Nothing is put in: not a bit changes, whatever lights there are. */
static void nothing_changes(void)
{
    char *more[] = {"--light", "sun:0,0,0:0.1,-1,0:2,2,2"};
    report r = {""};
    mix_job *j = begin(more, 2);
    test_rng rng = {7};
    set_depth(j, 2.5f, 1);
    for (int i = 0; i < 3 * PIXELS; ++i) {
        j->frame.light.pixels[i] = test_uniform(&rng, 0.0f, 2.0f);
    }
    CHECK(place(j) && mix_light(j, &r) && mix_voxels(j, &r) && mix_draw(j, &r));
    CHECK(memcmp(j->picture.pixels, j->frame.light.pixels, 3 * PIXELS * sizeof(float)) == 0);
    mix_job_free(j);
}

/* --- what lamps send ---------------------------------------------------------------------------------------------- */

/* W that voxels without the object hold of a spot over the floor, by maps of that many texels a side; *around: of what
 * is around, the share that is left with the object. */
static double lamp_flux(float *around, int32_t texels, const char *light, char *scale)
{
    char spot[100];
    char *more[] = {"--object", square, "--at", "48,60", "--scale", scale, "--light", spot};
    report r = {""};
    float rgb[2][3];
    snprintf(spot, sizeof spot, "%s", light);
    mix_job *j = begin(more, 8);
    j->o.shadow_map = texels;
    set_depth(j, 2.5f, 1);
    CHECK_MSG(place(j) && mix_light(j, &r) && mix_voxels(j, &r), "%s", r.text);
    for (int i = 0; i < 2; ++i) {
        lmb_env_irradiance(rgb[i], &j->env[i], (lmb_vec3){0, 1, 0});
    }
    *around = rgb[1][1] / rgb[0][1];
    const double flux = j->voxels.flux[0] + j->voxels.lost[0];
    mix_job_free(j);
    return flux;
}

/* All of a light's map counts, also where several of its texels are one first point. */
static void maps_count_whole(void)
{
    static const char spot[] = "spot:0,1,-1.6:0,-1,0:9,9,9:30,40";
    float around;
    const double fine = lamp_flux(&around, 1024, spot, "0.2"), coarse = lamp_flux(&around, 512, spot, "0.2");
    CHECK_MSG(fabs(fine - coarse) < 0.02 * coarse, "%g W, %g W", fine, coarse);
}

/* What is around darkens by what the object takes of a lamp's light: nothing where it stands beside that, the more the
 * larger it is, and of a sun nothing. */
static void around_darkens(void)
{
    float small, large, beside, sunny;
    lamp_flux(&small, 128, "spot:0,1,-1.1:0,-1,0:9,9,9:30,40", "0.05");
    lamp_flux(&large, 128, "spot:0,1,-1.1:0,-1,0:9,9,9:30,40", "0.3");
    lamp_flux(&beside, 128, "spot:0,1,-2.2:0,-1,0:9,9,9:10,15", "0.05");
    lamp_flux(&sunny, 128, "sun:0,0,0:0.1,-1,-0.1:2,2,2", "0.3");
    CHECK_MSG(beside == 1.0f && sunny == 1.0f && fabsf(small - 1.0f) < 0.01f && fabsf(large - 1.0f) > fabsf(small - 1.0f),
              "beside %g, small %g, large %g, under a sun %g", (double)beside, (double)small, (double)large,
              (double)sunny);
}

void test_mix(void)
{
    maps_count_whole();
    around_darkens();
    stands_on_floor();
    gap_is_seen();
    size_is_kept();
    no_floor();
    albedo_is_told();
    nothing_changes();
}
