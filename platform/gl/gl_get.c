/* gl_get.c: queries of a context: glGet*, strings, parameters of lights, materials and textures. */
#include "gl_context.h"

/* Conversion of a value to an integer: unchanged, rounded, or from -1 .. 1 to all integers. */
enum { GET_WHOLE, GET_FLOAT, GET_COLOUR };
typedef struct get_value {
    double v[16];
    int32_t count, kind;
} get_value;

static void get_floats(get_value *o, const float *v, int n, int kind)
{
    for (int i = 0; i < n; ++i) {
        o->v[i] = (double)v[i];
    }
    o->count = n;
    o->kind = kind;
}

static void get_ints(get_value *o, const int32_t *v, int n)
{
    for (int i = 0; i < n; ++i) {
        o->v[i] = (double)v[i];
    }
    o->count = n;
    o->kind = GET_WHOLE;
}

static void get_matrix(get_value *o, const gl_matrices *s, int turns)
{
    for (int i = 0; i < 16; ++i) {
        o->v[i] = (double)s->m[s->top][turns ? i % 4 * 4 + i / 4 : i];
    }
    o->count = 16;
    o->kind = GET_FLOAT;
}

#define WHOLE(name, value) case name: o->v[0] = (double)(value); return 1;
#define FLOAT(name, value) case name: o->v[0] = (double)(value); o->kind = GET_FLOAT; return 1;
#define FLOATS(name, array, n) case name: get_floats(o, array, n, GET_FLOAT); return 1;
#define COLOUR(name, array) case name: get_floats(o, array, 4, GET_COLOUR); return 1;
#define INTS(name, array, n) case name: get_ints(o, array, n); return 1;

static int get_limits(get_value *o, const gl_context *c, GLenum name)
{
    const gl_surface *s = &c->drawn;
    static const float sizes[2] = {1.0f, 255.0f};
    static const int32_t side[2] = {LMB_MAX_SIDE, LMB_MAX_SIDE};
    switch (name) {
    WHOLE(GL_MAX_LIGHTS, GL_LIGHTS) WHOLE(GL_MAX_CLIP_PLANES, GL_CLIP_PLANES)
    WHOLE(GL_MAX_MODELVIEW_STACK_DEPTH, c->modelview.limit) WHOLE(GL_MAX_PROJECTION_STACK_DEPTH, c->projection.limit)
    WHOLE(GL_MAX_TEXTURE_STACK_DEPTH, c->texture[0].limit) WHOLE(GL_MAX_ATTRIB_STACK_DEPTH, GL_ATTRIB_STACK)
    WHOLE(GL_MAX_CLIENT_ATTRIB_STACK_DEPTH, GL_ATTRIB_STACK) WHOLE(GL_MAX_NAME_STACK_DEPTH, GL_NAMES)
    WHOLE(GL_MAX_LIST_NESTING, GL_LIST_DEPTH) WHOLE(GL_MAX_EVAL_ORDER, GL_MAP_ORDER)
    WHOLE(GL_MAX_PIXEL_MAP_TABLE, GL_PIXEL_MAP) WHOLE(GL_MAX_TEXTURE_SIZE, GL_SIDE)
    WHOLE(GL_MAX_3D_TEXTURE_SIZE, GL_SIDE_3D) WHOLE(GL_MAX_CUBE_MAP_TEXTURE_SIZE, GL_SIDE_CUBE)
    WHOLE(GL_MAX_RECTANGLE_TEXTURE_SIZE_ARB, GL_SIDE) WHOLE(GL_MAX_TEXTURE_UNITS, GL_UNITS)
    WHOLE(GL_MAX_ELEMENTS_VERTICES, 65536) WHOLE(GL_MAX_ELEMENTS_INDICES, 65536)
    FLOAT(GL_MAX_TEXTURE_LOD_BIAS, 16) WHOLE(GL_MAX_RENDERBUFFER_SIZE_EXT, GL_SIDE_CUBE)
    WHOLE(GL_MAX_SAMPLES, 1)
    WHOLE(GL_MAX_COLOR_ATTACHMENTS_EXT, 1) WHOLE(GL_MAX_DRAW_BUFFERS, 1) FLOAT(GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT, 1)
    INTS(GL_MAX_VIEWPORT_DIMS, side, 2) WHOLE(GL_SUBPIXEL_BITS, 8)
    FLOATS(GL_POINT_SIZE_RANGE, sizes, 2) FLOATS(GL_ALIASED_POINT_SIZE_RANGE, sizes, 2)
    FLOATS(GL_LINE_WIDTH_RANGE, sizes, 2) FLOATS(GL_ALIASED_LINE_WIDTH_RANGE, sizes, 2)
    FLOAT(GL_POINT_SIZE_GRANULARITY, 1) FLOAT(GL_LINE_WIDTH_GRANULARITY, 1)
    WHOLE(GL_RED_BITS, s->colour != NULL ? 8 : 0) WHOLE(GL_GREEN_BITS, s->colour != NULL ? 8 : 0)
    WHOLE(GL_BLUE_BITS, s->colour != NULL ? 8 : 0) WHOLE(GL_ALPHA_BITS, s->colour != NULL && s->has_alpha ? 8 : 0)
    WHOLE(GL_DEPTH_BITS, s->depth != NULL ? 24 : 0) WHOLE(GL_STENCIL_BITS, s->stencil != NULL ? 8 : 0)
    WHOLE(GL_ACCUM_RED_BITS, c->framebuffer == NULL ? c->accum_bits : 0)
    WHOLE(GL_ACCUM_GREEN_BITS, c->framebuffer == NULL ? c->accum_bits : 0)
    WHOLE(GL_ACCUM_BLUE_BITS, c->framebuffer == NULL ? c->accum_bits : 0)
    WHOLE(GL_ACCUM_ALPHA_BITS, c->framebuffer == NULL ? c->accum_bits : 0)
    WHOLE(GL_INDEX_BITS, 0) WHOLE(GL_AUX_BUFFERS, 0) WHOLE(GL_RGBA_MODE, 1) WHOLE(GL_INDEX_MODE, 0)
    WHOLE(GL_DOUBLEBUFFER, 0) WHOLE(GL_STEREO, 0) WHOLE(GL_SAMPLE_BUFFERS, 0) WHOLE(GL_SAMPLES, 0)
    WHOLE(GL_NUM_COMPRESSED_TEXTURE_FORMATS, 0) WHOLE(GL_NUM_EXTENSIONS, 0)
    case GL_COMPRESSED_TEXTURE_FORMATS: o->count = 0; return 1;
    default: return 0;
    }
}

