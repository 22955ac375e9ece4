/* bounced.c: GL_BOUNCED_LIGHT_LMB: shadows, bounced light, and hostile use of them. Prints hashes of pictures.
 *
 * rendered[] has the same room by `lambent render room.obj --size 96x72 --eye 0,0,3.2 --target 0,0,0 --fov 53.130102
 * --light point:.3,.8,.2:0,-1,0:1.0995574,1.0995574,1.0995574 --bounces 8 --quality best --world none -o room.pfm`:
 * means of blocks of 8 x 8 pixels, rows from the top. `bounced hash` only prints hashes. */
#define _XOPEN_SOURCE 600
#include <GL/osmesa.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

enum { WIDTH = 96, HEIGHT = 72, BLOCK = 8, ACROSS = WIDTH / BLOCK, DOWN = HEIGHT / BLOCK, BYTES = WIDTH * HEIGHT * 4 };
static const float rendered[DOWN * ACROSS][3] = {
#include "bounced.inc"
};
static unsigned char pixels[HEIGHT][WIDTH][4]; /* rows from the bottom */
static int wrong;

static void check(int good, const char *what)
{
    if (!good) {
        fprintf(stderr, "bounced: %s\n", what);
        wrong = 1;
    }
}

static void print_hash(const char *name)
{
    uint64_t hash = 14695981039346656037u;
    for (size_t i = 0; i < sizeof pixels; ++i) {
        hash = (hash ^ ((const unsigned char *)pixels)[i]) * 1099511628211u;
    }
    printf("%-10s %08lx%08lx\n", name, (unsigned long)(hash >> 32), (unsigned long)(hash & 0xffffffffu));
}

/* --- the room ----------------------------------------------------------------------------------------------------- */

static const float corner[6][4][3] = {
    {{-1, -1, 1}, {-1, -1, -1}, {-1, 1, -1}, {-1, 1, 1}}, {{1, -1, -1}, {1, -1, 1}, {1, 1, 1}, {1, 1, -1}},
    {{-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1}}, {{-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}},
    {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}}, {{1, -1, 1}, {-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}}};
static const float normal[6][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
static const float red[4] = {0.75f, 0.1f, 0.1f, 1}, green[4] = {0.1f, 0.6f, 0.1f, 1},
                   white[4] = {0.75f, 0.75f, 0.75f, 1};

enum { BY_LISTS, BY_BUFFERS, BY_STREAMS, BY_CALLS };
static GLuint lists, buffer;

static void side(int i, float inwards, int buffers)
{
    glNormal3f(inwards * normal[i][0], inwards * normal[i][1], inwards * normal[i][2]);
    if (buffers) {
        glDrawArrays(GL_QUADS, 4 * i, 4);
        return;
    }
    glBegin(GL_QUADS);
    for (int k = 0; k < 4; ++k) {
        glVertex3fv(corner[i][k]);
    }
    glEnd();
}

static void cube(int which, int buffers)
{
    for (int i = 0; i < (which == 0 ? 5 : 6); ++i) {
        glMaterialfv(GL_FRONT_AND_BACK, GL_DIFFUSE, which == 1 || i > 1 ? white : i == 0 ? red : green);
        side(i, which == 0 ? 1.0f : -1.0f, buffers);
    }
}

static void put(int which, int how)
{
    if (how == BY_LISTS) {
        glCallList(lists + (GLuint)which);
    } else {
        cube(which, how != BY_CALLS);
    }
}

/* View and light of a frame. */
typedef struct view {
    float turn, light_x, box_x;
    int spot, suns;
} view;

static void draw(int how, const view *v)
{
    const float at[4] = {v->light_x, 0.8f, 0.2f, 1}, sun[4] = {0.2f, 0.3f, 1, 0}, none[4] = {0, 0, 0, 1};
    const float light[4] = {0.35f, 0.35f, 0.35f, 1}, down[3] = {0, -1, 0};
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glLoadIdentity();
    glTranslatef(0, 0, -3.2f);
    glRotatef(v->turn, 0, 1, 0);
    glLightfv(GL_LIGHT0, GL_POSITION, v->suns ? sun : at);
    glLightfv(GL_LIGHT0, GL_DIFFUSE, light);
    glLightf(GL_LIGHT0, GL_CONSTANT_ATTENUATION, 0);
    glLightf(GL_LIGHT0, GL_QUADRATIC_ATTENUATION, 1);
    glLightf(GL_LIGHT0, GL_SPOT_CUTOFF, v->spot ? 45 : 180);
    glLightf(GL_LIGHT0, GL_SPOT_EXPONENT, v->spot ? 3 : 0);
    glLightfv(GL_LIGHT0, GL_SPOT_DIRECTION, down);
    glLightModelfv(GL_LIGHT_MODEL_AMBIENT, none);
    put(0, how);
    glTranslatef(v->box_x, -0.65f, -0.2f);
    glRotatef(25, 0, 1, 0);
    glScalef(0.3f, 0.35f, 0.3f);
    put(1, how);
    glFinish();
}

static OSMesaContext begin(int on, int how)
{
    OSMesaContext c = OSMesaCreateContextExt(OSMESA_RGBA, 24, 0, 0, NULL);
    if (c == NULL || !OSMesaMakeCurrent(c, pixels, GL_UNSIGNED_BYTE, WIDTH, HEIGHT)) {
        fprintf(stderr, "bounced: no context\n");
        exit(1);
    }
    glMatrixMode(GL_PROJECTION);
    glFrustum(-0.4, 0.4, -0.3, 0.3, 0.6, 20);
    glMatrixMode(GL_MODELVIEW);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_LIGHTING);
    glEnable(GL_LIGHT0);
    glEnable(GL_NORMALIZE);
    lists = glGenLists(2);
    for (GLuint i = 0; i < 2; ++i) {
        glNewList(lists + i, GL_COMPILE);
        cube((int)i, 0);
        glEndList();
    }
    glGenBuffers(1, &buffer);
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glBufferData(GL_ARRAY_BUFFER, sizeof corner, corner, how == BY_STREAMS ? GL_STREAM_DRAW : GL_STATIC_DRAW);
    glVertexPointer(3, GL_FLOAT, 0, NULL);
    glEnableClientState(GL_VERTEX_ARRAY);
    if (on) {
        glEnable(GL_BOUNCED_LIGHT_LMB);
    }
    check(glIsEnabled(GL_BOUNCED_LIGHT_LMB) == on, "glIsEnabled");
    return c;
}

