# sum.sh: adds up the logs of part.sh, prints one line, and succeeds if nothing failed: sum.sh LOG...
# A missing log means that the part did not run.
for log in "$@"; do
    [ -f "$log" ] || echo "0 passed, 1 failed, 0 skipped"
    grep -o '[0-9][0-9]* passed, [0-9][0-9]* failed, [0-9][0-9]* skipped' "$log" | tail -n 1
done | awk '
    { p += $1; f += $3; s += $5 }
    END { printf "%d passed, %d failed, %d skipped\n", p, f, s; exit f > 0 || p == 0 }'
