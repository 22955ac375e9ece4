/* verb_compare.c: `lambent compare`: error of one picture against another. */
#include "verb_compare.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../common/options.h"
#include "../common/progress.h"
#include "../picture/image.h"
#include "../picture/metrics.h"
#include "../picture/picture_read.h"

enum { KEY_TRIM, KEY_RMSE, KEY_E50, KEY_E95, KEY_E99, KEY_WORST, KEY_LO, KEY_HI, KEY_LEAK, KEY_COUNT };

static const char *const key_names[KEY_COUNT] = {"trim", "rmse", "e50", "e95", "e99", "worst", "lo", "hi", "leak"};

typedef struct options {
    const char *test, *truth, *mask, *classes, *heat, *max; /* NULL: not given */
    double bounds[KEY_COUNT];
    int json, is_quiet, is_verbose;
} options;

/* A picture to compare. picture_free releases it; a zeroed one is empty. */
typedef struct picture {
    int32_t width, height;
    float *linear; /* 3 per pixel */
    float *codes;  /* 4 per pixel, RGBA as stored in an 8-bit file; NULL for a file of floats */
} picture;

/* All inputs of a run. */
typedef struct loaded {
    picture test, truth;
    image mask, classes; /* pixels NULL: not given */
} loaded;

typedef struct results {
    metrics figures;
    metrics_equality equality;
    double worst;             /* metrics_worst_pixel */
    int32_t worst_x, worst_y;
    int in_codes;          /* equality is in sRGB codes */
    int passed[KEY_COUNT]; /* 1 if a limit is exceeded */
    int ok;
} results;

/* -- options ------------------------------------------------------------------------------------------------------ */

#define AT(member) .at = offsetof(options, member)

static const option_row rows[] = {
    {.name = "A", .kind = OPTION_TEXT, .value = "", AT(test), .file = OPTION_READS, .help = "the picture"},
    {.name = "B", .kind = OPTION_TEXT, .value = "", AT(truth), .file = OPTION_READS, .help = "the truth"},
    {.name = "--mask", .value = "FILE", .kind = OPTION_TEXT, AT(mask), .file = OPTION_READS,
     .help = "count only pixels whose third channel in FILE (3-channel PFM) is over 0.5"},
    {.name = "--classes", .value = "FILE", .kind = OPTION_TEXT, AT(classes), .file = OPTION_READS,
     .help = "class of each pixel (1-channel PFM)"},
    {.name = "--max", .value = "KEY=V,...", .kind = OPTION_TEXT, AT(max),
     .help = "upper bounds for trim, rmse, e50, e95, e99, worst; lo and hi bound mean; leak bounds |leak - 1|"},
    {.name = "--json", .kind = OPTION_FLAG, AT(json),
     .help = "one object on one line; infinite or unmeasured values are null"},
    {.name = "--heat", .value = "OUT.png", .kind = OPTION_TEXT, AT(heat), .file = OPTION_WRITES,
     .help = "|a - b| / (b + 0.01 mean of B), grey: 0 black, 0.2 blue, 0.4 purple, 0.6 orange, 0.8 yellow, 1 and "
             "over white, in equal steps of lightness; dark grey: masked; green: not finite"},
    {.name = "--quiet", .brief = "-q", .kind = OPTION_QUIET, AT(is_quiet),
     .help = "print no figures, only set the exit status"},
    {.name = "--verbose", .brief = "-v", .kind = OPTION_VERBOSE, AT(is_verbose),
     .help = "print how each picture was read, and how many pixels count"},
    OPTION_ONLY_HERE,
    OPTION_TIME_LIMIT,
    OPTION_ASK,
    {.kind = OPTION_END},
};

