/* plan_table.c: a plan's stages, lights and budget as a table and as JSON. */
#include "plan_table.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char *proof_word(const lmb_plan_row *row)
{
    return row->proof == LMB_PROOF_RUNS ? "runs" : row->proof == LMB_PROOF_EXACT ? "exact" : "bound";
}

/* A count in four digits: 950, 12.3k, 4.56M. */
static const char *short_count(char out[16], double n)
{
    static const char *const units[] = {"", "k", "M", "G", "T"};
    int u = 0;
    while (n >= 9999.5 && u < 4) {
        n /= 1000.0;
        ++u;
    }
    if (u == 0) {
        snprintf(out, 16, "%.0f", n);
    } else {
        snprintf(out, 16, "%.*f%s", n < 10.0 ? 2 : n < 100.0 ? 1 : 0, n, units[u]);
    }
    return out;
}

/* "4.92M pairs, 600 tiles' cuts". */
static void print_ops(const lmb_plan_row *row)
{
    char number[16];
    int n = 0;
    for (int i = 0; i < LMB_OPS; ++i) {
        if (row->op[i] > 0.0) {
            printf("%s%s %s", n++ > 0 ? ", " : "", short_count(number, row->op[i]), lmb_op_name(i));
        }
    }
}

static void print_rows(const lmb_plan *p)
{
    printf("%-14s %9s %6s %10s  %s\n", "stage", "work", "%", "KiB", "what it does, or why it is left out");
    for (int s = 0; s < LMB_PLAN_STAGES; ++s) {
        const lmb_plan_row *row = &p->row[s];
        char work[16];
        printf("%-14s %9s %6.1f %10.1f  ", lmb_plan_stage_name(s), row->work > 0.0 ? short_count(work, row->work) : "-",
               p->work > 0.0 ? row->work / p->work * 100.0 : 0.0, (double)row->bytes / 1024.0);
        if (row->why != LMB_WHY_RUNS) {
            printf("left out (%s): %s", proof_word(row), lmb_why_name(row->why));
        } else {
            print_ops(row);
        }
        putchar('\n');
    }
}

/* Lights that do less than possible, one line per reason. */
static void print_lights(const lmb_plan *p, const render_job *j)
{
    for (int why = LMB_WHY_RUNS + 1; why < LMB_WHYS; ++why) {
        uint32_t n = 0, first = 0;
        for (uint32_t i = 0; i < j->scene.light_count; ++i) {
            if (p->light[i] == why) {
                first = n++ == 0 ? i : first;
            }
        }
        if (n == 1) {
            printf("light %u: %s\n", (unsigned)first, lmb_why_name(why));
        } else if (n > 1) {
            printf("%u lights, the first is %u: %s\n", (unsigned)n, (unsigned)first, lmb_why_name(why));
        }
    }
    if (p->faces > p->faces_drawn) {
        printf("%u of %u faces of shadow maps see nothing of the scene, and are not drawn\n",
               (unsigned)(p->faces - p->faces_drawn), (unsigned)p->faces);
    }
}

static const char *gather_word(int32_t step)
{
    return step == LMB_GATHER_LIVE ? "live" : "full";
}

