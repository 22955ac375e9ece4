/* main_sun.c: compares the light that `lambent mix` estimates for a photo with the light of the
 * photo's scene. [M23 M24]
 *
 *     measure-sun FOLDER [FIRST COUNT]...     caches photos in FOLDER
 *
 * Scenes by number: rooms under lamps, rooms beside a window outside the picture, and grounds with houses under an
 * overcast sky or in the sun. Sizes, colours, places and exposure are random. The photo and its depth are path-traced.
 * A small box is put where `mix` puts it, and the light at its middle is compared from 26 directions: mean brightness,
 * and how much brighter it is towards one side. Seeds 1 to 16 chose constants of mix_sun.c. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scene_photo.h"

int test_passed, test_failed, test_skipped;

enum { SIDE = 96, PIXELS = SIDE * SIDE, STRATA = 8, BOUNCES = 6, WAYS = 26, WAY_STRATA = 40, KINDS = 4 };

#define PI 3.141592653589793

static const char *const kinds[KINDS] = {"lamps", "window", "overcast", "sunny"};

typedef struct photo {
    float rgb[3 * PIXELS], depth[PIXELS];
} photo;

typedef struct stage {
    made_scene s;
    int white;   /* a material with albedo 1 that no surface has */
    double exposure;
    photo seen;
} stage;

/* --- photos ------------------------------------------------------------------------------------------------------- */

static int any_paint(made_scene *s, double low, double high)
{
    const double red = any_between(s, low, high), green = any_between(s, low, high), blue = any_between(s, low, high);
    return paint(s, red, green, blue);
}

/* Adds an emitting rectangle. */
static void shine(made_scene *s, svec a, svec u, svec v, double radiance)
{
    const int m = paint(s, 0, 0, 0);
    panel(s, m, a, u, v, NULL, 0);
    for (int c = 0; c < 3; ++c) {
        s->emission[m][c] = radiance;
    }
}

static void furnish(made_scene *s, svec low, svec high)
{
    const int count = (int)any_between(s, 3, 7);
    for (int i = 0; i < count; ++i) {
        const int m = any_between(s, 0, 1) < 0.3 ? paint(s, 0.82, 0.82, 0.8) : any_paint(s, 0.08, 0.65);
        const svec foot = at(any_between(s, low.x, high.x), low.y, any_between(s, low.z, high.z));
        if (any_between(s, 0, 1) < 0.3) {
            const double radius = any_between(s, 0.1, 0.25);
            ball(s, m, plus(foot, at(0, radius, 0)), radius, 8);
        } else {
            crate(s, m, foot, at(any_between(s, 0.2, 0.6), any_between(s, 0.2, 0.7), any_between(s, 0.2, 0.6)),
                  any_between(s, 0, 90));
        }
    }
}

static void build_indoors(made_scene *s, int has_window)
{
    const double wide = any_between(s, 3.2, 5), high = any_between(s, 2.4, 3), deep = any_between(s, 3.6, 5.5);
    const int floor = any_paint(s, 0.15, 0.5), ceiling = paint(s, 0.8, 0.8, 0.78);
    const int walls = any_between(s, 0, 1) < 0.5 ? paint(s, 0.75, 0.74, 0.7) : any_paint(s, 0.3, 0.7);
    shell(s, floor, walls, ceiling, at(0, 0, 0), at(wide, high, deep));
    furnish(s, at(0.4, 0, 0.4), at(wide - 0.8, 0, 0.6 * deep));
    if (has_window) {
        const double w = any_between(s, 1, 2), h = any_between(s, 1, 1.4), side = any_between(s, 0, 1);
        const svec a = side < 0.4   ? at(0.01, 0.9, 0.7 * deep - 0.5 * w)
                       : side < 0.8 ? at(wide - 0.01, 0.9, 0.7 * deep - 0.5 * w)
                                    : at(0.4, 0.9, deep - 0.01);
        shine(s, a, side < 0.8 ? at(0, 0, w) : at(w, 0, 0), at(0, h, 0), any_between(s, 4, 8));
    } else {
        const int lamps = 1 + (int)any_between(s, 0, 2);
        for (int i = 0; i < lamps; ++i) {
            const double size = any_between(s, 0.2, 1);
            shine(s, at(any_between(s, 0.3, 0.6) * wide, high - 0.01, any_between(s, 0.3, 0.7) * deep), at(size, 0, 0),
                  at(0, 0, any_between(s, 0.2, 1)), any_between(s, 4, 8) / size);
        }
    }
    look(s, at(any_between(s, 0.7, 0.9) * wide, any_between(s, 1.3, 1.7), any_between(s, 0.88, 0.95) * deep),
         at(any_between(s, 0.3, 0.5) * wide, 0.4, 0.3 * deep), any_between(s, 48, 62));
}

