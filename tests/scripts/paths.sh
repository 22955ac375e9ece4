# paths.sh: what the documents tell a new user to type works in a clean copy, block by block; B in the environment.
#
# A block is the one between ``` after a line `<!-- run: WHAT -->`, or `<!-- run: WHAT; needs COMMAND... -->`. Each runs
# by `sh -e`; every file that it names after -o has to be there afterwards.
. tests/scripts/checks.sh

case $B in /*) dir=$B/paths ;; *) dir=$PWD/$B/paths ;; esac
rm -rf "$dir"
mkdir -p "$dir/clone"
check "a clean copy" clean_copy "$dir/clone"

# The blocks as files 1.sh, 2.sh, ... whose first line is what they show, the second what they need.
cat tools/README.md include/README.md platform/README.md | awk -v dir="$dir" '
    /^<!-- run: .* -->$/ {
        what = needs = substr($0, 11, length($0) - 14)
        sub(/; needs .*/, "", what)
        if (!sub(/.*; needs /, "", needs)) needs = ""
        next
    }
    what != "" && /^```$/ { if (file == "") { file = dir "/" ++n ".sh"; print "# " what "\n# " needs > file } else { close(file); file = what = "" } next }
    file != "" { print > file }'

# What the commands build is compared with pictures elsewhere. The build of this make serves if its flags are CFLAGS:
# only its copy in the clean copy's place saves building everything once more.
flags=$CFLAGS
mkdir -p "$dir/clone/build/default"
cp -pR "$B/obj" "$B/flags" "$B/liblambent.a" "$dir/clone/build/default" && cp -p "$TOOL" "$dir/clone/build/lambent"
[ ! -d "$B/../tiny/obj" ] || cp -pR "$B/../tiny" "$dir/clone/build"
for block in "$dir"/*.sh; do
    what=$(sed -n '1s/^# //p' "$block")
    if missing=$(sh tests/scripts/tools.sh need $(sed -n '2s/^# //p' "$block") 2>&1); then
        check "$what" sh -c 'cd "$1" && env -i PATH="$PATH" HOME="$HOME" CC="$4" CFLAGS="$3" sh -e "$2"' sh "$dir/clone" "$block" "$flags" "$CC"
        for out in $(tr -s ' \n' '\n\n' <"$block" | sed -n '/^-o$/{n;p;}'); do
            check "$what: $out is there" test -s "$dir/clone/$out"
        done
    else
        skip "$what: $missing"
    fi
done
blocks=$(cat tools/README.md include/README.md platform/README.md | grep -c '^<!-- run: .* -->$')
check "all users' blocks" test "$(ls "$dir"/*.sh | wc -l)" -eq "$blocks" -a "$blocks" -ge 10
finish
