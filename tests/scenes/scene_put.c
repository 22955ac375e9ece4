/* scene_put.c: makes a scene by name; turns, scales and moves it; and writes its files. */
#include "scenes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define RADIANS (3.141592653589793 / 180.0)

int scene_make(made_scene *s, const char *name)
{
    const char *colon = strchr(name, ':');
    const size_t length = colon != NULL ? (size_t)(colon - name) : strlen(name);
    const uint64_t seed = colon != NULL ? strtoul(colon + 1, NULL, 10) : 1;
    for (int i = 0; i < scene_kind_count; ++i) {
        if (strlen(scene_kinds[i].name) == length && strncmp(scene_kinds[i].name, name, length) == 0) {
            memset(s, 0, sizeof *s);
            snprintf(s->name, sizeof s->name, "%s", name);
            s->open_low.x = 1.0;
            s->random = (seed + 1) * UINT64_C(0x9e3779b97f4a7c15);
            (void)any_between(s, 0, 1);
            scene_kinds[i].build(s);
            return 1;
        }
    }
    return 0;
}

void scene_drop(made_scene *s)
{
    free(s->corners);
    free(s->materials);
}

/* --- turned, scaled, moved ---------------------------------------------------------------------------------------- */

scene_place scene_as_it_is(void)
{
    scene_place p = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 1.0, {0, 0, 0}};
    return p;
}

void scene_turn(scene_place *p, svec axis, double degrees)
{
    const svec a = unit(axis);
    const double c = cosine(degrees), n = sine(degrees);
    for (int k = 0; k < 3; ++k) {
        const svec v = p->axis[k]; /* Rodrigues' rotation */
        p->axis[k] = plus(plus(times(v, c), times(cross_of(a, v), n)), times(a, dot_of(a, v) * (1.0 - c)));
    }
}

void scene_turn_any(scene_place *p, uint64_t seed)
{
    made_scene r;
    svec axis;
    r.random = (seed + 1) * UINT64_C(0x9e3779b97f4a7c15);
    (void)any_between(&r, 0, 1);
    do {
        axis = at(any_between(&r, -1, 1), any_between(&r, -1, 1), any_between(&r, -1, 1));
    } while (dot_of(axis, axis) > 1.0 || dot_of(axis, axis) < 0.01);
    scene_turn(p, axis, any_between(&r, 20, 340));
}

static svec turned(const scene_place *p, svec v)
{
    return plus(plus(times(p->axis[0], v.x), times(p->axis[1], v.y)), times(p->axis[2], v.z));
}

static svec placed(const scene_place *p, svec v) { return plus(times(turned(p, v), p->scale), p->move); }

/* The box around the eight transformed corners of the old box. */
static void put_opening(made_scene *s, const scene_place *p)
{
    const svec low = s->open_low, high = s->open_high;
    if (low.x > high.x) {
        return;
    }
    for (int k = 0; k < 8; ++k) {
        const svec c = placed(p, at(k & 1 ? low.x : high.x, k & 2 ? low.y : high.y, k & 4 ? low.z : high.z));
        s->open_low = k == 0 ? c : at(fmin(s->open_low.x, c.x), fmin(s->open_low.y, c.y), fmin(s->open_low.z, c.z));
        s->open_high = k == 0 ? c : at(fmax(s->open_high.x, c.x), fmax(s->open_high.y, c.y), fmax(s->open_high.z, c.z));
    }
}

void scene_put(made_scene *s, const scene_place *p)
{
    for (uint32_t i = 0; i < 3 * s->triangles; ++i) {
        s->corners[i] = placed(p, s->corners[i]);
    }
    for (int i = 0; i < s->light_count; ++i) {
        scene_light *l = &s->lights[i];
        l->position = placed(p, l->position);
        l->direction = turned(p, l->direction);
        for (int c = 0; c < 3 && l->kind != SCENE_SUN; ++c) {
            l->rgb[c] *= p->scale * p->scale; /* W/sr scales with the square of the distance */
        }
    }
    s->eye = placed(p, s->eye);
    s->target = placed(p, s->target);
    s->up = turned(p, s->up);
    s->near_m *= p->scale;
    put_opening(s, p);
}

/* --- files -------------------------------------------------------------------------------------------------------- */

static FILE *create(const char *folder, const char *name)
{
    char path[1024];
    snprintf(path, sizeof path, "%.900s/%s", folder, name);
    FILE *f = fopen(path, "wb");
    if (f == NULL) {
        fprintf(stderr, "scenes: %s: cannot be written\n", path);
    }
    return f;
}

static void little_endian(FILE *f, float v)
{
    uint32_t bits;
    memcpy(&bits, &v, 4);
    for (int k = 0; k < 4; ++k) {
        fputc((int)(bits >> (8 * k) & 255u), f);
    }
}

/* The corners of one material's triangles, consecutive in scene.bin, and their bounds. */
typedef struct bin_part {
    uint32_t count;
    float low[3], high[3];
} bin_part;

