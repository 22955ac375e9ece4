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

# Each requirement of worlds and photos has a row of the table and a command, and the command shows it. Files are in
# the clean copy.
for number in S1 S9 S10 S20 S27 S28 S29 M5 M20 M25 M26; do
    check "$number has a row and a command" sh -c 'grep -qE "^\|.* $1[ ,]" "$2" && grep -qE "^#.* $1[,: ]" "$2"' sh "$number" tools/README.md
done
shown() { # TEXT COMMAND...: runs in the folder of the blocks' files
    text=$1
    shift
    check "$text" sh -c 'cd "$1" && shift && "$@"' sh "$dir/clone/build" "$@"
}
differ() { shown "$1" sh -c 'test -s "$1" && test -s "$2" && ! cmp -s "$1" "$2"' sh "$2" "$3"; }
shown "S1: the black half is counted" sh -c './lambent relight --world half.pfm --cube again.pfm 2>&1 | grep -q "50 % of it is black"'
shown "S9: a map that begins at 0 degrees is not one that begins at -180" sh -c './lambent relight --world half.pfm --azimuth 0 --map zero.pfm >/dev/null 2>&1 && ./lambent relight --world half.pfm --map west.pfm >/dev/null 2>&1 && ! cmp -s zero.pfm west.pfm'
shown "S10, S29: a loaded transform image gives the map that it was saved with" cmp map.pfm map2.pfm
differ "S20, S28: a new world changes the picture of a place" change_00.png change_01.png
differ "S20, S28: numbered worlds change it" dusk_00.png dusk_02.png
differ "S20, S28: a blend is neither" dusk_00.png dusk_01.png
differ "S20, S28: numbered worlds change the frames of play" dusk_play_00.png dusk_play_02.png
shown "S27: two eyes are side by side" sh -c './lambent info both.png | grep -qE "^size +128x48"'
differ "M5, M20: the object changes the photo" r.color.png middle.png
differ "M25: a glowing object changes it differently" middle.png glow.png
shown "M25: the floor is brighter" sh -c './lambent info r.color.png | awk "/red .*mean/{print \$NF}" >a.txt && ./lambent info glow.png | awk "/red .*mean/{print \$NF}" | paste a.txt - | awk "{ exit !(\$2 > \$1) }"'
differ "M26: a photo without depth has the object" r2.color.png two_01.png
blocks=$(cat tools/README.md include/README.md platform/README.md | grep -c '^<!-- run: .* -->$')
check "all users' blocks" test "$(ls "$dir"/*.sh | wc -l)" -eq "$blocks" -a "$blocks" -ge 10
finish
