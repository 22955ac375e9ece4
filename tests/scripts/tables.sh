# tables.sh: checks that each tools/FOLDER/gen_*.c still prints the committed FILE.inc that its first line names, byte
# for byte. A name without a folder is beside the generator. Also checks the sizes of structs in include/README.md
# against the headers. CC FLAGS LIB LDLIBS B in the environment.
. tests/scripts/checks.sh

mkdir -p "$B/tables"
for source in tools/*/gen_*.c; do
    table=$(sed -n '1s/.*prints \([a-z0-9_\/.]*\.inc\).*/\1/p' "$source")
    [ -f "$table" ] || table=$(dirname "$source")/$table
    program=$B/tables/$(basename "$source" .c)
    if [ ! -f "$table" ]; then
        fail "$source: its first line names no FILE.inc"
        continue
    fi
    check "$source compiles" $CC $FLAGS -o "$program" "$source" "$LIB" $LDLIBS
    check "$source runs" sh -c '"$1" >"$1.out" 2>/dev/null' sh "$program"
    check "$table is not what $source prints" cmp "$program.out" "$table"
done

# Rows `| \`lmb_x\` | default | tiny | ...`; and the sizes after `lmb_scene`, as "96 a mesh".
sizes=$B/tables/sizes
sed -nE 's/^\| `lmb_scene` .*; ([0-9]+) a mesh, ([0-9]+) a material, ([0-9]+) an instance, ([0-9]+) a light.*/&\
lmb_mesh \1 \1\
lmb_material \2 \2\
lmb_instance \3 \3\
lmb_light \4 \4/; s/^\| `(lmb_[a-z_]+)` \| ([0-9,]+) \| ([0-9,]+) \|[^\n]*/\1 \2 \3/p' \
    include/README.md | tr -d , | xargs -n 3 >"$sizes.said"
check "few sizes are in include/README.md" test "$(wc -l <"$sizes.said")" -ge 15
for column in 2 3; do
    {
        printf '#include <lambent/lambent.h>\n#include <stdio.h>\nint main(void)\n{\n'
        echo '    if (sizeof(void *) != 8) return 2;'
        awk '{ printf "    printf(\"%s %%u\\n\", (unsigned)sizeof(%s));\n", $1, $1 }' "$sizes.said"
        printf '    return 0;\n}\n'
    } >"$sizes.c"
    tiny=-ULMB_CONFIG_TINY
    [ $column = 2 ] || tiny=-DLMB_CONFIG_TINY
    check "the sizes compile" $CC -std=c99 -Iinclude $tiny -o "$sizes" "$sizes.c"
    "$sizes" >"$sizes.are"
    [ $? -ne 2 ] || { skip "sizes of structs: pointers have no 8 bytes here"; break; }
    awk -v column=$column '{ print $1, $column }' "$sizes.said" >"$sizes.column"
    check "include/README.md's sizes of structs" diff "$sizes.column" "$sizes.are"
done
finish
