# faults.sh: runs every verb with its nth allocation, open, write, rename or thread failing: B TOOL SHIM in the
# environment.
#
# The tool makes the inputs, all small: a tent as OBJ with a texture, as PLY and as glTF, its relief, baked light, a
# photo with depth, and a sequence of two. tests/faults/main_faults.c lists the conditions that must hold. CASES=WORD
# runs only commands with this word; PART=K/N runs every Nth command from the Kth on.
. tests/scripts/checks.sh

case $(uname -sm)$(ldd --version 2>&1) in
*Linux*GLIBC* | *Linux*GNU*) ;;
*)
    skip "faults: no glibc"
    finish
    ;;
esac

here=$(pwd)
tool=$here/$TOOL
dir=$B/faults-here
rm -rf "$dir"
mkdir -p "$dir/out"
cd "$dir" || exit 1
make_inputs() {
    printf 'newmtl cloth\nmap_Kd cloth.png\n' >tent.mtl
    printf '%s\n' 'mtllib tent.mtl' 'v -1 0 -1' 'v 1 0 -1' 'v 0 0 1' 'v 0 1 0' 'vt 0 0' 'vt 1 0' 'vt 0 1' 'usemtl cloth' \
        'f 1/1 2/2 3/3' 'f 1/1 4/2 2/3' 'f 2/1 4/2 3/3' 'f 3/1 4/2 1/3' >tent.obj
    printf '%s\n' ply 'format ascii 1.0' 'element vertex 3' 'property float x' 'property float y' 'property float z' \
        'element face 1' 'property list uchar int vertex_indices' end_header '0 0 0' '1 0 0' '0 1 0' '3 0 1 2' >one.ply
    printf '%s' '{"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"scene":0,"images":[{"uri":' \
        '"cloth.png"}],"textures":[{"source":0}],"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],' \
        '"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],"accessors":[{"bufferView":0,' \
        '"componentType":5126,"count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{' \
        '"byteLength":36,"uri":"data:application/octet-stream;base64,' \
        'AAAAwAAAAAAAAADAAAAAwAAAAAAAAIBAAACAQAAAAAAAAADA"}]}' >floor.gltf
    printf '0,0,0\n1,0,0\n' >path.txt
    cp "$here/tests/fuzz/corpus/gltf/shaped.gltf" .
    printf 'f0\nf1\n' >frames.txt
    eye='--eye 0.5,1.25,2.5 --target 0.5,1,-1 --size 24x16'
    "$tool" render demo --size 16x16 -q -o cloth.png &&
        "$tool" render demo $eye -q -o photo.png &&
        "$tool" render demo $eye -q -o photo.pfm &&
        "$tool" render demo $eye -q --show depth -o depth.pfm &&
        for i in 0 1; do # one view for both, so that each frame equals a run on one photo
            cp photo.png f$i.color.png && cp depth.pfm f$i.depth.pfm
            printf '%s' '{"fx": 19, "fy": 19, "cx": 11.5, "cy": 7.5, "depth_unit_mm": 1000, "camera_to_world": ' \
                '[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}' >f$i.json
        done &&
        "$tool" relight --world demo -q --cube cube.pfm &&
        "$tool" bake tent.obj -q --elements 64 --receivers 64 -o tent.lmt &&
        "$tool" pack tent.obj -q --position-error 0 --order file -o tent.lmp &&
        "$tool" relief bake tent.obj -q --size 16 --triangles 8 --views 6 -o tent.lmr
}
check "inputs are made" make_inputs
cat >cases.txt <<'END'
render demo --size 24x16 --quality draft --shadow-map 64 -q --threads 2 -o out/a.png --stats out/a.json
render tent.obj --size 24x16 --quality draft --shadow-map 64 -q --threads 2 -o out/a.ppm
render floor.gltf --size 24x16 --shadow-map 64 --bounces 3 --elements 64 -q --threads 2 -o out/a.hdr
render one.ply --size 24x16 --shadow-map 64 --group method=zones -q --threads 1 --stereo 0.1 -o out/a.pfm
render tent.obj --size 24x16 --shadow-map 64 -q --threads 2 --transfer tent.lmt -o out/a.png
render demo --size 24x16 --shadow-map 64 --many-lights 4 --elements 64 --show occlusion --threads 2 -q -o out/a.png
render demo --size 16x16 --shadow-map 64 --threads 2 -q -o -
plan tent.obj --size 24x16 --shadow-map 64 --threads 1 --budget error=0.2 -q
bake tent.obj -q --elements 64 --receivers 64 --threads 2 -o out/a.lmt
bake floor.gltf -q --elements 64 --receivers 64 --threads 2 --once -o out/a.lmt
pack tent.obj -q -o out/a.lmp
pack floor.gltf -q -o out/a.c
pack tent.lmp --transfer tent.lmt -q -o out/a.lmp
info tent.lmp -q
play shaped.gltf --size 16x16 --shadow-map 64 --quality draft --frames 2 --threads 1 -q -o out/a%02d.pfm
play tent.obj --size 16x16 --shadow-map 64 --quality draft --frames 2 --threads 2 -q --background transparent -o out/a%02d.png --stats out/a.json
capture tent.obj --at 0,0.3,0 --faces 8 --samples 1 --shadow-map 64 --quality draft --threads 2 -q -o out/c.hdr --ground out/g.pfm
relight --world cube.pfm --object tent.obj --size 24x16 --threads 2 -q --cube out/c.pfm -o out/a.png
relight --world demo --object demo --contact --path path.txt --size 16x16 --threads 1 -q -o out/a.ppm
relief bake tent.obj --size 16 --triangles 8 --views greedy:2 --threads 2 -q -o out/a.lmr
relief bake tent.obj --size 16 --triangles 8 --views 2 --simple tent.obj --threads 1 -q -o out/a.lmr
relief render tent.lmr --size 24x16 --shadow-map 64 --with floor.gltf --bounce --threads 2 -q -o out/a.png
relief render tent.lmr --size 24x16 --shadow-map 64 --compare tent.obj --threads 1 -q -o out/a.pfm
mix --photo photo.png --depth depth.pfm --intrinsics 19,19,11.5,7.5 --object tent.obj --at 12,12 --scale 0.1 --shadow-map 64 --voxels 4 --threads 2 -q -o out/a.png --stats out/a.json
mix --photo photo.png --depth depth.pfm --intrinsics 19,19,11.5,7.5 --show planes -q -o out/a.png
mix --frames frames.txt --object tent.obj --at 12,12 --scale 0.1 --shadow-map 64 --voxels 4 --threads 2 -q -o out/f%02d.png
compare photo.png photo.pfm -q --max trim=9 --heat out/a.png
info tent.obj -q
info floor.gltf --json -q
info photo.png
lambent-bench tent.obj --size 16x16 --shadow-map 64 --runs 1 --sweep tree=8,16 --breakdown 0 --cache kept -q -o out/a
doctor -q
help render
END
awk -v part="${PART:-1/1}" 'BEGIN { split(part, p, "/") } NR % p[2] == p[1] % p[2]' cases.txt >some.txt && mv some.txt cases.txt
[ -z "$CASES" ] || { grep -e "$CASES" cases.txt >some.txt && mv some.txt cases.txt; }
"$here/$B/faults" "$here/$SHIM" "$tool" <cases.txt >faults.txt
status=$?
sed '$d' faults.txt
counted=$(tail -n 1 faults.txt)
passed=$((passed + ${counted%% passed*}))
failed=$((failed + $(echo "$counted" | sed 's/.* passed, \([0-9]*\) failed.*/\1/')))
check "the faults are counted: $status" test "$failed" -gt 0 -o $status -eq 0

