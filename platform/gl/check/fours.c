/* fours.c: lit vertices against the formula of OpenGL 1.x in binary64, within a code: highlights of any shininess,
 * normals to all sides, light over 1. Each pixel is one triangle. Normals are lit by fours (gl_four.h), and their count
 * is no multiple of four. */
#include <GL/osmesa.h>
#include <math.h>
#include <stdio.h>

enum { WIDE = 63, HIGH = 24 };
static unsigned char pixels[HIGH][WIDE][4];

/* The shininess of row `y`, and the way to the row's light. */
static float shininess_of(int y) { static const float all[6] = {0, 1, 7.5f, 30, 90, 128}; return all[y % 6]; }
static const float *way_of(int y)
{
    static const float all[4][4] = {{0, 0, 1, 0}, {0.48f, 0.6f, 0.64f, 0}, {0.6f, 0, -0.8f, 0}, {-0.8f, 0.6f, 0, 0}};
    return all[y / 6];
}

static void normal_of(float n[3], int x, int y)
{
    const double a = 0.1 * x + y, h = 2 * (x * 29 % WIDE) / (WIDE - 1.0) - 1, r = sqrt(1 - h * h);
    n[0] = (float)(r * cos(a));
    n[1] = (float)(r * sin(a));
    n[2] = (float)h;
}

static const double DIFFUSE[3] = {0.5, 1.5, 0.25}, SPECULAR[3] = {0.75, 0.125, 1};

static int code_of(int x, int y, int c)
{
    const float *to = way_of(y);
    float n[3];
    normal_of(n, x, y);
    const double half[3] = {to[0], to[1], to[2] + 1.0},
                 length = sqrt(half[0] * half[0] + half[1] * half[1] + half[2] * half[2]);
    const double facing = (double)n[0] * to[0] + (double)n[1] * to[1] + (double)n[2] * to[2];
    const double cosine = (n[0] * half[0] + n[1] * half[1] + n[2] * half[2]) / length;
    double v = 0;
    if (facing > 0) {
        v = DIFFUSE[c] * facing + SPECULAR[c] * pow(cosine > 0 ? cosine : 0, (double)shininess_of(y));
    }
    return (int)(255 * (v > 1 ? 1 : v) + 0.5);
}

static void draw(void)
{
    static const float none[4] = {0, 0, 0, 1}, diffuse[4] = {0.5f, 1.5f, 0.25f, 1}, specular[4] = {0.75f, 0.125f, 1, 1};
    glMatrixMode(GL_PROJECTION);
    glOrtho(0, WIDE, 0, HIGH, -1, 1);
    glMatrixMode(GL_MODELVIEW);
    glEnable(GL_LIGHTING);
    glEnable(GL_LIGHT0);
    glLightModelfv(GL_LIGHT_MODEL_AMBIENT, none);
    glLightfv(GL_LIGHT0, GL_DIFFUSE, diffuse);
    glLightfv(GL_LIGHT0, GL_SPECULAR, specular);
    glMaterialfv(GL_FRONT, GL_AMBIENT, none);
    for (int c = 0; c < 2; ++c) {
        static const float white[4] = {1, 1, 1, 1};
        glMaterialfv(GL_FRONT, c == 0 ? GL_DIFFUSE : GL_SPECULAR, white);
    }
    for (int y = 0; y < HIGH; ++y) {
        glMaterialf(GL_FRONT, GL_SHININESS, shininess_of(y));
        glLightfv(GL_LIGHT0, GL_POSITION, way_of(y));
        glBegin(GL_TRIANGLES); /* filled, because vertices of points are lit one by one */
        for (int x = 0; x < WIDE; ++x) {
            float n[3];
            normal_of(n, x, y);
            glNormal3fv(n);
            glVertex2f((float)x + 0.1f, (float)y + 0.1f);
            glVertex2f((float)x + 1.3f, (float)y + 0.1f);
            glVertex2f((float)x + 0.1f, (float)y + 1.3f);
        }
        glEnd();
        glFinish(); /* vertices that wait when the material changes are lit one by one */
    }
}

int main(void)
{
    OSMesaContext context = OSMesaCreateContext(OSMESA_RGBA, NULL);
    int wrong = 0;
    if (context == NULL || !OSMesaMakeCurrent(context, pixels, GL_UNSIGNED_BYTE, WIDE, HIGH)) {
        return 1;
    }
    draw();
    for (int i = 0; i < 3 * WIDE * HIGH; ++i) {
        const int x = i / 3 % WIDE, y = i / 3 / WIDE, c = i % 3, is = pixels[y][x][c], want = code_of(x, y, c);
        if (is < want - 1 || is > want + 1) {
            if (wrong++ < 10) {
                fprintf(stderr, "fours: pixel %d of row %d, channel %d: %d, not %d\n", x, y, c, is, want);
            }
        }
    }
    OSMesaDestroyContext(context);
    return wrong > 0;
}