static int write_bin(const made_scene *s, const char *folder, bin_part *parts)
{
    FILE *f = create(folder, "scene.bin");
    for (int m = 0; f != NULL && m < s->material_count; ++m) {
        bin_part *part = &parts[m];
        for (uint32_t i = 0; i < 3 * s->triangles; ++i) {
            const float v[3] = {(float)s->corners[i].x, (float)s->corners[i].y, (float)s->corners[i].z};
            for (int c = 0; s->materials[i / 3] == m && c < 3; ++c) {
                part->low[c] = part->count == 0 || v[c] < part->low[c] ? v[c] : part->low[c];
                part->high[c] = part->count == 0 || v[c] > part->high[c] ? v[c] : part->high[c];
                little_endian(f, v[c]);
            }
            part->count += s->materials[i / 3] == m;
        }
    }
    return f != NULL && fclose(f) == 0;
}

/* Columns right, up, back and position, because glTF's cameras and lights look along -z. */
static void write_frame(FILE *f, const char *what, int number, svec eye, svec along, svec up)
{
    const svec back = unit(times(along, -1.0));
    const svec hint = fabs(dot_of(unit(up), back)) < 0.99 ? up : fabs(back.x) < 0.9 ? at(1, 0, 0) : at(0, 0, 1);
    const svec x = unit(cross_of(hint, back)), y = cross_of(back, x);
    fprintf(f, ",\n  {\"matrix\": [%.9g, %.9g, %.9g, 0, %.9g, %.9g, %.9g, 0, %.9g, %.9g, %.9g, 0, %.9g, %.9g, %.9g, 1]",
            x.x, x.y, x.z, y.x, y.y, y.z, back.x, back.y, back.z, eye.x, eye.y, eye.z);
    if (number < 0) {
        fprintf(f, ", \"%s\": 0}", what);
    } else {
        fprintf(f, ", \"extensions\": {\"KHR_lights_punctual\": {\"light\": %d}}}", number);
    }
}

static void write_nodes(FILE *f, const made_scene *s)
{
    fprintf(f, " \"scene\": 0, \"scenes\": [{\"nodes\": [0");
    for (int i = 0; i < s->light_count + 1; ++i) {
        fprintf(f, ", %d", i + 1);
    }
    fprintf(f, "]}],\n \"nodes\": [\n  {\"mesh\": 0}");
    write_frame(f, "camera", -1, s->eye, less(s->target, s->eye), s->up);
    for (int i = 0; i < s->light_count; ++i) {
        write_frame(f, "light", i, s->lights[i].position, s->lights[i].direction, s->up);
    }
    fprintf(f,
            "],\n \"cameras\": [{\"type\": \"perspective\", \"perspective\": {\"yfov\": %.9g, \"aspectRatio\": 1, "
            "\"znear\": %.9g}}],\n",
            s->fov_deg * RADIANS, s->near_m);
}

static int emits(const made_scene *s)
{
    double most = 0;
    for (int i = 0; i < 3 * s->material_count; ++i) {
        most = fmax(most, s->emission[i / 3][i % 3]);
    }
    return most > 0;
}

static void write_lights(FILE *f, const made_scene *s)
{
    static const char *const kinds[] = {"spot", "point", "directional"};
    fprintf(
        f,
        " \"extensionsUsed\": [\"KHR_lights_punctual\"%s],\n \"extensions\": {\"KHR_lights_punctual\": {\"lights\": [",
        emits(s) ? ", \"KHR_materials_emissive_strength\"" : "");
    for (int i = 0; i < s->light_count; ++i) {
        const scene_light *l = &s->lights[i];
        const double max = fmax(l->rgb[0], fmax(l->rgb[1], l->rgb[2]));
        fprintf(f, "%s\n  {\"type\": \"%s\", \"color\": [%.9g, %.9g, %.9g], \"intensity\": %.9g", i > 0 ? "," : "",
                kinds[l->kind], l->rgb[0] / max, l->rgb[1] / max, l->rgb[2] / max, max);
        if (l->kind == SCENE_SPOT) {
            fprintf(f, ", \"spot\": {\"innerConeAngle\": %.9g, \"outerConeAngle\": %.9g}", l->inner_deg * RADIANS,
                    l->outer_deg * RADIANS);
        }
        fprintf(f, "}");
    }
    fprintf(f, "]}},\n");
}

/* glTF limits the factor to 0 .. 1. */
static void write_emission(FILE *f, const double rgb[3])
{
    const double max = fmax(rgb[0], fmax(rgb[1], rgb[2]));
    if (max > 0) {
        fprintf(f,
                ", \"emissiveFactor\": [%.9g, %.9g, %.9g], \"extensions\": {\"KHR_materials_emissive_strength\": "
                "{\"emissiveStrength\": %.9g}}",
                rgb[0] / max, rgb[1] / max, rgb[2] / max, max);
    }
}

