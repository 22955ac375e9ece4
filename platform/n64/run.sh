# run.sh: runs the room's cartridge in mupen64plus without window and sound: run.sh BUILD_FOLDER IMAGE
#
# Prints the program's text, and writes it to room.txt; ROOM_PICTURE gets the screen, ROOM_PADS are buttons of
# the controller (pad_n64.c).
set -u
here=$(cd "$1" && pwd)
image=$(cd "$(dirname "$2")" && pwd)/$(basename "$2")
emulator=$(PATH=$PATH:/usr/games command -v mupen64plus) || {
    echo "run.sh: no mupen64plus (Debian: mupen64plus-ui-console)" >&2
    exit 2
}
rm -rf "$here/home"
mkdir -p "$here/home"
log=$here/emulator.log
case ${ROOM_PICTURE:-} in
'' | /*) ;;
*) ROOM_PICTURE=$PWD/$ROOM_PICTURE ;;
esac
export ROOM_PICTURE
HOME=$here/home SDL_VIDEODRIVER=dummy SDL_AUDIODRIVER=dummy timeout "${ROOM_SECONDS:-300}" "$emulator" \
    --gfx "$here/screen_n64.so" --input "$here/pad_n64.so" --audio dummy --rsp dummy --nosaveoptions --nospeedlimit \
    --emumode "${ROOM_MODE:-2}" "$image" >"$log" 2>&1
status=$?
grep -a '^\(held\|frame\|cost\|ram\|end\|room\|fault\) ' "$log" >"$here/room.txt" || status=1
cat "$here/room.txt"
[ "$status" = 0 ] || { echo "run.sh: failed, see $log" >&2; exit 1; }
