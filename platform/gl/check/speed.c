/* speed.c: CPU time of the same calls by two OSMesa libraries: speed OURS THEIRS [ROUNDS].
 *
 * Each round runs all workloads once with each library, in a process of its own; the shortest times count. */
#define _GNU_SOURCE
#include <GL/osmesa.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { WIDTH = 1024, HEIGHT = 768, TRIANGLES = 100000, LARGE = 1000, LISTED = 1000000, QUADS = 10000, CLEARS = 50,
       FRAMES = 20 };

#define CALLS(X) \
    X(glBegin, void, (GLenum)) X(glEnd, void, (void)) X(glVertex3f, void, (GLfloat, GLfloat, GLfloat)) \
    X(glVertex2f, void, (GLfloat, GLfloat)) X(glColor3f, void, (GLfloat, GLfloat, GLfloat)) \
    X(glNormal3f, void, (GLfloat, GLfloat, GLfloat)) X(glTexCoord2f, void, (GLfloat, GLfloat)) \
    X(glNewList, void, (GLuint, GLenum)) X(glEndList, void, (void)) X(glCallList, void, (GLuint)) \
    X(glDeleteLists, void, (GLuint, GLsizei)) X(glEnable, void, (GLenum)) X(glDisable, void, (GLenum)) \
    X(glBlendFunc, void, (GLenum, GLenum)) X(glClear, void, (GLbitfield)) X(glFinish, void, (void)) \
    X(glTexImage2D, void, (GLenum, GLint, GLint, GLsizei, GLsizei, GLint, GLenum, GLenum, const void *)) \
    X(glTexParameteri, void, (GLenum, GLenum, GLint)) X(glMatrixMode, void, (GLenum)) X(glLoadIdentity, void, (void)) \
    X(glFrustum, void, (GLdouble, GLdouble, GLdouble, GLdouble, GLdouble, GLdouble)) \
    X(glTranslatef, void, (GLfloat, GLfloat, GLfloat)) X(glRotatef, void, (GLfloat, GLfloat, GLfloat, GLfloat)) \
    X(glPushMatrix, void, (void)) X(glPopMatrix, void, (void)) X(glLightfv, void, (GLenum, GLenum, const GLfloat *)) \
    X(glMaterialfv, void, (GLenum, GLenum, const GLfloat *)) X(glShadeModel, void, (GLenum)) \
    X(glFogi, void, (GLenum, GLint)) X(glFogf, void, (GLenum, GLfloat)) X(glFogfv, void, (GLenum, const GLfloat *)) \
    X(glGetString, const GLubyte *, (GLenum))
#include "library.h"

static unsigned char pixels[WIDTH * HEIGHT * 4];
static unsigned seed;

static float random_unit(void)
{
    seed = seed * 1664525u + 1013904223u;
    return (float)(seed >> 8) / 16777216.0f;
}

/* A triangle of a few pixels anywhere in the window. */
static void small_triangle(void)
{
    const float x = 1.9f * random_unit() - 1, y = 1.9f * random_unit() - 1, z = random_unit();
    p_glColor3f(x, y, z);
    p_glVertex3f(x, y, z);
    p_glVertex3f(x + 0.01f, y, z);
    p_glVertex3f(x, y + 0.01f, z);
}

static void immediate(void)
{
    p_glBegin(GL_TRIANGLES);
    for (int i = 0; i < TRIANGLES; ++i) {
        small_triangle();
    }
    p_glEnd();
}

/* Lines of up to 20 px a side. */
static void lines(void)
{
    p_glBegin(GL_LINES);
    for (int i = 0; i < TRIANGLES; ++i) {
        const float x = 1.9f * random_unit() - 1, y = 1.9f * random_unit() - 1;
        p_glColor3f(x, y, 1);
        p_glVertex3f(x, y, x);
        p_glVertex3f(x + 0.04f * (2 * random_unit() - 1), y + 0.05f * (2 * random_unit() - 1), y);
    }
    p_glEnd();
}

static void compile_list(void)
{
    p_glNewList(1, GL_COMPILE);
    p_glBegin(GL_TRIANGLES);
    for (int i = 0; i < LISTED; ++i) {
        const float x = 1.9f * random_unit() - 1, y = 1.9f * random_unit() - 1;
        p_glVertex3f(x, y, 0.1f);
        p_glVertex3f(x + 0.004f, y, 0.2f);
        p_glVertex3f(x, y + 0.004f, 0.3f);
    }
    p_glEnd();
    p_glEndList();
}
static void call_list(void) { p_glCallList(1); }

static void clipped(void)
{
    p_glBegin(GL_TRIANGLES);
    for (int i = 0; i < 3 * LISTED; ++i) {
        p_glVertex3f(5, (float)(i & 7), 0);
    }
    p_glEnd();
}