static const option_table table = {
    .verb = "compare",
    .usage = "compare A B [options]",
    .about = "Measures the error of picture A against the truth B. Each is PNG, JPEG, PPM, PGM, PFM or HDR, by "
             "content; 8-bit files are sRGB and are decoded to linear light for the error figures. A pixel of A that "
             "is not finite counts as black. The figures:\n"
             "trim (trimmed error): relative RMSE (rmse / mean of B) without the worst 1 % of pixels;\n"
             "rmse: relative RMSE; n90: number of pixels with 90 % of the squared error;\n"
             "e50 (median relative error), e95, e99: percentiles of |a - b| / (b + 0.01 mean of B), grey (mean of the "
             "channels);\n"
             "worst: largest |a - b| / (mean of B over the 5x5 pixels around + 0.01 mean of B), grey, and the first "
             "pixel x,y (from the top left);\n"
             "mean: mean of A / mean of B;\n"
             "leak: the same over dark pixels: class 3, or B < 1 % of mean of B without --classes (21 or more);\n"
             "NONFINITE: pixels of A that are not finite, if there are any;\n"
             "psnr: dB, over red, green and blue; full scale is 255 if both files are 8-bit (then psnr and max are "
             "in sRGB codes), otherwise the largest value of B (then they are in linear light);\n"
             "max: largest difference of a channel, and the first pixel x,y (from the top left);\n"
             "exact: pixels with equal bits (alpha included); first: the first pixel that differs.\n"
             "A figure is - if it is relative to a B that is black.",
    .part = {rows},
    .examples = "  error of a draft against the default settings:\n"
                "    lambent render demo --size 80x60 --quality draft -o draft.pfm\n"
                "    lambent render demo --size 80x60 -o default.pfm\n"
                "    lambent compare draft.pfm default.pfm --max trim=0.2 --heat error.png\n",
    .status = "exit status: 0 within the bounds, 1 a bound exceeded, pixels not finite or a file that cannot be used, "
              "2 bad usage, 3 sizes differ",
};

/* Parses a limit from the first `length` characters of `item`, up to a comma or the end of the text. Of two limits
 * for a key the stricter counts. */
static int parse_bound(options *o, const char *item, size_t length)
{
    for (int k = 0; k < KEY_COUNT; ++k) {
        size_t name = strlen(key_names[k]);
        if (length < name + 2 || strncmp(item, key_names[k], name) != 0 || item[name] != '=')
            continue;
        const char *text = item + name + 1;
        char *end;
        double v = strtod(text, &end);
        if (end != item + length || !strchr("+-.0123456789", text[0]) || isnan(v))
            return 0;
        if (k == KEY_LO ? v > o->bounds[k] : v < o->bounds[k])
            o->bounds[k] = v;
        return 1;
    }
    return 0;
}

static int parse_bounds(options *o, report *r)
{
    for (const char *item = o->max; *item;) {
        size_t length = strcspn(item, ",");
        if (length && !parse_bound(o, item, length))
            return report_fail(r, "--max: '%.*s' is not KEY=NUMBER with KEY one of trim rmse e50 e95 e99 worst lo hi "
                               "leak", (int)(length < 60 ? length : 60), item);
        item += length + (item[length] == ',');
    }
    return 1;
}

static int parse_options(options *o, int argc, char **argv, report *r)
{
    static const options none;
    *o = none;
    for (int k = 0; k < KEY_COUNT; ++k)
        o->bounds[k] = k == KEY_LO ? -(double)INFINITY : (double)INFINITY;
    const int asked = options_parse(o, &table, argc, argv, r);
    if (asked != OPTIONS_RUN)
        return asked;
    if (!o->truth)
        return report_fail(r, "two pictures are needed, A and the truth B; see lambent compare --help");
    return o->max && !parse_bounds(o, r) ? OPTIONS_BAD : OPTIONS_RUN;
}

/* -- files -------------------------------------------------------------------------------------------------------- */

static void picture_free(picture *p)
{
    static const picture none;
    free(p->linear);
    free(p->codes);
    *p = none;
}

static void loaded_free(loaded *l)
{
    picture_free(&l->test);
    picture_free(&l->truth);
    image_free(&l->mask);
    image_free(&l->classes);
}

/* Allocates `channels` floats per pixel, or NULL. */
static float *float_pixels(int32_t width, int32_t height, size_t channels)
{
    size_t count = (size_t)width * (size_t)height, bytes = channels * sizeof(float);
    return count > SIZE_MAX / bytes ? NULL : malloc(count * bytes);
}

static int picture_from_bitmap(picture *out, const bitmap *in)
{
    size_t count = (size_t)in->width * (size_t)in->height;
    float linear_of[256];
    srgb_table(linear_of);
    out->linear = float_pixels(in->width, in->height, 3);
    out->codes = float_pixels(in->width, in->height, 4);
    if (!out->linear || !out->codes)
        return 0;
    for (size_t i = 0; i < count; ++i) {
        for (size_t k = 0; k < 3; ++k)
            out->linear[3 * i + k] = linear_of[in->texels[4 * i + k]];
        for (size_t k = 0; k < 4; ++k)
            out->codes[4 * i + k] = (float)in->texels[4 * i + k];
    }
    return 1;
}

