# times.sh: wall seconds by stage of a 640x480 frame, by preset and number of threads: the minimum of several runs.
#
# SCENES, QUALITIES, THREADS, FRAME select the work. LMB_SHARED: the folder with truth/ (default ../shared). A case runs
# at most five times, or until it has taken ten seconds; the run with the shortest frame is shown. `frame` is the sum of
# all stages, without loading and writing. `again` is the rest of it when light and objects stand still. `user` is the
# user seconds of all threads, with loading and writing; other load on the machine changes it least.
. tests/measure/draw.sh

# Prints a table's cells from the stats of the last run.
cells() {
    maps=$(figure shadow_maps) bvh=$(figure BVH) points=$(figure first_points)
    view=$(figure view) bands=$(figure bands)
    awk "BEGIN { again = $view + $bands; printf \"%.3f | %.3f\", $maps + $bvh + $points + again, again }"
    echo " | $maps | $bvh | $points | $view | $bands | $(cat "$work/user") | $(figure pairs) | $(figure segments)"
}

row() {
    : >"$work/runs"
    for run in 1 2 3 4 5; do
        if ! draw "$1" "$2" "$3" "${FRAME:-640x480}" full; then
            fail "$1, $2, $3 threads: $(head -n 1 "$work/said")"
            return
        fi
        cells >>"$work/runs"
        awk '{ s += $1 } END { exit s < 10 }' "$work/runs" && break
    done
    pass
    echo "| $1 | $2 | $3 | $(sort -n "$work/runs" | head -n 1) |"
}

echo "| scene | quality | threads | frame, s | again | shadow maps | BVH | first points | view | bands | user |" \
    "pairs | segments |"
echo "|---|---|---|---|---|---|---|---|---|---|---|---|---|"
for scene in ${SCENES:-cornell bunny_room sponza}; do
    for quality in ${QUALITIES:-draft default best}; do
        for threads in ${THREADS:-1 2}; do
            row "$scene" "$quality" "$threads"
        done
    done
done
finish
