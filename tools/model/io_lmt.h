/* io_lmt.h: opens baked light transfers: a .lmt, or the one in a packed scene. */
#ifndef IO_LMT_H
#define IO_LMT_H

#include <lambent/lambent.h>

#include "../common/io_file.h"

/* lmt_open: opens the transfer in a file, which must outlive it. Returns 1, or 0 with `r` set. */
int lmt_open(lmb_transfer *out, const file_bytes *file, const char *path, report *r);

#endif
