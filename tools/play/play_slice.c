/* play_slice.c: frames -> a slice's file -> pictures. */
#include "play_slice.h"

#include "../common/frame_name.h"
#include "../picture/picture.h"
#include "play_options.h"

int play_slice_put(byte_buffer *to, int32_t k, int format, const file_bytes *file, report *r)
{
    byte_put_int(to, k);
    byte_put_int(to, format);
    byte_put_long(to, file->size);
    byte_put(to, file->data, file->size);
    return !to->is_short || report_fail(r, "not enough memory for the frames of a slice; use more slices");
}

int play_slice_write(const char *out, slice s, uint64_t job, const char *about, const byte_buffer *made, report *r)
{
    char name[SLICE_NAME];
    return slice_name(name, out, s, r) && slice_write(name, s, SLICE_PLAY, job, about, made, r);
}

/* Reads a slice and writes the frames. If `is_look`, only checks that they are complete and can be written. Returns 1,
 * or 0 with `r` set. */
static int put_frames(const char *path, const char *pattern, int is_look, report *r)
{
    slice_file f;
    char name[SLICE_NAME];
    int ok = slice_read(&f, path, r);
    while (ok && f.says.at < f.says.end) {
        const int32_t k = byte_get_int(&f.says);
        const int format = byte_get_int(&f.says);
        const uint64_t size = byte_get_long(&f.says);
        const uint8_t *data = size <= (size_t)(f.says.end - f.says.at) ? byte_get(&f.says, (size_t)size) : NULL;
        if (data == NULL || k < 0) {
            ok = report_fail(r, "%s: damaged", path);
        } else if (format != picture_format(pattern)) {
            ok = report_fail(r, "-o %s: the slices were made for another format of picture", pattern);
        } else {
            ok = frame_name(name, sizeof name, pattern, k, r) &&
                 (is_look ? file_may_replace(name, r) : file_write(name, data, (size_t)size, r));
        }
    }
    slice_file_free(&f);
    return ok;
}

int play_slice_merge(const char *pattern, const slice_set *set, report *r)
{
    for (int is_look = 1; is_look >= 0; --is_look) {
        for (int32_t i = 0; i < set->count; ++i) {
            if (!put_frames(set->path[i], pattern, is_look, r)) {
                return 0;
            }
        }
    }
    return 1;
}
