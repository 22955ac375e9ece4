# relight.sh: relight: worlds, filters, objects in the built-in world, places along a path, --contact.
. tests/cli/common.sh

white

# In a world of constant radiance every normal receives pi times that radiance, at any place and with any filter.
for filter in cosine sh9 sh16 sh25 blur blur1 blur2; do
    status 0 relight --world white.pfm --at 30,2,-9 --filter $filter --faces 3 --cube cube.pfm
    check "relight --filter $filter is pi" sh -c '"$1" info "$2" | grep -c "min 3.14159 .*max 3.14159 " | grep -qx 3' sh "$TOOL" cube.pfm
done
status 0 relight --world face --world-box -1,-1,-1,1,1,1 --cube cube.png --map map.pfm
check "where faces are missing it is dark" sh -c '"$1" info "$2" | grep -q "red   min 0 *max 0.9"' sh "$TOOL" map.pfm
for option in "--storage log8" "--storage log16" "--overlap mean" "--backend scalar" "--ground facepx.pfm --ground-size 4,4"; do
    status 0 relight --world white.pfm $option --cube cube.pfm
done
status 1 relight --world nowhere --cube bad.pfm
status 1 relight --world facepx.pfm --cube bad.pfm
status 1 relight --world white.pfm --world-centre 9,0,0 --world-sphere 0,0,0,5 --cube bad.pfm
status 1 relight --world white.pfm --ground nowhere.png --cube bad.pfm
status 2 relight --world white.pfm
status 2 relight --world white.pfm --cube bad.txt
status 2 relight --world white.pfm --cube bad.pfm --faces 65
status 2 relight --world white.pfm --cube bad.pfm --filter sh4
status 2 relight --cube bad.pfm
status 0 relight --help
# Objects in the built-in world: normal and glossy add up to both, everywhere; places along a path.
field="relight --world demo --object demo --size 48x24 --exposure 0"
for show in both normal glossy; do
    status 0 $field --show $show -o "field-$show.pfm"
done
check "glossy alone is darker than both" sh -c '"$1" compare "$2" "$3" --json | grep -q "\"mean\":0\.[0-9]"' sh "$TOOL" field-glossy.pfm field-both.pfm
status 0 $field --backend scalar -o field-scalar.pfm
check "a backend changes the field" cmp field-both.pfm field-scalar.pfm
status 0 $field --at 3,0,1 --roughness 0 --f0 0.9 --per-part --light sun:0,0,0:-1,-1,0:2,2,2 --cube cube.pfm -o field.png
# Two eyes: each half has the bytes of one eye there.
eyes="relight --world demo --object demo --size 48x24 --exposure 0 --at 1,0,2"
status 0 $eyes --eye 0,2.3,8.4 --target 0,0.9,0 --stereo 0.3 -o both.ppm
status 0 $eyes --eye -0.15,2.3,8.4 --target -0.15,0.9,0 -o left.ppm
status 0 $eyes --eye 0.15,2.3,8.4 --target 0.15,0.9,0 -o right.ppm
for eye in left right; do
    tail -c 3456 $eye.ppm | od -An -v -tx1 -w144 >one.txt
    tail -c 6912 both.ppm | od -An -v -tx1 -w144 | sed -n "$(test $eye = left && echo 'p;n' || echo 'n;p')" >half.txt
    check "relight --stereo: the $eye eye" cmp one.txt half.txt
done
check "relight --stereo: the eyes differ" sh -c '! cmp -s left.ppm right.ppm'
status 2 $eyes --stereo 0 -o both.ppm
status 2 $eyes --size 5000x8 --stereo 0.3 -o both.ppm
printf '# a walk\n0,0,0\n0.1,0,0\n\n 1,0,0 \n1,0,0' >path.txt
status 0 $field --path path.txt -o walk.ppm
check "a walk keeps its light while it is near" grep -q '^light computed 2 times, kept 2 times$' out.txt
check "a walk has a picture a place" sh -c 'test -s "$1/walk-0000.ppm" && test -s "$1/walk-0003.ppm" && ! test -e "$1/walk-0004.ppm"' sh .
status 0 $field --path path.txt --reuse 0 -o walk.ppm
check "a walk without reuse is computed until it rests" grep -q '^light computed 3 times, kept 1 times$' out.txt
status 0 $field --path path.txt --reuse 5 --keep 0,0.9,0 -o walk.ppm
check "a named place serves the whole walk" grep -q '^light computed 1 times, kept 3 times$' out.txt
printf '2,0,1\n2.2,0,1\n2,0,1\n' >path.txt
for parts in "" --per-part; do
    status 0 $field --path path.txt --keep 2,0,1 $parts -o walk.ppm
    check "a named place is where an object stands $parts" sh -c 'test "$(grep -c "  kept$" "$1")" = 1' sh out.txt
