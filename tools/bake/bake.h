/* bake.h: scene -> light transfer: the types and steps that the files of `lambent bake` share. */
#ifndef BAKE_H
#define BAKE_H

#include <lambent/lambent.h>

#include <string.h>

#include "../common/io_file.h"
#include "../common/progress.h"
#include "../common/report.h"

/* Accuracy. Error limits assume that all surfaces emit the same light. */
typedef struct bake_settings {
    float error;        /* limit for the links of a receiver */
    float division;     /* limit for linear interpolation between receivers, as a share of all light */
    float cluster_m;    /* triangles with edges under twice this are lit by clusters of this size; 0: from the area */
    float smallest_m;   /* shorter edges are not halved; 0: from the area */
    uint32_t elements;  /* a power of 4, up to LMB_TRANSFER_MAX_ELEMENTS */
    uint32_t receivers; /* maximum; 0: `dividing` in addition to the receivers at triangle corners */
    uint32_t dividing;
    int threads;
    int is_swapped;     /* the file is for the other byte order */
} bake_settings;

/* Growing array of 32-bit words. */
typedef struct bake_words {
    uint32_t *data;
    size_t count, cap;
} bake_words;

/* A surface element, which sends light. */
typedef struct bake_element {
    lmb_vec3 corner[3], middle, normal; /* of the largest triangle; middle, normal: means over all */
    lmb_vec3 place; /* middle of the largest triangle, if there are several */
    float area;    /* m2, of all triangles */
    float reach2;  /* distance from the middle to the farthest corner, squared, m2 */
    float facing;  /* length of the mean normal: 1 for one triangle */
    int is_one;
    int is_stood_on; /* other geometry touches it */
    float open;    /* share that light can reach; `middle` is the middle of that share */
    int emits;     /* at least one triangle does */
    int is_dark;   /* no light arrives */
    int is_hidden; /* hardly any light arrives: perhaps inside a solid, through a crack */
    float light;   /* estimate of the arriving light, arbitrary unit */
    uint32_t key, number; /* position on a Z curve; index when created */
    uint32_t zone; /* light passes between elements of one zone, directly or not; BAKE_NO_ZONE: unknown */
    uint32_t first_part, parts; /* if there are several */
} bake_element;

/* One triangle of an element. The corners are counter-clockwise around the normal. */
typedef struct bake_part {
    lmb_vec3 corner[3], normal;
    lmb_vec3 middle; /* of the open share */
    float open;      /* share that light can reach */
    float area;      /* of the whole triangle, m2 */
    uint32_t element, number; /* element that owns it; index when created */
    uint32_t side; /* 2 (id - 1) + back if it is a whole triangle; otherwise LMB_TRANSFER_NONE */
} bake_part;

enum { BAKE_PARENTS = 4 };

/* A node in the tree of cuts of a triangle: divides an edge, or is a leaf. */
typedef struct bake_cut {
    uint32_t first; /* of two adjacent child nodes; 0: a leaf */
    int from;       /* the edge */
    int is_wall;    /* other geometry touches the line */
    float part;     /* position along the edge, from the start; 0.5: halved */
    uint8_t is_closed[2]; /* front and back of a leaf: no light arrives */
} bake_cut;

enum { BAKE_NO_ZONE = 0 };

/* A receiver of light: the weighted sum of the parents, plus links. */
typedef struct bake_target {
    uint16_t *row; /* light that arrives from each element, along each axis: upper halves of binary32 */
    uint32_t parent[BAKE_PARENTS];
    float share[BAKE_PARENTS]; /* 0: none */
    float support;             /* area that it lights, m2 */
    lmb_vec3 normal;
    bake_words link;
    uint32_t links;
    float scale;
    uint32_t zone; /* that its light comes from */
} bake_target;