static void end(OSMesaContext c)
{
    check(glGetError() == GL_NO_ERROR, "an error");
    OSMesaDestroyContext(c);
}

/* The picture of `frames` frames in a context of its own. */
static void picture(unsigned char *out, int on, int how, int frames, const view *v)
{
    OSMesaContext c = begin(on, how);
    for (int i = 0; i < frames; ++i) {
        draw(how, v);
    }
    memcpy(out, pixels, BYTES);
    end(c);
}

static int differ(const unsigned char *a, const unsigned char *b)
{
    int max = 0;
    for (int i = 0; i < BYTES; ++i) {
        const int d = a[i] > b[i] ? a[i] - b[i] : b[i] - a[i];
        max = d > max ? d : max;
    }
    return max;
}

/* Mean difference, codes. */
static double mean_differ(const unsigned char *a, const unsigned char *b)
{
    double sum = 0;
    for (int i = 0; i < BYTES; ++i) {
        sum += a[i] > b[i] ? a[i] - b[i] : b[i] - a[i];
    }
    return sum / BYTES;
}

/* --- checks ------------------------------------------------------------------------------------------------------- */

static unsigned char off[BYTES], lit[BYTES], other[BYTES];
static const view plain = {0, 0.3f, -0.35f, 0, 0};

/* Red, green, blue of a pixel, counted from the upper left corner of a picture of 320 x 240. */
static const unsigned char *pixel(const unsigned char *of, int x, int y)
{
    return of + 4 * ((HEIGHT - 1 - y * HEIGHT / 240) * WIDTH + x * WIDTH / 320);
}

static void looks(void)
{
    const unsigned char *shadow = pixel(lit, 97, 197), *floor = pixel(lit, 190, 196), *near_red = pixel(lit, 64, 222),
                        *near_green = pixel(lit, 256, 222), *ceiling = pixel(lit, 75, 20);
    check(5 * shadow[1] < floor[1], "a shadow");
    check(pixel(off, 97, 197)[1] * 5 > pixel(off, 190, 196)[1], "no shadow without it");
    check(near_red[0] * 20 > near_red[1] * 23 && near_green[1] * 20 > near_green[0] * 23, "colour on the floor");
    check(pixel(off, 64, 222)[0] == pixel(off, 64, 222)[1], "no colour without it");
    check(ceiling[0] > pixel(off, 75, 20)[0] + 10, "light on the ceiling");
    for (int i = 0; i < 12; ++i) { /* pixels with their middle on the edge from the red wall to the ceiling */
        const unsigned char *edge = lit + 4 * ((HEIGHT - 1 - 4 - i) * WIDTH + 16 + i);
        check(edge[0] * 4 > edge[8] * 3, "a pixel on an edge");
    }
}

