# console_abis.sh: checks the library for the ABIs of today's consoles, without their SDKs, from C and from C++:
# x86-64 with AVX2 by Microsoft's and by System V's ABI, and AArch64. Headers come from platform/freestanding. B in the
# environment.
#
# src/ is C99, and parts of it are not valid C++; every public header is valid in both. The check compiles src/ as C and
# a C++ program that includes every header and calls the library. It then compares the undefined symbols of the library
# with the few functions that it may use.
. tests/scripts/checks.sh
CLANG=${CLANG:-clang}
if ! command -v "$CLANG" >/dev/null 2>&1; then
    skip "no $CLANG"
    finish
fi
B=${B:-build/default}
symbols=$(command -v llvm-nm || ls /usr/bin/llvm-nm-[0-9]* 2>/dev/null | tail -n 1)
symbols=${symbols:-nm}

# Microsoft's and Itanium's C++ rules: calls by address, all structs by value, so that both languages have to agree.
program() {
    echo '#include <lambent/lambent.h>'
    for h in include/lambent/*.h; do
        echo "#include <lambent/${h##*/}>"
    done
    cat <<'END'
extern "C" int frame_of(lmb_render *r, lmb_frame *f, const lmb_frame_settings *s, void *memory, size_t bytes)
{
    lmb_view view = s->view;
    return lmb_build_check() == LMB_OK && lmb_frame_init(f, s, memory, bytes) == LMB_OK &&
           lmb_view_look_at(&view, lmb_vec3{0, 0, 1}, lmb_vec3{0, 0, 0}, lmb_vec3{0, 1, 0}, 1.0f, 8, 8) == LMB_OK &&
           lmb_render_begin(r, f) == LMB_OK && lmb_render_step(r, 1) >= 0 && lmb_kernels_pick() != nullptr;
}
END
}

# abi NAME FLAG...
abi() {
    name=$1
    shift
    dir=$B/console-abis/$name
    rm -rf "$dir"
    mkdir -p "$dir"
    flags="-O2 -ffreestanding -isystem platform/freestanding -Iinclude -Wall -Wextra -Werror $*"
    for f in src/*/*.c; do
        echo "$f"
    done | xargs -P 2 -n 8 sh -c '
        dir=$1 flags=$2 clang=$3; shift 3
        for f in "$@"; do
            "$clang" -std=c99 -ffp-contract=off $flags -c "$f" -o "$dir/$(echo "$f" | tr / -).o" || exit 255
        done' sh "$dir" "$flags" "$CLANG" >"$dir/said" 2>&1
    status=$?
    check "$name: src/ as C: $(head -n 3 "$dir/said")" test $status -eq 0
    check "$name: an object a file" test "$(ls "$dir"/*.o | wc -l)" -eq "$(ls src/*/*.c | wc -l)"
    program >"$dir/program.cpp"
    check "$name: the headers as C++" "$CLANG" -x c++ -std=c++11 -fno-exceptions -fno-rtti $flags -c "$dir/program.cpp" \
        -o "$dir/program.obj"
    "$symbols" -u "$dir"/*.o | sed -n 's/.* //p' | grep -v ':$' | sort -u >"$dir/asked"
    "$symbols" --defined-only "$dir"/*.o | sed -n 's/.* [A-Za-z] //p' | sort -u >"$dir/given"
    comm -23 "$dir/asked" "$dir/given" >"$dir/outside"
    check "$name: what the library calls" test -s "$dir/outside"
    grep -vxE 'memcpy|memset|memmove|memcmp|sqrtf|floorf|_fltused|__chkstk' "$dir/outside" >"$dir/more"
    check "$name: calls from outside: $(tr '\n' ' ' <"$dir/more")" test ! -s "$dir/more"
    "$symbols" -u "$dir/program.obj" | sed 's/.* //' | bare | sort -u >"$dir/wanted"
    bare <"$dir/given" | sort -u >"$dir/has"
    check "$name: C++ finds each call of the C library" test -z "$(comm -23 "$dir/wanted" "$dir/has" | grep lmb_)"
    check "$name: C++ calls it at all" grep -q lmb_render_begin "$dir/wanted"
    ls "$dir"/*.o | wc -l | sed "s/^/  $name: /; s/$/ objects/"
    sed 's/^/    calls /' "$dir/outside"
}

abi x86-64-msvc --target=x86_64-pc-windows-msvc -mavx2 -mno-fma
abi x86-64-sysv --target=x86_64-unknown-none-elf -mavx2 -mno-fma
abi aarch64 --target=aarch64-none-elf
finish
