/* meshes.c: random meshes by every primitive and every way to send them.
 *
 *   meshes [ROUNDS [FIRST]]        a round's picture is the same by all ways and by all back ends
 *   meshes pin                     prints the hashes of the usual rounds, which are pinned
 *   meshes hash [ROUNDS [FIRST]]   prints a line a round, by the back end of the environment, to compare two libraries
 */
#define _POSIX_C_SOURCE 200112L
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "random.h"

enum { WIDTH = 150, HEIGHT = 94, SIDE = 32, BATCHES = 3, RUNS = 40, VERTICES = 14000 };
enum { SIMPLE = 10000 /* the first round of states that draw.h has kernels for */ };
static int simple; /* 1: such a round */
/* Ways: as the program would; every run on its own, by glVertex; compiled first; compiled and drawn. */
enum { WAY_USUAL, WAY_ALONE, WAY_LIST, WAY_BOTH, WAYS };
static unsigned char pixels[HEIGHT][WIDTH][4];
static float depths[HEIGHT][WIDTH];

typedef struct vertex {
    float uv[4];
    GLubyte colour[4];
    float normal[3], at[3];
    GLshort small_at[3], unused;
    float second[3], fog;
} vertex;
static vertex mesh[VERTICES];
static unsigned index_wide[VERTICES];
static unsigned short index_short[VERTICES];
static unsigned char index_byte[VERTICES];

static void set_texture(int u)
{
    static const GLenum formats[6] = {GL_RGBA, GL_RGB, GL_ALPHA, GL_LUMINANCE, GL_LUMINANCE_ALPHA, GL_INTENSITY};
    static const GLenum modes[5] = {GL_MODULATE, GL_REPLACE, GL_DECAL, GL_BLEND, GL_ADD};
    static const GLenum wraps[4] = {GL_REPEAT, GL_CLAMP, GL_CLAMP_TO_EDGE, GL_MIRRORED_REPEAT};
    static unsigned char texels[SIDE * SIDE * 4];
    float colour[4];
    for (int i = 0; i < (int)sizeof texels; ++i) {
        texels[i] = (unsigned char)any(256);
    }
    for (int i = 0; i < 4; ++i) {
        colour[i] = unit();
    }
    const GLint filter = any(2) ? GL_NEAREST : GL_LINEAR;
    glActiveTexture((GLenum)(GL_TEXTURE0 + u));
    glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, 1);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, any(6) ? filter : GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, (GLint)wraps[any(2) ? 0 : any(4)]);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, (GLint)wraps[any(2) ? 0 : any(4)]);
    glTexImage2D(GL_TEXTURE_2D, 0, (GLint)formats[any(3) ? 0 : any(6)], SIDE, SIDE, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 texels);
    glTexEnvfv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, colour);
    if (any(3) == 0) {
        set_combine();
    } else {
        glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, (GLint)modes[any(2) ? any(5) : 0]);
    }
    enable(GL_TEXTURE_GEN_S, 12);
    glEnable(GL_TEXTURE_2D);
    glActiveTexture(GL_TEXTURE0);
}

/* States of small triangles in batches. */
static void set_simple(void)
{
    static unsigned char texels[SIDE * SIDE * 4];
    const float at[4] = {2, 3, 4, (float)any(2)};
    const GLint filter = any(2) ? GL_NEAREST : GL_LINEAR;
    for (int i = 0; i < (int)sizeof texels; ++i) {
        texels[i] = (unsigned char)any(256);
    }
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, any(2) ? GL_REPEAT : GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, any(2) ? GL_REPEAT : GL_MIRRORED_REPEAT);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, SIDE, SIDE, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
    enable(GL_TEXTURE_2D, 2);
    glShadeModel(any(3) ? GL_SMOOTH : GL_FLAT);
    enable(GL_DEPTH_TEST, 2);
    enable(GL_BLEND, 4);
    glBlendFunc(GL_SRC_ALPHA, any(2) ? GL_ONE : GL_ONE_MINUS_SRC_ALPHA);
    enable(GL_CULL_FACE, 2);
    if (any(4) == 0) {
        glEnable(GL_LIGHTING);
        glEnable(GL_LIGHT0);
        enable(GL_COLOR_MATERIAL, 2);
        glLightfv(GL_LIGHT0, GL_POSITION, at);
    }
}

