# own.sh: compares bounced light with path-traced truth, on the shared folder's scenes and on those of tests/scenes. One
# table of one bounce marks each scene as fitted or held out and ends with mean and worst of each; then all bounces.
#
# LMB_OWN_TRUTH: the folder filled by tests/scenes/truth.sh, with full/ if it ran with FULL=1; without the folder, only
# the shared scenes are drawn. SHARED_SCENES, OWN_SCENES, QUALITIES select the work (default: everything). BOUNCES=1
# leaves out all bounces. The shared scenes count as fitted.
. tests/measure/draw.sh

compare=$truth/compare.py
rows=$work/own.rows

# A PFM's second line: `256 256`.
size_of() { dd if="$1" bs=32 count=1 2>/dev/null | sed -n '2s/ /x/p'; }

# set_of NAME: prints the set from the table of kinds; seeds of three digits are held out.
set_of() {
    case $1 in
    *:[1-9][0-9][0-9]) echo held-out ;;
    *) "$B/scenes" --list | awk -v kind="${1%%:*}" '$1 == kind { print $2 }' ;;
    esac
}

# row NAME SET QUALITY: prints a row for the scene in $truth.
row() {
    if ! draw "$1" "$3" 1 "$(size_of "$truth/$1/pt_indirect1.pfm")" indirect; then
        fail "$1, $3: $(head -n 1 "$work/said")"
        return
    fi
    said=$(python3 "$compare" "$work/drawn.pfm" "$truth/$1/pt_indirect1.pfm" --mask "$truth/$1/gbuffer_depth.pfm")
    case $said in
    *trim*) ;;
    *) fail "$1, $3: $said"; return ;;
    esac
    case $said in
    *NONFINITE*) fail "$1, $3:$said" ;;
    *) pass ;;
    esac
    cells=$(echo "$said" | awk '{ for (i = 1; i < NF; ++i) v[$i] = $(i + 1); print v["trim"], v["rmse"], v["mean"] }')
    echo "$1 $2 $3 $cells $(figure pairs) $(figure segments) $(cat "$work/user")" | tee -a "$rows" |
        sed 's/ / | /g; s/.*/| & |/'
}

scene_rows() {
    for quality in ${QUALITIES:-draft default best}; do
        row "$1" "$2" "$quality"
    done
}

# Prints mean and worst by quality and set; the worst mean is the one farthest from 1.
sums() {
    awk '
        function far(x) { return x > 1 ? x - 1 : 1 - x }
        {
            k = $3 SUBSEP $2
            n[k]++
            for (c = 4; c <= 9; ++c) {
                sum[k, c] += $c
                if (n[k] == 1 || (c == 6 ? far($c) > far(most[k, c]) : $c > most[k, c])) {
                    most[k, c] = $c
                }
            }
        }
        END {
            split("draft default best", qualities, " ")
            split("fitted held-out", sets, " ")
            for (q = 1; q <= 3; ++q) {
                for (s = 1; s <= 2; ++s) {
                    k = qualities[q] SUBSEP sets[s]
                    if (k in n) {
                        printf "| mean of %d | %s | %s | %.4f | %.4f | %.4f | %.0f | %.0f | %.2f |\n", n[k], sets[s],
                            qualities[q], sum[k, 4] / n[k], sum[k, 5] / n[k], sum[k, 6] / n[k], sum[k, 7] / n[k],
                            sum[k, 8] / n[k], sum[k, 9] / n[k]
                        printf "| worst of %d | %s | %s | %.4f | %.4f | %.4f | %.0f | %.0f | %.2f |\n", n[k], sets[s],
                            qualities[q], most[k, 4], most[k, 5], most[k, 6], most[k, 7], most[k, 8], most[k, 9]
                    }
                }
            }
        }' "$rows"
}

# mean_of FILE...: prints the sum of their means.
mean_of() {
    python3 -c '
import array, sys
total = 0.0
for name in sys.argv[1:]:
    with open(name, "rb") as f:
        f.readline(), f.readline(), f.readline()
        a = array.array("f", f.read())
    total += sum(a) / len(a)
print(total)' "$@"
}

# full_row NAME: all light with six bounces: trim and mean, and the mean of only the later bounces.
full_row() {
    once="$truth/$1/pt_direct.pfm $truth/$1/pt_indirect1.pfm"
    [ ! -f "$truth/$1/pt_one_bounce.pfm" ] || once=$truth/$1/pt_one_bounce.pfm
    size=$(size_of "$truth/$1/pt_full.pfm")
    if ! draw "$1" default 1 "$size" full; then
        fail "$1, full light: $(head -n 1 "$work/said")"
        return
    fi
    mv "$work/drawn.pfm" "$work/once.pfm"
    "$TOOL" render "$truth/$1/scene.gltf" -o "$work/drawn.pfm" --bounces 6 --threads 1 --size "$size" >"$work/said" 2>&1
    said=$(python3 "$compare" "$work/drawn.pfm" "$truth/$1/pt_full.pfm" --mask "$truth/$1/gbuffer_depth.pfm")
    cells=$(echo "$said" | awk '{ for (i = 1; i < NF; ++i) v[$i] = $(i + 1); print v["trim"], "|", v["mean"] }')
    # shellcheck disable=SC2086 # one name or two
    later=$(echo "$(mean_of "$work/drawn.pfm") $(mean_of "$work/once.pfm") $(mean_of "$truth/$1/pt_full.pfm")" \
        "$(mean_of $once)" | awk '{ printf "%.3f", ($1 - $2) / ($3 - $4) }')
    echo "| $1 | $cells | $later |"
    pass
}

full_rows() {
    for scene in "$@"; do
        [ ! -f "$truth/$scene/pt_full.pfm" ] || full_row "$scene"
    done
}

command -v python3 >/dev/null || { skip "no python3 for $compare"; finish; }

: >"$rows"
echo "| scene | set | quality | trim | rmse | mean | pairs | segments | user s |"
echo "|---|---|---|---|---|---|---|---|---|"
shared_scenes=${SHARED_SCENES-$(truth_scenes rooms)}
own_scenes=${OWN_SCENES-$("$B/scenes" --list | awk '{ print $1 }')
    $([ -z "$LMB_OWN_TRUTH" ] || (cd "$LMB_OWN_TRUTH" && ls -d -- *:[1-9][0-9][0-9] 2>/dev/null))}
for scene in $shared_scenes; do
    scene_rows "$scene" fitted
done
if [ -n "$LMB_OWN_TRUTH" ]; then
    truth=$LMB_OWN_TRUTH
    for scene in $own_scenes; do
        if [ -f "$truth/$scene/pt_indirect1.pfm" ]; then
            scene_rows "$scene" "$(set_of "$scene")"
        else
            skip "$scene has no truth in $truth (tests/scenes/truth.sh makes it)"
        fi
    done
else
    skip "LMB_OWN_TRUTH names no folder with truth of our own scenes (tests/scenes/truth.sh fills one)"
fi
sums
[ "$BOUNCES" != 1 ] || finish

printf '\n| scene, six bounces | trim of all light | mean | mean of later bounces |\n|---|---|---|---|\n'
truth=${LMB_SHARED:-../shared}/truth
full_rows $shared_scenes
truth=$LMB_OWN_TRUTH/full
full_rows $own_scenes
finish
