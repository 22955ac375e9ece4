/* corner_mesh.h: triangles that know their neighbours, and the collapse of an edge. */
#ifndef CORNER_MESH_H
#define CORNER_MESH_H

#include "../common/dvec.h"
#include "../common/counted_alloc.h"
#include "simplify.h"

#define CORNER_NONE UINT32_MAX
#define CORNER_STAR 256 /* most triangles at a vertex after a collapse: bounds the work of a collapse */

/* Corner c belongs to triangle c / 3. The corners at a vertex form a doubly linked list, which works for any
 * topology: borders, edges of three faces, two fans that touch in one vertex. */
typedef struct corner_mesh {
    uint32_t vertex_count, corner_count; /* as built; nothing moves */
    uint32_t live;                       /* triangles */
    dvec *places;
    float (*looks)[6];      /* normal, colour */
    uint32_t *vertex;       /* of a corner; CORNER_NONE: the triangle was removed */
    uint32_t *next, *prior; /* corner at the same vertex */
    uint32_t *first;        /* corner of a vertex; CORNER_NONE: no triangle has it */
    uint32_t *valence;      /* triangles at a vertex */
    uint32_t *mark;         /* of a vertex, for traversals: equal to `epoch` or stale */
    uint32_t epoch;
    uint8_t *border;        /* the vertex is on an edge that does not have two faces */
} corner_mesh;

static inline uint32_t corner_after(uint32_t c) { return c % 3 == 2 ? c - 2 : c + 1; }
static inline uint32_t corner_before(uint32_t c) { return c % 3 == 0 ? c + 2 : c - 1; }

/* corner_mesh_build: welds vertices at the same place and drops degenerate triangles. Returns 0: no memory, or a bad
 * index, with `r` set. Call corner_mesh_free in any case. */
int corner_mesh_build(corner_mesh *m, const triangle_mesh *in, simplify_facts *facts, counted_heap *t, report *r);

void corner_mesh_free(corner_mesh *m, counted_heap *t);

/* corner_mesh_edges: returns a corner for each edge of each triangle (the edge from the corner to the next), sorted
 * by vertices, so that those of one edge are adjacent. 3 * live of them; NULL: no memory. */
uint32_t *corner_mesh_edges(const corner_mesh *m, counted_heap *t);

/* corner_mesh_edge_end: edges[i] starts an edge; returns the index in `edges` at which the next edge starts. The
 * difference is the number of faces. */
uint32_t corner_mesh_edge_end(const corner_mesh *m, const uint32_t *edges, uint32_t i);

/* corner_mesh_normal: the normal of the triangle of corner c; the length is twice the area. */
dvec corner_mesh_normal(const corner_mesh *m, uint32_t c);

/* corner_mesh_can_join: whether vertices a and b of an edge can become one vertex at `at`. They cannot if that would
 * fold a triangle over, make a needle, pinch two borders or break the link condition (Dey et al. 1999). */
int corner_mesh_can_join(corner_mesh *m, uint32_t a, uint32_t b, dvec at);

/* corner_mesh_join: merges b into a, at `at`, with normal and colour interpolated on the edge. */
void corner_mesh_join(corner_mesh *m, uint32_t a, uint32_t b, dvec at);

/* corner_mesh_part: collects corners of the triangles connected with vertex v, if there are at most `cap`; otherwise
 * returns 0. */
uint32_t corner_mesh_part(const corner_mesh *m, uint32_t v, uint32_t *part, uint32_t cap);

/* corner_mesh_drop: removes the triangle of corner c. */
void corner_mesh_drop(corner_mesh *m, uint32_t c);

/* corner_mesh_write: writes the remaining mesh, in the same order. Returns 0: no memory. */
int corner_mesh_write(const corner_mesh *m, triangle_mesh *out, int colours, counted_heap *t);

#endif
