/* mix_job.h: one run of `lambent mix`: the photo, what is in it, what is put into it, its light. */
#ifndef MIX_JOB_H
#define MIX_JOB_H

#include <lambent/lambent.h>

#include "../../platform/host/pool.h"
#include "../model/model.h"
#include "mix_options.h"

enum { MIX_BLOCKS = 128, MIX_IDLE = 4 /* jobs */, MIX_LIGHT_SAMPLES = 32 /* of a light with a size */,
       MIX_SUN_SAMPLES = 16 /* of a guessed one */ };

struct mix_kept;
struct mix_sources;

/* What a pixel of a picture holds besides the photo: light without and with the object; the object's radiance, as much of
 * it as covers the pixel. */
typedef struct mix_answer {
    float light[2][3], object[3], covered;
} mix_answer;

/* Light from around at a pixel, without and with the object, for the frame after this one. */
typedef struct mix_carried {
    float rgb[2][3];
    float direct[3]; /* the lights' without the object; under 0: not known */
    int32_t is_known;
} mix_carried;

/* Light from around at the object's part of a pixel, likewise. */
typedef struct mix_lit {
    lmb_vec3 position, normal; /* in the scene's space */
    float x, y, rgb[3];        /* x, y: of the sample in the photo, px */
    int32_t is_known;
} mix_lit;

/* Pieces of work that are done beside a picture's rows; count 0: they are done, or there are none. */
typedef struct mix_aside {
    pool_job run;
    void *user;
    int count;
    int is_beside; /* they are done beside rows */
} mix_aside;

/* The room that lamps shine in, as far as the photo tells: a box along its largest wall, in the scene's space. */
typedef struct mix_space {
    lmb_vec3 axis[3];
    float low[3], high[3]; /* m along these */
    float albedo[3];
    int is_known;
} mix_space;

typedef struct mix_memory {
    void *at;
    size_t bytes;
    int idle; /* jobs with memory of their own that have ended since it was given back */
} mix_memory;

/* Of a sequence, the memory of jobs that are over: pages that the system gives anew cost a sixth of a frame. */
typedef struct mix_spare {
    mix_memory piece[MIX_BLOCKS];
    int count;
} mix_spare;

/* mix_job_free releases what it points to. */
typedef struct mix_job {
    mix_options o;
    mix_aside *aside; /* of a sequence; or NULL */
    mix_frame frame;
    const struct mix_kept *kept; /* of a sequence: its object is placed, and lit, by frames before; or NULL */
    lmb_cloud cloud;
    lmb_planes planes;
    lmb_real_mesh real;
    float plane_albedo[LMB_MAX_PLANES][3]; /* means; set where the object has metal */
    mix_space room;                         /* likewise */
    lmb_vec3 ball_at;                      /* likewise: a ball as large as its box */
    float ball_radius;
    int32_t track[LMB_MAX_PLANES]; /* of a sequence: each plane's number in it, or -1: it is new */
    lmb_vec3 box_low, box_high;            /* that has all of it; mix_lights.h */
    float *front;        /* 1/m, by pixel: what may hide the object; mix_front.h */
    lmb_axes axes;       /* of the camera in the scene's space: its floor is level */
    lmb_mat4 from_world; /* to the scene's space */
    lmb_mat4 placed;     /* the object's place in it */
    model object;
    model_notes notes;
    lmb_scene scene;     /* the real mesh is instance 0, the object's instances come after it */
    uint32_t real_triangles, object_triangles;
    lmb_vec3 anchor, up; /* in the camera's space */
    lmb_vec3 facing;     /* likewise: the normal of what it stands or hangs on */
    int32_t floor;       /* the plane that the object stands on, or -1 */
    int faces_up;        /* it does, or was named */
    int hangs;           /* on a wall, upright */
    float scale;         /* m of a unit of the mesh */
    int32_t box_px[4];   /* its box in the picture, and a little more: x0, y0, x1, y1, the last ones behind it */
    int inside;          /* the picture has room for all of it */
    float seen_px;       /* the longer side of what it covers; infinite where it is at the camera */
    float gap_m;         /* how much farther than it stands what was measured at its foot is, along the camera's axis */
    lmb_env env[2];      /* around the scene without and with the object */
    float dim[3];        /* what the object leaves of it, by channel */
    lmb_light *lights;         /* those with a size are MIX_LIGHT_SAMPLES, a guessed sun MIX_SUN_SAMPLES */
    lmb_light sun;             /* where none is told, in the scene's space */
    float sun_size;
    lmb_shadow_map (*maps)[2]; /* of each: without, with */
    int32_t light_count, lamp_count; /* the last ones are the object's own: they are there only with it */
    struct mix_sources *sources; /* what those send; NULL: none */
    const lmb_scene *bounces;  /* the scene, and its lobes as if they were matt */
    lmb_voxels voxels;   /* about the object; count 0: there is none */
    lmb_cones cones;
    lmb_cone_width glossy;
    lmb_cone_scratch *scratch;
    struct mix_job *world; /* whose voxels, cones and surroundings are traced: its own, or of a sequence an earlier frame's */
    lmb_mat4 to_voxels;  /* from the scene's space to that one's */
    uint8_t *seen;       /* where the world has surfaces: mix_world.h */
    int32_t old_cells, gone; /* cells of the world that the frame does not see, behind real.count; those that it misses */
    mix_carried *carried;    /* of a sequence, by pixel */
    mix_lit *lit;            /* likewise */
    lmb_mat4 to_last;        /* from the scene's space to that of the frame before */
    int is_settled;      /* a camera that stands still: pixels that measure what they did keep the last frame's answer */
    mix_answer *answer;  /* of a sequence, by pixel; NULL: it is not kept */
    image picture;       /* linear */
    struct mix_labels *labels; /* what each pixel shows of the object; NULL: nobody asks */
    double read_s, planes_s, place_s, light_s, build_s, voxels_s, draw_s; /* build_s: of voxels_s */
    mix_memory blocks[MIX_BLOCKS];
    int block_count;
    mix_spare *spare; /* where its memory is from, and goes to; or NULL */
} mix_job;

