/* mixed.h: a virtual object in one photo with depth: the real surfaces, a place for the object, its effect on the
 * photo. [M1-M24]
 *
 *     lmb_cloud_init(&cloud, &camera, depth, memory, bytes);      points, noise                             [M1]
 *     lmb_cloud_normals(&cloud, 0, camera.height);                normals                                   [M2]
 *     lmb_planes_find(&planes, &cloud, memory, bytes);            planes, and the plane of each pixel       [M3 M4]
 *     lmb_real_mesh_build(&mesh, &cloud, &planes, 4, ...);        the real scene as triangles               [M4]
 *     lmb_env_fold(&env, photo, width, height);                   light from outside the picture            [M14-M19]
 *     per tile: lmb_real_tile, direct light with and without the object, lmb_delta_tile                     [M23 M24]
 *
 * Clouds and planes are in camera space: metres, the camera at 0, x to the right, y up, view along -z. Draw and light
 * in scene space: camera space rotated about the camera so that the object's floor is level (lmb_axes_upright). Voxels
 * then separate the floor's light from that of objects on it.
 *
 * Stability: experimental. Tags like [M1] are requirements in src/SOURCES.md. */
#ifndef LMB_MIXED_H
#define LMB_MIXED_H

#include "compose.h"
#include "voxel.h"

/* A camera with square or other pixels, centres at whole numbers: column = fx x / z + cx, row = fy y / z + cy, with z
 * ahead and y down. */
typedef struct lmb_pinhole {
    int32_t width, height; /* px, 1 .. LMB_MAX_SIDE */
    float fx, fy, cx, cy;  /* px; fx, fy over 0 */
} lmb_pinhole;

/* The camera's axes in the scene's space. */
typedef struct lmb_axes {
    lmb_vec3 right, up, back;
} lmb_axes;

/* Depth as points, in your memory, 16 bytes a pixel. Planes are affine in 1 / distance over the picture, and the error
 * of sensors that measure disparity is about constant in it. So distances are stored, fitted and compared as their
 * inverses. */
typedef struct lmb_cloud {
    lmb_pinhole camera;
    float *inverse;   /* 1/m along the axis, by pixel; 0: not measured */
    lmb_vec3 *normal; /* unit, towards the camera; 0, 0, 0: unknown */
    float noise;      /* 1/m: standard deviation of `inverse`, in addition to a millimetre of distance */
} lmb_cloud;

/* A flat part of the real scene: points p with normal . p = -distance. */
typedef struct lmb_flat {
    lmb_vec3 normal;              /* unit, towards the camera */
    float distance;               /* of the camera from the plane, m, over 0 */
    float slope[3];               /* 1 / distance of pixel (x, y) is slope . (x', y', 1): see lmb_cloud_ray */
    lmb_vec3 centre;              /* the mean of the surface                                                  [M5] */
    lmb_vec3 across, along;       /* unit, in the plane: `across` is level with the camera's x; along = normal x
                                     across */
    float low[2], high[2];        /* m from the centre, across and along: the box of the pixels */
    int32_t pixels;
    int32_t x0, y0, x1, y1;       /* px: their box, x1 and y1 one past the last */
} lmb_flat;

typedef struct lmb_planes {
    lmb_flat plane[LMB_MAX_PLANES]; /* the one with most pixels first */
    int32_t count;
    uint8_t *label;  /* by pixel: 1 + its plane, or 0; a hole inside a plane belongs to it */
    int32_t *queue;  /* scratch */
} lmb_planes;

/* The real scene as one mesh: a flat square for each cell of pixels, two triangles each. In your memory. */
typedef struct lmb_real_mesh {
    float *positions;    /* 3 x 4 a cell */
    uint8_t *colours;    /* RGBA8 x 4 a cell: albedo, linear */
    uint32_t *indices;   /* 6 a cell */
    uint8_t *label;      /* per cell: 1 + its plane, or 0 */
    int32_t *cell;       /* per block of step x step pixels: its cell, or -1 */
    int32_t step, columns, rows, count; /* px; cells a row and rows of the picture; cells in use */
    int32_t plane_cell[LMB_MAX_PLANES]; /* one cell of each plane, or -1 */
} lmb_real_mesh;

