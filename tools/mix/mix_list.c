/* mix_list.c: which photos, depths and poses a sequence has. */
#include "mix_frames.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../common/io_text.h"

enum { STAMPED_CAP = 65536 };

#define SAME_TIME 0.02 /* s: of a photo, its depth and its pose */

/* A line of one of TUM's lists. */
typedef struct stamped {
    double time, value[7];
    char name[256];
} stamped;

typedef struct stamped_list {
    stamped *line;
    int32_t count, unread;
} stamped_list;

void mix_list_free(mix_list *l)
{
    free(l->entry);
    memset(l, 0, sizeof *l);
}

static mix_entry *add(mix_list *l, report *r)
{
    if (l->count == l->cap) {
        const int32_t cap = l->cap > 0 ? 2 * l->cap : 64;
        mix_entry *more = realloc(l->entry, (size_t)cap * sizeof *more);
        if (more == NULL) {
            report_fail(r, "out of memory");
            return NULL;
        }
        l->entry = more;
        l->cap = cap;
    }
    memset(&l->entry[l->count], 0, sizeof *l->entry);
    return &l->entry[l->count++];
}

/* A name beside the list. */
static int beside(char *out, size_t size, const char *folder, const char *name, size_t length, report *r)
{
    const int n = length > 0 && name[0] == '/' ? snprintf(out, size, "%.*s", (int)length, name)
                                               : snprintf(out, size, "%s%.*s", folder, (int)length, name);
    return (n >= 0 && (size_t)n < size) || report_fail(r, "%s: a name is too long", folder);
}

/* --- TUM's lists -------------------------------------------------------------------------------------------------- */

/* "time name", or "time" and seven numbers. Empty lines and headers, which begin with #, are passed over, and others that
 * are neither are counted. */
static void read_line(stamped_list *out, cursor *c, int has_names)
{
    slice s;
    stamped line;
    memset(&line, 0, sizeof line);
    if (!text_token(&s, c) || s.at[0] == '#') {
        return;
    }
    int ok = slice_number(&line.time, s);
    if (ok && has_names) {
        ok = text_token(&s, c) && s.size < sizeof line.name;
        memcpy(line.name, s.at, ok ? s.size : 0);
    }
    for (int i = 0; i < 7 && ok && !has_names; ++i) {
        ok = text_token(&s, c) && slice_number(&line.value[i], s);
    }
    if (ok && out->count < STAMPED_CAP) {
        out->line[out->count++] = line;
    } else {
        ++out->unread;
    }
}

static int read_stamped(stamped_list *out, const char *folder, const char *name, int has_names, report *r)
{
    char path[600];
    file_bytes file;
    memset(out, 0, sizeof *out);
    snprintf(path, sizeof path, "%s%s", folder, name);
    if (!file_read(&file, path, r)) {
        return 0;
    }
    out->line = malloc(STAMPED_CAP * sizeof *out->line);
    cursor c = text_open(file.data, file.size, path);
    do {
        if (out->line != NULL) {
            read_line(out, &c, has_names);
        }
    } while (text_next_line(&c));
    file_free(&file);
    return out->line != NULL || report_fail(r, "out of memory");
}

static const stamped *nearest(const stamped_list *l, double time)
{
    const stamped *found = NULL;
    for (int32_t i = 0; i < l->count; ++i) {
        const double off = fabs(l->line[i].time - time);
        found = off < SAME_TIME && (found == NULL || off < fabs(found->time - time)) ? &l->line[i] : found;
    }
    return found;
}

/* Of a place and a quaternion x, y, z, w. */
static void pose_of(double out[16], const double v[7])
{
    const double l = sqrt(v[3] * v[3] + v[4] * v[4] + v[5] * v[5] + v[6] * v[6]);
    const double x = v[3] / l, y = v[4] / l, z = v[5] / l, w = v[6] / l;
    const double m[16] = {1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), v[0],
                          2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), v[1],
                          2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), v[2], 0, 0, 0, 1};
    memcpy(out, m, sizeof m);
}

static int join(mix_list *out, const stamped_list l[3], const char *folder, report *r)
{
    for (int32_t i = 0; i < l[0].count; ++i) {
        const stamped *photo = &l[0].line[i], *depth = nearest(&l[1], photo->time), *pose = nearest(&l[2], photo->time);
        if (depth == NULL || pose == NULL) {
            out->no_depth += depth == NULL;
            out->no_pose += depth != NULL;
            continue;
        }
        mix_entry *e = add(out, r);
        if (e == NULL || !beside(e->photo, sizeof e->photo, folder, photo->name, strlen(photo->name), r) ||
            !beside(e->depth, sizeof e->depth, folder, depth->name, strlen(depth->name), r)) {
            return 0;
        }
        pose_of(e->pose, pose->value);
    }
    out->unread = l[0].unread + l[1].unread + l[2].unread;
    return 1;
}

static int read_tum(mix_list *out, const char *folder, report *r)
{
    stamped_list l[3];
    memset(l, 0, sizeof l);
    const int ok = read_stamped(&l[0], folder, "rgb.txt", 1, r) && read_stamped(&l[1], folder, "depth.txt", 1, r) &&
                   read_stamped(&l[2], folder, "groundtruth.txt", 0, r) && join(out, l, folder, r);
    for (int i = 0; i < 3; ++i) {
        free(l[i].line);
    }
    return ok;
}

/* --- prefixes ----------------------------------------------------------------------------------------------------- */

static int read_prefixes(mix_list *out, const char *path, report *r)
{
    char folder[512];
    file_bytes file;
    const char *last = strrchr(path, '/');
    const size_t n = last != NULL ? (size_t)(last + 1 - path) : 0;
    if (!file_read(&file, path, r)) {
        return 0;
    }
    int ok = beside(folder, sizeof folder, "", path, n, r);
    cursor c = text_open(file.data, file.size, path);
    do {
        slice s;
        if (ok && text_token(&s, &c)) {
            mix_entry *e = add(out, r);
            ok = e != NULL && beside(e->prefix, sizeof e->prefix, folder, s.at, s.size, r);
        }
    } while (text_next_line(&c));
    file_free(&file);
    return ok;
}

static int fail_empty(const mix_list *l, const char *path, report *r)
{
    return l->no_depth + l->no_pose > 0
               ? report_fail(r, "%s: lists no frame: photos without a depth within 0.02 s: %d; without a pose: %d", path,
                             (int)l->no_depth, (int)l->no_pose)
               : report_fail(r, "%s: lists no frame", path);
}

int mix_list_read(mix_list *out, const char *path, report *r)
{
    char folder[512], name[600];
    report none = {""};
    memset(out, 0, sizeof *out);
    snprintf(folder, sizeof folder, "%s%s", path, path[0] != '\0' && path[strlen(path) - 1] == '/' ? "" : "/");
    snprintf(name, sizeof name, "%srgb.txt", folder);
    const int is_tum = file_is_plain(name, &none);
    snprintf(name, sizeof name, "%sframes.txt", folder);
    const int is_folder = file_is_plain(name, &none);
    const int ok = (is_tum ? read_tum(out, folder, r) : read_prefixes(out, is_folder ? name : path, r)) &&
                   (out->count > 0 || fail_empty(out, path, r));
    if (!ok) {
        mix_list_free(out);
    }
    return ok;
}
