# pictures.sh: draws the README's pictures field, relief and mixed, which are in tests/results, into the folder
# B/pictures. (`make demo` draws demo.png, and `make screens` reads back consoles.png.)
. tests/scripts/checks.sh

to=$B/pictures
mkdir -p "$to"

# vase N: 2 N^2 triangles as OBJ: sixteen flutes that twist around a profile with a lip and a foot, 0.62 m high.
vase() {
    awk -v n="$1" 'BEGIN {
        turn = 2 * atan2(0, -1)
        for (j = 0; j <= n; ++j) {
            v = j / n
            radius = 0.13 + 0.07 * sin(0.9 * turn * v + 0.5) + 0.05 * exp(-400 * v * v) + 0.02 * exp(-900 * (v - 1) ^ 2)
            for (i = 0; i < n; ++i) {
                u = turn * i / n
                r = radius * (1 + 0.06 * cos(16 * (u + 0.12 * turn * v)) * sin(turn / 2 * v))
                printf "v %.5f %.5f %.5f\n", r * cos(u), 0.62 * v, -r * sin(u)
            }
        }
        print "v 0 0 0" # the middle of the floor
        for (j = 0; j < n; ++j)
            for (i = 1; i <= n; ++i) {
                a = j * n + i
                b = j * n + i % n + 1
                printf "f %d %d %d\nf %d %d %d\n", a, b, b + n, a, b + n, a + n
            }
        for (i = 1; i <= n; ++i)
            print "f", n * (n + 1) + 1, i % n + 1, i
    }'
}

room() {
    printf 'v %s\n' '-3 0 3' '3 0 3' '3 0 -1' '-3 0 -1' '3 3 -1' '-3 3 -1'
    printf 'f %s\n' '1 2 3' '1 3 4' '4 3 5' '4 5 6'
}

vase 256 >"$to/vase.obj"
vase 64 >"$to/small_vase.obj"
room >"$to/room.obj"

: "${data:=../shared/data}"
if [ -d "$data" ]; then
    check "stand.png" "$TOOL" relight --world "$data/env/venice_sunset_1024x512.hdr" \
        --object "$data/meshes/rhino_60k.ply" --scale 1.7 --at -0.2,0,0.9 \
        --object "$data/gltf/plastic_monobloc_chair.glb" --scale 0.88 --at 1.15,0,-0.3 \
        --object "$data/gltf/kenney-character.glb" --scale 0.8 --at -1.15,0,-0.5 \
        --object "$data/gltf/GlassVaseFlowers.glb" --scale 0.45 --at 0.3,0,-0.9 \
        --light sun:0,0,0:-0.85,-0.5,0.35:5,3.4,2.2 --eye 0.5,1.3,-4.2 --target -0.05,0.55,0 --fov 34 --size 640x360 \
        --exposure -0.5 --samples 16 -q -o "$to/stand.png"
fi
check "field.png" "$TOOL" relight --world demo --object demo --contact -q -o "$to/field.png"

check "vase.lmr" "$TOOL" relief bake "$to/vase.obj" -q -o "$to/vase.lmr"
check "relief.png" "$TOOL" relief render "$to/vase.lmr" --with "$to/room.obj" --size 480x300 \
    --eye 0.2,0.75,1.2 --target 0,0.29,0 --fov 38 --light spot:0.9,1.7,1.6:-0.9,-1.4,-1.6:16,14,11:20,32 \
    --bounce --samples 8 -q -o "$to/relief.png"

# Photo and depth show the built-in room; `mix` gets nothing else.
set -- demo --eye 0.5,1.25,2.5 --target 0.1,0.75,-1 --size 480x360 -q
check "the photo" "$TOOL" render "$@" --bounces 6 --samples 8 -o "$to/photo.png"
check "its depth" "$TOOL" render "$@" --show depth -o "$to/depth.pfm"
check "mixed.png" "$TOOL" mix --photo "$to/photo.png" --depth "$to/depth.pfm" \
    --intrinsics 434.6,434.6,239.5,179.5 --object "$to/small_vase.obj" --fit -q -o "$to/mixed.png"
finish
