# plan.sh: checks settings chosen for error budgets against path-traced truth. A row has the plan's prediction, the
# picture's error, and the cost of sampling relative to the picture. A picture fails if the plan reported its budget as
# met but the error is over twice the budget, or if sampling took over a quarter of the work. All fail together if, of
# the pictures reported as met, fewer than 95 % are within 1.5 x of their budget.
#
# LMB_OWN_TRUTH: the folder filled by tests/scenes/truth.sh. SHARED_SCENES, OWN_SCENES, BUDGETS select the
# work (default: everything).
. tests/measure/draw.sh

compare=$truth/compare.py
rows=$work/plan.rows

# A PFM's second line: `256 256`.
size_of() { dd if="$1" bs=32 count=1 2>/dev/null | sed -n '2s/ /x/p'; }

# Seeds of three digits are held out.
set_of() {
    case $1 in
    *:[1-9][0-9][0-9]) echo held-out; return ;;
    esac
    "$B/scenes" --list | awk -v kind="${1%%:*}" '$1 == kind { found = $2 } END { print found ? found : "shared" }'
}

# said KEY: prints a number from the plan's lines.
said() { sed -n "s/.*$1\\([0-9.e+-]*\\).*/\\1/p" "$work/said" | head -n 1; }

# Seconds of sampling, which belong to no stage, and their share of all stages except reading and writing.
look_seconds() {
    sed -n 's/.*"seconds": {\(.*\)}.*/\1/p' "$work/stats.json" | tr -d '",:' | awk '{
        for (i = 1; i < NF; i += 2) v[$i] = $(i + 1)
        for (k in v) if (k != "total") stages += v[k]
        look = v["total"] - stages
        printf "%.2f, %.0f %%", look, 100 * look / (stages - v["load"] - v["write"])
    }'
}

# row FOLDER SCENE BUDGET
row() {
    scene=$1/$2
    "$TOOL" render "$scene/scene.gltf" -o "$work/drawn.pfm" --show indirect --threads 1 --budget error="$3" \
        --stats "$work/stats.json" --size "$(size_of "$scene/pt_indirect1.pfm")" >"$work/said" 2>&1 || { fail "$2, $3"; return; }
    had=$(python3 "$compare" "$work/drawn.pfm" "$scene/pt_indirect1.pfm" --mask "$scene/gbuffer_depth.pfm" |
        sed 's/.*trim \([0-9.]*\).*/\1/')
    met=$(grep -q "the budget is met" "$work/said" && echo yes || echo no)
    look=$(said 'looked at .* units of work, ')
    about=$(said 'error about ')
    echo "| $2 | $(set_of "$2") | $3 | $(said '--tree ') | ${about:-not checked} | $met | $had | $look % | $(look_seconds) |"
    echo "$had $3 $met" >>"$rows"
    check "$2, $3: had $had, and the plan said that it is met" \
        awk -v had="$had" -v budget="$3" -v met="$met" 'BEGIN { exit !(met == "no" || had <= 2 * budget) }'
    check "$2, $3: the look took $look % of the picture" test "${look:-100}" -le 25
}

command -v python3 >/dev/null || { skip "no python3 for $compare"; finish; }

# Of the pictures reported to meet their budget: how many are within 1.5 x of it, and the worst ratio.
sums() {
    awk '
        $3 == "yes" { ++n; x = $1 / $2; within += x <= 1.5; kept += x <= 1; if (x > worst) worst = x }
        $3 == "no" { ++no }
        END {
            printf "of %d said met %d within the budget, %d within 1.5 x, the worst %.2f x; %d said not met\n",
                n, kept, within, worst, no
            exit !(within >= 0.95 * n)
        }' "$rows"
}

: >"$rows"
echo "| scene | set | budget | tree | said | met | had | look: work | s, of the picture's |"
echo "|---|---|---|---|---|---|---|---|---|"
own_scenes=${OWN_SCENES-$("$B/scenes" --list | awk '{ print $1 }')
    $([ -z "$LMB_OWN_TRUTH" ] || (cd "$LMB_OWN_TRUTH" && ls -d -- *:[1-9][0-9][0-9] 2>/dev/null))}
for budget in ${BUDGETS:-.1 .05 .03}; do
    for scene in ${SHARED_SCENES-cornell corridor corner_contact bunny_room point_room two_lights grazing_sun}; do
        row "$truth" "$scene" "$budget"
    done
    for scene in $own_scenes; do
        [ ! -f "$LMB_OWN_TRUTH/$scene/pt_indirect1.pfm" ] || row "$LMB_OWN_TRUTH" "$scene" "$budget"
    done
done
sums >"$work/plan.sum" && pass || fail "fewer than 95 % within 1.5 x of their budget"
cat "$work/plan.sum"
finish
