/* programs.h: other people's programs: those of a folder, run one at a time, and what they print. */
#ifndef PROGRAMS_H
#define PROGRAMS_H

#include <stddef.h>

enum { PROGRAMS = 32, PROGRAM_NAME = 64 };

/* Names of files in a folder, by the alphabet. */
typedef struct programs {
    char name[PROGRAMS][PROGRAM_NAME];
    int count;
} programs;

/* How a program ended. */
enum { PROGRAM_DONE, PROGRAM_FAILED, PROGRAM_SIGNAL, PROGRAM_NOT_RUN };

/* programs_find: the files of a folder that may be run, the first PROGRAMS of them. Names of other signs than letters,
 * digits and . + - _, or with a dot first, are left out, and so are longer ones than fit.
 * 1; 0 where the folder cannot be read, or the system runs no programs this way (Windows). */
int programs_find(programs *out, const char *folder);

/* program_run: run one with one argument and wait for it. What it prints is kept up to `size` - 1 bytes, with a zero
 * behind; its errors go where this program's go. `code`: its exit status, or the signal's number. */
int program_run(int *code, const char *path, const char *argument, char *printed, size_t size);

/* program_tell: programs that are run from now on find this in their environment. */
void program_tell(const char *name, const char *value);

#endif
