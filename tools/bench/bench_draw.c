/* bench_draw.c: the workloads of lambent/draw.h, generated here except for the meshes of the raster workload. */
#include "bench_draw.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/host.h"
#include "bench_scene.h"

enum {
    WIDE = 640,
    HIGH = 480,
    PIXELS = WIDE * HIGH,
    SPRITES = 20000,
    PARTICLES = 100000,
    GLYPHS = 4000,
    LINES = 200000,
    GRID = 224, /* 2 x 224 x 224: 100,352 triangles */
    SHADOWS = 96,
    TEXELS = 64,
    CORNERS_MAX = 4 * PARTICLES,
    FRAMES_LEAST = 5,
    REPEATS = 16, /* of cases that are compared with the memory's speed */
    TEXT_WIDE = WIDE / 6
};

/* The target of all cases, and the arrays of the current one. */
typedef struct drawing {
    lmb_draw_target target;
    lmb_draw_state state;
    lmb_draw_vertices vertices;
    lmb_draw_indices indices;
    lmb_texture texture;
    bench_scene mesh; /* of meshes from files */
    int32_t primitive;
    const char *text;
    uint32_t *colour;
    float *depth;
    uint8_t *stencil, *texels, *colours, *normals;
    float *positions, *uvs;
    uint32_t *index;
} drawing;

typedef struct draw_case {
    const char *name;
    int (*make)(drawing *d, const draw_options *o, report *r); /* returns 1, or 0 with `r` set */
    void (*frame)(drawing *d);
    const char *what;
} draw_case;

/* --- numbers ------------------------------------------------------------------------------------------------------ */

static uint32_t draw_random_state;

static float draw_random(float low, float high)
{
    draw_random_state = draw_random_state * 1664525u + 1013904223u;
    return low + (high - low) * (float)(draw_random_state >> 8) * (1.0f / 16777216.0f);
}

/* --- frames ------------------------------------------------------------------------------------------------------- */

static void clear(drawing *d)
{
    lmb_surface_clear(&d->target.colour);
    lmb_surface_clear(&d->target.depth);
}

static void frame_list(drawing *d)
{
    clear(d);
    (void)lmb_draw_list(&d->target, &d->state, &d->vertices, d->primitive, d->indices.data != NULL ? &d->indices : NULL,
                        NULL);
}

/* Draws again over the last frame. */
static void frame_over(drawing *d)
{
    (void)lmb_draw_list(&d->target, &d->state, &d->vertices, d->primitive, NULL, NULL);
}

static void frame_clear(drawing *d) { lmb_surface_clear(&d->target.colour); }

static void frame_text(drawing *d)
{
    static const uint8_t ink[4] = {255, 240, 200, 255};
    (void)lmb_text(&d->target.colour, 0, 0, d->text, 1, ink);
}

/* Draws the ground's depth, then the front and back faces of the volumes before it. */
static void frame_shadows(drawing *d)
{
    static const float plane[4][3] = {{-9, -9, -6}, {9, -9, -6}, {9, 9, -6}, {-9, 9, -6}};
    lmb_draw_vertices ground;
    lmb_draw_state s = d->state;
    clear(d);
    memset(d->stencil, 0, PIXELS);
    memset(&ground, 0, sizeof ground);
    ground.positions = plane;
    ground.count = 4;
    s.flags = LMB_DRAW_DEPTH_TEST | LMB_DRAW_DEPTH_WRITE;
    (void)lmb_draw_list(&d->target, &s, &ground, LMB_DRAW_QUADS, NULL, NULL);
    s.flags = LMB_DRAW_DEPTH_TEST | LMB_DRAW_STENCIL | LMB_DRAW_CULL_BACK;
    s.colour_mask = 0;
    s.stencil_op[2] = LMB_DRAW_INCREASE_WRAP;
    (void)lmb_draw_list(&d->target, &s, &d->vertices, LMB_DRAW_QUADS, NULL, NULL);
    s.flags = LMB_DRAW_DEPTH_TEST | LMB_DRAW_STENCIL | LMB_DRAW_CULL_FRONT;
    s.stencil_op[2] = LMB_DRAW_DECREASE_WRAP;
    (void)lmb_draw_list(&d->target, &s, &d->vertices, LMB_DRAW_QUADS, NULL, NULL);
    s = d->state;
    s.flags = LMB_DRAW_STENCIL | LMB_DRAW_BLEND;
    s.stencil_func = LMB_DRAW_NOTEQUAL; /* to 0 */
    s.colour[0] = s.colour[1] = s.colour[2] = 0;
    s.colour[3] = 128;
    s.blend_source[0] = LMB_DRAW_SOURCE_ALPHA;
    s.blend_target[0] = LMB_DRAW_INVERSE_SOURCE_ALPHA;
    (void)lmb_draw_list(&d->target, &s, &ground, LMB_DRAW_QUADS, NULL, NULL);
}

