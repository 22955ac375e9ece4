/* walk.h: how deep the tree of boxes may be. Floor 4. */
#ifndef LMB_OCCLUSION_WALK_H
#define LMB_OCCLUSION_WALK_H

/* Levels: 32 for 2^32 triangles cut by halves, and as many above for cuts that are not even. */
#define LMB_WALK_DEPTH 72

#endif
