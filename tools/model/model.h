/* model.h: a scene read from a file as the library needs it, and cameras and names, which the library does not use. */
#ifndef MODEL_H
#define MODEL_H

#include <lambent/lambent.h>

#include "../common/report.h"

typedef struct model_camera {
    char name[64];
    lmb_vec3 eye, right, up, back; /* world, orthonormal */
    int orthographic;
    float yfov_rad;                /* perspective */
    float half_width, half_height; /* orthographic: metres; perspective: tangents of packed scenes, else 0 */
    float aspect;                  /* width / height; 0: not given */
    float near_m, far_m;           /* far_m 0: not given */
} model_camera;

/* Support for a glTF extension. An unknown one that the file requires is an error instead. */
enum { MODEL_EXTENSION_IGNORED = 0, MODEL_EXTENSION_READ, MODEL_EXTENSION_FOLDED /* converted on load */ };

typedef struct model_extension {
    char name[64];
    int use; /* MODEL_EXTENSION_ */
    int required;
} model_extension;

/* Contents of the file, drawn or not. 0 also if the format has no such thing. */
typedef struct model_facts {
    const char *format;        /* "glTF", "GLB", "OBJ", "PLY", "LMP", a literal; NULL: unknown */
    uint32_t scenes, scene;    /* number; the one that was read, from 0 */
    char scene_name[64];
    uint32_t nodes, meshes, primitives;
    uint64_t vertices;         /* as stored (OBJ: v lines), of the meshes that were read */
    uint32_t materials;        /* without the default material */
    uint32_t textures, images;
    uint32_t lights, cameras;  /* in the file; scene and cameras have the placed ones */
    uint32_t animations, skins;
    model_extension extensions[32];
    uint32_t extension_count;  /* listed above */
    uint32_t extension_more;   /* not listed for lack of room */
    uint64_t file_bytes;       /* the model's file */
    uint64_t neighbour_bytes;  /* other files read for it; a file that is read twice counts twice */
    uint64_t memory_bytes;     /* of `blocks` */
    uint64_t loading_bytes;    /* while loading: `blocks`, working memory and the bytes of the files */
    uint64_t texel_bytes;      /* the share of textures, mips included */
} model_facts;

/* A material with a glossy lobe, for model_make_glossy. */
typedef struct model_lobe {
    float albedo[3], specular[3], roughness, metallic;
    uint32_t metal_map;
} model_lobe;

#define MODEL_LIGHT_NAME "lambent lightmap" /* of the image */

/* Baked light from a file that `lambent bake --to` wrote. */
typedef struct model_light {
    float scale;          /* W/m2 of a colour of 1; 0: no baked light */
    float **colour;       /* by mesh: COLOR_1, 3 per vertex, 0 .. 1; NULL: none */
    float **uv;           /* by mesh: lightmap coordinates, 2 per vertex; NULL: not in the lightmap */
    const lmb_texture *picture; /* by uv, sRGB-coded; NULL: none */
} model_light;

enum { MODEL_UV_SETS = 4 };

/* Parts of a glTF file that the scene does not have, for writing a file from it. */
typedef struct model_source {
    const char *json;            /* the document */
    size_t json_size;
    const uint8_t **image;       /* by image of the document: bytes of the image file; NULL: unreadable */
    size_t *image_size;
    uint32_t *node, *primitive;  /* by instance: index of the node; JSON node of the primitive */
    uint8_t *is_posed;           /* by instance: a skin has put the vertices into world space */
    uint32_t uv_sets;            /* TEXCOORD_ sets that materials use */
    float **uv[MODEL_UV_SETS];   /* by mesh: 2 per vertex, without texture transform; NULL: none */
    float **tangent;             /* by mesh: 4 per vertex; NULL: none */
} model_source;

/* Owns everything `scene` points to. model_free releases it; a zeroed model is empty. */
typedef struct model {
    lmb_scene scene; /* checked: lmb_scene_check(&scene) == LMB_OK */
    model_camera *cameras;
    uint32_t camera_count;
    model_lobe *lobes; /* by material; NULL: the format has none */
    model_light light;
    model_source *source;        /* set with model_choice.keeps_source if the format is glTF; else NULL */
    const char **material_names; /* by material, each may be NULL; NULL: no names, or they are in `source` */
    struct model_motion *motion; /* model_motion.h; NULL: nothing moves, or see `motion_problem` */
    report motion_problem;
    uint32_t idle_channels; /* animation channels that move nothing in the scene that was read */
    const lmb_pack *pack; /* a packed scene, in memory that the model owns; NULL: not packed */
    model_facts facts;
    void **blocks; /* every allocation, for model_free */
    uint32_t block_count, block_cap;
} model;

/* A line for the user that is not an error ("3 lines and points skipped"), printed by the caller after loading. */
typedef struct model_notes {
    char line[16][200];
    uint8_t kind[16]; /* MODEL_NOTE_ */
    uint32_t count;
} model_notes;

/* Kinds of notes: about an option that only `render` has, and with GLOSSY one that --glossy answers; about motion that
 * only `play` shows; others. */
enum { MODEL_NOTE_PLAIN = 0, MODEL_NOTE_OPTION = 1, MODEL_NOTE_MOTION = 2, MODEL_NOTE_GLOSSY = 4 };

/* Choices that the file leaves open. Zeros are the defaults. */
enum { MODEL_COLOURS_SRGB = 0, MODEL_COLOURS_LINEAR };
typedef struct model_choice {
    const char *scene;      /* name or index of the scene to load; NULL: the default scene of the file */
    int32_t vertex_colours; /* of OBJ and PLY: MODEL_COLOURS_; glTF specifies linear colours */
    int32_t keeps_source;   /* 1: fill out->source if the file is glTF */
} model_choice;

/* model_tell: prints the notes after the model's name, unless the program is quiet. It leaves out notes of the kinds in
 * `hides`, a sum of MODEL_NOTE_, and lines that it printed before. */
void model_tell(const model_notes *notes, const char *name, int hides);

/* model_load: loads .gltf, .glb, .obj, .ply or .lmp, by content and extension. `scene` is the name or number of the
 * scene to load; NULL: the default scene of the file. Returns 1, or 0 with `r` set and *out empty. */
int model_load(model *out, const char *path, const char *scene, model_notes *notes, report *r);


/* model_read: the same from memory. `path` is used in messages, to select the format if the content does not, and to
 * find files beside it. */
int model_read(model *out, const char *path, const char *scene, const uint8_t *data, size_t size, model_notes *notes,
               report *r);

/* The same with more choices, if you need them; NULL: the defaults. Only model_load_as refuses a model that shows
 * nothing (view_any). It accepts such a model if triangles of the model move. */
int model_load_as(model *out, const char *path, const model_choice *choice, model_notes *notes, report *r);
int model_read_as(model *out, const char *path, const model_choice *choice, const uint8_t *data, size_t size,
                  model_notes *notes, report *r);

/* model_make_glossy: gives the materials glossy lobes. Returns 0 if the format has none. */
int model_make_glossy(model *m);

void model_free(model *m);

#endif
