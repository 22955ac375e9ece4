/* gl_context.h: a context's memory: one block, with a cap for each table. Shared objects lie in the share group.
 *
 * Every call that a display list can hold is an operation on words: its entry point converts the arguments, then
 * gl_do records or runs it. The current context is the library's only writable global, one for each thread. */
#ifndef LAMBENT_GL_CONTEXT_H
#define LAMBENT_GL_CONTEXT_H

#include <lambent/draw.h>
#include <lambent/lambent.h>
#include <lambent/numbers.h>
#include <string.h>

#include "../../src/base/poly.h"
#include "../../src/base/vec.h"
#include "include/GL/gl.h"

enum {
    GL_UNITS = 4,
    GL_LIGHTS = 8,
    GL_CLIP_PLANES = LMB_DRAW_PLANES,
    GL_BATCH = 4092, /* vertices in the batch: whole triangles, quads and pairs, so a multiple of 12 */
    GL_ORDERS = 3 * GL_BATCH,
    GL_SLOTS = 8192, /* a power of two */
    GL_STACK = 32,   /* matrices of a stack */
    GL_ATTRIB_STACK = 16,
    GL_LEVELS = 15,
    GL_SIDE = 16384, /* px of a texture's side; */
    GL_SIDE_CUBE = 4096, /* of a cube map's and a renderbuffer's */
    GL_SIDE_3D = 512,
    GL_LIST_DEPTH = 64,
    GL_MISSING = 64, /* names of missing calls that were looked up */
    GL_MAP_ORDER = 30,
    GL_NAMES = 64, /* of the selection stack */
    GL_PIXEL_MAP = 256,
    GL_TABLE = 1 << 14 /* objects of a kind */
};
#ifndef GL_HEAP_BYTES
#define GL_HEAP_BYTES (sizeof(void *) > 4 ? (size_t)1 << 30 : (size_t)1 << 26) /* for textures, lists and buffers */
#endif

typedef union gl_word {
    float f;
    int32_t i;
    uint32_t u;
} gl_word;

/* --- capabilities ------------------------------------------------------------------------------------------------- */

enum {
    CAP_ALPHA_TEST, CAP_AUTO_NORMAL, CAP_BLEND, CAP_LOGIC, CAP_COLOR_MATERIAL, CAP_COLOR_SUM, CAP_CULL, CAP_DEPTH,
    CAP_DITHER, CAP_FOG, CAP_LIGHTING, CAP_LINE_SMOOTH, CAP_LINE_STIPPLE, CAP_NORMALIZE, CAP_POINT_SMOOTH,
    CAP_OFFSET_POINT, CAP_OFFSET_LINE, CAP_OFFSET_FILL, CAP_POLYGON_SMOOTH, CAP_POLYGON_STIPPLE, CAP_RESCALE,
    CAP_SCISSOR, CAP_STENCIL, CAP_INDEX_LOGIC, CAP_MULTISAMPLE, CAP_SAMPLE_ALPHA, CAP_SAMPLE_ONE, CAP_SAMPLE_COVERAGE,
    CAP_CLIP, /* 6 */ CAP_LIGHT = CAP_CLIP + GL_CLIP_PLANES, CAP_MAP1 = CAP_LIGHT + GL_LIGHTS, CAP_MAP2 = CAP_MAP1 + 9,
    CAP_POINT_SPRITE = CAP_MAP2 + 9, CAP_BOUNCED, CAPS
};
enum { TARGET_1D, TARGET_2D, TARGET_RECT, TARGET_3D, TARGET_CUBE, TARGETS }; /* later ones first, if several are on */

/* --- objects ------------------------------------------------------------------------------------------------------ */

typedef struct gl_image {
    uint8_t *texels;  /* 4 bytes R G B A, or floats of depths; NULL: no image */
    uint8_t *stencil; /* a byte a texel if the format has a stencil part, or NULL */
    int32_t width, height, depth, border;
    GLenum internal, base; /* as given; GL_ALPHA .. GL_RGBA, GL_DEPTH_COMPONENT */
} gl_image;

