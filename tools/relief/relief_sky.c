/* relief_sky.c: light and background of a picture of reliefs from a world around it. */
#include "relief_sky.h"

#include <stdlib.h>
#include <string.h>

#include "../common/fvec.h"

enum { IRRADIANCE_SIDE = 16 }; /* texels per side of a face: irradiance is smooth */

void relief_sky_free(relief_sky *s)
{
    world_free(&s->around);
    light_stream_free(&s->stream);
    free(s->memory);
    memset(s, 0, sizeof *s);
}

/* --- before the pictures ------------------------------------------------------------------------------------------ */

/* Unit vector to texel (x, y) of a face, in GL order. */
static lmb_vec3 texel_normal(int32_t face, int32_t x, int32_t y)
{
    const float s = (float)(2 * x + 1) / IRRADIANCE_SIDE - 1.0f, t = (float)(2 * y + 1) / IRRADIANCE_SIDE - 1.0f,
                side = face % 2 == 0 ? 1.0f : -1.0f;
    return normalize3(face < 2   ? vec3(side, -t, -side * s)
                      : face < 4 ? vec3(s, side, side * t)
                                 : vec3(side * s, -t, side));
}

static void sum_lights(float rgb[3], const lmb_light *lights, uint32_t count, lmb_vec3 normal)
{
    double sum[3] = {0.0, 0.0, 0.0};
    for (uint32_t i = 0; i < count; ++i) {
        const float cosine = -dot3(normal, lights[i].direction);
        for (int c = 0; c < 3 && cosine > 0.0f; ++c) {
            sum[c] += (double)(cosine * lights[i].intensity[c]);
        }
    }
    for (int c = 0; c < 3; ++c) {
        rgb[c] = (float)sum[c];
    }
}

static int make_irradiance(relief_sky *s, report *r)
{
    const size_t bytes = lmb_env_bytes(IRRADIANCE_SIDE);
    s->memory = malloc(bytes);
    if (s->memory == NULL || lmb_env_init(&s->irradiance, IRRADIANCE_SIDE, s->memory, bytes) != LMB_OK) {
        return report_fail(r, "not enough memory for a world's light");
    }
    for (int32_t i = 0; i < 6 * IRRADIANCE_SIDE * IRRADIANCE_SIDE; ++i) {
        const int32_t face = i / (IRRADIANCE_SIDE * IRRADIANCE_SIDE), x = i % IRRADIANCE_SIDE,
                      y = i / IRRADIANCE_SIDE % IRRADIANCE_SIDE;
        float rgb[3];
        sum_lights(rgb, s->around.lights, s->around.count, texel_normal(face, x, y));
        lmb_env_set(&s->irradiance, face, x, y, rgb);
    }
    lmb_env_mips(&s->irradiance);
    return 1;
}

/* The disc comes last in a copy of the arrays of `below`; here it becomes a scene by itself. */
static int put_disc(relief_sky *s, const lmb_scene *below, lmb_vec3 eye, report *r)
{
    lmb_scene with = *below;
    if (!world_put_ground(&s->around, &with, eye, r)) {
        return 0;
    }
    if (s->around.has_ground) {
        s->on_ground = with.instances[with.instance_count - 1];
        s->ground.meshes = with.meshes + s->on_ground.mesh;
        s->ground.materials = with.materials + s->on_ground.material;
        s->ground.mesh_count = s->ground.material_count = s->ground.instance_count = 1;
        s->on_ground.mesh = s->on_ground.material = 0;
        s->on_ground.first_id = 1;
        s->ground.instances = &s->on_ground;
        lmb_scene_bounds(&s->ground.bounds_min, &s->ground.bounds_max, &s->ground);
    }
    return 1;
}

int relief_sky_open(relief_sky *out, const char *path, const lmb_scene *below, lmb_vec3 eye, int is_quiet, report *r)
{
    memset(out, 0, sizeof *out);
    const int is_sky = strcmp(path, "sky") == 0;
    int ok = (is_sky ? world_sky(&out->around, r) : world_read(&out->around, path, is_quiet, r)) &&
             (below == NULL || put_disc(out, below, eye, r)) && world_light(&out->around, r) && make_irradiance(out, r);
    if (ok && out->around.count > 0) {
        const light_list lists[2] = {{out->around.lights, out->around.count}, {NULL, 0}};
        ok = light_stream_take(&out->stream, lists, LIGHT_STREAM_CELLS, r);
    }
    if (ok && out->around.count == 0 && !out->around.has_sun) {
        report_note(is_quiet, "note: %s gives no light", path);
    }
    if (!ok) {
        relief_sky_free(out);
    }
    return ok;
}

/* --- a tile ------------------------------------------------------------------------------------------------------- */

static void add_open(lmb_irradiance *inout, const relief_sky *s, const lmb_tile *tile)
{
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const lmb_vec3 n = vec3(tile->normal[0][k], tile->normal[1][k], tile->normal[2][k]);
        float rgb[3];
        if (tile->id[k] == 0) {
            continue;
        }
        lmb_env_sample(rgb, &s->irradiance, n, 0.0f);
        for (int c = 0; c < 3; ++c) {
            inout->rgb[c][k] += rgb[c];
        }
    }
}

lmb_status relief_sky_tile(lmb_irradiance *inout, relief_sky_scratch *scratch, const relief_sky *s,
                           const lmb_kernels *kernels, const lmb_tile *tile, uint64_t of_relief, const lmb_bvh *plain,
                           const lmb_bvh *both)
{
    lmb_status status = LMB_OK;
    if (plain->node_count == 0 || s->stream.tree.node == NULL) {
        add_open(inout, s, tile);
        return LMB_OK;
    }
    for (int relief = 0; relief < 2 && status == LMB_OK; ++relief) {
        const lmb_many_lights_query query = {.many_lights = &s->stream.tree, .bvh = relief ? plain : both};
        scratch->tile = *tile;
        scratch->tile.hits = 0;
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            scratch->tile.id[k] = (int)(of_relief >> k & 1u) == relief ? tile->id[k] : 0;
            scratch->tile.hits += scratch->tile.id[k] != 0;
        }
        if (scratch->tile.hits > 0) {
            status = lmb_many_lights_direct_tile(inout, kernels, &scratch->lights, &scratch->tile, &query);
        }
    }
    return status;
}

void relief_sky_behind(float rgb[3], const relief_sky *s, const lmb_view *view, int32_t x, int32_t y)
{
    const float across = 2.0f * ((float)x + 0.5f + (float)view->sample_x / 256.0f) / (float)view->frame_width - 1.0f,
                down = 2.0f * ((float)y + 0.5f + (float)view->sample_y / 256.0f) / (float)view->frame_height - 1.0f;
    const lmb_vec3 right = mul3(view->right, across * view->half_width), up = mul3(view->up, -down * view->half_height),
                   to = sub3(add3(right, up), view->back);
    const int perspective = view->kind == LMB_PERSPECTIVE;
    lmb_env_sample(rgb, &s->around.env, perspective ? to : mul3(view->back, -1.0f),
                   perspective ? view->half_height / (float)view->frame_height : 0.0f);
}
