/* envfold.c: folds the picture outwards, as light from unseen directions. Layer 6.      [M14-M19] */
#include "../base/poly.h"
#include "../base/vec.h"
#include "../probe/cube.h"
#include <lambent/mixed.h>

#if LMB_MIXED

#define INNER_THIRD 0.16666667f /* of the picture, from the middle to the edge of the middle third */

enum { SAMPLES_A_SIDE = 4 }; /* samples along each side of a texel */

/* Maps a direction in camera space to the picture, 0 .. 1 each way. The half width of the visible part grows from a
 * sixth at the front edge of a cube side to a half at the back edge. */
static void fold_direction(float *u, float *v, lmb_vec3 d)
{
    const float x = absf(d.x), y = absf(d.y), z = absf(d.z), far = maxf(maxf(x, y), z);
    const float m = z >= x && z >= y ? INNER_THIRD : INNER_THIRD + (1.0f + d.z / far) * INNER_THIRD;
    *u = 0.5f + d.x / far * m;
    *v = 0.5f - d.y / far * m;
}

static const float *photo_pixel(const float *rgb, int32_t width, int32_t height, float u, float v)
{
    const int32_t x = mini(maxi((int32_t)(u * (float)width), 0), width - 1),
                  y = mini(maxi((int32_t)(v * (float)height), 0), height - 1);
    return rgb + 3 * ((size_t)y * (size_t)width + (size_t)x);
}

/* A picture, and the rows of lmb_axes, which rotate scene space into camera space. */
typedef struct picture {
    const float *rgb;
    int32_t width, height;
    const lmb_axes *axes;
} picture;

static void fold_texel(float out[3], const lmb_env *env, const picture *from, cube_place at)
{
    const int32_t n = SAMPLES_A_SIDE * env->size;
    out[0] = out[1] = out[2] = 0.0f;
    for (int32_t k = 0; k < SAMPLES_A_SIDE * SAMPLES_A_SIDE; ++k) {
        float u, v;
        const int32_t x = SAMPLES_A_SIDE * at.x + k % SAMPLES_A_SIDE, y = SAMPLES_A_SIDE * at.y + k / SAMPLES_A_SIDE;
        const lmb_vec3 d = cube_point(at.face, cube_coordinate(x, n), cube_coordinate(y, n));
        fold_direction(&u, &v, vec3(dot3(from->axes->right, d), dot3(from->axes->up, d), dot3(from->axes->back, d)));
        const float *p = photo_pixel(from->rgb, from->width, from->height, u, v);
        for (int32_t c = 0; c < 3; ++c) {
            out[c] += p[c] > 0.0f && p[c] < 1e6f ? p[c] * (1.0f / (SAMPLES_A_SIDE * SAMPLES_A_SIDE)) : 0.0f;
        }
    }
}

/* Accepts any rotation of the camera, mirrored or not, but no zeros and no NaN. */
static int are_axes(const lmb_axes *a)
{
    const float right = dot3(a->right, a->right), up = dot3(a->up, a->up), back = dot3(a->back, a->back);
    return right > 0.5f && right < 2.0f && up > 0.5f && up < 2.0f && back > 0.5f && back < 2.0f;
}

lmb_status lmb_env_fold(const lmb_env *env, const float *rgb, int32_t width, int32_t height, const lmb_axes *axes)
{
    const picture from = {rgb, width, height, axes};
    if (env == NULL || env->texels == NULL || rgb == NULL || axes == NULL || !are_axes(axes) ||
        lmb_cloud_bytes(width, height) == 0) {
        return LMB_ERR_ARG;
    }
    const int32_t n = env->size;
    for (int32_t i = 0; i < 6 * n * n; ++i) {
        const cube_place at = cube_nth(i, n);
        float sum[3];
        fold_texel(sum, env, &from, at);
        lmb_env_set(env, at.face, at.x, at.y, sum);
    }
    lmb_env_mips(env);
    return LMB_OK;
}

/* --- irradiance --------------------------------------------------------------------------------------------------- */

void lmb_env_irradiance(float out[3], const lmb_env *env, lmb_vec3 normal)
{
    lmb_env_sample(out, env, normal, 1.0f);
    for (int32_t c = 0; c < 3 && out != NULL; ++c) {
        out[c] *= LMB_PI;
    }
}

#endif
