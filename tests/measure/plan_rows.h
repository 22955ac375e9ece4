/* plan_rows.h: measurements of scenes by settings, in a file, so that fitting need not measure again. */
#ifndef PLAN_ROWS_H
#define PLAN_ROWS_H

#include <stdio.h>

#include "../../tools/render/render_job.h"

enum { PLAN_WIDTH = 240, PLAN_HEIGHT = 180, PLAN_SCENES = 16, PLAN_RUNS = 64, PLAN_TIMES = LMB_STAGE_DONE };

/* One setting and the measurement of a frame. */
typedef struct plan_run {
    ladder_settings s;
    double seconds[PLAN_TIMES]; /* processor time by stage */
    double pairs, segments; /* counted */
} plan_run;

typedef struct plan_scene {
    char name[32];
    int fits; /* 1: the model is fitted to it */
    double shown, fixed;
    ladder_facts facts;
    plan_run run[PLAN_RUNS];
    int runs;
} plan_scene;

double plan_seconds(const plan_run *r);

/* plan_open: loads a scene of the list, ready to draw, on one thread. Returns 0 if the scene is missing, else 1. */
typedef struct plan_place {
    const char *name, *path, *options; /* options for the scene beside the common ones; separated by one space */
    int fits, heavy;                   /* heavy: fewer settings are drawn */
} plan_place;
extern const plan_place plan_places[];
extern const int plan_place_count;
int plan_open(render_job *j, const plan_place *at);

/* plan_draw: measures one setting. */
int plan_draw(plan_run *out, render_job *j);

/* plan_measure: measures all settings of one scene. */
int plan_measure(plan_scene *out, const plan_place *at);

/* plan_fit: writes the model fitted to all scenes with `fits` set, as plan_model.inc. */
void plan_fit(const plan_scene *s, int count, FILE *out);

#endif
