/* rooms_truth.c: path-traces rooms with metal surfaces, and writes the object as a file. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "rooms.h"

#define PI 3.141592653589793

enum { BOUNCES = 7 };

/* --- metals: GGX, height-correlated Smith, Schlick, as in lambent/scene.h ----------------------------------------- */

static double alpha_of(double roughness) { return fmax(roughness * roughness, 0.0025); }

static double lambda_of(double cosine, double a2) { return sqrt(a2 + (1.0 - a2) * cosine * cosine); }

/* G over 4 n.l n.v, by Heitz 2014. */
static double visible(double nl, double nv, double a2)
{
    return 0.5 / (nl * lambda_of(nv, a2) + nv * lambda_of(nl, a2));
}

static double fresnel(double f0, double vh) { return f0 + (1.0 - f0) * pow(1.0 - vh, 5.0); }

/* Adds light of sources without area that a metal reflects towards v. */
static void add_lights(const path_tracer *p, const path_point *here, double roughness, svec v, double rgb[3])
{
    const double a = alpha_of(roughness), a2 = a * a, nv = dot_of(here->normal, v);
    for (int i = 0; i < p->scene->light_count; ++i) {
        const scene_light *l = &p->scene->lights[i];
        const double e = path_arrives(p, l, here);
        if (e > 0.0 && nv > 0.0) {
            const svec to = unit(l->kind == SCENE_SUN ? times(l->direction, -1.0) : less(l->position, here->at)),
                       h = unit(plus(to, v));
            const double nh = dot_of(here->normal, h), nl = dot_of(here->normal, to), d = nh * nh * (a2 - 1.0) + 1.0,
                         lobe = a2 / (PI * d * d) * visible(nl, nv, a2);
            for (int c = 0; c < 3; ++c) {
                rgb[c] += fresnel(p->scene->albedo[here->material][c], dot_of(v, h)) * lobe * e * l->rgb[c];
            }
        }
    }
}

static svec across(svec n) { return unit(cross_of(fabs(n.x) < 0.5 ? at(1, 0, 0) : at(0, 1, 0), n)); }

/* Samples a direction by the density of half vectors and multiplies share by the weight. Returns 0 if the direction
 * points below the surface. */
static int reflect(svec *out, double share[3], const path_tracer *p, const path_point *here, double roughness, svec v,
                   double u, double w)
{
    const double a = alpha_of(roughness), a2 = a * a, nh = sqrt((1.0 - u) / (1.0 + (a2 - 1.0) * u)),
                 side = sqrt(fmax(1.0 - nh * nh, 0.0)), turn = 2.0 * PI * w;
    const svec n = here->normal, x = across(n), y = cross_of(n, x),
               h = plus(times(n, nh), plus(times(x, side * cos(turn)), times(y, side * sin(turn))));
    const double vh = dot_of(v, h), nv = dot_of(n, v);
    *out = less(times(h, 2.0 * vh), v);
    const double nl = dot_of(n, *out);
    if (nl <= 0.0 || nv <= 0.0 || vh <= 0.0) {
        return 0;
    }
    for (int c = 0; c < 3; ++c) {
        share[c] *= fresnel(p->scene->albedo[here->material][c], vh) * visible(nl, nv, a2) * 4.0 * nl * vh / nh;
    }
    return 1;
}

/* --- paths -------------------------------------------------------------------------------------------------------- */

static double any(test_rng *r) { return test_random(r) * (1.0 / 4294967296.0); }

/* Adds the radiance of one path from `here`, seen from v. A hit emitter counts only after the eye or a metal; matt
 * surfaces sample emitters by shadow rays. */
static void add_path(const path_tracer *p, const room *r, path_point here, svec v, const double first[2],
                     test_rng *random, double rgb[3])
{
    double share[3] = {1, 1, 1}, u = first[0], w = first[1];
    int asks = 1;
    for (int b = 0; b <= BOUNCES; ++b) {
        const double roughness = r->rough_metal[here.material];
        double light[3] = {0, 0, 0};
        svec next = {0, 0, 0};
        if (roughness >= 0.0) {
            add_lights(p, &here, roughness, v, light);
        } else {
            for (int i = 0; i < p->scene->light_count; ++i) {
                const double e = path_arrives(p, &p->scene->lights[i], &here) / PI;
                for (int c = 0; c < 3; ++c) {
                    light[c] += p->scene->albedo[here.material][c] * e * p->scene->lights[i].rgb[c];
                }
            }
            path_add_emitted(p, &here, any(random), any(random), random, light);
        }
        for (int c = 0; c < 3; ++c) {
            rgb[c] += share[c] * (light[c] + (asks ? p->scene->emission[here.material][c] : 0.0));
        }
        if (roughness < 0.0) {
            next = path_scattered(here.normal, u, w);
            for (int c = 0; c < 3; ++c) {
                share[c] *= p->scene->albedo[here.material][c];
            }
        } else if (!reflect(&next, share, p, &here, roughness, v, u, w)) {
            return;
        }
        asks = roughness >= 0.0;
        if (!path_hit(p, &here, here.at, next)) {
            return;
        }
        v = times(next, -1.0);
        u = any(random);
        w = any(random);
    }
}

