/* mix_placements.c: `lambent mix --placements`: many pictures of one photo, from a list of objects and places. */
#include "mix_swift.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/host.h"
#include "../common/option_value.h"
#include "../common/progress.h"
#include "../picture/picture.h"
#include "mix_lobes.h"
#include "mix_run.h"
#include "mix_turn.h"

enum { ROWS_MAX = 100000, THINGS_MAX = 1024, WORDS = 5, NAME_MAX_BYTES = 4096 };

#define FIT_SIZE (-1.0f)
#define MAX_BEND 0.05f /* m: a larger gap is a step next to the foot */

/* A line of the list. */
typedef struct list_row {
    char *out, *mesh;
    int32_t line, thing, at, on; /* at, on: as in mix_options */
    float px[2], turn, size;     /* size: m; 0: the mesh's own, FIT_SIZE: chosen */
    float scale;                 /* of the command line: m per unit of the mesh; 0: by `size` */
} list_row;

typedef struct placements {
    mix_job *j;
    const char *path; /* "--object": the command line has the objects */
    int is_line;      /* likewise */
    char *folder; /* of the list, "" or ending with a slash */
    list_row *row;
    int32_t count, cap;
    mix_thing *thing;
    int32_t things;
    mix_spot *spot; /* by row */
    int32_t *first; /* by picture: its first row; one more at the end */
    int32_t pictures;
    mix_swift swift;
    mix_swift_desk *desk[POOL_MAX];
    report failed[POOL_MAX];
    int32_t failed_at[POOL_MAX]; /* picture */
    double began, first_done;
} placements;

static int fail_row(const placements *p, const list_row *row, report *r, const char *what)
{
    return row->mesh != NULL && p->is_line ? report_fail(r, "--object %s: %s", row->mesh, what)
                                           : report_fail(r, "%s: line %d: %s", p->path, (int)row->line, what);
}

/* --- words -------------------------------------------------------------------------------------------------------- */

static int is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/* The next word of a line, or NULL with *at at the end; `"` quotes blanks. Returns 0 if a quote is not closed. */
static int next_word(char **word, char **at)
{
    char *p = *at;
    while (is_blank(*p)) {
        ++p;
    }
    *word = *p != '\0' ? p : NULL;
    if (*p == '"') {
        *word = ++p;
        while (*p != '"') {
            if (*p++ == '\0') {
                return 0;
            }
        }
        if (p[1] != '\0' && !is_blank(p[1])) {
            return 0;
        }
    } else {
        while (*p != '\0' && !is_blank(*p)) {
            ++p;
        }
    }
    *at = *p != '\0' ? p + 1 : p;
    *p = '\0';
    return 1;
}

static char *joined_after(const char *first, const char *then)
{
    const size_t a = strlen(first), b = strlen(then);
    char *out = malloc(a + b + 1);
    if (out != NULL) {
        memcpy(out, first, a);
        memcpy(out + a, then, b + 1);
    }
    return out;
}

static char *joined(const char *folder, const char *name) { return joined_after(name[0] == '/' ? "" : folder, name); }

/* Leaves out `.` and empty parts, which name the same file: x/./y and x//y become x/y. */
static void tidy(char *name)
{
    char *to = name;
    for (const char *from = name; *from != '\0';) {
        const size_t n = strcspn(from, "/");
        const int is_last = from[n] == '\0', is_needless = !is_last && from != name && n == 0;
        if (!is_needless && !(n == 1 && from[0] == '.' && !is_last)) {
            memmove(to, from, n + !is_last);
            to += n + !is_last;
        }
        from += n + !is_last;
    }
    *to = '\0';
}

/* Does a name stay in the list's folder? */
static int is_below(const char *name)
{
    for (const char *p = name;;) {
        const char *slash = strchr(p, '/');
        if (p[0] == '.' && p[1] == '.' && (p[2] == '/' || p[2] == '\0')) {
            return 0;
        }
        if (slash == NULL) {
            return name[0] != '/';
        }
        p = slash + 1;
    }
}

