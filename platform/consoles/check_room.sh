# check_room.sh: compares the room on a console with the host's, by hashes, by the screen, and when buttons steer.
# check_room.sh PORT WIDTH HEIGHT. Needs MAKE and BUILD in the environment. Ends with `N passed, N failed, N skipped`.
. tests/scripts/checks.sh
port=$1 width=$2 height=$3
folder=$BUILD/screens/$port
out=$folder/default
screen=$out/room.ppm colours=555
case $port in
gba) press="right@0+100 a@0+100" ;;
n64) press="2 2 2 200 200" ;;
gamecube) press="D_LEFT A" screen=$out/room.ycbcr colours= ;;
*) press="left@0+20 l@0+20" ;;
esac
host=$BUILD/screens/host-$width-$height
mkdir -p "$folder" "$host"
check "the host's room" $MAKE room BUILD="$host" PORT=host ROOM_SIZE="$width $height 8"

# host FOLDER [HELD]: draws frames for a screen of 5 bits a colour, or of 8.
host() {
    rm -rf "$1"
    mkdir -p "$1"
    (
        export ROOM_PICTURES="$1" ROOM_HELD="$2"
        [ -z "$colours" ] || export ROOM_COLOURS=$colours
        "$host/default/room" >"$1/said.txt"
    )
}
# as_screen PICTURE: prints the picture's bytes in the console's format. GameCube: see gamecube/row_gamecube.c.
as_screen() {
    case $port in
    gamecube)
        tail -c $((width * height * 3)) "$1" | od -An -v -tu1 -w6 | awk '
            function luma(r, g, b) { return int((66 * r + 129 * g + 25 * b + 4224) / 256) }
            { r = int(($1 + $4) / 2); g = int(($2 + $5) / 2); b = int(($3 + $6) / 2)
              print luma($1, $2, $3), int((112 * b - 38 * r - 74 * g + 32896) / 256),
                  luma($4, $5, $6), int((112 * r - 94 * g - 18 * b + 32896) / 256) }' ;;
    *) cat "$1" ;;
    esac
}
# is_shown PICTURE
is_shown() {
    as_screen "$1" >"$folder/expected"
    case $port in
    gamecube) od -An -v -tu1 -w4 "$screen" | awk '{ print $1, $2, $3, $4 }' ;;
    *) cat "$screen" ;;
    esac | cmp "$folder/expected" -
}
same_hashes() {
    grep '^frame' "$out/room.txt" >"$folder/hashes"
    [ "$(wc -l <"$folder/hashes")" = 3 ] && grep '^frame' "$host/path/said.txt" | diff - "$folder/hashes"
}

rm -f "$out/room.txt" "$screen" # of an earlier run
host "$host/path"
check "it runs" $MAKE run BUILD="$folder" PORT="$port"
check "hashes of frames 0, 30 and 59" same_hashes
check "the screen after the path is frame 59" is_shown "$host/path/frame_59.ppm"

rm -f "$out/room.txt" "$screen"
# The console prints the held buttons frame by frame; with the same buttons, the host must draw the same last picture.
check "it runs with buttons" $MAKE run BUILD="$folder" PORT="$port" PRESS="$press"
held=$(sed -n 's/^held //p' "$out/room.txt" | tr '\n' ' ')
host "$host/steered" "$held"
last=$(ls "$host/steered" | grep frame_ | sort -t _ -k 2n | tail -n 1)
check "buttons were held in some frames: $held" test -n "$held"
check "they change the picture" sh -c "! cmp -s '$host/path/frame_59.ppm' '$host/steered/$last'"
check "the screen then is the host's" is_shown "$host/steered/$last"
finish
