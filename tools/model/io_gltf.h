/* io_gltf.h: shared by the files of the glTF reader: document, bytes, accessors, nodes, materials. */
#ifndef IO_GLTF_H
#define IO_GLTF_H

#include "../common/io_json.h"
#include "model_build.h"
#include "model_morph.h"
#include "model_motion.h"

/* JSON nodes of a top-level array, for lookups by index. */
typedef struct gltf_list {
    uint32_t *items;
    uint32_t count;
} gltf_list;

typedef struct gltf_bytes {
    const uint8_t *data;
    size_t size;
    int ready; /* data and size are set */
} gltf_bytes;

/* How a material's images pick texture coordinates; the transform is folded into them at load. */
typedef struct gltf_uv {
    uint32_t set; /* n of TEXCOORD_n; JSON_NONE: untextured */
    int moved;    /* m is not the identity */
    double m[6];  /* u' = m0 u + m1 v + m2, v' = m3 u + m4 v + m5 */
} gltf_uv;

/* A primitive's joints and weights: four each a vertex and set. */
typedef struct gltf_influences {
    float **joints, **weights; /* by set; NULL: not read yet */
    uint32_t sets;
} gltf_influences;

/* Means over the texels of an image: channels as numbers, and as linear light. */
typedef struct gltf_mean {
    int known;
    double green, blue, alpha, light[3]; /* 0 .. 1 */
} gltf_mean;

/* Counts of ignored or replaced features, for the notes at the end. */
typedef struct gltf_counts {
    uint32_t points_lines, without_positions, ragged, bare;       /* primitives, vertices */
    uint32_t textures, blends, metals, metal_maps, gloss_maps, unlit, emissive_maps; /* materials */
    uint32_t occlusion_maps, odd_normal_maps, without_uvs;                         /* materials, primitives */
    uint32_t skins, odd_morphs, no_roots;                                       /* nodes, primitives, nodes */
} gltf_counts;

/* EXT_mesh_gpu_instancing of a node: a range of places; count 0: the node has none. */
typedef struct gltf_crowd {
    uint32_t first, count;
} gltf_crowd;

typedef struct gltf {
    model_build *b;
    json doc;
    gltf_bytes chunk; /* the BIN chunk of a GLB */
    gltf_list accessors, views, buffers, images, samplers, textures, materials, meshes, nodes, cameras, skins, lights;
    gltf_bytes *buffer_bytes; /* by buffer */
    /* by accessor: streams already made, so that primitives share them */
    const void **positions, **uvs;
    int16_t **normals;
    const int16_t **tangents;
    const uint8_t **colours;
    uint8_t *colour_formats;
    uint32_t *uv_owner;               /* material that uvs[accessor] was made for */
    gltf_uv *material_uv;             /* by material */
    int32_t *slots[2];                /* by texture, as colour or normal map: index in b->textures, or SLOT_ */
    lmb_texture *image_texels[2];     /* by image, as colour or normal map: decoded images; texels NULL: not yet */
    uint32_t *image_content;          /* by image: equal for equal bytes, once it is decoded */
    gltf_mean *image_means;           /* by image_content */
    uint32_t *mesh_first, *mesh_size; /* by mesh: range in b->meshes; mesh_first JSON_NONE: not made yet */
    uint32_t *mesh_material, *mesh_primitive; /* by lambent mesh: index; JSON node */
    lmb_mesh *mesh_rest;                      /* by lambent mesh: with all morph weights 0 */
    gltf_influences *mesh_influences;         /* by lambent mesh, if it is posed several times */
    uint32_t default_material;        /* for primitives without one; JSON_NONE until needed */
    uint32_t *instance_from;          /* by instance: index of the node in the document */
    gltf_uv *light_uv;                /* by material, for baked light; NULL: the file has no baked light */
    uint32_t *instance_node, *light_node, *camera_node; /* for the model: index in the tree's order, or MODEL_NONE */
    uint32_t *instance_shown;         /* by instance: index in the tree of the node with this mesh, skinned or not */
    gltf_crowd *crowd;                /* by index in the tree */
    model_local *place;               /* transforms relative to the node that has them */
    uint32_t *place_owner, places;    /* by place: index of that node in the tree; places in all */
    gltf_counts left_out;
    report texture_error; /* the first one */
} gltf;

