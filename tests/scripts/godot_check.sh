# godot_check.sh: checks the recipe for Godot 3 in tools/README.md: imports a baked lightmap, draws it in software, and
# compares the picture with ours. Skipped, with the reason, if tools are missing. Project and pictures: $B/godot.
#
# The bounds include the demo's painting, which Godot 3.2.3 draws white, because COLOR_0 has integers.
. tests/scripts/checks.sh
for command in godot3 godot3-server xvfb-run; do
    command -v $command >/dev/null 2>&1 || { skip "no $command: apt-get install godot3 godot3-server xvfb xauth"; finish; }
done
mkdir -p "$B" && dir=$(cd "$B" && pwd)/godot
rm -rf "$dir"
mkdir -p "$dir"
export HOME="$dir/home" XDG_RUNTIME_DIR="$dir" LIBGL_ALWAYS_SOFTWARE=1 SHOT="$dir/godot.png"
mkdir "$HOME"
light="--elements 1024 --receivers 3000"
"$TOOL" bake demo $light -q -o "$dir/demo.lmt" &&
    "$TOOL" render demo --transfer "$dir/demo.lmt" --bounces 4 --show indirect --samples 1 --size 240x160 --tone linear \
        --exposure 1 -q -o "$dir/ours.png" &&
    "$TOOL" bake demo $light --to lightmap --texels 1024 -q -o "$dir/scene.glb" || fail "lambent bakes no lightmap"

# A project with one scene that draws the bounced light of the room from the demo's camera.
sed -n '/^```gdscript$/,/^```$/p' tools/README.md | sed '/^```/d' >"$dir/lightmap.gd"
cat >"$dir/scene.glb.import" <<'END'
[remap]
importer="scene"
type="PackedScene"
[deps]
source_file="res://scene.glb"
[params]
nodes/custom_script="res://lightmap.gd"
END
printf 'config_version=4\n[application]\nrun/main_scene="res://main.tscn"\n' >"$dir/project.godot"
cat >"$dir/main.tscn" <<'END'
[gd_scene load_steps=3 format=2]
[ext_resource path="res://shot.gd" type="Script" id=1]
[ext_resource path="res://scene.glb" type="PackedScene" id=2]
[node name="main" type="Spatial"]
script = ExtResource( 1 )
[node name="room" parent="." instance=ExtResource( 2 )]
END
cat >"$dir/shot.gd" <<'END'
extends Spatial

func _ready():
    var camera = Camera.new()
    add_child(camera)
    camera.fov = 50
    camera.look_at_from_position(Vector3(0.12, 1.42, 2.7), Vector3(0, 1.1, -1), Vector3.UP)
    camera.environment = Environment.new()
    camera.environment.background_mode = Environment.BG_COLOR
    camera.environment.tonemap_exposure = 2
    for lamp in find_lamps(self):
        lamp.hide()
    for frame in 4:
        yield(VisualServer, "frame_post_draw")
    var image = get_viewport().get_texture().get_data()
    image.flip_y()
    image.save_png(OS.get_environment("SHOT"))
    get_tree().quit()

func find_lamps(from):
    var found = [from] if from is Light else []
    for child in from.get_children():
        found += find_lamps(child)
    return found
END
timeout 300 godot3-server --path "$dir" -e -q >"$dir/import.log" 2>&1
timeout 300 xvfb-run -a -s "-screen 0 640x480x24" godot3 --path "$dir" --video-driver GLES3 --resolution 240x160 \
    --audio-driver Dummy >"$dir/draw.log" 2>&1
if [ ! -s "$SHOT" ]; then
    fail "Godot draws nothing: $(grep -h "SCRIPT ERROR" "$dir"/*.log | head -n 1)"
elif figures=$("$TOOL" compare "$SHOT" "$dir/ours.png" --max e50=0.01,lo=0.98,hi=1.03); then
    pass
    echo "$figures"
else
    fail "Godot draws other light: $figures"
fi
finish
