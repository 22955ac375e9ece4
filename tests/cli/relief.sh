# relief.sh: relief bake and render: views, pictures, paths, refusals.
. tests/cli/common.sh

box
pit

printf '# eye, target, degrees\n0 0 5 0 0 0 40\n\n3 2 4 0 0 0 40\n' >cameras.txt
status 0 relief bake pit.obj -o pit.lmr --simple box.obj --size 32
check "relief bake prints when the mesh is worth more" holds 'the mesh is the faster and exact: draw that' out.txt
check "relief bake tells what it saw" grep -q 'as 12, 26 views of 32 x 32, .* bytes' out.txt
check "a small model has no mesh of fewer triangles" lacks '60000 triangles' out.txt
# A wavy sheet of 65,522 triangles, which are more than those of the mesh that a relief competes with.
awk 'BEGIN { for (j = 0; j < 182; ++j) for (i = 0; i < 182; ++i) print "v", i / 91 - 1, 0.1 * sin(i / 9) * cos(j / 7), j / 91 - 1
    for (j = 0; j < 181; ++j) for (i = 0; i < 181; ++i) { a = 182 * j + i + 1; print "f", a, a + 182, a + 1; print "f", a + 1, a + 182, a + 183 } }' >sheet.obj
status 0 relief bake sheet.obj -o sheet.lmr --views 6 --size 32 --triangles 200
check "relief bake measures the relief" grep -q '^the relief  *[0-9.]*  *[0-9.]*  *[0-9.]*  *0.[0-9]*$' out.txt
check "and a mesh of 60,000 triangles" grep -q '^the model as 60000 triangles  *[0-9.]*  *[0-9.]*  *[0-9.]*  *[0-9.]*$' out.txt
check "and the model" grep -q "^the model's 65522 triangles  *[0-9.]*  *[0-9.]*  *exact  *[0-9.]*$" out.txt
check "and names the way to draw" grep -q '^the \(mesh\|relief\).* is the faster' out.txt
bit pit.lmr 3000 bit.lmr
status 1 relief render bit.lmr -o bad.png
said "bit.lmr: a damaged .lmr file"
status 1 info bit.lmr
status 0 info pit.lmr
check "info knows reliefs" grep -q '^views  *[1-9][0-9]*, with sides of 32 to 32 texels, full$' out.txt
status 0 info pit.lmr --json
check "and those as JSON" grep -q '^{.*"kind":"relief".*"shortest_side":32,.*"packed":false,"min":.*}$' out.txt
sed 's/1/0.9/g' box.obj | sed 's/^f.*//' >less.obj
grep '^f' box.obj >>less.obj
status 0 relief bake pit.obj -o less.lmr --simple less.obj --as-is --size 16
check "a simple model that is too small is told" grep -q 'sticks out of the simple one by 0.1[67]' err.txt
status 0 relief bake pit.obj -o less.lmr --simple less.obj --size 16
check "and else moved outwards" lacks 'sticks out' err.txt
# Perspective views: a world a thousand times as large gives the same picture, to the bit.
awk '/^v /{print "v", $2 * 1024, $3 * 1024, $4 * 1024; next} {print}' pit.obj >vast.obj
printf '%s\n' '-4 0 0 0 0 0 45' '4 0 0 0 0 0 45' '0 4 1 0 0 0 45' '0 -4 1 0 0 0 45' '0 0 4 0 0 0 45' '2 2 3 0 0 0 45' >views.txt
awk '{print $1 * 1024, $2 * 1024, $3 * 1024, $4, $5, $6, $7}' views.txt >vast.txt
for size in pit vast; do
    status 0 relief bake "$size.obj" --views "$(test $size = pit && echo views || echo vast).txt" --size 64 -o seen.lmr
    status 0 relief render seen.lmr --eye $(test $size = pit && echo 1.5,2,5 || echo 1536,2048,5120) --target 0,0,0 \
        --size 64x64 --show normal -o "$size-normal.pfm"
