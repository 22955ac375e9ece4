/* simplify.h: reduces the triangles of a mesh, close to the original or around it. */
#ifndef SIMPLIFY_H
#define SIMPLIFY_H

#include <stdint.h>

#include "../common/report.h"

/* Triangles over shared vertices, counter-clockwise seen from outside. Metres, linear RGB; one allocation each. */
typedef struct triangle_mesh {
    uint32_t vertex_count, triangle_count;
    float *positions;  /* 3 per vertex */
    float *normals;    /* 3 per vertex, unit; NULL as input: computed from the faces */
    float *colours;    /* 3 per vertex; NULL as input: out has none */
    uint32_t *indices; /* 3 per triangle, each < vertex_count */
} triangle_mesh;

enum {
    SIMPLIFY_NEAR = 0, /* as close to the original as possible; parts of it stick out everywhere */
    SIMPLIFY_AROUND    /* the original lies inside or on it, except for simplify_facts.outside; parts stay */
};

typedef struct simplify_facts {
    uint32_t welded;          /* vertices at the position of another one */
    uint32_t dropped;         /* triangles of the input with a NaN or infinite corner, or two corners in one position */
    uint32_t collapses;
    uint32_t vanished;        /* unconnected parts, too small for their share of the triangles: NEAR only */
    double outside;           /* AROUND: the largest distance that a vertex of the original still sticks out, metres */
    uint64_t memory_bytes;    /* peak of the heap, without `out` and the input */
} simplify_facts;

/* simplify_mesh: reduces `in` to `triangles` triangles by edge collapses in the order of quadric error.
 *
 *   out        overwritten; triangle_mesh_free releases it. Vertices at one position become one vertex, with the
 *              mean of their normals and colours: a hard edge gets a smooth normal. A straight border stays, a
 *              curved one is kept as well as the faces are; a small hole closes
 *   triangles  the result keeps more if one more collapse would fold the surface over, tear it or close a tunnel. If
 *              `in` has no more than this, it is only welded
 *   around     SIMPLIFY_NEAR or SIMPLIFY_AROUND. AROUND needs faces that are turned outwards
 *   facts      written, also on failure
 *
 * Returns 1; or 0 with `r` set and `out` empty: no memory, an index beyond the vertices, 2^28 triangles or more. An
 * empty input (or one with only dropped triangles) gives an empty mesh, and 1. The output is the same on every machine:
 * doubles, no libm except sqrt, ties go to the lower vertex numbers. */
int simplify_mesh(triangle_mesh *out, const triangle_mesh *in, uint32_t triangles, int around, simplify_facts *facts,
                  report *r);

void triangle_mesh_free(triangle_mesh *m);

#endif
