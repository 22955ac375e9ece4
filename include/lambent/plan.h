/* plan.h: a frame before it is drawn: which stages it runs and which it leaves out, why, what each costs; and the
 * settings that meet a budget.
 *
 *     lmb_render_begin(&r, &frame);          or lmb_render_reuse: checks everything, writes no pixel
 *     lmb_plan_frame(&plan, &r, NULL);       what r will do: stages, operations, work, bytes
 *
 * A frame skips only what can change no byte of its picture. For a budget, settings are chosen by drawing a few tiles
 * of the scene itself at several settings, from coarse to fine: the rungs of a ladder (lmb_plan_rung).
 *
 *     lmb_survey_even(&places, &r, ...);           which tiles of a frame that is solved are sampled
 *     lmb_render_sample(&sample, &r, ...);         their light by one rung, then by the next: what that takes, and
 *     lmb_tile_sample_error(&sample, &next, 1.0f); how far the two are apart, go into `facts`
 *     lmb_plan_choose(&choice, &facts, &budget, fixed);
 *
 * All of it is a function of scene, view and numbers: no clock, the same on every target. Work is counted in units: one
 * is the time of a pixel gathering a node's light. How many of them a computer does in a second is for the caller to
 * measure (`lambent bench --calibrate`).
 *
 * Stability: experimental. */
#ifndef LMB_PLAN_H
#define LMB_PLAN_H

#include "render.h"

/* Operations that stages are counted in. */
typedef enum lmb_op {
    LMB_OP_TRIANGLES = 0, /* set up for a face of a map, or for the view */
    LMB_OP_TEXELS,        /* of depth and ids, cleared and filled */
    LMB_OP_BVH,           /* triangles put into the tree of boxes */
    LMB_OP_RESOLVED,      /* texels or pixels whose surface is looked up */
    LMB_OP_SUMMED,        /* first points summed up into nodes, or joined and grouped */
    LMB_OP_ELEMENTS,      /* triangles cut into pieces that light one another */
    LMB_OP_LIGHTING,      /* pixels times lights */
    LMB_OP_CUTS,          /* tiles that take their part of a tree, or of the groups */
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
    LMB_PLAN_VIEW,      /* depth and ids of what the viewer sees */
    LMB_PLAN_RESOLVE,   /* attributes of the pixels */
    LMB_PLAN_DIRECT,    /* light from the lights, with shadows */
    LMB_PLAN_GATHER,    /* bounced light */
    LMB_PLAN_OCCLUSION, /* which pixels see the nodes that light them */
    LMB_PLAN_LOBES,     /* highlights and reflections */
    LMB_PLAN_EMISSION,  /* light that surfaces emit towards the viewer */
    LMB_PLAN_STORE,     /* composed and written */
    LMB_PLAN_STAGES
} lmb_plan_stage;

/* Why a stage, or a shadow map, is skipped. All but the last two change no byte. */
typedef enum lmb_why {
    LMB_WHY_RUNS = 0,
    LMB_WHY_NOT_SHOWN,   /* the picture does not show it */
    LMB_WHY_NOT_ASKED,   /* the settings ask for none, or there is no memory for it */
    LMB_WHY_EMPTY,       /* there is no triangle */
    LMB_WHY_NO_LIGHT,    /* no light, or none that gives any, meets a triangle */
    LMB_WHY_BLACK,       /* nothing that is drawn reflects */
    LMB_WHY_NO_LOBE,     /* nothing that is drawn is glossy */
    LMB_WHY_NO_EMISSION, /* nothing that is drawn emits light */
    LMB_WHY_REUSED,      /* the last frame's is reused */
    LMB_WHY_CONVEX,      /* a convex, empty room: nothing in it blocks anything */
    LMB_WHY_PAST,        /* a light: all of the scene lies past its faces */
    LMB_WHY_DIM,         /* a light: what bounces of it is under half a display step everywhere: bounded */
    LMB_WHY_BUDGET,      /* left out to meet a budget: by an estimated error */
    LMB_WHYS
} lmb_why;