static int parse_place(list_row *row, const char *word)
{
    static const char *const ons[] = {"any", "floor", "table", "wall", NULL};
    static const int32_t values[] = {MIX_ON_ANY, MIX_ON_FLOOR, MIX_ON_TABLE, MIX_ON_WALL};
    if (option_word(word, ons, values, &row->on)) {
        return 1;
    }
    if (strcmp(word, "world") == 0) {
        row->at = MIX_AT_WORLD;
        return 1;
    }
    row->at = MIX_AT_PIXEL;
    return option_floats(&word, row->px, 2) && *word == '\0';
}

static int parse_size(list_row *row, const char *word)
{
    if (strcmp(word, "-") == 0) {
        return 1;
    }
    if (strcmp(word, "fit") == 0) {
        row->size = FIT_SIZE;
        return 1;
    }
    return option_number(word, 1e-6f, 1e6f, &row->size);
}

static int set_row(placements *p, list_row *row, char *const word[WORDS], report *r)
{
    if (word[2] == NULL) {
        return fail_row(p, row, r, "write OUT MESH PLACE [TURN [SIZE]]");
    }
    tidy(word[0]);
    if (!is_below(word[0])) {
        return fail_row(p, row, r, "OUT leads out of the list's folder");
    }
    if (picture_format(word[0]) == PICTURE_UNKNOWN || file_is_stdout(word[0])) {
        return fail_row(p, row, r, "OUT is no name ending in .png, .ppm, .pfm or .hdr");
    }
    if (!parse_place(row, word[2])) {
        return fail_row(p, row, r, "PLACE is no X,Y, any, floor, table, wall or world");
    }
    if (word[3] != NULL && !option_number(word[3], -3600.0f, 3600.0f, &row->turn)) {
        return fail_row(p, row, r, "TURN is no number of degrees, -3600 .. 3600");
    }
    if (word[3] != NULL && word[4] != NULL && !parse_size(row, word[4])) {
        return fail_row(p, row, r, "SIZE is no number of metres, 0.000001 .. 1000000, fit or -");
    }
    if (row->at == MIX_AT_WORLD && (row->turn != 0.0f || row->size != 0.0f)) {
        return fail_row(p, row, r, "PLACE world has the mesh's own turn and size");
    }
    const lmb_pinhole *c = &p->j->frame.camera;
    if (row->at == MIX_AT_PIXEL &&
        !(row->px[0] >= 0.0f && row->px[1] >= 0.0f && row->px[0] < (float)c->width && row->px[1] < (float)c->height)) {
        return report_fail(r, "%s: line %d: PLACE %s: the photo has %d x %d pixels", p->path, (int)row->line, word[2],
                           (int)c->width, (int)c->height);
    }
    row->out = joined(p->folder, word[0]);
    row->mesh = joined(p->folder, word[1]);
    return (row->out != NULL && row->mesh != NULL) || report_fail(r, "%s: out of memory", p->path);
}

static int read_line(placements *p, char *text, int32_t line, report *r)
{
    char *word[WORDS] = {NULL, NULL, NULL, NULL, NULL}, *more = NULL;
    const list_row here = {.line = line, .thing = -1};
    for (int i = 0; i <= WORDS; ++i) {
        if (!next_word(i < WORDS ? &word[i] : &more, &text)) {
            return fail_row(p, &here, r, "a quote is not closed before a blank");
        }
    }
    if (word[0] == NULL || word[0][0] == '#') {
        return 1;
    }
    if (more != NULL) {
        return fail_row(p, &here, r, "more than OUT MESH PLACE TURN SIZE; quote names with blanks");
    }
    if (p->count == ROWS_MAX) {
        return fail_row(p, &here, r, "over 100000 lines");
    }
    if (p->count == p->cap) {
        p->cap = p->cap > 0 ? 2 * p->cap : 64;
        list_row *grown = realloc(p->row, (size_t)p->cap * sizeof *grown);
        if (grown == NULL) {
            return report_fail(r, "%s: out of memory", p->path);
        }
        p->row = grown;
    }
    p->row[p->count] = here;
    return set_row(p, &p->row[p->count++], word, r);
}

