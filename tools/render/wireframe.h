/* wireframe.h: the edges of a scene's triangles, without those that surfaces hide. */
#ifndef WIREFRAME_H
#define WIREFRAME_H

#include "render_job.h"

/* wireframe_draw: draws white lines on black into frame.out for the current eye, and draws the depth of this view
 * again. Returns LMB_OK, or an error of lmb_draw_list; LMB_ERR_CAPACITY if memory is short. */
lmb_status wireframe_draw(render_job *j);

#endif
