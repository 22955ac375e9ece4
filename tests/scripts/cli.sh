# cli.sh: what the tool writes, says and returns; TOOL and B in the environment.
#
# SHORT=1, for builds that are slow: without the minutes of light that other checks run too.
. tests/scripts/checks.sh

dir=$B/cli
case $TOOL in /*) lambent=$TOOL ;; *) lambent=$PWD/$TOOL ;; esac
rm -rf "$dir"
mkdir -p "$dir"

# status WANTED ARGUMENT...: the exit status; a failure says one line on stderr, and only there.
status() {
    wanted=$1
    shift
    "$TOOL" "$@" >"$dir/out.txt" 2>"$dir/err.txt"
    got=$?
    [ $got -eq "$wanted" ] && pass || fail "lambent $*: exit status $got, not $wanted: $(head -n 1 "$dir/err.txt")"
    if [ "$wanted" -eq 1 ]; then
        lines=$(grep -c . "$dir/err.txt")
        [ "$lines" -eq 1 ] && pass || fail "lambent $*: $lines lines on stderr instead of one"
        [ ! -s "$dir/out.txt" ] && pass || fail "lambent $*: an error, yet output on stdout"
    elif [ "$wanted" -eq 2 ]; then
        [ -s "$dir/err.txt" ] && pass || fail "lambent $*: bad usage and not a word on stderr"
    fi
}

# begins FILE BYTES_IN_OCTAL: the first bytes of a file.
begins() {
    got=$(od -An -to1 -N4 "$1" | tr -d ' \n')
    [ "$got" = "$2" ] && pass || fail "$1 begins with $got instead of $2"
}

absent() { [ ! -e "$1" ] && pass || fail "$1 should not be there"; }

small="--size 64x48 --shadow-map 64 --exposure 0"

# Only glTF has lobes.
status 2 render demo $small --glossy -o "$dir/glossy.png"

# Each format by its extension, whole.
for extension in png ppm pfm hdr; do
    status 0 render demo $small -o "$dir/demo.$extension"
done
begins "$dir/demo.png" 211120116107
begins "$dir/demo.ppm" 120066012066
begins "$dir/demo.pfm" 120106012066
begins "$dir/demo.hdr" 043077122101
check "demo.ppm is 64x48" test "$(wc -c <"$dir/demo.ppm")" -eq $((64 * 48 * 3 + 13))
check "demo.pfm is 64x48" test "$(sed -n 2p "$dir/demo.pfm")" = "64 48"

# What is shown, and by which method.
for show in direct indirect irradiance depth normal albedo; do
    status 0 render demo $small --show $show -o "$dir/$show.pfm"
done
for show in occlusion eye-distance light-distance points groups; do
    for extension in png pfm hdr; do
        status 0 render demo $small --show $show -o "$dir/$show.$extension"
    done
done
check "what the eye sees has the picture's size" test "$(sed -n 2p "$dir/eye-distance.pfm")" = "64 48"
for show in light-distance points groups; do
    check "$show has the map's size" test "$(sed -n 2p "$dir/$show.pfm")" = "64 64"
done
status 0 render demo $small --show light-distance --light point:0,1,0:0,-1,0:1,1,1 --light sun:0,0,0:0,-1,0:1,1,1 -o "$dir/two.pfm"
check "a row of faces a light" test "$(sed -n 2p "$dir/two.pfm")" = "384 128"
status 0 render demo $small --show eye-distance -o "$dir/eye-distance.png"
check "distances say their range" grep -q '^lambent: from [0-9.]* m (white) to [0-9.]* m (dark grey)$' "$dir/err.txt"
for grouping in greedy zones; do
    status 0 render demo $small --grouping $grouping -o "$dir/$grouping.pfm"
done
for occlusion in none view view-world; do
    status 0 render demo $small --occlusion $occlusion -o "$dir/$occlusion.pfm"
done
status 0 render demo $small --stats "$dir/stats.json" -o "$dir/again.pfm"
check "the same command writes the same bytes" cmp "$dir/demo.pfm" "$dir/again.pfm"
check "stats are JSON" grep -q '^{' "$dir/stats.json"
check "light by cuts has no first points to count" grep -q '"first_points": null, "discs": null, "groups": null' "$dir/stats.json"

# Strict zones say what they lose; the others lose nothing and say nothing.
status 0 render demo $small --groups 40 --misfits drop -o "$dir/strict.pfm"
check "strict zones say their loss" grep -q '^lambent: note: --misfits drop lost [1-9][0-9.]* % of the light' "$dir/err.txt"
status 0 render demo $small --groups 40 --misfits keep -o "$dir/kept.pfm"
check "kept misfits lose nothing" sh -c '! grep -q lost "$1"' sh "$dir/err.txt"

# Groups that are too few are said; zones, neighbours and discs are as asked for.
status 0 render demo $small --groups 7 -o "$dir/few.pfm"
check "regrouping is said" grep -qE '^lambent: note: discs were grouped again [1-9][0-9]* times?, .*: [1-7]$' "$dir/err.txt"
status 0 render demo $small --groups 400 -o "$dir/plain.pfm"
for option in "--zones 20" "--neighbour 0.6" "--neighbour-blocks 3" "--disc-radius 2"; do
    status 0 render demo $small --groups 400 $option -o "$dir/other.pfm"
    check "$option changes nothing" sh -c '! cmp -s "$1" "$2"' sh "$dir/other.pfm" "$dir/plain.pfm"
done

# A number of the statistics.
count() { sed -n "/seconds/!s/.*\"$2\": \([0-9]*\).*/\1/p" "$1"; }

# More bounces add light, one is what there is without the option; what emits lights a scene without lamps.
cut="--grouping cut --occlusion exact --shadow-map 32"
coarse="--size 64x48 --exposure 0 $cut"
status 0 render demo $coarse -o "$dir/bounce.pfm"
status 0 render demo $coarse --bounces 1 -o "$dir/bounce1.pfm"
check "--bounces 1 is the default" cmp "$dir/bounce.pfm" "$dir/bounce1.pfm"
status 0 render demo $coarse --bounces 3 --elements 200 --threads 2 -o "$dir/bounce3.pfm" --stats "$dir/bounce3.json"
check "--bounces 3 changes the picture" sh -c '! cmp -s "$1" "$2"' sh "$dir/bounce.pfm" "$dir/bounce3.pfm"
check "--elements holds" test "$(count "$dir/bounce3.json" elements)" -le 256 -a "$(count "$dir/bounce3.json" elements)" -gt 16
status 0 render demo $coarse --bounces 3 --elements 256 --threads 1 -o "$dir/option.pfm"
check "threads do not change bounces" cmp "$dir/bounce3.pfm" "$dir/option.pfm"
status 2 render demo $small --grouping zones --bounces 2 -o "$dir/option.pfm"
status 2 render demo $coarse --bounces 0 -o "$dir/option.pfm"
printf 'newmtl lamp\nKe 2 3 4\nKd 0 0 0\n' >"$dir/emits.mtl"
printf '%s\n' 'mtllib emits.mtl' 'v -1 0 -1' 'v 1 0 -1' 'v 1 0 1' 'v -1 0 1' 'v -1 1 -1' 'v 1 1 -1' 'v 1 1 1' 'v -1 1 1' \
    'f 1 2 3 4' 'usemtl lamp' 'f 5 6 7 8' >"$dir/emits.obj"
status 0 render "$dir/emits.obj" --size 16x16 --eye 0,0.5,2 --target 0,0.4,0 $cut -o "$dir/emits.pfm"
check "a lamp is enough light" sh -c '! grep -q "no light in" "$1"' sh "$dir/err.txt"
status 0 render "$dir/emits.obj" --size 16x16 --eye 0,0.9,0 --target 0,0,0.1 $cut --show irradiance -o "$dir/floor.pfm"
check "its light is seen" test "$(tail -c 3072 "$dir/floor.pfm" | tr -d '\000' | wc -c)" -gt 2000
# What stands between a lamp that is a surface and the floor blocks it, with no other lamp too.
printf '%s\n' 'mtllib emits.mtl' 'v -1 0 -1' 'v 1 0 -1' 'v 1 0 1' 'v -1 0 1' 'v -1 1 -1' 'v 1 1 -1' 'v 1 1 1' 'v -1 1 1' \
    'v -2 0.5 -2' 'v 2 0.5 -2' 'v 2 0.5 2' 'v -2 0.5 2' 'f 1 2 3 4' 'f 9 10 11 12' 'usemtl lamp' 'f 5 6 7 8' >"$dir/shade.obj"
status 0 render "$dir/shade.obj" --size 16x16 --eye 0,0.45,0 --target 0,0,0.1 --shadow-map 32 --show irradiance -o "$dir/shade.pfm"
check "a shade is dark below" test "$(tail -c 3072 "$dir/shade.pfm" | tr -d '\000' | wc -c)" -eq 0

# A box with two lit eyes keeps its sun, and they do not change how it is exposed.
printf 'newmtl eye\nKe 0 3 3\nKd 0 0 0\n' >"$dir/eyes.mtl"
printf 'newmtl eye\nKd 0 0 0\n' >"$dir/blind.mtl"
eyes="--size 32x32 --eye 0,0.5,3 --target 0,0.5,0 --show direct"
for of in eyes blind; do
    printf '%s\n' "mtllib $of.mtl" 'v -0.5 0 0.5' 'v 0.5 0 0.5' 'v 0.5 1 0.5' 'v -0.5 1 0.5' 'v -0.5 1 -0.5' 'v 0.5 1 -0.5' \
        'v -0.3 0.6 0.502' 'v -0.1 0.6 0.502' 'v -0.1 0.8 0.502' 'v -0.3 0.8 0.502' 'v 0.1 0.6 0.502' 'v 0.3 0.6 0.502' \
        'v 0.3 0.8 0.502' 'v 0.1 0.8 0.502' 'f 1 2 3 4' 'f 4 3 6 5' 'usemtl eye' 'f 7 8 9 10' 'f 11 12 13 14' >"$dir/$of.obj"
    status 0 render "$dir/$of.obj" $eyes -o "$dir/$of.png"
    cp "$dir/err.txt" "$dir/$of.txt"
done
check "what only glows leaves the sun on" grep -q "no light in" "$dir/eyes.txt"
check "what glows does not expose" test "$(grep exposure "$dir/eyes.txt")" = "$(grep exposure "$dir/blind.txt")"

# First points: fewer discs, another neighbourhood, thresholds.
for option in "--thin 10" "--neighbourhood hemisphere" "--neighbour 0.25" "--neighbour 0.5" "--neighbour 1" "--centre disc"; do
    status 0 render demo $small $option -o "$dir/option.pfm" --stats "$dir/option.json"
    check "$option changes the picture" sh -c '! cmp -s "$1" "$2"' sh "$dir/demo.pfm" "$dir/option.pfm"
done

status 0 render demo $small --thin 10 -o "$dir/option.pfm" --stats "$dir/option.json"
status 0 render demo $small --grouping zones -o "$dir/option2.pfm" --stats "$dir/option2.json"
check "--thin 10 leaves few discs" test $((4 * $(count "$dir/option.json" discs))) -lt "$(count "$dir/option2.json" discs)"

# Two eyes: each half is what one eye sees from there, and the light is found once.
at() { echo "--eye $1,1.25,2.5 --target $1,1,-1 --fov 50"; }
rows() { tail -c +"$(($(head -n 3 "$1" | wc -c) + 1))" "$1" | od -An -v -tx1 | tr -d ' \n' | fold -w $((64 * 3 * 4 * 2)); }
eyes="$small --grouping zones"
status 0 render demo $eyes $(at 0.5) --stereo 0.25 -o "$dir/both.pfm" --stats "$dir/both.json"
status 0 render demo $eyes $(at 0.375) -o "$dir/left.pfm" --stats "$dir/left.json"
status 0 render demo $eyes $(at 0.625) -o "$dir/right.pfm"
check "two eyes side by side" test "$(sed -n 2p "$dir/both.pfm")" = "128 48"
rows "$dir/both.pfm" >"$dir/both.txt"
(rows "$dir/left.pfm"; echo) >"$dir/left.txt"
(rows "$dir/right.pfm"; echo) >"$dir/right.txt"
(sed -n 'p;n' "$dir/both.txt"; echo) | sed '/^$/d' >"$dir/left_half.txt"
(sed -n 'n;p' "$dir/both.txt"; echo) | sed '/^$/d' >"$dir/right_half.txt"
check "48 rows of an eye" test "$(grep -c . "$dir/left_half.txt")" -eq 48
check "the left half is the left eye's picture" cmp "$dir/left.txt" "$dir/left_half.txt"
check "the right half is the right eye's picture" cmp "$dir/right.txt" "$dir/right_half.txt"
for what in first_points discs groups; do
    check "two eyes: $what counted once" test "$(count "$dir/both.json" $what)" -gt 0 \
        -a "$(count "$dir/both.json" $what)" -eq "$(count "$dir/left.json" $what)"
done
check "two eyes: shadow map once, view twice" test $((2 * $(count "$dir/both.json" triangles_read))) -eq $((3 * $(count "$dir/left.json" triangles_read)))
check "two eyes: two views" test "$(count "$dir/both.json" views)" -eq 2
for show in depth eye-distance normal albedo occlusion direct; do
    status 0 render demo $small --stereo 0.1 --show $show -o "$dir/both.png"
done

# Many lights: a floor under 200 of them, in two orders, of a kind. Too many for maps; the picture knows no order.
many_lights() {
    awk -v first="$1" -v step="$2" -v kind="${4:-point}" 'BEGIN {
        printf "{\"asset\":{\"version\":\"2.0\"},\"extensionsUsed\":[\"KHR_lights_punctual\"],\"extensions\":"
        printf "{\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"%s\",\"intensity\":0.3%s}]}},\"scene\":0,\"nodes\":[{\"mesh\":0}", kind, kind == "spot" ? ",\"spot\":{\"outerConeAngle\":0.6}" : ""
        for (i = first; i >= 0 && i < 200; i += step)
            printf ",{\"rotation\":[-0.70710678,0,0,0.70710678],\"translation\":[%g,%g,%g],\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}}",
                i % 17 / 10, 0.2 + i % 7 / 9, i % 23 / 12 - 1
        printf "],\"scenes\":[{\"nodes\":[0"
        for (i = 1; i <= 200; ++i) printf ",%d", i
        printf "]}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"accessors\":[{\"bufferView\":0,"
        printf "\"componentType\":5126,\"count\":3,\"type\":\"VEC3\",\"min\":[-2,0,-2],\"max\":[4,0,4]}],\"bufferViews\":"
        printf "[{\"buffer\":0,\"byteLength\":36}],\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;"
        printf "base64,AAAAwAAAAAAAAADAAAAAwAAAAAAAAIBAAACAQAAAAAAAAADA\"}]}"
    }' >"$3"
}
many_lights 0 1 "$dir/many.gltf"
many_lights 199 -1 "$dir/manyback.gltf"
look="--size 64x48 --eye 0,3,3 --target 0,0,0"
status 0 render "$dir/many.gltf" $look -o "$dir/many.pfm" --stats "$dir/many.json"
check "render says what it does with many lights" grep -q '200 lights in 200 cells' "$dir/err.txt"
check "stats count the lights" grep -q '"many_lights": 200, "light_cells": 200, "light_nodes": [1-9]' "$dir/many.json"
status 0 render "$dir/manyback.gltf" $look --threads 3 --backend scalar -o "$dir/manyback.pfm"
check "the order of lights changes the picture" cmp "$dir/many.pfm" "$dir/manyback.pfm"
for kind in spot directional; do
    many_lights 0 1 "$dir/$kind.gltf" $kind
    many_lights 199 -1 "$dir/${kind}back.gltf" $kind
    status 0 render "$dir/$kind.gltf" $look --show direct -o "$dir/$kind.pfm"
    check "200 ${kind}s are drawn" grep -q '200 lights in' "$dir/err.txt"
    status 0 render "$dir/${kind}back.gltf" $look --show direct -o "$dir/${kind}back.pfm"
    check "the order of ${kind}s changes the picture" cmp "$dir/$kind.pfm" "$dir/${kind}back.pfm"
done
check "spots light what points do" sh -c "! cmp -s '$dir/spot.pfm' '$dir/many.pfm'"
status 0 render "$dir/many.gltf" $look --many-lights 50 -o "$dir/fewcells.pfm"
check "--many-lights 50 takes as many cells at most" grep -q '200 lights in [1-5][0-9] cells' "$dir/err.txt"
status 0 compare "$dir/many.pfm" "$dir/fewcells.pfm" --max trim=0.1
for show in direct full; do
    status 0 render "$dir/many.gltf" $look --show $show -o "$dir/$show.pfm"
done
check "a floor lights nothing but itself" cmp "$dir/direct.pfm" "$dir/full.pfm"
status 2 render demo $small --many-lights 4 --grouping zones -o "$dir/bad.pfm"
status 0 render "$dir/many.gltf" $look --grouping zones --show direct -o "$dir/zones.pfm"
check "direct light knows no grouping" cmp "$dir/direct.pfm" "$dir/zones.pfm"
status 2 render demo $small --profile fast -o "$dir/bad.pfm"
if [ -z "$SHORT" ]; then
    for light in point:-0.5,2,0.5:0,-1,0:9,9,9 spot:-0.5,2,0.5:0.3,-1,0:9,9,9:20,40; do
        for bounces in 1 3; do
            how="demo --size 32x24 --exposure 0 --light $light --shadow-map 512 --show indirect --bounces $bounces --elements 16384"
            status 0 render $how --many-lights 4 --gather full -o "$dir/elements.pfm"
            status 0 render $how -o "$dir/own.pfm"
            status 0 compare "$dir/elements.pfm" "$dir/own.pfm" --max trim=0.05
        done
    done
