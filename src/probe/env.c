/* env.c: a cube of light from far away: its levels, and lookups within a cone. Layer 5. [M14 M19 M22] */
#include <lambent/env.h>

#include <string.h>

#include "../base/half.h"
#include "../base/memory_check.h"
#include "cube.h"

#if LMB_MIXED || LMB_VOXELS || LMB_TREES

static int32_t level_count(int32_t size)
{
    int32_t levels = 1;
    while (size >> levels > 0) {
        ++levels;
    }
    return levels;
}

static int is_env_size(int32_t size)
{
    return size >= 1 && size <= 1 << (LMB_ENV_LEVELS - 1) && (size & (size - 1)) == 0;
}

size_t lmb_env_bytes(int32_t size)
{
    size_t texels = 0;
    if (!is_env_size(size)) {
        return 0;
    }
    for (int32_t n = size; n > 0; n /= 2) {
        texels += 6 * (size_t)n * (size_t)n;
    }
    return texels * 4 * sizeof(uint16_t);
}

lmb_status lmb_env_init(lmb_env *out, int32_t size, void *memory, size_t bytes)
{
    const size_t need = lmb_env_bytes(size);
    uint32_t at = 0;
    const lmb_status status = check_array(out, memory, bytes, need);
    if (status != LMB_OK) {
        return status;
    }
    memset(out, 0, sizeof *out);
    memset(memory, 0, need);
    out->texels = (uint16_t *)memory;
    out->size = size;
    out->levels = level_count(size);
    for (int32_t l = 0; l < out->levels; ++l) {
        const uint32_t n = (uint32_t)(size >> l);
        out->at[l] = at;
        at += 6 * n * n;
    }
    return LMB_OK;
}

static uint16_t *texel(const lmb_env *env, int32_t level, cube_place p)
{
    const int32_t n = env->size >> level;
    return env->texels + 4 * (env->at[level] + (size_t)((p.face * n + p.y) * n + p.x));
}

static int is_env_valid(const lmb_env *env) { return env != NULL && env->texels != NULL && is_env_size(env->size); }

void lmb_env_set(const lmb_env *env, int32_t face, int32_t x, int32_t y, const float rgb[3])
{
    const cube_place p = {face, x, y};
    if (!is_env_valid(env) || rgb == NULL || face < 0 || face > 5 || x < 0 || y < 0 || x >= env->size ||
        y >= env->size) {
        return;
    }
    uint16_t *to = texel(env, 0, p);
    for (int c = 0; c < 3; ++c) {
        to[c] = half_encode(rgb[c]);
    }
    to[3] = HALF_ONE;
}

static void halve_texel(const lmb_env *env, int32_t level, cube_place p)
{
    uint16_t *to = texel(env, level, p);
    for (int c = 0; c < 4; ++c) {
        float sum = 0.0f;
        for (int32_t k = 0; k < 4; ++k) {
            const cube_place from = {p.face, 2 * p.x + (k & 1), 2 * p.y + (k >> 1)};
            sum += half_decode(texel(env, level - 1, from)[c]);
        }
        to[c] = half_encode(0.25f * sum);
    }
}

void lmb_env_mips(const lmb_env *env)
{
    for (int32_t l = 1; is_env_valid(env) && l < env->levels; ++l) {
        const int32_t n = env->size >> l;
        for (int32_t i = 0; i < 6 * n * n; ++i) {
            halve_texel(env, l, cube_nth(i, n));
        }
    }
}

void lmb_env_dim(const lmb_env *out, const lmb_env *from, const float share[3])
{
    const int is_pair = is_env_valid(out) && is_env_valid(from) && share != NULL && out->size == from->size;
    const size_t texels = is_pair ? lmb_env_bytes(from->size) / (4 * sizeof(uint16_t)) : 0;
    for (size_t i = 0; i < 4 * texels; ++i) {
        out->texels[i] = i % 4 == 3 ? HALF_ONE : half_encode(half_decode(from->texels[i]) * share[i % 4]);
    }
}

/* --- cone lookups ------------------------------------------------------------------------------------------------- */

static void add_env_texel(float out[3], const lmb_env *env, int32_t level, cube_place p, float weight)
{
    const int32_t n = env->size >> level;
    const int inside = p.x >= 0 && p.y >= 0 && p.x < n && p.y < n;
    const uint16_t *from = texel(env, level, inside ? p : cube_border(p.face, p.x, p.y, n));
    for (int c = 0; c < 3; ++c) {
        out[c] += weight * half_decode(from[c]);
    }
}

static void sample_level(float out[3], const lmb_env *env, int32_t level, lmb_vec3 d, float weight)
{
    float s, t;
    const int32_t n = env->size >> level;
    const float length2 = dot3(d, d);
    if (!(length2 > 0.0f && length2 < 1e30f)) {
        d = vec3(0.0f, 0.0f, -1.0f); /* zero or not a number: ahead */
    }
    const int32_t face = cube_face(&s, &t, d);
    const float x = (s + 1.0f) * 0.5f * (float)n - 0.5f, y = (t + 1.0f) * 0.5f * (float)n - 0.5f;
    const float x0 = floorf(x), y0 = floorf(y);
    for (int32_t k = 0; k < 4; ++k) {
        const int32_t i = k & 1, j = k >> 1;
        const cube_place p = {face, (int32_t)x0 + i, (int32_t)y0 + j};
        const float wx = i ? x - x0 : 1.0f - (x - x0), wy = j ? y - y0 : 1.0f - (y - y0);
        add_env_texel(out, env, level, p, weight * (wx * wy));
    }
}

/* A face is 2 wide and the cone 2 tan_half, so a level with n texels a side fits if n tan_half = 1. Between two levels,
 * interpolates by the width, which needs no logarithm. */
void lmb_env_sample(float out[3], const lmb_env *env, lmb_vec3 direction, float tan_half)
{
    int32_t level = 0;
    if (out == NULL) {
        return;
    }
    out[0] = out[1] = out[2] = 0.0f;
    if (!is_env_valid(env)) {
        return;
    }
    float width = tan_half > 0.0f ? tan_half * (float)env->size : 0.0f;
    for (; width > 2.0f && level < env->levels - 1; ++level) {
        width *= 0.5f;
    }
    const float more = level < env->levels - 1 ? clampf(width - 1.0f, 0.0f, 1.0f) : 0.0f;
    sample_level(out, env, level, direction, 1.0f - more);
    if (more > 0.0f) {
        sample_level(out, env, level + 1, direction, more);
    }
}

#endif
