/* verb_explain.c: `lambent explain`: prints why a pixel has the light that it has. */
#include "verb_explain.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../common/io_json.h"
#include "../common/options.h"
#include "../common/progress.h"
#include "../render/render_draw.h"
#include "explain.h"

typedef struct explain_options {
    render_options render; /* first: the rows of `render` store into it */
    int32_t x, y;          /* px */
    int32_t has_pixel;
} explain_options;

static int parse_pixel(const char *text, void *at)
{
    explain_options *o = at;
    char rest;
    o->has_pixel = sscanf(text, "%9d,%9d%c", &o->x, &o->y, &rest) == 2; /* more digits do not fit */
    return o->has_pixel && o->x >= 0 && o->y >= 0;
}

static const option_row pixel_rows[] = {
    {.kind = OPTION_TITLE, .help = HELP("pixel")},
    {.name = "--pixel", .value = "X,Y", .kind = OPTION_OWN, .at = 0, .parse = parse_pixel,
     .expects = "two numbers from 0, from the picture's upper left corner: 320,240",
     .help = HELP("the pixel to explain, as `lambent compare` prints the worst one")},
    {.kind = OPTION_END},
};

static const option_table explain_table = {
    .verb = "explain",
    .usage = HELP("explain SCENE --pixel X,Y [options]"),
    .about = HELP("Prints why a pixel has its light: the surface that it shows, each light with the triangle that "
        "blocks it, and the surfaces that send the most bounced light. Give those options of the render that choose "
        "view, world, lights and bounced light.\n"
        "`the picture` is light of the render, at one sample per pixel. `traced` is light by exact shadows and, for "
        "one bounce, by 4,096 rays from the surface. If both differ, the method of the render loses light there or "
        "adds some."),
    .part = {render_scene_rows, pixel_rows, render_view_rows, render_world_rows, render_light_rows, render_bounce_rows,
             render_group_rows, render_other_rows},
    .examples = HELP("  lambent explain demo --size 160x120 --pixel 80,90\n"),
};

typedef struct explanation {
    explain_options o;
    render_job job;
    explain_space space;
    explain_place place;
    image direct;
    lmb_tile *tile;
    int32_t pixel; /* of the tile */
    float emission[3]; /* W/(sr m2), of the pixel's surface */
    explain_light *light;
    explain_bounce bounce;
    json doc; /* of a glTF file: names */
} explanation;

/* --- names -------------------------------------------------------------------------------------------------------- */

/* The name of an instance and of its material, or "". */
static void names_of(char node[64], char material[64], const explanation *e, uint32_t instance)
{
    const model *m = &e->job.loaded;
    const lmb_instance *of = &e->job.scene.instances[instance];
    node[0] = material[0] = '\0';
    if (e->doc.nodes != NULL && instance < m->scene.instance_count) {
        uint32_t nodes = json_first(&e->doc, json_member(&e->doc, 0, "nodes"));
        uint32_t materials = json_first(&e->doc, json_member(&e->doc, 0, "materials")), number = JSON_NONE;
        report unread = {""};
        json_read_uint(&number, &e->doc, json_member(&e->doc, m->source->primitive[instance], "material"), &unread);
        for (uint32_t i = 0; i < m->source->node[instance] && nodes != JSON_NONE; ++i) {
            nodes = json_next(&e->doc, nodes);
        }
        for (uint32_t i = 0; i < number && materials != JSON_NONE; ++i) {
            materials = json_next(&e->doc, materials);
        }
        json_string(node, 64, &e->doc, json_member(&e->doc, nodes, "name"));
        if (number != JSON_NONE) {
            json_string(material, 64, &e->doc, json_member(&e->doc, materials, "name"));
        }
    } else if (m->material_names != NULL && of->material < m->scene.material_count &&
               m->material_names[of->material] != NULL) {
        snprintf(material, 64, "%s", m->material_names[of->material]);
    }
}

static void print_instance(const explanation *e, uint32_t instance)
{
    char node[64], material[64];
    names_of(node, material, e, instance);
    report_say("instance %u", (unsigned)instance);
    if (node[0] != '\0') {
        report_say(" \"%s\"", node);
    }
    report_say(material[0] != '\0' ? ", material \"%s\"" : ", material %s%u", material,
               (unsigned)e->job.scene.instances[instance].material);
}

/* The instance of a triangle that is drawn. */
static uint32_t instance_of(const lmb_scene *scene, uint32_t id)
{
    lmb_triangle t;
    return lmb_triangle_fetch(&t, scene, id) ? (uint32_t)(t.instance - scene->instances) : 0;
}

static const lmb_material *material_of(const explanation *e)
{
    return &e->job.scene.materials[e->job.scene.instances[instance_of(&e->job.scene, e->place.id)].material];
}