fi
status 0 render demo $small --many-lights 4 --elements 1024 --bounces 2 -o "$dir/once.pfm"
status 0 render demo $small --many-lights 4 --elements 1024 --bounces 2 --threads 3 --backend scalar -o "$dir/threads.pfm"
check "threads or lanes change what many lights bounce" cmp "$dir/once.pfm" "$dir/threads.pfm"
few= # lights that bounce take a tree from 33 on, and less fine bounced light, which is as right as their direct light
for i in $(seq 33); do
    few="$few --light point:0.$((i % 10)),2,0.$((i / 4)):0,-1,0:1,1,1"
done
status 0 render demo $small $few --show indirect --stats "$dir/few.json" -o "$dir/few.pfm"
check "33 lights that bounce are many" grep -q '33 lights in' "$dir/err.txt"
status 0 render demo $small $few --show indirect --error 0.02 --visibility 0.015 --stats "$dir/fine.json" -o "$dir/fine.pfm"
status 0 compare "$dir/few.pfm" "$dir/fine.pfm" --max trim=0.05
check "33 lights' bounced light takes under three quarters of the finer segments" sh -c '
    segments() { sed -n "s/.*\"segments\": \([0-9]*\).*/\1/p" "$1"; }
    [ $((4 * $(segments "$1"))) -lt $((3 * $(segments "$2"))) ]' sh "$dir/few.json" "$dir/fine.json"
status 0 render demo $small $few --show direct -o "$dir/few.pfm"
check "33 lights' direct light has maps" sh -c "! grep -q 'lights in' '$dir/err.txt'"
status 2 render "$dir/many.gltf" --bounce-lights 3 -o "$dir/bad.pfm"
status 2 render "$dir/many.gltf" --many-lights 0 -o "$dir/bad.pfm"
status 2 render "$dir/many.gltf" --light-error 0 -o "$dir/bad.pfm"

status 0 render demo $small --occlusion none --error-bound 0.001 --show indirect -o "$dir/proved.pfm"
status 0 render demo $small --occlusion none --error 0.0001 --show indirect -o "$dir/ruled.pfm"
status 0 compare "$dir/proved.pfm" "$dir/ruled.pfm"
[ -n "$SHORT" ] || status 0 render demo --size 16x16 --shadow-map 64 --bounces 3 --elements 4096 --show occlusion -o "$dir/blocked.pfm"

# Help and version go to stdout.
status 0 --version
check "lambent --version says something" test -s "$dir/out.txt"
for ask in --help "render --help" "compare --help" "info --help" "bench --help"; do
    status 0 $ask
    check "lambent $ask says something, once" test "$(grep -c '^usage:' "$dir/out.txt")" -eq 1
done

# compare: equal, different, sizes differ.
status 0 compare "$dir/demo.pfm" "$dir/again.pfm"
status 0 render demo --size 32x24 --shadow-map 64 -o "$dir/half.pfm"
status 3 compare "$dir/demo.pfm" "$dir/half.pfm"
{ printf 'PF\n2 1\n-1\n'; head -c 24 /dev/zero; } >"$dir/black.pfm"
{ printf 'PF\n2 1\n-1\n'; printf '\000\000\200\077%.0s' 1 2 3 4 5 6; } >"$dir/white.pfm"
status 0 compare "$dir/white.pfm" "$dir/black.pfm"
check "errors relative to black are infinite" grep -q '^trim inf rmse inf .* mean inf' "$dir/out.txt"
status 0 compare "$dir/black.pfm" "$dir/black.pfm"
check "black is black" grep -q '^trim 0.0000 rmse 0.0000 ' "$dir/out.txt"

# info: a scene and pictures, as text and as one JSON object on one line.
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >"$dir/one.obj"
status 0 info "$dir/one.obj"
check "info counts the triangle" grep -q '^triangles  *1 placed, 1 unique$' "$dir/out.txt"
for file in one.obj demo.png demo.ppm demo.pfm; do
    status 0 info "$dir/$file" --json
    check "info $file --json is one line" test "$(wc -l <"$dir/out.txt")" -eq 1
    check "info $file --json is an object" grep -q '^{.*}$' "$dir/out.txt"
done

status 0 info demo
check "info knows the built-in scene" sh -c 'grep -q "^file  *demo: built in$" "$1" && grep -q "^cameras  *1; placed: 1" "$1"' sh "$dir/out.txt"

# One parser reads all command lines: `--name=value`, what is given twice, what may be meant, where options end.
said() { check "lambent says: $1" grep -qF -e "$1" "$dir/err.txt"; }
status 0 render demo --size=64x48 --shadow-map=64 --exposure=0 -o "$dir/inside.pfm"
check "--name=value is --name value" cmp "$dir/demo.pfm" "$dir/inside.pfm"
cp "$dir/one.obj" "$dir/-q.obj"
(cd "$dir" && "$lambent" info -- -q.obj >out.txt 2>err.txt)
check "behind -- a word that begins with - is no option" grep -q '^triangles' "$dir/out.txt"
status 2 render demo --visibilty 0.1 -o "$dir/bad.png"
said "unknown option --visibilty; did you mean --visibility?"
status 2 render demo --vis=0.1 -o "$dir/bad.png"
said "unknown option --vis; did you mean --visibility?"
status 2 render demo --nonsense -o "$dir/bad.png"
said "unknown option --nonsense; lambent render --help lists them"
status 2 bench demo --swep tree=8
said "did you mean --sweep?"
status 2 bench demo --shadwo-map 64
said "did you mean --shadow-map?"
status 2 render demo -o="$dir/bad.png"
said "write \`-o $dir/bad.png\`"
status 2 render demo --o=x.png
said "unknown option --o; did you mean -o?"
status 2 render demo -h=1
said "-h takes no value"
status 2 relief baek
said "there is no \`relief baek\`; did you mean relief bake?"
status 2 bench rastr
said "there is no file \`rastr\`; did you mean bench raster?"
status 2 render demo --quality drfat -o "$dir/bad.png"
said "did you mean draft?"
status 2 render demo --light spot:0,0,0:0,-1:1,1,1 -o "$dir/bad.png"
said "[:SIZE] with angles up to 89: its DX,DY,DZ is wrong"
status 2 render demo --samples 3 -o "$dir/bad.png"
said "--samples: \`3\` is not 1, 4, 8 or 16"
check "numbers are not spelling mistakes" sh -c '! grep -q "did you mean" "$1"' sh "$dir/err.txt"
for show in depth normal albedo eye-distance light-distance groups occlusion; do
    status 2 render demo --show $show --samples 4 -o "$dir/bad.png"
    said "--samples 4: only light has a mean over a pixel; --show $show takes one sample"
done
status 0 render demo $small --show depth --samples 1 -o "$dir/sampled.pfm"
check "--samples 1 is what --show depth takes" cmp "$dir/sampled.pfm" "$dir/depth.pfm"
status 2 rendr demo
said "did you mean render?"
status 2 render demo --size 64x48 --size 32x24 -o "$dir/bad.png"
said "--size is given twice, 64x48 and 32x24; leave one out"
status 2 render demo --glossy --glossy -o "$dir/bad.png"
said "--glossy is given twice"
status 2 bench demo --tree 8 --tree=16
said "--tree is given twice"
status 2 render demo --error 0.1 --error-bound 0.1 -o "$dir/bad.png"
said "--error and --error-bound exclude each other"
status 2 render demo -q -v -o "$dir/bad.png"
said "--quiet and --verbose exclude each other"
status 2 render demo --glossy=1 -o "$dir/bad.png"
said "--glossy takes no value"
status 2 render demo --tree=12 -o "$dir/bad.png"
said "--tree: \`12\` is not a power of two, 8 .. 4096"
status 2 render demo --tree
said "--tree wants a value: a power of two, 8 .. 4096"
status 2 render demo demo -o "$dir/bad.png"
said "one word too many: SCENE is \`demo\`"
status 2 render demo -o=bad.png
absent "$dir/bad.png"
# Quiet says nothing, verbose says more; both draw the same.
status 0 render demo --size 64x48 --shadow-map 64 -o "$dir/loud.png"
status 0 render demo --size 64x48 --shadow-map 64 -q -o "$dir/hushed.png"
check "-q says nothing" sh -c '! test -s "$1" && ! test -s "$2"' sh "$dir/out.txt" "$dir/err.txt"
status 0 render demo --size 64x48 --shadow-map 64 -v -o "$dir/told.png"
check "-v says how long what took" grep -q '^lambent: bands .* ms$' "$dir/err.txt"
check "what is said changes no byte" sh -c 'cmp "$1" "$2" && cmp "$1" "$3"' sh "$dir/loud.png" "$dir/hushed.png" "$dir/told.png"
status 0 compare "$dir/demo.pfm" "$dir/again.pfm" -q
check "compare -q is its exit status" sh -c '! test -s "$1"' sh "$dir/out.txt"
for verb in render play capture relight relief "relief bake" "relief render" mix pack merge plan compare info bench "bench raster" "bench gather" \
    "bench threads" "bench hard" "bench --calibrate" "bench demo" "bench relight" "bench relief" "bench mix" doctor; do
    status 0 $verb -V
    check "lambent $verb -V is the version" grep -q '^lambent [0-9.]*$' "$dir/out.txt"
    status 0 $verb -h
    cp "$dir/out.txt" "$dir/help.txt"
    check "$verb --help has under 100 columns" awk 'length($0) > 99 { exit 1 }' "$dir/help.txt"
    # What is pasted works: all lines below `examples` that begin with two blanks, but those that end in a colon.
    mkdir -p "$dir/paste"
    { printf 'set -e\nlambent() { "%s" "$@"; }\n' "$lambent"
      sed -n '/^examples$/,/^exit status/{/^  .*[^:]$/p;}' "$dir/help.txt"; } >"$dir/paste/run.sh"
    check "$verb --help has an example" test "$(grep -c . "$dir/paste/run.sh")" -gt 2
    [ -n "$SHORT" ] || check "$verb --help's example works when pasted" \
        sh -c 'cd "$1" && XDG_CACHE_HOME=. sh ./run.sh >said.txt 2>&1' sh "$dir/paste"
done

# Bad usage.
status 2
status 2 paint
status 2 render
status 2 render demo
status 2 render demo -o "$dir/bad.png" --no-such-flag
status 2 render demo -o "$dir/bad.png" --size 64
status 2 render demo -o "$dir/bad.png" --size 0x48
status 2 render demo -o "$dir/bad.png" --show nonsense
status 2 render demo -o "$dir/bad.png" --show groups --stereo 0.1
status 2 render demo -o "$dir/bad.png" --show occlusion --occlusion none
status 2 render demo -o "$dir/bad.png" --stereo 0
status 2 render demo -o "$dir/bad.png" --thin 65
status 2 render demo -o "$dir/bad.png" --neighbourhood none
status 2 render demo -o "$dir/bad.png" --size
status 2 render demo -o "$dir/bad.tiff"
status 2 compare "$dir/demo.pfm"
status 2 info
status 2 info "$dir/demo.pfm" "$dir/demo.png"
status 2 info "$dir/demo.pfm" --no-such-flag
absent "$dir/bad.png"

# What cannot be done leaves nothing behind.
printf 'no scene' >"$dir/broken.glb"
status 1 render "$dir/nowhere.gltf" -o "$dir/bad.png"
status 1 render "$dir/broken.glb" -o "$dir/bad.png"
absent "$dir/bad.png"
status 2 render demo --size 5000x8 --stereo 0.1 -o "$dir/bad.png"
status 1 render demo $small -o "$dir/nowhere/demo.png"
absent "$dir/nowhere"
mkdir "$dir/folder.png"
status 1 render demo $small -o "$dir/folder.png"
check "folder.png stays an empty folder" rmdir "$dir/folder.png"
status 1 compare "$dir/demo.pfm" "$dir/nowhere.pfm"
status 1 info "$dir/nowhere.glb"
status 1 info "$dir/broken.glb" --json
status 1 info "$dir/nowhere.png"

# A limit on the size of files: a failed write like any other. Some shells count in 512 bytes, some in 1024.
if (ulimit -f 8) 2>/dev/null; then
    echo before >"$dir/kept.pfm"
    (
        ulimit -f 8
        "$TOOL" render demo $small -o "$dir/kept.pfm" >"$dir/out.txt" 2>"$dir/err.txt"
        echo $? >"$dir/status.txt"
    )
    check "a file beyond the limit: exit status 1" test "$(cat "$dir/status.txt")" = 1
    check "a file beyond the limit: one line on stderr" test "$(wc -l <"$dir/err.txt")" -eq 1
    check "a file beyond the limit is named" grep -q 'kept.pfm: cannot be written: ' "$dir/err.txt"
    check "a file beyond the limit: what stood there stays" test "$(cat "$dir/kept.pfm")" = before
else
    skip "a limit on the size of files: this shell sets none"
fi
# Killed at any moment: what stood there stays, or the new file is there, whole (a PFM of 64 x 48 has 36,879 bytes).
"$TOOL" render demo $small -o "$dir/whole.pfm" >/dev/null 2>&1
for wait in 0 0.02 0.05 0.1 0.2; do
    echo before >"$dir/killed.pfm"
    "$TOOL" render demo $small -o "$dir/killed.pfm" >/dev/null 2>&1 &
    sleep $wait 2>/dev/null
    kill -9 $! 2>/dev/null
    wait $! 2>/dev/null
    check "killed after $wait s: a whole file" sh -c 'test "$(cat "$1")" = before || cmp -s "$1" "$2"' sh "$dir/killed.pfm" \
        "$dir/whole.pfm"
done
find "$dir" \( -name '*killed*tmp*' -o -name '.write-*.tmp' \) -exec rm -f {} + # of those that were killed

# A reader that goes away: the tool ends, with its own status or by the signal, and does not go on.
check "a closed pipe ends the tool" sh -c '"$1" bench hard mixed | head -n 1 | grep -q "^group"' sh "$TOOL"

left=$(find "$dir" -name '*tmp*' -o -name 'bad*' -o -name 'nowhere*')
check "left behind: $left" test -z "$left"
# The picture does not depend on how many threads draw it, nor on the backend.
for option in "--threads 1 --profile exact" "--threads 3" "--backend scalar"; do
    check "render demo $option" "$TOOL" render demo --size 64x48 --shadow-map 128 --exposure 0 $option -o "$dir/way.ppm"
    cp "$dir/way.ppm" "$dir/way$((ways = ways + 1)).ppm"
done
check "threads change the picture" cmp "$dir/way1.ppm" "$dir/way2.ppm"
check "a backend changes the picture" cmp "$dir/way1.ppm" "$dir/way3.ppm"
# A world of one radiance gives pi times that to every normal, from any place, by any filter.
one='\000\000\200\077'
{ printf 'PF\n1 6\n-1.0\n'; i=0; while [ $i -lt 18 ]; do printf "$one"; i=$((i + 1)); done; } > "$dir/white.pfm"
{ printf 'PF\n1 1\n-1.0\n'; printf "$one$one$one"; } > "$dir/facepx.pfm"
for filter in cosine sh9 sh16 sh25 blur blur1 blur2; do
    status 0 relight --world "$dir/white.pfm" --at 30,2,-9 --filter $filter --faces 3 --cube "$dir/cube.pfm"
    check "relight --filter $filter is pi" sh -c '"$1" info "$2" | grep -c "min 3.14159 .*max 3.14159 " | grep -qx 3' sh "$TOOL" "$dir/cube.pfm"
done
status 0 relight --world "$dir/face" --world-box -1,-1,-1,1,1,1 --cube "$dir/cube.png" --map "$dir/map.pfm"
check "where faces are missing it is dark" sh -c '"$1" info "$2" | grep -q "red   min 0 *max 0.9"' sh "$TOOL" "$dir/map.pfm"
for option in "--storage log8" "--storage log16" "--overlap mean" "--backend scalar" "--ground $dir/facepx.pfm --ground-size 4,4"; do
    status 0 relight --world "$dir/white.pfm" $option --cube "$dir/cube.pfm"
done
status 1 relight --world "$dir/nowhere" --cube "$dir/bad.pfm"
status 1 relight --world "$dir/facepx.pfm" --cube "$dir/bad.pfm"
status 1 relight --world "$dir/white.pfm" --world-centre 9,0,0 --world-sphere 0,0,0,5 --cube "$dir/bad.pfm"
status 1 relight --world "$dir/white.pfm" --ground "$dir/nowhere.png" --cube "$dir/bad.pfm"
status 2 relight --world "$dir/white.pfm"
status 2 relight --world "$dir/white.pfm" --cube "$dir/bad.txt"
status 2 relight --world "$dir/white.pfm" --cube "$dir/bad.pfm" --faces 65
status 2 relight --world "$dir/white.pfm" --cube "$dir/bad.pfm" --filter sh4
status 2 relight --cube "$dir/bad.pfm"
status 0 relight --help
# Objects in the built-in world: normal and glossy are the parts of both, everywhere; places along a path.
field="relight --world demo --object demo --size 48x24 --exposure 0"
for show in both normal glossy; do
    status 0 $field --show $show -o "$dir/field-$show.pfm"
