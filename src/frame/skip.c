/* skip.c: finds work that a frame can skip because it changes no byte of the picture. Layer 8.
 *
 *   lobes, emission        if only unused materials have them
 *   a light of 0 W         all products with the intensity are 0; adding 0 changes no sum
 *   a light out of reach   the light's range ends before the scene's box
 *   a face of a map        if the scene's box is outside the face's pyramid: no triangle would be drawn into the face,
 *                          so it has no first points, and a map without triangles casts no shadow
 *   bounced light          if no light reaches a triangle, or all reflect 0: the flux of first points is 0
 *
 * If the frame allows it, also skips lights whose bounce no pixel can show, according to a conservative bound. */
#include "../base/light_kind.h"
#include "../base/vec.h"
#include "../raster/triangle.h"
#include "stages.h"
#include "requires.h"

#if LMB_PLAN

/* margin of the test whether a box is outside, in half widths of a face: 1/16 px of the smallest map, over 16 times
 * the distance that rounding and snapping to 1/256 px move a vertex */
#define MIN_BOX_MARGIN 0.015625f

/* max excess of a disc in place of a surface: 16 % at 2 to 3 radii; nearer, the shape is used */
#define MAX_DISC_EXCESS 1.25f

static int any3(const float *c) { return c[0] > 0.0f || c[1] > 0.0f || c[2] > 0.0f; }

/* Properties of the drawn materials: does one reflect, emit, or have a lobe? */
typedef struct material_summary {
    int reflects, emits, is_glossy;
    float albedo; /* the largest */
} material_summary;

static material_summary summary_of(const lmb_scene *s)
{
    material_summary l = {0, 0, 0, 0.0f};
    for (uint32_t i = 0; i < s->instance_count; ++i) {
        const lmb_material *m = &s->materials[s->instances[i].material];
        if (s->meshes[s->instances[i].mesh].triangle_count > 0) {
            l.reflects |= any3(m->albedo);
            l.emits |= any3(m->emission);
            l.is_glossy |= any3(m->specular);
            l.albedo = maxf(l.albedo, maxf(m->albedo[0], maxf(m->albedo[1], m->albedo[2])));
        }
    }
    return l;
}

/* Is the whole box on the outer side of a plane of the pyramid? `middle` and `half` are the box's extent along the
 * plane's normal. */
static int is_outside(float middle, float half, float margin) { return middle - half > margin; }

/* Can a perspective face see a part of the scene? Uses the axes of the view; w is along the view direction. */
static int face_meets(const lmb_view *v, const lmb_scene *s)
{
    const lmb_vec3 half = mul3(sub3(s->bounds_max, s->bounds_min), 0.5f);
    const lmb_vec3 to = sub3(mul3(add3(s->bounds_max, s->bounds_min), 0.5f), v->eye);
    const float scale = absf(to.x) + absf(to.y) + absf(to.z) + half.x + half.y + half.z;
    const lmb_vec3 ahead = mul3(v->back, -1.0f);
    const lmb_vec3 side[4] = {v->right, mul3(v->right, -1.0f), v->up, mul3(v->up, -1.0f)};
    for (int i = 0; i < 4; ++i) {
        const float tangent = i < 2 ? v->half_width : v->half_height;
        const lmb_vec3 out = sub3(side[i], mul3(ahead, tangent)); /* point p is outside if out . p > 0 */
        const float reach = absf(out.x) * half.x + absf(out.y) * half.y + absf(out.z) * half.z;
        if (is_outside(dot3(out, to), reach, MIN_BOX_MARGIN * scale * tangent)) {
            return 0;
        }
    }
    return 1;
}

static void skip_faces(lmb_shadow_map *map, const lmb_scene *s)
{
    for (int32_t f = 0; f < map->faces; ++f) {
        if (map->view[f].kind == LMB_PERSPECTIVE && !face_meets(&map->view[f], s)) {
            map->drawn &= ~(1u << f);
        }
    }
}

/* Does the light's range end before the scene's box? The margin is a thousandth, because rounding may move pixels out
 * of the box. */
static int light_ends_before(const lmb_light *l, const lmb_scene *s)
{
    const lmb_vec3 low = sub3(s->bounds_min, l->position), high = sub3(l->position, s->bounds_max);
    const lmb_vec3 gap = vec3(maxf(maxf(low.x, high.x), 0.0f), maxf(maxf(low.y, high.y), 0.0f),
                              maxf(maxf(low.z, high.z), 0.0f));
    const float range2 = light_range2(l);
    return range2 > 0.0f && dot3(gap, gap) > 1.001f * range2;
}

/* --- lights that are too dim to bounce ---------------------------------------------------------------------------- */

