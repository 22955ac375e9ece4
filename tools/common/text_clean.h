/* text_clean.h: text from files and command lines, as it may be printed. All that the tool prints goes through here. */
#ifndef TEXT_CLEAN_H
#define TEXT_CLEAN_H

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

/* text_character: bytes of the UTF-8 character (RFC 3629) at `s`, and its code point; 0: the byte there begins none.
 * The terminating 0 ends any sequence. */
int text_character(uint32_t *code, const char *s);

/* text_is_hidden: a control character, or one that turns or hides the text beside it: C0, DEL, C1, marks and overrides
 * of the direction, separators of lines, tags, and what XML has no place for. */
int text_is_hidden(uint32_t code);

/* text_clean: in place: hidden characters, line breaks too, and bytes that are not UTF-8 become a question mark each.
 * It never gets longer. text_clean_lines: line breaks stay, if there are no more than `breaks`; if there are more, a
 * name has brought some, and only one at the end stays. */
void text_clean(char *inout);
void text_clean_lines(char *inout, int breaks);

/* text_format: vsnprintf, then text_clean_lines by the format's own line breaks. `args` is used up. A text that is cut
 * ends with a whole character. Returns the length that the text had before it was cleaned. */
int text_format(char *out, size_t size, const char *format, va_list args);

/* text_json: the next character of *at, which is not at the end, as it stands between the quotes of a JSON string:
 * hidden ones by \u, U+FFFD for bytes that are not UTF-8. */
enum { TEXT_JSON = 16 };
void text_json(char out[TEXT_JSON], const char **at);

#endif
