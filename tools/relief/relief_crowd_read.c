/* relief_crowd_read.c: lists of placements of reliefs. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../common/io_text.h"
#include "relief_crowd.h"

enum { MOST_PLACED = 1000000, MOST_FILES = 1000 };
#define FARTHEST    1e6  /* m, below the 2^20 of the library */
#define LEAST_SCALE 1e-6
#define MOST_SCALE  1e6

void relief_crowd_free(relief_crowd *c)
{
    for (uint32_t i = 0; i < c->files; ++i) {
        free(c->file[i]->path);
        file_free(&c->file[i]->bytes);
        free(c->file[i]);
    }
    free(c->file);
    free(c->placed);
    free(c->meshes);
    free(c->instances);
    memset(c, 0, sizeof *c);
}

/* --- a line ------------------------------------------------------------------------------------------------------- */

/* Opens a file of the list, or finds it among those opened before. NULL with `r` set. */
static const lmb_relief *relief_named(relief_crowd *c, const cursor *at, slice name, size_t folder, report *r)
{
    char *path = malloc(folder + name.size + 1);
    if (path == NULL) {
        report_fail(r, "not enough memory");
        return NULL;
    }
    if (memchr(name.at, 0, name.size) != NULL) {
        free(path);
        text_fail(at, r, "a zero byte in a name");
        return NULL;
    }
    const int is_whole = name.size > 0 && name.at[0] == '/';
    const size_t before = is_whole ? 0 : folder;
    memcpy(path, at->path, before);
    memcpy(path + before, name.at, name.size);
    path[before + name.size] = '\0';
    for (uint32_t i = 0; i < c->files; ++i) {
        if (strcmp(c->file[i]->path, path) == 0) {
            free(path);
            return &c->file[i]->relief;
        }
    }
    if (c->files == MOST_FILES) {
        text_fail(at, r, "over %d files", (int)MOST_FILES);
    } else if (file_is_below(path, at->path, folder, r)) {
        relief_file **more = realloc(c->file, (c->files + 1) * sizeof *more);
        relief_file *f = calloc(1, sizeof *f);
        c->file = more != NULL ? more : c->file;
        if (more != NULL && f != NULL) {
            f->path = path;
            c->file[c->files++] = f;
            return relief_file_open(&f->relief, &f->bytes, path, r) ? &f->relief : NULL;
        }
        free(f);
        report_fail(r, "not enough memory");
    }
    free(path);
    return NULL;
}

static int is_within(double v, double low, double high) { return v >= low && v <= high; }

/* Reads FILE X Y Z [TURN [SCALE]]. */
static int read_placed(relief_placed *out, relief_crowd *c, cursor *at, slice name, size_t folder, report *r)
{
    double number[5] = {0.0, 0.0, 0.0, 0.0, 1.0};
    slice word;
    int count = 0;
    while (text_token(&word, at)) {
        if (count == 5 || !slice_number(&number[count], word) || !isfinite(number[count])) {
            return text_fail(at, r, "not FILE.lmr X Y Z [TURN [SCALE]]");
        }
        ++count;
    }
    if (count < 3) {
        return text_fail(at, r, "not FILE.lmr X Y Z [TURN [SCALE]]");
    }
    for (int i = 0; i < 3; ++i) {
        if (!is_within(number[i], -FARTHEST, FARTHEST)) {
            return text_fail(at, r, "a place over %g m away", FARTHEST);
        }
    }
    if (!is_within(number[4], LEAST_SCALE, MOST_SCALE)) {
        return text_fail(at, r, "a scale that is not %g .. %g", LEAST_SCALE, MOST_SCALE);
    }
    const float turn = (float)(fmod(number[3], 360.0) * 0.017453292519943295);
    out->relief = relief_named(c, at, name, folder, r);
    out->at = (lmb_vec3){(float)number[0], (float)number[1], (float)number[2]};
    out->cosine = lmb_cos(turn);
    out->sine = lmb_sin(turn);
    out->scale = (float)number[4];
    return out->relief != NULL;
}

static int read_lines(relief_crowd *c, cursor *at, size_t folder, report *r)
{
    uint32_t room = 0;
    do {
        slice name;
        if (!text_token(&name, at)) {
            continue;
        }
        if (c->count == MOST_PLACED) {
            return text_fail(at, r, "over %d placements", (int)MOST_PLACED);
        }
        if (c->count == room) {
            room = room > 0 ? 2 * room : 64;
            relief_placed *more = realloc(c->placed, room * sizeof *more);
            if (more == NULL) {
                return report_fail(r, "not enough memory for %u reliefs", (unsigned)room);
            }
            c->placed = more;
        }
        if (!read_placed(&c->placed[c->count], c, at, name, folder, r)) {
            return 0;
        }
        ++c->count;
    } while (text_next_line(at));
    return c->count > 0 || report_fail(r, "%s: no placements in it", at->path);
}

int relief_crowd_read(relief_crowd *out, const char *path, report *r)
{
    file_bytes file;
    const char *slash = strrchr(path, '/');
    memset(out, 0, sizeof *out);
    if (!file_read(&file, path, r)) {
        return 0;
    }
    cursor at = text_open(file.data, file.size, path);
    const int ok = read_lines(out, &at, slash != NULL ? (size_t)(slash - path) + 1 : 0, r) &&
                   relief_crowd_scene(out, r);
    file_free(&file);
    const lmb_vec3 low = out->scene.bounds_min, high = out->scene.bounds_max;
    const float reach = fmaxf(fmaxf(fmaxf(-low.x, -low.y), -low.z), fmaxf(fmaxf(high.x, high.y), high.z));
    if (ok && !(reach <= (float)FARTHEST)) {
        return report_fail(r, "%s: a placement reaches over %g m away", path, FARTHEST);
    }
    return ok;
}
