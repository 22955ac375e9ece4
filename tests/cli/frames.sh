# frames.sh: mix --frames: sequences, and frames that are left out.
. tests/cli/common.sh

photo
{ printf 'Pf\n19 13\n-1.0\n'; head -c 988 /dev/zero; } >far.pfm

# A sequence: unusable frames are reported and left out, and do not affect the other frames.
leaves_out() { # WANTED ARGUMENT...: checks for WANTED such lines, and one line with the total
    wanted=$1
    shift
    "$TOOL" "$@" >out.txt 2>err.txt
    got=$?
    check "lambent $*: exit status $got, not 1" test $got -eq 1
    check "lambent $*: each frame that is left out is said" test "$(grep -c 'frame [0-9]* is left out: ' err.txt)" = "$wanted"
    check "lambent $*: and all together" grep -q ": $wanted of [0-9]* frames are left out, the first because " err.txt
}
mkdir -p frames
pose='"camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]'
for i in 0 1 2 3 4; do
    cp photo.pfm "frames/f$i.color.pfm"
    cp wall.pfm "frames/f$i.depth.pfm"
    printf '{"fx": 30, "fy": 30, "cx": 11.5, "cy": 11.5, "depth_unit_mm": 1000, %s}' "$pose" >"frames/f$i.json"
done
printf '{"fx": 30, "fy": 30, "cx": 11.5, "cy": 11.5, "depth_unit_mm": 1000, %s}' "$(echo "$pose" | sed 's/\[1,0,0,0\]/[3,0,0,0]/')" >frames/f1.json
cp far.pfm frames/f2.depth.pfm
rm frames/f3.color.pfm
printf 'f0\nf1\nf2\nf3\nf4\n' >frames/frames.txt
leaves_out 3 mix --frames frames $tent -o frames/o_%02d.pfm
said "frame 1 is left out: "
said "is no rotation and place"
said "frame 2 is left out: "
said "frame 3 is left out: "
check "frames left out are not there" sh -c '! ls "$1"/o_01* "$1"/o_02* "$1"/o_03* 2>/dev/null | grep -q .' sh frames
check "of one place all frames are the same" cmp frames/o_00.pfm frames/o_04.pfm
check "a frame has the object" differ photo.pfm frames/o_00.pfm
# With a still camera, a surface in front of the object for two frames hides the object; new photos change the light.
{ printf 'Pf\n24 24\n-1.0\n'; repeated 576 "$one"; } >frames/near.depth.pfm
{ printf 'PF\n24 24\n-1.0\n'; repeated 1728 '\000\000\200\076'; } >frames/other.color.pfm
cp photo.pfm frames/near.color.pfm && cp wall.pfm frames/other.depth.pfm
cp frames/f0.json frames/near.json && cp frames/f0.json frames/other.json
printf 'f0\nnear\nnear\n' >frames/near.txt && printf 'f0\nother\n' >frames/other.txt
status 0 mix --frames frames/near.txt $tent -o frames/n_%02d.pfm
check "one frame is not believed" cmp frames/o_00.pfm frames/n_01.pfm
check "two are" differ frames/o_00.pfm frames/n_02.pfm
status 0 mix --frames frames/other.txt $tent -o frames/p_%02d.pfm
check "each frame has its own photo" differ frames/o_00.pfm frames/p_01.pfm
# The twelve bytes of a pixel in the middle of the object: a photo of half the brightness changes the light.
on_object() { dd if="$1" bs=1 skip=3278 count=12 2>/dev/null | od -An -tx1; }
check "a photo of another brightness has its own light" test "$(on_object frames/o_00.pfm)" != "$(on_object frames/p_01.pfm)"
printf 'f0\nf4\n' >frames/two.txt
status 0 mix --frames frames/two.txt $tent --threads 3 --backend scalar -o frames/t_%02d.pfm
check "threads, backends and frames left out change no byte" cmp frames/o_04.pfm frames/t_01.pfm
# A moving camera: a shorter list gives the same bytes, for any number of threads, and a frame of another size is
# skipped.
for i in 5 6 7; do
    cp photo.pfm "frames/f$i.color.pfm" && cp wall.pfm "frames/f$i.depth.pfm"
    sed "s/\[\[1,0,0,0\]/[[1,0,0,0.0$i]/" frames/f0.json >"frames/f$i.json"
