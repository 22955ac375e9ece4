/* render.h: draw a frame with bounced light, by one call or in bounded steps. [V29 V30 V33 V34]
 *
 *     lmb_frame_init(&frame, &settings, memory, lmb_frame_bytes(&settings));   all memory in one block
 *     lmb_render r;                        0.8 KiB a light; holds no pointer into itself: copy it freely
 *     lmb_render_begin(&r, &frame);        checks the frame, writes no pixel
 *     while (lmb_render_step(&r, 1000) == LMB_MORE) { ... }       or: lmb_render_frame(&r, &frame)
 *
 * Order [V34]: for each light the shadow map, first points and discs; groups; bounces after the first; the viewer's
 * depth; then each band: attributes, direct light, gathered light, picture. Steps of any size, and bands in any order,
 * give the same bytes.
 *
 * You can read the results of each stage [V33]. They are plain structs in your memory:
 *   light distances     r.maps[light], from LMB_STAGE_POINTS on: lmb_gbuffer_band over view[f] and face[f] gives metres
 *   first points        lmb_points_collect, one face of a light after another; frame.points: all faces, joined
 *   incident light      frame.points, from LMB_STAGE_GROUPS on: data[i].flux / data[i].albedo is the incident power, W
 *   groups              frame.groups, from LMB_STAGE_VIEW on; members of group k: points.data[first[k]] and on, each
 *                       with its texel in the map of its face [V15]. frame.points.owner: the disc of each texel
 *   eye distances       frame.eye (or eye_depth), from LMB_STAGE_BANDS on: lmb_depth_view_z, or lmb_gbuffer_band
 *   received light      LMB_SHOW_IRRADIANCE as the picture; for single tiles: lmb_direct_tile, lmb_gather_tile
 *
 * Glossy materials (lmb_material.specular; builds with trees) reflect the scene's lights, and also bounced light if the
 * frame uses LMB_GROUP_CUT or a transfer. Fixed groups and the direct light of `many_lights` light only the diffuse
 * part. Tiles that show a lobe are gathered at each pixel, whatever gather_step is. LMB_SHOW_IRRADIANCE has no lobes.
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

/* The part of the light to write. Linear formats receive radiance (SHOW_IRRADIANCE: W/m2, before the albedo). */
enum { LMB_SHOW_FULL = 0, LMB_SHOW_DIRECT = 1, LMB_SHOW_INDIRECT = 2, LMB_SHOW_IRRADIANCE = 3 };

/* A value of gather_step: lmb_live lights single points, up to 16 px apart, and closer if light or surfaces vary. The
 * pixels between them are interpolated with the gradients of the light. The picture is a function of scene, view and
 * settings; order, threads and bands do not change it. If you set gather_many_lights and the many lights are not only
 * suns, each pixel is lit instead. */
enum { LMB_GATHER_LIVE = 16 };

/* Scratch for frame.samples > 1: the samples of one band. 19 KiB, and the memory of `eye`. */
typedef struct lmb_multisample {
    lmb_target eye;    /* depth and ids: as wide as the frame, 8 rows a sample, one sample below the other */
    lmb_view view;     /* of one sample */
    lmb_target window; /* the sample's rows of `eye` */
    lmb_tile tile;     /* surfaces that the sample shows in a tile's pixels */
    lmb_irradiance middle, light;         /* bounced light: at the pixel centres, and at the sample */
    int16_t middle_of[LMB_TILE_PIXELS];   /* the pixel that shows the sample's surface at its centre, or -1 */
    uint64_t lobe_pixels;                 /* pixels that show a lobe at their centre */
    lmb_radiance lobes;                   /* bounced light reflected by lobes at the pixel centres */
    lmb_radiance sum;                     /* sum of the samples so far */
    lmb_tile extra;                       /* surfaces that samples show and no pixel centre does */
    lmb_irradiance extra_light;           /* bounced light of `extra` */
    uint8_t extra_pixel[LMB_TILE_PIXELS]; /* the pixel of each surface of `extra` */
    int32_t extras;                       /* surfaces in `extra` */
} lmb_multisample;

