# render.sh: render's formats, outputs, methods and notes; the same bytes for any threads; two eyes.
. tests/cli/common.sh

# --glossy needs glTF, because only glTF has lobes.
status 2 render demo $small --glossy -o glossy.png

# Writes each format by file extension, complete.
for extension in png ppm pfm hdr; do
    status 0 render demo $small -o "demo.$extension"
done
# begins FILE OCTAL: checks the first four bytes.
begins() { check "$1 begins with $2" test "$(head -c 4 "$1" | od -An -to1 | tr -d ' \n')" = "$2"; }
begins demo.png 211120116107
begins demo.ppm 120066012063
begins demo.pfm 120106012063
begins demo.hdr 043077122101
check "demo.ppm is 32x24" test "$(wc -c <demo.ppm)" -eq $((32 * 24 * 3 + 13))
check "demo.pfm is 32x24" test "$(sed -n 2p demo.pfm)" = "32 24"

# Outputs of --show, and methods.
for show in direct indirect irradiance depth normal albedo wireframe; do
    status 0 render demo $small --show $show -o "$show.pfm"
done
for show in occlusion eye-distance light-distance points groups; do
    for extension in png pfm hdr; do
        status 0 render demo $small --show $show -o "$show.$extension"
    done
done
check "what the eye sees has the picture's size" test "$(sed -n 2p eye-distance.pfm)" = "32 24"
for show in light-distance points groups; do
    check "$show has the map's size" test "$(sed -n 2p "$show.pfm")" = "64 64"
done
status 0 render demo $small --show light-distance --light point:0,1,0:0,-1,0:1,1,1 --light sun:0,0,0:0,-1,0:1,1,1 -o two.pfm
check "a row of faces a light" test "$(sed -n 2p two.pfm)" = "384 128"
status 0 render demo $small --show eye-distance -o eye-distance.png
check "distances say their range" grep -q '^lambent: from [0-9.]* m (white) to [0-9.]* m (dark grey)$' err.txt
for grouping in greedy zones; do
    status 0 render demo $small --group method=$grouping -o "$grouping.pfm"
done
for occlusion in none view view-world; do
    status 0 render demo $small --occlusion $occlusion -o "$occlusion.pfm"
done
status 0 render demo $small --stats stats.json -o again.pfm
check "the same command writes the same bytes" cmp demo.pfm again.pfm
check "stats are JSON" grep -q '^{' stats.json
check "light by cuts has no first points to count" grep -q '"first_points": null, "discs": null, "groups": null' stats.json

# --group misfits=drop reports the lost flux; the others lose nothing and print nothing.
status 0 render demo $small --group groups=40 --group misfits=drop -o strict.pfm
check "strict zones say their loss" grep -q '^lambent: note: --group misfits=drop lost [1-9][0-9.]* % of the light' err.txt
status 0 render demo $small --group groups=40 --group misfits=keep -o kept.pfm
check "kept misfits lose nothing" lacks lost err.txt

# Too few groups are reported; zones, neighbours and discs follow the options.
status 0 render demo $small --group groups=7 -o few.pfm
check "regrouping is said" grep -qE '^lambent: note: discs were grouped again [1-9][0-9]* times?, .*: [1-7]$' err.txt
status 0 render demo $small --group groups=400 -o plain.pfm
for option in "--group zones=20" "--group neighbour=0.6" "--group neighbour-blocks=3" "--group disc-radius=2"; do
    status 0 render demo $small --group groups=400 $option -o other.pfm
    check "$option changes nothing" differ other.pfm plain.pfm
done
# Options of first points: fewer discs, another neighbourhood, thresholds.
for option in "--group thin=10" "--group neighbourhood=hemisphere" "--group neighbour=0.25" "--group neighbour=0.5" "--group neighbour=1" "--group centre=disc"; do
    status 0 render demo $small $option -o option.pfm --stats option.json
    check "$option changes the picture" differ demo.pfm option.pfm
done

status 0 render demo $small --group thin=10 -o option.pfm --stats option.json
status 0 render demo $small --group method=zones -o option2.pfm --stats option2.json
check "--group thin=10 leaves few discs" test $((4 * $(count option.json discs))) -lt "$(count option2.json discs)"
# The picture does not depend on the number of threads or the backend.
for option in "--threads 1" "--threads 3" "--backend scalar"; do
    check "render demo $option" "$TOOL" render demo $small $option -o way.ppm
    cp way.ppm "way$((ways = ways + 1)).ppm"
done
check "threads change the picture" cmp way1.ppm way2.ppm
check "a backend changes the picture" cmp way1.ppm way3.ppm

