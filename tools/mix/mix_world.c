/* mix_world.c: voxels shared by a sequence. */
#include "mix_world.h"

#include <math.h>
#include <string.h>

/* If more than one in NEW surface cells around the object is new, or gone, voxels are built again. */
enum { NEW = 20, CELL_FLOATS = 12, CELL_COLOURS = 16, CELL_INDICES = 6 };

/* Maximum distance from the voxels' cube, in cube sides: cells farther away cast no relevant shadow. */
#define FAR 1.0f

/* --- tracing ------------------------------------------------------------------------------------------------------ */

lmb_cone_trace mix_trace(const mix_job *j, int32_t world)
{
    const lmb_cone_trace trace = {j->o.kernels, &j->world->voxels, world, world, &j->world->env[world], j->scratch, 1};
    return trace;
}

static void turn_planes(float planes[3][LMB_TILE_PIXELS], const lmb_mat4 *t, int is_place)
{
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const lmb_vec3 v = {planes[0][k], planes[1][k], planes[2][k]}, to = is_place ? mix_move(t, v) : mix_turn(t, v);
        planes[0][k] = to.x;
        planes[1][k] = to.y;
        planes[2][k] = to.z;
    }
}

const lmb_tile *mix_tile_there(lmb_tile *room, const mix_job *j, const lmb_tile *in)
{
    if (j->world->voxels.child == j->voxels.child) {
        return in;
    }
    *room = *in;
    turn_planes(room->position, &j->to_voxels, 1);
    turn_planes(room->face, &j->to_voxels, 0);
    turn_planes(room->normal, &j->to_voxels, 0);
    return room;
}

lmb_vec3 mix_point_there(const mix_job *j, lmb_vec3 p)
{
    return j->world->voxels.child == j->voxels.child ? p : mix_move(&j->to_voxels, p);
}

/* --- cells -------------------------------------------------------------------------------------------------------- */

static lmb_vec3 corner(const float *at, int k) { return (lmb_vec3){at[3 * k], at[3 * k + 1], at[3 * k + 2]}; }

static lmb_vec3 middle(const float *at)
{
    const lmb_vec3 out = {0.25f * (at[0] + at[3] + at[6] + at[9]), 0.25f * (at[1] + at[4] + at[7] + at[10]),
                          0.25f * (at[2] + at[5] + at[8] + at[11])};
    return out;
}

static float along(lmb_vec3 a, lmb_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/* The state of a world's cell in a frame: not visible, present, or gone. */
enum { UNSEEN, THERE, GONE };

static int seen(const mix_job *j, lmb_vec3 p)
{
    const lmb_pinhole *c = &j->frame.camera;
    const float ahead = -along(j->axes.back, p), x = c->cx + c->fx * along(j->axes.right, p) / ahead + 0.5f,
                y = c->cy - c->fy * along(j->axes.up, p) / ahead + 0.5f;
    if (!(ahead > 0.01f) || !(x >= 0.0f) || !(y >= 0.0f) || !(x < (float)c->width) || !(y < (float)c->height)) {
        return UNSEEN;
    }
    const float q = j->cloud.inverse[(int32_t)y * c->width + (int32_t)x];
    if (!(q > 0.0f) || (q > 1.0f / ahead && !mix_agree(q, 1.0f / ahead))) {
        return UNSEEN;
    }
    return mix_agree(q, 1.0f / ahead) ? THERE : GONE;
}

/* Enlarges the arrays of a mesh for more cells. */
static int grow(lmb_real_mesh *m, mix_job *j, int32_t more, report *r)
{
    const size_t cells = (size_t)(m->count + more), own = (size_t)m->count;
    float *positions = mix_take(j, CELL_FLOATS * cells * sizeof *positions, r);
    uint32_t *indices = mix_take(j, CELL_INDICES * cells * sizeof *indices, r);
    uint8_t *colours = mix_take(j, CELL_COLOURS * cells, r);
    if (positions == NULL || indices == NULL || colours == NULL) {
        return 0;
    }
    memcpy(positions, m->positions, CELL_FLOATS * own * sizeof *positions);
    memcpy(indices, m->indices, CELL_INDICES * own * sizeof *indices);
    memcpy(colours, m->colours, CELL_COLOURS * own);
    m->positions = positions;
    m->indices = indices;
    m->colours = colours;
    return 1;
}

static void put_cell(mix_job *j, const lmb_vec3 at[4], const uint8_t *colours)
{
    static const uint32_t corners[CELL_INDICES] = {0, 1, 2, 0, 2, 3};
    const size_t cell = (size_t)j->real.count + (size_t)j->old_cells;
    for (size_t k = 0; k < 4; ++k) {
        j->real.positions[CELL_FLOATS * cell + 3 * k] = at[k].x;
        j->real.positions[CELL_FLOATS * cell + 3 * k + 1] = at[k].y;
        j->real.positions[CELL_FLOATS * cell + 3 * k + 2] = at[k].z;
    }
    for (size_t k = 0; k < CELL_INDICES; ++k) {
        j->real.indices[CELL_INDICES * cell + k] = (uint32_t)(4 * cell) + corners[k];
    }
    memcpy(j->real.colours + CELL_COLOURS * cell, colours, CELL_COLOURS);
    ++j->old_cells;
}

static int is_in_cube(const lmb_voxels *v, lmb_vec3 p, float beyond)
{
    const float side = v->leaf * (float)(1 << v->depth), low = -beyond * side, high = (1.0f + beyond) * side;
    const lmb_vec3 d = {p.x - v->low.x, p.y - v->low.y, p.z - v->low.z};
    return d.x > low && d.y > low && d.z > low && d.x < high && d.y < high && d.z < high;
}

/* A cell is present if a corner is, because the frame then has a cell there, and gone only if all of it is: the middle
 * of a cell across a depth edge lies in the air. */
static int cell_seen(const mix_job *j, const lmb_mat4 *here, const float *from)
{
    const int now = seen(j, mix_move(here, middle(from)));
    int gone = 0;
    for (int k = 0; k < 4; ++k) {
        const int of = seen(j, mix_move(here, corner(from, k)));
        if (of == THERE) {
            return THERE;
        }
        gone += of == GONE;
    }
    return now == GONE && gone < 4 ? UNSEEN : now;
}

int mix_cells(mix_job *j, report *r)
{
    const mix_job *w = j->kept != NULL ? j->kept->world : NULL;
    if (w == NULL) {
        return 1;
    }
    const lmb_mat4 back = mix_back(&w->from_world), here = mix_product(&j->from_world, &back);
    const int32_t count = w->real.count + w->old_cells;
    const int32_t cap = j->real.columns * j->real.rows * 2; /* of old cells */
    j->to_voxels = mix_back(&here);
    if (!grow(&j->real, j, count < cap ? count : cap, r)) {
        return 0;
    }
    for (int32_t i = 0; i < count && j->old_cells < cap; ++i) {
        const float *from = w->real.positions + CELL_FLOATS * (size_t)i;
        const lmb_vec3 p = middle(from);
        if (!is_in_cube(&w->voxels, p, FAR)) {
            continue;
        }
        const int now = cell_seen(j, &here, from);
        if (now == UNSEEN) {
            lmb_vec3 at[4];
            for (int k = 0; k < 4; ++k) {
                at[k] = mix_move(&here, corner(from, k));
            }
            put_cell(j, at, w->real.colours + CELL_COLOURS * (size_t)i);
        }
        j->gone += now == GONE && is_in_cube(&w->voxels, p, 0.0f);
    }
    return 1;
}

/* --- occupancy grid ----------------------------------------------------------------------------------------------- */

/* The grid cell that contains a point. */
static size_t place_of(const lmb_voxels *v, lmb_vec3 p, int x, int y, int z)
{
    const float per = (float)MIX_SEEN / (v->leaf * (float)(1 << v->depth));
    const int at[3] = {(int)((p.x - v->low.x) * per) + x, (int)((p.y - v->low.y) * per) + y,
                       (int)((p.z - v->low.z) * per) + z};
    size_t out = 0;
    for (int i = 0; i < 3; ++i) {
        const int clamped = at[i] < 0 ? 0 : at[i] > MIX_SEEN - 1 ? MIX_SEEN - 1 : at[i];
        out = out * MIX_SEEN + (size_t)clamped;
    }
    return out;
}

static int is_known(const mix_job *w, lmb_vec3 p)
{
    for (int i = 0; i < 27; ++i) {
        if (w->seen[place_of(&w->voxels, p, i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1)] != 0) {
            return 1;
        }
    }
    return 0;
}

static lmb_vec3 between(lmb_vec3 a, lmb_vec3 b, float t)
{
    const lmb_vec3 out = {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z)};
    return out;
}

