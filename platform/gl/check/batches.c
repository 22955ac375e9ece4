/* batches.c: draws that wait in one batch. A draw's pixels do not depend on others, batches that are full take no more
 * vertices, and GL_COLOR_MATERIAL follows the current colour whatever is drawn. */
#include <GL/osmesa.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { SIDE = 96, SMALL = 64, VERTICES = 400, NUMBERS = 80000 };
static unsigned char pixels[3][SIDE * SIDE * 4];
static uint64_t seed;
static int wrong;

static float between(float low, float high)
{
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (float)(seed >> 40) / 16777216.0f;
}

/* --- neighbours --------------------------------------------------------------------------------------------------- */

/* Place, colour, coordinates. */
static float mesh[VERTICES][8];
/* Places outside of the picture, coordinates of which q is not 1. */
static const float far_mesh[4][8] = {{9, 9, 0, 0, 0, 0, 0, 2}, {9.1f, 9, 0, 0, 1, 0, 0, 2},
                                     {9, 9.1f, 0, 0, 0, 1, 0, 1}, {9.1f, 9.1f, 0, 0, 1, 1, 0, 3}};

/* how: 0 glBegin, 1 arrays, 2 indices. */
static void draw(GLenum mode, const float (*v)[8], int count, int coordinates, int how)
{
    static unsigned index[VERTICES];
    const int at = coordinates == 4 ? 4 : 6;
    if (how == 0) {
        glBegin(mode);
        for (int i = 0; i < count; ++i) {
            if (coordinates == 2) {
                glColor3fv(&v[i][3]);
                glTexCoord2fv(&v[i][at]);
            } else {
                glTexCoord4fv(&v[i][at]);
            }
            glVertex3fv(v[i]);
        }
        glEnd();
        return;
    }
    for (int i = 0; i < count; ++i) {
        index[i] = (unsigned)i;
    }
    glVertexPointer(3, GL_FLOAT, sizeof *v, v);
    glTexCoordPointer(coordinates, GL_FLOAT, sizeof *v, &v[0][at]);
    glColorPointer(3, GL_FLOAT, sizeof *v, &v[0][3]);
    glEnableClientState(GL_VERTEX_ARRAY);
    glEnableClientState(GL_TEXTURE_COORD_ARRAY);
    if (coordinates == 2) {
        glEnableClientState(GL_COLOR_ARRAY);
    }
    if (how == 1) {
        glDrawArrays(mode, 0, count);
    } else {
        glDrawElements(mode, count, GL_UNSIGNED_INT, index);
    }
    glDisableClientState(GL_VERTEX_ARRAY);
    glDisableClientState(GL_TEXTURE_COORD_ARRAY);
    glDisableClientState(GL_COLOR_ARRAY);
}

/* neighbour: 0 none, 1 before, 2 after the mesh. */
static void draw_mesh(GLenum mode, int how, int near_how, int neighbour, int filter)
{
    static unsigned char texels[32 * 32 * 4];
    OSMesaContext context = OSMesaCreateContextExt(GL_RGBA, 24, 8, 0, NULL);
    if (context == NULL || !OSMesaMakeCurrent(context, pixels[neighbour], GL_UNSIGNED_BYTE, SIDE, SIDE)) {
        ++wrong;
        return;
    }
    seed = mode + 5;
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    for (size_t i = 0; i < sizeof texels; ++i) {
        texels[i] = (unsigned char)between(0, 255);
    }
    for (int i = 0; i < VERTICES; ++i) {
        for (int k = 0; k < 8; ++k) {
            mesh[i][k] = k < 2 ? between(-2, 2) : k == 2 ? between(-6, -2) : between(0, 1);
        }
    }
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 32, 32, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
    glEnable(GL_TEXTURE_2D);
    glFrustum(-0.5, 0.5, -0.5, 0.5, 1, 9);
    if (neighbour == 1) {
        draw(mode, far_mesh, mode == GL_TRIANGLES ? 3 : 4, 4, near_how);
    }
    draw(mode, (const float(*)[8])mesh, 120, 2, how);
    if (neighbour == 2) {
        draw(mode, far_mesh, mode == GL_TRIANGLES ? 3 : 4, 4, near_how);
    }
    glFinish();
    OSMesaDestroyContext(context);
}

