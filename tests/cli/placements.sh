# placements.sh: mix: many placements from a list, labels, and the photo's grain.
. tests/cli/common.sh

photo
mkdir -p set/out
mv photo.pfm wall.pfm tent.obj set
seen="--photo set/photo.pfm --depth set/wall.pfm --intrinsics 30,30,11.5,11.5 --shadow-map 64"
sun="--light sun:0,0,0:0.6,-0.2,-1:2,2,2:8"
white

list() { printf "$1" >set/list.txt; }
line() { # line NUMBER TEXT LIST: checks that the list is refused at this line
    list "$3"
    status 1 mix $seen --placements set/list.txt
    said "set/list.txt: line $1: $2"
}
list '# a comment\n\nout/a.png tent.obj 8,12 30 0.4\nout/b.pfm "tent.obj" wall - \n'
status 1 mix $seen --placements set/list.txt
list '# a comment\n\nout/a.png tent.obj 8,12 30 0.4\nout/b.pfm "tent.obj" wall\r\nout/c.ppm tent.obj any 0 fit\nout/c.ppm tent.obj 16,12 0 0.2'
status 0 mix $seen $sun --placements set/list.txt -q
for file in a.png b.pfm c.ppm; do
    check "a list draws $file" test -s set/out/$file
done
cp -r set/out set/first
status 0 mix $seen $sun --placements set/list.txt -q --threads 1 --backend scalar
check "threads and back ends change no placement" sh -c 'cmp set/out/a.png set/first/a.png && cmp set/out/b.pfm set/first/b.pfm && cmp set/out/c.ppm set/first/c.ppm'
# Other lines do not change a picture. Pixels far from all objects equal the photo.
list 'out/alone.pfm tent.obj wall\n'
status 0 mix $seen $sun --placements set/list.txt -q
check "a placement does not depend on the others" cmp set/out/b.pfm set/out/alone.pfm
list 'out/near.pfm tent.obj 6,12 0 0.1\nout/far.pfm tent.obj 6,12 0 0.4\n'
status 0 mix $seen --light none --placements set/list.txt -q
tail -c 288 set/photo.pfm >rows.photo
tail -c 288 set/out/near.pfm >rows.near
check "far from a small object the photo stays" cmp rows.photo rows.near
check "a size changes the picture" differ set/out/near.pfm set/out/far.pfm
# An object in the world's coordinates has the same pixels as at --at world.
printf 'v -0.3 -0.2 -1.8\nv 0.3 -0.2 -1.8\nv 0 0.3 -1.8\nf 1 2 3\n' >set/flat.obj
mkdir -p lab_out
list 'out/world.pfm flat.obj world\n'
status 0 mix $seen --light none --placements set/list.txt --labels lab_ -q
status 0 mix $seen --light none --object set/flat.obj --at world --voxels 4 --labels one -q -o one.pfm
check "world: the object is where the mesh has it" cmp lab_out/world.depth.pfm one.depth.pfm
# The shadow of a list's object lies where mix --object has it: both darken the wall by about the same.
list 'out/sun.pfm tent.obj 8,12\n'
status 0 mix $seen $sun --placements set/list.txt -q
status 0 mix $seen $sun --object set/tent.obj --at 8,12 --voxels 4 -q -o whole.pfm
check "a list's picture is near that of --object" sh -c '"$1" compare "$2" "$3" | awk "{ for (i = 1; i < NF; ++i) if (\$i == \"rmse\") exit !(\$(i + 1) < 0.12) }"' sh "$TOOL" set/out/sun.pfm whole.pfm