static void clears(void)
{
    for (int i = 0; i < CLEARS; ++i) {
        p_glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        p_glFinish();
    }
}

static void quads(GLint filter)
{
    const float w = 32.0f * 2 / WIDTH, h = 32.0f * 2 / HEIGHT;
    static unsigned char texels[64 * 64 * 4];
    for (int i = 0; i < (int)sizeof texels; ++i) {
        texels[i] = (unsigned char)(i * 37);
    }
    p_glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 64, 64, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
    p_glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    p_glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    p_glEnable(GL_TEXTURE_2D);
    p_glEnable(GL_BLEND);
    p_glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    p_glDisable(GL_DEPTH_TEST);
    p_glBegin(GL_QUADS);
    for (int i = 0; i < QUADS; ++i) {
        const float x = (2 - w) * random_unit() - 1, y = (2 - h) * random_unit() - 1;
        p_glTexCoord2f(0, 0); p_glVertex2f(x, y);
        p_glTexCoord2f(1, 0); p_glVertex2f(x + w, y);
        p_glTexCoord2f(1, 1); p_glVertex2f(x + w, y + h);
        p_glTexCoord2f(0, 1); p_glVertex2f(x, y + h);
    }
    p_glEnd();
    p_glDisable(GL_TEXTURE_2D);
    p_glDisable(GL_BLEND);
    p_glEnable(GL_DEPTH_TEST);
}
static void quads_nearest(void) { quads(GL_NEAREST); }
static void quads_linear(void) { quads(GL_LINEAR); }

/* A wheel with teeth: two flat sides and a rim. */
static void gear(float inner, float outer, float thick, int teeth)
{
    for (int side = -1; side <= 1; side += 2) {
        p_glNormal3f(0, 0, (float)side);
        p_glBegin(GL_QUAD_STRIP);
        for (int i = 0; i <= 4 * teeth; ++i) {
            const float a = (float)i * 6.2831853f / (float)(4 * teeth), r = (i & 3) < 2 ? outer : outer - 0.7f;
            p_glVertex3f(inner * cosf(a), inner * sinf(a), (float)side * thick);
            p_glVertex3f(r * cosf(a), r * sinf(a), (float)side * thick);
        }
        p_glEnd();
    }
    p_glBegin(GL_QUAD_STRIP);
    for (int i = 0; i <= 4 * teeth; ++i) {
        const float a = (float)i * 6.2831853f / (float)(4 * teeth), r = (i & 3) < 2 ? outer : outer - 0.7f;
        p_glNormal3f(cosf(a), sinf(a), 0);
        p_glVertex3f(r * cosf(a), r * sinf(a), -thick);
        p_glVertex3f(r * cosf(a), r * sinf(a), thick);
    }
    p_glEnd();
}

static void gears(void)
{
    static const GLfloat at[4] = {5, 5, 10, 0};
    static const GLfloat colour[3][4] = {{0.8f, 0.1f, 0, 1}, {0, 0.8f, 0.2f, 1}, {0.2f, 0.2f, 1, 1}};
    static const float place[3][5] = {{-3, -2, 4, 1, 20}, {3.1f, -2, 2, 2, 10}, {-3.1f, 4.2f, 2, 0.5f, 10}};
    p_glMatrixMode(GL_PROJECTION);
    p_glFrustum(-1, 1, -0.75, 0.75, 5, 60);
    p_glMatrixMode(GL_MODELVIEW);
    p_glLightfv(GL_LIGHT0, GL_POSITION, at);
    p_glEnable(GL_LIGHTING);
    p_glEnable(GL_LIGHT0);
    for (int f = 0; f < FRAMES; ++f) {
        p_glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        p_glLoadIdentity();
        p_glTranslatef(0, 0, -40);
        p_glRotatef(20, 1, 0, 0);
        p_glRotatef(30, 0, 1, 0);
        for (int g = 0; g < 3; ++g) {
            const float *p = place[g];
            p_glPushMatrix();
            p_glTranslatef(p[0], p[1], 0);
            p_glRotatef((float)(f * 5) * (g == 0 ? 1.0f : -2.0f), 0, 0, 1);
            p_glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE, colour[g]);
            gear(p[2] * 0.25f, p[2], p[3] * 0.5f, (int)p[4]);
            p_glPopMatrix();
        }
        p_glFinish();
    }
    p_glDisable(GL_LIGHTING);
    p_glMatrixMode(GL_PROJECTION);
    p_glLoadIdentity();
    p_glMatrixMode(GL_MODELVIEW);
    p_glLoadIdentity();
}

