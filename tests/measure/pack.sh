# pack.sh: measures packed scenes: bytes by part beside the gzipped source, and the time until each can be drawn. Needs
# TOOL and B in the environment; SCENES names other scenes. A .gltf counts with the .bin beside it.
shared=${LMB_SHARED:-../shared}
scenes=${SCENES:-demo $shared/data/scenes/living_room.glb $shared/truth/sponza/scene.gltf}
mkdir -p "$B/pack"
failed=0
for scene in $scenes; do
    packed=$B/pack/scene.lmp
    if [ "$scene" != demo ] && [ ! -f "$scene" ]; then
        echo "skipped: no $scene"
        continue
    fi
    "$TOOL" pack "$scene" -o "$packed" --report 2>"$B/pack/said.txt" >"$B/pack/report.txt" || exit 1
    echo "$scene"
    sed 1d "$B/pack/report.txt"
    echo "  gzip -9: $(gzip -9 -c "$packed" | wc -c) bytes"
    if [ "$scene" != demo ]; then
        set -- "$scene"
        [ ! -f "${scene%.gltf}.bin" ] || set -- "$scene" "${scene%.gltf}.bin"
        echo "  the source: $(cat "$@" | wc -c) bytes, gzip -9: $(cat "$@" | gzip -9 -c | wc -c)"
    fi
    "$B/measure-pack" "$scene" "$packed" || failed=1
done
exit $failed
