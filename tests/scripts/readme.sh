# readme.sh: the C examples of README.md compile without a warning against the library, and run.
#
# An example is the ```c block after a line `<!-- example: .../NAME.c -->`. CC FLAGS LIB LDLIBS B in the environment.
. tests/scripts/checks.sh

dir=$B/readme
rm -rf "$dir"
mkdir -p "$dir"
awk -v dir="$dir" '
    /^<!-- example: [^ ]+ -->$/ { n = split($3, part, "/"); file = dir "/" part[n]; next }
    file && /^```c$/ { inside = 1; next }
    /^```$/ { inside = 0; file = "" }
    inside { print > file }' README.md

for source in "$dir"/*.c; do
    if [ ! -f "$source" ]; then
        fail "README.md has no example"
        break
    fi
    program=${source%.c}
    check "$source compiles" $CC $FLAGS -Werror -o "$program" "$source" "$LIB" $LDLIBS
    [ ! -x "$program" ] || check "$source runs" sh -c 'cd "${1%/*}" && "./${1##*/}"' sh "$program"
done
finish
