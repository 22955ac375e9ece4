/* hard_list.c: a list of hard cases, and the result of one. */
#include "hard_list.h"

#include <math.h>
#include <stdlib.h>

void hard_put(hard_list *list, int kind, const char *name, double figure, double bound, const char *unit)
{
    if (list->count == HARD_CASES) {
        abort(); /* HARD_CASES is too small */
    }
    hard_case *c = &list->item[list->count++];
    c->group = list->group;
    c->name = name;
    c->unit = unit;
    c->kind = kind;
    c->figure = figure;
    c->bound = bound;
}

int hard_holds(const hard_case *c) { return c->figure <= c->bound; }

const char *hard_kind_name(int kind)
{
    return kind == HARD_EXACT ? "exact" : kind == HARD_BOUNDED ? "bounded" : "measured";
}

double hard_share(double part, double whole) { return whole > 0.0 ? part / whole : HUGE_VAL; }
