# lights.sh: many lights: the light tree, in any order, and bounced light.
. tests/cli/common.sh

# A floor under 200 lights of one kind, too many for shadow maps; the picture does not depend on their order.
many_lights() {
    awk -v first="$1" -v step="$2" -v kind="${4:-point}" -v all="${5:-200}" 'BEGIN {
        printf "{\"asset\":{\"version\":\"2.0\"},\"extensionsUsed\":[\"KHR_lights_punctual\"],\"extensions\":"
        printf "{\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"%s\",\"intensity\":0.3%s}]}},\"scene\":0,\"nodes\":[{\"mesh\":0}", kind, kind == "spot" ? ",\"spot\":{\"outerConeAngle\":0.6}" : ""
        for (i = first; i >= 0 && i < all; i += step)
            printf ",{\"rotation\":[-0.70710678,0,0,0.70710678],\"translation\":[%g,%g,%g],\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}}",
                i % 17 / 10, 0.2 + i % 7 / 9, i % 23 / 12 - 1
        printf "],\"scenes\":[{\"nodes\":[0"
        for (i = 1; i <= all; ++i) printf ",%d", i
        printf "]}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"accessors\":[{\"bufferView\":0,"
        printf "\"componentType\":5126,\"count\":3,\"type\":\"VEC3\",\"min\":[-2,0,-2],\"max\":[4,0,4]}],\"bufferViews\":"
        printf "[{\"buffer\":0,\"byteLength\":36}],\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;"
        printf "base64,AAAAwAAAAAAAAADAAAAAwAAAAAAAAIBAAACAQAAAAAAAAADA\"}]}"
    }' >"$3"
}
many_lights 0 1 many.gltf
many_lights 199 -1 manyback.gltf
look="--size 32x24 --eye 0,3,3 --target 0,0,0"
status 0 render many.gltf $look -o many.pfm --stats many.json
check "render says what it does with many lights" holds '200 lights in 200 cells' err.txt
check "stats count the lights" grep -q '"many_lights": 200, "light_cells": 200, "light_nodes": [1-9]' many.json
status 0 render manyback.gltf $look --threads 3 --backend scalar -o manyback.pfm
check "the order of lights changes the picture" cmp many.pfm manyback.pfm
for kind in spot directional; do
    many_lights 0 1 "$kind.gltf" $kind
    many_lights 199 -1 "${kind}back.gltf" $kind
    status 0 render "$kind.gltf" $look --show direct -o "$kind.pfm"
    check "200 ${kind}s are drawn" holds '200 lights in' err.txt
    status 0 render "${kind}back.gltf" $look --show direct -o "${kind}back.pfm"
    check "the order of ${kind}s changes the picture" cmp "$kind.pfm" "${kind}back.pfm"
done
check "spots light what points do" differ spot.pfm many.pfm
status 0 render many.gltf $look --many-lights 50 -o fewcells.pfm
check "--many-lights 50 takes as many cells at most" grep -q '200 lights in [1-5][0-9] cells' err.txt
status 0 compare many.pfm fewcells.pfm --max trim=0.1
for show in direct full; do
    status 0 render many.gltf $look --show $show -o "$show.pfm"
done
check "a floor lights nothing but itself" cmp direct.pfm full.pfm
status 2 render demo $small --many-lights 4 --group method=zones -o bad.pfm
status 0 render many.gltf $look --group method=zones --show direct -o zones.pfm
check "direct light knows no grouping" cmp direct.pfm zones.pfm
status 2 render demo $small --group thick=2 -o bad.pfm

