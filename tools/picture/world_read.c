/* world_read.c: image files -> the cube and ground of a world, as linear floats. */
#include "world_read.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../common/slice.h"
#include "world_sphere.h"

enum { MAX_SIDE = 4096 };

/* --- pictures ----------------------------------------------------------------------------------------------------- */

/* Replaces infinite texels, which would outshine the world, and NaN, which would spread. */
static void clear_not_finite(world_pictures *own, stored_picture *p)
{
    const size_t count = (size_t)p->width * (size_t)p->height * (size_t)p->light.channels;
    for (size_t i = 0; p->light.pixels != NULL && i < count; ++i) {
        if (!isfinite(p->light.pixels[i])) {
            p->light.pixels[i] = 0.0f;
            ++own->not_finite;
        }
    }
}

static int read_picture(stored_picture *out, world_pictures *own, const char *path, report *r)
{
    file_bytes bytes;
    if (!file_read(&bytes, path, r)) {
        return 0;
    }
    const int ok = picture_read(out, bytes.data, bytes.size, path, r);
    file_free(&bytes);
    if (ok) {
        clear_not_finite(own, out);
    }
    return ok;
}

/* Allocates face i, with alpha if the image has one; returns 0 with `r` set if memory is short. */
static int take_face(lmb_world_pictures *out, world_pictures *own, int i, int32_t side, const stored_picture *p,
                     const char *path, report *r)
{
    const size_t texels = (size_t)side * (size_t)side;
    const int has_alpha = p->light.pixels == NULL;
    out->face[i] = own->face[i] = malloc(3 * texels * sizeof(float));
    out->alpha[i] = own->alpha[i] = has_alpha ? malloc(texels * sizeof(float)) : NULL;
    out->face_size = side;
    return (own->face[i] != NULL && (!has_alpha || own->alpha[i] != NULL)) ||
           report_fail(r, "%s: out of memory", path);
}

/* --- one file ----------------------------------------------------------------------------------------------------- */

/* Copies the square with pixel (x0, y0) as a corner. */
static void copy_face(world_pictures *own, int face, int32_t side, const stored_picture *p, int32_t x0, int32_t y0)
{
    for (int32_t i = 0; i < side * side; ++i) {
        float rgba[4];
        world_pixel(rgba, p, (size_t)(y0 + i / side) * (size_t)p->width + (size_t)(x0 + i % side));
        memcpy(own->face[face] + 3 * (size_t)i, rgba, 3 * sizeof *rgba);
        if (own->alpha[face] != NULL) {
            own->alpha[face][i] = rgba[3];
        }
    }
}

static int read_strip(lmb_world_pictures *out, world_pictures *own, const stored_picture *p, const char *path,
                      report *r)
{
    const int down = p->height > p->width;
    const int32_t side = down ? p->width : p->height;
    for (int i = 0; i < 6; ++i) {
        if (!take_face(out, own, i, side, p, path, r)) {
            return 0;
        }
        copy_face(own, i, side, p, down ? 0 : i * side, down ? i * side : 0);
    }
    return 1;
}

static int read_sphere(lmb_world_pictures *out, world_pictures *own, const stored_picture *p, const char *path,
                       report *r)
{
    const int32_t side = p->width / 4 > 0 ? p->width / 4 : 1;
    for (int i = 0; i < 6; ++i) {
        if (!take_face(out, own, i, side, p, path, r)) {
            return 0;
        }
    }
    return world_sphere(own, side, p, path, r);
}

/* The side of a face. Checked before a face is allocated, because a small file may hold an image of one colour of
 * any size. */
static int32_t side_of(const stored_picture *p)
{
    const int32_t min = p->width < p->height ? p->width : p->height;
    return p->width == 2 * p->height ? p->width / 4 : min;
}

static int read_one(lmb_world_pictures *out, world_pictures *own, const char *path, report *r)
{
    stored_picture p;
    int ok;
    if (!read_picture(&p, own, path, r)) {
        return 0;
    }
    if (side_of(&p) > MAX_SIDE) {
        ok = report_fail(r, "%s: faces of %d pixels; at most %d", path, (int)side_of(&p), MAX_SIDE);
    } else if (p.height == 6 * p.width || p.width == 6 * p.height) {
        ok = read_strip(out, own, &p, path, r);
    } else if (p.width == 2 * p.height) {
        ok = read_sphere(out, own, &p, path, r);
    } else {
        ok = report_fail(r, "%s: %d x %d pixels are no world; six faces are N x 6N or 6N x N, the whole sphere 2N x N",
                         path, (int)p.width, (int)p.height);
    }
    stored_picture_free(&p);
    return ok;
}

/* --- six files ---------------------------------------------------------------------------------------------------- */

static int is_there(const char *path)
{
    return file_is_plain(path, NULL); /* without a line: a series asks for 250,000 names */
}

/* Finds the file of face i; returns 0 if there is none. */
static int find_face(char *path, size_t size, const char *prefix, int i)
{
    static const char *const names[6] = {"px", "nx", "py", "ny", "pz", "nz"};
    static const char *const kinds[4] = {"pfm", "hdr", "png", "jpg"};
    for (int k = 0; k < 4; ++k) {
        const int n = snprintf(path, size, "%s%s.%s", prefix, names[i], kinds[k]);
        if (n > 0 && (size_t)n < size && is_there(path)) {
            return 1;
        }
    }
    return 0;
}

