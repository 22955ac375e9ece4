/* key_path.h: a file of keys: positions of lights, camera and objects over time. */
#ifndef KEY_PATH_H
#define KEY_PATH_H

#include <lambent/types.h>

#include "report.h"

enum { KEY_LIGHT = 1, KEY_CAMERA = 2, KEY_OBJECT = 4 };

typedef struct path_key {
    double time_s;
    lmb_vec3 at, target;
    int has_target;
} path_key;

/* The keys of one item, sorted by time. Either all have a target or none. */
typedef struct key_track {
    int what;       /* KEY_* */
    uint32_t index; /* of the lights or objects */
    uint32_t first, count;
    uint32_t line;  /* of the first key */
} key_track;

enum { KEY_TRACKS = 64, KEY_MOST = 10000 };

/* Zeroed: none. key_path_free releases it. */
typedef struct key_path {
    path_key *key;
    uint32_t key_count;
    key_track track[KEY_TRACKS];
    uint32_t track_count;
} key_path;

/* key_path_read: returns 1, or 0 with `r` set, with the line number. */
int key_path_read(key_path *out, const char *file, report *r);
void key_path_free(key_path *path);

/* key_path_at: the state of a track at a time: on a Catmull-Rom curve through the keys, with their times; before the
 * first key and after the last one, those apply. */
path_key key_path_at(const key_path *path, const key_track *track, double time_s);

/* The time of the last key. */
double key_path_end(const key_path *path);

#endif
