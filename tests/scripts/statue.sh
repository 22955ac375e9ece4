# statue.sh: draws a relief of 16 views of 64 x 64 in 512 KiB of ROM, on an emulated Cortex-M7 and here: checks for
# equal pictures, and prints the cost. MAKE BUILD TOOL in the environment. Without cross compiler or qemu: as tiny.sh.
#
# The code is built for the Cortex-M4F, as in tiny.sh, and a Cortex-M7 runs it too; bare.ld limits it to 512 KiB.
. tests/scripts/checks.sh

if ! missing=$(sh tests/scripts/tools.sh need arm-none-eabi-gcc qemu-system-arm 2>&1); then
    skip "a relief on a Cortex-M7: $missing"
    [ -n "$IN_CHECK" ] && finish
    exit 1
fi

here=$BUILD/plain/tiny there=$BUILD/cortex-m/tiny rom=524288
mkdir -p "$here" "$there"

# A wavy tube, tied in a trefoil knot, on a base.
awk 'function tube(i, j,   t, a, x, y, z, r) {
    t = 6.283185307 * i / along; a = 6.283185307 * j / around
    r = 0.5 + 0.06 * sin(27 * t) + 0.05 * cos(4 * a)
    x = (2 + cos(3 * t)) * cos(2 * t); y = (2 + cos(3 * t)) * sin(2 * t); z = sin(3 * t)
    x += r * cos(a) * cos(2 * t); y += r * cos(a) * sin(2 * t); z += r * sin(a)
    printf "v %.5f %.5f %.5f %.3f %.3f %.3f\n", x, y, z, 0.6 + 0.3 * sin(9 * t), 0.5, 0.45 - 0.2 * cos(6 * t)
}
function face(a, b, c) { printf "f %d %d %d\n", a, b, c }
BEGIN {
    along = 360; around = 24
    for (i = 0; i < along; ++i) for (j = 0; j < around; ++j) tube(i, j)
    for (i = 0; i < along; ++i) for (j = 0; j < around; ++j) {
        k = (j + 1) % around; n = (i + 1) % along
        face(i * around + j + 1, n * around + j + 1, n * around + k + 1)
        face(i * around + j + 1, n * around + k + 1, i * around + k + 1)
    }
}' >"$here/knot.obj"
check "a relief is baked" "$TOOL" relief bake "$here/knot.obj" -o "$here/knot.lmr" --views 16 --size 64 --packed \
    --triangles 400
od -An -v -tx4 "$here/knot.lmr" | sed 's/ *\([0-9a-f][0-9a-f]*\)/0x\1,/g' >"$here/statue.new"
for to in "$here" "$there"; do
    cmp -s "$here/statue.new" "$to/statue.inc" || cp "$here/statue.new" "$to/statue.inc"
done
plain="-DLMB_HAVE_AVX512=0 -DLMB_HAVE_AVX2=0 -DLMB_HAVE_SSE2=0" # as in tiny.sh
check "for this machine" $MAKE "$here/statue" PORT=host CONFIG=tiny BUILD="$BUILD/plain" ONE_UNIT=1 CFLAGS="-O1 $plain"
m='PORT=cortex-m CONFIG=tiny CFLAGS=-Os LDFLAGS='
check "for a Cortex-M" $MAKE "$there/statue" $m BUILD="$BUILD/cortex-m"
[ $failed -eq 0 ] || finish

"$here/statue" >"$here/statue.out"
check "exit status here: $?" test $? -eq 0
$MAKE run-statue $m BUILD="$BUILD/cortex-m" BOARD=mps2-an500 >"$there/statue.out"
check "exit status on the Cortex-M7: $?" test $? -eq 0

echo "here:"
sed 's/^/  /' "$here/statue.out"
echo "Cortex-M7:"
sed 's/^/  /' "$there/statue.out"
taken=$(arm-none-eabi-size "$there/statue" | awk 'NR == 2 { print $1 + $2 }')
echo "ROM: $taken bytes of $rom, $(wc -c <"$here/knot.lmr") of them the relief"
check "over 512 KiB of ROM: $taken" test "$taken" -le $rom
hash_of() { awk '/^statue-/ { print $2 }' "$1"; }
check "hashes differ: $(hash_of "$here/statue.out") here, $(hash_of "$there/statue.out") there" \
    test -n "$(hash_of "$here/statue.out")" -a "$(hash_of "$here/statue.out")" = "$(hash_of "$there/statue.out")"
check "few pixels show the surface" awk '/^views 16,/ { n = $6 + 0; h = $8 + 0 } END { exit !(h > n / 2) }' \
    "$there/statue.out"
finish
