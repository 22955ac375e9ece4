/* model_build.h: shared by the model readers: memory with a budget, notes, files beside the model, textures, the
 * end. */
#ifndef MODEL_BUILD_H
#define MODEL_BUILD_H

#include "../picture/image.h"
#include "model.h"

#define MODEL_BYTES_PER_BYTE 96                  /* memory a reader may use per byte of input ... */
#define MODEL_BYTES_FREE     (16u << 20)         /* ... in addition to this */
#define MODEL_PIXELS_PER_BYTE 64                 /* of all images, for each decoding, per byte of the images ... */
#define MODEL_FREE_PIXELS    (UINT64_C(1) << 24) /* ... in addition to this, ... */
#define MODEL_LARGE_PICTURE  (UINT64_C(1) << 26) /* ... and one larger image; at most 8 bytes of memory per pixel */
#define MODEL_TRIANGLES_PER_BYTE 64              /* of all instances per byte of files; of all meshes with their ... */
#define MODEL_FREE_TRIANGLES (UINT64_C(1) << 26) /* ... vertices, as they may share them; in addition to this, ... */
#define MODEL_FREE_CORNERS   (UINT64_C(1) << 24) /* ... and this */
#define MODEL_PATH_MAX       4096                /* bytes of a composed path */

/* A file beside the model; the path has no doubled slashes or /./. */
typedef struct build_neighbour {
    char *path;
    file_bytes file;
} build_neighbour;

/* The bytes of an image, which may have several names, and the texels decoded from them, by TEXELS_. */
typedef struct build_content {
    const uint8_t *data;
    size_t size;
    uint64_t hash;
    lmb_texture texels[3]; /* texels NULL: not yet */
} build_content;

/* A scene in construction; the arrays are blocks of `out`. */
typedef struct model_build {
    model *out;
    model scratch; /* blocks that are freed when loading ends */
    model_notes *notes;
    report *r;
    const char *path;      /* file of the model, as given by the user */
    const char *scene;     /* name or number of the scene to load; NULL: the default of the file */
    int linear_colours;    /* vertex colours of OBJ and PLY are linear light, not sRGB codes */
    uint16_t linear_of[256]; /* by sRGB code: a code of build_linear */
    int keeps_source;      /* out->source must be filled */
    uint64_t budget;       /* bytes that may still be allocated */
    uint64_t pixel_budget; /* pixels that may still be decoded */
    uint64_t large_picture; /* pixels that one image may have in addition; 0: used up */
    build_content *contents; /* images; found by hash through content_slots, a power of two, 0: free */
    uint32_t *content_slots;
    uint32_t content_count, content_slot_count;
    build_neighbour *neighbours; /* files read beside the model, each once */
    uint32_t neighbour_count, neighbour_cap;
    uint32_t marked_normals; /* normals marked by build_normal_code */
    lmb_mesh *meshes;
    lmb_material *materials;
    lmb_texture *textures;
    lmb_instance *instances;
    lmb_light *lights;
    uint32_t mesh_count, material_count, texture_count, instance_count, light_count;
} model_build;

/* build_keep: returns count * size zeroed bytes that live as long as the model; build_scratch: until loading ends.
 * Both return NULL with the report set if memory or the budget is short; otherwise never NULL, also for count 0. */
void *build_keep(model_build *b, uint64_t count, size_t size);
void *build_scratch(model_build *b, uint64_t count, size_t size);

/* build_materials: allocates `count` materials in b->materials. */
int build_materials(model_build *b, uint64_t count);

/* build_note: adds a line for the user. Equal lines appear once; the sixteenth reports that there were more. */
void build_note(model_build *b, const char *format, ...) REPORT_PRINTF(2, 3);

/* build_note_count: adds "WHAT: COUNT" if the count is not 0. */
void build_note_count(model_build *b, const char *what, uint32_t count);

/* The same for a note of a kind, MODEL_NOTE_. */
void build_note_of(model_build *b, int kind, const char *format, ...) REPORT_PRINTF(3, 4);
void build_note_count_of(model_build *b, int kind, const char *what, uint32_t count);

/* Converts numbers of files to binary32. build_float: an infinity beyond the range, which the library drops; a plain
 * cast would be undefined. build_uv: 0 if the number is useless as a texture coordinate. build_normal: unit length;
 * if there is no direction, +Y, and increments *zeros. */
float build_float(double v);
float build_uv(double v);
lmb_vec3 build_normal(const double v[3], uint32_t *zeros);

/* build_normal_code: returns the same as an octahedral code. A normal without direction is marked for mend_normals,
 * which runs at the end. */
#define BUILD_NO_NORMAL INT16_MIN /* no code has it */
void build_normal_code(model_build *b, int16_t out[2], const double v[3]);

/* build_colour: converts a colour channel of OBJ or PLY, scaled to 0 .. 1, to a code of LMB_COLOUR_RGBA16. It rounds
 * once, at the end. build_linear: the same for a linear channel. build_share: the same for alpha. NaN and negative
 * values become 0. */
uint16_t build_colour(const model_build *b, double code);
uint16_t build_linear(double v);
uint16_t build_share(double v);

/* build_narrow: the LMB_COLOUR_ format of n vertices in LMB_COLOUR_RGBA16 at `codes`, which become bytes in place if
 * all of them are exactly bytes. */
uint8_t build_narrow(uint16_t *codes, size_t n);

/* build_read: reads a file beside the model. It must be a regular file, because a model may name a device that never
 * ends. Each file is read once and raises the budgets once; the bytes stay until loading ends. */
int build_read(model_build *b, file_bytes *out, const char *path, report *r);

/* build_forget: frees the files that build_read keeps. */
void build_forget(model_build *b);

/* build_is_relative: whether a path is relative to the model's folder: no scheme, no drive, no root. */
int build_is_relative(const char *name);

/* build_sibling: makes a path from `name`, relative to the model's file; returns 0 with `r` set if it is longer than
 * `cap`. */
int build_sibling(char *out, size_t cap, const model_build *b, const char *name, report *r);

/* build_picture: decodes an image of codes (PNG, JPEG, PPM, PGM), recognized by content. Free it with bitmap_free. */
int build_picture(model_build *b, bitmap *out, const uint8_t *data, size_t size, const char *name, report *why);

/* Filtering of an image's mip levels; TEXELS_PLAIN has none. */
enum { TEXELS_PLAIN = 0, TEXELS_COLOUR, TEXELS_NORMALS };

/* build_texels: decodes an image into out->texels, width, height and the mip levels for `kind`. Equal bytes are
 * decoded once; they stay until loading ends. `name` is used in messages. *content: an index from 0, the same for
 * equal bytes; may be NULL. Returns 0 with `why` set, after which loading may continue. */
int build_texels(model_build *b, lmb_texture *out, const uint8_t *data, size_t size, int kind, const char *name,
                 uint32_t *content, report *why);

/* The readers fill the arrays of `b`; first_id and bounds are set afterwards. Return 1, or 0 with b->r set. */
int gltf_load(model_build *b, const uint8_t *data, size_t size);
int obj_load(model_build *b, const uint8_t *data, size_t size);

#endif
