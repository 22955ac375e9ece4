/* tree.h: the shadow map as a tree, of which each tile of pixels takes its own cut. [V3 V6 V15 V27]
 *
 * Every lit texel of a map is a first point; four make a node, four nodes the next, up to one a face. Sums go upward
 * from the finest texels, so no flux is lost and a fine map costs pixels only where they are near it. A tile goes down
 * until what its nodes may be wrong by is under `error` of what they give. */
#ifndef LMB_TREE_H
#define LMB_TREE_H

#include "bounce.h"
#include "occlusion.h"

/* A first point. 40 bytes. */
typedef struct lmb_texel {
    lmb_vec3 position, normal; /* m; unit, on the lit side */
    float flux[3];             /* outgoing Lambertian power, W; all 0: no first point */
    uint8_t side[4];           /* how far its surface goes on from its middle: left, right, up, down, in 1/256: 128
                                  of a whole one; else to where its plane meets its neighbour's */
} lmb_texel;

/* The first points of a square of texels. 96 bytes.
 *
 * Its box has sides along the normal, along `across`, and along normal x across: so what is asked of it does not depend
 * on how the world is turned. */
typedef struct lmb_node {
    lmb_vec3 centre, normal; /* means, weighted by flux; normal of unit length */
    float flux[3], area;     /* sums, W and m2; flux 0: nothing */
    lmb_vec3 middle, across; /* of the box of their quads; across: unit, at right angles to the normal */
    float half[3];           /* half the box's sides, m */
    float radius;            /* m: all of them lie as near to `middle` */
    float cosine;            /* of the widest angle between their normals and the mean; -1: any */
    float agreement;         /* length of the normals' mean, weighted by flux: 1 where all are the same, else less */
    uint32_t texel;          /* one of them, near the centre: where visibility is asked for */
} lmb_node;

/* The caller's memory, shared out. Face f of all shadow maps, in order. */
typedef struct lmb_tree {
    lmb_texel *texel; /* face_cap x size x size, row by row */
    lmb_node *node;   /* face_cap x (size^2 - 1) / 3: of each face the level of size / 2 first, its root last */
    lmb_view *view;   /* face_cap */
    const struct lmb_element *element; /* what the texels are, along the Z curve, where they are no texels of maps */
    int32_t size;     /* texels a side: a power of two */
    uint32_t face_cap, faces;
} lmb_tree;

/* A node of a tile's cut, made ready for the gather. */
typedef struct lmb_emitter {
    lmb_vec3 position, back; /* back: against its normal */
    float area_pi;           /* area / pi */
    float flux[3];
    uint64_t visible; /* the pixels that see it, a bit each */
} lmb_emitter;

/* Where a node is: level 0 are texels. */
typedef struct lmb_node_ref {
    uint16_t face, x, y, level;
} lmb_node_ref;

enum { LMB_CUT_BUCKETS = 512 };

/* One tile's cut; one a thread. */
typedef struct lmb_cut {
    int32_t count;                     /* nodes, of which some are gone */
    uint64_t visible[LMB_MAX_CUT];     /* the pixels that see it, a bit each */
    lmb_node_ref ref[LMB_MAX_CUT];
    float value[LMB_MAX_CUT];          /* what it gives where it is seen, W/m2 */
    float upper[LMB_MAX_CUT];           /* the most that it can give */
    float error[LMB_MAX_CUT];          /* what it may be wrong by as one disc */
    int32_t next[LMB_MAX_CUT];         /* in its bucket */
    int32_t bucket[LMB_CUT_BUCKETS];   /* the first of each, by exponent and first bit */
    float bounds_of_nodes[23][LMB_BOUNDS_NODES]; /* nodes side by side; what the planes are is src/bounce's own */
    lmb_emitter emitter[LMB_CUT_BLOCK];
    union {
        float pairs[3][LMB_GATHER_PAIRS]; /* while it lights */
        lmb_traversal traversal;          /* while it is taken */
    } use;
} lmb_cut;

