/* draw_vertex.c: values of vertex streams, and checks of them. Layer 4. */
#include "draw_part.h"

#include <string.h>

#if LMB_DRAW
void lmb_draw_fetch(float *out, const void *data, uint32_t i, int n, int format)
{
    const size_t at = (size_t)i * (size_t)(format == LMB_DRAW_I16 && n == 3 ? 4 : n);
    if (format == LMB_DRAW_F32 || format == LMB_DRAW_F32X4) {
        memcpy(out, (const float *)data + at, (size_t)n * sizeof *out);
        return;
    }
    for (int k = 0; k < n; ++k) {
        out[k] = format == LMB_DRAW_I16 ? (float)((const int16_t *)data)[at + (size_t)k]
                                        : (float)((const int32_t *)data)[at + (size_t)k] * (1.0f / 65536.0f);
    }
}

lmb_vec3 lmb_draw_position_w(float *w, const lmb_draw_vertices *v, uint32_t i)
{
    const int has_w = DRAW_FULL && v->position_format == LMB_DRAW_F32X4;
    float at[4];
    lmb_draw_fetch(at, v->positions, i, has_w ? 4 : 3, v->position_format);
    *w = has_w ? at[3] : 1.0f;
    if (v->position_format == LMB_DRAW_I16) {
        return vec3(v->position_scale.x * at[0] + v->position_offset.x,
                    v->position_scale.y * at[1] + v->position_offset.y,
                    v->position_scale.z * at[2] + v->position_offset.z);
    }
    return vec3(at[0], at[1], at[2]);
}

lmb_vec3 lmb_draw_position(const lmb_draw_vertices *v, uint32_t i)
{
    float w;
    const lmb_vec3 p = lmb_draw_position_w(&w, v, i);
    return w != 1.0f && w != 0.0f ? mul3(p, 1.0f / w) : p;
}

static size_t vertex_value_bytes(int format) { return format == LMB_DRAW_I16 ? 2 : 4; }

static int vertex_is_aligned(const void *p, size_t bytes) { return (uintptr_t)p % bytes == 0; }

lmb_status lmb_draw_check_vertices(const lmb_draw_vertices *v)
{
    int aligned = vertex_is_aligned(v->fogs, sizeof *v->fogs);
    if (v->position_format > (DRAW_FULL ? LMB_DRAW_F32X4 : LMB_DRAW_FIXED) || v->uv_format > LMB_DRAW_FIXED) {
        return LMB_ERR_FORMAT;
    }
    if (!DRAW_FULL && (v->seconds != NULL || v->back_colours != NULL || v->back_seconds != NULL || v->fogs != NULL)) {
        return LMB_ERR_ARG;
    }
    if ((v->positions == NULL && v->count > 0) || v->count > UINT32_MAX - 4) {
        return LMB_ERR_ARG;
    }
    if ((v->position_format == LMB_DRAW_I16 && !(is_place(v->position_scale) && is_place(v->position_offset))) ||
        (v->uv_format == LMB_DRAW_I16 && !is_sane(v->uv_scale))) {
        return LMB_ERR_ARG;
    }
    for (int k = 0; k < LMB_DRAW_STAGES; ++k) {
        aligned &= vertex_is_aligned(v->uvs[k], vertex_value_bytes(v->uv_format));
    }
    return aligned && vertex_is_aligned(v->positions, vertex_value_bytes(v->position_format)) ? LMB_OK : LMB_ERR_ALIGN;
}
#endif
