/* transfer.h: bounced light of scenes that do not move, from a file that was baked once (`lambent bake`): lights and
 * cameras may move. A 640x480 frame then takes up to 3.3 times as long as by direct light alone.
 *
 * The file holds, of all surfaces: *elements*, pieces that send light; *receivers*, points that receive it; and
 * *links*, which say how much of what a node of elements sends arrives at a receiver. Visibility is in the links, so
 * no frame tests it again. Albedo and emission are not, so materials may change. Light goes through five steps:
 *
 *     lmb_transfer_collect(..)    from the texels of shadow maps to the elements; lmb_transfer_many_lights(..), from
 *                                 lights without maps
 *     lmb_transfer_bounce(..)     further reflections, from elements to at most 1,024 coarse ones
 *     lmb_transfer_send(..)       from what elements receive and emit to what they and their nodes send
 *     lmb_transfer_receivers(..)  from the nodes, by the links, to the receivers
 *     lmb_transfer_tile(..)       from the receivers to a tile's pixels
 *
 * Receivers lie at the corners of triangles that the baker halved until light is nearly linear on each. Before that it
 * cuts triangles along the lines where others stand on them or go through them, as light differs on both sides. A pixel
 * interpolates the three receivers of its triangle by barycentric weights. The receiver in the middle of an edge stores
 * its difference from the mean of the edge's two ends. Small triangles of meshes take their light from clusters, which
 * keep it by direction, as differences from blends of clusters around them. So do large triangles with a normal map or
 * a lobe: each of their receivers is a cluster, and each of their blends one of these.
 *
 * Objects that move take their light from a grid of places in the air, by direction. They cast shadows in direct light;
 * bounced light they neither block nor reflect.
 *
 * The sums over links are of integers, so they are the same in any order and width.
 *
 * Stability: experimental. Tags like [V3] are requirements in src/SOURCES.md. */
#ifndef LMB_TRANSFER_H
#define LMB_TRANSFER_H

#include "elements.h"
#include "map.h"
#include "light.h"

/* Where the words of a file lie: sections in this order, each an array of 32-bit words. */
enum {
    LMB_TRANSFER_SURFACES, /* a triangle: roots among pieces, of its front and its back; likewise among divisions */
    LMB_TRANSFER_PIECES,   /* halvings down to elements */
    LMB_TRANSFER_AREAS,    /* of elements, m2, binary32 */
    LMB_TRANSFER_DIVISIONS, /* halvings down to corners */
    LMB_TRANSFER_CORNERS,  /* three a leaf: receivers; then three a leaf that keeps light by direction: blends */
    LMB_TRANSFER_RECEIVERS,
    LMB_TRANSFER_LINKS,
    LMB_TRANSFER_BLENDS,   /* up to four clusters and their weights */
    LMB_TRANSFER_CLUSTERS,
    LMB_TRANSFER_CLUSTER_LINKS,
    LMB_TRANSFER_COARSE, /* runs of elements, at most 1,024, to which light that is reflected again comes alike */
    LMB_TRANSFER_COARSE_LINKS,
    LMB_TRANSFER_MOVING, /* first id, and past the last one, of triangles that may move, in order */
    LMB_TRANSFER_GRID,   /* none or one: of places in the air, for light on what moves */
    LMB_TRANSFER_AIR,    /* a place of the grid, along x, then y, then z: the first of six receivers, which face +x, -x,
                            +y, -y, +z, -z; or LMB_TRANSFER_NONE, where no light comes */
    LMB_TRANSFER_CUTS,   /* divisions of an edge elsewhere than in its middle */
    LMB_TRANSFER_SECTIONS
};

