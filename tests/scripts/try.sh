# try.sh: runs one test by its name, after a build of the files that changed: MAKE B T and CHECK_NAMES in the environment.
#
#     T=cut            all tests of that name, of each kind
#     T=golden/torus   one kind: unit, analytic, truth, lanes, golden, hard, cli
#     T=words          a check of the Makefile, if no test has the name
# A path such as tests/unit/test_cut.c selects that test. The last line is the sum. If there is no such test, the script
# prints similar names, or the tests of the folder of src or tools that T names.
. tests/scripts/checks.sh

kinds=$(
    for file in tests/unit/test_*.c tests/analytic/test_*.c tests/truth/test_*.c tests/lanes/test_*.c; do
        group=${file#tests/} name=${file##*/test_}
        echo "${group%%/*}/${name%.c}"
    done
    sed -nE 's,^ *\{"([a-z0-9-]+)"\, case_.*,golden/\1,p' tests/golden/*.inc
    sed -n '/^const char \*const hard_groups/,/NULL/{s/^[^{]*{//;s/NULL.*//;s/[",]/ /g;p;}' tools/hard/hard.c |
        tr -s ' ' '\n' | sed -n 's,^[a-z],hard/&,p'
    printf '%s\n' hard/invariants hard/again hard/masks
    for file in tests/cli/*.sh; do
        name=${file##*/}
        [ "$name" = common.sh ] || echo "cli/${name%.sh}"
    done
)
for kind in unit golden hard/r cli; do
    case $kinds in *"$kind"*) ;; *) fail "make try finds no $kind tests" && finish ;; esac
done

if [ -z "$T" ]; then
    echo "make try: T names no test; for example: make try T=cut, T=golden/torus, T=hard/shadow, T=cli/help" >&2
    exit 2
fi
wanted=$(printf '%s' "$T" | tr 'A-Z\n' 'a-z ')
wanted=${wanted#tests/} wanted=${wanted%.c} wanted=${wanted%.sh}
case $wanted in
slow/*) wanted=unit/${wanted#slow/} ;;
src/*/* | tools/*/*) wanted=${wanted%/*} ;;
test_*) wanted=${wanted#test_} ;;
*/test_*) wanted=${wanted%%/test_*}/${wanted##*/test_} ;;
esac

# similar: names that contain the word or that differ from it by few letters, nearest first.
similar() {
    printf '%s\n' "$kinds" $CHECK_NAMES | WANTED=$wanted awk '
        function distance(a, b,    i, j, n, m, row, last, cost) {
            n = length(a); m = length(b)
            for (j = 0; j <= m; ++j) last[j] = j
            for (i = 1; i <= n; ++i) {
                row[0] = i
                for (j = 1; j <= m; ++j) {
                    cost = last[j - 1] + (substr(a, i, 1) != substr(b, j, 1))
                    if (last[j] + 1 < cost) cost = last[j] + 1
                    if (row[j - 1] + 1 < cost) cost = row[j - 1] + 1
                    row[j] = cost
                }
                for (j = 0; j <= m; ++j) last[j] = row[j]
            }
            return last[m]
        }
        BEGIN { word = ENVIRON["WANTED"] }
        {
            name = $0
            if (word !~ /\//) sub(/^.*\//, "", name)
            far = distance(word, name)
            if (index(name, word) || index(word, name) && length(name) > 3) far = far < 2 ? far : 2
            if (far <= 2 && (far < length(word) - 1 || index(name, word))) print far, $0
        }' | sort -n | cut -d ' ' -f 2 | head -n 12
}

# of_folder: the tests that tests/scripts/mutants.txt names for the folder of that name.
of_folder() {
    WANTED=$wanted awk '
        BEGIN { word = ENVIRON["WANTED"] }
        /^#/ || /^$/ { mine = 0; next }
        /^[^ ]/ { folder = $1; sub(/^(src|tools)\//, "", folder); mine = word == $1 || word == folder; $1 = "" }
        mine && $1 != "-" { for (i = 1; i <= NF; ++i) { sub(/^tests:/, "", $i); sub(/:/, "/", $i); print $i } }' tests/scripts/mutants.txt
}

# A name with a kind in front is one test; any other name selects the tests of that name in all kinds.
found=$(printf '%s\n' "$kinds" |
    WANTED=$wanted awk '{ name = $0; sub(/^[^\/]*\//, "", name) } $0 == ENVIRON["WANTED"] || name == ENVIRON["WANTED"]')
if [ -z "$found" ]; then
    for check in $CHECK_NAMES; do
        [ "$check" != "$wanted" ] || exec $MAKE "$check"
    done
    names=$(of_folder | tr '\n' ' ')
    if [ -n "$names" ]; then
        echo "make try: $T is a folder; its tests:" $names >&2
        exit 2
    fi
    near=$(similar | tr '\n' ' ')
    [ -z "$near" ] && near="T=src/tree lists the tests of a folder" || near="similar names: $near"
    echo "make try: there is no test $T; $near" >&2
    exit 2
fi

# one COMMAND...: prints the output except for the last line, which has the counts.
one() {
    "$@" >"$B/try.log" 2>&1
    ended=$?
    sed '$d' "$B/try.log"
    counts=$(tail -n 1 "$B/try.log")
    case $counts in
    [0-9]*" passed, "[0-9]*" failed, "[0-9]*" skipped")
        passed=$((passed + ${counts%% passed*}))
        counts=${counts#* passed, }
        failed=$((failed + ${counts%% failed*}))
        skipped=$((skipped + $(expr "$counts" : '.*failed, \([0-9]*\)')))
        [ $ended -eq 0 ] || [ $failed -gt 0 ] || fail "$*: exit status $ended"
        ;;
    *)
        printf '%s\n' "$counts"
        fail "$*: exit status $ended, without a sum"
        ;;
    esac
}

for test in $found; do
    name=${test#*/}
    case $test in
    golden/*) program=$B/golden-one ;;
    hard/*) program=$B/hard ;;
    cli/*)
        $MAKE all && one $MAKE cli PART="$name" || fail "$test"
        continue
        ;;
    *) program=$B/tests ;;
    esac
    if $MAKE "$program"; then
        one "$program" "$name"
    else
        fail "$test does not build"
    fi
done
finish