/* Against lambent render: the means of blocks differ by at most 10 % of theirs and a code, their sum by 1 %. */
static void as_rendered(void)
{
    double sum[2] = {0, 0}, worst = 0;
    for (int b = 0; b < DOWN * ACROSS; ++b) {
        for (int k = 0; k < 3; ++k) {
            double mine = 0, theirs = rendered[b][k];
            for (int i = 0; i < BLOCK * BLOCK; ++i) {
                const int x = b % ACROSS * BLOCK + i % BLOCK, y = b / ACROSS * BLOCK + i / BLOCK;
                mine += lit[4 * ((HEIGHT - 1 - y) * WIDTH + x) + k] / 255.0 / (BLOCK * BLOCK);
            }
            if (theirs < 1) { /* no pixel is brighter than a code */
                const double d = fabs(mine - theirs) / (theirs + 1.0 / 255.0);
                worst = d > worst ? d : worst;
                sum[0] += mine;
                sum[1] += theirs;
            }
        }
    }
    if (getenv("VERBOSE") != NULL) {
        fprintf(stderr, "worst block %.3f, mean %.3f\n", worst, sum[0] / sum[1]);
    }
    check(worst < 0.1, "a block of the picture");
    check(fabs(sum[0] / sum[1] - 1) < 0.01, "the mean of the picture");
}

static void ways(void)
{
    picture(other, 1, BY_LISTS, 1, &plain);
    check(memcmp(off, other, BYTES) == 0, "the first frame is as without");
    picture(other, 1, BY_LISTS, 5, &plain);
    check(memcmp(lit, other, BYTES) == 0, "later frames");
    picture(other, 1, BY_BUFFERS, 2, &plain);
    check(memcmp(lit, other, BYTES) == 0, "static buffers");
    picture(other, 1, BY_STREAMS, 2, &plain);
    check(memcmp(off, other, BYTES) == 0, "other buffers are not static");
    picture(other, 1, BY_CALLS, 2, &plain);
    check(memcmp(off, other, BYTES) == 0, "immediate mode is not static");
}

/* Camera, light and box move. */
static void moves(void)
{
    const view turned = {20, 0.3f, -0.35f, 0, 0}, light = {0, -0.4f, -0.35f, 0, 0}, box = {0, 0.3f, 0.2f, 0, 0},
               spot = {0, 0.3f, -0.35f, 1, 0}, sun = {0, 0.3f, -0.35f, 0, 1};
    const view *const views[5] = {&turned, &light, &box, &spot, &sun};
    unsigned char alone[BYTES];
    for (int i = 0; i < 5; ++i) {
        picture(alone, 1, BY_LISTS, 2, views[i]);
        OSMesaContext c = begin(1, BY_LISTS);
        draw(BY_LISTS, &plain);
        draw(BY_LISTS, &plain);
        draw(BY_LISTS, views[i]);
        if (i == 0) { /* the scene stays where it was: only rounding differs */
            check(mean_differ(alone, pixels[0][0]) < 0.5, "a camera that turned");
        } else if (i != 2) {
            check(memcmp(alone, pixels, BYTES) == 0, "a light that moved");
        } else {
            draw(BY_LISTS, views[i]);
            check(memcmp(alone, pixels, BYTES) == 0, "a box that moved");
        }
        end(c);
        check(differ(alone, lit) > 20, "moves show");
    }
}

/* --- hostile use -------------------------------------------------------------------------------------------------- */