# Ranges with shadow maps and with a light tree, in both files. 0 means no range, and a light that ends before the floor
# does not light it.
is_black() { [ "$(tail -c 9216 "$1" | tr -d '\000' | wc -c)" -eq 0 ]; }
for count in 3 200; do
    for kind in point spot; do
        many_lights 0 1 open.gltf $kind $count
        for range in 0 0.1 0.6; do
            sed "s/\"intensity\":0.3/&,\"range\":$range/" open.gltf >ended.gltf
            status 0 render ended.gltf $look --show direct -o "range$range.pfm"
            check "a range is drawn, not left out" lacks range err.txt
        done
        status 0 render open.gltf $look --show direct -o open.pfm
        check "$count ${kind}s: a range of 0 is none" cmp range0.pfm open.pfm
        check "$count ${kind}s: one of 0.6 m is seen" differ range0.6.pfm open.pfm
        check "$count ${kind}s: one of 0.1 m ends before the floor" is_black range0.1.pfm
        check "$count ${kind}s: without it there is light" sh -c '! "$@"' sh cmp -s range0.1.pfm range0.6.pfm
        status 0 pack ended.gltf -o ended.lmp --position-error 0 --order file
        status 0 render ended.lmp $look --show direct -o packed.pfm
        check "$count ${kind}s: a packed scene keeps ranges" cmp packed.pfm range0.6.pfm
        status 0 render ended.gltf $look --show direct --many-lights 300 --light-error 0.0001 -o tree.pfm
        status 0 compare tree.pfm range0.6.pfm --max trim=0.02
    done
done
if [ -z "$SHORT" ]; then
    for light in point:-0.5,2,0.5:0,-1,0:9,9,9 spot:-0.5,2,0.5:0.3,-1,0:9,9,9:20,40; do
        for bounces in 1 3; do
            # A spot's border needs smaller elements than the light of a point.
            case $light in spot*) map=512 elements=16384 ;; *) map=128 elements=4096 ;; esac
            [ $bounces = 1 ] || elements=$((elements / 4))
            how="demo --size 32x24 --exposure 0 --light $light --shadow-map $map --show indirect --bounces $bounces --elements $elements"
            status 0 render $how --many-lights 4 --gather full -o elements.pfm
            status 0 render $how -o own.pfm
            status 0 compare elements.pfm own.pfm --max trim=0.05
        done
    done
fi
status 0 render demo $small --many-lights 4 --elements 1024 --bounces 2 -o once.pfm
status 0 render demo $small --many-lights 4 --elements 1024 --bounces 2 --threads 3 --backend scalar -o threads.pfm
check "threads or lanes change what many lights bounce" cmp once.pfm threads.pfm
few= # lights that bounce use a tree from 33 on, with coarser bounced light, which is as accurate as their direct light
for i in $(seq 33); do
    few="$few --light point:0.$((i % 10)),2,0.$((i / 4)):0,-1,0:1,1,1"
done
status 0 render demo $small $few --show indirect --stats few.json -o few.pfm
check "33 lights that bounce are many" holds '33 lights in' err.txt
status 0 render demo $small $few --show indirect --error 0.02 --visibility 0.015 --stats fine.json -o fine.pfm
status 0 compare few.pfm fine.pfm --max trim=0.05
check "33 lights' bounced light takes under three quarters of the finer segments" sh -c '
    segments() { sed -n "s/.*\"segments\": \([0-9]*\).*/\1/p" "$1"; }
    [ $((4 * $(segments "$1"))) -lt $((3 * $(segments "$2"))) ]' sh few.json fine.json
status 0 render demo $small $few --show direct -o few.pfm
check "33 lights' direct light has maps" lacks 'lights in' err.txt
# From 65,536 pixels on many lights have live light by default, but not if they make a soft shadow.
plain="demo --size 256x256 --exposure 0 --elements 1024 --occlusion none --show indirect"
for light in "$few" "--light point:0.5,2,0.5:0,-1,0:9,9,9:0.4"; do
    way=$([ "$light" = "$few" ] && echo live || echo full)
    status 0 render $plain $light -o implied.pfm
    status 0 render $plain $light --gather $way -o named.pfm
    check "light from ${light%%:*} has --gather $way" cmp implied.pfm named.pfm
done
status 2 render many.gltf --bounce-lights 3 -o bad.pfm
status 2 render many.gltf --many-lights 0 -o bad.pfm
status 2 render many.gltf --light-error 0 -o bad.pfm
check "nothing is left behind" none bad* nowhere* *tmp*

