/* io_obj.h: shared by the OBJ reader and the material reader: materials by name. */
#ifndef IO_OBJ_H
#define IO_OBJ_H

#include "../common/io_text.h"
#include "model_build.h"

/* A texture map with a transform: coordinates are scaled, then moved, with v upwards, as in OBJ. */
typedef struct obj_map {
    char *path; /* NULL: no map */
    double scale[2], offset[2];
    uint8_t wrap;
} obj_map;

/* Material features that are ignored. */
enum {
    OBJ_LEFT_OPACITY = 1,
    OBJ_LEFT_OPACITY_MAP = 2,
    OBJ_LEFT_EMISSION_MAP = 4,
    OBJ_LEFT_BUMP = 8,
    OBJ_LEFT_OPTION = 16,
    OBJ_LEFT_MIRROR = 32,
    OBJ_LEFT_SPECTRUM = 64,
    OBJ_LEFT_RELIEF = 128
};

/* A name from usemtl; [0] is for faces before any usemtl. */
typedef struct obj_material {
    slice name;
    obj_map map;
    uint8_t defined; /* an MTL file describes it */
    uint8_t has_kd, has_d;
    uint8_t left_out; /* OBJ_LEFT_ ... */
} obj_material;

/* Names with an open-addressed index; slots hold number + 1. The keys are hashes of the files that contain the names
 * and map paths, so that no file can choose names that collide. */
typedef struct obj_names {
    obj_material *items;
    uint32_t *slots;
    uint32_t count, mask;
    uint64_t key, map_key;
} obj_names;

/* io_mtl.c: a keyed hash, so that nobody without the key can make collisions; depends on the byte order. */
uint64_t obj_hash(uint64_t key, const void *data, size_t size);
uint32_t obj_find(const obj_names *names, slice name, uint32_t *slot); /* UINT32_MAX: absent, insert at *slot */

/* Bytes and path of a library; returns 0: see `why`. */
int mtl_find(file_bytes *out, char path[MODEL_PATH_MAX], model_build *b, slice name, report *why);
/* Reads a library into b->materials, parallel to `names`. */
int mtl_read(model_build *b, obj_names *names, cursor text);
/* Loads the textures of the materials, each file once, into b->textures. */
int mtl_textures(model_build *b, obj_names *names);
/* Adds notes about ignored features. */
void mtl_tell_left_out(model_build *b, const obj_names *names);

#endif
