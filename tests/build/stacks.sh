# stacks.sh: the largest stack frame that each machine's compiler made, against a budget: stacks.sh BYTES BUILD...
#
# At -O0 nothing shares a frame's slots, and no one ships it: told, not judged.
. tests/build/checks.sh
budget=$1
shift

for build in "$@"; do
    largest=$(find "$build" -path '*/obj/src/*' -name '*.su' -exec cat {} + 2>/dev/null | awk -F '\t' '
        { n = split($1, part, ":"); print $2, part[n], $3 }' | sort -rn | head -n 1)
    [ -n "$largest" ] || continue
    printf '  %-14s %s\n' "$(basename "$build")" "$largest"
    case $build in
    *-O0) ;;
    *) check "$build: $largest; the budget is $budget bytes" test "${largest%% *}" -le "$budget" ;;
    esac
done
finish
