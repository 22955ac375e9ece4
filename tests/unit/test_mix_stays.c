/* test_mix_stays.c: a sequence with a moving camera and a Kinect's noise against the same without noise: the object's
 * position in the picture, the surface below it, its light and its shadow do not jump between frames. */
#include "../folder.h"

#include <math.h>
#include <stdlib.h>

#include "../../tools/mix/mix_next.h"
#include "../photo_job.h"
#include "../test.h"

void test_mix_stays(void);

enum { WIDTH = 160, HEIGHT = 120, PIXELS = WIDTH * HEIGHT, FRAMES = 5 };

static const lmb_pinhole camera = {WIDTH, HEIGHT, 131.25f, 131.25f, 79.5f, 59.5f};
static const char *mesh, *picture;

/* Measurements of one frame. */
typedef struct look {
    double foot[2];   /* the object's foot in the picture, px */
    double above;     /* m: the supporting plane over the foot */
    double light;     /* the object's mean brightness */
    double dark;      /* light that the shadow removes from the photo, in black pixels */
    double middle[2]; /* of the shadow, px */
    int32_t track;    /* of the supporting plane */
    double walls;     /* m: mean movement of the planes since the previous frame */
} look;

/* --- the room ----------------------------------------------------------------------------------------------------- */

/* x to the right, y down, z ahead. */
typedef struct seen {
    double far, shade;
    int what; /* floor, wall, side, box */
} seen;

static void meet(seen *s, double far, double shade, int what)
{
    if (far > 0.0 && far < s->far) {
        s->far = far;
        s->shade = shade;
        s->what = what;
    }
}

/* A box on the floor with three visible sides. */
static void meet_box(seen *s, const double from[3], const double ray[3])
{
    static const double low[3] = {0.55, 0.5, 2.0}, high[3] = {1.0, 0.9, 2.4};
    for (int axis = 0; axis < 3; ++axis) {
        const double far = (low[axis] - from[axis]) / ray[axis];
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        const double a = from[u] + far * ray[u], b = from[v] + far * ray[v];
        if (a > low[u] && a < high[u] && b > low[v] && b < high[v]) {
            meet(s, far, axis == 1 ? 0.5 : 0.3, 3);
        }
    }
}

static seen look_along(const double from[3], const double ray[3])
{
    seen s = {1e9, 0.0, 0};
    meet(&s, (0.9 - from[1]) / ray[1], 0.4, 0);
    meet(&s, (3.2 - from[2]) / ray[2], 0.3, 1);
    meet(&s, (-1.6 - from[0]) / ray[0], 0.25, 2);
    meet_box(&s, from, ray);
    return s;
}

/* A hand-held path to the right and a little down, turning back towards the scene. */
static void set_pose(double pose[16], int frame)
{
    test_rng rng = {(uint32_t)frame + 40};
    const double turn = -0.008 * frame + 0.002 * (double)test_uniform(&rng, -1, 1), nod = 0.002 * (double)test_uniform(&rng, -1, 1);
    const double c = cos(turn), s = sin(turn), d = cos(nod), e = sin(nod);
    const double out[16] = {c, s * e, s * d, 0.025 * frame, 0, d, -e, 0.01 * sin(frame), -s, c * e, c * d, 0.005 * frame, 0, 0, 0, 1};
    memcpy(pose, out, sizeof out);
}

static double gauss(test_rng *rng)
{
    double sum = 0.0;
    for (int i = 0; i < 12; ++i) {
        sum += (double)test_uniform(rng, -0.5f, 0.5f);
    }
    return sum;
}

/* Disparity over a base of 75 mm with a sensor of 525 px focal length: in eighths of a pixel, with missing spots. */
static float measured(double far, double noise, test_rng *rng)
{
    const double base = 0.075 * 525.0, shift = base / far + 0.1 * noise * gauss(rng);
    const int hole = test_uniform(rng, 0, 1) < 0.03f * (float)noise;
    return hole ? 0.0f : (float)(noise > 0.0 ? base / (floor(8.0 * shift + 0.5) / 8.0) : far);
}

