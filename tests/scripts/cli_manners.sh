# cli_manners.sh: what every verb has in common: pipes, help, files that are refused before the work, a full disk,
# progress, threads. A part of cli.sh, whose functions and files it uses.

m=$dir/manners
mkdir -p "$m"
few="--size 32x24 --shadow-map 64 --quality draft"

# --- standard output and input ---

# piped WHAT FILE ARGUMENT...: with `-o -` in place of `-o FILE` the same bytes come from stdout, and words from stderr.
piped() {
    what=$1 file=$2
    shift 2
    status 0 "$@" -o "$m/$file"
    "$TOOL" "$@" -o "${pipe:--}" >"$m/pipe" 2>"$m/err.txt"
    check "$what -o ${pipe:--}: the bytes of the file" cmp "$m/$file" "$m/pipe"
}
piped "render demo" demo.png render demo $few
for format in ppm pfm hdr; do
    pipe=$format:-
    piped "render demo" demo.$format render demo $few
done
pipe=-
piped bake box.lmt bake "$dir/box.obj" --elements 64 --receivers 64
piped pack box.lmp pack "$dir/box.obj"
piped "relief bake" pit.lmr relief bake "$dir/pit.obj" --size 16 --triangles 20 --views 6
piped "relief render" pit.png relief render "$m/pit.lmr" --size 32x24
piped mix mixed.png mix $seen $tent
piped relight field.png relight --world demo --object demo --size 32x16
"$TOOL" relight --world demo --cube pfm:- 2>/dev/null >"$m/pipe"
check "relight --cube pfm:-" sh -c '"$1" info - <"$2" | grep -q "^size  *8x48$"' sh "$TOOL" "$m/pipe"
"$TOOL" render demo $few -q -o "$m/quiet.png" --stats - >"$m/pipe"
check "--stats -" grep -q '^  "width": 32, "height": 24' "$m/pipe"
"$TOOL" compare "$dir/demo.pfm" "$dir/half.pfm" --heat - >"$m/pipe" 2>"$m/err.txt"
check "sizes that differ leave stdout empty" test ! -s "$m/pipe"
"$TOOL" compare "$m/demo.png" "$m/demo.pfm" --heat - >"$m/pipe" 2>"$m/err.txt"
check "the heat picture alone is on stdout" sh -c '"$1" info - <"$2" | grep -q PNG && grep -q "^trim" "$3"' sh "$TOOL" "$m/pipe" "$m/err.txt"

# fed FILE ARGUMENT...: what the command writes, with `-` for FILE from stdin, is what it writes of the file.
fed() {
    file=$1
    shift
    "$TOOL" "$@" -q -o "$m/fed.ppm" <"$file" >"$m/out.txt" 2>&1 || fail "lambent $*: $(head -n 1 "$m/out.txt")"
    check "lambent $*: as of $file" cmp "$m/fed.ppm" "$m/file.ppm"
}
cp "$dir/odd.gltf" "$m/odd.gltf"
printf '%s\n' ply 'format ascii 1.0' 'element vertex 3' 'property float x' 'property float y' 'property float z' \
    'element face 1' 'property list uchar int vertex_indices' end_header '0 0 0' '1 0 0' '0 1 0' '3 0 1 2' >"$m/one.ply"
for scene in "$dir/box.obj" "$m/one.ply" "$m/odd.gltf"; do
    status 0 render "$scene" $few -q -o "$m/file.ppm"
    fed "$scene" render - $few
done
status 0 relief render "$m/pit.lmr" --size 32x24 -q -o "$m/file.ppm"
fed "$m/pit.lmr" relief render - --size 32x24
status 0 render "$dir/box.obj" $inside --transfer "$dir/box-1.lmt" -q -o "$m/file.ppm"
fed "$dir/box-1.lmt" render "$dir/box.obj" $inside --transfer -
status 0 mix $seen $tent -q -o "$m/file.ppm"
fed "$dir/photo.pfm" mix --photo - --depth "$dir/wall.pfm" --intrinsics 30,30,11.5,11.5 $tent
fed "$dir/wall.pfm" mix --photo "$dir/photo.pfm" --depth - --intrinsics 30,30,11.5,11.5 $tent
check "compare takes - for one" sh -c '"$1" compare - "$2" <"$2" | grep -q "exact 768 of 768"' sh "$TOOL" "$m/demo.png"
check "bake, plan and info take -" sh -c '"$1" bake - --elements 64 --receivers 64 -o - <"$2" | cmp - "$3" && "$1" plan - --size 32x24 <"$2" |
    grep -q "^bounced light" && "$1" info - <"$2" | grep -q "^triangles"' sh "$TOOL" "$dir/box.obj" "$m/box.lmt"
