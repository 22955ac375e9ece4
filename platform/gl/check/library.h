/* library.h: an OSMesa library that a program loads, for speed.c and ways.c. Before you include it, define
 * CALLS(X), which names each call as X(name, result, arguments): p_NAME is then the library's. */
#ifndef CHECK_LIBRARY_H
#define CHECK_LIBRARY_H

#include <GL/osmesa.h>
#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

#define POINTER(name, result, args) static result (*p_##name) args;
CALLS(POINTER)

/* Makes a context with 24 bits of depth and 8 of stencil current. Returns 0 and prints a line if that fails. */
static int load_library(const char *program, const char *path, void *pixels, int width, int height, int names_it)
{
    OSMesaContext (*create)(GLenum, GLint, GLint, GLint, OSMesaContext);
    GLboolean (*make)(OSMesaContext, void *, GLenum, GLsizei, GLsizei);
    void *lib = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (lib == NULL) {
        fprintf(stderr, "%s: %s\n", program, dlerror());
        return 0;
    }
#define LOAD(pointer, name) do { void *f = dlsym(lib, name); memcpy(&pointer, &f, sizeof f); } while (0)
    LOAD(create, "OSMesaCreateContextExt");
    LOAD(make, "OSMesaMakeCurrent");
#define FIND(name, result, args) LOAD(p_##name, #name);
    CALLS(FIND)
    if (!make(create(GL_RGBA, 24, 8, 0, NULL), pixels, GL_UNSIGNED_BYTE, width, height)) {
        fprintf(stderr, "%s: %s makes no context\n", program, path);
        return 0;
    }
    if (names_it) {
        fprintf(stderr, "%s: %s\n", path, (const char *)p_glGetString(GL_RENDERER));
    }
    return 1;
}

#endif
