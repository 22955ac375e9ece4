# layers.sh: checks includes and calls against layers.txt, which lists every folder of src/ and tools/ in order. CC B NM
# in the environment; needs the built library and tool.
#
#     layers.sh          checks folders by #include and by nm; cycles between files in both; private headers in tools;
#                        first lines; file names; names that several files define; the plans in the README files; the
#                        rows of mutants.txt; and that it finds made-up faults
#     layers.sh write    writes the plans into src/README.md and tools/README.md, and the layers into the first lines
. tests/scripts/checks.sh
. tests/scripts/mutants.sh
table=tests/scripts/layers.txt

# plan ROOT: prints the table's part in the format of a README.
plan() {
    awk -v root="$1" '
        /^#/ || /^$/ { mine = 0; next }
        /^ / { if (mine) { sub(/^ +/, ""); printf "%15s%s\n", "", $0 } next }
        {
            mine = index($1, root "/") == 1
            if (!mine) next
            folder = substr($1, length(root) + 2) "/"; number = $2
            sub(/^[^ ]+ [0-9]+ /, "")
            printf "%2d %-12s%s\n", number, folder, $0
        }' $table
}

# planned ROOT: prints the text between the marks in ROOT/README.md.
planned() {
    awk '/^<!-- end of layers -->/ { exit } inside && !/^```/ { print } /^<!-- layers: / { inside = 1 }' "$1/README.md"
}

put_plan() {
    plan "$1" >"$1/plan.new"
    awk -v plan="$1/plan.new" '
        /^<!-- end of layers -->/ { inside = 0 }
        !inside { print }
        /^<!-- layers: / { inside = 1; print "```"; while ((getline line < plan) > 0) print line; print "```" }
    ' "$1/README.md" >"$1/README.new" && mv "$1/README.new" "$1/README.md"
    rm "$1/plan.new"
}

