# animations.sh: play: what moves by the animations of a glTF file, each frame the same alone.
. tests/cli/common.sh

# The animations of a glTF file: light, camera and a triangle move by them, each frame the same alone.
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
# The first 64 cameras count, and that is said of more.
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

finish
