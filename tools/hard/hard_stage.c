/* hard_stage.c: scenes of hard cases, drawn and lit by the library. */
#include "hard_stage.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

hard_stage *hard_stage_make(const lmb_kernels *kernels)
{
    hard_stage *s = calloc(1, sizeof *s);
    if (s == NULL) {
        return NULL;
    }
    s->kernels = kernels;
    s->map_bytes = lmb_shadow_map_bytes(HARD_FACES, HARD_MAP, LMB_ID32);
    s->tree_bytes = lmb_tree_bytes(HARD_FACES, HARD_TREE);
    s->bvh_bytes = lmb_bvh_bytes(HARD_TRIANGLES);
    s->lattice_bytes = lmb_lattice_bytes(HARD_SIDE, HARD_SIDE);
    s->live_bytes = lmb_live_bytes(HARD_FACES, lmb_live_side(HARD_FACES, HARD_MAP), 0);
    s->map_memory = malloc(s->map_bytes);
    s->tree_memory = malloc(s->tree_bytes);
    s->bvh_memory = malloc(s->bvh_bytes);
    s->lattice_memory = malloc(s->lattice_bytes);
    s->live_memory = malloc(s->live_bytes);
    if (s->map_memory == NULL || s->tree_memory == NULL || s->bvh_memory == NULL || s->lattice_memory == NULL ||
        s->live_memory == NULL) {
        hard_stage_free(s);
        return NULL;
    }
    return s;
}

void hard_stage_free(hard_stage *s)
{
    if (s != NULL) {
        free(s->map_memory);
        free(s->tree_memory);
        free(s->bvh_memory);
        free(s->lattice_memory);
        free(s->live_memory);
        free(s);
    }
}

/* --- the scene ---------------------------------------------------------------------------------------------------- */

uint32_t hard_part(hard_stage *s, double albedo)
{
    if (s->parts == HARD_PARTS) {
        abort(); /* a case needs more than HARD_PARTS */
    }
    const uint32_t k = s->parts++;
    lmb_material *m = &s->material[k];
    memset(m, 0, sizeof *m);
    m->albedo[0] = m->albedo[1] = m->albedo[2] = (float)albedo;
    m->alpha = 1.0f;
    m->texture = -1;
    m->flags = LMB_DOUBLE_SIDED;
    memset(&s->instance[k], 0, sizeof s->instance[k]);
    for (int i = 0; i < 4; ++i) {
        s->instance[k].to_world.m[5 * i] = 1.0f;
    }
    s->instance[k].mesh = s->instance[k].material = k;
    s->first[k] = s->count;
    return k;
}

void hard_begin(hard_stage *s, double albedo)
{
    s->count = s->parts = 0;
    memset(s->uv, 0, sizeof s->uv);
    memset(&s->texture, 0, sizeof s->texture);
    memset(&s->light, 0, sizeof s->light);
    memset(&s->scene, 0, sizeof s->scene);
    hard_part(s, albedo);
}

void hard_triangle(hard_stage *s, dvec a, dvec b, dvec c)
{
    if (s->count == HARD_TRIANGLES) {
        abort(); /* a case needs more than HARD_TRIANGLES */
    }
    dvec_write(s->corner[s->count][0], a);
    dvec_write(s->corner[s->count][1], b);
    dvec_write(s->corner[s->count][2], c);
    ++s->count;
}

