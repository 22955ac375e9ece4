# try.sh: runs one test by its name, after a build of the files that changed: MAKE B and T in the environment.
#
#     T=cut            each test of that name: unit/cut; a name of two kinds runs both
#     T=golden/torus   one kind: unit, analytic, truth, lanes, golden, hard, cli
#     T=words          a check of the Makefile, if no test has the name
# Exits 1 if the test fails, and 2 with a list of similar names if there is none.
kinds=$(
    for file in tests/unit/test_*.c tests/analytic/test_*.c tests/truth/test_*.c tests/lanes/test_*.c; do
        group=${file#tests/} name=${file##*/test_}
        name=${name%.c} group=${group%%/*}
        echo "$group/$name"
    done
    sed -nE 's,^ *\{"([a-z0-9-]+)"\, case_.*,golden/\1,p' tests/golden/*.inc
    sed -n '/^const char \*const hard_groups/{s/^[^{]*{//;s/NULL.*//;s/[",]/ /g;p;}' tools/hard/hard.c |
        tr -s ' ' '\n' | sed -n 's,^[a-z],hard/&,p'
    printf '%s\n' hard/invariants hard/again
    for file in tests/cli/*.sh; do
        name=${file##*/}
        case $name in '*.sh' | common.sh) ;; *) echo "cli/${name%.sh}" ;; esac
    done
)

# similar WORD: names that contain the word or differ from it by few letters, nearest first.
similar() {
    printf '%s\n' "$kinds" $CHECK_NAMES | awk -v word="$1" '
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
        {
            name = $0
            if (word !~ /\//) sub(/^.*\//, "", name)
            far = distance(word, name)
            if (index(name, word) || index(word, name) && length(name) > 3) far = far < 2 ? far : 2
            if (far <= 2 && far < length(word) - 1) print far, $0
        }' | sort -n | cut -d ' ' -f 2 | head -n 12
}

if [ -z "$T" ]; then
    echo "make try: T names no test; for example: make try T=cut, T=golden/torus, T=hard/shadow, T=cli/help" >&2
    exit 2
fi
# A name that begins with its kind is one test; any other is each kind's test of that name.
found=$(printf '%s\n' "$kinds" | awk -v word="$T" '{ name = $0; sub(/^[^\/]*\//, "", name) } $0 == word || name == word')
if [ -z "$found" ]; then
    for check in $CHECK_NAMES; do
        [ "$check" != "$T" ] || exec $MAKE "$T"
    done
    near=$(similar "$T" | tr '\n' ' ')
    echo "make try: there is no test $T; similar names: ${near:-none}" >&2
    exit 2
fi

failed=0
for test in $found; do
    name=${test#*/}
    case $test in
    golden/*) program=$B/golden-one ;;
    hard/*) program=$B/hard ;;
    cli/*) program= ;;
    *) program=$B/tests ;;
    esac
    if [ -z "$program" ]; then
        $MAKE cli PART="$name" || failed=1
    else
        $MAKE "$program" && "$program" "$name" || failed=1
    fi
done
exit $failed