enum {
    LMB_TRANSFER_VERSION = 3, /* the file's fourth byte, behind `LMT` */
    LMB_TRANSFER_HEADER_WORDS = 24, /* the last one: FNV-1a, 32 bits, of all other bytes; 0: not told, never checked here */
    LMB_TRANSFER_SURFACE_WORDS = 4,
    LMB_TRANSFER_CORNER_WORDS = 3,
    LMB_TRANSFER_RECEIVER_WORDS = 5, /* two parents, first link, number of links, scale */
    LMB_TRANSFER_BLEND_WORDS = 3,
    LMB_TRANSFER_CLUSTER_WORDS = 6, /* a blend of clusters before it, first link, number of links, scale */
    LMB_TRANSFER_CLUSTER_LINK_WORDS = 2,
    LMB_TRANSFER_COARSE_WORDS = 4, /* first element, first link, number of links, scale */
    LMB_TRANSFER_MAX_COARSE = 1024,
    LMB_TRANSFER_MOVING_WORDS = 2,
    LMB_TRANSFER_GRID_WORDS = 7, /* the first place, m, binary32; places a metre, binary32; how many along each axis */
    LMB_TRANSFER_AIR_RECEIVERS = 6,
    LMB_TRANSFER_MAX_AIR = 1024, /* places along an axis */
    LMB_TRANSFER_CUT_WORDS = 2, /* as of a halving, with LMB_TRANSFER_WALL; where on the edge, 0 to 1, binary32 */
    LMB_TRANSFER_MAX_ELEMENTS = 16384,
    LMB_TRANSFER_MAX_CLUSTERS = 65536,
    LMB_TRANSFER_KEPT = 64, /* triangles */
    LMB_TRANSFER_CELLS = 4,    /* of a block, each way: see lmb_transfer_collect */
    LMB_TRANSFER_BLOCK_CELLS = LMB_TRANSFER_CELLS * LMB_TRANSFER_CELLS,
    LMB_TRANSFER_SHOWN = 36,    /* triangles of a face at hand: see below */
    LMB_TRANSFER_SHARING = 10,  /* triangles that share a block by their outlines */
    LMB_TRANSFER_SHARERS = 8,  /* triangles that share a tile of blocks */
    LMB_TRANSFER_ALL_ROWS = 255,
    LMB_TRANSFER_PARTS = 16,   /* of one's light, that wait to be halved */
    LMB_TRANSFER_MAX_HALVINGS = 40 /* of a triangle; what lies deeper is not lit */
};
#define LMB_TRANSFER_NONE      0xffffffffu
#define LMB_TRANSFER_LEAF      0x80000000u /* of a halving: the rest is an element, or the place of three corners */
#define LMB_TRANSFER_EDGE_BIT  29          /* of others, bits 29 and 30: the edge that is halved; below: its halves */
#define LMB_TRANSFER_CUT       3u          /* in place of the edge: below is one of the cuts, which has both */
#define LMB_TRANSFER_WALL      0x80000000u /* of a cut: a surface stands on this line, so light goes to what is shown */
#define LMB_TRANSFER_LEAST_CUT 1e-6f       /* of the edge, from either end */
#define LMB_TRANSFER_MAX_SUM   32767       /* of the absolute weights of a receiver, or of an axis of a cluster */

/* A file in place, checked by lmb_transfer_open. */
typedef struct lmb_transfer {
    const uint32_t *section[LMB_TRANSFER_SECTIONS];
    uint32_t count[LMB_TRANSFER_SECTIONS]; /* entries */
    uint32_t leaves; /* of corners: those of receivers */
    uint32_t nodes;  /* elements, and means of 4, 16, ... of them */
    uint32_t scene[2]; /* what it was baked from: lmb_transfer_fingerprint */
} lmb_transfer;

/* A coarse element: the mean by area of a run of elements. */
typedef struct lmb_transfer_coarse {
    float albedo[3], area; /* m2 */
    float sent[3], came[3]; /* of the last reflection, W/m2 */
    float all[3];           /* that came of all reflections but the first, W/m2 */
} lmb_transfer_coarse;

