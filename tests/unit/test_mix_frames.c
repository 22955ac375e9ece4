/* test_mix_frames.c: sequences: depth kept between frames, valid poses, and an object that stays in place. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../tools/mix/mix_between.h"
#include "../../tools/mix/mix_carry.h"
#include "../../tools/mix/mix_frames.h"
#include "../test.h"

void test_mix_frames(void);

enum { WIDTH = 96, HEIGHT = 72, PIXELS = WIDTH * HEIGHT };

static const lmb_pinhole camera = {WIDTH, HEIGHT, 80.0f, 80.0f, 47.5f, 35.5f};
static const double still[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

static mix_frame frame_at(double x)
{
    mix_frame f;
    memset(&f, 0, sizeof f);
    f.camera = camera;
    f.has_pose = 1;
    memcpy(f.pose, still, sizeof still);
    f.pose[3] = x;
    f.depth = malloc(PIXELS * sizeof(float));
    f.light.width = WIDTH;
    f.light.height = HEIGHT;
    f.light.channels = 3;
    f.light.pixels = malloc(3 * PIXELS * sizeof(float));
    for (int i = 0; i < 3 * PIXELS; ++i) {
        f.light.pixels[i] = 0.3f;
    }
    return f;
}

static void fill(mix_frame *f, float depth)
{
    for (int i = 0; i < PIXELS; ++i) {
        f->depth[i] = depth;
    }
}

/* A static camera: noise changes nothing, earlier measurements fill a hole, and a changed depth is accepted the second
 * time. */
static void depth_stays(void)
{
    mix_depth d;
    report r = {""};
    mix_frame f = frame_at(0.0);
    memset(&d, 0, sizeof d);
    fill(&f, 2.0f);
    f.depth[5] = 0.0f;
    f.depth[9] = NAN;
    CHECK(mix_keep_depth(&d, &f, &r) && f.depth[5] == 0.0f && f.depth[9] == 0.0f && f.depth[6] == 2.0f);
    fill(&f, 2.01f);
    f.depth[6] = 0.0f;
    f.depth[7] = 1.0f;
    f.depth[8] = INFINITY;
    CHECK(mix_keep_depth(&d, &f, &r));
    CHECK(f.depth[4] == 2.0f && f.depth[6] == 2.0f && f.depth[7] == 2.0f && f.depth[8] == 2.0f);
    CHECK(fabsf(f.depth[5] - 2.01f) < 1e-5f);
    fill(&f, 2.01f);
    f.depth[7] = 1.0f;
    CHECK(mix_keep_depth(&d, &f, &r) && f.depth[7] == 1.0f && f.depth[4] == 2.0f);
    mix_frame_free(&f);
    mix_depth_free(&d);
}

/* A camera that moves right by eight pixels of a wall: gaps are filled with the depth seen there before; beyond the old
 * picture there is none. Another picture size starts over. */
static void depth_moves(void)
{
    mix_depth d;
    report r = {""};
    mix_frame f = frame_at(0.0);
    memset(&d, 0, sizeof d);
    for (int i = 0; i < PIXELS; ++i) {
        f.depth[i] = i % WIDTH < 40 ? 2.0f : 2.5f;
    }
    CHECK(mix_keep_depth(&d, &f, &r));
    fill(&f, 0.0f);
    f.pose[3] = 8.0 * 2.0 / 80.0;
    CHECK(mix_keep_depth(&d, &f, &r));
    CHECK(f.depth[20 * WIDTH + 31] == 2.0f && fabsf(f.depth[20 * WIDTH + 60] - 2.5f) < 1e-5f);
    CHECK(f.depth[20 * WIDTH + 95] == 0.0f);
    f.camera.width = WIDTH / 2;
    fill(&f, 3.0f);
    CHECK(mix_keep_depth(&d, &f, &r) && fabsf(f.depth[0] - 3.0f) < 1e-5f && d.camera.width == WIDTH / 2);
    mix_frame_free(&f);
    mix_depth_free(&d);
}

static void poses(void)
{
    double p[16];
    memcpy(p, still, sizeof p);
    CHECK(mix_is_pose(p));
    p[0] = -1.0; /* mirrored */
    CHECK(!mix_is_pose(p));
    p[5] = -1.0; /* half a turn */
    CHECK(mix_is_pose(p));
    p[10] = 2.0;
    CHECK(!mix_is_pose(p));
    p[10] = 1.0;
    p[3] = (double)NAN;
    CHECK(!mix_is_pose(p));
    memset(p, 0, sizeof p);
    CHECK(!mix_is_pose(p));
}

