# mix.sh: mix: an object in a photo with depth.
. tests/cli/common.sh

white
photo
status 0 render demo $small -o demo.png

{ printf 'Pf\n24 24\n-1.0\n'; head -c 2304 /dev/zero; } >blind.pfm
status 0 mix $seen -o same.pfm
check "without an object the photo stays as it is" cmp photo.pfm same.pfm
status 0 mix $seen $tent --light sun:0,0,0:0.6,-0.2,-1:2,2,2 -o mixed.pfm
check "an object changes the photo" differ photo.pfm mixed.pfm
status 0 mix $seen $tent --light sun:0,0,0:0.6,-0.2,-1:2,2,2 --backend scalar -o scalar.pfm
check "a backend changes the mixed picture" cmp mixed.pfm scalar.pfm
status 0 mix $seen $tent --light sun:0,0,0:0.6,-0.2,-1:2,2,2:12 -o soft.pfm
check "a light with a size changes the mixed picture" differ mixed.pfm soft.pfm
status 0 mix $seen $tent --light sun:0,0,0:0.6,-0.2,-1:2,2,2:12 --backend scalar --threads 1 -o scalar.pfm
check "a backend changes a soft shadow" cmp soft.pfm scalar.pfm
status 2 mix $seen $tent --light sun:0,0,0:0.6,-0.2,-1:2,2,2:91 -o bad.png
status 0 mix $seen $tent --samples 16 -o soft.png
status 0 render tent.obj --size 16x16 --light point:0,3,0:0,-1,0:6,6,6:0.5 --show direct -o soft.png
status 2 relief render nowhere.lmr --light sun:0,0,0:0.6,-0.2,-1:2,2,2:12 -o bad.png
status 0 mix $seen $tent --stats mix.json -o mixed.hdr
check "--stats of mix names the planes" grep -q '"planes": 1,' mix.json
status 0 mix $seen $tent --show delta -o delta.pfm
check "the delta is darker somewhere" sh -c '"$1" info "$2" | grep -q "red   min -0"' sh "$TOOL" delta.pfm
for show in final delta planes voxels env object; do
    status 0 mix $seen $tent --show $show --roughness 0.2,0.5 -o mixed.png
done
status 0 mix --photo photo.pfm --depth blind.pfm --intrinsics 30,30,11.5,11.5 -o same.pfm
check "nor does a photo without depth change" cmp photo.pfm same.pfm
status 1 mix --photo photo.pfm --depth blind.pfm --intrinsics 30,30,11.5,11.5 --object tent.obj -o bad.png
said "nothing to stand on: no pixel of the depth has a number over 0, so none is measured"
status 2 mix $seen --object tent.obj --at 5000,10 -o bad.png
said "--at 5000,10: the photo has 24 x 24 pixels"
status 2 mix --photo photo.pfm --depth wall.pfm --intrinsics 0,0,0,0 --object tent.obj -o bad.png
said "--intrinsics: focal lengths are over 0"
# Stored pictures keep their codes; our own files keep all bytes.
far() { printf 'Pf\n%d %d\n-1.0\n' "$1" "$2"; head -c $(($1 * $2 * 4)) /dev/zero; }
far 32 24 >far.pfm
status 0 mix --photo demo.png --depth far.pfm --intrinsics 30,30,9,6 -o same.png
check "a PNG comes out as it went in" cmp demo.png same.png
far 19 13 >far.pfm
status 0 mix --photo "$root/tests/fuzz/corpus/jpeg/baseline_420.jpg" --depth far.pfm --intrinsics 30,30,9,6 -o same.png
check "a JPEG's pixels come out as they went in" sh -c '"$1" compare "$2" "$3" | grep -q "exact 247 of 247"' sh "$TOOL" "$root/tests/fuzz/corpus/jpeg/baseline_420.jpg" same.png
# One pixel does not define a plane, so a place is required.
{ printf 'PF\n1 1\n-1.0\n'; printf "$half$half$half"; } >photo1.pfm
{ printf 'Pf\n1 1\n-1.0\n'; printf "$two"; } >depth1.pfm
dot="--photo photo1.pfm --depth depth1.pfm --intrinsics 30,30,0,0"
status 0 mix $dot -o same.pfm
check "one pixel comes out as it went in" cmp photo1.pfm same.pfm
status 1 mix $dot --object tent.obj -o bad.png
said "no plane in the depth to stand on; 100 % of its pixels are measured, 2 .. 2 m away: --depth-scale sets its unit"
status 0 mix $dot --object tent.obj --at 0,0 --scale 0.01 --shadow-map 64 --voxels 4 -o mixed.pfm
# If there is only a wall, the object stands on the wall, and a line reports it.
status 0 mix $seen --object tent.obj --shadow-map 64 --voxels 4 -o mixed.pfm
check "that no plane faces up is said" holds "no plane faces up" err.txt
# --show planes prints no message about the object's place, because no object is placed.
status 0 mix $seen --object tent.obj --show planes -o planes.png
check "--show planes puts no object anywhere" lacks 'stands on\|no plane faces up' err.txt
status 0 mix $seen --object tent.obj --scale 0.5 --at 2,12 --shadow-map 64 --voxels 4 -o mixed.pfm
check "that the object is off the picture is said" holds "part of the object is off the picture" err.txt
# A spike out of the wall: near corners of the bounding box are outside the picture, but the spike is inside.
printf 'v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv 0 0 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n' >spike.obj
spike="--object spike.obj --scale 0.6 --shadow-map 64 --voxels 4"
for at in 11,11 9,11 14,11 11,9 11,14; do
    status 0 mix $seen $spike --at $at -o mixed.pfm
    check "a spike at $at is in the picture" lacks 'off the picture' err.txt