typedef struct gl_texture {
    GLuint name;
    int target; /* TARGETS: not bound yet */
    GLenum min_filter, mag_filter, wrap[3], compare_mode, compare_func, depth_mode;
    GLenum swizzle[4]; /* GL_RED .. GL_ALPHA, GL_ZERO, GL_ONE */
    float border[4], min_lod, max_lod, lod_bias, priority;
    int32_t base_level, max_level, generate;
    float anisotropy;
    gl_image image[6][GL_LEVELS];
} gl_texture;

typedef struct gl_list {
    GLuint name;
    struct gl_chunk *first;
} gl_list;

typedef struct gl_chunk {
    struct gl_chunk *next;
    int32_t used, cap;
    gl_word word[];
} gl_chunk;

typedef struct gl_buffer {
    GLuint name;
    size_t bytes;
    uint8_t *data;
    GLenum usage, access;
    int is_mapped;
} gl_buffer;

typedef struct gl_query {
    GLuint name;
    uint64_t passed;
} gl_query;

typedef struct gl_renderbuffer {
    GLuint name;
    GLenum internal;
    int32_t width, height, samples; /* samples: 0 or 1, as a program asked */
    uint8_t *data;    /* colours, or depths */
    uint8_t *stencil; /* or NULL */
} gl_renderbuffer;

typedef struct gl_attachment {
    GLenum type; /* GL_NONE, GL_TEXTURE, GL_RENDERBUFFER_EXT */
    GLuint name;
    int32_t level, face, slice;
} gl_attachment;

typedef struct gl_framebuffer {
    GLuint name;
    gl_attachment colour, depth, stencil;
} gl_framebuffer;

/* A table from names to objects; a name without an object is reserved. */
typedef struct gl_entry {
    GLuint name;
    void *object;
} gl_entry;
typedef struct gl_table {
    gl_entry entry[GL_TABLE];
    int32_t used;
    GLuint last;
} gl_table;

typedef struct gl_heap {
    uint8_t *start;
    size_t bytes, top;
    struct gl_block *free;
} gl_heap;

typedef struct gl_group {
    int32_t users;
    gl_heap heap;
    size_t heap_last; /* bytes of the last block */
    gl_table textures, lists, buffers, renderbuffers;
} gl_group;

/* --- attributes of glPushAttrib, one struct for each bit ---------------------------------------------------------- */

typedef struct gl_vertex {
    float at[4], normal[3], fog, colour[4], second[3], edge, tex[GL_UNITS][4];
} gl_vertex;

typedef struct gl_material {
    float ambient[4], diffuse[4], specular[4], emission[4], shininess, indexes[3];
} gl_material;

typedef struct gl_light {
    float ambient[4], diffuse[4], specular[4], position[4], spot[3], exponent, cutoff, attenuation[3];
} gl_light;

typedef struct gl_gen {
    GLenum mode;
    float object[4], eye[4];
} gl_gen;

typedef struct gl_unit {
    uint32_t on;  /* a bit a target */
    uint32_t gen; /* a bit a coordinate */
    gl_gen coordinate[4];
    GLenum mode;
    float colour[4], lod_bias;
    GLenum combine[2], source[2][3], operand[2][3];
    float scale[2];
    int32_t replaces; /* point sprites */
    gl_texture *bound[TARGETS];
} gl_unit;

typedef struct gl_state {
    uint64_t caps;
    struct { gl_vertex v; float raster[4], raster_colour[4], raster_second[4], raster_tex[GL_UNITS][4], raster_distance;
             int32_t raster_valid; } current;
    struct { float size, min, max, fade, attenuation[3]; GLenum origin; } point;
    struct { float width; int32_t factor; uint32_t pattern; } line;
    struct { GLenum front, back, cull, front_face; float factor, units; } polygon;
    struct { uint8_t bits[128]; } stipple;
    struct { float scale[4], bias[4], depth_scale, depth_bias, zoom[2]; int32_t map_colour, map_stencil, index_shift,
             index_offset; GLenum read; } pixel;
    struct { gl_material material[2]; gl_light light[GL_LIGHTS]; float ambient[4]; int32_t local, two, separate;
             GLenum shade, tracks_face, tracks; } lighting;
    struct { GLenum mode, source; float colour[4], density, start, end, index; } fog;
    struct { GLenum func; int32_t mask; double clear; } depth;
    struct { float clear[4]; } accum;
    struct { GLenum func, fail, zfail, zpass; int32_t ref; uint32_t mask, write; int32_t clear; } stencil;
    struct { int32_t box[4]; double range[2]; } viewport;
    struct { GLenum mode; float plane[GL_CLIP_PLANES][4]; } transform;
    struct { GLenum alpha_func; float alpha_ref; GLenum blend[4], equation[2]; float blend_colour[4]; GLenum logic;
             float clear[4]; uint32_t mask; GLenum draw; } colour;
    struct { GLenum hint[6], poly; } hint;
    struct { float grid1[2], grid2[4]; int32_t n1, n2[2]; } eval;
    struct { GLuint base; } list;
    struct { int32_t active; gl_unit unit[GL_UNITS]; } texture;
    struct { int32_t box[4]; } scissor;
    struct { float coverage; int32_t invert; } sample;
} gl_state;

