/* ways.c: CPU time of one mesh by every way to send it: ways OURS THEIRS [ROUNDS [STATE]].
 *
 * A grid of 100,000 triangles is sent as triangles, strips, fans, quads and quad strips, by glBegin, arrays and
 * indices, at once and from display lists. Each round runs all ways with each library, in a process of its own; the
 * shortest times count, in ms. */
#define _GNU_SOURCE
#include <GL/osmesa.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { WIDTH = 1024, HEIGHT = 768, TRIANGLES = 100000, SIDE_MAX = 224, SIDE = 64 };

#define CALLS(X) \
    X(glBegin, void, (GLenum)) X(glEnd, void, (void)) X(glVertex3fv, void, (const GLfloat *)) \
    X(glColor4ubv, void, (const GLubyte *)) X(glNormal3fv, void, (const GLfloat *)) \
    X(glTexCoord2fv, void, (const GLfloat *)) X(glNewList, void, (GLuint, GLenum)) X(glEndList, void, (void)) \
    X(glCallList, void, (GLuint)) X(glEnable, void, (GLenum)) X(glDisable, void, (GLenum)) \
    X(glClear, void, (GLbitfield)) \
    X(glFinish, void, (void)) X(glTexParameteri, void, (GLenum, GLenum, GLint)) \
    X(glTexEnvi, void, (GLenum, GLenum, GLint)) \
    X(glTexImage2D, void, (GLenum, GLint, GLint, GLsizei, GLsizei, GLint, GLenum, GLenum, const void *)) \
    X(glLightfv, void, (GLenum, GLenum, const GLfloat *)) X(glEnableClientState, void, (GLenum)) \
    X(glMatrixMode, void, (GLenum)) X(glRotatef, void, (GLfloat, GLfloat, GLfloat, GLfloat)) \
    X(glLoadIdentity, void, (void)) \
    X(glDisableClientState, void, (GLenum)) X(glVertexPointer, void, (GLint, GLenum, GLsizei, const void *)) \
    X(glColorPointer, void, (GLint, GLenum, GLsizei, const void *)) \
    X(glNormalPointer, void, (GLenum, GLsizei, const void *)) \
    X(glTexCoordPointer, void, (GLint, GLenum, GLsizei, const void *)) X(glDrawArrays, void, (GLenum, GLint, GLsizei)) \
    X(glDrawElements, void, (GLenum, GLsizei, GLenum, const void *)) X(glGenBuffers, void, (GLsizei, GLuint *)) \
    X(glBindBuffer, void, (GLenum, GLuint)) X(glBufferData, void, (GLenum, GLsizeiptr, const void *, GLenum)) \
    X(glDeleteBuffers, void, (GLsizei, const GLuint *)) X(glDeleteLists, void, (GLuint, GLsizei)) \
    X(glGetString, const GLubyte *, (GLenum))
#include "library.h"

typedef struct vertex {
    float uv[2];
    GLubyte colour[4];
    float normal[3], at[3];
} vertex;

static unsigned char pixels[WIDTH * HEIGHT * 4];
static vertex grid[(SIDE_MAX + 1) * (SIDE_MAX + 1)], sent[3 * TRIANGLES + 4000];
static unsigned wide_index[3 * TRIANGLES + 4000];
static unsigned short index_of[3 * TRIANGLES + 4000];
static int runs[SIDE_MAX * SIDE_MAX + 1], run_count, index_count; /* a run is a glBegin */

enum { COLOUR = 1, LIT = 2, TEXTURE = 4, LINEAR = 8, COMBINE = 16 };

