/* options.c: parses command lines with the option table of a verb. options_help.c prints the help. */
#include "options.h"

#include <stdlib.h>
#include <string.h>

#include <lambent/lambent.h>

#include "command_name.h"
#include "io_file.h"
#include "option_value.h"
#include "options_table.h"

/* --- rows --------------------------------------------------------------------------------------------------------- */

/* Returns whether the word is this name, optionally followed by `=value`. */
static int names(const char *name, const char *word)
{
    const size_t n = name != NULL ? strlen(name) : 0;
    return n > 0 && strncmp(name, word, n) == 0 && (word[n] == '\0' || (word[n] == '=' && name[1] == '-'));
}

static int is_option(const option_row *row) { return row->name != NULL && row->name[0] == '-'; }

/* Returns the row, or -1. A row of a key is not found, because `--group=block` is no spelling of `--group block`. */
static int find(const option_table *t, const char *word)
{
    const option_row *row;
    for (int i = 0; (row = options_row(t, i)) != NULL; ++i) {
        if (is_option(row) && options_key(row) == NULL && (names(row->name, word) || names(row->brief, word))) {
            return i;
        }
    }
    return -1;
}

const option_row *options_find(const option_table *t, const char *word) { return options_row(t, find(t, word)); }

int options_words(const option_row *row, const char *word)
{
    return options_has_value(row) && strchr(word, '=') == NULL ? 2 : 1;
}

int options_exclude(const option_row *a, const option_row *b)
{
    if (a->kind == OPTION_QUIET || b->kind == OPTION_QUIET) {
        return a->kind == OPTION_VERBOSE || b->kind == OPTION_VERBOSE;
    }
    return a != b && a->at == b->at && options_has_value(a) && a->kind != OPTION_OWN && b->kind == a->kind;
}

/* --- names that nobody knows -------------------------------------------------------------------------------------- */

enum { LETTERS = 40 };

static int min(int a, int b) { return a < b ? a : b; }

int options_distance(const char *a, const char *b)
{
    int row[3][LETTERS + 1]; /* for the letters of `a` so far, and for one and two fewer */
    const int n = (int)strlen(a), m = (int)strlen(b);
    if (n > LETTERS || m > LETTERS) {
        return LETTERS + 1;
    }
    for (int k = 0; k <= m; ++k) {
        row[0][k] = k;
    }
    for (int i = 1; i <= n; ++i) {
        int *now = row[i % 3];
        const int *before = row[(i - 1) % 3], *two_before = row[(i + 1) % 3];
        now[0] = i;
        for (int k = 1; k <= m; ++k) {
            now[k] = min(before[k - 1] + (a[i - 1] != b[k - 1]), min(before[k], now[k - 1]) + 1);
            if (i > 1 && k > 1 && a[i - 1] == b[k - 2] && a[i - 2] == b[k - 1]) {
                now[k] = min(now[k], two_before[k - 2] + 1);
            }
        }
    }
    return row[n % 3][m];
}

/* The most similar name so far, and the number of letters that may differ. */
typedef struct likeness {
    const char *word, *found;
    int letters;
} likeness;

/* A third of the letters may differ, but at least one. */
static likeness likeness_of(const char *word)
{
    const int n = (int)strlen(word);
    const likeness l = {word, NULL, n > 5 ? (n - 2) / 3 : 1};
    return l;
}

/* The word may also be a prefix of the name. */
static void try_name(likeness *l, const char *name)
{
    if (name[0] >= '0' && name[0] <= '9') {
        return; /* 3 is not 4 misspelt */
    }
    const size_t n = strlen(l->word);
    const int begun = n > 4 && strncmp(name, l->word, n) == 0;
    const int far = begun ? 0 : options_distance(l->word, name);
    if (far < l->letters || (far == l->letters && l->found == NULL)) {
        l->letters = far;
        l->found = name;
    }
}

const char *options_nearest(const char *const *names, const char *word)
{
    likeness l = likeness_of(word);
    for (int i = 0; names[i] != NULL; ++i) {
        try_name(&l, names[i]);
    }
    return l.found;
}

static const char *nearest_option(const option_table *const *tables, int count, const char *word)
{
    likeness l = likeness_of(word);
    for (int k = 0; k < count; ++k) {
        const option_row *row;
        for (int i = 0; (row = options_row(tables[k], i)) != NULL; ++i) {
            if (is_option(row) && options_key(row) == NULL) {
                try_name(&l, row->name);
            }
        }
    }
    return l.found;
}

