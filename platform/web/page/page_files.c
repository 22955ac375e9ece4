/* page_files.c: the tool's files (io_file.h) in memory: files from the page, and files that a verb writes; and stubs of
 * calls that the page leaves out. */
#include "page_calls.h"

#include <stdlib.h>
#include <string.h>

#include "../../../tools/common/area_light.h"
#include "../../../tools/common/io_file.h"
#include "../../../tools/mix/mix_frames.h"
#include "../../../tools/mix/mix_front.h"
#include "../../../tools/mix/mix_again.h"
#include "../../../tools/mix/mix_carry.h"
#include "../../../tools/mix/mix_labels.h"
#include "../../../tools/mix/mix_near.h"
#include "../../../tools/mix/mix_run.h"
#include "../../../tools/mix/mix_world.h"
#include "../../../tools/mix/mix_around.h"
#include "../../../tools/mix/mix_lobes.h"
#include "../../../tools/mix/mix_mirror.h"
#include "../../../tools/mix/mix_sources.h"
#include "../../../tools/mix/mix_lights.h"
#include "../../../tools/picture/image.h"
#include "../../../tools/picture/io_jpeg.h"
#include "../../../tools/picture/io_pam.h"
#include "../../../tools/relief/relief_compare.h"
#include "../../../tools/relief/relief_crowd.h"
#include "../../../tools/relief/relief_path.h"
#include "../../../tools/relief/relief_sky.h"
#include "../../../tools/relief/relief_withheld.h"
#include "../../../tools/relight/relight_contact.h"
#include "../../../tools/relight/relight_export.h"
#include "../../../tools/relight/relight_path.h"
#include "../../../tools/relight/relight_way.h"
#include "../../../tools/render/budget.h"
#include "../../../tools/render/render_slice.h"
#include "../../../tools/render/wireframe.h"

enum { FILES = 256, NAME_BYTES = 256 };

static struct kept {
    char name[NAME_BYTES]; /* "": free */
    uint8_t *data;
    size_t size;
} files[FILES];

/* Finds a file's slot, or a free one for a new name. NULL: none is left, or the name is too long. */
static struct kept *find(const char *name, int is_new)
{
    struct kept *empty = NULL;
    if (name[0] == '\0' || strlen(name) >= NAME_BYTES) {
        return NULL;
    }
    for (int i = 0; i < FILES; ++i) {
        if (strcmp(files[i].name, name) == 0) {
            return &files[i];
        }
        empty = empty == NULL && files[i].name[0] == '\0' ? &files[i] : empty;
    }
    return is_new ? empty : NULL;
}

int page_file_put(const char *name, uint8_t *data, size_t size)
{
    struct kept *k = find(name, 1);
    if (k == NULL) {
        free(data);
        return 0;
    }
    free(k->data);
    strcpy(k->name, name);
    k->data = data;
    k->size = size;
    return 1;
}

const uint8_t *page_file_data(const char *name)
{
    const struct kept *k = find(name, 0);
    return k != NULL ? k->data : NULL;
}

size_t page_file_size(const char *name)
{
    const struct kept *k = find(name, 0);
    return k != NULL ? k->size : 0;
}

void page_file_drop(const char *name)
{
    struct kept *k = find(name, 0);
    if (k != NULL) {
        free(k->data);
        memset(k, 0, sizeof *k);
    }
}

/* --- io_file.h ---------------------------------------------------------------------------------------------------- */

static int copy_to(file_bytes *out, const void *data, size_t size, const char *path, report *r)
{
    out->data = malloc(size > 0 ? size : 1);
    out->size = out->data != NULL ? size : 0;
    if (out->data == NULL) {
        return report_fail(r, "%s: out of memory after 0 bytes", path);
    }
    memcpy(out->data, data, size);
    return 1;
}

int file_is_plain(const char *path, report *r)
{
    return find(path, 0) != NULL || report_fail(r, "%s: is not here; drop it together with the scene", path);
}

int file_read(file_bytes *out, const char *path, report *r)
{
    const struct kept *k = find(path, 0);
    memset(out, 0, sizeof *out);
    return file_is_plain(path, r) && copy_to(out, k->data, k->size, path, r);
}

