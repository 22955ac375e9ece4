# paths.sh: checks that the command blocks in the documents work in a clean copy, one by one; B in the environment.
#
# A block is between ``` after a line `<!-- run: TEXT -->`, or `<!-- run: TEXT; needs COMMAND... -->`. Each block
# runs with `sh -e`; every file that it names after -o must exist afterwards,
# with 00 for %02d.
. tests/scripts/checks.sh

case $B in /*) dir=$B/paths ;; *) dir=$PWD/$B/paths ;; esac
rm -rf "$dir"
mkdir -p "$dir/clone"
check "a clean copy" clean_copy "$dir/clone"

# The blocks as files 1.sh, 2.sh, ...; line 1 has the text, line 2 the needed commands.
cat tools/README.md include/README.md platform/README.md | awk -v dir="$dir" '
    /^<!-- run: .* -->$/ {
        what = needs = substr($0, 11, length($0) - 14)
        sub(/; needs .*/, "", what)
        if (!sub(/.*; needs /, "", needs)) needs = ""
        next
    }
    what != "" && /^```$/ { if (file == "") { file = dir "/" ++n ".sh"; print "# " what "\n# " needs > file } else { close(file); file = what = "" } next }
    file != "" { print > file }'

# Other checks compare the built pictures. If the flags are CFLAGS, a copy of the existing build in the clean copy saves
# a second one.
flags=$CFLAGS
mkdir -p "$dir/clone/build/default"
cp -pR "$B/obj" "$B/flags" "$B/liblambent.a" "$dir/clone/build/default" && cp -p "$TOOL" "$dir/clone/build/lambent"
[ ! -d "$B/../tiny/obj" ] || cp -pR "$B/../tiny" "$dir/clone/build"
for block in "$dir"/*.sh; do
    what=$(sed -n '1s/^# //p' "$block")
    if missing=$(sh tests/scripts/tools.sh need $(sed -n '2s/^# //p' "$block") 2>&1); then
        check "$what" sh -c 'cd "$1" && env -i PATH="$PATH" HOME="$HOME" CC="$4" CFLAGS="$3" sh -e "$2"' sh "$dir/clone" "$block" "$flags" "$CC"
        for out in $(tr -s ' \n' '\n\n' <"$block" | sed -n '/^-o$/{n;s/%02d/00/;p;}'); do
            check "$what: $out is there" test -s "$dir/clone/$out"
        done
    else
        skip "$what: $missing"
    fi
done
blocks=$(cat tools/README.md include/README.md platform/README.md | grep -c '^<!-- run: .* -->$')
check "all users' blocks" test "$(ls "$dir"/*.sh | wc -l)" -eq "$blocks" -a "$blocks" -ge 10
finish
