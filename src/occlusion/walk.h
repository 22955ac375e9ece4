/* walk.h: how deep the tree of boxes may be, and what rounding may do. Floor 4. */
#ifndef LMB_OCCLUSION_WALK_H
#define LMB_OCCLUSION_WALK_H

#include <lambent/occlusion.h>

/* Levels: eight for 2^31 triangles cut into sixteen by halves, and as many above for cuts that are not even. */
#define LMB_WALK_LEVELS 16

/* Of the largest coordinate: some rounding steps of positions and planes. */
#define LMB_BLOCKER_NOISE 3.8146973e-6f /* 2^-18 */

#endif
