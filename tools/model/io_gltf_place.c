/* io_gltf_place.c: cameras and punctual lights, placed by their nodes. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "io_gltf.h"

static int spot_cone(lmb_light *out, gltf *g, uint32_t light)
{
    const json *doc = &g->doc;
    const uint32_t spot = json_member(doc, light, "spot");
    double inner = 0, outer = 0.78539816339744831; /* pi / 4 */
    if (!json_read_double(&inner, doc, json_member(doc, spot, "innerConeAngle"), g->b->r) ||
        !json_read_double(&outer, doc, json_member(doc, spot, "outerConeAngle"), g->b->r))
        return 0;
    if (!(inner >= 0 && inner <= outer && outer > 0 && outer < 1.5709))
        return json_fail(doc, spot, g->b->r, "needs 0 <= innerConeAngle <= outerConeAngle <= pi / 2");
    out->kind = LMB_LIGHT_SPOT;
    out->cos_inner = (float)cos(inner);
    out->cos_outer = (float)cos(outer);
    return 1;
}

static int light_kind(lmb_light *out, gltf *g, uint32_t light)
{
    const uint32_t type = json_member(&g->doc, light, "type");
    out->kind = LMB_LIGHT_POINT;
    out->cos_inner = 1.0f;
    out->cos_outer = 0.0f;
    if (json_equals(&g->doc, type, "spot"))
        return spot_cone(out, g, light);
    if (json_equals(&g->doc, type, "directional")) {
        out->kind = LMB_LIGHT_DIRECTIONAL;
        return 1;
    }
    return json_equals(&g->doc, type, "point") ||
           json_fail(&g->doc, light, g->b->r, "type must be point, spot or directional");
}

/* A light of the document placed by a node: it points along -Z of the node. */
static int read_light(lmb_light *out, gltf *g, uint32_t light)
{
    const json *doc = &g->doc;
    double colour[3] = {1, 1, 1}, intensity = 1, range = 0;
    int i;
    memset(out, 0, sizeof *out);
    if (!light_kind(out, g, light) || !json_read_doubles(colour, 3, doc, json_member(doc, light, "color"), g->b->r) ||
        !json_read_double(&intensity, doc, json_member(doc, light, "intensity"), g->b->r) ||
        !json_read_double(&range, doc, json_member(doc, light, "range"), g->b->r))
        return 0;
    for (i = 0; i < 3; ++i) {
        const double value = colour[i] * intensity;
        if (!(value >= 0 && value <= 1e30))
            return json_fail(doc, light, g->b->r, "color x intensity is no intensity");
        out->intensity[i] = (float)value;
    }
    /* As in other viewers, 0 or less means no range. Directional lights never have one. */
    out->range = out->kind != LMB_LIGHT_DIRECTIONAL && range > 0 && range < 1e9 ? (float)range : 0.0f;
    return 1;
}

static uint32_t light_reference(const gltf *g, uint32_t node)
{
    const uint32_t extensions = json_member(&g->doc, node, "extensions");
    return json_member(&g->doc, json_member(&g->doc, extensions, "KHR_lights_punctual"), "light");
}

int gltf_lights(const gltf_tree *t, gltf *g)
{
    const uint32_t extensions = json_member(&g->doc, 0, "extensions");
    uint32_t i, light, total = 0;
    if (!gltf_list_of(&g->lights, g,
                      json_member(&g->doc, json_member(&g->doc, extensions, "KHR_lights_punctual"), "lights")))
        return 0;
    for (i = 0; i < t->count; ++i)
        total += light_reference(g, g->nodes.items[t->order[i]]) != JSON_NONE;
    g->b->lights = (lmb_light *)build_keep(g->b, total, sizeof *g->b->lights);
    g->light_node = (uint32_t *)build_keep(g->b, total, sizeof *g->light_node);
    if (!g->b->lights || !g->light_node)
        return 0;
    for (i = 0; i < t->count; ++i) {
        const uint32_t index = t->order[i];
        lmb_light *to = &g->b->lights[g->b->light_count];
        if (!gltf_item(&light, g, &g->lights, light_reference(g, g->nodes.items[index])))
            return 0;
        if (light == JSON_NONE || t->hidden[index])
            continue;
        if (!read_light(to, g, light))
            return 0;
        model_place_light(to, t->world[index].m, t->turn[index].m);
        g->light_node[g->b->light_count++] = i;
    }
    return 1;
}

/* Positive, also in binary32. */
static int is_length(double v) { return v > 1e-30 && v < 1e30; }

