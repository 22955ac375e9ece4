/* main_gl.c: sequences of OpenGL calls with hostile arguments: numbers, names, sizes, formats, pixel store. A pointer
 * leads to exactly the bytes that OpenGL may read or write, and ends where the block ends. After each call glGetError
 * gives a known error, and then none.
 *
 * The target gl of `make fuzz`, where FUZZER is defined, and a program of `make gl-check`: hostile [SEEDS [FIRST]]. */
#include <GL/osmesa.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fuzz.h"

enum { SIDE = 48, CALLS = 120, BYTES = 1 << 20 };
static unsigned char *memory; /* BYTES bytes; pointers lead here */

typedef struct stream {
    const uint8_t *at, *end;
    uint64_t state;
} stream;

static uint32_t next(stream *s)
{
    uint32_t v = 0;
    if (s->at + 4 <= s->end) {
        memcpy(&v, s->at, 4);
        s->at += 4;
        return v;
    }
    s->state = s->state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(s->state >> 33);
}

static const GLenum words[] = {
    0, 1, 2, 3, 4, 5, 6, 7, 8, 9, GL_NEVER, GL_LESS, GL_EQUAL, GL_GEQUAL, GL_ALWAYS, GL_SRC_ALPHA, GL_DST_COLOR,
    GL_CONSTANT_ALPHA, GL_FRONT, GL_BACK, GL_FRONT_AND_BACK, GL_CW, GL_CCW, GL_BLEND, GL_DEPTH_TEST,
    GL_STENCIL_TEST, GL_FOG, GL_LIGHTING, GL_LIGHT0, GL_LIGHT3, GL_TEXTURE_1D, GL_TEXTURE_2D, GL_TEXTURE_3D,
    GL_TEXTURE_CUBE_MAP, GL_TEXTURE_CUBE_MAP_POSITIVE_X, GL_TEXTURE_CUBE_MAP_NEGATIVE_Z, GL_PROXY_TEXTURE_2D,
    GL_TEXTURE_GEN_S, GL_TEXTURE_GEN_Q, GL_ALPHA, GL_RGB, GL_RGBA, GL_BGRA, GL_LUMINANCE, GL_LUMINANCE_ALPHA,
    GL_INTENSITY, GL_DEPTH_COMPONENT, GL_STENCIL_INDEX, GL_COLOR_INDEX, GL_UNSIGNED_BYTE, GL_BYTE, GL_SHORT,
    GL_UNSIGNED_SHORT, GL_INT, GL_UNSIGNED_INT, GL_FLOAT, GL_DOUBLE, GL_BITMAP, GL_UNSIGNED_SHORT_5_6_5,
    GL_UNSIGNED_INT_8_8_8_8_REV, GL_NEAREST, GL_LINEAR, GL_LINEAR_MIPMAP_LINEAR, GL_CLAMP, GL_REPEAT,
    GL_CLAMP_TO_BORDER, GL_MIRRORED_REPEAT, GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER, GL_TEXTURE_WRAP_S,
    GL_TEXTURE_WRAP_T, GL_TEXTURE_BASE_LEVEL, GL_TEXTURE_MAX_LEVEL, GL_GENERATE_MIPMAP, GL_TEXTURE_ENV,
    GL_TEXTURE_ENV_MODE, GL_MODULATE, GL_DECAL, GL_REPLACE, GL_ADD, GL_COMBINE, GL_COMBINE_RGB, GL_SRC0_RGB,
    GL_OPERAND2_ALPHA, GL_DOT3_RGBA, GL_TEXTURE1, GL_TEXTURE3, GL_S, GL_Q, GL_SPHERE_MAP, GL_EYE_LINEAR,
    GL_MODELVIEW, GL_PROJECTION, GL_TEXTURE, GL_POINT, GL_LINE, GL_FILL, GL_POLYGON_STIPPLE, GL_LINE_STIPPLE,
    GL_SCISSOR_TEST, GL_ALPHA_TEST, GL_CLIP_PLANE0, GL_CLIP_PLANE5, GL_RENDER, GL_SELECT, GL_FEEDBACK, GL_COMPILE,
    GL_COMPILE_AND_EXECUTE, GL_ACCUM, GL_LOAD, GL_RETURN, GL_COLOR, GL_DEPTH, GL_STENCIL, GL_VERTEX_ARRAY,
    GL_COLOR_ARRAY, GL_TEXTURE_COORD_ARRAY, GL_ARRAY_BUFFER, GL_ELEMENT_ARRAY_BUFFER, GL_STATIC_DRAW,
    GL_SAMPLES_PASSED, GL_FRAMEBUFFER_EXT, GL_RENDERBUFFER_EXT, GL_COLOR_ATTACHMENT0_EXT, GL_DEPTH_ATTACHMENT_EXT,
    GL_DEPTH24_STENCIL8_EXT, GL_MAP1_VERTEX_3, GL_MAP2_VERTEX_4, GL_AUTO_NORMAL, GL_UNPACK_ROW_LENGTH,
    GL_UNPACK_SKIP_ROWS, GL_UNPACK_ALIGNMENT, GL_UNPACK_SWAP_BYTES, GL_PACK_ALIGNMENT, GL_PIXEL_MAP_I_TO_R,
    GL_MAP_COLOR, GL_RED_SCALE, GL_POSITION, GL_SPOT_CUTOFF, GL_AMBIENT, GL_SHININESS, GL_LIGHT_MODEL_TWO_SIDE,
    GL_COLOR_MATERIAL, GL_2D, GL_4D_COLOR_TEXTURE, GL_CULL_FACE, GL_NORMALIZE, GL_BOUNCED_LIGHT_LMB};

