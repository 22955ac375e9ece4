/* many_lights.h: light from 1 to millions of lights of any kind, in memory that does not grow with their number. [V3]
 *
 *     lmb_many_lights_init(&many, 16384, low, high, total_w, memory, bytes);
 *     lmb_many_lights_add(&many, lights, n);  ...   in slices of any size, in any order: the same bytes
 *     lmb_many_lights_build(&many);
 *     per tile: lmb_many_lights_direct_tile(...)
 *
 *     lmb_elements_build(&e, &scene, NULL);    bounces: the same cuts light the scene's elements (elements.h)
 *     lmb_many_lights_elements(&e, ...);  lmb_many_lights_elements_done(&e);  lmb_elements_send(&e, 1);
 *     per tile: lmb_gather_cut(.., &e.tree, ..)
 *
 * Lights stream once into cells of the world: points by position, spots also by the side of space that they point to,
 * suns by direction. A cell holds lights of one kind only. When the cells run out, their side doubles and cells merge:
 * detail is lost, light is not. Sums are integers, so neither order nor slicing changes them. Each tile of pixels then
 * takes a cut of its own through a tree over the cells: a node that is small for its distance represents all its
 * lights.
 *
 * Stability: experimental. Tags like [V3] are requirements in src/SOURCES.md. */
#ifndef LMB_MANY_LIGHTS_H
#define LMB_MANY_LIGHTS_H

#include "light.h"
#include "live.h"
#include "occlusion.h"

enum { LMB_MANY_LIGHTS_KINDS = 8 }; /* point lights; spots by six sides of space; suns */
/* If a scene has at least this many lights and no others, bounced light comes from all sides: a frame's `error` and
 * `visibility` then default to 0.1 and 0.2. */
enum { LMB_MANY_LIGHTS_EVEN = 32 };

/* A single light that represents its cell: a shadow test needs a position, a cone needs an axis. */
typedef struct lmb_many_lights_source {
    lmb_vec3 position;          /* m; a sun's: unit, towards it */
    lmb_vec3 direction;         /* a spot's, as in lmb_light; else 0 */
    float cos_inner, cos_outer; /* a spot's; else 0 */
    float range2;               /* m2: the range squared; 0: no range */
} lmb_many_lights_source;

typedef struct lmb_many_lights_member {
    lmb_many_lights_source source;
    float score;   /* a cell holds the candidate with the largest score, */
    uint32_t hash; /* of equals the one with the smaller hash, then source */
} lmb_many_lights_member;

/* The lights of one kind in one cube of the world; spots' directions are in one cube too. 232 bytes. */
typedef struct lmb_many_lights_cell {
    uint64_t key;         /* the cube's position: interleaved bits of x, y, z */
    uint64_t turn;        /* spots: the same for their directions, in a cube of -1 .. 1; else 0 */
    int64_t intensity[3]; /* quanta */
    int64_t weight;       /* R + G + B in 2^24 quanta, at least 1 a light */
    int64_t moment[3];    /* sums of weight x position, in steps of the box's longest side / 2^24 */
    float low[3], high[3]; /* m: the bounding box of the lights */
    float axis_low[3], axis_high[3]; /* bounds of spots' directions */
    float cos_outer;                 /* of the widest spot */
    float range2_low, range2_high;   /* m2: smallest and largest squared range; 2^60: no range */
    lmb_many_lights_member strongest, median; /* median: one drawn at random, in proportion to intensity */
    uint32_t lights;
    uint32_t kind; /* < LMB_MANY_LIGHTS_KINDS: 0 points, 7 suns */
} lmb_many_lights_cell;

/* A cell, or several, that may represent all their lights. 128 bytes.
 * A sun's position is a point on the unit sphere around the pixel that it lights, so W/sr equal W/m2. In a root
 * over lights of several kinds, only intensity, lights and children have a meaning. */
typedef struct lmb_many_lights_node {
    float intensity[3]; /* W/sr */
    lmb_vec3 position;  /* mean, weighted by intensity; of suns unit */
    float spread;       /* m2: mean square of the lights' distance from `position`, as if they filled their box */
    float share;        /* the strongest light's share of the intensity */
    lmb_many_lights_source strongest, median;
    uint32_t first, children;   /* nodes first .. first + children - 1, at most 8; none: a cell */
    uint32_t lights, from, past; /* number of lights; the cells from .. past - 1 in their order */
    uint32_t kind;               /* LMB_LIGHT_*, or LMB_MANY_LIGHTS_MIXED: the root over one node for each kind */
} lmb_many_lights_node;
#define LMB_MANY_LIGHTS_MIXED 3u

