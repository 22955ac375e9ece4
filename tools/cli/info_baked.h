/* info_baked.h: `lambent info` for baked files: light (.lmt) and reliefs (.lmr). */
#ifndef INFO_BAKED_H
#define INFO_BAKED_H

#include "../common/io_file.h"

/* info_baked_begins: tests the first bytes. */
int info_baked_begins(const file_bytes *file);

/* info_baked: prints the facts; `out` NULL: only checks. Returns 1, or 0 with `r` set: a file that the verb for it
 * would refuse. */
int info_baked(FILE *out, const char *path, const file_bytes *file, int json, report *r);

#endif
