/* relief_options.c: option values shared by the relief verbs. */
#include "relief_options.h"

#include <string.h>

#include "../common/option_value.h"

int relief_option_views(const char *text, int32_t *views, int32_t *is_greedy)
{
    *is_greedy = strncmp(text, "greedy:", 7) == 0;
    return option_int(text + 7 * *is_greedy, 1, LMB_RELIEF_VIEWS, views);
}
