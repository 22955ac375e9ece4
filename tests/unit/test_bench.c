/* test_bench.c: the numbers of a sweep's report: front, knee, breakdown; the texts of its files; the command line. */
#include "../folder.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../tools/bench/bench_chart.h"
#include "../../tools/bench/bench_front.h"
#include "../../tools/bench/bench_html.h"
#include "../../tools/bench/bench_breakdown.h"
#include "../../tools/bench/bench_slice.h"
#include "../../tools/bench/bench_sweep.h"
#include "../../tools/bench/bench_task.h"
#include "../../tools/bench/bench_table.h"
#include "../../tools/demo/demo_scene.h"
#include "../../tools/model/scene_hash.h"
#include "../test.h"

void test_bench(void);

/* --- front and knee ----------------------------------------------------------------------------------------------- */

static bench_point *add(bench_results *b, const char *name, double time_s, double error)
{
    bench_point *p = bench_results_add(b);
    snprintf(p->name, sizeof p->name, "%s", name);
    p->time_s = time_s;
    p->figure[0] = error;
    p->has_figures = 1;
    return p;
}

static void check_front(void)
{
    bench_results b;
    int order[BENCH_POINTS];
    memset(&b, 0, sizeof b);
    add(&b, "slow and good", 100.0, 0.001);
    add(&b, "beaten in both", 5.0, 0.2);
    add(&b, "fast and bad", 0.1, 0.5);
    add(&b, "middle", 1.0, 0.01);
    add(&b, "its equal, later", 1.0, 0.01);
    add(&b, "as slow, worse", 1.0, 0.02);
    add(&b, "better, with threads", 0.01, 0.0001)->threads = 2;
    add(&b, "no figures", 0.001, 0.0)->has_figures = 0;
    snprintf(add(&b, "failed", 0.001, 0.0)->failure, sizeof b.point->failure, "why");
    CHECK(bench_front(&b) == 3);
    CHECK(bench_front_order(order, &b) == 3);
    CHECK(order[0] == 2 && order[1] == 3 && order[2] == 0);
    /* A third of the way in time (1 of 3 decades) and lower in error: 1 - 1/3 - log(10)/log(500) below the
     * line. */
    CHECK(b.point[3].is_knee && !b.point[0].is_knee && !b.point[2].is_knee);
    bench_results_free(&b);
}

static void check_knee(void)
{
    bench_results b;
    memset(&b, 0, sizeof b);
    add(&b, "a", 1.0, 1.0);
    add(&b, "b", 100.0, 0.01);
    CHECK(bench_front(&b) == 2);
    CHECK(!b.point[0].is_knee && !b.point[1].is_knee);
    add(&b, "above the line", 10.0, 0.2); /* the line is at 0.1 there */
    CHECK(bench_front(&b) == 3);
    CHECK(!b.point[2].is_knee);
    add(&b, "under it", 20.0, 0.04);       /* the line is at 0.05 */
    add(&b, "farther under it", 3.0, 0.1); /* at 0.33; dominates the one above the line */
    CHECK(bench_front(&b) == 4);
    CHECK(!b.point[2].on_front && !b.point[3].is_knee && b.point[4].is_knee);
    add(&b, "exact", 200.0, 0.0);
    CHECK(bench_front(&b) == 5); /* an error of 0 has no logarithm */
    bench_results_free(&b);
}

/* --- the breakdown ------------------------------------------------------------------------------------------------ */

/* Two pixels that count and one that does not. Errors of different steps in different pixels add up; equal errors count
 * double. */
