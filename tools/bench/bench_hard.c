/* bench_hard.c: `lambent-bench hard`: the gallery of hard cases as a table. */
#include "bench_hard.h"

#include <stdio.h>
#include <stdlib.h>

#include "../hard/hard.h"

/* Failed cases have NaN or infinity, which JSON lacks. */
static void print_number(double v)
{
    if (v - v == 0.0) {
        printf("%.4g", v);
    } else {
        printf("null");
    }
}

static void print_object(const hard_case *c)
{
    printf("{\"group\":\"%s\",\"case\":\"%s\",\"kind\":\"%s\",\"figure\":", c->group, c->name, hard_kind_name(c->kind));
    print_number(c->figure);
    printf(",\"bound\":%.4g,\"unit\":\"%s\",\"holds\":%s}\n", c->bound, c->unit, hard_holds(c) ? "true" : "false");
}

static void print_line(const hard_case *c)
{
    printf("%-7s %-8s %10.4g %10.4g %-13s %-4s %s\n", c->group, hard_kind_name(c->kind), c->figure, c->bound, c->unit,
           hard_holds(c) ? "" : "FAIL", c->name);
}

static void print_cases(const hard_list *list, int json)
{
    if (!json) {
        printf("%-7s %-8s %10s %10s %-13s %-4s %s\n", "group", "kind", "figure", "bound", "unit", "", "case");
    }
    for (int i = 0; i < list->count; ++i) {
        json ? print_object(&list->item[i]) : print_line(&list->item[i]);
    }
}

int bench_hard(const hard_options *o, report *r)
{
    hard_list *list = malloc(sizeof *list);
    int past = 0;
    if (list == NULL || !hard_run(list, o->group, o->kernels)) {
        free(list);
        return report_fail(r, "not enough memory for the gallery");
    }
    if (!o->is_quiet) {
        print_cases(list, o->json);
    }
    for (int i = 0; i < list->count; ++i) {
        past += !hard_holds(&list->item[i]);
    }
    free(list);
    return past == 0 || report_fail(r, "%d figures are past their bound: please tell us, with the table", past);
}
