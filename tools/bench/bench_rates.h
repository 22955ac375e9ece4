/* bench_rates.h: what a backend can do at most: cycles of each operation, and how much of a unit each takes.
 *
 * Each operation is timed alone, on many independent values in registers, so that whatever carries it out (its unit) is
 * busy all the time; then with a little of another operation beside it. What the other adds is its load on that unit:
 * nothing where it goes elsewhere, part of its time or all of it where it does not.
 *
 * The bound of a mix is the most loaded unit's time: from below, since loads, stores, masks, branches and waiting for
 * results count as nothing, and an operation that could go to either of two units counts for neither. Units are those
 * of operations that are one instruction of every backend: compare and pick may be several. */
#ifndef BENCH_RATES_H
#define BENCH_RATES_H

#include <stdint.h>

/* ADD: and subtract. MAX: and min. CMP: compare. PICK: by a mask that is there already. */
enum { BENCH_MUL = 0, BENCH_ADD, BENCH_MAX, BENCH_DIV, BENCH_UNITS };
enum { BENCH_CMP = BENCH_UNITS, BENCH_PICK, BENCH_SQRT, BENCH_OPS };
extern const char *const bench_op_names[BENCH_OPS];

typedef void bench_loop(float *out, uint32_t rounds, const float *in);

/* A backend's loops, compiled for it from bench_rates.inl. */
typedef struct bench_backend {
    const char *name; /* as its lmb_kernels' */
    int lanes, chains; /* independent values */
    bench_loop *alone[BENCH_OPS], *beside[BENCH_UNITS][BENCH_OPS]; /* [that keeps its unit busy][beside] */
    /* Reads `count` depths, tests each and writes it by the test's outcome, as filling does; `rounds` times. */
    void (*store)(float *inout, uint32_t count, uint32_t rounds);
    /* Adds up four floats from a place of each lane's own among `count`, a power of two, `rounds` times. */
    void (*read)(float *out, const float *in, int32_t count, uint32_t rounds);
} bench_backend;

/* Operations of a round on each chain, and of the one beside in all. Rows of 16 floats that a loop reads: 1, a tiny
 * number, and values from 1 to 2. */
#define BENCH_IS_SLOW(op) ((op) == BENCH_DIV || (op) == BENCH_SQRT)
#define BENCH_BUSY(op) (BENCH_IS_SLOW(op) ? 1 : 4)
#define BENCH_BESIDE(op) (BENCH_IS_SLOW(op) ? 4 : 2)
enum { BENCH_ROWS = 18 };

/* A backend's least times so far, s. Begin with bench_rates_begin; each bench_rates_step improves them. */
typedef struct bench_rates {
    const bench_backend *backend;
    double cycle;                                            /* a cycle */
    double alone[BENCH_OPS], beside[BENCH_UNITS][BENCH_OPS]; /* a round */
    double store, read;                                      /* a value; four floats of one lane */
} bench_rates;

/* bench_rates_begin: 0 where `name` is no backend of this build. */
int bench_rates_begin(bench_rates *out, const char *name);
/* bench_rates_step: every loop once more, about 2 ms. */
void bench_rates_step(bench_rates *inout);
/* Depths a second that the processor has at best read, tested and written in its cache, 16 KiB, after one more try. */
double bench_rates_store(bench_rates *inout);
/* Places a second that the backend's lanes have at best read four floats from in its cache, after one more try. */
double bench_rates_read(bench_rates *inout);
/* Cycles of one operation on a vector. */
double bench_rates_op(const bench_rates *r, int op);
/* Cycles that one of `op` adds to the unit that `unit` keeps busy. */
double bench_rates_load(const bench_rates *r, int unit, int op);
/* Least cycles for so many of each; *unit: the operation that names the unit which bounds it. */
double bench_rates_bound(int *unit, const bench_rates *r, const double counts[BENCH_OPS]);

#endif
