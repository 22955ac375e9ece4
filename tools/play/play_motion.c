/* play_motion.c: moves lights, camera and objects in a frame: by keys, animations, or a default motion. */
#include "play_motion.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../common/fvec.h"
#include "../model/model_shape.h"
#include "../render/render_view.h"
#include "play_space.h"

#define TURN_S 10.0      /* period of a figure of eight or a swing */
#define CIRCLE 0.25f     /* largest radius of a figure of eight / smaller horizontal side of the scene */
#define CONE   0.2f      /* the same for a sun, as a tangent */
#define SWING  0.35f     /* rad, the largest */
#define SMALLER 0.8f     /* factor tried next if there is no room */
#define LEAST_M 1e-6f    /* minimum distance of a place from the target, to have a direction */
#define AIR    1.2f      /* required free space, relative to the motion */
enum { TRIES = 16, PLACES = 64, EVERYTHING = KEY_LIGHT | KEY_CAMERA | KEY_OBJECT };

static const double two_pi = 6.283185307179586;

/* --- room for the default motion ---------------------------------------------------------------------------------- */

static int is_sun(const lmb_light *l) { return l->kind != LMB_LIGHT_POINT && l->kind != LMB_LIGHT_SPOT; }

static lmb_vec3 on_circle(lmb_vec3 middle, double radius, double turn)
{
    return add3(middle, vec3((float)(radius * cos(two_pi * turn)), 0.0f, (float)(radius * sin(two_pi * turn))));
}

/* Does it stay inside the scene's box, if its middle is inside? */
static int stays_inside(const lmb_scene *s, lmb_vec3 at, float radius)
{
    const lmb_vec3 low = s->bounds_min, high = s->bounds_max;
    const int is_inside = at.x >= low.x && at.x <= high.x && at.z >= low.z && at.z <= high.z;
    return !is_inside || (at.x - radius >= low.x && at.x + radius <= high.x && at.z - radius >= low.z &&
                          at.z + radius <= high.z);
}

static float room_for_light(play_space *space, const lmb_scene *s, const lmb_light *l)
{
    lmb_vec3 place[PLACES];
    float radius = CIRCLE * minf(s->bounds_max.x - s->bounds_min.x, s->bounds_max.z - s->bounds_min.z);
    if (is_sun(l)) {
        return CONE;
    }
    for (int i = 0; i < TRIES; ++i, radius *= SMALLER) {
        for (int k = 0; k < PLACES; ++k) {
            place[k] = on_circle(l->position, (double)(AIR * radius), (double)k / PLACES);
        }
        if (stays_inside(s, l->position, AIR * radius) && play_space_sees(space, l->position, place, PLACES)) {
            return radius;
        }
    }
    return 0.0f;
}

/* `v` rotated by an angle about the upright axis. */
static lmb_vec3 turned(lmb_vec3 v, double angle)
{
    const float c = (float)cos(angle), s = (float)sin(angle);
    return vec3(c * v.x + s * v.z, v.y, c * v.z - s * v.x);
}

static lmb_vec3 swung(const play_motion *m, double angle)
{
    return add3(m->middle, turned(sub3(m->view_at_rest.eye, m->middle), angle));
}

static float room_for_camera(play_space *space, const play_motion *m)
{
    lmb_vec3 place[PLACES];
    float angle = SWING;
    for (int i = 0; i < TRIES; ++i, angle *= SMALLER) {
        for (int k = 0; k < PLACES; ++k) {
            place[k] = swung(m, (double)(AIR * angle) * (2.0 * (k + 0.5) / PLACES - 1.0));
        }
        if (play_space_sees(space, m->view_at_rest.eye, place, PLACES)) {
            return angle;
        }
    }
    return 0.0f;
}

/* Returns 1 if the light is the sun of an environment map. That sun does not move. */
static int is_pictured(const render_job *j, uint32_t light)
{
    return j->around.has_sun && !j->around.is_sky && light == j->scene.light_count - 1;
}

