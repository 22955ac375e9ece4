# sequence.sh: runs `lambent mix --frames` on sequences of rooms with a Kinect's noise: flicker of pixels, and time.
#
#     sequence.sh [NAME SCENE EYE TARGET SEED]...    (default: one room used in development, one that was not)
#
# For each room, one camera moves 25 mm a frame, and one stands still while the noise changes. FRAME: size (default
# 640x480). COUNT: number of moving frames (default 21). Flicker: change, of 255, of pixels that are equal in the
# photos: the 99.9th percentile and the maximum. Frames a second and processor seconds a frame cover all frames after
# the first, with their files, on THREADS threads (default 2). OBJECT: default a tent.
. tests/scripts/checks.sh

work=$B/measure/sequence
size=${FRAME:-640x480} count=${COUNT:-21} threads=${THREADS:-2}
maker=$B/measure-sequence
mkdir -p "$work"
printf 'v %s\n' '-1 0 -1' '1 0 -1' '0 0 1' '0 1 0' >"$work/tent.obj"
printf 'f %s\n' '1 2 3' '1 4 2' '2 4 3' '3 4 1' >>"$work/tent.obj"
object=${OBJECT:-$work/tent.obj}

# now: sets wall milliseconds, and processor milliseconds of all child programs.
now() {
    times >"$work/times.txt"
    wall=$(date +%s%N | cut -c1-13)
    cpu=$(sed -n 2p "$work/times.txt" | tr 'ms' '  ' | awk '{ printf "%d", 60000 * ($1 + $3) + 1000 * ($2 + $4) }')
}

# made NAME SCENE EYE TARGET SEED: makes photos and depth, once.
made() {
    d=$work/$1
    mkdir -p "$d"
    [ -f "$d/still.txt" ] && return
    "$maker" poses "$5" "$count" "$3" "$4" 0.025 50 "${size%x*}" "${size#*x}" "$d/f" >"$d/poses.txt" || return 1
    while read -r k eye target; do
        k=$(printf %02d "$k")
        view="--eye $eye --target $target --fov 50 --size $size"
        # shellcheck disable=SC2086
        "$TOOL" render "$2" $view --quality draft -q -o "$d/light$k.pfm" &&
            "$TOOL" render "$2" $view --show depth -q -o "$d/depth$k.pfm" &&
            "$maker" sensor $((100 * $5 + ${k#0})) 50 "$d/light00.pfm" "$d/depth$k.pfm" "$d/light$k.pfm" \
                "$d/f$k.depth.pfm" "$d/f$k.color.png" || return 1
        echo "f$k"
    done <"$d/poses.txt" >"$d/moving.txt"
    for k in 0 1 2 3 4 5; do
        "$maker" sensor $((100 * $5 + 50 + k)) 50 "$d/light00.pfm" "$d/depth00.pfm" "$d/light00.pfm" \
            "$d/s0$k.depth.pfm" "$d/s0$k.color.png" still && cp "$d/f00.json" "$d/s0$k.json" || return 1
        echo "s0$k"
    done >"$d/list.txt"
    mv "$d/list.txt" "$d/still.txt"
}

# timed LIST OUT
timed() {
    now
    took=$wall used=$cpu
    "$TOOL" mix --frames "$1" --object "$object" --fit --threads "$threads" -q -o "$2" || return 1
    now
    took=$((wall - took)) used=$((cpu - used))
}

# sequence NAME SCENE EYE TARGET SEED
sequence() {
    made "$@" || { fail "$1: no photos"; return; }
    for way in moving still; do
        head -n 1 "$d/$way.txt" >"$d/one.txt"
        timed "$d/one.txt" "$d/one%02d.png" || { fail "$1 $way"; return; }
        one=$took one_cpu=$used
        timed "$d/$way.txt" "$d/$way%02d.png" || { fail "$1 $way"; return; }
        frames=$(grep -c . "$d/$way.txt")
        echo "$1, $way, $frames frames: $(awk -v n="$((frames - 1))" -v a="$((took - one))" -v c="$((used - one_cpu))" \
            'BEGIN { printf "%.2f a second, %.3f s of processor each", n * 1000 / a, c / n / 1000 }'), the first one $one ms"
    done
    for k in 1 2 3 4 5; do
        echo "$1: change of a still camera's pixels, frame $k: $("$maker" change "$d/still0$((k - 1)).png" "$d/still0$k.png" "$d/s0$((k - 1)).color.png" "$d/s0$k.color.png")"
    done
    pass
}

if [ $# -eq 0 ]; then
    mkdir -p "$work/kitchen"
    "$B/scenes" kitchen:131 -o "$work/kitchen" >/dev/null || { fail "no kitchen"; finish; }
    from=$(head -n 1 "$work/kitchen/scene.txt" | awk '{ print $3 "," $4 "," $5 " " $6 "," $7 "," $8 }')
    set -- demo demo 0.5,1.4,2.5 0.3,0.6,-1 5 kitchen "$work/kitchen/scene.gltf" "${from% *}" "${from#* }" 91
fi
while [ $# -ge 5 ]; do
    sequence "$1" "$2" "$3" "$4" "$5"
    shift 5
done
finish
