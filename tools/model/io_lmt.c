/* io_lmt.c: opens baked light transfers, or reports why a file is refused. */
#include "io_lmt.h"

#include <string.h>

#include "../common/checksum.h"
#include "io_lmp.h"

/* Reports why a file is refused, from the first words of the file. */
static int refuse(const uint8_t *head, size_t size, const char *path, report *r)
{
    if (size < 8 || memcmp(head, "LMT", 3) != 0) {
        return report_fail(r, "%s: no light transfer, or a damaged one; `lambent bake` makes them", path);
    }
    if (head[3] != LMB_TRANSFER_VERSION) {
        return report_fail(r, "%s: a light transfer of version %d, and this reads version %d; bake it again", path,
                           head[3], LMB_TRANSFER_VERSION);
    }
    const uint32_t order = (uint32_t)head[4] << 24 | (uint32_t)head[5] << 16 | (uint32_t)head[6] << 8 | head[7];
    const uint32_t own = 0x01020304u;
    if ((order == 0x01020304u || order == 0x04030201u) && memcmp(head + 4, &own, 4) != 0) {
        return report_fail(r, "%s: baked for %s-endian machines, unlike this one; `lambent bake --endian %s`", path,
                           order == own ? "big" : "little", order == own ? "little" : "big");
    }
    return report_fail(r, "%s: a damaged light transfer; bake it again", path);
}

int lmt_open(lmb_transfer *out, const file_bytes *file, const char *path, report *r)
{
    const uint8_t *data = file->data;
    size_t size = file->size;
    lmb_pack pack;
    if (size == 0) {
        return report_fail(r, "%s: the file is empty (0 bytes); export or copy it again", path);
    }
    if (lmp_begins(data, size)) {
        if (lmb_pack_open(&pack, data, size) != LMB_OK || !checksum_fits(data, size, LMB_PACK_HEADER_WORDS)) {
            return lmp_refuse(path, data, size, r);
        }
        data = lmb_pack_part(&pack, LMB_PACK_TRANSFER, &size);
        if (data == NULL) {
            return report_fail(r, "%s: a packed scene without baked light; `lambent pack --transfer` puts it in", path);
        }
    }
    return (lmb_transfer_open(out, data, size) == LMB_OK && checksum_fits(data, size, LMB_TRANSFER_HEADER_WORDS)) ||
           refuse(data, size, path, r);
}
