# run.sh: runs the room's program in beetle-psx without a window: run.sh BUILD_FOLDER LRHOST CORE IMAGE
#
# The core's BIOS is bios.bin (bios_ps1.S). Prints the program's text, and writes it to room.txt; ROOM_PICTURE gets the
# screen, PRESS are buttons for after the path in lrhost's form; the program runs until Start.
set -u
mkdir -p "$1/system"
for name in scph5500 scph5501 scph5502; do
    cp "$1/bios.bin" "$1/system/$name.bin" || exit 1
done
set -- "$@" ${PRESS:+$(printf -- '--press %s ' $PRESS)}
folder=$1 host=$2 core=$3 image=$4
shift 4
[ -f "$core" ] || { echo "run.sh: no $core (Debian: libretro-beetle-psx)" >&2; exit 2; }
"$host" "$core" "$image" --system "$folder/system" --until 'end of path' --limit "${ROOM_LIMIT:-4000}" \
    --frames "${ROOM_AFTER:-60}" --bits 5 ${ROOM_PICTURE:+-o "$ROOM_PICTURE"} "$@" > "$folder/room.txt"
status=$?
cat "$folder/room.txt"
exit $status
