/* render_job.c: a picture's scene, lights and memory. */
#include "render_job.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "demo_scene.h"
#include "own_light.h"
#include "picture.h"
#include "render_view.h"

#define ELEMENTS      16384 /* for what shines, and many lights */
#define HALF_STEP     0.00015f /* of black in 8 bits: radiance at exposure 0 */
#define MANY_ELEMENTS 65536 /* for one bounce after another: by fewer, rooms lose a tenth of their later light */
#define MOST_MAPPED   32 /* lights with maps that bounce, by default: 100 take 160 times as long as in a tree */
#define MAP_TEXELS (2u << 20) /* over all lights' maps, by default: 16 MiB */

void render_job_free(render_job *j)
{
    free(j->map_memory);
    free(j->point_memory);
    free(j->blocker_memory);
    free(j->owner_memory);
    free(j->element_memory);
    free(j->depth_memory);
    free(j->id_memory);
    free(j->frame.groups);
    free(j->crew.scratches);
    free(j->render);
    image_free(&j->linear);
    many_lights_free(&j->many);
    model_free(&j->loaded);
}

static void *take(render_job *j, size_t bytes, report *r)
{
    void *p = malloc(bytes > 0 ? bytes : 1);
    j->bytes += bytes;
    if (p == NULL) {
        report_fail(r, "not enough memory: %.0f MiB more wanted; try a smaller --size or --light-map",
                    (double)bytes / 1048576.0);
    }
    return p;
}

/* To whoever watches. */
static void note(const render_job *j, const char *format, ...) REPORT_PRINTF(2, 3);

static void note(const render_job *j, const char *format, ...)
{
    va_list args;
    if (j->o.view.is_quiet) {
        return;
    }
    va_start(args, format);
    fputs("lambent: ", stderr);
    vfprintf(stderr, format, args);
    fputc('\n', stderr);
    va_end(args);
}

/* --- scene and lights --------------------------------------------------------------------------------------------- */

int render_job_load(render_job *j, report *r)
{
    if (strcmp(j->o.scene, "demo") == 0) {
        j->scene = *demo_scene();
        return !j->o.glossy || report_fail(r, "--glossy: the demo's materials have no lobe; give a glTF scene");
    }
    if (!model_load(&j->loaded, j->o.scene, j->o.scene_name, &j->notes, r)) {
        return 0;
    }
    if (j->o.glossy && !model_make_glossy(&j->loaded)) {
        return report_fail(r, "--glossy: %s: only glTF's materials have a lobe", j->o.scene);
    }
    j->scene = j->loaded.scene;
    return lmb_scene_triangles(&j->scene) > 0 ||
           report_fail(r, "%s: nothing to draw: no triangles; `lambent info` says what is in it", j->o.scene);
}

/* Once nothing but memory can fail: an error is a line on its own. */
static void tell_notes(const render_job *j)
{
    for (uint32_t i = 0; i < j->notes.count; ++i) {
        note(j, "note: %s", j->notes.line[i]);
    }
}

/* Is there light without lamps? */
static int shines_itself(const render_job *j)
{
    return j->o.grouping.method == LMB_GROUP_CUT && lmb_scene_shines(&j->scene);
}

/* Without lamps: a sun, but where what shines by itself is the scene's light. 0 with `r` set: out of memory. */
static int set_lights(render_job *j, report *r)
{
    if (j->o.light_count > 0) {
        j->scene.lights = j->o.lights;
        j->scene.light_count = j->o.light_count;
    } else if (j->scene.light_count == 0) {
        const float own = shines_itself(j) ? own_light(&j->scene, r) : 0.0f;
        if (own < 0.0f || own >= OWN_LIGHT) {
            return own >= 0.0f;
        }
        lmb_light sun = {{0, 0, 0}, {-0.45f, -0.8f, -0.3968627f}, {3.0f, 2.9f, 2.7f}, 1.0f, 1.0f, LMB_LIGHT_DIRECTIONAL,
                         0};
        j->sun = sun;
        j->scene.lights = &j->sun;
        j->scene.light_count = 1;
        note(j, "no light in %s: a sun of 3 W/m2 from the upper right; --light sets others", j->o.scene);
    }
    return 1;
}