static mix_job *job_at(double x, const mix_kept *k)
{
    static char square[] = "tests/fuzz/corpus/obj/quads.obj";
    char *argv[] = {"mix", "--frame", "known", "--object", square, "--fit", "--voxels", "5", "--shadow-map", "64", "-q",
                    "-o", "known.pfm", NULL};
    report r = {""};
    mix_job *j = calloc(1, sizeof *j);
    if (j == NULL) {
        abort();
    }
    CHECK_MSG(mix_options_parse(&j->o, 13, argv, &r), "%s", r.text);
    j->kept = k;
    j->frame = frame_at(x);
    for (int i = 0; i < PIXELS; ++i) {
        const lmb_vec3 ray = lmb_cloud_ray(&camera, (float)(i % WIDTH), (float)(i / WIDTH));
        const float floor = ray.y < -0.01f ? -0.5f / ray.y : 1e9f;
        j->frame.depth[i] = floor < 2.5f ? floor : 2.5f;
    }
    return j;
}

/* The camera moves 0.1 m to the right, so the object moves 0.1 m to the left in camera space; plane and sun stay. */
static void object_stays(void)
{
    mix_kept k;
    report r = {""};
    memset(&k, 0, sizeof k);
    mix_job *a = job_at(0.0, &k);
    CHECK(mix_find_planes(a, &r) && mix_place(a, &r) && mix_light(a, &r) && mix_keep(&k, a, &r));
    mix_job *b = job_at(0.1, &k);
    CHECK_MSG(mix_find_planes(b, &r) && mix_place(b, &r) && mix_light(b, &r), "%s", r.text);
    CHECK(fabsf(b->anchor.x - a->anchor.x + 0.1f) < 1e-5f && fabsf(b->anchor.y - a->anchor.y) < 1e-5f);
    CHECK(b->floor >= 0 && b->scale == a->scale && a->object_triangles == b->object_triangles);
    CHECK(fabsf(b->placed.m[12] - a->placed.m[12] + 0.1f) < 1e-3f && fabsf(b->placed.m[14] - a->placed.m[14]) < 1e-3f);
    CHECK(fabsf(b->lights[0].direction.x - a->lights[0].direction.x) < 1e-3f &&
          b->lights[0].intensity[0] == a->lights[0].intensity[0]);
    mix_job_free(a);
    mix_job_free(b);
    mix_kept_free(&k);
}

enum { SEEN = 16 /* planes of a frame */ };

/* A frame with planes at distances `from`, from + 1 ... m; the object is on plane `floor`. The first ones continue
 * tracks 0, 1 ... */
static void keep_frame(mix_kept *k, mix_job *j, int from, int go_on, int32_t floor)
{
    memset(j, 0, sizeof *j);
    j->planes.count = SEEN;
    j->floor = floor;
    for (int i = 0; i < SEEN; ++i) {
        j->planes.plane[i].normal = (lmb_vec3){0, 0, 1};
        j->planes.plane[i].distance = (float)(from + i);
        j->planes.plane[i].pixels = 100;
        j->track[i] = i < go_on ? i : -1;
    }
    mix_keep_planes(k, j);
    ++k->frames;
}

static int32_t track_at(const mix_kept *k, int far)
{
    for (int32_t i = 0; i < k->tracks; ++i) {
        if (k->track[i].distance == (float)far) {
            return i;
        }
    }
    return -1;
}

/* More planes than tracks: the floor keeps its track, new planes get one each, and a plane not seen for long loses its
 * track, however often it was seen. */
static void tracks_are_few(void)
{
    static mix_job j;
    mix_kept k;
    memset(&k, 0, sizeof k);
    k.floor = -1;
    keep_frame(&k, &j, 1, 0, 0);
    keep_frame(&k, &j, 1, SEEN, 0);
    CHECK(k.floor == 0 && k.tracks == SEEN && k.track[0].seen == 2);
    keep_frame(&k, &j, 101, 0, -1); /* eight are free */
    CHECK(k.tracks == LMB_MAX_PLANES && k.floor == 0 && k.track[0].distance == 1.0f);
    for (int i = 0; i < SEEN; ++i) {
        CHECK_MSG(track_at(&k, 101 + i) > 0, "plane %d of the third frame has no track", i);
    }
    keep_frame(&k, &j, 201, 0, -1);
    int32_t left = 0;
    for (int i = 0; i < SEEN; ++i) {
        CHECK_MSG(track_at(&k, 201 + i) > 0, "plane %d of the fourth frame has no track", i);
        left += track_at(&k, 101 + i) > 0;
        CHECK_MSG(i == 0 || track_at(&k, 1 + i) < 0, "plane %d was not seen for two frames", i);
    }
    CHECK_MSG(k.floor == 0 && track_at(&k, 1) == 0 && left == LMB_MAX_PLANES - 1 - SEEN, "%d left", (int)left);
}