void plan_print_table(const lmb_plan *p, const render_job *j, const budget_choice *c)
{
    const lmb_frame *f = &j->frame;
    char work[16], words[200];
    report_print(stdout, "%s: %d x %d, %u triangles, %u lights; --shadow-map %d", j->o.scene,
                 (int)f->view.frame_width, (int)f->view.frame_height, (unsigned)lmb_scene_triangles(&j->scene),
                 (unsigned)j->scene.light_count, (int)f->shadow_map);
    if (f->tree.texel != NULL) {
        printf(" --tree %d --error %.3g --visibility %.3g --gather %s", (int)f->tree.size, (double)f->error,
               (double)f->visibility, gather_word(f->gather_step));
    }
    printf("\n\n");
    print_rows(p);
    printf("%-14s %9s %6s %10.1f  state, and scratch of further threads; not in --budget bytes\n", "the rest", "", "",
           fmax((double)j->bytes + (double)j->many_lights.bytes - (double)p->bytes, 0.0) / 1024.0);
    printf("%-14s %9s %6s %10.1f\n\n", "all", short_count(work, p->work), "",
           fmax((double)j->bytes + (double)j->many_lights.bytes, (double)p->bytes) / 1024.0);
    print_lights(p, j);
    if (f->tree.texel != NULL && f->gather_step == LMB_GATHER_LIVE) {
        printf("live light is planned as the cuts of all tiles, which is more work than it takes\n");
    }
    if (c->rate > 0.0) {
        printf("about %.3g ms on this machine, by %.3g units a second\n", p->work / c->rate * 1e3, c->rate);
    }
    if (has_budget(&c->budget, 0.0f)) {
        budget_words(words, sizeof words, c);
        if (c->chosen.error >= 0.0f) {
            printf("%s; error about %.2g of the bounced light\n", words, (double)c->chosen.error);
        } else {
            printf("%s; error not checked\n", words);
        }
        printf("looked at %.3g units of work, %.0f %% of the picture's\n", c->look.work,
               100.0 * c->look.work / c->chosen.work);
    }
}

void plan_print_json(const lmb_plan *p, const render_job *j, const budget_choice *c)
{
    const lmb_frame *f = &j->frame;
    printf(
        "{\n  \"width\": %d, \"height\": %d, \"triangles\": %u, \"lights\": %u,\n  \"shadow_map\": %d, \"tree\": %d, "
        "\"error\": %.6g, \"visibility\": %.6g, \"gather\": %d,\n  \"stages\": [\n",
        (int)f->view.frame_width, (int)f->view.frame_height, (unsigned)lmb_scene_triangles(&j->scene),
        (unsigned)j->scene.light_count, (int)f->shadow_map, (int)f->tree.size, (double)f->error, (double)f->visibility,
        (int)f->gather_step);
    for (int s = 0; s < LMB_PLAN_STAGES; ++s) {
        const lmb_plan_row *row = &p->row[s];
        printf("    {\"stage\": \"%s\", \"runs\": %s, \"why\": \"%s\", \"proof\": \"%s\", \"work\": %.6g, \"bytes\": "
               "%.0f",
               lmb_plan_stage_name(s), row->why == LMB_WHY_RUNS ? "true" : "false", lmb_why_name(row->why),
               proof_word(row), row->work, (double)row->bytes);
        for (int i = 0; i < LMB_OPS; ++i) {
            if (row->op[i] > 0.0) {
                printf(", \"%s\": %.10g", lmb_op_name(i), row->op[i]);
            }
        }
        printf("}%s\n", s + 1 < LMB_PLAN_STAGES ? "," : "");
    }
    printf("  ],\n  \"light_why\": [");
    for (uint32_t i = 0; i < j->scene.light_count; ++i) {
        printf("%s\"%s\"", i > 0 ? ", " : "", lmb_why_name(p->light[i]));
    }
    printf("],\n  \"faces\": %u, \"faces_drawn\": %u, \"work\": %.6g, \"bytes\": %.0f, \"memory\": %.0f, "
           "\"rate\": %.6g",
           (unsigned)p->faces, (unsigned)p->faces_drawn, p->work, (double)p->bytes,
           (double)j->bytes + (double)j->many_lights.bytes, c->rate);
    if (has_budget(&c->budget, 0.0f)) {
        printf(",\n  \"budget\": {\"work\": %.6g, \"error\": %.6g, \"bytes\": %.0f, \"meets\": %s, \"estimated_work\": "
               "%.6g, \"checked\": %s, \"estimated_error\": %.6g, \"estimated_bytes\": %.0f, \"look_work\": %.6g, "
               "\"look_seconds\": %.6f}",
               c->budget.work, (double)c->budget.error, (double)c->budget.bytes, c->chosen.meets ? "true" : "false",
               c->chosen.work, c->chosen.error >= 0.0f ? "true" : "false",
               c->chosen.error >= 0.0f ? (double)c->chosen.error : 0.0, (double)c->chosen.bytes, c->look.work,
               c->look.seconds);
    }
    printf("\n}\n");
}
