/* options_table.h: shared by parsing and help of command lines. */
#ifndef OPTIONS_TABLE_H
#define OPTIONS_TABLE_H

#include "options.h"

/* Row i over all parts, or NULL after the last and for i < 0. */
const option_row *options_row(const option_table *t, int i);

int options_has_value(const option_row *row);

/* The key that a row stores, "block" of "--group block"; NULL if the row is an option of its own. */
const char *options_key(const option_row *row);

/* The text behind the name of an option: "WxH", "full|direct"; "" if it has no value. */
void options_value(char *out, size_t size, const option_row *row);

/* The purpose of an option, with the range. */
void options_text(char *out, size_t size, const option_row *row);

const char *options_status(const option_table *t);

/* The expected value, for `is not ...` and `wants a value: ...`. */
void options_wants(char *out, size_t size, const option_row *row);

#endif