/* How tiles take their cut. */
typedef struct lmb_cut_params {
    float error; /* share of a pixel's light that what bounces may be wrong by where nothing blocks: the root of the
                      nodes' errors' squares; conservative: of their sum */
    float visibility; /* share that no node may exceed whose visibility is asked as one */
    float floor;   /* W/m2, R + G + B: what is wrong by less than this is right, whatever its share; conservative: not
                      used */
    int32_t
        conservative; /* 1: `error` is a bound that no pixel exceeds where nothing blocks, by any number of nodes; 0:
                         rule
                       that holds for all but a few pixels, by a tenth of them */
    const lmb_bvh *bvh;           /* NULL: everything is seen */
    lmb_stats *stats;             /* counts pairs and segments; may be NULL */
    const lmb_irradiance *direct; /* shown together with what bounces: counts to a pixel's light, by the least of the
                                     pixels that take a cut together; or NULL */
    const lmb_irradiance *beside; /* counts to a pixel's light too, for both shares; may be what is added to; or NULL */
    float lower;                  /* so does this, W/m2, R + G + B */
    lmb_glossy *glossy;           /* the tile's lobes: what they make of the nodes is added; NULL: none */
} lmb_cut_params;

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_tree_bytes: memory of a tree of `faces` faces of size x size texels; 0 where that cannot be. */
size_t lmb_tree_bytes(uint32_t faces, int32_t size);

/* lmb_tree_init: share out `memory`; size: a power of two, 8 .. 4096. LMB_OK, LMB_ERR_ARG, LMB_ERR_ALIGN,
 * LMB_ERR_CAPACITY. */
lmb_status lmb_tree_init(lmb_tree *out, uint32_t faces, int32_t size, void *memory, size_t bytes);

/* lmb_tree_texels: the first points of the tile rows first .. past - 1 of one face of a shadow map, into face `into`
 * of the tree. A map of 2, 4 or 8 times the tree's size gives one texel of 2 x 2, 4 x 4 or 8 x 8: of the surface in
 * their middle, and there; or, where others hide it or are hidden by it, of one of these, as often as it shows. A fine
 * map makes sharp shadows, which do not ask for as many first points.
 * Rows may be taken in any order, at once on any threads. LMB_OK, LMB_ERR_ARG or LMB_ERR_CAPACITY. */
lmb_status lmb_tree_texels(const lmb_tree *tree, const lmb_kernels *kernels, lmb_tile *scratch, const lmb_scene *scene,
                           const lmb_light *light, const lmb_shadow_map *map, int32_t face, uint32_t into,
                           int32_t first, int32_t past);

/* lmb_tree_sum: the nodes of one face, from its first points, once all its rows are there. */
lmb_status lmb_tree_sum(const lmb_tree *tree, uint32_t face);

/* lmb_gather_cut: add what the tree's first points light to a tile's pixels.                          [V25 V27 V28]
 *
 * The tile is split by surfaces; each takes its own cut: the node with the largest error is replaced by its four until
 * the root of the errors' squares' sum is at most cut_params->error of the sum of what they give. A node's error is the
 * most it can give, times the second order of its size and bend: U min(1, R^2 / 2 d^2 + sin^2 a), and at least a
 * quarter of it where a horizon goes through the node. Where LMB_MAX_CUT nodes are not enough, each half of the pixels
 * takes a cut of its own, while that comes closer; else the pixels are lit by the nodes there are, and stats->full_cuts
 * counts. Visibility: one texel of each node that faces the pixels, from every pixel. Texels near a pixel count as
 * their exact quads.
 * Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_gather_cut(lmb_irradiance *inout, const lmb_kernels *kernels, lmb_cut *scratch, const lmb_tile *tile,
                          const lmb_tree *tree, const lmb_cut_params *cut_params);

#ifdef __cplusplus
}
#endif
#endif