/* What a reflection begins with. */
enum {
    LMB_TRANSFER_SEND_EMITTED,  /* what surfaces emit; first, where any does */
    LMB_TRANSFER_SEND_COLLECTED, /* what they reflect of the lights' light and of what was emitted; once */
    LMB_TRANSFER_SEND_RECEIVED  /* what they reflect of what came last */
};

/* An element's largest piece: its middle, m, unit normal, and area, m2; 0: there is none. */
typedef struct lmb_transfer_place {
    lmb_vec3 position, normal;
    float area;
} lmb_transfer_place;

/* The light in the air, in the caller's memory. */
typedef struct lmb_transfer_light {
    float (*power)[3];    /* an element: W that arrive */
    float (*albedo)[3];   /* an element: 0 .. 1 */
    float (*emission)[3]; /* an element: W/m2 that it emits */
    lmb_transfer_coarse *coarse;
    uint16_t (*node)[4]; /* a node: what it sends, in steps of `step`; then 0 */
    float (*receiver)[3]; /* W/m2 */
    float (*cluster)[9];  /* W/m2 along x, y, z, of R, then G, then B */
    lmb_transfer_place *place; /* an element's, for lmb_transfer_many_lights: the caller's, set before
                                  lmb_transfer_materials; NULL after lmb_transfer_light_init: none */
    struct lmb_transfer_part *part; /* LMB_TRANSFER_PARTS, of the triangle that lmb_transfer_collect is at */
    float step;
} lmb_transfer_light;

/* A triangle of the scene. Its corners' weights at a point p on it are 1 - b1 - b2, b1 and b2. */
typedef struct lmb_transfer_triangle {
    lmb_vec3 corner, along[2]; /* b1 = along[0] . (p - corner), b2 = along[1] . (p - corner) */
    lmb_vec3 normal;           /* of its front, unit */
} lmb_transfer_triangle;

/* Those met lately; all 0: none. */
typedef struct lmb_transfer_kept {
    uint32_t id[LMB_TRANSFER_KEPT]; /* or 0 */
    lmb_transfer_triangle triangle[LMB_TRANSFER_KEPT];
} lmb_transfer_kept;

/* A halving on the way to a leaf. The weight of its corner k is weight[0][k] + weight[1][k] b1 + weight[2][k] b2. */
typedef struct lmb_transfer_step {
    float weight[3][3];
    float side[3];      /* the next step's places have it over 0; or 0, in a first half */
    uint32_t at;        /* which it is */
    int32_t second;     /* 1: the next step is its second half */
} lmb_transfer_step;

/* A triangle as a face of a shadow map shows it. Its functions are linear in a cell's column and row: the value in the
 * first cell, the step by column, the step by row. */
typedef struct lmb_transfer_shown {
    uint32_t id;         /* or 0 */
    uint32_t root;       /* among pieces, of the side to the light; or LMB_TRANSFER_NONE */
    int32_t has_outline; /* 0: cut out by a mask, or seen edge on: it has the cells whose middles show it */
    float corner[3][3];  /* weights of its corners, times its nearness where rays meet in a point */
    float per[3];        /* 1 / what these change by over a cell */
    float cosine[3];     /* of the angle between the edges that meet at a corner */
    float near[3];       /* 1 / distance along the view; of suns, minus the distance */
} lmb_transfer_shown;

/* What lmb_transfer_collect works on: 8 x 8 blocks. */
typedef struct lmb_transfer_sharer {
    uint32_t id, root;            /* as above */
    uint32_t rows;                /* a bit each: those that have a share */
    float corner[3][3];           /* as above, by block */
    float share[LMB_TILE_PIXELS]; /* of each block's light */
} lmb_transfer_sharer;

typedef struct lmb_transfer_part {
    uint32_t at;                  /* a halving */
    int32_t depth;                /* of it */
    uint32_t rows;                /* a bit each: of others the light is not told */
    float corner[3][3];           /* as above, of the halving's corners, by block */
    float light[LMB_TILE_PIXELS]; /* of each block: whole numbers, 2^24 for all that a block could bring */
} lmb_transfer_part;

