# bounce.sh: bounced light: --bounces, --elements, surfaces that emit, error bounds.
. tests/cli/common.sh

# More bounces add light, and the default is one; a surface that emits lights a scene without lamps.
cut="--group method=cut --occlusion exact --shadow-map 32"
coarse="--size 32x24 --exposure 0 $cut"
status 0 render demo $coarse -o bounce.pfm
status 0 render demo $coarse --bounces 1 -o bounce1.pfm
check "--bounces 1 is the default" cmp bounce.pfm bounce1.pfm
status 0 render demo $coarse --bounces 3 --elements 200 --threads 2 -o bounce3.pfm --stats bounce3.json
check "--bounces 3 changes the picture" differ bounce.pfm bounce3.pfm
check "--elements holds" test "$(count bounce3.json elements)" -le 256 -a "$(count bounce3.json elements)" -gt 16
status 0 render demo $coarse --bounces 3 --elements 256 --threads 1 -o option.pfm
check "threads do not change bounces" cmp bounce3.pfm option.pfm
status 2 render demo $small --group method=zones --bounces 2 -o option.pfm
status 2 render demo $coarse --bounces 0 -o option.pfm
printf 'newmtl lamp\nKe 2 3 4\nKd 0 0 0\n' >emits.mtl
printf '%s\n' 'mtllib emits.mtl' 'v -1 0 -1' 'v 1 0 -1' 'v 1 0 1' 'v -1 0 1' 'v -1 1 -1' 'v 1 1 -1' 'v 1 1 1' 'v -1 1 1' \
    'f 1 2 3 4' 'usemtl lamp' 'f 5 6 7 8' >emits.obj
status 0 render emits.obj --size 16x16 --eye 0,0.5,2 --target 0,0.4,0 $cut -o emits.pfm
check "a lamp is enough light" lacks 'no light in' err.txt
status 0 render emits.obj --size 16x16 --eye 0,0.9,0 --target 0,0,0.1 $cut --show irradiance -o floor.pfm
check "its light is seen" test "$(tail -c 3072 floor.pfm | tr -d '\000' | wc -c)" -gt 2000
# A square between an emitting surface and the floor blocks the light, also if there is no other lamp.
printf '%s\n' 'mtllib emits.mtl' 'v -1 0 -1' 'v 1 0 -1' 'v 1 0 1' 'v -1 0 1' 'v -1 1 -1' 'v 1 1 -1' 'v 1 1 1' 'v -1 1 1' \
    'v -2 0.5 -2' 'v 2 0.5 -2' 'v 2 0.5 2' 'v -2 0.5 2' 'f 1 2 3 4' 'f 9 10 11 12' 'usemtl lamp' 'f 5 6 7 8' >shade.obj
status 0 render shade.obj --size 16x16 --eye 0,0.45,0 --target 0,0,0.1 --shadow-map 32 --show irradiance -o shade.pfm
check "a shade is dark below" test "$(tail -c 3072 shade.pfm | tr -d '\000' | wc -c)" -eq 0

# Two emitting eyes on a box do not remove the default sun and do not change the exposure.
printf 'newmtl eye\nKe 0 3 3\nKd 0 0 0\n' >eyes.mtl
printf 'newmtl eye\nKd 0 0 0\n' >blind.mtl
eyes="--size 32x32 --eye 0,0.5,3 --target 0,0.5,0 --show direct"
for of in eyes blind; do
    printf '%s\n' "mtllib $of.mtl" 'v -0.5 0 0.5' 'v 0.5 0 0.5' 'v 0.5 1 0.5' 'v -0.5 1 0.5' 'v -0.5 1 -0.5' 'v 0.5 1 -0.5' \
        'v -0.3 0.6 0.502' 'v -0.1 0.6 0.502' 'v -0.1 0.8 0.502' 'v -0.3 0.8 0.502' 'v 0.1 0.6 0.502' 'v 0.3 0.6 0.502' \
        'v 0.3 0.8 0.502' 'v 0.1 0.8 0.502' 'f 1 2 3 4' 'f 4 3 6 5' 'usemtl eye' 'f 7 8 9 10' 'f 11 12 13 14' >"$of.obj"
    status 0 render "$of.obj" $eyes -o "$of.png"
    cp err.txt "$of.txt"
done
check "what only glows leaves the sun on" grep -q "no light in" eyes.txt
check "what glows does not expose" test "$(grep exposure eyes.txt)" = "$(grep exposure blind.txt)"
status 0 render demo $small --occlusion none --error-bound 0.001 --show indirect -o proved.pfm
status 0 render demo $small --occlusion none --error 0.0001 --show indirect -o ruled.pfm
status 0 compare proved.pfm ruled.pfm
[ -n "$SHORT" ] || status 0 render demo --size 16x16 --shadow-map 64 --bounces 3 --elements 4096 --show occlusion -o blocked.pfm