/* Column-major like in glTF; composed in double, so that deep trees lose no precision before binary32. */
typedef struct gltf_matrix {
    double m[16];
} gltf_matrix;

/* The part of the document that is drawn: nodes in drawing order with world transforms. */
typedef struct gltf_tree {
    uint32_t *order; /* parents before children */
    uint32_t count;
    uint32_t *parent;   /* by node; JSON_NONE: a root */
    gltf_matrix *world; /* by node; of those in `order` */
    gltf_matrix *turn;  /* by node: the same without scale, for directions if the scale is 0 */
    uint8_t *hidden;    /* by node: meshes and lights are not drawn */
    uint8_t *placed;    /* by node: 1 if in `order` */
} gltf_tree;

/* An accessor with all bytes checked to exist. */
typedef struct gltf_accessor {
    uint32_t node;       /* JSON, for messages */
    const uint8_t *data; /* element 0; NULL: zeros */
    uint32_t count, stride;
    uint32_t component;  /* GL type, 5120 .. 5126 */
    uint32_t components; /* 1 .. 4 */
    int normalized;
    uint32_t sparse_count, sparse_component, sparse_node;
    const uint8_t *sparse_indices, *sparse_values;
} gltf_accessor;

enum { GLTF_I8 = 5120, GLTF_U8 = 5121, GLTF_I16 = 5122, GLTF_U16 = 5123, GLTF_U32 = 5125, GLTF_F32 = 5126 };

#define GLTF_UNDO_DRACO "decompress it: gltf-transform cp IN.glb OUT.glb"

/* io_gltf_data.c */
int gltf_container(gltf *g, const uint8_t *data, size_t size); /* GLB or plain: parses the JSON */
int gltf_lists(gltf *g);                                       /* all lists, except lights */
int gltf_list_of(gltf_list *out, gltf *g, uint32_t array);     /* of any array; JSON_NONE: empty */
int gltf_item(uint32_t *out, const gltf *g, const gltf_list *list, uint32_t reference);  /* node an index points to */
int gltf_index(uint32_t *out, const gltf *g, const gltf_list *list, uint32_t reference); /* the index, checked */
int gltf_uri(gltf_bytes *out, gltf *g, uint32_t uri, report *r); /* bytes that stay until loading ends */
int gltf_view(gltf_bytes *out, gltf *g, uint32_t view); /* bytes of a bufferView, by JSON node */
int gltf_accessor_open(gltf_accessor *out, gltf *g, uint32_t accessor);
int gltf_accessor_floats(float *out, const gltf *g, const gltf_accessor *a); /* count * components values */
int gltf_accessor_indices(uint32_t *out, const gltf *g, const gltf_accessor *a);

/* io_gltf_tree.c */
int gltf_make_tree(gltf_tree *t, gltf *g);
int gltf_local(model_local *out, gltf *g, uint32_t node);
void gltf_multiply(gltf_matrix *out, const gltf_matrix *a, const gltf_matrix *b);

/* All instances of a node at one place. */
typedef struct gltf_placing {
    uint32_t mesh, first;     /* index in g->meshes; the first of the meshes in the model */
    uint32_t order, mover;    /* index in the tree; node of the motion, or MODEL_NONE */
    const gltf_matrix *world; /* of the node */
} gltf_placing;

/* io_gltf_tree.c: adds an instance for each primitive. */
void gltf_add_instances(gltf *g, const gltf_tree *t, const gltf_placing *p);

#ifdef GLTF_WITHOUT_CROWDS
enum { GLTF_HAS_CROWDS = 0 }; /* for the page on the web, which has to be small */
#else
enum { GLTF_HAS_CROWDS = 1 };
#endif

/* io_gltf_crowd.c */
/* gltf_crowds: reads all places of the tree's nodes. gltf_add_crowd: adds the instances of a node at each place.
 * gltf_crowd_motion: in the model's motion, place p is node (nodes of the tree) + p. */