done
{ printf 'PF\n2 1\n-1.0\n'; repeated 6 '\000\000\200\076'; } >frames/f8.color.pfm
{ printf 'Pf\n2 1\n-1.0\n\000\000\200\077\000\000\300\177'; } >frames/f8.depth.pfm # 1 m, and no number
cp frames/f0.json frames/f8.json
printf 'f0\nf5\nf6\nf8\nf7\n' >frames/moves.txt && printf 'f0\nf5\nf6\n' >frames/begins.txt
leaves_out 1 mix --frames frames/moves.txt $tent --threads 1 -o frames/m_%02d.pfm
said "frame 3 is left out: frames/f8: 2 x 1 pixels, and the first frame has 24 x 24; frames of a sequence have one size"
status 0 mix --frames frames/begins.txt $tent --threads 3 --backend scalar -o frames/g_%02d.pfm
for i in 0 1 2; do
    check "moving frame $i is the same by threads, backends and what follows" cmp "frames/m_0$i.pfm" "frames/g_0$i.pfm"
done
check "the object moves in the picture" differ frames/m_00.pfm frames/m_02.pfm
check "a frame of another size is not drawn" test ! -e frames/m_03.pfm
check "and the next one is" test -s frames/m_04.pfm
# A camera that trembles by a micrometre sees the same in all frames, so the world gathers no new cells. The light is
# given, because shadows of a guessed light from all the sky are recomputed for each frame.
status 0 render demo --eye 0.5,1.25,2.5 --target 0.5,1,-1 --size 40x30 --quality draft -o frames/h.color.pfm
status 0 render demo --eye 0.5,1.25,2.5 --target 0.5,1,-1 --size 40x30 --show depth -o frames/h.depth.pfm
for i in 00 01 02 03; do
    ln -f frames/h.color.pfm "frames/h$i.color.pfm" && ln -f frames/h.depth.pfm "frames/h$i.depth.pfm"
    printf '{"fx": 36.2, "fy": 36.2, "cx": 19.5, "cy": 14.5, "depth_unit_mm": 1000, "camera_to_world": [[1,0,0,%s],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}' \
        "$([ $((1$i % 2)) = 0 ] && echo 0 || echo 0.000001)" >"frames/h$i.json"
    echo "h$i"
done >frames/tremble.txt
status 0 mix --frames frames/tremble.txt --object tent.obj --fit --voxels 4 --light sun:0,0,0:0.630,0.774,-0.063:1.171,0.862,0.543:35 \
    -o frames/h_%02d.pfm
check "a camera that trembles changes nothing" sh -c '"$1" compare "$2" "$3" | grep -q "rmse 0\.000[0-4]"' sh "$TOOL" frames/h_01.pfm frames/h_03.pfm
# A unit of depth must be valid. --depth-scale does not hide an invalid one.
for unit in 0 -0 -1 1e-7 1e7 1e300 '"1"' null '[1]'; do
    sed "s/\"depth_unit_mm\": 1000/\"depth_unit_mm\": $unit/" frames/f0.json >frames/unit.json
    cp photo.pfm frames/unit.color.pfm && cp wall.pfm frames/unit.depth.pfm
    status 1 mix --frame frames/unit $tent -o frames/bad.pfm
    said "frames/unit.json: depth_unit_mm: "
    status 1 mix --frame frames/unit --depth-scale 1 $tent -o frames/bad.pfm
done
# A prefix may contain any bytes: blanks inside and around it, #, quotes, bytes that are not UTF-8, and line breaks if
# the list has zero bytes. A path may have any length that the system allows.
long=frames
while [ ${#long} -lt 900 ]; do long=$long/a_folder_with_a_name_of_some_length_to_come_over_what_was_there_before; done
mkdir -p "$long/two words"
i=0
for prefix in 'two words/f' 'a  b' ' before' 'behind ' '#x' 'x#y z' "q'u\"o" 'back\' "$(printf 'b\377\001')" 'f # g'; do
    for part in color.pfm depth.pfm json; do cp "frames/f0.$part" "$long/$prefix.$part"; done
    case $prefix in '#'*) printf './%s\n' "$prefix" ;; *) printf '%s\n' "$prefix" ;; esac
    i=$((i + 1))