done
status 0 $field --path path.txt -o walk.ppm
status 0 $field --path path.txt -o step_%03d.ppm
check "a walk's pictures are numbered by the pattern" cmp step_002.ppm walk-0002.ppm
status 0 $field --path path.txt -q -o walk.ppm
check "a quiet walk prints nothing" sh -c '! test -s "$1" && ! test -s "$2"' sh out.txt err.txt
cp white.pfm bad_001.pfm # the file that the second picture would overwrite is an input
status 2 relight --world bad_001.pfm --object demo --size 16x8 --path path.txt -o bad_%03d.pfm
said "bad_001.pfm: cannot be written: it is read"
check "no picture is drawn where one of them cannot be written" test ! -e bad_000.pfm
rm -f bad_001.pfm
status 2 $field -o bad_%04d.ppm
check "a pattern wants a path" holds 'numbers pictures of a --path' err.txt
# Numbered files are a world that changes; between two of them it is blended, also while an object rests.
series
printf '0,0,0\n0,0,0\n0,0,0\n0,0,0\n' >rests.txt
printf '0,0,0\n' >one.txt
box
changes="relight --object box.obj --size 16x8 --eye 0,1,6 --target 0,1,0"
status 0 $changes --world tone_%02d.pfm --world-every 2 --path rests.txt -o change_%01d.pfm
said "tone_%02d.pfm ends after number 4: from picture 2 on the world stays"
check "light is new in a changed world, and kept in the last one" grep -q '^light computed 3 times, kept 1 times$' out.txt
status 0 $changes --world tone_%02d.pfm --path rests.txt -o each_%01d.pfm
for pair in "tone_03 change_0" "between change_1" "tone_04 change_2" "tone_04 change_3" "tone_04 each_1"; do
    set -- $pair
    status 0 $changes --world "$1.pfm" --path one.txt -o alone_%01d.pfm
    check "in picture $2 the world is $1" sh -c '"$1" compare "$2" "$3" --max rmse=0.00001' sh "$TOOL" "$2.pfm" alone_0.pfm
done
status 2 $changes --world tone_%02d.pfm -o bad.pfm
said "--world tone_%02d.pfm: numbered files need the pictures of a --path"
status 2 $changes --world tone_03.pfm --world-every 2 --path rests.txt -o bad.pfm
said "--world-every needs a numbered --world"
status 2 $changes --world tone_%02d.pfm --world between.pfm --world-centre 0,0,0 --world-centre 1,0,0 --path rests.txt -o bad.pfm
said "numbered files are one world that changes; give no other"
status 2 $changes --world tone_%02d.pfm --path rests.txt -o tone_%02d.pfm
said "tone_%02d.pfm: both --world and -o"
status 1 $changes --world none_%02d.pfm --path rests.txt -o bad.pfm
said "none_%02d.pfm: no world of this name with a number from 0 to 9999"
printf '0,0,0\n0,0,0 between.pfm\n' >named.txt
status 1 $changes --world tone_%02d.pfm --path named.txt -o bad.pfm
said "named.txt: names a world, and a numbered --world already changes"
{ printf 'PF\n2 12\n-1.0\n'; repeated 72 "$two"; } >tone_05.pfm
tool $changes --world tone_%02d.pfm --world-every 1 --path rests.txt -o change_%01d.pfm >out.txt 2>err.txt
check "a series may have files of other sizes, if none is blended" test $? -eq 0
mv tone_05.pfm tone_02.pfm
! tool $changes --world tone_%02d.pfm --world-every 2 --path rests.txt -q -o change_%01d.pfm >out.txt 2>err.txt && pass ||
    fail "a blend of two sizes ends with an error"
