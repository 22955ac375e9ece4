/* stages.h: functions shared by the files of src/frame. Layer 8. */
#ifndef LMB_FRAME_STAGES_H
#define LMB_FRAME_STAGES_H

#include <lambent/render.h>

#include "../base/exact.h"

/* Replaces a call that a build lacks and never makes. */
#define never(call) ((void)sizeof(call), LMB_ERR_ARG)

/* A build without trees refuses frames that need them (lmb_render_check), so none of these is ever called. */
#if !LMB_TREES
#undef lmb_glossy_tile
#undef lmb_many_lights_direct_tile
#undef lmb_bvh_build
#define lmb_glossy_tile(...)             (never(LMB_LAYOUT(lmb_glossy_tile)(__VA_ARGS__)) == LMB_OK)
#define lmb_many_lights_direct_tile(...) never(LMB_LAYOUT(lmb_many_lights_direct_tile)(__VA_ARGS__))
#define lmb_bvh_build(...)               never(LMB_LAYOUT(lmb_bvh_build)(__VA_ARGS__))
#define lmb_compose_glossy(...)          never(lmb_compose_glossy(__VA_ARGS__))
#endif

#define UNIT_TRIANGLES 1024u /* of a draw, in one unit of a step */

static inline int32_t band_count(const lmb_view *v) { return (v->frame_height + LMB_TILE - 1) / LMB_TILE; }

/* --- checks ------------------------------------------------------------------------------------------------------- */

lmb_status lmb_render_check(const lmb_frame *frame);

/* lmb_render_defaults: replaces the numbers that are 0 by their defaults. */
void lmb_render_defaults(lmb_frame *frame);

/* lmb_render_check_out: checks the picture's surface, which you may set to the whole frame or to one band. */
lmb_status lmb_render_check_out(const lmb_surface *out, const lmb_view *view);

/* --- skipping ---------------------------------------------------------------------------------------------------- */

/* lmb_render_skip: at the start of a frame, sets r->skips, light_state and the revisions. Clears the faces in
 * r->maps.drawn that the scene's box does not meet, and is_glossy and emits if no drawn material is. */
void lmb_render_skip(lmb_render *r);

/* --- stages ------------------------------------------------------------------------------------------------------- */

/* A step runs up to `units` of the current stage and advances r->light, face and progress. It returns LMB_MORE, LMB_OK
 * if the stage is complete, or an error. A part is a part of the current stage, as in lmb_render_part. */

/* LMB_STAGE_SHADOW_MAP .. LMB_STAGE_BOUNCES. */
lmb_status lmb_render_solve(lmb_render *r, int32_t units);
lmb_status lmb_render_solve_part(const lmb_render *r, lmb_band_scratch *scratch, int32_t part, int32_t parts,
                                 lmb_stats *stats);

/* Can the current face or bounce be split into parts? */
int lmb_render_solve_has_parts(const lmb_render *r);

/* Call this after all parts of the current face or bounce. Returns LMB_MORE if the stage has another one. */
lmb_status lmb_render_solve_on(lmb_render *r, int32_t parts);

/* The share of LMB_STAGE_BOUNCES that is done, 0 .. 1. */
float lmb_render_solve_done(const lmb_render *r);

/* LMB_STAGE_VIEW. */
lmb_status lmb_render_view(lmb_render *r, int32_t units);
lmb_status lmb_render_view_part(const lmb_render *r, int32_t part, int32_t parts, lmb_stats *stats);

/* LMB_STAGE_SAMPLES. lmb_render_samples_on: advances to the next phase. */
lmb_status lmb_render_samples(lmb_render *r, int32_t units);
lmb_status lmb_render_samples_part(const lmb_render *r, lmb_band_scratch *scratch, int32_t part, int32_t parts,
                                   lmb_stats *stats);
lmb_status lmb_render_samples_on(lmb_render *r);

/* lmb_render_live_tile: after all phases, sets the light of the tile's pixels with a surface. */
lmb_status lmb_render_live_tile(lmb_irradiance *out, const lmb_render *r, lmb_band_scratch *scratch);
#if !LMB_LIVE
#define lmb_lattice_bytes(...)        ((void)sizeof(lmb_lattice_bytes(__VA_ARGS__)), (size_t)0)
#define lmb_lattice_init(...)         never(lmb_lattice_init(__VA_ARGS__))
#define lmb_render_live_tile(...)     never(lmb_render_live_tile(__VA_ARGS__))
#define lmb_render_samples(...)       never(lmb_render_samples(__VA_ARGS__))
#define lmb_render_samples_part(...)  never(lmb_render_samples_part(__VA_ARGS__))
#define lmb_render_samples_on(...)    never(lmb_render_samples_on(__VA_ARGS__))
#endif

