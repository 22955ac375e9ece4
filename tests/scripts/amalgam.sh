# amalgam.sh: checks that the library as two files draws the golden pictures with clang, g++ (as C++), clang with
# Microsoft's ABI (under wine) and tcc; COMPILERS="g++" selects some. Checks that it exports the same names as the
# library, and compiles without warnings in each configuration. AMALGAM (the folder of the two files), OBJ (objects of
# the golden program), GOLDEN_SRC, B, LIB, NM, LDLIBS in the environment.
. tests/scripts/checks.sh

dir=$B/amalgam-check
rm -rf "$dir"
mkdir -p "$dir"
exact="-ffp-contract=off -fno-math-errno -I$AMALGAM"

# compiled NAME COMMAND...: checks that one command compiles lambent.c.
compiled() {
    name=$1
    shift
    check "$name: one call compiles it" "$@" -c "$AMALGAM/lambent.c" -o "$dir/$name.o"
}

# golden NAME LINKER...: checks the golden program with that object.
golden() {
    name=$1
    shift
    check "$name: it links" "$@" -o "$dir/$name" $OBJ "$dir/$name.o" $LDLIBS
    check "$name: golden pictures" "$dir/$name"
}

# Compilers: clang, g++, tcc and msvc; tcc-msvc is both of the last. gcc builds the same sources in `make one-command`.
wanted() { case " ${COMPILERS:-clang g++ tcc-msvc} " in *[\ -]"$1"[\ -]*) ;; *) return 1 ;; esac; }

# Compiles at -O1, in a third of the time of -O2, because pixels do not depend on the level.
warnings="-Wall -Wextra -pedantic -Werror"
check "gcc: no warnings" gcc -std=c99 -O1 $warnings $exact -fsyntax-only "$AMALGAM/lambent.c"
exports() { ${NM:-nm} "$1" 2>/dev/null | awk '$2 ~ /^[A-TV-Z]$/ && $3 ~ /^[a-z]/ { print $3 }' | sort -u; }

if ! wanted clang; then
    :
elif command -v clang >/dev/null; then
    compiled clang clang -std=c99 -O1 $warnings $exact
    golden clang clang
    exports "$LIB" >"$dir/library"
    exports "$dir/clang.o" >"$dir/one-file"
    check "it exports what the library does" diff "$dir/library" "$dir/one-file"
else
    skip "no clang"
fi
if ! wanted g++; then
    :
elif command -v g++ >/dev/null; then
    compiled g++ g++ -std=c++17 -O1 -Wall $exact
    golden g++ g++
else
    skip "no g++"
fi

# Like clang-cl: Microsoft's object files and calls, with MinGW's start-up, output and maths. No stack probes, because
# no call uses 4 KiB of stack.
if ! wanted msvc; then
    :
elif missing=$(sh tests/scripts/tools.sh need clang x86_64-w64-mingw32-gcc wine64 2>&1); then
    compiled msvc clang --target=x86_64-pc-windows-msvc -ffreestanding -isystem platform/freestanding -mno-stack-arg-probe \
        -std=c99 -O1 $warnings $exact
    echo 'int _fltused;' >"$dir/fltused.c"
    check "msvc: it links" x86_64-w64-mingw32-gcc -static -std=c99 -O1 $exact -Iinclude -o "$dir/msvc.exe" $GOLDEN_SRC \
        "$dir/fltused.c" "$dir/msvc.o"
    check "msvc: golden pictures" sh tests/scripts/wine.sh "$dir/msvc.exe"
else
    skip "Microsoft's ABI: $missing"
fi

# tcc 0.9.27 miscompiles, which lmb_build_check detects.
if ! wanted tcc; then
    :
elif command -v tcc >/dev/null; then
    compiled tcc tcc $exact
    check "tcc: it links" tcc -o "$dir/tcc" $OBJ "$dir/tcc.o" $LDLIBS
    "$dir/tcc" >"$dir/tcc.txt" 2>&1
    if grep -q '^lmb_build_check: LMB_ERR_BUILD$' "$dir/tcc.txt"; then
        skip "tcc: lmb_build_check refuses it"
    else
        check "tcc: golden pictures" grep -q ' 0 failed' "$dir/tcc.txt"
    fi
else
    skip "no tcc"
fi

# Each switch of config.h separately, and the tiny configuration.
for switch in CONFIG_TINY $(sed -n '/^\/\* 0: /,/^#ifndef/s/^#ifndef LMB_\(.*\)/\1=0/p' include/lambent/config.h) \
    HAVE_AVX2=0; do
    check "-DLMB_$switch" gcc -std=c99 -DLMB_$switch $warnings $exact -fsyntax-only "$AMALGAM/lambent.c"
done
# Without AVX-512 batches are smaller; gcc warns about a write past an array only if it generates code.
check "-DLMB_HAVE_AVX512=0" gcc -std=c99 -O1 -ftree-vrp -DLMB_HAVE_AVX512=0 -DLMB_HAVE_SSE2=0 $warnings $exact -c "$AMALGAM/lambent.c" \
    -o "$dir/avx2.o"
finish
