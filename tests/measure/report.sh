# report.sh: measures speed against error of three truth scenes and the demo: one page each, and the
# README's table and picture.
#
# SCENES: scenes (default "demo cornell corridor sponza"). LMB_SHARED: the folder with truth/ (default ../shared).
# REPORT: output folder (default build/report). RUNS, BREAKDOWN: see `lambent-bench SCENE --help`.
# tests/results/README.md gets a table of all finished scenes, which may come from several runs, and front.svg beside it
# the Cornell box's picture.
. tests/scripts/checks.sh

truth=${LMB_SHARED:-../shared}/truth
to=${REPORT:-build/report}
scenes=${SCENES:-demo cornell corridor sponza}
mkdir -p "$to"

# sweep NAME ARGUMENT...: writes its page and prints the time.
sweep() {
    name=$1
    shift
    if "$TOOL-bench" "$@" --runs "${RUNS:-2}" --breakdown "${BREAKDOWN:-8}" -o "$to/$name" --svg "$to/$name.svg" \
        >"$to/$name.txt"; then
        pass
        echo "$to/$name.html: $(sed -n 's/^.*"seconds": \([0-9.]*\),$/\1/p' "$to/$name.json" | head -n 1) s"
    else
        fail "$name: no report"
    fi
}

# rows NAME TITLE: prints from the front the fastest, the knee, the most accurate, and between them each setting that
# reduces the error by a quarter.
rows() {
    awk -F, -v title="$2" '
    NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
    $3 == "front" || $3 == "knee" { ++n; name[n] = $1; mark[n] = $3; time[n] = $4; error[n] = $(column["trim"])
                                    bytes[n] = $(column["bytes"]) }
    function say(i, at) {
        at = time[i] < 1 ? sprintf("%.0f ms", 1000 * time[i]) : sprintf("%.1f s", time[i])
        printf "| %s | %s%s | %s | %.1f %% | %.0f MiB |\n", title, mark[i] == "knee" ? "knee: " : "", "`" name[i] "`",
            at, 100 * error[i], bytes[i] / 1048576
        title = ""
    }
    END {
        for (i = 1; i <= n; ++i) order[i] = i
        for (i = 2; i <= n; ++i) {
            for (k = i; k > 1 && time[order[k - 1]] > time[order[k]]; --k) {
                t = order[k]; order[k] = order[k - 1]; order[k - 1] = t
            }
        }
        last = 1e30
        for (i = 1; i <= n; ++i) {
            k = order[i]
            if (i == n || mark[k] == "knee" || error[k] < 0.75 * last) { say(k); last = error[k] }
        }
    }' "$to/$1.csv"
}

table() {
    echo "| scene | setting | time | trim | memory |"
    echo "|---|---|---|---|---|"
    [ ! -s "$to/cornell.csv" ] || rows cornell "Cornell box, 256x256"
    [ ! -s "$to/corridor.csv" ] || rows corridor "two rooms, 256x256"
    [ ! -s "$to/sponza.csv" ] || rows sponza "Sponza atrium, 320x240"
}

# Replaces the text between README's marks by the table.
put_table() {
    table >"$to/front.md"
    awk -v table="$to/front.md" '
    /^<!-- front: / { print; while ((getline line < table) > 0) print line; inside = 1; next }
    /^<!-- end of front -->/ { inside = 0 }
    !inside' tests/results/README.md >"$to/README.md"
    if grep -q '^<!-- front: ' tests/results/README.md && [ -s "$to/README.md" ]; then
        cp "$to/README.md" tests/results/README.md
        cp "$to/cornell.svg" tests/results/front.svg
        pass
    else
        fail "tests/results/README.md has no place for the table"
    fi
}

started=$(date +%s)
if [ ! -f "$truth/compare.py" ]; then
    skip "$truth is not there (LMB_SHARED names its folder)"
    finish
fi
for scene in $scenes; do
    if [ "$scene" = demo ]; then
        sweep demo demo
        continue
    fi
    sweep "$scene" "$truth/$scene/scene.gltf" --truth "$truth/$scene/pt_indirect1.pfm"
done
[ ! -s "$to/cornell.csv" ] || [ $failed -gt 0 ] || put_table
echo "$(($(date +%s) - started)) s in all"
finish