/* A plane with the floor's number at another position is not the object's floor. */
static void floor_is_below(void)
{
    mix_kept k;
    report r = {""};
    memset(&k, 0, sizeof k);
    mix_job *a = job_at(0.0, &k);
    CHECK(mix_find_planes(a, &r) && mix_place(a, &r) && mix_light(a, &r) && mix_keep(&k, a, &r));
    CHECK(k.tracks == 2 && k.floor >= 0);
    k.floor = 1 - k.floor;
    mix_job *b = job_at(0.1, &k);
    CHECK(mix_find_planes(b, &r) && mix_place(b, &r) && b->floor >= 0 && b->planes.plane[b->floor].normal.y > 0.99f);
    mix_job_free(a);
    mix_job_free(b);
    mix_kept_free(&k);
}

/* A guessed sun is kept, even next to the object's lamps; explicit lights are not. */
static void sun_stays(void)
{
    mix_kept k;
    report r = {""};
    memset(&k, 0, sizeof k);
    mix_job *a = job_at(0.0, &k);
    CHECK(mix_find_planes(a, &r) && mix_place(a, &r) && mix_light(a, &r) && a->light_count == MIX_SUN_SAMPLES);
    a->lamp_count = 2;
    a->light_count += 2;
    CHECK(mix_keep_light(&k, a, &r) && k.has_sun);
    mix_kept_free(&k);
    memset(&k, 0, sizeof k);
    a->o.light_count = 1;
    CHECK(mix_keep_light(&k, a, &r) && !k.has_sun);
    mix_job_free(a);
    mix_kept_free(&k);
}

static int find_world(mix_job *j)
{
    report r = {""};
    const int ok = mix_find_planes(j, &r) && mix_place(j, &r) && mix_light(j, &r) && mix_voxels(j, &r);
    CHECK_MSG(ok, "%s", r.text);
    return ok;
}

static int draw(mix_job *j)
{
    report r = {""};
    const int ok = find_world(j) && mix_draw(j, &r);
    CHECK_MSG(ok, "%s", r.text);
    return ok;
}

/* RMS difference of the surrounding light over the mean, and the number of pixels in both. */
static double apart(const mix_job *a, const mix_job *b, int *both)
{
    double sum = 0.0, mean = 0.0;
    *both = 0;
    for (int i = 0; i < PIXELS; ++i) {
        if (a->carried[i].is_known && b->carried[i].is_known) {
            const double d = (double)a->carried[i].rgb[1][0] - (double)b->carried[i].rgb[1][0];
            ++*both;
            sum += d * d;
            mean += (double)a->carried[i].rgb[1][0];
        }
    }
    return sqrt(sum * *both) / mean;
}

/* With a sun without size, so that the shadow has an edge: light that is smooth everywhere could be reprojected well by
 * chance. */
static mix_job *sunny_at(double x, const mix_kept *k)
{
    mix_job *j = job_at(x, k);
    lmb_light *l = &j->o.lights[0];
    memset(l, 0, sizeof *l);
    l->kind = LMB_LIGHT_DIRECTIONAL;
    l->direction = (lmb_vec3){-0.6427876f, 0.7660444f, 0.0f};
    l->cos_inner = l->cos_outer = 1.0f;
    l->intensity[0] = l->intensity[1] = l->intensity[2] = 0.369f;
    j->o.light_count = 1;
    return j;
}

/* Frame c takes all light from frame a, which is 7 everywhere. Within 72 frames each pixel between others is traced
 * again, and so is each that edges and curved surfaces separate from them; in a single frame few are. */
static void all_is_traced_again(mix_job *c, mix_job *a, mix_kept *k)
{
    enum { TURNS = 72, TILES = PIXELS / LMB_TILE_PIXELS };
    static mix_batch batch;
    static uint64_t fresh[TILES], known[TILES];
    int most = 0, never = 0, all = 0, stale = 0;
    for (int i = 0; i < PIXELS; ++i) {
        for (int n = 0; n < 6; ++n) {
            a->carried[i].rgb[n / 3][n % 3] = 7.0f;
            a->carried[i].direct[n % 3] = 1.0f;
        }
    }
    memset(fresh, 0, sizeof fresh);
    for (k->frames = 1; k->frames <= TURNS; ++k->frames) {
        int now = 0;
        for (int i = 0; i < TILES; ++i) {
            batch.count = 1;
            lmb_real_tile(&batch.real[0], &c->cloud, &c->planes, &c->real, &c->axes, i % (WIDTH / LMB_TILE) * LMB_TILE,
                          i / (WIDTH / LMB_TILE) * LMB_TILE);
            mix_cones_batch(&batch, c);
            known[i] = mix_between_pixels(&batch.real[0]);
            for (int q = 0; q < LMB_TILE_PIXELS; ++q) {
                const int is_new = batch.real[0].id[q] != 0 && fabsf(batch.light[0][0].rgb[0][q] - 7.0f) > 1e-4f;
                fresh[i] |= (uint64_t)is_new << q;
                stale += is_new && (batch.direct[0].known >> q & 1) != 0;
                now += is_new && (known[i] >> q & 1) != 0;
            }
        }
        most = now > most ? now : most;
    }
    for (int i = 0; i < PIXELS; ++i) {
        const int is_known = (int)(known[i / LMB_TILE_PIXELS] >> i % LMB_TILE_PIXELS & 1);
        all += is_known;
        never += is_known && (fresh[i / LMB_TILE_PIXELS] >> i % LMB_TILE_PIXELS & 1) == 0;
    }
    CHECK_MSG(never == 0 && all > 4 * TILES + 50, "%d of %d pixels keep their light", never, all);
    CHECK_MSG(stale == 0, "%d pixels that are traced again keep the lights' own light", stale);
    CHECK_MSG(10 * most < all, "%d of %d pixels in one frame", most, all);
}

