/* bench_options.c: the command line of a sweep: options of the sweep, and others for the subject. */
#include "bench_options.h"

#include <stdio.h>
#include <string.h>

#include "../common/options.h"
#include "../common/slice.h"

static int parse_out(const char *text, void *at)
{
    bench_options *o = at;
    static const char *const endings[3] = {"html", "csv", "json"};
    const char **const files[3] = {&o->html, &o->csv, &o->json};
    int n = 0;
    o->out = text;
    for (int i = 0; i < 3; ++i) {
        n = snprintf(o->names[i], sizeof o->names[i], "%s.%s", text, endings[i]);
        *files[i] = o->names[i];
    }
    return text[0] != '\0' && n > 0 && (size_t)n < sizeof o->names[0];
}

static int parse_sweep(const char *text, void *at)
{
    bench_options *o = at;
    bench_range *s = &o->range[o->ranges];
    const char *values = strchr(text, '=');
    while (*text == '-') {
        ++text;
    }
    if (o->ranges == BENCH_SWEEPS || values == NULL || values <= text || values - text > 30 ||
        strlen(values) >= sizeof s->text || strchr(values, ' ') != NULL) {
        return 0;
    }
    snprintf(s->name, sizeof s->name, "--%.*s", (int)(values - text), text);
    snprintf(s->text, sizeof s->text, "%s", values + 1);
    for (char *v = s->text; s->count < BENCH_VALUES && *v != '\0';) {
        const size_t n = strcspn(v, ",");
        const int more = v[n] == ',';
        s->value[s->count++] = v;
        v[n] = '\0';
        if (n == 0 || (more && v[n + 1] == '\0')) {
            return 0;
        }
        v += n + (size_t)more;
    }
    ++o->ranges;
    return s->count > 0 && s->count < BENCH_VALUES;
}

#define AT(member) .at = offsetof(bench_options, member)

static const option_row sweep_rows[] = {
    {.kind = OPTION_TITLE, .help = "sweep"},
    {.name = "--sweep", .value = "NAME=V,V,...", .kind = OPTION_OWN, .times = BENCH_SWEEPS, .parse = parse_sweep,
     .expects = "NAME=V,V,... with up to 63 values",
     .help = "instead of the usual settings: this option of the verb with each value; if you give several, all "
             "combinations"},
    {.name = "--runs", .value = "N", .kind = OPTION_INT, AT(runs), .low = 1, .high = 1000,
     .help = "runs of a setting, of which the shortest time counts, stage by stage (default 3, after one that warms "
             "up; no further one once 3 s have passed)"},
    {.name = "--truth", .value = "FILE.pfm", .kind = OPTION_TEXT, AT(truth), .file = OPTION_READS,
     .help = "errors against this picture (default: against the most exact settings)"},
    OPTION_SLICE_ROW(bench_options, slice, "settings"),
    {.kind = OPTION_END},
};

/* Of a subject with stages that can be made exact. */
static const option_row truth_rows[] = {
    {.kind = OPTION_TITLE, .help = "truth"},
    {.name = "--cache", .value = "FOLDER", .kind = OPTION_TEXT, AT(cache),
     .help = "folder for a scene's own truth, by the scene's content and the settings, because it takes minutes "
             "(default: $XDG_CACHE_HOME/lambent or ~/.cache/lambent)"},
    {.name = "--breakdown", .value = "N", .kind = OPTION_INT, AT(breakdown), .low = 0, .high = 64,
     .help = "the error breakdown, which is nearly brute force, uses one band of 8 rows in N (default 4); 0: no "
             "breakdown. It makes one stage after another exact: the squared error of that step is the stage's "
             "share; the interaction is the error that stages hide or add to each other's"},
    {.kind = OPTION_END},
};

static const option_row output_rows[] = {
    {.kind = OPTION_TITLE, .help = "output"},
    {.name = "-o", .value = "NAME", .kind = OPTION_OWN, .parse = parse_out,
     .expects = "a name that .html, .csv and .json are put behind",
     .help = "NAME.html, NAME.csv and NAME.json"},
    {.name = "--html", .value = "FILE.html", .kind = OPTION_TEXT, AT(html), .file = OPTION_WRITES,
     .help = "self-contained: the front of speed against error with its knee, cost and gain of each option, "
             "pictures and heat maps, memory, and the command line of each setting"},
    {.name = "--csv", .value = "FILE.csv", .kind = OPTION_TEXT, AT(csv), .file = OPTION_WRITES, .help = "one line "
             "per setting"},
    {.name = "--json", .value = "FILE.json", .kind = OPTION_TEXT, AT(json), .file = OPTION_WRITES,
     .help = "all figures"},
    {.name = "--svg", .value = "FILE.svg", .kind = OPTION_TEXT, AT(svg), .file = OPTION_WRITES, .help = "only the "
             "front"},
    {.name = "--quiet", .brief = "-q", .kind = OPTION_QUIET, AT(is_quiet), .help = "no table and no progress"},
    {.name = "--verbose", .brief = "-v", .kind = OPTION_VERBOSE, AT(is_verbose),
     .help = "print each setting's command before it is measured"},
    OPTION_ONLY_HERE,
    OPTION_TIME_LIMIT,
    OPTION_ASK,
    {.kind = OPTION_TITLE,
     .help = "A setting is on the front if no other is both faster and nearer to the truth. Beyond the knee, more time "
             "hardly pays. Time is the processor's on one thread; a setting with more threads is timed by the clock. "
             "Everything else on the command line goes to the verb unchanged."},
    {.kind = OPTION_END},
};

