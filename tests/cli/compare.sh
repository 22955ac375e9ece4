# compare.sh: compare and info: pictures that are equal, differ or have other sizes; scenes and pictures as text and JSON.
. tests/cli/common.sh

for extension in png ppm pfm; do
    status 0 render demo $few -o demo.$extension
done
cp demo.pfm again.pfm

# compare: equal, different, sizes differ.
status 0 compare demo.pfm again.pfm
status 0 render demo --size 16x12 --shadow-map 64 --quality draft -o half.pfm
status 3 compare demo.pfm half.pfm
{ printf 'PF\n2 1\n-1\n'; head -c 24 /dev/zero; } >black.pfm
{ printf 'PF\n2 1\n-1\n'; printf '\000\000\200\077%.0s' 1 2 3 4 5 6; } >white.pfm
status 0 compare white.pfm black.pfm
check "errors relative to black have no value" grep -qx 'trim - rmse - (n90 [0-9]*) e50 - e95 - e99 - worst - mean -' out.txt
check "psnr relative to black has no value" grep -q '^psnr - (rgb, linear, peak 0) max 1 at 0,0 ' out.txt
for name in white black; do { printf 'PF\n24 1\n-1\n'; repeated 36 "$(test $name = white && printf %s "$one$one" || printf '\\000\\000\\000\\000\\000\\000\\000\\000')"; } >wide_$name.pfm; done
status 0 compare wide_white.pfm wide_black.pfm
check "leak relative to black has no value" grep -q ' mean - leak -$' out.txt
{ printf 'PF\n2 1\n-1\n'; printf '\121\131\004\151%.0s' 1 2 3 4 5 6; } >vast.pfm
{ printf 'PF\n2 1\n-1\n'; printf '\314\274\214\053%.0s' 1 2 3 4 5 6; } >faint.pfm
status 0 compare vast.pfm white.pfm
check "a figure of 1e25 is printed" grep -q '^trim 1e+25 rmse 1e+25 ' out.txt
status 0 compare faint.pfm black.pfm
check "faint errors relative to black have no value" grep -qx 'trim - rmse - (n90 [0-9]*) e50 - e95 - e99 - worst - mean -' out.txt
{ printf 'PF\n2 1\n-1\n'; printf '\000\000\000\277%.0s' 1 2 3 4 5 6; } >negative.pfm
for bound in trim rmse e50 worst hi; do
    check "--max $bound holds for a negative truth" sh -c '! "$@" >/dev/null' sh "$TOOL" compare white.pfm negative.pfm --max $bound=0.1
done
status 0 compare black.pfm white.pfm
check "the worst pixel is the first of equal ones" grep -q ' worst 0.990[0-9]* at 0,0 mean 0.0000$' out.txt
check "--max worst bounds it" sh -c '! "$1" compare white.pfm black.pfm --max worst=9' sh "$TOOL"
status 0 compare black.pfm black.pfm
check "no pixel is the worst of equal ones" grep -q ' worst 0.0000 mean ' out.txt
check "black is black" grep -q '^trim 0.0000 rmse 0.0000 ' out.txt

# info: a scene and pictures, as text and as one JSON object on one line.
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >one.obj
status 0 info one.obj
check "info counts the triangle" grep -q '^triangles  *1 placed, 1 unique$' out.txt
for file in one.obj demo.png demo.ppm demo.pfm; do
    status 0 info "$file" --json
    check "info $file --json is one line" test "$(wc -l <out.txt)" -eq 1
    check "info $file --json is an object" grep -q '^{.*}$' out.txt
done

status 0 info demo
check "info knows the built-in scene" sh -c 'grep -q "^file  *demo: built in$" "$1" && grep -q "^cameras  *1; placed: 1" "$1"' sh out.txt
status 0 compare demo.pfm again.pfm -q
check "compare -q is its exit status" empty out.txt

finish
