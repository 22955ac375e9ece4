# plan.sh: settings chosen for budgets of error, against path-traced truth: what the plan said of each, what the picture
# had, and what the look took of the picture's work. A picture fails that has over twice its budget without a word, or
# whose look took over a quarter.
#
# LMB_OWN_TRUTH: the folder that tests/scenes/truth.sh filled. SHARED_SCENES, OWN_SCENES, BUDGETS: which.
. tests/measure/draw.sh

compare=$truth/compare.py

# A PFM's second line: `256 256`.
size_of() { dd if="$1" bs=32 count=1 2>/dev/null | sed -n '2s/ /x/p'; }

set_of() { "$B/scenes" --list | awk -v kind="${1%%:*}" '$1 == kind { found = $2 } END { print found ? found : "shared" }'; }

# said KEY: of the plan's lines.
said() { sed -n "s/.*$1\\([0-9.e+-]*\\).*/\\1/p" "$work/said" | head -n 1; }

# row FOLDER SCENE BUDGET
row() {
    scene=$1/$2
    "$TOOL" render "$scene/scene.gltf" -o "$work/drawn.pfm" --show indirect --threads 1 --budget-error "$3" \
        --size "$(size_of "$scene/pt_indirect1.pfm")" >"$work/said" 2>&1 || { fail "$2, $3"; return; }
    had=$(python3 "$compare" "$work/drawn.pfm" "$scene/pt_indirect1.pfm" --mask "$scene/gbuffer_depth.pfm" |
        sed 's/.*trim \([0-9.]*\).*/\1/')
    met=$(grep -q "the budget is met" "$work/said" && echo yes || echo no)
    look=$(said 'looked at .* units of work, ')
    about=$(said 'error about ')
    echo "| $2 | $(set_of "$2") | $3 | $(said '--tree ') | ${about:-not checked} | $met | $had | $look % |"
    check "$2, $3: had $had, and the plan said that it is met" \
        awk -v had="$had" -v budget="$3" -v met="$met" 'BEGIN { exit !(met == "no" || had <= 2 * budget) }'
    check "$2, $3: the look took $look % of the picture" test "${look:-100}" -le 25
}

command -v python3 >/dev/null || { skip "no python3 for $compare"; finish; }

echo "| scene | set | budget | tree | said | met | had | look |"
echo "|---|---|---|---|---|---|---|---|"
for budget in ${BUDGETS:-.1 .05 .03}; do
    for scene in ${SHARED_SCENES-cornell corridor corner_contact bunny_room point_room two_lights grazing_sun}; do
        row "$truth" "$scene" "$budget"
    done
    for scene in ${OWN_SCENES-$("$B/scenes" --list | awk '{ print $1 }')}; do
        [ ! -f "$LMB_OWN_TRUTH/$scene/pt_indirect1.pfm" ] || row "$LMB_OWN_TRUTH" "$scene" "$budget"
    done
done
finish
