/* mixed.h: a virtual object in one photo with depth: the real surfaces, where the object stands, its effect on them.
 * [M1-M24]
 *
 *     lmb_cloud_init(&cloud, &camera, depth, memory, bytes);      points, noise                             [M1]
 *     lmb_cloud_normals(&cloud, 0, camera.height);                normals                                   [M2]
 *     lmb_planes_find(&planes, &cloud, memory, bytes);            planes and whose each pixel is            [M3 M4]
 *     lmb_real_mesh_build(&mesh, &cloud, &planes, 4, ...);        the real scene as triangles               [M4]
 *     lmb_env_fold(&env, photo, width, height);                   light from where no picture is            [M14-M19]
 *     per tile: lmb_real_tile, direct light with and without the object, lmb_delta_tile                     [M23 M24]
 *
 * Clouds and planes are in the camera's own space: metres, it stands at 0, x to the right, y up, and looks down -z.
 * What is drawn and lit is in the scene's, which is the same turned about the camera, so that the object's floor is
 * level (lmb_axes_upright): voxels then keep the floor's light apart from what stands on it.
 *
 * Stability: experimental. Tags like [M1] are requirements in src/SOURCES.md. */
#ifndef LMB_MIXED_H
#define LMB_MIXED_H

#include "compose.h"
#include "voxel.h"

/* A camera with square or other pixels, their centres at whole numbers: column = fx x / z + cx, row = fy y / z + cy,
 * with z ahead and y down. */
typedef struct lmb_pinhole {
    int32_t width, height; /* px, 1 .. LMB_MAX_SIDE */
    float fx, fy, cx, cy;  /* px; fx, fy over 0 */
} lmb_pinhole;

/* The camera's axes in the scene's space. */
typedef struct lmb_axes {
    lmb_vec3 right, up, back;
} lmb_axes;

/* Depth as points, in the caller's memory, 16 bytes a pixel. Planes are affine in 1 / distance over the picture, and
 * what sensors that measure by disparity get wrong is about even in it: so distances are kept, fitted and compared as
 * their inverses. */
typedef struct lmb_cloud {
    lmb_pinhole camera;
    float *inverse;   /* 1/m along the axis, by pixel; 0: not measured */
    lmb_vec3 *normal; /* unit, towards the camera; 0, 0, 0: unknown */
    float noise;      /* 1/m: standard deviation of `inverse`, beside a millimetre of distance */
} lmb_cloud;

/* A flat part of the real scene: points p with normal . p = -distance. */
typedef struct lmb_flat {
    lmb_vec3 normal;              /* unit, towards the camera */
    float distance;               /* of the camera from it, m, over 0 */
    float slope[3];               /* 1 / distance of pixel (x, y) is slope . (x', y', 1): see lmb_cloud_ray */
    lmb_vec3 centre;              /* the mean of its surface                                                  [M5] */
    lmb_vec3 across, along;       /* unit, in it: level with the camera's x; normal x across */
    float low[2], high[2];        /* m from the centre, across and along: the box of its pixels */
    int32_t pixels;
    int32_t x0, y0, x1, y1;       /* px: the box of them, x1 and y1 behind the last */
} lmb_flat;

typedef struct lmb_planes {
    lmb_flat plane[LMB_MAX_PLANES]; /* the largest picture first */
    int32_t count;
    uint8_t *label;  /* by pixel: 1 + its plane, or 0; holes inside a plane are its own */
    int32_t *queue;  /* scratch */
} lmb_planes;

/* The real scene as one mesh: a flat square a cell of pixels, two triangles each. In the caller's memory. */
typedef struct lmb_real_mesh {
    float *positions;    /* 3 x 4 a cell */
    uint8_t *colours;    /* RGBA8 x 4 a cell: albedo, linear */
    uint32_t *indices;   /* 6 a cell */
    uint8_t *label;      /* a cell: 1 + its plane, or 0 */
    int32_t *cell;       /* of each step x step pixels: its cell, or -1 */
    int32_t step, columns, rows, count; /* px; cells a row and rows of the picture; cells that are there */
    int32_t plane_cell[LMB_MAX_PLANES]; /* one of each plane's, or -1 */
} lmb_real_mesh;

