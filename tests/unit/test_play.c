/* test_play.c: keys of a path, interpolation, motion without a path, and timing figures. */
#include "../folder.h"

#include <math.h>

#include "../../src/base/vec.h"
#include "../../tools/common/frame_name.h"
#include "../../tools/play/play_options.h"
#include "../../tools/common/key_path.h"
#include "../../tools/play/play_motion.h"
#include "../../tools/play/play_times.h"

void test_play(void);

static folder place;

static const char *keys(const char *text) { return folder_put(&place, "keys.txt", text, strlen(text)); }

static int is_at(lmb_vec3 v, double x, double y, double z)
{
    return fabs((double)v.x - x) < 1e-6 && fabs((double)v.y - y) < 1e-6 && fabs((double)v.z - z) < 1e-6;
}

/* Interleaved keys of two things. Along a line with even keys the speed is constant, so the curve is the line. */
static void goes_through_keys(void)
{
    key_path p;
    report r = {""};
    const char *file = keys("0 light:1 0,0,0\n0.5 camera 1,2,3 4,5,6 # a comment\n1 light:1 2,0,-4\n\n2 light:1 4,0,-8\n");
    CHECK_MSG(key_path_read(&p, file, &r), "%s", r.text);
    CHECK(p.track_count == 2 && p.key_count == 4 && key_path_end(&p) == 2.0);
    CHECK(p.track[0].what == KEY_LIGHT && p.track[0].index == 1 && p.track[0].count == 3 && p.track[0].line == 1);
    CHECK(p.track[1].what == KEY_CAMERA && p.track[1].count == 1 && p.track[1].line == 2);
    for (int i = 0; i <= 16; ++i) {
        const double t = i / 8.0;
        CHECK(is_at(key_path_at(&p, &p.track[0], t).at, 2 * t, 0, -4 * t));
    }
    CHECK(is_at(key_path_at(&p, &p.track[0], 99.0).at, 4, 0, -8));
    CHECK(is_at(key_path_at(&p, &p.track[1], 0.0).at, 1, 2, 3));
    CHECK(is_at(key_path_at(&p, &p.track[1], 7.0).target, 4, 5, 6));
    key_path_free(&p);
}

/* Passes through each key with the same speed before and after it, for any times. */
static void is_smooth(void)
{
    static const double at[] = {0, 0.5, 2, 2.25, 5};
    key_path p;
    report r = {""};
    const char *file = keys("0 camera 0,0,0 0,0,9\n0.5 camera 1,0,3 1,0,9\n2 camera -1,2,0 0,1,9\n2.25 camera -1,3,1 0,0,8\n"
                            "5 camera 4,4,4 0,0,9\n");
    CHECK_MSG(key_path_read(&p, file, &r), "%s", r.text);
    for (int i = 0; i < 5; ++i) {
        const path_key *key = &p.key[p.track[0].first + (uint32_t)i];
        CHECK(is_at(key_path_at(&p, &p.track[0], at[i]).at, (double)key->at.x, (double)key->at.y, (double)key->at.z));
    }
    for (int i = 1; i < 4; ++i) {
        const double step = 1e-3;
        const path_key a = key_path_at(&p, &p.track[0], at[i] - step), b = key_path_at(&p, &p.track[0], at[i]),
                       c = key_path_at(&p, &p.track[0], at[i] + step);
        const double before = ((double)b.at.x - (double)a.at.x) / step, after = ((double)c.at.x - (double)b.at.x) / step;
        CHECK_MSG(fabs(after - before) < 0.05 * (1.0 + fabs(after)), "%g m/s, then %g", before, after);
        CHECK(fabs((double)c.target.z - (double)a.target.z) < 0.02);
    }
    key_path_free(&p);
}

/* object:0 at positions with targets: a mirrored object stays mirrored, its +Z points to the target and its +Y stays
 * up. A key without a target does not change its rotation. */