/* A point that receives light. */
typedef struct bake_receiver {
    lmb_vec3 place, at; /* `at` lies a little inside the triangle that has `place` as a corner */
    float light; /* sum of row times element light (from bake_reach); near 0 in a solid */
    uint16_t *directions; /* rows along x, y and z, one after another, for bake_directed; or NULL */
    bake_target target;
} bake_receiver;

/* Adjacent small triangles with similar normals. */
typedef struct bake_cluster {
    lmb_vec3 at;
    bake_target target;
    int32_t cell[3];
    uint32_t next; /* in the same slot, + 1 */
    uint32_t key, generation;
} bake_cluster;

typedef struct bake_share bake_share; /* steps shared among slices */
typedef struct bake_linker bake_linker; /* scratch of bake_links; one per thread */

typedef struct bake {
    bake_settings set;
    bake_share *share; /* NULL: one machine bakes everything */
    const lmb_scene *scene;
    const lmb_kernels *kernels;
    lmb_bvh bvh;
    void *bvh_memory;
    float area;    /* m2, of everything that receives */
    float small_m;  /* longest edge of a small triangle */
    uint32_t small_count;
    int has_cluster_m; /* the settings give the cluster size: do not shrink clusters to get more of them */
    uint32_t *coarse; /* counts calls with coarser visibility, because a job ran out of tests; NULL: not counted */
    uint64_t *tests; /* counts visibility tests of rows: nodes, leaves, triangles, pixels against holes; or NULL */
    int by_middles; /* rows use only the middles of elements */
    int has_thin;   /* elements may be long and thin, because others would be far too large */
    int is_coded;   /* the areas of targets were added to their parents */

    bake_element *element; /* set.elements; area 0 from element_count on */
    uint32_t element_count;
    bake_part *part; /* of elements with several triangles; parts of an element are adjacent */
    uint32_t part_count, part_cap;

    bake_receiver *receiver;
    uint32_t receiver_count, receiver_cap;

    bake_cut *cut; /* of all triangles */
    uint32_t cut_count, cut_cap;
    float cut_shortest; /* m: shorter lines are ignored */
    uint32_t *cut_root; /* first node per triangle; 0: not cut */
    uint32_t *node_zone; /* per node of elements: the zone, BAKE_NO_ZONE, or BAKE_ZONES for several */

    uint8_t *small_open; /* per side of small triangles: bits of the bake_quarters that light reaches; NULL: all */
    bake_words section[LMB_TRANSFER_SECTIONS];
    uint32_t leaves; /* of corners: the leaves of receivers, which come first */
    bake_cluster *cluster;
    uint32_t cluster_count, cluster_cap;
} bake;

/* The area of an element that sends light, m2. */
static inline float bake_open_area(const bake_element *e) { return e->is_dark ? 0.0f : e->area * e->open; }

/* A point on an element. If there are several triangles, it lies on the largest: their mean may lie inside a solid. */
static inline lmb_vec3 bake_place(const bake_element *e) { return e->is_one ? e->middle : e->place; }

/* The normal at bake_place. */
lmb_vec3 bake_facing(const bake_element *e);

/* Scratch of bake_sees; one per thread. */
typedef struct bake_sight {
    lmb_tile *tile;
    lmb_traversal traversal;
} bake_sight;

/* bake_sees: returns 1 if nothing blocks the way between two points of a plane, just above it. bake_sees_over: the
 * same between two points of a mesh, higher above it, to find walls between them. bake_stands_free: whether the
 * middle of a triangle sees all corners. bake_pulled: moves a corner slightly towards the middle. */
int bake_sight_begin(bake_sight *s, report *r);
void bake_sight_end(bake_sight *s, const bake *b);
int bake_sees(bake_sight *s, const bake *b, lmb_vec3 from, lmb_vec3 to, lmb_vec3 normal);
int bake_sees_over(bake_sight *s, const bake *b, lmb_vec3 from, lmb_vec3 from_normal, lmb_vec3 to, lmb_vec3 to_normal);
int bake_stands_free(bake_sight *s, const bake *b, const lmb_vec3 corner[3], lmb_vec3 normal);
lmb_vec3 bake_pulled(const bake *b, lmb_vec3 at, lmb_vec3 to);

