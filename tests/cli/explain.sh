# explain.sh: checks the surface, occluders and lights that `explain` prints; compares traced light with the picture.
. tests/cli/common.sh

# The demo has a spot and one bounce. The rays do not use the picture's method, so both agree only if both are right.
# agrees FILE PERCENT: traced and drawn bounced light in the report FILE differ by at most PERCENT.
agrees() {
    awk -v most="$2" '
        /before the albedo/ { for (i = 1; i <= 3; ++i) picture[i] = $i }
        /^lights/ { light = 1 }
        /^light of one bounce/ { light = 0 }
        / sky: / { sky = 1 }
        / traced / && light { for (i = 1; i <= 3; ++i) at_once[i] = $(i + 1) }
        /^  0 sun/ { split($0, part, ": "); split(part[2], sun, "[ ,]") }
        / traced / && !light { for (i = 1; i <= 3; ++i) traced[i] = $(i + 1) }
        END {
            for (i = 1; i <= 3; ++i) {
                want = traced[i] + (sky ? at_once[i] - (lit ? sun[i] : 0) : 0)
                if (picture[i] == "" || !(want > 0)) bad = 1
                off = picture[i] - want
                if (off < 0) off = -off
                if (off > most / 100 * want) { print picture[i], want; bad = 1 }
            }
            exit bad
        }' "$1"
}
for pixel in 10,30 50,15 70,50 40,45; do
    status 0 explain demo --size 80x60 --shadow-map 256 --pixel $pixel
    check "demo $pixel: bounced light of the picture equals traced light" agrees out.txt 6
done
check "its surface" holds "triangle 1 of instance 12, material 4" out.txt
check "its light is seen" lacks ', blocked' out.txt

# A floor of 2 x 2 m below a shelf, which keeps the light from the floor's middle.
cat >shelf.obj <<'OBJ'
mtllib shelf.mtl
v -1 0 -1
v -1 0 1
v 1 0 1
v 1 0 -1
v -0.2 0.5 -0.2
v -0.2 0.5 0.2
v 0.2 0.5 0.2
v 0.2 0.5 -0.2
usemtl floor
f 1 2 3 4
usemtl shelf
f 5 6 7 8
OBJ
printf 'newmtl floor\nKd 0.5 0.5 0.5\nnewmtl shelf\nKd 0.2 0.6 0.2\n' >shelf.mtl
above="--eye 0,0.4,1.5 --target 0,0,0 --size 64x64 --light point:0,1,0:0,-1,0:3,3,3"
status 0 explain shelf.obj $above --pixel 32,32
check "the floor" holds 'of instance 0, material "floor"' out.txt
check "is named, and so is the occluder" holds 'blocked 0.5' out.txt
check "by its material" holds 'of instance 1, material "shelf"' out.txt
check "no light comes at once" holds "direct       0 0 0" out.txt
status 0 explain shelf.obj $above --pixel 32,50
check "light beside the shelf" lacks ', blocked' out.txt
# 3 W/sr, the cosine, and the squared distance.
check "is the cosine over the squared distance" awk '
    / position / { d = $2 * $2 + ($3 - 1) * ($3 - 1) + $4 * $4; want = 3 * (1 - $3) / (d * sqrt(d)) }
    /^  0 point/ { n = split($0, part, " "); got = part[n]; ok = got > 0.998 * want && got < 1.002 * want }
    END { exit !ok }' out.txt
status 0 explain shelf.obj $above --pixel 0,0
check "a pixel without a surface" holds "none: the pixel shows the background" out.txt

# Lights in a tree are traced as those with maps: the same lines and the same sums.
lamps="--light point:0.2,2,0.5:0,-1,0:3,3,3 --light point:-0.4,1.5,0.2:0,-1,0:2,1,1"
status 0 explain shelf.obj --eye 0,0.4,1.5 --target 0,0,0 --size 64x64 $lamps --pixel 32,50
sed -n '/^lights/,$p' out.txt >maps.txt
status 0 explain shelf.obj --eye 0,0.4,1.5 --target 0,0,0 --size 64x64 $lamps --many-lights 16 --pixel 32,50
sed -n '/^lights/,$p' out.txt >tree.txt
check "two lights are listed" test "$(grep -c '^  [01] point' tree.txt)" = 2
check "lights in a tree are traced" cmp maps.txt tree.txt

# A sky adds a line of its own.
status 0 explain shelf.obj --eye 0,0.4,1.5 --target 0,0,0 --size 64x64 --world sky --quality best --pixel 32,50
check "a sky's light" holds "sky: " out.txt

# Names with control characters reach no terminal.
cat >named.gltf <<'GLTF'
{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"name":"a\u001b[31mred"}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],"materials":[{"name":"stone","doubleSided":true}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,0,1]}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAAAAAIA/"}]}
GLTF
status 0 explain named.gltf --size 32x32 --eye 0.3,1,0.3 --target 0.3,0,0.29 --light point:0.3,1,0.3:0,-1,0:1,1,1 --pixel 16,16
check "names of nodes and materials" holds 'material "stone"' out.txt
check "without control characters" sh -c '! grep -q "$(printf "\\033")" out.txt'