static void set_state(void)
{
    static const double plane[4] = {0.3, 0.6, 0.1, 1.5};
    const float at[4] = {2, 3, 4, (float)any(2)}, grey[4] = {unit(), unit(), unit(), unit()};
    const int units = any(2) ? 0 : 1 + (any(4) == 0);
    for (int u = 0; u < units; ++u) {
        set_texture(u);
    }
    enable(GL_FOG, 6);
    glFogfv(GL_FOG_COLOR, grey);
    glFogi(GL_FOG_MODE, GL_LINEAR);
    glFogf(GL_FOG_START, 2);
    glFogf(GL_FOG_END, 9);
    glShadeModel(any(4) ? GL_SMOOTH : GL_FLAT);
    if (any(4)) {
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(any(3) ? GL_LESS : GL_LEQUAL);
    }
    enable(GL_BLEND, 4);
    glBlendFunc(GL_SRC_ALPHA, any(2) ? GL_ONE : GL_ONE_MINUS_SRC_ALPHA);
    enable(GL_CULL_FACE, 5);
    glCullFace(any(5) ? GL_BACK : GL_FRONT);
    glFrontFace(any(2) ? GL_CW : GL_CCW);
    enable(GL_STENCIL_TEST, 12);
    glStencilFunc(GL_ALWAYS, 1, 255);
    glStencilOp(GL_KEEP, GL_INCR, GL_INCR);
    enable(GL_ALPHA_TEST, 10);
    glAlphaFunc(GL_GREATER, 0.3f);
    enable(GL_SCISSOR_TEST, 8);
    glScissor(9, 7, 101, 55);
    enable(GL_POLYGON_OFFSET_FILL, 12);
    glPolygonOffset(1.5f, any(2) ? 2.0f : 0.0f);
    enable(GL_POLYGON_STIPPLE, 20);
    enable(GL_COLOR_SUM, 10);
    glClipPlane(GL_CLIP_PLANE0, plane);
    enable(GL_CLIP_PLANE0, 10);
    if (any(3) == 0) {
        glEnable(GL_LIGHTING);
        glEnable(GL_LIGHT0);
        enable(GL_COLOR_MATERIAL, 2);
        enable(GL_NORMALIZE, 2);
        glLightfv(GL_LIGHT0, GL_POSITION, at);
        glLightfv(GL_LIGHT0, GL_SPECULAR, grey);
        glMaterialfv(GL_FRONT_AND_BACK, GL_SPECULAR, grey);
        glMaterialf(GL_FRONT_AND_BACK, GL_SHININESS, 9);
        glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, any(3) == 0);
        glLightModeli(GL_LIGHT_MODEL_COLOR_CONTROL, any(3) ? GL_SINGLE_COLOR : GL_SEPARATE_SPECULAR_COLOR);
    }
    if (any(12) == 0) {
        glPolygonMode(any(2) ? GL_FRONT : GL_FRONT_AND_BACK, any(2) ? GL_LINE : GL_POINT);
    }
}

static float not_a_number(void)
{
    const uint32_t bits = any(2) ? 0x7fc00000u : any(2) ? 0x7f800000u : 0xff800000u;
    float v;
    memcpy(&v, &bits, sizeof v);
    return v;
}

