/* probe.h: objects lit by the world around them: one cube map and a ground image, seen from each object. [S1-S27]
 *
 *     lmb_world_init(&world, &pictures, format, memory, bytes);       once, and when the world changes
 *     lmb_probe_table_init(&table, 128, 64, 0.0f, memory, bytes);     once a size
 *     per object: lmb_probe_remap(map, ...);                          radiance at its position, by direction
 *                 lmb_probe_reduce(...), lmb_probe_cosine(...);       irradiance by normal: or lmb_probe_sh, _blur
 *                 lmb_probe_reflect(...);                             radiance reflected by rough surfaces
 *                 lmb_probe_cube_init(&cube, ...);                    either one, prepared for lookups
 *     per tile:   lmb_probe_light_tile, lmb_probe_glossy_tile, lmb_probe_background: or relight.h does it all
 *
 * Cubes have six faces of n x n texels in GL order (+x -x +y -y +z -z), rows from the top: with s, t in -1 .. 1 the
 * direction is (1,-t,-s) (-1,-t,s) (s,1,t) (s,-1,-t) (s,-t,1) (-s,-t,-1).
 *
 * Stability: experimental. Tags like [S1] are requirements in src/SOURCES.md. */
#ifndef LMB_PROBE_H
#define LMB_PROBE_H

#include "light.h"

/* Storage of the world's radiance. LOG: e = (log10(c + 0.101) + 1) / 3, c in 0 .. 100, in 8 or 16 bits (a step of 2.7 %
 * or 0.011 %, of c + 0.101). [S4] */
enum { LMB_WORLD_F32 = 0, LMB_WORLD_LOG16, LMB_WORLD_LOG8 };

/* Proxy shape of the far world, for parallax. */
enum { LMB_WORLD_SPHERE = 0, LMB_WORLD_BOX };

/* The world's pictures, and their positions. [S1 S2 S3] */
typedef struct lmb_world_pictures {
    const float *face[6]; /* face_size x face_size x RGB, W/(m2 sr), >= 0, rows from the top; NULL: missing */
    const float *alpha[6]; /* alpha of the faces' texels, 0 blank .. 1; NULL: no texel of that face is blank */
    int32_t face_size;
    const float *ground;  /* ground_width x ground_height x RGB + alpha 0 .. 1; rows grow with z; NULL: none */
    int32_t ground_width, ground_height;
    float ground_x, ground_z, ground_width_m, ground_depth_m; /* corner of lowest x and z, and the sides */
    float ground_y;       /* the ground's height, m */
    lmb_vec3 centre;      /* the position from which the cube was taken, m */
    int32_t shape;        /* LMB_WORLD_SPHERE or LMB_WORLD_BOX */
    lmb_vec3 middle;      /* of the sphere */
    float radius;         /* m */
    lmb_vec3 low, high;   /* of the box */
    uint32_t revision;    /* raise it when you change the world: older cubes become stale [S20] */
    int32_t has_floor;    /* 1: the far world has a flat lower half at ground_y, which rays that go down hit */
} lmb_world_pictures;

#define LMB_WORLD_LEVELS 14

/* One mip level of a picture. */
typedef struct lmb_world_level {
    uint32_t at;           /* index of the level's first texel */
    int32_t width, height; /* of a face, without the border of one texel; of the ground */
} lmb_world_level;

#define LMB_WORLD_PEAKS 64

/* A lamp, or a part of one: the radiance of a small part of the far world beyond the level of its surroundings. */
typedef struct lmb_world_peak {
    lmb_vec3 to;   /* unit, from the centre */
    float flux[3]; /* radiance x solid angle, W/m2 */
    float area;    /* the solid angle, sr */
    float limit;   /* radiance above this limit belongs to the peak, not to the map */
    int32_t face, x, y; /* which 32nd by 32nd of which face */
} lmb_world_peak;

/* The world in your memory: RGBA texels, each level half the one before, radiance averaged. Faces have a border of one
 * texel copied from the next face, so lookups need no special case at face edges. Few rays would miss small lamps or
 * count them twice. Light is therefore gathered from `calm` levels, which lack the peaks, and the peaks are added
 * exactly. */