status 2 compare - - <"$m/demo.png"
said "-: standard input has been read; give one of both as a file"
status 1 render - -o "$m/bad.png" </dev/null
status 2 mix --photo - --depth - --intrinsics 30,30,11.5,11.5 $tent -o "$m/bad.png" <"$dir/photo.pfm"
said "-: standard input has been read; give one of both as a file"
status 2 relight --world demo --object demo --path "$dir/path.txt" -o -
status 2 render demo -o xyz:-
said "png:-, ppm:-, pfm:- or hdr:- for standard output"
for verb in render mix relight "relief render"; do
    status 0 $verb --help
    check "$verb --help: -o to standard output" sh -c 'tr -s "\n " " " <"$1" | grep -qF -e "-, ppm:-, pfm:-, hdr:- are standard output"' sh "$dir/out.txt"
done
status 2 render demo -o /dev/stdout

# --- help, the man page, the doctor ---

for verb in render bake play capture relight relief "relief bake" "relief render" mix plan compare info bench "bench raster" "bench gather" \
    "bench threads" "bench hard" "bench --calibrate" "bench SCENE" "bench relight" "bench relief" "bench mix" doctor; do
    "$TOOL" $verb --help >"$m/help.txt"
    status 0 help $verb
    check "help $verb is $verb --help" cmp "$m/help.txt" "$dir/out.txt"
    grep -oE '^  (-[a-zA-Z], )?--?[a-z][a-z0-9-]*' "$m/help.txt" | sed 's/.* //' >>"$m/options.txt"
done
status 0 help
check "help lists the verbs" grep -q '^  doctor ' "$dir/out.txt"
status 2 help rendr
said "did you mean render?"
status 0 help --man
cp "$dir/out.txt" "$m/lambent.1"
sed 's/\\-/-/g' "$m/lambent.1" >"$m/plain.1"
missing=$(sort -u "$m/options.txt" | while read -r option; do grep -qF -e "\\fB$option\\fR" "$m/plain.1" || echo "$option"; done)
check "options that the man page lacks: $missing" test -z "$missing" -a "$(grep -c . "$m/options.txt")" -gt 100
if command -v groff >/dev/null; then
    check "groff has a warning about the man page" sh -c 'test -z "$(groff -man -Tutf8 -ww -z "$1" 2>&1)"' sh "$m/lambent.1"
    check "the man page has its examples as they are" sh -c "groff -man -Tascii -rLL=150n \"\$1\" | grep -qF \"printf 'f %s\\\\n' '1 2 3' '1 4 2' '2 4 3' '3 4 1' >>tent.obj\"" sh "$m/lambent.1"
else
    skip "the man page: no groff"
