/* model_build.h: what the model readers share: memory with a budget, notes, neighbouring files, textures, the end. */
#ifndef MODEL_BUILD_H
#define MODEL_BUILD_H

#include "../picture/image.h"
#include "model.h"

#define MODEL_BYTES_PER_BYTE 96                  /* memory a reader may take for each byte of input ... */
#define MODEL_BYTES_FREE     (16u << 20)         /* ... beside these */
#define MODEL_PIXELS_PER_BYTE 64                 /* of all pictures as often as they are decoded, their bytes counted ... */
#define MODEL_FREE_PIXELS    (UINT64_C(1) << 24) /* ... beside these, ... */
#define MODEL_LARGE_PICTURE  (UINT64_C(1) << 26) /* ... and one that has more; 8 bytes of memory a pixel at most */
#define MODEL_TRIANGLES_PER_BYTE 64              /* of all instances for each byte of the files; of all meshes, their ... */
#define MODEL_FREE_TRIANGLES (UINT64_C(1) << 26) /* ... vertices counted, as they may share them; beside these, ... */
#define MODEL_FREE_CORNERS   (UINT64_C(1) << 24) /* ... and these */
#define MODEL_PATH_MAX       4096                /* bytes of a path that a reader composes */

/* A file beside the model, by its path without doubled slashes and /./. */
typedef struct build_neighbour {
    char *path;
    file_bytes file;
} build_neighbour;

/* A picture's bytes, which may be shown under any number of names, and what was decoded of them by TEXELS_. */
typedef struct build_content {
    const uint8_t *data;
    size_t size;
    uint64_t hash;
    lmb_texture texels[3]; /* texels NULL: nothing yet */
} build_content;

/* A scene under construction; the arrays are blocks of `out`. */
typedef struct model_build {
    model *out;
    model scratch; /* blocks that go when loading ends */
    model_notes *notes;
    report *r;
    const char *path;      /* the model's file, as the user named it */
    const char *scene;     /* wanted of several, by name or number; NULL: the file chooses */
    int linear_colours;    /* vertex colours of OBJ and PLY are linear light, not sRGB codes */
    uint8_t linear_of[256]; /* by sRGB code */
    int keeps_source;      /* out->source must be filled */
    uint64_t budget;       /* bytes that may still be allocated */
    uint64_t pixel_budget; /* pixels that may still be decoded */
    uint64_t large_picture; /* pixels that one picture may have beyond that; 0: one had */
    build_content *contents; /* pictures; found by their hashes through content_slots, a power of two, 0: free */
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

/* build_keep: count * size zeroed bytes that live as long as the model; build_scratch: until loading ends.
 * NULL with the report set where memory or the budget is short; never NULL otherwise, count 0 included. */
void *build_keep(model_build *b, uint64_t count, size_t size);
void *build_scratch(model_build *b, uint64_t count, size_t size);

/* build_materials: room for `count` materials in b->materials. */
int build_materials(model_build *b, uint64_t count);

/* build_note: a line for the user; equal lines appear once, the sixteenth says that there were more. */
void build_note(model_build *b, const char *format, ...) REPORT_PRINTF(2, 3);

/* build_note_count: "WHAT: COUNT", where that is not 0. */
void build_note_count(model_build *b, const char *what, uint32_t count);

/* Numbers as files have them, for binary32: build_float: beyond its range an infinity, which the library drops, for the
 * cast alone would not say so; build_uv: 0 for what is of no use as a texture coordinate; build_normal: unit length, +Y
 * and one more in *zeros for what has no direction. */
float build_float(double v);
float build_uv(double v);
lmb_vec3 build_normal(const double v[3], uint32_t *zeros);

/* build_normal_code: returns the same as an octahedral code. A normal without direction is marked for mend_normals,
 * which runs at the end. */
#define BUILD_NO_NORMAL INT16_MIN /* no code has it */
void build_normal_code(model_build *b, int16_t out[2], const double v[3]);

/* build_colour: converts a colour channel of OBJ or PLY, scaled to 0 .. 1, to the linear byte of the library. It rounds
 * once, at the end. build_share: the same without decoding, for alpha. NaN and negative values become 0. */
uint8_t build_colour(const model_build *b, double code);
uint8_t build_share(double v);

/* build_read: a whole file beside the model: a plain one, as what a model names may be a device that never ends. It is
 * read once, however often it is asked for, and raises the budgets once; the bytes stay until loading ends. */
int build_read(model_build *b, file_bytes *out, const char *path, report *r);

/* build_forget: the files that build_read keeps. */
void build_forget(model_build *b);

/* build_is_relative: is this a path from the model's folder: no scheme, no drive, no root? */
int build_is_relative(const char *name);

/* build_sibling: the path of `name`, relative to the model's file; 0 with `r` set where it is longer than `cap`. */
int build_sibling(char *out, size_t cap, const model_build *b, const char *name, report *r);

/* build_picture: decode a picture of codes (PNG, JPEG, PPM, PGM), known by its content; free it with bitmap_free. */
int build_picture(model_build *b, bitmap *out, const uint8_t *data, size_t size, const char *name, report *why);

/* What an image's lower levels are means of; TEXELS_PLAIN has none. */
enum { TEXELS_PLAIN = 0, TEXELS_COLOUR, TEXELS_NORMALS };

/* build_texels: decode a picture into out->texels, width, height and the levels of its `kind`; equal bytes are decoded
 * once. `name` for messages; the bytes stay until loading ends. *content: numbers equal bytes alike, from 0; may be
 * NULL. 0 with `why` set, which need not end the loading. */
int build_texels(model_build *b, lmb_texture *out, const uint8_t *data, size_t size, int kind, const char *name,
                 uint32_t *content, report *why);

/* The readers: fill the arrays of `b`; first_id and bounds are set afterwards. 1, or 0 with b->r set. */
int gltf_load(model_build *b, const uint8_t *data, size_t size);
int obj_load(model_build *b, const uint8_t *data, size_t size);

#endif
