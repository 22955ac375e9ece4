# strangers.sh: checks files from strangers: names with control characters, references that leave a folder, a time
# limit.
. tests/cli/common.sh

# --- names: no terminal controls, no characters that reorder or hide text, no line breaks ---

# ESC ] 0 and BEL, C1 as UTF-8 and as a bare byte, an override, an isolate, two marks, a line break, the end of a
# comment, and characters with a meaning in HTML or trigraphs.
odd=$(printf 'o\033]0;x\007y\302\233\233z\342\200\256\342\201\246\342\200\216\330\234\nq*?\?\\<b>&"'"'")
text=$(printf 'o\033]0;x\007y\302\233\233z\342\200\256\342\201\246\342\200\216\330\234q')
name='o\u001b]0;x\u0007\u009bz\u202e\u2066\u200e\u061c\nq*/<b>&\"'"'$(printf '\302\233\342\200\256')"

# clean NAME FILE...: checks that the files have no such byte and are UTF-8.
clean() {
    what=$1
    shift
    for each in "$@"; do
        if [ ! -f "$each" ]; then
            fail "$what: there is no $each"
        elif od -An -v -tx1 "$each" | tr '\n' ' ' | grep -qE \
            ' (0[0-9b-f]|1[0-9a-f]|7f|c2 +[89][0-9a-f]|d8 +9c|e2 +80 +(8[ef]|a[89a-e])|e2 +81 +a[0-9a-f])'; then
            fail "$what: a control character or mark in $each"
        elif ! iconv -f UTF-8 -t UTF-8 "$each" >/dev/null; then
            fail "$what: $each is not UTF-8"
        else
            pass
        fi
    done
}

# says WANTED ARGUMENT...: checks the exit status, and that the output is clean.
says() {
    status "$@"
    clean "$2 $3" out.txt err.txt
}

