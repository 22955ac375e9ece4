/* gl_list.c: runs or records operations; display lists. */
#include "gl_context.h"

#define LIST_ROW(name) gl_op_##name,
static void (*const list_ops[OPS])(gl_context *, const gl_word *) = {GL_OPERATIONS(LIST_ROW)};

enum { LIST_FIRST_WORDS = 128, LIST_NEXT_WORDS = 16384 };
enum { LIST_MOST_WORDS = 0x3fff };
enum { LIST_POINTER = 1 << 30 /* flag of an operation: the last words are a pointer to data owned by the list */ };

static void list_run(gl_context *c, int op, const gl_word *w)
{
    if (op >= OP_FIRST_STATE) {
        if (c->is_inside) {
            gl_error(c, GL_INVALID_OPERATION);
            return;
        }
        gl_flush_vertices(c);
        c->dirty = 1;
    }
    list_ops[op](c, w);
}

/* Returns room for words in the list being compiled; NULL: out of memory. */
static gl_word *list_room(gl_context *c, int32_t words)
{
    gl_chunk *k = c->list_chunk;
    if (k == NULL || k->used + words > k->cap) {
        const int32_t cap = k == NULL ? LIST_FIRST_WORDS : LIST_NEXT_WORDS;
        gl_chunk *more = gl_alloc(c, sizeof *more + (size_t)cap * sizeof more->word[0]);
        if (more == NULL) {
            return NULL;
        }
        more->cap = cap;
        more->next = NULL;
        more->used = 0;
        if (k == NULL) {
            c->list->first = more;
        } else {
            k->next = more;
        }
        c->list_chunk = k = more;
    }
    k->used += words;
    return &k->word[k->used - words];
}

/* The words of the operation at `head`. */
static int32_t list_words(const gl_word *head) { return (int32_t)(head->u >> 16 & LIST_MOST_WORDS); }

/* Returns the operation, or NULL if memory is used up. */
static gl_word *list_record(gl_context *c, int op, const gl_word *w, int32_t words, uint32_t flags)
{
    gl_word *to = list_room(c, words + 1);
    c->list_run = NULL;
    if (to != NULL) {
        to[0].u = (uint32_t)op | (uint32_t)words << 16 | flags;
        if (words == 3) { /* most often */
            memcpy(to + 1, w, 3 * sizeof *w);
        } else if (words > 0) {
            memcpy(to + 1, w, (size_t)words * sizeof *w);
        }
    }
    return to;
}

/* Vertices in a row are one operation; if all of them have the w 1, it holds no w. */
void gl_list_vertex(gl_context *c, const float at[4])
{
    const int op = at[3] == 1.0f ? OP_vertex_3 : OP_vertex;
    const int32_t words = op == OP_vertex ? 4 : 3;
    gl_chunk *k = c->list_chunk;
    gl_word *run = c->list_run;
    if (run != NULL && (run->u & 0xffffu) == (uint32_t)op && k->used + 4 <= k->cap &&
        list_words(run) + words <= LIST_MOST_WORDS) {
        memcpy(&k->word[k->used], at, 4 * sizeof *at); /* the fourth is scratch if w is left out: the next operation overwrites it */
        k->used += words;
        run->u += (uint32_t)words << 16;
    } else {
        gl_word w[4];
        memcpy(w, at, sizeof w);
        c->list_run = list_record(c, op, w, words, 0);
    }
    if (c->list_mode != GL_COMPILE) {
        gl_vertex_at(c, at);
    }
}

void gl_do(gl_context *c, int op, const gl_word *w, int32_t words)
{
    if (c->list_mode != 0) {
        list_record(c, op, w, words, 0);
    }
    if (c->list_mode != GL_COMPILE) {
        list_run(c, op, w);
    }
}

void gl_op_fail(gl_context *c, const gl_word *w) { gl_error(c, w[0].u); }

void gl_fail(gl_context *c, GLenum error)
{
    const gl_word w = {.u = error};
    gl_do(c, OP_fail, &w, 1);
}

const void *gl_data_of(const gl_word *w)
{
    uint64_t at;
    memcpy(&at, w, sizeof at);
    return (const void *)(uintptr_t)at;
}

static void list_set_data(gl_word *w, const void *data)
{
    const uint64_t at = (uintptr_t)data;
    memcpy(w, &at, sizeof at);
}

