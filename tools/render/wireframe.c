/* wireframe.c: the edges of a scene's triangles, without those that surfaces hide. */
#include "wireframe.h"

#include <stdlib.h>
#include <string.h>

/* Surfaces are offset back by their depth change over a pixel, so that they do not hide their own edges. */
#define BACK_SLOPE (-1.0f)
#define BACK_STEPS (-64.0f)

/* Draw state for a material, with edges or without. Holes are not tested: such surfaces hide nothing. */
static void set_state(lmb_draw_state *s, const lmb_scene *scene, const lmb_instance *instance, int edges)
{
    const lmb_material *m = &scene->materials[instance->material];
    const float *t = instance->to_world.m;
    const float volume = t[0] * (t[5] * t[10] - t[9] * t[6]) - t[4] * (t[1] * t[10] - t[9] * t[2]) +
                         t[8] * (t[1] * t[6] - t[5] * t[2]);
    s->flags = LMB_DRAW_DEPTH_TEST | (edges ? 0u : LMB_DRAW_DEPTH_WRITE);
    s->flags |= (m->flags & LMB_DOUBLE_SIDED) != 0 ? 0u : LMB_DRAW_CULL_BACK;
    s->flags |= volume < 0.0f ? LMB_DRAW_CLOCKWISE : 0u;
    s->depth_func = edges ? LMB_DRAW_GEQUAL : LMB_DRAW_GREATER;
    s->colour_mask = edges ? 15 : 0;
    s->offset_slope = edges ? 0.0f : BACK_SLOPE;
    s->offset_units = edges ? 0.0f : BACK_STEPS;
    s->polygon_mode[0] = s->polygon_mode[1] = edges ? LMB_DRAW_EDGES : LMB_DRAW_FILL;
}

static lmb_status draw_instance(const lmb_draw_target *target, const lmb_frame *f, const lmb_scene *scene,
                                const lmb_instance *instance, int edges)
{
    const lmb_mesh *mesh = &scene->meshes[instance->mesh];
    const lmb_draw_vertices v = {.positions = mesh->positions,
                                 .count = mesh->vertex_count,
                                 .position_scale = mesh->position_scale,
                                 .position_offset = mesh->position_offset,
                                 .position_format = mesh->position_format == LMB_POSITION_I16 ? LMB_DRAW_I16
                                                                                              : LMB_DRAW_F32};
    const lmb_draw_indices x = {mesh->indices, 3 * mesh->triangle_count, mesh->index_format};
    lmb_draw_state s;
    if (!edges && (scene->materials[instance->material].flags & LMB_ALPHA_MASK) != 0) {
        return LMB_OK;
    }
    lmb_status status = lmb_draw_state_init(&s, f->view.frame_width, f->view.frame_height);
    status = status != LMB_OK ? status : lmb_draw_view(&s, &f->view, &instance->to_world);
    set_state(&s, scene, instance, edges);
    return status != LMB_OK ? status : lmb_draw_list(target, &s, &v, LMB_DRAW_TRIANGLES, &x, NULL);
}

lmb_status wireframe_draw(render_job *j)
{
    lmb_frame *f = &j->frame;
    const int32_t width = f->view.frame_width, height = f->view.frame_height;
    const size_t bytes = lmb_surface_bytes(LMB_RGBA8, width, height);
    uint8_t *lines = calloc(bytes, 1);
    lmb_draw_target target;
    memset(&target, 0, sizeof target);
    target.depth = f->eye.depth;
    lmb_status status = lines == NULL ? LMB_ERR_CAPACITY
                                      : lmb_surface_init(&target.colour, LMB_RGBA8, width, height, lines, bytes);
    lmb_surface_clear(&f->eye.depth);
    for (uint32_t i = 0; i < 2 * j->scene.instance_count && status == LMB_OK; ++i) {
        const int edges = i >= j->scene.instance_count;
        status = draw_instance(&target, f, &j->scene, &j->scene.instances[i % j->scene.instance_count], edges);
    }
    for (int32_t y = 0; y < height && status == LMB_OK; ++y) {
        float *row = (float *)(void *)((uint8_t *)f->out.data + (ptrdiff_t)y * f->out.stride_bytes);
        const uint8_t *from = lines + (ptrdiff_t)y * target.colour.stride_bytes;
        for (int32_t k = 0; k < 3 * width; ++k) {
            row[k] = (float)from[k / 3 * 4 + k % 3] * (1.0f / 255.0f);
        }
    }
    free(lines);
    return status;
}
