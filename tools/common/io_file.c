/* io_file.c: whole files in and out; a file is written aside and renamed, so that no reader ever sees half of one. */
#if !defined(_WIN32) && !defined(_XOPEN_SOURCE)
#define _XOPEN_SOURCE 700 /* lstat, realpath, fdopen, fchmod */
#endif
#include "io_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#ifdef _WIN32
#include <io.h>
#include <process.h>
#include <windows.h>
#else
#include <unistd.h>
#endif

#ifdef _WIN32
#define IS_KIND(s, kind) (((s).st_mode & _S_IFMT) == _S_IF##kind)
#else
#define IS_KIND(s, kind) (((s).st_mode & S_IFMT) == S_IF##kind)
#endif

#define FILE_MAX (UINT64_C(1) << 32)

enum { FIRST_READ = 1 << 16, NAME_TRIES = 1000, SUFFIX_MAX = 40 };

static const char *reason(void)
{
    return errno ? strerror(errno) : "the system does not say why";
}

/* --- reading --- */

void file_free(file_bytes *file)
{
    if (!file) return;
    free(file->data);
    file->data = NULL;
    file->size = 0;
}

/* Room for more, doubled up to FILE_MAX and one byte, which tells a file that is too long. */
static int grow(file_bytes *file, size_t *cap, const char *path, report *r)
{
    uint64_t want = *cap ? 2 * (uint64_t)*cap : FIRST_READ;
    uint8_t *data;
    if (file->size > FILE_MAX) return report_fail(r, "%s: over 4 GiB; too large to read", path);
    if (want > FILE_MAX) want = FILE_MAX + 1;
    data = want <= SIZE_MAX ? realloc(file->data, (size_t)want) : NULL;
    if (!data) return report_fail(r, "%s: out of memory after %zu bytes", path, file->size);
    file->data = data;
    *cap = (size_t)want;
    return 1;
}

static int read_all(file_bytes *out, FILE *f, const char *path, report *r)
{
    size_t cap = 0;
    for (;;) {
        if (out->size == cap && !grow(out, &cap, path, r)) return 0;
        errno = 0;
        out->size += fread(out->data + out->size, 1, cap - out->size, f);
        if (ferror(f)) return report_fail(r, "%s: cannot be read: %s", path, reason());
        if (out->size < cap) return 1; /* fread stops short only at the end or at an error */
    }
}

int file_read(file_bytes *out, const char *path, report *r)
{
    FILE *f;
    uint8_t *data;
    int done;

    out->data = NULL;
    out->size = 0;
    errno = 0;
    f = fopen(path, "rb");
    if (!f) return report_fail(r, "%s: cannot be opened: %s", path, reason());
    done = read_all(out, f, path, r);
    fclose(f);
    if (!done) {
        file_free(out);
        return 0;
    }
    data = realloc(out->data, out->size ? out->size : 1);
    if (data) out->data = data;
    return 1;
}

int file_is_plain(const char *path, report *r)
{
    struct stat s;
    errno = 0;
    if (stat(path, &s) != 0) return report_fail(r, "%s: cannot be opened: %s", path, reason());
    return IS_KIND(s, REG) || report_fail(r, "%s: not a file", path);
}

/* --- writing --- */

/* Write, flush and close; every step may be the one at which a full disk shows. */
static int write_and_close(FILE *f, const void *data, size_t size)
{
    int whole, closed, error;
    errno = 0;
    whole = (size == 0 || fwrite(data, 1, size, f) == size) && fflush(f) == 0;
    error = errno;
    closed = fclose(f) == 0;
    if (!whole) errno = error;
    return whole && closed;
}

/* Pipes, devices, terminals: nothing can be renamed over them. */
static int write_direct(const char *path, const void *data, size_t size, report *r)
{
    FILE *f;
    errno = 0;
    f = fopen(path, "wb");
    if (!f || !write_and_close(f, data, size)) return report_fail(r, "%s: cannot be written: %s", path, reason());
    return 1;
}

#ifdef _WIN32

static int create_exclusive(const char *path, int mode)
{
    (void)mode;
    return _open(path, _O_WRONLY | _O_CREAT | _O_EXCL | _O_BINARY, _S_IREAD | _S_IWRITE);
}

static FILE *open_stream(int fd)
{
    FILE *f = _fdopen(fd, "wb");
    if (!f) _close(fd);
    return f;
}

static unsigned process_number(void)
{
    return (unsigned)_getpid();
}

static int replace(const char *from, const char *to)
{
    errno = 0;
    return MoveFileExA(from, to, MOVEFILE_REPLACE_EXISTING) != 0;
}

static const char *name_in(const char *path)
{
    const char *name = path, *c;
    for (c = path; *c; ++c) {
        if (*c == '/' || *c == '\\' || *c == ':') name = c + 1;
    }
    return name;
}

#else

/* With the permissions of the file it will replace; mode < 0: there is none, so the user's usual ones. */
static int create_exclusive(const char *path, int mode)
{
    int fd = open(path, O_WRONLY | O_CREAT | O_EXCL, mode < 0 ? (mode_t)0666 : (mode_t)mode);
    if (fd >= 0 && mode >= 0) fchmod(fd, (mode_t)mode); /* open left out what umask forbids */
    return fd;
}