static void turns_objects(void)
{
    static const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    static render_job job;
    lmb_mesh mesh;
    lmb_material material;
    lmb_instance instance;
    play_motion m;
    play_options o;
    report r = {""};
    memset(&job, 0, sizeof job);
    memset(&mesh, 0, sizeof mesh);
    memset(&material, 0, sizeof material);
    memset(&instance, 0, sizeof instance);
    memset(&o, 0, sizeof o);
    mesh.positions = corners;
    mesh.vertex_count = 3;
    mesh.triangle_count = 1;
    material.texture = -1;
    material.alpha = 1.0f;
    instance.first_id = 1;
    instance.to_world.m[0] = -2.0f; /* mirrored */
    instance.to_world.m[5] = 3.0f;
    instance.to_world.m[10] = 0.5f;
    instance.to_world.m[15] = 1.0f;
    job.scene.meshes = &mesh;
    job.scene.materials = &material;
    job.scene.instances = &instance;
    job.scene.mesh_count = job.scene.material_count = job.scene.instance_count = 1;
    o.move = KEY_LIGHT | KEY_CAMERA | KEY_OBJECT;
    o.fps = 1.0f;
    static const struct { const char *keys; double axis[3][3]; } cases[] = {
        {"0 object:0 1,2,3 1,2,9\n", {{-2, 0, 0}, {0, 3, 0}, {0, 0, 0.5}}},
        {"0 object:0 1,2,3 8,2,3\n", {{0, 0, 2}, {0, 3, 0}, {0.5, 0, 0}}},
        {"0 object:0 1,2,3 -4,2,3\n", {{0, 0, -2}, {0, 3, 0}, {-0.5, 0, 0}}},
        {"0 object:0 1,2,3 1,2,-1\n", {{2, 0, 0}, {0, 3, 0}, {0, 0, -0.5}}},
        {"0 object:0 1,2,3 1,6,7\n", {{-2, 0, 0}, {0, 2.12132034, -2.12132034}, {0, 0.35355339, 0.35355339}}},
        {"0 object:0 1,2,3 1,9,3\n", {{-2, 0, 0}, {0, 0, -3}, {0, 0.5, 0}}},
        {"0 object:0 1,2,3\n", {{-2, 0, 0}, {0, 3, 0}, {0, 0, 0.5}}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        job.scene.instances = &instance;
        o.path = keys(cases[i].keys);
        CHECK_MSG(play_motion_read(&m, &o, &r) && play_motion_find(&m, &job, &r) && play_motion_make(&m, &r) &&
                  play_motion_set(&m, 0, &r), "case %d: %s", (int)i, r.text);
        const float *to = job.scene.instances[0].to_world.m;
        for (int c = 0; c < 3; ++c) {
            const double *want = cases[i].axis[c];
            CHECK_MSG(is_at(vec3(to[4 * c], to[4 * c + 1], to[4 * c + 2]), want[0], want[1], want[2]),
                      "case %d, axis %d: %g %g %g", (int)i, c, (double)to[4 * c], (double)to[4 * c + 1],
                      (double)to[4 * c + 2]);
        }
        CHECK(is_at(vec3(to[12], to[13], to[14]), 1, 2, 3) && job.scene.instances[0].revision == 1);
        play_motion_free(&m);
    }
}

static void names_frames(void)
{
    char name[32];
    report r = {""};
    CHECK(frame_name(name, sizeof name, "a/f_%04d.png", 7, &r) && strcmp(name, "a/f_0007.png") == 0);
    CHECK(frame_name(name, sizeof name, "%02d.pfm", 123, &r) && strcmp(name, "123.pfm") == 0);
    CHECK(frame_name(name, sizeof name, "50%_%04d.png", 7, &r) && strcmp(name, "50%_0007.png") == 0);
    CHECK(frame_name(name, sizeof name, "%04d-%d.png", 7, &r) && strcmp(name, "0007-%d.png") == 0);
    CHECK(frame_digits("%%_%03d") == 0 && frame_digits("%03d%%") == 0 && frame_digits("50%.png") == 0 && frame_digits("%02d_%02d") == 0 && frame_digits("%") == 0);
    CHECK(!frame_name(name, 8, "frames%04d.png", 0, &r) && r.text[0] != '\0');
}

static void sums_times_up(void)
{
    play_times t;
    play_time one;
    report r = {""};
    text_buffer b;
    memset(&b, 0, sizeof b);
    CHECK(play_times_make(&t, 100, &r));
    play_times_print(&b, &t);
    CHECK(b.size == 0);
    for (int i = 0; i < 100; ++i) {
        memset(&one, 0, sizeof one);
        one.clock_s[PLAY_WHOLE] = (double)((i * 37) % 100 + 1);
        one.cpu_s[PLAY_WHOLE] = 2.0;
        play_times_add(&t, &one);
    }
    const play_figure clock = play_times_of(&t, PLAY_WHOLE, 0), cpu = play_times_of(&t, PLAY_WHOLE, 1);
    CHECK(clock.low == 1.0 && clock.median == 50.5 && clock.p95 == 95.0);
    CHECK(cpu.low == 2.0 && cpu.median == 2.0 && cpu.p95 == 2.0);
    t.count = 1;
    CHECK(play_times_of(&t, PLAY_WHOLE, 0).p95 == play_times_of(&t, PLAY_WHOLE, 0).low);
    play_times_print(&b, &t);
    CHECK(strstr(b.data, "whole frame") != NULL && strstr(b.data, "bands") == NULL);
    text_buffer_free(&b);
    play_times_free(&t);
}

/* --- motion of the demo ------------------------------------------------------------------------------------------- */

static play_options options;
static render_job job;
static play_motion motion;

/* The demo at the start of `play` with this option; the transfer's ranges of moving ids, if any. */
static int begin_demo(const char *what, const char *path, uint32_t *ranges, uint32_t range_count)
{
    const char *line[] = {"play", "demo", "-o", "none_%02d.pfm", "--size", "32x24", "-q", "--fps", "2", "--move", what,
                          "--path", path};
    char *words[sizeof line / sizeof *line];
    const int count = (int)(sizeof line / sizeof *line) - (path != NULL ? 0 : 2);
    report r = {""};
    memset(&job, 0, sizeof job);
    for (int i = 0; i < count; ++i) {
        words[i] = (char *)(uintptr_t)line[i];
    }
    int ok = play_options_parse(&options, count, words, &r) == OPTIONS_RUN;
    job.o = options.render;
    ok = ok && play_motion_read(&motion, &options, &r) && render_job_load(&job, &r) &&
         play_motion_find(&motion, &job, &r) && render_job_set(&job, &r);
    CHECK_MSG(ok, "%s", r.text);
    if (ok && ranges != NULL) {
        options.render.transfer = "baked";
        job.transfer.count[LMB_TRANSFER_MOVING] = range_count;
        job.transfer.section[LMB_TRANSFER_MOVING] = ranges;
    }
    return ok && play_motion_make(&motion, &r);
}

static void end_demo(void)
{
    job.transfer.section[LMB_TRANSFER_MOVING] = NULL;
    play_motion_free(&motion);
    render_job_free(&job);
}

static int near_vec(lmb_vec3 a, lmb_vec3 b) { return length3(sub3(a, b)) < 1e-4f; }

/* Lights move on figures of eight within the room, and the camera on an arc around its target. Both return after 10 s,
 * and each frame is the same whichever frame was set before. */
static void moves_by_itself(void)
{
    report r = {""};
    const int ok = begin_demo("all", NULL, NULL, 0);
    CHECK(ok && motion.swing > 0.0f && motion.radius != NULL && motion.radius[0] > 0.0f);
    if (ok) {
        const lmb_view rest = job.middle;
        const lmb_light lamp = job.scene.lights[0];
        const lmb_vec3 arm = sub3(rest.eye, motion.middle), low = job.scene.bounds_min, high = job.scene.bounds_max;
        CHECK(play_motion_set(&motion, 0, &r) && memcmp(&job.middle, &rest, sizeof rest) == 0);
        CHECK(memcmp(&job.scene.lights[0], &lamp, sizeof lamp) == 0);
        for (int k = 0; k <= 20; ++k) {
            CHECK(play_motion_set(&motion, k, &r));
            const lmb_view *v = &job.middle;
            const lmb_vec3 at = job.scene.lights[0].position, now = sub3(v->eye, motion.middle);
            CHECK(at.x > low.x && at.x < high.x && at.z > low.z && at.z < high.z && at.y == lamp.position.y);
            CHECK(length3(sub3(at, lamp.position)) <= 1.001f * motion.radius[0]);
            CHECK(fabsf(length3(now) - length3(arm)) < 1e-4f && fabsf(v->eye.y - rest.eye.y) < 1e-6f);
            CHECK(fabsf(dot3(now, v->back) - dot3(arm, rest.back)) < 1e-4f);
            CHECK(fabsf(dot3(now, v->right) - dot3(arm, rest.right)) < 1e-4f);
            CHECK(near_vec(cross3(v->right, v->up), v->back) && fabsf(length3(v->right) - 1.0f) < 1e-5f);
            CHECK(k % 10 != 0 || (near_vec(at, lamp.position) && near_vec(v->eye, rest.eye)));
        }
        CHECK(play_motion_set(&motion, 5, &r)); /* a quarter of the 10 s */
        CHECK(fabsf(job.scene.lights[0].position.x - lamp.position.x - motion.radius[0]) < 1e-4f);
        CHECK(fabsf(dot3(job.middle.back, rest.back) -
                    (1.0f - (1.0f - cosf(motion.swing)) * (1.0f - rest.back.y * rest.back.y))) < 1e-4f);
        const lmb_view quarter = job.middle;
        const lmb_light lit = job.scene.lights[0];
        CHECK(play_motion_set(&motion, 5, &r) && job.scene.lights[0].revision == lit.revision);
        CHECK(play_motion_set(&motion, 3, &r) && job.scene.lights[0].revision == lit.revision + 1);
        CHECK(!near_vec(job.middle.eye, quarter.eye) && job.scene.lights[0].position.z != lamp.position.z);
        CHECK(play_motion_set(&motion, 5, &r) && memcmp(&job.middle, &quarter, sizeof quarter) == 0);
        CHECK(near_vec(job.scene.lights[0].position, lit.position));
    }
    end_demo();
}

/* With baked light, a path moves only objects that were baked as movable. */
static void moves_baked_objects(void)
{
    const char *const path = keys("0 object:2 0,0,0\n1 object:2 0.1,0,0\n");
    CHECK(begin_demo("object", path, NULL, 0));
    const uint32_t id = job.scene.instances[2].first_id, last = job.scene.instances[1].first_id;
    end_demo();
    uint32_t both[] = {last, last + 1, id, id + 1}, before[] = {last, id}, after[] = {id + 1, id + 2};
    CHECK(begin_demo("object", path, both, 2));
    end_demo();
    CHECK(begin_demo("object", path, both + 2, 1));
    end_demo();
    CHECK(!begin_demo("object", path, before, 1));
    end_demo();
    CHECK(!begin_demo("object", path, after, 1));
    end_demo();
}

/* Motion of a path ends at the last key, motion of animations at the last of them, and the default motion never. */
static void ends_after_the_last_key(void)
{
    struct model_motion poses;
    CHECK(begin_demo("all", keys("0 light:0 0,1,0\n1.5 light:0 0,1,0.1\n"), NULL, 0));
    CHECK(!play_motion_is_over(&motion, 1.0) && !play_motion_is_over(&motion, 1.5) && play_motion_is_over(&motion, 2.0));
    end_demo();
    CHECK(begin_demo("all", NULL, NULL, 0));
    CHECK(!play_motion_is_over(&motion, 0.5) && !play_motion_is_over(&motion, 100.0));
    struct model_motion *const own = job.loaded.motion;
    memset(&poses, 0, sizeof poses);
    poses.end_s = 0.75;
    job.loaded.motion = &poses;
    motion.is_animated = 1;
    CHECK(!play_motion_is_over(&motion, 0.75) && play_motion_is_over(&motion, 1.0));
    motion.is_animated = 0;
    job.loaded.motion = own;
    end_demo();
}

void test_play(void)
{
    folder_open(&place);
    moves_by_itself();
    moves_baked_objects();
    ends_after_the_last_key();
    goes_through_keys();
    is_smooth();
    turns_objects();
    names_frames();
    sums_times_up();
    folder_close(&place);
}