static int read_perspective(model_camera *out, gltf *g, uint32_t camera)
{
    const json *doc = &g->doc;
    double yfov = 0, aspect = 0, near_m = 0, far_m = 0;
    if (!json_read_double(&yfov, doc, json_member(doc, camera, "yfov"), g->b->r) ||
        !json_read_double(&aspect, doc, json_member(doc, camera, "aspectRatio"), g->b->r) ||
        !json_read_double(&near_m, doc, json_member(doc, camera, "znear"), g->b->r) ||
        !json_read_double(&far_m, doc, json_member(doc, camera, "zfar"), g->b->r))
        return 0;
    if (!(yfov > 1e-6 && yfov < 3.14159) || !is_length(near_m) || (aspect != 0 && !is_length(aspect)) ||
        (far_m != 0 && !(is_length(far_m) && far_m > near_m)))
        return json_fail(doc, camera, g->b->r, "needs 0 < yfov < pi, znear > 0, zfar > znear, aspectRatio > 0");
    out->yfov_rad = (float)yfov;
    out->aspect = (float)aspect;
    out->near_m = (float)near_m;
    out->far_m = (float)far_m;
    return 1;
}

static int read_orthographic(model_camera *out, gltf *g, uint32_t camera)
{
    const json *doc = &g->doc;
    double xmag = 0, ymag = 0, near_m = 0, far_m = 0;
    if (!json_read_double(&xmag, doc, json_member(doc, camera, "xmag"), g->b->r) ||
        !json_read_double(&ymag, doc, json_member(doc, camera, "ymag"), g->b->r) ||
        !json_read_double(&near_m, doc, json_member(doc, camera, "znear"), g->b->r) ||
        !json_read_double(&far_m, doc, json_member(doc, camera, "zfar"), g->b->r))
        return 0;
    if (!is_length(fabs(xmag)) || !is_length(fabs(ymag)) || !(near_m >= 0) || !is_length(far_m) || !(far_m > near_m))
        return json_fail(doc, camera, g->b->r, "needs xmag and ymag other than 0, 0 <= znear < zfar");
    out->orthographic = 1;
    out->half_width = (float)fabs(xmag);
    out->half_height = (float)fabs(ymag);
    out->aspect = (float)fabs(xmag / ymag);
    out->near_m = (float)near_m;
    out->far_m = (float)far_m;
    return 1;
}

/* Named after the node that places it, otherwise after the camera, otherwise by number. */
static int read_camera(model_camera *out, gltf *g, uint32_t camera, uint32_t node)
{
    const json *doc = &g->doc;
    const uint32_t flat = json_member(doc, camera, "orthographic"), deep = json_member(doc, camera, "perspective");
    if (json_string(out->name, sizeof out->name, doc, json_member(doc, node, "name")) == 0 &&
        json_string(out->name, sizeof out->name, doc, json_member(doc, camera, "name")) == 0)
        snprintf(out->name, sizeof out->name, "camera %u", (unsigned)g->b->out->camera_count);
    if (json_equals(doc, json_member(doc, camera, "type"), "orthographic") && flat != JSON_NONE)
        return read_orthographic(out, g, flat);
    if (json_equals(doc, json_member(doc, camera, "type"), "perspective") && deep != JSON_NONE)
        return read_perspective(out, g, deep);
    return json_fail(doc, camera, g->b->r, "type must be perspective or orthographic, with the object of that name");
}

int gltf_cameras(const gltf_tree *t, gltf *g)
{
    uint32_t i, camera, total = 0;
    model *out = g->b->out;
    for (i = 0; i < t->count; ++i)
        total += json_member(&g->doc, g->nodes.items[t->order[i]], "camera") != JSON_NONE;
    out->cameras = (model_camera *)build_keep(g->b, total, sizeof *out->cameras);
    g->camera_node = (uint32_t *)build_keep(g->b, total, sizeof *g->camera_node);
    if (!out->cameras || !g->camera_node)
        return 0;
    for (i = 0; i < t->count; ++i) {
        const uint32_t index = t->order[i], node = g->nodes.items[index];
        if (!gltf_item(&camera, g, &g->cameras, json_member(&g->doc, node, "camera")))
            return 0;
        if (camera == JSON_NONE)
            continue;
        if (!read_camera(&out->cameras[out->camera_count], g, camera, node))
            return 0;
        model_place_camera(&out->cameras[out->camera_count], t->world[index].m, t->turn[index].m);
        g->camera_node[out->camera_count++] = i;
    }
    return 1;
}
