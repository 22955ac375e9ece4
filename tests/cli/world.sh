# world.sh: the surroundings of a scene: sky, pictures of the world, ground, background, tone.
. tests/cli/common.sh

look="--size 48x36 --eye 1.5,2,3 --target 0,0.5,0 --shadow-map 256 --quality draft"
printf '%s\n' 'v -0.5 0 0.5' 'v 0.5 0 0.5' 'v 0.5 1 0.5' 'v -0.5 1 0.5' 'v -0.5 0 -0.5' 'v 0.5 0 -0.5' 'v 0.5 1 -0.5' \
    'v -0.5 1 -0.5' 'f 1 2 3 4' 'f 6 5 8 7' 'f 5 1 4 8' 'f 2 6 7 3' 'f 4 3 7 8' 'f 5 6 2 1' >box.obj

# lit PICTURE: counts the non-zero bytes of a PNG's three channels, or of floats.
lit() { tail -c "$2" "$1" | tr -d '\000' | wc -c; }
floats=$((48 * 36 * 12))

# --- by default ---

status 0 render box.obj $look -o sky.pfm
check "a box stands on a ground under a sky" holds "a clear sky and a ground below" err.txt
check "nothing of the picture is black" test "$(lit sky.pfm $floats)" -gt $((floats * 6 / 10))
status 0 render box.obj $look --world none -o none.pfm
check "without a world there is a sun" holds "a sun of 3 W/m2" err.txt
check "and black around" test "$(lit none.pfm $floats)" -lt $((floats / 2))
status 0 render box.obj $look --ground none -o floats.pfm
check "no ground where none is wanted" holds "a clear sky; " err.txt
status 0 render box.obj $look --threads 1 --backend scalar -o again.pfm
check "the same bytes by one thread and plain C" cmp sky.pfm again.pfm
# 256 x 256 pixels are lit at single points, except by the best quality, with equal bytes on any backend.
large="--size 256x256 --eye 1.5,2,3 --target 0,0.5,0 --shadow-map 256"
status 0 render box.obj $large --quality draft -o draft.pfm
status 0 render box.obj $large --quality draft --gather live --threads 1 --backend scalar -o live.pfm
check "a draft under a sky is live light" cmp draft.pfm live.pfm
status 0 render box.obj $large --quality draft --gather full -o full.pfm
status 0 compare live.pfm full.pfm --max trim=0.04,rmse=0.06,lo=0.98,hi=1.02
status 0 render box.obj $large -o default.pfm
status 0 render box.obj $large --gather live -o live.pfm
check "the default quality is live light, too" cmp default.pfm live.pfm
# Mostly sky, because cuts at each pixel of the ground take long.
large="--size 256x256 --eye 1.5,2,3 --target 0,2.3,0 --shadow-map 256"
status 0 render box.obj $large --quality draft -o draft.pfm
status 0 render box.obj $large --quality draft --error 0.02 -o error.pfm
check "cuts, if an error limit is given" differ draft.pfm error.pfm
status 0 render box.obj $large --quality best -o best.pfm
status 0 render box.obj $large --quality best --gather full -o full.pfm
check "the best quality gathers each pixel" cmp best.pfm full.pfm
check "and does not draw live light" differ best.pfm draft.pfm
status 0 render demo $few -o demo.pfm
check "a scene with lights has no sky" lacks sky err.txt

# Lamps that are switched off do not count as light.
printf '%s' '{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],"nodes":[{"mesh":0},
 {"extensions":{"KHR_lights_punctual":{"light":0}},"translation":[0,3,0]}],
 "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
 "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
 "bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,
 "uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
 "extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","intensity":0}]}}}' >off.gltf
status 0 render off.gltf --size 32x24 --quality draft -o off.png
check "a sky where lamps are off" holds "a clear sky and a ground below" err.txt
status 0 render off.gltf --size 32x24 --quality draft --world none -o off.png
sed 's/"intensity":0/"intensity":1/' off.gltf >on.gltf
status 0 render on.gltf --size 32x24 --quality draft -o off.png
check "none where one is on" lacks sky err.txt

# A scene with a floor, seen from above, gets no second ground.
{ cat box.obj; printf '%s\n' 'v -3 0 3' 'v 3 0 3' 'v 3 0 -3' 'v -3 0 -3' 'f 9 10 11 12'; } >floor.obj
status 0 render floor.obj $look -o floor.pfm
check "no second floor" holds "a clear sky; " err.txt

# A box 400 m above the origin has a ground: there a float has steps of 0.03 mm, and the ground lies 0.06 mm lower.
awk '/^v/ { print "v", $2, $3 + 400, $4; next } { print }' box.obj >high.obj
status 0 render high.obj --size 32x24 --quality draft -o high.png
check "a ground below a box at 400 m" holds "a clear sky and a ground below" err.txt

# A mountain of 20 km also gets a ground. One of 200 km gets none, because the rim of the ground
# would lie over 2^20 m away.
for size in 20000 200000; do
    awk -v size=$size '/^v/ { print "v", size * $2, size * $3, size * $4; next } { print }' box.obj >"$size.obj"
    status 0 render "$size.obj" --size 32x24 --quality draft -o mountain.png
    case $size in
    20000) check "a ground below 20 km" holds "a clear sky and a ground below" err.txt ;;
    *) check "none below 200 km" holds "a clear sky; " err.txt ;;
    esac
