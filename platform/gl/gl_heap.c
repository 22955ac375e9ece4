/* gl_heap.c: memory of textures, lists and buffers inside the context's block, and tables of names. */
#include "gl_context.h"

/* A block: size, used or free, and the block before it. Free blocks form a list. */
typedef struct gl_block {
    size_t bytes, before; /* with this head; of the block before it, 0: first block */
    struct gl_block *next, **link; /* link: the pointer to this block; NULL: used */
} gl_block;
/* Under AddressSanitizer only the bytes that were asked for may be used. */
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define HEAP_GUARDS 1
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define HEAP_GUARDS 1
#endif
#ifdef HEAP_GUARDS
void __asan_poison_memory_region(const volatile void *p, size_t bytes);
void __asan_unpoison_memory_region(const volatile void *p, size_t bytes);
#define HEAP_CLOSE(p, bytes) __asan_poison_memory_region(p, bytes)
#define HEAP_OPEN(p, bytes)  __asan_unpoison_memory_region(p, bytes)
#else
#define HEAP_CLOSE(p, bytes) ((void)(p), (void)(bytes))
#define HEAP_OPEN(p, bytes)  ((void)(p), (void)(bytes))
#endif
enum { HEAP_ALIGN = 32, HEAP_HEAD = (sizeof(gl_block) + 31) / 32 * 32 };

void gl_heap_init(gl_heap *h, void *start, size_t bytes)
{
    const size_t skip = (size_t)(-(uintptr_t)start) % HEAP_ALIGN;
    h->start = (uint8_t *)start + skip;
    h->bytes = bytes - skip;
    h->top = 0;
    h->free = NULL;
}

static gl_block *heap_block(const gl_heap *h, size_t at) { return (gl_block *)(void *)(h->start + at); }

static void heap_unlink(gl_block *b)
{
    *b->link = b->next;
    if (b->next != NULL) {
        b->next->link = b->link;
    }
    b->link = NULL;
}

static void heap_link(gl_heap *h, gl_block *b)
{
    b->next = h->free;
    b->link = &h->free;
    if (b->next != NULL) {
        b->next->link = &b->next;
    }
    h->free = b;
}

static gl_block *heap_after(const gl_heap *h, gl_block *b)
{
    const size_t at = (size_t)((uint8_t *)b - h->start) + b->bytes;
    return at < h->top ? heap_block(h, at) : NULL;
}

/* Splits the unused rest off a block. */
static void heap_split(gl_heap *h, gl_block *b, size_t bytes)
{
    gl_block *after = heap_after(h, b);
    if (b->bytes < bytes + 2 * HEAP_HEAD) {
        return;
    }
    gl_block *rest = (gl_block *)(void *)((uint8_t *)b + bytes);
    HEAP_OPEN(rest, HEAP_HEAD);
    rest->bytes = b->bytes - bytes;
    rest->before = bytes;
    b->bytes = bytes;
    heap_link(h, rest);
    if (after != NULL) {
        after->before = rest->bytes;
    }
}

/* The block's memory, `size` bytes of it open. */
static void *heap_memory(gl_block *b, size_t size)
{
    uint8_t *p = (uint8_t *)b + HEAP_HEAD;
    HEAP_CLOSE(p, b->bytes - HEAP_HEAD);
    HEAP_OPEN(p, size);
    return p;
}

void *gl_alloc(gl_context *c, size_t size)
{
    gl_heap *h = &c->group->heap;
    const size_t bytes = (size + HEAP_ALIGN - 1) / HEAP_ALIGN * HEAP_ALIGN + HEAP_HEAD;
    if (size < h->bytes) {
        for (gl_block *b = h->free; b != NULL; b = b->next) {
            if (b->bytes >= bytes) {
                heap_unlink(b);
                heap_split(h, b, bytes);
                return heap_memory(b, size);
            }
        }
        if (bytes <= h->bytes - h->top) {
            gl_block *b = heap_block(h, h->top);
            HEAP_OPEN(b, HEAP_HEAD);
            b->before = h->top == 0 ? 0 : c->group->heap_last;
            b->bytes = bytes;
            b->link = NULL;
            h->top += bytes;
            c->group->heap_last = bytes;
            return heap_memory(b, size);
        }
    }
    gl_error(c, GL_OUT_OF_MEMORY);
    return NULL;
}

