/* mix_frames.h: a sequence of photos with depth and pose: the state kept from frame to frame. */
#ifndef MIX_FRAMES_H
#define MIX_FRAMES_H

#include <math.h>

#include "mix_job.h"

/* The depth known so far, in pixels of the previous frame. */
typedef struct mix_depth {
    lmb_pinhole camera;     /* the camera of `inverse` */
    int has_pose;
    double pose[16];
    float *inverse;         /* 1/m, by pixel; 0 if never measured */
    uint8_t *differs;       /* number of consecutive frames with another measurement */
    uint8_t *fresh;         /* 1: the depth of this pixel has changed since `last` was drawn */
    size_t changed;         /* number of such pixels */
} mix_depth;

/* A plane found in several frames, in the world of their poses: normal . p = -distance. */
typedef struct mix_track {
    lmb_vec3 normal;
    float distance;
    float weight;  /* number of pixels in recent frames */
    int32_t seen;  /* number of earlier frames that showed it */
    int32_t last;  /* the number of the last frame that showed it */
} mix_track;

/* State left by earlier frames, in the world of their poses. */
typedef struct mix_kept {
    int32_t frames;         /* frames drawn so far */
    model object;
    model_notes notes;
    lmb_mat4 to_world;      /* of the object */
    lmb_vec3 anchor, up, facing;
    float scale;
    int hangs;
    mix_track track[LMB_MAX_PLANES];
    int32_t tracks, floor;  /* floor: the track of the plane under the object, or -1 */
    int has_sun;
    lmb_light sun;          /* guessed at the first frame */
    float sun_size, softens;
    lmb_env env;            /* environment of the first frame */
    void *env_memory;
    mix_depth depth;
    double bright;          /* mean of the photo that `last` was drawn for */
    int is_other_light;     /* the frame is brighter or darker by over a twentieth */
    int has_exposure;
    float exposure_ev;      /* for linear photos: chosen for the first one */
    mix_job *last;          /* the last frame drawn and kept; or NULL */
    mix_job *world;         /* the frame with the voxels that are traced; or NULL */
} mix_kept;

/* One frame of a list. */
typedef struct mix_entry {
    char *prefix;                   /* as for --frame; NULL: the next two are used */
    char *photo, *depth;            /* depth may be NULL: see may_lack_depth */
    int is_rooted;                  /* a name is an absolute path */
    double pose[16];
} mix_entry;

typedef struct mix_list {
    mix_entry *entry;
    int32_t count, cap;
    char *folder; /* folder of the list, prefixed to all names; "" or ending with a slash */
    int may_lack_depth;            /* input: TUM photos without a depth are frames, too */
    int32_t no_depth, no_pose, unread; /* of TUM's lists: photos without depth or pose; malformed lines */
} mix_list;

/* mix_list_read: reads a folder with TUM's rgb.txt, depth.txt and groundtruth.txt or with frames.txt, or a file with
 * one PREFIX per line. A prefix may contain blanks. Blanks around it belong to it only if there is such a frame. A line
 * that begins with # is a comment. If a list contains zero bytes, they separate the prefixes instead of line breaks.
 * TUM photos without a depth or a pose within 0.02 s are skipped and counted. Returns 1, or 0 with `r` set. */
int mix_list_read(mix_list *out, const char *path, report *r);
void mix_list_free(mix_list *l);

/* mix_keep_depth: merges a frame's depth into the known depth. If both agree, the known value stays. A new value, or
 * one that differs twice, replaces it. Sets frame->depth to the known depth as the frame's camera sees it. Returns 1,
 * or 0 with `r` set. */
int mix_keep_depth(mix_depth *d, mix_frame *frame, report *r);

/* mix_depth_seen: marks all pixels as not new; call it when you have drawn the known depth. mix_is_little_new: are
 * under one pixel in 500 new? */
void mix_depth_seen(mix_depth *d);
int mix_is_little_new(const mix_depth *d);

/* mix_depth_copy: returns 1, or 0 with `r` set and nothing allocated. Release the copy with mix_depth_free. */
int mix_depth_copy(mix_depth *out, const mix_depth *in, report *r);
void mix_depth_free(mix_depth *d);

/* Maximum difference between measurements of one surface, 1/m and relative. A Kinect's noise is 0.003 1/m. */
#define MIX_NOISE    0.012f
#define MIX_RELATIVE 0.01f

/* mix_agree: can two inverse distances, 1/m, belong to one surface? */
static inline int mix_agree(float a, float b) { return fabsf(a - b) <= MIX_NOISE + MIX_RELATIVE * fmaxf(a, b); }

/* Parts of mix_keep: place and light of the first frame's object; planes of each frame. */
void mix_keep_place(mix_kept *k, const mix_job *j);
void mix_keep_planes(mix_kept *k, const mix_job *j);
int mix_keep_light(mix_kept *k, const mix_job *j, report *r);

/* mix_is_still: has the camera not moved since k->last was drawn, are under one pixel in 500 measured differently, and
 * is the mean brightness within a twentieth, so that no lamp was switched? Then the last result holds. mix_brightness:
 * the mean of a photo, linear. */
int mix_is_still(mix_kept *k, double bright);

/* mix_is_settled: has so little changed since `last` was drawn that pixels with unchanged depth keep the last
 * result? */
int mix_is_settled(const mix_kept *k);
double mix_brightness(const mix_frame *f);

/* mix_keep: stores the planes of a frame, and after the first frame also the place and the light of the object. */
int mix_keep(mix_kept *k, mix_job *j, report *r);

void mix_kept_free(mix_kept *k);

#endif