/* A page has no folders; only dropped files exist. */
int file_is_folder(const char *path) { (void)path; return 0; }
void file_only_here(void) {}
int file_is_below(const char *path, const char *folder, size_t folder_size, report *r)
{
    (void)path;
    (void)folder;
    (void)folder_size;
    (void)r;
    return 1;
}

void file_free(file_bytes *file)
{
    free(file->data);
    memset(file, 0, sizeof *file);
}

int file_write(const char *path, const void *data, size_t size, report *r)
{
    file_bytes copy;
    return copy_to(&copy, data, size, path, r) &&
           (page_file_put(path, copy.data, copy.size) || report_fail(r, "%s: too many files", path));
}

/* There are no devices, no links to files, and no temporary files that a signal could leave. */
int file_is_stdout(const char *path) { return strcmp(path, "-") == 0; }
int file_keep(const char *path, report *r) { return (void)path, (void)r, 1; }
void file_keep_all(void) {}
void file_keep_end(void) {}
int file_suits(const char *option, const char *path, const char *own, report *r)
{
    return (void)option, (void)path, (void)own, (void)r, 1;
}
int file_can_write(const char *path, report *r) { return (void)path, (void)r, 1; }
int file_may_replace(const char *path, report *r) { return (void)path, (void)r, 1; }
int file_is_same_place(const char *a, const char *b) { return strcmp(a, b) == 0; }
void file_drop_aside(void) {}

/* --- image.h: the page shows outputs of verbs as .ppm, so it has no packer ---------------------------------------- */

static int is_ppm_only(report *r) { return report_fail(r, "a page writes no .png; name a .ppm"); }
int png_encode(file_bytes *out, const uint8_t *rgb, int32_t width, int32_t height, report *r)
{
    return (void)out, (void)rgb, (void)width, (void)height, is_ppm_only(r);
}
int png_encode_alpha(file_bytes *out, const uint8_t *rgba, int32_t width, int32_t height, report *r)
{
    return png_encode(out, rgba, width, height, r);
}

/* --- relight_*.h: a world has one place, and objects stay and hide nothing ---------------------------------------- */

int contact_make(contact *c, figures *f, relight_light *w, const relight_options *o, report *r)
{
    return (void)c, (void)f, (void)w, (void)o, (void)r, 1;
}
lmb_status contact_band(const contact *c, const figures *f, const ground_lights *g, const lmb_relight *l,
                        lmb_relight_scratch *s, float *rows, const lmb_surface *out, int32_t band)
{
    return (void)c, (void)f, (void)g, (void)rows, lmb_relight_band(l, s, out, band);
}
void contact_free(contact *c) { (void)c; }
int ground_lights_take(ground_lights *g, const figures *f, relight_light *w, const relight_options *o, report *r)
{
    return (void)g, (void)f, (void)w, (void)o, (void)r, 1;
}
lmb_status ground_band(const ground_lights *g, const contact *c, const lmb_relight *l, lmb_relight_scratch *s,
                       const lmb_surface *out, int32_t band)
{
    return (void)g, (void)c, (void)l, (void)s, (void)out, (void)band, LMB_OK;
}
void ground_lights_free(ground_lights *g) { (void)g; }

int relight_exports(const relight_options *o)
{
    return o->map != NULL || o->vectors_out != NULL || o->lobes != NULL || o->harmonics != NULL || o->dfg != NULL;
}
int relight_export_check(const relight_options *o, report *r)
{
    return !relight_exports(o) || report_fail(r, "the page writes no light for other programs");
}
int relight_export(relight_light *w, const relight_options *o, lmb_vec3 at, report *r)
{
    return (void)w, (void)o, (void)at, (void)r, 1;
}

int figures_load_many(figures *f, const relight_options *o, report *r)
{
    return (void)f, (void)o, report_fail(r, "--object: the page has one");
}

lmb_vec3 way_move(way *w, lmb_vec3 at, float radius) { return (void)w, (void)radius, at; }
void way_turn(way *w, int32_t slot, int is_computed, float radius) { (void)w, (void)slot, (void)is_computed, (void)radius; }
int way_show(lmb_probe_cube *out, float *step, way_cube *c, const way *w, const float *planes, int32_t n, report *r)
{
    return (void)out, (void)step, (void)c, (void)w, (void)planes, (void)n, (void)r, 0;
}
void way_free(way *w) { (void)w; }

