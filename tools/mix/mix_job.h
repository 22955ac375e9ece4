/* mix_job.h: one run of `lambent mix`: the photo, planes, object and light. */
#ifndef MIX_JOB_H
#define MIX_JOB_H

#include <lambent/lambent.h>

#include "../../platform/host/pool.h"
#include "../model/model.h"
#include "mix_options.h"

enum { MIX_BLOCKS = 128, MIX_IDLE = 4 /* jobs */, MIX_LIGHT_SAMPLES = 32 /* of a light with a size */,
       MIX_LIGHT_FEW = 8 /* likewise, for placements from a list */,
       MIX_SUN_SAMPLES = 16 /* of a guessed sun */ };

struct mix_kept;
struct mix_sources;

/* The result at one pixel, besides the photo: light without and with the object, the object's radiance and coverage. */
typedef struct mix_answer {
    float light[2][3], object[3], covered;
} mix_answer;

/* Indirect light at a pixel, without and with the object, kept for the next frame. */
typedef struct mix_carried {
    float rgb[2][3];
    float direct[3]; /* direct light without the object; under 0: unknown */
    int32_t is_known;
} mix_carried;

/* Indirect light on the object at a pixel, likewise. */
typedef struct mix_lit {
    lmb_vec3 position, normal; /* in scene space */
    float x, y, rgb[3];        /* x, y: of the sample in the photo, px */
    int32_t is_known;
} mix_lit;

/* Tasks that run beside a picture's rows; count 0: done, or none. */
typedef struct mix_aside {
    pool_job run;
    void *user;
    int count;
    int is_beside; /* they run beside rows */
} mix_aside;

/* The estimated room around the lamps: a box aligned to the photo's largest wall, in scene space. */
typedef struct mix_space {
    lmb_vec3 axis[3];
    float low[3], high[3]; /* m along these */
    float albedo[3];
    int is_known;
} mix_space;

typedef struct mix_memory {
    void *at;
    size_t bytes;
    int idle; /* number of jobs that ended since the block was given back */
} mix_memory;

/* Memory of finished jobs of a sequence. New pages from the system would cost a sixth of a frame. */
typedef struct mix_spare {
    mix_memory piece[MIX_BLOCKS];
    int count;
} mix_spare;

