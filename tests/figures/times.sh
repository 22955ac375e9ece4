# times.sh: wall seconds by stage of a 640x480 frame, by preset and number of threads: the least of several runs.
#
# SCENES, QUALITIES, THREADS, FRAME: which. LMB_SHARED: the folder with truth/ (default ../shared). A case runs until it
# has taken ten seconds, at most five times, and the run with the shortest frame is shown. `frame` is all stages,
# without loading and writing; `again` what is left of it where light and objects stand still.
. tests/build/checks.sh

truth=${LMB_SHARED:-../shared}/truth
work=$B/figures
mkdir -p "$work"

# From the stats of one run: frame, again, the stages, pairs and segments, as numbers in a line. A stage's seconds stand
# before counts of the same name.
numbers() {
    awk '{
        gsub(/[",:{}]/, " ")
        for (i = 1; i < NF; ++i) {
            if (!($i in v)) v[$i] = $(i + 1)
        }
    }
    END {
        again = v["view"] + v["bands"]
        light = v["light_maps"] + v["blockers"] + v["first_points"] + v["groups"] + v["bounces"]
        printf "%.3f %.3f %.4f %.4f %.4f %.4f %.4f %.0f %.0f\n", light + again, again, v["light_maps"], v["blockers"],
            v["first_points"], v["view"], v["bands"], v["pairs"], v["segments"]
    }' "$work/times.json"
}

# One line a run. Fails where one does.
runs() {
    for run in 1 2 3 4 5; do
        "$TOOL" render "$truth/$1/scene.gltf" -o "$work/times.pfm" --quality "$2" --threads "$3" \
            --size "${FRAME:-640x480}" --stats "$work/times.json" >"$work/said" 2>&1 || return
        numbers | tee -a "$work/runs"
        if awk '{ s += $1 } END { exit s < 10 }' "$work/runs"; then
            break
        fi
    done
}

row() {
    : >"$work/runs"
    if ! runs "$1" "$2" "$3" >/dev/null; then
        fail "$1, $2, $3 threads: $(head -n 1 "$work/said")"
        return
    fi
    pass
    sort -n "$work/runs" | head -n 1 | sed "s/ / | /g; s/.*/| $1 | $2 | $3 | & |/"
}

[ -d "$truth" ] || { skip "$truth is not there (LMB_SHARED names its folder)"; finish; }

echo "| scene | quality | threads | frame, s | again | light maps | blockers | first points | view | bands | pairs |" \
    "segments |"
echo "|---|---|---|---|---|---|---|---|---|---|---|---|"
for scene in ${SCENES:-cornell bunny_room sponza}; do
    for quality in ${QUALITIES:-draft default best}; do
        for threads in ${THREADS:-1 2}; do
            row "$scene" "$quality" "$threads"
        done
    done
done
finish
