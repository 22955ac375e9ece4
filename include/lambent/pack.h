/* pack.h: a scene as one file that is used in place, from flash or a mapped file, or as a C array: `lambent pack`.
 *
 *     lmb_pack_open(&pack, words, bytes);                  checks all of it once
 *     lmb_pack_scene(&scene, &pack, memory, lmb_pack_bytes(&pack));
 *     lmb_pack_pose(&scene, &pack, time_s);                            moves animated instances and lights
 *     lmb_pack_view(&view, &pack, &scene, 0, time_s, width, height);   the view of a camera
 *     lmb_transfer_open(&transfer, lmb_pack_part(&pack, LMB_PACK_TRANSFER, &n), n);
 *
 * Vertices, indices and texels are used in the file; only the scene's structs are made in your memory.
 *
 * A .lmp, version 1: 32-bit words in the byte order that word 1 shows. Offsets are bytes from the file's start,
 * multiples of 4; an offset of 0 means: none.
 *   word 0  the bytes L M P 1           word 3  parts, 1 .. LMB_PACK_MOST_PARTS
 *        1  0x01020304                       4 .. 6  0
 *        2  bytes of the file                7  FNV-1a, 32 bits, of all other bytes; 0: none
 *                                            8  of each part: kind, offset, bytes, 0
 * No kind occurs twice. Parts follow the table and do not overlap. Unknown kinds are skipped. Records, in words; floats
 * are binary32:
 *   SCENE      bounds_min, bounds_max; lmb_core: low, high, wide_low, wide_high, faces; then 0
 *   MESHES     vertices, triangles, position_format | uv_format << 8 | index_format << 16 | tangent_format << 24 |
 *              colour_format << 28, offsets of positions, normals, tangents, uvs, colours, indices; position_scale,
 *              position_offset, uv_scale; then 0
 *   MATERIALS  albedo, alpha, alpha_cutoff, texture, flags, normal_map, normal_scale, emission, specular, roughness,
 *              emission_map, metal_map, metallic, as in lmb_material; then 0
 *   TEXTURES   offset, width | height << 16, levels | format << 8 | wrap_s << 16 | wrap_t << 24, filter
 *   INSTANCES  to_world without the last row, by columns; mesh, material, node, 0
 *   LIGHTS     position, direction, intensity, cos_inner, cos_outer, kind, node, range (0: none); then 0
 *   CAMERAS    eye, right, up, back, kind, half_width, half_height, aspect, near_m, far_m, vfov_rad, node, as in
 *              lmb_view; aspect, near_m and far_m 0: not given; vfov_rad 0: orthographic
 *   NODES      parent, which is an earlier node, or LMB_PACK_NONE; first track; tracks; 0; translation, rotation x y z
 *              w, scale, 0, 0; or with 1 in the fourth word a matrix, as of instances
 *   TRACKS     target (0 translation, 1 rotation, 2 scale) | interpolation (0 step, 1 linear, 2 cubic) << 8; keys;
 *              offsets of times, s, ascending, and of values: 3 or 4 a key; cubic: three of them, in-tangent, value,
 *              out-tangent
 *   NAMES      of cameras, one after the other, each with a final 0
 *
 * Stability: stable. */
#ifndef LMB_PACK_H
#define LMB_PACK_H

#include "scene.h"

enum {
    LMB_PACK_SCENE = 1,
    LMB_PACK_MESHES,
    LMB_PACK_VERTICES,
    LMB_PACK_INDICES,
    LMB_PACK_MATERIALS,
    LMB_PACK_TEXTURES,
    LMB_PACK_TEXELS,
    LMB_PACK_INSTANCES,
    LMB_PACK_LIGHTS,
    LMB_PACK_CAMERAS,
    LMB_PACK_NODES,
    LMB_PACK_TRACKS,
    LMB_PACK_KEYS,
    LMB_PACK_NAMES,
    LMB_PACK_TRANSFER,     /* a whole .lmt, checked by lmb_transfer_open */
    LMB_PACK_VERTEX_LIGHT, /* light by vertex for processors without floats; checked by its reader */
    LMB_PACK_KINDS
};

enum {
    LMB_PACK_VERSION = 1, /* the file's fourth byte, after `LMP` */
    LMB_PACK_HEADER_WORDS = 8,
    LMB_PACK_PART_WORDS = 4,
    LMB_PACK_MOST_PARTS = 64,
    LMB_PACK_SCENE_WORDS = 20,
    LMB_PACK_MESH_WORDS = 20,
    LMB_PACK_MATERIAL_WORDS = 20,
    LMB_PACK_TEXTURE_WORDS = 4,
    LMB_PACK_INSTANCE_WORDS = 16,
    LMB_PACK_LIGHT_WORDS = 16,
    LMB_PACK_CAMERA_WORDS = 20,
    LMB_PACK_NODE_WORDS = 16,
    LMB_PACK_TRACK_WORDS = 4,
    LMB_PACK_MOST_ABOVE = 64 /* nodes above a node */
};
#define LMB_PACK_NONE 0xffffffffu