# Two eyes: each half equals a single picture from that eye, and the light is computed once.
at() { echo "--eye $1,1.25,2.5 --target $1,1,-1 --fov 50"; }
rows() { tail -c +"$(($(head -n 3 "$1" | wc -c) + 1))" "$1" | od -An -v -tx1 | tr -d ' \n' | fold -w $((32 * 3 * 4 * 2)); }
eyes="$small --group method=zones"
status 0 render demo $eyes $(at 0.5) --stereo 0.25 -o both.pfm --stats both.json
status 0 render demo $eyes $(at 0.375) -o left.pfm --stats left.json
status 0 render demo $eyes $(at 0.625) -o right.pfm
check "two eyes side by side" test "$(sed -n 2p both.pfm)" = "64 24"
rows both.pfm >both.txt
(rows left.pfm; echo) >left.txt
(rows right.pfm; echo) >right.txt
(sed -n 'p;n' both.txt; echo) | sed '/^$/d' >left_half.txt
(sed -n 'n;p' both.txt; echo) | sed '/^$/d' >right_half.txt
check "24 rows of an eye" test "$(grep -c . left_half.txt)" -eq 24
check "the left half is the left eye's picture" cmp left.txt left_half.txt
check "the right half is the right eye's picture" cmp right.txt right_half.txt
for what in first_points discs groups; do
    check "two eyes: $what counted once" test "$(count both.json $what)" -gt 0 \
        -a "$(count both.json $what)" -eq "$(count left.json $what)"
done
check "two eyes: shadow map once, view twice" test $((2 * $(count both.json triangles_read))) -eq $((3 * $(count left.json triangles_read)))
check "two eyes: two views" test "$(count both.json views)" -eq 2
for show in depth eye-distance normal albedo wireframe occlusion direct; do
    status 0 render demo $small --stereo 0.1 --show $show -o both.png
done
# Undrawable triangles count once, however many views and faces of a shadow map draw them.
printf 'v -1 0 1\nv 1 0 1\nv 0 0 -1\nv 3e6 0 0\nv 0 3e6 0\nf 1 2 3\nf 1 2 4\nf 1 3 5\n' >absurd.obj
status 0 render absurd.obj $small --eye 0,2,2 --target 0,0,0 --light point:0,1,0:0,-1,0:1,1,1 --stereo 0.1 -o absurd.png
said "note: 2 of 3 triangles dropped: vertices not finite or over 2^20 m away"
status 0 play absurd.obj $small --eye 0,2,2 --target 0,0,0 --light point:0,1,0:0,-1,0:1,1,1 --frames 2 -o absurd%01d.png
said "note: 2 of 3 triangles dropped: vertices not finite or over 2^20 m away"
# An empty file of any kind.
for extension in glb gltf obj ply lmp; do
    : >empty.$extension
    status 1 render empty.$extension -o bad.png
    said "empty.$extension: the file is empty (0 bytes); export or copy it again"
done
: >empty.png
status 1 compare empty.png demo.png
said "empty.png: the file is empty (0 bytes); export or copy it again"
: >empty.lmt
status 1 render demo --transfer empty.lmt -o bad.png
said "empty.lmt: the file is empty (0 bytes); export or copy it again"
# Edges are white on black, without other colours, and both occur.
status 0 render demo --size 64x48 --wireframe -o wire.ppm
status 0 render demo --size 64x48 --show wireframe -o shown.ppm
check "--wireframe is --show wireframe" cmp wire.ppm shown.ppm
check "edges are white, all else is black" test \
    "$(tail -c 9216 wire.ppm | od -An -v -tu1 -w3 | sort | uniq -c | awk '{ print ($1 > 300) $2 $3 $4 }' | xargs)" = \
    "1000 1255255255"
status 2 render demo $small --wireframe --samples 4 -o bad.png
check "edges have no samples" grep -q "wireframe takes one sample" err.txt

# A view of nothing is noted.
box
away="--eye 0,0,9 --target 0,0,20"
for show in full direct depth; do
    status 0 render box.obj $few --light sun:0,0,0:0,-1,0:2,2,2 --show $show $away -o away.pfm
    said "note: no surface is in the picture; --eye and --target set the view"
    status 0 render box.obj $few --light sun:0,0,0:0,-1,0:2,2,2 --show $show -o there.pfm
    check "a view of the box has no such note" lacks "no surface" err.txt
done
status 0 render box.obj $few --eye 0,0,9 --target 0,9,20 -o away.pfm
said "note: no surface is in the picture"
# One of four samples meets this triangle, and only the left eye sees the other one.
printf 'v -.199 -.06 0\nv -.079 -.06 0\nv -.139 .06 0\nf 1 2 3\n' >speck.obj
printf 'v -2.2 -.3 0\nv -2.1 -.3 0\nv -2.1 .3 0\nf 1 2 3\n' >left.obj
seen_at="--light sun:0,0,0:0,-.3,-1:2,2,2 --eye 0,0,4 --target 0,0,0"
status 0 render speck.obj $seen_at --size 16x12 --samples 4 -o speck.pfm
check "a surface in one sample is seen" lacks "no surface" err.txt
status 0 render left.obj $seen_at --size 64x48 --stereo 0.3 -o left.pfm
check "a surface in one eye's view is seen" lacks "no surface" err.txt
status 0 render box.obj $few --show light-distance $away --light sun:0,0,0:0,-1,0:2,2,2 -o away.pfm
check "a map has no such note" lacks "no surface" err.txt

check "nothing is left behind" none bad* nowhere* *tmp*

finish
