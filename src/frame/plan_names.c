/* plan_names.c: names used in a plan, and the numbers of the cost model. Layer 8. */
#include "plan_model.h"

#if LMB_PLAN

const plan_model lmb_model =
#include "plan_model.inc"
    ;

const char *lmb_why_name(int32_t why)
{
    static const char *const names[LMB_WHYS] = {
        "runs",
        "the picture does not show it",
        "not asked for",
        "there is no triangle",
        "no light meets a triangle",
        "nothing that is drawn reflects",
        "nothing that is drawn is glossy",
        "nothing that is drawn emits light",
        "stands as the last frame left it",
        "a convex, empty room: nothing stands between",
        "all of the scene lies past it",
        "its bounce is under half a display step",
    };
    return why >= 0 && why < LMB_WHYS ? names[why] : "?";
}

const char *lmb_op_name(int32_t op)
{
    static const char *const names[LMB_OPS] = {
        "triangles set up", "texels filled", "triangles sorted", "surfaces looked up", "first points summed",
        "triangles cut up", "pixels lit",    "tiles' cuts",      "pairs",              "segments",
        "lobes",            "pixels stored",
    };
    return op >= 0 && op < LMB_OPS ? names[op] : "?";
}

const char *lmb_plan_stage_name(int32_t stage)
{
    static const char *const names[LMB_PLAN_STAGES] = {
        "shadow maps", "BVH",     "first points", "later bounces", "view",           "surfaces",
        "direct light", "bounced light", "occlusion",    "lobes",         "emitted light", "picture",
    };
    return stage >= 0 && stage < LMB_PLAN_STAGES ? names[stage] : "?";
}

#endif
