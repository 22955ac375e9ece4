/* gl_state.c: plain state: capabilities, functions, masks, and the stacks of attributes. */
#include "gl_context.h"

#include <stddef.h>
#include <stdio.h>

void gl_error(gl_context *c, GLenum error)
{
    if (c->error == GL_NO_ERROR) {
        c->error = error;
    }
}

GLenum glGetError(void)
{
    GL_ENTER(0)
    const GLenum error = c->error;
    c->error = GL_NO_ERROR;
    return error;
}

/* --- capabilities ------------------------------------------------------------------------------------------------- */

static const struct { GLenum name; int32_t cap; GLbitfield group; } state_caps[] = {
    {GL_ALPHA_TEST, CAP_ALPHA_TEST, GL_COLOR_BUFFER_BIT}, {GL_AUTO_NORMAL, CAP_AUTO_NORMAL, GL_EVAL_BIT},
    {GL_BLEND, CAP_BLEND, GL_COLOR_BUFFER_BIT}, {GL_COLOR_LOGIC_OP, CAP_LOGIC, GL_COLOR_BUFFER_BIT},
    {GL_INDEX_LOGIC_OP, CAP_INDEX_LOGIC, GL_COLOR_BUFFER_BIT}, {GL_COLOR_MATERIAL, CAP_COLOR_MATERIAL, GL_LIGHTING_BIT},
    {GL_COLOR_SUM, CAP_COLOR_SUM, GL_FOG_BIT}, {GL_CULL_FACE, CAP_CULL, GL_POLYGON_BIT},
    {GL_DEPTH_TEST, CAP_DEPTH, GL_DEPTH_BUFFER_BIT}, {GL_DITHER, CAP_DITHER, GL_COLOR_BUFFER_BIT},
    {GL_FOG, CAP_FOG, GL_FOG_BIT}, {GL_LIGHTING, CAP_LIGHTING, GL_LIGHTING_BIT},
    {GL_LINE_SMOOTH, CAP_LINE_SMOOTH, GL_LINE_BIT}, {GL_LINE_STIPPLE, CAP_LINE_STIPPLE, GL_LINE_BIT},
    {GL_NORMALIZE, CAP_NORMALIZE, GL_TRANSFORM_BIT}, {GL_RESCALE_NORMAL, CAP_RESCALE, GL_TRANSFORM_BIT},
    {GL_POINT_SMOOTH, CAP_POINT_SMOOTH, GL_POINT_BIT}, {GL_POINT_SPRITE_ARB, CAP_POINT_SPRITE, GL_POINT_BIT},
    {GL_POLYGON_OFFSET_POINT, CAP_OFFSET_POINT, GL_POLYGON_BIT},
    {GL_POLYGON_OFFSET_LINE, CAP_OFFSET_LINE, GL_POLYGON_BIT},
    {GL_POLYGON_OFFSET_FILL, CAP_OFFSET_FILL, GL_POLYGON_BIT}, {GL_POLYGON_SMOOTH, CAP_POLYGON_SMOOTH, GL_POLYGON_BIT},
    {GL_POLYGON_STIPPLE, CAP_POLYGON_STIPPLE, GL_POLYGON_BIT}, {GL_SCISSOR_TEST, CAP_SCISSOR, GL_SCISSOR_BIT},
    {GL_STENCIL_TEST, CAP_STENCIL, GL_STENCIL_BUFFER_BIT}, {GL_MULTISAMPLE, CAP_MULTISAMPLE, GL_MULTISAMPLE_BIT},
    {GL_SAMPLE_ALPHA_TO_COVERAGE, CAP_SAMPLE_ALPHA, GL_MULTISAMPLE_BIT},
    {GL_SAMPLE_ALPHA_TO_ONE, CAP_SAMPLE_ONE, GL_MULTISAMPLE_BIT},
    {GL_SAMPLE_COVERAGE, CAP_SAMPLE_COVERAGE, GL_MULTISAMPLE_BIT},
    {GL_BOUNCED_LIGHT_LMB, CAP_BOUNCED, GL_LIGHTING_BIT}};
enum { STATE_CAPS = sizeof state_caps / sizeof state_caps[0] };

