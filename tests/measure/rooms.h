/* rooms.h: rooms into which an object is put, and their path-traced pictures with and without it. */
#ifndef ROOMS_H
#define ROOMS_H

#include "../truth/path.h"

enum { ROOM_SIDE = 64, ROOM_PIXELS = ROOM_SIDE * ROOM_SIDE, ROOM_LIGHTS = 8 };

/* What rough_metal is of a material that is none. */
#define ROOM_MATT (-1.0)

typedef struct room {
    made_scene scene;
    uint32_t bare;                          /* so many triangles, the first ones, are there without the object */
    double rough_metal[SCENE_MATERIALS];    /* roughness of a metal, whose albedo is what it reflects straight on */
    scene_light told[ROOM_LIGHTS];          /* the lights that `mix` is told of */
    int told_count;
} room;

typedef struct room_kind {
    const char *name;
    void (*build)(room *r);
    const char *what;
} room_kind;

extern const room_kind room_kinds[];
extern const int room_kind_count;

/* room_any_metal: a metal object in a room, all of it by a number. */
void room_any_metal(room *r, uint64_t seed);

/* One picture: radiance, and depth along the axis, m. */
typedef struct room_picture {
    float rgb[3 * ROOM_PIXELS], depth[ROOM_PIXELS];
} room_picture;

/* room_trace: the picture without or with the object, `strata`^2 paths a pixel, of which those that do not meet the
 * object are the same in both; other numbers of `half` take other paths. 1, or 0 without memory. */
int room_trace(room_picture *out, room *r, int with, int strata, int half);

/* room_write_object: the object alone as DIR/NAME.gltf. 1, or 0 where it cannot be written. */
int room_write_object(const room *r, const char *path);

#endif
