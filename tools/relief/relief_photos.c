/* relief_photos.c: photos with depth and poses as a relief's views, and blocks around their surfaces. [P11] */
#include "relief_photos.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../common/fvec.h"

enum { MAX_CUBES = 1 << 24 };

static lmb_vec3 get(const float *at) { return vec3(at[0], at[1], at[2]); }

static void put(float *at, lmb_vec3 v)
{
    at[0] = v.x;
    at[1] = v.y;
    at[2] = v.z;
}

/* --- a photo ------------------------------------------------------------------------------------------------------ */

/* A column of the pose, in library coordinates. */
static lmb_vec3 column(const double pose[16], int c)
{
    return vec3((float)pose[c], (float)-pose[4 + c], (float)-pose[8 + c]);
}

static void set_pose(lmb_view *v, const double pose[16])
{
    v->right = normalize3(column(pose, 0));
    v->back = mul3(normalize3(column(pose, 2)), -1.0f);
    v->up = cross3(v->back, v->right);
    v->eye = column(pose, 3);
}

enum { SIDE_MAX = 4096 /* the limit of lmb_relief_open */ };

/* Are the axes orthogonal, and is the position in range for depths? */
static int is_pose(const lmb_view *v)
{
    const float square = dot3(cross3(v->right, v->up), v->back);
    return is_place(v->eye) && fabsf(dot3(v->right, v->back)) < 1e-3f && fabsf(square - 1.0f) < 1e-3f;
}

/* Sets the planes as close to the surface as possible, because depth is coded between them. */
static int set_reach(lmb_view *v, const float *depth)
{
    float min = 3e38f, max = 0.0f;
    for (size_t i = 0; i < (size_t)v->frame_width * (size_t)v->frame_height; ++i) {
        if (depth[i] > 0.0f) {
            min = minf(min, depth[i]);
            max = maxf(max, depth[i]);
        }
    }
    v->near_m = 0.99f * min;
    v->far_m = 1.01f * max;
    return max > 0.0f && max < 1e5f;
}

