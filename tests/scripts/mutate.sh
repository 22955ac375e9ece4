# mutate.sh: tests the tests: changes one operator or constant of src/ or tools/ at a time, and checks that a test
# fails.
#
#     mutate.sh FOLDER N SEED [MODULE...]     N seeded changes in these modules of src/ (base, ...) or of tools/
#                                             (tools/model, ...); default: all that have tests in mutants.txt
#
# Works on a copy in FOLDER/tree, with kernels for two backends (scalar and AVX2), because each takes seconds to
# compile. A change does not count if it fails to build or gives the same code. For other changes it runs the tests in
# the module's row of mutants.txt, the quickest first, until one fails, crashes or takes six times as long as without
# the change. With FULL=1 it also runs all others that link the library. It rebuilds only dependents of the changed
# file, and a program only before running it. If mutants.txt has a missing folder or test, it stops before the first
# change. Prints one line per change, the source line of each survivor, and killed / tried by module. Exit status 1 if
# tests found under 85 %. Some survivors are equivalent (a limit that is never reached, a tie that may go both ways), so
# read them, but do not try to reach 100 %.
# ONLY="NUMBER..." repeats some changes; FILES=PATTERN selects files. WARM=build starts from the outputs of `make` in
# that folder, with the same optimisation and all kernels: this takes seconds, but a first build minutes. Each change of
# a kernel then takes minutes.
folder=$1 wanted=$2 seed=$3
shift 3
. tests/scripts/mutants.sh
table=tests/scripts/mutants.txt
mkdir -p "$folder"
faults=$(mutant_faults $table .)
[ -z "$faults" ] || { printf '%s\n' "$faults" | sed 's/^/FAIL mutants.txt: /'; exit 1; }
mutant_rows $table | awk '$2 != "-"' >"$folder/rows" || exit 1
modules=
for module in ${*:-$(cut -d ' ' -f1 "$folder/rows")}; do
    case $module in src/* | tools/*) ;; *) module=src/$module ;; esac
    grep -q "^$module " "$folder/rows" || { echo "FAIL mutants.txt has no tests for $module"; exit 1; }
    modules="$modules $module"
done
mkdir -p "$folder/tree"
folder=$(cd "$folder" && pwd)
tree=$folder/tree
for part in Makefile include src tests tools platform README.md; do
    rm -rf "${tree:?}/$part"
    cp -pR "$part" "$tree" || exit 1
done
rm -rf "$folder/src" "$folder/tools"
cp -pR src tools "$folder"
chmod -R u+w "$tree" "$folder/src" "$folder/tools" # the clone may be read-only
if [ -n "$WARM" ]; then
    rm -rf "$tree/build"
    mkdir -p "$tree/build/default"
    (cd "$WARM/default" && cp -pR obj flags build_flags.inc tests.inc liblambent.a "$tree/build/default") || exit 1
elif [ -d "$folder/built" ]; then # of an earlier run, without any change
    rm -rf "$tree/build"
    cp -pR "$folder/built" "$tree/build"
fi
out=build/default
build="make -C $tree BUILD=build"
by_line=$(command -v stdbuf >/dev/null && echo stdbuf -oL)

make_it() {
    if [ -n "$WARM" ]; then
        $build "$@"
    else
        $build CFLAGS='-O1 -DLMB_HAVE_SSE2=0 -DLMB_HAVE_AVX512=0' "$@"
    fi >"$folder/build.log" 2>&1 </dev/null
}

# tests MODULE: the tests for a change in the module; NAME:WORD is a program and the word that selects the test.
tests() {
    sed -n "s,^$1 ,,p" "$folder/rows"
    case $FULL,$1 in ?*,src/*) echo tests:unit tests:analytic tests:lanes reference:hard hard:again ;; esac
}

# candidates: prints FILE LINE COLUMN FROM TO of each possible change, one a line.
candidates() {
    for module in $modules; do
        ls "$module"/*.c "$module"/*.inl "$module"/*.h 2>/dev/null
    done | grep -v -e _table.inc -e /gen_ | grep -e "${FILES:-.}" | while read -r file; do
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

# draw: picks random lines without repetition.
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

# change FILE LINE COLUMN FROM TO: makes the change in the copy.
change() {
    awk -v line="$2" -v at="$3" -v from="$4" -v to="$5" '
        NR == line { $0 = substr($0, 1, at - 1) to substr($0, at + length(from)) }
        { print }' "$folder/$1" >"$tree/$1"
}

# run NAME:WORD SECONDS: runs a test with a limit of processor time; ends at the first line that reports a failure.
run() {
    word=${1#*:}
    [ "$word" != "$1" ] || word=
    {
        (cd "$tree" && ulimit -t "$2" && exec $by_line timeout $((10 * $2)) "$out/${1%%:*}" $word)
        echo "status $?"
    } 2>&1 | awk '{ last = $0 } /^FAIL| WRONG/ { exit } END { exit last != "status 0" }'
}

# measure: writes a time limit for each test of the modules, six times its time without any change, as SECONDS
# NAME:WORD. Measures again if a program is newer.
measure() {
    modules=$(cut -f1 "$folder/drawn" | sed 's,/[^/]*$,,' | sort -u)
    find "$tree/$out" -maxdepth 1 -type f -newer "$folder/limits" 2>/dev/null | grep -q . && : >"$folder/limits"
    for test in $(for module in $modules; do tests "$module"; done | tr ' ' '\n' | sort -u); do
        ! grep -q " $test " "$folder/limits" || continue
        took=$(run "$test" 900; echo "failed $?"; times)
        case $took in "failed 0"*) ;; *) echo "$test fails without any change" >&2; return 1 ;; esac
        echo "$took" | awk -v test="$test" 'END {
            split($1, t, "m"); split($2, u, "m"); s = 60 * (t[1] + u[1]) + t[2] + u[2]
            printf "%d %s %.1f\n", 6 * s + 5, test, s }' >>"$folder/limits"
    done
    sort -n -o "$folder/limits" "$folder/limits"
}

# order MODULE: prints SECONDS:NAME:WORD, the quickest first.
order() {
    tests "$1" | tr ' ' '\n' | awk '
        NR == FNR { wanted[$1] = 1; next }
        $2 in wanted { print $1 ":" $2 }' - "$folder/limits"
}

# is_same: succeeds if the code is the same as without the change.
is_same() {
    ! find "$tree/$out/obj" -name '*.o' -newer "$folder/stamp" | while read -r object; do
        cmp -s "$object" "$folder/built${object#"$tree/build"}" || { echo other; break; }
    done | grep -q other
}

# verdict MODULE: prints the test that failed, `survived`, `same` or `none`.
verdict() {
    case $1 in
    tools/*) make_it $out/tests ;;
    *) make_it lib ;;
    esac || { echo none; return; }
    ! is_same || { echo same; return; }
    for test in $(order "$1"); do
        limit=${test%%:*}
        test=${test#*:}
        make_it "$out/${test%%:*}" || { echo none; return; }
        run "$test" "$limit" </dev/null || { echo "$test"; return; }
    done
    echo survived
}

# restore FILE VERDICT: restores the source and the build outputs.
restore() {
    cp -p "$folder/$1" "$tree/$1"
    if [ "$2" = none ]; then
        rm -rf "$tree/build"
        cp -pR "$folder/built" "$tree/build"
        return
    fi
    find "$tree/build" -type f -newer "$folder/stamp" | while read -r file; do
        cp -p "$folder/built${file#"$tree/build"}" "$file"
    done
}

# Builds only programs with tests of the modules, in a third of the time of all programs.
programs=$(for module in $modules; do tests "$module"; done | tr ' ' '\n' | sed "s,:.*,,; s,^,$out/," | sort -u)
make_it lib $programs || { tail -5 "$folder/build.log"; exit 1; }
rm -rf "$folder/built"
cp -pR "$tree/build" "$folder/built"
candidates >"$folder/candidates"
[ -f "$folder/limits" ] || : >"$folder/limits"
draw <"$folder/candidates" | awk -v only=" $ONLY " '
    only == "  " || index(only, " " NR " ") { print NR "\t" $0 }' >"$folder/numbered"
cut -f2- "$folder/numbered" >"$folder/drawn"
measure || exit 1
echo "$(wc -l <"$folder/drawn") of $(wc -l <"$folder/candidates") changes"

: >"$folder/result"
tab=$(printf '\t')
while IFS="$tab" read -r number file line at from to; do
    module=${file%/*}
    touch "$folder/stamp"
    change "$file" "$line" "$at" "$from" "$to"
    found=$(verdict "$module")
    restore "$file" "$found"
    echo "$module $found" >>"$folder/result"
    echo "$number $file:$line [$from] -> [$to]: $found"
    [ "$found" != survived ] || sed -n "${line}p" "$folder/$file"
done <"$folder/numbered"

awk '
    $2 == "none" || $2 == "same" { ++not; next }
    { ++tried[$1]; ++all; if ($2 != "survived") { ++killed[$1]; ++dead; ++by[$2] } }
    END {
        for (module in tried) printf "%-16s %d of %d\n", module, killed[module], tried[module] | "sort"
        close("sort")
        for (test in by) printf "by %-12s %d\n", test, by[test] | "sort"
        close("sort")
        printf "noticed: %d of %d, %.0f %%; %d were none\n", dead, all, all ? 100 * dead / all : 0, not
        exit !(all && dead >= 0.85 * all)
    }' "$folder/result"
