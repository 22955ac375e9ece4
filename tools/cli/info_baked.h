/* info_baked.h: what `lambent info` says of files that lambent bakes: light (.lmt) and reliefs (.lmr). */
#ifndef INFO_BAKED_H
#define INFO_BAKED_H

#include "../common/io_file.h"

/* By its first bytes. */
int info_baked_begins(const file_bytes *file);

/* `out`: NULL for no figures. 1, or 0 with `r` set: a file that its verb would refuse. */
int info_baked(FILE *out, const char *path, const file_bytes *file, int json, report *r);

#endif
