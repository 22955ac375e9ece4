# no_float.sh: checks that a frame in integers has no float: vertex/fixed*.c, number.c and the room, compiled for a Cortex-M0+,
# call no float and no division function of the compiler's run time in a frame. Prints their ROM. Skipped without the compiler.
. tests/scripts/checks.sh

if ! missing=$(sh tests/scripts/tools.sh need arm-none-eabi-gcc 2>&1); then
    skip "no float in vertex/fixed*.c: $missing"
    finish
fi
folder=$B/no_float
mkdir -p "$folder"
for source in src/vertex/fixed*.c src/vertex/number.c platform/demo/room.c; do
    object=$folder/$(basename "$source" .c).o
    check "$source compiles" arm-none-eabi-gcc -mcpu=cortex-m0plus -mthumb -mfloat-abi=soft -std=c99 -Os -ffp-contract=off \
        -Iinclude -isystem platform/freestanding -c "$source" -o "$object"
    helpers=$(arm-none-eabi-nm -u "$object" | grep -oE '__aeabi_([fd][a-z0-9]*|[iul]+2[fd]|[iul]*div[a-z]*)' | grep -v idiv0 | sort -u)
    case $source in
    # only when a blob is opened or a pose is made
    */fixed_open.c | */room.c) helpers=$(printf '%s' "$helpers" | grep -v div) ;;
    esac
    check "$source asks for $helpers" test -z "$helpers"
done
arm-none-eabi-size -t "$folder"/fixed*.o "$folder"/number.o | awk 'END { print "rom of vertex/fixed*.c and number.c: " $1 + $2 " bytes" }'
finish