static void check_neighbours(void)
{
    static const GLenum modes[8] = {GL_POINTS, GL_LINES, GL_LINE_STRIP, GL_TRIANGLES, GL_TRIANGLE_STRIP,
                                    GL_TRIANGLE_FAN, GL_QUADS, GL_QUAD_STRIP};
    for (int k = 0; k < 8 * 9 * 2; ++k) {
        const GLenum mode = modes[k % 8];
        const int how = k / 8 % 3, near_how = k / 24 % 3, filter = k < 72 ? GL_NEAREST : GL_LINEAR;
        for (int neighbour = 0; neighbour < 3; ++neighbour) {
            draw_mesh(mode, how, near_how, neighbour, filter);
            if (memcmp(pixels[neighbour], pixels[0], sizeof pixels[0]) != 0) {
                ++wrong;
                fprintf(stderr, "batches: mode %u by %d, neighbour %d by %d\n", (unsigned)mode, how, neighbour,
                        near_how);
            }
        }
    }
}

/* --- a full batch ------------------------------------------------------------------------------------------------- */

/* Quads that share no vertex, as their numbers share a place in the library's table, then a strip by glBegin. */
static void check_full(void)
{
    static float at[NUMBERS][3];
    static const unsigned index[4] = {0, 8192, 16384, 24576};
    OSMesaContext context = OSMesaCreateContextExt(GL_RGBA, 24, 8, 0, NULL);
    unsigned char(*const to)[SMALL * SMALL * 4] = (void *)pixels;
    for (int way = 0; way < 2 && context != NULL; ++way) {
        wrong += !OSMesaMakeCurrent(context, to[way], GL_UNSIGNED_BYTE, SMALL, SMALL);
        glClear(GL_COLOR_BUFFER_BIT);
        glVertexPointer(3, GL_FLOAT, 0, at);
        glEnableClientState(GL_VERTEX_ARRAY);
        for (int n = 0; n < 1023; ++n) { /* 4092 vertices */
            glDrawElements(GL_QUAD_STRIP, 4, GL_UNSIGNED_INT, index);
        }
        if (way == 1) {
            glFinish();
        }
        for (int run = 0; run < 3; ++run) {
            glBegin(GL_QUAD_STRIP);
            for (int i = 0; i < 9000; ++i) {
                glColor3f((float)(i % 11) / 11.0f, (float)run / 3.0f, 1);
                glVertex3f((float)(i % 7) / 7.0f, (float)(i % 5) / 5.0f, 0);
            }
            glEnd();
        }
        glFinish();
    }
    wrong += context == NULL || glGetError() != GL_NO_ERROR;
    if (memcmp(to[0], to[1], sizeof to[0]) != 0) {
        ++wrong;
        fprintf(stderr, "batches: a full batch\n");
    }
    OSMesaDestroyContext(context);
}

/* --- the tracked colour ------------------------------------------------------------------------------------------- */

static void expect(int step, float r, float g, float b)
{
    float got[4];
    glGetMaterialfv(GL_FRONT, GL_DIFFUSE, got);
    if (got[0] != r || got[1] != g || got[2] != b) {
        ++wrong;
        fprintf(stderr, "batches: colour %d is %g %g %g\n", step, (double)got[0], (double)got[1], (double)got[2]);
    }
    glEnable(GL_COLOR_MATERIAL);
}

static void triangle(GLenum mode, float x)
{
    glBegin(mode);
    glVertex2f(x - 1, -1);
    glVertex2f(x + 1, -1);
    glVertex2f(x, 1);
    glEnd();
}

