/* scene.h: a scene as plain const data: usable in place from flash, 4-byte aligned; a scene owns no memory.
 *
 * Every array is yours and may be const. Positions may be in RAM and indices in flash (moving, skinned meshes). Changes
 * are found by `revision` numbers, not by hashing: raise them when you write.
 *
 * Stability: stable. Tags like [V2] are requirements in src/SOURCES.md. */
#ifndef LMB_SCENE_H
#define LMB_SCENE_H

#include "types.h"

/* Vertex streams: tightly packed, one format each. */
enum { LMB_POSITION_F32 = 0, /* float x, y, z */
       LMB_POSITION_I16 = 1  /* int16 x, y, z, 0: position_scale * v + position_offset */ };
enum { LMB_UV_F32 = 0, /* float u, v */
       LMB_UV_U16 = 1  /* uint16 u, v: uv_scale * v / 65535 */ };
enum { LMB_COLOUR_RGBA8 = 0, /* bytes: code / 255 */
       LMB_COLOUR_RGBA16 = 1 /* uint16: R G B are (code / 65535)^2, so dark colours keep their ratios; A is
                                code / 65535. Needs a build with LMB_TEXTURE_FORMATS */ };
enum { LMB_INDEX_NONE = 0, /* vertices in order, three a triangle */
       LMB_INDEX_U16 = 1, LMB_INDEX_U32 = 2 };
enum { LMB_TANGENT_BY_UV = 0, /* a normal map's second axis points towards smaller v of the triangle */
       LMB_TANGENT_SIDED = 1  /* the second axis is normal x tangent if the tangent's first number is odd (glTF's w =
                                 1), the opposite if it is even (w = -1). It is interpolated if corners differ. Texture
                                 coordinates are used only for the lookup */ };

typedef struct lmb_mesh {
    const void *positions;
    const int16_t *normals;  /* octahedral, two a vertex (lmb_octahedral_encode); NULL: flat shading */
    const int16_t *tangents; /* octahedral, towards larger u, for normal maps; NULL: computed per triangle */
    const void *uvs;         /* NULL: no texture coordinates, (0, 0) */
    const uint8_t *colours;  /* linear RGBA in the colour_format, multiplies the albedo; NULL: white */
    const void *indices;     /* uint16 or uint32; NULL with LMB_INDEX_NONE */
    uint32_t vertex_count;
    uint32_t triangle_count;
    lmb_vec3 position_scale, position_offset; /* LMB_POSITION_I16 only */
    float uv_scale[2];                        /* LMB_UV_U16 only */
    uint8_t position_format, uv_format, index_format, tangent_format, colour_format;
} lmb_mesh;

enum { LMB_WRAP_REPEAT = 0, LMB_WRAP_CLAMP = 1, LMB_WRAP_MIRROR = 2 };
enum { LMB_NEAREST = 0, LMB_BILINEAR = 1, LMB_TRILINEAR = 2 };

/* Storage of a texture's texels. All but RGBA8 need a build with LMB_TEXTURE_FORMATS; they are sampled one pixel at a
 * time, as the RGBA8 codes that they represent. */
enum { LMB_TEXELS_RGBA8 = 0, /* bytes R G B A */
       LMB_TEXELS_RGB565 = 1, /* uint16 in native byte order, red in the high bits; the high bits of a channel fill the
                                 low ones of its code; alpha is 255 */
       LMB_TEXELS_PALETTE4 = 2 /* 16 colours as bytes R G B A, then 4 bits a texel, the first one in the low bits;
                                  each level begins a byte */ };

/* An image: level 0 first, each next level half the size (floor, at least 1), tightly packed. A base colour is
 * sRGB-coded with linear alpha: lmb_texture_mips fills the levels. A normal map is glTF's: R G B = 0 .. 255 stand for
 * -1 .. 1 towards larger u, smaller v, and out of the surface: lmb_normal_map_mips fills the levels. */
typedef struct lmb_texture {
    const uint8_t *texels;
    uint16_t width, height; /* of level 0; 1 .. LMB_MAX_SIDE, any size */
    uint8_t levels;         /* 1: no mips */
    uint8_t wrap_s, wrap_t;
    uint8_t filter;
    uint8_t format;         /* LMB_TEXELS_RGBA8, ... */
} lmb_texture;

