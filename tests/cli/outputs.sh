# outputs.sh: checks that failures leave no files, and that unwritable outputs are refused before the work.
. tests/cli/common.sh

# A failure leaves no files.
printf 'no scene' >broken.glb
status 1 render nowhere.gltf -o bad.png
status 1 render broken.glb -o bad.png
absent bad.png
status 2 render demo --size 5000x8 --stereo 0.1 -o bad.png
status 1 render demo $small -o nowhere/demo.png
absent nowhere
mkdir folder.png
status 1 render demo $small -o folder.png
check "folder.png stays an empty folder" rmdir folder.png
status 0 render demo $few -o demo.pfm
status 1 compare demo.pfm nowhere.pfm
status 1 info nowhere.glb
status 1 info broken.glb --json
status 1 info nowhere.png

# A limit on file sizes fails like any other write. Some shells count in 512 bytes, some in 1024.
if (ulimit -f 8) 2>/dev/null; then
    echo before >kept.pfm
    (
        ulimit -f 8
        "$TOOL" render demo $small -o kept.pfm >out.txt 2>err.txt
        echo $? >status.txt
    )
    check "a file beyond the limit: exit status 1" test "$(cat status.txt)" = 1
    check "a file beyond the limit: one line on stderr" test "$(wc -l <err.txt)" -eq 1
    check "a file beyond the limit is named" holds 'kept.pfm: cannot be written: ' err.txt
    check "a file beyond the limit: what stood there stays" test "$(cat kept.pfm)" = before
else
    skip "a limit on the size of files: this shell sets none"
fi
# Killed at any moment: either the old file or the whole new file exists (a PFM of 32 x 24 has 9,231 bytes).
"$TOOL" render demo $small -o whole.pfm >/dev/null 2>&1
for wait in 0 0.02 0.05 0.1 0.2; do
    echo before >killed.pfm
    "$TOOL" render demo $small -o killed.pfm >/dev/null 2>&1 &
    sleep $wait 2>/dev/null
    kill -9 $! 2>/dev/null
    wait $! 2>/dev/null
    check "killed after $wait s: a whole file" sh -c 'test "$(cat "$1")" = before || cmp -s "$1" "$2"' sh killed.pfm \
        whole.pfm
done
find . \( -name '*killed*tmp*' -o -name '.write-*.tmp' \) -exec rm -f {} + # temporary files of the killed commands

# If the reader closes the pipe, the tool ends, with an exit status or by the signal.
check "a closed pipe ends the tool" sh -c '"$1-bench" hard mixed | head -n 1 | grep -q "^group"' sh "$TOOL"

left=$(find . -name '*tmp*' -o -name 'bad*' -o -name 'nowhere*')
check "left behind: $left" test -z "$left"

box
photo

# --- unwritable outputs are refused before the work ---

# alone: one line on stderr, and nothing on stdout. refused WORD ARGUMENT...: one line with the word, although the scene
# is missing too. misused: one file for two purposes, which is bad usage.
alone() { one_line err.txt && empty out.txt; }
refused() {
    word=$1
    shift
    status 1 "$@"
    said "$word"
}
misused() {
    word=$1
    shift
    status 2 "$@"
    said "$word"
    check "lambent $*: one line" alone
}
nowhere=nodir
for out in x.png x.pfm; do
    refused "$nowhere/$out: cannot be written" render no.gltf -o "$nowhere/$out"
    refused "$nowhere/$out: cannot be written" relight --world no.pfm --cube "$nowhere/$out"
    refused "$nowhere/$out: cannot be written" relight --world no.pfm --map "$nowhere/$out"
    refused "$nowhere/$out: cannot be written" relight --world no.pfm --object no.obj -o "$nowhere/$out"
    refused "$nowhere/$out: cannot be written" relief render no.lmr -o "$nowhere/$out"
    refused "$nowhere/$out: cannot be written" mix --frame no -o "$nowhere/$out"
done
refused "$nowhere/x00.png: cannot be written" play no.gltf -o "$nowhere/x%02d.png"
refused "$nowhere/s.json: cannot be written" render no.gltf -o x.png --stats "$nowhere/s.json"
refused "$nowhere/x.lmt: cannot be written" bake no.gltf -o "$nowhere/x.lmt"
refused "$nowhere/x.lmp: cannot be written" pack no.gltf -o "$nowhere/x.lmp"
refused "$nowhere/x.lmr: cannot be written" relief bake no.gltf -o "$nowhere/x.lmr"
refused "$nowhere/x.png: cannot be written" compare no.png no.png --heat "$nowhere/x.png"
refused "$nowhere/x.svg: cannot be written" lambent-bench no.gltf --svg "$nowhere/x.svg"
mkdir -p folder.png
refused "folder.png: cannot be written: it is a folder" render no.gltf -o folder.png
ln -s nodir/x.png dangling.png
refused "dangling.png: cannot be written: the link's target" render no.gltf -o dangling.png
long=$(printf '%0300d' 0)
refused "cannot be written: File name too long" render no.gltf -o "$long.png"
if [ "$(id -u)" -ne 0 ]; then
    : >locked.png
    chmod 444 locked.png
    refused "locked.png: cannot be written" render no.gltf -o locked.png
    mkdir -p locked
    chmod 555 locked
    refused "locked/x.png: cannot be written" render no.gltf -o locked/x.png
