/* relight_path.h: a file of places, X,Y,Z per line and, if the world changes there, a blank and the new world's name,
 * relative to the file. Empty lines and lines that begin with # are ignored. */
#ifndef RELIGHT_PATH_H
#define RELIGHT_PATH_H

#include <lambent/probe.h>

#include "../common/report.h"

typedef struct place_list {
    lmb_vec3 *place;
    char **world; /* by place: the world from here on; NULL: unchanged */
    int32_t count;
} place_list;

/* Returns 1, or 0 with `r` set; call place_list_free in either case. */
int place_list_read(place_list *out, const char *path, report *r);
void place_list_free(place_list *list);

/* place_list_walk: calls `draw` for each place with the name of a picture, derived from `out`, and finally prints how
 * often `cache` had the light. place_tell prints a place's line. They print nothing if `is_quiet` is set, and return 1,
 * or 0 with `r` set. */
typedef int place_draw(void *user, int32_t i, const char *name, report *r);
int place_list_walk(const place_list *list, const char *out, place_draw *draw, void *user, const lmb_probe_cache *cache,
                    int is_quiet, report *r);
int place_tell(const place_list *list, int32_t i, const char *name, int is_kept, int is_quiet);

#endif
