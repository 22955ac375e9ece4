/* mix_voxels.c: light reflected by real surfaces and the object, as voxels around the object. */
#include "mix_lights.h"
#include "mix_lobes.h"
#include "mix_sources.h"
#include "mix_world.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/host.h"

enum { TREE_SIZE = 512, TURNS = 4, ASKED = 4 /* samples of a guessed sun, for albedo */ };

/* Side of the cube, in multiples of the object's size. */
#define ROOM 4.0f

/* Albedo of surfaces outside the photo. */
#define UNSEEN_ALBEDO 0.5

/* Leaves within which points share one result. */
#define NEAR_LEAVES 4.0f

/* --- albedo of real surfaces -------------------------------------------------------------------------------------- */

/* Sums of one cell. */
typedef struct colour {
    float rgb[3];
    int32_t count;
} colour;

/* A pixel's irradiance without the object: lights, and the environment without occlusion. */
static void light_tile(lmb_irradiance *out, mix_job *j, const lmb_tile *tile, const lmb_view *view)
{
    const int32_t told = j->light_count - j->lamp_count, step = mix_lights_step(j, ASKED);
    memset(out, 0, sizeof *out);
    for (int32_t i = 0; i < told; i += step) {
        lmb_direct_tile(out, j->o.kernels, tile, view, &j->scene, &j->lights[i], &j->maps[i][0]);
    }
    for (int k = 0; k < 3 * LMB_TILE_PIXELS; ++k) {
        out->rgb[k / LMB_TILE_PIXELS][k % LMB_TILE_PIXELS] *= (float)step; /* they represent the whole sun */
    }
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        float rgb[3];
        const lmb_vec3 n = {tile->normal[0][k], tile->normal[1][k], tile->normal[2][k]};
        if (tile->id[k] != 0) {
            lmb_env_irradiance(rgb, &j->env[0], n);
            for (int c = 0; c < 3; ++c) {
                out->rgb[c][k] += rgb[c];
            }
        }
    }
}

static void add_tile(colour *cells, const mix_job *j, const lmb_tile *tile, const lmb_irradiance *light)
{
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int32_t x = tile->x + k % LMB_TILE, y = tile->y + k / LMB_TILE;
        if (tile->id[k] == 0) {
            continue;
        }
        const int32_t cell = j->real.cell[y / j->real.step * j->real.columns + x / j->real.step];
        const float *photo = j->frame.light.pixels + 3 * ((size_t)y * (size_t)j->frame.light.width + (size_t)x);
        for (int c = 0; cell >= 0 && c < 3; ++c) {
            cells[cell].rgb[c] += lmb_real_albedo(photo[c], light->rgb[c][k]);
        }
        cells[cell >= 0 ? cell : 0].count += cell >= 0;
    }
}

static int colour_real(mix_job *j, report *r)
{
    colour *cells = mix_take(j, (size_t)(j->real.count > 0 ? j->real.count : 1) * sizeof *cells, r);
    lmb_tile *tile = mix_take(j, sizeof *tile, r);
    lmb_irradiance *light = mix_take(j, sizeof *light, r);
    lmb_view view;
    int32_t x0, y0;
    if (cells == NULL || tile == NULL || light == NULL ||
        lmb_photo_view(&view, &x0, &y0, &j->frame.camera, &j->axes) != LMB_OK) {
        return report_fail(r, "intrinsics: the camera's axis is too far outside the photo");
    }
    for (int32_t y = 0; y < j->frame.light.height; y += LMB_TILE) {
        for (int32_t x = 0; x < j->frame.light.width; x += LMB_TILE) {
            lmb_real_tile(tile, &j->cloud, &j->planes, &j->real, &j->axes, x, y);
            light_tile(light, j, tile, &view);
            add_tile(cells, j, tile, light);
        }
    }
    for (int32_t i = 0; i < j->real.count; ++i) {
        const float n = cells[i].count > 0 ? 1.0f / (float)cells[i].count : 0.0f;
        const float albedo[3] = {cells[i].rgb[0] * n, cells[i].rgb[1] * n, cells[i].rgb[2] * n};
        lmb_real_mesh_colour(&j->real, i, albedo);
    }
    return 1;
}

