/* test_bake_share.c: steps of a bake that slices share through files: accepted and rejected files of other slices. */
#include "../folder.h"

#include <string.h>

#include "../../tools/bake/bake_share.h"
#include "../test.h"

void test_bake_share(void);

enum { BATCHES = 6 };

/* A step with batches that are numbers from `first` on. */
typedef struct numbers {
    int32_t first, value[BATCHES], made;
    double heavy; /* weight of the first and the last batch; others have 1 */
} numbers;

static double weight_of(const void *user, int32_t batch)
{
    return batch == 0 || batch == BATCHES - 1 ? ((const numbers *)user)->heavy : 1.0;
}

static int make(void *user, int32_t batch, report *r)
{
    numbers *n = user;
    (void)r;
    n->value[batch] = n->first + batch;
    ++n->made;
    return 1;
}

static void put(const void *user, int32_t batch, byte_buffer *to)
{
    byte_put_int(to, ((const numbers *)user)->value[batch]);
}

static int get(void *user, int32_t batch, byte_reader *from)
{
    ((numbers *)user)->value[batch] = byte_get_int(from);
    return !from->is_short;
}

static void run(numbers *n, const char *in, int32_t number, uint64_t job)
{
    static bake_share s; /* large */
    const bake_step step = {BATCHES, weight_of, make, put, get, n};
    report r = {""};
    memset(&s, 0, sizeof s);
    s.slice.number = number;
    s.slice.count = 2;
    s.job = job;
    s.folder = in;
    CHECK_MSG(bake_share_step(&s, &step, &r), "%s", r.text);
}

static int is_from(const numbers *n, int32_t first)
{
    int same = 0;
    for (int32_t i = 0; i < BATCHES; ++i) {
        same += n->value[i] == first + i;
    }
    return same == BATCHES;
}

/* Files count only from the same job, step and deal, even if others have the same size. */
void test_bake_share(void)
{
    folder f;
    char in[FOLDER_PATH + 1], name[FOLDER_PATH];
    folder_open(&f);
    snprintf(in, sizeof in, "%s/", f.path);
    numbers first = {.first = 100, .heavy = 1.0}, other = {.first = 200, .heavy = 1.0}, job = {.first = 300, .heavy = 1.0},
            deal = {.first = 400, .heavy = 2.0};
    run(&first, in, 1, 7); /* the second slice never comes: the first makes that part too */
    CHECK(first.made == BATCHES && is_from(&first, 100));
    run(&other, in, 2, 7);
    CHECK_MSG(other.made == 0 && is_from(&other, 100), "%d made by the second slice", (int)other.made);
    run(&job, in, 2, 8);
    CHECK_MSG(job.made == BATCHES && is_from(&job, 300), "%d made of another job", (int)job.made);
    run(&deal, in, 2, 8);
    CHECK_MSG(deal.made == BATCHES && is_from(&deal, 400), "%d made by another deal", (int)deal.made);
    for (int i = 1; i <= 2; ++i) {
        snprintf(name, sizeof name, "%.400s/%dof2.1", f.path, i);
        remove(name);
    }
    folder_close(&f);
}
