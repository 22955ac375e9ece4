/* glb_parts.h: declarations that the files of the GLB writer share. */
#ifndef GLB_PARTS_H
#define GLB_PARTS_H

#include "../common/byte_buffer.h"
#include "../common/io_json.h"
#include "../common/text_buffer.h"
#include "glb_write.h"

typedef struct glb_writer {
    text_buffer json, views, accessors;
    byte_buffer bytes;
    uint32_t view_count, accessor_count;
    const lmb_scene *scene;
    const model *loaded;
    const glb_mesh *mesh;
    uint32_t mesh_count;
    const glb_light *light;
    uint32_t uv_sets; /* texture coordinate sets before the set of the lightmap */
    report *r;
} glb_writer;

/* glb_end_view: makes a buffer view of the bytes put since `from` and returns its index. target 0: no target. */
uint32_t glb_end_view(glb_writer *w, size_t from, int target);

/* Write parts of the JSON without the enclosing brackets. `is_first`: no comma before it. */
void glb_put_name(text_buffer *p, const char *name); /* "name":"...", or nothing if empty */
void glb_put_primitive(glb_writer *w, const glb_mesh *m); /* {"attributes":... and no closing brace */
void glb_put_material(text_buffer *p, const lmb_material *m, const char *name, const char *light_slot, int is_first);
void glb_put_lights(text_buffer *p, const lmb_scene *scene); /* the KHR_lights_punctual extension */
void glb_put_light_nodes(text_buffer *p, const lmb_scene *scene);
void glb_put_version(text_buffer *p);                       /* version and generator of the asset */
void glb_put_extras(glb_writer *w);                         /* "lambent":{...} in the extras of the asset */
#define GLB_LIGHT_SAMPLER "{\"wrapS\":33071,\"wrapT\":33071,\"magFilter\":9729,\"minFilter\":9729}"

/* glb_light_slot: the members of a texture info that shows the lightmap. */
enum { GLB_SLOT = 96 };
void glb_light_slot(char out[GLB_SLOT], const glb_writer *w, uint32_t texture);

/* glb_copy: writes the JSON of the file from loaded->source. Returns 1, or 0 with w->r set. */
int glb_copy(glb_writer *w);

#endif