static int set_view(lmb_view *v, const mix_frame *f, report *r)
{
    static const double origin[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const lmb_pinhole *c = &f->camera;
    memset(v, 0, sizeof *v);
    set_pose(v, f->has_pose ? f->pose : origin);
    v->half_width = 0.5f * (float)c->width / c->fx;
    v->half_height = 0.5f * (float)c->height / c->fy;
    v->kind = LMB_PERSPECTIVE;
    v->frame_width = c->width;
    v->frame_height = c->height;
    if (fabsf(c->cx - 0.5f * (float)(c->width - 1)) > 0.5f || fabsf(c->cy - 0.5f * (float)(c->height - 1)) > 0.5f) {
        return report_fail(r, "a photo whose cx, cy (%g, %g) are not its middle", (double)c->cx, (double)c->cy);
    }
    if (c->width > SIDE_MAX || c->height > SIDE_MAX) {
        return report_fail(r, "a photo of %d x %d pixels: a relief's views have at most %d a side", (int)c->width,
                           (int)c->height, (int)SIDE_MAX);
    }
    if (!is_pose(v)) {
        return report_fail(r, "a photo whose camera_to_world is not a rotation and a place within 2^20 m");
    }
    return set_reach(v, f->depth) || report_fail(r, "a photo without depth");
}

/* The surface point at the middle of a pixel. */
static lmb_vec3 point_at(const relief_photo *p, int32_t x, int32_t y)
{
    const lmb_view *v = &p->view;
    const float z = p->depth[(size_t)y * (size_t)v->frame_width + (size_t)x];
    const float sx = ((float)(2 * x + 1) / (float)v->frame_width - 1.0f) * v->half_width,
                sy = (1.0f - (float)(2 * y + 1) / (float)v->frame_height) * v->half_height;
    return add3(v->eye, mul3(sub3(add3(mul3(v->right, sx), mul3(v->up, sy)), v->back), z));
}

/* The slope of the surface to the right or down, from the neighbour on either side that is nearer in depth. */
static lmb_vec3 slope_at(const relief_photo *p, int32_t x, int32_t y, int32_t dx, int32_t dy)
{
    const int32_t w = p->view.frame_width, h = p->view.frame_height;
    const float z = p->depth[y * w + x];
    lmb_vec3 slope = {0.0f, 0.0f, 0.0f};
    float min = 3e38f;
    for (int32_t k = -1; k <= 1; k += 2) {
        const int32_t nx = x + k * dx, ny = y + k * dy;
        const int inside = nx >= 0 && ny >= 0 && nx < w && ny < h;
        const float n = inside ? p->depth[ny * w + nx] : 0.0f;
        if (n > 0.0f && fabsf(n - z) < min) {
            min = fabsf(n - z);
            slope = mul3(sub3(point_at(p, nx, ny), point_at(p, x, y)), (float)k);
        }
    }
    return slope;
}

static lmb_vec3 normal_at(const relief_photo *p, int32_t x, int32_t y)
{
    const lmb_vec3 across = slope_at(p, x, y, 1, 0), down = slope_at(p, x, y, 0, 1), n = cross3(down, across);
    const float length = length3(n);
    return length > 0.0f ? mul3(n, 1.0f / length) : p->view.back;
}

int relief_photo_of(relief_photo *out, const mix_frame *frame, report *r)
{
    const size_t pixels = (size_t)frame->camera.width * (size_t)frame->camera.height;
    memset(out, 0, sizeof *out);
    out->has_pose = frame->has_pose != 0;
    if (!set_view(&out->view, frame, r)) {
        return 0;
    }
    out->depth = malloc(pixels * sizeof(float));
    out->normal = malloc(3 * pixels * sizeof(float));
    out->colour = malloc(3 * pixels * sizeof(float));
    if (out->depth == NULL || out->normal == NULL || out->colour == NULL) {
        relief_photo_free(out);
        return report_fail(r, "not enough memory for a photo of %.0f pixels", (double)pixels);
    }
    memcpy(out->depth, frame->depth, pixels * sizeof(float));
    memcpy(out->colour, frame->light.pixels, 3 * pixels * sizeof(float));
    for (int32_t y = 0; y < frame->camera.height; ++y) {
        for (int32_t x = 0; x < frame->camera.width; ++x) {
            put(out->normal + 3 * ((size_t)y * (size_t)frame->camera.width + (size_t)x), normal_at(out, x, y));
        }
    }
    return 1;
}

int relief_photo_read(relief_photo *out, const char *prefix, report *r)
{
    mix_source from;
    mix_frame frame;
    memset(&from, 0, sizeof from);
    from.frame = prefix;
    if (!mix_frame_read(&frame, &from, r)) {
        return 0;
    }
    const int ok = relief_photo_of(out, &frame, r);
    mix_frame_free(&frame);
    return ok;
}

void relief_photo_free(relief_photo *p)
{
    free(p->depth);
    free(p->normal);
    free(p->colour);
    memset(p, 0, sizeof *p);
}

/* --- blocks ------------------------------------------------------------------------------------------------------- */

/* Cubes around points. Arrays have count[0] x count[1] x count[2] cubes, or one corner more each way. */
typedef struct blocks {
    lmb_vec3 low;
    float side;
    int32_t count[3];
    float *colour;    /* sums, 3 per cube */
    uint32_t *points; /* by cube */
    uint32_t *vertex; /* by corner; UINT32_MAX: none */
} blocks;

static void bounds(lmb_vec3 *low, lmb_vec3 *high, const relief_photo *photo, int32_t count)
{
    *low = vec3(3e38f, 3e38f, 3e38f);
    *high = vec3(-3e38f, -3e38f, -3e38f);
    for (int32_t i = 0; i < count; ++i) {
        const int32_t w = photo[i].view.frame_width, h = photo[i].view.frame_height;
        for (int32_t k = 0; k < w * h; ++k) {
            if (photo[i].depth[k] > 0.0f) {
                const lmb_vec3 p = point_at(&photo[i], k % w, k / w);
                *low = min3(*low, p);
                *high = max3(*high, p);
            }
        }
    }
}

float relief_photo_size(const relief_photo *photo, int32_t count)
{
    lmb_vec3 low, high;
    bounds(&low, &high, photo, count);
    return maxf(maxf(high.x - low.x, high.y - low.y), high.z - low.z);
}

static size_t cube_at(const blocks *b, int32_t x, int32_t y, int32_t z)
{
    return ((size_t)z * (size_t)b->count[1] + (size_t)y) * (size_t)b->count[0] + (size_t)x;
}

static int is_full(const blocks *b, int32_t x, int32_t y, int32_t z)
{
    return x >= 0 && y >= 0 && z >= 0 && x < b->count[0] && y < b->count[1] && z < b->count[2] &&
           b->points[cube_at(b, x, y, z)] > 0;
}

static int32_t clamp_to(float at, int32_t count) { return (int32_t)clampf(at, 0.0f, (float)(count - 1)); }

static void add_photo(blocks *b, const relief_photo *photo)
{
    const int32_t w = photo->view.frame_width, h = photo->view.frame_height;
    for (int32_t k = 0; k < w * h; ++k) {
        if (photo->depth[k] > 0.0f) {
            const lmb_vec3 at = mul3(sub3(point_at(photo, k % w, k / w), b->low), 1.0f / b->side);
            const size_t cube = cube_at(b, clamp_to(at.x, b->count[0]), clamp_to(at.y, b->count[1]),
                                        clamp_to(at.z, b->count[2]));
            ++b->points[cube];
            for (size_t c = 0; c < 3; ++c) {
                b->colour[3 * cube + c] += photo->colour[3 * (size_t)k + c];
            }
        }
    }
}

/* The mean colour of the cubes at a corner. */
static lmb_vec3 corner_colour(const blocks *b, int32_t x, int32_t y, int32_t z)
{
    lmb_vec3 sum = {0.0f, 0.0f, 0.0f};
    float n = 0.0f;
    for (int k = 0; k < 8; ++k) {
        const int32_t cx = x - (k & 1), cy = y - (k >> 1 & 1), cz = z - (k >> 2);
        if (is_full(b, cx, cy, cz)) {
            const size_t cube = cube_at(b, cx, cy, cz);
            sum = add3(sum, get(b->colour + 3 * cube));
            n += (float)b->points[cube];
        }
    }
    return mul3(sum, 1.0f / maxf(n, 1.0f));
}

static uint32_t corner(blocks *b, triangle_mesh *out, int32_t x, int32_t y, int32_t z)
{
    const size_t row = (size_t)z * (size_t)(b->count[1] + 1) + (size_t)y;
    uint32_t *v = &b->vertex[row * (size_t)(b->count[0] + 1) + (size_t)x];
    if (*v == UINT32_MAX) {
        *v = out->vertex_count++;
        put(out->positions + 3 * (size_t)*v, add3(b->low, mul3(vec3((float)x, (float)y, (float)z), b->side)));
        put(out->normals + 3 * (size_t)*v, vec3(0.0f, 0.0f, 0.0f));
        put(out->colours + 3 * (size_t)*v, corner_colour(b, x, y, z));
    }
    return *v;
}

/* Adds the face of a cube towards +-axis: two triangles, counter-clockwise from outside. */
static void add_face(blocks *b, triangle_mesh *out, const int32_t at[3], int axis, int up)
{
    static const int order[2][6] = {{0, 2, 1, 1, 2, 3}, {0, 1, 2, 2, 1, 3}};
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    uint32_t square[4];
    for (int k = 0; k < 4; ++k) {
        int32_t c[3] = {at[0], at[1], at[2]};
        c[axis] += up;
        c[u] += k & 1;
        c[v] += k >> 1;
        square[k] = corner(b, out, c[0], c[1], c[2]);
        out->normals[3 * (size_t)square[k] + (size_t)axis] += up ? 1.0f : -1.0f;
    }
    for (int k = 0; k < 6; ++k) {
        out->indices[3 * (size_t)out->triangle_count + (size_t)k] = square[order[up][k]];
    }
    out->triangle_count += 2;
}

/* Counts the faces; if `out` is not NULL, also makes them. */
static size_t add_faces(blocks *b, triangle_mesh *out)
{
    const size_t row = (size_t)b->count[0], slice = row * (size_t)b->count[1], all = slice * (size_t)b->count[2];
    size_t n = 0;
    for (size_t i = 0; i < 6 * all; ++i) {
        const size_t cube = i / 6;
        const int axis = (int)(i % 6) / 2, up = (int)(i % 2);
        const int32_t at[3] = {(int32_t)(cube % row), (int32_t)(cube % slice / row), (int32_t)(cube / slice)};
        int32_t next[3] = {at[0], at[1], at[2]};
        next[axis] += up ? 1 : -1;
        if (b->points[cube] > 0 && !is_full(b, next[0], next[1], next[2])) {
            ++n;
            if (out != NULL) {
                add_face(b, out, at, axis, up);
            }
        }
    }
    return n;
}

static int build(blocks *b, triangle_mesh *out, const relief_photo *photo, int32_t count)
{
    for (int32_t i = 0; i < count; ++i) {
        add_photo(b, &photo[i]);
    }
    const size_t faces = add_faces(b, NULL);
    out->positions = malloc(12 * faces * sizeof(float));
    out->normals = malloc(12 * faces * sizeof(float));
    out->colours = malloc(12 * faces * sizeof(float));
    out->indices = malloc(6 * faces * sizeof(uint32_t));
    if (out->positions == NULL || out->normals == NULL || out->colours == NULL || out->indices == NULL) {
        return 0;
    }
    add_faces(b, out);
    for (uint32_t v = 0; v < out->vertex_count; ++v) {
        float *n = out->normals + 3 * (size_t)v;
        const float length = length3(get(n));
        put(n, length > 0.0f ? mul3(get(n), 1.0f / length) : vec3(0.0f, 1.0f, 0.0f));
    }
    return 1;
}

int relief_blocks(triangle_mesh *out, const relief_photo *photo, int32_t count, float side, report *r)
{
    blocks b;
    lmb_vec3 high;
    memset(&b, 0, sizeof b);
    memset(out, 0, sizeof *out);
    bounds(&b.low, &high, photo, count);
    const lmb_vec3 cubes = mul3(sub3(high, b.low), 1.0f / side);
    if (!(cubes.x + 1.0f < MAX_CUBES && cubes.y + 1.0f < MAX_CUBES && cubes.z + 1.0f < MAX_CUBES &&
          ((double)cubes.x + 2.0) * ((double)cubes.y + 2.0) * ((double)cubes.z + 2.0) < (double)MAX_CUBES)) {
        return report_fail(r, "blocks of %g m are too small for what the photos show", (double)side);
    }
    b.side = side;
    b.count[0] = 1 + (int32_t)cubes.x;
    b.count[1] = 1 + (int32_t)cubes.y;
    b.count[2] = 1 + (int32_t)cubes.z;
    const size_t all = (size_t)b.count[0] * (size_t)b.count[1] * (size_t)b.count[2],
                 corners = (size_t)(b.count[0] + 1) * (size_t)(b.count[1] + 1) * (size_t)(b.count[2] + 1);
    b.colour = calloc(3 * all, sizeof(float));
    b.points = calloc(all, sizeof(uint32_t));
    b.vertex = malloc(corners * sizeof(uint32_t));
    const int ok = b.colour != NULL && b.points != NULL && b.vertex != NULL &&
                   memset(b.vertex, 0xff, corners * sizeof(uint32_t)) != NULL && build(&b, out, photo, count);
    free(b.colour);
    free(b.points);
    free(b.vertex);
    if (!ok) {
        triangle_mesh_free(out);
        return report_fail(r, "not enough memory for blocks of %g m", (double)side);
    }
    return 1;
}
