# part.sh: runs one part of the checks, keeps its log, and prints one line with wall-clock and processor seconds:
# part.sh NAME COMMAND...
#
# Counts are read from the last line `N passed, N failed, N skipped` (it may have a prefix). If the line is missing, or
# has no failure although the exit status is not 0, one failure is added. LOGS: folder for NAME.log. NEEDS: required
# commands; without them the part is skipped. V=1 prints the whole log. Always succeeds; sum.sh returns the result.
name=$1
shift
log=${LOGS:?}/$name.log
mkdir -p "$LOGS"
needs=${NEEDS:-}
unset LOGS NEEDS
begun=$(date +%s)
counts='[0-9][0-9]* passed, [0-9][0-9]* failed, [0-9][0-9]* skipped'

if missing=$(sh tests/scripts/tools.sh need $needs 2>&1); then
    IN_CHECK=1 "$@" >"$log" 2>&1 </dev/null
    status=$?
else
    printf 'skipped: %s\n0 passed, 0 failed, 1 skipped\n' "$missing" >"$log"
    status=0
fi

line=$(grep -o "$counts" "$log" | tail -n 1)
case "$status/$line" in
0/[0-9]*) ;;
*/ | *", 0 failed,"*)
    line=$(echo "${line:-0 passed, 0 failed, 0 skipped}" | awk '{ $3 += 1; print }')
    printf 'exit status %s\n%s\n' "$status" "$line" >>"$log"
    ;;
esac

# One write, so that lines of parallel parts do not mix.
case "$V/$line" in
/*", 0 failed,"*) shown=$(grep '^skipped: ' "$log") ;;
*) shown=$(cat "$log") ;;
esac
times >"$log.times"
spent=$(awk 'NR == 2 { gsub(/[ms]/, " "); print int($1 * 60 + $2 + $3 * 60 + $4 + 0.5) }' "$log.times")
rm -f "$log.times"
printf '%s%-14s %s, %d s (%s of CPU)\n' "${shown:+$shown
}" "$name" "$line" $(($(date +%s) - begun)) "$spent"
