# pack.sh: packed scenes in both forms and byte orders, and whether all draw the same. Needs CC FLAGS LIB LDLIBS.
. tests/cli/common.sh

moving

shows="--size 64x48 --shadow-map 64 --show direct"

# The file, the linked array and a C file made from the packed file give the same picture.
status 0 pack demo -o demo.lmp --report
check "pack tells the bytes of each part" grep -q '  indices  *[0-9]* bytes' out.txt
check "and their sum, which is the file's" grep -q "  in all  *$(wc -c <demo.lmp | tr -d ' ') bytes" out.txt
check "pack says how far vertices moved" grep -q 'vertices moved by up to 0.000[0-9]* m' out.txt
status 0 render demo.lmp $shows -o tool.pfm
status 0 pack demo -o demo-1.c --name scene_words
status 0 pack demo.lmp -o again.lmp
check "a packed scene stays as it is" cmp demo.lmp again.lmp
status 0 pack demo.lmp -o demo-2.c --name scene_words
check "an array has the words of the file" cmp demo-1.c demo-2.c
check "a program with the array compiles" compile -DLINKED -o "$PWD/linked" tests/scripts/packed.c "$PWD/demo-1.c" "$LIB" $LDLIBS
check "a linked scene opens and is drawn" ./linked linked.pfm
check "it has the tool's picture" cmp linked.pfm tool.pfm
check "a loaded scene has it, too" sh -c '"$1/linked" "$1/loaded.pfm" 0 "$1/demo.lmp" && cmp "$1/loaded.pfm" "$1/tool.pfm"' sh .
status 0 pack demo -o kept.lmp --position-error 0 --textures rgba8 --order file
status 0 render demo $shows -o source.pfm
status 0 render kept.lmp $shows -o kept.pfm
check "what loses nothing has the source's picture" cmp source.pfm kept.pfm
status 0 compare tool.pfm source.pfm --max trim=0.02

# Animated parts are at the same places as in the tool.
status 0 pack moving.gltf -o moving.lmp
status 0 play moving.lmp $shows --fps 2 --frames 3 -o tool_%02d.pfm
for frame in 0 1 2; do
    check "frame $frame is posed" ./linked posed.pfm $(awk "BEGIN { print $frame / 2 }") moving.lmp
    check "frame $frame is that of the library" cmp posed.pfm "tool_0$frame.pfm"
done
check "it moves" sh -c '! cmp -s "$1/tool_00.pfm" "$1/tool_02.pfm"' sh .

# Either byte order can be written; the other order is refused with a message that names it.
status 0 pack moving.gltf -o little.lmp --endian little
status 0 pack moving.gltf -o big.lmp --endian big
check "the orders have as many bytes" test "$(wc -c <little.lmp)" -eq "$(wc -c <big.lmp)"
check "the words of head and table are turned round, but the checksum" sh -c '
    od -An -v -tx1 -w4 -j4 -N92 "$1" | sed 7d >"$1.txt"; od -An -v -tx1 -w4 -j4 -N92 "$2" | sed 7d | awk "{ print \" \" \$4, \$3, \$2, \$1 }" |
    cmp -s - "$1.txt"' sh little.lmp big.lmp
cmp -s little.lmp moving.lmp && other=big || other=little
status 1 render "$other.lmp" $small -o bad.png
said "$other.lmp: packed for $other-endian machines, unlike this one; pack it with --endian"
{ printf 'LMP\011'; tail -c +5 demo.lmp; } >new.lmp
status 1 info new.lmp
said "new.lmp: a packed scene of version 9, and this reads version 1"
head -c 5000 demo.lmp >cut.lmp
status 1 info cut.lmp
said "cut.lmp: a packed scene of"
{ head -c 200 demo.lmp; head -c 600 /dev/zero | tr '\000' '\377'; tail -c +801 demo.lmp; } >damaged.lmp
status 1 info damaged.lmp
said "damaged.lmp: a damaged packed scene"
# A file cut at any place, or with any flipped bit: one line, status 1, and no picture.
broken() {
    rm -f broken.png
    status 1 info broken.lmp
    status 1 render broken.lmp $small -o broken.png
    check "$1: no picture" test ! -e broken.png
}
size=$(wc -c <demo.lmp | tr -d ' ')
for cut in 0 1 3 4 8 31 32 215 216 $((size - 4)) $((size - 1)); do
    head -c "$cut" demo.lmp >broken.lmp
    broken "cut after $cut bytes"
done
for at in 0 4 8 15 16 31 36 40 47; do
    { head -c "$at" demo.lmp; printf '\377'; tail -c +$((at + 2)) demo.lmp; } >broken.lmp
    broken "another byte at $at"
