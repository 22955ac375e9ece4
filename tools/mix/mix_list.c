/* mix_list.c: the photos, depths and poses of a sequence. */
#include "mix_frames.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../common/io_text.h"

#define SAME_TIME 0.02 /* s: maximum time between a photo, a depth picture and a pose */

/* A line of one of TUM's lists. */
typedef struct stamped {
    double time, value[7];
    slice name; /* points into the bytes of the file */
} stamped;

typedef struct stamped_list {
    stamped *line;             /* in the file's order */
    const stamped **by_time;   /* sorted by time, then by position in the file */
    int32_t count, cap, unread;
    file_bytes file;
} stamped_list;

void mix_list_free(mix_list *l)
{
    for (int32_t i = 0; i < l->count; ++i) {
        free(l->entry[i].prefix);
        free(l->entry[i].photo);
        free(l->entry[i].depth);
    }
    free(l->entry);
    free(l->folder);
    memset(l, 0, sizeof *l);
}

/* Makes room for one more item. Returns the items, or NULL with `r` set and the old ones unchanged. */
static void *with_room(void *items, int32_t *cap, int32_t count, size_t bytes, report *r)
{
    if (count < *cap) {
        return items;
    }
    const int32_t larger = *cap > 0 ? 2 * *cap : 64;
    void *more = realloc(items, (size_t)larger * bytes);
    if (more == NULL) {
        report_fail(r, "out of memory");
        return NULL;
    }
    *cap = larger;
    return more;
}

static mix_entry *add(mix_list *l, report *r)
{
    mix_entry *more = with_room(l->entry, &l->cap, l->count, sizeof *more, r);
    if (more == NULL) {
        return NULL;
    }
    l->entry = more;
    memset(&l->entry[l->count], 0, sizeof *l->entry);
    return &l->entry[l->count++];
}

static int is_rooted(slice name) { return name.size > 0 && name.at[0] == '/'; }

/* Joins both strings. Returns NULL with `r` set on failure. The caller frees the result. */
static char *joined(const char *a, slice b, report *r)
{
    const size_t n = strlen(a);
    char *out = malloc(n + b.size + 1);
    if (out == NULL) {
        report_fail(r, "%s: out of memory", a);
        return NULL;
    }
    memcpy(out, a, n);
    memcpy(out + n, b.at, b.size);
    out[n + b.size] = '\0';
    return out;
}

static char *with(const char *a, const char *b, report *r)
{
    const slice s = {b, strlen(b)};
    return joined(a, s, r);
}

/* Returns the path of a name relative to the list, or NULL with `r` set. The caller frees the result. */
static char *beside(const char *folder, slice name, report *r)
{
    return joined(is_rooted(name) ? "" : folder, name, r);
}

/* --- TUM's lists -------------------------------------------------------------------------------------------------- */

/* Reads "time name", or "time" and seven numbers. Empty lines and headers, which begin with #, are skipped; other lines
 * are counted. Returns 0 with `r` set if memory is short. */
static int read_line(stamped_list *out, cursor *c, int has_names, report *r)
{
    slice s;
    stamped line;
    memset(&line, 0, sizeof line);
    if (!text_token(&s, c)) {
        return 1;
    }
    int ok = slice_number(&line.time, s) && isfinite(line.time);
    if (ok && has_names) {
        text_rest(&line.name, c);
        ok = line.name.size > 0 && memchr(line.name.at, 0, line.name.size) == NULL;
    }
    for (int i = 0; i < 7 && ok && !has_names; ++i) {
        ok = text_token(&s, c) && slice_number(&line.value[i], s);
    }
    if (!ok) {
        ++out->unread;
        return 1;
    }
    stamped *more = with_room(out->line, &out->cap, out->count, sizeof *more, r);
    if (more == NULL) {
        return 0;
    }
    out->line = more;
    out->line[out->count++] = line;
    return 1;
}

/* Both point into one array, in the file's order. */
static int by_time(const void *a, const void *b)
{
    const stamped *x = *(const stamped *const *)a, *y = *(const stamped *const *)b;
    return x->time != y->time ? (x->time > y->time) - (x->time < y->time) : (x > y) - (x < y);
}

static int sort(stamped_list *l, report *r)
{
    l->by_time = malloc((size_t)(l->count + 1) * sizeof *l->by_time);
    if (l->by_time == NULL) {
        return report_fail(r, "out of memory");
    }
    for (int32_t i = 0; i < l->count; ++i) {
        l->by_time[i] = &l->line[i];
    }
    qsort(l->by_time, (size_t)l->count, sizeof *l->by_time, by_time);
    return 1;
}

