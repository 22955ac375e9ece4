/* test_mix.c: the steps of `lambent mix` on a photo of a known floor and wall: placement of the object, reflectance of
 * the surfaces, and photos without a surface to place it on. [M4 M5 M7 M24] */
#include "../folder.h"

#include <math.h>

#include "../../tools/mix/mix_front.h"
#include "../../tools/mix/mix_lights.h"
#include "../photo_job.h"
#include "../test.h"

void test_mix(void);

enum { WIDTH = 96, HEIGHT = 72, PIXELS = WIDTH * HEIGHT };

static const float GREY = 0.3f;
static const lmb_pinhole camera = {WIDTH, HEIGHT, 80.0f, 80.0f, 47.5f, 35.5f};
static char square[] = "tests/fuzz/corpus/obj/quads.obj"; /* upright, one unit wide and high */

#define RED  "point:-0.6,0.5,-1.2:0,-1,0:2,0,0"
#define BLUE "point:0.6,0.5,-1.2:0,-1,0:0,0,2"

/* A job with a grey photo and `more` options. */
static mix_job *begin(char *const *more, int count)
{
    char *argv[24] = {"mix", "--frame", "known", "--voxels", "4", "--shadow-map", "64", "-o", "known.pfm"};
    for (int i = 0; i < count; ++i) {
        argv[9 + i] = more[i];
    }
    mix_job *j = photo_job(9 + count, argv, &camera);
    for (int i = 0; i < 3 * PIXELS; ++i) {
        j->frame.light.pixels[i] = GREY;
    }
    return j;
}

/* A wall at `far`, and optionally a floor half a metre below the camera. */
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

/* --- placement ---------------------------------------------------------------------------------------------------- */

static void stands_on_floor(void)
{
    char *object[] = {"--object", square, "--fit"};
    mix_job *j = begin(object, 3);
    set_depth(j, 2.5f, 1);
    CHECK(place(j) && j->faces_up && j->inside && j->floor >= 0);
    CHECK_MSG(fabsf(j->anchor.y + 0.5f) < 1e-3f && fabsf(j->gap_m) < 1e-3f, "%g %g", (double)j->anchor.y,
              (double)j->gap_m);
    /* One sixth of the floor's shorter side, or less if the picture has no room. */
    CHECK_MSG(j->scale > 0.05f && j->scale < 0.4f, "%g", (double)j->scale);
    mix_job_free(j);
}

/* The measured floor is `step` below the plane: the object and the plane move there. A step larger than sensors distort
 * a plane is kept and reported. */
static void touches(float step, int goes)
{
    char *object[] = {"--object", square};
    mix_job *j = begin(object, 2);
    report r = {""};
    set_depth(j, 2.5f, 1);
    CHECK(mix_find_planes(j, &r));
    for (int i = 0; i < PIXELS; ++i) {
        j->frame.depth[i] += step;
    }
    CHECK(mix_place(j, &r));
    CHECK_MSG(fabsf(j->gap_m - (goes ? 0.0f : step)) < 5e-4f, "%g", (double)j->gap_m);
    const lmb_flat *p = &j->planes.plane[j->floor];
    CHECK_MSG(fabsf(p->normal.x * j->anchor.x + p->normal.y * j->anchor.y + p->normal.z * j->anchor.z + p->distance) <
                  1e-5f && p->normal.y > 0.999f, "%g", (double)p->distance);
    const lmb_vec3 seen = lmb_cloud_point(&j->cloud, 48, 68);
    CHECK_MSG(fabsf(p->normal.x * seen.x + p->normal.y * seen.y + p->normal.z * seen.z + p->distance) < 1e-5f, "%g",
              (double)seen.y);
    mix_job_free(j);
}

/* An explicit size is kept and reported as too large. */
static void size_is_kept(void)
{
    char *object[] = {"--object", square, "--scale", "1.5"};
    mix_job *j = begin(object, 4);
    set_depth(j, 2.5f, 1);
    CHECK(place(j) && j->scale == 1.5f && !j->inside);
    mix_job_free(j);
}

/* A room with a floor, a table on it and a wall behind. The camera is pitched down a little. */
typedef struct room {
    float height, pitch, table, wall; /* m: of the camera, of the table top, distance to the wall */
    float low[2], high[2];            /* of the table: x and distance */
} room;

static room random_room(test_rng *rng)
{
    const float wall = test_uniform(rng, 2.5f, 4.0f), left = test_uniform(rng, -1.0f, 0.0f);
    const room r = {test_uniform(rng, 1.2f, 1.7f), test_uniform(rng, 0.35f, 0.6f), test_uniform(rng, 0.5f, 0.8f), wall,
                    {left, 1.2f}, {left + test_uniform(rng, 0.9f, 1.2f), 1.2f + test_uniform(rng, 0.6f, 0.8f)}};
    return r;
}

/* A ray rotated by the pitch into the room, in which the floor is y = -height. */
static lmb_vec3 room_ray(const room *r, lmb_vec3 ray)
{
    const float c = cosf(r->pitch), s = sinf(r->pitch);
    const lmb_vec3 out = {ray.x, c * ray.y + s * ray.z, c * ray.z - s * ray.y};
    return out;
}

static void set_room(mix_job *j, const room *r)
{
    for (int i = 0; i < PIXELS; ++i) {
        const lmb_vec3 ray = room_ray(r, lmb_cloud_ray(&camera, (float)(i % WIDTH), (float)(i / WIDTH)));
        float far = r->wall / -ray.z;
        const float floor = ray.y < 0.0f ? -r->height / ray.y : 1e9f,
                    table = ray.y < 0.0f ? (r->table - r->height) / ray.y : 1e9f;
        const float x = ray.x * table, z = -ray.z * table;
        far = floor < far ? floor : far;
        far = table < far && x > r->low[0] && x < r->high[0] && z > r->low[1] && z < r->high[1] ? table : far;
        j->frame.depth[i] = far;
    }
}

/* The object's height over the floor and distance to the wall. */
static void stands_at(float *high, float *before, const mix_job *j, const room *r)
{
    const lmb_vec3 at = room_ray(r, j->anchor);
    *high = at.y + r->height;
    *before = r->wall + at.z;
}

/* Random rooms: seeds under 100 were used for development, the others were held out. */
static void stands_on_what_is_asked(void)
{
    static const char *const ons[] = {"floor", "table", "wall"};
    for (int seed = 0; seed < 124; seed += seed == 11 ? 89 : 1) {
        test_rng rng = {(uint32_t)seed + 1};
        const room rm = random_room(&rng);
        for (int k = 0; k < 3; ++k) {
            char on[8];
            char *more[] = {"--object", square, "--on", on, "--fit", "--quiet"};
            float high, before;
            strcpy(on, ons[k]);
            mix_job *j = begin(more, 6);
            set_room(j, &rm);
            CHECK_MSG(place(j), "%d %s", seed, on);
            stands_at(&high, &before, j, &rm);
            CHECK_MSG(k == 2 ? fabsf(before) < 0.02f : fabsf(high - (k == 0 ? 0.0f : rm.table)) < 0.02f,
                      "seed %d, %s: %g over the floor, %g before the wall", seed, on, (double)high, (double)before);
            CHECK_MSG(j->inside && j->hangs == (k == 2), "seed %d, %s", seed, on);
            mix_job_free(j);
        }
    }
}

