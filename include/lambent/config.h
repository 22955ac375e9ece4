/* config.h: every capacity and switch of lambent, with unit, cost and the effect when it is full.
 *
 * You may change each value inside #ifndef: define it on the compiler's command line, for both the library and the
 * application. The other values follow from these, or from LMB_CONFIG_TINY, or are part of the arithmetic.
 * LMB_CONFIG_TINY picks the small set. Capacities are not sizes: a run may use any size up to them.
 *
 * Stability: stable. Tags like [V19] are requirements in src/SOURCES.md. */
#ifndef LMB_CONFIG_H
#define LMB_CONFIG_H

/* Groups of one frame's first points [V19]. 64 bytes each, inside lmb_groups. When full, grouping restarts with a wider
 * reach until everything fits: detail is lost, light is not. */
#ifndef LMB_MAX_GROUPS
#ifdef LMB_CONFIG_TINY
#define LMB_MAX_GROUPS 96
#else
#define LMB_MAX_GROUPS 2048
#endif
#endif

/* Lights of one frame that have their own shadow map. Full: LMB_ERR_CAPACITY. */
#ifndef LMB_MAX_LIGHTS
#ifdef LMB_CONFIG_TINY
#define LMB_MAX_LIGHTS 1
#else
#define LMB_MAX_LIGHTS 128
#endif
#endif

/* Nodes of one tile's cut through the light tree (lmb_cut). 32 bytes each. When full, each half of the pixels gets a
 * cut of its own; if that does not help, the pixels are lit by the nodes there are, coarser than the error limit, and
 * lmb_stats.full_cuts counts them. At least 6 x LMB_MAX_LIGHTS: the cut holds the root of every face of every map. */
#ifndef LMB_MAX_CUT
#ifdef LMB_CONFIG_TINY
#define LMB_MAX_CUT 64
#else
#define LMB_MAX_CUT 65536
#endif
#endif

/* Nodes of the tree of many lights that one surface of a tile uses at most. 20 bytes each, in lmb_many_lights_scratch.
 * When full, nodes are not split further, and the error grows. */
#ifndef LMB_MANY_LIGHTS_CUT
#ifdef LMB_CONFIG_TINY
#define LMB_MANY_LIGHTS_CUT 32
#else
#define LMB_MANY_LIGHTS_CUT 1024
#endif
#endif

/* Nodes of such a cut that are tested for shadows, and light the pixels, at a time. 144 bytes each, in
 * lmb_many_lights_scratch. */
#ifdef LMB_CONFIG_TINY
#define LMB_ACTIVE_LIGHTS 8
#else
#define LMB_ACTIVE_LIGHTS 32
#endif

/* Pixels x groups that the gather computes together. 12 bytes each, in lmb_gather_scratch and lmb_cut. */
#ifdef LMB_CONFIG_TINY
#define LMB_GATHER_PAIRS 128
#else
#define LMB_GATHER_PAIRS 256
#endif

/* 0: this build has no fixed groups (lambent/bounce.h): frames show only direct light, unless a baked transfer adds
 * bounced light. Saves 15 KiB of ROM on a Cortex-M4F. A build without groups has no trees and no plan.h either. */
#ifndef LMB_BOUNCE
#define LMB_BOUNCE 1
#endif

/* 0: this build has no trees: no LMB_GROUP_CUT, exact occlusion, many lights, further bounces or emissive surfaces; a
 * material's glossy lobe is ignored. Their functions are missing, and frames that need them are refused. Saves 30 KiB
 * of ROM on a Cortex-M4F. */
#ifndef LMB_TREES
#define LMB_TREES LMB_BOUNCE
#endif
#if LMB_TREES && !LMB_BOUNCE
#error "lambent: LMB_TREES needs LMB_BOUNCE"
#endif

/* 0: a texel of the light tree in which several surfaces show gives light by one of them only, and only shadow maps
 * decide about single lit pixels in dark corners. Saves 7 KiB of code; floors beside round objects in low sun get
 * bright specks. 0 in a build without trees. */
#ifndef LMB_FACETS
#define LMB_FACETS LMB_TREES
#endif

