/* vertex_light.h: a scene -> the blob of lambent/fixed.h: light by vertex, for processors with only integers. */
#ifndef VERTEX_LIGHT_H
#define VERTEX_LIGHT_H

#include <lambent/lambent.h>
#include <lambent/fixed.h>

#include "../common/dvec.h"
#include "../common/report.h"

typedef struct vertex_light_options {
    uint32_t vertices; /* approximate number; 0: 600 */
    uint32_t elements; /* surface pieces that reflect light; 0: 192 */
    uint32_t links;    /* maximum per vertex, half as many per element; 0: 32 */
    uint32_t places;   /* of the lamp, approximate number; 0: 512 */
} vertex_light_options;

typedef struct vertex_light_facts {
    uint32_t vertices, triangles, elements, links, places, valid, hidden, hull;
    double unit_m, spacing_m;
} vertex_light_facts;

/* vertex_light_make: makes words in this machine's byte order; you free them. Returns 1, or 0 with `r` set. */
int vertex_light_make(uint32_t **words, uint32_t *count, vertex_light_facts *facts, const lmb_scene *scene,
                      const vertex_light_options *options, report *r);

/* --- internal ----------------------------------------------------------------------------------------------------- */

enum { VL_NONE = -1 };

typedef struct vl_triangle {
    uint32_t p[3];     /* places */
    dvec n[3];         /* unit */
    double uv[3][2], colour[3][3];
    dvec face;         /* unit */
    const lmb_material *material;
    int is_two_sided;
} vl_triangle;

typedef struct vl_mesh {
    const lmb_scene *scene;
    dvec *place;
    uint32_t places, place_cap;
    vl_triangle *triangle;
    uint32_t triangles, triangle_cap;
} vl_mesh;

/* Occluders: the mesh before it is divided. */
typedef struct vl_sight {
    lmb_scene scene;
    lmb_mesh mesh;
    lmb_material material;
    lmb_instance instance;
    float *positions;
    uint32_t *indices;
    int *two_sided;
    lmb_bvh bvh;
    void *bvh_memory;
    lmb_tile *tile;
    lmb_traversal traversal;
    const lmb_kernels *kernels;
} vl_sight;

typedef struct vl_lattice {
    int32_t count[3];
    double first[3], spacing;
    uint32_t all;
    unsigned char *valid;
} vl_lattice;

int vl_mesh_build(vl_mesh *m, const lmb_scene *scene, uint32_t vertices, report *r);
int vl_mesh_divide(vl_mesh *m, vl_sight *s, const vl_lattice *l, uint32_t vertices, report *r);
void vl_mesh_free(vl_mesh *m);
int vl_triangle_face(vl_triangle *t, const vl_mesh *m);

int vl_sight_begin(vl_sight *s, const vl_mesh *m, report *r);
void vl_sight_end(vl_sight *s);
int vl_sees(vl_sight *s, dvec from, dvec to);
/* The share of directions in which the first hit is a back face; a large share means inside a solid. If `up` is not 0,
 * only directions on that side count. */
double vl_buried(const vl_sight *s, dvec at, dvec up);

int vl_lattice_make(vl_lattice *l, const vl_mesh *m, const vl_sight *s, uint32_t places, report *r);
dvec vl_lattice_place(const vl_lattice *l, uint32_t i);

/* Linear albedo at a point of a triangle, from the weights of the corners. */
void vl_albedo(double out[3], const vl_mesh *m, const vl_triangle *t, const double weight[3]);

#endif