static int get_pixels(get_value *o, const gl_context *c, GLenum name)
{
    const gl_store *u = &c->client.unpack, *p = &c->client.pack;
    if (name >= GL_PIXEL_MAP_I_TO_I_SIZE && name <= GL_PIXEL_MAP_A_TO_A_SIZE) {
        o->v[0] = (double)c->pixel_map_size[name - GL_PIXEL_MAP_I_TO_I_SIZE];
        return 1;
    }
    switch (name) {
    WHOLE(GL_UNPACK_SWAP_BYTES, u->swap) WHOLE(GL_UNPACK_LSB_FIRST, u->lsb) WHOLE(GL_UNPACK_ROW_LENGTH, u->row)
    WHOLE(GL_UNPACK_SKIP_ROWS, u->rows) WHOLE(GL_UNPACK_SKIP_PIXELS, u->pixels) WHOLE(GL_UNPACK_ALIGNMENT, u->align)
    WHOLE(GL_UNPACK_SKIP_IMAGES, u->images) WHOLE(GL_UNPACK_IMAGE_HEIGHT, u->height)
    WHOLE(GL_PACK_SWAP_BYTES, p->swap) WHOLE(GL_PACK_LSB_FIRST, p->lsb) WHOLE(GL_PACK_ROW_LENGTH, p->row)
    WHOLE(GL_PACK_SKIP_ROWS, p->rows) WHOLE(GL_PACK_SKIP_PIXELS, p->pixels) WHOLE(GL_PACK_ALIGNMENT, p->align)
    WHOLE(GL_PACK_SKIP_IMAGES, p->images) WHOLE(GL_PACK_IMAGE_HEIGHT, p->height)
    WHOLE(GL_MAP_COLOR, c->s.pixel.map_colour) WHOLE(GL_MAP_STENCIL, c->s.pixel.map_stencil)
    WHOLE(GL_INDEX_SHIFT, c->s.pixel.index_shift) WHOLE(GL_INDEX_OFFSET, c->s.pixel.index_offset)
    FLOAT(GL_RED_SCALE, c->s.pixel.scale[0]) FLOAT(GL_GREEN_SCALE, c->s.pixel.scale[1])
    FLOAT(GL_BLUE_SCALE, c->s.pixel.scale[2]) FLOAT(GL_ALPHA_SCALE, c->s.pixel.scale[3])
    FLOAT(GL_RED_BIAS, c->s.pixel.bias[0]) FLOAT(GL_GREEN_BIAS, c->s.pixel.bias[1])
    FLOAT(GL_BLUE_BIAS, c->s.pixel.bias[2]) FLOAT(GL_ALPHA_BIAS, c->s.pixel.bias[3])
    FLOAT(GL_DEPTH_SCALE, c->s.pixel.depth_scale) FLOAT(GL_DEPTH_BIAS, c->s.pixel.depth_bias)
    FLOAT(GL_ZOOM_X, c->s.pixel.zoom[0]) FLOAT(GL_ZOOM_Y, c->s.pixel.zoom[1]) WHOLE(GL_READ_BUFFER, c->s.pixel.read)
    default: return 0;
    }
}

