/* many_lights.h: light from 1 to millions of lights of any kind, in memory that does not grow with their number. [V3]
 *
 *     lmb_many_lights_init(&many, 16384, low, high, total_w, memory, bytes);
 *     lmb_many_lights_add(&many, lights, n);  ...   in slices of any size, in any order: the same bytes
 *     lmb_many_lights_build(&many);
 *     per tile: lmb_many_lights_direct_tile(...)
 *
 *     lmb_elements_build(&e, &scene, NULL);    what bounces: the same cuts light the scene's elements (elements.h)
 *     lmb_many_lights_elements(&e, ...);  lmb_many_lights_elements_done(&e);  lmb_elements_send(&e, 1);
 *     per tile: lmb_gather_cut(.., &e.tree, ..)
 *
 * Lights stream once into cells of the world: points by position, spots also by the side of space that they point to,
 * suns by direction; lights of two kinds are never in one cell. When there are more cells than room, the cells' side
 * doubles and cells merge: detail is lost, light is not. Sums are integers, so neither order nor slicing changes them.
 * In a tree over the cells each tile of pixels then takes its own cut: a node that is small for its distance stands for
 * all of its lights.
 *
 * Stability: experimental. Tags like [V3] are requirements in src/SOURCES.md. */
#ifndef LMB_MANY_LIGHTS_H
#define LMB_MANY_LIGHTS_H

#include "light.h"
#include "occlusion.h"

enum { LMB_MANY_LIGHTS_KINDS = 8 }; /* point lights; spots by six sides of space; suns */
/* From so many lights on, and without others, bounced light comes from all sides: the defaults of a frame's `error` and
 * `visibility` are then 0.1 and 0.2. */
enum { LMB_MANY_LIGHTS_EVEN = 32 };

/* A light that represents its cell where one light must: a shadow test needs a position, a cone needs an axis. */
typedef struct lmb_many_lights_source {
    lmb_vec3 position;          /* m; a sun's: unit, towards it */
    lmb_vec3 direction;         /* a spot's, as in lmb_light; else 0 */
    float cos_inner, cos_outer; /* a spot's; else 0 */
    float range2;               /* m2: the range squared; 0: no range */
} lmb_many_lights_source;

typedef struct lmb_many_lights_member {
    lmb_many_lights_source source;
    float score;   /* a cell keeps the candidate with the largest score, */
    uint32_t hash; /* of equals the one with the smaller hash, then source */
} lmb_many_lights_member;

/* The lights of one kind and one cube of the world; spots' directions are in one cube too. 232 bytes. */
typedef struct lmb_many_lights_cell {
    uint64_t key;         /* the cube's position: bits of x, y, z in turn */
    uint64_t turn;        /* spots: the same for their directions, in a cube of -1 .. 1; else 0 */
    int64_t intensity[3]; /* quanta */
    int64_t weight;       /* R + G + B in 2^24 quanta, at least 1 a light */
    int64_t moment[3];    /* sums of weight x position, in steps of the box's longest side / 2^24 */
    float low[3], high[3]; /* m: the lights' own box */
    float axis_low[3], axis_high[3]; /* of spots' directions */
    float cos_outer;                 /* of the widest spot */
    float range2_low, range2_high;   /* m2: least and greatest squared range; 2^60: no range */
    lmb_many_lights_member strongest, median; /* median: one drawn at random, in proportion to intensity */
    uint32_t lights;
    uint32_t kind; /* < LMB_MANY_LIGHTS_KINDS: 0 points, 7 suns */
} lmb_many_lights_cell;

/* A cell, or several, that may stand for all of their lights. 128 bytes.
 * A sun's position is a point of the unit sphere around whatever pixel it lights, so its W/sr equal its W/m2. Of a root
 * over lights of several kinds, intensity, lights and children alone mean anything. */
typedef struct lmb_many_lights_node {
    float intensity[3]; /* W/sr */
    lmb_vec3 position;  /* mean, weighted by intensity; of suns unit */
    float spread;       /* m2: mean square of the lights' distance from there, as if they filled their box */
    float share;        /* of the intensity that is the strongest light's */
    lmb_many_lights_source strongest, median;
    uint32_t first, children;   /* nodes first .. first + children - 1, at most 8; none: a cell */
    uint32_t lights, from, past; /* its cells in their order */
    uint32_t kind;               /* LMB_LIGHT_*, or LMB_MANY_LIGHTS_MIXED: the root over one node for each kind */
} lmb_many_lights_node;
#define LMB_MANY_LIGHTS_MIXED 3u

