/* live_block.c: whether a block of a shadow map shows one triangle, one plane, or more. Layer 5.             [ours] */
#include "live_part.h"

#if LMB_LIVE

#define FLAT_SHARE 0.125f /* of a block's side: surfaces closer than that to a plane are in it */

/* Part 0 of a block, and the distances of texels and of rows of texels from one part to the next one. */
static const uint8_t *first_part(ptrdiff_t step[2], const lmb_surface *s, int32_t x, int32_t y, int32_t each)
{
    const ptrdiff_t bytes = s->format == LMB_ID16 ? 2 : 4;
    const int tiled = s->layout == LMB_TILED;
    x += each / 8;
    y += each / 8;
    step[0] = each / 4 * bytes;
    step[1] = each / 4 * (tiled ? LMB_TILE * bytes : s->stride_bytes);
    return (const uint8_t *)s->data +
           (tiled ? (ptrdiff_t)(y / LMB_TILE) * s->stride_bytes +
                        (x / LMB_TILE * LMB_TILE_PIXELS + y % LMB_TILE * LMB_TILE + x % LMB_TILE) * bytes
                  : (ptrdiff_t)y * s->stride_bytes + x * bytes);
}

/* 1 if rows of four texels from `from` on have one id, which is read fast: most blocks do. */
static int rows_agree(const uint8_t *from, ptrdiff_t down, uint32_t id, int is_16)
{
    const uint64_t all = (uint64_t)id * (is_16 ? UINT64_C(0x0001000100010001) : UINT64_C(0x0000000100000001));
    uint64_t differ = 0;
    for (int i = 0; i < 4; ++i, from += down) {
        uint64_t left, right;
        memcpy(&left, from, sizeof left);
        memcpy(&right, is_16 ? from : from + sizeof left, sizeof right);
        differ |= (left ^ all) | (right ^ all);
    }
    return differ == 0;
}

void lmb_live_block_of(lmb_live_block *out, const lmb_live_face *face, int32_t column, int32_t row)
{
    const int32_t each = face->each;
    ptrdiff_t step[2];
    const uint8_t *from = first_part(step, &face->id, column * each, row * each, each);
    const int is_16 = face->id.format == LMB_ID16;
    uint32_t differ = 0;
    out->id[0] = is_16 ? *(const uint16_t *)(const void *)from : *(const uint32_t *)(const void *)from;
    out->is_one = each == 4 && rows_agree(from, step[1], out->id[0], is_16);
    if (out->is_one) {
        return;
    }
    out->x = column * each + each / 8;
    out->y = row * each + each / 8;
    out->step = each / 4;
    out->shown = 0;
    for (int i = 0; i < LMB_LIVE_NODES; ++i) {
        const void *at = from + i / 4 * step[1] + i % 4 * step[0];
        out->id[i] = is_16 ? *(const uint16_t *)at : *(const uint32_t *)at;
        differ |= out->id[i] ^ out->id[0];
        out->shown |= (uint32_t)(out->id[i] != 0) << i;
    }
    out->is_one = differ == 0;
}

int lmb_live_square_is_one(uint32_t *id, const lmb_live_face *face, int32_t column, int32_t row)
{
    const int32_t x = column * face->each, y = row * face->each, side = LMB_TILE * face->each;
    const int is_16 = face->id.format == LMB_ID16;
    const size_t bytes = (size_t)(side * LMB_TILE) * (is_16 ? sizeof(uint16_t) : sizeof(uint32_t));
    uint64_t differ = 0;
    if (face->id.layout != LMB_TILED || face->each != 4 || x + side > face->size || y + side > face->size) {
        return 0;
    }
    *id = live_id(&face->id, x, y);
    const uint64_t all = (uint64_t)*id * (is_16 ? UINT64_C(0x0001000100010001) : UINT64_C(0x0000000100000001));
    for (int32_t down = 0; down < side && differ == 0; down += LMB_TILE) {
        const ptrdiff_t tiles = (ptrdiff_t)((y + down) / LMB_TILE) * face->id.stride_bytes;
        const uint8_t *from = (const uint8_t *)face->id.data + tiles + (size_t)x * (bytes / (size_t)side);
        for (size_t i = 0; i < bytes; i += sizeof differ) {
            uint64_t some;
            memcpy(&some, from + i, sizeof some);
            differ |= some ^ all;
        }
    }
    return differ == 0;
}

uint32_t lmb_live_block_on(const lmb_live_block *b, const lmb_live_face *face, const lmb_surface *depth,
                           const lmb_live_facet *p)
{
    const lmb_view *v = &face->view;
    const int is_cone = v->kind == LMB_PERSPECTIVE;
    const float right = dot3(p->normal, v->right), up = dot3(p->normal, v->up), back = dot3(p->normal, v->back),
                to = dot3(p->normal, sub3(p->corner, v->eye));
    const float wide = FLAT_SHARE * 2.0f * v->half_width * (float)face->each / (float)face->size;
    ptrdiff_t step[2];
    const uint8_t *from = first_part(step, depth, b->x - face->each / 8, b->y - face->each / 8, face->each);
    uint32_t on = 0;
    for (int i = 0; i < LMB_LIVE_NODES; ++i) {
        const float d = *(const float *)(const void *)(from + i / 4 * step[1] + i % 4 * step[0]);
        const float across = right * texel_sx(v, face->size, b->x + i % 4 * b->step) +
                             up * texel_sy(v, face->size, b->y + i / 4 * b->step);
        const float here = lmb_depth_view_z(v, d), plane = is_cone ? to / (across - back) : (across - to) / back;
        on |= (uint32_t)(b->id[i] == p->id || absf(plane - here) <= (is_cone ? wide * here : wide)) << i;
    }
    return on & b->shown;
}

#endif
