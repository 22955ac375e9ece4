# same.sh: the golden lines of several machines' logs are the first one's, no more and no less: same.sh LOG... With EACH=N
# in the environment a machine may draw every Nth.
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
        awk -v each="${EACH:-1}" 'NR == FNR { is[$1] = $2; next }
            ($1 in is ? is[$1] != $2 : each == 1) { print; exit 1 }' "$first.lines" "$log.lines" >"$log.other"
        check "$log against $first: $(cat "$log.other")" test ! -s "$log.other"
        few=$(($(grep -c . "$first.lines") / ${EACH:-1}))
        check "$log has as many lines" test "$(grep -c . "$log.lines")" -ge "$few"
    fi
done
check "no machine has golden lines" test -n "$first"
finish
