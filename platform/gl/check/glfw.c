/* glfw.c: GLFW 3.3 with an OSMesa context: GLFW finds libOSMesa.so.8, makes a context, and looks the calls up by name.
 * Checks the framebuffer's pixels. Needs a display: run it with xvfb-run. */
#include <GL/gl.h>
#define GLFW_INCLUDE_NONE
#define GLFW_EXPOSE_NATIVE_OSMESA
#include <GLFW/glfw3.h>
#include <GLFW/glfw3native.h>
#include <stdio.h>
#include <string.h>

enum { WIDE = 64, HIGH = 48 };

static int same(const unsigned char *p, int r, int g, int b) { return p[0] == r && p[1] == g && p[2] == b; }

/* Calls of the library that GLFW loaded, not of one that this program is linked with. */
#define CALLS(X) \
    X(glGetString, const GLubyte *, (GLenum)) X(glClearColor, void, (GLclampf, GLclampf, GLclampf, GLclampf)) \
    X(glClear, void, (GLbitfield)) X(glColor3f, void, (GLfloat, GLfloat, GLfloat)) \
    X(glRectf, void, (GLfloat, GLfloat, GLfloat, GLfloat)) X(glFinish, void, (void))
#define POINTER(name, result, args) static result (*p_##name) args;
CALLS(POINTER)

int main(void)
{
    int wide, high, format;
    void *data;
    if (!glfwInit()) {
        fputs("glfw: no display\n", stderr);
        return 2;
    }
    glfwWindowHint(GLFW_CONTEXT_CREATION_API, GLFW_OSMESA_CONTEXT_API);
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    GLFWwindow *window = glfwCreateWindow(WIDE, HIGH, "test", NULL, NULL);
    if (window == NULL) {
        const char *why = "";
        glfwGetError(&why);
        fprintf(stderr, "glfw: no window: %s\n", why);
        return 1;
    }
    glfwMakeContextCurrent(window);
#define LOAD(name, result, args) \
    do { \
        GLFWglproc f = glfwGetProcAddress(#name); \
        memcpy(&p_##name, &f, sizeof f); \
    } while (0);
    CALLS(LOAD)
    const char *renderer = (const char *)p_glGetString(GL_RENDERER);
    p_glClearColor(0, 0, 1, 1);
    p_glClear(GL_COLOR_BUFFER_BIT);
    p_glColor3f(1, 0, 0);
    p_glRectf(-1, -1, 0, 0); /* the lower left quarter */
    p_glFinish();
    if (!glfwGetOSMesaColorBuffer(window, &wide, &high, &format, &data)) {
        fputs("glfw: no colour buffer\n", stderr);
        return 1;
    }
    const unsigned char *pixels = data;
    int wrong = strcmp(renderer, "lambent") != 0 || wide != WIDE || high != HIGH;
    for (int y = 0; y < HIGH && !wrong; ++y) {
        for (int x = 0; x < WIDE && !wrong; ++x) {
            const unsigned char *p = pixels + 4 * (y * WIDE + x);
            wrong = x < WIDE / 2 && y < HIGH / 2 ? !same(p, 255, 0, 0) : !same(p, 0, 0, 255);
        }
    }
    if (wrong) {
        fprintf(stderr, "glfw: other pixels, or another library: %s, %dx%d\n", renderer, wide, high);
    }
    glfwSwapBuffers(window);
    glfwTerminate();
    return wrong;
}