/* Scratch for one band. Place it in fast RAM, one for each thread that draws bands. */
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
    int64_t saved_tests; /* lmb_cut_params.saved of the band's cuts */
    lmb_many_lights_scratch many_lights;
    lmb_tile together;      /* pixels of several samples, or vertices, gathered as one tile */
    lmb_irradiance between; /* LMB_GATHER_LIVE: bounced light of a tile's pixels */
    lmb_glossy glossy; /* for scenes with glossy lobes */
    lmb_multisample *multisample; /* for frame.samples > 1 */
    lmb_live_scratch *live; /* for LMB_GATHER_LIVE */
} lmb_band_scratch;

/* Called for each finished band, with a surface of up to 8 rows. The first row is row y of the frame. Return 0 to go
 * on, any other number to stop: lmb_render_step then returns LMB_OK early and the frame is incomplete. */
typedef int (*lmb_band_callback)(void *user, const lmb_surface *rows, int32_t y);

/* A frame's description: the scene, the settings, and the memory to draw in. All memory is the caller's. */
typedef struct lmb_frame {
    const lmb_kernels *kernels; /* lmb_kernels_pick(), or one backend's own on small targets */
    const lmb_scene *scene;     /* checked */
    const lmb_many_lights *many_lights; /* built: lights beside the scene's; they bounce by `elements`. NULL: none */
    const lmb_env *background; /* shown by pixels that hit nothing; needs mip levels; does not light the scene
                                  (lmb_env_lights does). NULL: black, as always in builds without trees */
    lmb_view view;
    /* settings */
    int32_t show;          /* LMB_SHOW_* */
    int32_t shadow_map;    /* texels a side: a multiple of 8 */
    lmb_grouping grouping; /* zeros: defaults */
    int32_t occlusion;     /* LMB_OCCLUSION_* */
    int32_t steps;         /* samples of a VIEW occlusion segment; 0: 12 */
    float error;           /* LMB_GROUP_CUT: lmb_cut_params.error. 0: 0.02; with LMB_MANY_LIGHTS_EVEN lights 0.1 */
    float visibility;      /* LMB_OCCLUSION_EXACT: lmb_cut_params.visibility. 0: 0.015; with these lights 0.2 */
    int32_t conservative;  /* 1: `error` is a bound (LMB_GROUP_CUT): lmb_cut_params.conservative */
    float many_lights_error; /* lmb_many_lights_query.error; 0: 0.02 */
    int32_t gather_many_lights; /* 1: direct light of `many_lights` is gathered with bounced light, at `gather_step` and
                                   once for each surface of a pixel: for light from all sides, such as a sky.
                                   SHOW_INDIRECT then includes it and SHOW_DIRECT does not, as with emission */
    int32_t bounces;       /* 1 .. 64; 0: 1. Reflections before the visible surface; over 1 only with LMB_GROUP_CUT or
                              a transfer. Emitted light that reaches a surface directly is always included */
    int32_t truncated;     /* 1: light reflected more than `bounces` times is missing. 0: if `bounces` is over 1, it is
                              estimated, up to LMB_MAX_BOUNCES: lmb_elements_rest */
    int32_t gather_step;   /* 1 (or 0): bounced light is gathered at each pixel; or LMB_GATHER_LIVE, with `lattice` */
    int32_t samples;       /* coverage and direct light, samples a pixel: 1 (or 0), 4, 8 or 16, with
                              scratch.multisample; the picture is their mean. Bounced light is gathered once for each
                              surface of a pixel, but lobes only if some pixel centre shows the surface. Each band draws
                              the scene once more for each sample */
    float exposure_ev;
    /* memory */
    void *map_memory; /* shadow maps of all lights: the sum of lmb_shadow_map_bytes over the lights */
    size_t map_bytes;
    int32_t id_format;  /* LMB_ID32 (or 0), or LMB_ID16 for scenes under 65,536 triangles */
    lmb_points points;  /* data NULL: no bounced light */
    lmb_groups *groups; /* NULL: no bounced light */
    lmb_tree tree;      /* LMB_GROUP_CUT: instead of points and groups; texel NULL: no bounced light */
    const struct lmb_transfer *transfer; /* baked from the scene: all bounced light comes from it. NULL: none */
    lmb_transfer_light transfer_light;   /* laid out for `transfer`, with the scene's materials */
    lmb_bvh bvh; /* LMB_OCCLUSION_EXACT, shadows of many_lights, and LMB_SHOW_DIRECT or `transfer` if it has room for
                    at most LMB_TRACED_TRIANGLES; triangle NULL: many_lights cast no shadows, and lit pixels are not
                    traced */
    lmb_elements elements; /* for bounces > 1, bounced many_lights, and emissive materials; data NULL: none of these */
    lmb_lattice lattice; /* LMB_GATHER_LIVE: of the view's size; tile NULL: none */
    lmb_live *live; /* LMB_GATHER_LIVE, with LMB_GROUP_CUT: for all faces of the maps and all elements; NULL: none */
    lmb_live_sky *live_sky; /* for many_lights that are only suns; NULL: none */
    lmb_target eye;     /* depth and ids of the whole frame; if memory is short, of a strip of some bands of 8 rows: the
                           scene is drawn again for each strip */
    lmb_surface eye_depth; /* with a strip as `eye` and VIEW occlusion: depth of the whole frame (16 bit will do) */
    lmb_band_scratch *scratch;
    /* output */
    lmb_surface out; /* the whole frame; or 8 rows, handed to `callback` band by band */
    lmb_band_callback callback;
    void *user;
    lmb_stats *stats; /* may be NULL */
    float dim; /* 0, or radiance, W/(sr m2): lights do not bounce if their bounced light together provably stays below
                  it at every pixel. For a display at exposure e, half a step of black in 8 bits is 0.00015 / 2^e */
    float error_floor; /* 0, or radiance, W/(sr m2): errors of bounced light below it are accepted; not with
                          `conservative`. For a display see `dim` */
    int32_t run_all;   /* 1: skip and reuse nothing. The bytes are the same: use it to check that skipping changes
                          none */
} lmb_frame;