static int get_arrays(get_value *o, const gl_context *c, GLenum name)
{
    const gl_array *a = c->client.array, *t = &a[ARRAY_TEX + c->client.active];
#define NAME_OF(b) ((b) != NULL ? (b)->name : 0)
    switch (name) {
    WHOLE(GL_VERTEX_ARRAY, a[0].on) WHOLE(GL_VERTEX_ARRAY_SIZE, a[0].size)
    WHOLE(GL_VERTEX_ARRAY_TYPE, a[0].type) WHOLE(GL_VERTEX_ARRAY_STRIDE, a[0].stride)
    WHOLE(GL_NORMAL_ARRAY, a[1].on) WHOLE(GL_NORMAL_ARRAY_TYPE, a[1].type) WHOLE(GL_NORMAL_ARRAY_STRIDE, a[1].stride)
    WHOLE(GL_COLOR_ARRAY, a[2].on) WHOLE(GL_COLOR_ARRAY_SIZE, a[2].size) WHOLE(GL_COLOR_ARRAY_TYPE, a[2].type)
    WHOLE(GL_COLOR_ARRAY_STRIDE, a[2].stride)
    WHOLE(GL_INDEX_ARRAY, a[3].on) WHOLE(GL_INDEX_ARRAY_TYPE, a[3].type) WHOLE(GL_INDEX_ARRAY_STRIDE, a[3].stride)
    WHOLE(GL_EDGE_FLAG_ARRAY, a[4].on) WHOLE(GL_EDGE_FLAG_ARRAY_STRIDE, a[4].stride)
    WHOLE(GL_FOG_COORD_ARRAY, a[5].on) WHOLE(GL_FOG_COORD_ARRAY_TYPE, a[5].type)
    WHOLE(GL_FOG_COORD_ARRAY_STRIDE, a[5].stride)
    WHOLE(GL_SECONDARY_COLOR_ARRAY, a[6].on) WHOLE(GL_SECONDARY_COLOR_ARRAY_SIZE, a[6].size)
    WHOLE(GL_SECONDARY_COLOR_ARRAY_TYPE, a[6].type) WHOLE(GL_SECONDARY_COLOR_ARRAY_STRIDE, a[6].stride)
    WHOLE(GL_TEXTURE_COORD_ARRAY, t->on) WHOLE(GL_TEXTURE_COORD_ARRAY_SIZE, t->size)
    WHOLE(GL_TEXTURE_COORD_ARRAY_TYPE, t->type) WHOLE(GL_TEXTURE_COORD_ARRAY_STRIDE, t->stride)
    WHOLE(GL_CLIENT_ACTIVE_TEXTURE, GL_TEXTURE0 + (GLenum)c->client.active)
    WHOLE(GL_ARRAY_BUFFER_BINDING, NAME_OF(c->client.bound))
    WHOLE(GL_ELEMENT_ARRAY_BUFFER_BINDING, NAME_OF(c->client.bound_elements))
    WHOLE(GL_VERTEX_ARRAY_BUFFER_BINDING, NAME_OF(a[0].buffer))
    WHOLE(GL_NORMAL_ARRAY_BUFFER_BINDING, NAME_OF(a[1].buffer))
    WHOLE(GL_COLOR_ARRAY_BUFFER_BINDING, NAME_OF(a[2].buffer))
    WHOLE(GL_INDEX_ARRAY_BUFFER_BINDING, NAME_OF(a[3].buffer))
    WHOLE(GL_EDGE_FLAG_ARRAY_BUFFER_BINDING, NAME_OF(a[4].buffer))
    WHOLE(GL_FOG_COORDINATE_ARRAY_BUFFER_BINDING, NAME_OF(a[5].buffer))
    WHOLE(GL_SECONDARY_COLOR_ARRAY_BUFFER_BINDING, NAME_OF(a[6].buffer))
    WHOLE(GL_TEXTURE_COORD_ARRAY_BUFFER_BINDING, NAME_OF(t->buffer))
    default: return 0;
    }
}

static int get_transform(get_value *o, const gl_context *c, GLenum name)
{
    const gl_state *s = &c->s;
    const int unit = s->texture.active;
    const gl_unit *u = &s->texture.unit[unit];
    switch (name) {
    case GL_MODELVIEW_MATRIX: get_matrix(o, &c->modelview, 0); return 1;
    case GL_PROJECTION_MATRIX: get_matrix(o, &c->projection, 0); return 1;
    case GL_TEXTURE_MATRIX: get_matrix(o, &c->texture[unit], 0); return 1;
    case GL_TRANSPOSE_MODELVIEW_MATRIX: get_matrix(o, &c->modelview, 1); return 1;
    case GL_TRANSPOSE_PROJECTION_MATRIX: get_matrix(o, &c->projection, 1); return 1;
    case GL_TRANSPOSE_TEXTURE_MATRIX: get_matrix(o, &c->texture[unit], 1); return 1;
    WHOLE(GL_MODELVIEW_STACK_DEPTH, c->modelview.top + 1) WHOLE(GL_PROJECTION_STACK_DEPTH, c->projection.top + 1)
    WHOLE(GL_TEXTURE_STACK_DEPTH, c->texture[unit].top + 1) WHOLE(GL_MATRIX_MODE, s->transform.mode)
    INTS(GL_VIEWPORT, s->viewport.box, 4) INTS(GL_SCISSOR_BOX, s->scissor.box, 4)
    case GL_DEPTH_RANGE: o->v[0] = s->viewport.range[0]; o->v[1] = s->viewport.range[1]; o->count = 2;
        o->kind = GET_COLOUR; return 1;
    WHOLE(GL_ACTIVE_TEXTURE, GL_TEXTURE0 + (GLenum)unit)
    WHOLE(GL_TEXTURE_BINDING_1D, u->bound[TARGET_1D]->name) WHOLE(GL_TEXTURE_BINDING_2D, u->bound[TARGET_2D]->name)
    WHOLE(GL_TEXTURE_BINDING_3D, u->bound[TARGET_3D]->name)
    WHOLE(GL_TEXTURE_BINDING_RECTANGLE_ARB, u->bound[TARGET_RECT]->name)
    WHOLE(GL_TEXTURE_BINDING_CUBE_MAP, u->bound[TARGET_CUBE]->name)
    WHOLE(GL_ATTRIB_STACK_DEPTH, c->saved_count) WHOLE(GL_CLIENT_ATTRIB_STACK_DEPTH, c->client_count)
    WHOLE(GL_NAME_STACK_DEPTH, c->name_count) WHOLE(GL_RENDER_MODE, c->render_mode)
    WHOLE(GL_SELECTION_BUFFER_SIZE, c->select_size) WHOLE(GL_FEEDBACK_BUFFER_SIZE, c->feedback_size)
    WHOLE(GL_FEEDBACK_BUFFER_TYPE, c->feedback_type)
    WHOLE(GL_LIST_BASE, s->list.base) WHOLE(GL_LIST_INDEX, c->list_mode != 0 ? c->list_name : 0)
    WHOLE(GL_LIST_MODE, c->list_mode)
    WHOLE(GL_FRAMEBUFFER_BINDING_EXT, c->framebuffer != NULL ? c->framebuffer->name : 0)
    WHOLE(GL_READ_FRAMEBUFFER_BINDING, c->read_framebuffer != NULL ? c->read_framebuffer->name : 0)
    WHOLE(GL_RENDERBUFFER_BINDING_EXT, c->renderbuffer != NULL ? c->renderbuffer->name : 0)
    WHOLE(GL_MAP1_GRID_SEGMENTS, s->eval.n1) INTS(GL_MAP2_GRID_SEGMENTS, s->eval.n2, 2)
    FLOATS(GL_MAP1_GRID_DOMAIN, s->eval.grid1, 2) FLOATS(GL_MAP2_GRID_DOMAIN, s->eval.grid2, 4)
    default: return 0;
    }
}

