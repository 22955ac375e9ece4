/* light_probes.c: bounced light in the air as a lattice of spherical harmonics: a JSON and a file of numbers. */
#include "light_export.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../common/byte_buffer.h"
#include "../common/fvec.h"
#include "../common/io_json.h"
#include "../common/text_buffer.h"
#include "light_distances.h"

enum { TERMS = 9, FLOATS = 3 * TERMS + 1, ALL_FLOATS = FLOATS + LIGHT_DISTANCES, NORMALS = LIGHT_PROBE_NORMALS,
       TOGETHER = 4, ACROSS = 12, MOST = 1 << 16, PATH = 4096 };
#define NEAREST 0.05f /* of a cell's diagonal: closer surfaces count as so far */
#define SOLID 1e-4f /* weight of a probe in a solid, which counts if all are */
#define OPEN 0.25f /* of all directions: a point that sees less of lit surfaces counts as inside or behind a solid */

/* Harmonics of the radiance of R, G and B, W/(sr m2); the share of directions that see a lit surface; distances. */
typedef struct probe {
    float v[ALL_FLOATS];
} probe;

typedef struct lattice {
    lmb_vec3 first, step; /* m */
    int32_t count[3];     /* along x, y, z */
    probe *probe;         /* x varies fastest */
} lattice;

/* --- harmonics ---------------------------------------------------------------------------------------------------- */

/* Real harmonics, index l l + l + m. */
static void harmonics(float y[TERMS], lmb_vec3 n)
{
    y[0] = 0.282095f;
    y[1] = 0.488603f * n.y;
    y[2] = 0.488603f * n.z;
    y[3] = 0.488603f * n.x;
    y[4] = 1.092548f * n.x * n.y;
    y[5] = 1.092548f * n.y * n.z;
    y[6] = 0.315392f * (3.0f * n.z * n.z - 1.0f);
    y[7] = 1.092548f * n.x * n.z;
    y[8] = 0.546274f * (n.x * n.x - n.y * n.y);
}

/* Factor of the clamped cosine for each term. */
static float cosine_of(int term) { return term == 0 ? 3.141593f : term < 4 ? 2.094395f : 0.785398f; }

/* Axes and diagonals: with these weights, sums over the sphere are exact up to order five (Lebedev). */
lmb_vec3 light_probe_normal(int k, float *weight)
{
    const float sign = k % 2 ? -1.0f : 1.0f, d = 0.57735027f;
    *weight = 12.566371f * (k < 6 ? 1.0f / 15.0f : 3.0f / 40.0f);
    if (k < 6) {
        return vec3(k / 2 == 0 ? sign : 0.0f, k / 2 == 1 ? sign : 0.0f, k / 2 == 2 ? sign : 0.0f);
    }
    return vec3((k - 6) & 1 ? d : -d, (k - 6) & 2 ? d : -d, (k - 6) & 4 ? d : -d);
}

/* --- the lattice -------------------------------------------------------------------------------------------------- */

static size_t count_of(const lattice *l) { return (size_t)l->count[0] * (size_t)l->count[1] * (size_t)l->count[2]; }

static float step_of(const lmb_scene *scene, float step_m)
{
    const lmb_vec3 size = sub3(scene->bounds_max, scene->bounds_min);
    return step_m > 0.0f ? step_m : maxf(maxf(size.x, maxf(size.y, size.z)) / (float)ACROSS, 1e-6f);
}

/* Number of points along each axis, at most MOST; returns the total. */
static double count_places(int32_t count[3], const lmb_scene *scene, float step)
{
    const lmb_vec3 size = sub3(scene->bounds_max, scene->bounds_min);
    const float side[3] = {size.x, size.y, size.z};
    double all = 1.0;
    for (int k = 0; k < 3; ++k) {
        const double steps = ceil((double)side[k] / (double)step - 1e-6);
        count[k] = steps > 1.0 ? (int32_t)(steps < MOST ? steps : MOST) : 1;
        all *= steps > 1.0 ? steps : 1.0;
    }
    return all;
}

int light_probes_fit(const lmb_scene *scene, float step_m, report *r)
{
    const float step = step_of(scene, step_m);
    int32_t count[3];
    const double all = count_places(count, scene, step);
    return all <= (double)MOST ||
           report_fail_usage(r, "--step %g: %.3g places are over %d; give a larger one", (double)step, all, MOST);
}

