# lights.sh: runs measure-lights on scenes with known truth: baked light with lights unknown at
# bake time, one row a scene.
#
# SCENES: scenes, and `demo` (default: all with bars below). LMT: the folder with NAME.lmt, baked if missing (default
# $B/measure). FRAME: size (default 160x120). OPTIONS: instead of baked light, say "--gather live". LMB_SHARED: the
# folder with truth/ (default ../shared). Each light's own line goes to $B/measure/lights.NAME. A row passes if the mean
# trim over all lights meets the bar, and the worst trim twice the bar.
. tests/measure/draw.sh

folder=${LMT:-$work}

bar_of() {
    case $1 in
    bunny_room) echo 0.055 ;;
    sponza) echo 0.13 ;;
    *) echo 0.04 ;;
    esac
}

row() {
    scene=$1 options=$OPTIONS
    [ "$1" = demo ] || scene=$truth/$1/scene.gltf
    if [ -z "$OPTIONS" ]; then
        options="--transfer $folder/$1.lmt"
        [ -f "$folder/$1.lmt" ] || "$TOOL" bake "$scene" --quality best -q -o "$folder/$1.lmt" || return
    fi
    # shellcheck disable=SC2086 # words
    "$B/measure-lights" "$scene" $options --size "${FRAME:-160x120}" --threads 1 >"$work/lights.$1" || return
    awk -v name="$1" -v bar="$(bar_of "$1")" '$1 == "lights:" {
        print "| " name " | " $3 " | " $5 " | " $7 " | " $9 " | " bar " |"
        exit !($3 <= bar && $7 <= 2 * bar) }' "$work/lights.$1"
}

echo "| scene | trim, mean of lights | rmse | worst trim | dim lights | bar |"
echo "|---|---|---|---|---|---|"
for name in ${SCENES:-cornell corridor demo point_room corner_contact bunny_room sponza}; do
    row "$name" && pass || fail "$name"
done
finish
