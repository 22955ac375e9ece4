/* demo_scene.c: hands out the built-in scene and its camera. The data are generated: gen_demo.c. */
#include "demo_scene.h"

/* Streams must be aligned to 4 bytes. The unions in the data do that portably. If uint32_t itself only needs 2
 * (m68k), the compiler attribute does. */
#if defined(__GNUC__)
#define ALIGNED_4 __attribute__((aligned(4)))
#else
#define ALIGNED_4
#endif

#include "demo_scene_data.inc"

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

static const lmb_scene scene = {
    demo_meshes,
    demo_materials,
    demo_textures,
    demo_instances,
    demo_lights,
    COUNT(demo_meshes),
    COUNT(demo_materials),
    COUNT(demo_textures),
    COUNT(demo_instances),
    COUNT(demo_lights),
    DEMO_BOUNDS_MIN,
    DEMO_BOUNDS_MAX,
    0,
    0,
    0,
    {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, 0}, /* all of it is fine */
};

const lmb_scene *demo_scene(void)
{
    return &scene;
}

lmb_view demo_view(int32_t width, int32_t height)
{
    static const lmb_view nothing;
    static const lmb_vec3 eye = {0.12f, 1.42f, 2.70f}, target = {0.0f, 1.10f, -1.0f}, up = {0.0f, 1.0f, 0.0f};
    const float vfov_rad = 0.872664626f; /* 50 degrees */
    lmb_view view = nothing;
    lmb_view_look_at(&view, eye, target, up, vfov_rad, width, height);
    return view;
}
