/* test_mix_sources.c: light that an object emits or reflects, against closed forms: an emissive square, a metal square
 * under a lamp; and the effect of a texel's emission and a metal's reflected beam on a photo. [M20 M25] */
#include "../folder.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../tools/mix/mix_sources.h"
#include "../photo_job.h"
#include "../test.h"

void test_mix_sources(void);

#define PI 3.14159265358979

/* --- patches against closed forms --------------------------------------------------------------------------------- */

enum { SIDE = 16 };

static mix_patch pieces[SIDE * SIDE];
static mix_sources square = {.piece = pieces, .first = {0, SIDE * SIDE}};

/* A unit square at height 1 that faces down and emits or reflects `flux` W. */
static void set_square(float flux, float alpha2, lmb_vec3 from)
{
    for (int i = 0; i < SIDE * SIDE; ++i) {
        mix_patch *p = &pieces[i];
        memset(p, 0, sizeof *p);
        p->at = (lmb_vec3){((float)(i % SIDE) + 0.5f) / SIDE - 0.5f, 1.0f, ((float)(i / SIDE) + 0.5f) / SIDE - 0.5f};
        p->normal = (lmb_vec3){0, -1, 0};
        p->from = from;
        p->alpha2 = alpha2;
        p->area = 1.0f / (SIDE * SIDE);
        p->flux[0] = p->flux[1] = p->flux[2] = flux / (SIDE * SIDE);
        p->arrives[0] = p->arrives[1] = p->arrives[2] = alpha2 > 0.0f ? flux / (SIDE * SIDE) : 0.0f;
    }
}

/* For a point directly below a corner of a parallel rectangle a x b at height c: Howell's B-3. */
static double corner_factor(double a, double b, double c)
{
    const double x = a / c, y = b / c, p = sqrt(1.0 + x * x), q = sqrt(1.0 + y * y);
    return (x / p * atan(y / p) + y / q * atan(x / q)) / (2.0 * PI);
}

static void emits_by_form_factors(void)
{
    const float flux = 3.0f;
    set_square(flux, 0.0f, (lmb_vec3){0, 0, 0});
    for (int i = 0; i < 5; ++i) {
        const double far = 0.25 + 0.3 * i; /* below the square's centre, at this distance */
        const lmb_vec3 at = {0.0f, (float)(1.0 - far), 0.0f}, up = {0, 1, 0};
        float rgb[3];
        mix_sources_at(rgb, &square, 0, at, up);
        const double want = (double)flux * 4.0 * corner_factor(0.5, 0.5, far); /* the exitance is the flux over 1 m2 */
        CHECK_MSG(fabs((double)rgb[1] - want) < 0.02 * want, "%g m: %g, not %g", far, (double)rgb[1], want);
    }
    float behind[3];
    mix_sources_at(behind, &square, 0, (lmb_vec3){0, 1.5f, 0}, (lmb_vec3){0, -1, 0});
    CHECK(behind[0] == 0.0f);
}

/* The light of a perfectly reflecting metal arrives on the hemisphere around it, except for the lobe's loss between
 * facets, and mostly near the mirror direction. */
static void reflects_what_arrives(void)
{
    enum { RINGS = 64, TURNS = 128 };
    const lmb_vec3 from = {0.6f, -0.8f, 0.0f};
    for (int k = 0; k < 3; ++k) {
        const float alpha2 = k == 0 ? 0.0016f : k == 1 ? 0.0256f : 0.25f, far = 40.0f;
        double sum = 0.0, along = 0.0;
        set_square(2.0f, alpha2, from);
        for (int i = 0; i < RINGS * TURNS; ++i) { /* of equal area */
            const double high = (i / TURNS + 0.5) / RINGS, turn = 2.0 * PI * (i % TURNS + 0.5) / TURNS, out = sqrt(1.0 - high * high);
            const lmb_vec3 d = {(float)(out * cos(turn)), (float)-high, (float)(out * sin(turn))},
                           at = {far * d.x, 1.0f + far * d.y, far * d.z}, back = {-d.x, -d.y, -d.z};
            float rgb[3];
            mix_sources_at(rgb, &square, 0, at, back);
            const double watts = (double)(rgb[0] * far * far) * 2.0 * PI / (RINGS * TURNS);
            sum += watts;
            along += watts * (double)(-0.6f * d.x - 0.8f * d.y > 0.94f);
        }
        CHECK_MSG(sum > (k < 2 ? 1.9 : 1.3) && sum < 2.05, "alpha^2 %g: %g W of 2", (double)alpha2, sum);
        CHECK_MSG(k == 2 || along > (k == 0 ? 0.95 : 0.6) * sum, "alpha^2 %g: %g of %g W", (double)alpha2, along, sum);
    }
}

/* --- in a photo --------------------------------------------------------------------------------------------------- */