/* --- voxels ------------------------------------------------------------------------------------------------------- */

/* Puts the floor at three quarters of a leaf's height, so that the object on it starts in the next leaf and shares none
 * with the floor's light. */
static float leaf_under(float height, float leaf)
{
    return (floorf(height / leaf) + 0.75f) * leaf;
}

static int build(mix_job *j, report *r)
{
    lmb_vec3 low, high;
    mix_object_box(&low, &high, j);
    const float size = fmaxf(fmaxf(high.x - low.x, high.y - low.y), high.z - low.z), half = 0.5f * ROOM * size;
    const lmb_vec3 foot = lmb_axes_turn(&j->axes, j->anchor);
    lmb_vec3 middle = {0.5f * (low.x + high.x), 0.5f * (low.y + high.y), 0.5f * (low.z + high.z)};
    if (j->floor >= 0 && !j->hangs) {
        middle.y = foot.y + half - leaf_under(half - (middle.y - foot.y), 2.0f * half / (float)(1 << j->o.depth));
    } else if (j->hangs) {
        middle.z = foot.z + half - leaf_under(half - (middle.z - foot.z), 2.0f * half / (float)(1 << j->o.depth));
    }
    const lmb_vec3 from = {middle.x - half, middle.y - half, middle.z - half},
                   to = {middle.x + half, middle.y + half, middle.z + half};
    const lmb_voxel_part parts[2] = {{&j->scene, 1, j->real_triangles, {1, 1}},
                                     {&j->scene, j->real_triangles + 1, j->object_triangles, {0, 1}}};
    const int32_t bits = 2 * j->o.depth + 4; /* surfaces take about six times the leaves of a square */
    const uint32_t cap = 1u << (bits < 14 ? 14 : bits > 22 ? 22 : bits);
    const size_t bytes = lmb_voxels_bytes(cap, LMB_VOXELS_THREE);
    void *memory = mix_take(j, bytes, r);
    if (memory == NULL) {
        return 0;
    }
    if (lmb_voxels_init(&j->voxels, cap, LMB_VOXELS_THREE, memory, bytes) != LMB_OK ||
        lmb_voxels_build(&j->voxels, &from, &to, j->o.depth, parts, 2) != LMB_OK ||
        lmb_cones_init(&j->cones, &j->voxels, j->o.cones) != LMB_OK ||
        lmb_cone_width_init(&j->glossy, &j->voxels, lmb_cone_tangent(j->o.roughness)) != LMB_OK) {
        return report_fail(r, "the object is too large or too small for voxels; --scale sets metres of a unit");
    }
    report_note(j->o.is_quiet || j->voxels.depth >= j->voxels.asked,
                "voxels: %u are not enough for %d a side; they are coarser, %d a side", (unsigned)cap,
                1 << j->voxels.asked, 1 << j->voxels.depth);
    return 1;
}

/* --- light of the voxels ------------------------------------------------------------------------------------------ */

/* The injected points, and the scratch for first points of the maps. */
typedef struct points {
    lmb_tree tree;
    lmb_tile *scratch;
    lmb_around_scratch *around;
    lmb_texel *real, *object, *again; /* again: copies with updated light */
    size_t real_count, object_count;
    lmb_texel *sent;                 /* first hits of the object's light */
    size_t sent_count;
    double sent_flux[3], sent_out[3]; /* W: light that these add to the environment; light that leaves the cube */
    lmb_vec3 about; /* the object's middle */
} points;

/* Makes all first points of a face, in p->tree. Reflections of given lights by metal are handled as separate lights. */
static int map_texels(mix_job *j, points *p, int32_t light, const lmb_shadow_map *map, int32_t face)
{
    return lmb_tree_texels(&p->tree, j->o.kernels, p->scratch, &j->scene, &j->lights[light], map, face, 0, 0,
                           map->size / LMB_TILE) == LMB_OK;
}

