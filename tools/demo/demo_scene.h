/* demo_scene.h: the built-in scene: a small gallery room in const memory, usable from flash. */
#ifndef DEMO_SCENE_H
#define DEMO_SCENE_H

#include <lambent/lambent.h>

#ifdef __cplusplus
extern "C" {
#endif

/* demo_scene: a closed room of 4 x 2.75 x 4.75 m, lit by one spot light with one shadow-map face: a red and a teal
 * wall, a tiled floor, a painting, a knot on a plinth, a sphere and a block. Static storage, never written; passes
 * lmb_scene_check. Made for an exposure of 0 EV. */
const lmb_scene *demo_scene(void);

/* demo_view: the camera, inside the room, with a vertical angle of 50 degrees for any aspect ratio. All zero if
 * lmb_view_look_at refuses the size. */
lmb_view demo_view(int32_t width, int32_t height);

#ifdef __cplusplus
}
#endif
#endif