# put_layers: corrects the layer in the first lines of src/'s files.
put_layers() {
    sed -n 's,^\(src/[^ ]*\) \([0-9]*\) .*,\1 \2,p' $table | while read -r folder layer; do
        for file in "$folder"/*.c "$folder"/*.h "$folder"/*.inl; do
            sed "1!d; /Layer $layer\\./d" "$file" 2>/dev/null | grep -q Layer || continue
            sed "1s/Layer [0-9]*\\./Layer $layer./" "$file" >"$file.new" && cat "$file.new" >"$file"
            rm "$file.new"
        done
    done
}

# Edges are lines `FROM TO`, as paths of sources.

# by_include FOLDER...: edges from #include "...".
by_include() {
    grep -rnE '^[[:space:]]*#[[:space:]]*include[[:space:]]*"' "$@" |
        sed -E 's/^([^:]+):[0-9]+:[^"]*"([^"]*)".*/\1 \2/' | awk '
            { to = $1; sub(/\/[^\/]*$/, "", to); to = to "/" $2
              while (sub(/[^\/.]+\/\.\.\//, "", to)) ;
              print $1, to }'
}

# objects FOLDER: the objects of existing sources of src/ and tools/; objects of deleted sources are left out.
objects() {
    (cd "$1" && find src tools -name '*.o' 2>/dev/null) | sort | while read -r object; do
        [ ! -f "${object%.o}.c" ] || echo "$object"
    done
}

# by_call FOLDER: edges from objects in the input list that use a symbol to the objects that define it.
by_call() {
    (cd "$1" && xargs $NM -A) | awk '
        {
            source = $1; sub(/:.*/, "", source); sub(/\.o$/, ".c", source)
            symbol = $NF; kind = $(NF - 1); sub(/^.*:/, "", kind)
        }
        kind ~ /^[TDBRVWC]$/ { at[symbol] = source }
        kind == "U" { ++n; user[n] = source; taken[n] = symbol }
        END {
            for (i = 1; i <= n; ++i)
                if (taken[i] in at && at[taken[i]] != user[i]) print user[i], at[taken[i]]
        }' | sort -u
}

# in_circles: keeps edges on cycles and between them; repeatedly removes edges to or from a node with no further edges.
in_circles() {
    awk '
        { from[NR] = $1; to[NR] = $2; left[NR] = 1 }
        END {
            do {
                gone = 0
                split("", has_out); split("", has_in)
                for (i = 1; i <= NR; ++i) if (left[i]) { has_out[from[i]] = 1; has_in[to[i]] = 1 }
                for (i = 1; i <= NR; ++i)
                    if (left[i] && (!(to[i] in has_out) || !(from[i] in has_in))) { left[i] = 0; gone = 1 }
            } while (gone)
            for (i = 1; i <= NR; ++i) if (left[i]) print from[i] " -> " to[i]
        }'
}

# upward: prints edges to the same or a higher layer, and to files outside src/, tools/ and include/.
upward() {
    awk -v table=$table '
        function folder(path) { sub(/\/[^\/]*$/, "", path); return path }
        BEGIN {
            while ((getline line < table) > 0)
                if (line ~ /^[a-z]/) {
                    split(line, part, " ")
                    layer[part[1]] = part[2] + (part[1] ~ /^tools/ ? 1000 : 0)
                }
            layer["platform/host"] = 999
        }
        {
            a = folder($1); b = folder($2)
            if (a == b || a !~ /^(src|tools|include)\//) next
            if (a ~ /^include/) print $1 " -> " $2 " (a public header leans on public headers alone)"
            else if (!(a in layer) || !(b in layer)) print $1 " -> " $2 " (layers.txt has no " (a in layer ? b : a) ")"
            else if (layer[b] >= layer[a]) print $1 " -> " $2 " (from " layer[a] % 1000 " to " layer[b] % 1000 ")"
        }'
}

# private: prints edges from tools/ to src/. Tools use only public headers, as your programs do. Except: lambent-bench,
# which measures the SIMD verbs and counts the operations of kernels.
private() {
    awk '$1 ~ /^tools\// && $2 ~ /^src\// && $1 !~ /^tools\/bench\/bench_(rates|operations)/ { print $1 " -> " $2 }'
}

# none TEXT LINES: fails once for each line.
none() {
    if [ -z "$2" ]; then
        pass
    else
        failed=$((failed + $(printf '%s\n' "$2" | wc -l)))
        printf '%s\n' "$2" | sed "s/^/FAIL $1: /"
    fi
}

if [ "$1" = write ]; then
    put_plan src
    put_plan tools
    put_layers
    exit
fi

dir=$B/layers
rm -rf "$dir"
mkdir -p "$dir"

by_include src tools include >"$dir/includes"
objects "$B/obj" | by_call "$B/obj" >"$dir/calls"
check "nm finds no calls" test -s "$dir/calls"

none "include" "$(upward <"$dir/includes")"
none "call" "$(upward <"$dir/calls")"
none "private header in a tool" "$(private <"$dir/includes")"
none "circle of includes" "$(grep -E '^(src|tools)' "$dir/includes" | in_circles)"
none "circle of calls" "$(in_circles <"$dir/calls")"
echo "$(sort -u "$dir/includes" | wc -l) includes, $(wc -l <"$dir/calls") calls from file to file"

for folder in src/*/ tools/*/; do
    check "$folder: layers.txt has no such folder" grep -q "^${folder%/} [0-9]" $table
done
# without_layer FILE...: prints files without their layer (and tags) at the end of the first line.
without_layer() {
    awk -v table=$table '
        BEGIN { while ((getline line < table) > 0) if (line ~ /^[a-z]/) { split(line, part, " "); layer[part[1]] = part[2] } }
        FNR == 1 {
            folder = FILENAME; sub(/\/[^\/]*$/, "", folder); sub(/^.*\/src\//, "src/", folder)
            if (index($0, "Layer " layer[folder] ".") == 0) print FILENAME " (layer " layer[folder] ")"
        }' "$@"
}
none "the first line does not say the layer" "$(without_layer src/*/*.c src/*/*.h src/*/*.inl)"

# same_names FILE...: prints files with the name of an earlier file. `cc -c src/*/*.c` puts all objects into one folder.
same_names() {
    printf '%s\n' "$@" | awk '
        { name = $0; sub(/^.*\//, "", name) }
        name in at { print at[name] " and " $0; next }
        { at[name] = $0 }'
}
none "two files have one name" "$(same_names src/*/*)"
none "two files have one name" "$(same_names tools/*/*)"
none "two sources have one name" "$(same_names src/*/*.c tools/*/*.c platform/host/*.c)"
# ambiguous FILE...: prints names that several sources of src define, with these. A name is then clear in a stack trace,
# and the two-file version keeps it. Six older names are left.
ambiguous() {
    awk -v PART=names -f platform/amalgam/amalgam.awk "$@" |
        grep -vE '^(area_of|grid_of|is_even|light_tile|share_of|spread):'
}
none "several files define" "$(ambiguous src/*/*.c)"
none "mutants.txt" "$(mutant_faults tests/scripts/mutants.txt .)"

for root in src tools; do
    [ "$(plan $root)" = "$(planned $root)" ] && pass ||
        fail "$root/README.md has another plan than layers.txt: sh tests/scripts/layers.sh write"
done

# Checks that it can fail: two files that call each other and a third; two headers that include each other; a call and
# an include upward; a first line without the layer; a second file of one name; faulty rows of mutants.txt.
made=$dir/made
mkdir -p "$made/src/base" "$made/src/raster" "$made/obj/src/base" "$made/obj/src/raster"
echo 'int one(void); int two(void); int three(void); int one(void) { return two() + three(); }' >"$made/src/base/one.c"
echo 'int one(void); int two(void); int two(void) { return one(); }' >"$made/src/base/two.c"
echo 'int three(void); int three(void) { return 3; }' >"$made/src/raster/three.c"
echo '#include "two.h"' >"$made/src/base/one.h"
printf '#include "one.h"\n#include "../raster/three.h"\n' >"$made/src/base/two.h"
: >"$made/src/raster/three.h"
for name in base/one base/two raster/three; do
    check "$name.c of a made-up circle compiles" $CC -O0 -c "$made/src/$name.c" -o "$made/obj/src/$name.o"
done
printf '/* four.inl: a kernel. Floor 1. */\n' >"$made/src/base/four.inl"
check "a first line without its layer is not found" test -n "$(without_layer "$made/src/base/four.inl")"
check "a second shade.c is not found" test "$(same_names src/*/* src/isa/shade.c)" = \
    "src/frame/shade.c and src/isa/shade.c"
printf '%s\n' 'static int next_cell(int i)' '{' '    return i;' '}' 'enum { MAX_CELLS = 4 };' >"$made/src/base/five.c"
printf '%s\n' 'typedef struct next_cell {' '    int i;' '} next_cell;' 'enum {' '    A_CELL, /* a * b */' \
    '    MAX_CELLS' '};' >"$made/src/raster/six.c"
check "made-up ambiguous names are not found" test "$(ambiguous "$made/src/base/five.c" "$made/src/raster/six.c" |
    sed 's/:.*//' | sort | tr '\n' ';')" = "MAX_CELLS;next_cell;"
mkdir -p "$made/tests/unit" "$made/tools/cli"
: >"$made/tests/unit/test_light.c"
printf '%s\n' '# A table.' 'src/base tests:light' '    tests:gone' 'src/gone - why' 'tools/cli -' >"$made/mutants.txt"
mutant_faults "$made/mutants.txt" "$made" >"$made/faults"
check "made-up faults of mutants.txt are not found" test "$(tr '\n' ';' <"$made/faults")" = \
    "$(printf '%s;' 'src/base: there is no test tests:gone' 'src/gone: there is no such folder' \
        'tools/cli: neither tests nor a reason' 'src/raster: mutants.txt has not one row for it')"
(cd "$made/obj" && find src -name '*.o') | by_call "$made/obj" >"$made/calls"
(cd "$made" && by_include src) >"$made/includes"
check "a made-up private include is not found" test "$(printf '%s\n' 'tools/cli/a.c src/base/vec.h' \
    'tools/bench/bench_rates.c src/lane/lane.h' 'tools/bench/bench_draw.c src/lane/lane.h' \
    'tools/cli/a.c include/lambent/draw.h' | private | tr '\n' ';')" = \
    "tools/cli/a.c -> src/base/vec.h;tools/bench/bench_draw.c -> src/lane/lane.h;"
check "a made-up circle of calls is not found" test "$(in_circles <"$made/calls" | sort | tr '\n' ';')" = \
    "src/base/one.c -> src/base/two.c;src/base/two.c -> src/base/one.c;"
check "a made-up circle of includes is not found" test "$(in_circles <"$made/includes" | sort | tr '\n' ';')" = \
    "src/base/one.h -> src/base/two.h;src/base/two.h -> src/base/one.h;"
check "a made-up call upward is not found" test "$(upward <"$made/calls" | wc -l)" -eq 1
check "a made-up include upward is not found" test "$(upward <"$made/includes" | wc -l)" -eq 1
finish