static GLenum word(stream *s)
{
    return next(s) % 32 == 0 ? next(s) : words[next(s) % (sizeof words / sizeof words[0])];
}
static GLint small(stream *s) { return (GLint)(next(s) % 40) - 3; }
static GLint number(stream *s)
{
    static const GLint odd[] = {0, 1, -1, 2147483647, -2147483647 - 1, 65536, 8192, 4097, 255};
    return next(s) % 8 == 0 ? odd[next(s) % 9] : small(s);
}
static float value(stream *s)
{
    static const float odd[] = {0.0f, -0.0f, 1e38f, -1e38f, 1e-38f, 1e9f, 0.5f, 255.0f};
    const uint32_t v = next(s), bits = next(s);
    float f;
    memcpy(&f, &bits, sizeof f);
    return v % 16 == 0 ? f : v % 8 == 0 ? odd[v / 8 % 8] : (float)(int)(v % 2001) / 250.0f - 4.0f;
}

/* --- the bytes of an image, by the specification ------------------------------------------------------------------- */

static size_t format_values(GLenum f)
{
    switch (f) {
    case GL_RGB: case GL_BGR: return 3;
    case GL_RGBA: case GL_BGRA: case GL_ABGR_EXT: return 4;
    case GL_LUMINANCE_ALPHA: case GL_DEPTH_STENCIL: return 2;
    default: return 1;
    }
}

/* Bytes of a value, or of a whole pixel: then *packed is 1. */
static size_t type_bytes(GLenum t, int *packed)
{
    *packed = (t >= GL_UNSIGNED_BYTE_3_3_2 && t <= GL_UNSIGNED_INT_10_10_10_2) ||
              (t >= GL_UNSIGNED_BYTE_2_3_3_REV && t <= GL_UNSIGNED_INT_2_10_10_10_REV) || t == GL_UNSIGNED_INT_24_8;
    switch (t) {
    case GL_UNSIGNED_BYTE: case GL_BYTE: case GL_UNSIGNED_BYTE_3_3_2: case GL_UNSIGNED_BYTE_2_3_3_REV: return 1;
    case GL_UNSIGNED_SHORT: case GL_SHORT: case GL_UNSIGNED_SHORT_4_4_4_4: case GL_UNSIGNED_SHORT_5_5_5_1:
    case GL_UNSIGNED_SHORT_5_6_5: case GL_UNSIGNED_SHORT_5_6_5_REV: case GL_UNSIGNED_SHORT_4_4_4_4_REV:
    case GL_UNSIGNED_SHORT_1_5_5_5_REV:
        return 2;
    default: return 4;
    }
}

/* A place with exactly the bytes of an image up to the end of the memory; NULL: too large for it. Other formats and
 * types are errors, so no byte is read. pack: 0 as glTexImage reads, 1 as glReadPixels writes. */
