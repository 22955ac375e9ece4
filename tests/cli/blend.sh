# blend.sh: checks --blend sorted: layers in front of each other, crossing panes, light, limits, samples and slices.
. tests/cli/common.sh

# Materials: a black wall, and panes of alpha 0.25, 0.5 and others. The sun is so strong that a white pane facing it has
# the radiance 1. Panes of alpha below 0.5 cast no shadow.
cat >panes.mtl <<'MTL'
newmtl wall
Kd 0 0 0
newmtl quarter
Kd 1 1 1
d 0.25
newmtl tenth
Kd 1 1 1
d 0.1
newmtl red
Kd 1 0 0
d 0.4
newmtl green
Kd 0 1 0
d 0.4
newmtl dark
Kd 0 0 0
d 0.25
newmtl solid
Kd 0.8 0.6 0.4
newmtl glass
Kd 0.8 0.6 0.4
d 0.6
newmtl floor
Kd 0.7 0.3 0.2
MTL

# walls MATERIAL:Z...: squares that fill the picture, at these z, in this order.
walls() {
    printf 'mtllib panes.mtl\n'
    for wall in "$@"; do
        z=${wall#*:}
        printf 'usemtl %s\nv -30 -30 %s\nv 30 -30 %s\nv 30 30 %s\nv -30 30 %s\nf -4 -3 -2 -1\n' "${wall%:*}" "$z" "$z" "$z" "$z"
    done
}
sun="--light sun:0,0,9:0,0,-1:3.14159265,3.14159265,3.14159265 --show direct"
view="--eye 0,0,9 --target 0,0,0 --size 24x20"

# numbers FILE: prints the numbers of a picture of 24 x 20. all FILE LOW HIGH: checks that all lie in this range.
numbers() { tail -c 5760 "$1" | od -An -v -tf4 | tr -s ' ' '\n' | grep .; }
all() { numbers "$1" | awk -v low="$2" -v high="$3" '$1 < low || $1 > high { ++bad } END { exit !(NR == 1440 && bad == 0) }'; }

# Three layers of 0.25 in front of a black wall.
walls wall:0 quarter:1 quarter:2 quarter:3 >three.obj
for samples in 1 4 16; do
    status 0 render three.obj $view $sun --blend sorted --samples $samples -o three.pfm
    check "three layers of 0.25 cover 1 - 0.75^3: --samples $samples" all three.pfm 0.578124 0.578126
done
status 0 render three.obj $view $sun --samples 16 -o pattern.pfm
check "the pattern covers about as much" sh -c 'tail -c 5760 pattern.pfm | od -An -v -tf4 | tr -s " " "\n" |
    awk "/./ { sum += \$1; ++n } END { mean = sum / n; exit !(mean > 0.56 && mean < 0.6) }"'
check "and is not the mixture" differ three.pfm pattern.pfm
status 0 render three.obj $view $sun --blend pattern --samples 16 -o same.pfm
check "--blend pattern is the default" cmp pattern.pfm same.pfm
walls quarter:2 wall:0 quarter:3 quarter:1 >other.obj
status 0 render other.obj $view $sun --blend sorted --samples 16 -o other.pfm
check "the order in the file does not matter" cmp three.pfm other.pfm

# Crossing panes: red is nearer on the left, green on the right. Both face the sun alike.
crossing() { # crossing FIRST_MATERIAL FIRST_SLOPE SECOND_MATERIAL SECOND_SLOPE
    printf 'mtllib panes.mtl\n'
    for pane in "$1 $2" "$3 $4"; do
        printf 'usemtl %s\n' "${pane% *}"
        awk -v s="${pane#* }" 'BEGIN { printf "v -14 -9 %g\nv 14 -9 %g\nv 14 9 %g\nv -14 9 %g\nf -4 -3 -2 -1\n", -14 * s, 14 * s, 14 * s, -14 * s }'
    done
}
crossing red -0.5 green 0.5 >crossing.obj
crossing green 0.5 red -0.5 >crossed.obj
slant="--light sun:0,0,9:0,0,-1:3.51240737,3.51240737,3.51240737 --show direct --world none"
status 0 render crossing.obj $view $slant --blend sorted -o crossing.pfm
status 0 render crossed.obj $view $slant --blend sorted -o crossed.pfm
check "crossing panes do not depend on the order in the file" cmp crossing.pfm crossed.pfm
# The nearer pane shows 0.4 of its light, the farther one 0.4 * 0.6. The crossing lies between columns 11 and 12.
check "crossing panes are right on both sides" sh -c 'tail -c 5760 crossing.pfm | od -An -v -tf4 -w12 | awk "
    { x = (NR - 1) % 24; near = x < 12 ? \$1 : \$2; far = x < 12 ? \$2 : \$1
      ok += near > 0.39999 && near < 0.40001 && far > 0.23999 && far < 0.24001 && \$3 == 0 }
    END { exit !(NR == 480 && ok == 480) }"'
status 0 render crossing.obj $view $slant -o crossing.pfm
check "the pattern mixes them otherwise" differ crossing.pfm crossed.pfm

# At most 32 layers; the farthest are left out.
stack() { # stack COUNT MATERIAL
    walls wall:0 $(awk -v n="$1" -v m="$2" 'BEGIN { while (n-- > 0) printf "%s:%g ", m, 0.1 + n / 20 }')
}
white() { awk -v n="$1" -v e="$2" 'BEGIN { printf "%.9g", 1 - 0.9 ^ n + e }'; }
stack 32 tenth >stack.obj
status 0 render stack.obj $view $sun --blend sorted -o stack.pfm
check "32 layers" all stack.pfm "$(white 32 -1e-6)" "$(white 32 1e-6)"
check "32 layers are not too many" lacks "layers" err.txt
stack 40 tenth >stack.obj
status 0 render stack.obj $view $sun --blend sorted -o stack.pfm
check "40 layers show the nearest 32" all stack.pfm "$(white 32 -1e-6)" "$(white 32 1e-6)"
said "note: --blend sorted: 480 pixels show more than 32 layers; the farthest are left out"
status 0 render stack.obj $view $sun --blend sorted -q -o stack.pfm
check "-q leaves out the note" empty err.txt

# Light: a pane of alpha 0.6 blocks and bounces light as an opaque one does, and shows 0.6 of it, the rest is the
# background: black, since no world is given.
standing() { # standing MATERIAL
    printf 'mtllib panes.mtl\nusemtl floor\nv -3 0 -1\nv -3 0 3\nv 3 0 3\nv 3 0 -1\nf 1 2 3 4\n'
    printf 'usemtl %s\nv -1 0.01 0\nv 1 0.01 0\nv 1 2 0.3\nv -1 2 0.3\nf 5 6 7 8\n' "$1"
}
room="--eye 0,1.2,4 --target 0,1,0 --fov 40 --size 24x20 --world none --light spot:0,3,2.5:0,-0.7,-0.7:60,50,40:10,70"
standing glass >glass.obj
standing solid >solid.obj
share() { # share LOW HIGH: of the light of glass.pfm to that of solid.pfm, in the upper half: no floor behind the pane
    for file in glass solid; do numbers $file.pfm >$file.txt; done
    paste glass.txt solid.txt | awk -v low="$1" -v high="$2" '
        NR > 720 && $2 > 0.01 { ++n; share = $1 / $2; bad += share < low || share > high } END { exit !(n > 200 && bad == 0) }'
}
for how in "--show direct" "--show full" "--show indirect --bounces 2"; do
    for scene in glass solid; do
        status 0 render $scene.obj $room $how --blend sorted -o $scene.pfm
    done
    check "a pane of 0.6 shows 0.6 of its light: $how" share 0.59999 0.60001
done
for how in "--gather live" "--group method=zones" "--many-lights 64"; do # interpolated, or by tile
    for scene in glass solid; do
        status 0 render $scene.obj $room $how --blend sorted -o $scene.pfm
    done
    check "a pane of 0.6 shows about 0.6 of its light: $how" share 0.55 0.65
done

# Pixels that show no layer, threads, backends, eyes and slices.
few="$room --shadow-map 64 --samples 4 --exposure 0"
status 0 render glass.obj $few -o pattern.pfm
status 0 render glass.obj $few --blend sorted -o sorted.pfm
status 0 render glass.obj $few --blend sorted --threads 3 -o threads.pfm
check "several threads have the same bytes" cmp sorted.pfm threads.pfm
status 0 render glass.obj $few --blend sorted --backend scalar -o scalar.pfm
check "plain C has the same bytes" cmp sorted.pfm scalar.pfm
for file in pattern sorted; do tail -c 5760 $file.pfm | od -An -v -tx4 -w12 >$file.txt; done
head -n 72 pattern.txt >floor.txt # the lowest three rows
head -n 72 sorted.txt >floor-sorted.txt
check "the floor is lit" lacks 00000000 floor.txt
check "pixels without a layer keep their bytes" cmp floor.txt floor-sorted.txt
check "pixels with a layer do not" differ pattern.txt sorted.txt
status 0 render solid.obj $few -o pattern.pfm
status 0 render solid.obj $few --blend sorted -o sorted.pfm
check "a scene without BLEND keeps all bytes" cmp pattern.pfm sorted.pfm
status 0 render glass.obj $few --stereo 0.2 --blend sorted -o both.ppm
for i in 1 2; do
    status 0 render glass.obj $few --stereo 0.2 --blend sorted --slice $i/2 -o both.part.ppm
done
status 0 merge both.part.ppm.*of2 -o merged.ppm
check "slices of both eyes make the same picture" cmp both.ppm merged.ppm

# A colour behind the layers: three dark layers of 0.25 leave 0.421875 of white, code 174.
walls dark:1 dark:2 dark:3 >dark.obj
status 0 render dark.obj $view $sun --world none --background ffffff --exposure 0 --blend sorted -o dark.ppm
check "the background shows through" sh -c '[ "$(tail -c 1440 dark.ppm | od -An -v -tu1 -w3 | sort -u | tr -s " ")" = " 174 174 174" ]'

# Unlit layers keep their colours at any exposure: half of white over (0.5, 0.25, 0.125).
cat >unlit.gltf <<'EOF'
{"asset":{"version":"2.0"},"extensionsUsed":["KHR_materials_unlit","KHR_mesh_quantization"],
"cameras":[{"type":"orthographic","orthographic":{"xmag":1,"ymag":1,"znear":0.1,"zfar":10}}],
"scenes":[{"nodes":[0,1,2]}],
"nodes":[{"camera":0,"translation":[0,0,3]},{"mesh":0,"scale":[4,4,1]},{"mesh":1,"scale":[4,4,1],"translation":[0,0,1]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":5,"material":0}]},
{"primitives":[{"attributes":{"POSITION":0},"mode":5,"material":1}]}],
"materials":[{"extensions":{"KHR_materials_unlit":{}},"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,0.125,1]}},
{"extensions":{"KHR_materials_unlit":{}},"alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.5]}}],
"accessors":[{"bufferView":0,"componentType":5120,"count":4,"type":"VEC3"}],
"bufferViews":[{"buffer":0,"byteLength":16,"byteStride":4}],
"buffers":[{"byteLength":16,"uri":"data:;base64,//8AAAH/AAD/AQAAAQEAAA=="}]}
EOF
for how in "--exposure 0" "--exposure 3 --tone linear" ""; do
    status 0 render unlit.gltf --size 16x16 --shadow-map 64 --blend sorted $how -o unlit.ppm
    check "unlit layers keep their colours: $how" sh -c \
        '[ "$(tail -c 768 unlit.ppm | od -An -v -tu1 -w3 | sort -u | tr -s " ")" = " 225 207 198" ]'
done

status 2 render three.obj --show normal --blend sorted -o bad.png
said "--blend sorted: only light is mixed; --show normal shows one surface at each pixel"
status 2 render three.obj --blend sort -o bad.png
said "--blend: \`sort\` is not pattern or sorted"

finish