static int lay_out(lattice *l, const lmb_scene *scene, float step_m, report *r)
{
    const lmb_vec3 size = sub3(scene->bounds_max, scene->bounds_min);
    const float side[3] = {size.x, size.y, size.z},
                low[3] = {scene->bounds_min.x, scene->bounds_min.y, scene->bounds_min.z};
    const float step = step_of(scene, step_m);
    float first[3], each[3];
    const double all = count_places(l->count, scene, step);
    for (int k = 0; k < 3; ++k) {
        each[k] = side[k] > 0.0f ? side[k] / (float)l->count[k] : step;
        first[k] = low[k] + 0.5f * (side[k] > 0.0f ? each[k] : 0.0f);
    }
    l->first = vec3(first[0], first[1], first[2]);
    l->step = vec3(each[0], each[1], each[2]);
    l->probe = calloc(count_of(l), sizeof *l->probe);
    return l->probe != NULL || report_fail(r, "not enough memory for %.0f places", all);
}

static lmb_vec3 place_of(const lattice *l, size_t i)
{
    const int32_t x = (int32_t)(i % (size_t)l->count[0]), y = (int32_t)(i / (size_t)l->count[0] % (size_t)l->count[1]),
                  z = (int32_t)(i / ((size_t)l->count[0] * (size_t)l->count[1]));
    return vec3(l->first.x + (float)x * l->step.x, l->first.y + (float)y * l->step.y,
                l->first.z + (float)z * l->step.z);
}

void light_probe_add(float inout[3 * TERMS], int k, const float e[3])
{
    float weight, y[TERMS];
    harmonics(y, light_probe_normal(k, &weight));
    for (int t = 0; t < TERMS; ++t) {
        for (int c = 0; c < 3; ++c) {
            inout[3 * t + c] += e[c] * y[t] * weight / cosine_of(t);
        }
    }
}

/* Sets the harmonics at a point from the rows of the normals. */
static void set_probe(probe *p, const light_solve *s, const bake *b, float *const *row)
{
    const lmb_transfer_light *light = &s->job.render->frame.transfer_light;
    for (int k = 0; k < NORMALS; ++k) {
        float e[3] = {0.0f, 0.0f, 0.0f}, seen = 0.0f, weight;
        light_probe_normal(k, &weight);
        for (uint32_t i = 0; i < b->element_count; ++i) {
            seen += row[k][i];
            for (int c = 0; c < 3; ++c) {
                e[c] += row[k][i] * (float)light->node[i][c];
            }
        }
        for (int c = 0; c < 3; ++c) {
            e[c] *= light->step;
        }
        light_probe_add(p->v, k, e);
        p->v[FLOATS - 1] += seen * weight / 12.566371f;
    }
}

static int fill(lattice *l, const light_solve *s, const bake *b, report *r)
{
    enum { POINTS = TOGETHER * NORMALS };
    lmb_vec3 at[POINTS], normal[POINTS];
    float *row[POINTS], unused;
    const size_t all = count_of(l);
    float *memory = malloc((size_t)POINTS * b->set.elements * sizeof *memory);
    int ok = memory != NULL || report_fail(r, "not enough memory for %u elements", (unsigned)b->set.elements);
    for (size_t first = 0; ok && first < all; first += TOGETHER) {
        const size_t some = all - first < TOGETHER ? all - first : TOGETHER;
        progress_tell("probes", (double)first / (double)all);
        for (size_t k = 0; k < some * NORMALS; ++k) {
            at[k] = place_of(l, first + k / NORMALS);
            normal[k] = light_probe_normal((int)(k % NORMALS), &unused);
            row[k] = memory + k * b->set.elements;
        }
        ok = bake_rows(b, at, normal, (int)(some * NORMALS), 1, row, NULL, r);
        for (size_t k = 0; ok && k < some; ++k) {
            set_probe(&l->probe[first + k], s, b, row + NORMALS * k);
        }
    }
    free(memory);
    return ok;
}

static int measure_distances(lattice *l, const lmb_scene *scene, report *r)
{
    ray_space space;
    const size_t all = count_of(l);
    if (!ray_space_make(&space, scene, r)) {
        return 0;
    }
    for (size_t i = 0; i < all; ++i) {
        progress_tell("distances", (double)i / (double)all);
        light_distances(l->probe[i].v + FLOATS, &space, place_of(l, i), NEAREST * length3(l->step));
    }
    ray_space_free(&space);
    return 1;
}

