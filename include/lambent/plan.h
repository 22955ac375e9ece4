/* plan.h: a frame before it is drawn: the stages that it runs or skips, with reasons and costs.
 *
 *     lmb_render_begin(&r, &frame);          or lmb_render_reuse: checks the frame, writes no pixel
 *     lmb_plan_frame(&plan, &r, 0.0, 0.0);   the work of r: stages, operations, units, bytes
 *
 * A frame skips only stages that can change no byte of the picture. The work of the gather is known only from samples:
 * lmb_render_sample draws a few tiles of a solved frame and counts it. `lambent render --budget` compares samples of
 * several settings and chooses one (tools/render/ladder.h).
 *
 * All results are functions of scene, view and numbers: no clock, the same on every target. Work is counted in units:
 * one is the time of a pixel gathering a node's light. To convert units to seconds, you can measure your computer with
 * `lambent-bench --calibrate`.
 *
 * Stability: experimental. */
#ifndef LMB_PLAN_H
#define LMB_PLAN_H

#include "render.h"

/* Operations that the work of stages is counted in. */
typedef enum lmb_op {
    LMB_OP_TRIANGLES = 0, /* set up for a face of a map, or for the view */
    LMB_OP_TEXELS,        /* of depth and ids, cleared and filled */
    LMB_OP_BVH,           /* triangles put into the tree of boxes */
    LMB_OP_RESOLVED,      /* texels or pixels with a surface that is resolved */
    LMB_OP_SUMMED,        /* first points summed up into nodes, or joined and grouped */
    LMB_OP_ELEMENTS,      /* triangles cut into pieces that light one another */
    LMB_OP_LIGHTING,      /* pixels times lights */
    LMB_OP_CUTS,          /* tiles that take a cut of a tree, or use the groups */
    LMB_OP_PAIRS,         /* pixels times nodes that light them */
    LMB_OP_SEGMENTS,      /* tested for occlusion */
    LMB_OP_LOBES,         /* pixels times lights and nodes that their lobes reflect */
    LMB_OP_STORED,        /* pixels written */
    LMB_OPS
} lmb_op;

/* The stages of a plan. */
typedef enum lmb_plan_stage {
    LMB_PLAN_MAPS = 0,  /* the shadow maps */
    LMB_PLAN_BVH,       /* the BVH */
    LMB_PLAN_POINTS,    /* first points, and their tree or groups */
    LMB_PLAN_BOUNCES,   /* elements: later bounces, and surfaces that emit light */
    LMB_PLAN_VIEW,      /* depth and ids of the view */
    LMB_PLAN_RESOLVE,   /* attributes of the pixels */
    LMB_PLAN_DIRECT,    /* light from the lights, with shadows */
    LMB_PLAN_GATHER,    /* bounced light */
    LMB_PLAN_OCCLUSION, /* visibility of nodes from the pixels that they light */
    LMB_PLAN_LOBES,     /* highlights and reflections */
    LMB_PLAN_EMISSION,  /* light that surfaces emit towards the viewer */
    LMB_PLAN_STORE,     /* composed and written */
    LMB_PLAN_STAGES
} lmb_plan_stage;

/* Reasons for skipping a stage or a shadow map. All but the last change no byte. */
typedef enum lmb_why {
    LMB_WHY_RUNS = 0,
    LMB_WHY_NOT_SHOWN,   /* the picture does not show it */
    LMB_WHY_NOT_ASKED,   /* the settings do not need it, or there is no memory for it */
    LMB_WHY_EMPTY,       /* there is no triangle */
    LMB_WHY_NO_LIGHT,    /* no light with power reaches a triangle */
    LMB_WHY_BLACK,       /* no surface in the frame reflects */
    LMB_WHY_NO_LOBE,     /* no surface in the frame is glossy */
    LMB_WHY_NO_EMISSION, /* no surface in the frame emits light */
    LMB_WHY_REUSED,      /* the last frame's result is reused */
    LMB_WHY_CONVEX,      /* a convex, empty room: no triangle in it blocks */
    LMB_WHY_PAST,        /* a light: all of the scene lies past the faces */
    LMB_WHY_DIM,         /* a light: its bounced light is provably under half a display step everywhere */
    LMB_WHYS
} lmb_why;

