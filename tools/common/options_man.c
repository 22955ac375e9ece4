/* options_man.c: prints a verb's table as a section of a man page. */
#include <string.h>

#include "command_name.h"
#include "options_table.h"

/* Escapes text: no character is a command, and a hyphen can be copied. `is_new`: at the beginning of a line. */
static void put(FILE *out, const char *text, size_t size, int is_new)
{
    for (size_t i = 0; i < size; ++i) {
        const char c = text[i];
        if (is_new && (c == '.' || c == '\'')) {
            fputs("\\&", out);
        }
        is_new = c == '\n';
        if (c == '\\') {
            fputs("\\e", out);
        } else if (c == '-') {
            fputs("\\-", out);
        } else if (c == '\'') {
            fputs("\\(aq", out);
        } else if (c == '`') {
            fputs("\\(ga", out);
        } else if (c == '^' || c == '~') {
            fputs(c == '^' ? "\\(ha" : "\\(ti", out);
        } else {
            fputc(c, out);
        }
    }
}

static void put_upper(FILE *out, const char *text)
{
    for (; *text != '\0'; ++text) {
        const char c = *text >= 'a' && *text <= 'z' ? (char)(*text - 'a' + 'A') : *text;
        put(out, &c, 1, 0);
    }
}

/* Keeps line breaks of the text. */
static void put_lines(FILE *out, const char *text)
{
    while (*text != '\0') {
        const size_t n = strcspn(text, "\n");
        put(out, text, n, 1);
        fputs(text[n] == '\n' ? "\n.br\n" : "\n", out);
        text += n + (text[n] == '\n');
    }
}

static void put_row(FILE *out, const option_row *row)
{
    char value[256], text[2048];
    options_value(value, sizeof value, row);
    options_text(text, sizeof text, row);
    fputs(".TP\n\\fB", out);
    if (row->brief != NULL) {
        put(out, row->brief, strlen(row->brief), 0);
        fputs("\\fR, \\fB", out);
    }
    const char *key = options_key(row), *name = key != NULL ? key : row->name;
    put(out, name, strlen(name), 0);
    fputs(key != NULL ? "=\\fR" : "\\fR", out);
    if (value[0] != '\0') {
        fputs(key != NULL ? "\\fI" : " \\fI", out);
        put(out, value, strlen(value), 0);
        fputs("\\fR", out);
    }
    fputc('\n', out);
    put_lines(out, text);
}

void options_man(FILE *out, const option_table *t)
{
    const option_row *row;
    fputs(".SH ", out);
    put_upper(out, command_name(""));
    fputs(t->verb[0] != '\0' ? " " : "", out);
    put(out, t->verb, strlen(t->verb), 0);
    fputs("\n.nf\n", out);
    for (const char *line = t->usage; *line != '\0';) {
        const size_t n = strcspn(line, "\n");
        put(out, command_name(""), strlen(command_name("")), 0);
        fputc(' ', out);
        put(out, line, n, 0);
        fputc('\n', out);
        line += n + (line[n] == '\n');
    }
    fputs(".fi\n.PP\n", out);
    put_lines(out, t->about);
    for (int i = 0; (row = options_row(t, i)) != NULL; ++i) {
        if (row->kind == OPTION_TITLE) {
            fputs(".PP\n", out);
            put_lines(out, row->help);
        } else {
            put_row(out, row);
        }
    }
    fputs(".PP\nexamples\n.PP\n.nf\n", out);
    put(out, t->examples, strlen(t->examples), 1);
    fputs(".fi\n.PP\n", out);
    put_lines(out, options_status(t));
}
