# mutate.sh: test the tests: change one operator or constant of src/ at a time, and see whether a test notices.
#
#     mutate.sh FOLDER N SEED [ROOM...]     N seeded changes in these rooms of src/ (all but lane and isa)
#
# Works on a copy in FOLDER/tree. Of each change: it builds or is none; then the quickest tests first, until one fails,
# ends badly or takes six times as long as without it: golden pictures, the unit tests of the room, hard cases; with
# FULL=1 all others too. Prints a line each, those that no test noticed with their line,
# and killed / tried by room. Exit status 1 where under 85 % were noticed. Some changes change nothing (a bound that is
# never met, a tie that either way is right): survivors are for reading, not for driving to nothing.
# ONLY=NUMBER does one of them again; FILES=PATTERN takes only such files (kernels take half a minute to build).
folder=$1 wanted=$2 seed=$3
shift 3
tree=$folder/tree
mkdir -p "$folder"
rm -rf "$tree" "$folder/src"
mkdir -p "$tree"
cp -pR Makefile include src tests tools platform README.md "$tree" || exit 1
cp -pR src "$folder/src"
rooms=${*:-base raster map occlusion light bounce voxel probe relief mixed compose plan}
build="make -C $tree BUILD=build CFLAGS=-O1"
programs="build/default/golden build/default/tests build/default/hard build/default/reference"

# tests ROOM: what is run for a change there, the quickest first; NAME:WORDS is a program and its words.
tests() {
    case $1 in
    base) echo golden tests:base tests:contracts tests:light hard:raster hard:all tests:tree ;;
    raster) echo golden hard:raster tests:resolve tests:textures tests:normal_map tests:raster hard:invariants ;;
    map) echo golden tests:light tests:mixed hard:shadow hard:all tests:frames ;;
    occlusion) echo golden tests:occlusion hard:bounce hard:all ;;
    light) echo golden tests:light hard:shadow tests:gloss tests:many hard:bounce ;;
    bounce) echo golden tests:bounce hard:bounce tests:cut tests:tree tests:threads hard:all tests:elements tests:analytic ;;
    voxel) echo golden tests:voxel tests:voxels hard:mixed ;;
    probe) echo golden tests:probe tests:probe_cache hard:probe tests:relit ;;
    relief) echo golden tests:relief hard:relief ;;
    mixed) echo golden tests:mixed hard:mixed ;;
    compose) echo golden tests:light tests:sparse hard:invariants tests:frames ;;
    *) echo golden tests:frames tests:contracts tests:threads tests:sparse hard:invariants tests:elements ;;
    esac
    [ -z "$FULL" ] || echo tests:unit tests:analytic tests:lanes reference:hard hard:again
}