void gl_do_data(gl_context *c, int op, gl_word *w, int32_t words, const void *data, size_t bytes)
{
    if (c->list_mode != 0) {
        void *copy = data != NULL ? gl_alloc(c, bytes) : NULL;
        if (data != NULL && copy == NULL) {
            return;
        }
        if (copy != NULL) {
            memcpy(copy, data, bytes);
        }
        list_set_data(&w[words - 2], copy);
        list_record(c, op, w, words, LIST_POINTER);
    }
    if (c->list_mode != GL_COMPILE) {
        list_set_data(&w[words - 2], data);
        list_run(c, op, w);
    }
}

static void list_clear(gl_context *c, gl_list *list)
{
    gl_chunk *k = list->first;
    list->first = NULL;
    while (k != NULL) {
        gl_chunk *next = k->next;
        for (int32_t i = 0; i < k->used; i += 1 + list_words(&k->word[i])) {
            if ((k->word[i].u & LIST_POINTER) != 0) {
                gl_free(c, (void *)(uintptr_t)gl_data_of(&k->word[i + list_words(&k->word[i]) - 1]));
            }
        }
        gl_free(c, k);
        k = next;
    }
}

void gl_list_free(gl_context *c, gl_list *list)
{
    list_clear(c, list);
    gl_free(c, list);
}

void gl_run_list(gl_context *c, GLuint name)
{
    const gl_list *list = gl_find(&c->group->lists, name);
    if (list == NULL || c->list_depth >= GL_LIST_DEPTH) {
        return;
    }
    ++c->list_depth;
    for (const gl_chunk *k = list->first; k != NULL; k = k->next) {
        for (int32_t i = 0; i < k->used;) {
            const int op = (int)(k->word[i].u & 0xffffu);
            const int32_t words = list_words(&k->word[i]);
            if (op == OP_vertex || op == OP_vertex_3) {
                const int32_t each = op == OP_vertex ? 4 : 3;
                gl_vertices_at(c, &k->word[i + 1], words / each, each);
            } else {
                list_run(c, op, &k->word[i + 1]);
            }
            i += 1 + words;
        }
    }
    --c->list_depth;
}

void gl_op_call_list(gl_context *c, const gl_word *w) { gl_run_list(c, w[0].u); }
void gl_op_call_lists(gl_context *c, const gl_word *w) { gl_run_list(c, c->s.list.base + w[0].u); }
void gl_op_list_base(gl_context *c, const gl_word *w) { c->s.list.base = w[0].u; }

void glNewList(GLuint name, GLenum mode)
{
    GL_ENTER()
    GL_FAIL(name == 0, GL_INVALID_VALUE, )
    GL_FAIL(mode != GL_COMPILE && mode != GL_COMPILE_AND_EXECUTE, GL_INVALID_ENUM, )
    GL_FAIL(c->list_mode != 0, GL_INVALID_OPERATION, )
    gl_list *old = gl_find(&c->group->lists, name);
    gl_list *list = gl_alloc(c, sizeof *list);
    if (list != NULL) {
        /* This context cannot call it until glEndList, and the new list takes its memory. A context that is made in
         * between, and shares lists, finds it empty. */
        if (old != NULL && mode == GL_COMPILE && c->group->users == 1) {
            list_clear(c, old);
        }
        list->name = name;
        list->first = NULL;
        c->list = list;
        c->list_chunk = NULL;
        c->list_run = NULL;
        c->list_name = name;
        c->list_mode = mode;
    }
}

void glEndList(void)
{
    GL_ENTER()
    GL_FAIL(c->list_mode == 0, GL_INVALID_OPERATION, )
    gl_list *old = gl_find(&c->group->lists, c->list_name);
    c->list_mode = 0;
    if (old != NULL) {
        gl_list_free(c, old);
    }
    gl_put(c, &c->group->lists, c->list_name, c->list);
}

GLuint glGenLists(GLsizei n)
{
    GL_ENTER(0)
    GL_FAIL(n < 0, GL_INVALID_VALUE, 0)
    return gl_new_names(c, &c->group->lists, n);
}

void glDeleteLists(GLuint first, GLsizei n)
{
    GL_ENTER()
    GL_FAIL(n < 0, GL_INVALID_VALUE, )
    for (GLsizei i = 0; i < n; ++i) {
        gl_list *list = gl_find(&c->group->lists, first + (GLuint)i);
        if (list != NULL) {
            gl_list_free(c, list);
        }
        gl_remove(&c->group->lists, first + (GLuint)i);
    }
}

GLboolean glIsList(GLuint name)
{
    GL_ENTER(0)
    return (GLboolean)gl_has(&c->group->lists, name);
}
