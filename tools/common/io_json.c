/* io_json.c: reads strict JSON into a flat array of nodes, without recursion. */
#include "io_json.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct parser {
    json *doc;
    uint32_t at;   /* next byte */
    uint32_t open; /* innermost open container, or JSON_NONE */
    uint32_t last; /* child added to it last, or JSON_NONE */
    uint32_t depth;
    uint32_t key_start, key_size; /* of the current member */
    report *r;
} parser;

static int is_digit(int c) { return c >= '0' && c <= '9'; }

static int hex_digit(int c)
{
    if (is_digit(c))
        return c - '0';
    if (c >= 'a' && c <= 'f')
        return c - 'a' + 10;
    if (c >= 'A' && c <= 'F')
        return c - 'A' + 10;
    return -1;
}

/* Returns the next byte; -1 at the end. */
static int peek(const parser *s) { return s->at < s->doc->size ? (unsigned char)s->doc->text[s->at] : -1; }

static int syntax(const parser *s, const char *what)
{
    uint32_t line = 1, i;
    char path[160];
    for (i = 0; i < s->at; ++i)
        line += s->doc->text[i] == '\n';
    json_path(path, sizeof path, s->doc, s->open);
    return report_fail(s->r, "%s: line %u, byte %u, in %s: %s; the JSON is damaged, export the file again",
                       s->doc->name, (unsigned)line, (unsigned)s->at, path, what);
}

static void skip_space(parser *s)
{
    for (;; ++s->at) {
        int c = peek(s);
        if (c != ' ' && c != '\t' && c != '\n' && c != '\r')
            return;
    }
}

/* The four digits of a \u escape at `at`; -1 if they are not. */
static int32_t hex4(const json *doc, uint32_t at)
{
    int32_t value = 0;
    int i;
    if (doc->size - at < 4)
        return -1;
    for (i = 0; i < 4; ++i) {
        int d = hex_digit((unsigned char)doc->text[at + (uint32_t)i]);
        if (d < 0)
            return -1;
        value = value * 16 + d;
    }
    return value;
}

/* Skips a \u escape from the 'u'. A surrogate must be a high one followed by a low one. */
static int skip_unicode(parser *s)
{
    int32_t unit = hex4(s->doc, s->at + 1), low;
    if (unit < 0)
        return syntax(s, "\\u without four hexadecimal digits");
    s->at += 5;
    if (unit < 0xD800 || unit > 0xDFFF)
        return 1;
    if (unit > 0xDBFF || s->doc->size - s->at < 6 || s->doc->text[s->at] != '\\' || s->doc->text[s->at + 1] != 'u')
        return syntax(s, "half a \\u surrogate pair");
    low = hex4(s->doc, s->at + 2);
    if (low < 0xDC00 || low > 0xDFFF)
        return syntax(s, "half a \\u surrogate pair");
    s->at += 6;
    return 1;
}

static int read_string(parser *s, uint32_t *start, uint32_t *size)
{
    if (peek(s) != '"')
        return syntax(s, "expected a string in double quotes");
    *start = ++s->at;
    for (;;) {
        int c = peek(s);
        if (c < 0)
            return syntax(s, "the text ends inside a string");
        if (c == '"')
            break;
        if (c < 0x20)
            return syntax(s, "control character inside a string");
        ++s->at;
        if (c != '\\')
            continue;
        c = peek(s);
        if (c == 'u') {
            if (!skip_unicode(s))
                return 0;
        } else if (c > 0 && strchr("\"\\/bfnrt", c)) {
            ++s->at;
        } else {
            return syntax(s, "unknown escape in a string");
        }
    }
    *size = s->at++ - *start;
    return 1;
}

static int skip_digits(parser *s)
{
    if (!is_digit(peek(s)))
        return syntax(s, "expected a digit");
    while (is_digit(peek(s)))
        ++s->at;
    return 1;
}

static int skip_number(parser *s)
{
    if (peek(s) == '-')
        ++s->at;
    if (peek(s) == '0') {
        ++s->at;
    } else if (!skip_digits(s)) {
        return 0;
    }
    if (peek(s) == '.') {
        ++s->at;
        if (!skip_digits(s))
            return 0;
    }
    if (peek(s) != 'e' && peek(s) != 'E')
        return 1;
    ++s->at;
    if (peek(s) == '+' || peek(s) == '-')
        ++s->at;
    return skip_digits(s);
}