said "tone_03.pfm: faces of 1 pixels, and tone_02.pfm has 2; files of one series have one size"
rm -f tone_02.pfm change_*.pfm
# A file that cannot be read ends the walk before the first picture.
cp tone_04.pfm saved.pfm
printf 'no picture' >tone_04.pfm
status 1 $changes --world tone_%02d.pfm --path rests.txt -o change_%01d.pfm
said "tone_04.pfm"
check "no picture is drawn if a later world cannot be read" test ! -e change_0.pfm
mv saved.pfm tone_04.pfm
printf '0,0,0\n1,2\n' >path.txt
status 1 $field --path path.txt -o bad.ppm
check "a path's error names its line" holds 'path.txt:2: `1,2` is not X,Y,Z' err.txt
status 1 $field --path nowhere -o bad.ppm
status 1 relight --world demo --object nowhere.glb -o bad.ppm
status 2 $field --path path.txt --at 0,0,0 -o bad.ppm
for option in "--world-sphere 0,0,0,5" "--world-centre 0,1,0" "--ground-size 5,5" "--ground-height 1"; do
    status 2 $field $option -o bad.ppm
    check "the built-in world says that it lies where it lies: $option" holds 'lies where it lies' err.txt
done
status 2 relight --world demo --object demo
status 2 $field --eye 0,1,2 -o bad.ppm
status 2 $field --roughness 2 -o bad.ppm
status 2 $field --at 3e6,0,0 -o bad.ppm
status 0 $field --ground facepx.pfm --faces 4 --at 0,0,0 -o field.png
if [ -e /dev/full ]; then
    printf '0,0,0\n' >path.txt
    check "a full disk is an error of a walk" sh -c '! "$1" relight --world demo --object demo --size 16x8 --path "$2" -o "$3" >/dev/full 2>/dev/null' sh "$TOOL" path.txt walk.ppm
fi
status 2 $field -o bad.gif
check "nothing was left behind" none bad*

# Contact of objects with the ground and each other: nothing gets brighter, and the ground right below gets darker.
printf 'v -1 0.5 -1\nv 1 0.5 -1\nv 1 0.5 1\nv -1 0.5 1\nf 1 2 3 4\n' >table.obj
low="relight --world white.pfm --ground facepx.pfm --ground-size 40,40 --object table.obj --f0 0 --at 0,0.5,0 --eye 0,0.3,2.5 --target 0,0.1,0 --size 48x24"
status 0 $low -o bright.pfm
status 0 $low --contact -o dark.pfm
check "the ground is darker below a table" sh -c '"$1" compare "$2" "$3" --json | grep -q "\"mean\":0\.[89]"' sh "$TOOL" dark.pfm bright.pfm
status 0 $low --contact --threads 1 --backend scalar -o alike.pfm
check "a backend changes no contact" cmp dark.pfm alike.pfm
printf '0,0.5,0\n3,0.5,0\n0,0.5,0\n' >path.txt
status 0 relight --world white.pfm --ground facepx.pfm --ground-size 40,40 --object table.obj --f0 0 --contact --path path.txt --eye 0,0.3,2.5 --target 0,0.1,0 --size 48x24 -o walk.pfm
check "contact goes with what moves" sh -c 'cmp "$1/walk-0000.pfm" "$1/walk-0002.pfm" && ! cmp -s "$1/walk-0000.pfm" "$1/walk-0001.pfm"' sh .
status 0 relight --world white.pfm --object demo --contact --size 16x8 -o field.png
# A ground that is brighter than its world is lit by lamps that the world does not show: contact makes no bright line.
{ printf 'PF\n1 6\n-1.0\n'; repeated 18 '\315\314\314\075'; } >dim.pfm
box
status 0 relight --world dim.pfm --ground facepx.pfm --ground-size 40,40 --object box.obj --scale 0.5 --contact --eye 0.5,1,2 --target 0,0.1,0 --size 64x48 -o foot.pfm
check "contact makes no bright line at the foot" sh -c '"$1" info foot.pfm | awk "\$1 == \"green\" { exit !(\$5 <= 1.25) }"' sh "$TOOL"
# A ground of radiance 1 at night receives at least the light that it emits, so a white box adds a part of that.
printf 'v -1 0 -1\nv 1 0 -1\nv 1 2 -1\nv -1 2 -1\nv -1 0 1\nv 1 0 1\nv 1 2 1\nv -1 2 1\nf 1 4 3 2\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nf 5 6 7 8\n' >white_box.obj
{ printf 'PF\n1 6\n-1.0\n'; head -c 72 /dev/zero; } >night.pfm
{ printf 'PF\n1 6\n-1.0\n'; repeated 18 '\012\327\243\074'; } >dusk.pfm # 0.02
{ printf 'PF\n1 6\n-1.0\n'; repeated 9 '\012\327\243\074'; head -c 36 /dev/zero; } >dusk_half.pfm
for sky in night dusk; do
    status 0 relight --world "$sky.pfm" --ground facepx.pfm --ground-size 40,40 --object white_box.obj --f0 0 --contact --eye 0,4,9 --target 0,0.5,0 --size 64x48 -o glow.pfm
    check "contact lights a bright ground by a part of its own light: $sky" sh -c '"$1" info "$2" | awk "/ max /{ n += \$5 > 1.05 && \$5 < 1.5 } END { exit n != 3 }"' sh "$TOOL" glow.pfm