static int get_current(get_value *o, const gl_context *c, GLenum name)
{
    const gl_state *s = &c->s;
    static const float index = 1.0f;
    switch (name) {
    COLOUR(GL_CURRENT_COLOR, s->current.v.colour) FLOAT(GL_CURRENT_INDEX, index)
    case GL_CURRENT_NORMAL: get_floats(o, s->current.v.normal, 3, GET_COLOUR); return 1;
    FLOATS(GL_CURRENT_TEXTURE_COORDS, s->current.v.tex[s->texture.active], 4)
    FLOAT(GL_CURRENT_FOG_COORD, s->current.v.fog)
    case GL_CURRENT_SECONDARY_COLOR: get_floats(o, s->current.v.second, 3, GET_COLOUR); o->v[3] = 1.0; o->count = 4;
        return 1;
    WHOLE(GL_EDGE_FLAG, s->current.v.edge != 0.0f)
    FLOATS(GL_CURRENT_RASTER_POSITION, s->current.raster, 4) COLOUR(GL_CURRENT_RASTER_COLOR, s->current.raster_colour)
    COLOUR(GL_CURRENT_RASTER_SECONDARY_COLOR, s->current.raster_second)
    FLOATS(GL_CURRENT_RASTER_TEXTURE_COORDS, s->current.raster_tex[s->texture.active], 4)
    FLOAT(GL_CURRENT_RASTER_INDEX, index)
    FLOAT(GL_CURRENT_RASTER_DISTANCE, s->current.raster_distance)
    WHOLE(GL_CURRENT_RASTER_POSITION_VALID, s->current.raster_valid)
    FLOAT(GL_POINT_SIZE, s->point.size) FLOAT(GL_POINT_SIZE_MIN, s->point.min) FLOAT(GL_POINT_SIZE_MAX, s->point.max)
    FLOAT(GL_POINT_FADE_THRESHOLD_SIZE, s->point.fade) FLOATS(GL_POINT_DISTANCE_ATTENUATION, s->point.attenuation, 3)
    FLOAT(GL_LINE_WIDTH, s->line.width) WHOLE(GL_LINE_STIPPLE_PATTERN, s->line.pattern)
    WHOLE(GL_LINE_STIPPLE_REPEAT, s->line.factor)
    case GL_POLYGON_MODE: o->v[0] = (double)s->polygon.front; o->v[1] = (double)s->polygon.back; o->count = 2; return 1;
    WHOLE(GL_CULL_FACE_MODE, s->polygon.cull) WHOLE(GL_FRONT_FACE, s->polygon.front_face)
    FLOAT(GL_POLYGON_OFFSET_FACTOR, s->polygon.factor) FLOAT(GL_POLYGON_OFFSET_UNITS, s->polygon.units)
    WHOLE(GL_SHADE_MODEL, s->lighting.shade) WHOLE(GL_COLOR_MATERIAL_FACE, s->lighting.tracks_face)
    WHOLE(GL_COLOR_MATERIAL_PARAMETER, s->lighting.tracks) COLOUR(GL_LIGHT_MODEL_AMBIENT, s->lighting.ambient)
    WHOLE(GL_LIGHT_MODEL_LOCAL_VIEWER, s->lighting.local) WHOLE(GL_LIGHT_MODEL_TWO_SIDE, s->lighting.two)
    WHOLE(GL_LIGHT_MODEL_COLOR_CONTROL, s->lighting.separate ? GL_SEPARATE_SPECULAR_COLOR : GL_SINGLE_COLOR)
    WHOLE(GL_FOG_MODE, s->fog.mode) WHOLE(GL_FOG_COORD_SRC, s->fog.source) FLOAT(GL_FOG_DENSITY, s->fog.density)
    FLOAT(GL_FOG_START, s->fog.start) FLOAT(GL_FOG_END, s->fog.end) COLOUR(GL_FOG_COLOR, s->fog.colour)
    WHOLE(GL_FOG_INDEX, s->fog.index)
    WHOLE(GL_DEPTH_FUNC, s->depth.func) WHOLE(GL_DEPTH_WRITEMASK, s->depth.mask)
    case GL_DEPTH_CLEAR_VALUE: o->v[0] = s->depth.clear; o->kind = GET_COLOUR; return 1;
    COLOUR(GL_ACCUM_CLEAR_VALUE, s->accum.clear) WHOLE(GL_STENCIL_FUNC, s->stencil.func)
    WHOLE(GL_STENCIL_FAIL, s->stencil.fail) WHOLE(GL_STENCIL_PASS_DEPTH_FAIL, s->stencil.zfail)
    WHOLE(GL_STENCIL_PASS_DEPTH_PASS, s->stencil.zpass) WHOLE(GL_STENCIL_REF, s->stencil.ref)
    WHOLE(GL_STENCIL_VALUE_MASK, (int32_t)s->stencil.mask) WHOLE(GL_STENCIL_WRITEMASK, (int32_t)s->stencil.write)
    WHOLE(GL_STENCIL_CLEAR_VALUE, s->stencil.clear) WHOLE(GL_ALPHA_TEST_FUNC, s->colour.alpha_func)
    case GL_ALPHA_TEST_REF: o->v[0] = (double)s->colour.alpha_ref; o->kind = GET_COLOUR; return 1;
    WHOLE(GL_BLEND_SRC, s->colour.blend[0]) WHOLE(GL_BLEND_DST, s->colour.blend[1])
    WHOLE(GL_BLEND_SRC_RGB, s->colour.blend[0]) WHOLE(GL_BLEND_DST_RGB, s->colour.blend[1])
    WHOLE(GL_BLEND_SRC_ALPHA, s->colour.blend[2]) WHOLE(GL_BLEND_DST_ALPHA, s->colour.blend[3])
    WHOLE(GL_BLEND_EQUATION_ALPHA_EXT, s->colour.equation[1])
    WHOLE(GL_BLEND_EQUATION, s->colour.equation[0]) COLOUR(GL_BLEND_COLOR, s->colour.blend_colour)
    WHOLE(GL_LOGIC_OP_MODE, s->colour.logic) COLOUR(GL_COLOR_CLEAR_VALUE, s->colour.clear)
    WHOLE(GL_DRAW_BUFFER, s->colour.draw)
    case GL_COLOR_WRITEMASK:
        for (int i = 0; i < 4; ++i) {
            o->v[i] = (double)(s->colour.mask >> i & 1u);
        }
        o->count = 4;
        return 1;
    FLOAT(GL_INDEX_CLEAR_VALUE, 0) WHOLE(GL_INDEX_WRITEMASK, -1)
    WHOLE(GL_PERSPECTIVE_CORRECTION_HINT, s->hint.hint[0]) WHOLE(GL_POINT_SMOOTH_HINT, s->hint.hint[1])
    WHOLE(GL_LINE_SMOOTH_HINT, s->hint.hint[2]) WHOLE(GL_POLYGON_SMOOTH_HINT, s->hint.poly)
    WHOLE(GL_FOG_HINT, s->hint.hint[3])
    WHOLE(GL_TEXTURE_COMPRESSION_HINT, s->hint.hint[4]) WHOLE(GL_GENERATE_MIPMAP_HINT, s->hint.hint[5])
    FLOAT(GL_SAMPLE_COVERAGE_VALUE, s->sample.coverage) WHOLE(GL_SAMPLE_COVERAGE_INVERT, s->sample.invert)
    default: return 0;
    }
}

