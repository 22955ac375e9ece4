/* gl_bounce.c: GL_BOUNCED_LIGHT_LMB: shadows and bounced light from glLight, by lambent's elements and live light.
 *
 * A frame's static triangles (of display lists and of static buffers) are collected as they are drawn. glClear compares
 * them with the scene, and builds another scene if they differ. Triangles are in eye space. If the camera moves, the
 * model-view matrix of the first static primitive gives the change. If a light changed, the light is solved when the
 * first static primitive of a frame is drawn. The shader then computes shadows and bounced light for each pixel. */
#include "gl_context.h"

#include <lambent/elements.h>

#include "../../src/tree/tree.h"

#ifndef GL_BOUNCE_ELEMENTS
#define GL_BOUNCE_ELEMENTS 16384 /* a power of 4 */
#endif
enum { BOUNCE_FIRST = 1024 /* triangles */, BOUNCE_TEXELS = 32 /* a side, for the mean of a texture */,
       BOUNCE_MAX = 1 << 22, BOUNCES = 4 /* solved; the rest is estimated */ };
#define BOUNCE_INSET 0.001f /* of the scene's size */
#define BOUNCE_FLAT  0.999f /* least cosine of normals that share light */
#define BOUNCE_SAME 1e-4f /* maximum movement by rounding, as a share of the scene's size */

/* Triangles of a frame, in eye space. */
typedef struct bounce_part {
    float *at;       /* 9 a triangle */
    uint8_t *colour; /* R G B A of 3 corners */
    uint32_t count, cap;
    float first[16]; /* model-view matrix of the first static primitive */
    int32_t begun;   /* first is set */
} bounce_part;

typedef struct gl_bounce {
    bounce_part part[2]; /* the scene's, and the one being collected */
    int32_t now;         /* the scene's part */
    int32_t failed;      /* memory was used up: until the next glDisable */
    int32_t stands;      /* there is a scene; */
    int32_t is_lit;      /* its elements are solved for `light`, */
    int32_t is_placed;   /* and this frame's place in it is known */
    float to_scene[16], size;
    lmb_mesh mesh;
    lmb_material material;
    lmb_instance instance;
    lmb_scene scene;
    lmb_bvh bvh;
    lmb_elements elements;
    lmb_live live;
    void *memory[3]; /* of bvh, elements, live */
    lmb_live_scratch *scratch;
    gl_light light[GL_LIGHTS]; /* in the scene's space */
    uint32_t lights;           /* those enabled, a bit each */
    lmb_tile tile;
    lmb_traversal traversal;
    lmb_vec3 eye;      /* in the scene's space: the viewer, */
    int32_t eye_kind;  /* or a direction: LMB_EYE_* */
} gl_bounce;

static const lmb_kernels *bounce_kernels(const gl_context *c)
{
    return c->kernels != NULL ? c->kernels : lmb_kernels_named("scalar");
}

/* --- memory ------------------------------------------------------------------------------------------------------- */

static void bounce_free_scene(gl_context *c, gl_bounce *b)
{
    for (int i = 0; i < 3; ++i) {
        gl_free(c, b->memory[i]);
        b->memory[i] = NULL;
    }
    b->stands = b->is_lit = b->is_placed = 0;
}

void gl_bounce_free(gl_context *c)
{
    gl_bounce *b = c->bounce;
    if (b == NULL) {
        return;
    }
    bounce_free_scene(c, b);
    for (int i = 0; i < 2; ++i) {
        gl_free(c, b->part[i].at);
        gl_free(c, b->part[i].colour);
    }
    gl_free(c, b->scratch);
    gl_free(c, b);
    c->bounce = NULL;
}

/* Gives the memory back; nothing is lit until the next glEnable. */
static void bounce_fail(gl_context *c)
{
    gl_bounce_free(c);
    c->bounce_failed = 1;
    c->dirty = 1;
}

static gl_bounce *bounce_of(gl_context *c)
{
    if (c->bounce == NULL && !c->bounce_failed) {
        c->bounce = gl_alloc(c, sizeof *c->bounce);
        if (c->bounce == NULL) {
            c->bounce_failed = 1;
            return NULL;
        }
        memset(c->bounce, 0, sizeof *c->bounce);
    }
    return c->bounce;
}

