# stack.sh: checks the stack of the library's functions, as reported by the compiler: B in the environment.
#   stack.sh BUDGET_BYTES
#
# Reports each function's own frame (.su) and, if the compiler writes call graphs (.ci), each library call including all
# callees. Builds at -O1 and -Os print the calls, and only frames have a budget (stacks.sh).
. tests/scripts/checks.sh
budget=$1

frames=$(find "$B/obj/src" -name '*.su' -exec cat {} + 2>/dev/null | awk -F '\t' '
    { n = split($1, part, ":"); sub(/^.*src\//, "src/", part[1]); print $2, part[n], part[1], $3 }' | sort -rn | bare)
if [ -z "$frames" ]; then
    skip "this compiler does not report stack frames"
    finish
fi

echo "largest stack frames, bytes:"
printf '%s\n' "$frames" | head -n 12 | awk '{ printf "  %6d  %-34s %s\n", $1, $2, $3 }'
wrong=$(printf '%s\n' "$frames" | awk -v budget="$budget" '
    $1 > budget { print "FAIL " $3 ": " $2 " takes " $1 " bytes of stack; the budget is " budget }
    $4 == "dynamic" { print "FAIL " $3 ": " $2 " takes stack without a bound" }')

calls=$(sh tests/scripts/calls.sh "$B" "$budget" | bare)
optimized=yes
case " $FLAGS " in *" -O1 "* | *" -Os "*) optimized=no ;; esac
if [ -z "$calls" ]; then
    skip "this compiler does not report who calls whom"
else
    echo "calls that take the most stack, bytes, and how:"
    printf '%s\n' "$calls" | head -n 9 | cut -d ' ' -f 2- | sed 's/^/  /'
fi
if [ $optimized = no ]; then
    skip "the budget of calls: at -O1 and -Os the verbs of wide lanes are calls"
    calls=
fi
wrong=$(printf '%s\n' "$wrong" "$calls" | sed -n '/^FAIL/p; s/^over /FAIL too much stack with all that it calls: /p')
[ -z "$wrong" ] || printf '%s\n' "$wrong"
failed=$(printf '%s\n' "$wrong" | grep -c FAIL)
passed=$(($(printf '%s\n%s\n' "$frames" "$calls" | grep -c .) - failed))
finish
