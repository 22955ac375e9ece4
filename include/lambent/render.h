/* render.h: one call that draws a frame with bounced light, or one bounded step of it at a time. [V29 V30 V33 V34]
 *
 *     lmb_frame_init(&frame, &settings, memory, lmb_frame_bytes(&settings));   all its memory in one block; or by hand
 *     lmb_render r;                        0.8 KiB a light; holds no pointer into itself: copy it freely
 *     lmb_render_begin(&r, &frame);        checks everything, writes no pixel
 *     while (lmb_render_step(&r, 1000) == LMB_MORE) { ... }       or: lmb_render_frame(&r, &frame)
 *
 * Order [V34]: per light its map, first points, discs; groups; bounces after the first; the viewer's depth; then band
 * after band: attributes, direct light, gathered light, picture. Steps of any size, and bands in any
 * order, give the same bytes.
 *
 * What a frame keeps, and where [V33]; all of it is the caller's memory and plain structs:
 *   light distances     r.maps[light], from LMB_STAGE_POINTS on: lmb_gbuffer_band over view[f] and face[f] gives metres
 *   first points        lmb_points_collect, one light's face after another; once a frame's are joined:
 *   incident light      frame.points, from LMB_STAGE_GROUPS on: data[i].flux / data[i].albedo is what arrives, W
 *   groups              frame.groups, from LMB_STAGE_VIEW on; members of group k: points.data[first[k]] and on, each
 *                       with its place in the map of its face [V15]. frame.points.owner: the disc of each texel
 *   eye distances       frame.eye (or eye_depth), from LMB_STAGE_BANDS on: lmb_depth_view_z, or lmb_gbuffer_band
 *   received light      LMB_SHOW_IRRADIANCE as the picture; a tile at a time: lmb_direct_tile, lmb_gather_tile
 *
 * Glossy materials (lmb_material.specular; builds with trees) reflect the scene's lights, and bounced light by
 * LMB_GROUP_CUT or a transfer; fixed groups and direct light of `many_lights` reach their diffuse part alone. Tiles that show a lobe
 * are gathered at each pixel, whatever gather_step is. LMB_SHOW_IRRADIANCE has no lobes.
 *
 * Stability: stable. Tags like [V29] are requirements in src/SOURCES.md. */
#ifndef LMB_RENDER_H
#define LMB_RENDER_H

#include "bounce.h"
#include "compose.h"
#include "draw.h"
#include "elements.h"
#include "env.h"
#include "live.h"
#include "many_lights.h"
#include "transfer.h"
#include "tree.h"

/* What of the light to write. Linear formats get it as radiance (SHOW_IRRADIANCE: W/m2, before the albedo). */
enum { LMB_SHOW_FULL = 0, LMB_SHOW_DIRECT = 1, LMB_SHOW_INDIRECT = 2, LMB_SHOW_IRRADIANCE = 3 };

/* A gather_step: samples 8 px apart, and closer where light or surfaces ask for it; what lies between goes on by their
 * slopes. The picture is a function of scene, view and settings, whatever the order, threads and bands. */
enum { LMB_GATHER_ADAPTIVE = 8, LMB_GATHER_LIVE = 16 /* the same samples, by lmb_live: for light that moves */ };

/* Light gathered for some pixels of a block of tiles side by side. */
typedef struct lmb_sparse {
    lmb_tile together;                      /* the next pixels: their positions, faces, normals and ids */
    uint16_t pixel[LMB_TILE_PIXELS];        /* where they are in `light` */
    int32_t count;                          /* of them */
    lmb_irradiance light[LMB_SPARSE_TILES]; /* of the block's pixels */
} lmb_sparse;

/* Where frame.samples is over 1: what works on the samples of one band. 20 KiB, and the memory of `eye`. */
typedef struct lmb_multisample {
    lmb_target eye;    /* depth and ids: as wide as the frame, 8 rows a sample, one sample below the other */
    lmb_view view;     /* of one sample */
    lmb_target window; /* the sample's rows of `eye` */
    lmb_tile tile;     /* what the sample shows of a tile's pixels */
    lmb_irradiance middle, light;         /* bounced light: at the pixels' middles, and at the sample */
    int16_t middle_of[LMB_TILE_PIXELS];   /* the pixel whose middle shows the sample's surface, or -1 */
    uint64_t lobe_pixels;                 /* pixels whose middle shows a lobe */
    lmb_radiance lobes;                   /* what lobes make of bounced light at the middles */
    lmb_radiance sum;                     /* the samples so far */
    lmb_tile extra;                       /* surfaces that samples show and no pixel's middle does */
    lmb_irradiance extra_light;           /* bounced light of `extra` */
    uint8_t extra_pixel[LMB_TILE_PIXELS]; /* the pixel of each surface of `extra` */
    int32_t extras;                       /* surfaces in `extra` */
} lmb_multisample;

