# bake-walls.sh: checks that baked light does not leak through thin walls, in a room of two closed halves with a lamp in
# one. Seeds choose among twelve kinds of walls and orientations. The dark half may have at most 0.1 % of the lit half's
# mean, and 5 % at any pixel.
. tests/cli/common.sh

cat >walls.awk <<'AWK'
function r(a, b) { return a + (b - a) * rand() }
function turned(x, y, z) {
    return sprintf("%.7g %.7g %.7g", m[0] * x + m[1] * y + m[2] * z + t[0], m[3] * x + m[4] * y + m[5] * z + t[1],
                   m[6] * x + m[7] * y + m[8] * z + t[2])
}
function comma(x, y, z, s) { s = turned(x, y, z); gsub(" ", ",", s); return s }
function quad(ax, ay, az, bx, by, bz, cx, cy, cz, dx, dy, dz) {
    printf "v %s\nv %s\nv %s\nv %s\nf -4 -3 -2 -1\n", turned(ax, ay, az), turned(bx, by, bz), turned(cx, cy, cz),
           turned(dx, dy, dz)
}
# A wall over the line from (ax, az) to (bx, bz).
function wall(ax, az, bx, bz, y0, y1) { quad(ax, y0, az, bx, y0, bz, bx, y1, bz, ax, y1, az) }
function box(x0, y0, z0, x1, y1, z1) {
    wall(x0, z0, x0, z1, y0, y1); wall(x1, z0, x1, z1, y0, y1); wall(x0, z0, x1, z0, y0, y1)
    wall(x0, z1, x1, z1, y0, y1)
    quad(x0, y0, z0, x1, y0, z0, x1, y0, z1, x0, y0, z1); quad(x0, y1, z0, x1, y1, z0, x1, y1, z1, x0, y1, z1)
}
function turn(  i, s, c, x, y, z, l) {
    x = r(-1, 1); y = r(-1, 1); z = r(-1, 1); l = sqrt(x * x + y * y + z * z); x /= l; y /= l; z /= l
    s = r(0.2, 3); c = cos(s); s = sin(s)
    m[0] = c + x * x * (1 - c); m[1] = x * y * (1 - c) - z * s; m[2] = x * z * (1 - c) + y * s
    m[3] = y * x * (1 - c) + z * s; m[4] = c + y * y * (1 - c); m[5] = y * z * (1 - c) - x * s
    m[6] = z * x * (1 - c) - y * s; m[7] = z * y * (1 - c) + x * s; m[8] = c + z * z * (1 - c)
    for (i = 0; i < 3; ++i) t[i] = r(-3, 3)
}
BEGIN {
    srand(seed); rand(); turn(); w = r(-0.3, 0.3); e = rand() < 0.5 ? 0 : 0.05; z = r(-0.6, 0); y = r(0.8, 1.2)
    box(-2, 0, -1, 2, 2, 1)
    if (kind == "plane") wall(w, -1, w, 1, 0, 2)
    if (kind ~ /metre$/) box(w, -e, -1 - e, w + (kind ~ /^milli/ ? 0.001 : kind ~ /^centi/ ? 0.01 : 0.1), 2 + e, 1 + e)
    if (kind == "pair") { wall(w, -1, w, 1, 0, 2); wall(w + 0.002, -1, w + 0.002, 1, 0, 2) }
    if (kind == "rim") { wall(w, -1, w, 1, 0, y); quad(w, y, -1, 2, y, -1, 2, y, 1, w, y, 1) }
    if (kind == "door") {
        wall(w, -1, w, z, 0, 2); wall(w, z, w, z + 0.7, 1.4, 2); wall(w, z + 0.7, w, 1, 0, 2)
        wall(w, z, w, z + 0.7, 0, 1.4)
    }
    for (i = 0; i < 16 && kind == "curve"; ++i)
        wall(w + 0.3 * cos(i * 0.19635), -1 + i / 8, w + 0.3 * cos((i + 1) * 0.19635), -1 + (i + 1) / 8, 0, 2)
    if (kind == "corner") { wall(w, -1, w, z + 0.6, 0, 2); wall(w, z + 0.6, 2, z + 0.6, 0, 2) }
    if (kind == "slope") quad(w - 0.4, 0, -1, w - 0.4, 0, 1, w + 0.4, 2, 1, w + 0.4, 2, -1)
    for (i = 0; i < 6 && kind == "screen"; ++i)
        wall(w + i % 2 * 0.2, -1 + i / 3, w + (i + 1) % 2 * 0.2, -1 + (i + 1) / 3, 0, 2)
    for (i = 0; i < 400 && kind == "mesh"; ++i)
        wall(w, -1 + i % 20 / 10, w, -1 + (i % 20 + 1) / 10, int(i / 20) / 10, (int(i / 20) + 1) / 10)
    print "# lamp " comma(-1.1, r(1.2, 1.7), r(-0.3, 0.3))
    print "# eyes " comma(1.8, 0.75, -0.8), comma(-1.9, 1, -0.3)
    print "# targets " comma(0, 0.5, -0.3), comma(0, 0.9, 0)
}
AWK