done
for at in 7,11 16,11 11,7 11,16; do
    status 0 mix $seen $spike --at $at -o mixed.pfm
    said "part of the object is off the picture"
done
# Sizes are in metres of the file; an absurd size is reported.
status 0 mix $seen --object tent.obj --scale 300 --shadow-map 64 --voxels 4 -o mixed.pfm
check "an object that fills the picture is said" holds "m long and fills the picture; --fit chooses its size" err.txt
status 0 mix $seen --object tent.obj --scale 0.0001 --shadow-map 64 --voxels 4 -o mixed.pfm
check "an object that vanishes is said" holds "m long and vanishes in the picture" err.txt
status 0 mix $seen --object tent.obj --fit --on wall --shadow-map 64 --voxels 4 -o mixed.pfm
check "what fits is neither" lacks 'm long and' err.txt
status 1 mix $seen --object tent.obj --on floor -o bad.png
said "--on floor: no plane faces up"
status 2 mix $seen --object tent.obj --fit --scale 2 -o bad.png
status 2 mix $seen --object tent.obj --on wall --at 3,4 -o bad.png
# Surroundings in one colour light the object only in that colour.
{ printf 'PF\n1 6\n-1.0\n'; repeated 6 "$one\000\000\000\000\000\000\000\000"; } >red.pfm
status 0 mix $seen $tent --world red.pfm --show object -o mixed.pfm
check "--world lights the object" sh -c '"$1" info "$2" | grep -q "red   min 0 *max [0-9.]*[1-9]"' sh "$TOOL" mixed.pfm
check "--world lights it in its own colour" sh -c '"$1" info "$2" | grep -q "green min 0 *max 0 "' sh "$TOOL" mixed.pfm
status 1 mix $seen $tent --world nowhere.pfm -o bad.png
status 1 mix --photo photo.pfm --depth facepx.pfm --intrinsics 30,30,11.5,11.5 -o bad.png
status 1 mix --photo photo.pfm --depth demo.png --intrinsics 30,30,11.5,11.5 -o bad.png
status 1 mix --photo nowhere.pfm --depth wall.pfm --intrinsics 30,30,11.5,11.5 -o bad.png
status 2 mix --photo photo.pfm --depth wall.pfm --intrinsics 0,30,11.5,11.5 -o bad.png
status 1 mix $seen --object nowhere.obj -o bad.png
status 2 mix $seen --object tent.obj --at 24,0 -o bad.png
status 2 mix $seen --object tent.obj --at 3e9,5 -o bad.png
status 1 mix --frame nowhere -o bad.png
status 2 mix --photo photo.pfm --depth wall.pfm -o bad.png
status 2 mix --photo photo.pfm -o bad.png
status 2 mix $seen
status 2 mix $seen -o bad.png --show nonsense
status 2 mix $seen -o bad.png --shadow-map 100
status 2 mix $seen -o bad.png --roughness 2
status 2 mix $seen -o bad.png --show object
# --up sets the direction up: for a camera that looks down, the desk ahead is the floor.
status 0 mix $seen $tent --up 0,0,1 -o mixed.pfm
check "--up: what faces the camera is a floor" lacks "no plane faces up" err.txt
said "stands on number 1"
status 0 mix $seen $tent --up camera -o mixed.pfm
check "--up camera: that is a wall" holds "hangs on number 1" err.txt
status 2 mix $seen $tent --up 0,0,0 -o bad.png
status 2 mix $seen $tent --up down -o bad.png
# No light at all, and not together with another light.
status 0 mix $seen $tent --light none -o mixed.pfm
check "--light none guesses no light" lacks "no light given" err.txt
status 2 mix $seen $tent --light none --light sun:0,0,0:0.6,-0.2,-1:2,2,2 -o bad.png
said "--light none leaves all lights out"
# Depth of half the size, and of another aspect ratio.
{ printf 'Pf\n12 12\n-1.0\n'; repeated 144 "$two"; } >half.pfm
status 0 mix --photo photo.pfm --depth half.pfm --intrinsics 30,30,11.5,11.5 $tent --light none -o half_mixed.pfm
status 0 mix $seen $tent --light none -o mixed.pfm
check "depth of another size is resampled" "$TOOL" compare half_mixed.pfm mixed.pfm --max rmse=0.001
{ printf 'Pf\n12 6\n-1.0\n'; repeated 72 "$two"; } >flat.pfm
status 1 mix --photo photo.pfm --depth flat.pfm --intrinsics 30,30,11.5,11.5 -o bad.png
said "12 x 6 pixels, the photo has 24 x 24"
# --labels writes what each pixel shows of the object: on the wall, the object's depth is that of the plane, and
# the mask is white there.
status 0 mix $seen --object tent.obj --scale 0.3 --labels lab --light none -o mixed.png
for file in lab.mask.png lab.depth.pfm lab.normal.pfm lab.pose.json; do
    check "--labels writes $file" test -s $file
