/* ladder.h: the settings of a budget: a ladder from coarse to fine, the cost of each rung, and the choice of one. */
#ifndef LADDER_H
#define LADDER_H

#include <lambent/plan.h>

/* Settings of bounced light with LMB_GROUP_CUT: the members of lmb_frame and lmb_tree of the same names. */
typedef struct ladder_settings {
    int32_t shadow_map, tree;
    float error, visibility;
    int32_t occlusion;
} ladder_settings;

/* Sampling results of one rung. */
typedef struct ladder_rung {
    int32_t places;        /* sampled; 0: none, and the numbers are extrapolated from the rung before */
    float pairs, segments; /* per tile of the picture */
    float error;           /* estimated upper bound, from ladder_error against the next rung; below 0: not checked */
} ladder_rung;

/* Sampling results of a solved frame. The last rung only checks the one before: it is never chosen. */
enum { LADDER_RUNGS = 8 };
typedef struct ladder_facts {
    double triangles, faces, tiles, lights; /* of the scene; drawn, of maps; of the frame; that light directly */
    double bounces, elements;               /* of the frame, one more if materials emit light; their capacity, 0:
                                               none */
    double pairs, segments;                 /* of all tiles, with the frame's own settings; both 0: unknown */
    int32_t wanted_map;                     /* texels a side of a map with texels as fine as the picture */
    int32_t max;                            /* upper limit for maps and trees, texels a side */
    int32_t convex;                         /* 1: a convex, empty room: no triangle in it blocks */
    ladder_rung rung[LADDER_RUNGS];
} ladder_facts;

/* Limits of a frame's cost; 0: no limit. */
typedef struct ladder_budget {
    double work;    /* units */
    float error;    /* of bounced light, against a finer setting: see ladder_error */
    uint64_t bytes; /* of maps, tree, the BVH, elements, view, picture and one thread's scratch */
} ladder_budget;

/* Settings for a budget, and their estimated cost. */
typedef struct ladder_choice {
    int32_t rung;
    ladder_settings settings;
    double work, op[LMB_OPS];
    float error;   /* estimated upper bound; below 0: not checked */
    uint64_t bytes;
    int32_t meets; /* 1: meets the whole budget. An unchecked error meets no error budget */
} ladder_choice;

/* ladder_at: the settings of a rung; 0 is the coarsest. Rungs 3, 4 and 6 are `draft`, `default` and `best`; 5 lies
 * between `default` and `best`, and 7 is finer. Trees and maps have up to facts->max texels a side. */
void ladder_at(ladder_settings *out, const ladder_facts *facts, int32_t rung);

/* ladder_cost: the settings of a rung and their cost. `fixed`: bytes that no setting changes: picture, view, scratch,
 * the BVH, elements. out->meets is not set. */
void ladder_cost(ladder_choice *out, const ladder_facts *facts, int32_t rung, uint64_t fixed);

/* ladder_cost_of: the same of out->settings, from the pairs and segments of all tiles: operations, work and bytes. */
void ladder_cost_of(ladder_choice *out, const ladder_facts *facts, double pairs, double segments, uint64_t fixed);

/* ladder_choose: the finest rung, sampled or extrapolated, within budget->work and bytes; with budget->error, the
 * coarsest rung that meets it too. If there is none, the nearest rung: out->meets is 0, and the numbers show the
 * difference. Returns 0 if facts->max is below LMB_TILE, else 1. */
int ladder_choose(ladder_choice *out, const ladder_facts *facts, const ladder_budget *budget, uint64_t fixed);

/* ladder_places: up to `wanted` places, spread evenly over a frame along a Z curve. The first few of them are spread
 * evenly too, because sampling may end early. */
void ladder_places(lmb_survey *out, const lmb_view *view, int32_t wanted);

/* ladder_error: the difference of `a` from `b` over the places that both have: root mean square over the pixels'
 * channels, without the worst 1 % of the pixels, divided by the mean of b. Places are few, so for an upper bound
 * `deviations` standard deviations of the mean square are added to the mean square. They are estimated from the
 * differences between places. Below 0 if there is no meaningful result: fewer than 4 places, or b is dark. */
float ladder_error(const lmb_tile_sample *a, const lmb_tile_sample *b, float deviations);

#endif