typedef struct lmb_world {
    void *texels;
    int32_t format, cube_levels, ground_levels; /* ground_levels 0: no ground */
    lmb_world_level cube[LMB_WORLD_LEVELS], ground[LMB_WORLD_LEVELS];
    lmb_world_level calm[LMB_WORLD_LEVELS]; /* of the same size as the cube's; the first is the cube's own */
    lmb_world_peak peak[LMB_WORLD_PEAKS];
    int32_t peaks; /* 0: calm levels are the cube's */
    lmb_world_pictures pictures; /* the numbers; the pictures themselves are not read again */
    float log8[256];             /* radiance of an 8-bit code */
    float log16[2][256];         /* radiance of a 16-bit code: [0][code >> 8] * [1][code & 255] - 0.101 */
} lmb_world;

/* Shares of a block of two by two map texels among the texels of the reduced cube. */
typedef struct lmb_probe_share {
    uint16_t slot; /* texel of the bordered cube: the upper left of nine */
    uint8_t x, y;  /* position in the middle one, of 255 */
} lmb_probe_share;

/* Directions of a latitude-longitude map's texels, built once a size. In your memory. [S9 S10] */
typedef struct lmb_probe_table {
    int32_t width, height;
    float start;         /* longitude of the left edge, rad */
    uint16_t *direction; /* 3 planes of width x height: x, y, z as 65535 (d + 1) / 2 */
    float *area;         /* height: the solid angle of a row's texels, sr */
    float *wave;         /* 9 planes of width: cos m a, m = 0 .. 4, then sin m a, m = 1 .. 4, a the longitude */
    float *legendre;     /* 15 planes of height: the harmonics l, m >= 0 without their wave; l 0 .. 4, m 0 .. l */
    lmb_probe_share *share; /* width / 2 x height / 2 */
    float *light;        /* 3 planes of LMB_PROBE_TEXELS: the directions of lmb_probe_lights */
    uint16_t *fold;      /* LMB_PROBE_BORDERED: the inner texel that each texel of the bordered cube belongs to */
} lmb_probe_table;

enum { LMB_SH_9 = 9, LMB_SH_16 = 16, LMB_SH_25 = 25 };

#define LMB_PROBE_SIDE 8 /* texels of a reduced cube's side */
#define LMB_PROBE_TEXELS (6 * LMB_PROBE_SIDE * LMB_PROBE_SIDE)
#define LMB_PROBE_BORDERED (6 * (LMB_PROBE_SIDE + 2) * (LMB_PROBE_SIDE + 2))
#define LMB_PROBE_PEAKS 64

/* All incident light at a position as 6 x 8 x 8 directions, and up to LMB_PROBE_PEAKS bright peaks that keep their
 * exact direction. */
typedef struct lmb_probe_lights {
    float rgbw[4][LMB_PROBE_TEXELS];     /* radiance x solid angle, W/m2; the solid angle itself, sr */
    float peak[6][LMB_PROBE_PEAKS];      /* unit direction; RGB, W/m2 */
    int32_t peaks;                       /* in use */
    float shared[LMB_PROBE_BORDERED + 1][4]; /* scratch; vectors reach one past the last */
} lmb_probe_lights;

/* Kernels of a blur, for maps of one size. [S11] */
typedef struct lmb_probe_blur {
    int32_t width, height, terms; /* terms 0: one kernel for all rows; 1, 2: products fitted for each */
    float *column;                /* [term][row of the result][2 height]: weights of rows, then of rows past a pole */
    float *row;                   /* [term][row of the result][width]: weights by lag */
} lmb_probe_blur;

/* A cube of n x n x 6 texels with a border of one texel copied from the next face, so lookups need no special case at
 * face edges. */
typedef struct lmb_probe_cube {
    const float *texel; /* RGBA, faces of (n + 2) x (n + 2); in your memory */
    int32_t side;       /* n */
} lmb_probe_cube;

/* The world, and the parameters of sampling it. */
typedef struct lmb_world_query {
    const lmb_world *world;
    float ray_width; /* rad: of a pixel. Reads levels with texels at least as wide */
    int32_t blend;   /* see lmb_probe_remap */
} lmb_world_query;

/* When to recompute an object's cubes: if the object is more than radius_m from the position of its cubes, or if it has
 * moved at all and `every` frames have passed. Radius 0: in each frame while it moves. [S18] */
