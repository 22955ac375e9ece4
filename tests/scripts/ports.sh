# ports.sh: builds the room on all ports, runs each in an emulator, and compares the hashes with this machine's room of
# the same size. Prints one table, also in BUILD/ports/table.md. MAKE, BUILD; ROOM=pixel: light by pixel;
# PORTS="cortex-m gba": only these.
#
# A port is a folder of platform/ with a port.mk. `ROOMS := WORD ...` in port.mk names variants, each a word for make.
# The size is read from the port's source, `WIDTH = N, HEIGHT = N`; the default is 160 x 120.
. tests/scripts/checks.sh

# The tools that a port needs, as tools.sh names them.
needs() {
    case $1 in
    cortex-m | cortex-a) echo arm-none-eabi-gcc qemu-system-arm ;;
    aarch64) echo aarch64-linux-gnu-gcc qemu-system-aarch64 ;;
    riscv) echo riscv64-unknown-elf-gcc qemu-system-riscv32 ;;
    gba) echo arm-none-eabi-gcc qemu-system-arm libretro-mgba ;;
    nds) echo arm-none-eabi-gcc qemu-system-arm libretro-desmume ;;
    ps1) echo mipsel-linux-gnu-gcc qemu-mipsel libretro-beetle-psx ;;
    n64) echo mips-linux-gnu-gcc qemu-mips mupen64plus ;;
    gamecube) echo powerpc-linux-gnu-gcc qemu-ppc dolphin-emu-nogui ;;
    esac
}

out=$BUILD/ports HOST_BUILD=$BUILD
export HOST_BUILD
mkdir -p "$out"
all=
for mk in platform/*/port.mk; do
    name=${mk%/port.mk} name=${name##*/}
    case $name in host | null | web) continue ;; esac
    all="$all $name"
done
PORTS=${PORTS:-$all}
for name in $PORTS; do
    needs "$name"
done | tr ' ' '\n' | sort -u >"$out/needs"
# shellcheck disable=SC2046
[ ! -s "$out/needs" ] || sh tests/scripts/tools.sh get $(cat "$out/needs") 2>&1

# size NAME: prints width and height.
size() {
    if [ "$ROOM" = pixel ]; then
        echo 160 120
    else
        found=$(sed -n 's/^enum {.*WIDTH = \([0-9]*\), HEIGHT = \([0-9]*\).*/\1 \2/p' platform/"$1"/port_*.c 2>/dev/null | head -n 1)
        echo "${found:-160 120}"
    fi
}

# host WIDTH HEIGHT: prints the hashes of this machine's room.
host() {
    if [ ! -s "$out/host-$1x$2.txt" ]; then
        $MAKE room PORT=host CONFIG=default ROOM_SIZE="$1 $2 8" BUILD="$out/host-$1x$2" ROOM="$ROOM" >"$out/host.log" 2>&1 &&
            $MAKE run PORT=host CONFIG=default ROOM_SIZE="$1 $2 8" BUILD="$out/host-$1x$2" ROOM="$ROOM" \
                >"$out/host-$1x$2.txt" 2>>"$out/host.log"
    fi
    frames_of "$out/host-$1x$2.txt"
}

# frames_of FILE: prints the hash lines. A port without a screen may write picture bytes between them.
frames_of() { LC_ALL=C grep -a '^frame ' "$1"; }

# stages FILE: prints the numbers of the most expensive frame; with `all`: only the last of them.
stages() {
    awk -v last="$2" '/^cost / { for (i = 3; i < NF; i += 2) if ($i == "all" && $(i + 1) > most) {
            most = $(i + 1); line = ""
            for (k = 4; k <= i + 1; k += 2) line = line " " sprintf("%.2f", $k / 1e6) " |"
            unit = $NF }
        } END { if (last) printf "%.2f", most / 1e6; else print line, unit }' "$1"
}

# counted FILE: loads and stores of the most expensive frame, in millions.
counted() {
    most() { awk -v what="$2" '$1 == what && $NF > most { most = $NF } END { printf "%.2f", most / 1e6 }' "$1"; }
    loads=$(most "$1" loads) stores=$(most "$1" stores)
}

rm -f "$out"/host-*.txt
stage_names=$([ "$ROOM" = pixel ] && echo "map | light | fill" || echo "transform | light | fill")
{
    echo "| port | size | ROM, KiB | RAM, KiB | $stage_names | show | all | unit, millions a frame | loads | stores | hashes of 0, 30, 59 | match |"
    echo "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|"
} >"$out/table.md"

