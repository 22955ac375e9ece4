/* mix_frame.c: a photo with depth and camera, read from files. */
#include "mix_frame.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../common/io_json.h"
#include "../picture/io_pam.h"

enum { PATH_CAP = 4096 };

/* PREFIX with the first ending for which there is a file, or with the first ending if there is none. */
static int find_file(char path[PATH_CAP], const char *prefix, const char *const *endings, report *r)
{
    for (int i = 0; endings[i] != NULL; ++i) {
        report none = {""};
        if (snprintf(path, PATH_CAP, "%s%s", prefix, endings[i]) >= PATH_CAP) {
            return report_fail(r, "--frame: the name is too long");
        }
        if (file_is_plain(path, &none)) {
            return 1;
        }
    }
    snprintf(path, PATH_CAP, "%s%s", prefix, endings[0]);
    return 1;
}

/* --- photo -------------------------------------------------------------------------------------------------------- */

static int linear_photo(mix_frame *f, const char *path, report *r)
{
    const size_t pixels = (size_t)f->photo.width * (size_t)f->photo.height;
    f->light.width = f->photo.width;
    f->light.height = f->photo.height;
    f->light.channels = 3;
    f->light.pixels = malloc(3 * pixels * sizeof(float));
    if (f->light.pixels == NULL) {
        return report_fail(r, "%s: out of memory", path);
    }
    const int channels = f->photo.light.channels;
    for (size_t i = 0; i < 3 * pixels; ++i) {
        f->light.pixels[i] = f->photo.codes.texels != NULL ? f->photo.light_of[f->photo.codes.texels[i / 3 * 4 + i % 3]]
                                                           : f->photo.light.pixels[channels == 1 ? i / 3 : i];
    }
    return 1;
}

static int read_photo(mix_frame *f, const char *path, report *r)
{
    file_bytes file;
    if (!file_read(&file, path, r)) {
        return 0;
    }
    const int ok = picture_read(&f->photo, file.data, file.size, path, r) && linear_photo(f, path, r);
    file_free(&file);
    if (ok && (f->photo.width > LMB_MAX_SIDE || f->photo.height > LMB_MAX_SIDE)) {
        return report_fail(r, "%s: %d x %d pixels; at most %d a side", path, (int)f->photo.width, (int)f->photo.height,
                           LMB_MAX_SIDE);
    }
    return ok;
}

/* --- depth -------------------------------------------------------------------------------------------------------- */

/* 16-bit grey codes as numbers, one channel. */
static int grey_of_png(image *out, const file_bytes *file, const char *path, report *r)
{
    bitmap codes;
    if (!(is_pam(file->data, file->size) ? pam_decode_16 : png_decode_16)(&codes, file->data, file->size, path, r)) {
        return 0;
    }
    const size_t pixels = (size_t)codes.width * (size_t)codes.height;
    out->width = codes.width;
    out->height = codes.height;
    out->channels = 1;
    out->pixels = malloc(pixels * sizeof(float));
    for (size_t i = 0; out->pixels != NULL && i < pixels; ++i) {
        out->pixels[i] = (float)(codes.texels[4 * i] << 8 | codes.texels[4 * i + 1]);
    }
    bitmap_free(&codes);
    return out->pixels != NULL || report_fail(r, "%s: out of memory", path);
}

/* Takes the first channel, in metres. */
static int take_depth(mix_frame *f, const image *in, float scale, const char *path, report *r)
{
    const size_t pixels = (size_t)in->width * (size_t)in->height;
    if (in->width != f->photo.width || in->height != f->photo.height) {
        return mix_has_shape(f, in)
                   ? mix_resample(f, in, scale) || report_fail(r, "%s: out of memory", path)
                   : report_fail(
                         r, "%s: %d x %d pixels, the photo has %d x %d; depth must be registered to it, of its shape",
                         path, (int)in->width, (int)in->height, (int)f->photo.width, (int)f->photo.height);
    }
    f->depth = malloc(pixels * sizeof(float));
    for (size_t i = 0; f->depth != NULL && i < pixels; ++i) {
        f->depth[i] = in->pixels[(size_t)in->channels * i] * scale;
    }
    return f->depth != NULL || report_fail(r, "%s: out of memory", path);
}

static int read_depth(mix_frame *f, const char *path, float scale, report *r)
{
    file_bytes file;
    image in;
    if (!file_read(&file, path, r)) {
        return 0;
    }
    const int is_pfm = file.size > 2 && file.data[0] == 'P' && !is_pam(file.data, file.size);
    int ok = is_pfm ? pfm_decode(&in, file.data, file.size, path, r) : grey_of_png(&in, &file, path, r);
    if (ok) {
        ok = take_depth(f, &in, scale > 0.0f ? scale : is_pfm ? 1.0f : 0.001f, path, r);
        image_free(&in);
    }
    file_free(&file);
    return ok;
}

/* --- camera ------------------------------------------------------------------------------------------------------- */

int mix_is_pose(const double pose[16])
{
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            const double d = pose[4 * i] * pose[4 * k] + pose[4 * i + 1] * pose[4 * k + 1] +
                             pose[4 * i + 2] * pose[4 * k + 2];
            if (!(fabs(d - (i == k)) < 1e-3)) {
                return 0;
            }
        }
        if (!(fabs(pose[4 * i + 3]) < 1e4)) {
            return 0;
        }
    }
    const double turn = pose[0] * (pose[5] * pose[10] - pose[6] * pose[9]) -
                        pose[1] * (pose[4] * pose[10] - pose[6] * pose[8]) +
                        pose[2] * (pose[4] * pose[9] - pose[5] * pose[8]);
    return turn > 0.0;
}

