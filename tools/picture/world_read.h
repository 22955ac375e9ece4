/* world_read.h: image files -> the cube and ground of a world, as linear floats. [S1 S2] */
#ifndef WORLD_READ_H
#define WORLD_READ_H

#include <lambent/probe.h>

#include "../common/report.h"

/* The pictures in memory. Zero it before use; world_pictures_free releases them. */
typedef struct world_pictures {
    float *face[6], *alpha[6], *ground;
    size_t not_finite; /* numbers that were read as 0 */
} world_pictures;

/* world_read_cube: from one file, recognized by the aspect ratio: six faces stacked top to bottom or side by side, or
 * the whole sphere (twice as wide as high: longitude from -180 degrees, north on top), which becomes a cube with faces
 * of a quarter of the width. Or from six files: `path` with px nx py ny pz nz and .pfm, .hdr, .png or .jpg appended;
 * some may be missing. Transparent pixels are blank.
 *
 *   own  takes the memory that `out` points into
 *
 * Returns 1, or 0 with `r` set. */
int world_read_cube(lmb_world_pictures *out, world_pictures *own, const char *path, report *r);

/* world_is_there: whether there is a file `path`, or one of six. */
int world_is_there(const char *path);

/* world_hash: adds the contents of the world's file, or of its six files, to the hash of a slice's job. Returns 1, or 0
 * with `r` set. */
int world_hash(uint64_t *hash, const char *path, report *r);

/* world_check: reads a world before the work begins, and protects a single file from being overwritten. Sets
 * *face_size, in pixels. Returns 1, or 0 with `r` set. */
int world_check(const char *path, int32_t *face_size, report *r);

/* world_read_ground: an image from above, rows towards +z; transparent pixels are blank. Sets the ground members of
 * `out`. */
int world_read_ground(lmb_world_pictures *out, world_pictures *own, const char *path, report *r);

/* world_tell_not_finite: prints a note if an image of `path`, read since the last note, had numbers that are not
 * finite. */
void world_tell_not_finite(world_pictures *inout, const char *path, int is_quiet);

void world_pictures_free(world_pictures *own);

#endif
