/* scene_check.h: the parts of lmb_scene_check, for code that builds a scene piece by piece. Layer 1. */
#ifndef LMB_BASE_SCENE_CHECK_H
#define LMB_BASE_SCENE_CHECK_H

#include <lambent/scene.h>

/* Checks a single object like lmb_scene_check. `texture_count`: of the scene. */
lmb_status lmb_check_mesh(const lmb_mesh *m);
lmb_status lmb_check_material(const lmb_material *m, uint32_t texture_count);
lmb_status lmb_check_light(const lmb_light *l);
lmb_status lmb_check_bounds(const lmb_scene *s); /* and the core */

#endif
