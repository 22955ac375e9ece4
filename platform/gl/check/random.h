/* random.h: random numbers, a random GL_COMBINE and the hash of a picture, for alike.c and meshes.c. */
#ifndef CHECK_RANDOM_H
#define CHECK_RANDOM_H

#include <GL/osmesa.h>
#include <stdint.h>
#include <string.h>

static uint64_t seed;

static uint32_t any(uint32_t count)
{
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(seed >> 33) % count;
}
static float unit(void) { return (float)any(1 << 20) / (float)(1 << 20); }
static float between(float low, float high) { return low + (high - low) * unit(); }
static void enable(GLenum what, uint32_t one_in)
{
    if (any(one_in) == 0) {
        glEnable(what);
    }
}

/* Of the current unit; it may read the texels of units 0 and 1. */
static void set_combine(void)
{
    static const GLenum rgb[9] = {GL_MODULATE, GL_REPLACE, GL_ADD, GL_ADD_SIGNED, GL_INTERPOLATE, GL_SUBTRACT,
                                  GL_DOT3_RGB, GL_DOT3_RGBA, GL_MODULATE};
    static const GLenum from[7] = {GL_TEXTURE, GL_PRIMARY_COLOR, GL_PREVIOUS, GL_CONSTANT, GL_TEXTURE0, GL_TEXTURE1,
                                   GL_TEXTURE};
    static const GLenum how[4] = {GL_SRC_COLOR, GL_ONE_MINUS_SRC_COLOR, GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA};
    static const float scale[3] = {1, 2, 4};
    glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_COMBINE);
    glTexEnvi(GL_TEXTURE_ENV, GL_COMBINE_RGB, (GLint)rgb[any(9)]);
    glTexEnvi(GL_TEXTURE_ENV, GL_COMBINE_ALPHA, (GLint)rgb[any(6)]);
    for (int i = 0; i < 3; ++i) {
        glTexEnvi(GL_TEXTURE_ENV, (GLenum)(GL_SOURCE0_RGB + i), (GLint)from[any(7)]);
        glTexEnvi(GL_TEXTURE_ENV, (GLenum)(GL_SOURCE0_ALPHA + i), (GLint)from[any(7)]);
        glTexEnvi(GL_TEXTURE_ENV, (GLenum)(GL_OPERAND0_RGB + i), (GLint)how[any(4)]);
        glTexEnvi(GL_TEXTURE_ENV, (GLenum)(GL_OPERAND0_ALPHA + i), (GLint)how[2 + any(2)]);
    }
    glTexEnvf(GL_TEXTURE_ENV, GL_RGB_SCALE, scale[any(3)]);
    glTexEnvf(GL_TEXTURE_ENV, GL_ALPHA_SCALE, scale[any(3)]);
}

/* FNV-1a of bytes and of the bits of numbers. */
static uint64_t hash_picture(uint64_t hash, const unsigned char *bytes, size_t count, const float *depths, size_t numbers)
{
    for (size_t i = 0; i < count; ++i) {
        hash = (hash ^ bytes[i]) * 1099511628211u;
    }
    for (size_t i = 0; i < numbers; ++i) {
        uint32_t bits;
        memcpy(&bits, &depths[i], sizeof bits);
        hash = (hash ^ bits) * 1099511628211u;
    }
    return hash;
}

#endif