typedef struct gl_store { int32_t swap, lsb, row, height, rows, pixels, images, align; } gl_store;

typedef struct gl_array {
    int32_t on, size, stride;
    GLenum type;
    const void *data;
    gl_buffer *buffer;
} gl_array;
enum { ARRAY_VERTEX, ARRAY_NORMAL, ARRAY_COLOUR, ARRAY_INDEX, ARRAY_EDGE, ARRAY_FOG, ARRAY_SECOND, ARRAY_TEX,
       ARRAYS = ARRAY_TEX + GL_UNITS };
typedef struct gl_client {
    gl_store pack, unpack;
    gl_array array[ARRAYS];
    int32_t active;
    gl_buffer *bound, *bound_elements;
} gl_client;

typedef struct gl_matrices {
    float m[GL_STACK][16];
    int32_t top, limit;
} gl_matrices;

/* A vertex after transformation and lighting. */
typedef struct gl_made {
    float eye[4], clip[4], colour[2][4], second[2][3], fog, tex[GL_UNITS][4], size, edge;
    float normal[3];         /* in eye space; only for bounced light, */
    gl_material material[2]; /* and so are these */
} gl_made;

typedef struct gl_map {
    int32_t order[2];
    float range[4];
    float *points;
} gl_map;

/* The target of draws. */
typedef struct gl_surface {
    int32_t width, height, stride; /* px */
    uint8_t *colour;               /* 4 bytes, R G B A or B G R A */
    float *depth;
    uint8_t *stencil;
    int32_t depth_stride, stencil_stride;
    int32_t swaps;      /* B G R A */
    int32_t has_alpha;
    int32_t is_complete;
} gl_surface;

