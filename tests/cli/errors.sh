# errors.sh: checks that each verb prints the same line for the same fault of a file.
. tests/cli/common.sh

# --- models that show nothing ---

photo
printf 'v nan nan nan\nv nan nan nan\nv nan nan nan\nf 1 2 3\n' >nan.obj
printf 'v 1e9 0 0\nv 1e9 1 0\nv 1e9 0 1\nf 1 2 3\n' >far.obj
printf 'v 1 2 3\nv 1 2 3\nv 1 2 3\nf 1 2 3\n' >point.obj
printf '{"asset":{"version":"2.0"},"nodes":[{"camera":0}],"cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":0.1}}]}' >none.gltf
for fault in nan.obj:"each triangle has a corner that is not finite or 2^20 m away" far.obj:"each triangle has a corner that is not finite or 2^20 m away" \
    point.obj:"all triangles are in one point" none.gltf:"no triangles; \`lambent info\` lists the contents"; do
    model=${fault%%:*}
    for verb in "render $model $few -o x.png" "render $model $few --eye 0,0,9 --target 0,0,0 -o x.png" "plan $model --size 8x8" \
        "play $model $few --frames 2 -o x%02d.png" "pack $model -o x.lmp" "bake $model -o x.lmt" \
        "bake $model --to lightmap -o x.glb" "bake $model --to probes -o x.json" "capture $model --at 0,0,1 --faces 8 -o x.hdr" \
        "explain $model --size 8x8 --pixel 1,1" "relight --world demo --object $model --size 8x8 -o x.png" \
        "relight --world demo --object tent.obj --at 0,0,0 --object $model --at 1,0,0 --size 8x8 -o x.png" \
        "relief bake $model --size 16 -o x.lmr" "relief bake tent.obj --simple $model --size 16 -o x.lmr" \
        "mix $seen --object $model --scale 0.2 --at 8,12 -o x.png" "lambent-bench $model --size 8x8 --runs 1 -q"; do
        status 1 $verb
        said ": $model: nothing to see: ${fault#*:}"
    done
    status 0 info $model
done
echo 'x.png nan.obj 8,12' >list.txt
status 1 mix $seen --placements list.txt
said "nan.obj: nothing to see: each triangle has"
check "nothing is written" none x.*

finish
