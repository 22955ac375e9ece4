/* live.h: bounced light at single points, a few microseconds each: for lights that move.                   [ours]
 *
 *     lmb_live_init(&live, faces, side, elements, memory, lmb_live_bytes(faces, side, elements));
 *     lmb_live_collect(&live, ...);       each face of each light's shadow map; then set live.faces
 *     lmb_live_build(&live, scene);
 *     lmb_live_receive(light, kernels, &scratch, &live, &bvh, &receiver);         at any points, on any threads
 *
 * A point is lit in four steps. A cut of a tree of first points gives their unoccluded light. That sum is divided into
 * strata of equal light, and one first point is taken from each. A segment is traced to each of them, all in one packet
 * from one origin. The light is the sum times the visible share of the strata, channel by channel. So the sum has no
 * noise, and only shadows are sampled.
 *
 * The tree is built over cells of the world: first points of all lights that share a cell and a plane are one node, in
 * which shared area counts once. Crowded cells are divided further. If a node is near, the parts are used: down to
 * first points, then to texels of the map, then to parts of a texel, until their spacing is a quarter of their
 * distance.
 *
 * A point's light depends only on that point, the scene and the maps: not on other points, order, threads or lanes.
 *
 * A point in a concave edge, next to lit blocks, is lit as if it lay a texel of the map away from the edge, if the
 * point's triangle extends that far and no triangle is in between. Otherwise it would be dark: between a wall's last
 * texel and the edge the map shows the other wall.
 *
 * Elements (lambent/elements.h) can be points of the tree too. Elements that do not emit are divided at half the
 * distance.
 *
 * Lights at infinity (lmb_many_lights_sky) have a tree of their own, so they are sampled by segments of their own, and
 * the light of a bright sky does not make the shadows of bounced light noisy.
 *
 * Missing in builds without trees, and with LMB_LIVE 0. Stability: experimental. */
#ifndef LMB_LIVE_H
#define LMB_LIVE_H

#include "map.h"
#include "occlusion.h"

#define LMB_LIVE_NODES  16   /* of a chunk: logical lanes of every backend */
#if LMB_LIVE_SMALL /* the other branch explains each number */
#define LMB_LIVE_NEAR   12
#define LMB_LIVE_KEPT   2
#define LMB_LIVE_FACETS 8
#define LMB_LIVE_PICKS  64
#define LMB_LIVE_STACK  64
#define LMB_LIVE_KNOWN  64
#else
#define LMB_LIVE_NEAR   96   /* chunks of a cut that are made for one point, of parts near it */
#define LMB_LIVE_KEPT   128  /* such chunks that are kept for other points */
#define LMB_LIVE_FACETS 32   /* facets of near parts that are kept */
#define LMB_LIVE_PICKS  512  /* maximum number of segments of a steady point */
#define LMB_LIVE_STACK  256  /* BVH nodes on the stack */
#define LMB_LIVE_KNOWN  64   /* triangles of small nodes (lmb_bvh.small) that are kept */
#endif
#define LMB_LIVE_STRATA 64   /* maximum number of segments of a point */
#define LMB_LIVE_LAST   4    /* triangles that blocked many segments recently */
#define LMB_LIVE_SKY    64   /* maximum number of chunks of a sky */

/* A first point. A hash selects one texel to represent a block of the map, 4 x 4 or 8 x 8 texels. If 4 x 4 blocks show
 * one triangle, one texel represents 2 x 2 of them. If a block is not flat, each of up to four surfaces has a point. 60
 * bytes. */
typedef struct lmb_live_point {
    lmb_vec3 position, normal; /* m; unit, on the lit side */
    float flux[3];             /* outgoing Lambertian power of the blocks or parts, W; all 0: no first point */
    float area;                /* of these on the surface, m2 */
    uint32_t id;               /* the triangle */
    uint32_t key;              /* cell of the world and side, once the tree is built */
    uint16_t column, row;      /* the first block */
    uint16_t face;             /* LMB_LIVE_ELEMENT: column + 65,536 row is an element */
    uint8_t light, wide;       /* wide: blocks a side: 1 or 2 */
    uint16_t shows;            /* bit i: part i of the block's 4 x 4 parts belongs to this point */
} lmb_live_point;
#define LMB_LIVE_ELEMENT 0xffffu

