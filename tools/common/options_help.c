/* options_help.c: prints the help of a verb's table, wrapped to less than 100 columns. */
#include <string.h>

#include "command_name.h"
#include "options_table.h"

enum { WIDTH = 98, INDENT = 2, COLUMN = 29 /* column of the text beside a name */ };

/* --- expected values ---------------------------------------------------------------------------------------------- */

static const char backends[] = "avx512, avx2, sse2, neon, simd128, scalar, as far as this machine has it";

/* "8 .. 4096"; "" if there is no useful range. */
static void range_of(char *out, size_t size, const option_row *row)
{
    const char *what = row->kind == OPTION_POWER_OF_2      ? "a power of two, "
                       : row->kind == OPTION_MULTIPLE_OF_8 ? "a multiple of 8, "
                                                           : "";
    out[0] = '\0';
    if (row->kind >= OPTION_INT && row->kind <= OPTION_MULTIPLE_OF_8) {
        snprintf(out, size, "%s%.0f .. %.0f", what, row->low, row->high);
    } else if (row->kind == OPTION_ABOVE) {
        snprintf(out, size, row->high < 1e5 ? "over %g, at most %g" : "over %g", row->low, row->high);
    } else if (row->kind == OPTION_NUMBER && row->high < 1e5) {
        snprintf(out, size, "%g .. %g", row->low, row->high);
    } else if (row->kind == OPTION_NUMBER && row->low > -1e5) {
        snprintf(out, size, "%g or more", row->low);
    }
}

/* The words with `between` them, and `last` before the last one. */
static void join(char *out, size_t size, const char *const *words, const char *between, const char *last)
{
    size_t n = 0;
    out[0] = '\0';
    for (int i = 0; words[i] != NULL && n < size; ++i) {
        const char *before = i == 0 ? "" : words[i + 1] == NULL ? last : between;
        n += (size_t)snprintf(out + n, size - n, "%s%s", before, words[i]);
    }
}

void options_wants(char *out, size_t size, const option_row *row)
{
    char range[96];
    range_of(range, sizeof range, row);
    if (row->expects != NULL) {
        snprintf(out, size, "%s", row->expects);
    } else if (row->kind == OPTION_WORD) {
        join(out, size, row->words, ", ", " or ");
    } else if (row->kind == OPTION_BACKEND) {
        snprintf(out, size, "one of %s", backends);
    } else if (row->kind == OPTION_LIGHT) {
        snprintf(out, size, "%sspot|point|sun:PX,PY,PZ:DX,DY,DZ:R,G,B[:INNER,OUTER]%s with angles up to 89",
                 row->nones > 0 ? "none or " : "", row->sizes > 0 ? "[:SIZE]" : "");
    } else if (row->kind == OPTION_TEXT) {
        snprintf(out, size, "text of a character or more");
    } else if (row->kind >= OPTION_INT && row->kind <= OPTION_MULTIPLE_OF_8) {
        snprintf(out, size, "%s%s", row->kind == OPTION_INT ? "a whole number, " : "", range);
    } else if (row->kind == OPTION_NUMBER || row->kind == OPTION_ABOVE) {
        snprintf(out, size, "a number%s%s", range[0] != '\0' ? ", " : "", range);
    } else {
        snprintf(out, size, "%s", row->kind == OPTION_POINT ? "X,Y,Z" : row->value);
    }
}

/* --- folded text -------------------------------------------------------------------------------------------------- */

/* Wraps words at WIDTH and starts new lines at `column`; the first line starts at `at`. Keeps line breaks in the
 * text. */
static void fold(FILE *out, const char *text, int at, int column)
{
    while (*text != '\0') {
        int n = (int)strcspn(text, " \n");
        n += text[n] == ' ' && text[n + 1] == '%' ? 1 + (int)strcspn(text + n + 1, " \n") : 0; /* keeps "5 %" whole */
        if (at > column && at + n + 1 > WIDTH) {
            at = column;
            fprintf(out, "\n%*s", column, "");
        } else if (at > column) {
            fputc(' ', out);
            ++at;
        }
        fprintf(out, "%.*s", n, text);
        at += n;
        text += n;
        if (*text == '\n') {
            at = column;
            fprintf(out, "\n%*s", text[1] == '\n' ? 0 : column, "");
        }
        text += *text != '\0';
    }
    fputc('\n', out);
}

