# docs_check.sh: checks that the C code of the documents compiles, that the commands in them run, and that the reference
# of `make docs` has no dead link, nothing wider than a phone, and a search.
#
# Commands are the lines that begin with `lambent`, `lambent-bench` or the same with `build/` in README.md and tools/README.md. The script makes
# the input files: a room as glTF and OBJ, and outputs of earlier commands. B, TOOL, CC, FLAGS in the environment.
. tests/scripts/checks.sh

case $B in /*) dir=$B/docs-check ;; *) dir=$PWD/$B/docs-check ;; esac
case $TOOL in /*) lambent=$TOOL ;; *) lambent=$PWD/$TOOL ;; esac
rm -rf "$dir"
mkdir -p "$dir/run/build"
documents="README.md include/README.md tools/README.md platform/README.md tests/README.md src/README.md src/EXACT.md src/RECIPES.md tests/results/README.md"

# Compiles each ```c block of each document.
awk -v dir="$dir" '
    FNR == 1 { inside = 0 }
    /^```c$/ { inside = 1; file = dir "/" ++n ".c"; print "#line " FNR + 1 " \"" FILENAME "\"" > file; next }
    /^```$/ { inside = 0 }
    inside { print > file }' $documents
for source in "$dir"/*.c; do
    check "$(sed -n '1s/.*"\(.*\)"/\1/p' "$source"): its code compiles" $CC $FLAGS -Werror -fsyntax-only "$source"
done

# A room of two walls with a camera, a spot light and a moving object, as .gltf, .glb and .obj; a sky of one colour.
cd "$dir/run" || exit 1
number() { printf "\\$(printf %o $(($1 & 255)))\\$(printf %o $(($1 >> 8 & 255)))\\$(printf %o $(($1 >> 16 & 255)))\\000"; }
"$lambent" pack demo -o demo.lmp >/dev/null 2>&1
cat >scene.obj <<'OBJ'
v -2 0 -2
v 2 0 -2
v 2 0 2
v -2 0 2
v -2 3 -2
v 2 3 -2
f 1 4 3 2
f 1 2 6 5
OBJ
corners=$(printf '0 0 0 300 0 0 300 0 300 0 0 300 0 300 0 300 300 0\n')
floats() { # metres, 0 or 3, as binary32
    for n in $corners; do [ "$n" = 0 ] && printf '\000\000\000\000' || printf '\000\000\100\100'; done
}
indices='\000\000\003\000\002\000\000\000\002\000\001\000\000\000\001\000\005\000\000\000\005\000\004\000'
data=$({ floats; printf "$indices"; } | base64 | tr -d '\n')
cat >scene.gltf <<GLTF
{"asset":{"version":"2.0"},"extensionsUsed":["KHR_lights_punctual"],"scene":0,"scenes":[{"nodes":[0,1,2]}],
"nodes":[{"name":"room","mesh":0},{"name":"eye","camera":0,"translation":[1.5,1.5,6]},
{"name":"lamp","translation":[1.5,2.5,1.5],"rotation":[-0.7071068,0,0,0.7071068],"extensions":{"KHR_lights_punctual":{"light":0}}}],
"cameras":[{"type":"perspective","perspective":{"yfov":0.8,"aspectRatio":1.3333333,"znear":0.1}}],
"extensions":{"KHR_lights_punctual":{"lights":[{"type":"spot","intensity":30,"spot":{"outerConeAngle":0.7}}]}},
"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0.7,0.6,0.5,1],"metallicFactor":0,"roughnessFactor":0.5}}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":6,"type":"VEC3","min":[0,0,0],"max":[3,3,3]},
{"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":72},{"buffer":0,"byteOffset":72,"byteLength":24}],
"buffers":[{"byteLength":96,"uri":"data:application/octet-stream;base64,$data"}]}
GLTF
bytes=$(wc -c <scene.gltf)
padding=$(((4 - bytes % 4) % 4))
{ printf 'glTF\002\000\000\000'; number $((20 + bytes + padding)); number $((bytes + padding)); printf 'JSON'; cat scene.gltf; printf '%*s' $padding ''; } >scene.glb
cp scene.glb city.glb
"$lambent" render demo --size 64x32 --world none -o sky.hdr >/dev/null 2>&1
cp sky.hdr sky_000.hdr
"$lambent" relief bake scene.glb --size 64 --triangles 300 -o statue.lmr >/dev/null 2>&1
echo statue.lmr 0 0 0 >list.txt
cd - >/dev/null || exit 1

# A command ends at two blanks or at the end of the line. Only one of two bakes with default settings runs, because each
# takes 21 s. `make paths` runs the marked blocks.
awk '/^<!-- run: / { apart = 1 } /^```/ { inside = !inside; if (!inside) apart = 0 } inside && !apart' README.md tools/README.md |
    sed -nE 's#^(build/)?lambent(-bench)? #\2 #; t found; d; :found; s/ {2,}.*//; s/(relief bake .*-o [^ ]*) .*/\1/; s/--frames 300/--frames 2/; s/^ bake scene.lmp/& --elements 1024/; p' \
        >"$dir/commands.txt"
check "documents show commands" test "$(grep -c . "$dir/commands.txt")" -gt 15
while IFS= read -r arguments; do
    case $arguments in
    *"--frame room"* | *"--photo room"* | *"--frames DIR"* | *"--placements list.txt"* | "-bench hard"*)
        skip "lambent$arguments: other checks run it"
        continue
        ;;
    esac
    check "lambent$arguments" sh -c 'cd "$1" && eval "\"\$2\"$3"' sh "$dir/run" "$lambent" "$arguments"
done <"$dir/commands.txt"

# The reference.
if missing=$(sh tests/scripts/tools.sh need doxygen 2>&1); then
    check "make docs" ${MAKE:-make} docs
    grep 'lmb_[a-z0-9_]*()' "$BUILD"/docs/html/calls.html | grep -v href= >"$dir/lost.txt"
    check "calls that have no place in the reference: $(grep -o 'lmb_[a-z0-9_]*()' "$dir/lost.txt" | head -5 | tr '\n' ' ')" \
        test ! -s "$dir/lost.txt"
    check "few calls have links" test "$(grep -c '_8h.html#[^"]*">lmb_' "$BUILD"/docs/html/calls.html)" -ge 200
    modules=$BUILD/web/modules
    if ! command -v node >/dev/null || ! command -v npm >/dev/null || [ ! -x "${CHROMIUM:-/usr/bin/chromium}" ]; then
        skip "the reference in a browser: needs node, npm and chromium"
    elif [ ! -d "$modules/node_modules/playwright-core" ] &&
        ! npm install --no-audit --no-fund --prefix "$modules" playwright-core >/dev/null 2>&1; then
        skip "the reference in a browser: npm gets no playwright-core"
    else
        node tests/web/docs_test.mjs "$BUILD/docs/html" "$modules" "$B/docs-check/shots" >"$dir/browser.txt" 2>&1
        grep -v passed "$dir/browser.txt" | head -20
        counts=$(tail -n 1 "$dir/browser.txt")
        passed=$((passed + $(echo "$counts" | sed -n 's/^\([0-9]*\) passed.*/\1/p;s/^[^0-9].*/0/p')))
        case $counts in *" passed, 0 failed"*) pass ;; *) fail "the reference in a browser: $counts" ;; esac
    fi
else
    skip "the reference: $missing"
fi
finish
