/* byte_buffer.h: a growing array of little-endian numbers, for files that are written at once; and a reader. */
#ifndef BYTE_BUFFER_H
#define BYTE_BUFFER_H

#include <stddef.h>
#include <stdint.h>

/* Zeroed: empty; release it with free(data). If memory runs out, it stays unchanged and sets `is_short`, which you
 * can check at the end. */
typedef struct byte_buffer {
    uint8_t *data;
    size_t size, cap;
    int is_short;
} byte_buffer;

void byte_put(byte_buffer *b, const void *data, size_t size);
void byte_put_int(byte_buffer *b, int32_t v);
void byte_put_long(byte_buffer *b, uint64_t v);
void byte_put_float(byte_buffer *b, float v);
void byte_put_floats(byte_buffer *b, const float *v, size_t count);
void byte_put_double(byte_buffer *b, double v);

/* Reads numbers back. Past the end all reads return 0 and set `is_short`. */
typedef struct byte_reader {
    const uint8_t *at, *end;
    int is_short;
} byte_reader;

const uint8_t *byte_get(byte_reader *s, size_t size); /* NULL past the end */
int32_t byte_get_int(byte_reader *s);
uint64_t byte_get_long(byte_reader *s);
float byte_get_float(byte_reader *s);
void byte_get_floats(float *out, byte_reader *s, size_t count);
double byte_get_double(byte_reader *s);

#endif