typedef struct lmb_probe_policy {
    float radius_m; /* for example LMB_PROBE_RADIUS */
    int32_t every;  /* 0: age does not matter */
} lmb_probe_policy;

#define LMB_PROBE_RADIUS 0.15f

enum { LMB_PROBE_FREE = 0, LMB_PROBE_OWNED, LMB_PROBE_NAMED };

/* One position with stored cubes. */
typedef struct lmb_probe_slot {
    lmb_vec3 place;
    uint32_t owner, world; /* the object; the world's revision */
    uint32_t frame, used;  /* the frame that computed the cubes; the last frame that used them */
    int32_t kind;          /* LMB_PROBE_ */
    int32_t known;         /* 1: the cubes were computed */
} lmb_probe_slot;

/* Assigns slots to objects and places. The cubes themselves are yours, one set a slot. [S18-S20] */
typedef struct lmb_probe_cache {
    lmb_probe_slot slot[LMB_MAX_PROBES];
    int32_t count; /* slots in use by this cache */
    lmb_probe_policy policy;
    uint32_t kept, computed; /* results so far: cubes reused, and cubes to compute */
} lmb_probe_cache;

/* Result of lmb_probe_cache_ask. */
typedef struct lmb_probe_answer {
    int32_t slot;    /* use the cubes of this slot */
    int32_t compute; /* 1: compute them first, from `place` */
    lmb_vec3 place;
} lmb_probe_answer;

/* Scratch for rays. 5.3 KiB. */
typedef struct lmb_probe_rays {
    float n[3][LMB_TILE_PIXELS], across[3][LMB_TILE_PIXELS], along[3][LMB_TILE_PIXELS];
    float origin[3][LMB_TILE_PIXELS], direction[3][LMB_TILE_PIXELS], seen[3][LMB_TILE_PIXELS];
    float sum[3][LMB_TILE_PIXELS];
} lmb_probe_rays;

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_world_bytes: memory of a world of these pictures; 0 for sizes out of range: faces 1 .. 4096 texels a side, ground
 * 0 or 1 .. 8192. 5/3 of the faces' texels (4/3 of faces under 32), 4/3 of the ground's. */
size_t lmb_world_bytes(const lmb_world_pictures *pictures, int32_t format);

/* lmb_world_init: encode the pictures and their levels into `memory`.
 *
 * The centre must lie inside the sphere or box, and above a floor. The ground's picture lies on a floor. Missing faces
 * and blank parts have alpha 0: a ray that hits them goes on to the other candidate; if that is blank too, the ray gets
 * no light. Radiance that is not finite, or under 1e-12, counts as 0; coded formats clamp it to 100. Peaks are texels
 * at least four times as bright as the mean of the quarter by quarter of a face around them, on faces of 32 texels and
 * more. The strongest LMB_WORLD_PEAKS cells of a 32nd by a 32nd of a face are stored, each with the mean direction of
 * its light.
 * Returns LMB_OK, LMB_ERR_ARG, LMB_ERR_FORMAT, LMB_ERR_ALIGN or LMB_ERR_CAPACITY. Cost: about seven passes over the
 * texels. */
lmb_status lmb_world_init(lmb_world *out, const lmb_world_pictures *pictures, int32_t format, void *memory,
                          size_t bytes);

/* lmb_probe_table_bytes: memory of a table; 0 for sizes out of range. Height 8 .. 512, a multiple of 8, and width
 * twice that. */
size_t lmb_probe_table_bytes(int32_t width, int32_t height);

/* lmb_probe_table_init: directions by latitude from the north (+y) down, and by longitude. start_deg: longitude of the
 * left edge, of a = atan2(x, -z): -180 as usual, or -90, or 0. Returns LMB_OK, LMB_ERR_ARG, LMB_ERR_ALIGN or
 * LMB_ERR_CAPACITY. */
lmb_status lmb_probe_table_init(lmb_probe_table *out, int32_t width, int32_t height, float start_deg, void *memory,
                                size_t bytes);

