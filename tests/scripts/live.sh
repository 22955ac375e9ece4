# live.sh: checks that frames of the demo with moving light are equal on a Cortex-M4F under qemu and here: in 160 KiB of
# RAM, and in 320 KiB with bounced light that is not baked. Prints instructions, ROM and RAM of each. MAKE BUILD TOOL in
# the environment. Without cross compiler or qemu: as tiny.sh.
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

# Bounced light with occlusion, lamp and object moving, nothing baked: a build of its own, with LMB_LIVE_CUT 64.
small='-DLMB_LIVE_CUT=64'
bare='-DLMB_TRANSFER=0 -DLMB_PROBES=0 -DLMB_RELIEF=0 -DLMB_MIXED=0 -DLMB_VOXELS=0 -DLMB_PLAN=0 -DLMB_MAX_CUT=6'
bare="$bare -DLMB_MANY_LIGHTS_CUT=16"
small_here=$BUILD/plain/small/tiny small_there=$BUILD/cortex-m/small/tiny
check "bounced light for this machine" $MAKE PORT=host CONFIG=tiny BUILD="$BUILD/plain/small" ONE_UNIT=1 \
    CFLAGS="-O1 $plain $small" "$small_here/bounced"
make_small() { $MAKE "$@" PORT=cortex-m CONFIG=tiny BUILD="$BUILD/cortex-m/small" CFLAGS="-O2 $small $bare" LDFLAGS=; }
check "bounced light for a Cortex-M4F" make_small "$small_there/bounced"
[ $failed -eq 0 ] || finish
"$small_here/bounced" >"$small_here/bounced.out"
check "bounced: exit status here: $?" test $? -eq 0
make_small run-bounced >"$small_there/bounced.out"
check "bounced: exit status on the Cortex-M4F: $?" test $? -eq 0
sed 's/^/  /' "$small_there/bounced.out"
arm-none-eabi-size "$small_there/bounced" | awk 'NR == 2 { print "  rom " $1 + $2 " bytes" }'
for i in 0 1 2; do
    hash_here=$(awk -v name="demo-bounced-$i" '$1 == name { print $2 }' "$small_here/bounced.out")
    hash_there=$(awk -v name="demo-bounced-$i" '$1 == name { print $2 }' "$small_there/bounced.out")
    check "bounced, frame $i: hashes differ: $hash_here here, $hash_there there" \
        test -n "$hash_here" -a "$hash_here" = "$hash_there"
done
for added in $(sed -n 's/^thousands.* added //p' "$small_there/bounced.out"); do
    bound "bounced light on top of direct light" "$((added * 1000))" 260000
done
finish
