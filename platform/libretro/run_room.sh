# run_room.sh: runs the room on a console in lrhost, then measures the cost by qemu_stages.c: run_room.sh IMAGE
#
# LRHOST, CORE, SCREEN: lrhost's options for the core; B: folder of room and room.ppm; PRESS: buttons in lrhost's form;
# PLUGIN, MODEL: of qemu_stages.c; BEGIN: the symbol at which qemu starts; CROSS: the toolchain's prefix; WITHOUT: lines
# to remove from the console's output.
image=$1
set --
for press in $PRESS; do
    set -- "$@" --press "$press"
done
"$LRHOST" "$CORE" "$image" $SCREEN --system "$B" --until 'end of path' -o "$B/room.ppm" "$@" > "$B/room.txt" || exit 1
grep -v "$WITHOUT" "$B/room.txt"

# A board with RAM at all addresses: the first 256 MiB.
sh tests/scripts/tools.sh need qemu-system-arm || exit 0
at=$("${CROSS}nm" "$B/room" | sed -n "s/ . $BEGIN\$//p")
"${CROSS}objcopy" --set-start="0x$at" "$B/room" "$B/room.elf" &&
    qemu-system-arm -M versatilepb -m 256M -cpu arm926 -display none -monitor none -serial none \
        -plugin "$PLUGIN,model=$MODEL" -kernel "$B/room.elf" 2>"$B/qemu.log" || { cat "$B/qemu.log" >&2; exit 1; }