static int is_unlit(const explanation *e) { return e->place.id > 0 && (material_of(e)->flags & LMB_UNLIT) != 0; }

/* --- output ----------------------------------------------------------------------------------------------------- */

static void print_rgb(const char *what, const float c[3], const char *unit)
{
    report_say("  %-12s %.4g %.4g %.4g%s\n", what, (double)c[0], (double)c[1], (double)c[2], unit);
}

static void print_surface(const explanation *e)
{
    const lmb_tile *t = e->tile;
    const explain_place *p = &e->place;
    const uint32_t instance = instance_of(&e->job.scene, p->id);
    const lmb_vec3 d = {p->at.x - e->job.middle.eye.x, p->at.y - e->job.middle.eye.y, p->at.z - e->job.middle.eye.z};
    const float albedo[3] = {t->albedo[0][e->pixel], t->albedo[1][e->pixel], t->albedo[2][e->pixel]};
    const lmb_material *m = material_of(e);
    report_say("surface\n  triangle %u of ", (unsigned)(p->id - e->job.scene.instances[instance].first_id));
    print_instance(e, instance);
    report_say("\n  %-12s %.4f %.4f %.4f, %.4g m from the eye\n", "position", (double)p->at.x, (double)p->at.y,
               (double)p->at.z, sqrt((double)(d.x * d.x + d.y * d.y + d.z * d.z)));
    report_say("  %-12s %.3f %.3f %.3f\n", "normal", (double)p->normal.x, (double)p->normal.y, (double)p->normal.z);
    print_rgb("albedo", albedo, "");
    if (m->emission[0] + m->emission[1] + m->emission[2] > 0.0f) {
        print_rgb("emits", e->emission, " W/(sr m2)");
    }
    if (is_unlit(e)) {
        report_say("  unlit: the picture shows the albedo, whatever light arrives\n");
    }
}

static float sum_of(const float c[3]) { return c[0] + c[1] + c[2]; }

static void print_light(const explanation *e, const explain_light *l)
{
    static const char *const kinds[] = {"point", "spot", "sun"};
    const lmb_light *light = &e->job.scene.lights[l->number];
    report_say("  %u %s, ", (unsigned)l->number, kinds[light->kind]);
    if (light->kind != LMB_LIGHT_DIRECTIONAL) {
        report_say("%.3g m, ", (double)l->far_m);
    }
    report_say("%.0f degrees off the normal: %.4g %.4g %.4g", (double)l->angle_deg, (double)l->open[0],
               (double)l->open[1], (double)l->open[2]);
    if (l->is_behind) {
        report_say(", behind the surface");
    } else if (l->is_blocked && l->blocker > 0) {
        const uint32_t instance = instance_of(&e->job.scene, l->blocker);
        report_say(", blocked %.3g m away by triangle %u of ", (double)l->blocker_m,
                   (unsigned)(l->blocker - e->job.scene.instances[instance].first_id));
        print_instance(e, instance);
    } else if (l->is_blocked) {
        report_say(", blocked");
    } else if (!(l->open[0] + l->open[1] + l->open[2] > 0.0f)) {
        report_say(sum_of(light->intensity) > 0.0f ? ", outside its cone or range" : ", dark");
    }
    report_say("\n");
}

static int by_open(const void *a, const void *b)
{
    const explain_light *x = a, *y = b;
    const float p = sum_of(x->open), q = sum_of(y->open);
    return p != q ? (p < q) - (p > q) : (x->number > y->number) - (x->number < y->number);
}

static void print_lights(explanation *e)
{
    const uint32_t count = e->job.scene.light_count;
    float sum[3] = {0.0f, 0.0f, 0.0f};
    for (uint32_t i = 0; i < count; ++i) {
        for (int c = 0; c < 3 && !e->light[i].is_behind && !e->light[i].is_blocked; ++c) {
            sum[c] += e->light[i].open[c];
        }
    }
    qsort(e->light, count, sizeof *e->light, by_open);
    report_say("lights, W/m2 if nothing blocked them\n");
    for (uint32_t i = 0; i < count && i < EXPLAIN_LIGHTS; ++i) {
        print_light(e, &e->light[i]);
    }
    if (count > EXPLAIN_LIGHTS) {
        report_say("  and %u weaker ones\n", (unsigned)(count - EXPLAIN_LIGHTS));
    }
    if (e->space.sky_count > 0) {
        double open[3], seen[3];
        explain_sky(open, seen, &e->space, &e->place);
        const double all = open[0] + open[1] + open[2];
        report_say("  sky: %.4g %.4g %.4g", open[0], open[1], open[2]);
        report_say(all > 0.0 ? ", %.1f %% of it blocked\n" : "\n",
                   all > 0.0 ? 100.0 - 100.0 * (seen[0] + seen[1] + seen[2]) / all : 0.0);
        for (int c = 0; c < 3; ++c) {
            sum[c] += (float)seen[c];
        }
    }
    print_rgb("traced", sum, " W/m2");
}

