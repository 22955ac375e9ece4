/* main_planes.c: compares the planes found in depth pictures with known planes. [M3 M4]
 *
 *     measure-planes [SHARED]     SHARED holds data/rgbd (default ../shared)
 *
 * Rooms of known planes with a Kinect's noise: 1.2 mm + 1.9 mm/m2 (z - 0.4 m)^2 (Nguyen et al. 2012), one pixel of
 * twenty missing. Bars: angle 0.5 degrees, offset 5 mm at the plane's middle, 0.9 of pixels in common (IoU). Then
 * frames of one world with known poses: each plane that two frames share must have the same normal within a degree. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <lambent/lambent.h>

#include "../../tools/mix/mix_frame.h"
#include "../test.h"

int test_passed, test_failed, test_skipped;

enum { WIDTH = 640, HEIGHT = 480, TRUE_PLANES = 4, ROOMS = 6, FRAMES = 4 };

/* n . p = d. */
typedef struct true_plane {
    double n[3], d;
} true_plane;

typedef struct work {
    lmb_cloud cloud;
    lmb_planes planes;
    void *memory[2];
    float depth[WIDTH * HEIGHT];
    uint8_t truth[WIDTH * HEIGHT];
} work;

static void find(work *w, const lmb_pinhole *camera, const float *depth)
{
    const size_t a = lmb_cloud_bytes(camera->width, camera->height),
                 b = lmb_planes_bytes(camera->width, camera->height);
    w->memory[0] = malloc(a);
    w->memory[1] = malloc(b);
    if (w->memory[0] == NULL || w->memory[1] == NULL ||
        lmb_cloud_init(&w->cloud, camera, depth, w->memory[0], a) != LMB_OK ||
        lmb_cloud_normals(&w->cloud, 0, LMB_MAX_SIDE) != LMB_OK ||
        lmb_planes_find(&w->planes, &w->cloud, w->memory[1], b) != LMB_OK) {
        printf("FAIL: the search was refused\n");
        exit(1);
    }
}

static void release(work *w)
{
    free(w->memory[0]);
    free(w->memory[1]);
}

/* --- rooms -------------------------------------------------------------------------------------------------------- */

static double normal_random(test_rng *rng)
{
    const double u = 1.0 - (double)test_uniform(rng, 0.0f, 1.0f), v = (double)test_uniform(rng, 0.0f, 6.2831853f);
    return sqrt(-2.0 * log(u)) * cos(v);
}

/* Floor, back wall and a side wall, seen by a tilted camera, and a table top. */
static void make_room(true_plane p[TRUE_PLANES], test_rng *rng)
{
    const double pitch = (double)test_uniform(rng, 0.15f, 0.7f), yaw = (double)test_uniform(rng, -0.5f, 0.5f);
    const double roll = (double)test_uniform(rng, -0.15f, 0.15f);
    const double axes[3][3] = {{0, 1, 0}, {sin(yaw), 0, cos(yaw)}, {cos(yaw), 0, -sin(yaw)}};
    for (int i = 0; i < TRUE_PLANES; ++i) {
        const double *a = axes[i == 3 ? 0 : i];
        const double y = a[1] * cos(pitch) + a[2] * sin(pitch), z = -a[1] * -sin(pitch) + a[2] * cos(pitch);
        p[i].n[0] = a[0] * cos(roll) - y * sin(roll);
        p[i].n[1] = a[0] * sin(roll) + y * cos(roll);
        p[i].n[2] = z;
    }
    p[0].d = -(double)test_uniform(rng, 1.2f, 1.7f);
    p[1].d = -(double)test_uniform(rng, 2.2f, 3.2f);
    p[2].d = -(double)test_uniform(rng, 0.9f, 1.4f);
    p[3].d = 0.5 * p[0].d;
}

