# steady.sh: runs measure-steady with baked light on scenes with known truth.
#
# SCENES: scenes (default cornell corridor). LMT: the folder with NAME.lmt, baked if missing (default $B/measure).
# FRAME: size (default 160x120). ONLY: residual, halving or shift. LMB_SHARED: the folder with truth/ (default
# ../shared). The failures of a scene count as one.
. tests/measure/draw.sh

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