/* A capability's number, or -1. */
static int state_cap(GLenum name)
{
    for (int i = 0; i < STATE_CAPS; ++i) {
        if (state_caps[i].name == name) {
            return state_caps[i].cap;
        }
    }
    return name >= GL_CLIP_PLANE0 && name < GL_CLIP_PLANE0 + GL_CLIP_PLANES ? CAP_CLIP + (int)(name - GL_CLIP_PLANE0)
           : name >= GL_LIGHT0 && name < GL_LIGHT0 + GL_LIGHTS            ? CAP_LIGHT + (int)(name - GL_LIGHT0)
           : name >= GL_MAP1_COLOR_4 && name <= GL_MAP1_VERTEX_4         ? CAP_MAP1 + (int)(name - GL_MAP1_COLOR_4)
           : name >= GL_MAP2_COLOR_4 && name <= GL_MAP2_VERTEX_4         ? CAP_MAP2 + (int)(name - GL_MAP2_COLOR_4)
                                                                         : -1;
}

/* A capability of the active texture unit: a pointer to the bits, and the bit; or NULL. */
static uint32_t *state_unit_cap(gl_context *c, GLenum name, uint32_t *bit)
{
    gl_unit *u = &c->s.texture.unit[c->s.texture.active];
    const int target = name == GL_TEXTURE_1D         ? TARGET_1D
                       : name == GL_TEXTURE_2D       ? TARGET_2D
                       : name == GL_TEXTURE_RECTANGLE_ARB ? TARGET_RECT
                       : name == GL_TEXTURE_3D       ? TARGET_3D
                       : name == GL_TEXTURE_CUBE_MAP ? TARGET_CUBE
                                                     : -1;
    if (target >= 0) {
        *bit = 1u << target;
        return &u->on;
    }
    if (name >= GL_TEXTURE_GEN_S && name <= GL_TEXTURE_GEN_Q) {
        *bit = 1u << (name - GL_TEXTURE_GEN_S);
        return &u->gen;
    }
    return NULL;
}

void gl_op_enable(gl_context *c, const gl_word *w)
{
    const int cap = state_cap(w[0].u);
    uint32_t bit = 0, *unit = cap < 0 ? state_unit_cap(c, w[0].u, &bit) : NULL;
    if (cap >= 0) {
        gl_light_track(c); /* colours that were tracked stay */
        c->s.caps = (c->s.caps & ~((uint64_t)1 << cap)) | (uint64_t)(w[1].i != 0) << cap;
        if (cap == CAP_BOUNCED && w[1].i == 0) {
            c->bounce_failed = 0;
        }
        gl_light_track(c);
    } else if (unit != NULL) {
        *unit = (*unit & ~bit) | (w[1].i != 0 ? bit : 0);
    } else {
        gl_error(c, GL_INVALID_ENUM);
    }
}

GLboolean glIsEnabled(GLenum name)
{
    GL_ENTER(0)
    const int cap = state_cap(name);
    uint32_t bit = 0;
    if (cap >= 0) {
        return (GLboolean)gl_is_on(c, cap);
    }
    const uint32_t *unit = state_unit_cap(c, name, &bit);
    if (unit != NULL) {
        return (*unit & bit) != 0;
    }
    static const GLenum arrays[ARRAY_TEX + 1] = {GL_VERTEX_ARRAY, GL_NORMAL_ARRAY, GL_COLOR_ARRAY, GL_INDEX_ARRAY,
                                                 GL_EDGE_FLAG_ARRAY, GL_FOG_COORD_ARRAY, GL_SECONDARY_COLOR_ARRAY,
                                                 GL_TEXTURE_COORD_ARRAY};
    for (int i = 0; i <= ARRAY_TEX; ++i) {
        if (arrays[i] == name) {
            return c->client.array[i < ARRAY_TEX ? i : ARRAY_TEX + c->client.active].on != 0;
        }
    }
    gl_error(c, GL_INVALID_ENUM);
    return 0;
}

/* --- checked values ----------------------------------------------------------------------------------------------- */

static int state_is_func(GLenum f) { return f >= GL_NEVER && f <= GL_ALWAYS; }
static int state_is_face(GLenum f) { return f == GL_FRONT || f == GL_BACK || f == GL_FRONT_AND_BACK; }

static int state_is_factor(GLenum f, int target)
{
    return f <= GL_ONE || (f >= GL_SRC_COLOR && f <= GL_ONE_MINUS_DST_COLOR) ||
           (f == GL_SRC_ALPHA_SATURATE && !target) || (f >= GL_CONSTANT_COLOR && f <= GL_ONE_MINUS_CONSTANT_ALPHA);
}

