/* solve_elements.c: light between surface elements, one reflection a pass, for the solvers that have them. Layer 8.
 *
 * If there are emissive surfaces or many lights, the first pass receives their light. The next pass receives the first
 * reflection of this light, and of the lights in shadow maps. Each further pass adds one reflection. */
#include "../base/vec.h"
#include "../bounce/points.h"
#include "requires.h"
#include "solver.h"
#include "stages.h"

#if LMB_TREES

#ifdef LMB_CONFIG_TINY
#define DEFAULT_ELEMENTS        256u
#define DEFAULT_BOUNCE_ELEMENTS 1024u
#else
#define DEFAULT_ELEMENTS        16384u /* for emissive surfaces and many lights */
#define DEFAULT_BOUNCE_ELEMENTS 65536u /* for repeated bounces: with fewer, rooms lose a tenth of the later light */
#endif

lmb_status lmb_solve_elements_place(lmb_frame *f, const lmb_frame_settings *s, frame_block *b)
{
    const int live = LMB_LIVE && f->gather_step == LMB_GATHER_LIVE;
    const uint32_t n = s->elements != 0          ? s->elements
                       : s->bounces > 1 && !live ? DEFAULT_BOUNCE_ELEMENTS
                                                 : DEFAULT_ELEMENTS;
    const size_t bytes = lmb_elements_bytes(n);
    void *memory = lmb_frame_take(b, bytes);
    f->elements.cap = n;
    return bytes == 0 ? LMB_ERR_ARG : is_only_measured(b) ? LMB_OK : lmb_elements_init(&f->elements, n, memory, bytes);
}

/* Elements first .. past - 1 receive light in pass r->light. */
static lmb_status receive_bounce(const lmb_render *r, const frame_solver *own, lmb_band_scratch *s, int32_t first,
                                 int32_t past, lmb_stats *stats)
{
    const lmb_frame *f = &r->frame;
    const int is_direct = r->light < (uint32_t)sends_direct(r);
    const int by_points = has_live_sky(f); /* own->receive adds the light of many lights */
    const lmb_status status =
        is_direct && !r->emits && !by_points ? LMB_OK : own->receive(r, s, first, past, stats);
    if (status != LMB_OK || !is_direct || by_points || !requires_many_lights_bounce(f)) {
        return status;
    }
    const lmb_many_lights_query query = elements_query(f, stats);
    const lmb_element_scratch scratch = {f->kernels, &s->gather.cut, &s->tile, &s->direct, &s->indirect};
    return lmb_many_lights_elements(&f->elements, &scratch, &s->many_lights, &query, first, past);
}

lmb_status lmb_solve_elements_end(lmb_render *r, const frame_solver *own)
{
    lmb_frame *f = &r->frame;
    lmb_status status = r->light == 0 && requires_many_lights_bounce(f) ? lmb_many_lights_elements_done(&f->elements)
                                                                        : LMB_OK;
    const int is_last = r->light + 1 >= radiosity_bounces(r);
    if (status == LMB_OK && is_last && f->bounces > 1 && !f->truncated) {
        status = own->rest(r, LMB_MAX_BOUNCES - f->bounces);
    }
    r->progress = 0;
    ++r->light;
    status = status != LMB_OK ? status : lmb_elements_send(&f->elements, is_last);
    status = status == LMB_OK && own->built != NULL ? own->built(r) : status;
    return status != LMB_OK ? status : has_bounces(r) ? LMB_MORE : LMB_OK;
}

lmb_status lmb_solve_elements_step(lmb_render *r, const frame_solver *own, int32_t units)
{
    if (!has_bounces(r)) {
        return LMB_OK;
    }
    const int32_t tiles = lmb_elements_tiles(&r->frame.elements), first = (int32_t)r->progress,
                  past = tiles - first < units ? tiles : first + units;
    const lmb_status status = receive_bounce(r, own, r->frame.scratch, first, past, r->frame.stats);
    r->progress = (uint32_t)past;
    return status != LMB_OK ? status : past < tiles ? LMB_MORE : lmb_solve_elements_end(r, own);
}

float lmb_solve_elements_done(const lmb_render *r)
{
    return ((float)r->light + (float)r->progress / maxf((float)lmb_elements_tiles(&r->frame.elements), 1.0f)) /
           maxf((float)radiosity_bounces(r), 1.0f);
}

lmb_status lmb_solve_elements_part(const lmb_render *r, const frame_solver *own, lmb_band_scratch *scratch,
                                   int32_t part, int32_t parts, lmb_stats *stats)
{
    int64_t first, past;
    share_out(&first, &past, lmb_elements_tiles(&r->frame.elements), part, parts);
    return receive_bounce(r, own, scratch, (int32_t)first, (int32_t)past, stats);
}

#endif
