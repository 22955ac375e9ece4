/* relight_samples.c: reduces an object's vertices by clusters of grid cell and facing. */
#include "relight_samples.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define REACH 1.6f /* of a cell's side: the radius of a sample */
#define FINEST 96.0f

enum { NEIGHBOURS = 12, SHARES = HIDDEN_SHARES };

/* --- shared by the files of contact ------------------------------------------------------------------------------- */

float hidden_dot(lmb_vec3 a, lmb_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

uint32_t hidden_vertex(const lmb_mesh *m, uint32_t corner)
{
    return m->index_format == LMB_INDEX_NONE  ? corner
           : m->index_format == LMB_INDEX_U16 ? ((const uint16_t *)m->indices)[corner]
                                              : ((const uint32_t *)m->indices)[corner];
}

uint32_t hidden_sampled(const hidden_part *p, uint32_t sample)
{
    return p->vertex_of != NULL ? p->vertex_of[sample] : sample;
}

float hidden_shared(uint32_t *sample, const hidden_part *p, uint32_t vertex, int i)
{
    *sample = p->share != NULL ? p->share[vertex].sample[i] : vertex;
    return p->share != NULL ? p->share[vertex].weight[i] : (float)(i == 0);
}

/* --- clusters ----------------------------------------------------------------------------------------------------- */

/* The vertices of one cell with one facing. */
typedef struct cluster {
    uint64_t key;
    lmb_vec3 sum;
    uint32_t count, vertex; /* the vertex nearest to the mean */
    float distance2;
    uint32_t next[NEIGHBOURS], beside; /* clusters joined to this one by a triangle */
} cluster;

typedef struct thinning {
    hidden *h;
    hidden_part *p;
    uint32_t part;
    lmb_vec3 low;
    float per_cell;
    cluster *list;
    uint32_t count, cap;
    uint32_t *slot, mask; /* a hash table: cluster + 1 */
    uint32_t *of;         /* by vertex */
} thinning;

static uint64_t key_of(const thinning *t, uint32_t vertex)
{
    const lmb_vec3 at = t->p->at[vertex], n = t->p->normal[vertex];
    const float x = fabsf(n.x), y = fabsf(n.y), z = fabsf(n.z);
    const int axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    const float along = axis == 0 ? n.x : axis == 1 ? n.y : n.z;
    const uint64_t side = (uint64_t)(2 * axis + (along < 0.0f));
    const uint64_t cx = (uint64_t)fminf(fmaxf((at.x - t->low.x) * t->per_cell, 0.0f), 65535.0f),
                   cy = (uint64_t)fminf(fmaxf((at.y - t->low.y) * t->per_cell, 0.0f), 65535.0f),
                   cz = (uint64_t)fminf(fmaxf((at.z - t->low.z) * t->per_cell, 0.0f), 65535.0f);
    return (cx << 40 | cy << 24 | cz << 8 | side) + 1;
}

static uint32_t hash_of(uint64_t key) { return (uint32_t)(key * 0x9e3779b97f4a7c15u >> 32); }

/* Finds the cluster of a key, or adds it. Returns UINT32_MAX if there is no room. */
static uint32_t find(thinning *t, uint64_t key)
{
    uint32_t i = hash_of(key) & t->mask;
    while (t->slot[i] != 0 && t->list[t->slot[i] - 1].key != key) {
        i = (i + 1) & t->mask;
    }
    if (t->slot[i] == 0) {
        if (t->count == t->cap) {
            return UINT32_MAX;
        }
        memset(&t->list[t->count], 0, sizeof *t->list);
        t->list[t->count].key = key;
        t->slot[i] = ++t->count;
    }
    return t->slot[i] - 1;
}

/* Returns 0 if the clusters do not fit. */
static int gather(thinning *t)
{
    t->count = 0;
    memset(t->slot, 0, ((size_t)t->mask + 1) * sizeof *t->slot);
    for (uint32_t i = 0; i < t->p->mesh.vertex_count; ++i) {
        const uint32_t k = t->of[i] = find(t, key_of(t, i));
        if (k == UINT32_MAX) {
            return 0;
        }
        cluster *c = &t->list[k];
        c->sum = (lmb_vec3){c->sum.x + t->p->at[i].x, c->sum.y + t->p->at[i].y, c->sum.z + t->p->at[i].z};
        ++c->count;
    }
    return 1;
}

static float distance2(lmb_vec3 a, lmb_vec3 b)
{
    const lmb_vec3 d = {a.x - b.x, a.y - b.y, a.z - b.z};
    return hidden_dot(d, d);
}

static void choose_vertices(thinning *t)
{
    for (uint32_t i = 0; i < t->p->mesh.vertex_count; ++i) {
        cluster *c = &t->list[t->of[i]];
        const float per = 1.0f / (float)c->count;
        const float d = distance2((lmb_vec3){c->sum.x * per, c->sum.y * per, c->sum.z * per}, t->p->at[i]);
        if (c->distance2 == 0.0f || d + 1e-30f < c->distance2) {
            c->distance2 = d + 1e-30f;
            c->vertex = i;
        }
    }
}

static void join(thinning *t, uint32_t a, uint32_t b)
{
    cluster *c = &t->list[a];
    for (uint32_t i = 0; i < c->beside; ++i) {
        if (c->next[i] == b) {
            return;
        }
    }
    if (a != b && c->beside < NEIGHBOURS) {
        c->next[c->beside++] = b;
    }
}

static void corners_of(uint32_t out[3], const thinning *t, uint32_t triangle)
{
    for (uint32_t k = 0; k < 3; ++k) {
        out[k] = t->of[hidden_vertex(&t->p->mesh, 3 * triangle + k)];
    }
}

static void join_all(thinning *t)
{
    for (uint32_t i = 0; i < t->p->mesh.triangle_count; ++i) {
        uint32_t c[3];
        corners_of(c, t, i);
        for (int k = 0; k < 3; ++k) {
            join(t, c[k], c[(k + 1) % 3]);
            join(t, c[(k + 1) % 3], c[k]);
        }
    }
}

/* The weight of a sample at a vertex: larger if near and with a similar normal. */
static float weight_of(const thinning *t, uint32_t vertex, uint32_t k)
{
    const hidden_part *p = t->p;
    const uint32_t other = t->list[k].vertex;
    const float reach = REACH / t->per_cell, near = 1.0f - distance2(p->at[vertex], p->at[other]) / (reach * reach),
                alike = hidden_dot(p->normal[vertex], p->normal[other]);
    return near > 0.0f && alike > 0.0f ? near * near * alike * alike : 0.0f;
}

/* Keeps the largest weights, after the first entry. */
static void add_share(hidden_share *s, uint32_t sample, float weight)
{
    int lightest = 1;
    for (int i = 2; i < SHARES; ++i) {
        lightest = s->weight[i] < s->weight[lightest] ? i : lightest;
    }
    if (weight > s->weight[lightest]) {
        s->weight[lightest] = weight;
        s->sample[lightest] = sample;
    }
}

static void share_out(thinning *t)
{
    for (uint32_t i = 0; i < t->p->mesh.vertex_count; ++i) {
        hidden_share *s = &t->p->share[i];
        const cluster *own = &t->list[t->of[i]];
        float sum = 0.0f;
        memset(s, 0, sizeof *s);
        s->sample[0] = t->of[i];
        s->weight[0] = weight_of(t, i, t->of[i]); /* the vertex's cluster stays first: regions use it */
        for (uint32_t k = 0; k < own->beside; ++k) {
            add_share(s, own->next[k], weight_of(t, i, own->next[k]));
        }
        for (int k = 0; k < SHARES; ++k) {
            sum += s->weight[k];
        }
        for (int k = 0; k < SHARES && sum > 0.0f; ++k) {
            s->weight[k] /= sum;
        }
        if (!(sum > 0.0f)) {
            s->sample[0] = t->of[i];
            s->weight[0] = 1.0f;
        }
    }
}

/* Adds triangles with corners in three clusters to the proxy, each once. */
static int add_triangles(thinning *t, uint32_t first)
{
    hidden_proxy *x = &t->h->proxy;
    const uint32_t n = t->p->mesh.triangle_count;
    uint32_t size = 1024;
    while (size < 2 * n && size < 1u << 30) {
        size *= 2;
    }
    uint32_t *seen = calloc(size, sizeof *seen);
    if (seen == NULL) {
        return 0;
    }
    for (uint32_t i = 0; i < n; ++i) {
        uint32_t c[3], at;
        corners_of(c, t, i);
        const uint32_t turn = c[0] < c[1] ? (c[0] < c[2] ? 0u : 2u) : c[1] < c[2] ? 1u : 2u;
        const uint32_t key[3] = {c[turn], c[(turn + 1) % 3], c[(turn + 2) % 3]};
        if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) {
            continue;
        }
        at = hash_of(((uint64_t)key[0] << 42) ^ ((uint64_t)key[1] << 21) ^ key[2]) & (size - 1);
        while (seen[at] != 0 && memcmp(x->key[seen[at] - 1], key, sizeof key) != 0) {
            at = (at + 1) & (size - 1);
        }
        if (seen[at] == 0) {
            memcpy(x->key[x->count], key, sizeof key);
            for (int k = 0; k < 3; ++k) {
                const uint32_t v = t->list[key[k]].vertex;
                const lmb_vec3 p = t->p->at[v], nv = t->p->normal[v];
                float *to = x->corners + 9 * (size_t)x->count + 3 * k;
                to[0] = p.x - t->h->lift * nv.x;
                to[1] = p.y - t->h->lift * nv.y;
                to[2] = p.z - t->h->lift * nv.z;
            }
            x->source[x->count] = first + i;
            seen[at] = ++x->count;
        }
    }
    free(seen);
    return 1;
}