/* The row of a key that somebody gave as an option: `--block` for `--group block=`, `--group-block` too; else NULL. */
static const option_row *find_as_option(const option_table *t, const char *name)
{
    const option_row *row;
    for (int i = 0; (row = options_row(t, i)) != NULL; ++i) {
        const char *key = options_key(row);
        const size_t n = key != NULL ? (size_t)(key - row->name) : 0;
        if (n > 0 && name[0] == '-' && name[1] == '-' &&
            (strcmp(name + 2, key) == 0 ||
             (strncmp(name, row->name, n - 1) == 0 && name[n - 1] == '-' && strcmp(name + n, key) == 0))) {
            return row;
        }
    }
    return NULL;
}

int options_unknown(const option_table *const *tables, int count, const char *word, report *r)
{
    char name[LETTERS + 1];
    const size_t n = strcspn(word, "=");
    memcpy(name, word, n < LETTERS ? n : LETTERS);
    name[n < LETTERS ? n : LETTERS] = '\0';
    for (int k = 0; k < count; ++k) {
        const option_row *row = options_find(tables[k], name);
        if (row != NULL) { /* -o=x: one letter */
            return options_has_value(row) ? report_fail(r, "%s: write `%s %s`", word, name, word + n + 1)
                                          : report_fail(r, "%s takes no value: %s", name, word);
        }
    }
    for (int k = 0; k < count; ++k) {
        const option_row *row = find_as_option(tables[k], name);
        if (row != NULL) {
            return report_fail(r, "unknown option %s; did you mean %s=...?", name, row->name);
        }
    }
    const char *meant = nearest_option(tables, count, name);
    if (meant != NULL) {
        return report_fail(r, "unknown option %s; did you mean %s?", name, meant);
    }
    return report_fail(r, "unknown option %s; %s --help lists them", name, command_name(tables[0]->verb));
}

/* --- values ------------------------------------------------------------------------------------------------------- */

static int store_int(const option_row *row, const char *text, int32_t *at)
{
    if (!option_int(text, (int32_t)row->low, (int32_t)row->high, at)) {
        return 0;
    }
    return row->kind == OPTION_POWER_OF_2 ? (*at & (*at - 1)) == 0 : row->kind == OPTION_INT || *at % 8 == 0;
}

static int store_floats(const option_row *row, const char *text, float *at)
{
    const int count = row->kind == OPTION_NUMBERS ? (int)row->size : 1;
    int ok = option_floats(&text, at, count) && *text == '\0';
    for (int i = 0; i < count && ok; ++i) {
        ok = at[i] <= (float)row->high &&
             (row->kind == OPTION_ABOVE ? at[i] > (float)row->low : at[i] >= (float)row->low);
    }
    return ok;
}

static int (*limit_by)(double seconds);

void options_limit_by(int (*limit)(double seconds)) { limit_by = limit; }

int options_time_limit(const char *text, void *at)
{
    float seconds;
    (void)at;
    return option_number(text, 0.0f, 1e7f, &seconds) && seconds > 0.0f &&
           (limit_by == NULL || limit_by((double)seconds));
}

int options_only_here(const char *text, void *at)
{
    (void)text;
    (void)at;
    file_only_here();
    return 1;
}

/* Returns 1, or 0 if the text is invalid for this row. */
static int store(const option_row *row, const char *text, void *at, float *size)
{
    switch (row->kind) {
    case OPTION_TEXT: return (*(const char **)at = text)[0] != '\0';
    case OPTION_INT:
    case OPTION_POWER_OF_2:
    case OPTION_MULTIPLE_OF_8: return store_int(row, text, at);
    case OPTION_NUMBER:
    case OPTION_ABOVE:
    case OPTION_NUMBERS: return store_floats(row, text, at);
    case OPTION_WORD: return option_word(text, row->words, row->values, at);
    case OPTION_POINT: return option_vec3(text, at);
    case OPTION_LIGHT: return option_light(text, at, size) == NULL;
    case OPTION_BACKEND: return (*(const lmb_kernels **)at = lmb_kernels_named(text)) != NULL;
    default: return row->parse(text, at);
    }
}

/* --- command lines ------------------------------------------------------------------------------------------------ */

typedef struct line {
    void *out;
    const option_table *table;
    char *const *argv;
    int argc, at;
    int32_t given[OPTION_ROWS]; /* occurrences by row */
    const char *first[OPTION_ROWS]; /* the first value */
    char text[1024];            /* values of keys, each ending with 0 */
    size_t used;                /* bytes of `text` */
} line;

/* The wrong part of a value with several; "": unknown. */
static const char *wrong_part(const option_row *row, const char *value)
{
    lmb_light light;
    float size;
    const char *part = row->kind == OPTION_LIGHT ? option_light(value, &light, row->sizes > 0 ? &size : NULL) : NULL;
    return part != NULL ? part : "";
}

/* Returns whether the value is a number of the row's kind, but out of range. */
static int is_beyond(const option_row *row, const char *value)
{
    const int is_int = row->kind >= OPTION_INT && row->kind <= OPTION_MULTIPLE_OF_8;
    char *end;
    const double v = is_int ? (double)strtol(value, &end, 10) : strtod(value, &end);
    return (is_int || row->kind == OPTION_NUMBER || row->kind == OPTION_ABOVE) && end != value && *end == '\0' &&
           (v < row->low || v > row->high || (row->kind == OPTION_ABOVE && v <= row->low));
}

