/* text_buffer.h: a growing text, for files that are written at once. */
#ifndef TEXT_BUFFER_H
#define TEXT_BUFFER_H

#include <stddef.h>
#include <stdint.h>

#include "report.h"

/* Zeroed: empty; text_buffer_free releases it. If memory runs out, it stays unchanged and sets `is_short`, which you
 * can check at the end. */
typedef struct text_buffer {
    char *data; /* ends with 0 */
    size_t size, cap;
    int is_short;
} text_buffer;

/* text_buffer_add: like printf, cleaned by text_format. text_buffer_plain, text_buffer_span: unchanged, for the tool's
 * own text. text_buffer_html: escapes & < > ". text_buffer_json: writes a string with quotes. text_buffer_csv: quotes
 * the text if it contains a comma or a quote. html and csv replace hidden characters like text_clean, and json escapes
 * them. text_buffer_base64: RFC 4648, padded. */
void text_buffer_add(text_buffer *p, const char *format, ...) REPORT_PRINTF(2, 3);
void text_buffer_plain(text_buffer *p, const char *text);
void text_buffer_span(text_buffer *p, const char *text, size_t size);
void text_buffer_html(text_buffer *p, const char *text);
void text_buffer_json(text_buffer *p, const char *text);
void text_buffer_csv(text_buffer *p, const char *text);
void text_buffer_base64(text_buffer *p, const uint8_t *data, size_t size);

/* text_buffer_write: writes the file. Returns 1, or 0 with `r` set. */
int text_buffer_write(const text_buffer *p, const char *path, report *r);

void text_buffer_free(text_buffer *p);

#endif