done
# A blocker is as dark as its texture or vertex colours: a U of three boxes in one dark grey.
grey_png='\211\120\116\107\015\012\032\012\000\000\000\015\111\110\104\122\000\000\000\001\000\000\000\001\010\002\000\000\000\220\167\123\336\000\000\000\014\111\104\101\124\170\234\143\210\214\214\004\000\002\032\001\014\047\014\256\360\000\000\000\000\111\105\116\104\256\102\140\202'
printf "$grey_png" >grey.png # one texel, 89: 0.0998987 in linear light
chess_png='\211\120\116\107\015\012\032\012\000\000\000\015\111\110\104\122\000\000\000\002\000\000\000\002\010\000\000\000\000\127\335\122\370\000\000\000\016\111\104\101\124\170\332\143\370\317\300\300\360\037\000\006\000\001\377\145\064\370\367\000\000\000\000\111\105\116\104\256\102\140\202'
printf "$chess_png" >chess.png # two by two texels, white and black: 0.5 in the mean
printf 'newmtl flat\nKd 0.0998987 0.0998987 0.0998987\nnewmtl paper\nmap_Kd grey.png\nnewmtl corners\nKd 1 1 1\nnewmtl half\nKd 0.5 0.5 0.5\nnewmtl chess\nmap_Kd chess.png\n' >grey.mtl
for grey in flat paper corners half chess; do
    ink=1 && [ $grey = corners ] && ink=0.349020 # an sRGB code: 0.0998987 in linear light
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
    }' >"grey_$grey.obj"
done
lit="--world white.pfm --ground facepx.pfm --ground-size 40,40 --f0 0 --contact --size 48x32"
for grey in flat paper corners; do
    status 0 relight $lit --object "grey_$grey.obj" --eye 0,2,3 --target 0,0.5,0 -o "grey_$grey.pfm"
    [ $grey = flat ] || check "contact knows how dark $grey is" sh -c '"$1" compare "$2" "$3" | grep -q "^trim 0\.00[0-2]"' sh "$TOOL" "grey_$grey.pfm" grey_flat.pfm
done
for grey in flat half chess; do
    status 0 relight $lit --object "grey_$grey.obj" --eye 2,2,2 --target 2,0,0 --fov 20 -o "grey_$grey.pfm"
done
check "the ground beside a pattern is as bright as beside its mean" sh -c '"$1" compare "$2" "$3" | grep -q "^trim 0\.000"' sh "$TOOL" grey_chess.pfm grey_half.pfm
check "and not as beside a darker one" sh -c '! "$1" compare "$2" "$3" | grep -q "^trim 0\.000"' sh "$TOOL" grey_chess.pfm grey_flat.pfm
# Lobes mirror the darkened ground.
shiny="$(echo "$low" | sed 's/--f0 0 /--f0 0.9 --roughness 0.2 /;s/0,0.3,2.5 --target 0,0.1,0/0.1,0.05,0.3 --target 0,0.5,0/') --show glossy"
status 0 $shiny -o shiny.pfm
status 0 $shiny --contact -o dull.pfm
check "a lobe is darker below a table" sh -c '"$1" compare "$2" "$3" --json | grep -q "\"mean\":0\.[5-9]"' sh "$TOOL" dull.pfm shiny.pfm
# A small lamp in a white world, on the border of two texels of the map; two bowls with smooth normals over a ground
# that ends the shadow within the picture. Each constant of contact changes some of these pixels.
row=$one$one$one$one; row=$row$row$row; row=$row$row$row$row$row$row$row$row
lamp='\000\000\172\104\000\000\172\104\000\000\172\104'
{ printf 'PF\n32 192\n-1.0\n'; i=0; while [ $i -lt 192 ]; do
    if [ $i -eq 180 ]; then printf "$lamp"; printf "$row" | tail -c 372; else printf "$row"; fi
    i=$((i + 1))
done; } >lamp_world.pfm
printf 'v 0 0 0\nv 1 0.3 -1\nv -1 0.3 -1\nv -1 0.3 1\nv 1 0.3 1\nvn 0 1 0\nvn -0.5 0.7 0.5\nvn 0.5 0.7 0.5\nvn 0.5 0.7 -0.5\nvn -0.5 0.7 -0.5\nf 1//1 2//2 3//3\nf 1//1 3//3 4//4\nf 1//1 4//4 5//5\nf 1//1 5//5 2//2\n' >bowl.obj
printf '0,0.2,0\n' >path.txt
status 0 relight --world lamp_world.pfm --ground facepx.pfm --ground-size 60,60 --object bowl.obj --f0 0.2 --roughness 0.3 --contact --at 0,0.2,0 --at 2.1,1.0,0 --eye 1,4,5 --target 1,0,0 --size 64x48 -o bowls.pfm
contact_sum=$(cksum <bowls.pfm)
check "contact's pixels are these: $contact_sum" test "$contact_sum" = "2008633955 36878"