line 1 'write OUT MESH PLACE' 'out/x.png tent.obj\n'
line 2 'OUT leads out of the list' 'out/x.png tent.obj 8,12\n../x.png tent.obj 8,12\n'
line 1 'OUT leads out of the list' '/tmp/x.png tent.obj 8,12\n'
line 1 'OUT leads out of the list' 'out/../../x.png tent.obj 8,12\n'
line 1 'OUT is no name ending in' 'out/x.txt tent.obj 8,12\n'
line 1 'OUT is no name ending in' ' - tent.obj 8,12\n'
line 1 'PLACE is no X,Y, any' 'out/x.png tent.obj ceiling\n'
line 1 'PLACE is no X,Y, any' 'out/x.png tent.obj nan,3\n'
line 1 'PLACE 24,3: the photo has 24 x 24 pixels' 'out/x.png tent.obj 24,3\n'
line 1 'PLACE world has' 'out/x.png tent.obj world 30\n'
line 1 'TURN is no number' 'out/x.png tent.obj 8,12 left\n'
line 1 'SIZE is no number' 'out/x.png tent.obj 8,12 0 0\n'
line 1 'SIZE is no number' 'out/x.png tent.obj 8,12 0 1e30\n'
line 1 'more than OUT MESH PLACE' 'out/x.png tent.obj 8,12 0 1 2\n'
line 1 'a quote is not closed' 'out/x.png "tent.obj 8,12\n'
line 3 'OUT is that of line 1' 'out/x.png tent.obj 8,12\nout/y.png tent.obj 8,12\nout/x.png tent.obj 8,12\n'
line 3 'OUT is that of line 1' 'out/x.png tent.obj 8,12\nout/y.png tent.obj 8,12\n./out/.//x.png tent.obj 8,12\n'
line 2 'set/nowhere.obj: ' 'out/x.png tent.obj 8,12\nout/y.png nowhere.obj 8,12\n'
line 2 '--on floor: no plane faces up' 'out/x.png tent.obj 8,12\nout/y.png tent.obj floor\n'
line 2 'set/nowhere/y.png: ' 'out/x.png tent.obj 8,12\nnowhere/y.png tent.obj 8,12\n'
line 17 'over 16 objects' "$(for i in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17; do printf 'out/x.png tent.obj 8,12\\n'; done)"
line 1 'is no text' 'out/x.png\000 tent.obj 8,12\n'
check "a bad line draws nothing" none set/out/x.png set/out/y.png set/x.png x.png
list '# nothing\n'
status 1 mix $seen --placements set/list.txt
said "set/list.txt: no placement in it"
status 1 mix $seen --placements set/nowhere.txt
list 'out/x.png tent.obj 8,12\n'
for extra in "--object set/tent.obj" "-o x.png" "--at 3,4" "--scale 2" "--fit" "--on wall" "--show object" "--roughness 0.2"; do
    status 2 mix $seen --placements set/list.txt $extra
done
list 'photo.pfm tent.obj 8,12\n'
cp set/photo.pfm kept.pfm
status 1 mix $seen --placements set/list.txt
check "a list does not write over the photo" cmp kept.pfm set/photo.pfm

# --labels: of each picture; several objects have 255, 254, ... in the mask, and a pose each.
list 'out/a.png tent.obj 6,12 0 0.3\nout/a.png tent.obj 17,12 0 0.3\nout/b.png tent.obj 8,12 0 0.3\n'
mkdir -p lab/out
status 0 mix $seen --light none --placements set/list.txt --labels lab/ -q
for file in mask.png depth.pfm normal.pfm object.png pose.json; do
    check "--labels of a list writes $file" test -s lab/out/a.$file -a -s lab/out/b.$file
done
check "two objects have a pose each" test "$(grep -c '"object_to_camera"' lab/out/a.pose.json)" -eq 3
check "a pose has the camera" holds '"fx": 30,' lab/out/b.pose.json
check "one object has one pose" test "$(grep -c '"object_to_camera"' lab/out/b.pose.json)" -eq 1
"$TOOL" info lab/out/b.mask.png >info.txt
check "the mask has the code 255" holds 'max 255' info.txt

list 'out/a.png tent.obj 6,12 0 0.3\nout/a.pfm tent.obj 17,12 0 0.3\n'
status 1 mix $seen --light none --placements set/list.txt --labels lab/ -q
said "set/list.txt: line 2: lab/out/a.depth.pfm is a file of line 1, too"
list 'out/a.mask.png tent.obj 6,12 0 0.3\nout/a.png tent.obj 17,12 0 0.3\n'
status 1 mix $seen --light none --placements set/list.txt --labels set/ -q
said "set/list.txt: line 2: set/out/a.mask.png is a file of line 1, too"

# --match-grain adds noise to the object, and only as much as the photo has. The noise here is even over 30 codes, which
# is a deviation of 8.7 codes.
noise() { awk 'BEGIN { x = 9; for (i = 0; i < 6912; ++i) { x = (x * 75 + 74) % 65537; printf "\\%03o", 90 + int(x / 7) % 30 } }'; }
# shellcheck disable=SC2059
{ printf 'P6\n48 48\n255\n'; printf "$(noise)"; } >noisy.ppm
{ printf 'Pf\n48 48\n-1.0\n'; repeated 2304 "$two"; } >deep.pfm
noisy="--photo noisy.ppm --depth deep.pfm --intrinsics 60,60,23.5,23.5 --object set/tent.obj --at 23,23 --scale 0.6"
status 0 mix $noisy --voxels 4 --shadow-map 64 --light none --match-grain -q -o grain.ppm
status 0 mix $noisy --voxels 4 --shadow-map 64 --light none -q -o plain.ppm
tail -c 6912 grain.ppm | od -An -v -tu1 -w1 >grain.txt
tail -c 6912 plain.ppm | od -An -v -tu1 -w1 >plain.txt
paste grain.txt plain.txt | awk '$1 != $2 { n += 1; sum += ($1 - $2) ^ 2 } END { print n, sqrt(sum / (n > 0 ? n : 1)) }' >found.txt
check "the grain is as strong as the photo's: $(cat found.txt)" awk '{ exit !($1 > 300 && $1 < 5000 && $2 > 6.5 && $2 < 11) }' found.txt
status 0 mix $seen $sun --object set/tent.obj --at 8,12 --scale 0.5 --voxels 4 --match-grain -q -o even.pfm
status 0 mix $seen $sun --object set/tent.obj --at 8,12 --scale 0.5 --voxels 4 -q -o plain.pfm
check "a photo without noise adds none" cmp even.pfm plain.pfm

