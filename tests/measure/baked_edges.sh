# baked_edges.sh: compares baked with gathered light on stairs, shelves and in attics, each turned at
# random: one row a scene.
#
# Both use defaults and one bounce; the reference is `--quality best`. TUNED, HELD_OUT: scenes of tests/scenes; no
# constant is chosen on the latter. FRAME: pixels (default 64x64). A row passes if baked light's trim is within 1.5 x
# that of gathered light and its leak is at most 2. `compare.py` of the shared folder defines both: leak is mean light
# over mean truth at pixels whose truth is under 1 % of its mean; `-` if fewer than 21 pixels are so dark.
. tests/measure/draw.sh

compare=$truth/compare.py
place=$work/edges
size=${FRAME:-64x64}
mkdir -p "$place"

# figures PICTURE: prints `trim leak`.
figures() {
    python3 "$compare" "$1" "$place/best.pfm" |
        awk '{ for (i = 1; i < NF; ++i) v[$i] = $(i + 1); print v["trim"], v["leak"] == "" ? "-" : v["leak"] }'
}

# look OUT [OPTION...]
look() {
    out=$1
    shift
    "$TOOL" render "$place/scene.gltf" -o "$place/$out.pfm" --size "$size" --show indirect --bounces 1 -q "$@"
}

# row SET SCENE TURN
row() {
    "$B/scenes" "$2" --rotate "$3" -o "$place" && look best --quality best && look gathered &&
        said=$("$TOOL" bake "$place/scene.gltf" -o "$place/baked.lmt") && look baked --transfer "$place/baked.lmt" ||
        { fail "$2: not drawn"; return; }
    set -- "$1" "$2" $(figures "$place/gathered.pfm") $(figures "$place/baked.pfm") "${said##*, }"
    echo "| $2 | $1 | $3 | $5 | $(awk "BEGIN { printf \"%.1f\", $5 / $3 }") | $4 | $6 | $7 |"
    awk "BEGIN { exit !($5 <= 1.5 * $3 && (\"$6\" == \"-\" || $6 + 0 <= 2)) }" && pass || fail "$2"
}

echo "| scene | set | gathered: trim | baked: trim | x | gathered: leak | baked: leak | file |"
echo "|---|---|---|---|---|---|---|---|"
turn=0
for scene in ${TUNED-stair_hall:1 attic:1 attic:2 small_shelf:1 small_shelf:2}; do
    row tuned "$scene" $((turn += 1))
done
for scene in ${HELD_OUT-stair_hall:101 small_stairs:101 attic:101 small_shelf:101 small_shelf:102}; do
    row held-out "$scene" $((turn += 1))
done
finish
