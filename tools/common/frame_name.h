/* frame_name.h: numbered files from a pattern with one %0Nd, as frame_%04d.png. */
#ifndef FRAME_NAME_H
#define FRAME_NAME_H

#include <stddef.h>
#include <stdint.h>

#include "report.h"

/* frame_digits: returns N of the pattern; 0 if it has none, more than one, or a `%%`. */
int frame_digits(const char *pattern);

/* frame_name: the name of frame k, from a pattern with digits. Returns 1, or 0 with `r` set: too long. */
int frame_name(char *out, size_t size, const char *pattern, int32_t k, report *r);

/* frame_numbered: like frame_name; without digits OUT.png becomes OUT-0007.png. */
int frame_numbered(char *out, size_t size, const char *path, int32_t k, report *r);

/* frames_can_write: checks that the first of `count` files can be created, and that none replaces an input. Returns
 * 1, or 0 with `r` set. */
int frames_can_write(const char *path, int32_t count, report *r);

#endif