/* Inputs of a node's error, in planes of one value a node: */
enum {
    LMB_MANY_LIGHTS_MIDDLE = 0,   /* 3: centre of the lights' box, m */
    LMB_MANY_LIGHTS_HALF = 3,     /* 3: half sides of the box, m */
    LMB_MANY_LIGHTS_POSITION = 6, /* 3: as in lmb_many_lights_node */
    LMB_MANY_LIGHTS_POWER = 9,    /* 1: R + G + B, W/sr */
    LMB_MANY_LIGHTS_AXIS = 10,    /* 3: unit; with the next two a cone that holds the cones of all its spots */
    LMB_MANY_LIGHTS_COSINE = 13,  /* 1: of the angle between axis and rim */
    LMB_MANY_LIGHTS_SINE = 14,
    LMB_MANY_LIGHTS_OUTER = 15, /* 1: cosine of the widest spot's own cone */
    LMB_MANY_LIGHTS_RANGE = 16, /* 2: smallest and largest range, squared, m2 */
    LMB_MANY_LIGHTS_PLANES = 18
};

/* The builder and, after lmb_many_lights_build, the tree: in your memory. node[0] is the root. */
typedef struct lmb_many_lights {
    lmb_many_lights_cell *cell;
    lmb_many_lights_node *node;
    float *plane;             /* LMB_MANY_LIGHTS_PLANES x plane_step */
    uint32_t *slot;           /* the cells' hash table; after the build, their order */
    uint32_t cell_cap, cell_count, node_count, plane_step, slot_count;
    lmb_vec3 low;             /* m: origin of the steps */
    lmb_vec3 high;
    float step;               /* m: of positions, the box's longest side / 2^24 */
    float quantum;            /* W/sr: of intensities, a power of two */
    int64_t total;            /* quanta of R + G + B */
    uint32_t doubled;         /* times that the cell's side doubled: it is 8 x 2^doubled steps */
    uint32_t lights, dropped; /* lights added; lights refused: dark, not finite, outside the box, or with a direction,
                                 cone or range that lmb_scene_check refuses */
    uint32_t ranged;          /* lights added that have a range */
} lmb_many_lights;

/* The tree that a tile's cut is taken from, and parameters. */
typedef struct lmb_many_lights_query {
    const lmb_many_lights *many_lights;
    const lmb_bvh *bvh;           /* NULL: no shadows */
    float error;                  /* share of a pixel's light that one node may be wrong by; 0: 0.02 */
    int32_t each;                 /* 1: every pixel tests every shadow itself */
    int32_t by_seen;              /* 1: `error` is a share of the light that arrives: if less than a fifth of it does, a
                                     surface takes a second, finer cut. For a sky seen through windows */
    lmb_stats *stats;             /* counts tiles with shadow tests, and coarse ones; may be NULL */
} lmb_many_lights_query;

/* One node of a tile's cut. */
typedef struct lmb_many_lights_entry {
    float error, light; /* unoccluded, R + G + B, W/m2: a bound of the error; approximate irradiance */
    float inside;       /* irradiance if one of the cones represents all and holds the pixels */
    float key;          /* of the heap: error, or inside */
    uint32_t node;
} lmb_many_lights_entry;

/* A node with the state that it needs to light a tile's pixels. */
typedef struct lmb_active_light {
    lmb_vec3 position;
    float intensity[3], spread; /* as in lmb_many_lights_node */
    float share[2];             /* of the intensity that comes with seen[0] and seen[1] */
    uint64_t seen[2];           /* pixels that see the strongest light, and the median one: a bit each */
    lmb_many_lights_source source[2]; /* these two lights: each spot has its own cone */
    float per[2];               /* 1 / (cos_inner - cos_outer) of each */
    uint32_t kind;              /* LMB_LIGHT_* */
} lmb_active_light;

/* Scratch of lmb_many_lights_direct_tile. */
typedef struct lmb_many_lights_scratch {
    lmb_many_lights_entry
        entry[LMB_MANY_LIGHTS_CUT]; /* nodes that may still be split: a heap from the front; others from the back */
    int32_t open, closed, by_light;
    float error, light; /* sums over the cut */
    float allowed;      /* from query->error, or the default */
    lmb_active_light active[LMB_ACTIVE_LIGHTS];
    lmb_traversal traversal;
    uint32_t nodes, tests; /* counted up: nodes taken over all cuts, shadow tests made. You zero them */
} lmb_many_lights_scratch;

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_many_lights_bytes: memory for `cells` cells, 1 .. 2^22; 0 for another number. About 650 bytes a cell. */
size_t lmb_many_lights_bytes(uint32_t cells);

