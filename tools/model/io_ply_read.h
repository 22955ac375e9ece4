/* io_ply_read.h: declarations that the files of the PLY reader share: elements of a file, and access to the values of
 * each item. */
#ifndef IO_PLY_READ_H
#define IO_PLY_READ_H

#include "../common/io_text.h"
#include "io_ply.h"

enum { MAX_ELEMENTS = 32, MAX_PROPERTIES = 512, MAX_WORDS = 5, MAX_PICTURES = 64 };

typedef struct scalar_type {
    const char *name, *alias;
    double min, max; /* range of an integer type; both 0: a float */
    uint32_t size;
} scalar_type;

/* The role of a property. Roles index the values of an item. The last two roles are lists. */
enum { X, Y, Z, NX, NY, NZ, RED, GREEN, BLUE, ALPHA, U, V, PICTURE, INDICES, TEXCOORDS, ROLES, NO_ROLE = ROLES };

enum { VERTEX = 1, FACE = 2, STRIP = 4, OTHER = 8 };

#define RESTART UINT32_MAX /* in a strip, in place of a vertex: a new strip begins */

typedef struct property {
    slice name;
    const scalar_type *type;
    const scalar_type *count_type; /* type of a list length; NULL: a single value */
    int role;
} property;

typedef struct element {
    int kind;
    uint32_t count;
    uint32_t first, properties; /* in ply.properties */
    uint32_t bytes;             /* minimum size of an item in the file */
    int has_lists;
    const property *roles[ROLES];
    const uint8_t *at; /* the first item, and the line of that item */
    uint32_t line;
} element;

/* The mesh's arrays while they are written. */
typedef struct streams {
    float *positions, *uvs;
    int16_t *normals;
    uint16_t *colours; /* LMB_COLOUR_RGBA16 */
    uint16_t *indices16; /* one of the two, or NULL */
    uint32_t *indices32;
} streams;

/* A vertex in one face, if faces have their own colours or texture coordinates. */
typedef struct wedge {
    uint32_t vertex, next; /* next wedge of the same vertex: index + 1 */
    float uv[2];
    uint16_t colour[4];
} wedge;

typedef enum encoding { NO_FORMAT, TEXT, LITTLE_ENDIAN_BYTES, BIG_ENDIAN_BYTES } encoding;

typedef struct ply {
    model_build *b;
    const uint8_t *begin, *at, *end;
    uint32_t line; /* line number from 1; in the header and in text files */
    int has_cr_lines; /* CR ends a line, as files of old Macs have it */
    int in_bytes;  /* after the header of a binary file: errors name byte offsets */
    encoding format;
    element elements[MAX_ELEMENTS];
    property properties[MAX_PROPERTIES];
    uint32_t element_count, property_count;
    element *vertex, *face, *strip; /* NULL: missing, or without items */
    slice picture[MAX_PICTURES];    /* comment TextureFile */
    uint32_t pictures;
    uint64_t triangles;   /* upper bound (for strips) from the first pass, then the exact count */
    uint64_t all_corners; /* corners of faces; upper bound for triangles of strips */
    uint32_t widest;      /* most corners of a face, values of a strip, or texture coordinate values of a face */
    uint32_t longest_strip, longest_coords;
    uint32_t corners, coords; /* number of corners and of texture coordinate values of the item read last */
    uint32_t *corner;         /* vertices of those corners; NULL in the first pass */
    float *coord;             /* NULL: not wanted */
    double *points;           /* scratch for one face: positions, indices, triangles and links of the corners */
    uint32_t *number, *cut, *links;
    uint64_t cut_steps; /* steps of polygon_cut_within that are left for all faces */
    streams s;
    int is_textured, has_face_uvs, has_face_colours, has_vertex_colours;
    double range[2][4]; /* of vertices and of faces: the values of full red, green, blue and alpha */
    int32_t texture_of[MAX_PICTURES]; /* -1: the texture could not be read */
    wedge *wedges;      /* NULL: the mesh uses the vertices of the file */
    uint32_t *wedge_of; /* by vertex: index + 1 of the last wedge */
    uint32_t wedge_count;
    uint8_t *paint;     /* material of each triangle; NULL: one for all */
    uint32_t degenerate, short_strips, overlapping, unused, unknown_lines, translucent, odd_coords;
    uint32_t more_pictures;
} ply;

/* ply_fail: reports an error with the position in the file. Returns 0. */
int ply_fail(const ply *p, const char *format, ...) REPORT_PRINTF(2, 3);

static inline int ply_is_float(const scalar_type *t) { return t->max <= 0; }

/* ply_walk: reads the header and makes the counting pass over all items. */
int ply_walk(ply *p);

/* ply_begin: moves to the first item of the element. ply_take: reads one item: values by role, and the corners of a
 * face. If `values` is NULL, the item is skipped. Returns 1, or 0 with the report set. */
void ply_begin(ply *p, const element *e);
int ply_take(ply *p, double *values, const element *e);

/* ply_has: returns 1 if the element has all roles from first to last; 0 if it is NULL. */
int ply_has(const element *e, int first, int last);

/* ply_scene (io_ply_mesh.c): makes the second pass: puts meshes, materials, textures, instances and notes into p->b. */
int ply_scene(ply *p);

#endif