/* --- meshes ------------------------------------------------------------------------------------------------------- */

static void set_texture(drawing *d, int filter)
{
    for (int y = 0; y < TEXELS; ++y) {
        for (int x = 0; x < TEXELS; ++x) {
            uint8_t *p = d->texels + 4 * (y * TEXELS + x);
            const int dx = 2 * x - TEXELS + 1, dy = 2 * y - TEXELS + 1, square = dx * dx + dy * dy;
            p[0] = (uint8_t)(150 + x);
            p[1] = (uint8_t)(((x ^ y) & 8) != 0 ? 220 : 90);
            p[2] = (uint8_t)(200 - 2 * y);
            p[3] = (uint8_t)(square < TEXELS * TEXELS ? 255 - square * 255 / (TEXELS * TEXELS) : 0);
        }
    }
    d->texture.texels = d->texels;
    d->texture.width = d->texture.height = TEXELS;
    d->texture.levels = 1;
    d->texture.filter = (uint8_t)filter;
    d->state.stage[0].texture = &d->texture;
}

static void set_depth(drawing *d)
{
    d->state.flags |= LMB_DRAW_DEPTH_TEST | LMB_DRAW_DEPTH_WRITE;
    d->primitive = LMB_DRAW_TRIANGLES;
}

static int make_file(drawing *d, int scene, int look, const draw_options *o, report *r)
{
    const bench_case file = {"draw", scene, look, WIDE, HIGH, 0};
    if (!bench_scene_load(&d->mesh, &file, o->folder, r)) {
        return 0;
    }
    (void)lmb_draw_view(&d->state, &d->mesh.view, &d->mesh.instance.to_world);
    d->vertices.positions = d->mesh.mesh.positions;
    d->vertices.colours = d->mesh.mesh.colours;
    d->vertices.uvs[0] = d->mesh.mesh.uvs;
    d->vertices.count = d->mesh.mesh.vertex_count;
    d->indices.data = d->mesh.mesh.indices;
    d->indices.count = 3 * d->mesh.mesh.triangle_count;
    d->indices.format = LMB_INDEX_U32;
    d->state.stage[0].texture = look == BENCH_TEXTURED ? &d->mesh.texture : NULL;
    d->mesh.texture.filter = LMB_NEAREST;
    set_depth(d);
    return 1;
}

static int make_bunny(drawing *d, const draw_options *o, report *r)
{
    return make_file(d, BENCH_BUNNY, BENCH_GOURAUD, o, r);
}
static int make_bunny_tex(drawing *d, const draw_options *o, report *r)
{
    return make_file(d, BENCH_BUNNY, BENCH_TEXTURED, o, r);
}
static int make_sponza(drawing *d, const draw_options *o, report *r)
{
    return make_file(d, BENCH_SPONZA_INSIDE, BENCH_GOURAUD, o, r);
}
static int make_sponza_tex(drawing *d, const draw_options *o, report *r)
{
    return make_file(d, BENCH_SPONZA_INSIDE, BENCH_TEXTURED, o, r);
}

