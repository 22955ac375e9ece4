/* render_slice.h: writes some rows of an image's light as a slice file, and merges slice files to an image. */
#ifndef RENDER_SLICE_H
#define RENDER_SLICE_H

#include "render_finish.h"

/* render_slice_write: writes the bands of j->o.slice beside j->o.out. render_slice_merge: writes the picture from
 * the slices of one job; `path` must have the file type that they were made for. Return 1, or 0 with `r` set. */
int render_slice_write(const render_job *j, const render_finish *f, report *r);
int render_slice_merge(const char *path, const slice_set *set, int is_quiet, report *r);

#endif