# A signal at each open, write and rename: the exit status is 128 + signal, or 0 if the program ended before. The file
# is the old one or the whole new one, and no other file is left.
draw() { LD_PRELOAD=$here/$SHIM FAULT=$1 "$tool" render one.ply --size 16x16 --shadow-map 64 --threads 1 -q -o out/a.pfm 2>/dev/null; }
draw none:0
mv out/a.pfm whole.pfm
for signal in 1 2 15; do
    reached=0
    for at in open:1 open:2 open:3 open:4 open:5 open:6 open:7 write:1 write:2 write:3 write:4 write:5 write:6 rename:1; do
        rm -rf out
        mkdir out
        echo before >out/a.pfm
        { draw $at:$signal; } 2>/dev/null
        status=$?
        [ $status -ne $((128 + signal)) ] || reached=$((reached + 1))
        check "signal $signal at $at: exit status $status" test $status -eq $((128 + signal)) -o $status -eq 0
        check "signal $signal at $at: $(ls -A out)" test "$(ls -A out)" = a.pfm
        check "signal $signal at $at: a part of a file" sh -c 'cmp -s out/a.pfm whole.pfm || test "$(cat out/a.pfm)" = before'
    done
    check "signal $signal came $reached times" test $reached -ge 12
done
(trap '' HUP; draw write:3:1)
check "HUP that is ignored ends nothing" cmp out/a.pfm whole.pfm
finish
