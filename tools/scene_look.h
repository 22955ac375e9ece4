/* scene_look.h: a look at a few tiles of a scene by several settings: facts that budgets are reckoned by. */
#ifndef SCENE_LOOK_H
#define SCENE_LOOK_H

#include "render_job.h"

/* scene_look: of a job that is set, by maps and trees of its own; the job's eye and first scratch are drawn into. With
 * a budget by a ladder of settings; else by the job's own alone, for what that asks of its pixels. Where no light
 * bounces by cuts, out->tree is 0. 1, or 0 with `r` set: out of memory. */
int scene_look(lmb_facts *out, const render_job *j, report *r);

#endif
