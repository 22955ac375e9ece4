/* key_path.h: a file of keys: when which light, camera or object is where. */
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

/* The keys of one thing, by time. All of them have a target, or none. */
typedef struct key_track {
    int what;       /* PLAY_* */
    uint32_t index; /* of the lights or objects */
    uint32_t first, count;
    uint32_t line;  /* of its first key */
} key_track;

enum { KEY_TRACKS = 64, KEY_MOST = 10000 };

/* Zeroed: none. key_path_free releases it. */
typedef struct key_path {
    path_key *key;
    uint32_t key_count;
    key_track track[KEY_TRACKS];
    uint32_t track_count;
} key_path;

/* key_path_read: 1, or 0 with `r` set, naming the line. */
int key_path_read(key_path *out, const char *file, report *r);
void key_path_free(key_path *path);

/* key_path_at: where the track is at a time: on a smooth curve through its keys (Catmull and Rom's, by their times),
 * at the first before it and at the last after it. */
path_key key_path_at(const key_path *path, const key_track *track, double time_s);

/* When the last key is. */
double key_path_end(const key_path *path);

#endif