# In a world without a picture of the ground, the lower half is the ground; it gets an object's
# contact and a sun's shadow.
stand="relight --world white.pfm --object table.obj --f0 0 --at 0,0.5,0 --eye 0,0.3,2.5 --target 0,0.1,0 --size 48x24"
least() { "$TOOL" info "$1" | awk -v low="$2" -v high="$3" '/ min /{ n += $3 >= low && $3 <= high } END { exit n != 3 }'; }
status 0 $stand -o stood.pfm
status 0 $stand --no-contact -o hung.pfm
check "a world is a ground without a picture of one" sh -c '"$1" compare "$2" "$3" --json | grep -q "\"mean\":0\.[89]"' sh "$TOOL" stood.pfm hung.pfm
status 0 $stand --floor none -o none.pfm
status 0 $stand --floor none --no-contact -o none2.pfm
check "without a floor nothing stands on it" cmp none.pfm none2.pfm
# Pi from the white world and pi from the sun: the ground keeps half of the light below the table,
# and all of it elsewhere.
noon="--light sun:0,0,0:0,-1,0:3.14159265,3.14159265,3.14159265"
status 0 $stand --no-contact $noon -o noon.pfm
check "a given sun casts a shadow on the ground" least noon.pfm 0.49 0.51
check "and lights it nowhere else" sh -c '"$1" info "$2" | awk "/ max /{ n += \$5 < 1.6 } END { exit n != 3 }"' sh "$TOOL" noon.pfm
status 0 $stand --no-contact $noon --threads 1 --backend scalar -o alike.pfm
check "a backend changes no shadow" cmp noon.pfm alike.pfm
status 0 $low $noon -o noon.pfm
check "a given sun casts a shadow on a picture of the ground" least noon.pfm 0.49 0.51
status 2 $stand --contact --no-contact -o bad.pfm
status 1 $stand --floor on --world-centre 0,-1,0 -o bad.pfm
said "under the --floor"
status 0 relight --world white.pfm --object table.obj --size 16x12 -o framed.png
said "framing the objects from"
# Objects with many vertices are thinned: the contact of a ball hardly changes. The work is bounded
# if many triangles cross.
ball() { awk -v n="$1" 'BEGIN { p = atan2(0, -1)
    for (j = 0; j <= n; ++j) for (i = 0; i < n; ++i)
        printf "v %.6f %.6f %.6f\n", sin(p * j / n) * cos(2 * p * i / n), 1 + cos(p * j / n), sin(p * j / n) * sin(2 * p * i / n)
    for (j = 0; j < n; ++j) for (i = 1; i <= n; ++i) { a = j * n; k = i % n + 1
        print "f", a + i, a + k, a + n + k; print "f", a + i, a + n + k, a + n + i } }'; }
for n in 60 110; do
    ball $n >"ball_$n.obj"
    status 0 relight --world white.pfm --object "ball_$n.obj" --f0 0 --eye 0,2,6 --target 0,0.8,0 --size 64x48 -o "ball_$n.pfm"
