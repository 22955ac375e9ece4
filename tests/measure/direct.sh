# direct.sh: what bounced light adds to direct light, one thread, the least of five runs that alternate: of scenes in which
# little bounces, and of a hundred lights.
#
# LMB_SHARED: the folder with truth/ and data/ (default ../shared). SIMPLE, MANY: which files below it. RUNS, FRAME (of the
# simple ones, default 640x480). User seconds of the whole command. A simple scene passes where the default picture takes
# 1.5 x as long as the direct one, and the shadow map and the tree (--stats), at most. Many lights, at 256 x 256, pass at 3 x
# the instructions of direct light by the same tree, or user seconds where valgrind is missing. Spots stand in for the
# lights of MANY's file, and suns for that of a court that tests/scenes makes.
. tests/measure/draw.sh

shared=${LMB_SHARED:-../shared}
runs=${RUNS:-5}

# user_of COMMAND...: its user seconds, and fails as it does.
user_of() {
    python3 - "$@" <<'PYTHON'
import resource, subprocess, sys
done = subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
print('%.3f' % resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime)
sys.exit(done.returncode)
PYTHON
}

least() { sort -n "$1" | head -n 1; }

# both FILE SIZE [OPTION...]: user seconds in $direct and $full, and of the map and the tree in $light.
both() {
    drawn=$1 size=$2
    shift 2
    : >"$work/direct"
    : >"$work/full"
    : >"$work/light"
    for run in $(seq "$runs"); do
        for show in direct full; do
            user_of "$TOOL" render "$drawn" -o "$work/drawn.pfm" --size "$size" --threads 1 --show $show \
                --stats "$work/stats.json" "$@" >>"$work/$show" || return
        done
        echo "$(figure shadow_maps) $(figure BVH) $(figure first_points)" | awk '{ print $1 + $2 + $3 }' >>"$work/light"
    done
    direct=$(least "$work/direct") full=$(least "$work/full") light=$(least "$work/light")
}

# instructions FILE SHOW: of a picture of 256 x 256 with the tree of lights.
instructions() {
    valgrind --tool=callgrind --callgrind-out-file=/dev/null "$TOOL" render "$1" -o "$work/drawn.pfm" --size 256x256 \
        --threads 1 --show "$2" --many-lights 16384 2>&1 | sed -n 's/.*Collected : //p'
}

# with_lights FOLDER KIND N: FOLDER/scene.gltf with N lights of a kind in place of its own, into $work/lit.
with_lights() {
    mkdir -p "$work/lit"
    cp "$1/scene.bin" "$work/lit" && python3 - "$1/scene.gltf" "$work/lit/scene.gltf" "$2" "$3" <<'PYTHON'
import json, math, random, sys
source, to, kind, count = sys.argv[1:]
draw = random.Random(1)
with open(source) as f:
    file = json.load(f)
nodes = [n for n in file['nodes'] if 'extensions' not in n]
low, high = [[pick(a[end][i] for a in file['accessors'] if a['type'] == 'VEC3' and 'min' in a) for i in range(3)]
             for pick, end in ((min, 'min'), (max, 'max'))]
lights = []
for n in range(int(count)):
    light = {'type': kind, 'color': [draw.uniform(0.3, 1) for _ in range(3)], 'intensity': draw.uniform(0.5, 1)}
    if kind == 'spot':
        light['spot'] = {'innerConeAngle': draw.uniform(0.2, 0.4), 'outerConeAngle': draw.uniform(0.5, 1)}
    # A node's light shines along -z: turned about x by 30 to 90 degrees it shines down, and then to any side.
    a, b = draw.uniform(0.5, 1.57), draw.uniform(0, 6.28)
    x, y = [math.cos(a / 2), -math.sin(a / 2)], [math.cos(b / 2), math.sin(b / 2)]
    turn = [x[1] * y[0], x[0] * y[1], -x[1] * y[1], x[0] * y[0]]
    nodes.append({'rotation': turn, 'translation': [draw.uniform(l + 0.1 * (h - l), h - 0.1 * (h - l))
                                                    for l, h in zip(low, high)],
                  'extensions': {'KHR_lights_punctual': {'light': n}}})
    lights.append(light)
file['nodes'] = nodes
file['scenes'] = [{'nodes': list(range(len(nodes)))}]
file['extensions']['KHR_lights_punctual']['lights'] = lights
with open(to, 'w') as f:
    json.dump(file, f)
PYTHON
}

# many NAME FILE
many() {
    if ! both "$2" 256x256; then
        fail "$1: it was not drawn"
        return
    fi
    by_maps=$direct
    both "$2" 256x256 --many-lights 16384
    of_user=$(echo "$full $direct" | awk '{ printf "%.2f", $1 / $2 }')
    of_count=-
    ! command -v valgrind >/dev/null ||
        of_count=$(echo "$(instructions "$2" full) $(instructions "$2" direct)" |
            awk '{ printf "%.2f", $1 / $2 }')
    echo "| $1 | $by_maps | $direct | $full | $of_user | $of_count |"
    check "$1: $of_user x the user seconds, $of_count x the instructions of direct light" \
        awk -v a="$of_user" -v b="$of_count" 'BEGIN { exit !((b == "-" ? a : b) + 0 <= 3) }'
}

command -v python3 >/dev/null || { skip "no python3"; finish; }

echo "| scene | direct, user s | default | map and tree | default / direct | (default - map and tree) / direct |"
echo "|---|---|---|---|---|---|"
for file in ${SIMPLE-data/gltf/Box.glb data/gltf/TwoSidedPlane/TwoSidedPlane.gltf}; do
    if both "$shared/$file" "${FRAME:-640x480}"; then
        echo "$direct $full $light" | awk -v name="$(basename "$file")" '{
            printf "| %s | %s | %s | %.3f | %.2f | %.2f |\n", name, $1, $2, $3, $2 / $1, ($2 - $3) / $1 }'
        check "$file: over 1.5 x direct light, map and tree" \
            awk -v d="$direct" -v f="$full" -v l="$light" 'BEGIN { exit !(f <= 1.5 * d + l) }'
    else
        fail "$file: it was not drawn"
    fi
done

printf '\n| a hundred lights | direct by maps, user s | direct by tree | default | default / direct by tree | instructions |\n'
echo "|---|---|---|---|---|---|"
for file in ${MANY-truth/many_lights_100/scene.gltf}; do
    many "points in a room" "$shared/$file"
    with_lights "$shared/$(dirname "$file")" spot 100 && many "spots in that room" "$work/lit/scene.gltf"
    mkdir -p "$work/court"
    "$B/scenes" courtyard -o "$work/court"
    with_lights "$work/court" directional 100 && many "suns over courtyard" "$work/lit/scene.gltf"
done
finish