/* Points in solids take the mean of their neighbours, step by step, so that their darkness does not show outside. */
static int mend_once(lattice *l, uint8_t *open)
{
    const size_t all = count_of(l), along[3] = {1, (size_t)l->count[0], (size_t)l->count[0] * (size_t)l->count[1]};
    int any = 0;
    for (size_t i = 0; i < all; ++i) {
        float sum[FLOATS - 1] = {0.0f}, weight = 0.0f;
        for (int k = 0; k < 6 && !open[i]; ++k) {
            const size_t step = along[k / 2], at = i / step % (size_t)l->count[k / 2];
            const int is_in = k % 2 ? at + 1 < (size_t)l->count[k / 2] : at > 0;
            const size_t other = !is_in ? i : k % 2 ? i + step : i - step;
            for (int f = 0; open[other] == 1 && f < FLOATS - 1; ++f) {
                sum[f] += l->probe[other].v[f];
            }
            weight += open[other] == 1 ? 1.0f : 0.0f;
        }
        for (int f = 0; weight > 0.0f && f < FLOATS - 1; ++f) {
            l->probe[i].v[f] = sum[f] / weight;
        }
        open[i] = weight > 0.0f ? 2 : open[i]; /* from the next step on */
        any |= weight > 0.0f;
    }
    for (size_t i = 0; i < all; ++i) {
        open[i] = open[i] != 0;
    }
    return any;
}

static int mend(lattice *l, report *r)
{
    const size_t all = count_of(l);
    uint8_t *open = malloc(all);
    for (size_t i = 0; open != NULL && i < all; ++i) {
        open[i] = l->probe[i].v[FLOATS - 1] >= OPEN;
    }
    while (open != NULL && mend_once(l, open)) {
    }
    free(open);
    return open != NULL || report_fail(r, "not enough memory for %.0f places", (double)all);
}

/* --- files -------------------------------------------------------------------------------------------------------- */

/* Name of the .bin that belongs to a .json, with or without the folder. */
static void name_numbers(char out[PATH], const char *path, int is_alone)
{
    const char *slash = strrchr(path, '/');
    snprintf(out, PATH, "%.4000s", is_alone && slash != NULL ? slash + 1 : path);
    snprintf(out + strlen(out) - 5, 5, ".bin");
}

static int write_both(const char *path, const lattice *l, report *r)
{
    char name[PATH];
    byte_buffer b = {NULL, 0, 0, 0};
    text_buffer t;
    memset(&t, 0, sizeof t);
    for (size_t i = 0; i < count_of(l); ++i) {
        byte_put_floats(&b, l->probe[i].v, ALL_FLOATS);
    }
    name_numbers(name, path, 1);
    text_buffer_add(&t, "{\n  \"lambent\": \"probes\", \"version\": 2, \"numbers\": ");
    text_buffer_json(&t, name);
    text_buffer_add(
        &t,
        ",\n  \"first\": [%.9g, %.9g, %.9g], \"step\": [%.9g, %.9g, %.9g], \"count\": [%d, %d, %d],\n"
        "  \"order\": \"x fastest, then y, then z\", \"floats\": %d,\n"
        "  \"layout\": \"little-endian binary32: 9 harmonics l l + l + m of radiance, R G B each, W/(sr m2); "
        "then the share of directions that show a lit surface, 0 .. 1: under %g the place lies in a solid and "
        "has its neighbours' harmonics; then a cube map of six faces of %d x %d texels: mean of 1 / distance to "
        "surfaces along the face's axis, and mean of its square, 1/m, 1/m2; faces +x -x +y -y +z -z, a direction d is "
        "at 0.5 + 0.5 (d[a + 1], d[a + 2]) / |d[a]| of the square of its longest axis a, and after z comes x\",\n"
        "  \"irradiance\": \"sum of harmonic x Y(normal) x 3.141593 for l = 0, 2.094395 for l = 1, 0.785398 for "
        "l = 2, at least 0; W/m2\"\n}\n",
        (double)l->first.x, (double)l->first.y, (double)l->first.z, (double)l->step.x, (double)l->step.y,
        (double)l->step.z, (int)l->count[0], (int)l->count[1], (int)l->count[2], ALL_FLOATS, (double)OPEN,
        LIGHT_DISTANCES_SIDE, LIGHT_DISTANCES_SIDE);
    name_numbers(name, path, 0);
    const int ok = (!b.is_short || report_fail(r, "%s: not enough memory", path)) &&
                   file_write(name, b.data, b.size, r) && text_buffer_write(&t, path, r);
    free(b.data);
    text_buffer_free(&t);
    return ok;
}

