/* main_mixed.c: adds a virtual object to a photo of a known scene and compares with the path-traced answer. [M24]
 *
 *     measure-mixed [SHARED [OUT.pfm]]        SHARED holds truth/mixed_without and mixed_with (default ../shared)
 *
 * The photo and its depth are the truth's picture without the two objects. The objects and the light are those of the
 * truth, at the same places. `lambent mix` computes everything else. Bars: 0.85 of the shadow in common (IoU); a
 * relative RMSE of the whole picture of 0.04; the sign of the change right for pixels that the truth changes by more
 * than 2 % of its mean. The error of the unchanged photo is printed beside it. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "../../tools/mix/mix_job.h"
#include "../../tools/picture/picture.h"
#include "../test.h"

int test_passed, test_failed, test_skipped;

enum { SIDE = 192, PIXELS = SIDE * SIDE };

/* The scene of mixed_without/scene.json. */
static const double eye[3] = {3.6, 1.6, 4.1}, target[3] = {1.6, 0.65, 1.0};
static const lmb_light light = {{2.6f, 2.5f, 2.4f}, {-0.2996672f, -0.8324089f, -0.466149f}, {11.0f, 10.4f, 9.4f},
                               0.8386706f, 0.7660444f, LMB_LIGHT_SPOT, 0, 0};

typedef struct truth {
    image without, with, depth[2], albedo, direct[2];
} truth;

static int read_image(image *out, const char *folder, const char *name)
{
    char path[600];
    file_bytes file;
    report r = {""};
    snprintf(path, sizeof path, "%s/truth/%s", folder, name);
    if (!file_read(&file, path, &r)) {
        SKIP("%s", r.text);
        return 0;
    }
    const int ok = pfm_decode(out, file.data, file.size, path, &r);
    file_free(&file);
    return ok && out->width == SIDE && out->height == SIDE;
}

static int read_truth(truth *t, const char *folder)
{
    return read_image(&t->without, folder, "mixed_without/pt_full.pfm") &&
           read_image(&t->with, folder, "mixed_with/pt_full.pfm") &&
           read_image(&t->depth[0], folder, "mixed_without/gbuffer_depth.pfm") &&
           read_image(&t->depth[1], folder, "mixed_with/gbuffer_depth.pfm") &&
           read_image(&t->direct[0], folder, "mixed_without/cycles_direct.pfm") &&
           read_image(&t->direct[1], folder, "mixed_with/cycles_direct.pfm");
}

static float grey(const image *p, int i)
{
    return (p->pixels[3 * i] + p->pixels[3 * i + 1] + p->pixels[3 * i + 2]) / 3.0f;
}

/* Both pictures show the same surface. */
static int is_same(const truth *t, int i)
{
    return fabsf(t->depth[0].pixels[3 * i] - t->depth[1].pixels[3 * i]) < 1e-3f && t->depth[0].pixels[3 * i] > 0.0f;
}

/* --- the job ------------------------------------------------------------------------------------------------------ */

static void set_pose(double pose[16])
{
    double f[3], right[3], up[3], length = 0.0;
    for (int i = 0; i < 3; ++i) {
        f[i] = target[i] - eye[i];
        length += f[i] * f[i];
    }
    for (int i = 0; i < 3; ++i) {
        f[i] /= sqrt(length);
    }
    const double flat = sqrt(f[0] * f[0] + f[2] * f[2]);
    right[0] = -f[2] / flat; /* forward x (0, 1, 0) */
    right[1] = 0.0;
    right[2] = f[0] / flat;
    up[0] = right[1] * f[2] - right[2] * f[1];
    up[1] = right[2] * f[0] - right[0] * f[2];
    up[2] = right[0] * f[1] - right[1] * f[0];
    for (int i = 0; i < 3; ++i) {
        pose[4 * i] = right[i];
        pose[4 * i + 1] = -up[i];
        pose[4 * i + 2] = f[i];
        pose[4 * i + 3] = eye[i];
    }
    pose[15] = 1.0;
}

