/* frame_name.h: numbered files by a pattern with one %0Nd, as frame_%04d.png. */
#ifndef FRAME_NAME_H
#define FRAME_NAME_H

#include <stddef.h>
#include <stdint.h>

#include "report.h"

/* frame_digits: N of the pattern; 0 where there is no such thing, or more than one, or a `%%`. */
int frame_digits(const char *pattern);

/* frame_name: the file of frame k by a pattern that has digits. 1, or 0 with `r` set: too long. */
int frame_name(char *out, size_t size, const char *pattern, int32_t k, report *r);

/* frame_numbered: the same; without digits OUT.png gives OUT-0007.png. */
int frame_numbered(char *out, size_t size, const char *path, int32_t k, report *r);

/* frames_can_write: could the first be begun, and do none of so many replace a file that is read? 1, or 0 with `r` set. */
int frames_can_write(const char *path, int32_t count, report *r);

#endif