int gltf_crowds(const gltf_tree *t, gltf *g);
int gltf_crowd_use(const gltf *g, uint32_t name); /* MODEL_EXTENSION_ support for this extension */
int gltf_add_crowd(gltf *g, const gltf_tree *t, const gltf_placing *node);
void gltf_crowd_motion(uint32_t *parent, model_local *rest, uint8_t *moves, const gltf_tree *t, const gltf *g);

/* io_gltf_place.c: for the nodes of the tree */
int gltf_lights(const gltf_tree *t, gltf *g);
int gltf_cameras(const gltf_tree *t, gltf *g);

/* io_gltf_motion.c: call it after all animated items; sets the model's motion, or motion_problem */
void gltf_motion(const gltf_tree *t, gltf *g);

/* io_gltf_shape.c: makes shapes of nodes with moving joints or with a track of morph weights; `place`: of each document
 * node in the tree's order. gltf_targets: returns the number of morph targets of the mesh of a JSON node. */
int gltf_shapes(struct model_motion *inout, const gltf_tree *t, gltf *g, const uint32_t *place,
                const model_track *weight_track, uint32_t weight_tracks);
uint32_t gltf_targets(const gltf *g, uint32_t node);

/* io_gltf_material.c */
int gltf_materials(gltf *g);         /* all of them, their textures, material_uv */
void gltf_default_material(gltf *g); /* makes default_material, once */

/* Reads the bytes of images[index], usually a PNG or a JPEG, and a name for messages. On failure returns 0 with
 * `why` set, or with the report set if the model is damaged. */
enum { GLTF_PLACE = 96 };
int gltf_image_bytes(gltf_bytes *out, char place[GLTF_PLACE], gltf *g, uint32_t index, report *why);

int gltf_read_uv(gltf_uv *out, gltf *g, uint32_t info); /* the set and transform of a texture info */

int gltf_texture(int32_t *out, gltf *g, uint32_t texture); /* index in b->textures, as a colour; -1: not available */

/* io_gltf_mesh.c */
int gltf_mesh(gltf *g, uint32_t mesh); /* fills mesh_first and mesh_size; once per mesh */
/* Opens the accessor of an attribute and returns its index. Requires `components` or `other` components and `count`
 * elements (0: any). If absent, *index is JSON_NONE. */
int gltf_attribute(gltf_accessor *a, uint32_t *index, gltf *g, uint32_t reference, uint32_t components, uint32_t other,
                   uint32_t count);
float *gltf_floats(gltf *g, const gltf_accessor *a); /* all values in scratch memory; NULL with the report set */

/* io_gltf_light.c: files from `lambent bake --to` */
int gltf_light_begin(gltf *g, uint32_t meshes);            /* call before the meshes: looks for baked light */
int gltf_light_end(gltf *g);                               /* reads the lightmap */
int gltf_light_is_slot(const gltf *g, uint32_t info);      /* 1: the texture info shows the lightmap, or did */

/* io_gltf_source.c: call it after the instances; sets the model's source */
int gltf_source(gltf *g);

/* io_gltf_skin.c */
/* Skins the copies of the mesh made for this node, starting at b->meshes[first]. Positions are then in world metres. */
int gltf_pose(gltf *g, const gltf_tree *t, uint32_t node, uint32_t mesh, uint32_t first);

/* io_gltf_morph.c */
/* Applies morph weights to a primitive that was read with all weights 0. `mesh` and `node` are JSON nodes; if `node` is
 * JSON_NONE, the weights of the mesh are used. */
int gltf_morph(lmb_mesh *inout, gltf *g, uint32_t mesh, uint32_t primitive, uint32_t node);
/* Reads the morph targets of a primitive into scratch memory, for model_morph_pose. If `weights` is not NULL, only
 * targets with a nonzero weight are read. */
int gltf_morph_read(model_morph *out, gltf *g, uint32_t primitive, const lmb_mesh *mesh, const double *weights);

#endif
