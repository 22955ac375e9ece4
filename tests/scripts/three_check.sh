# three_check.sh: compares baked light for other engines, drawn by three.js in headless Chromium, with our picture of
# the same view, also after glTF-Transform, gltf-pipeline and gltfpack have rewritten the file. Babylon.js reads the
# files too. Skipped, with the reason, if tools are missing.
#
# Gets the packages below with npm if possible. Pictures, ours on the left: $B/three/shots. B, BUILD and TOOL in the
# environment.
skip() {
    echo "three-check: $1"
    echo "0 passed, 0 failed, 1 skipped"
    exit 0
}
for command in node npm; do
    command -v $command >/dev/null 2>&1 || skip "no $command"
done
[ -x "${CHROMIUM:-/usr/bin/chromium}" ] || skip "no Chromium: apt-get install chromium"
modules=$BUILD/web/three # a separate folder, because docs-check may fill the other one at the same time
mkdir -p "$modules"
for name in playwright-core three@0.187.0 @gltf-transform/cli@4.5.1 gltf-pipeline@4.3.1 gltfpack@1.3.0 @babylonjs/core@9.28.0 \
    @babylonjs/loaders@9.28.0; do
    [ -d "$modules/node_modules/${name%@[0-9]*}" ] || npm install --no-audit --no-fund --prefix "$modules" $name >/dev/null 2>&1 ||
        skip "npm gets no $name"
done

# The demo's room, from the camera of the demo.
dir=$B/three
rm -rf "$dir"
mkdir -p "$dir"
light="--elements 1024 --receivers 3000"
"$TOOL" bake demo $light -q -o "$dir/demo.lmt" &&
    "$TOOL" render demo --transfer "$dir/demo.lmt" --bounces 4 --show indirect --samples 1 --size 240x160 -q -o "$dir/ours.pfm" &&
    "$TOOL" bake demo $light --to vertex-colours -q -o "$dir/colours.glb" &&
    "$TOOL" bake demo $light --to lightmap --texels 1024 -q -o "$dir/lightmap.glb" || { echo "0 passed, 1 failed, 0 skipped"; exit 1; }
# Runs each tool with default options; gltfpack quantizes. lambent must read the same light, or report that it is gone.
failed=0 files=
bin=$PWD/$modules/node_modules/.bin
case $modules in /*) bin=$modules/node_modules/.bin ;; esac
through() {
    out=$1
    shift
    "$@" >"$dir/$out.log" 2>&1 && "$TOOL" render "$dir/$out" --size 24x16 --shadow-map 64 -o "$dir/$out.png" >>"$dir/$out.log" 2>&1 &&
        ! grep -q "lightmap is gone" "$dir/$out.log" && files="$files $out" && return
    echo "FAIL three-check: the lightmap through $1: $(tail -n 1 "$dir/$out.log")"
    failed=1
}
through by-transform.glb "$bin/gltf-transform" copy "$dir/lightmap.glb" "$dir/by-transform.glb"
through by-optimize.glb "$bin/gltf-transform" optimize --compress false --texture-compress false "$dir/lightmap.glb" "$dir/by-optimize.glb"
through by-pipeline.glb "$bin/gltf-pipeline" -i "$dir/lightmap.glb" -o "$dir/by-pipeline.glb"
through by-pack.glb "$bin/gltfpack" -i "$dir/lightmap.glb" -o "$dir/by-pack.glb"
NODE_PATH=$modules/node_modules node tests/web/babylon_test.mjs "$modules" "$dir/lightmap.glb" "$dir/by-pipeline.glb" || failed=1
view='{"eye": [0.12, 1.42, 2.7], "target": [0, 1.1, -1], "fov": 50, "width": 240, "height": 160}'
node tests/web/three_test.mjs "$dir" "$modules" "$dir/shots" "$view" colours.glb lightmap.glb $files && [ $failed -eq 0 ]