/* If frame.bvh has room for at most this many triangles, frames with LMB_SHOW_DIRECT or baked light trace lit pixels
 * that the four texels around them do not decide, in builds with LMB_FACETS. lmb_frame_init adds that room, 116 bytes a
 * triangle, for scenes of at most this size. In larger scenes, sealed rooms may show lit pixels. 0: never, as in the
 * tiny configuration, where the room would take a quarter of a frame's memory. */
#ifndef LMB_TRACED_TRIANGLES
#ifdef LMB_CONFIG_TINY
#define LMB_TRACED_TRIANGLES 0u
#else
#define LMB_TRACED_TRIANGLES 16384u
#endif
#endif

/* 0: this build has no light at single points (lambent/live.h); frames with LMB_GATHER_LIVE are refused. Saves 12 KiB
 * of ROM on a Cortex-M4F. 0 in a build without trees. */
#ifndef LMB_LIVE
#define LMB_LIVE LMB_TREES
#endif

/* Chunks of sixteen nodes of a point's cut (lambent/live.h), 64 .. 512; 76 bytes each, in lmb_live_scratch. Full: near
 * nodes are used whole. Numbers under 512 are for pictures of about 160 x 120 px on small machines: samples of frames
 * are 16 and 8 px apart, and lmb_live, lmb_lattice and lmb_live_scratch take 2/3, 1/15 and 1/11 of the memory. */
#ifndef LMB_LIVE_CUT
#define LMB_LIVE_CUT 512
#endif
#define LMB_LIVE_SMALL (LMB_LIVE_CUT < 512)
#if LMB_LIVE_CUT < 64
#error "lambent: LMB_LIVE_CUT is too small"
#endif

/* 0: this build has no fixed-function drawing (lambent/draw.h). Saves 30 KiB of ROM on a Cortex-M4F. */
#ifndef LMB_DRAW
#define LMB_DRAW LMB_TREES
#endif

/* 1: draw.h draws only triangles and polygons, with depth, alpha, two texture stages and the 2D calls; states that use
 * more are refused: lines, points, polygon modes, patterns, stencil, logic op, fog, clip planes, depth offset, combined
 * stages, second and back colours, shaders, counts of passed pixels, positions with w. lmb_draw_light,
 * lmb_draw_fragment, lmb_draw_shares and lmb_draw_steps are missing. Saves 17 KiB of ROM on a Cortex-M4F. */
#ifndef LMB_DRAW_SMALL
#define LMB_DRAW_SMALL 0
#endif

/* 0: draws ignore a state's kernels. Builds whose plain C has one lane (no SSE2, NEON or simd128) never have them.
 * Saves 6 KiB of ROM for each backend. */
#ifndef LMB_DRAW_KERNELS
#define LMB_DRAW_KERNELS (LMB_DRAW && !LMB_DRAW_SMALL)
#endif

/* 0: this build has no probes (lambent/probe.h). Saves 6 KiB of ROM on a Cortex-M4F. */
#ifndef LMB_PROBES
#define LMB_PROBES 1
#endif

/* Builds that evaluate materials' glossy lobes. */
#define LMB_LOBES (LMB_TREES || LMB_PROBES)

/* Positions whose cubes an lmb_probe_cache holds: 36 bytes each. When full, the least recently used one is replaced. */
#ifndef LMB_MAX_PROBES
#define LMB_MAX_PROBES 64
#endif

/* 0: this build has no voxels and cones (lambent/voxel.h). Saves 10 KiB of ROM on a Cortex-M4F. */
#ifndef LMB_VOXELS
#define LMB_VOXELS 1
#endif

/* 0: this build has no mixed reality (lambent/mixed.h, lambent/env.h). Saves 20 KiB of ROM on a Cortex-M4F. */
#ifndef LMB_MIXED
#define LMB_MIXED 1
#endif

/* Planes that are found in one picture. 100 bytes each, in lmb_planes. When full, the smaller planes stay ordinary
 * surface. */
#ifndef LMB_MAX_PLANES
#define LMB_MAX_PLANES 24
#endif

