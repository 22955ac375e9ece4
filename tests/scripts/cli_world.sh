# cli_world.sh: what lies around a scene: sky, pictures of the world, ground, background. A part of cli.sh, whose functions
# and files it uses.

w=$dir/world
mkdir -p "$w"
look="--size 48x36 --eye 1.5,2,3 --target 0,0.5,0 --shadow-map 256 --quality draft"
printf '%s\n' 'v -0.5 0 0.5' 'v 0.5 0 0.5' 'v 0.5 1 0.5' 'v -0.5 1 0.5' 'v -0.5 0 -0.5' 'v 0.5 0 -0.5' 'v 0.5 1 -0.5' \
    'v -0.5 1 -0.5' 'f 1 2 3 4' 'f 6 5 8 7' 'f 5 1 4 8' 'f 2 6 7 3' 'f 4 3 7 8' 'f 5 6 2 1' >"$w/box.obj"

# lit PICTURE: how many bytes of a PNG's three channels, or of floats, are not 0.
lit() { tail -c "$2" "$1" | tr -d '\000' | wc -c; }
floats=$((48 * 36 * 12))

# --- by default ---

status 0 render "$w/box.obj" $look -o "$w/sky.pfm"
check "a box stands on a ground under a sky" grep -q "a clear sky and a ground below" "$dir/err.txt"
check "nothing of the picture is black" test "$(lit "$w/sky.pfm" $floats)" -gt $((floats * 6 / 10))
status 0 render "$w/box.obj" $look --world none -o "$w/none.pfm"
check "without a world there is a sun" grep -q "a sun of 3 W/m2" "$dir/err.txt"
check "and black around" test "$(lit "$w/none.pfm" $floats)" -lt $((floats / 2))
status 0 render "$w/box.obj" $look --ground none -o "$w/floats.pfm"
check "no ground where none is wanted" grep -q "a clear sky; " "$dir/err.txt"
status 0 render "$w/box.obj" $look --threads 1 --backend scalar -o "$w/again.pfm"
check "the same bytes by one thread and plain C" cmp "$w/sky.pfm" "$w/again.pfm"
status 0 render demo $few -o "$w/demo.pfm"
check "a scene with lights has no sky" sh -c '! grep -q sky "$1"' sh "$dir/err.txt"

# Lamps that are switched off are no light.
printf '%s' '{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],"nodes":[{"mesh":0},
 {"extensions":{"KHR_lights_punctual":{"light":0}},"translation":[0,3,0]}],
 "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
 "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
 "bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,
 "uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
 "extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","intensity":0}]}}}' >"$w/off.gltf"
status 0 render "$w/off.gltf" --size 32x24 --quality draft -o "$w/off.png"
check "a sky where lamps are off" grep -q "a clear sky and a ground below" "$dir/err.txt"
status 0 render "$w/off.gltf" --size 32x24 --quality draft --world none -o "$w/off.png"
sed 's/"intensity":0/"intensity":1/' "$w/off.gltf" >"$w/on.gltf"
status 0 render "$w/on.gltf" --size 32x24 --quality draft -o "$w/off.png"
check "none where one is on" sh -c '! grep -q sky "$1"' sh "$dir/err.txt"

# A floor of its own, seen from above, is ground enough.
{ cat "$w/box.obj"; printf '%s\n' 'v -3 0 3' 'v 3 0 3' 'v 3 0 -3' 'v -3 0 -3' 'f 9 10 11 12'; } >"$w/floor.obj"
status 0 render "$w/floor.obj" $look -o "$w/floor.pfm"
check "no second floor" grep -q "a clear sky; " "$dir/err.txt"

# A mountain of 20 km stands on a ground, too; one of 200 km does not, as its ground's rim would lie over 2^20 m away.
for size in 20000 200000; do
    awk -v size=$size '/^v/ { print "v", size * $2, size * $3, size * $4; next } { print }' "$w/box.obj" >"$w/$size.obj"
    status 0 render "$w/$size.obj" --size 32x24 --quality draft -o "$w/mountain.png"
    case $size in
    20000) check "a ground below 20 km" grep -q "a clear sky and a ground below" "$dir/err.txt" ;;
    *) check "none below 200 km" grep -q "a clear sky; " "$dir/err.txt" ;;
    esac
done

sed 's/^v \([^ ]*\)/v 2\1e6/; s/^v 2-/v -2/' "$w/box.obj" >"$w/away.obj"
status 1 render "$w/away.obj" $few -o "$w/bad.png"
said "each triangle has a corner that is not finite or 2^20 m away"

# --- pictures of the world ---

