# size.sh: prints code and data of the library by module, and the largest functions and tables: B NM SIZE in the
# environment.
#
# `code` includes constants and, on hosts, unwind tables.
. tests/scripts/checks.sh
objects=$(find "$B/obj/src" -name '*.o' | sort)

echo "$B, bytes by module:"
$SIZE $objects | awk '
    NR == 1 { next }
    {
        module = $NF; sub(/^.*\/obj\/src\//, "", module); sub(/\/.*/, "", module)
        if (!(module in code)) order[n++] = module
        code[module] += $1; data[module] += $2; bss[module] += $3
        all_code += $1; all_data += $2; all_bss += $3
    }
    END {
        form = "  %-10s %8s %8s %8s\n"
        printf form, "module", "code", "data", "bss"
        for (i = 0; i < n; ++i) printf form, order[i], code[order[i]], data[order[i]], bss[order[i]]
        printf form, "all", all_code, all_data, all_bss
    }'

echo "largest functions and tables:"
$NM -S -t d $objects | awk 'NF == 4 { printf "  %8d  %s\n", $2, $4 }' | sort -rn | bare | head -n 12