/* Everything that works on one band. Place it in fast RAM; one for each thread that draws bands. */
typedef struct lmb_band_scratch {
    union {
        lmb_gather_scratch groups;
        lmb_cut cut;
        lmb_transfer_scratch transfer;
    } gather;
    lmb_tile tile;
    lmb_irradiance direct, indirect;
    lmb_radiance radiance;
    lmb_stats counts; /* pairs and segments, added to by lmb_render_band: zero it yourself */
    lmb_many_lights_scratch many_lights;
    lmb_sparse sparse; /* where gather_step is over 1 */
    lmb_glossy glossy; /* where a material has a lobe */
    lmb_multisample *multisample; /* where frame.samples is over 1 */
    lmb_live_scratch *live; /* LMB_GATHER_LIVE */
} lmb_band_scratch;

/* Called once a finished band, with a surface of up to 8 rows whose first is row y of the frame. Return 0 to go on,
 * anything else to stop: lmb_render_step then returns LMB_OK early and the frame is incomplete. */
typedef int (*lmb_band_callback)(void *user, const lmb_surface *rows, int32_t y);

/* A frame's description: what to draw, how, and the memory to do it in. All memory is the caller's. */
typedef struct lmb_frame {
    const lmb_kernels *kernels; /* lmb_kernels_pick(), or one backend's own on small targets */
    const lmb_scene *scene;     /* checked */
    const lmb_many_lights *many_lights; /* built: lights beside the scene's; they bounce by `elements`. NULL: none */
    const lmb_env *background; /* what pixels without a surface show, with its levels; it lights nothing, which
                                  lmb_env_lights are for. NULL: black, as always without trees (LMB_TREES 0) */
    lmb_view view;
    /* how */
    int32_t show;          /* LMB_SHOW_* */
    int32_t shadow_map;    /* texels a side: a multiple of 8 */
    lmb_grouping grouping; /* zeros: defaults */
    int32_t occlusion;     /* LMB_OCCLUSION_* */
    int32_t steps;         /* 12 where 0: samples of a VIEW occlusion segment */
    float error;           /* of LMB_GROUP_CUT: lmb_cut_params.error. 0: 0.02, by LMB_MANY_LIGHTS_EVEN lights 0.1 */
    float visibility;      /* of LMB_OCCLUSION_EXACT: lmb_cut_params.visibility. 0: 0.015, by such lights 0.2 */
    int32_t conservative;  /* 1: LMB_GROUP_CUT: `error` is a bound: lmb_cut_params's */
    float many_lights_error; /* 0.02 where 0: lmb_many_lights_query's */
    int32_t gather_many_lights; /* 1: what they send straight to surfaces is gathered with bounced light, at
                                   `gather_step` and once for each surface of a pixel: for light from all sides, a sky's
                                   say. SHOW_INDIRECT has it then, and SHOW_DIRECT has not, as with emission */
    int32_t bounces;       /* 1 .. 64, 1 where 0: how often light is reflected before the surface that is seen;
                              LMB_GROUP_CUT. Light straight from a material that emits is not reflected: it always
                              counts */
    int32_t truncated;     /* 1: light that is reflected more than `bounces` times is missing; 0: with `bounces` over 1
                              it is estimated, up to LMB_MAX_BOUNCES: lmb_elements_rest */
    int32_t gather_step;   /* bounced light at every 1 (or 0), 2 or 4 pixels each way: see lmb_upsample_tile; or
                              LMB_GATHER_ADAPTIVE, with `lattice` */
    int32_t samples;       /* of coverage and direct light a pixel: 1 (or 0), 4, 8 or 16, with scratch.multisample; the
                              picture is their mean. Bounced light is gathered once for each surface of a pixel, but
                              lobes only where some pixel's middle shows the surface. Each band draws the scene once more for each sample */
    float exposure_ev;
    /* memory */
    void *map_memory; /* every light's shadow map: the sum of lmb_shadow_map_bytes over the lights */
    size_t map_bytes;
    int32_t id_format;  /* LMB_ID32 (or 0), or LMB_ID16 for scenes under 65,536 triangles */
    lmb_points points;  /* data NULL: no bounced light */
    lmb_groups *groups; /* NULL: no bounced light */
    lmb_tree tree;      /* LMB_GROUP_CUT: in place of points and groups; texel NULL: no bounced light */
    const struct lmb_transfer *transfer; /* baked from the scene: bounced light comes by it alone. NULL: none */
    lmb_transfer_light transfer_light;   /* laid out for it, with the scene's materials */
    lmb_bvh bvh; /* LMB_OCCLUSION_EXACT, and shadows of many_lights; triangle NULL: these cast none */
    lmb_elements elements; /* for bounces > 1, bounced many_lights, and materials that emit; data NULL: none of these */
    lmb_lattice lattice; /* LMB_GATHER_ADAPTIVE and _LIVE: of the view's size; tile NULL: none */
    lmb_live *live; /* LMB_GATHER_LIVE, with LMB_GROUP_CUT: for all faces of the maps and all elements; NULL: none */
    lmb_target eye;     /* depth and id of the whole frame; when memory is short, of a strip of some bands of 8 rows:
                           the scene is drawn again for each strip */
    lmb_surface eye_depth; /* with such an `eye` and VIEW occlusion: depth of the whole frame (16 bit will do) */
    lmb_band_scratch *scratch;
    /* where to */
    lmb_surface out; /* the whole frame; or 8 rows, handed to `callback` band by band */
    lmb_band_callback callback;
    void *user;
    lmb_stats *stats; /* may be NULL */
    float dim; /* 0, or radiance, W/(sr m2): lights do not bounce if a bound shows that the bounced light of all of them
                  together stays under it at every pixel. For a display at exposure e, 0.00015 / 2^e is half a step of
                  black in 8 bits */
    float error_floor; /* 0, or radiance, W/(sr m2): errors of bounced light below it are accepted; not with
                          `conservative`. For a display as for `dim` */
    int32_t run_all;   /* 1: skip nothing and reuse nothing: the same bytes, to check that skipping changes none */
} lmb_frame;