# candidates: FILE LINE COLUMN LENGTH TO of everything that can be changed, one a line.
candidates() {
    for room in $rooms; do
        ls src/"$room"/*.c src/"$room"/*.inl src/"$room"/*.h 2>/dev/null
    done | grep -v _table.inc | grep -e "${FILES:-.}" | while read -r file; do
        awk -v file="$file" '
            BEGIN {
                n = split(" + @ - ; - @ + ; * @ / ; / @ * ; < @ <= ; <= @ < ; > @ >= ; >= @ > ; == @ != ; != @ == ;" \
                    " && @ || ; || @ && ; & @ | ;lane_add(@lane_sub(;lane_sub(@lane_add(;lane_mul(@lane_add(;" \
                    "lane_min(@lane_max(;lane_max(@lane_min(;minf(@maxf(;maxf(@minf(;mini(@maxi(;maxi(@mini(;" \
                    "add3(@sub3(;sub3(@add3(;mask_and(@mask_or(;mask_or(@mask_and(; 0#@ 1#; 1#@ 0#; 1)@ 2);" \
                    "0.5f@0.25f;1.0f@2.0f;2.0f@1.0f; + 1@ + 2; - 1@ - 2", pair, ";")
                for (i = 1; i <= n; ++i) {
                    gsub(/#/, ";", pair[i])
                    cut = index(pair[i], "@")
                    from[i] = substr(pair[i], 1, cut - 1)
                    to[i] = substr(pair[i], cut + 1)
                }
            }
            /^ *\/\*/ { inside = 1 }
            inside { if (/\*\//) inside = 0; next }
            /^ *#/ || /^typedef|^enum|LANE_PART|^extern/ { next }
            {
                code = $0
                sub(/\/\*.*/, "", code)
                for (i = 1; i <= n; ++i) {
                    at = 0
                    while ((found = index(substr(code, at + 1), from[i])) > 0) {
                        at += found
                        print file "\t" NR "\t" at "\t" from[i] "\t" to[i]
                    }
                }
            }' "$file"
    done
}

# Some lines, drawn without putting back.
draw() {
    awk -v n="$wanted" -v seed="$seed" '
        function next_random() { state = (state * 69069 + 12345) % 4294967296; return int(state / 65536) }
        { line[NR] = $0 }
        END {
            state = seed
            for (i = 1; i <= n && i <= NR; ++i) {
                k = i + (next_random() * 65536 + next_random()) % (NR - i + 1)
                swap = line[i]; line[i] = line[k]; line[k] = swap
                print line[i]
            }
        }'
}

# change FILE LINE COLUMN FROM TO: in the copy.
change() {
    awk -v line="$2" -v at="$3" -v from="$4" -v to="$5" '
        NR == line { $0 = substr($0, 1, at - 1) to substr($0, at + length(from)) }
        { print }' "$folder/$1" >"$tree/$1"
}

# run NAME:WORDS SECONDS
run() {
    words=${1#*:}
    [ "$words" != "$1" ] || words=
    (cd "$tree" && timeout "$2" "build/default/${1%%:*}" $words) >"$folder/run.log" 2>&1
}

# What each takes without any change, times six and a little: as NAME:WORDS=SECONDS.
measure() {
    for test in $(for room in $rooms; do tests "$room"; done | tr ' ' '\n' | sort -u); do
        begun=$(date +%s)
        run "$test" 900 || { { echo "$test fails without any change"; tail -3 "$folder/run.log"; } >&2; exit 1; }
        echo "$test $((6 * ($(date +%s) - begun) + 20))"
    done >"$folder/limits"
}
limit_of() { awk -v test="$1" '$1 == test { print $2 }' "$folder/limits"; }

$build $programs >"$folder/build.log" 2>&1 || { tail -5 "$folder/build.log"; exit 1; }
measure
rm -rf "$folder/built"
cp -pR "$tree/build" "$folder/built"
candidates >"$folder/candidates"
draw <"$folder/candidates" >"$folder/drawn"
echo "$(wc -l <"$folder/drawn") of $(wc -l <"$folder/candidates") changes"

: >"$folder/result"
number=0
tab=$(printf '\t')
while IFS="$tab" read -r file line at from to; do
    number=$((number + 1))
    [ -z "$ONLY" ] || [ "$ONLY" = "$number" ] || continue
    room=${file#src/}
    room=${room%%/*}
    change "$file" "$line" "$at" "$from" "$to"
    verdict=survived
    if ! $build $programs >"$folder/build.log" 2>&1 </dev/null; then
        verdict=none
    else
        for test in $(tests "$room"); do
            run "$test" "$(limit_of "$test")" </dev/null || { verdict=$test; break; }
        done
    fi
    cp -p "$folder/$file" "$tree/$file"
    rm -rf "$tree/build"
    cp -pR "$folder/built" "$tree/build" # as if nothing had happened
    echo "$room $verdict" >>"$folder/result"
    echo "$number $file:$line [$from] -> [$to]: $verdict"
    [ "$verdict" != survived ] || sed -n "${line}p" "$folder/$file"
done <"$folder/drawn"

awk '
    $2 == "none" { next }
    { ++tried[$1]; ++all; if ($2 != "survived") { ++killed[$1]; ++dead; ++by[$2] } }
    END {
        for (room in tried) printf "%-10s %d of %d\n", room, killed[room], tried[room] | "sort"
        close("sort")
        for (test in by) printf "by %-12s %d\n", test, by[test] | "sort"
        close("sort")
        printf "noticed: %d of %d, %.0f %%\n", dead, all, all ? 100 * dead / all : 0
        exit !(all && dead >= 0.85 * all)
    }' "$folder/result"
