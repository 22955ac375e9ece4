/* threads.c: a frame drawn by POSIX threads, in all stages.
 *
 * Each thread does a share of the current stage, later of the bands, with its own scratch. Between stages
 * the program waits for all threads. The bytes equal those of one thread. In a game you would keep your
 * threads and give them jobs. */
#include "room.h"

#include <pthread.h>
#include <stdlib.h>

enum { THREADS = 3 };

static lmb_render state, alone;
static lmb_frame frame, other; /* the same, by one thread */

typedef struct job { /* a share of the stage, or every third band */
    pthread_t thread;
    int32_t number;
    lmb_status status;
} job;

static void *work(void *user)
{
    job *j = user;
    lmb_band_scratch *own = &frame.scratch[j->number];
    if (state.stage < LMB_STAGE_BANDS)
        j->status = lmb_render_part(&state, own, j->number, THREADS, NULL);
    for (int32_t b = j->number; state.stage == LMB_STAGE_BANDS && b < (frame.out.height + 7) / 8; b += THREADS)
        j->status = j->status == LMB_OK ? lmb_render_band(&state, own, &frame.eye, &frame.out, b) : j->status;
    return NULL;
}

static lmb_status by_all(void)
{
    job jobs[THREADS];
    lmb_status status = LMB_OK;
    for (int32_t i = 0; i < THREADS; ++i) {
        jobs[i].number = i, jobs[i].status = LMB_OK;
        if (pthread_create(&jobs[i].thread, NULL, work, &jobs[i]) != 0)
            exit(1);
    }
    for (int32_t i = 0; i < THREADS; ++i) {
        pthread_join(jobs[i].thread, NULL);
        status = jobs[i].status != LMB_OK ? jobs[i].status : status;
    }
    return status;
}

int main(void)
{
    lmb_mesh mesh[2];
    lmb_material material[2];
    lmb_instance place[2];
    lmb_light light;
    const lmb_scene scene = room_scene(mesh, material, place, &light);
    lmb_frame_settings s;
    memset(&s, 0, sizeof s);
    s.kernels = lmb_kernels_pick();
    s.scene = &scene;
    s.threads = THREADS; /* number of scratches */
    s.shadow_map = 128;
    s.tree = 32;
    lmb_view_look_at(&s.view, room_eye, room_middle, room_up, 0.8f, 96, 64);
    const size_t bytes = lmb_frame_bytes(&s);
    if (lmb_frame_init(&other, &s, malloc(bytes), bytes) != LMB_OK ||
        lmb_frame_init(&frame, &s, malloc(bytes), bytes) != LMB_OK)
        return 1;
    lmb_status status = lmb_render_begin(&state, &frame);
    while (status >= LMB_OK && state.stage < LMB_STAGE_BANDS) {
        if (!lmb_render_has_parts(&state))
            status = lmb_render_step(&state, 1000); /* a short one */
        else if ((status = by_all()) == LMB_OK)
            status = lmb_render_parts_done(&state, THREADS);
    }
    if (status < LMB_OK || by_all() != LMB_OK || lmb_render_frame(&alone, &other) != LMB_OK)
        return 1;
    const uint64_t hash = lmb_surface_hash(&frame.out);
    return hash != lmb_surface_hash(&other.out) ||
           ends_with("threads", hash, BY_CONFIG(UINT64_C(0x0c572a24ad6d96d2), UINT64_C(0x4afcf9870b45114f)));
}
