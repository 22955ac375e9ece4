/* io_ply_read.h: what the PLY reader's files share: a file's elements, and their items' values one by one. */
#ifndef IO_PLY_READ_H
#define IO_PLY_READ_H

#include "../common/io_text.h"
#include "io_ply.h"

enum { MAX_ELEMENTS = 32, MAX_PROPERTIES = 512, MAX_WORDS = 5, MAX_PICTURES = 64 };

typedef struct scalar_type {
    const char *name, *alias;
    double min, max; /* of whole numbers; both 0: a float */
    uint32_t size;
} scalar_type;

/* What a property is to us; the numbers index an item's values. The last two are lists. */
enum { X, Y, Z, NX, NY, NZ, RED, GREEN, BLUE, ALPHA, U, V, PICTURE, INDICES, TEXCOORDS, ROLES, NO_ROLE = ROLES };

enum { VERTEX = 1, FACE = 2, STRIP = 4, OTHER = 8 };

#define RESTART UINT32_MAX /* in a strip, in place of a vertex: another begins */

typedef struct property {
    slice name;
    const scalar_type *type;
    const scalar_type *count_type; /* of a list; NULL: a single value */
    int role;
} property;

typedef struct element {
    int kind;
    uint32_t count;
    uint32_t first, properties; /* in ply.properties */
    uint32_t bytes;             /* least that an item takes in the file */
    int has_lists;
    const property *roles[ROLES];
    const uint8_t *at; /* its first item, and that one's line */
    uint32_t line;
} element;

/* The mesh's arrays while they are written. */
typedef struct streams {
    float *positions, *uvs;
    int16_t *normals;
    uint8_t *colours;
    uint16_t *indices16; /* one of the two, or NULL */
    uint32_t *indices32;
} streams;

/* A vertex as one face has it, where faces have colours or texture coordinates of their own. */
typedef struct wedge {
    uint32_t vertex, next; /* the next one of that vertex: number + 1 */
    float uv[2];
    uint8_t colour[4];
} wedge;

typedef enum encoding { NO_FORMAT, TEXT, LITTLE_ENDIAN_BYTES, BIG_ENDIAN_BYTES } encoding;

typedef struct ply {
    model_build *b;
    const uint8_t *begin, *at, *end;
    uint32_t line; /* from 1; of the header and of text */
    int in_bytes;  /* behind the header of a binary file: places are bytes */
    encoding format;
    element elements[MAX_ELEMENTS];
    property properties[MAX_PROPERTIES];
    uint32_t element_count, property_count;
    element *vertex, *face, *strip; /* NULL: none, or it has no items */
    slice picture[MAX_PICTURES];    /* comment TextureFile */
    uint32_t pictures;
    uint64_t triangles;   /* counted by the first pass, of strips at most; then those there are */
    uint64_t all_corners; /* of faces, and of strips' triangles at most */
    uint32_t widest;      /* most corners of a face, values of a strip, values of a face's texture coordinates */
    uint32_t longest_strip, longest_coords;
    uint32_t corners, coords; /* of the item read last: corners, and values of texture coordinates */
    uint32_t *corner;         /* those corners' vertices; NULL in the first pass */
    float *coord;             /* NULL: not wanted */
    double *points;           /* scratch for one face: its corners' places, numbers, triangles and links */
    uint32_t *number, *cut, *links;
    uint64_t cut_steps; /* polygon_cut_within's, left for all faces */
    streams s;
    int is_textured, has_face_uvs, has_face_colours, has_vertex_colours;
    double range[2][4]; /* of vertices and of faces: what stands for full red, green, blue, alpha */
    int32_t texture_of[MAX_PICTURES]; /* -1: could not be read */
    wedge *wedges;      /* NULL: vertices are as the file has them */
    uint32_t *wedge_of; /* by vertex: number + 1 of its last one */
    uint32_t wedge_count;
    uint8_t *paint;     /* by triangle its material; NULL: one for all */
    uint32_t degenerate, short_strips, overlapping, unused, unknown_lines, translucent, odd_coords;
    uint32_t more_pictures;
} ply;

/* ply_fail: a line with the place in the file; 0. */
int ply_fail(const ply *p, const char *format, ...) REPORT_PRINTF(2, 3);

static inline int ply_is_float(const scalar_type *t) { return t->max <= 0; }

/* ply_walk: the header, and the pass over all items that counts. */
int ply_walk(ply *p);

/* ply_begin: the element's first item comes next. ply_take: one item: its values by role, and a face's corners. values
 * NULL: only step over it. 1, or 0 with the report set. */
void ply_begin(ply *p, const element *e);
int ply_take(ply *p, double *values, const element *e);

/* ply_has: all the roles from first to last? NULL has none. */
int ply_has(const element *e, int first, int last);

/* ply_scene (io_ply_mesh.c): the second pass: meshes, materials, textures, instances and notes into p->b. */
int ply_scene(ply *p);

#endif
