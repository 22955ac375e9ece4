# amalgam.awk: writes the library as two files, lambent.h (PART=h) and lambent.c (PART=c). Run it
# from the root of the tree.
#
#   awk -v PART=c -v VERSION=0.1.0 -f platform/amalgam/amalgam.awk src/*/*.c
#
# The headers of src come first, each once. Then comes each .c file with the files that only a unit may include,
# copied for each unit: verbs and formulas of a backend (lane_*.h, sums_*.h, target*.h, *.inl, *.inc), and headers
# that hide calls missing in a build. If two units define the same name at file scope, the name gets the file's name
# as a suffix (walk in clip.c: walk_clip). Macros of a unit are undefined at its end. Comments of kernels are printed
# only in the plain C backend.
function fold(path,    part, n, i, kept, out) {
    n = split(path, part, "/")
    kept = 0
    for (i = 1; i <= n; ++i) {
        if (part[i] == ".." && kept > 0) --kept
        else if (part[i] != ".") kept_part[++kept] = part[i]
    }
    out = kept_part[1]
    for (i = 2; i <= kept; ++i) out = out "/" kept_part[i]
    return out
}

# The file of src that a line includes; "" if there is none.
function included(line, from,    name) {
    if (line !~ /^ *# *include +"/) return ""
    name = line
    sub(/^[^"]*"/, "", name)
    sub(/".*/, "", name)
    sub(/[^\/]*$/, "", from)
    return fold(from name)
}

# Returns whether a file is copied into each unit. A header that includes such a file is copied too.
function is_own(path,    i, to, found) {
    if (path ~ /\.(inl|inc)$/ || path ~ /frame\/(requires|stages)\.h$/ || path ~ /src\/lane\/(lane|sums|target)[^\/]*\.h$/) return 1
    if (path in owned) return owned[path]
    load(path)
    for (i = 1; i <= lines[path] && !found; ++i) {
        to = included(text[path, i], path)
        if (to != "") found = is_own(to)
    }
    return owned[path] = found + 0
}

function load(path,    line) {
    if (path in lines) return
    lines[path] = 0
    while ((getline line < path) > 0) text[path, ++lines[path]] = line
    close(path)
    if (lines[path] == 0) { print "amalgam.awk: no file " path > "/dev/stderr"; failed = 1; exit 1 }
}

# A line without strings and comments; `inside` is set if a comment continues.
function bare(line,    out, at, rest) {
    out = ""
    while (line != "") {
        if (inside) {
            at = index(line, "*/")
            if (!at) return out
            inside = 0
            line = substr(line, at + 2)
            out = out " "
        } else if (match(line, /"([^"\\]|\\.)*"|'([^'\\]|\\.)*'|\/\*|\/\//)) {
            rest = substr(line, RSTART, 2)
            out = out substr(line, 1, RSTART - 1)
            if (rest == "//") return out
            if (rest == "/*") inside = 1
            else out = out "0"
            line = substr(line, RSTART + (rest == "/*" ? 2 : RLENGTH))
        } else {
            return out line
        }
    }
    return out
}

# --- names defined at file scope of a unit ---------------------------------------------------------------------------

function add_name(name) {
    if (name ~ /^(lmb_|LMB_)/ || name in keyword || name !~ /^[A-Za-z_]/ || (unit, name) in defines) return
    defines[unit, name] = 1
    ++units_with[name]
}

function end_statement() {
    was = at_paren = after_equals = parens = tag_next = function_seen = 0
    previous = before = ""
}

# One token of a unit's code; braces, parens: nesting depth.
function scan(token,    word) {
    word = token ~ /^[A-Za-z_]/
    if (token == "{") {
        if (++braces == 1) {
            if (head_enum) in_enum = 1
            want_constant = 1
        }
    } else if (token == "}") {
        if (--braces == 0) {
            in_enum = head_enum = 0
            if (function_seen && !after_equals) end_statement()
            previous = "}"
            return
        }
    } else if (braces > 0) {
        if (in_enum && braces == 1) {
            if (token == ",") want_constant = 1
            else if (word && want_constant) { add_name(token); want_constant = 0 }
        }
        return
    } else if (token == "(") {
        if (parens++ == 0 && previous ~ /^[A-Za-z_]/ && !function_seen && !after_equals && previous !~ /^(__attribute__|KERNEL|__declspec)$/) {
            add_name(previous)
            function_seen = 1
        }
        if (parens == 1 && previous == "KERNEL") function_seen = 1
    } else if (token == ")") {
        --parens
    } else if (parens > 0) {
        # parameters; for a pointer to a function, `(*name)`
        if (word && parens == 1 && previous == "*" && before == "(") add_name(token)
    } else if (token == ";" || token == "," || token == "[" || token == "=") {
        if (previous ~ /^[A-Za-z_]/ && !function_seen && !after_equals) add_name(previous)
        if (token == "=") after_equals = 1
        if (token == ",") after_equals = 0
        if (token == ";") { end_statement(); head_enum = 0 }
    } else if (word) {
        if (previous ~ /^(struct|union|enum)$/) tag = token
        if (token == "enum") head_enum = 1
    }
    if (token == "{" && tag != "") { add_name(tag) }
    if (!(word && previous ~ /^(struct|union|enum)$/)) tag = ""
    before = previous
    previous = token
}

function tokens_of(line) {
    while (match(line, /[A-Za-z_][A-Za-z_0-9]*|[0-9][A-Za-z_0-9.]*|->|[^ \t]/)) {
        scan(substr(line, RSTART, RLENGTH))
        line = substr(line, RSTART + RLENGTH)
    }
}

# The lines of a unit, with the files copied into it; records shared headers in order.
function gather(path,    i, line, to) {
    load(path)
    for (i = 1; i <= lines[path]; ++i) {
        line = text[path, i]
        to = included(line, path)
        if (to == "") {
            own[++owns] = line
        } else if (is_own(to)) {
            if (to ~ /\.h$/ && to !~ /target/) {
                if ((unit, to) in taken) continue
                taken[unit, to] = 1
            }
            gather(to)
        } else {
            share(to)
        }
    }
}

function names_of_own(    i, line, goes_on, name) {
    inside = braces = in_enum = head_enum = 0
    end_statement()
    for (i = 1; i <= owns; ++i) {
        line = bare(own[i])
        if (goes_on || line ~ /^ *#/) {
            if (!goes_on && match(line, /^ *# *define +[A-Za-z_0-9]+/)) {
                name = substr(line, RSTART, RLENGTH)
                sub(/.* /, "", name)
                macros[unit] = macros[unit] " " name
            }
            goes_on = line ~ /\\$/
            continue
        }
        tokens_of(line)
    }
    if (braces != 0) { print "amalgam.awk: " unit ": braces " braces > "/dev/stderr"; failed = 1; exit 1 }
}

# A header of src, after the headers that it includes. Its names are never renamed.
function share(path,    i, to, kept_unit) {
    if (path in shared) return
    shared[path] = 1
    load(path)
    for (i = 1; i <= lines[path]; ++i) {
        to = included(text[path, i], path)
        if (to != "" && !is_own(to)) share(to)
    }
    header_order[++headers] = path
}

function count_shared(    h, i) {
    unit = "headers"
    for (h = 1; h <= headers; ++h) {
        owns = 0
        for (i = 1; i <= lines[header_order[h]]; ++i) own[++owns] = text[header_order[h], i]
        names_of_own()
    }
}

# --- output ----------------------------------------------------------------------------------------------------------

# Renames tokens with the unit's suffix. Members of structs keep their names, after a dot or an arrow and in
# declarations of structs in the unit.
function renamed(line,    out, token, rest, before, was_inside) {
    out = ""
    while (line != "") {
        if (inside) {
            at = index(line, "*/")
            if (!at) return out (strip ? "" : line)
            if (!strip) out = out substr(line, 1, at + 1)
            line = substr(line, at + 2)
            inside = 0
            continue
        }
        if (!match(line, /[A-Za-z_][A-Za-z_0-9]*|[0-9][A-Za-z_0-9.]*|"([^"\\]|\\.)*"|'([^'\\]|\\.)*'|\/\*|\/\/|->|[^ \t]/)) return out line
        token = substr(line, RSTART, RLENGTH)
        before = substr(line, 1, RSTART - 1)
        rest = substr(line, RSTART + RLENGTH)
        out = out before
        if (token == "/*") {
            inside = 1
            if (!strip) out = out token
        } else if (token == "//") {
            return out token rest
        } else if ((unit, token) in defines && units_with[token] > 1 && last != "." && last != "->" &&
                   !(struct_depth > 0 && last ~ /^([A-Za-z_].*|\*|,)$/ && rest ~ /^ *[;,\[:]/ && !pre)) {
            out = out token ending
        } else {
            out = out token
        }
        if (!pre && token != "/*") {
            if (token == "{") {
                if (struct_depth > 0 || (depth == 0 && struct_head)) ++struct_depth
                ++depth
            }
            if (token == "}") { --depth; if (struct_depth > 0) --struct_depth }
            if (token == "struct" || token == "union") struct_head = 1
            if (token == ";" || token == "(" || token == "=" || token == "}") struct_head = 0
        }
        if (token != "/*") last = token
        line = rest
    }
    return out
}

function print_unit(    i, line, goes_on, n, name, gone) {
    ending = unit
    sub(/.*\//, "", ending)
    sub(/\.c$/, "", ending)
    sub(/^isa_/, "", ending)
    ending = "_" ending
    strip = unit ~ /isa_/ && unit !~ /isa_(pick|scalar)/
    print "\n/* ==== " unit " ==== */"
    inside = depth = struct_depth = struct_head = 0
    last = ""
    blank = 1
    for (i = 1; i <= owns; ++i) {
        line = own[i]
        if (line ~ /^ *# *include +<(lambent\/|stddef|stdint|string|float)/) continue
        if (line == "" && blank) continue
        blank = line == ""
        pre = goes_on || (!inside && line ~ /^ *#/)
        goes_on = pre && line ~ /\\$/
        line = renamed(line)
        if (strip) sub(/ +$/, "", line)
        if (!strip || line != "") print line
    }
    n = split(macros[unit], name, " ")
    for (i = 1; i <= n; ++i) {
        if (name[i] in gone) continue
        gone[name[i]] = 1
        print "#undef " name[i]
        if (name[i] in laid_out) print laid_out[name[i]]
    }
}

function print_header(path,    i, line) {
    print "\n/* ==== " path " ==== */"
    blank = 1
    for (i = 1; i <= lines[path]; ++i) {
        line = text[path, i]
        if (line ~ /^ *# *include +("|<lambent\/|<(stddef|stdint|string|float)\.h>)/) continue
        if (line == "" && blank) continue
        blank = line == ""
        print line
    }
}

# A public header with the headers that it includes, each once.
function print_public(path,    i, line, to) {
    if (path in shared) return
    shared[path] = 1
    load(path)
    print "\n/* ==== " path " ==== */"
    for (i = 1; i <= lines[path]; ++i) {
        line = text[path, i]
        to = included(line, path)
        if (to != "") print_public(to)
        else print line
    }
}

function print_top(what,    i) {
    print "/* lambent " VERSION ": " what
    print " *"
    print " * A portable software rasterizer with indirect light, as two files. Made by `make amalgam`; not for editing."
    print " *"
    print " *   cc -std=c99 -O2 -ffp-contract=off -c lambent.c      then link it with a program that includes lambent.h, and -lm"
    print " *"
    print " * Never -ffast-math. One call compiles all backends that the machine may pick from (AVX-512, AVX2 and SSE2 on"
    print " * x86-64; NEON; simd128; plain C): lmb_kernels_pick asks the processor."
    print " *"
    print " * Capacities and switches are macros of config.h, which comes first in lambent.h. Define them for both files and the"
    print " * program alike. -DLMB_CONFIG_TINY picks the small capacities. What can be left out, each by -DLMB_...=0:"
    for (i = 1; i <= switches; ++i) print " *   " switch_name[i] switch_says[i]
    print " *   LMB_HAVE_AVX512, LMB_HAVE_AVX2, LMB_HAVE_SSE2, LMB_HAVE_NEON, LMB_HAVE_SIMD128   a backend"
    print " *"
    for (i = 1; i <= lines["LICENSE"]; ++i) print " *" (text["LICENSE", i] == "" ? "" : " " text["LICENSE", i])
    print " */"
}

# Finds switches of config.h: `0: this build has no ...` above an #ifndef.
function find_switches(    path, i, says) {
    path = "include/lambent/config.h"
    load(path)
    for (i = 1; i <= lines[path]; ++i) {
        if (text[path, i] ~ /^\/\* 0: /) {
            says = text[path, i]
            sub(/^\/\* 0: (this build )?/, "", says)
            sub(/[.:;(].*/, "", says)
            sub(/ *(\*\/)?$/, "", says)
        } else if (text[path, i] ~ /^#ifndef / && says != "") {
            switch_name[++switches] = substr(text[path, i], 9)
            switch_says[switches] = sprintf("%*s%s", 22 - length(switch_name[switches]), "", says)
            says = ""
        }
    }
}

BEGIN {
    n = split("auto break case char const continue default do double else enum extern float for goto if inline int long " \
              "register return short signed sizeof static struct switch typedef union unsigned void volatile while " \
              "int8_t uint8_t int16_t uint16_t int32_t uint32_t int64_t uint64_t size_t NULL __attribute__ KERNEL", word, " ")
    for (i = 1; i <= n; ++i) keyword[word[i]] = 1
    load("LICENSE")
    path = "include/lambent/layout.h"
    load(path)
    for (i = 1; i <= lines[path]; ++i) {
        if (text[path, i] ~ /^#define lmb_/) {
            split(text[path, i], word, " ")
            laid_out[word[2]] = text[path, i]
        }
    }
    find_switches()
    if (PART == "h") {
        print_top("lambent.h, the whole public face")
        print_public("include/lambent/lambent.h")
        exit
    }
    for (a = 1; a < ARGC; ++a) {
        unit = ARGV[a]
        owns = 0
        gather(unit)
        names_of_own()
    }
    count_shared()
    print_top("lambent.c, the whole library")
    print "#include \"lambent.h\"\n"
    print "#if defined(__clang__)\n#pragma clang diagnostic ignored \"-Wunused-function\" /* verbs that some kernels lack */\n#endif"
    print "#include <float.h>\n#include <stddef.h>\n#include <stdint.h>\n#include <string.h>"
    # For C++, names are as in C; headers with templates come first.
    print "#ifdef __cplusplus\n#if defined(__SSE2__)\n#include <cpuid.h>\n#include <immintrin.h>"
    print "#elif defined(__ARM_NEON)\n#include <arm_neon.h>\n#endif\nextern \"C\" {\n#endif"
    for (h = 1; h <= headers; ++h) print_header(header_order[h])
    for (a = 1; a < ARGC; ++a) {
        unit = ARGV[a]
        owns = 0
        split("", taken)
        gather(unit)
        print_unit()
    }
    print "\n#ifdef __cplusplus\n}\n#endif"
    exit failed
}
