/* pack.h: a scene on its way into a .lmp: its parts, and what was lost on the way. */
#ifndef PACK_H
#define PACK_H

#include <lambent/lambent.h>

#include "../common/io_file.h"
#include "../common/report.h"
#include "../model/model.h"

enum { PACK_LOCALITY = 0, PACK_FILE }; /* the order of triangles */
enum { PACK_AUTO = 0, PACK_RGBA8, PACK_RGB565, PACK_PALETTE4 };

typedef struct pack_settings {
    double position_error_m; /* 0: positions stay binary32 */
    double texture_error;    /* of 255, rms, for PACK_AUTO */
    int order, textures;
} pack_settings;

/* Bytes that grow, in multiples of 4. Once memory is short it stays as it is and `is_short` is set. */
typedef struct pack_buffer {
    uint8_t *data;
    size_t size, cap;
    int is_short;
} pack_buffer;

/* What packing did, for the report. */
typedef struct pack_losses {
    double position_m, uv_texels, texture; /* the largest errors: m, texels, rms of 255 */
    uint32_t vertices, triangles;          /* kept */
    uint32_t vertices_before, dropped;     /* triangles without area or corners */
    uint64_t fetched_before, fetched;      /* vertices that a first-in first-out cache of 16 fetches, of all meshes */
    uint32_t textures[4];                  /* by LMB_TEXELS_ */
    uint32_t float_meshes;                 /* whose positions stay binary32 */
} pack_losses;

/* The parts in this machine's byte order. Offsets in records count from their part's start, and are 4 larger: see
 * pack_place. */
typedef struct pack {
    pack_buffer part[LMB_PACK_KINDS];
    pack_losses lost;
} pack;

/* pack_put: bytes, then zeros up to a multiple of 4. pack_word, pack_float, pack_vec: records. pack_place: where the next
 * byte of a part goes, as records have it. All say by `is_short` that memory ended. */
void pack_put(pack_buffer *to, const void *data, size_t size);
void pack_word(pack_buffer *to, uint32_t word);
void pack_float(pack_buffer *to, float v);
void pack_vec(pack_buffer *to, lmb_vec3 v);
void pack_words(pack_buffer *to, int count, uint32_t word);
uint32_t pack_place(const pack_buffer *part);

/* pack_model: all of a model but its transfer. `demo`: it is the built-in scene, with its camera. pack_take: the parts of a
 * packed scene as they are. 1, or 0 with `r` set; pack_free in any case. */
int pack_model(pack *out, const model *m, const pack_settings *set, report *r);
int pack_take(pack *out, const lmb_pack *from, const char *path, report *r);
void pack_free(pack *p);

/* Its pieces, each into its own parts. `slot`: by the model's textures, the packed one or UINT32_MAX. */
int pack_meshes(pack *out, const lmb_scene *scene, const pack_settings *set, report *r);
int pack_textures(pack *out, uint32_t *slot, const lmb_scene *scene, const pack_settings *set, report *r);
int pack_motion(pack *out, const model *m, uint32_t *node_of_instance, uint32_t *node_of_light, uint32_t *node_of_camera,
                report *r);

/* pack_order: triangles in an order in which they share vertices with those just before. `index`: 3 a triangle.
 * pack_fetched: how many vertices a first-in first-out cache of 16 fetches. 0: no memory. */
int pack_order(uint32_t *index, uint32_t triangles, uint32_t vertices);
uint64_t pack_fetched(const uint32_t *index, uint32_t triangles, uint32_t *scratch, uint32_t vertices);

/* pack_encode: a texture's levels, RGBA8, in another format, appended to `out`; the rms of the codes' errors, of 255, over
 * level 0. With `alpha` it counts, too. Under 0: no memory. */
double pack_encode(pack_buffer *out, const lmb_texture *t, int format, int alpha);

/* pack_file: the file, in this machine's byte order. pack_swap: into the other one. */
int pack_file(file_bytes *out, const pack *p, report *r);
void pack_swap(file_bytes *inout, const lmb_pack *opened);

/* pack_code: the file as a C array `name`. */
int pack_code(const char *path, const char *name, const file_bytes *file, int is_big, report *r);

#endif
