# animations.sh: play with a file's animations; a frame drawn singly equals the same frame of a sequence.
. tests/cli/common.sh

# Animations of a glTF file that move light, camera and a triangle; each frame drawn singly gives the same bytes.
moving
for move in light camera object all; do
    status 0 play moving.gltf --size 32x24 --quality draft --move $move --fps 2 --frames 3 -o play_%02d.pfm
    status 0 play moving.gltf --size 32x24 --quality draft --move $move --fps 2 --from 2 --frames 1 -o alone_%02d.pfm
    check "an animation moves --move $move, the same alone" sh -c '! cmp -s "$1_00.pfm" "$1_02.pfm" && cmp -s "$1_02.pfm" "$2_02.pfm"' \
        sh play alone
done
status 0 render moving.gltf --size 32x24 --quality draft --light point:0.5,2,0.4:0,0,-1:4,4,4 -o rendered.pfm
status 0 play moving.gltf --size 32x24 --quality draft --move light --fps 1 --from 1 --frames 1 -o alone_%02d.pfm
check "an animated light lights as one that was put there" cmp -s rendered.pfm alone_01.pfm
status 0 bake moving.gltf -o moving.lmt --elements 64 --receivers 64
status 0 play moving.gltf --size 32x24 --transfer moving.lmt --frames 2
check "that baked objects stand still is said" holds "objects stand still: what was baked" err.txt
status 1 play moving.gltf --size 32x24 --transfer moving.lmt --move object --frames 2
status 0 bake moving.gltf -o moves.lmt --elements 64 --receivers 64 --moving 1
status 0 play moving.gltf --size 32x24 --transfer moves.lmt --fps 2 --frames 3 -o play_%02d.pfm
check "no object stands still" lacks 'stand still' err.txt
status 0 play moving.gltf --size 32x24 --transfer moves.lmt --fps 2 --from 2 --frames 1 -o alone_%02d.pfm
check "a baked object moves, and is the same alone" sh -c '! cmp -s "$1_00.pfm" "$1_02.pfm" && cmp -s "$1_02.pfm" "$2_02.pfm"' \
    sh play alone
# Only the first 64 cameras are used; a line reports it if there are more.
for more in 63 64; do
    sed "s/\"camera\":0}]/\"camera\":0}$(awk -v n=$more 'BEGIN { while (n-- > 0) printf ",{\"camera\":0}" }')]/" moving.gltf >eyes.gltf
    status 0 bake eyes.gltf -o eyes.lmt --elements 64 --receivers 64
    check "cameras that do not count: $more and one" test "$(grep -c "eyes.gltf has 65 cameras, of which the first 64 count" err.txt)" -eq $((more - 63))
done
status 0 bake eyes.gltf -o eyes.lmt --elements 64 --receivers 64 -q
check "--quiet says nothing of them" test ! -s err.txt
status 0 render odd.gltf --size 32x24 --shadow-map 64 -o odd.png
status 1 play odd.gltf --size 32x24 --frames 2
said "2 values for 2 keys; or give --path"

# Skins and morph weights move: shaped.gltf bends a triangle by two skins, moves one by weights, and one by both.
shaped="$root/tests/fuzz/corpus/gltf/shaped.gltf"
few="--size 32x24 --quality draft --elements 256 --eye 2,2,-9 --target 2,1,0"
for move in object all; do
    status 0 play $shaped $few --move $move --fps 4 --frames 4 -o play_%02d.pfm
    check "skins and weights move --move $move" sh -c '! cmp -s play_00.pfm play_01.pfm && ! cmp -s play_01.pfm play_03.pfm'
    status 0 play $shaped $few --move $move --fps 4 --from 3 --frames 1 -o alone_%02d.pfm
    check "the same alone" cmp -s play_03.pfm alone_03.pfm
done
status 0 play $shaped $few --fps 1 --from 1 --frames 4 -o play_%02d.pfm
check "after their last key they stand" cmp -s play_01.pfm play_04.pfm
check "and so does the camera" lacks 'camera' err.txt
status 0 bake $shaped -o shaped.lmt --elements 64 --receivers 64
status 0 play $shaped $few --transfer shaped.lmt --fps 1 --frames 2 -o play_%02d.pfm
check "that baked shapes stand still is said" holds "objects stand still: what was baked" err.txt
check "with them all does" cmp -s play_00.pfm play_01.pfm
status 0 pack $shaped -o shaped.lmp
said "skins and morph targets that animations move stand still in what is packed"
status 0 play shaped.lmp $few --fps 1 --frames 2 -o play_%02d.pfm
check "nothing else moves instead" holds "nothing moves: of the animations of shaped.lmp nothing is left here" err.txt
check "neither lights nor the camera" cmp -s play_00.pfm play_01.pfm

# If the animations of a file move nothing that is drawn, there is no default motion either, and a line reports it.
sed 's/"path":"[a-z]*"/"path":"pointer"/g' $shaped >idle.gltf
status 0 play idle.gltf $few --fps 1 --frames 2 -o play_%02d.pfm
check "idle animations are counted" holds "channels of animations that move nothing of the scene, or what does not move here: 3" err.txt
check "that nothing moves is said" holds "nothing moves: of the animations of idle.gltf nothing is left here" err.txt
check "nothing moves" cmp -s play_00.pfm play_01.pfm
status 0 play idle.gltf $few --move camera --fps 1 --frames 2 -o play_%02d.pfm
check "a camera that is asked to does" differ play_00.pfm play_01.pfm
status 1 play idle.gltf $few --move object --frames 2 -q

# The file may have more lights than the command line that replaces them with --light.
more=$(awk 'BEGIN { while (n++ < 64) printf "{\"translation\":[0,2,0],\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}}," }')
sed "s/{\"translation\":\[0,2,0\],[^}]*}}}/{\"children\":[4]}/; s/\"camera\":0}\]/\"camera\":0},{\"children\":[$(seq -s, 5 68)]},${more%,}]/" moving.gltf >lamps.gltf
status 0 play lamps.gltf --size 32x24 --quality draft --light point:0,2,0:0,-1,0:4,4,4 --fps 1 --frames 2 -o play_%02d.pfm
check "one light for 64" differ play_00.pfm play_01.pfm

finish
