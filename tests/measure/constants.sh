# constants.sh: measures with constants of tools/mix halved and doubled, on generated rooms that chose none of them.
#
#     constants.sh FIRST COUNT FIRST COUNT [NAME]...    two columns: numbers of rooms; default: all constants
#
# ROOMS_OBJ and SUN_OBJ: the objects of measure-rooms and measure-sun. The script recompiles the source of a constant
# with a new value and links it in place of the original. It prints one line a value: the summaries of both columns.
set -eu
work=$B/constants/$$
mkdir -p "$work" "$B/rooms" "$B/suns"
columns="$1 $2 $3 $4"
shift 4

# linked OUT SOURCE VALUE OBJECTS...: links a measure with VALUE for the constant $name.
linked() {
    out=$1 file=$2 changed=$3
    shift 3
    base=$(basename "$file" .c)
    sed "s|^#define $name  *[0-9.]*f|#define $name ${changed}f|" "tools/mix/$file" >"$work/$base.c"
    grep -q "^#define $name ${changed}f" "$work/$base.c" || { echo "constants.sh: $file has no $name" >&2; exit 1; }
    $CC $FLAGS -iquote tools/mix -c -o "$work/$base.o" "$work/$base.c"
    others= replaced=0
    for object in "$@"; do
        case $object in
        */mix/$base.o) others="$others $work/$base.o" replaced=1 ;;
        *) others="$others $object" ;;
        esac
    done
    [ $replaced -eq 1 ] || { echo "constants.sh: no object of $file is linked" >&2; exit 1; }
    $CC $FLAGS -o "$out" $others -lm -lpthread
}

# told NAME VALUE MEASURE: prints only the summaries, or everything if the measure fails.
told() {
    case $3 in
    rooms) set -- "$1" "$2" "$B/rooms" metal ;;
    sun) set -- "$1" "$2" "$B/suns" ;;
    esac
    label="$1 $2"
    shift 2
    "$work/measure" "$@" $columns >"$work/said.txt" || { cat "$work/said.txt" >&2; exit 1; }
    sed -nE "s|^[0-9]+\.\.[0-9]+|$label: &|p" "$work/said.txt"
}

while read -r name source value measure; do
    case " ${*:-$name} " in *" $name "*) ;; *) continue ;; esac
    for by in 0.5 1 2; do
        now=$(awk "BEGIN { printf \"%.4f\", $by * $value }")
        case $measure in
        rooms) linked "$work/measure" "$source" "$now" $ROOMS_OBJ ;;
        sun) linked "$work/measure" "$source" "$now" $SUN_OBJ ;;
        esac
        told "$name" "$now" "$measure"
    done
done <<END
MORE_MAX mix_sun.c 4 sun
NEAR mix_sun.c 0.5 sun
WEAK mix_sun.c 0.35 sun
BY_NORMALS mix_sources.c 6 rooms
BY_LIGHTS mix_sources.c 0.5 rooms
CLEAR mix_sources.c 0.01 rooms
THROWN mix_lobes.c 0.75 rooms
END