else
    skip "files that may not be written: root may write all"
fi

# --- inputs are not overwritten, whatever their name ---

status 0 render demo $few -o demo.png
status 0 render demo $few -o demo.pfm
cp demo.png cloth.png
printf 'newmtl cloth\nmap_Kd cloth.png\n' >cloth.mtl
{ printf 'mtllib cloth.mtl\n'; sed 's/^f/usemtl cloth\nf/' box.obj; } >cloth.obj
cp cloth.obj scene.png
ln scene.png hard.png
ln -s scene.png soft.png
for kind in lmt lmr; do
    ln scene.png "scene.$kind"
done
ln -s cloth.png cloth.lmt
sum() { cat scene.png cloth.png cloth.mtl | cksum; }
kept=$(sum)
for out in scene.png hard.png soft.png ../outputs/scene.png; do
    misused "cannot be written: it is read by the same command" render scene.png $few -o "$out"
done
for in in hard.png soft.png; do
    misused "scene.lmt: cannot be written: it is read by the same command" bake "$in" -o scene.lmt
    misused "scene.lmr: cannot be written: it is read by the same command" relief bake "$in" -o scene.lmr
done
misused "cannot be written: it is read" render cloth.obj $few -o cloth.png
ln cloth.mtl cloth.json
misused "cannot be written: it is read" render cloth.obj $few -o x.png --stats cloth.json
misused "cannot be written: it is read" bake cloth.obj --elements 64 --receivers 64 -o cloth.lmt
misused "cannot be written: it is read" mix $seen --object cloth.obj -o cloth.png
misused "cannot be written: it is read" compare cloth.png demo.pfm --heat cloth.png
misused "cannot be written: it is read" relight --world cloth.png --cube cloth.png
cp cloth.png cloth01.png
misused "cloth01.png: cannot be written: it is read" play cloth.obj --size 16x16 --frames 2 --path cloth01.png -o cloth%02d.png
absent cloth00.png
check "what is read stays as it was" test "$(sum)" = "$kept"

# --- no file in a format of lambent under the name of another kind ---

for out in x.png X.PPM x.pfm x.hdr x.jpg x.jpeg x.gltf x.GLB x.obj x.mtl x.ply x.lmp x.lmr; do
    misused "$out: a .lmt file would be written, under the name of a" bake box.obj --elements 64 --receivers 64 -o "$out"
    absent "$out"
done
misused "x.lmt: a .lmp file would be written, under the name of a .lmt file; name it *.lmp" pack demo -o x.lmt
misused "--eye and --target are one place" render demo $few --eye 1,1,1 --target 1,1,1 -o y.png
misused "over 1048576 m from the origin" render demo $few --eye 3e6,1,1 --target 1,1,1 -o y.png
misused "they must not lie on one line" render demo $few --eye 1,1,1 --target 1,2,1 -o y.png
refused "is the view or a light over 1048576 m from the origin?" render demo $few --light point:2e6,0,0:0,-1,0:9,9,9 -o y.png
misused "--heat x.obj: a .png file would be written, under the name of a .obj file" compare demo.png demo.png --heat x.obj
misused "--stats x.ply: a .json file would be written, under the name of a .ply file" render demo $few -o y.png --stats x.ply
absent y.png
misused "x.png: a .lmr file would be written, under the name of a .png file; name it *.lmr" relief bake cloth.obj -o x.png
absent x.png
for out in room room.baked room.lmt ROOM.LMT png .lmt x.png.lmt; do
    status 0 bake box.obj --elements 64 --receivers 64 -q -o "$out"
    check "$out is a transfer" cmp -s "$out" room
done
misused "x.pfm: both -o and --stats; give each another name" render demo -o x.pfm --stats x.pfm
misused "both -o and --stats" render demo -o x.pfm --stats ./x.pfm
ln -s y.pfm x-link.pfm && : >y.pfm
misused "both -o and --stats" render demo -o y.pfm --stats x-link.pfm
rm -f x-link.pfm y.pfm
misused "both --cube and -o" relight --world demo --object demo --at 0,0,0 --cube - -o pfm:-
absent x.pfm

finish