/* A strip of vertices that wander over the picture in steps of about `step`. */
static void set_mesh(int count, float step, int odd)
{
    float x = between(-3, 3), y = between(-2, 2), z = between(-8, -3);
    for (int i = 0; i < count; ++i) {
        vertex *v = &mesh[i];
        memset(v, 0, sizeof *v);
        if (any(30) == 0) {
            x = between(-3, 3);
            y = between(-2, 2);
            z = between(-8, -3);
        }
        x += between(-step, step);
        y += between(-step, step);
        z += between(-step, step);
        v->at[0] = x;
        v->at[1] = y;
        v->at[2] = z;
        if (odd && any(40) == 0) {
            v->at[any(3)] = not_a_number();
        } else if (any(25) == 0 && i > 0) { /* no area */
            memcpy(v->at, mesh[i - 1].at, sizeof v->at);
        }
        for (int k = 0; k < 4; ++k) {
            v->colour[k] = (GLubyte)any(256);
            v->uv[k] = k < 3 ? between(-2, 3) : 1;
        }
        if (odd && any(60) == 0) {
            v->uv[any(4)] = any(2) ? not_a_number() : between(0.5f, 2);
        }
        for (int k = 0; k < 3; ++k) {
            v->normal[k] = between(-0.7f, 0.7f);
            v->second[k] = unit();
            v->small_at[k] = (GLshort)(x != x ? 0 : (k == 0 ? x : k == 1 ? y : z));
        }
        v->normal[2] += 0.6f;
        v->fog = between(0, 9);
    }
}

/* What a batch's vertices have: bits of colour, normal, coordinates, second colour. */
static void point_at(const vertex *v, int has, int coordinates)
{
    const char *p = (const char *)v;
    glVertexPointer(3, GL_FLOAT, sizeof *v, p + offsetof(vertex, at));
    glEnableClientState(GL_VERTEX_ARRAY);
    if (has & 1) {
        glColorPointer(4, GL_UNSIGNED_BYTE, sizeof *v, p + offsetof(vertex, colour));
        glEnableClientState(GL_COLOR_ARRAY);
    }
    if (has & 2) {
        glNormalPointer(GL_FLOAT, sizeof *v, p + offsetof(vertex, normal));
        glEnableClientState(GL_NORMAL_ARRAY);
    }
    if (has & 4) {
        glTexCoordPointer(coordinates, GL_FLOAT, sizeof *v, p + offsetof(vertex, uv));
        glEnableClientState(GL_TEXTURE_COORD_ARRAY);
    }
    if (has & 8) {
        glSecondaryColorPointer(3, GL_FLOAT, sizeof *v, p + offsetof(vertex, second));
        glEnableClientState(GL_SECONDARY_COLOR_ARRAY);
    }
}

static void send(const vertex *v, int has, int coordinates)
{
    if (has & 1) glColor4ubv(v->colour);
    if (has & 2) glNormal3fv(v->normal);
    if ((has & 4) && coordinates == 2) glTexCoord2fv(v->uv);
    if ((has & 4) && coordinates == 4) glTexCoord4fv(v->uv);
    if (has & 8) glSecondaryColor3fv(v->second);
    glVertex3fv(v->at);
}

/* Draws a run, first + count elements: indices or not. how: 0 glBegin, 1 arrays, 2 indices. */
static void draw_run(GLenum mode, int first, int count, int how, int type, int has, int coordinates, int way,
                     int paints, int buffered)
{
    static const GLenum types[3] = {GL_UNSIGNED_BYTE, GL_UNSIGNED_SHORT, GL_UNSIGNED_INT};
    const char *const from[3] = {(const char *)(index_byte + first), (const char *)(index_short + first),
                                 (const char *)(index_wide + first)};
    if (way == WAY_ALONE) {
        static const float kept[4] = {0.3f, 0.7f, 0.2f, 0.8f};
        glFlush();
        glEnable(GL_DITHER); /* a batch ends */
        glBegin(mode);
        for (int i = 0; i < count; ++i) {
            const unsigned at = how < 2 ? (unsigned)(first + i)
                                : type == 0 ? index_byte[first + i] : type == 1 ? index_short[first + i]
                                                                                 : index_wide[first + i];
            if (paints && i == count / 2) {
                glMaterialfv(GL_FRONT_AND_BACK, GL_DIFFUSE, kept);
            }
            send(&mesh[at], has, coordinates);
        }
        glEnd();
    } else if (how == 0) {
        static const float kept[4] = {0.3f, 0.7f, 0.2f, 0.8f};
        glBegin(mode);
        for (int i = 0; i < count; ++i) {
            if (paints && i == count / 2) {
                glMaterialfv(GL_FRONT_AND_BACK, GL_DIFFUSE, kept);
            }
            send(&mesh[first + i], has, coordinates);
        }
        glEnd();
    } else if (how == 1) {
        glDrawArrays(mode, first, count);
    } else {
        glDrawElements(mode, count, types[type],
                       buffered ? (const void *)(uintptr_t)(first << type) : (const void *)from[type]);
    }
}