static void set_grid(int n)
{
    for (int y = 0; y <= n; ++y) {
        for (int x = 0; x <= n; ++x) {
            vertex *v = &grid[y * (n + 1) + x];
            const float a = (float)x / (float)n, b = (float)y / (float)n;
            const float nx = 0.6f * sinf(9 * a), ny = 0.6f * cosf(7 * b);
            const float z = sqrtf(1 - nx * nx - ny * ny);
            v->uv[0] = 6 * a;
            v->uv[1] = 6 * b;
            v->colour[0] = (GLubyte)(255 * a);
            v->colour[1] = (GLubyte)(255 * b);
            v->colour[2] = (GLubyte)(x * 37 & 255);
            v->colour[3] = 255;
            v->normal[0] = nx;
            v->normal[1] = ny;
            v->normal[2] = z;
            v->at[0] = 1.9f * a - 0.95f;
            v->at[1] = 1.9f * b - 0.95f;
            v->at[2] = 0.3f * sinf(5 * a + 3 * b);
        }
    }
}

static void add(int i) { wide_index[index_count++] = (unsigned)i; }
static void end_run(void) { runs[++run_count] = index_count; }

static void set_mesh(GLenum mode, int n)
{
    const int w = n + 1;
    run_count = index_count = runs[0] = 0;
    for (int y = 0; y < n; ++y) {
        if (mode == GL_TRIANGLE_STRIP || mode == GL_QUAD_STRIP) {
            for (int x = 0; x <= n; ++x) {
                add(y * w + x);
                add((y + 1) * w + x);
            }
            end_run();
            continue;
        }
        for (int x = 0; x < n; ++x) {
            const int a = y * w + x, b = a + 1, c = a + w + 1, d = a + w;
            if (mode == GL_TRIANGLES) {
                add(a), add(b), add(c), add(a), add(c), add(d);
            } else if (mode == GL_QUADS) {
                add(a), add(b), add(c), add(d);
            } else if ((x & 1) != 0 && (y & 1) != 0) { /* fans of eight */
                const int m = a;
                add(m), add(m - w - 1), add(m - w), add(m - w + 1);
                add(m + 1), add(m + w + 1), add(m + w), add(m + w - 1);
                add(m - 1), add(m - w - 1);
                end_run();
            }
        }
    }
    if (mode == GL_TRIANGLES || mode == GL_QUADS) {
        end_run();
    }
    for (int i = 0; i < index_count; ++i) {
        index_of[i] = (unsigned short)wide_index[i];
        sent[i] = grid[wide_index[i]];
    }
}

static void point_at(const vertex *v, int how)
{
    p_glVertexPointer(3, GL_FLOAT, sizeof *v, (const char *)v + 24);
    p_glEnableClientState(GL_VERTEX_ARRAY);
    if (how & COLOUR) {
        p_glColorPointer(4, GL_UNSIGNED_BYTE, sizeof *v, (const char *)v + 8);
        p_glEnableClientState(GL_COLOR_ARRAY);
    }
    if (how & LIT) {
        p_glNormalPointer(GL_FLOAT, sizeof *v, (const char *)v + 12);
        p_glEnableClientState(GL_NORMAL_ARRAY);
    }
    if (how & TEXTURE) {
        p_glTexCoordPointer(2, GL_FLOAT, sizeof *v, v);
        p_glEnableClientState(GL_TEXTURE_COORD_ARRAY);
    }
}

static void point_nowhere(void)
{
    p_glDisableClientState(GL_VERTEX_ARRAY);
    p_glDisableClientState(GL_COLOR_ARRAY);
    p_glDisableClientState(GL_NORMAL_ARRAY);
    p_glDisableClientState(GL_TEXTURE_COORD_ARRAY);
}

/* Ways: glBegin, glDrawArrays, from a buffer; glDrawElements with ushort, with uint, from buffers. */
enum { IMMEDIATE, ARRAYS, ARRAYS_BUFFER, SHORTS, INTS, BUFFERS, WAYS };
static const char *const way_names[WAYS] = {"glBegin", "arrays", "arrays in a buffer", "ushort indices", "uint indices",
                                            "indices and arrays in buffers"};

