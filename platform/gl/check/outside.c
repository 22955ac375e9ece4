/* outside.c: batches at the edges of the view volume. The library drops a batch of triangles that is all outside. Each
 * batch is drawn twice: as triangles, and as polygons, which it never drops. The pictures are equal. */
#include <GL/osmesa.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { WIDE = 64, HIGH = 48, ROUNDS = 4000, CORNERS = 24 };
static unsigned char pixels[WIDE * HIGH * 4], first[WIDE * HIGH * 4];
static uint64_t state = 1;

static float uniform(float low, float high)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (float)(state >> 40) / 16777216.0f;
}

static void set_matrices(int round)
{
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    if (round % 3 == 0) {
        glOrtho(-1, 1, -1, 1, -1, 1);
    } else {
        glFrustum(-1, 1, -1, 1, 1, 1 + (double)uniform(1, 20));
    }
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glTranslatef(uniform(-1, 1), uniform(-1, 1), round % 3 == 0 ? 0 : uniform(-4, 0));
    glRotatef(uniform(0, 360), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
}

static void draw(float (*at)[4], int count, int polygons)
{
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    for (int i = 0; i < count; ++i) {
        if (i == 0 || (polygons && i % 3 == 0)) {
            glBegin(polygons ? GL_POLYGON : GL_TRIANGLES);
        }
        glColor3f(1, (float)i / CORNERS, 0.5f);
        glVertex4fv(at[i]);
        if (i == count - 1 || (polygons && i % 3 == 2)) {
            glEnd();
        }
    }
    glFinish();
}

int main(void)
{
    int wrong = 0, shown = 0;
    OSMesaContext c = OSMesaCreateContextExt(GL_RGBA, 24, 8, 0, NULL);
    if (c == NULL || !OSMesaMakeCurrent(c, pixels, GL_UNSIGNED_BYTE, WIDE, HIGH)) {
        return 2;
    }
    glEnable(GL_DEPTH_TEST);
    for (int round = 0; round < ROUNDS; ++round) {
        float at[CORNERS][4], eye[3], size = round % 5 == 0 ? 6.0f : uniform(0.05f, 0.8f);
        const int count = 3 * (1 + round % (CORNERS / 3)), far = round % 7 == 0;
        for (int k = 0; k < 3; ++k) {
            eye[k] = uniform(-2.5f, 2.5f) * (far ? 1000.0f : 1.0f);
        }
        for (int i = 0; i < count; ++i) {
            for (int k = 0; k < 3; ++k) {
                at[i][k] = eye[k] + size * uniform(-1, 1);
            }
            at[i][3] = round % 11 == 0 ? uniform(-0.5f, 2) : 1;
        }
        set_matrices(round);
        draw(at, count, 1);
        memcpy(first, pixels, sizeof first);
        draw(at, count, 0);
        int same = memcmp(first, pixels, sizeof first) == 0, any = 0;
        for (int i = 0; i < WIDE * HIGH; ++i) {
            any |= pixels[4 * i] != 0;
        }
        if (!same) {
            fprintf(stderr, "outside: round %d: other pixels\n", round);
        }
        wrong += !same;
        shown += any;
    }
    fprintf(stderr, "outside: %d of %d batches show\n", shown, ROUNDS);
    return wrong != 0 || shown < ROUNDS / 8 || shown > ROUNDS * 7 / 8;
}