GLboolean glIsEnabled(GLenum name);

static int get_any(get_value *o, gl_context *c, GLenum name)
{
    memset(o, 0, sizeof *o);
    o->count = 1;
    gl_find_surface(c, &c->drawn, c->framebuffer);
    if (get_current(o, c, name) || get_transform(o, c, name) || get_limits(o, c, name) || get_pixels(o, c, name) ||
        get_arrays(o, c, name)) {
        return 1;
    }
    const GLenum was = c->error;
    c->error = GL_NO_ERROR;
    o->v[0] = (double)glIsEnabled(name);
    const int known = c->error == GL_NO_ERROR;
    c->error = was;
    if (!known) {
        gl_error(c, GL_INVALID_ENUM);
    }
    return known;
}

static int32_t get_round(double v)
{
    return v >= 2147483647.0 ? 2147483647 : v <= -2147483648.0 ? -2147483647 - 1 : (int32_t)(v < 0 ? v - 0.5 : v + 0.5);
}

static int32_t get_int(const get_value *o, int i)
{
    const double v = o->v[i];
    return o->kind == GET_COLOUR ? get_round((v * 4294967295.0 - 1.0) * 0.5) : o->kind == GET_FLOAT ? get_round(v)
           : v > 2147483647.0 ? (int32_t)(uint32_t)v : (int32_t)v;
}

#define GET(call, T, VALUE) \
    void call(GLenum name, T *out) \
    { \
        get_value o; \
        GL_ENTER() \
        if (get_any(&o, c, name)) { \
            for (int i = 0; i < o.count; ++i) out[i] = VALUE; \
        } \
    }
GET(glGetIntegerv, GLint, get_int(&o, i))
GET(glGetFloatv, GLfloat, (float)o.v[i])
GET(glGetDoublev, GLdouble, o.v[i])
GET(glGetBooleanv, GLboolean, (GLboolean)(o.v[i] != 0.0))

