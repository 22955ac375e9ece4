# notes.sh: notes about models: each verb prints them once, after the model's name, before long work.
. tests/cli/common.sh

# A model with two notes: a texture that cannot be read, and an animation.
moving
sed 's|"nodes":\[|"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],"textures":[{"source":0}],"images":[{"uri":"gone.png"}],&|
    s|"POSITION":4}|&,"material":0|' moving.gltf >noted.gltf
cp noted.gltf again.gltf
photo
white
left="noted.gltf: textures left out"
plays="noted.gltf: animations, which only \`lambent play\` shows: 1"
printf 'out.png noted.gltf 8,12 0 0.4\nout2.png noted.gltf 9,12 0 0.4\n' >list.txt

# once WORDS: the last command printed a line of these words once.
once() { check "$each: once: $1" test "$(grep -c -F -e "$1" err.txt)" = 1; }

for each in "render noted.gltf $few -o x.png" "pack noted.gltf -o x.lmp" "bake noted.gltf --elements 64 -o x.lmt" \
    "relief bake noted.gltf --size 16 -o x.lmr" "relight --world white.pfm --object noted.gltf --size 16x12 -o x.png" \
    "mix $seen --object noted.gltf --scale 0.1 --at 8,12 --shadow-map 64 --voxels 4 -o x.png" "mix $seen --placements list.txt" \
    "relight --world white.pfm --object noted.gltf --at 0,0,0 --object noted.gltf --at 1,0,0 --size 16x12 -o x.png"; do
    status 0 $each
    once "lambent: note: $left"
    once "lambent: note: $plays"
done
each="play noted.gltf $few --frames 1"
status 0 $each
once "$left"
check "play prints no note that animations do not move" lacks animations err.txt
each="relight --world white.pfm --object noted.gltf --at 0,0,0 --object again.gltf --at 1,0,0 --size 16x12 -o x.png"
status 0 $each
once "$left"
once "again.gltf: textures left out"
check "relight needs no camera of an object" lacks "no camera" err.txt
status 0 $each -q
check "relight -q prints no note" empty err.txt
status 0 pack noted.gltf -q -o x.lmp
check "pack -q prints no note" empty err.txt
for each in "lambent-bench noted.gltf --size 8x6 --runs 1 --sweep tree=16 --breakdown 0" \
    "lambent-bench relief noted.gltf --views 2 --triangles 8 --sweep size=16 --runs 1" \
    "lambent-bench relight --world white.pfm --object noted.gltf --size 16x12 --runs 1 --sweep filter=sh9"; do
    status 0 $each
    once "$left"
done

# Notes come before the long work: the command still runs when they are there.
"$TOOL" render demo --eye 0.5,1.25,2.5 --target 0.5,1,-1 --size 320x240 --show depth -q -o large_depth.pfm
"$TOOL" render demo --eye 0.5,1.25,2.5 --target 0.5,1,-1 --size 320x240 --show direct -q -o large.pfm
mix="mix --photo large.pfm --depth large_depth.pfm --intrinsics 289.7,289.7,159.5,119.5 --object noted.gltf --fit --voxels 10
    --cones 37 --samples 16 --threads 1 --light none"
for each in "$mix -o long.png" "relief bake noted.gltf --size 2048 --views 60 --threads 1 -o long.lmr"; do
    rm -f long.png long.lmr
    "$TOOL" $each --time-limit 100 >out.txt 2>err.txt &
    long=$!
    for i in $(seq 300); do
        holds "$left" err.txt && break
        sleep 0.1
    done
    check "${each%% *} prints its notes" holds "$left" err.txt
    check "${each%% *} prints its notes before the long work" kill $long
    wait $long 2>/dev/null
    absent long.png
    absent long.lmr
done

finish
