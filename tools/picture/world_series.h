/* world_series.h: a world that changes: numbered files, blended from one to the next. [S20 S28] */
#ifndef WORLD_SERIES_H
#define WORLD_SERIES_H

#include "world_read.h"

/* Files of one pattern with consecutive numbers. */
typedef struct world_series {
    const char *pattern; /* of the caller; NULL: no series */
    int32_t first, count;
} world_series;

/* A place between two files: the first one's index from 0, and the share of the next, 0 .. under 1. */
typedef struct world_moment {
    int32_t index;
    float share;
} world_moment;

/* world_series_find: finds the files of a pattern with one %0Nd, from the lowest number under 10,000 on.
 * world_series_name: the name of a file. Return 1, or 0 with `r` set. */
int world_series_find(world_series *out, const char *pattern, report *r);
int world_series_name(char *out, size_t size, const world_series *s, int32_t index, report *r);

/* world_series_at: the moment of picture k, with `every` pictures from one file to the next; the last file stays. */
world_moment world_series_at(const world_series *s, int32_t k, int32_t every);

/* world_series_check: reads each file that `pictures` pictures from picture `first` on use, before they are drawn, and
 * protects it from being overwritten. If `has_one_size` is set, all must have faces of one size, as a blend needs.
 * Returns 1, or 0 with `r` set. */
int world_series_check(const world_series *s, int32_t first, int32_t pictures, int32_t every, int has_one_size,
                       report *r);

/* world_series_tell: prints a note if the series ends before the last of the pictures. */
void world_series_tell(const world_series *s, int32_t last_picture, int32_t every, int is_quiet);

/* world_series_read: reads the cube of a moment. `own` takes the memory that `out` points into. Returns 1, or 0 with
 * `r` set. */
int world_series_read(lmb_world_pictures *out, world_pictures *own, const world_series *s, world_moment at, report *r);

#endif
