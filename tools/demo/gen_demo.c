/* gen_demo.c: prints demo_scene_data.inc, the data of the built-in demo scene: a small gallery room.
 *
 * Everything is computed in double with + - * / and sqrt only (sine included), so that the printed data are the same
 * on every machine; packing, mips and bounds come from the library itself. All sizes are metres. */
#include <lambent/lambent.h>

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_VERTICES = 1536, MAX_TRIANGLES = 3072, MAX_INSTANCES = 32 };
enum { TILE_TEXELS = 32, TILE_LEVELS = 6 };

#define ROOM_X 2.0     /* half the width */
#define ROOM_Y 2.75    /* height */
#define ROOM_BACK -2.0 /* z of the back wall */
#define ROOM_FRONT 2.75 /* z of the front wall, behind the camera; all exact in float: neighbours share corners */
#define TILES_X (2.0 * ROOM_X / 0.8) /* repeats of the floor's texture, 0.8 m each */
#define TILES_Z ((ROOM_FRONT - ROOM_BACK) / 0.8)

/* A mesh under construction. `flat`: no normals are stored. */
typedef struct shape {
    const char *name;
    double position[MAX_VERTICES][3], normal[MAX_VERTICES][3];
    double uv[MAX_VERTICES][2];
    uint8_t colours[MAX_VERTICES * 4];
    uint16_t indices[MAX_TRIANGLES * 3];
    float position_f32[MAX_VERTICES * 3];
    int16_t position_i16[MAX_VERTICES * 4];
    int16_t octahedral[MAX_VERTICES * 2];
    uint16_t uv_u16[MAX_VERTICES * 2];
    lmb_mesh mesh;
} shape;

enum { QUAD, BOX, SPHERE, KNOT, PAINTING, SHAPES };
static shape shapes[SHAPES];

/* Albedos that real paint reaches; red and teal are saturated enough for their bounce to be seen. */
enum { TILES, WHITE, RED, TEAL, STONE, CLAY, BRASS, WOOD, CANVAS, MATERIALS };
static const char *const material_name[MATERIALS] = {"floor tiles", "white plaster", "red wall", "teal wall", "plinth",
                                                     "sphere and block", "knot", "frame", "painting"};
static const lmb_material materials[MATERIALS] = {
    {{0.95f, 0.95f, 0.95f}, 1.0f, 0.0f, 0, 0, 0, 0.0f, {0, 0, 0}, {0, 0, 0}, 0.0f, 0, 0, 0.0f},
    {{0.78f, 0.77f, 0.75f}, 1.0f, 0.0f, -1, 0, 0, 0.0f, {0, 0, 0}, {0, 0, 0}, 0.0f, 0, 0, 0.0f},
    {{0.80f, 0.14f, 0.05f}, 1.0f, 0.0f, -1, 0, 0, 0.0f, {0, 0, 0}, {0, 0, 0}, 0.0f, 0, 0, 0.0f},
    {{0.05f, 0.44f, 0.54f}, 1.0f, 0.0f, -1, 0, 0, 0.0f, {0, 0, 0}, {0, 0, 0}, 0.0f, 0, 0, 0.0f},
    {{0.74f, 0.73f, 0.70f}, 1.0f, 0.0f, -1, 0, 0, 0.0f, {0, 0, 0}, {0, 0, 0}, 0.0f, 0, 0, 0.0f},
    {{0.84f, 0.83f, 0.81f}, 1.0f, 0.0f, -1, 0, 0, 0.0f, {0, 0, 0}, {0, 0, 0}, 0.0f, 0, 0, 0.0f},
    {{0.80f, 0.52f, 0.13f}, 1.0f, 0.0f, -1, 0, 0, 0.0f, {0, 0, 0}, {0, 0, 0}, 0.0f, 0, 0, 0.0f},
    {{0.16f, 0.09f, 0.05f}, 1.0f, 0.0f, -1, 0, 0, 0.0f, {0, 0, 0}, {0, 0, 0}, 0.0f, 0, 0, 0.0f},
    {{1.00f, 1.00f, 1.00f}, 1.0f, 0.0f, -1, 0, 0, 0.0f, {0, 0, 0}, {0, 0, 0}, 0.0f, 0, 0, 0.0f},
};

static lmb_instance instances[MAX_INSTANCES];
static uint32_t instance_count, next_id = 1;
static uint8_t texels[TILE_TEXELS * TILE_TEXELS * 4 * 2];

