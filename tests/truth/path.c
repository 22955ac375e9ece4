/* path.c: a small path tracer for truth: rays against triangles in a BVH, light by light. */
#include "path.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.141592653589793

/* Offset of ray origins from a surface, m: corners are binary32 numbers within some metres. */
#define LIFT 1e-6

enum { LEAF = 2 };

/* --- the BVH ------------------------------------------------------------------------------------------------------ */

static double part(svec a, int axis) { return axis == 0 ? a.x : axis == 1 ? a.y : a.z; }

static svec smaller(svec a, svec b) { return at(fmin(a.x, b.x), fmin(a.y, b.y), fmin(a.z, b.z)); }
static svec larger(svec a, svec b) { return at(fmax(a.x, b.x), fmax(a.y, b.y), fmax(a.z, b.z)); }

static svec middle(const path_triangle *t) { return plus(t->a, times(plus(t->u, t->v), 1.0 / 3.0)); }

static void bound(path_node *n, const path_triangle *t)
{
    n->low = n->high = t[0].a;
    for (uint32_t i = 0; i < n->count; ++i) {
        const svec corners[3] = {t[i].a, plus(t[i].a, t[i].u), plus(t[i].a, t[i].v)};
        for (int k = 0; k < 3; ++k) {
            n->low = smaller(n->low, corners[k]);
            n->high = larger(n->high, corners[k]);
        }
    }
    n->low = less(n->low, at(LIFT, LIFT, LIFT)); /* gives flat boxes a thickness */
    n->high = plus(n->high, at(LIFT, LIFT, LIFT));
}

/* Insertion sort by centre along an axis: there are few triangles. */
static void sort(path_triangle *t, uint32_t count, int axis)
{
    for (uint32_t i = 1; i < count; ++i) {
        const path_triangle moved = t[i];
        const double key = part(middle(&moved), axis);
        uint32_t k = i;
        for (; k > 0 && part(middle(&t[k - 1]), axis) > key; --k) {
            t[k] = t[k - 1];
        }
        t[k] = moved;
    }
}

static void divide(path_tracer *p, uint32_t first, uint32_t count)
{
    path_node *n = &p->nodes[p->node_count++];
    n->first = first;
    n->count = count;
    bound(n, p->triangles + first);
    if (count > LEAF) {
        const svec d = less(n->high, n->low);
        sort(p->triangles + first, count, d.x > d.y && d.x > d.z ? 0 : d.y > d.z ? 1 : 2);
        n->count = 0;
        divide(p, first, count / 2);
        divide(p, first + count / 2, count - count / 2);
    }
    n->skip = p->node_count;
}

static int is_hit(const path_node *n, svec from, svec inverse, double far)
{
    double enter = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (part(n->low, axis) - part(from, axis)) * part(inverse, axis),
                     b = (part(n->high, axis) - part(from, axis)) * part(inverse, axis);
        const double near = a < b ? a : b, leave = a < b ? b : a;
        enter = near > enter ? near : enter;
        far = leave < far ? leave : far;
    }
    return enter <= far;
}

/* Distance along the ray to the triangle, or a negative number (Moeller and Trumbore 1997). */
static double meet(const path_triangle *t, svec from, svec along)
{
    const svec s = cross_of(along, t->v), d = less(from, t->a), q = cross_of(d, t->u);
    const double det = dot_of(t->u, s);
    if (det == 0.0) {
        return -1.0;
    }
    const double b = dot_of(d, s) / det, c = dot_of(along, q) / det;
    return b >= 0.0 && c >= 0.0 && b + c <= 1.0 ? dot_of(t->v, q) / det : -1.0;
}

static double over_one(double v) { return 1.0 / (fabs(v) > 1e-200 ? v : 1e-200); }

/* Returns the nearest triangle nearer than *far and updates *far; NULL if there is none.
 * `any`: returns the first hit. */