photo
cat >odd.gltf <<GLTF
{"asset":{"version":"2.0"},"scene":0,"scenes":[{"name":"$name","nodes":[0,1]}],"nodes":[{"mesh":0,"name":"$name"},
{"camera":0,"name":"$name"}],"cameras":[{"name":"$name","type":"perspective","perspective":{"yfov":1,"znear":0.1}}],
"extensionsUsed":["$name","$(printf 'plain\233')"],"materials":[{"name":"$name","pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],
"textures":[{"source":0}],"images":[{"uri":"$name.png"}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}]}
GLTF
cp odd.gltf "$odd.gltf"
printf 'mtllib %s.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl %s\nf 1 2 3\n' "$text" "$text" >odd.obj
printf 'ply\nformat ascii 1.0\ncomment %s\nelement vertex 1\nproperty %s x\nend_header\n0\n' "$text" "$text" >odd.ply
cp odd.obj "$odd.obj"
cp photo.pfm "$odd.pfm"
for model in odd.gltf "$odd.gltf" "$odd.obj"; do
    says 0 info "$model"
    says 0 info "$model" --json
    says 0 render "$model" $small -v --stats odd.json -o "$odd.png"
    clean "render's statistics" odd.json
    says 0 plan "$model" --size 32x24
    says 0 plan "$model" --size 32x24 --json
done
"$TOOL" info "$odd.gltf" --json >out.txt
check "a name stays in JSON, by escapes" holds 'o\u001b]0;x\u0007y\u009b\ufffdz\u202e\u2066\u200e\u061c\u000aq*?' out.txt
says 1 info odd.ply
says 0 bake "$odd.obj" -v --elements 64 --receivers 64 -o "$odd.lmt"
says 0 bake "$odd.obj" --to probes -o "$odd.json"
clean "the probes" "$odd.json"
says 0 info "$odd.lmt"
says 0 pack "$odd.obj" -v --report -o "$odd.c"
clean "the packed scene" "$odd.c"
says 0 play "$odd.obj" $few --frames 1 --stats odd.json -o "$odd%02d.png"
clean "play's statistics" odd.json
says 0 capture "$odd.obj" --at 0.2,0.2,1 --faces 8 -o "$odd.hdr"
says 0 relight --world "$odd.hdr" --object "$odd.obj" --size 16x16 -v -o "$odd.png"
says 0 mix $seen --object "$odd.obj" --scale 0.2 --at 8,12 --shadow-map 64 --voxels 4 -v -o "$odd.png"
says 1 mix --frame "$odd" $tent -o "$odd.png"
says 0 relief bake "$odd.obj" --size 16 --triangles 8 -v -o "$odd.lmr"
says 0 relief render "$odd.lmr" --size 16x16 -v -o "$odd.png"
says 0 info "$odd.lmr" --json
says 0 compare -v "$odd.pfm" photo.pfm
says 1 compare "$odd" photo.pfm
says 2 compare photo.pfm photo.pfm --max "mean=$text"
says 0 lambent-bench "$odd.obj" --size 24x24 --shadow-map 64 --sweep tree=8,16 --runs 1 --truth "$odd.pfm" -v -o "$odd-table" --svg "$odd.svg"
clean "the tables" "$odd-table.html" "$odd-table.csv" "$odd-table.json" "$odd.svg"

# Markup: SVG and HTML show the name of a file in labels and titles, with &, <, > and quotes escaped.
plain=${odd%%"$(printf '\nq')"*} # no line break: a break in a name cleans the line breaks around it, too
cp "$odd.lmt" "$plain<b>&.lmt"
"$TOOL" bake "$odd.obj" -q --elements 256 --receivers 400 -o "$plain<i>&.lmt"
status 0 lambent-bench "$odd.obj" --size 24x24 --shadow-map 64 --sweep "transfer=$plain<b>&.lmt,$plain<i>&.lmt" --runs 1 --breakdown 0 -q -o marked --svg marked.svg
clean "markup" marked.svg marked.html marked.csv marked.json
for page in marked.svg marked.html; do
    check "$page has both names, escaped" sh -c 'grep -q "transfer o?]0;x?y?*z?*&lt;b&gt;&amp;\.lmt" "$1" &&
        grep -q "transfer o?]0;x?y?*z?*&lt;i&gt;&amp;\.lmt" "$1" && ! grep -q "<b>&\|<i>&" "$1"' sh $page
done
mkdir "peers$odd"
printf '#!/bin/sh\nprintf "\033]0;x\007,$1,cpu_min_ms=9\\n"\n' >"peers$odd/fine"
cp "peers$odd/fine" "peers$odd/odd$odd" && chmod +x "peers$odd/"*
for form in "--html $plain.html" "--json --html $plain.html"; do
    says 0 lambent-bench raster fill-depth-pass --seconds 0.01 --peers "peers$odd" --data "$odd" $form
    clean "raster --html" "$plain.html"
done
says 2 lambent-bench raster "$odd" --html "$plain.html"
says 1 lambent-bench raster bunny --data "$odd" --html "$plain.html"
"$TOOL" merge "$odd" -o joined.png >out.txt 2>err.txt && fail "merge: no slice, and exit status 0" || pass
clean "merge's notes" out.txt err.txt
says 2 "$odd"
says 2 render "--$odd" -o x.png
says 2 render demo --show "$odd" -o x.png
says 1 lambent-bench "$odd"
printf '%s\n' "$text" >names.txt
says 1 mix --frames names.txt $tent -o frame_%02d.png

# --- references: with --only-here no reference leaves the folder of its file ---

mkdir -p in/sub out
status 0 render demo --size 8x8 --shadow-map 64 --show direct --exposure 0 -q -o out/t.png
cp out/t.png in/sub/t.png
ln -s ../out in/folder
ln -s ../out/t.png in/link.png
ln -s sub/t.png in/own.png
ln -s ../in/sub in/around
printf '\000\000\000\000\000\000\000\000\000\000\000\000\000\000\200\077\000\000\000\000\000\000\000\000\000\000\000\000\000\000\200\077\000\000\000\000' >out/t.bin
cp out/t.bin in/sub/t.bin
ln -s ../out/t.bin in/link.bin
obj() { # MTLLIB MAP
    printf 'mtllib %s\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl a\nf 1/1 2/2 3/3\n' "$1" >in/m.obj
    printf 'newmtl a\nKd 1 1 1\nmap_Kd %s\n' "$2" >in/m.mtl
    cp in/m.mtl out/m.mtl
}
gltf() { # BUFFER IMAGE
    printf '{"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"meshes":[{"primitives":[{"attributes":
{"POSITION":0},"material":0}]}],"materials":[{"pbrMetallicRoughness":{"metallicFactor":0,"baseColorTexture":{"index":0}}}],"textures":
[{"source":0}],"images":[{"uri":"%s"}],"buffers":[{"byteLength":36,"uri":"%s"}],"bufferViews":[{"buffer":0,"byteLength":36}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}]}' "$2" "$1" >in/m.gltf
}
# textures MODEL OPTION...: prints the number of textures read.
textures() { "$TOOL" info "$@" 2>err.txt | sed -n 's/^textures .*read: \([0-9]*\) .*/\1/p'; }
inside="sub/t.png own.png ./sub/../sub/t.png around/t.png"
outside="../out/t.png folder/t.png link.png sub/../../out/t.png ../in/sub/t.png around/../../out/t.png $PWD/out/t.png $PWD/in/sub/t.png"
for map in $inside; do
    obj m.mtl "$map" && gltf sub/t.bin "$map"
    check "$map is inside" test "$(textures in/m.obj --only-here)$(textures in/m.gltf --only-here)$(cd in && textures m.obj --only-here)" = 111
