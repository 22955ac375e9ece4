# play.sh: play: frames with default motion and along paths, equal singly and in a sequence.
. tests/cli/common.sh

box
block
status 0 bake block.obj -o block-1.lmt --elements 256 --receivers 300

# Moving frames are equal singly and in a sequence, by cuts and by baked light, and equal to `render`.
baked="--transfer block-1.lmt"
for way in "--quality draft" "$baked"; do
    for move in light camera all; do
        status 0 play block.obj $inside $way --move $move --fps 2 --frames 4 -o play_%02d.pfm
        check "frames move" sh -c '! cmp -s "$1_00.pfm" "$1_03.pfm"' sh play
        status 0 play block.obj $inside $way --move $move --fps 2 --from 3 --frames 1 --threads 1 -o alone_%02d.pfm
        check "a frame is the same alone, $way --move $move" cmp -s play_03.pfm alone_03.pfm
    done
done
status 0 play block.obj $inside --quality draft --move all --fps 2 --frames 1 -v -o play_%02d.pfm
for note in "light 0 moves by 0" "the camera swings by "; do
    check "--verbose has: $note" holds "$note" err.txt
done
status 0 play block.obj $inside --quality draft --move all --fps 2 --frames 1 -o play_%02d.pfm
check "without --verbose no note of how far things move" sh -c '! grep -q -e "moves by" -e "swings by" "$1"' sh err.txt
check "a frame's times are told" sh -c 'grep -q "^bands  *[0-9.]* " "$1" && grep -q "^whole frame  *[0-9.]* " "$1"' sh out.txt
for extension in png hdr; do
    status 0 play block.obj $inside $baked --frames 2 --fps 1 -o "play%02d.$extension"
    status 0 play block.obj $inside $baked --frames 1 --fps 1 --from 1 -o "alone%02d.$extension"
    check "a .$extension is the same alone" cmp -s "play01.$extension" "alone01.$extension"
done
printf '%s\n' "0 light 0.2,0.5,0 # begins here" "0 camera -0.8,0.6,-0.8 0.3,-0.6,0.3" "" \
    "1 light 0.3,0.5,0.1" "1 camera -0.7,0.6,-0.8 0.2,-0.6,0.3" "3 light 0.5,0.4,0.2" "2 camera -0.5,0.6,-0.8 0,-0.5,0" >keys.txt
status 0 play block.obj $inside $baked --path keys.txt --fps 1 --frames 4 -o key%01d.pfm
status 0 render block.obj --eye -0.7,0.6,-0.8 --target 0.2,-0.6,0.3 --size 32x24 --light point:0.3,0.5,0.1:0,-1,0:5,4,3 \
    --show indirect $baked -o rendered.pfm
check "a frame at a key is as render has it" cmp -s key1.pfm rendered.pfm
status 0 play block.obj $inside --path keys.txt --move camera --quality draft --fps 1 --from 2 --frames 3 -o key%01d.pfm
check "that a path ends is said" holds "keys.txt ends at 3 s, the frames at 4 s: from there on nothing moves" err.txt
check "after its last key nothing moves" cmp -s key2.pfm key4.pfm
printf '0 object:0 0,0,0\n1 object:0 0.1,0,0 1,0,0\n' >mixed.txt
status 1 play block.obj $inside --path mixed.txt --frames 2 -o bad%02d.pfm
said "mixed.txt: line 2: keys of one thing have a target each, or none; see line 1"
for what in light camera object:0; do
    printf "0 $what -0.2,0.5,0 0.2,0.5,0\n2 $what 0.2,0.5,0 -0.2,0.5,0\n" >meets.txt
    status 1 play block.obj $inside --path meets.txt --quality draft --fps 1 --frames 2 -o bad%02d.pfm
    said "meets.txt: at frame 1 what line 1 moves stands at its own target; move one of its keys"
    rm -f bad00.pfm
done
printf '0 object:0 0,0,0\n1 object:0 0.1,0,0\n' >object.txt
status 0 play block.obj $inside --path object.txt --move object --quality draft --fps 2 --frames 3 -o play_%02d.pfm
status 0 play block.obj $inside --path object.txt --quality draft --fps 2 --from 2 --frames 1 -o alone_%02d.pfm
check "an object moves, and is the same alone" sh -c '! cmp -s "$1_00.pfm" "$1_02.pfm" && cmp -s "$1_02.pfm" "$2_02.pfm"' sh play alone
status 1 play block.obj $inside --path object.txt $baked --frames 2 -o bad%02d.pfm
said "object.txt: line 1: object:0 stands still in what was baked; bake it with --moving 0"
little=$(echo "$inside" | sed s/32x24/4x3/)
status 0 play block.obj $little $baked --frames 3 --check 2 --stats play.json
check "every second frame's error is told" sh -c 'test "$(grep -c "^frame [02] *trim 0\.[0-9]* *rmse 0\." "$1")" = 2' sh out.txt
check "--stats of play has the whole frame" grep -q '"whole frame": {"clock": \[[0-9.]*, ' play.json
status 0 play block.obj $little --quality best --gather full --shadow-map 512 --frames 1 --check 1
check "the best has no error against itself" grep -q "trim 0.0000  rmse 0.0000" out.txt
status 0 play block.obj $inside $baked --frames 1 -q -o play_%02d.ppm
check "--quiet is quiet" sh -c '! cat "$1" "$2" | grep -q .' sh out.txt err.txt