static unsigned char *exact(int pack, int dims, GLint w, GLint h, GLint d, GLenum format, GLenum type)
{
    static const GLenum names[2][6] = {
        {GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS, GL_UNPACK_ALIGNMENT, GL_UNPACK_IMAGE_HEIGHT,
         GL_UNPACK_SKIP_IMAGES},
        {GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS, GL_PACK_ALIGNMENT, GL_PACK_IMAGE_HEIGHT,
         GL_PACK_SKIP_IMAGES}};
    GLint v[6] = {0, 0, 0, 1, 0, 0};
    int packed;
    for (int i = 0; i < 6; ++i) {
        glGetIntegerv(names[pack][i], &v[i]);
    }
    const size_t value = type_bytes(type, &packed), group = value * (packed ? 1 : format_values(format));
    const size_t wide = (size_t)(v[0] > 0 ? v[0] : w), align = (size_t)v[3];
    if (w <= 0 || h <= 0 || d <= 0) {
        return memory + BYTES;
    }
    size_t row = value >= align ? wide * group : (wide * group + align - 1) / align * align;
    size_t last = ((size_t)v[2] + (size_t)w) * group;
    if (type == GL_BITMAP) {
        row = align * ((wide + 8 * align - 1) / (8 * align));
        last = ((size_t)v[2] + (size_t)w + 7) / 8;
    }
    const size_t image = row * (size_t)(v[4] > 0 ? v[4] : h);
    const size_t bytes = (dims == 3 ? ((size_t)v[5] + (size_t)d - 1) * image : 0) +
                         ((size_t)v[1] + (size_t)h - 1) * row + last;
    return bytes <= BYTES ? memory + BYTES - bytes : NULL;
}

static void read_texture(stream *s)
{
    const GLenum target = word(s), format = word(s), type = word(s);
    const GLint level = number(s);
    GLint size[3] = {0, 0, 0};
    glGetTexLevelParameteriv(target, level, GL_TEXTURE_WIDTH, &size[0]);
    glGetTexLevelParameteriv(target, level, GL_TEXTURE_HEIGHT, &size[1]);
    glGetTexLevelParameteriv(target, level, GL_TEXTURE_DEPTH, &size[2]);
    unsigned char *to = exact(1, size[2] > 1 || target == GL_TEXTURE_3D ? 3 : 2, size[0], size[1], size[2], format, type);
    if (to != NULL) {
        glGetTexImage(target, level, format, type, to);
    }
}

static void call_pixels(stream *s, uint32_t which)
{
    const GLint w = small(s), h = small(s), d = small(s) % 8;
    const GLenum format = word(s), type = which % 12 == 6 ? GL_BITMAP : word(s);
    const int pack = which % 12 == 5, dims = which % 12 == 0 ? 1 : which % 12 == 2 || which % 12 == 10 ? 3 : 2;
    unsigned char *at = exact(pack, dims, w, dims > 1 ? h : 1, dims > 2 ? d : 1,
                              which % 12 == 6 ? GL_COLOR_INDEX : format, type);
    if (at == NULL) {
        return;
    }
    switch (which % 12) {
    case 0: glTexImage1D(word(s), small(s), (GLint)word(s), w, small(s) % 2, format, type, at); break;
    case 1: glTexImage2D(word(s), small(s), (GLint)word(s), w, h, small(s) % 2, format, type,
        next(s) % 4 ? at : NULL); break;
    case 2: glTexImage3D(word(s), small(s), (GLint)word(s), w, h, d, small(s) % 2, format, type, at);
        break;
    case 3: glTexSubImage2D(word(s), small(s), number(s), number(s), w, h, format, type, at); break;
    case 4: glDrawPixels(w, h, format, type, at); break;
    case 5: glReadPixels(number(s), number(s), w, h, format, type, at); break;
    case 6: glBitmap(w, h, value(s), value(s), value(s), value(s), at); break;
    case 7: glCopyTexImage2D(word(s), small(s), word(s), number(s), number(s), w, h, 0); break;
    case 8: glCopyPixels(number(s), number(s), w, h, word(s)); break;
    case 9: read_texture(s); break;
    case 10: glTexSubImage3D(word(s), small(s), number(s), number(s), number(s), w, h, d, format, type, at); break;
    default: glCopyTexSubImage2D(word(s), small(s), number(s), number(s), number(s), number(s), w, h); break;
    }
}