done
for map in $outside; do
    obj m.mtl "$map" && gltf sub/t.bin "$map"
    check "$map is outside" test "$(textures in/m.obj --only-here)$(textures in/m.gltf --only-here)$(cd in && textures m.obj --only-here)" = 000
    status 0 render in/m.obj $small --only-here -q -o here.png
done
obj m.mtl ../out/t.png && gltf sub/t.bin ../out/t.png
check "without --only-here both are read" test "$(textures in/m.obj)$(textures in/m.gltf)" = 11
"$TOOL" render in/m.obj $small --only-here -o here.png >out.txt 2>err.txt
check "what is refused has one line" test "$(grep -c 'no file in or below its folder (--only-here)' err.txt)" = 1
for library in ../out/m.mtl folder/m.mtl; do
    obj "$library" sub/t.png && check "$library is outside" test "$(textures in/m.obj --only-here)" = 0
done
for buffer in ../out/t.bin link.bin folder/t.bin sub/%2e%2e/../../out/t.bin gone.bin; do
    gltf "$buffer" sub/t.png
    status 1 info in/m.gltf --only-here
    said "no file in or below its folder (--only-here)"
done
for verb in "render in/m.gltf $few -o x.png" "plan in/m.gltf --size 8x8" "play in/m.gltf $few --frames 1" "pack in/m.gltf -o x.lmp" \
    "bake in/m.gltf -o x.lmt" "capture in/m.gltf --at 0,0,1 -o x.hdr" "relief bake in/m.gltf -o x.lmr" \
    "relight --world demo --object in/m.gltf -o x.png" "mix $seen --object in/m.gltf --scale 0.2 --at 8,12 -o x.png"; do
    gltf link.bin sub/t.png
    status 1 $verb --only-here
    said "no file in or below its folder (--only-here)"
done
for subject in "in/m.gltf --size 8x8" "relight --world demo --object in/m.gltf --size 8x8" "relief in/m.gltf --size 8" "mix $seen --truth photo.pfm --object in/m.gltf"; do
    status 1 lambent-bench $subject --runs 1 --only-here
    said "no file in or below its folder (--only-here)"