static void build_outdoors(made_scene *s, int is_sunny)
{
    const int ground = any_paint(s, 0.15, 0.45);
    panel(s, ground, at(-60, 0, -60), at(120, 0, 0), at(0, 0, 120), NULL, 0);
    furnish(s, at(-1.5, 0, -1), at(1.5, 0, 2.5));
    for (int i = 0; i < 3; ++i) {
        box(s, any_paint(s, 0.2, 0.7), at(-6.0 + 4.5 * i, 0, any_between(s, -7, -4)),
            at(-2.5 + 4.5 * i, any_between(s, 2.5, 5), any_between(s, -3.5, -2.5)));
    }
    const int sky = paint(s, 0, 0, 0);
    for (int c = 0; c < 3; ++c) {
        s->emission[sky][c] = 1;
    }
    box(s, sky, at(-61, -1, -61), at(61, 40, 61));
    if (is_sunny) {
        sun(s, at(any_between(s, -1, 1), -any_between(s, 0.6, 1.2), any_between(s, -1, 1)), any_between(s, 3, 14));
    }
    look(s, at(any_between(s, 1, 2.5), any_between(s, 1.4, 1.7), any_between(s, 5, 6)), at(any_between(s, -0.5, 0.5), 0.3, 0),
         any_between(s, 45, 60));
}

static void trace(stage *st, uint64_t seed, const path_tracer *p)
{
    const svec eye = st->s.eye, ahead = unit(less(st->s.target, eye));
    for (int i = 0; i < PIXELS; ++i) {
        path_point seen;
        test_rng random = {seed * 1000003u + (uint64_t)i * 977u + 1u};
        double direct[3] = {0, 0, 0}, rest[3] = {0, 0, 0}, glow[3] = {0, 0, 0};
        st->seen.depth[i] = 0.0f;
        if (path_eye(p, &seen, i % SIDE, i / SIDE, SIDE)) {
            (void)test_random(&random);
            path_direct(p, &seen, direct);
            path_bounced(p, &seen, BOUNCES, STRATA, &random, rest);
            memcpy(glow, st->s.emission[seen.material], sizeof glow);
            const double far = dot_of(less(seen.at, eye), ahead);
            st->seen.depth[i] = far < 15.0 ? (float)far : 0.0f;
        }
        for (int c = 0; c < 3; ++c) {
            st->seen.rgb[3 * i + c] = (float)(direct[c] + rest[c] + glow[c]);
        }
    }
}

