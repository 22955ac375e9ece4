/* programs.c: runs a folder's programs by fork and exec and reads their output through a pipe; elsewhere finds none. */
#if !defined(_WIN32) && !defined(_XOPEN_SOURCE)
#define _XOPEN_SOURCE 700 /* fork, pipe, opendir, setenv */
#endif
#include "programs.h"

#ifdef _WIN32

int programs_find(programs *out, const char *folder)
{
    (void)folder;
    out->count = 0;
    return 0;
}

int program_run(int *code, const char *path, const char *argument, char *printed, size_t size)
{
    (void)path;
    (void)argument;
    (void)printed;
    (void)size;
    *code = 0;
    return PROGRAM_NOT_RUN;
}

void program_tell(const char *name, const char *value)
{
    (void)name;
    (void)value;
}

#else

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

enum { NOT_FOUND = 127 }; /* exit status of a copy that could not run the program */

static int may_run(const char *folder, const char *name)
{
    char path[1024];
    struct stat s;
    const int n = snprintf(path, sizeof path, "%s/%s", folder, name);
    return n > 0 && (size_t)n < sizeof path && stat(path, &s) == 0 && S_ISREG(s.st_mode) && access(path, X_OK) == 0;
}

/* Names that never need quotes. */
static int is_plain(const char *name)
{
    const size_t n = strlen(name);
    return name[0] != '.' && n < PROGRAM_NAME &&
           strspn(name, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.+-_") == n;
}

/* Inserts in order; if the list is full, drops the last. */
static void insert(programs *p, const char *name)
{
    int at = p->count;
    while (at > 0 && strcmp(p->name[at - 1], name) > 0) {
        --at;
    }
    if (at == PROGRAMS) {
        return;
    }
    p->count += p->count < PROGRAMS;
    memmove(p->name[at + 1], p->name[at], (size_t)(p->count - 1 - at) * sizeof *p->name);
    strcpy(p->name[at], name);
}

int programs_find(programs *out, const char *folder)
{
    DIR *d = opendir(folder);
    out->count = 0;
    if (d == NULL) {
        return 0;
    }
    for (struct dirent *e = readdir(d); e != NULL; e = readdir(d)) {
        if (is_plain(e->d_name) && may_run(folder, e->d_name)) {
            insert(out, e->d_name);
        }
    }
    closedir(d);
    return 1;
}

/* Also reads output that does not fit, so that a full pipe does not block the program. */
static void hear(int from, char *printed, size_t size)
{
    char rest[256];
    size_t used = 0;
    for (;;) {
        const int fits = used + 1 < size;
        const ssize_t n = read(from, fits ? printed + used : rest, fits ? size - 1 - used : sizeof rest);
        if (n > 0) {
            used += fits ? (size_t)n : 0;
        } else if (n == 0 || errno != EINTR) {
            break;
        }
    }
    printed[used] = '\0';
}

int program_run(int *code, const char *path, const char *argument, char *printed, size_t size)
{
    int ends[2], status = 0;
    *code = 0;
    printed[0] = '\0';
    if (pipe(ends) != 0) {
        return PROGRAM_NOT_RUN;
    }
    const pid_t id = fork();
    if (id == 0) {
        dup2(ends[1], STDOUT_FILENO);
        close(ends[0]);
        close(ends[1]);
        execl(path, path, argument, (char *)NULL);
        _exit(NOT_FOUND);
    }
    close(ends[1]);
    if (id > 0) {
        hear(ends[0], printed, size);
    }
    close(ends[0]);
    if (id < 0 || waitpid(id, &status, 0) != id) {
        return PROGRAM_NOT_RUN;
    }
    if (WIFSIGNALED(status)) {
        *code = WTERMSIG(status);
        return PROGRAM_SIGNAL;
    }
    *code = WEXITSTATUS(status);
    return *code == 0 ? PROGRAM_DONE : *code == NOT_FOUND ? PROGRAM_NOT_RUN : PROGRAM_FAILED;
}

void program_tell(const char *name, const char *value) { setenv(name, value, 1); }

#endif
