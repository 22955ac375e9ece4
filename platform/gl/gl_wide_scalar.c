/* gl_wide_scalar.c: gl_wide.h in plain C, and the choice of a back end. */
#include "gl_wide.h"

#include "../../src/lane/lane_scalar.h"

#define WIDE_NAME gl_wide_scalar
#include "gl_wide.inl"

gl_wide_shader gl_wide_pick(const struct lmb_kernels *kernels)
{
#define WIDE_OF(upper, lower) LMB_IF(LMB_HAVE_##upper, {#lower, gl_wide_##lower}, )
    static const struct { const char *name; gl_wide_shader shader; } all[] = {LMB_BACKENDS(WIDE_OF)};
    for (size_t i = 0; kernels != NULL && i < sizeof all / sizeof all[0]; ++i) {
        if (strcmp(lmb_kernels_name(kernels), all[i].name) == 0) {
            return all[i].shader;
        }
    }
    return NULL;
}