/* A batch of runs of one kind. */
static void draw_batch(int way)
{
    static const GLenum modes[7] = {GL_TRIANGLES, GL_TRIANGLE_STRIP, GL_TRIANGLE_FAN, GL_QUADS, GL_QUAD_STRIP,
                                    GL_POLYGON, GL_TRIANGLE_STRIP};
    const GLenum mode = modes[any(7)];
    const float step = any(2) ? 0.08f : any(2) ? 0.3f : 1.5f;
    const int odd = any(8) == 0, how = (int)any(3), type = (int)any(3), has = (int)any(16) | (simple ? 5 : 0),
              coordinates = any(5) ? 2 : 4, is_long = any(simple ? 5 : 10) == 0,
              runs = is_long ? 1 + (int)any(2) : 1 + (int)any(RUNS),
              paints = any(6) == 0 && how == 0, buffered = any(2) == 0;
    const int most_of_run = is_long ? VERTICES / 2 : 60, vertices = is_long ? 9000 : 1000;
    GLuint buffer[2];
    set_mesh(vertices, step, odd);
    for (int i = 0; i < VERTICES; ++i) { /* neighbours are shared */
        const uint32_t near = (uint32_t)(i / 3) + any(9), at = any(20) == 0 ? any((uint32_t)vertices) : near;
        index_wide[i] = at % (uint32_t)vertices;
        index_short[i] = (unsigned short)index_wide[i];
        index_byte[i] = (unsigned char)index_wide[i];
    }
    glGenBuffers(2, buffer);
    if (how != 0 && way != WAY_ALONE) {
        if (buffered) {
            glBindBuffer(GL_ARRAY_BUFFER, buffer[0]);
            glBufferData(GL_ARRAY_BUFFER, sizeof mesh, mesh, GL_STATIC_DRAW);
            glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer[1]);
            glBufferData(GL_ELEMENT_ARRAY_BUFFER, VERTICES << type,
                         type == 0 ? (const void *)index_byte : type == 1 ? (const void *)index_short
                                                                           : (const void *)index_wide, GL_STATIC_DRAW);
        }
        point_at(buffered ? NULL : mesh, has, coordinates);
    }
    if (way >= WAY_LIST) {
        glNewList(1, way == WAY_LIST ? GL_COMPILE : GL_COMPILE_AND_EXECUTE);
    }
    for (int r = 0; r < runs; ++r) {
        const int count = (int)any((uint32_t)most_of_run),
                  first = (int)any((uint32_t)((how < 2 ? vertices : VERTICES) - most_of_run));
        draw_run(mode, first, count, how, type, has, coordinates, way, paints, buffered);
        if (how != 0) { /* the list's attributes end with the last element's */
            glColor4f(0.8f, 0.7f, 0.9f, 0.6f);
            glNormal3f(0.1f, 0.2f, 1);
            glTexCoord2f(0.25f, 0.5f);
            glSecondaryColor3f(0.1f, 0.2f, 0.3f);
        }
    }
    if (way >= WAY_LIST) {
        glEndList();
    }
    if (way == WAY_LIST) {
        glCallList(1);
    }
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
    glDisableClientState(GL_VERTEX_ARRAY);
    glDisableClientState(GL_COLOR_ARRAY);
    glDisableClientState(GL_NORMAL_ARRAY);
    glDisableClientState(GL_TEXTURE_COORD_ARRAY);
    glDisableClientState(GL_SECONDARY_COLOR_ARRAY);
    glDeleteBuffers(2, buffer);
    glColor4f(0.5f, 0.4f, 0.3f, 0.9f);
    glNormal3f(0, 0, 1);
    glTexCoord2f(0, 0);
    glSecondaryColor3f(0, 0, 0);
}