static int read_list(placements *p, report *r)
{
    file_bytes file;
    const char *slash = strrchr(p->path, '/');
    const size_t n = slash != NULL ? (size_t)(slash - p->path) + 1 : 0;
    p->folder = calloc(n + 1, 1);
    if (p->folder == NULL || !file_read(&file, p->path, r)) {
        return report_fail(r, "%s: out of memory", p->path);
    }
    memcpy(p->folder, p->path, n);
    const list_row first = {.line = 1};
    char *text = malloc(file.size + 1), *at = text;
    int ok = text != NULL ? memchr(file.data, 0, file.size) == NULL || fail_row(p, &first, r, "is no text")
                          : report_fail(r, "%s: out of memory", p->path);
    if (text != NULL) {
        memcpy(text, file.data, file.size);
        text[file.size] = '\0';
    }
    for (int32_t line = 1; ok && at != NULL; ++line) {
        char *end = strchr(at, '\n');
        if (end != NULL) {
            *end = '\0';
        }
        ok = (end != NULL ? (size_t)(end - at) : strlen(at)) < 2 * NAME_MAX_BYTES
                 ? read_line(p, at, line, r)
                 : report_fail(r, "%s: line %d: too long", p->path, (int)line);
        at = end != NULL ? end + 1 : NULL;
    }
    free(text);
    file_free(&file);
    return ok && (p->count > 0 || report_fail(r, "%s: no placement in it", p->path));
}

/* The objects of the command line, in one picture. */
static int take_line(placements *p, report *r)
{
    const mix_options *o = &p->j->o;
    const lmb_pinhole *c = &p->j->frame.camera;
    p->folder = calloc(1, 1);
    p->row = calloc((size_t)o->objects, sizeof *p->row);
    if (p->folder == NULL || p->row == NULL) {
        return report_fail(r, "%s: out of memory", p->path);
    }
    for (int32_t i = 0; i < o->objects; ++i) {
        list_row *row = &p->row[p->count++];
        const mix_at *at = &o->at_of[i];
        row->thing = -1;
        row->at = at->at;
        memcpy(row->px, at->px, sizeof row->px);
        row->turn = o->turn_of[o->turns > 1 ? i : 0];
        row->size = o->fit ? FIT_SIZE : 0.0f;
        row->scale = o->scale_of[o->scales > 1 ? i : 0];
        row->out = joined("", o->out);
        row->mesh = joined("", o->object_of[i]);
        if (row->out == NULL || row->mesh == NULL) {
            return report_fail(r, "%s: out of memory", p->path);
        }
        if (at->at == MIX_AT_PIXEL && !(at->px[0] >= 0.0f && at->px[1] >= 0.0f && at->px[0] < (float)c->width &&
                                        at->px[1] < (float)c->height)) {
            return report_fail_usage(r, "--at %g,%g: the photo has %d x %d pixels", (double)at->px[0],
                                     (double)at->px[1], (int)c->width, (int)c->height);
        }
    }
    return 1;
}

/* --- pictures ----------------------------------------------------------------------------------------------------- */

static int by_name(const void *a, const void *b)
{
    const list_row *const *x = a, *const *y = b;
    const int order = strcmp((*x)->out, (*y)->out);
    return order != 0 ? order : ((*x)->line > (*y)->line) - ((*x)->line < (*y)->line);
}