/* The array was sized by counting the bytes that can start a node, so there is always room. */
static json_node *add_node(parser *s, uint32_t kind)
{
    json *doc = s->doc;
    uint32_t index = doc->count++;
    json_node *node = &doc->nodes[index];
    node->start = s->at;
    node->size = 0;
    node->key_start = s->key_start;
    node->key_size = s->key_size;
    node->parent = s->open;
    node->next = JSON_NONE;
    node->count = 0;
    node->kind = kind;
    if (s->last != JSON_NONE)
        doc->nodes[s->last].next = index;
    if (s->open != JSON_NONE)
        ++doc->nodes[s->open].count;
    s->last = index;
    return node;
}

static int read_key(parser *s)
{
    skip_space(s);
    if (!read_string(s, &s->key_start, &s->key_size))
        return 0;
    skip_space(s);
    if (peek(s) != ':')
        return syntax(s, "expected ':' after a key");
    ++s->at;
    return 1;
}

static int closing(const parser *s) { return s->doc->nodes[s->open].kind == JSON_ARRAY ? ']' : '}'; }

static void close_container(parser *s)
{
    json_node *node = &s->doc->nodes[s->open];
    node->size = ++s->at - node->start;
    s->last = s->open;
    s->open = node->parent;
    --s->depth;
}

/* Opens a container; sets *complete if it is empty and closed. */
static int open_container(parser *s, uint32_t kind, int *complete)
{
    if (s->depth == JSON_MAX_DEPTH)
        return syntax(s, "more than 64 arrays and objects inside each other");
    ++s->depth;
    add_node(s, kind);
    s->open = s->last;
    s->last = JSON_NONE;
    s->key_start = s->key_size = 0;
    ++s->at;
    skip_space(s);
    *complete = peek(s) == closing(s);
    if (*complete) {
        close_container(s);
        return 1;
    }
    return kind == JSON_ARRAY || read_key(s);
}

static int read_literal(parser *s, const char *word, uint32_t kind)
{
    size_t n = strlen(word);
    if (s->doc->size - s->at < n || memcmp(s->doc->text + s->at, word, n) != 0)
        return syntax(s, "expected a value");
    add_node(s, kind)->size = (uint32_t)n;
    s->at += (uint32_t)n;
    return 1;
}

/* Reads one value. For a container that is not empty, reads only the bracket and the first key, and *complete is 0. */
static int read_value(parser *s, int *complete)
{
    json_node *node;
    int c;
    skip_space(s);
    c = peek(s);
    *complete = 1;
    if (c == '[' || c == '{')
        return open_container(s, c == '[' ? JSON_ARRAY : JSON_OBJECT, complete);
    if (c == 't')
        return read_literal(s, "true", JSON_TRUE);
    if (c == 'f')
        return read_literal(s, "false", JSON_FALSE);
    if (c == 'n')
        return read_literal(s, "null", JSON_NULL);
    if (c == '"') {
        node = add_node(s, JSON_STRING);
        return read_string(s, &node->start, &node->size);
    }
    if (c != '-' && !is_digit(c))
        return syntax(s, c < 0 ? "the text ends early" : "expected a value");
    node = add_node(s, JSON_NUMBER);
    if (!skip_number(s))
        return 0;
    node->size = s->at - node->start;
    return 1;
}

/* Returns whether the open container is in a member "extras". */
static int is_in_extras(const parser *s)
{
    static const char extras[] = "extras";
    uint32_t i;
    for (i = s->open; i != JSON_NONE; i = s->doc->nodes[i].parent) {
        const json_node *n = &s->doc->nodes[i];
        if (n->key_size == sizeof extras - 1 && memcmp(s->doc->text + n->key_start, extras, sizeof extras - 1) == 0)
            return 1;
    }
    return 0;
}

/* After a comma: another element, or the key of another member. */
static int read_next(parser *s)
{
    const json_node *open = &s->doc->nodes[s->open];
    if (open->kind == JSON_ARRAY)
        return 1;
    if (open->count == JSON_MAX_MEMBERS && !is_in_extras(s))
        return syntax(s, "more than 1000 members in an object");
    return read_key(s);
}

/* After a complete value: reads a comma, or the end of the container, which completes that as well. */
static int after_value(parser *s)
{
    while (s->open != JSON_NONE) {
        skip_space(s);
        if (peek(s) == ',') {
            ++s->at;
            return read_next(s);
        }
        if (peek(s) != closing(s))
            return syntax(s, closing(s) == ']' ? "expected ',' or ']'" : "expected ',' or '}'");
        close_container(s);
    }
    return 1;
}

/* The root is an object and ends in '}', so a number is never the last byte of the text: strtod stops inside the
 * text. */