done
# A file that is itself a link, named on the command line.
cp photo.pfm wall.pfm out/
gltf sub/t.bin sub/t.png
cp in/m.gltf out/m.gltf && cp in/m.gltf in/own.gltf
ln -s ../out/m.gltf in/away.gltf
ln -s own.gltf in/near.gltf
ln -s ../out/photo.pfm in/away.pfm
ln -s ../out in/gone
for verb in "render in/away.gltf $few -o x.png" "info in/away.gltf" "pack in/away.gltf -o x.lmp" "render in/near.gltf --world in/away.pfm $few -o x.png" \
    "compare in/away.pfm in/away.pfm" "relight --world in/away.pfm --object tent.obj -o x.png" "mix --photo in/away.pfm --depth wall.pfm --intrinsics 30,30,11.5,11.5 --object tent.obj --scale 0.2 --at 8,12 -o x.png"; do
    status 1 $verb --only-here
    said "a link that leads out of its folder (--only-here)"
done
"$TOOL" merge in/away.pfm -o x.png --only-here >out.txt 2>err.txt
said "a link that leads out of its folder (--only-here)"
status 1 info /proc/self/cwd/in/away.gltf --only-here # by the name of a folder that the system links
said "a link that leads out of its folder (--only-here)"
status 0 info in/away.gltf
cp tent.obj out/tent.obj
printf 'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' >triangle.ply
for model in in/near.gltf in/gone/tent.obj /dev/stdin -; do
    status 0 info $model --only-here <triangle.ply
done
status 1 info in/missing.gltf --only-here
said "in/missing.gltf: cannot be opened"
for part in color.pfm depth.pfm; do cp wall.pfm "in/f.$part" && cp wall.pfm "out/f.$part"; done
printf '{"fx": 30, "fy": 30, "cx": 11.5, "cy": 11.5, "depth_unit_mm": 1000, "camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}' >in/f.json
cp in/f.json out/f.json
for prefix in ../out/f folder/f "$PWD/out/f" "$PWD/in/f"; do
    printf 'f\n%s\n' "$prefix" >in/list.txt
    status 1 mix --frames in/list.txt $tent --only-here -q -o listed_%01d.pfm
    said "1 of 2 frames are left out, the first because"
    said "no file in or below its folder (--only-here)"
    status 0 mix --frames in/list.txt $tent -q -o listed_%01d.pfm
done
printf '1 f.color.pfm\n2 ../out/f.color.pfm\n' >in/rgb.txt && printf '1 f.depth.pfm\n2 f.depth.pfm\n' >in/depth.txt
printf '1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n' >in/groundtruth.txt
status 1 mix --frames in $tent --intrinsics 30,30,11.5,11.5 --depth-scale 1 --only-here -q -o listed_%01d.pfm
said "1 of 2 frames are left out, the first because in/../out/f.color.pfm: no file in or below"
printf '1 f.color.pfm\n' >in/rgb.txt
for list in rgb depth groundtruth frames; do
    [ $list != frames ] || { rm in/rgb.txt && echo f >in/frames.txt; }
    seen="$tent --intrinsics 30,30,11.5,11.5 --depth-scale 1 --only-here"
    [ $list != frames ] || seen="$tent --only-here"
    status 0 mix --frames in $seen -q -o listed_%01d.pfm
    mv in/$list.txt out/$list.txt && ln -s ../out/$list.txt in/$list.txt
    status 1 mix --frames in $seen -q -o listed_%01d.pfm
    said "in/$list.txt: no file in or below its folder (--only-here)"
    rm in/$list.txt && mv out/$list.txt in/$list.txt
done

# --- a time limit: one line, status 1, and no files from this command ---

