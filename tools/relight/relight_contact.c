/* relight_contact.c: the light that objects block from the ground, and by vertex the light that reaches them. */
#include "relight_contact.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../common/progress.h"

#define FAR 0.05f  /* minimum radius / distance of another figure that can block light */
#define SAME 0.9976f /* cosine of 4 degrees, between parts of one small light: a texel of the map covers 2.8 */

/* --- light -------------------------------------------------------------------------------------------------------- */

static void add_light(far_lights *f, lmb_vec3 to, const float rgb[3])
{
    far_light *l = &f->light[f->count++];
    l->to = to;
    for (int c = 0; c < 3; ++c) {
        l->rgb[c] = fmaxf(rgb[c], 0.0f);
    }
}

static float light_of(const float rgb[3]) { return rgb[0] + rgb[1] + rgb[2]; }

/* A small light can cover up to four texels of the map, each of which is a peak. They are merged to cast one shadow. */
static void add_peaks(far_lights *f, const lmb_probe_lights *l)
{
    for (int32_t i = 0; i < l->peaks; ++i) {
        const lmb_vec3 to = {l->peak[0][i], l->peak[1][i], l->peak[2][i]};
        const float rgb[3] = {l->peak[3][i], l->peak[4][i], l->peak[5][i]}, light = light_of(rgb);
        int32_t k = LMB_PROBE_TEXELS;
        while (k < f->count && hidden_dot(f->light[k].to, to) < SAME) {
            ++k;
        }
        if (k == f->count) {
            add_light(f, to, rgb);
            continue;
        }
        far_light *m = &f->light[k];
        const float old = light_of(m->rgb), per = old + light > 0.0f ? 1.0f / (old + light) : 0.0f;
        const lmb_vec3 sum = {(old * m->to.x + light * to.x) * per, (old * m->to.y + light * to.y) * per,
                              (old * m->to.z + light * to.z) * per};
        const float length = sqrtf(hidden_dot(sum, sum));
        m->to = length > 0.0f ? (lmb_vec3){sum.x / length, sum.y / length, sum.z / length} : to;
        for (int c = 0; c < 3; ++c) {
            m->rgb[c] += rgb[c];
        }
    }
}

int figure_light(far_lights *out, const figures *f, uint32_t figure, relight_light *w, const relight_options *o)
{
    const float *at = w->table[0].light;
    const lmb_probe_lights *l = &w->lights;
    const lmb_vec3 place = figures_middle(f, figure * figures_owners_each(f));
    if (!relight_light_see(w, o, place) ||
        lmb_probe_reduce(&w->lights, o->kernels, w->map, &w->table[0]) != LMB_OK) {
        return 0;
    }
    out->count = 0;
    for (int32_t i = 0; i < LMB_PROBE_TEXELS; ++i) {
        const float rgb[3] = {l->rgbw[0][i], l->rgbw[1][i], l->rgbw[2][i]};
        add_light(out, (lmb_vec3){at[i], at[LMB_PROBE_TEXELS + i], at[2 * LMB_PROBE_TEXELS + i]}, rgb);
        out->angle[i] = l->rgbw[3][i];
    }
    add_peaks(out, l);
    return 1;
}

/* --- the ground --------------------------------------------------------------------------------------------------- */

void contact_ground_left(float out[3], const contact *c, float x, float z)
{
    out[0] = out[1] = out[2] = 1.0f;
    for (uint32_t i = 0; c->grounds != NULL && i < c->figures; ++i) {
        ground_left(out, &c->grounds[i], HIDDEN_MAPS, x, z);
    }
}

/* --- vertices ----------------------------------------------------------------------------------------------------- */

/* 64 samples of a figure, relative to the foot. */
typedef struct vertices {
    lmb_tile tile; /* positions and normals */
    lmb_vec3 middle;
    float radius;
    uint64_t all;
    uint32_t figure;
} vertices;

static void take_vertices(vertices *v, const hidden_part *p, uint32_t first)
{
    const uint32_t left = p->samples - first, count = left < LMB_TILE_PIXELS ? left : LMB_TILE_PIXELS;
    lmb_vec3 low = p->at[hidden_sampled(p, first)], high = low;
    memset(&v->tile, 0, sizeof v->tile);
    for (uint32_t k = 0; k < count; ++k) {
        const uint32_t vertex = hidden_sampled(p, first + k);
        const lmb_vec3 at = p->at[vertex], n = p->normal[vertex];
        v->tile.position[0][k] = at.x;
        v->tile.position[1][k] = at.y;
        v->tile.position[2][k] = at.z;
        v->tile.normal[0][k] = n.x;
        v->tile.normal[1][k] = n.y;
        v->tile.normal[2][k] = n.z;
        v->tile.id[k] = 1;
        low = (lmb_vec3){fminf(low.x, at.x), fminf(low.y, at.y), fminf(low.z, at.z)};
        high = (lmb_vec3){fmaxf(high.x, at.x), fmaxf(high.y, at.y), fmaxf(high.z, at.z)};
    }
    const lmb_vec3 half = {0.5f * (high.x - low.x), 0.5f * (high.y - low.y), 0.5f * (high.z - low.z)};
    v->middle = (lmb_vec3){low.x + half.x, low.y + half.y, low.z + half.z};
    v->radius = sqrtf(hidden_dot(half, half));
    v->all = count < LMB_TILE_PIXELS ? ((uint64_t)1 << count) - 1 : ~(uint64_t)0;
}