done >"$long/frames.txt"
status 0 mix --frames "$long" $tent -q -o frames/any_%02d.pfm
status 0 mix --frames "$long/frames.txt" $tent -q -o frames/any_%02d.pfm
check "all prefixes are read" cmp frames/o_00.pfm frames/any_09.pfm
two=$(printf 'line\nbreak')
for part in color.pfm depth.pfm json; do cp "frames/f0.$part" "$long/$two.$part"; done
printf 'two words/f\000%s\000' "$two" >"$long/zero.txt"
status 0 mix --frames "$long/zero.txt" $tent -q -o frames/zero_%02d.pfm
check "a list with bytes of 0" cmp frames/o_00.pfm frames/zero_01.pfm
# Photos may be PAM, as README's program writes them; the photo is 24 x 24 pixels of code 188.
mkdir -p frames/pam
{ printf 'P7\nWIDTH 24\nHEIGHT 24\nDEPTH 4\nMAXVAL 255\nTUPLTYPE RGB_ALPHA\nENDHDR\n'; repeated 576 '\274\274\274\377'; } >frames/pam/f.color.pam
cp frames/f0.json frames/pam/f.json && cp wall.pfm frames/pam/f.depth.pfm
echo f >frames/pam/list.txt
status 0 mix --frame frames/pam/f $tent -q -o frames/pam_one.pfm
status 0 mix --frames frames/pam/list.txt $tent -q -o frames/pam_%02d.pfm
check "a sequence of PAM photos" cmp frames/pam_one.pfm frames/pam_00.pfm
printf '#x\000two words/f\000' >"$long/hash.txt"
status 0 mix --frames "$long/hash.txt" $tent -q -o frames/hash_%02d.pfm
check "has no comments" cmp frames/o_00.pfm frames/hash_01.pfm
printf 'two words/f\r\nbehind \r\n' >"$long/returns.txt"
status 0 mix --frames "$long/returns.txt" $tent -q -o frames/return_%02d.pfm
check "a blank before a carriage return may be the prefix's" cmp frames/o_00.pfm frames/return_01.pfm
printf '  f0 \r\n\n  # none\n\tf4\t\n' >frames/blanks.txt
status 0 mix --frames frames/blanks.txt $tent -q -o frames/blank_%02d.pfm
check "blanks around a prefix are none of it" cmp frames/o_00.pfm frames/blank_01.pfm
for part in color depth; do cp "frames/f0.$part.pfm" "$long/two words/a  b # $part"; done
printf '1 two words/a  b # color\n' >"$long/rgb.txt" && printf '1 two words/a  b # depth\n' >"$long/depth.txt"
printf '1 0 0 0 0 0 0 1\n' >"$long/groundtruth.txt"
status 0 mix --frames "$long" $tent --intrinsics 30,30,11.5,11.5 --depth-scale 1 -q -o frames/blank_%02d.pfm
check "and TUM's lists have names with blanks" cmp frames/o_00.pfm frames/blank_00.pfm
# No frame overwrites a photo of the list, even one that was already read.
for i in 0 1; do
    for part in color.pfm depth.pfm json; do cp "frames/f0.$part" "frames/r$i.$part"; done
