/* io_gltf_attribute.c: an attribute of a mesh: its accessor, checked, and its numbers. */
#include "io_gltf.h"

int gltf_attribute(gltf_accessor *a, uint32_t *index, gltf *g, uint32_t reference, uint32_t components, uint32_t other,
                   uint32_t count)
{
    if (!gltf_index(index, g, &g->accessors, reference))
        return 0;
    if (*index == JSON_NONE)
        return 1;
    if (!gltf_accessor_open(a, g, g->accessors.items[*index]))
        return 0;
    if ((a->components != components && a->components != other) || a->component == GLTF_U32)
        return json_fail(&g->doc, reference, g->b->r, "accessor %u has a type that this attribute does not take",
                         (unsigned)*index);
    if (count && a->count != count)
        return json_fail(&g->doc, reference, g->b->r, "%u elements, but POSITION has %u; all must have as many",
                         (unsigned)a->count, (unsigned)count);
    return 1;
}

float *gltf_floats(gltf *g, const gltf_accessor *a)
{
    float *values = (float *)build_scratch(g->b, (uint64_t)a->count * a->components, sizeof *values);
    return values && gltf_accessor_floats(values, g, a) ? values : NULL;
}
