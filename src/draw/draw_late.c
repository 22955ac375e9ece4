/* draw_late.c: colours, shares and 1 / w of a shape of draw_quick.c, once a pixel passes the tests. Layer 4. */
#include "draw_part.h"

#if LMB_DRAW

static void quick_values(lmb_draw_corner *out, const lmb_draw_pass *pass, uint32_t i, uint32_t flat)
{
    const lmb_draw_vertices *v = pass->vertices;
    const lmb_draw_state *s = pass->state;
    const uint32_t of = (s->flags & LMB_DRAW_FLAT) != 0 ? flat : i;
    const uint8_t *colour = v->colours != NULL ? v->colours + 4 * (size_t)of : s->colour;
    for (int k = 0; k < 4; ++k) {
        out->v[CORNER_RED + k] = (float)colour[k];
    }
    for (int k = 0; k < LMB_DRAW_STAGES; ++k) {
        float *uv = &out->v[CORNER_UV + 2 * k];
        if (s->stage[k].texture != NULL) { /* otherwise not read */
            const float *from = v->uvs[k] != NULL ? (const float *)v->uvs[k] + 2 * (size_t)i : NULL;
            uv[0] = from != NULL ? from[0] : 0.0f;
            uv[1] = from != NULL ? from[1] : 0.0f;
        }
    }
    if (s->fog != LMB_DRAW_FOG_NONE) {
        float p[4];
        quick_fetch(p, v, i);
        out->v[CORNER_FOG] = quick_fog(pass, p, quick_row(s->to_clip.m + 3, p));
    }
}

/* The value of the edge from a to b, over twice the area: 0 on the edge, 1 at the opposite corner. */
static lmb_draw_plane quick_edge(const lmb_screen_vertex *a, const lmb_screen_vertex *b, double by_area)
{
    const int32_t ex = a->y_24_8 - b->y_24_8, ey = b->x_24_8 - a->x_24_8;
    lmb_draw_plane p;
    p.origin = (double)(-(int64_t)ex * a->x_24_8 - (int64_t)ey * a->y_24_8) * by_area;
    p.x = ex * 256.0 * by_area;
    p.y = ey * 256.0 * by_area;
    return p;
}

void lmb_draw_finish(const lmb_draw_pass *pass, lmb_draw_shape *s)
{
    lmb_draw_late *late = s->late;
    const float *inverse = late->inverse;
    for (int i = 0; i < 3; ++i) {
        quick_values(&late->corner[i], pass, late->vertex[i], late->flat);
    }
    s->late = NULL;
    s->n1 = quick_edge(&late->at[2], &late->at[0], late->by_area);
    s->n2 = quick_edge(&late->at[0], &late->at[1], late->by_area);
    s->is_even = inverse[0] == inverse[1] && inverse[0] == inverse[2];
    if (!s->is_even) {
        const double more1 = (double)inverse[1] - (double)inverse[0], more2 = (double)inverse[2] - (double)inverse[0];
        s->q.origin = (double)inverse[0] + (s->n1.origin * more1 + s->n2.origin * more2);
        s->q.x = s->n1.x * more1 + s->n2.x * more2;
        s->q.y = s->n1.y * more1 + s->n2.y * more2;
        draw_scale_plane(&s->n1, (double)inverse[1]);
        draw_scale_plane(&s->n2, (double)inverse[2]);
    }
}

#endif
