/* mix_aside.c: work that runs beside the rows of a picture. */
#include "mix_job.h"

void mix_aside_run(mix_aside *a, int threads)
{
    const int count = a->count;
    a->is_beside = a->count = 0;
    pool_run(threads, count, a->run, a->user);
}

typedef struct rows {
    mix_aside *aside;
    int aside_count;
    pool_job row;
    void *user;
} rows;

static void run_row(void *user, int index, int thread)
{
    const rows *r = user;
    if (index < r->aside_count) {
        r->aside->run(r->aside->user, index, thread);
    } else {
        r->row(r->user, index - r->aside_count, thread);
    }
}

void mix_run_rows(const mix_job *j, int threads, int count, pool_job row, void *user)
{
    rows all = {j->aside, 0, row, user};
    if (j->aside != NULL) {
        all.aside_count = j->aside->count;
        j->aside->count = 0;
        j->aside->is_beside = 1;
    }
    pool_run(threads, all.aside_count + count, run_row, &all);
}