struct gl_wide_job;
typedef struct gl_context {
    gl_state s;
    gl_state saved[GL_ATTRIB_STACK];
    GLbitfield saved_bits[GL_ATTRIB_STACK];
    int32_t saved_count;
    GLuint saved_names[GL_ATTRIB_STACK][GL_UNITS][TARGETS];
    gl_client client, client_saved[GL_ATTRIB_STACK];
    GLbitfield client_bits[GL_ATTRIB_STACK];
    int32_t client_count;
    gl_group *group;
    int32_t owns_group, is_destroyed;
    struct gl_context *owner; /* the context with the group in its block */

    GLenum error;
    int32_t dirty; /* 1: draw.h's state is out of date */
    gl_matrices modelview, projection, texture[GL_UNITS];
    float normal_matrix[9], eye_scale;
    float mvp[16];
    int32_t matrices_dirty;

    /* batched vertices */
    int32_t is_inside;  /* between glBegin and glEnd */
    int32_t is_static;  /* the batch is of a display list or a static buffer; only for bounced light */
    int32_t reads_static; /* a call draws from static buffers */
    struct gl_bounce *bounce; /* NULL: none yet */
    int32_t bounce_failed; /* out of memory */
    GLenum primitive;
    int32_t count, made_count, first_kept, is_continued;
    gl_vertex loop_first;
    int32_t stipple_at; /* px along the line so far */
    float at_of[GL_BATCH + 4][4];
    /* Look k is the attributes of vertices look_from[k] .. look_from[k + 1] - 1. */
    gl_vertex look[GL_BATCH + 4];
    int32_t look_from[GL_BATCH + 4], looks;
    /* Runs of strips, fans and quad strips wait as triangles or quads: places of vertices. 0: vertices in order. */
    uint32_t order_of[GL_ORDERS];
    int32_t orders;
    GLenum ordered; /* GL_TRIANGLES or GL_QUADS */
    uint32_t name_of[GL_BATCH + 4]; /* the element of an indexed array that a vertex of the batch is */
    int32_t slot_of[GL_SLOTS];      /* the vertex that an element may be */
    int32_t open; /* glVertex may append to the last look while count < open; 0: only gl_vertex_at may append */
    gl_made made[GL_BATCH + 4];
    float eye_of[GL_BATCH + 4][4];
    uint8_t colour_of[GL_BATCH + 4][4];
    float uv_of[GL_BATCH + 4][2];
    uint32_t index_of[GL_BATCH + 4];

    const struct lmb_kernels *kernels; /* of draw.h; NULL: plain C */
    lmb_draw_state draw;
    lmb_draw_target target;
    lmb_texture draw_texture;
    void (*wide)(uint8_t out[64][4], const struct gl_wide_job *job, uint64_t mask); /* gl_wide.h's; NULL: none */
    int32_t shades;      /* 1: the shader colours */
    int32_t bounces;     /* 1: with bounced light */
    int32_t draws;       /* 0: there is no target */
    int32_t is_side, side; /* lines and points of a polygon: the visible side */
    uint32_t flat;
    float line_from[2];
    int32_t line_steep, begin_at, skips;
    int32_t is_odd; /* 1: the texture coordinates of the batch's independent primitives need a shader */
    gl_texture *unit_texture[GL_UNITS]; /* the sampled texture: enabled and complete; or NULL */
    gl_image proxy[TARGETS];
    struct { const uint8_t *codes; int32_t width, height, kind; float x, y, zoom[2]; uint8_t colour[4]; } drawing;
    float row[GL_SIDE_CUBE + 8][4];
    int edges[GL_BATCH + 4];
    gl_surface window, drawn;
    uint64_t passed;
    gl_query *query;
    gl_framebuffer *framebuffer, *read_framebuffer;
    gl_renderbuffer *renderbuffer;
    gl_table framebuffers, queries;
    gl_texture default_texture[TARGETS];

    /* lists */
    GLuint list_name;
    GLenum list_mode; /* 0: none is compiled */
    gl_list *list;
    gl_chunk *list_chunk;
    gl_word *list_run; /* the operation recorded last, if it is a run of vertices that can grow; or NULL */
    int32_t list_depth, list_inside;

    float pixel_map[10][GL_PIXEL_MAP];
    int32_t pixel_map_size[10];
    gl_map map1[9], map2[9];

    /* selection and feedback */
    GLenum render_mode;
    GLuint name_stack[GL_NAMES];
    int32_t name_count, hit, hits, select_size, select_at;
    GLuint *select;
    float hit_min, hit_max;
    float *feedback;
    int32_t feedback_size, feedback_at;
    GLenum feedback_type;

    char missing[GL_MISSING][48];
    int32_t missing_count;
    float *accum; /* of the window, 4 floats a pixel */

    /* OSMesa */
    GLenum format;
    int32_t depth_bits, stencil_bits, accum_bits, y_up, row_length;
    void *user;
    uint8_t *own; /* buffer for pixels of other formats */
    void *depth_codes;
} gl_context;

/* The current context, or NULL. C99 has no keyword for thread-local objects; GCC and Clang have one. */
#ifndef GL_THREAD
#ifdef __GLIBC__ /* a load instead of a call; other C libraries refuse it in libraries that dlopen loads */
#define GL_THREAD __thread __attribute__((tls_model("initial-exec")))
#else
#define GL_THREAD __thread
#endif
#endif
extern GL_THREAD gl_context *gl_now;

/* --- operations --------------------------------------------------------------------------------------------------- */