/* What the error of a node depends on, in planes of one value a node: */
enum {
    LMB_MANY_LIGHTS_MIDDLE = 0,   /* 3: of the lights' box, m */
    LMB_MANY_LIGHTS_HALF = 3,     /* 3: its half sides, m */
    LMB_MANY_LIGHTS_POSITION = 6, /* 3: as in lmb_many_lights_node */
    LMB_MANY_LIGHTS_POWER = 9,    /* 1: R + G + B, W/sr */
    LMB_MANY_LIGHTS_AXIS = 10,    /* 3: unit; with the next two a cone that holds those of all of its spots */
    LMB_MANY_LIGHTS_COSINE = 13,  /* 1: of the angle between axis and rim */
    LMB_MANY_LIGHTS_SINE = 14,
    LMB_MANY_LIGHTS_OUTER = 15, /* 1: cosine of the widest spot's own */
    LMB_MANY_LIGHTS_RANGE = 16, /* 2: least and greatest range, squared, m2 */
    LMB_MANY_LIGHTS_PLANES = 18
};

/* The builder and, after lmb_many_lights_build, the tree: in the caller's memory. node[0] is the root. */
typedef struct lmb_many_lights {
    lmb_many_lights_cell *cell;
    lmb_many_lights_node *node;
    float *plane;             /* LMB_MANY_LIGHTS_PLANES x plane_step */
    uint32_t *slot;           /* the cells' hash table; after the build, their order */
    uint32_t cell_cap, cell_count, node_count, plane_step, slot_count;
    lmb_vec3 low;             /* m: where steps are counted from */
    lmb_vec3 high;
    float step;               /* m: of positions, the box's longest side / 2^24 */
    float quantum;            /* W/sr: of intensities, a power of two */
    int64_t total;            /* quanta of R + G + B */
    uint32_t doubled;         /* times the cell's side did: it is 8 x 2^doubled steps */
    uint32_t lights, dropped; /* lights that were added; and those refused: dark, not finite, outside the box, or with a
                                 direction, cone or range that lmb_scene_check refuses */
    uint32_t ranged;          /* lights added that have a range */
} lmb_many_lights;

/* What a tile's cut is taken from, and how. */
typedef struct lmb_many_lights_query {
    const lmb_many_lights *many_lights;
    const lmb_bvh *bvh;           /* NULL: nothing casts a shadow */
    float error;                  /* 0.02 where 0: share of a pixel's light that one node may be wrong by */
    int32_t each;                 /* 1: every pixel tests every shadow for itself */
    int32_t by_seen;              /* 1: `error` is a share of what arrives: where under a fifth of the light does, a surface
                                     takes a second, finer cut. For a sky that is seen through windows */
    lmb_stats *stats;             /* counts tiles whose shadows are tested, and coarse ones; may be NULL */
} lmb_many_lights_query;

/* One node of a tile's cut. */
typedef struct lmb_many_lights_entry {
    float error, light; /* without shadows, R + G + B, W/m2: a bound of its error; about the irradiance it gives */
    float inside;       /* and what it gives if one of its cones stands for all of them and holds the pixels */
    float key;          /* the heap's: error, or inside */
    uint32_t node;
} lmb_many_lights_entry;

/* A node as it lights a tile's pixels. */
typedef struct lmb_active_light {
    lmb_vec3 position;
    float intensity[3], spread; /* as in lmb_many_lights_node */
    float share[2];             /* of the intensity that comes with seen[0] and seen[1] */
    uint64_t seen[2];           /* pixels that see the strongest light, and the median one: a bit each */
    lmb_many_lights_source source[2]; /* those two: of spots each has its own cone */
    float per[2];               /* 1 / the width of its cosines */
    uint32_t kind;              /* LMB_LIGHT_* */
} lmb_active_light;

