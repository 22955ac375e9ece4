/* bounced.c: a room of OpenGL 1.x with shadows and bounced light: bounced OUT.ppm [off].
 *
 * The room and the box are display lists, so they are static. The first frame shows them to the library, the second one
 * is lit. */
#include <GL/osmesa.h>
#include <stdio.h>

enum { WIDTH = 320, HEIGHT = 240 };
static unsigned char pixels[HEIGHT][WIDTH][4];

/* Five or six sides of a cube with normals inwards (1) or outwards (-1). */
static void cube(float inwards, int sides, const float left[4], const float right[4], const float rest[4])
{
    static const float corner[6][4][3] = {
        {{-1, -1, 1}, {-1, -1, -1}, {-1, 1, -1}, {-1, 1, 1}}, {{1, -1, -1}, {1, -1, 1}, {1, 1, 1}, {1, 1, -1}},
        {{-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1}}, {{-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}},
        {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}}, {{1, -1, 1}, {-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}}};
    static const float normal[6][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (int i = 0; i < sides; ++i) {
        glMaterialfv(GL_FRONT_AND_BACK, GL_DIFFUSE, i == 0 ? left : i == 1 ? right : rest);
        glNormal3f(inwards * normal[i][0], inwards * normal[i][1], inwards * normal[i][2]);
        glBegin(GL_QUADS);
        for (int k = 0; k < 4; ++k) {
            glVertex3fv(corner[i][k]);
        }
        glEnd();
    }
}

static void frame(GLuint lists)
{
    static const float at[4] = {0.3f, 0.8f, 0.2f, 1}, light[4] = {0.45f, 0.43f, 0.38f, 1}, none[4] = {0, 0, 0, 1};
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glLoadIdentity();
    glTranslatef(0, 0, -3.2f); /* the camera */
    glLightfv(GL_LIGHT0, GL_POSITION, at);
    glLightfv(GL_LIGHT0, GL_DIFFUSE, light);
    glLightModelfv(GL_LIGHT_MODEL_AMBIENT, none);
    glCallList(lists);
    glTranslatef(-0.35f, -0.65f, -0.2f);
    glRotatef(25, 0, 1, 0);
    glScalef(0.3f, 0.35f, 0.3f);
    glCallList(lists + 1);
    glFinish();
}

int main(int argc, char **argv)
{
    static const float red[4] = {0.7f, 0.1f, 0.1f, 1}, green[4] = {0.1f, 0.6f, 0.1f, 1},
                       white[4] = {0.7f, 0.7f, 0.7f, 1};
    OSMesaContext context = OSMesaCreateContext(OSMESA_RGBA, NULL);
    if (!OSMesaMakeCurrent(context, pixels, GL_UNSIGNED_BYTE, WIDTH, HEIGHT)) {
        return 1;
    }
    glMatrixMode(GL_PROJECTION);
    glFrustum(-0.4, 0.4, -0.3, 0.3, 0.6, 20);
    glMatrixMode(GL_MODELVIEW);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_LIGHTING);
    glEnable(GL_LIGHT0);
    glEnable(GL_NORMALIZE);
    const GLuint lists = glGenLists(2);
    glNewList(lists, GL_COMPILE);
    cube(1, 5, red, green, white);
    glEndList();
    glNewList(lists + 1, GL_COMPILE);
    cube(-1, 6, white, white, white);
    glEndList();
    (argc < 3 ? glEnable : glDisable)(GL_BOUNCED_LIGHT_LMB);
    frame(lists);
    frame(lists);
    FILE *f = argc > 1 ? fopen(argv[1], "wb") : NULL;
    (void)(f != NULL && fprintf(f, "P6\n%d %d\n255\n", WIDTH, HEIGHT));
    for (int i = 0; f != NULL && i < HEIGHT * WIDTH; ++i) {
        (void)fwrite(pixels[HEIGHT - 1 - i / WIDTH][i % WIDTH], 1, 3, f);
    }
    OSMesaDestroyContext(context);
    return f == NULL || fclose(f) != 0;
}
