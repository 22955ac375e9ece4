/* fuzz.h: the fuzz targets: one for each parser and three for the library, each for arbitrary bytes. The same
 * functions replay a file.
 *
 * Models are in tests/fuzz/neighbours and may name files there relative to the repository's
 * root, so run from the root. */
#ifndef FUZZ_H
#define FUZZ_H

#include <stddef.h>
#include <stdint.h>

#include "../../tools/common/report.h"

typedef void (*fuzz_target)(const uint8_t *data, size_t size);

/* fuzz_find: the target with this name, or NULL. */
fuzz_target fuzz_find(const char *name);
extern const char *const fuzz_names[]; /* ends with NULL */

/* fuzz_require: if the condition does not hold, prints the condition and aborts; a fuzzer then reports the input. */
#define fuzz_require(condition) fuzz_check((condition) != 0, #condition, __FILE__, __LINE__)
void fuzz_check(int holds, const char *condition, const char *file, int line);

/* fuzz_failed: checks that a failure printed one line that begins with `begin`: the file's name, or the folder of the
 * file and its neighbours. */
void fuzz_failed(const report *r, const char *begin);
extern uint32_t fuzz_failures; /* number of calls */

void fuzz_png(const uint8_t *data, size_t size);
void fuzz_jpeg(const uint8_t *data, size_t size);
void fuzz_hdr(const uint8_t *data, size_t size);
void fuzz_pfm(const uint8_t *data, size_t size);
void fuzz_ppm(const uint8_t *data, size_t size);
void fuzz_pam(const uint8_t *data, size_t size);
void fuzz_picture(const uint8_t *data, size_t size);
void fuzz_inflate(const uint8_t *data, size_t size);
void fuzz_json(const uint8_t *data, size_t size);
void fuzz_gltf(const uint8_t *data, size_t size);
void fuzz_obj(const uint8_t *data, size_t size);
void fuzz_mtl(const uint8_t *data, size_t size);
void fuzz_ply(const uint8_t *data, size_t size);
void fuzz_lmr(const uint8_t *data, size_t size);
void fuzz_lmt(const uint8_t *data, size_t size);
void fuzz_lmf(const uint8_t *data, size_t size);
void fuzz_lmp(const uint8_t *data, size_t size);
void fuzz_cli(const uint8_t *data, size_t size);
void fuzz_api(const uint8_t *data, size_t size);
void fuzz_calls(const uint8_t *data, size_t size);
void fuzz_stages(const uint8_t *data, size_t size);
/* In the fuzzer only: platform/gl's calls. main_gl.c. */
void fuzz_gl(const uint8_t *data, size_t size);

/* fuzz_repair: for a target that reads PNG, writes correct checksums to mutated chunks, because otherwise the fuzzer
 * would not get past them. Does nothing if the seed is a multiple of eight. Other bytes stay unchanged. */
void fuzz_repair(fuzz_target target, uint8_t *data, size_t size, uint64_t seed);

#endif