static int take_samples(thinning *t)
{
    hidden_part *p = t->p;
    p->samples = t->count;
    p->vertex_of = malloc(((size_t)t->count + 1) * sizeof *p->vertex_of);
    p->share = malloc(((size_t)p->mesh.vertex_count + 1) * sizeof *p->share);
    if (p->vertex_of == NULL || p->share == NULL) {
        return 0;
    }
    for (uint32_t i = 0; i < t->count; ++i) {
        p->vertex_of[i] = t->list[i].vertex;
    }
    share_out(t);
    return 1;
}

/* Finds the part's clusters, at most `cap`: cells grow until the clusters fit. */
static int thin_part(thinning *t, uint32_t cap, uint32_t first)
{
    const float side = 2.0f * t->h->radius;
    uint32_t size = 1024;
    while (size < 4 * cap) {
        size *= 2;
    }
    t->mask = size - 1;
    t->cap = cap;
    t->slot = malloc((size_t)size * sizeof *t->slot);
    t->list = malloc(((size_t)cap + 1) * sizeof *t->list);
    t->of = malloc(((size_t)t->p->mesh.vertex_count + 1) * sizeof *t->of);
    int ok = t->slot != NULL && t->list != NULL && t->of != NULL;
    for (float cells = FINEST; ok; cells *= 0.85f) {
        t->per_cell = cells > 0.5f ? cells / fmaxf(side, 1e-20f) : 0.0f; /* finally all is one cell */
        if (gather(t)) {
            break;
        }
    }
    if (ok) {
        choose_vertices(t);
        join_all(t);
        t->per_cell = fmaxf(t->per_cell, 0.5f / fmaxf(side, 1e-20f));
        ok = take_samples(t) && add_triangles(t, first);
    }
    free(t->slot);
    free(t->list);
    free(t->of);
    return ok;
}

