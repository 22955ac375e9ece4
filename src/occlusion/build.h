/* build.h: a BVH that is built fast, for few rays. Layer 4. */
#ifndef LMB_OCCLUSION_BUILD_H
#define LMB_OCCLUSION_BUILD_H

#include <lambent/occlusion.h>

#if LMB_FACETS

/* lmb_bvh_build with leaves in the order of the scene's triangles: faster to build, with slower rays. Returns 0 if the
 * order scatters the triangles: then call lmb_bvh_build. node_count is 0 if the triangles do not fit: then nothing
 * blocks. */
int lmb_bvh_build_in_order(lmb_bvh *inout, const lmb_scene *scene);

#endif

#endif