static int state_is_equation(GLenum e)
{
    return e == GL_FUNC_ADD || e == GL_MIN || e == GL_MAX || e == GL_FUNC_SUBTRACT || e == GL_FUNC_REVERSE_SUBTRACT;
}

static int state_is_stencil_op(GLenum o)
{
    return o == GL_KEEP || o == GL_ZERO || o == GL_REPLACE || o == GL_INCR || o == GL_DECR || o == GL_INVERT ||
           o == GL_INCR_WRAP || o == GL_DECR_WRAP;
}

#define OP(name) void gl_op_##name(gl_context *c, const gl_word *w)
#define CHECK(good, error) \
    if (!(good)) { gl_error(c, error); return; }

OP(alpha_func)
{
    CHECK(state_is_func(w[0].u), GL_INVALID_ENUM)
    c->s.colour.alpha_func = w[0].u;
    c->s.colour.alpha_ref = gl_unit_range(w[1].f);
}
OP(blend_func)
{
    for (int i = 0; i < 4; ++i) {
        CHECK(state_is_factor(w[i].u, i & 1), GL_INVALID_ENUM)
    }
    for (int i = 0; i < 4; ++i) {
        c->s.colour.blend[i] = w[i].u;
    }
}
OP(blend_equation)
{
    CHECK(state_is_equation(w[0].u) && state_is_equation(w[1].u), GL_INVALID_ENUM)
    c->s.colour.equation[0] = w[0].u;
    c->s.colour.equation[1] = w[1].u;
}
static void state_colour(float out[4], const gl_word *w)
{
    for (int i = 0; i < 4; ++i) {
        out[i] = gl_unit_range(w[i].f);
    }
}
OP(blend_colour) { state_colour(c->s.colour.blend_colour, w); }
OP(clear_colour) { state_colour(c->s.colour.clear, w); }
OP(clear_accum)
{
    for (int i = 0; i < 4; ++i) {
        c->s.accum.clear[i] = clampf(w[i].f, -1.0f, 1.0f);
    }
}
OP(clear_depth) { c->s.depth.clear = (double)gl_unit_range(w[0].f); }
OP(clear_stencil) { c->s.stencil.clear = w[0].i & 255; }
OP(colour_mask) { c->s.colour.mask = w[0].u; }
OP(cull_face)
{
    CHECK(state_is_face(w[0].u), GL_INVALID_ENUM)
    c->s.polygon.cull = w[0].u;
}
OP(depth_func)
{
    CHECK(state_is_func(w[0].u), GL_INVALID_ENUM)
    c->s.depth.func = w[0].u;
}
OP(depth_mask) { c->s.depth.mask = w[0].i; }
OP(depth_range)
{
    c->s.viewport.range[0] = (double)gl_unit_range(w[0].f);
    c->s.viewport.range[1] = (double)gl_unit_range(w[1].f);
}