/* Returns a hash of colours and depths; 0: an error. */
static uint64_t draw_round(uint32_t round, int way)
{
    OSMesaContext context = OSMesaCreateContextExt(round % 3 == 0 ? OSMESA_BGRA : OSMESA_RGBA, 24, 8, 0, NULL);
    const int wide = round % 2 == 0 ? WIDTH : WIDTH - 5, high = round % 2 == 0 ? HEIGHT : HEIGHT - 1;
    uint64_t hash = 14695981039346656037u;
    simple = round >= SIMPLE;
    memset(pixels, 0, sizeof pixels);
    if (context == NULL || !OSMesaMakeCurrent(context, pixels, GL_UNSIGNED_BYTE, wide, high)) {
        return 0;
    }
    seed = round * 0x9e3779b97f4a7c15u + 5;
    glClearColor(0.2f, 0.5f, 0.7f, 0.4f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    glMatrixMode(GL_PROJECTION);
    glFrustum(-0.6, 0.6, -0.4, 0.4, 1, 12);
    glMatrixMode(GL_MODELVIEW);
    for (int batch = 0; batch < BATCHES; ++batch) {
        glPushAttrib(GL_ALL_ATTRIB_BITS);
        glLoadIdentity();
        if (any(2)) {
            glRotatef(between(-9, 9), 0.1f, 0.3f, 1);
        }
        if (simple) {
            set_simple();
        } else {
            set_state();
        }
        draw_batch(way);
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

/* Returns how many ways and back ends draw a round otherwise. */
static int check_round(uint32_t r)
{
    static const char *const kernels[6] = {"avx512", "avx2", "sse2", "neon", "simd128", "scalar"};
    int wrong = 0;
    setenv("LAMBENT_GL_KERNELS", "none", 1);
    const uint64_t want = draw_round(r, WAY_ALONE);
    wrong += want == 0;
    for (int k = 0; k < 6 + WAYS; ++k) { /* back ends as usual; all ways by the best one */
        const int way = k < 6 ? WAY_USUAL : k - 6;
        setenv("LAMBENT_GL_KERNELS", kernels[k < 6 ? k : 0], 1);
        if (draw_round(r, way) != want) {
            ++wrong;
            fprintf(stderr, "meshes: round %u by %s, way %d\n", (unsigned)r, kernels[k < 6 ? k : 0], way);
        }
    }
    return wrong;
}

static void print_round(uint32_t r, int ways)
{
    for (int w = 0; w < ways; ++w) {
        const uint64_t hash = draw_round(r, w);
        printf("%u %d %08lx%08lx\n", (unsigned)r, w, (unsigned long)(hash >> 32), (unsigned long)(hash & 0xffffffffu));
    }
}

int main(int argc, char **argv)
{
    static const uint32_t usual[4][2] = {{0, 12}, {SIMPLE, 30}, {2148, 1}, {4131, 1}}; /* first, rounds */
    const int pins = argc > 1 && strcmp(argv[1], "pin") == 0,
              prints = pins || (argc > 1 && strcmp(argv[1], "hash") == 0);
    int wrong = 0;
    for (int k = 0; k < (argc > 1 + prints ? 1 : 4); ++k) {
        const uint32_t rounds = argc > 1 + prints ? (uint32_t)atoi(argv[1 + prints]) : usual[k][1],
                       first = argc > 2 + prints ? (uint32_t)atoi(argv[2 + prints]) : usual[k][0];
        for (uint32_t r = first; r < first + rounds; ++r) {
            if (prints) {
                print_round(r, pins ? 1 : WAYS);
            } else {
                wrong += check_round(r);
            }
        }
    }
    return wrong > 0;
}
