/* play_path.h: a file of keys: when which light, camera or object is where. */
#ifndef PLAY_PATH_H
#define PLAY_PATH_H

#include <lambent/types.h>

#include "../common/report.h"

enum { PLAY_LIGHT = 1, PLAY_CAMERA = 2, PLAY_OBJECT = 4 };

typedef struct play_key {
    double time_s;
    lmb_vec3 at, target;
    int has_target;
} play_key;

/* The keys of one thing, by time. All of them have a target, or none. */
typedef struct play_track {
    int what;       /* PLAY_* */
    uint32_t index; /* of the lights or objects */
    uint32_t first, count;
    uint32_t line;  /* of its first key */
} play_track;

enum { PLAY_TRACKS = 64, PLAY_KEYS = 10000 };

/* Zeroed: none. play_path_free releases it. */
typedef struct play_path {
    play_key *key;
    uint32_t key_count;
    play_track track[PLAY_TRACKS];
    uint32_t track_count;
} play_path;

/* play_path_read: 1, or 0 with `r` set, naming the line. */
int play_path_read(play_path *out, const char *file, report *r);
void play_path_free(play_path *path);

/* play_path_at: where the track is at a time: on a smooth curve through its keys (Catmull and Rom's, by their times),
 * at the first before it and at the last after it. */
play_key play_path_at(const play_path *path, const play_track *track, double time_s);

/* When the last key is. */
double play_path_end(const play_path *path);

#endif