static void print_senders(const explanation *e)
{
    const explain_bounce *b = &e->bounce;
    const double all = b->irradiance[0] + b->irradiance[1] + b->irradiance[2];
    const float sum[3] = {(float)b->irradiance[0], (float)b->irradiance[1], (float)b->irradiance[2]};
    report_say("light of one bounce and of surfaces that emit\n");
    for (uint32_t i = 0; i < b->senders && i < EXPLAIN_SENDERS; ++i) {
        const explain_sender *s = &b->sender[i];
        const double part = s->irradiance[0] + s->irradiance[1] + s->irradiance[2];
        const double emitted = s->emitted[0] + s->emitted[1] + s->emitted[2];
        report_say("  %5.1f %%  ", 100.0 * part / all);
        print_instance(e, s->instance);
        report_say(", %.3g to %.3g m away%s\n", (double)s->near_m, (double)s->far_m,
                   emitted > 0.5 * part ? ", emits" : "");
    }
    if (b->senders > EXPLAIN_SENDERS) {
        report_say("  and %u weaker instances\n", (unsigned)(b->senders - EXPLAIN_SENDERS));
    }
    report_say("  %.1f %% of the rays leave the scene, %.1f %% hit surfaces without light\n",
               100.0 * b->missed / EXPLAIN_RAYS, 100.0 * b->dark / EXPLAIN_RAYS);
    print_rgb("traced", sum, " W/m2");
}

static void print_picture(const explanation *e)
{
    const size_t at = 3 * ((size_t)e->o.y * (size_t)e->job.linear.width + (size_t)e->o.x);
    const float *full = e->job.linear.pixels + at, *direct = e->direct.pixels + at;
    float bounced[3], irradiance[3], received[3]; /* received: without own emission */
    report_say("the picture, W/(sr m2)\n");
    print_rgb("light", full, "");
    if (is_unlit(e)) {
        return;
    }
    for (int c = 0; c < 3; ++c) {
        const float albedo = e->place.id > 0 ? e->tile->albedo[c][e->pixel] : 0.0f;
        received[c] = direct[c] - e->emission[c];
        bounced[c] = full[c] - direct[c];
        irradiance[c] = albedo > 0.0f ? bounced[c] * 3.14159265f / albedo : 0.0f;
    }
    print_rgb("direct", received, "");
    if (sum_of(e->emission) > 0.0f) {
        print_rgb("emitted", e->emission, "");
    }
    print_rgb(e->job.gathers_sky ? "sky, bounced" : "bounced", bounced, "");
    if (e->place.id > 0) {
        print_rgb("", irradiance, " W/m2 before the albedo");
    }
}

/* --- the run ------------------------------------------------------------------------------------------------------ */

/* The light that the surface at the pixel emits, by its map. */
static int find_emission(explanation *e, report *r)
{
    lmb_radiance *own = calloc(1, sizeof *own);
    if (own == NULL) {
        return report_fail(r, "not enough memory for a tile");
    }
    lmb_compose_emission(own, &e->job.scene, &e->job.frame.view, e->tile);
    for (int c = 0; c < 3; ++c) {
        e->emission[c] = own->rgb[c][e->pixel];
    }
    free(own);
    return 1;
}

/* The surface at the pixel: place.id 0 if there is none. */
static int find_surface(explanation *e, report *r)
{
    render_job *j = &e->job;
    lmb_frame *f = &j->frame;
    e->tile = calloc(1, sizeof *e->tile);
    if (e->tile == NULL) {
        return report_fail(r, "not enough memory for a tile");
    }
    render_job_eye(j, f, &j->linear, 0);
    lmb_surface_clear(&f->eye.depth);
    lmb_surface_clear(&f->eye.id);
    lmb_status status =
        lmb_draw(&f->eye, f->kernels, &f->view, &j->scene, 1, UINT32_MAX - 1, LMB_CULL_BACK | LMB_BLEND, &j->stats);
    if (status == LMB_OK) {
        status = lmb_resolve_tile(e->tile, f->kernels, &f->view, &j->scene, &f->eye, e->o.x & ~7, e->o.y & ~7);
    }
    if (status != LMB_OK) {
        return report_fail(r, "%s: the surface of the pixel cannot be found: %s", j->o.scene, lmb_status_name(status));
    }
    const int32_t k = e->pixel = (e->o.y & 7) * LMB_TILE + (e->o.x & 7);
    const lmb_tile *t = e->tile;
    explain_place *p = &e->place;
    p->id = t->id[k];
    p->at.x = t->position[0][k], p->at.y = t->position[1][k], p->at.z = t->position[2][k];
    p->face.x = t->face[0][k], p->face.y = t->face[1][k], p->face.z = t->face[2][k];
    p->normal.x = t->normal[0][k], p->normal.y = t->normal[1][k], p->normal.z = t->normal[2][k];
    p->depth = t->depth[k];
    p->noise = lmb_place_noise(p->at, fabsf(p->depth));
    return find_emission(e, r);
}

