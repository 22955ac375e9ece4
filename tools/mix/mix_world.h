/* mix_world.h: voxels shared by a sequence: frames trace the voxels of an earlier one until enough of the view is
 * new. */
#ifndef MIX_WORLD_H
#define MIX_WORLD_H

#include "mix_frames.h"
#include "mix_turn.h"

enum { MIX_SEEN = 64 /* cells per side of a world's occupancy grid */ };

/* mix_trace: a trace through the world without or with the object, with j's own scratch. mix_tile_there: transforms a
 * tile to voxel space, into `*room`; returns `in` if the spaces are equal. mix_point_there: the same for a point of the
 * scene. */
lmb_cone_trace mix_trace(const mix_job *j, int32_t world);
const lmb_tile *mix_tile_there(lmb_tile *room, const mix_job *j, const lmb_tile *in);
lmb_vec3 mix_point_there(const mix_job *j, lmb_vec3 p);

/* mix_cells: appends cells of the last world that are outside this frame's view: out of the picture, or hidden. Visible
 * cells, and cells that the frame sees through, are replaced. Returns 1, or 0 with `r` set. */
int mix_cells(mix_job *j, report *r);

/* mix_world_stays: returns 1 if the last world is still valid, and uses it from now on. mix_world_begins: makes this
 * frame's voxels the world. */
int mix_world_stays(mix_job *j);
int mix_world_begins(mix_job *j, report *r);

#endif
