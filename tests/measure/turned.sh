# turned.sh: the work and the error of the scenes of tests/scenes, turned at random, against what they have upright.
#
# LMB_OWN_TRUTH: the folder that tests/scenes/truth.sh filled. OWN_SCENES, QUALITIES, TURNS: which (default: all that is
# there, default, "1 2 3 4 5"). A turn passes where pairs and segments are within 1.3 x, trim within 1.1 x.
. tests/measure/draw.sh

compare=$truth/compare.py
truth=$work/turned

# figures_of NAME QUALITY [TURN]: `trim pairs segments` of one picture.
figures_of() {
    "$B/scenes" "$1" ${3:+--rotate "$3"} -o "$truth/one" &&
        draw one "$2" 1 "$(dd if="$LMB_OWN_TRUTH/$1/pt_indirect1.pfm" bs=32 count=1 2>/dev/null | sed -n '2s/ /x/p')" \
            indirect || return
    python3 "$compare" "$work/drawn.pfm" "$LMB_OWN_TRUTH/$1/pt_indirect1.pfm" \
        --mask "$LMB_OWN_TRUTH/$1/gbuffer_depth.pfm" |
        awk -v work="$(figure pairs) $(figure segments)" '{ print $2, work }'
}

turns() {
    upright=$(figures_of "$1" "$2")
    for turn in ${TURNS:-1 2 3 4 5}; do
        ratios=$(echo "$upright $(figures_of "$1" "$2" "$turn")" |
            awk '{ printf "%.2f | %.2f | %.2f", $4 / $1, $5 / $2, $6 / $3 }')
        echo "| $1 | $2 | $turn | $ratios |"
        if echo "$ratios" | awk '{ exit !($1 <= 1.1 && $3 <= 1.3 && $5 <= 1.3) }'; then
            pass
        else
            fail "$1, $2, turned by $turn"
        fi
    done
}

[ -n "$LMB_OWN_TRUTH" ] || { skip "LMB_OWN_TRUTH names no folder (tests/scenes/truth.sh fills one)"; finish; }
command -v python3 >/dev/null || { skip "no python3 for $compare"; finish; }
mkdir -p "$truth/one"
echo "| scene | quality | turn | trim x | pairs x | segments x |"
echo "|---|---|---|---|---|---|"
for scene in ${OWN_SCENES-$("$B/scenes" --list | awk '{ print $1 }')}; do
    if [ -f "$LMB_OWN_TRUTH/$scene/pt_indirect1.pfm" ]; then
        for quality in ${QUALITIES:-default}; do
            turns "$scene" "$quality"
        done
    else
        skip "$scene has no truth in $LMB_OWN_TRUTH"
    fi
done
finish
