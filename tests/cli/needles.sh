# needles.sh: triangles that all cross in one point: checks that visibility tests are bounded, and a note reports it.
. tests/cli/common.sh

crossing='function crossing(n,  i, a, z, s) { # needles through the middle of a room, in directions that fill a sphere
         for (i = 0; i < n; ++i) {
             a = 2.399963 * i; z = 1 - (i + 0.5) / n; s = sqrt(1 - z * z)
             x = 1.4 * s * cos(a); y = 1.4 * s * sin(a); z = 1.4 * z
             printf "v %.5f %.5f %.5f\nv %.5f %.5f %.5f\nv %.5f %.5f %.5f\nf -3 -2 -1\n", -x, 1.5 - y, -z,
                 x + 0.002, 1.5 + y, z, x - 0.002, 1.5 + y, z
         } }
     BEGIN { printf "v -2 0 2\nv 2 0 2\nv 2 0 -2\nv -2 0 -2\nv -2 3 -2\nv 2 3 -2\nf 1 2 3 4\nf 4 3 6 5\n"
             crossing(many) }'
awk -v many=12000 "$crossing" >needles.obj
view="--size 8x8 --show direct --eye 0,1.5,6 --target 0,1.5,0 --exposure 0"
status 0 render needles.obj $view --threads 1 -o one.pfm --stats needles.json
said "note: 1 of 1 tiles have coarser visibility: too many triangles cross there"
check "stats count coarse tiles" test "$(count needles.json coarse_tiles)" -eq 1
status 0 render needles.obj $view --threads 3 --backend scalar -o three.pfm
check "threads and back ends change coarse visibility" cmp one.pfm three.pfm
status 0 render needles.obj $view -q -o quiet.pfm
check "--quiet prints the note" lacks coarser err.txt
status 0 play needles.obj $view --frames 1 -o frame%01d.pfm
said "note: 1 of 1 tiles have coarser visibility: too many triangles cross there"
# The search for free space around lights is bounded too: eight lights near the crossing point.
lights=
for i in 1 2 3 4 5 6 7 8; do
    lights="$lights --light point:0,1.5$i,0:0,-1,0:9,9,9"
done
status 0 play needles.obj $view $lights --shadow-map 64 --frames 1 -o frame%01d.pfm
check "play prints no note of searches" grep -q '^lambent: note: [1-9][0-9]* searches for room to move have coarser' err.txt
# A bake is bounded too, and equal for any threads.
awk -v many=600 "$crossing" >few.obj
status 0 bake few.obj -o one.lmt --elements 64 --receivers 64 --cluster 3 --threads 1
check "bake prints no note" grep -q '^lambent: note: [1-9][0-9]* sights have coarser visibility' err.txt
status 0 bake few.obj -o three.lmt --elements 64 --receivers 64 --cluster 3 --threads 3
check "threads change coarse visibility of a bake" cmp one.lmt three.lmt
# All samples of a tile together have as many tests as its pixels' middles.
awk -v many=2000 "$crossing" >samples.obj
for n in 1 4; do
    status 0 render samples.obj --quality draft --samples $n --size 8x8 --eye 0,1.5,2 --target 0,1.5,0 --shadow-map 256 \
        --light point:0.3,2.7,0.2:0,-1,0:6,6,6 -o samples.pfm --stats samples$n.json
done
check "samples of crossing triangles take too many tests" \
    test "$((10 * $(count samples4.json segments)))" -lt "$((11 * $(count samples1.json segments)))"
status 0 render demo $small -o demo.pfm --stats demo.json
check "an ordinary scene has coarse tiles" lacks coarser err.txt
check "an ordinary scene counts tiles" test "$(count demo.json coarse_tiles)" -eq 0 -a "$(count demo.json tiles)" -gt 0
finish
