# prove.sh: proves properties of the rasterizer's integers for all possible input: prove.sh FOLDER.
#
# Frama-C's Eva runs each driver of tests/static with all values of the ranges at once and proves: no signed overflow,
# no conversion out of range, no index outside an array, every assertion. Gappa bounds rounding.
# Ends with a line `N passed, N failed, N skipped`.
. tests/scripts/checks.sh
folder=$1
mkdir -p "$folder"
ranges=cvalue related=equality,symbolic-locations

# eva NAME MAIN DOMAINS [EXPECTED]: checks that Eva has no alarm except EXPECTED, which the caller explains. Without
# __GNUC__ the code uses no builtins. `related`: conditions on a sum also restrict the terms, at twice the time.
eva() {
    log=$folder/$1-$2.log
    frama-c -eva -eva-precision 0 -eva-split-return auto -eva-min-loop-unroll 12 -eva-domains "$3" \
        -warn-special-float none -machdep gcc_x86_64 -main "$2" \
        -cpp-extra-args="-Iinclude -std=c99 -U__GNUC__" "tests/static/$1.c" >"$log" 2>&1
    grep -A1 'eva:alarm' "$log" | tr -d '\n' | sed 's/\[eva:alarm\]/\n/g' | grep . | grep -vE "${4:-^$}" >"$log.left"
    check "Eva has no alarm in $1.c's $2: $(head -n 1 "$log.left")" test ! -s "$log.left"
    check "Eva proves all assertions of $1.c's $2" grep -qE 'Assertions +[1-9][0-9]* valid +0 unknown +0 invalid' "$log"
}

if command -v frama-c >/dev/null 2>&1; then
    eva edges main "$related"
    eva small set_up "$ranges"
    eva small main "$ranges"
    eva bins main "$ranges"
    # to_24_8: after a comparison Eva still includes NaN. maxf(NaN, low) is low, because NaN is above nothing.
    eva snap main "$related" 'draw_one.c:26: .*is_finite|draw_one.c:26: .*non-finite float value'
else
    skip "frama-c is not here (Debian: frama-c-base)"
fi
if command -v gappa >/dev/null 2>&1; then
    check "Gappa proves tests/static/snap.g" gappa tests/static/snap.g
else
    skip "gappa is not here (Debian: gappa)"
fi
finish
