/* io_file.c: reads and writes whole files. Files are written aside and renamed, so that no reader sees half a file. */
#if !defined(_WIN32) && !defined(_XOPEN_SOURCE)
#define _XOPEN_SOURCE 700 /* lstat, realpath, fdopen, fchmod */
#endif
#include "io_file.h"

#include <ctype.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "../../platform/host/host.h"
#include "../../platform/host/limit.h"
#include "ending.h"

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

static int is_keeping, is_only_here;

void file_keep_all(void)
{
    is_keeping = 1;
}

int file_is_stdout(const char *path)
{
    if (strcmp(path, "-") == 0 || strcmp(path, "/dev/stdout") == 0) return 1;
    return isalpha((unsigned char)path[0]) && isalpha((unsigned char)path[1]) && isalpha((unsigned char)path[2]) &&
           strcmp(path + 3, ":-") == 0;
}

int file_suits(const char *option, const char *path, const char *own, report *r)
{
    static const char *const known[] = {".png", ".ppm", ".pfm", ".hdr", ".jpg", ".jpeg", ".gltf",
                                        ".glb", ".obj", ".mtl", ".ply", ".lmp", ".lmr", ".lmt", ".json",
                                        ".csv", ".html", ".svg"};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; ++i) {
        if (has_ending(path, known[i]) && strcmp(own, known[i]) != 0) {
            return report_fail_usage(r, "%s %s: a %s file would be written, under the name of a %s file; name it *%s",
                                     option, path, own, known[i], own);
        }
    }
    return 1;
}

/* --- inputs, which outputs may not replace ------------- */

#ifdef _WIN32

void file_keep_end(void)
{
    is_keeping = is_only_here = 0;
}

/* Files have no number on this system. */
int file_keep(const char *path, report *r)
{
    (void)path;
    (void)r;
    return 1;
}

#else

typedef struct file_number {
    dev_t device;
    ino_t inode;
    int is_used;
} file_number;

/* A hash table of file numbers with linear probing, because a list of frames may name thousands. */
static struct kept_files {
    file_number *file;
    size_t count, cap; /* a power of two, at least twice the count; 0: none */
} kept;

void file_keep_end(void)
{
    free(kept.file);
    memset(&kept, 0, sizeof kept);
    is_keeping = is_only_here = 0;
}

/* Slot of a file, or the free slot for it. There is always room. */
static file_number *kept_place(dev_t device, ino_t inode)
{
    size_t at = ((size_t)inode * 31 + (size_t)device) * (size_t)2654435761u >> 7;
    file_number *f = &kept.file[at & (kept.cap - 1)];
    while (f->is_used && (f->device != device || f->inode != inode)) f = &kept.file[++at & (kept.cap - 1)];
    return f;
}

static int is_kept(const struct stat *s) { return kept.cap > 0 && kept_place(s->st_dev, s->st_ino)->is_used; }

static int kept_grows(void)
{
    const struct kept_files was = kept;
    size_t i;
    kept.cap = was.cap > 0 ? 2 * was.cap : 32;
    kept.file = calloc(kept.cap, sizeof *kept.file);
    if (!kept.file) {
        kept = was;
        return 0;
    }
    for (i = 0; i < was.cap; ++i)
        if (was.file[i].is_used) *kept_place(was.file[i].device, was.file[i].inode) = was.file[i];
    free(was.file);
    return 1;
}

int file_keep(const char *path, report *r)
{
    struct stat s;
    file_number *f;
    if (stat(path, &s) != 0 || !S_ISREG(s.st_mode) || is_kept(&s)) return 1;
    if (2 * kept.count >= kept.cap && !kept_grows()) return report_fail(r, "%s: out of memory", path);
    f = kept_place(s.st_dev, s.st_ino);
    f->device = s.st_dev;
    f->inode = s.st_ino;
    f->is_used = 1;
    ++kept.count;
    return 1;
}

#endif

/* --- references to other files --- */

void file_only_here(void) { is_only_here = 1; }

static int is_separator(char c)
{
#ifdef _WIN32
    return c == '/' || c == '\\';
#else
    return c == '/';
#endif
}