static FILE *open_stream(int fd)
{
    FILE *f = fdopen(fd, "wb");
    if (!f) close(fd);
    return f;
}

static unsigned process_number(void)
{
    return (unsigned)getpid();
}

static int replace(const char *from, const char *to)
{
    return rename(from, to) == 0;
}

static const char *name_in(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

#endif

/* A new file in the directory of `path`, under a name that nobody has; `temporary` holds strlen(path) + SUFFIX_MAX. */
static FILE *open_beside(char *temporary, const char *path, int mode)
{
    size_t directory = (size_t)(name_in(path) - path);
    int i, fd = -1;
    memcpy(temporary, path, directory);
    for (i = 0; i < NAME_TRIES && fd < 0; ++i) {
        snprintf(temporary + directory, SUFFIX_MAX, ".write-%u-%d.tmp", process_number(), i);
        errno = 0;
        fd = create_exclusive(temporary, mode);
        if (fd < 0 && errno != EEXIST) return NULL;
    }
    return fd < 0 ? NULL : open_stream(fd);
}

static int write_aside(const char *path, int mode, const void *data, size_t size, report *r)
{
    char *temporary = malloc(strlen(path) + SUFFIX_MAX);
    FILE *f;
    int done;

    if (!temporary) return report_fail(r, "%s: out of memory", path);
    f = open_beside(temporary, path, mode);
    if (!f) {
        report_fail(r, "%s: cannot be written: no file can be made in its directory: %s", path, reason());
        free(temporary);
        return 0;
    }
    done = write_and_close(f, data, size) && replace(temporary, path);
    if (!done) {
        report_fail(r, "%s: cannot be written: %s", path, reason());
        remove(temporary);
    }
    free(temporary);
    return done;
}

#ifdef _WIN32

int file_write(const char *path, const void *data, size_t size, report *r)
{
    struct _stat s;
    if (_stat(path, &s) == 0 && !(s.st_mode & _S_IFREG)) return write_direct(path, data, size, r);
    return write_aside(path, -1, data, size, r);
}

#else

/* The standard streams have names too; what a program printed before stays before. */
static int write_stream(FILE *f, const char *path, const void *data, size_t size, report *r)
{
    errno = 0;
    if ((size > 0 && fwrite(data, 1, size, f) != size) || fflush(f) != 0)
        return report_fail(r, "%s: cannot be written: %s", path, reason());
    return 1;
}

/* A regular file's replacement; one that may not be written may not be replaced either. */
static int write_over(const char *path, const struct stat *s, const void *data, size_t size, report *r)
{
    errno = 0;
    if (access(path, W_OK) != 0) return report_fail(r, "%s: cannot be written: %s", path, reason());
    return write_aside(path, (int)(s->st_mode & 0777), data, size, r);
}

/* A link stays, and what it points to is replaced; except where it stands for an open file (/dev/fd/3). */
static int write_linked(const char *path, const void *data, size_t size, report *r)
{
    char *target;
    struct stat s;
    int done;

    errno = 0;
    if (stat(path, &s) != 0) return report_fail(r, "%s: cannot be written: the link's target: %s", path, reason());
    if (!S_ISREG(s.st_mode) || strncmp(path, "/dev/", 5) == 0 || strncmp(path, "/proc/", 6) == 0)
        return write_direct(path, data, size, r);
    target = realpath(path, NULL);
    if (!target) return report_fail(r, "%s: cannot be written: the link's target: %s", path, reason());
    done = write_over(target, &s, data, size, r);
    free(target);
    return done;
}

int file_write(const char *path, const void *data, size_t size, report *r)
{
    struct stat s;
    if (strcmp(path, "/dev/stdout") == 0) return write_stream(stdout, path, data, size, r);
    if (strcmp(path, "/dev/stderr") == 0) return write_stream(stderr, path, data, size, r);
    if (lstat(path, &s) != 0) return write_aside(path, -1, data, size, r);
    if (S_ISLNK(s.st_mode)) return write_linked(path, data, size, r);
    if (!S_ISREG(s.st_mode)) return write_direct(path, data, size, r);
    return write_over(path, &s, data, size, r);
}

#endif

int file_can_write(const char *path, report *r)
{
    struct stat s;
    char *temporary;
    FILE *f;
    int exists = stat(path, &s) == 0;
    if (exists && IS_KIND(s, DIR)) return report_fail(r, "%s: cannot be written: it is a folder", path);
    if (exists && !IS_KIND(s, REG)) return 1; /* a device or a pipe: only writing tells */
    temporary = malloc(strlen(path) + SUFFIX_MAX);
    if (!temporary) return report_fail(r, "%s: out of memory", path);
    f = open_beside(temporary, path, -1);
    if (!f) {
        report_fail(r, "%s: cannot be written: no file can be made in its directory: %s", path, reason());
    } else {
        fclose(f);
        remove(temporary);
    }
    free(temporary);
    return f != NULL;
}
