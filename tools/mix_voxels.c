/* mix_voxels.c: the light that real surfaces and the object throw about, as voxels around the object. */
#include "mix_job.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { TREE_SIZE = 512, CONES = 19 };

/* The cube around the object is so many times as wide as it is. */
#define ROOM 6.0f

/* --- real surfaces' colours --------------------------------------------------------------------------------------- */

/* Sums of a row of cells. */
typedef struct colour {
    float rgb[3];
    int32_t count;
} colour;

/* A pixel's irradiance without the object: lamps, and what is around as if nothing were in its way. */
static void light_tile(lmb_irradiance *out, mix_job *j, const lmb_tile *tile, const lmb_view *view)
{
    memset(out, 0, sizeof *out);
    for (int32_t i = 0; i < j->light_count; ++i) {
        lmb_direct_tile(out, j->o.kernels, tile, view, &j->scene, &j->lights[i], &j->maps[i][0]);
    }
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        float rgb[3];
        const lmb_vec3 n = {tile->normal[0][k], tile->normal[1][k], tile->normal[2][k]};
        if (tile->id[k] != 0) {
            lmb_env_irradiance(rgb, &j->env, n);
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
        lmb_photo_view(&view, &x0, &y0, &j->frame.camera) != LMB_OK) {
        return report_fail(r, "intrinsics: the camera's axis is too far outside the photo");
    }
    for (int32_t y = 0; y < j->frame.light.height; y += LMB_TILE) {
        for (int32_t x = 0; x < j->frame.light.width; x += LMB_TILE) {
            lmb_real_tile(tile, &j->cloud, &j->planes, &j->real, x, y);
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

static void object_box(lmb_vec3 *low, lmb_vec3 *high, const mix_job *j)
{
    lmb_scene object = j->scene;
    object.instances = j->scene.instances + 1;
    object.instance_count = j->scene.instance_count - 1;
    lmb_scene_bounds(low, high, &object);
}

static int build(mix_job *j, report *r)
{
    lmb_vec3 low, high;
    object_box(&low, &high, j);
    const float size = fmaxf(fmaxf(high.x - low.x, high.y - low.y), high.z - low.z), half = 0.5f * ROOM * size;
    const lmb_vec3 middle = {0.5f * (low.x + high.x), 0.5f * (low.y + high.y), 0.5f * (low.z + high.z)};
    const lmb_vec3 from = {middle.x - half, middle.y - half, middle.z - half},
                   to = {middle.x + half, middle.y + half, middle.z + half};
    const lmb_voxel_part parts[2] = {{&j->scene, 1, j->real_triangles, {1, 1}},
                                     {&j->scene, j->real_triangles + 1, j->object_triangles, {0, 1}}};
    const uint32_t cap = 1u << (j->o.depth < 7 ? 18 : j->o.depth == 7 ? 19 : 21);
    const size_t bytes = lmb_voxels_bytes(cap, LMB_VOXELS_THREE);
    void *memory = mix_take(j, bytes, r);
    if (memory == NULL) {
        return 0;
    }
    if (lmb_voxels_init(&j->voxels, cap, LMB_VOXELS_THREE, memory, bytes) != LMB_OK ||
        lmb_voxels_build(&j->voxels, &from, &to, j->o.depth, parts, 2) != LMB_OK ||
        lmb_cones_init(&j->cones, &j->voxels, CONES) != LMB_OK ||
        lmb_cone_width_init(&j->gloss, &j->voxels, lmb_cone_tangent(j->o.roughness)) != LMB_OK) {
        return report_fail(r, "the object is too large or too small for voxels; --scale sets metres of a unit");
    }
    if (j->voxels.depth < j->voxels.asked) {
        fprintf(stderr, "lambent: voxels: %u are not enough for %d a side; they are coarser, %d a side\n", (unsigned)cap,
                1 << j->voxels.asked, 1 << j->voxels.depth);
    }
    return 1;
}

/* --- their light -------------------------------------------------------------------------------------------------- */

static int inject_map(mix_job *j, lmb_tree *tree, lmb_tile *scratch, int32_t light, int32_t with)
{
    const lmb_light_map *map = &j->maps[light][with];
    for (int32_t f = 0; f < map->faces; ++f) {
        if ((map->drawn >> f & 1u) != 0) {
            tree->faces = 1;
            if (lmb_tree_texels(tree, j->o.kernels, scratch, &j->scene, &j->lights[light], map, f, 0, 0,
                                tree->size / LMB_TILE) != LMB_OK ||
                lmb_voxels_inject(&j->voxels, with, tree->texel, (size_t)tree->size * (size_t)tree->size) != LMB_OK) {
                return 0;
            }
        }
    }
    return 1;
}

static int inject_lamps(mix_job *j, report *r)
{
    const int32_t size = j->o.light_map < TREE_SIZE ? j->o.light_map : j->o.light_map / 8 > TREE_SIZE ? j->o.light_map / 8
                                                                                                      : TREE_SIZE;
    const size_t bytes = lmb_tree_bytes(1, size);
    lmb_tree tree;
    lmb_tile *scratch = mix_take(j, sizeof *scratch, r);
    void *memory = mix_take(j, bytes, r);
    if (scratch == NULL || memory == NULL) {
        return 0;
    }
    if (lmb_tree_init(&tree, 1, size, memory, bytes) != LMB_OK) {
        return report_fail(r, "--light-map: a power of two, not %d", (int)j->o.light_map);
    }
    for (int32_t i = 0; i < j->light_count; ++i) {
        if (!inject_map(j, &tree, scratch, i, 0) || !inject_map(j, &tree, scratch, i, 1)) {
            return report_fail(r, "--light %d: its map cannot be taken into voxels", (int)i + 1);
        }
    }
    return 1;
}

static int inject_around(mix_job *j, report *r)
{
    for (int32_t field = 0; field < 2; ++field) {
        const uint32_t count = j->real_triangles + (field == LMB_VOXEL_WITH ? j->object_triangles : 0);
        if (lmb_around_inject(&j->voxels, field, &j->scene, 1, count, &j->env) != LMB_OK ||
            lmb_voxels_filter(&j->voxels, field) != LMB_OK) {
            return report_fail(r, "voxels cannot take their light");
        }
    }
    return lmb_voxels_delta(&j->voxels) == LMB_OK;
}

int mix_voxels(mix_job *j, report *r)
{
    if (j->object_triangles == 0) {
        return 1;
    }
    return colour_real(j, r) && build(j, r) && inject_lamps(j, r) && inject_around(j, r);
}
