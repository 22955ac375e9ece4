/* pfm_file.h: a picture that has to be there: one that cannot be read has failed. */
#ifndef TEST_PFM_FILE_H
#define TEST_PFM_FILE_H

#include "../tools/picture/image.h"
#include "test.h"

typedef int decode_picture(image *out, const uint8_t *data, size_t size, const char *name, report *r);

static inline int picture_file(image *out, const char *path, decode_picture *decode)
{
    file_bytes bytes;
    report r = {""};
    int ok = file_read(&bytes, path, &r);
    if (ok) {
        ok = decode(out, bytes.data, bytes.size, path, &r);
        file_free(&bytes);
    }
    CHECK_MSG(ok, "%s", r.text);
    return ok;
}

static inline int pfm_file(image *out, const char *path) { return picture_file(out, path, pfm_decode); }

#endif
