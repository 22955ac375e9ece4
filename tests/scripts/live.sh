# live.sh: frames of the demo with moving light, in 160 KiB of RAM on a Cortex-M4F under qemu and here: checks for equal
# pictures, and prints instructions, ROM and RAM of each. MAKE BUILD TOOL in the environment. Without cross compiler or
# qemu: as tiny.sh.
. tests/scripts/checks.sh

if ! missing=$(sh tests/scripts/tools.sh need arm-none-eabi-gcc qemu-system-arm 2>&1); then
    skip "light that moves on a Cortex-M4F: $missing"
    [ -n "$IN_CHECK" ] && finish
    exit 1
fi

here=$BUILD/plain/tiny there=$BUILD/cortex-m/live/tiny
mkdir -p "$here" "$there"
check "the demo is baked" "$TOOL" bake demo -o "$here/demo.lmt" --elements 256 --receivers 300 --cluster 0.6 --error 0.00065 --once
od -An -v -tx4 "$here/demo.lmt" | sed 's/ *\([0-9a-f][0-9a-f]*\)/0x\1,/g' >"$here/baked.new"
for to in "$here" "$there"; do
    cmp -s "$here/baked.new" "$to/baked.inc" || cp "$here/baked.new" "$to/baked.inc"
done

without='-DLMB_TREES=0 -DLMB_TRANSFER=1 -DLMB_PROBES=0 -DLMB_RELIEF=0 -DLMB_MIXED=0 -DLMB_VOXELS=0 -DLMB_PLAN=0'
without="$without -DLMB_MAX_CUT=6 -DLMB_MANY_LIGHTS_CUT=16"
# The build for this machine is that of tiny.sh. It has all of the library, so the switches must not change a picture.
plain="-DLMB_HAVE_AVX512=0 -DLMB_HAVE_AVX2=0 -DLMB_HAVE_SSE2=0"
make_here() { $MAKE "$@" PORT=host CONFIG=tiny BUILD="$BUILD/plain" ONE_UNIT=1 CFLAGS="-O1 $plain"; }
make_there() { $MAKE "$@" PORT=cortex-m CONFIG=tiny BUILD="$BUILD/cortex-m/live" CFLAGS="-O2 $without" LDFLAGS=; }
programs='live baked gouraud'
check "for this machine" make_here $(for p in $programs; do echo "$here/$p"; done)
check "for a Cortex-M4F" make_there $(for p in $programs; do echo "$there/$p"; done)
[ $failed -eq 0 ] || finish

taken() { awk '/^instructions / { print $2 }' "$there/$1.out"; }
# bound NAME INSTRUCTIONS MAXIMUM, in thousands.
bound() {
    check "$1: $2 instructions, bound $3,000" test "${2:-0}" -gt 100000 -a "$(((${2:-0} + 999) / 1000))" -le "$3"
}

for p in $programs; do
    "$here/$p" >"$here/$p.out"
    check "$p: exit status here: $?" test $? -eq 0
    make_there "run-$p" >"$there/$p.out"
    check "$p: exit status on the Cortex-M4F: $?" test $? -eq 0
    hash_here=$(awk '/^demo-/ { print $2 }' "$here/$p.out")
    hash_there=$(awk '/^demo-/ { print $2 }' "$there/$p.out")
    check "$p: hashes differ: $hash_here here, $hash_there there" test -n "$hash_here" -a "$hash_here" = "$hash_there"
    sed 's/^/  /' "$there/$p.out"
    arm-none-eabi-size "$there/$p" | awk 'NR == 2 { print "  rom " $1 + $2 " bytes" }'
done
bound "direct light" "$(taken live)" 70000
bound "baked light on top of it" $(($(taken baked) - $(taken live))) 25000
bound "light at corners" "$(taken gouraud)" 13000
bound "light at corners, where the light stands still" "$(awk '/^instructions / { print $NF }' "$there/gouraud.out")" 6200
finish