/* One face of a light's shadow map, as it was collected. */
typedef struct lmb_live_face {
    lmb_view view;
    lmb_surface id;   /* of the map; do not move it while you light points */
    int32_t size, each; /* texels of the map a side, and of a block */
    uint32_t light;
} lmb_live_face;

/* The end of a segment: a first point. */
typedef struct lmb_live_target {
    float at[3], facet[3]; /* m; the normal of the triangle, on the lit side */
    float colour[3];       /* flux by power */
    uint32_t id;           /* the triangle */
} lmb_live_target;

/* Sixteen nodes side by side. 1,600 bytes. A node with `count` 0 has no parts. The parts of a node with LMB_LIVE_LEAF
 * are the first points first .. first + count - 1; those of other nodes are nodes: `first` is 16 times a chunk plus a
 * lane. */
typedef struct lmb_live_chunk {
    float place[3][LMB_LIVE_NODES], normal[3][LMB_LIVE_NODES]; /* means by power */
    float area[LMB_LIVE_NODES];    /* m2; of all lights' first points, each place once */
    float power[LMB_LIVE_NODES];   /* W, mean of R, G, B; 0: nothing */
    float radius2[LMB_LIVE_NODES]; /* m2: squared distance from `place` to the farthest first point, plus the squared
                                      spacing */
    float colour[3][LMB_LIVE_NODES]; /* flux by power */
    uint32_t first[LMB_LIVE_NODES], count[LMB_LIVE_NODES];
    float threshold[LMB_LIVE_NODES]; /* 0 .. 1, from the cell of the world and the side: decides when a steady point
                                        traces a segment to the node */
    lmb_live_target target[LMB_LIVE_NODES]; /* the first point nearest to `place`, with the node's colour */
} lmb_live_chunk;
#define LMB_LIVE_LEAF 0x80000000u /* in `count` */

/* A light at infinity. 16 bytes. */
typedef struct lmb_live_sun {
    lmb_vec3 toward; /* unit */
    float upto;      /* W/m2: power of the node's suns up to this one, included */
} lmb_live_sun;

/* Sixteen parts of a sky side by side. 576 bytes. A node's suns are first .. first + count - 1. */
typedef struct lmb_live_suns {
    float toward[3][LMB_LIVE_NODES]; /* mean of the directions by power, so not longer than 1 */
    float power[LMB_LIVE_NODES];     /* W/m2, mean of R, G, B; 0: nothing */
    float colour[3][LMB_LIVE_NODES]; /* W/m2 by power */
    uint32_t first[LMB_LIVE_NODES], count[LMB_LIVE_NODES];
} lmb_live_suns;

/* Lights at infinity, in your memory. */
typedef struct lmb_live_sky {
    lmb_live_suns *chunk; /* LMB_LIVE_SKY of them */
    lmb_live_sun *sun;
    uint32_t sun_cap, chunks;
    int32_t strata; /* 1 .. LMB_LIVE_STRATA: segments of a packet; default 64 */
    float reach;    /* m: length of a segment, which ends outside the scene */
} lmb_live_sky;

/* The tree, in your memory. */
typedef struct lmb_live {
    const lmb_scene *scene; /* the scene that it was built from */
    lmb_live_face *face;
    lmb_live_point *point;  /* face_cap x side x side: a slot for each block, in each row the lit ones first, then a
                               dark one; then 64 slots for further surfaces of each group of 8 x 8 blocks; then
                               element_cap of elements */
    const struct lmb_element *element; /* shapes of the element points */
    const lmb_live_sky *sky; /* adds its light; NULL: none */
    lmb_live_point *sorted; /* the lit ones, in the order of the cells */
    lmb_live_chunk *chunk;  /* first the chunks of the top level */
    uint32_t face_cap, faces, chunk_cap, chunks, top; /* top: nodes of the top level */
    uint32_t element_cap, elements; /* points of elements */
    uint32_t points;        /* sorted */
    uint32_t merged;        /* nodes that are not divided because memory ran out: used whole until a point is near */
    int32_t side;           /* blocks a side of a face, at most */
    int32_t strata;         /* 1 .. LMB_LIVE_STRATA; default 64 */
    int32_t steady;         /* 1: lights and receivers may move a little without a jump of the light, for about twice
                               as many segments; set it before lmb_live_build. Default 0 */
    int32_t built;          /* 1 + steady of the last lmb_live_build; 0: none */
    double sent[3];         /* flux of the maps' first points, W */
    float split;            /* a node is divided at points nearer than sqrt(split) times the radius; default 16 */
} lmb_live;