#define GL_OPERATIONS(X) \
    X(vertex) X(vertex_3) X(colour) X(normal) X(tex_coord) X(tex_coord_2) X(second) X(fog_coord) X(edge) X(begin) \
    X(end) X(material) X(eval_coord) X(eval_point) X(call_list) X(call_lists) \
    X(enable) X(alpha_func) X(blend_func) X(blend_equation) X(blend_colour) X(clear) X(clear_colour) X(clear_depth) \
    X(clear_stencil) X(clear_accum) X(colour_mask) X(colour_material) X(cull_face) X(depth_func) X(depth_mask) \
    X(depth_range) X(draw_buffer) X(read_buffer) X(fog) X(front_face) X(hint) X(light) X(light_model) X(line_stipple) \
    X(line_width) X(list_base) X(logic_op) X(matrix_mode) X(load_matrix) X(mult_matrix) X(push_matrix) X(pop_matrix) \
    X(pixel_zoom) X(pixel_transfer) X(pixel_map) X(point_size) X(point_parameter) X(polygon_mode) X(polygon_offset) \
    X(polygon_stipple) X(push_attrib) X(pop_attrib) X(raster_pos) X(window_pos) X(scissor) X(shade_model) \
    X(stencil_func) X(stencil_mask) X(stencil_op) X(tex_env) X(tex_gen) X(tex_parameter) X(bind_texture) \
    X(active_texture) X(prioritize) X(viewport) X(accum) X(init_names) X(load_name) X(push_name) X(pop_name) \
    X(pass_through) X(clip_plane) X(draw_pixels) X(bitmap) X(copy_pixels) X(tex_image) X(tex_sub_image) \
    X(copy_tex_image) X(copy_tex_sub_image) X(eval_mesh) X(map) X(map_grid) X(begin_query) X(end_query) \
    X(sample_coverage) X(rect) X(fail)
#define GL_ENUM_OP(name) OP_##name,
enum { GL_OPERATIONS(GL_ENUM_OP) OPS, OP_FIRST_STATE = OP_enable, OP_LAST_INSIDE = OP_call_lists };
#define GL_DECLARE_OP(name) void gl_op_##name(gl_context *c, const gl_word *w);
GL_OPERATIONS(GL_DECLARE_OP)

/* Record, run or both; words: the operation's arguments. */
void gl_do(gl_context *c, int op, const gl_word *w, int32_t words);
/* The same with bytes: `data` is copied if it is recorded. The last two words are the pointer. */
void gl_do_data(gl_context *c, int op, gl_word *w, int32_t words, const void *data, size_t bytes);
const void *gl_data_of(const gl_word *w);
void gl_run_list(gl_context *c, GLuint name);
void gl_list_vertex(gl_context *c, const float at[4]); /* records a vertex */
void gl_list_free(gl_context *c, gl_list *list);

/* --- functions shared by the files -------------------------------------------------------------------------------- */

void gl_error(gl_context *c, GLenum error);
/* The same for a call that a display list can hold: the list repeats the error. */
void gl_fail(gl_context *c, GLenum error);
void gl_refuse(const char *name); /* a call that is not offered */

void *gl_alloc(gl_context *c, size_t bytes); /* NULL and GL_OUT_OF_MEMORY if the heap is full */
void gl_free(gl_context *c, void *p);
void gl_heap_init(gl_heap *heap, void *start, size_t bytes);
void *gl_find(const gl_table *t, GLuint name);
int gl_has(const gl_table *t, GLuint name); /* reserved or an object */
int gl_put(gl_context *c, gl_table *t, GLuint name, void *object);
void gl_remove(gl_table *t, GLuint name);
GLuint gl_new_names(gl_context *c, gl_table *t, int32_t count); /* the first of consecutive names; 0: none left */