static int by_value(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

/* Exposes as a camera does: at most a tenth of the pixels is white. */
static void expose(stage *st)
{
    static float grey[PIXELS];
    for (int i = 0; i < PIXELS; ++i) {
        grey[i] = (st->seen.rgb[3 * i] + st->seen.rgb[3 * i + 1] + st->seen.rgb[3 * i + 2]) / 3.0f;
    }
    qsort(grey, PIXELS, sizeof *grey, by_value);
    const int rank = (int)(any_between(&st->s, 0.9, 0.99) * PIXELS);
    st->exposure = 1.0 / (double)grey[rank];
    for (int i = 0; i < 3 * PIXELS; ++i) {
        st->seen.rgb[i] = fminf((float)(st->exposure * (double)st->seen.rgb[i]), 1.0f);
    }
}

static int get_photo(stage *st, const char *folder, int seed, const path_tracer *p)
{
    char path[600];
    snprintf(path, sizeof path, "%s/sun_%d.photo", folder, seed);
    if (scene_keep(path, &st->seen, sizeof st->seen, 1)) {
        return 1;
    }
    trace(st, (uint64_t)seed, p);
    return scene_keep(path, &st->seen, sizeof st->seen, 0);
}

/* --- ours --------------------------------------------------------------------------------------------------------- */

static int light_photo(mix_job *j, const stage *st, char *object, report *r)
{
    char *argv[] = {"mix", "--frame", "known", "--object", object, "-o", "known.pfm", "--quiet", NULL};
    if (!mix_options_parse(&j->o, 8, argv, r)) {
        return 0;
    }
    return scene_photo(j, &st->s, SIDE, st->seen.rgb, st->seen.depth, r) && mix_find_planes(j, r) && mix_place(j, r) &&
           mix_light(j, r);
}

/* --- both --------------------------------------------------------------------------------------------------------- */

/* Mean irradiance over all directions, and the cosine-shaped part towards one direction. */
typedef struct level {
    double mean, side;
    svec to;
} level;

static svec way(int i)
{
    const int k = i < 13 ? i : i + 1; /* of 27 without the middle */
    return unit(at(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1));
}

/* The 6 face, 8 corner and 12 edge directions are each uniform on the sphere. */
static level level_of(const double e[WAYS])
{
    level l = {0, 0, {0, 0, 0}};
    for (int i = 0; i < WAYS; ++i) {
        l.mean += e[i] / WAYS;
        l.to = plus(l.to, times(way(i), 3.0 * e[i] / WAYS));
    }
    l.side = sqrt(dot_of(l.to, l.to));
    return l;
}

static level true_level(const stage *st, const path_tracer *p, svec here)
{
    double e[WAYS];
    test_rng random = {77};
    for (int i = 0; i < WAYS; ++i) {
        const path_point at_here = {here, way(i), st->white};
        double direct[3], rest[3];
        path_direct(p, &at_here, direct);
        path_bounced(p, &at_here, BOUNCES, WAY_STRATA, &random, rest);
        e[i] = 0.0;
        for (int c = 0; c < 3; ++c) {
            e[i] += PI * st->exposure * (direct[c] + rest[c]) / 3.0;
        }
    }
    return level_of(e);
}

/* Reads the level at the object's place from the folder, or computes it. */
static level kept_level(const stage *st, const path_tracer *p, svec here, const char *folder, int seed)
{
    struct kept {
        svec here;
        double exposure;
        level found;
    } k;
    char path[600];
    snprintf(path, sizeof path, "%s/sun_%d.level", folder, seed);
    FILE *f = fopen(path, "rb");
    const int is_read = f != NULL && fread(&k, sizeof k, 1, f) == 1;
    const svec off = is_read ? less(k.here, here) : here;
    if (f != NULL) {
        fclose(f);
    }
    if (!is_read || dot_of(off, off) > 1e-4 || k.exposure != st->exposure) {
        memset(&k, 0, sizeof k);
        k.here = here;
        k.exposure = st->exposure;
        k.found = true_level(st, p, here);
        f = fopen(path, "wb");
        if (f != NULL) {
            fwrite(&k, sizeof k, 1, f);
            fclose(f);
        }
    }
    return k.found;
}

static level our_level(const mix_job *j)
{
    double e[WAYS];
    for (int i = 0; i < WAYS; ++i) {
        const svec n = way(i);
        const float *m = j->from_world.m;
        const lmb_vec3 v = {m[0] * (float)n.x + m[4] * (float)n.y + m[8] * (float)n.z,
                            m[1] * (float)n.x + m[5] * (float)n.y + m[9] * (float)n.z,
                            m[2] * (float)n.x + m[6] * (float)n.y + m[10] * (float)n.z};
        float rgb[3];
        lmb_env_irradiance(rgb, &j->env[0], v);
        for (int32_t k = 0; k < j->light_count - j->lamp_count; ++k) {
            const lmb_light *l = &j->lights[k];
            const float cosine = -(v.x * l->direction.x + v.y * l->direction.y + v.z * l->direction.z);
            for (int c = 0; c < 3; ++c) {
                rgb[c] += fmaxf(cosine, 0.0f) * l->intensity[c];
            }
        }
        e[i] = ((double)rgb[0] + (double)rgb[1] + (double)rgb[2]) / 3.0;
    }
    return level_of(e);
}

static svec foot_of(const mix_job *j, const made_scene *s)
{
    double pose[16];
    scene_pose(pose, s);
    const double a[3] = {(double)j->anchor.x, -(double)j->anchor.y, -(double)j->anchor.z};
    double out[3];
    for (int i = 0; i < 3; ++i) {
        out[i] = pose[4 * i] * a[0] + pose[4 * i + 1] * a[1] + pose[4 * i + 2] * a[2] + pose[4 * i + 3];
    }
    return at(out[0], out[1], out[2]);
}

typedef struct sums {
    double level, side, bias;
    int count;
} sums;

static int write_object(const char *path)
{
    FILE *f = fopen(path, "w");
    if (f == NULL) {
        return 0;
    }
    for (int i = 0; i < 8; ++i) {
        fprintf(f, "v %g %g %g\n", i & 1 ? 0.1 : -0.1, i & 2 ? 0.25 : 0.0, i & 4 ? 0.1 : -0.1);
    }
    fputs("f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n", f);
    return fclose(f) == 0;
}

static void measure(stage *st, int seed, const char *folder, sums all[KINDS])
{
    char object[600];
    report r = {""};
    path_tracer p;
    const int kind = seed % KINDS;
    mix_job *j = calloc(1, sizeof *j);
    memset(st, 0, sizeof *st);
    st->s.up = at(0, 1, 0);
    st->s.near_m = 0.1;
    st->s.random = (uint64_t)seed * 7919u + 13u;
    (void)any_between(&st->s, 0, 1);
    if (kind < 2) {
        build_indoors(&st->s, kind == 1);
    } else {
        build_outdoors(&st->s, kind == 3);
    }
    st->white = paint(&st->s, 1, 1, 1);
    snprintf(object, sizeof object, "%s/sun_box.obj", folder);
    if (j == NULL || !write_object(object) || !path_open(&p, &st->s) || !get_photo(st, folder, seed, &p)) {
        printf("FAIL %d: cannot be kept in %s\n", seed, folder);
        ++test_failed;
        free(j);
        return;
    }
    expose(st);
    if (!light_photo(j, st, object, &r)) {
        printf("%3d %-8s %s\n", seed, kinds[kind], r.text);
    } else {
        const level theirs = kept_level(st, &p, plus(foot_of(j, &st->s), at(0, 0.15, 0)), folder, seed), ours = our_level(j);
        const double bright = log2(ours.mean / theirs.mean), a = ours.side / ours.mean, b = theirs.side / theirs.mean;
        printf("%3d %-8s mean %.2f of %.2f (%+.2f stops), to one side %.2f, true %.2f; %.0f degrees wide\n", seed, kinds[kind],
               ours.mean, theirs.mean, bright, a, b, (double)j->sun_size);
        all[kind].level += bright * bright;
        all[kind].bias += bright;
        all[kind].side += (a - b) * (a - b);
        ++all[kind].count;
    }
    path_close(&p);
    mix_job_free(j);
    scene_drop(&st->s);
}

int main(int argc, char **argv)
{
    static stage st;
    const char *folder = argc > 1 ? argv[1] : ".";
    for (int i = 2; i < (argc > 3 ? argc : 3); i += 2) {
        const int first = argc > 3 ? atoi(argv[i]) : 1, count = i + 1 < argc ? atoi(argv[i + 1]) : 16;
        sums all[KINDS];
        memset(all, 0, sizeof all);
        for (int k = 0; k < count; ++k) {
            measure(&st, first + k, folder, all);
        }
        for (int k = 0; k < KINDS; ++k) {
            const double n = all[k].count > 0 ? all[k].count : 1;
            printf("%d..%d %-8s %d: level off by %.2f stops (mean %+.2f), side by %.2f\n", first, first + count - 1,
                   kinds[k], all[k].count, sqrt(all[k].level / n), all[k].bias / n, sqrt(all[k].side / n));
        }
    }
    printf("%d passed, %d failed, %d skipped\n", test_passed, test_failed, test_skipped);
    return test_failed != 0;
}
