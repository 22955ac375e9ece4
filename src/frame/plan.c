/* plan.c: plans a started frame: operations, work, bytes; skipped stages, and the reasons. Layer 8. */
#include <lambent/plan.h>

#include <string.h>

#include "../base/vec.h"
#include "solver.h"
#include "stages.h"
#include "requires.h"
#include "plan_model.h"

#if LMB_PLAN

typedef struct planner {
    lmb_plan *out;
    const lmb_render *r;
    double pairs, segments; /* of the gathers of all tiles; 0: unknown */
    double pixels, tiles; /* of the frame, in whole tiles */
} planner;

static void leave_out(planner *p, int stage, lmb_why why)
{
    lmb_plan_row *row = &p->out->row[stage];
    row->why = (int32_t)why;
    row->proof = why == LMB_WHY_DIM ? LMB_PROOF_BOUND : LMB_PROOF_EXACT;
    row->bound = why == LMB_WHY_DIM ? p->r->dimmed : 0.0f;
}

static uint64_t surface_bytes(const lmb_surface *s)
{
    return s->data == NULL ? 0 : (uint64_t)lmb_surface_bytes(s->format, s->width, s->height);
}

/* --- lights ------------------------------------------------------------------------------------------------------- */

static int why_light(const lmb_render *r, uint32_t i)
{
    return light_is(r, i, LMB_LIGHT_DARK)         ? LMB_WHY_NO_LIGHT
           : r->maps[i].drawn == 0                ? LMB_WHY_PAST
           : light_is(r, i, LMB_SHADOW_MAP_REUSED) ? LMB_WHY_REUSED
           : light_is(r, i, LMB_LIGHT_DIM)        ? LMB_WHY_DIM
                                                  : LMB_WHY_RUNS;
}

static void plan_maps(planner *p)
{
    const lmb_render *r = p->r;
    lmb_plan_row *row = &p->out->row[LMB_PLAN_MAPS];
    const double texels = (double)r->frame.shadow_map * (double)r->frame.shadow_map;
    uint32_t kept = 0;
    for (uint32_t i = 0; i < r->frame.scene->light_count; ++i) {
        uint32_t drawn = (uint32_t)count_bits_64(r->maps[i].drawn);
        p->out->light[i] = (uint8_t)why_light(r, i);
        p->out->faces += (uint32_t)r->maps[i].faces;
        if (light_is(r, i, LMB_SHADOW_MAP_REUSED)) {
            ++kept;
            continue;
        }
        p->out->faces_drawn += drawn;
        row->op[LMB_OP_TRIANGLES] += (double)drawn * (double)r->triangles;
        row->op[LMB_OP_TEXELS] += (double)r->maps[i].faces * texels;
    }
    row->bytes = r->frame.map_bytes;
    if (p->out->faces_drawn == 0) {
        leave_out(p, LMB_PLAN_MAPS, kept > 0 ? LMB_WHY_REUSED : LMB_WHY_NO_LIGHT);
    }
}

/* --- bounced light ------------------------------------------------------------------------------------------------ */

/* The reason why nothing bounces, or LMB_WHY_RUNS. */
static lmb_why why_no_bounce(const lmb_render *r)
{
    const lmb_frame *f = &r->frame;
    if (f->show == LMB_SHOW_DIRECT) {
        return LMB_WHY_NOT_SHOWN;
    }
    if (!requires_bounce(f)) {
        return LMB_WHY_NOT_ASKED;
    }
    if (!skips(r, LMB_SKIP_BOUNCE)) {
        return LMB_WHY_RUNS;
    }
    uint32_t seen = 0, bounce = 0;
    for (uint32_t i = 0; i < f->scene->light_count; ++i) {
        seen |= r->maps[i].drawn;
        bounce += faces_that_bounce(r, i);
    }
    return r->triangles == 0 ? LMB_WHY_EMPTY : seen == 0 ? LMB_WHY_NO_LIGHT : bounce == 0 ? LMB_WHY_DIM : LMB_WHY_BLACK;
}

