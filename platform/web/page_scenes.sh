# page_scenes.sh: page_scenes.sh TOOL SCENES FOLDER: makes the page's extra files: scenes with baked light, a relief, a
# photo with depth for `lambent mix`, and scenes.json, a list of the scenes. Existing files are kept.
set -e
tool=$1 scenes=$2 to=$3

bake() { # SCENE NAME
    if [ ! -s "$to/$2.lmt" ]; then
        "$tool" bake "$1" --elements 4096 -q -o "$to/$2.lmt"
    fi
}

# A fluted vase, turned about its axis: twelve flutes.
vase() {
    awk 'BEGIN {
        pi = 3.14159265358979; rings = 48; n = 144
        for (i = 0; i <= rings; ++i) {
            h = i / rings
            r = 0.16 + 0.2 * sin(pi * h ^ 0.7) ^ 2 + 0.07 * h ^ 6
            for (k = 0; k < n; ++k) {
                a = 2 * pi * k / n
                f = r * (1 - 0.06 * sin(pi * h) * (1 + cos(12 * a)) / 2)
                printf "v %.5f %.5f %.5f\n", f * sin(a), h, f * cos(a)
            }
        }
        for (i = 0; i < rings; ++i) for (k = 0; k < n; ++k) {
            a = i * n + k + 1; b = i * n + (k + 1) % n + 1
            printf "f %d %d %d\nf %d %d %d\n", a, b, b + n, a, b + n, a + n
        }
        printf "v 0 0 0\nv 0 0.97 0\n"
        c = (rings + 1) * n + 1; top = rings * n
        for (k = 0; k < n; ++k) printf "f %d %d %d\n", c, (k + 1) % n + 1, k + 1
        for (k = 0; k < n; ++k) printf "f %d %d %d\n", c + 1, top + k + 1, top + (k + 1) % n + 1
    }'
}

bake demo demo
list='{"name": "demo", "file": "demo", "transfer": "demo.lmt"}'
for name in small_room gallery; do
    if [ ! -s "$to/$name/scene.gltf" ]; then
        mkdir -p "$to/$name"
        "$scenes" $name -o "$to/$name"
        rm -f "$to/$name/scene.txt" "$to/$name/scene.box"
    fi
    bake "$to/$name/scene.gltf" $name
    list="$list,
 {\"name\": \"$(echo $name | tr _ ' ')\", \"file\": \"$name/scene.gltf\", \"files\": [\"$name/scene.gltf\", \"$name/scene.bin\"],
  \"transfer\": \"$name.lmt\"}"
done
printf '[%s]\n' "$list" > "$to/scenes.json"
if [ ! -s "$to/mix/depth.pfm" ]; then
    mkdir -p "$to/mix"
    vase > "$to/mix/vase.obj"
    "$tool" render demo --size 480x360 -q -o "$to/mix/photo.png"
    "$tool" render demo --size 480x360 --show depth -q -o "$to/mix/depth.pfm"
fi
if [ ! -s "$to/relief.lmr" ]; then
    "$tool" relief bake "$to/mix/vase.obj" --views 18 --size 128 --triangles 600 -q -o "$to/relief.lmr"
fi
