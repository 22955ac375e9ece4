/* mix_labels.c: per-pixel labels of the object, written as files beside the picture. */
#include "mix_labels.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../common/text_buffer.h"
#include "../picture/picture.h"
#include "mix_grain.h"
#include "mix_turn.h"

enum { PATH_CAP = 4096 };

static float dot(lmb_vec3 a, lmb_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/* 1 unless a label would replace the picture or the statistics; names are compared as text. */
static int names_differ(const mix_job *j, report *r)
{
    static const char *const endings[] = {".mask.png", ".depth.pfm", ".normal.pfm", ".object.png", ".pose.json"};
    const char *const others[] = {j->o.out, j->o.stats};
    const size_t length = strlen(j->o.labels);
    for (int i = 0; i < 10; ++i) {
        const char *other = others[i % 2];
        if (other != NULL && strncmp(other, j->o.labels, length) == 0 && strcmp(other + length, endings[i / 2]) == 0) {
            return report_fail(r, "--labels would write %s a second time", other);
        }
    }
    return 1;
}

int mix_labels_take(mix_job *j, report *r)
{
    const size_t pixels = (size_t)j->frame.light.width * (size_t)j->frame.light.height;
    j->grain = j->o.match_grain ? mix_take(j, sizeof *j->grain, r) : NULL;
    if (j->o.match_grain && j->grain == NULL) {
        return 0;
    }
    if (j->grain != NULL && !mix_grain_find(j->grain, &j->frame.light)) {
        return report_fail(r, "out of memory");
    }
    if (j->o.labels == NULL || j->is_shared) {
        return 1;
    }
    if (!names_differ(j, r)) {
        return 0;
    }
    struct mix_labels *l = j->labels = mix_take(j, sizeof *l, r);
    if (l == NULL || (l->covered = mix_take(j, MIX_LABEL_FLOATS * pixels * sizeof *l->covered, r)) == NULL) {
        return 0;
    }
    mix_labels_lay_out(l, pixels);
    l->count = 1;
    l->placed[0] = j->placed;
    l->path[0] = j->o.object;
    return 1;
}

void mix_labels_lay_out(struct mix_labels *l, size_t pixels)
{
    l->depth = l->covered + pixels;
    l->normal = l->depth + pixels;
    l->rgb = l->normal + 3 * pixels;
    l->object = l->rgb + 3 * pixels;
}

static int32_t object_of(const struct mix_labels *l, uint32_t id)
{
    int32_t i = 0;
    while (i + 1 < l->count && id >= l->first[i + 1]) {
        ++i;
    }
    return i;
}

/* The pixel of the photo; -1 outside. */
static ptrdiff_t pixel_of(const mix_job *j, const lmb_tile *real, int32_t k)
{
    const int32_t x = real->x + k % LMB_TILE, y = real->y + k / LMB_TILE;
    return x < j->frame.light.width && y < j->frame.light.height ? (ptrdiff_t)y * j->frame.light.width + x : -1;
}

void mix_labels_sample(const mix_job *j, const lmb_tile *real, const lmb_tile *object, uint64_t shown)
{
    const struct mix_labels *l = j->labels;
    for (int32_t k = 0; k < LMB_TILE_PIXELS && l != NULL; ++k) {
        const ptrdiff_t at = (shown >> k & 1u) != 0 ? pixel_of(j, real, k) : -1;
        if (at >= 0 && !(l->depth[at] > 0.0f)) {
            const lmb_vec3 n = {object->normal[0][k], object->normal[1][k], object->normal[2][k]};
            l->depth[at] = object->depth[k];
            l->object[at] = (float)(1 + object_of(l, object->id[k]));
            l->normal[3 * at] = dot(j->axes.right, n);
            l->normal[3 * at + 1] = dot(j->axes.up, n);
            l->normal[3 * at + 2] = dot(j->axes.back, n);
        }
    }
}

void mix_labels_cover(const mix_job *j, const lmb_tile *real, const lmb_radiance *over,
                      const float covered[LMB_TILE_PIXELS])
{
    for (int32_t k = 0; k < LMB_TILE_PIXELS && j->labels != NULL; ++k) {
        const ptrdiff_t at = pixel_of(j, real, k);
        if (at >= 0) {
            j->labels->covered[at] = covered[k];
            for (int c = 0; c < 3; ++c) {
                j->labels->rgb[3 * at + c] = over->rgb[c][k];
            }
        }
    }
}

void mix_labels_grain(lmb_radiance *inout, const mix_job *j, const lmb_tile *real, const float covered[LMB_TILE_PIXELS])
{
    if (j->grain != NULL) {
        mix_grain_add(inout, j->grain, covered, real->x, real->y);
    }
}

/* --- files -------------------------------------------------------------------------------------------------------- */

static int write_picture(const mix_job *j, const char *ending, float *pixels, int32_t channels, report *r)
{
    char path[PATH_CAP];
    const image p = {
        .width = j->frame.light.width, .height = j->frame.light.height, .channels = channels, .pixels = pixels};
    return snprintf(path, sizeof path, "%s%s", j->o.labels, ending) < PATH_CAP
               ? picture_write(path, &p, 0.0f, PICTURE_CLIPPED, r)
               : report_fail(r, "--labels: the name is too long");
}

static int write_codes(const mix_job *j, const char *ending, const uint8_t *rgb, report *r)
{
    char path[PATH_CAP];
    file_bytes file = {NULL, 0};
    const int ok = (snprintf(path, sizeof path, "%s%s", j->o.labels, ending) < PATH_CAP ||
                    report_fail(r, "--labels: the name is too long")) &&
                   png_encode_quick(&file, rgb, j->frame.light.width, j->frame.light.height, r) &&
                   file_write(path, file.data, file.size, r);
    file_free(&file);
    return ok;
}

/* The code 255 if the object covers half of the pixel; of several objects the next ones have 254, 253, ... */
static int write_mask(const mix_job *j, report *r)
{
    const size_t pixels = (size_t)j->frame.light.width * (size_t)j->frame.light.height;
    uint8_t *mask = malloc(3 * pixels);
    if (mask == NULL) {
        return report_fail(r, "out of memory");
    }
    for (size_t i = 0; i < 3 * pixels; ++i) {
        mask[i] = j->labels->covered[i / 3] >= 0.5f ? (uint8_t)(256 - (int)j->labels->object[i / 3]) : 0;
    }
    const int ok = write_codes(j, ".mask.png", mask, r);
    free(mask);
    return ok;
}

/* The object without the photo, with alpha. */
static int write_object(const mix_job *j, float exposure_ev, report *r)
{
    char path[PATH_CAP];
    file_bytes file = {NULL, 0};
    const image p = {
        .width = j->frame.light.width, .height = j->frame.light.height, .channels = 3, .pixels = j->labels->rgb};
    const int ok = (snprintf(path, sizeof path, "%s.object.png", j->o.labels) < PATH_CAP ||
                    report_fail(r, "--labels: the name is too long")) &&
                   picture_encode_alpha(&file, &p, j->labels->covered, exposure_ev, PICTURE_CLIPPED, r) &&
                   file_write(path, file.data, file.size, r);
    file_free(&file);
    return ok;
}

static void put_rows(text_buffer *out, const char *indent, const char *name, const double m[3][4])
{
    text_buffer_add(out, "%s\"%s\": [", indent, name);
    for (int i = 0; i < 3; ++i) {
        text_buffer_add(out, "[%.9g, %.9g, %.9g, %.9g],\n%s  ", m[i][0], m[i][1], m[i][2], m[i][3], indent);
    }
    text_buffer_add(out, "[0, 0, 0, 1]]");
}

/* From mesh units to camera space as poses define it (x right, y down, z ahead), and to the world. */
static void put_pose(text_buffer *out, const char *indent, const mix_job *j, const lmb_mat4 *placed)
{
    const lmb_vec3 axis[3] = {j->axes.right, j->axes.up, j->axes.back};
    double camera[3][4], world[3][4];
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 4; ++k) {
            const float *c = placed->m + 4 * k;
            camera[i][k] = (double)((i == 0 ? 1.0f : -1.0f) * (axis[i].x * c[0] + axis[i].y * c[1] + axis[i].z * c[2]));
        }
    }
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 4; ++k) {
            const double *p = j->frame.pose + 4 * i;
            world[i][k] = p[0] * camera[0][k] + p[1] * camera[1][k] + p[2] * camera[2][k] + (k == 3 ? p[3] : 0.0);
        }
    }
    put_rows(out, indent, "object_to_camera", (const double(*)[4])camera);
    if (j->frame.has_pose) {
        text_buffer_add(out, ",\n");
        put_rows(out, indent, "object_to_world", (const double(*)[4])world);
    }
}

