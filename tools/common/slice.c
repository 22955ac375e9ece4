/* slice.c: the --slice option and the slice file. */
#include "slice.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lambent/lambent.h>

#include "io_bytes.h"
#include "option_value.h"
#include "options_table.h"

/* magic, version, kind, number, count, job, sizes of the about line and of the data; at the end the hash */
enum { HEADER = 48, TAIL = 8, VERSION = 1 };
static const char magic[9] = "LMBSLICE";

/* --- the option --------------------------------------------------------------------------------------------------- */

int slice_option(const char *text, void *at)
{
    slice s;
    char *end;
    const long number = text[0] >= '0' && text[0] <= '9' ? strtol(text, &end, 10) : 0;
    if (number < 1 || number > SLICE_MOST || *end != '/' || !option_int(end + 1, 1, SLICE_MOST, &s.count) ||
        number > s.count) {
        return 0;
    }
    s.number = (int32_t)number;
    memcpy(at, &s, sizeof s);
    return 1;
}

/* --- the job ------------------------------------------------------------------------------------------------------ */

uint64_t slice_hash(uint64_t hash, const void *data, size_t size)
{
    const uint8_t *p = data;
    for (size_t i = 0; i < size; ++i) {
        hash = (hash ^ p[i]) * UINT64_C(0x100000001b3);
    }
    return hash;
}

static uint64_t hash_text(uint64_t hash, const char *text) { return slice_hash(hash, text, strlen(text) + 1); }

/* Options that change no byte of the result. For input files the contents count, not the name. */
static int is_free(const option_row *row)
{
    static const char *const names[] = {"--slice", "--time-limit", "--threads", "--backend",
                                        "--stats", "--report",     NULL};
    int i = 0;
    while (names[i] != NULL && strcmp(names[i], row->name) != 0) {
        ++i;
    }
    return names[i] != NULL || (row->file != 0 && strcmp(row->name, "-o") != 0) || row->kind == OPTION_QUIET ||
           row->kind == OPTION_VERBOSE;
}

/* For an output only the format counts, which the ending selects. */
static uint64_t hash_value(uint64_t hash, const option_row *row, const char *value)
{
    const char *ending = strcmp(row->name, "-o") == 0 ? strrchr(value, '.') : NULL;
    return hash_text(hash, ending != NULL ? ending : value);
}

/* Options may come in any order, so their hashes are added. For a repeated option the order counts. */
static uint64_t hash_words(const option_table *t, int argc, char **argv)
{
    uint64_t sum = 0;
    for (int i = 1; i < argc; ++i) {
        const option_row *row = options_find(t, argv[i]);
        if (row == NULL) {
            continue; /* a scene: the contents count */
        }
        const int words = options_words(row, argv[i]);
        const char *inside = strchr(argv[i], '=');
        const char *value = words == 2 && i + 1 < argc ? argv[i + 1] : inside != NULL ? inside + 1 : "";
        int32_t before = 0;
        for (int k = 1; k < i; ++k) {
            before += options_find(t, argv[k]) == row;
        }
        if (!is_free(row)) {
            sum += hash_value(hash_text(slice_hash(SLICE_HASH, &before, sizeof before), row->name), row, value);
        }
        i += words - 1;
    }
    return sum;
}

int slice_hash_file(uint64_t *hash, const char *path, report *r)
{
    file_bytes file = {NULL, 0};
    if (strcmp(path, "-") == 0) {
        return report_fail(r, "--slice: only one machine has standard input; give a file");
    }
    if (!file_read(&file, path, r)) {
        return 0;
    }
    *hash = slice_hash(*hash, file.data, file.size);
    file_free(&file);
    return 1;
}

int slice_job(uint64_t *out, const void *options, const option_table *t, int argc, char **argv, report *r)
{
    static const uint32_t version = LMB_VERSION;
    *out = hash_text(slice_hash(SLICE_HASH, &version, sizeof version), t->verb) + hash_words(t, argc, argv);
    const option_row *row;
    for (int i = 0; (row = options_row(t, i)) != NULL; ++i) {
        const char *path = NULL;
        if (row->file == OPTION_READS && row->kind == OPTION_TEXT) {
            memcpy(&path, (const char *)options + row->at, sizeof path);
        }
        *out = path != NULL ? hash_text(*out, row->name) : *out;
        if (path != NULL && strcmp(path, "demo") != 0 && !slice_hash_file(out, path, r)) {
            return 0;
        }
    }
    return 1;
}

/* --- the file ----------------------------------------------------------------------------------------------------- */

int slice_name(char out[SLICE_NAME], const char *path, slice s, report *r)
{
    if (file_is_stdout(path)) {
        return report_fail_usage(r, "--slice: a slice is a file beside the output; give -o a file's name");
    }
    const int n = snprintf(out, SLICE_NAME, "%s.%dof%d", path, (int)s.number, (int)s.count);
    return (n > 0 && n < SLICE_NAME) || report_fail(r, "%s: the name is too long", path);
}

int slice_write(const char *path, slice s, int32_t kind, uint64_t job, const char *about, const byte_buffer *says,
                report *r)
{
    byte_buffer b = {NULL, 0, 0, says->is_short};
    byte_put(&b, magic, 8);
    byte_put_int(&b, VERSION);
    byte_put_int(&b, kind);
    byte_put_int(&b, s.number);
    byte_put_int(&b, s.count);
    byte_put_long(&b, job);
    byte_put_long(&b, strlen(about));
    byte_put_long(&b, says->size);
    byte_put(&b, about, strlen(about));
    byte_put(&b, says->data, says->size);
    byte_put_long(&b, slice_hash(SLICE_HASH, b.data, b.size));
    const int ok =
        b.is_short ? report_fail(r, "%s: not enough memory for the slice", path) : file_write(path, b.data, b.size, r);
    free(b.data);
    return ok;
}