/* Accuracy of bounced light: each quality sets the numbers of lmb_frame_settings that you leave 0. Errors against truth
 * are in tests/results/README.md. If LMB_MANY_LIGHTS_EVEN or more `many_lights` are all the light of the scene, `error`
 * and `visibility` are larger (0.1 and 0.2 by default). */
enum {
    LMB_QUALITY_DEFAULT = 0, /* tree 256, error 0.02, visibility 0.015 */
    LMB_QUALITY_DRAFT = 1,   /* tree 128, error 0.06, visibility 0.06 */
    LMB_QUALITY_BEST = 2,    /* tree 1024, error 0.01, visibility 0.002 */
    LMB_QUALITY_FIXED = 3    /* fixed groups, with occlusion by the viewer's depth: if memory is short. Builds without
                                trees (LMB_TREES 0) always use it */
};

/* Settings for lmb_frame_init. You must set `kernels`, `scene` and `view`; zeros elsewhere give usable defaults. Set
 * members of lmb_frame that take no memory and are not here (exposure_ev, occlusion, stats, callback ...) in the frame
 * afterwards. */
typedef struct lmb_frame_settings {
    const lmb_kernels *kernels; /* lmb_kernels_pick(), or one backend's own on small targets */
    const lmb_scene *scene; /* checked, with lights; do not move it while you use the frame */
    const lmb_many_lights *many_lights;   /* built, in memory of your own; NULL: none */
    const lmb_transfer *transfer;         /* opened, in memory of your own; NULL: none. It must be baked from the scene:
                                             lmb_transfer_fits checks that, a frame does not */
    lmb_view view;          /* see lmb_view_look_at; the frame is 1 .. LMB_MAX_SIDE px a side */
    lmb_surface out;        /* your picture; data NULL: one in the block, at frame.out */
    int32_t format;         /* of a picture in the block; 0: LMB_RGBA8 */
    int32_t by_bands;       /* 1: depth, ids and a picture in the block have 8 rows, and frame.callback receives them.
                               The scene is drawn again for each band. One thread */
    int32_t show;           /* LMB_SHOW_*; LMB_SHOW_DIRECT takes no memory for bounced light */
    int32_t quality;        /* LMB_QUALITY_* */
    int32_t bounces;        /* 1 .. 64; 0: 1. LMB_QUALITY_FIXED allows only 1 */
    int32_t threads;        /* number of threads that draw bands at once, 1 .. 1024; 0: 1. Each uses one of
                               frame.scratch[0 .. threads - 1] */
    int32_t shadow_map;     /* texels a side, a multiple of 8; with a tree 1 to 8 times the tree's. 0: 2^21 texels (tiny
                               configuration: 2^14) over all shadow maps, 64 .. 1024 a side */
    int32_t tree;           /* texels a side, a power of two, from 1/8 of shadow_map to shadow_map; 0: set by the
                               quality (tiny configuration: an eighth) */
    float error, visibility;   /* lmb_frame's; 0: set by the quality */
    uint32_t elements;      /* a power of 4, 64 .. 2^24. 0: 65,536 for more than one bounce without LMB_GATHER_LIVE,
                               else 16,384 (tiny: 1,024 and 256). None if bounces, many_lights and materials need
                               none */
    lmb_grouping grouping;  /* LMB_QUALITY_FIXED: any method but LMB_GROUP_CUT */
    int32_t gather_step;    /* lmb_frame's; 0: 1 */
    int32_t samples;        /* lmb_frame's; 0: 1 */
    uint32_t points;        /* LMB_QUALITY_FIXED: first points. 0: four a block of texels, the maximum */
    int32_t steady;         /* 1: with LMB_GATHER_LIVE, bounced light changes more evenly while lights or the camera
                               move, for about twice as many segments: lmb_live.steady */
    int32_t id_format;      /* 0: LMB_ID16 for scenes under 65,536 triangles, else LMB_ID32 */
} lmb_frame_settings;