/* A wavy ground of GRID x GRID cells, lit per vertex, seen from above. */
static void make_ground(drawing *d)
{
    lmb_view view;
    static const lmb_mat4 unit = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
    const lmb_vec3 eye = {0, 5, 9}, target = {0, 0, 0}, up = {0, 1, 0};
    uint32_t *index = d->index;
    for (int y = 0; y <= GRID; ++y) {
        for (int x = 0; x <= GRID; ++x) {
            const int i = y * (GRID + 1) + x;
            const float u = (float)x / GRID, v = (float)y / GRID;
            const float light = 0.5f + 0.5f * sinf(23.0f * u) * cosf(17.0f * v);
            d->positions[3 * i] = 12.0f * u - 6.0f;
            d->positions[3 * i + 1] = 0.7f * sinf(20.0f * u) * sinf(15.0f * v);
            d->positions[3 * i + 2] = 12.0f * v - 6.0f;
            d->uvs[2 * i] = 8.0f * u;
            d->uvs[2 * i + 1] = 8.0f * v;
            for (int k = 0; k < 3; ++k) {
                d->colours[4 * i + k] = (uint8_t)(light * (float)(255 - 40 * k));
            }
            d->colours[4 * i + 3] = 255;
        }
    }
    for (uint32_t y = 0; y < GRID; ++y) {
        for (uint32_t x = 0; x < GRID; ++x) {
            const uint32_t i = y * (GRID + 1) + x;
            const uint32_t six[6] = {i, i + GRID + 1, i + 1, i + 1, i + GRID + 1, i + GRID + 2};
            memcpy(index, six, sizeof six);
            index += 6;
        }
    }
    lmb_view_look_at(&view, eye, target, up, 0.9f, WIDE, HIGH);
    view.near_m = 0.1f;
    (void)lmb_draw_view(&d->state, &view, &unit);
    d->vertices.positions = d->positions;
    d->vertices.colours = d->colours;
    d->vertices.uvs[0] = d->uvs;
    d->vertices.count = (GRID + 1) * (GRID + 1);
    d->indices.data = d->index;
    d->indices.count = 6 * GRID * GRID;
    d->indices.format = LMB_INDEX_U32;
    set_depth(d);
}

static int make_hills(drawing *d, const draw_options *o, report *r)
{
    (void)o, (void)r;
    make_ground(d);
    return 1;
}
static int make_hills_tex(drawing *d, const draw_options *o, report *r)
{
    (void)o, (void)r;
    make_ground(d);
    set_texture(d, LMB_NEAREST);
    return 1;
}
static int make_fogged(drawing *d, const draw_options *o, report *r)
{
    (void)o, (void)r;
    make_ground(d);
    set_texture(d, LMB_BILINEAR);
    d->state.fog = LMB_DRAW_FOG_LINEAR;
    d->state.fog_start = 4.0f;
    d->state.fog_end = 16.0f;
    d->state.fog_colour[0] = d->state.fog_colour[1] = d->state.fog_colour[2] = 180;
    return 1;
}

/* --- sprites, particles, lines, text ------------------------------------------------------------------------------ */

/* `count` squares of `size` pixels at random pixel positions. */
static void make_squares(drawing *d, int count, int size)
{
    static const float at[4][2] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
    for (int i = 0; i < count; ++i) {
        const float x = floorf(draw_random(0, (float)(WIDE - size))), y = floorf(draw_random(0, (float)(HIGH - size)));
        const float tint = draw_random(120, 255);
        for (int k = 0; k < 4; ++k) {
            float *p = d->positions + 3 * (4 * i + k), *uv = d->uvs + 2 * (4 * i + k);
            uint8_t *rgba = d->colours + 4 * (4 * i + k);
            p[0] = x + at[k][0] * (float)size;
            p[1] = y + at[k][1] * (float)size;
            p[2] = 0.5f;
            uv[0] = at[k][0];
            uv[1] = at[k][1];
            rgba[0] = (uint8_t)tint;
            rgba[1] = (uint8_t)(tint * 0.6f);
            rgba[2] = 90;
            rgba[3] = 200;
        }
    }
    (void)lmb_draw_pixels(&d->state);
    d->vertices.positions = d->positions;
    d->vertices.colours = d->colours;
    d->vertices.uvs[0] = d->uvs;
    d->vertices.count = (uint32_t)(4 * count);
    d->primitive = LMB_DRAW_QUADS;
    d->state.flags = LMB_DRAW_BLEND;
}