void gl_flush_vertices(gl_context *c); /* draws the batch */
void gl_make_vertices(gl_context *c);  /* transforms and lights the batch, before a state changes */
void gl_vertex_at(gl_context *c, const float at[4]);
void gl_vertex_of(gl_context *c, const float at[4], const gl_vertex *look); /* with attributes of its own */
void gl_vertices_at(gl_context *c, const gl_word *w, int32_t count, int32_t words); /* 3 (w is 1) or 4 words each */
int gl_can_order(const gl_context *c, GLenum primitive); /* 1: the batch may be in order_of */
/* Primitives of a run of triangles, strips, fans, quads or quad strips: vertices of one, and their number. */
static inline uint32_t gl_order_each(GLenum mode) { return mode == GL_QUADS || mode == GL_QUAD_STRIP ? 4 : 3; }
static inline uint32_t gl_order_past(GLenum mode, uint32_t vertices)
{
    const uint32_t sides = vertices < 2 ? 0 : vertices - 2;
    return mode == GL_TRIANGLES    ? vertices / 3
           : mode == GL_QUADS      ? vertices / 4
           : mode == GL_QUAD_STRIP ? sides / 2
                                   : sides;
}
/* The places of primitive n in its run. */
static inline void gl_order_places(uint32_t out[4], GLenum mode, uint32_t n)
{
    const uint32_t odd = n & 1u;
    switch (mode) {
    case GL_TRIANGLES: out[0] = 3 * n, out[1] = 3 * n + 1, out[2] = 3 * n + 2; break;
    case GL_TRIANGLE_STRIP: out[0] = n + odd, out[1] = n + 1 - odd, out[2] = n + 2; break;
    case GL_TRIANGLE_FAN: out[0] = 0, out[1] = n + 1, out[2] = n + 2; break;
    case GL_QUADS: out[0] = 4 * n, out[1] = 4 * n + 1, out[2] = 4 * n + 2, out[3] = 4 * n + 3; break;
    default: out[0] = 2 * n, out[1] = 2 * n + 1, out[2] = 2 * n + 3, out[3] = 2 * n + 2; break;
    }
}
/* Vertices are appended, and order_of is written, by the caller, which draws when either is full. 0: an error. */
int gl_order_begin(gl_context *c, GLenum primitive);
void gl_update_matrices(gl_context *c);
void gl_set_draw(gl_context *c); /* derives draw.h's state from the context's */
int gl_draw_func(GLenum func);
void gl_light_vertex(gl_context *c, const gl_vertex *v, gl_made *made);
void gl_light_codes(gl_context *c, int32_t from); /* colour_of the vertices from `from` on, from eye_of; one side */
void gl_light_track(gl_context *c); /* with GL_COLOR_MATERIAL: the material takes the current colour */
/* One side's colours at a place in eye space. seen: lights that are not hidden, a bit each. */
void gl_light_side(const gl_context *c, const gl_material *m, const float eye[4], const float n[3], uint32_t seen,
                   float colour[4], float second[3]);
/* Adds the light, pi times GL's, that a place with unit normal n receives. */
void gl_light_receive(float inout[3], const gl_light *l, const float at[3], const float n[3]);
/* Bounced light: a batch before it is drawn; a frame's end; whether pixels get it; the colours of a primitive's
 * pixels. */
void gl_bounce_batch(gl_context *c);
void gl_bounce_frame(gl_context *c);
void gl_bounce_free(gl_context *c);
int gl_bounce_shows(const gl_context *c);
void gl_bounce_pixels(const gl_context *c, const lmb_draw_pixels_of *p, const gl_made *const m[3], int side,
                      float colour[64][4], float second[64][3]);
void gl_gen_vertex(gl_context *c, const float at[4], const gl_vertex *v, gl_made *made);
void gl_state_init(gl_context *c);
void gl_set_array(gl_context *c);
uint64_t gl_shade_pixels(void *user, const lmb_draw_pixels_of *p, uint8_t colour[64][4]);
void gl_shade_raster(const gl_context *c, float colour[4]);
void gl_find_textures(gl_context *c); /* the units' textures */
void gl_texture_init(gl_texture *t, GLuint name, int target);
int gl_texture_is_complete(const gl_texture *t);
void gl_find_surface(gl_context *c, gl_surface *out, const gl_framebuffer *f);
int gl_surface_ready(gl_context *c, const gl_framebuffer *f); /* 1, or an error */
void gl_set_window(gl_context *c);
void gl_window_out(gl_context *c); /* pixels into the program's memory */
void gl_select_primitive(gl_context *c, const uint32_t *index, int n, int reset);
void gl_window_place(const gl_context *c, const float clip[4], float out[3]);
void gl_transfer(const gl_context *c, float *rgba, size_t pixels);

