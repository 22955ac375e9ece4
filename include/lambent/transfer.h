/* transfer.h: bounced light of static scenes, from a file that `lambent bake` writes once: lights and cameras may move.
 * A 640x480 frame then takes up to 3.3 times as long as with direct light only.
 *
 * The file holds, for all surfaces: *elements*, pieces that send light; *receivers*, points that receive it; and
 * *links*, the share of a node's light that arrives at a receiver. A node is an element or the mean of several.
 * Visibility is in the links, so no frame tests it again. Albedo and emission are not, so materials may change. Light
 * passes through five steps:
 *
 *     lmb_transfer_collect(..)    from the texels of shadow maps to the elements; lmb_transfer_many_lights(..), from
 *                                 lights without maps
 *     lmb_transfer_bounce(..)     further reflections, from elements to at most 1,024 coarse ones
 *     lmb_transfer_send(..)       from light that elements receive and emit to light that they and their nodes send
 *     lmb_transfer_receivers(..)  from the nodes, by the links, to the receivers
 *     lmb_transfer_tile(..)       from the receivers to a tile's pixels
 *
 * Receivers lie at the corners of triangles, which the baker halves until light is nearly linear on each. First it cuts
 * triangles along the lines where others touch or cross them, because light differs on both sides. A pixel interpolates
 * the three receivers of its triangle with barycentric weights. The receiver in the middle of an edge stores its
 * difference from the mean of the edge's two ends. Small triangles of meshes read clusters, which store light by
 * direction, as differences from blends of clusters around them. So do large triangles with a normal map or a lobe:
 * each of their receivers is a cluster, and each of their blends names one of these.
 *
 * Objects that move read a grid of points in the air, which store light by direction. They cast shadows in direct
 * light; they neither block nor reflect bounced light.
 *
 * The sums over links are of integers, so they are the same in any order and vector width.
 *
 * Stability: experimental. Tags like [V3] are requirements in src/SOURCES.md. */
#ifndef LMB_TRANSFER_H
#define LMB_TRANSFER_H

#include "elements.h"
#include "map.h"
#include "light.h"

/* Sections of a file, in this order. Each is an array of 32-bit words. */
enum {
    LMB_TRANSFER_SURFACES, /* per triangle: roots among pieces, of front and back; likewise among divisions */
    LMB_TRANSFER_PIECES,   /* halvings down to elements */
    LMB_TRANSFER_AREAS,    /* of elements, m2, binary32 */
    LMB_TRANSFER_DIVISIONS, /* halvings down to corners */
    LMB_TRANSFER_CORNERS,  /* three a leaf: receivers; then three a leaf that stores light by direction: blends */
    LMB_TRANSFER_RECEIVERS,
    LMB_TRANSFER_LINKS,
    LMB_TRANSFER_BLENDS,   /* up to four clusters and their weights */
    LMB_TRANSFER_CLUSTERS,
    LMB_TRANSFER_CLUSTER_LINKS,
    LMB_TRANSFER_COARSE, /* at most 1,024 runs of elements; all of a run receive the same reflected light */
    LMB_TRANSFER_COARSE_LINKS,
    LMB_TRANSFER_MOVING, /* per range of triangles that may move, in order: first id, and one past the last */
    LMB_TRANSFER_GRID,   /* none or one: the grid of points in the air, for light on objects that move */
    LMB_TRANSFER_AIR,    /* per point of the grid, along x, then y, then z: the first of six receivers, which face +x,
                            -x, +y, -y, +z, -z; or LMB_TRANSFER_NONE, a point without light */
    LMB_TRANSFER_CUTS,   /* divisions of an edge at another point than its middle */
    LMB_TRANSFER_SECTIONS
};

