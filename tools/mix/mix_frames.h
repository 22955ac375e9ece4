/* mix_frames.h: a sequence of photos with depth and pose: what is kept from frame to frame. */
#ifndef MIX_FRAMES_H
#define MIX_FRAMES_H

#include <math.h>

#include "mix_job.h"

/* Depth that is known, by the pixels of the frame before. */
typedef struct mix_depth {
    lmb_pinhole camera;     /* that `inverse` is seen by */
    int has_pose;
    double pose[16];
    float *inverse;         /* 1/m, by pixel: 0 where nothing was ever measured */
    uint8_t *differs;       /* how many frames running measured something else */
    uint8_t *fresh;         /* 1: pixels whose depth has changed since `last` was drawn */
    size_t changed;         /* how many these are */
} mix_depth;

/* A plane that frames have found, in the world of their poses: normal . p = -distance. */
typedef struct mix_track {
    lmb_vec3 normal;
    float distance;
    float weight;  /* by how many pixels; of the last frames */
    int32_t seen;  /* by how many frames before this one; 0: by none */
    int32_t last;  /* the number of frames with the last one that found it */
} mix_track;

/* What frames before have left, in the world of their poses. */
typedef struct mix_kept {
    int32_t frames;         /* that were mixed */
    model object;
    model_notes notes;
    lmb_mat4 to_world;      /* of the object */
    lmb_vec3 anchor, up, facing;
    float scale;
    int hangs;
    mix_track track[LMB_MAX_PLANES];
    int32_t tracks, floor;  /* floor: the track of what the object stands on, or -1 */
    int has_sun;
    lmb_light sun;          /* guessed at the first frame */
    float sun_size;
    lmb_env env;            /* around the first frame */
    void *env_memory;
    mix_depth depth;
    double bright;          /* the mean of the photo that `last` was drawn for */
    int is_other_light;     /* the frame is brighter or darker by over a twentieth */
    int has_exposure;
    float exposure_ev;      /* of linear photos: chosen for the first one */
    mix_job *last;          /* the frame that was drawn last, with its answer; or NULL */
    mix_job *world;         /* the frame whose voxels are traced; or NULL */
} mix_kept;

/* One frame of a list. */
typedef struct mix_entry {
    char *prefix;                   /* as for --frame; if NULL, these are used: */
    char *photo, *depth;
    int is_rooted;                  /* a name is an absolute path */
    double pose[16];
} mix_entry;

typedef struct mix_list {
    mix_entry *entry;
    int32_t count, cap;
    char *folder; /* folder of the list, the prefix of all names; "" or ending with a slash */
    int32_t no_depth, no_pose, unread; /* of TUM's lists: photos without a depth, or a pose, of their time; odd lines */
} mix_list;

/* mix_list_read: reads a folder with TUM's rgb.txt, depth.txt and groundtruth.txt or with frames.txt, or a file with
 * one PREFIX per line. A prefix may contain blanks. Blanks around it belong to it only if there is such a frame. A line
 * that begins with # is a comment. If a list contains zero bytes, they separate the prefixes instead of line breaks.
 * TUM photos without a depth or a pose within 0.02 s are skipped and counted. Returns 1, or 0 with `r` set. */
int mix_list_read(mix_list *out, const char *path, report *r);
void mix_list_free(mix_list *l);

/* mix_keep_depth: what was measured agrees with what is known, and that stays; or it is new, or it differs twice, and
 * replaces it. frame->depth becomes what is known now, as the frame's camera sees it. 1, or 0 with `r` set. */
int mix_keep_depth(mix_depth *d, mix_frame *frame, report *r);

/* mix_depth_seen: what is known now was drawn: nothing of it is new. mix_is_little_new: under one pixel in 500. */
void mix_depth_seen(mix_depth *d);
int mix_is_little_new(const mix_depth *d);

/* mix_depth_copy: 1, or 0 with `r` set and nothing allocated. mix_depth_free releases it. */
int mix_depth_copy(mix_depth *out, const mix_depth *in, report *r);
void mix_depth_free(mix_depth *d);

/* Measures of one thing differ by less, 1/m and relatively: a Kinect's noise is 0.003 1/m. */
#define MIX_NOISE    0.012f
#define MIX_RELATIVE 0.01f

/* mix_agree: may two inverse distances, 1/m, be of one thing? */
static inline int mix_agree(float a, float b) { return fabsf(a - b) <= MIX_NOISE + MIX_RELATIVE * fmaxf(a, b); }

/* Parts of mix_keep: where the object of the first frame stands, and its light; of each frame its planes. */
void mix_keep_place(mix_kept *k, const mix_job *j);
void mix_keep_planes(mix_kept *k, const mix_job *j);
int mix_keep_light(mix_kept *k, const mix_job *j, report *r);

/* mix_is_still: the camera has not moved since k->last was drawn, under one pixel in 500 measures something else, and the
 * photo is as bright on the whole to a twentieth, so that no lamp was switched: what was found then stays.
 * mix_brightness: the mean of a photo, linear. */
int mix_is_still(mix_kept *k, double bright);

/* mix_is_settled: is the camera where `last` was drawn from, and so little new that pixels which are not keep its answer?
 */
int mix_is_settled(const mix_kept *k);
double mix_brightness(const mix_frame *f);

/* mix_keep: after the first frame: where its object stands, and its light. */
int mix_keep(mix_kept *k, mix_job *j, report *r);

void mix_kept_free(mix_kept *k);

#endif