/* Words per record of each kind, indexed by LMB_PACK_SCENE and so on; 0: the kind has no records. */
#define LMB_PACK_WORDS_EACH                                                                                    \
    {0, LMB_PACK_SCENE_WORDS, LMB_PACK_MESH_WORDS, 0, 0, LMB_PACK_MATERIAL_WORDS, LMB_PACK_TEXTURE_WORDS, 0,   \
     LMB_PACK_INSTANCE_WORDS, LMB_PACK_LIGHT_WORDS, LMB_PACK_CAMERA_WORDS, LMB_PACK_NODE_WORDS,                \
     LMB_PACK_TRACK_WORDS, 1, 0, 0, 0}

/* A file in place, checked by lmb_pack_open. */
typedef struct lmb_pack {
    const uint32_t *part[LMB_PACK_KINDS]; /* by kind; NULL: none */
    uint32_t bytes[LMB_PACK_KINDS];
    uint32_t count[LMB_PACK_KINDS]; /* records, of kinds that have records */
    const uint32_t *data;
    float seconds; /* time of the last key; 0: nothing moves */
} lmb_pack;

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_pack_open: check a .lmp and find the parts. Nothing is copied: keep `data` as long as you use `out` and its
 * scenes.
 *
 * Returns LMB_OK, LMB_ERR_ARG (null), LMB_ERR_ALIGN (data not on 4 bytes), LMB_ERR_FORMAT (no .lmp of version 1, the
 * other byte order, cut off, parts that overlap, an invalid offset, index or number): then `out` is all 0. In an
 * accepted file no number leads outside, and vertex indices are valid. Word 7 is checked only by the tool; the parts
 * TRANSFER and VERTEX_LIGHT by the calls that open them.
 * Cost: one pass over indices and records; vertices and texels are not read. */
lmb_status lmb_pack_open(lmb_pack *out, const void *data, size_t bytes);

/* lmb_pack_part: a part in place, and the size in bytes; NULL and 0 if there is none. */
const void *lmb_pack_part(const lmb_pack *pack, int32_t kind, size_t *bytes);

/* lmb_pack_bytes: memory for lmb_pack_scene; 0: null, an empty scene, or more than this target can address. */
size_t lmb_pack_bytes(const lmb_pack *pack);

/* lmb_pack_scene: make the scene, with structs in `memory`, and streams and texels in the file.
 * Returns LMB_OK, LMB_ERR_ARG, LMB_ERR_ALIGN (memory not aligned for pointers), LMB_ERR_CAPACITY, or an error of
 * lmb_scene_check: LMB_ERR_FORMAT if this build lacks a texture's format. */
lmb_status lmb_pack_scene(lmb_scene *out, const lmb_pack *pack, void *memory, size_t bytes);

/* lmb_pack_pose: set instances and lights to the animations at a time. Before the first key and after the last one, the
 * value of that key holds. Revisions of changed parts are raised, and bounds are recomputed if instances changed.
 *
 *   inout  from lmb_pack_scene: instances and lights in its memory are overwritten
 * Returns LMB_OK; LMB_ERR_ARG (a scene of another file); LMB_ERR_SCENE: a rotation of length 0, or numbers beyond
 * binary32; instances and lights after the failing one are unchanged. A light below a scale of 0 takes its direction
 * from the rotations. Cost: the nodes above each instance and light that moves, some 200 operations each; and one pass
 * over all vertices if instances moved. */
lmb_status lmb_pack_pose(lmb_scene *inout, const lmb_pack *pack, float time_s);

/* lmb_pack_place_instance, lmb_pack_place_light: the same for one instance or light, in a copy of yours.
 *
 *   inout  instance or light i of a scene from lmb_pack_scene. Only to_world, or position and direction, are set; if
 *          nothing moves it, it stays unchanged. Revisions are yours to raise.
 * Returns LMB_OK, LMB_ERR_ARG (null, or no record i) or LMB_ERR_SCENE as lmb_pack_pose: then `inout` is unchanged. */
lmb_status lmb_pack_place_instance(lmb_instance *inout, const lmb_pack *pack, uint32_t i, float time_s);
lmb_status lmb_pack_place_light(lmb_light *inout, const lmb_pack *pack, uint32_t i, float time_s);

/* lmb_pack_view: the view of camera `camera` at a time, on a frame of square pixels.
 *
 *   scene  after lmb_pack_pose; its bounds give near_m and far_m if the file does not
 * Returns LMB_OK, LMB_ERR_ARG (no such camera, a size outside), LMB_ERR_SCENE (the animation gives no valid
 * position or axes). */
lmb_status lmb_pack_view(lmb_view *out, const lmb_pack *pack, const lmb_scene *scene, uint32_t camera, float time_s,
                         int32_t width, int32_t height);

#ifdef __cplusplus
}
#endif
#endif