/* Buffers of a window with one buffer, or of a framebuffer object. */
static GLenum state_check_buffer(const gl_context *c, GLenum b, int reads, const gl_framebuffer *f)
{
    if (f != NULL) {
        return b == GL_COLOR_ATTACHMENT0_EXT || b == GL_NONE ? GL_NO_ERROR
               : b > GL_COLOR_ATTACHMENT0_EXT && b <= GL_COLOR_ATTACHMENT15_EXT ? GL_INVALID_OPERATION
               : b >= GL_FRONT_LEFT && b <= GL_FRONT_AND_BACK ? GL_INVALID_OPERATION : GL_INVALID_ENUM;
    }
    (void)c;
    switch (b) {
    case GL_FRONT: case GL_FRONT_LEFT: case GL_LEFT: return GL_NO_ERROR;
    case GL_BACK: case GL_BACK_LEFT: return GL_NO_ERROR; /* programs made for windows name the
                                                          * back buffer: the one buffer */
    case GL_FRONT_AND_BACK: return reads ? GL_INVALID_ENUM : GL_NO_ERROR;
    case GL_NONE: return GL_NO_ERROR;
    case GL_RIGHT: case GL_FRONT_RIGHT: case GL_BACK_RIGHT: case GL_AUX0: case GL_AUX1: case GL_AUX2: case GL_AUX3:
        return GL_INVALID_OPERATION;
    default:
        return b >= GL_COLOR_ATTACHMENT0_EXT && b <= GL_COLOR_ATTACHMENT15_EXT ? GL_INVALID_OPERATION : GL_INVALID_ENUM;
    }
}
OP(draw_buffer)
{
    const GLenum error = state_check_buffer(c, w[0].u, 0, c->framebuffer);
    CHECK(error == GL_NO_ERROR, error)
    c->s.colour.draw = w[0].u;
}
OP(read_buffer)
{
    const GLenum error = state_check_buffer(c, w[0].u, 1, c->read_framebuffer);
    CHECK(error == GL_NO_ERROR, error)
    c->s.pixel.read = w[0].u;
}
OP(fog)
{
    switch (w[0].u) {
    case GL_FOG_MODE:
        CHECK(w[1].f == (float)GL_LINEAR || w[1].f == (float)GL_EXP || w[1].f == (float)GL_EXP2, GL_INVALID_ENUM)
        c->s.fog.mode = (GLenum)w[1].f;
        break;
    case GL_FOG_COORD_SRC:
        CHECK(w[1].f == (float)GL_FOG_COORD || w[1].f == (float)GL_FRAGMENT_DEPTH, GL_INVALID_ENUM)
        c->s.fog.source = (GLenum)w[1].f;
        break;
    case GL_FOG_DENSITY:
        CHECK(w[1].f >= 0.0f, GL_INVALID_VALUE)
        c->s.fog.density = w[1].f;
        break;
    case GL_FOG_START: c->s.fog.start = w[1].f; break;
    case GL_FOG_END: c->s.fog.end = w[1].f; break;
    case GL_FOG_INDEX: c->s.fog.index = (GLenum)gl_int(w[1].f); break;
    case GL_FOG_COLOR: state_colour(c->s.fog.colour, w + 1); break;
    default: gl_error(c, GL_INVALID_ENUM); break;
    }
}
OP(front_face)
{
    CHECK(w[0].u == GL_CW || w[0].u == GL_CCW, GL_INVALID_ENUM)
    c->s.polygon.front_face = w[0].u;
}
OP(hint)
{
    GLenum *at = NULL;
    switch (w[0].u) {
    case GL_PERSPECTIVE_CORRECTION_HINT: at = &c->s.hint.hint[0]; break;
    case GL_POINT_SMOOTH_HINT: at = &c->s.hint.hint[1]; break;
    case GL_LINE_SMOOTH_HINT: at = &c->s.hint.hint[2]; break;
    case GL_POLYGON_SMOOTH_HINT: at = &c->s.hint.poly; break;
    case GL_FOG_HINT: at = &c->s.hint.hint[3]; break;
    case GL_TEXTURE_COMPRESSION_HINT: at = &c->s.hint.hint[4]; break;
    case GL_GENERATE_MIPMAP_HINT: at = &c->s.hint.hint[5]; break;
    default: break;
    }
    CHECK(at != NULL && w[1].u >= GL_DONT_CARE && w[1].u <= GL_NICEST, GL_INVALID_ENUM)
    *at = w[1].u;
}
OP(line_stipple)
{
    c->s.line.factor = clampi(w[0].i, 1, 256);
    c->s.line.pattern = w[1].u & 0xffffu;
}
OP(line_width)
{
    CHECK(w[0].f > 0.0f, GL_INVALID_VALUE)
    c->s.line.width = w[0].f;
}
OP(point_size)
{
    CHECK(w[0].f > 0.0f, GL_INVALID_VALUE)
    c->s.point.size = w[0].f;
}
OP(point_parameter)
{
    const float v = w[1].f;
    CHECK(!(v < 0.0f) || w[0].u == GL_POINT_DISTANCE_ATTENUATION, GL_INVALID_VALUE)
    switch (w[0].u) {
    case GL_POINT_SIZE_MIN: c->s.point.min = v; break;
    case GL_POINT_SIZE_MAX: c->s.point.max = v; break;
    case GL_POINT_FADE_THRESHOLD_SIZE: c->s.point.fade = v; break;
    case GL_POINT_DISTANCE_ATTENUATION:
        for (int i = 0; i < 3; ++i) {
            c->s.point.attenuation[i] = w[1 + i].f;
        }
        break;
    default: gl_error(c, GL_INVALID_ENUM); break;
    }
}
OP(logic_op)
{
    CHECK(w[0].u >= GL_CLEAR && w[0].u <= GL_SET, GL_INVALID_ENUM)
    c->s.colour.logic = w[0].u;
}
OP(polygon_mode)
{
    CHECK(state_is_face(w[0].u) && w[1].u >= GL_POINT && w[1].u <= GL_FILL, GL_INVALID_ENUM)
    c->s.polygon.front = w[0].u != GL_BACK ? w[1].u : c->s.polygon.front;
    c->s.polygon.back = w[0].u != GL_FRONT ? w[1].u : c->s.polygon.back;
}
OP(polygon_offset)
{
    c->s.polygon.factor = w[0].f;
    c->s.polygon.units = w[1].f;
}
OP(polygon_stipple) { memcpy(c->s.stipple.bits, gl_data_of(w), sizeof c->s.stipple.bits); }
OP(scissor)
{
    CHECK(w[2].i >= 0 && w[3].i >= 0, GL_INVALID_VALUE)
    memcpy(c->s.scissor.box, w, sizeof c->s.scissor.box);
}
OP(viewport)
{
    CHECK(w[2].i >= 0 && w[3].i >= 0, GL_INVALID_VALUE)
    memcpy(c->s.viewport.box, w, sizeof c->s.viewport.box);
    c->s.viewport.box[2] = mini(w[2].i, LMB_MAX_FRAME);
    c->s.viewport.box[3] = mini(w[3].i, LMB_MAX_FRAME);
}
OP(shade_model)
{
    CHECK(w[0].u == GL_FLAT || w[0].u == GL_SMOOTH, GL_INVALID_ENUM)
    c->s.lighting.shade = w[0].u;
}
OP(stencil_func)
{
    CHECK(state_is_func(w[0].u), GL_INVALID_ENUM)
    c->s.stencil.func = w[0].u;
    c->s.stencil.ref = clampi(w[1].i, 0, 255);
    c->s.stencil.mask = w[2].u;
}
OP(stencil_mask) { c->s.stencil.write = w[0].u; }
OP(stencil_op)
{
    CHECK(state_is_stencil_op(w[0].u) && state_is_stencil_op(w[1].u) && state_is_stencil_op(w[2].u), GL_INVALID_ENUM)
    c->s.stencil.fail = w[0].u;
    c->s.stencil.zfail = w[1].u;
    c->s.stencil.zpass = w[2].u;
}
OP(sample_coverage)
{
    c->s.sample.coverage = gl_unit_range(w[0].f);
    c->s.sample.invert = w[1].i;
}
OP(pixel_zoom)
{
    c->s.pixel.zoom[0] = w[0].f;
    c->s.pixel.zoom[1] = w[1].f;
}
OP(pixel_transfer)
{
    const float v = w[1].f;
    switch (w[0].u) {
    case GL_MAP_COLOR: c->s.pixel.map_colour = v != 0.0f; break;
    case GL_MAP_STENCIL: c->s.pixel.map_stencil = v != 0.0f; break;
    case GL_INDEX_SHIFT: c->s.pixel.index_shift = gl_int(v); break;
    case GL_INDEX_OFFSET: c->s.pixel.index_offset = gl_int(v); break;
    case GL_RED_SCALE: c->s.pixel.scale[0] = v; break;
    case GL_GREEN_SCALE: c->s.pixel.scale[1] = v; break;
    case GL_BLUE_SCALE: c->s.pixel.scale[2] = v; break;
    case GL_ALPHA_SCALE: c->s.pixel.scale[3] = v; break;
    case GL_RED_BIAS: c->s.pixel.bias[0] = v; break;
    case GL_GREEN_BIAS: c->s.pixel.bias[1] = v; break;
    case GL_BLUE_BIAS: c->s.pixel.bias[2] = v; break;
    case GL_ALPHA_BIAS: c->s.pixel.bias[3] = v; break;
    case GL_DEPTH_SCALE: c->s.pixel.depth_scale = v; break;
    case GL_DEPTH_BIAS: c->s.pixel.depth_bias = v; break;
    default: gl_error(c, GL_INVALID_ENUM); break;
    }
}
OP(pixel_map)
{
    const int k = (int)(w[0].u - GL_PIXEL_MAP_I_TO_I), n = w[1].i;
    CHECK(w[0].u >= GL_PIXEL_MAP_I_TO_I && k < 10, GL_INVALID_ENUM)
    CHECK(k > 5 || (n & (n - 1)) == 0, GL_INVALID_VALUE)
    memcpy(c->pixel_map[k], gl_data_of(w + 2), (size_t)n * sizeof(float));
    c->pixel_map_size[k] = n;
}