/* Groups successive lines, and refuses a name that returns later. */
static int find_pictures(placements *p, report *r)
{
    const list_row **order = malloc((size_t)p->count * sizeof *order);
    p->first = malloc(((size_t)p->count + 1) * sizeof *p->first);
    if (order == NULL || p->first == NULL) {
        free(order);
        return report_fail(r, "%s: out of memory", p->path);
    }
    int ok = 1;
    for (int32_t i = 0; i < p->count; ++i) {
        order[i] = &p->row[i];
        if (i == 0 || strcmp(p->row[i].out, p->row[i - 1].out) != 0) {
            p->first[p->pictures++] = i;
        }
        if (ok && i - p->first[p->pictures - 1] >= MIX_TOGETHER) {
            ok = fail_row(p, &p->row[i], r, "over 16 objects in one picture");
        }
    }
    p->first[p->pictures] = p->count;
    qsort(order, (size_t)p->count, sizeof *order, by_name);
    for (int32_t i = 1; i < p->count && ok; ++i) {
        if (strcmp(order[i]->out, order[i - 1]->out) == 0 && order[i] != order[i - 1] + 1) {
            ok = report_fail(r, "%s: line %d: OUT is that of line %d, and other lines are between", p->path,
                             (int)order[i]->line, (int)order[i - 1]->line);
        }
    }
    free(order);
    return ok;
}

static void label_name(char *out, size_t size, const placements *p, int32_t picture)
{
    const char *name = p->row[p->first[picture]].out + strlen(p->folder), *dot = strrchr(name, '.');
    snprintf(out, size, "%s%.*s", p->j->o.labels, p->is_line ? 0 : (int)(dot - name), name);
}

static const char *const endings[] = {".mask.png", ".depth.pfm", ".normal.pfm", ".object.png", ".pose.json"};

/* A file that a picture writes. */
typedef struct written {
    char *name;
    int32_t line;
} written;

static int by_written(const void *a, const void *b)
{
    const written *x = a, *y = b;
    const int order = strcmp(x->name, y->name);
    return order != 0 ? order : (x->line > y->line) - (x->line < y->line);
}

/* Refuses labels of one picture that would replace a file of another one, as those of a.png and a.pfm. */
static int labels_differ(const placements *p, report *r)
{
    enum { FILES = 6 };
    char name[2 * NAME_MAX_BYTES];
    written *all = p->j->o.labels != NULL ? calloc((size_t)p->pictures * FILES, sizeof *all) : NULL;
    int ok = p->j->o.labels == NULL || all != NULL;
    int32_t n = 0;
    for (int32_t i = 0; ok && all != NULL && i < p->pictures; ++i) {
        const list_row *row = &p->row[p->first[i]];
        label_name(name, sizeof name, p, i);
        for (int k = 0; k < FILES && ok; ++k) {
            all[n].line = row->line;
            all[n].name = joined_after(k == 0 ? row->out : name, k == 0 ? "" : endings[k - 1]);
            ok = all[n++].name != NULL;
        }
    }
    if (!ok) {
        report_fail(r, "%s: out of memory", p->path);
    } else if (all != NULL) {
        qsort(all, (size_t)n, sizeof *all, by_written);
    }
    for (int32_t i = 1; i < n && ok; ++i) {
        if (strcmp(all[i].name, all[i - 1].name) == 0) {
            ok = report_fail(r, "%s: line %d: %s is a file of line %d, too", p->path, (int)all[i].line, all[i].name,
                             (int)all[i - 1].line);
        }
    }
    for (int32_t i = 0; i < n; ++i) {
        free(all[i].name);
    }
    free(all);
    return ok;
}

static int can_write(const placements *p, report *r)
{
    int ok = 1;
    for (int32_t i = 0; ok && i < p->pictures; ++i) {
        char name[2 * NAME_MAX_BYTES], whole[2 * NAME_MAX_BYTES + 16];
        report own = {""};
        ok = p->is_line || file_can_write(p->row[p->first[i]].out, &own); /* options_files has checked -o */
        if (ok && p->j->o.labels != NULL) {
            label_name(name, sizeof name, p, i);
            for (int k = 0; ok && k < 5; ++k) {
                snprintf(whole, sizeof whole, "%s%s", name, endings[k]);
                ok = k == 0 ? file_can_write(whole, &own) : file_may_replace(whole, &own);
            }
        }
        if (!ok) {
            fail_row(p, &p->row[p->first[i]], r, own.text);
        }
    }
    return ok;
}

/* --- meshes ------------------------------------------------------------------------------------------------------- */

