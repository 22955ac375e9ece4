/* mix_mirror.c: reflections in the object's metal: the photo's surfaces with the object, and planes. [M20] */
#include "mix_mirror.h"

#include <math.h>
#include <string.h>

#include "mix_lights.h"
#include "mix_sources.h"

#define PI 3.14159265f

enum { RAYS = 12, STEPS = 72, HALVINGS = 5, LIGHTS = 8 /* samples of a guessed sun that are evaluated */ };

#define FIRST  0.01f /* m: length of the first step; GROWTH is the factor from step to step */
#define GROWTH 1.12f
#define BEHIND 0.05f /* m, plus two steps: a ray that lies farther behind a surface passes it */
#define CLIPPED 0.98f /* clipped pixels are at least this bright; the lights give their value */
#define WALL   1.0f  /* m2: minimum area of planes that are continued beyond the photo */
#define SPACE  0.5f  /* m: minimum distance of walls from lamps and from the camera */
#define UPRIGHT 0.25881905f

static lmb_vec3 plus(lmb_vec3 a, lmb_vec3 b, float s)
{
    const lmb_vec3 out = {a.x + b.x * s, a.y + b.y * s, a.z + b.z * s};
    return out;
}

static float dot(lmb_vec3 a, lmb_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

static lmb_vec3 unit(lmb_vec3 a)
{
    const lmb_vec3 zero = {0, 0, 0};
    return plus(zero, a, 1.0f / sqrtf(fmaxf(dot(a, a), 1e-30f)));
}

static lmb_vec3 to_camera(const mix_job *j, lmb_vec3 v)
{
    const lmb_vec3 out = {dot(j->axes.right, v), dot(j->axes.up, v), dot(j->axes.back, v)};
    return out;
}

/* --- planes ------------------------------------------------------------------------------------------------------- */

static void widen(mix_space *r, lmb_vec3 p, float by)
{
    for (int i = 0; i < 3; ++i) {
        r->low[i] = fminf(r->low[i], dot(r->axis[i], p) - by);
        r->high[i] = fmaxf(r->high[i], dot(r->axis[i], p) + by);
    }
}

static void turn_room(mix_space *r, lmb_vec3 wall)
{
    const lmb_vec3 up = {0, 1, 0}, z = unit((lmb_vec3){wall.x, 0, wall.z}), x = {z.z, 0, -z.x};
    r->axis[0] = x;
    r->axis[1] = up;
    r->axis[2] = z;
}

/* Estimates the room: a box around all measured surfaces, the lamps and the camera, with walls as those seen. Given
 * lamps light surfaces that the photo does not show, and the environment lacks this light. */
static void find_room(mix_job *j)
{
    mix_space *r = &j->room;
    const lmb_vec3 eye = {0, 0, 0}, back = {0, 0, 1};
    float area = 0.0f;
    memset(r, 0, sizeof *r);
    turn_room(r, back);
    for (int32_t p = 0; p < j->planes.count; ++p) {
        const lmb_vec3 n = lmb_axes_turn(&j->axes, j->planes.plane[p].normal);
        const lmb_flat *f = &j->planes.plane[p];
        const float one = (f->high[0] - f->low[0]) * (f->high[1] - f->low[1]);
        if (fabsf(n.y) < UPRIGHT) {
            if (!(area > 0.0f)) { /* planes are sorted by area in the picture */
                turn_room(r, n);
            }
            area += one;
            for (int c = 0; c < 3; ++c) {
                r->albedo[c] += one * j->plane_albedo[p][c];
            }
        }
    }
    for (int c = 0; c < 3; ++c) {
        r->albedo[c] /= fmaxf(area, 1e-9f);
    }
    widen(r, eye, SPACE);
    for (int32_t i = 0; i < j->light_count - j->lamp_count; ++i) {
        if (j->lights[i].kind != LMB_LIGHT_DIRECTIONAL) {
            widen(r, j->lights[i].position, SPACE);
            r->is_known = area > 0.0f && j->o.world == NULL;
        }
    }
    for (int32_t k = 0; k < 4 * j->real.count; ++k) {
        const float *at = j->real.positions + 3 * (size_t)k;
        widen(r, (lmb_vec3){at[0], at[1], at[2]}, 0.0f);
    }
}

/* The distance at which a scene-space ray leaves the room, and the normal of the wall there. */
static float leave_room(lmb_vec3 *normal, const mix_space *r, lmb_vec3 from, lmb_vec3 along)
{
    float far = INFINITY;
    for (int i = 0; i < 3; i += 2) { /* lamps hang too near to a ceiling to estimate it */
        const float d = dot(r->axis[i], along), p = dot(r->axis[i], from),
                    t = fabsf(d) > 1e-6f ? ((d > 0.0f ? r->high[i] : r->low[i]) - p) / d : INFINITY;
        if (t < far) {
            const lmb_vec3 zero = {0, 0, 0};
            far = t;
            *normal = plus(zero, r->axis[i], d > 0.0f ? -1.0f : 1.0f);
        }
    }
    return far;
}

void mix_mirror_planes(mix_job *j)
{
    float sum[LMB_MAX_PLANES][4];
    lmb_vec3 low, high;
    mix_object_box(&low, &high, j);
    j->ball_at = (lmb_vec3){0.5f * (low.x + high.x), 0.5f * (low.y + high.y), 0.5f * (low.z + high.z)};
    j->ball_radius = 0.5f * cbrtf((high.x - low.x) * (high.y - low.y) * (high.z - low.z));
    memset(sum, 0, sizeof sum);
    for (int32_t c = 0; c < j->real.count; ++c) {
        for (int i = 0; i < 4 && j->real.label[c] > 0; ++i) {
            sum[j->real.label[c] - 1][i] += i < 3 ? (float)j->real.colours[16 * c + i] * (1.0f / 255.0f) : 1.0f;
        }
    }
    for (int32_t p = 0; p < LMB_MAX_PLANES; ++p) {
        for (int c = 0; c < 3; ++c) {
            j->plane_albedo[p][c] = sum[p][3] > 0.0f ? sum[p][c] / sum[p][3] : 0.0f;
        }
    }
    find_room(j);
}

/* The nearest large plane that a ray meets, all in camera space; -1: none. */
static int32_t plane_ahead(lmb_vec3 *at, const mix_job *j, lmb_vec3 from, lmb_vec3 along)
{
    int32_t best = -1;
    float near = INFINITY;
    *at = from;
    for (int32_t i = 0; i < j->planes.count; ++i) {
        const lmb_flat *p = &j->planes.plane[i];
        const float facing = dot(p->normal, along), far = -(dot(p->normal, from) + p->distance) / facing,
                    area = (p->high[0] - p->low[0]) * (p->high[1] - p->low[1]);
        if (facing < -1e-4f && far > 0.0f && far < near && area > WALL) {
            near = far;
            best = i;
            *at = plus(from, along, far);
        }
    }
    return best;
}

/* Adds the irradiance of given lamps at a place in scene space, W/m2, without occlusion. */
static void add_told(float inout[3], const mix_job *j, lmb_vec3 at, lmb_vec3 normal)
{
    for (int32_t i = 0; i < j->light_count - j->lamp_count; ++i) {
        const lmb_light *l = &j->lights[i];
        const lmb_vec3 to = plus(l->position, at, -1.0f), way = unit(to);
        const float cosine = dot(normal, way);
        if (l->kind == LMB_LIGHT_DIRECTIONAL || !(cosine > 0.0f)) {
            continue;
        }
        float t = l->kind == LMB_LIGHT_SPOT
                      ? (-dot(way, l->direction) - l->cos_outer) / fmaxf(l->cos_inner - l->cos_outer, 1e-6f) : 1.0f;
        t = fminf(fmaxf(t, 0.0f), 1.0f);
        for (int c = 0; c < 3; ++c) {
            inout[c] += l->intensity[c] * t * t * (3.0f - 2.0f * t) * cosine / fmaxf(dot(to, to), 1e-6f);
        }
    }
}

/* The radiance of a surface under the lamps and the environment. */
static void send_back(float out[3], const mix_job *j, lmb_vec3 at, lmb_vec3 normal, const float albedo[3])
{
    lmb_env_irradiance(out, &j->env[1], normal);
    add_told(out, j, at, normal);
    for (int c = 0; c < 3; ++c) {
        out[c] *= albedo[c] * (1.0f / PI);
    }
}

/* Radiance from beyond the photo: a plane continued in the mean colour, a wall of the room if nearer, or the
 * environment. */
static void unseen(float out[3], const mix_job *j, lmb_vec3 from, lmb_vec3 along, lmb_vec3 direction, float tangent)
{
    lmb_vec3 at, wall = {0, 1, 0};
    const int32_t p = plane_ahead(&at, j, from, along);
    const lmb_vec3 here = lmb_axes_turn(&j->axes, from), off = plus(at, from, -1.0f);
    const float ends = j->room.is_known ? leave_room(&wall, &j->room, here, direction) : INFINITY;
    if (ends < INFINITY && (p < 0 || ends * ends < dot(off, off))) {
        send_back(out, j, plus(here, direction, ends), wall, j->room.albedo);
    } else if (p >= 0) {
        send_back(out, j, lmb_axes_turn(&j->axes, at), lmb_axes_turn(&j->axes, j->planes.plane[p].normal),
                  j->plane_albedo[p]);
    } else {
        lmb_env_sample(out, &j->env[1], direction, tangent);
    }
}

/* --- rays --------------------------------------------------------------------------------------------------------- */

/* Distance of a place behind the measured surface, m along the axis. Negative if it lies in front or nothing is
 * measured. *pixel: the pixel of the place; -1 outside the picture. */
static float behind(int32_t *pixel, const mix_job *j, lmb_vec3 p)
{
    const lmb_pinhole *c = &j->frame.camera;
    const float z = -p.z, x = c->cx + c->fx * p.x / z + 0.5f, y = c->cy - c->fy * p.y / z + 0.5f;
    *pixel = -1;
    if (!(z > 1e-3f && x >= 0.0f && y >= 0.0f && x < (float)c->width && y < (float)c->height)) {
        return -1.0f;
    }
    *pixel = (int32_t)y * c->width + (int32_t)x;
    const float q = j->cloud.inverse[*pixel];
    return q > 0.0f ? z - 1.0f / q : -1.0f;
}

/* The pixel of the photo that shows the surface hit by a camera-space ray, or -1. */
static int32_t march(float *far, const mix_job *j, lmb_vec3 from, lmb_vec3 along)
{
    float before = 0.0f, at = FIRST;
    int was_before = 1;
    for (int i = 0; i < STEPS; ++i, before = at, at *= GROWTH) {
        int32_t pixel;
        const float by = behind(&pixel, j, plus(from, along, at));
        if (pixel < 0) {
            return -1;
        }
        if (was_before && by >= 0.0f && by < BEHIND + 2.0f * (at - before)) {
            for (int k = 0; k < HALVINGS; ++k) {
                const float middle = 0.5f * (before + at);
                int32_t there;
                const int is_behind = behind(&there, j, plus(from, along, middle)) >= 0.0f;
                before = is_behind ? before : middle;
                at = is_behind ? middle : at;
                pixel = is_behind ? there : pixel;
            }
            *far = at;
            return pixel;
        }
        was_before = by < 0.0f;
    }
    return -1;
}

/* Reflects the view direction about a half vector, sampled by density, with a sequence rotated from pixel to pixel.
 * Sets the reflected share by channel: height-correlated Smith masking, Schlick's Fresnel term. Returns 0 if the ray
 * points into the surface. */
static int ray_of(lmb_vec3 *out, float weight[3][LMB_TILE_PIXELS], const lmb_tile *t, const lmb_glossy *lobes,
                  int32_t k, int ray)
{
    const lmb_vec3 n = {t->normal[0][k], t->normal[1][k], t->normal[2][k]},
                   v = {lobes->towards[0][k], lobes->towards[1][k], lobes->towards[2][k]},
                   axis = fabsf(n.x) < 0.5f ? (lmb_vec3){1, 0, 0} : (lmb_vec3){0, 1, 0};
    const lmb_vec3 a = unit(plus(axis, n, -dot(axis, n))),
                   b = {n.y * a.z - n.z * a.y, n.z * a.x - n.x * a.z, n.x * a.y - n.y * a.x};
    const float u = ((float)ray + 0.5f) / RAYS,
                turn = 2.3999632f * (float)ray + 0.3926991f * (float)(5 * (k % 4) + 7 * (k / 8 % 4)),
                wide = sqrtf(lobes->alpha2[k] * u / (1.0f - u)), s = cosf(turn) * wide, c = sinf(turn) * wide;
    const lmb_vec3 h = unit(plus(plus(n, a, s), b, c)), zero = {0, 0, 0};
    *out = plus(plus(zero, h, 2.0f * dot(v, h)), v, -1.0f);
    const float nl = dot(*out, n), nv = fmaxf(dot(v, n), 1e-3f), vh = dot(v, h), a2 = lobes->alpha2[k];
    if (!(vh > 0.0f && nl > 0.0f && dot(*out, (lmb_vec3){t->face[0][k], t->face[1][k], t->face[2][k]}) > 0.0f)) {
        return 0;
    }
    const float see = nl * sqrtf(a2 + (1.0f - a2) * nv * nv) + nv * sqrtf(a2 + (1.0f - a2) * nl * nl),
                one = 2.0f * nl * vh / (dot(n, h) * see), low = fmaxf(1.0f - vh, 0.0f),
                rise = low * low * low * low * low;
    for (int i = 0; i < 3; ++i) {
        weight[i][k] = one * (lobes->specular[i][k] + (1.0f - lobes->specular[i][k]) * rise);
    }
    return 1;
}

/* The photo around a pixel, filtered to the spacing of the lobe's rays there. */
static void photo_about(float out[3], const mix_job *j, int32_t pixel, float px)
{
    const int32_t w = j->frame.camera.width, h = j->frame.camera.height, off = (int32_t)fminf(px, 16.0f);
    for (int c = 0; c < 3; ++c) {
        out[c] = 0.0f;
    }
    for (int32_t i = 0; i < 9; ++i) {
        const int32_t x = pixel % w + (i % 3 - 1) * off, y = pixel / w + (i / 3 - 1) * off;
        const int is_in = x >= 0 && y >= 0 && x < w && y < h && j->planes.label[y * w + x] == j->planes.label[pixel];
        const float *from = j->frame.light.pixels + 3 * (size_t)(is_in ? y * w + x : pixel);
        for (int c = 0; c < 3; ++c) {
            out[c] += from[c] * (1.0f / 9.0f);
        }
    }
}

/* Traces one ray of pixel k. Stores a hit in the photo in s, to be lit; otherwise sets `out`. */
static void see(float out[3], mix_mirror *s, const mix_job *j, const lmb_tile *t, const lmb_glossy *lobes, int32_t k,
                int ray)
{
    const lmb_vec3 at = {t->position[0][k], t->position[1][k], t->position[2][k]};
    const float wide = sqrtf(lobes->alpha2[k]);
    lmb_vec3 d;
    s->hit.id[k] = 0;
    if (!ray_of(&d, s->weight, t, lobes, k, ray)) {
        return;
    }
    float far = 0.0f;
    const lmb_vec3 from = to_camera(j, at), along = to_camera(j, d);
    const int32_t pixel = march(&far, j, from, along), w = j->frame.camera.width;
    const int32_t cell =
        pixel < 0 ? -1 : j->real.cell[pixel / w / j->real.step * j->real.columns + pixel % w / j->real.step];
    if (pixel < 0) {
        unseen(out, j, from, along, d, 0.5f * wide);
        return;
    }
    photo_about(out, j, pixel, 0.3f * wide * far * j->frame.camera.fx * j->cloud.inverse[pixel]);
    if (cell >= 0) {
        const lmb_vec3 p = lmb_axes_turn(&j->axes, lmb_cloud_point(&j->cloud, pixel % w, pixel / w)),
                       n = lmb_axes_turn(&j->axes, j->cloud.normal[pixel]);
        const float place[3] = {p.x, p.y, p.z}, facing[3] = {n.x, n.y, n.z};
        const uint8_t label = j->planes.label[pixel];
        s->hit.id[k] = 1 + 2 * (uint32_t)cell;
        s->hit.depth[k] = 1.0f / j->cloud.inverse[pixel];
        for (int c = 0; c < 3; ++c) {
            s->hit.position[c][k] = place[c];
            s->hit.normal[c][k] = s->hit.face[c][k] = facing[c];
            s->photo[c][k] = out[c];
            s->albedo[c][k] = label > 0 ? j->plane_albedo[label - 1][c] : 0.0f;
            out[c] = 0.0f;
        }
    }
}

/* --- light on the hits -------------------------------------------------------------------------------------------- */

static void light_hits(mix_mirror *s, const mix_job *j, const lmb_view *view)
{
    const int32_t told = j->light_count - j->lamp_count, step = mix_lights_step(j, LIGHTS);
    memset(s->light, 0, sizeof s->light);
    for (int with = 0; with < 2; ++with) {
        for (int32_t i = 0; i < told; i += step) {
            lmb_direct_tile(&s->light[with], j->o.kernels, &s->hit, view, &j->scene, &j->lights[i], &j->maps[i][with]);
        }
        for (int32_t k = 0; k < 3 * LMB_TILE_PIXELS; ++k) {
            s->light[with].rgb[k / LMB_TILE_PIXELS][k % LMB_TILE_PIXELS] *= (float)step;
        }
    }
    for (int32_t i = told; i < j->light_count; ++i) {
        mix_sources_tile(&s->light[1], j, &s->hit, i, 0);
    }
}

/* The share of the environment that the object leaves visible, approximated by a ball of the box's size. */
static float open_share(const mix_job *j, lmb_vec3 at, lmb_vec3 normal)
{
    const lmb_vec3 to = plus(j->ball_at, at, -1.0f);
    const float r2 = dot(to, to), near = fminf(j->ball_radius * j->ball_radius / fmaxf(r2, 1e-12f), 1.0f);
    return 1.0f - near * fmaxf(dot(to, normal) / sqrtf(fmaxf(r2, 1e-12f)), 0.0f);
}

static void add_hits(float out[3][LMB_TILE_PIXELS], const mix_mirror *s, const mix_job *j)
{
    for (int32_t k = 0; k < LMB_TILE_PIXELS; ++k) {
        float around[2][3];
        const lmb_vec3 n = {s->hit.normal[0][k], s->hit.normal[1][k], s->hit.normal[2][k]};
        const lmb_vec3 at = {s->hit.position[0][k], s->hit.position[1][k], s->hit.position[2][k]};
        const float open = open_share(j, at, n);
        for (int i = 0; i < 2 && s->hit.id[k] != 0; ++i) {
            lmb_env_irradiance(around[i], &j->env[i], n);
        }
        for (int c = 0; c < 3 && s->hit.id[k] != 0; ++c) {
            const float was = s->light[0].rgb[c][k] + around[0][c], is = s->light[1].rgb[c][k] + open * around[1][c];
            const float photo =
                s->photo[c][k] < CLIPPED ? s->photo[c][k] : fmaxf(s->photo[c][k], s->albedo[c][k] * was * (1.0f / PI));
            out[c][k] += s->weight[c][k] * photo * (was > 0.0f ? fminf(is / was, 8.0f) : 1.0f);
        }
    }
}

void mix_mirror_tile(float out[3][LMB_TILE_PIXELS], mix_mirror *s, const mix_job *j, const lmb_view *view,
                     const lmb_tile *object, const lmb_glossy *lobes)
{
    memset(out, 0, 3 * sizeof *out);
    memset(&s->hit, 0, sizeof s->hit);
    for (int ray = 0; ray < RAYS; ++ray) {
        memset(s->weight, 0, sizeof s->weight);
        for (int32_t k = 0; k < LMB_TILE_PIXELS; ++k) {
            float rgb[3] = {0, 0, 0};
            s->hit.id[k] = 0;
            if ((lobes->pixels >> k & 1u) != 0) {
                see(rgb, s, j, object, lobes, k, ray);
            }
            for (int c = 0; c < 3; ++c) {
                out[c][k] += s->weight[c][k] * rgb[c];
            }
        }
        light_hits(s, j, view);
        add_hits(out, s, j);
    }
    for (int32_t k = 0; k < 3 * LMB_TILE_PIXELS; ++k) {
        out[k / LMB_TILE_PIXELS][k % LMB_TILE_PIXELS] *= 1.0f / RAYS;
    }
}