/* Maps of bounced light cost by the light, each as much as a picture. Lobes mirror lights of maps alone. */
static uint32_t most_mapped(const render_job *j)
{
    const int bounces = j->o.show == LMB_SHOW_FULL || j->o.show == LMB_SHOW_INDIRECT || j->o.show == LMB_SHOW_IRRADIANCE;
    const int mirrors = j->o.glossy && lmb_scene_is_glossy(&j->scene);
    return bounces && !mirrors && j->o.grouping.method == LMB_GROUP_CUT ? MOST_MAPPED : LMB_MAX_LIGHTS;
}

/* Lights that are too many for maps, or that were asked to, go into a tree. */
static int set_many_lights(render_job *j, report *r)
{
    const uint32_t cells = j->o.many_cells > 0 ? (uint32_t)j->o.many_cells : MANY_LIGHTS_CELLS;
    if (j->o.many_cells == 0 && j->scene.light_count <= most_mapped(j)) {
        return 1;
    }
    if (j->o.show != LMB_SHOW_DIRECT && j->o.grouping.method != LMB_GROUP_CUT) {
        return report_fail(r, "%s: %u lights bounce by --grouping cut only; or use --show direct", j->o.scene,
                           (unsigned)j->scene.light_count);
    }
    if (!many_lights_take(&j->many, &j->scene, cells, r)) {
        return 0;
    }
    j->frame.many = &j->many.tree;
    j->frame.many_error = j->o.light_error;
    note(j, "%u lights in %u cells (--many-lights)", (unsigned)j->many.tree.lights, (unsigned)j->many.tree.cell_count);
    return 1;
}

/* --- memory ------------------------------------------------------------------------------------------------------- */

static uint32_t total_faces(const lmb_scene *s)
{
    uint32_t faces = 0;
    for (uint32_t i = 0; i < s->light_count; ++i) {
        faces += (uint32_t)lmb_light_map_faces(&s->lights[i], s);
    }
    return faces;
}

static int32_t choose_light_map(const render_job *j, uint32_t faces)
{
    uint32_t size = 1024;
    while (size > 64 && (uint64_t)size * size * faces > MAP_TEXELS) {
        size /= 2;
    }
    return j->o.light_map != 0 ? j->o.light_map : (int32_t)size;
}

static int take_maps(render_job *j, report *r)
{
    lmb_frame *f = &j->frame;
    uint32_t faces = total_faces(&j->scene);
    f->light_map = choose_light_map(j, faces);
    for (uint32_t i = 0; i < j->scene.light_count; ++i) {
        const int32_t own = lmb_light_map_faces(&j->scene.lights[i], &j->scene);
        f->map_bytes += lmb_light_map_bytes(own, f->light_map, f->id_format);
    }
    f->map_memory = j->map_memory = take(j, f->map_bytes, r);
    return f->map_memory != NULL;
}

/* What blocks light, for those that ask every triangle. */
static int take_blockers(render_job *j, report *r)
{
    lmb_frame *f = &j->frame;
    const uint32_t triangles = lmb_scene_triangles(&j->scene);
    const size_t bytes = lmb_blockers_bytes(triangles);
    if ((f->occlusion != LMB_OCCLUSION_EXACT || j->o.show == LMB_SHOW_DIRECT) && f->many == NULL) {
        return 1;
    }
    j->blocker_memory = take(j, bytes, r);
    return j->blocker_memory != NULL && lmb_blockers_init(&f->blockers, triangles, j->blocker_memory, bytes) == LMB_OK;
}

static int take_elements(render_job *j, report *r)
{
    const uint32_t n = j->o.elements != 0 ? (uint32_t)j->o.elements : j->o.bounces > 1 ? MANY_ELEMENTS : ELEMENTS;
    if (j->o.bounces <= 1 && !lmb_scene_shines(&j->scene) && j->frame.many == NULL) {
        return 1;
    }
    j->element_memory = take(j, lmb_elements_bytes(n), r);
    return j->element_memory != NULL &&
           lmb_elements_init(&j->frame.elements, n, j->element_memory, lmb_elements_bytes(n)) == LMB_OK;
}