static int find_room(play_motion *m, report *r)
{
    const lmb_scene *s = &m->job->scene;
    const int is_quiet = m->options->render.view.is_quiet;
    play_space space;
    int ok = play_space_make(&space, s, m->options->render.kernels, r);
    for (uint32_t i = 0; ok && (m->moves & KEY_LIGHT) != 0 && i < s->light_count; ++i) {
        m->radius[i] = is_pictured(m->job, i) ? 0.0f : room_for_light(&space, s, &m->light_at_rest[i]);
        const int is_followed = is_pictured(m->job, i) && m->job->o.world_changes; /* the files move it */
        report_note(is_quiet || m->radius[i] > 0.0f || is_followed, "light %u stands still: %s", (unsigned)i,
                    is_pictured(m->job, i) ? "it is the sun of --world"
                                           : "surfaces are too near for a circle; --path FILE moves it");
        report_note(!m->options->render.view.is_verbose || m->radius[i] <= 0.0f, "light %u moves by %.3g%s",
                    (unsigned)i, (double)m->radius[i], is_sun(&m->light_at_rest[i]) ? " of its length" : " m");
    }
    if (ok && (m->moves & KEY_CAMERA) != 0) {
        const float far_m = 2.0f * length3(sub3(s->bounds_max, s->bounds_min));
        const lmb_vec3 ahead = mul3(m->view_at_rest.back, -1.0f), eye = m->view_at_rest.eye;
        m->middle = add3(eye, mul3(ahead, play_space_reach(&space, eye, ahead, far_m)));
        m->swing = room_for_camera(&space, m);
        report_note(is_quiet || m->swing > 0.0f,
                    "the camera stands still: surfaces are too near beside it; --path FILE moves it");
        report_note(!m->options->render.view.is_verbose || m->swing <= 0.0f, "the camera swings by %.3g degrees",
                    (double)m->swing * 360.0 / two_pi);
    }
    report_note(is_quiet || space.traversal.coarse == 0, "note: %u searches for room to move have coarser visibility: "
                "too many triangles cross there; --path gives the way instead", (unsigned)space.traversal.coarse);
    play_space_free(&space);
    return ok;
}

/* --- a frame ------------------------------------------------------------------------------------------------------ */

/* Two directions perpendicular to a unit vector. */
static void set_across(lmb_vec3 *a, lmb_vec3 *b, lmb_vec3 v)
{
    *a = normalize3(cross3(absf(v.y) < 0.9f ? vec3(0, 1, 0) : vec3(1, 0, 0), v));
    *b = cross3(v, *a);
}

/* Moves a light on a figure of eight. It starts in the middle, at the light's place in the file, so frame 0 equals the
 * picture of `render`. */
static lmb_light wandering(const play_motion *m, uint32_t i, double time_s)
{
    lmb_light l = m->light_at_rest[i];
    const double turn = two_pi * time_s / TURN_S, along = (double)m->radius[i] * sin(turn), aside = along * cos(turn);
    lmb_vec3 a, b;
    if (!is_sun(&l)) {
        l.position = add3(l.position, vec3((float)along, 0.0f, (float)aside));
    } else if (along != 0.0) {
        set_across(&a, &b, l.direction);
        l.direction = normalize3(add3(l.direction, add3(mul3(a, (float)along), mul3(b, (float)aside))));
    }
    return l;
}

/* Sets a light. The revision lets the next frame reuse the shadow map if the light is unchanged. */
static void put_light(play_motion *m, uint32_t i, lmb_light wanted)
{
    lmb_light *l = &m->light[i];
    wanted.revision = l->revision;
    if (memcmp(&wanted, l, sizeof wanted) != 0) {
        *l = wanted;
        ++l->revision;
    }
}

/* Returns 1 if it has moved. */
static int put_object(play_motion *m, uint32_t i, const lmb_mat4 *to)
{
    if (memcmp(to, &m->instance[i].to_world, sizeof *to) == 0) {
        return 0;
    }
    m->instance[i].to_world = *to;
    ++m->instance[i].revision;
    return 1;
}

/* Updates the scene after objects have moved. */
static int set_moved(play_motion *m, int32_t k, report *r)
{
    lmb_scene *s = &m->job->scene;
    ++s->revision;
    lmb_scene_bounds(&s->bounds_min, &s->bounds_max, s);
    return lmb_scene_check(s) == LMB_OK || report_fail(r, "%s: at frame %d an object stands where it cannot",
                                                       m->job->o.scene, (int)k);
}