/* Can another figure hide a light from any of them? Tests bounding spheres. */
static int may_hide(const contact *c, const vertices *v, uint32_t other, lmb_vec3 to)
{
    const lmb_vec3 a = c->foot[other], b = c->foot[v->figure], m = c->hidden.middle;
    const lmb_vec3 d = {a.x + m.x - b.x - v->middle.x, a.y + m.y - b.y - v->middle.y, a.z + m.z - b.z - v->middle.z};
    const float far2 = hidden_dot(d, d), along = hidden_dot(d, to), wide = c->hidden.radius + v->radius;
    return c->hidden.radius * c->hidden.radius > FAR * FAR * far2 &&
           (far2 <= wide * wide || (along > 0.0f && far2 - along * along < wide * wide));
}

/* All figures are copies of one object, so the origins of rays are moved instead of the figure. */
static uint64_t seen_from(contact *c, const relight_options *o, const vertices *v, uint32_t other, uint64_t pixels,
                          lmb_vec3 to)
{
    const lmb_vec3 a = c->foot[v->figure], b = c->foot[other];
    const float by[3] = {a.x - b.x, a.y - b.y, a.z - b.z};
    lmb_tile moved = v->tile;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        for (int i = 0; i < 3; ++i) {
            moved.position[i][k] += by[i];
        }
    }
    return lmb_occluded_sun(o->kernels, &c->hidden.traversal, &c->hidden.bvh, &moved, pixels, to);
}

static uint64_t blocked_of(contact *c, const relight_options *o, const vertices *v, uint64_t faces, uint64_t known,
                           int is_known, lmb_vec3 to)
{
    uint64_t blocked = is_known ? known : seen_from(c, o, v, v->figure, faces, to);
    for (uint32_t i = 0; i < c->figures; ++i) {
        if (i != v->figure && (faces & ~blocked) != 0 && may_hide(c, v, i, to)) {
            blocked |= seen_from(c, o, v, i, faces & ~blocked, to);
        }
    }
    return blocked & faces;
}

/* The share of light left in a direction from below, which comes from the ground. */
static void ground_of(float left[3], const contact *c, const vertices *v, int k, lmb_vec3 to)
{
    const lmb_vec3 foot = c->foot[v->figure];
    const float far = (c->ground_y - foot.y - v->tile.position[1][k]) / to.y;
    contact_ground_left(left, c, foot.x + v->tile.position[0][k] + far * to.x,
                        foot.z + v->tile.position[2][k] + far * to.z);
}

static void add_light_of(float all[LMB_TILE_PIXELS][3], float left[LMB_TILE_PIXELS][3], contact *c,
                         const relight_options *o, const vertices *v, int32_t i, const hidden_part *p, uint32_t first)
{
    const far_lights *f = &c->lights[v->figure];
    const far_light *l = &f->light[i];
    const int is_known = i < LMB_PROBE_TEXELS, is_below = l->to.y < -HIDDEN_LOWEST && c->grounds != NULL;
    const float angle = is_known ? f->angle[i] : 0.0f;
    float cosine[LMB_TILE_PIXELS];
    uint64_t faces = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        cosine[k] = v->tile.normal[0][k] * l->to.x + v->tile.normal[1][k] * l->to.y + v->tile.normal[2][k] * l->to.z;
        faces |= (uint64_t)(cosine[k] > 0.0f) << k;
    }
    faces &= v->all;
    const uint64_t blocked =
        faces == 0 ? 0
                   : blocked_of(c, o, v, faces, is_known ? p->blocked[first / LMB_TILE_PIXELS][i] : 0, is_known, l->to);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        float open[3] = {1.0f, 1.0f, 1.0f};
        if (!(faces >> k & 1)) {
            continue;
        }
        if (is_below && !(blocked >> k & 1)) {
            ground_of(open, c, v, k, l->to);
        }
        for (int h = 0; h < 3; ++h) {
            all[k][h] += cosine[k] * l->rgb[h];
            left[k][h] += cosine[k] * (blocked >> k & 1 ? l->back[h] * angle : l->rgb[h] * open[h]);
        }
    }
}

