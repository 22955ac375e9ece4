/* slice.h: one of N slices of a work, each made on a machine of its own, and the file that carries it to where they are
 * joined. */
#ifndef SLICE_H
#define SLICE_H

#include <stddef.h>
#include <stdint.h>

#include "byte_buffer.h"
#include "io_file.h"
#include "options.h"
#include "slice_items.h"

enum { SLICE_MOST = 4096, SLICE_NAME = 4096, SLICE_ABOUT = 256 };

/* What is sliced. */
enum { SLICE_RENDER = 1, SLICE_PLAY, SLICE_BENCH, SLICE_BAKE, SLICE_BAKE_STEP };

/* A row of an option table: I/N. */
int slice_option(const char *text, void *at);
#define OPTION_SLICE_ROW(type, member, what)                                                                   \
    {.name = "--slice", .value = "I/N", .kind = OPTION_OWN, .at = offsetof(type, member), .parse = slice_option, \
     .expects = "I/N, the Ith of N slices: 1/4 .. 4/4",                                                        \
     .help = "the Ith of N slices of the " what ", for a machine of its own: written to OUT.IofN. `lambent merge` " \
             "joins all N to the bytes of one machine"}

/* slice_job: one number for what a command line makes, in any order of its options: all of them but those that change
 * no byte, the contents of the files that its table reads, and the version. slice_hash_file: another file's contents,
 * too. 1, or 0 with `r` set. */
int slice_hash_file(uint64_t *hash, const char *path, report *r);
int slice_job(uint64_t *out, const void *options, const option_table *t, int argc, char **argv, report *r);

/* slice_hash: FNV-1a of 64 bits, going on from `hash`. */
#define SLICE_HASH UINT64_C(0xcbf29ce484222325)
uint64_t slice_hash(uint64_t hash, const void *data, size_t size);

/* slice_name: OUT.IofN. slice_write: that file, whole or not at all: of which work and job it is, a line about it, what
 * it says, and a hash of all. Both: 1, or 0 with `r` set. */
int slice_name(char out[SLICE_NAME], const char *path, slice s, report *r);
int slice_write(const char *path, slice s, int32_t kind, uint64_t job, const char *about, const byte_buffer *says,
                report *r);

/* One file, read back and checked. slice_file_free releases it. */
typedef struct slice_file {
    file_bytes file;
    slice slice;
    int32_t kind;
    uint64_t job, hash;
    char about[SLICE_ABOUT];
    byte_reader says;
} slice_file;

/* slice_read: 1; 0 with `r` set, where it cannot be read, is no slice, is cut off or damaged. */
int slice_read(slice_file *out, const char *path, report *r);
void slice_file_free(slice_file *f);

/* The files of one job, one a slice, checked: in order of their numbers. */
typedef struct slice_set {
    const char *path[SLICE_MOST], *first; /* the first file that is whole: whose job it is */
    int32_t count, kind;
    uint64_t job, hash[SLICE_MOST];
    char about[SLICE_ABOUT];
} slice_set;

/* slice_gather: tells (unless quiet) of files that are cut off or damaged, which it goes without, and of slices that are
 * there twice. 1; 0 with `r` set, where slices are missing, of another job, or one is there twice and differs. */
int slice_gather(slice_set *out, const char *const *paths, int32_t count, int is_quiet, report *r);

#endif
