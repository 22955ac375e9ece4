/* bake_slice.h: a bake in slices: the part of the output that each slice writes, and the merged file. */
#ifndef BAKE_SLICE_H
#define BAKE_SLICE_H

#include "../common/slice.h"
#include "bake_share.h"

/* The .json of `--to probes` has a second file with the numbers. */
enum { BAKE_FILES = 2 };

/* bake_slice_folder: creates OUT.shared/, through which slices exchange their steps, if it does not exist.
 * bake_slice_numbers: returns the name of the second file that belongs to a .json. Both return 1, or 0 with `r` set. */
int bake_slice_folder(char out[SLICE_NAME], const char *path, report *r);
int bake_slice_numbers(char out[SLICE_NAME], const char *path, report *r);

/* bake_slice_write: writes this slice's part of each file, beside `path`. bake_slice_merge: writes the files if all
 * slices agree. Both return 1, or 0 with `r` set. */
int bake_slice_write(const char *path, const bake_share *s, const char *about, const file_bytes *file, int32_t files,
                     report *r);
int bake_slice_merge(const char *path, const slice_set *set, report *r);

#endif