static void write_meshes(FILE *f, const made_scene *s, const bin_part *parts)
{
    const char *comma = "";
    fprintf(f, " \"materials\": [");
    for (int m = 0; m < s->material_count; ++m) {
        fprintf(f,
                "%s\n  {\"doubleSided\": true, \"pbrMetallicRoughness\": {\"baseColorFactor\": [%.9g, %.9g, %.9g, 1], "
                "\"metallicFactor\": 0, \"roughnessFactor\": 1}",
                m > 0 ? "," : "", s->albedo[m][0], s->albedo[m][1], s->albedo[m][2]);
        write_emission(f, s->emission[m]);
        fprintf(f, "}");
    }
    fprintf(
        f,
        "],\n \"bufferViews\": [{\"buffer\": 0, \"byteOffset\": 0, \"byteLength\": %lu}],\n \"buffers\": [{\"uri\": "
        "\"scene.bin\", \"byteLength\": %lu}],\n \"accessors\": [",
        (unsigned long)s->triangles * 36, (unsigned long)s->triangles * 36);
    unsigned long offset = 0;
    for (int m = 0; m < s->material_count; offset += 12ul * parts[m++].count) {
        const bin_part *p = &parts[m];
        if (p->count > 0) {
            fprintf(f,
                    "%s\n  {\"bufferView\": 0, \"byteOffset\": %lu, \"componentType\": 5126, \"count\": %lu, \"type\": "
                    "\"VEC3\", \"min\": [%.9g, %.9g, %.9g], \"max\": [%.9g, %.9g, %.9g]}",
                    comma, offset, (unsigned long)p->count, (double)p->low[0], (double)p->low[1], (double)p->low[2],
                    (double)p->high[0], (double)p->high[1], (double)p->high[2]);
            comma = ",";
        }
    }
    fprintf(f, "],\n \"meshes\": [{\"primitives\": [");
    for (int m = 0, n = 0; m < s->material_count; ++m) {
        if (parts[m].count > 0) {
            fprintf(f, "%s{\"attributes\": {\"POSITION\": %d}, \"material\": %d}", n > 0 ? ", " : "", n, m);
            ++n;
        }
    }
    fprintf(f, "]}]\n}\n");
}

static int write_gltf(const made_scene *s, const char *folder)
{
    bin_part parts[SCENE_MATERIALS];
    memset(parts, 0, sizeof parts);
    if (!write_bin(s, folder, parts)) {
        return 0;
    }
    FILE *f = create(folder, "scene.gltf");
    if (f == NULL) {
        return 0;
    }
    fprintf(f, "{\n \"asset\": {\"version\": \"2.0\"},\n");
    write_nodes(f, s);
    write_lights(f, s);
    write_meshes(f, s, parts);
    return fclose(f) == 0;
}

/* Input of the path tracer: the corners as in scene.bin. */
static int write_text(const made_scene *s, const char *folder, int size)
{
    FILE *f = create(folder, "scene.txt");
    if (f == NULL) {
        return 0;
    }
    fprintf(f, "%d %d %.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g\n%d\n", size, size, s->eye.x, s->eye.y,
            s->eye.z, s->target.x, s->target.y, s->target.z, s->up.x, s->up.y, s->up.z, s->fov_deg, s->light_count);
    for (int i = 0; i < s->light_count; ++i) {
        const scene_light *l = &s->lights[i];
        const svec d = unit(l->direction);
        fprintf(f, "%d %.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g\n", l->kind, l->position.x, l->position.y,
                l->position.z, d.x, d.y, d.z, l->rgb[0], l->rgb[1], l->rgb[2], l->inner_deg * RADIANS,
                l->outer_deg * RADIANS);
    }
    fprintf(f, "%u %u\n", (unsigned)(3 * s->triangles), (unsigned)s->triangles);
    for (uint32_t i = 0; i < 3 * s->triangles; ++i) {
        const svec *v = &s->corners[i];
        fprintf(f, "%.9g %.9g %.9g\n", (double)(float)v->x, (double)(float)v->y, (double)(float)v->z);
    }
    for (uint32_t i = 0; i < s->triangles; ++i) {
        const double *a = s->albedo[s->materials[i]];
        fprintf(f, "%u %u %u %.9g %.9g %.9g\n", (unsigned)(3 * i), (unsigned)(3 * i + 1), (unsigned)(3 * i + 2), a[0],
                a[1], a[2]);
    }
    return fclose(f) == 0;
}

static int write_box(const made_scene *s, const char *folder)
{
    FILE *f = create(folder, "scene.box");
    if (f == NULL) {
        return 0;
    }
    if (s->open_low.x <= s->open_high.x) {
        fprintf(f, "%.9g %.9g %.9g %.9g %.9g %.9g\n", s->open_low.x, s->open_low.y, s->open_low.z, s->open_high.x,
                s->open_high.y, s->open_high.z);
    }
    return fclose(f) == 0;
}

int scene_write(const made_scene *s, const char *folder, int size)
{
    return write_gltf(s, folder) && write_text(s, folder, size) && write_box(s, folder);
}
