/* threads.c: two contexts in two threads draw the same picture at once; under the race detector, too. */
#include <GL/osmesa.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>

enum { SIDE = 64, BYTES = SIDE * SIDE * 4 };
static unsigned char pixels[2][2 * BYTES]; /* of each thread: the last picture, and the last one with bounced light */

static void *draw(void *at)
{
    unsigned char lit[BYTES] = {0};
    for (int round = 0; round < 20; ++round) {
        OSMesaContext c = OSMesaCreateContext(OSMESA_RGBA, NULL);
        if (c == NULL || !OSMesaMakeCurrent(c, at, GL_UNSIGNED_BYTE, SIDE, SIDE)) {
            return NULL;
        }
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glEnable(GL_DEPTH_TEST);
        glEnable(GL_FOG);
        glNewList(1, GL_COMPILE);
        glBegin(GL_TRIANGLES);
        for (int i = 0; i < 90; ++i) {
            glColor3f((float)(i % 7) / 7.0f, (float)(i % 5) / 5.0f, 1);
            glVertex3f((float)(i * 37 % 41) / 20.0f - 1.0f, (float)(i * 29 % 43) / 21.0f - 1.0f,
                       (float)(i % 11) / 11.0f);
        }
        glEnd();
        glEndList();
        glCallList(1);
        if (round % 10 == 0) { /* with bounced light: two frames */
            glDisable(GL_FOG);
            glEnable(GL_LIGHTING);
            glEnable(GL_LIGHT0);
            glEnable(GL_BOUNCED_LIGHT_LMB);
            for (int i = 0; i < 2; ++i) {
                glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
                glCallList(1);
            }
            memcpy(lit, at, sizeof lit);
        }
        glFinish();
        OSMesaDestroyContext(c);
    }
    memcpy((unsigned char *)at + BYTES, lit, sizeof lit);
    return at;
}

int main(void)
{
    pthread_t thread;
    void *other = NULL;
    if (pthread_create(&thread, NULL, draw, pixels[1]) != 0 || draw(pixels[0]) == NULL ||
        pthread_join(thread, &other) != 0 || other == NULL) {
        return 1;
    }
    return memcmp(pixels[0], pixels[1], sizeof pixels[0]) != 0;
}
