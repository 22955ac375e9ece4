# examples.sh: checks that the programs of tests/examples compile without a warning, run, and print the expected lines:
# CC FLAGS LIB LDLIBS B in the environment.
. tests/scripts/checks.sh

dir=$B/examples
mkdir -p "$dir"

# A C++ compiler needs other flags than C, and may be missing.
echo 'int main() { return 0; }' >"$dir/empty.cpp"
cxx_flags=$(printf '%s\n' "$FLAGS" | sed -E 's/-std=[a-z0-9]+/-std=c++11/; s/-Wmissing-prototypes//')
has_cxx=$($CC -x c++ $cxx_flags "$dir/empty.cpp" -o "$dir/empty" -lstdc++ -lpthread 2>/dev/null && echo yes)

run() { # run PROGRAM: prints the last line of output, or all of it if the program fails
    said=$("$1" 2>&1)
    ended=$?
    printf '%s\n' "$said" | tail -n 1 | sed 's/^/  /'
    check "$1: exit status $ended: $said" test $ended -eq 0
}

for source in tests/examples/*.c tests/examples/*.cpp; do
    program=$dir/$(basename "${source%.*}")
    rm -f "$program"
    check "$source has over 80 lines" test "$(wc -l <"$source")" -le 80
    case $source in
    *.c) check "$source compiles" $CC $FLAGS -Werror -o "$program" "$source" "$LIB" $LDLIBS ;;
    *)
        if [ -z "$has_cxx" ]; then
            skip "$source: $CC compiles no C++ here"
            continue
        fi
        check "$source compiles" $CC -x c++ $cxx_flags -Werror -o "$program" "$source" -x none "$LIB" $LDLIBS -lstdc++ \
            -lpthread
        ;;
    esac
    [ ! -x "$program" ] || run "$program"
done
finish
