/* pack.h: the parts of a .lmp during packing, and the losses. */
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

/* A growing byte array, in multiples of 4. If memory is short, the contents stay and `is_short` is set, so you may
 * check it once at the end. */
typedef struct pack_buffer {
    uint8_t *data;
    size_t size, cap;
    int is_short;
} pack_buffer;

/* Figures for the report. */
typedef struct pack_losses {
    double position_m, uv_texels, texture; /* the largest errors: m, texels, rms of 255 */
    uint32_t vertices, triangles;          /* after packing */
    uint32_t vertices_before, dropped;     /* dropped: triangles without area or corners */
    uint64_t fetched_before, fetched;      /* vertices fetched by a FIFO cache of 16, over all meshes */
    uint32_t textures[4];                  /* by LMB_TEXELS_ */
    uint32_t float_meshes;                 /* number that keep binary32 positions */
} pack_losses;

/* The parts in this machine's byte order. Offsets in records are relative to the start of the part, plus 4: see
 * pack_place. */
typedef struct pack {
    pack_buffer part[LMB_PACK_KINDS];
    pack_losses lost;
} pack;

/* pack_put: appends bytes, then zeros up to a multiple of 4. pack_word, pack_float, pack_vec: append records.
 * pack_place: the offset of the next byte of a part, as used in records. If memory is short, all set `is_short`. */
void pack_put(pack_buffer *to, const void *data, size_t size);
void pack_word(pack_buffer *to, uint32_t word);
void pack_float(pack_buffer *to, float v);
void pack_vec(pack_buffer *to, lmb_vec3 v);
void pack_words(pack_buffer *to, int count, uint32_t word);
uint32_t pack_place(const pack_buffer *part);

/* pack_model: packs all of a model except baked light. `demo`: it is the built-in scene, with a camera. pack_take:
 * copies the parts of a packed scene unchanged. They return 1, or 0 with `r` set; call pack_free in any case. */
int pack_model(pack *out, const model *m, const pack_settings *set, report *r);
int pack_take(pack *out, const lmb_pack *from, const char *path, report *r);
void pack_free(pack *p);

/* Steps of pack_model, each for separate parts. `slot`: by the model's textures, the packed one or UINT32_MAX. */
int pack_meshes(pack *out, const lmb_scene *scene, const pack_settings *set, report *r);
int pack_textures(pack *out, uint32_t *slot, const lmb_scene *scene, const pack_settings *set, report *r);
int pack_motion(pack *out, const model *m, uint32_t *node_of_instance, uint32_t *node_of_light,
                uint32_t *node_of_camera, report *r);

/* pack_order: reorders triangles so that they share vertices with preceding ones. `index`: 3 per triangle.
 * pack_fetched: the number of vertices that a FIFO cache of 16 fetches. pack_order returns 0 if memory is short. */
int pack_order(uint32_t *index, uint32_t triangles, uint32_t vertices);
uint64_t pack_fetched(const uint32_t *index, uint32_t triangles, uint32_t *scratch, uint32_t vertices);

/* pack_encode: appends a texture's levels, RGBA8, in another format to `out`. Returns the rms error of the codes, of
 * 255, over level 0, or half of that over another level, if that is larger; it includes alpha if `alpha` is set.
 * Returns a negative number if memory is short. */
double pack_encode(pack_buffer *out, const lmb_texture *t, int format, int alpha);

/* pack_file: makes the file, in this machine's byte order. pack_swap: converts it to the other byte order. */
int pack_file(file_bytes *out, const pack *p, report *r);
void pack_swap(file_bytes *inout, const lmb_pack *opened);

/* Sets counts, formats and streams of mesh i, in place. */
void pack_streams(lmb_mesh *out, const lmb_pack *opened, uint32_t i);

/* pack_code: writes the file as a C array `name`. */
int pack_code(const char *path, const char *name, const file_bytes *file, int is_big, report *r);

#endif