/* --- stacks of attributes ----------------------------------------------------------------------------------------- */

#define GROUP(bit, field) {bit, offsetof(gl_state, field), sizeof(((gl_state *)0)->field)}
static const struct { GLbitfield bit; size_t at, bytes; } state_groups[] = {
    GROUP(GL_CURRENT_BIT, current), GROUP(GL_POINT_BIT, point), GROUP(GL_LINE_BIT, line),
    GROUP(GL_POLYGON_BIT, polygon), GROUP(GL_POLYGON_STIPPLE_BIT, stipple), GROUP(GL_PIXEL_MODE_BIT, pixel),
    GROUP(GL_LIGHTING_BIT, lighting), GROUP(GL_FOG_BIT, fog), GROUP(GL_DEPTH_BUFFER_BIT, depth),
    GROUP(GL_ACCUM_BUFFER_BIT, accum), GROUP(GL_STENCIL_BUFFER_BIT, stencil), GROUP(GL_VIEWPORT_BIT, viewport),
    GROUP(GL_TRANSFORM_BIT, transform), GROUP(GL_COLOR_BUFFER_BIT, colour), GROUP(GL_HINT_BIT, hint),
    GROUP(GL_EVAL_BIT, eval), GROUP(GL_LIST_BIT, list), GROUP(GL_SCISSOR_BIT, scissor),
    GROUP(GL_MULTISAMPLE_BIT, sample)};