done
check "glossy alone is darker than both" sh -c '"$1" compare "$2" "$3" --json | grep -q "\"mean\":0\.[0-9]"' sh "$TOOL" "$dir/field-glossy.pfm" "$dir/field-both.pfm"
status 0 $field --backend scalar -o "$dir/field-scalar.pfm"
check "a backend changes the field" cmp "$dir/field-both.pfm" "$dir/field-scalar.pfm"
status 0 $field --at 3,0,1 --roughness 0 --f0 0.9 --per-part --light sun:0,0,0:-1,-1,0:2,2,2 --cube "$dir/cube.pfm" -o "$dir/field.png"
printf '# a walk\n0,0,0\n0.1,0,0\n\n 1,0,0 \n1,0,0' >"$dir/path.txt"
status 0 $field --path "$dir/path.txt" -o "$dir/walk.ppm"
check "a walk keeps its light while it is near" grep -q '^light computed 2 times, kept 2 times$' "$dir/out.txt"
check "a walk has a picture a place" sh -c 'test -s "$1/walk-0000.ppm" && test -s "$1/walk-0003.ppm" && ! test -e "$1/walk-0004.ppm"' sh "$dir"
status 0 $field --path "$dir/path.txt" --reuse 0 -o "$dir/walk.ppm"
check "a walk without reuse is computed until it rests" grep -q '^light computed 3 times, kept 1 times$' "$dir/out.txt"
status 0 $field --path "$dir/path.txt" --reuse 5 --keep 0,0.9,0 -o "$dir/walk.ppm"
check "a named place serves the whole walk" grep -q '^light computed 1 times, kept 3 times$' "$dir/out.txt"
printf '2,0,1\n2.2,0,1\n2,0,1\n' >"$dir/path.txt"
for parts in "" --per-part; do
    status 0 $field --path "$dir/path.txt" --keep 2,0,1 $parts -o "$dir/walk.ppm"
    check "a named place is where an object stands $parts" sh -c 'test "$(grep -c "  kept$" "$1")" = 1' sh "$dir/out.txt"
done
status 0 $field --path "$dir/path.txt" -o "$dir/walk.ppm"
status 0 $field --path "$dir/path.txt" -o "$dir/step_%03d.ppm"
check "a walk's pictures are numbered by the pattern" cmp "$dir/step_002.ppm" "$dir/walk-0002.ppm"
cp "$dir/white.pfm" "$dir/bad_001.pfm" # what the second picture would replace is read
status 2 relight --world "$dir/bad_001.pfm" --object demo --size 16x8 --path "$dir/path.txt" -o "$dir/bad_%03d.pfm"
said "bad_001.pfm: cannot be written: it is read"
check "no picture is drawn where one of them cannot be written" test ! -e "$dir/bad_000.pfm"
rm -f "$dir/bad_001.pfm"
status 2 $field -o "$dir/bad_%04d.ppm"
check "a pattern wants a path" grep -q 'numbers pictures of a --path' "$dir/err.txt"
printf '0,0,0\n1,2\n' >"$dir/path.txt"
status 1 $field --path "$dir/path.txt" -o "$dir/bad.ppm"
check "a path's error names its line" grep -q 'path.txt:2: `1,2` is not X,Y,Z' "$dir/err.txt"
status 1 $field --path "$dir/nowhere" -o "$dir/bad.ppm"
status 1 relight --world demo --object "$dir/nowhere.glb" -o "$dir/bad.ppm"
status 2 $field --path "$dir/path.txt" --at 0,0,0 -o "$dir/bad.ppm"
for option in "--world-sphere 0,0,0,5" "--world-centre 0,1,0" "--ground-size 5,5" "--ground-height 1"; do
    status 2 $field $option -o "$dir/bad.ppm"
    check "the built-in world says that it lies where it lies: $option" grep -q 'lies where it lies' "$dir/err.txt"
done
status 2 relight --world demo --object demo
# What objects take of the ground's light and their own: nothing gets brighter, the ground right below gets darker.
printf 'v -1 0.5 -1\nv 1 0.5 -1\nv 1 0.5 1\nv -1 0.5 1\nf 1 2 3 4\n' >"$dir/table.obj"
low="relight --world $dir/white.pfm --ground $dir/facepx.pfm --ground-size 40,40 --object $dir/table.obj --f0 0 --at 0,0.5,0 --eye 0,0.3,2.5 --target 0,0.1,0 --size 48x24"
status 0 $low -o "$dir/bright.pfm"
status 0 $low --contact -o "$dir/dark.pfm"
check "the ground is darker below a table" sh -c '"$1" compare "$2" "$3" --json | grep -q "\"mean\":0\.[89]"' sh "$TOOL" "$dir/dark.pfm" "$dir/bright.pfm"
status 0 $low --contact --threads 1 --backend scalar -o "$dir/alike.pfm"
check "a backend changes no contact" cmp "$dir/dark.pfm" "$dir/alike.pfm"
printf '0,0.5,0\n3,0.5,0\n0,0.5,0\n' >"$dir/path.txt"
status 0 relight --world "$dir/white.pfm" --ground "$dir/facepx.pfm" --ground-size 40,40 --object "$dir/table.obj" --f0 0 --contact --path "$dir/path.txt" --eye 0,0.3,2.5 --target 0,0.1,0 --size 48x24 -o "$dir/walk.pfm"
check "contact goes with what moves" sh -c 'cmp "$1/walk-0000.pfm" "$1/walk-0002.pfm" && ! cmp -s "$1/walk-0000.pfm" "$1/walk-0001.pfm"' sh "$dir"
status 0 relight --world "$dir/white.pfm" --object demo --contact --size 16x8 -o "$dir/field.png"
# A ground of radiance 1 that shines at night: it receives what it sends up at least, so a white box adds a part of that.
printf 'v -1 0 -1\nv 1 0 -1\nv 1 2 -1\nv -1 2 -1\nv -1 0 1\nv 1 0 1\nv 1 2 1\nv -1 2 1\nf 1 4 3 2\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nf 5 6 7 8\n' >"$dir/white_box.obj"
{ printf 'PF\n1 6\n-1.0\n'; head -c 72 /dev/zero; } >"$dir/night.pfm"
{ printf 'PF\n1 6\n-1.0\n'; i=0; while [ $i -lt 18 ]; do printf '\012\327\243\074'; i=$((i + 1)); done; } >"$dir/dusk.pfm" # 0.02
for sky in night dusk; do
    status 0 relight --world "$dir/$sky.pfm" --ground "$dir/facepx.pfm" --ground-size 40,40 --object "$dir/white_box.obj" --f0 0 --contact --eye 0,4,9 --target 0,0.5,0 --size 64x48 -o "$dir/glow.pfm"
    check "contact lights a bright ground by a part of its own light: $sky" sh -c '"$1" info "$2" | awk "/ max /{ n += \$5 > 1.05 && \$5 < 1.5 } END { exit n != 3 }"' sh "$TOOL" "$dir/glow.pfm"
done
# What blocks light is as dark as its texture or its corners' colours make it: a U of three boxes in one dark grey.
grey_png='\211\120\116\107\015\012\032\012\000\000\000\015\111\110\104\122\000\000\000\001\000\000\000\001\010\002\000\000\000\220\167\123\336\000\000\000\014\111\104\101\124\170\234\143\210\214\214\004\000\002\032\001\014\047\014\256\360\000\000\000\000\111\105\116\104\256\102\140\202'
printf "$grey_png" >"$dir/grey.png" # one texel, 89: 0.0998987 in linear light
chess_png='\211\120\116\107\015\012\032\012\000\000\000\015\111\110\104\122\000\000\000\002\000\000\000\002\010\000\000\000\000\127\335\122\370\000\000\000\016\111\104\101\124\170\332\143\370\317\300\300\360\037\000\006\000\001\377\145\064\370\367\000\000\000\000\111\105\116\104\256\102\140\202'
printf "$chess_png" >"$dir/chess.png" # two by two texels, white and black: 0.5 in the mean
printf 'newmtl flat\nKd 0.0998987 0.0998987 0.0998987\nnewmtl paper\nmap_Kd grey.png\nnewmtl corners\nKd 1 1 1\nnewmtl half\nKd 0.5 0.5 0.5\nnewmtl chess\nmap_Kd chess.png\n' >"$dir/grey.mtl"
for grey in flat paper corners half chess; do
    ink=1 && [ $grey = corners ] && ink=0.0998987
    awk -v ink=$ink -v grey=$grey 'BEGIN {
        print "mtllib grey.mtl\nusemtl " grey "\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1"
        split("-1 0 1 0.2 -1 0.2 -0.7 1.2 0.7 0.2 1 1.2", b, " "); split("1 4 3 2 1 2 6 5 2 3 7 6 3 4 8 7 4 1 5 8 5 6 7 8", f, " ")
        for (i = 0; i < 3; ++i)
            for (k = 0; k < 8; ++k)
                print "v " b[4 * i + (k % 4 == 1 || k % 4 == 2 ? 3 : 1)] " " b[4 * i + (k % 4 > 1 ? 4 : 2)] " " (k < 4 ? -1 : 1) " " ink " " ink " " ink
        for (i = 0; i < 18; ++i) {
            line = "f"
            for (k = 1; k <= 4; ++k) line = line " " f[4 * (i % 6) + k] + 8 * int(i / 6) "/" k
            print line
        }
    }' >"$dir/grey_$grey.obj"
done
lit="--world $dir/white.pfm --ground $dir/facepx.pfm --ground-size 40,40 --f0 0 --contact --size 48x32"
for grey in flat paper corners; do
    status 0 relight $lit --object "$dir/grey_$grey.obj" --eye 0,2,3 --target 0,0.5,0 -o "$dir/grey_$grey.pfm"
    [ $grey = flat ] || check "contact knows how dark $grey is" sh -c '"$1" compare "$2" "$3" | grep -q "^trim 0\.00[0-2]"' sh "$TOOL" "$dir/grey_$grey.pfm" "$dir/grey_flat.pfm"
done
for grey in flat half chess; do
    status 0 relight $lit --object "$dir/grey_$grey.obj" --eye 2,2,2 --target 2,0,0 --fov 20 -o "$dir/grey_$grey.pfm"
done
check "the ground beside a pattern is as bright as beside its mean" sh -c '"$1" compare "$2" "$3" | grep -q "^trim 0\.000"' sh "$TOOL" "$dir/grey_chess.pfm" "$dir/grey_half.pfm"
check "and not as beside a darker one" sh -c '! "$1" compare "$2" "$3" | grep -q "^trim 0\.000"' sh "$TOOL" "$dir/grey_chess.pfm" "$dir/grey_flat.pfm"
# Lobes mirror the ground as dark as it is.
shiny="$(echo "$low" | sed 's/--f0 0 /--f0 0.9 --roughness 0.2 /;s/0,0.3,2.5 --target 0,0.1,0/0.1,0.05,0.3 --target 0,0.5,0/') --show glossy"
status 0 $shiny -o "$dir/shiny.pfm"
status 0 $shiny --contact -o "$dir/dull.pfm"
check "a lobe is darker below a table" sh -c '"$1" compare "$2" "$3" --json | grep -q "\"mean\":0\.[5-9]"' sh "$TOOL" "$dir/dull.pfm" "$dir/shiny.pfm"
# A small lamp in a white world, on the border of two of its map's texels; two bowls with smooth normals over a ground that
# ends its shadow within the picture. Each constant of contact moves some of these pixels.
row=$one$one$one$one; row=$row$row$row; row=$row$row$row$row$row$row$row$row
lamp='\000\000\172\104\000\000\172\104\000\000\172\104'
{ printf 'PF\n32 192\n-1.0\n'; i=0; while [ $i -lt 192 ]; do
    if [ $i -eq 180 ]; then printf "$lamp"; printf "$row" | tail -c 372; else printf "$row"; fi
    i=$((i + 1))
done; } >"$dir/lamp_world.pfm"
printf 'v 0 0 0\nv 1 0.3 -1\nv -1 0.3 -1\nv -1 0.3 1\nv 1 0.3 1\nvn 0 1 0\nvn -0.5 0.7 0.5\nvn 0.5 0.7 0.5\nvn 0.5 0.7 -0.5\nvn -0.5 0.7 -0.5\nf 1//1 2//2 3//3\nf 1//1 3//3 4//4\nf 1//1 4//4 5//5\nf 1//1 5//5 2//2\n' >"$dir/bowl.obj"
printf '0,0.2,0\n' >"$dir/path.txt"
status 0 relight --world "$dir/lamp_world.pfm" --ground "$dir/facepx.pfm" --ground-size 60,60 --object "$dir/bowl.obj" --f0 0.2 --roughness 0.3 --contact --at 0,0.2,0 --at 2.1,1.0,0 --eye 1,4,5 --target 1,0,0 --size 64x48 -o "$dir/bowls.pfm"
contact_sum=$(cksum <"$dir/bowls.pfm")
check "contact's pixels are these: $contact_sum" test "$contact_sum" = "2008633955 36878"
# What a place of a scene sees, for relight: in a box that shines from within alike, any place receives pi.
printf 'newmtl lamp\nKd 0 0 0\nKe 1 1 1\n' >"$dir/lamp.mtl"
printf 'mtllib lamp.mtl\nusemtl lamp\nv -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\nf 1 4 3 2\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nf 5 6 7 8\n' >"$dir/lamp.obj"
status 0 capture "$dir/lamp.obj" --at 0.2,0.1,0 --faces 8 --samples 1 --world none -o "$dir/lamp.pfm" --ground "$dir/under.pfm"
taken=$(cat "$dir/out.txt")
status 0 relight $taken --at 0.5,0,-0.5 --cube "$dir/cube.pfm"
check "a shining box is pi everywhere" sh -c '"$1" info "$2" | grep -c "min 3.14159 .*max 3.14159 " | grep -qx 3' sh "$TOOL" "$dir/cube.pfm"
# The eye where the cube was taken sees the scene's own picture: each face the right way round.
look="--size 32x32 --fov 90 --eye 0.6,1.1,0.2"
status 0 capture demo --at 0.6,1.1,0.2 --faces 64 --samples 1 --shadow-map 128 --quality draft -o "$dir/room.pfm"
taken=$(cat "$dir/out.txt")
for way in 1,0,0:0,1,0 -1,0,0:0,1,0 0,1,0:0,0,1 0,-1,0:0,0,-1 0,0,1:0,1,0 0,0,-1:0,1,0; do
    to=$(echo "${way%:*}" | awk -F, '{ print 0.6 + $1 "," 1.1 + $2 "," 0.2 + $3 }')
    status 0 render demo $look --target "$to" --up "${way#*:}" --shadow-map 128 --quality draft -o "$dir/seen.pfm"
    status 0 relight $taken --object "$dir/lamp.obj" --scale 0.001 --at 90,0,0 $look --target "$to" --up "${way#*:}" -o "$dir/shown.pfm"
    check "relight says nothing of options that it lacks" sh -c '! grep -q "emissive\|--glossy\|--grouping" "$1"' sh "$dir/err.txt"
    check "the cube shows what is seen towards $way" sh -c '"$1" compare "$2" "$3" --max e50=0.15' sh "$TOOL" "$dir/shown.pfm" "$dir/seen.pfm"
