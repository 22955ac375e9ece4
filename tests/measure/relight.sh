# relight.sh: prints the relight figures, with instructions of an update if valgrind can count them.
#
# LMB_SHARED: the folder with truth/ and data/ (default ../shared). The program makes two updates by each filter;
# callgrind counts only inside relight_update and writes a file after each call. The script uses every second file.
work=$B/relight
mkdir -p "$work"
rm -f "$work"/count*

if command -v valgrind >/dev/null 2>&1 &&
    valgrind --tool=callgrind --callgrind-out-file="$work/count" --toggle-collect=relight_update \
        --dump-after=relight_update "$B/measure-relight" count >"$work/names" 2>"$work/said"; then
    i=0
    while read -r name; do
        i=$((i + 2))
        echo "$name $(sed -n 's/^summary: \([0-9]*\).*/\1/p' "$work/count.$i")"
    done <"$work/names" >"$work/counts"
    exec "$B/measure-relight" "$work/counts"
fi
exec "$B/measure-relight"