int place_list_read(place_list *out, const char *path, report *r)
{
    return (void)out, report_fail(r, "%s: the page draws one picture", path);
}
void place_list_free(place_list *list) { (void)list; }
int place_list_walk(const place_list *list, const char *out, place_draw *draw, void *user, const lmb_probe_cache *cache,
                    int is_quiet, report *r)
{
    return (void)list, (void)out, (void)draw, (void)user, (void)cache, (void)is_quiet, (void)r, 0;
}
int place_tell(const place_list *list, int32_t i, const char *name, int is_kept, int is_quiet)
{
    return (void)list, (void)i, (void)name, (void)is_quiet, is_kept;
}

int relight_worlds_check(const relight_options *o, report *r)
{
    return o->worlds == 1 || report_fail(r, "--world: the page has one");
}
int relight_light_see(relight_light *w, const relight_options *o, lmb_vec3 at)
{
    return lmb_probe_remap(w->map, o->kernels, w->world, w->table, at, o->blend) == LMB_OK;
}
int relight_light_reflect(relight_light *w, const relight_options *o, float *planes, int32_t n, lmb_probe_rays *rays,
                          lmb_vec3 at, float roughness)
{
    const lmb_world_query query = {w->world, 0.0f, o->blend};
    return lmb_probe_reflect(planes, n, o->kernels, rays, &query, at, roughness) == LMB_OK;
}
const lmb_world *relight_light_nearest(const relight_light *w, const relight_options *o, lmb_vec3 at)
{
    return (void)o, (void)at, w->world;
}

/* --- relief_compare.h: reliefs on the page have no model ---------------------------------------------------------- */

int relief_tell(const relief_frame *f, relief_shot shot, const lmb_scene *complex, report *r)
{
    return (void)f, (void)shot, (void)complex, report_fail(r, "--compare: not on the page");
}

const option_row relief_path_rows[] = {{.kind = OPTION_END}};
int relief_path_check(const relief_options *o, report *r) { return (void)o, (void)r, 1; }
int relief_path_open(key_path *out, const relief_options *o, const lmb_light *light, report *r)
{
    return (void)out, (void)o, (void)light, (void)r, 1;
}
int relief_path_leads(const key_path *path, int what) { return (void)path, (void)what, 0; }
int relief_along(relief_options *o, const key_path *path, relief_shot *shot, lmb_light *light, const lmb_scene *simple,
                 relief_write *write, report *r)
{
    return (void)o, (void)path, (void)shot, (void)light, (void)simple, (void)write, (void)r, 0;
}
void key_path_free(key_path *path) { (void)path; }

/* --- relief_crowd.h, relief_sky.h, relief_withheld.h: a page draws one relief, without a world ---------------- */