static void check_breakdown(void)
{
    static const float a[9] = {1.5f, 1.5f, 1.5f, 1.0f, 1.0f, 1.0f, 9.0f, 9.0f, 9.0f};
    static const float b[9] = {1.0f, 1.0f, 1.0f, 1.0f, 1.0f, 1.0f, 0.0f, 0.0f, 0.0f};
    static const float c[9] = {1.0f, 1.0f, 1.0f, 0.5f, 0.5f, 0.5f, 5.0f, 5.0f, 5.0f};
    static const float d[9] = {0.5f, 0.5f, 0.5f, 1.0f, 1.0f, 1.0f, 9.0f, 9.0f, 9.0f};
    static const uint8_t counts[3] = {1, 1, 0}, none[3] = {0, 0, 0};
    const float *apart[3] = {a, b, c}, *along[3] = {a, b, d};
    bench_breakdown l;
    memset(&l, 0, sizeof l);
    l.rows = 2;
    CHECK(bench_breakdown_sum(&l, apart, counts, 3));
    const double mean2 = 0.75 * 0.75; /* mean square of the truth, c */
    CHECK_MSG(fabs(l.row[0].square - 0.125 / mean2) < 1e-12, "%.9g", l.row[0].square);
    CHECK_MSG(fabs(l.row[1].square - 0.125 / mean2) < 1e-12, "%.9g", l.row[1].square);
    CHECK_MSG(fabs(l.total - l.sum) < 1e-12, "%.9g %.9g", l.total, l.sum);
    CHECK(bench_breakdown_sum(&l, along, counts, 3));
    CHECK_MSG(fabs(l.total - 2.0 * l.sum) < 1e-12, "%.9g %.9g", l.total, l.sum);
    CHECK(!bench_breakdown_sum(&l, apart, none, 3));
}

/* The two worst of 200 pixels in each picture are left out of all steps. */
static void check_trim(void)
{
    static float a[600], b[600], truth[600];
    static uint8_t counts[200];
    const float *picture[3] = {a, b, truth};
    bench_breakdown l;
    memset(&l, 0, sizeof l);
    l.rows = 2;
    for (int i = 0; i < 600; ++i) {
        truth[i] = b[i] = 1.0f;
        a[i] = i < 6 ? 1000.0f : 1.1f;
        b[i] = i / 3 == 10 ? 500.0f : 1.0f;
        counts[i / 3] = 1;
    }
    CHECK(bench_breakdown_sum(&l, picture, counts, 200));
    CHECK_MSG(fabs(l.total - 0.01) < 1e-6 && fabs(l.row[0].square - 0.01) < 1e-6 && l.row[1].square == 0.0,
              "%.9g = %.9g + %.9g", l.total, l.row[0].square, l.row[1].square);
}

/* --- texts -------------------------------------------------------------------------------------------------------- */

static void check_page(void)
{
    text_buffer p;
    memset(&p, 0, sizeof p);
    text_buffer_html(&p, "<a href=\"b&c\">");
    text_buffer_plain(&p, "|");
    text_buffer_json(&p, "a\"\\\n");
    text_buffer_plain(&p, "|");
    text_buffer_csv(&p, "plain");
    text_buffer_csv(&p, ",a,\"b\"");
    text_buffer_plain(&p, "|");
    text_buffer_base64(&p, (const uint8_t *)"light", 5);
    text_buffer_base64(&p, (const uint8_t *)"work", 4);
    text_buffer_base64(&p, (const uint8_t *)"sun", 3);
    CHECK_MSG(
        strcmp(p.data,
               "&lt;a href=&quot;b&amp;c&quot;&gt;|\"a\\\"\\\\\\u000a\"|plain\",a,\"\"b\"\"\"|bGlnaHQ=d29yaw==c3Vu") ==
            0,
        "%s", p.data);
    text_buffer_free(&p);
    for (int i = 0; i < 5000; ++i) {
        text_buffer_add(&p, "%04d", i);
    }
    CHECK(p.size == 20000 && strlen(p.data) == 20000 && memcmp(p.data + 4 * 4321, "4321", 4) == 0);
    text_buffer_free(&p);
}