static int load(mix_thing *t, const placements *p, const list_row *row, report *r)
{
    model_notes notes = {.count = 0};
    report own = {""};
    mix_job *j = p->j;
    if ((!p->is_line && !file_is_below(row->mesh, p->folder, strlen(p->folder), &own)) ||
        !model_load_as(&t->object, row->mesh, &j->o.choice, &notes, &own)) {
        return p->is_line ? report_fail(r, "%s", own.text) : fail_row(p, row, r, own.text);
    }
    model_tell(&notes, row->mesh, MODEL_NOTE_OPTION);
    t->path = row->mesh;
    const model was = j->object;
    j->object = t->object;
    mix_lobes_read(j);
    t->object = j->object;
    j->object = was;
    return mix_block_make(&t->block, &t->object.scene) || report_fail(r, "%s: out of memory", row->mesh);
}

static int load_meshes(placements *p, report *r)
{
    p->thing = calloc(THINGS_MAX, sizeof *p->thing);
    if (p->thing == NULL) {
        return report_fail(r, "%s: out of memory", p->path);
    }
    for (int32_t i = 0; i < p->count; ++i) {
        list_row *row = &p->row[i];
        for (int32_t k = 0; k < p->things && row->thing < 0; ++k) {
            row->thing = strcmp(p->thing[k].path, row->mesh) == 0 ? k : -1;
        }
        if (row->thing < 0) {
            if (p->things == THINGS_MAX) {
                return fail_row(p, row, r, "over 1024 meshes");
            }
            row->thing = p->things;
            if (!load(&p->thing[p->things++], p, row, r)) {
                return 0;
            }
        }
    }
    return 1;
}

/* --- places ------------------------------------------------------------------------------------------------------- */

/* Moves the foot onto the surface measured there. The plane stays for other placements; mix_swift.c moves its
 * pixels. */
static float touch(mix_job *j, report *r)
{
    float lift = 0.0f;
    for (int i = 0; i < 3 && j->floor >= 0; ++i) {
        const float gap = mix_gap(j, r);
        if (fabsf(gap) <= MAX_BEND) {
            const float dq = 1.0f / (gap - j->anchor.z) + 1.0f / j->anchor.z, by = 1.0f / (1.0f - j->anchor.z * dq);
            j->anchor = (lmb_vec3){j->anchor.x * by, j->anchor.y * by, j->anchor.z * by};
            lift += dq;
        }
    }
    return lift;
}

/* An object in the world of the poses: finds its foot, in camera space, and the plane under it if there is one. */
static void put_in_world(mix_job *one)
{
    const lmb_vec3 low = one->object.scene.bounds_min, high = one->object.scene.bounds_max,
                   foot = {0.5f * (low.x + high.x), low.y, 0.5f * (low.z + high.z)}, up = {0, 1, 0};
    const lmb_mat4 camera = mix_camera_of(one);
    const lmb_vec3 n = mix_turn(&camera, up);
    one->anchor = mix_move(&camera, foot);
    one->scale = 1.0f;
    for (int32_t i = 0; i < one->planes.count && one->floor < 0; ++i) {
        const lmb_flat *f = &one->planes.plane[i];
        const float off = f->normal.x * one->anchor.x + f->normal.y * one->anchor.y + f->normal.z * one->anchor.z +
                          f->distance;
        const int faces = f->normal.x * n.x + f->normal.y * n.y + f->normal.z * n.z > 0.985f;
        one->floor = faces && fabsf(off) < MAX_BEND ? i : -1;
    }
}

/* Notes an object of the command line that fills the picture or vanishes, by the corners of the box around it.
 * `there`: from the object to the camera. */