done
status 0 capture demo --at 0.6,1.1,0.2 --at 0.3,0.8,0.4 --faces 8 --samples 1 --shadow-map 128 --quality draft -o "$dir/two_%02d.pfm"
two=$(cat "$dir/out.txt")
status 0 relight $two --at 0.45,1,0.3 --cube "$dir/both.pfm" --map "$dir/map.pfm"
status 0 relight $two --at 0.3,0.8,0.4 --cube "$dir/second.pfm"
status 0 relight --world "$dir/two_01.pfm" --world-centre 0.3,0.8,0.4 ${two#*0.4 } --at 0.3,0.8,0.4 --cube "$dir/alone.pfm"
check "where a cube was taken it counts alone" sh -c '"$1" compare "$2" "$3" --max trim=0.001' sh "$TOOL" "$dir/second.pfm" "$dir/alone.pfm"
check "between two it is of both" sh -c '! "$1" compare "$2" "$3" --max trim=0.01 >"$4"' sh "$TOOL" "$dir/both.pfm" "$dir/alone.pfm" "$dir/out.txt"
status 0 relight $two --object demo --scale 0.3 --at 0.45,0.5,0.3 --eye 0.6,1,1 --target 0.45,0.6,0.3 --size 16x16 -o "$dir/both.ppm"
status 2 relight --world "$dir/two_00.pfm" --world "$dir/two_01.pfm" --cube "$dir/bad.pfm"
status 2 relight --world demo --world "$dir/two_01.pfm" --world-centre 0,0,0 --world-centre 0,0,0 --cube "$dir/bad.pfm"
status 2 capture demo --at 0.6,1.1,0.2
status 2 capture demo -o "$dir/bad.pfm"
status 2 capture demo --at 0.6,1.1,0.2 -o "$dir/bad.png"
status 2 capture demo --at 0.6,1.1,0.2 -o "$dir/bad_%02d.pfm"
status 2 capture demo --at 0.6,1.1,0.2 --at 0,1,0 -o "$dir/bad.pfm"
status 2 capture demo --at 0.6,1.1,0.2 -o "$dir/bad.pfm" --ground-height 1
status 1 capture demo --at 0.6,1.1,0.2 -o "$dir/bad.pfm" --ground "$dir/bad.hdr" --ground-height 2
status 1 capture "$dir/nowhere.obj" --at 0,0,0 -o "$dir/bad.pfm"
status 2 $field --eye 0,1,2 -o "$dir/bad.ppm"
status 2 $field --roughness 2 -o "$dir/bad.ppm"
status 2 $field --at 3e6,0,0 -o "$dir/bad.ppm"
status 0 $field --ground "$dir/facepx.pfm" --faces 4 --at 0,0,0 -o "$dir/field.png"
if [ -e /dev/full ]; then
    printf '0,0,0\n' >"$dir/path.txt"
    check "a full disk is an error of a walk" sh -c '! "$1" relight --world demo --object demo --size 16x8 --path "$2" -o "$3" >/dev/full 2>/dev/null' sh "$TOOL" "$dir/path.txt" "$dir/walk.ppm"
fi
status 2 $field -o "$dir/bad.gif"
check "nothing was left behind" sh -c '! ls "$1"/bad* 2>/dev/null | grep -q .' sh "$dir"
# A box with a pit, as six triangles more than a cube has, on a box of its own.
printf 'v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\nv 0 0 0.3\nf 1 4 3 2\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nf 5 6 9\nf 6 7 9\nf 7 8 9\nf 8 5 9\n' >"$dir/pit.obj"
printf 'v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\nf 1 4 3 2\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nf 5 6 7 8\n' >"$dir/box.obj"
printf '# eye, target, degrees\n0 0 5 0 0 0 40\n\n3 2 4 0 0 0 40\n' >"$dir/cameras.txt"
# bit FILE AT OUT: the file, its byte at AT with another lowest bit.
bit() {
    value=$(od -An -tu1 -j"$2" -N1 "$1" | tr -d ' ')
    # shellcheck disable=SC2059
    { head -c "$2" "$1"; printf "\\$(printf %03o $((value / 2 * 2 + 1 - value % 2)))"; tail -c +$(($2 + 2)) "$1"; } >"$3"
}
status 0 relief bake "$dir/pit.obj" -o "$dir/pit.lmr" --simple "$dir/box.obj" --size 32
check "relief bake tells what it saw" grep -q 'as 12, 26 views of 32 x 32, .* bytes' "$dir/out.txt"
bit "$dir/pit.lmr" 3000 "$dir/bit.lmr"
status 1 relief render "$dir/bit.lmr" -o "$dir/bad.png"
said "bit.lmr: a damaged .lmr file"
status 1 info "$dir/bit.lmr"
status 0 info "$dir/pit.lmr"
check "info knows reliefs" grep -q '^views  *[1-9][0-9]*, with sides of 32 to 32 texels, full$' "$dir/out.txt"
status 0 info "$dir/pit.lmr" --json
check "and those as JSON" grep -q '^{.*"kind":"relief".*"shortest_side":32,.*"packed":false,"min":.*}$' "$dir/out.txt"
sed 's/1/0.9/g' "$dir/box.obj" | sed 's/^f.*//' >"$dir/less.obj"
grep '^f' "$dir/box.obj" >>"$dir/less.obj"
status 0 relief bake "$dir/pit.obj" -o "$dir/less.lmr" --simple "$dir/less.obj" --as-is --size 16
check "a simple model that is too small is told" grep -q 'sticks out of the simple one by 0.1[67]' "$dir/err.txt"
status 0 relief bake "$dir/pit.obj" -o "$dir/less.lmr" --simple "$dir/less.obj" --size 16
check "and else moved outwards" sh -c '! grep -q "sticks out" "$1"' sh "$dir/err.txt"
# Views in perspective: a world a thousand times as large gives the same picture, to the bit.
awk '/^v /{print "v", $2 * 1024, $3 * 1024, $4 * 1024; next} {print}' "$dir/pit.obj" >"$dir/vast.obj"
printf '%s\n' '-4 0 0 0 0 0 45' '4 0 0 0 0 0 45' '0 4 1 0 0 0 45' '0 -4 1 0 0 0 45' '0 0 4 0 0 0 45' '2 2 3 0 0 0 45' >"$dir/views.txt"
awk '{print $1 * 1024, $2 * 1024, $3 * 1024, $4, $5, $6, $7}' "$dir/views.txt" >"$dir/vast.txt"
for size in pit vast; do
    status 0 relief bake "$dir/$size.obj" --views "$dir/$(test $size = pit && echo views || echo vast).txt" --size 64 -o "$dir/seen.lmr"
    status 0 relief render "$dir/seen.lmr" --eye $(test $size = pit && echo 1.5,2,5 || echo 1536,2048,5120) --target 0,0,0 \
        --size 64x64 --show normal -o "$dir/$size-normal.pfm"
done
check "a relief of any size looks the same" cmp -s "$dir/pit-normal.pfm" "$dir/vast-normal.pfm"
# Without normals it is flat, as in `lambent render`: a box has one colour in front, but at its rim.
status 0 relief bake "$dir/box.obj" -o "$dir/box.lmr" --triangles 12 --size 32
status 0 relief render "$dir/box.lmr" --eye 0,0,5 --target 0,0,0 --size 32x32 --show normal -o "$dir/box.ppm"
check "a relief of a box is flat" test "$(tail -c 3072 "$dir/box.ppm" | od -An -v -tx1 -w3 | sort | uniq -c | sort -rn | awk 'NR == 2 { print $1 }')" -ge 300
status 2 relief render "$dir/pit.lmr" -o "$dir/bad.png" --with "$dir/box.obj" --compare "$dir/pit.obj"
status 0 relief render "$dir/pit.lmr" -o "$dir/pit.png" --eye 1.5,2,5 --target 0,0,0 --size 64x64 --compare "$dir/pit.obj"
check "relief render --compare shows both" grep -q 'pixels, ms  *[0-9.]*  *[0-9.]*$' "$dir/out.txt"
status 0 relief render "$dir/pit.lmr" -o "$dir/pit.pfm" --pick eye-ray --sampling nearest --show depth --size 40x30 --with "$dir/box.obj" --light point:3,3,3:0,-1,0:90,90,90
printf 'v -4 -1 4\nv 4 -1 4\nv 4 -1 -4\nv -4 -1 -4\nf 1 2 3 4\n' >"$dir/floor.obj"
for more in '' --bounce; do
    status 0 relief render "$dir/pit.lmr" -o "$dir/floor$more.pfm" --with "$dir/floor.obj" --ambient 0 --size 40x30 $more
done
check "bounced light adds some" sh -c '! cmp -s "$1" "$2"' sh "$dir/floor.pfm" "$dir/floor--bounce.pfm"
for views in 14 greedy:5 "$dir/cameras.txt"; do
    status 0 relief bake "$dir/pit.obj" -o "$dir/pit.lmr" --triangles 20 --size 16 --packed --views $views
    status 0 relief render "$dir/pit.lmr" -o "$dir/pit.ppm" --size 40x30 --shadow-map 0 --steps 1 --pixel-views 2 --keep 1
done
# Along a path: each picture is the one that its camera and light give alone.
sun=sun:0,0,0:0.6,-0.64,-0.48:3,2.9,2.7
printf '# keys\n0 camera 1.5,2,5 0,0,0\n1 camera 4,1,3 0,0,0\n0 light 0,0,0 1,-1,0\n1 light 0,0,0 0.6,-0.64,-0.48\n' >"$dir/keys.txt"
status 0 relief render "$dir/pit.lmr" --path "$dir/keys.txt" --fps 2 --size 40x30 -o "$dir/lap_%02d.pfm"
check "a relief's path is drawn to its last key" sh -c 'test -s "$1/lap_02.pfm" && ! test -e "$1/lap_03.pfm"' sh "$dir"
check "a relief's pictures are told by name" grep -q 'lap_01.pfm$' "$dir/out.txt"
status 0 relief render "$dir/pit.lmr" --eye 4,1,3 --target 0,0,0 --light $sun --size 40x30 -o "$dir/one.pfm"
check "a relief's last picture is that of its last keys" cmp "$dir/one.pfm" "$dir/lap_02.pfm"
check "a relief moves between keys" sh -c '! cmp -s "$1/lap_00.pfm" "$1/lap_01.pfm" && ! cmp -s "$1/lap_01.pfm" "$1/lap_02.pfm"' sh "$dir"
status 0 relief render "$dir/pit.lmr" --path "$dir/keys.txt" --fps 2 --frames 2 --size 40x30 -q -o "$dir/lap.pfm"
check "a relief's pictures are numbered without a pattern" sh -c 'cmp "$1/lap-0001.pfm" "$1/lap_01.pfm" && ! test -e "$1/lap-0002.pfm"' sh "$dir"
status 2 relief render "$dir/pit.lmr" -o "$dir/bad_%04d.png"
said "numbers pictures of a --path, and none is given"
status 2 relief render "$dir/pit.lmr" --fps 3 -o "$dir/bad.png"
said "--frames and --fps are of a --path"
status 2 relief render "$dir/pit.lmr" --path "$dir/keys.txt" -o -
status 2 relief render "$dir/pit.lmr" --path "$dir/keys.txt" --compare "$dir/pit.obj" -o "$dir/bad.png"
status 1 relief render "$dir/pit.lmr" --path "$dir/nowhere.txt" -o "$dir/bad.png"
status 0 relief render "$dir/pit.lmr" --path "$dir/keys.txt" --frames 2 --size 40x30 -v -o "$dir/50%_%02d.pfm"
check "the time of a path's pictures is told" grep -q 'a picture in the mean: shadow map [0-9.]* ms, triangles [0-9.]* ms, pixels [0-9.]* ms' "$dir/err.txt"
check "a number is found after another %" test -s "$dir/50%_01.pfm"
status 1 relief render "$dir/pit.lmr" --path "$dir/keys.txt" --eye 1,2,3 --target 0,0,0 -o "$dir/bad.png"
said "keys.txt:2: the camera goes and looks by these keys; leave --eye and --target out"
printf '0 camera 1,2,5\n11 camera 2,2,5\n' >"$dir/keys.txt"
status 0 relief render "$dir/pit.lmr" --path "$dir/keys.txt" --eye 1,2,3 --target 0,0,0 --frames 1 --size 16x16 -o "$dir/looks.pfm"
status 1 relief render "$dir/pit.lmr" --path "$dir/keys.txt" --fps 1e5 -o "$dir/bad.png"
said "keys.txt: 1100001 pictures to its last key, of which 1000000 can be drawn"
# keys_refused KEYS WORDS: a path that a relief cannot follow.
keys_refused() {
    printf "$1" >"$dir/keys.txt"
    status 1 relief render "$dir/pit.lmr" --path "$dir/keys.txt" --fps 2 -o "$dir/bad.png"
    said "$2"
}
keys_refused '0 camera 1,2,5 0,0,0\n1 camera 0,9,0 0,0,0\n' "at frame 2 the camera looks along what is up"
keys_refused '0 object:1 0,0,0\n' "keys.txt:1: a relief has a camera and a light"
keys_refused '0 light 0,0,0\n' "keys.txt:1: the light is a sun"
keys_refused '0 camera 0,9,0 0,0,0\n' "at frame 0 the camera looks along what is up"
printf '0 camera 0,0,9 0,0,0\n1 camera 0,0,-9 0,0,0\n2 camera 0,0,9 0,0,0\n' >"$dir/lap_00.pfm"
status 2 relief render "$dir/pit.lmr" --path "$dir/lap_00.pfm" -o "$dir/lap_%02d.pfm"
said "lap_00.pfm: cannot be written: it is read"
status 1 relief bake "$dir/nowhere.obj" -o "$dir/bad.lmr"
sed 's/\([0-9.]\{1,\}\)/\1e-10/g; /^[^v]/s/e-10//g' "$dir/pit.obj" >"$dir/speck.obj"
status 1 relief bake "$dir/speck.obj" -o "$dir/bad.lmr" --simple "$dir/speck.obj" --as-is --size 16
status 1 relief bake "$dir/pit.obj" -o "$dir/bad.lmr" --views "$dir/nowhere.txt"
status 1 relief render "$dir/box.obj" -o "$dir/bad.png"
check "who failed is told" grep -q '^lambent relief render: ' "$dir/err.txt"
status 1 relief render "$dir/pit.lmr" -o "$dir/bad.png" --compare "$dir/nowhere.obj"
status 2 relief
status 2 relief bake "$dir/pit.obj"
status 2 relief bake "$dir/pit.obj" -o "$dir/bad.lmr" --size 7
status 2 relief bake "$dir/pit.obj" -o "$dir/bad.lmr" --views 65
status 2 relief bake "$dir/pit.obj" -o "$dir/bad.lmr" --as-is
status 2 relief render "$dir/pit.lmr"
status 2 relief render "$dir/pit.lmr" -o "$dir/bad.png" --pick q
status 2 relief render "$dir/pit.lmr" -o "$dir/bad.png" --eye 1,2,3
status 2 relief render "$dir/pit.lmr" -o "$dir/bad.png" --shadow-map 12
status 0 relief --help
status 0 relief bake --help
status 0 relief render --help
# Baked light of the box, empty and with a block in it: as bright as by the ordinary way, and the same by any threads.
awk '/^v/ { v[++n] = $0; print } /^f/ { f[++m] = $0; print }
    END { for (i = 1; i <= n; ++i) { split(v[i], p, " "); print "v", 0.3 * p[2] + 0.3, 0.3 * p[3] - 0.69, 0.3 * p[4] + 0.2 }
          for (i = 1; i <= m; ++i) { split(f[i], p, " "); print "f", p[2] + n, p[3] + n, p[4] + n, p[5] + n } }' \
    "$dir/box.obj" >"$dir/block.obj"
inside="--eye -0.8,0.6,-0.8 --target 0.3,-0.6,0.3 --size 64x48 --light point:0.2,0.5,0:0,-1,0:5,4,3 --show indirect"
for room in box:256:200 block:1024:1000; do
    name=${room%%:*} receivers=${room##*:} elements=${room#*:}
    elements=${elements%:*}
    for threads in 1 2; do
        status 0 bake "$dir/$name.obj" -o "$dir/$name-$threads.lmt" --elements $elements --receivers $receivers --threads $threads
    done
    check "bake tells what it made" grep -q "$name-2.lmt: .* elements, .* receivers, .* MB" "$dir/out.txt"
    check "bakes of $name by one and two threads are equal" cmp -s "$dir/$name-1.lmt" "$dir/$name-2.lmt"
    status 0 render "$dir/$name.obj" $inside --quality draft -o "$dir/$name-draft.pfm"
    status 0 render "$dir/$name.obj" $inside --transfer "$dir/$name-1.lmt" -o "$dir/$name-baked.pfm"
    status 0 compare "$dir/$name-baked.pfm" "$dir/$name-draft.pfm" --max lo=0.95,hi=1.05,trim=0.06
    status 0 render "$dir/$name.obj" $inside --transfer "$dir/$name-1.lmt" --threads 1 -o "$dir/$name-again.pfm"
    check "baked light by any threads is equal" cmp -s "$dir/$name-baked.pfm" "$dir/$name-again.pfm"
done
# A closed room that no light or camera of the scene sees into is dark, but where --eye is in it.
status 0 bake "$dir/box.obj" -o "$dir/eye.lmt" --elements 256 --receivers 200 --eye 5,0,0
status 0 render "$dir/box.obj" $inside --transfer "$dir/eye.lmt" -o "$dir/dark.pfm"
check "a closed room that nothing sees into is dark" sh -c '! "$1" compare "$2" "$3" --max lo=0.01 >/dev/null' sh "$TOOL" \
    "$dir/dark.pfm" "$dir/box-draft.pfm"
status 0 bake "$dir/box.obj" -o "$dir/eye.lmt" --elements 256 --receivers 200 --eye 5,0,0 --eye 0.2,0.5,0
status 0 render "$dir/box.obj" $inside --transfer "$dir/eye.lmt" -o "$dir/lit.pfm"
status 0 compare "$dir/lit.pfm" "$dir/box-draft.pfm" --max lo=0.95,hi=1.05,trim=0.06
status 2 bake "$dir/box.obj" -o "$dir/bad.lmt" --eye 5,0
# Long slivers: narrow strips over a floor, and splinters beside them as a mesh has.
strips() { # strips STRIPS SPLINTERS ELEMENTS: how many elements they get, in `elements`.
    awk -v strips=$1 -v splinters=$2 'BEGIN {
        print "v -2 0 2\nv 2 0 2\nv 2 0 -2\nv -2 0 -2\nf -4 -3 -2 -1"
        for (i = 0; i < strips; ++i) {
            z = -1.9 + 3.8 * i / strips
            printf "v -1.5 0.5 %.5f\nv 1.5 0.5 %.5f\nv 1.5 0.5 %.5f\nv -1.5 0.5 %.5f\nf -4 -3 -2 -1\n", z + 0.002, z + 0.002, z, z
        }
        for (i = 0; i < splinters; ++i) {
            x = -1.95 + 0.0003 * i
            printf "v %.5f 1 1.9\nv %.5f 1 1.9\nv %.5f 1 1.86\nf -3 -2 -1\n", x, x + 0.0002, x
        }
    }' >"$dir/strips.obj"
    status 0 bake "$dir/strips.obj" -o "$dir/strips.lmt" --elements $3 --receivers 3000
    elements=$(sed -n 's/.*: \([0-9]*\) elements.*/\1/p' "$dir/out.txt")
}
if [ -z "$SHORT" ]; then
    strips 8 0 1024
    alone=$elements
    strips 8 600 1024
    check "a mesh's splinters leave strips their elements: $elements, $alone without" test "$elements" -le $((alone + 16))
    strips 300 0 1024
    check "many strips share elements, and the floor has some: $elements" test "$elements" -gt 512
    strips 255 0 4096
    check "strips that crowd nothing out keep their elements: $elements" test "$elements" -lt 3300
fi
# Slivers in a room, many of them through a block: they crowd nothing out there either.
awk 'function block(x0, y0, z0, x1, y1, z1,  i) {
         for (i = 0; i < 8; ++i) print "v", i % 2 ? x1 : x0, int(i / 2) % 2 ? y1 : y0, (i > 3 ? z1 : z0)
         print "f -8 -6 -5 -7\nf -4 -3 -1 -2\nf -8 -7 -3 -4\nf -6 -2 -1 -5\nf -8 -4 -2 -6\nf -7 -5 -1 -3" }
     BEGIN { block(0, 0, 0, 4, 3, 4); block(1, 0, 1, 2, 1, 2)
             for (i = 0; i < 600; ++i) {
                 x = 0.2 + 0.006 * i
                 printf "v %.5f 0.5 0.2\nv %.5f 0.5 0.2\nv %.5f 0.5 3.8\nf -3 -1 -2\n", x, x + 0.003, x + 0.003
             } }' >"$dir/through.obj"
if [ -z "$SHORT" ]; then
    status 0 bake "$dir/through.obj" -o "$dir/through.lmt" --elements 256 --division 1 --error 1 --once
    elements=$(sed -n 's/.*: \([0-9]*\) elements.*/\1/p' "$dir/out.txt")
    check "slivers through a block leave the room its elements: $elements" test "$elements" -gt 128
