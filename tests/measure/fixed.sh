# fixed.sh: compares the integer renderer with lmb_render's best settings, 320 x 240: frames 0, 30 and 59 of the room's
# path, and other scenes with one camera and one light (SCENES). Needs B and TOOL in the environment. Minutes a scene.
set -e
shared=${LMB_SHARED:-../shared}
program=$B/measure-fixed

# truth SCENE FRAME FOLDER: draws pictures with 1 and 3 reflections, all light and only bounced light.
truth() {
    options=$("$program" options "$1" "$2")
    for bounces in 1 3; do
        for show in full indirect; do
            # shellcheck disable=SC2086
            "$TOOL" render "$1" --size 320x240 $options --quality best --bounces $bounces --show $show -q \
                -o "$3/$2_b${bounces}_$show.pfm"
        done
    done
}

for scene in ${SCENES:-demo "$shared/truth/cornell/scene.gltf"}; do
    folder=$(mktemp -d)
    frames=0 gain=0.1
    [ "$scene" != demo ] || frames='0 30 59' gain=0.25
    for frame in $frames; do
        truth "$scene" "$frame" "$folder"
    done
    echo "$scene"
    "$program" errors "$scene" "$folder" $gain
    rm -rf "$folder"
done
