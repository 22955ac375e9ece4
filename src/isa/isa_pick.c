/* isa_pick.c: which machine's kernels, and do they compute what they should? Floor 9. */
#include "../base/exact.h"
#include "../lane/kernels.h"

const lmb_kernels *lmb_kernels_pick(void) { return &lmb_kernels_scalar; }

static int same_text(const char *a, const char *b)
{
    while (*a != '\0' && *a == *b) {
        ++a;
        ++b;
    }
    return *a == *b;
}

const lmb_kernels *lmb_kernels_named(const char *name)
{
    return name != NULL && same_text(name, lmb_kernels_scalar.name) ? &lmb_kernels_scalar : NULL;
}

const char *lmb_kernels_name(const lmb_kernels *kernels) { return kernels != NULL ? kernels->name : "?"; }

lmb_status lmb_build_check(void)
{
    volatile float one_and_bit = 1.000244140625f; /* 1 + 2^-12 */
    return lmb_base_is_exact() && lmb_kernels_scalar.probe(one_and_bit) == 0.0f ? LMB_OK : LMB_ERR_BUILD;
}