fi
status 0 doctor -v
check "the doctor says what draws" sh -c 'grep -c "exact (.*), draws where none is named$" "$1" | grep -qx 1' sh "$dir/out.txt"
check "the doctor tries all lanes" grep -q '^scalar  *exact' "$dir/out.txt"
check "the doctor says the flags" grep -q '^flags .*-ffp-contract=off' "$dir/out.txt"
# One that expects other bytes: it says so, and its status is 1. Objects whose source is gone may lie about.
objects_of_tool() {
    for object in "$B"/obj/tools/*/*.o "$B"/obj/platform/host/*.o; do
        source=${object#"$B"/obj/}
        [ -e "${source%.o}.c" ] && echo "$object"
    done
}
if $CC $FLAGS '-DROOM_HASH=UINT64_C(1)' -I"$B" -c tools/cli/verb_doctor.c -o "$m/ill.o" &&
    $CC $FLAGS -o "$m/ill" $(objects_of_tool | grep -v -e verb_doctor -e port_host) "$m/ill.o" "$LIB" $LDLIBS; then
    "$m/ill" doctor >"$m/out.txt" 2>"$m/err.txt"
    check "a doctor that finds other bytes has status 1" test $? -eq 1
    check "and says so in one line" sh -c 'test "$(wc -l <"$1")" -eq 1 && grep -q "draws .* instead of 0000000000000001" "$1"' sh "$m/err.txt"
else
    fail "a doctor with another hash does not compile"
fi

# --- what cannot be written is refused before the work ---

# refused WORD ARGUMENT...: one line with the word, though the scene is not there either. misused: one file for two
# purposes, which is bad usage.
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
    check "lambent $*: one line" test "$(grep -c . "$dir/err.txt")" -eq 1 -a ! -s "$dir/out.txt"
}
nowhere=$m/nodir
for out in x.png x.pfm; do
    refused "$nowhere/$out: cannot be written" render "$m/no.gltf" -o "$nowhere/$out"
    refused "$nowhere/$out: cannot be written" relight --world "$m/no.pfm" --cube "$nowhere/$out"
    refused "$nowhere/$out: cannot be written" relight --world "$m/no.pfm" --map "$nowhere/$out"
    refused "$nowhere/$out: cannot be written" relight --world "$m/no.pfm" --object "$m/no.obj" -o "$nowhere/$out"
    refused "$nowhere/$out: cannot be written" relief render "$m/no.lmr" -o "$nowhere/$out"
    refused "$nowhere/$out: cannot be written" mix --frame "$m/no" -o "$nowhere/$out"
done
refused "$nowhere/x00.png: cannot be written" play "$m/no.gltf" -o "$nowhere/x%02d.png"
refused "$nowhere/s.json: cannot be written" render "$m/no.gltf" -o "$m/x.png" --stats "$nowhere/s.json"
refused "$nowhere/x.lmt: cannot be written" bake "$m/no.gltf" -o "$nowhere/x.lmt"
refused "$nowhere/x.lmp: cannot be written" pack "$m/no.gltf" -o "$nowhere/x.lmp"
refused "$nowhere/x.lmr: cannot be written" relief bake "$m/no.gltf" -o "$nowhere/x.lmr"
refused "$nowhere/x.png: cannot be written" compare "$m/no.png" "$m/no.png" --heat "$nowhere/x.png"
refused "$nowhere/x.svg: cannot be written" bench "$m/no.gltf" --svg "$nowhere/x.svg"
mkdir -p "$m/folder.png"
refused "folder.png: cannot be written: it is a folder" render "$m/no.gltf" -o "$m/folder.png"
ln -s nodir/x.png "$m/dangling.png"
refused "dangling.png: cannot be written: the link's target" render "$m/no.gltf" -o "$m/dangling.png"
long=$(printf '%0300d' 0)
refused "cannot be written: File name too long" render "$m/no.gltf" -o "$m/$long.png"
if [ "$(id -u)" -ne 0 ]; then
    : >"$m/locked.png"
    chmod 444 "$m/locked.png"
    refused "locked.png: cannot be written" render "$m/no.gltf" -o "$m/locked.png"
    mkdir -p "$m/locked"
    chmod 555 "$m/locked"
    refused "locked/x.png: cannot be written" render "$m/no.gltf" -o "$m/locked/x.png"
else
    skip "files that may not be written: root may write all"
fi

# --- what is read is not written over, whatever its name ---

cp "$m/demo.png" "$m/cloth.png"
printf 'newmtl cloth\nmap_Kd cloth.png\n' >"$m/cloth.mtl"
{ printf 'mtllib cloth.mtl\n'; sed 's/^f/usemtl cloth\nf/' "$dir/box.obj"; } >"$m/cloth.obj"
cp "$m/cloth.obj" "$m/scene.png"
ln "$m/scene.png" "$m/hard.png"
ln -s scene.png "$m/soft.png"
for kind in lmt lmr; do
    ln "$m/scene.png" "$m/scene.$kind"
done
ln -s cloth.png "$m/cloth.lmt"
sum() { cat "$m/scene.png" "$m/cloth.png" "$m/cloth.mtl" | cksum; }
kept=$(sum)
for out in scene.png hard.png soft.png ../manners/scene.png; do
    misused "cannot be written: it is read by the same command" render "$m/scene.png" $few -o "$m/$out"
done
for in in hard.png soft.png; do
    misused "scene.lmt: cannot be written: it is read by the same command" bake "$m/$in" -o "$m/scene.lmt"
    misused "scene.lmr: cannot be written: it is read by the same command" relief bake "$m/$in" -o "$m/scene.lmr"
done
misused "cannot be written: it is read" render "$m/cloth.obj" $few -o "$m/cloth.png"
ln "$m/cloth.mtl" "$m/cloth.json"
misused "cannot be written: it is read" render "$m/cloth.obj" $few -o "$m/x.png" --stats "$m/cloth.json"
misused "cannot be written: it is read" bake "$m/cloth.obj" --elements 64 --receivers 64 -o "$m/cloth.lmt"
misused "cannot be written: it is read" mix $seen --object "$m/cloth.obj" -o "$m/cloth.png"
misused "cannot be written: it is read" compare "$m/cloth.png" "$m/demo.pfm" --heat "$m/cloth.png"
misused "cannot be written: it is read" relight --world "$m/cloth.png" --cube "$m/cloth.png"
cp "$m/cloth.png" "$m/cloth01.png"
misused "cloth01.png: cannot be written: it is read" play "$m/cloth.obj" --size 16x16 --frames 2 --path "$m/cloth01.png" -o "$m/cloth%02d.png"
absent "$m/cloth00.png"
check "what is read stays as it was" test "$(sum)" = "$kept"

# --- no file of lambent's own under the name of another kind ---

for out in x.png X.PPM x.pfm x.hdr x.jpg x.jpeg x.gltf x.GLB x.obj x.mtl x.ply x.lmp x.lmr; do
    misused "$out: a .lmt file would be written, under the name of a" bake "$dir/box.obj" --elements 64 --receivers 64 -o "$m/$out"
    absent "$m/$out"
done
misused "x.lmt: a .lmp file would be written, under the name of a .lmt file; name it *.lmp" pack demo -o "$m/x.lmt"
misused "--eye and --target are one place" render demo $few --eye 1,1,1 --target 1,1,1 -o "$m/y.png"
misused "over 1048576 m from the origin" render demo $few --eye 3e6,1,1 --target 1,1,1 -o "$m/y.png"
misused "they must not lie on one line" render demo $few --eye 1,1,1 --target 1,2,1 -o "$m/y.png"
refused "is the view or a light over 1048576 m from the origin?" render demo $few --light point:2e6,0,0:0,-1,0:9,9,9 -o "$m/y.png"
misused "--heat $m/x.obj: a .png file would be written, under the name of a .obj file" compare "$m/demo.png" "$m/demo.png" --heat "$m/x.obj"
misused "--stats $m/x.ply: a .json file would be written, under the name of a .ply file" render demo $few -o "$m/y.png" --stats "$m/x.ply"
absent "$m/y.png"
misused "x.png: a .lmr file would be written, under the name of a .png file; name it *.lmr" relief bake "$m/cloth.obj" -o "$m/x.png"
absent "$m/x.png"
for out in room room.baked room.lmt ROOM.LMT png .lmt x.png.lmt; do
    status 0 bake "$dir/box.obj" --elements 64 --receivers 64 -q -o "$m/$out"
    check "$out is a transfer" cmp -s "$m/$out" "$m/room"
done
misused "x.pfm: both -o and --stats; give them names of their own" render demo -o "$m/x.pfm" --stats "$m/x.pfm"
misused "both -o and --stats" render demo -o "$m/x.pfm" --stats "$m/./x.pfm"
ln -s y.pfm "$m/x-link.pfm" && : >"$m/y.pfm"
misused "both -o and --stats" render demo -o "$m/y.pfm" --stats "$m/x-link.pfm"
rm -f "$m/x-link.pfm" "$m/y.pfm"
misused "both --cube and -o" relight --world demo --object demo --at 0,0,0 --cube - -o pfm:-
absent "$m/x.pfm"

# --- a full disk, a stdout that is closed ---

if [ -e /dev/full ]; then
    full() {
        "$TOOL" "$@" >/dev/full 2>"$m/err.txt"
        got=$?
        check "lambent $* >/dev/full: exit status $got" test $got -eq 1
        check "lambent $* >/dev/full: one line" test "$(grep -c -e 'cannot be written' -e 'could not be written' "$m/err.txt")" -eq 1
    }
    full --version
    full --help
    full help render
    full help --man
    full render --help
    full doctor
    full render demo $few -o "$m/x.png"
    full render demo $few -q -o -
    full render demo $few -q -o "$m/x.png" --stats -
    full plan demo --size 32x24
    full plan demo --size 32x24 --json
    full bake "$dir/box.obj" --elements 64 --receivers 64 -o "$m/x.lmt"
    full bake "$dir/box.obj" --elements 64 --receivers 64 -q -o -
    full pack "$dir/box.obj" -o "$m/x.lmp"
    full pack "$dir/box.obj" -q -o -
    full play "$dir/box.obj" --size 16x16 --quality draft --frames 2
    full relief bake "$dir/pit.obj" --size 16 --triangles 20 --views 6 -o "$m/x.lmr"
    full relief render "$m/pit.lmr" --size 32x24 -o "$m/x.png"
    full relight --world demo --object demo --size 16x8 --path "$dir/path.txt" -o "$m/x.ppm"
    printf "0 camera 0,0,9 0,0,0\n" >"$m/keys.txt"
    full relief render "$m/pit.lmr" --size 16x8 --path "$m/keys.txt" -o "$m/x.ppm"
    full mix $seen $tent -q -o -
    full info "$m/demo.png"
    full compare "$m/demo.png" "$m/demo.png"
    full bench raster fill-depth --seconds 0.01
    full bench gather --backend scalar --seconds 0.01
    full bench hard mixed
    full bench --calibrate --threads 1
    full bench "$dir/box.obj" --size 16x16 --shadow-map 64 --runs 1 --sweep tree=8 --breakdown 0 --cache "$m/kept"
else
    skip "a full disk: no /dev/full"
fi
sh -c '"$1" doctor >&-' sh "$TOOL" 2>"$m/err.txt"
check "a closed stdout is exit status 1" test $? -eq 1
sh -c '"$1" render demo --size 16x16 --shadow-map 64 -o "$2" >&- 2>/dev/null' sh "$TOOL" "$m/closed.png"
check "no words land in a file instead" sh -c '"$1" info "$2" >/dev/null && ! grep -aq triangles "$2"' sh "$TOOL" "$m/closed.png"

# --- progress, and Ctrl-C in it ---

# watched WANTED SIGNAL ARGUMENT...: on a terminal, until the signal comes after some seconds; the screen in screen.txt.
# Once more, for longer, where WANTED is not on it by then, as on a busy machine.
watched() {
    wanted=$1 sent=$2
    shift 2
    for seconds in 4 60; do
        (cd "$m" && script -qec "timeout --foreground --preserve-status -s $sent $seconds $lambent $*" screen.txt >/dev/null 2>&1 </dev/null)
        ended=$?
        grep -aqE "$wanted" "$m/screen.txt" && break
    done
    return $ended
}
if command -v script >/dev/null && script -qec true /dev/null >/dev/null 2>&1; then
    watched "[0-9] %" INT render demo --size 4096x4096 --quality best --threads 1 -o long.png
    check "Ctrl-C is exit status 130" test $? -eq 130
    check "progress has percent" grep -aqE 'lambent render: [a-zA-Z ]* [0-9]+ %' "$m/screen.txt"
    check "Ctrl-C wipes the line" sh -c 'tail -n 2 "$1" | tr "\r" "\n" | grep -av Script | grep -a . | tail -n 1 | grep -aqv "%"' sh "$m/screen.txt"
    watched "bake: [a-z ]* [0-9]+ %" TERM bake demo --threads 1 -o long.lmt
    check "TERM is exit status 143" test $? -eq 143
    check "bake tells percent" grep -aqE 'lambent bake: [a-z ]* [0-9]+ %' "$m/screen.txt"
    watched "frames [0-9]+ %" HUP play demo --size 16x16 --quality draft --frames 100000
    check "HUP is exit status 129" test $? -eq 129
    check "play tells percent and seconds" grep -aqE 'lambent play: frames [0-9]+ %' "$m/screen.txt"
    watched "" INT render demo --size 4096x4096 --quality best --threads 1 -q -o long.png
    check "no progress with -q" sh -c '! grep -aq "%" "$1"' sh "$m/screen.txt"
    (cd "$m" && timeout --preserve-status -s INT 3 "$lambent" render demo --size 4096x4096 --quality best -o long.png >out.txt 2>err.txt)
    check "no progress where stderr is no terminal" sh -c '! grep -q "%" "$1"' sh "$m/err.txt"
    watched "(s|min) left" INT play demo --size 16x16 --quality draft --threads 1 --frames 20000
    check "seconds left are told" grep -aqE 'frames [0-9]+ %, [0-9]+ (s|min) left' "$m/screen.txt"
    left=$(ls -A "$m" | grep -e long -e '\.tmp$')
    check "left behind: $left" test -z "$left"
else
    skip "progress: no script(1)"
fi

# --- threads ---

for verb in render bake play capture relight "relief bake" "relief render" mix plan "bench threads" "bench --calibrate"; do
    status 0 $verb --help
    check "$verb has --threads" grep -q '^  --threads N' "$dir/out.txt"
done
# any FILE ARGUMENT...: the same bytes by one thread and by three.
any() {
    file=$1
    shift
    status 0 "$@" --threads 1 -o "$m/one-$file"
    status 0 "$@" --threads 3 -o "$m/three-$file"
    check "threads change lambent $*" cmp "$m/one-$file" "$m/three-$file"
}
any e.pfm capture demo --at 0.6,1.1,0.2 --faces 8 --shadow-map 128 --quality draft
any a.pfm relight --world demo --object demo --size 64x48
any b.pfm relief render "$m/pit.lmr" --with "$dir/floor.obj" --bounce --size 64x48
any c.lmr relief bake "$dir/pit.obj" --size 32 --triangles 20
any d.pfm mix $seen $tent --roughness 0.2,0.5