static void tell_size(const placements *p, const mix_job *one, const lmb_mat4 *there, const char *mesh)
{
    const lmb_vec3 low = one->object.scene.bounds_min, high = one->object.scene.bounds_max;
    const lmb_pinhole *c = &one->frame.camera;
    float from[2] = {INFINITY, INFINITY}, to[2] = {-INFINITY, -INFINITY};
    int is_behind = 0;
    for (int i = 0; i < 8; ++i) {
        const lmb_vec3 corner = {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z},
                       at = mix_move(there, corner);
        const float px[2] = {c->fx * at.x / -at.z, c->fy * at.y / -at.z};
        is_behind |= !(at.z < 0.0f);
        for (int k = 0; k < 2; ++k) {
            from[k] = fminf(from[k], px[k]);
            to[k] = fmaxf(to[k], px[k]);
        }
    }
    const float side = fmaxf(to[0] - from[0], to[1] - from[1]);
    const int fills = is_behind || !(side < 1.5f * (float)(c->width > c->height ? c->width : c->height));
    report_note(!p->is_line || one->o.fit || p->j->o.is_quiet || (!fills && !(side < 4.0f)),
                "%s: the object is %.3g m long and %s; --fit chooses its size, --scale M sets it", mesh,
                (double)(mix_extent_of(one).longest * one->scale),
                fills ? "fills the picture" : "vanishes in the picture");
}

static int put(mix_spot *out, const placements *p, const list_row *row, mix_job *one, report *r)
{
    const mix_job *j = p->j;
    report own = {""};
    const int blocks = one->block_count;
    one->object = p->thing[row->thing].object;
    one->o.at = row->at;
    one->o.on = row->on;
    one->o.at_px[0] = row->px[0];
    one->o.at_px[1] = row->px[1];
    one->o.turn_deg = row->turn;
    one->o.fit = row->size < 0.0f;
    one->o.scale = row->size > 0.0f ? row->size / fmaxf(mix_extent_of(one).longest, 1e-20f) : row->scale;
    one->hangs = 0;
    one->floor = -1;
    one->up = j->up;
    one->anchor = (lmb_vec3){0, 0, 0};
    if (row->at == MIX_AT_CENTRE && one->planes.count == 0) {
        mix_fail_depth(one, &own);
    } else if (mix_stand(one, &own) && row->at != MIX_AT_WORLD && !(one->anchor.z < 0.0f)) {
        mix_fail_at(one, &own);
    }
    if (own.text[0] != '\0') {
        return fail_row(p, row, r, own.text);
    }
    if (row->at == MIX_AT_WORLD) {
        put_in_world(one);
    }
    out->lift = row->at == MIX_AT_WORLD ? 0.0f : touch(one, r);
    while (one->block_count > blocks) { /* mix_gap's */
        free(one->blocks[--one->block_count].at);
    }
    one->facing = one->floor >= 0 ? one->planes.plane[one->floor].normal : one->up;
    mix_turn_scene(one);
    const lmb_mat4 back = mix_back(&one->from_world), to_world = mix_object_to_scene(one),
                   there = mix_product(&back, &to_world);
    tell_size(p, one, &there, row->mesh);
    out->placed = mix_product(&j->from_world, &there);
    out->thing = row->thing;
    out->scale = one->scale;
    out->plane = one->floor;
    out->hangs = one->hangs;
    return 1;
}

static int put_all(placements *p, report *r)
{
    mix_job *one = malloc(sizeof *one);
    p->spot = calloc((size_t)p->count, sizeof *p->spot);
    int ok = one != NULL && p->spot != NULL ? 1 : report_fail(r, "%s: out of memory", p->path);
    if (ok) {
        *one = *p->j;
    }
    for (int32_t i = 0; ok && i < p->count; ++i) {
        ok = put(&p->spot[i], p, &p->row[i], one, r);
        if (i == 0 && ok) { /* the photo's light is estimated about the first object */
            p->j->anchor = one->anchor;
            p->j->scale = one->scale;
            p->j->object.scene.bounds_min = one->object.scene.bounds_min;
            p->j->object.scene.bounds_max = one->object.scene.bounds_max;
        }
    }
    free(one);
    return ok;
}

/* --- the whole ---------------------------------------------------------------------------------------------------- */

static int light_photo(placements *p, report *r)
{
    mix_job *j = p->j;
    j->is_shared = 1;
    const int ok = mix_light(j, r) && mix_labels_take(j, r) && mix_swift_begin(&p->swift, j, p->thing, r);
    j->object.scene.bounds_min = j->object.scene.bounds_max = (lmb_vec3){0, 0, 0};
    return ok;
}