fi
# A panel whose corners, and the middle of its longest edge, lie in blocks: light comes to the rest of it.
awk 'function block(x, z,  i) {
         for (i = 0; i < 8; ++i) print "v", x + (i % 2 ? 0.12 : -0.12), int(i / 2) % 2 ? -0.3 : -0.7, z + (i > 3 ? 0.12 : -0.12)
         print "f -8 -6 -5 -7\nf -4 -3 -1 -2\nf -8 -7 -3 -4\nf -6 -2 -1 -5\nf -8 -4 -2 -6\nf -7 -5 -1 -3" }
     { print }
     END { print "v -0.7 -0.5 -0.6\nv 0.7 -0.5 -0.6\nv 0 -0.5 0.7\nf -1 -2 -3"
           block(-0.7, -0.6); block(0.7, -0.6); block(0, 0.7); block(0, -0.6) }' "$dir/box.obj" >"$dir/buried.obj"
above="--eye 0,0.4,-0.1 --target 0.01,-0.5,-0.1 --fov 30 --size 32x32 --light point:0.2,0.8,0:0,-1,0:5,4,3 --show indirect"
status 0 bake "$dir/buried.obj" -o "$dir/buried.lmt" --elements 1024 --division 1
status 0 render "$dir/buried.obj" $above --quality draft -o "$dir/buried-draft.pfm"
status 0 render "$dir/buried.obj" $above --transfer "$dir/buried.lmt" -o "$dir/buried.pfm"
status 0 compare "$dir/buried.pfm" "$dir/buried-draft.pfm" --max lo=0.7,hi=1.3
status 0 render "$dir/box.obj" $inside --transfer "$dir/box-1.lmt" --bounces 4 --threads 1 -o "$dir/box-four.pfm"
check "a transfer reflects light again" sh -c '! cmp -s "$1" "$2"' sh "$dir/box-baked.pfm" "$dir/box-four.pfm"
status 0 render "$dir/box.obj" $inside --transfer "$dir/box-1.lmt" --bounces 4 --threads 2 -o "$dir/box-again.pfm"
check "so it does by two threads" cmp -s "$dir/box-four.pfm" "$dir/box-again.pfm"
# Forty lights go into a tree, light the elements and are thrown back.
forty=$(awk 'BEGIN { for (i = 0; i < 40; ++i) printf " --light point:%g,%g,%g:0,-1,0:0.3,0.2,0.1", i % 5 / 4 - 0.5, i % 7 / 6 - 0.5, i % 11 / 10 - 0.5 }')
among="--eye -0.8,0.6,-0.8 --target 0.3,-0.6,0.3 --size 64x48 --show indirect $forty"
status 0 render "$dir/box.obj" $among --quality draft -o "$dir/forty.pfm"
status 0 render "$dir/box.obj" $among --transfer "$dir/box-1.lmt" --threads 1 -o "$dir/box-forty.pfm"
check "render says what it does with lights and a transfer" grep -q '40 lights in .* cells' "$dir/err.txt"
status 0 compare "$dir/box-forty.pfm" "$dir/forty.pfm" --max lo=0.95,hi=1.05,trim=0.06
status 0 render "$dir/box.obj" $among --transfer "$dir/box-1.lmt" --threads 3 -o "$dir/box-again.pfm"
check "so they are by three threads" cmp -s "$dir/box-forty.pfm" "$dir/box-again.pfm"
status 0 render "$dir/box.obj" $inside --bounces 4 -o "$dir/box-draft.pfm"
status 0 compare "$dir/box-four.pfm" "$dir/box-draft.pfm" --max lo=0.95,hi=1.05,trim=0.06
status 1 bake "$dir/block.obj" -o "$dir/bad.lmt" --elements 256 --moving 0
said "no surface to light"
for list in 1 0,0 0, x -1; do
    status 2 bake "$dir/block.obj" -o "$dir/bad.lmt" --elements 256 --moving=$list
done
head -c 5000 "$dir/box-1.lmt" >"$dir/cut.lmt"
status 1 render "$dir/box.obj" $inside --transfer "$dir/cut.lmt" -o "$dir/bad.pfm"
said "cut.lmt: a damaged light transfer"
status 0 bake "$dir/box.obj" -o "$dir/little.lmt" --elements 256 --receivers 200 --endian little --report
check "bake tells the bytes of each part" grep -q '  links  *[0-9]* bytes' "$dir/out.txt"
status 0 info "$dir/little.lmt"
check "info knows baked light" sh -c 'grep -q "little.lmt: baked light, version 2, [1-9][0-9]* bytes$" "$1" && grep -q "^elements  *256$" "$1"' sh "$dir/out.txt"
status 0 info "$dir/little.lmt" --json
check "and as JSON" grep -q '^{.*"kind":"transfer".*"elements":256,.*"scene":"[0-9a-f]*"}$' "$dir/out.txt"
status 0 bake "$dir/box.obj" -o "$dir/big.lmt" --elements 256 --receivers 200 --endian big
check "the other byte order has the same bytes but the checksum, turned round" sh -c '
    od -An -v -tx1 -w4 "$1" | sed "1d;24d" >"$1.txt"; od -An -v -tx1 -w4 "$2" | sed "1d;24d" | awk "{ print \" \" \$4, \$3, \$2, \$1 }" |
    cmp -s - "$1.txt"' sh "$dir/little.lmt" "$dir/big.lmt"
check "the byte order is that of this machine" sh -c 'cmp -s "$1" "$3" || cmp -s "$2" "$3"' sh "$dir/little.lmt" "$dir/big.lmt" "$dir/box-1.lmt"
cmp -s "$dir/little.lmt" "$dir/box-1.lmt" && other=big || other=little
status 1 render "$dir/box.obj" $inside --transfer "$dir/$other.lmt" -o "$dir/bad.pfm"
said "$other.lmt: baked for $other-endian machines, unlike this one"
{ printf 'LMT\001'; tail -c +5 "$dir/box-1.lmt"; } >"$dir/old.lmt"
status 1 render "$dir/box.obj" $inside --transfer "$dir/old.lmt" -o "$dir/bad.pfm"
said "old.lmt: a light transfer of version 1, and this reads version 2"
budget=$(($(wc -c <"$dir/box-1.lmt") * 3 / 4))
status 0 bake "$dir/box.obj" -o "$dir/less.lmt" --elements 256 --receivers 200 --budget-bytes $budget
check "bake says by which error a file fits" grep -q "by --error .*, which fits into $budget bytes" "$dir/out.txt"
check "a file with a budget is within it" sh -c 'test $(wc -c <"$1") -le '$budget sh "$dir/less.lmt"
status 1 bake "$dir/box.obj" -o "$dir/bad.lmt" --elements 256 --receivers 200 --budget-bytes 1000
said "without any link it is"
status 2 bake "$dir/box.obj" -o "$dir/bad.lmt" --endian middle
status 1 render "$dir/box.obj" $inside --transfer "$dir/box.obj" -o "$dir/bad.pfm"
status 1 render "$dir/box.obj" $inside --transfer "$dir/nowhere.lmt" -o "$dir/bad.pfm"
status 1 render "$dir/box.obj" $inside --transfer "$dir/block-1.lmt" -o "$dir/bad.pfm"
said "block-1.lmt: baked from another scene than"
status 1 bake "$dir/nowhere.obj" -o "$dir/bad.lmt"
status 1 bake "$dir/box.obj" -o "$dir/nowhere/bad.lmt"
status 2 bake
status 2 bake "$dir/box.obj"
said "no output given"
for elements in 32 128 1000 512 65536; do
    status 2 bake "$dir/box.obj" -o "$dir/bad.lmt" --elements $elements
done
check "nothing bad was drawn or baked" sh -c '! ls "$1"/bad* 2>/dev/null | grep -q .' sh "$dir"
status 0 bake --help
check "bake --help has under 100 columns" awk 'length($0) > 99 { exit 1 }' "$dir/out.txt"
status 0 bake -V
# Frames that move: each the same alone and among others, by cuts and by baked light; and as `render` has it.
baked="--transfer $dir/block-1.lmt"
for way in "--quality draft" "$baked"; do
    for move in light camera all; do
        status 0 play "$dir/block.obj" $inside $way --move $move --fps 2 --frames 4 -o "$dir/play_%02d.pfm"
        check "frames move" sh -c '! cmp -s "$1_00.pfm" "$1_03.pfm"' sh "$dir/play"
        status 0 play "$dir/block.obj" $inside $way --move $move --fps 2 --from 3 --frames 1 --threads 1 -o "$dir/alone_%02d.pfm"
        check "a frame is the same alone, $way --move $move" cmp -s "$dir/play_03.pfm" "$dir/alone_03.pfm"
    done
done
check "a frame's times are told" sh -c 'grep -q "^bands  *[0-9.]* " "$1" && grep -q "^whole frame  *[0-9.]* " "$1"' sh "$dir/out.txt"
for extension in png hdr; do
    status 0 play "$dir/block.obj" $inside $baked --frames 2 --fps 1 -o "$dir/play%02d.$extension"
    status 0 play "$dir/block.obj" $inside $baked --frames 1 --fps 1 --from 1 -o "$dir/alone%02d.$extension"
    check "a .$extension is the same alone" cmp -s "$dir/play01.$extension" "$dir/alone01.$extension"
done
printf '%s\n' "0 light 0.2,0.5,0 # begins here" "0 camera -0.8,0.6,-0.8 0.3,-0.6,0.3" "" \
    "1 light 0.3,0.5,0.1" "1 camera -0.7,0.6,-0.8 0.2,-0.6,0.3" "3 light 0.5,0.4,0.2" "2 camera -0.5,0.6,-0.8 0,-0.5,0" >"$dir/keys.txt"
status 0 play "$dir/block.obj" $inside $baked --path "$dir/keys.txt" --fps 1 --frames 4 -o "$dir/key%01d.pfm"
status 0 render "$dir/block.obj" --eye -0.7,0.6,-0.8 --target 0.2,-0.6,0.3 --size 64x48 --light point:0.3,0.5,0.1:0,-1,0:5,4,3 \
    --show indirect $baked -o "$dir/rendered.pfm"
check "a frame at a key is as render has it" cmp -s "$dir/key1.pfm" "$dir/rendered.pfm"
status 0 play "$dir/block.obj" $inside --path "$dir/keys.txt" --move camera --quality draft --fps 1 --from 2 --frames 3 -o "$dir/key%01d.pfm"
check "that a path ends is said" grep -q "keys.txt ends at 3 s, the frames at 4 s: from there on nothing moves" "$dir/err.txt"
check "after its last key nothing moves" cmp -s "$dir/key2.pfm" "$dir/key4.pfm"
printf '0 object:0 0,0,0\n1 object:0 0.1,0,0 1,0,0\n' >"$dir/mixed.txt"
status 1 play "$dir/block.obj" $inside --path "$dir/mixed.txt" --frames 2 -o "$dir/bad%02d.pfm"
said "mixed.txt: line 2: keys of one thing have a target each, or none; see line 1"
for what in light camera object:0; do
    printf "0 $what -0.2,0.5,0 0.2,0.5,0\n2 $what 0.2,0.5,0 -0.2,0.5,0\n" >"$dir/meets.txt"
    status 1 play "$dir/block.obj" $inside --path "$dir/meets.txt" --quality draft --fps 1 --frames 2 -o "$dir/bad%02d.pfm"
    said "meets.txt: at frame 1 what line 1 moves stands at its own target; move one of its keys"
    rm -f "$dir/bad00.pfm"