/* Lower bound of the squared distance from a point to any triangle, from the triangles' boxes. Triangles that are never
 * drawn count too, which only raises the bound on light. */
static float nearest2(const lmb_scene *s, uint32_t triangles, lmb_vec3 at)
{
    lmb_triangle t;
    float nearest = 3e38f;
    for (uint32_t id = 1; id <= triangles; ++id) {
        if (lmb_triangle_fetch(&t, s, id)) {
            const lmb_vec3 *p = t.corner;
            const float x = maxf(maxf(minf(p[0].x, minf(p[1].x, p[2].x)) - at.x,
                                      at.x - maxf(p[0].x, maxf(p[1].x, p[2].x))), 0.0f);
            const float y = maxf(maxf(minf(p[0].y, minf(p[1].y, p[2].y)) - at.y,
                                      at.y - maxf(p[0].y, maxf(p[1].y, p[2].y))), 0.0f);
            const float z = maxf(maxf(minf(p[0].z, minf(p[1].z, p[2].z)) - at.z,
                                      at.z - maxf(p[0].z, maxf(p[1].z, p[2].z))), 0.0f);
            nearest = minf(nearest, x * x + y * y + z * z);
        }
    }
    return nearest;
}

/* Upper bound of the radiance that a light's bounced light adds to a pixel. No surface receives more than E = I / d^2
 * (a sun: E), so none sends more than albedo E. A surface surrounded by this light receives as much, and so on for each
 * further bounce, including estimated ones; it shows albedo / pi of the light it receives. Albedo is at most 1;
 * textures and colours only darken. */
static float upper_bounced(const lmb_render *r, const lmb_light *l, float albedo)
{
    const lmb_scene *s = r->frame.scene;
    const float largest = maxf(l->intensity[0], maxf(l->intensity[1], l->intensity[2]));
    const float d2 = light_kind_is(l->kind, LIGHT_FAR) ? 1.0f : nearest2(s, r->triangles, l->position);
    const int32_t own = r->frame.bounces, bounces = own > 1 && !r->frame.truncated ? LMB_MAX_BOUNCES : own;
    float sum = 0.0f, share = 1.0f;
    for (int32_t i = 0; i < bounces; ++i) {
        share *= albedo;
        sum += share;
    }
    return largest <= d2 * 1e30f && d2 > 0.0f ? largest / d2 * sum * albedo * 0.3183099f : 3e38f;
}

/* Skips lights one after another while the sum of their bounds stays under `dim`. */
static void skip_dim(lmb_render *r, float albedo)
{
    for (uint32_t i = 0; i < r->frame.scene->light_count; ++i) {
        const float upper = upper_bounced(r, &r->frame.scene->lights[i], albedo) * MAX_DISC_EXCESS;
        if (r->light_state[i] == 0 && r->dimmed + upper <= r->frame.dim) {
            r->light_state[i] |= LMB_LIGHT_DIM;
            r->dimmed += upper;
        }
    }
}

/* --- all of it ---------------------------------------------------------------------------------------------------- */

static void remember_revisions(lmb_render *r)
{
    const lmb_scene *s = r->frame.scene;
    r->revision = s->revision;
    r->lights_revision = s->lights_revision;
    r->appearance_revision = s->appearance_revision;
    for (uint32_t i = 0; i < s->light_count; ++i) {
        r->light_revision[i] = s->lights[i].revision;
    }
}

void lmb_render_skip(lmb_render *r)
{
    const lmb_scene *s = r->frame.scene;
    uint32_t lit = 0;
    remember_revisions(r);
    if (r->frame.run_all) {
        return;
    }
    const material_summary l = summary_of(s);
    r->emits = r->emits && l.emits;
    r->is_glossy = r->is_glossy && l.is_glossy;
    for (uint32_t i = 0; i < s->light_count; ++i) {
        if (!any3(s->lights[i].intensity) || light_ends_before(&s->lights[i], s)) {
            r->light_state[i] |= LMB_LIGHT_DARK;
            r->maps[i].drawn = 0;
        } else {
            skip_faces(&r->maps[i], s);
        }
    }
    /* The bound holds for surfaces without lobes. */
    if (r->frame.dim > 0.0f && !r->is_glossy && r->frame.show != LMB_SHOW_IRRADIANCE) {
        skip_dim(r, minf(l.albedo, 1.0f));
    }
    for (uint32_t i = 0; i < s->light_count; ++i) {
        lit += faces_that_bounce(r, i);
    }
    lit += (uint32_t)(requires_many_lights_bounce(&r->frame) || requires_many_lights_transfer(&r->frame) ||
                      gathers_many_lights(&r->frame));
    if (!r->emits && (lit == 0 || !l.reflects || r->triangles == 0)) {
        r->skips |= LMB_SKIP_BOUNCE;
    }
}

#endif