/* matrices, column-major as OpenGL's */
void gl_matrix_times(float out[16], const float a[16], const float b[16]);
void gl_matrix_point(float out[4], const float m[16], const float v[4]);
void gl_matrix_points(float (*out)[4], const float m[16], const float (*in)[4], int32_t count);
int gl_matrix_invert(float out[16], const float m[16]);

/* --- images ------------------------------------------------------------------------------------------------------- */

/* Values of a format's pixels; 0: unknown. Bytes of a type's value or packed pixel. */
int gl_format_values(GLenum format);
int gl_type_bytes(GLenum type);
int gl_type_is_packed(GLenum type);
GLenum gl_check_image(GLenum format, GLenum type); /* GL_NO_ERROR or the error */
size_t gl_image_bytes(const gl_store *s, int w, int h, int d, GLenum format, GLenum type); /* bytes read */
uint8_t *gl_image_row(void *data, const gl_store *s, int w, int y, GLenum format); /* of bytes, 2D */
/* 4 floats a pixel: R G B A; or depth, or stencil, in the first. */
void gl_unpack(float *out, const gl_store *s, int w, int h, int d, int dims, GLenum format, GLenum type,
               const void *data);
void gl_pack(void *data, const gl_store *s, int w, int h, int d, int dims, GLenum format, GLenum type,
             const float *from);
/* Pixels from a program, or from the read buffer, after the transfer: 4 bytes each: R G B A, a float depth, or a
 * stencil code as float; of GL_DEPTH_STENCIL all depths, then all stencil codes. Allocated in the heap; NULL and an
 * error if there is no room. */
uint8_t *gl_read_codes(gl_context *c, int w, int h, int d, int dims, GLenum format, GLenum type, const void *data);
uint8_t *gl_copy_codes(gl_context *c, int32_t x, int32_t y, int32_t w, int32_t h, GLenum format);
GLenum gl_base_format(GLenum internal); /* GL_DEPTH_COMPONENT also with a stencil part */
int gl_has_stencil(GLenum internal);

/* Rows of depths are whole tiles, as draw.h requires. A load waits for an earlier store if their addresses differ by a
 * multiple of 4 KiB, so rows of a tile are other distances apart. */
static inline int32_t gl_depth_stride(int32_t width)
{
    const int32_t whole = (width + LMB_TILE - 1) / LMB_TILE * LMB_TILE;
    return whole + (whole % 256 == 0 ? 16 : 0);
}
static inline int gl_is_on(const gl_context *c, int cap) { return (int)(c->s.caps >> cap & 1u); }
static inline uint8_t gl_code(float v)
{
    return (uint8_t)((v > 0.0f ? v < 1.0f ? v : 1.0f : 0.0f) * 255.0f + 0.5f); /* NaN is 0 */
}
static inline float gl_unit_range(float v) { return v > 0.0f ? v < 1.0f ? v : 1.0f : 0.0f; }
static inline float gl_pow(float a, float b) { return b == 0.0f ? 1.0f : a <= 0.0f ? 0.0f : lmb_exp2(b * lmb_log2(a)); }
static inline int32_t gl_int(float v)
{
    return v >= 2147483520.0f ? 2147483647 : v <= -2147483520.0f ? -2147483647 - 1 : v == v ? (int32_t)v : 0;
}

static inline int gl_unit_is_on(const gl_context *c, int unit) { return c->unit_texture[unit] != NULL; }
static inline gl_texture *gl_unit_texture(const gl_context *c, int unit) { return c->unit_texture[unit]; }

/* For calls that are not allowed between glBegin and glEnd: defines the context, or returns. */
#define GL_ENTER(result) \
    gl_context *c = gl_now; \
    if (c == NULL) return result; \
    if (c->is_inside) { gl_error(c, GL_INVALID_OPERATION); return result; }
/* The same for calls that a display list holds: lists record the error. */
#define GL_ENTER_LISTED() \
    gl_context *c = gl_now; \
    if (c == NULL) return; \
    if (c->is_inside) { gl_fail(c, GL_INVALID_OPERATION); return; }
#define GL_FAIL_LISTED(condition, error) \
    if (condition) { gl_fail(c, error); return; }
#define GL_FAIL(condition, error, result) \
    if (condition) { gl_error(c, error); return result; }
#endif
