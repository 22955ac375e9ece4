/* page.h: text that grows, for files that are written whole. */
#ifndef PAGE_H
#define PAGE_H

#include <stddef.h>
#include <stdint.h>

#include "report.h"

/* Zeroed it is empty; page_free releases it. Once memory is short it stays as it is and `is_short` is set. */
typedef struct page {
    char *data; /* ends with 0 */
    size_t size, cap;
    int is_short;
} page;

/* page_add: as printf. page_plain: as it is. page_html: with & < > " escaped. page_json: a string with its quotes.
 * page_csv: quoted where a comma or quote asks for it. page_base64: RFC 4648, padded. */
void page_add(page *p, const char *format, ...) REPORT_PRINTF(2, 3);
void page_plain(page *p, const char *text);
void page_html(page *p, const char *text);
void page_json(page *p, const char *text);
void page_csv(page *p, const char *text);
void page_base64(page *p, const uint8_t *data, size_t size);

/* page_write: the file. 1, or 0 with `r` set. */
int page_write(const page *p, const char *path, report *r);

void page_free(page *p);

#endif