static int parse_document(parser *s)
{
    int complete;
    skip_space(s);
    if (peek(s) != '{')
        return syntax(s, "expected '{'");
    do {
        if (!read_value(s, &complete))
            return 0;
        if (complete && !after_value(s))
            return 0;
    } while (s->open != JSON_NONE);
    skip_space(s);
    return s->at == s->doc->size ? 1 : syntax(s, "text after the end of the document");
}

/* Every value except the root follows a bracket or a comma. */
static size_t node_bound(const char *text, size_t size)
{
    size_t bound = 1, i;
    for (i = 0; i < size; ++i)
        bound += text[i] == ',' || text[i] == '[' || text[i] == '{';
    return bound;
}

int json_parse(json *out, const char *text, size_t size, const char *name, report *r)
{
    parser s = {NULL, 0, JSON_NONE, JSON_NONE, 0, 0, 0, NULL};
    size_t bound;
    memset(out, 0, sizeof *out);
    if (size >= UINT32_MAX)
        return report_fail(r, "%s: JSON of 4 GiB or more; split the file", name);
    bound = node_bound(text, size);
    if (bound > SIZE_MAX / sizeof *out->nodes)
        return report_fail(r, "%s: too large for this machine", name);
    out->nodes = (json_node *)malloc(bound * sizeof *out->nodes);
    if (!out->nodes)
        return report_fail(r, "%s: out of memory for the JSON; close other programs", name);
    out->text = text;
    out->name = name;
    out->size = (uint32_t)size;
    s.doc = out;
    s.r = r;
    if (size >= 3 && memcmp(text, "\xEF\xBB\xBF", 3) == 0)
        s.at = 3;
    if (parse_document(&s))
        return 1;
    json_free(out);
    return 0;
}

void json_free(json *doc)
{
    free(doc->nodes);
    memset(doc, 0, sizeof *doc);
}

uint32_t json_kind(const json *doc, uint32_t node) { return node == JSON_NONE ? JSON_NONE : doc->nodes[node].kind; }

uint32_t json_count(const json *doc, uint32_t node) { return node == JSON_NONE ? 0 : doc->nodes[node].count; }

uint32_t json_first(const json *doc, uint32_t node) { return json_count(doc, node) ? node + 1 : JSON_NONE; }

uint32_t json_next(const json *doc, uint32_t node) { return node == JSON_NONE ? JSON_NONE : doc->nodes[node].next; }

uint32_t json_member(const json *doc, uint32_t object, const char *key)
{
    size_t n = strlen(key);
    uint32_t i;
    if (json_kind(doc, object) != JSON_OBJECT)
        return JSON_NONE;
    for (i = json_first(doc, object); i != JSON_NONE; i = doc->nodes[i].next)
        if (doc->nodes[i].key_size == n && memcmp(doc->text + doc->nodes[i].key_start, key, n) == 0)
            return i;
    return JSON_NONE;
}

/* Puts `size` bytes before *head, as far as they fit; returns 0 if they did not fit. */
static int prepend(char *out, size_t *head, const char *text, size_t size)
{
    if (size > *head)
        return 0;
    *head -= size;
    memcpy(out + *head, text, size);
    return 1;
}

static int prepend_step(char *out, size_t *head, const json *doc, uint32_t node)
{
    const json_node *n = &doc->nodes[node];
    char number[16];
    uint32_t i, at = 0;
    if (doc->nodes[n->parent].kind == JSON_OBJECT)
        return prepend(out, head, doc->text + n->key_start, n->key_size) &&
               (doc->nodes[n->parent].parent == JSON_NONE || prepend(out, head, ".", 1));
    for (i = n->parent + 1; i != node; i = doc->nodes[i].next)
        ++at;
    snprintf(number, sizeof number, "[%u]", (unsigned)at);
    return prepend(out, head, number, strlen(number));
}

void json_path(char *out, size_t cap, const json *doc, uint32_t node)
{
    size_t head = cap - 1;
    out[head] = '\0';
    if (node == JSON_NONE || doc->nodes[node].parent == JSON_NONE) {
        snprintf(out, cap, "the document");
        return;
    }
    while (doc->nodes[node].parent != JSON_NONE && prepend_step(out, &head, doc, node))
        node = doc->nodes[node].parent;
    memmove(out, out + head, cap - head);
}

int json_fail(const json *doc, uint32_t node, report *r, const char *format, ...)
{
    char path[160], message[320];
    va_list args;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    json_path(path, sizeof path, doc, node);
    return report_fail(r, "%s: %s: %s", doc->name, path, message);
}

/* The tools never call setlocale, so strtod reads a point. */
int json_read_double(double *out, const json *doc, uint32_t node, report *r)
{
    double value;
    if (node == JSON_NONE)
        return 1;
    if (doc->nodes[node].kind != JSON_NUMBER)
        return json_fail(doc, node, r, "must be a number");
    value = strtod(doc->text + doc->nodes[node].start, NULL);
    if (!(fabs(value) <= 1e300))
        return json_fail(doc, node, r, "the number is too large");
    *out = value;
    return 1;
}