static int make_job(mix_job *j, const truth *t, char *object, report *r)
{
    const float focal = (float)(0.5 * SIDE / tan(28.0 * 3.14159265358979 / 180.0));
    const lmb_pinhole camera = {SIDE, SIDE, focal, focal, 0.5f * (SIDE - 1), 0.5f * (SIDE - 1)};
    char *argv[] = {"mix", "--frame", "known", "--object", object, "--at", "world", "-o", "known.pfm", NULL};
    if (!mix_options_parse(&j->o, 9, argv, r)) {
        return 0;
    }
    j->o.lights[0] = light;
    j->o.light_count = 1;
    j->frame.camera = camera;
    j->frame.has_pose = 1;
    set_pose(j->frame.pose);
    j->frame.light = t->without;
    j->frame.light.pixels = malloc(3 * PIXELS * sizeof(float));
    j->frame.depth = malloc(PIXELS * sizeof(float));
    if (j->frame.light.pixels == NULL || j->frame.depth == NULL) {
        return report_fail(r, "out of memory");
    }
    memcpy(j->frame.light.pixels, t->without.pixels, 3 * PIXELS * sizeof(float));
    for (int i = 0; i < PIXELS; ++i) {
        j->frame.depth[i] = t->depth[0].pixels[3 * i];
    }
    return mix_find_planes(j, r) && mix_place(j, r) && mix_light(j, r) && mix_voxels(j, r) && mix_draw(j, r);
}

/* --- figures ------------------------------------------------------------------------------------------------------ */

/* Pixels that the light reaches without the object but not with it, from the two maps. */
static void our_shadow(uint8_t *out, mix_job *j)
{
    static lmb_tile tile;
    static lmb_irradiance by_map[2];
    lmb_view view;
    int32_t x0, y0;
    lmb_photo_view(&view, &x0, &y0, &j->frame.camera, &j->axes);
    for (int i = 0; i < PIXELS / LMB_TILE_PIXELS; ++i) {
        const int x = i % (SIDE / LMB_TILE) * LMB_TILE, y = i / (SIDE / LMB_TILE) * LMB_TILE;
        memset(by_map, 0, sizeof by_map);
        lmb_real_tile(&tile, &j->cloud, &j->planes, &j->real, &j->axes, x, y);
        for (int k = 0; k < 2; ++k) {
            lmb_direct_tile(&by_map[k], j->o.kernels, &tile, &view, &j->scene, &j->lights[0], &j->maps[0][k]);
        }
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            out[(y + k / LMB_TILE) * SIDE + x + k % LMB_TILE] =
                (uint8_t)(by_map[0].rgb[1][k] > 0.0f && by_map[1].rgb[1][k] == 0.0f);
        }
    }
}

static void judge_shadow(const truth *t, mix_job *j)
{
    static uint8_t ours[PIXELS];
    int both = 0, either = 0;
    our_shadow(ours, j);
    for (int i = 0; i < PIXELS; ++i) {
        const int theirs = grey(&t->direct[0], i) > 0.0f && grey(&t->direct[1], i) == 0.0f;
        if (is_same(t, i)) {
            both += theirs && ours[i];
            either += theirs || ours[i];
        }
    }
    printf("shadow: IoU %.4f of %d pixels\n", (double)both / (double)either, either);
    CHECK(both >= 0.85 * either);
}

static double rmse(const image *a, const image *b, const truth *t, int same_only)
{
    double sum = 0.0, mean = 0.0;
    int count = 0;
    for (int i = 0; i < PIXELS; ++i) {
        if (same_only && !is_same(t, i)) {
            continue;
        }
        for (int c = 0; c < 3; ++c) {
            const double d = (double)a->pixels[3 * i + c] - (double)b->pixels[3 * i + c];
            sum += d * d;
            mean += (double)b->pixels[3 * i + c];
            ++count;
        }
    }
    return sqrt(sum / count) / (mean / count);
}