static int refuse(const option_row *row, const char *value, report *r)
{
    for (int i = 0; row->gone != NULL && row->gone[i] != NULL; i += 2) {
        if (strcmp(value, row->gone[i]) == 0) {
            return report_fail(r, "%s: `%s` was removed; use %s", row->name, value, row->gone[i + 1]);
        }
    }
    const char *part = wrong_part(row, value);
    const char *meant = row->kind == OPTION_WORD ? options_nearest(row->words, value) : NULL;
    char expects[320];
    options_wants(expects, sizeof expects, row);
    if (is_beyond(row, value)) {
        return report_fail(r, "%s: `%s` is out of range; give %s", row->name, value, expects);
    }
    return meant != NULL ? report_fail(r, "%s: `%s` is not %s; did you mean %s?", row->name, value, expects, meant)
                         : report_fail(r, "%s: `%s` is not %s%s%s%s", row->name, value, expects,
                                       part[0] != '\0' ? ": its " : "", part, part[0] != '\0' ? " is wrong" : "");
}

/* Stores `value` after those that the row already has. */
static int take(line *l, int i, const char *value, report *r)
{
    const option_row *row = options_row(l->table, i);
    const int32_t times = row->times > 0 ? row->times : 1, before = l->given[i];
    if (before >= times) {
        return times > 1 ? report_fail(r, "%s is given over %d times; leave some out", row->name, (int)times)
               : value[0] != '\0'
                   ? report_fail(r, "%s is given twice, %s and %s; leave one out", row->name, l->first[i], value)
                   : report_fail(r, "%s is given twice; leave one out", row->name);
    }
    l->given[i] = before + 1;
    l->first[i] = before == 0 ? value : l->first[i];
    char *at = (char *)l->out + row->at + (times > 1 ? (size_t)before * row->size : 0);
    if (row->nones > 0 && strcmp(value, "none") == 0) {
        *(int *)(void *)((char *)l->out + row->nones) = 1;
        return 1;
    }
    if (options_has_value(row)) {
        float *size = row->sizes > 0 ? (float *)(void *)((char *)l->out + row->sizes) + before : NULL;
        if (!store(row, value, at, size)) {
            return refuse(row, value, r);
        }
    } else if (row->parse != NULL) {
        row->parse(value, at);
    } else {
        *(int *)(void *)at = 1;
    }
    if (row->counts > 0) {
        *(int32_t *)(void *)((char *)l->out + row->counts) = before + 1;
    }
    return 1;
}

static int take_alone(line *l, int i, const char *value, report *r)
{
    const option_row *row = options_row(l->table, i), *other;
    for (int k = 0; (other = options_row(l->table, k)) != NULL; ++k) {
        if (k != i && l->given[k] > 0 && options_exclude(row, other)) {
            return report_fail(r, "%s and %s exclude each other; leave one out", other->name, row->name);
        }
    }
    return take(l, i, value, r);
}

#if !defined(OPTIONS_WITHOUT_HELP) /* the web page gives no keys */

/* Returns the row of a key of that option, or -1. */
static int find_key(const option_table *t, const option_row *option, const char *key, size_t size)
{
    const size_t n = strlen(option->name);
    const option_row *row;
    for (int i = 0; (row = options_row(t, i)) != NULL; ++i) {
        const char *own = options_key(row);
        if (own != NULL && own == row->name + n + 1 && strncmp(row->name, option->name, n) == 0 &&
            strlen(own) == size && memcmp(own, key, size) == 0) {
            return i;
        }
    }
    return -1;
}

static int refuse_key(const line *l, const option_row *option, const char *key, report *r)
{
    const char *names[OPTION_ROWS + 1];
    const size_t n = strlen(option->name);
    const option_row *row;
    int count = 0;
    for (int i = 0; (row = options_row(l->table, i)) != NULL; ++i) {
        const char *own = options_key(row);
        if (own != NULL && own == row->name + n + 1 && strncmp(row->name, option->name, n) == 0) {
            names[count++] = own;
        }
    }
    names[count] = NULL;
    const char *meant = options_nearest(names, key);
    return report_fail(r, "%s: `%s` is no key%s%s%s; %s --help lists them", option->name, key,
                       meant != NULL ? ", did you mean " : "", meant != NULL ? meant : "", meant != NULL ? "?" : "",
                       command_name(l->table->verb));
}

