# errors.sh: checks that each verb prints the same line for the same fault of a file.
. tests/cli/common.sh

# --- models that show nothing ---

photo
printf 'v nan nan nan\nv nan nan nan\nv nan nan nan\nf 1 2 3\n' >nan.obj
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0\nf 1 2 3\nf 1 4 2\n' >sliver.obj
printf 'v 1e9 0 0\nv 1e9 1 0\nv 1e9 0 1\nf 1 2 3\n' >far.obj
printf 'v 1 2 3\nv 1 2 3\nv 1 2 3\nf 1 2 3\n' >point.obj
printf '{"asset":{"version":"2.0"},"nodes":[{"camera":0}],"cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":0.1}}]}' >none.gltf
for fault in nan.obj:"each triangle has a corner that is not finite or 2^20 m away" far.obj:"each triangle has a corner that is not finite or 2^20 m away" \
    point.obj:"all triangles are in one point" none.gltf:"no triangles; \`lambent info\` lists the contents"; do
    model=${fault%%:*}
    for verb in "render $model $few -o x.png" "render $model $few --eye 0,0,9 --target 0,0,0 -o x.png" "plan $model --size 8x8" \
        "play $model $few --frames 2 -o x%02d.png" "pack $model -o x.lmp" "bake $model -o x.lmt" \
        "bake $model --to lightmap -o x.glb" "bake $model --to probes -o x.json" "capture $model --at 0,0,1 --faces 8 -o x.hdr" \
        "explain $model --size 8x8 --pixel 1,1" "relight --world demo --object $model --size 8x8 -o x.png" \
        "relight --world demo --object tent.obj --at 0,0,0 --object $model --at 1,0,0 --size 8x8 -o x.png" \
        "relief bake $model --size 16 -o x.lmr" "relief bake tent.obj --simple $model --size 16 -o x.lmr" \
        "mix $seen --object $model --scale 0.2 --at 8,12 -o x.png" "lambent-bench $model --size 8x8 --runs 1 -q"; do
        status 1 $verb
        said ": $model: nothing to see: ${fault#*:}"
    done
    status 0 info $model
done
echo 'x.png nan.obj 8,12' >list.txt
status 1 mix $seen --placements list.txt
said "nan.obj: nothing to see: each triangle has"
check "nothing is written" none x.*

# --- folders in place of files ---

mkdir faces empty
for verb in "render tent.obj $few" "relight --object tent.obj --size 8x8"; do
    status 1 $verb --world empty -o x.png
    said "empty: a folder; give a picture, or empty/ if six faces are in it: px.png"
    status 1 $verb --world empty/ -o x.png
    said "empty/: a folder; give a picture, or empty/ if"
    status 1 $verb --world missing -o x.png
    said "missing: no such file, and no face missingpx.png"
done
cp photo.pfm faces/px.pfm
status 0 render tent.obj $few --world faces/ -o face.png

# --- notes with a remedy ---

printf 'v %s\n' '-1e-4 -1 -1' '-1e-4 1 -1' '-1e-4 1 1' '-1e-4 -1 1' '1e-4 -1 -1' '1e-4 1 -1' '1e-4 1 1' '1e-4 -1 1' >slit.obj
printf 'f %s\n' '1 2 3 4' '5 6 7 8' '1 2 6 5' >>slit.obj
status 0 play slit.obj $few --frames 1 --eye 0,0,1 --target 0,0,-1
said "the camera stands still: surfaces are too near beside it; --path FILE moves it"
box
status 0 play box.obj $few --frames 1 --eye 0,0,0 --target 1,0,0 --light point:0.9999,0.9999,0.9999:0,-1,0:1,1,1
said "light 0 stands still: surfaces are too near for a circle; --path FILE moves it"

# --- an error is the only line, also if there are notes; without an error the notes are printed ---

status 2 explain tent.obj --size 8x8 --shadow-map 64 --pixel 9,9
check "one line" one_line err.txt
status 1 render tent.obj $few --world missing -o x.png
status 0 explain tent.obj --size 8x8 --shadow-map 64 --pixel 4,4
said "no camera in tent.obj: framing the scene from"
status 0 plan tent.obj --size 8x8
said "no camera in tent.obj: framing the scene from"
status 0 render tent.obj $few -o x.png
said "no camera in tent.obj: framing the scene from"
status 0 pack sliver.obj -o x.lmp
said "triangles without area or vertices, which are left out: 1"
status 1 pack sliver.obj -o nowhere/x.lmp
# --- long names are whole ---