/* First points that are lit again. 9 KiB. */
typedef struct lmb_around_scratch {
    lmb_tile tile;
    lmb_irradiance before, now;
    size_t first[LMB_TILE_PIXELS + 1]; /* first point of each answer, and one past the last */
    int32_t count;
} lmb_around_scratch;

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_cloud_bytes: memory of a cloud; 0 for a bad size. */
size_t lmb_cloud_bytes(int32_t width, int32_t height);

/* lmb_cloud_init: points from distances.                                                                           [M1]
 *
 *   depth_m  width x height along the camera's axis, rows from the top; values outside 0.01 .. 1000 m count as not
 *            measured
 * The noise is estimated from the picture's second differences, which are 0 on planes. Normals are unknown before
 * lmb_cloud_normals. Returns LMB_OK, LMB_ERR_ARG, LMB_ERR_ALIGN or LMB_ERR_CAPACITY. */
lmb_status lmb_cloud_init(lmb_cloud *out, const lmb_pinhole *camera, const float *depth_m, void *memory, size_t bytes);

/* lmb_axes_upright: the scene space with `up` (unit, in camera space) as +y, and the camera's view about along -z.
 * lmb_axes_turn: transform a vector from camera space to scene space. */
lmb_axes lmb_axes_upright(lmb_vec3 up);
lmb_vec3 lmb_axes_turn(const lmb_axes *axes, lmb_vec3 v);

/* lmb_cloud_ray: the ray (x', y', -1) of pixel (x, y). The pixel's point is the ray times the distance. */
lmb_vec3 lmb_cloud_ray(const lmb_pinhole *camera, float x, float y);

/* lmb_cloud_point: the point measured at a pixel; 0, 0, 0 for none. */
lmb_vec3 lmb_cloud_point(const lmb_cloud *cloud, int32_t x, int32_t y);

/* lmb_cloud_sigma: standard deviation of an inverse distance, 1/m. */
float lmb_cloud_sigma(const lmb_cloud *cloud, float inverse);

/* lmb_cloud_normals: fit a plane through each point and its neighbours, in two rounds: first those that a surface
 * tilted by 75 degrees or less can reach, then those on the first round's plane. Fewer than 6 points: unknown. [M2]
 *
 *   y0, y1  rows y0 .. y1 - 1, clipped to the picture: any rows on any threads at once
 * Returns LMB_OK or LMB_ERR_ARG. Cost: 2 x 49 points a pixel. */
lmb_status lmb_cloud_normals(const lmb_cloud *cloud, int32_t y0, int32_t y1);

/* lmb_planes_bytes: memory of lmb_planes_find, 5 bytes a pixel; 0 for a bad size. */
size_t lmb_planes_bytes(int32_t width, int32_t height);

/* lmb_planes_find: find the planes of a cloud with normals. [M3 M4 M5]
 *
 * A plane grows from points whose nearest neighbours all face the same way, over points within 4.5 standard deviations,
 * and is fitted again each time they double. Planes that match are joined, and each plane is fitted once more to those
 * of its points within 4 deviations. A plane has at least 1/256 of the picture's pixels, and at least 32. If there is
 * none, the call returns LMB_OK with count 0.
 * Returns LMB_OK, LMB_ERR_ARG, LMB_ERR_ALIGN or LMB_ERR_CAPACITY. Cost: some 60 operations a pixel. */
lmb_status lmb_planes_find(lmb_planes *out, const lmb_cloud *cloud, void *memory, size_t bytes);

/* lmb_planes_up: estimate the up direction, unit, in camera space. The camera's own up is the first guess. The result
 * lies within 70 degrees of it and fits most planes as floors, ceilings or walls. Cost: planes^3. */
lmb_vec3 lmb_planes_up(const lmb_planes *planes);

/* lmb_planes_floor: the plane for an object to stand on: the one with most pixels among those that face up, within 25
 * degrees of lmb_planes_up and 70 of the camera's up; pixels count less the more it tilts. -1 if there is none. */
int32_t lmb_planes_floor(const lmb_planes *planes);

/* lmb_planes_anchor: the point at which the ray of pixel (x, y) hits plane p. Returns 0 if it does not. */
int lmb_planes_anchor(lmb_vec3 *out, const lmb_planes *planes, const lmb_pinhole *camera, int32_t p, float x, float y);