done
printf 'r1\nr0\n' >frames/own.txt
status 2 mix --frames frames/own.txt $tent -o frames/r%01d.color.pfm
for i in 0 1; do check "photo $i of the list stays" cmp frames/f0.color.pfm "frames/r$i.color.pfm"; done
status 2 mix --frames frames/own.txt $tent --stats bad.json -o frames/bad_%02d.pfm
# An error in the command line that shows in the first photo would show in every photo, so it is bad usage.
status 2 mix --frames frames/begins.txt --object tent.obj --at 5000,10 -o frames/bad_%02d.pfm
said "--at 5000,10: the photo has 24 x 24 pixels"
: >frames/empty.txt
status 1 mix --frames frames/empty.txt $tent -o frames/bad_%02d.pfm
said "lists no frame"
awk 'BEGIN { print "f0"; for (i = 1; i < 10000; ++i) print "gone" }' >frames/long.txt
status_of_long() { "$TOOL" mix --frames frames/long.txt $tent -o frames/long_%04d.pfm >out.txt 2>err.txt; echo $?; }
check "a list of nothing but its first frame: exit status 1" test "$(status_of_long)" = 1
check "of frames in a row eight are said" test "$(grep -c 'frame [0-9]* is left out: ' err.txt)" = 8
said "frames 9 to 9999 are left out, too"
said ": 9999 of 10000 frames are left out, the first because "
check "and the first one is there" cmp frames/m_00.pfm frames/long_0000.pfm
printf '# time name\n1.00 f0.color.pfm\n1.03 f4.color.pfm\n' >frames/rgb.txt
printf '1.01 f0.depth.pfm\n1.04 f4.depth.pfm\n' >frames/depth.txt
printf '1.00 0 0 0 0 0 0 1\n1.03 0 0 0 0 0 0 1\n' >frames/groundtruth.txt
status 0 mix --frames frames $tent --intrinsics 30,30,11.5,11.5 --depth-scale 1 -o frames/tum_%02d.pfm
check "TUM's lists give the same frame" cmp frames/o_00.pfm frames/tum_01.pfm
# Photos without a depth or a pose of the same time are skipped, and so are malformed lines; both are counted.
printf '1.00 f0.color.pfm\n1.02\nlate f4.color.pfm\n1.03 f4.color.pfm\n2.00 f4.color.pfm\n3.00 f0.color.pfm\n' >frames/rgb.txt
printf '1.01 f0.depth.pfm\n1.04 f4.depth.pfm\n3.00 f0.depth.pfm\n' >frames/depth.txt
printf '1.00 0 0 0 0 0 0 1\n1.03 0 0 0 0 0 0\n1.03 0 0 0 0 0 0 1\n' >frames/groundtruth.txt
status 0 mix --frames frames $tent --intrinsics 30,30,11.5,11.5 --depth-scale 1 -o frames/tom_%02d.pfm
said "photos without a depth within 0.02 s: 1; without a pose: 1;"
said "lines of its lists that are no time and name, or pose: 3;"
check "they change no other frame" cmp frames/tum_01.pfm frames/tom_01.pfm
# A rotation of length 0 is refused.
printf '1.00 0 0 0 0 0 0 1\n1.03 0 0 0 0 0 0 0\n' >frames/groundtruth.txt
leaves_out 1 mix --frames frames $tent --intrinsics 30,30,11.5,11.5 --depth-scale 1 -o frames/ter_%02d.pfm
said "frame 1 is left out: frames/f4.color.pfm: its pose is no rotation and place"
check "nor does a pose that is none" cmp frames/tum_00.pfm frames/ter_00.pfm
# Lists may be in any order and of any length. Of two depths at the same distance in time, or at the same time,
# the earlier line is used.
printf '1.00 0 0 0 0 0 0 1\n' >frames/groundtruth.txt
awk 'BEGIN { for (i = 70000; i > 1; --i) print i, "f4.color.pfm"; print "1.00 f0.color.pfm"; print "nan f0.color.pfm" }' >frames/rgb.txt
tie=0
for times in '0.9921875 1.0078125' '1.0078125 0.9921875' '1 1' '0.9921875 0.9921875' '1.0078125 1.0078125'; do
    printf '5 gone\n%s f0.depth.pfm\n%s near.depth.pfm\n-5 gone\n' $times >frames/depth.txt
    status 0 mix --frames frames $tent --intrinsics 30,30,11.5,11.5 --depth-scale 1 -o "frames/tie${tie}_%02d.pfm"
    said "photos without a depth within 0.02 s: 69998; without a pose: 1;"
    said "lines of its lists that are no time and name, or pose: 1;"
    check "depths at $times s: the earlier line" cmp frames/o_00.pfm "frames/tie${tie}_00.pfm"
    tie=$((tie + 1))