/* The camera moves: the first frame's voxels continue to be traced, including cells now out of the picture, and
 * reprojected light equals traced light. A wall that comes near the object ends this, as does a switched lamp. */
static void one_world(void)
{
    mix_kept k;
    report r = {""};
    int both;
    memset(&k, 0, sizeof k);
    mix_job *a = sunny_at(0.0, &k), *b = sunny_at(0.1, &k), *c = sunny_at(0.1, &k), *d = sunny_at(0.05, &k);
    if (draw(a) && mix_keep(&k, a, &r)) {
        CHECK(a->world == a && a->old_cells == 0);
        k.world = a;
        CHECK(draw(b) && b->world == a && b->voxels.count == 0 && b->old_cells > 0 && b->old_cells < b->real.count / 4);
        k.last = a;
        CHECK(draw(c) && c->world == a);
        const double off = apart(b, c, &both);
        int all;
        CHECK_MSG(off > 0.0 && 2.0 * off < apart(b, a, &all) && both > PIXELS * 9 / 10, "%g of %g at %d pixels", off,
                  apart(b, a, &all), both);
        all_is_traced_again(c, a, &k);
        for (int i = 0; i < PIXELS; ++i) {
            const int near = i % WIDTH > WIDTH * 5 / 8;
            d->frame.depth[i] = near && d->frame.depth[i] > 1.4f ? 1.4f : d->frame.depth[i];
        }
        CHECK(find_world(d) && d->world == d && d->voxels.count > 0);
        mix_job *e = sunny_at(0.05, &k);
        k.is_other_light = 1;
        CHECK(find_world(e) && e->world == e);
        mix_job_free(e);
    }
    mix_job_free(d);
    mix_job_free(c);
    mix_job_free(b);
    k.world = NULL; /* k.last too */
    mix_kept_free(&k);
}

/* A finished job's memory is reused if it is at least as large as needed and at most twice as large; it is as if
 * new. */
static void memory_is_used_again(void)
{
    static mix_spare spare;
    report r = {""};
    void *at[3] = {NULL, NULL, NULL};
    for (int i = 0; i < 3; ++i) {
        static const size_t bytes[3] = {1000, 600, 400}; /* one piece: it is 1000, and too large for the last */
        mix_job *j = calloc(1, sizeof *j);
        if (j == NULL) {
            abort();
        }
        j->spare = &spare;
        unsigned char *m = mix_take(j, bytes[i], &r);
        at[i] = m;
        for (size_t k = 0; k < bytes[i]; ++k) {
            CHECK(m[k] == 0);
            m[k] = 0xff;
        }
        mix_job_free(j);
    }
    CHECK(at[1] == at[0] && at[2] != at[0] && spare.count == 2);
    for (int i = 0; i < 2 * MIX_IDLE + 1; ++i) { /* jobs that need none, and jobs with other sizes */
        mix_job *j = calloc(1, sizeof *j);
        if (j == NULL) {
            abort();
        }
        j->spare = &spare;
        CHECK(i < MIX_IDLE || mix_take(j, 10, &r) != NULL);
        mix_job_free(j);
        CHECK(i >= MIX_IDLE || spare.count == 2);
    }
    CHECK_MSG(spare.count == 1, "%d pieces are kept", spare.count); /* the one of ten bytes */
    mix_spare_free(&spare);
    CHECK(spare.count == 0);
}

void test_mix_frames(void)
{
    memory_is_used_again();
    one_world();
    depth_stays();
    depth_moves();
    poses();
    object_stays();
    tracks_are_few();
    floor_is_below();
    sun_stays();
}
