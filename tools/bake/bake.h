/* bake.h: a scene -> its light transfer: what the steps of `lambent bake` share. */
#ifndef BAKE_H
#define BAKE_H

#include <lambent/lambent.h>

#include "../common/io_file.h"
#include "../common/report.h"

/* How accurately; errors are of light that all surfaces send alike. */
typedef struct bake_settings {
    float error;        /* of a receiver's links */
    float division;     /* of light that is taken to be linear between receivers, as a share of all */
    float cluster_m;    /* triangles under twice this are lit by clusters of that size; 0: by the scene's area */
    float smallest_m;   /* no edge under it is halved; 0: by the scene's area */
    uint32_t elements;  /* a power of 4, up to LMB_TRANSFER_MAX_ELEMENTS */
    uint32_t receivers; /* at most */
    int threads;
} bake_settings;

/* Words that grow. */
typedef struct bake_words {
    uint32_t *data;
    size_t count, cap;
} bake_words;

/* A piece of surface that sends light. */
typedef struct bake_element {
    lmb_vec3 corner[3], middle, normal; /* of several triangles the largest; middle, normal: means */
    float area;    /* m2, of all */
    float largest; /* of its triangles, m2 */
    float reach2;  /* its farthest corner from its middle, squared, m2 */
    float facing;  /* length of the mean normal: 1 for one triangle */
    int is_one;
    int is_dark;   /* no light comes here */
    float light;   /* about how much comes, in any unit */
    uint32_t key, number; /* order along a Z curve; where it was made */
} bake_element;

/* A point that receives light. */
typedef struct bake_receiver {
    lmb_vec3 place, at, normal; /* `at` lies a little inside the triangle at whose corner `place` is */
    uint32_t parent[2]; /* LMB_TRANSFER_NONE: none */
    float *row;         /* what arrives of each element, as the file will have it */
    uint32_t first_link, links;
    float scale;
} bake_receiver;

typedef struct bake {
    bake_settings set;
    const lmb_scene *scene;
    const lmb_kernels *kernels;
    lmb_bvh bvh;
    void *bvh_memory;
    float area;    /* m2, of all that receives */
    float small_m;  /* no edge of a small triangle is longer */
    uint32_t small_count;
    int has_cluster_m; /* the settings say how large clusters are: they do not shrink until there are many */
    int by_middles; /* rows ask for elements' middles alone */
    int is_quiet;

    bake_element *element; /* set.elements; past element_count without area */
    uint32_t element_count;

    bake_receiver *receiver;
    uint32_t receiver_count, receiver_cap;

    bake_words section[LMB_TRANSFER_SECTIONS];
    uint32_t leaves; /* of corners: those of receivers, which come first */
    uint32_t clusters;
} bake;

/* What bake_sees works with; one a thread. */
typedef struct bake_sight {
    lmb_tile *tile;
    lmb_traversal traversal;
} bake_sight;

/* bake_sees: does nothing stand between two points of a plane, just over it?
 * bake_stands_free: does a triangle's middle see its corners so? bake_pulled: a corner, a little towards its middle. */
int bake_sight_begin(bake_sight *s, report *r);
void bake_sight_end(bake_sight *s);
int bake_sees(bake_sight *s, const bake *b, lmb_vec3 from, lmb_vec3 to, lmb_vec3 normal);
int bake_stands_free(bake_sight *s, const bake *b, const lmb_vec3 corner[3], lmb_vec3 normal);
lmb_vec3 bake_pulled(const bake *b, lmb_vec3 at, lmb_vec3 to);

/* All of these return 1, or 0 with `r` set. */

int bake_put(bake_words *w, uint32_t word, report *r);
int bake_put_float(bake_words *w, float v, report *r);

/* The scene's BVH, and elements with the way to them from each triangle. */
int bake_begin(bake *b, const lmb_scene *scene, const bake_settings *set, report *r);
int bake_elements(bake *b, report *r);

/* bake_reach: leave out the sides of surfaces that no way through the scene leads to from its lights and from `eyes`,
 * like the insides of boxes. With neither nothing is left out. */
int bake_reach(bake *b, const lmb_vec3 *eyes, uint32_t count, report *r);

/* bake_rows: what arrives of each element at up to 64 points: form factor times the share that is seen.
 *   row   axes x count rows of set.elements. axes 1: on a plane of the normal; 3: along x, y, z, of what lies
 *         before it */
int bake_rows(const bake *b, const lmb_vec3 *at, const lmb_vec3 *normal, int count, int axes, float *const *row,
              report *r);

/* bake_links: choose nodes whose means stand for a row of elements; axes 1 or 3 rows that share them.
 *   row    becomes what the links say
 *   *count, *scale  what was put into `links`, and a weight's unit */
int bake_links(const bake *b, float *const *row, int axes, bake_words *links, uint32_t *count, float *scale, report *r);

/* bake_surplus: how much a row is at odds with light that is even over nodes of a 64th of the elements. */
float bake_surplus(const bake *b, const float *row);

/* Receivers on large triangles, and clusters on small ones. */
int bake_receivers(bake *b, report *r);
int bake_clusters(bake *b, report *r);

/* bake_key: the side of space that a normal faces, then the place along a Z curve: neighbours have near keys. */
uint32_t bake_key(const lmb_scene *scene, lmb_vec3 at, lmb_vec3 normal);

/* bake_cell: the cell of a grid, `per` a metre, within +-1e9. */
int32_t bake_cell(float at, float per);

int bake_is_small(const bake *b, const lmb_vec3 corner[3]);

int bake_file(file_bytes *out, const bake *b, report *r);
void bake_free(bake *b);

#endif
