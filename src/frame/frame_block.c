/* frame_block.c: the parts of a frame's memory, one after another in one block. Layer 8. */
#include "../base/exact.h"
#include "solver.h"

#define PART_ALIGN_BYTES 64u /* bytes: parts start at multiples of this */

void *lmb_frame_take(frame_block *b, uint64_t bytes)
{
    void *part = b->memory != NULL ? b->memory + (size_t)b->used : NULL;
    b->used += (bytes + PART_ALIGN_BYTES - 1) / PART_ALIGN_BYTES * PART_ALIGN_BYTES;
    return part;
}

lmb_status lmb_frame_take_surface(lmb_surface *out, int32_t format, const lmb_view *v, int32_t height, frame_block *b)
{
    const size_t bytes = lmb_surface_bytes(format, v->frame_width, height);
    if (bytes == 0) {
        return LMB_ERR_FORMAT;
    }
    void *memory = lmb_frame_take(b, bytes);
    return is_only_measured(b) ? LMB_OK : lmb_surface_init(out, format, v->frame_width, height, memory, bytes);
}

uint32_t lmb_frame_map_faces(const lmb_scene *s)
{
    uint32_t faces = 0;
    for (uint32_t i = 0; i < s->light_count; ++i) {
        faces += (uint32_t)lmb_shadow_map_faces(&s->lights[i], s);
    }
    return faces;
}