static const path_triangle *shoot(const path_tracer *p, svec from, svec along, double *far, int any)
{
    const svec inverse = at(over_one(along.x), over_one(along.y), over_one(along.z));
    const path_triangle *found = NULL;
    for (uint32_t i = 0; i < p->node_count;) {
        const path_node *n = &p->nodes[i];
        const int hit = is_hit(n, from, inverse, *far);
        for (uint32_t k = 0; hit && k < n->count; ++k) {
            const path_triangle *t = &p->triangles[n->first + k];
            const double s = meet(t, from, along);
            if (s > 0.0 && s < *far) {
                *far = s;
                found = t;
                if (any) {
                    return found;
                }
            }
        }
        i = hit && n->count == 0 ? i + 1 : n->skip;
    }
    return found;
}

/* --- a scene ------------------------------------------------------------------------------------------------------ */

/* Rounded as in scene.bin, so that the drawn corners are the same. */
static svec stored(svec a) { return at((double)(float)a.x, (double)(float)a.y, (double)(float)a.z); }

/* Returns 0 if the triangle has no area. */
static int take(path_triangle *out, const svec *corners, int material)
{
    const svec a = stored(corners[0]), b = stored(corners[1]), c = stored(corners[2]);
    out->a = a;
    out->u = less(b, a);
    out->v = less(c, a);
    out->material = material;
    out->normal = cross_of(out->u, out->v);
    const int has_area = dot_of(out->normal, out->normal) > 0.0;
    out->normal = has_area ? unit(out->normal) : out->normal;
    return has_area;
}

static void list_emitters(path_tracer *p)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < p->count; ++i) {
        const path_triangle *t = &p->triangles[i];
        const double *e = p->scene->emission[t->material];
        const svec n = cross_of(t->u, t->v);
        if (e[0] + e[1] + e[2] > 0.0) {
            sum += 0.5 * sqrt(dot_of(n, n));
            p->emitter_area[p->emitter_count] = sum;
            p->emitters[p->emitter_count++] = i;
        }
    }
}

int path_open(path_tracer *p, const made_scene *scene)
{
    const size_t n = scene->triangles;
    memset(p, 0, sizeof *p);
    p->scene = scene;
    p->triangles = malloc(n * sizeof *p->triangles);
    p->nodes = malloc(2 * n * sizeof *p->nodes);
    p->emitter_area = malloc(n * sizeof *p->emitter_area);
    p->emitters = malloc(n * sizeof *p->emitters);
    if (p->triangles == NULL || p->nodes == NULL || p->emitter_area == NULL || p->emitters == NULL) {
        path_close(p);
        return 0;
    }
    for (uint32_t i = 0; i < scene->triangles; ++i) {
        p->count += (uint32_t)take(&p->triangles[p->count], scene->corners + 3 * (size_t)i, scene->materials[i]);
    }
    divide(p, 0, p->count);
    list_emitters(p);
    return 1;
}

void path_close(path_tracer *p)
{
    free(p->triangles);
    free(p->nodes);
    free(p->emitter_area);
    free(p->emitters);
    memset(p, 0, sizeof *p);
}

int path_hit(const path_tracer *p, path_point *out, svec from, svec along)
{
    double far = 1e30;
    const path_triangle *t = shoot(p, from, along, &far, 0);
    if (t != NULL) {
        out->normal = times(t->normal, dot_of(t->normal, along) > 0.0 ? -1.0 : 1.0);
        out->at = plus(plus(from, times(along, far)), times(out->normal, LIFT));
        out->material = t->material;
    }
    return t != NULL;
}

int path_eye(const path_tracer *p, path_point *out, int x, int y, int side)
{
    const made_scene *s = p->scene;
    const svec forward = unit(less(s->target, s->eye)), right = unit(cross_of(forward, s->up));
    const svec up = cross_of(right, forward);
    const double half = tan(0.5 * s->fov_deg * PI / 180.0);
    const svec across = times(right, half * (2.0 * (x + 0.5) / side - 1.0)),
               down = times(up, half * (1.0 - 2.0 * (y + 0.5) / side));
    return path_hit(p, out, s->eye, unit(plus(forward, plus(across, down))));
}

/* --- light -------------------------------------------------------------------------------------------------------- */

static double any(test_rng *r) { return test_random(r) * (1.0 / 4294967296.0); }

int path_sees(const path_tracer *p, svec from, svec along, double far)
{
    far -= 2.0 * LIFT;
    return shoot(p, from, along, &far, 1) == NULL;
}

