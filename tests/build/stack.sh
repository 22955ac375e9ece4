# stack.sh: stack frames of the library's functions, as the compiler reports them (.su): B in the environment.
#   stack.sh BUDGET_BYTES
. tests/build/checks.sh
budget=$1

frames=$(find "$B/obj/src" -name '*.su' -exec cat {} + 2>/dev/null | awk -F '\t' '
    { n = split($1, part, ":"); sub(/^.*src\//, "src/", part[1]); print $2, part[n], part[1], $3 }' | sort -rn)
if [ -z "$frames" ]; then
    skip "this compiler does not report stack frames"
    finish
fi

echo "largest stack frames, bytes:"
printf '%s\n' "$frames" | head -n 12 | awk '{ printf "  %6d  %-34s %s\n", $1, $2, $3 }'
wrong=$(printf '%s\n' "$frames" | awk -v budget="$budget" '
    $1 > budget { print "FAIL " $3 ": " $2 " takes " $1 " bytes of stack; the budget is " budget }
    $4 == "dynamic" { print "FAIL " $3 ": " $2 " takes stack without a bound" }')
[ -z "$wrong" ] || printf '%s\n' "$wrong"
failed=$(printf '%s' "$wrong" | grep -c FAIL)
passed=$(($(printf '%s\n' "$frames" | grep -c .) - failed))
finish