static void check_says(void)
{
    bench_results b;
    char text[BENCH_NAME];
    memset(&b, 0, sizeof b);
    static const struct {
        double s;
        const char *text;
    } times[] = {{83.4, "83.4 s"}, {1.239, "1.24 s"}, {0.9996, "1.00 s"}, {0.0834, "83.4 ms"}, {0.0001, "100 us"}};
    for (size_t i = 0; i < sizeof times / sizeof *times; ++i) {
        bench_say_time(text, times[i].s);
        CHECK_MSG(strcmp(text, times[i].text) == 0, "%g: %s", times[i].s, text);
    }
    b.percent = 1;
    bench_say_figure(text, &b, 0, 0.0314);
    CHECK_MSG(strcmp(text, "3.1 %") == 0, "%s", text);
    bench_say_figure(text, &b, 0, 0.0);
    CHECK_MSG(strcmp(text, "0 %") == 0, "%s", text);
    bench_say_bytes(text, 10.0 * 1048576.0);
    CHECK_MSG(strcmp(text, "10 MiB") == 0, "%s", text);
    bench_label(text, "--tree 64 --gather live");
    CHECK_MSG(strcmp(text, "tree 64, gather live") == 0, "%s", text);
}

/* Every text is complete, whatever the names of files and scenes. */
static void check_files(void)
{
    bench_results b;
    text_buffer p;
    memset(&b, 0, sizeof b);
    memset(&p, 0, sizeof p);
    b.figure[0] = "trim";
    b.figure_is[0] = "error";
    b.stage[0] = "pixels";
    snprintf(b.title, sizeof b.title, "lambent render '<b>.glb'");
    add(&b, "default", 1.0, 0.5)->stage_s[0] = 1.0;
    add(&b, "--tree 64", 0.5, 0.7)->stage_s[0] = 0.5;
    bench_front(&b);
    bench_csv(&p, &b);
    CHECK_MSG(strstr(p.data, "\n--tree 64,,front,0.5,0.5,0.7,0,0,,1,,,\n") != NULL, "%s", p.data);
    text_buffer_free(&p);
    bench_html(&p, &b);
    CHECK(p.is_short); /* no memory for the pictures: the text is not written without them */
    text_buffer_free(&p);
    for (int i = 0; i < 2 * b.count + 1; ++i) {
        bench_picture *to = i == 2 * b.count ? &b.truth_picture : i % 2 == 0 ? &b.point[i / 2].picture : &b.point[i / 2].heat;
        to->rgb = calloc(3, 1);
        to->width = to->height = 1;
    }
    bench_html(&p, &b);
    CHECK(!p.is_short && strstr(p.data, "'&lt;b&gt;.glb'") != NULL && strstr(p.data, "<b>.glb") == NULL);
    CHECK(strstr(p.data, "</body></html>\n") == p.data + p.size - 15);
    text_buffer_free(&p);
    bench_results_free(&b);
}

/* One of two settings, measured on a machine with this name. */
static void put_slice(const char *out, int32_t number, const char *computer, report *r)
{
    static bench_options o;
    bench_results b;
    memset(&o, 0, sizeof o);
    memset(&b, 0, sizeof b);
    o.subject = &bench_render;
    o.out = out;
    o.is_quiet = 1;
    o.slice.number = number;
    o.slice.count = 2;
    b.settings = 2;
    b.job = 7;
    snprintf(b.computer, sizeof b.computer, "%s", computer);
    bench_point *p = add(&b, number == 1 ? "default" : "--tree 64", 1.0, 0.5);
    p->number = number - 1;
    CHECK_MSG(bench_slice_write(&o, &b, r), "%s", r->text);
    bench_results_free(&b);
}

/* Slices of different machines are joined, and the report mentions it. */
static void check_computers(void)
{
    static slice_set set; /* large */
    static const char *const second[] = {"one, avx2 lanes", "another, avx512 lanes"};
    folder f;
    folder_open(&f);
    for (int unlike = 0; unlike < 2; ++unlike) {
        report r = {""};
        file_bytes file = {NULL, 0};
        const char *out = folder_put(&f, "joined.json", "", 0), *paths[2];
        put_slice(out, 1, second[0], &r);
        put_slice(out, 2, second[unlike], &r);
        char name[2][SLICE_NAME];
        for (int i = 0; i < 2; ++i) {
            const slice s = {i + 1, 2};
            CHECK(slice_name(name[i], out, s, &r));
            paths[i] = name[i];
        }
        CHECK_MSG(slice_gather(&set, paths, 2, 1, &r) && bench_slice_merge(out, &set, 1, &r) && file_read(&file, out, &r),
                  "%s", r.text);
        byte_buffer text = {NULL, 0, 0, 0};
        byte_put(&text, file.data, file.size);
        byte_put(&text, "", 1);
        const char *said = unlike ? "\"several unlike computers\"" : "\"one, avx2 lanes\"";
        CHECK_MSG(text.data != NULL && strstr((const char *)text.data, said) != NULL, "%s", said);
        free(text.data);
        file_free(&file);
        remove(name[0]);
        remove(name[1]);
    }
    folder_close(&f);
}

