# guard.sh: checks that base/exact.h or lmb_build_check refuses builds that would draw other pixels: CC FLAGS B LIB
# LDLIBS in the environment.
#
# The golden program, linked with one miscompiled file, must print LMB_ERR_BUILD and draw nothing.
. tests/scripts/checks.sh
mkdir -p "$B/guard"
golden="$(ls "$B"/obj/tests/golden/golden_*.o) $B/obj/tests/golden/main_golden.o $B/obj/tools/demo/demo_scene.o
    $B/obj/platform/host/port_host.o $B/guard/golden.o"
check "every fifth golden picture" $CC $FLAGS -O0 -DGOLDEN_EACH=5 -c tests/golden/golden.c -o "$B/guard/golden.o"

# compiles FILE FLAG...: puts FLAGs after the Makefile's own, so that they take precedence.
compiles() {
    source=$1
    shift
    $CC $FLAGS "$@" -c "$source" -o "$B/guard/wrong.o" 2>"$B/guard/errors"
}

knows() {
    : >"$B/guard/empty.c"
    compiles "$B/guard/empty.c" -Wno-pedantic "$@" || { skip "$CC does not know $*" && return 1; }
}

refused_by_compiler() {
    knows "$@" || return
    check "exact.h lets $* pass" sh -c "! $CC $FLAGS $* -c src/base/exact.c -o $B/guard/wrong.o 2>$B/guard/errors"
    check "exact.h does not name what is wrong with $*" grep -q 'error.*lambent: ' "$B/guard/errors"
}

refused_at_start() {
    file=$1
    shift
    knows "$@" || return
    check "$file with $*" compiles "$file" "$@"
    check "linked with $file" $CC $FLAGS -o "$B/guard/golden" $golden "$B/guard/wrong.o" "$LIB" $LDLIBS
    "$B/guard/golden" >"$B/guard/said"
    check "exit status of a wrong build: $?" test $? -eq 1
    check "$file with $* is not refused" grep -q '^lmb_build_check: LMB_ERR_BUILD$' "$B/guard/said"
    check "$file with $* draws" sh -c "! grep -qE ' [0-9a-f]{16}' $B/guard/said"
}

refused_by_compiler -ffast-math
refused_by_compiler -ffinite-math-only
refused_by_compiler -m32 -mfpmath=387 -ffreestanding
refused_by_compiler -m32 -mfpmath=387 -ffreestanding -std=gnu99

# made_right FILE FLAG...: checks that a pragma corrects the effect of these flags.
made_right() {
    file=$1
    shift
    knows "$@" || return
    check "$file with $*" compiles "$file" "$@"
    check "linked with $file" $CC $FLAGS -o "$B/guard/golden" $golden "$B/guard/wrong.o" "$LIB" $LDLIBS
    check "$file with $* does not draw what it should" "$B/guard/golden"
}

# Sources without base/exact.h do not have its pragma.
bare=$(grep -L 'base/exact\.h' "$B"/obj/src/*/*.d)
check "sources that do not include base/exact.h: $bare" test -z "$bare"

fused=-ffp-contract=fast
case $(uname -m) in x86_64) fused="-mfma $fused" ;; esac
# -O1 with the passes that fuse takes two thirds of the time of -O2.
level="-O1 -fexpensive-optimizations"
$CC -dM -E -x c /dev/null | grep -q __clang__ && level=-O1
if grep -qw -e fma -e asimd /proc/cpuinfo 2>/dev/null; then
    refused_at_start src/base/exact.c -O2 $fused
    refused_at_start src/isa/isa_scalar.c $level $fused
    $CC -dM -E -x c /dev/null | grep -q __clang__ && fused=${fused%fast}on
    made_right src/base/exact.c -O2 -std=gnu17 $fused
    made_right src/isa/isa_scalar.c $level -std=gnu17 $fused
else
    skip "this processor may have no fused multiply-add"
fi
refused_at_start src/base/exact.c -O2 -funsafe-math-optimizations
refused_at_start src/base/exact.c -O2 -freciprocal-math
refused_at_start src/base/exact.c -O2 -fno-signed-zeros

# A first build for a Cortex-M4F, with the compiler's default flags.
if arm=$(command -v arm-none-eabi-gcc); then
    for file in src/isa/isa_scalar.c src/base/view.c src/transfer/transfer_many_lights.c; do
        check "$file for a Cortex-M4F" "$arm" -O1 -fexpensive-optimizations -fno-inline -mcpu=cortex-m4 -mfpu=fpv4-sp-d16 -mthumb -mfloat-abi=hard -Iinclude \
            -isystem platform/freestanding -S -o "$B/guard/m4f.s" "$file"
        check "$file: fused multiply-adds" sh -c '! grep -E "vfn?m[as]" "$1"' sh "$B/guard/m4f.s"
    done
else
    skip "a first build for a Cortex-M4F: no arm-none-eabi-gcc"
fi
finish
