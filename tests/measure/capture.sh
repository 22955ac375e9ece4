# capture.sh: compares an object lit by a few captured cubes with the object drawn in the scene.
#
# The object, a matte white cow of 1.2 m, stands at places of Sponza that no sun reaches. Drawn in the scene, it gets
# two bounces. Otherwise it is lit by the one cube in the middle or by three; the cubes contain one bounce, so that
# both have light that was reflected twice. A third way adds --contact to three cubes, so that the object shadows
# itself and the ground. A row has the RMSE of the object's pixels over their mean, that mean over the right one, and
# the total time of a picture. The first path was inspected during development, the second was not. FRAME (default
# 160x120), FACES (default 64).
. tests/scripts/checks.sh

shared=${LMB_SHARED:-../shared}
work=$B/measure/capture
size=${FRAME:-160x120}
mkdir -p "$work"
[ -f "$shared/truth/sponza/mesh.obj" ] && [ -f "$shared/data/meshes/spot.obj" ] ||
    { skip "no shared folder"; finish; }
sun='--light sun:0,0,0:0.3234507,-0.924145,0.2033119:10,9.6,8.8'

# Writes the cow with its feet in the middle of y = 0, 1.2 m long; also appended to the scene's own vertices.
cow() {
    awk -v x="$1" -v y="$2" -v z="$3" -v before="$4" '
        NR == FNR { if ($1 == "v") { for (i = 2; i <= 4; ++i) { if (!n || $i < low[i]) low[i] = $i; if (!n || $i > high[i]) high[i] = $i } n = 1 } next }
        FNR == 1 { for (i = 2; i <= 4; ++i) if (high[i] - low[i] > longest) longest = high[i] - low[i]; s = 1.2 / longest; print "usemtl cow" }
        $1 == "v" { printf "v %.7f %.7f %.7f\n", x + s * ($2 - (low[2] + high[2]) / 2), y + s * ($3 - low[3]), z + s * ($4 - (low[4] + high[4]) / 2) }
        $1 == "f" { split($2, a, "/"); split($3, b, "/"); split($4, c, "/"); print "f", a[1] + before, b[1] + before, c[1] + before }
    ' "$shared/data/meshes/spot.obj" "$shared/data/meshes/spot.obj"
}
{ cat "$shared/truth/sponza/mesh.mtl"; printf 'newmtl cow\nKd 0.7 0.7 0.7\n'; } >"$work/cow.mtl"
{ echo 'mtllib cow.mtl'; cow 0 0 0 0; } >"$work/cow.obj"
vertices=$(grep -c '^v ' "$shared/truth/sponza/mesh.obj")

ms() { date +%s%N | cut -c1-13; }
seconds() { awk -v a="$1" -v b="$2" 'BEGIN { printf "%.2f", (b - a) / 1000 }'; }
error() { "$TOOL" compare "$1" "$work/there.pfm" --mask "$work/mask.pfm" 2>/dev/null | grep -o 'rmse [0-9.]*' | cut -d' ' -f2; }
level() { "$TOOL" compare "$1" "$work/there.pfm" --mask "$work/mask.pfm" 2>/dev/null | grep -o 'mean [0-9.]*' | cut -d' ' -f2; }

# carried OUT WORLD PLACE EYE TARGET [--contact]
carried() {
    # shellcheck disable=SC2086
    "$TOOL" relight $2 --object "$work/cow.obj" --at "$3" --eye "$4" --target "$5" --fov 40 --f0 0 --roughness 1 \
        --size "$size" ${6:-} -q -o "$1"
}

