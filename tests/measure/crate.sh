# crate.sh: measures how baked light misses the shadow and reflection of a moving object: a crate in a closed room.
#
# The crate is put at three places, and finally outside the room, which shows the error of the room's own light. A
# row has the whole picture's trim and RMSE, bounced light against the best settings with the crate in place.
# FRAME (default 160x120).
. tests/scripts/checks.sh

work=$B/measure/crate
mkdir -p "$work"

# A room of 4 x 2.4 x 4 m, and a crate of 0.7 m: boxes around (0, 1.2, 0) and (0, 0.35, 0).
python3 - "$work/room.gltf" <<'PYTHON' || { skip "no python3"; finish; }
import base64, json, struct, sys
def box(half, sign):
    out = []
    for axis in range(3):
        for side in (-1, 1):
            u, v = (axis + 1) % 3, (axis + 2) % 3
            corners = []
            for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                p = [0, 0, 0]
                p[axis], p[u], p[v] = side * half[axis], a * half[u], b * half[v]
                corners.append(p)
            order = (0, 1, 2, 0, 2, 3) if side * sign > 0 else (0, 2, 1, 0, 3, 2)
            out += [corners[i] for i in order]
    return out
sizes = [((2, 1.2, 2), -1), ((0.35, 0.35, 0.35), 1)]
data = b''.join(struct.pack('<3f', *p) for half, sign in sizes for p in box(half, sign))
views = [{'buffer': 0, 'byteOffset': 432 * i, 'byteLength': 432} for i in range(2)]
accessors = [{'bufferView': i, 'componentType': 5126, 'count': 36, 'type': 'VEC3', 'min': [-x for x in sizes[i][0]],
              'max': list(sizes[i][0])} for i in range(2)]
file = {'asset': {'version': '2.0'}, 'scene': 0, 'scenes': [{'nodes': [0, 1]}],
        'nodes': [{'mesh': 0, 'translation': [0, 1.2, 0]}, {'mesh': 1, 'translation': [0, 0.35, 0]}],
        'meshes': [{'primitives': [{'attributes': {'POSITION': i}, 'material': i}]} for i in range(2)],
        'materials': [{'pbrMetallicRoughness': {'baseColorFactor': c + [1], 'metallicFactor': 0}}
                      for c in ([0.7, 0.7, 0.7], [0.7, 0.4, 0.2])],
        'buffers': [{'byteLength': len(data),
                     'uri': 'data:application/octet-stream;base64,' + base64.b64encode(data).decode()}],
        'bufferViews': views, 'accessors': accessors}
with open(sys.argv[1], 'w') as f:
    json.dump(file, f)
PYTHON

cat >"$work/path.txt" <<'PATH'
0 object:1 0.6,0.35,-0.2 0.6,0.35,9.8
1 object:1 -0.4,0.35,-1.2 -0.4,0.35,8.8
2 object:1 -1.2,0.35,0.6 -1.2,0.35,10.6
3 object:1 0,-30,0 0,-30,10
PATH
"$TOOL" bake "$work/room.gltf" -q -o "$work/room.lmt" --moving 1 --elements 4096 --receivers 3000 || { fail "the room is not baked"; finish; }
"$TOOL" play "$work/room.gltf" --transfer "$work/room.lmt" --path "$work/path.txt" --move object --fps 1 --frames 4 \
    --check 1 --show indirect --size "${FRAME:-160x120}" --light spot:1.2,2.2,0.8:-0.3,-1,-0.2:30,28,25:25,40 \
    --eye -1.6,2.1,1.8 --target 0.1,0,-0.2 --fov 75 >"$work/said" 2>&1 && pass || fail "$(head -n 1 "$work/said")"
echo "| the crate | trim, rmse, mean |"
echo "|---|---|"
awk 'BEGIN { split("in the lit patch,by the wall,near the eye,out of the room", place, ",") }
    /^frame [0-9]/ { print "| " place[++n] " | " $4 ", " $6 ", " $8 " |" }' "$work/said"
finish