/* How accurately bounced light is solved: the values of those numbers of lmb_frame_settings that are 0; errors
 * against truth are in tests/results/README.md. Where LMB_MANY_LIGHTS_EVEN lights or more of `many_lights` are all the
 * light there is, `error` and `visibility` are larger (0.1 and 0.2 by default), and bounced light is gathered at every
 * second pixel. */
enum {
    LMB_QUALITY_DEFAULT = 0, /* tree 256, error 0.02, visibility 0.015 */
    LMB_QUALITY_DRAFT = 1,   /* tree 128, error 0.06, visibility 0.06 */
    LMB_QUALITY_BEST = 2,    /* tree 1024, error 0.01, visibility 0.002 */
    LMB_QUALITY_FIXED = 3    /* fixed groups, with occlusion by the viewer's own depth: where memory is short. Builds
                                without trees (LMB_TREES 0) have this one alone, whichever is asked for */
};

/* What lmb_frame_init makes a frame of. `kernels`, `scene` and `view` are needed; zeros elsewhere give usable defaults.
 * What takes no memory and is not here (exposure_ev, occlusion, stats, callback ...) is set in the frame afterwards. */
typedef struct lmb_frame_settings {
    const lmb_kernels *kernels; /* lmb_kernels_pick(), or one backend's own on small targets */
    const lmb_scene *scene; /* checked, with its lights; stays where it is */
    const lmb_many_lights *many_lights;   /* built; NULL: none. Its memory is its own */
    const lmb_transfer *transfer;         /* opened, and baked from the scene, which lmb_transfer_fits checks and no
                                             frame does; NULL: none. Its memory is its own */
    lmb_view view;          /* lmb_view_look_at makes one; its frame 1 .. LMB_MAX_SIDE px a side */
    lmb_surface out;        /* the caller's picture; data NULL: one in the block, at frame.out */
    int32_t format;         /* of one in the block: LMB_RGBA8 where 0 */
    int32_t by_bands;       /* 1: 8 rows of depth and ids, and of a picture in the block: frame.callback gets them. The
                               scene is drawn again for each band. One thread */
    int32_t show;           /* LMB_SHOW_*: LMB_SHOW_DIRECT takes no memory for bounced light */
    int32_t quality;        /* LMB_QUALITY_* */
    int32_t bounces;        /* 1 where 0, or .. 64; over 1 not by LMB_QUALITY_FIXED */
    int32_t threads;        /* 1 .. 1024, 1 where 0: how many draw bands at once: frame.scratch[0 .. threads - 1] */
    int32_t shadow_map;     /* texels a side, a multiple of 8; with a tree 1 to 8 times the tree's. 0: 2^21 texels (tiny
                               configuration: 2^14) over all shadow maps, 64 .. 1024 a side */
    int32_t tree;           /* texels a side, a power of two; the quality's where 0 (tiny configuration: an eighth);
                               from 1/8 of shadow_map to shadow_map */
    float error, visibility;   /* lmb_frame's; the quality's where 0 */
    uint32_t elements;      /* a power of 4, 64 .. 2^24. 0: 65,536 for more than one bounce but by LMB_GATHER_LIVE, else
                               16,384 (tiny: 1,024 and 256). None where bounces, many_lights and materials need none */
    lmb_grouping grouping;  /* LMB_QUALITY_FIXED: method is not LMB_GROUP_CUT */
    int32_t gather_step;    /* lmb_frame's, 1 where 0 (2 by LMB_MANY_LIGHTS_EVEN lights) */
    int32_t samples;        /* lmb_frame's, 1 where 0 */
    uint32_t points;        /* LMB_QUALITY_FIXED: first points. 0: four a block of texels, the most there can be */
    int32_t id_format;      /* 0: LMB_ID16 for scenes under 65,536 triangles, else LMB_ID32 */
} lmb_frame_settings;