/* Sine of `turns` whole turns, folded to the first quarter, by Taylor's series to x^19 (remainder under 3e-16
 * there), because libm's sine may differ in the last bit between machines. */
static double sine(double turns)
{
    double t = turns - floor(turns), sign = 1.0, x, term, sum;
    int k;
    if (t > 0.5) {
        t -= 0.5;
        sign = -1.0;
    }
    if (t > 0.25) {
        t = 0.5 - t;
    }
    x = t * 6.283185307179586;
    term = sum = x;
    for (k = 2; k < 20; k += 2) {
        term = -term * x * x / (double)(k * (k + 1));
        sum += term;
    }
    return sign * sum;
}

static double cosine(double turns)
{
    return sine(turns + 0.25);
}

static double length(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static void cross(double out[3], const double a[3], const double b[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* ---- building shapes ---- */

static uint16_t add_vertex(shape *s, double x, double y, double z)
{
    uint32_t i = s->mesh.vertex_count++;
    s->position[i][0] = x;
    s->position[i][1] = y;
    s->position[i][2] = z;
    return (uint16_t)i;
}

static void add_triangle(shape *s, uint32_t a, uint32_t b, uint32_t c)
{
    uint16_t *out = s->indices + 3 * s->mesh.triangle_count++;
    out[0] = (uint16_t)a;
    out[1] = (uint16_t)b;
    out[2] = (uint16_t)c;
}

/* Counter-clockwise corners a b c d. */
static void add_quad(shape *s, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    add_triangle(s, a, b, c);
    add_triangle(s, a, c, d);
}

/* Unit square in x and y, facing +z; uv runs over the floor's tiles. */
static void build_quad(shape *s)
{
    int i;
    s->name = "quad";
    s->mesh.uv_format = LMB_UV_U16;
    s->mesh.uv_scale[0] = (float)TILES_X;
    s->mesh.uv_scale[1] = (float)TILES_Z;
    for (i = 0; i < 4; ++i) {
        s->uv[i][0] = i & 1;
        s->uv[i][1] = i >> 1;
        add_vertex(s, i & 1, i >> 1, 0.0);
    }
    add_quad(s, 0, 1, 3, 2);
}

/* Unit cube standing on y = 0, centred in x and z. Corner bits: 1 x, 2 y, 4 z. */
static void build_box(shape *s)
{
    static const uint8_t sides[6][4] = {{4, 5, 7, 6}, {1, 0, 2, 3}, {5, 1, 3, 7},
                                        {0, 4, 6, 2}, {6, 7, 3, 2}, {0, 1, 5, 4}};
    int i;
    s->name = "box";
    for (i = 0; i < 8; ++i) {
        add_vertex(s, (i & 1) - 0.5, (i >> 1) & 1, (i >> 2) - 0.5);
    }
    for (i = 0; i < 6; ++i) {
        add_quad(s, sides[i][0], sides[i][1], sides[i][2], sides[i][3]);
    }
}

/* Unit sphere: rings of `around` vertices between two poles. */
static void build_sphere(shape *s, int around, int rings)
{
    int i, j;
    s->name = "sphere";
    s->mesh.position_format = LMB_POSITION_I16;
    add_vertex(s, 0.0, -1.0, 0.0);
    for (j = 1; j <= rings; ++j) {
        for (i = 0; i < around; ++i) {
            double r = sine(0.5 * j / (rings + 1)), turn = (double)i / around;
            add_vertex(s, r * sine(turn), -cosine(0.5 * j / (rings + 1)), r * cosine(turn));
        }
    }
    add_vertex(s, 0.0, 1.0, 0.0);
    for (i = 0; i < around; ++i) {
        uint32_t k = (uint32_t)((i + 1) % around), last = (uint32_t)(1 + (rings - 1) * around);
        add_triangle(s, 0, 1 + k, 1 + (uint32_t)i);
        for (j = 1; j < rings; ++j) {
            uint32_t low = (uint32_t)(1 + (j - 1) * around), high = low + (uint32_t)around;
            add_quad(s, low + (uint32_t)i, low + k, high + k, high + (uint32_t)i);
        }
        add_triangle(s, last + (uint32_t)i, last + k, s->mesh.vertex_count - 1);
    }
    memcpy(s->normal, s->position, sizeof s->normal);
}

/* Position and direction of a trefoil knot on a torus (2 turns around, 3 through), and the torus' normal there. The
 * normal is perpendicular to the curve and closes after one round, so it frames the tube. */
static void knot_frame(double at[3], double along[3], double out[3], double turn)
{
    const double minor = 0.42;
    double cp = cosine(2.0 * turn), sp = sine(2.0 * turn), cq = cosine(3.0 * turn), sq = sine(3.0 * turn);
    double r = 1.0 + minor * cq, size;
    at[0] = r * cp;
    at[1] = r * sp;
    at[2] = minor * sq;
    along[0] = -3.0 * minor * sq * cp - 2.0 * r * sp;
    along[1] = -3.0 * minor * sq * sp + 2.0 * r * cp;
    along[2] = 3.0 * minor * cq;
    size = length(along);
    along[0] /= size;
    along[1] /= size;
    along[2] /= size;
    out[0] = cq * cp;
    out[1] = cq * sp;
    out[2] = sq;
}

static void build_knot(shape *s, int along, int around, double tube)
{
    int i, j, k;
    s->name = "knot";
    s->mesh.position_format = LMB_POSITION_I16;
    for (i = 0; i < along; ++i) {
        double at[3], run[3], out[3], side[3];
        knot_frame(at, run, out, (double)i / along);
        cross(side, run, out);
        for (j = 0; j < around; ++j) {
            double c = cosine((double)j / around), n = sine((double)j / around);
            double *normal = s->normal[s->mesh.vertex_count];
            for (k = 0; k < 3; ++k) {
                normal[k] = c * out[k] + n * side[k];
            }
            add_vertex(s, at[0] + tube * normal[0], at[1] + tube * normal[1], at[2] + tube * normal[2]);
        }
    }
    for (i = 0; i < along; ++i) {
        for (j = 0; j < around; ++j) {
            uint32_t here = (uint32_t)(i * around), next = (uint32_t)((i + 1) % along * around);
            uint32_t a = (uint32_t)j, b = (uint32_t)((j + 1) % around);
            add_quad(s, here + a, here + b, next + b, next + a);
        }
    }
}

static double lowest_y(const shape *s)
{
    double low = s->position[0][1];
    uint32_t i;
    for (i = 1; i < s->mesh.vertex_count; ++i) {
        low = s->position[i][1] < low ? s->position[i][1] : low;
    }
    return low;
}

/* ---- the painting: a sun in the evening, drawn with vertex colours ---- */

#define SUN_X 0.14 /* from the painting's centre */
#define SUN_Y -0.04
#define SUN_RADIUS 0.15
#define PAINTING_W 1.04
#define PAINTING_H 0.74

static void paint(shape *s, uint32_t vertex, const double colour[3])
{
    int k;
    for (k = 0; k < 3; ++k) {
        s->colours[4 * vertex + k] = (uint8_t)(255.0 * (colour[k] > 1.0 ? 1.0 : colour[k]) + 0.5);
    }
    s->colours[4 * vertex + 3] = 255;
}

/* Night blue above, dusk below, and the sun's glow around it. */
static void paint_sky(shape *s, uint32_t vertex)
{
    static const double low[3] = {0.55, 0.16, 0.10}, high[3] = {0.03, 0.06, 0.22}, glow[3] = {0.95, 0.45, 0.08};
    double x = s->position[vertex][0] - SUN_X, y = s->position[vertex][1] - SUN_Y;
    double up = s->position[vertex][1] / PAINTING_H + 0.5, near = 1.0 / (1.0 + 26.0 * (x * x + y * y)), colour[3];
    int k;
    for (k = 0; k < 3; ++k) {
        colour[k] = low[k] + (high[k] - low[k]) * up;
        colour[k] += (glow[k] - colour[k]) * near;
    }
    paint(s, vertex, colour);
}

/* Point `k` of `side` * 4 on the rectangle's border, counter-clockwise from the lower left corner. */
static void border_point(double *x, double *y, int k, int side)
{
    static const int8_t corner[5][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
    double t = (double)(k % side) / side;
    const int8_t *a = corner[k / side], *b = corner[k / side + 1];
    *x = PAINTING_W / 2.0 * (a[0] + (b[0] - a[0]) * t);
    *y = PAINTING_H / 2.0 * (a[1] + (b[1] - a[1]) * t);
}

/* A disc of sun, then rings of sky that widen to the border; the sun's edge has two vertices, so that it is sharp. */
static void build_painting(shape *s, int side, int rings)
{
    static const double sun[3] = {1.0, 0.86, 0.42}, rim[3] = {1.0, 0.62, 0.18};
    int spokes = 4 * side, j, k;
    s->name = "painting";
    s->mesh.colours = s->colours;
    paint(s, add_vertex(s, SUN_X, SUN_Y, 0.0), sun);
    for (j = -1; j <= rings; ++j) {
        double share = j < 0 ? 0.0 : (double)j / rings;
        for (k = 0; k < spokes; ++k) {
            double x, y, reach;
            uint32_t v;
            border_point(&x, &y, k, side);
            x -= SUN_X;
            y -= SUN_Y;
            reach = SUN_RADIUS / sqrt(x * x + y * y);
            reach += (1.0 - reach) * share;
            v = add_vertex(s, SUN_X + x * reach, SUN_Y + y * reach, 0.0);
            if (j < 0) {
                paint(s, v, rim);
            } else {
                paint_sky(s, v);
            }
        }
    }
    for (k = 0; k < spokes; ++k) {
        uint32_t a = (uint32_t)k, b = (uint32_t)((k + 1) % spokes);
        add_triangle(s, 0, 1 + a, 1 + b);
        for (j = 1; j <= rings; ++j) {
            uint32_t in = (uint32_t)(1 + j * spokes), out = in + (uint32_t)spokes;
            add_quad(s, in + a, out + a, out + b, in + b);
        }
    }
}

/* ---- the floor's texture: four tiles of two stones, with a joint of one texel ---- */

static void build_tiles(void)
{
    static const uint8_t stone[4][3] = {{206, 203, 197}, {148, 146, 142}, {155, 152, 147}, {212, 208, 201}};
    static const uint8_t joint[3] = {94, 92, 89};
    const int half = TILE_TEXELS / 2;
    uint32_t noise = 1u;
    int x, y, k;
    for (y = 0; y < TILE_TEXELS; ++y) {
        for (x = 0; x < TILE_TEXELS; ++x) {
            const uint8_t *c = x % half == 0 || y % half == 0 ? joint : stone[y / half * 2 + x / half];
            uint8_t *out = texels + 4 * (y * TILE_TEXELS + x);
            noise = noise * 1664525u + 1013904223u;
            for (k = 0; k < 3; ++k) {
                out[k] = (uint8_t)(c[k] + (noise >> 29)); /* a grain of up to 7 steps */
            }
            out[3] = 255;
        }
    }
    lmb_texture_mips(texels, TILE_TEXELS, TILE_TEXELS, TILE_LEVELS);
}

/* ---- packing to the scene's formats ---- */

/* The box's half sides become 32766 steps: even, so that their halves are whole steps, not ties of the rounding. */
static void pack_positions_i16(shape *s)
{
    double low[3], high[3], scale[3], offset[3];
    uint32_t i;
    int k;
    for (k = 0; k < 3; ++k) {
        low[k] = high[k] = s->position[0][k];
        for (i = 1; i < s->mesh.vertex_count; ++i) {
            low[k] = s->position[i][k] < low[k] ? s->position[i][k] : low[k];
            high[k] = s->position[i][k] > high[k] ? s->position[i][k] : high[k];
        }
        scale[k] = (double)(float)((high[k] - low[k]) / 65532.0);
        offset[k] = floor((high[k] + low[k]) * 524288.0 + 0.5) / 1048576.0; /* on a grid of 2^-20 m: 0 is 0 */
        for (i = 0; i < s->mesh.vertex_count; ++i) {
            s->position_i16[4 * i + k] = (int16_t)floor((s->position[i][k] - offset[k]) / scale[k] + 0.5);
        }
    }
    s->mesh.position_scale.x = (float)scale[0];
    s->mesh.position_scale.y = (float)scale[1];
    s->mesh.position_scale.z = (float)scale[2];
    s->mesh.position_offset.x = (float)offset[0];
    s->mesh.position_offset.y = (float)offset[1];
    s->mesh.position_offset.z = (float)offset[2];
    s->mesh.positions = s->position_i16;
}

static void pack_positions_f32(shape *s)
{
    uint32_t i;
    for (i = 0; i < 3 * s->mesh.vertex_count; ++i) {
        s->position_f32[i] = (float)s->position[i / 3][i % 3];
    }
    s->mesh.positions = s->position_f32;
}

static void pack(shape *s)
{
    uint32_t i;
    int smooth = length(s->normal[0]) > 0.5;
    if (s->mesh.position_format == LMB_POSITION_I16) {
        pack_positions_i16(s);
    } else {
        pack_positions_f32(s);
    }
    for (i = 0; smooth && i < s->mesh.vertex_count; ++i) {
        lmb_vec3 n;
        n.x = (float)s->normal[i][0];
        n.y = (float)s->normal[i][1];
        n.z = (float)s->normal[i][2];
        lmb_octahedral_encode(s->octahedral + 2 * i, n);
        s->mesh.normals = s->octahedral;
    }
    for (i = 0; s->mesh.uv_format == LMB_UV_U16 && i < s->mesh.vertex_count; ++i) {
        s->uv_u16[2 * i] = (uint16_t)(65535.0 * s->uv[i][0] + 0.5);
        s->uv_u16[2 * i + 1] = (uint16_t)(65535.0 * s->uv[i][1] + 0.5);
        s->mesh.uvs = s->uv_u16;
    }
    s->mesh.indices = s->indices;
    s->mesh.index_format = LMB_INDEX_U16;
}

/* ---- placing ---- */

/* The next instance, with its matrix' columns. */
static void place(int mesh, int material, const double x[3], const double y[3], const double z[3], const double at[3])
{
    const double *column[4];
    lmb_instance *out = instances + instance_count++;
    int i;
    column[0] = x;
    column[1] = y;
    column[2] = z;
    column[3] = at;
    for (i = 0; i < 16; ++i) {
        out->to_world.m[i] = i % 4 < 3 ? (float)column[i / 4][i % 4] : i == 15 ? 1.0f : 0.0f;
    }
    out->mesh = (uint32_t)mesh;
    out->material = (uint32_t)material;
    out->first_id = next_id;
    next_id += shapes[mesh].mesh.triangle_count;
}

/* Rectangle from corner `at` along u and v, facing u x v. */
static void place_wall(int material, double x, double y, double z, const double u[3], const double v[3])
{
    double at[3], n[3], size;
    at[0] = x;
    at[1] = y;
    at[2] = z;
    cross(n, u, v);
    size = length(n);
    n[0] /= size;
    n[1] /= size;
    n[2] /= size;
    place(QUAD, material, u, v, n, at);
}

/* Scaled by `size`, leaned by `lean` turns about z (to the left), turned by `yaw` turns about y, moved to x y z. */
static void place_turned(int mesh, int material, const double size[3], double lean, double yaw, const double at[3])
{
    double cl = cosine(lean), sl = sine(lean), cy = cosine(yaw), sy = sine(yaw), x[3], y[3], z[3];
    x[0] = size[0] * cl * cy;
    x[1] = size[0] * sl;
    x[2] = -size[0] * cl * sy;
    y[0] = -size[1] * sl * cy;
    y[1] = size[1] * cl;
    y[2] = size[1] * sl * sy;
    z[0] = size[2] * sy;
    z[1] = 0.0;
    z[2] = size[2] * cy;
    place(mesh, material, x, y, z, at);
}

static void place_box(int material, double width, double height, double depth, double x, double y, double z)
{
    double size[3], at[3];
    size[0] = width;
    size[1] = height;
    size[2] = depth;
    at[0] = x;
    at[1] = y;
    at[2] = z;
    place_turned(BOX, material, size, 0.0, 0.0, at);
}

static void place_room(void)
{
    static const double right[3] = {2.0 * ROOM_X, 0.0, 0.0}, left[3] = {-2.0 * ROOM_X, 0.0, 0.0};
    static const double up[3] = {0.0, ROOM_Y, 0.0};
    static const double away[3] = {0.0, 0.0, ROOM_BACK - ROOM_FRONT}, nearer[3] = {0.0, 0.0, ROOM_FRONT - ROOM_BACK};
    place_wall(TILES, -ROOM_X, 0.0, ROOM_FRONT, right, away);
    place_wall(WHITE, -ROOM_X, ROOM_Y, ROOM_BACK, right, nearer);
    place_wall(WHITE, -ROOM_X, 0.0, ROOM_BACK, right, up);
    place_wall(RED, -ROOM_X, 0.0, ROOM_FRONT, away, up);
    place_wall(TEAL, ROOM_X, 0.0, ROOM_BACK, nearer, up);
    place_wall(WHITE, ROOM_X, 0.0, ROOM_FRONT, left, up);
}

/* The painting hangs 2 cm off the back wall; four boxes frame it, 1 mm off, so that no two faces share a plane. */
static void place_painting(double x, double y)
{
    static const double one[3] = {1.0, 1.0, 1.0};
    const double bar = 0.05, deep = 0.05, z = ROOM_BACK + 0.5 * deep + 0.001;
    const double w = PAINTING_W, h = PAINTING_H;
    double at[3];
    at[0] = x;
    at[1] = y;
    at[2] = ROOM_BACK + 0.02;
    place_turned(PAINTING, CANVAS, one, 0.0, 0.0, at);
    place_box(WOOD, w + 2.0 * bar, bar, deep, x, y + 0.5 * h, z);
    place_box(WOOD, w + 2.0 * bar, bar, deep, x, y - 0.5 * h - bar, z);
    place_box(WOOD, bar, h, deep, x - 0.5 * (w + bar), y - 0.5 * h, z);
    place_box(WOOD, bar, h, deep, x + 0.5 * (w + bar), y - 0.5 * h, z);
}

#define PLINTH_TOP 0.86

static void place_objects(void)
{
    static const double plinth[3] = {0.20, 0.0, -0.75};
    static const double sphere_size[3] = {0.36, 0.36, 0.36}, sphere_at[3] = {-1.40, 0.36, -0.45};
    static const double block_size[3] = {0.42, 0.72, 0.42}, block_at[3] = {1.16, 0.0, -0.25};
    static const double knot_size[3] = {0.29, 0.29, 0.29};
    double knot_at[3];
    place_box(STONE, 0.66, 0.06, 0.66, plinth[0], 0.0, plinth[2]);
    place_box(STONE, 0.54, PLINTH_TOP - 0.12, 0.54, plinth[0], 0.06, plinth[2]);
    place_box(STONE, 0.66, 0.06, 0.66, plinth[0], PLINTH_TOP - 0.06, plinth[2]);
    knot_at[0] = plinth[0];
    knot_at[1] = PLINTH_TOP - knot_size[1] * lowest_y(&shapes[KNOT]);
    knot_at[2] = plinth[2];
    place_turned(KNOT, BRASS, knot_size, 0.0, 0.04, knot_at);
    place_turned(SPHERE, CLAY, sphere_size, 0.0, 0.0, sphere_at);
    place_turned(BOX, CLAY, block_size, 0.0, 0.055, block_at);
}

/* ---- printing ---- */

/* Prints the fewest digits that give the same float again; never -0. */
static void print_float(float v)
{
    char text[32];
    int digits;
    for (digits = 6; digits <= 9; ++digits) {
        snprintf(text, sizeof text, "%.*g", digits, v == 0.0f ? 0.0 : (double)v);
        if ((float)strtod(text, NULL) == v) {
            break;
        }
    }
    printf("%s%sf", text, strpbrk(text, ".e") ? "" : ".0");
}

static void print_vec3(lmb_vec3 v)
{
    printf("{");
    print_float(v.x);
    printf(", ");
    print_float(v.y);
    printf(", ");
    print_float(v.z);
    printf("}");
}

typedef enum stream { STREAM_F32, STREAM_I16, STREAM_U16, STREAM_U8 } stream;

/* A stream as a union: the first member is the data, the second brings the alignment. */
static void print_array(const char *shape_name, const char *name, stream type, const void *data, uint32_t count)
{
    static const char *const type_name[4] = {"float", "int16_t", "uint16_t", "uint8_t"};
    uint32_t i, per_line = type == STREAM_F32 ? 6 : 12;
    printf("static const ALIGNED_4 union {\n    %s v[%" PRIu32 "];\n    uint32_t align;\n} %s_%s = {{", type_name[type],
           count, shape_name, name);
    for (i = 0; i < count; ++i) {
        printf("%s", i % per_line == 0 ? "\n    " : " ");
        switch (type) {
        case STREAM_F32: print_float(((const float *)data)[i]); break;
        case STREAM_I16: printf("%d", ((const int16_t *)data)[i]); break;
        case STREAM_U16: printf("%u", (unsigned)((const uint16_t *)data)[i]); break;
        case STREAM_U8: printf("%u", (unsigned)((const uint8_t *)data)[i]); break;
        }
        printf(",");
    }
    printf("\n}};\n\n");
}

static void print_streams(const shape *s)
{
    const lmb_mesh *m = &s->mesh;
    if (m->position_format == LMB_POSITION_I16) {
        print_array(s->name, "positions", STREAM_I16, m->positions, 4 * m->vertex_count);
    } else {
        print_array(s->name, "positions", STREAM_F32, m->positions, 3 * m->vertex_count);
    }
    if (m->normals) {
        print_array(s->name, "normals", STREAM_I16, m->normals, 2 * m->vertex_count);
    }
    if (m->uvs) {
        print_array(s->name, "uvs", STREAM_U16, m->uvs, 2 * m->vertex_count);
    }
    if (m->colours) {
        print_array(s->name, "colours", STREAM_U8, m->colours, 4 * m->vertex_count);
    }
    print_array(s->name, "indices", STREAM_U16, m->indices, 3 * m->triangle_count);
}

static void print_pointer(const char *shape_name, const char *name, const void *data)
{
    if (data) {
        printf("%s_%s.v, ", shape_name, name);
    } else {
        printf("NULL, ");
    }
}

static void print_mesh(const shape *s)
{
    const lmb_mesh *m = &s->mesh;
    printf("    {");
    print_pointer(s->name, "positions", m->positions);
    print_pointer(s->name, "normals", m->normals);
    printf("NULL, ");
    print_pointer(s->name, "uvs", m->uvs);
    print_pointer(s->name, "colours", m->colours);
    print_pointer(s->name, "indices", m->indices);
    printf("%" PRIu32 ", %" PRIu32 ",\n     ", m->vertex_count, m->triangle_count);
    print_vec3(m->position_scale);
    printf(", ");
    print_vec3(m->position_offset);
    printf(",\n     {");
    print_float(m->uv_scale[0]);
    printf(", ");
    print_float(m->uv_scale[1]);
    printf("}, %s, %s, LMB_INDEX_U16, 0, 0},\n",
           m->position_format == LMB_POSITION_I16 ? "LMB_POSITION_I16" : "LMB_POSITION_F32",
           m->uv_format == LMB_UV_U16 ? "LMB_UV_U16" : "LMB_UV_F32");
}

static void print_materials(void)
{
    int i, k;
    printf("static const lmb_material demo_materials[%d] = {\n", MATERIALS);
    for (i = 0; i < MATERIALS; ++i) {
        printf("    {{");
        for (k = 0; k < 3; ++k) {
            print_float(materials[i].albedo[k]);
            printf(k < 2 ? ", " : "}, 1.0f, 0.0f, %" PRId32 ", 0, 0, 0.0f, ", materials[i].texture);
        }
        printf("{0, 0, 0}, {0, 0, 0}, 0.0f, 0, 0, 0.0f}, /* ");
        printf("%s */\n", material_name[i]);
    }
    printf("};\n\n");
}

static void print_instances(void)
{
    uint32_t i;
    int k;
    printf("static const lmb_instance demo_instances[%" PRIu32 "] = {\n", instance_count);
    for (i = 0; i < instance_count; ++i) {
        const lmb_instance *in = instances + i;
        printf("    {{{");
        for (k = 0; k < 16; ++k) {
            print_float(in->to_world.m[k]);
            printf(k == 15 ? "}}," : k % 4 == 3 ? ",\n       " : ", ");
        }
        printf("\n     %" PRIu32 ", %" PRIu32 ", %" PRIu32 ", 0}, /* %s, %s */\n", in->mesh, in->material, in->first_id,
               shapes[in->mesh].name, material_name[in->material]);
    }
    printf("};\n\n");
}

/* The spot hangs under the ceiling, right of the middle. It lights both coloured walls, the floor and half of the
 * back wall; the rest only gets bounced light. 98 degrees across, full within 68: the shadow map has one face (half
 * angle up to 50). 30 W/sr on a light tile 2.8 m away at 45 degrees: 0.6 / pi * 30 * 0.7 / 2.8^2 = 0.5 W/(m2 sr). */
static lmb_light aim_light(void)
{
    static const double from[3] = {0.80, 2.70, 0.75}, to[3] = {-0.42, 0.42, -0.75};
    double way[3], size;
    lmb_light light;
    int k;
    memset(&light, 0, sizeof light);
    for (k = 0; k < 3; ++k) {
        way[k] = to[k] - from[k];
    }
    size = length(way);
    light.position.x = (float)from[0];
    light.position.y = (float)from[1];
    light.position.z = (float)from[2];
    light.direction.x = (float)(way[0] / size);
    light.direction.y = (float)(way[1] / size);
    light.direction.z = (float)(way[2] / size);
    light.intensity[0] = 31.5f;
    light.intensity[1] = 29.5f;
    light.intensity[2] = 26.5f;
    light.cos_inner = (float)cosine(34.0 / 360.0);
    light.cos_outer = (float)cosine(49.0 / 360.0);
    light.kind = LMB_LIGHT_SPOT;
    return light;
}

static void print_light(const lmb_light *light)
{
    lmb_vec3 watts;
    watts.x = light->intensity[0];
    watts.y = light->intensity[1];
    watts.z = light->intensity[2];
    printf("static const lmb_light demo_lights[1] = {\n    {");
    print_vec3(light->position);
    printf(", ");
    print_vec3(light->direction);
    printf(",\n     ");
    print_vec3(watts);
    printf(", ");
    print_float(light->cos_inner);
    printf(", ");
    print_float(light->cos_outer);
    printf(", LMB_LIGHT_SPOT, 0, 0},\n};\n\n");
}

/* ---- putting it together ---- */

static void build_scene(void)
{
    int i;
    build_quad(&shapes[QUAD]);
    build_box(&shapes[BOX]);
    build_sphere(&shapes[SPHERE], 48, 24);
    build_knot(&shapes[KNOT], 96, 12, 0.21);
    build_painting(&shapes[PAINTING], 6, 3);
    for (i = 0; i < SHAPES; ++i) {
        pack(&shapes[i]);
    }
    build_tiles();
    place_room();
    place_painting(-0.94, 1.64);
    place_objects();
}

/* The same scene in memory, for the library's own check and bounds. */
static lmb_status measure(lmb_vec3 *low, lmb_vec3 *high, const lmb_light *light)
{
    static lmb_mesh meshes[SHAPES];
    static lmb_texture texture = {texels, TILE_TEXELS, TILE_TEXELS, TILE_LEVELS, 0, 0, LMB_TRILINEAR, 0};
    lmb_scene scene;
    int i;
    memset(&scene, 0, sizeof scene);
    for (i = 0; i < SHAPES; ++i) {
        meshes[i] = shapes[i].mesh;
    }
    scene.meshes = meshes;
    scene.materials = materials;
    scene.textures = &texture;
    scene.instances = instances;
    scene.lights = light;
    scene.mesh_count = SHAPES;
    scene.material_count = MATERIALS;
    scene.texture_count = 1;
    scene.instance_count = instance_count;
    scene.light_count = 1;
    lmb_scene_bounds(low, high, &scene);
    scene.bounds_min = *low;
    scene.bounds_max = *high;
    return lmb_scene_check(&scene);
}

static void print_bounds(lmb_vec3 low, lmb_vec3 high)
{
    printf("/* world metres */\n#define DEMO_BOUNDS_MIN ");
    print_vec3(low);
    printf("\n#define DEMO_BOUNDS_MAX ");
    print_vec3(high);
    printf("\n#define DEMO_TRIANGLES %" PRIu32 "\n", next_id - 1);
}

int main(void)
{
    lmb_vec3 low, high;
    lmb_light light = aim_light();
    lmb_status status;
    int i;
    build_scene();
    status = measure(&low, &high, &light);
    if (status != LMB_OK) {
        fprintf(stderr, "gen_demo: the scene is refused: %s\n", lmb_status_name(status));
        return 1;
    }
    printf("/* demo_scene_data.inc: the demo scene's data, printed by gen_demo.c; do not edit. */\n\n");
    for (i = 0; i < SHAPES; ++i) {
        print_streams(&shapes[i]);
    }
    print_array("tile", "texels", STREAM_U8, texels,
                (uint32_t)lmb_texture_bytes(TILE_TEXELS, TILE_TEXELS, TILE_LEVELS));
    printf("static const lmb_texture demo_textures[1] = {\n    {tile_texels.v, %d, %d, %d, LMB_WRAP_REPEAT, "
           "LMB_WRAP_REPEAT, LMB_TRILINEAR, LMB_TEXELS_RGBA8},\n};\n\n",
           TILE_TEXELS, TILE_TEXELS, TILE_LEVELS);
    printf("static const lmb_mesh demo_meshes[%d] = {\n", SHAPES);
    for (i = 0; i < SHAPES; ++i) {
        print_mesh(&shapes[i]);
    }
    printf("};\n\n");
    print_materials();
    print_instances();
    print_light(&light);
    print_bounds(low, high);
    if (fflush(stdout) != 0 || ferror(stdout)) {
        fprintf(stderr, "gen_demo: cannot write the data; is the disk full?\n");
        return 1;
    }
    return 0;
}