enum {
    LMB_TRANSFER_VERSION = 3, /* the file's fourth byte, after `LMT` */
    LMB_TRANSFER_HEADER_WORDS = 24, /* the last one: FNV-1a, 32 bits, of all other bytes, or 0; the library does not
                                       check it */
    LMB_TRANSFER_SURFACE_WORDS = 4,
    LMB_TRANSFER_CORNER_WORDS = 3,
    LMB_TRANSFER_RECEIVER_WORDS = 5, /* two parents, first link, number of links, scale */
    LMB_TRANSFER_BLEND_WORDS = 3,
    LMB_TRANSFER_CLUSTER_WORDS = 6, /* a blend of clusters before it, first link, number of links, scale */
    LMB_TRANSFER_CLUSTER_LINK_WORDS = 2,
    LMB_TRANSFER_COARSE_WORDS = 4, /* first element, first link, number of links, scale */
    LMB_TRANSFER_MAX_COARSE = 1024,
    LMB_TRANSFER_MOVING_WORDS = 2,
    LMB_TRANSFER_GRID_WORDS = 7, /* the first point, m, binary32; points a metre, binary32; points along each axis */
    LMB_TRANSFER_AIR_RECEIVERS = 6,
    LMB_TRANSFER_MAX_AIR = 1024, /* points along an axis */
    LMB_TRANSFER_CUT_WORDS = 2, /* a halving, with LMB_TRANSFER_WALL; position on the edge, 0 to 1, binary32 */
    LMB_TRANSFER_MAX_ELEMENTS = 16384,
    LMB_TRANSFER_MAX_CLUSTERS = 65536,
    LMB_TRANSFER_KEPT = 64, /* triangles */
    LMB_TRANSFER_CELLS = 4,    /* cells of a block along each side: see lmb_transfer_collect */
    LMB_TRANSFER_BLOCK_CELLS = LMB_TRANSFER_CELLS * LMB_TRANSFER_CELLS,
    LMB_TRANSFER_SHOWN = 36,    /* cached triangles of a face: lmb_transfer_collecting */
    LMB_TRANSFER_SHARING = 10,  /* triangles that share a block by their outlines */
    LMB_TRANSFER_SHARERS = 8,  /* triangles that share a tile of blocks */
    LMB_TRANSFER_ALL_ROWS = 255,
    LMB_TRANSFER_PARTS = 16,   /* parts of one triangle's light that wait to be halved */
    LMB_TRANSFER_MAX_HALVINGS = 40 /* of a triangle; pieces below are not lit */
};
/* Words per entry of each section. */
#define LMB_TRANSFER_WORDS_EACH                                                                                 \
    {LMB_TRANSFER_SURFACE_WORDS, 1, 1, 1, LMB_TRANSFER_CORNER_WORDS, LMB_TRANSFER_RECEIVER_WORDS, 1,            \
     LMB_TRANSFER_BLEND_WORDS, LMB_TRANSFER_CLUSTER_WORDS, LMB_TRANSFER_CLUSTER_LINK_WORDS,                     \
     LMB_TRANSFER_COARSE_WORDS, 1, LMB_TRANSFER_MOVING_WORDS, LMB_TRANSFER_GRID_WORDS, 1, LMB_TRANSFER_CUT_WORDS}
#define LMB_TRANSFER_NONE      0xffffffffu
#define LMB_TRANSFER_LEAF      0x80000000u /* in a halving: the other bits are an element, or the index of three
                                              corners */
#define LMB_TRANSFER_EDGE_BIT  29          /* in a halving, bits 29 and 30: the edge that is halved; lower bits: the
                                              first of its halves */
#define LMB_TRANSFER_CUT       3u          /* instead of the edge: the lower bits are a cut, which has edge and
                                              halves */
#define LMB_TRANSFER_WALL      0x80000000u /* in a cut: a surface touches this line, so light near it goes to the side
                                              that the map shows */
#define LMB_TRANSFER_LEAST_CUT 1e-6f       /* of the edge, from either end */
#define LMB_TRANSFER_MAX_SUM   32767       /* sum of the absolute weights of a receiver, or of an axis of a cluster */

/* A file in place, checked by lmb_transfer_open. */
typedef struct lmb_transfer {
    const uint32_t *section[LMB_TRANSFER_SECTIONS];
    uint32_t count[LMB_TRANSFER_SECTIONS]; /* entries */
    uint32_t leaves; /* corners that name receivers */
    uint32_t nodes;  /* elements, and means of 4, 16, ... of them */
    uint32_t scene[2]; /* fingerprint of the baked scene: lmb_transfer_fingerprint */
} lmb_transfer;

