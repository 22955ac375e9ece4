# screens.sh: compares consoles' screens, read back from emulators after the path and after buttons, with this machine's
# pictures: see platform/consoles/check_room.sh. MAKE, BUILD; PORTS="gba nds": only these.
. tests/scripts/checks.sh
mkdir -p "$BUILD"
for port in ${PORTS:-gba nds n64 ps1 gamecube}; do
    case $port in
    gba) size="240 160" needs="arm-none-eabi-gcc qemu-system-arm libretro-mgba" ;;
    nds) size="256 192" needs="arm-none-eabi-gcc qemu-system-arm libretro-desmume" ;;
    n64) size="320 240" needs="mips-linux-gnu-gcc mupen64plus" ;;
    ps1) size="320 240" needs="mipsel-linux-gnu-gcc libretro-beetle-psx" ;;
    gamecube) size="640 480" needs="powerpc-linux-gnu-gcc dolphin-emu-nogui" ;;
    *)
        fail "$port: no console"
        continue
        ;;
    esac
    # shellcheck disable=SC2086
    sh tests/scripts/tools.sh get $needs
    # shellcheck disable=SC2086
    if ! missing=$(sh tests/scripts/tools.sh need $needs 2>&1); then
        skip "$port: $missing"
        continue
    fi
    # shellcheck disable=SC2086
    if sh platform/consoles/check_room.sh "$port" $size >"$BUILD/screen-$port.log" 2>&1; then
        echo "$port: $(tail -n 1 "$BUILD/screen-$port.log")"
        pass
    else
        fail "$port: $(cat "$BUILD/screen-$port.log")"
    fi
done
finish