# A closed room, turned, under a lamp outside. At one corner, the shadow map shows the ground behind the room.
cat >closed.obj <<EOF
v -0.831321061 2.95186472 -2.02455735
v -1.93729246 -0.915264666 -2.98540139
v 2.25978637 -2.89397454 0.147342309
v 3.3657577 0.973154902 1.10818624
v -3.3657577 -0.973154902 -1.10818624
v -2.25978637 2.89397454 -0.147342309
v 1.93729246 0.915264666 2.98540139
v 0.831321061 -2.95186472 2.02455735
v -20 -4.13534546 20
v 20 -4.13534546 20
v 20 -4.13534546 -20
v -20 -4.13534546 -20
f 1 2 3 4
f 5 6 7 8
f 5 8 3 2
f 7 6 1 4
f 7 4 3 8
f 1 6 5 2
f 9 10 11 12
EOF
closed="--eye -0.588447849,-0.156395245,0.111647998 --target -0.0166343277,0.556149825,0.518229872
    --up 0.748557762,-0.250371547,-0.613983196 --fov 85.9436693
    --light point:-5.01398017,4.4383184,-0.221688962:0,-1,0:200,200,200"
# A larger room, where more pixels of a tile show the corner.
cat >large.obj <<EOF
v 5.7131019 4.3100323 -1.38922375
v 1.9513198 -6.73976183 -1.97833666
v -0.0309421387 6.3795527 -3.52791785
v -3.79272424 -4.67024143 -4.11703075
v 3.79272424 4.67024143 4.11703075
v 0.0309421387 -6.3795527 3.52791785
v -1.9513198 6.73976183 1.97833666
v -5.7131019 -4.3100323 1.38922375
v -116.874295 -6.74076183 116.874295
v 116.874295 -6.74076183 116.874295
v 116.874295 -6.74076183 -116.874295
v -116.874295 -6.74076183 -116.874295
f 3 4 2 1
f 6 8 7 5
f 2 6 5 1
f 7 8 4 3
f 5 7 3 1
f 4 8 6 2
f 9 10 11 12
EOF
large="--eye 0.655966519,1.29114707,1.89278772 --target 2.22434538,2.98069425,3.00490924
    --up -0.936863538,0.278795044,-0.238872422 --fov 48.840697
    --light sun:0,0,0:-0.435928705,-0.716927585,0.54404136:100,100,100
    --light point:-4.99398668,8.21310174,-6.23252213:0,-1,0:13123,13123,13123"
printf 'newmtl shiny\nKd .5 .5 .5\nKs .3 .3 .3\nNs 50\n' >shiny.mtl
# The segments that keep the corners of a coarse map dark are counted.
status 0 render large.obj $large --world none --size 96x96 --shadow-map 64 --tree 8 -o closed.pfm --stats corners.json
check "stats count no segments of corners" test "$(count corners.json corner_segments)" -gt 0
status 0 render large.obj $large --world none --size 96x96 --show direct -o closed.pfm
status 0 render large.obj $large --world none --size 96x96 --shadow-map 64 --show direct -o coarse.pfm --stats corners.json
check "stats count them for direct light" test "$(count corners.json corner_segments)" -gt 0
status 0 info closed.pfm
check "direct light only: light in the corner of a closed room: $(grep red out.txt)" awk '
    $1 == "red" { dark = $5 == 0 } END { exit !dark }' out.txt
# Up to a hundred-thousandth of the light outside is left: bounced light in the corners of the larger and the shiny room.
for room in closed large; do
    [ $room = closed ] && look=$closed most=0 || look=$large most=0.001
    sed 's/^f/usemtl shiny\nf/; 1i mtllib shiny.mtl' $room.obj >shiny_$room.obj
    for file in $room.obj shiny_$room.obj; do
        [ $file != shiny_closed.obj ] || most=1e-6
        for options in "--samples 1" "--samples 4" "--samples 16" "--quality best"; do
            case $file$options,${LMB_LONG:-0} in
            *best,[01] | *16,[01] | shiny_*[!4],[01]) continue ;; # nightly: closed rooms are dark, so they take long
            esac
            status 0 render $file $look --world none --size 96x96 $options -o closed.pfm
            status 0 info closed.pfm
            check "$file, $options: light in the corner of a closed room: $(grep red out.txt)" awk -v most=$most '
                $1 == "red" { seen = 1; wrong = $5 > most } END { exit !seen || wrong }' out.txt
        done
    done
done

finish
