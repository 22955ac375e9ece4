/* simplify.h: a triangle mesh with fewer triangles, close to the first one or around it. */
#ifndef SIMPLIFY_H
#define SIMPLIFY_H

#include <stdint.h>

#include "../common/report.h"

/* Triangles over shared vertices, counter-clockwise seen from outside. Metres, linear RGB; one allocation each. */
typedef struct triangle_mesh {
    uint32_t vertex_count, triangle_count;
    float *positions;  /* 3 a vertex */
    float *normals;    /* 3 a vertex, unit; NULL as input: taken from the faces */
    float *colours;    /* 3 a vertex; NULL as input: out has none */
    uint32_t *indices; /* 3 a triangle, each < vertex_count */
} triangle_mesh;

enum {
    SIMPLIFY_NEAR = 0, /* as close to the original as it can be: some of it sticks out everywhere */
    SIMPLIFY_AROUND    /* the original lies inside or on it, but for what simplify_facts.outside says; parts stay */
};

typedef struct simplify_facts {
    uint32_t welded;          /* vertices that shared another one's place */
    uint32_t dropped;         /* triangles of the input with a NaN or infinite corner, or two corners in one place */
    uint32_t collapses;
    uint32_t vanished;        /* unconnected parts, too small for their share of the triangles: NEAR only */
    double outside;           /* AROUND: how far a vertex of the original still sticks out at most, metres */
    uint64_t memory_bytes;    /* heap at its highest, without `out` and the input */
} simplify_facts;

/* simplify_mesh: `in` down to `triangles` triangles, by edge collapse in the order of quadric error.
 *
 *   out        overwritten; triangle_mesh_free releases it. Vertices of one place are one vertex, with the mean of
 *              their normals and colours: a hard edge gets a smooth normal. A straight border stays, a
 *              curved one is kept as well as the faces are; a small hole closes.
 *   triangles  may be missed upwards: where one more collapse would fold the surface over, tear it or close a tunnel,
 *              the result keeps more. Never missed by an input that has as few: that is welded, and else as it was.
 *   around     SIMPLIFY_NEAR or SIMPLIFY_AROUND. Around needs faces that are turned outwards.
 *   facts      written, also for a failure.
 *
 * Returns 1; or 0 with `r` set and `out` empty: no memory, an index beyond the vertices, 2^28 triangles or more.
 * An empty input (or one with nothing but dropped triangles) gives an empty mesh, and 1.
 * The same output on every machine: doubles, no libm but sqrt, ties go to the lower vertex numbers. */
int simplify_mesh(triangle_mesh *out, const triangle_mesh *in, uint32_t triangles, int around, simplify_facts *facts,
                  report *r);

void triangle_mesh_free(triangle_mesh *m);

#endif