name=$(printf 'n%.0s' $(seq 200))
mkdir -p "$name/$name/$name"
long="$name/$name/$name/$name"
for verb in "mix --photo $long.pfm --depth wall.pfm --intrinsics 30,30,11.5,11.5 --object tent.obj -o x.png" "render $long.obj -o x.png" \
    "mix --frame $long --object tent.obj -o x.png" "info $long.lmp"; do
    status 1 $verb
    said "$long."
    said "cannot be opened: No such file or directory"
done
echo "x.png $long.obj 8,12" >list.txt
status 1 mix $seen --placements list.txt
said "$long.obj: cannot be opened: No such file or directory"

# play prints its notes before its first picture.
"$TOOL" play tent.obj --size 8x6 --shadow-map 64 --quality draft --frames 3 -o noted%02d.ppm --time-limit 100 >out.txt 2>noted.txt
check "play ends" test $? -eq 0
"$TOOL" play tent.obj --size 320x240 --shadow-map 64 --quality draft --frames 100000 --time-limit 1 >out.txt 2>cut.txt
check "play ends at its limit" test $? -eq 1
check "play prints its notes before the end" grep -qxFf noted.txt cut.txt
check "play has notes" test -s noted.txt

# --- line ends of any system ---

printf 'mtllib lines.mtl\nv 0 0 0 # a corner\nv 1 0 \\\n0\nv 0 1 0\nusemtl a b\nf 1 2 \\\n3\n# end' >lines.obj
printf 'newmtl a b\nKd 1 0.5 0.25\n' >lines.mtl
mkdir cr crlf
for file in lines.obj lines.mtl; do
    tr '\n' '\r' <$file >cr/$file
    sed "s/\$/$(printf '\r')/" $file >crlf/$file
done
status 0 render lines.obj $few -q -o lines.pfm
for folder in cr crlf; do
    status 0 render $folder/lines.obj $few -q -o $folder.pfm
    check "$folder: the same picture" cmp lines.pfm $folder.pfm
done
printf 'v 0 0 0\rv 1 0 0\rv x 1 0\rf 1 2 3\r' >cr.obj
status 1 info cr.obj
said 'cr.obj: line 3: "x" is not a number'
printf '# by\rf 7 8 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >comment.obj
status 0 info comment.obj # with LF in the file, CR ends no line

# --- a note about a texture that was left out ---

printf 'newmtl a\nmap_Kd cut.png\n' >cut.mtl
head -c 40 tent.png >cut.png 2>/dev/null || printf '\211PNG' >cut.png
printf 'mtllib cut.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl a\nf 1/1 2/2 3/3\n' >cut.obj
for verb in "render cut.obj $few -o cut.png.pfm" "bake cut.obj --elements 64 -o cut.lmt" "relief bake cut.obj --size 16 -o cut.lmr" "pack cut.obj -o cut.lmp"; do
    status 0 $verb
    check "$verb prints no note about the texture" grep -q "textures left out" err.txt
done

# --- a wrong value of an option is bad usage, also if only the file shows it ---

moving
for scene in 4 night; do
    status 2 render moving.gltf --scene $scene $few -o x.png
    said "moving.gltf: no scene \`$scene\`; it has"
    status 2 info moving.gltf --scene $scene
done
status 2 render moving.gltf --camera nope $few -o x.png
status 2 relief foo
said "there is no \`relief foo\`: give bake or render"
status 2 relief
said "give bake or render"

# --- standard input under each of its names ---

"$TOOL" render tent.obj $few -q -o tent.pfm
for name in - /dev/stdin /dev/fd/0; do
    "$TOOL" render $name $few -q -o stdin.pfm <tent.obj
    check "$name is read as OBJ" cmp tent.pfm stdin.pfm
    rm -f stdin.pfm
done
status 2 render "" -o x.png
said 'SCENE: `` is not text of a character or more'

finish
