/* io_lmp.h: reads packed scenes that `lambent pack` wrote. */
#ifndef IO_LMP_H
#define IO_LMP_H

#include "model_build.h"

/* lmp_begins: whether the first bytes are those of a packed scene, of any version and byte order. */
int lmp_begins(const uint8_t *data, size_t size);

/* lmp_load: returns 1, or 0 with b->r set. The scene's streams point into a copy of the file that the model owns. */
int lmp_load(model_build *b, const uint8_t *data, size_t size);

/* lmp_refuse: sets `r` to the reason why the library does not open the file. Returns 0. */
int lmp_refuse(const char *path, const uint8_t *data, size_t size, report *r);

#endif
