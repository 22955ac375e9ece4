/* tree.h: the shadow map as a tree; each tile of pixels takes a cut of its own. [V3 V6 V15 V27]
 *
 * Every lit texel of a map is a first point; four make a node, four nodes the next, up to one node a face. Sums go
 * upward from the finest texels, so no flux is lost, and a fine map costs more only at the pixels near its texels. A
 * tile starts at the roots and splits nodes until their estimated error is under `error` times their light.
 *
 * Stability: experimental. Tags like [V3] are requirements in src/SOURCES.md. */
#ifndef LMB_TREE_H
#define LMB_TREE_H

#include "bounce.h"
#include "occlusion.h"

/* A first point. 44 bytes. */
typedef struct lmb_texel {
    lmb_vec3 position, normal; /* m; unit, on the lit side */
    float flux[3];             /* outgoing Lambertian power, W; all 0: no first point */
    uint8_t side[4];           /* extent of the surface from the texel's middle, left, right, up and down, in 1/256
                                  texel: 128 reaches the texel's edge; else the line where the plane meets the
                                  neighbour's plane. side[0] 0: several surfaces show, and the rest says which */
    float share;               /* if a side is not 128: share of the flux that the exact shape has; under 0: use the
                                  sides */
} lmb_texel;

/* The first points of a square of texels. 92 bytes.
 *
 * The box has sides along the normal, along `across`, and along normal x across, so the bounds do not depend on the
 * world's rotation. */
typedef struct lmb_node {
    lmb_vec3 centre, normal; /* means, weighted by flux; normal of unit length */
    float flux[3], area;     /* sums, W and m2; flux 0: empty */
    lmb_vec3 middle, across; /* of the box of their quads; across: unit, perpendicular to the normal */
    float half[3];           /* half sides of the box, m */
    float radius;            /* m: all first points lie within this distance of `middle` */
    float cosine;            /* of the largest angle between their normals and the mean; -1: any */
    float agreement;         /* length of the normals' mean, weighted by flux: 1 if all are equal, else less */
    uint32_t texel;          /* one first point, near the centre: visibility is tested towards it */
} lmb_node;

/* The tree, in your memory. The faces are those of all shadow maps, in order. */
typedef struct lmb_tree {
    lmb_texel *texel; /* face_cap x size x size, row by row */
    lmb_node *node;   /* face_cap x (size^2 - 1) / 3: of each face the level of size / 2 first, the root last */
    lmb_view *view;   /* face_cap */
    const struct lmb_element *element; /* NULL; or the elements that replace the texels, along a Z curve */
    int32_t size;     /* texels a side: a power of two */
    uint32_t face_cap, faces;
    int32_t tests;    /* 1: cuts test visibility, so steep planes at sharp edges are drawn by their triangles; set it
                         before lmb_tree_texels. Frames set it */
} lmb_tree;

/* A node of a tile's cut, prepared for the gather. */
typedef struct lmb_emitter {
    lmb_vec3 position, back; /* back: the reversed normal */
    float area_pi;           /* area / pi */
    float flux[3];
    uint64_t visible; /* the pixels that see the node, a bit each */
} lmb_emitter;

/* A node of the tree; level 0: texels. */
typedef struct lmb_node_ref {
    uint16_t face, x, y, level;
} lmb_node_ref;

enum { LMB_CUT_BUCKETS = 512 };

/* The index of a node in a cut, or -1. */
#if LMB_MAX_CUT < 32768
typedef int16_t lmb_cut_slot;
#else
typedef int32_t lmb_cut_slot;
#endif

/* One tile's cut; one a thread. */
typedef struct lmb_cut {
    int32_t count;                     /* nodes, including those that were split */
    int32_t tests_left;                /* visibility tests left to the tile: see lmb_traversal */
    uint32_t tests;                    /* those of the tile so far */
    uint32_t coarse;                   /* calls with a coarse answer: see lmb_traversal */
    uint64_t visible[LMB_MAX_CUT];     /* the pixels that see the node, a bit each */
    lmb_node_ref ref[LMB_MAX_CUT];
    float value[LMB_MAX_CUT];          /* irradiance of the pixels that see the node, W/m2, R + G + B */
    float upper[LMB_MAX_CUT];          /* upper bound of `value` */
    union {
        float error[LMB_MAX_CUT];      /* of a node that a pixel sees: estimated error of using it as one disc */
        uint32_t blocker[LMB_MAX_CUT]; /* of a node that no pixel sees: a triangle that blocked one, + 1; 0: unknown */
    } of;
    lmb_cut_slot next[LMB_MAX_CUT];    /* the next node in its bucket */
    lmb_cut_slot bucket[LMB_CUT_BUCKETS]; /* the first node of each; buckets are sorted by exponent and first bit */
    union {
        struct {
            float bounds[23][LMB_BOUNDS_NODES]; /* nodes side by side; src/tree/node_bounds.inl lists the planes */
            lmb_emitter emitter[LMB_CUT_BLOCK]; /* nodes that wait until the kernel takes them together */
        } nodes;
        uint64_t facets[366]; /* while no node waits: surfaces of a texel that shows several: src/tree/facets.h */
    } with;
    union {
        float pairs[3][LMB_GATHER_PAIRS]; /* while the cut lights pixels */
        lmb_traversal traversal;          /* while the cut is found */
    } use;
} lmb_cut;

