/* pack_texture.c: chooses each texture's format; writes records of textures and materials. */
#include <stdlib.h>
#include <string.h>

#include "pack.h"

/* How materials use a texture. */
enum { USED = 1, AS_VECTOR = 2, WITH_ALPHA = 4 };

static void mark(uint8_t *use, const lmb_scene *s)
{
    for (uint32_t i = 0; i < s->material_count; ++i) {
        const lmb_material *m = &s->materials[i];
        if (m->texture >= 0) {
            use[m->texture] |= (m->flags & LMB_ALPHA_MASK) != 0 ? USED | WITH_ALPHA : USED;
        }
        if (m->normal_scale != 0.0f) {
            use[m->normal_map] |= USED | AS_VECTOR;
        }
        if (m->emission_map > 0) {
            use[m->emission_map - 1] |= USED;
        }
        if (m->metal_map > 0) {
            use[m->metal_map - 1] |= USED | AS_VECTOR;
        }
    }
}

/* Can texels with this use have that format? */
static int may_be(int use, int format)
{
    return (use & AS_VECTOR) == 0 && (format != LMB_TEXELS_RGB565 || (use & WITH_ALPHA) == 0);
}

/* Encodes in the smallest format with an error within the bound, or in the requested one, at the end of `out`. Returns
 * the error, or a negative number if memory is short. */
static double encode(pack_buffer *out, int *format, const lmb_texture *t, int use, const pack_settings *set)
{
    static const int order[] = {LMB_TEXELS_PALETTE4, LMB_TEXELS_RGB565};
    static const int asked[] = {-1, LMB_TEXELS_RGBA8, LMB_TEXELS_RGB565, LMB_TEXELS_PALETTE4};
    const size_t before = out->size;
    for (int i = 0; i < 2 && t->format == LMB_TEXELS_RGBA8; ++i) {
        if (!may_be(use, order[i]) || (set->textures != PACK_AUTO && asked[set->textures] != order[i])) {
            continue;
        }
        const double error = pack_encode(out, t, order[i], (use & WITH_ALPHA) != 0);
        if (error < 0.0 || set->textures != PACK_AUTO || error <= set->texture_error) {
            *format = order[i];
            return error;
        }
        out->size = before;
    }
    *format = t->format;
    pack_put(out, t->texels, lmb_texture_format_bytes(t->format, t->width, t->height, t->levels));
    return 0.0;
}

static void put_record(pack_buffer *to, const lmb_texture *t, uint32_t place, int format)
{
    pack_word(to, place);
    pack_word(to, (uint32_t)t->width | (uint32_t)t->height << 16);
    pack_word(to, (uint32_t)t->levels | (uint32_t)format << 8 | (uint32_t)t->wrap_s << 16 | (uint32_t)t->wrap_t << 24);
    pack_word(to, t->filter);
}

/* Do both have the same texels and use? */
static int is_same(const lmb_texture *a, int use_a, const lmb_texture *b, int use_b)
{
    return a->texels == b->texels && a->width == b->width && a->height == b->height && a->levels == b->levels &&
           use_a == use_b;
}

int pack_textures(pack *out, uint32_t *slot, const lmb_scene *s, const pack_settings *set, report *r)
{
    pack_buffer *texels = &out->part[LMB_PACK_TEXELS], *records = &out->part[LMB_PACK_TEXTURES];
    uint8_t *use = calloc((size_t)s->texture_count + 1, 1);
    uint32_t *place = calloc((size_t)s->texture_count + 1, sizeof *place), count = 0;
    int *format = calloc((size_t)s->texture_count + 1, sizeof *format);
    int ok = use != NULL && place != NULL && format != NULL;
    if (ok) {
        mark(use, s);
    }
    for (uint32_t i = 0; ok && i < s->texture_count; ++i) {
        const lmb_texture *t = &s->textures[i];
        slot[i] = UINT32_MAX;
        if (use[i] == 0) {
            continue;
        }
        for (uint32_t k = 0; k < i && place[i] == 0; ++k) {
            if (place[k] != 0 && is_same(&s->textures[k], use[k], t, use[i])) {
                place[i] = place[k];
                format[i] = format[k];
            }
        }
        if (place[i] == 0) {
            place[i] = pack_place(texels);
            const double error = encode(texels, &format[i], t, use[i], set);
            ok = error >= 0.0;
            out->lost.texture = error > out->lost.texture ? error : out->lost.texture;
            ++out->lost.textures[format[i]];
        }
        put_record(records, t, place[i], format[i]);
        slot[i] = count++;
    }
    free(use);
    free(place);
    free(format);
    return ok || report_fail(r, "not enough memory for %u textures", (unsigned)s->texture_count);
}