static void take_frame(mix_job *j, int frame, double noise)
{
    static const float colours[4][3] = {{0.9f, 0.8f, 0.6f}, {0.8f, 0.8f, 0.9f}, {1.0f, 0.5f, 0.4f}, {0.4f, 0.6f, 1.0f}};
    test_rng rng = {(uint32_t)frame * 77 + 5};
    set_pose(j->frame.pose, frame);
    j->frame.has_pose = 1;
    const double *m = j->frame.pose, from[3] = {m[3], m[7], m[11]};
    for (int i = 0; i < PIXELS; ++i) {
        const double x = (i % WIDTH - (double)camera.cx) / (double)camera.fx, y = (i / WIDTH - (double)camera.cy) / (double)camera.fy;
        const double ray[3] = {m[0] * x + m[1] * y + m[2], m[4] * x + m[5] * y + m[6], m[8] * x + m[9] * y + m[10]};
        const seen s = look_along(from, ray);
        j->frame.depth[i] = measured(s.far, noise, &rng);
        for (int c = 0; c < 3; ++c) {
            j->frame.light.pixels[3 * i + c] = fmaxf(colours[s.what][c] * (float)(s.shade + 0.005 * noise * gauss(&rng)), 0.0f);
        }
    }
}

/* --- one sequence ------------------------------------------------------------------------------------------------- */

/* With a small sun, or with the guessed one, which is wide. */
static mix_job *begin(const mix_kept *k, int is_guessed)
{
    static char path[FOLDER_PATH], to[FOLDER_PATH];
    strcpy(path, mesh);
    strcpy(to, picture);
    char *argv[] = {"mix", "--frame", "known", "--object", path, "--fit", "--voxels", "6", "--shadow-map", "512", "--samples",
                    "4", "-q", "-o", to, "--light", "sun:0,0,0:0.6,-0.7,-0.4:0.6,0.6,0.6", NULL};
    mix_job *j = photo_job(is_guessed ? 15 : 17, argv, &camera);
    j->kept = k;
    return j;
}

/* Adds a floor pixel that the object does not cover to the shadow's sums. */
static void add_shadow(look *out, const mix_job *j, int i)
{
    double photo = 0.0, now = 0.0;
    for (int c = 0; c < 3; ++c) {
        photo += (double)j->frame.light.pixels[3 * i + c];
        now += (double)j->picture.pixels[3 * i + c];
    }
    const double taken = photo > 0.0 ? 1.0 - now / photo : 0.0;
    out->dark += taken;
    out->middle[0] += taken * (i % WIDTH);
    out->middle[1] += taken * (i / WIDTH);
}

static look look_at(const mix_kept *k)
{
    const mix_job *j = k->last;
    look out = {{0, 0}, 0, 0, 0, {0, 0}, 0, 0};
    double covered = 0.0;
    out.foot[0] = (double)(camera.cx - camera.fx * j->anchor.x / j->anchor.z);
    out.foot[1] = (double)(camera.cy + camera.fy * j->anchor.y / j->anchor.z);
    out.track = k->floor;
    if (j->floor >= 0) {
        const lmb_flat *p = &j->planes.plane[j->floor];
        out.above = -(double)(p->normal.x * j->anchor.x + p->normal.y * j->anchor.y + p->normal.z * j->anchor.z + p->distance);
    }
    for (int i = 0; i < PIXELS; ++i) {
        const mix_answer *a = &j->answer[i];
        covered += (double)a->covered;
        out.light += (double)(a->object[0] + a->object[1] + a->object[2]);
        if (a->covered == 0.0f) {
            add_shadow(&out, j, i);
        }
    }
    out.light /= covered;
    out.middle[0] /= out.dark;
    out.middle[1] /= out.dark;
    CHECK_MSG(j->floor >= 0 && covered > 100.0, "plane %d, %g pixels", (int)j->floor, covered);
    return out;
}

