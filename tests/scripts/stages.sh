# stages.sh: finds the first stage in which two builds of the tool, two machines or two settings differ: compares the
# float picture of each stage.
#
#   TOOL=build/lambent sh tests/scripts/stages.sh dump DIR SCENE OPTION...     options of `lambent render`, without -o
#   TOOL=build/lambent sh tests/scripts/stages.sh compare DIR_A DIR_B
#
# dump writes one PFM per stage, in the order of the data, and stages.txt with a checksum per stage: `-` if the scene or
# the options lack the stage. If you have only stages.txt of the other run, compare needs no pictures. Exit status: 0
# all equal, 1 one differs, 2 bad usage.
TOOL=${TOOL:-build/lambent}
stages="light-distance depth normal albedo direct irradiance full"

usage() {
    sed -n 's/^#   /usage: /p' "$0" >&2
    exit 2
}

# The name of the stage that --show selects.
called() {
    case $1 in
    light-distance) echo "shadow maps" ;;
    depth) echo "view: depth" ;;
    normal | albedo) echo "attributes: $1" ;;
    direct) echo "direct light" ;;
    irradiance) echo "bounced light" ;;
    full) echo "picture" ;;
    esac
}

dump() {
    [ $# -ge 2 ] || usage
    dir=$1
    shift
    mkdir -p "$dir" || exit 1
    rm -f "$dir"/*.pfm "$dir/stages.txt"
    for stage in $stages; do
        sum=-
        if "$TOOL" render "$@" -q --samples 1 --show $stage -o "$dir/$stage.pfm" 2>"$dir/said"; then
            sum=$(cksum <"$dir/$stage.pfm" | tr ' ' ':')
        elif [ $stage = full ]; then
            cat "$dir/said" >&2
            exit 1
        fi
        echo "$stage $sum" >>"$dir/stages.txt"
    done
    rm -f "$dir/said"
}

compare() {
    [ $# -eq 2 ] && [ -s "$1/stages.txt" ] && [ -s "$2/stages.txt" ] || usage
    for stage in $stages; do
        a=$(sed -n "s/^$stage //p" "$1/stages.txt")
        b=$(sed -n "s/^$stage //p" "$2/stages.txt")
        [ "$a" != "$b" ] || continue
        echo "the first stage that differs: $(called $stage) (--show $stage), $a and $b"
        if [ -s "$1/$stage.pfm" ] && [ -s "$2/$stage.pfm" ]; then
            "$TOOL" compare "$1/$stage.pfm" "$2/$stage.pfm"
        fi
        exit 1
    done
    echo "all stages are equal"
}

case $1 in
dump | compare) "$@" ;;
*) usage ;;
esac
