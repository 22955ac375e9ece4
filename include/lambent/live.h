/* live.h: bounced light at single points, at a few microseconds a point: for light that moves.                   [ours]
 *
 *     lmb_live_init(&live, faces, side, elements, memory, lmb_live_bytes(faces, side, elements));
 *     lmb_live_collect(&live, ...);       each face of each light's shadow map; then live.faces is set
 *     lmb_live_build(&live, scene);
 *     lmb_live_receive(light, kernels, &scratch, &live, &bvh, &receiver);         at any points, on any threads
 *
 * A point is lit in four steps. A cut of a tree of first points gives the light that they send, without shadows. That
 * sum is divided into strata of equal light, and one first point is taken from each. A segment is traced to each of
 * them, all in one packet from one origin. The sum times the share of the strata that is seen is the light, channel by
 * channel. So the sum has no noise, and only shadows are sampled.
 *
 * The tree lies over cells of the world: first points of all lights that share a cell and a plane are one node, whose
 * area counts once. Where a node is near, its parts count: down to first points, then to texels of the map, then to
 * parts of a texel, until their spacing is a quarter of their distance.
 *
 * A point's light depends on that point, the scene and the maps alone: not on other points, order, threads or lanes.
 *
 * A point in an inner edge, next to lit blocks, is lit a texel of the map off it, if that is on its triangle and the
 * way is free: between a wall's last texel and the edge the map shows the other wall.
 *
 * Elements (lambent/elements.h) may be points of the tree too. Those that emit nothing are divided at half the
 * distance.
 *
 * Missing in builds without trees, and with LMB_LIVE 0. Stability: experimental. */
#ifndef LMB_LIVE_H
#define LMB_LIVE_H

#include "map.h"
#include "occlusion.h"

#define LMB_LIVE_NODES  16   /* of a chunk: logical lanes of every backend */
#define LMB_LIVE_CUT    512  /* chunks of a point's cut */
#define LMB_LIVE_NEAR   96   /* of these, chunks that are made for one point: what lies near it */
#define LMB_LIVE_STRATA 64   /* segments of a point, at most */
#define LMB_LIVE_STACK  256  /* nodes of the BVH that wait */
#define LMB_LIVE_LAST   4    /* triangles that blocked much */

/* A first point: what one block of a map's texels shows at one of them, taken by a hash. 56 bytes. */
typedef struct lmb_live_point {
    lmb_vec3 position, normal; /* m; unit, on the lit side */
    float flux[3];             /* outgoing Lambertian power of the block, W; all 0: no first point */
    float area;                /* of the block on the surface, m2 */
    uint32_t id;               /* the triangle */
    uint32_t key;              /* its cell of the world and its side, once the tree is built */
    uint16_t column, row;      /* the block */
    uint16_t face, light;      /* LMB_LIVE_ELEMENT as the face: column + 65,536 row is an element */
} lmb_live_point;
#define LMB_LIVE_ELEMENT 0xffffu

/* One face of a light's shadow map, as it was collected. */
typedef struct lmb_live_face {
    lmb_view view;
    lmb_surface id;   /* the map's, which stays where it is while points are lit */
    int32_t size, each; /* texels of the map a side, and of a block */
    uint32_t light;
} lmb_live_face;

/* Where a segment ends: a first point. */
typedef struct lmb_live_target {
    float at[3], facet[3]; /* m; the normal of its triangle, on the lit side */
    float colour[3];       /* flux by power */
    uint32_t id;           /* its triangle */
} lmb_live_target;

/* Sixteen nodes side by side. 1,536 bytes. A node with `count` 0 has no parts; those of one with LMB_LIVE_LEAF are the
 * first points first .. first + count - 1, those of others are nodes: `first` is 16 times a chunk plus a lane. */
typedef struct lmb_live_chunk {
    float place[3][LMB_LIVE_NODES], normal[3][LMB_LIVE_NODES]; /* means by power */
    float area[LMB_LIVE_NODES];    /* m2; of all lights' first points, each place once */
    float power[LMB_LIVE_NODES];   /* W, mean of R, G, B; 0: nothing */
    float radius2[LMB_LIVE_NODES]; /* m2, of the place to its farthest first point, and the square of their spacing */
    float colour[3][LMB_LIVE_NODES]; /* flux by power */
    uint32_t first[LMB_LIVE_NODES], count[LMB_LIVE_NODES];
    lmb_live_target target[LMB_LIVE_NODES]; /* the first point nearest to `place`, with the node's colour */
} lmb_live_chunk;
#define LMB_LIVE_LEAF 0x80000000u /* in `count` */

/* The tree, in the caller's memory. */
typedef struct lmb_live {
    const lmb_scene *scene; /* that it was built from */
    lmb_live_face *face;
    lmb_live_point *point;  /* face_cap x side x side: each block has its own place; then element_cap of elements */
    const struct lmb_element *element; /* whose shapes they have */
    lmb_live_point *sorted; /* those that are lit, along the cells */
    lmb_live_chunk *chunk;  /* those of the top first */
    uint32_t face_cap, faces, chunk_cap, chunks, top; /* top: nodes of the first level */
    uint32_t element_cap, elements; /* points of elements */
    uint32_t points;        /* sorted */
    uint32_t merged;        /* nodes whose parts found no room: they count whole, until a point is near */
    int32_t side;           /* blocks a side of a face, at most */
    int32_t strata;         /* 1 .. LMB_LIVE_STRATA; 64 */
    double sent[3];         /* flux of the maps' first points, W */
    float split;            /* a node is divided at points nearer than the root of this times its radius; 16 */
} lmb_live;

