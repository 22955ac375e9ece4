# static.sh: analyses src/ with compilers and checkers, without running it: static.sh FOLDER.
#
# PART=K/N in the environment takes every Nth file from the Kth on.
# Each tool is one check: all findings must be listed here, with the reason. Ends with `N passed, ...`.
. tests/scripts/checks.sh
folder=$1
mkdir -p "$folder" || exit 1
flags="-std=c99 -ffp-contract=off -Iinclude"
sources=$(ls src/*/*.c | awk -v part="${PART:-1/1}" 'BEGIN { split(part, p, "/") } NR % p[2] == p[1] % p[2]')
bare_sources=$(printf '%s\n' $sources | grep -v src/isa/)
check "PART=$PART picks no file" test -n "$bare_sources"

here() { command -v "$1" >/dev/null 2>&1 || { skip "$1 is not here (Debian: $2)"; return 1; }; }

# silent NAME [PATTERN]: fails if NAME.log has a finding that PATTERN does not match.
silent() {
    grep -E '(src|include)/[^ ]*:[0-9]+:.*(warning|error|portability|noValidConfiguration)' "$folder/$1.log" |
        grep -vE "${2:-^$}" | sort -u >"$folder/$1.left"
    [ ! -s "$folder/$1.left" ] && pass ||
        fail "$1: $(wc -l <"$folder/$1.left") findings in $folder/$1.left: $(head -n 1 "$folder/$1.left")"
}

# Conversions that change a value or a sign.
for compiler in gcc clang; do
    if here $compiler $compiler; then
        for file in $sources; do
            $compiler $flags -O1 -fsyntax-only -Wconversion -Wsign-conversion -Wfloat-conversion "$file"
        done >"$folder/conversion-$compiler.log" 2>&1
        # relief/warp.inl: votes[] counts 64 pixels in bytes.
        silent conversion-$compiler 'relief/warp.inl:.*uint8_t'
    fi
done

# Null pointers, leaks and uninitialized values. Kernels take minutes each and have no such paths.
if here gcc gcc; then
    for file in $sources; do
        case $file in
        src/isa/*) ;;
        *) gcc $flags -O1 -fanalyzer -c "$file" -o /dev/null ;;
        esac
    done >"$folder/analyzer.log" 2>&1
    # local_cube.c: an array that is full when it is searched. shadow_map.c, envfold.c, plane_place.c: values set by a
    # loop of three or by copying a struct, which gcc 12 does not follow; draw_quick.c: by a loop over the corners of a
    # batch, before the loop over its triangles. around.c: `out` is NULL only if there is no room, and is then not
    # written. texture.c: shares that are not read if the count is 1.
    silent analyzer 'shadow_map.c:.*extent|envfold.c:.*sum|plane_place.c:.*one|around.c:.*NULL .out|texture.c:.*share|local_cube.c:.*light|draw_quick.c:.*[*][bcqr][.]'
fi
# cppcheck has no <float.h>: without these numbers it stops at exact.h's #error, and reports that only with
# --enable=information. Plain C includes the kernels.
if here cppcheck cppcheck; then
    cppcheck --quiet --std=c99 --enable=warning,portability,information --suppress=missingIncludeSystem -Iinclude \
        -D__GNUC__=12 -D__STDC_HOSTED__=1 -DFLT_RADIX=2 -DFLT_MANT_DIG=24 -DFLT_MAX_EXP=128 -DFLT_EVAL_METHOD=0 \
        --template='{file}:{line}: {severity}: {id}: {message}' \
        $bare_sources src/isa/isa_scalar.c >"$folder/cppcheck.log" 2>&1
    # clip.c, crease.c: copies only the vertices that were set. Kernels, draw_rows.c: structs that a callee sets, or
    # reads only when set (`make msan` runs both). elements.c: a loop of one side or two. scene.c: a material's floats, by offset.
    # exact.c tests how this compiler shifts.
    known='clip.c:.*uninitvar.*out|crease.c:.*uninitvar.*out|inl:.*ctuuninitvar|draw_rows.c:.*ctuuninitvar|elements.c:.*compareBool'
    silent cppcheck "$known|scene.c:.*invalidPointerCast|exact.c:.*shiftNegativeLHS"
fi
# Only bugprone, because gcc's analyzer follows paths. Left out: int products as offsets, with casts (sizes of a tile, a
# batch or a slice; rows of surfaces use ptrdiff_t); i / side as a row, on purpose; signed bit fields; and memcmp for
# changes, which at worst repeats a stage if equal values have different bytes.
if here clang-tidy clang-tidy; then
    clang-tidy --quiet --checks='-*,bugprone-*,-bugprone-easily-swappable-parameters,-bugprone-integer-division,-bugprone-implicit-widening-of-multiplication-result,-bugprone-misplaced-widening-cast,-bugprone-narrowing-conversions,-bugprone-suspicious-memory-comparison' \
        $bare_sources -- $flags 2>/dev/null | sed "s|$PWD/||" >"$folder/tidy.log"
    grep -v ': note:' "$folder/tidy.log" >"$folder/tidy.new" && mv "$folder/tidy.new" "$folder/tidy.log"
    # A macro argument that is a type: `(type) *to` would not be a declaration.
    silent tidy 'fixed_fill.c:[0-9:]* warning: macro argument should be enclosed in parentheses'
fi
finish
