/* render_slice.h: some rows of a picture's light as a slice's file, and the picture of all of them. */
#ifndef RENDER_SLICE_H
#define RENDER_SLICE_H

#include "render_finish.h"

/* render_slice_write: the bands of j->o.slice, beside j->o.out. render_slice_merge: the picture, from the slices of one
 * job; `path` has the ending that they were made for. 1, or 0 with `r` set. */
int render_slice_write(const render_job *j, const render_finish *f, report *r);
int render_slice_merge(const char *path, const slice_set *set, int is_quiet, report *r);

#endif