/* The truth's change of a pixel, averaged over 3 x 3 pixels of one surface: the noise of one pixel (1 to 2 %,
 * truth/README) is as large as the limit. */
static double their_delta(const truth *t, int i)
{
    double sum = 0.0;
    int count = 0;
    for (int k = 0; k < 9; ++k) {
        const int x = i % SIDE + k % 3 - 1, y = i / SIDE + k / 3 - 1, at = y * SIDE + x;
        if (x >= 0 && y >= 0 && x < SIDE && y < SIDE && is_same(t, at)) {
            sum += (double)grey(&t->with, at) - (double)grey(&t->without, at);
            ++count;
        }
    }
    return sum / count;
}

static void judge_delta(const truth *t, const mix_job *j)
{
    int right = 0, asked = 0, darker[2] = {0}, brighter[2] = {0}, blank = 0;
    double mean = 0.0;
    for (int i = 0; i < PIXELS; ++i) {
        mean += (double)grey(&t->without, i) / PIXELS;
    }
    for (int i = 0; i < PIXELS; ++i) {
        const double theirs = is_same(t, i) ? their_delta(t, i) : 0.0;
        const double ours = (double)grey(&j->picture, i) - (double)grey(&t->without, i);
        if (fabs(theirs) > 0.02 * mean) {
            ++asked;
            right += theirs * ours > 0.0;
            blank += ours == 0.0;
            if (theirs < 0.0) {
                ++darker[ours < 0.0];
            } else {
                ++brighter[ours > 0.0];
            }
        }
    }
    printf("sign: right at %d of %d pixels (%.2f %%): darker %d, not %d; brighter %d, not %d; unchanged %d\n", right,
           asked, 100.0 * right / asked, darker[1], darker[0], brighter[1], brighter[0], blank);
    CHECK(right == asked);
}

/* Both maps have the same views, so a texel has the same power in both. Checks that no light is lost in the voxels. */
static void judge_energy(const mix_job *j)
{
    CHECK(memcmp(j->maps[0][0].view, j->maps[0][1].view, sizeof j->maps[0][0].view) == 0);
    for (int i = 0; i < 2; ++i) {
        const double all = j->voxels.flux[i] + j->voxels.lost[i];
        printf("energy %s the object: %.3f W, %.2f %% of it lost\n", i == 0 ? "without" : "with", all,
               100.0 * j->voxels.lost[i] / all);
        CHECK(j->voxels.lost[i] <= 0.02 * all);
    }
}

static void judge(const truth *t, mix_job *j)
{
    CHECK(rmse(&j->picture, &t->with, t, 0) <= 0.04);
    judge_energy(j);
    judge_shadow(t, j);
    judge_delta(t, j);
    printf("composite: relative RMSE %.4f (photo as it is: %.4f); where the surface is the same %.4f (%.4f)\n",
           rmse(&j->picture, &t->with, t, 0), rmse(&t->without, &t->with, t, 0), rmse(&j->picture, &t->with, t, 1),
           rmse(&t->without, &t->with, t, 1));
}

int main(int argc, char **argv)
{
    static truth t;
    const char *folder = argc > 1 ? argv[1] : "../shared";
    char object[600];
    report r = {""};
    mix_job *j = calloc(1, sizeof *j);
    snprintf(object, sizeof object, "%s/truth/mixed_with/object.obj", folder);
    if (j != NULL && read_truth(&t, folder)) {
        const clock_t from = clock();
        if (make_job(j, &t, object, &r)) {
            printf("%d planes; %.2f s\n", (int)j->planes.count, (double)(clock() - from) / CLOCKS_PER_SEC);
            judge(&t, j);
            if (argc > 2) {
                picture_write(argv[2], &j->picture, 0.0f, PICTURE_CLIPPED, &r);
            }
        } else {
            printf("FAIL: %s\n", r.text);
            ++test_failed;
        }
    }
    printf("%d passed, %d failed, %d skipped\n", test_passed, test_failed, test_skipped);
    return test_failed != 0;
}
