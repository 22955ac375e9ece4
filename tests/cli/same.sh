# same.sh: checks that `play` at time 0 and `render` write the same bytes for the same file and options.
. tests/cli/common.sh

# same EXTENSION ARGUMENT...: runs both verbs with this extension and compares the files.
same() {
    end=$1
    shift
    rm -f whole."$end" frame0."$end"
    status 0 render "$@" -o whole."$end"
    grep -v 'EV (auto' err.txt >said-render.txt
    status 0 play "$@" --frames 1 -q -o frame%01d."$end"
    check "render and play: $* -o .$end" cmp -s whole."$end" frame0."$end"
}

box
block
few="--size 24x18 --shadow-map 64 --quality draft --elements 256"
printf '%s\n' 'v -0.5 0 0.5' 'v 0.5 0 0.5' 'v 0.5 1 0.5' 'v -0.5 1 0.5' 'v -0.5 0 -0.5' 'v 0.5 0 -0.5' 'v 0.5 1 -0.5' \
    'v -0.5 1 -0.5' 'f 1 2 3 4' 'f 6 5 8 7' 'f 5 1 4 8' 'f 2 6 7 3' 'f 4 3 7 8' 'f 5 6 2 1' >outside.obj

# An OBJ without light, under a sky and on a ground, in every format.
for end in png ppm pfm hdr; do
    same $end outside.obj $few
done
check "it is a sky on a ground" holds "a clear sky and a ground below" said-render.txt
status 0 play outside.obj $few --frames 1 -o frame%01d.png
said "a clear sky and a ground below"

# Worlds: none, a sky, an environment map with its sun; and backgrounds.
{ printf 'PF\n32 16\n-1.0\n'; repeated 700 "$half"; printf '\000\000\000\106'; repeated 835 "$half"; } >world.pfm
for world in none sky world.pfm; do
    same png outside.obj $few --world $world
    same pfm outside.obj $few --world $world --ground none
    same png demo $few --world $world
done
for behind in transparent ff8800; do
    same png outside.obj $few --background $behind
    same png demo $few --background $behind --exposure 1 --tone linear
done

# Indoors: light of the room, light from the command line, an area light, and baked light.
same png demo $few
same pfm demo $few --show indirect --bounces 2
same pfm block.obj $inside --quality draft
same png demo $few --light point:0,1.5,0:0,-1,0:6,6,6:0.2
status 0 bake block.obj -o block.lmt --elements 256 --receivers 300
same png block.obj --size 24x18 --transfer block.lmt

# glTF with a camera and with animations at 0 s; cameras from the command line.
moving
sed 's/"translation":\[0,1.5,4\]/"translation":[0,1,4]/' moving.gltf >still.gltf
same png still.gltf $few
same png still.gltf $few --camera 0 --world sky
same pfm still.gltf $few --eye 2,2,4 --target 0,0.5,0 --near 0.2

# Frames under a sky, or without a background, are the same singly and in slices. In some of them the camera does not
# move.
for way in "" "--background transparent" "--move light --world world.pfm --light point:1,2,1:0,-1,0:9,9,9"; do
    status 0 play outside.obj $few $way --fps 1 --frames 4 -o all%01d.png
    status 0 play outside.obj $few $way --fps 1 --from 3 --frames 1 -o alone%01d.png
    check "the same alone $way" cmp -s all3.png alone3.png
    check "and it moves $way" differ all0.png all2.png
    status 0 play outside.obj $few $way --fps 1 --frames 4 --slice 1/2 -q -o part%01d.png
    status 0 play outside.obj $few $way --fps 1 --frames 4 --slice 2/2 -q -o part%01d.png
    status 0 merge -q part%01d.png.?of2 -o part%01d.png
    check "the same in slices $way" sh -c 'for k in 0 1 2 3; do cmp -s "all$k.png" "part$k.png" || exit 1; done'
done
printf '0 object:0 0,0,0\n2 object:0 0.2,0,0\n' >path.txt
status 0 play outside.obj $few --path path.txt --background 0000ff --fps 1 --frames 3 -o all%01d.png
status 0 play outside.obj $few --path path.txt --background 0000ff --fps 1 --from 2 --frames 1 --exposure auto -o alone%01d.png
check "a still camera before a colour: the same alone" cmp -s all2.png alone2.png

# Errors under a sky are measured against the same sky.
status 0 play outside.obj --size 4x3 --quality best --gather full --frames 1 --check 1
check "the best has no error against itself under a sky" grep -q "trim 0.0000  rmse 0.0000  mean 1.0000" out.txt

status 2 play outside.obj $few --background transparent --frames 1 -o bad%01d.ppm
status 1 play outside.obj $few -q --world missing.hdr --frames 1 -o bad%01d.png
status 1 play outside.obj $few --world world.pfm --ground none --many-lights 64 --move light -q --frames 1 -o bad%01d.png

finish