/* Returns 1 if the text of a relative path stays below its folder. Links are not followed. The last name is a file. */
static int stays_below(const char *path)
{
    int depth = 0;
    if (is_separator(path[0])) return 0;
#ifdef _WIN32
    if (strchr(path, ':')) return 0;
#endif
    while (*path) {
        size_t n = 0;
        while (path[n] && !is_separator(path[n])) ++n;
        if (n == 2 && path[0] == '.' && path[1] == '.') {
            if (depth-- == 0) return 0;
        } else if (n > 0 && !(n == 1 && path[0] == '.')) {
            ++depth;
        }
        path += n + (path[n] != '\0');
    }
    return depth > 0;
}

#ifdef _WIN32
static const char *name_in(const char *path)
{
    const char *name = path, *c;
    for (c = path; *c; ++c) {
        if (*c == '/' || *c == '\\' || *c == ':') name = c + 1;
    }
    return name;
}

/* Resolves all links of a path. Returns NULL if the path does not exist. The caller frees the result. */
static char *real_path(const char *path)
{
    const HANDLE f = CreateFileA(path, 0, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, NULL, OPEN_EXISTING,
                                 FILE_FLAG_BACKUP_SEMANTICS, NULL);
    const DWORD size = f != INVALID_HANDLE_VALUE ? GetFinalPathNameByHandleA(f, NULL, 0, 0) : 0;
    char *out = size > 0 ? malloc((size_t)size + 1) : NULL;
    if (out && GetFinalPathNameByHandleA(f, out, size + 1, 0) == 0) {
        free(out);
        out = NULL;
    }
    if (f != INVALID_HANDLE_VALUE) CloseHandle(f);
    return out;
}
#else
static const char *name_in(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

static char *real_path(const char *path) { return realpath(path, NULL); }
#endif

/* Is the file in or below the folder, after all links of both? */
static int is_really_below(const char *path, const char *folder, size_t folder_size)
{
    char *own = malloc(folder_size + 2), *real = NULL, *real_folder = NULL;
    size_t n;
    int ok = 0;
    if (own) {
        memcpy(own, folder, folder_size);
        strcpy(own + folder_size, ".");
        real = real_path(path);
        real_folder = real_path(own);
    }
    if (real && real_folder) {
        n = strlen(real_folder);
        ok = strncmp(real, real_folder, n) == 0 && (is_separator(real[n]) || (n > 0 && is_separator(real[n - 1])));
    }
    free(own);
    free(real);
    free(real_folder);
    return ok;
}

int file_is_below(const char *path, const char *folder, size_t folder_size, report *r)
{
    return !is_only_here ||
           (strncmp(path, folder, folder_size) == 0 && stays_below(path + folder_size) &&
            is_really_below(path, folder, folder_size)) ||
           report_fail(r, "%s: no file in or below its folder (--only-here)", path);
}

/* Names of the program's open files; the system makes them links. */
static int is_open_file(const char *path)
{
    static const char *const folders[] = {"/dev/fd/", "/proc/self/fd/"};
    for (size_t i = 0; i < sizeof folders / sizeof *folders; ++i) {
        const size_t n = strlen(folders[i]),
                     digits = strncmp(path, folders[i], n) != 0 ? 0 : strspn(path + n, "0123456789");
        if (digits > 0 && path[n + digits] == '\0') {
            return 1;
        }
    }
    return strcmp(path, "/dev/stdin") == 0;
}

/* Is it a link out of its folder? */
static int leads_out(const char *path)
{
    return is_only_here && !is_open_file(path) && !is_really_below(path, path, (size_t)(name_in(path) - path));
}

/* --- reading --- */

/* Running out of memory or open files would happen with another file too; all other errors concern this file. */
static int cannot_read(report *r, const char *path, const char *what)
{
    const int error = errno, is_systems = error == ENOMEM || error == EMFILE || error == ENFILE;
    const char *why = reason();
    return (is_systems ? report_fail_system : report_fail)(r, "%s: cannot be %s: %s", path, what, why);
}

void file_free(file_bytes *file)
{
    if (!file) return;
    free(file->data);
    file->data = NULL;
    file->size = 0;
}

/* Doubles the capacity, up to FILE_MAX and one byte, which detects a file that is too long. */
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
        if (ferror(f)) return cannot_read(r, path, "read");
        if (out->size < cap) return 1; /* fread returns less only at the end or on an error */
    }
}

