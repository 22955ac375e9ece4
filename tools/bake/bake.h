/* bake.h: a scene -> its light transfer: what the steps of `lambent bake` share. */
#ifndef BAKE_H
#define BAKE_H

#include <lambent/lambent.h>

#include <string.h>

#include "../common/io_file.h"
#include "../common/progress.h"
#include "../common/report.h"
#include "bake_triangle.h"

/* How accurately; errors are of light that all surfaces send alike. */
typedef struct bake_settings {
    float error;        /* of a receiver's links */
    float division;     /* of light that is taken to be linear between receivers, as a share of all */
    float cluster_m;    /* triangles under twice this are lit by clusters of that size; 0: by the scene's area */
    float smallest_m;   /* no edge under it is halved; 0: by the scene's area */
    uint32_t elements;  /* a power of 4, up to LMB_TRANSFER_MAX_ELEMENTS */
    uint32_t receivers; /* maximum; 0: `dividing` in addition to those at the corners of triangles */
    uint32_t dividing;
    int threads;
    int is_swapped;     /* the file is for the other byte order */
} bake_settings;

/* Words that grow. */
typedef struct bake_words {
    uint32_t *data;
    size_t count, cap;
} bake_words;

/* A piece of surface that sends light. */
typedef struct bake_element {
    lmb_vec3 corner[3], middle, normal; /* of several triangles the largest; middle, normal: means */
    lmb_vec3 place; /* of several triangles: the middle of the largest one */
    float area;    /* m2, of all */
    float reach2;  /* its farthest corner from its middle, squared, m2 */
    float facing;  /* length of the mean normal: 1 for one triangle */
    int is_one;
    int is_stood_on; /* something stands on it */
    float open;    /* share of it that light can come to; `middle` is that of it */
    int emits;     /* one of its triangles does */
    int is_dark;   /* no light comes here */
    int is_hidden; /* hardly any does: inside of a solid, it may be, through a crack */
    float light;   /* about how much comes, in any unit */
    uint32_t key, number; /* order along a Z curve; where it was made */
    uint32_t zone; /* light goes between elements of one zone, by any way; BAKE_NO_ZONE: not known */
    uint32_t first_part, parts; /* its triangles, where it has several */
} bake_element;

/* One of an element's triangles: its corners go round its normal. */
typedef struct bake_part {
    lmb_vec3 corner[3], normal;
    lmb_vec3 middle; /* of what light can come to */
    float open;      /* the share of it */
    float area;      /* of all, m2 */
    uint32_t element, number; /* of which it is one; where it was made */
    uint32_t side; /* 2 (id - 1) + back, where it is all of a triangle; or LMB_TRANSFER_NONE */
} bake_part;

enum { BAKE_PARENTS = 4 };

/* A node of a triangle's cuts: an edge is divided there, or nothing is. */
typedef struct bake_cut {
    uint32_t first; /* of two nodes side by side; 0: a leaf */
    int from;       /* the edge */
    int is_wall;    /* something stands on the line */
    float part;     /* of the edge, from its beginning; 0.5: a halving */
    uint8_t is_closed[2]; /* a leaf's front and back: no light comes there */
} bake_cut;

enum { BAKE_NO_ZONE = 0 };

/* What receives light: what its parents do, by their shares, and what its links say. */
typedef struct bake_target {
    uint16_t *row; /* what arrives of each element, along each axis: upper halves of binary32 */
    uint32_t parent[BAKE_PARENTS];
    float share[BAKE_PARENTS]; /* 0: none */
    float support;             /* m2 that it lights */
    lmb_vec3 normal;
    bake_words link;
    uint32_t links;
    float scale;
    uint32_t zone; /* that its light comes from */
} bake_target;

/* A point that receives light. */
typedef struct bake_receiver {
    lmb_vec3 place, at; /* `at` lies a little inside the triangle at whose corner `place` is */
    float light; /* that comes to it: what bake_reach found that elements get, by its row; in a solid hardly any */
    bake_target target;
} bake_receiver;

