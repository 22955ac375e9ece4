# prototypes.awk: prints the public calls of the given headers, one a line: NAME|RETURNS|PARAMETER;PARAMETER;...
#   awk -f tests/scripts/prototypes.awk include/lambent/*.h
{
    line = line " " $0
    if (line ~ /\\$/) { sub(/\\$/, "", line); next }    # a macro with continuation lines
    if (line ~ /^ *#/) { if (line !~ /\/\*/ || line ~ /\*\//) line = ""; next }
    text = text line
    line = ""
}
END {
    while ((from = index(text, "/*")) > 0) {
        rest = substr(text, from)
        text = substr(text, 1, from - 1) " " substr(rest, index(rest, "*/") + 2)
    }
    gsub(/extern "C" \{/, ";", text)
    gsub(/[ \t]+/, " ", text)
    n = split(text, statement, /[;{}]/)
    for (i = 1; i <= n; ++i) {
        s = statement[i]
        if (s !~ /^ *[a-z_][A-Za-z0-9_ *]*lmb_[a-z0-9_]+\(.*\) *$/ || s ~ /typedef/) continue
        open = index(s, "(")
        head = substr(s, 1, open - 1)
        args = substr(s, open + 1)
        sub(/\) *$/, "", args)
        match(head, /lmb_[a-z0-9_]+$/)
        name = substr(head, RSTART)
        returns = substr(head, 1, RSTART - 1)
        gsub(/^ +| +$/, "", returns)
        gsub(/ *, */, ";", args)
        print name "|" returns "|" args
    }
}
