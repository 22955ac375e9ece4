# slices.sh: pictures, frames and sweeps in slices, and their join.
. tests/cli/common.sh

# Four slices give the bytes of one machine: with automatic exposure, for two eyes, and for frames.
slices() { # slices NAME WORD...: draws NAME whole and in four slices
    name=$1
    shift
    status 0 "$@" -o "whole-$name"
    for i in 3 1 4 2; do
        status 0 "$@" --slice $i/4 -o "$name"
    done
    status 0 merge "$name".*of4 -o "$name"
}
tiny="--size 48x77 --quality draft --shadow-map 64 --tree 64"
for how in "" "--background transparent" "--stereo 0.1 --light point:0,1.5,0:0,-1,0:6,6,6"; do
    slices joined.png render demo $tiny $how
    check "four slices are one picture: $how" cmp whole-joined.png joined.png
done
slices joined.pfm render demo $tiny
check "four slices are one picture of light" cmp whole-joined.pfm joined.pfm
slices f%02d.ppm play demo $tiny --frames 5
for i in 0 1 2 3 4; do
    check "four slices are one sequence: frame $i" cmp "whole-f0$i.ppm" "f0$i.ppm"
done

# A world of six faces is an input, and so is each of them.
mkdir -p six
for face in px nx py ny pz nz; do
    { printf 'PF\n1 1\n-1.0\n'; printf '\000\000\000\077\000\000\000\077\000\000\000\077'; } >six/$face.pfm
done
slices sixfold.png render demo $tiny --world six/
check "slices in a world of six faces are one picture" cmp whole-sixfold.png sixfold.png
printf 'PF\n1 1\n-1.0\n\000\000\000\076\000\000\000\077\000\000\000\077' >six/nz.pfm
status 0 render demo $tiny --world six/ --slice 1/4 -o sixfold.png
status 1 merge sixfold.png.*of4 -o other.png
said "of another job"
rm six/nz.pfm
status 0 render demo $tiny --world six/ --slice 2/4 -o sixfold.png
status 1 merge sixfold.png.1of4 sixfold.png.2of4 -o other.png
said "of another job"
status 1 render demo $tiny --world nowhere --slice 1/4 -o other.png
said "no such file"

# Slices that are truncated, damaged, missing, duplicated, or from another job.
one=joined.pfm
head -c 3000 "$one.2of4" >cut
{ head -c 2000 "$one.2of4"; printf X; tail -c +2002 "$one.2of4"; } >damaged
for bad in cut damaged; do
    rm -f bad.pfm
    status 1 merge -q "$one.1of4" "$bad" "$one.3of4" "$one.4of4" -o bad.pfm
    said "of 4 slices 1 is missing: 2"
    absent bad.pfm
    status 0 merge "$one.4of4" "$bad" "$one.3of4" "$one.1of4" "$one.2of4" "$one.4of4" -o mended.pfm
    check "a slice that is $bad is told of" grep -q "$bad: .*; it is left out" err.txt
    check "one that is there twice is told of" holds "slice 4 of 4 once more, the same as" err.txt
    check "and both lose nothing" cmp mended.pfm whole-joined.pfm
done
status 1 merge -q "$one.4of4" -o bad.pfm
said "of 4 slices 3 are missing: 1, 2, 3"
status 0 render demo $tiny --bounces 2 --elements 256 --slice 2/4 -o other.pfm
status 1 merge -q "$one.1of4" other.pfm.2of4 "$one.3of4" "$one.4of4" -o bad.pfm
said "of another job"
status 0 render demo --shadow-map 64 --tree 64 --quality draft --size 48x77 --threads 2 --slice 2/4 -o again.pfm
check "the same options in any order are the same slice" cmp again.pfm.2of4 "$one.2of4"
status 1 merge "$one".*of4 -o bad.png
said "the slices were made for a *.pfm"
status 2 render demo $tiny --slice 5/4 -o bad.pfm
status 2 render demo $tiny --slice 1/4 --show depth -o bad.pfm
status 2 play demo $tiny --slice 1/4
status 2 merge
check "nothing bad was joined" none bad*

# A sweep in slices: the joined table has the settings, errors, memory, work and commands of one machine. Times, counted
# instructions and the front, which depends on times, differ by machine.
without_times() { # removes columns by name from a CSV
    awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) out[i] = $i == "mark" || $i == "seconds" || $i == "instructions" || $i ~ /^s / }
        { line = ""; for (i = 1; i <= NF; ++i) if (!out[i]) line = line "," $i; print line }' "$1"
}
sweep="lambent-bench demo --size 6x4 --runs 1 --cache kept --shadow-map 64 --sweep tree=8,16,32 --sweep error=0.05,0.1"
status 0 $sweep --breakdown 0 -o sweep
for i in 2 4 3 1; do
    status 0 $sweep --slice $i/4 -o part
done
check "a slice of a sweep says how much of it it is" holds "part.1of4: 2 of 6 settings" err.txt
status 0 lambent-bench merge part.*of4 -o joined.csv
without_times sweep.csv >sweep.txt
without_times joined.csv >joined.txt
check "errors and commands are compared" grep -q "^,--tree 32 --error 0.1,tree,0[.0-9]*,.*,lambent render " sweep.txt
check "four slices are one sweep" cmp sweep.txt joined.txt
for end in json html svg; do
    status 0 lambent-bench merge part.*of4 -o "joined.$end"
done
check "their JSON has all settings" test "$(grep -c '"setting": "--tree ' joined.json)" -eq 6
# The truth, and two pictures of each setting on the front, which depends on times.
cards=$(grep -o '<figcaption>' joined.html | wc -l)
check "their page has the truth and a front" test "$cards" -ge 2
check "their page has all pictures" test "$(grep -o 'data:image/png' joined.html | wc -l)" -eq $((2 * cards - 1))
status 1 lambent-bench merge -q part.1of4 part.2of4 part.4of4 -o bad.csv
said "of 4 slices 1 is missing: 3"
head -c 900 part.3of4 >part_cut
status 1 lambent-bench merge -q part.1of4 part.2of4 part_cut part.4of4 -o bad.csv
said "of 4 slices 1 is missing: 3"
status 0 $sweep --sweep bounces=1 --slice 3/4 -o foreign
status 1 lambent-bench merge -q part.1of4 part.2of4 foreign.3of4 part.4of4 -o bad.csv
said "of another job"
printf 'v -1 0 -1\nv 1 0 -1\nv 0 0 1\nf 1 2 3\n' >scene.obj
file="lambent-bench scene.obj --size 12x8 --runs 1 --cache kept --shadow-map 64 --sweep tree=8,16"
status 0 $file --slice 1/2 -o file
printf 'v -1 0 -1\nv 1 0 -1\nv 0 1 1\nf 1 2 3\n' >scene.obj
status 0 $file --slice 2/2 -o file
status 1 lambent-bench merge -q file.?of2 -o bad.csv
said "of another job"
status 1 lambent-bench merge -q part.*of4 -o bad.png
said "a sweep's slices make a .csv, .json, .html or .svg"
status 2 $sweep --slice 1/4
said "--slice: give -o NAME"
status 2 $sweep --slice 1/4 -o bad --svg bad.svg
status 2 lambent-bench raster --slice 1/4
status 1 merge -q part.*of4 -o bad.csv
said "a slice of a sweep; \`lambent-bench merge\` joins it"
status 1 lambent-bench merge -q "$one".*of4 -o bad.csv
said "no slice of a sweep; \`lambent merge\` joins it"
status 2 lambent-bench merge
said "try: lambent-bench merge"
check "nothing bad was joined of a sweep" none bad*

finish