/* lmb_probe_remap: radiance of the world at `at`, by direction. [S5-S8]
 *
 *   map    3 planes (R, G, B) of the table's width x height
 *   blend  0: the nearer of ground and far world, through blank parts of it; 1: their mean if a ray hits both
 * Each texel reads bilinearly from calm levels with texels as wide as its own. The light of a peak is shared among the
 * four texels around it. A position outside the far world counts as the nearest one at 0.999 of the world's size; a
 * position at or under the ground gets no light from the ground.
 * Returns LMB_OK or LMB_ERR_ARG (a NULL, `at` not finite). Cost: about 20 cycles a texel with AVX2. */
lmb_status lmb_probe_remap(float *map, const lmb_kernels *kernels, const lmb_world *world, const lmb_probe_table *table,
                           lmb_vec3 at, int32_t blend);

/* lmb_probe_reduce: reduce a map to 6 x 8 x 8 directions. Each block of two by two texels is shared among the nine
 * nearest directions. Blocks with over four times the mean become peaks, the strongest LMB_PROBE_PEAKS of them. Returns
 * LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_probe_reduce(lmb_probe_lights *out, const lmb_kernels *kernels, const float *map,
                            const lmb_probe_table *table);

/* lmb_probe_cosine: irradiance for n x n x 6 normals (texel centres): pi times the cosine-weighted mean of the lights,
 * so a world of constant radiance gives pi times the radiance. Beside a light of a few texels in a black world the
 * result may be negative, down to -2 % of the largest. [S14 S25]
 *
 *   cube  3 planes of 6 n x n texels, face by face; n: 1 .. 64
 * Error against path-traced truth 0.4 % rmse for this step, 0.6 % with remap to 128 x 64. Cost: 0.7 cycles a texel and
 * light with AVX2. Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_probe_cosine(float *cube, int32_t n, const lmb_kernels *kernels, const lmb_probe_lights *lights,
                            const lmb_probe_table *table);

/* lmb_probe_sh: the first 25 real harmonics of a map, coefficient[3][25], in the order l l + l + m. [S25]
 * lmb_probe_sh_cube: irradiance for n x n x 6 normals from the first `terms` (9, 16 or 25). The clamped cosine has no
 * third band, so 16 terms give the same as 9. Sharp lights overshoot: results may be negative, and are not clamped.
 * Both return LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_probe_sh(float coefficient[3][LMB_SH_25], const float *map, const lmb_probe_table *table);
lmb_status lmb_probe_sh_cube(float *cube, int32_t n, const float coefficient[3][LMB_SH_25], int32_t terms);

/* lmb_probe_blur_bytes, lmb_probe_blur_init: kernels of a blur, computed once a size: 2 height + width floats a row and
 * term.
 *
 *   terms  0: cosine by latitude, then by longitude; 1 or 2: fitted for each row
 * Returns LMB_OK, LMB_ERR_ARG, LMB_ERR_ALIGN or LMB_ERR_CAPACITY. Cost of fitting: 100 height^2 width operations. */
size_t lmb_probe_blur_bytes(const lmb_probe_table *table, int32_t terms);
lmb_status lmb_probe_blur_init(lmb_probe_blur *out, const lmb_probe_table *table, int32_t terms, void *memory,
                               size_t bytes);

/* lmb_probe_blur_map: irradiance by direction, into another map of the same size or in place. [S11 S12 S13]
 *
 *   out   may be `map` itself, with the same result
 *   line  scratch, 4 x width floats; in place width x height more
 * A world of constant radiance gives pi times the radiance. Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_probe_blur_map(float *out, const lmb_kernels *kernels, float *line, const float *map,
                              const lmb_probe_blur *blur);

/* lmb_probe_halve: a map of half the width and height; may be in place. The table is that of the larger map. Returns
 * LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_probe_halve(float *out, const float *map, const lmb_probe_table *table);

/* lmb_probe_map_cube: read a map bilinearly in n x n x 6 directions, across the seam and the poles. Returns LMB_OK or
 * LMB_ERR_ARG. [S14] */
lmb_status lmb_probe_map_cube(float *cube, int32_t n, const float *map, const lmb_probe_table *table);

