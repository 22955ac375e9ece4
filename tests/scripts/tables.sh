# tables.sh: each tools/FOLDER/gen_*.c says in its first line which checked-in FILE.inc it prints; it must print it again,
# byte for byte. A name without folder stands beside the generator. CC FLAGS LIB LDLIBS B in the environment.
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
finish