/* 0: this build has no reliefs (lambent/relief.h). Saves about 10 KiB of ROM on a Cortex-M4F. */
#ifndef LMB_RELIEF
#define LMB_RELIEF 1
#endif

/* 0: this build draws every frame whole: it skips no stage and reuses nothing of the last frame. It has no
 * lmb_render_reuse and no lambent/plan.h. */
#ifndef LMB_PLAN
#define LMB_PLAN LMB_BOUNCE
#endif
#if LMB_PLAN && !LMB_BOUNCE
#error "lambent: LMB_PLAN needs LMB_BOUNCE"
#endif

/* 0: this build has no baked light transfer (lambent/transfer.h). Saves about 6 KiB of ROM on a Cortex-M4F. The default
 * is 1 only in builds with trees, but you can set it to 1 in any build. */
#ifndef LMB_TRANSFER
#define LMB_TRANSFER LMB_TREES
#endif

/* 0: textures and vertex colours must be RGBA8; scenes with other formats are refused. Saves 0.4 KiB of ROM on a
 * Cortex-M4F. */
#ifndef LMB_TEXTURE_FORMATS
#define LMB_TEXTURE_FORMATS LMB_TREES
#endif

/* 0: this build has no packed scenes (lambent/pack.h). */
#ifndef LMB_PACK
#define LMB_PACK 1
#endif

/* 0: this build has no anti-aliasing: one sample a pixel. */
#ifndef LMB_MULTISAMPLE
#define LMB_MULTISAMPLE LMB_TREES
#endif

/* 0: this build has no lmb_draw_culled and no bins, and fills 16-bit depth and alpha masks by slower code with the same
 * bytes. */
#ifndef LMB_CULLING
#define LMB_CULLING LMB_TREES
#endif

/* Reference views of one relief. 168 bytes each, in lmb_relief. A file with more is refused. */
#ifndef LMB_RELIEF_VIEWS
#ifdef LMB_CONFIG_TINY
#define LMB_RELIEF_VIEWS 16
#else
#define LMB_RELIEF_VIEWS 64
#endif
#endif

#define LMB_RELIEF_TILE_VIEWS 8 /* maximum number of reference views that one tile reads */

/* Planes of a convex room, 24 bytes each in lmb_bvh. A room with more planes is not recognised: its BVH is traversed
 * although nothing in it blocks. */
#ifdef LMB_CONFIG_TINY
#define LMB_HULL_PLANES 6
#else
#define LMB_HULL_PLANES 16
#endif

/* Limits of the arithmetic, not of memory: src/raster/setup.c lists the code that depends on them. */
#define LMB_MAX_SIDE 8192       /* px of a surface's side; draw larger frames in windows */
#define LMB_MAX_FRAME 16384     /* px of a frame's side, over all windows */
#define LMB_TILE 8              /* px of a tile's side; a band is LMB_TILE rows */
#define LMB_TILE_PIXELS 64      /* LMB_TILE * LMB_TILE */
#define LMB_CUT_BLOCK 64        /* nodes of a cut that are prepared for the gather together */
/* Nodes of a cut whose bounds are computed side by side, 92 bytes of lmb_cut each: as many as the widest backend has
 * lanes, and at least four, the children of one node. */
#ifdef LMB_CONFIG_TINY
#define LMB_BOUNDS_NODES 4
#else
#define LMB_BOUNDS_NODES 16
#endif
/* Triangles of a tile that are resolved side by side, 180 bytes of lmb_tile each: as many as the widest backend has
 * lanes. */
#ifdef LMB_CONFIG_TINY
#define LMB_SLOTS 4
#else
#define LMB_SLOTS 16
#endif
#define LMB_MAX_TRIANGLES 0x7fffffff /* of a scene: ids are 1 .. LMB_MAX_TRIANGLES */

#if LMB_MAX_GROUPS < 1 || LMB_MAX_LIGHTS < 1 || LMB_MAX_CUT < 6 * LMB_MAX_LIGHTS || LMB_MANY_LIGHTS_CUT < 16
#error "lambent: a capacity in config.h is too small"
#endif

/* A program and a library built with different capacities do not link. */
#include "layout.h"

#endif
