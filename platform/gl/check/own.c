/* own.c: our own pictures by OpenGL 1.x, and their hashes: one line each. The same on every machine.
 *
 * Also checks return values of glGetError, destruction of current contexts, and calls out of order. */
#include <GL/osmesa.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 96, HEIGHT = 64 };
static unsigned char pixels[HEIGHT][WIDTH][4];
static int wrong;

static void expect(GLenum error, const char *what)
{
    const GLenum was = glGetError();
    if (was != error) {
        fprintf(stderr, "own: %s: error 0x%x, not 0x%x\n", what, was, error);
        wrong = 1;
    }
}

static void finish(const char *name)
{
    uint64_t hash = 14695981039346656037u;
    glFinish();
    expect(GL_NO_ERROR, name);
    for (size_t i = 0; i < sizeof pixels; ++i) {
        hash = (hash ^ ((const unsigned char *)pixels)[i]) * 1099511628211u;
    }
    printf("%-10s %08lx%08lx\n", name, (unsigned long)(hash >> 32), (unsigned long)(hash & 0xffffffffu));
}

static void look(void)
{
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glFrustum(-0.6, 0.6, -0.4, 0.4, 1, 20);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glTranslatef(0, 0, -5);
    glRotatef(30, 1, 0, 0);
    glRotatef(40, 0, 1, 0);
}

static void box(void)
{
    static const float normal[6][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (int f = 0; f < 6; ++f) {
        const float *n = normal[f];
        const float s[3] = {n[1], n[2], n[0]}, t[3] = {n[2], n[0], n[1]};
        const float turn = n[0] + n[1] + n[2];
        glNormal3fv(n);
        glBegin(GL_QUADS);
        for (int k = 0; k < 4; ++k) {
            const float u = k == 1 || k == 2 ? 1.0f : -1.0f, v = (k >= 2 ? 1.0f : -1.0f) * turn;
            glTexCoord2f(u, v);
            glVertex3f(n[0] + u * s[0] * turn + v * t[0] * turn, n[1] + u * s[1] * turn + v * t[1] * turn,
                n[2] + u * s[2] * turn + v * t[2] * turn);
        }
        glEnd();
    }
}

static void texture(GLenum min, GLenum mag)
{
    unsigned char texels[16][16][3];
    GLuint name;
    for (int i = 0; i < 16 * 16; ++i) {
        const int x = i % 16, y = i / 16;
        texels[y][x][0] = (unsigned char)(16 * x);
        texels[y][x][1] = (unsigned char)(16 * y);
        texels[y][x][2] = (unsigned char)((x ^ y) & 4 ? 220 : 40);
    }
    glGenTextures(1, &name);
    glBindTexture(GL_TEXTURE_2D, name);
    glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, 1);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, (GLint)min);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, (GLint)mag);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 16, 16, 0, GL_RGB, GL_UNSIGNED_BYTE, texels);
    glEnable(GL_TEXTURE_2D);
}

static void light(void)
{
    static const float at[4] = {2, 3, 4, 1}, highlight[4] = {0.7f, 0.7f, 0.7f, 1}, paint[4] = {0.8f, 0.3f, 0.2f, 1};
    glEnable(GL_LIGHTING);
    glEnable(GL_LIGHT0);
    glEnable(GL_NORMALIZE);
    glLightfv(GL_LIGHT0, GL_POSITION, at);
    glMaterialfv(GL_FRONT_AND_BACK, GL_SPECULAR, highlight);
    glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE, paint);
    glMaterialf(GL_FRONT_AND_BACK, GL_SHININESS, 24);
}

