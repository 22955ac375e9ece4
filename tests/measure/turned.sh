# turned.sh: compares work and error of scenes turned at random, with camera and lights, with
# those of the upright scenes.
#
# SHARED_SCENES: scenes of the shared folder, ten turns each. LMB_OWN_TRUTH: the folder filled by tests/scenes/truth.sh.
# OWN_SCENES: scenes in it, three turns each. QUALITIES, TURNS (default: all scenes, quality default, turns as above). A
# turn passes if pairs and segments are within 1.3 x, and trim within 1.1 x or within 0.003; `close` counts the latter.
. tests/measure/draw.sh

compare=$truth/compare.py
shared=$truth
truth=$work/turned
rows=$work/turned.rows

# turn_gltf FOLDER SEED: writes its scene.gltf to $truth/one with all nodes below a new node that turns about an axis
# and by an angle drawn uniformly from all rotations.
turn_gltf() {
    cp "$1/scene.bin" "$truth/one" && python3 - "$1/scene.gltf" "$truth/one/scene.gltf" "$2" <<'PYTHON'
import json, random, sys
draw = random.Random(int(sys.argv[3]))
q = [draw.gauss(0, 1) for _ in range(4)]
length = sum(x * x for x in q) ** 0.5
with open(sys.argv[1]) as f:
    file = json.load(f)
for scene in file['scenes']:
    file['nodes'].append({'name': 'turned', 'rotation': [x / length for x in q], 'children': scene['nodes']})
    scene['nodes'] = [len(file['nodes']) - 1]
with open(sys.argv[2], 'w') as f:
    json.dump(file, f)
PYTHON
}

# place FOLDER NAME [TURN]: puts the scene, turned or not, into $truth/one.
place() {
    if [ "$1" != "$shared" ]; then
        "$B/scenes" "$2" ${3:+--rotate "$3"} -o "$truth/one"
    elif [ -n "$3" ]; then
        turn_gltf "$1/$2" "$3"
    else
        cp "$1/$2/scene.bin" "$1/$2/scene.gltf" "$truth/one"
    fi
}

# figures_of FOLDER NAME QUALITY [TURN]: prints `trim pairs segments` of one picture.
figures_of() {
    place "$1" "$2" "$4" &&
        draw one "$3" 1 "$(dd if="$1/$2/pt_indirect1.pfm" bs=32 count=1 2>/dev/null | sed -n '2s/ /x/p')" indirect ||
        return
    python3 "$compare" "$work/drawn.pfm" "$1/$2/pt_indirect1.pfm" --mask "$1/$2/gbuffer_depth.pfm" |
        awk -v work="$(figure pairs) $(figure segments)" '{ print $2, work }'
}

# turns FOLDER NAME QUALITY TURN...
turns() {
    folder=$1 name=$2 quality=$3
    shift 3
    upright=$(figures_of "$folder" "$name" "$quality")
    for turn in "$@"; do
        row=$(echo "$upright $(figures_of "$folder" "$name" "$quality" "$turn")" | awk 'NF == 6 {
            trim = $4 / $1; close_by = trim > 1.1 && $4 - $1 < 0.003
            bad = (trim > 1.1 && !close_by) || $5 / $2 > 1.3 || $6 / $3 > 1.3
            printf "%.4f %.4f %.3f %.3f %.3f %s\n", $1, $4, trim, $5 / $2, $6 / $3,
                bad ? "missed" : close_by ? "close" : "kept" }')
        echo "$name $quality $turn $row" | tee -a "$rows" | sed 's/ / | /g; s/.*/| & |/'
        case $row in
        *kept | *close) pass ;;
        *) fail "$name, $quality, turned by $turn: ${row:-$(head -n 1 "$work/said")}" ;;
        esac
    done
}

# Prints the worst and the mean of each scene's ratios.
sums() {
    awk '
        NF == 9 {
            k = $1 " | " $2
            if (!(k in n)) order[++scenes] = k
            n[k]++; upright[k] = $4
            for (c = 6; c <= 8; ++c) { sum[k, c] += $c; if ($c > most[k, c]) most[k, c] = $c }
            close_by[k] += $9 == "close"; missed[k] += $9 == "missed"
        }
        END {
            for (s = 1; s <= scenes; ++s) {
                k = order[s]
                printf "| %s | %d | %s", k, n[k], upright[k]
                for (c = 6; c <= 8; ++c) printf " | %.2f, %.2f", most[k, c], sum[k, c] / n[k]
                printf " | %d | %d |\n", close_by[k], missed[k]
            }
        }' "$rows"
}

command -v python3 >/dev/null || { skip "no python3 for $compare"; finish; }
mkdir -p "$truth/one"
: >"$rows"
echo "| scene | quality | turn | trim upright | trim turned | trim x | pairs x | segments x | |"
echo "|---|---|---|---|---|---|---|---|---|"
for scene in ${SHARED_SCENES-$(truth_scenes rooms)}; do
    for quality in ${QUALITIES:-default}; do
        # shellcheck disable=SC2046 # numbers
        turns "$shared" "$scene" "$quality" ${TURNS:-$(seq $([ "$scene" = sponza ] && echo 3 || echo 10))}
    done
done
if [ -z "$LMB_OWN_TRUTH" ]; then
    skip "LMB_OWN_TRUTH names no folder with truth of our own scenes (tests/scenes/truth.sh fills one)"
    OWN_SCENES=
fi
for scene in ${OWN_SCENES-$("$B/scenes" --list | awk '{ print $1 }')}; do
    if [ -f "$LMB_OWN_TRUTH/$scene/pt_indirect1.pfm" ]; then
        for quality in ${QUALITIES:-default}; do
            # shellcheck disable=SC2086 # numbers
            turns "$LMB_OWN_TRUTH" "$scene" "$quality" ${TURNS:-1 2 3}
        done
    else
        skip "$scene has no truth in $LMB_OWN_TRUTH"
    fi
done
printf '\n| scene | quality | turns | trim upright | trim x worst, mean | pairs x | segments x | close | missed |\n'
echo "|---|---|---|---|---|---|---|---|---|"
sums
finish