/* Release it with mix_job_free. */
typedef struct mix_job {
    mix_options o;
    mix_aside *aside; /* of a sequence; or NULL */
    mix_frame frame;
    const struct mix_kept *kept; /* state of a sequence, with place and light of the object; or NULL */
    lmb_cloud cloud;
    lmb_planes planes;
    lmb_real_mesh real;
    float plane_albedo[LMB_MAX_PLANES][3]; /* means; set if the object has metal */
    mix_space room;                         /* likewise */
    lmb_vec3 ball_at;                      /* likewise: a ball as large as the object's box */
    float ball_radius;
    int32_t track[LMB_MAX_PLANES]; /* in a sequence: the track of each plane, or -1: it is new */
    lmb_vec3 box_low, box_high;            /* box of the whole object; mix_lights.h */
    float *front;        /* 1/m, by pixel: surfaces that may hide the object; mix_front.h */
    lmb_axes axes;       /* of the camera in scene space, in which the floor is level */
    lmb_mat4 from_world; /* to scene space */
    lmb_mat4 placed;     /* the object's place in it */
    model object;
    model_notes notes;
    lmb_scene scene;     /* instance 0 is the real mesh, the others are the object's */
    uint32_t real_triangles, object_triangles;
    lmb_vec3 anchor, up; /* in camera space */
    lmb_vec3 facing;     /* likewise: the normal of the plane under or behind the object */
    int32_t floor;       /* the plane under or behind the object, or -1 */
    int faces_up;        /* the plane faces up, or was named */
    int hangs;           /* on a wall, upright */
    float scale;         /* m per unit of the mesh */
    int32_t box_px[4];   /* the object's box in the picture and a margin: x0, y0, x1, y1, end exclusive */
    int inside;          /* all of the object lies in the picture */
    float seen_px;       /* the longer side of the covered area; infinite if it reaches the camera */
    float gap_m;         /* depth measured at the object's foot minus the object's own, along the camera's axis */
    lmb_env env[2];      /* environment without and with the object */
    float dim[3];        /* share of it left by the object, by channel */
    lmb_light *lights;         /* MIX_LIGHT_SAMPLES for each with a size, MIX_SUN_SAMPLES for a guessed sun */
    lmb_light sun;             /* if none is given, in scene space */
    float sun_size;
    float softens;             /* share of the darkening that is left out: 0, or more if the light is unknown */
    lmb_shadow_map (*maps)[2]; /* of each: without, with */
    int32_t light_count, lamp_count; /* the last lamp_count lights are the object's own and exist only with it */
    struct mix_sources *sources; /* the object's own light sources; NULL: none */
    const lmb_scene *bounces;  /* the scene, with lobes as if diffuse */
    const lmb_scene *shiny;   /* the scene as drawn, also with lobes of plastics: mix_lobes.h */
    lmb_voxels voxels;   /* around the object; count 0: there are none */
    lmb_cones cones;
    lmb_cone_width glossy;
    lmb_cone_scratch *scratch;
    struct mix_job *world; /* owns the traced voxels, cones and environment: this job, or an earlier frame's */
    lmb_mat4 to_voxels;  /* from scene space to that job's */
    uint8_t *seen;       /* occupancy grid of the world's surfaces: mix_world.h */
    int32_t old_cells, gone; /* cells of the world outside the frame's view, after real.count; cells no longer there */
    mix_carried *carried;    /* of a sequence, by pixel */
    mix_lit *lit;            /* likewise */
    lmb_mat4 to_last;        /* from scene space to the previous frame's */
    int is_settled;      /* the camera is static: pixels with unchanged depth keep the last result */
    mix_answer *answer;  /* of a sequence, by pixel; NULL: not kept */
    image picture;       /* linear */
    struct mix_grain *grain;   /* noise for the object; NULL: none */
    int is_shared;             /* the photo of a list of placements: lit without an object */
    struct mix_labels *labels; /* per-pixel labels of the object; NULL: not requested */
    double read_s, planes_s, place_s, light_s, build_s, voxels_s, draw_s; /* build_s: part of voxels_s */
    mix_memory blocks[MIX_BLOCKS];
    int block_count;
    mix_spare *spare; /* pool for the memory; or NULL */
} mix_job;

/* mix_take: zeroed memory that lives as long as the job, so you do not free it; NULL with `r` set on failure. */
void *mix_take(mix_job *j, size_t bytes, report *r);

/* The steps, in order. Each returns 1, or 0 with `r` set. */
int mix_find_planes(mix_job *j, report *r); /* cloud and planes */
int mix_place(mix_job *j, report *r);       /* the object, the real scene's mesh, and the scene of both */
int mix_stand(mix_job *j, report *r);       /* part of mix_place: plane (at the centre there is one), size, position */
int mix_light(mix_job *j, report *r);       /* environment, lights and shadow maps */
int mix_voxels(mix_job *j, report *r);      /* albedo of real surfaces, and bounced light around the object */
int mix_draw(mix_job *j, report *r);        /* the picture */

/* mix_guess_sun: a sun for a photo without given lights. It is estimated from shadows in the photo, or from the way in
 * which brightness decreases (mix_cast.h). If neither shows a light, it is wide, weak and overhead, and *softens is
 * over 0. The environment is scaled so that the photo's brightest surfaces are at most white. A sequence keeps the
 * first sun. Returns the sun's size, degrees, or -1 if memory is short. */
float mix_guess_sun(lmb_light *out, float *softens, const mix_job *j);

/* mix_soften: `with`, without the share `softens` of the darkening, but less of it is left out if nearly all light is
 * blocked: at a contact, the direction of the light does not matter. `room` holds the result. */
const lmb_irradiance *mix_soften(lmb_irradiance *room, const lmb_irradiance *with, const lmb_irradiance *without,
                                 float softens);