/* lmb_planes_clear: a place on plane p for a cylinder: the picture shows only the plane at the foot, has room for all
 * of it, and nothing measured is in front of it. The result is the plane's centre if it is clear, else the clear place
 * nearest to it, by pixels in steps of four. The source does not use the centre, but objects often stand there. Returns
 * 0 if there is no clear place. [M5]
 *
 *   radius_m, height_m   of the cylinder; height 0 tests only the foot */
int lmb_planes_clear(lmb_vec3 *out, const lmb_planes *planes, const lmb_cloud *cloud, int32_t p, float radius_m,
                     float height_m);

/* lmb_planes_move: move the cloud's points onto their planes, and fill the holes inside them.                   [M4] */
void lmb_planes_move(const lmb_cloud *cloud, const lmb_planes *planes);

/* lmb_real_mesh_bytes: memory of the real scene's mesh, 96 bytes a cell of step x step pixels; 0 for a bad size. */
size_t lmb_real_mesh_bytes(int32_t width, int32_t height, int32_t step);

/* lmb_real_mesh_build: a square for each cell in which most pixels have a surface.                                 [M4]
 *
 *   cloud   with normals, moved onto the planes
 *   step    px, 1 .. 64
 * Cells of one plane share exact corners and meet without a gap; other squares go through their mean point along their
 * mean normal, and leave cracks. Colours are white: set them with lmb_real_mesh_colour. Returns LMB_OK, LMB_ERR_ARG,
 * LMB_ERR_ALIGN or LMB_ERR_CAPACITY. */
lmb_status lmb_real_mesh_build(lmb_real_mesh *out, const lmb_cloud *cloud, const lmb_planes *planes, int32_t step,
                               const lmb_axes *axes, void *memory, size_t bytes);

/* lmb_real_mesh_draw: the real mesh as an lmb_mesh for a scene. Triangles 2 c and 2 c + 1 are cell c. */
lmb_mesh lmb_real_mesh_draw(const lmb_real_mesh *mesh);

/* lmb_real_mesh_colour: set the albedo of cell c. */
void lmb_real_mesh_colour(const lmb_real_mesh *mesh, int32_t c, const float albedo[3]);

/* lmb_photo_view: a view whose frame holds the photo's pixel (0, 0) at pixel (*x0, *y0), multiples of LMB_TILE. The
 * axis of a view goes through the frame's middle, so the frame extends beyond the photo on one side. cx and cy count to
 * half a pixel: round them first, so that the rays match. Returns LMB_OK or LMB_ERR_ARG.
 * lmb_pinhole_round: round cx and cy to the nearest half pixel. */
lmb_status lmb_photo_view(lmb_view *out, int32_t *x0, int32_t *y0, const lmb_pinhole *camera, const lmb_axes *axes);
void lmb_pinhole_round(lmb_pinhole *camera);

/* lmb_real_tile: the real surfaces of 8 x 8 pixels from (x, y) of the photo, as if drawn: planes at their pixels, else
 * cells, else single points. tile->x and y are the photo's. id: of a triangle of the mesh, which must be the scene's
 * first instance. Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_real_tile(lmb_tile *out, const lmb_cloud *cloud, const lmb_planes *planes, const lmb_real_mesh *mesh,
                         const lmb_axes *axes, int32_t x, int32_t y);

/* lmb_env_fold: an environment cube from one picture.                                                         [M14-M19]
 *
 *   rgb  width x height x 3, linear, rows from the top
 * The picture is cut into thirds. The middle third is the front face (-z) and, mirrored, the back face (+z); the parts
 * left of, right of, over and under the middle are the sides. Unlike the source, each side takes its whole edge of the
 * picture, widening outwards from the middle, so that no part is left over and the five faces meet without a seam.
 * Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_env_fold(const lmb_env *env, const float *rgb, int32_t width, int32_t height, const lmb_axes *axes);

/* lmb_env_irradiance: unoccluded irradiance of a surface that faces `normal`, W/m2: pi times the mean of a cone. */
void lmb_env_irradiance(float out[3], const lmb_env *env, lmb_vec3 normal);

