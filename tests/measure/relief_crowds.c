/* relief_crowds.c: a thousand placements of six models in one picture: reliefs against meshes of 60,000 and 3,000
 * triangles, by time and error against the whole meshes. The list is fixed; no constant of the reliefs was chosen by
 * these scenes. [P11] */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../src/base/vec.h"
#include "../../tools/relief/relief_compare.h"
#include "../../tools/relief/relief_crowd.h"
#include "../baroque.h"
#include "relief_stage.h"

enum { MODELS = 6, PLACES = 1000, ACROSS = 40, WIDE = 1280, HIGH = 720, MAP = 1024, FINE = 250 };
enum { VIEW_SIDE = 64, SIMPLE = 500, RUNS = 3 };

static const uint32_t counts[] = {60000, 3000};
enum { MESHES = sizeof counts / sizeof *counts };

/* One model in all forms. */
typedef struct crowd_model {
    subject *whole;
    triangle_mesh mesh[MESHES], simple;
    relief_scene drawn[MESHES];
    relief_bake bake;
    file_bytes file;
} crowd_model;

/* All placements of one form as a scene. */
typedef struct crowd_scene {
    lmb_mesh meshes[MODELS];
    lmb_instance instances[PLACES];
    lmb_scene scene;
} crowd_scene;

static double random_of(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (double)(*state >> 8) / 16777216.0;
}

static void make_model(crowd_model *m, int i, report *r)
{
    static const statue small[3] = {{"rhino", "meshes/rhino_60k.ply", SIMPLE},
                                    {"bunny", "meshes/stanford_bunny.obj", SIMPLE},
                                    {"lucy", "meshes/lucy_100k.ply", SIMPLE}};
    simplify_facts facts;
    lmb_vec3 direction[LMB_RELIEF_VIEWS];
    m->whole = i < 3 ? subject_make(&small[i], r) : NULL;
    if (m->whole == NULL) {
        triangle_mesh shape = baroque(i % BAROQUE_KINDS, 11 + (uint32_t)i, FINE);
        m->whole = subject_of(&shape, SIMPLE, r);
        triangle_mesh_free(&shape);
    }
    int ok = 1;
    for (int k = 0; k < MESHES && ok; ++k) {
        ok = simplify_mesh(&m->mesh[k], &m->whole->mesh, counts[k], SIMPLIFY_NEAR, &facts, r) &&
             relief_scene_of(&m->drawn[k], &m->mesh[k], r);
    }
    relief_directions(direction, RELIEF_VIEWS);
    m->bake.format = LMB_RELIEF_FULL;
    for (int k = 0; k < RELIEF_VIEWS && ok; ++k) {
        const lmb_view v = relief_fit(&m->whole->mesh, direction[k], VIEW_SIDE);
        ok = relief_add(&m->bake, &m->whole->complex.scene, &v, r);
    }
    if (!ok || !relief_encode(&m->file, &m->bake, &m->whole->simple, r)) {
        give_up(r);
    }
}

static void free_model(crowd_model *m)
{
    for (int k = 0; k < MESHES; ++k) {
        triangle_mesh_free(&m->mesh[k]);
        relief_scene_free(&m->drawn[k]);
    }
    relief_bake_free(&m->bake);
    file_free(&m->file);
    subject_free(m->whole);
}

/* Places each model upright on a jittered lattice, a metre across, and turned. */
static void place_all(relief_crowd *c, crowd_model *figure, report *r)
{
    uint32_t state = 5;
    c->placed = calloc(PLACES, sizeof *c->placed);
    c->file = calloc(MODELS, sizeof *c->file);
    for (int i = 0; c->file != NULL && i < MODELS; ++i) {
        c->file[i] = calloc(1, sizeof **c->file);
        if (c->file[i] == NULL || lmb_relief_open(&c->file[i]->relief, figure[i].file.data, figure[i].file.size) != LMB_OK) {
            report_fail(r, "no relief");
            give_up(r);
        }
        ++c->files;
    }
    for (int i = 0; c->placed != NULL && i < PLACES; ++i) {
        relief_placed *p = &c->placed[c->count++];
        const int which = (i * 7 + i / ACROSS * 3) % MODELS;
        const float turn = (float)(6.28318 * random_of(&state));
        p->relief = &c->file[which]->relief;
        p->scale = (float)(0.9 + 0.3 * random_of(&state)) / figure[which].whole->diagonal;
        p->cosine = lmb_cos(turn);
        p->sine = lmb_sin(turn);
        p->at = vec3((float)(i % ACROSS) - 19.5f + (float)(0.3 * random_of(&state)), -p->scale * p->relief->low.y,
                     -(float)(i / ACROSS) + (float)(0.3 * random_of(&state)));
    }
    if (c->count != PLACES || !relief_crowd_scene(c, r)) {
        give_up(r);
    }
}