/* Standard input can be read only once. */
static FILE *open_input(const char *path, report *r)
{
    static int is_taken;
    FILE *f;
    if (strcmp(path, "-") != 0) {
        errno = 0;
        f = fopen(path, "rb");
        if (!f) cannot_read(r, path, "opened");
        return f;
    }
    if (is_taken) report_fail_usage(r, "-: standard input has been read; give one of both as a file");
#ifdef _WIN32
    _setmode(_fileno(stdin), _O_BINARY);
#endif
    f = is_taken ? NULL : stdin;
    is_taken = 1;
    return f;
}

int file_read(file_bytes *out, const char *path, report *r)
{
    FILE *f;
    uint8_t *data;
    int done;

    out->data = NULL;
    out->size = 0;
    f = open_input(path, r);
    if (!f) return 0;
    done = f == stdin || !leads_out(path) ||
           report_fail(r, "%s: a link that leads out of its folder (--only-here)", path);
    done = done && (f == stdin || !is_keeping || file_keep(path, r)) && read_all(out, f, path, r);
    if (f != stdin) fclose(f);
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
    if (stat(path, &s) != 0) return r != NULL && cannot_read(r, path, "opened");
    return IS_KIND(s, REG) || (r != NULL && report_fail(r, "%s: not a file", path));
}

int file_is_folder(const char *path)
{
    struct stat s;
    return stat(path, &s) == 0 && IS_KIND(s, DIR);
}

/* --- writing --- */

/* Writes, flushes and closes. Each step may be the one that reports a full disk. */
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

static void remove_now(const char *path)
{
    remove(path);
}

#else

