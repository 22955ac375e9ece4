/* draw_list.c: a list's vertices and primitives, checked and drawn in order. Layer 4. */
#include "draw_part.h"

#include <string.h>

#include "../base/surface_check.h"

#if LMB_DRAW
#define LIST_GUARD_PX 16383.0f /* from the viewport's middle; one px of rounding short of what setup.c can take */
#define LIST_ABSURD   1e30f    /* of clip space */

/* --- vertices ----------------------------------------------------------------------------------------------------- */

static void list_fetch_values(float *out, const void *data, uint32_t i, int n, int format)
{
    const size_t at = (size_t)i * (size_t)(format == LMB_DRAW_I16 && n == 3 ? 4 : n);
    if (format == LMB_DRAW_F32) {
        memcpy(out, (const float *)data + at, (size_t)n * sizeof *out);
        return;
    }
    for (int k = 0; k < n; ++k) {
        out[k] = format == LMB_DRAW_I16 ? (float)((const int16_t *)data)[at + (size_t)k]
                                        : (float)((const int32_t *)data)[at + (size_t)k] * (1.0f / 65536.0f);
    }
}

static float list_row(const lmb_mat4 *m, int row, lmb_vec3 p)
{
    return m->m[row] * p.x + m->m[4 + row] * p.y + m->m[8 + row] * p.z + m->m[12 + row];
}

static float list_plane(const float plane[4], lmb_vec3 p)
{
    return plane[0] * p.x + plane[1] * p.y + plane[2] * p.z + plane[3];
}

/* Its position in clip space, and what depends on it; 0 if it is not finite or absurd. */
static int list_place(lmb_draw_corner *out, const lmb_draw_pass *pass, uint32_t i)
{
    const lmb_draw_vertices *v = pass->vertices;
    const lmb_draw_state *s = pass->state;
    float at[3];
    int sane = 1;
    list_fetch_values(at, v->positions, i, 3, v->position_format);
    lmb_vec3 p = vec3(at[0], at[1], at[2]);
    if (v->position_format == LMB_DRAW_I16) {
        p = vec3(v->position_scale.x * p.x + v->position_offset.x, v->position_scale.y * p.y + v->position_offset.y,
                 v->position_scale.z * p.z + v->position_offset.z);
    }
    for (int row = 0; row < 4; ++row) {
        out->v[CORNER_X + row] = list_row(&s->to_clip, row, p);
        sane &= out->v[CORNER_X + row] > -LIST_ABSURD && out->v[CORNER_X + row] < LIST_ABSURD;
    }
    const float *axis = s->fog_axis;
    const int has_axis = axis[0] != 0.0f || axis[1] != 0.0f || axis[2] != 0.0f || axis[3] != 0.0f;
    out->v[CORNER_FOG] = has_axis ? list_plane(axis, p) : out->v[CORNER_W];
    sane &= out->v[CORNER_FOG] > -LIST_ABSURD && out->v[CORNER_FOG] < LIST_ABSURD;
    for (int k = 0; k < LMB_DRAW_PLANES; ++k) {
        const int on = (s->planes >> k & 1u) != 0;
        out->v[CORNER_PLANES + k] = on ? list_plane(s->plane[k], p) : 0.0f;
        sane &= out->v[CORNER_PLANES + k] > -LIST_ABSURD && out->v[CORNER_PLANES + k] < LIST_ABSURD;
    }
    return sane && is_place(p);
}

/* Vertex i; 0 if it is to be dropped. */
static int list_vertex(lmb_draw_corner *out, const lmb_draw_pass *pass, uint32_t i)
{
    const lmb_draw_vertices *v = pass->vertices;
    const uint8_t *colour = v->colours != NULL ? v->colours + 4 * (size_t)i : pass->state->colour;
    int sane = list_place(out, pass, i);
    for (int k = 0; k < 4; ++k) {
        out->v[CORNER_RED + k] = (float)colour[k];
    }
    for (int k = 0; k < LMB_DRAW_STAGES; ++k) {
        float *uv = &out->v[CORNER_UV + 2 * k];
        uv[0] = uv[1] = 0.0f;
        if (v->uvs[k] != NULL && pass->state->stage[k].texture != NULL) {
            const float scale = v->uv_format == LMB_DRAW_I16 ? v->uv_scale : 1.0f;
            list_fetch_values(uv, v->uvs[k], i, 2, v->uv_format);
            uv[0] *= scale;
            uv[1] *= scale;
            sane &= is_sane(uv[0]) && is_sane(uv[1]);
        }
    }
    return sane;
}

/* --- primitives --------------------------------------------------------------------------------------------------- */