# look EYE TARGET OUT [OPTION...]
look() {
    eye=$1 target=$2 out=$3
    shift 3
    status 0 render room.obj --eye "$eye" --target "$target" --fov 90 --size 32x32 --light "point:$lamp:0,-1,0:5,5,5" \
        --show irradiance --bounces 3 -o "$out" -q "$@"
}

# values FILE: prints the numbers of FILE, one a line.
values() { tail -c $((32 * 32 * 3 * 4)) "$1" | od -An -v -tf4 -w4; }

# is_dark DARK LIT: checks for at most 0.1 % of the lit half's mean, and 5 % of it at any pixel.
is_dark() {
    values "$2" >lit.txt
    values "$1" | awk 'NR == FNR { lit += $1 / 3072; next } { sum += $1 / 3072; if ($1 > most) most = $1 }
        END { printf "mean %.4f %%, most %.3f %% of %g\n", 100 * sum / lit, 100 * most / lit, lit
              exit !(lit > 0.01 && sum <= 0.001 * lit && most <= 0.05 * lit) }' lit.txt -
}

kinds="plane millimetre centimetre decimetre pair rim door curve corner slope screen mesh"
# make check-all tries half of the kinds, and make nightly all.
wanted=$kinds
[ "${LMB_LONG:-0}" -gt 1 ] || wanted="plane millimetre pair door slope mesh"
[ -z "$SHORT" ] || wanted="plane rim"
seed=${SEED:-0}
for kind in $kinds; do
    seed=$((seed + 1)) # a kind has the same seed in both
    case " $wanted " in *" $kind "*) ;; *) continue ;; esac
    awk -v kind=$kind -v seed=$seed -f walls.awk >room.obj
    lamp=$(sed -n 's/^# lamp //p' room.obj)
    set -- $(sed -n 's/^# eyes //p; s/^# targets //p' room.obj)
    # Most walls hold with few elements. Those of many parts, and thin ones that start outside the room, need more.
    case $kind in
    curve) cost="--elements 1024 --receivers 1500" ;;
    millimetre | rim | mesh) cost="--elements 1024 --receivers 400" ;;
    *) cost="--elements 256 --receivers 400" ;;
    esac
    status 0 bake room.obj -o room.lmt -q $cost --eye "$1" --eye "$2"
    look "$1" "$3" dark.pfm --transfer room.lmt
    look "$2" "$4" lit.pfm --transfer room.lmt
    check "a dark room behind a wall, $kind, seed $seed" is_dark dark.pfm lit.pfm
done

# At the foot of a crate at the border of a spot, light changes from black to bright within a centimetre. Without
# smaller elements there, the RMSE was 0.078, and the worst pixel 0.18.
if [ -z "$SHORT" ]; then
    awk 'function v(x, y, z) { print "v " x, y, z }
        function sides(y) { v(0.13, y, 0.065); v(0.29, y, 0.114); v(0.24, y, 0.272); v(0.082, y, 0.225) }
        BEGIN {
            for (i = 0; i < 8; ++i) v(int(i / 2) % 2 * 0.56, int(i / 4) * 0.55, int((i + 1) / 2) % 2 * 0.56)
            print "f 1 2 3 4\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7"
            sides(0); sides(0.165)
            print "f 13 14 15 16"
            for (i = 0; i < 4; ++i) print "f", 9 + i, 9 + (i + 1) % 4, 13 + (i + 1) % 4, 13 + i
        }' >foot.obj
    foot="--eye 0.4,0.12,-0.3 --target 0.24,0.04,0.1 --fov 30 --size 48x48 --bounces 1 --show indirect -q
        --light spot:0.278,0.54,0.2:0.3294831,-0.9413804,-0.0724139:2,2,2:24,28"
    status 0 bake foot.obj -o foot.lmt -q --receivers 2000 --eye 0.3,0.3,-0.5
    status 0 render foot.obj $foot --transfer foot.lmt -o foot.pfm
    status 0 render foot.obj $foot --quality best -o best.pfm
    status 0 compare foot.pfm best.pfm --max rmse=0.065
fi
finish