static void odd_order(void)
{
    OSMesaContext c = begin(0, BY_LISTS);
    glBegin(GL_TRIANGLES);
    glEnable(GL_BOUNCED_LIGHT_LMB);
    glEnd();
    check(glGetError() == GL_INVALID_OPERATION && !glIsEnabled(GL_BOUNCED_LIGHT_LMB), "glEnable in glBegin");
    glEnable(GL_BOUNCED_LIGHT_LMB);
    for (int i = 0; i < 3; ++i) { /* no lists */
        glClear(GL_COLOR_BUFFER_BIT);
    }
    draw(BY_LISTS, &plain);
    glDeleteLists(lists, 2); /* while the scene is of them; then buffers draw the same */
    draw(BY_BUFFERS, &plain);
    check(memcmp(lit, pixels, BYTES) == 0, "deleted lists");
    glDisable(GL_BOUNCED_LIGHT_LMB);
    draw(BY_BUFFERS, &plain);
    check(memcmp(off, pixels, BYTES) == 0, "off again");
    glEnable(GL_BOUNCED_LIGHT_LMB);
    draw(BY_BUFFERS, &plain);
    check(memcmp(lit, pixels, BYTES) == 0, "on again");
    glPushAttrib(GL_ENABLE_BIT);
    glDisable(GL_BOUNCED_LIGHT_LMB);
    glPopAttrib();
    check(glIsEnabled(GL_BOUNCED_LIGHT_LMB), "glPopAttrib");
    glDisable(GL_LIGHT0); /* no light */
    draw(BY_BUFFERS, &plain);
    memset(other, 0, sizeof other);
    for (int i = 3; i < BYTES; i += 4) {
        other[i] = ((unsigned char *)pixels)[i];
    }
    check(memcmp(other, pixels, BYTES) == 0, "no light");
    end(c);
}

static void odd_shapes(void)
{
    static const float odd[6] = {0, 1, NAN, INFINITY, 1e38f, -1e-38f};
    OSMesaContext c = begin(1, BY_LISTS);
    glNewList(lists, GL_COMPILE);
    for (int mode = GL_POINTS; mode <= GL_POLYGON; ++mode) {
        glBegin((GLenum)mode);
        for (int i = 0; i < 216; ++i) {
            glVertex3f(odd[i % 6], odd[i / 6 % 6], odd[i / 36]);
        }
        glEnd();
    }
    glEndList();
    for (int i = 0; i < 3; ++i) {
        draw(BY_LISTS, &plain);
    }
    glNewList(lists, GL_COMPILE); /* only triangles without area */
    glBegin(GL_TRIANGLES);
    for (int i = 0; i < 300; ++i) {
        glVertex3f(0, 0, 0);
    }
    glEnd();
    glEndList();
    for (int i = 0; i < 3; ++i) {
        glClear(GL_COLOR_BUFFER_BIT);
        glLoadIdentity();
        glCallList(lists);
        glScalef(0, 0, 0); /* no inverse */
        glCallList(lists);
    }
    const float far[4] = {1e30f, NAN, -INFINITY, 1}, zero[4] = {0, 0, 0, 0};
    for (int i = 0; i < 3; ++i) {
        glClear(GL_COLOR_BUFFER_BIT);
        glLightfv(GL_LIGHT0, GL_POSITION, i == 0 ? far : zero);
        glLightf(GL_LIGHT0, GL_CONSTANT_ATTENUATION, 0);
        glCallList(lists + 1);
    }
    end(c);
}

/* With little memory the picture is as without. */
static void full(void)
{
    struct rlimit was, few;
    if (getrlimit(RLIMIT_AS, &was) != 0) {
        return;
    }
    few = was;
    few.rlim_cur = (rlim_t)14 << 20;
    if (setrlimit(RLIMIT_AS, &few) != 0) {
        return;
    }
    OSMesaContext c = begin(1, BY_LISTS);
    (void)setrlimit(RLIMIT_AS, &was);
    draw(BY_LISTS, &plain);
    check(glGetError() == GL_NO_ERROR, "one frame fits");
    draw(BY_LISTS, &plain);
    check(glGetError() == GL_OUT_OF_MEMORY, "GL_OUT_OF_MEMORY");
    check(memcmp(off, pixels, BYTES) == 0, "no memory: as without");
    draw(BY_LISTS, &plain);
    check(glGetError() == GL_NO_ERROR && memcmp(off, pixels, BYTES) == 0, "no second error");
    glDisable(GL_BOUNCED_LIGHT_LMB);
    glEnable(GL_BOUNCED_LIGHT_LMB);
    draw(BY_LISTS, &plain);
    draw(BY_LISTS, &plain);
    check(glGetError() == GL_OUT_OF_MEMORY, "it tries again after glEnable");
    end(c);
}

int main(int argc, char **argv)
{
    static const view spot = {10, 0.3f, -0.3f, 1, 0};
    picture(lit, 1, BY_LISTS, 2, &plain);
    print_hash("room");
    picture(other, 1, BY_LISTS, 2, &spot);
    print_hash("spot");
    if (argc > 1 && strcmp(argv[1], "hash") == 0) {
        return wrong;
    }
    picture(off, 0, BY_LISTS, 2, &plain);
    looks();
    as_rendered();
    ways();
    moves();
    odd_order();
    odd_shapes();
    full();
    return wrong;
}