static void plan_bvh(planner *p)
{
    const lmb_frame *f = &p->r->frame;
    lmb_plan_row *row = &p->out->row[LMB_PLAN_BVH];
    row->bytes = f->bvh.triangle_cap > 0 ? (uint64_t)lmb_bvh_bytes(f->bvh.triangle_cap) : 0;
#if LMB_LIVE
    if (f->bvh.small != NULL) {
        row->bytes = (uint64_t)lmb_bvh_small_bytes(f->bvh.triangle_cap);
    }
#endif
    if (!requires_bvh(f)) {
        leave_out(p, LMB_PLAN_BVH, f->show == LMB_SHOW_DIRECT ? LMB_WHY_NOT_SHOWN : LMB_WHY_NOT_ASKED);
        return;
    }
    row->op[LMB_OP_BVH] = (requires_full_bvh(f) ? 1.0 : 0.07) * (double)p->r->triangles;
    if (reuses(p->r, LMB_REUSE_BVH)) {
        row->op[LMB_OP_BVH] = 0.0;
        leave_out(p, LMB_PLAN_BVH, LMB_WHY_REUSED);
    }
}

/* Faces with first points that must be collected in this frame. */
static double fresh_faces(const lmb_render *r)
{
    uint32_t n = 0;
    for (uint32_t i = 0; i < r->frame.scene->light_count; ++i) {
        n += light_is(r, i, LMB_LIGHT_TEXELS_REUSED) ? 0 : faces_that_bounce(r, i);
    }
    return (double)n;
}

/* Memory of live light: the tree of single points, and the sky. */
static uint64_t live_memory(const lmb_frame *f)
{
    uint64_t bytes = 0;
#if LMB_LIVE
    if (f->gather_step == LMB_GATHER_LIVE && f->live != NULL) {
        const uint32_t lit = lmb_frame_map_faces(f->scene), faces = lit > 0 ? lit : 1;
        bytes += (uint64_t)lmb_live_bytes(faces, lmb_live_side(faces, f->shadow_map), f->elements.cap) +
                 sizeof *f->live;
        if (f->live_sky != NULL) {
            bytes += (uint64_t)lmb_live_sky_bytes(f->live_sky->sun_cap) + sizeof *f->live_sky;
        }
    }
#endif
    (void)f;
    return bytes;
}

/* Memory of the first points, for any solver. */
static uint64_t points_memory(const lmb_frame *f)
{
    uint64_t bytes = 0;
#if LMB_TRANSFER
    if (f->transfer != NULL) {
        bytes += (uint64_t)lmb_transfer_light_bytes(f->transfer);
        bytes += f->transfer_light.place == NULL
                     ? 0
                     : (uint64_t)sizeof(lmb_transfer_place) * f->transfer->count[LMB_TRANSFER_AREAS];
    }
#endif
    if (requires_cut(f)) {
        bytes += (uint64_t)lmb_tree_bytes(f->tree.face_cap, f->tree.size);
    } else if (f->points.data != NULL) {
        bytes += (uint64_t)f->points.cap * sizeof(lmb_point) + sizeof(lmb_groups) +
                 (uint64_t)f->points.cell_cap * sizeof(uint32_t);
    }
    return bytes + live_memory(f);
}

static void plan_points(planner *p, lmb_why none)
{
    const lmb_frame *f = &p->r->frame;
    lmb_plan_row *row = &p->out->row[LMB_PLAN_POINTS];
    const double side = (double)f->shadow_map, block = f->grouping.block != 0 ? (double)f->grouping.block : LMB_TILE;
    row->bytes = points_memory(f);
    if (none != LMB_WHY_RUNS) {
        leave_out(p, LMB_PLAN_POINTS, none);
        return;
    }
    const double faces = reuses(p->r, LMB_REUSE_POINTS) ? 0.0 : fresh_faces(p->r);
    const double points = requires_cut(f) ? (double)f->tree.size * (double)f->tree.size : side * side / (block * block);
    row->op[LMB_OP_RESOLVED] = faces * side * side;
    row->op[LMB_OP_SUMMED] = faces * points;
    if (faces == 0.0) {
        leave_out(p, LMB_PLAN_POINTS, LMB_WHY_REUSED);
    }
}