/* What a frame skips though its settings ask for it, as it would change no byte of the picture. lmb_plan says why. */
enum {
    LMB_SKIP_BOUNCE = 1 /* nothing is lit, or nothing reflects */
};

/* What a frame reuses of the last one: lmb_render_reuse. */
enum {
    LMB_REUSE_BVH = 1,
    LMB_REUSE_POINTS = 2,  /* and groups */
    LMB_REUSE_BOUNCES = 4, /* elements and their light */
    LMB_REUSE_VIEW = 8
};

/* The state of one light of a frame. */
enum {
    LMB_LIGHT_DARK = 1,          /* gives no light: has no map, and is skipped */
    LMB_SHADOW_MAP_REUSED = 2,   /* its shadow map is the last frame's */
    LMB_LIGHT_TEXELS_REUSED = 4, /* so are its faces of the tree */
    LMB_LIGHT_DIM = 8            /* does not bounce: lmb_frame.dim */
};

/* The state of a frame under way. */
typedef struct lmb_render {
    lmb_frame frame;
    lmb_shadow_map maps[LMB_MAX_LIGHTS];
    int32_t stage;               /* lmb_stage */
    lmb_status failed;           /* the error that stopped the frame: every later call returns it; LMB_OK: none */
    uint32_t light, face, progress; /* how far the stage is */
    uint32_t triangles;          /* of the scene */
    int32_t emits;               /* 1 where a material emits light */
    int32_t is_glossy;           /* 1 where one has a lobe, in builds with trees */
    int32_t is_unlit;            /* 1 if a material is LMB_UNLIT */
    uint32_t skips, reuses;      /* LMB_SKIP_*, LMB_REUSE_* */
    float dimmed;                /* upper bound of the radiance missing by lights that are too dim to bounce */
    uint8_t light_state[LMB_MAX_LIGHTS]; /* LMB_LIGHT_*, bits */
    uint32_t revision, lights_revision, appearance_revision, light_revision[LMB_MAX_LIGHTS]; /* of what was drawn */
} lmb_render;

/* The stages, in order; lmb_render_progress names them. */
typedef enum lmb_stage {
    LMB_STAGE_SHADOW_MAP = 0,
    LMB_STAGE_BVH, /* LMB_OCCLUSION_EXACT */
    LMB_STAGE_POINTS,
    LMB_STAGE_GROUPS,
    LMB_STAGE_BOUNCES,
    LMB_STAGE_VIEW,
    LMB_STAGE_SAMPLES, /* LMB_GATHER_ADAPTIVE; other frames go on to LMB_STAGE_BANDS at once */
    LMB_STAGE_BANDS,
    LMB_STAGE_DONE
} lmb_stage;

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_frame_bytes: all the memory of a frame by these settings but the scene, many_lights, a picture of the caller's
 * and lmb_render. 0 for settings that lmb_frame_init refuses, and for sizes that this target cannot address.
 *
 * With zeros a room with one spot at 640x480 takes 16 MiB and 116 bytes a triangle: 6 MiB the shadow map, 5 the tree,
 * 3 the viewer's depth and ids and the picture, 2 a thread; LMB_QUALITY_DRAFT 12 MiB, _BEST 86; LMB_GATHER_ADAPTIVE 14
 * MiB more. At 160x120 in the tiny configuration, with 16-bit pixels by bands, a map of 128 x 128 and 400 points, LMB_QUALITY_FIXED takes 215 KiB.
 * Cost: a pass over the lights. */