static void call_state(stream *s, uint32_t which)
{
    GLfloat f[16];
    for (int i = 0; i < 16; ++i) {
        f[i] = value(s);
    }
    switch (which % 40) {
    case 0: glEnable(word(s)); break;
    case 1: glDisable(word(s)); break;
    case 2: glBlendFunc(word(s), word(s)); break;
    case 3: glDepthFunc(word(s)); break;
    case 4: glStencilFunc(word(s), number(s), next(s)); break;
    case 5: glStencilOp(word(s), word(s), word(s)); break;
    case 6: glViewport(number(s), number(s), number(s), number(s)); break;
    case 7: glScissor(number(s), number(s), number(s), number(s)); break;
    case 8: glMatrixMode(word(s)); break;
    case 9: glLoadMatrixf(f); break;
    case 10: glMultMatrixf(f); break;
    case 11: glRotatef(f[0], f[1], f[2], f[3]); break;
    case 12: glPushMatrix(); break;
    case 13: glPopMatrix(); break;
    case 14: glPushAttrib(next(s)); break;
    case 15: glPopAttrib(); break;
    case 16: glLightfv(word(s), word(s), f); break;
    case 17: glMaterialfv(word(s), word(s), f); break;
    case 18: glTexParameterf(word(s), word(s), next(s) % 2 ? (float)word(s) : f[0]); break;
    case 19: glTexEnvf(word(s), word(s), (float)word(s)); break;
    case 20: glTexGenfv(word(s), word(s), f); break;
    case 21: glBindTexture(word(s), next(s) % 6); break;
    case 22: glActiveTexture(word(s)); break;
    case 23: glPolygonMode(word(s), word(s)); break;
    case 24: glLineStipple(number(s), (GLushort)next(s)); break;
    case 25: glLineWidth(f[0]); glPointSize(f[1]); break;
    case 26: glPixelZoom(f[0], f[1]); break;
    case 27: glPixelTransferf(word(s), f[0]); break;
    case 28: glPixelStorei(word(s), small(s)); break;
    case 29: glFogf(word(s), f[0]); break;
    case 30: glDepthRange((double)f[0], (double)f[1]); glPolygonOffset(f[2], f[3]); break;
    case 31: glRasterPos4f(f[0], f[1], f[2], f[3]); break;
    case 32:
        glClear(next(s) % 3 ? GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT | GL_ACCUM_BUFFER_BIT
                            : next(s));
        break;
    case 33: glAccum(word(s), f[0]); break;
    case 34: glFrustum((double)f[0], (double)f[1], (double)f[2], (double)f[3], (double)f[4], (double)f[5]); break;
    case 35: { GLdouble p[4] = {(double)f[0], (double)f[1], (double)f[2], (double)f[3]}; glClipPlane(word(s), p); break; }
    case 36: glShadeModel(word(s)); glFrontFace(word(s)); glCullFace(word(s)); break;
    case 37: glLogicOp(word(s)); glAlphaFunc(word(s), f[0]); break;
    case 38: glLightModelf(word(s), f[0]); break;
    default: { GLint out[16]; glGetIntegerv(word(s), (GLint *)(void *)memory);
        glGetTexLevelParameteriv(word(s), number(s), word(s), out); break; }
    }
}

static void call_objects(stream *s, uint32_t which)
{
    GLuint name = next(s) % 6;
    switch (which % 20) {
    case 0: glNewList(name, word(s)); break;
    case 1: case 2: glEndList(); break;
    case 3: glCallList(name); break;
    case 4: glDeleteLists(name, small(s)); break;
    case 5: glDeleteTextures(1, &name); break;
    case 6: glBindBuffer(word(s), name); break;
    case 7: glBufferData(word(s), small(s) * 16, memory, GL_STATIC_DRAW); break;
    case 8: glDeleteBuffers(1, &name); break;
    case 9: { GLint b = 0; glGetIntegerv(GL_ARRAY_BUFFER_BINDING, &b);
              glVertexPointer(small(s) % 5, word(s), small(s),
                  b ? (const void *)(uintptr_t)(unsigned)number(s) : (const void *)memory); break; }
    case 10: glEnableClientState(word(s)); break;
    case 11: glDrawArrays(word(s), (GLint)(next(s) % 64), small(s)); break;
    case 12: { GLint b = 0; glGetIntegerv(GL_ELEMENT_ARRAY_BUFFER_BINDING, &b); memset(memory, 3, 256);
               glDrawElements(word(s), small(s), GL_UNSIGNED_BYTE,
                   b ? (const void *)(uintptr_t)(unsigned)number(s) : (const void *)memory); break; }
    case 13: glBindFramebufferEXT(word(s), name % 3); break;
    case 14: glFramebufferTexture2DEXT(word(s), word(s), word(s), name, small(s)); break;
    case 15: glBindRenderbufferEXT(word(s), name);
        glRenderbufferStorageEXT(GL_RENDERBUFFER_EXT, word(s), small(s), small(s)); break;
    case 16: glFramebufferRenderbufferEXT(word(s), word(s), word(s), name); break;
    case 17: glBeginQuery(GL_SAMPLES_PASSED, name); break;
    case 18: glEndQuery(GL_SAMPLES_PASSED); glDeleteQueries(1, &name); break;
    default: { GLuint buffer[4]; (void)buffer; glSelectBuffer(64, (GLuint *)(void *)(memory + BYTES / 2));
        glFeedbackBuffer(64, word(s), (GLfloat *)(void *)(memory + BYTES / 2)); glRenderMode(word(s)); break; }
    }
}