/* Parameters of a tile's cut. */
typedef struct lmb_cut_params {
    float error;          /* allowed error of bounced light, ignoring occlusion, as a share of the pixel's light: the
                             root of the sum of the nodes' squared errors; conservative: the sum of the errors */
    float visibility;     /* largest share of a pixel's light tested by one visibility ray */
    float floor;          /* W/m2, R + G + B: an error below this is accepted, whatever the share; ignored with
                             `conservative` */
    int32_t conservative; /* 1: `error` is a bound that no pixel exceeds, ignoring occlusion, however many nodes that
                             takes; 0: a rule that holds for all but a few pixels, with a tenth of the nodes */
    const lmb_bvh *bvh;           /* NULL: nothing blocks */
    lmb_stats *stats;             /* counts pairs and segments; may be NULL */
    const lmb_irradiance *direct; /* or NULL: direct light that is shown with the bounced light: counts as a pixel's
                                     light, with the minimum over the pixels that share a cut */
    const lmb_irradiance *beside; /* or NULL: further light of the pixels, for `error` and `visibility`; may be the
                                     irradiance that is added to */
    float lower;                  /* light that every pixel has in addition, W/m2, R + G + B */
    lmb_glossy *glossy;           /* the tile's lobes, to which the reflection of the nodes is added; NULL: none */
    const lmb_view *view;         /* the pixels' view: a pixel within rounding of a wall's plane counts as on the eye's
                                     side. NULL: such a pixel gets no light from that wall */
    int32_t tests;                /* visibility tests before the light becomes coarser, LMB_TRAVERSAL_FIRST at most: see
                                     lmb_traversal. A share of them also gets that share of nodes. 0: the most.
                                     A tile adds M tests to `saved`, and ends at most at 5 M + `saved`, whatever its
                                     calls add. M is 4.4 million, times .015 / `visibility` for a smaller one */
    int64_t *saved;               /* tests that earlier tiles of the row saved, or minus those that they borrowed; 0 at
                                     the row's start; updated. NULL: the tile shares tests with none */
} lmb_cut_params;

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_tree_bytes: memory of a tree of `faces` faces of size x size texels; 0 if that is impossible. */
size_t lmb_tree_bytes(uint32_t faces, int32_t size);

/* lmb_tree_init: lay out a tree in `memory`; size: a power of two, 8 .. 4096. Returns LMB_OK, LMB_ERR_ARG,
 * LMB_ERR_ALIGN or LMB_ERR_CAPACITY. */
lmb_status lmb_tree_init(lmb_tree *out, uint32_t faces, int32_t size, void *memory, size_t bytes);

/* lmb_tree_texels: write the first points of the tile rows first .. past - 1 of one face of a shadow map into face
 * `into` of the tree. A map of 2, 4 or 8 times the tree's size gives one texel for each 2 x 2, 4 x 4 or 8 x 8 of the
 * map: a point of the surface that shows in their middle. If surfaces hide each other there, texels alternate between
 * them in proportion to their visible area, and near receivers get light from each. So you can use fine maps, for sharp
 * shadows, without as many first points. lmb_gather_cut with a BVH reads the ids of such a map again, so keep the map.
 * The BVH must be of the scene that the map shows, with the same ids.
 * Rows may be done in any order, on any threads. Returns LMB_OK, LMB_ERR_ARG or LMB_ERR_CAPACITY. */
lmb_status lmb_tree_texels(const lmb_tree *tree, const lmb_kernels *kernels, lmb_tile *scratch, const lmb_scene *scene,
                           const lmb_light *light, const lmb_shadow_map *map, int32_t face, uint32_t into,
                           int32_t first, int32_t past);

/* lmb_tree_sum: sum the nodes of one face from the first points, once all rows are there. Returns LMB_OK or
 * LMB_ERR_ARG. */
lmb_status lmb_tree_sum(const lmb_tree *tree, uint32_t face);

/* lmb_gather_cut: add the light of the tree's first points to a tile's pixels.                            [V25 V27 V28]
 *
 * The tile's pixels are split by surface, and each cluster takes a cut of its own: the node with the largest error is
 * replaced by the four children until the root of the sum of squared errors is at most cut_params->error times the
 * light of all nodes. A node's error is the upper bound U of the node's light times the second order of size and bend:
 * U min(1, R^2 / 2 d^2 + sin^2 a), and at least a quarter of U if a horizon goes through the node. If LMB_MAX_CUT nodes
 * are not enough, each half of the pixels takes a cut of its own, as long as that reduces the error; else the pixels
 * are lit by the nodes there are, and stats->full_cuts counts such clusters. Visibility is tested from every pixel
 * towards one texel of each node, which faces the pixels. Texels near a pixel count as exact quads.
 * Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_gather_cut(lmb_irradiance *inout, const lmb_kernels *kernels, lmb_cut *scratch, const lmb_tile *tile,
                          const lmb_tree *tree, const lmb_cut_params *cut_params);

#ifdef __cplusplus
}
#endif
#endif