/* Stages that a frame skips although the settings ask for them, because they would change no byte of the picture.
 * lmb_plan gives the reasons. */
enum {
    LMB_SKIP_BOUNCE = 1 /* no surface is lit, or none reflects */
};

/* Results of the last frame that a frame reuses: lmb_render_reuse. */
enum {
    LMB_REUSE_BVH = 1,
    LMB_REUSE_POINTS = 2,  /* and groups */
    LMB_REUSE_BOUNCES = 4, /* elements and their light */
    LMB_REUSE_VIEW = 8
};

/* The state of one light of a frame. */
enum {
    LMB_LIGHT_DARK = 1,          /* emits no light: has no map, and is skipped */
    LMB_SHADOW_MAP_REUSED = 2,   /* the shadow map is from the last frame */
    LMB_LIGHT_TEXELS_REUSED = 4, /* so are the faces of the tree */
    LMB_LIGHT_DIM = 8            /* does not bounce: lmb_frame.dim */
};

/* The state of a frame under way. */
typedef struct lmb_render {
    lmb_frame frame;
    lmb_shadow_map maps[LMB_MAX_LIGHTS];
    int32_t stage;               /* lmb_stage */
    lmb_status failed;           /* the error that stopped the frame: every later call returns it; LMB_OK: none */
    uint32_t light, face, progress; /* progress within the stage */
    uint32_t triangles;          /* of the scene */
    int32_t emits;               /* 1 if a material emits light */
    int32_t is_glossy;           /* 1 if a material has a lobe, in builds with trees */
    int32_t is_unlit;            /* 1 if a material is LMB_UNLIT */
    uint32_t skips, reuses;      /* LMB_SKIP_*, LMB_REUSE_*; the highest bit of reuses: the BVH was built fast */
    float dimmed;                /* upper bound of the radiance that is missing because dim lights do not bounce */
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
    LMB_STAGE_SAMPLES, /* LMB_GATHER_LIVE; other frames go on to LMB_STAGE_BANDS at once */
    LMB_STAGE_BANDS,
    LMB_STAGE_DONE
} lmb_stage;

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_frame_bytes: the bytes of a frame's block: all memory except the scene, many_lights, a picture of your own and
 * lmb_render. Returns 0 for settings that lmb_frame_init refuses, and for sizes that this target cannot address.
 *
 * With zeros in the settings a room with one spot at 640x480 takes 16 MiB and 116 bytes a triangle: the shadow map 6
 * MiB, the tree 5, the viewer's depth, ids and picture 3, a thread 2. LMB_QUALITY_DRAFT takes 12 MiB, _BEST 86;
 * LMB_GATHER_LIVE adds 30 MiB. At 160x120 in the tiny configuration, with 16-bit pixels by bands, a map of 128 x
 * 128 and 400 points, LMB_QUALITY_FIXED takes 215 KiB.
 * Cost: a pass over the lights. */
size_t lmb_frame_bytes(const lmb_frame_settings *settings);

