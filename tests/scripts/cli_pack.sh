# cli_pack.sh: packed scenes: what they become in either form and byte order, and whether all draw the same. A part of
# cli.sh, whose functions and files it uses; CC FLAGS LIB LDLIBS in the environment.

p=$dir/pack
mkdir -p "$p"
shows="--size 64x48 --shadow-map 64 --show direct"

# The same picture from the file, from the array that is linked in, and from the other path to the same words.
status 0 pack demo -o "$p/demo.lmp" --report
check "pack tells the bytes of each part" grep -q '  indices  *[0-9]* bytes' "$dir/out.txt"
check "and their sum, which is the file's" grep -q "  in all  *$(wc -c <"$p/demo.lmp" | tr -d ' ') bytes" "$dir/out.txt"
check "pack says how far vertices moved" grep -q 'vertices moved by up to 0.000[0-9]* m' "$dir/out.txt"
status 0 render "$p/demo.lmp" $shows -o "$p/tool.pfm"
status 0 pack demo -o "$p/demo-1.c" --name scene_words
status 0 pack "$p/demo.lmp" -o "$p/again.lmp"
check "a packed scene stays as it is" cmp "$p/demo.lmp" "$p/again.lmp"
status 0 pack "$p/demo.lmp" -o "$p/demo-2.c" --name scene_words
check "an array has the words of the file" cmp "$p/demo-1.c" "$p/demo-2.c"
check "a program with the array compiles" $CC $FLAGS -DLINKED -o "$p/linked" tests/scripts/packed.c "$p/demo-1.c" "$LIB" $LDLIBS
check "a linked scene opens and is drawn" "$p/linked" "$p/linked.pfm"
check "it has the tool's picture" cmp "$p/linked.pfm" "$p/tool.pfm"
check "a loaded scene has it, too" sh -c '"$1/linked" "$1/loaded.pfm" 0 "$1/demo.lmp" && cmp "$1/loaded.pfm" "$1/tool.pfm"' sh "$p"
status 0 pack demo -o "$p/kept.lmp" --position-error 0 --textures rgba8 --order file
status 0 render demo $shows -o "$p/source.pfm"
status 0 render "$p/kept.lmp" $shows -o "$p/kept.pfm"
check "what loses nothing has the source's picture" cmp "$p/source.pfm" "$p/kept.pfm"
status 0 compare "$p/tool.pfm" "$p/source.pfm" --max trim=0.02

# What moves is where the tool has it.
status 0 pack "$dir/moving.gltf" -o "$p/moving.lmp"
status 0 play "$p/moving.lmp" $shows --fps 2 --frames 3 -o "$p/tool_%02d.pfm"
for frame in 0 1 2; do
    check "frame $frame is posed" "$p/linked" "$p/posed.pfm" $(awk "BEGIN { print $frame / 2 }") "$p/moving.lmp"
    check "frame $frame is that of the library" cmp "$p/posed.pfm" "$p/tool_0$frame.pfm"
done
check "it moves" sh -c '! cmp -s "$1/tool_00.pfm" "$1/tool_02.pfm"' sh "$p"

# Either byte order from this machine, and the other one refused by its name.
status 0 pack "$dir/moving.gltf" -o "$p/little.lmp" --endian little
status 0 pack "$dir/moving.gltf" -o "$p/big.lmp" --endian big
check "the orders have as many bytes" test "$(wc -c <"$p/little.lmp")" -eq "$(wc -c <"$p/big.lmp")"
check "the words of head and table are turned round, but the checksum" sh -c '
    od -An -v -tx1 -w4 -j4 -N92 "$1" | sed 7d >"$1.txt"; od -An -v -tx1 -w4 -j4 -N92 "$2" | sed 7d | awk "{ print \" \" \$4, \$3, \$2, \$1 }" |
    cmp -s - "$1.txt"' sh "$p/little.lmp" "$p/big.lmp"