static int take_proxy(hidden_proxy *x, uint32_t triangles)
{
    x->key = malloc(((size_t)triangles + 1) * sizeof *x->key);
    x->corners = malloc(((size_t)triangles + 1) * 9 * sizeof *x->corners);
    x->source = malloc(((size_t)triangles + 1) * sizeof *x->source);
    return x->key != NULL && x->corners != NULL && x->source != NULL;
}

static int thin(hidden *h, uint64_t vertices)
{
    uint32_t triangles = 0, first = 0;
    for (uint32_t i = 0; i < h->parts; ++i) {
        triangles += h->part[i].mesh.triangle_count;
    }
    int ok = take_proxy(&h->proxy, triangles);
    for (uint32_t i = 0; ok && i < h->parts; ++i) {
        thinning t;
        memset(&t, 0, sizeof t);
        t.h = h;
        t.p = &h->part[i];
        t.part = i;
        t.low = (lmb_vec3){h->middle.x - h->radius, h->middle.y - h->radius, h->middle.z - h->radius};
        const uint64_t fair = (uint64_t)SAMPLES_MAX * t.p->mesh.vertex_count / vertices;
        ok = thin_part(&t, fair > 6 ? (uint32_t)fair : 6, first);
        first += t.p->mesh.triangle_count;
    }
    return ok;
}

int samples_take(hidden *h)
{
    uint64_t vertices = 0;
    for (uint32_t i = 0; i < h->parts; ++i) {
        h->part[i].samples = h->part[i].mesh.vertex_count;
        vertices += h->part[i].mesh.vertex_count;
    }
    return vertices <= SAMPLES_MAX || thin(h, vertices);
}