OP(push_attrib)
{
    CHECK(c->saved_count < GL_ATTRIB_STACK, GL_STACK_OVERFLOW)
    gl_light_track(c);
    c->saved[c->saved_count] = c->s;
    for (int i = 0; i < GL_UNITS * TARGETS; ++i) {
        c->saved_names[c->saved_count][i / TARGETS][i % TARGETS] =
            c->s.texture.unit[i / TARGETS].bound[i % TARGETS]->name;
    }
    c->saved_bits[c->saved_count++] = w[0].u;
}

static uint64_t state_caps_of(GLbitfield bits)
{
    uint64_t caps = 0;
    for (int i = 0; i < STATE_CAPS; ++i) {
        caps |= (bits & state_caps[i].group) != 0 ? (uint64_t)1 << state_caps[i].cap : 0;
    }
    for (int i = 0; i < GL_CLIP_PLANES; ++i) {
        caps |= (bits & GL_TRANSFORM_BIT) != 0 ? (uint64_t)1 << (CAP_CLIP + i) : 0;
    }
    for (int i = 0; i < GL_LIGHTS; ++i) {
        caps |= (bits & GL_LIGHTING_BIT) != 0 ? (uint64_t)1 << (CAP_LIGHT + i) : 0;
    }
    for (int i = 0; i < 18; ++i) {
        caps |= (bits & GL_EVAL_BIT) != 0 ? (uint64_t)1 << (CAP_MAP1 + i) : 0;
    }
    return (bits & GL_ENABLE_BIT) != 0 ? ~(uint64_t)0 : caps;
}

static void state_pop_textures(gl_context *c, const gl_state *old, GLbitfield bits)
{
    for (int i = 0; i < GL_UNITS; ++i) {
        gl_unit *to = &c->s.texture.unit[i];
        const gl_unit *from = &old->texture.unit[i];
        if ((bits & GL_TEXTURE_BIT) != 0) {
            gl_texture *bound[TARGETS];
            for (int t = 0; t < TARGETS; ++t) { /* a texture may have been deleted since */
                const gl_texture *was = from->bound[t];
                bound[t] = was == &c->default_texture[t] ||
                                   gl_find(&c->group->textures, c->saved_names[c->saved_count][i][t]) == was
                               ? from->bound[t]
                               : &c->default_texture[t];
            }
            *to = *from;
            memcpy(to->bound, bound, sizeof bound);
        } else if ((bits & GL_ENABLE_BIT) != 0) {
            to->on = from->on;
            to->gen = from->gen;
        }
    }
    if ((bits & GL_TEXTURE_BIT) != 0) {
        c->s.texture.active = old->texture.active;
    }
}

