# readme.sh: checks that the C examples of README.md and include/README.md compile without a warning, and run.
#
# An example is the ```c block after a line `<!-- example: .../NAME.c -->`. The example of baked light uses the scene
# made by the commands above it, and readme_baked_main.c adds the rest of a program. CC FLAGS LIB TOOL LDLIBS B in the
# environment.
. tests/scripts/checks.sh

dir=$B/readme
rm -rf "$dir"
mkdir -p "$dir"
awk -v dir="$dir" '
    /^<!-- example: [^ ]+ -->$/ { n = split($3, part, "/"); file = dir "/" part[n]; next }
    file && /^```c$/ { inside = 1; next }
    /^```$/ { inside = 0; file = "" }
    inside { print > file }' README.md include/README.md

baked=$dir/readme_baked
check "include/README.md has its example" test -f "$baked.c"
check "its scene" "$TOOL" pack demo -o "$dir/scene.lmp"
check "its light" "$TOOL" bake "$dir/scene.lmp" -o "$dir/scene.lmt" --elements 256 --receivers 300 --cluster 0.6 --once -q
check "both as C" "$TOOL" pack "$dir/scene.lmp" --transfer "$dir/scene.lmt" -o "$dir/room.c"
echo 'uint64_t picture_hash(void); uint64_t picture_hash(void) { return lmb_surface_hash(&frame.out); }' >>"$baked.c"
mkdir -p "$dir/baked"
mv "$baked.c" "$dir/room.c" "$dir/baked"
check "$baked compiles" $CC $FLAGS -Werror -o "$baked" "$dir"/baked/*.c \
    tests/scripts/readme_baked_main.c "$LIB" $LDLIBS
check "$baked runs" "$baked"

for source in "$dir"/*.c; do
    if [ ! -f "$source" ]; then
        fail "README.md has no example"
        break
    fi
    program=${source%.c}
    check "$source compiles" $CC $FLAGS -Werror -o "$program" "$source" "$LIB" $LDLIBS
    rm -f "$dir/picture.pam"
    [ ! -x "$program" ] || check "$source runs" sh -c 'cd "${1%/*}" && "./${1##*/}"' sh "$program"
    [ ! -f "$dir/picture.pam" ] || check "the tool reads the picture of $source" \
        sh -c '"$1" info "$2" | grep -q "^channels  *4, "' sh "$TOOL" "$dir/picture.pam"
done
finish
