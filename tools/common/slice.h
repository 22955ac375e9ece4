/* slice.h: a job split into N slices for several machines, and the file with the results of a slice, to be merged. */
#ifndef SLICE_H
#define SLICE_H

#include <stddef.h>
#include <stdint.h>

#include "byte_buffer.h"
#include "io_file.h"
#include "options.h"
#include "slice_items.h"

enum { SLICE_MOST = 4096, SLICE_NAME = 4096, SLICE_ABOUT = 256 };

/* The kind of job. */
enum { SLICE_RENDER = 1, SLICE_PLAY, SLICE_BENCH, SLICE_BAKE, SLICE_BAKE_STEP };

/* slice_option: parses I/N, for a row of an option table. */
int slice_option(const char *text, void *at);
#define OPTION_SLICE_ROW(type, member, what)                                                                   \
    {.name = "--slice", .value = "I/N", .kind = OPTION_OWN, .at = offsetof(type, member), .parse = slice_option, \
     .expects = "I/N, the Ith of N slices: 1/4 .. 4/4",                                                        \
     .help = "compute slice I of N of the " what ", on one of several machines, into OUT.IofN. `merge` " \
             "joins all N to the same bytes as one machine"}

/* slice_job: a hash of the result of a command line, in any order of options: all options except those that change
 * no byte, the contents of input files, and the version. slice_hash_file: adds the contents of another file. Return
 * 1, or 0 with `r` set. */
int slice_hash_file(uint64_t *hash, const char *path, report *r);
int slice_job(uint64_t *out, const void *options, const option_table *t, int argc, char **argv, report *r);

/* slice_hash: 64-bit FNV-1a, continued from `hash`. */
#define SLICE_HASH UINT64_C(0xcbf29ce484222325)
uint64_t slice_hash(uint64_t hash, const void *data, size_t size);

/* slice_name: OUT.IofN. slice_write: writes that file, completely or not at all: kind, job, a line about it, the
 * data and a hash of everything. Both return 1, or 0 with `r` set. */
int slice_name(char out[SLICE_NAME], const char *path, slice s, report *r);
int slice_write(const char *path, slice s, int32_t kind, uint64_t job, const char *about, const byte_buffer *says,
                report *r);

/* A file, read back and checked. slice_file_free releases it. */
typedef struct slice_file {
    file_bytes file;
    slice slice;
    int32_t kind;
    uint64_t job, hash;
    char about[SLICE_ABOUT];
    byte_reader says;
} slice_file;

/* slice_read: returns 1; 0 with `r` set if the file is unreadable, not a slice, truncated or damaged. */
int slice_read(slice_file *out, const char *path, report *r);
void slice_file_free(slice_file *f);

/* The checked files of one job, one per slice, in order. */
typedef struct slice_set {
    const char *path[SLICE_MOST], *first; /* the first valid file; it determines the job */
    int32_t count, kind;
    uint64_t job, hash[SLICE_MOST];
    char about[SLICE_ABOUT];
} slice_set;

/* slice_gather: collects the files of a job. Prints notes (unless quiet) about truncated or damaged files, which it
 * skips, and about duplicate slices. Returns 1; 0 with `r` set if slices are missing, belong to another job, or a
 * duplicate differs. */
int slice_gather(slice_set *out, const char *const *paths, int32_t count, int is_quiet, report *r);

#endif
