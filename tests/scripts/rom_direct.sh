# rom_direct.sh: checks the ROM of frames with only direct light (LMB_BOUNCE 0): the calls of a frame, linked with the
# parts of the library and the compiler's run time that they need: rom_direct.sh BUDGET_BYTES; CC FLAGS B NM SIZE in the
# environment.
. tests/scripts/checks.sh
budget=$1

objects=$(find "$B/obj/src" -name '*.o' | sort)
roots=$($NM $objects | awk '
    $2 == "T" && $3 ~ /^lmb_(frame_init|render_frame|render_begin|render_step|scene_check|scene_bounds|kernels_pick)(_g[0-9].*)?$/ {
        print "-Wl,-u," $3
    }' | sort -u)
check "all seven calls are found" test "$(echo "$roots" | wc -l)" -eq 7
check "the frame links" $CC $FLAGS -nostdlib -o "$B/rom.elf" -Wl,--gc-sections -Wl,-e,lmb_kernels_pick $roots \
    -Wl,--unresolved-symbols=ignore-all $objects -lgcc
[ $failed -eq 0 ] || finish
check "no code of fixed groups is linked" sh -c '! "$1" "$2" | grep -qE " (lmb_group_|lmb_points_|lmb_gather_tile|lmb_discs_)"' \
    sh "$NM" "$B/rom.elf"
bytes=$($SIZE "$B/rom.elf" | awk 'NR == 2 { print $1 + $2 }')
echo "direct light: $bytes of $budget bytes"
check "$bytes bytes of ROM are over the budget" test "$bytes" -le "$budget"
finish