static int read_stamped(stamped_list *out, const char *folder, const char *name, int has_names, report *r)
{
    char *path = with(folder, name, r);
    memset(out, 0, sizeof *out);
    int ok = path != NULL && file_is_below(path, folder, strlen(folder), r) && file_read(&out->file, path, r);
    if (ok) {
        cursor c = text_open(out->file.data, out->file.size, path);
        do {
            ok = read_line(out, &c, has_names, r);
        } while (ok && text_next_line(&c));
    }
    free(path);
    return ok && sort(out, r);
}

/* The first line at or after this time, or the list's count. */
static int32_t first_from(const stamped_list *l, double time)
{
    int32_t low = 0, high = l->count;
    while (low < high) {
        const int32_t middle = low + (high - low) / 2;
        if (l->by_time[middle]->time < time) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

/* The line nearest in time; of two equally near ones the earlier. NULL if none is near enough. */
static const stamped *nearest(const stamped_list *l, double time)
{
    const int32_t from = first_from(l, time);
    const stamped *after = from < l->count ? l->by_time[from] : NULL,
                  *before = from > 0 ? l->by_time[first_from(l, l->by_time[from - 1]->time)] : NULL;
    const double later = after != NULL ? after->time - time : HUGE_VAL,
                 earlier = before != NULL ? time - before->time : HUGE_VAL;
    const stamped *found = earlier < later || (earlier == later && before < after) ? before : after;
    return fmin(earlier, later) < SAME_TIME ? found : NULL;
}

/* Converts a position and a quaternion x, y, z, w. */
static void pose_of(double out[16], const double v[7])
{
    const double l = sqrt(v[3] * v[3] + v[4] * v[4] + v[5] * v[5] + v[6] * v[6]);
    const double x = v[3] / l, y = v[4] / l, z = v[5] / l, w = v[6] / l;
    const double m[16] = {1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), v[0],
                          2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), v[1],
                          2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), v[2], 0, 0, 0, 1};
    memcpy(out, m, sizeof m);
}

static int join(mix_list *out, const stamped_list l[3], report *r)
{
    for (int32_t i = 0; i < l[0].count; ++i) {
        const stamped *photo = &l[0].line[i], *depth = nearest(&l[1], photo->time), *pose = nearest(&l[2], photo->time);
        if ((depth == NULL && !out->may_lack_depth) || pose == NULL) {
            out->no_depth += depth == NULL && !out->may_lack_depth;
            out->no_pose += depth != NULL || out->may_lack_depth;
            continue;
        }
        mix_entry *e = add(out, r);
        if (e == NULL || (e->photo = beside(out->folder, photo->name, r)) == NULL ||
            (depth != NULL && (e->depth = beside(out->folder, depth->name, r)) == NULL)) {
            return 0;
        }
        e->is_rooted = is_rooted(photo->name) || (depth != NULL && is_rooted(depth->name));
        pose_of(e->pose, pose->value);
    }
    out->unread = l[0].unread + l[1].unread + l[2].unread;
    return 1;
}

static int read_tum(mix_list *out, const char *folder, report *r)
{
    stamped_list l[3];
    memset(l, 0, sizeof l);
    out->folder = with(folder, "", r);
    const int ok = out->folder != NULL && read_stamped(&l[0], folder, "rgb.txt", 1, r) &&
                   read_stamped(&l[1], folder, "depth.txt", 1, r) &&
                   read_stamped(&l[2], folder, "groundtruth.txt", 0, r) && join(out, l, r);
    for (int i = 0; i < 3; ++i) {
        free(l[i].line);
        free(l[i].by_time);
        file_free(&l[i].file);
    }
    return ok;
}

/* --- prefixes ----------------------------------------------------------------------------------------------------- */

static int is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/* Returns 1 if there is a frame with this prefix. */
static int is_frame(const char *prefix, report *r)
{
    static const char *const endings[] = {".json", ".color.png", ".color.jpg", ".color.pam", ".color.pfm"};
    int found = 0;
    for (size_t i = 0; !found && i < sizeof endings / sizeof *endings; ++i) {
        report none = {""};
        char *name = with(prefix, endings[i], r);
        if (name == NULL) {
            return 0;
        }
        found = file_is_plain(name, &none);
        free(name);
    }
    return found;
}