/* Computes the share of light left at 64 samples from `first` on. */
static void shade_samples(float (*share)[3], contact *c, const relight_options *o, const hidden_part *p,
                          uint32_t figure, uint32_t first)
{
    float all[LMB_TILE_PIXELS][3] = {{0}}, left[LMB_TILE_PIXELS][3] = {{0}};
    vertices v;
    take_vertices(&v, p, first);
    hidden_bound(&c->hidden.traversal);
    v.figure = figure;
    for (int32_t i = 0; i < c->lights[figure].count; ++i) {
        add_light_of(all, left, c, o, &v, i, p, first);
    }
    for (uint32_t k = 0; k < LMB_TILE_PIXELS && v.all >> k & 1; ++k) {
        for (uint32_t h = 0; h < 3; ++h) {
            share[first + k][h] = all[k][h] > 0.0f ? fminf(left[k][h] / all[k][h], 1.0f) : 1.0f;
        }
    }
}

/* The codes of a vertex with `share` of its light, in the format of the mesh. */
static void put_shaded(uint8_t *to, const lmb_mesh *m, const lmb_vertex *own, const float share[3])
{
    for (int h = 0; h < 4; ++h) {
        const float part = h < 3 ? fminf(share[h], 1.0f) : 1.0f, v = own->colour[h] * part;
        if (m->colour_format == LMB_COLOUR_RGBA16) {
            const uint16_t code = (uint16_t)((h < 3 ? sqrtf(v) : v) * 65535.0f + 0.5f);
            memcpy(to + 2 * h, &code, sizeof code);
        } else {
            to[h] = (uint8_t)(floorf(own->colour[h] * 255.0f + 0.5f) * part + 0.5f);
        }
    }
}

static void colour_vertex(uint8_t *out, const hidden_part *p, uint32_t vertex, float (*share)[3])
{
    lmb_vertex own = {.colour = {1.0f, 1.0f, 1.0f, 1.0f}};
    float sum[3] = {0.0f, 0.0f, 0.0f};
    for (int i = 0; i < (p->share != NULL ? HIDDEN_SHARES : 1); ++i) {
        uint32_t sample;
        const float weight = hidden_shared(&sample, p, vertex, i);
        for (int h = 0; h < 3; ++h) {
            sum[h] += weight * share[sample][h];
        }
    }
    lmb_mesh_vertex(&own, &p->mesh, vertex);
    put_shaded(out, &p->mesh, &own, sum);
}

static int shade_part(contact *c, const relight_options *o, uint32_t instance)
{
    const hidden_part *p = &c->hidden.part[instance % c->hidden.parts];
    float (*share)[3] = malloc(((size_t)p->samples + 1) * sizeof *share);
    if (share == NULL) {
        return 0;
    }
    for (uint32_t first = 0; first < p->samples; first += LMB_TILE_PIXELS) {
        shade_samples(share, c, o, p, instance / c->hidden.parts, first);
    }
    const size_t each = p->mesh.colour_format == LMB_COLOUR_RGBA16 ? 8 : 4;
    for (uint32_t i = 0; i < p->mesh.vertex_count; ++i) {
        colour_vertex(c->colours[instance] + each * i, p, i, share);
    }
    free(share);
    return 1;
}

/* --- all ---------------------------------------------------------------------------------------------------------- */

static int take_meshes(contact *c)
{
    int ok = 1;
    for (uint32_t i = 0; ok && i < c->instances; ++i) {
        const lmb_mesh *m = &c->hidden.part[i % c->hidden.parts].mesh;
        c->colours[i] = malloc((m->colour_format == LMB_COLOUR_RGBA16 ? 8 : 4) * (size_t)m->vertex_count + 1);
        c->meshes[i] = *m;
        c->meshes[i].colours = c->colours[i];
        ok = c->colours[i] != NULL;
    }
    return ok;
}

/* Sets the regions of the shadow casters' triangles. */
static int take_regions(contact *c)
{
    hidden_proxy *x = &c->hidden.proxy;
    c->hidden.region_of = c->regions.of;
    if (x->count == 0) {
        return 1;
    }
    if ((x->region = malloc(x->count)) == NULL) {
        return 0;
    }
    for (uint32_t i = 0; i < x->count; ++i) {
        x->region[i] = c->regions.of[x->source[i]];
    }
    c->hidden.region_of = x->region;
    return 1;
}

