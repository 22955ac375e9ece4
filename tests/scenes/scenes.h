/* scenes.h: scenes generated from a number, for judging on data that no constant was fitted to.
 *
 * A name is `kind` or `kind:seed`: another seed gives another scene of that kind, with other sizes and places. The same
 * name gives the same bytes everywhere: random numbers and sine are our own, the rest is + - * / and square roots.
 * Surfaces are flat and Lambertian, metres, y up, right handed; light is in W/sr, a sun's in W/m2. */
#ifndef SCENES_H
#define SCENES_H

#include <stdint.h>

enum { SCENE_LIGHTS = 4, SCENE_MATERIALS = 16, SCENE_NAME = 64 };

typedef struct svec {
    double x, y, z;
} svec;

enum { SCENE_SPOT, SCENE_POINT, SCENE_SUN };

typedef struct scene_light {
    int kind;
    svec position, direction; /* direction in which light travels, any length */
    double rgb[3];
    double inner_deg, outer_deg; /* half angles of a spot */
} scene_light;

typedef struct made_scene {
    char name[SCENE_NAME];
    svec *corners;      /* 3 a triangle */
    uint8_t *materials; /* 1 a triangle */
    uint32_t triangles, room;
    double albedo[SCENE_MATERIALS][3];
    double emission[SCENE_MATERIALS][3]; /* radiance of both sides, W/(sr m2) */
    int material_count;
    scene_light lights[SCENE_LIGHTS];
    int light_count;
    svec eye, target, up;
    double fov_deg, near_m;
    svec open_low, open_high; /* a box that all relevant sunlight passes through; low.x > high.x: anywhere */
    uint64_t random;
} made_scene;

/* Turns, scales and moves geometry, camera and lights of a scene together, so that the picture stays the same. */
typedef struct scene_place {
    svec axis[3]; /* images of x, y and z: orthonormal */
    double scale;
    svec move;
} scene_place;

typedef struct scene_kind {
    const char *name;
    int held_out; /* never use it to choose a constant */
    void (*build)(made_scene *s);
    const char *what;
} scene_kind;

extern const scene_kind scene_kinds[];
extern const int scene_kind_count;

/* scene_make: returns 1, or 0 if the name is not in the table. scene_drop frees the scene. */
int scene_make(made_scene *s, const char *name);
void scene_drop(made_scene *s);

/* The unchanged scene; turned about an axis (any length); turned at random. */
scene_place scene_as_it_is(void);
void scene_turn(scene_place *p, svec axis, double degrees);
void scene_turn_any(scene_place *p, uint64_t seed);
void scene_put(made_scene *s, const scene_place *p);

/* scene_write: writes scene.gltf and scene.bin (for lambent), scene.txt and scene.box (for the path tracer of
 * the truth, which has no emission: a view of `size` x `size` pixels) to an existing folder. Returns 1, or 0 if
 * a file cannot be written. */
int scene_write(const made_scene *s, const char *folder, int size);

/* --- functions for building kinds --------------------------------------------------------------------------------- */

#define COUNT_OF(a) ((int)(sizeof(a) / sizeof *(a)))

static inline svec at(double x, double y, double z)
{
    svec v = {x, y, z};
    return v;
}

static inline svec plus(svec a, svec b) { return at(a.x + b.x, a.y + b.y, a.z + b.z); }
static inline svec less(svec a, svec b) { return at(a.x - b.x, a.y - b.y, a.z - b.z); }
static inline svec times(svec a, double k) { return at(a.x * k, a.y * k, a.z * k); }
static inline double dot_of(svec a, svec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline svec cross_of(svec a, svec b)
{
    return at(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
svec unit(svec a);
double sine(double degrees);
double cosine(double degrees);

/* Uniform in [low, high). */
double any_between(made_scene *s, double low, double high);

/* Smooth noise at a point, about -1 .. 1, by seed. */
double smooth_noise(svec p, uint32_t seed);

/* Adds a material with these reflectances; returns its number. */
int paint(made_scene *s, double red, double green, double blue);

void triangle(made_scene *s, int material, svec a, svec b, svec c);
void quad(made_scene *s, int material, svec a, svec b, svec c, svec d);

/* From a: edges u, v, w, not necessarily perpendicular. box: by two corners. */
void slab(made_scene *s, int material, svec a, svec u, svec v, svec w);
void box(made_scene *s, int material, svec low, svec high);
/* A box of this size on the ground at `foot`, turned about y. */
void crate(made_scene *s, int material, svec foot, svec size, double degrees);

/* The inside of a room: floor, walls, ceiling. */
void shell(made_scene *s, int floor, int wall, int ceiling, svec low, svec high);

/* Metres along a panel's edges u and v. */
typedef struct opening {
    double u0, v0, u1, v1;
} opening;

/* panel: a parallelogram from a with openings. wall: the same, w thick, with reveals. */
void panel(made_scene *s, int material, svec a, svec u, svec v, const opening *holes, int count);
void wall(made_scene *s, int material, svec a, svec u, svec v, svec w, const opening *holes, int count);

/* From a to b, without end caps; a cone if the radii differ. */
void tube(made_scene *s, int material, svec a, svec b, double radius_a, double radius_b, int sides);
void ball(made_scene *s, int material, svec centre, double radius, int rings);

void spot(made_scene *s, svec from, svec towards, double watts_per_sr, double inner_deg, double outer_deg);
void point(made_scene *s, svec from, double watts_per_sr);
void sun(made_scene *s, svec direction, double watts_per_m2);
void look(made_scene *s, svec eye, svec target, double fov_deg);
void sun_through(made_scene *s, svec low, svec high);

/* Kinds, by file. */
void build_louvres(made_scene *s);
void build_blinds(made_scene *s);
void build_stair_hall(made_scene *s);
void build_kitchen(made_scene *s);
void build_attic(made_scene *s);
void build_bookshelves(made_scene *s);
void build_grille(made_scene *s);
void build_columns(made_scene *s);
void build_windows(made_scene *s);
void build_doors(made_scene *s);
void build_gallery(made_scene *s);
void build_l_corridor(made_scene *s);
void build_furnished(made_scene *s);
void build_spiral(made_scene *s);
void build_arcade(made_scene *s);
void build_tent(made_scene *s);
void build_pipes(made_scene *s);
void build_crates(made_scene *s);
void build_railing(made_scene *s);
void build_foliage(made_scene *s);
void build_foliage20k(made_scene *s);
void build_reeds(made_scene *s);
void build_canyon(made_scene *s);
void build_terrain_in(made_scene *s);
void build_terrain_out(made_scene *s);
void build_courtyard(made_scene *s);
void build_city(made_scene *s);
void build_cave(made_scene *s);
void build_small_room(made_scene *s);
void build_small_stairs(made_scene *s);
void build_small_shelf(made_scene *s);
void build_doorway(made_scene *s);
void build_leaves(made_scene *s);
void build_glow(made_scene *s);
void build_alcove(made_scene *s);

#endif