enum { LMB_DOUBLE_SIDED = 1, /* if not set, back faces are culled in the camera's view (never in a light's) */
       LMB_ALPHA_MASK = 2,   /* texels with alpha < alpha_cutoff are holes; drawn by the masked path */
       LMB_UNLIT = 8,        /* a frame's camera sees the diffuse albedo as radiance, independent of light and without
                                lobe and emission; to other surfaces the material is as without this flag */
       LMB_ALPHA_BLEND = 4   /* with LMB_ALPHA_MASK: a camera sees the material in alpha's share of a pixel's samples,
                                and the surface behind it in the others, by an ordered pattern of 8 x 8 pixels; 64
                                levels without samples. For light, alpha_cutoff applies. Not in builds without
                                LMB_MULTISAMPLE */ };

/* Lower bound of a lobe's alpha = roughness^2: keeps a point light's highlight under 3,200 times the reflectance, and
 * the lobe's numbers far from the limits of binary32. */
#define LMB_MIN_ALPHA 0.01f

/* A Lambertian surface. Its diffuse albedo is albedo x texture x vertex colour [V2], 0 .. 1 per channel. If `specular`
 * is not 0 it also has one glossy lobe towards the viewer: lmb_glossy. Only the diffuse part bounces light on to other
 * surfaces.
 *
 * All maps use the texture coordinates of the base colour. The viewer sees emission texel by texel; other surfaces are
 * lit by the mean over each element (elements.h). With a metal_map, per texel, the diffuse albedo is albedo x (1 -
 * metallic) and F0 is specular + (albedo - specular) x metallic: `specular` is then that of the non-metallic part.
 * Builds without lobes (LMB_LOBES 0) read neither map. */
typedef struct lmb_material {
    float albedo[3];
    float alpha;        /* times texture alpha times vertex alpha */
    float alpha_cutoff;
    int32_t texture;    /* index into scene->textures, or -1 */
    uint32_t flags;
    uint32_t normal_map; /* index into scene->textures; used if normal_scale is not 0 */
    float normal_scale;  /* times the map's x and y; 0: no normal map */
    float emission[3];   /* radiance emitted by the front, W/(sr m2), and by the back if LMB_DOUBLE_SIDED is set; times
                            emission_map's texels */
    float specular[3];   /* F0, the lobe's reflectance along the normal, 0 .. 1; all 0: no lobe */
    float roughness;     /* 0 .. 1; alpha = roughness^2, at least LMB_MIN_ALPHA; times metal_map's G */
    uint32_t emission_map; /* 1 + index into scene->textures, sRGB: multiplies emission; 0: none */
    uint32_t metal_map;    /* 1 + index of glTF's map of roughness (G) and metallic (B), linear; 0: none */
    float metallic;        /* 0 .. 1, times metal_map's B; only with it */
} lmb_material;

/* A mesh placed in the world. Triangle t has the id first_id + t, in the draw order of the scene; the first instance
 * has first_id 1, so that id 0 means nothing was drawn. lmb_scene_check verifies the numbering. */
typedef struct lmb_instance {
    lmb_mat4 to_world; /* affine; may mirror or scale unevenly */
    uint32_t mesh, material;
    uint32_t first_id;
    uint32_t revision; /* raise it when you change to_world or the mesh's data */
} lmb_instance;

enum { LMB_LIGHT_POINT = 0, LMB_LIGHT_SPOT = 1, LMB_LIGHT_DIRECTIONAL = 2 };

/* A light without area. Spot: full inside the inner cone, zero outside the outer one, smoothstep of the cosine between.
 * `direction` is the direction in which the light travels, unit length.
 * If a point or spot light has a range, the light at the distance d is multiplied by max(1 - (d / range)^4, 0), as
 * viewers draw KHR_lights_punctual. Directional lights have no range. */
typedef struct lmb_light {
    lmb_vec3 position;
    lmb_vec3 direction;
    float intensity[3]; /* W/sr; directional: W/m2 on a plane facing the light */
    float cos_inner, cos_outer;
    int32_t kind;
    uint32_t revision; /* raise it when you change the light at this index of scene->lights */
    float range;       /* m; 0, or 2^30 and more: unlimited */
} lmb_light;

/* The part of a scene with the fine detail, m: for example the house on a terrain. A sun's shadow map has a face for
 * this core, one for the whole scene, and others between them, each at most 16 times as wide as the one inside it. */
