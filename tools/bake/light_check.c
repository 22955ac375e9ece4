/* light_check.c: reads a file's light back, renders it and compares it with the light that it was baked from. */
#include "light_export.h"

#include <stdlib.h>
#include <string.h>

#include "../common/fvec.h"
#include "../model/model.h"
#include "../picture/metrics.h"

/* Images of one view: the light as baked, and as stored in the file. */
typedef struct checked {
    float *truth, *test, *surface; /* 3 per pixel */
    int32_t width, height;
} checked;

/* Barycentric weights of a point of a triangle. */
static void weights_at(float w[3], const lmb_triangle *t, lmb_vec3 p)
{
    const lmb_vec3 a = sub3(t->corner[1], t->corner[0]), b = sub3(t->corner[2], t->corner[0]),
                   d = sub3(p, t->corner[0]);
    const float aa = dot3(a, a), ab = dot3(a, b), bb = dot3(b, b), da = dot3(d, a), db = dot3(d, b);
    const float under = aa * bb - ab * ab, per = under != 0.0f ? 1.0f / under : 0.0f;
    w[1] = (bb * da - ab * db) * per;
    w[2] = (aa * db - ab * da) * per;
    w[0] = 1.0f - w[1] - w[2];
}

static void texel(float out[3], const lmb_texture *t, int32_t x, int32_t y)
{
    x = x < 0 ? 0 : x >= t->width ? t->width - 1 : x;
    y = y < 0 ? 0 : y >= t->height ? t->height - 1 : y;
    for (int c = 0; c < 3; ++c) {
        out[c] = (float)srgb_decode(t->texels[4 * ((size_t)y * t->width + (size_t)x) + (size_t)c]);
    }
}

/* Interpolates between four texels, in linear light. */
static void bilinear(float out[3], const lmb_texture *t, float u, float v)
{
    const float x = u * (float)t->width - 0.5f, y = v * (float)t->height - 0.5f;
    const int32_t x0 = (int32_t)(x + 1.0f) - 1, y0 = (int32_t)(y + 1.0f) - 1;
    const float fx = x - (float)x0, fy = y - (float)y0;
    memset(out, 0, 3 * sizeof *out);
    for (int k = 0; k < 4; ++k) {
        float own[3];
        texel(own, t, x0 + k % 2, y0 + k / 2);
        const float w = (k % 2 ? fx : 1.0f - fx) * (k / 2 ? fy : 1.0f - fy);
        for (int c = 0; c < 3; ++c) {
            out[c] += w * own[c];
        }
    }
}

/* The light at a point as the file stores it. */
static void light_of(float out[3], const void *user, uint32_t id, lmb_vec3 at, lmb_vec3 normal)
{
    const model *m = user;
    const model_light *l = &m->light;
    lmb_triangle t;
    float w[3], uv[2] = {0.0f, 0.0f};
    memset(out, 0, 3 * sizeof *out);
    (void)normal;
    if (!lmb_triangle_fetch(&t, &m->scene, id)) {
        return;
    }
    const uint32_t mesh = t.instance->mesh;
    weights_at(w, &t, at);
    for (int k = 0; k < 3 && l->picture != NULL && l->uv[mesh] != NULL; ++k) {
        uv[0] += w[k] * l->uv[mesh][2 * (size_t)t.vertex[k]];
        uv[1] += w[k] * l->uv[mesh][2 * (size_t)t.vertex[k] + 1];
    }
    if (l->picture != NULL) {
        bilinear(out, l->picture, uv[0], uv[1]);
    }
    for (int k = 0; k < 3 && l->colour[mesh] != NULL; ++k) {
        for (int c = 0; c < 3; ++c) {
            out[c] += w[k] * l->colour[mesh][3 * (size_t)t.vertex[k] + (size_t)c];
        }
    }
    for (int c = 0; c < 3; ++c) {
        out[c] *= l->scale;
    }
}