/* Mean movement of the planes since `was` at points 1.5 m to either side, up and down from the room's centre. */
static double moved(const mix_kept *k, const mix_track was[LMB_MAX_PLANES])
{
    double sum = 0.0, weight = 0.0;
    for (int32_t i = 0; i < k->tracks; ++i) {
        const mix_track *a = &was[i], *b = &k->track[i];
        const lmb_vec3 turn = {b->normal.x - a->normal.x, b->normal.y - a->normal.y, b->normal.z - a->normal.z};
        if (i != k->floor && a->seen > 0 && b->seen == a->seen + 1) {
            const double off = fabs((double)(b->distance - a->distance - 2.0f * turn.z)) +
                               1.5 * (double)(fabsf(turn.x) + fabsf(turn.y) + fabsf(turn.z));
            sum += off * (double)b->weight;
            weight += (double)b->weight;
        }
    }
    return weight > 0.0 ? sum / weight : 0.0;
}

static void run(look out[FRAMES], int frames, double noise, int is_guessed)
{
    static mix_track was[LMB_MAX_PLANES];
    mix_kept k;
    memset(&k, 0, sizeof k);
    for (int i = 0; i < frames; ++i) {
        report r = {""};
        mix_ready n;
        memset(&n, 0, sizeof n);
        n.job = begin(&k, is_guessed);
        take_frame(n.job, i, noise);
        memcpy(was, k.track, sizeof was);
        const int ok = mix_draw_next(&n, &k, &r);
        CHECK_MSG(ok, "frame %d: %s", i, r.text);
        mix_ready_free(&n);
        if (ok) {
            out[i] = look_at(&k);
            out[i].walls = moved(&k, was);
        }
    }
    mix_kept_free(&k);
}

/* Change of the error due to noise between two frames. */
static double step(double clean0, double clean1, double noisy0, double noisy1) { return fabs(noisy1 - clean1 - (noisy0 - clean0)); }

static void nothing_steps(void)
{
    look clean[FRAMES], noisy[FRAMES];
    run(clean, FRAMES, 0.0, 0);
    run(noisy, FRAMES, 1.0, 0);
    for (int i = 1; i < FRAMES; ++i) {
        const look *a = &clean[i - 1], *b = &clean[i], *c = &noisy[i - 1], *d = &noisy[i];
        for (int k = 0; k < 2; ++k) {
            const double foot = step(a->foot[k], b->foot[k], c->foot[k], d->foot[k]),
                         shadow = step(a->middle[k], b->middle[k], c->middle[k], d->middle[k]);
            CHECK_MSG(foot < 0.05, "frame %d: the object's foot by %g px", i, foot);
            CHECK_MSG(shadow < 0.6, "frame %d: its shadow by %g px", i, shadow);
        }
        const double light = step(log(a->light), log(b->light), log(c->light), log(d->light)),
                     dark = step(log(a->dark), log(b->dark), log(c->dark), log(d->dark));
        CHECK_MSG(light < 0.006, "frame %d: its light by %g", i, light);
        CHECK_MSG(dark < 0.05, "frame %d: its shadow's depth by %g", i, dark);
        CHECK_MSG(fabs(b->above) < 1e-4 && fabs(d->above) < 1e-4, "frame %d: the floor is %g, %g m over its foot", i, b->above,
                  d->above);
        CHECK_MSG(d->walls < 2.5e-3, "frame %d: walls by %g m", i, d->walls); /* 2.1 mm at most; 4.3 without tracks */
        CHECK_MSG(b->track == a->track && d->track == c->track, "frame %d: another floor", i);
    }
}

/* A wide sun's sample positions stay fixed in the world while the camera turns: the light changes by at most 0.3 % per
 * frame, or by 0.7 % if the camera determines them. */
static void places_of_a_sun_stay(void)
{
    look of[FRAMES];
    run(of, 4, 0.0, 1);
    for (int i = 1; i < 4; ++i) {
        const double light = fabs(log(of[i].light / of[i - 1].light));
        CHECK_MSG(light < 0.004, "frame %d: its light by %g", i, light);
    }
}

