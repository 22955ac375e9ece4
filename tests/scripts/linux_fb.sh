# linux_fb.sh: draws the room into a file in place of a framebuffer device, and checks that the last picture equals the
# host port's, on a screen of the same size and centred on a larger one. MAKE, BUILD in the environment.
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
