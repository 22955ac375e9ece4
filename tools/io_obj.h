/* io_obj.h: what the OBJ reader and its material reader share: text by tokens and lines, materials by name. */
#ifndef IO_OBJ_H
#define IO_OBJ_H

#include "model_build.h"

/* Some bytes of a text; not terminated. */
typedef struct slice {
    const char *at;
    size_t size;
} slice;

/* A place in a text of lines. */
typedef struct cursor {
    const char *at, *end;
    const char *path; /* for messages */
    uint32_t line;    /* from 1 */
} cursor;

/* io_text.c: tokens. A comment, or the line's end unless a backslash stands before it, ends a line. */
cursor text_open(const uint8_t *data, size_t size, const char *path);
int text_token(slice *out, cursor *c); /* the next on this line; 0 at its end */
void text_rest(slice *out, cursor *c); /* what remains of this line (not of one it goes on in), outer blanks cut */
int text_next_line(cursor *c);         /* 0 at the end of the text */
int slice_is(slice s, const char *word);
int slice_number(double *out, slice s);   /* 0: not a number; inf and nan are numbers */
int slice_integer(int64_t *out, slice s); /* 0: not one of at most 18 digits */
int text_fail(const cursor *c, report *r, const char *format, ...) REPORT_PRINTF(3, 4);

/* One name that usemtl gave; [0] stands for faces before any. */
typedef struct obj_material {
    slice name;
    char *map;   /* map_Kd's path, or NULL */
    int defined; /* an MTL file describes it */
    int has_kd;
    uint8_t wrap;
} obj_material;

/* Names with an open-addressed index; slots hold number + 1. */
typedef struct obj_names {
    obj_material *items;
    uint32_t *slots;
    uint32_t count, mask;
} obj_names;

uint32_t obj_find(const obj_names *names, slice name, uint32_t *slot); /* UINT32_MAX: absent, *slot is where it goes */

/* io_mtl.c: read one library into b->materials, which stands beside `names`; a missing one is a note. */
int mtl_load(model_build *b, obj_names *names, slice file);
int mtl_read(model_build *b, obj_names *names, cursor text); /* the same from memory */
/* Load the textures that materials name, each file once, into b->textures. */
int mtl_textures(model_build *b, obj_names *names);

#endif