/* A coarse element: the area-weighted mean of a run of elements. */
typedef struct lmb_transfer_coarse {
    float albedo[3], area; /* m2 */
    float sent[3], came[3]; /* in the last reflection, W/m2 */
    float all[3];           /* received in all reflections but the first, W/m2 */
} lmb_transfer_coarse;

/* The light that a reflection starts with. */
enum {
    LMB_TRANSFER_SEND_EMITTED,  /* light that surfaces emit; use it first, if any surface emits */
    LMB_TRANSFER_SEND_COLLECTED, /* light of the lights and of emitters that surfaces reflect; use it once */
    LMB_TRANSFER_SEND_RECEIVED  /* light of the last reflection that surfaces reflect */
};

/* An element's largest piece: the centre, m, unit normal, and area, m2; 0: there is none. */
typedef struct lmb_transfer_place {
    lmb_vec3 position, normal;
    float area;
} lmb_transfer_place;

/* The light of a frame, in your memory. */
typedef struct lmb_transfer_light {
    float (*power)[3];    /* per element: incident power, W */
    float (*albedo)[3];   /* per element: 0 .. 1 */
    float (*emission)[3]; /* per element: emitted, W/m2 */
    lmb_transfer_coarse *coarse;
    uint16_t (*node)[4]; /* per node: sent, in steps of `step`; then 0 */
    float (*receiver)[3]; /* W/m2 */
    float (*cluster)[9];  /* W/m2 along x, y, z, of R, then G, then B */
    lmb_transfer_place *place; /* per element, for lmb_transfer_many_lights: yours, set before lmb_transfer_materials;
                                  NULL after lmb_transfer_light_init: none */
    struct lmb_transfer_part *part; /* LMB_TRANSFER_PARTS: scratch of lmb_transfer_collect, for one triangle */
    float step;
} lmb_transfer_light;

/* A triangle of the scene. Its corners' weights at a point p on it are 1 - b1 - b2, b1 and b2. */
typedef struct lmb_transfer_triangle {
    lmb_vec3 corner, along[2]; /* b1 = along[0] . (p - corner), b2 = along[1] . (p - corner) */
    lmb_vec3 normal;           /* of its front, unit */
} lmb_transfer_triangle;

/* A cache of recent triangles; all 0: empty. */
typedef struct lmb_transfer_kept {
    uint32_t id[LMB_TRANSFER_KEPT]; /* 0: free */
    lmb_transfer_triangle triangle[LMB_TRANSFER_KEPT];
} lmb_transfer_kept;

/* A halving on the way to a leaf. The weight of its corner k is weight[k][0] + weight[k][1] b1 + weight[k][2] b2. */
typedef struct lmb_transfer_step {
    float weight[3][3];
    float side[3];      /* over 0 at points of the next step; or 0, in a first half */
    uint32_t at;        /* index of the halving */
    int32_t second;     /* 1: the next step is the second half */
} lmb_transfer_step;

/* A triangle as a face of a shadow map shows it. Its functions are linear in a cell's column and row: the value in the
 * first cell, the step by column, the step by row. */
typedef struct lmb_transfer_shown {
    uint32_t id;         /* 0: free */
    uint32_t root;       /* among pieces, of the side that faces the light; or LMB_TRANSFER_NONE */
    int32_t has_outline; /* 0: cut out by a mask, or seen edge on: it covers the cells that show it at their centre */
    float corner[3][3];  /* weights of the corners; in perspective times `near` */
    float per[3];        /* 1 / their change over a cell */
    float cosine[3];     /* of the angle between the edges that meet at a corner */
    float near[3];       /* 1 / distance along the view; of suns, minus the distance */
} lmb_transfer_shown;

/* Shares of one triangle in a tile of 8 x 8 blocks: scratch of lmb_transfer_collect. */
typedef struct lmb_transfer_sharer {
    uint32_t id, root;            /* see lmb_transfer_shown */
    uint32_t rows;                /* a bit each: rows that have a share */
    float corner[3][3];           /* see lmb_transfer_shown, by block */
    float share[LMB_TILE_PIXELS]; /* of each block's light */
} lmb_transfer_sharer;