/* Effect of skipping a stage on the picture: the stage runs; no change; at most `bound`. */
typedef enum lmb_proof { LMB_PROOF_RUNS = 0, LMB_PROOF_EXACT, LMB_PROOF_BOUND } lmb_proof;

typedef struct lmb_plan_row {
    int32_t why, proof;  /* lmb_why, lmb_proof */
    float bound;         /* if proof is BOUND: upper bound of a pixel's change, radiance */
    double op[LMB_OPS];  /* predicted counts */
    double work;         /* units */
    uint64_t bytes;      /* memory of the stage's results */
} lmb_plan_row;

/* The tiles of a frame to sample. */
enum { LMB_SAMPLE_TILES = 192, LMB_SAMPLE_PIXELS = LMB_SAMPLE_TILES * LMB_TILE_PIXELS };
typedef struct lmb_survey {
    int32_t count;
    uint16_t x[LMB_SAMPLE_TILES], y[LMB_SAMPLE_TILES]; /* first pixel of each tile */
} lmb_survey;

/* The light of a survey's places with one setting. 150 KB of your memory. */
typedef struct lmb_tile_sample {
    int32_t places;                    /* sampled: the rest of `light` is not written */
    float light[LMB_SAMPLE_PIXELS][3]; /* W/m2; below 0: no surface */
    double pairs, segments;            /* of these places */
} lmb_tile_sample;

typedef struct lmb_plan {
    lmb_plan_row row[LMB_PLAN_STAGES];
    uint8_t light[LMB_MAX_LIGHTS]; /* lmb_why of each light's shadow map */
    uint32_t faces, faces_drawn;   /* of the shadow maps: in total, and drawn in this frame */
    double work;                   /* units: sum over the rows */
    uint64_t bytes;                /* sum over the rows, with scratch and picture */
} lmb_plan;

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_plan_frame: predict the work of a frame that has begun, and has not gone on.
 *
 *   begun            by lmb_render_begin or lmb_render_reuse; read.
 *   pairs, segments  of the gathers of all tiles, from samples; 0: unknown, and their cost counts as 0.
 * Counts of triangles, texels, pixels, tiles and lights are exact for frames drawn in one piece without holes in masks.
 * If you draw in parts, each part sets up all triangles. Returns LMB_OK, or LMB_ERR_ARG (null; a frame that failed or
 * has gone on). Cost: a pass over instances, lights and, if the scene may be convex, triangles. */
lmb_status lmb_plan_frame(lmb_plan *out, const lmb_render *begun, double pairs, double segments);

/* lmb_plan_units: the work of one operation in units; 0 for other numbers. */
double lmb_plan_units(int32_t op);

/* lmb_render_sample: bounced light of a survey's places with the frame's current settings.
 *
 *   r       a frame with LMB_GROUP_CUT, at LMB_STAGE_BANDS, with a whole frame's eye; read. To change error,
 *           visibility and occlusion between samples, call lmb_render_again or write to r->frame.
 *   max     units of work after which no further place is sampled; 0: no limit. out->places is the number sampled.
 * Returns LMB_OK or LMB_ERR_ARG. A gather_step over 1 is also refused: its samples depend on those of the whole frame,
 * so some places do not show the cost. Cost: that of the places. */
lmb_status lmb_render_sample(lmb_tile_sample *out, const lmb_render *r, lmb_band_scratch *scratch,
                             const lmb_survey *places, double max);

/* lmb_why_name, lmb_op_name, lmb_plan_stage_name: a short text; "?" for other numbers. Never NULL. */
const char *lmb_why_name(int32_t why);
const char *lmb_op_name(int32_t op);
const char *lmb_plan_stage_name(int32_t stage);

#ifdef __cplusplus
}
#endif
#endif