static int take_contact(contact *c, const figures *f, const relight_options *o, const relight_light *w)
{
    c->fold = w->table[0].fold;
    c->ground_y = o->place.ground_y;
    if (c->meshes != NULL) {
        return 1;
    }
    c->figures = f->count;
    c->instances = f->count * f->parts;
    c->meshes = malloc(c->instances * sizeof *c->meshes);
    c->colours = calloc(c->instances, sizeof *c->colours);
    c->lights = malloc(c->figures * sizeof *c->lights);
    c->foot = malloc(c->figures * sizeof *c->foot);
    c->grounds = relight_has_ground(o) ? malloc(c->figures * sizeof *c->grounds) : NULL;
    const int ok = c->meshes != NULL && c->colours != NULL && c->lights != NULL && c->foot != NULL &&
           (c->grounds != NULL || !relight_has_ground(o)) && hidden_make(&c->hidden, f, o, w->table[0].light) &&
           regions_make(&c->regions, &c->hidden, w->table[0].light) && take_meshes(c);
    return ok && take_regions(c);
}

/* The ground under one figure. */
typedef struct ground_below {
    const contact_ground *ground;
    lmb_vec3 foot;
    float height; /* of the foot over the ground, m */
} ground_below;

static void left_below(float left[3], const void *user, lmb_vec3 at, lmb_vec3 to)
{
    const ground_below *b = user;
    const float far = -(b->height + at.y) / to.y;
    ground_left(left, b->ground, 1, b->foot.x + at.x + far * to.x, b->foot.z + at.z + far * to.z);
}

static void shade_map(contact *c, uint32_t figure, int map)
{
    ground_shade(&c->grounds[figure].map[map], &c->hidden.map[map], &c->peaks[map], c->foot[figure], &c->lights[figure],
                 c->reflected);
}

/* Lights a figure in two passes. Light that the object reflects onto the ground includes light from the ground, so
 * regions are lit again with the wide ground map, which is enough for that. */
static int light_figure(contact *c, figures *f, uint32_t i, relight_light *w, const relight_options *o)
{
    const float height = c->foot[i].y - c->ground_y;
    const ground_below below = {c->grounds != NULL ? &c->grounds[i] : NULL, c->foot[i], height};
    far_lights *l = &c->lights[i];
    if (!figure_light(l, f, i, w, o)) {
        return 0;
    }
    regions_light(c->reflected, l, &c->regions, c->fold, NULL, NULL);
    if (c->grounds == NULL) {
        return 1;
    }
    if (!hidden_ground(&c->hidden, f, o, height)) {
        return 0;
    }
    for (int map = 0; map < HIDDEN_MAPS; ++map) {
        if (!ground_throw(&c->peaks[map], map, &c->hidden, l, o)) {
            return 0;
        }
    }
    shade_map(c, i, 0);
    regions_light(c->reflected, l, &c->regions, c->fold, left_below, &below);
    for (int map = 0; map < HIDDEN_MAPS; ++map) {
        shade_map(c, i, map);
    }
    return 1;
}

static int work(contact *c, figures *f, relight_light *w, const relight_options *o)
{
    int ok = 1;
    for (uint32_t i = 0; ok && i < c->figures; ++i) {
        c->foot[i] = hidden_foot(f, i);
        ok = light_figure(c, f, i, w, o);
    }
    for (uint32_t i = 0; ok && i < c->instances; ++i) {
        ok = shade_part(c, o, i);
        progress_tell("contact: light", (double)(i + 1) / (double)c->instances);
    }
    return ok;
}

/* Restores the figures' scene as loaded. */
static void show_plain(figures *f)
{
    for (uint32_t i = 0; i < f->count * f->parts; ++i) {
        f->instances[i].mesh = f->loaded.scene.instances[i % f->parts].mesh;
    }
    f->scene.meshes = f->loaded.scene.meshes;
    f->scene.mesh_count = f->loaded.scene.mesh_count;
}

static void show_darkened(figures *f, contact *c)
{
    for (uint32_t i = 0; i < c->instances; ++i) {
        f->instances[i].mesh = i;
        ++f->instances[i].revision;
    }
    f->scene.meshes = c->meshes;
    f->scene.mesh_count = c->instances;
}

int contact_make(contact *c, figures *f, relight_light *w, const relight_options *o, report *r)
{
    show_plain(f);
    const int ok = take_contact(c, f, o, w) && work(c, f, w, o);
    if (ok) {
        show_darkened(f, c);
        const uint32_t coarse = hidden_coarse(&c->hidden);
        report_note(o->view.is_quiet || coarse == 0 || c->has_told, "note: %u sights have coarser visibility: too many "
                    "triangles cross there", (unsigned)coarse);
        c->has_told |= coarse > 0;
    }
    return ok || report_fail(r, "--contact: %s: out of memory", o->object);
}

void contact_free(contact *c)
{
    for (uint32_t i = 0; c->colours != NULL && i < c->instances; ++i) {
        free(c->colours[i]);
    }
    hidden_free(&c->hidden);
    regions_free(&c->regions);
    for (int i = 0; i < HIDDEN_MAPS; ++i) {
        free(c->peaks[i].runs.run);
    }
    free(c->colours);
    free(c->meshes);
    free(c->lights);
    free(c->foot);
    free(c->grounds);
}