static int bounce_grow(gl_context *c, bounce_part *p)
{
    const uint32_t cap = p->cap == 0 ? BOUNCE_FIRST : 2 * p->cap;
    float *at = cap <= BOUNCE_MAX ? gl_alloc(c, 9 * sizeof *at * cap) : NULL;
    uint8_t *colour = at != NULL ? gl_alloc(c, (size_t)12 * cap) : NULL;
    if (colour == NULL) {
        gl_free(c, at);
        gl_error(c, GL_OUT_OF_MEMORY);
        return 0;
    }
    memcpy(at, p->at != NULL ? (const void *)p->at : "", 9 * sizeof *at * p->count);
    memcpy(colour, p->colour != NULL ? (const void *)p->colour : "", (size_t)12 * p->count);
    gl_free(c, p->at);
    gl_free(c, p->colour);
    p->at = at;
    p->colour = colour;
    p->cap = cap;
    return 1;
}

/* --- collecting --------------------------------------------------------------------------------------------------- */

/* The mean colour that unit 0 multiplies by. */
static void bounce_texture(const gl_context *c, float mean[3])
{
    const gl_texture *t = gl_unit_is_on(c, 0) ? gl_unit_texture(c, 0) : NULL;
    const gl_image *m = t != NULL ? &t->image[0][t->base_level] : NULL;
    mean[0] = mean[1] = mean[2] = 1.0f;
    if (m == NULL || m->texels == NULL || m->base == GL_DEPTH_COMPONENT || m->base == GL_ALPHA) {
        return;
    }
    const size_t texels = (size_t)m->width * (size_t)m->height; /* of a border, too: of no account */
    const size_t each = texels / (BOUNCE_TEXELS * BOUNCE_TEXELS) + 1;
    uint32_t sum[3] = {0, 0, 0}, count = 0;
    for (size_t i = 0; i < texels; i += each, ++count) {
        for (int k = 0; k < 3; ++k) {
            sum[k] += m->texels[4 * i + (size_t)k];
        }
    }
    for (int k = 0; k < 3; ++k) {
        mean[k] = (float)sum[k] / (255.0f * (float)maxi((int32_t)count, 1));
    }
}

static int bounce_point(float out[3], const float eye[4])
{
    const float by = eye[3] == 1.0f ? 1.0f : 1.0f / eye[3];
    for (int i = 0; i < 3; ++i) {
        out[i] = eye[i] * by;
    }
    return is_place(vec3(out[0], out[1], out[2]));
}

static int bounce_add(gl_context *c, bounce_part *p, const float mean[3], uint32_t i, uint32_t j, uint32_t k)
{
    const uint32_t corner[3] = {i, j, k};
    if (p->count == p->cap && !bounce_grow(c, p)) {
        return 0;
    }
    for (int n = 0; n < 3; ++n) {
        const gl_made *m = &c->made[corner[n]];
        uint8_t *code = p->colour + 12 * (size_t)p->count + 4 * n;
        if (!bounce_point(p->at + 9 * (size_t)p->count + 3 * n, m->eye)) {
            return 1;
        }
        for (int k3 = 0; k3 < 3; ++k3) {
            code[k3] = gl_code(m->material[0].diffuse[k3] * mean[k3]);
        }
        code[3] = 255;
    }
    ++p->count;
    return 1;
}

static int bounce_collect(gl_context *c, bounce_part *p)
{
    const uint32_t n = (uint32_t)c->count;
    float mean[3];
    int good = 1;
    bounce_texture(c, mean);
    switch (c->primitive) {
    case GL_TRIANGLES:
        for (uint32_t i = 2; i < n && good; i += 3) {
            good = bounce_add(c, p, mean, i - 2, i - 1, i);
        }
        break;
    case GL_TRIANGLE_STRIP:
        for (uint32_t i = 2; i < n && good; ++i) {
            good = bounce_add(c, p, mean, i - 2, i - 1, i);
        }
        break;
    case GL_QUADS:
        for (uint32_t i = 3; i < n && good; i += 4) {
            good = bounce_add(c, p, mean, i - 3, i - 2, i - 1) && bounce_add(c, p, mean, i - 3, i - 1, i);
        }
        break;
    case GL_QUAD_STRIP:
        for (uint32_t i = 3; i < n && good; i += 2) {
            good = bounce_add(c, p, mean, i - 3, i - 2, i) && bounce_add(c, p, mean, i - 3, i, i - 1);
        }
        break;
    case GL_TRIANGLE_FAN: case GL_POLYGON:
        for (uint32_t i = 2; i < n && good; ++i) {
            good = bounce_add(c, p, mean, 0, i - 1, i);
        }
        break;
    default: break;
    }
    return good;
}

