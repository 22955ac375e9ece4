# linux_fb.sh: draws the room into a file in place of a framebuffer device, and checks that the last picture equals the
# host port's, on a screen of the same size and centred on a larger one. Checks the room's title and frame counter.
# MAKE, BUILD in the environment.
. tests/scripts/checks.sh
dir=$BUILD/linux-fb-test
rm -rf "$dir"
mkdir -p "$dir/host"
check "the host's room" $MAKE room ROOM_SIZE="320 240 16" BUILD="$BUILD/linux-fb-host"
check "the framebuffer's room" $MAKE room PORT=linux-fb BUILD="$BUILD/linux-fb"
[ $failed -eq 0 ] || finish
ROOM_PICTURES=$dir/host "$BUILD/linux-fb-host/default/room" >"$dir/host.out"
check "the host's room runs" test $? -eq 0
room=$BUILD/linux-fb/default/room
tail -c 230400 "$dir/host/frame_59.ppm" | od -An -v -tu1 -w3 | awk '{ print $1, $2, $3 }' >"$dir/expected"
# The room's own codes end at 248, so pixels of 255 are the title: twelve cells of 6 x 8 px from (4, 4), the eighth empty.
cells() { # cells FRAME: prints cell, x and y of each
    tail -c 230400 "$dir/host/frame_$1.ppm" | od -An -v -tu1 -w3 | awk '$1 == 255 && $2 == 255 && $3 == 255 {
        x = (NR - 1) % 320 - 4; y = int((NR - 1) / 320) - 4
        cell = (x < 0 || x >= 72 || y < 0 || y >= 8) ? "outside" : int(x / 6)
        print cell, x, y }'
}
for frame in 58 59; do cells $frame >"$dir/cells$frame"; done
check "the title is in its cells" awk '{ ++n[$1] } END { for (i = 0; i < 12; ++i) ok += (i == 7 && n[i] == 0) || (i != 7 && n[i] >= 5)
    exit !(ok == 12 && n["outside"] == 0) }' "$dir/cells59"
for frame in 58 59; do grep -v '^11 ' "$dir/cells$frame" >"$dir/title$frame"; done
check "title and tens of frames 58 and 59 are alike" cmp "$dir/title58" "$dir/title59"
check "their last digits are not" sh -c '! cmp -s "$1" "$2"' sh "$dir/cells58" "$dir/cells59"
FB_FILE=$dir/same.fb FB_SIZE=320x240x32 "$room" >"$dir/same.out"
od -An -v -tu1 -w4 "$dir/same.fb" | awk '{ print $3, $2, $1 }' >"$dir/same"
check "the screen has the host's picture" cmp "$dir/expected" "$dir/same"
FB_FILE=$dir/large.fb FB_SIZE=400x300x32 "$room" >"$dir/large.out"
od -An -v -tu1 -w4 "$dir/large.fb" \
    | awk '{ x = (NR - 1) % 400; y = int((NR - 1) / 400) } x >= 40 && x < 360 && y >= 30 && y < 270 { print $3, $2, $1 }' >"$dir/large"
check "the middle of a larger screen has it" cmp "$dir/expected" "$dir/large"
hashes() { grep '^frame ' "$1"; }
check "equal hashes" test "$(hashes "$dir/host.out")" = "$(hashes "$dir/same.out")"
FB_FILE=$dir/small.fb FB_SIZE=160x120x32 "$room" >"$dir/small.out" 2>"$dir/said"
check "a screen that is too small: exit status $?" test $? -eq 1
check "a screen that is too small is named" grep -q 'small.fb: needs 320x240' "$dir/said"
finish