/* Many lights with one common shadow get as many texels in total as one light. */
static int32_t tree_side(const mix_job *j, int32_t map)
{
    const int32_t cap = j->light_count < MIX_SUN_SAMPLES && j->lamp_count == 0 ? TREE_SIZE : TREE_SIZE / 4;
    const int32_t low = map / 8 > cap ? map / 8 : cap;
    return map < cap ? map : low;
}

static int inject_map(mix_job *j, points *p, int32_t light, int32_t with)
{
    const lmb_shadow_map *map = &j->maps[light][with];
    for (int32_t f = 0; f < map->faces; ++f) {
        if ((map->drawn >> f & 1u) != 0) {
            const size_t size = (size_t)p->tree.size;
            if (!map_texels(j, p, light, map, f) ||
                lmb_voxels_inject(&j->voxels, with, p->tree.texel, size * size) != LMB_OK) {
                return 0;
            }
        }
    }
    return 1;
}

static int inject_maps(mix_job *j, points *p, int32_t with)
{
    for (int32_t i = 0; i < j->light_count - j->lamp_count; ++i) {
        if (!inject_map(j, p, i, with)) {
            return 0;
        }
    }
    return !with || lmb_voxels_inject(&j->voxels, with, p->sent, p->sent_count) == LMB_OK;
}

/* Light of spots and points at the first hit, W by channel, without and with the object: reflected by visible surfaces,
 * and sent elsewhere. */
typedef struct first_light {
    double flux[2][3], unseen[2][3];
} first_light;

static void add_texels(first_light *sum, const points *p, const lmb_light *light, const lmb_shadow_map *map,
                       int32_t face, int32_t with)
{
    const int32_t size = p->tree.size;
    lmb_shadow_map coarse = *map;
    coarse.size = size;
    for (int32_t i = 0; i < size * size; ++i) {
        const float *flux = p->tree.texel[i].flux;
        float power[3] = {0, 0, 0};
        if (!(flux[0] + flux[1] + flux[2] > 0.0f)) {
            lmb_light_texel_power(power, light, &coarse, face, i % size, i / size);
        }
        for (int c = 0; c < 3; ++c) {
            sum->flux[with][c] += (double)flux[c];
            sum->unseen[with][c] += (double)power[c];
        }
    }
}

static int add_first_light(first_light *sum, mix_job *j, points *p, int32_t light)
{
    for (int32_t i = 0; i < 2 * j->maps[light][0].faces; ++i) {
        const lmb_shadow_map *map = &j->maps[light][i % 2];
        if ((map->drawn >> i / 2 & 1u) == 0) {
            continue;
        }
        if (!map_texels(j, p, light, map, i / 2)) {
            return 0;
        }
        add_texels(sum, p, &j->lights[light], map, i / 2, i % 2);
    }
    return 1;
}

static int is_inside(const lmb_texel *t, const lmb_voxels *v)
{
    const float side = v->leaf * (float)(1 << v->depth);
    const lmb_vec3 at = {t->position.x - v->low.x, t->position.y - v->low.y, t->position.z - v->low.z};
    return at.x > 0.0f && at.y > 0.0f && at.z > 0.0f && at.x < side && at.y < side && at.z < side;
}

/* Keeps only points in the cube: the others would find no leaf. */
static size_t inside(lmb_texel *all, size_t count, const lmb_voxels *v)
{
    size_t n = 0;
    for (size_t i = 0; i < count; ++i) {
        if (is_inside(&all[i], v)) {
            all[n++] = all[i];
        }
    }
    return n;
}

/* Light reflected by all surfaces of a scene under pi W/m2, as points in the cube. */
static lmb_texel *reflect_all(size_t *count, const mix_job *j, const lmb_scene *scene, const lmb_env *white,
                              lmb_texel *out, size_t cap)
{
    const uint32_t all = j->real_triangles + j->object_triangles;
    lmb_around_points(out, cap, scene, 1, all, 0.5f * j->voxels.leaf, white);
    *count = inside(out, cap, &j->voxels);
    return out;
}

