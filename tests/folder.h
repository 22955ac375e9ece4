/* folder.h: a test's temporary folder and the files in it. Include it before any system header. */
#ifndef FOLDER_H
#define FOLDER_H

#if !defined(_WIN32) && !defined(_XOPEN_SOURCE)
#define _XOPEN_SOURCE 700 /* mkdtemp, rmdir */
#endif
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifndef _WIN32
#include <unistd.h>
#endif

#include "test.h"

enum { FOLDER_PATH = 512, FOLDER_FILES = 64 };

typedef struct folder {
    char path[FOLDER_PATH];
    char files[FOLDER_FILES][FOLDER_PATH]; /* written there, each once */
    int count;
} folder;

static inline void folder_open(folder *f)
{
    const char *parent = getenv("TMPDIR");
    memset(f, 0, sizeof *f);
#ifdef _WIN32
    (void)parent;
    strcpy(f->path, ".");
#else
    snprintf(f->path, sizeof f->path, "%.400s/lambent_XXXXXX", parent && *parent ? parent : "/tmp");
    CHECK_MSG(mkdtemp(f->path) != NULL, "no temporary folder %s", f->path);
#endif
}

/* The path of a file that is written there by others; folder_close removes it. */
static inline const char *folder_file(folder *f, const char *name)
{
    int i;
    char path[FOLDER_PATH];
    snprintf(path, sizeof path, "%.440s/%.60s", f->path, name);
    for (i = 0; i < f->count && strcmp(f->files[i], path) != 0; ++i)
        continue;
    CHECK_MSG(i < FOLDER_FILES, "more than %d files", FOLDER_FILES);
    memcpy(f->files[i], path, sizeof path);
    f->count += i == f->count;
    return f->files[i];
}

/* Write a file, or write over it; its path. */
static inline const char *folder_put(folder *f, const char *name, const void *data, size_t size)
{
    const char *path = folder_file(f, name);
    FILE *to;
    remove(path); /* a new file is quicker than a truncated one, which some systems flush */
    to = fopen(path, "wb");
    CHECK_MSG(to && fwrite(data, 1, size, to) == size, "cannot write %s", path);
    if (to)
        fclose(to);
    return path;
}

static inline void folder_close(folder *f)
{
    int i;
    for (i = 0; i < f->count; ++i)
        remove(f->files[i]);
#ifndef _WIN32
    rmdir(f->path);
#endif
}

#endif