/* --- the key of a stored truth ------------------------------------------------------------------------------------ */

/* Copies are the same scene; a change of any number that affects the picture makes another. */
static void check_hash(void)
{
    const lmb_scene *scene = demo_scene();
    lmb_scene other = *scene;
    lmb_light light = scene->lights[0];
    lmb_mesh mesh[64];
    uint8_t positions[12];
    lmb_view a = demo_view(32, 24), b = a;
    other.lights = &light;
    other.light_count = 1;
    CHECK(scene->light_count == 1 && scene_hash(&other) == scene_hash(scene));
    light.intensity[2] += 0.5f;
    CHECK(scene_hash(&other) != scene_hash(scene));
    light = scene->lights[0];
    CHECK(scene->mesh_count <= 64);
    memcpy(mesh, scene->meshes, scene->mesh_count * sizeof *mesh);
    other.meshes = mesh;
    CHECK(scene_hash(&other) == scene_hash(scene));
    memset(positions, 0, sizeof positions);
    mesh[0].positions = positions;
    mesh[0].vertex_count = 1;
    CHECK(scene_hash(&other) != scene_hash(scene));
    b.eye.x += 0.001f;
    CHECK(scene_hash_view(1, &a) == scene_hash_view(1, &a) && scene_hash_view(1, &a) != scene_hash_view(1, &b));
}

/* --- the command line --------------------------------------------------------------------------------------------- */

static int parses(bench_options *o, int argc, char **argv)
{
    report r = {""};
    return bench_options_parse(o, &bench_render, argc, argv, &r);
}

static void check_options(void)
{
    static bench_options o;
    static bench_task task[BENCH_POINTS];
    report r = {""};
    bench_line line;
    char said[256];
    char *all[] = {
        "a room's.glb", "--sweep", "tree=64,128", "--bounces",       "2", "--sweep", "gather=full,live",
        "--runs",     "7",       "--sweep",     "--error=0.1,0.2", NULL};
    CHECK(parses(&o, 11, all));
    CHECK(o.runs == 7 && o.ranges == 3 && o.given_count == 3);
    CHECK(bench_tasks(task, &o, &r) == 8);
    CHECK_MSG(strcmp(task[7].words, "--tree 128 --gather live --error 0.2") == 0, "%s", task[7].words);
    CHECK(bench_options_line(&line, &o, NULL, &r) && bench_line_add(&line, task[7].words));
    bench_line_say(said, sizeof said, &line);
    CHECK_MSG(strcmp(said, "lambent render --show indirect --threads 1 --size 160x120 'a room'\\''s.glb' --bounces 2 "
                           "-o picture.pfm --tree 128 --gather live --error 0.2") == 0,
              "%s", said);
    char *wrong[][3] = {{"a", "--sweep", "tree"}, {"a", "--sweep", "tree=1,,2"}, {"a", "--sweep", "tree=1,"},
                        {"a", "--runs", "0"},     {"a", "--stats", "x"},         {"a", "--tree", NULL}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        char *argv[4] = {wrong[i][0], wrong[i][1], wrong[i][2], NULL};
        CHECK_MSG(!parses(&o, wrong[i][2] != NULL ? 3 : 2, argv), "%s", wrong[i][1]);
    }
}

void test_bench(void)
{
    check_front();
    check_knee();
    check_breakdown();
    check_trim();
    check_page();
    check_says();
    check_files();
    check_computers();
    check_hash();
    check_options();
}
