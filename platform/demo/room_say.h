/* room_say.h: prints a frame's hash and the cost by stage, for both room programs. */
#ifndef ROOM_SAY_H
#define ROOM_SAY_H

#include "../port.h"
#include "../port_say.h"
#include "room_port.h"

static inline void say_frame(int32_t frame, uint32_t hash, const char *const *stage, const uint32_t *taken, int stages)
{
    uint32_t all = 0;
    say_count("frame ", (uint32_t)frame);
    port_put(" ");
    say_word(hash);
    say_count("\ncost ", (uint32_t)frame);
    port_put(":");
    for (int i = 0; i < stages; ++i) {
        port_put(" ");
        port_put(stage[i]);
        say_count(" ", taken[i]);
        all += taken[i];
    }
    say_count(" all ", all);
    port_put(" ");
    port_put(port_clock_unit);
    port_put("\n");
}

#endif