typedef struct lmb_transfer_part {
    uint32_t at;                  /* a halving */
    int32_t depth;                /* of the halving */
    uint32_t rows;                /* a bit each: rows with light; `light` of other rows is undefined */
    float corner[3][3];           /* of the halving, by block; see lmb_transfer_shown */
    float light[LMB_TILE_PIXELS]; /* of each block: whole numbers, 2^24 for the most that a block can bring */
} lmb_transfer_part;

/* The ids in a block's cells, by the first cell of each. */
typedef struct lmb_transfer_several {
    int32_t count; /* over LMB_TRANSFER_SHARING: more than fit */
    uint32_t id[LMB_TRANSFER_SHARING];
} lmb_transfer_several;

typedef struct lmb_transfer_collecting {
    lmb_transfer_shown shown[LMB_TRANSFER_SHOWN];
    uint32_t block_id[LMB_TILE + 2][LMB_TILE + 2]; /* the single id of a block's cells, or LMB_TRANSFER_NONE */
    lmb_transfer_several several[3][LMB_TILE + 2]; /* the ids of blocks that show several: of three rows of blocks */
    lmb_transfer_shown outline[LMB_TRANSFER_SHARING]; /* the elements that share the current block */
    lmb_transfer_sharer sharer[LMB_TRANSFER_SHARERS];
    int32_t sharers;
    float share[LMB_TRANSFER_SHARING][LMB_TRANSFER_BLOCK_CELLS]; /* each outline's share of each cell, 0 to 1 */
    float power[LMB_TILE_PIXELS + 16]; /* of the cells, padded to a whole vector */
} lmb_transfer_collecting;

/* State of lmb_transfer_tile between calls. */
typedef struct lmb_transfer_met {
    lmb_transfer_kept kept;
    lmb_transfer_step step[LMB_TRANSFER_MAX_HALVINGS + 1]; /* the last way down: the next one shares most of it */
    uint32_t root;                                         /* start of that way, plus 1; 0: there is none */
    uint32_t depth;                                        /* number of steps */
    float weight[2][LMB_TILE_PIXELS];                      /* of the pixels of one step */
} lmb_transfer_met;

/* Scratch of lmb_transfer_collect and lmb_transfer_tile, one for each thread; the contents change no byte. Zero it
 * before you first call lmb_transfer_tile, and when you have changed the scene. lmb_transfer_collect accepts any
 * contents, and leaves nothing useful for lmb_transfer_tile. */
typedef union lmb_transfer_scratch {
    lmb_transfer_met met;
    lmb_transfer_collecting collecting;
} lmb_transfer_scratch;

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_transfer_open: use a .lmt in place. `data` is 4-byte aligned; do not move it while you use `out`. The call checks
 * the whole file in one pass: afterwards no number in it can lead outside its memory or overflow a sum.
 * Returns LMB_OK, LMB_ERR_ARG, LMB_ERR_ALIGN, or LMB_ERR_FORMAT (not a .lmt, of the other byte order, cut off, or
 * damaged). */
lmb_status lmb_transfer_open(lmb_transfer *out, const void *data, size_t bytes);

/* lmb_transfer_fingerprint: 64 bits that depend on a checked scene's triangles: their corners in the world, their
 * order, and which sides show. They do not depend on lights, colours and cameras. Of triangles in the `count` ranges
 * `moving`, as in LMB_TRANSFER_MOVING, only the number counts. Cost: a pass over the triangles.
 * lmb_transfer_fits: LMB_OK if the file was baked from this scene, else LMB_ERR_SCENE. */
void lmb_transfer_fingerprint(uint32_t out[2], const lmb_scene *scene, const uint32_t *moving, uint32_t count);
lmb_status lmb_transfer_fits(const lmb_transfer *transfer, const lmb_scene *scene);

/* lmb_transfer_light_bytes: memory of the light: about 50 bytes an element, 12 a receiver, 36 a cluster. 0: null, or
 * more than this target can address.
 * lmb_transfer_light_init: lay it out. Returns LMB_OK, LMB_ERR_ARG, LMB_ERR_ALIGN or LMB_ERR_CAPACITY. */
