/* relight_path.c: a file of places, X,Y,Z per line, and a picture of each. */
#include "relight_path.h"

#include <stdlib.h>
#include <string.h>

#include "../common/frame_name.h"
#include "../common/io_file.h"
#include "relight_options.h"

enum { LONGEST = 4096, MAX = 10000 };

/* Copies a line without blanks at both ends. Returns 0 if it is too long for a place. */
static int take_line(char out[LONGEST], const char *from, size_t length)
{
    while (length > 0 && strchr(" \t\r", from[length - 1]) != NULL) {
        --length;
    }
    while (length > 0 && (*from == ' ' || *from == '\t')) {
        ++from;
        --length;
    }
    if (length >= LONGEST || memchr(from, '\0', length) != NULL) {
        return 0;
    }
    memcpy(out, from, length);
    out[length] = '\0';
    return 1;
}

/* Cuts a world's name off the end of a line. Returns 0 with `r` set if it must not be read, or if memory is short. */
static int take_world(char **out, char *word, const char *path, report *r)
{
    const char *slash = strrchr(path, '/');
    const size_t folder = slash != NULL ? (size_t)(slash - path) + 1 : 0, comma = strcspn(word, " \t");
    char *name = word + comma;
    if (*name == '\0') {
        return 1;
    }
    *name++ = '\0';
    name += strspn(name, " \t");
    const size_t from = name[0] == '/' ? 0 : folder, size = strlen(name);
    *out = malloc(from + size + 1);
    if (*out == NULL) {
        return report_fail(r, "%s: out of memory", path);
    }
    memcpy(*out, path, from);
    memcpy(*out + from, name, size + 1);
    return file_is_below(*out, path, folder, r);
}

static int read_places(place_list *out, const char *text, size_t size, const char *path, report *r)
{
    for (size_t at = 0, line = 1; at < size; ++line) {
        const char *end = memchr(text + at, '\n', size - at);
        const size_t length = end != NULL ? (size_t)(end - text) - at : size - at;
        char word[LONGEST];
        if (!take_line(word, text + at, length)) {
            return report_fail(r, "%s:%u: the line is too long, or no text", path, (unsigned)line);
        }
        if (word[0] != '\0' && word[0] != '#') {
            if (out->count == MAX) {
                return report_fail(r, "%s:%u: over %d places", path, (unsigned)line, MAX);
            }
            const int32_t i = out->count++;
            if (!take_world(&out->world[i], word, path, r)) {
                return 0;
            }
            if (!relight_place(word, &out->place[i])) {
                return report_fail(r, "%s:%u: `%s` is not X,Y,Z within 1,000,000 m", path, (unsigned)line, word);
            }
        }
        at += length + 1;
    }
    return out->count > 0 || report_fail(r, "%s: no places in it", path);
}

int place_list_read(place_list *out, const char *path, report *r)
{
    file_bytes file;
    memset(out, 0, sizeof *out);
    if (!file_read(&file, path, r)) {
        return 0;
    }
    out->place = malloc(MAX * sizeof *out->place);
    out->world = calloc(MAX, sizeof *out->world);
    const int has_room = out->place != NULL && out->world != NULL;
    const int ok = has_room ? read_places(out, (const char *)file.data, file.size, path, r)
                            : report_fail(r, "%s: out of memory", path);
    file_free(&file);
    return ok;
}

void place_list_free(place_list *list)
{
    for (int32_t i = 0; list->world != NULL && i < list->count; ++i) {
        free(list->world[i]);
    }
    free(list->world);
    free(list->place);
}

int place_tell(const place_list *list, int32_t i, const char *name, int is_kept, int is_quiet)
{
    const lmb_vec3 at = list->place[i];
    if (!is_quiet) {
        report_say("%s  %g,%g,%g  %s\n", name, (double)at.x, (double)at.y, (double)at.z, is_kept ? "kept" : "computed");
    }
    return 1;
}

int place_list_walk(const place_list *list, const char *out, place_draw *draw, void *user, const lmb_probe_cache *cache,
                    int is_quiet, report *r)
{
    if (!frames_can_write(out, list->count, r)) {
        return 0;
    }
    for (int32_t i = 0; i < list->count; ++i) {
        char name[4096];
        if (!frame_numbered(name, sizeof name, out, i, r) || !draw(user, i, name, r)) {
            return 0;
        }
    }
    if (!is_quiet) {
        report_say("light computed %u times, kept %u times\n", (unsigned)cache->computed, (unsigned)cache->kept);
    }
    return report_flush(r);
}