size_t lmb_frame_bytes(const lmb_frame_settings *settings);

/* lmb_frame_init: a frame laid out in one block, ready for lmb_render_begin.
 *
 *   out     set, whole. It points into the block, which stays where it is while the frame is used.
 *   memory  aligned as for a uint64_t; by 64 bytes is best: each part then begins on a cache line. Scratches, and a
 *           picture in it, become zeros; the rest is not touched.
 *   bytes   at least lmb_frame_bytes.
 *
 * The frame may be used for as long as the scene has no more triangles, lights and map faces (lmb_shadow_map_faces)
 * than now: lights, objects and viewer may move. To end it, free the block; there is nothing else to undo.
 * Returns LMB_OK; LMB_ERR_ARG (null, no scene, a number outside what stands beside it), LMB_ERR_FORMAT (of picture or
 * ids), LMB_ERR_SCENE (ids do not fit), LMB_ERR_ALIGN, LMB_ERR_CAPACITY (bytes; more lights than LMB_MAX_LIGHTS): then
 * nothing was written. */
lmb_status lmb_frame_init(lmb_frame *out, const lmb_frame_settings *settings, void *memory, size_t bytes);

/* lmb_render_begin: check a frame and start it.
 *
 * Returns LMB_OK, or LMB_ERR_ARG, LMB_ERR_CAPACITY (too many lights, maps or surfaces too small), LMB_ERR_FORMAT,
 * LMB_ERR_ALIGN, LMB_ERR_SCENE (ids do not fit id_format): then nothing but *r was written. */
lmb_status lmb_render_begin(lmb_render *r, const lmb_frame *frame);

/* lmb_render_step: do up to `units` units of work, at least one.
 *
 * A unit is 1,024 triangles of a draw, a row of shadow-map tiles, or 64 elements or receivers of one bounce. A band
 * counts as 8 (and the first of a strip draws the whole scene, where the eye is smaller than the frame), a window of
 * 64 x 64 px of LMB_STAGE_SAMPLES as 64. The discs of one face, the grouping, the BVH and building the elements cannot
 * be divided: each is one unit.
 * Returns LMB_MORE, LMB_OK when the frame is done, or an error of the stage. */
lmb_status lmb_render_step(lmb_render *r, int32_t units);

/* lmb_render_band: draw one band of the picture, whole; legal from LMB_STAGE_BANDS on, in any order, on any thread with
 * its own scratch (and, where that is smaller than the frame, its own `eye`, of which it takes 8 rows, and which is not
 * frame.eye while lmb_render_step is in a strip). Band b is rows 8b .. 8b + 7.
 * `out` is the whole frame, or 8 rows that take the band. Returns LMB_OK, LMB_ERR_ARG or LMB_ERR_FORMAT. */
lmb_status lmb_render_band(const lmb_render *r, lmb_band_scratch *scratch, const lmb_target *eye,
                           const lmb_surface *out, int32_t band);

/* lmb_render_again: another picture by the same light: the second eye's [V31], or the next of a viewer who moves while
 * light and objects stand still. r goes back to LMB_STAGE_VIEW; maps, points, groups and trees stay, and are only
 * read.
 *
 *   frame  kernels, view, show, occlusion, steps, error, visibility, conservative, many_lights_error, gather_step,
 *          lattice, samples, exposure_ev, eye, eye_depth, scratch, out, callback, user and stats are taken from it; the rest stays as it
 *          was at lmb_render_begin.
 * The bytes are those of lmb_render_frame of the same view. Two pictures at once: copy r, and give each copy an eye,
 * scratch and out of its own. Legal from LMB_STAGE_VIEW on. Returns LMB_OK and what lmb_render_begin does; LMB_ERR_ARG
 * also where `frame` shows bounced light and r solved none; where r solved several bounces, or those of many_lights, by
 * another occlusion, error, visibility or many_lights_error; or where it needs a BVH that r did not build. After an
 * error r is unchanged. */
lmb_status lmb_render_again(lmb_render *r, const lmb_frame *frame);