static void draw(int which)
{
    static const float fog[4] = {0.6f, 0.7f, 0.8f, 1};
    look();
    switch (which) {
    case 0: light(); box(); break;
    case 1: texture(GL_NEAREST, GL_NEAREST); box(); break;
    case 2: texture(GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR); glMatrixMode(GL_TEXTURE); glLoadIdentity();
        glScalef(5, 5, 1); box(); glLoadIdentity(); break;
    case 3: light(); glEnable(GL_FOG); glFogfv(GL_FOG_COLOR, fog); glFogi(GL_FOG_MODE, GL_EXP2);
        glFogf(GL_FOG_DENSITY, 0.2f); box(); break;
    case 4: glPolygonMode(GL_FRONT_AND_BACK, GL_LINE); glLineWidth(2); glEnable(GL_LINE_STIPPLE);
        glLineStipple(2, 0x6f5a); box(); break;
    case 5: light(); glShadeModel(GL_FLAT); glNewList(7, GL_COMPILE); box(); glEndList();
        glScalef(0.5f, 0.5f, 0.5f); glCallList(7); glTranslatef(1, 2, 0); glCallList(7); break;
    case 6: texture(GL_LINEAR, GL_LINEAR); glEnable(GL_TEXTURE_GEN_S); glEnable(GL_TEXTURE_GEN_T);
        glTexGeni(GL_S, GL_TEXTURE_GEN_MODE, GL_SPHERE_MAP); glTexGeni(GL_T, GL_TEXTURE_GEN_MODE, GL_SPHERE_MAP); box();
        break;
    default: glEnable(GL_BLEND); glBlendFunc(GL_SRC_ALPHA, GL_ONE); glDisable(GL_DEPTH_TEST);
        glColor4f(0.9f, 0.5f, 0.2f, 0.4f); glPointSize(5); glPolygonMode(GL_BACK, GL_POINT); box(); break;
    }
}

static void errors(void)
{
    glBegin(99);
    expect(GL_INVALID_ENUM, "glBegin(99)");
    glBegin(GL_LINES);
    glEnable(GL_FOG);
    glEnd();
    expect(GL_INVALID_OPERATION, "glEnable inside");
    glBegin(GL_LINES);
    glPolygonStipple(NULL);
    glPixelMapfv(GL_PIXEL_MAP_R_TO_R, 2, NULL);
    glMap1f(GL_MAP1_VERTEX_3, 0, 1, 3, 2, NULL);
    glMap2f(GL_MAP2_VERTEX_3, 0, 1, 3, 2, 0, 1, 6, 2, NULL);
    glEnd();
    expect(GL_INVALID_OPERATION, "glPolygonStipple inside reads no byte");
    glEnd();
    expect(GL_INVALID_OPERATION, "glEnd outside");
    glViewport(0, 0, -1, 1);
    expect(GL_INVALID_VALUE, "glViewport");
    glPopMatrix();
    glMatrixMode(GL_TEXTURE);
    for (int i = 0; i < 100; ++i) {
        glPopMatrix();
    }
    expect(GL_STACK_UNDERFLOW, "glPopMatrix");
    for (int i = 0; i < 100; ++i) {
        glPushMatrix();
    }
    expect(GL_STACK_OVERFLOW, "glPushMatrix");
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 1 << 20, 1, 0, GL_RGB, GL_UNSIGNED_BYTE, NULL);
    expect(GL_INVALID_VALUE, "glTexImage2D");
    glCallList(12345);
    expect(GL_NO_ERROR, "glCallList of no list");
}

static void check(int good, const char *what)
{
    if (!good) {
        fprintf(stderr, "own: %s\n", what);
        wrong = 1;
    }
}

/* Primitives of `each` vertices: all in one glBegin, or one in each. */
static void draw_many(GLenum mode, int each, int apart)
{
    unsigned seed = 1;
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glBegin(mode);
    for (int i = 0; i < 12000; ++i) {
        seed = seed * 1664525u + 1013904223u;
        const float x = (float)(i / each % 90) / 45 - 1, y = (float)(i / each / 90) / 67 - 1;
        glColor3ub((GLubyte)(seed >> 24), (GLubyte)(seed >> 16), (GLubyte)(i / each));
        glVertex3f(x + (float)(seed >> 8 & 255) / 5000, y + (float)(seed >> 16 & 255) / 5000, (float)(i % each) / 10);
        if (apart && i % each == each - 1) {
            glEnd();
            glFinish();
            glBegin(mode);
        }
    }
    glEnd();
    glFinish();
    expect(GL_NO_ERROR, "many vertices");
}