static int read_pose(mix_frame *f, const json *doc, report *r)
{
    const uint32_t rows = json_member(doc, 0, "camera_to_world");
    if (rows == JSON_NONE) {
        return 1;
    }
    if (json_kind(doc, rows) != JSON_ARRAY || json_count(doc, rows) != 4) {
        return json_fail(doc, rows, r, "is not four rows of four numbers");
    }
    uint32_t row = json_first(doc, rows);
    for (int i = 0; i < 4; ++i, row = json_next(doc, row)) {
        if (!json_read_doubles(f->pose + 4 * i, 4, doc, row, r)) {
            return 0;
        }
    }
    f->has_pose = mix_is_pose(f->pose);
    return f->has_pose || json_fail(doc, rows, r, "is no rotation and place");
}

static int read_numbers(mix_frame *f, mix_source *s, const json *doc, report *r)
{
    static const char *const names[4] = {"fx", "fy", "cx", "cy"};
    const uint32_t unit = json_member(doc, 0, "depth_unit_mm");
    double unit_mm = 0.0, v[4] = {0};
    for (int i = 0; i < 4; ++i) {
        const uint32_t node = json_member(doc, 0, names[i]);
        if (node == JSON_NONE) {
            return report_fail(r, "%s: has no %s", doc->name, names[i]);
        }
        if (!json_read_double(&v[i], doc, node, r)) {
            return 0;
        }
    }
    for (int i = 0; i < 4 && !s->has_intrinsics; ++i) {
        s->intrinsics[i] = (float)v[i];
    }
    s->has_intrinsics = 1;
    if (!json_read_double(&unit_mm, doc, unit, r)) {
        return 0;
    }
    if (unit != JSON_NONE && !(unit_mm >= 1e-6 && unit_mm <= 1e6)) {
        return json_fail(doc, unit, r, "is %g; a unit of depth has 0.000001 to 1,000,000 mm", unit_mm);
    }
    s->depth_scale = s->depth_scale > 0.0f ? s->depth_scale : (float)(unit_mm * 0.001);
    return read_pose(f, doc, r);
}

/* Returns 1 if a file that a list of frames refers to may be read. */
static int may_read(const mix_source *s, const char *path, report *r)
{
    return s->folder == NULL || (file_is_below(path, s->folder, strlen(s->folder), r) && file_is_plain(path, r));
}

static int read_camera(mix_frame *f, mix_source *s, report *r)
{
    char path[PATH_CAP];
    static const char *const endings[] = {".json", NULL};
    file_bytes file;
    json doc;
    if (!find_file(path, s->frame, endings, r) || !may_read(s, path, r) || !file_read(&file, path, r)) {
        return 0;
    }
    int ok = json_parse(&doc, (const char *)file.data, file.size, path, r);
    if (ok) {
        ok = read_numbers(f, s, &doc, r);
        json_free(&doc);
    }
    file_free(&file);
    return ok;
}

int mix_is_camera(const float v[4])
{
    return v[0] > 0.1f && v[1] > 0.1f && v[0] < 1e5f && v[1] < 1e5f && v[2] > -8192.0f && v[2] < 16384.0f &&
           v[3] > -8192.0f && v[3] < 16384.0f;
}

static int set_camera(mix_frame *f, const mix_source *s, report *r)
{
    const lmb_pinhole c = {f->photo.width, f->photo.height, s->intrinsics[0], s->intrinsics[1], s->intrinsics[2],
                           s->intrinsics[3]};
    f->camera = c;
    return mix_is_camera(s->intrinsics) ||
           report_fail(r, "intrinsics %g,%g,%g,%g: focal lengths are over 0 and all in pixels", (double)c.fx,
                       (double)c.fy, (double)c.cx, (double)c.cy);
}

/* --- the whole ---------------------------------------------------------------------------------------------------- */

static int read_all(mix_frame *f, mix_source s, report *r)
{
    char photo[PATH_CAP], depth[PATH_CAP];
    static const char *const colours[] = {".color.png", ".color.jpg", ".color.pam", ".color.pfm", NULL};
    static const char *const depths[] = {".depth.png", ".depth.pfm", NULL};
    if (s.frame != NULL) {
        if (!read_camera(f, &s, r) || (s.photo == NULL && !find_file(photo, s.frame, colours, r)) ||
            (s.depth == NULL && !find_file(depth, s.frame, depths, r))) {
            return 0;
        }
        s.photo = s.photo != NULL ? s.photo : photo;
        s.depth = s.depth != NULL ? s.depth : depth;
    }
    report none = {""};
    f->lacks_depth = s.may_lack_depth && (s.depth == NULL || !file_is_plain(s.depth, &none));
    if (!may_read(&s, s.photo, r) || (!f->lacks_depth && !may_read(&s, s.depth, r)) || !read_photo(f, s.photo, r)) {
        return 0;
    }
    if (f->lacks_depth) {
        f->depth = calloc((size_t)f->photo.width * (size_t)f->photo.height, sizeof *f->depth);
        return (f->depth != NULL || report_fail(r, "%s: out of memory", s.photo)) && set_camera(f, &s, r);
    }
    return read_depth(f, s.depth, s.depth_scale, r) && set_camera(f, &s, r);
}

int mix_frame_read(mix_frame *out, const mix_source *from, report *r)
{
    memset(out, 0, sizeof *out);
    if (!read_all(out, *from, r)) {
        mix_frame_free(out);
        return 0;
    }
    return 1;
}

void mix_frame_free(mix_frame *f)
{
    stored_picture_free(&f->photo);
    image_free(&f->light);
    free(f->depth);
    memset(f, 0, sizeof *f);
}
