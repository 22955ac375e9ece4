/* draw_combine.c: texture stages with functions of three arguments. Layer 4. */
#include "draw_part.h"

#if LMB_DRAW
typedef struct combine_job {
    const lmb_draw_stage *stage;
    const uint8_t *first, *previous; /* colours before all stages, and before this one */
    const uint8_t (*texel)[4];       /* of all stages */
    int at;                          /* this stage */
} combine_job;

/* Argument k of channel i. */
static int32_t combine_argument(const combine_job *j, int i, int k)
{
    const lmb_draw_combine *c = &j->stage->combine;
    const int operand = c->operand[i == 3][k];
    const uint8_t *from;
    switch (c->source[i == 3][k]) {
    case LMB_DRAW_FROM_TEXTURE:
        from = j->texel[j->at];
        break;
    case LMB_DRAW_FROM_CONSTANT:
        from = j->stage->colour;
        break;
    case LMB_DRAW_FROM_VERTEX:
        from = j->first;
        break;
    case LMB_DRAW_FROM_PREVIOUS:
        from = j->previous;
        break;
    default:
        from = j->texel[c->source[i == 3][k] - LMB_DRAW_FROM_STAGE];
        break;
    }
    const int32_t code = from[operand >= LMB_DRAW_TAKE_ALPHA ? 3 : i];
    return operand == LMB_DRAW_TAKE_INVERSE_COLOUR || operand == LMB_DRAW_TAKE_INVERSE_ALPHA ? 255 - code : code;
}

/* v / 255, clamped to 0 from below, to nearest; ties cannot occur. */
static int32_t combine_quotient(int32_t v) { return (maxi(v, 0) + 127) / 255; }

static int32_t combine_dot(const combine_job *j, int32_t scale)
{
    int32_t sum = 0;
    for (int i = 0; i < 3; ++i) {
        sum += (2 * combine_argument(j, i, 0) - 255) * (2 * combine_argument(j, i, 1) - 255);
    }
    return combine_quotient(scale * sum);
}

static int32_t combine_channel(const combine_job *j, int i)
{
    const lmb_draw_combine *c = &j->stage->combine;
    const int32_t scale = 1 << c->shift[i == 3];
    const int32_t a = combine_argument(j, i, 0), b = combine_argument(j, i, 1);
    switch (c->func[i == 3]) {
    case LMB_DRAW_ARG:
        return scale * a;
    case LMB_DRAW_PRODUCT:
        return combine_quotient(scale * a * b);
    case LMB_DRAW_SUM:
        return scale * (a + b);
    case LMB_DRAW_SIGNED:
        return (maxi(scale * (2 * (a + b) - 255), 0) + 1) / 2;
    case LMB_DRAW_INTERPOLATE: {
        const int32_t share = combine_argument(j, i, 2);
        return combine_quotient(scale * (a * share + b * (255 - share)));
    }
    case LMB_DRAW_DIFFERENCE:
        return scale * (a - b);
    default:
        return combine_dot(j, scale);
    }
}

void lmb_draw_combine_codes(uint8_t inout[4], const lmb_draw_state *state, int stage, const uint8_t first[4],
                            const uint8_t texel[LMB_DRAW_STAGES][4])
{
    const uint8_t previous[4] = {inout[0], inout[1], inout[2], inout[3]};
    const combine_job j = {&state->stage[stage], first, previous, texel, stage};
    const int is_dot4 = j.stage->combine.func[0] == LMB_DRAW_DOT4;
    for (int i = 0; i < 4; ++i) {
        inout[i] = (uint8_t)clampi(combine_channel(&j, is_dot4 ? 0 : i), 0, 255);
    }
}
#endif
