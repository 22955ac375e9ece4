/* mix_place.c: where the virtual object stands, and the scene of it and the real surfaces. */
#include "mix_job.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- matrices: columns, as the library has them ------------------------------------------------------------------- */

static lmb_mat4 multiply(const lmb_mat4 *a, const lmb_mat4 *b)
{
    lmb_mat4 out;
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) {
            double sum = 0.0;
            for (int k = 0; k < 4; ++k) {
                sum += (double)a->m[4 * k + r] * (double)b->m[4 * c + k];
            }
            out.m[4 * c + r] = (float)sum;
        }
    }
    return out;
}

static lmb_mat4 of_axes(lmb_vec3 x, lmb_vec3 y, lmb_vec3 z, lmb_vec3 at)
{
    const lmb_mat4 m = {{x.x, x.y, x.z, 0, y.x, y.y, y.z, 0, z.x, z.y, z.z, 0, at.x, at.y, at.z, 1}};
    return m;
}

static lmb_vec3 scaled(lmb_vec3 v, float s)
{
    const lmb_vec3 out = {v.x * s, v.y * s, v.z * s};
    return out;
}

static float dot(lmb_vec3 a, lmb_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/* A pose's inverse; its camera looks along +z with y down, the library's along -z with y up. */
static lmb_mat4 world_to_camera(const double pose[16])
{
    lmb_mat4 m;
    memset(&m, 0, sizeof m);
    for (int r = 0; r < 3; ++r) {
        const double sign = r == 0 ? 1.0 : -1.0;
        double at = 0.0;
        for (int c = 0; c < 3; ++c) {
            m.m[4 * c + r] = (float)(sign * pose[4 * c + r]);
            at -= pose[4 * c + r] * pose[4 * c + 3];
        }
        m.m[12 + r] = (float)(sign * at);
    }
    m.m[15] = 1.0f;
    return m;
}

static int by_size(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

static float median(float *values, size_t count)
{
    qsort(values, count, sizeof *values, by_size);
    return values[count / 2];
}

static const lmb_mat4 identity = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};

/* --- where -------------------------------------------------------------------------------------------------------- */

/* Of the object's box, in its own units. */
typedef struct extent {
    float radius, height, longest; /* radius: of the upright cylinder that holds it, and a fifth more */
} extent;

static extent extent_of(const mix_job *j)
{
    const lmb_vec3 lo = j->object.scene.bounds_min, hi = j->object.scene.bounds_max;
    const extent e = {0.6f * hypotf(hi.x - lo.x, hi.z - lo.z), hi.y - lo.y,
                      fmaxf(fmaxf(hi.x - lo.x, hi.y - lo.y), hi.z - lo.z)};
    return e;
}

/* A sixth of the plane's mean side for the object's longest; half a metre where there is no plane. */
static float chosen_scale(const mix_job *j)
{
    float room = 3.0f;
    if (j->floor >= 0) {
        const lmb_flat *p = &j->planes.plane[j->floor];
        room = sqrtf((p->high[0] - p->low[0]) * (p->high[1] - p->low[1]));
    }
    return j->o.scale > 0.0f ? j->o.scale : room / 6.0f / fmaxf(extent_of(j).longest, 1e-9f);
}

/* The plane of the pixel, or what was measured there, upright. */
static int stand_at_pixel(mix_job *j, report *r)
{
    const int32_t w = j->frame.camera.width, h = j->frame.camera.height;
    if (!(j->o.at_px[0] >= 0.0f && j->o.at_px[1] >= 0.0f && j->o.at_px[0] < (float)w && j->o.at_px[1] < (float)h)) {
        return report_fail(r, "--at %g,%g: the photo has %d x %d pixels", (double)j->o.at_px[0], (double)j->o.at_px[1],
                           (int)w, (int)h);
    }
    const int32_t x = (int32_t)j->o.at_px[0], y = (int32_t)j->o.at_px[1];
    const int32_t label = j->planes.label[y * w + x];
    j->floor = label - 1;
    j->faces_up = 1; /* or was asked for */
    j->scale = chosen_scale(j);
    if (label > 0) {
        j->up = j->planes.plane[j->floor].normal;
        lmb_planes_anchor(&j->anchor, &j->planes, &j->frame.camera, j->floor, j->o.at_px[0], j->o.at_px[1]);
    } else {
        j->anchor = lmb_cloud_point(&j->cloud, x, y);
    }
    return j->anchor.z < 0.0f ||
           report_fail(r, "--at %d,%d: neither a plane nor any depth there; lambent mix --show planes shows them",
                       (int)x, (int)y);
}

/* The middle of the plane, or beside what already stands there: where all of the object is in the picture and nothing
 * in front of it. Where there is no such place the object becomes smaller, unless its size was asked for; then where
 * its foot alone is seen, or most of it is. */
static void stand_free(mix_job *j)
{
    enum { SIZES = 6 };
    const extent e = extent_of(j);
    const float max = j->scale, min = j->o.scale > 0.0f ? max : 0.0f; /* of its size */
    float scale = max;
    for (int i = 0; i < SIZES; ++i) {
        if (lmb_planes_clear(&j->anchor, &j->planes, &j->cloud, j->floor, e.radius * scale,
                             e.height * fmaxf(scale, min))) {
            j->scale = fmaxf(scale, min);
            return;
        }
        scale *= 0.75f;
    }
    scale = max;
    for (int i = 0; i < SIZES; ++i) {
        if (lmb_planes_clear(&j->anchor, &j->planes, &j->cloud, j->floor, e.radius * scale, 0.0f)) {
            return;
        }
        scale *= 0.75f;
    }
}

static int stand_at_centre(mix_job *j, report *r)
{
    j->floor = lmb_planes_floor(&j->planes);
    j->faces_up = j->floor >= 0;
    j->floor = j->floor < 0 && j->planes.count > 0 ? 0 : j->floor;
    if (j->floor < 0) {
        return report_fail(r, "no plane in the depth to stand on; say where by --at X,Y");
    }
    j->up = j->planes.plane[j->floor].normal;
    j->anchor = j->planes.plane[j->floor].centre;
    j->scale = chosen_scale(j);
    stand_free(j);
    return 1;
}

/* How much farther than the surface that the object stands on what was measured is, at the pixels of its foot: the
 * median, so that noise counts as little as there are many of them. Along the camera's axis. */
static float gap(mix_job *j, report *r)
{
    const lmb_pinhole *c = &j->frame.camera;
    const float radius = extent_of(j).radius * j->scale, slope = dot(j->anchor, j->up);
    const int reach = (int)fminf(fmaxf(radius * c->fx / -j->anchor.z, 4.0f), 200.0f);
    const int x0 = (int)floorf(c->cx - c->fx * j->anchor.x / j->anchor.z + 0.5f),
              y0 = (int)floorf(c->cy + c->fy * j->anchor.y / j->anchor.z + 0.5f);
    float *off = mix_take(j, (size_t)(2 * reach + 1) * (size_t)(2 * reach + 1) * sizeof *off, r);
    size_t n = 0;
    for (int y = y0 - reach; off != NULL && y <= y0 + reach; ++y) {
        for (int x = x0 - reach; x <= x0 + reach; ++x) {
            if (x < 0 || y < 0 || x >= c->width || y >= c->height || !(j->frame.depth[y * c->width + x] > 0.0f)) {
                continue;
            }
            const lmb_vec3 ray = lmb_cloud_ray(c, (float)x, (float)y);
            const float at = slope / dot(ray, j->up);
            const lmb_vec3 p = scaled(ray, at), d = {p.x - j->anchor.x, p.y - j->anchor.y, p.z - j->anchor.z};
            if (dot(d, d) <= radius * radius || (x == x0 && y == y0)) {
                off[n++] = j->frame.depth[y * c->width + x] - at;
            }
        }
    }
    return n > 0 ? median(off, n) : NAN;
}

/* Upright in the scene's space, +Z towards the viewer, then turned. */
static lmb_mat4 upright(const mix_job *j, float scale)
{
    const lmb_vec3 at = lmb_axes_turn(&j->axes, j->anchor);
    const float viewer = hypotf(at.x, at.z) > 0.0f ? atan2f(-at.x, -at.z) : 0.0f;
    const float turn = j->o.turn_deg * 0.017453293f + viewer;
    const lmb_vec3 x = {cosf(turn) * scale, 0, -sinf(turn) * scale}, y = {0, scale, 0},
                   z = {sinf(turn) * scale, 0, cosf(turn) * scale};
    return of_axes(x, y, z, at);
}

/* The middle of the mesh's foot goes to the anchor. */
static lmb_mat4 object_to_scene(mix_job *j)
{
    if (j->o.at == MIX_AT_WORLD) {
        return j->from_world;
    }
    const lmb_vec3 lo = j->object.scene.bounds_min, hi = j->object.scene.bounds_max;
    const lmb_mat4 stand = upright(j, j->scale);
    lmb_mat4 foot = identity;
    foot.m[12] = -0.5f * (lo.x + hi.x);
    foot.m[13] = -lo.y;
    foot.m[14] = -0.5f * (lo.z + hi.z);
    return multiply(&stand, &foot);
}

/* --- the scene ---------------------------------------------------------------------------------------------------- */

static int build_real(mix_job *j, report *r)
{
    const int32_t step = 4;
    const size_t bytes = lmb_real_mesh_bytes(j->frame.camera.width, j->frame.camera.height, step);
    void *mesh = mix_take(j, bytes, r);
    return mesh != NULL &&
           (lmb_real_mesh_build(&j->real, &j->cloud, &j->planes, step, &j->axes, mesh, bytes) == LMB_OK ||
            report_fail(r, "the photo is too large"));
}

/* The real mesh before the object's own: everything of the object moves up by one. */
static int join_scene(mix_job *j, const lmb_mat4 *place, report *r)
{
    const lmb_scene *s = &j->object.scene;
    lmb_mesh *meshes = mix_take(j, (s->mesh_count + 1) * sizeof *meshes, r);
    lmb_material *materials = mix_take(j, (s->material_count + 1) * sizeof *materials, r);
    lmb_instance *instances = mix_take(j, (s->instance_count + 1) * sizeof *instances, r);
    if (meshes == NULL || materials == NULL || instances == NULL) {
        return 0;
    }
    if (!build_real(j, r)) {
        return 0;
    }
    meshes[0] = lmb_real_mesh_draw(&j->real);
    materials[0].albedo[0] = materials[0].albedo[1] = materials[0].albedo[2] = materials[0].alpha = 1.0f;
    materials[0].texture = -1;
    materials[0].flags = LMB_DOUBLE_SIDED;
    instances[0].to_world = identity;
    instances[0].first_id = 1;
    j->real_triangles = meshes[0].triangle_count;
    for (uint32_t i = 0; i < s->mesh_count; ++i) {
        meshes[i + 1] = s->meshes[i];
    }
    for (uint32_t i = 0; i < s->material_count; ++i) {
        materials[i + 1] = s->materials[i];
    }
    for (uint32_t i = 0; i < s->instance_count; ++i) {
        lmb_instance *to = &instances[i + 1];
        *to = s->instances[i];
        to->to_world = multiply(place, &to->to_world);
        ++to->mesh;
        ++to->material;
        to->first_id += j->real_triangles;
    }
    j->object_triangles = lmb_scene_triangles(s);
    j->scene = *s;
    j->scene.meshes = meshes;
    j->scene.materials = materials;
    j->scene.instances = instances;
    ++j->scene.mesh_count;
    ++j->scene.material_count;
    ++j->scene.instance_count;
    j->scene.lights = NULL;
    j->scene.light_count = 0;
    lmb_scene_bounds(&j->scene.bounds_min, &j->scene.bounds_max, &j->scene);
    return lmb_scene_check(&j->scene) == LMB_OK ||
           report_fail(r, "%s: too large where it stands; --scale sets metres of a unit", j->o.object);
}

/* The scene's space stands upright on what the object stands on, or on the floor. */
static void turn_scene(mix_job *j)
{
    const lmb_mat4 camera = j->frame.has_pose ? world_to_camera(j->frame.pose) : identity;
    j->axes = lmb_axes_upright(j->up);
    const lmb_mat4 turn = of_axes(j->axes.right, j->axes.up, j->axes.back, (lmb_vec3){0, 0, 0});
    j->from_world = multiply(&turn, &camera);
}

/* Is the box of what the object covers in the picture? */
static int is_inside(const mix_job *j)
{
    const lmb_pinhole *c = &j->frame.camera;
    lmb_scene object = j->scene;
    lmb_vec3 low, high;
    ++object.instances;
    --object.instance_count;
    lmb_scene_bounds(&low, &high, &object);
    for (int i = 0; i < 8; ++i) {
        const lmb_vec3 p = {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z};
        const float ahead = -dot(j->axes.back, p), x = c->cx + c->fx * dot(j->axes.right, p) / ahead,
                    y = c->cy - c->fy * dot(j->axes.up, p) / ahead;
        if (!(ahead > 0.0f) || x < -0.5f || y < -0.5f || x > (float)c->width - 0.5f || y > (float)c->height - 0.5f) {
            return 0;
        }
    }
    return 1;
}

/* Of the floor, or, where none is seen, what else tells. */
static void set_up(mix_job *j)
{
    const int32_t floor = lmb_planes_floor(&j->planes);
    j->up = floor >= 0 ? j->planes.plane[floor].normal : lmb_planes_up(&j->planes);
}

int mix_place(mix_job *j, report *r)
{
    j->floor = -1;
    set_up(j);
    if (j->o.object == NULL) {
        turn_scene(j);
        return join_scene(j, &identity, r);
    }
    if (!model_load(&j->object, j->o.object, NULL, &j->notes, r) ||
        (j->o.at == MIX_AT_PIXEL && !stand_at_pixel(j, r)) || (j->o.at == MIX_AT_CENTRE && !stand_at_centre(j, r))) {
        return 0;
    }
    turn_scene(j);
    j->gap_m = j->o.at == MIX_AT_WORLD ? NAN : gap(j, r);
    const lmb_mat4 place = object_to_scene(j);
    if (!join_scene(j, &place, r)) {
        return 0;
    }
    j->inside = is_inside(j);
    return 1;
}