done
check "the depth of the object is before the wall" sh -c '"$1" info "$2" | grep -q "max 1\.[0-9]*\|max 2 "' sh "$TOOL" lab.depth.pfm
check "the pose is as far away as the wall" grep -q 'object_to_camera' lab.pose.json
status 2 mix $seen --labels lab -o mixed.png
said "--labels is of an object in the photo"
status 0 mix --help

# Red plastic has a white highlight. A rough red object has none.
moving
for rough in 0.2 1; do
    sed "s/\"POSITION\":[45]}/&,\"material\":0/g; s/\"nodes\":\[/\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.5,0,0,1],\"metallicFactor\":0,\"roughnessFactor\":$rough}}],&/" moving.gltf >"red$rough.gltf"
    status 0 mix $seen --object "red$rough.gltf" --scale 0.1 --at 8,12 --voxels 4 --light none --show object -q -o "red$rough.pfm"
    "$TOOL" info "red$rough.pfm" >"red$rough.txt"
done
check "a plastic reflects white light" sh -c 'grep -q "green min 0 *max [0-9.]*[1-9]" red0.2.txt'
check "a rough object does not" grep -q "green min 0 *max 0 " red1.txt
printf 'red.png red0.2.gltf 8,12 0 0.8\n' >red.txt
status 0 mix $seen --light none --placements red.txt --labels lab_ -q
"$TOOL" info lab_red.object.png >red_object.txt
check "so does a plastic of a list" sh -c 'grep -q "green min 0 *max [1-9]" red_object.txt'

# An object that glows needs no other light.
printf 'newmtl glow\nKd 0 0 0\nKe 4 3 2\n' >glow.mtl
{ printf 'mtllib glow.mtl\nusemtl glow\n'; cat tent.obj; } >glow.obj
status 0 mix $seen --object glow.obj --scale 0.2 --at 8,12 --shadow-map 64 --voxels 4 --light none --show delta -q -o glow.pfm
check "an object that glows lights the photo" sh -c '"$1" info "$2" | awk "\$1 == \"red\" { exit !(\$5 > 0.05) }"' sh "$TOOL" glow.pfm

finish