/* First points that are lit again. 9 KiB. */
typedef struct lmb_around_scratch {
    lmb_tile tile;
    lmb_irradiance before, now;
    size_t first[LMB_TILE_PIXELS + 1]; /* of each answer's points, and where the next one would begin */
    int32_t count;
} lmb_around_scratch;

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_cloud_bytes: memory of a cloud; 0 for a bad size. */
size_t lmb_cloud_bytes(int32_t width, int32_t height);

/* lmb_cloud_init: distances as points.                                                                        [M1]
 *
 *   depth_m  width x height along the camera's axis, rows from the top; what is not in 0.01 .. 1000 m is not measured
 * The noise is asked of the picture itself: of second differences, which planes have none of. Normals are unknown
 * before lmb_cloud_normals. Returns LMB_OK, LMB_ERR_ARG, LMB_ERR_ALIGN or LMB_ERR_CAPACITY. */
lmb_status lmb_cloud_init(lmb_cloud *out, const lmb_pinhole *camera, const float *depth_m, void *memory, size_t bytes);

/* lmb_axes_upright: the scene's space in which `up` (unit, the camera's space) is +y, and the camera looks about -z.
 * lmb_axes_turn: a vector of the camera's space in it. */
lmb_axes lmb_axes_upright(lmb_vec3 up);
lmb_vec3 lmb_axes_turn(const lmb_axes *axes, lmb_vec3 v);

/* lmb_cloud_ray: the ray of pixel (x, y): (x', y', -1). Its point is that times the distance. */
lmb_vec3 lmb_cloud_ray(const lmb_pinhole *camera, float x, float y);

/* lmb_cloud_point: what was measured at a pixel; 0, 0, 0 for nothing. */
lmb_vec3 lmb_cloud_point(const lmb_cloud *cloud, int32_t x, int32_t y);

/* lmb_cloud_sigma: standard deviation of an inverse distance, 1/m. */
float lmb_cloud_sigma(const lmb_cloud *cloud, float inverse);

/* lmb_cloud_normals: the plane through each point and what surrounds it, in two rounds: what a surface of 75 degrees or
 * less can reach, then what lies on the first round's plane. Fewer than 6 points: unknown.                       [M2]
 *
 *   y0, y1  rows y0 .. y1 - 1, of those that there are: any rows on any threads at once
 * Returns LMB_OK or LMB_ERR_ARG. Cost: 2 x 49 points a pixel. */
lmb_status lmb_cloud_normals(const lmb_cloud *cloud, int32_t y0, int32_t y1);

/* lmb_planes_bytes: memory of the search, 5 bytes a pixel; 0 for a bad size. */
size_t lmb_planes_bytes(int32_t width, int32_t height);

/* lmb_planes_find: the planes of a cloud with normals.                                                      [M3 M4 M5]
 *
 * Grown from points whose nearest all face the same way, over points within 4.5 standard deviations, fitted again as
 * they double, joined where they are one, and fitted to what is left within 4 deviations. A plane has at least one
 * pixel of 256 of the picture, and 32. None is LMB_OK with count 0. Returns LMB_OK, LMB_ERR_ARG, LMB_ERR_ALIGN or
 * LMB_ERR_CAPACITY. Cost: some 60 operations a pixel. */
lmb_status lmb_planes_find(lmb_planes *out, const lmb_cloud *cloud, void *memory, size_t bytes);

/* lmb_planes_up: which way is up, unit, in the camera's space. A photo does not know; the camera's own up is a guess, and
 * within 70 degrees of it a better one is what most of the planes agree with as floors, ceilings or walls. Cost: each pair of
 * planes asks all. */
lmb_vec3 lmb_planes_up(const lmb_planes *planes);

/* lmb_planes_floor: the plane that an object would stand on: the one with the largest picture of those that face up:
 * within 25 degrees of lmb_planes_up and 70 of the camera's up, the less the more it turns away. -1 where none does. */
int32_t lmb_planes_floor(const lmb_planes *planes);

/* lmb_planes_anchor: where on plane p the ray of pixel (x, y) meets it. 0 where it does not. */
int lmb_planes_anchor(lmb_vec3 *out, const lmb_planes *planes, const lmb_pinhole *camera, int32_t p, float x, float y);

