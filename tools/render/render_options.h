/* render_options.h: the options of `lambent render`. */
#ifndef RENDER_OPTIONS_H
#define RENDER_OPTIONS_H

#include <lambent/lambent.h>

#include "../common/report.h"
#include "../common/slice.h"
#include "../common/view_options.h"
#include "../model/model.h"
#include "ladder.h"

#define RENDER_LIGHTS 64 /* most --light options */

/* --show beyond LMB_SHOW_*: attributes of the view; contents of the shadow maps; how much light is blocked. */
enum { SHOW_DEPTH = 16, SHOW_NORMAL, SHOW_ALBEDO, SHOW_WIREFRAME, SHOW_EYE_DISTANCE };
enum { SHOW_LIGHT_DISTANCE = 32, SHOW_POINTS, SHOW_GROUPS };
enum { SHOW_OCCLUSION = 48 };

static inline int shows_attribute(int32_t show) { return show >= SHOW_DEPTH && show <= SHOW_EYE_DISTANCE; }
/* Returns whether settings are chosen for a budget. */
static inline int has_budget(const ladder_budget *b, float ms)
{
    return b->work > 0.0 || b->error > 0.0f || b->bytes > 0 || ms > 0.0f;
}

static inline int shows_map(int32_t show) { return show >= SHOW_LIGHT_DISTANCE && show <= SHOW_GROUPS; }

enum { BACKGROUND_WORLD = 0, BACKGROUND_TRANSPARENT, BACKGROUND_COLOUR };

typedef struct render_background {
    int32_t kind;   /* BACKGROUND_ */
    uint8_t rgb[3]; /* display codes, of a colour */
} render_background;

typedef struct render_options {
    const char *scene, *out, *stats, *transfer;
    view_options view;
    model_choice choice;    /* choices that the scene's file leaves open */
    const char *camera;     /* name or number; NULL: the first */
    lmb_light lights[RENDER_LIGHTS];
    float light_size[RENDER_LIGHTS]; /* m, or degrees for a sun; 0: none */
    uint32_t light_count;
    const char *world; /* sky, none, or a file; NULL: a sky if the scene has no light */
    int32_t world_changes; /* from frame to frame: scene.lights keeps room for suns. Set by `play` */
    int32_t has_sky; /* use a sky if the scene has no light; set by verbs that draw pictures */
    int32_t no_ground;
    render_background background;
    float stereo_m; /* between the eyes; 0: one eye */
    int32_t show;
    int32_t shadow_map; /* 0: automatic */
    lmb_grouping grouping;
    int32_t quality;      /* LMB_QUALITY_*: defaults of the next three, if these are 0 */
    int32_t tree;         /* first points per side of a light tree */
    float error, visibility;
    int32_t conservative;
    int32_t bounces, elements; /* 0: default */
    int32_t truncated;         /* --rest none */
    int32_t occlusion, steps;
    int32_t many_lights_cells; /* 0: only if the scene has too many lights for maps */
    float light_error;
    int32_t gather_step; /* LMB_GATHER_*; 0: default */
    int is_steady;       /* lmb_frame_settings.steady */
    int32_t is_moving;   /* many frames of one scene: set by `play` */
    int32_t samples;     /* per pixel; 0: depends on the output format */
    int32_t sorted;      /* --blend sorted */
    int glossy;          /* materials have glossy lobes */
    int32_t exposure_auto;
    float exposure_ev;
    int32_t tone; /* PICTURE_ */
    const lmb_kernels *kernels;
    int32_t threads; /* 0: one per processor */
    ladder_budget budget; /* zeros: none */
    float budget_ms;   /* 0: none */
    float rate;        /* units of work per second; 0: measured if needed */
    int json;          /* of `plan` */
    slice slice;       /* of the picture's rows, or of the frames of a sequence */
    uint64_t slice_job; /* with a slice: hash of the command line and of the files in it */
} render_options;

extern const option_table render_table, plan_table;

/* For a row of an option table (OPTION_OWN): stores a render_background. */
int render_option_background(const char *text, void *at);
#define RENDER_BACKGROUND_WANTS "world, transparent, or a colour such as ffffff"

/* Rows that other verbs share. Begin the struct of such a verb with a render_options. */
extern const option_row render_scene_rows[], render_view_rows[], render_world_rows[], render_light_rows[],
    render_bounce_rows[], render_group_rows[], render_budget_rows[], render_picture_rows[], render_other_rows[];

/* render_options_begin: sets the defaults. render_options_complete: after the command line was read, fills in open
 * options and checks that they fit together; returns 1, or 0 with `r` set. render_options_parse does both. */
void render_options_begin(render_options *out);
int render_options_complete(render_options *inout, report *r);

/* For `render` and `plan`, which has no output; argv[0] selects. Returns like options_parse. */
int render_options_parse(render_options *out, int argc, char **argv, report *r);

/* render_options_job: with a slice, computes the job hash; reads the files. Returns 1, or 0 with `r` set. */
int render_options_job(render_options *inout, const option_table *t, int argc, char **argv, report *r);

#endif
