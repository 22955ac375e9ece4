/* rooms.h: rooms for a virtual object, and their path-traced pictures with and without the object. */
#ifndef ROOMS_H
#define ROOMS_H

#include "../truth/path.h"

enum { ROOM_SIDE = 64, ROOM_PIXELS = ROOM_SIDE * ROOM_SIDE, ROOM_LIGHTS = 8 };

/* rough_metal of a material that is no metal. */
#define ROOM_MATT (-1.0)

typedef struct room {
    made_scene scene;
    uint32_t bare;                          /* number of triangles of the room; the object's follow */
    double rough_metal[SCENE_MATERIALS];    /* roughness of a metal; its albedo is F0 */
    scene_light told[ROOM_LIGHTS];          /* the lights passed to `mix` */
    int told_count;
} room;

typedef struct room_kind {
    const char *name;
    void (*build)(room *r);
    const char *what;
} room_kind;

extern const room_kind room_kinds[];
extern const int room_kind_count;

/* room_any_metal: a metal object in a room, both generated from a seed. */
void room_any_metal(room *r, uint64_t seed);

/* One picture: radiance, and depth along the axis, m. */
typedef struct room_picture {
    float rgb[3 * ROOM_PIXELS], depth[ROOM_PIXELS];
} room_picture;

/* room_trace: the picture without or with the object, `strata`^2 paths a pixel. Paths that miss the object are the same
 * in both; another value of `half` gives other paths. Returns 1, or 0 if there is no memory. */
int room_trace(room_picture *out, room *r, int with, int strata, int half);

/* room_write_object: writes only the object, as DIR/NAME.gltf. Returns 1, or 0 if it cannot be written. */
int room_write_object(const room *r, const char *path);

#endif
