/* bench_options.c: the command line of a sweep: its own options; what it does not know is the subject's. */
#include "bench_options.h"

#include <stdio.h>
#include <string.h>

#include "option_value.h"

const char bench_help[] =
    "sweep\n"
    "  --sweep NAME=V,V,...       instead of the usual settings: this option of the verb with each value; may be\n"
    "                             repeated, then each with each\n"
    "  --runs N                   runs of a setting, of which the least time counts, stage by stage (default 3, after\n"
    "                             one that warms up; no further one once 3 s have passed)\n"
    "  --truth FILE.pfm           errors against this picture (default: against its own most exact settings)\n"
    "output\n"
    "  -o NAME                    NAME.html, NAME.csv and NAME.json\n"
    "  --html FILE --csv FILE --json FILE --svg FILE\n"
    "                             each by itself. The HTML needs nothing else: the front of speed against error\n"
    "                             with its knee, what each option costs and buys, pictures and heat maps, memory,\n"
    "                             and the command line of each setting. CSV: a line a setting; JSON: all figures;\n"
    "                             SVG: the front alone\n"
    "\n"
    "A setting is on the front where no other is both faster and nearer to the truth. At the knee more time stops to\n"
    "pay. Time is the processor's on one thread; a setting with more threads is timed by what passes. Everything else\n"
    "on the command line goes to the verb, as it is.\n"
    "\n"
    "exit status: 0 done, 1 a file that cannot be read or written, 2 bad usage\n";

static int parse_file(const char **out, const char *text) { return (*out = text)[0] != '\0'; }
static int parse_html(const char *text, bench_options *o) { return parse_file(&o->html, text); }
static int parse_csv(const char *text, bench_options *o) { return parse_file(&o->csv, text); }
static int parse_json(const char *text, bench_options *o) { return parse_file(&o->json, text); }
static int parse_svg(const char *text, bench_options *o) { return parse_file(&o->svg, text); }
static int parse_truth(const char *text, bench_options *o) { return parse_file(&o->truth, text); }
static int parse_cache(const char *text, bench_options *o) { return parse_file(&o->cache, text); }
static int parse_runs(const char *text, bench_options *o) { return option_int(text, 1, 1000, &o->runs); }
static int parse_ledger(const char *text, bench_options *o) { return option_int(text, 0, 64, &o->ledger); }

static int parse_out(const char *text, bench_options *o)
{
    static const char *const endings[3] = {"html", "csv", "json"};
    const char **const files[3] = {&o->html, &o->csv, &o->json};
    int n = 0;
    for (int i = 0; i < 3; ++i) {
        n = snprintf(o->names[i], sizeof o->names[i], "%s.%s", text, endings[i]);
        *files[i] = o->names[i];
    }
    return text[0] != '\0' && n > 0 && (size_t)n < sizeof o->names[0];
}

static int parse_sweep(const char *text, bench_options *o)
{
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

static const struct flag {
    option_name of;
    int (*parse)(const char *text, bench_options *o);
} flags[] = {
    {{"-o", "a name that .html, .csv and .json are put behind"}, parse_out},
    {{"--html", "a file name"}, parse_html},
    {{"--csv", "a file name"}, parse_csv},
    {{"--json", "a file name"}, parse_json},
    {{"--svg", "a file name"}, parse_svg},
    {{"--truth", "a PFM file's name"}, parse_truth},
    {{"--cache", "a folder's name"}, parse_cache},
    {{"--sweep", "NAME=V,V,... with up to 63 values, up to 4 times"}, parse_sweep},
    {{"--runs", "1 .. 1000"}, parse_runs},
    {{"--ledger", "0 .. 64"}, parse_ledger},
};
enum { FLAGS = sizeof flags / sizeof *flags };

static int is_own(const char *word)
{
    int at = FLAGS - 1;
    while (at >= 0 && strcmp(flags[at].of.name, word) != 0) {
        --at;
    }
    return at >= 0;
}

/* Does `list` have the word, with spaces around? */
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

/* The subject's word, and its value behind it. */
static int give(bench_options *o, int *at, int argc, char **argv, report *r)
{
    const char *word = argv[*at];
    const int is_option = word[0] == '-' && word[1] != '\0';
    if (is_option && is_listed(o->subject->refused, word)) {
        return report_fail(r, "%s means nothing to a sweep; see --help", word);
    }
    const int words = is_option && !is_listed(o->subject->bare, word) ? 2 : 1;
    if (*at + words > argc) {
        return report_fail(r, "%s: its value is missing", word);
    }
    if (o->given_count + words > BENCH_ARGS / 2) {
        return report_fail(r, "too many options; at most %d words", BENCH_ARGS / 2);
    }
    for (int i = 0; i < words; ++i) {
        o->given[o->given_count++] = argv[(*at)++];
    }
    --*at;
    return 1;
}

int bench_options_parse(bench_options *o, const bench_subject *subject, int argc, char **argv, report *r)
{
    memset(o, 0, sizeof *o);
    o->subject = subject;
    o->runs = 3;
    o->ledger = 4;
    for (int i = 0; i < argc; ++i) {
        if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0) {
            return o->help = 1;
        }
        if (!is_own(argv[i])) {
            if (!give(o, &i, argc, argv, r)) {
                return 0;
            }
            continue;
        }
        const int f = option_find(flags, sizeof *flags, FLAGS, argv, i, r);
        if (f < 0 || (!flags[f].parse(argv[++i], o) && !option_refuse(&flags[f].of, argv[i], r))) {
            return 0;
        }
    }
    return 1;
}

int bench_options_line(bench_line *l, const bench_options *o, const image *like, report *r)
{
    const bench_subject *s = o->subject;
    char size[64] = "";
    memset(l, 0, sizeof *l);
    if (like != NULL && s->size != NULL) {
        snprintf(size, sizeof size, s->size, (int)like->width, (int)like->height);
    } else if (s->usual_size != NULL) {
        snprintf(size, sizeof size, "%s", s->usual_size);
    }
    int ok = bench_line_add(l, s->verb) && bench_line_add(l, size);
    for (int i = 0; i < o->given_count; ++i) {
        l->argv[l->argc++] = o->given[i];
    }
    ok = ok && (s->output == NULL || bench_line_add(l, s->output));
    return ok || report_fail(r, "too many options");
}