/* The placements of `crowd` with other meshes. form: MESHES for the whole ones. */
static void scene_of(crowd_scene *out, const relief_crowd *crowd, crowd_model *figure, int form)
{
    uint32_t next = 1;
    memset(out, 0, sizeof *out);
    out->scene = crowd->scene;
    for (int i = 0; i < MODELS; ++i) {
        out->meshes[i] = form == MESHES ? figure[i].whole->complex.mesh : figure[i].drawn[form].mesh;
    }
    for (int i = 0; i < PLACES; ++i) {
        out->instances[i] = crowd->instances[i];
        out->instances[i].first_id = next;
        next += out->meshes[out->instances[i].mesh].triangle_count;
    }
    out->scene.meshes = out->meshes;
    out->scene.instances = out->instances;
}

/* Draws a picture RUNS times; keeps the shortest time, s. */
static double shoot_best(relief_frame *out, const relief_shot *shot, int runs, report *r)
{
    double best = 1e30;
    for (int i = 0; i < runs; ++i) {
        if (i > 0) {
            relief_frame_free(out);
        }
        if (!relief_shoot(out, shot, r)) {
            give_up(r);
        }
        best = fmin(best, out->light_s + out->draw_s + out->band_s);
    }
    return best;
}

static void tell_crowd(const char *name, double s, const relief_frame *test, const relief_frame *truth, report *r)
{
    relief_figures f;
    if (!relief_measure(&f, test, truth, 1.0, r)) {
        give_up(r);
    }
    printf("%-16s %8.0f ms (map %.0f)  light %.2f dB, with shadows %.2f  covered in common %.2f %%  isolated %.3f %%\n",
           name, 1e3 * s, 1e3 * test->light_s, f.psnr_db, f.shadowed_db, 100.0 * f.iou, 100.0 * f.isolated);
}

static void draw_forms(relief_shot shot, const relief_crowd *crowd, crowd_model *figure, const char *where, report *r)
{
    relief_frame truth, test;
    static crowd_scene scene;
    scene_of(&scene, crowd, figure, MESHES);
    shot.scene = &scene.scene;
    const double whole_s = shoot_best(&truth, &shot, 1, r);
    printf("%s: whole meshes %.0f ms\n", where, 1e3 * whole_s);
    relief_show(where, truth.rgb, truth.width, truth.height, r);
    double mesh_s[MESHES] = {0.0};
    for (int k = 0; k < MESHES; ++k) {
        char name[32];
        scene_of(&scene, crowd, figure, k);
        mesh_s[k] = shoot_best(&test, &shot, k == 0 ? 2 : RUNS, r);
        snprintf(name, sizeof name, "%u triangles", (unsigned)counts[k]);
        tell_crowd(name, mesh_s[k], &test, &truth, r);
        relief_frame_free(&test);
    }
    shot.scene = NULL;
    shot.crowd = crowd;
    const double relief_s = shoot_best(&test, &shot, RUNS, r);
    tell_crowd("reliefs", relief_s, &test, &truth, r);
    char name[64];
    snprintf(name, sizeof name, "%s_reliefs", where);
    relief_show(name, test.rgb, test.width, test.height, r);
    relief_frame_free(&test);
    relief_frame_free(&truth);
    printf("%-16s %.1f times as fast as 60,000 triangles\n", "", mesh_s[0] / relief_s);
    bar(where, "reliefs at least five times as fast as 60,000 triangles", mesh_s[0] >= 5.0 * relief_s);
}

void relief_crowds(report *r)
{
    static crowd_model figure[MODELS];
    static const struct { const char *name; lmb_vec3 eye, target; } cameras[] = {
        {"crowd from above", {0, 9, 8}, {0, 0, -10}}, {"crowd from within", {0, 1.7f, 3}, {0.5f, 0.3f, -10}}};
    relief_crowd crowd;
    memset(&crowd, 0, sizeof crowd);
    for (int i = 0; i < MODELS; ++i) {
        make_model(&figure[i], i, r);
    }
    place_all(&crowd, figure, r);
    for (int i = 0; i < 2; ++i) {
        const lmb_light sun = {{0, 0, 0}, {-0.45f, -0.8f, -0.3968627f}, {3.0f, 2.9f, 2.7f}, 1.0f, 1.0f,
                               LMB_LIGHT_DIRECTIONAL, 0, 0};
        relief_shot shot;
        memset(&shot, 0, sizeof shot);
        shot.kernels = lmb_kernels_pick();
        if (lmb_view_look_at(&shot.view, cameras[i].eye, cameras[i].target, vec3(0, 1, 0), 0.8f, WIDE, HIGH) != LMB_OK) {
            exit(1);
        }
        shot.view.near_m = 0.05f;
        shot.light = &sun;
        shot.shadow_map = MAP;
        shot.ambient = 0.4f;
        draw_forms(shot, &crowd, figure, cameras[i].name, r);
    }
    relief_crowd_free(&crowd);
    for (int i = 0; i < MODELS; ++i) {
        free_model(&figure[i]);
    }
}
