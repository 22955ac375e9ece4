/* io_ply.c: loads a PLY file into a scene: one pass counts, the next fills. */
#include <string.h>

#include "ear_clip.h"
#include "io_ply_read.h"

int ply_load(model_build *b, const uint8_t *data, size_t size)
{
    ply p;
    memset(&p, 0, sizeof p);
    p.b = b;
    p.begin = p.at = data;
    p.end = size ? data + size : data;
    p.line = 1;
    p.cut_steps = polygon_steps(size);
    if (!ply_walk(&p) || !ply_scene(&p))
        return 0;
    b->out->facts.format = "PLY";
    b->out->facts.vertices = p.vertex->count;
    return 1;
}
