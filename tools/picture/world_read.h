/* world_read.h: picture files -> a world's cube and ground, as linear floats.                              [S1 S2] */
#ifndef WORLD_READ_H
#define WORLD_READ_H

#include <lambent/probe.h>

#include "../common/report.h"

/* The pictures in memory. Zero it before use; world_pictures_free releases them. */
typedef struct world_pictures {
    float *face[6], *alpha[6], *ground;
    size_t not_finite; /* numbers that were read as 0 */
} world_pictures;

/* world_read_cube: from one file, known by its shape: six faces stacked top to bottom or side by side, or the whole
 * sphere (twice as wide as high: longitude from -180 degrees, north on top), which becomes a cube with faces of a
 * quarter of its width. Or from six: `path` with px nx py ny pz nz and .pfm, .hdr, .png or .jpg behind it, of which
 * some may be missing. Transparent pixels are blank.
 *
 *   own  takes the memory that `out` points into
 * 1, or 0 with `r` set. */
int world_read_cube(lmb_world_pictures *out, world_pictures *own, const char *path, report *r);

/* world_read_ground: a picture from above, rows towards +z; transparent pixels are blank. Sets the picture's own. */
int world_read_ground(lmb_world_pictures *out, world_pictures *own, const char *path, report *r);

/* world_tell_not_finite: a note where a picture of `path`, read since the last one, had numbers that are none. */
void world_tell_not_finite(world_pictures *inout, const char *path, int is_quiet);

void world_pictures_free(world_pictures *own);

#endif
