#!/bin/sh
# Checks that other machines draw the same bytes: cross.sh BUILD MACHINE ... An emulator runs own.c and bounced.c for each
# machine.
#
# A machine is skipped if its compiler or emulator is missing. MAKE and CFLAGS are make's.
set -u
build=$1
shift
here=platform/gl/check
failed=0
for machine; do
    case $machine in
    aarch64) cc=aarch64-linux-gnu-gcc run=qemu-aarch64 ;;
    mips) cc=mips-linux-gnu-gcc run=qemu-mips ;; # big-endian
    riscv64) cc=riscv64-linux-gnu-gcc run=qemu-riscv64 ;;
    i386) cc="gcc -m32" run= ;;
    *) echo "cross.sh: no machine $machine"; exit 2 ;;
    esac
    out=$build/gl-$machine
    mkdir -p "$out"
    echo 'int main(void) { return 0; }' > "$out/one.c"
    if ! $cc -static -o "$out/one" "$out/one.c" 2> "$out/one.txt" || ! $run "$out/one" 2>> "$out/one.txt"; then
        echo "skipped: $machine: ${cc%% *} or ${run:-its loader} is missing"
        continue
    fi
    ${MAKE:-make} -s "$out/gl/libGL.a" BUILD="$out" CC="$cc" CFLAGS="${CFLAGS:--O2}" || exit 1
    $cc -std=c99 -O1 -static -Iplatform/gl/include -o "$out/own" $here/own.c "$out/gl/libGL.a" -lm || exit 1
    $run "$out/own" > "$out/own.txt"
    status=$?
    $cc -std=c99 -O1 -static -Iplatform/gl/include -o "$out/bounced" $here/bounced.c "$out/gl/libGL.a" -lm || exit 1
    $run "$out/bounced" hash > "$out/bounced.txt" || status=$?
    if [ $status -eq 0 ] && cmp -s "$out/own.txt" $here/own.txt && cmp -s "$out/bounced.txt" $here/bounced.txt; then
        echo "$machine: equal"
    else
        echo "FAILED: $machine: $out/own.txt or bounced.txt is not that of $here (exit status $status)"
        failed=1
    fi
done
exit $failed
