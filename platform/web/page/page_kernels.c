/* page_kernels.c: replaces isa_pick.c: uses the kernels of another module, renumbered for this
 * module's table of functions. */
#include "page_calls.h"

#include <string.h>

#include "../../../src/base/exact.h"
#include "../../../src/lane/kernels.h"

enum { KEPT_WORDS = sizeof(lmb_kernels) / sizeof(uint32_t), FUNCTIONS_FROM = 2 };

static lmb_kernels kernels;
static int are_here;

void page_use_kernels(const uint32_t *words, uint32_t first_function)
{
    uint32_t own[KEPT_WORDS];
    memcpy(own, words, sizeof own);
    for (int i = FUNCTIONS_FROM; i < KEPT_WORDS; ++i) {
        own[i] += first_function;
    }
    memcpy(&kernels, own, sizeof kernels);
    are_here = 1;
}

const lmb_kernels *lmb_kernels_at(int32_t i) { return i == 0 && are_here ? &kernels : NULL; }
const lmb_kernels *lmb_kernels_pick(void) { return lmb_kernels_at(0); }
const char *lmb_kernels_name(const lmb_kernels *k) { return k != NULL ? k->name : "?"; }

const lmb_kernels *lmb_kernels_named(const char *name)
{
    return are_here && name != NULL && strcmp(name, kernels.name) == 0 ? &kernels : NULL;
}

lmb_status lmb_build_check(void)
{
    volatile float one_and_bit = 1.000244140625f; /* 1 + 2^-12 */
    return are_here && lmb_base_is_exact() && kernels.probe(one_and_bit) == 0.0f ? LMB_OK : LMB_ERR_BUILD;
}
