/* occlude.h: prepares the viewer's depth map for the gather's march. Layer 4. */
#ifndef LMB_OCCLUSION_OCCLUDE_H
#define LMB_OCCLUSION_OCCLUDE_H

#include "../lane/kernels.h"

/* Returns 1 and sets the job, 0 if nothing occludes (NULL or LMB_OCCLUSION_NONE), or a negative lmb_status. */
int32_t lmb_march_setup(lmb_march_job *job, const lmb_occluder *occluder);

#endif