/* Large triangles in perspective, about 150 px a side, of random directions and depths. */
enum { LARGE_TEXTURE = 1, LARGE_SMOOTH = 2, LARGE_FOG = 4, LARGE_BLEND = 8, LARGE_LINEAR = 16, LARGE_MIPS = 32 };

static void large(int how, GLint fog)
{
    static const GLfloat grey[4] = {0.6f, 0.65f, 0.7f, 1};
    static unsigned char texels[64 * 64 * 4];
    const GLint filter = (how & LARGE_LINEAR) != 0 ? GL_LINEAR : GL_NEAREST;
    for (int i = 0; i < (int)sizeof texels; ++i) {
        texels[i] = (unsigned char)(i * 37);
    }
    if ((how & LARGE_TEXTURE) != 0) {
        p_glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, (how & LARGE_MIPS) != 0);
        p_glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 64, 64, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
        p_glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER,
                          (how & LARGE_MIPS) != 0 ? GL_LINEAR_MIPMAP_LINEAR : filter);
        p_glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
        p_glEnable(GL_TEXTURE_2D);
    }
    if ((how & LARGE_FOG) != 0) {
        p_glEnable(GL_FOG);
        p_glFogi(GL_FOG_MODE, fog);
        p_glFogfv(GL_FOG_COLOR, grey);
        p_glFogf(GL_FOG_START, 2);
        p_glFogf(GL_FOG_END, 9);
        p_glFogf(GL_FOG_DENSITY, 0.15f);
    }
    if ((how & LARGE_BLEND) != 0) {
        p_glEnable(GL_BLEND);
        p_glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    }
    p_glMatrixMode(GL_PROJECTION);
    p_glFrustum(-1, 1, -0.75, 0.75, 2, 20);
    p_glMatrixMode(GL_MODELVIEW);
    p_glBegin(GL_TRIANGLES);
    for (int i = 0; i < LARGE; ++i) {
        const float z = 3 + 5 * random_unit(), x = (2 * random_unit() - 1) * z * 0.3f,
                    y = (2 * random_unit() - 1) * z * 0.25f;
        float red = 1;
        for (int k = 0; k < 3; ++k) {
            const float to = z + random_unit() * 1.5f, size = 0.15f * z;
            red = (how & LARGE_SMOOTH) != 0 || k == 0 ? random_unit() : red;
            if ((how & LARGE_SMOOTH) != 0 || k == 0) {
                p_glColor3f(red, 1 - red, 0.75f);
            }
            p_glTexCoord2f((float)(k == 1) * 2.5f, (float)(k == 2) * 2.5f);
            p_glVertex3f(x + (k == 1 ? size : k == 2 ? -0.3f * size : 0),
                         y + (k == 2 ? size : 0.2f * size * random_unit()), -to);
        }
    }
    p_glEnd();
    p_glMatrixMode(GL_PROJECTION);
    p_glLoadIdentity();
    p_glMatrixMode(GL_MODELVIEW);
    p_glDisable(GL_TEXTURE_2D);
    p_glDisable(GL_FOG);
    p_glDisable(GL_BLEND);
    p_glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, 0);
}
static void large_smooth(void) { large(LARGE_SMOOTH, 0); }
static void large_nearest(void) { large(LARGE_TEXTURE | LARGE_SMOOTH, 0); }
static void large_linear(void) { large(LARGE_TEXTURE | LARGE_SMOOTH | LARGE_LINEAR, 0); }
static void large_mips(void) { large(LARGE_TEXTURE | LARGE_SMOOTH | LARGE_LINEAR | LARGE_MIPS, 0); }
static void large_fog(void) { large(LARGE_FOG | LARGE_SMOOTH, GL_LINEAR); }
static void large_fog_nearest(void) { large(LARGE_TEXTURE | LARGE_FOG, GL_LINEAR); }
static void large_fog_linear(void) { large(LARGE_TEXTURE | LARGE_FOG | LARGE_LINEAR, GL_LINEAR); }
static void large_fog_smooth(void) { large(LARGE_TEXTURE | LARGE_FOG | LARGE_SMOOTH | LARGE_LINEAR, GL_LINEAR); }
static void large_fog_exp(void) { large(LARGE_TEXTURE | LARGE_FOG | LARGE_SMOOTH | LARGE_LINEAR, GL_EXP); }
static void large_fog_exp2(void) { large(LARGE_TEXTURE | LARGE_FOG | LARGE_SMOOTH | LARGE_LINEAR, GL_EXP2); }
static void large_fog_mips(void)
{
    large(LARGE_TEXTURE | LARGE_FOG | LARGE_SMOOTH | LARGE_LINEAR | LARGE_MIPS, GL_LINEAR);
}
static void large_fog_blend(void) { large(LARGE_FOG | LARGE_BLEND, GL_LINEAR); }
static void large_all(void)
{
    large(LARGE_TEXTURE | LARGE_FOG | LARGE_SMOOTH | LARGE_LINEAR | LARGE_BLEND, GL_LINEAR);
}

