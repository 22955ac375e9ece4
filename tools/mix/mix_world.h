/* mix_world.h: one world of voxels over a sequence: frames trace what an earlier one has built, until enough of what they
 * see is new. */
#ifndef MIX_WORLD_H
#define MIX_WORLD_H

#include "mix_frames.h"
#include "mix_turn.h"

enum { MIX_SEEN = 64 /* cells a side of a world's cube, that say where it has surfaces */ };

/* mix_trace: through the world without or with the object, by j's own scratch. mix_tile_there: `in`, or `*room` with it as
 * it lies in the voxels' space; mix_point_there a point of the scene. */
lmb_cone_trace mix_trace(const mix_job *j, int32_t world);
const lmb_tile *mix_tile_there(lmb_tile *room, const mix_job *j, const lmb_tile *in);
lmb_vec3 mix_point_there(const mix_job *j, lmb_vec3 p);

/* mix_cells: behind the frame's own cells those of the last world that this frame does not see: out of its picture, or
 * behind what it sees. What it sees, and what it sees through, is replaced. 1, or 0 with `r` set. */
int mix_cells(mix_job *j, report *r);

/* mix_world_stays: the last world holds for this frame; from now on that is traced. mix_world_begins: this frame has built
 * its own. */
int mix_world_stays(mix_job *j);
int mix_world_begins(mix_job *j, report *r);

#endif
