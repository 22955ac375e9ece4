/* programs.h: runs foreign programs from a folder, one at a time, and returns their output. */
#ifndef PROGRAMS_H
#define PROGRAMS_H

#include <stddef.h>

enum { PROGRAMS = 32, PROGRAM_NAME = 64 };

/* Names of files in a folder, sorted. */
typedef struct programs {
    char name[PROGRAMS][PROGRAM_NAME];
    int count;
} programs;

/* Ways in which a program ends. */
enum { PROGRAM_DONE, PROGRAM_FAILED, PROGRAM_SIGNAL, PROGRAM_NOT_RUN };

/* programs_find: finds the executable files of a folder, the first PROGRAMS of them. Skips names with characters other
 * than letters, digits and . + - _, with a leading dot, or too long. Returns 1, or 0 if the folder cannot be read or
 * the system cannot run programs this way (Windows). */
int programs_find(programs *out, const char *folder);

/* program_run: runs a program with one argument and waits for it. Stores up to `size` - 1 bytes of the output and a
 * zero; stderr is shared with this program. `code`: the exit status, or the signal's number. */
int program_run(int *code, const char *path, const char *argument, char *printed, size_t size);

/* program_tell: sets an environment variable for programs that run from now on. */
void program_tell(const char *name, const char *value);

#endif
