# three_check.sh: baked light for other engines, drawn by three.js in headless Chromium beside our picture of the same
# view; skipped, with the reason, where tools are missing.
#
# Gets playwright-core and three by npm where it may. Pictures, ours on the left: $B/three/shots. B, BUILD and TOOL in the
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
modules=$BUILD/web/three version=0.187.0 # of its own: docs-check may fill the other one at the same time
mkdir -p "$modules"
for name in playwright-core three@$version; do
    [ -d "$modules/node_modules/${name%@*}" ] || npm install --no-audit --no-fund --prefix "$modules" $name >/dev/null 2>&1 ||
        skip "npm gets no $name"
done

# The demo's room as its own camera sees it.
dir=$B/three
rm -rf "$dir"
mkdir -p "$dir"
light="--elements 1024 --receivers 3000"
"$TOOL" bake demo $light -q -o "$dir/demo.lmt" &&
    "$TOOL" render demo --transfer "$dir/demo.lmt" --bounces 4 --show indirect --samples 1 --size 240x160 -q -o "$dir/ours.pfm" &&
    "$TOOL" bake demo $light --to vertex-colours -q -o "$dir/colours.glb" &&
    "$TOOL" bake demo $light --to lightmap --texels 1024 -q -o "$dir/lightmap.glb" || { echo "0 passed, 1 failed, 0 skipped"; exit 1; }
view='{"eye": [0.12, 1.42, 2.7], "target": [0, 1.1, -1], "fov": 50, "width": 240, "height": 160}'
node tests/web/three_test.mjs "$dir" "$modules" "$dir/shots" "$view" colours.glb lightmap.glb