mkdir -p late
box
white
late() {
    rm -rf late && mkdir late
    begun=$(date +%s)
    status 1 "$@" --time-limit 0.1
    said "--time-limit 0.1: the time is over"
    check "lambent $1: ends soon" test $(($(date +%s) - begun)) -lt 20
    check "lambent $1: leaves nothing" test -z "$(ls -A late)"
}
# needles.obj: needles through one point; holes.gltf: masked quads. Either takes minutes at these settings.
awk 'BEGIN { srand(1); for (i = 0; i < 20000; ++i) { x = 2 * rand() - 1; y = 2 * rand() - 1; z = 2 * rand() - 1
    printf "v %g %g %g\nv %g %g %g\nv %g %g %g\nf -1 -2 -3\n", x, y, z, x + 0.001, y, z + 0.001, -x, -y, -z } }' >needles.obj
{
    printf '{"asset":{"version":"2.0"},"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0}]}],'
    printf '"materials":[{"alphaMode":"MASK","doubleSided":true,"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],'
    printf '"textures":[{"source":0}],"images":[{"uri":"data:image/png;base64,%s"}],' "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAYAAABytg0kAAAAE0lEQVR42mP4//8/IxD/Z4AyGAF7qgz3Qa70rQAAAABJRU5ErkJggg=="
    printf '"buffers":[{"byteLength":120,"uri":"data:application/octet-stream;base64,%s"}],' "AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAACAPwAAgD8AAAAAAACAvwAAgL8AAAAAAACAPwAAgD8AAAAAAACAvwAAgD8AAAAAAAAAAAAAAAAAABBBAAAAAAAAEEEAABBBAAAAAAAAAAAAABBBAAAQQQAAAAAAABBB"
    printf '"bufferViews":[{"buffer":0,"byteLength":72},{"buffer":0,"byteOffset":72,"byteLength":48}],"accessors":['
    printf '{"bufferView":0,"componentType":5126,"count":6,"type":"VEC3"},{"bufferView":1,"componentType":5126,"count":6,"type":"VEC2"}],'
    awk 'BEGIN { printf "\"nodes\":["; for (i = 0; i < 5000; ++i) printf "%s{\"mesh\":0,\"translation\":[0,0,%g]}", i ? "," : "", i / 5000; print "]}" }'
} >holes.gltf
late render needles.obj --size 2000x2000 --quality best -q -o late/x.png --stats late/x.json
late render holes.gltf --size 2000x2000 --quality best -q -o late/x.png
late explain needles.obj --size 4000x4000 --quality best --pixel 9,9 -q
late mix --photo photo.pfm --depth wall.pfm --intrinsics 30,30,11.5,11.5 --object needles.obj --scale 0.2 --at 8,12 --voxels 9 -q -o late/x.png
late play demo --size 64x48 --quality draft --frames 100000 -q -o late/f%06d.png
late bake holes.gltf --quality best -q -o late/x.lmt
late bake demo --to lightmap -q -o late/x.glb
late plan demo --size 2000x2000 --budget error=0.001
late capture demo --at 0.5,1,0.5 --faces 512 -q -o late/x.hdr --ground late/g.hdr
late relight --world demo --object needles.obj --size 4000x4000 --samples 16 -q -o late/x.png
late relief bake needles.obj --size 512 --views 48 -q -o late/x.lmr
late lambent-bench demo --size 800x600 -q -o late/table
mkfifo pipe.glb
late info pipe.glb
late pack pipe.glb -q -o late/x.lmp
late compare pipe.glb photo.pfm
mkfifo endless.obj
yes 'v 0 0 0' >endless.obj 2>/dev/null &
late render endless.obj -q -o late/x.png
# stdout and stderr are a full pipe that nobody reads.
mkfifo full
exec 9<>full
dd if=/dev/zero bs=4096 count=4096 >&9 2>/dev/null &
filler=$!
sleep 0.3
for quiet in -q -v; do
    rm -rf late && mkdir late
    "$TOOL" play demo --size 32x24 --quality draft --frames 100000 $quiet -o late/f%06d.png --time-limit 0.1 >&9 2>&9 &
    player=$!
    for second in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15; do kill -0 $player 2>/dev/null && sleep 1; done
    kill -9 $player 2>/dev/null
    wait $player
    check "play $quiet ends though nobody reads its output" test $? -eq 1
    check "play $quiet into a full pipe leaves nothing" test -z "$(ls -A late)"
done
kill $filler
exec 9>&-
status 0 render demo $small --time-limit 1e5 -q -o in-time.png
status 0 render demo $small -q -o plain.png
check "a limit changes no byte" cmp in-time.png plain.png
for seconds in 0 -1 nan inf 1e99 x ''; do
    status 2 render demo $small -o bad.png --time-limit "$seconds"
done

finish