static void set_alpha(drawing *d)
{
    d->state.flags = LMB_DRAW_BLEND;
    d->state.blend_source[0] = d->state.blend_source[1] = LMB_DRAW_SOURCE_ALPHA;
    d->state.blend_target[0] = d->state.blend_target[1] = LMB_DRAW_INVERSE_SOURCE_ALPHA;
}

static int make_sprites(drawing *d, const draw_options *o, report *r)
{
    (void)o, (void)r;
    make_squares(d, SPRITES, 32);
    set_texture(d, LMB_NEAREST);
    set_alpha(d);
    return 1;
}

static int make_particles(drawing *d, const draw_options *o, report *r)
{
    (void)o, (void)r;
    make_squares(d, PARTICLES, 4);
    d->state.blend_source[0] = d->state.blend_source[1] = LMB_DRAW_SOURCE_ALPHA;
    d->state.blend_target[0] = d->state.blend_target[1] = LMB_DRAW_ONE;
    return 1;
}

static int make_lines(drawing *d, const draw_options *o, report *r)
{
    (void)o, (void)r;
    for (int i = 0; i < 2 * LINES; ++i) {
        float *p = d->positions + 3 * i;
        p[0] = (i & 1) != 0 ? p[-3] + draw_random(-20, 20) : draw_random(20, WIDE - 20);
        p[1] = (i & 1) != 0 ? p[-2] + draw_random(-20, 20) : draw_random(20, HIGH - 20);
        p[2] = 0.5f;
        for (int k = 0; k < 4; ++k) {
            d->colours[4 * i + k] = (uint8_t)draw_random(0, 255);
        }
    }
    (void)lmb_draw_pixels(&d->state);
    d->vertices.positions = d->positions;
    d->vertices.colours = d->colours;
    d->vertices.count = 2 * LINES;
    d->primitive = LMB_DRAW_LINES;
    return 1;
}

static int make_text(drawing *d, const draw_options *o, report *r)
{
    static char text[GLYPHS + GLYPHS / TEXT_WIDE + 2];
    int n = 0;
    (void)o, (void)r;
    for (int i = 0; i < GLYPHS; ++i) {
        text[n++] = (char)(33 + i % 94);
        if (i % TEXT_WIDE == TEXT_WIDE - 1) {
            text[n++] = '\n';
        }
    }
    text[n] = '\0';
    d->text = text;
    return 1;
}

/* Open boxes from the viewer's side into the ground, four sides each. */
static int make_shadows(drawing *d, const draw_options *o, report *r)
{
    static const float corner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    const lmb_vec3 eye = {0, 0, 0}, target = {0, 0, -1}, up = {0, 1, 0};
    static const lmb_mat4 unit = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
    lmb_view view;
    float *p = d->positions;
    (void)o, (void)r;
    for (int i = 0; i < SHADOWS; ++i) {
        const float x = draw_random(-3, 3), y = draw_random(-2, 2), size = draw_random(0.1f, 0.4f);
        for (int side = 0; side < 4; ++side) {
            const float *a = corner[side], *b = corner[(side + 1) % 4];
            const float quad[4][3] = {{x + size * a[0], y + size * a[1], -4},
                                      {x + 1.5f + size * a[0], y + 1 + size * a[1], -7},
                                      {x + 1.5f + size * b[0], y + 1 + size * b[1], -7},
                                      {x + size * b[0], y + size * b[1], -4}};
            memcpy(p, quad, sizeof quad);
            p += 12;
        }
    }
    lmb_view_look_at(&view, eye, target, up, 0.9f, WIDE, HIGH);
    view.near_m = 0.1f;
    (void)lmb_draw_view(&d->state, &view, &unit);
    d->vertices.positions = d->positions;
    d->vertices.count = SHADOWS * 16;
    return 1;
}

static void make_screen(drawing *d)
{
    static const float corner[4][2] = {{0, 0}, {0, HIGH}, {WIDE, HIGH}, {WIDE, 0}};
    for (int k = 0; k < 4; ++k) {
        d->positions[3 * k] = corner[k][0];
        d->positions[3 * k + 1] = corner[k][1];
        d->positions[3 * k + 2] = 0.5f;
    }
    (void)lmb_draw_pixels(&d->state);
    d->vertices.positions = d->positions;
    d->vertices.count = 4;
    d->primitive = LMB_DRAW_QUADS;
}

