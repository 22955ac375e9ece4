/* relief_file.c: reads a .lmr file. */
#include "../common/checksum.h"
#include "relief_crowd.h"

int relief_file_open(lmb_relief *out, file_bytes *bytes, const char *path, report *r)
{
    if (!file_read(bytes, path, r)) {
        return 0;
    }
    const int fits = checksum_fits(bytes->data, bytes->size, LMB_RELIEF_HEADER_WORDS);
    lmb_status status = lmb_relief_swap(bytes->data, bytes->size);
    if (status == LMB_OK && !fits) {
        return report_fail(r, "%s: a damaged .lmr file; copy it or bake it again", path);
    }
    if (status == LMB_OK) {
        status = lmb_relief_open(out, bytes->data, bytes->size);
    }
    return status == LMB_OK ||
           report_fail(r, "%s: %s", path, status == LMB_ERR_CAPACITY ? "more views than this build takes"
                                                                     : "not a whole .lmr file of version 1");
}
