// cpp_user.cpp: the library from C++: the headers compile as C++, and the memory is a vector.
//
// Structs are plain data, so value initialisation replaces memset. Any threads may draw bands in any order with the
// same bytes. Here two threads do, each with its own scratch (settings.threads), after the light was solved once.
#include <cstdint>
#include <cstdio>
#include <thread>
#include <vector>

#include "room.h"

namespace {

class Renderer {
public:
    explicit Renderer(const lmb_frame_settings &settings)
        : block_((lmb_frame_bytes(&settings) + 7) / 8), state_(1), threads_(settings.threads)
    {
        status_ = lmb_frame_init(&frame_, &settings, block_.data(), block_.size() * 8);
    }

    lmb_status draw()
    {
        if (status_ == LMB_OK)
            status_ = lmb_render_begin(&state_[0], &frame_);
        while (status_ == LMB_OK && state_[0].stage < LMB_STAGE_BANDS) {
            const lmb_status step = lmb_render_step(&state_[0], 1000);
            status_ = step == LMB_MORE ? LMB_OK : step;
        }
        std::vector<std::thread> workers;
        for (int w = 0; w < threads_ && status_ == LMB_OK; ++w)
            workers.emplace_back([this, w] {
                for (int band = w; band < (frame_.out.height + 7) / 8; band += threads_)
                    lmb_render_band(&state_[0], &frame_.scratch[w], &frame_.eye, &frame_.out, band);
            });
        for (std::thread &t : workers)
            t.join();
        return status_;
    }

    const lmb_surface &picture() const { return frame_.out; }

private:
    std::vector<std::uint64_t> block_;
    std::vector<lmb_render> state_;
    lmb_frame frame_ = lmb_frame();
    int threads_;
    lmb_status status_;
};

} // namespace

int main()
{
    lmb_mesh mesh[2];
    lmb_material material[2];
    lmb_instance place[2];
    lmb_light light;
    const lmb_scene scene = room_scene(mesh, material, place, &light);
    lmb_frame_settings settings = lmb_frame_settings();
    settings.kernels = lmb_kernels_pick();
    settings.scene = &scene;
    settings.threads = 2;
    settings.shadow_map = 128;
    settings.tree = 32;
    lmb_view_look_at(&settings.view, room_eye, room_middle, room_up, 0.8f, 96, 64);
    Renderer renderer(settings);
    const lmb_status status = renderer.draw();
    return status != LMB_OK || ends_with("C++", lmb_surface_hash(&renderer.picture()),
                                       BY_CONFIG(UINT64_C(0x0c572a24ad6d96d2), UINT64_C(0x4afcf9870b45114f)));
}