# Numbered files are a world that changes. A frame at a file is as `render` has it; between two files the world is
# blended, and each frame is the same alone, with cuts, live light and baked light.
series
echo "0 camera 2,2,3 0,0,0" >still.txt
seen="--eye 2,2,3 --target 0,0,0 --size 24x16 --shadow-map 64"
rests="--path still.txt $seen"
status 0 bake box.obj -o box.lmt --elements 256 --receivers 300
for way in "--gather full --quality draft" "--gather live" "--transfer box.lmt" "--many-lights 4096 --gather full"; do
    status 0 play box.obj $rests $way --world tone_%02d.pfm --world-every 2 --frames 4 -o tone%01d.pfm
    for pair in "tone_03 tone0" "between tone1" "tone_04 tone2" "tone_04 tone3"; do
        set -- $pair
        status 0 render box.obj $seen $way --world "$1.pfm" -o rendered.pfm
        check "$way: in frame $2 the world is $1" cmp "$2.pfm" rendered.pfm
    done
    status 0 play box.obj $rests $way --world tone_%02d.pfm --world-every 2 --from 1 --frames 1 -o alone%01d.pfm
    check "$way: a frame of a changing world is the same alone" cmp tone1.pfm alone1.pfm
done
status 0 play box.obj $rests --quality draft --world tone_%02d.pfm --world-every 2 --frames 4
check "that the world stays is told" holds "tone_%02d.pfm ends after number 4: from picture 2 on the world stays" err.txt
# sun ROW COLUMN: a world of radiance 1 with a lamp in one of 32 x 192 texels. Rows count from the top, unlike in a PFM.
row=$one$one$one$one; row=$row$row$row; row=$row$row$row$row$row$row$row$row
sun() {
    printf 'PF\n32 192\n-1.0\n'
    i=0
    while [ $i -lt 192 ]; do
        if [ $i -eq $((191 - $1)) ]; then
            printf "$row" | head -c $((12 * $2))
            printf '\000\000\172\105\000\000\172\105\000\000\172\105'
            printf "$row" | tail -c $((372 - 12 * $2))
        else
            printf "$row"
        fi
        i=$((i + 1))
    done
}
sun 80 8 >near_0.pfm
sun 82 10 >near_1.pfm
sun 80 8 >far_0.pfm
sun 92 26 >far_1.pfm
for pair in "near 1" "far 2"; do
    set -- $pair
    status 0 play box.obj $rests --quality draft --world "$1_%01d.pfm" --world-every 2 --from 1 --frames 1 -o "$1%01d.pfm"
    check "between two $1 suns there are $2" grep -q "triangles, $2 lights" out.txt
done
status 0 play box.obj $rests --quality draft --world far_%01d.pfm --frames 2 -o other%01d.pfm
status 0 render box.obj $seen --quality draft --world far_1.pfm -o rendered.pfm
check "the shadows are those of the other sun" cmp other1.pfm rendered.pfm
# The sun of another file counts beside animations, too.
moving
sun 136 8 >front_0.pfm
sun 130 28 >front_1.pfm
n=0
for world in front_%01d front_1; do
    status 0 play moving.gltf --size 24x16 --quality draft --world "$world.pfm" --fps 2 --from 1 --frames 1 -o "${world%_*}$((n += 1))_%02d.pfm"
done
check "an animation leaves the suns of a series alone" cmp front1_01.pfm front2_01.pfm
status 2 play demo --world-every 2
said "--world-every needs a numbered --world"
status 2 play demo --world tone_%02d.pfm -o tone_%02d.pfm
said "tone_%02d.pfm: both --world and -o"
cp tone_04.pfm saved.pfm
printf 'no picture' >tone_04.pfm
status 1 play box.obj $rests --quality draft --world tone_%02d.pfm --frames 2 -o early_%01d.pfm
check "no frame is drawn if a later world cannot be read" test ! -e early_0.pfm
mv saved.pfm tone_04.pfm
status 1 play demo --world none_%02d.pfm
said "none_%02d.pfm: no world of this name with a number from 0 to 9999"
echo "0 light:0 0,1,0 0,0,0" >sun.txt
status 1 play box.obj --world near_%01d.pfm --path sun.txt --frames 1
said "light:0 is the sun of a numbered --world, which moves by itself"
status 2 play box.obj $rests --world tone_%02d.pfm --from 4 --frames 1 -o tone_0%01d.pfm
said "tone_04.pfm: cannot be written: it is read by the same command"

finish