/* The line without the carriage return at the end, if there is such a frame: the prefix may end with blanks. */
static slice without_return(const mix_list *l, slice line, report *r)
{
    slice kept = line;
    if (line.size > 0 && line.at[line.size - 1] == '\r') {
        --kept.size;
        char *prefix = beside(l->folder, kept, r);
        if (prefix != NULL && is_frame(prefix, r)) {
            line = kept;
        }
        free(prefix);
    }
    return line;
}

/* Reads a line of a list. Blanks around a prefix belong to it only if there is such a frame. If zero bytes separate the
 * lines (`breaks`), no line is a comment. */
static int read_prefix(mix_list *out, slice line, int breaks, report *r)
{
    line = breaks == '\n' ? without_return(out, line, r) : line;
    slice bare = line;
    while (bare.size > 0 && is_blank(bare.at[0])) {
        ++bare.at;
        --bare.size;
    }
    while (bare.size > 0 && is_blank(bare.at[bare.size - 1])) {
        --bare.size;
    }
    if (bare.size == 0 || (bare.at[0] == '#' && breaks == '\n')) {
        return 1;
    }
    mix_entry *e = add(out, r);
    if (e == NULL || (e->prefix = beside(out->folder, line, r)) == NULL) {
        return 0;
    }
    e->is_rooted = is_rooted(line);
    if (bare.size < line.size && !is_frame(e->prefix, r)) {
        free(e->prefix);
        e->prefix = beside(out->folder, bare, r);
        e->is_rooted = is_rooted(bare);
    }
    return e->prefix != NULL && r->text[0] == '\0';
}

static int read_prefixes(mix_list *out, const char *path, report *r)
{
    file_bytes file;
    const char *last = strrchr(path, '/');
    const slice folder = {path, last != NULL ? (size_t)(last + 1 - path) : 0};
    out->folder = beside("", folder, r);
    if (out->folder == NULL || !file_read(&file, path, r)) {
        return 0;
    }
    const int breaks = file.size > 0 && memchr(file.data, 0, file.size) != NULL ? '\0' : '\n';
    const char *at = (const char *)file.data, *end = at + file.size;
    at += file.size >= 3 && memcmp(at, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0;
    int ok = 1;
    while (ok && at < end) {
        const char *stop = memchr(at, breaks, (size_t)(end - at));
        const slice line = {at, (size_t)((stop != NULL ? stop : end) - at)};
        ok = read_prefix(out, line, breaks, r);
        at = stop != NULL ? stop + 1 : end;
    }
    file_free(&file);
    return ok;
}

static int fail_empty(const mix_list *l, const char *path, report *r)
{
    return l->no_depth + l->no_pose > 0
               ? report_fail(r, "%s: lists no frame: photos without a depth within 0.02 s: %d; without a pose: %d",
                             path, (int)l->no_depth, (int)l->no_pose)
               : report_fail(r, "%s: lists no frame", path);
}

/* Reads a TUM list or frames.txt, whichever the folder has. */
static int read_list(mix_list *out, const char *path, const char *folder, const char *tum, const char *own, report *r)
{
    report none = {""};
    const int is_tum = file_is_plain(tum, &none), is_folder = file_is_plain(own, &none);
    if (!is_tum && !is_folder && file_is_folder(path)) {
        return report_fail(r, "%s: a folder with neither frames.txt nor TUM's rgb.txt; name one, or a list of PREFIXes",
                           path);
    }
    if (!is_tum && is_folder && !file_is_below(own, folder, strlen(folder), r)) {
        return 0;
    }
    return (is_tum ? read_tum(out, folder, r) : read_prefixes(out, is_folder ? own : path, r)) &&
           (out->count > 0 || fail_empty(out, path, r));
}

int mix_list_read(mix_list *out, const char *path, report *r)
{
    const size_t n = strlen(path);
    const int may_lack_depth = out->may_lack_depth;
    memset(out, 0, sizeof *out);
    out->may_lack_depth = may_lack_depth;
    char *folder = with(path, n > 0 && path[n - 1] == '/' ? "" : "/", r);
    char *tum = folder != NULL ? with(folder, "rgb.txt", r) : NULL;
    char *own = folder != NULL ? with(folder, "frames.txt", r) : NULL;
    const int ok = tum != NULL && own != NULL && read_list(out, path, folder, tum, own, r);
    free(folder);
    free(tum);
    free(own);
    if (!ok) {
        mix_list_free(out);
    }
    return ok;
}