static lmb_scene *white_scene(mix_job *j, report *r)
{
    lmb_material *m;
    lmb_scene *out = mix_copy_scene(&m, j, r);
    for (uint32_t i = 0; out != NULL && i < out->material_count; ++i) {
        m[i].albedo[0] = m[i].albedo[1] = m[i].albedo[2] = 1.0f;
        m[i].texture = -1;
    }
    return out;
}

/* First hits of the object's light. Light that hits a surface in the cube goes into the voxels, and bounces from there
 * light the environment; the rest lights the environment directly. */
static int find_sent(mix_job *j, points *p, report *r)
{
    enum { SIDE = 8 };
    lmb_env white;
    double arrives[3] = {0, 0, 0};
    if (j->lamp_count == 0) {
        return 1;
    }
    const uint32_t all = j->real_triangles + j->object_triangles;
    const size_t bytes = lmb_env_bytes(SIDE),
                 cap = lmb_around_points(NULL, 0, j->bounces, 1, all, 0.5f * j->voxels.leaf, &j->env[0]);
    void *memory = mix_take(j, bytes, r);
    lmb_texel *bare = mix_take(j, cap * sizeof *bare, r);
    const lmb_scene *scene = white_scene(j, r);
    p->sent = mix_take(j, cap * sizeof *p->sent, r);
    if (memory == NULL || bare == NULL || scene == NULL || p->sent == NULL ||
        !mix_white_env(&white, SIDE, memory, bytes)) {
        return 0;
    }
    reflect_all(&p->sent_count, j, j->bounces, &white, p->sent, cap);
    reflect_all(&p->sent_count, j, scene, &white, bare, cap);
    mix_sources_points(p->sent, bare, p->sent_count, arrives, j);
    for (size_t i = 0; i < 3 * p->sent_count; ++i) {
        p->sent_flux[i % 3] += UNSEEN_ALBEDO * (double)p->sent[i / 3].flux[i % 3];
    }
    for (int c = 0; c < 3; ++c) {
        p->sent_out[c] = fmax(j->sources->sent[c] - arrives[c], 0.0);
    }
    return 1;
}

/* Surfaces outside the photo are lit by the first bounce of the lamps. They darken by the share of it that the object
 * removes, which depends on size and position. A sun has no such share. */
static int dim_around(mix_job *j, points *p)
{
    first_light sum;
    int has_sun = 0;
    memset(&sum, 0, sizeof sum);
    j->dim[0] = j->dim[1] = j->dim[2] = 1.0f;
    for (int32_t i = 0; i < j->light_count - j->lamp_count; ++i) {
        has_sun |= j->lights[i].kind == LMB_LIGHT_DIRECTIONAL;
        if (!has_sun && !add_first_light(&sum, j, p, i)) {
            return 0;
        }
    }
    for (int c = 0; c < 3 && !has_sun; ++c) {
        const double before = sum.flux[0][c] + UNSEEN_ALBEDO * sum.unseen[0][c],
                     now = sum.flux[1][c] + p->sent_flux[c] + UNSEEN_ALBEDO * (sum.unseen[1][c] + p->sent_out[c]);
        j->dim[c] = before > 0.0 ? (float)(now / before) : 1.0f;
    }
    lmb_env_dim(&j->env[1], &j->env[0], j->dim);
    return 1;
}

/* Injects the field with the object: direct light, and the updated reflected light of the points. */
static int inject_with(mix_job *j, points *p)
{
    return lmb_voxels_dark(&j->voxels, LMB_VOXEL_WITH) == LMB_OK && inject_maps(j, p, LMB_VOXEL_WITH) &&
           lmb_voxels_inject(&j->voxels, LMB_VOXEL_WITH, p->again, p->real_count + p->object_count) == LMB_OK &&
           lmb_voxels_filter(&j->voxels, LMB_VOXEL_WITH) == LMB_OK;
}

/* Scales the flux of points by their light now over their light before: without the object for real surfaces, or
 * unoccluded for the object. */