/* What is lit. */
typedef struct lmb_live_receiver {
    lmb_vec3 position, face, normal; /* unit: of the triangle, and by which it is lit; both towards the viewer */
    uint32_t id;  /* its triangle, which does not shade it; 0: none */
    float noise;  /* m: how far rounding may have put it off its surface: lmb_place_noise */
    lmb_vec3 to_eye; /* towards who sees it, any length: which side of a plane it is on that it lies in; 0: no one */
} lmb_live_receiver;

/* A point's segments. */
typedef struct lmb_live_rays {
    lmb_segments segments;                      /* from the receiver */
    float to[3][LMB_TILE_PIXELS];               /* m, from there to the targets */
    float facet[3][LMB_TILE_PIXELS];            /* normals of the targets */
    float colour[3][LMB_TILE_PIXELS];           /* what a stratum has of each channel, by its mean */
    uint32_t id[LMB_TILE_PIXELS];               /* the targets' triangles */
} lmb_live_rays;

/* A node of the BVH that waits, and the segments that meet it. */
typedef struct lmb_live_branch {
    uint64_t rays;
    uint32_t node;
} lmb_live_branch;

/* One a thread: 199 KiB. Its contents mean nothing between calls, but for `full`, `segments` and `pairs`, which are
 * added to, and `whole` and `seen`, which are those of the last point. */
typedef struct lmb_live_scratch {
    float value[LMB_LIVE_CUT][LMB_LIVE_NODES]; /* light of each node without shadows; 0 where its parts give it */
    float sum[LMB_LIVE_CUT];
    const lmb_live_chunk *chunk[LMB_LIVE_CUT];
    uint16_t asked[LMB_LIVE_CUT];              /* of the chunk's nodes, a bit each */
    int32_t count, done;                       /* chunks of the cut, and those summed */
    lmb_live_chunk near[LMB_LIVE_NEAR];
    uint32_t part[LMB_LIVE_NEAR][LMB_LIVE_NODES]; /* which part of a first point each of their nodes is */
    int32_t near_count, near_lane;             /* chunks of them that are begun, and nodes of the last one */
    uint32_t leaf[LMB_LIVE_CUT];               /* nodes that were near and have no nodes below: 16 times the chunk's */
    int32_t leaves;                            /* number in the cut, plus the lane */
    int32_t targets, is_full;
    lmb_vec3 off;      /* m, from an inner edge that the receiver lies in, */
    float lift;        /* and how far that is from the surface it meets there; 0: nowhere */
    lmb_live_rays rays;
    lmb_live_branch waiting[LMB_LIVE_STACK];
    uint32_t last[LMB_LIVE_LAST]; /* of the BVH, plus 1: those that blocked much lately, which are tested first */
    lmb_target window; /* what src/frame draws meanwhile */
    uint32_t full;     /* points whose cut found no room: nodes near them counted whole */
    uint64_t segments, pairs;
    float whole[3]; /* the light without shadows */
    float seen[3]; /* the share that shadows leave of each channel; -1: there is no light to shade */
} lmb_live_scratch;

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_live_side: blocks a side of a map of `size` texels a side, over `faces` faces: one of each 4 x 4 texels, or 8 x 8
 * where that would be over 2^18 blocks in all. */
int32_t lmb_live_side(uint32_t faces, int32_t size);

/* lmb_live_bytes: memory for `faces` faces of side x side blocks and 0 .. 2^24 elements; 0 where that cannot be. 232
 * bytes a block or element.
 * lmb_live_init: lay a tree out in it, aligned as for a uint64_t. LMB_OK, LMB_ERR_ARG, LMB_ERR_ALIGN or
 * LMB_ERR_CAPACITY. */
size_t lmb_live_bytes(uint32_t faces, int32_t side, uint32_t elements);
lmb_status lmb_live_init(lmb_live *out, uint32_t faces, int32_t side, uint32_t elements, void *memory, size_t bytes);

/* lmb_live_collect: the first points of the map's tile rows first .. past - 1 of one face, as face `into` of the tree:
 * those of the rows of 8 blocks that begin there. Rows may be collected in any order, at once on any threads. A block
 * has the whole light that goes through it, at one of its texels: so surfaces that share a block get it in turns, each
 * as often as it shows.
 *   light  of scene->lights.
 * Returns LMB_OK, LMB_ERR_ARG, or LMB_ERR_CAPACITY (no such face; more blocks than there is room for). */
lmb_status lmb_live_collect(const lmb_live *live, const lmb_kernels *kernels, lmb_tile *scratch,
                            const lmb_scene *scene, uint32_t light, const lmb_shadow_map *map, int32_t face,
                            uint32_t into, int32_t first, int32_t past);

/* lmb_live_build: the tree over the first points of faces 0 .. live->faces - 1 and live->elements elements. Where nodes
 * run out, those that are
 * left undivided count whole (live->merged), and near points still see their first points. LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_live_build(lmb_live *live, const lmb_scene *scene);

/* lmb_live_receive: set the light of a receiver, W/m2.
 *
 *   bvh  what may stand between; NULL: nothing.
 * A triangle blocks a segment that crosses it before .99999 of its length; the target's and the receiver's own ones do
 * not. A receiver that lies in a triangle's plane, to within rounding, counts as on the eye's side of it. A target
 * counts only if the receiver is in front of its facet, and it over the receiver's horizon. A segment meets a box of
 * the BVH by one formula, whatever packet it is in.
 * Returns LMB_OK or LMB_ERR_ARG. Cost: 1 to 10 us. Stack: under 4 KiB. */
lmb_status lmb_live_receive(float light[3], const lmb_kernels *kernels, lmb_live_scratch *scratch,
                            const lmb_live *live, const lmb_bvh *bvh, const lmb_live_receiver *receiver);

#ifdef __cplusplus
}
#endif
#endif