static void put_keyed_light(play_motion *m, uint32_t i, const path_key *key)
{
    lmb_light l = m->light_at_rest[i];
    l.position = is_sun(&l) ? l.position : key->at;
    l.direction = key->has_target ? normalize3(sub3(key->target, key->at)) : l.direction;
    put_light(m, i, l);
}

static int put_keyed_camera(play_motion *m, const path_key *key, int32_t k, report *r)
{
    const play_options *o = m->options;
    lmb_view *v = &m->job->middle, look;
    v->eye = key->at;
    if (!key->has_target) {
        return 1;
    }
    if (lmb_view_look_at(&look, key->at, key->target, o->render.view.up, 1.0f, 8, 8) != LMB_OK) {
        return report_fail(r, "%s: at frame %d the camera looks along what is up for it; give another --up", o->path,
                           (int)k);
    }
    v->right = look.right;
    v->up = look.up;
    v->back = look.back;
    return 1;
}

/* Multiplies the rotation axes with three columns of the rest matrix. */
static void turn_object(lmb_mat4 *to, const lmb_mat4 *rest, lmb_vec3 right, lmb_vec3 up, lmb_vec3 ahead)
{
    for (int c = 0; c < 3; ++c) {
        const float *from = rest->m + 4 * c;
        const lmb_vec3 v = add3(mul3(right, from[0]), add3(mul3(up, from[1]), mul3(ahead, from[2])));
        to->m[4 * c] = v.x;
        to->m[4 * c + 1] = v.y;
        to->m[4 * c + 2] = v.z;
    }
}

/* Returns 1 if it has moved. */
static int put_keyed_object(play_motion *m, uint32_t i, const path_key *key)
{
    lmb_mat4 to = m->instance_at_rest[i].to_world;
    if (key->has_target) {
        const lmb_vec3 ahead = normalize3(sub3(key->target, key->at));
        lmb_vec3 right = cross3(vec3(0, 1, 0), ahead);
        right = length3(right) > 1e-4f ? normalize3(right) : vec3(1, 0, 0);
        turn_object(&to, &m->instance_at_rest[i].to_world, right, cross3(ahead, right), ahead);
    }
    to.m[12] = key->at.x;
    to.m[13] = key->at.y;
    to.m[14] = key->at.z;
    return put_object(m, i, &to);
}

static int set_by_path(play_motion *m, int32_t k, double time_s, report *r)
{
    int moved = 0, ok = 1;
    for (uint32_t t = 0; ok && t < m->path.track_count; ++t) {
        const key_track *track = &m->path.track[t];
        const path_key key = key_path_at(&m->path, track, time_s);
        if ((track->what & m->moves) != 0 && key.has_target && !(length3(sub3(key.target, key.at)) > LEAST_M)) {
            return report_fail(r, "%s: at frame %d what line %u moves stands at its own target; move one of its keys",
                               m->options->path, (int)k, (unsigned)track->line);
        }
        if ((track->what & m->moves) == KEY_LIGHT) {
            put_keyed_light(m, track->index, &key);
        } else if ((track->what & m->moves) == KEY_CAMERA) {
            ok = put_keyed_camera(m, &key, k, r);
        } else if ((track->what & m->moves) == KEY_OBJECT) {
            moved |= put_keyed_object(m, track->index, &key);
        }
    }
    return ok && (!moved || set_moved(m, k, r));
}

/* Updates meshes that change shape, if their instances may move. Returns 1 if any shape has changed. */
static int reshape(play_motion *m, double time_s)
{
    const struct model_motion *motion = m->job->loaded.motion;
    const double until = fmin(time_s, motion->end_s);
    if (motion->reshapes == NULL || until == m->shaped_s) {
        return 0;
    }
    model_pose_shapes(&m->job->loaded, time_s);
    m->shaped_s = until;
    for (uint32_t i = 0; i < m->job->loaded.scene.instance_count; ++i) {
        m->instance[i].revision += motion->reshapes[i];
    }
    return 1;
}