static int picture_from_image(picture *out, const image *in)
{
    size_t count = (size_t)in->width * (size_t)in->height, step = in->channels == 3 ? 1 : 0;
    out->linear = float_pixels(in->width, in->height, 3);
    if (!out->linear)
        return 0;
    for (size_t i = 0; i < count; ++i) {
        for (size_t k = 0; k < 3; ++k)
            memcpy(&out->linear[3 * i + k], &in->pixels[i * (size_t)in->channels + k * step], sizeof(float));
    }
    return 1;
}

static int picture_decode(picture *out, const file_bytes *file, const char *path, report *r)
{
    stored_picture stored;
    if (!picture_read(&stored, file->data, file->size, path, r))
        return 0;
    out->width = stored.width;
    out->height = stored.height;
    int ok = stored.codes.texels ? picture_from_bitmap(out, &stored.codes) : picture_from_image(out, &stored.light);
    stored_picture_free(&stored);
    return ok || report_fail(r, "%s: memory is short for its pixels", path);
}

static int picture_load(picture *out, const char *path, report *r)
{
    file_bytes file = {NULL, 0};
    if (!file_read(&file, path, r))
        return 0;
    int ok = picture_decode(out, &file, path, r);
    file_free(&file);
    return ok;
}

static int layer_load(image *out, const char *path, int32_t channels, report *r)
{
    file_bytes file = {NULL, 0};
    if (!path)
        return 1;
    if (!file_read(&file, path, r))
        return 0;
    int ok = pfm_decode(out, file.data, file.size, path, r);
    file_free(&file);
    if (ok && out->channels != channels)
        return report_fail(r, "%s: %s", path, channels == 3 ?
                           "1 channel, but the mask is the third of 3 (as in gbuffer_depth.pfm)" :
                           "3 channels, but classes are 1 (as in classes.pfm)");
    return ok;
}

static int load_all(loaded *l, const options *o, report *r)
{
    return picture_load(&l->test, o->test, r) && picture_load(&l->truth, o->truth, r) &&
           layer_load(&l->mask, o->mask, 3, r) && layer_load(&l->classes, o->classes, 1, r);
}

static int check_sizes(const loaded *l, const options *o, report *r)
{
    int w = (int)l->truth.width, h = (int)l->truth.height;
    if (l->test.width != w || l->test.height != h)
        return report_fail(r, "sizes differ: %s is %dx%d, %s is %dx%d", o->test, (int)l->test.width,
                           (int)l->test.height, o->truth, w, h);
    for (int k = 0; k < 2; ++k) {
        const image *layer = k ? &l->classes : &l->mask;
        if (layer->pixels && (layer->width != w || layer->height != h))
            return report_fail(r, "sizes differ: %s is %dx%d, %s is %dx%d", k ? o->classes : o->mask,
                               (int)layer->width, (int)layer->height, o->truth, w, h);
    }
    return 1;
}

/* -- figures ------------------------------------------------------------------------------------------------------ */

static metrics_input linear_input(const loaded *l)
{
    metrics_input in = {l->test.linear, l->truth.linear, l->mask.pixels, l->classes.pixels,
                        l->truth.width, l->truth.height, 3};
    return in;
}

/* Written so that NaN exceeds every limit. */
static int is_passed(const results *res, int key, double bound)
{
    const metrics *m = &res->figures;
    const double upper[] = {m->trim, m->rmse, m->e50, m->e95, m->e99, res->worst};
    switch (key) {
    case KEY_LO:
        return !(m->mean >= bound);
    case KEY_HI:
        return !(m->mean <= bound);
    case KEY_LEAK:
        return m->has_leak && !(fabs(m->leak - 1.0) <= bound);
    default:
        return !(upper[key] <= bound);
    }
}

/* Differences relative to a black truth have no meaning. */
static void drop_relative(results *inout)
{
    metrics *m = &inout->figures;
    double *const relative[] = {&m->trim, &m->rmse, &m->e50, &m->e95, &m->e99, &m->mean, &m->leak, &inout->worst};
    for (int i = 0; m->truth_mean <= METRICS_BLACK && i < (int)(sizeof relative / sizeof *relative); ++i) {
        *relative[i] = *relative[i] == 0.0 ? 0.0 : (double)NAN;
    }
}