/* bake_bound: begins a job of some calls with a fixed number of visibility tests, whichever thread runs it. Beyond
 * that number visibility is coarser. traversal->coarse keeps counting. */
void bake_bound(lmb_traversal *traversal);

/* bake_count_coarse: adds `calls` to the count of calls with coarser visibility, if the bake counts them. */
void bake_count_coarse(const bake *b, uint32_t calls);

/* All calls below return 1, or 0 with `r` set. */

int bake_put(bake_words *w, uint32_t word, report *r);
int bake_put_float(bake_words *w, float v, report *r);

/* bake_begin: builds the BVH. bake_elements: makes the elements, and for each triangle the pieces that lead to them. */
int bake_begin(bake *b, const lmb_scene *scene, const bake_settings *set, report *r);
int bake_elements(bake *b, report *r);

/* bake_cuts: divides large triangles along lines where other triangles touch or cross them, because light differs on
 * the two sides. If many lines lie close together, it halves the triangle first. Each further call makes fewer cuts.
 * bake_divide: splits a node of pieces or divisions as the cut does; the two parts start at *first. bake_first:
 * returns the first part of an inner node. bake_part_of: returns the area share of the first part. bake_cut_at:
 * returns the point on the edge. */
int bake_cuts(bake *b, report *r);
int bake_divide(bake *b, bake_words *nodes, size_t node, const bake_cut *c, uint32_t *first, report *r);
uint32_t bake_first(const bake *b, uint32_t word);
float bake_part_of(const bake *b, uint32_t word);
lmb_vec3 bake_cut_at(const bake_cut *c, const lmb_vec3 corner[3]);

/* bake_zones: fills b->node_zone from the current elements. bake_zone_of: returns the zone of the element that
 * contributes most to a row. */
#define BAKE_ZONES UINT32_MAX
int bake_zones(bake *b, report *r);
uint32_t bake_zone_of(const bake *b, const uint16_t *row, int axes);

/* bake_order: sorts elements so that neighbours with similar normals are adjacent, because nodes use their means.
 * Hidden and emitting elements are kept apart, because their light differs from that of their neighbours. */
int bake_order(bake *b, report *r);

/* bake_join: sets the means and the largest triangle of an element from the open share of its parts, if any is open. */
void bake_join(const bake *b, bake_element *e);

/* bake_reach: removes the sides of surfaces that no path of light connects to a light or to `eyes`, like the inside
 * of a box, and the covered parts of elements that other geometry touches. Without lights and eyes it removes
 * nothing. Afterwards the areas of elements are final. */
int bake_reach(bake *b, const lmb_vec3 *eyes, uint32_t count, report *r);

/* bake_smalls: fills b->small_open and the open share of parts from the light of elements. bake_quarters: returns
 * the middle of a triangle and three points towards its corners. */
int bake_smalls(bake *b, report *r);
void bake_quarters(lmb_vec3 out[4], const lmb_vec3 corner[3]);

/* The nearest of the points that were added. */
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

/* bake_nearest_put: adds a point; call it only if bake_is_near. */
void bake_nearest_put(bake_nearest *n, lmb_vec3 at, float far2);

/* bake_rows: computes the light that arrives from each element at up to 64 points: form factor times visible share.
 *
 *   row   axes x count rows of set.elements
 *   axes  1: on a plane with the normal; 3: along x, y and z, from elements in front of the plane
 *   times NULL, or receives a factor for the entries of each element: elements far from all points are subsampled; the
 *         skipped ones get 0, the others count for them */
int bake_rows(const bake *b, const lmb_vec3 *at, const lmb_vec3 *normal, int count, int axes, float *const *row,
              float *times, report *r);