/* lmb_many_lights_init: lay out the builder in `memory` and begin an empty stream.
 *
 *   low, high  a box that holds all points and spots, m. The finest cell is the longest side / 2^21; of suns 2^-20.
 *   max        the sum of all lights' intensities, R + G + B, W/sr (suns: W/m2), or more: sets the quantum, 2^-60 to
 *              2^-59 of it. A bound 1,000 times too large still resolves a millionth of the light to 9 digits.
 * Returns LMB_OK, LMB_ERR_ARG (null, the number of cells, a box that is reversed or reaches past +-2^20 m, `max`
 * outside 2^-60 .. 2^60), LMB_ERR_ALIGN (as for a uint64_t) or LMB_ERR_CAPACITY (bytes): then `out` is unchanged. */
lmb_status lmb_many_lights_init(lmb_many_lights *out, uint32_t cells, lmb_vec3 low, lmb_vec3 high, float max,
                                void *memory, size_t bytes);

/* lmb_many_lights_add: add the next lights of the stream, of any kind.
 *
 * The result of lmb_many_lights_build depends only on the lights, not on their order or slices. Returns LMB_OK,
 * LMB_ERR_ARG, or LMB_ERR_CAPACITY if the sum of intensities exceeds 4 to 8 times `max`, if a light has 2 to 4 times
 * `max` in a channel, or if there are fewer cells than kinds: earlier lights were added.
 * Cost: about 100 ns a light. */
lmb_status lmb_many_lights_add(lmb_many_lights *inout, const lmb_light *lights, uint32_t count);

/* lmb_many_lights_build: build the tree over all lights that were added; the stream ends. Returns LMB_OK or
 * LMB_ERR_ARG. Cost: under 1 us a cell. */
lmb_status lmb_many_lights_build(lmb_many_lights *inout);

/* lmb_many_lights_direct_tile: add the direct irradiance of all lights to a tile's pixels.                     [V3 V29]
 *
 *   inout    added to. Pixels without a surface are unchanged.
 *   scratch  yours; only the two counters are kept.
 *   query    a built tree; the error sets how many nodes a tile takes, up to LMB_MANY_LIGHTS_CUT.
 *
 * The tile's pixels are split by surface, and each surface takes a cut of its own. Nodes are split until the sum of
 * their error bounds I cos / d^2 x min(1, R^2 / d^2) is within 16 x query->error of all light, and until no node with
 * children contributes more than query->error of it. R is a node's half diagonal, d its minimum distance; real errors
 * are far below their bounds. A node lights each pixel by I cos / d^2 from the mean position of the lights.
 * Visibility and spots' cones are tested for two lights of the node: the strongest, and one drawn by intensity. Nodes
 * with cones that miss the tile are left out. If the four corners of a tile's surface agree, all pixels use their
 * answer; a light that contributes more than query->error of all is tested at each pixel.
 * Measured in rooms with 100 to 1,000,000 lights (truth/many_lights_*): at 0.02 the picture's relative RMSE is 0.012 to
 * 0.014, at 0.01 0.007 to 0.010.
 * Returns LMB_OK or LMB_ERR_ARG. Stack: under 1 KiB. */
lmb_status lmb_many_lights_direct_tile(lmb_irradiance *inout, const lmb_kernels *kernels,
                                       lmb_many_lights_scratch *scratch, const lmb_tile *tile,
                                       const lmb_many_lights_query *query);

/* lmb_many_lights_sky: fill a sky with the lights of a built tree that has only suns, one for each cell. `scene` sets
 * the length of segments. Nodes are as fine as LMB_LIVE_SKY allows, bright parts finer than dark ones.
 *
 * Returns LMB_OK, LMB_ERR_ARG (null, a tree that is not built, or has other lights too), or LMB_ERR_CAPACITY (more
 * cells than there is room for): then `out` is unchanged. Missing in builds without live. Cost: about 100 ns a cell. */
lmb_status lmb_many_lights_sky(lmb_live_sky *out, const lmb_many_lights *many_lights, const lmb_scene *scene);

#ifdef __cplusplus
}
#endif
#endif
