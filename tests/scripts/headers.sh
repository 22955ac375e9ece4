# headers.sh: each public header compiles alone, and twice, as C99 and as C++: CC and B in the environment.
. tests/scripts/checks.sh

warnings="-Wall -Wextra -pedantic -Wshadow -Werror -Iinclude"
dir=$B/headers
mkdir -p "$dir"

try() { # try HEADER LANGUAGE STANDARD
    printf '#include <lambent/%s>\n#include <lambent/%s>\ntypedef int not_empty;\n' "$1" "$1" >"$dir/$1.inc"
    check "$1 alone as $3" $CC -x "$2" -std="$3" $warnings -fsyntax-only "$dir/$1.inc"
}

echo >"$dir/empty.inc"
has_cxx=$($CC -x c++ -fsyntax-only "$dir/empty.inc" 2>/dev/null && echo yes)
[ -n "$has_cxx" ] || skip "headers as C++: $CC compiles no C++ here"
for path in include/lambent/*.h; do
    try "$(basename "$path")" c c99
    [ -z "$has_cxx" ] || try "$(basename "$path")" c++ c++98
done
finish