/* A steep floor below a panel that protrudes from the wall stays as measured: the mean of the pixels below would lie in
 * front of the panel. */
static void floor_stays(void)
{
    static float front[PIXELS];
    static mix_way way[PIXELS];
    static const int32_t all[4] = {0, 0, WIDTH, HEIGHT};
    char *object[] = {"--object", square};
    mix_job *j = begin(object, 2);
    report r = {""};
    set_depth(j, 2.5f, 1);
    for (int i = 0; i < PIXELS; ++i) {
        const int x = i % WIDTH, y = i / WIDTH;
        j->frame.depth[i] = x > 20 && x < 70 && y > 15 && y < 49 ? 2.2f : j->frame.depth[i];
    }
    CHECK(mix_find_planes(j, &r));
    mix_front_refine(front, way, &j->cloud, &j->planes, j->frame.light.pixels, all);
    int doubtful = 0, off = 0;
    for (int i = 55 * WIDTH; i < 62 * WIDTH; ++i) {
        doubtful += way[i].is_doubtful;
        off += fabsf(front[i] / j->cloud.inverse[i] - 1.0f) > 0.02f;
    }
    for (int i = 52 * WIDTH; i < 55 * WIDTH; ++i) {
        doubtful += way[i].is_doubtful;
        off += front[i] > 1.02f * j->cloud.inverse[i] && j->planes.label[i] != 0 &&
               j->planes.plane[j->planes.label[i] - 1].normal.y > 0.9f;
    }
    CHECK_MSG(doubtful > 40 && off == 0, "%d of %d", off, doubtful);
    mix_job_free(j);
}

/* A table on a floor, no wall. The table's edge is vertical but too thin to be a wall; a chest's front is thick
 * enough. */
static void edge_is_no_wall(float thick, int is_wall)
{
    static const room looks_down = {.pitch = 0.5f};
    char *wall[] = {"--object", square, "--on", "wall", "--scale", "0.05"};
    mix_job *j = begin(wall, 6);
    report r = {""};
    for (int i = 0; i < PIXELS; ++i) {
        const lmb_vec3 ray = room_ray(&looks_down, lmb_cloud_ray(&camera, (float)(i % WIDTH), (float)(i / WIDTH)));
        const float top = ray.y < -0.01f ? -0.5f / ray.y : 1e9f, front = 1.0f / -ray.z, low = -0.5f - thick;
        const int is_top = top > front && -ray.z * top < 2.2f, is_front = ray.y * front < -0.5f && ray.y * front > low;
        j->frame.depth[i] = is_top ? top : is_front ? front : fminf(2.6f * top, 8.0f); /* the floor, 1.3 m down */
    }
    CHECK(mix_find_planes(j, &r) && j->planes.count >= 2);
    CHECK_MSG(mix_place(j, &r) == is_wall && (is_wall ? j->hangs : strstr(r.text, "--on wall: no plane") != NULL), "%s",
              r.text);
    mix_job_free(j);
}

/* If there is no such surface, the error names the missing kind. */
static void asked_for_nothing(void)
{
    char *table[] = {"--object", square, "--on", "table"};
    report r = {""};
    mix_job *j = begin(table, 4);
    set_depth(j, 2.5f, 1);
    CHECK(mix_find_planes(j, &r) && !mix_place(j, &r) && strstr(r.text, "--on table: no plane") != NULL);
    mix_job_free(j);
}

/* Without --fit and --scale one unit is a metre, even if that is absurd. If the object can be entirely visible, it
 * is. */
static void metres_are_its_own(void)
{
    static const struct size {
        const char *scale;
        float want;
        int inside;
    } sizes[] = {{NULL, 1.0f, 1}, {"0.25", 0.25f, 1}, {"0.5", 0.5f, 1}, {"100", 100.0f, 0}, {"1e-4", 1e-4f, 1}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; ++i) {
        char scale[8];
        char *more[] = {"--object", square, "--scale", scale};
        strcpy(scale, sizes[i].scale != NULL ? sizes[i].scale : "");
        mix_job *j = begin(more, sizes[i].scale != NULL ? 4 : 2);
        set_depth(j, 2.5f, 1);
        CHECK(place(j) && j->scale == sizes[i].want);
        CHECK_MSG(j->inside == sizes[i].inside, "%zu", i);
        CHECK(i < 3 || (i == 3 ? j->seen_px > 200.0f : j->seen_px < 0.1f));
        mix_job_free(j);
    }
}

/* A needle along the diagonal of its bounding box: the box would appear far wider than the needle. */
static void size_by_its_own(void)
{
    static const char needle[] = "v -1 0 -1\nv 1 2 1\nv 1 2.01 1\nv -1 0.01 -1\nf 1 2 3 4\nf 4 3 2 1\n";
    static folder f;
    char path[FOLDER_PATH];
    folder_open(&f);
    strcpy(path, folder_put(&f, "needle.obj", needle, sizeof needle - 1));
    for (int turn = 45; turn >= -45; turn -= 90) {
        char angle[8];
        char *more[] = {"--object", path, "--scale", "0.1", "--turn", angle};
        snprintf(angle, sizeof angle, "%d", turn);
        mix_job *j = begin(more, 6);
        set_depth(j, 2.5f, 1);
        CHECK(place(j));
        CHECK_MSG(turn > 0 ? j->seen_px > 11.0f : j->seen_px < 7.0f, "turned by %d: %g px", turn, (double)j->seen_px);
        mix_job_free(j);
    }
    folder_close(&f);
}

/* One wall, no floor: the object hangs upright, and faces_up is 0. The same holds if --at selects the wall. If it lay
 * on the wall as on a floor, it would stick out sideways. */
static void no_floor(void)
{
    char *object[] = {"--object", square, "--at", "48,10"};
    for (int at = 0; at < 2; ++at) {
        mix_job *j = begin(object, at ? 4 : 2);
        set_depth(j, 2.5f, at);
        CHECK(place(j) && j->faces_up == at && j->hangs && j->up.y > 0.999f && j->placed.m[5] > 0.0f);
        CHECK(fabsf(j->placed.m[4]) < 1e-3f && fabsf(j->placed.m[6]) < 1e-3f && fabsf(j->anchor.z + 2.5f) < 1e-3f);
        mix_job_free(j);
    }
    mix_job *j;
    j = begin(object, 2);
    memset(j->frame.depth, 0, PIXELS * sizeof(float));
    CHECK(!place(j));
    mix_job_free(j);
}

/* --- surfaces and light from the photo ---------------------------------------------------------------------------- */

