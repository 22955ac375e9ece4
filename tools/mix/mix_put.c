/* mix_put.c: the scene of the real surfaces and the placed object. */
#include "mix_world.h"

#include <math.h>
#include <string.h>

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

static const lmb_mat4 identity = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};

/* The inverse of a pose. The pose's camera has +z ahead and y down; the library's has -z ahead and y up. */
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

/* The real mesh comes first: everything of the object moves up by one. */
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

/* Turns the back axis to point out of the wall, so that voxels are aligned to it. */
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

lmb_mat4 mix_camera_of(const mix_job *j) { return j->frame.has_pose ? world_to_camera(j->frame.pose) : identity; }

void mix_turn_scene(mix_job *j)
{
    const lmb_mat4 camera = mix_camera_of(j);
    j->axes = lmb_axes_upright(j->up);
    if (j->hangs) {
        turn_to_wall(&j->axes, j->up, j->facing);
    }
    const lmb_mat4 turn = of_axes(j->axes.right, j->axes.up, j->axes.back, (lmb_vec3){0, 0, 0});
    j->from_world = mix_product(&turn, &camera);
}

/* A margin for samples, which lie up to half a pixel off and read four pixels. */
static void set_box(mix_job *j, float x0, float y0, float x1, float y1)
{
    const float w = (float)j->frame.camera.width, h = (float)j->frame.camera.height;
    j->box_px[0] = (int32_t)fminf(fmaxf(x0 - 2.0f, 0.0f), w);
    j->box_px[1] = (int32_t)fminf(fmaxf(y0 - 2.0f, 0.0f), h);
    j->box_px[2] = (int32_t)fminf(fmaxf(x1 + 4.0f, 0.0f), w);
    j->box_px[3] = (int32_t)fminf(fmaxf(y1 + 4.0f, 0.0f), h);
}

/* Sets the box of the covered area in the picture, and whether the object is in it. */
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
            j->inside = mix_is_inside(j);
            set_box(j, 0.0f, 0.0f, (float)c->width, (float)c->height);
            return;
        }
        x0 = fminf(x0, x);
        y0 = fminf(y0, y);
        x1 = fmaxf(x1, x);
        y1 = fmaxf(y1, y);
    }
    set_box(j, x0, y0, x1, y1);
    j->inside = mix_is_inside(j);
}

int mix_put_object(mix_job *j, report *r)
{
    if (!join_scene(j, &j->placed, r)) {
        return 0;
    }
    if (j->o.object != NULL) {
        look(j);
    }
    return 1;
}
