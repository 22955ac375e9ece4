/* bake_slice.h: what was baked in slices: each slice's part of the bytes, and the file of all. */
#ifndef BAKE_SLICE_H
#define BAKE_SLICE_H

#include "../common/slice.h"
#include "bake_share.h"

/* A .json of `--to probes` has its numbers in a file beside it. */
enum { BAKE_FILES = 2 };

/* bake_slice_folder: OUT.shared/, in which slices pass on their steps, made if it is not there. bake_slice_numbers: the
 * second file's name, by that of a .json. Both: 1, or 0 with `r` set. */
int bake_slice_folder(char out[SLICE_NAME], const char *path, report *r);
int bake_slice_numbers(char out[SLICE_NAME], const char *path, report *r);

/* bake_slice_write: this slice's part of each file's bytes, beside `path`. bake_slice_merge: the files, where all slices
 * have the same. 1, or 0 with `r` set. */
int bake_slice_write(const char *path, const bake_share *s, const char *about, const file_bytes *file, int32_t files,
                     report *r);
int bake_slice_merge(const char *path, const slice_set *set, report *r);

#endif