/* bake_rows_part: computes only the entries of part `own` of `parts` (up to BAKE_PARTS). bake_rows_has: whether an
 * element belongs to that part. */
enum { BAKE_PARTS = 64 };
int bake_rows_part(const bake *b, const lmb_vec3 *at, const lmb_vec3 *normal, int count, int axes, float *const *row,
                   float *times, int own, int parts, report *r);
int bake_rows_has(const bake *b, uint32_t element, int own, int parts);

/* bake_links: chooses the nodes whose means approximate a row of elements; with 3 axes, all rows share the nodes.
 *
 *   row            becomes the row that the links reproduce
 *   normal         3 axes: errors across the normal count less
 *   price          squared error that a link must save
 *   *count, *scale number of links added to `links`, and the unit of the weights */
bake_linker *bake_linker_new(const bake *b, report *r);
void bake_linker_free(bake_linker *l);
int bake_links(bake_linker *l, float *const *row, int axes, lmb_vec3 normal, float price, bake_words *links,
               uint32_t *count, float *scale, report *r);

/* bake_code: rows -> links. The links of a target encode how the row differs from the parents, and the row becomes
 * the decoded one. Parents come before children. A link costs the same error times support area at every target.
 * Targets are `each` bytes apart. */
int bake_code(bake *b, bake_target *target, size_t each, uint32_t count, int axes, report *r);

/* Row entries: upper halves of binary32, rounded to nearest. */
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

/* bake_surplus: returns the size of a difference of rows: the root of squared sums over groups of a 256th of the
 * elements and of four. */
float bake_surplus(const bake *b, const float *row);

/* Receivers on large triangles, clusters on small ones. */
int bake_receivers(bake *b, report *r);
int bake_clusters(bake *b, report *r);

/* bake_takes_direction: returns whether a material has a normal map or a lobe. bake_directed: turns the receivers of
 * such surfaces into clusters; call it after both. bake_cluster_rows: computes the rows of clusters along x, y and z;
 * put neighbours next to each other. */
int bake_takes_direction(const lmb_material *m);
int bake_directed(bake *b, report *r);
int bake_cluster_rows(bake *b, bake_cluster *const *cluster, uint32_t all, report *r);

/* bake_generations: orders clusters: first a few that are far apart, then more and more between them. bake_parents:
 * finds up to four clusters of former generations that predict each row as a weighted sum; parents come first. */
void bake_generations(bake_cluster *c, uint32_t count, float cell);
int bake_parents(bake *b, report *r);
/* bake_bounces: groups elements into runs, and links each run to the elements that light it. */
int bake_bounces(bake *b, report *r);

/* bake_air: adds receivers in the air, for objects that move. */
int bake_air(bake *b, report *r);

/* bake_still: copies the scene with all triangles of some instances collapsed to a point, so that no step sees them.
 * `ranges` becomes LMB_TRANSFER_MOVING. Free out->instance. */
typedef struct bake_still_scene {
    lmb_scene scene;
    lmb_instance *instance;
} bake_still_scene;

int bake_still(bake_still_scene *out, const lmb_scene *scene, const uint32_t *moving, uint32_t count,
               bake_words *ranges, report *r);

/* bake_key: returns a sort key: the octant of the normal, then the position on a Z curve. Neighbours have similar
 * keys. */
uint32_t bake_key(const lmb_scene *scene, lmb_vec3 at, lmb_vec3 normal);

/* bake_cell: returns the grid cell, `per` cells a metre, clamped to +-1e9. */
int32_t bake_cell(float at, float per);

int bake_is_small(const bake *b, const lmb_vec3 corner[3]);

/* bake_code_all: codes receivers and clusters; if they have links already, codes them again with the new error.
 * bake_file: writes the bytes of a .lmt. */
int bake_code_all(bake *b, report *r);
int bake_file(file_bytes *out, bake *b, report *r);
void bake_free(bake *b);

#endif
