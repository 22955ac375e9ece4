/* own_light.c: the irradiance in a scene from emissive surfaces, with few elements. */
#include "own_light.h"

#include <stdlib.h>
#include <string.h>

enum { ELEMENTS = 4096 };
#define MAX 0.05f  /* W/m2, of an element: a glowing label may light the surface next to it with any amount */
#define SHARE 0.2f /* largest relative error; the cases to distinguish differ by far more */

typedef struct meter {
    lmb_elements elements;
    lmb_bvh bvh;
    lmb_band_scratch *scratch;
    void *element_memory, *bvh_memory;
} meter;

static int take(meter *m, const lmb_scene *scene, report *r)
{
    const uint32_t triangles = lmb_scene_triangles(scene);
    const size_t bvh_bytes = lmb_bvh_bytes(triangles), element_bytes = lmb_elements_bytes(ELEMENTS);
    memset(m, 0, sizeof *m);
    m->scratch = malloc(sizeof *m->scratch);
    m->bvh_memory = malloc(bvh_bytes);
    m->element_memory = malloc(element_bytes);
    return (m->scratch != NULL && m->bvh_memory != NULL && m->element_memory != NULL &&
            lmb_bvh_init(&m->bvh, triangles, m->bvh_memory, bvh_bytes) == LMB_OK &&
            lmb_elements_init(&m->elements, ELEMENTS, m->element_memory, element_bytes) == LMB_OK) ||
           report_fail(r, "not enough memory to see what emits in the scene; give its lights by --light");
}

static float mean_of(const lmb_elements *e)
{
    double sum = 0.0, area = 0.0;
    for (uint32_t i = 0; i < e->count; ++i) {
        const lmb_element *p = &e->data[i];
        const float received = (p->fresh[0] + p->fresh[1] + p->fresh[2]) / 3.0f;
        sum += (double)p->area * (double)(received < MAX ? received : MAX);
        area += (double)p->area;
    }
    return area > 0.0 ? (float)(sum / area) : 0.0f;
}

static float measure(meter *m, const lmb_scene *scene)
{
    lmb_element_scratch own;
    lmb_cut_params cut_params;
    memset(&cut_params, 0, sizeof cut_params);
    cut_params.error = cut_params.visibility = SHARE;
    cut_params.bvh = &m->bvh;
    own.kernels = lmb_kernels_pick();
    own.cut = &m->scratch->gather.cut;
    own.tile = &m->scratch->tile;
    own.received = &m->scratch->direct;
    own.fresh = &m->scratch->indirect;
    const int ok = lmb_bvh_build(&m->bvh, scene) == LMB_OK &&
                   lmb_elements_build(&m->elements, scene, NULL) == LMB_OK &&
                   lmb_elements_receive(&m->elements, &own, NULL, &cut_params, 0, lmb_elements_tiles(&m->elements)) ==
                       LMB_OK;
    return ok ? mean_of(&m->elements) : 0.0f;
}

float own_light(const lmb_scene *scene, report *r)
{
    meter m;
    const float mean = take(&m, scene, r) ? measure(&m, scene) : -1.0f;
    free(m.scratch);
    free(m.bvh_memory);
    free(m.element_memory);
    return mean;
}
