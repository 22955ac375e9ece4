/* page_pool.c: pool.h by the page's workers, which wait in page_help: each is an instance on the same memory. */
#include "page_calls.h"

#include "../../host/pool.h"

/* Each pool_run that needs help raises `turn`; each helper then lowers `busy` once. So no helper is late and
 * reads data of the next turn. */
static struct shared {
    int32_t helpers;             /* started helpers */
    int32_t there, start;        /* participants with the caller, 0: not known yet; the turn before their first */
    int32_t turn, busy;
    int32_t threads, next, count; /* of this turn */
    pool_job job;
    void *user;
} all;

static int32_t load(const int32_t *from) { return __atomic_load_n(from, __ATOMIC_SEQ_CST); }
static int32_t add(int32_t *to, int32_t n) { return __atomic_fetch_add(to, n, __ATOMIC_SEQ_CST); }

/* Waits while *at is `old`. */
static void wait_while(int32_t *at, int32_t old)
{
    while (load(at) == old) {
        __builtin_wasm_memory_atomic_wait32((int *)at, old, -1);
    }
}

static void wake(int32_t *at) { __builtin_wasm_memory_atomic_notify((int *)at, 0x7fffffff); }

static void work(int number)
{
    for (int32_t i = number; i < all.count; i = add(&all.next, 1)) {
        all.job(all.user, i, number);
    }
}

void page_help(void)
{
    const int32_t number = 1 + add(&all.helpers, 1);
    wait_while(&all.there, 0);
    for (int32_t seen = all.start; number < all.there; ++seen) {
        wait_while(&all.turn, seen);
        if (number < all.threads) {
            work(number);
        }
        if (add(&all.busy, -1) == 1) {
            wake(&all.busy);
        }
    }
}

int32_t page_helpers(void) { return load(&all.helpers); }

int32_t page_take_helpers(void)
{
    if (all.there == 0) {
        const int32_t there = 1 + load(&all.helpers);
        all.start = load(&all.turn);
        __atomic_store_n(&all.there, there < POOL_MAX ? there : POOL_MAX, __ATOMIC_SEQ_CST);
        wake(&all.there);
    }
    return all.there;
}

int pool_processors(void) { return all.there > 1 ? all.there : 1; }

int pool_threads(int asked) { return asked < 1 ? pool_processors() : asked > POOL_MAX ? POOL_MAX : asked; }

void pool_run(int threads, int count, pool_job job, void *user)
{
    const int there = pool_processors();
    threads = threads > there ? there : threads;
    threads = threads > count ? count : threads;
    all.threads = threads < 1 ? 1 : threads;
    all.count = count;
    all.next = all.threads;
    all.job = job;
    all.user = user;
    if (all.threads > 1) {
        __atomic_store_n(&all.busy, there - 1, __ATOMIC_SEQ_CST);
        add(&all.turn, 1);
        wake(&all.turn);
    }
    work(0);
    for (int32_t left = load(&all.busy); left > 0; left = load(&all.busy)) {
        __builtin_wasm_memory_atomic_wait32((int *)&all.busy, left, -1);
    }
}
