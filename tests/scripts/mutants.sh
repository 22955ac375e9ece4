# mutants.sh: reads mutants.txt; mutate.sh and layers.sh source it.

# mutant_rows TABLE: prints each row as one line, FOLDER WORD...
mutant_rows() {
    awk '
        /^#/ || /^$/ { next }
        /^ / { sub(/^ +/, ""); row = row " " $0; next }
        { if (row != "") print row; row = $0 }
        END { if (row != "") print row }' "$1"
}

# is_test ROOT PROGRAM:WORD: succeeds if the tests in ROOT/tests include it.
is_test() {
    case $2 in
    golden | reference:hard) ;;
    tests:unit | tests:analytic | tests:truth | tests:lanes) ;;
    tests:*)
        for group in unit analytic truth lanes; do
            [ ! -f "$1/tests/$group/test_${2#tests:}.c" ] || return 0
        done
        return 1
        ;;
    hard:*) grep -qF "\"${2#hard:}\"" "$1/tools/hard/hard.c" "$1/tests/hard/main_hard.c" ;;
    *) return 1 ;;
    esac
}

# mutant_faults TABLE ROOT: prints a line for each folder of ROOT/src and ROOT/tools that has not exactly one row, each
# row without a folder, each row without tests or a reason, and each test that does not exist.
mutant_faults() {
    mutant_rows "$1" | while read -r row words; do
        [ -d "$2/$row" ] || echo "$row: there is no such folder"
        case $words in
        "- "?*) continue ;;
        "" | -) echo "$row: neither tests nor a reason"; continue ;;
        esac
        for word in $words; do
            is_test "$2" "$word" || echo "$row: there is no test $word"
        done
    done
    for place in "$2"/src/*/ "$2"/tools/*/; do
        place=${place#"$2"/}
        place=${place%/}
        [ "$(mutant_rows "$1" | grep -c "^$place ")" = 1 ] || echo "$place: mutants.txt has not one row for it"
    done
}
