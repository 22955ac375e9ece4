/* shared_file.h: sample files beside the repository, for tests that skip what is not there. */
#ifndef SHARED_FILE_H
#define SHARED_FILE_H

#include <stdlib.h>

#include "test.h"

enum { SHARED_PATH = 512 };

/* The path of a sample, from LMB_SHARED or ../shared; 0 and one skipped where it cannot be opened. */
static inline int shared_file(char path[SHARED_PATH], const char *name)
{
    const char *shared = getenv("LMB_SHARED");
    FILE *f;
    snprintf(path, SHARED_PATH, "%.300s/%.200s", shared && *shared ? shared : "../shared", name);
    f = fopen(path, "rb");
    if (!f) {
        SKIP("%s is not there (LMB_SHARED names the folder)", path);
        return 0;
    }
    fclose(f);
    return 1;
}

#endif
