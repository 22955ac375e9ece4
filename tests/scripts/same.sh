# same.sh: checks that the golden lines in the logs of all machines equal those of the first log: same.sh LOG... With
# EACH=N in the environment a machine may draw every Nth.
#
# A log without golden lines is left out here, because the machine's own check reports the reason.
. tests/scripts/checks.sh

# Leaves out cases that depend on the capacities of a configuration: the machines have two configurations, and each
# machine checks such lines against the hash for its configuration.
capacity_cases() { sed -n 's/^CAPACITY_CASE("\([^"]*\)".*/\1/p' tests/golden/golden_capacity.inc; }
lines() { capacity_cases | awk 'NR == FNR { no[$1]; next } NF == 2 && $2 ~ /^[0-9a-f]+$/ && length($2) == 16 && !($1 in no)' - "$1"; }

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
        # The tiny configuration leaves out an eighth of the cases.
        few=$(($(grep -c . "$first.lines") * 5 / 6 / ${EACH:-1}))
        check "$log has as many lines" test "$(grep -c . "$log.lines")" -ge "$few"
    fi
done
check "no machine has golden lines" test -n "$first"
finish
