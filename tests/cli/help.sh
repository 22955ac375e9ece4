# help.sh: help and version of each verb, the man page, the doctor. Needs CC FLAGS LIB LDLIBS.
. tests/cli/common.sh

# Help and version go to stdout.
status 0 --version
check "lambent --version says something" test -s out.txt
for ask in --help "render --help" "compare --help" "info --help" "bench --help"; do
    status 0 $ask
    check "lambent $ask says something, once" test "$(grep -c '^usage:' out.txt)" -eq 1
done
for verb in render play capture explain relight relief "relief bake" "relief render" mix pack merge plan compare info bench "bench raster" "bench draw" "bench gather" \
    "bench threads" "bench hard" "bench --calibrate" "bench demo" "bench relight" "bench relief" "bench mix" doctor; do
    status 0 $verb -V
    check "lambent $verb -V is the version" grep -q '^lambent [0-9.]*$' out.txt
    status 0 $verb -h
    check "$verb --help has under 100 columns" awk 'length($0) > 99 { exit 1 }' out.txt
done
for verb in render bake play capture relight relief "relief bake" "relief render" mix plan compare info bench "bench raster" "bench draw" "bench gather" \
    "bench threads" "bench hard" "bench --calibrate" "bench SCENE" "bench relight" "bench relief" "bench mix" doctor; do
    "$TOOL" $verb --help >help.txt
    status 0 help $verb
    check "help $verb is $verb --help" cmp help.txt out.txt
    grep -oE '^  (-[a-zA-Z], )?--?[a-z][a-z0-9-]*' help.txt | sed 's/.* //' >>options.txt
done
status 0 help
check "help lists the verbs" grep -q '^  doctor ' out.txt
status 2 help rendr
said "did you mean render?"
status 0 help --man
cp out.txt lambent.1
sed 's/\\-/-/g' lambent.1 >plain.1
missing=$(awk 'NR == FNR { page = page $0 "\n"; next } !index(page, "\\fB" $0 "\\fR")' plain.1 options.txt)
check "options that the man page lacks: $missing" test -z "$missing" -a "$(grep -c . options.txt)" -gt 100
if command -v groff >/dev/null; then
    check "groff has a warning about the man page" sh -c 'test -z "$(groff -man -Tutf8 -ww -z "$1" 2>&1)"' sh lambent.1
    check "the man page has its examples as they are" sh -c "groff -man -Tascii -rLL=150n \"\$1\" | grep -qF \"printf 'f %s\\\\n' '1 2 3' '1 4 2' '2 4 3' '3 4 1' >>tent.obj\"" sh lambent.1
else
    skip "the man page: no groff"
fi
for verb in render bake play capture relight "relief bake" "relief render" mix plan "bench threads" "bench --calibrate"; do
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