/* Neighbouring small triangles that face alike. */
typedef struct bake_cluster {
    lmb_vec3 at;
    bake_target target;
    int32_t cell[3];
    uint32_t next; /* of the same slot, + 1 */
    uint32_t key, generation;
} bake_cluster;

typedef struct bake_share bake_share; /* of slices */
typedef struct bake_linker bake_linker; /* what bake_links works with; one a thread */

typedef struct bake {
    bake_settings set;
    bake_share *share; /* NULL: one machine bakes it all */
    const lmb_scene *scene;
    const lmb_kernels *kernels;
    lmb_bvh bvh;
    void *bvh_memory;
    float area;    /* m2, of all that receives */
    float small_m;  /* no edge of a small triangle is longer */
    uint32_t small_count;
    int has_cluster_m; /* the settings say how large clusters are: they do not shrink until there are many */
    uint32_t *coarse; /* counts calls whose visibility is coarser, as too many triangles cross; NULL: none */
    int by_middles; /* rows ask for elements' middles alone */
    int is_coded;   /* areas of targets were handed up */

    bake_element *element; /* set.elements; past element_count without area */
    uint32_t element_count;
    bake_part *part; /* of elements of several triangles; those of one lie side by side */
    uint32_t part_count, part_cap;

    bake_receiver *receiver;
    uint32_t receiver_count, receiver_cap;

    bake_cut *cut; /* of all triangles */
    uint32_t cut_count, cut_cap;
    float cut_shortest; /* m: shorter lines cut nothing */
    uint32_t *cut_root; /* a triangle's first node; 0: it is not cut */
    uint32_t *node_zone; /* of nodes of elements: theirs, BAKE_NO_ZONE, or BAKE_ZONES where they have several */

    uint8_t *small_open; /* of each side of small triangles: which of bake_quarters light comes to; NULL: all */
    bake_words section[LMB_TRANSFER_SECTIONS];
    uint32_t leaves; /* of corners: those of receivers, which come first */
    bake_cluster *cluster;
    uint32_t cluster_count, cluster_cap;
} bake;

/* What of an element sends light, m2. */
static inline float bake_open_area(const bake_element *e) { return e->is_dark ? 0.0f : e->area * e->open; }

/* A place on an element. Of several triangles the largest one is taken: their mean middle may lie inside a solid. */
static inline lmb_vec3 bake_place(const bake_element *e) { return e->is_one ? e->middle : e->place; }

/* The normal there. */
static inline lmb_vec3 bake_facing(const bake_element *e)
{
    const lmb_vec3 across = cross3(sub3(e->corner[1], e->corner[0]), sub3(e->corner[2], e->corner[0]));
    const float length = length3(across);
    return e->is_one || !(length > 0.0f) ? e->normal : mul3(across, 1.0f / length);
}

/* What bake_sees works with; one a thread. */
typedef struct bake_sight {
    lmb_tile *tile;
    lmb_traversal traversal;
} bake_sight;

/* bake_sees: does nothing stand between two points of a plane, just over it?
 * bake_sees_over: likewise between two places of a mesh, higher over it: no wall parts them.
 * bake_stands_free: does a triangle's middle see its corners so? bake_pulled: a corner, a little towards its middle. */
int bake_sight_begin(bake_sight *s, report *r);
void bake_sight_end(bake_sight *s, const bake *b);
int bake_sees(bake_sight *s, const bake *b, lmb_vec3 from, lmb_vec3 to, lmb_vec3 normal);
int bake_sees_over(bake_sight *s, const bake *b, lmb_vec3 from, lmb_vec3 from_normal, lmb_vec3 to, lmb_vec3 to_normal);
int bake_stands_free(bake_sight *s, const bake *b, const lmb_vec3 corner[3], lmb_vec3 normal);
lmb_vec3 bake_pulled(const bake *b, lmb_vec3 at, lmb_vec3 to);