cmp -s "$p/little.lmp" "$p/moving.lmp" && other=big || other=little
status 1 render "$p/$other.lmp" $small -o "$p/bad.png"
said "$other.lmp: packed for $other-endian machines, unlike this one; pack it with --endian"
{ printf 'LMP\011'; tail -c +5 "$p/demo.lmp"; } >"$p/new.lmp"
status 1 info "$p/new.lmp"
said "new.lmp: a packed scene of version 9, and this reads version 1"
head -c 5000 "$p/demo.lmp" >"$p/cut.lmp"
status 1 info "$p/cut.lmp"
said "cut.lmp: a packed scene of"
{ head -c 200 "$p/demo.lmp"; head -c 600 /dev/zero | tr '\000' '\377'; tail -c +801 "$p/demo.lmp"; } >"$p/damaged.lmp"
status 1 info "$p/damaged.lmp"
said "damaged.lmp: a damaged packed scene"
# Wherever it is cut, and wherever one bit of it is another: one line, status 1, and no picture.
broken() {
    rm -f "$p/broken.png"
    status 1 info "$p/broken.lmp"
    status 1 render "$p/broken.lmp" $small -o "$p/broken.png"
    check "$1: no picture" test ! -e "$p/broken.png"
}
size=$(wc -c <"$p/demo.lmp" | tr -d ' ')
for cut in 0 1 3 4 8 31 32 215 216 $((size - 4)) $((size - 1)); do
    head -c "$cut" "$p/demo.lmp" >"$p/broken.lmp"
    broken "cut after $cut bytes"
done
for at in 0 4 8 15 16 31 36 40 47; do
    { head -c "$at" "$p/demo.lmp"; printf '\377'; tail -c +$((at + 2)) "$p/demo.lmp"; } >"$p/broken.lmp"
    broken "another byte at $at"
done
for k in 1 2 3 4 5 6 7 8 9 10 11 12; do
    bit "$p/demo.lmp" $((size * k / 13)) "$p/broken.lmp"
    broken "another bit at $((size * k / 13))"
done
status 0 info "$p/demo.lmp"
check "info knows packed scenes" grep -q 'demo.lmp: LMP$' "$dir/out.txt"

# Baked light: of what was packed, within the file.
status 0 bake "$p/demo.lmp" -o "$p/demo.lmt" --elements 64 --receivers 200
status 0 pack "$p/demo.lmp" --transfer "$p/demo.lmt" -o "$p/lit.lmp" --report
check "its bytes are told" grep -q '  transfer  *[0-9]* bytes' "$dir/out.txt"
status 0 render "$p/demo.lmp" $small --transfer "$p/demo.lmt" -o "$p/beside.pfm"
status 0 render "$p/lit.lmp" $small --transfer "$p/lit.lmp" -o "$p/within.pfm"
check "light within the file is that beside it" cmp "$p/beside.pfm" "$p/within.pfm"
status 1 render "$p/demo.lmp" $small --transfer "$p/demo.lmp" -o "$p/bad.pfm"
said "demo.lmp: a packed scene without baked light"
for file in demo.lmt lit.lmp; do
    bit "$p/$file" $(($(wc -c <"$p/$file") - 99)) "$p/bit.lmt"
    status 1 render "$p/demo.lmp" $small --transfer "$p/bit.lmt" -o "$p/bad.pfm"
    said "bit.lmt: a damaged"
done
status 0 bake demo -o "$p/source.lmt" --elements 64 --receivers 200
status 1 pack demo --transfer "$p/source.lmt" -o "$p/bad.lmp"
said "source.lmt: baked from another scene than what demo becomes here; pack it"
status 1 pack demo --transfer "$p/demo.pfm" -o "$p/bad.lmp"

# Usage.
status 2 pack
status 2 pack demo
said "no output given; add -o FILE.lmp"
status 2 pack demo -o "$p/bad.lmp" --name x
status 2 pack demo -o "$p/bad.c" --name 2x
said "is no name in C"
status 0 pack demo -o "$p/1x-y.c"
check "an array's name begins with a letter" grep -q 'scene_1x_y\[' "$p/1x-y.c"
status 2 pack "$p/demo.lmp" -o "$p/bad.lmp" --position-error 0.1
said "a packed scene stays as it is"
status 2 pack demo -o "$p/bad.lmp" --endian middle
status 2 pack demo -o "$p/bad.lmp" --textures dxt
status 2 pack demo -o "$p/bad.lmp" --glossy
status 1 pack "$p/nowhere.glb" -o "$p/bad.lmp"
status 1 pack demo -o "$p/nowhere/bad.lmp"
check "nothing bad was packed" sh -c '! ls "$1"/bad* 2>/dev/null | grep -q .' sh "$p"