/* lmb_planes_clear: where on plane p a cylinder stands free: the picture shows nothing but the plane at its foot, has
 * room for all of it, and nothing that was measured is in front of it. The plane's centre where that is so, else the
 * place nearest to it, by pixels in steps of four. The centre is not from the source, but things stand there. 0 where
 * there is none.                                                                                                [M5]
 *
 *   radius_m, height_m   the cylinder's; height 0 asks for its foot alone */
int lmb_planes_clear(lmb_vec3 *out, const lmb_planes *planes, const lmb_cloud *cloud, int32_t p, float radius_m,
                     float height_m);

/* lmb_planes_move: move the cloud's points onto their planes, and fill the holes inside them.                   [M4] */
void lmb_planes_move(const lmb_cloud *cloud, const lmb_planes *planes);

/* lmb_real_mesh_bytes: memory of the real scene's mesh, 96 bytes a cell of step x step pixels; 0 for a bad size. */
size_t lmb_real_mesh_bytes(int32_t width, int32_t height, int32_t step);

/* lmb_real_mesh_build: a square for each cell of pixels that mostly have a surface.                             [M4]
 *
 *   cloud   with normals, moved onto its planes
 *   step    px, 1 .. 64
 * Cells of one plane meet without a gap, for their corners are the same numbers; others' squares go through their mean
 * point along their mean normal, and leave cracks. Colours are white: lmb_real_mesh_colour. Returns LMB_OK,
 * LMB_ERR_ARG, LMB_ERR_ALIGN or LMB_ERR_CAPACITY. */
lmb_status lmb_real_mesh_build(lmb_real_mesh *out, const lmb_cloud *cloud, const lmb_planes *planes, int32_t step,
                               const lmb_axes *axes, void *memory, size_t bytes);

/* lmb_real_mesh_draw: it as a mesh of a scene. Its triangles 2 c and 2 c + 1 are cell c. */
lmb_mesh lmb_real_mesh_draw(const lmb_real_mesh *mesh);

/* lmb_real_mesh_colour: the albedo of cell c. */
void lmb_real_mesh_colour(const lmb_real_mesh *mesh, int32_t c, const float albedo[3]);

/* lmb_photo_view: the view whose frame holds the photo's pixel (0, 0) as its pixel (*x0, *y0), multiples of LMB_TILE.
 * Frames' axes go through their middles, so this one reaches farther than the photo on one side. cx and cy count to
 * half a pixel: round them first, that rays are the same. LMB_OK or LMB_ERR_ARG.
 * lmb_pinhole_round: cx and cy to the nearest half pixel. */
lmb_status lmb_photo_view(lmb_view *out, int32_t *x0, int32_t *y0, const lmb_pinhole *camera, const lmb_axes *axes);
void lmb_pinhole_round(lmb_pinhole *camera);

/* lmb_real_tile: the real surfaces of 8 x 8 pixels from (x, y) of the photo on, as if they had been drawn: planes where
 * their pixels are, else cells, else single points. tile->x and y are the photo's. id: of a triangle of the mesh, which
 * is the scene's first instance. LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_real_tile(lmb_tile *out, const lmb_cloud *cloud, const lmb_planes *planes, const lmb_real_mesh *mesh,
                         const lmb_axes *axes, int32_t x, int32_t y);

/* lmb_env_fold: the cube that one picture allows.                                                      [M14-M19]
 *
 *   rgb  width x height x 3, linear, rows from the top
 * The picture is cut into thirds. Its middle is what lies ahead (-z) and, turned over, behind (+z); what is left of the
 * middle, right of it, over and under it are the sides. Not from the source: each side takes its whole edge of the
 * picture, widening from the middle outwards, so that nothing is left over and the five faces meet without a seam. LMB_OK or
 * LMB_ERR_ARG. */
lmb_status lmb_env_fold(const lmb_env *env, const float *rgb, int32_t width, int32_t height, const lmb_axes *axes);

/* lmb_env_irradiance: W/m2 that a surface facing `normal` gets, nothing being in the way: pi times the mean of a
 * cone. */
void lmb_env_irradiance(float out[3], const lmb_env *env, lmb_vec3 normal);

