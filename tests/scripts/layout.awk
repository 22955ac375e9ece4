# layout.awk: finds in the headers the capacities on which a program and the library must agree:
#   awk -f tests/scripts/layout.awk include/lambent/config.h OTHER_HEADERS... CALLS      (CALLS: from prototypes.awk)
# prints `capacity NAME` for each capacity of config.h that sizes a public struct, and `call NAME` for each call that
# takes such a struct, or a struct that holds or points to one.
FILENAME == ARGV[1] {
    # Capacities that a build may define, and those that the tiny configuration defines.
    if ($1 == "#ifndef") open_for = $2
    if ($1 == "#ifdef" && $2 == "LMB_CONFIG_TINY") in_tiny = 1
    if ($1 == "#define" && $3 ~ /^[0-9]+$/ && ($2 == open_for || in_tiny)) may_change[$2] = 1
    if ($1 == "#endif") in_tiny = 0
    next
}
FILENAME == ARGV[ARGC - 1] { call[++calls] = $0; next }
{
    gsub(/\/\*.*\*\//, "")
    if (/^typedef struct lmb_/) { name = $3; next }
    if (/^}/) name = ""
    if (name != "") body[name] = body[name] " " $0
}
END {
    for (s in body)
        for (c in may_change)
            if (body[s] ~ "\\[[^]]*" c "[^]A-Z_]*\\]") { sized[s] = 1; sizes[c] = 1 }
    do {
        more = 0
        for (s in body)
            for (t in sized)
                if (!(s in sized) && body[s] ~ "(^|[ (])" t "[ *]") { sized[s] = 1; more = 1 }
    } while (more)
    for (c in sizes) print "capacity", c
    for (i = 1; i <= calls; ++i) {
        split(call[i], part, "|")
        for (t in sized)
            if (part[3] ~ "(^|[ ;])" t "[ *;]" || part[2] ~ "(^|[ ])" t "( |$)") { print "call", part[1]; break }
    }
}
