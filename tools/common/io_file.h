/* io_file.h: whole files in and out. Every writer writes aside, then renames. */
#ifndef IO_FILE_H
#define IO_FILE_H

#include <stddef.h>
#include <stdint.h>

#include "report.h"

/* A whole file. file_free releases it. */
typedef struct file_bytes {
    uint8_t *data;
    size_t size;
} file_bytes;

/* All functions below return 1, or 0 with `r` set and nothing allocated, nothing left on disk. */

/* file_read: the whole file (regular or pipe), at most 4 GiB. */
int file_read(file_bytes *out, const char *path, report *r);
void file_free(file_bytes *file);

/* file_is_plain: a regular file, or a link to one; no folder, device or pipe. */
int file_is_plain(const char *path, report *r);

/* file_write: write `size` bytes to `path`, whole or not at all: to a temporary file beside it, flushed and closed
 * with every error checked, then renamed over it. Existing special files (/dev/stdout, pipes) are written directly. */
int file_write(const char *path, const void *data, size_t size, report *r);

/* file_can_write: could file_write begin? Ask before long work. Leaves nothing behind. */
int file_can_write(const char *path, report *r);

#endif