static int set_by_animations(play_motion *m, int32_t k, double time_s, report *r)
{
    const model *loaded = &m->job->loaded;
    int moved = 0;
    if (!model_pose(m->instance_posed, m->light_posed, m->camera, loaded, time_s)) {
        return report_fail(r,
                           "%s: at frame %d its animations lead nowhere: a scale of 0, or numbers that are too large",
                           m->job->o.scene, (int)k);
    }
    for (uint32_t i = 0; (m->moves & KEY_LIGHT) != 0 && i < m->job->scene.light_count; ++i) {
        put_light(m, i, m->light_posed[i]);
    }
    for (uint32_t i = 0; (m->moves & KEY_OBJECT) != 0 && i < m->job->scene.instance_count; ++i) {
        moved |= put_object(m, i, &m->instance_posed[i].to_world);
    }
    moved |= (m->moves & KEY_OBJECT) != 0 && reshape(m, time_s);
    if ((m->moves & KEY_CAMERA) != 0 && m->camera_used >= 0) {
        const model_camera *c = &m->camera[m->camera_used];
        m->job->middle.eye = c->eye;
        m->job->middle.right = c->right;
        m->job->middle.up = c->up;
        m->job->middle.back = c->back;
    }
    return !moved || set_moved(m, k, r);
}

int play_motion_set(play_motion *m, int32_t k, report *r)
{
    const double time_s = (double)k / (double)m->options->fps;
    m->job->middle = m->view_at_rest;
    if (m->path.key_count > 0) {
        return set_by_path(m, k, time_s, r);
    }
    if (m->is_animated) {
        return set_by_animations(m, k, time_s, r);
    }
    for (uint32_t i = 0; i < m->job->scene.light_count; ++i) {
        if (m->radius[i] > 0.0f) {
            put_light(m, i, wandering(m, i, time_s));
        }
    }
    const double angle = (double)m->swing * sin(two_pi * time_s / TURN_S);
    if (angle != 0.0) {
        lmb_view *v = &m->job->middle;
        v->eye = swung(m, angle);
        v->right = normalize3(turned(v->right, angle));
        v->back = normalize3(turned(v->back, angle));
        v->up = cross3(v->back, v->right);
    }
    return 1;
}

/* --- before the first frame --------------------------------------------------------------------------------------- */

/* Was it baked to move? Without a transfer, everything may move. */
static int may_move(const play_motion *m, uint32_t instance)
{
    const lmb_transfer *t = m->options->render.transfer != NULL ? &m->job->transfer : NULL;
    const uint32_t id = m->job->scene.instances[instance].first_id;
    int any = t == NULL;
    for (uint32_t i = 0; t != NULL && i < t->count[LMB_TRANSFER_MOVING]; ++i) {
        const uint32_t *range = t->section[LMB_TRANSFER_MOVING] + LMB_TRANSFER_MOVING_WORDS * (size_t)i;
        any |= id >= range[0] && id < range[1];
    }
    return any;
}

/* Does the scene contain the item that a track moves? */
static int check_track(const play_motion *m, const key_track *t, report *r)
{
    static const char *const names[] = {"", "light", "camera", "", "object"};
    const lmb_scene *s = &m->job->scene;
    const uint32_t count = t->what == KEY_LIGHT ? s->light_count : t->what == KEY_OBJECT ? s->instance_count : 1;
    if (t->index >= count) {
        return report_fail(r, "%s: line %u: no %s:%u; the scene has %u, numbered from 0", m->options->path,
                           (unsigned)t->line, names[t->what], (unsigned)t->index, (unsigned)count);
    }
    if (t->what == KEY_LIGHT && is_sun(&m->light[t->index]) && !m->path.key[t->first].has_target) {
        return report_fail(r, "%s: line %u: light:%u is a sun, which has only a direction; give its keys a target",
                           m->options->path, (unsigned)t->line, (unsigned)t->index);
    }
    if (t->what == KEY_LIGHT && m->job->o.world_changes && t->index >= m->job->own_lights) {
        return report_fail(r, "%s: line %u: light:%u is the sun of a numbered --world, which moves by itself",
                           m->options->path, (unsigned)t->line, (unsigned)t->index);
    }
    return t->what != KEY_OBJECT || may_move(m, t->index) ||
           report_fail(r,
                       "%s: line %u: object:%u stands still in what was baked; bake it with --moving %u, or leave out "
                       "--transfer",
                       m->options->path, (unsigned)t->line, (unsigned)t->index, (unsigned)t->index);
}

