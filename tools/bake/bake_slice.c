/* bake_slice.c: baked files -> the file of a slice -> the same files, if all slices agree. */
#include "bake_slice.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/host.h"

static const char *last_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash != NULL ? slash + 1 : path;
}

static const char *ending_of(const char *path)
{
    const char *dot = strrchr(last_name(path), '.');
    return dot != NULL ? dot : "";
}

int bake_slice_folder(char out[SLICE_NAME], const char *path, report *r)
{
    const int n = snprintf(out, SLICE_NAME, "%s.shared/", path);
    if (n < 0 || n >= SLICE_NAME) {
        return report_fail(r, "%s: the name is too long", path);
    }
    host_make_folders(out);
    char name[SLICE_NAME + 8];
    snprintf(name, sizeof name, "%stry", out);
    return file_can_write(name, r);
}

int bake_slice_numbers(char out[SLICE_NAME], const char *path, report *r)
{
    const int bare = (int)(strlen(path) - strlen(ending_of(path)));
    const int n = snprintf(out, SLICE_NAME, "%.*s.bin", bare, path);
    return (n > 0 && n < SLICE_NAME) || report_fail(r, "%s: the name is too long", path);
}

/* Start of part i of `count` parts of `size` bytes. */
static size_t begin_of(size_t size, int32_t i, int32_t count)
{
    return (size_t)((uint64_t)size * (uint64_t)i / (uint64_t)count);
}

int bake_slice_write(const char *path, const bake_share *s, const char *about, const file_bytes *file, int32_t files,
                     report *r)
{
    char name[SLICE_NAME];
    byte_buffer says = {NULL, 0, 0, 0};
    byte_put_int(&says, (int32_t)strlen(last_name(path)));
    byte_put(&says, last_name(path), strlen(last_name(path)));
    byte_put_int(&says, files);
    for (int32_t i = 0; i < files; ++i) {
        const size_t from = begin_of(file[i].size, s->slice.number - 1, s->slice.count);
        byte_put_long(&says, file[i].size);
        byte_put_long(&says, slice_hash(SLICE_HASH, file[i].data, file[i].size));
        byte_put(&says, file[i].data + from, begin_of(file[i].size, s->slice.number, s->slice.count) - from);
    }
    const int ok =
        slice_name(name, path, s->slice, r) && slice_write(name, s->slice, SLICE_BAKE, s->job, about, &says, r);
    free(says.data);
    return ok;
}

/* --- back --------------------------------------------------------------------------------------------------------- */

typedef struct joined {
    char name[SLICE_NAME]; /* name of the first slice's output */
    int32_t files;
    file_bytes file[BAKE_FILES];
    uint64_t hash[BAKE_FILES];
} joined;

/* Reads the header of a slice file; the first slice's is authoritative. */
static int get_head(joined *j, byte_reader *s, int is_first)
{
    const int32_t bytes = byte_get_int(s);
    const uint8_t *name = bytes >= 0 && bytes < SLICE_NAME ? byte_get(s, (size_t)bytes) : NULL;
    const int32_t files = byte_get_int(s);
    if (name == NULL || files < 1 || files > BAKE_FILES || (!is_first && files != j->files)) {
        return 0;
    }
    if (is_first) {
        memcpy(j->name, name, (size_t)bytes);
        j->name[bytes] = '\0';
        j->files = files;
    }
    return 1;
}

/* Reads the part of a file from slice i. */
static int get_part(joined *j, int32_t k, byte_reader *s, slice of, const char *path, report *r)
{
    file_bytes *file = &j->file[k];
    const uint64_t size = byte_get_long(s), hash = byte_get_long(s);
    if (of.number == 1 && size > 0 && size < UINT32_MAX) {
        file->data = malloc((size_t)size);
        file->size = (size_t)size;
        j->hash[k] = hash;
    }
    if (s->is_short || file->data == NULL) {
        return report_fail(r, "%s: damaged, or there is not enough memory", path);
    }
    if (size != file->size || hash != j->hash[k]) {
        return report_fail(r,
                           "%s: its bake is another one than that of slice 1, though the job is the same: one of the "
                           "machines is at fault; make both again",
                           path);
    }
    const size_t from = begin_of(file->size, of.number - 1, of.count);
    const size_t own = begin_of(file->size, of.number, of.count) - from;
    const uint8_t *data = byte_get(s, own);
    if (data == NULL) {
        return report_fail(r, "%s: damaged", path);
    }
    memcpy(file->data + from, data, own);
    return 1;
}

static int get_all(joined *j, const slice_set *set, report *r)
{
    int ok = 1;
    for (int32_t i = 0; ok && i < set->count; ++i) {
        slice_file f;
        ok = slice_read(&f, set->path[i], r) &&
             (get_head(j, &f.says, i == 0) || report_fail(r, "%s: damaged", set->path[i]));
        for (int32_t k = 0; ok && k < j->files; ++k) {
            ok = get_part(j, k, &f.says, f.slice, set->path[i], r);
        }
        slice_file_free(&f);
    }
    for (int32_t k = 0; ok && k < j->files; ++k) {
        ok = slice_hash(SLICE_HASH, j->file[k].data, j->file[k].size) == j->hash[k] ||
             report_fail(r, "%s: the slices do not make the file that they are of", set->about);
    }
    return ok;
}

/* A .json contains the name of the file of numbers. */
static int suits(const joined *j, const char *path, report *r)
{
    if (strcmp(ending_of(path), ending_of(j->name)) != 0) {
        return report_fail(r, "-o %s: the slices were made for a *%s", path, ending_of(j->name));
    }
    return j->files == 1 || strcmp(last_name(path), j->name) == 0 ||
           report_fail(r, "-o %s: the slices were made for %s, and name a file beside it", path, j->name);
}

int bake_slice_merge(const char *path, const slice_set *set, report *r)
{
    static joined j; /* large */
    char numbers[SLICE_NAME];
    memset(&j, 0, sizeof j);
    int ok = get_all(&j, set, r) && suits(&j, path, r);
    if (ok && j.files > 1) {
        ok = bake_slice_numbers(numbers, path, r) && file_may_replace(numbers, r) &&
             file_write(numbers, j.file[1].data, j.file[1].size, r);
    }
    ok = ok && file_write(path, j.file[0].data, j.file[0].size, r);
    for (int32_t k = 0; k < BAKE_FILES; ++k) {
        file_free(&j.file[k]);
    }
    return ok;
}