static void trace_pixel(room_picture *out, const path_tracer *p, const room *r, int i, int strata, int half)
{
    path_point seen;
    double rgb[3] = {0, 0, 0};
    const svec eye = r->scene.eye, ahead = unit(less(r->scene.target, eye));
    out->depth[i] = 0.0f;
    if (path_eye(p, &seen, i % ROOM_SIDE, i / ROOM_SIDE, ROOM_SIDE)) {
        const svec v = unit(less(eye, seen.at));
        for (int k = 0; k < strata * strata; ++k) {
            test_rng random = {(uint64_t)i * 977u + (uint64_t)k * 7919u + 1u + 1000000007u * (uint64_t)half};
            (void)test_random(&random);
            const double first[2] = {(k % strata + any(&random)) / strata, (k / strata + any(&random)) / strata};
            add_path(p, r, seen, v, first, &random, rgb);
        }
        out->depth[i] = (float)dot_of(less(seen.at, eye), ahead);
    }
    for (int c = 0; c < 3; ++c) {
        out->rgb[3 * i + c] = (float)(rgb[c] / ((double)strata * strata));
    }
}

int room_trace(room_picture *out, room *r, int with, int strata, int half)
{
    path_tracer p;
    made_scene shown = r->scene;
    shown.triangles = with ? shown.triangles : r->bare;
    if (!path_open(&p, &shown)) {
        return 0;
    }
    for (int i = 0; i < ROOM_PIXELS; ++i) {
        trace_pixel(out, &p, r, i, strata, half);
    }
    path_close(&p);
    return 1;
}

/* --- the object --------------------------------------------------------------------------------------------------- */

static void write_base64(FILE *f, const unsigned char *in, size_t size)
{
    static const char code[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        const unsigned a = in[i], b = i + 1 < size ? in[i + 1] : 0, c = i + 2 < size ? in[i + 2] : 0;
        fputc(code[a >> 2], f);
        fputc(code[(a & 3) << 4 | b >> 4], f);
        fputc(i + 1 < size ? code[(b & 15) << 2 | c >> 6] : '=', f);
        fputc(i + 2 < size ? code[c & 63] : '=', f);
    }
}

/* Collects one material's corners in the order of triangles, from the object's first triangle on. */
static size_t gather(float *out, const room *r, int material)
{
    const made_scene *s = &r->scene;
    size_t n = 0;
    for (uint32_t i = r->bare; i < s->triangles; ++i) {
        for (int k = 0; k < 3 && s->materials[i] == material; ++k) {
            const svec a = s->corners[3 * i + (uint32_t)k];
            out[3 * n] = (float)a.x;
            out[3 * n + 1] = (float)a.y;
            out[3 * n + 2] = (float)a.z;
            ++n;
        }
    }
    return n;
}

static void write_material(FILE *f, const room *r, int m)
{
    const double *a = r->scene.albedo[m], *e = r->scene.emission[m], rough = r->rough_metal[m];
    const double max = fmax(fmax(e[0], fmax(e[1], e[2])), 1e-9);
    fprintf(f,
            "{\"pbrMetallicRoughness\":{\"baseColorFactor\":[%.9g,%.9g,%.9g,1],\"metallicFactor\":%d,"
            "\"roughnessFactor\":%.9g},\"emissiveFactor\":[%.9g,%.9g,%.9g],\"extensions\":"
            "{\"KHR_materials_emissive_strength\":{\"emissiveStrength\":%.9g}}}",
            a[0], a[1], a[2], rough >= 0.0, rough >= 0.0 ? rough : 1.0, e[0] / max, e[1] / max, e[2] / max, max);
}

int room_write_object(const room *r, const char *path)
{
    static float corners[3 * 3 * 4096];
    size_t first[SCENE_MATERIALS + 1] = {0};
    const made_scene *s = &r->scene;
    const int n = s->material_count;
    FILE *f = fopen(path, "w");
    if (f == NULL || s->triangles - r->bare > 4096) {
        return f != NULL && fclose(f) == 0 && 0;
    }
    for (int m = 0; m < n; ++m) {
        first[m + 1] = first[m] + gather(corners + 3 * first[m], r, m);
    }
    fprintf(f, "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],\"materials\":[");
    for (int m = 0; m < n; ++m) {
        fputs(m > 0 ? "," : "", f);
        write_material(f, r, m);
    }
    fprintf(f, "],\"meshes\":[{\"primitives\":[");
    for (int m = 0, any_yet = 0; m < n; ++m) {
        if (first[m + 1] > first[m]) {
            fprintf(f, "%s{\"attributes\":{\"POSITION\":%d},\"material\":%d}", any_yet ? "," : "", m, m);
            any_yet = 1;
        }
    }
    fprintf(f, "]}],\"accessors\":[");
    for (int m = 0; m < n; ++m) { /* each material of the room has one unused corner */
        const size_t count = first[m + 1] - first[m];
        fprintf(f, "%s{\"bufferView\":0,\"byteOffset\":%u,\"componentType\":5126,\"count\":%u,\"type\":\"VEC3\"}",
                m > 0 ? "," : "", (unsigned)(count > 0 ? 12 * first[m] : 0), (unsigned)(count > 0 ? count : 1));
    }
    const size_t bytes = 12 * first[n];
    fprintf(f, "],\"bufferViews\":[{\"buffer\":0,\"byteLength\":%u}],\"buffers\":[{\"byteLength\":%u,\"uri\":"
               "\"data:application/octet-stream;base64,", (unsigned)bytes, (unsigned)bytes);
    write_base64(f, (const unsigned char *)corners, bytes);
    fprintf(f, "\"}]}\n");
    return fclose(f) == 0;
}