/* Maps, pixel maps, stipples, arrays and queries of state. */
static void call_more(stream *s, uint32_t which)
{
    GLfloat f[16];
    for (int i = 0; i < 16; ++i) {
        f[i] = value(s);
    }
    switch (which % 16) {
    case 0: {
        static GLfloat points[4 * 36];
        points[next(s) % 144] = value(s);
        glMap1f(word(s), f[0], f[1], small(s) % 5, small(s) % 37, points);
        break;
    }
    case 1: {
        static GLfloat points[4 * 36];
        points[next(s) % 144] = value(s);
        glMap2f(word(s), f[0], f[1], 4, small(s) % 7, f[2], f[3], 24, small(s) % 7, points);
        break;
    }
    case 2: glMapGrid1f(number(s) % 100, f[0], f[1]); glMapGrid2f(small(s), f[0], f[1], small(s), f[2], f[3]); break;
    case 3: glEvalMesh1(word(s), small(s), small(s)); glEvalMesh2(word(s), small(s), small(s), small(s), small(s)); break;
    case 4: {
        const GLint n = small(s);
        glPixelMapfv(word(s), n, (const GLfloat *)(void *)(memory + BYTES) - (n > 0 ? n : 0));
        break;
    }
    case 5: {
        unsigned char *at = exact(0, 2, 32, 32, 1, GL_COLOR_INDEX, GL_BITMAP);
        if (at != NULL) glPolygonStipple(at);
        break;
    }
    case 6: {
        const GLint count = small(s) % 16;
        static const GLuint names[16];
        glListBase(next(s) % 6);
        glCallLists(count, word(s), names);
        break;
    }
    case 7: glBufferSubData(word(s), number(s), number(s) % 640, memory); break;
    case 8: {
        unsigned char *p = glMapBuffer(word(s), word(s));
        if (p != NULL) p[0] = (unsigned char)next(s);
        if (next(s) % 4) glUnmapBuffer(word(s));
        break;
    }
    case 9: glInterleavedArrays(GL_V2F + next(s) % 15, number(s) % 64, memory); break;
    case 10: glArrayElement((GLint)(next(s) % 64)); break;
    case 11: glBlitFramebufferEXT(number(s), number(s), number(s), number(s), number(s), number(s), number(s),
                                  number(s), next(s), word(s)); break;
    case 12: glGetFloatv(word(s), f); glGetLightfv(word(s), word(s), f); glGetMaterialfv(word(s), word(s), f); break;
    case 13: glGetTexEnvfv(word(s), word(s), f); glGetTexGenfv(word(s), word(s), f); break;
    case 14: glGetTexParameterfv(word(s), word(s), f); glGenerateMipmapEXT(word(s)); break;
    default: {
        GLint first[2] = {(GLint)(next(s) % 64), 0}, count[2] = {small(s), small(s)};
        glMultiDrawArrays(word(s), first, count, 2);
        break;
    }
    }
}

static void call_shape(stream *s)
{
    glBegin(next(s) % 10);
    for (uint32_t n = next(s) % 12; n > 0; --n) {
        const uint32_t changes = next(s);
        if (changes & 1) glColor4f(value(s), value(s), value(s), value(s));
        if (changes & 2) glTexCoord4f(value(s), value(s), value(s), value(s));
        if (changes & 4) glNormal3f(value(s), value(s), value(s));
        if ((changes & 56) == 0) glMaterialf(word(s), word(s), value(s));
        if ((changes & 448) == 0) glEvalCoord2f(value(s), value(s));
        glVertex4f(value(s), value(s), value(s), next(s) % 4 ? 1.0f : value(s));
    }
    if (next(s) % 16) {
        glEnd();
    }
}

static void require(int holds, const char *what)
{
    if (!holds) {
        fprintf(stderr, "does not hold: %s\n", what);
        abort();
    }
}

