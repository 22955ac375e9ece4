# amalgam_cost.sh: compares the cost of the two files with that of the tree, at the same flags: bytes of ROM on a
# Cortex-M4F in the tiny configuration with every call linked; instructions of two examples on this machine (valgrind);
# seconds of the golden pictures, the minimum of alternating runs. Each may be 2 % higher. AMALGAM, OBJ (objects of the
# golden program), B, LDLIBS in the environment.
. tests/scripts/checks.sh

dir=$B/amalgam-cost
rm -rf "$dir"
mkdir -p "$dir"
exact="-std=c99 -ffp-contract=off -fno-math-errno"

# within NAME TREE FILES
within() {
    echo "$1: $2 by the tree, $3 by two files: $(awk "BEGIN { printf \"%.4f\", $3 / $2 }")"
    check "$1: two files take over 2 % more" awk "BEGIN { exit !($3 <= 1.02 * $2) }"
}

if missing=$(sh tests/scripts/tools.sh need arm-none-eabi-gcc 2>&1); then
    arm="arm-none-eabi-gcc $exact -mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16 -Os -DLMB_CONFIG_TINY
        -ffunction-sections -fdata-sections"
    mkdir -p "$dir/arm"
    for source in src/*/*.c; do
        $arm -Iinclude -c "$source" -o "$dir/arm/$(echo "$source" | tr / -).o" || fail "$source"
    done
    check "two files for a Cortex-M4F" $arm -I"$AMALGAM" -c "$AMALGAM/lambent.c" -o "$dir/arm.o"
    roots=$(arm-none-eabi-nm "$dir/arm.o" | awk '$2 == "T" { print "-Wl,-u," $3 }')
    rom() { # rom OBJECT...
        arm-none-eabi-gcc -mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16 -nostdlib -o "$dir/rom.elf" \
            -Wl,--gc-sections -Wl,-e,lmb_kernels_pick $roots -Wl,--unresolved-symbols=ignore-all "$@" -lgcc &&
            arm-none-eabi-size "$dir/rom.elf" | awk 'NR == 2 { print $1 + $2 }'
    }
    within "bytes of ROM" "$(rom "$dir"/arm/*.o)" "$(rom "$dir/arm.o")"
else
    skip "ROM: $missing"
fi

check "two files here" gcc $exact -O2 -I"$AMALGAM" -c "$AMALGAM/lambent.c" -o "$dir/files.o"
mkdir -p "$dir/tree"
for source in src/*/*.c; do
    gcc $exact -O2 -Iinclude -c "$source" -o "$dir/tree/$(echo "$source" | tr / -).o" || fail "$source"
done
if command -v valgrind >/dev/null; then
    for example in bounced moving; do
        for build in tree files; do
            objects=$dir/files.o
            [ $build = files ] || objects=$(echo "$dir"/tree/*.o)
            check "$example by the $build" gcc $exact -O2 -Iinclude -o "$dir/$example-$build" tests/examples/$example.c \
                $objects $LDLIBS
            valgrind --tool=callgrind --callgrind-out-file="$dir/out" "$dir/$example-$build" 2>&1 |
                sed -nE 's/.*Collected : ([0-9]+).*/\1/p' >"$dir/$example-$build.count"
        done
        within "instructions of $example.c" "$(cat "$dir/$example-tree.count")" "$(cat "$dir/$example-files.count")"
    done
else
    skip "instructions: no valgrind"
fi

check "the golden program of the tree" gcc -o "$dir/golden-tree" $OBJ "$dir"/tree/*.o $LDLIBS
check "the golden program of two files" gcc -o "$dir/golden-files" $OBJ "$dir/files.o" $LDLIBS
for run in 1 2 3 4 5; do
    for build in tree files; do
        (
            "$dir/golden-$build" >/dev/null 2>&1
            times >"$dir/times"
        )
        awk 'NR == 2 { split($1, t, "m"); printf "%.3f\n", 60 * t[1] + t[2] }' "$dir/times" >>"$dir/$build.seconds"
    done
done
least() { sort -n "$dir/$1.seconds" | head -n 1; }
within "seconds of the golden pictures" "$(least tree)" "$(least files)"
finish
