/* scene_photo.h: uses the path-traced picture of a generated scene as the photo of a job of `lambent mix`. */
#ifndef SCENE_PHOTO_H
#define SCENE_PHOTO_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../tools/mix/mix_job.h"
#include "../truth/path.h"

/* scene_pose: the transform from the scene's camera to its world, in the convention of --frame. */
static inline void scene_pose(double pose[16], const made_scene *s)
{
    const svec f = unit(less(s->target, s->eye)), right = unit(cross_of(f, s->up)), down = cross_of(f, right);
    const svec columns[4] = {right, down, f, s->eye};
    memset(pose, 0, 16 * sizeof *pose);
    for (int c = 0; c < 4; ++c) {
        pose[c] = columns[c].x;
        pose[4 + c] = columns[c].y;
        pose[8 + c] = columns[c].z;
    }
    pose[15] = 1.0;
}

/* scene_photo: sets a photo of `side` x `side` pixels: light, depth along the axis in metres, camera and pose.
 * Returns 1, or 0 with `r` set. */
static inline int scene_photo(mix_job *j, const made_scene *s, int side, const float *rgb, const float *depth, report *r)
{
    const size_t pixels = (size_t)side * (size_t)side;
    const float focal = (float)(0.5 * side / tan(0.5 * s->fov_deg * 3.14159265358979 / 180.0)), middle = 0.5f * (float)(side - 1);
    const lmb_pinhole camera = {side, side, focal, focal, middle, middle};
    j->frame.camera = camera;
    j->frame.has_pose = 1;
    scene_pose(j->frame.pose, s);
    j->frame.light.width = j->frame.light.height = side;
    j->frame.light.channels = 3;
    j->frame.light.pixels = malloc(3 * pixels * sizeof *rgb);
    j->frame.depth = malloc(pixels * sizeof *depth);
    if (j->frame.light.pixels == NULL || j->frame.depth == NULL) {
        return report_fail(r, "out of memory");
    }
    memcpy(j->frame.light.pixels, rgb, 3 * pixels * sizeof *rgb);
    memcpy(j->frame.depth, depth, pixels * sizeof *depth);
    return 1;
}

/* scene_keep: reads a cached result from a file or writes it. Returns 1, or 0 if the file is missing or incomplete. */
static inline int scene_keep(const char *path, void *p, size_t bytes, int is_read)
{
    FILE *f = fopen(path, is_read ? "rb" : "wb");
    const size_t n = f == NULL ? 0 : is_read ? fread(p, bytes, 1, f) : fwrite(p, bytes, 1, f);
    return f != NULL && fclose(f) == 0 && n == 1;
}

#endif
