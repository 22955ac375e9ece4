# amalgam.awk: writes the library as two files, lambent.h (PART=h) and lambent.c (PART=c). Run it
# from the root of the tree.
#
#   awk -v PART=c -v VERSION=0.1.0 -f platform/amalgam/amalgam.awk src/*/*.c
#
# PART=names prints names that several sources define at file scope.
#
# The headers of src come first, each once. Then comes each .c file with the files that only a unit may include,
# copied for each unit: verbs and formulas of a backend (lane_*.h, sums_*.h, target*.h, *.inl, *.inc), and headers
# that hide calls missing in a build. What two units define at file scope, as the verbs, gets the unit's name as a
# suffix (lane_add in isa_avx2.c: lane_add_avx2). To find it, definitions begin at column 0, with one name each; members
# of structs have other names. Macros of a unit are undefined at its end. Comments of kernels are printed only in the
# plain C backend.
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

# --- names defined at file scope of a unit ---------------------------------------------------------------------------

function add_name(name) {
    if (name ~ /^(lmb_|LMB_)/ || name !~ /^[A-Za-z_]/ || name == "KERNEL" || (unit, name) in defines) return
    defines[unit, name] = 1
    ++units_with[name]
    if (from == unit || unit == "headers") files_with[name] = files_with[name] " " (from == unit ? unit : from)
}

# A line without comments.
function bare(line,    at, end) {
    if (inside) {
        if (!sub(/^.*\*\//, "", line)) return ""
        inside = 0
    }
    while ((at = index(line, "/*")) > 0) {
        end = index(substr(line, at), "*/")
        inside = !end
        line = substr(line, 1, at - 1) (end ? " " substr(line, at + end + 1) : "")
    }
    return line
}

# Names in a line of code at column 0: functions, objects, types; and constants of an enum.
function names_of_line(line,    word, n, i) {
    if (line ~ /^(typedef )?enum/) in_enum = 1
    if (in_enum) {
        sub(/^.*\{/, "", line)
        in_enum = line !~ /\}/
        sub(/\}.*/, "", line)
        gsub(/=[^,]*/, "", line)
        n = split(line, word, /[ ,]+/)
        for (i = 1; i <= n; ++i) add_name(word[i])
    } else if (line ~ /^typedef (struct|union) [a-z_0-9]+ \{/) {
        split(line, word, " ")
        add_name(word[3])
    } else if (line ~ /^\} [a-z_0-9]+;/ || line ~ /^typedef [a-z_0-9 ]+;/) {
        sub(/;.*/, "", line)
        sub(/.* /, "", line)
        add_name(line)
    } else if (line ~ /^[A-Za-z]/) {
        gsub(/__attribute__\(\([a-z_]*\)\) |\(\*/, "", line)
        if (match(line, /[A-Za-z_0-9]+[[(;)]/) || match(line, /[A-Za-z_0-9]+ =/)) {
            line = substr(line, RSTART, RLENGTH)
            sub(/[^A-Za-z_0-9]+$/, "", line)
            add_name(line)
        }
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
            own_from[owns] = path
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
    in_enum = inside = 0
    for (i = 1; i <= owns; ++i) {
        line = own[i]
        from = own_from[i]
        if (goes_on || line ~ /^ *#/) {
            if (!goes_on && match(line, /^ *# *define +[A-Za-z_0-9]+/)) {
                name = substr(line, RSTART, RLENGTH)
                sub(/.* /, "", name)
                macros[unit] = macros[unit] " " name
            }
            goes_on = line ~ /\\$/
        } else {
            names_of_line(bare(line))
        }
    }
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
        for (i = 1; i <= lines[header_order[h]]; ++i) {
            own[++owns] = text[header_order[h], i]
            own_from[owns] = header_order[h]
        }
        names_of_own()
    }
}

# --- output ----------------------------------------------------------------------------------------------------------

# Adds the unit's suffix to names that other units define too, but not to members of structs, after a dot or an arrow.
# Leaves out comments if `strip` is set.
function renamed(line,    out, token, at) {
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
        if (!match(line, /[A-Za-z_][A-Za-z_0-9]*|[0-9][A-Za-z_0-9.]*|"([^"\\]|\\.)*"|'([^'\\]|\\.)*'|\/\*|->|[^ \t]/)) return out line
        token = substr(line, RSTART, RLENGTH)
        out = out substr(line, 1, RSTART - 1)
        line = substr(line, RSTART + RLENGTH)
        inside = token == "/*"
        if (!inside || !strip) out = out token
        if ((unit, token) in defines && units_with[token] > 1 && last != "." && last != "->") out = out ending
        if (!inside) last = token
    }
    return out
}

function print_unit(    i, line, n, name, gone) {
    ending = unit
    sub(/.*\//, "", ending)
    sub(/\.c$/, "", ending)
    sub(/^isa_/, "", ending)
    ending = "_" ending
    strip = unit ~ /isa_/ && unit !~ /isa_(pick|scalar)/
    print "\n/* ==== " unit " ==== */"
    inside = 0
    last = ""
    blank = 1
    for (i = 1; i <= owns; ++i) {
        line = own[i]
        if (line ~ /^ *# *include +<(lambent\/|stddef|stdint|string|float)/) continue
        if (line == "" && blank) continue
        blank = line == ""
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
    if (PART == "names") {
        for (name in files_with) if (split(files_with[name], word, " ") > 1) print name ":" files_with[name]
        exit failed
    }
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
