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

/* file_read: the whole file (regular or pipe), at most 4 GiB; `-` is standard input. */
int file_read(file_bytes *out, const char *path, report *r);
void file_free(file_bytes *file);

/* file_is_plain: a regular file, or a link to one; no folder, device or pipe. */
int file_is_plain(const char *path, report *r);

/* file_is_folder: a folder, or a link to one. */
int file_is_folder(const char *path);

/* file_is_stdout: `-`, /dev/stdout, or `png:-` with any three letters: a name that says the format, too. */
int file_is_stdout(const char *path);

/* file_only_here: from now on file_is_below refuses files outside the folder, until file_keep_end. file_is_below:
 * returns 1 if a file that another file refers to may be read. `folder` ends with a slash, or is "" for the current
 * folder. Refuses absolute paths, and .. or links that leave the folder; the result does not reveal whether such a file
 * exists. Returns 1 if file_only_here was not called. */
void file_only_here(void);
int file_is_below(const char *path, const char *folder, size_t folder_size, report *r);

/* file_suits: is a name's ending not that of another kind of file: a picture's, a model's, a table's, or another one of
 * lambent's? `option` took the name; `own` is what would be written, as ".lmt". A name with no ending, or with an unknown
 * one, suits anything. */
int file_suits(const char *option, const char *path, const char *own, report *r);

/* file_keep: this file is read by the same command: from now on no other may be written over it, whatever its name.
 * file_keep_all: so is each that file_read reads from now on. file_keep_end: the command is over, all are forgotten. */
int file_keep(const char *path, report *r);
void file_keep_all(void);
void file_keep_end(void);

/* file_write: write `size` bytes to `path`, whole or not at all: to a temporary file beside it, flushed and closed
 * with every error checked, then renamed over it. Existing special files (/dev/stdout, pipes) are written directly. */
int file_write(const char *path, const void *data, size_t size, report *r);

/* file_can_write: could file_write begin? Ask before long work. Leaves nothing behind. */
int file_can_write(const char *path, report *r);

/* file_may_replace: is what is there, if anything is, a file that file_write would replace? Of the many names of one
 * folder file_can_write is asked for one. */
int file_may_replace(const char *path, report *r);

/* file_is_same_place: would file_write write both names to one place? Links are followed. */
int file_is_same_place(const char *a, const char *b);

/* file_drop_aside: remove the temporary file, if there is one: for signals that end the program. */
void file_drop_aside(void);

/* file_keep_names: from now on file_write records the files that it writes, under limit_hold. file_drop_written:
 * removes all of them; the caller must hold the limit. */
void file_keep_names(void);
void file_drop_written(void);

#endif
