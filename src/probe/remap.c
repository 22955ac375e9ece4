/* remap.c: the world as an object's place sees it: its numbers, then the kernel. Floor 6.                   [S5-S8] */
#include "../base/poly.h"
#include "../base/vec.h"
#include "../lane/kernels.h"

#if LMB_PROBES

#define INSIDE 0.999f /* a place outside the far world is pulled in to this share of its size */

/* Nearest to `at`, inside the far world. */
static lmb_vec3 pull_in(const lmb_world_pictures *p, lmb_vec3 at)
{
    if (p->shape == LMB_WORLD_SPHERE) {
        const lmb_vec3 d = sub3(at, p->middle);
        const float length = length3(d), most = INSIDE * p->radius;
        return length > most ? add3(p->middle, mul3(d, most / length)) : at;
    }
    const lmb_vec3 middle = mul3(add3(p->low, p->high), 0.5f), half = mul3(sub3(p->high, p->low), 0.5f * INSIDE);
    return max3(min3(at, add3(middle, half)), sub3(middle, half));
}

static void set_cube(lmb_remap_job *job, const lmb_world *w, lmb_vec3 at, int32_t table_width)
{
    const lmb_world_pictures *p = &w->pictures;
    const lmb_vec3 d = sub3(at, p->middle), low = sub3(p->low, at), high = sub3(p->high, at);
    int32_t level = 0;
    while (level + 1 < w->cube_levels && w->cube[level].width > table_width / 4) {
        ++level;
    }
    job->side = w->cube[level].width;
    job->cube_at = (int32_t)w->cube[level].at;
    job->shape = p->shape;
    job->from_centre = sub3(at, p->centre);
    job->from_middle = d;
    job->outside2 = dot3(d, d) - p->radius * p->radius;
    job->to_low[0] = low.x;
    job->to_low[1] = low.y;
    job->to_low[2] = low.z;
    job->to_high[0] = high.x;
    job->to_high[1] = high.y;
    job->to_high[2] = high.z;
}

/* A level's limit is a texel and a half of its own: the next one's would be nearer in size. */
static void set_ground(lmb_remap_job *job, const lmb_world *w, lmb_vec3 at)
{
    const lmb_world_pictures *p = &w->pictures;
    job->height = at.y - p->ground_y;
    job->ground_levels = w->ground_levels > 0 && job->height > 0.0f ? w->ground_levels : 0;
    if (job->ground_levels == 0) {
        return;
    }
    job->ground_x = at.x - p->ground_x;
    job->ground_z = at.z - p->ground_z;
    job->ground_width_m = p->ground_width_m;
    job->ground_depth_m = p->ground_depth_m;
    job->ground_per_x = 1.0f / p->ground_width_m;
    job->ground_per_z = 1.0f / p->ground_depth_m;
    job->ground_from = (int32_t)w->ground[0].at;
    for (int32_t i = 0; i < w->ground_levels; ++i) {
        const lmb_world_level *l = &w->ground[i];
        job->ground_columns[i] = (float)l->width;
        job->ground_rows[i] = (float)l->height;
        job->ground_at[i] = (float)(l->at - w->ground[0].at);
        job->ground_limit[i] =
            1.41421356f * maxf(p->ground_width_m / (float)l->width, p->ground_depth_m / (float)l->height);
    }
}

lmb_status lmb_probe_remap(float *map, const lmb_kernels *kernels, const lmb_world *world, const lmb_probe_table *table,
                           lmb_vec3 at, int32_t blend)
{
    lmb_remap_job job;
    if (map == NULL || kernels == NULL || world == NULL || table == NULL || !is_sane(at.x) || !is_sane(at.y) ||
        !is_sane(at.z)) {
        return LMB_ERR_ARG;
    }
    at = pull_in(&world->pictures, at);
    job.texels = world->texels;
    job.format = world->format;
    job.log8 = world->log8;
    job.log16 = world->log16;
    job.direction = table->direction;
    job.count = table->width * table->height;
    job.ray_width = LMB_PI / (float)table->height;
    job.blend = blend;
    set_cube(&job, world, at, table->width);
    set_ground(&job, world, at);
    kernels->remap(map, &job);
    return LMB_OK;
}

#endif