void slice_file_free(slice_file *f)
{
    file_free(&f->file);
    memset(f, 0, sizeof *f);
}

static int refuse(slice_file *f, const char *path, const char *what, report *r)
{
    slice_file_free(f);
    return report_fail(r, "%s: %s", path, what);
}

int slice_read(slice_file *out, const char *path, report *r)
{
    memset(out, 0, sizeof *out);
    if (!file_read(&out->file, path, r)) {
        return 0;
    }
    const size_t size = out->file.size;
    byte_reader s = {out->file.data, out->file.data + size, 0};
    if (size < 8 || memcmp(byte_get(&s, 8), magic, 8) != 0) {
        return refuse(out, path, "no slice of `lambent ... --slice`", r);
    }
    if (size < HEADER + TAIL) {
        return refuse(out, path, "cut off", r);
    }
    if (byte_get_int(&s) != VERSION) {
        return refuse(out, path, "a slice of another version of lambent", r);
    }
    out->kind = byte_get_int(&s);
    out->slice.number = byte_get_int(&s);
    out->slice.count = byte_get_int(&s);
    out->job = byte_get_long(&s);
    const uint64_t about = byte_get_long(&s), says = byte_get_long(&s), inside = size - HEADER - TAIL;
    if (about > inside || says > inside - about) {
        return refuse(out, path, "cut off", r);
    }
    byte_reader tail = {out->file.data + size - TAIL, out->file.data + size, 0};
    out->hash = byte_get_long(&tail);
    if (about + says != inside || about >= SLICE_ABOUT ||
        out->hash != slice_hash(SLICE_HASH, out->file.data, size - TAIL)) {
        return refuse(out, path, "damaged", r);
    }
    memcpy(out->about, byte_get(&s, (size_t)about), (size_t)about);
    out->says.at = s.at;
    out->says.end = s.at + says;
    return (out->slice.count >= 1 && out->slice.count <= SLICE_MOST && out->slice.number >= 1 &&
            out->slice.number <= out->slice.count) ||
           refuse(out, path, "damaged", r);
}

/* --- all of them -------------------------------------------------------------------------------------------------- */

/* Stores a file in the set if it belongs to the job of the first valid one. */
static int take(slice_set *set, const slice_file *f, const char *path, int is_quiet, report *r)
{
    if (set->count == 0) {
        set->count = f->slice.count;
        set->kind = f->kind;
        set->job = f->job;
        memcpy(set->about, f->about, sizeof set->about);
        set->first = path;
    }
    if (f->kind != set->kind || f->job != set->job || f->slice.count != set->count) {
        return report_fail(r,
                           "%s: slice %d of %d of another job (%s) than %s (%s): inputs, options and version must be "
                           "the same; leave one of them out",
                           path, (int)f->slice.number, (int)f->slice.count, f->about, set->first, set->about);
    }
    const int32_t i = f->slice.number - 1;
    if (set->hash[i] != 0 && set->hash[i] != f->hash && f->kind == SLICE_BENCH) { /* times differ */
        report_note(is_quiet, "%s: slice %d of %d once more; %s counts", path, (int)f->slice.number, (int)set->count,
                    set->path[i]);
        return 1;
    }
    if (set->hash[i] != 0 && set->hash[i] != f->hash) {
        return report_fail(r,
                           "%s and %s: both slice %d of %d, and they differ: one of the machines is at fault; make "
                           "that slice again",
                           set->path[i], path, (int)f->slice.number, (int)set->count);
    }
    report_note(is_quiet || set->hash[i] == 0, "%s: slice %d of %d once more, the same as %s", path,
                (int)f->slice.number, (int)set->count, set->path[i]);
    set->path[i] = path;
    set->hash[i] = f->hash;
    return 1;
}

/* Returns whether all are there; otherwise `r` lists the missing ones. */
static int is_complete(const slice_set *set, report *r)
{
    char list[200] = "";
    size_t n = 0;
    int32_t missing = 0;
    for (int32_t i = 0; i < set->count; ++i) {
        if (set->hash[i] == 0 && n < sizeof list - 24) {
            n += (size_t)snprintf(list + n, sizeof list - n, "%s%d", missing > 0 ? ", " : "", (int)i + 1);
        } else if (set->hash[i] == 0 && list[n - 1] != '.') {
            n += (size_t)snprintf(list + n, sizeof list - n, ", ...");
        }
        missing += set->hash[i] == 0;
    }
    return missing == 0 || report_fail(r, "%s: of %d slices %d %s missing: %s; make %s again by --slice I/%d",
                                       set->about, (int)set->count, (int)missing, missing == 1 ? "is" : "are", list,
                                       missing == 1 ? "it" : "them", (int)set->count);
}

int slice_gather(slice_set *out, const char *const *paths, int32_t count, int is_quiet, report *r)
{
    memset(out, 0, sizeof *out);
    for (int32_t i = 0; i < count; ++i) {
        slice_file f;
        report own = {""};
        if (!slice_read(&f, paths[i], &own)) {
            if (report_is_system(&own)) {
                return report_fail(r, "%s", own.text);
            }
            report_note(is_quiet, "%s; it is left out", own.text);
            continue;
        }
        const int ok = take(out, &f, paths[i], is_quiet, r);
        slice_file_free(&f);
        if (!ok) {
            return 0;
        }
    }
    return out->count > 0 ? is_complete(out, r) : report_fail(r, "no whole slice is among the files");
}