done
printf '1.00 f0.color.pfm\n1.02\nlate f4.color.pfm\n1.03 f4.color.pfm\n2.00 f4.color.pfm\n3.00 f0.color.pfm\n' >frames/rgb.txt
printf '1.00 0 0 0 0 0 0 1\n1.03 0 0 0 0 0 0 0\n' >frames/groundtruth.txt
printf '9.00 f0.depth.pfm\n' >frames/depth.txt
status 1 mix --frames frames $tent --intrinsics 30,30,11.5,11.5 -o frames/bad_%02d.pfm
said "lists no frame: photos without a depth within 0.02 s: 4; without a pose: 0"
printf '1.01 f0.depth.pfm\n1.04 f4.depth.pfm\n' >frames/depth.txt
status 1 mix --frames frames $tent -q -o frames/bad_%02d.pfm
said "2 of 2 frames are left out, the first because no camera given"
# Frames with a depth that has no valid pixel or no numbers, with a truncated photo, or with photo and depth of
# different sizes are each reported once. Later frames are the same as in a list without them.
{ printf 'Pf\n24 24\n-1.0\n'; repeated 576 '\000\000\300\177'; } >frames/x0.depth.pfm
for i in 0 1 2 3; do cp frames/f0.json "frames/x$i.json" && cp photo.pfm "frames/x$i.color.pfm"; done
head -c 500 photo.pfm >frames/x1.color.pfm && cp wall.pfm frames/x1.depth.pfm
cp frames/f8.depth.pfm frames/x2.depth.pfm
printf '{"fx": 30, "fy": 30, "cx": 11.5, "cy": 11.5, "depth_unit_mm": 1000}' >frames/x3.json && cp wall.pfm frames/x3.depth.pfm
printf 'f0\nx1\nf5\nx2\nx3\ngone\nf6\n' >frames/odd.txt
leaves_out 4 mix --frames frames/odd.txt $tent -o frames/odd_%02d.pfm
for i in 0 1 2; do check "odd frames change frame $i of the others by no byte" cmp "frames/odd_0$((i * (i + 3) / 2 + (i == 2))).pfm" "frames/g_0$i.pfm"; done
printf 'f0\nx0\nx0\n' >frames/nan.txt
status 0 mix --frames frames/nan.txt $tent -o frames/nan_%02d.pfm
for i in 1 2; do check "what is not measured again stays: $i" cmp frames/o_00.pfm "frames/nan_0$i.pfm"; done
printf 'x0\nf0\n' >frames/blind.txt
leaves_out 1 mix --frames frames/blind.txt $tent -o frames/blind_%02d.pfm
said "frame 0 is left out: "
check "a list whose first frame is blind begins with the next" cmp frames/o_00.pfm frames/blind_01.pfm
# A wall at 1.5 m has a hole at the object's place, so the frame is left out, and its measurements are dropped too.
{
    printf 'Pf\n24 24\n-1.0\n'
    i=0
    while [ $i -lt 576 ]; do
        if [ $((i % 24)) -lt 22 ]; then printf '\000\000\300\177'; else printf '\000\000\300\077'; fi
        i=$((i + 1))
    done
} >frames/hole.depth.pfm
cp photo.pfm frames/hole.color.pfm && cp frames/f0.json frames/hole.json
printf 'hole\nf0\n' >frames/hole.txt
leaves_out 1 mix --frames frames/hole.txt $tent -o frames/hole_%02d.pfm
said "frame 0 is left out: --at 8,12: neither a plane nor any depth there"
check "what a frame measured that is left out changes no other" cmp frames/o_00.pfm frames/hole_01.pfm
# If a name cannot be read for any reason, only that frame is affected.
ln -s loop.color.png frames/loop.color.png && cp frames/f0.json frames/loop.json && cp wall.pfm frames/loop.depth.pfm
printf 'f0\nloop\nf5\n' >frames/loop.txt
leaves_out 1 mix --frames frames/loop.txt $tent -o frames/loop_%02d.pfm
said "frame 1 is left out: "
check "a link to itself ends no sequence" cmp frames/g_01.pfm frames/loop_02.pfm
# Linear photos: half of this one equals the first photo, and half is very bright; the codes of that half are kept.
{ printf 'PF\n24 24\n-1.0\n'; tail -c 3456 photo.pfm; repeated 864 '\000\000\000\101'; } >frames/glow.color.pfm
cp wall.pfm frames/glow.depth.pfm && cp frames/f0.json frames/glow.json
printf 'f0\nglow\n' >frames/glow.txt
status 0 mix --frames frames/glow.txt -o frames/glow_%02d.ppm
for i in 0 1; do tail -c 864 "frames/glow_0$i.ppm" >"frames/still_$i"; done
check "the first frame's exposure stays" cmp frames/still_0 frames/still_1
check "the other half shines" differ frames/glow_00.ppm frames/glow_01.ppm
status 2 mix --frames frames/two.txt --object tent.obj --fit --scale 2 -o frames/bad_%02d.pfm
status 2 mix --frames frames/two.txt --object tent.obj --on wall --at 3,4 -o frames/bad_%02d.pfm
status 2 mix --frames frames/two.txt --show object -o frames/bad_%02d.pfm
check "what is refused draws nothing" sh -c '! ls "$1"/bad_* 2>/dev/null | grep -q .' sh frames
status 2 mix --frames frames $tent -o bad.png
status 2 mix --frames frames --photo photo.pfm $tent -o bad%02d.png
status 1 mix --frames nowhere $tent -o bad%02d.png
mkdir -p frames/none
status 1 mix --frames frames/none $tent -o bad%02d.png
said "frames/none: a folder with neither frames.txt nor TUM's rgb.txt"

