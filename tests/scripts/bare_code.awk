# C without comments and strings, line by line.
{
    line = $0
    out = ""
    while (line != "") {
        if (inside) {
            at = index(line, "*/")
            if (at == 0) {
                line = ""
            } else {
                inside = 0
                line = substr(line, at + 2)
            }
        } else if (match(line, /\/\*|\/\/|"([^"\\]|\\.)*"|'([^'\\]|\\.)+'/)) {
            what = substr(line, RSTART, 2)
            out = out substr(line, 1, RSTART - 1) " "
            inside = what == "/*"
            line = what == "//" ? "" : substr(line, RSTART + RLENGTH)
        } else {
            out = out line
            line = ""
        }
    }
    print out
}
