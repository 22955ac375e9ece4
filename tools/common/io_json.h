/* io_json.h: a strict JSON (RFC 8259) reader. Nodes point into the text, which is not copied. They form one array in
 * document order, with a size found by counting commas and brackets: at most 32 bytes of memory per byte of text. At
 * most 64 levels of containers, and 1000 members per object, because a lookup is linear; a member "extras" and all
 * values in it may have more, because nobody searches them. No recursion. Text is passed through as UTF-8. */
#ifndef IO_JSON_H
#define IO_JSON_H

#include <stddef.h>
#include <stdint.h>

#include "report.h"

enum { JSON_NULL, JSON_FALSE, JSON_TRUE, JSON_NUMBER, JSON_STRING, JSON_ARRAY, JSON_OBJECT };
#define JSON_NONE        UINT32_MAX /* no such node; every call below treats it as an absent value */
#define JSON_MAX_DEPTH   64
#define JSON_MAX_MEMBERS 1000

typedef struct json_node {
    uint32_t start, size;         /* bytes of the value in the text; of a string: between the quotes */
    uint32_t key_start, key_size; /* of a member of an object: between the quotes, escapes as written */
    uint32_t parent;              /* JSON_NONE for the root */
    uint32_t next;                /* the following sibling, or JSON_NONE */
    uint32_t count;               /* children of an array or object; the first one is the next node of the array */
    uint32_t kind;
} json_node;

/* The root is nodes[0] and always an object. json_free releases the nodes; you keep the text. */
typedef struct json {
    const char *text;
    const char *name; /* the file, for messages */
    json_node *nodes;
    uint32_t size, count;
} json;

/* json_parse: returns 1, or 0 with line, byte and JSON path in `r`, and nothing allocated. Text and name must
 * outlive `out`. A byte order mark is skipped. Of duplicate keys the first is found. */
int json_parse(json *out, const char *text, size_t size, const char *name, report *r);
void json_free(json *doc);

/* Navigation. All return JSON_NONE if there is no such node. */
uint32_t json_kind(const json *doc, uint32_t node);  /* JSON_NONE for no node */
uint32_t json_count(const json *doc, uint32_t node); /* children; 0 for anything but a container */
uint32_t json_first(const json *doc, uint32_t node);
uint32_t json_next(const json *doc, uint32_t node);
uint32_t json_member(const json *doc, uint32_t object, const char *key);

/* json_fail: set `r` to "FILE: JSON PATH: message". Returns 0. */
int json_fail(const json *doc, uint32_t node, report *r, const char *format, ...) REPORT_PRINTF(4, 5);

/* json_path: writes the path of a node, like meshes[0].primitives[1].attributes.POSITION; drops the start if too
 * long. */
void json_path(char *out, size_t cap, const json *doc, uint32_t node);

/* Read a value. All return 1, or 0 with `r` set if the value has another kind or is out of range. If the node is
 * absent, they leave the output unchanged and return 1. */
int json_read_double(double *out, const json *doc, uint32_t node, report *r);
int json_read_doubles(double *out, uint32_t count, const json *doc, uint32_t node, report *r); /* exactly count */
int json_read_uint(uint32_t *out, const json *doc, uint32_t node, report *r);                  /* 0 .. 4294967294 */
int json_read_bool(int *out, const json *doc, uint32_t node, report *r);

/* json_string: decodes the escapes of a string into out, truncated to whole characters and at most cap - 1 bytes,
 * 0-terminated. Returns the full length; 0 with out "" if the node is no string. */
size_t json_string(char *out, size_t cap, const json *doc, uint32_t node);

/* json_equals: whether this node is the string `text`, which must not need escapes. */
int json_equals(const json *doc, uint32_t node, const char *text);

#endif