static void send_mesh(GLenum mode, int way, int how)
{
    for (int r = 0; r < run_count; ++r) {
        const int from = runs[r], n = runs[r + 1] - from;
        if (way == IMMEDIATE) {
            p_glBegin(mode);
            for (int i = from; i < from + n; ++i) {
                const vertex *v = &sent[i];
                if (how & COLOUR) p_glColor4ubv(v->colour);
                if (how & LIT) p_glNormal3fv(v->normal);
                if (how & TEXTURE) p_glTexCoord2fv(v->uv);
                p_glVertex3fv(v->at);
            }
            p_glEnd();
        } else if (way <= ARRAYS_BUFFER) {
            p_glDrawArrays(mode, from, n);
        } else if (way == SHORTS) {
            p_glDrawElements(mode, n, GL_UNSIGNED_SHORT, index_of + from);
        } else {
            p_glDrawElements(mode, n, GL_UNSIGNED_INT, way == INTS ? (void *)(wide_index + from)
                                                                   : (void *)(sizeof(unsigned) * (size_t)from));
        }
    }
}

static double cpu_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

static const struct state { const char *name; int how; } states[] = {
    {"smooth", COLOUR}, {"lit", LIT}, {"textured", TEXTURE}, {"lit, textured", LIT | TEXTURE | LINEAR},
    {"combine", COLOUR | TEXTURE | LINEAR | COMBINE}};
enum { STATES = 5, MODES = 5, SIZES = 2, LISTS = 2, CASES = STATES * MODES * SIZES * LISTS * WAYS };
static const GLenum modes[MODES] = {GL_TRIANGLES, GL_TRIANGLE_STRIP, GL_TRIANGLE_FAN, GL_QUADS, GL_QUAD_STRIP};
static const char *const mode_names[MODES] = {"triangles", "strips", "fans", "quads", "quad strips"};
static const int sides[SIZES] = {SIDE_MAX, 70}, layers[SIZES] = {1, 10};

static void set_state(int how)
{
    static const GLfloat at[4] = {1, 2, 3, 0};
    if (how & LIT) { p_glEnable(GL_LIGHTING); p_glEnable(GL_LIGHT0); } else { p_glDisable(GL_LIGHTING); }
    p_glLightfv(GL_LIGHT0, GL_POSITION, at);
    if (how & TEXTURE) { p_glEnable(GL_TEXTURE_2D); } else { p_glDisable(GL_TEXTURE_2D); }
    const GLint f = how & LINEAR ? GL_LINEAR : GL_NEAREST;
    p_glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, f);
    p_glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, f);
    p_glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, how & COMBINE ? GL_COMBINE : GL_MODULATE);
    p_glTexEnvi(GL_TEXTURE_ENV, GL_COMBINE_RGB, GL_ADD_SIGNED);
}

static int run_all(const char *path, int to, int round, int only, int only_way)
{
    static double seconds[CASES];
    static unsigned char texels[SIDE * SIDE * 4];
    int k = 0;
    if (!load_library("ways", path, pixels, WIDTH, HEIGHT, round == 0)) {
        return 2;
    }
    for (int i = 0; i < (int)sizeof texels; ++i) {
        texels[i] = (unsigned char)(i * 37);
    }
    p_glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, SIDE, SIDE, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
    p_glEnable(GL_DEPTH_TEST);
    p_glMatrixMode(GL_MODELVIEW);
    p_glRotatef(7, 0.2f, 0.3f, 1);
    for (int s = 0; s < STATES; ++s) {
        for (int z = 0; z < SIZES; ++z) {
            set_grid(sides[z]);
            for (int m = 0; m < MODES; ++m) {
                set_mesh(modes[m], sides[z]);
                for (int w = 0; w < WAYS; ++w) {
                    for (int l = 0; l < LISTS; ++l, ++k) {
                        GLuint buffer[2];
                        if ((only >= 0 && s != only) || (only_way >= 0 && w != only_way)) {
                            continue;
                        }
                        set_state(states[s].how);
                        p_glGenBuffers(2, buffer);
                        if (w == BUFFERS || w == ARRAYS_BUFFER) {
                            p_glBindBuffer(GL_ARRAY_BUFFER, buffer[0]);
                            if (w == BUFFERS) {
                                p_glBufferData(GL_ARRAY_BUFFER, sizeof grid, grid, GL_STATIC_DRAW);
                            } else {
                                p_glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)sizeof sent, sent, GL_STATIC_DRAW);
                            }
                            p_glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, w == BUFFERS ? buffer[1] : 0);
                            if (w == BUFFERS) {
                                p_glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)sizeof wide_index, wide_index,
                                               GL_STATIC_DRAW);
                            }
                            point_at(NULL, states[s].how);
                        } else if (w != IMMEDIATE) {
                            point_at(w == ARRAYS ? sent : grid, states[s].how);
                        }
                        if (l == 1) {
                            p_glNewList(1, GL_COMPILE);
                            send_mesh(modes[m], w, states[s].how);
                            p_glEndList();
                        }
                        for (int again = 0; again < 3; ++again) {
                            p_glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
                            p_glFinish();
                            const double start = cpu_seconds();
                            for (int i = 0; i < layers[z]; ++i) {
                                if (l == 1) {
                                    p_glCallList(1);
                                } else {
                                    send_mesh(modes[m], w, states[s].how);
                                }
                            }
                            p_glFinish();
                            const double took = cpu_seconds() - start;
                            seconds[k] = again == 0 || took < seconds[k] ? took : seconds[k];
                        }
                        if (l == 1) {
                            p_glDeleteLists(1, 1);
                        }
                        p_glBindBuffer(GL_ARRAY_BUFFER, 0);
                        p_glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
                        p_glDeleteBuffers(2, buffer);
                        point_nowhere();
                    }
                }
            }
        }
    }
    for (size_t at = 0; at < sizeof seconds;) {
        const ssize_t n = write(to, (char *)seconds + at, sizeof seconds - at);
        if (n <= 0) {
            return 1;
        }
        at += (size_t)n;
    }
    return 0;
}

