/* key_path.c: reads a file of keys and interpolates between them. */
#include "key_path.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "io_file.h"
#include "io_text.h"
#include "option_value.h"

enum { WORD = 100 };
#define FAR_M 1e6f
#define LATEST_S 1e6

/* --- reading ------------------------------------------------------------------------------------------------------ */

/* The next token of the line as text. A token that is too long or no text ends with `?`. Returns 0 if none is left. */
static int take_word(char out[WORD], cursor *c)
{
    slice s;
    if (!text_token(&s, c)) {
        return 0;
    }
    const size_t n = s.size < WORD - 2 ? s.size : WORD - 2;
    const int is_whole = n == s.size && memchr(s.at, '\0', n) == NULL;
    memcpy(out, s.at, n);
    memcpy(out + n, is_whole ? "" : "?", is_whole ? 1 : 2);
    return 1;
}

static int is_near(float v) { return fabsf(v) <= FAR_M; }

static int read_place(lmb_vec3 *out, const char *word, cursor *c, report *r)
{
    return (option_vec3(word, out) && is_near(out->x) && is_near(out->y) && is_near(out->z)) ||
           text_fail(c, r, "`%s` is not X,Y,Z within 1,000,000 m", word);
}

/* `camera`, `light`, `light:2`, `object:5`. */
static int read_what(int *what, uint32_t *index, const char *word, cursor *c, report *r)
{
    static const struct {
        const char *name;
        int what;
    } things[] = {{"camera", KEY_CAMERA}, {"light", KEY_LIGHT}, {"object", KEY_OBJECT}};
    *index = 0;
    for (int i = 0; i < 3; ++i) {
        const size_t n = strlen(things[i].name);
        int32_t number = 0;
        if (strncmp(word, things[i].name, n) != 0 || (word[n] != '\0' && word[n] != ':')) {
            continue;
        }
        const int is_one = word[n] == '\0' ? things[i].what != KEY_OBJECT
                                           : things[i].what != KEY_CAMERA &&
                                                 option_int(word + n + 1, 0, 1 << 24, &number);
        *what = things[i].what;
        *index = (uint32_t)number;
        return is_one || text_fail(c, r, "`%s`: write camera, light, light:N or object:N, numbered from 0", word);
    }
    return text_fail(c, r, "`%s` moves nothing; write camera, light, light:N or object:N", word);
}

/* A key and the line that it is on. */
typedef struct key_line {
    path_key key;
    uint32_t track;
} key_line;

typedef struct reading {
    key_path *path;
    key_line *line;
    cursor c;
    double last_s[KEY_TRACKS];
    int has_target[KEY_TRACKS];
} reading;

/* The track of an item; creates it at the first key. */
static int find_track(uint32_t *out, reading *g, int what, uint32_t index, int has_target, report *r)
{
    key_path *p = g->path;
    for (*out = 0; *out < p->track_count; ++*out) {
        if (p->track[*out].what == what && p->track[*out].index == index) {
            return 1;
        }
    }
    if (p->track_count == KEY_TRACKS) {
        return text_fail(&g->c, r, "over %d things that move", KEY_TRACKS);
    }
    p->track[*out].what = what;
    p->track[*out].index = index;
    p->track[*out].line = g->c.line;
    g->last_s[*out] = -1.0;
    g->has_target[*out] = has_target;
    ++p->track_count;
    return 1;
}

/* TIME WHAT X,Y,Z [X,Y,Z]; the first token is read. */
static int read_key(reading *g, slice first, report *r)
{
    key_line *to = &g->line[g->path->key_count];
    char word[WORD];
    slice more;
    int what = 0;
    uint32_t index = 0;
    memset(to, 0, sizeof *to);
    if (!slice_number(&to->key.time_s, first) || !(to->key.time_s >= 0.0 && to->key.time_s <= LATEST_S)) {
        return text_fail(&g->c, r, "begins with no time, seconds, 0 .. 1,000,000");
    }
    if (!take_word(word, &g->c)) {
        return text_fail(&g->c, r, "a time alone; write TIME WHAT X,Y,Z [X,Y,Z]");
    }
    if (!read_what(&what, &index, word, &g->c, r)) {
        return 0;
    }
    if (!take_word(word, &g->c)) {
        return text_fail(&g->c, r, "no position behind what moves; write X,Y,Z");
    }
    if (!read_place(&to->key.at, word, &g->c, r)) {
        return 0;
    }
    to->key.has_target = take_word(word, &g->c);
    if (to->key.has_target && !read_place(&to->key.target, word, &g->c, r)) {
        return 0;
    }
    if (text_token(&more, &g->c)) {
        return text_fail(&g->c, r, "more than TIME WHAT X,Y,Z X,Y,Z on the line");
    }
    if (to->key.has_target && memcmp(&to->key.at, &to->key.target, sizeof to->key.at) == 0) {
        return text_fail(&g->c, r, "position and target are the same place");
    }
    if (!find_track(&to->track, g, what, index, to->key.has_target, r)) {
        return 0;
    }
    if (!(to->key.time_s > g->last_s[to->track])) {
        return text_fail(&g->c, r, "not later than the key before it of the same thing");
    }
    if (to->key.has_target != g->has_target[to->track]) {
        return text_fail(&g->c, r, "keys of one thing have a target each, or none; see line %u",
                         (unsigned)g->path->track[to->track].line);
    }
    g->last_s[to->track] = to->key.time_s;
    return 1;
}