static double cone(const scene_light *l, svec towards)
{
    if (l->kind != SCENE_SPOT) {
        return 1.0;
    }
    const double inner = cos(l->inner_deg * PI / 180.0), outer = cos(l->outer_deg * PI / 180.0);
    const double t = (-dot_of(unit(l->direction), towards) - outer) / (inner - outer);
    return t <= 0.0 ? 0.0 : t >= 1.0 ? 1.0 : t * t * (3.0 - 2.0 * t);
}

double path_arrives(const path_tracer *p, const scene_light *l, const path_point *from)
{
    const int is_sun = l->kind == SCENE_SUN;
    const svec d = is_sun ? times(l->direction, -1.0) : less(l->position, from->at), along = unit(d);
    const double off = is_sun ? 1e30 : sqrt(dot_of(d, d)), cosine_there = dot_of(along, from->normal);
    if (cosine_there <= 0.0) {
        return 0.0;
    }
    const double open = cone(l, along) * cosine_there / (is_sun ? 1.0 : off * off);
    return open > 0.0 && path_sees(p, from->at, along, off) ? open : 0.0;
}

void path_direct(const path_tracer *p, const path_point *from, double rgb[3])
{
    rgb[0] = rgb[1] = rgb[2] = 0.0;
    for (int i = 0; i < p->scene->light_count; ++i) {
        const scene_light *l = &p->scene->lights[i];
        const double share = path_arrives(p, l, from) / PI;
        for (int c = 0; c < 3; ++c) {
            rgb[c] += p->scene->albedo[from->material][c] * share * l->rgb[c];
        }
    }
}

void path_add_emitted(const path_tracer *p, const path_point *from, double u, double v, test_rng *r, double rgb[3])
{
    if (p->emitter_count == 0) {
        return;
    }
    const double all = p->emitter_area[p->emitter_count - 1], pick = all * any(r), root = sqrt(u);
    uint32_t k = 0;
    while (k + 1 < p->emitter_count && p->emitter_area[k] <= pick) {
        ++k;
    }
    const path_triangle *t = &p->triangles[p->emitters[k]];
    const svec there = plus(t->a, plus(times(t->u, root * (1.0 - v)), times(t->v, root * v)));
    const svec d = less(there, from->at), along = unit(d);
    const double r2 = dot_of(d, d), here = dot_of(along, from->normal), away = fabs(dot_of(along, t->normal));
    if (here > 0.0 && path_sees(p, from->at, along, sqrt(r2))) {
        for (int c = 0; c < 3; ++c) {
            rgb[c] += p->scene->albedo[from->material][c] / PI * p->scene->emission[t->material][c] * here * away *
                      all / r2;
        }
    }
}

svec path_scattered(svec n, double u, double v)
{
    const svec other = fabs(n.x) < 0.5 ? at(1, 0, 0) : at(0, 1, 0), x = unit(cross_of(other, n)), y = cross_of(n, x);
    const double radius = sqrt(u), turn = 2.0 * PI * v;
    return plus(plus(times(x, radius * cos(turn)), times(y, radius * sin(turn))), times(n, sqrt(1.0 - u)));
}

/* A point that reflects light to another is sampled in two ways: by rays from the other point, and by rays from a light
 * with a position. The balance heuristic (Veach 1997) weights them by these densities: rays per m2. */
static double rays_from_surface(const path_point *here, const path_point *there)
{
    const svec d = less(there->at, here->at);
    const double r2 = dot_of(d, d);
    return fabs(dot_of(d, here->normal) * dot_of(d, there->normal)) / (PI * r2 * r2);
}

static double narrowest(const scene_light *l) { return l->kind == SCENE_SPOT ? cos(l->outer_deg * PI / 180.0) : -1.0; }

static double rays_from_light(const scene_light *l, const path_point *there)
{
    if (l->kind == SCENE_SUN) {
        return 0.0;
    }
    const svec d = less(there->at, l->position);
    const double r2 = dot_of(d, d);
    return fabs(dot_of(d, there->normal)) / (sqrt(r2) * r2 * 2.0 * PI * (1.0 - narrowest(l)));
}

