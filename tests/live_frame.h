/* live_frame.h: memory for light at single points, for a frame of bounce_frame.h, which you include first. */
#ifndef TEST_LIVE_FRAME_H
#define TEST_LIVE_FRAME_H

/* Makes `inout` a frame of LMB_GATHER_LIVE. */
static inline void gather_live(lmb_frame *inout)
{
    static lmb_live live;
    static lmb_live_scratch live_scratch;
    static uint64_t lattice_memory[FRAME * FRAME / 64 * 192];
    static uint64_t live_memory[FACES * MAP * MAP * 3 + ELEMENTS * 32 + FACES * 1024 + 4096];
    inout->gather_step = LMB_GATHER_LIVE;
    inout->live = &live;
    scratch.live = &live_scratch;
    CHECK(lmb_lattice_init(&inout->lattice, FRAME, FRAME, lattice_memory, sizeof lattice_memory) == LMB_OK);
    CHECK(lmb_live_init(&live, FACES, lmb_live_side(FACES, MAP), ELEMENTS, live_memory, sizeof live_memory) == LMB_OK);
}

#endif
