# run.sh: the room's program in beetle-psx without a window: run.sh BUILD_FOLDER LRHOST CORE IMAGE
#
# The core's BIOS is bios.bin (bios_ps1.S). Prints what the program says, which is in room.txt too; ROOM_PICTURE gets the
# screen, PRESS are buttons for after the path as lrhost takes them; the program runs until Start.
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
