/* test_mix_cones.c: surrounding light, traced at some pixels and interpolated between them, against tracing all pixels.
 * [M21] */
#include "../folder.h"

#include <math.h>

#include "../../tools/mix/mix_carry.h"
#include "../../tools/mix/mix_world.h"
#include "../photo_job.h"
#include "../test.h"

void test_mix_cones(void);

enum { WIDTH = 160, HEIGHT = 120, PIXELS = WIDTH * HEIGHT };

static const lmb_pinhole camera = {WIDTH, HEIGHT, 131.25f, 131.25f, 79.5f, 59.5f};

/* A ball at the origin, or a box. */
static size_t put_mesh(char *out, size_t size, int is_box)
{
    enum { RINGS = 10, TURNS = 20 };
    size_t n = 0;
    if (is_box) {
        return (size_t)snprintf(out, size, "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv -1 2 -1\nv 1 2 -1\nv 1 2 1\nv -1 2 1\n"
                                           "f 1 2 3 4\nf 8 7 6 5\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n");
    }
    for (int i = 0; i <= RINGS * TURNS + TURNS - 1; ++i) {
        const double down = 3.14159265 * (i / TURNS) / RINGS, turn = 6.2831853 * (i % TURNS) / TURNS;
        n += (size_t)snprintf(out + n, size - n, "v %.5f %.5f %.5f\n", sin(down) * cos(turn), 1.0 - cos(down), sin(down) * sin(turn));
    }
    for (int i = 0; i < RINGS * TURNS; ++i) {
        const int a = i + 1, b = i / TURNS * TURNS + (i + 1) % TURNS + 1;
        n += (size_t)snprintf(out + n, size - n, "f %d %d %d %d\n", a, a + TURNS, b + TURNS, b);
    }
    return n;
}

/* A floor and a rotated wall; the photo is brighter on one side. */
static mix_job *begin(char *object, const char *at, const char *light, float turn)
{
    static char place[20], sun[60];
    char *argv[] = {"mix", "--frame", "known", "--object", object, "--scale", "0.15", "--at", place, "--light", sun,
                    "--voxels", "6", "--shadow-map", "256", "-q", "-o", "known.pfm", NULL};
    report r = {""};
    snprintf(place, sizeof place, "%s", at);
    snprintf(sun, sizeof sun, "%s", light);
    mix_job *j = photo_job(18, argv, &camera);
    for (int i = 0; i < PIXELS; ++i) {
        const lmb_vec3 ray = lmb_cloud_ray(&camera, (float)(i % WIDTH), (float)(i / WIDTH));
        const float floor = ray.y < -0.01f ? -0.7f / ray.y : 1e9f, wall = 2.4f / (1.0f + turn * ray.x);
        j->frame.depth[i] = floor < wall ? floor : wall;
        for (int c = 0; c < 3; ++c) {
            j->frame.light.pixels[3 * i + c] = 0.2f + 0.1f * (float)c + 0.2f * (float)(i % WIDTH) / WIDTH;
        }
    }
    CHECK_MSG(mix_find_planes(j, &r) && mix_place(j, &r) && mix_light(j, &r) && mix_voxels(j, &r), "%s", r.text);
    return j;
}

/* The share of a pixel's light that remains with the object. */
static double left_of(const lmb_irradiance light[2], int k)
{
    double sum[2] = {0.0, 0.0};
    for (int c = 0; c < 6; ++c) {
        sum[c / 3] += (double)light[c / 3].rgb[c % 3][k];
    }
    return sum[0] > 0.0 ? sum[1] / sum[0] : 1.0;
}

/* For a job's real pixels: RMS and largest error of the remaining light, if the object takes some; and the number of
 * traced pixels. */
typedef struct figures {
    double square, worst, near;
    int traced, all;
} figures;

static void add_tile(figures *f, const mix_job *j, const mix_batch *b)
{
    static lmb_irradiance dense[2];
    const lmb_tile *tile = &b->real[0];
    memset(dense, 0, sizeof dense);
    for (int world = 0; world < 2; ++world) {
        const lmb_cone_trace trace = mix_trace(j, world);
        CHECK(lmb_cones_diffuse(&dense[world], NULL, &trace, &j->world->cones, tile) == LMB_OK);
    }
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        if (tile->id[k] != 0) {
            const lmb_irradiance ours[2] = {b->light[0][0], b->light[1][0]};
            const double want = left_of(dense, k), off = left_of(ours, k) - want;
            f->traced += dense[1].rgb[0][k] == b->light[1][0].rgb[0][k] && dense[0].rgb[0][k] == b->light[0][0].rgb[0][k];
            ++f->all;
            f->near += fabs(want - 1.0) > 0.02;
            f->square += fabs(want - 1.0) > 0.02 ? off * off : 0.0;
            f->worst = fabs(off) > f->worst ? fabs(off) : f->worst;
        }
    }
}