/* Uses the permissions of the file that it replaces; mode < 0: no such file, so the default permissions. */
static int create_exclusive(const char *path, int mode)
{
    int fd = open(path, O_WRONLY | O_CREAT | O_EXCL, mode < 0 ? (mode_t)0666 : (mode_t)mode);
    if (fd >= 0 && mode >= 0) fchmod(fd, (mode_t)mode); /* open applied the umask */
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

/* Safe in a signal handler. */
static void remove_now(const char *path)
{
    unlink(path);
}

#endif

/* The current temporary file; a signal that ends the program removes it. */
static char *volatile aside;

void file_drop_aside(void)
{
    char *path = aside;
    if (path) remove_now(path);
}

static void drop(char *temporary)
{
    int error = errno;
    remove_now(temporary);
    aside = NULL;
    errno = error;
}

/* Blocks signals between creating the file and storing the name. A name that exists belongs to another program. */
static int create_aside(char *temporary, int mode)
{
    int fd, error;
    host_hold_signals(1);
    errno = 0;
    fd = create_exclusive(temporary, mode);
    error = errno;
    if (fd >= 0) aside = temporary;
    host_hold_signals(0);
    errno = error;
    return fd;
}

/* Names of written files, for file_drop_written. Guarded by limit_hold. */
static struct written_files {
    char **name;
    size_t count, cap;
    int is_on;
} written;

void file_keep_names(void) { written.is_on = 1; }

void file_drop_written(void)
{
    size_t i;
    for (i = 0; i < written.count; ++i) remove_now(written.name[i]);
}

/* Makes room for one more name, before the file exists. */
static int written_grows(const char *path, report *r)
{
    char **more;
    if (!written.is_on || written.count < written.cap) return 1;
    more = realloc(written.name, (2 * written.cap + 16) * sizeof *more);
    if (!more) return report_fail(r, "%s: out of memory", path);
    written.name = more;
    written.cap = 2 * written.cap + 16;
    return 1;
}

static char *copy_of(const char *path)
{
    char *copy = malloc(strlen(path) + 1);
    if (copy) strcpy(copy, path);
    return copy;
}

/* Creates a file in the directory of `path` with an unused name; `temporary` holds strlen(path) + SUFFIX_MAX. */
static FILE *open_beside(char *temporary, const char *path, int mode)
{
    size_t directory = (size_t)(name_in(path) - path);
    int i, fd = -1;
    FILE *f;
    memcpy(temporary, path, directory);
    for (i = 0; i < NAME_TRIES && fd < 0; ++i) {
        snprintf(temporary + directory, SUFFIX_MAX, ".write-%u-%d.tmp", process_number(), i);
        fd = create_aside(temporary, mode);
        if (fd < 0 && errno != EEXIST) return NULL;
    }
    if (fd < 0) return NULL;
    f = open_stream(fd);
    if (!f) drop(temporary);
    return f;
}

static int write_aside(const char *path, int mode, const void *data, size_t size, report *r)
{
    char *temporary = malloc(strlen(path) + SUFFIX_MAX), *name = written.is_on ? copy_of(path) : NULL;
    FILE *f;
    int done;

    if (!temporary || (written.is_on && !name) || !written_grows(path, r)) {
        free(temporary);
        free(name);
        return report_fail(r, "%s: out of memory", path);
    }
    f = open_beside(temporary, path, mode);
    if (!f) {
        report_fail(r, "%s: cannot be written: no file can be made in its folder: %s", path, reason());
        free(temporary);
        free(name);
        return 0;
    }
    done = write_and_close(f, data, size) && replace(temporary, path);
    if (!done) {
        report_fail(r, "%s: cannot be written: %s", path, reason());
        drop(temporary);
    }
    aside = NULL;
    if (done && name) {
        written.name[written.count++] = name;
        name = NULL;
    }
    free(temporary);
    free(name);
    return done;
}

/* --- where it goes --- */

/* If `over` is not NULL, a file beside it is written and replaces it. Otherwise writes directly to the name. */
typedef struct place {
    char *over;
    int mode; /* permissions of the existing file; -1: none */
} place;

static int cannot(report *r, const char *path, const char *why)
{
    return report_fail(r, "%s: cannot be written: %s", path, why);
}

static int take_place(place *out, const char *path, report *r)
{
    const size_t bytes = strlen(path) + 1;
    out->over = malloc(bytes);
    if (!out->over) return report_fail(r, "%s: out of memory", path);
    memcpy(out->over, path, bytes);
    return 1;
}

#ifdef _WIN32

static int find_place(place *out, const char *path, report *r)
{
    struct _stat s;
    out->over = NULL;
    out->mode = -1;
    if (_stat(path, &s) == 0 && (s.st_mode & _S_IFDIR)) return cannot(r, path, "it is a folder");
    if (_stat(path, &s) == 0 && !(s.st_mode & _S_IFREG)) return 1;
    return take_place(out, path, r);
}

#else

/* Keeps a link and replaces the target, unless the link stands for an open file (/dev/fd/3). */
static int follow(place *out, const char *path, report *r)
{
    out->over = realpath(path, NULL);
    return out->over || report_fail(r, "%s: cannot be written: the link's target: %s", path, reason());
}

/* An existing file is replaced only if it is writable. */
static int find_place(place *out, const char *path, report *r)
{
    struct stat s;
    int is_link;
    out->over = NULL;
    out->mode = -1;
    errno = 0;
    if (lstat(path, &s) != 0) return errno == ENOENT ? take_place(out, path, r) : cannot(r, path, reason());
    is_link = S_ISLNK(s.st_mode);
    if (is_link && stat(path, &s) != 0)
        return report_fail(r, "%s: cannot be written: the link's target: %s", path, reason());
    if (S_ISDIR(s.st_mode)) return cannot(r, path, "it is a folder");
    if (access(path, W_OK) != 0) return cannot(r, path, reason());
    if (!S_ISREG(s.st_mode) || (is_link && (strncmp(path, "/dev/", 5) == 0 || strncmp(path, "/proc/", 6) == 0)))
        return 1;
    if (is_kept(&s))
        return report_fail_usage(r, "%s: cannot be written: it is read by the same command; give another name", path);
    out->mode = (int)(s.st_mode & 0777);
    return is_link ? follow(out, path, r) : take_place(out, path, r);
}

#endif

/* Pipes, devices and terminals cannot be replaced by a rename. */
static int write_direct(const char *path, const void *data, size_t size, report *r)
{
    FILE *f;
    errno = 0;
    f = fopen(path, "wb");
    if (!f || !write_and_close(f, data, size)) return cannot(r, path, reason());
    return 1;
}

/* Handles the names of standard streams; output that was printed earlier comes first. */
static int write_stream(FILE *f, const char *path, const void *data, size_t size, report *r)
{
    errno = 0;
#ifdef _WIN32
    _setmode(_fileno(f), _O_BINARY);
#endif
    if ((size > 0 && fwrite(data, 1, size, f) != size) || fflush(f) != 0) return cannot(r, path, reason());
    return 1;
}

int file_write(const char *path, const void *data, size_t size, report *r)
{
    place to;
    int done;
    if (file_is_stdout(path)) return write_stream(stdout, path, data, size, r);
    if (strcmp(path, "/dev/stderr") == 0) return write_stream(stderr, path, data, size, r);
    if (!find_place(&to, path, r)) return 0;
    if (to.over) {
        limit_hold(1);
        done = write_aside(to.over, to.mode, data, size, r);
        limit_hold(0);
    } else {
        done = write_direct(path, data, size, r);
    }
    free(to.over);
    return done;
}

int file_may_replace(const char *path, report *r)
{
    place to;
    if (!find_place(&to, path, r)) return 0;
    free(to.over);
    return 1;
}

#ifdef _WIN32
static int is_one_place(const char *a, const char *b) { return strcmp(a, b) == 0; }
#else
/* Start of the last name in a path. */
static const char *last_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

static int stat_folder(struct stat *out, const char *path)
{
    const size_t bytes = (size_t)(last_name(path) - path);
    char *folder = malloc(bytes + 2);
    int found;
    if (!folder) return 0;
    memcpy(folder, path, bytes);
    strcpy(folder + bytes, ".");
    found = stat(folder, out) == 0;
    free(folder);
    return found;
}

static int is_one_place(const char *a, const char *b)
{
    struct stat to_a, to_b;
    return strcmp(last_name(a), last_name(b)) == 0 && stat_folder(&to_a, a) && stat_folder(&to_b, b) &&
           to_a.st_dev == to_b.st_dev && to_a.st_ino == to_b.st_ino;
}
#endif

int file_is_same_place(const char *a, const char *b)
{
    place to_a, to_b;
    report unread = {""};
    int same = 0;
    if (strcmp(a, b) == 0 || (file_is_stdout(a) && file_is_stdout(b))) return 1;
    if (file_is_stdout(a) || file_is_stdout(b) || !find_place(&to_a, a, &unread)) return 0;
    if (find_place(&to_b, b, &unread)) {
        same = to_a.over && to_b.over && is_one_place(to_a.over, to_b.over);
        free(to_b.over);
    }
    free(to_a.over);
    return same;
}

int file_can_write(const char *path, report *r)
{
    place to;
    char *temporary;
    FILE *f = NULL;
    if (file_is_stdout(path) || strcmp(path, "/dev/stderr") == 0) return 1;
    if (!find_place(&to, path, r)) return 0;
    if (!to.over) return 1; /* a device or a pipe: only writing can show errors */
    temporary = malloc(strlen(to.over) + SUFFIX_MAX);
    limit_hold(1);
    if (!temporary) {
        report_fail(r, "%s: out of memory", path);
    } else if (!(f = open_beside(temporary, to.over, -1))) {
        report_fail(r, "%s: cannot be written: no file can be made in its folder: %s", path, reason());
    } else {
        fclose(f);
        drop(temporary);
    }
    limit_hold(0);
    free(temporary);
    free(to.over);
    return f != NULL;
}
