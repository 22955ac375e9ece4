/* play_slice.h: some frames of a sequence as a slice's file, and the pictures of all of them. */
#ifndef PLAY_SLICE_H
#define PLAY_SLICE_H

#include "../common/slice.h"
#include "../common/io_file.h"

/* play_slice_put: adds frame k, encoded as a file of a PICTURE_ format. play_slice_write: writes all added frames to a
 * file next to `out`. play_slice_merge: writes the files of all frames from the slices of one job; `pattern` has a %0Nd
 * and the ending that the slices were made for. Return 1, or 0 with `r` set. */
int play_slice_put(byte_buffer *to, int32_t k, int format, const file_bytes *file, report *r);
int play_slice_write(const char *out, slice s, uint64_t job, const char *about, const byte_buffer *made, report *r);
int play_slice_merge(const char *pattern, const slice_set *set, report *r);

#endif