static int trace(explanation *e, report *r)
{
    const lmb_scene *scene = &e->job.scene;
    e->light = calloc((size_t)scene->light_count + 1, sizeof *e->light);
    e->bounce.sender = calloc((size_t)scene->instance_count + 1, sizeof *e->bounce.sender);
    if (e->light == NULL || e->bounce.sender == NULL) {
        return report_fail(r, "not enough memory to trace the scene");
    }
    if (!explain_space_make(&e->space, scene, e->job.frame.kernels, r)) {
        return 0;
    }
    e->space.sky = e->job.around.lights;
    e->space.sky_count = e->job.around.lights != NULL ? e->job.around.count : 0;
    explain_lights(e->light, &e->space, &e->place);
    explain_gather(&e->bounce, &e->space, &e->place);
    return 1;
}

static int run(explanation *e, report *r)
{
    render_job *j = &e->job;
    lmb_frame direct;
    j->o = e->o.render;
    if (!render_job_load(j, r) || !render_job_set(j, r)) {
        return 0;
    }
    if (e->o.x >= j->linear.width || e->o.y >= j->linear.height) {
        return report_fail_usage(r, "--pixel %d,%d: the picture has %d x %d pixels", (int)e->o.x, (int)e->o.y,
                                 (int)j->linear.width, (int)j->linear.height);
    }
    if (j->loaded.source != NULL &&
        !json_parse(&e->doc, j->loaded.source->json, j->loaded.source->json_size, j->o.scene, r)) {
        return 0;
    }
    direct = j->frame;
    direct.show = LMB_SHOW_DIRECT;
    if (!render_draw(j, r) || !render_draw_once_more(j, &e->direct, direct, r) || !find_surface(e, r)) {
        return 0;
    }
    progress_end();
    report_say("pixel %d,%d of %d x %d\n", (int)e->o.x, (int)e->o.y, (int)j->linear.width, (int)j->linear.height);
    if (e->place.id == 0) {
        report_say("surface\n  none: the pixel shows the background\n");
    } else {
        print_surface(e);
    }
    print_picture(e);
    if (e->place.id > 0) {
        j->scene.light_count += j->in_tree; /* the picture took them from the tree */
        if (!trace(e, r)) {
            return 0;
        }
        print_lights(e);
        print_senders(e);
    }
    return report_flush(r);
}

static int parse(explain_options *o, int argc, char **argv, report *r)
{
    memset(o, 0, sizeof *o);
    render_options_begin(&o->render);
    o->render.has_sky = 1;
    o->render.choice.keeps_source = 1;
    const int asked = options_parse(o, &explain_table, argc, argv, r);
    if (asked != OPTIONS_RUN) {
        return asked;
    }
    if (o->render.scene == NULL) {
        report_fail(r, "no scene given; try: lambent explain demo --pixel 320,240");
        return OPTIONS_BAD;
    }
    if (!o->has_pixel) {
        report_fail(r, "no pixel given; add --pixel X,Y");
        return OPTIONS_BAD;
    }
    if (o->render.stats != NULL) {
        report_fail(r, "--stats: explain writes no file; use lambent render --stats");
        return OPTIONS_BAD;
    }
    if (o->render.view.is_verbose) {
        report_fail(r, "-v: explain prints all it has; use lambent render -v");
        return OPTIONS_BAD;
    }
    return render_options_complete(&o->render, r) ? OPTIONS_RUN : OPTIONS_BAD;
}

int verb_explain(int argc, char **argv)
{
    report r = {""};
    static explanation e; /* too large for a small stack: the options hold 64 lights */
    memset(&e, 0, sizeof e);
    const int asked = parse(&e.o, argc, argv, &r);
    if (asked != OPTIONS_RUN) {
        return options_answer(asked, &explain_table, &r);
    }
    progress_begin(e.o.render.view.is_quiet, "explain");
    const int ok = render_options_job(&e.o.render, &explain_table, argc, argv, &r) && run(&e, &r);
    progress_end();
    explain_space_free(&e.space);
    free(e.tile);
    free(e.light);
    free(e.bounce.sender);
    image_free(&e.direct);
    json_free(&e.doc);
    render_job_free(&e.job);
    return ok ? 0 : report_end(&r, "explain", 1);
}