/* Renders one tile into `out`; `of` NULL: the light as baked. */
static void light_tile(checked *p, float *out, light_solve *s, const light_source *of, int32_t x, int32_t y)
{
    lmb_frame *f = &s->job.frame;
    const lmb_scene *scene = of != NULL ? of->scene : &s->job.scene;
    static lmb_tile tile;
    lmb_irradiance light;
    memset(&light, 0, sizeof light);
    if (lmb_resolve_tile(&tile, f->kernels, &f->view, scene, &f->eye, x, y) != LMB_OK) {
        return;
    }
    if (of == NULL) {
        lmb_transfer_tile(&light, NULL, f->kernels, &s->scratch, &s->job.render->frame.transfer_light, f->transfer,
                          scene, &tile);
    }
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int32_t px = x + k % LMB_TILE, py = y + k / LMB_TILE;
        if (px >= p->width || py >= p->height) {
            continue;
        }
        const size_t at = 3 * ((size_t)py * (size_t)p->width + (size_t)px);
        float own[3] = {light.rgb[0][k], light.rgb[1][k], light.rgb[2][k]};
        if (of != NULL && tile.id[k] != 0) {
            of->light(own, of->user, tile.id[k], vec3(tile.position[0][k], tile.position[1][k], tile.position[2][k]),
                      vec3(tile.normal[0][k], tile.normal[1][k], tile.normal[2][k]));
        }
        memcpy(out + at, own, sizeof own);
        p->surface[at + 2] += tile.id[k] != 0 ? 0.5f : 0.0f; /* both show a surface: 1 */
    }
}

static int draw(checked *p, float *out, light_solve *s, const light_source *of, report *r)
{
    lmb_frame *f = &s->job.frame;
    const lmb_scene *scene = of != NULL ? of->scene : &s->job.scene;
    lmb_surface_clear(&f->eye.depth);
    lmb_surface_clear(&f->eye.id);
    if (lmb_draw(&f->eye, f->kernels, &f->view, scene, 1, UINT32_MAX - 1, LMB_CULL_BACK | LMB_BLEND, NULL) != LMB_OK) {
        return report_fail(r, "the light could not be drawn");
    }
    for (int32_t y = 0; y < p->height; y += LMB_TILE) {
        for (int32_t x = 0; x < p->width; x += LMB_TILE) {
            light_tile(p, out, s, of, x, y);
        }
    }
    return 1;
}

static int compare(const checked *p, const char *path, const char *form, int is_quiet, report *r)
{
    metrics_input in;
    metrics m;
    memset(&in, 0, sizeof in);
    in.test = p->test;
    in.truth = p->truth;
    in.surface = p->surface;
    in.width = p->width;
    in.height = p->height;
    in.channels = 3;
    if (!metrics_measure(&m, &in, r)) {
        return 0;
    }
    if (!is_quiet && m.truth_mean <= 1e-20) {
        report_say("%s: %s, without light: no light bounces onto the surfaces in the picture of the check\n", path,
                   form);
    } else if (!is_quiet) {
        report_say("%s: %s, read back and drawn: trim %.4f, rmse %.4f, mean %.4f of the light it was baked from\n",
                   path, form, m.trim, m.rmse, m.mean);
    }
    return 1;
}

int light_compare(const char *path, light_solve *s, const light_source *of, const char *form, int is_quiet, report *r)
{
    checked p = {NULL, NULL, NULL, s->job.linear.width, s->job.linear.height};
    const size_t floats = 3 * (size_t)p.width * (size_t)p.height;
    p.truth = calloc(floats, sizeof *p.truth);
    p.test = calloc(floats, sizeof *p.test);
    p.surface = calloc(floats, sizeof *p.surface);
    memset(&s->scratch, 0, sizeof s->scratch);
    const int ok = ((p.truth != NULL && p.test != NULL && p.surface != NULL) ||
                    report_fail(r, "not enough memory to check %s", path)) &&
                   draw(&p, p.truth, s, NULL, r) && draw(&p, p.test, s, of, r) && compare(&p, path, form, is_quiet, r);
    free(p.truth);
    free(p.test);
    free(p.surface);
    return ok;
}

int light_check(const char *path, light_solve *s, const char *form, int is_quiet, report *r)
{
    model loaded;
    model_notes notes;
    memset(&loaded, 0, sizeof loaded);
    memset(&notes, 0, sizeof notes);
    const light_source of = {&loaded.scene, light_of, &loaded};
    const int ok = model_load(&loaded, path, NULL, &notes, r) &&
                   (loaded.light.scale > 0.0f || report_fail(r, "%s: its light does not read back", path)) &&
                   light_compare(path, s, &of, form, is_quiet, r);
    model_free(&loaded);
    return ok;
}
