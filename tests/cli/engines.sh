# engines.sh: exports light for other engines, reads it back and draws it.
. tests/cli/common.sh

# Exported light, read back and drawn, equals the baked light.
light="--elements 256 --receivers 200 --cluster 0.6"
trim() { sed -n 's/.* trim \([0-9.]*\),.*/\1/p' out.txt; }
under() { awk -v is="$(trim)" -v bar="$1" 'BEGIN { exit !(is != "" && is < bar) }'; }
status 0 bake demo $light --to vertex-colours -o colours.glb
check "vertex colours are that light: $(trim)" under 0.02
status 0 bake demo $light --to lightmap --texels 256 -o map.glb
check "a lightmap is that light: $(trim)" under 0.02
status 2 bake demo $light --to probes --step 0.000001 -o never.json
said "give a larger one"
status 0 bake demo $light --to probes --step 0.8 -o air.json
check "probes say how far they are from it: $(trim)" under 0.2
check "they have their numbers beside them" test -s air.bin
if command -v node >/dev/null 2>&1; then
    check "JavaScript reads them" node "$root/tests/web/probes_test.mjs" air.json
else
    skip "probes in JavaScript: no node"
fi
for name in colours map; do
    status 0 render "$name.glb" --size 24x16 --shadow-map 64 -q -o "$name.png"
done

# The GLB keeps parts of the scene's file other than surfaces and light. The file has two tables with one mesh, the
# second below a node that mirrors it. One material has its own occlusion and emission maps, so each slot for the
# lightmap is used.
png="data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGNoaPgPAAODAgAApfuJAAAAAElFTkSuQmCC"
quad="data:;base64,AAAAwAAAAAAAAABAAAAAQAAAAAAAAABAAAAAQAAAAAAAAADAAAAAwAAAAAAAAADAAAAAAAAAAAAAAIA/AAAAAAAAgD8AAIA/AAAAAAAAgD8AAAEAAgAAAAIAAwA="
part='"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2'
cat >named.gltf <<END
{"asset":{"version":"2.0","copyright":"of ours","extras":{"author":"me"}},
"extensionsUsed":["KHR_lights_punctual","KHR_materials_clearcoat"],
"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","intensity":20,"name":"bulb","extras":{"watts":60}}]}},
"scenes":[{"name":"room","nodes":[0,1,3,4]}],
"nodes":[{"name":"table","mesh":0,"extras":{"id":7}},
{"name":"turned","children":[2],"translation":[0,3,0],"scale":[1,-1,1]},{"name":"second table","mesh":0},
{"name":"lamp","translation":[0,1,0],"extensions":{"KHR_lights_punctual":{"light":0}}},{"name":"shelf","mesh":1,"translation":[0,2,-1]}],
"meshes":[{"name":"slab","extras":{"sold":1},"primitives":[{$part,"material":0,"extras":{"side":"up"}}]},
{"name":"board","primitives":[{$part,"material":1},{"attributes":{"POSITION":0},"indices":2,"material":2,"mode":0}]}],
"materials":[{"name":"oak","extras":{"hardness":3},"normalTexture":{"index":0},"emissiveTexture":{"index":0},
"emissiveFactor":[0.01,0,0],"occlusionTexture":{"index":0,"strength":0.5},
"pbrMetallicRoughness":{"metallicRoughnessTexture":{"index":0},"metallicFactor":0.1},"extensions":{"KHR_materials_clearcoat":{"clearcoatFactor":0.5}}},
{"name":"steel","occlusionTexture":{"index":0}},{"name":"unused"}],
"textures":[{"source":0,"name":"grain"}],"images":[{"name":"wood","uri":"$png"}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[-2,0,-2],"max":[2,0,2]},
{"bufferView":0,"byteOffset":48,"componentType":5126,"count":4,"type":"VEC2"},
{"bufferView":0,"byteOffset":80,"componentType":5123,"count":6,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":92}],"buffers":[{"byteLength":92,"uri":"$quad"}]}
END
# kept FILE TEXT...: checks that the JSON in a GLB contains each text unchanged.
kept() {
    glb=$1
    shift
    for text in "$@"; do
        grep -aqF -e "$text" "$glb" && pass || fail "$glb has no $text"
    done
}
for to in lightmap vertex-colours; do
    status 0 bake named.gltf --elements 256 --receivers 500 --texels 64 --to $to -o named-$to.glb
    check "$to of a turned object is that light: $(trim)" under 0.02
    kept named-$to.glb '"name":"table","extras":{"id":7},"mesh":0' '"name":"second table","mesh":1' '"name":"lamp"' \
        '"scale":[1,-1,1]' '"name":"shelf","translation":[0,2,-1],"mesh":2' '"children":[2]' '"name":"bulb"' '"watts":60' \
        '"name":"slab","extras":{"sold":1}' '"name":"board"' '"extras":{"side":"up"}' '"name":"oak","extras":{"hardness":3}' \
        '"normalTexture":{"index":0}' '"emissiveTexture":{"index":0}' '"occlusionTexture":{"index":0,"strength":0.5}' \
        '"metallicRoughnessTexture":{"index":0}' '"clearcoatFactor":0.5' '"copyright":"of ours"' '"author":"me"' \
        '"name":"room"' '"name":"grain"' '"name":"wood"' '"name":"unused"'
done
# Each material refers to the lightmap, in a slot that the material's own maps leave free.
kept named-lightmap.glb '"specularTexture":{"index":1,"texCoord":1}' '"emissiveTexture":{"index":1,"texCoord":1}' \
    '"occlusionTexture":{"index":1,"texCoord":1,"strength":0}' '"name":"lambent lightmap"' '"KHR_materials_specular"'
status 0 bake named.gltf --elements 256 --receivers 500 --light point:0,1,0:0,-1,0:9,9,9 --to vertex-colours -o lit.glb
kept lit.glb '"name":"lamp"' '"KHR_lights_punctual":{"light":0}'
check "lights of the file go where others are given" lacks '"bulb"' lit.glb
printf 'mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 0 -1\nusemtl brick wall\nf 1 2 3\n' >named.obj
printf 'newmtl brick wall\nKd 0.5 0.5 0.5\n' >a.mtl
status 0 bake named.obj --elements 256 --receivers 500 --to lightmap --texels 64 -o obj.glb
kept obj.glb '{"name":"brick wall","mesh":0' '{"name":"brick wall","pbrMetallicRoughness"'

# Other tools may rewrite such a file. If a tool drops the lightmap, the file is still drawn, and a line reports it.
sed 's/"lambent lightmap"/"another picture."/' map.glb >gone.glb
status 0 render map.glb --size 24x16 --shadow-map 64 --show direct -o kept.pfm
check "a lightmap is no occlusion map" lacks occlusion err.txt
status 0 render gone.glb --size 24x16 --shadow-map 64 --show direct -o gone.pfm
said "the lightmap is gone"
check "without its lightmap the picture is the same" cmp kept.pfm gone.pfm
status 2 bake demo $light --to lightmap -o bad.png
said "--to lightmap writes a .glb"
status 2 bake demo $light --bounces 2 -o bad.lmt
status 2 bake demo $light --to probes --moving 0 -o bad.json

finish
