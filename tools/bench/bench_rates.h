/* bench_rates.h: the limits of a backend: cycles of each operation, and the load of each on the execution units.
 *
 * Each operation is first timed by itself, on many independent values in registers, which keeps the unit that executes
 * it busy. Then a few operations of another kind are added. The additional time is the other operation's load on that
 * unit: nothing if another unit executes it, otherwise part or all of its time.
 *
 * The bound of a mix is the time of the most loaded unit. It is a lower bound: loads, stores, masks, branches and
 * latencies count as nothing, and an operation that either of two units can execute counts for neither. Units are named
 * by operations that are one instruction in every backend: compare and pick may be several. */
#ifndef BENCH_RATES_H
#define BENCH_RATES_H

#include <stdint.h>

/* ADD: and subtract. MAX: and min. CMP: compare. PICK: by an existing mask. */
enum { BENCH_MUL = 0, BENCH_ADD, BENCH_MAX, BENCH_DIV, BENCH_UNITS };
enum { BENCH_CMP = BENCH_UNITS, BENCH_PICK, BENCH_SQRT, BENCH_OPS };
extern const char *const bench_op_names[BENCH_OPS];

typedef void bench_loop(float *out, uint32_t rounds, const float *in);

/* A backend's loops, compiled from bench_rates.inl. */
typedef struct bench_backend {
    const char *name; /* as in lmb_kernels */
    int lanes, chains; /* independent values */
    bench_loop *alone[BENCH_OPS], *beside[BENCH_UNITS][BENCH_OPS]; /* [operation of the busy unit][added operation] */
    /* Reads `count` depths, tests each and writes it by the result, as filling does; `rounds` times. */
    void (*store)(float *inout, uint32_t count, uint32_t rounds);
    /* Sums four floats per lane from separate positions among `count`, a power of two; `rounds` times. */
    void (*read)(float *out, const float *in, int32_t count, uint32_t rounds);
} bench_backend;

/* Operations per round on each chain, and operations of the added kind per round. Rows of 16 floats that a loop reads:
 * 1, a tiny number, and values from 1 to 2. */
#define BENCH_IS_SLOW(op) ((op) == BENCH_DIV || (op) == BENCH_SQRT)
#define BENCH_BUSY(op) (BENCH_IS_SLOW(op) ? 1 : 4)
#define BENCH_BESIDE(op) (BENCH_IS_SLOW(op) ? 4 : 2)
enum { BENCH_ROWS = 18 };

/* The shortest times of a backend so far, s. Call bench_rates_begin first. You may repeat bench_rates_step: each call
 * improves them. */
typedef struct bench_rates {
    const bench_backend *backend;
    double cycle;                                            /* a cycle */
    double alone[BENCH_OPS], beside[BENCH_UNITS][BENCH_OPS]; /* a round */
    double store, read;                                      /* a value; four floats of one lane */
} bench_rates;

/* bench_rates_begin: returns 0 if `name` is no backend of this build. */
int bench_rates_begin(bench_rates *out, const char *name);
/* bench_rates_step: runs every loop once more, about 2 ms. */
void bench_rates_step(bench_rates *inout);
/* Tries once more, and returns the maximum number of depths per second read, tested and written in 16 KiB of cache. */
double bench_rates_store(bench_rates *inout);
/* Tries once more, and returns the maximum number of gathers of four floats per second from the cache. */
double bench_rates_read(bench_rates *inout);
/* Cycles of one operation on a vector. */
double bench_rates_op(const bench_rates *r, int op);
/* Cycles that one `op` adds to the unit of `unit`. */
double bench_rates_load(const bench_rates *r, int unit, int op);
/* Minimum cycles for a mix; *unit: the operation that names the limiting unit. */
double bench_rates_bound(int *unit, const bench_rates *r, const double counts[BENCH_OPS]);

#endif