/* The point to light. */
typedef struct lmb_live_receiver {
    lmb_vec3 position, face, normal; /* unit: of the triangle, and the shading normal; both towards the viewer */
    uint32_t id;  /* the triangle, which does not shadow it; 0: none */
    float noise;  /* m: largest distance from the surface that rounding may cause: lmb_place_noise */
    lmb_vec3 to_eye; /* towards the viewer, any length: decides the side of a plane that the point lies in; 0: no
                        viewer */
    float turn; /* 0 .. 1: shifts the segments towards a sky. Let neighbours differ, and average their shares */
} lmb_live_receiver;

/* A point's segments. */
typedef struct lmb_live_rays {
    lmb_segments segments;                      /* from the receiver */
    float to[3][LMB_TILE_PIXELS];               /* m, from the receiver to the targets */
    float facet[3][LMB_TILE_PIXELS];            /* normals of the targets */
    float colour[3][LMB_TILE_PIXELS];           /* a stratum's share of each channel, divided by the mean share */
    uint32_t id[LMB_TILE_PIXELS];               /* the targets' triangles */
} lmb_live_rays;

/* A triangle in a map, with a unit normal on the lit side, and the vectors that give barycentrics. */
typedef struct lmb_live_facet {
    uint32_t id, face; /* 0: none; of the tree */
    lmb_vec3 corner, normal, side[2], along[2];
} lmb_live_facet;

/* A target of a steady point: a node, and the strata of light that it stands for. */
typedef struct lmb_live_pick {
    const lmb_live_chunk *chunk;
    int32_t lane;
    float weight;
} lmb_live_pick;

/* A BVH node on the stack, and the segments that hit it. */
typedef struct lmb_live_branch {
    uint64_t rays;
    uint32_t node;
} lmb_live_branch;

/* Scratch, one a thread: 428 KiB, or 37 with LMB_LIVE_CUT 64. The contents are undefined between
 * calls, except `full`, `segments` and `pairs`, to which calls add until you zero them, and `whole`, `seen` and
 * `sky_...`, which are those of the last point. */
typedef struct lmb_live_scratch {
    lmb_live_chunk near[LMB_LIVE_KEPT + LMB_LIVE_NEAR]; /* kept ones first */
    float value[LMB_LIVE_CUT][LMB_LIVE_NODES]; /* unoccluded light of each node; 0 if the parts are used */
    float sum[LMB_LIVE_CUT];
    const lmb_live_chunk *chunk[LMB_LIVE_CUT];
    uint16_t asked[LMB_LIVE_CUT];              /* used nodes of the chunk, a bit each */
    int32_t count, done;                       /* chunks of the cut, and those summed */
    uint32_t part[LMB_LIVE_KEPT + LMB_LIVE_NEAR][LMB_LIVE_NODES]; /* the part of a first point that each of their nodes
                                                                     is */
    int32_t near_count, near_lane;             /* chunks of `near` in use, and nodes of the last one */
    uint64_t kept[LMB_LIVE_KEPT];              /* first point and part; all ones: none */
    uint32_t kept_for[LMB_LIVE_KEPT];          /* the number of the last point that used it */
    uint16_t kept_nodes[LMB_LIVE_KEPT];        /* a bit each */
    uint32_t number, keeps;                    /* of the current point; 1: chunks are kept */
    lmb_live_facet facet[LMB_LIVE_FACETS];
    uint32_t leaf[LMB_LIVE_CUT];               /* near nodes without nodes below: 16 times the chunk's index */
    int32_t leaves;                            /* in the cut, plus the lane */
    int32_t targets, is_full;
    int32_t picks;
    lmb_live_pick pick[LMB_LIVE_PICKS];
    lmb_vec3 off;      /* m: offset away from a concave edge that the receiver lies in, */
    float lift;        /* and how far `off` moves it from the other surface there, m; 0: no such edge */
    lmb_live_rays rays;
    lmb_live_branch waiting[LMB_LIVE_STACK];
    uint32_t met[2][2][LMB_BOXES]; /* segments that meet the boxes of the last two nodes, a bit each */
    uint32_t last[LMB_LIVE_LAST]; /* index in the BVH, plus 1: triangles that blocked many segments recently; tested
                                     first */
    lmb_bvh_triangle known[LMB_LIVE_KNOWN]; /* of small nodes; id 0: none */
    lmb_target window; /* used by src/frame */
    uint32_t full;     /* points whose cut was full: nodes near them were used whole */
    uint64_t segments, pairs;
    float whole[3], sky_whole[3]; /* the unoccluded light of the tree, and of the sky */
    float seen[3], sky_seen[3]; /* visible share of each channel; -1: there is no light to shadow */
} lmb_live_scratch;

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_live_side: blocks a side of a map of `size` texels a side, over `faces` faces: one for each 4 x 4 texels, or 8 x
 * 8 if there would be over 2^18 blocks in all. */