/* lmb_probe_reflect: the radiance that a surface reflects, indexed by the mirror direction.                   [S16 S22]
 *
 *   cube       3 planes of 6 n x n texels; n: 1 .. 256. With n from lmb_probe_glossy_side the error in a world of small
 *              lights is 2 to 4 % rmse from roughness 0.2 on, 12 % at 0.1
 *   roughness  0 .. 1; alpha = roughness^2; under LMB_MIN_ALPHA: a mirror.
 * The lobe is that of lmb_glossy seen along the normal. It is sampled down to its horizon with 64 rays, or from
 * roughness 0.2 on with the world's peaks and 40 rays. Texels of a mirror are means of 36 rays: against path-traced
 * truth of a world with small lights 1 % rmse away from silhouettes. If n is the side of the world's faces, lights of
 * one texel keep their power within 0.5 %; with finer texels they gain up to 30 %. Returns LMB_OK or LMB_ERR_ARG. Cost:
 * about 25 cycles a ray with AVX2.
 * lmb_probe_glossy_side: the n that a roughness needs: 64 from 0.1 on, 16 from 0.3, 8 from 0.6; 0 under 0.1, for which
 * pixels sample the world itself. */
int32_t lmb_probe_glossy_side(float roughness);
lmb_status lmb_probe_reflect(float *cube, int32_t n, const lmb_kernels *kernels, lmb_probe_rays *scratch,
                             const lmb_world_query *query, lmb_vec3 at, float roughness);

/* lmb_probe_cube_bytes, lmb_probe_cube_init: prepare a cube in planes for lookups. n: 1 .. 256. 9.4 KiB for 8. Returns
 * LMB_OK, LMB_ERR_ARG, LMB_ERR_ALIGN or LMB_ERR_CAPACITY. */
size_t lmb_probe_cube_bytes(int32_t n);
lmb_status lmb_probe_cube_init(lmb_probe_cube *out, const float *planes, int32_t n, void *memory, size_t bytes);

/* lmb_probe_light_tile: add a cube's irradiance by normal, clamped to >= 0, to `pixels` of a tile, a bit each. [S21]
 * lmb_probe_glossy_tile: add the reflection of a cube's radiance, stored by reflected direction, in the lobes of
 * `pixels`. The factor is F0 + (1 - F0) (1 - alpha)^3 (1 - n.v)^5, which lmb_compose_glossy subtracts from the diffuse
 * light. Without a cube each pixel samples the world from its own position. [S17 S22]
 *
 *   inout  of lmb_glossy_tile.
 *   query  read if cube is NULL.
 * Lookups are bilinear. An object does not block light from itself. Both return LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_probe_light_tile(lmb_irradiance *inout, const lmb_kernels *kernels, lmb_probe_rays *scratch,
                                const lmb_tile *tile, uint64_t pixels, const lmb_probe_cube *cube);
lmb_status lmb_probe_glossy_tile(lmb_glossy *inout, const lmb_kernels *kernels, lmb_probe_rays *scratch,
                                 const lmb_tile *tile, uint64_t pixels, const lmb_probe_cube *cube,
                                 const lmb_world_query *query);

/* lmb_probe_cache_init: an empty cache of `slots`, 1 .. LMB_MAX_PROBES. Returns LMB_OK or LMB_ERR_ARG.
 * lmb_probe_cache_name: reserve cubes for a place: objects within the policy's radius of the place use them. Returns
 * the slot; -1 if no slot would be left for objects, or the place is out of range.
 * lmb_probe_cache_ask: choose the cubes that object `owner`, now `at`, uses in this frame: those of the nearest named
 * place within the radius; else its own; else a free slot, or the least recently used one. Returns LMB_OK, or
 * LMB_ERR_ARG: then *out and the cache are unchanged. Cost: slots. */
lmb_status lmb_probe_cache_init(lmb_probe_cache *out, int32_t slots, const lmb_probe_policy *policy);
int32_t lmb_probe_cache_name(lmb_probe_cache *inout, lmb_vec3 place);
lmb_status lmb_probe_cache_ask(lmb_probe_answer *out, lmb_probe_cache *inout, uint32_t owner, lmb_vec3 at,
                               uint32_t world_revision, uint32_t frame);

/* lmb_probe_background: set the pixels of a tile without a surface to the radiance of the world behind them. Returns
 * LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_probe_background(float inout[3][LMB_TILE_PIXELS], const lmb_kernels *kernels, lmb_probe_rays *scratch,
                                const lmb_tile *tile, const lmb_view *view, const lmb_world_query *query);

#ifdef __cplusplus
}
#endif

#endif