done
for k in 1 2 3 4 5 6 7 8 9 10 11 12; do
    bit demo.lmp $((size * k / 13)) broken.lmp
    broken "another bit at $((size * k / 13))"
done
status 0 info demo.lmp
check "info knows packed scenes" grep -q 'demo.lmp: LMP$' out.txt

# Baked light of the packed scene, inside the file.
status 0 bake demo.lmp -o demo.lmt --elements 256 --receivers 200 --cluster 0.6
status 0 pack demo.lmp --transfer demo.lmt -o lit.lmp --report
check "its bytes are told" grep -q '  transfer  *[0-9]* bytes' out.txt
status 0 render demo.lmp $small --transfer demo.lmt -o beside.pfm
status 0 render lit.lmp $small --transfer lit.lmp -o within.pfm
check "light within the file is that beside it" cmp beside.pfm within.pfm
status 1 render demo.lmp $small --transfer demo.lmp -o bad.pfm
said "demo.lmp: a packed scene without baked light"
for file in demo.lmt lit.lmp; do
    bit "$file" $(($(wc -c <"$file") - 99)) bit.lmt
    status 1 render demo.lmp $small --transfer bit.lmt -o bad.pfm
    said "bit.lmt: a damaged"
done
status 0 bake demo -o source.lmt --elements 256 --receivers 200 --cluster 0.6
status 1 pack demo --transfer source.lmt -o bad.lmp
said "source.lmt: baked from another scene than what demo becomes here; pack it"
status 1 pack demo --transfer demo.pfm -o bad.lmp

# Usage.
status 2 pack
status 2 pack demo
said "no output given; add -o FILE.lmp"
status 2 pack demo -o bad.lmp --name x
status 2 pack demo -o bad.c --name 2x
said "is no name in C and C++"
status 0 pack demo -o 1x-y.c
check "an array's name begins with a letter" grep -q 'scene_1x_y\[' 1x-y.c
# Names that C, C++, their libraries, the compiler or lambent use are refused as --name, and changed if they come from a
# file name.
for name in isnan isinf HUGE_VAL INFINITY NAN M_PI FILE time_t jmp_buf sig_atomic_t fenv_t PRIu64 SCNx8 SEEK_SET LONG_MAX FP_NAN \
    sizeof int restrict _Bool _x __x a__b x_ class namespace co_await alignas asm typeof std main memcpy printf sinf \
    hypotl uint32_t int_fast8_t INT8_MAX UINT64_C SIZE_MAX NULL EDOM SIGINT linux unix errno size_t write lmb_scene LMB_OK \
    1x 'a b' 'x;y' "$(printf '\303\274')" aaaaaaaaaabbbbbbbbbbccccccccccddddddddddeeeeeeeeeeffffffffffgggg; do
    status 2 pack demo -q -o bad.c --name "$name"
    said "--name: \`$name\` is no name in C and C++: "
done
absent bad.c
mkdir -p names
for pair in sizeof:scene_sizeof class:scene_class memcpy:scene_memcpy lmb_x:scene_lmb_x linux:scene_linux _x:scene_x :scene \
    ___:scene a__b:a_b a-b.old:a_b 'two words':two_words "$(printf '\303\274n')":scene_n 7:scene_7 town:town sinf:scene_sinf \
    aaaaaaaaaabbbbbbbbbbccccccccccddddddddddeeeeeeeeeeffffffffffgggg:aaaaaaaaaabbbbbbbbbbccccccccccddddddddddeeeeeeeeeeffffffffffggg; do
    status 0 pack demo -q -o "names/${pair%:*}.c"
    check "${pair%:*}.c has the array ${pair##*:}" grep -q "^const uint32_t ${pair##*:}\[\] = {" "names/${pair%:*}.c"
done
for file in names/sizeof.c names/class.c names/memcpy.c names/linux.c names/.c names/7.c; do
    check "$file is C" compile -Wall -Wextra -pedantic -Werror -c -o "$PWD/names/c.o" "$PWD/$file"
    check "$file is C of GNU" compile -std=gnu99 -Wall -Wextra -Werror -c -o "$PWD/names/c.o" "$PWD/$file"
    if command -v g++ >/dev/null; then
        check "$file is C++" g++ -Wall -Wextra -pedantic -Werror -c -x c++ -o names/cpp.o "$file"
    fi
done
status 2 pack demo.lmp -o bad.lmp --position-error 0.1
said "a packed scene stays as it is"
status 2 pack demo -o bad.lmp --endian middle
status 2 pack demo -o bad.lmp --textures dxt
status 2 pack demo -o bad.lmp --glossy
status 1 pack nowhere.glb -o bad.lmp
status 1 pack demo -o nowhere/bad.lmp
check "nothing bad was packed" none bad*

finish
