#!/bin/sh
# Godot 3.2.3 (Debian 12) ignores emissiveFactor of a glTF material that also has emissiveTexture.
#
# glTF 2.0, section 3.9.3: emitted light is emissiveFactor times emissiveTexture. Godot's importer sets the emission to
# black and adds the texture in full. The script imports two materials with the factor (1, 0, 0), one of them with a
# white texture, and prints Godot's materials. It exits with 1 if Godot's emission with the texture is no longer black,
# or if the script cannot show it. You need apt-get, root, python3 and network access. Nothing is installed outside the
# script's folder.
set -eu
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
chmod 755 "$dir"
cd "$dir"
mkdir partial
apt-get -y -q --no-install-recommends --reinstall --download-only -o Dir::Cache::archives="$dir" install \
    godot3-server=3.2.3-stable-1+b3 >apt.log 2>&1 || { cat apt.log; exit 1; }
for package in *.deb; do dpkg -x "$package" root; done
LD_LIBRARY_PATH=$(echo "$dir"/root/usr/lib/*-linux-gnu*)
export LD_LIBRARY_PATH HOME="$dir"

mkdir project
python3 - <<'END'
import base64, json, struct, zlib
data = struct.pack('<9f', 0, 0, 0, 1, 0, 0, 0, 1, 0) + struct.pack('<6f', 0, 0, 1, 0, 0, 1)
def chunk(kind, body):
    return struct.pack('>I', len(body)) + kind + body + struct.pack('>I', zlib.crc32(kind + body))
with open('project/white.png', 'wb') as f:
    f.write(b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', struct.pack('>IIBBBBB', 1, 1, 8, 2, 0, 0, 0)) +
            chunk(b'IDAT', zlib.compress(b'\0\xff\xff\xff')) + chunk(b'IEND', b''))
for name in 'factor', 'factor_and_texture':
    material = {"emissiveFactor": [1, 0, 0]}
    if name != 'factor':
        material["emissiveTexture"] = {"index": 0}
    model = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
        "materials": [material],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                       "min": [0, 0, 0], "max": [1, 1, 0]},
                      {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36},
                        {"buffer": 0, "byteOffset": 36, "byteLength": 24}],
        "buffers": [{"byteLength": 60,
                     "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]}
    if name != 'factor':
        model.update(textures=[{"source": 0}], images=[{"uri": "white.png"}])
    json.dump(model, open('project/%s.gltf' % name, 'w'))
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
    for name in ["factor", "factor_and_texture"]:
        var material = mesh_in(load("res://" + name + ".gltf").instance()).surface_get_material(0)
        print("RESULT ", name, ": emission ", material.emission, ", texture ",
            "none" if material.emission_texture == null else "yes", ", operator ",
            "add" if material.emission_operator == SpatialMaterial.EMISSION_OP_ADD else "multiply")
    quit()
END
godot=$dir/root/usr/bin/godot3-server
$godot --version 2>/dev/null | grep '^3' || true
timeout 300 $godot --path project -e -q >import.log 2>&1 || true
timeout 300 $godot --path project --script print.gd 2>&1 | sed -n 's/^RESULT //p' | tee results
grep -q '^factor: emission 1,0,0,1, texture none' results
grep -q '^factor_and_texture: emission 0,0,0,1, texture yes, operator add' results
