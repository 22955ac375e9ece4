/* text_clean.h: makes text from files and command lines safe to print. All output of the tool goes through here. */
#ifndef TEXT_CLEAN_H
#define TEXT_CLEAN_H

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

/* text_character: returns the number of bytes of the UTF-8 character (RFC 3629) at `s`, and its code point; 0 if no
 * character begins there. The terminating 0 ends any sequence. */
int text_character(uint32_t *code, const char *s);

/* text_is_hidden: returns 1 for control characters and for characters that reorder or hide text: C0, DEL, C1, direction
 * marks and overrides, line separators, tags, and characters that XML forbids. */
int text_is_hidden(uint32_t code);

/* text_clean: replaces each hidden character, line break and byte that is not UTF-8 with a question mark, in place. The
 * text never gets longer. text_clean_lines: keeps line breaks if there are at most `breaks`. If there are more, some
 * come from a name, and only one at the end is kept. */
void text_clean(char *inout);
void text_clean_lines(char *inout, int breaks);

/* text_format: vsnprintf, then text_clean_lines with the number of line breaks in the format. `args` is consumed. A
 * truncated text ends with a whole character. Returns the length of the text before cleaning. */
int text_format(char *out, size_t size, const char *format, va_list args);

/* text_json: writes the next character of *at, as in a JSON string: hidden characters as \u, and bytes that are not
 * UTF-8 as U+FFFD. *at must not be at the end. */
enum { TEXT_JSON = 16 };
void text_json(char out[TEXT_JSON], const char **at);

#endif