void gl_free(gl_context *c, void *p)
{
    gl_heap *h = &c->group->heap;
    if (p == NULL) {
        return;
    }
    gl_block *b = (gl_block *)(void *)((uint8_t *)p - HEAP_HEAD);
    HEAP_CLOSE(p, b->bytes - HEAP_HEAD);
    gl_block *after = heap_after(h, b);
    if (after != NULL && after->link != NULL) {
        heap_unlink(after);
        b->bytes += after->bytes;
    }
    if (b->before != 0) {
        gl_block *before = (gl_block *)(void *)((uint8_t *)b - b->before);
        if (before->link != NULL) {
            heap_unlink(before);
            before->bytes += b->bytes;
            b = before;
        }
    }
    after = heap_after(h, b);
    if (after == NULL) { /* the last block: the heap now ends before it */
        h->top = (size_t)((uint8_t *)b - h->start);
        c->group->heap_last = b->before;
        return;
    }
    after->before = b->bytes;
    heap_link(h, b);
}

/* --- tables ------------------------------------------------------------------------------------------------------- */

static gl_entry *table_entry(const gl_table *t, GLuint name)
{
    uint32_t at = name * 2654435761u >> 18;
    for (int32_t tries = 0; tries < GL_TABLE; ++tries, at = (at + 1) % GL_TABLE) {
        const gl_entry *e = &t->entry[at];
        if (e->name == name || e->name == 0) {
            return (gl_entry *)(uintptr_t)e;
        }
    }
    return NULL;
}

int gl_has(const gl_table *t, GLuint name)
{
    const gl_entry *e = name != 0 ? table_entry(t, name) : NULL;
    return e != NULL && e->name == name;
}

void *gl_find(const gl_table *t, GLuint name) { return gl_has(t, name) ? table_entry(t, name)->object : NULL; }

int gl_put(gl_context *c, gl_table *t, GLuint name, void *object)
{
    gl_entry *e = table_entry(t, name);
    if (e == NULL || (e->name == 0 && t->used >= GL_TABLE / 4 * 3)) {
        gl_error(c, GL_OUT_OF_MEMORY);
        return 0;
    }
    t->used += e->name == 0;
    t->last = name > t->last ? name : t->last;
    e->name = name;
    e->object = object;
    return 1;
}

void gl_remove(gl_table *t, GLuint name)
{
    gl_entry *e = name != 0 ? table_entry(t, name) : NULL;
    if (e == NULL || e->name != name) {
        return;
    }
    e->name = 0;
    --t->used;
    /* Moves back entries behind it that collided. */
    for (size_t at = (size_t)(e - t->entry + 1) % GL_TABLE; t->entry[at].name != 0; at = (at + 1) % GL_TABLE) {
        const gl_entry moved = t->entry[at];
        t->entry[at].name = 0;
        *table_entry(t, moved.name) = moved;
    }
}

GLuint gl_new_names(gl_context *c, gl_table *t, int32_t count)
{
    GLuint first = t->last + 1;
    if (count <= 0) {
        return 0;
    }
    if (t->last > 0xffffffffu - (GLuint)count) { /* names chosen by the program reach the end: search for a gap */
        first = 1;
        for (GLuint n = 0; n < (GLuint)count && first < 0xf0000000u; ++n) {
            if (gl_has(t, first + n)) {
                first += n + 1;
                n = (GLuint)-1;
            }
        }
    }
    for (int32_t i = 0; i < count; ++i) {
        if (!gl_put(c, t, first + (GLuint)i, NULL)) {
            return 0;
        }
    }
    return first;
}
