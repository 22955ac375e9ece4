/* wireframe.h: the edges of a scene's triangles, as far as no surface hides them. */
#ifndef WIREFRAME_H
#define WIREFRAME_H

#include "render_job.h"

/* wireframe_draw: white lines on black into frame.out, of the eye at hand, whose depth is drawn anew. LMB_OK, or an error
 * of lmb_draw_list; LMB_ERR_CAPACITY if memory is short. */
lmb_status wireframe_draw(render_job *j);

#endif