/* Surroundings of GREY give an irradiance of pi GREY, and a light from above adds 0.7 of this to the floor only. On the
 * floor GREY then means an albedo of 1 / 1.7; on the wall 1, which no surface has. */
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
    /* One row of cells crosses the edge between floor and wall. */
    CHECK_MSG(cells[0] > 100 && cells[1] > 50 && wrong[0] + wrong[1] <= WIDTH / 4, "%d of %d, %d of %d", wrong[0],
              cells[0], wrong[1], cells[1]);
    mix_job_free(j);
}

/* Without an object no bit changes, whatever the lights. */
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

/* --- light from lamps --------------------------------------------------------------------------------------------- */

/* Flux in W that the voxels without the object receive from a spot over the floor, for a shadow map of `texels` a side;
 * *around: share of the surroundings that remains with the object. */
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

/* The whole shadow map counts, even if several texels form one first point. */
static void maps_count_whole(void)
{
    static const char spot[] = "spot:0,1,-1.6:0,-1,0:9,9,9:30,40";
    float around;
    const double fine = lamp_flux(&around, 1024, spot, "0.2"), coarse = lamp_flux(&around, 512, spot, "0.2");
    CHECK_MSG(fabs(fine - coarse) < 0.02 * coarse, "%g W, %g W", fine, coarse);
}

/* The surroundings darken by the lamp light that the object takes: a larger object takes more. One beside the cone
 * takes nothing, and a sun has no effect. */
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

/* --- the sun that is guessed -------------------------------------------------------------------------------------- */

#define BLOCK_LOW  ((lmb_vec3){-0.75f, -0.5f, -1.75f})
#define BLOCK_HIGH ((lmb_vec3){-0.45f, -0.15f, -1.45f})

/* Distance at which a ray in camera space enters the block; infinite if it misses. */
static float block_at(lmb_vec3 from, lmb_vec3 along)
{
    const float p[3] = {from.x, from.y, from.z}, d[3] = {along.x, along.y, along.z},
                low[3] = {BLOCK_LOW.x, BLOCK_LOW.y, BLOCK_LOW.z}, high[3] = {BLOCK_HIGH.x, BLOCK_HIGH.y, BLOCK_HIGH.z};
    float first = 1e-4f, last = INFINITY;
    for (int i = 0; i < 3; ++i) {
        const float a = (low[i] - p[i]) / d[i], b = (high[i] - p[i]) / d[i];
        first = fmaxf(first, fminf(a, b));
        last = fminf(last, fmaxf(a, b));
    }
    return first <= last ? first : INFINITY;
}

/* A block on the floor. Its sun shadow has `dark` times the light of the lit floor. */
static void set_block(mix_job *j, lmb_vec3 to_sun, float dark)
{
    const lmb_vec3 eye = {0, 0, 0};
    set_depth(j, 2.5f, 1);
    for (int i = 0; i < PIXELS; ++i) {
        const lmb_vec3 ray = lmb_cloud_ray(&camera, (float)(i % WIDTH), (float)(i / WIDTH));
        j->frame.depth[i] = fminf(j->frame.depth[i], block_at(eye, ray));
        const float z = j->frame.depth[i];
        const lmb_vec3 at = {ray.x * z, ray.y * z, ray.z * z};
        for (int c = 0; c < 3; ++c) {
            j->frame.light.pixels[3 * i + c] = GREY * (block_at(at, to_sun) < INFINITY ? dark : 1.0f);
        }
    }
}

/* A block's shadow gives the sun's direction, strength and hardness. If the shadow is missing, or half of the floor is
 * dark without a blocker, the guess must be a weak, wide sun overhead: it was 50 degrees off, from the side. */
