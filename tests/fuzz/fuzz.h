/* fuzz.h: the fuzz targets: one a parser, three for the library, each on bytes that may be anything. The same functions
 * replay a file.
 *
 * Models lie in tests/fuzz/neighbours, whose files they may name, as seen from the repository's root: run there. */
#ifndef FUZZ_H
#define FUZZ_H

#include <stddef.h>
#include <stdint.h>

#include "../../tools/common/report.h"

typedef void (*fuzz_target)(const uint8_t *data, size_t size);

/* fuzz_find: the target of that name, or NULL. */
fuzz_target fuzz_find(const char *name);
extern const char *const fuzz_names[]; /* ends with NULL */

/* fuzz_require: print what does not hold and abort, which a fuzzer reports with its input. */
#define fuzz_require(condition) fuzz_check((condition) != 0, #condition, __FILE__, __LINE__)
void fuzz_check(int holds, const char *condition, const char *file, int line);

/* fuzz_failed: a failure says so in one line that begins with `begin`: the file's name, or the folder that it and
 * what stands beside it lie in. */
void fuzz_failed(const report *r, const char *begin);
extern uint32_t fuzz_failures; /* how often that was called */

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

/* fuzz_repair: for a target that reads PNG, put right checksums over whatever a mutation left of one's chunks, unless
 * the seed is a multiple of eight; without them nothing behind them would be reached. Other bytes stay. */
void fuzz_repair(fuzz_target target, uint8_t *data, size_t size, uint64_t seed);

#endif
