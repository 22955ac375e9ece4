/* golden_gouraud.c: small_room with light at vertices: shadow map, bounced light of the transfer, the picture. */
#include "golden_cases.h"

#if LMB_TRANSFER

#include "../small_transfer.h"

enum { MAP = 32 };

typedef struct gouraud_space {
    uint32_t file[SMALL_TRANSFER_WORDS(ROOM_TRIANGLES)];
    uint32_t light_memory[9 * SMALL_ELEMENTS + 2 * SMALL_NODES + 3 * SMALL_RECEIVERS + 9 * SMALL_CLUSTERS +
                          SMALL_ELEMENTS * sizeof(lmb_transfer_coarse) / 4 +
                          LMB_TRANSFER_PARTS * sizeof(lmb_transfer_part) / 4];
    uint32_t map_memory[6 * MAP * MAP * 2], picture[GOLDEN_WIDTH * GOLDEN_HEIGHT / 2];
    uint16_t depth[GOLDEN_WIDTH * GOLDEN_HEIGHT];
    float direct[SMALL_RECEIVERS][3];
    lmb_gouraud_scratch scratch;
    lmb_transfer_scratch collecting;
    lmb_transfer transfer;
    lmb_transfer_light light;
    lmb_shadow_map map;
    lmb_gouraud frame;
    small_room room; /* last: where words are aligned to 2 bytes, its size is no multiple of 4 */
} gouraud_space;

GOLDEN_FITS(gouraud_space, first);

static lmb_status light_up(gouraud_space *s)
{
    const lmb_kernels *k = lmb_kernels_pick();
    const lmb_scene *scene = &s->room.scene;
    lmb_status status =
        lmb_shadow_map_init(&s->map, &s->room.light, scene, MAP, LMB_ID16, s->map_memory, sizeof s->map_memory);
    status = status != LMB_OK ? status : lmb_transfer_open(&s->transfer, s->file, small_transfer(s->file, scene));
    status = status != LMB_OK ? status
                              : lmb_transfer_light_init(&s->light, &s->transfer, s->light_memory, sizeof s->light_memory);
    status = status != LMB_OK ? status : lmb_transfer_materials(&s->light, &s->transfer, scene);
    status = status != LMB_OK ? status : lmb_gouraud_map(&s->map, &s->scratch, scene);
    memset(&s->collecting, 0, sizeof s->collecting);
    for (int32_t f = 0; f < s->map.faces && status == LMB_OK; ++f) {
        status = lmb_transfer_collect(&s->light, k, &s->collecting, &s->transfer, scene, &s->room.light, &s->map, f, 1,
                                      0, MAP);
    }
    status = status != LMB_OK ? status : lmb_transfer_send(&s->light, &s->transfer);
    return status != LMB_OK ? status
                            : lmb_transfer_receivers(&s->light, k, &s->transfer, 0, SMALL_RECEIVERS + SMALL_CLUSTERS);
}

/* Bit 0: from inside, so that the floor is clipped; 1: a point light; 2: less exposure. */
uint64_t case_gouraud(int variant)
{
    gouraud_space *s = golden_first();
    uint64_t h = GOLDEN_START;
    small_room_make(&s->room);
    s->room.light.kind = variant & 2 ? LMB_LIGHT_POINT : LMB_LIGHT_SPOT;
    lmb_status status = light_up(s);
    memset(&s->frame, 0, sizeof s->frame);
    s->frame.scene = &s->room.scene;
    s->frame.transfer = &s->transfer;
    s->frame.light = &s->light;
    s->frame.maps = &s->map;
    s->frame.direct = s->direct;
    s->frame.scratch = &s->scratch;
    s->frame.depth = s->depth;
    s->frame.exposure_ev = variant & 4 ? -1.5f : 0.0f;
    lmb_surface_init(&s->frame.out, LMB_RGB565, GOLDEN_WIDTH, GOLDEN_HEIGHT, s->picture, sizeof s->picture);
    lmb_view_look_at(&s->frame.view, variant & 1 ? vec3(0.3f, 0.4f, 0.2f) : vec3(0.4f, 0.6f, 2.5f),
                     variant & 1 ? vec3(-0.4f, 0, -0.5f) : vec3(0, 0.4f, 0), vec3(0, 1, 0), 1.2f, GOLDEN_WIDTH,
                     GOLDEN_HEIGHT);
    status = status != LMB_OK ? status : lmb_gouraud_begin(&s->frame);
    status = status != LMB_OK ? status : lmb_gouraud_draw(&s->frame, 1, ROOM_TRIANGLES);
    h = golden_hash_u32(h, (uint32_t)status);
    for (int32_t i = 0; i < GOLDEN_WIDTH * GOLDEN_HEIGHT; ++i) {
        h = golden_hash_u32(h, ((const uint16_t *)s->picture)[i] | (uint32_t)s->depth[i] << 16);
    }
    return h;
}

#endif
