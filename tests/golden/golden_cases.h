/* golden_cases.h: shared by the files of golden cases: a scene, memory, hashes. */
#ifndef GOLDEN_CASES_H
#define GOLDEN_CASES_H

#include "golden.h"

/* Alignment of static memory that is passed to calls. Compilers align by type only, which is 4 bytes for structs of
 * floats, and 2 bytes for everything on a 68000. */
#ifdef __GNUC__
#define GOLDEN_ALIGNED __attribute__((aligned(8)))
#else
#define GOLDEN_ALIGNED
#endif

#define GOLDEN_START UINT64_C(0xcbf29ce484222325)

extern const lmb_kernels *golden_kernels; /* kernels of the current run */

/* FNV-1a of little-endian bytes. */
uint64_t golden_hash_u32(uint64_t h, uint32_t v);
uint64_t golden_hash_floats(uint64_t h, const float *v, size_t n);

/* Forty triangles in two instances, with textures, holes and colours, and a view of them. */
lmb_scene *golden_soup(uint32_t seed, float span);
lmb_view golden_soup_view(int orthographic);
float golden_random(float low, float high); /* continues the soup's random numbers */

/* GOLDEN_WIDTH x GOLDEN_HEIGHT, depth and ids cleared; the same memory each time. */
lmb_target golden_eye(int depth_format, int id_format);

/* Memory of cases, besides the eye's: two pieces, 8-byte aligned, the same each time, filled with 0x3c. A case that
 * needs more than the small configuration has (130 and 64 KiB) breaks the build. */
typedef struct golden_space {
    uint64_t first[130 * 128], second[64 * 128];
} golden_space;
void *golden_first(void);
void *golden_second(void);
#define GOLDEN_FITS(type, piece) \
    typedef char type##_fits[sizeof(type) <= sizeof ((golden_space *)0)->piece ? 1 : -1]

#if LMB_PROBES
uint64_t case_probe(int variant);  /* golden_probe.c */
uint64_t case_relit(int variant);
uint64_t case_small_probe(int variant);
#endif
#if LMB_MIXED
uint64_t case_mixed(int variant);  /* golden_mixed.c */
uint64_t case_folded(int variant);
#endif
#if LMB_VOXELS && !defined(LMB_CONFIG_TINY)
uint64_t case_voxels(int variant); /* golden_voxel.c */
#endif
#if LMB_TRANSFER
uint64_t case_gouraud(int variant); /* golden_gouraud.c */
#endif
#if LMB_DRAW
uint64_t case_draw(int variant); /* golden_draw.c */
uint64_t case_blit(int variant);
uint64_t case_draw_each(int variant); /* golden_draw_each.c */
#endif
uint64_t case_fixed(int variant); /* golden_fixed.c */
#if LMB_RELIEF
uint64_t case_relief(int variant); /* golden_relief.c */
#endif

#endif