# port NAME [WORD]: adds a row to the table.
port() {
    name=$1 word=$2
    label=$name${word:+ ${word#*=}}
    dir=$out/$name${word:+-${word#*=}}
    said=$dir.txt
    size=$(size "$name")
    # shellcheck disable=SC2046,SC2086
    if [ -n "$(needs "$name")" ] && ! missing=$(sh tests/scripts/tools.sh need $(needs "$name") 2>&1); then
        skip "$label: $missing"
        return
    fi
    # shellcheck disable=SC2086
    if ! $MAKE room PORT="$name" $word BUILD="$dir" ROOM="$ROOM" >"$dir.log" 2>&1; then
        fail "$label does not build: $(tail -n 2 "$dir.log")"
        return
    fi
    # shellcheck disable=SC2086
    $MAKE run PORT="$name" $word BUILD="$dir" ROOM="$ROOM" >"$said" 2>>"$dir.log" || fail "$label: see $dir.log"
    # shellcheck disable=SC2086
    memory=$($MAKE size PORT="$name" $word BUILD="$dir" ROOM="$ROOM" 2>/dev/null | sed -n 's/^rom \([0-9]*\) bytes, ram \([0-9]*\) bytes/\1 \2/p')
    rom=${memory% *} ram=$(sed -n 's/^ram \([0-9]*\) of .*/\1/p' "$said")
    ram=${ram:-${memory#* }}
    loads=- stores=- costs=$said
    frames_of "$said" >"$dir.hashes.run"
    if grep -q 'bare\.mk' "platform/$name/port.mk"; then
        for counted in loads stores; do
            # shellcheck disable=SC2086
            $MAKE run PORT="$name" $word BUILD="$dir" ROOM="$ROOM" COUNTED=$counted >"$dir.$counted" 2>>"$dir.log"
        done
        loads=$(stages "$dir.loads" all) stores=$(stages "$dir.stores" all)
    elif grep -q '^loads ' "$said"; then # the port's qemu plugin prints them beside the cost
        counted "$said"
    elif grep -q '^COUNTED ' "platform/$name/port.mk" && [ "$ROOM" != pixel ]; then
        # The emulator does not model caches, so the same frames run in qemu's user mode, which does.
        $MAKE count PORT="$name" BUILD="$dir" >"$dir.count" 2>&1 || fail "$label: see $dir.count"
        counted "$dir.count"
        sed -n 's/^cycles \(.*\)/cost \1 model/p' "$dir.count" >"$dir.cycles"
        frames_of "$dir.count" | cmp -s - "$dir.hashes.run" || fail "$label: counted frames have other hashes"
        costs=$dir.cycles
    fi
    # Without an FPU, machines draw only frame 0 with light by pixel.
    # shellcheck disable=SC2086
    host $size >"$dir.expected"
    frames_of "$said" >"$dir.hashes"
    frames=$(wc -l <"$dir.hashes")
    match=no
    if [ "$frames" -gt 0 ] && head -n "$frames" "$dir.expected" | cmp -s - "$dir.hashes" &&
        { [ "$frames" -eq 3 ] || [ "$ROOM" = pixel ]; }; then
        match=yes
        pass
    else
        fail "$label: its hashes are not this machine's: $(tr '\n' ' ' <"$dir.hashes"), $(tr '\n' ' ' <"$dir.expected")"
    fi
    stages=$(stages "$costs")
    hashes=$(awk '{ printf "%s ", $3 }' "$dir.hashes")
    kib() { awk -v n="$1" 'BEGIN { if (n + 0 > 0) printf "%.1f", n / 1024; else print "-" }'; }
    [ "${stages# }" != "" ] && [ "${stages# }" != " " ] || stages=" - | - | - | - | - | -"
    echo "| $label | $(echo "$size" | tr ' ' x) | $(kib "$rom") | $(kib "$ram") |$stages | $loads | $stores | $hashes| $match |" >>"$out/table.md"
}

for name in $PORTS; do
    variants=$(sed -n 's/^ROOMS *:= *//p' "platform/$name/port.mk")
    if [ -n "$variants" ]; then
        for word in $variants; do
            port "$name" "$word"
        done
    else
        port "$name"
    fi
done
cat "$out/table.md"
finish
