# contracts.awk: prints each public call with the header's description, one a line:
#   HEADER|STABILITY|NAME|RETURNS|STATUSES|WORDS      WORDS: the first sentence after the call's name
# and `unknown HEADER NAME` for each lmb_ name in a comment that no header declares.
#   awk -f tests/scripts/contracts.awk CALLS HEADER...      CALLS: HEADER|line of prototypes.awk, a line a call
#
# A comment describes the calls that it names as "lmb_a:" or "lmb_a, lmb_b:". The first comment of a header describes
# the whole header, and contains "Stability: stable." or "Stability: experimental.".
FILENAME == ARGV[1] {
    split($0, part, "|")
    order[++calls] = part[2]
    home[part[2]] = part[1]
    returns[part[2]] = part[3]
    known[part[2]] = 1
    next
}
FNR == 1 { header = FILENAME; sub(/.*\//, "", header); inside = 0; first = 1 }
{
    line = $0
    code = line
    if (!inside && match(line, /\/\*/)) {
        inside = 1
        said = ""
        code = substr(line, 1, RSTART - 1)
        line = substr(line, RSTART + 2)
    } else if (inside)
        code = ""
    if (inside) {
        done = sub(/\*\/.*/, "", line)
        sub(/^ \*/, "", line)
        gsub(/^ +| +$/, "", line)
        gsub(/ *\[[VSPM][0-9][-VSPM0-9 ]*\]/, "", line)
        said = said (said == "" || line == "" ? "" : " ") line (line == "" ? "  " : "")
        if (done) { inside = 0; end_comment() }
    }
    while (match(code, /lmb_[a-z0-9_]+/)) {
        known[substr(code, RSTART, RLENGTH)] = 1
        code = substr(code, RSTART + RLENGTH)
    }
}
END {
    for (i = 1; i <= calls; ++i) {
        c = order[i]
        print home[c] "|" stability[home[c]] "|" c "|" returns[c] "|" statuses(all[c]) "|" sentence(words[c])
    }
    for (use in used) {
        split(use, part, " ")
        name = part[2]
        if (!(name in known) && name !~ /_g[0-9]+_l/) print "unknown " use
    }
}

function end_comment(    rest, list, n, i, title, before) {
    if (first && match(said, /Stability: [a-z]+/)) stability[header] = substr(said, RSTART + 11, RLENGTH - 11)
    rest = said
    while (match(rest, /lmb_[a-z0-9_]+/)) {
        used[header " " substr(rest, RSTART, RLENGTH)] = 1
        rest = substr(rest, RSTART + RLENGTH)
    }
    rest = first ? "" : said
    first = 0
    while (match(rest, /lmb_[a-z0-9_]+(, lmb_[a-z0-9_]+)*: /)) {
        list = substr(rest, RSTART, RLENGTH - 2)
        before = substr(rest, 1, RSTART - 1)
        rest = substr(rest, RSTART + RLENGTH)
        if (before !~ /^ *$|[.)]  *$|  $/) continue    # in a sentence
        n = split(list, title, ", ")
        for (i = 1; i <= n; ++i)
            if (home[title[i]] == header && !(title[i] in words)) { words[title[i]] = rest; all[title[i]] = said }
    }
}

function sentence(s) {
    gsub(/ \.\. /, " to ", s)
    sub(/\? .*/, "?", s)
    sub(/(\. |\.$|  ).*/, "", s)
    sub(/[.:,]$/, "", s)
    return s
}

function statuses(s,    list, x) {
    while (match(s, /LMB_(OK|MORE|ERR_[A-Z]+)/)) {
        x = substr(s, RSTART, RLENGTH)
        s = substr(s, RSTART + RLENGTH)
        if (index(list " ", " " x " ") == 0) list = list " " x
    }
    return substr(list, 2)
}