enum { LMB_CORE_FACES = 6 };
typedef struct lmb_core {
    lmb_vec3 low, high;           /* the box of the finest detail */
    lmb_vec3 wide_low, wide_high; /* the box of nearly all triangles; the scene's bounds if these are all */
    int32_t faces;                /* of a sun's map, up to LMB_CORE_FACES; 0 or 1: one face, for the scene's bounds */
} lmb_core;

typedef struct lmb_scene {
    const lmb_mesh *meshes;
    const lmb_material *materials;
    const lmb_texture *textures;
    const lmb_instance *instances;
    const lmb_light *lights;
    uint32_t mesh_count, material_count, texture_count, instance_count, light_count;
    lmb_vec3 bounds_min, bounds_max; /* of all placed vertices, world metres: lmb_scene_bounds */
    uint32_t revision;        /* raise it when you change anything that the next two do not cover */
    uint32_t lights_revision; /* raise it when you add, remove or change lights; if you change one, its own revision
                                 is enough */
    uint32_t appearance_revision; /* raise it when you change only colours: albedo, emission, specular, roughness,
                                     texels but not their holes; visibility and occlusion are unchanged */
    lmb_core core;            /* lmb_scene_core; all 0: suns' maps have one face */
} lmb_scene;

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_scene_check: check that a scene is safe to draw. Reads every struct (not the vertices; draws check each index).
 *
 * Returns LMB_OK, LMB_ERR_ARG (null pointer, non-finite number, too many triangles, negative albedo, emission or
 * intensity, specular, roughness or metallic outside 0 .. 1, direction not of unit length, cones not 0 < cos_outer <=
 * cos_inner <= 1, bounds or core reversed), LMB_ERR_ALIGN (a stream not 4-byte aligned), LMB_ERR_FORMAT (unknown
 * format, wrap, filter, light kind), LMB_ERR_SCENE (index outside, ids not numbered in order). Call it once after you
 * load a scene; all other functions assume a checked scene. */
lmb_status lmb_scene_check(const lmb_scene *scene);

/* lmb_scene_triangles: the number of triangles over all instances of a checked scene, which is the highest id. Cost:
 * none. */
uint32_t lmb_scene_triangles(const lmb_scene *scene);

/* lmb_scene_emits: 1 if a material emits light (a frame then needs elements), else 0. */
int lmb_scene_emits(const lmb_scene *scene);

/* lmb_scene_is_glossy: 1 if a material has a lobe, else 0. */
int lmb_scene_is_glossy(const lmb_scene *scene);

/* lmb_scene_bounds: the box of all placed, finite vertices; (0,0,0)-(0,0,0) for none. Cost: one pass over them. */
void lmb_scene_bounds(lmb_vec3 *out_min, lmb_vec3 *out_max, const lmb_scene *scene);

/* lmb_scene_core: find the core of a checked scene from the sizes of the triangles. All of `out` is 0 if one face is
 * enough, as in most scenes. Call it after lmb_scene_bounds, and again when you have moved objects far. Missing in
 * builds without trees. Cost: up to 250 passes over 8,192 of the triangles, and a few over all. */
void lmb_scene_core(lmb_core *out, const lmb_scene *scene);

/* lmb_texture_bytes: memory of `levels` levels of a width x height image, 4 bytes a texel; 0 for a bad size. */
size_t lmb_texture_bytes(int32_t width, int32_t height, int32_t levels);

/* lmb_texture_format_bytes: the same for a format, a palette included; 0 for an unknown format, too. */
size_t lmb_texture_format_bytes(int32_t format, int32_t width, int32_t height, int32_t levels);

/* lmb_texture_level_count: number of levels down to 1x1. */
int32_t lmb_texture_level_count(int32_t width, int32_t height);

/* lmb_texture_mips: fill levels 1.. from level 0. Each texel is the mean of the area that it covers, in linear light
 * and weighted by alpha. If a side is odd, each texel covers parts of three texels. `texels` holds lmb_texture_bytes.
 * Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_texture_mips(uint8_t *texels, int32_t width, int32_t height, int32_t levels);

/* lmb_normal_map_mips: the same with plain means of the codes. Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_normal_map_mips(uint8_t *texels, int32_t width, int32_t height, int32_t levels);

/* lmb_octahedral_encode, lmb_octahedral_decode: a unit vector as two int16, and back (Meyer et al. 2010); error under
 * 4.4e-5 rad. */
void lmb_octahedral_encode(int16_t out[2], lmb_vec3 unit);
lmb_vec3 lmb_octahedral_decode(const int16_t code[2]);

#ifdef __cplusplus
}
#endif
#endif