static int make_fill(drawing *d, const draw_options *o, report *r)
{
    (void)o, (void)r;
    make_screen(d);
    return 1;
}

static int make_glass(drawing *d, const draw_options *o, report *r)
{
    (void)o, (void)r;
    make_screen(d);
    set_alpha(d);
    d->state.colour[3] = 100;
    return 1;
}

/* --- the cases ---------------------------------------------------------------------------------------------------- */

static const draw_case cases[] = {
    {"bunny-gouraud", make_bunny, frame_list, "69,451 triangles with colours at corners, opaque, tested by depth"},
    {"bunny-textured", make_bunny_tex, frame_list, "the same with a texture, nearest texel"},
    {"sponza-gouraud", make_sponza, frame_list, "262,267 triangles from inside, with colours at corners"},
    {"sponza-textured", make_sponza_tex, frame_list, "the same with a texture, nearest texel"},
    {"hills-gouraud", make_hills, frame_list, "100,352 triangles of a ground with colours at corners, tested by depth"},
    {"hills-textured", make_hills_tex, frame_list, "the same, times a texture, nearest texel"},
    {"hills-fogged", make_fogged, frame_list, "the same, lit at corners, texture bilinear, in linear fog"},
    {"sprites", make_sprites, frame_list, "20,000 textured squares of 32x32 px, blended by their alpha"},
    {"particles", make_particles, frame_list, "100,000 squares of 4x4 px, added"},
    {"text", make_text, frame_text, "4,000 glyphs of lmb_text"},
    {"lines", make_lines, frame_list, "200,000 lines of up to 20 px a side, with colours at ends"},
    {"shadows", make_shadows, frame_shadows, "96 shadow volumes counted in the stencil, and a darker ground there"},
    {"clear", make_fill, frame_clear, "lmb_surface_clear of the colours"},
    {"fill", make_fill, frame_over, "an opaque rectangle over the whole picture"},
    {"glass", make_glass, frame_over, "a rectangle over the whole picture, blended by its alpha"},
};
enum { CASES = sizeof cases / sizeof *cases };

static int draw_needs_file(const draw_case *c) { return c - cases < 4; }

static int draw_is_named(const draw_case *c, const draw_options *o)
{
    for (int i = 0; i < o->case_count; ++i) {
        if (strstr(c->name, o->cases[i]) != NULL) {
            return 1;
        }
    }
    return o->case_count == 0;
}

int bench_draw_is_wanted(const draw_options *o)
{
    int any = 0;
    for (int i = 0; i < CASES; ++i) {
        any |= draw_is_named(&cases[i], o);
    }
    return any;
}

/* --- memory ------------------------------------------------------------------------------------------------------- */

static void drawing_free(drawing *d)
{
    free(d->colour);
    free(d->depth);
    free(d->stencil);
    free(d->texels);
    free(d->colours);
    free(d->positions);
    free(d->uvs);
    free(d->index);
}

static int drawing_make(drawing *d, report *r)
{
    const size_t depth_bytes = lmb_depth_bytes(WIDE, HIGH);
    memset(d, 0, sizeof *d);
    d->colour = malloc(4 * PIXELS);
    d->depth = malloc(depth_bytes);
    d->stencil = malloc(PIXELS);
    d->texels = malloc(4 * TEXELS * TEXELS);
    d->colours = malloc(4 * CORNERS_MAX);
    d->positions = malloc(12 * CORNERS_MAX);
    d->uvs = malloc(8 * CORNERS_MAX);
    d->index = malloc(24 * GRID * GRID);
    if (d->colour == NULL || d->depth == NULL || d->stencil == NULL || d->texels == NULL || d->colours == NULL ||
        d->positions == NULL || d->uvs == NULL || d->index == NULL) {
        return report_fail(r, "no memory to draw into");
    }
    (void)lmb_surface_init(&d->target.colour, LMB_RGBA8, WIDE, HIGH, d->colour, 4 * PIXELS);
    (void)lmb_surface_init(&d->target.depth, LMB_DEPTH32F, WIDE, HIGH, d->depth, depth_bytes);
    d->target.stencil = d->stencil;
    d->target.stencil_stride = WIDE;
    memset(d->colour, 0, 4 * PIXELS);
    return 1;
}

