/* map_picture.c: the shadow maps as images: distances, first points, and the group that owns a texel. */
#include "map_picture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static float dot(lmb_vec3 a, lmb_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

void distance_of_depth(float *pixels, int32_t width, int32_t height, size_t step, const lmb_view *view)
{
    if (view->kind != LMB_PERSPECTIVE) {
        return;
    }
    for (int32_t y = 0; y < height; ++y) {
        for (int32_t x = 0; x < width; ++x) {
            const float right = (((float)x + 0.5f) / (float)width * 2.0f - 1.0f) * view->half_width,
                        up = (((float)y + 0.5f) / (float)height * 2.0f - 1.0f) * view->half_height;
            pixels[(size_t)y * step + (size_t)x] *= sqrtf(1.0f + right * right + up * up);
        }
    }
}

/* --- the picture: a row of faces a light -------------------------------------------------------------------------- */

static int begin_picture(image *out, const lmb_render *render, int32_t channels, report *r)
{
    const uint32_t lights = render->frame.scene->light_count;
    const int32_t size = render->frame.shadow_map;
    int32_t faces = 1;
    for (uint32_t i = 0; i < lights; ++i) {
        faces = render->maps[i].faces > faces ? render->maps[i].faces : faces;
    }
    if ((int64_t)size * faces > LMB_MAX_SIDE || (int64_t)size * lights > LMB_MAX_SIDE) {
        return report_fail(r, "%u lights with maps of %d texels make too large a picture; use a smaller --shadow-map",
                           (unsigned)lights, (int)size);
    }
    out->width = size * faces;
    out->height = size * (int32_t)lights;
    out->channels = channels;
    out->pixels = calloc((size_t)out->width * (size_t)out->height * (size_t)channels, sizeof(float));
    return out->pixels != NULL || report_fail(r, "not enough memory for the picture; try a smaller --shadow-map");
}

/* The first pixel of a face; rows are out->width pixels apart. */
static float *face_pixels(const image *out, const lmb_shadow_map *map, uint32_t light, int32_t face)
{
    const size_t y = (size_t)light * (size_t)map->size, x = (size_t)face * (size_t)map->size;
    return out->pixels + (y * (size_t)out->width + x) * (size_t)out->channels;
}

/* Returns whether the light sends anything through a texel. */
static int is_lit(const lmb_render *render, uint32_t light, int32_t face, int32_t x, int32_t y)
{
    float power[3];
    lmb_light_texel_power(power, &render->frame.scene->lights[light], &render->maps[light], face, x, y);
    return power[0] + power[1] + power[2] > 0.0f;
}

/* --- distances ---------------------------------------------------------------------------------------------------- */

static lmb_status face_distances(const image *out, const lmb_render *render, uint32_t light, int32_t face)
{
    const lmb_frame *f = &render->frame;
    const lmb_shadow_map *map = &render->maps[light];
    const lmb_view *view = &map->view[face];
    lmb_status status = LMB_OK;
    lmb_surface depth;
    memset(&depth, 0, sizeof depth);
    depth.data = face_pixels(out, map, light, face);
    depth.width = depth.height = map->size;
    depth.stride_bytes = out->width * (int32_t)sizeof(float);
    depth.format = LMB_R32F;
    for (int32_t band = 0; band < map->size / LMB_TILE && status == LMB_OK; ++band) {
        status =
            lmb_gbuffer_band(&depth, NULL, NULL, f->kernels, &f->scratch->tile, view, f->scene, &map->face[face], band);
    }
    distance_of_depth(depth.data, map->size, map->size, (size_t)out->width, view);
    for (int32_t i = 0; i < map->size * map->size; ++i) {
        if (!is_lit(render, light, face, i % map->size, i / map->size)) {
            ((float *)depth.data)[(size_t)(i / map->size) * (size_t)out->width + (size_t)(i % map->size)] = 0.0f;
        }
    }
    return status;
}

int map_distances(image *out, const lmb_render *render, report *r)
{
    lmb_status status = LMB_OK;
    if (!begin_picture(out, render, 1, r)) {
        return 0;
    }
    for (uint32_t i = 0; i < render->frame.scene->light_count; ++i) {
        for (int32_t face = 0; face < render->maps[i].faces && status == LMB_OK; ++face) {
            if ((render->maps[i].drawn >> face) & 1u) {
                status = face_distances(out, render, i, face);
            }
        }
    }
    return status == LMB_OK || report_fail(r, "drawing stopped: %s", lmb_status_name(status));
}