static int check_path(const play_motion *m, report *r)
{
    uint32_t used = 0;
    for (uint32_t t = 0; t < m->path.track_count; ++t) {
        if ((m->path.track[t].what & m->moves) != 0 && ++used > 0 && !check_track(m, &m->path.track[t], r)) {
            return 0;
        }
    }
    return used > 0 || report_fail(r, "%s: nothing in it that --move lets move", m->options->path);
}

/* Rejects moving lights that are in a light tree, from the scene or the sky. The tree is not rebuilt for each frame. */
static int check_lights(play_motion *m, report *r)
{
    if (m->job->many_lights.tree.node == NULL || m->job->scene.light_count > 0 || (m->moves & KEY_LIGHT) == 0) {
        return 1;
    }
    if (m->moves == KEY_LIGHT) {
        return report_fail(r, "--move light: the scene's %u lights are in a tree, where they stand still",
                           (unsigned)m->job->many_lights.tree.lights);
    }
    m->moves &= ~KEY_LIGHT;
    return 1;
}

/* Does any of these nodes move? */
static int any_moves(const struct model_motion *motion, const uint32_t *node, uint32_t count)
{
    int any = 0;
    for (uint32_t i = 0; i < count; ++i) {
        any |= node[i] != MODEL_NONE && motion->moves[node[i]];
    }
    return any;
}

/* The subset of `moves` that the file's animations move: the file's lights, the camera in use, objects. */
static int animated(play_motion *m, report *r)
{
    const model *loaded = &m->job->loaded;
    const struct model_motion *motion = loaded->motion;
    const model_camera *camera = m->options->render.view.has_eye ? NULL : render_camera(&m->job->o, loaded, r);
    int all = 0;
    m->camera_used = camera != NULL ? (int32_t)(camera - loaded->cameras) : -1;
    if (motion == NULL) {
        return 0;
    }
    all |= m->options->render.light_count == 0 && any_moves(motion, motion->of_light, loaded->scene.light_count)
               ? KEY_LIGHT
               : 0;
    all |= camera != NULL && any_moves(motion, motion->of_camera + m->camera_used, 1) ? KEY_CAMERA : 0;
    all |= motion->shapes != NULL || any_moves(motion, motion->of_instance, loaded->scene.instance_count) ? KEY_OBJECT
                                                                                                          : 0;
    return all & m->moves;
}

/* Does an animation move an object that was baked as static? */
static int moves_baked(const play_motion *m)
{
    const struct model_motion *motion = m->job->loaded.motion;
    int any = 0;
    for (uint32_t i = 0; motion != NULL && i < m->job->loaded.scene.instance_count; ++i) {
        const int moves = any_moves(motion, motion->of_instance + i, 1) ||
                          (motion->reshapes != NULL && motion->reshapes[i] != 0);
        any |= moves && !may_move(m, i);
    }
    return any;
}

int play_motion_find(play_motion *m, render_job *j, report *r)
{
    const model *loaded = &j->loaded;
    m->job = j;
    if (m->path.key_count > 0) {
        return 1;
    }
    int all = animated(m, r);
    report_note(loaded->idle_channels == 0 || m->options->render.view.is_quiet,
                "note: channels of animations that move nothing of the scene, or what does not move here: %u",
                (unsigned)loaded->idle_channels);
    if (loaded->motion_problem.text[0] != '\0') {
        return report_fail(r, "%s; or give --path", loaded->motion_problem.text);
    }
    if ((all & KEY_OBJECT) != 0 && moves_baked(m)) {
        if (m->moves == KEY_OBJECT) {
            return report_fail(r, "--move object: what was baked holds for objects that stand still; name those that "
                                  "move by `lambent bake --moving`, or leave out --transfer");
        }
        report_note(m->options->render.view.is_quiet, "objects stand still: what was baked holds for those that do");
        all &= ~KEY_OBJECT;
    }
    if (all == 0 && m->moves == KEY_OBJECT) {
        return report_fail(r, "--move object: nothing in %s moves objects; give --path FILE", m->job->o.scene);
    }
    m->is_animated = all != 0;
    if (!m->is_animated && m->moves == EVERYTHING && loaded->facts.animations > 0) { /* the file specifies the motion */
        report_note(
            m->options->render.view.is_quiet,
            "nothing moves: of the animations of %s nothing is left here; --move light or camera moves those by "
            "themselves",
            m->job->o.scene);
        m->moves = 0;
    }
    m->moves = m->is_animated ? all : m->moves;
    return 1;
}