size_t lmb_transfer_light_bytes(const lmb_transfer *transfer);
lmb_status lmb_transfer_light_init(lmb_transfer_light *out, const lmb_transfer *transfer, void *memory, size_t bytes);

/* lmb_transfer_materials: set the elements' mean albedos and emission from the scene's materials. Call it once, and
 * when you change materials. Cost: about 0.5 us an element. Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_transfer_materials(const lmb_transfer_light *light, const lmb_transfer *transfer,
                                  const lmb_scene *scene);

/* lmb_transfer_clear: remove all light; begins a frame. Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_transfer_clear(lmb_transfer_light *light, const lmb_transfer *transfer);

/* lmb_transfer_collect: add the power of one face of a shadow map to the elements that it shows, by blocks of `each` x
 * `each` texels. Rows first .. past - 1 of blocks, in order, in pieces of any size: eight rows are added with the last
 * of them. Use about 256 x 256 blocks for a light with one face.
 * A block's light is divided among triangles and elements by area, so elements gain and lose light gradually while the
 * light moves.
 * Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_transfer_collect(const lmb_transfer_light *light, const lmb_kernels *kernels,
                                lmb_transfer_scratch *scratch, const lmb_transfer *transfer, const lmb_scene *scene,
                                const lmb_light *from, const lmb_shadow_map *map, int32_t face, int32_t each,
                                int32_t first, int32_t past);

/* lmb_transfer_tiles: the number of tiles of 64 elements.
 * lmb_transfer_many_lights: add the light of a tree of lights to elements of the tiles first .. past - 1. Tiles may run
 * in any order, on any threads, each with its own scratches (own_scratch: kernels, tile and fresh are used).
 * light->place gives each element's position. Cost: a tile's cut and its shadows, as for 64 pixels. Returns LMB_OK or
 * LMB_ERR_ARG.                                                                                                  [V3] */
int32_t lmb_transfer_tiles(const lmb_transfer *transfer);
lmb_status lmb_transfer_many_lights(const lmb_transfer_light *light, const lmb_element_scratch *own_scratch,
                                    lmb_many_lights_scratch *scratch, const lmb_transfer *transfer,
                                    const lmb_many_lights_query *query, int32_t first, int32_t past);

/* lmb_transfer_bounce: call it after all maps: elements send the light that `what` names in the enum above, and coarse
 * ones receive it.
 * lmb_transfer_rest: call it after these: adds an estimate of `bounces` further reflections, 0 to LMB_MAX_BOUNCES, from
 * the ratio of the last one, of `what`, to the one before.
 * Cost: about 200,000 products. Both return LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_transfer_bounce(lmb_transfer_light *light, const lmb_transfer *transfer, int what);
lmb_status lmb_transfer_rest(lmb_transfer_light *light, const lmb_transfer *transfer, int what, int32_t bounces);

/* lmb_transfer_send: after all maps and bounces: incident light times albedo, plus emission, becomes the light that
 * elements and their nodes send. Returns LMB_OK or LMB_ERR_ARG. Cost: some 20 operations an element. */
lmb_status lmb_transfer_send(lmb_transfer_light *light, const lmb_transfer *transfer);

/* lmb_transfer_receivers: sum the light at receivers and clusters first .. past - 1, counted together, receivers first.
 * In order, in pieces of any size. Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_transfer_receivers(const lmb_transfer_light *light, const lmb_kernels *kernels,
                                  const lmb_transfer *transfer, uint32_t first, uint32_t past);

/* lmb_transfer_tile: add the bounced light at a tile's pixels. Returns LMB_OK or LMB_ERR_ARG.
 *
 *   glossy  the tile's lobes, to which the reflection of that light is added; NULL: none. For a lobe all light is one
 *           disc: in the mean direction if the file stores directions, else along the face normal. That is right for
 *           rough surfaces; smooth ones do not reflect an image of the room. Lobes of moving objects get none. */
lmb_status lmb_transfer_tile(lmb_irradiance *inout, lmb_glossy *glossy, const lmb_kernels *kernels,
                             lmb_transfer_scratch *scratch, const lmb_transfer_light *light,
                             const lmb_transfer *transfer, const lmb_scene *scene, const lmb_tile *tile);

#ifdef __cplusplus
}
#endif
#endif