static int measure(results *out, const loaded *l, const options *o, report *r)
{
    metrics_input in = linear_input(l);
    if (!metrics_measure(&out->figures, &in, r))
        return 0;
    out->worst = metrics_worst_pixel(&out->worst_x, &out->worst_y, &out->figures, &in);
    out->ok = out->figures.nonfinite == 0;
    for (int k = 0; k < KEY_COUNT; ++k) {
        out->passed[k] = is_passed(out, k, o->bounds[k]);
        out->ok = out->ok && !out->passed[k];
    }
    drop_relative(out);
    out->in_codes = l->test.codes && l->truth.codes;
    if (out->in_codes) {
        in.test = l->test.codes;
        in.truth = l->truth.codes;
        in.channels = 4;
    }
    metrics_compare(&out->equality, &in, out->in_codes ? 255.0 : 0.0);
    return 1;
}

/* -- output ------------------------------------------------------------------------------------------------------- */

static int has_meaning(double v) { return isfinite(v); }

static void text_number(FILE *out, const char *name, double v, int digits)
{
    if (has_meaning(v))
        fprintf(out, fabs(v) < 1e6 ? "%s %.*f" : "%s %.*g", name, digits, v);
    else
        fprintf(out, "%s -", name);
}

static void print_text(FILE *out, const results *res, const options *o)
{
    const metrics *m = &res->figures;
    const metrics_equality *e = &res->equality;
    text_number(out, "trim", m->trim, 4);
    text_number(out, " rmse", m->rmse, 4);
    fprintf(out, " (n90 %" PRIu64 ")", m->n90);
    text_number(out, " e50", m->e50, 4);
    text_number(out, " e95", m->e95, 4);
    text_number(out, " e99", m->e99, 4);
    text_number(out, " worst", res->worst, 4);
    if (res->worst_x >= 0 && has_meaning(res->worst))
        fprintf(out, " at %d,%d", (int)res->worst_x, (int)res->worst_y);
    text_number(out, " mean", m->mean, 4);
    if (m->has_leak)
        text_number(out, " leak", m->leak, 3);
    if (m->nonfinite)
        fprintf(out, " NONFINITE %" PRIu64, m->nonfinite);
    if (!res->ok && o->max)
        report_print(out, " [bound %s]", o->max);
    if (e->peak > 0.0 || e->exact == e->pixels)
        fprintf(out, "\npsnr %.2f dB", e->psnr_db);
    else
        fprintf(out, "\npsnr -");
    fprintf(out, " (rgb, %s, peak %.6g) max %.6g", res->in_codes ? "sRGB codes" : "linear", e->peak, e->max_abs);
    if (e->max_x >= 0)
        fprintf(out, " at %d,%d", (int)e->max_x, (int)e->max_y);
    fprintf(out, " exact %" PRIu64 " of %" PRIu64, e->exact, e->pixels);
    if (e->first_x >= 0)
        fprintf(out, " first %d,%d", (int)e->first_x, (int)e->first_y);
    fputc('\n', out);
}

/* JSON has no infinity and no NaN. */
static void json_number(FILE *out, const char *name, double v)
{
    if (has_meaning(v))
        fprintf(out, "\"%s\":%.9g,", name, v);
    else
        fprintf(out, "\"%s\":null,", name);
}

static void json_count(FILE *out, const char *name, uint64_t v) { fprintf(out, "\"%s\":%" PRIu64 ",", name, v); }

static void json_place(FILE *out, const char *name, int32_t x, int32_t y)
{
    if (x >= 0)
        fprintf(out, "\"%s\":[%d,%d],", name, (int)x, (int)y);
    else
        fprintf(out, "\"%s\":null,", name);
}

static void json_figures(FILE *out, const metrics *m)
{
    json_number(out, "trim", m->trim);
    json_number(out, "rmse", m->rmse);
    json_count(out, "n90", m->n90);
    json_number(out, "e50", m->e50);
    json_number(out, "e95", m->e95);
    json_number(out, "e99", m->e99);
    json_number(out, "mean", m->mean);
    json_number(out, "leak", m->has_leak ? m->leak : (double)NAN);
    json_count(out, "dark", m->dark);
    json_count(out, "nonfinite", m->nonfinite);
    json_count(out, "pixels", m->pixels);
}

