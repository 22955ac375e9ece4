/* alike.c: random draws by each back end and by the code for single pixels: the same bytes.
 *
 *   alike [ROUNDS [FIRST]]        each round draws by LAMBENT_GL_KERNELS=none, then by every other back end
 *   alike hash [ROUNDS [FIRST]]   prints a line a round, by the back end of the environment, to compare two libraries
 */
#define _POSIX_C_SOURCE 200112L
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "random.h"

enum { WIDTH = 136, HEIGHT = 90, SIDE = 64, BATCHES = 4, VERTICES = 24 };
static unsigned char pixels[HEIGHT][WIDTH][4];
static float depths[HEIGHT][WIDTH];

static void set_texture(int u)
{
    static const GLenum wraps[5] = {GL_REPEAT, GL_CLAMP, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_BORDER, GL_MIRRORED_REPEAT};
    static const GLenum formats[6] = {GL_RGBA, GL_RGB, GL_ALPHA, GL_LUMINANCE, GL_LUMINANCE_ALPHA, GL_INTENSITY};
    static const GLenum modes[6] = {GL_MODULATE, GL_REPLACE, GL_DECAL, GL_BLEND, GL_ADD, GL_COMBINE};
    static const GLenum filters[6] = {GL_NEAREST, GL_LINEAR, GL_NEAREST_MIPMAP_NEAREST, GL_LINEAR_MIPMAP_NEAREST,
                                      GL_NEAREST_MIPMAP_LINEAR, GL_LINEAR_MIPMAP_LINEAR};
    static const GLenum targets[3] = {GL_TEXTURE_2D, GL_TEXTURE_1D, GL_TEXTURE_3D};
    static unsigned char texels[SIDE * SIDE * 4];
    const GLenum target = targets[any(10) == 0 ? 1 + any(2) : 0];
    const int wide = 1 << any(7), high = 1 << any(7), border = any(12) == 0;
    const GLenum format = formats[any(3) == 0 ? any(6) : 0];
    float colour[4], matrix[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    for (int i = 0; i < (int)sizeof texels; ++i) {
        texels[i] = (unsigned char)any(256);
    }
    for (int i = 0; i < 4; ++i) {
        colour[i] = unit();
    }
    glActiveTexture((GLenum)(GL_TEXTURE0 + u));
    glTexParameteri(target, GL_GENERATE_MIPMAP, 1);
    glTexParameterfv(target, GL_TEXTURE_BORDER_COLOR, colour);
    glTexParameteri(target, GL_TEXTURE_MIN_FILTER, (GLint)filters[any(2) ? any(2) : any(6)]);
    glTexParameteri(target, GL_TEXTURE_MAG_FILTER, (GLint)filters[any(2)]);
    glTexParameteri(target, GL_TEXTURE_WRAP_S, (GLint)wraps[any(2) ? 0 : any(5)]);
    glTexParameteri(target, GL_TEXTURE_WRAP_T, (GLint)wraps[any(2) ? 0 : any(5)]);
    if (any(6) == 0) {
        glTexParameterf(target, GL_TEXTURE_LOD_BIAS, between(-2, 2));
        glTexParameterf(target, GL_TEXTURE_MIN_LOD, between(-1, 2));
        glTexParameteri(target, GL_TEXTURE_MAX_LEVEL, 1 + (GLint)any(5));
    }
    if (target == GL_TEXTURE_1D) {
        glTexImage1D(target, 0, (GLint)format, wide, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
    } else if (target == GL_TEXTURE_3D) {
        glTexImage3D(target, 0, (GLint)format, 8, 8, 8, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
    } else {
        glTexImage2D(target, 0, (GLint)format, border ? 34 : wide, border ? 34 : high, border, GL_RGBA,
                     GL_UNSIGNED_BYTE, texels);
    }
    const GLenum mode = modes[any(2) ? any(2) : any(6)];
    glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, (GLint)mode);
    if (mode == GL_COMBINE) {
        set_combine();
    }
    glTexEnvfv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, colour);
    if (any(8) == 0) { /* a q that varies */
        matrix[3] = between(-0.5f, 0.5f);
        matrix[7] = between(-0.5f, 0.5f);
        glMatrixMode(GL_TEXTURE);
        glLoadMatrixf(matrix);
        glMatrixMode(GL_MODELVIEW);
    }
    if (any(8) == 0) {
        glTexGeni(GL_S, GL_TEXTURE_GEN_MODE, GL_EYE_LINEAR);
        glEnable(GL_TEXTURE_GEN_S);
    }
    glEnable(target);
    glActiveTexture(GL_TEXTURE0);
}

static void set_state(void)
{
    static const GLenum factors[8] = {GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ZERO, GL_DST_COLOR, GL_SRC_COLOR,
                                      GL_DST_ALPHA, GL_ONE_MINUS_DST_COLOR};
    static const GLenum fogs[3] = {GL_LINEAR, GL_EXP, GL_EXP2};
    static const GLenum ops[8] = {GL_KEEP, GL_ZERO, GL_REPLACE, GL_INCR, GL_DECR, GL_INVERT, GL_INCR_WRAP,
                                  GL_DECR_WRAP};
    static unsigned char stipple[128];
    const float grey[4] = {unit(), unit(), unit(), 1}, at[4] = {2, 3, 4, 1};
    const int units = any(4) == 0 ? 0 : any(4) == 0 ? 2 : 1;
    for (int u = 0; u < units; ++u) {
        set_texture(u);
    }
    if (any(3)) {
        glEnable(GL_FOG);
    }
    glFogi(GL_FOG_MODE, (GLint)fogs[any(3)]);
    glFogfv(GL_FOG_COLOR, grey);
    glFogf(GL_FOG_START, any(8) ? between(0, 4) : 6);
    glFogf(GL_FOG_END, any(8) ? between(4, 9) : 6);
    glFogf(GL_FOG_DENSITY, between(0.01f, 0.5f));
    glFogi(GL_FOG_COORDINATE_SOURCE, any(5) ? GL_FRAGMENT_DEPTH : GL_FOG_COORDINATE);
    glShadeModel(any(5) ? GL_SMOOTH : GL_FLAT);
    enable(GL_BLEND, 3);
    const int is_over = any(2) == 0;
    glBlendFunc(is_over ? GL_SRC_ALPHA : factors[any(8)], is_over ? factors[1 + any(2)] : factors[any(4)]);
    if (any(4)) {
        glEnable(GL_DEPTH_TEST);
        glDepthFunc((GLenum)(any(2) ? GL_LESS : GL_NEVER + any(8)));
        glDepthMask(any(4) != 0);
    }
    enable(GL_STENCIL_TEST, 6);
    glStencilFunc((GLenum)(GL_NEVER + any(8)), (GLint)any(4), any(2) ? 255 : any(256));
    glStencilOp(ops[any(8)], ops[any(8)], ops[any(8)]);
    glStencilMask(any(2) ? 255 : any(256));
    enable(GL_ALPHA_TEST, 8);
    glAlphaFunc(GL_GREATER, 0.4f);
    enable(GL_COLOR_LOGIC_OP, 14);
    glLogicOp(GL_XOR);
    enable(GL_CULL_FACE, 8);
    enable(GL_SCISSOR_TEST, 5);
    glScissor(9, 7, 101, 55);
    enable(GL_POLYGON_OFFSET_FILL, 8);
    glPolygonOffset(1.5f, 2);
    for (int i = 0; i < (int)sizeof stipple; ++i) {
        stipple[i] = (unsigned char)any(256);
    }
    glPolygonStipple(stipple);
    enable(GL_POLYGON_STIPPLE, 16);
    enable(GL_LINE_STIPPLE, 8);
    glLineStipple(2, 0x6f5a);
    enable(GL_COLOR_SUM, 6);
    if (any(6) == 0) {
        glEnable(GL_LIGHTING);
        glEnable(GL_LIGHT0);
        glEnable(GL_COLOR_MATERIAL);
        glLightfv(GL_LIGHT0, GL_POSITION, at);
        glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, any(2) == 0);
        glLightModeli(GL_LIGHT_MODEL_COLOR_CONTROL, any(2) ? GL_SINGLE_COLOR : GL_SEPARATE_SPECULAR_COLOR);
    }
    if (any(8) == 0) {
        glColorMask(any(2) == 0, 1, any(2) == 0, any(2) == 0);
    }
    if (any(12) == 0) {
        glPolygonMode(GL_FRONT_AND_BACK, any(2) ? GL_LINE : GL_POINT);
    }
    glLineWidth((float)(1 + any(3)));
    glPointSize((float)(1 + any(12)));
}