/* --- one frame read while the one before it is drawn -------------------------------------------------------------- */

enum { LISTED = 6, NO_POSE = -1 };

/* One frame is unusable, and one has the camera of the frame before. */
static const int listed[LISTED] = {0, NO_POSE, 1, 1, 2, 3};

typedef struct ahead {
    mix_kept kept;
    mix_spare spare;
    mix_aside aside;
    mix_ready next;
    int is_ahead, at, made_ready; /* made_ready: frames */
} ahead;

static void read_listed(ahead *a)
{
    memset(&a->next, 0, sizeof a->next);
    a->next.job = begin(&a->kept, 0);
    a->next.job->spare = a->is_ahead ? &a->spare : NULL; /* otherwise all memory is new */
    a->next.job->aside = &a->aside;
    take_frame(a->next.job, listed[a->at] < 0 ? 0 : listed[a->at], 1.0);
    a->next.job->frame.has_pose = listed[a->at] >= 0;
}

static void read_next(void *user, int index, int thread)
{
    ahead *a = user;
    (void)index;
    (void)thread;
    if (++a->at < LISTED) {
        read_listed(a);
        if (a->aside.is_beside) {
            mix_make_ready(&a->next, &a->kept);
            a->made_ready += a->next.has_depth;
        }
    }
}

/* Draws the pictures of the list in turn and returns their number. */
static int draw_list(float *pictures, int is_ahead, int *made_ready)
{
    static ahead a;
    int drawn = 0;
    memset(&a, 0, sizeof a);
    a.aside.run = read_next;
    a.aside.user = &a;
    a.is_ahead = is_ahead;
    read_listed(&a);
    while (a.at < LISTED) {
        report r = {""};
        mix_ready now = a.next;
        a.aside.count = is_ahead;
        if (mix_draw_next(&now, &a.kept, &r)) {
            memcpy(pictures + (size_t)(3 * PIXELS * drawn++), a.kept.last->picture.pixels, 3 * PIXELS * sizeof(float));
        } else {
            CHECK_MSG(listed[a.at - (is_ahead && a.aside.count == 0)] == NO_POSE, "frame %d: %s", a.at, r.text);
        }
        if (!is_ahead) {
            a.aside.count = 1;
        }
        if (a.aside.count > 0) {
            mix_aside_run(&a.aside, 1);
        }
        mix_ready_free(&now);
    }
    *made_ready = a.made_ready;
    mix_kept_free(&a.kept);
    mix_spare_free(&a.spare);
    return drawn;
}

/* Reading frames ahead gives the same pictures as reading them in turn: each uses only the knowledge of earlier
 * frames. */
static void ahead_is_the_same(void)
{
    const size_t bytes = (size_t)LISTED * 3 * PIXELS * sizeof(float);
    float *one = calloc(1, bytes), *other = calloc(1, bytes);
    int none, ready;
    if (one == NULL || other == NULL) {
        abort();
    }
    const int drawn = draw_list(one, 0, &none), same = draw_list(other, 1, &ready);
    CHECK_MSG(drawn == LISTED - 1 && same == drawn, "%d and %d frames", drawn, same);
    CHECK_MSG(none == 0 && ready == 2, "%d and %d made ready", none, ready);
    for (int i = 0; i < drawn; ++i) {
        CHECK_MSG(memcmp(one + 3 * PIXELS * i, other + 3 * PIXELS * i, 3 * PIXELS * sizeof(float)) == 0, "frame %d", i);
    }
    free(other);
    free(one);
}

void test_mix_stays(void)
{
    static const char box[] = "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv -1 2 -1\nv 1 2 -1\nv 1 2 1\nv -1 2 1\n"
                              "f 1 2 3 4\nf 8 7 6 5\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n";
    static folder f;
    folder_open(&f);
    mesh = folder_put(&f, "box.obj", box, sizeof box - 1);
    picture = folder_file(&f, "known.png"); /* never written, but checked for being writable */
    nothing_steps();
    places_of_a_sun_stay();
    ahead_is_the_same();
    folder_close(&f);
}