/* Assumes that the memory of elements is full. */
static void plan_bounces(planner *p, lmb_why none)
{
    const lmb_render *r = p->r;
    const lmb_frame *f = &r->frame;
    lmb_plan_row *row = &p->out->row[LMB_PLAN_BOUNCES];
    row->bytes = f->elements.cap > 0 ? (uint64_t)lmb_elements_bytes(f->elements.cap) : 0;
    if (none != LMB_WHY_RUNS || !requires_elements(r)) {
        leave_out(p, LMB_PLAN_BOUNCES, none != LMB_WHY_RUNS ? none : LMB_WHY_NOT_ASKED);
        return;
    }
    if (reuses(r, LMB_REUSE_BOUNCES)) {
        leave_out(p, LMB_PLAN_BOUNCES, LMB_WHY_REUSED);
        return;
    }
    row->op[LMB_OP_ELEMENTS] = (double)r->triangles;
    row->op[LMB_OP_CUTS] = (double)f->elements.cap / LMB_TILE_PIXELS * (double)radiosity_bounces(r);
}

/* One thread's scratch. */
static uint64_t scratch_memory(const lmb_frame *f)
{
    uint64_t bytes = sizeof(lmb_band_scratch);
    if (f->scratch == NULL) {
        return bytes;
    }
    if (f->scratch->multisample != NULL) {
        const lmb_target *eye = &f->scratch->multisample->eye;
        bytes += sizeof(lmb_multisample) + surface_bytes(&eye->depth) + surface_bytes(&eye->id);
    }
    return bytes + (f->scratch->live != NULL ? sizeof(lmb_live_scratch) : 0);
}

/* Light between gathered pixels. */
static uint64_t lattice_memory(const lmb_frame *f)
{
    return f->gather_step == LMB_GATHER_LIVE && f->show != LMB_SHOW_DIRECT
               ? (uint64_t)lmb_lattice_bytes(f->view.frame_width, f->view.frame_height)
               : 0;
}

/* The tiles' gathers, and their BVH traversals. */
static void plan_gather(planner *p, lmb_why none)
{
    const lmb_frame *f = &p->r->frame;
    lmb_plan_row *row = &p->out->row[LMB_PLAN_GATHER], *traversal = &p->out->row[LMB_PLAN_OCCLUSION];
    lmb_hull hull;
    row->bytes = scratch_memory(f) + lattice_memory(f);
    if (none != LMB_WHY_RUNS) {
        leave_out(p, LMB_PLAN_GATHER, none);
        leave_out(p, LMB_PLAN_OCCLUSION, none);
        return;
    }
    row->op[LMB_OP_CUTS] =
        p->tiles / (requires_samples(p->r) ? LMB_TILE_PIXELS : 1.0) * (requires_elements(p->r) ? 2.0 : 1.0);
    if (requires_cut(f)) {
        row->op[LMB_OP_PAIRS] = p->pairs;
        traversal->op[LMB_OP_SEGMENTS] = p->segments;
    }
    if (f->occlusion == LMB_OCCLUSION_NONE) {
        leave_out(p, LMB_PLAN_OCCLUSION, LMB_WHY_NOT_ASKED);
    } else if (f->occlusion == LMB_OCCLUSION_EXACT && !f->run_all) {
        lmb_hull_find(&hull, f->scene);
        if (hull.count > 0) {
            traversal->op[LMB_OP_SEGMENTS] = 0.0;
            leave_out(p, LMB_PLAN_OCCLUSION, LMB_WHY_CONVEX);
        }
    }
}

/* --- the picture -------------------------------------------------------------------------------------------------- */

static void plan_view(planner *p)
{
    const lmb_render *r = p->r;
    const lmb_frame *f = &r->frame;
    lmb_plan_row *row = &p->out->row[LMB_PLAN_VIEW];
    const int whole = is_whole(&f->eye.depth, &f->view);
    row->bytes = surface_bytes(&f->eye.depth) + surface_bytes(&f->eye.id) + surface_bytes(&f->eye_depth);
    if (reuses(r, LMB_REUSE_VIEW) || r->triangles == 0) {
        leave_out(p, LMB_PLAN_VIEW, r->triangles == 0 ? LMB_WHY_EMPTY : LMB_WHY_REUSED);
        return;
    }
    row->op[LMB_OP_TRIANGLES] = (double)r->triangles * (whole ? 1.0 : (double)band_count(&f->view));
    row->op[LMB_OP_TEXELS] = p->pixels;
}

