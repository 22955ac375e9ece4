/* full.c: lists that use up the memory of a context. The call that finds no room sets GL_OUT_OF_MEMORY; the list then
 * draws what was recorded, and the memory of deleted or replaced lists is reused. */
#define _XOPEN_SOURCE 600
#include <GL/osmesa.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>

enum { WIDE = 16, HIGH = 16, ROUNDS = 40, MOST = 40000000 };
static unsigned char pixels[WIDE * HIGH * 4];

static unsigned state = 1;

static unsigned random_below(unsigned past)
{
    state = state * 1664525u + 1013904223u;
    return (state >> 8) % past;
}

/* Records a triangle that covers the picture, and then vertices outside of glBegin until memory is used up: with `others`
 * with calls of several sizes in between. Returns the number of vertices. */
static int fill(GLuint list, int others)
{
    static const float at[3][2] = {{-1.1f, -1.1f}, {3.3f, -1.1f}, {-1.1f, 3.3f}};
    int vertices = 3;
    glNewList(list, GL_COMPILE);
    glColor3f(0, 1, 0);
    glBegin(GL_TRIANGLES);
    for (int i = 0; i < 3; ++i) {
        glVertex2fv(at[i]);
    }
    glEnd();
    for (; vertices < MOST && (vertices % 300 != 0 || glGetError() == GL_NO_ERROR); ++vertices) {
        if (others && random_below(2) != 0) {
            switch (random_below(3)) {
            case 0: glTexCoord2f(0, 1); break;
            case 1: glEdgeFlag(1); break;
            default: glNormal3f(0, 0, 1); break;
            }
        }
        glVertex2fv(at[vertices % 3]);
    }
    glEndList();
    return vertices;
}

int main(void)
{
    const struct rlimit limit = {(rlim_t)12 << 20, (rlim_t)12 << 20}; /* so a context has 8 MiB or less */
    int wrong = 0, low = MOST, high = 0;
    if (setrlimit(RLIMIT_AS, &limit) != 0) {
        return 1;
    }
    OSMesaContext c = OSMesaCreateContext(OSMESA_RGBA, NULL);
    if (c == NULL || !OSMesaMakeCurrent(c, pixels, GL_UNSIGNED_BYTE, WIDE, HIGH)) {
        fprintf(stderr, "no context\n");
        return 1;
    }
    for (int round = 0; round < ROUNDS; ++round) {
        const int vertices = fill(1, round % 4 != 0);
        if (round % 4 == 0) { /* lists of the same calls hold the same number */
            low = vertices < low ? vertices : low;
            high = vertices > high ? vertices : high;
        }
        glClear(GL_COLOR_BUFFER_BIT);
        glCallList(1);
        glFinish();
        while (glGetError() != GL_NO_ERROR) {
        }
        wrong += pixels[0] != 0 || pixels[1] != 255 || pixels[2] != 0;
        wrong += vertices < 10000 || vertices >= MOST;
        if (round % 8 != 3) { /* otherwise the next list replaces it */
            glDeleteLists(1, 1);
        }
    }
    wrong += low != high;
    if (wrong != 0) {
        fprintf(stderr, "%d wrong; %d to %d vertices\n", wrong, low, high);
    }
    OSMesaDestroyContext(c);
    return wrong != 0;
}
