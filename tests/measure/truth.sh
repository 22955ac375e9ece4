# truth.sh: compares one bounce with path-traced truth, every scene by every preset: one table of errors, work and time.
#
# SCENES, QUALITIES select the work. LMB_SHARED: the folder with truth/ (default ../shared). truth/compare.py computes
# the figures, independently of the tool. A row passes if it meets the bars below; rows without bars are only shown.
. tests/measure/draw.sh

# Bars of a preset: trim; full RMSE unless a few pixels dominate it; light in the dark parts of the two rooms.
bars_of() {
    case $1/$2 in
    default/cornell | default/bunny_room | default/corner_contact) echo trim=0.05 ;;
    default/corridor) echo trim=0.05,leak=0.3 ;;
    default/sponza) echo trim=0.12 ;;
    best/cornell | best/bunny_room) echo trim=0.015,rmse=0.04 ;;
    best/corridor) echo trim=0.015,rmse=0.04,leak=0.1 ;;
    best/corner_contact) echo trim=0.015,rmse=0.08 ;;
    best/sponza) echo trim=0.03 ;;
    esac
}

# A PFM's second line: `256 256`.
size_of() { dd if="$1" bs=32 count=1 2>/dev/null | sed -n '2s/ /x/p'; }

compare() {
    bars=$(bars_of "$2" "$1")
    python3 "$truth/compare.py" "$work/drawn.pfm" "$truth/$1/pt_indirect1.pfm" --mask "$truth/$1/gbuffer_depth.pfm" \
        --classes "$truth/$1/classes.pfm" ${bars:+--max "$bars"} | tee "$work/compared"
}

# Prints compare.py's `KEY value` pairs as cells, leak if there is one, and any missed bar.
cells() {
    sed 's/[()]//g' "$work/compared" | awk '{
        for (i = 1; i < NF; ++i) v[$i] = $(i + 1)
        printf "%s | %s | %s | %s | %s | %s | %s | %s", v["trim"], v["rmse"], v["n90"], v["e50"], v["e95"], v["e99"],
            v["mean"], "leak" in v ? v["leak"] : "-"
    }'
}

row() {
    if ! draw "$1" "$2" 1 "$(size_of "$truth/$1/pt_indirect1.pfm")" indirect; then
        fail "$1, $2: $(head -n 1 "$work/said")"
        return
    fi
    said=$(compare "$1" "$2")
    echo "| $1 | $2 | $(cells) | $(figure pairs) | $(figure segments) | $(cat "$work/user") |"
    case $said in
    *bound* | *NONFINITE* | "") fail "$1, $2:$said" ;;
    *) pass ;;
    esac
}

command -v python3 >/dev/null || { skip "no python3 for $truth/compare.py"; finish; }

echo "| scene | quality | trim | rmse | n90 | e50 | e95 | e99 | mean | leak | pairs | segments | user s |"
echo "|---|---|---|---|---|---|---|---|---|---|---|---|---|"
for scene in ${SCENES:-$(truth_scenes rooms)}; do
    for quality in ${QUALITIES:-draft default best}; do
        row "$scene" "$quality"
    done
done
finish
