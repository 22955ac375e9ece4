/* walk.h: how deep the tree of boxes may be. Floor 4. */
#ifndef LMB_OCCLUSION_WALK_H
#define LMB_OCCLUSION_WALK_H

#include <lambent/occlusion.h>

/* Levels: eight for 2^31 triangles cut into sixteen by halves, and as many above for cuts that are not even. */
#define LMB_WALK_LEVELS 16
/* Nodes that may wait while one way down is gone: all but one of each level. */
#define LMB_WALK_STACK (LMB_WALK_LEVELS * (LMB_BOXES - 1) + 1)

#endif
