/* bench_slice.c: settings measured by a machine -> a slice's file -> the report of all machines. */
#include "bench_slice.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lambent/types.h>

#include "../picture/image.h"
#include "bench_front.h"
#include "bench_outputs.h"

static const bench_subject *const subjects[] = {&bench_render, &bench_relight, &bench_relief, &bench_mixed,
                                                &bench_figures};
enum { SUBJECTS = sizeof subjects / sizeof *subjects };

/* --- choice of settings ------------------------------------------------------------------------------------------- */

void bench_slice_deal(uint8_t is_own[BENCH_POINTS], slice s, const bench_task *task, int tasks)
{
    static double load[SLICE_MOST];
    memset(is_own, 0, BENCH_POINTS);
    memset(load, 0, sizeof load);
    uint8_t is_dealt[BENCH_POINTS] = {0};
    for (int n = 0; n < tasks; ++n) {
        int next = -1, to = 0;
        for (int i = 0; i < tasks; ++i) {
            next = !is_dealt[i] && (next < 0 || task[i].weight > task[next].weight) ? i : next;
        }
        for (int k = 1; k < s.count; ++k) {
            to = load[k] < load[to] ? k : to;
        }
        is_dealt[next] = 1;
        load[to] += task[next].weight;
        is_own[next] = s.count == 0 || to == s.number - 1;
    }
}

static uint64_t hash_text(uint64_t hash, const char *text) { return slice_hash(hash, text, strlen(text) + 1); }

static uint64_t hash_picture(uint64_t hash, const image *p)
{
    const int32_t size[2] = {p->width, p->height};
    return slice_hash(slice_hash(hash, size, sizeof size), p->pixels,
                      3 * sizeof *p->pixels * (size_t)p->width * (size_t)p->height);
}

/* Hashes options by words, and files by content instead of name. */
static uint64_t hash_given(uint64_t hash, const bench_options *o)
{
    for (int i = 0; i < o->given_count; ++i) {
        const option_row *row = o->given[i][0] == '-' ? options_find(o->subject->table, o->given[i]) : NULL;
        const int words = row != NULL ? options_words(row, o->given[i]) : 1;
        const int last = i + words <= o->given_count ? i + words - 1 : i;
        const int is_file = row == NULL || row->file == OPTION_READS;
        const char *inside = row != NULL && words == 1 ? strchr(o->given[i], '=') : NULL;
        report unheard = {""}; /* words that are not files affect the pictures, which are hashed, too */
        hash = row != NULL ? hash_text(hash, row->name) : hash;
        if (!is_file) {
            hash = hash_text(hash, inside != NULL ? inside + 1 : o->given[last]);
        } else {
            slice_hash_file(&hash, inside != NULL ? inside + 1 : o->given[last], &unheard);
        }
        i = last;
    }
    return hash;
}

uint64_t bench_slice_job(const sweep *s)
{
    static const uint32_t version = LMB_VERSION;
    uint64_t hash = hash_text(slice_hash(SLICE_HASH, &version, sizeof version), s->o->subject->verb), scene = 0;
    bench_line line;
    report unheard = {""};
    hash = hash_given(slice_hash(hash, &s->o->runs, sizeof s->o->runs), s->o);
    for (int i = 0; i < s->tasks; ++i) {
        hash = hash_text(hash, s->task[i].words);
    }
    if (s->o->subject->hash != NULL && sweep_line(&line, s, "", &unheard) &&
        s->o->subject->hash(&scene, &line, &unheard)) { /* including the files that the scene's file refers to */
        hash = slice_hash(hash, &scene, sizeof scene);
    }
    return hash_picture(hash_picture(hash, &s->truth.picture), &s->kept[0]);
}

/* --- writing ------------------------------------------------------------------------------------------------------ */

static void put_text(byte_buffer *b, const char *text)
{
    byte_put_int(b, (int32_t)strlen(text));
    byte_put(b, text, strlen(text));
}