static int read_face(lmb_world_pictures *out, world_pictures *own, int i, const char *path, report *r)
{
    stored_picture p;
    if (!read_picture(&p, own, path, r)) {
        return 0;
    }
    int ok = p.width == p.height && p.width <= MAX_SIDE && (out->face_size == 0 || out->face_size == p.width);
    if (!ok) {
        report_fail(r, "%s: %d x %d pixels; faces are square, of one size, at most %d", path, (int)p.width,
                    (int)p.height, MAX_SIDE);
    } else if ((ok = take_face(out, own, i, p.width, &p, path, r)) != 0) {
        copy_face(own, i, p.width, &p, 0, 0);
    }
    stored_picture_free(&p);
    return ok;
}

/* Always 0. */
static int no_world(const char *prefix, report *r)
{
    if (file_is_folder(prefix)) {
        const char *slash = prefix[strlen(prefix) - 1] == '/' ? "" : "/";
        return report_fail(r, "%s: a folder; give a picture, or %s%s if six faces are in it: px.png (.pfm .hdr .jpg), "
                           "nx py ny pz nz", prefix, prefix, slash);
    }
    return report_fail(r, "%s: no such file, and no face %spx.png (.pfm .hdr .jpg; px nx py ny pz nz)", prefix, prefix);
}

static int read_six(lmb_world_pictures *out, world_pictures *own, const char *prefix, report *r)
{
    char path[4096];
    for (int i = 0; i < 6; ++i) {
        if (find_face(path, sizeof path, prefix, i) && !read_face(out, own, i, path, r)) {
            return 0;
        }
    }
    return out->face_size > 0 || no_world(prefix, r);
}

/* --- all ---------------------------------------------------------------------------------------------------------- */

int world_is_there(const char *path)
{
    char face[4096];
    int any = is_there(path);
    for (int i = 0; i < 6 && !any; ++i) {
        any = find_face(face, sizeof face, path, i);
    }
    return any;
}

int world_hash(uint64_t *hash, const char *path, report *r)
{
    char face[4096];
    int any = 0, ok = 1;
    if (is_there(path) || strcmp(path, "-") == 0) {
        return slice_hash_file(hash, path, r);
    }
    for (int i = 0; i < 6 && ok; ++i) {
        if (find_face(face, sizeof face, path, i)) {
            *hash += (uint64_t)i; /* which faces are missing */
            ok = slice_hash_file(hash, face, r);
            any = 1;
        }
    }
    return ok && (any || no_world(path, r));
}

int world_read_cube(lmb_world_pictures *out, world_pictures *own, const char *path, report *r)
{
    memset(out->face, 0, sizeof out->face); /* of another world, which is freed */
    memset(out->alpha, 0, sizeof out->alpha);
    out->face_size = 0;
    return is_there(path) ? read_one(out, own, path, r) : read_six(out, own, path, r);
}

int world_check(const char *path, int32_t *face_size, report *r)
{
    lmb_world_pictures cube;
    world_pictures own;
    memset(&cube, 0, sizeof cube);
    memset(&own, 0, sizeof own);
    report none = {""}; /* a prefix of six files is no file */
    const int ok = world_read_cube(&cube, &own, path, r) && (!file_is_plain(path, &none) || file_keep(path, r));
    world_pictures_free(&own);
    *face_size = cube.face_size;
    return ok;
}

int world_read_ground(lmb_world_pictures *out, world_pictures *own, const char *path, report *r)
{
    stored_picture p;
    if (!read_picture(&p, own, path, r)) {
        return 0;
    }
    free(own->ground); /* the built-in world has one */
    own->ground = NULL;
    const size_t pixels = (size_t)p.width * (size_t)p.height;
    int ok = p.width <= LMB_MAX_SIDE && p.height <= LMB_MAX_SIDE;
    if (!ok) {
        report_fail(r, "%s: %d x %d pixels; a ground is at most %d a side", path, (int)p.width, (int)p.height,
                    LMB_MAX_SIDE);
    } else if ((own->ground = malloc(4 * pixels * sizeof *own->ground)) == NULL) {
        ok = report_fail(r, "%s: out of memory", path);
    }
    for (size_t i = 0; ok && i < pixels; ++i) {
        world_pixel(own->ground + 4 * i, &p, i);
    }
    out->ground = own->ground;
    out->ground_width = p.width;
    out->ground_height = p.height;
    stored_picture_free(&p);
    return ok;
}

void world_tell_not_finite(world_pictures *own, const char *path, int is_quiet)
{
    if (own->not_finite > 0) {
        report_note(is_quiet, "note: %s: numbers that are infinite or none, and count as black: %.0f", path,
                    (double)own->not_finite);
    }
    own->not_finite = 0;
}

void world_pictures_free(world_pictures *own)
{
    for (int i = 0; i < 6; ++i) {
        free(own->face[i]);
        free(own->alpha[i]);
    }
    free(own->ground);
    memset(own, 0, sizeof *own);
}