static void sun_is_by_shadows(void)
{
    static const float ways[4][3] = {{-0.6f, 0.7f, 0.2f}, {0.5f, 0.8f, 0.5f}, {-0.3f, 0.6f, -0.7f}, {0.8f, 0.6f, -0.1f}};
    char *object[] = {"--object", square, "--at", "70,64", "--scale", "0.2", "--quiet"};
    for (int i = 0; i < 6; ++i) {
        const int has_shadow = i < 4;
        const float *w = ways[i % 4], n = sqrtf(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
        const lmb_vec3 to = {w[0] / n, w[1] / n, w[2] / n};
        mix_job *j = begin(object, 7);
        report r = {""};
        lmb_light sun;
        float softens = -1.0f;
        set_block(j, to, has_shadow ? 0.4f : 1.0f);
        for (int k = 0; k < 3 * PIXELS && i == 5; ++k) {
            j->frame.light.pixels[k] *= k / 3 % WIDTH > WIDTH / 2 && k / 3 / WIDTH > 52 ? 0.5f : 1.0f;
        }
        CHECK_MSG(place(j) && mix_light(j, &r), "%s", r.text);
        const float size = mix_guess_sun(&sun, &softens, j), cosine = -(sun.direction.x * to.x + sun.direction.y * to.y + sun.direction.z * to.z);
        float rgb[3];
        lmb_env_irradiance(rgb, &j->env[0], (lmb_vec3){0, 1, 0});
        const float share = -sun.direction.y * sun.intensity[1] / rgb[1];
        CHECK_MSG(!has_shadow || (cosine > 0.906f && size < 20.0f && share > 0.5f && share < 2.5f), "%d: cosine %g, %g wide, %g", i,
                  (double)cosine, (double)size, (double)share);
        CHECK_MSG(has_shadow || (sun.direction.y < -0.99f && size > 40.0f && share < 0.5f), "%d: from %g, %g wide, %g", i,
                  (double)-sun.direction.y, (double)size, (double)share);
        mix_job_free(j);
    }
}

/* The light of a lamp at p and of an even light, with or without the block's shadow. pane: the lamp is a window that
 * faces this place. */
static void set_lamp(mix_job *j, const float p[3], float even, int has_block, const lmb_vec3 *pane)
{
    for (int k = 0; k < PIXELS; ++k) {
        const lmb_vec3 ray = lmb_cloud_ray(&camera, (float)(k % WIDTH), (float)(k / WIDTH));
        const float z = j->frame.depth[k];
        const lmb_vec3 at = {ray.x * z, ray.y * z, ray.z * z}, to = {p[0] - at.x, p[1] - at.y, p[2] - at.z};
        const float d = sqrtf(to.x * to.x + to.y * to.y + to.z * to.z), up = z < 2.5f ? to.y : to.z;
        float sent = has_block && block_at(at, to) < 1.0f ? 0.0f : fmaxf(up, 0.0f) / (d * d * d);
        if (pane != NULL) {
            const float x = p[0] - pane->x, y = p[2] - pane->z;
            sent *= fmaxf((to.x * x + to.z * y) / (sqrtf(x * x + y * y) * d), 0.0f);
        }
        for (int c = 0; c < 3; ++c) {
            j->frame.light.pixels[3 * k + c] = 0.4f * (even + sent);
        }
    }
}

/* The guessed light of a photo, and the cosine between its direction and that of a light at `p`, from the anchor. */
typedef struct near_guess {
    lmb_light sun;
    float size, softens, cosine, distance;
} near_guess;

static near_guess guess_near(mix_job *j, const float p[3])
{
    report r = {""};
    near_guess g;
    g.softens = -1.0f;
    CHECK_MSG(mix_light(j, &r), "%s", r.text);
    g.size = mix_guess_sun(&g.sun, &g.softens, j);
    const lmb_vec3 to = {p[0] - j->anchor.x, p[1] - j->anchor.y, p[2] - j->anchor.z}, way = g.sun.direction;
    g.distance = sqrtf(to.x * to.x + to.y * to.y + to.z * to.z);
    g.cosine = -(way.x * to.x + way.y * to.y + way.z * to.z) / g.distance;
    return g;
}

/* A lamp outside the picture: floor and wall get darker with the distance from it, and no shadow is in view. The guess
 * was overhead, 30 to 60 degrees off. If only half of the floor is dark, it may be painted so: the guess must be weak and
 * overhead, and the object darkens half as much. */
static void lamp_is_by_falloff(void)
{
    static const float places[4][3] = {{0.9f, 0.9f, -1.4f}, {-1.0f, 0.8f, -1.2f}, {-0.4f, 1.2f, -0.6f}, {0.9f, 0.9f, -1.4f}};
    char *object[] = {"--object", square, "--at", "48,62", "--scale", "0.2", "--quiet"};
    for (int i = 0; i < 4; ++i) {
        const float *p = places[i];
        mix_job *j = begin(object, 7);
        set_depth(j, 2.5f, 1);
        set_lamp(j, p, 0.1f, 0, NULL);
        for (int k = 0; k < 3 * PIXELS && i == 3; ++k) {
            j->frame.light.pixels[k] = j->frame.depth[k / 3] < 2.5f && k / 3 % WIDTH < WIDTH / 2 ? 0.12f : 0.24f;
        }
        CHECK(place(j));
        const near_guess g = guess_near(j, p);
        CHECK_MSG(i == 3 || (g.cosine > 0.97f && g.size < 20.0f && g.softens == 0.0f), "%d: cosine %g, %g wide, %g", i,
                  (double)g.cosine, (double)g.size, (double)g.softens);
        CHECK_MSG(i != 3 || (g.sun.direction.y < -0.99f && g.size > 40.0f && g.softens == 0.5f && j->softens == 0.5f),
                  "from %g, %g wide, %g", (double)-g.sun.direction.y, (double)g.size, (double)g.softens);
        mix_job_free(j);
    }
}

/* A lamp or a window near a block: both the block's shadow and the falloff give the direction. With one model for lamps,
 * a window was 12 to 30 degrees off: its light falls off with the angle to the pane, too. */
static void near_light_is_by_both(void)
{
    static const float places[4][3] = {{-1.1f, 0.9f, -2.2f}, {-1.3f, 0.6f, -0.7f}, {-0.9f, 1.0f, -2.3f}, {-1.2f, 0.7f, -1.9f}};
    char *object[] = {"--object", square, "--at", "60,62", "--scale", "0.2", "--quiet"};
    for (int i = 0; i < 4; ++i) {
        const float *p = places[i];
        mix_job *j = begin(object, 7);
        set_block(j, (lmb_vec3){0, 1, 0}, 1.0f);
        CHECK(place(j));
        set_lamp(j, p, 0.15f, 1, i % 2 != 0 ? &j->anchor : NULL);
        const near_guess g = guess_near(j, p);
        CHECK_MSG(g.cosine > 0.985f && g.size < 30.0f && g.softens < 0.1f, "%d: cosine %g, %g wide, %g", i, (double)g.cosine,
                  (double)g.size, (double)g.softens);
        mix_job_free(j);
    }
}

/* A ball of light softens the block's shadow, and the width of the penumbra gives its size: 2 asin(radius / distance) from
 * the object's foot. In these small photos it is right to a third. */
static void near_light_has_size(void)
{
    enum { BALL_POINTS = 48 };
    static const float balls[2][4] = {{-1.1f, 0.9f, -2.2f, 0.2f}, {-1.4f, 0.8f, -1.2f, 0.4f}};
    char *object[] = {"--object", square, "--at", "60,62", "--scale", "0.2", "--quiet"};
    for (int i = 0; i < 2; ++i) {
        const float *p = balls[i], radius = p[3];
        mix_job *j = begin(object, 7);
        float *sum = calloc(3 * PIXELS, sizeof *sum);
        set_block(j, (lmb_vec3){0, 1, 0}, 1.0f);
        CHECK(sum != NULL && place(j));
        for (int n = 0; n < BALL_POINTS && sum != NULL; ++n) { /* points on the ball, in equal areas */
            const float y = 1.0f - (2.0f * (float)n + 1.0f) / BALL_POINTS, flat = sqrtf(1.0f - y * y), turn = 2.4f * (float)n;
            const float at[3] = {p[0] + radius * flat * cosf(turn), p[1] + radius * y, p[2] + radius * flat * sinf(turn)};
            set_lamp(j, at, 0.15f, 1, NULL);
            for (int k = 0; k < 3 * PIXELS; ++k) {
                sum[k] += j->frame.light.pixels[k] / BALL_POINTS;
            }
        }
        memcpy(j->frame.light.pixels, sum, 3 * PIXELS * sizeof *sum);
        free(sum);
        const near_guess g = guess_near(j, p);
        const float wide = 114.6f * asinf(radius / g.distance);
        CHECK_MSG(fabsf(g.size - wide) < 0.34f * wide, "%d: %g wide, right is %g", i, (double)g.size, (double)wide);
        mix_job_free(j);
    }
}

/* If the light is unknown, places that see half of it blocked darken less, and those that see nothing darken in full. */
static void unknown_light_darkens_less(void)
{
    char *object[] = {"--object", square, "--at", "48,62", "--scale", "0.3", "--quiet"};
    float *first = calloc(3 * PIXELS, sizeof *first);
    int darker = 0, wrong = 0;
    for (int i = 0; i < 2 && first != NULL; ++i) {
        mix_job *j = begin(object, 7);
        report r = {""};
        set_depth(j, 2.5f, 1);
        CHECK_MSG(place(j) && mix_light(j, &r) && j->softens == 0.5f, "%s %g", r.text, (double)j->softens);
        j->softens = i == 0 ? 0.0f : 0.5f;
        CHECK_MSG(mix_voxels(j, &r) && mix_draw(j, &r), "%s", r.text);
        for (int k = 0; k < 3 * PIXELS; ++k) {
            const float blocked = 1.0f - first[k] / GREY, left = 1.0f - j->picture.pixels[k] / GREY;
            darker += i == 1 && blocked > 0.02f && j->picture.pixels[k] < GREY;
            wrong += i == 1 && blocked > 0.02f && j->picture.pixels[k] < GREY && j->picture.pixels[k] != first[k] &&
                     fabsf(left - blocked * (0.5f + 0.5f * blocked)) > 1e-3f;
            first[k] = j->picture.pixels[k];
        }
        mix_job_free(j);
    }
    CHECK_MSG(first != NULL && darker > 300 && wrong == 0, "%d of %d", wrong, darker);
    free(first);
}

/* A pose whose world has +Y down, as some data sets have: the object stood on the ceiling. */
static void worlds_may_be_upside_down(void)
{
    for (int i = 0; i < 3; ++i) { /* +Y is down, up, and ahead */
        static const float y[3][3] = {{0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
        mix_job *j = begin(NULL, 0);
        report r = {""};
        set_depth(j, 2.5f, 1);
        for (int k = 0; k < PIXELS; ++k) {
            const lmb_vec3 ray = lmb_cloud_ray(&camera, (float)(k % WIDTH), (float)(k / WIDTH));
            j->frame.depth[k] = fminf(j->frame.depth[k], ray.y > 0.01f ? 0.5f / ray.y : 1e9f);
        }
        j->frame.has_pose = 1;
        memset(j->frame.pose, 0, sizeof j->frame.pose);
        for (int c = 0; c < 3; ++c) { /* rows: the world's axes, by the camera's right, down and ahead */
            const float z[3] = {0, i < 2 ? 0.0f : 1.0f, i < 2 ? y[i][1] : 0.0f};
            j->frame.pose[c] = c == 0;
            j->frame.pose[4 + c] = (double)y[i][c];
            j->frame.pose[8 + c] = (double)z[c];
        }
        CHECK_MSG(mix_find_planes(j, &r), "%s", r.text);
        const lmb_vec3 up = mix_up(j);
        const int32_t floor = mix_floor(j);
        CHECK_MSG(up.y > 0.99f && floor >= 0 && j->planes.plane[floor].normal.y > 0.99f, "%d: up is %g %g %g", i,
                  (double)up.x, (double)up.y, (double)up.z);
        mix_job_free(j);
    }
}

/* If the object hangs on a wall, the sun is in front of the wall. */
static void sun_is_before_walls(void)
{
    char *object[] = {"--object", square, "--quiet", "--at", "50,36"};
    mix_job *j = begin(object, 5);
    report r = {""};
    lmb_light sun;
    float softens = -1.0f;
    set_depth(j, 2.5f, 0);
    CHECK(place(j) && j->hangs && mix_light(j, &r));
    mix_guess_sun(&sun, &softens, j);
    CHECK_MSG(sun.direction.z < -0.25f && sun.direction.y < -0.25f, "%g %g", (double)sun.direction.y, (double)sun.direction.z);
    mix_job_free(j);
}

/* Without lights, the photo changes only because the object blocks its surroundings, and no sun is guessed. */
static void no_light_is_none(void)
{
    char *more[] = {"--object", square, "--at", "47,64", "--scale", "0.3", "--light", "none", "--quiet"};
    mix_job *j = begin(more, 9);
    report r = {""};
    set_depth(j, 2.5f, 1);
    CHECK_MSG(place(j) && mix_light(j, &r) && mix_voxels(j, &r) && mix_draw(j, &r), "%s", r.text);
    CHECK(j->light_count == 0);
    mix_job_free(j);
}

/* Specks of the floor measured on the extension of the wall's plane do not belong to the wall; specks within noise
 * belong to the floor. */
static void specks_are_no_plane(void)
{
    char *more[] = {"--quiet"};
    mix_job *j = begin(more, 1);
    int wrong = 0;
    set_depth(j, 2.5f, 1);
    for (int k = 0; k < 8; ++k) { /* 2 x 3 pixels each */
        for (int i = 0; i < 6; ++i) {
            j->frame.depth[(56 + 2 * (k % 4) + i / 3) * WIDTH + 8 + 10 * k + i % 3] = 2.5f;
        }
    }
    report r = {""};
    CHECK(mix_find_planes(j, &r) && j->planes.count >= 2);
    const uint8_t wall = j->planes.label[10 * WIDTH + 48], floor = j->planes.label[70 * WIDTH + 48];
    for (int i = 55 * WIDTH; i < PIXELS; ++i) {
        wrong += j->planes.label[i] == wall && floor != wall;
    }
    CHECK_MSG(wall != 0 && floor != 0 && wrong == 0, "%d pixels of the floor are the wall's", wrong);
    mix_job_free(j);
}

/* Angular size in degrees of a guessed sun when half of the floor has `dark` of the other half's light; *up: irradiance
 * on the floor from all lights, relative to the photo's floor. */
static float guessed_size(float *up, float dark, float wall)
{
    char *object[] = {"--object", square, "--scale", "0.3", "--quiet"};
    mix_job *j = begin(object, 5);
    report r = {""};
    float rgb[3];
    set_depth(j, 2.5f, 1);
    for (int i = 0; i < PIXELS; ++i) {
        const float here = i / WIDTH < 52 ? wall : i % WIDTH < WIDTH / 2 ? dark : 1.0f;
        for (int c = 0; c < 3; ++c) {
            j->frame.light.pixels[3 * i + c] = GREY * here;
        }
    }
    CHECK_MSG(place(j) && mix_light(j, &r) && j->light_count == MIX_SUN_SAMPLES, "%s", r.text);
    lmb_env_irradiance(rgb, &j->env[0], (lmb_vec3){0, 1, 0});
    *up = rgb[1];
    for (int32_t i = 0; i < j->light_count; ++i) {
        *up -= j->lights[i].direction.y * j->lights[i].intensity[1];
    }
    *up /= 3.14159265f * GREY;
    const float size = j->sun_size;
    mix_job_free(j);
    return size;
}

/* If the photo shows no shadow, the sun is wide, even when half of the floor is dark for no visible reason. A floor as
 * bright as its surroundings counts as grey; one three times as bright counts as white, because no surface reflects
 * more light than it receives. */
static void sun_fits_the_photo(void)
{
    float plain, shadowed, bright;
    const float wide = guessed_size(&plain, 1.0f, 1.0f), half = guessed_size(&shadowed, 0.45f, 1.0f);
    guessed_size(&bright, 1.0f, 0.3f);
    CHECK_MSG(wide > 40.0f && half > 40.0f, "%g, %g degrees", (double)wide, (double)half);
    CHECK_MSG(plain > 1.1f && plain < 1.8f, "%g", (double)plain);
    CHECK_MSG(bright > 1.2f && bright < 1.5f, "%g", (double)bright);
}

/* A photo with a floor brighter than a white one would be in its surroundings, and a placed object. */
static mix_job *bright_floor(char **more, int count)
{
    mix_job *j = begin(more, count);
    report r = {""};
    set_depth(j, 2.5f, 1);
    for (int i = 0; i < 3 * PIXELS; ++i) {
        j->frame.light.pixels[i] = i / 3 / WIDTH < 52 ? 0.3f * GREY : GREY;
    }
    CHECK_MSG(place(j) && mix_light(j, &r), "%s", r.text);
    return j;
}

/* Pixels that are not numbers do not affect the photo's brightness, wherever they are. */
static void no_number_says_nothing(void)
{
    char *more[] = {"--object", square, "--at", "47.5,60", "--scale", "0.3", "--quiet"};
    static const float half[3] = {0.5f, 0.5f, 0.5f};
    float rgb[2][3];
    for (int i = 0; i < 2; ++i) {
        mix_job *j = begin(more, 7);
        report r = {""};
        lmb_light sun;
        float softens = -1.0f;
        set_depth(j, 2.5f, 1);
        for (int k = 0; k < 3 * PIXELS; ++k) {
            j->frame.light.pixels[k] = k / 3 / WIDTH < 52 ? 0.3f * GREY : GREY;
        }
        CHECK_MSG(place(j) && mix_light(j, &r), "%s", r.text);
        for (int k = 0; k < 3 * PIXELS && i == 1; ++k) { /* the right half */
            j->frame.light.pixels[k] = k / 3 % WIDTH >= WIDTH / 2 ? NAN : j->frame.light.pixels[k];
        }
        lmb_env_dim(&j->env[0], &j->env[0], half); /* the guess matched the photo's brightness */
        mix_guess_sun(&sun, &softens, j);
        lmb_env_irradiance(rgb[i], &j->env[0], (lmb_vec3){0, 1, 0});
        mix_job_free(j);
    }
    CHECK_MSG(fabsf(rgb[0][1] - rgb[1][1]) < 0.02f * rgb[0][1], "around %g, with what is no number %g", (double)rgb[0][1],
              (double)rgb[1][1]);
}

/* An object with world coordinates in its file gets the same light as one placed there; neither depends on the
 * camera. */
static void world_has_the_same_light(void)
{
    static folder f;
    char path[FOLDER_PATH], text[300];
    char *at_pixel[] = {"--object", path, "--at", "47.5,60", "--scale", "0.3", "--quiet"},
         *at_world[] = {"--object", path, "--at", "world", "--quiet"};
    static const char unit[] = "v -0.5 0 0\nv 0.5 0 0\nv 0.5 1 0\nv -0.5 1 0\nf 1 2 3 4\n";
    float rgb[2][3];
    folder_open(&f);
    strcpy(path, folder_put(&f, "unit.obj", unit, sizeof unit - 1));
    mix_job *j[2] = {bright_floor(at_pixel, 7), NULL};
    const double y = (double)j[0]->anchor.y, z = (double)j[0]->anchor.z;
    const int size = snprintf(text, sizeof text, "v -0.15 %.6f %.6f\nv 0.15 %.6f %.6f\nv 0.15 %.6f %.6f\nv -0.15 %.6f %.6f\n"
                              "f 1 2 3 4\n", y, z, y, z, y + 0.3, z, y + 0.3, z);
    strcpy(path, folder_put(&f, "there.obj", text, (size_t)size));
    j[1] = bright_floor(at_world, 5);
    for (int i = 0; i < 2; ++i) {
        lmb_env_irradiance(rgb[i], &j[i]->env[0], (lmb_vec3){0, 1, 0});
    }
    CHECK_MSG(fabsf(rgb[0][1] - rgb[1][1]) < 1e-4f * rgb[0][1], "around %g, in the world %g", (double)rgb[0][1],
              (double)rgb[1][1]);
    CHECK_MSG(fabsf(j[0]->sun.intensity[1] - j[1]->sun.intensity[1]) < 1e-4f * j[0]->sun.intensity[1], "%g, in the world %g",
              (double)j[0]->sun.intensity[1], (double)j[1]->sun.intensity[1]);
    for (int i = 0; i < 2; ++i) {
        mix_job_free(j[i]);
    }
    folder_close(&f);
}

/* Finds a job's lights and the view of the photo. */
static void find_lights(mix_job *j, lmb_view *view)
{
    report r = {""};
    int32_t x0, y0;
    set_depth(j, 2.5f, 1);
    CHECK_MSG(place(j) && mix_light(j, &r), "%s", r.text);
    CHECK(lmb_photo_view(view, &x0, &y0, &j->frame.camera, &j->axes) == LMB_OK);
    mix_lights_begin(j);
}

static void get_tile(lmb_tile *out, const mix_job *j, int t)
{
    lmb_real_tile(out, &j->cloud, &j->planes, &j->real, &j->axes, t % (WIDTH / LMB_TILE) * LMB_TILE,
                  t / (WIDTH / LMB_TILE) * LMB_TILE);
}

/* Tiles outside the object's shadows keep the photo's bits, and the others equal a test of all lights for each tile:
 * for a sun from the side with a visible shadow, and for a lamp. If the object changes the surroundings, every light is
 * tested, even behind one with a size. */
static void lights_are_asked_where_they_change(void)
{
    static const char *const lights[3][3] = {{"sun:0,0,0:1,-0.5,0.2:2,2,2:30"},
                                             {"point:-0.6,0.5,-1.2:0,-1,0:1,1,1:0.1"},
                                             {"sun:0,0,0:1,-0.5,0.2:2,2,2:5", RED, BLUE}};
    for (int i = 0; i < 3; ++i) {
        char light[3][60];
        char *more[] = {"--object", square,    "--at",   "40,66",   "--scale", "0.2",     "--turn",
                        "60",       "--light", light[0], "--light", light[1],  "--light", light[2]};
        int changed = 0, same = 0, carried = 0;
        for (int k = 0; k < 3; ++k) {
            strcpy(light[k], lights[i][k] != NULL ? lights[i][k] : "");
        }
        mix_job *j = begin(more, lights[i][1] != NULL ? 14 : 10);
        lmb_view view;
        find_lights(j, &view);
        for (int t = 0; t < PIXELS / LMB_TILE_PIXELS; ++t) {
            static lmb_tile tile;
            static lmb_irradiance all[2], some[2], other[2];
            get_tile(&tile, j, t);
            memset(all, 0, sizeof all);
            memset(some, 0, sizeof some);
            memset(other, 0, sizeof other);
            mix_direct direct = {0}, again;
            for (int32_t k = 0; k < 2 * j->light_count; ++k) {
                lmb_direct_tile(&all[k % 2], j->o.kernels, &tile, &view, &j->scene, &j->lights[k / 2],
                                &j->maps[k / 2][k % 2]);
            }
            mix_lights_tile(&some[0], &some[1], &direct, j, &view, &tile);
            if (memcmp(&all[0], &all[1], sizeof all[0]) != 0) {
                CHECK_MSG(memcmp(all, some, sizeof all) == 0, "light %d, tile %d", i, t);
                ++changed;
            } else {
                CHECK(memcmp(&some[0], &some[1], sizeof some[0]) == 0);
                same += some[0].rgb[0][0] == 0.0f && all[0].rgb[0][0] > 0.0f;
            }
            other[1].rgb[2][0] = 1e-30f; /* too small to change a sum */
            memset(&direct, 0, sizeof direct);
            mix_lights_tile(&other[0], &other[1], &direct, j, &view, &tile);
            CHECK_MSG(memcmp(&all[0], &other[0], sizeof all[0]) == 0, "light %d, tile %d: not all are asked", i, t);
            /* Light known from the previous frame is reused outside the object's shadows; the rest is recomputed. */
            again = direct;
            again.known &= 0x00ff00ff00ff00ffu;
            for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
                again.light.rgb[0][k] = again.known >> k & 1 ? 7.0f : 0.0f;
                again.light.rgb[1][k] = again.light.rgb[2][k] = 0.0f;
            }
            const uint64_t taken = again.known;
            memset(other, 0, sizeof other);
            other[1].rgb[2][0] = 1e-30f;
            mix_lights_tile(&other[0], &other[1], &again, j, &view, &tile);
            for (int k = 0; k < LMB_TILE_PIXELS && tile.id[k] != 0; ++k) {
                const float is = other[0].rgb[0][k], fresh = all[0].rgb[0][k];
                const int falls = memcmp(&all[0], &all[1], sizeof all[0]) != 0;
                CHECK_MSG(is == fresh || (!falls && (taken >> k & 1) != 0 && is == 7.0f), "light %d, tile %d: %g", i, t, (double)is);
                carried += is == 7.0f && fresh != 7.0f;
            }
        }
        CHECK_MSG(carried > 100, "light %d: %d pixels are carried", i, carried);
        CHECK_MSG(changed > 3 && same > 5, "light %d: %d tiles change, %d are not asked", i, changed, same);
        mix_job_free(j);
    }
}

/* Suns from all sides. For those behind the camera, the object's box is no larger than the shadow: a tile that only the
 * shadow's edge touches is also computed with the object. */
static void shadows_that_touch_a_tile(void)
{
    test_rng rng = {77};
    char sun[60];
    char *more[] = {"--object", square, "--at", "48,60", "--scale", "0.35", "--light", sun};
    const int suns = tries(30, 90);
    int changed = 0;
    for (int i = 0; i < suns; ++i) {
        const double wide = i % 3 == 0 ? 1.0 : 0.2;
        snprintf(sun, sizeof sun, "sun:0,0,0:%.3f,%.3f,%.3f:2,2,2", wide * (double)test_uniform(&rng, -1, 1),
                 wide * (double)test_uniform(&rng, -1, -0.1f), i % 3 == 0 ? (double)test_uniform(&rng, -1, 1) : -1.0);
        mix_job *j = begin(more, 8);
        j->o.shadow_map = 1024;
        lmb_view view;
        find_lights(j, &view);
        for (int t = 0; t < PIXELS / LMB_TILE_PIXELS; ++t) {
            static lmb_tile tile;
            static lmb_irradiance all[2], some[2];
            mix_direct direct = {0};
            get_tile(&tile, j, t);
            memset(all, 0, sizeof all);
            memset(some, 0, sizeof some);
            some[1].rgb[2][0] = all[1].rgb[2][0] = 1e-30f;
            for (int k = 0; k < 2; ++k) {
                lmb_direct_tile(&all[k], j->o.kernels, &tile, &view, &j->scene, &j->lights[0], &j->maps[0][k]);
            }
            mix_lights_tile(&some[0], &some[1], &direct, j, &view, &tile);
            CHECK_MSG(memcmp(all, some, sizeof all) == 0, "%s, tile %d", sun, t);
            int differs = 0;
            for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
                differs |= fabsf(all[0].rgb[0][k] - all[1].rgb[0][k]) > 1e-3f;
            }
            changed += differs;
        }
        mix_job_free(j);
    }
    CHECK_MSG(9 * changed > 10 * suns, "%d tiles change", changed);
}

/* A mirror facing the camera reflects the wall behind it, which no photo shows: as bright as the lamp makes it. A sun
 * creates no room. The room contains the camera and the lamp and is as wide as the measured scene. */
static void metal_mirrors_the_room(void)
{
    static const char *const lights[3] = {"point:0.4,0.3,0.3:0,-1,0:0.4,0.4,0.4", "point:0.4,0.3,0.3:0,-1,0:4,4,4",
                                          "sun:0,0,0:0.1,-1,-0.1:2,2,2"};
    float shown[3];
    for (int i = 0; i < 3; ++i) {
        char light[60];
        char *more[] = {"--object", square, "--at", "48,60", "--scale", "0.3", "--light", light};
        strcpy(light, lights[i]);
        mix_job *j = begin(more, 8);
        lmb_material metal;
        memset(&metal, 0, sizeof metal);
        metal.specular[0] = metal.specular[1] = metal.specular[2] = 1.0f;
        metal.alpha = 1.0f;
        metal.roughness = 0.2f;
        metal.texture = -1;
        metal.flags = LMB_DOUBLE_SIDED;
        set_depth(j, 2.5f, 1);
        CHECK(place(j));
        photo_draw(j, &metal);
        CHECK(j->room.is_known == (i < 2));
        CHECK_MSG(i == 2 || (j->room.high[2] > 0.75f && j->room.high[2] < 0.9f && j->room.low[2] < -2.4f), "%g .. %g",
                  (double)j->room.low[2], (double)j->room.high[2]);
        shown[i] = photo_mean(j, 46, 46, 51, 51);
        mix_job_free(j);
    }
    CHECK_MSG(shown[1] > 1.5f * shown[0], "%g by a lamp, %g by one of ten times its light", (double)shown[0],
              (double)shown[1]);
}

/* Lit by a sun with a size and two lamps of other colours. */
static mix_job *lit_by(const char *first, const char *second)
{
    char sun[] = "sun:0,0,0:1,-0.5,0.2:1,1,1:5", light[2][40];
    char *more[] = {"--object", square,  "--at", "40,66",   "--scale", "0.2",     "--show",
                    "voxels",   "--light", sun,    "--light", light[0],  "--light", light[1]};
    report r = {""};
    strcpy(light[0], first);
    strcpy(light[1], second);
    mix_job *j = begin(more, 14);
    set_depth(j, 2.5f, 1);
    CHECK_MSG(place(j) && mix_light(j, &r) && mix_voxels(j, &r) && mix_show_voxels(j, &r), "%s", r.text);
    return j;
}

/* The order of the lamps does not matter: each counts once. */
static void order_of_lights_says_nothing(void)
{
    mix_job *a = lit_by(RED, BLUE), *b = lit_by(BLUE, RED);
    double off = 0.0, all = 0.0;
    int unlike = 0;
    for (int32_t i = 0; i < 16 * a->real.count; ++i) {
        unlike += abs(a->real.colours[i] - b->real.colours[i]) > 1;
    }
    for (int i = 0; i < 3 * PIXELS; ++i) {
        off += fabs((double)a->picture.pixels[i] - (double)b->picture.pixels[i]);
        all += (double)a->picture.pixels[i];
    }
    CHECK_MSG(unlike == 0 && all > 0.0 && off < 1e-3 * all, "%d colours; %g of %g", unlike, off, all);
    mix_job_free(a);
    mix_job_free(b);
}

/* A sun of 16 degrees partly lights the floor next to the umbra; one without a size does not. */
static void size_softens(void)
{
    static const char *const lights[2] = {"sun:0,0,0:1,-1,0:2,2,2", "sun:0,0,0:1,-1,0:2,2,2:16"};
    int part[2] = {0}, full[2] = {0};
    for (int i = 0; i < 2; ++i) {
        char light[40];
        char *more[] = {"--object", square, "--at", "40,66", "--scale", "0.2", "--turn", "90", "--show", "delta",
                        "--light", light};
        report r = {""};
        strcpy(light, lights[i]);
        mix_job *j = begin(more, 12);
        set_depth(j, 2.5f, 1);
        CHECK_MSG(place(j) && mix_light(j, &r) && mix_voxels(j, &r) && mix_draw(j, &r), "%s", r.text);
        CHECK(j->light_count == (i == 0 ? 1 : MIX_LIGHT_SAMPLES));
        for (int k = 0; k < PIXELS; ++k) {
            const float share = -j->picture.pixels[3 * k] / GREY;
            part[i] += share > 0.2f && share < 0.45f;
            full[i] += share >= 0.45f;
        }
        mix_job_free(j);
    }
    CHECK_MSG(part[1] > part[0] + 20 && full[1] > 20 && full[1] < full[0], "%d %d, %d %d", part[0], part[1], full[0],
              full[1]);
}

/* --- metals and lamps -------------------------------------------------------------------------------------------------- */

/* A photo of the corner, lit by a lamp, with an object of one material. */
static mix_job *draw_with(const lmb_material *look)
{
    char *more[] = {"--object", square, "--at", "48,60", "--scale", "0.3", "--light", "point:0,1,-1:0,-1,0:5,5,5"};
    report r = {""};
    mix_job *j = begin(more, 8);
    set_depth(j, 2.5f, 1);
    CHECK_MSG(place(j), "%s", r.text);
    photo_draw(j, look);
    return j;
}

/* A metal reflects the grey around it, a lamp shows its emission, and both light the floor in front. Neither did once,
 * because a metal has no albedo. */
static void objects_show_light(void)
{
    lmb_material look = {.alpha = 1.0f, .texture = -1, .roughness = 0.4f, .flags = LMB_DOUBLE_SIDED};
    mix_job *j = draw_with(&look);
    const float black = photo_mean(j, 46, 50, 50, 56), floor = photo_mean(j, 40, 64, 56, 70);
    mix_job_free(j);
    look.specular[0] = look.specular[1] = look.specular[2] = 0.9f;
    j = draw_with(&look);
    const float metal = photo_mean(j, 46, 50, 50, 56);
    mix_job_free(j);
    memset(look.specular, 0, sizeof look.specular);
    look.emission[0] = look.emission[1] = look.emission[2] = 2.0f;
    j = draw_with(&look);
    const float lamp = photo_mean(j, 46, 50, 50, 56), lit = photo_mean(j, 40, 64, 56, 70);
    CHECK_MSG(black < 0.01f && metal > 0.1f && metal < 0.6f && fabsf(lamp - 2.0f) < 0.02f && lit > 1.1f * floor,
              "black %g, metal %g, lamp %g; the floor %g, by the lamp %g", (double)black, (double)metal, (double)lamp,
              (double)floor, (double)lit);
    CHECK_MSG(j->lamp_count > 0 && j->lamp_count <= 2, "%d lamps of a square", (int)j->lamp_count);
    mix_job_free(j);
}

/* For a pixel beside the floor, the message names the nearest floor pixel. */
static void place_is_named(void)
{
    char *object[] = {"--object", square, "--at", "10,5"};
    int32_t at[2] = {0, 0};
    mix_job *j = begin(object, 4);
    report r = {""};
    set_depth(j, 2.5f, 1);
    CHECK(mix_find_planes(j, &r));
    CHECK_MSG(mix_plane_near(at, j) && at[0] == 10 && at[1] > 45 && at[1] < 60, "%d, %d", (int)at[0], (int)at[1]);
    memset(j->planes.label, 0, PIXELS);
    CHECK(!mix_plane_near(at, j));
    mix_job_free(j);
}

/* For a pixel without a surface at the picture's edge, the message names one with room for the object: half a metre
 * wide, it does not fit at the nearest floor pixel. */
static void place_has_room(void)
{
    char *object[] = {"--object", square, "--at", "0,70", "--scale", "0.5"};
    int32_t at[2] = {0, 0};
    char named[40];
    mix_job *j = begin(object, 6);
    report r = {""};
    set_depth(j, 2.5f, 1);
    for (int i = 0; i < 3; ++i) { /* width of the left part without a surface */
        for (int y = 0; y < HEIGHT; ++y) {
            j->frame.depth[y * WIDTH + i] = 0.0f;
        }
    }
    CHECK(mix_find_planes(j, &r) && !mix_place(j, &r));
    CHECK(mix_plane_near(at, j) && at[0] > 10 && at[0] < 60);
    snprintf(named, sizeof named, "would do is %d,%d", (int)at[0], (int)at[1]);
    CHECK_MSG(strstr(r.text, named) != NULL, "%s, not %s", r.text, named);
    mix_job_free(j);
    j = begin(object, 6);
    set_depth(j, 2.5f, 1);
    j->o.at_px[0] = (float)at[0];
    j->o.at_px[1] = (float)at[1];
    CHECK_MSG(place(j) && j->inside, "%d,%d", (int)at[0], (int)at[1]);
    mix_job_free(j);
}

void test_mix(void)
{
    floor_stays();
    edge_is_no_wall(0.14f, 0);
    edge_is_no_wall(0.5f, 1);
    place_has_room();
    objects_show_light();
    place_is_named();
    maps_count_whole();
    around_darkens();
    sun_is_by_shadows();
    near_light_is_by_both();
    near_light_has_size();
    lamp_is_by_falloff();
    unknown_light_darkens_less();
    worlds_may_be_upside_down();
    sun_is_before_walls();
    no_light_is_none();
    specks_are_no_plane();
    sun_fits_the_photo();
    world_has_the_same_light();
    no_number_says_nothing();
    lights_are_asked_where_they_change();
    shadows_that_touch_a_tile();
    metal_mirrors_the_room();
    order_of_lights_says_nothing();
    size_softens();
    stands_on_floor();
    touches(0.004f, 1);
    touches(0.019f, 1);
    touches(0.2f, 0);
    size_is_kept();
    no_floor();
    stands_on_what_is_asked();
    asked_for_nothing();
    metres_are_its_own();
    size_by_its_own();
    albedo_is_told();
    nothing_changes();
}