# A screen with a hole, below a roof; the floor emits light by a map. Texel 0 is a hole, both are grey, code 128.
cat >holes.gltf <<'GLTF'
{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1,2]}],
"nodes":[{"mesh":0},{"mesh":1,"translation":[0,0.5,0]},{"mesh":2,"translation":[0,0.8,0],"scale":[0.3,1,0.3]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2,"material":0}]},
{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2,"material":1}]},
{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2,"material":2}]}],
"materials":[{"name":"floor","emissiveFactor":[1,1,1],"emissiveTexture":{"index":0}},
{"name":"screen","alphaMode":"MASK","doubleSided":true,"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}},
{"name":"roof","doubleSided":true}],
"textures":[{"source":0,"sampler":0}],"samplers":[{"magFilter":9728,"minFilter":9728,"wrapS":33071,"wrapT":33071}],
"images":[{"uri":"data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAYAAAD0In+KAAAAD0lEQVR42mNoaGhgAOL/ABAIBAAiyhyNAAAAAElFTkSuQmCC"}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[-1,0,-1],"max":[1,0,1]},
{"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"},{"bufferView":2,"componentType":5123,"count":6,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":32},
{"buffer":0,"byteOffset":80,"byteLength":12}],
"buffers":[{"byteLength":92,"uri":"data:;base64,AACAvwAAAAAAAIC/AACAvwAAAAAAAIA/AACAPwAAAAAAAIA/AACAPwAAAAAAAIC/AAAAAAAAAAAAAAAAAACAPwAAgD8AAIA/AACAPwAAAAAAAAEAAgAAAAIAAwA="}]}
GLTF
lamp="--size 32x32 --quality draft --light point:-0.1,1.2,0:0,-1,0:3,3,3"
below="--eye 0,0.25,1.5 --target -0.2,0,0 $lamp --pixel 16,16"
status 0 explain holes.gltf $below
check "light passes through a hole; the roof blocks it" holds 'of instance 2, material "roof"' out.txt
check "the map's emission" holds "emits        0.2159 0.2159 0.2159" out.txt
check "is emitted light in the picture, and no direct light" holds "direct       0 0 0" out.txt
check "of its own" holds "emitted      0.2159 0.2159 0.2159" out.txt

# bounce FILE: the light of one bounce that rays find, red.
bounce() { awk '/^light of one/ { bounce = 1 } / traced / && bounce { print $2 }' "$1"; }
under="--eye 0.5,0.2,0.6 --target 0.6,0.5,0 $lamp --pixel 16,16" # the screen, lit by the floor below
status 0 explain holes.gltf $under
check "a screen" holds 'material "screen"' out.txt
bounce out.txt >loaded
check "the floor sends at most pi times what it emits by the map" awk '{ exit !($1 > 0.1 && $1 < 0.68) }' loaded
status 0 pack holes.gltf -o holes.lmp --textures palette4
status 0 explain holes.lmp $under
check "a palette has the colours of the image" awk -v loaded="$(cat loaded)" -v packed="$(bounce out.txt)" \
    'BEGIN { exit !(loaded > 0 && packed > 0.97 * loaded && packed < 1.03 * loaded) }'

sed 's/"name":"stone"/&,"extensions":{"KHR_materials_unlit":{}}/' named.gltf >unlit.gltf
status 0 explain unlit.gltf --size 32x32 --eye 0.3,1,0.3 --target 0.3,0,0.29 --light point:0.3,1,0.3:0,-1,0:1,1,1 --pixel 16,16
check "an unlit surface" holds "unlit: the picture shows the albedo" out.txt

# From far away, positions are less exact than from near; no triangle blocks its own light.
status 0 explain shelf.obj --eye 0,3000,3000 --target 0,0,0.8 --fov 0.01 --size 64x64 --light sun:0,0,0:0.3,-1,0.2:3,3,3 --pixel 32,32
check "a floor 4 km away" holds 'material "floor"' out.txt
check "does not block its sun" lacks ', blocked' out.txt
status 2 explain demo --pixel 4294967296,0
status 2 explain demo --pixel 1,1 -v
said "-v: explain prints all it has"
status 2 explain demo --pixel 1,1 --stats stats.json
said "--stats: explain writes no file"

status 2 explain demo
said "no pixel given; add --pixel X,Y"
status 2 explain demo --pixel 1
said "--pixel: \`1\` is not two numbers from 0"
status 2 explain demo --pixel -1,2
status 2 explain demo --size 32x24 --pixel 32,0
said "--pixel 32,0: the picture has 32 x 24 pixels"
status 1 explain nowhere.obj --pixel 0,0
finish
