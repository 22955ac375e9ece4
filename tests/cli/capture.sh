# capture.sh: capture: the surroundings of a place in a scene, for relight.
. tests/cli/common.sh

# In a box with walls of radiance 1, any place receives pi.
printf 'newmtl lamp\nKd 0 0 0\nKe 1 1 1\n' >lamp.mtl
printf 'mtllib lamp.mtl\nusemtl lamp\nv -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\nf 1 4 3 2\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nf 5 6 7 8\n' >lamp.obj
status 0 capture lamp.obj --at 0.2,0.1,0 --faces 8 --samples 1 --world none -o lamp.pfm --ground under.pfm
taken=$(cat out.txt)
status 0 relight $taken --at 0.5,0,-0.5 --cube cube.pfm
check "a shining box is pi everywhere" sh -c '"$1" info "$2" | grep -c "min 3.14159 .*max 3.14159 " | grep -qx 3' sh "$TOOL" cube.pfm
# An eye at the place of the cube sees the same picture as the scene: each face has the right orientation.
look="--size 32x32 --fov 90 --eye 0.6,1.1,0.2"
status 0 capture demo --at 0.6,1.1,0.2 --faces 64 --samples 1 --shadow-map 128 --quality draft -o room.pfm
taken=$(cat out.txt)
for way in 1,0,0:0,1,0 -1,0,0:0,1,0 0,1,0:0,0,1 0,-1,0:0,0,-1 0,0,1:0,1,0 0,0,-1:0,1,0; do
    to=$(echo "${way%:*}" | awk -F, '{ print 0.6 + $1 "," 1.1 + $2 "," 0.2 + $3 }')
    status 0 render demo $look --target "$to" --up "${way#*:}" --shadow-map 128 --quality draft -o seen.pfm
    status 0 relight $taken --object lamp.obj --scale 0.001 --at 90,0,0 $look --target "$to" --up "${way#*:}" -o shown.pfm
    check "relight says nothing of options that it lacks" lacks 'emissive\|--glossy\|fixed groups' err.txt
    check "the cube shows what is seen towards $way" sh -c '"$1" compare "$2" "$3" --max e50=0.15' sh "$TOOL" shown.pfm seen.pfm
done
status 0 capture demo --at 0.6,1.1,0.2 --at 0.3,0.8,0.4 --faces 8 --samples 1 --shadow-map 128 --quality draft -o two_%02d.pfm
two=$(cat out.txt)
status 0 relight $two --at 0.45,1,0.3 --cube both.pfm --map map.pfm
status 0 relight $two --at 0.3,0.8,0.4 --cube second.pfm
status 0 relight --world two_01.pfm --world-centre 0.3,0.8,0.4 ${two#*0.4 } --at 0.3,0.8,0.4 --cube alone.pfm
check "where a cube was taken it counts alone" sh -c '"$1" compare "$2" "$3" --max trim=0.001' sh "$TOOL" second.pfm alone.pfm
check "between two it is of both" sh -c '! "$1" compare "$2" "$3" --max trim=0.01 >"$4"' sh "$TOOL" both.pfm alone.pfm out.txt
status 0 relight $two --object demo --scale 0.3 --at 0.45,0.5,0.3 --eye 0.6,1,1 --target 0.45,0.6,0.3 --size 16x16 -o both.ppm
status 2 relight --world two_00.pfm --world two_01.pfm --cube bad.pfm
status 2 relight --world demo --world two_01.pfm --world-centre 0,0,0 --world-centre 0,0,0 --cube bad.pfm
status 2 capture demo --at 0.6,1.1,0.2
status 2 capture demo -o bad.pfm
status 2 capture demo --at 0.6,1.1,0.2 -o bad.png
status 2 capture demo --at 0.6,1.1,0.2 -o bad_%02d.pfm
status 2 capture demo --at 0.6,1.1,0.2 --at 0,1,0 -o bad.pfm
status 2 capture demo --at 0.6,1.1,0.2 -o bad.pfm --ground-height 1
status 1 capture demo --at 0.6,1.1,0.2 -o bad.pfm --ground bad.hdr --ground-height 2
status 1 capture nowhere.obj --at 0,0,0 -o bad.pfm
check "nothing is left behind" none bad* nowhere* *tmp*

finish
