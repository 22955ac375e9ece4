/* mix_stays.c: in a sequence, matches planes from frame to frame and keeps the object in place. */
#include "mix_frames.h"
#include "mix_turn.h"

#include <math.h>

/* Planes of two frames are one if their normals match, as for regions in lmb_planes_find, and if they agree at the
 * plane's middle (MIX_RELATIVE): noise of a plane is averaged over its pixels and counts little. */
#define ONE_PLANE 0.9975641f /* cosine of 4 degrees */

/* Tolerance for the plane under the object. The plane that it stood on before also gets the sensor's tolerance. */
#define BELOW_M  0.05f
#define BELOW    0.985f /* cosine of ten degrees */

enum { RECENT = 8 /* frames that determine a plane's position: sensors bend it differently from other viewpoints */ };

static float dot(lmb_vec3 a, lmb_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/* --- planes ------------------------------------------------------------------------------------------------------- */

/* A track as seen by the frame's camera: 1 / distance is slope . (x, y, 1). Returns 0 if seen from behind. */
static int slope_of(float slope[3], lmb_vec3 *normal, const mix_track *t, const lmb_mat4 *camera)
{
    const lmb_vec3 n = mix_turn(camera, t->normal), at = {camera->m[12], camera->m[13], camera->m[14]};
    const float distance = t->distance - dot(n, at);
    *normal = n;
    slope[0] = -n.x / distance;
    slope[1] = -n.y / distance;
    slope[2] = n.z / distance;
    return distance > 1e-3f;
}

static float inverse_at(const float slope[3], lmb_vec3 p)
{
    return slope[0] * p.x / -p.z + slope[1] * p.y / -p.z + slope[2];
}

/* The track that a plane continues, or -1. */
static int32_t track_of(float slope[3], const mix_job *j, const lmb_flat *p, const lmb_mat4 *camera)
{
    int32_t best = -1;
    float near = MIX_RELATIVE;
    for (int32_t i = 0; i < j->kept->tracks; ++i) {
        lmb_vec3 normal;
        float one[3];
        if (j->kept->track[i].seen == 0 || !slope_of(one, &normal, &j->kept->track[i], camera) ||
            dot(normal, p->normal) < ONE_PLANE) {
            continue;
        }
        const float q = -1.0f / p->centre.z, off = fabsf(inverse_at(one, p->centre) / q - 1.0f);
        if (off < near) {
            near = off;
            best = i;
            slope[0] = one[0];
            slope[1] = one[1];
            slope[2] = one[2];
        }
    }
    return best;
}

static void set_slope(lmb_flat *p, const float slope[3])
{
    const lmb_vec3 n = {-slope[0], -slope[1], slope[2]};
    const float length = sqrtf(dot(n, n)), q = -1.0f / p->centre.z, far = q / inverse_at(slope, p->centre);
    p->distance = 1.0f / length;
    p->normal = (lmb_vec3){n.x / length, n.y / length, n.z / length};
    p->centre = (lmb_vec3){p->centre.x * far, p->centre.y * far, p->centre.z * far};
    for (int c = 0; c < 3; ++c) {
        p->slope[c] = slope[c];
    }
}

/* Averages each plane with the matching track, weighted by pixels. */
static void track_planes(mix_job *j, const lmb_mat4 *camera)
{
    for (int32_t i = 0; i < j->planes.count; ++i) {
        lmb_flat *p = &j->planes.plane[i];
        float was[3], slope[3];
        j->track[i] = track_of(was, j, p, camera);
        if (j->track[i] >= 0) {
            const float weight = fminf(j->kept->track[j->track[i]].weight, (float)RECENT * (float)p->pixels),
                        share = weight / (weight + (float)p->pixels);
            for (int c = 0; c < 3; ++c) {
                slope[c] = p->slope[c] + share * (was[c] - p->slope[c]);
            }
            set_slope(p, slope);
        }
    }
    lmb_planes_move(&j->cloud, &j->planes);
}

/* Is track a replaced before b? The one not found for longer is, or if equal, the one found in fewer frames. */
static int gives_way(const mix_track *a, const mix_track *b)
{
    return a->last != b->last ? a->last < b->last : a->seen < b->seen;
}

/* A free track, or else the least recently found one, except the object's plane and planes of this frame. -1: none. */
static int32_t new_track(mix_kept *k)
{
    int32_t first = -1;
    if (k->tracks < LMB_MAX_PLANES) {
        return k->tracks++;
    }
    for (int32_t i = 0; i < k->tracks; ++i) {
        if (i != k->floor && k->track[i].last <= k->frames &&
            (first < 0 || gives_way(&k->track[i], &k->track[first]))) {
            first = i;
        }
    }
    return first;
}

static void keep_plane(mix_kept *k, const mix_job *j, int32_t i, int is_new)
{
    const lmb_mat4 camera = mix_camera_of(j), world = mix_back(&camera);
    const lmb_flat *p = &j->planes.plane[i];
    const lmb_vec3 at = {camera.m[12], camera.m[13], camera.m[14]};
    const int32_t n = is_new ? new_track(k) : j->track[i];
    if (n < 0) {
        return;
    }
    mix_track *t = &k->track[n];
    t->normal = mix_turn(&world, p->normal);
    t->distance = p->distance + dot(p->normal, at);
    t->weight = (is_new ? 0.0f : fminf(t->weight, (float)RECENT * (float)p->pixels)) + (float)p->pixels;
    t->seen = is_new ? 1 : t->seen + 1;
    t->last = k->frames + 1;
    if (i == j->floor && (k->frames == 0 || k->floor >= 0)) {
        k->floor = n;
    }
}

/* Continued planes come first, because their tracks are not free. */
void mix_keep_planes(mix_kept *k, const mix_job *j)
{
    for (int is_new = 0; is_new < 2; ++is_new) {
        for (int32_t i = 0; i < j->planes.count; ++i) {
            if (is_new == (k->frames == 0 || j->track[i] < 0)) {
                keep_plane(k, j, i, is_new);
            }
        }
    }
}

/* --- the object --------------------------------------------------------------------------------------------------- */

void mix_keep_place(mix_kept *k, const mix_job *j)
{
    const lmb_mat4 camera = mix_camera_of(j), world = mix_back(&camera), from = mix_back(&j->from_world);
    k->to_world = mix_product(&from, &j->placed);
    k->anchor = mix_move(&world, j->anchor);
    k->up = mix_turn(&world, j->up);
    k->facing = mix_turn(&world, j->facing);
    k->scale = j->scale;
    k->hangs = j->hangs;
    k->floor = -1;
}

/* Distance between a plane and the object's foot, m; infinite if the plane is tilted there or too far even for sensor
 * error. */
static float miss(const mix_job *j, const lmb_flat *p, lmb_vec3 normal, int is_its_own)
{
    const float off = fabsf(dot(p->normal, j->anchor) + p->distance);
    const int may_be = off < BELOW_M || (is_its_own && j->anchor.z < -1e-3f &&
                                         mix_agree(inverse_at(p->slope, j->anchor), -1.0f / j->anchor.z));
    return may_be && dot(p->normal, normal) > BELOW ? off : INFINITY;
}

/* The plane of this frame under the object: the one that it stood on, else the nearest; or -1. */
static int32_t plane_below(const mix_job *j, lmb_vec3 normal)
{
    int32_t best = -1;
    float near = INFINITY;
    for (int32_t i = 0; i < j->planes.count; ++i) {
        const int is_its_own = j->kept->floor >= 0 && j->track[i] == j->kept->floor;
        const float off = miss(j, &j->planes.plane[i], normal, is_its_own);
        if (is_its_own && off < INFINITY) {
            return i;
        }
        if (off < near) {
            near = off;
            best = i;
        }
    }
    return best;
}

/* Moves the plane to the object's foot. Otherwise the object would float or sink. */
static void hold_plane(mix_job *j)
{
    const lmb_flat *p = &j->planes.plane[j->floor];
    const float q = -1.0f / j->anchor.z, dq = q - inverse_at(p->slope, j->anchor);
    if (j->anchor.z < -1e-3f && fabsf(dq) <= MIX_RELATIVE * q) {
        mix_lift_plane(j, j->floor, dq);
    }
}

int mix_place_again(mix_job *j, report *r)
{
    const mix_kept *k = j->kept;
    const lmb_mat4 camera = mix_camera_of(j);
    track_planes(j, &camera);
    j->object = k->object;
    j->anchor = mix_move(&camera, k->anchor);
    j->up = mix_turn(&camera, k->up);
    j->scale = k->scale;
    j->facing = mix_turn(&camera, k->facing);
    j->hangs = k->hangs;
    j->floor = plane_below(j, j->facing);
    if (j->floor >= 0 && j->track[j->floor] == k->floor) {
        hold_plane(j);
    }
    j->faces_up = 1;
    mix_turn_scene(j);
    j->gap_m = NAN;
    j->placed = mix_product(&j->from_world, &k->to_world);
    return mix_put_object(j, r);
}
