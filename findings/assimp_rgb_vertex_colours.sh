#!/bin/sh
# Assimp 5.2.5 (Debian 12) reads glTF vertex colours without alpha as fully transparent.
#
# glTF 2.0, section 3.7.2.1: COLOR_0 may be VEC3, and alpha is then 1. The script writes one triangle with COLOR_0 as
# VEC3 and as VEC4 and converts both to PLY. It exits with 1 if Assimp's alpha of the VEC3 colours is no longer 0, or
# if the script cannot show it. You need apt-get, root, python3 and network access. Nothing is installed outside the
# script's folder.
set -eu
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
chmod 755 "$dir"
cd "$dir"
mkdir partial
apt-get -y -q --no-install-recommends --reinstall --download-only -o Dir::Cache::archives="$dir" install \
    assimp-utils=5.2.5~ds0-1+b1 libassimp5=5.2.5~ds0-1+b1 >apt.log 2>&1 || { cat apt.log; exit 1; }
for package in *.deb; do dpkg -x "$package" .; done
LD_LIBRARY_PATH=$(dirname "$dir"/usr/lib/*/libassimp.so.5)
export LD_LIBRARY_PATH

python3 - <<'END'
import base64, json, struct
positions = struct.pack('<9f', 0, 0, 0, 1, 0, 0, 0, 1, 0)
for n in 3, 4:
    data = positions + b''.join(struct.pack('<%df' % n, *(0.25, 0.5, 0.75, 1.0)[:n]) for _ in range(3))
    json.dump({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "COLOR_0": 1}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                       "min": [0, 0, 0], "max": [1, 1, 0]},
                      {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC%d" % n}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36},
                        {"buffer": 0, "byteOffset": 36, "byteLength": len(data) - 36}],
        "buffers": [{"byteLength": len(data),
                     "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]},
        open('vec%d.gltf' % n, 'w'))
END
usr/bin/assimp version | grep -o 'Version [0-9.]*'
for n in 3 4; do
    usr/bin/assimp export vec$n.gltf vec$n.ply -fply >vec$n.log 2>&1 || { cat vec$n.log; exit 1; }
    sed '1,/^end_header/d' vec$n.ply | sed -n 1p >vec$n.txt
    echo "COLOR_0 as VEC$n, (0.25, 0.5, 0.75$([ $n = 3 ] || echo ', 1')), is x y z r g b a of PLY: $(cat vec$n.txt)"
done
three=$(awk '{ print $NF }' vec3.txt) four=$(awk '{ print $NF }' vec4.txt)
echo "alpha of VEC3: $three (glTF: 255), of VEC4: $four"
[ "$three" = 0 ] && [ "$four" = 255 ]