static double distance_along(const true_plane *p, const double ray[3])
{
    const double c = p->n[0] * ray[0] + p->n[1] * ray[1] + p->n[2] * ray[2], z = p->d / c;
    return c < 0.0 && z > 0.0 ? z : 1e9;
}

/* Whether the ray meets the table's plane on the table top. */
static int on_table(const double ray[3], double z)
{
    return ray[0] * z < 0.55 && ray[0] * z > -0.35 && z < 1.9 && z > 0.7;
}

static void draw_room(work *w, const lmb_pinhole *c, const true_plane p[TRUE_PLANES], test_rng *rng)
{
    for (int i = 0; i < WIDTH * HEIGHT; ++i) {
        const double ray[3] = {((double)(i % WIDTH) - (double)c->cx) / (double)c->fx,
                               ((double)c->cy - (double)(i / WIDTH)) / (double)c->fy, -1.0};
        double best = 1e8;
        w->truth[i] = 0;
        for (int k = 0; k < TRUE_PLANES; ++k) {
            const double z = distance_along(&p[k], ray);
            if (z < best && (k < 3 || on_table(ray, z))) {
                best = z;
                w->truth[i] = (uint8_t)(k + 1);
            }
        }
        const double sigma = 0.0012 + 0.0019 * (best - 0.4) * (best - 0.4);
        const double z = floor((best + sigma * normal_random(rng)) * 1000.0 + 0.5) / 1000.0;
        w->depth[i] = test_uniform(rng, 0.0f, 1.0f) < 0.05f || best > 8.0 ? 0.0f : (float)z;
        w->truth[i] = best > 8.0 ? 0 : w->truth[i];
    }
}

/* Finds the plane that covers most pixels of a true one; `iou` is their intersection over union. */
static int match(double *iou, const work *w, int label)
{
    int both[LMB_MAX_PLANES + 1] = {0}, ours[LMB_MAX_PLANES + 1] = {0}, theirs = 0, best = 0;
    for (int i = 0; i < WIDTH * HEIGHT; ++i) {
        ++ours[w->planes.label[i]];
        theirs += w->truth[i] == label;
        both[w->planes.label[i]] += w->truth[i] == label;
    }
    for (int i = 1; i <= w->planes.count; ++i) {
        best = best == 0 || both[i] > both[best] ? i : best;
    }
    *iou = best > 0 ? (double)both[best] / (double)(theirs + ours[best] - both[best]) : 0.0;
    return theirs < WIDTH * HEIGHT / 100 ? -1 : best - 1;
}

static double angle_deg(const double a[3], lmb_vec3 b)
{
    const double x = a[1] * (double)b.z - a[2] * (double)b.y, y = a[2] * (double)b.x - a[0] * (double)b.z,
                 z = a[0] * (double)b.y - a[1] * (double)b.x;
    const double c = a[0] * (double)b.x + a[1] * (double)b.y + a[2] * (double)b.z;
    return atan2(sqrt(x * x + y * y + z * z), c) * 57.29577951308232;
}

static void judge_room(const work *w, const true_plane p[TRUE_PLANES], int room)
{
    for (int k = 0; k < TRUE_PLANES; ++k) {
        double iou;
        const int found = match(&iou, w, k + 1);
        if (found == -1) {
            continue;
        }
        const lmb_flat *f = &w->planes.plane[found < 0 ? 0 : found];
        const double angle = angle_deg(p[k].n, f->normal);
        const double offset = fabs(p[k].n[0] * (double)f->centre.x + p[k].n[1] * (double)f->centre.y +
                                   p[k].n[2] * (double)f->centre.z - p[k].d);
        printf("room %d plane %d: angle %.3f deg, offset %.2f mm, extent IoU %.3f (%d planes)\n", room, k, angle,
               1000.0 * offset, iou, (int)w->planes.count);
        CHECK(found >= 0 && angle <= 0.5);
        CHECK(offset <= 0.005);
        CHECK(iou >= 0.9);
    }
}