/* lmb_two_maps: a light's shadow maps without [0] and with [1] the object: the same views, so that each texel stands
 * for the same incident power in both.                                                                             [M9]
 *
 *   scene  of both: the real mesh is its first instance, the object's come after it
 *   bytes  of memory: twice lmb_shadow_map_bytes
 * Clear both (lmb_shadow_map_clear), then draw the real mesh's ids into the first and all into the second
 * (lmb_shadow_map_draw). Returns LMB_OK or LMB_ERR_ARG, or what lmb_shadow_map_init does. */
lmb_status lmb_two_maps(lmb_shadow_map maps[2], const lmb_light *light, const lmb_scene *scene, int32_t size,
                        void *memory, size_t bytes);

/* lmb_around_points: light of `env` that triangles reflect, with nothing in its way, as first points that
 * lmb_voxels_inject takes beside those of the shadow maps.                                                      [M7]
 *
 *   leaf  m: triangles are divided until their parts are no longer than that, or 64 to a side
 * By this light and the lights' real surfaces emit light about as the photo has them. Returns how many points there
 * are; `cap` of them are written, 0 to ask.
 *
 * lmb_around_gather, lmb_around_scale: the same points by what reaches them through voxels, so that light
 * which the object blocks and reflects is bounced again. Points from `from` on become scratch->tile, 64 answers at
 * most: those that follow each other, face one way and lie within near_m, or 0.15 of their distance from `about`, have
 * one. The caller adds what they get without and with the object to scratch->before and ->now (lmb_cones_diffuse); then
 * each flux is scaled by the share of the second to the first. Where `env` is given, to its light with nothing in the
 * way. lmb_around_gather returns the first point that it did not take, lmb_around_scale LMB_OK or LMB_ERR_ARG. */
size_t lmb_around_points(lmb_texel *out, size_t cap, const lmb_scene *scene, uint32_t first_id, uint32_t count,
                         float leaf, const lmb_env *env);
size_t lmb_around_gather(lmb_around_scratch *out, const lmb_texel *points, size_t from, size_t count, float near_m,
                         lmb_vec3 about);
lmb_status lmb_around_scale(lmb_texel *inout, const lmb_around_scratch *scratch, const lmb_env *env);

/* lmb_real_albedo: what a surface must reflect to look as the photo has it: pi x radiance / irradiance, within
 * LMB_ALBEDO_MIN .. LMB_ALBEDO_MAX; 0.5 where there is no irradiance. */
#define LMB_ALBEDO_MIN 0.02f
#define LMB_ALBEDO_MAX 0.95f
float lmb_real_albedo(float radiance, float irradiance);

/* lmb_delta_tile: the photo with what the object changes on real surfaces.                              [M23 M24]
 *
 *   inout    the photo's radiance; where without and with are equal it stays as it is, bit for bit
 *   without, with   irradiance
 * More light adds albedo / pi x (with - without), of the albedo that `without` and the photo tell; less takes the same
 * share from the photo as from the light. Pixels without a surface stay. LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_delta_tile(lmb_radiance *inout, const lmb_tile *real, const lmb_irradiance *without,
                          const lmb_irradiance *with);

/* lmb_mirror_tile: add what a varnish on plane p (-1: on every plane) shows of the object and hides behind it:
 * Schlick's share of with - without; what it hides is at most half of the photo.                          [M20 M24]
 *
 *   without, with  what narrow cones along the mirrored view see: lmb_cones_glossy
 *   specular       share where the surface faces the camera; LMB_OK or LMB_ERR_ARG */
lmb_status lmb_mirror_tile(lmb_radiance *inout, const lmb_tile *real, const lmb_planes *planes,
                           const lmb_pinhole *camera, int32_t p, const lmb_cone_seen *without,
                           const lmb_cone_seen *with, float specular);

/* lmb_object_tile: put the object's pixels over the photo's, where nothing real is in front of them.          [M24]
 *
 *   object, real  tiles of the same pixels
 *   cloud         its noise: what is not nearer than two deviations does not hide
 * Returns the pixels that show the object, a bit each. */
uint64_t lmb_object_tile(lmb_radiance *inout, const lmb_radiance *light, const lmb_tile *object, const lmb_tile *real,
                         const lmb_cloud *cloud);

#ifdef __cplusplus
}
#endif
#endif