const GLubyte *glGetString(GLenum name)
{
    GL_ENTER(NULL)
    switch (name) {
    case GL_VENDOR: return (const GLubyte *)"lambent";
    case GL_RENDERER: return (const GLubyte *)"lambent";
    case GL_VERSION: return (const GLubyte *)"1.5 lambent";
    case GL_EXTENSIONS:
        return (const GLubyte *)
            "GL_ARB_depth_buffer_float GL_ARB_depth_texture GL_ARB_framebuffer_object GL_ARB_multitexture "
            "GL_ARB_occlusion_query GL_ARB_point_parameters "
            "GL_ARB_point_sprite GL_ARB_shadow GL_ARB_texture_border_clamp GL_ARB_texture_cube_map "
            "GL_ARB_texture_env_add GL_ARB_texture_env_combine GL_ARB_texture_env_crossbar GL_ARB_texture_env_dot3 "
            "GL_ARB_texture_mirrored_repeat GL_ARB_texture_non_power_of_two GL_ARB_texture_rectangle "
            "GL_ARB_transpose_matrix "
            "GL_ARB_vertex_buffer_object GL_ARB_window_pos GL_EXT_abgr GL_EXT_bgra GL_EXT_blend_color "
            "GL_EXT_blend_equation_separate "
            "GL_EXT_blend_func_separate GL_EXT_blend_minmax GL_EXT_blend_subtract GL_EXT_compiled_vertex_array "
            "GL_EXT_copy_texture GL_EXT_draw_range_elements GL_EXT_fog_coord GL_EXT_framebuffer_blit "
            "GL_EXT_framebuffer_object "
            "GL_EXT_multi_draw_arrays GL_EXT_packed_depth_stencil GL_EXT_packed_pixels GL_EXT_point_parameters "
            "GL_EXT_polygon_offset GL_EXT_rescale_normal GL_EXT_secondary_color GL_EXT_separate_specular_color "
            "GL_EXT_shadow_funcs GL_EXT_stencil_wrap GL_EXT_subtexture GL_EXT_texture GL_EXT_texture3D "
            "GL_EXT_texture_cube_map GL_EXT_texture_edge_clamp GL_EXT_texture_env_add GL_EXT_texture_env_combine "
            "GL_EXT_texture_lod_bias GL_EXT_texture_object GL_EXT_texture_swizzle GL_EXT_vertex_array "
            "GL_IBM_texture_mirrored_repeat "
            "GL_SGIS_generate_mipmap GL_SGIS_texture_border_clamp GL_SGIS_texture_edge_clamp GL_SGIS_texture_lod";
    default:
        gl_error(c, GL_INVALID_ENUM);
        return NULL;
    }
}

/* --- parameters of objects ---------------------------------------------------------------------------------------- */

/* CALLf and CALLi of a function that fills a get_value. */
#define GET_2(call, fill) \
    void call##fv(GLenum a, GLenum n, GLfloat *out) \
    { \
        get_value o; \
        GL_ENTER() \
        memset(&o, 0, sizeof o); \
        o.count = 1; \
        if (fill(&o, c, a, n)) for (int i = 0; i < o.count; ++i) out[i] = (float)o.v[i]; \
    } \
    void call##iv(GLenum a, GLenum n, GLint *out) \
    { \
        get_value o; \
        GL_ENTER() \
        memset(&o, 0, sizeof o); \
        o.count = 1; \
        if (fill(&o, c, a, n)) for (int i = 0; i < o.count; ++i) out[i] = get_int(&o, i); \
    }
#define NONE default: gl_error(c, GL_INVALID_ENUM); return 0;

static int get_light(get_value *o, gl_context *c, GLenum a, GLenum n)
{
    GL_FAIL(a < GL_LIGHT0 || a >= GL_LIGHT0 + GL_LIGHTS, GL_INVALID_ENUM, 0)
    const gl_light *l = &c->s.lighting.light[a - GL_LIGHT0];
    switch (n) {
    COLOUR(GL_AMBIENT, l->ambient) COLOUR(GL_DIFFUSE, l->diffuse) COLOUR(GL_SPECULAR, l->specular)
    FLOATS(GL_POSITION, l->position, 4) FLOATS(GL_SPOT_DIRECTION, l->spot, 3) FLOAT(GL_SPOT_EXPONENT, l->exponent)
    FLOAT(GL_SPOT_CUTOFF, l->cutoff) FLOAT(GL_CONSTANT_ATTENUATION, l->attenuation[0])
    FLOAT(GL_LINEAR_ATTENUATION, l->attenuation[1]) FLOAT(GL_QUADRATIC_ATTENUATION, l->attenuation[2])
    NONE
    }
}

static int get_material(get_value *o, gl_context *c, GLenum a, GLenum n)
{
    GL_FAIL(a != GL_FRONT && a != GL_BACK, GL_INVALID_ENUM, 0)
    gl_light_track(c);
    const gl_material *m = &c->s.lighting.material[a == GL_BACK];
    switch (n) {
    COLOUR(GL_AMBIENT, m->ambient) COLOUR(GL_DIFFUSE, m->diffuse) COLOUR(GL_SPECULAR, m->specular)
    COLOUR(GL_EMISSION, m->emission) FLOAT(GL_SHININESS, m->shininess) FLOATS(GL_COLOR_INDEXES, m->indexes, 3)
    NONE
    }
}

static int get_tex_env(get_value *o, gl_context *c, GLenum a, GLenum n)
{
    const gl_unit *u = &c->s.texture.unit[c->s.texture.active];
    if (a == GL_POINT_SPRITE_ARB && n == GL_COORD_REPLACE_ARB) {
        o->v[0] = (double)u->replaces;
        return 1;
    }
    if (a == GL_TEXTURE_FILTER_CONTROL && n == GL_TEXTURE_LOD_BIAS) {
        o->v[0] = (double)u->lod_bias;
        o->kind = GET_FLOAT;
        return 1;
    }
    GL_FAIL(a != GL_TEXTURE_ENV, GL_INVALID_ENUM, 0)
    switch (n) {
    WHOLE(GL_TEXTURE_ENV_MODE, u->mode) COLOUR(GL_TEXTURE_ENV_COLOR, u->colour) WHOLE(GL_COMBINE_RGB, u->combine[0])
    WHOLE(GL_COMBINE_ALPHA, u->combine[1]) FLOAT(GL_RGB_SCALE, u->scale[0]) FLOAT(GL_ALPHA_SCALE, u->scale[1])
    WHOLE(GL_SRC0_RGB, u->source[0][0]) WHOLE(GL_SRC1_RGB, u->source[0][1]) WHOLE(GL_SRC2_RGB, u->source[0][2])
    WHOLE(GL_SRC0_ALPHA, u->source[1][0]) WHOLE(GL_SRC1_ALPHA, u->source[1][1]) WHOLE(GL_SRC2_ALPHA, u->source[1][2])
    WHOLE(GL_OPERAND0_RGB, u->operand[0][0]) WHOLE(GL_OPERAND1_RGB, u->operand[0][1])
    WHOLE(GL_OPERAND2_RGB, u->operand[0][2])
    WHOLE(GL_OPERAND0_ALPHA, u->operand[1][0]) WHOLE(GL_OPERAND1_ALPHA, u->operand[1][1])
    WHOLE(GL_OPERAND2_ALPHA, u->operand[1][2])
    NONE
    }
}