/* Filled and read inside lmb_many_lights_direct_tile. */
typedef struct lmb_many_lights_scratch {
    lmb_many_lights_entry
        entry[LMB_MANY_LIGHTS_CUT]; /* those that may still be split: a heap from the front; others from the back */
    int32_t open, closed, by_light;
    float error, light; /* sums over the cut */
    float allowed;      /* of query->error, or the default */
    lmb_active_light active[LMB_ACTIVE_LIGHTS];
    lmb_traversal traversal;
    uint32_t nodes, tests; /* counted up: nodes taken over all cuts, shadow tests asked. Zero them yourself */
} lmb_many_lights_scratch;

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_many_lights_bytes: memory for `cells` cells, 1 .. 2^22; 0 for another number. About 650 bytes a cell. */
size_t lmb_many_lights_bytes(uint32_t cells);

/* lmb_many_lights_init: lay the builder out in `memory` and begin an empty stream.
 *
 *   low, high  a box that holds all points and spots, m. The finest cell is its longest side / 2^21; suns': 2^-20.
 *   max        the sum of all lights' intensities, R + G + B, W/sr (suns': W/m2), or more: sets the quantum, 2^-60 to
 *              2^-59 of it.
 *              A bound 1,000 times too large still resolves a millionth of the light to 9 digits.
 * Returns LMB_OK, LMB_ERR_ARG (null, the number of cells, a box that is turned round or reaches past +-2^20 m, `most`
 * outside 2^-60 .. 2^60), LMB_ERR_ALIGN (as for a uint64_t) or LMB_ERR_CAPACITY (bytes): `out` is then untouched. */
lmb_status lmb_many_lights_init(lmb_many_lights *out, uint32_t cells, lmb_vec3 low, lmb_vec3 high, float max,
                                void *memory, size_t bytes);

/* lmb_many_lights_add: the next lights of the stream, of any kind.
 *
 * What lmb_many_lights_build makes of them depends on the lights alone, not on their order or on the slices they come
 * in. Returns LMB_OK, LMB_ERR_ARG, or LMB_ERR_CAPACITY where the sum of intensities exceeds 4 to 8 times `max`, or a
 * light has 2 to 4 times `max` in a channel, or there are fewer cells than kinds: the lights before it are in.
 * Cost: about 100 ns a light. */
lmb_status lmb_many_lights_add(lmb_many_lights *inout, const lmb_light *lights, uint32_t count);

/* lmb_many_lights_build: the tree over all that was added; the stream ends. LMB_OK or LMB_ERR_ARG. Cost: under 1 us a
 * cell. */
lmb_status lmb_many_lights_build(lmb_many_lights *inout);

/* lmb_many_lights_direct_tile: add the direct irradiance of all lights to a tile's pixels.                 [V3 V29]
 *
 *   inout    added to. Pixels without a surface stay.
 *   scratch  caller's; nothing but the two counters is kept.
 *   query    a tree that was built; its error sets how many nodes a tile takes, up to LMB_MANY_LIGHTS_CUT.
 *
 * The tile's pixels are split by surface, and each surface takes its own cut. Nodes are split until the sum of their
 * error bounds I cos / d^2 x min(1, R^2 / d^2) is within 16 x query->error of all light (R: a node's half diagonal, d:
 * its minimum distance; real errors are far below their bounds), and until no node with children gives more than
 * query->error of it. A node lights each pixel by I cos / d^2 from the mean position of its lights. Whether a pixel
 * sees it, and is in a spot's cone, is tested with its strongest light and with one drawn by intensity. Nodes whose
 * cones miss the tile are left out. Where the four corners of a tile's surface agree, all of its pixels use their
 * answer; a light that gives more than query->error of all is tested by each pixel.
 * Measured in rooms with 100 to 1,000,000 lights (truth/many_lights_*): at 0.02 the picture's relative RMSE is 0.012 to
 * 0.014, at 0.01 0.007 to 0.010.
 * Returns LMB_OK or LMB_ERR_ARG. Stack: under 1 KiB. */
lmb_status lmb_many_lights_direct_tile(lmb_irradiance *inout, const lmb_kernels *kernels,
                                       lmb_many_lights_scratch *scratch, const lmb_tile *tile,
                                       const lmb_many_lights_query *query);

#ifdef __cplusplus
}
#endif
#endif
