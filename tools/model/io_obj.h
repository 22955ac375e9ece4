/* io_obj.h: what the OBJ reader and its material reader share: materials by name. */
#ifndef IO_OBJ_H
#define IO_OBJ_H

#include "../common/io_text.h"
#include "model_build.h"

/* A map of colours and how it is laid: coordinates are scaled, then moved, as OBJ has them, v upwards. */
typedef struct obj_map {
    char *path; /* NULL: no map */
    double scale[2], offset[2];
    uint8_t wrap;
} obj_map;

/* What a material asks for and does not get. */
enum {
    OBJ_LEFT_OPACITY = 1,
    OBJ_LEFT_OPACITY_MAP = 2,
    OBJ_LEFT_EMISSION_MAP = 4,
    OBJ_LEFT_BUMP = 8,
    OBJ_LEFT_OPTION = 16,
    OBJ_LEFT_MIRROR = 32,
    OBJ_LEFT_SPECTRUM = 64
};

/* One name that usemtl gave; [0] stands for faces before any. */
typedef struct obj_material {
    slice name;
    obj_map map;
    uint8_t defined; /* an MTL file describes it */
    uint8_t has_kd;
    uint8_t left_out; /* OBJ_LEFT_ ... */
} obj_material;

/* Names with an open-addressed index; slots hold number + 1. The keys are hashes of the files that the names and the
 * maps' paths come from, so that no file can choose names that all go to one slot. */
typedef struct obj_names {
    obj_material *items;
    uint32_t *slots;
    uint32_t count, mask;
    uint64_t key, map_key;
} obj_names;

/* io_mtl.c: a hash that nobody aims who does not know the key; its order of bytes is the machine's. */
uint64_t obj_hash(uint64_t key, const void *data, size_t size);
uint32_t obj_find(const obj_names *names, slice name, uint32_t *slot); /* UINT32_MAX: absent, *slot is where it goes */

/* A library's bytes and path; 0: see `why`. */
int mtl_find(file_bytes *out, char path[MODEL_PATH_MAX], model_build *b, slice name, report *why);
/* Read one into b->materials, which stands beside `names`. */
int mtl_read(model_build *b, obj_names *names, cursor text);
/* Load the textures that materials name, each file once, into b->textures. */
int mtl_textures(model_build *b, obj_names *names);
/* Notes on what the materials do not get. */
void mtl_tell_left_out(model_build *b, const obj_names *names);

#endif