/* mix_up: the up direction, unit, in camera space: --up; or +Y, else +Z, of the pose's world if a plane lies across it;
 * or the direction that the planes agree on. mix_floor: the largest plane that faces up, or -1. */
lmb_vec3 mix_up(const mix_job *j);
int32_t mix_floor(const mix_job *j);

/* mix_drop_islands: removes specks of a plane's label inside another plane. Returns 1, or 0 with `r` set. */
int mix_drop_islands(mix_job *j, report *r);

/* mix_extent: size of the object in mesh units. radius: of a cylinder around it, upright or perpendicular to the wall,
 * plus a fifth. */
typedef struct mix_extent {
    float radius, height, longest;
} mix_extent;
mix_extent mix_extent_of(const mix_job *j);

/* mix_is_in_view: on plane p at `at`, is all of the object in the picture, and the foot within the plane's box, so
 * nearer than the far edge? */
int mix_is_in_view(const mix_job *j, const lmb_flat *p, lmb_vec3 at, const mix_extent *e);

/* mix_touch: moves the object and its plane onto the surface measured at the foot, gap_m farther along the camera's
 * axis. A gap too large for sensor error stays. */
void mix_touch(mix_job *j, float gap_m);
void mix_lift_plane(mix_job *j, int32_t p, float dq); /* brings it nearer by dq, 1/m, along each ray */

/* mix_plane_near: finds the pixel nearest to --at on a plane that faces up and with the object wholly in view; if there
 * is none, only on a plane that faces up. Returns 0 if no plane does. */
int mix_plane_near(int32_t at[2], const mix_job *j);

/* Parts of mix_place. mix_place_again: places the object of a sequence. mix_camera_of: from the world of the poses to
 * camera space. mix_turn_scene: orients scene space upright on the object's plane, or on the floor. mix_put_object:
 * adds the placed object and the real scene's mesh. */
int mix_place_again(mix_job *j, report *r);
lmb_mat4 mix_camera_of(const mix_job *j);
void mix_turn_scene(mix_job *j);
int mix_put_object(mix_job *j, report *r);

/* mix_is_inside: do all vertices of the placed object lie in the picture? Also sets seen_px. */
int mix_is_inside(mix_job *j);

/* mix_fail_depth: returns 0 with `r` set: no plane was found, and how much depth is measured, and how far away. */
int mix_fail_depth(const mix_job *j, report *r);

/* mix_fail_at: returns 0 with `r` set: --at shows nothing to stand on, and the nearest pixel that does. */
int mix_fail_at(const mix_job *j, report *r);

/* mix_copy_scene: copies the scene with materials that you may change; NULL if memory is short. */
lmb_scene *mix_copy_scene(lmb_material **materials, mix_job *j, report *r);

/* mix_object_box: the box of the placed object. */
void mix_object_box(lmb_vec3 *low, lmb_vec3 *high, const mix_job *j);

/* mix_maps_bytes: size of the shadow maps. */
size_t mix_maps_bytes(const mix_job *j);

/* Pictures drawn instead of mix_draw's. */
int mix_show_planes(mix_job *j, report *r);
int mix_show_env(mix_job *j, report *r);
int mix_show_voxels(mix_job *j, report *r);

/* mix_run_rows: runs all rows of a picture, and the tasks aside. mix_aside_run: runs only those tasks. */
void mix_aside_run(mix_aside *a, int threads);
void mix_run_rows(const mix_job *j, int threads, int count, pool_job row, void *user);

/* mix_gap: the measured depth at the object's foot minus the plane's, along the camera's axis: the median; NaN if none
 * is measured. mix_object_to_scene: the object's place, from mesh to scene space. */
float mix_gap(mix_job *j, report *r);
lmb_mat4 mix_object_to_scene(mix_job *j);

/* mix_image: black, 3 channels. */
int mix_image(image *out, int32_t width, int32_t height, report *r);

void mix_job_free(mix_job *j);
void mix_spare_free(mix_spare *s);

#endif