enum { WIDTH = 96, HEIGHT = 72, PIXELS = WIDTH * HEIGHT };

static const lmb_pinhole camera = {WIDTH, HEIGHT, 80.0f, 80.0f, 47.5f, 35.5f};
static char quads[] = "tests/fuzz/corpus/obj/quads.obj"; /* upright, one unit wide and high */

/* A grey floor half a metre below the camera and a grey wall in front, lit by a lamp; the object is a square a third of
 * a metre wide in front of the wall. */
static mix_job *draw_square(const lmb_material *look, const char *at, const char *turn, const char *lamp)
{
    char place[20], turned[20], light[60];
    char *argv[] = {"mix", "--frame", "known", "--voxels", "5", "--shadow-map", "256", "-o", "known.pfm", "--object", quads,
                    "--at", place, "--scale", "0.3", "--turn", turned, "--light", light, "--quiet"};
    report r = {""};
    snprintf(place, sizeof place, "%s", at);
    snprintf(turned, sizeof turned, "%s", turn);
    snprintf(light, sizeof light, "%s", lamp);
    mix_job *j = photo_job(20, argv, &camera);
    for (int i = 0; i < PIXELS; ++i) {
        const lmb_vec3 ray = lmb_cloud_ray(&camera, (float)(i % WIDTH), (float)(i / WIDTH));
        const float floor = ray.y < -0.01f ? -0.5f / ray.y : 1e9f;
        j->frame.depth[i] = floor < 1.6f ? floor : 1.6f;
        j->frame.light.pixels[3 * i] = j->frame.light.pixels[3 * i + 1] = j->frame.light.pixels[3 * i + 2] = 0.3f;
    }
    CHECK_MSG(mix_find_planes(j, &r) && mix_place(j, &r), "%s", r.text);
    photo_draw(j, look);
    return j;
}

/* A metal square reflects a lamp's light onto the floor on the lamp's side; a matt black one does not. The metal once
 * acted as matt, with a black foot. */
static void beam_lights_floor(void)
{
    static const char lamp[] = "point:0,0.5,-0.6:0,-1,0:3,3,3";
    lmb_material look = {.alpha = 1.0f, .texture = -1, .roughness = 0.3f, .flags = LMB_DOUBLE_SIDED};
    mix_job *j = draw_square(&look, "48,62", "0", lamp);
    const float dark = photo_mean(j, 42, 66, 54, 71);
    mix_job_free(j);
    look.specular[0] = look.specular[1] = look.specular[2] = 0.95f;
    j = draw_square(&look, "48,62", "0", lamp);
    const float lit = photo_mean(j, 42, 66, 54, 71);
    CHECK(j->lamp_count == 1 && j->sources != NULL);
    CHECK_MSG(lit > 1.15f * dark && lit > 0.3f, "%g by black, %g by metal", (double)dark, (double)lit);
    mix_job_free(j);
}

/* Smooth metal reflects the floor in front down to the foot; cones through voxels gave black there. The mean equals
 * that of the floor, which the reflected beam brightens. */
static void foot_mirrors_floor(void)
{
    lmb_material look = {.alpha = 1.0f, .texture = -1, .roughness = 0.2f, .flags = LMB_DOUBLE_SIDED};
    look.specular[0] = look.specular[1] = look.specular[2] = 0.95f;
    mix_job *j = draw_square(&look, "48,62", "0", "point:0,0.5,-0.6:0,-1,0:3,3,3");
    const float foot = photo_mean(j, 44, 57, 52, 61), floor = photo_mean(j, 44, 64, 52, 68);
    CHECK_MSG(foot > 0.6f * floor && foot < 1.2f * floor, "the foot shows %g, the floor %g", (double)foot, (double)floor);
    mix_job_free(j);
}

/* An emissive object has pieces of at most a twentieth of its width: larger ones would be nearer to the foot than they
 * are wide. */
static void patches_are_small(void)
{
    lmb_material look = {.alpha = 1.0f, .texture = -1, .roughness = 1.0f, .flags = LMB_DOUBLE_SIDED};
    look.emission[0] = look.emission[1] = look.emission[2] = 2.0f;
    mix_job *j = draw_square(&look, "48,62", "0", "point:0,0.5,-0.6:0,-1,0:3,3,3");
    const double side = sqrt((double)j->sources->piece[0].area);
    CHECK_MSG(side > 0.0 && side < 0.3 / 20.0, "patches of %g m", side);
    mix_job_free(j);
}

/* --- glowing objects on the floor --------------------------------------------------------------------------------- */