# --missing-depth estimate: depth comes from earlier frames, here of the same wall, 1 m to the side.
mkdir -p gaps
for i in 0 1 2; do cp photo.pfm gaps/g$i.color.pfm; done
cp wall.pfm gaps/g0.depth.pfm && cp wall.pfm gaps/whole.depth.pfm && cp photo.pfm gaps/whole.color.pfm
for i in 0 1 2 whole; do
    printf '{"fx": 30, "fy": 30, "cx": 11.5, "cy": 11.5, "depth_unit_mm": 1000, "camera_to_world": [[1,0,0,%s],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}' \
        "$(case $i in 0) echo 0 ;; *) echo 0.2 ;; esac)" >gaps/g$i.json
done
mv gaps/gwhole.json gaps/whole.json
printf 'g0\ng1\ng2\n' >gaps/frames.txt && printf 'g0\nwhole\nwhole\n' >gaps/whole.txt
status 1 mix --frames gaps $tent -q -o gaps/none_%02d.pfm
check "without depth a frame is left out" test -s gaps/none_00.pfm -a ! -e gaps/none_01.pfm
status 0 mix --frames gaps --missing-depth estimate $tent --light none -o gaps/o_%02d.pfm
said "frames without depth: 2, the first is 1; it is estimated from earlier frames and their planes"
status 0 mix --frames gaps/whole.txt $tent --light none -q -o gaps/w_%02d.pfm
check "the estimate is near the measured depth" sh -c '"$1" compare gaps/o_01.pfm gaps/w_01.pfm | awk "{ for (i = 1; i < NF; ++i) if (\$i == \"rmse\") exit !(\$(i + 1) < 0.02) }"' sh "$TOOL"
check "no frame is left out" test -s gaps/o_02.pfm
printf 'g1\ng0\n' >gaps/frames.txt
status 1 mix --frames gaps --missing-depth estimate $tent -q -o gaps/late_%02d.pfm
said "has no depth, and no frame before it has any"
check "only the frames before the first depth are left out" test -s gaps/late_01.pfm
printf '1 photo.pfm\n2 photo.pfm\n' >gaps/rgb.txt && cp photo.pfm wall.pfm gaps && printf '1 wall.pfm\n' >gaps/depth.txt
printf '1 0 0 0 0 0 0 1\n2 0.2 0 0 0 0 0 1\n' >gaps/groundtruth.txt
status 0 mix --frames gaps --missing-depth estimate --intrinsics 30,30,11.5,11.5 --depth-scale 1 $tent --light none -q -o gaps/t_%02d.pfm
check "nor of TUM's" test -s gaps/t_01.pfm
status 2 mix --missing-depth estimate $seen $tent -o bad.pfm

finish
