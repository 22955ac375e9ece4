/* fault.c: preloaded into a program: the Nth call of one kind fails, or a signal comes there. glibc only.
 *
 * FAULT=KIND:N makes it fail; FAULT=KIND:N:SIGNAL raises the signal there. KIND: alloc, open, write, rename or thread.
 * FAULT_COUNTS=FILE: how many there were of each, in this order. What goes to stderr never fails. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { ALLOC, OPEN, WRITE, RENAME, THREAD, KINDS };

enum { ERROR_SEEN = 0x20 }; /* of FILE._flags: what ferror tells */

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *p, size_t size);

static int armed, kind = -1, number, signal_number;
static int counts[KINDS];

static FILE *(*next_fopen)(const char *, const char *);
static FILE *(*next_fdopen)(int, const char *);
static int (*next_open)(const char *, int, ...);
static size_t (*next_fwrite)(const void *, size_t, size_t, FILE *);
static int (*next_fflush)(FILE *);
static int (*next_fclose)(FILE *);
static int (*next_rename)(const char *, const char *);
static int (*next_thread)(pthread_t *, const pthread_attr_t *, void *(*)(void *), void *);

/* C has no cast from void * to a pointer to a function. */
static void find(void *function, const char *name)
{
    void *found = dlsym(RTLD_NEXT, name);
    memcpy(function, &found, sizeof found);
}

__attribute__((constructor)) static void begin(void)
{
    static const char *const names[KINDS] = {"alloc", "open", "write", "rename", "thread"};
    const char *what = getenv("FAULT");
    find(&next_fopen, "fopen");
    find(&next_fdopen, "fdopen");
    find(&next_open, "open");
    find(&next_fwrite, "fwrite");
    find(&next_fflush, "fflush");
    find(&next_fclose, "fclose");
    find(&next_rename, "rename");
    find(&next_thread, "pthread_create");
    for (int i = 0; what != NULL && i < KINDS; ++i) {
        const size_t n = strlen(names[i]);
        if (strncmp(what, names[i], n) == 0 && what[n] == ':') {
            kind = i;
            sscanf(what + n + 1, "%d:%d", &number, &signal_number);
        }
    }
    armed = 1;
}

__attribute__((destructor)) static void end(void)
{
    const char *path = getenv("FAULT_COUNTS");
    char text[128];
    int n = 0;
    armed = 0;
    for (int i = 0; i < KINDS; ++i) {
        n += snprintf(text + n, sizeof text - (size_t)n, "%d ", counts[i]);
    }
    const int fd = path != NULL ? next_open(path, O_WRONLY | O_CREAT | O_TRUNC, 0666) : -1;
    if (fd >= 0) {
        (void)!write(fd, text, (size_t)n);
        close(fd);
    }
}

/* Does this call fail? */
static int fails(int which, int error)
{
    if (!armed || __atomic_add_fetch(&counts[which], 1, __ATOMIC_RELAXED) != number || which != kind) {
        return 0;
    }
    if (signal_number != 0) {
        raise(signal_number);
        return 0;
    }
    errno = error;
    return 1;
}

void *malloc(size_t size) { return fails(ALLOC, ENOMEM) ? NULL : __libc_malloc(size); }
void *calloc(size_t count, size_t size) { return fails(ALLOC, ENOMEM) ? NULL : __libc_calloc(count, size); }
void *realloc(void *p, size_t size) { return fails(ALLOC, ENOMEM) ? NULL : __libc_realloc(p, size); }

FILE *fopen(const char *path, const char *mode) { return fails(OPEN, EMFILE) ? NULL : next_fopen(path, mode); }
FILE *fdopen(int fd, const char *mode) { return fails(OPEN, ENOMEM) ? NULL : next_fdopen(fd, mode); }

int open(const char *path, int flags, ...)
{
    va_list more;
    va_start(more, flags);
    const int mode = flags & O_CREAT ? va_arg(more, int) : 0;
    va_end(more);
    return fails(OPEN, EMFILE) ? -1 : next_open(path, flags, mode);
}

size_t fwrite(const void *data, size_t size, size_t count, FILE *f)
{
    if (f != stderr && fails(WRITE, ENOSPC)) {
        f->_flags |= ERROR_SEEN;
        return 0;
    }
    return next_fwrite(data, size, count, f);
}

int fflush(FILE *f)
{
    if (f != stderr && fails(WRITE, ENOSPC)) {
        return EOF;
    }
    return next_fflush(f);
}

int fclose(FILE *f)
{
    const int failed = fails(WRITE, EIO);
    return next_fclose(f) != 0 || failed ? EOF : 0;
}

int rename(const char *from, const char *to) { return fails(RENAME, EXDEV) ? -1 : next_rename(from, to); }

int pthread_create(pthread_t *thread, const pthread_attr_t *how, void *(*run)(void *), void *argument)
{
    return fails(THREAD, EAGAIN) ? EAGAIN : next_thread(thread, how, run, argument);
}
