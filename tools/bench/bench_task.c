/* bench_task.c: the settings that a sweep measures. */
#include <stdio.h>
#include <string.h>

#include <lambent/lambent.h>

#include "bench_task.h"

static int usual(bench_task *out, const bench_subject *s)
{
    for (int i = 0; i < s->try_count; ++i) {
        snprintf(out[i].option, sizeof out[i].option, "%s", s->tries[i].option);
        snprintf(out[i].words, sizeof out[i].words, "%s", s->tries[i].words);
        out[i].weight = s->tries[i].weight;
        out[i].flags = s->tries[i].flags;
    }
    int count = s->try_count;
    const lmb_kernels *k;
    for (int32_t i = 0; s->backends && count < BENCH_POINTS && (k = lmb_kernels_at(i)) != NULL; ++i) {
        snprintf(out[count].option, sizeof out[count].option, "machine");
        snprintf(out[count].words, sizeof out[count].words, "--backend %s", lmb_kernels_name(k));
        out[count].weight = s->tries[0].weight * (lmb_kernels_at(i + 1) == NULL ? 2.5 : 1.0); /* plain C comes last */
        out[count++].flags = BENCH_SAME;
    }
    return count;
}

/* Combination i of all ranges' values; the last range varies fastest. */
static int combine(bench_task *out, const bench_options *o, int i)
{
    int value[BENCH_SWEEPS];
    size_t n = 0;
    memset(out, 0, sizeof *out);
    for (int k = o->ranges; k-- > 0;) {
        value[k] = i % o->range[k].count;
        i /= o->range[k].count;
    }
    for (int k = 0; k < o->ranges && n < sizeof out->words; ++k) {
        const bench_range *g = &o->range[k];
        n += (size_t)snprintf(out->words + n, sizeof out->words - n, "%s%s %s", k > 0 ? " " : "", g->name,
                              g->value[value[k]]);
    }
    snprintf(out->option, sizeof out->option, "%.30s", o->range[0].name + 2);
    out->weight = 1.0;
    return n < sizeof out->words;
}

int bench_tasks(bench_task *out, const bench_options *o, report *r)
{
    int all = o->ranges > 0;
    for (int k = 0; k < o->ranges; ++k) {
        all *= o->range[k].count;
        if (all > BENCH_POINTS) {
            return report_fail(r, "--sweep: more than %d settings", BENCH_POINTS);
        }
    }
    if (all == 0) {
        return usual(out, o->subject);
    }
    for (int i = 0; i < all; ++i) {
        if (!combine(&out[i], o, i)) {
            return report_fail(r, "--sweep: names and values of over %d characters", BENCH_NAME - 1);
        }
    }
    return all;
}

int bench_check(const bench_options *o, report *r)
{
    static bench_task task[BENCH_POINTS];
    bench_line line;
    int ok = bench_tasks(task, o, r);
    for (int i = ok && o->ranges > 0 ? ok : 1; ok && i-- > 0;) {
        ok = bench_options_line(&line, o, NULL, r) &&
             (bench_line_add(&line, task[i].words) || report_fail(r, "too many options")) &&
             o->subject->check(&line, r);
    }
    return ok != 0;
}
