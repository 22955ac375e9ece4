# front.sh: plots speed against error: light gathered at every pixel, live and baked light, and path tracing.
#
# SCENES: scenes (default cornell corridor bunny_room sponza). SETTINGS: rows (default: all below). LMT: the folder with
# NAME.lmt, and NAME-*.lmt for other values of --error, if any (default $B/measure). RUNS: number of runs (default 1);
# each measures the first frame of a process, and the minimum counts. Times are processor time of one thread for only
# one bounce, against path-traced truth of the same size. Rows (scene, setting, milliseconds, trim) are appended to
# $B/measure/front.csv; the last row of a setting counts. The script draws tests/results/live.svg from all rows. Figures
# of path tracing with Embree were measured once, with AVX-512. With SCENES= the script only draws the picture.
. tests/measure/draw.sh

folder=${LMT:-$work}
rows=$work/front.csv
touch "$rows"

options_of() {
    case $1 in
    draft | default | best) echo "--quality $1 --gather full" ;;
    draft-* | default-*) echo "--quality ${1%%-*} --gather ${1#*-}" ;;
    *.lmt) echo "--transfer $folder/$1" ;;
    esac
}

# Measures milliseconds and trim of one setting.
measure() {
    options=$(options_of "$2")
    size=$(dd if="$truth/$1/pt_indirect1.pfm" bs=32 count=1 2>/dev/null | sed -n '2s/ /x/p')
    for _ in $(seq "${RUNS:-1}"); do
        # shellcheck disable=SC2086 # words
        "$TOOL" play "$truth/$1/scene.gltf" $options --path "$work/still" --frames 1 --size "$size" --threads 1 \
            --show indirect -o "$work/front_%01d.pfm" 2>"$work/said" | awk '/^whole frame/ { print $6 }'
    done | sort -n | sed -n 1p >"$work/ms"
    [ -s "$work/ms" ] || { fail "$1, $2: $(sed -n 1p "$work/said")"; return; }
    trim=$(python3 "$truth/compare.py" "$work/front_0.pfm" "$truth/$1/pt_indirect1.pfm" \
        --mask "$truth/$1/gbuffer_depth.pfm" | awk '{ print $2 }')
    echo "$1,$2,$(cat "$work/ms"),$trim" | tee -a "$rows"
    pass
}

for scene in ${SCENES-cornell corridor bunny_room sponza}; do
    python3 -c 'import json, sys
c = json.load(open(sys.argv[1]))["camera"]
print("0 camera", *(",".join(map(str, c[k])) for k in ("eye", "target")))' "$truth/$scene/scene.json" >"$work/still"
    for setting in ${SETTINGS-draft-live draft default-live default best}; do
        measure "$scene" "$setting"
    done
    for file in "$folder/$scene".lmt "$folder/$scene"-*.lmt; do
        [ ! -f "$file" ] || measure "$scene" "${file##*/}"
    done
done

# Draws the picture, one panel a scene.
python3 - "$rows" tests/results/live.svg <<'PYTHON' && pass || fail "no picture"
import math, sys
names = {'cornell': 'Cornell box', 'corridor': 'two rooms', 'bunny_room': 'bunny in a room', 'sponza': 'Sponza'}
traced = {  # ms to a trim: plain, with more light connections, with those and a denoiser
    'cornell': {'PT': [(8003, .05), (28189, .02)], 'PT, MIS': [(1734, .05), (5214, .02)],
                'denoised': [(129, .05), (558, .02)]},
    'corridor': {'PT': [(1856, .05), (5192, .02)], 'PT, MIS': [(668, .05), (1669, .02)],
                 'denoised': [(51, .05), (153, .02)]},
    'bunny_room': {'PT': [(24500, .05)], 'PT, MIS': [(18600, .05)], 'denoised': [(2441, .05)]},
    'sponza': {'PT': [(8176, .1), (24000, .05)], 'PT, MIS': [(8866, .1), (27000, .05)],
               'denoised': [(1658, .1), (8466, .05)]}}