done
check "a relief of any size looks the same" cmp -s pit-normal.pfm vast-normal.pfm
# Without normals, shading is flat, as in `lambent render`: a box has one colour in front, except at the rim.
status 0 relief bake box.obj -o box.lmr --triangles 12 --size 32
status 0 relief render box.lmr --eye 0,0,5 --target 0,0,0 --size 32x32 --show normal -o box.ppm
check "a relief of a box is flat" test "$(tail -c 3072 box.ppm | od -An -v -tx1 -w3 | sort | uniq -c | sort -rn | awk 'NR == 2 { print $1 }')" -ge 300
status 2 relief render pit.lmr -o bad.png --with box.obj --compare pit.obj
status 0 relief render pit.lmr -o pit.png --eye 1.5,2,5 --target 0,0,0 --size 64x64 --compare pit.obj
check "relief render --compare shows both" grep -q 'pixels, ms  *[0-9.]*  *[0-9.]*$' out.txt
status 0 relief render pit.lmr -o pit.pfm --pick eye-ray --sampling nearest --show depth --size 40x30 --with box.obj --light point:3,3,3:0,-1,0:90,90,90
floor
for more in '' --bounce; do
    status 0 relief render pit.lmr -o "floor$more.pfm" --with floor.obj --ambient 0 --size 40x30 $more
done
check "bounced light adds some" differ floor.pfm floor--bounce.pfm
for views in 14 greedy:5 cameras.txt; do
    status 0 relief bake pit.obj -o pit.lmr --triangles 20 --size 16 --packed --views $views
    status 0 relief render pit.lmr -o pit.ppm --size 40x30 --shadow-map 0 --steps 1 --pixel-views 2 --keep 1
