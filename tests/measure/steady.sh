# steady.sh: runs measure-steady with baked light on scenes with known truth, and with live light.
#
# SCENES: scenes (default cornell corridor; of bends cornell point_room corner_contact bunny_room). LMT: the folder with
# NAME.lmt, baked if missing (default $B/measure). FRAME: size (default 160x120; of bends 640x480). ONLY: residual,
# halving or shift of baked light, or bend: live light (LIGHT: its options), compared with the bars. LMB_SHARED: the
# folder with truth/ (default ../shared). The failures of a scene count as one.
. tests/measure/draw.sh

# bars SCENE: largest bends for a light that moves; the 95th, 99th and 99.9th of 100 places.
bars() {
    case $1 in
    cornell) echo 0.006 0.025 0.10 ;;
    point_room) echo 0.012 0.04 0.18 ;;
    kitchen) echo 0.025 0.07 0.28 ;;
    bunny_room | sponza) echo 0.05 9 9 ;;
    *) echo 9 9 9 ;;
    esac
}

if [ "$ONLY" = bend ]; then
    for scene in ${SCENES:-cornell point_room corner_contact bunny_room}; do
        # shellcheck disable=SC2086 # options
        if "$B/measure-steady" bend "$truth/$scene/scene.gltf" --size "${FRAME:-640x480}" --threads 1 \
            ${LIGHT:---gather live --quality draft} >"$work/steady.txt" 2>&1 &&
            awk -v bars="$(bars "$scene")" 'BEGIN { split(bars, bar) }
                $2 == "light" { for (i = 1; i <= 3; ++i) over += $(i + 2) > bar[i] }
                END { exit over > 0 }' "$work/steady.txt"; then
            pass
        else
            fail "$scene: over $(bars "$scene")"
        fi
        sed "s/^/$scene: /" "$work/steady.txt"
    done
    finish
fi

folder=${LMT:-$work}
for scene in ${SCENES:-cornell corridor}; do
    if [ ! -f "$folder/$scene.lmt" ] &&
        ! "$TOOL" bake "$truth/$scene/scene.gltf" --quality best -o "$folder/$scene.lmt" >"$work/said" 2>&1; then
        fail "$scene: $(head -n 1 "$work/said")"
        continue
    fi
    if "$B/measure-steady" $ONLY "$truth/$scene/scene.gltf" --transfer "$folder/$scene.lmt" --size "${FRAME:-160x120}" \
        --threads 1 >"$work/steady.txt" 2>&1; then
        pass
    else
        fail "$scene"
    fi
    sed "s/^/$scene: /" "$work/steady.txt"
done
finish