/* lmb_two_maps: a light's shadow maps without [0] and with [1] the object. Both have the same views, so that a texel
 * has the same incident power in both.                                                                             [M9]
 *
 *   scene  of both: the real mesh is its first instance, the object's instances follow
 *   bytes  of memory: twice lmb_shadow_map_bytes
 * Clear both (lmb_shadow_map_clear), then draw the real mesh's ids into the first and all into the second
 * (lmb_shadow_map_draw). Returns LMB_OK, LMB_ERR_ARG, or an error of lmb_shadow_map_init. */
lmb_status lmb_two_maps(lmb_shadow_map maps[2], const lmb_light *light, const lmb_scene *scene, int32_t size,
                        void *memory, size_t bytes);

/* lmb_around_points: unoccluded light of `env` that triangles reflect, as first points for lmb_voxels_inject in
 * addition to those of the shadow maps.                                                                            [M7]
 *
 *   leaf  m: triangles are divided until their parts are no longer than that, or 64 to a side
 * With these points and the lights' first points, real surfaces emit about as much light as the photo shows. Returns
 * the number of points and writes at most `cap` of them; pass 0 to count.
 *
 * lmb_around_gather, lmb_around_scale: scale these points by the light that reaches them through voxels, so that light
 * which the object blocks and reflects is bounced again. Points from `from` on become scratch->tile, with at most 64
 * answers: consecutive points share an answer if they face one way and lie within near_m, or 0.15 of their distance
 * from `about`. Add their irradiance without and with the object to scratch->before and ->now (lmb_cones_diffuse);
 * lmb_around_scale then scales each flux by the ratio of the second to the first, or to the unoccluded light of `env`
 * if that is given, but at most by 4. lmb_around_gather returns the first point that it did not take, lmb_around_scale
 * LMB_OK or LMB_ERR_ARG. */
size_t lmb_around_points(lmb_texel *out, size_t cap, const lmb_scene *scene, uint32_t first_id, uint32_t count,
                         float leaf, const lmb_env *env);
size_t lmb_around_gather(lmb_around_scratch *out, const lmb_texel *points, size_t from, size_t count, float near_m,
                         lmb_vec3 about);
lmb_status lmb_around_scale(lmb_texel *inout, const lmb_around_scratch *scratch, const lmb_env *env);

/* lmb_real_albedo: the albedo at which a surface looks as in the photo: pi x radiance / irradiance, clamped to
 * LMB_ALBEDO_MIN .. LMB_ALBEDO_MAX; 0.5 if there is no irradiance. */
#define LMB_ALBEDO_MIN 0.02f
#define LMB_ALBEDO_MAX 0.95f
float lmb_real_albedo(float radiance, float irradiance);

/* lmb_delta_tile: add the object's effect on real surfaces to the photo.                                      [M23 M24]
 *
 *   inout    the photo's radiance; unchanged, bit for bit, if without and with are equal
 *   without, with   irradiance
 * More light adds albedo / pi x (with - without), with the albedo from `without` and the photo; less light scales the
 * photo by with / without. Pixels without a surface are unchanged. Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_delta_tile(lmb_radiance *inout, const lmb_tile *real, const lmb_irradiance *without,
                          const lmb_irradiance *with);

/* lmb_mirror_tile: add the object's reflection in a varnish on plane p (-1: on every plane), and remove the reflections
 * that it hides: Schlick's share of with - without. At most half of the photo is removed. [M20 M24]
 *
 *   without, with  the light in narrow cones along the mirrored view: lmb_cones_glossy
 *   specular       reflectance if the surface faces the camera. Returns LMB_OK or LMB_ERR_ARG */
lmb_status lmb_mirror_tile(lmb_radiance *inout, const lmb_tile *real, const lmb_planes *planes,
                           const lmb_pinhole *camera, int32_t p, const lmb_cone_seen *without,
                           const lmb_cone_seen *with, float specular);

/* lmb_object_tile: put the object's pixels over the photo's if nothing real is in front of them.                  [M24]
 *
 *   object, real  tiles of the same pixels
 *   cloud         for the noise: a real point hides the object only if it is nearer by two deviations
 * Returns the pixels that show the object, a bit each. */
uint64_t lmb_object_tile(lmb_radiance *inout, const lmb_radiance *light, const lmb_tile *object, const lmb_tile *real,
                         const lmb_cloud *cloud);

#ifdef __cplusplus
}
#endif
#endif
