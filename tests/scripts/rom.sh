# rom.sh: the ROM of bounced light without trees (LMB_TREES 0): the modules raster (without lookup, for programs that read
# scenes), direct (without light_tile, which
# belongs to frames) and bounce, and far light (env, env_sky), linked with the parts of other modules and of the
# compiler's run time that they need: rom.sh BUDGET_BYTES; CC FLAGS B NM SIZE in the environment.
. tests/scripts/checks.sh
budget=$1

objects=$(find "$B/obj/src" -name '*.o' | sort)
modules=$(printf '%s\n' "$objects" | grep -E '/src/((raster|direct|bounce)/|occlusion/occlude\.o|probe/env)' |
    grep -vE '/direct/light_tile\.o$|/raster/lookup\.o$')
roots=$($NM $modules | awk '$2 == "T" { print "-Wl,-u," $3 }' | sort -u)
check "the modules link" $CC $FLAGS -nostdlib -o "$B/rom.elf" -Wl,--gc-sections -Wl,-e,lmb_kernels_pick $roots \
    -Wl,--unresolved-symbols=ignore-all $objects -lgcc
[ $failed -eq 0 ] || finish

echo "bounced light, linked, largest functions and tables:"
$NM -S -t d "$B/rom.elf" | awk 'NF == 4 { printf "  %8d  %s\n", $2, $4 }' | sort -rn | bare | head -n 25
bytes=$($SIZE "$B/rom.elf" | awk 'NR == 2 { print $1 + $2 }')
echo "raster + map + light + bounce and what they need: $bytes of $budget bytes"
check "$bytes bytes of ROM are over the budget" test "$bytes" -le "$budget"
finish