static void print_title(FILE *out, const char *title)
{
    fputc('\n', out);
    fold(out, title, 0, 0);
}

void options_value(char *out, size_t size, const option_row *row)
{
    out[0] = '\0';
    if (row->value != NULL) {
        snprintf(out, size, "%s", row->value);
    } else if (row->kind == OPTION_WORD) {
        join(out, size, row->words, "|", "|");
    } else if (row->kind == OPTION_POINT) {
        snprintf(out, size, "X,Y,Z");
    } else if (row->kind == OPTION_LIGHT) {
        snprintf(out, size, "KIND:PX,PY,PZ:DX,DY,DZ:R,G,B[:INNER,OUTER]%s%s", row->sizes > 0 ? "[:SIZE]" : "",
                 row->nones > 0 ? "|none" : "");
    }
}

/* Prints "-h, --help", "--show full|direct|...", or "block=1|2|..." for a key; returns the width, or WIDTH if a list is
 * too long for a line. */
static int print_name(FILE *out, const option_row *row)
{
    char value[256];
    options_value(value, sizeof value, row);
    const char *key = options_key(row);
    const int begin = key != NULL ? fprintf(out, "%*s%s=", 2 * INDENT, "", key)
                                  : fprintf(out, "%*s%s%s%s%s", INDENT, "", row->brief != NULL ? row->brief : "",
                                            row->brief != NULL ? ", " : "", row->name, value[0] != '\0' ? " " : "");
    int at = begin, is_folded = 0;
    for (const char *text = value; *text != '\0';) {
        const int n = (int)strcspn(text, "|") + (strchr(text, '|') != NULL);
        if (at > begin && at + n > WIDTH) {
            at = fprintf(out, "\n%*s", begin, "") - 1;
            is_folded = 1;
        }
        at += fprintf(out, "%.*s", n, text);
        text += n;
    }
    return is_folded ? WIDTH : at;
}

void options_text(char *out, size_t size, const option_row *row)
{
    char range[96];
    range_of(range, sizeof range, row);
    int n = snprintf(out, size, range[0] != '\0' ? "%s [%s]" : "%s%s", row->help, range);
    if (row->times > 1 && n >= 0 && (size_t)n < size) {
        n += snprintf(out + n, size - (size_t)n, " [up to %d times]", (int)row->times);
    }
    if (row->kind == OPTION_WORD && row->value != NULL && n >= 0 && (size_t)n < size) {
        char words[256];
        join(words, sizeof words, row->words, ", ", " or ");
        n += snprintf(out + n, size - (size_t)n, ": %s", words);
    }
    if (row->kind == OPTION_BACKEND && n >= 0 && (size_t)n < size) {
        snprintf(out + n, size - (size_t)n, ": %s", backends);
    }
}

static void print_row(FILE *out, const option_row *row)
{
    char text[2048];
    int at = print_name(out, row);
    if (at + 1 >= COLUMN) {
        fputc('\n', out);
        at = 0;
    }
    fprintf(out, "%*s", COLUMN - at, "");
    options_text(text, sizeof text, row);
    fold(out, text, COLUMN, COLUMN);
}

const char *options_status(const option_table *t)
{
    return t->status != NULL ? t->status : "exit status: 0 done, 1 a file that cannot be read or written, 2 bad usage, "
                                           "also one file for two purposes";
}

void options_help(FILE *out, const option_table *t)
{
    const option_row *row;
    for (const char *line = t->usage, *end; *line != '\0'; line = *end != '\0' ? end + 1 : end) {
        end = line + strcspn(line, "\n");
        fprintf(out, "%s%s %.*s\n", line == t->usage ? "usage: " : "       ", command_name(""), (int)(end - line),
                line);
    }
    fputc('\n', out);
    fold(out, t->about, 0, 0);
    if (options_row(t, 0) != NULL && options_row(t, 0)->kind != OPTION_TITLE) {
        print_title(out, "options");
    }
    for (int i = 0; (row = options_row(t, i)) != NULL; ++i) {
        if (row->kind == OPTION_TITLE) {
            print_title(out, row->help);
        } else {
            print_row(out, row);
        }
    }
    print_title(out, "examples");
    fputs(t->examples, out);
    fputc('\n', out);
    fold(out, options_status(t), 0, 0);
}