/* --- a face's owners ---------------------------------------------------------------------------------------------- */

typedef struct painter {
    const image *out;
    const lmb_render *render;
    const uint32_t *group; /* of each point: from 0, or LMB_NOBODY */
    float scale;           /* multiplies the exitance */
    int display;
} painter;

/* One texel: `owner` is the point that holds the light; `line`: the neighbour below or to the right has another. */
typedef void (*paint_texel)(float *pixel, const painter *p, uint32_t owner, int line);

static void paint_face(const painter *p, float *pixels, const uint32_t *owner, paint_texel paint)
{
    const int32_t size = p->render->frame.shadow_map;
    for (int32_t y = 0; y < size; ++y) {
        for (int32_t x = 0; x < size; ++x, ++owner) {
            const int line = (x + 1 < size && owner[1] != *owner) || (y + 1 < size && owner[size] != *owner);
            if (*owner != LMB_NOBODY) {
                paint(pixels + ((size_t)y * (size_t)p->out->width + (size_t)x) * (size_t)p->out->channels, p, *owner,
                      line);
            }
        }
    }
}

static void paint_faces(const painter *p, paint_texel paint)
{
    const lmb_render *render = p->render;
    const uint32_t *owner = render->frame.points.owner;
    for (uint32_t i = 0; i < render->frame.scene->light_count; ++i) {
        for (int32_t face = 0; face < render->maps[i].faces; ++face) {
            if ((render->maps[i].drawn >> face) & 1u) {
                paint_face(p, face_pixels(p->out, &render->maps[i], i, face), owner, paint);
                owner += (size_t)render->frame.shadow_map * (size_t)render->frame.shadow_map;
            }
        }
    }
}

/* --- first points ------------------------------------------------------------------------------------------------- */

