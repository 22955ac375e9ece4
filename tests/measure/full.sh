# full.sh: compares all light with path-traced truth: every scene with pt_full.pfm, by `--quality default --bounces 6`.
#
# SCENES, QUALITY, BOUNCES select the work. LMB_SHARED: the folder with truth/ (default ../shared). A row passes if trim
# meets its bar and the mean of the whole lies in 0.97 .. 1.03. The row also has the mean of only the later bounces:
# (all - one bounce) of the picture against that of the truth.
. tests/measure/draw.sh

size_of() { dd if="$1" bs=32 count=1 2>/dev/null | sed -n '2s/ /x/p'; }

# Mean later light of picture ALL minus ONE, relative to the truth's, over pixels with a surface.
later() {
    python3 - "$1" "$2" "$3" <<'PYTHON'
import array, os, sys
def pfm(name):
    f = open(name, 'rb')
    n = 3 if f.readline().strip() == b'PF' else 1
    w, h = map(int, f.readline().split())
    f.readline()
    a = array.array('f')
    a.frombytes(f.read(w * h * n * 4))
    return a
all_, one, folder = sys.argv[1:]
truth = pfm(folder + '/pt_full.pfm')
if os.path.exists(folder + '/pt_one_bounce.pfm'):
    less = pfm(folder + '/pt_one_bounce.pfm')
else:
    less = [a + b for a, b in zip(pfm(folder + '/pt_direct.pfm'), pfm(folder + '/pt_indirect1.pfm'))]
depth = pfm(folder + '/gbuffer_depth.pfm')
on = [i for i in range(len(truth)) if depth[i - i % 3] > 0]
a, b = pfm(all_), pfm(one)
print('%.3f' % (sum(a[i] - b[i] for i in on) / sum(truth[i] - less[i] for i in on)))
PYTHON
}

# Like draw of draw.sh, but with options for bounces.
draw_bounces() {
    "$TOOL" render "$truth/$1/scene.gltf" -o "$2" --quality "${QUALITY:-default}" --threads 1 --size "$3" --show full \
        --bounces "$4" --stats "$work/stats.json" >"$work/said" 2>&1
}

row() {
    folder=$truth/$1
    size=$(size_of "$folder/pt_full.pfm")
    bar=0.03
    [ "$1" != sponza ] || bar=0.05
    if ! draw_bounces "$1" "$work/one.pfm" "$size" 1 || ! draw_bounces "$1" "$work/all.pfm" "$size" "${BOUNCES:-6}"; then
        fail "$1: $(head -n 1 "$work/said")"
        return
    fi
    said=$(python3 "$truth/compare.py" "$work/all.pfm" "$folder/pt_full.pfm" --mask "$folder/gbuffer_depth.pfm" \
        --max "trim=$bar,lo=0.97,hi=1.03")
    figures=$(echo "$said" | awk '{ for (i = 1; i < NF; ++i) v[$i] = $(i + 1); print v["trim"] " | " v["rmse"] " | " v["mean"] }')
    echo "| $1 | $figures | $(later "$work/all.pfm" "$work/one.pfm" "$folder") | $(figure elements) | $(figure pairs) | $(figure segments) |"
    case $said in
    *bound* | *NONFINITE* | "") fail "$1:$said" ;;
    *) pass ;;
    esac
}

command -v python3 >/dev/null || { skip "no python3 for $truth/compare.py"; finish; }

echo "| scene | trim | rmse | mean | mean of the later part | elements | pairs | segments |"
echo "|---|---|---|---|---|---|---|---|"
for scene in ${SCENES:-$(truth_scenes)}; do
    row "$scene"
done
finish