/* One with `n` corners, the last of which gives a flat colour: the `flat`-th of the list. */
static void list_draw(const lmb_draw_pass *pass, const uint32_t *order, int n, uint32_t flat)
{
    lmb_draw_corner corner[DRAW_CORNERS];
    int sane = 1, drawn;
    for (int i = 0; i < n && sane; ++i) {
        const uint32_t at = draw_index(pass, order[i]);
        sane = at < pass->vertices->count && list_vertex(&corner[i], pass, at);
    }
    const uint32_t at = draw_index(pass, flat);
    sane &= at < pass->vertices->count;
    if (pass->stats != NULL) {
        ++pass->stats->triangles;
        pass->stats->triangles_dropped += !sane;
    }
    if (!sane) {
        return;
    }
    if ((pass->state->flags & LMB_DRAW_FLAT) != 0 && pass->vertices->colours != NULL) {
        const uint8_t *colour = pass->vertices->colours + 4 * (size_t)at;
        for (int i = 0; i < 4 * n; ++i) {
            corner[i / 4].v[CORNER_RED + i % 4] = (float)colour[i % 4];
        }
    }
    drawn = n == 3   ? lmb_draw_triangle(pass, corner)
            : n == 2 ? lmb_draw_line(pass, corner)
                     : lmb_draw_point(pass, corner);
    if (pass->stats != NULL) {
        pass->stats->triangles_drawn += (uint32_t)drawn;
    }
}

static void list_triangle(const lmb_draw_pass *pass, uint32_t a, uint32_t b, uint32_t c, uint32_t flat)
{
    const uint32_t order[3] = {a, b, c};
    if (pass->kept == NULL || !lmb_draw_quick(pass, a, b, c, flat)) {
        list_draw(pass, order, 3, flat);
    }
}

static void list_line(const lmb_draw_pass *pass, uint32_t a, uint32_t b)
{
    const uint32_t order[2] = {a, b};
    list_draw(pass, order, 2, b);
}

static void list_quad(const lmb_draw_pass *pass, uint32_t a, uint32_t b, uint32_t c, uint32_t d, uint32_t flat)
{
    list_triangle(pass, a, b, c, flat);
    list_triangle(pass, a, c, d, flat);
}

static void list_areas(const lmb_draw_pass *pass, int32_t primitive, uint32_t count)
{
    switch (primitive) {
    case LMB_DRAW_TRIANGLES:
        for (uint32_t i = 2; i < count; i += 3) {
            list_triangle(pass, i - 2, i - 1, i, i);
        }
        break;
    case LMB_DRAW_TRIANGLE_STRIP:
        for (uint32_t i = 2; i < count; ++i) {
            list_triangle(pass, i - 2 + (i & 1u), i - 1 - (i & 1u), i, i);
        }
        break;
    case LMB_DRAW_TRIANGLE_FAN:
        for (uint32_t i = 2; i < count; ++i) {
            list_triangle(pass, 0, i - 1, i, i);
        }
        break;
    case LMB_DRAW_QUADS:
        for (uint32_t i = 3; i < count; i += 4) {
            list_quad(pass, i - 3, i - 2, i - 1, i, i);
        }
        break;
    default: /* a strip of quads */
        for (uint32_t i = 3; i < count; i += 2) {
            list_quad(pass, i - 3, i - 2, i, i - 1, i);
        }
        break;
    }
}

static void list_lines(const lmb_draw_pass *pass, int32_t primitive, uint32_t count)
{
    for (uint32_t i = 1; i < count; i += primitive == LMB_DRAW_LINES ? 2 : 1) {
        list_line(pass, i - 1, i);
    }
    if (primitive == LMB_DRAW_LINE_LOOP && count >= 2) {
        list_line(pass, count - 1, 0);
    }
}

/* --- the call ----------------------------------------------------------------------------------------------------- */

static size_t list_value_bytes(int format) { return format == LMB_DRAW_I16 ? 2 : 4; }

static int list_is_aligned(const void *p, size_t bytes) { return (uintptr_t)p % bytes == 0; }

static lmb_status list_check_vertices(const lmb_draw_vertices *v)
{
    int aligned = 1;
    if (v->position_format > LMB_DRAW_FIXED || v->uv_format > LMB_DRAW_FIXED) {
        return LMB_ERR_FORMAT;
    }
    if ((v->positions == NULL && v->count > 0) || v->count > UINT32_MAX - 4) {
        return LMB_ERR_ARG;
    }
    if ((v->position_format == LMB_DRAW_I16 && !(is_place(v->position_scale) && is_place(v->position_offset))) ||
        (v->uv_format == LMB_DRAW_I16 && !is_sane(v->uv_scale))) {
        return LMB_ERR_ARG;
    }
    for (int k = 0; k < LMB_DRAW_STAGES; ++k) {
        aligned &= list_is_aligned(v->uvs[k], list_value_bytes(v->uv_format));
    }
    return aligned && list_is_aligned(v->positions, list_value_bytes(v->position_format)) ? LMB_OK : LMB_ERR_ALIGN;
}