/* Stores each KEY=VALUE of a list. */
static int take_keys(line *l, const option_row *option, const char *list, report *r)
{
    const size_t size = strlen(list) + 1;
    if (size > sizeof l->text - l->used) {
        return report_fail(r, "%s: the list is too long", option->name);
    }
    char *key = memcpy(l->text + l->used, list, size);
    l->used += size;
    for (char *next; key != NULL; key = next) {
        next = strchr(key, ',');
        if (next != NULL) {
            *next++ = '\0';
        }
        char *value = strchr(key, '=');
        const int i = find_key(l->table, option, key, value != NULL ? (size_t)(value - key) : strlen(key));
        if (value != NULL) {
            *value++ = '\0';
        }
        if (i < 0) {
            return refuse_key(l, option, key, r);
        }
        if (value == NULL || value[0] == '\0') {
            char expects[320];
            options_wants(expects, sizeof expects, options_row(l->table, i));
            return report_fail(r, "%s=VALUE wants a value: %s", options_row(l->table, i)->name, expects);
        }
        if (!take_alone(l, i, value, r)) {
            return 0;
        }
    }
    return 1;
}

static int take_value(line *l, int i, const char *value, report *r)
{
    const option_row *row = options_row(l->table, i);
    return row->kind == OPTION_KEYS ? take_keys(l, row, value, r) : take_alone(l, i, value, r);
}

#else

static int take_value(line *l, int i, const char *value, report *r) { return take_alone(l, i, value, r); }

#endif

static int take_option(line *l, report *r)
{
    const char *word = l->argv[l->at], *inside = strchr(word, '=');
    const int i = find(l->table, word);
    if (i < 0) {
        return options_unknown(&l->table, 1, word, r);
    }
    const option_row *row = options_row(l->table, i);
    if (!options_has_value(row)) {
        return inside == NULL ? take_alone(l, i, "", r) : report_fail(r, "%s takes no value: %s", row->name, word);
    }
    if (inside != NULL) {
        return take_value(l, i, inside + 1, r);
    }
    if (l->at + 1 == l->argc) {
        char expects[320];
        options_wants(expects, sizeof expects, row);
        return report_fail(r, "%s wants a value: %s", row->name, expects);
    }
    return take_value(l, i, l->argv[++l->at], r);
}

/* A positional argument goes to the first such row with room. */
static int take_word(line *l, report *r)
{
    const char *word = l->argv[l->at];
    const option_row *row;
    int last = -1;
    for (int i = 0; (row = options_row(l->table, i)) != NULL; ++i) {
        if (row->name == NULL || is_option(row)) {
            continue;
        }
        if (l->given[i] < (row->times > 0 ? row->times : 1)) {
            return take(l, i, word, r);
        }
        last = i;
    }
    return last < 0 ? report_fail(r, "`%s` is no option; %s --help lists them", word, command_name(l->table->verb))
                    : report_fail(r, "`%s` is one word too many: %s is `%s`", word, options_row(l->table, last)->name,
                                  l->first[last]);
}

int options_parse(void *out, const option_table *t, int argc, char **argv, report *r)
{
    line l;
    int ended = 0;
    memset(&l, 0, sizeof l);
    l.out = out;
    l.table = t;
    l.argv = argv;
    l.argc = argc;
    for (l.at = 1; l.at < argc; ++l.at) {
        const char *word = argv[l.at];
        const option_row *row = ended ? NULL : options_find(t, word);
        if (!ended && strcmp(word, "--") == 0) {
            ended = 1;
        } else if (row != NULL && (row->kind == OPTION_HELP || row->kind == OPTION_VERSION)) {
            return row->kind == OPTION_HELP ? OPTIONS_ASK_HELP : OPTIONS_ASK_VERSION;
        } else if (!(!ended && word[0] == '-' && word[1] != '\0' ? take_option : take_word)(&l, r)) {
            return OPTIONS_BAD;
        }
    }
    return OPTIONS_RUN;
}

static int is_man_page;

void options_form(int is_man) { is_man_page = is_man; }

int options_answer_to(FILE *out, FILE *err, int asked, const option_table *t, const report *r)
{
    if (asked == OPTIONS_BAD) {
        fprintf(err, "%s: %s\n", command_name(t->verb), r->text);
        return 2;
    }
#if !defined(OPTIONS_WITHOUT_HELP)
    report written = {""};
    if (asked == OPTIONS_ASK_HELP) {
        (is_man_page ? options_man : options_help)(out, t);
    } else {
        options_version(out);
    }
    return report_flush_to(out, &written) ? 0 : report_end_to(err, &written, t->verb, 1);
#else
    options_version(out);
    return 0;
#endif
}

int options_answer(int asked, const option_table *t, const report *r)
{
    return options_answer_to(stdout, stderr, asked, t, r);
}

void options_version(FILE *out)
{
    fprintf(out, "%s %d.%d.%d\n", command_name(""), LMB_VERSION / 10000, LMB_VERSION / 100 % 100, LMB_VERSION % 100);
}