/* The camera, the first object's place as before, and, of several, each one's. */
static int write_pose(const mix_job *j, report *r)
{
    char path[PATH_CAP];
    const lmb_pinhole *c = &j->frame.camera;
    text_buffer out;
    memset(&out, 0, sizeof out);
    text_buffer_add(
        &out,
        "{\n  \"width\": %d,\n  \"height\": %d,\n  \"fx\": %.9g,\n  \"fy\": %.9g,\n  \"cx\": %.9g,\n  \"cy\": "
        "%.9g,\n",
        (int)c->width, (int)c->height, (double)c->fx, (double)c->fy, (double)c->cx, (double)c->cy);
    if (j->frame.has_pose) {
        double pose[3][4];
        memcpy(pose, j->frame.pose, sizeof pose);
        put_rows(&out, "  ", "camera_to_world", (const double(*)[4])pose);
        text_buffer_add(&out, ",\n");
    }
    put_pose(&out, "  ", j, &j->labels->placed[0]);
    for (int32_t i = 0; i < j->labels->count && j->labels->count > 1; ++i) {
        text_buffer_add(&out, i == 0 ? ",\n  \"objects\": [{\n    \"mask\": %d,\n" : "}, {\n    \"mask\": %d,\n",
                        255 - (int)i);
        put_pose(&out, "    ", j, &j->labels->placed[i]);
    }
    text_buffer_add(&out, j->labels->count > 1 ? "}]\n}\n" : "\n}\n");
    const int ok = (snprintf(path, sizeof path, "%s.pose.json", j->o.labels) < PATH_CAP ||
                    report_fail(r, "--labels: the name is too long")) &&
                   text_buffer_write(&out, path, r);
    text_buffer_free(&out);
    return ok;
}

int mix_labels_write(const mix_job *j, float exposure_ev, report *r)
{
    return j->labels == NULL || (write_mask(j, r) && write_picture(j, ".depth.pfm", j->labels->depth, 1, r) &&
                                 write_picture(j, ".normal.pfm", j->labels->normal, 3, r) &&
                                 write_object(j, exposure_ev, r) &&
            write_pose(j, r));
}