int main(int argc, char **argv)
{
    const int rounds = argc > 3 ? atoi(argv[3]) : 2, only = argc > 4 ? atoi(argv[4]) : -1,
              only_way = argc > 5 ? atoi(argv[5]) : -1;
    static double shortest[2][CASES], seconds[CASES];
    if (argc < 3) {
        fprintf(stderr, "usage: ways OURS THEIRS [ROUNDS [STATE [WAY]]]\n");
        return 2;
    }
    setenv("LP_NUM_THREADS", "0", 1);
    for (int r = 0; r < 2 * rounds; ++r) {
        int ends[2], status;
        if (pipe(ends) != 0) {
            return 2;
        }
        const pid_t child = fork();
        if (child == 0) {
            _exit(run_all(argv[1 + r % 2], ends[1], r / 2, only, only_way));
        }
        close(ends[1]);
        size_t got = 0;
        for (ssize_t n; (n = read(ends[0], (char *)seconds + got, sizeof seconds - got)) > 0;) {
            got += (size_t)n;
        }
        close(ends[0]);
        waitpid(child, &status, 0);
        if (got != sizeof seconds) {
            return 1;
        }
        for (int i = 0; i < CASES; ++i) {
            shortest[r % 2][i] = r < 2 || seconds[i] < shortest[r % 2][i] ? seconds[i] : shortest[r % 2][i];
        }
    }
    for (int s = 0; s < STATES; ++s) {
        for (int z = 0; z < SIZES && (only < 0 || s == only); ++z) {
            printf("\n%s, %s: ours in ms (theirs / ours)\n\n| way |", states[s].name, z == 0 ? "small" : "mid-size");
            for (int m = 0; m < MODES; ++m) {
                printf(" %s |", mode_names[m]);
            }
            printf("\n|---|---|---|---|---|---|\n");
            for (int w = 0; w < WAYS; ++w) {
                for (int l = 0; l < LISTS && (only_way < 0 || w == only_way); ++l) {
                    printf("| %s%s |", way_names[w], l == 1 ? ", list" : "");
                    for (int m = 0; m < MODES; ++m) {
                        const int k = ((((s * SIZES + z) * MODES + m) * WAYS) + w) * LISTS + l;
                        printf(" %.1f (%.1f) |", shortest[0][k] * 1e3, shortest[1][k] / shortest[0][k]);
                    }
                    printf("\n");
                }
            }
        }
    }
    return 0;
}