/* The tree of light. */
static int take_tree(render_job *j, report *r)
{
    lmb_frame *f = &j->frame;
    const uint32_t lit = total_faces(&j->scene), faces = lit > 0 ? lit : 1;
    const int32_t finest = f->light_map < 4096 ? f->light_map : 4096, least = f->light_map / 8;
    const int32_t size = j->o.tree > finest ? finest : j->o.tree < least ? least : j->o.tree;
    const size_t bytes = lmb_tree_bytes(faces, size);
    if (bytes == 0 || f->light_map % size != 0) {
        return report_fail(r, "--grouping cut: --light-map must be a power of two, not %d", (int)f->light_map);
    }
    j->point_memory = take(j, bytes, r);
    return j->point_memory != NULL && lmb_tree_init(&f->tree, faces, size, j->point_memory, bytes) == LMB_OK &&
           take_elements(j, r);
}

/* Who holds a texel's light: asked for only where it is shown. */
static int take_owners(render_job *j, report *r)
{
    lmb_points *p = &j->frame.points;
    const uint64_t texels = (uint64_t)j->frame.light_map * (uint64_t)j->frame.light_map * total_faces(&j->scene);
    if (texels > UINT32_MAX / 16) {
        return report_fail(r, "%.0f texels are too many to show; use a smaller --light-map", (double)texels);
    }
    p->owner = j->owner_memory = take(j, (size_t)texels * sizeof *p->owner, r);
    p->owner_cap = (uint32_t)texels;
    return p->owner != NULL;
}

/* Room for every block to hold all the surfaces that the library tells apart. */
static int take_points(render_job *j, report *r)
{
    lmb_frame *f = &j->frame;
    int32_t block = f->grouping.block != 0 ? f->grouping.block : LMB_TILE;
    uint32_t side = (uint32_t)(f->light_map / block);
    uint64_t n = (uint64_t)side * side * 4u * total_faces(&j->scene);
    if (n > 64000000u) {
        return report_fail(r, "%.0f first points are too many; use a larger --block or a smaller --light-map",
                           (double)n);
    }
    n = n > 0 ? n : 1;
    size_t bytes = lmb_points_bytes((uint32_t)n, side);
    j->point_memory = take(j, bytes, r);
    f->groups = take(j, sizeof *f->groups, r);
    return j->point_memory != NULL && f->groups != NULL &&
           lmb_points_init(&f->points, (uint32_t)n, side, j->point_memory, bytes) == LMB_OK;
}

/* What holds the light that bounces, as far as it is shown. */
static int take_light(render_job *j, report *r)
{
    const int dark = total_faces(&j->scene) == 0 && !shines_itself(j) && j->frame.many == NULL;
    if (j->o.show == LMB_SHOW_DIRECT || j->o.show == SHOW_LIGHT_DISTANCE || dark) {
        return 1;
    }
    if (j->frame.grouping.method == LMB_GROUP_CUT) {
        return take_tree(j, r);
    }
    return take_points(j, r) && (!shows_map(j->o.show) || take_owners(j, r));
}

/* Where in a picture of all eyes one eye's goes. */
static lmb_surface eye_surface(const render_job *j, const image *whole, int32_t eye)
{
    lmb_surface s;
    memset(&s, 0, sizeof s);
    s.data = whole->pixels + (size_t)eye * (size_t)(j->o.view.width * whole->channels);
    s.width = j->o.view.width;
    s.height = whole->height;
    s.stride_bytes = whole->width * whole->channels * (int32_t)sizeof(float);
    s.format = whole->channels == 1 ? LMB_R32F : LMB_RGB32F;
    return s;
}

void render_job_eye(const render_job *j, lmb_frame *f, const image *whole, int32_t eye)
{
    const float right_m = j->o.stereo_m * ((float)eye - 0.5f * (float)(j->eyes - 1));
    f->view = view_from(&j->middle, right_m, &j->scene);
    f->out = eye_surface(j, whole, eye);
}

int render_job_picture(render_job *j, image *out, report *r)
{
    size_t bytes = (size_t)(j->o.view.width * j->eyes) * (size_t)j->o.view.height * 3 * sizeof(float);
    out->pixels = take(j, bytes, r);
    out->width = j->o.view.width * j->eyes;
    out->height = j->o.view.height;
    out->channels = 3;
    if (out->pixels != NULL) {
        memset(out->pixels, 0, bytes);
    }
    return out->pixels != NULL;
}