int32_t lmb_live_side(uint32_t faces, int32_t size);

/* lmb_live_bytes: memory for `faces` faces of side x side blocks and 0 .. 2^24 elements; 0 if that is impossible. 365
 * bytes a block, 245 an element.
 * lmb_live_init: lay out a tree in it, aligned as for a uint64_t. Returns LMB_OK, LMB_ERR_ARG, LMB_ERR_ALIGN or
 * LMB_ERR_CAPACITY. */
size_t lmb_live_bytes(uint32_t faces, int32_t side, uint32_t elements);
lmb_status lmb_live_init(lmb_live *out, uint32_t faces, int32_t side, uint32_t elements, void *memory, size_t bytes);

/* lmb_live_sky_bytes: memory for a sky of 1 .. 2^22 suns; 0 for another number. 16 bytes a sun, and 36 KiB.
 * lmb_live_sky_init: lay out an empty sky in it, aligned as for a uint64_t; lmb_many_lights_sky (many_lights.h) fills
 * it. Then set lmb_live.sky. Returns LMB_OK, LMB_ERR_ARG, LMB_ERR_ALIGN or LMB_ERR_CAPACITY. */
size_t lmb_live_sky_bytes(uint32_t suns);
lmb_status lmb_live_sky_init(lmb_live_sky *out, uint32_t suns, void *memory, size_t bytes);

/* lmb_live_collect: collect first points of one face, as face `into` of the tree: those of the rows of 8 blocks that
 * begin in the map's tile rows first .. past - 1. Rows may be collected in any order, on any threads. The light through
 * a flat block is put at one texel of the block; otherwise each quarter gets a point. Over many blocks, surfaces get
 * light in proportion to the texels that show them.
 *   light  of scene->lights.
 *   map    drawn: depths and ids are read.
 * Returns LMB_OK, LMB_ERR_ARG, or LMB_ERR_CAPACITY (no such face; more blocks than there is room for). */
lmb_status lmb_live_collect(const lmb_live *live, const lmb_kernels *kernels, lmb_tile *scratch,
                            const lmb_scene *scene, uint32_t light, const lmb_shadow_map *map, int32_t face,
                            uint32_t into, int32_t first, int32_t past);

/* lmb_live_build: build the tree over the first points of faces 0 .. live->faces - 1 and live->elements elements. If
 * nodes run out, undivided ones are used whole (live->merged), and near points still use their first points. Returns
 * LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_live_build(lmb_live *live, const lmb_scene *scene);

/* lmb_live_receive: set the light of a receiver, W/m2.
 *
 *   bvh  occluders; NULL: none.
 * A triangle blocks a segment that crosses it before .99999 of the segment's length; the triangles of target and
 * receiver do not. A receiver that lies in a triangle's plane, to within rounding, counts as on the viewer's side of
 * it. A target counts only if the receiver is in front of its facet, and the target is above the receiver's horizon.
 * Segments are tested against a box of the BVH with one formula, whatever packet they are in.
 * Returns LMB_OK or LMB_ERR_ARG. Cost: 1 to 10 us. Stack: under 4 KiB. */
lmb_status lmb_live_receive(float light[3], const lmb_kernels *kernels, lmb_live_scratch *scratch,
                            const lmb_live *live, const lmb_bvh *bvh, const lmb_live_receiver *receiver);

#ifdef __cplusplus
}
#endif
#endif
