/* mix_stand.c: the object's plane, size and a position on that plane in full view. */
#include "mix_job.h"

#include <math.h>

#define UNDER_TABLE 0.3f        /* m, minimum height of a table above the lowest plane */
#define LEVEL       0.90630779f /* cosine of 25 degrees: maximum slope of a floor */
#define UPRIGHT     0.25881905f /* cosine of 75 degrees: for walls */
#define WALL        0.25f       /* m: minimum shorter side of a wall; a table's edge is narrower */

static float dot(lmb_vec3 a, lmb_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

static lmb_vec3 moved(lmb_vec3 p, lmb_vec3 by, float far)
{
    const lmb_vec3 out = {p.x + by.x * far, p.y + by.y * far, p.z + by.z * far};
    return out;
}

mix_extent mix_extent_of(const mix_job *j)
{
    const lmb_vec3 lo = j->object.scene.bounds_min, hi = j->object.scene.bounds_max;
    const float x = hi.x - lo.x, y = hi.y - lo.y, z = hi.z - lo.z;
    const mix_extent e = {0.6f * hypotf(x, j->hangs ? y : z), j->hangs ? z : y, fmaxf(fmaxf(x, y), z)};
    return e;
}

/* --- size --------------------------------------------------------------------------------------------------------- */

/* With --fit, the object's longest side is a sixth of the plane's mean side; half a metre if there is no plane. */
static float chosen_scale(const mix_job *j)
{
    float room = 3.0f;
    if (!j->o.fit) {
        return j->o.scale > 0.0f ? j->o.scale : 1.0f;
    }
    if (j->floor >= 0) {
        const lmb_flat *p = &j->planes.plane[j->floor];
        room = sqrtf((p->high[0] - p->low[0]) * (p->high[1] - p->low[1]));
    }
    return room / 6.0f / fmaxf(mix_extent_of(j).longest, 1e-9f);
}

/* --- plane -------------------------------------------------------------------------------------------------------- */

/* The lowest level plane, or -1. */
static int32_t lowest(const lmb_planes *planes, lmb_vec3 up)
{
    int32_t low = -1;
    for (int32_t i = 0; i < planes->count; ++i) {
        const lmb_flat *p = &planes->plane[i];
        if (dot(p->normal, up) > LEVEL && (low < 0 || dot(p->centre, up) < dot(planes->plane[low].centre, up))) {
            low = i;
        }
    }
    return low;
}

static int is_upright(const lmb_flat *p, lmb_vec3 up) { return fabsf(dot(p->normal, up)) < UPRIGHT; }

static int is_wall(const lmb_flat *p, lmb_vec3 up)
{
    return is_upright(p, up) && fminf(p->high[0] - p->low[0], p->high[1] - p->low[1]) > WALL;
}

/* The first plane that --on allows, or -1; planes are sorted by area in the picture. */
static int32_t plane_asked(const mix_job *j, lmb_vec3 up)
{
    const int32_t low = lowest(&j->planes, up);
    for (int32_t i = 0; i < j->planes.count && j->o.on != MIX_ON_FLOOR; ++i) {
        const lmb_flat *p = &j->planes.plane[i];
        const float level = dot(p->normal, up);
        if (j->o.on == MIX_ON_WALL ? is_wall(p, up)
                                   : level > LEVEL && dot(p->centre, up) - dot(j->planes.plane[low].centre, up) >
                                                          UNDER_TABLE) {
            return i;
        }
    }
    return j->o.on == MIX_ON_FLOOR ? low : -1;
}

/* If no plane faces up: the first large enough wall, or the first plane. */
static int32_t wall_of(const mix_job *j, lmb_vec3 up)
{
    for (int32_t i = 0; i < j->planes.count; ++i) {
        if (is_wall(&j->planes.plane[i], up)) {
            return i;
        }
    }
    return 0;
}

/* An object cannot stand on an upright plane, so it hangs there. */
static void choose_hanging(mix_job *j)
{
    const lmb_vec3 up = mix_up(j);
    j->hangs = is_upright(&j->planes.plane[j->floor], up);
    j->up = j->hangs ? up : j->planes.plane[j->floor].normal;
}

static int find_plane(mix_job *j, report *r)
{
    const lmb_vec3 up = mix_up(j);
    static const char *const none[] = {"", "--on floor: no plane faces up",
                                       "--on table: no plane lies 0.3 m over another",
                                       "--on wall: no plane is upright and over 0.25 m wide and high"};
    j->floor = j->o.on == MIX_ON_ANY ? mix_floor(j) : plane_asked(j, up);
    j->faces_up = j->floor >= 0;
    if (j->floor < 0 && j->o.on != MIX_ON_ANY) {
        return report_fail(r, "%s; --show planes shows them, --at X,Y names one", none[j->o.on]);
    }
    j->floor = j->floor < 0 ? wall_of(j, up) : j->floor;
    choose_hanging(j);
    return 1;
}

/* --- position on the plane ---------------------------------------------------------------------------------------- */

static int is_in_picture(const lmb_pinhole *c, lmb_vec3 p)
{
    const float x = c->cx - c->fx * p.x / p.z, y = c->cy + c->fy * p.y / p.z;
    return p.z < 0.0f && x >= 0.0f && y >= 0.0f && x < (float)c->width && y < (float)c->height;
}

int mix_is_in_view(const mix_job *j, const lmb_flat *p, lmb_vec3 at, const mix_extent *e)
{
    const float radius = e->radius / 1.2f * j->scale; /* without the extra fifth */
    for (int k = 0; k < 8; ++k) {
        const lmb_vec3 rim = moved(moved(at, p->across, (k & 1 ? radius : -radius) * (k & 2 ? 0.0f : 1.0f)), p->along,
                                   (k & 1 ? radius : -radius) * (k & 2 ? 1.0f : 0.0f));
        const lmb_vec3 off = moved(rim, p->centre, -1.0f);
        const float x = dot(off, p->across), y = dot(off, p->along);
        if (!is_in_picture(&j->frame.camera, moved(rim, p->normal, k & 4 ? e->height * j->scale : 0.0f)) ||
            x < p->low[0] || x > p->high[0] || y < p->low[1] || y > p->high[1]) {
            return 0;
        }
    }
    return 1;
}

/* The position nearest to the plane's middle with the object wholly in view, even if other things stand there. */
static int stand_in_view(mix_job *j)
{
    enum { STEP = 4 };
    const mix_extent e = mix_extent_of(j);
    const lmb_flat *p = &j->planes.plane[j->floor];
    float near = INFINITY;
    for (int32_t y = p->y0; y < p->y1; y += STEP) {
        for (int32_t x = p->x0; x < p->x1; x += STEP) {
            lmb_vec3 at;
            if (j->planes.label[y * j->frame.camera.width + x] == j->floor + 1 &&
                lmb_planes_anchor(&at, &j->planes, &j->frame.camera, j->floor, (float)x, (float)y)) {
                const lmb_vec3 off = moved(at, p->centre, -1.0f);
                if (dot(off, off) < near && mix_is_in_view(j, p, at, &e)) {
                    near = dot(off, off);
                    j->anchor = at;
                }
            }
        }
    }
    return near < INFINITY;
}

/* Tries the middle of the plane, or a place beside things that stand there, with the whole object in the picture and
 * nothing in front of it; with --fit also for smaller sizes. Otherwise takes a position wholly in view, or one that
 * shows at least the foot or part of it. */
static void stand_free(mix_job *j)
{
    enum { SIZES = 6 };
    const mix_extent e = mix_extent_of(j);
    const float max = j->scale;
    for (int i = 0; i < (j->o.fit ? SIZES : 1); ++i) {
        if (lmb_planes_clear(&j->anchor, &j->planes, &j->cloud, j->floor, e.radius * j->scale, e.height * j->scale)) {
            return;
        }
        j->scale *= j->o.fit ? 0.75f : 1.0f;
    }
    j->scale = max;
    float foot = stand_in_view(j) ? 0.0f : e.radius * max;
    for (int i = 0; i < SIZES && foot > 0.0f; ++i, foot *= 0.75f) {
        if (lmb_planes_clear(&j->anchor, &j->planes, &j->cloud, j->floor, foot, 0.0f)) {
            return;
        }
    }
}

static int stand_at_centre(mix_job *j, report *r)
{
    if (!find_plane(j, r)) {
        return 0;
    }
    j->anchor = j->planes.plane[j->floor].centre;
    j->scale = chosen_scale(j);
    stand_free(j);
    return 1;
}

/* Uses the plane of the pixel, or the point measured there, upright. If nothing is measured, the anchor does not lie
 * ahead. */
static int stand_at_pixel(mix_job *j, report *r)
{
    const int32_t w = j->frame.camera.width, h = j->frame.camera.height;
    if (!(j->o.at_px[0] >= 0.0f && j->o.at_px[1] >= 0.0f && j->o.at_px[0] < (float)w && j->o.at_px[1] < (float)h)) {
        return report_fail_usage(r, "--at %g,%g: the photo has %d x %d pixels", (double)j->o.at_px[0],
                                 (double)j->o.at_px[1], (int)w, (int)h);
    }
    const int32_t x = (int32_t)j->o.at_px[0], y = (int32_t)j->o.at_px[1];
    const int32_t label = j->planes.label[y * w + x];
    j->floor = label - 1;
    j->faces_up = 1; /* or was requested */
    if (label > 0) {
        choose_hanging(j);
    }
    j->scale = chosen_scale(j);
    if (label > 0) {
        lmb_planes_anchor(&j->anchor, &j->planes, &j->frame.camera, j->floor, j->o.at_px[0], j->o.at_px[1]);
    } else {
        j->anchor = lmb_cloud_point(&j->cloud, x, y);
    }
    return 1;
}

int mix_stand(mix_job *j, report *r)
{
    return j->o.at == MIX_AT_WORLD || (j->o.at == MIX_AT_PIXEL ? stand_at_pixel(j, r) : stand_at_centre(j, r));
}