done
# Along a path, each picture equals a single picture with the same camera and light.
sun=sun:0,0,0:0.6,-0.64,-0.48:3,2.9,2.7
printf '# keys\n0 camera 1.5,2,5 0,0,0\n1 camera 4,1,3 0,0,0\n0 light 0,0,0 1,-1,0\n1 light 0,0,0 0.6,-0.64,-0.48\n' >keys.txt
status 0 relief render pit.lmr --path keys.txt --fps 2 --size 40x30 -o lap_%02d.pfm
check "a relief's path is drawn to its last key" sh -c 'test -s "$1/lap_02.pfm" && ! test -e "$1/lap_03.pfm"' sh .
check "a relief's pictures are told by name" grep -q 'lap_01.pfm$' out.txt
status 0 relief render pit.lmr --eye 4,1,3 --target 0,0,0 --light $sun --size 40x30 -o one.pfm
check "a relief's last picture is that of its last keys" cmp one.pfm lap_02.pfm
check "a relief moves between keys" sh -c '! cmp -s "$1/lap_00.pfm" "$1/lap_01.pfm" && ! cmp -s "$1/lap_01.pfm" "$1/lap_02.pfm"' sh .
status 0 relief render pit.lmr --path keys.txt --fps 2 --frames 2 --size 40x30 -q -o lap.pfm
check "a relief's pictures are numbered without a pattern" sh -c 'cmp "$1/lap-0001.pfm" "$1/lap_01.pfm" && ! test -e "$1/lap-0002.pfm"' sh .
status 2 relief render pit.lmr -o bad_%04d.png
said "numbers pictures of a --path, and none is given"
status 2 relief render pit.lmr --fps 3 -o bad.png
said "--frames and --fps are of a --path"
status 2 relief render pit.lmr --path keys.txt -o -
status 2 relief render pit.lmr --path keys.txt --compare pit.obj -o bad.png
status 1 relief render pit.lmr --path nowhere.txt -o bad.png
status 0 relief render pit.lmr --path keys.txt --frames 2 --size 40x30 -v -o 50%_%02d.pfm
check "the time of a path's pictures is told" grep -q 'a picture in the mean: shadow map [0-9.]* ms, triangles [0-9.]* ms, pixels [0-9.]* ms' err.txt
check "a number is found after another %" test -s 50%_01.pfm
status 1 relief render pit.lmr --path keys.txt --eye 1,2,3 --target 0,0,0 -o bad.png
said "keys.txt:2: the camera goes and looks by these keys; leave --eye and --target out"
printf '0 camera 1,2,5\n11 camera 2,2,5\n' >keys.txt
printf '0 camera 1,2,5 0,0,0\n1 camera 2,2,5 0,0,0\n' >looks.txt
status 0 relief render pit.lmr --path keys.txt --eye 1,2,3 --target 0,0,0 --frames 1 --size 16x16 -o looks.pfm
status 1 relief render pit.lmr --path keys.txt --fps 1e5 -o bad.png
said "keys.txt: 1100001 pictures to its last key, of which 1000000 can be drawn"
# keys_refused KEYS WORDS: checks that a path that a relief cannot follow is refused.
keys_refused() {
    printf "$1" >keys.txt
    status 1 relief render pit.lmr --path keys.txt --fps 2 -o bad.png
    said "$2"
}
keys_refused '0 camera 1,2,5 0,0,0\n1 camera 0,9,0 0,0,0\n' "at frame 2 the camera looks along what is up"
keys_refused '0 object:1 0,0,0\n' "keys.txt:1: a relief has a camera and a light"
keys_refused '0 light 0,0,0\n' "keys.txt:1: the light is a sun"
keys_refused '0 camera 0,9,0 0,0,0\n' "at frame 0 the camera looks along what is up"
printf '0 camera 0,0,9 0,0,0\n1 camera 0,0,-9 0,0,0\n2 camera 0,0,9 0,0,0\n' >lap_00.pfm
status 2 relief render pit.lmr --path lap_00.pfm -o lap_%02d.pfm
said "lap_00.pfm: cannot be written: it is read"
status 1 relief bake nowhere.obj -o bad.lmr
sed 's/\([0-9.]\{1,\}\)/\1e-10/g; /^[^v]/s/e-10//g' pit.obj >speck.obj
status 1 relief bake speck.obj -o bad.lmr --simple speck.obj --as-is --size 16
status 1 relief bake pit.obj -o bad.lmr --views nowhere.txt
status 1 relief render box.obj -o bad.png
check "who failed is told" grep -q '^lambent relief render: ' err.txt
status 1 relief render pit.lmr -o bad.png --compare nowhere.obj
status 2 relief
status 2 relief bake pit.obj
status 2 relief bake pit.obj -o bad.lmr --size 7
status 2 relief bake pit.obj -o bad.lmr --views 65
status 2 relief bake pit.obj -o bad.lmr --as-is
status 2 relief render pit.lmr
status 2 relief render pit.lmr -o bad.png --pick q
status 2 relief render pit.lmr -o bad.png --eye 1,2,3
status 2 relief render pit.lmr -o bad.png --shadow-map 12
# Crowds: a placement at the origin is the relief itself, and turned, moved or scaled ones are as with another eye.
status 0 relief bake pit.obj -o pit.lmr --triangles 20 --size 32
mkdir -p stage
cp pit.lmr stage/
printf '# one\n\npit.lmr 0 0 0\n' >stage/one.txt
eye="--eye 1.5,2,5 --target 0,0,0 --size 64x48"
for more in "" "--light point:3,3,3:0,-1,0:90,90,90" "--with floor.obj --bounce" "--world sky"; do
    # shellcheck disable=SC2086
    status 0 relief render pit.lmr $eye $more -o alone.ppm
    # shellcheck disable=SC2086
    status 0 relief render --crowd stage/one.txt $eye $more -o crowd.ppm
    check "a crowd of one is a relief, $more" cmp -s alone.ppm crowd.ppm