/* The ids that a block's cells show, in the order of the first cell of each. */
typedef struct lmb_transfer_several {
    int32_t count; /* over LMB_TRANSFER_SHARING: more than these */
    uint32_t id[LMB_TRANSFER_SHARING];
} lmb_transfer_several;

typedef struct lmb_transfer_collecting {
    lmb_transfer_shown shown[LMB_TRANSFER_SHOWN];
    uint32_t block_id[LMB_TILE + 2][LMB_TILE + 2]; /* the one id of a block's cells, or LMB_TRANSFER_NONE */
    lmb_transfer_several several[3][LMB_TILE + 2]; /* the ids of blocks that show several: of three rows of blocks */
    lmb_transfer_shown outline[LMB_TRANSFER_SHARING]; /* the elements that share the block at hand */
    lmb_transfer_sharer sharer[LMB_TRANSFER_SHARERS];
    int32_t sharers;
    float share[LMB_TRANSFER_SHARING][LMB_TRANSFER_BLOCK_CELLS]; /* each outline's share of each cell, 0 to 1 */
    float power[LMB_TILE_PIXELS + 16]; /* of the cells, padded to a whole vector */
} lmb_transfer_collecting;

/* What lmb_transfer_tile keeps from call to call. */
typedef struct lmb_transfer_met {
    lmb_transfer_kept kept;
    lmb_transfer_step step[LMB_TRANSFER_MAX_HALVINGS + 1]; /* the last way down: the next one shares most of it */
    uint32_t root;                                         /* where that way began, plus 1; 0: there is none */
    uint32_t depth;                                        /* its steps */
    float weight[2][LMB_TILE_PIXELS];                      /* of the pixels of one step */
} lmb_transfer_met;

/* What lmb_transfer_collect and lmb_transfer_tile work on, one for each thread: what it holds changes no byte. Set it to
 * 0 before the first call of lmb_transfer_tile, and when the scene has changed. lmb_transfer_collect may find anything
 * in it, and leaves nothing of use to lmb_transfer_tile. */
typedef union lmb_transfer_scratch {
    lmb_transfer_met met;
    lmb_transfer_collecting collecting;
} lmb_transfer_scratch;

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_transfer_open: use a .lmt in place; `data` is 4-byte aligned and stays where it is. Everything in it is checked,
 * in one pass: afterwards no number of it can lead outside its memory or overflow a sum.
 * LMB_OK, LMB_ERR_ARG, LMB_ERR_ALIGN, or LMB_ERR_FORMAT (not a .lmt, of the other byte order, cut off, or damaged). */
lmb_status lmb_transfer_open(lmb_transfer *out, const void *data, size_t bytes);

/* lmb_transfer_fingerprint: 64 bits of a checked scene's triangles: their corners in the world, their order, and which
 * sides of them show. Lights, colours and cameras are no part of it, nor triangles of `count` ranges `moving`, as
 * LMB_TRANSFER_MOVING has them, but for their number. Cost: a pass over the triangles.
 * lmb_transfer_fits: LMB_OK where the file was baked from this scene, else LMB_ERR_SCENE. */
void lmb_transfer_fingerprint(uint32_t out[2], const lmb_scene *scene, const uint32_t *moving, uint32_t count);
lmb_status lmb_transfer_fits(const lmb_transfer *transfer, const lmb_scene *scene);

/* lmb_transfer_light_bytes: memory of the light: about 50 bytes an element, 12 a receiver, 36 a cluster. 0: null, or
 * more than this target can address.
 * lmb_transfer_light_init: lay it out. LMB_OK, LMB_ERR_ARG, LMB_ERR_ALIGN or LMB_ERR_CAPACITY. */
size_t lmb_transfer_light_bytes(const lmb_transfer *transfer);
lmb_status lmb_transfer_light_init(lmb_transfer_light *out, const lmb_transfer *transfer, void *memory, size_t bytes);

