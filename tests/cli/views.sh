# views.sh: checks that objects close to the eye are visible in a scene of any size, and that --near cuts them away.
. tests/cli/common.sh

# sign SIDE AWAY WIDE: writes a ground of SIDE metres, and a square that fills the picture AWAY metres in front of the
# eye. The eye is at 0,1.6,0 and looks along -Z.
sign() {
    awk -v h="$1" -v d="$2" 'BEGIN {
        h /= 2; printf "v %g 0 %g\nv %g 0 %g\nv %g 0 %g\nv %g 0 %g\nf 1 2 3 4\n", -h, h, h, h, h, -h, -h, -h
        printf "v %.9g %.9g %.9g\nv %.9g %.9g %.9g\n", -2 * d, 1.6 - 2 * d, -d, 2 * d, 1.6 - 2 * d, -d
        printf "v %.9g %.9g %.9g\nv %.9g %.9g %.9g\nf 5 6 7 8\n", 2 * d, 1.6 + 2 * d, -d, -2 * d, 1.6 + 2 * d, -d }' >sign.obj
}
ahead="--eye 0,1.6,0 --target 0,1.6,-1"

# depths LOW HIGH: checks that all 64 depths of a picture of 8 x 8 are in this range.
depths() {
    tail -c 256 seen.pfm | od -An -v -tf4 | tr -s ' ' '\n' | awk -v low="$1" -v high="$2" '
        /./ { ++n; ok += $1 >= low && $1 <= high } END { exit !(n == 64 && ok == 64) }'
}

for case in 1000:0.05 4000:0.2 20000:0.5 20000:0.01 60000:0.001; do
    sign "${case%:*}" "${case#*:}"
    status 0 render sign.obj $ahead --size 8x8 --show depth -o seen.pfm
    check "in ${case%:*} m a sign ${case#*:} m before the eye is seen" depths \
        "$(awk -v d="${case#*:}" 'BEGIN { print d * 0.99999 }')" "$(awk -v d="${case#*:}" 'BEGIN { print d * 1.00001 }')"
done
sign 20000 0.5
status 0 render sign.obj $ahead --size 8x8 --show depth --near 0.6 -o seen.pfm
check "--near cuts the sign away" sh -c 'tail -c 256 "$1" | od -An -v -tf4 | tr -s " " "\n" | awk "\$1 > 0 && \$1 < 0.6 { ++n } END { exit n > 0 }"' sh seen.pfm
status 0 render sign.obj $ahead --size 8x8 --show depth --near 0.4 -o seen.pfm
check "what is beyond it stays" depths 0.49999 0.50001
for bad in 0 -1 2e6 x; do
    status 2 render sign.obj $ahead --size 8x8 --near $bad -o bad.pfm
done

# The same rule holds for frames of `play` and for several models.
light="--light sun:0,0,5:0,0,-1:3,3,3 --show direct"
status 0 render sign.obj $ahead --size 8x8 $light -o lit.pfm
echo "0 camera 0,1.6,0 0,1.6,-1" >stays.txt
status 0 play sign.obj $ahead --size 8x8 $light --path stays.txt --frames 1 -o frame%01d.pfm
check "frames show the sign, too" cmp -s lit.pfm frame0.pfm

# If an orthographic camera has znear 0, its near plane is at 0.
flat() {
    printf '{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],"nodes":[{"mesh":0},{"camera":0}],
"cameras":[{"type":"orthographic","orthographic":{"xmag":1,"ymag":1,"znear":%s,"zfar":30000}}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":6,"type":"VEC3"}],
"bufferViews":[{"buffer":0,"byteLength":72}],"buffers":[{"byteLength":72,"uri":"%s"}]}' "$1" \
    "data:application/octet-stream;base64,AACAwAAAgMAAAAC/AACAQAAAgMAAAAC/AAAAAAAAwEAAAAC/AECcxgBAnMYAQJzGAECcRgBAnMYAQJzGAAAAAABAnEYAQJzG"
}
flat 0 >flat.gltf
status 0 render flat.gltf --size 8x8 --show depth -o seen.pfm
check "an orthographic camera with znear 0 cuts nothing" depths 0.49 0.51
flat 1 >flat.gltf
status 0 render flat.gltf --size 8x8 --show depth -o seen.pfm
check "znear 1 cuts what is at 0.5 m" depths 10000 30000

finish
