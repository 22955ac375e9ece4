/* bench_truth.c: a truth from a file, from the cache, or drawn. */
#include "bench_truth.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/host.h"

static int read_pfm(image *out, const char *path, report *r)
{
    file_bytes file;
    if (!file_read(&file, path, r)) {
        return 0;
    }
    const int ok = pfm_decode(out, file.data, file.size, path, r);
    file_free(&file);
    if (ok && out->channels != 3) {
        image_free(out);
        return report_fail(r, "%s: one channel; a truth has three", path);
    }
    return ok;
}

int bench_truth_read(bench_truth *t, const char *path, report *r)
{
    const char *name = path;
    memset(t, 0, sizeof *t);
    for (const char *c = path; *c != '\0'; ++c) {
        name = *c == '/' || *c == '\\' ? c + 1 : name;
    }
    snprintf(t->said, sizeof t->said, "%.200s", name);
    return read_pfm(&t->picture, path, r);
}

/* FOLDER/HASH.pfm; returns 0 if there is no cache folder. */
static int cache_path(char *out, size_t size, const char *folder, uint64_t hash)
{
    const char *cache = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    int n = -1;
    if (folder != NULL) {
        n = snprintf(out, size, "%s/%016" PRIx64 ".pfm", folder, hash);
    } else if (cache != NULL && cache[0] != '\0') {
        n = snprintf(out, size, "%s/lambent/%016" PRIx64 ".pfm", cache, hash);
    } else if (home != NULL && home[0] != '\0') {
        n = snprintf(out, size, "%s/.cache/lambent/%016" PRIx64 ".pfm", home, hash);
    }
    return n > 0 && (size_t)n < size;
}

/* Stores a picture in the cache; if that fails, it will be drawn again next time. */
static void keep(const image *picture, const char *path)
{
    report unheard = {""};
    file_bytes file = {NULL, 0};
    host_make_folders(path);
    remove(path); /* a damaged file may exist, and files that were read are never overwritten */
    if (pfm_encode(&file, picture, &unheard)) {
        file_write(path, file.data, file.size, &unheard);
        file_free(&file);
    }
}

static int draw(bench_truth *t, const bench_options *o, const bench_line *line, report *r)
{
    bench_shot shot;
    if (!o->subject->truth(&shot, line, r)) {
        return 0;
    }
    t->picture = shot.picture;
    t->surface = shot.surface;
    shot.picture.pixels = NULL;
    shot.surface = NULL;
    bench_shot_free(&shot);
    return 1;
}

int bench_truth_make(bench_truth *t, const bench_options *o, const bench_line *line, report *r)
{
    char path[1024];
    uint64_t hash = 0;
    report unheard = {""};
    memset(t, 0, sizeof *t);
    t->is_own = 1;
    snprintf(t->said, sizeof t->said, "%s", o->subject->truth_is);
    if (o->subject->hash == NULL || !o->subject->hash(&hash, line, r) ||
        !cache_path(path, sizeof path, o->cache, hash)) {
        return r->text[0] == '\0' && draw(t, o, line, r);
    }
    if (read_pfm(&t->picture, path, &unheard)) {
        return 1;
    }
    const int ok = draw(t, o, line, r);
    if (ok) {
        keep(&t->picture, path);
    }
    return ok;
}

void bench_truth_free(bench_truth *t)
{
    image_free(&t->picture);
    free(t->surface);
}