/* More vertices than wait at once draw as fewer do. */
static void many(void)
{
    static const GLenum modes[4] = {GL_POINTS, GL_LINES, GL_TRIANGLES, GL_QUADS};
    static unsigned char once[sizeof pixels];
    for (int i = 0; i < 4; ++i) {
        draw_many(modes[i], i + 1, 0);
        memcpy(once, pixels, sizeof once);
        draw_many(modes[i], i + 1, 1);
        check(memcmp(once, pixels, sizeof once) == 0, "many vertices in one glBegin");
    }
}

/* Errors of calls in lists are those of the list's run. */
static void list_errors(void)
{
    static const GLubyte bits[4] = {255};
    glNewList(9, GL_COMPILE_AND_EXECUTE);
    glBegin(GL_POINTS);
    glBitmap(1, 1, 0, 0, 0, 0, bits);
    glEnd();
    glEndList();
    expect(GL_INVALID_OPERATION, "glBitmap inside");
    glCallList(9);
    expect(GL_INVALID_OPERATION, "glBitmap inside, by a list");
    glNewList(9, GL_COMPILE);
    glDrawArrays(77, 0, 1);
    glEndList();
    expect(GL_NO_ERROR, "glDrawArrays(77), recorded");
    glCallList(9);
    expect(GL_INVALID_ENUM, "glDrawArrays(77), by a list");
}

/* Vertices with and without a w, and coordinates of a texture, in runs longer than a record of a list. */
static void draw_mixed(void)
{
    unsigned seed = 3;
    glBegin(GL_TRIANGLES);
    for (int i = 0; i < 12000; ++i) {
        seed = seed * 1664525u + 1013904223u;
        const float x = (float)(seed >> 8 & 1023) / 512 - 1, y = (float)(seed >> 18 & 1023) / 512 - 1,
                    w = i / 30 % 7 == 3 ? 1.5f : 1;
        if (i % 6000 == 5001 || (i / 2000 == 1 && i % 3 == 0)) {
            glTexCoord2f(x, y);
            glColor3f(x, y, 1);
        }
        if (i > 11000 && i % 5 == 1) {
            glVertex2f(x, y);
        } else {
            glVertex4f(x * w, y * w, (float)(i % 100) / 100 * w, w);
        }
    }
    glEnd();
}

/* A list draws as its calls do. While a list is compiled again, its name stays in use, and only GL_COMPILE_AND_EXECUTE
 * can call the list of before. */
static void lists_again(void)
{
    static const unsigned char texels[4][4] = {{255, 9, 9, 255}, {9, 255, 9, 255}, {9, 9, 255, 255}, {99, 99, 99, 255}};
    static unsigned char once[sizeof pixels];
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 2, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glEnable(GL_TEXTURE_2D);
    for (int by_list = 0; by_list < 2; ++by_list) {
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glTexCoord4f(0, 0, 0, 2);
        glColor3f(1, 1, 1);
        if (by_list) {
            glNewList(10, GL_COMPILE);
        }
        draw_mixed();
        if (by_list) {
            glEndList();
            glCallList(10);
        }
        glFinish();
        if (by_list) {
            check(memcmp(once, pixels, sizeof once) == 0, "vertices of a list");
        }
        memcpy(once, pixels, sizeof once);
    }
    glDisable(GL_TEXTURE_2D);
    glNewList(10, GL_COMPILE);
    check(glIsList(10), "a list that is compiled again");
    glColor3f(0, 1, 0);
    glEndList();
    glNewList(10, GL_COMPILE_AND_EXECUTE);
    glColor3f(0, 0, 1);
    glCallList(10);
    glRectf(-1, -1, 1, 1);
    glEndList();
    glFinish();
    check(pixels[20][20][1] == 255, "the list of before, called by its successor");
    expect(GL_NO_ERROR, "lists again");
}

