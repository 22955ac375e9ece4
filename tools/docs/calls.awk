# calls.awk: makes a page from the output of contracts.awk: each call, its stability, purpose and results.
BEGIN {
    FS = "|"
    print "# All calls {#calls}"
    print ""
    print "Each header says how stable it is; `types.h` says what a new version may change of it. Every call may be given"
    print "NULL, structs of zeros and numbers out of range (`types.h`); none takes more than 4 KiB of stack. Ranges, units"
    print "and cost stand where the call is described. Where a comment describes several calls, statuses are all of theirs."
}
/^unknown / { next }
$1 != header {
    header = $1
    printf "\n## %s: %s\n\n| call | what it does |\n|---|---|\n", $1, $2
}
{
    gsub(/ /, ", ", $5)
    printf "| %s() | %s%s *%s* |\n", $3, escape($6), $6 ~ /\?$/ ? "" : ".", $4 == "lmb_status" ? $5 : escape($4)
}

function escape(s) {
    gsub(/\\/, "\\\\", s)
    gsub(/&/, "\\&amp;", s)
    gsub(/</, "\\&lt;", s)
    gsub(/`/, "", s)
    gsub(/[][*_#@%~]/, "\\\\&", s)
    return s
}