done
printf 'pit.lmr 0 0 0 90 2' >stage/turned.txt
status 0 relief render --crowd stage/turned.txt --eye 10,4,-3 --target 0,0,0 --size 64x48 --show depth -o turned.pfm
status 0 relief render pit.lmr $eye --show depth -o alone.pfm
status 0 compare turned.pfm alone.pfm
check "a relief turned and twice as large has twice the depth" grep -q ' mean \(2.00\|1.99\)' out.txt
printf 'pit.lmr %s\n' '0 0 0 30' '2.5 0 -1 200 0.5' '-2 0.5 -4' '-2 0.5 -4' '0 0 90' >stage/many.txt
awk '{ line[NR] = $0 } END { for (i = NR; i > 0; --i) print line[i] }' stage/many.txt >stage/reversed.txt
for threads in 1 3; do
    status 0 relief render --crowd stage/many.txt $eye --threads $threads -o many-$threads.ppm
done
check "a crowd has the same bytes on any threads" cmp -s many-1.ppm many-3.ppm
check "a crowd has more than its first" differ many-1.ppm crowd.ppm
status 0 relief render --crowd stage/reversed.txt $eye -o reversed.ppm
check "and in any order" cmp -s many-1.ppm reversed.ppm
status 0 relief render --crowd stage/many.txt --path looks.txt --frames 2 --size 16x16 -o walk.ppm
check "a path walks through a crowd" test -s walk-0001.ppm
# crowd_refused LINES WORDS: checks that a list is refused.
crowd_refused() {
    printf "$1" >stage/bad.txt
    status 1 relief render --crowd stage/bad.txt $eye -o bad.png
    said "$2"
}
# Placements of one pixel stay in the picture: 400 of them, away from each other. They had vanished but for those in the
# corners of tiles.
awk 'BEGIN { for (i = 0; i < 400; ++i) print "pit.lmr", 20.3 * (i % 20 - 9.5), 0, 20.3 * (int(i / 20) - 9.5) }' >stage/far.txt
status 0 relief render --crowd stage/far.txt --size 160x160 --fov 2 --eye 0,13000,0 --target 0,0,0 --up 0,0,1 --samples 1 -o far.ppm
check "a far crowd stays in the picture" sh -c 'awk "/^pixels of the simple model/ { ok = \$6 + 0 > 150 && \$8 + 0 > 85 } END { exit !ok }" "$1"' sh out.txt
crowd_refused 'pit.lmr\0x 0 0 0\n' "stage/bad.txt: line 1: a zero byte in a name"
crowd_refused 'pit.lmr 1e6 0 0 0 1e6\n' "stage/bad.txt: a placement reaches over 1e+06 m away"
crowd_refused '# none\n' "stage/bad.txt: no placements in it"
crowd_refused 'pit.lmr 0 0 0\npit.lmr 0 0\n' "stage/bad.txt: line 2: not FILE.lmr X Y Z [TURN [SCALE]]"
crowd_refused 'pit.lmr 0 0 0 0 1 7\n' "stage/bad.txt: line 1: not FILE.lmr"
crowd_refused 'pit.lmr 0 nan 0\n' "stage/bad.txt: line 1: not FILE.lmr"
crowd_refused 'pit.lmr 0 2e6 0\n' "a place over 1e+06 m away"
crowd_refused 'pit.lmr 0 0 0 0 -1\n' "a scale that is not 1e-06 .. 1e+06"
crowd_refused 'nowhere.lmr 0 0 0\n' "stage/nowhere.lmr: "
crowd_refused 'many.txt 0 0 0\n' "stage/many.txt: not a whole .lmr file"
printf '../pit.lmr 0 0 0\n' >stage/up.txt
status 1 relief render --crowd stage/up.txt $eye --only-here -o bad.png
said "no file in or below its folder"
status 2 relief render pit.lmr --crowd stage/one.txt -o bad.png
said "--crowd names the reliefs to draw: leave pit.lmr out"
status 1 relief render pit.lmr --photo nowhere -o bad.png
said "nowhere."
for more in "--size 9x9" "--fov 10" "--up 1,0,0" "--near 1"; do
    # shellcheck disable=SC2086
    status 2 relief render pit.lmr --photo nowhere $more -o bad.png
    said "--photo sets camera and size"