int relief_crowd_read(relief_crowd *out, const char *path, report *r)
{
    return (void)out, (void)path, report_fail(r, "a page draws no crowds");
}
void relief_crowd_free(relief_crowd *c) { (void)c; }
uint32_t relief_crowd_see(relief_seen *out, const relief_crowd *crowd, const lmb_view *view)
{
    return (void)out, (void)crowd, (void)view, 0;
}
size_t crowd_band_take(crowd_band *out, int32_t width) { return (void)out, (void)width, 0; }
void crowd_band_free(crowd_band *b) { (void)b; }
lmb_status crowd_band_draw(crowd_band *b, const relief_seen *seen, uint32_t count, const lmb_view *view,
                           const lmb_kernels *kernels, const lmb_relief_how *how, int32_t first, int32_t past,
                           lmb_relief_stats *stats)
{
    return (void)b, (void)seen, (void)count, (void)view, (void)kernels, (void)how, (void)first, (void)past, (void)stats,
           LMB_ERR_ARG;
}
void crowd_band_tile(lmb_tile *out, const crowd_band *b, int32_t column, int32_t row, int32_t x, int32_t y)
{
    (void)out, (void)b, (void)column, (void)row, (void)x, (void)y;
}
int relief_sky_open(relief_sky *out, const char *path, const lmb_scene *below, lmb_vec3 eye, int is_quiet, report *r)
{
    return (void)out, (void)path, (void)below, (void)eye, (void)is_quiet, report_fail(r, "a page has no --world here");
}
void relief_sky_free(relief_sky *s) { (void)s; }
lmb_status relief_sky_tile(lmb_irradiance *inout, relief_sky_scratch *scratch, const relief_sky *s,
                           const lmb_kernels *kernels, const lmb_tile *tile, uint64_t of_relief, const lmb_bvh *plain,
                           const lmb_bvh *both)
{
    return (void)inout, (void)scratch, (void)s, (void)kernels, (void)tile, (void)of_relief, (void)plain, (void)both,
           LMB_ERR_ARG;
}
void relief_sky_behind(float rgb[3], const relief_sky *s, const lmb_view *view, int32_t x, int32_t y)
{
    (void)rgb, (void)s, (void)view, (void)x, (void)y;
}
int relief_photo_read(relief_photo *out, const char *prefix, report *r)
{
    return (void)out, (void)prefix, report_fail(r, "a page has no --photo here");
}
void relief_photo_free(relief_photo *p) { (void)p; }
void withheld_measure(withheld_figures *out, const relief_frame *frame, const relief_photo *photo)
{
    (void)out, (void)frame, (void)photo;
}

/* --- area_light.h, mix_*.h: lights have no size, and depth is exact ----------------------------------------------- */

void area_light(lmb_light *out, int32_t count, const lmb_light *from, float size)
{
    (void)size;
    for (int32_t i = 0; i < count; ++i) {
        out[i] = *from;
    }
}
void mix_front_refine(float *out, mix_way *way, const lmb_cloud *cloud, const lmb_planes *planes, const float *rgb,
                      const int32_t box[4])
{
    (void)box, (void)out, (void)way, (void)cloud, (void)planes, (void)rgb;
}
void mix_front_tile(lmb_tile *out, const lmb_tile *real, const lmb_tile *object, const float *front,
                    const lmb_cloud *cloud, float x, float y)
{
    (void)object, (void)front, (void)cloud, (void)x, (void)y;
    *out = *real;
}
int mix_frames(const mix_options *o, report *r) { return report_fail(r, "%s: the page mixes one photo", o->frames); }
lmb_cone_trace mix_trace(const mix_job *j, int32_t world)
{
    return (lmb_cone_trace){j->o.kernels, &j->voxels, world, world, &j->env[world], j->scratch, 1};
}
const lmb_tile *mix_tile_there(lmb_tile *room, const mix_job *j, const lmb_tile *in) { return (void)room, (void)j, in; }
lmb_vec3 mix_point_there(const mix_job *j, lmb_vec3 p) { return (void)j, p; }
int mix_cells(mix_job *j, report *r) { return (void)j, (void)r, 1; }
int mix_world_stays(mix_job *j) { return (void)j, 0; }
int mix_world_begins(mix_job *j, report *r) { return (void)r, j->world = j, 1; }
int mix_carry_take(mix_job *j, report *r) { return (void)j, (void)r, 1; }
uint64_t mix_carry_get(lmb_irradiance *without, lmb_irradiance *with, mix_direct *direct, const mix_job *j,
                       const lmb_tile *real)
{
    return (void)without, (void)with, (void)direct, (void)j, (void)real, 0;
}
uint64_t mix_carry_spread(lmb_irradiance *without, lmb_irradiance *with, const lmb_tile *real, uint64_t carried,
                          uint64_t wanted)
{
    return (void)without, (void)with, (void)real, (void)carried, (void)wanted, 0;
}
int mix_carry_knows(const mix_job *j, int32_t x, int32_t y) { return (void)j, (void)x, (void)y, 0; }
int mix_carry_turn(const mix_job *j, int32_t x, int32_t y) { return (void)j, (void)x, (void)y, 0; }
void mix_carry_put_direct(const mix_job *j, const lmb_tile *real, const mix_direct *direct)
{
    (void)j, (void)real, (void)direct;
}
void mix_carry_put(const mix_job *j, const lmb_tile *real, const lmb_irradiance *without, const lmb_irradiance *with)
{
    (void)j, (void)real, (void)without, (void)with;
}
void mix_cones_near(lmb_irradiance *inout, const mix_job *j, const lmb_tile *tile, mix_near *near)
{
    (void)inout, (void)j, (void)tile, (void)near;
}
int mix_again_light(lmb_irradiance *without, lmb_irradiance *with, const mix_job *j, const lmb_tile *real)
{
    return (void)without, (void)with, (void)j, (void)real, 0;
}
void mix_again_object(lmb_radiance *object, float *covered, const mix_job *j, const lmb_tile *real)
{
    (void)object, (void)covered, (void)j, (void)real;
}
int mix_again_take(mix_job *j, report *r) { return (void)j, (void)r, 1; }
void mix_again_keep(mix_job *j, const lmb_tile *real, const lmb_irradiance *without, const lmb_irradiance *with,
                    const lmb_radiance *object, const float *covered)
{
    (void)j, (void)real, (void)without, (void)with, (void)object, (void)covered;
}
void mix_lights_begin(mix_job *j) { (void)j; }
void mix_lights_tile(lmb_irradiance *without, lmb_irradiance *with, mix_direct *direct, const mix_job *j,
                     const lmb_view *view, const lmb_tile *real)
{
    (void)direct;
    for (int32_t i = 0; i < j->light_count; ++i) {
        lmb_direct_tile(without, j->o.kernels, real, view, &j->scene, &j->lights[i], &j->maps[i][0]);
        lmb_direct_tile(with, j->o.kernels, real, view, &j->scene, &j->lights[i], &j->maps[i][1]);
    }
}
float mix_guess_sun(lmb_light *out, float *softens, const mix_job *j)
{
    return *out = j->o.lights[0], *softens = 0.0f, 0.0f;
}
const lmb_irradiance *mix_soften(lmb_irradiance *room, const lmb_irradiance *with, const lmb_irradiance *without,
                                 float share)
{
    return (void)room, (void)without, (void)share, with;
}