static int get_tex_gen(get_value *o, gl_context *c, GLenum a, GLenum n)
{
    GL_FAIL(a < GL_S || a > GL_Q, GL_INVALID_ENUM, 0)
    const gl_gen *g = &c->s.texture.unit[c->s.texture.active].coordinate[a - GL_S];
    switch (n) {
    WHOLE(GL_TEXTURE_GEN_MODE, g->mode) FLOATS(GL_OBJECT_PLANE, g->object, 4) FLOATS(GL_EYE_PLANE, g->eye, 4)
    NONE
    }
}

static int get_kind(GLenum t)
{
    return t == GL_TEXTURE_1D              ? TARGET_1D
           : t == GL_TEXTURE_2D            ? TARGET_2D
           : t == GL_TEXTURE_RECTANGLE_ARB ? TARGET_RECT
           : t == GL_TEXTURE_3D            ? TARGET_3D
           : t == GL_TEXTURE_CUBE_MAP      ? TARGET_CUBE
                                           : -1;
}

static int get_tex_parameter(get_value *o, gl_context *c, GLenum a, GLenum n)
{
    GL_FAIL(get_kind(a) < 0, GL_INVALID_ENUM, 0)
    const gl_texture *t = c->s.texture.unit[c->s.texture.active].bound[get_kind(a)];
    switch (n) {
    WHOLE(GL_TEXTURE_MIN_FILTER, t->min_filter) WHOLE(GL_TEXTURE_MAG_FILTER, t->mag_filter)
    WHOLE(GL_TEXTURE_WRAP_S, t->wrap[0])
    WHOLE(GL_TEXTURE_WRAP_T, t->wrap[1]) WHOLE(GL_TEXTURE_WRAP_R, t->wrap[2]) COLOUR(GL_TEXTURE_BORDER_COLOR, t->border)
    case GL_TEXTURE_PRIORITY: o->v[0] = (double)t->priority; o->kind = GET_COLOUR; return 1;
    WHOLE(GL_TEXTURE_SWIZZLE_R_EXT, t->swizzle[0]) WHOLE(GL_TEXTURE_SWIZZLE_G_EXT, t->swizzle[1])
    WHOLE(GL_TEXTURE_SWIZZLE_B_EXT, t->swizzle[2]) WHOLE(GL_TEXTURE_SWIZZLE_A_EXT, t->swizzle[3])
    INTS(GL_TEXTURE_SWIZZLE_RGBA_EXT, (const int32_t *)t->swizzle, 4)
    WHOLE(GL_TEXTURE_RESIDENT, 1) FLOAT(GL_TEXTURE_MIN_LOD, t->min_lod) FLOAT(GL_TEXTURE_MAX_LOD, t->max_lod)
    FLOAT(GL_TEXTURE_LOD_BIAS, t->lod_bias) WHOLE(GL_TEXTURE_BASE_LEVEL, t->base_level)
    WHOLE(GL_TEXTURE_MAX_LEVEL, t->max_level)
    WHOLE(GL_GENERATE_MIPMAP, t->generate) WHOLE(GL_TEXTURE_COMPARE_MODE, t->compare_mode)
    WHOLE(GL_TEXTURE_COMPARE_FUNC, t->compare_func)
    WHOLE(GL_DEPTH_TEXTURE_MODE, t->depth_mode) FLOAT(GL_TEXTURE_MAX_ANISOTROPY_EXT, t->anisotropy)
    NONE
    }
}
GET_2(glGetLight, get_light)
GET_2(glGetMaterial, get_material)
GET_2(glGetTexEnv, get_tex_env)
GET_2(glGetTexGen, get_tex_gen)
GET_2(glGetTexParameter, get_tex_parameter)

void glGetTexGendv(GLenum a, GLenum n, GLdouble *out)
{
    get_value o;
    GL_ENTER()
    memset(&o, 0, sizeof o);
    o.count = 1;
    if (get_tex_gen(&o, c, a, n)) {
        for (int i = 0; i < o.count; ++i) {
            out[i] = o.v[i];
        }
    }
}