/* lmb_transfer_materials: the elements' mean albedos and emission, from the scene's materials: once, and when these
 * change. Cost: about 0.5 us an element. LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_transfer_materials(const lmb_transfer_light *light, const lmb_transfer *transfer,
                                  const lmb_scene *scene);

/* lmb_transfer_clear: no light. Begins a frame. LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_transfer_clear(lmb_transfer_light *light, const lmb_transfer *transfer);

/* lmb_transfer_collect: add the power of one face of a shadow map to the elements that it shows, by blocks of
 * `each` x `each` texels. Rows first .. past - 1 of blocks, in order, in pieces of any size: eight rows are added when
 * the last of them is asked for. Use about 256 x 256 blocks for a light with one face.
 * A block's light is parted at the borders of triangles and of elements, by area: as the light moves, it crosses these
 * little by little.
 * LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_transfer_collect(const lmb_transfer_light *light, const lmb_kernels *kernels,
                                lmb_transfer_scratch *scratch, const lmb_transfer *transfer, const lmb_scene *scene,
                                const lmb_light *from, const lmb_shadow_map *map, int32_t face, int32_t each,
                                int32_t first, int32_t past);

/* lmb_transfer_tiles: how many times 64 elements there are.
 * lmb_transfer_many_lights: add what a tree of lights sends to elements of the tiles first .. past - 1. Any tiles in any
 * order, at once on any threads, each with its own scratches (of own_scratch kernels, tile and fresh are used). An
 * element is lit as light->place says. Cost: a tile's cut and its shadows, as of 64 pixels. LMB_OK or LMB_ERR_ARG.
 *                                                                                                         [V3] */
int32_t lmb_transfer_tiles(const lmb_transfer *transfer);
lmb_status lmb_transfer_many_lights(const lmb_transfer_light *light, const lmb_element_scratch *own_scratch,
                                    lmb_many_lights_scratch *scratch, const lmb_transfer *transfer,
                                    const lmb_many_lights_query *query, int32_t first, int32_t past);

/* lmb_transfer_bounce: after all maps: elements send what the enum above says, and coarse ones receive it.
 * lmb_transfer_rest: after these, an estimate of `bounces` further ones, 0 to LMB_MAX_BOUNCES, from how much weaker the
 * last one, of `what`, grew.
 * Cost: about 200,000 products. LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_transfer_bounce(lmb_transfer_light *light, const lmb_transfer *transfer, int what);
lmb_status lmb_transfer_rest(lmb_transfer_light *light, const lmb_transfer *transfer, int what, int32_t bounces);

/* lmb_transfer_send: after all maps and bounces: what arrived, times albedo, and what is emitted become what elements
 * and their nodes send. LMB_OK or LMB_ERR_ARG. Cost: some 20 operations an element. */
lmb_status lmb_transfer_send(lmb_transfer_light *light, const lmb_transfer *transfer);

/* lmb_transfer_receivers: the light at receivers and clusters first .. past - 1, counted together, receivers first.
 * In order, in pieces of any size. LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_transfer_receivers(const lmb_transfer_light *light, const lmb_kernels *kernels,
                                  const lmb_transfer *transfer, uint32_t first, uint32_t past);

/* lmb_transfer_tile: add the light that arrives at a tile's pixels. LMB_OK or LMB_ERR_ARG.
 *
 *   glossy  the tile's lobes, to which what they make of that light is added; NULL: none. A lobe sees all light as one
 *           disc in its mean direction, where the file keeps directions; else straight above. That is right for rough
 *           surfaces; smooth ones show no pictures of the room. Lobes of what moves get none. */
lmb_status lmb_transfer_tile(lmb_irradiance *inout, lmb_glossy *glossy, const lmb_kernels *kernels,
                             lmb_transfer_scratch *scratch, const lmb_transfer_light *light,
                             const lmb_transfer *transfer, const lmb_scene *scene, const lmb_tile *tile);

#ifdef __cplusplus
}
#endif
#endif