static void check_colours(void)
{
    static const float at[3][2] = {{-1, -1}, {1, -1}, {0, 1}}, colours[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    static const unsigned index[6] = {0, 1, 2, 2, 1, 0};
    OSMesaContext context = OSMesaCreateContextExt(GL_RGBA, 24, 8, 0, NULL);
    if (context == NULL || !OSMesaMakeCurrent(context, pixels, GL_UNSIGNED_BYTE, SMALL, SMALL)) {
        ++wrong;
        return;
    }
    glEnable(GL_LIGHTING);
    glEnable(GL_LIGHT0);
    glColorMaterial(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE);
    glEnable(GL_COLOR_MATERIAL);
    glColor3f(1, 0, 0); /* nothing is drawn */
    glDisable(GL_COLOR_MATERIAL);
    glColor3f(0, 1, 0);
    expect(1, 1, 0, 0);
    glColor3f(0, 0, 1); /* outside of the picture */
    triangle(GL_TRIANGLES, 50);
    glDisable(GL_COLOR_MATERIAL);
    expect(2, 0, 0, 1);
    triangle(GL_TRIANGLES, 0); /* a colour after the last vertex */
    glColor3f(0, 1, 1);
    glDisable(GL_COLOR_MATERIAL);
    expect(3, 0, 1, 1);
    glColor3f(1, 0, 1);
    glColorMaterial(GL_FRONT_AND_BACK, GL_SPECULAR);
    glColor3f(0, 0, 0);
    glDisable(GL_COLOR_MATERIAL);
    expect(4, 1, 0, 1);
    glColorMaterial(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE);
    glColor3f(0.5f, 0, 0); /* the material that is saved */
    glPushAttrib(GL_LIGHTING_BIT);
    glDisable(GL_COLOR_MATERIAL);
    glColor3f(0, 0.5f, 0);
    glPopAttrib();
    glPushAttrib(GL_CURRENT_BIT);
    glColor3f(0.25f, 0, 0);
    glDisable(GL_COLOR_MATERIAL);
    glPopAttrib();
    expect(5, 0.25f, 0, 0);
    glDisable(GL_COLOR_MATERIAL);
    expect(6, 0, 0.5f, 0);
    glColor3f(0.75f, 0, 0);
    glPushAttrib(GL_LIGHTING_BIT);
    glColor3f(0, 0.75f, 0);
    glDisable(GL_COLOR_MATERIAL);
    glPopAttrib();
    glColor3f(0, 0, 0.75f);
    glDisable(GL_COLOR_MATERIAL);
    expect(7, 0, 0, 0.75f);
    glDisable(GL_COLOR_MATERIAL); /* the popped bits end the tracking */
    glPushAttrib(GL_ENABLE_BIT);
    glEnable(GL_COLOR_MATERIAL);
    glColor3f(0.125f, 0, 0);
    glPopAttrib();
    glColor3f(0.375f, 0, 0);
    expect(8, 0.125f, 0, 0);
    glColor3f(0, 0.125f, 0); /* a material of that name has no effect */
    glMaterialfv(GL_FRONT_AND_BACK, GL_DIFFUSE, colours[0]);
    glDisable(GL_COLOR_MATERIAL);
    expect(9, 0, 0.125f, 0);
    glVertexPointer(2, GL_FLOAT, 0, at);
    glColorPointer(3, GL_FLOAT, 0, colours);
    glEnableClientState(GL_VERTEX_ARRAY);
    glEnableClientState(GL_COLOR_ARRAY);
    glDrawElements(GL_TRIANGLE_STRIP, 6, GL_UNSIGNED_INT, index);
    glColor3f(0, 0.625f, 0);
    triangle(GL_TRIANGLE_STRIP, 0);
    glDisable(GL_COLOR_MATERIAL);
    expect(10, 0, 0.625f, 0);
    wrong += glGetError() != GL_NO_ERROR;
    OSMesaDestroyContext(context);
}

int main(void)
{
    check_neighbours();
    check_full();
    check_colours();
    return wrong > 0;
}