static lmb_status list_check_indices(const lmb_draw_indices *x)
{
    if (x == NULL) {
        return LMB_OK;
    }
    if (x->format > LMB_DRAW_INDEX_U8) {
        return LMB_ERR_FORMAT;
    }
    if ((x->format != LMB_INDEX_NONE && x->data == NULL && x->count > 0) || x->count > UINT32_MAX - 4) {
        return LMB_ERR_ARG;
    }
    const size_t bytes = x->format == LMB_INDEX_U32 ? 4 : x->format == LMB_INDEX_U16 ? 2 : 1;
    return list_is_aligned(x->data, bytes) ? LMB_OK : LMB_ERR_ALIGN;
}

static void list_keep(lmb_draw_pass *pass, int32_t x, int32_t y, int32_t width, int32_t height)
{
    pass->x0 = maxi(pass->x0, x);
    pass->y0 = maxi(pass->y0, y);
    pass->x1 = mini(pass->x1, x + width - 1);
    pass->y1 = mini(pass->y1, y + height - 1);
}

static void list_set_window(lmb_draw_pass *pass)
{
    const lmb_draw_target *t = pass->target;
    const lmb_draw_state *s = pass->state;
    const lmb_surface *any = t->colour.data != NULL ? &t->colour : &t->depth;
    pass->x0 = t->x0;
    pass->y0 = t->y0;
    pass->x1 = t->x0 + any->width - 1;
    pass->y1 = t->y0 + any->height - 1;
    list_keep(pass, s->viewport[0], s->viewport[1], s->viewport[2], s->viewport[3]);
    if ((s->flags & LMB_DRAW_SCISSOR) != 0) {
        list_keep(pass, s->scissor[0], s->scissor[1], s->scissor[2], s->scissor[3]);
    }
}

static void list_set_pass(lmb_draw_pass *pass)
{
    const lmb_draw_target *t = pass->target;
    const lmb_draw_state *s = pass->state;
    list_set_window(pass);
    pass->middle_x = s->viewport[0] * 256 + s->viewport[2] * 128;
    pass->middle_y = s->viewport[1] * 256 + s->viewport[3] * 128;
    pass->snap_x = (float)(s->viewport[2] * 128);
    pass->snap_y = (float)(s->viewport[3] * 128);
    pass->guard_x = LIST_GUARD_PX * 2.0f / (float)s->viewport[2];
    pass->guard_y = LIST_GUARD_PX * 2.0f / (float)s->viewport[3];
    pass->depth_scale = pass->depth_bias = 0.0f;
    if (t->depth.data != NULL && t->depth.format == LMB_DEPTH16) {
        pass->depth_scale = 65534.0f / (1.0f - t->depth_far);
        pass->depth_bias = 1.0f - t->depth_far * pass->depth_scale;
    }
    pass->tests = (s->flags & (LMB_DRAW_DEPTH_TEST | LMB_DRAW_STENCIL)) != 0;
    pass->shows = t->colour.data != NULL && s->colour_mask != 0;
}

static lmb_status list_check(const lmb_draw_target *target, const lmb_draw_state *state,
                             const lmb_draw_vertices *vertices, int32_t primitive, const lmb_draw_indices *indices)
{
    if (target == NULL || state == NULL || vertices == NULL || primitive < LMB_DRAW_TRIANGLES ||
        primitive > LMB_DRAW_POINTS) {
        return LMB_ERR_ARG;
    }
    lmb_status status = lmb_draw_check_target(target);
    status = status != LMB_OK ? status : lmb_draw_check_state(state, target);
    status = status != LMB_OK ? status : list_check_vertices(vertices);
    return status != LMB_OK ? status : list_check_indices(indices);
}

lmb_status lmb_draw_list(const lmb_draw_target *target, const lmb_draw_state *state, const lmb_draw_vertices *vertices,
                         int32_t primitive, const lmb_draw_indices *indices, lmb_stats *stats)
{
    const lmb_status status = list_check(target, state, vertices, primitive, indices);
    lmb_draw_pass pass;
    lmb_draw_kept kept;
    if (status != LMB_OK) {
        return status;
    }
    memset(&pass, 0, sizeof pass);
    pass.target = target;
    pass.state = state;
    pass.vertices = vertices;
    pass.indices = indices;
    pass.stats = stats;
    list_set_pass(&pass);
    lmb_draw_rows_begin(&pass);
    if (primitive < LMB_DRAW_LINES) {
        lmb_draw_quick_begin(&pass, &kept);
    }
    const uint32_t count = indices != NULL ? indices->count : vertices->count;
    if (primitive == LMB_DRAW_POINTS) {
        for (uint32_t i = 0; i < count; ++i) {
            list_draw(&pass, &i, 1, i);
        }
    } else if (primitive >= LMB_DRAW_LINES) {
        list_lines(&pass, primitive, count);
    } else {
        list_areas(&pass, primitive, count);
    }
    return LMB_OK;
}
#endif