static int take_frame(render_job *j, report *r)
{
    lmb_frame *f = &j->frame;
    int32_t w = j->o.view.width, h = j->o.view.height;
    size_t depth = lmb_surface_bytes(LMB_DEPTH32F, w, h), id = lmb_surface_bytes(f->id_format, w, h);
    j->depth_memory = take(j, depth, r);
    j->id_memory = take(j, id, r);
    f->scratch = j->crew.scratches = take(j, sizeof *f->scratch * (size_t)j->crew.threads, r);
    j->render = take(j, sizeof *j->render, r);
    if (!render_job_picture(j, &j->linear, r) || r->text[0] != '\0') {
        return 0;
    }
    memset(j->render, 0, sizeof *j->render);
    lmb_surface_init(&f->eye.depth, LMB_DEPTH32F, w, h, j->depth_memory, depth);
    lmb_surface_init(&f->eye.id, f->id_format, w, h, j->id_memory, id);
    render_job_eye(j, f, &j->linear, 0);
    return 1;
}

/* As the options have them. */
static void set_settings(render_job *j)
{
    lmb_frame *f = &j->frame;
    f->grouping = j->o.grouping;
    f->occlusion = j->o.occlusion;
    f->steps = j->o.steps;
    f->error = j->o.error;
    f->proven = j->o.proven;
    f->bounces = j->o.bounces;
    f->truncated = j->o.truncated;
    f->visible = j->o.visible;
    f->gather_step = j->o.gather_step;
    const int shows_steps = j->o.out != NULL && !picture_is_linear(picture_format(j->o.out)) && !j->o.exposure_auto;
    f->least = shows_steps ? HALF_STEP * exp2f(-j->o.exposure_ev) : 0.0f;
    if (total_faces(&j->scene) == 0 && !shines_itself(j) && f->many == NULL) { /* no map, no bounce */
        f->occlusion = LMB_OCCLUSION_NONE;
    }
}

int render_job_refit(render_job *j, report *r)
{
    lmb_frame *f = &j->frame;
    free(j->map_memory);
    free(j->point_memory);
    free(j->blocker_memory);
    free(j->element_memory);
    j->map_memory = j->point_memory = j->blocker_memory = j->element_memory = NULL;
    f->map_bytes = 0;
    memset(&f->tree, 0, sizeof f->tree);
    memset(&f->blockers, 0, sizeof f->blockers);
    memset(&f->elements, 0, sizeof f->elements);
    set_settings(j);
    return take_maps(j, r) && take_blockers(j, r) && take_light(j, r);
}

int render_job_set(render_job *j, report *r)
{
    lmb_frame *f = &j->frame;
    if (!render_view(&j->middle, &j->o, &j->loaded, &j->scene, r)) {
        return 0;
    }
    j->eyes = j->o.stereo_m > 0.0f ? 2 : 1;
    if (j->o.view.width * j->eyes > LMB_MAX_SIDE) {
        return report_fail(r, "--stereo: two views of %d px are wider than %d; try a smaller --size",
                           (int)j->o.view.width, LMB_MAX_SIDE);
    }
    tell_notes(j);
    if (!shows_attribute(j->o.show) && (!set_lights(j, r) || !set_many_lights(j, r))) {
        return 0;
    }
    render_options_light(&j->o, j->many.tree.lights >= LMB_MANY_EVEN && !lmb_scene_shines(&j->scene));
    j->crew.threads = j->o.threads > 0 ? j->o.threads : pool_processors();
    j->crew.threads = j->crew.threads > POOL_MAX ? POOL_MAX : j->crew.threads;
    f->kernels = j->o.kernels;
    f->scene = &j->scene;
    f->show = j->o.show < SHOW_DEPTH ? j->o.show : j->o.show == SHOW_OCCLUSION ? LMB_SHOW_IRRADIANCE : LMB_SHOW_FULL;
    set_settings(j);
    f->id_format = LMB_ID32;
    f->stats = &j->stats;
    if (shows_attribute(j->o.show)) {
        return take_frame(j, r);
    }
    if (j->o.show == SHOW_POINTS && f->grouping.join <= 0.0f) {
        f->grouping.join = 1e-30f; /* first points as they are: none is so near another */
    }
    f->everything = shows_map(j->o.show); /* also maps of lights that give nothing */
    return take_maps(j, r) && take_blockers(j, r) && take_light(j, r) && take_frame(j, r);
}
