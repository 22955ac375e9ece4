# truth.sh NAME...: path-traces truth for our own scenes into $LMB_OWN_TRUTH/NAME, beside the scene's files.
# Existing pictures are kept.
#
# LMB_OWN_TRUTH: a folder outside the repository. PT: the path tracer, built from the shared folder's truth/make; if you
# set FULL=1 in the environment, it also makes pt_full.pfm. SAMPLES=64 (squared) a pixel, SIZE=112 pixels a side.
# SCENES: the program that generates scenes (default build/default/scenes).
set -e
: "${LMB_OWN_TRUTH:?names no folder for truth}" "${PT:?names no path tracer}"

for name in "$@"; do
    folder=$LMB_OWN_TRUTH/$name
    [ ! -f "$folder/pt_indirect1.pfm" ] || continue
    # Complete pictures are moved to their final place. The box is six numbers or nothing.
    mkdir -p "$folder/new"
    "${SCENES:-build/default/scenes}" "$name" --size "${SIZE:-112}" -o "$folder"
    "$PT" "$folder/scene.txt" "$folder/new" "${SAMPLES:-64}" $(cat "$folder/scene.box")
    mv "$folder/new/"*.pfm "$folder"
    rmdir "$folder/new"
    echo "$name: done"
done
