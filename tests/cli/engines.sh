# engines.sh: light for other engines, read back and drawn.
. tests/cli/common.sh

# Light for other engines, read back and drawn, is the light it was baked from.
light="--elements 256 --receivers 500 --cluster 0.6"
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
for name in colours map; do
    status 0 render "$name.glb" --size 24x16 --shadow-map 64 -q -o "$name.png"
done
status 2 bake demo $light --to lightmap -o bad.png
said "--to lightmap writes a .glb"
status 2 bake demo $light --bounces 2 -o bad.lmt
status 2 bake demo $light --to probes --moving 0 -o bad.json

finish
