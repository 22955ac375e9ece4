/* page_demo.c: replaces demo_scene.c: the built-in scene comes from another module, a file beside the page. */
#include "page_calls.h"

#include <string.h>

#include "../../../tools/demo/demo_scene.h"

static const lmb_scene *(*scene)(void);
static lmb_view (*view)(int32_t width, int32_t height);

void page_use_demo(const lmb_scene *(*its_scene)(void), lmb_view (*its_view)(int32_t width, int32_t height))
{
    scene = its_scene;
    view = its_view;
}

/* An empty scene until then. */
const lmb_scene *demo_scene(void)
{
    static const lmb_scene nothing;
    return scene != NULL ? scene() : &nothing;
}

lmb_view demo_view(int32_t width, int32_t height)
{
    static const lmb_view nothing;
    return view != NULL ? view(width, height) : nothing;
}
