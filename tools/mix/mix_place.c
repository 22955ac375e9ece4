/* mix_place.c: where the virtual object stands, and the scene of it and the real surfaces. */
#include "mix_frames.h"
#include "mix_lobes.h"
#include "mix_world.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- matrices: columns, as the library has them ------------------------------------------------------------------- */

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

/* How much farther than the surface that the object stands on what was measured is, at the pixels of its foot: the
 * median, so that noise counts as little as there are many of them. Along the camera's axis. */
static float gap(mix_job *j, report *r)
{
    const lmb_pinhole *c = &j->frame.camera;
    const lmb_vec3 n = j->hangs ? j->planes.plane[j->floor].normal : j->up;
    const float radius = mix_extent_of(j).radius * j->scale, slope = dot(j->anchor, n);
    const int reach = (int)fminf(fmaxf(radius * c->fx / -j->anchor.z, 4.0f), 200.0f);
    const int x0 = (int)floorf(c->cx - c->fx * j->anchor.x / j->anchor.z + 0.5f),
              y0 = (int)floorf(c->cy + c->fy * j->anchor.y / j->anchor.z + 0.5f);
    float *off = mix_take(j, (size_t)(2 * reach + 1) * (size_t)(2 * reach + 1) * sizeof *off, r);
    size_t count = 0;
    for (int y = y0 - reach; off != NULL && y <= y0 + reach; ++y) {
        for (int x = x0 - reach; x <= x0 + reach; ++x) {
            if (x < 0 || y < 0 || x >= c->width || y >= c->height || !(j->frame.depth[y * c->width + x] > 0.0f)) {
                continue;
            }
            const lmb_vec3 ray = lmb_cloud_ray(c, (float)x, (float)y);
            const float at = slope / dot(ray, n);
            const lmb_vec3 p = scaled(ray, at), d = {p.x - j->anchor.x, p.y - j->anchor.y, p.z - j->anchor.z};
            if (dot(d, d) <= radius * radius || (x == x0 && y == y0)) {
                off[count++] = j->frame.depth[y * c->width + x] - at;
            }
        }
    }
    return count > 0 ? median(off, count) : NAN;
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

/* Upright before a wall, +Z out of it, then turned about that. */
static lmb_mat4 hanging(const mix_job *j, float scale)
{
    const lmb_vec3 n = lmb_axes_turn(&j->axes, j->planes.plane[j->floor].normal);
    const float level = fmaxf(hypotf(n.x, n.z), 1e-6f), turn = j->o.turn_deg * 0.017453293f;
    const lmb_vec3 z = {n.x / level, 0, n.z / level}, across = {z.z, 0, -z.x};
    const float c = cosf(turn) * scale, s = sinf(turn) * scale;
    const lmb_vec3 x = {c * across.x, s, c * across.z}, y = {-s * across.x, c, -s * across.z};
    return of_axes(x, y, scaled(z, scale), lmb_axes_turn(&j->axes, j->anchor));
}

/* The middle of the mesh's foot goes to the anchor; of one that hangs the middle of its back. */
static lmb_mat4 object_to_scene(mix_job *j)
{
    if (j->o.at == MIX_AT_WORLD) {
        return j->from_world;
    }
    const lmb_vec3 lo = j->object.scene.bounds_min, hi = j->object.scene.bounds_max;
    const lmb_mat4 stand = j->hangs ? hanging(j, j->scale) : upright(j, j->scale);
    lmb_mat4 foot = identity;
    foot.m[12] = -0.5f * (lo.x + hi.x);
    foot.m[13] = j->hangs ? -0.5f * (lo.y + hi.y) : -lo.y;
    foot.m[14] = j->hangs ? -lo.z : -0.5f * (lo.z + hi.z);
    return mix_product(&stand, &foot);
}

/* --- the scene ---------------------------------------------------------------------------------------------------- */

static int build_real(mix_job *j, report *r)
{
    const int32_t step = 4;
    const size_t bytes = lmb_real_mesh_bytes(j->frame.camera.width, j->frame.camera.height, step);
    void *mesh = mix_take(j, bytes, r);
    return mesh != NULL &&
           (lmb_real_mesh_build(&j->real, &j->cloud, &j->planes, step, &j->axes, mesh, bytes) == LMB_OK ||
            report_fail(r, "the photo is too large")) &&
           mix_cells(j, r);
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
    meshes[0].vertex_count += 4 * (uint32_t)j->old_cells;
    meshes[0].triangle_count += 2 * (uint32_t)j->old_cells;
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
        to->to_world = mix_product(place, &to->to_world);
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

/* Its back axis out of a wall: voxels are aligned to what the object hangs on, too. */
static void turn_to_wall(lmb_axes *out, lmb_vec3 up, lmb_vec3 facing)
{
    const float tall = dot(facing, up);
    const lmb_vec3 level = {facing.x - tall * up.x, facing.y - tall * up.y, facing.z - tall * up.z},
                   z = scaled(level, 1.0f / sqrtf(fmaxf(dot(level, level), 1e-12f))),
                   x = {up.y * z.z - up.z * z.y, up.z * z.x - up.x * z.z, up.x * z.y - up.y * z.x};
    out->right = (lmb_vec3){x.x, up.x, z.x};
    out->up = (lmb_vec3){x.y, up.y, z.y};
    out->back = (lmb_vec3){x.z, up.z, z.z};
}

/* The scene's space stands upright on what the object stands on, or on the floor. */
static void turn_scene(mix_job *j)
{
    const lmb_mat4 camera = j->frame.has_pose ? world_to_camera(j->frame.pose) : identity;
    j->axes = lmb_axes_upright(j->up);
    if (j->hangs) {
        turn_to_wall(&j->axes, j->up, j->facing);
    }
    const lmb_mat4 turn = of_axes(j->axes.right, j->axes.up, j->axes.back, (lmb_vec3){0, 0, 0});
    j->from_world = mix_product(&turn, &camera);
}

/* Samples lie up to half a pixel off, and ask four pixels. */
static void set_box(mix_job *j, float x0, float y0, float x1, float y1)
{
    const float w = (float)j->frame.camera.width, h = (float)j->frame.camera.height;
    j->box_px[0] = (int32_t)fminf(fmaxf(x0 - 2.0f, 0.0f), w);
    j->box_px[1] = (int32_t)fminf(fmaxf(y0 - 2.0f, 0.0f), h);
    j->box_px[2] = (int32_t)fminf(fmaxf(x1 + 4.0f, 0.0f), w);
    j->box_px[3] = (int32_t)fminf(fmaxf(y1 + 4.0f, 0.0f), h);
}

/* How large is the box of what the object covers in the picture, and is the object in it? */
static void look(mix_job *j)
{
    const lmb_pinhole *c = &j->frame.camera;
    lmb_vec3 low, high;
    float x0 = INFINITY, y0 = INFINITY, x1 = -INFINITY, y1 = -INFINITY;
    mix_object_box(&low, &high, j);
    for (int i = 0; i < 8; ++i) {
        const lmb_vec3 p = {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z};
        const float ahead = -dot(j->axes.back, p), x = c->cx + c->fx * dot(j->axes.right, p) / ahead,
                    y = c->cy - c->fy * dot(j->axes.up, p) / ahead;
        if (!(ahead > 0.0f)) {
            j->seen_px = INFINITY;
            j->inside = 0;
            set_box(j, 0.0f, 0.0f, (float)c->width, (float)c->height);
            return;
        }
        x0 = fminf(x0, x);
        y0 = fminf(y0, y);
        x1 = fmaxf(x1, x);
        y1 = fmaxf(y1, y);
    }
    set_box(j, x0, y0, x1, y1);
    j->seen_px = fmaxf(x1 - x0, y1 - y0);
    j->inside = mix_is_inside(j);
}

/* Of the floor, or, where none is seen, what else tells. */
static void set_up(mix_job *j)
{
    const int32_t floor = lmb_planes_floor(&j->planes);
    j->up = floor >= 0 ? j->planes.plane[floor].normal : lmb_planes_up(&j->planes);
}

/* --- in a sequence ------------------------------------------------------------------------------------------------ */

static lmb_mat4 camera_of(const mix_job *j)
{
    return j->frame.has_pose ? world_to_camera(j->frame.pose) : identity;
}

void mix_keep_place(mix_kept *k, const mix_job *j)
{
    const lmb_mat4 camera = camera_of(j), world = mix_back(&camera), from = mix_back(&j->from_world);
    k->to_world = mix_product(&from, &j->placed);
    k->anchor = mix_move(&world, j->anchor);
    k->up = mix_turn(&world, j->up);
    k->facing = mix_turn(&world, j->facing);
    k->scale = j->scale;
    k->hangs = j->hangs;
}

/* The plane of this frame that the object stands on: within ten degrees and 50 mm of where it stood; or -1. */
static int32_t plane_below(const mix_job *j, lmb_vec3 normal)
{
    int32_t best = -1;
    float near = 0.05f;
    for (int32_t i = 0; i < j->planes.count; ++i) {
        const lmb_flat *p = &j->planes.plane[i];
        const float off = fabsf(dot(p->normal, j->anchor) + p->distance);
        if (off < near && dot(p->normal, normal) > 0.985f) {
            near = off;
            best = i;
        }
    }
    return best;
}

static int place_again(mix_job *j, report *r)
{
    const mix_kept *k = j->kept;
    const lmb_mat4 camera = camera_of(j);
    j->object = k->object;
    j->anchor = mix_move(&camera, k->anchor);
    j->up = mix_turn(&camera, k->up);
    j->scale = k->scale;
    j->facing = mix_turn(&camera, k->facing);
    j->hangs = k->hangs;
    j->floor = plane_below(j, j->facing);
    j->faces_up = 1;
    turn_scene(j);
    j->gap_m = NAN;
    j->placed = mix_product(&j->from_world, &k->to_world);
    if (!join_scene(j, &j->placed, r)) {
        return 0;
    }
    look(j);
    return 1;
}

int mix_place(mix_job *j, report *r)
{
    if (j->kept != NULL && j->kept->frames > 0 && j->o.object != NULL) {
        return place_again(j, r);
    }
    j->floor = -1;
    set_up(j);
    if (j->o.object == NULL) {
        turn_scene(j);
        return join_scene(j, &identity, r);
    }
    if (j->o.at == MIX_AT_CENTRE && j->planes.count == 0) {
        return mix_fail_depth(j, r);
    }
    if (!model_load(&j->object, j->o.object, NULL, &j->notes, r) ||
        !mix_stand(j, r)) {
        return 0;
    }
    if (j->o.at == MIX_AT_PIXEL && !(j->anchor.z < 0.0f)) {
        return mix_fail_at(j, r);
    }
    mix_lobes_read(j);
    for (int i = 0; i < 3 && j->floor >= 0; ++i) { /* most of the foot's pixels are nearer than its middle */
        mix_touch(j, gap(j, r));
    }
    j->facing = j->floor >= 0 ? j->planes.plane[j->floor].normal : j->up;
    turn_scene(j);
    j->gap_m = j->o.at == MIX_AT_WORLD ? NAN : gap(j, r);
    j->placed = object_to_scene(j);
    if (!join_scene(j, &j->placed, r)) {
        return 0;
    }
    look(j);
    return 1;
}