/* bake_bound: begin a job of some calls, which has tests of visibility of its own whatever thread runs it: beyond them
 * visibility is coarser. traversal->coarse goes on. */
void bake_bound(lmb_traversal *traversal);

/* bake_count_coarse: add calls whose visibility is coarser to the count, if the bake has one. */
void bake_count_coarse(const bake *b, uint32_t calls);

/* All of these return 1, or 0 with `r` set. */

int bake_put(bake_words *w, uint32_t word, report *r);
int bake_put_float(bake_words *w, float v, report *r);

/* The scene's BVH, and elements with the way to them from each triangle. */
int bake_begin(bake *b, const lmb_scene *scene, const bake_settings *set, report *r);
int bake_elements(bake *b, report *r);

/* bake_cuts: divides large triangles along lines where other triangles stand on them or go through them, because light
 * differs on the two sides; if many lie close together, a triangle is halved first; each further call makes fewer.
 * bake_divide: makes a node of pieces or divisions one of the cut's kind, with two more nodes
 * for its parts, from *first on. bake_first: returns the first part of a node that is no leaf. bake_part_of: returns its
 * share of the area. bake_cut_at: returns the place on the edge. */
int bake_cuts(bake *b, report *r);
int bake_divide(bake *b, bake_words *nodes, size_t node, const bake_cut *c, uint32_t *first, report *r);
uint32_t bake_first(const bake *b, uint32_t word);
float bake_part_of(const bake *b, uint32_t word);
lmb_vec3 bake_cut_at(const bake_cut *c, const lmb_vec3 corner[3]);

/* bake_zones: b->node_zone, of the elements as they are now. bake_zone_of: of the element of which most arrives. */
#define BAKE_ZONES UINT32_MAX
int bake_zones(bake *b, report *r);
uint32_t bake_zone_of(const bake *b, const uint16_t *row, int axes);

/* bake_order: put elements in order, so that neighbours that face alike lie side by side: their means become nodes.
 * Hidden ones and those that emit lie apart, as what others send is not like what they do. */
int bake_order(bake *b, report *r);

/* bake_join: an element's means, and its largest triangle, by what is open of its parts, if anything is. */
void bake_join(const bake *b, bake_element *e);

/* bake_reach: leave out the sides of surfaces that no way through the scene leads to from its lights and from `eyes`,
 * like the insides of boxes, and parts of elements on which something stands. With neither nothing is left out. Then
 * the elements' areas are known. */
int bake_reach(bake *b, const lmb_vec3 *eyes, uint32_t count, report *r);

/* bake_smalls: b->small_open, by the light of elements; and what is open of parts. bake_quarters: a triangle's middle,
 * and places towards its corners. */
int bake_smalls(bake *b, report *r);
void bake_quarters(lmb_vec3 out[4], const lmb_vec3 corner[3]);

/* The nearest of what was put in. */
enum { BAKE_NEAREST = 64 };
typedef struct bake_nearest {
    lmb_vec3 at[BAKE_NEAREST];
    float far2[BAKE_NEAREST]; /* squared distance, m2, rising */
    int count, limit;
} bake_nearest;

static inline int bake_is_near(const bake_nearest *n, float far2)
{
    return n->count < n->limit || far2 < n->far2[n->count - 1];
}

/* bake_nearest_put: what bake_is_near. */
void bake_nearest_put(bake_nearest *n, lmb_vec3 at, float far2);

/* bake_rows: what arrives of each element at up to 64 points: form factor times the share that is seen.
 *   row   axes x count rows of set.elements. axes 1: on a plane of the normal; 3: along x, y, z, of what lies
 *         before it
 *   times  NULL, or for each element what its entries stand for: of those far from all points some are left out (0),
 *          and others count for them */
int bake_rows(const bake *b, const lmb_vec3 *at, const lmb_vec3 *normal, int count, int axes, float *const *row,
              float *times, report *r);