static int read_header(lattice *l, const char *path, const file_bytes *file, report *r)
{
    json doc;
    double first[3] = {0, 0, 0}, step[3] = {0, 0, 0}, count[3] = {0, 0, 0};
    if (!json_parse(&doc, (const char *)file->data, file->size, path, r)) {
        return 0;
    }
    const int ok = json_read_doubles(first, 3, &doc, json_member(&doc, 0, "first"), r) &&
                   json_read_doubles(step, 3, &doc, json_member(&doc, 0, "step"), r) &&
                   json_read_doubles(count, 3, &doc, json_member(&doc, 0, "count"), r);
    json_free(&doc);
    l->first = vec3((float)first[0], (float)first[1], (float)first[2]);
    l->step = vec3((float)step[0], (float)step[1], (float)step[2]);
    for (int k = 0; k < 3; ++k) {
        l->count[k] = count[k] >= 1.0 && count[k] <= MOST ? (int32_t)count[k] : 0;
    }
    return ok && ((double)l->count[0] * l->count[1] * l->count[2] >= 1.0 || report_fail(r, "%s: no lattice", path));
}

static int read_both(lattice *l, const char *path, report *r)
{
    char name[PATH];
    file_bytes head = {NULL, 0}, numbers = {NULL, 0};
    memset(l, 0, sizeof *l);
    name_numbers(name, path, 0);
    int ok = file_read(&head, path, r) && read_header(l, path, &head, r) && file_read(&numbers, name, r);
    ok = ok && (numbers.size == 4 * ALL_FLOATS * count_of(l) ||
                report_fail(r, "%s: not as long as %s says", name, path));
    l->probe = ok ? malloc(count_of(l) * sizeof *l->probe) : NULL;
    byte_reader from = {numbers.data, numbers.data + numbers.size, 0};
    for (size_t i = 0; l->probe != NULL && i < count_of(l); ++i) {
        byte_get_floats(l->probe[i].v, &from, ALL_FLOATS);
    }
    file_free(&head);
    file_free(&numbers);
    return ok && (l->probe != NULL || report_fail(r, "%s: not enough memory", path));
}

/* --- as an engine draws it ---------------------------------------------------------------------------------------- */

/* The lattice point before along an axis, and the fraction towards the next. */
static int32_t before(float *part, float at, float first, float step, int32_t count)
{
    const float x = minf(maxf((at - first) / step, 0.0f), (float)(count - 1));
    const int32_t i = (int32_t)x < count - 1 ? (int32_t)x : count > 1 ? count - 2 : 0;
    *part = count > 1 ? x - (float)i : 0.0f;
    return i;
}

static void light_in(float out[3], const void *user, uint32_t id, lmb_vec3 at, lmb_vec3 normal)
{
    const lattice *l = user;
    float part[3], y[TERMS];
    const int32_t x = before(&part[0], at.x, l->first.x, l->step.x, l->count[0]),
                  v = before(&part[1], at.y, l->first.y, l->step.y, l->count[1]),
                  z = before(&part[2], at.z, l->first.z, l->step.z, l->count[2]);
    const float shortest = minf(l->step.x, minf(l->step.y, l->step.z));
    float sum = 0.0f;
    (void)id;
    harmonics(y, normal);
    memset(out, 0, 3 * sizeof *out);
    for (int k = 0; k < 8; ++k) {
        float w = (k & 1 ? part[0] : 1.0f - part[0]) * (k & 2 ? part[1] : 1.0f - part[1]) *
                        (k & 4 ? part[2] : 1.0f - part[2]);
        if (!(w > 0.0f)) {
            continue;
        }
        const size_t i = (size_t)(x + (k & 1)) + (size_t)l->count[0] * ((size_t)(v + (k >> 1 & 1)) +
                                                                        (size_t)l->count[1] * (size_t)(z + (k >> 2)));
        w *= light_distances_weight(l->probe[i].v + FLOATS, place_of(l, i), shortest, at, normal);
        w *= l->probe[i].v[FLOATS - 1] < OPEN ? SOLID : 1.0f;
        sum += w;
        for (int t = 0; t < 3 * TERMS; ++t) {
            out[t % 3] += w * l->probe[i].v[t] * y[t / 3] * cosine_of(t / 3);
        }
    }
    for (int c = 0; c < 3; ++c) {
        out[c] = maxf(out[c] / sum, 0.0f);
    }
}

int light_probes(const char *path, light_solve *s, bake *b, float step_m, int is_quiet, report *r)
{
    lattice l, back;
    memset(&l, 0, sizeof l);
    memset(&back, 0, sizeof back);
    const light_source of = {&s->job.scene, light_in, &back};
    const int ok = light_probes_fit(&s->job.scene, step_m, r) && lay_out(&l, &s->job.scene, step_m, r) &&
                   fill(&l, s, b, r) && mend(&l, r) && measure_distances(&l, &s->job.scene, r) &&
                   write_both(path, &l, r) && read_both(&back, path, r) &&
                   light_compare(path, s, &of, "probes", is_quiet, r);
    free(l.probe);
    free(back.probe);
    return ok;
}
