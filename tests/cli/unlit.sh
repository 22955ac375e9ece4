# unlit.sh: checks KHR_materials_unlit: a colour is unchanged for any light, exposure, samples and eyes.
. tests/cli/common.sh

# A wall of colour (0.5, 0.25, 0.125), with codes 188, 137 and 99, fills the view. A small lit square is in front of it.
unlit() { # unlit MATERIALS NODES >FILE.gltf
    cat <<EOF
{"asset":{"version":"2.0"},"extensionsUsed":["KHR_materials_unlit","KHR_mesh_quantization"],
"cameras":[{"type":"orthographic","orthographic":{"xmag":1,"ymag":1,"znear":0.1,"zfar":10}}],
"scenes":[{"nodes":[0,1$2]}],
"nodes":[{"camera":0,"translation":[0,0,3]},{"mesh":0,"scale":[4,4,1]},{"mesh":1,"scale":[0.5,0.5,1],"translation":[0,0,1]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":5,"material":0}]},
{"primitives":[{"attributes":{"POSITION":0},"mode":5,"material":1}]}],
"materials":[{$1"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,0.125,1],"metallicFactor":0}},
{"pbrMetallicRoughness":{"metallicFactor":0}}],
"accessors":[{"bufferView":0,"componentType":5120,"count":4,"type":"VEC3"}],
"bufferViews":[{"buffer":0,"byteLength":16,"byteStride":4}],
"buffers":[{"byteLength":16,"uri":"data:;base64,//8AAAH/AAD/AQAAAQEAAA=="}]}
EOF
}
unlit '"extensions":{"KHR_materials_unlit":{}},' '' >wall.gltf
unlit '"extensions":{"KHR_materials_unlit":{}},' ',2' >both.gltf
unlit '' ',2' >lit.gltf
lamp="--light sun:0,0,5:0,0,-1:9,9,9"

is_wall() { [ "$(tail -c 768 "$1" | od -An -v -tu1 -w3 | sort -u | tr -s ' ')" = " 188 137 99" ]; }
for how in "--exposure 0" "--exposure 3 --tone linear" "--exposure -2 --samples 1" "" "--show direct --quality draft" "--world sky"; do
    status 0 render wall.gltf --size 16x16 --shadow-map 64 $how -o wall.ppm
    check "an unlit wall shows its colour: $how" is_wall wall.ppm
done
status 0 render wall.gltf --size 16x16 --shadow-map 64 $lamp --exposure 1 -o wall.ppm
check "an unlit wall shows its colour in light" is_wall wall.ppm
status 0 play wall.gltf --size 16x16 --shadow-map 64 $lamp --frames 2 -o wall%02d.ppm
check "an unlit wall shows its colour in each frame" is_wall wall01.ppm
status 0 render wall.gltf --size 16x16 --shadow-map 64 --stereo 0.1 --exposure 2 -o eyes.ppm
check "and to both eyes" sh -c '[ "$(tail -c 1536 eyes.ppm | od -An -v -tu1 -w3 | sort -u | tr -s " ")" = " 188 137 99" ]'

# A lit square in front of the wall has the same exposure as without the wall. Its edges are mixed.
pixel() { tail -c 768 "$1" | od -An -v -tu1 -j $((3 * $2)) -N 3 | tr -s ' '; } # pixel FILE NUMBER
for how in "--exposure -1" ""; do
    status 0 render both.gltf --size 16x16 --shadow-map 64 $lamp $how -o both.ppm
    check "the wall beside a lit square: $how" test "$(pixel both.ppm 0)" = " 188 137 99"
    check "the lit square is not of the wall's colour: $how" test "$(pixel both.ppm 136)" != " 188 137 99"
done
status 0 render both.gltf --size 16x16 --shadow-map 64 $lamp --exposure -1 --show direct -o both.ppm
status 0 render lit.gltf --size 16x16 --shadow-map 64 $lamp --exposure -1 --show direct -o lit.ppm
check "light on what is lit stays as it was" test "$(pixel both.ppm 136)" = "$(pixel lit.ppm 136)"
check "the wall was lit otherwise" test "$(pixel lit.ppm 0)" != " 188 137 99"
for i in 1 2; do
    status 0 render both.gltf --size 16x16 --shadow-map 64 $lamp --slice $i/2 -o parts.png
done
status 0 render both.gltf --size 16x16 --shadow-map 64 $lamp -o whole.png
status 0 merge parts.png.*of2 -o parts.png
check "in slices too" cmp parts.png whole.png

finish
