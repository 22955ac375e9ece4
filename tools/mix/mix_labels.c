/* mix_labels.c: per-pixel labels of the object, written as files beside the picture. */
#include "mix_labels.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../picture/picture.h"
#include "mix_turn.h"

enum { PATH_CAP = 4096 };

static float dot(lmb_vec3 a, lmb_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

int mix_labels_take(mix_job *j, report *r)
{
    const size_t pixels = (size_t)j->frame.light.width * (size_t)j->frame.light.height;
    if (j->o.labels == NULL) {
        return 1;
    }
    struct mix_labels *l = j->labels = mix_take(j, sizeof *l, r);
    return l != NULL && (l->covered = mix_take(j, pixels * sizeof *l->covered, r)) != NULL &&
           (l->depth = mix_take(j, pixels * sizeof *l->depth, r)) != NULL &&
           (l->normal = mix_take(j, 3 * pixels * sizeof *l->normal, r)) != NULL;
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
            l->normal[3 * at] = dot(j->axes.right, n);
            l->normal[3 * at + 1] = dot(j->axes.up, n);
            l->normal[3 * at + 2] = dot(j->axes.back, n);
        }
    }
}

void mix_labels_cover(const mix_job *j, const lmb_tile *real, const float covered[LMB_TILE_PIXELS])
{
    for (int32_t k = 0; k < LMB_TILE_PIXELS && j->labels != NULL; ++k) {
        const ptrdiff_t at = pixel_of(j, real, k);
        if (at >= 0) {
            j->labels->covered[at] = covered[k];
        }
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

/* White if the object covers half of the pixel. */
static int write_mask(const mix_job *j, report *r)
{
    const size_t pixels = (size_t)j->frame.light.width * (size_t)j->frame.light.height;
    float *mask = malloc(3 * pixels * sizeof *mask);
    if (mask == NULL) {
        return report_fail(r, "out of memory");
    }
    for (size_t i = 0; i < 3 * pixels; ++i) {
        mask[i] = j->labels->covered[i / 3] >= 0.5f ? 1.0f : 0.0f;
    }
    const int ok = write_picture(j, ".mask.png", mask, 3, r);
    free(mask);
    return ok;
}

static size_t put_rows(char *out, size_t size, const char *name, const double m[3][4])
{
    return (size_t)snprintf(
        out, size,
        "  \"%s\": [[%.9g, %.9g, %.9g, %.9g],\n    [%.9g, %.9g, %.9g, %.9g],\n    [%.9g, %.9g, %.9g, %.9g],\n"
        "    [0, 0, 0, 1]]",
        name, m[0][0], m[0][1], m[0][2], m[0][3], m[1][0], m[1][1], m[1][2], m[1][3], m[2][0], m[2][1], m[2][2],
        m[2][3]);
}

/* From mesh units to camera space as poses define it (x right, y down, z ahead), and to the world. */
static int write_pose(const mix_job *j, report *r)
{
    char path[PATH_CAP], text[2048];
    const lmb_vec3 axis[3] = {j->axes.right, j->axes.up, j->axes.back};
    double camera[3][4], world[3][4];
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 4; ++k) {
            const float *c = j->placed.m + 4 * k;
            camera[i][k] = (double)((i == 0 ? 1.0f : -1.0f) * (axis[i].x * c[0] + axis[i].y * c[1] + axis[i].z * c[2]));
        }
    }
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 4; ++k) {
            const double *p = j->frame.pose + 4 * i;
            world[i][k] = p[0] * camera[0][k] + p[1] * camera[1][k] + p[2] * camera[2][k] + (k == 3 ? p[3] : 0.0);
        }
    }
    size_t n = (size_t)snprintf(text, sizeof text, "{\n");
    n += put_rows(text + n, sizeof text - n, "object_to_camera", (const double(*)[4])camera);
    if (j->frame.has_pose) {
        n += (size_t)snprintf(text + n, sizeof text - n, ",\n");
        n += put_rows(text + n, sizeof text - n, "object_to_world", (const double(*)[4])world);
    }
    n += (size_t)snprintf(text + n, sizeof text - n, "\n}\n");
    return snprintf(path, sizeof path, "%s.pose.json", j->o.labels) < PATH_CAP
               ? file_write(path, text, n, r)
               : report_fail(r, "--labels: the name is too long");
}

int mix_labels_write(const mix_job *j, report *r)
{
    return j->labels == NULL || (write_mask(j, r) && write_picture(j, ".depth.pfm", j->labels->depth, 1, r) &&
                                 write_picture(j, ".normal.pfm", j->labels->normal, 3, r) && write_pose(j, r));
}
