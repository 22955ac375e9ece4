# help.sh: help and version of each verb, the man page, the doctor. Needs CC FLAGS LIB LDLIBS.
. tests/cli/common.sh

# Help and version go to stdout.
status 0 --version
check "lambent --version says something" test -s out.txt
status 0 lambent-bench --version
check "lambent-bench --version names it" grep -q '^lambent-bench [0-9]' out.txt
for ask in --help "render --help" "compare --help" "info --help" "lambent-bench --help"; do
    status 0 $ask
    check "lambent $ask says something, once" test "$(grep -c '^usage:' out.txt)" -eq 1
done
verbs="render bake play capture relight relief relief_bake relief_render mix explain pack merge plan compare info doctor"
measures="raster draw gather threads hard --calibrate demo relight relief mix merge"

# spoken NAME COMMAND...: checks version and help of the command, a program with words behind it.
spoken() {
    name=$1
    shift
    status 0 "$@" -V
    check "$* -V is the version" grep -q "^$name [0-9.]*\$" out.txt
    status 0 "$@" -h
    check "$* --help has under 100 columns" awk 'length($0) > 99 { exit 1 }' out.txt
    check "$* --help is that of $name" grep -q "^usage: $name " out.txt
}
for verb in $verbs; do
    spoken lambent $(echo $verb | tr _ ' ')
done
for measure in $measures ""; do
    spoken lambent-bench lambent-bench $measure
done

# asked NAME HELP WORD...: checks that `help` with the words prints HELP, and keeps the options in NAME.options.
asked() {
    name=$1 both=$2
    shift 2
    cp out.txt help.txt
    status 0 $both "$@"
    check "$both $* is the same as --help" cmp help.txt out.txt
    grep -oE '^  (-[a-zA-Z], )?--?[a-z][a-z0-9-]*' help.txt | sed 's/.* //' >>"$name.options"
}
for verb in $verbs; do
    words=$(echo $verb | tr _ ' ')
    status 0 $words --help
    asked lambent help $words
done
for measure in $measures; do
    status 0 lambent-bench $measure --help
    asked lambent-bench "lambent-bench help" $measure
done
status 0 help
check "help lists the verbs" grep -q '^  doctor ' out.txt
check "help names the second program" grep -q '^  lambent-bench --help ' out.txt
status 2 help rendr
said "did you mean render?"
# A user who has the old verb in a script learns the name of the program.
for words in "bench demo" "bench --help" "help bench"; do
    status 2 $words
    said "lambent: bench is the program lambent-bench: give it the same words"
    check "lambent $words says only that" one_line err.txt
done
for name in lambent lambent-bench; do
    [ $name = lambent ] && status 0 help --man || status 0 $name help --man
    cp out.txt $name.1
    sed 's/\\-/-/g' $name.1 >plain.1
    missing=$(awk 'NR == FNR { page = page $0 "\n"; next } !index(page, "\\fB" $0 "\\fR")' plain.1 $name.options)
    check "options that the man page of $name lacks: $missing" test -z "$missing" -a "$(grep -c . $name.options)" -gt 50
    check "the man page of $name has its name" grep -q "^$name - " plain.1
done
if command -v groff >/dev/null; then
    for name in lambent lambent-bench; do
        check "groff has a warning about the man page of $name" sh -c 'test -z "$(groff -man -Tutf8 -ww -z "$1" 2>&1)"' sh $name.1
    done
    check "the man page has its examples as they are" sh -c "groff -man -Tascii -rLL=150n \"\$1\" | grep -qF \"printf 'f %s\\\\n' '1 2 3' '1 4 2' '2 4 3' '3 4 1' >>tent.obj\"" sh lambent.1
else
    skip "the man page: no groff"
fi
for verb in render bake play capture relight "relief bake" "relief render" mix plan "lambent-bench threads" "lambent-bench --calibrate"; do
    status 0 $verb --help
    check "$verb has --threads" grep -q '^  --threads N' out.txt
done

# Runs the example of the doctor.
pasted doctor
if [ -n "$SHORT" ]; then
    status 0 doctor -v
    cp out.txt paste/said-doctor.txt
fi
check "the doctor says what draws" sh -c 'grep -c "exact (.*), draws where none is named$" "$1" | grep -qx 1' sh paste/said-doctor.txt
check "the doctor tries all lanes" grep -q '^scalar  *exact' paste/said-doctor.txt
check "the doctor says the flags" grep -q '^flags .*-ffp-contract=off' paste/said-doctor.txt
# A doctor that expects another hash reports it and returns 1. Objects of deleted sources may exist.
for object in "$B"/obj/tools/*/*.o "$B"/obj/platform/host/*.o; do
    source=${object#"$B"/obj/}
    case $source in *verb_doctor* | *port_* | *main_*) continue ;; esac
    [ -e "$root/${source%.o}.c" ] && printf '"%s"\n' "$object"
done >objects
if compile '-DROOM_HASH=UINT64_C(1)' -I"$B" -c tools/cli/verb_doctor.c -o "$PWD/ill.o" &&
    compile -o "$PWD/ill" @"$PWD/objects" "$PWD/ill.o" "$LIB" $LDLIBS; then
    ./ill doctor >out.txt 2>err.txt
    check "a doctor that finds other bytes has status 1" test $? -eq 1
    check "and says so in one line" sh -c 'test "$(wc -l <"$1")" -eq 1 && grep -q "draws .* instead of 0000000000000001" "$1"' sh err.txt
else
    fail "a doctor with another hash does not compile"
fi

finish
