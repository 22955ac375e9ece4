/* corner_mesh.h: triangles that know their neighbours, and the collapse of an edge. */
#ifndef CORNER_MESH_H
#define CORNER_MESH_H

#include "../common/dvec.h"
#include "../common/counted_alloc.h"
#include "simplify.h"

#define CORNER_NONE UINT32_MAX
#define CORNER_STAR 256 /* triangles at a vertex that a collapse leaves behind, at most: bounds the work of one */

/* Corner c belongs to triangle c / 3. The corners at a vertex are a doubly linked list, which holds whatever the
 * triangles are up to: borders, edges of three faces, two fans that touch in one vertex. */
typedef struct corner_mesh {
    uint32_t vertex_count, corner_count; /* as built; nothing moves */
    uint32_t live;                       /* triangles */
    dvec *places;
    float (*looks)[6];      /* normal, colour */
    uint32_t *vertex;       /* of a corner; CORNER_NONE: its triangle is gone */
    uint32_t *next, *prior; /* corner at the same vertex */
    uint32_t *first;        /* corner of a vertex; CORNER_NONE: no triangle has it */
    uint32_t *valence;      /* triangles at a vertex */
    uint32_t *mark;         /* of a vertex, for walks: equal to `epoch` or stale */
    uint32_t epoch;
    uint8_t *border;        /* vertex of an edge that has not two faces */
} corner_mesh;

static inline uint32_t corner_after(uint32_t c) { return c % 3 == 2 ? c - 2 : c + 1; }
static inline uint32_t corner_before(uint32_t c) { return c % 3 == 0 ? c + 2 : c - 1; }

/* corner_mesh_build: vertices of one place welded, triangles that are none dropped. 0: no memory, or a bad index, which
 * `r` says; corner_mesh_free in any case. */
int corner_mesh_build(corner_mesh *m, const triangle_mesh *in, simplify_facts *facts, counted_heap *t, report *r);

void corner_mesh_free(corner_mesh *m, counted_heap *t);

/* corner_mesh_edges: a corner of each triangle's each edge (from the corner to the one after), so that those of one
 * edge stand together, edges in the order of their vertices. 3 * live of them; NULL: no memory. */
uint32_t *corner_mesh_edges(const corner_mesh *m, counted_heap *t);

/* corner_mesh_edge_end: edges[i] starts an edge; where in `edges` the next one starts. The difference is its faces. */
uint32_t corner_mesh_edge_end(const corner_mesh *m, const uint32_t *edges, uint32_t i);

/* corner_mesh_normal: of the triangle of corner c, twice its area long. */
dvec corner_mesh_normal(const corner_mesh *m, uint32_t c);

/* corner_mesh_can_join: may vertices a and b of an edge become one vertex at `at`? Not where that would fold a
 * triangle over, make a needle, pinch two borders or join what is not neighbours (link condition: Dey et al. 1999). */
int corner_mesh_can_join(corner_mesh *m, uint32_t a, uint32_t b, dvec at);

/* corner_mesh_join: b becomes a, at `at`, with the look of that place on the edge. */
void corner_mesh_join(corner_mesh *m, uint32_t a, uint32_t b, dvec at);

/* corner_mesh_part: corners of the triangles that hang together with vertex v, if those are at most `cap`; else 0. */
uint32_t corner_mesh_part(const corner_mesh *m, uint32_t v, uint32_t *part, uint32_t cap);

/* corner_mesh_drop: the triangle of corner c goes. */
void corner_mesh_drop(corner_mesh *m, uint32_t c);

/* corner_mesh_write: what is left, numbered in the order it has. 0: no memory. */
int corner_mesh_write(const corner_mesh *m, triangle_mesh *out, int colours, counted_heap *t);

#endif