static void put_picture(byte_buffer *b, const bench_picture *p)
{
    const int32_t width = p->rgb != NULL ? p->width : 0, height = p->rgb != NULL ? p->height : 0;
    byte_put_int(b, width);
    byte_put_int(b, height);
    byte_put(b, p->rgb, 3 * (size_t)width * (size_t)height);
}

static void put_point(byte_buffer *b, const bench_point *p)
{
    byte_put_int(b, p->number);
    put_text(b, p->option);
    put_text(b, p->name);
    put_text(b, p->command);
    put_text(b, p->failure);
    for (int i = 0; i < BENCH_STAGES; ++i) {
        byte_put_double(b, p->stage_s[i]);
    }
    byte_put_double(b, p->time_s);
    byte_put_double(b, p->instructions);
    byte_put_double(b, p->bytes);
    byte_put_double(b, p->work);
    for (int i = 0; i < BENCH_FIGURES; ++i) {
        byte_put_double(b, p->figure[i]);
    }
    byte_put_int(b, p->has_figures);
    byte_put_int(b, p->threads);
    byte_put_int(b, p->same);
    put_picture(b, &p->picture);
    put_picture(b, &p->heat);
}

static int subject_number(const bench_subject *s)
{
    int i = 0;
    while (i < SUBJECTS - 1 && subjects[i] != s) {
        ++i;
    }
    return i;
}

int bench_slice_write(const bench_options *o, const bench_results *b, report *r)
{
    char name[SLICE_NAME], about[SLICE_ABOUT];
    byte_buffer says = {NULL, 0, 0, 0};
    int32_t own = 0;
    for (int i = 0; i < b->count; ++i) {
        own += b->point[i].number >= 0;
    }
    snprintf(about, sizeof about, "bench %.160s, %d settings", b->title, b->settings);
    byte_put_int(&says, subject_number(o->subject));
    byte_put_int(&says, b->settings);
    put_text(&says, b->title);
    put_text(&says, b->truth);
    put_text(&says, b->computer);
    put_text(&says, b->how);
    byte_put_double(&says, b->seconds);
    put_picture(&says, &b->truth_picture);
    byte_put_int(&says, own);
    for (int i = 0; i < b->count; ++i) {
        if (b->point[i].number >= 0) {
            put_point(&says, &b->point[i]);
        }
    }
    const int ok = slice_name(name, o->out, o->slice, r) &&
                   slice_write(name, o->slice, SLICE_BENCH, b->job, about, &says, r);
    free(says.data);
    report_note(!ok || o->is_quiet, "%s: %d of %d settings", name, (int)own, b->settings);
    return ok;
}

/* --- reading ------------------------------------------------------------------------------------------------------ */

static int get_text(char *out, size_t size, byte_reader *s)
{
    const int32_t n = byte_get_int(s);
    const uint8_t *text = n >= 0 && (size_t)n < size ? byte_get(s, (size_t)n) : NULL;
    if (text == NULL) {
        s->is_short = 1;
        return 0;
    }
    memcpy(out, text, (size_t)n);
    out[n] = '\0';
    return 1;
}

/* With the size limits of bench_picture_of. */
static void get_picture(bench_picture *out, byte_reader *s)
{
    out->width = byte_get_int(s);
    out->height = byte_get_int(s);
    const int fits = out->width > 0 && out->height > 0 && out->width <= 4096 && out->height <= 4096;
    const size_t size = fits ? 3 * (size_t)out->width * (size_t)out->height : 0;
    const uint8_t *data = fits ? byte_get(s, size) : NULL;
    out->rgb = data != NULL ? malloc(size) : NULL;
    if (out->rgb != NULL) {
        memcpy(out->rgb, data, size);
    }
}

