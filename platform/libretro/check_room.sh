# check_room.sh: is the room on a console the host's, by hashes, by what the screen shows, and as buttons steer it?
# check_room.sh PORT WIDTH HEIGHT. Ends with `N passed, N failed, N skipped`.
. tests/scripts/checks.sh
port=$1 width=$2 height=$3
out=build/$port/default
case $port in
gba) press="right@0+100 a@0+100" ;;
*) press="left@0+20 l@0+20" ;;
esac
host=build/room-$width-$height
check "the host's room" make room BUILD="$host" PORT=host ROOM_SIZE="$width $height 8"

# host FOLDER [HELD]: frames as a screen of 5 bits a colour shows them.
host() {
    rm -rf "$1"
    mkdir -p "$1"
    ROOM_PICTURES=$1 ROOM_COLOURS=555 ROOM_HELD=$2 "$host/default/room" > "$1/said.txt"
}
same_hashes() {
    grep '^frame' "$out/room.txt" > "$out/hashes.txt"
    [ "$(wc -l < "$out/hashes.txt")" = 3 ] && grep '^frame' "$host/path/said.txt" | diff - "$out/hashes.txt"
}

rm -f "$out/room.txt" "$out/room.ppm" # of another run
host "$host/path"
check "it runs" make run PORT="$port"
check "hashes of frames 0, 30 and 59" same_hashes
check "the screen after the path is frame 59" cmp "$host/path/frame_59.ppm" "$out/room.ppm"

rm -f "$out/room.txt" "$out/room.ppm"
# What was held, frame by frame, is what the console says; then the last picture is the host's.
check "it runs with buttons" make run PORT="$port" PRESS="$press"
held=$(sed -n 's/^held //p' "$out/room.txt" | tr '\n' ' ')
host "$host/steered" "$held"
last=$(ls "$host/steered" | grep frame_ | tail -n 1)
check "buttons were held in some frames: $held" test -n "$held"
check "they change the picture" sh -c "! cmp -s '$host/path/frame_59.ppm' '$host/steered/$last'"
check "the screen then is the host's" cmp "$host/steered/$last" "$out/room.ppm"
finish
