# header.awk: converts the comments of a public header for doxygen; everything else is unchanged.
#
# A comment on separate lines documents the declarations up to the next empty line; a comment behind a declaration
# documents that one. Words keep their lines and columns, because tables of arguments need them.

function escape(s) {
    gsub(/\\/, "\\\\", s)
    gsub(/&/, "\\&amp;", s)
    gsub(/</, "\\&lt;", s)
    gsub(/>/, "\\&gt;", s)
    gsub(/@/, "\\@", s)
    gsub(/#/, "\\#", s)
    gsub(/%/, "\\%", s)
    return s
}

# The text of one line of a comment, without its frame.
function text(s) {
    sub(/^ ?\* ?/, "", s)
    sub(/ *\*\/.*$/, "", s)
    return escape(s)
}

# Whether a line ends a declaration; several declarations may share a comment.
function declarations(line) {
    if (line ~ /^[^ {}#\/].*\);$/ || line ~ /^ +.*\);$/) return 1
    return 0
}

function close_group() {
    if (grouped) print "/**@}*/"
    grouped = 0
}

BEGIN { first = 1 }

inside {
    if ($0 ~ /\*\//) {
        inside = 0
        after = $0
        sub(/^.*\*\//, "", after)    # an enum may end behind its last comment
        print text($0) "</pre> */" after
        if (!trailing && !header) pending = 1
        header = 0
    } else print text($0)
    next
}

/^\/\*/ {
    close_group()
    line = $0
    sub(/^\/\*\*? ?/, "", line)
    header = first
    first = 0
    start = "/** " (header ? "\\file\n" : "") "<pre>"
    trailing = 0
    if (line ~ /\*\//) {
        sub(/ *\*\/.*$/, "", line)
        print start escape(line) "</pre> */"
        if (!header) pending = 1
        header = 0
    } else {
        print start escape(line)
        inside = 1
    }
    next
}

# A comment behind a declaration.
/[^ ].*\/\* / && !/^ *\/\*/ && !/^#/ {
    at = index($0, "/*")
    code = substr($0, 1, at - 1)
    rest = substr($0, at + 2)
    sub(/^ +/, "", rest)
    if (rest ~ /\*\//) {
        after = rest
        sub(/^[^*]*(\*[^\/][^*]*)*\*\//, "", after)
        sub(/ *\*\/.*$/, "", rest)
        print code "/**< " escape(rest) " */" after
    } else {
        print code "/**< <pre>" escape(rest)
        inside = trailing = 1
    }
    next
}

pending && /^[^ ].*\);/ {
    print "/**@{*/"
    grouped = 1
    pending = 0
    print
    next
}
pending && /^[^ ]/ {
    pending = 0
    if ($0 ~ /\($|,$/ && $0 !~ /^(typedef|enum|struct|#|static)/) {
        print "/**@{*/"
        grouped = 1
    }
    print
    next
}
/^$/ { close_group(); pending = 0 }
{ print }
END { close_group() }