/* LMB_STAGE_BANDS. */
lmb_status lmb_render_bands(lmb_render *r, int32_t units);

/* --- parts of a band ---------------------------------------------------------------------------------------------- */

/* Finds the depth and ids of a band: in the whole frame's eye, or drawn now into the first rows of a smaller one.
 * lmb_render_view_strip: the same for frame.eye if you take the bands in order; the first band of a strip draws the
 * strip. */
lmb_status lmb_render_view_band(const lmb_render *r, lmb_target *out, const lmb_target *eye, int32_t band);
lmb_status lmb_render_view_strip(const lmb_render *r, lmb_target *out, int32_t band);

/* lmb_render_direct: sets scratch->direct to the direct light of the tile, which you resolved for `view`, or to 0 if
 * the picture does not show it. Adds the light that lobes reflect, unless `glossy` is NULL. Overwrites
 * scratch->indirect. */
lmb_status lmb_render_direct(const lmb_render *r, lmb_glossy *glossy, lmb_band_scratch *scratch, const lmb_tile *tile,
                             const lmb_view *view);

/* lmb_render_radiance: sets scratch->radiance to the light from the tile's pixels to the viewer: scratch->direct,
 * `indirect`, lobes (NULL: none) and emission. */
lmb_status lmb_render_radiance(const lmb_render *r, const lmb_glossy *glossy, lmb_band_scratch *scratch,
                               const lmb_tile *tile, const lmb_view *view, const lmb_irradiance *indirect);

/* --- several samples a pixel -------------------------------------------------------------------------------------- */

/* Do frame and scratch have the memory that frame.samples needs? LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_multisample_check(const lmb_frame *f, const lmb_band_scratch *scratch);

/* Draws depth and ids of a band for each sample. */
lmb_status lmb_multisample_draw(const lmb_render *r, lmb_band_scratch *scratch, int32_t band);

/* lmb_multisample_light: sets scratch->radiance of scratch->tile's pixels to the mean of their samples, each clamped to
 * `white`.
 *
 *   middle  bounced light at the pixels' middles.
 *   lobes   bounced light that lobes reflect there, or NULL. You may pass scratch->glossy, which is overwritten. */
lmb_status lmb_multisample_light(const lmb_render *r, lmb_band_scratch *scratch, const lmb_irradiance *middle,
                                 const lmb_glossy *lobes, int32_t band, float white);
#if !LMB_MULTISAMPLE
#define lmb_multisample_check(f, s) \
    ((void)sizeof(lmb_multisample_check(f, s)), (f)->samples == 1 ? LMB_OK : LMB_ERR_ARG)
#define lmb_multisample_draw(...)  never(lmb_multisample_draw(__VA_ARGS__))
#define lmb_multisample_light(...) never(lmb_multisample_light(__VA_ARGS__))
#endif

/* lmb_render_gather: adds the bounced light of a tile's pixels, and the part that lobes reflect, unless `glossy` is
 * NULL. direct: light shown together with it, so that error limits apply to the sum; or NULL. Returns LMB_OK or the
 * gather's error. */
lmb_status lmb_render_gather(lmb_irradiance *inout, lmb_glossy *glossy, const lmb_render *r, lmb_band_scratch *scratch,
                             const lmb_tile *tile, const lmb_irradiance *direct);

/* lmb_render_onto_triangles: if cuts light the frame, moves a tile's pixels onto the triangles that they show. Shadow
 * tests start at the pixels, and a pixel past a fold lies on the other side of the fold. Direct light uses the resolved
 * positions. */
void lmb_render_onto_triangles(lmb_tile *inout, const lmb_frame *f);

/* lmb_render_live: sets the light of a receiver. Call this only if requires_live. */
lmb_status lmb_render_live(float light[3], const lmb_render *r, lmb_band_scratch *scratch, const lmb_live_receiver *at);
#if !LMB_LIVE
#define lmb_render_live(...) never(lmb_render_live(__VA_ARGS__))
#endif

#endif
