/* pack_motion.c: a model's animations -> nodes, tracks and keys for the objects, lights and cameras they move. */
#include <stdlib.h>
#include <string.h>

#include "../model/model_motion.h"
#include "pack.h"

/* Marks a node and its ancestors. Returns 0 if there are more than LMB_PACK_MOST_ABOVE. */
static int mark_above(uint8_t *used, const struct model_motion *m, uint32_t node)
{
    uint32_t above = 0;
    for (; node != MODEL_NONE; node = m->parent[node], ++above) {
        used[node] = 1;
    }
    return above <= LMB_PACK_MOST_ABOVE + 1;
}

/* Sets the node of each moving item, LMB_PACK_NONE for others. Returns 0 if a node has too many ancestors. */
static int mark(uint8_t *used, uint32_t *node_of, const uint32_t *node, uint32_t count, const struct model_motion *m)
{
    int ok = 1;
    for (uint32_t i = 0; i < count; ++i) {
        node_of[i] = node[i] != MODEL_NONE && m->moves[node[i]] ? node[i] : LMB_PACK_NONE;
        ok &= node_of[i] == LMB_PACK_NONE || mark_above(used, m, node[i]);
    }
    return ok;
}

static void renumber(uint32_t *node_of, uint32_t count, const uint32_t *number)
{
    for (uint32_t i = 0; i < count; ++i) {
        node_of[i] = node_of[i] != LMB_PACK_NONE ? number[node_of[i]] : LMB_PACK_NONE;
    }
}

static void put_rest(pack_buffer *to, const model_local *l)
{
    for (int i = 0; i < 12 && l->is_matrix; ++i) {
        pack_float(to, (float)l->matrix[i / 3 * 4 + i % 3]);
    }
    if (l->is_matrix) {
        return;
    }
    for (int i = 0; i < 3; ++i) {
        pack_float(to, (float)l->t[i]);
    }
    for (int i = 0; i < 4; ++i) {
        pack_float(to, (float)l->q[i]);
    }
    for (int i = 0; i < 3; ++i) {
        pack_float(to, (float)l->s[i]);
    }
    pack_words(to, 2, 0);
}

/* Writes a track's times; tracks with equal times share them. */
static uint32_t put_times(pack_buffer *keys, const struct model_motion *m, uint32_t track, uint32_t *place)
{
    const model_track *t = &m->track[track];
    for (uint32_t i = 0; i < track; ++i) {
        if (place[i] != 0 && m->track[i].count == t->count &&
            memcmp(m->track[i].time, t->time, t->count * sizeof *t->time) == 0) {
            return place[i];
        }
    }
    const uint32_t at = pack_place(keys);
    for (uint32_t i = 0; i < t->count; ++i) {
        pack_float(keys, t->time[i]);
    }
    return at;
}

static void put_track(pack *out, const struct model_motion *m, uint32_t track, uint32_t *place)
{
    pack_buffer *to = &out->part[LMB_PACK_TRACKS], *keys = &out->part[LMB_PACK_KEYS];
    const model_track *t = &m->track[track];
    const size_t floats = (size_t)t->count * (t->what == MODEL_ROTATION ? 4 : 3) * (t->between == MODEL_CUBIC ? 3 : 1);
    pack_word(to, (uint32_t)t->what | (uint32_t)t->between << 8);
    pack_word(to, t->count);
    place[track] = put_times(keys, m, track, place);
    pack_word(to, place[track]);
    pack_word(to, pack_place(keys));
    for (size_t i = 0; i < floats; ++i) {
        pack_float(keys, t->value[i]);
    }
}

static void put_nodes(pack *out, const struct model_motion *m, const uint8_t *used, uint32_t *number, uint32_t *place)
{
    pack_buffer *to = &out->part[LMB_PACK_NODES];
    for (uint32_t i = 0, track = 0, count = 0, tracks = 0; i < m->nodes; ++i) {
        const uint32_t first = tracks;
        for (; track < m->tracks && m->track[track].node == i; ++track) {
            if (used[i]) {
                put_track(out, m, track, place);
                ++tracks;
            }
        }
        if (used[i]) {
            number[i] = count++;
            pack_word(to, m->parent[i] == MODEL_NONE ? LMB_PACK_NONE : number[m->parent[i]]);
            pack_word(to, first);
            pack_word(to, tracks - first);
            pack_word(to, m->rest[i].is_matrix ? 1 : 0);
            put_rest(to, &m->rest[i]);
        }
    }
}

/* If only skins and morph targets move, which are not packed, adds a node that moves nothing. So `play` finds that the
 * file had animations, and adds no default motion. */
static void put_still_node(pack *out, const struct model_motion *m, const uint8_t *used)
{
    pack_buffer *to = &out->part[LMB_PACK_NODES];
    model_local still;
    if (m->shapes == NULL || (m->nodes > 0 && memchr(used, 1, m->nodes) != NULL)) {
        return;
    }
    memset(&still, 0, sizeof still);
    still.q[3] = still.s[0] = still.s[1] = still.s[2] = 1.0;
    pack_word(to, LMB_PACK_NONE);
    pack_words(to, 3, 0);
    put_rest(to, &still);
}

int pack_motion(pack *out, const model *m, uint32_t *node_of_instance, uint32_t *node_of_light,
                uint32_t *node_of_camera, report *r)
{
    const struct model_motion *motion = m->motion;
    const lmb_scene *s = &m->scene;
    memset(node_of_instance, 255, s->instance_count * sizeof *node_of_instance);
    memset(node_of_light, 255, s->light_count * sizeof *node_of_light);
    memset(node_of_camera, 255, m->camera_count * sizeof *node_of_camera);
    if (motion == NULL) {
        return 1;
    }
    uint8_t *used = calloc((size_t)motion->nodes + 1, 1);
    uint32_t *number = calloc((size_t)motion->nodes + motion->tracks + 1, sizeof *number);
    int ok =
        (used != NULL && number != NULL) || report_fail(r, "not enough memory for %u nodes", (unsigned)motion->nodes);
    if (ok) {
        ok = (mark(used, node_of_instance, motion->of_instance, s->instance_count, motion) &
              mark(used, node_of_light, motion->of_light, s->light_count, motion) &
              mark(used, node_of_camera, motion->of_camera, m->camera_count, motion)) ||
             report_fail(r, "more than %d nodes are above one that moves; join some", LMB_PACK_MOST_ABOVE);
    }
    if (ok) {
        put_nodes(out, motion, used, number, number + motion->nodes);
        put_still_node(out, motion, used);
        renumber(node_of_instance, s->instance_count, number);
        renumber(node_of_light, s->light_count, number);
        renumber(node_of_camera, m->camera_count, number);
    }
    free(used);
    free(number);
    return ok;
}