OP(pop_attrib)
{
    (void)w;
    CHECK(c->saved_count > 0, GL_STACK_UNDERFLOW)
    gl_light_track(c);
    const gl_state *old = &c->saved[--c->saved_count];
    const GLbitfield bits = c->saved_bits[c->saved_count];
    for (size_t i = 0; i < sizeof state_groups / sizeof state_groups[0]; ++i) {
        if ((bits & state_groups[i].bit) != 0) {
            memcpy((uint8_t *)&c->s + state_groups[i].at, (const uint8_t *)old + state_groups[i].at,
                   state_groups[i].bytes);
        }
    }
    const uint64_t caps = state_caps_of(bits);
    c->s.caps = (c->s.caps & ~caps) | (old->caps & caps);
    state_pop_textures(c, old, bits);
    c->matrices_dirty = 1;
}

void glPushClientAttrib(GLbitfield bits)
{
    GL_ENTER()
    GL_FAIL(c->client_count >= GL_ATTRIB_STACK, GL_STACK_OVERFLOW, )
    c->client_saved[c->client_count] = c->client;
    c->client_bits[c->client_count++] = bits;
}

void glPopClientAttrib(void)
{
    GL_ENTER()
    GL_FAIL(c->client_count == 0, GL_STACK_UNDERFLOW, )
    const gl_client *old = &c->client_saved[--c->client_count];
    if ((c->client_bits[c->client_count] & GL_CLIENT_PIXEL_STORE_BIT) != 0) {
        c->client.pack = old->pack;
        c->client.unpack = old->unpack;
    }
    if ((c->client_bits[c->client_count] & GL_CLIENT_VERTEX_ARRAY_BIT) != 0) {
        const gl_client now = c->client;
        c->client = *old;
        c->client.pack = now.pack;
        c->client.unpack = now.unpack;
    }
}

/* --- the beginning ------------------------------------------------------------------------------------------------ */

static void state_init_lighting(gl_state *s)
{
    for (int i = 0; i < 2; ++i) {
        gl_material *m = &s->lighting.material[i];
        m->ambient[0] = m->ambient[1] = m->ambient[2] = 0.2f;
        m->diffuse[0] = m->diffuse[1] = m->diffuse[2] = 0.8f;
        m->ambient[3] = m->diffuse[3] = m->specular[3] = m->emission[3] = 1.0f;
        m->indexes[1] = m->indexes[2] = 1.0f;
    }
    for (int i = 0; i < GL_LIGHTS; ++i) {
        gl_light *l = &s->lighting.light[i];
        l->ambient[3] = l->diffuse[3] = l->specular[3] = l->position[2] = l->attenuation[0] = 1.0f;
        l->spot[2] = -1.0f;
        l->cutoff = 180.0f;
        for (int k = 0; k < 3 && i == 0; ++k) {
            l->diffuse[k] = l->specular[k] = 1.0f;
        }
    }
    s->lighting.ambient[0] = s->lighting.ambient[1] = s->lighting.ambient[2] = 0.2f;
    s->lighting.ambient[3] = 1.0f;
    s->lighting.shade = GL_SMOOTH;
    s->lighting.tracks_face = GL_FRONT_AND_BACK;
    s->lighting.tracks = GL_AMBIENT_AND_DIFFUSE;
}

static void state_init_units(gl_context *c)
{
    for (int i = 0; i < GL_UNITS; ++i) {
        gl_unit *u = &c->s.texture.unit[i];
        u->mode = GL_MODULATE;
        for (int k = 0; k < 4; ++k) {
            u->coordinate[k].mode = GL_EYE_LINEAR;
        }
        u->coordinate[0].object[0] = u->coordinate[0].eye[0] = u->coordinate[1].object[1] = u->coordinate[1].eye[1] =
            1.0f;
        for (int k = 0; k < 2; ++k) {
            u->combine[k] = GL_MODULATE;
            u->source[k][0] = GL_TEXTURE;
            u->source[k][1] = GL_PREVIOUS;
            u->source[k][2] = GL_CONSTANT;
            u->operand[k][0] = u->operand[k][1] = k == 0 ? GL_SRC_COLOR : GL_SRC_ALPHA;
            u->operand[k][2] = GL_SRC_ALPHA;
            u->scale[k] = 1.0f;
        }
        for (int t = 0; t < TARGETS; ++t) {
            u->bound[t] = &c->default_texture[t];
        }
        c->s.current.v.tex[i][3] = c->s.current.raster_tex[i][3] = 1.0f;
    }
}