void bench_options_table(option_table *out, const bench_subject *subject)
{
    int n = 0;
    memset(out, 0, sizeof *out);
    out->verb = "";
    out->usage = subject->usage;
    out->about = subject->about;
    out->examples = subject->examples;
    out->part[n++] = sweep_rows;
    if (subject->exact != NULL) {
        out->part[n++] = truth_rows;
    }
    out->part[n] = output_rows;
}

/* Does `list` contain the word, with spaces around it? */
static int is_listed(const char *list, const char *word)
{
    const size_t n = strlen(word);
    for (const char *at = list; (at = strstr(at, word)) != NULL; ++at) {
        if (at > list && at[-1] == ' ' && at[n] == ' ') {
            return 1;
        }
    }
    return 0;
}

/* Words of the command line: the sweep's, and the verb's. */
typedef struct halves {
    char *own[BENCH_ARGS];
    int own_count;
} halves;

/* Assigns an option with its value to the sweep or the verb, whichever has it; other words go to the verb. */
static int take(halves *h, bench_options *o, const option_table *own, int *at, int argc, char **argv, report *r)
{
    const option_table *const both[] = {own, o->subject->table};
    char *word = argv[*at];
    const int is_option = word[0] == '-' && word[1] != '\0';
    const option_row *mine = is_option ? options_find(own, word) : NULL;
    const option_row *row = mine == NULL && is_option ? options_find(o->subject->table, word) : mine;
    if (is_option && row == NULL) {
        return options_unknown(both, 2, word, r);
    }
    if (row != NULL && mine == NULL && is_listed(o->subject->refused, row->name)) {
        return report_fail(r, "%s means nothing to a sweep; see --help", row->name);
    }
    const int words = row != NULL ? options_words(row, word) : 1;
    if (mine == NULL && *at + words > argc) {
        return report_fail(r, "%s: its value is missing", row->name);
    }
    if (o->given_count + words > BENCH_ARGS / 2 || h->own_count + words > BENCH_ARGS) {
        return report_fail(r, "too many options; at most %d words", BENCH_ARGS / 2);
    }
    for (int i = 0; i < words && *at < argc; ++i, ++*at) {
        if (mine != NULL) {
            h->own[h->own_count++] = argv[*at];
        } else {
            o->given[o->given_count++] = argv[*at];
        }
    }
    --*at;
    return 1;
}

/* Checks that options of the verb are given only once. A bench_line would use the last one. */
static int once(const bench_options *o, report *r)
{
    for (int i = 0; i < o->given_count; ++i) {
        const option_row *row = o->given[i][0] == '-' ? options_find(o->subject->table, o->given[i]) : NULL;
        const int words = row != NULL ? options_words(row, o->given[i]) : 1;
        for (int k = i + words; row != NULL && row->times <= 1 && k < o->given_count; ++k) {
            if (o->given[k][0] == '-' && options_find(o->subject->table, o->given[k]) == row) {
                return report_fail(r, "%s is given twice; leave one out", row->name);
            }
        }
        i += words - 1;
    }
    return 1;
}

/* A slice needs -o and no other output, and has no breakdowns, because these need the front of all settings. */
static int check_slice(bench_options *o, report *r)
{
    if (o->slice.count == 0) {
        return 1;
    }
    if (o->out == NULL || o->html != o->names[0] || o->csv != o->names[1] || o->json != o->names[2] || o->svg != NULL) {
        return report_fail(
            r, "--slice: give -o NAME and no other output; `lambent-bench merge` writes .csv, .json, .html, .svg");
    }
    o->html = o->csv = o->json = NULL;
    o->breakdown = 0;
    return 1;
}

int bench_options_parse(bench_options *o, const bench_subject *subject, int argc, char **argv, report *r)
{
    static char verb[] = "bench";
    halves h = {{verb}, 1};
    option_table own;
    memset(o, 0, sizeof *o);
    o->subject = subject;
    o->runs = 3;
    o->breakdown = 4;
    bench_options_table(&own, subject);
    for (int i = 0; i < argc; ++i) {
        if (!take(&h, o, &own, &i, argc, argv, r)) {
            return OPTIONS_BAD;
        }
    }
    const int asked = options_parse(o, &own, h.own_count, h.own, r);
    return asked == OPTIONS_RUN && !(once(o, r) && check_slice(o, r)) ? OPTIONS_BAD : asked;
}

int bench_options_line(bench_line *l, const bench_options *o, const image *like, report *r)
{
    const bench_subject *s = o->subject;
    char size[64] = "";
    memset(l, 0, sizeof *l);
    l->table = s->table;
    if (like != NULL && s->size != NULL) {
        snprintf(size, sizeof size, s->size, (int)like->width, (int)like->height);
    } else if (s->usual_size != NULL) {
        snprintf(size, sizeof size, "%s", s->usual_size);
    }
    int ok = bench_line_add(l, s->verb) && bench_line_add(l, size);
    for (int i = 0; i < o->given_count && ok; ++i) {
        ok = bench_line_put(l, o->given[i]);
    }
    ok = ok && (s->output == NULL || bench_line_add(l, s->output));
    return ok || report_fail(r, "too many options");
}