void hard_quad(hard_stage *s, dvec centre, dvec u, dvec v)
{
    static const float uv[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
    const dvec a = dvec_sub(dvec_sub(centre, u), v), b = dvec_sub(dvec_add(centre, u), v),
               c = dvec_add(dvec_add(centre, u), v), d = dvec_add(dvec_sub(centre, u), v);
    hard_triangle(s, a, b, c);
    hard_triangle(s, a, c, d);
    memcpy(s->uv[s->count - 2], uv, sizeof uv);
}

void hard_box(hard_stage *s, dvec centre, dvec half)
{
    const dvec axis[3] = {{half.x, 0, 0}, {0, half.y, 0}, {0, 0, half.z}};
    for (int i = 0; i < 6; ++i) {
        const double sign = i & 1 ? -1.0 : 1.0;
        hard_quad(s, dvec_add(centre, dvec_mul(axis[i / 2], sign)), dvec_mul(axis[(i / 2 + 1) % 3], sign),
                  axis[(i / 2 + 2) % 3]);
    }
}

static dvec on_ball(dvec centre, double radius, int stack, int stacks, int slice, int slices)
{
    const double a = PI * stack / stacks, b = 2.0 * PI * slice / slices;
    return dvec_add(centre, dvec_mul(dvec_of(sin(a) * cos(b), cos(a), -sin(a) * sin(b)), radius));
}

void hard_ball(hard_stage *s, dvec centre, double radius, int slices)
{
    const int stacks = slices / 2;
    for (int i = 0; i < stacks; ++i) {
        for (int j = 0; j < slices; ++j) {
            const dvec a = on_ball(centre, radius, i, stacks, j, slices),
                       b = on_ball(centre, radius, i + 1, stacks, j, slices),
                       c = on_ball(centre, radius, i + 1, stacks, j + 1, slices),
                       d = on_ball(centre, radius, i, stacks, j + 1, slices);
            if (i + 1 < stacks) {
                hard_triangle(s, a, b, c);
            }
            if (i > 0) {
                hard_triangle(s, a, c, d);
            }
        }
    }
}

void hard_holes(hard_stage *s, uint32_t part, uint8_t *texels, int side)
{
    for (int i = 0; i < side * side; ++i) {
        memset(texels + 4 * i, 255, 4);
        texels[4 * i + 3] = ((i % side) ^ (i / side)) & 1 ? 0 : 255;
    }
    s->texture.texels = texels;
    s->texture.width = s->texture.height = (uint16_t)side;
    s->texture.levels = 1;
    s->texture.filter = LMB_NEAREST;
    s->material[part].texture = 0;
    s->material[part].flags |= LMB_ALPHA_MASK;
    s->material[part].alpha_cutoff = 0.5f;
}

static dvec placed(const lmb_mat4 *t, const float p[3])
{
    const float *m = t->m;
    const dvec x = dvec_of((double)m[0], (double)m[1], (double)m[2]),
               y = dvec_of((double)m[4], (double)m[5], (double)m[6]),
               z = dvec_of((double)m[8], (double)m[9], (double)m[10]);
    const dvec to = dvec_of((double)m[12], (double)m[13], (double)m[14]);
    return dvec_add(dvec_add(dvec_mul(x, (double)p[0]), dvec_mul(y, (double)p[1])),
                    dvec_add(dvec_mul(z, (double)p[2]), to));
}

static void end_part(hard_stage *s, uint32_t k)
{
    const uint32_t from = s->first[k], to = k + 1 < s->parts ? s->first[k + 1] : s->count;
    memset(&s->mesh[k], 0, sizeof s->mesh[k]);
    s->mesh[k].positions = s->corner[from];
    s->mesh[k].uvs = s->uv[from];
    s->mesh[k].triangle_count = to - from;
    s->mesh[k].vertex_count = 3 * (to - from);
    s->instance[k].first_id = from + 1;
    for (uint32_t i = from; i < to; ++i) {
        for (int c = 0; c < 3; ++c) {
            s->world[i][c] = placed(&s->instance[k].to_world, s->corner[i][c]);
        }
    }
}

int hard_end(hard_stage *s)
{
    for (uint32_t k = 0; k < s->parts; ++k) {
        end_part(s, k);
    }
    s->scene.meshes = s->mesh;
    s->scene.materials = s->material;
    s->scene.instances = s->instance;
    s->scene.textures = &s->texture;
    s->scene.lights = &s->light;
    s->scene.mesh_count = s->scene.material_count = s->scene.instance_count = s->parts;
    s->scene.texture_count = s->texture.texels != NULL;
    s->scene.light_count = s->light.intensity[0] > 0.0f;
    lmb_scene_bounds(&s->scene.bounds_min, &s->scene.bounds_max, &s->scene);
    lmb_scene_core(&s->scene.core, &s->scene);
    return lmb_scene_check(&s->scene) == LMB_OK;
}

static void set_light(hard_stage *s, int32_t kind, dvec at, dvec along, double intensity)
{
    float place[3], way[3];
    memset(&s->light, 0, sizeof s->light);
    dvec_write(place, at);
    dvec_write(way, dvec_unit(along));
    s->light.kind = kind;
    s->light.position = (lmb_vec3){place[0], place[1], place[2]};
    s->light.direction = (lmb_vec3){way[0], way[1], way[2]};
    s->light.intensity[0] = s->light.intensity[1] = s->light.intensity[2] = (float)intensity;
    s->light.cos_inner = s->light.cos_outer = 0.5f;
}

void hard_spot(hard_stage *s, dvec at, dvec towards, double outer_deg, double intensity)
{
    set_light(s, LMB_LIGHT_SPOT, at, dvec_sub(towards, at), intensity);
    s->light.cos_inner = (float)cos(0.8 * outer_deg * PI / 180.0);
    s->light.cos_outer = (float)cos(outer_deg * PI / 180.0);
}

void hard_point(hard_stage *s, dvec at, double intensity)
{
    set_light(s, LMB_LIGHT_POINT, at, dvec_of(0, -1, 0), intensity);
}

void hard_sun(hard_stage *s, dvec along, double irradiance)
{
    set_light(s, LMB_LIGHT_DIRECTIONAL, dvec_of(0, 0, 0), along, irradiance);
}

/* --- drawing by the library --------------------------------------------------------------------------------------- */

static void set_eye(hard_stage *s)
{
    const int32_t side = s->view.frame_width;
    memset(&s->eye, 0, sizeof s->eye);
    lmb_surface_init(&s->eye.depth, LMB_DEPTH32F, side, side, s->depth, sizeof s->depth);
    lmb_surface_init(&s->eye.id, LMB_ID32, side, side, s->id, sizeof s->id);
}

void hard_look(hard_stage *s, dvec from, dvec target, double fov_deg, int32_t side)
{
    const dvec along = dvec_sub(target, from);
    const int steep = fabs(along.y) > 0.999 * dvec_length(along);
    float e[3], t[3];
    dvec_write(e, from);
    dvec_write(t, target);
    lmb_view_look_at(&s->view, (lmb_vec3){e[0], e[1], e[2]}, (lmb_vec3){t[0], t[1], t[2]},
                     (lmb_vec3){0, steep ? 0.0f : 1.0f, steep ? 1.0f : 0.0f}, (float)(fov_deg * PI / 180.0), side,
                     side);
    set_eye(s);
}

void hard_look_flat(hard_stage *s, int32_t side)
{
    lmb_view *v = &s->view;
    memset(v, 0, sizeof *v);
    v->right.x = v->up.y = v->back.z = 1.0f;
    v->half_width = v->half_height = 0.5f * (float)side;
    v->near_m = 1.0f;
    v->far_m = 2.0f;
    v->kind = LMB_ORTHOGRAPHIC;
    v->frame_width = v->frame_height = side;
    set_eye(s);
}

void hard_draw(hard_stage *s, uint32_t first, uint32_t count)
{
    lmb_surface_clear(&s->eye.depth);
    lmb_surface_clear(&s->eye.id);
    lmb_draw(&s->eye, s->kernels, &s->view, &s->scene, first + 1, count, 0, &s->stats);
}

size_t hard_at(const hard_stage *s, int32_t x, int32_t y)
{
    const int32_t tiles = (s->view.frame_width + LMB_TILE - 1) / LMB_TILE;
    return (size_t)((y / LMB_TILE * tiles + x / LMB_TILE) * LMB_TILE_PIXELS + y % LMB_TILE * LMB_TILE + x % LMB_TILE);
}

float hard_depth(const hard_stage *s, int32_t x, int32_t y)
{
    float d;
    memcpy(&d, &s->depth[hard_at(s, x, y)], sizeof d);
    return d;
}

void hard_map(hard_stage *s, int32_t size)
{
    lmb_shadow_map_init(&s->map, &s->light, &s->scene, size, LMB_ID32, s->map_memory, s->map_bytes);
    lmb_shadow_map_clear(&s->map);
    lmb_shadow_map_draw(&s->map, s->kernels, &s->scene, 1, UINT32_MAX, NULL);
}

void hard_direct(hard_stage *s, int32_t x, int32_t y)
{
    memset(&s->lit, 0, sizeof s->lit);
    lmb_resolve_tile(&s->tile, s->kernels, &s->view, &s->scene, &s->eye, x, y);
    lmb_direct_tile(&s->lit, s->kernels, &s->tile, &s->view, &s->scene, &s->light, &s->map);
}

lmb_status hard_frame(hard_stage *s, int32_t show, int32_t map, float error)
{
    const int32_t side = s->view.frame_width;
    lmb_frame f;
    memset(&f, 0, sizeof f);
    f.kernels = s->kernels;
    f.scene = &s->scene;
    f.view = s->view;
    f.show = show;
    f.shadow_map = map;
    f.grouping.method = LMB_GROUP_CUT;
    f.occlusion = LMB_OCCLUSION_EXACT;
    f.error = error;
    f.visibility = 0.75f * error;
    f.transfer = s->transfer;
    f.transfer_light = s->transfer_light;
    f.map_memory = s->map_memory;
    f.map_bytes = s->map_bytes;
    f.eye = s->eye;
    f.scratch = &s->scratch;
    f.stats = &s->stats;
    const int32_t own = map < HARD_TREE ? map : HARD_TREE;
    lmb_tree_init(&f.tree, HARD_FACES, s->tree_size > 0 ? s->tree_size : own, s->tree_memory, s->tree_bytes);
    lmb_bvh_init(&f.bvh, HARD_TRIANGLES, s->bvh_memory, s->bvh_bytes);
    f.gather_step = s->gather_step;
    lmb_lattice_init(&f.lattice, side, side, s->lattice_memory, s->lattice_bytes);
    lmb_live_init(&s->live, HARD_FACES, lmb_live_side(HARD_FACES, HARD_MAP), 0, s->live_memory, s->live_bytes);
    s->live.strata = LMB_LIVE_STRATA / 2;
    s->live.split = 8.0f;
    f.live = &s->live;
    s->scratch.live = &s->live_scratch;
    lmb_surface_init(&f.out, LMB_RGB32F, side, side, s->out, sizeof s->out);
    lmb_surface_clear(&s->eye.depth);
    lmb_surface_clear(&s->eye.id);
    return lmb_render_frame(&s->render, &f);
}