void gl_state_init(gl_context *c)
{
    gl_state *s = &c->s;
    static const float one[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    gl_matrices *stacks[2 + GL_UNITS] = {&c->modelview, &c->projection, &c->texture[0], &c->texture[1], &c->texture[2],
                                         &c->texture[3]};
    for (int i = 0; i < 2 + GL_UNITS; ++i) {
        memcpy(stacks[i]->m[0], one, sizeof one);
        stacks[i]->top = 0;
        stacks[i]->limit = i == 0 ? GL_STACK : i == 1 ? GL_STACK : 10;
    }
    for (int t = 0; t < TARGETS; ++t) {
        gl_texture_init(&c->default_texture[t], 0, t);
    }
    s->caps = (uint64_t)1 << CAP_DITHER | (uint64_t)1 << CAP_MULTISAMPLE;
    for (int i = 0; i < 4; ++i) {
        s->current.v.colour[i] = s->current.raster_colour[i] = s->pixel.scale[i] = 1.0f;
    }
    s->current.v.normal[2] = s->current.v.edge = s->current.raster[3] = s->current.raster_second[3] = 1.0f;
    s->current.raster_valid = 1;
    s->point.size = s->point.fade = s->point.attenuation[0] = s->line.width = 1.0f;
    s->point.max = 255.0f;
    s->point.origin = GL_UPPER_LEFT;
    s->line.factor = 1;
    s->line.pattern = 0xffff;
    s->polygon.front = s->polygon.back = GL_FILL;
    s->polygon.cull = GL_BACK;
    s->polygon.front_face = GL_CCW;
    memset(s->stipple.bits, 255, sizeof s->stipple.bits);
    s->pixel.depth_scale = s->pixel.zoom[0] = s->pixel.zoom[1] = 1.0f;
    s->pixel.read = s->colour.draw = GL_FRONT;
    state_init_lighting(s);
    s->fog.mode = GL_EXP;
    s->fog.source = GL_FRAGMENT_DEPTH;
    s->fog.density = s->fog.end = 1.0f;
    s->depth.func = GL_LESS;
    s->depth.mask = 1;
    s->depth.clear = s->viewport.range[1] = 1.0;
    s->stencil.func = GL_ALWAYS;
    s->stencil.fail = s->stencil.zfail = s->stencil.zpass = GL_KEEP;
    s->stencil.mask = s->stencil.write = 0xffffffffu;
    s->transform.mode = GL_MODELVIEW;
    s->colour.alpha_func = GL_ALWAYS;
    s->colour.blend[0] = s->colour.blend[2] = GL_ONE;
    s->colour.equation[0] = s->colour.equation[1] = GL_FUNC_ADD;
    s->colour.logic = GL_COPY;
    s->colour.mask = 15;
    for (int i = 0; i < 6; ++i) {
        s->hint.hint[i] = GL_DONT_CARE;
    }
    s->hint.poly = GL_DONT_CARE;
    s->eval.n1 = s->eval.n2[0] = s->eval.n2[1] = 1;
    s->eval.grid1[1] = s->eval.grid2[1] = s->eval.grid2[3] = 1.0f;
    s->sample.coverage = 1.0f;
    state_init_units(c);
    c->client.pack.align = c->client.unpack.align = 4;
    for (int i = 0; i < 10; ++i) {
        c->pixel_map_size[i] = 1;
    }
    gl_set_array(c);
    c->render_mode = GL_RENDER;
    c->matrices_dirty = c->dirty = 1;
}

/* --- calls that are not offered ---------------------------------------------------------------------------------- */

char *gl_missing_name(int slot);
char *gl_missing_name(int slot) { return gl_now != NULL && slot < GL_MISSING ? gl_now->missing[slot] : NULL; }

void gl_refuse(const char *name)
{
    if (gl_now != NULL) {
        gl_error(gl_now, GL_INVALID_OPERATION);
    }
    fprintf(stderr, "lambent: %s is not offered\n", name);
}