static figures measure(char *object, const char *at, const char *light, float turn)
{
    static mix_batch b;
    figures f = {0.0, 0.0, 0.0, 0, 0};
    mix_job *j = begin(object, at, light, turn);
    for (int i = 0; i < PIXELS / LMB_TILE_PIXELS; ++i) {
        b.count = 1;
        lmb_real_tile(&b.real[0], &j->cloud, &j->planes, &j->real, &j->axes, i % (WIDTH / LMB_TILE) * LMB_TILE,
                      i / (WIDTH / LMB_TILE) * LMB_TILE);
        mix_cones_batch(&b, j);
        add_tile(&f, j, &b);
    }
    mix_job_free(j);
    return f;
}

/* A pixel unknown from the previous frame takes the light of the nearest pixel on the same surface, and of no other. */
static void spreads_on_its_own_surface(void)
{
    static lmb_tile t;
    static lmb_irradiance without, with;
    memset(&t, 0, sizeof t);
    memset(&without, 0, sizeof without);
    memset(&with, 0, sizeof with);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) { /* columns 0 to 3 face the camera, the others left; row 7 is empty */
        t.id[k] = k / LMB_TILE < 7;
        t.position[0][k] = 0.01f * (float)(k % LMB_TILE);
        t.position[1][k] = -0.01f * (float)(k / LMB_TILE);
        t.position[2][k] = -1.0f;
        t.normal[k % LMB_TILE < 4 ? 2 : 0][k] = k % LMB_TILE < 4 ? 1.0f : -1.0f;
    }
    without.rgb[1][8 + 1] = 3.0f;
    with.rgb[2][8 + 1] = 4.0f;
    without.rgb[1][8 + 7] = 5.0f;
    const uint64_t carried = (uint64_t)1 << (8 + 1) | (uint64_t)1 << (8 + 7),
                   found = mix_carry_spread(&without, &with, &t, carried, ~carried);
    CHECK(found == 0x8f8f0d8fu); /* two rows and columns around (1, 1); only the column of (7, 1) lies on its plane */
    CHECK(without.rgb[1][0] == 3.0f && with.rgb[2][3 * LMB_TILE + 3] == 4.0f && without.rgb[1][8 + 6] == 0.0f);
    CHECK(mix_carry_spread(&without, &with, &t, 0, ~carried) == 0);
}

/* Light along an arc of a ball has no stripes: fine voxels drew contours, because each point saw other parts of the
 * ball's own voxels. */
static void balls_have_no_stripes(char *ball)
{
    mix_job *j = begin(ball, "80,90", "none", 0.0f);
    lmb_vec3 low, high;
    lmb_tile tile;
    lmb_irradiance light;
    double stripes = 0.0;
    memset(&tile, 0, sizeof tile);
    memset(&light, 0, sizeof light);
    mix_object_box(&low, &high, j);
    const float radius = 0.5f * (high.y - low.y), middle[3] = {0.5f * (low.x + high.x), 0.5f * (low.y + high.y), 0.5f * (low.z + high.z)};
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const float up = 0.3f + 0.015f * (float)k, n[3] = {0.4f * cosf(up), sinf(up), 0.9165f * cosf(up)};
        for (int c = 0; c < 3; ++c) {
            tile.position[c][k] = middle[c] + radius * n[c];
            tile.face[c][k] = tile.normal[c][k] = n[c];
        }
        tile.depth[k] = 1.0f;
        tile.id[k] = 1;
    }
    mix_cones_tile(&light, j, &tile);
    for (int k = 4; k < LMB_TILE_PIXELS - 4; ++k) {
        const float *at = light.rgb[1] + k;
        stripes = fmax(stripes, fabs(1.0 - 0.5 * (double)(at[-4] + at[4]) / (double)at[0]));
    }
    CHECK_MSG(light.rgb[1][0] > 0.0f && stripes < 0.01, "stripes of %g", stripes);
    mix_job_free(j);
}

/* With half of the difference limit for tracing whole tiles 8,812 pixels are traced; with twice the limit the error is
 * 0.03. */
void test_mix_cones(void)
{
    spreads_on_its_own_surface();
    static char text[40000];
    static folder f;
    char path[2][FOLDER_PATH];
    folder_open(&f);
    for (int is_box = 0; is_box < 2; ++is_box) {
        strcpy(path[is_box], folder_put(&f, is_box ? "box.obj" : "ball.obj", text, put_mesh(text, sizeof text, is_box)));
    }
    balls_have_no_stripes(path[0]);
    const figures of[4] = {measure(path[0], "70,90", "sun:0,0,0:0.5,-0.6,-0.3:2,2,2", 0.2f),
                           measure(path[1], "100,85", "sun:0,0,0:0.5,-0.6,-0.3:2,2,2", 0.2f),
                           measure(path[0], "90,100", "point:0.6,0.5,-1:0,-1,0:2,2,1", -0.3f),
                           measure(path[1], "50,95", "point:-0.6,0.6,-0.8:0,-1,0:1,2,2", -0.1f)};
    int traced = 0;
    for (int i = 0; i < 4; ++i) {
        const double rms = sqrt(of[i].square / of[i].near);
        CHECK_MSG(of[i].near > 1000.0 && rms < 0.02 && of[i].worst < 0.25, "scene %d: %g, at most %g, at %g pixels", i, rms,
                  of[i].worst, of[i].near);
        traced += of[i].traced;
    }
    CHECK_MSG(traced < 8200, "%d pixels of %d are traced", traced, 4 * PIXELS);
    folder_close(&f);
}