static int read_lines(reading *g, report *r)
{
    slice first;
    do {
        if (!text_token(&first, &g->c)) {
            continue;
        }
        if (g->path->key_count == KEY_MOST) {
            return text_fail(&g->c, r, "over %d keys", KEY_MOST);
        }
        if (!read_key(g, first, r)) {
            return 0;
        }
        ++g->path->key_count;
    } while (text_next_line(&g->c));
    return 1;
}

/* Sorts keys by track, keeping their order. */
static void sort_keys(reading *g)
{
    key_path *p = g->path;
    uint32_t n = 0;
    for (uint32_t t = 0; t < p->track_count; ++t) {
        p->track[t].first = n;
        for (uint32_t i = 0; i < p->key_count; ++i) {
            if (g->line[i].track == t) {
                p->key[n++] = g->line[i].key;
            }
        }
        p->track[t].count = n - p->track[t].first;
    }
}

int key_path_read(key_path *out, const char *name, report *r)
{
    reading g;
    file_bytes file;
    memset(out, 0, sizeof *out);
    memset(&g, 0, sizeof g);
    if (!file_read(&file, name, r)) {
        return 0;
    }
    g.path = out;
    g.c = text_open(file.data, file.size, name);
    g.line = calloc(KEY_MOST, sizeof *g.line);
    out->key = calloc(KEY_MOST, sizeof *out->key);
    int ok = (g.line != NULL && out->key != NULL) || report_fail(r, "%s: not enough memory to read it", name);
    ok = ok && read_lines(&g, r) && (out->key_count > 0 || report_fail(r, "%s: no keys in it", name));
    if (ok) {
        sort_keys(&g);
    }
    free(g.line);
    file_free(&file);
    return ok;
}

void key_path_free(key_path *path)
{
    free(path->key);
    memset(path, 0, sizeof *path);
}

/* --- between keys ------------------------------------------------------------------------------------------------- */

static double component(const lmb_vec3 *v, int axis) { return (double)(axis == 0 ? v->x : axis == 1 ? v->y : v->z); }

static const lmb_vec3 *place_of(const path_key *k, int is_target) { return is_target ? &k->target : &k->at; }

/* Speed at key i, m/s: from the key before to the key after, if they exist. */
static double speed(const path_key *key, uint32_t count, uint32_t i, int is_target, int axis)
{
    const path_key *a = &key[i > 0 ? i - 1 : i], *b = &key[i + 1 < count ? i + 1 : i];
    const double time = b->time_s - a->time_s;
    return time > 0.0 ? (component(place_of(b, is_target), axis) - component(place_of(a, is_target), axis)) / time
                      : 0.0;
}

/* Between the keys i and i + 1 by Hermite's cubic. */
static float between(const path_key *key, uint32_t count, uint32_t i, double time_s, int is_target, int axis)
{
    const double span = key[i + 1].time_s - key[i].time_s, u = (time_s - key[i].time_s) / span, v = 1.0 - u;
    const double a = component(place_of(&key[i], is_target), axis),
                 b = component(place_of(&key[i + 1], is_target), axis);
    const double from = speed(key, count, i, is_target, axis) * span,
                 to = speed(key, count, i + 1, is_target, axis) * span;
    return (float)(v * v * (1.0 + 2.0 * u) * a + u * u * (1.0 + 2.0 * v) * b + u * v * (v * from - u * to));
}

path_key key_path_at(const key_path *path, const key_track *track, double time_s)
{
    const path_key *key = path->key + track->first;
    const uint32_t last = track->count - 1;
    uint32_t i = 0;
    if (!(time_s > key[0].time_s) || !(time_s < key[last].time_s)) {
        return key[time_s > key[0].time_s ? last : 0];
    }
    while (time_s >= key[i + 1].time_s) {
        ++i;
    }
    path_key out = key[i];
    out.time_s = time_s;
    out.at.x = between(key, track->count, i, time_s, 0, 0);
    out.at.y = between(key, track->count, i, time_s, 0, 1);
    out.at.z = between(key, track->count, i, time_s, 0, 2);
    if (out.has_target) {
        out.target.x = between(key, track->count, i, time_s, 1, 0);
        out.target.y = between(key, track->count, i, time_s, 1, 1);
        out.target.z = between(key, track->count, i, time_s, 1, 2);
    }
    return out;
}

double key_path_end(const key_path *path)
{
    double end = 0.0;
    for (uint32_t i = 0; i < path->key_count; ++i) {
        end = fmax(end, path->key[i].time_s);
    }
    return end;
}
