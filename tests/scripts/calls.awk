# calls.awk: reads gcc's call graphs (.ci, -fcallgraph-info=su) of the library and prints the maximum stack of each
# call, including its callees: "BYTES NAME CHAIN".
#
# A call through the table of kernels may reach any backend; the source line names the kernel. Callbacks of the user and
# functions outside the library (memset, soft floats) count as 0.

/^node:/ {
    name = between($0, "title: \"")
    n = split(between($0, "label: \""), part, "\\\\n")
    if (part[n] ~ /^[0-9]+ bytes/) {
        split(part[n], word, " ")
        bytes[name] = word[1] + 0
        kernel = name
        if (kernel ~ /^src\/isa\/isa_/ && sub(/^.*:/, "", kernel) &&
            sub(/_(scalar|sse2|avx2|avx512|neon|simd128)$/, "", kernel))
            backends[kernel] = backends[kernel] " " name
    }
}

/^edge:/ {
    from = between($0, "sourcename: \"")
    to = between($0, "targetname: \"")
    if (to != "__indirect_call")
        calls[from] = calls[from] " " to
    else
        through[from] = through[from] " " between($0, "label: \"")
}

END {
    for (name in bytes)
        if (name ~ /^lmb_/)
            print depth(name), name, chain[name]
}

function between(line, before,    at) {
    at = index(line, before)
    line = substr(line, at + length(before))
    return substr(line, 1, index(line, "\"") - 1)
}

# The kernel that is called at FILE:LINE:COLUMN, or "".
function kernel_at(place,    part, line, i) {
    split(place, part, ":")
    for (i = 1; i <= part[2]; ++i)
        getline line < part[1]
    close(part[1])
    line = substr(line, part[3])
    if (!match(line, /^[a-z_>-]*kernels->[a-z_]+\(/))
        return ""
    line = substr(line, 1, RLENGTH - 1)
    sub(/^.*->/, "", line)
    return line
}

function callees(name,    list, place, n, i) {
    list = calls[name]
    n = split(through[name], place, " ")
    for (i = 1; i <= n; ++i)
        list = list backends[kernel_at(place[i])]
    return list
}

function depth(name,    to, n, i, below, most) {
    if (name in known)
        return known[name]
    if (name in under_way) {
        print 1e9, name, "calls itself"
        return 0
    }
    under_way[name] = 1
    n = split(callees(name), to, " ")
    most = 0
    chain[name] = name ":" bytes[name]
    for (i = 1; i <= n; ++i) {
        below = to[i] in bytes ? depth(to[i]) : 0
        if (below > most) {
            most = below
            chain[name] = name ":" bytes[name] " " chain[to[i]]
        }
    }
    delete under_way[name]
    return known[name] = bytes[name] + most
}