int json_read_doubles(double *out, uint32_t count, const json *doc, uint32_t node, report *r)
{
    uint32_t i;
    if (node == JSON_NONE)
        return 1;
    if (doc->nodes[node].kind != JSON_ARRAY || doc->nodes[node].count != count)
        return json_fail(doc, node, r, "must be an array of %u numbers", (unsigned)count);
    for (i = json_first(doc, node); i != JSON_NONE; i = doc->nodes[i].next)
        if (!json_read_double(out++, doc, i, r))
            return 0;
    return 1;
}

int json_read_uint(uint32_t *out, const json *doc, uint32_t node, report *r)
{
    double value = 0;
    if (node == JSON_NONE)
        return 1;
    if (!json_read_double(&value, doc, node, r))
        return 0;
    if (!(value >= 0.0 && value <= 4294967294.0) || value != floor(value))
        return json_fail(doc, node, r, "must be a whole number from 0 to 4294967294");
    *out = (uint32_t)value;
    return 1;
}

int json_read_bool(int *out, const json *doc, uint32_t node, report *r)
{
    uint32_t kind = json_kind(doc, node);
    if (node == JSON_NONE)
        return 1;
    if (kind != JSON_TRUE && kind != JSON_FALSE)
        return json_fail(doc, node, r, "must be true or false");
    *out = kind == JSON_TRUE;
    return 1;
}

/* UTF-8 of a code point; returns the length. */
static size_t utf8(char out[4], uint32_t code)
{
    if (code < 0x80) {
        out[0] = (char)code;
        return 1;
    }
    if (code < 0x800) {
        out[0] = (char)(0xC0 | (code >> 6));
        out[1] = (char)(0x80 | (code & 63));
        return 2;
    }
    if (code < 0x10000) {
        out[0] = (char)(0xE0 | (code >> 12));
        out[1] = (char)(0x80 | ((code >> 6) & 63));
        out[2] = (char)(0x80 | (code & 63));
        return 3;
    }
    out[0] = (char)(0xF0 | (code >> 18));
    out[1] = (char)(0x80 | ((code >> 12) & 63));
    out[2] = (char)(0x80 | ((code >> 6) & 63));
    out[3] = (char)(0x80 | (code & 63));
    return 4;
}

/* Decodes one character at *at of checked string text, including escapes, into out; returns the length. */
static size_t next_character(char out[4], const json *doc, uint32_t *at, uint32_t end)
{
    static const char from[] = "bfnrt", to[] = "\b\f\n\r\t";
    int c = (unsigned char)doc->text[(*at)++];
    uint32_t code;
    size_t n = 1;
    out[0] = (char)c;
    if (c >= 0xC0) { /* the rest of a UTF-8 character, so that a cut falls between characters */
        while (n < 4 && *at < end && ((unsigned char)doc->text[*at] & 0xC0) == 0x80)
            out[n++] = doc->text[(*at)++];
        return n;
    }
    if (c != '\\')
        return 1;
    c = (unsigned char)doc->text[(*at)++];
    if (c != 'u') {
        const char *found = strchr(from, c);
        out[0] = found ? to[found - from] : (char)c;
        return 1;
    }
    code = (uint32_t)hex4(doc, *at);
    *at += 4;
    if (code >= 0xD800 && code <= 0xDBFF) {
        code = 0x10000 + ((code - 0xD800) << 10) + ((uint32_t)hex4(doc, *at + 2) - 0xDC00);
        *at += 6;
    }
    return utf8(out, code);
}

size_t json_string(char *out, size_t cap, const json *doc, uint32_t node)
{
    uint32_t at, end;
    size_t length = 0;
    int full = 0;
    char *to = out;
    *to = '\0';
    if (json_kind(doc, node) != JSON_STRING)
        return 0;
    at = doc->nodes[node].start;
    end = at + doc->nodes[node].size;
    while (at < end) {
        char bytes[4];
        size_t n = next_character(bytes, doc, &at, end);
        full = full || n >= cap - (size_t)(to - out);
        length += n;
        if (full)
            continue;
        memcpy(to, bytes, n);
        to += n;
        *to = '\0';
    }
    return length;
}

int json_equals(const json *doc, uint32_t node, const char *text)
{
    size_t n = strlen(text);
    return json_kind(doc, node) == JSON_STRING && doc->nodes[node].size == n &&
           memcmp(doc->text + doc->nodes[node].start, text, n) == 0;
}
