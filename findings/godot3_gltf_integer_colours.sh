#!/bin/sh
# Godot 3.2.3 (Debian 12) does not normalize integer vertex colours of glTF files, so nearly all of them become white.
#
# glTF 2.0, section 3.7.2.1: COLOR_0 may be normalized bytes or shorts; 64 of 255 is 0.25. Godot's importer does not
# divide such integers, and a mesh clamps colours to 1. The script imports a triangle with the colour
# (0.25, 0.5, 0.75) as floats, bytes and shorts, and prints the colours of Godot's mesh. It exits with 1 if the integers
# no longer become (1, 1, 1), or if the script cannot show it. You need apt-get, root, python3 and network access.
# Nothing is installed outside the script's folder.
set -eu
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
chmod 755 "$dir"
cd "$dir"
mkdir partial project
apt-get -y -q --no-install-recommends --reinstall --download-only -o Dir::Cache::archives="$dir" install \
    godot3-server=3.2.3-stable-1+b3 >apt.log 2>&1 || { cat apt.log; exit 1; }
for package in *.deb; do dpkg -x "$package" root; done
LD_LIBRARY_PATH=$(echo "$dir"/root/usr/lib/*-linux-gnu*)
export LD_LIBRARY_PATH HOME="$dir"

python3 - <<'END'
import base64, json, struct
positions = struct.pack('<9f', 0, 0, 0, 1, 0, 0, 0, 1, 0)
for name, component, colour in (('float', 5126, struct.pack('<4f', 0.25, 0.5, 0.75, 1)),
                                ('byte', 5121, struct.pack('<4B', 64, 128, 191, 255)),
                                ('short', 5123, struct.pack('<4H', 16384, 32768, 49151, 65535))):
    data = positions + 3 * colour
    json.dump({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "COLOR_0": 1}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                       "min": [0, 0, 0], "max": [1, 1, 0]},
                      {"bufferView": 1, "componentType": component, "normalized": component != 5126, "count": 3,
                       "type": "VEC4"}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36},
                        {"buffer": 0, "byteOffset": 36, "byteLength": len(data) - 36}],
        "buffers": [{"byteLength": len(data),
                     "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]},
        open('project/%s.gltf' % name, 'w'))
END
echo 'config_version=4' >project/project.godot
cat >project/print.gd <<'END'
extends SceneTree

func mesh_in(node):
    if node is MeshInstance:
        return node.mesh
    for child in node.get_children():
        var mesh = mesh_in(child)
        if mesh:
            return mesh

func _init():
    for name in ["float", "byte", "short"]:
        var mesh = mesh_in(load("res://" + name + ".gltf").instance())
        print("RESULT ", name, ": ", Array(mesh.surface_get_arrays(0)[Mesh.ARRAY_COLOR])[0])
    quit()
END
godot=$dir/root/usr/bin/godot3-server
$godot --version 2>/dev/null | grep '^3' || true
timeout 300 $godot --path project -e -q >import.log 2>&1 || true
timeout 300 $godot --path project --script print.gd 2>&1 | sed -n 's/^RESULT //p' | tee results
grep -q '^float: 0.2[0-9]*,0.[45][0-9]*,0.7[0-9]*,1' results
grep -q '^byte: 1,1,1,1' results
grep -q '^short: 1,1,1,1' results