static int relight(mix_job *j, points *p, lmb_texel *inout, size_t count, int is_real)
{
    const lmb_cone_trace with = {j->o.kernels, &j->voxels, LMB_VOXEL_WITH, LMB_VOXEL_WITH, &j->env[1], j->scratch, 1},
                         without = {j->o.kernels, &j->voxels, LMB_VOXEL_WITHOUT, LMB_VOXEL_WITHOUT, &j->env[0],
                                    j->scratch, 1};
    for (size_t i = 0; i < count;) {
        i = lmb_around_gather(p->around, inout, i, count, NEAR_LEAVES * j->voxels.leaf, p->about);
        if (lmb_cones_diffuse(&p->around->now, NULL, &with, &j->cones, &p->around->tile) != LMB_OK ||
            (is_real &&
             lmb_cones_diffuse(&p->around->before, NULL, &without, &j->cones, &p->around->tile) != LMB_OK) ||
            lmb_around_scale(inout, p->around, is_real ? NULL : &j->env[0]) != LMB_OK) {
            return 0;
        }
    }
    return 1;
}

static int relight_real(mix_job *j, points *p)
{
    memcpy(p->again, p->real, p->real_count * sizeof *p->again);
    return relight(j, p, p->again, p->real_count, 1);
}

static int relight_object(mix_job *j, points *p)
{
    lmb_texel *object = p->again + p->real_count;
    memcpy(object, p->object, p->object_count * sizeof *object);
    return relight(j, p, object, p->object_count, 0);
}

/* Without the object, the world is as in the photo. With it, iteration starts with a black object: first the floor
 * darkens beneath it, then the object is lit by that floor, and so on in turns. A bright start would leave the gap
 * between both bright for as many turns as light bounces there. */
static int inject_all(mix_job *j, points *p, report *r)
{
    int ok = dim_around(j, p) && inject_maps(j, p, LMB_VOXEL_WITHOUT) &&
             lmb_voxels_inject(&j->voxels, LMB_VOXEL_WITHOUT, p->real, p->real_count) == LMB_OK &&
             lmb_voxels_filter(&j->voxels, LMB_VOXEL_WITHOUT) == LMB_OK;
    memcpy(p->again, p->real, p->real_count * sizeof *p->again);
    memset(p->again + p->real_count, 0, p->object_count * sizeof *p->again);
    ok = ok && inject_with(j, p);
    for (int i = 0; ok && i < TURNS; ++i) {
        ok = (i % 2 == 0 ? relight_real(j, p) : relight_object(j, p)) && inject_with(j, p);
    }
    return (ok && lmb_voxels_delta(&j->voxels) == LMB_OK) || report_fail(r, "voxels cannot take their light");
}

/* Groups points with one result: those in one cube of NEAR_LEAVES with similar normals. */
typedef struct sorter {
    uint64_t key;
    uint32_t at;
} sorter;

static uint64_t key_of(const lmb_texel *t, const lmb_voxels *v)
{
    const float per = 1.0f / (NEAR_LEAVES * v->leaf * 0.57735f), at[3] = {t->position.x, t->position.y, t->position.z},
                low[3] = {v->low.x, v->low.y, v->low.z}, n[3] = {t->normal.x, t->normal.y, t->normal.z};
    uint64_t key = 0;
    for (int i = 0; i < 3; ++i) {
        key = key << 12 | ((uint64_t)((at[i] - low[i]) * per) & 0xfff);
    }
    for (int i = 0; i < 3; ++i) {
        key = key << 4 | (uint64_t)(fminf(fmaxf(n[i], -1.0f), 1.0f) * 6.5f + 7.0f);
    }
    return key;
}

static int by_key(const void *a, const void *b)
{
    const sorter *x = a, *y = b;
    return x->key != y->key ? (x->key > y->key) - (x->key < y->key) : (x->at > y->at) - (x->at < y->at);
}

