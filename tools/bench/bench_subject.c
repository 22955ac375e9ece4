/* bench_subject.c: command lines of settings, and timing. */
#include "bench_subject.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/count.h"
#include "../../platform/host/host.h"
#include "../../platform/host/pool.h"

/* Fast settings are drawn more often: for this long per requested run, s. */
#define SHORT_S 0.03

/* The option that a word names, or NULL. */
static const option_row *named(const bench_line *l, const char *word)
{
    return l->table != NULL && word[0] == '-' ? options_find(l->table, word) : NULL;
}

/* Removes from the line an option that may be given once, and options that exclude it. */
static void drop(bench_line *l, const option_row *row)
{
    const int argc = l->argc;
    l->argc = 1;
    for (int i = 1; i < argc;) {
        const option_row *other = named(l, l->argv[i]);
        const int words = other != NULL ? options_words(other, l->argv[i]) : 1;
        const int goes = other != NULL && row->times <= 1 && (other == row || options_exclude(other, row));
        for (int k = 0; k < words && i < argc; ++k, ++i) {
            if (!goes) {
                l->argv[l->argc++] = l->argv[i];
            }
        }
    }
}

/* Is the next word the last one's value? */
static int wants_value(const bench_line *l)
{
    const option_row *row = NULL;
    int words = 1;
    for (int i = 1; i < l->argc; i += words) {
        row = named(l, l->argv[i]);
        words = row != NULL ? options_words(row, l->argv[i]) : 1;
        if (i + words > l->argc) {
            return 1;
        }
    }
    return 0;
}

int bench_line_put(bench_line *l, char *word)
{
    const option_row *row = l->argc > 0 && !wants_value(l) ? named(l, word) : NULL;
    if (row != NULL) {
        drop(l, row);
    }
    if (l->argc + 1 >= BENCH_ARGS) {
        return 0;
    }
    l->argv[l->argc++] = word;
    return 1;
}

int bench_line_add(bench_line *l, const char *text)
{
    while (*(text += strspn(text, " ")) != '\0') {
        const size_t n = strcspn(text, " ");
        if (l->used + n + 1 > sizeof l->words) {
            return 0;
        }
        char *word = l->words + l->used;
        memcpy(word, text, n);
        word[n] = '\0';
        l->used += n + 1;
        if (!bench_line_put(l, word)) {
            return 0;
        }
        text += n;
    }
    return 1;
}

int bench_line_with(bench_line *out, const bench_line *line, const char *text, report *r)
{
    memset(out, 0, sizeof *out);
    memcpy(out->argv, line->argv, sizeof out->argv);
    out->argc = line->argc;
    out->table = line->table;
    return bench_line_add(out, text) || report_fail(r, "too many options");
}

int bench_line_hurry(bench_line *l, const bench_subject *s)
{
    char words[64] = "";
    if (s->hurry != NULL) {
        snprintf(words, sizeof words, s->hurry, pool_processors());
    }
    return bench_line_add(l, words);
}

/* Puts a word into single quotes. Quotes inside the word are escaped outside the quotes. Returns bytes as snprintf
 * does, or `size`. */
static size_t say_quoted(char *out, size_t size, const char *word)
{
    size_t n = (size_t)snprintf(out, size, " '");
    for (; *word != '\0' && n < size; ++word) {
        n += (size_t)snprintf(out + n, size - n, *word == '\'' ? "'\\''" : "%c", *word);
    }
    return n < size ? n + (size_t)snprintf(out + n, size - n, "'") : size;
}

/* Quotes words that a shell would expand. */
void bench_line_say(char *out, size_t size, const bench_line *l)
{
    size_t n = (size_t)snprintf(out, size, "lambent");
    for (int i = 0; i < l->argc && n < size; ++i) {
        const char *word = l->argv[i];
        const int plain = word[0] != '\0' && strspn(word, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                                          "0123456789_-+=.,:/%@") == strlen(word);
        n += plain ? (size_t)snprintf(out + n, size - n, " %s", word) : say_quoted(out + n, size - n, word);
    }
}

void bench_shot_free(bench_shot *s)
{
    image_free(&s->picture);
    free(s->surface);
    memset(s, 0, sizeof *s);
}

/* Keeps the shorter times. The first run warms up, so the second run's times replace the first run's. */
static void keep_min(bench_shot *s, const double *stage_s, double instructions, int is_first)
{
    for (int i = 0; i < BENCH_STAGES; ++i) {
        s->stage_s[i] = is_first || stage_s[i] < s->stage_s[i] ? stage_s[i] : s->stage_s[i];
    }
    s->instructions = is_first || instructions < s->instructions ? instructions : s->instructions;
}

int bench_repeat(bench_shot *s, const bench_way *way, bench_once once, void *user, report *r)
{
    const double start = host_seconds();
    for (int run = 0; run <= way->runs || host_seconds() - start < SHORT_S * way->runs; ++run) {
        double stage_s[BENCH_STAGES] = {0};
        const int counted = way->runs > 0 && count_start();
        if (!once(user, stage_s, r)) {
            return 0;
        }
        keep_min(s, stage_s, counted ? count_stop() : 0.0, run <= 1);
        if (host_seconds() - start > BENCH_ENOUGH_S) {
            break;
        }
    }
    return 1;
}

/* --- the report --------------------------------------------------------------------------------------------------- */

void bench_results_about(bench_results *b, const bench_subject *s)
{
    static const char *const figures[] = {"trim", "rmse", "e50", "e95", "e99", "mean", "leak"};
    static const char *const meanings[] = {"relative RMSE without the worst 1 % of pixels",
                                           "relative RMSE",
                                           "median relative error of a pixel",
                                           "that of 95 in 100 pixels",
                                           "that of 99 in 100 pixels",
                                           "mean light, as a share of the truth's",
                                           "light where the truth is dark, as a share of the truth's"};
    memcpy(b->figure, figures, sizeof figures);
    memcpy(b->figure_is, meanings, sizeof meanings);
    for (int i = 0; i < BENCH_STAGES; ++i) {
        b->stage[i] = i > 0 && b->stage[i - 1] == NULL ? NULL : s->stages[i];
    }
    b->work = s->work;
    b->percent = 1;
}
