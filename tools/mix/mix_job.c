/* mix_job.c: memory and planes of one run of `lambent mix`. */
#include "mix_frames.h"

#include <stdlib.h>
#include <string.h>

/* Takes the smallest block that fits and is at most twice as large; zeroed. */
static mix_memory take_spare(mix_spare *s, size_t bytes)
{
    mix_memory out = {NULL, 0, 0};
    int best = -1;
    for (int i = 0; i < s->count; ++i) {
        const size_t has = s->piece[i].bytes;
        if (has >= bytes && has / 2 <= bytes && (best < 0 || has < s->piece[best].bytes)) {
            best = i;
        }
    }
    if (best >= 0) {
        out = s->piece[best];
        s->piece[best] = s->piece[--s->count];
        memset(out.at, 0, bytes);
    }
    return out;
}

void mix_spare_free(mix_spare *s)
{
    while (s->count > 0) {
        free(s->piece[--s->count].at);
    }
}

/* Frees blocks that later jobs did not use, as when a world's voxels have grown. */
static void drop_idle(mix_spare *s)
{
    int kept = 0;
    for (int i = 0; i < s->count; ++i) {
        if (++s->piece[i].idle > MIX_IDLE) {
            free(s->piece[i].at);
        } else {
            s->piece[kept++] = s->piece[i];
        }
    }
    s->count = kept;
}

static void give_back(mix_job *j)
{
    if (j->spare != NULL && j->block_count > 0) { /* a frame that reuses the last result has no blocks */
        drop_idle(j->spare);
    }
    for (int i = 0; i < j->block_count; ++i) {
        if (j->spare != NULL && j->spare->count < MIX_BLOCKS) {
            j->spare->piece[j->spare->count] = j->blocks[i];
            j->spare->piece[j->spare->count++].idle = 0;
        } else {
            free(j->blocks[i].at);
        }
    }
}

void *mix_take(mix_job *j, size_t bytes, report *r)
{
    mix_memory m = {NULL, bytes > 0 ? bytes : 1, 0};
    if (j->block_count < MIX_BLOCKS) {
        if (j->spare != NULL) {
            m = take_spare(j->spare, m.bytes);
        }
        if (m.at == NULL) {
            m.bytes = bytes > 0 ? bytes : 1;
            m.at = calloc(1, m.bytes);
        }
        if (m.at == NULL && j->spare != NULL && j->spare->count > 0) {
            mix_spare_free(j->spare);
            m.at = calloc(1, m.bytes);
        }
    }
    if (m.at == NULL) {
        report_fail(r, "not enough memory: %.0f MiB more wanted", (double)bytes / 1048576.0);
        return NULL;
    }
    j->blocks[j->block_count++] = m;
    return m.at;
}

void mix_job_free(mix_job *j)
{
    mix_frame_free(&j->frame);
    if (j->kept == NULL || j->kept->frames == 0) { /* otherwise the sequence owns it */
        model_free(&j->object);
    }
    image_free(&j->picture);
    give_back(j);
    free(j);
}

void mix_object_box(lmb_vec3 *low, lmb_vec3 *high, const mix_job *j)
{
    lmb_scene object = j->scene;
    object.instances = j->scene.instances + 1;
    object.instance_count = j->scene.instance_count - 1;
    lmb_scene_bounds(low, high, &object);
}

lmb_scene *mix_copy_scene(lmb_material **materials, mix_job *j, report *r)
{
    lmb_scene *out = mix_take(j, sizeof *out, r);
    lmb_material *m = mix_take(j, j->scene.material_count * sizeof *m, r);
    if (out == NULL || m == NULL) {
        return NULL;
    }
    *out = j->scene;
    memcpy(m, j->scene.materials, j->scene.material_count * sizeof *m);
    out->materials = *materials = m;
    return out;
}

enum { ROWS = 16 };

static void normals_of_rows(void *user, int index, int thread)
{
    (void)thread;
    lmb_cloud_normals(user, index * ROWS, (index + 1) * ROWS);
}

static int find_normals(mix_job *j)
{
    pool_run(pool_threads(j->o.threads), (j->frame.camera.height + ROWS - 1) / ROWS, normals_of_rows, &j->cloud);
    return 1;
}

static int find_cloud(mix_job *j, report *r)
{
    const lmb_pinhole *c = &j->frame.camera;
    const size_t a = lmb_cloud_bytes(c->width, c->height), b = lmb_planes_bytes(c->width, c->height);
    void *cloud = mix_take(j, a, r), *planes = mix_take(j, b, r);
    if (cloud == NULL || planes == NULL) {
        return 0;
    }
    if (lmb_cloud_init(&j->cloud, c, j->frame.depth, cloud, a) != LMB_OK || !find_normals(j) ||
        lmb_planes_find(&j->planes, &j->cloud, planes, b) != LMB_OK) {
        return report_fail(r, "the photo's camera or size is none that can be used");
    }
    return 1;
}

int mix_find_planes(mix_job *j, report *r)
{
    lmb_pinhole_round(&j->frame.camera);
    if (!find_cloud(j, r)) {
        return 0;
    }
    lmb_planes_move(&j->cloud, &j->planes);
    return mix_drop_islands(j, r);
}
