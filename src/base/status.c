/* status.c: names of the status numbers. Layer 1. */
#include <lambent/types.h>

#include "exact.h"

const char *lmb_status_name(lmb_status status)
{
    switch (status) {
    case LMB_OK: return "LMB_OK";
    case LMB_MORE: return "LMB_MORE";
    case LMB_ERR_ARG: return "LMB_ERR_ARG";
    case LMB_ERR_CAPACITY: return "LMB_ERR_CAPACITY";
    case LMB_ERR_ALIGN: return "LMB_ERR_ALIGN";
    case LMB_ERR_FORMAT: return "LMB_ERR_FORMAT";
    case LMB_ERR_SCENE: return "LMB_ERR_SCENE";
    case LMB_ERR_BUILD: return "LMB_ERR_BUILD";
    }
    return "?";
}