/* Depth and stencil in one pixel, copied into another place. */
static void depth_stencil(void)
{
    const GLuint code = 0x4000007bu;
    GLuint back = 0;
    GLfloat sum = 0;
    glClearColor(1, 1, 1, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    glWindowPos2i(3, 4);
    glDrawPixels(1, 1, GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8, &code);
    glBlitFramebufferEXT(3, 4, 4, 5, 10, 12, 9, 11, GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT, GL_NEAREST);
    glReadPixels(9, 11, 1, 1, GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8, &back);
    check(back == code, "a depth-stencil pixel");
    glReadPixels(0, 0, 1, 1, GL_LUMINANCE, GL_FLOAT, &sum);
    check(sum == 1, "white's luminance");
    expect(GL_NO_ERROR, "depth-stencil");
}

/* A texture with a side above the limit of lambent.h's textures: green in the last row. */
static void tall(void)
{
    enum { TALL = 12000 };
    static unsigned char texels[TALL][3];
    GLint max = 0;
    texels[TALL - 1][1] = 255;
    glDisable(GL_TEXTURE_GEN_S);
    glDisable(GL_TEXTURE_GEN_T);
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &max);
    check(max >= TALL, "GL_MAX_TEXTURE_SIZE");
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 1, TALL, 0, GL_RGB, GL_UNSIGNED_BYTE, texels);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
    glEnable(GL_TEXTURE_2D);
    glDisable(GL_DEPTH_TEST);
    glTexCoord2f(0.5f, (TALL - 0.5f) / TALL);
    glRectf(-1, -1, 1, 1);
    glFinish();
    check(pixels[20][20][1] == 255 && pixels[20][20][0] == 0, "a tall texture");
    static unsigned char back[TALL][3];
    for (int i = 0; i < TALL; ++i) {
        texels[i][0] = (unsigned char)(i / 47);
    }
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, TALL, 1, 0, GL_RGB, GL_UNSIGNED_BYTE, texels);
    glGetTexImage(GL_TEXTURE_2D, 0, GL_RGB, GL_UNSIGNED_BYTE, back);
    check(memcmp(back, texels, sizeof back) == 0, "glGetTexImage of a wide texture");
    glTexImage2D(GL_PROXY_TEXTURE_2D, 0, GL_RGBA, max, max, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
    glGetTexLevelParameteriv(GL_PROXY_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &max);
    check(max == 0, "a texture as large as the heap");
    expect(GL_NO_ERROR, "a tall texture");
}

int main(void)
{
    static const char *const names[8] = {"lights", "nearest", "mips", "fog", "stipple", "lists", "sphere", "points"};
    for (int i = 0; i < 8; ++i) {
        OSMesaContext c = OSMesaCreateContextExt(i % 2 ? OSMESA_RGBA : OSMESA_BGRA, 24, 8, 0, NULL);
        if (c == NULL || !OSMesaMakeCurrent(c, pixels, GL_UNSIGNED_BYTE, WIDTH, HEIGHT)) {
            return 1;
        }
        glClearColor(0.1f, 0.2f, 0.3f, 1);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glEnable(GL_DEPTH_TEST);
        draw(i);
        finish(names[i]);
        errors();
        if (i == 7) {
            glDisable(GL_BLEND);
            glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
            glMatrixMode(GL_PROJECTION);
            glLoadIdentity();
            glMatrixMode(GL_MODELVIEW);
            glLoadIdentity();
            many();
            list_errors();
            lists_again();
            depth_stencil();
            tall();
        }
        OSMesaDestroyContext(c); /* while it is current */
    }
    return wrong;
}