static const struct workload { const char *name, *unit; double by; void (*run)(void); } workloads[] = {
    {"100,000 immediate-mode triangles", "ms", 1e3, immediate},
    {"compiling a list again, per glVertex3f", "ns", 1e9 / (3.0 * LISTED), compile_list},
    {"a display list of 1 M triangles", "ms", 1e3, call_list},
    {"glVertex3f, clipped away", "ns", 1e9 / (3.0 * LISTED), clipped},
    {"10,000 blended quads of 32x32, nearest", "ms", 1e3, quads_nearest},
    {"10,000 blended quads of 32x32, linear", "ms", 1e3, quads_linear},
    {"clear 1024x768, colour and depth", "ms", 1e3 / CLEARS, clears},
    {"gears 1024x768, per frame", "ms", 1e3 / FRAMES, gears},
    {"100,000 immediate-mode lines", "ms", 1e3, lines},
    {"1,000 large triangles, smooth", "ms", 1e3, large_smooth},
    {"texture, smooth, nearest", "ms", 1e3, large_nearest},
    {"texture, smooth, linear", "ms", 1e3, large_linear},
    {"texture, smooth, trilinear", "ms", 1e3, large_mips},
    {"fog, smooth", "ms", 1e3, large_fog},
    {"fog, texture, nearest", "ms", 1e3, large_fog_nearest},
    {"fog, texture, linear", "ms", 1e3, large_fog_linear},
    {"fog, texture, smooth, linear", "ms", 1e3, large_fog_smooth},
    {"the same, GL_EXP", "ms", 1e3, large_fog_exp},
    {"the same, GL_EXP2", "ms", 1e3, large_fog_exp2},
    {"fog, texture, smooth, trilinear", "ms", 1e3, large_fog_mips},
    {"fog, blended", "ms", 1e3, large_fog_blend},
    {"fog, texture, smooth, linear, blended", "ms", 1e3, large_all}};
enum { WORKLOADS = sizeof workloads / sizeof workloads[0] };

/* User and system time: the kernel splits the two by samples, and called whole workloads system time. */
static double cpu_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

/* In a process of its own: all workloads once to warm up, then measured. */
static int run_all(const char *path, int to, int round)
{
    double seconds[WORKLOADS];
    if (!load_library("speed", path, pixels, WIDTH, HEIGHT, round == 0)) {
        return 2;
    }
    p_glEnable(GL_DEPTH_TEST);
    for (int i = 0; i < WORKLOADS; ++i) {
        for (int again = 0; again < 2; ++again) {
            seed = 7;
            p_glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
            p_glFinish();
            const double start = cpu_seconds();
            workloads[i].run();
            p_glFinish();
            seconds[i] = cpu_seconds() - start;
        }
    }
    return write(to, seconds, sizeof seconds) == (ssize_t)sizeof seconds ? 0 : 1;
}

int main(int argc, char **argv)
{
    const int rounds = argc > 3 ? atoi(argv[3]) : 5;
    double shortest[2][WORKLOADS];
    if (argc < 3) {
        fprintf(stderr, "usage: speed OURS THEIRS [ROUNDS]\n");
        return 2;
    }
    setenv("LP_NUM_THREADS", "0", 1);
    for (int r = 0; r < 2 * rounds; ++r) {
        double seconds[WORKLOADS];
        int ends[2], status;
        if (pipe(ends) != 0) {
            return 2;
        }
        const pid_t child = fork();
        if (child == 0) {
            _exit(run_all(argv[1 + r % 2], ends[1], r / 2));
        }
        close(ends[1]);
        const ssize_t got = read(ends[0], seconds, sizeof seconds);
        close(ends[0]);
        waitpid(child, &status, 0);
        if (got != (ssize_t)sizeof seconds) {
            return 1;
        }
        for (int i = 0; i < WORKLOADS; ++i) {
            shortest[r % 2][i] = r < 2 || seconds[i] < shortest[r % 2][i] ? seconds[i] : shortest[r % 2][i];
        }
    }
    printf("| workload | theirs | ours | ratio |\n|---|---|---|---|\n");
    for (int i = 0; i < WORKLOADS; ++i) {
        const double by = workloads[i].by, ours = shortest[0][i] * by, theirs = shortest[1][i] * by;
        printf("| %s | %.3g %s | %.3g %s | %.1f |\n", workloads[i].name, theirs, workloads[i].unit, ours,
               workloads[i].unit, theirs / ours);
    }
    return 0;
}