done
for more in "--world sky" "--show full" "--show lit"; do
    status 2 relief render pit.lmr --photo nowhere $more -o bad.png
    said "--photo draws without light"
done
status 2 relief render pit.lmr --photo nowhere --background ffffff -o bad.png
said "--photo has no background"
status 2 relief render --crowd stage/one.txt --compare pit.obj -o bad.png
printf 'pit.lmr 0 0 0\n' >stage/self.ppm
status 2 relief render --crowd stage/self.ppm -o stage/self.ppm
cp pit.lmr stage/self.ppm
printf 'self.ppm 0 0 0\n' >stage/over.txt
status 2 relief render --crowd stage/over.txt $eye -o stage/self.ppm
said "stage/self.ppm: cannot be written: it is read"
check "and what it reads stays" cmp -s pit.lmr stage/self.ppm
# In a world a box as a relief has the light, shadow, ground and background of `lambent render`.
eye="--eye 3,2,4 --target 0,0,0 --size 80x60"
{ printf 'PF\n16 8\n-1.0\n'; repeated 192 "$half"; repeated 192 "$two"; } >dusk.pfm
for world in sky dusk.pfm; do
    for ground in auto none; do
        status 0 relief render box.lmr --world $world --ground $ground --samples 1 $eye -o as-relief.pfm
        status 0 render box.obj --world $world --ground $ground --show direct --samples 1 $eye -o as-mesh.pfm
        status 0 compare as-relief.pfm as-mesh.pfm
        check "a box in the world $world, ground $ground" sh -c 'awk "/^trim/ { exit !(\$2 < 0.03 && \$8 < 0.002) }" out.txt'
    done
done
status 0 relief render box.lmr --world sky --with floor.obj $eye --samples 1 -o in.pfm
status 0 relief render box.lmr --world none --with floor.obj $eye --samples 1 -o out.pfm
check "a sky lights other geometry" differ in.pfm out.pfm
status 0 relief render box.lmr --world dusk.pfm --bounce $eye -o dim.ppm
said "--bounce reflects only a sun or lamp"
status 0 relief render box.lmr --world sky --bounce $eye -o dim.ppm
check "a sky's sun is reflected" lacks "--bounce reflects" err.txt
status 0 relief render box.lmr --world dusk.pfm --path looks.txt --frames 1 --samples 1 --size 80x60 -o tour.pfm
status 0 relief render box.lmr --world dusk.pfm --eye 1,2,5 --target 0,0,0 --samples 1 --size 80x60 -o single.pfm
check "a path has the world" cmp -s tour-0000.pfm single.pfm
status 0 relief render box.lmr --background 336699 $eye -o colour.ppm
check "a background's colour" test "$(tail -c 3 colour.ppm | od -An -tx1 | tr -d ' ')" = 336699
status 0 relief render box.lmr --background transparent $eye -o clear.png
check "a transparent background has alpha" test "$(od -An -tu1 -j25 -N1 clear.png | tr -d ' ')" = 6
status 1 relief render box.lmr --world nowhere.hdr -o bad.png
said "nowhere.hdr: "
status 2 relief render box.lmr --world sky --compare box.obj -o bad.png
said "leave --world out"
status 2 relief render box.lmr --background 33669 -o bad.png
status 2 relief render box.lmr --background transparent -o bad.ppm
status 2 relief render box.lmr --background 336699 -o bad.pfm
status 2 relief render box.lmr --background 336699 --show depth -o bad.png
status 0 relief --help
status 0 relief bake --help
status 0 relief render --help

finish