/* How well it is known what skipping a stage changes: it runs; nothing; no more than `bound`; by an estimate. */
typedef enum lmb_proof { LMB_PROOF_RUNS = 0, LMB_PROOF_EXACT, LMB_PROOF_BOUND, LMB_PROOF_ESTIMATE } lmb_proof;

typedef struct lmb_plan_row {
    int32_t why, proof;  /* lmb_why, lmb_proof */
    float bound;         /* where proof is BOUND: upper bound of a pixel's change, radiance */
    double op[LMB_OPS];  /* predicted counts */
    double work;         /* units */
    uint64_t bytes;      /* that the stage's results take */
} lmb_plan_row;

/* Settings of bounced light by LMB_GROUP_CUT; the fields of lmb_frame and lmb_tree of the same names. */
typedef struct lmb_settings {
    int32_t shadow_map, tree;
    float error, visibility;
    int32_t gather_step, occlusion;
} lmb_settings;

/* What sampling found of one rung of the ladder (lmb_plan_rung). */
typedef struct lmb_rung {
    int32_t places;         /* sampled; 0: none, and the numbers are guessed from the rung before */
    float pairs, segments;  /* per tile of the picture */
    float error;            /* estimated upper bound, by lmb_tile_sample_error against the next rung; below 0: not checked */
} lmb_rung;

/* What sampling some tiles of a solved frame found. The last rung checks the one before: it is never chosen itself. */
enum { LMB_PLAN_RUNGS = 8 };
typedef struct lmb_facts {
    double triangles, faces, tiles, lights; /* of the scene; drawn, of maps; of the frame; that light directly */
    double bounces, elements;               /* of the frame, one more where materials emit light; their cap, 0: none */
    double pairs, segments;                 /* of all tiles, by the frame's own settings; both 0: not known */
    int32_t wanted_map;                     /* texels a side of a map whose texels are as fine as the picture */
    int32_t max;                            /* texels a side of the largest map or tree that may be chosen */
    int32_t convex;                         /* 1: a convex, empty room: nothing blocks */
    lmb_rung rung[LMB_PLAN_RUNGS];
} lmb_facts;

/* What a frame may cost; 0: no limit. */
typedef struct lmb_budget {
    double work;    /* units */
    float error;    /* of bounced light: as lmb_tile_sample_error, against a finer setting */
    uint64_t bytes; /* of maps, tree, the BVH, elements, view, picture and one thread's scratch */
} lmb_budget;

/* Settings for a budget, and their estimated cost. */
typedef struct lmb_choice {
    int32_t rung;
    lmb_settings settings;
    double work, op[LMB_OPS];
    float error;   /* estimated upper bound; below 0: not checked */
    uint64_t bytes;
    int32_t meets; /* 1: the whole budget is met. An error that was not checked meets no budget of errors */
} lmb_choice;

/* Which tiles of a frame are sampled: places of one tile each, or of LMB_SPARSE_TILES side by side where bounced light
 * is gathered for some of the pixels only. */
enum { LMB_SAMPLE_TILES = 192, LMB_SAMPLE_BLOCKS = 80 };
enum { LMB_SAMPLE_PIXELS = LMB_SAMPLE_BLOCKS * LMB_SPARSE_TILES * LMB_TILE_PIXELS };
typedef struct lmb_survey {
    int32_t tiles, count;                              /* tiles of a place; places */
    uint16_t x[LMB_SAMPLE_TILES], y[LMB_SAMPLE_TILES]; /* the places' first pixels */
} lmb_survey;

/* The light of a survey's places, by one setting. 250 KB of the caller's. */
typedef struct lmb_tile_sample {
    int32_t tiles, places;             /* tiles of a place; places sampled: the rest of `light` is not written */
    float light[LMB_SAMPLE_PIXELS][3]; /* W/m2; below 0: no surface */
    double pairs, segments;            /* of these places */
} lmb_tile_sample;

