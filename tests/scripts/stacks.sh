# stacks.sh: checks the largest stack frame of each machine's build, and the call with the most stack including callees,
# against a budget: stacks.sh BYTES BUILD...
#
# At -O0 no variables share stack slots, and at -O1 and -Os the verbs of wide lanes are calls. Such builds ship only for
# narrow lanes (Cortex-M, which is checked). On hosts they are printed, not checked.
. tests/scripts/checks.sh
budget=$1
shift

for build in "$@"; do
    largest=$(find "$build" -path '*/obj/src/*' -name '*.su' -exec cat {} + 2>/dev/null | awk -F '\t' '
        { n = split($1, part, ":"); print $2, part[n], $3 }' | sort -rn | head -n 1)
    [ -n "$largest" ] || continue
    printf '  %-14s %s\n' "$(basename "$build")" "$largest"
    # include/README.md lists the builds whose calls take up to 6.2 KiB.
    limit=$budget
    case $build in *-O3 | *-native | *ppc64* | *windows* | *riscv64* | *s390x*) limit=6400 ;; esac
    case $build in
    *-O0) ;;
    *-O1 | *-Os) sh tests/scripts/calls.sh "$build" "$budget" | sed -n '1s/^\([a-z]*\) \([0-9]* [a-z_0-9]*\) .*/                 \1 \2/p' ;;
    *)
        check "$build: $largest; the budget is $budget bytes" test "${largest%% *}" -le "$budget"
        calls=$(sh tests/scripts/calls.sh "$build" "$limit")
        [ -n "$calls" ] || continue
        printf '%s\n' "$calls" | sed -n '1s/^[a-z]*/                /p'
        check "$build: calls over $limit bytes: $(printf '%s\n' "$calls" | sed -n 's/^over //p')" \
            test "${calls#over}" = "$calls" -a "${calls#*
over}" = "$calls"
        ;;
    esac
done
finish
