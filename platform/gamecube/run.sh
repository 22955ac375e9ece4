# run.sh: the room's program in dolphin-emu without a window: run.sh BUILD_FOLDER IMAGE
#
# Prints what the program says on its serial line. ROOM_PADS are controller commands of dolphin's pipes, such as
# "PRESS D_LEFT", one a line, each held for ROOM_HELD seconds.
set -u
here=$(cd "$1" && pwd)
image=$(cd "$(dirname "$2")" && pwd)/$(basename "$2")
emulator=$(PATH=$PATH:/usr/games command -v dolphin-emu-nogui) || {
    echo "run.sh: no dolphin-emu-nogui (Debian: dolphin-emu)" >&2
    exit 2
}
user=$here/user
rm -rf "$user"
mkdir -p "$user/Config" "$user/Logs"
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
log=$user/Logs/dolphin.log
"$emulator" -p headless -v Null -u "$user" -e "$image" >"$here/emulator.log" 2>&1 &
process=$!
left=${ROOM_SECONDS:-300}
until grep -qa 'left: ' "$log" 2>/dev/null || [ "$left" = 0 ]; do
    sleep 1
    left=$((left - 1))
done
kill "$process" 2>/dev/null
wait "$process" 2>/dev/null
sed -n 's/.*OSREPORT.*: \(\(held\|frame\|cost\|ram\|end\|room\|left\)[: ].*\)/\1/p' "$log" | tr -d '\r'
grep -qa 'left: done' "$log"