/* Sorts points by position, because triangles of a mesh come in any order and near points share one result. */
static int sort_points(mix_job *j, lmb_texel *all, size_t count, report *r)
{
    sorter *order = mix_take(j, count * sizeof *order, r);
    lmb_texel *copy = mix_take(j, count * sizeof *copy, r);
    if (order == NULL || copy == NULL) {
        return 0;
    }
    for (size_t i = 0; i < count; ++i) {
        order[i].key = key_of(&all[i], &j->voxels);
        order[i].at = (uint32_t)i;
    }
    qsort(order, count, sizeof *order, by_key);
    memcpy(copy, all, count * sizeof *copy);
    for (size_t i = 0; i < count; ++i) {
        all[i] = copy[order[i].at];
    }
    return 1;
}

static lmb_texel *take_points(size_t *count, mix_job *j, uint32_t first_id, uint32_t triangles, report *r)
{
    const float leaf = 0.5f * j->voxels.leaf; /* half, so that leaves get about equal shares */
    const size_t cap = lmb_around_points(NULL, 0, j->bounces, first_id, triangles, leaf, &j->env[0]);
    lmb_texel *out = mix_take(j, cap * sizeof *out, r);
    if (out != NULL) {
        lmb_around_points(out, cap, j->bounces, first_id, triangles, leaf, &j->env[0]);
        *count = inside(out, cap, &j->voxels);
    }
    return out;
}

static int light_voxels(mix_job *j, report *r)
{
    const int32_t map = j->light_count > j->lamp_count ? j->maps[0][0].size : j->o.shadow_map, size = tree_side(j, map);
    const size_t bytes = lmb_tree_bytes(1, size);
    lmb_vec3 low, high;
    points p;
    memset(&p, 0, sizeof p);
    void *memory = mix_take(j, bytes, r);
    p.scratch = mix_take(j, sizeof *p.scratch, r);
    p.around = mix_take(j, sizeof *p.around, r);
    j->scratch = mix_take(j, sizeof *j->scratch, r);
    p.real = take_points(&p.real_count, j, 1, j->real_triangles, r);
    p.object = take_points(&p.object_count, j, j->real_triangles + 1, j->object_triangles, r);
    p.again = mix_take(j, (p.real_count + p.object_count) * sizeof *p.again, r);
    if (p.object != NULL && !sort_points(j, p.object, p.object_count, r)) {
        return 0;
    }
    if (memory == NULL || p.scratch == NULL || p.around == NULL || j->scratch == NULL || p.real == NULL ||
        p.object == NULL || p.again == NULL) {
        return 0;
    }
    if (lmb_tree_init(&p.tree, 1, size, memory, bytes) != LMB_OK) {
        return report_fail(r, "--shadow-map: a power of two, not %d", (int)map);
    }
    p.tree.faces = 1;
    mix_object_box(&low, &high, j);
    p.about = (lmb_vec3){0.5f * (low.x + high.x), 0.5f * (low.y + high.y), 0.5f * (low.z + high.z)};
    return find_sent(j, &p, r) && inject_all(j, &p, r);
}

/* Metal needs the environment and plane albedos in each frame, even if the voxels stay. The environment's dimming is
 * then that of the frame that built the voxels. */
static int find_mirrored(mix_job *j, report *r)
{
    if (j->object_triangles == 0 || !lmb_scene_is_glossy(&j->scene)) {
        return 1;
    }
    memcpy(j->dim, j->world->dim, sizeof j->dim);
    lmb_env_dim(&j->env[1], &j->env[0], j->dim);
    if (!colour_real(j, r)) {
        return 0;
    }
    mix_mirror_planes(j);
    return 1;
}

int mix_voxels(mix_job *j, report *r)
{
    if (j->object_triangles == 0 || mix_world_stays(j)) {
        return find_mirrored(j, r);
    }
    if (!colour_real(j, r) || !mix_lobes_bounces(j, r)) {
        return 0;
    }
    const double from = host_seconds();
    if (!build(j, r)) {
        return 0;
    }
    j->build_s = host_seconds() - from;
    return light_voxels(j, r) && mix_world_begins(j, r);
}