# Draft uses live light for all but small pictures and for frames of play, unless --gather names another way.
drawn="--exposure 0 --show indirect --shadow-map 64 --occlusion none --quality draft"
status 0 render demo --size 256x256 $drawn -o implied.pfm
status 0 render demo --size 256x256 $drawn --gather live -o named.pfm
check "--quality draft has live light" cmp implied.pfm named.pfm
status 0 render demo --size 256x256 $drawn --gather full -o named.pfm
check "--gather full holds by draft" differ implied.pfm named.pfm
status 0 render demo --size 255x256 $drawn -o implied.pfm
status 0 render demo --size 255x256 $drawn --gather full -o named.pfm
check "draft gathers each pixel of small pictures" cmp implied.pfm named.pfm
status 0 play demo --size 256x256 $drawn --frames 1 -o named%01d.pfm
status 0 render demo --size 256x256 $drawn -o implied.pfm
check "play has the live light of render" cmp implied.pfm named0.pfm
drawn="--size 48x32 --exposure 0 --show indirect --shadow-map 256"
status 0 play demo $drawn --frames 1 -o implied%01d.pfm
status 0 render demo $drawn -o named.pfm
check "play gathers as render does in small pictures" cmp implied0.pfm named.pfm
# A small place in much land: cells of the live tree are larger than its parts, and are divided.
awk 'BEGIN { print "v -2000 0 -2000\nv -2000 0 2000\nv 2000 0 2000\nv 2000 0 -2000\nf 1 2 3 4"
    for (i = 0; i < 64; ++i) { x = i % 8; z = int(i / 8); y = i % 3; n = 4 + 4 * i
        printf "v %g %g %g\nv %g %g %g\n", x, y, z, x, y + 1, z + 0.5
        printf "v %g %g %g\nv %g %g %g\n", x + 1, y + 1, z + 0.5, x + 1, y, z
        printf "f %d %d %d %d\n", n + 1, n + 2, n + 3, n + 4 } }' >land.obj
land="land.obj --light sun:0,9,0:-0.3,-1,-0.2:3,3,3 --eye 4,4,14 --target 4,5,4 --size 256x256 --show indirect"
for way in "" "--gather full" "--gather live"; do
    status 0 render $land --quality draft $way -o "land${way##* }.pfm"
done
check "draft has live light also in a small place in much land" cmp land.pfm landlive.pfm
status 0 compare land.pfm landfull.pfm
check "it keeps the light: $(head -n 1 out.txt)" awk '
    { for (i = 1; i < NF; ++i) v[$i] = $(i + 1) } END { exit !(v["mean"] > 0.9 && v["mean"] < 1.1 && v["trim"] < 0.2) }' \
    out.txt
status 2 render demo $small --steady --error-bound 0.1 -o bound.pfm
status 2 render demo $small --steady --gather full -o bound.pfm
check "--steady refuses --gather full" grep -q 'leave --gather full out' err.txt
status 0 render demo $few --exposure 0 --gather live -o live.pfm
status 0 render demo $few --exposure 0 --steady -o steady.pfm
status 0 render demo $few --exposure 0 --steady --gather live -o named.pfm
check "--steady is live light" cmp steady.pfm named.pfm
check "--steady picks other targets" differ steady.pfm live.pfm
status 2 render demo $small --gather live --error-bound 0.1 -o bound.pfm
check "live light refuses a bound that it does not keep" grep -q -e '--gather live keeps no bound; use --gather full' err.txt
check "and writes nothing" test ! -e bound.pfm
status 0 render demo $small --gather live -v -o named.pfm
check "-v names the way of gathering" grep -q -e '--gather live' err.txt
for gone in half quarter adaptive; do
    status 2 render demo $small --gather $gone -o named.pfm
    check "--gather $gone names the replacement" grep -q -- "--gather: \`$gone\` was removed; use live" err.txt
    check "in one line" test "$(wc -l <err.txt)" -eq 1
done
drawn="--size 256x256 --exposure 0 --show indirect --shadow-map 64"
status 0 play demo $drawn --frames 1 -o implied%01d.pfm
status 0 play demo $drawn --frames 1 --gather live -o named%01d.pfm
check "play has live light" cmp implied0.pfm named0.pfm
status 0 play demo $drawn --frames 1 --quality best --occlusion none -o implied%01d.pfm
status 0 play demo $drawn --frames 1 --quality best --occlusion none --gather full -o named%01d.pfm
check "--quality best gathers each pixel in play" cmp implied0.pfm named0.pfm

# --gather live: the same bytes for any threads, backends and slices; errors; a view frame by frame.
live="--size 48x32 --exposure 0 --quality draft --show indirect --gather live"
status 0 render demo $live --threads 1 -o live.pfm
status 0 render demo $live --threads 3 -o live3.pfm
check "threads do not change live light" cmp live.pfm live3.pfm
status 0 render demo $live --backend scalar -o scalar.pfm
check "back ends do not change live light" cmp live.pfm scalar.pfm
# Later bounces and emitting surfaces use the same points.
for of in demo emits.obj; do
    again="--size 40x30 --exposure 0 --show indirect --bounces 3 --elements 2048 --shadow-map 512"
    status 0 render $of $again --quality draft --gather live --threads 1 -o again.pfm
    status 0 render $of $again --quality draft --gather live --threads 3 --backend scalar -o again3.pfm
    check "threads and back ends do not change live bounces of $of" cmp again.pfm again3.pfm
    status 0 render $of $again --gather full -o full.pfm
    status 0 compare again.pfm full.pfm --max trim=0.12,lo=0.95,hi=1.05
done
for i in 1 2 3; do
    status 0 render demo $live --slice $i/3 -o live.pfm
done
cp live.pfm before.pfm
status 0 merge live.pfm.1of3 live.pfm.2of3 live.pfm.3of3 -o live.pfm
check "slices do not change live light" cmp live.pfm before.pfm
status 0 play demo $live --frames 1 -q -o live%01d.pfm
check "play does not change live light" cmp live.pfm live0.pfm
status 0 render demo --size 48x32 --exposure 0 --shadow-map 256 --quality best --show indirect -o truth.pfm
status 0 compare live.pfm truth.pfm --max trim=0.12,rmse=0.18,lo=0.97,hi=1.03
status 2 render demo $live --group method=zones -o live0.pfm
check "nothing is left behind" none bad* nowhere* *tmp*

finish