done
check "a thinned ball has the contact of a whole one" sh -c '"$1" compare "$2" "$3" | grep -q "^trim 0\.00"' sh "$TOOL" ball_110.pfm ball_60.pfm
if [ "${LMB_LONG:-0}" -gt 1 ]; then # nightly: so many tests take seconds
    awk 'BEGIN { srand(3); for (i = 0; i < 1800; ++i) { z = 2 * rand() - 1; a = 6.2831853 * rand(); r = sqrt(1 - z * z); x = r * cos(a); y = r * sin(a)
        print "v", x, z + 1, y; print "v", -x, 1 - z, -y; print "v", 0.002 - x, 1.002 - z, -y; print "f", 3 * i + 1, 3 * i + 2, 3 * i + 3 } }' >needles.obj
    status 0 relight --world white.pfm --object needles.obj --size 16x12 -o needles.pfm
    said "sights have coarser visibility"
fi

# Files for other programs: a white world has lobes of 1, and harmonics of one constant. A
# transform image gives its map.
for out in - hdr:-; do
    status 2 relight --world white.pfm --lobes $out
    said "--lobes writes six files: give it a file name"
done
status 0 relight --world white.pfm --lobes lobe_%02d.pfm --side 16 --harmonics harmonics.json --dfg dfg.pfm --map own.pfm --map-height 16 --azimuth -90 --save-vectors vectors.pfm
for k in 00 01 02 03 04 05; do
    check "lobe $k of a white world is white" sh -c '"$1" info "$2" | grep -cE "min (1|0.99999.*) .*max (1|1.00000.*) " | grep -qx 3' sh "$TOOL" "lobe_$k.pfm"
done
check "a white world's harmonics" sh -c 'tr -d " \n" <"$1" | grep -q "\"radiance\":\[\[3\.5449.*\"irradiance\":\[\[11\.1366"' sh harmonics.json
check "the smoothest lobe reflects grazing light as a mirror" sh -c '"$1" info "$2" | grep -q "green .*max 0.98"' sh "$TOOL" dfg.pfm
check "a smooth lobe reflects all of F0" sh -c '"$1" info "$2" | grep -q "red .*max 1 "' sh "$TOOL" dfg.pfm
status 0 relight --world face --world-box -1,-1,-1,1,1,1 --map quarter.pfm --map-height 16 --azimuth 0 --save-vectors vectors.pfm
status 0 relight --world face --world-box -1,-1,-1,1,1,1 --map again.pfm --vectors vectors.pfm
check "a saved transform image gives the same map" cmp quarter.pfm again.pfm
status 0 relight --world face --world-box -1,-1,-1,1,1,1 --map half.pfm --map-height 16
check "a map begins at its azimuth" sh -c '! cmp -s "$1" "$2"' sh half.pfm quarter.pfm
# The lamps of the built-in world are summed apart: with another left edge they went to other pixels.
for azimuth in -90 45 179; do
    status 0 relight --world demo --map quarter.pfm --map-height 16 --azimuth $azimuth --save-vectors vectors.pfm
    status 0 relight --world demo --map again.pfm --vectors vectors.pfm
    check "relight --vectors moves the lamps of --azimuth $azimuth" cmp quarter.pfm again.pfm
done
# A sun of one pixel: finer maps and the first lobe have all of its light, which is a mean of 1 in this map.
{ printf 'PF\n128 64\n-1.0\n'; head -c $((12 * (128 * 32 + 40))) /dev/zero; printf '\000\000\000\106%.0s' 1 2 3; head -c $((12 * (128 * 32 - 41))) /dev/zero; } >sun.pfm
status 0 relight --world sun.pfm --map sun_map.pfm --map-height 128
check "a map keeps the light of a sun of one pixel" sh -c '"$1" info sun_map.pfm | awk "/ mean /{ n += \$NF > 0.98 && \$NF < 1.02 } END { exit n != 3 }"' sh "$TOOL"
status 1 relight --world white.pfm --map bad.pfm --vectors white.pfm
said "no transform image"
status 2 relight --world white.pfm --map bad.pfm --vectors vectors.pfm --azimuth 0
status 2 relight --world white.pfm --save-vectors bad.png
status 2 relight --world white.pfm --harmonics bad.json --at 0,0,0 --at 1,0,0
check "a world that is half black is reported" sh -c '"$1" relight --world dusk_half.pfm --cube half_cube.pfm 2>&1 | grep -q "note: dusk_half.pfm: 50 % of it is black or blank"' sh "$TOOL"
# Along a path, light changes smoothly: no step over 1 % although the light changes by 3 % from cube to cube.
awk 'BEGIN { for (i = 0; i < 40; ++i) printf "%.3f,0,-2.5\n", -9.8 + 0.02 * i }' >path.txt
status 0 relight --world demo --object demo --size 16x12 --path path.txt -o walk.ppm
check "steps of light are under 1 %" sh -c 'awk "/^largest step of light/{ ok = \$5 > 0.05 && \$5 <= 1 } END { exit !ok }" "$1"' sh out.txt
awk 'BEGIN { for (i = 0; i < 6; ++i) printf "%.3f,0,-2.5\n", -9.8 + 0.151 * i }' >path.txt
status 0 relight --world demo --object demo --size 16x12 --path path.txt -o walk.ppm
check "and from cube to cube more" sh -c 'awk "/^largest step of light/{ ok = \$5 > 2 } END { exit !ok }" "$1"' sh out.txt