static void json_equality(FILE *out, const metrics_equality *e, int in_codes)
{
    json_number(out, "psnr_db", e->psnr_db);
    fprintf(out, "\"psnr_of\":\"%s\",", in_codes ? "rgb, sRGB codes" : "rgb, linear");
    json_number(out, "peak", e->peak);
    json_number(out, "max_abs", e->max_abs);
    json_place(out, "max_at", e->max_x, e->max_y);
    json_count(out, "exact", e->exact);
    json_place(out, "first_difference", e->first_x, e->first_y);
}

static void print_json(FILE *out, const results *res, const loaded *l)
{
    const char *comma = "";
    fprintf(out, "{\"width\":%d,\"height\":%d,", (int)l->truth.width, (int)l->truth.height);
    json_figures(out, &res->figures);
    json_number(out, "worst", res->worst);
    json_place(out, "worst_at", res->worst_x, res->worst_y);
    json_equality(out, &res->equality, res->in_codes);
    fprintf(out, "\"passed_bounds\":[");
    for (int k = 0; k < KEY_COUNT; ++k) {
        if (res->passed[k]) {
            fprintf(out, "%s\"%s\"", comma, key_names[k]);
            comma = ",";
        }
    }
    fprintf(out, "],\"ok\":%s}\n", res->ok ? "true" : "false");
}

static int write_heat(const loaded *l, const metrics *m, const char *path, report *r)
{
    metrics_input in = linear_input(l);
    size_t count = (size_t)in.width * (size_t)in.height;
    uint8_t *rgb = count > SIZE_MAX / 3 ? NULL : malloc(3 * count);
    file_bytes png = {NULL, 0};
    if (!rgb)
        return report_fail(r, "%s: memory is short for its pixels", path);
    metrics_heat(rgb, &in, m->truth_mean);
    int ok = png_encode(&png, rgb, in.width, in.height, r) && file_write(path, png.data, png.size, r);
    file_free(&png);
    free(rgb);
    return ok;
}

/* --verbose: prints how the pictures were read. */
static void tell_taken(FILE *err, const loaded *l, const options *o, const metrics *m)
{
    const picture *const both[] = {&l->test, &l->truth};
    const char *const path[] = {o->test, o->truth};
    for (int i = 0; i < 2 && o->is_verbose; ++i)
        report_print(err, "lambent: %s: %dx%d, %s\n", path[i], (int)both[i]->width, (int)both[i]->height,
                     both[i]->codes ? "8-bit sRGB, decoded" : "linear light");
    if (o->is_verbose)
        fprintf(err, "lambent: %" PRIu64 " pixels count\n", m->pixels);
}

/* Prints the metrics before it writes the heat picture, so that a full disk does not lose them. */
static int deliver(FILE *out, FILE *err, const results *res, const loaded *l, const options *o, report *r)
{
    out = o->heat && file_is_stdout(o->heat) ? err : out;
    tell_taken(err, l, o, &res->figures);
    if (!o->is_quiet)
        o->json ? print_json(out, res, l) : print_text(out, res, o);
    return report_flush_to(out, r) && (!o->heat || write_heat(l, &res->figures, o->heat, r));
}

/* Returns the exit status. */
static int run(FILE *out, FILE *err, loaded *l, const options *o, report *r)
{
    results res;
    if (!options_files(o, &table, r) || !load_all(l, o, r))
        return COMPARE_FAILED;
    if (!check_sizes(l, o, r))
        return COMPARE_SIZES;
    if (!measure(&res, l, o, r) || !deliver(out, err, &res, l, o, r))
        return COMPARE_FAILED;
    return res.ok ? COMPARE_OK : COMPARE_FAILED;
}

int compare_to(FILE *out, FILE *err, int argc, char **argv)
{
    static const loaded none;
    loaded l = none;
    options o;
    report r = {""};
    const int asked = parse_options(&o, argc, argv, &r);
    if (asked != OPTIONS_RUN)
        return options_answer_to(out, err, asked, &table, &r);
    progress_begin(o.is_quiet, "compare");
    const int status = run(out, err, &l, &o, &r);
    loaded_free(&l);
    return r.text[0] != '\0' ? report_end_to(err, &r, "compare", status) : status;
}

int verb_compare(int argc, char **argv)
{
    return compare_to(stdout, stderr, argc, argv);
}
