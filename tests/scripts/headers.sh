# headers.sh: checks that each public header compiles on its own, and twice, as C99 and as C++: CC and B in the
# environment.
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
finish