# Another photo has other noise, so the grain of a sequence does not stand still. Its first pixel is black.
{ head -c 13 noisy.ppm; printf '\000\000\000'; tail -c 6909 noisy.ppm; } >other.ppm
cp other.ppm noisy.ppm
status 0 mix $noisy --voxels 4 --shadow-map 64 --light none --match-grain -q -o moved.ppm
tail -c 6912 moved.ppm | od -An -v -tu1 -w1 | paste - grain.txt | awk '$1 != $2 { n += 1 } END { print n }' >found.txt
check "another photo has other grain: $(cat found.txt)" test "$(cat found.txt)" -gt 300

# Several --object of the command line: the bytes of a list with the same places; the labels have the PREFIX only.
cp set/tent.obj set/other.obj
list 'out/two.pfm tent.obj 7,12 30 0.4\nout/two.pfm other.obj 16,12 -20 0.2\n'
status 0 mix $seen $sun --placements set/list.txt --labels lab/ -q
two="--object set/tent.obj --at 7,12 --object set/other.obj --at 16,12"
status 0 mix $seen $sun $two --scale 0.2 --turn 30 --scale 0.1 --turn -20 --labels two -q -o two.pfm
check "several --object are drawn as by a list" cmp two.pfm set/out/two.pfm
for file in mask.png depth.pfm normal.pfm object.png; do
    check "several --object have labels: $file" cmp two.$file lab/out/two.$file
done
check "several --object have a pose each" test "$(grep -c '"object_to_camera"' two.pose.json)" -eq 3
list 'out/two.pfm tent.obj 7,12 30 0.4\nout/two.pfm other.obj 16,12 30 0.4\n'
status 0 mix $seen $sun --placements set/list.txt -q
"$TOOL" mix $seen $sun $two --scale 0.2 --turn 30 -q -o pfm:- >same.pfm
check "one --scale and --turn hold for all, to standard output" cmp same.pfm set/out/two.pfm
check "objects of a usual size have no note" lacks "m long" err.txt
status 0 mix $seen $sun $two --scale 100 --scale 0.001 -o x.png
said "set/tent.obj: the object is 200 m long"
said "m long and fills the picture; --fit chooses its size"
said "m long and vanishes in the picture; --fit chooses its size"
rm x.png
status 2 mix $seen $two --object set/tent.obj -o x.png
said "--object and --at: 3 and 2 of them; give each object its place"
status 2 mix $seen --object set/tent.obj --at 8,12 --at 9,12 -o x.png
said "--at: 2 places, but one --object; give each place its --object"
status 2 mix $seen --object set/tent.obj --scale 1 --scale 2 -o x.png
said "--object and --scale: 1 and 2 of them; give one --scale, or each object one"
status 2 mix $seen $two --turn 1 --turn 2 --turn 3 -o x.png
said "--object and --turn: 2 and 3 of them; give one --turn, or each object one"
for extra in "--voxels 7" "--cones 19"; do
    status 2 mix $seen $two $extra -o x.png
    said "--voxels and --cones apply only to one --object; leave them out"
done
for extra in "--show delta" "--stats x.json" "--roughness 0.2" "--frames set/list.txt" "--placements set/list.txt"; do
    status 2 mix $seen $two -o x.png $extra
done
status 2 mix $seen $two --object set/tent.obj --at 24,3 -o x.png
said "--at 24,3: the photo has 24 x 24 pixels"
status 2 mix $seen $two --object set/tent.obj --at world --fit -o x.png
status 1 mix $seen $two --object nowhere.obj --at 8,12 -o x.png
status 1 mix $seen $two -o set/tent.obj/x.png
many=; for i in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17; do many="$many --object set/tent.obj --at 8,12"; done
status 2 mix $seen $many -o x.png
absent x.png

# A label never replaces the picture.
status 1 mix $seen $sun --object set/tent.obj --at 8,12 --voxels 4 --labels lone -q -o lone.mask.png
said "--labels would write lone.mask.png a second time"
check "and nothing is written" none lone.*
finish