static void judge_rooms(work *w)
{
    const lmb_pinhole camera = {WIDTH, HEIGHT, 525.0f, 525.0f, 319.5f, 239.5f};
    test_rng rng = {8};
    for (int room = 0; room < ROOMS; ++room) {
        true_plane p[TRUE_PLANES];
        make_room(p, &rng);
        draw_room(w, &camera, p, &rng);
        find(w, &camera, w->depth);
        printf("noise of the picture: %.5f 1/m\n", (double)w->cloud.noise);
        judge_room(w, p, room);
        release(w);
    }
}

/* --- frames of one world ------------------------------------------------------------------------------------------ */

/* n . p = d in world space; the camera looks along +z with y down. */
static true_plane in_world(const lmb_flat *f, const double pose[16])
{
    const double n[3] = {(double)f->normal.x, -(double)f->normal.y, -(double)f->normal.z};
    true_plane p;
    p.d = -(double)f->distance;
    for (int i = 0; i < 3; ++i) {
        p.n[i] = pose[4 * i] * n[0] + pose[4 * i + 1] * n[1] + pose[4 * i + 2] * n[2];
        p.d += p.n[i] * pose[4 * i + 3];
    }
    return p;
}

/* For each plane of one frame, finds the nearest plane of the other. They are the same wall if they lie
 * within 5 cm and 10 degrees. */
static void compare_frames(const true_plane *a, int a_count, const true_plane *b, int b_count, double *worst,
                           int *shared)
{
    for (int i = 0; i < a_count; ++i) {
        double nearest = 0.05, turned = -1.0;
        for (int k = 0; k < b_count; ++k) {
            const lmb_vec3 n = {(float)b[k].n[0], (float)b[k].n[1], (float)b[k].n[2]};
            const double angle = angle_deg(a[i].n, n), off = fabs(a[i].d - b[k].d);
            if (angle < 10.0 && off < nearest) {
                nearest = off;
                turned = angle;
            }
        }
        if (turned >= 0.0) {
            printf("  shared: angle %.3f deg, offset %.1f mm\n", turned, 1000.0 * nearest);
            *worst = turned > *worst ? turned : *worst;
            ++*shared;
        }
    }
}

static void judge_frames(work *w, const char *folder)
{
    static true_plane planes[FRAMES][LMB_MAX_PLANES];
    int count[FRAMES] = {0}, shared = 0;
    double worst = 0.0;
    for (int i = 0; i < FRAMES; ++i) {
        char prefix[600];
        report r = {""};
        mix_frame f;
        mix_source s;
        memset(&s, 0, sizeof s);
        snprintf(prefix, sizeof prefix, "%s/data/rgbd/icl_living_%d", folder, i + 1);
        s.frame = prefix;
        if (!mix_frame_read(&f, &s, &r)) {
            SKIP("%s", r.text);
            return;
        }
        find(w, &f.camera, f.depth);
        for (int k = 0; k < w->planes.count; ++k) {
            /* Only the larger ones: walls, floor, ceiling. */
            if (w->planes.plane[k].pixels > WIDTH * HEIGHT / 25) {
                planes[i][count[i]++] = in_world(&w->planes.plane[k], f.pose);
            }
        }
        release(w);
        mix_frame_free(&f);
        for (int k = 0; k < i; ++k) {
            printf("frames %d and %d\n", k + 1, i + 1);
            compare_frames(planes[k], count[k], planes[i], count[i], &worst, &shared);
        }
    }
    printf("%d planes shared by frames, %.3f degrees apart at most\n", shared, worst);
    CHECK(shared > 0 && worst <= 1.0);
}

int main(int argc, char **argv)
{
    static work w;
    judge_rooms(&w);
    judge_frames(&w, argc > 1 ? argv[1] : "../shared");
    printf("%d passed, %d failed, %d skipped\n", test_passed, test_failed, test_skipped);
    return test_failed != 0;
}