/* --- mix_labels.h: no label pictures ----------------------------------------------------------------------------- */

int mix_labels_take(mix_job *j, report *r) { return (void)j, (void)r, 1; }
int mix_labels_write(const mix_job *j, float ev, report *r) { return (void)j, (void)ev, (void)r, 1; }
void mix_labels_sample(const mix_job *j, const lmb_tile *real, const lmb_tile *object, uint64_t shown)
{
    (void)j, (void)real, (void)object, (void)shown;
}
void mix_labels_cover(const mix_job *j, const lmb_tile *real, const lmb_radiance *over,
                      const float covered[LMB_TILE_PIXELS])
{
    (void)j, (void)real, (void)over, (void)covered;
}
void mix_labels_grain(lmb_radiance *inout, const mix_job *j, const lmb_tile *real,
                      const float covered[LMB_TILE_PIXELS])
{
    (void)inout, (void)j, (void)real, (void)covered;
}

/* --- mix_frame.h, mix_job.h: depth has the photo's size, and planes do not change --------------------------------- */

int mix_drop_islands(mix_job *j, report *r) { return (void)j, (void)r, 1; }

int mix_has_shape(const mix_frame *f, const image *in) { return (void)f, (void)in, 0; }
int mix_resample(mix_frame *f, const image *in, float scale) { return (void)f, (void)in, (void)scale, 0; }

/* --- wireframe.h: without draw.h --------------------------------------------------------------------------------- */

lmb_status wireframe_draw(render_job *j) { return (void)j, LMB_ERR_ARG; }

/* --- mix_lobes.h, mix_mirror.h, mix_sources.h, mix_job.h: objects are matt, planes do not change ------------------ */