typedef struct lmb_plan {
    lmb_plan_row row[LMB_PLAN_STAGES];
    uint8_t light[LMB_MAX_LIGHTS]; /* lmb_why of each light's shadow map */
    uint32_t faces, faces_drawn;   /* of the shadow maps: there, and drawn in this frame */
    double work;                   /* units: sum over the rows */
    uint64_t bytes;                /* sum over the rows, with scratch and picture */
} lmb_plan;

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_plan_frame: what a frame that began, and has not gone on, will do.
 *
 *   begun  by lmb_render_begin or lmb_render_reuse; read.
 *   facts  NULL: pairs and segments of the gather, which only sampling can tell, count as 0, and so does their cost.
 * Counts of triangles, texels, pixels, tiles and lights are exact, for frames drawn in one piece (parts set up all
 * triangles each) without holes in masks. Returns LMB_OK, or LMB_ERR_ARG (null; a frame that failed or has gone on).
 * Cost: a pass over instances, lights and, where that may be convex, triangles. */
lmb_status lmb_plan_frame(lmb_plan *out, const lmb_render *begun, const lmb_facts *facts);

/* lmb_plan_units: the work of one operation; 0 for other numbers. */
double lmb_plan_units(int32_t op);

/* lmb_survey_even: places spread evenly over a frame.
 *
 *   r       a frame by LMB_GROUP_CUT, at LMB_STAGE_BANDS, with a whole frame's eye; read. lmb_render_again, or writing
 *           to r->frame, changes error, visibility, gather_step and occlusion between samples.
 *   tiles   of a place: 1, or LMB_SPARSE_TILES side by side for a gather_step over 1.
 *   wanted  how many places, up to LMB_SAMPLE_TILES or LMB_SAMPLE_BLOCKS; there may be fewer.
 * The first few of them are spread evenly too, as sampling may end early. Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_survey_even(lmb_survey *out, const lmb_render *r, int32_t tiles, int32_t wanted);

/* lmb_render_sample: bounced light of a survey's places by the frame's present settings.
 *
 *   r       as above; read.
 *   places  of a survey by a gather_step of 1 where this is by 1, else of one over 1; or that by 1 again, to compare.
 *   max     units of work after which no further place is sampled; 0: no limit. out->places says how many were.
 * Returns LMB_OK or LMB_ERR_ARG; that too by LMB_GATHER_ADAPTIVE, whose samples depend on those of the whole frame: some
 * places do not tell what it takes. Cost: that of the places. */
lmb_status lmb_render_sample(lmb_tile_sample *out, const lmb_render *r, lmb_band_scratch *scratch,
                             const lmb_survey *places, double max);

/* lmb_tile_sample_error: how far `a` is from `b`, by the places that both have: root of the mean square over the
 * pixels' channels, without the worst 1 % of the pixels, over the mean of b; to the mean square are added so many
 * `deviations` of its own standard deviation, from how places differ: a bound, as places are few. Below 0 where that
 * says nothing: fewer than 4 places, or b is dark. */
float lmb_tile_sample_error(const lmb_tile_sample *a, const lmb_tile_sample *b, float deviations);

/* lmb_plan_rung: the settings of a rung, 0: coarsest. The last four are `draft`, `default`, `best` and one finer. Trees
 * and maps have up to facts->max texels a side. */
void lmb_plan_rung(lmb_settings *out, const lmb_facts *facts, int32_t rung);

/* lmb_plan_cost: settings of a rung and what they take. `fixed`: bytes that no setting changes: picture, view, scratch,
 * the BVH, elements. out->meets is not set. */
void lmb_plan_cost(lmb_choice *out, const lmb_facts *facts, int32_t rung, uint64_t fixed);

/* lmb_plan_choose: the finest rung, sampled or guessed, within budget->work and bytes; where budget->error is given,
 * the coarsest rung that meets it too. Where none does, the one that is nearest: out->meets is 0, and the numbers say
 * how far off it is. Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_plan_choose(lmb_choice *out, const lmb_facts *facts, const lmb_budget *budget, uint64_t fixed);

/* lmb_why_name, lmb_op_name, lmb_plan_stage_name: in a few words; "?" for other numbers. Never NULL. */
const char *lmb_why_name(int32_t why);
const char *lmb_op_name(int32_t op);
const char *lmb_plan_stage_name(int32_t stage);

#ifdef __cplusplus
}
#endif
#endif
