/* glu.c: Debian's GLU on our library: a sphere, and a polygon with a hole that GLU cuts into triangles. */
#include <GL/glu.h>
#include <GL/osmesa.h>
#include <stdio.h>

enum { SIDE = 64 };
static unsigned char pixels[SIDE][SIDE][4];

static int count(int channel)
{
    int n = 0;
    for (int i = 0; i < SIDE * SIDE; ++i) {
        n += pixels[i / SIDE][i % SIDE][channel] > 100;
    }
    return n;
}

static void draw_hole(void)
{
    static GLdouble at[8][3] = {{8, 8, 0},   {56, 8, 0},  {56, 56, 0}, {8, 56, 0},
                                {24, 24, 0}, {24, 40, 0}, {40, 40, 0}, {40, 24, 0}};
    GLUtesselator *t = gluNewTess();
    gluTessCallback(t, GLU_TESS_BEGIN, (_GLUfuncptr)glBegin);
    gluTessCallback(t, GLU_TESS_VERTEX, (_GLUfuncptr)glVertex3dv);
    gluTessCallback(t, GLU_TESS_END, (_GLUfuncptr)glEnd);
    gluTessBeginPolygon(t, NULL);
    for (int i = 0; i < 8; ++i) {
        if (i % 4 == 0) {
            gluTessBeginContour(t);
        }
        gluTessVertex(t, at[i], at[i]);
        if (i % 4 == 3) {
            gluTessEndContour(t);
        }
    }
    gluTessEndPolygon(t);
    gluDeleteTess(t);
}

int main(void)
{
    OSMesaContext c = OSMesaCreateContext(OSMESA_RGBA, NULL);
    if (c == NULL || !OSMesaMakeCurrent(c, pixels, GL_UNSIGNED_BYTE, SIDE, SIDE)) {
        return 1;
    }
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glMatrixMode(GL_PROJECTION);
    gluOrtho2D(0, SIDE, 0, SIDE);
    glColor3f(1, 0, 0);
    draw_hole();
    glFinish();
    const int hole = count(0), expected = 48 * 48 - 16 * 16;
    glClear(GL_COLOR_BUFFER_BIT);
    glLoadIdentity();
    glOrtho(-1, 1, -1, 1, -2, 2);
    glColor3f(0, 1, 0);
    GLUquadric *q = gluNewQuadric();
    gluSphere(q, 0.8, 64, 32);
    gluDeleteQuadric(q);
    glFinish();
    const int sphere = count(1); /* pi 0.8^2 of the window's area of 4, times the number of pixels: 2,058 */
    const GLenum error = glGetError();
    OSMesaDestroyContext(c);
    if (hole != expected || sphere < 2030 || sphere > 2070 || error != GL_NO_ERROR) {
        printf("glu: a hole leaves %d pixels, not %d; a sphere has %d, not 2030 .. 2070; error %u\n", hole, expected,
               sphere, error);
        return 1;
    }
    return 0;
}
