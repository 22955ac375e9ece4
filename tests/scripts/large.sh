# large.sh: draws ten million triangles from a file; prints time and memory, with no limit except for the sum. One sun
# whose bounced light nothing blocks, because the check is about the scaling of loading and drawing, in seconds.
. tests/scripts/checks.sh

squares=2237 triangles=10008338
folder=$B/large
mkdir -p "$folder"
trap 'rm -f "$folder"/grid.ply' EXIT
check "the generator compiles" $CC $FLAGS -o "$folder/grid" tests/large/main_grid.c
check "the generator runs" sh -c '"$1" "$2" >"$3"' sh "$folder/grid" "$squares" "$folder/grid.ply"
check "the scene is drawn" "$TOOL" render "$folder/grid.ply" -o "$folder/grid.png" --size 320x240 --shadow-map 512 \
    --quality draft --world none --occlusion none --stats "$folder/grid.json"

figure() { sed -n "s/.*\"$1\": \([0-9.]*\).*/\1/p" "$folder/grid.json"; }

check "all of it was loaded" [ "$(figure scene_triangles)" = "$triangles" ]
check "all of it was drawn, by the light and the camera" [ "$(figure triangles_read)" = $((2 * triangles)) ]
check "nothing was dropped" [ "$(figure triangles_dropped)" = 0 ]
check "in memory at most 20 bytes a triangle" [ "$(figure model_bytes)" -le $((20 * triangles)) ]
check "while loading at most 60" [ "$(figure loading_bytes)" -le $((60 * triangles)) ]
echo "$triangles triangles: $(figure total) s, $(figure load) s of it loading; bytes: $(figure model_bytes) model," \
    "$(figure loading_bytes) while loading, $(figure bytes) beside it"
finish
