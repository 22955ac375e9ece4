/* relief_own.c: draws reliefs from their own reference views; the stored values must be reproduced. [P5] */
#include <math.h>
#include <stdio.h>

#include "../../src/base/codec.h"
#include "../../src/base/vec.h"
#include "../../tools/relief/relief_compare.h"
#include "relief_stage.h"

/* Sums over views. */
typedef struct own_errors {
    long long covered;   /* pixels of the simple model */
    long long bare;      /* pixels of the complex model that the simple one does not cover */
    long long outline;   /* covered pixels that are shown but not stored, or stored but not shown */
    long long colour;    /* pixels with another colour than the stored code */
    double depth;        /* maximum error, m */
} own_errors;

static relief_frame shoot(const relief_shot *shot, report *r)
{
    relief_frame f;
    if (!relief_shoot(&f, shot, r)) {
        give_up(r);
    }
    return f;
}

static int is_stored(const relief_frame *got, size_t i, const uint8_t *colour)
{
    return got->albedo[3 * i] == lmb_srgb_linear[colour[0]] && got->albedo[3 * i + 1] == lmb_srgb_linear[colour[1]] &&
           got->albedo[3 * i + 2] == lmb_srgb_linear[colour[2]];
}

/* Distance in metres along the axis that a FULL texel of an orthographic view encodes; 0: nothing. */
static double stored_depth(const relief_picture *p, size_t i)
{
    const uint8_t *t = p->texels + 4 * i;
    const double code = (double)(t[0] | (uint32_t)t[1] << 8 | (uint32_t)t[2] << 16);
    return code > 0.0 ? (double)p->view.far_m - (double)(p->view.far_m - p->view.near_m) * code / 16777215.0 : 0.0;
}

static void count(own_errors *e, const relief_frame *got, const relief_frame *simple, const relief_picture *stored,
                  double back)
{
    const size_t texels = (size_t)got->width * (size_t)got->height;
    for (size_t i = 0; i < texels; ++i) {
        const uint8_t *colour = stored->texels + 4 * (texels + i);
        const double want = stored_depth(stored, i);
        e->bare += want > 0.0 && simple->depth[i] == 0.0f;
        if (simple->depth[i] == 0.0f) {
            continue;
        }
        ++e->covered;
        e->outline += (got->depth[i] > 0.0f) != (want > 0.0);
        if (got->depth[i] > 0.0f && want > 0.0) {
            e->colour += !is_stored(got, i, colour);
            e->depth = fmax(e->depth, fabs((double)got->depth[i] - back - want));
        }
    }
}

/* Uses the reference view's own camera, moved back so that the whole simple model lies in front of it. */
static void add_view(own_errors *e, const subject *s, int32_t which, report *r)
{
    relief_shot shot = {0}, around;
    lmb_scene simple;
    shot.kernels = lmb_kernels_pick();
    shot.view = s->bake.picture[which].view;
    shot.view.eye = add3(shot.view.eye, mul3(shot.view.back, s->diagonal));
    shot.view.far_m += 2.0f * s->diagonal;
    shot.how.pick = LMB_RELIEF_EYE_RAY;
    shot.how.sampling = 1;
    around = shot;
    shot.relief = &s->relief;
    lmb_relief_scene(&simple, &s->relief);
    around.scene = &simple;
    relief_frame got = shoot(&shot, r), outer = shoot(&around, r);
    count(e, &got, &outer, &s->bake.picture[which], (double)s->diagonal);
    relief_frame_free(&got);
    relief_frame_free(&outer);
}

void relief_own_views(report *r)
{
    for (int i = 0; i < STATUES; ++i) {
        subject *s = subject_make(&statues[i], r);
        own_errors e = {0, 0, 0, 0, 0.0};
        if (s == NULL) {
            continue;
        }
        for (int32_t v = 0; v < s->bake.views; ++v) {
            add_view(&e, s, v, r);
        }
        printf("%-6s own views: %lld pixels covered, %lld of the model's are not; %lld shown or not as they should "
               "not, %lld of another colour, depth within %.2g of the diagonal\n",
               statues[i].name, e.covered, e.bare, e.outline, e.colour, e.depth / (double)s->diagonal);
        bar(statues[i].name, "its own views are what is stored",
            e.outline == 0 && e.colour == 0 && e.depth <= 1e-5 * (double)s->diagonal);
        subject_free(s);
    }
}