/* --- the scene ---------------------------------------------------------------------------------------------------- */

static void bounce_set_scene(gl_bounce *b)
{
    const bounce_part *p = &b->part[b->now];
    memset(&b->mesh, 0, sizeof b->mesh);
    memset(&b->material, 0, sizeof b->material);
    memset(&b->instance, 0, sizeof b->instance);
    memset(&b->scene, 0, sizeof b->scene);
    b->mesh.positions = p->at;
    b->mesh.colours = p->colour;
    b->mesh.vertex_count = 3 * p->count;
    b->mesh.triangle_count = p->count;
    b->material.albedo[0] = b->material.albedo[1] = b->material.albedo[2] = b->material.alpha = 1.0f;
    b->material.texture = -1;
    b->material.flags = LMB_DOUBLE_SIDED;
    for (int i = 0; i < 4; ++i) {
        b->instance.to_world.m[5 * i] = 1.0f;
    }
    b->instance.first_id = 1;
    b->scene.meshes = &b->mesh;
    b->scene.materials = &b->material;
    b->scene.instances = &b->instance;
    b->scene.mesh_count = b->scene.material_count = b->scene.instance_count = 1;
    lmb_scene_bounds(&b->scene.bounds_min, &b->scene.bounds_max, &b->scene);
    b->size = length3(sub3(b->scene.bounds_max, b->scene.bounds_min));
}

/* Returns 0 if memory is used up. */
static int bounce_build(gl_context *c, gl_bounce *b)
{
    const uint32_t n = b->part[b->now].count;
    const int32_t side = lmb_live_side(1, 8);
    const size_t bytes[3] = {lmb_bvh_bytes(n), lmb_elements_bytes(GL_BOUNCE_ELEMENTS),
                             lmb_live_bytes(1, side, GL_BOUNCE_ELEMENTS)};
    bounce_free_scene(c, b);
    for (int i = 0; i < 3; ++i) {
        b->memory[i] = gl_alloc(c, bytes[i]);
        if (b->memory[i] == NULL) {
            return 0;
        }
    }
    if (b->scratch == NULL) {
        b->scratch = gl_alloc(c, sizeof *b->scratch);
        if (b->scratch == NULL) {
            return 0;
        }
        memset(b->scratch, 0, sizeof *b->scratch);
    }
    bounce_set_scene(b);
    b->stands = lmb_bvh_init(&b->bvh, n, b->memory[0], bytes[0]) == LMB_OK &&
                lmb_bvh_build(&b->bvh, &b->scene) == LMB_OK &&
                lmb_elements_init(&b->elements, GL_BOUNCE_ELEMENTS, b->memory[1], bytes[1]) == LMB_OK &&
                lmb_elements_build(&b->elements, &b->scene, NULL) == LMB_OK &&
                lmb_live_init(&b->live, 1, side, GL_BOUNCE_ELEMENTS, b->memory[2], bytes[2]) == LMB_OK;
    return 1;
}

static void bounce_transform(float out[3], const float m[16], const float at[3], float w)
{
    for (int i = 0; i < 3; ++i) {
        out[i] = m[i] * at[0] + m[4 + i] * at[1] + m[8 + i] * at[2] + m[12 + i] * w;
    }
}

/* Sets the matrix from the eye space with the model-view matrix `from` to that with `to`. Returns 0 if there is
 * none. */