# Several objects: one object at two places equals two objects.
two="relight --world white.pfm --no-contact --eye 0,3,9 --target 1,0.5,0 --size 48x32 $noon"
status 0 $two --object white_box.obj --at -1,0,0 --at 3,0,1 -o twice.pfm
status 0 $two --object white_box.obj --at -1,0,0 --object white_box.obj --at 3,0,1 --scale 2 -o both.pfm
check "two objects are as one at two places" sh -c '"$1" compare "$2" "$3" | grep -q "^trim 0\.000"' sh "$TOOL" both.pfm twice.pfm
status 0 $two --object white_box.obj --at -1,0,0 --object grey_paper.obj --at 3,0,1 --scale 2 --scale 1 -o mixed.pfm
check "each has its own materials" sh -c '! "$1" compare "$2" "$3" | grep -q "^trim 0\.000"' sh "$TOOL" both.pfm mixed.pfm
status 0 relight --world demo --object demo --at 0,0,0 --object white_box.obj --at 2,0,0 --per-part --size 32x24 -o several.png
status 2 $two --object white_box.obj --object table.obj --at 3,0,1 -o bad.pfm
said "give each object its place"
status 2 $two --object white_box.obj --at 0,0,0 --object table.obj --at 3,0,1 --scale 1 --scale 2 --scale 3 -o bad.pfm
status 2 relight --world demo --object demo --object demo --path path.txt -o bad.ppm

# A world that changes along a path: no picture depends on the worlds before.
mkdir -p worlds
{ printf 'PF\n1 6\n-1.0\n'; repeated 9 "$one"; repeated 9 "$half"; } >worlds/evening.pfm
printf '0,0,0\n0.05,0,0 evening.pfm\n0.05,0,0\n0.05,0,0 ../white.pfm\n' >worlds/path.txt
still="--object white_box.obj --f0 0.3 --roughness 0.3 --size 24x16 --eye 2,2,6 --target 0,1,0 -q"
status 0 relight --world white.pfm $still --path worlds/path.txt -o changes_%02d.pfm
status 0 relight --world white.pfm $still --at 0.05,0,0 -o day.pfm
status 0 relight --world worlds/evening.pfm $still --at 0.05,0,0 -o evening.pfm
check "the world changes along a path" cmp evening.pfm changes_01.pfm
check "and stays" cmp evening.pfm changes_02.pfm
check "and changes back" cmp day.pfm changes_03.pfm
check "the worlds differ" differ day.pfm evening.pfm
printf '0,0,0\n1,0,0 nowhere.pfm\n' >worlds/path.txt
status 1 relight --world white.pfm $still --path worlds/path.txt -o bad_%02d.pfm
said "worlds/nowhere.pfm: "
printf '0,0,0\n1,0,0 path.txt\n' >worlds/path.txt
status 1 relight --world white.pfm $still --path worlds/path.txt -o bad_%02d.pfm
printf '0,0,0\n1,0,0 ../white.pfm\n' >worlds/path.txt
status 1 relight --only-here --world white.pfm $still --path worlds/path.txt -o bad_%02d.pfm
cp white.pfm white_00.pfm
printf '0,0,0\n1,0,0 ../white_00.pfm\n' >worlds/path.txt
status 2 relight --world white.pfm $still --path worlds/path.txt -o white_%02d.pfm
check "a picture does not write over a world" cmp white.pfm white_00.pfm
check "a missing world draws nothing" none bad_*.pfm
status 2 relight --world white.pfm --stereo 0.06 --cube bad.pfm
said "--stereo draws a picture for each eye"

finish