/* Two frames with bounced light, of a list with any shape. */
static void call_bounced(stream *s)
{
    const GLuint name = next(s) % 6 + 1;
    glEnable(GL_BOUNCED_LIGHT_LMB);
    glEnable(GL_LIGHTING);
    glEnable(GL_LIGHT0 + next(s) % 8);
    glNewList(name, GL_COMPILE);
    call_shape(s);
    glEndList();
    for (int i = 0; i < 2; ++i) {
        glClear(next(s) % 8 ? GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT : word(s));
        call_state(s, next(s));
        glCallList(name);
        if (next(s) % 4 == 0) {
            glDeleteLists(name, 1);
        }
    }
}

static void call_any(stream *s)
{
    const uint32_t which = next(s);
    switch (which % 9) {
    case 0: call_pixels(s, which / 9); break;
    case 1: case 2: case 3: call_state(s, which / 9); break;
    case 4: call_objects(s, which / 9); break;
    case 5: call_more(s, which / 9); break;
    case 6:
        if (which / 9 % 8 == 0) {
            call_bounced(s);
            break;
        }
        call_shape(s);
        break;
    default: call_shape(s); break;
    }
    const GLenum error = glGetError();
    require(error <= GL_INVALID_FRAMEBUFFER_OPERATION_EXT &&
                (error == GL_NO_ERROR || error >= GL_INVALID_ENUM), "a known error");
    /* between glBegin and glEnd glGetError itself is an error, and gives 0 */
    require(glGetError() == GL_NO_ERROR, "the error is gone");
}

/* A window of a block of its own; NULL: no such context. */
static OSMesaContext begin_window(stream *s, OSMesaContext shared, unsigned char **pixels)
{
    static const GLenum formats[] = {OSMESA_RGBA, OSMESA_BGRA, OSMESA_ARGB, OSMESA_RGB, OSMESA_BGR, OSMESA_RGB_565};
    static const size_t bytes[] = {4, 4, 4, 3, 3, 2};
    const uint32_t k = next(s) % 4 ? 0 : next(s) % 6;
    const GLsizei w = (GLsizei)(next(s) % SIDE) + 1, h = (GLsizei)(next(s) % SIDE) + 1;
    OSMesaContext c = OSMesaCreateContextExt(formats[k], next(s) % 4 ? 24 : 0, next(s) % 4 ? 8 : 0,
                                             next(s) % 4 ? 0 : 16, shared);
    *pixels = calloc(bytes[k] * (size_t)w, (size_t)h);
    require(c != NULL && *pixels != NULL, "memory");
    require(OSMesaMakeCurrent(c, *pixels, k == 5 ? GL_UNSIGNED_SHORT_5_6_5 : GL_UNSIGNED_BYTE, w, h), "a window");
    return c;
}

static void run(stream *s)
{
    unsigned char *pixels, *more = NULL;
    OSMesaContext c = begin_window(s, NULL, &pixels), other = NULL;
    for (int i = 0; i < CALLS; ++i) {
        call_any(s);
    }
    if (next(s) % 4 == 0) { /* a second context uses the objects after the first one's end */
        other = begin_window(s, c, &more);
        for (int i = 0; i < CALLS / 4; ++i) {
            call_any(s);
        }
        OSMesaDestroyContext(c);
        c = other;
        for (int i = 0; i < CALLS / 4; ++i) {
            call_any(s);
        }
    }
    glEnd();
    glFinish();
    OSMesaDestroyContext(c); /* while current */
    call_any(s);
    OSMesaMakeCurrent(NULL, NULL, GL_UNSIGNED_BYTE, 0, 0);
    call_any(s);
    free(pixels);
    free(more);
}

#ifdef FUZZER
void fuzz_gl(const uint8_t *data, size_t size)
{
    stream s = {data, data + size, 1};
    memory = memory != NULL ? memory : calloc(1, BYTES);
    require(memory != NULL, "memory");
    s.state = next(&s); /* of the calls after the end of the data */
    run(&s);
}
#else
int main(int argc, char **argv)
{
    const long seeds = argc > 1 ? atol(argv[1]) : 300, first = argc > 2 ? atol(argv[2]) : 0;
    memory = calloc(1, BYTES);
    for (long i = first; i < first + seeds && memory != NULL; ++i) {
        stream s = {NULL, NULL, (uint64_t)i * 977u + 1u};
        if (getenv("VERBOSE") != NULL) {
            fprintf(stderr, "seed %ld\n", i);
        }
        run(&s);
    }
    return memory == NULL;
}
#endif