done
printf '0 object:0 0,0,0\n1 object:0 0.1,0,0\n' >"$dir/object.txt"
status 0 play "$dir/block.obj" $inside --path "$dir/object.txt" --move object --quality draft --fps 2 --frames 3 -o "$dir/play_%02d.pfm"
status 0 play "$dir/block.obj" $inside --path "$dir/object.txt" --quality draft --fps 2 --from 2 --frames 1 -o "$dir/alone_%02d.pfm"
check "an object moves, and is the same alone" sh -c '! cmp -s "$1_00.pfm" "$1_02.pfm" && cmp -s "$1_02.pfm" "$2_02.pfm"' sh "$dir/play" "$dir/alone"
status 1 play "$dir/block.obj" $inside --path "$dir/object.txt" $baked --frames 2 -o "$dir/bad%02d.pfm"
said "object.txt: line 1: object:0 stands still in what was baked; bake it with --moving 0"
status 0 play "$dir/block.obj" $inside $baked --frames 3 --check 2 --stats "$dir/play.json"
check "every second frame's error is told" sh -c 'test "$(grep -c "^frame [02] *trim 0\.[0-9]* *rmse 0\." "$1")" = 2' sh "$dir/out.txt"
check "--stats of play has the whole frame" grep -q '"whole frame": {"clock": \[[0-9.]*, ' "$dir/play.json"
status 0 play "$dir/block.obj" $inside --quality best --gather full --frames 1 --check 1
check "the best has no error against itself" grep -q "trim 0.0000  rmse 0.0000" "$dir/out.txt"
status 0 play "$dir/block.obj" $inside $baked --frames 1 -q -o "$dir/play_%02d.ppm"
check "--quiet is quiet" sh -c '! cat "$1" "$2" | grep -q .' sh "$dir/out.txt" "$dir/err.txt"
# The animations of a glTF file: light, camera and a triangle move by them, each frame the same alone.
cat >"$dir/moving.gltf" <<'GLTF'
{"asset":{"version":"2.0"},"extensionsUsed":["KHR_lights_punctual"],"nodes":[{"mesh":0},{"mesh":1},
{"translation":[0,2,0],"extensions":{"KHR_lights_punctual":{"light":0}}},{"translation":[0,1.5,4],"camera":0}],
"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","intensity":4}]}},
"cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":0.1,"aspectRatio":1.333}}],
"meshes":[{"primitives":[{"attributes":{"POSITION":4}}]},{"primitives":[{"attributes":{"POSITION":5}}]}],
"animations":[{"channels":[{"sampler":0,"target":{"node":1,"path":"translation"}},
{"sampler":1,"target":{"node":2,"path":"translation"}},{"sampler":2,"target":{"node":3,"path":"translation"}}],
"samplers":[{"input":0,"output":1},{"input":0,"output":2},{"input":0,"output":3}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":2,"type":"SCALAR"},
{"bufferView":0,"byteOffset":8,"componentType":5126,"count":2,"type":"VEC3"},
{"bufferView":0,"byteOffset":32,"componentType":5126,"count":2,"type":"VEC3"},
{"bufferView":0,"byteOffset":56,"componentType":5126,"count":2,"type":"VEC3"},
{"bufferView":0,"byteOffset":80,"componentType":5126,"count":6,"type":"VEC3"},
{"bufferView":0,"byteOffset":152,"componentType":5126,"count":3,"type":"VEC3"}],
"bufferViews":[{"buffer":0,"byteLength":188}],
"buffers":[{"byteLength":188,"uri":"data:application/octet-stream;base64,AAAAAAAAgD8AAAAAAAAAAAAAAACamRk/AAAAAJqZmT4AAAAAAAAAQAAAAAAAAAA/AAAAQM3MzD4AAAAAAACAPwAAgEAAAAA/mpmZPwAAgEAAAEDAAAAAAAAAQMAAAEBAAAAAAAAAQEAAAEBAAAAAAAAAQMAAAEDAAAAAAAAAQMAAAEDAAAAAAAAAQEAAAEBAAAAAAAAAQEAAAAC/mpmZPgAAAAAAAAA/mpmZPgAAAAAAAAAAAACAPwAAAAA="}]}
GLTF
for move in light camera object all; do
    status 0 play "$dir/moving.gltf" --size 64x48 --quality draft --move $move --fps 2 --frames 3 -o "$dir/play_%02d.pfm"
    status 0 play "$dir/moving.gltf" --size 64x48 --quality draft --move $move --fps 2 --from 2 --frames 1 -o "$dir/alone_%02d.pfm"
    check "an animation moves --move $move, the same alone" sh -c '! cmp -s "$1_00.pfm" "$1_02.pfm" && cmp -s "$1_02.pfm" "$2_02.pfm"' \
        sh "$dir/play" "$dir/alone"
done
status 0 render "$dir/moving.gltf" --size 64x48 --quality draft --light point:0.5,2,0.4:0,0,-1:4,4,4 -o "$dir/rendered.pfm"
status 0 play "$dir/moving.gltf" --size 64x48 --quality draft --move light --fps 1 --from 1 --frames 1 -o "$dir/alone_%02d.pfm"
check "an animated light lights as one that was put there" cmp -s "$dir/rendered.pfm" "$dir/alone_01.pfm"
status 0 bake "$dir/moving.gltf" -o "$dir/moving.lmt" --elements 64 --receivers 64
status 0 play "$dir/moving.gltf" --size 64x48 --transfer "$dir/moving.lmt" --frames 2
check "that baked objects stand still is said" grep -q "objects stand still: what was baked" "$dir/err.txt"
status 1 play "$dir/moving.gltf" --size 64x48 --transfer "$dir/moving.lmt" --move object --frames 2
status 0 bake "$dir/moving.gltf" -o "$dir/moves.lmt" --elements 64 --receivers 64 --moving 1
status 0 play "$dir/moving.gltf" --size 64x48 --transfer "$dir/moves.lmt" --fps 2 --frames 3 -o "$dir/play_%02d.pfm"
check "no object stands still" sh -c '! grep -q "stand still" "$1"' sh "$dir/err.txt"
status 0 play "$dir/moving.gltf" --size 64x48 --transfer "$dir/moves.lmt" --fps 2 --from 2 --frames 1 -o "$dir/alone_%02d.pfm"
check "a baked object moves, and is the same alone" sh -c '! cmp -s "$1_00.pfm" "$1_02.pfm" && cmp -s "$1_02.pfm" "$2_02.pfm"' \
    sh "$dir/play" "$dir/alone"
# The first 64 cameras count, and that is said of more.
for more in 63 64; do
    sed "s/\"camera\":0}]/\"camera\":0}$(awk -v n=$more 'BEGIN { while (n-- > 0) printf ",{\"camera\":0}" }')]/" "$dir/moving.gltf" >"$dir/eyes.gltf"
    status 0 bake "$dir/eyes.gltf" -o "$dir/eyes.lmt" --elements 64 --receivers 64
    check "cameras that do not count: $more and one" test "$(grep -c "eyes.gltf has 65 cameras, of which the first 64 count" "$dir/err.txt")" -eq $((more - 63))
done
status 0 bake "$dir/eyes.gltf" -o "$dir/eyes.lmt" --elements 64 --receivers 64 -q
check "--quiet says nothing of them" test ! -s "$dir/err.txt"
sed 's/"input":0,"output":2/"input":0,"output":3,"interpolation":"CUBICSPLINE"/' "$dir/moving.gltf" >"$dir/odd.gltf"
status 0 render "$dir/odd.gltf" --size 64x48 --shadow-map 64 -o "$dir/odd.png"
status 1 play "$dir/odd.gltf" --size 64x48 --frames 2
said "2 values for 2 keys; or give --path"
line() { # line NUMBER SAYS KEYS: a path file that is refused, by the line.
    printf "$3" >"$dir/bad.txt"
    status 1 play "$dir/block.obj" $inside --path "$dir/bad.txt" --frames 2 -o "$dir/bad%02d.pfm"
    said "bad.txt: line $1: $2"
}
long=$(printf '%0200d' 0)
line 1 "begins with no time" 'camera 0,0,0\n'
line 1 "begins with no time" '\000\001\002'
line 2 "begins with no time" '0 light 0,0,0\n-1 light 0,0,0\n'
line 1 "begins with no time" 'nan light 0,0,0\n'
line 1 "begins with no time" '1e7 light 0,0,0\n'
line 3 "a time alone" '# none\n\n0\n'
line 1 "\`lamp\` moves nothing" '0 lamp 0,0,0\n'
line 1 "\`object\`: write camera, light, light:N or object:N" '0 object 0,0,0\n'
line 1 "\`camera:0\`: write" '0 camera:0 0,0,0\n'
line 1 "\`light:-1\`: write" '0 light:-1 0,0,0\n'
line 1 "\`light:\`: write" '0 light: 0,0,0\n'
line 1 "no position" '0 light\n'
line 1 "\`0,0\` is not X,Y,Z" '0 light 0,0\n'
line 1 "\`0,0,2e6\` is not X,Y,Z within 1,000,000 m" '0 light 0,0,2e6\n'
line 1 "\`nan,0,0\` is not" '0 light nan,0,0\n'
line 1 "more than TIME WHAT" '0 light 0,0,0 1,1,1 2\n'
line 1 "position and target are the same" '0 light 0,0,0 0,0,0\n'
line 2 "not later than the key before it" '1 light 0,0,0\n1 light 0,0,1\n'
line 1 "no light:1; the scene has 1, numbered from 0" '0 light:1 0,0,0\n'
line 1 "no object:7; the scene has" '0 object:7 0,0,0\n'
line 1 "\`00000000" "0 light 0$long,0,0\\n"
line 1 "\`1,1,100000000" "0 camera 0,0,0 1,1,1$long\\n"
awk 'BEGIN { for (i = 0; i < 10001; ++i) print i, "camera 0,0,0" }' >"$dir/bad.txt"
status 1 play "$dir/block.obj" $inside --path "$dir/bad.txt" --frames 2
said "bad.txt: line 10001: over 10000 keys"
awk 'BEGIN { for (i = 0; i < 70; ++i) print "0 light:" i, "0,0,0" }' >"$dir/bad.txt"
status 1 play "$dir/block.obj" $inside --path "$dir/bad.txt" --frames 2
said "bad.txt: line 65: over 64 things that move"
printf '# nothing\n' >"$dir/bad.txt"
status 1 play "$dir/block.obj" $inside --path "$dir/bad.txt" --frames 2
said "bad.txt: no keys in it"
status 1 play "$dir/block.obj" $inside --path "$dir/keys.txt" --move object --frames 2
said "keys.txt: nothing in it that --move lets move"
printf '0 camera 0,0,0 0,1,0\n' >"$dir/bad.txt"
status 1 play "$dir/block.obj" $inside --path "$dir/bad.txt" --frames 2
said "at frame 0 the camera looks along what is up"
status 1 play "$dir/block.obj" $inside --path "$dir/nowhere.txt" --frames 2
status 1 play "$dir/nowhere.obj" --frames 2
status 1 play "$dir/block.obj" $inside --frames 2 -o "$dir/nowhere/bad%02d.pfm"
status 1 play "$dir/block.obj" $inside --frames 2 --transfer "$dir/box-1.lmt" -o "$dir/bad%02d.pfm"
status 2 play
status 1 play "$dir/block.obj" --move object
said "nothing in $dir/block.obj moves objects; give --path FILE"
for pattern in bad.png bad%d.png bad%4d.png bad%00d.png bad%s.png bad%04d%04d.png bad%04d%%.png bad%04d bad%04d.gif bad%010d.png bad%04n.png; do
    status 2 play "$dir/block.obj" -o "$dir/$pattern"
done
for option in "--frames 0" "--frames 1e3" "--from -1" "--fps 0" "--check 0" "--move lamp" "--show depth" "--stereo 0.1"; do
    status 2 play "$dir/block.obj" $option
done
status 2 play "$dir/block.obj" --check 1 --show direct
check "nothing bad was played" sh -c '! ls "$1"/bad*.p* 2>/dev/null | grep -q .' sh "$dir"
status 0 play --help
check "play --help has under 100 columns" awk 'length($0) > 99 { exit 1 }' "$dir/out.txt"
status 0 play -V
# One photo of a wall, 24 x 24, grey, 2 m away; and what may not be there.
half='\000\000\000\077'
two='\000\000\000\100'
{ printf 'PF\n24 24\n-1.0\n'; i=0; while [ $i -lt 1728 ]; do printf "$half"; i=$((i + 1)); done; } > "$dir/photo.pfm"
{ printf 'Pf\n24 24\n-1.0\n'; i=0; while [ $i -lt 576 ]; do printf "$two"; i=$((i + 1)); done; } > "$dir/wall.pfm"
{ printf 'Pf\n24 24\n-1.0\n'; head -c 2304 /dev/zero; } > "$dir/blind.pfm"
printf 'v -1 0 -1\nv 1 0 -1\nv 0 0 1\nv 0 1 0\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n' > "$dir/tent.obj"
seen="--photo $dir/photo.pfm --depth $dir/wall.pfm --intrinsics 30,30,11.5,11.5"
tent="--object $dir/tent.obj --scale 0.2 --at 8,12 --shadow-map 64 --voxels 4"
status 0 mix $seen -o "$dir/same.pfm"
check "without an object the photo stays as it is" cmp "$dir/photo.pfm" "$dir/same.pfm"
status 0 mix $seen $tent --light sun:0,0,0:0.6,-0.2,-1:2,2,2 -o "$dir/mixed.pfm"
check "an object changes the photo" sh -c '! cmp -s "$1" "$2"' sh "$dir/photo.pfm" "$dir/mixed.pfm"
status 0 mix $seen $tent --light sun:0,0,0:0.6,-0.2,-1:2,2,2 --backend scalar -o "$dir/scalar.pfm"
check "a backend changes the mixed picture" cmp "$dir/mixed.pfm" "$dir/scalar.pfm"
status 0 mix $seen $tent --light sun:0,0,0:0.6,-0.2,-1:2,2,2:12 -o "$dir/soft.pfm"
check "a light with a size changes the mixed picture" sh -c '! cmp -s "$1" "$2"' sh "$dir/mixed.pfm" "$dir/soft.pfm"
status 0 mix $seen $tent --light sun:0,0,0:0.6,-0.2,-1:2,2,2:12 --backend scalar --threads 1 -o "$dir/scalar.pfm"
check "a backend changes a soft shadow" cmp "$dir/soft.pfm" "$dir/scalar.pfm"
status 2 mix $seen $tent --light sun:0,0,0:0.6,-0.2,-1:2,2,2:91 -o "$dir/bad.png"
status 0 mix $seen $tent --samples 16 -o "$dir/soft.png"
status 0 render "$dir/tent.obj" --size 16x16 --light point:0,3,0:0,-1,0:6,6,6:0.5 --show direct -o "$dir/soft.png"
status 2 relief render "$dir/nowhere.lmr" --light sun:0,0,0:0.6,-0.2,-1:2,2,2:12 -o "$dir/bad.png"
status 0 mix $seen $tent --stats "$dir/mix.json" -o "$dir/mixed.hdr"
check "--stats of mix names the planes" grep -q '"planes": 1,' "$dir/mix.json"
status 0 mix $seen $tent --show delta -o "$dir/delta.pfm"
check "the delta is darker somewhere" sh -c '"$1" info "$2" | grep -q "red   min -0"' sh "$TOOL" "$dir/delta.pfm"
for show in final delta planes voxels env object; do
    status 0 mix $seen $tent --show $show --roughness 0.2,0.5 -o "$dir/mixed.png"
done
status 0 mix --photo "$dir/photo.pfm" --depth "$dir/blind.pfm" --intrinsics 30,30,11.5,11.5 -o "$dir/same.pfm"
check "nor does a photo without depth change" cmp "$dir/photo.pfm" "$dir/same.pfm"
status 1 mix --photo "$dir/photo.pfm" --depth "$dir/blind.pfm" --intrinsics 30,30,11.5,11.5 --object "$dir/tent.obj" -o "$dir/bad.png"
said "nothing to stand on: no pixel of the depth has a number over 0, so none is measured"
status 2 mix $seen --object "$dir/tent.obj" --at 5000,10 -o "$dir/bad.png"
said "--at 5000,10: the photo has 24 x 24 pixels"
status 2 mix --photo "$dir/photo.pfm" --depth "$dir/wall.pfm" --intrinsics 0,0,0,0 --object "$dir/tent.obj" -o "$dir/bad.png"
said "--intrinsics: focal lengths are over 0"
# Stored pictures come out with the same codes; of ours, as the same file.
far() { printf 'Pf\n%d %d\n-1.0\n' "$1" "$2"; head -c $(($1 * $2 * 4)) /dev/zero; }
far 64 48 >"$dir/far.pfm"
status 0 mix --photo "$dir/demo.png" --depth "$dir/far.pfm" --intrinsics 30,30,9,6 -o "$dir/same.png"
check "a PNG comes out as it went in" cmp "$dir/demo.png" "$dir/same.png"
far 19 13 >"$dir/far.pfm"
status 0 mix --photo tests/fuzz/corpus/jpeg/baseline_420.jpg --depth "$dir/far.pfm" --intrinsics 30,30,9,6 -o "$dir/same.png"
check "a JPEG's pixels come out as they went in" sh -c '"$1" compare "$2" "$3" | grep -q "exact 247 of 247"' sh "$TOOL" tests/fuzz/corpus/jpeg/baseline_420.jpg "$dir/same.png"
# One pixel, of which a plane cannot be told; where it stands is asked.
{ printf 'PF\n1 1\n-1.0\n'; printf "$half$half$half"; } >"$dir/photo1.pfm"
{ printf 'Pf\n1 1\n-1.0\n'; printf "$two"; } >"$dir/depth1.pfm"
dot="--photo $dir/photo1.pfm --depth $dir/depth1.pfm --intrinsics 30,30,0,0"
status 0 mix $dot -o "$dir/same.pfm"
check "one pixel comes out as it went in" cmp "$dir/photo1.pfm" "$dir/same.pfm"
status 1 mix $dot --object "$dir/tent.obj" -o "$dir/bad.png"
said "no plane in the depth to stand on; 100 % of its pixels are measured, 2 .. 2 m away: --depth-scale sets its unit"
status 0 mix $dot --object "$dir/tent.obj" --at 0,0 --scale 0.01 --shadow-map 64 --voxels 4 -o "$dir/mixed.pfm"
# A wall alone: the object stands on it, and that is said.
status 0 mix $seen --object "$dir/tent.obj" --shadow-map 64 --voxels 4 -o "$dir/mixed.pfm"
check "that no plane faces up is said" grep -q "no plane faces up" "$dir/err.txt"
# Of planes that are shown nothing is said about a place where the object was not put.
status 0 mix $seen --object "$dir/tent.obj" --show planes -o "$dir/planes.png"
check "--show planes puts no object anywhere" sh -c '! grep -q "stands on\|no plane faces up" "$1"' sh "$dir/err.txt"
status 0 mix $seen --object "$dir/tent.obj" --scale 0.5 --at 2,12 --shadow-map 64 --voxels 4 -o "$dir/mixed.pfm"
check "that the object is off the picture is said" grep -q "part of the object is off the picture" "$dir/err.txt"
# A spike out of the wall: its box's near corners are off the picture, and its own are not.
printf 'v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv 0 0 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n' >"$dir/spike.obj"
spike="--object $dir/spike.obj --scale 0.6 --shadow-map 64 --voxels 4"
for at in 11,11 9,11 14,11 11,9 11,14; do
    status 0 mix $seen $spike --at $at -o "$dir/mixed.pfm"
    check "a spike at $at is in the picture" sh -c '! grep -q "off the picture" "$1"' sh "$dir/err.txt"
done
for at in 7,11 16,11 11,7 11,16; do
    status 0 mix $seen $spike --at $at -o "$dir/mixed.pfm"
    said "part of the object is off the picture"
done
# A size is the file's own metres, and is said where that is absurd.
status 0 mix $seen --object "$dir/tent.obj" --scale 300 --shadow-map 64 --voxels 4 -o "$dir/mixed.pfm"
check "an object that fills the picture is said" grep -q "m long and fills the picture; --fit chooses its size" "$dir/err.txt"
status 0 mix $seen --object "$dir/tent.obj" --scale 0.0001 --shadow-map 64 --voxels 4 -o "$dir/mixed.pfm"
check "an object that vanishes is said" grep -q "m long and vanishes in the picture" "$dir/err.txt"
status 0 mix $seen --object "$dir/tent.obj" --fit --on wall --shadow-map 64 --voxels 4 -o "$dir/mixed.pfm"
check "what fits is neither" sh -c '! grep -q "m long and" "$1"' sh "$dir/err.txt"
status 1 mix $seen --object "$dir/tent.obj" --on floor -o "$dir/bad.png"
said "--on floor: no plane faces up"
status 2 mix $seen --object "$dir/tent.obj" --fit --scale 2 -o "$dir/bad.png"
status 2 mix $seen --object "$dir/tent.obj" --on wall --at 3,4 -o "$dir/bad.png"
# A sequence: frames that cannot be used are said and left out, and the others do not know of them.
leaves_out() { # WANTED ARGUMENT...: so many frames, a line each and one of the sum
    wanted=$1
    shift
    "$TOOL" "$@" >"$dir/out.txt" 2>"$dir/err.txt"
    got=$?
    check "lambent $*: exit status $got, not 1" test $got -eq 1
    check "lambent $*: each frame that is left out is said" test "$(grep -c 'frame [0-9]* is left out: ' "$dir/err.txt")" = "$wanted"
    check "lambent $*: and all together" grep -q ": $wanted of [0-9]* frames are left out, the first because " "$dir/err.txt"
}
mkdir -p "$dir/frames"
pose='"camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]'
for i in 0 1 2 3 4; do
    cp "$dir/photo.pfm" "$dir/frames/f$i.color.pfm"
    cp "$dir/wall.pfm" "$dir/frames/f$i.depth.pfm"
    printf '{"fx": 30, "fy": 30, "cx": 11.5, "cy": 11.5, "depth_unit_mm": 1000, %s}' "$pose" >"$dir/frames/f$i.json"
done
printf '{"fx": 30, "fy": 30, "cx": 11.5, "cy": 11.5, "depth_unit_mm": 1000, %s}' "$(echo "$pose" | sed 's/\[1,0,0,0\]/[3,0,0,0]/')" >"$dir/frames/f1.json"
cp "$dir/far.pfm" "$dir/frames/f2.depth.pfm"
rm "$dir/frames/f3.color.pfm"
printf 'f0\nf1\nf2\nf3\nf4\n' >"$dir/frames/frames.txt"
leaves_out 3 mix --frames "$dir/frames" $tent -o "$dir/frames/o_%02d.pfm"
said "frame 1 is left out: "
said "is no rotation and place"
said "frame 2 is left out: "
said "frame 3 is left out: "
check "frames left out are not there" sh -c '! ls "$1"/o_01* "$1"/o_02* "$1"/o_03* 2>/dev/null | grep -q .' sh "$dir/frames"
check "of one place all frames are the same" cmp "$dir/frames/o_00.pfm" "$dir/frames/o_04.pfm"
check "a frame has the object" sh -c '! cmp -s "$1" "$2"' sh "$dir/photo.pfm" "$dir/frames/o_00.pfm"
# A camera that stands still: what is in front of the object for two frames hides it, and another photo's light is taken.
{ printf 'Pf\n24 24\n-1.0\n'; i=0; while [ $i -lt 576 ]; do printf '\000\000\200\077'; i=$((i + 1)); done; } >"$dir/frames/near.depth.pfm"
{ printf 'PF\n24 24\n-1.0\n'; i=0; while [ $i -lt 576 ]; do printf '\000\000\200\076\000\000\200\076\000\000\200\076'; i=$((i + 1)); done; } >"$dir/frames/other.color.pfm"
cp "$dir/photo.pfm" "$dir/frames/near.color.pfm" && cp "$dir/wall.pfm" "$dir/frames/other.depth.pfm"
cp "$dir/frames/f0.json" "$dir/frames/near.json" && cp "$dir/frames/f0.json" "$dir/frames/other.json"
printf 'f0\nnear\nnear\n' >"$dir/frames/near.txt" && printf 'f0\nother\n' >"$dir/frames/other.txt"
status 0 mix --frames "$dir/frames/near.txt" $tent -o "$dir/frames/n_%02d.pfm"
check "one frame is not believed" cmp "$dir/frames/o_00.pfm" "$dir/frames/n_01.pfm"
check "two are" sh -c '! cmp -s "$1" "$2"' sh "$dir/frames/o_00.pfm" "$dir/frames/n_02.pfm"
status 0 mix --frames "$dir/frames/other.txt" $tent -o "$dir/frames/p_%02d.pfm"
check "each frame has its own photo" sh -c '! cmp -s "$1" "$2"' sh "$dir/frames/o_00.pfm" "$dir/frames/p_01.pfm"
# The twelve bytes of a pixel in the middle of the object: a photo half as bright lights it anew.
on_object() { dd if="$1" bs=1 skip=3278 count=12 2>/dev/null | od -An -tx1; }
check "a photo of another brightness has its own light" test "$(on_object "$dir/frames/o_00.pfm")" != "$(on_object "$dir/frames/p_01.pfm")"
printf 'f0\nf4\n' >"$dir/frames/two.txt"
status 0 mix --frames "$dir/frames/two.txt" $tent --threads 3 --backend scalar -o "$dir/frames/t_%02d.pfm"
check "threads, backends and frames left out change no byte" cmp "$dir/frames/o_04.pfm" "$dir/frames/t_01.pfm"
# A camera that moves: the bytes are the list's up to there, by any threads, and a frame of another size starts anew.
for i in 5 6 7; do
    cp "$dir/photo.pfm" "$dir/frames/f$i.color.pfm" && cp "$dir/wall.pfm" "$dir/frames/f$i.depth.pfm"
    sed "s/\[\[1,0,0,0\]/[[1,0,0,0.0$i]/" "$dir/frames/f0.json" >"$dir/frames/f$i.json"
done
{ printf 'PF\n2 1\n-1.0\n'; i=0; while [ $i -lt 6 ]; do printf '\000\000\200\076'; i=$((i + 1)); done; } >"$dir/frames/f8.color.pfm"
{ printf 'Pf\n2 1\n-1.0\n\000\000\200\077\000\000\300\177'; } >"$dir/frames/f8.depth.pfm" # 1 m, and no number
cp "$dir/frames/f0.json" "$dir/frames/f8.json"
printf 'f0\nf5\nf6\nf8\nf7\n' >"$dir/frames/moves.txt" && printf 'f0\nf5\nf6\n' >"$dir/frames/begins.txt"
status 0 mix --frames "$dir/frames/moves.txt" $tent --threads 1 -o "$dir/frames/m_%02d.pfm"
status 0 mix --frames "$dir/frames/begins.txt" $tent --threads 3 --backend scalar -o "$dir/frames/g_%02d.pfm"
for i in 0 1 2; do
    check "moving frame $i is the same by threads, backends and what follows" cmp "$dir/frames/m_0$i.pfm" "$dir/frames/g_0$i.pfm"
done
check "the object moves in the picture" sh -c '! cmp -s "$1" "$2"' sh "$dir/frames/m_00.pfm" "$dir/frames/m_02.pfm"
check "a frame of another size is drawn in its own" sh -c '"$1" info "$2" | grep -q "size  *2x1"' sh "$TOOL" "$dir/frames/m_03.pfm"
check "and the next one after it" test -s "$dir/frames/m_04.pfm"
# A camera that trembles by a micrometre sees the same in all frames: the world gathers no cells that it has.
status 0 render demo --eye 0.5,1.25,2.5 --target 0.5,1,-1 --size 80x60 -o "$dir/frames/h.color.pfm"
status 0 render demo --eye 0.5,1.25,2.5 --target 0.5,1,-1 --size 80x60 --show depth -o "$dir/frames/h.depth.pfm"
for i in 00 01 02 03 04 05 06 07 08 09 10 11; do
    ln -f "$dir/frames/h.color.pfm" "$dir/frames/h$i.color.pfm" && ln -f "$dir/frames/h.depth.pfm" "$dir/frames/h$i.depth.pfm"
    printf '{"fx": 72.43, "fy": 72.43, "cx": 39.5, "cy": 29.5, "depth_unit_mm": 1000, "camera_to_world": [[1,0,0,%s],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}' \
        "$([ $((1$i % 2)) = 0 ] && echo 0 || echo 0.000001)" >"$dir/frames/h$i.json"
    echo "h$i"
done >"$dir/frames/tremble.txt"
status 0 mix --frames "$dir/frames/tremble.txt" --object "$dir/tent.obj" --fit --voxels 5 -o "$dir/frames/h_%02d.pfm"
check "a camera that trembles changes nothing" sh -c '"$1" compare "$2" "$3" | grep -q "rmse 0\.000[0-4]"' sh "$TOOL" "$dir/frames/h_01.pfm" "$dir/frames/h_11.pfm"
# No frame is written over a photo of the list, whenever it is read.
for i in 0 1; do
    for part in color.pfm depth.pfm json; do cp "$dir/frames/f0.$part" "$dir/frames/r$i.$part"; done
done
printf 'r1\nr0\n' >"$dir/frames/own.txt"
status 2 mix --frames "$dir/frames/own.txt" $tent -o "$dir/frames/r%01d.color.pfm"
for i in 0 1; do check "photo $i of the list stays" cmp "$dir/frames/f0.color.pfm" "$dir/frames/r$i.color.pfm"; done
status 2 mix --frames "$dir/frames/own.txt" $tent --stats "$dir/bad.json" -o "$dir/frames/bad_%02d.pfm"
# What the command line says wrongly of the first photo it would say of none rightly.
status 2 mix --frames "$dir/frames/begins.txt" --object "$dir/tent.obj" --at 5000,10 -o "$dir/frames/bad_%02d.pfm"
said "--at 5000,10: the photo has 24 x 24 pixels"
: >"$dir/frames/empty.txt"
status 1 mix --frames "$dir/frames/empty.txt" $tent -o "$dir/frames/bad_%02d.pfm"
said "lists no frame"
awk 'BEGIN { print "f0"; for (i = 1; i < 10000; ++i) print "gone" }' >"$dir/frames/long.txt"
status_of_long() { "$TOOL" mix --frames "$dir/frames/long.txt" $tent -o "$dir/frames/long_%04d.pfm" >"$dir/out.txt" 2>"$dir/err.txt"; echo $?; }
check "a list of nothing but its first frame: exit status 1" test "$(status_of_long)" = 1
check "of frames in a row eight are said" test "$(grep -c 'frame [0-9]* is left out: ' "$dir/err.txt")" = 8
said "frames 9 to 9999 are left out, too"
said ": 9999 of 10000 frames are left out, the first because "
check "and the first one is there" cmp "$dir/frames/m_00.pfm" "$dir/frames/long_0000.pfm"
printf '# time name\n1.00 f0.color.pfm\n1.03 f4.color.pfm\n' >"$dir/frames/rgb.txt"
printf '1.01 f0.depth.pfm\n1.04 f4.depth.pfm\n' >"$dir/frames/depth.txt"
printf '1.00 0 0 0 0 0 0 1\n1.03 0 0 0 0 0 0 1\n' >"$dir/frames/groundtruth.txt"
status 0 mix --frames "$dir/frames" $tent --intrinsics 30,30,11.5,11.5 --depth-scale 1 -o "$dir/frames/tum_%02d.pfm"
check "TUM's lists give the same frame" cmp "$dir/frames/o_00.pfm" "$dir/frames/tum_01.pfm"
# Photos of no depth's time, or no pose's, are no frames; lines that are neither are passed over; both are said and counted.
printf '1.00 f0.color.pfm\n1.02\nlate f4.color.pfm\n1.03 f4.color.pfm\n2.00 f4.color.pfm\n3.00 f0.color.pfm\n' >"$dir/frames/rgb.txt"
printf '1.01 f0.depth.pfm\n1.04 f4.depth.pfm\n3.00 f0.depth.pfm\n' >"$dir/frames/depth.txt"
printf '1.00 0 0 0 0 0 0 1\n1.03 0 0 0 0 0 0\n1.03 0 0 0 0 0 0 1\n' >"$dir/frames/groundtruth.txt"
status 0 mix --frames "$dir/frames" $tent --intrinsics 30,30,11.5,11.5 --depth-scale 1 -o "$dir/frames/tom_%02d.pfm"
said "photos without a depth within 0.02 s: 1; without a pose: 1;"
said "lines of its lists that are no time and name, or pose: 3;"
check "they change no other frame" cmp "$dir/frames/tum_01.pfm" "$dir/frames/tom_01.pfm"
# A turn of no length.
printf '1.00 0 0 0 0 0 0 1\n1.03 0 0 0 0 0 0 0\n' >"$dir/frames/groundtruth.txt"
leaves_out 1 mix --frames "$dir/frames" $tent --intrinsics 30,30,11.5,11.5 --depth-scale 1 -o "$dir/frames/ter_%02d.pfm"
said "frame 1 is left out: $dir/frames/f4.color.pfm: its pose is no rotation and place"
check "nor does a pose that is none" cmp "$dir/frames/tum_00.pfm" "$dir/frames/ter_00.pfm"
# In any order; of two depths as near in time, or of one time, the earlier line; and of lists as long as they are.
printf '1.00 0 0 0 0 0 0 1\n' >"$dir/frames/groundtruth.txt"
awk 'BEGIN { for (i = 70000; i > 1; --i) print i, "f4.color.pfm"; print "1.00 f0.color.pfm"; print "nan f0.color.pfm" }' >"$dir/frames/rgb.txt"
tie=0
for times in '0.9921875 1.0078125' '1.0078125 0.9921875' '1 1' '0.9921875 0.9921875' '1.0078125 1.0078125'; do
    printf '5 gone\n%s f0.depth.pfm\n%s near.depth.pfm\n-5 gone\n' $times >"$dir/frames/depth.txt"
    status 0 mix --frames "$dir/frames" $tent --intrinsics 30,30,11.5,11.5 --depth-scale 1 -o "$dir/frames/tie${tie}_%02d.pfm"
    said "photos without a depth within 0.02 s: 69998; without a pose: 1;"
    said "lines of its lists that are no time and name, or pose: 1;"
    check "depths at $times s: the earlier line" cmp "$dir/frames/o_00.pfm" "$dir/frames/tie${tie}_00.pfm"
    tie=$((tie + 1))
done
printf '1.00 f0.color.pfm\n1.02\nlate f4.color.pfm\n1.03 f4.color.pfm\n2.00 f4.color.pfm\n3.00 f0.color.pfm\n' >"$dir/frames/rgb.txt"
printf '1.00 0 0 0 0 0 0 1\n1.03 0 0 0 0 0 0 0\n' >"$dir/frames/groundtruth.txt"
printf '9.00 f0.depth.pfm\n' >"$dir/frames/depth.txt"
status 1 mix --frames "$dir/frames" $tent --intrinsics 30,30,11.5,11.5 -o "$dir/frames/bad_%02d.pfm"
said "lists no frame: photos without a depth within 0.02 s: 4; without a pose: 0"
printf '1.01 f0.depth.pfm\n1.04 f4.depth.pfm\n' >"$dir/frames/depth.txt"
status 1 mix --frames "$dir/frames" $tent -q -o "$dir/frames/bad_%02d.pfm"
said "2 of 2 frames are left out, the first because no camera given"
# Frames without one measured depth, of no numbers, of a photo that ends early and of another size than their depth: each
# is said once, and the frames after it are those of a list without it.
{ printf 'Pf\n24 24\n-1.0\n'; i=0; while [ $i -lt 576 ]; do printf '\000\000\300\177'; i=$((i + 1)); done; } >"$dir/frames/x0.depth.pfm"
for i in 0 1 2 3; do cp "$dir/frames/f0.json" "$dir/frames/x$i.json" && cp "$dir/photo.pfm" "$dir/frames/x$i.color.pfm"; done
head -c 500 "$dir/photo.pfm" >"$dir/frames/x1.color.pfm" && cp "$dir/wall.pfm" "$dir/frames/x1.depth.pfm"
cp "$dir/frames/f8.depth.pfm" "$dir/frames/x2.depth.pfm"
printf '{"fx": 30, "fy": 30, "cx": 11.5, "cy": 11.5, "depth_unit_mm": 1000}' >"$dir/frames/x3.json" && cp "$dir/wall.pfm" "$dir/frames/x3.depth.pfm"
printf 'f0\nx1\nf5\nx2\nx3\ngone\nf6\n' >"$dir/frames/odd.txt"
leaves_out 4 mix --frames "$dir/frames/odd.txt" $tent -o "$dir/frames/odd_%02d.pfm"
for i in 0 1 2; do check "odd frames change frame $i of the others by no byte" cmp "$dir/frames/odd_0$((i * (i + 3) / 2 + (i == 2))).pfm" "$dir/frames/g_0$i.pfm"; done
printf 'f0\nx0\nx0\n' >"$dir/frames/nan.txt"
status 0 mix --frames "$dir/frames/nan.txt" $tent -o "$dir/frames/nan_%02d.pfm"
for i in 1 2; do check "what is not measured anew stays: $i" cmp "$dir/frames/o_00.pfm" "$dir/frames/nan_0$i.pfm"; done
printf 'x0\nf0\n' >"$dir/frames/blind.txt"
leaves_out 1 mix --frames "$dir/frames/blind.txt" $tent -o "$dir/frames/blind_%02d.pfm"
said "frame 0 is left out: "
check "a list whose first frame is blind begins with the next" cmp "$dir/frames/o_00.pfm" "$dir/frames/blind_01.pfm"
# A wall 1.5 m away that is not measured where the object would stand: what it measured is forgotten with it.
{
    printf 'Pf\n24 24\n-1.0\n'
    i=0
    while [ $i -lt 576 ]; do
        if [ $((i % 24)) -lt 22 ]; then printf '\000\000\300\177'; else printf '\000\000\300\077'; fi
        i=$((i + 1))
    done
} >"$dir/frames/hole.depth.pfm"
cp "$dir/photo.pfm" "$dir/frames/hole.color.pfm" && cp "$dir/frames/f0.json" "$dir/frames/hole.json"
printf 'hole\nf0\n' >"$dir/frames/hole.txt"
leaves_out 1 mix --frames "$dir/frames/hole.txt" $tent -o "$dir/frames/hole_%02d.pfm"
said "frame 0 is left out: --at 8,12: neither a plane nor any depth there"
check "what a frame measured that is left out changes no other" cmp "$dir/frames/o_00.pfm" "$dir/frames/hole_01.pfm"
# A name that cannot be read, whatever the system's reason, is of its frame alone.
ln -s loop.color.png "$dir/frames/loop.color.png" && cp "$dir/frames/f0.json" "$dir/frames/loop.json" && cp "$dir/wall.pfm" "$dir/frames/loop.depth.pfm"
printf 'f0\nloop\nf5\n' >"$dir/frames/loop.txt"
leaves_out 1 mix --frames "$dir/frames/loop.txt" $tent -o "$dir/frames/loop_%02d.pfm"
said "frame 1 is left out: "
check "a link to itself ends no sequence" cmp "$dir/frames/g_01.pfm" "$dir/frames/loop_02.pfm"
# Linear photos: half of this one is as the first, and half shines; that half's codes stay.
{ printf 'PF\n24 24\n-1.0\n'; tail -c 3456 "$dir/photo.pfm"; i=0; while [ $i -lt 864 ]; do printf '\000\000\000\101'; i=$((i + 1)); done; } >"$dir/frames/glow.color.pfm"
cp "$dir/wall.pfm" "$dir/frames/glow.depth.pfm" && cp "$dir/frames/f0.json" "$dir/frames/glow.json"
printf 'f0\nglow\n' >"$dir/frames/glow.txt"
status 0 mix --frames "$dir/frames/glow.txt" -o "$dir/frames/glow_%02d.ppm"
for i in 0 1; do tail -c 864 "$dir/frames/glow_0$i.ppm" >"$dir/frames/still_$i"; done
check "the first frame's exposure stays" cmp "$dir/frames/still_0" "$dir/frames/still_1"
check "the other half shines" sh -c '! cmp -s "$1" "$2"' sh "$dir/frames/glow_00.ppm" "$dir/frames/glow_01.ppm"
status 2 mix --frames "$dir/frames/two.txt" --object "$dir/tent.obj" --fit --scale 2 -o "$dir/frames/bad_%02d.pfm"
status 2 mix --frames "$dir/frames/two.txt" --object "$dir/tent.obj" --on wall --at 3,4 -o "$dir/frames/bad_%02d.pfm"
status 2 mix --frames "$dir/frames/two.txt" --show object -o "$dir/frames/bad_%02d.pfm"
check "what is refused draws nothing" sh -c '! ls "$1"/bad_* 2>/dev/null | grep -q .' sh "$dir/frames"
status 2 mix --frames "$dir/frames" $tent -o "$dir/bad.png"
status 2 mix --frames "$dir/frames" --photo "$dir/photo.pfm" $tent -o "$dir/bad%02d.png"
status 1 mix --frames "$dir/nowhere" $tent -o "$dir/bad%02d.png"
mkdir -p "$dir/frames/none"
status 1 mix --frames "$dir/frames/none" $tent -o "$dir/bad%02d.png"
said "$dir/frames/none: a folder with neither frames.txt nor TUM's rgb.txt"
# Surroundings that shine in one colour light the object in that colour alone.
{ printf 'PF\n1 6\n-1.0\n'; i=0; while [ $i -lt 6 ]; do printf "$one\000\000\000\000\000\000\000\000"; i=$((i + 1)); done; } > "$dir/red.pfm"
status 0 mix $seen $tent --world "$dir/red.pfm" --show object -o "$dir/mixed.pfm"
check "--world lights the object" sh -c '"$1" info "$2" | grep -q "red   min 0 *max [0-9.]*[1-9]"' sh "$TOOL" "$dir/mixed.pfm"
check "--world lights it in its own colour" sh -c '"$1" info "$2" | grep -q "green min 0 *max 0 "' sh "$TOOL" "$dir/mixed.pfm"
status 1 mix $seen $tent --world "$dir/nowhere.pfm" -o "$dir/bad.png"
status 1 mix --photo "$dir/photo.pfm" --depth "$dir/facepx.pfm" --intrinsics 30,30,11.5,11.5 -o "$dir/bad.png"
status 1 mix --photo "$dir/photo.pfm" --depth "$dir/demo.png" --intrinsics 30,30,11.5,11.5 -o "$dir/bad.png"
status 1 mix --photo "$dir/nowhere.pfm" --depth "$dir/wall.pfm" --intrinsics 30,30,11.5,11.5 -o "$dir/bad.png"
status 2 mix --photo "$dir/photo.pfm" --depth "$dir/wall.pfm" --intrinsics 0,30,11.5,11.5 -o "$dir/bad.png"
status 1 mix $seen --object "$dir/nowhere.obj" -o "$dir/bad.png"
status 2 mix $seen --object "$dir/tent.obj" --at 24,0 -o "$dir/bad.png"
status 2 mix $seen --object "$dir/tent.obj" --at 3e9,5 -o "$dir/bad.png"
status 1 mix --frame "$dir/nowhere" -o "$dir/bad.png"
status 2 mix --photo "$dir/photo.pfm" --depth "$dir/wall.pfm" -o "$dir/bad.png"
status 2 mix --photo "$dir/photo.pfm" -o "$dir/bad.png"
status 2 mix $seen
status 2 mix $seen -o "$dir/bad.png" --show nonsense
status 2 mix $seen -o "$dir/bad.png" --shadow-map 100
status 2 mix $seen -o "$dir/bad.png" --roughness 2
status 2 mix $seen -o "$dir/bad.png" --show object
status 0 mix --help
# The fixed workload: its own quads need no files.
if [ -z "$SHORT" ]; then
    check "bench raster draws the quads" sh -c '"$1" bench raster fill-depth --seconds 0.01 | grep -c "^lambent,fill-depth-.*,tris=64,cpu_min_ms=[0-9]" | grep -qx 2' sh "$TOOL"
    check "bench raster prints JSON" sh -c '"$1" bench raster fill-gouraud --seconds 0.01 --json | grep -q "^{.case.:.fill-gouraud-1280x720.,"' sh "$TOOL"
    check "bench raster holds filling against a peak" sh -c '"$1" bench raster fill-depth-pass --seconds 0.01 --json | grep -q ",.pixels_per_s.:[1-9][^,]*,.peak.:[1-9][^,]*,.*.share.:[0-9.]*}$"' sh "$TOOL"
    status 0 bench raster fill-depth --seconds 0.01 -q --html "$dir/shares.html"
    check "bench raster --html has a bar a case" sh -c 'grep -o "<rect class=.on.[^>]*>" "$1" | grep -c "width=.[1-9]" | grep -qx 2' sh "$dir/shares.html"
fi
status 2 bench raster nonsense
status 1 bench raster fill-depth --seconds 0.01 --html "$dir/none/shares.html"
status 2 bench raster fill-depth --seconds 1x
status 2 bench raster fill-depth --seconds 0.01 --threads 2
mkdir -p "$dir/flat" # one vertex at 0 and no triangle
printf '\001\000\000\000' >"$dir/flat/bunny.mesh"
head -c 36 /dev/zero >>"$dir/flat/bunny.mesh"
status 1 bench raster bunny-depth-1024 --data "$dir/flat" --seconds 0.01
# Other rasterizers' programs, which are scripts here.
peer() {
    mkdir -p "$dir/peers_$1"
    printf '#!/bin/sh\n%s\n' "$2" >"$dir/peers_$1/$1"
    chmod +x "$dir/peers_$1/$1"
}
quad="bench raster fill-depth-pass --seconds 0.01"
peer good 'echo "#cov 1"; echo "x,$1-cull,cpu_min_ms=9"; echo "x,$1,tris=64,cpu_min_ms=1e3,n=8"; echo "$BENCH_SEC" >"$0.txt"'
status 0 $quad --peers "$dir/peers_good"
check "bench raster --peers prints theirs beside ours" sh -c 'sed 1d "$1" | grep -qx "good,fill-depth-pass-1024,cpu_min_ms=1000.0000,times=[1-9][0-9.]*"' sh "$dir/out.txt"
check "it tells them how long to measure" grep -qx 0.01 "$dir/peers_good/good.txt"
status 0 $quad --json --peers "$dir/peers_good"
check "bench raster --peers prints JSON" grep -q '^{"peer":"good","case":"fill-depth-pass-1024","cpu_min_ms":1000.0000,"times":[1-9][0-9.]*}$' "$dir/out.txt"
peer crash 'kill -SEGV $$'
peer fails 'echo "x,$1,cpu_min_ms=1"; exit 3'
peer rubbish 'head -c 100000 /dev/urandom; echo; echo "x,$1,cpu_min_ms=fast"'
peer missing "" && printf '#!%s/nowhere\n' "$dir" >"$dir/peers_missing/missing"
for case in "crash: ended by signal 11 at" "fails: exit status 3 at" "rubbish: printed no line" "missing: it cannot be run"; do
    "$TOOL" $quad --peers "$dir/peers_${case%%:*}" >"$dir/out.txt" 2>"$dir/err.txt"
    check "bench raster --peers refuses one: $case" test $? -eq 1
    check "and says so in a line" sh -c 'test "$(grep -c . "$1")" -eq 1 && grep -q "$2" "$1"' sh "$dir/err.txt" "$case"
done
status 1 $quad --peers "$dir/nowhere"
mkdir -p "$dir/peers_none"
echo "no program" >"$dir/peers_none/readme.txt"
status 1 $quad --peers "$dir/peers_none"
status 1 $quad --peers "$dir/peers_good/good"
status 2 $quad --peers
# Threads beside processes: wants more than one, and sponza.
status 2 bench threads --threads 1
status 2 bench threads gather
status 2 bench threads --threads 2x
status 2 bench threads --json
BENCH_DATA= status 1 bench threads --seconds 0.01
# The gather, a line for each backend that is here; how fast is nobody's promise.
n='[0-9.]*(e[+-][0-9]*)?' # a number
ops="\\{(\"[a-z]+\":$n,?){7}\\}"
line="^\\{\"case\":\"gather\",\"backend\":\"[a-z0-9]+\",\"pairs_per_s\":$n,\"cycles_per_pair\":$n,\"bound_cycles\":$n,\"share\":$n"
line="$line,\"unit\":\"[a-z]+\",\"ghz\":$n,\"ops_per_vector\":$ops,\"cycles_per_op\":$ops,\"load_per_op\":$ops\\}\$"
status 0 bench gather --seconds 0.01 --json
backends=$(grep -c . "$dir/out.txt")
check "bench gather prints one object a line" test "$backends" -eq "$(grep -cE "$line" "$dir/out.txt")"
check "bench gather ends with the scalar lanes" sh -c 'tail -n 1 "$1" | grep -q "\"backend\":\"scalar\""' sh "$dir/out.txt"
check "the gather's operations are counted" test "$backends" -eq "$(grep -c '"ops_per_vector":{"mul":[1-9][0-9.]*,"add":[1-9][0-9.]*,"max":[1-9][0-9.]*,"div":2[.0-9]*,"cmp":[1-9].*"sqrt":1[.0-9]*}' "$dir/out.txt")"
status 0 bench gather --backend scalar --seconds 0.01
check "bench gather --backend measures that one" grep -q '^lambent,gather,backend=scalar,pairs_per_s=[1-9].*,share=[0-9.]*,unit=[a-z]*,ghz=' "$dir/out.txt"
check "and no other" test "$(grep -c . "$dir/out.txt")" -eq 1
# Every figure of a group of cases on a line, and within its bound.
status 0 bench hard raster
check "bench hard prints a line a case" test "$(grep -c '^raster ' "$dir/out.txt")" -ge 20
status 0 bench hard mixed --json --backend scalar
check "bench hard --json says which hold" test "$(grep -c ',"holds":true}$' "$dir/out.txt")" -ge 8
status 2 bench hard nowhere
said "CASES: \`nowhere\` is not raster, shadow, bounce, probe, relief, mixed, far, whole or baked"
status 2 bench hard rastr
said "did you mean raster?"
status 2 bench hard raster shadow
status 2 bench hard --seconds 1
status 0 bench hard probe -q
check "bench hard -q is its exit status" sh -c '! test -s "$1" && ! test -s "$2"' sh "$dir/out.txt" "$dir/err.txt"
status 0 bench hard probe -v
check "bench hard -v says how long it took" grep -q '^lambent: bench hard took .* s$' "$dir/err.txt"
status 0 bench raster fill-depth --seconds 0.01 -q
check "bench raster -q prints nothing" sh -c '! test -s "$1"' sh "$dir/out.txt"
status 0 bench gather --backend scalar --seconds 0.01 --quiet
check "bench gather -q prints nothing" sh -c '! test -s "$1"' sh "$dir/out.txt"
status 2 bench gather -q -v
said "--quiet and --verbose exclude each other"

status 2 bench gather --backend nothing
status 2 bench gather bunny
status 2 bench gather --linear
# Speed against error: a sweep as table, CSV, JSON, SVG and one page.
sweep="demo --size 24x16 --runs 1 --cache $dir/kept"
status 0 bench $sweep --sweep tree=8,16,32 --shadow-map 64 --breakdown 1 -o "$dir/swept" --svg "$dir/swept.svg"
check "bench prints a line a setting" test "$(grep -cE '^(front|knee|     ) .*--tree (8|16|32) ' "$dir/out.txt")" -eq 3
check "bench prints the breakdown" grep -q '^error breakdown of --tree 8' "$dir/out.txt"
check "CSV: a head and three lines of as many columns" sh -c 'awk -F, "NR == 1 { n = NF } NF != n { exit 1 } END { exit NR != 4 }" "$1"' sh "$dir/swept.csv"
check "JSON has the settings" grep -q '"setting": "--tree 32", .*"same_bytes": null' "$dir/swept.json"
check "the page is whole, with pictures in it" sh -c 'tail -n 1 "$1" | grep -q "</html>$" && grep -q "src=\"data:image/png;base64,iVBOR" "$1"' sh "$dir/swept.html"
check "the page asks for nothing else" sh -c '! grep -qE "<script|<link|url\(|src=\"[^d]" "$1"' sh "$dir/swept.html"
check "SVG is whole" sh -c 'head -c 5 "$1" | grep -q "<svg " && tail -n 1 "$1" | grep -q "</svg>$"' sh "$dir/swept.svg"
check "each setting has its command" grep -q '<pre>lambent render --show indirect --threads 1 demo --size 24x16 --shadow-map 64 -o picture.pfm --tree 8$' "$dir/swept.html"
check "the truth is kept, once" test "$(ls "$dir/kept" | wc -l)" -eq 1
cp "$dir/kept/"*.pfm "$dir/truth24.pfm"
status 0 bench $sweep --sweep tree=64 --shadow-map 64 --breakdown 0
check "by the scene and its settings" test "$(ls "$dir/kept" | wc -l)" -eq 1
status 0 bench demo --runs 1 --shadow-map 64 --truth "$dir/truth24.pfm" --sweep tree=8 --breakdown 0
check "a truth of one's own gives the size" grep -q -- '--size 24x16' "$dir/out.txt"
# Refused before the work, whole or not at all.
status 1 bench demo --size 4000x4000 -o "$dir/no/such/folder"
status 1 bench demo --size 24x16 --truth "$dir/nothing.pfm"
status 1 bench demo --size 32x16 --shadow-map 64 --truth "$dir/truth24.pfm" --sweep tree=8 -o "$dir/unequal"
absent "$dir/unequal.html"
status 1 bench "$dir/nowhere.glb" -o "$dir/unequal"
absent "$dir/unequal.csv"
status 2 bench demo --shadow-map 64 --sweep tree=8,3
status 2 bench demo --sweep tree
status 2 bench demo --runs 0
status 2 bench demo --stats x.json
status 2 bench demo --tree
for ask in demo relight relief mix; do
    status 0 bench $ask --help
    check "bench $ask --help says something, once" test "$(grep -c '^usage:' "$dir/out.txt")" -eq 1
done
status 0 bench relight --world demo --runs 1 --sweep filter=cosine,sh9,blur --csv "$dir/filters.csv"
check "filters in their order" sh -c 'awk -F, "NR == 1 { for (i = 1; \$i != \"trim\"; ++i); next } { e[NR] = \$i } END { exit !(e[2] < e[3] && e[3] < e[4]) }" "$1"' sh "$dir/filters.csv"
status 1 bench relight --world "$dir/nowhere.pfm" --runs 1
status 0 bench relight --world demo --object demo --at 0,0,0 --size 24x16 --runs 1 --sweep samples=1,4 --csv "$dir/objects.csv"
check "objects by samples: more are nearer to the truth" sh -c 'awk -F, "NR == 1 { for (i = 1; \$i != \"trim\"; ++i); next } { e[NR] = \$i } END { exit !(e[2] > e[3]) }" "$1"' sh "$dir/objects.csv"
status 0 bench relief "$dir/pit.obj" --runs 1 --size 16 --triangles 20 --sweep views=6,14
check "reliefs by views" test "$(grep -c -- '--views' "$dir/out.txt")" -eq 2
status 0 bench mix $seen --object "$dir/tent.obj" --light sun:0,0,0:0.6,-0.2,-1:2,2,2 --runs 1 --sweep voxels=4,5 --truth "$dir/mixed.pfm"
status 2 bench mix $seen --show planes
# --- plan: what is left out and why; budgets ---

plan="--size 32x24 --shadow-map 64 --threads 1"
status 0 plan demo $plan
check "a plan says that nothing is glossy" grep -q "^lobes .*left out (exact): nothing that is drawn is glossy" "$dir/out.txt"
check "a plan counts bounced light" grep -q "^bounced light .*tiles' cuts, .* pairs" "$dir/out.txt"
status 0 plan demo $plan --light point:0,1,0:0,-1,0:0,0,0
check "a plan says that a light of 0 W gives nothing" grep -q "^bounced light .*(exact): no light meets a triangle" "$dir/out.txt"
status 0 plan demo $plan --show direct --json
check "a plan's JSON says what is not shown" \
    grep -q '"stage": "bounced light", "runs": false, "why": "the picture does not show it", "proof": "exact"' "$dir/out.txt"
printf '%s\n' 'v -1 0 -1' 'v 1 0 -1' 'v 1 0 1' 'v -1 0 1' 'v -1 1 -1' 'v 1 1 -1' 'f 4 3 2 1' 'f 1 2 6 5' >"$dir/corner.obj"
corner="$dir/corner.obj --size 32x24 --threads 1 --eye 1,2,4 --target 0,0.4,0 --light point:0.3,1.5,0.2:0,-1,0:9,9,9"
status 0 plan $corner --budget-bytes 100KiB
check "100 KiB are too few, and by how much" grep -q "no setting meets the budget; the nearest takes [0-9.]* x the bytes" "$dir/out.txt"
# A look is a part of the picture that it plans: its share of the work is told, and at most a quarter.
status 0 plan demo --size 240x180 --threads 1 --budget-error 0.2 --json
check "a look takes at most a quarter of what it plans" awk -F '"look_work": |"estimated_work": ' '
    /"look_work"/ { look = $3 + 0; work = $2 + 0 } END { exit !(look > 0 && look <= 0.25 * work) }' "$dir/out.txt"
check "what is chosen for an error is checked" grep -q '"checked": true' "$dir/out.txt"
if [ -z "$SHORT" ]; then
    status 0 plan demo --size 240x180 --threads 1 --budget-error 0.00001
    check "an error that no setting has is said" grep -q "^no setting .*the budget" "$dir/out.txt"
fi
status 0 plan $corner --budget-ms 16 --rate 1e4
check "so are 160 units" grep -q "no setting meets the budget; the nearest takes [0-9.e+]* x the work" "$dir/out.txt"
status 0 plan --help
check "plan --help has budgets and examples" sh -c 'grep -q -- --budget-bytes "$1" && grep -q "lambent plan demo" "$1"' sh "$dir/out.txt"
status 2 plan
status 2 plan demo -o "$dir/plan.png"
status 2 plan demo --show depth
status 2 plan demo --budget-error 0.1 --grouping zones
status 2 plan demo --budget-ms 16 --budget-work 1e6
status 2 plan demo --budget-bytes 100kB
status 2 render demo --json -o "$dir/plan.png"
status 2 render demo --budget-error 0.1 --show direct -o "$dir/plan.png"
status 1 plan "$dir/nowhere.gltf"
absent "$dir/plan.png"

# What is chosen for a budget is said as options that draw the same picture.
status 0 render demo --size 240x180 --threads 1 --exposure 0 --budget-error 0.2 -o "$dir/budget.pfm"
check "an easy budget is met" grep -q "^lambent: the budget is met" "$dir/err.txt"
chosen=$(sed -n 's/^lambent: chosen: \(.*\): error about.*/\1/p' "$dir/err.txt")
status 0 render demo --size 240x180 --threads 1 --exposure 0 $chosen -o "$dir/chosen.pfm"
check "the chosen settings draw the same: $chosen" cmp -s "$dir/budget.pfm" "$dir/chosen.pfm"
status 0 bench --calibrate --threads 1
check "calibrating gives a rate" grep -q "^[0-9.e+]* units of work a second, threads: 1 " "$dir/out.txt"
status 2 bench --calibrate demo

. tests/scripts/cli_manners.sh
. tests/scripts/cli_world.sh
. tests/scripts/cli_pack.sh
. tests/scripts/cli_slices.sh

finish
