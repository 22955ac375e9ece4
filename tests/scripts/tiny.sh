# tiny.sh: checks that the tiny demo draws the same pictures on a Cortex-M4F under qemu as here, and measures the RAM.
# MAKE BUILD TOOL in the environment. Without a cross compiler or qemu it is skipped in `make check`, but fails if you
# run it directly.
. tests/scripts/checks.sh

if ! missing=$(sh tests/scripts/tools.sh need arm-none-eabi-gcc qemu-system-arm 2>&1); then
    skip "the demo on a Cortex-M4F: $missing"
    [ -n "$IN_CHECK" ] && finish
    exit 1
fi

# Here only the pictures count, so this build is plain C in one unit; statue.sh, live.sh and `make examples-tiny`
# share it.
plain="-DLMB_HAVE_AVX512=0 -DLMB_HAVE_AVX2=0 -DLMB_HAVE_SSE2=0"
make_here() { $MAKE "$@" PORT=host CONFIG=tiny BUILD="$BUILD/plain" ONE_UNIT=1 CFLAGS="-O1 $plain"; }
here=$BUILD/plain/tiny
check "the demo for this machine" make_here "$here/demo"
make_there() { $MAKE "$@" PORT=cortex-m CONFIG=tiny BUILD="$BUILD/cortex-m" CFLAGS=-Os LDFLAGS=; }
check "the demo for a Cortex-M4F" make_there "$BUILD/cortex-m/tiny/demo"
[ $failed -eq 0 ] || finish

"$here/demo" >"$here/demo.out"
check "exit status here: $?" test $? -eq 0
echo "here:"
sed 's/^/  /' "$here/demo.out"
hash_of() { awk '/^demo-/ { print $2 }' "$1"; }
is=$(hash_of "$here/demo.out")
check "the demo's picture" test -n "$is"
# make check-all leaves out this frame, which takes 6 s: that of the packed scene below is of the same size and kind.
if [ "${LMB_LONG:-2}" -ge 2 ]; then
    make_there run-demo >"$BUILD/cortex-m/tiny/demo.out"
    check "exit status on the Cortex-M4F: $?" test $? -eq 0
    echo "Cortex-M4F:"
    sed 's/^/  /' "$BUILD/cortex-m/tiny/demo.out"
    there=$(hash_of "$BUILD/cortex-m/tiny/demo.out")
    check "hashes differ: $is here, $there there" test "$is" = "$there"
fi

# A torus, with the bytes of the table of platform/README.md, and smaller pictures.
torus_of() { sed -n 's/ bytes .*instructions [0-9]*//p' "$1"; }
check "the torus for this machine" make_here "$here/torus_few"
check "the torus for a Cortex-M4F" make_there "$BUILD/cortex-m/tiny/torus_few"
[ $failed -eq 0 ] || finish
"$here/torus_few" >"$here/torus_few.out"
make_there run-torus_few >"$BUILD/cortex-m/tiny/torus_few.out"
sed 's/^/  /' "$BUILD/cortex-m/tiny/torus_few.out"
check "the torus differs" test "$(torus_of "$here/torus_few.out")" = "$(torus_of "$BUILD/cortex-m/tiny/torus_few.out")"
check "five pictures of the torus" test "$(torus_of "$BUILD/cortex-m/tiny/torus_few.out" | grep -c LMB_OK)" -eq 5
taken=$(sed -n 's/^direct 160 .*instructions \([0-9]*\) .*/\1/p' "$BUILD/cortex-m/tiny/torus_few.out")
check "${taken:-0} instructions for direct light on the torus, bound 32 million" test "${taken:-0}" -gt 1000000 -a "${taken:-0}" -le 32000000

# A packed scene with the settings of the table row for bounced light: the same memory, and the same picture on both
# machines.
scene=$BUILD/cortex-m/tiny/packed_scene.c
check "the demo is packed" "$TOOL" pack demo -o "$scene" --name scene_words -q
make_here run-scene PACKED="$scene" >"$here/scene.out" 2>&1
check "exit status of the packed scene here: $?" test $? -eq 0
make_there run-scene PACKED="$scene" >"$BUILD/cortex-m/tiny/scene.out" 2>&1
check "exit status of the packed scene on the Cortex-M4F: $?" test $? -eq 0
sed 's/^/  /' "$BUILD/cortex-m/tiny/scene.out"
scene_of() { sed -n 's/^scene-160x120-rgb565 //p' "$1"; }
is=$(scene_of "$here/scene.out") there=$(scene_of "$BUILD/cortex-m/tiny/scene.out")
check "packed scene: hashes differ: $is here, $there there" test -n "$is" -a "$is" = "$there"
row=$(sed -n 's/^bounced, fixed groups 160 bytes \([0-9]*\).*/\1/p' "$BUILD/cortex-m/tiny/torus_few.out")
kib=$(awk -F ' *[|] *' '$2 == "bounced light, fixed groups" { print $4 }' platform/README.md)
check "its frame takes what the torus does, $row bytes, $kib KiB in platform/README.md" \
    grep -q "^frame $row bytes ($kib KiB)" "$BUILD/cortex-m/tiny/scene.out"
finish