# 32 x 16 pixels: red above, black below.
{ printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16 +X 32\n'
  i=0; while [ $i -lt 512 ]; do [ $i -lt 256 ] && printf '\200\000\000\201' || printf '\000\000\000\000'; i=$((i + 1)); done
} >"$w/red.hdr"
status 0 render "$w/box.obj" $look --world "$w/red.hdr" -o "$w/red.pfm"
check "red light alone" sh -c 'tail -c "$2" "$1" | od -An -v -tf4 | tr -s " " "\n" | grep . | awk "NR % 3 == 1 { r += \$1 } NR % 3 != 1 { o += \$1 } END { exit !(r > 100 && o < 1e-3) }"' sh "$w/red.pfm" $floats
# The same size of PFM, 1 but for one number that is infinite, which counts as black.
one_bright() { { printf 'PF\n32 16\n-1.0\n'; i=0; while [ $i -lt 1536 ]; do [ $i -eq 700 ] && printf "$1" || printf '\000\000\200\077'; i=$((i + 1)); done; } >"$2"; }
one_bright '\000\000\200\177' "$w/infinite.pfm"
one_bright '\000\000\000\000' "$w/black.pfm"
status 0 render "$w/box.obj" $look --world "$w/infinite.pfm" -o "$w/infinite-lit.pfm"
said "infinite.pfm: numbers that are infinite or none, and count as black: 1"
for world in infinite:black black:infinite; do
    status 0 relight --world "$w/${world%:*}.pfm" --ground "$w/${world#*:}.pfm" --cube "$w/cube.pfm"
    check "what is infinite is told by its own file: $world" sh -c 'test "$(grep -c "infinite.pfm: numbers that are" "$1")" = 1 && ! grep -q "black.pfm: numbers" "$1"' sh "$dir/err.txt"
done
status 0 render "$w/box.obj" $look --world "$w/black.pfm" -o "$w/black-lit.pfm"
check "an infinite texel is black" cmp "$w/infinite-lit.pfm" "$w/black-lit.pfm"
status 1 render "$w/box.obj" $look --world "$w/box.obj" -o "$w/bad.pfm"
status 1 render "$w/box.obj" $look --world "$w/missing.hdr" -o "$w/bad.pfm"
absent "$w/bad.pfm"
status 2 render demo $few --world sky --grouping zones -o "$w/bad.pfm"
status 0 render demo $few --world sky -o "$w/both.pfm"
check "a sky besides a scene's lights" sh -c '! cmp -s "$1" "$2"' sh "$w/both.pfm" "$w/demo.pfm"

# --- background ---

status 0 render "$w/box.obj" $look --background transparent -o "$w/cut.png"
check "eight bits of RGBA" test "$(od -An -tu1 -j24 -N2 "$w/cut.png" | tr -s ' ')" = " 8 6"
status 0 render "$w/box.obj" $look --background '#ff8800' -o "$w/colour.ppm"
check "the colour itself in the corner" test "$(tail -c 3 "$w/colour.ppm" | od -An -tu1 | tr -s ' ')" = " 255 136 0"
status 0 render "$w/box.obj" $look --background ff8800 --samples 1 -o "$w/colour.png"
status 2 render "$w/box.obj" $look --background transparent -o "$w/bad.ppm"
status 2 render "$w/box.obj" $look --background ff8800 -o "$w/bad.pfm"
status 2 render "$w/box.obj" $look --background ff88 -o "$w/bad.png"
status 2 render "$w/box.obj" $look --background ff880g -o "$w/bad.png"
status 2 render "$w/box.obj" $look --background ff8800 --show depth -o "$w/bad.png"

# A sky behind it does not change how an object is exposed.
status 0 render "$w/box.obj" $look --ground none -o "$w/a.png"
ev=$(grep exposure "$dir/err.txt")
status 0 render "$w/box.obj" $look --background 000000 -o "$w/b.png"
check "exposed by the surfaces: $ev" test -n "$ev" -a "$ev" = "$(grep exposure "$dir/err.txt")"

# What is lifted by more than eight stops is as good as black: the line names the likely cause, and the picture stays.
sealed="$w/box.obj --size 48x36 --quality draft --eye 0,0.5,0.3 --target 0,0.5,-1 --light"
status 0 render $sealed point:0,0.5,0:0,-1,0:1e-6,1e-6,1e-6 -o "$w/dim.png"
check "of a dim picture the cause is named" grep -q 'EV (auto): hardly any light' "$dir/err.txt"
status 0 render $sealed point:0,0.5,0:0,-1,0:1,1,1 -o "$w/dim.png"
check "not of another" grep -q 'EV (auto)$' "$dir/err.txt"

# --- what was baked ---

status 0 bake "$w/floor.obj" --elements 256 --receivers 200 -o "$w/floor.lmt"
status 0 render "$w/floor.obj" $look --transfer "$w/floor.lmt" -o "$w/baked.pfm"
check "baked light of a sky" sh -c 'build=$1; shift; "$build" compare "$1" "$2" 2>/dev/null | grep -o "trim [0-9.]*" | awk "{ exit !(\$2 < 0.1) }"' sh "$TOOL" "$w/baked.pfm" "$w/floor.pfm"

# --- tone ---

status 0 render "$w/box.obj" $look --exposure 2 -o "$w/filmic.ppm"
status 0 render "$w/box.obj" $look --exposure 2 --tone linear -o "$w/linear.ppm"
check "a curve by default" sh -c '! cmp -s "$1" "$2"' sh "$w/filmic.ppm" "$w/linear.ppm"
white() { tail -c 5184 "$1" | tr -cd '\377' | wc -c; }
check "it keeps light over white apart" test "$(white "$w/linear.ppm")" -gt 1000 -a "$(white "$w/filmic.ppm")" -lt 100
status 0 render "$w/box.obj" $look --exposure 2 --tone linear -o "$w/again.pfm"
check "linear formats have none" cmp "$w/sky.pfm" "$w/again.pfm"
status 2 render "$w/box.obj" $look --tone soft -o "$w/bad.png"
status 0 relight --world demo --object demo --size 32x24 --tone linear -o "$w/relit.png"
