/* hard_stage.h: a scene for hard cases, built in code: drawn and lit by the library, and traced by rays in double. */
#ifndef HARD_STAGE_H
#define HARD_STAGE_H

#include <lambent/lambent.h>

#include "../common/dvec.h"

enum { HARD_TRIANGLES = 12288, HARD_PARTS = 4, HARD_SIDE = 64, HARD_MAP = 512, HARD_FACES = 6, HARD_TREE = 256 };

typedef struct hard_stage {
    const lmb_kernels *kernels;
    /* The scene: parts of loose triangles, with one material per part. Triangle ids count from 1, in order. */
    float corner[HARD_TRIANGLES][3][3], uv[HARD_TRIANGLES][3][2];
    dvec world[HARD_TRIANGLES][3]; /* corners in world space */
    uint32_t count, first[HARD_PARTS];
    uint32_t parts;
    lmb_mesh mesh[HARD_PARTS];
    lmb_material material[HARD_PARTS];
    lmb_instance instance[HARD_PARTS];
    lmb_texture texture; /* texels NULL: none */
    lmb_light light;
    lmb_scene scene;
    lmb_view view; /* square, HARD_SIDE px at most */
    /* Results of the library. */
    uint32_t depth[HARD_SIDE * HARD_SIDE], id[HARD_SIDE * HARD_SIDE]; /* tiled: hard_at */
    float out[HARD_SIDE * HARD_SIDE * 3];
    lmb_target eye;
    lmb_shadow_map map;
    lmb_tile tile;
    lmb_irradiance lit;
    lmb_band_scratch scratch;
    lmb_render render;
    lmb_stats stats;
    const lmb_transfer *transfer; /* NULL: bounced light by cuts */
    lmb_transfer_light transfer_light;
    int32_t gather_step; /* 0: every pixel */
    int32_t tree_size;   /* first points per side; 0: the map's, HARD_TREE at most */
    lmb_live live;
    lmb_live_scratch live_scratch;
    void *map_memory, *tree_memory, *bvh_memory, *lattice_memory, *live_memory;
    size_t map_bytes, tree_bytes, bvh_bytes, lattice_bytes, live_bytes;
} hard_stage;

/* Returns NULL if memory is short. */
hard_stage *hard_stage_make(const lmb_kernels *kernels);
void hard_stage_free(hard_stage *s);

/* --- the scene ---------------------------------------------------------------------------------------------------- */

/* Starts an empty scene with one white double-sided part of this reflectance. */
void hard_begin(hard_stage *s, double albedo);
/* Starts another part. Returns its number. */
uint32_t hard_part(hard_stage *s, double albedo);
void hard_triangle(hard_stage *s, dvec a, dvec b, dvec c);
/* Half sides u and v; the front is u x v; texture coordinates 0 .. 1 from -u -v to +u +v. */
void hard_quad(hard_stage *s, dvec centre, dvec u, dvec v);
void hard_box(hard_stage *s, dvec centre, dvec half);
void hard_ball(hard_stage *s, dvec centre, double radius, int slices);
/* Turns a part into a screen: every other of side x side squares is a hole. texels: 4 side^2 bytes, written; keep them
 * until the next hard_begin. */
void hard_holes(hard_stage *s, uint32_t part, uint8_t *texels, int side);
/* Finishes the scene: ids, bounds, checks. You may call it again after a change. Returns 1, or 0 if the library refuses
 * the scene. */
int hard_end(hard_stage *s);

void hard_spot(hard_stage *s, dvec at, dvec towards, double outer_deg, double intensity);
void hard_point(hard_stage *s, dvec at, double intensity);
void hard_sun(hard_stage *s, dvec along, double irradiance);

/* --- drawing by the library --------------------------------------------------------------------------------------- */

void hard_look(hard_stage *s, dvec from, dvec target, double fov_deg, int32_t side);
/* 1 px is a metre; the frame's middle is at (0, 0); depth from z = -1 (d = 1) to z = -2 (d = 0). */
void hard_look_flat(hard_stage *s, int32_t side);
/* Clears, then draws `count` triangles from number `first` (0) on; UINT32_MAX: all. */
void hard_draw(hard_stage *s, uint32_t first, uint32_t count);
size_t hard_at(const hard_stage *s, int32_t x, int32_t y);
float hard_depth(const hard_stage *s, int32_t x, int32_t y);
/* Draws the shadow map, size texels per side. */
void hard_map(hard_stage *s, int32_t size);
/* Resolves and lights the tile at (x, y), after you have called hard_draw and hard_map. */
void hard_direct(hard_stage *s, int32_t x, int32_t y);
/* Draws a whole frame into s->out: cuts of a tree of `map` texels, occlusion by all triangles. Returns the library's
 * status. */
lmb_status hard_frame(hard_stage *s, int32_t show, int32_t map, float error);

/* --- rays in double ----------------------------------------------------------------------------------------------- */

/* The ray from the eye through a position in the frame, px; w = 1 along the view's axis. */
dvec hard_ray(dvec *from, const lmb_view *v, double x, double y);
/* The point at which pixel (x, y) meets the plane of triangle `id`, and the normal there, towards the viewer. */
dvec hard_surface(dvec *normal, const hard_stage *s, int32_t x, int32_t y, uint32_t id);
/* Form factor of a convex polygon of up to 8 corners from a surface element, clipped by the horizon; of either side. */
double hard_true_factor(dvec at, dvec normal, const dvec *corner, int count);
/* Does a triangle other than `a` and `b` (ids, 0: none) intersect the segment strictly between the ends? */
int hard_occluded(const hard_stage *s, dvec from, dvec to, uint32_t a, uint32_t b);
/* Direct irradiance on a surface, one channel, with shadows by rays; id: the surface's triangle. */
double hard_true_direct(const hard_stage *s, dvec at, dvec normal, uint32_t id);
/* Irradiance by one bounce: each triangle is divided into n x n cells, with visibility by rays. Relative error: about
 * (a cell's side / distance)^2. */
double hard_true_bounce(const hard_stage *s, dvec at, dvec normal, uint32_t id, int n);

/* --- random numbers, portable ------------------------------------------------------------------------------------- */

uint32_t hard_random(uint64_t *state);
double hard_uniform(uint64_t *state, double low, double high);
dvec hard_direction(uint64_t *state);

#endif