/* bake_rows_part: of `parts` up to BAKE_PARTS, entries of those elements alone that are `own` by bake_rows_has. */
enum { BAKE_PARTS = 64 };
int bake_rows_part(const bake *b, const lmb_vec3 *at, const lmb_vec3 *normal, int count, int axes, float *const *row,
                   float *times, int own, int parts, report *r);
int bake_rows_has(const bake *b, uint32_t element, int own, int parts);

/* bake_links: choose nodes whose means stand for a row of elements; axes 1 or 3 rows that share them.
 *   row     becomes what the links say
 *   normal  3 axes: what arrives across it counts less
 *   price   squared error that a link has to save
 *   *count, *scale  what was put into `links`, and a weight's unit */
bake_linker *bake_linker_new(const bake *b, report *r);
void bake_linker_free(bake_linker *l);
int bake_links(bake_linker *l, float *const *row, int axes, lmb_vec3 normal, float price, bake_words *links,
               uint32_t *count, float *scale, report *r);

/* bake_code: rows -> links: what each target's parents do not say of its row, which becomes what the file says. Parents
 * lie before their children. Links cost as much error, times the area that it shows on, at all targets alike.
 *   target   `each` bytes apart */
int bake_code(bake *b, bake_target *target, size_t each, uint32_t count, int axes, report *r);

/* A row's entries: upper halves of binary32, to the nearest. */
static inline uint16_t bake_short(float v)
{
    uint32_t bits;
    memcpy(&bits, &v, sizeof bits);
    return (uint16_t)((bits + 0x7fffu + (bits >> 16 & 1u)) >> 16);
}

static inline float bake_long(uint16_t v)
{
    const uint32_t bits = (uint32_t)v << 16;
    float out;
    memcpy(&out, &bits, sizeof out);
    return out;
}

/* bake_surplus: how much a row is at odds with light that is even over nodes of a 256th of the elements, and of four. */
float bake_surplus(const bake *b, const float *row);

/* Receivers on large triangles, and clusters on small ones. */
int bake_receivers(bake *b, report *r);
int bake_clusters(bake *b, report *r);

/* bake_directed: receivers of surfaces with a normal map or a lobe become clusters, after both.
 * bake_cluster_rows: what arrives at clusters, along x, y and z; neighbours lie side by side. */
int bake_directed(bake *b, report *r);
int bake_cluster_rows(bake *b, bake_cluster *const *cluster, uint32_t all, report *r);

/* bake_generations: few clusters far apart first, then more and more between them; in any order of theirs.
 * bake_parents: up to four of former generations, by which each one's row is nearly a sum of theirs; these come first. */
void bake_generations(bake_cluster *c, uint32_t count, float cell);
int bake_parents(bake *b, report *r);
/* Runs of elements, and the links by which light comes to them again. */
int bake_bounces(bake *b, report *r);

/* bake_air: receivers at places in the air, where objects move. */
int bake_air(bake *b, report *r);

/* bake_still: the scene with all triangles of some instances drawn together into a point, so that no step sees them;
 * `ranges` becomes LMB_TRANSFER_MOVING. Free out->instance. */
typedef struct bake_still_scene {
    lmb_scene scene;
    lmb_instance *instance;
} bake_still_scene;

int bake_still(bake_still_scene *out, const lmb_scene *scene, const uint32_t *moving, uint32_t count, bake_words *ranges,
               report *r);

/* bake_key: the side of space that a normal faces, then the place along a Z curve: neighbours have near keys. */
uint32_t bake_key(const lmb_scene *scene, lmb_vec3 at, lmb_vec3 normal);

/* bake_cell: the cell of a grid, `per` a metre, within +-1e9. */
int32_t bake_cell(float at, float per);

int bake_is_small(const bake *b, const lmb_vec3 corner[3]);

/* bake_code_all: receivers and clusters, all again by another error where they have links.
 * bake_file: the bytes of a .lmt. */
int bake_code_all(bake *b, report *r);
int bake_file(file_bytes *out, bake *b, report *r);
void bake_free(bake *b);

#endif
