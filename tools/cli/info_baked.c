/* info_baked.c: `lambent info` for baked files: light (.lmt) and reliefs (.lmr). */
#include "info_baked.h"

#include <string.h>

#include "../common/checksum.h"
#include "../model/io_lmt.h"
#include "info_text.h"

/* A number with a label and a name in JSON. */
typedef struct figure {
    const char *label, *name;
    double value;
} figure;

static int begins(const file_bytes *file, const char *magic)
{
    return file->size >= 4 && memcmp(file->data, magic, 3) == 0;
}

int info_baked_begins(const file_bytes *file) { return begins(file, "LMT") || begins(file, "LMR"); }

/* Prints the common start of both kinds; leaves the JSON open. */
static void head(FILE *out, const char *path, const char *kind, const file_bytes *file, int json)
{
    if (json) {
        fputs("{\"file\":", out);
        json_text(out, path);
        fprintf(out, ",\"kind\":\"%s\",\"version\":%d,\"bytes\":%.0f", kind, file->data[3], (double)file->size);
    } else {
        label(out, "file");
        plain_text(out, path);
        fprintf(out, ": %s, version %d, %.0f bytes\n", kind, file->data[3], (double)file->size);
    }
}

static void figures(FILE *out, const figure *all, int json)
{
    for (; all->label != NULL; ++all) {
        if (json) {
            fprintf(out, ",\"%s\":%.0f", all->name, all->value);
        } else {
            label(out, all->label);
            fprintf(out, "%.0f\n", all->value);
        }
    }
}

static int light_info(FILE *out, const char *path, const file_bytes *file, int json, report *r)
{
    lmb_transfer t;
    if (!lmt_open(&t, file, path, r) || out == NULL) {
        return r->text[0] == '\0';
    }
    const figure all[] = {{"triangles", "triangles", t.count[LMB_TRANSFER_SURFACES]},
                          {"elements", "elements", t.count[LMB_TRANSFER_AREAS]},
                          {"coarse", "coarse_elements", t.count[LMB_TRANSFER_COARSE]},
                          {"receivers", "receivers", t.count[LMB_TRANSFER_RECEIVERS]},
                          {"links", "links", t.count[LMB_TRANSFER_LINKS]},
                          {"clusters", "clusters", t.count[LMB_TRANSFER_CLUSTERS]},
                          {"their links", "cluster_links", t.count[LMB_TRANSFER_CLUSTER_LINKS]},
                          {"moving", "moving_ranges", t.count[LMB_TRANSFER_MOVING]},
                          {"in the air", "air_places", t.count[LMB_TRANSFER_AIR]},
                          {NULL, NULL, 0.0}};
    head(out, path, json ? "transfer" : "baked light", file, json);
    figures(out, all, json);
    if (json) {
        fprintf(out, ",\"scene\":\"%08x%08x\"}\n", (unsigned)t.scene[1], (unsigned)t.scene[0]);
    } else {
        label(out, "scene");
        fprintf(out, "%08x%08x\n", (unsigned)t.scene[1], (unsigned)t.scene[0]);
    }
    return 1;
}

static int relief_info(FILE *out, const char *path, const file_bytes *file, int json, report *r)
{
    lmb_relief f;
    const int fits = checksum_fits(file->data, file->size, LMB_RELIEF_HEADER_WORDS);
    if (lmb_relief_swap(file->data, file->size) != LMB_OK || lmb_relief_open(&f, file->data, file->size) != LMB_OK ||
        !fits) {
        return report_fail(r, "%s: a damaged relief, or not of version 1; bake it again", path);
    }
    if (out == NULL) {
        return 1;
    }
    int32_t min = f.view[0].width, max = min;
    for (int32_t i = 0; i < f.views; ++i) {
        const int32_t w = f.view[i].width, h = f.view[i].height;
        min = w < min ? w : min;
        min = h < min ? h : min;
        max = w > max ? w : max;
        max = h > max ? h : max;
    }
    const figure all[] = {{"triangles", "triangles", f.mesh.triangle_count},
                          {"vertices", "vertices", f.mesh.vertex_count},
                          {"views", "views", f.views},
                          {"", "shortest_side", min},
                          {"", "longest_side", max},
                          {NULL, NULL, 0.0}};
    head(out, path, "relief", file, json);
    if (json) {
        figures(out, all, 1);
        fprintf(out, ",\"packed\":%s,", f.format == LMB_RELIEF_PACKED ? "true" : "false");
        json_vec3(out, "min", f.low);
        fputc(',', out);
        json_vec3(out, "max", f.high);
        fputs("}\n", out);
    } else {
        const lmb_vec3 rows[2] = {f.low, f.high};
        const char *const ends[2] = {"min", "max"};
        label(out, "triangles");
        fprintf(out, "%u, with %u vertices\n", (unsigned)f.mesh.triangle_count, (unsigned)f.mesh.vertex_count);
        label(out, "views");
        fprintf(out, "%d, with sides of %d to %d texels, %s\n", (int)f.views, (int)min, (int)max,
                f.format == LMB_RELIEF_PACKED ? "packed" : "full");
        for (int i = 0; i < 2; ++i) {
            label(out, i == 0 ? "bounds" : "");
            fprintf(out, "%-4s %13.6g %13.6g %13.6g\n", ends[i], (double)rows[i].x, (double)rows[i].y,
                    (double)rows[i].z);
        }
    }
    return 1;
}

int info_baked(FILE *out, const char *path, const file_bytes *file, int json, report *r)
{
    return (begins(file, "LMT") ? light_info : relief_info)(out, path, file, json, r);
}