/* lmb_frame_init: lay out a frame in one block, ready for lmb_render_begin.
 *
 *   out     overwritten. It points into the block: do not move the block while you use the frame.
 *   memory  aligned as for a uint64_t; 64 bytes is best: each part then begins on a cache line. Scratch memory and a
 *           picture in the block are zeroed; the rest is not touched.
 *   bytes   at least lmb_frame_bytes.
 *
 * You may use the frame as long as the scene has no more triangles, lights and map faces (lmb_shadow_map_faces) than
 * now; lights, objects and viewer may move. To end it, free the block; there is nothing else to undo.
 * Returns LMB_OK; LMB_ERR_ARG (null, no scene, a number out of range), LMB_ERR_FORMAT (of picture or ids),
 * LMB_ERR_SCENE (ids do not fit), LMB_ERR_ALIGN, LMB_ERR_CAPACITY (bytes; more lights than LMB_MAX_LIGHTS): then
 * nothing was written. */
lmb_status lmb_frame_init(lmb_frame *out, const lmb_frame_settings *settings, void *memory, size_t bytes);

/* lmb_render_begin: check a frame and start it.
 *
 * Returns LMB_OK, or LMB_ERR_ARG, LMB_ERR_CAPACITY (too many lights, maps or surfaces too small), LMB_ERR_FORMAT,
 * LMB_ERR_ALIGN, LMB_ERR_SCENE (ids do not fit id_format): then only *r was written. */
lmb_status lmb_render_begin(lmb_render *r, const lmb_frame *frame);

/* lmb_render_step: do up to `units` units of work, at least one.
 *
 * A unit is 1,024 triangles of a draw, a row of shadow-map tiles, or 64 elements or receivers of one bounce. A band
 * counts as 8 units, two rows of tiles of LMB_STAGE_SAMPLES as 64. If `eye` is smaller than the frame, the first
 * band of a strip also draws the whole scene. The discs of one face, the grouping, the BVH and building the elements
 * cannot be divided: each is one unit.
 * Returns LMB_MORE, LMB_OK when the frame is done, or an error of the stage. */
lmb_status lmb_render_step(lmb_render *r, int32_t units);

/* lmb_render_band: draw one whole band of the picture: rows 8b .. 8b + 7 for band b. Legal from LMB_STAGE_BANDS on, in
 * any order, on any thread with a scratch of its own. If `eye` is smaller than the frame, each thread also needs its
 * own `eye`, of which the call uses 8 rows. It must not be frame.eye while lmb_render_step is in a strip.
 * `out` is the whole frame, or 8 rows that receive the band. Returns LMB_OK, LMB_ERR_ARG or LMB_ERR_FORMAT. */
lmb_status lmb_render_band(const lmb_render *r, lmb_band_scratch *scratch, const lmb_target *eye,
                           const lmb_surface *out, int32_t band);

/* lmb_render_again: draw another picture with the same light: the second eye [V31], or the next view of a moving viewer
 * while lights and objects do not move. r goes back to LMB_STAGE_VIEW; maps, points, groups and trees are reused and
 * only read.
 *
 *   frame  kernels, view, show, occlusion, steps, error, visibility, conservative, many_lights_error,
 *          gather_many_lights, background, gather_step, lattice, samples, exposure_ev, eye, eye_depth, scratch, out,
 *          callback, user and stats are read; the rest is as it was at lmb_render_begin.
 * The bytes are those of lmb_render_frame of the same view. To draw two pictures at once, copy r, and give each copy
 * its own eye, scratch and out. Legal from LMB_STAGE_VIEW on.
 * Returns LMB_OK or an error of lmb_render_begin. LMB_ERR_ARG also if `frame` shows bounced light and r solved none; if
 * r solved several bounces, or those of many_lights, with another occlusion, error, visibility, conservative or
 * many_lights_error, or if one of the two uses LMB_GATHER_LIVE and the other does not; or if `frame` needs a tree or
 * BVH that r did not build. After an error r is unchanged. */
lmb_status lmb_render_again(lmb_render *r, const lmb_frame *frame);