static float area_of(const lmb_point *p)
{
    const lmb_vec3 u = p->axis_u, v = p->axis_v;
    const lmb_vec3 n = {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
    return 4.0f * sqrtf(dot(n, n));
}

/* Draws 2 x 2 texels at a point, in a colour that no lit surface has. */
static void dot_point(const image *out, const lmb_shadow_map *map, uint32_t light, int32_t face, lmb_vec3 at)
{
    const lmb_view *v = &map->view[face];
    const lmb_vec3 away = {at.x - v->eye.x, at.y - v->eye.y, at.z - v->eye.z};
    const float w = v->kind == LMB_PERSPECTIVE ? -dot(v->back, away) : 1.0f, half = 0.5f * (float)map->size;
    const float x = half + half * dot(v->right, away) / (w * v->half_width),
                y = half - half * dot(v->up, away) / (w * v->half_height), last = (float)map->size - 1.0f;
    float *pixels = face_pixels(out, map, light, face);
    if (!(w > 0.0f && x >= 1.0f && y >= 1.0f && x <= last && y <= last)) {
        return;
    }
    for (int i = 0; i < 4; ++i) {
        const size_t u = (size_t)(x - 0.5f) + (size_t)(i % 2), v_px = (size_t)(y - 0.5f) + (size_t)(i / 2);
        float *pixel = pixels + 3 * (v_px * (size_t)out->width + u);
        pixel[0] = 1.0f;
        pixel[1] = 0.05f;
        pixel[2] = 0.4f;
    }
}

/* Points carry the number of their face among those drawn, from 1. */
static void dot_points(const image *out, const lmb_render *render)
{
    const lmb_points *points = &render->frame.points;
    uint32_t number = 0, next = 0; /* points are sorted by face until they are grouped */
    for (uint32_t i = 0; i < render->frame.scene->light_count; ++i) {
        for (int32_t face = 0; face < render->maps[i].faces; ++face) {
            number += (render->maps[i].drawn >> face) & 1u;
            for (; next < points->count && points->data[next].face == number; ++next) {
                dot_point(out, &render->maps[i], i, face, points->data[next].position);
            }
        }
    }
}

/* Outlines are drawn if blocks have room for them. */
static int has_marks(const painter *p)
{
    const int32_t block = p->render->frame.grouping.block;
    return p->display && (block == 0 || block >= 4);
}

/* Tone map e / (1 + e) of the brightest channel: light falls off with the square of distance, and all of it should
 * be visible. */
static void paint_exitance(float *pixel, const painter *p, uint32_t owner, int line)
{
    const lmb_point *d = &p->render->frame.points.data[owner];
    const float scale = p->scale / fmaxf(area_of(d), 1e-24f), max = fmaxf(fmaxf(d->flux[0], d->flux[1]), d->flux[2]);
    const float dim = p->display ? 1.0f / (1.0f + max * scale) : 1.0f;
    for (int c = 0; c < 3; ++c) {
        pixel[c] = d->flux[c] * scale * dim * (line && has_marks(p) ? 0.4f : 1.0f);
    }
}

static float exitance_of(const lmb_point *p)
{
    return (p->flux[0] + p->flux[1] + p->flux[2]) / 3.0f / fmaxf(area_of(p), 1e-24f);
}

/* Scale that brings the median exitance to about 1, within a quarter of a stop; uses a histogram. */
static float points_scale(const lmb_points *points)
{
    enum { STEPS = 512, MIDDLE = 256 };
    uint32_t counts[STEPS] = {0}, lit = 0, below = 0;
    for (uint32_t i = 0; i < points->count; ++i) {
        const float e = exitance_of(&points->data[i]);
        if (e > 1e-9f && e < 1e9f) {
            ++counts[(int)(log2((double)e) * 4.0 + MIDDLE)];
            ++lit;
        }
    }
    for (int step = 0; step < STEPS; ++step) {
        below += counts[step];
        if (lit > 0 && 2 * below >= lit) {
            return (float)exp2((double)(MIDDLE - step) / 4.0);
        }
    }
    return 1.0f;
}

int map_points(image *out, const lmb_render *render, int display, report *r)
{
    painter p = {out, render, NULL, 1.0f, display};
    p.scale = display ? 0.7f * points_scale(&render->frame.points) : 1.0f;
    if (!begin_picture(out, render, 3, r)) {
        return 0;
    }
    paint_faces(&p, paint_exitance);
    if (has_marks(&p)) {
        dot_points(out, render);
    }
    return 1;
}

/* --- groups ------------------------------------------------------------------------------------------------------- */

/* Linear colour for number k. Hues follow the golden section, so that near numbers have distant hues. Three
 * brightnesses, because the hue repeats after a row of groups. No two numbers have the same colour. */
static void false_colour(float *out, uint32_t k)
{
    static const float bright[3] = {1.0f, 0.45f, 0.18f};
    const double hue = fmod((double)k * 0.6180339887498949, 1.0) * 6.0;
    for (int c = 0; c < 3; ++c) {
        const double ramp = fmin(fmax(fabs(fmod(hue + 6.0 - 2.0 * c, 6.0) - 3.0) - 1.0, 0.0), 1.0);
        out[c] = (float)(0.08 + 0.92 * ramp * ramp) * bright[k % 3];
    }
}

static void paint_group(float *pixel, const painter *p, uint32_t owner, int line)
{
    const uint32_t group = p->group[owner];
    (void)line;
    if (!p->display) {
        pixel[0] = group != LMB_NOBODY ? (float)(group + 1) : -1.0f;
    } else if (group != LMB_NOBODY) {
        false_colour(pixel, group);
    } else {
        pixel[0] = pixel[1] = pixel[2] = 0.2f;
    }
}

int map_groups(image *out, const lmb_render *render, int display, report *r)
{
    const lmb_frame *f = &render->frame;
    uint32_t *group = malloc(((size_t)f->points.count + 1) * sizeof *group);
    const painter p = {out, render, group, 1.0f, display};
    if (group == NULL) {
        return report_fail(r, "not enough memory for the picture; try a smaller --shadow-map");
    }
    memset(group, 0xff, (size_t)f->points.count * sizeof *group); /* LMB_NOBODY */
    for (int32_t k = 0; k < f->groups->count; ++k) {
        for (uint32_t i = 0; i < f->groups->members[k]; ++i) {
            group[f->groups->first[k] + i] = (uint32_t)k;
        }
    }
    const int ok = begin_picture(out, render, display ? 3 : 1, r);
    if (ok) {
        paint_faces(&p, paint_group);
    }
    free(group);
    return ok;
}