static int bounce_between(float out[16], const float to[16], const float from[16])
{
    static const float one[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    float inverse[16];
    int good = 1;
    if (memcmp(to, from, sizeof one) == 0) {
        memcpy(out, one, sizeof one);
        return 1;
    }
    if (!gl_matrix_invert(inverse, from)) {
        return 0;
    }
    gl_matrix_times(out, to, inverse);
    for (int i = 0; i < 16; ++i) {
        good &= is_sane(out[i]);
    }
    return good;
}

/* 1 if the collected triangles are those of the scene. */
static int bounce_is_same(const gl_bounce *b)
{
    const bounce_part *old = &b->part[b->now], *p = &b->part[!b->now];
    const float near = BOUNCE_SAME * b->size;
    float m[16];
    if (!b->stands || old->count != p->count || memcmp(old->colour, p->colour, (size_t)12 * p->count) != 0) {
        return 0;
    }
    if (memcmp(old->first, p->first, sizeof p->first) == 0 &&
        memcmp(old->at, p->at, 9 * sizeof *p->at * p->count) == 0) {
        return 1;
    }
    if (!bounce_between(m, old->first, p->first)) {
        return 0;
    }
    for (size_t i = 0; i < (size_t)3 * p->count; ++i) {
        float at[3];
        bounce_transform(at, m, p->at + 3 * i, 1.0f);
        for (int k = 0; k < 3; ++k) {
            if (!(absf(at[k] - old->at[3 * i + (size_t)k]) <= near)) {
                return 0;
            }
        }
    }
    return 1;
}

void gl_bounce_frame(gl_context *c)
{
    gl_bounce *b = c->bounce;
    if (b == NULL) {
        return;
    }
    if (b->part[!b->now].count > 0 && !bounce_is_same(b)) {
        b->now = !b->now;
        if (!bounce_build(c, b)) {
            bounce_fail(c);
            return;
        }
    }
    b->part[!b->now].count = 0;
    b->part[!b->now].begun = 0;
    b->is_placed = 0;
    c->dirty = 1;
}

/* --- light -------------------------------------------------------------------------------------------------------- */

/* A tile's pixels that light l does not reach. */
static uint64_t bounce_hidden(const gl_context *c, gl_bounce *b, const gl_light *l, uint64_t pixels)
{
    const float w = l->position[3], by = w != 0.0f ? 1.0f / w : 1.0f;
    const lmb_vec3 at = vec3(l->position[0] * by, l->position[1] * by, l->position[2] * by);
    const float far = dot3(at, at);
    memset(&b->traversal, 0, sizeof b->traversal);
    b->traversal.eye = b->eye;
    b->traversal.eye_kind = b->eye_kind;
    if (!is_place(at) || (w == 0.0f && !(far > 0.0f))) {
        return 0;
    }
    if (w == 0.0f) {
        return lmb_occluded_sun(bounce_kernels(c), &b->traversal, &b->bvh, &b->tile, pixels,
                                mul3(at, 1.0f / lmb_sqrt(far)));
    }
    return lmb_occluded_tile(bounce_kernels(c), &b->traversal, &b->bvh, &b->tile, pixels, at,
                             lmb_tile_noise(&b->tile, pixels) + lmb_place_noise(at, 0.0f));
}

/* The direct light of elements. */
static void bounce_light_elements(gl_context *c, gl_bounce *b)
{
    for (uint32_t first = 0; first < b->elements.count; first += LMB_TILE_PIXELS) {
        lmb_elements_as_tile(&b->tile, &b->elements, first, LMB_TILE_PIXELS);
        const int n = b->tile.hits;
        for (int k = 0; k < n; ++k) {
            lmb_element *e = &b->elements.data[first + (uint32_t)k];
            memset(e->received, 0, sizeof e->received);
            memset(e->fresh, 0, sizeof e->fresh);
        }
        for (int i = 0; i < GL_LIGHTS; ++i) {
            const uint64_t all = n == 64 ? ~(uint64_t)0 : ((uint64_t)1 << n) - 1;
            const uint64_t hidden = (b->lights >> i & 1u) != 0 ? bounce_hidden(c, b, &b->light[i], all) : all;
            for (int k = 0; k < n; ++k) {
                if ((hidden >> k & 1u) == 0) {
                    const float at[3] = {b->tile.position[0][k], b->tile.position[1][k], b->tile.position[2][k]};
                    const float normal[3] = {b->tile.normal[0][k], b->tile.normal[1][k], b->tile.normal[2][k]};
                    gl_light_receive(b->elements.data[first + (uint32_t)k].fresh, &b->light[i], at, normal);
                }
            }
        }
    }
}

/* Adds the light of all elements to the tree of points. */
static int bounce_send(gl_bounce *b, int last)
{
    return lmb_elements_send(&b->elements, last) == LMB_OK && lmb_elements_live(&b->live, &b->elements) == LMB_OK &&
           lmb_live_build(&b->live, &b->scene) == LMB_OK;
}

/* Solves all bounces: some between the elements, the rest by lmb_elements_rest_live. */
static void bounce_solve(gl_context *c, gl_bounce *b)
{
    lmb_live few;
    b->eye_kind = LMB_EYE_NONE;
    bounce_light_elements(c, b);
    b->live.faces = 0;
    b->is_lit = bounce_send(b, 0);
    for (int i = 2; i <= BOUNCES && b->is_lit; ++i) {
        few = b->live;
        few.strata = (few.strata + 3) / 4; /* a pixel sees many elements with independent noise */
        b->is_lit = lmb_elements_receive_live(&b->elements, bounce_kernels(c), b->scratch, &few, &b->bvh, 0,
                                              lmb_elements_tiles(&b->elements)) == LMB_OK &&
                    (i < BOUNCES ||
                     lmb_elements_rest_live(&b->elements, &b->live, LMB_MAX_BOUNCES - BOUNCES) == LMB_OK) &&
                    bounce_send(b, i == BOUNCES);
    }
}

static int bounce_is_near(const float *a, const float *b, int n, float near)
{
    int good = 1;
    for (int i = 0; i < n; ++i) {
        good &= absf(a[i] - b[i]) <= near;
    }
    return good;
}

/* Takes the context's lights into the scene's space; 1 if they are others than those solved. */
static int bounce_take_lights(const gl_context *c, gl_bounce *b)
{
    uint32_t on = 0;
    int changed = 0;
    for (int i = 0; i < GL_LIGHTS; ++i) {
        const gl_light *from = &c->s.lighting.light[i];
        gl_light l = *from, *old = &b->light[i];
        on |= (uint32_t)gl_is_on(c, CAP_LIGHT + i) << i;
        bounce_transform(l.position, b->to_scene, from->position, from->position[3]);
        bounce_transform(l.spot, b->to_scene, from->spot, 0.0f);
        const float near = BOUNCE_SAME * (l.position[3] != 0.0f ? b->size : 1.0f);
        const int differs = !bounce_is_near(l.position, old->position, 3, near) ||
                            !bounce_is_near(l.spot, old->spot, 3, BOUNCE_SAME) ||
                            memcmp(l.diffuse, old->diffuse, sizeof l.diffuse) != 0 ||
                            l.position[3] != old->position[3] || l.exponent != old->exponent ||
                            l.cutoff != old->cutoff ||
                            memcmp(l.attenuation, old->attenuation, sizeof l.attenuation) != 0;
        if (differs) {
            *old = l;
        }
        changed |= differs && (on >> i & 1u) != 0;
    }
    changed |= on != b->lights;
    b->lights = on;
    return changed;
}

/* The first static primitive of a frame. */
static void bounce_place(gl_context *c, gl_bounce *b)
{
    const float *m = c->modelview.m[c->modelview.top];
    bounce_part *p = &b->part[!b->now];
    memcpy(p->first, m, sizeof p->first);
    p->begun = 1;
    if (b->stands && bounce_between(b->to_scene, b->part[b->now].first, m)) {
        b->is_placed = 1;
        if (bounce_take_lights(c, b) || !b->is_lit) {
            bounce_solve(c, b);
        }
        c->dirty = 1;
    }
}

void gl_bounce_batch(gl_context *c)
{
    gl_bounce *b = gl_is_on(c, CAP_LIGHTING) && c->render_mode == GL_RENDER ? bounce_of(c) : NULL;
    if (b == NULL || !c->is_static || gl_is_on(c, CAP_BLEND) || c->primitive < GL_TRIANGLES) {
        return;
    }
    if (c->dirty) {
        gl_find_textures(c);
    }
    gl_make_vertices(c);
    if (!b->part[!b->now].begun) {
        bounce_place(c, b);
    }
    if (!bounce_collect(c, &b->part[!b->now])) {
        bounce_fail(c);
    }
}

int gl_bounce_shows(const gl_context *c)
{
    const gl_bounce *b = c->bounce;
    return gl_is_on(c, CAP_BOUNCED) && gl_is_on(c, CAP_LIGHTING) && b != NULL && b->is_placed && b->is_lit;
}

/* --- pixels ------------------------------------------------------------------------------------------------------- */

static float bounce_mix(float a, float b, float d, const float share[2])
{
    return a + (share[0] * (b - a) + share[1] * (d - a));
}

static lmb_vec3 bounce_turn(const gl_bounce *b, const float v[3], float sign)
{
    float out[3];
    bounce_transform(out, b->to_scene, v, 0.0f);
    return mul3(normalize3(vec3(out[0], out[1], out[2])), sign);
}

static void bounce_set_pixel(lmb_tile *t, int k, const float at[3], lmb_vec3 face, lmb_vec3 normal, float depth)
{
    const float n[3] = {normal.x, normal.y, normal.z}, f[3] = {face.x, face.y, face.z};
    for (int i = 0; i < 3; ++i) {
        t->position[i][k] = at[i];
        t->normal[i][k] = n[i];
        t->face[i][k] = f[i];
    }
    t->depth[k] = depth;
    t->id[k] = 1;
    ++t->hits;
}

/* The normal at a pixel, as long as those of the corners. */
static void bounce_normal(float out[3], const gl_made *const m[3], float sign, const float share[2])
{
    float length[3];
    for (int i = 0; i < 3; ++i) {
        const float *n = m[i]->normal;
        length[i] = lmb_sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        out[i] = sign * bounce_mix(m[0]->normal[i], m[1]->normal[i], m[2]->normal[i], share);
    }
    const float square = out[0] * out[0] + out[1] * out[1] + out[2] * out[2];
    const float by = square > 0.0f ? bounce_mix(length[0], length[1], length[2], share) / lmb_sqrt(square) : 0.0f;
    for (int i = 0; i < 3; ++i) {
        out[i] *= by;
    }
}

/* Pixels on the edge of two planes are on the viewer's side of both. */
static void bounce_set_eye(const gl_context *c, gl_bounce *b)
{
    const float *p = c->projection.m[c->projection.top], axis[3] = {0.0f, 0.0f, 1.0f}, *m = b->to_scene;
    const int is_far = p[3] == 0.0f && p[7] == 0.0f && p[11] == 0.0f;
    b->eye_kind = is_far ? LMB_EYE_FAR : LMB_EYE_PLACE;
    b->eye = is_far ? bounce_turn(b, axis, 1.0f) : vec3(m[12], m[13], m[14]);
}

static void bounce_material(gl_material *out, const gl_made *const m[3], int side, const float share[2])
{
    const float *p = m[0]->material[side].ambient, *q = m[1]->material[side].ambient, *r = m[2]->material[side].ambient;
    float *to = out->ambient;
    for (int i = 0; i < 17; ++i) { /* ambient, diffuse, specular, emission, shininess */
        to[i] = bounce_mix(p[i], q[i], r[i], share);
    }
}

/* On an edge between two planes the elements of the other one are infinitely near, and so small that they are lost. A
 * point a little towards the middle of its triangle gets their light. */
static lmb_vec3 bounce_inset(const gl_bounce *b, lmb_vec3 at, lmb_vec3 middle)
{
    const lmb_vec3 way = sub3(middle, at);
    const float square = dot3(way, way), by = square > 0.0f ? BOUNCE_INSET * b->size / lmb_sqrt(square) : 0.0f;
    return add3(at, mul3(way, minf(by, 0.25f)));
}

static lmb_vec3 bounce_vec(const float (*v)[LMB_TILE_PIXELS], int k) { return vec3(v[0][k], v[1][k], v[2][k]); }

/* The bounced light of pixel k, or of a point between pixels with k's normals. */
static void bounce_receive(const gl_context *c, gl_bounce *b, float light[3], int k, lmb_vec3 place, lmb_vec3 middle)
{
    const lmb_tile *t = &b->tile;
    const lmb_vec3 inside = bounce_inset(b, place, middle), face = bounce_vec(t->face, k),
                   normal = bounce_vec(t->normal, k);
    const lmb_live_receiver at = {inside, face, normal, 0, lmb_place_noise(place, t->depth[k]),
                                  b->eye_kind == LMB_EYE_FAR ? b->eye : sub3(b->eye, inside), 0.0f};
    light[0] = light[1] = light[2] = 0.0f;
    if (is_place(place) && dot3(face, face) > 0.5f && dot3(normal, normal) > 0.5f) {
        (void)lmb_live_receive(light, bounce_kernels(c), b->scratch, &b->live, &b->bvh, &at);
    }
}

/* The bounced light of all pixels. 2 x 2 pixels of a nearly flat part share the light of their middle. */
static void bounce_receive_all(const gl_context *c, gl_bounce *b, float light[64][3], uint64_t mask, lmb_vec3 middle)
{
    const lmb_tile *t = &b->tile;
    const uint64_t four = 0x303u; /* of pixels 0, 1, 8, 9 */
    for (; mask != 0; mask &= mask - 1) {
        const int k = lowest_bit_64(mask), other[3] = {k + 1, k + 8, k + 9};
        const int is_first = (k & 1) == 0 && (k & 8) == 0 && (mask >> k & four) == four;
        const lmb_vec3 n = bounce_vec(t->normal, k);
        lmb_vec3 sum = bounce_vec(t->position, k);
        int is_flat = is_first;
        for (int i = 0; i < 3 && is_flat; ++i) {
            is_flat = dot3(n, bounce_vec(t->normal, other[i])) > BOUNCE_FLAT;
            sum = add3(sum, bounce_vec(t->position, other[i]));
        }
        bounce_receive(c, b, light[k], k, is_flat ? mul3(sum, 0.25f) : bounce_vec(t->position, k), middle);
        for (int i = 0; i < 3 && is_flat; ++i) {
            memcpy(light[other[i]], light[k], sizeof light[k]);
            mask &= ~((uint64_t)1 << other[i]);
        }
    }
}

void gl_bounce_pixels(const gl_context *c, const lmb_draw_pixels_of *p, const gl_made *const m[3], int side,
                      float colour[64][4], float second[64][3])
{
    gl_bounce *b = c->bounce;
    lmb_tile *t = &b->tile;
    const float sign = side ? -1.0f : 1.0f;
    float corner[3][3], sum[3], eye[64][4], normal[64][3], light[64][3];
    gl_material look[64];
    uint64_t hidden[GL_LIGHTS];
    memset(t, 0, sizeof *t);
    bounce_set_eye(c, b);
    for (int i = 0; i < 3; ++i) {
        (void)bounce_point(corner[i], m[i]->eye);
        sum[i] = 0.0f;
    }
    for (int i = 0; i < 9; ++i) {
        sum[i % 3] += corner[i / 3][i % 3] * (1.0f / 3.0f);
    }
    bounce_transform(sum, b->to_scene, (const float[3]){sum[0], sum[1], sum[2]}, 1.0f);
    const lmb_vec3 middle = vec3(sum[0], sum[1], sum[2]);
    const lmb_vec3 o = vec3(corner[0][0], corner[0][1], corner[0][2]);
    const lmb_vec3 across = cross3(sub3(vec3(corner[1][0], corner[1][1], corner[1][2]), o),
                                   sub3(vec3(corner[2][0], corner[2][1], corner[2][2]), o));
    for (uint64_t bits = p->mask; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        lmb_draw_fragment_at f;
        float at[3];
        lmb_draw_fragment(&f, p, k);
        for (int i = 0; i < 4; ++i) {
            eye[k][i] = bounce_mix(m[0]->eye[i], m[1]->eye[i], m[2]->eye[i], f.share);
        }
        (void)bounce_point(eye[k], eye[k]);
        eye[k][3] = 1.0f;
        bounce_normal(normal[k], m, sign, f.share);
        bounce_material(&look[k], m, side, f.share);
        bounce_transform(at, b->to_scene, eye[k], 1.0f);
        const float plane[3] = {across.x, across.y, across.z};
        const float facing = across.x * normal[k][0] + across.y * normal[k][1] + across.z * normal[k][2];
        bounce_set_pixel(t, k, at, bounce_turn(b, plane, facing < 0.0f ? -1.0f : 1.0f), bounce_turn(b, normal[k], 1.0f),
                         4.0f * lmb_sqrt(eye[k][0] * eye[k][0] + eye[k][1] * eye[k][1] + eye[k][2] * eye[k][2]));
    }
    for (int i = 0; i < GL_LIGHTS; ++i) {
        hidden[i] = gl_is_on(c, CAP_LIGHT + i) ? bounce_hidden(c, b, &b->light[i], p->mask) : 0;
    }
    bounce_receive_all(c, b, light, p->mask, middle);
    for (uint64_t bits = p->mask; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit_64(bits);
        uint32_t seen = 0;
        for (int i = 0; i < GL_LIGHTS; ++i) {
            seen |= (uint32_t)((hidden[i] >> k & 1u) == 0) << i;
        }
        gl_light_side(c, &look[k], eye[k], normal[k], seen, colour[k], second[k]);
        for (int i = 0; i < 3; ++i) {
            colour[k][i] = gl_unit_range(colour[k][i] + look[k].diffuse[i] * light[k][i] * (1.0f / LMB_PI));
            second[k][i] = gl_unit_range(second[k][i]);
        }
        colour[k][3] = gl_unit_range(colour[k][3]);
    }
}