/* Resets the state that the previous case left. */
static void drawing_begin(drawing *d, const draw_options *o)
{
    (void)lmb_draw_state_init(&d->state, WIDE, HIGH);
    d->state.kernels = o->kernels;
    memset(&d->vertices, 0, sizeof d->vertices);
    memset(&d->indices, 0, sizeof d->indices);
    memset(&d->texture, 0, sizeof d->texture);
    memset(&d->mesh, 0, sizeof d->mesh);
    draw_random_state = 1;
}

/* --- measuring ---------------------------------------------------------------------------------------------------- */

/* Shortest times for storing each pixel once, and for reading and storing each once in place, s. */
typedef struct bounds {
    double store, copy;
} bounds;

static void store_all(drawing *d) { memset(d->colour, 85, 4 * PIXELS); }
static void copy_all(drawing *d) { memmove(d->colour, d->colour + 1, 4 * (PIXELS - 1)); }

/* Processor time of a call, s: the mean of `repeats`, because the clock is inexact for calls of microseconds. */
static double seconds_of(drawing *d, void (*call)(drawing *d), int repeats)
{
    const double start = host_cpu_seconds();
    for (int i = 0; i < repeats; ++i) {
        call(d);
    }
    return (host_cpu_seconds() - start) / repeats;
}

/* Shortest processor time of a frame, s; *out: the bounds, measured in turn. */
static double measure(drawing *d, const draw_case *c, double seconds, bounds *out, int *frames)
{
    const double end = host_seconds() + seconds;
    double shortest = 1e9;
    c->frame(d);
    out->store = out->copy = 1e9;
    const int is_bounded = c->make == make_fill || c->make == make_glass;
    for (*frames = 0; host_seconds() < end || *frames < FRAMES_LEAST; ++*frames) {
        shortest = fmin(shortest, seconds_of(d, c->frame, is_bounded ? REPEATS : 1));
        if (is_bounded) {
            out->store = fmin(out->store, seconds_of(d, store_all, REPEATS));
            out->copy = fmin(out->copy, seconds_of(d, copy_all, REPEATS));
        }
    }
    return shortest;
}

static void print_line(const draw_case *c, double shortest, const bounds *b, int frames, const draw_options *o)
{
    const char *backend = o->kernels != NULL ? lmb_kernels_name(o->kernels) : "plain";
    if (o->is_quiet) {
        return;
    }
    printf(o->json ? "{\"case\":\"%s\",\"what\":\"%s\",\"cpu_min_ms\":%.4f,\"frames\":%d,\"backend\":\"%s\""
                   : "%-16s %s: %.3f ms, shortest of %d, backend=%s",
           c->name, c->what, shortest * 1e3, frames, backend);
    if (b->store < 1e8) {
        printf(o->json ? ",\"store_ms\":%.4f,\"share\":%.3f,\"copy_ms\":%.4f,\"copy_share\":%.3f"
                       : ", store bound %.4f ms, share %.3f, copy bound %.4f ms, share %.3f",
               b->store * 1e3, b->store / shortest, b->copy * 1e3, b->copy / shortest);
    }
    puts(o->json ? "}" : "");
    fflush(stdout);
}

static int run_case(drawing *d, const draw_case *c, const draw_options *o, report *r)
{
    bounds bound;
    int frames;
    if (draw_needs_file(c) && o->folder == NULL) {
        return 1;
    }
    drawing_begin(d, o);
    if (!c->make(d, o, r)) {
        return 0;
    }
    const double shortest = measure(d, c, o->seconds, &bound, &frames);
    print_line(c, shortest, &bound, frames, o);
    if (draw_needs_file(c)) {
        bench_scene_free(&d->mesh);
    }
    return 1;
}

int bench_draw(const draw_options *o, report *r)
{
    static drawing d;
    int ok = drawing_make(&d, r);
    for (int i = 0; i < CASES && ok; ++i) {
        ok = !draw_is_named(&cases[i], o) || run_case(&d, &cases[i], o, r);
    }
    drawing_free(&d);
    return ok;
}
