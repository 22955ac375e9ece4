# draw.sh: shared by truth.sh and times.sh: draws a truth scene with the tool, and reads its stats and user seconds.
. tests/scripts/checks.sh

truth=${LMB_SHARED:-../shared}/truth
work=$B/measure
mkdir -p "$work"

# truth_scenes [SET]: prints the scenes of tests/truth/truth_scenes.inc.
truth_scenes() { sed -n "s/^TRUTH_SCENE(\([a-z_]*\),.* ${1:-[a-z]*})/\1/p" tests/truth/truth_scenes.inc; }

# draw SCENE QUALITY THREADS WxH SHOW: draws with --gather GATHER (default full: at each pixel). Fails if the tool
# fails. Leaves drawn.pfm, stats.json, user, and the error message in `said`.
draw() {
    (
        "$TOOL" render "$truth/$1/scene.gltf" -o "$work/drawn.pfm" --quality "$2" --threads "$3" --size "$4" \
            --show "$5" --gather "${GATHER:-full}" --stats "$work/stats.json" >"$work/said" 2>&1 || exit
        times >"$work/times" # what this shell's children took; into a pipe it would be another shell's
    ) && awk 'NR == 2 { split($1, t, "m"); printf "%.2f\n", 60 * t[1] + t[2] }' "$work/times" >"$work/user"
}

# figure KEY: prints the first number of that name in the stats; a stage's seconds come before counts of the same name.
figure() { sed -n "s/.*\"$1\": \([0-9.]*\).*/\1/p" "$work/stats.json" | head -n 1; }

[ -f "$truth/compare.py" ] || { skip "$truth is not there (LMB_SHARED names its folder)"; finish; }
