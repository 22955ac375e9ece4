/* io_file.h: reads and writes whole files. Writers create a temporary file, then rename it. */
#ifndef IO_FILE_H
#define IO_FILE_H

#include <stddef.h>
#include <stdint.h>

#include "report.h"

/* The bytes of a file. file_free releases them. */
typedef struct file_bytes {
    uint8_t *data;
    size_t size;
} file_bytes;

/* All calls below return 1, or 0 with `r` set and nothing allocated or left on disk. */

/* file_read: reads a file or pipe of at most 4 GiB; `-` is standard input. */
int file_read(file_bytes *out, const char *path, report *r);
void file_free(file_bytes *file);

/* file_is_plain: 1 for a regular file or a link to one; 0 for folders, devices and pipes. `r` may be NULL. */
int file_is_plain(const char *path, report *r);

/* file_is_folder: 1 for a folder or a link to one. */
int file_is_folder(const char *path);

/* file_is_stdout: 1 for `-`, /dev/stdout, or a name like `png:-`, three letters that select the format. */
int file_is_stdout(const char *path);

/* file_only_here: from now on file_is_below refuses files outside the folder, until file_keep_end. file_is_below:
 * returns 1 if a file that another file refers to may be read. `folder` ends with a slash, or is "" for the current
 * folder. Refuses absolute paths, and .. or links that leave the folder; the result does not reveal whether such a file
 * exists. Returns 1 if file_only_here was not called. */
void file_only_here(void);
int file_is_below(const char *path, const char *folder, size_t folder_size, report *r);

/* file_suits: checks that the ending of a name does not belong to another kind of file: a picture, a model, a table,
 * or another lambent file. `option` is for the message; `own` is the ending of the output, as ".lmt". No ending, or
 * an unknown one, suits anything. */
int file_suits(const char *option, const char *path, const char *own, report *r);

/* file_keep: protects an input file from being overwritten by the same command, under any name. file_keep_all:
 * protects each file that file_read reads from now on. file_keep_end: ends all protection; call it when the command
 * is done. */
int file_keep(const char *path, report *r);
void file_keep_all(void);
void file_keep_end(void);

/* file_write: writes `size` bytes to `path` completely or not at all: writes a temporary file beside it, flushes and
 * closes it with all errors checked, then renames it. Existing special files (/dev/stdout, pipes) are written
 * directly. */
int file_write(const char *path, const void *data, size_t size, report *r);

/* file_can_write: checks whether file_write could start. Call it before long work. Leaves no file behind. */
int file_can_write(const char *path, report *r);

/* file_may_replace: checks that file_write may replace an existing file, if there is one. If you write many files to
 * one folder, call file_can_write once and this for each. */
int file_may_replace(const char *path, report *r);

/* file_is_same_place: whether file_write would write both names to the same file. Follows links. */
int file_is_same_place(const char *a, const char *b);

/* file_drop_aside: removes the temporary file, if there is one. For signals that end the program. */
void file_drop_aside(void);

/* file_keep_names: from now on file_write records the files that it writes, under limit_hold. file_drop_written:
 * removes all of them; the caller must hold the limit. */
void file_keep_names(void);
void file_drop_written(void);

#endif
