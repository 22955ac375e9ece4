# colours.sh: checks how vertex colours are interpreted, and the option for that.
. tests/cli/common.sh

# Vertex colours are sRGB codes, or linear light if the user sets that. In glTF they are always linear.
printf 'v -1 -1 0 .5 .5 .5\nv 1 -1 0 .5 .5 .5\nv 0 1 0 .5 .5 .5\nf 1 2 3\n' >grey.obj
for colours in srgb linear; do
    status 0 render grey.obj --size 32x24 --show albedo --vertex-colours $colours -o "$colours.pfm"
done
status 0 render grey.obj --size 32x24 --show albedo -o usual.pfm
check "colours are codes by default" cmp usual.pfm srgb.pfm
check "linear colours differ" sh -c '! cmp -s srgb.pfm linear.pfm'
status 0 info srgb.pfm
check "half a code is 0.214034 of light" holds ' 0.214034 ' out.txt
status 0 info linear.pfm
check "and 0.5 without decoding" holds ' 0.499995 ' out.txt

# Dark colours keep their ratios in every kind of file: codes 1 2 3 are 0.000303527 times 1 2 3.
dark="0.0003035 0.000607 0.000911"
# albedo FILE: checks the albedo in the middle of a model.
albedo() {
    status 0 render "$1" --size 16x16 --show albedo --eye 0,0,3 --target 0,0,0 -o dark.pfm
    tail -c 1632 dark.pfm | head -c 12 | od -An -tf4 >dark.txt
    awk -v want="$dark" 'BEGIN { split(want, w) } { for (i = 1; i <= 3; ++i) bad += $i < 0.99 * w[i] || $i > 1.01 * w[i] }
        END { exit bad || NR != 1 }' dark.txt
}
head="ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
rgb="property uchar red\nproperty uchar green\nproperty uchar blue\n"
face="element face 1\nproperty list uchar int vertex_indices\n"
printf "$head$rgb${face}end_header\n-1 -1 0 1 2 3\n1 -1 0 1 2 3\n0 1 0 1 2 3\n3 0 1 2\n" >dark.ply
printf "$head$face${rgb}end_header\n-1 -1 0\n1 -1 0\n0 1 0\n3 0 1 2 1 2 3\n" >faces.ply
sed -n 's/^\(.*\) 1 2 3$/v \1 .003921569 .007843137 .011764706/p' dark.ply >dark.obj
echo 'f 1 2 3' >>dark.obj
triangle="data:;base64,AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAAAAAAAAgD8AAAAAFR+fORUfHzot0G46FR+fORUfHzot0G46FR+fORUfHzot0G46"
cat >dark.gltf <<END
{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"buffers":[{"byteLength":72,"uri":"$triangle"}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"COLOR_0":1},"material":0}]}],
"materials":[{"doubleSided":true,"pbrMetallicRoughness":{"metallicFactor":0}}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[-1,-1,0],"max":[1,1,0]},
{"bufferView":0,"byteOffset":36,"componentType":5126,"count":3,"type":"VEC3"}],
"bufferViews":[{"buffer":0,"byteLength":72}]}
END
# The note about metals is only for pictures without lobes.
sed 's/"metallicFactor":0/"metallicFactor":1/' dark.gltf >metal.gltf
status 0 render metal.gltf --size 16x16 -o metal.png
check "metal has a note" holds "reflect only with --glossy" err.txt
status 0 render metal.gltf --size 16x16 --glossy -o metal.png
check "with --glossy metal has none" lacks "only with --glossy" err.txt
status 0 pack dark.ply -o dark.lmp
status 0 bake dark.ply --to vertex-colours --elements 64 --receivers 64 --light point:0,0,2:0,0,-1:9,9,9 -o dark.glb
for model in dark.ply faces.ply dark.obj dark.gltf dark.lmp; do
    check "$model keeps dark colours" albedo $model
done
status 0 pack dark.ply --textures rgba8 -o bytes.lmp
status 0 render bytes.lmp --size 16x16 --show albedo --eye 0,0,3 --target 0,0,0 -o dark.pfm
check "--textures rgba8 packs bytes" sh -c '[ "$(tail -c 1632 dark.pfm | head -c 12 | od -An -v -tx4 | tr -d " 0")" = "" ]'
status 0 pack dark.ply -o little.lmp --endian little
status 0 pack dark.ply -o big.lmp --endian big
check "little-endian colours" sh -c 'od -An -v -tx1 little.lmp | tr -d " \n" | grep -q 76044f06ba07ffff'
check "big-endian colours" sh -c 'od -An -v -tx1 big.lmp | tr -d " \n" | grep -q 0476064f07baffff'
dark="0.000305 0.00061 0.000916" # as 65535ths
check "so does a baked GLB" albedo dark.glb

for verb in bake capture info mix pack plan play relight render 'relief bake' 'relief render'; do
    "$TOOL" $verb --help >help.txt
    check "$verb has --vertex-colours" holds '--vertex-colours srgb|linear' help.txt
done

finish