/* mix_take: zeroed memory that lives as long as the job; NULL with `r` set. */
void *mix_take(mix_job *j, size_t bytes, report *r);

/* The steps, in order. Each 1, or 0 with `r` set. */
int mix_find_planes(mix_job *j, report *r); /* cloud and planes */
int mix_place(mix_job *j, report *r);       /* the object, the real scene's mesh, and the scene of both */
int mix_stand(mix_job *j, report *r);       /* of that: which plane (at the centre there is one), how large, and where */
int mix_light(mix_job *j, report *r);       /* environment, lights and their maps */
int mix_voxels(mix_job *j, report *r);      /* real surfaces' albedo, and bounced light about the object */
int mix_draw(mix_job *j, report *r);        /* the picture */

/* mix_guess_sun: a sun for a photo that is given no light, and how wide it is, degrees: the one that the photo's own shadows
 * tell of (mix_cast.h); where they tell of none, a wide and weak one overhead. It makes what is around so bright that the
 * photo's brightest surfaces are white at most. In a sequence it stays as it was. -1 where memory is short. */
float mix_guess_sun(lmb_light *out, const mix_job *j);

/* mix_up: what is up, unit, in the camera's space: as --up has it; or of the world that the pose is in, +Y or else +Z, where
 * a plane lies across it; or as the planes have it. mix_floor: the largest plane that faces up, or -1. */
lmb_vec3 mix_up(const mix_job *j);
int32_t mix_floor(const mix_job *j);

/* mix_drop_islands: specks of a plane's label in the midst of another's. 1, or 0 with `r` set. */
int mix_drop_islands(mix_job *j, report *r);

/* mix_extent: the object's box in its own units. radius: of the cylinder that holds it, upright or out of its wall, and a
 * fifth more. */
typedef struct mix_extent {
    float radius, height, longest;
} mix_extent;
mix_extent mix_extent_of(const mix_job *j);

/* mix_is_in_view: is all of the object in the picture where it stands on plane p, and its foot within the plane's box, so
 * nearer than the far edge? */
int mix_is_in_view(const mix_job *j, const lmb_flat *p, lmb_vec3 at, const mix_extent *e);

/* mix_touch: move the plane that the object stands on, and the object, onto what was measured at its foot, gap_m farther
 * along the camera's axis. What is more than a sensor bends a plane by stays. */
void mix_touch(mix_job *j, float gap_m);
void mix_lift_plane(mix_job *j, int32_t p, float dq); /* that it is nearer by dq, 1/m, along each ray */

/* mix_plane_near: the pixel nearest to --at whose plane faces up, and where the object, as large as it is, would be wholly
 * in view; where it is nowhere, one whose plane faces up; 0 where there is none. */
int mix_plane_near(int32_t at[2], const mix_job *j);

/* Parts of mix_place. mix_place_again: where the object of a sequence stands. mix_camera_of: from the world of the poses to the
 * camera's space. mix_turn_scene: the scene's space stands upright on what the object stands on, or on the floor.
 * mix_put_object: the object where it is placed, and the real scene's mesh. */
int mix_place_again(mix_job *j, report *r);
lmb_mat4 mix_camera_of(const mix_job *j);
void mix_turn_scene(mix_job *j);
int mix_put_object(mix_job *j, report *r);

/* mix_is_inside: do all vertices of the object lie in the picture, where it stands? Sets seen_px by them. */
int mix_is_inside(mix_job *j);

/* mix_fail_depth: 0, with `r` set: no plane is in the depth, and how much of that is measured, and how far away. */
int mix_fail_depth(const mix_job *j, report *r);

/* mix_fail_at: 0, with `r` set: --at shows nothing to stand on, and which pixel would. */
int mix_fail_at(const mix_job *j, report *r);

/* mix_copy_scene: a copy of the scene, whose materials may be changed; NULL without memory. */
lmb_scene *mix_copy_scene(lmb_material **materials, mix_job *j, report *r);

/* mix_object_box: the object's, where it stands. */
void mix_object_box(lmb_vec3 *low, lmb_vec3 *high, const mix_job *j);

/* mix_maps_bytes: of the shadow maps. */
size_t mix_maps_bytes(const mix_job *j);

/* The picture instead of mix_draw's. */
int mix_show_planes(mix_job *j, report *r);
int mix_show_env(mix_job *j, report *r);
int mix_show_voxels(mix_job *j, report *r);

/* mix_run_rows: all rows of a picture, and what there is aside. mix_aside_run: that alone. */
void mix_aside_run(mix_aside *a, int threads);
void mix_run_rows(const mix_job *j, int threads, int count, pool_job row, void *user);

/* mix_image: black, 3 channels. */
int mix_image(image *out, int32_t width, int32_t height, report *r);

void mix_job_free(mix_job *j);
void mix_spare_free(mix_spare *s);

#endif
