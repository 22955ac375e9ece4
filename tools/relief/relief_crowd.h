/* relief_crowd.h: many placements of reliefs in one picture. The time grows with their
 * pixels and triangles. [P11] */
#ifndef RELIEF_CROWD_H
#define RELIEF_CROWD_H

#include <lambent/lambent.h>

#include "../common/io_file.h"
#include "../common/report.h"

/* A relief at a place: scaled, then turned about +y, then moved. */
typedef struct relief_placed {
    const lmb_relief *relief;
    lmb_vec3 at;               /* m */
    float cosine, sine, scale; /* of the turn, counter-clockwise seen from above */
} relief_placed;

typedef struct relief_file {
    char *path;
    file_bytes bytes;
    lmb_relief relief;
} relief_file;

/* Zeroed: empty. Release it with relief_crowd_free. Do not move it. */
typedef struct relief_crowd {
    relief_placed *placed;
    uint32_t count;
    relief_file **file; /* each once */
    uint32_t files;
    lmb_scene scene;    /* the simple models, placed */
    lmb_mesh *meshes;
    lmb_instance *instances;
} relief_crowd;

/* relief_file_open: reads a .lmr into `bytes`, which file_free releases in either case, and opens it. Returns 1, or 0
 * with `r` set. */
int relief_file_open(lmb_relief *out, file_bytes *bytes, const char *path, report *r);

/* relief_crowd_read: reads a list of placements, one per line: FILE.lmr X Y Z [TURN [SCALE]], where TURN is in degrees
 * about +y, and `#` begins a comment. Names are relative to the list's folder. Returns 1, or 0 with `r` set; call
 * relief_crowd_free in either case. */
int relief_crowd_read(relief_crowd *out, const char *path, report *r);
void relief_crowd_free(relief_crowd *c);

/* relief_crowd_scene: fills in `scene` from the placements, with bounds around their boxes. Returns 1, or 0 with `r`
 * set. relief_crowd_read calls it. */
int relief_crowd_scene(relief_crowd *inout, report *r);

/* --- drawing ------------------------------------------------------------------------------------------------------ */

enum { CROWD_ROWS = 8 /* tile rows of a band */ };

/* A placement in a view. */
typedef struct relief_seen {
    const relief_placed *placed;
    lmb_view view;                /* the view in the relief's space */
    int32_t left, top, right, bottom; /* tiles that may show it; right and bottom past the last */
    float near_m;                 /* of the box, along the view's axis */
} relief_seen;

/* The nearest surfaces of 8 x 8 pixels, in world space. */
typedef struct crowd_tile {
    float position[3][LMB_TILE_PIXELS], face[3][LMB_TILE_PIXELS], normal[3][LMB_TILE_PIXELS];
    float albedo[3][LMB_TILE_PIXELS];
    float depth[LMB_TILE_PIXELS]; /* m along the view's axis; 0: nothing */
} crowd_tile;

/* A band of CROWD_ROWS tile rows that one thread draws. Zeroed: no memory. */
typedef struct crowd_band {
    crowd_tile *tiles;
    void *depth, *id;
    size_t surface_bytes;
    int32_t columns; /* tiles per row */
    lmb_tile tile;   /* scratch */
} crowd_band;

/* crowd_band_take: memory for pictures of this width, px. Returns the number of bytes, or 0 if memory is short.
 * Release it with crowd_band_free in either case. */
size_t crowd_band_take(crowd_band *out, int32_t width);
void crowd_band_free(crowd_band *b);

/* relief_crowd_see: lists the placements that the view may show, the nearest first. `out` has room for all. Returns
 * the number. */
uint32_t relief_crowd_see(relief_seen *out, const relief_crowd *crowd, const lmb_view *view);

/* crowd_band_draw: draws tile rows first .. past - 1 of the view, at most CROWD_ROWS. `stats` may be NULL. A tile of a
 * placement is left out if nearer placements hide it. */
lmb_status crowd_band_draw(crowd_band *b, const relief_seen *seen, uint32_t count, const lmb_view *view,
                           const lmb_kernels *kernels, const lmb_relief_how *how, int32_t first, int32_t past,
                           lmb_relief_stats *stats);

/* crowd_band_tile: a tile of the band as lmb_relief_tile would leave it. `row` counts from the band's first. Ids are
 * LMB_MAX_TRIANGLES. */
void crowd_band_tile(lmb_tile *out, const crowd_band *b, int32_t column, int32_t row, int32_t x, int32_t y);

#endif