/* Copies cameras from the file, and lights and objects from before the motion. */
static int take_poses(play_motion *m, report *r)
{
    const model *loaded = &m->job->loaded;
    const size_t lights = m->job->scene.light_count * sizeof *m->light;
    const size_t own_lights = loaded->scene.light_count * sizeof *m->light; /* may be more, and are posed too */
    const size_t instances = m->job->scene.instance_count * sizeof *m->instance;
    const size_t cameras = loaded->camera_count * sizeof *m->camera;
    m->light_posed = malloc((lights > own_lights ? lights : own_lights) + RENDER_SUNS * sizeof *m->light);
    m->instance_posed = malloc(instances + 1);
    m->camera = malloc(cameras + 1);
    if (m->light_posed == NULL || m->instance_posed == NULL || m->camera == NULL) {
        return report_fail(r, "not enough memory for what moves");
    }
    if (own_lights > 0) {
        memcpy(m->light_posed, loaded->scene.lights, own_lights);
    }
    memcpy(m->light_posed, m->light_at_rest, lights);
    memcpy(m->instance_posed, m->instance_at_rest, instances);
    if (cameras > 0) {
        memcpy(m->camera, loaded->cameras, cameras);
    }
    return 1;
}

static int take(play_motion *m, report *r)
{
    const lmb_scene *s = &m->job->scene;
    const size_t lights = s->light_count * sizeof *m->light, instances = s->instance_count * sizeof *m->instance;
    m->light = malloc(lights + RENDER_SUNS * sizeof *m->light);
    m->light_at_rest = malloc(lights + RENDER_SUNS * sizeof *m->light);
    m->instance = malloc(instances + 1);
    m->instance_at_rest = malloc(instances + 1);
    m->radius = calloc(s->light_count + RENDER_SUNS, sizeof *m->radius);
    if (m->light == NULL || m->light_at_rest == NULL || m->instance == NULL || m->instance_at_rest == NULL ||
        m->radius == NULL) {
        return report_fail(r, "not enough memory for what moves");
    }
    if (lights > 0) {
        memcpy(m->light, s->lights, lights);
        memcpy(m->light_at_rest, s->lights, lights);
    }
    memcpy(m->instance, s->instances, instances);
    memcpy(m->instance_at_rest, s->instances, instances);
    return 1;
}

int play_motion_read(play_motion *m, const play_options *o, report *r)
{
    memset(m, 0, sizeof *m);
    m->options = o;
    m->moves = o->move;
    m->shaped_s = -1.0;
    return o->path == NULL || key_path_read(&m->path, o->path, r);
}

int play_motion_make(play_motion *m, report *r)
{
    render_job *j = m->job;
    m->view_at_rest = j->middle;
    if (!take(m, r) || !check_lights(m, r) || (m->is_animated && !take_poses(m, r))) {
        return 0;
    }
    j->scene.lights = m->light;
    j->scene.instances = m->instance;
    return m->path.key_count > 0 ? check_path(m, r) : m->is_animated || find_room(m, r);
}

void play_motion_suns(play_motion *m)
{
    for (uint32_t i = m->job->own_lights; i < m->job->scene.light_count; ++i) {
        m->light_at_rest[i] = m->light[i];
        m->radius[i] = 0.0f;
        if (m->light_posed != NULL) {
            m->light_posed[i] = m->light[i];
        }
    }
}

double play_motion_end(const play_motion *m)
{
    return m->is_animated ? m->job->loaded.motion->end_s : key_path_end(&m->path);
}

int play_motion_is_over(const play_motion *m, double time_s)
{
    return (m->options->path != NULL || m->is_animated) && time_s > play_motion_end(m);
}

void play_motion_free(play_motion *m)
{
    free(m->light);
    free(m->light_at_rest);
    free(m->instance);
    free(m->instance_at_rest);
    free(m->light_posed);
    free(m->instance_posed);
    free(m->camera);
    free(m->radius);
    key_path_free(&m->path);
    memset(m, 0, sizeof *m);
}
