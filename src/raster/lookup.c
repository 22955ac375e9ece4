/* lookup.c: decodes single vertices, and the opacity of a triangle at a pixel. Layer 3. */
#include <lambent/lookup.h>

#include "../base/vertex.h"
#include "plane.h"
#include "resolve.h"

int lmb_mesh_vertex(lmb_vertex *out, const lmb_mesh *mesh, uint32_t vertex)
{
    if (out == NULL || mesh == NULL || vertex >= mesh->vertex_count) {
        return 0;
    }
    out->position = mesh_position(mesh, vertex);
    out->normal = mesh_normal(mesh, vertex);
    mesh_uv(mesh, vertex, out->uv);
    mesh_colour(mesh, vertex, out->colour);
    return 1;
}

uint32_t lmb_mesh_index(const lmb_mesh *mesh, uint32_t corner)
{
    return mesh != NULL && corner / 3 < mesh->triangle_count ? mesh_index(mesh, corner) : UINT32_MAX;
}

float lmb_triangle_alpha(const lmb_view *view, const lmb_scene *scene, uint32_t id, int32_t x, int32_t y)
{
    lmb_triangle t;
    lmb_rays rays; /* of the whole tile, as for the pixel's other attributes */
    lmb_plane plane;
    lmb_resolve_alpha alpha;
    float b1, b2;
    if (view == NULL || x < 0 || y < 0 || x >= mini(view->frame_width, LMB_MAX_FRAME) ||
        y >= mini(view->frame_height, LMB_MAX_FRAME) || !lmb_triangle_fetch(&t, scene, id)) {
        return 0.0f;
    }
    lmb_resolve_rays(&rays, view, x / LMB_TILE * LMB_TILE, y / LMB_TILE * LMB_TILE);
    lmb_resolve_plane(&plane, t.corner, &rays);
    lmb_resolve_alpha_of(&alpha, &t);
#if LMB_MULTISAMPLE
    if ((t.material->flags & (LMB_ALPHA_MASK | LMB_ALPHA_BLEND)) != LMB_ALPHA_MASK) {
        return lmb_resolve_blend_alpha(&alpha, scene, &plane, &rays, x % LMB_TILE, y % LMB_TILE);
    }
#endif
    lmb_resolve_point(&b1, &b2, &plane, &rays, (float)(x % LMB_TILE), (float)(y % LMB_TILE));
    return lmb_resolve_alpha_at(&alpha, scene, b1, b2);
}
