# headers.sh: checks that each public header compiles on its own, and twice, as C99 and as C++, and that src compiles as
# one unit as both, in each configuration, so that no two files give a name two meanings: CC and B in the environment.
. tests/scripts/checks.sh

warnings="-Wall -Wextra -pedantic -Wshadow -Werror -Iinclude"
dir=$B/headers
rm -rf "$dir"
mkdir -p "$dir"

for path in include/lambent/*.h; do
    header=${path##*/}
    printf '#include <lambent/%s>\n#include <lambent/%s>\ntypedef int not_empty;\n' "$header" "$header" >"$dir/$header.inc"
done

# try LANGUAGE STANDARD: compiles all with one command, in a third of the time; if that fails, each separately.
try() {
    if $CC -x "$1" -std="$2" $warnings -fsyntax-only "$dir"/*.h.inc >/dev/null 2>&1; then
        passed=$((passed + $(ls "$dir"/*.h.inc | wc -l)))
        return
    fi
    for source in "$dir"/*.h.inc; do
        name=${source##*/}
        check "${name%.inc} alone as $2" $CC -x "$1" -std="$2" $warnings -fsyntax-only "$source"
    done
}

echo >"$dir/empty.inc"
has_cxx=$($CC -x c++ -fsyntax-only "$dir/empty.inc" 2>/dev/null && echo yes)
[ -n "$has_cxx" ] || skip "headers as C++: $CC compiles no C++ here"
try c c99
[ -z "$has_cxx" ] || try c++ c++98

# one_unit TEXT OPTION...: compiles all of src but the kernels as one unit, without output.
one_unit() {
    text=$1
    shift
    for path in src/*/*.c; do
        case $path in src/isa/*) ;; *) printf '#include "%s"\n' "$path" ;; esac
    done | $CC "$@" -Werror -Iinclude -I. -fsyntax-only - >"$dir/one_unit.log" 2>&1
    status=$?
    [ $status -eq 0 ] || grep -m 5 error: "$dir/one_unit.log"
    check "src as one unit, $text" test $status -eq 0
}
one_unit "C99" -x c -std=c99 -Wall
one_unit "C99, tiny configuration" -x c -std=c99 -Wall -DLMB_CONFIG_TINY
[ -z "$has_cxx" ] || one_unit "C++" -x c++ -std=c++17 -w
finish
