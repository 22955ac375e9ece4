/* hostile.c: sequences of calls with hostile arguments: numbers, names, sizes, formats, unpack state. Pointers lead to
 * as much memory as OpenGL may read. Runs with libFuzzer (-DFUZZER), or as a program: hostile [SEEDS [FIRST]]. */
#include <GL/osmesa.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 48, CALLS = 120, BYTES = 1 << 22 };
static unsigned char window[SIDE * SIDE * 4];
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
    GL_COLOR_MATERIAL, GL_2D, GL_4D_COLOR_TEXTURE, GL_CULL_FACE, GL_NORMALIZE};

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

static void call_pixels(stream *s, uint32_t which)
{
    const GLint w = small(s), h = small(s);
    const GLenum format = word(s), type = word(s);
    switch (which % 9) {
    case 0: glTexImage1D(word(s), small(s), (GLint)word(s), w, small(s) % 2, format, type, memory); break;
    case 1: glTexImage2D(word(s), small(s), (GLint)word(s), w, h, small(s) % 2, format, type,
        next(s) % 4 ? memory : NULL); break;
    case 2: glTexImage3D(word(s), small(s), (GLint)word(s), w, h, small(s) % 8, small(s) % 2, format, type, memory);
        break;
    case 3: glTexSubImage2D(word(s), small(s), number(s), number(s), w, h, format, type, memory); break;
    case 4: glDrawPixels(w, h, format, type, memory); break;
    case 5: glReadPixels(number(s), number(s), w, h, format, type, memory + BYTES / 2); break;
    case 6: glBitmap(w, h, value(s), value(s), value(s), value(s), memory); break;
    case 7: glCopyTexImage2D(word(s), small(s), word(s), number(s), number(s), w, h, 0); break;
    default: glCopyPixels(number(s), number(s), w, h, word(s)); break;
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
    case 35: { GLdouble p[4] = {f[0], f[1], f[2], f[3]}; glClipPlane(word(s), p); break; }
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

static void call_shape(stream *s)
{
    glBegin(next(s) % 10);
    for (uint32_t n = next(s) % 12; n > 0; --n) {
        glColor4f(value(s), value(s), value(s), value(s));
        glTexCoord4f(value(s), value(s), value(s), value(s));
        glNormal3f(value(s), value(s), value(s));
        glVertex4f(value(s), value(s), value(s), next(s) % 4 ? 1.0f : value(s));
    }
    if (next(s) % 16) {
        glEnd();
    }
}

static void run(stream *s)
{
    OSMesaContext c = OSMesaCreateContextExt(GL_RGBA, 24, 8, 16, NULL);
    if (c == NULL || !OSMesaMakeCurrent(c, window, GL_UNSIGNED_BYTE, SIDE, SIDE)) {
        abort();
    }
    for (int i = 0; i < CALLS; ++i) {
        const uint32_t which = next(s);
        switch (which % 8) {
        case 0: call_pixels(s, which / 8); break;
        case 1: case 2: case 3: call_state(s, which / 8); break;
        case 4: call_objects(s, which / 8); break;
        default: call_shape(s); break;
        }
    }
    glEnd();
    glFinish();
    OSMesaDestroyContext(c);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes)
{
    stream s = {data, data + bytes, 1};
    memory = memory != NULL ? memory : calloc(1, BYTES);
    run(&s);
    return 0;
}

#ifndef FUZZER
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