static void draw_batch(void)
{
    const GLenum mode = any(3) ? GL_TRIANGLES : (GLenum)any(10);
    const float size = any(3) == 0 ? 0.1f : any(4) ? 1.0f : 6.0f;
    const int one = any(3) == 0;
    float colour[4] = {1, 1, 1, 1}, x = 0, y = 0, z = 0;
    glBegin(mode);
    for (int i = 0; i < VERTICES; ++i) {
        if (i % 3 == 0) {
            z = between(2, 9);
            x = between(-0.5f, 0.5f) * z;
            y = between(-0.4f, 0.4f) * z;
        }
        for (int k = 0; k < 4 && (i == 0 || !one); ++k) {
            colour[k] = any(2) ? unit() : 1;
        }
        glColor4fv(colour);
        glNormal3f(unit(), unit(), 1);
        glSecondaryColor3f(unit(), unit(), unit());
        glFogCoordf(between(0, 9));
        glMultiTexCoord2f(GL_TEXTURE0, between(-2, 3), between(-2, 3));
        glMultiTexCoord2f(GL_TEXTURE1, between(-2, 3), between(-2, 3));
        glVertex3f(x + between(-size, size), y + between(-size, size), -z - (any(3) ? between(-size, size) : 0));
    }
    glEnd();
}