done

sed 's/^v \([^ ]*\)/v 2\1e6/; s/^v 2-/v -2/' box.obj >away.obj
status 1 render away.obj $few -o bad.png
said "each triangle has a corner that is not finite or 2^20 m away"

# --- pictures of the world ---

# 32 x 16 pixels: red above, black below.
{ printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16 +X 32\n'
  repeated 256 '\200\000\000\201'; repeated 256 '\000\000\000\000'
} >red.hdr
status 0 render box.obj $look --world red.hdr -o red.pfm
check "red light alone" sh -c 'tail -c "$2" "$1" | od -An -v -tf4 | tr -s " " "\n" | grep . | awk "NR % 3 == 1 { r += \$1 } NR % 3 != 1 { o += \$1 } END { exit !(r > 100 && o < 1e-3) }"' sh red.pfm $floats
# A PFM of the same size with value 1, except for one infinite number, which counts as black.
one_bright() { { printf 'PF\n32 16\n-1.0\n'; repeated 700 "$one"; printf "$1"; repeated 835 "$one"; } >"$2"; }
one_bright '\000\000\200\177' infinite.pfm
one_bright '\000\000\000\000' black.pfm
status 0 render box.obj $look --world infinite.pfm -o infinite-lit.pfm
said "infinite.pfm: numbers that are infinite or none, and count as black: 1"
for world in infinite:black black:infinite; do
    status 0 relight --world "${world%:*}.pfm" --ground "${world#*:}.pfm" --cube cube.pfm
    check "what is infinite is told by its own file: $world" sh -c 'test "$(grep -c "infinite.pfm: numbers that are" "$1")" = 1 && ! grep -q "black.pfm: numbers" "$1"' sh err.txt
done
status 0 render box.obj $look --world black.pfm -o black-lit.pfm
check "an infinite texel is black" cmp infinite-lit.pfm black-lit.pfm
status 1 render box.obj $look --world box.obj -o bad.pfm
status 1 render box.obj $look --world missing.hdr -o bad.pfm
absent bad.pfm
status 2 render demo $few --world sky --group method=zones -o bad.pfm
status 0 render demo $few --world sky -o both.pfm
check "a sky besides a scene's lights" differ both.pfm demo.pfm

# --- background ---

status 0 render box.obj $look --background transparent -o cut.png
check "eight bits of RGBA" test "$(od -An -tu1 -j24 -N2 cut.png | tr -s ' ')" = " 8 6"
status 0 render box.obj $look --background '#ff8800' -o colour.ppm
check "the colour itself in the corner" test "$(tail -c 3 colour.ppm | od -An -tu1 | tr -s ' ')" = " 255 136 0"
status 0 render box.obj $look --background ff8800 --samples 1 -o colour.png
status 2 render box.obj $look --background transparent -o bad.ppm
status 2 render box.obj $look --background ff8800 -o bad.pfm
status 2 render box.obj $look --background ff88 -o bad.png
status 2 render box.obj $look --background ff880g -o bad.png
status 2 render box.obj $look --background ff8800 --show depth -o bad.png

# A sky in the background does not change the exposure of an object.
status 0 render box.obj $look --ground none -o a.png
ev=$(grep exposure err.txt)
status 0 render box.obj $look --background 000000 -o b.png
check "exposed by the surfaces: $ev" test -n "$ev" -a "$ev" = "$(grep exposure err.txt)"

# A picture that needs more than eight stops is practically black: a line names the likely cause,
# and the picture is written.
sealed="box.obj --size 48x36 --quality draft --eye 0,0.5,0.3 --target 0,0.5,-1 --light"
status 0 render $sealed point:0,0.5,0:0,-1,0:1e-6,1e-6,1e-6 -o dim.png
check "of a dim picture the cause is named" holds 'EV (auto): hardly any light' err.txt
status 0 render $sealed point:0,0.5,0:0,-1,0:1,1,1 -o dim.png
check "not of another" grep -q 'EV (auto)$' err.txt

# --- baked light ---

status 0 bake floor.obj --elements 256 --receivers 200 -o floor.lmt
status 0 render floor.obj $look --transfer floor.lmt -o baked.pfm
check "baked light of a sky" sh -c 'build=$1; shift; "$build" compare "$1" "$2" 2>/dev/null | grep -o "trim [0-9.]*" | awk "{ exit !(\$2 < 0.1) }"' sh "$TOOL" baked.pfm floor.pfm

# --- tone ---

status 0 render box.obj $look --exposure 2 -o filmic.ppm
status 0 render box.obj $look --exposure 2 --tone linear -o linear.ppm
check "a curve by default" differ filmic.ppm linear.ppm
white() { tail -c 5184 "$1" | tr -cd '\377' | wc -c; }
check "it keeps light over white apart" test "$(white linear.ppm)" -gt 1000 -a "$(white filmic.ppm)" -lt 100
status 0 render box.obj $look --exposure 2 --tone linear -o again.pfm
check "linear formats have none" cmp sky.pfm again.pfm
status 2 render box.obj $look --tone soft -o bad.png
status 0 relight --world demo --object demo --size 32x24 --tone linear -o relit.png

finish
