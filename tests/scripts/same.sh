# same.sh: the golden lines of several machines' logs are the first one's, no more and no less: same.sh LOG...
#
# A machine that drew none has said why in its own log, and counts there.
. tests/scripts/checks.sh

lines() { grep -E '^[^ ]+ [0-9a-f]{16}$' "$1"; }

first=
for log in "$@"; do
    if [ -z "$(lines "$log")" ]; then
        continue
    elif [ -z "$first" ]; then
        first=$log
        lines "$first" >"$first.lines"
    else
        lines "$log" >"$log.lines"
        check "$log against $first" diff "$first.lines" "$log.lines"
    fi
done
check "no machine has golden lines" test -n "$first"
finish
