# sum.sh: add up the logs of part.sh; one line, and success where nothing failed: sum.sh LOG...
# A log that is not there is a part that did not run.
for log in "$@"; do
    [ -f "$log" ] || echo "0 passed, 1 failed, 0 skipped"
    grep -o '[0-9][0-9]* passed, [0-9][0-9]* failed, [0-9][0-9]* skipped' "$log" | tail -n 1
done | awk '
    { p += $1; f += $3; s += $5 }
    END { printf "%d passed, %d failed, %d skipped\n", p, f, s; exit f > 0 || p == 0 }'