# path NAME Y HEIGHT CENTRES -- X,Z ...: captures cubes at X,HEIGHT,Z of the centres.
path() {
    name=$1 y=$2 height=$3 faces=${FACES:-64}
    shift 3
    at=''
    while [ "$1" != -- ]; do
        at="$at --at ${1%,*},$height,${1#*,}"
        shift
    done
    shift
    before=$(ms)
    # shellcheck disable=SC2086
    "$TOOL" capture "$shared/truth/sponza/scene.gltf" $at --faces "$faces" --ground "$work/$name.pfm" --ground-height "$y" \
        -o "$work/${name}_%02d.pfm" 2>/dev/null >"$work/$name.txt" || { fail "$name: no cubes"; return; }
    echo "$name: three cubes of 6 x $faces x $faces and the ground: $(seconds "$before" "$(ms)") s"
    all=$(cat "$work/$name.txt")
    rest=${all#* --world-box}
    one="--world $work/${name}_01.pfm $(echo "$all" | grep -o -e '--world-centre [^ ]*' | sed -n 2p) --world-box$rest"
    printf '%-10s %8s %8s %8s %8s %8s %8s %10s %10s %10s\n' place 'one' '(mean)' 'three' '(mean)' 'contact' '(mean)' \
        'carried s' 'contact s' 'drawn s'
    for to in "$@"; do
        x=${to%,*} z=${to#*,}
        eye=$(awk -v x="$x" -v y="$y" -v z="$z" 'BEGIN { print x - 2 "," y + 1.3 "," z + 0.4 }') target="$x,$(awk -v y="$y" 'BEGIN { print y + 0.5 }'),$z"
        { echo 'mtllib cow.mtl'; grep -v mtllib "$shared/truth/sponza/mesh.obj"; cow "$x" "$y" "$z" "$vertices"; } >"$work/there.obj"
        cow "$x" "$y" "$z" 0 | { echo 'mtllib cow.mtl'; cat; } >"$work/alone.obj"
        view="--eye $eye --target $target --fov 40 --size $size"
        # shellcheck disable=SC2086
        "$TOOL" render "$work/alone.obj" $view --show albedo -q -o "$work/mask.pfm" &&
            "$TOOL" render "$work/there.obj" $view $sun --show direct -q -o "$work/direct.pfm" || { fail "$name $to"; return; }
        before=$(ms)
        # shellcheck disable=SC2086
        "$TOOL" render "$work/there.obj" $view $sun --bounces 2 --rest none -q -o "$work/there.pfm" || { fail "$name $to"; return; }
        drawn=$(seconds "$before" "$(ms)")
        carried "$work/one.pfm" "$one" "$x,$y,$z" "$eye" "$target"
        before=$(ms)
        carried "$work/three.pfm" "$all" "$x,$y,$z" "$eye" "$target" || { fail "$name $to"; return; }
        took=$(seconds "$before" "$(ms)")
        before=$(ms)
        carried "$work/contact.pfm" "$all" "$x,$y,$z" "$eye" "$target" --contact || { fail "$name $to"; return; }
        touched=$(seconds "$before" "$(ms)")
        printf '%-10s %8s %8s %8s %8s %8s %8s %10s %10s %10s %s\n' "$to" "$(error "$work/one.pfm")" "$(level "$work/one.pfm")" \
            "$(error "$work/three.pfm")" "$(level "$work/three.pfm")" "$(error "$work/contact.pfm")" \
            "$(level "$work/contact.pfm")" "$took" "$touched" "$drawn" \
            "$("$TOOL" compare "$work/direct.pfm" "$work/there.pfm" --mask "$work/mask.pfm" 2>/dev/null | grep -o 'mean [0-9.]*' | awk '$2 > 0.001 { print "in the sun" }')"
        cp "$work/there.pfm" "$work/$name-$to-there.pfm"; cp "$work/three.pfm" "$work/$name-$to-three.pfm"
        cp "$work/contact.pfm" "$work/$name-$to-contact.pfm"
    done
    pass
}

path court 0.1 1.5 -8,-1.5 0,-1.5 8,-1.5 -- -8,-1.5 -4,-1.5 0,-1.5 4,-1.5 8,-1.5
path aisle 0.1 1.5 -10,5 0,5 10,5 -- -9,4.8 -5,4.8 -1,4.8 3,4.8 7,4.8
finish
