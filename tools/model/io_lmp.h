/* io_lmp.h: the reader of packed scenes: what `lambent pack` wrote. */
#ifndef IO_LMP_H
#define IO_LMP_H

#include "model_build.h"

/* lmp_begins: is this a packed scene, of any version and byte order, by its first bytes? */
int lmp_begins(const uint8_t *data, size_t size);

/* lmp_load: 1, or 0 with b->r set. The scene's streams lie in a copy of the file that the model owns. */
int lmp_load(model_build *b, const uint8_t *data, size_t size);

/* lmp_refuse: `r` says why the library does not open it. Returns 0. */
int lmp_refuse(const char *path, const uint8_t *data, size_t size, report *r);

#endif