static void plan_direct(planner *p)
{
    const lmb_render *r = p->r;
    const lmb_frame *f = &r->frame;
    double lights = 0.0;
    for (uint32_t i = 0; i < f->scene->light_count; ++i) {
        lights += light_is(r, i, LMB_LIGHT_DARK) ? 0.0 : 1.0;
    }
    if (!requires_direct(f)) {
        leave_out(p, LMB_PLAN_DIRECT, LMB_WHY_NOT_SHOWN);
    } else if (lights == 0.0 && !requires_many_lights(f)) {
        leave_out(p, LMB_PLAN_DIRECT, LMB_WHY_NO_LIGHT);
    } else {
        p->out->row[LMB_PLAN_DIRECT].op[LMB_OP_LIGHTING] = p->pixels * lights;
    }
}

static void plan_lookups(planner *p)
{
    const lmb_render *r = p->r;
    const lmb_frame *f = &r->frame;
    if (!requires_glossy(r)) {
        leave_out(p, LMB_PLAN_LOBES, r->is_glossy ? LMB_WHY_NOT_SHOWN : LMB_WHY_NO_LOBE);
    } else {
        p->out->row[LMB_PLAN_LOBES].op[LMB_OP_LOBES] = p->pixels;
    }
    if (!r->emits || !requires_direct(f)) {
        leave_out(p, LMB_PLAN_EMISSION, r->emits ? LMB_WHY_NOT_SHOWN : LMB_WHY_NO_EMISSION);
    } else {
        p->out->row[LMB_PLAN_EMISSION].op[LMB_OP_STORED] = p->pixels;
    }
}

/* --- the whole ---------------------------------------------------------------------------------------------------- */

double lmb_plan_units(int32_t op) { return op >= 0 && op < LMB_OPS ? (double)lmb_model.units[op] : 0.0; }

static void sum_up(lmb_plan *out)
{
    for (int s = 0; s < LMB_PLAN_STAGES; ++s) {
        lmb_plan_row *row = &out->row[s];
        for (int i = 0; i < LMB_OPS; ++i) {
            row->work += row->op[i] * (double)lmb_model.units[i];
        }
        out->work += row->work;
        out->bytes += row->bytes;
    }
}

lmb_status lmb_plan_frame(lmb_plan *out, const lmb_render *begun, double pairs, double segments)
{
    if (out == NULL || begun == NULL || begun->frame.scene == NULL || begun->failed != LMB_OK ||
        begun->stage != LMB_STAGE_SHADOW_MAP || begun->light != 0 || begun->progress != 0) {
        return LMB_ERR_ARG;
    }
    const lmb_frame *f = &begun->frame;
    planner p = {out, begun, pairs, segments, 0.0, 0.0};
    p.tiles = (double)((f->view.frame_width + LMB_TILE - 1) / LMB_TILE) * (double)band_count(&f->view);
    p.pixels = p.tiles * LMB_TILE_PIXELS;
    memset(out, 0, sizeof *out);
    const lmb_why none = why_no_bounce(begun);
    plan_maps(&p);
    plan_bvh(&p);
    plan_points(&p, none);
    plan_bounces(&p, none);
    plan_view(&p);
    out->row[LMB_PLAN_RESOLVE].op[LMB_OP_RESOLVED] =
        p.pixels * (requires_samples(begun) ? 2.0 : 1.0);
    plan_direct(&p);
    plan_gather(&p, none);
    plan_lookups(&p);
    out->row[LMB_PLAN_STORE].op[LMB_OP_STORED] = p.pixels;
    out->row[LMB_PLAN_STORE].bytes = surface_bytes(&f->out);
    sum_up(out);
    return LMB_OK;
}

#endif