static void get_point(bench_point *p, byte_reader *s)
{
    get_text(p->option, sizeof p->option, s);
    get_text(p->name, sizeof p->name, s);
    get_text(p->command, sizeof p->command, s);
    get_text(p->failure, sizeof p->failure, s);
    for (int i = 0; i < BENCH_STAGES; ++i) {
        p->stage_s[i] = byte_get_double(s);
    }
    p->time_s = byte_get_double(s);
    p->instructions = byte_get_double(s);
    p->bytes = byte_get_double(s);
    p->work = byte_get_double(s);
    for (int i = 0; i < BENCH_FIGURES; ++i) {
        p->figure[i] = byte_get_double(s);
    }
    p->has_figures = byte_get_int(s);
    p->threads = byte_get_int(s);
    p->same = byte_get_int(s);
    get_picture(&p->picture, s);
    get_picture(&p->heat, s);
}

/* Sets up the data that all slices share, from the first one, with room for all points. */
static int begin(bench_results *b, int subject, int settings)
{
    bench_results_about(b, subjects[subject]);
    b->settings = settings;
    for (int i = 0; i < settings; ++i) {
        bench_point *p = bench_results_add(b);
        if (p == NULL) {
            return 0;
        }
        p->number = -1;
    }
    return 1;
}

/* Reads the head of slice i of `set`: sweep and machine. Pictures are the same on all machines; times are not. */
static int get_head(bench_results *b, byte_reader *s, const slice_set *set, int32_t i, int is_quiet)
{
    const int is_first = i == 0;
    static bench_results own; /* the head of a later slice */
    static char first[sizeof own.computer];
    bench_results *to = is_first ? b : &own;
    const int subject = byte_get_int(s), settings = byte_get_int(s);
    if (subject < 0 || subject >= SUBJECTS || settings < 1 || settings > BENCH_POINTS ||
        (is_first ? !begin(b, subject, settings) : settings != b->settings)) {
        return 0;
    }
    get_text(to->title, sizeof to->title, s);
    get_text(to->truth, sizeof to->truth, s);
    get_text(to->computer, sizeof to->computer, s);
    get_text(to->how, sizeof to->how, s);
    const double seconds = byte_get_double(s);
    get_picture(&to->truth_picture, s);
    if (!is_first) {
        b->seconds += seconds;
        if (strcmp(first, own.computer) != 0) {
            report_note(is_quiet,
                        "%s: measured by %s, and %s by %s: times of one do not compare with those of the other",
                        set->path[i], own.computer, set->path[0], first);
            snprintf(b->computer, sizeof b->computer, "several unlike computers");
        }
        bench_results_free(&own);
    } else {
        b->seconds = seconds;
        memcpy(first, b->computer, sizeof first);
    }
    return !s->is_short;
}

static int get_points(bench_results *b, byte_reader *s)
{
    for (int32_t left = byte_get_int(s); left > 0; --left) {
        const int32_t i = byte_get_int(s);
        if (s->is_short || i < 0 || i >= b->count || b->point[i].number >= 0) {
            return 0;
        }
        b->point[i].number = i;
        get_point(&b->point[i], s);
    }
    return !s->is_short && s->at == s->end;
}

static int get_all(bench_results *b, const slice_set *set, int is_quiet, report *r)
{
    int ok = 1;
    for (int32_t i = 0; ok && i < set->count; ++i) {
        slice_file file;
        ok = slice_read(&file, set->path[i], r) &&
             ((get_head(b, &file.says, set, i, is_quiet) && get_points(b, &file.says)) ||
              report_fail(r, "%s: damaged", set->path[i]));
        slice_file_free(&file);
    }
    for (int i = 0; ok && i < b->count; ++i) {
        ok = b->point[i].number >= 0 || report_fail(r, "%s: setting %d is in no slice", set->about, i + 1);
    }
    return ok;
}

int bench_slice_merge(const char *path, const slice_set *set, int is_quiet, report *r)
{
    bench_results b;
    memset(&b, 0, sizeof b);
    int ok = get_all(&b, set, is_quiet, r);
    if (ok) {
        bench_front(&b);
        ok = bench_output(path, &b, r);
    }
    bench_results_free(&b);
    return ok;
}
