/* random.h: random numbers and the hash of a picture, for alike.c and meshes.c. */
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