/* lmb_render_reuse: begin the next frame of an animation: lmb_render_begin that reuses results that did not change
 * since r's last frame. The scene's revisions and the frame's settings decide. The bytes are those of lmb_render_begin.
 *
 *   r      of the last frame, done or not; all 0 for the first frame.
 *   frame  whole, as for lmb_render_begin. Reused results lie in the frame's memory: pass the same memory each frame,
 *          and do not write to it in between. If memory, a size or the scene differs, that part is made again.
 * Reused are: a shadow map, if no object moved and the light's own revision and lights_revision are unchanged; its
 * first points, if appearance_revision is unchanged too; groups, if that holds for all lights; the BVH, if no object
 * moved; bounces, if everything is unchanged; the viewer's depth and ids (of a whole frame), if neither objects nor the
 * viewer moved. Direct and bounced light of the pixels are always gathered again.
 * Returns LMB_OK or an error of lmb_render_begin. Missing in builds without LMB_PLAN. */
lmb_status lmb_render_reuse(lmb_render *r, const lmb_frame *frame);

/* lmb_render_has_parts: 1 if the current stage can be done in parts, on several threads. 0 if lmb_render_step must do
 * it: short stages, a stage that steps have begun, first points without room for four a block. */
int32_t lmb_render_has_parts(const lmb_render *r);

/* lmb_render_part: do one of `parts` equal shares of the current stage: tile rows of all shadow maps
 * (LMB_STAGE_SHADOW_MAP), of the next face of one (LMB_STAGE_POINTS), or of the frame (LMB_STAGE_VIEW); or elements of
 * the next bounce (LMB_STAGE_BOUNCES). Run the shares on any threads in any order, each once, and then call
 * lmb_render_parts_done. The bytes are those of lmb_render_step.
 *
 *   scratch  one for each thread.
 *   parts    1 .. 65,535. Use one share for each thread, because each share of a map sets up all triangles. For
 *            LMB_STAGE_SAMPLES use 16 for each thread, because some rows have many more samples than others.
 *   stats    added to; one for each thread, or NULL. lmb_render_parts_done writes frame.stats.
 * Returns LMB_OK; LMB_ERR_ARG (null, part outside, a stage without parts); or an error of the stage. */
lmb_status lmb_render_part(const lmb_render *r, lmb_band_scratch *scratch, int32_t part, int32_t parts,
                           lmb_stats *stats);

/* lmb_render_parts_done: go on to the next face or stage when all `parts` shares are done. Returns LMB_MORE or LMB_OK
 * as lmb_render_step does, an error of the stage, or LMB_ERR_ARG for a stage without parts. */
lmb_status lmb_render_parts_done(lmb_render *r, int32_t parts);

/* lmb_render_frame: begin a frame and do all steps. `r` is your memory. Returns LMB_OK when the frame is done, or
 * an error of lmb_render_begin or of a stage. */
lmb_status lmb_render_frame(lmb_render *r, const lmb_frame *frame);

#if LMB_DRAW
/* lmb_render_vertices: light vertices for lmb_draw_list with the light of a frame: the scene's lights with their
 * shadows, many lights, and bounced light. Use it for glass, smoke and particles in a lit room.
 *
 *   colours  R G B A a vertex, sRGB; overwritten with the colour that a matt surface of the vertex's own colour shows
 *            at the frame's exposure; alpha is unchanged. May be vertices->colours.
 *   r        from LMB_STAGE_BANDS on, done or not. With LMB_SHOW_DIRECT there is no bounced light, with
 *            LMB_SHOW_INDIRECT only bounced light.
 *   normals  x, y, z a vertex, in the vertices' space: towards the lit side. NULL: light from all
 *            sides counts alike, as in smoke (the mean over all directions of the normal).
 * With a transfer, bounced light is read from points in the air; a file without moving objects has none. With cuts,
 * 64 consecutive vertices share a cut, so a vertex's light changes a little with the others. Otherwise a vertex's light
 * depends only on the vertex, the scene and the maps. A vertex that is not finite becomes black.
 * Returns LMB_OK; LMB_ERR_ARG, LMB_ERR_FORMAT or LMB_ERR_ALIGN, then nothing is written; or an error of the frame. */
lmb_status lmb_render_vertices(uint8_t *colours, const lmb_render *r, lmb_band_scratch *scratch,
                               const lmb_draw_vertices *vertices, const float *normals, const lmb_mat4 *to_world);
#endif

/* lmb_render_progress: progress of the current stage, 0 .. 1. *name receives the stage's name, never NULL. */
float lmb_render_progress(const char **name, const lmb_render *r);

#ifdef __cplusplus
}
#endif
#endif