void mix_lobes_read(mix_job *j) { (void)j; }
int mix_lobes_take(mix_job *j, report *r) { return (void)j, (void)r, 1; }
void mix_mirror_planes(mix_job *j) { (void)j; }
int mix_around(mix_job *j, report *r) { return (void)j, (void)r, 1; }
int32_t mix_sources_find(lmb_light out[MIX_WAYS], mix_job *j, report *r) { return (void)out, (void)j, (void)r, 0; }
void mix_sources_tile(lmb_irradiance *inout, const mix_job *j, const lmb_tile *tile, int32_t i, int photo)
{
    (void)inout, (void)j, (void)tile, (void)i, (void)photo;
}
int mix_white_env(lmb_env *out, int32_t side, void *memory, size_t bytes)
{
    return (void)out, (void)side, (void)memory, (void)bytes, 0;
}
void mix_sources_points(lmb_texel *inout, const lmb_texel *white, size_t count, double arrives[3], const mix_job *j)
{
    (void)inout, (void)white, (void)count, (void)arrives, (void)j;
}
int mix_lobes_bounces(mix_job *j, report *r) { return (void)r, j->bounces = &j->scene, 1; }
void mix_lobes_lights(mix_lobes *out, lmb_irradiance *inout, const mix_job *j, const lmb_view *view,
                      const lmb_tile *object, int32_t sample, int32_t samples)
{
    (void)sample, (void)samples;
    (void)out;
    for (int32_t i = 0; i < j->light_count; ++i) {
        lmb_direct_tile(inout, j->o.kernels, object, view, &j->scene, &j->lights[i], &j->maps[i][1]);
    }
}
void mix_lobes_finish(lmb_radiance *inout, mix_lobes *s, const mix_job *j, const lmb_view *view, const lmb_tile *object)
{
    (void)inout, (void)s, (void)j, (void)view, (void)object;
}
void mix_touch(mix_job *j, float gap_m) { (void)j, (void)gap_m; }
int mix_plane_near(int32_t at[2], const mix_job *j) { return (void)at, (void)j, 0; }
int mix_place_again(mix_job *j, report *r) { return (void)j, (void)r, 0; }
int mix_is_inside(mix_job *j) { return (void)j, 1; }
void mix_run_rows(const mix_job *j, int threads, int count, pool_job row, void *user)
{
    (void)j;
    pool_run(threads, count, row, user);
}
int mix_fail_depth(const mix_job *j, report *r) { return (void)j, report_fail(r, "no plane in the depth"); }
int mix_fail_at(const mix_job *j, report *r) { return (void)j, report_fail(r, "--at: nothing there"); }

/* --- io_pam.h: the page reads no PAM ------------------------------------------------------------------------------------ */

int pam_decode(bitmap *out, const uint8_t *data, size_t size, const char *name, report *r)
{
    return (void)out, (void)data, (void)size, report_fail(r, "%s: the page reads no PAM", name);
}
int pam_decode_16(bitmap *out, const uint8_t *data, size_t size, const char *name, report *r)
{
    return pam_decode(out, data, size, name, r);
}
int32_t pam_channels(const uint8_t *data, size_t size) { return (void)data, (void)size, 0; }

/* --- io_jpeg.h: no notes of photos -------------------------------------------------------------------------------- */

const char *jpeg_exif_note(const uint8_t *body, size_t size) { return (void)body, (void)size, NULL; }

/* --- budget.h: a slider chooses settings -------------------------------------------------------------------------- */

int budget_fit(budget_choice *out, render_job *j, report *r)
{
    return (void)out, (void)j, report_fail(r, "--budget: not on the page");
}

/* --- slice.h, render_slice.h: the page draws whole pictures --------------------------------------------------------------- */

int slice_option(const char *text, void *at) { return (void)text, (void)at, 0; }
int32_t slice_items(slice s, int32_t total) { return (void)s, total; }
int32_t slice_item(slice s, int32_t k) { return (void)s, k; }
uint64_t slice_hash(uint64_t hash, const void *data, size_t size) { return (void)data, (void)size, hash; }
int slice_hash_file(uint64_t *hash, const char *path, report *r) { return (void)hash, (void)path, (void)r, 0; }
int slice_job(uint64_t *out, const void *options, const option_table *t, int argc, char **argv, report *r)
{
    return (void)out, (void)options, (void)t, (void)argc, (void)argv, (void)r, 0;
}
int slice_name(char out[SLICE_NAME], const char *path, slice s, report *r)
{
    return (void)out, (void)path, (void)s, (void)r, 0;
}
int render_slice_write(const render_job *j, const render_finish *f, report *r) { return (void)j, (void)f, (void)r, 0; }