static int get_level(gl_context *c, GLenum target, GLint level, GLenum name, GLint *out)
{
    static const GLenum proxies[TARGETS] = {GL_PROXY_TEXTURE_1D, GL_PROXY_TEXTURE_2D,
        GL_PROXY_TEXTURE_RECTANGLE_ARB, GL_PROXY_TEXTURE_3D,
        GL_PROXY_TEXTURE_CUBE_MAP};
    const gl_image *m = NULL;
    GL_FAIL(level < 0 || level >= GL_LEVELS, GL_INVALID_VALUE, 0)
    const gl_unit *u = &c->s.texture.unit[c->s.texture.active];
    for (int i = 0; i < TARGETS; ++i) {
        m = proxies[i] == target ? &c->proxy[i] : m;
    }
    if (target >= GL_TEXTURE_CUBE_MAP_POSITIVE_X && target <= GL_TEXTURE_CUBE_MAP_NEGATIVE_Z) {
        m = &u->bound[TARGET_CUBE]->image[target - GL_TEXTURE_CUBE_MAP_POSITIVE_X][level];
    } else if (get_kind(target) >= 0 && target != GL_TEXTURE_CUBE_MAP) {
        m = &u->bound[get_kind(target)]->image[0][level];
    }
    GL_FAIL(m == NULL, GL_INVALID_ENUM, 0)
    const int there = m->internal != 0;
    const GLenum b = m->base;
    switch (name) {
    case GL_TEXTURE_WIDTH: *out = there ? m->width + 2 * m->border : 0; return 1;
    case GL_TEXTURE_HEIGHT: *out = there ? m->height + (target == GL_TEXTURE_1D ||
        target == GL_PROXY_TEXTURE_1D ? 0 : 2 * m->border) : 0; return 1;
    case GL_TEXTURE_DEPTH: *out = there ? m->depth + (target == GL_TEXTURE_3D ||
        target == GL_PROXY_TEXTURE_3D ? 2 * m->border : 0) : 0; return 1;
    case GL_TEXTURE_INTERNAL_FORMAT:
        *out = there ? (GLint)m->internal : 1;
        if (m->internal >= GL_COMPRESSED_ALPHA && m->internal <= GL_COMPRESSED_RGBA) {
            *out = (GLint)m->base;
        }
        return 1;
    case GL_TEXTURE_BORDER: *out = m->border; return 1;
    case GL_TEXTURE_RED_SIZE: case GL_TEXTURE_GREEN_SIZE: case GL_TEXTURE_BLUE_SIZE: *out = b == GL_RGB ||
        b == GL_RGBA ? 8 : 0; return 1;
    case GL_TEXTURE_ALPHA_SIZE: *out = b == GL_RGBA || b == GL_ALPHA || b == GL_LUMINANCE_ALPHA ? 8 : 0; return 1;
    case GL_TEXTURE_LUMINANCE_SIZE: *out = b == GL_LUMINANCE || b == GL_LUMINANCE_ALPHA ? 8 : 0; return 1;
    case GL_TEXTURE_INTENSITY_SIZE: *out = b == GL_INTENSITY ? 8 : 0; return 1;
    case GL_TEXTURE_DEPTH_SIZE: *out = b == GL_DEPTH_COMPONENT ? 32 : 0; return 1;
    case GL_TEXTURE_STENCIL_SIZE_EXT: *out = gl_has_stencil(m->internal) ? 8 : 0; return 1;
    case GL_TEXTURE_COMPRESSED: *out = 0; return 1;
    case GL_TEXTURE_COMPRESSED_IMAGE_SIZE: gl_error(c, GL_INVALID_OPERATION); return 0;
    NONE
    }
}

void glGetTexLevelParameteriv(GLenum target, GLint level, GLenum name, GLint *out)
{
    GL_ENTER()
    (void)get_level(c, target, level, name, out);
}

void glGetTexLevelParameterfv(GLenum target, GLint level, GLenum name, GLfloat *out)
{
    GLint v = 0;
    GL_ENTER()
    if (get_level(c, target, level, name, &v)) {
        *out = (float)v;
    }
}

void glGetClipPlane(GLenum plane, GLdouble *out)
{
    GL_ENTER()
    GL_FAIL(plane < GL_CLIP_PLANE0 || plane >= GL_CLIP_PLANE0 + GL_CLIP_PLANES, GL_INVALID_ENUM, )
    for (int i = 0; i < 4; ++i) {
        out[i] = (double)c->s.transform.plane[plane - GL_CLIP_PLANE0][i];
    }
}

void glGetPolygonStipple(GLubyte *out)
{
    GL_ENTER()
    const gl_store *s = &c->client.pack;
    const size_t align = (size_t)s->align, row = (size_t)((s->row > 0 ? s->row : 32) + 7) / 8,
        stride = (row + align - 1) / align * align;
    for (size_t i = 0; i < 1024; ++i) {
        const size_t at = i % 32 + (size_t)s->pixels;
        uint8_t *to = out + stride * (i / 32 + (size_t)s->rows) + at / 8;
        const int bit = c->s.stipple.bits[i / 8] >> (7 - i % 8) & 1, shift = (int)(s->lsb ? at & 7 : 7 - (at & 7));
        *to = (uint8_t)((*to & ~(1 << shift)) | bit << shift);
    }
}

#define GET_PIXEL_MAP(t, T, VALUE, INDEX) \
    void glGetPixelMap##t(GLenum map, T *out) \
    { \
        GL_ENTER() \
        GL_FAIL(map < GL_PIXEL_MAP_I_TO_I || map > GL_PIXEL_MAP_A_TO_A, GL_INVALID_ENUM, ) \
        const int k = (int)(map - GL_PIXEL_MAP_I_TO_I); \
        for (int i = 0; i < c->pixel_map_size[k]; ++i) { \
            const float v = c->pixel_map[k][i]; \
            out[i] = k < 2 ? (T)(INDEX) : (T)(VALUE); \
        } \
    }
GET_PIXEL_MAP(fv, GLfloat, v, v)
GET_PIXEL_MAP(uiv, GLuint, (double)gl_unit_range(v) * 4294967295.0, v)
GET_PIXEL_MAP(usv, GLushort, gl_unit_range(v) * 65535.0f + 0.5f, v)