/* Adds the light of all lights that `next`, found by a ray from `here`, reflects. */
static void add_found(const path_tracer *p, const path_point *here, const path_point *next, double rgb[3])
{
    for (int i = 0; i < p->scene->light_count; ++i) {
        const scene_light *l = &p->scene->lights[i];
        const double by_surface = rays_from_surface(here, next);
        const double share = by_surface / (by_surface + rays_from_light(l, next)) * path_arrives(p, l, next) / PI;
        for (int c = 0; c < 3; ++c) {
            rgb[c] += p->scene->albedo[next->material][c] * share * l->rgb[c];
        }
    }
}

/* A uniform direction in a cone around an axis; the cosine to the axis is at least `cosine_there`. */
static svec within(svec axis, double cosine_there, double u, double v)
{
    const svec other = fabs(axis.x) < 0.5 ? at(1, 0, 0) : at(0, 1, 0), x = unit(cross_of(other, axis));
    const double height = 1.0 - u * (1.0 - cosine_there), radius = sqrt(1.0 - height * height), turn = 2.0 * PI * v;
    return plus(times(axis, height), plus(times(x, radius * cos(turn)), times(cross_of(axis, x), radius * sin(turn))));
}

/* For each light, traces one ray from the light to a point, and adds `weight` times that point's
 * light reflected by `here`. */
static void add_lit(const path_tracer *p, const path_point *here, double u, double v, const double weight[3],
                    double rgb[3])
{
    for (int i = 0; i < p->scene->light_count; ++i) {
        const scene_light *l = &p->scene->lights[i];
        path_point lit;
        if (l->kind == SCENE_SUN || !path_hit(p, &lit, l->position, within(unit(l->direction), narrowest(l), u, v))) {
            continue;
        }
        const svec d = less(lit.at, here->at), along = unit(d);
        if (dot_of(along, here->normal) > 0.0 && dot_of(along, lit.normal) < 0.0 &&
            path_sees(p, here->at, along, sqrt(dot_of(d, d)))) {
            const double by_surface = rays_from_surface(here, &lit);
            const double share = by_surface / (by_surface + rays_from_light(l, &lit)) * path_arrives(p, l, &lit) / PI;
            for (int c = 0; c < 3; ++c) {
                rgb[c] += weight[c] * p->scene->albedo[here->material][c] * p->scene->albedo[lit.material][c] * share *
                          l->rgb[c];
            }
        }
    }
}

/* Adds the radiance of one path; u, v: the first direction; x, y: that of the first ray from a light. */
static void add_path(const path_tracer *p, path_point here, int bounces, const double first[4], test_rng *r,
                     double rgb[3])
{
    double share[3] = {1, 1, 1}, u = first[0], v = first[1], x = first[2], y = first[3];
    for (int b = 0; b < bounces; ++b) {
        path_point next;
        double light[3] = {0, 0, 0};
        add_lit(p, &here, x, y, share, rgb);
        if (!path_hit(p, &next, here.at, path_scattered(here.normal, u, v))) {
            return;
        }
        add_found(p, &here, &next, light);
        path_add_emitted(p, &next, any(r), any(r), r, light);
        for (int c = 0; c < 3; ++c) {
            share[c] *= p->scene->albedo[here.material][c];
            rgb[c] += share[c] * light[c];
        }
        here = next;
        u = any(r);
        v = any(r);
        x = any(r);
        y = any(r);
    }
}

void path_bounced(const path_tracer *p, const path_point *from, int bounces, int strata, test_rng *random, double rgb[3])
{
    rgb[0] = rgb[1] = rgb[2] = 0.0;
    for (int i = 0; i < strata * strata; ++i) {
        const double x = i % strata, y = i / strata;
        double first[4];
        for (int k = 0; k < 4; ++k) {
            first[k] = ((k % 2 == 0 ? x : y) + any(random)) / strata;
        }
        path_add_emitted(p, from, first[2], first[3], random, rgb);
        add_path(p, *from, bounces, first, random, rgb);
    }
    for (int c = 0; c < 3; ++c) {
        rgb[c] /= (double)strata * strata;
    }
}