/* lmb_render_reuse: begin the next frame of an animation: lmb_render_begin that keeps what did not change since r's
 * last frame, by the scene's revisions and the frame's settings. The bytes are those of lmb_render_begin.
 *
 *   r      of the last frame, done or not; or all 0: then it is the first.
 *   frame  whole, as for lmb_render_begin. What is reused lies in its memory: give the same memory each frame, and do
 *          not write to it in between. Where memory, a size or the scene is another one, that part is made again.
 * Reused are: a shadow map, while no object moved and the light's own and lights_revision are unchanged; its first
 * points, if appearance_revision is unchanged too; groups, if that holds for all lights; the BVH, while no object
 * moved, whatever lights do; bounces, if everything is unchanged; the viewer's depth and ids (of a whole frame), while
 * neither objects nor the viewer moved. Direct and bounced light of the pixels are always gathered anew. Returns LMB_OK
 * or what else lmb_render_begin does. Missing in builds without plan. */
lmb_status lmb_render_reuse(lmb_render *r, const lmb_frame *frame);

/* lmb_render_has_parts: 1 where the current stage can be done in parts, on several threads; 0 where lmb_render_step
 * must do it: short stages, one that steps have begun, first points without room for four a block. */
int32_t lmb_render_has_parts(const lmb_render *r);

/* lmb_render_part: do one of `parts` equal shares: tile rows of all shadow maps (LMB_STAGE_SHADOW_MAP), of the next
 * face of one (LMB_STAGE_POINTS), or of the frame (LMB_STAGE_VIEW); the elements of the next bounce
 * (LMB_STAGE_BOUNCES). Shares may be done on any threads in any order. When each was done, once, lmb_render_parts_done
 * goes on. The bytes are those of lmb_render_step.
 *
 *   scratch  one for each thread.
 *   parts    1 .. 65,535. A share of a map sets up all of its triangles: one share a thread is best.
 *   stats    added to; one for each thread, or NULL. frame.stats is left to lmb_render_parts_done.
 * Returns LMB_OK; LMB_ERR_ARG (null, part outside, a stage without parts); or an error of the stage. */
lmb_status lmb_render_part(const lmb_render *r, lmb_band_scratch *scratch, int32_t part, int32_t parts,
                           lmb_stats *stats);

/* lmb_render_parts_done: all `parts` shares were done: go on to the next face or stage. Returns LMB_MORE or
 * LMB_OK as lmb_render_step does, an error of the stage, or LMB_ERR_ARG for a stage without parts. */
lmb_status lmb_render_parts_done(lmb_render *r, int32_t parts);

/* lmb_render_frame: begin and all the steps. `r` is caller's memory. Returns LMB_OK when the frame is done, or an error of
 * lmb_render_begin or of a stage. */
lmb_status lmb_render_frame(lmb_render *r, const lmb_frame *frame);

#if LMB_DRAW
/* lmb_render_vertices: light vertices for lmb_draw_list by the light of a frame: the scene's lights with their shadows,
 * many lights, and bounced light. So glass, smoke and particles lie in the room's light.
 *
 *   colours  R G B A a vertex, sRGB; set to what a matt surface of the vertex's own colour shows there at the frame's
 *            exposure; alpha stays. May be vertices->colours.
 *   r        from LMB_STAGE_BANDS on, done or not. LMB_SHOW_DIRECT has no bounced light, LMB_SHOW_INDIRECT no other.
 *   normals  x, y, z a vertex, in the vertices' space: towards the side that is lit. NULL: light comes from all sides
 *            alike, as in smoke: the mean of all normals.
 * By a transfer, bounced light is that of its places in the air: none in files without objects that move. By cuts,
 * 64 vertices in a row share a cut, and what they get changes a little with the others. Otherwise a vertex's light
 * depends on it, the scene and the maps only. A vertex that is not finite becomes black.
 * Returns LMB_OK, LMB_ERR_ARG, LMB_ERR_FORMAT or LMB_ERR_ALIGN, then nothing is written; or an error of the frame. */
lmb_status lmb_render_vertices(uint8_t *colours, const lmb_render *r, lmb_band_scratch *scratch,
                               const lmb_draw_vertices *vertices, const float *normals, const lmb_mat4 *to_world);
#endif

/* lmb_render_progress: how far the current stage is, 0 .. 1. *name is its name in words; never NULL. */
float lmb_render_progress(const char **name, const lmb_render *r);

#ifdef __cplusplus
}
#endif
#endif