/* A ball as .obj, front sides outwards. */
static int ball_text(char *out, size_t size, double radius)
{
    enum { RINGS = 16, TURNS = 32 };
    int n = 0;
    for (int i = 0; i <= RINGS; ++i) {
        for (int k = 0; k < TURNS; ++k) {
            const double a = PI * i / RINGS, b = 2.0 * PI * k / TURNS;
            n += snprintf(out + n, size - (size_t)n, "v %.6f %.6f %.6f\n", radius * sin(a) * cos(b), -radius * cos(a),
                          -radius * sin(a) * sin(b));
        }
    }
    for (int i = 0; i < RINGS; ++i) {
        for (int k = 0; k < TURNS; ++k) {
            const int a = i * TURNS + k + 1, b = i * TURNS + (k + 1) % TURNS + 1;
            n += snprintf(out + n, size - (size_t)n, "f %d %d %d %d\n", a, b, b + TURNS, a + TURNS);
        }
    }
    return n;
}

/* W/m2 from a ball of radius r on a floor at distance `far` from the foot, for 1 W/(m2 sr). */
static double ball_light(double r, double far)
{
    const double d = sqrt(far * far + r * r);
    return PI * r * r * r / (d * d * d);
}

/* Light of a glowing ball on the floor around and below it, by distance. Below it nothing arrived once, because the
 * light source for the lower side lay in the floor and the ball blocked it. */
static void ball_lights_its_foot(double radius)
{
    static folder f;
    static char text[80000];
    char path[FOLDER_PATH];
    double sum[6] = {0}, want[6] = {0}, off = 0.0;
    int count = 0;
    lmb_material look = {.alpha = 1.0f, .texture = -1, .roughness = 1.0f};
    report r = {""};
    folder_open(&f);
    const int size = ball_text(text, sizeof text, radius);
    strcpy(path, folder_put(&f, "ball.obj", text, (size_t)size));
    char *argv[] = {"mix", "--frame", "known", "--voxels", "5", "--shadow-map", "256", "-o", "known.pfm", "--object", path,
                    "--at", "48,58", "--light", "sun:0,0,0:0.2,-1,-0.1:1,1,1", "--quiet"};
    mix_job *j = photo_job(16, argv, &camera);
    for (int i = 0; i < PIXELS; ++i) {
        const lmb_vec3 ray = lmb_cloud_ray(&camera, (float)(i % WIDTH), (float)(i / WIDTH));
        j->frame.depth[i] = ray.y < -0.01f && -0.5f / ray.y < 2.5f ? -0.5f / ray.y : 2.5f;
        j->frame.light.pixels[3 * i] = j->frame.light.pixels[3 * i + 1] = j->frame.light.pixels[3 * i + 2] = 0.2f;
    }
    CHECK_MSG(mix_find_planes(j, &r) && mix_place(j, &r), "%s", r.text);
    look.emission[0] = look.emission[1] = look.emission[2] = 5.0f;
    photo_draw(j, &look);
    const lmb_vec3 foot = lmb_axes_turn(&j->axes, j->anchor);
    for (int t = 0; t < PIXELS / LMB_TILE_PIXELS; ++t) {
        static lmb_tile tile;
        static lmb_irradiance light;
        lmb_real_tile(&tile, &j->cloud, &j->planes, &j->real, &j->axes, t % (WIDTH / LMB_TILE) * LMB_TILE,
                      t / (WIDTH / LMB_TILE) * LMB_TILE);
        memset(&light, 0, sizeof light);
        for (int32_t i = j->light_count - j->lamp_count; i < j->light_count; ++i) {
            mix_sources_tile(&light, j, &tile, i, 1);
        }
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            const double far = hypot((double)(tile.position[0][k] - foot.x), (double)(tile.position[2][k] - foot.z)) / radius;
            if (tile.id[k] != 0 && tile.normal[1][k] > 0.99f && far > 0.25 && far < 3.0) {
                const double one = 5.0 * ball_light(radius, far * radius);
                sum[(int)(2.0 * far)] += (double)light.rgb[1][k];
                want[(int)(2.0 * far)] += one;
                off += pow((double)light.rgb[1][k] / one - 1.0, 2.0);
                ++count;
            }
        }
    }
    for (int i = 0; i < 6; ++i) {
        CHECK_MSG(want[i] > 0.0 && fabs(sum[i] / want[i] - 1.0) < (i == 0 ? 0.2 : 0.08), "%.1f radii from the foot of %g m: %.2f of the light", 0.5 * i,
                  radius, sum[i] / want[i]);
    }
    CHECK_MSG(sqrt(off / count) < 0.1, "%g m: off by %g", radius, sqrt(off / count));
    mix_job_free(j);
    folder_close(&f);
}

void test_mix_sources(void)
{
    ball_lights_its_foot(0.2);
    ball_lights_its_foot(0.11);
    patches_are_small();
    foot_mirrors_floor();
    emits_by_form_factors();
    reflects_what_arrives();
    beam_lights_floor();
}