/* Draws a round in a context of its own. Returns a hash of colours and depths; 0: an error. */
static uint64_t draw_round(uint32_t round)
{
    OSMesaContext context = OSMesaCreateContextExt(round % 3 == 0 ? OSMESA_BGRA : OSMESA_RGBA, 24, 8, 0, NULL);
    const int wide = round % 2 == 0 ? WIDTH : WIDTH - 5, high = round % 2 == 0 ? HEIGHT : HEIGHT - 1;
    uint64_t hash = 14695981039346656037u;
    memset(pixels, 0, sizeof pixels);
    if (context == NULL || !OSMesaMakeCurrent(context, pixels, GL_UNSIGNED_BYTE, wide, high)) {
        return 0;
    }
    seed = round * 0x9e3779b97f4a7c15u + 1;
    glClearColor(0.2f, 0.5f, 0.7f, 0.4f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    for (int batch = 0; batch < BATCHES; ++batch) {
        glPushAttrib(GL_ALL_ATTRIB_BITS);
        glMatrixMode(GL_TEXTURE);
        glLoadIdentity();
        glMatrixMode(GL_PROJECTION);
        glLoadIdentity();
        if (any(5)) {
            glFrustum(-0.6, 0.6, -0.4, 0.4, 1, 12);
        } else {
            glOrtho(-3, 3, -2, 2, 1, 12);
        }
        glMatrixMode(GL_MODELVIEW);
        glLoadIdentity();
        set_state();
        draw_batch();
        glPopAttrib();
    }
    memset(depths, 0, sizeof depths);
    glReadPixels(0, 0, wide, high, GL_DEPTH_COMPONENT, GL_FLOAT, depths);
    glFinish();
    const int good = glGetError() == GL_NO_ERROR;
    hash = hash_picture(hash, &pixels[0][0][0], sizeof pixels, &depths[0][0], sizeof depths / sizeof depths[0][0]);
    OSMesaDestroyContext(context);
    return good ? hash : 0;
}

int main(int argc, char **argv)
{
    static const char *const kernels[6] = {"avx512", "avx2", "sse2", "neon", "simd128", "scalar"};
    const int prints = argc > 1 && strcmp(argv[1], "hash") == 0;
    const uint32_t rounds = argc > 1 + prints ? (uint32_t)atoi(argv[1 + prints]) : 200,
                   first = argc > 2 + prints ? (uint32_t)atoi(argv[2 + prints]) : 0;
    int wrong = 0;
    for (uint32_t r = first; r < first + rounds; ++r) {
        if (prints) {
            const uint64_t hash = draw_round(r);
            printf("%u %08lx%08lx\n", (unsigned)r, (unsigned long)(hash >> 32), (unsigned long)(hash & 0xffffffffu));
            continue;
        }
        setenv("LAMBENT_GL_KERNELS", "none", 1);
        const uint64_t want = draw_round(r);
        wrong += want == 0;
        for (int k = 0; k < 6; ++k) {
            setenv("LAMBENT_GL_KERNELS", kernels[k], 1); /* one that is not here draws as "none" does */
            if (draw_round(r) != want && wrong++ < 10) {
                fprintf(stderr, "alike: round %u by %s\n", (unsigned)r, kernels[k]);
            }
        }
    }
    return wrong > 0;
}
