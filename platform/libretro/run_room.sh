# run_room.sh: the room on a console of lrhost, then what it costs by qemu_stages.c: run_room.sh IMAGE
#
# LRHOST, CORE, SCREEN: lrhost's options for the core; B: where room and room.ppm are; PRESS: buttons as lrhost takes
# them; PLUGIN, MODEL: of qemu_stages.c; BEGIN: the symbol where qemu begins; CROSS: the toolchain's prefix; WITHOUT:
# lines that are left out of what the console says.
image=$1
set --
for press in $PRESS; do
    set -- "$@" --press "$press"
done
"$LRHOST" "$CORE" "$image" $SCREEN --system "$B" --until 'end of path' -o "$B/room.ppm" "$@" > "$B/room.txt" || exit 1
grep -v "$WITHOUT" "$B/room.txt"

# Where all addresses are RAM: the first 256 MiB of this board.
sh tests/scripts/tools.sh need qemu-system-arm || exit 0
at=$("${CROSS}nm" "$B/room" | sed -n "s/ . $BEGIN\$//p")
"${CROSS}objcopy" --set-start="0x$at" "$B/room" "$B/room.elf" &&
    qemu-system-arm -M versatilepb -m 256M -cpu arm926 -display none -monitor none -serial none \
        -plugin "$PLUGIN,model=$MODEL" -kernel "$B/room.elf" 2>"$B/qemu.log" || { cat "$B/qemu.log" >&2; exit 1; }
