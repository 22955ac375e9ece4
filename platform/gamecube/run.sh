# run.sh: runs the room's program in dolphin-emu without a window: run.sh BUILD_FOLDER IMAGE
#
# Prints the program's serial output, and writes it to room.txt. PRESS: buttons of dolphin's pipes for after the path,
# such as "D_LEFT A": each is held in turn, then Start ends the program. room.ycbcr gets the screen as stored in the
# console's RAM: rows of Y, Cb, Y, Cr.
set -u
here=$(cd "$1" && pwd)
image=$(cd "$(dirname "$2")" && pwd)/$(basename "$2")
emulator=$(PATH=$PATH:/usr/games command -v dolphin-emu-nogui) || {
    echo "run.sh: no dolphin-emu-nogui (Debian: dolphin-emu)" >&2
    exit 2
}
user=$here/user
rm -rf "$user" "$here/room.ycbcr" "$here/room.txt"
mkdir -p "$user/Config" "$user/Logs" "$user/Pipes"
cat >"$user/Config/Dolphin.ini" <<'INI'
[Core]
CPUThread = False
SkipIPL = True
CPUCore = 1
EmulationSpeed = 0.0
SIDevice0 = 6
[DSP]
Backend = No Audio Output
DSPThread = False
[Input]
BackgroundInput = True
[Analytics]
PermissionAsked = True
Enabled = False
INI
cat >"$user/Config/Logger.ini" <<'INI'
[Options]
Verbosity = 4
WriteToConsole = False
WriteToFile = True
[Logs]
OSREPORT = True
BOOT = True
EXI = True
INI
cat >"$user/Config/GCPadNew.ini" <<'INI'
[GCPad1]
Device = Pipe/0/pad
Buttons/A = Button A
Buttons/B = Button B
Buttons/X = Button X
Buttons/Y = Button Y
Buttons/Start = Button START
D-Pad/Up = Button D_UP
D-Pad/Down = Button D_DOWN
D-Pad/Left = Button D_LEFT
D-Pad/Right = Button D_RIGHT
INI
mkfifo "$user/Pipes/pad" || exit 1
log=$user/Logs/dolphin.log
"$emulator" -p headless -v Null -u "$user" -e "$image" >"$here/emulator.log" 2>&1 &
process=$!
exec 3<>"$user/Pipes/pad"
left=${ROOM_SECONDS:-600}
# wait_for TEXT: waits until the program prints TEXT.
wait_for() {
    until grep -qa "$1" "$log" 2>/dev/null || [ "$left" = 0 ]; do
        sleep 1
        left=$((left - 1))
    done
}
# count: number of lines about held buttons
count() { grep -ca 'OSREPORT.*: held ' "$log"; }

wait_for 'end of path'
for button in ${PRESS:-}; do
    before=$(count)
    echo "PRESS $button" >&3
    until [ "$(count)" -gt "$before" ] || [ "$left" = 0 ]; do
        sleep 1
        left=$((left - 1))
    done
    echo "RELEASE $button" >&3
done
echo 'PRESS START' >&3
wait_for 'left: '

# The emulator's shared memory is the console's RAM, from the first byte on. The screen shown last is the
# one that is not `hidden`.
symbol() { "${NM:-nm}" "$here/room" | sed -n "s/^[89]\([0-9a-f]*\) . $1\$/0x\1/p"; }
word() { tail -c +$(($1 + 1)) "$ram" | head -c 4 | od -An -v -tu1 | awk '{ print (($1 * 256 + $2) * 256 + $3) * 256 + $4 }'; }
for ram in /proc/"$process"/fd/*; do
    case $(readlink "$ram") in
    /dev/shm/dolphin-emu*)
        bytes=$((640 * 480 * 2))
        at=$(($(symbol screens) + (1 - $(word "$(symbol hidden)")) * bytes))
        tail -c +$((at + 1)) "$ram" | head -c $bytes >"$here/room.ycbcr"
        ;;
    esac
done
kill "$process" 2>/dev/null
wait "$process" 2>/dev/null
sed -n 's/.*OSREPORT.*: \(\(held\|frame\|cost\|ram\|end\|room\|left\)[: ].*\)/\1/p' "$log" | tr -d '\r' >"$here/room.txt"
cat "$here/room.txt"
grep -qa 'left: done' "$log"