static void draw(void *user, int index, int thread)
{
    placements *p = user;
    const int32_t from = p->first[index], count = p->first[index + 1] - from;
    char labels[2 * NAME_MAX_BYTES];
    if (p->failed[thread].text[0] != '\0') {
        return;
    }
    if (p->j->o.labels != NULL) {
        label_name(labels, sizeof labels, p, index);
    }
    if (p->desk[thread] == NULL) {
        p->desk[thread] = mix_swift_desk_make(&p->swift, &p->failed[thread]);
    }
    if (p->desk[thread] != NULL) {
        mix_swift_draw(p->desk[thread], &p->swift, p->spot + from, count, p->row[from].out,
                       p->j->o.labels != NULL ? labels : NULL, &p->failed[thread]);
    }
    p->failed_at[thread] = index;
    if (index == 0) {
        p->first_done = host_seconds();
    }
    if (thread == 0) {
        progress_tell("pictures", (double)index / (double)p->pictures);
    }
}

static int draw_all(placements *p, report *r)
{
    const int threads = pool_threads(p->j->o.threads);
    int32_t at = p->pictures;
    pool_run(threads, p->pictures, draw, p);
    for (int i = 0; i < threads; ++i) { /* the first one in the list */
        if (p->failed[i].text[0] != '\0' && p->failed_at[i] < at) {
            at = p->failed_at[i];
            *r = p->failed[i];
        }
    }
    return at == p->pictures;
}

static void tell(const placements *p)
{
    const double all = host_seconds() - p->began, later = host_seconds() - p->first_done;
    mix_tell_times(p->j);
    report_note(!p->j->o.is_verbose || p->pictures < 2, "%d pictures in %.2f s; after the first %.1f a second",
                (int)p->pictures, all, (double)(p->pictures - 1) / (later > 1e-9 ? later : 1e-9));
}

static void free_all(placements *p)
{
    for (int32_t i = 0; i < p->count; ++i) {
        free(p->row[i].out);
        free(p->row[i].mesh);
    }
    for (int32_t i = 0; i < p->things; ++i) {
        model_free(&p->thing[i].object);
        mix_block_free(&p->thing[i].block);
    }
    for (int i = 0; i < POOL_MAX; ++i) {
        mix_swift_desk_free(p->desk[i]);
    }
    free(p->row);
    free(p->thing);
    free(p->spot);
    free(p->first);
    free(p->folder);
    free(p);
}

static int run(placements *p, report *r)
{
    mix_job *j = p->j;
    double from = p->began;
    int ok = options_files(&j->o, &mix_table, r) && mix_frame_read(&j->frame, &j->o.source, r);
    j->read_s = mix_lap(&from);
    ok = ok && (p->is_line ? take_line(p, r) : read_list(p, r)) && find_pictures(p, r) &&
         options_files(&j->o, &mix_table, r) && load_meshes(p, r) && labels_differ(p, r) && can_write(p, r) &&
         mix_find_planes(j, r);
    j->planes_s = mix_lap(&from);
    ok = ok && mix_place(j, r) && put_all(p, r);
    j->place_s = mix_lap(&from);
    if (ok) {
        report_print_notes();
    }
    ok = ok && light_photo(p, r);
    j->light_s = mix_lap(&from);
    ok = ok && draw_all(p, r);
    j->draw_s = mix_lap(&from);
    return ok;
}

int mix_placements(mix_job *j, report *r)
{
    placements *p = calloc(1, sizeof *p);
    if (p == NULL) {
        return report_fail(r, "out of memory");
    }
    p->j = j;
    p->is_line = j->o.placements == NULL;
    p->path = p->is_line ? "--object" : j->o.placements;
    j->o.object = NULL; /* rows have them */
    p->began = host_seconds();
    const int ok = run(p, r);
    if (ok) {
        tell(p);
    }
    free_all(p);
    return ok;
}