static float distance(lmb_vec3 a, lmb_vec3 b)
{
    const lmb_vec3 d = {a.x - b.x, a.y - b.y, a.z - b.z};
    return sqrtf(along(d, d));
}

/* Marks a cell by points no farther apart than the grid's cells. */
static void mark_cell(mix_job *j, const float *at)
{
    const float side = j->voxels.leaf * (float)(1 << j->voxels.depth) / (float)MIX_SEEN;
    const float wide = fmaxf(distance(corner(at, 0), corner(at, 1)), distance(corner(at, 0), corner(at, 3)));
    const int n = (int)fminf(wide / side, (float)MIX_SEEN) + 1;
    for (int i = 0; i <= n; ++i) {
        for (int k = 0; k <= n; ++k) {
            const float s = (float)i / (float)n, t = (float)k / (float)n;
            const lmb_vec3 p =
                between(between(corner(at, 0), corner(at, 1), s), between(corner(at, 3), corner(at, 2), s), t);
            if (is_in_cube(&j->voxels, p, 0.0f)) {
                j->seen[place_of(&j->voxels, p, 0, 0, 0)] = 1;
            }
        }
    }
}

int mix_world_begins(mix_job *j, report *r)
{
    const int32_t count = j->real.count + j->old_cells;
    j->world = j;
    if (j->kept == NULL) {
        return 1;
    }
    j->seen = mix_take(j, MIX_SEEN * MIX_SEEN * MIX_SEEN, r);
    for (int32_t i = 0; j->seen != NULL && i < count; ++i) {
        mark_cell(j, j->real.positions + CELL_FLOATS * (size_t)i);
    }
    return j->seen != NULL;
}

int mix_world_stays(mix_job *j)
{
    mix_job *w = j->kept != NULL ? j->kept->world : NULL;
    int32_t all = 0, fresh = 0;
    if (w == NULL || j->kept->is_other_light) {
        return 0;
    }
    for (int32_t i = 0; i < j->real.count; ++i) {
        const lmb_vec3 p = mix_move(&j->to_voxels, middle(j->real.positions + CELL_FLOATS * (size_t)i));
        if (is_in_cube(&w->voxels, p, 0.0f)) {
            ++all;
            fresh += !is_known(w, p);
        }
    }
    report_note(!j->o.is_verbose, "of %d cells about the object %d are new, %d are gone", (int)all, (int)fresh,
                (int)j->gone);
    if (NEW * (fresh + j->gone) > all) {
        return 0;
    }
    j->world = w;
    return 1;
}
