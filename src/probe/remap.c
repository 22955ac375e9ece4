/* remap.c: sets up jobs and runs the kernels that see the world from a point or along rays. Layer 5. [S5-S8, S17] */
#include "../base/poly.h"
#include "../base/vec.h"
#include "../lane/kernels.h"
#include "world.h"

#if LMB_PROBES

/* of the far world's size: points outside are clamped to it, or to the centre's distance */
#define MAX_PLACE_SHARE 0.999f

static void set_job_cube(lmb_world_job *job, const lmb_world *w, int is_calm)
{
    const lmb_world_pictures *p = &w->pictures;
    const lmb_world_level *levels = is_calm ? w->calm : w->cube;
    const lmb_vec3 middle = mul3(add3(p->low, p->high), 0.5f),
                   half = mul3(sub3(p->high, p->low), 0.5f * MAX_PLACE_SHARE);
    const float max = 0.5001f * LMB_PI; /* a face, rad: levels with texels narrower than the ray are skipped */
    int32_t level = is_calm && w->cube_levels > 1; /* level 0 contains all light */
    while (level + 1 < w->cube_levels && (float)levels[level].width * job->ray_width > max) {
        ++level;
    }
    job->side = levels[level].width;
    job->cube_at = (int32_t)levels[level].at;
    job->shape = p->shape;
    job->has_floor = p->has_floor;
    job->centre = p->centre;
    job->middle = p->middle;
    job->radius2 = p->radius * p->radius;
    job->reach = maxf(MAX_PLACE_SHARE * p->radius, length3(sub3(p->centre, p->middle)));
    job->low = p->low;
    job->high = p->high;
    job->reach_low = min3(sub3(middle, half), p->centre);
    job->reach_high = max3(add3(middle, half), p->centre);
}

/* A level serves rays up to one and a half texels wide; for wider ones the next level's texels are closer in size. */
static void set_job_ground(lmb_world_job *job, const lmb_world *w)
{
    const lmb_world_pictures *p = &w->pictures;
    job->ground_levels = w->ground_levels;
    job->ground = vec3(p->ground_x, p->ground_y, p->ground_z);
    if (job->ground_levels == 0) {
        return;
    }
    job->ground_width_m = p->ground_width_m;
    job->ground_depth_m = p->ground_depth_m;
    job->ground_per_x = 1.0f / p->ground_width_m;
    job->ground_per_z = 1.0f / p->ground_depth_m;
    job->ground_from = (int32_t)w->ground[0].at;
    for (int32_t i = 0; i < w->ground_levels; ++i) {
        const lmb_world_level *l = &w->ground[i];
        job->ground_columns[i] = (float)l->width;
        job->ground_rows[i] = (float)l->height;
        job->ground_at[i] = (int32_t)(l->at - w->ground[0].at);
        job->ground_limit[i] =
            1.41421356f * maxf(p->ground_width_m / (float)l->width, p->ground_depth_m / (float)l->height);
    }
}

void lmb_world_ask(lmb_world_job *out, const lmb_world *world, int32_t of, float ray_width, int32_t blend)
{
    out->texels = world->texels;
    out->format = world->format;
    out->log8 = world->log8;
    out->log16 = world->log16;
    out->ray_width = ray_width;
    out->blend = blend;
    out->means = 0;
    set_job_cube(out, world, of == LMB_WORLD_CALM && world->peaks > 0);
    set_job_ground(out, world);
}

/* Flushes values under a millionth of a micrometre to 0: kernels must not meet denormals. */
static float no_speck(float v) { return absf(v) < 1e-12f ? 0.0f : v; }

lmb_status lmb_probe_remap(float *map, const lmb_kernels *kernels, const lmb_world *world, const lmb_probe_table *table,
                           lmb_vec3 at, int32_t blend)
{
    lmb_world_job job;
    if (map == NULL || kernels == NULL || world == NULL || world->texels == NULL || table == NULL ||
        table->direction == NULL || !is_place(at) || world->peaks < 0 || world->peaks > LMB_WORLD_PEAKS) {
        return LMB_ERR_ARG;
    }
    lmb_world_ask(&job, world, LMB_WORLD_CALM, LMB_PI / (float)table->height, blend);
    at = vec3(no_speck(at.x), no_speck(at.y), no_speck(at.z));
    kernels->remap(map, table->direction, table->width * table->height, at, &job);
    lmb_world_add_peaks(map, table, &job, world, at);
    return LMB_OK;
}

#endif