found = {}
for line in open(sys.argv[1]):
    scene, setting, ms, trim = line.strip().split(',')
    found.setdefault(scene, {})[setting] = (float(ms), float(trim))
W, H, LEFT, TOP, MS, TRIM = 450, 300, 52, 30, (8, 150000), (.0025, .7)
def place(panel, ms, trim):
    u = math.log(ms / MS[0]) / math.log(MS[1] / MS[0])
    v = math.log(trim / TRIM[0]) / math.log(TRIM[1] / TRIM[0])
    return (panel % 2 * W + LEFT + u * (W - LEFT - 20), panel // 2 * H + H - 34 - v * (H - 34 - TOP))
colours = {'gather': '#0b6e99', 'live': '#0f9d58', 'baked': '#c2410c', 'PT': '#999', 'PT, MIS': '#666', 'denoised': '#7c3aed'}
legend = {'gather': 'every pixel', 'live': 'live light', 'baked': 'baked', 'PT': 'path tracing',
          'PT, MIS': 'with MIS', 'denoised': 'with MIS, denoised'}
def kind(s):
    return 'baked' if s.endswith('.lmt') else 'live' if '-' in s else 'gather'
out = ['<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 %d %d" width="%d" height="%d" role="img"><style>text{font:11px '
       'ui-monospace,Menlo,Consolas,monospace;fill:#333;paint-order:stroke;stroke:#fff;stroke-width:3px}.grid{stroke:#ddd}'
       '</style><rect width="%d" height="%d" fill="#fff"/>' % ((2 * W, 2 * H + 24) * 3)]
for panel, scene in enumerate(names):
    for ms, label in ((10, '10 ms'), (100, '0.1 s'), (1000, '1 s'), (10000, '10 s')):
        x, y = place(panel, ms, TRIM[0])
        out.append('<line class="grid" x1="%.1f" y1="%.1f" x2="%.1f" y2="%.1f"/><text x="%.1f" y="%.1f" text-anchor="middle">'
                   '%s</text>' % (x, y, x, place(panel, ms, TRIM[1])[1], x, y + 15, label))
    for trim in (.005, .01, .02, .05, .1, .2, .5):
        x, y = place(panel, MS[0], trim)
        out.append('<line class="grid" x1="%.1f" y1="%.1f" x2="%.1f" y2="%.1f"/><text x="%.1f" y="%.1f" text-anchor="end">%g %%'
                   '</text>' % (x, y, place(panel, MS[1], trim)[0], y, x - 5, y + 4, 100 * trim))
    out.append('<text x="%.1f" y="%.1f" font-weight="bold">%s</text>' % (panel % 2 * W + LEFT, panel // 2 * H + 20, names[scene]))
    points = [(kind(s), s, *p) for s, p in found.get(scene, {}).items()]
    points += [(k, '', *p) for k, all in traced[scene].items() for p in all]
    best = [p for p in points if not any(q[2] <= p[2] and q[3] <= p[3] and q is not p for q in points)]
    best.sort(key=lambda p: p[2])
    out.append('<polyline fill="none" stroke="#333" stroke-width="1" points="%s"/>'
               % ' '.join('%.1f,%.1f' % place(panel, *p[2:]) for p in best))
    for k, s, ms, trim in points:
        x, y = place(panel, ms, trim)
        out.append('<circle cx="%.1f" cy="%.1f" r="4" fill="%s"><title>%s: %.0f ms, %.2f %%</title></circle>'
                   % (x, y, colours[k], s or legend[k], ms, 100 * trim))
for i, k in enumerate(legend):
    out.append('<circle cx="%d" cy="%d" r="4" fill="%s"/><text x="%d" y="%d">%s</text>'
               % (50 + 140 * i, 2 * H + 10, colours[k], 59 + 140 * i, 2 * H + 14, legend[k]))
open(sys.argv[2], 'w').write(''.join(out) + '</svg>\n')
PYTHON
finish
