# cli_slices.sh: work in slices and joined, and light for other engines. A part of cli.sh, whose functions and files it
# uses.

s=$dir/slices
mkdir -p "$s"

# Four slices have the bytes of one machine: with what the exposure looks at, of two eyes, and of frames.
slices() { # slices NAME WORD...: NAME whole and by four slices
    name=$1
    shift
    status 0 "$@" -o "$s/whole-$name"
    for i in 3 1 4 2; do
        status 0 "$@" --slice $i/4 -o "$s/$name"
    done
    status 0 merge "$s/$name".*of4 -o "$s/$name"
}
tiny="--size 48x77 --quality draft --shadow-map 64 --tree 64"
for how in "" "--background transparent" "--stereo 0.1 --light point:0,1.5,0:0,-1,0:6,6,6"; do
    slices joined.png render demo $tiny $how
    check "four slices are one picture: $how" cmp "$s/whole-joined.png" "$s/joined.png"
done
slices joined.pfm render demo $tiny
check "four slices are one picture of light" cmp "$s/whole-joined.pfm" "$s/joined.pfm"
slices f%02d.ppm play demo $tiny --frames 5
for i in 0 1 2 3 4; do
    check "four slices are one sequence: frame $i" cmp "$s/whole-f0$i.ppm" "$s/f0$i.ppm"
done

# What is cut off, damaged, missing, there twice, or of another job.
one=$s/joined.pfm
head -c 3000 "$one.2of4" >"$s/cut"
{ head -c 2000 "$one.2of4"; printf X; tail -c +2002 "$one.2of4"; } >"$s/damaged"
for bad in cut damaged; do
    rm -f "$s/bad.pfm"
    status 1 merge -q "$one.1of4" "$s/$bad" "$one.3of4" "$one.4of4" -o "$s/bad.pfm"
    said "of 4 slices 1 is missing: 2"
    absent "$s/bad.pfm"
    status 0 merge "$one.4of4" "$s/$bad" "$one.3of4" "$one.1of4" "$one.2of4" "$one.4of4" -o "$s/mended.pfm"
    check "a slice that is $bad is told of" grep -q "$bad: .*; it is left out" "$dir/err.txt"
    check "one that is there twice is told of" grep -q "slice 4 of 4 once more, the same as" "$dir/err.txt"
    check "and both lose nothing" cmp "$s/mended.pfm" "$s/whole-joined.pfm"
done
status 1 merge -q "$one.4of4" -o "$s/bad.pfm"
said "of 4 slices 3 are missing: 1, 2, 3"
status 0 render demo $tiny --bounces 2 --slice 2/4 -o "$s/other.pfm"
status 1 merge -q "$one.1of4" "$s/other.pfm.2of4" "$one.3of4" "$one.4of4" -o "$s/bad.pfm"
said "of another job"
status 0 render demo --shadow-map 64 --tree 64 --quality draft --size 48x77 --threads 2 --slice 2/4 -o "$s/again.pfm"
check "the same options in any order are the same slice" cmp "$s/again.pfm.2of4" "$one.2of4"
status 1 merge "$one".*of4 -o "$s/bad.png"
said "the slices were made for a *.pfm"
status 2 render demo $tiny --slice 5/4 -o "$s/bad.pfm"
status 2 render demo $tiny --slice 1/4 --show depth -o "$s/bad.pfm"
status 2 play demo $tiny --slice 1/4
status 2 merge
check "nothing bad was joined" sh -c '! ls "$1"/bad* 2>/dev/null | grep -q .' sh "$s"

# Settings of a sweep: the table of all slices has the settings, errors, memory, work and commands of one machine's. Times,
# counted instructions and what follows from times (the front) are each machine's own.
without_times() { # of a CSV, its columns by name
    awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) out[i] = $i == "mark" || $i == "seconds" || $i == "instructions" || $i ~ /^s / }
        { line = ""; for (i = 1; i <= NF; ++i) if (!out[i]) line = line "," $i; print line }' "$1"
}
sweep="bench demo --size 24x16 --runs 1 --cache $s/kept --shadow-map 64 --sweep tree=8,16,32 --sweep error=0.05,0.1"
status 0 $sweep --breakdown 0 -o "$s/sweep"
for i in 2 4 3 1; do
    status 0 $sweep --slice $i/4 -o "$s/part"
done
check "a slice of a sweep says how much of it it is" grep -q "part.1of4: 2 of 6 settings" "$dir/err.txt"
status 0 merge "$s"/part.*of4 -o "$s/joined.csv"
without_times "$s/sweep.csv" >"$s/sweep.txt"
without_times "$s/joined.csv" >"$s/joined.txt"
check "errors and commands are compared" grep -q "^,--tree 32 --error 0.1,tree,0[.0-9]*,.*,lambent render " "$s/sweep.txt"
check "four slices are one sweep" cmp "$s/sweep.txt" "$s/joined.txt"
for end in json html svg; do
    status 0 merge "$s"/part.*of4 -o "$s/joined.$end"
done
check "their JSON has all settings" test "$(grep -c '"setting": "--tree ' "$s/joined.json")" -eq 6
check "their page has all pictures" test "$(grep -o 'data:image/png' "$s/joined.html" | wc -l)" -eq "$(grep -o 'data:image/png' "$s/sweep.html" | wc -l)"
status 1 merge -q "$s/part.1of4" "$s/part.2of4" "$s/part.4of4" -o "$s/bad.csv"
said "of 4 slices 1 is missing: 3"
head -c 2000 "$s/part.3of4" >"$s/part_cut"
status 1 merge -q "$s/part.1of4" "$s/part.2of4" "$s/part_cut" "$s/part.4of4" -o "$s/bad.csv"
said "of 4 slices 1 is missing: 3"
status 0 $sweep --sweep bounces=1 --slice 3/4 -o "$s/foreign"
status 1 merge -q "$s/part.1of4" "$s/part.2of4" "$s/foreign.3of4" "$s/part.4of4" -o "$s/bad.csv"
said "of another job"
printf 'v -1 0 -1\nv 1 0 -1\nv 0 0 1\nf 1 2 3\n' >"$s/scene.obj"
file="bench $s/scene.obj --size 24x16 --runs 1 --cache $s/kept --shadow-map 64 --sweep tree=8,16"
status 0 $file --slice 1/2 -o "$s/file"
printf 'v -1 0 -1\nv 1 0 -1\nv 0 1 1\nf 1 2 3\n' >"$s/scene.obj"
status 0 $file --slice 2/2 -o "$s/file"
status 1 merge -q "$s"/file.?of2 -o "$s/bad.csv"
said "of another job"
status 1 merge -q "$s"/part.*of4 -o "$s/bad.png"
said "a sweep's slices make a .csv, .json, .html or .svg"
status 2 $sweep --slice 1/4
said "--slice: give -o NAME"
status 2 $sweep --slice 1/4 -o "$s/bad" --svg "$s/bad.svg"
status 2 bench raster --slice 1/4
check "nothing bad was joined of a sweep" sh -c '! ls "$1"/bad* 2>/dev/null | grep -q .' sh "$s"

# A bake: slices at once, one after the other, by a folder that is half full or damaged, and without one.
bake="bake demo --elements 1024 --receivers 500 --cluster 0.6 --threads 1"
status 0 $bake -o "$s/bake.lmt"
at_once() { # at_once COUNT NAME WORD...: all slices, each in a process of its own
    of=$1 name=$2
    shift 2
    for i in $(seq "$of"); do
        "$TOOL" "$@" --slice "$i/$of" -o "$s/$name" -q 2>"$s/said.$i" || echo "failed: $i" >>"$s/failed.txt" &
    done
    wait
}
rm -f "$s/failed.txt"
at_once 4 four.lmt $bake
check "four slices at once have no failure" test ! -e "$s/failed.txt"
status 0 merge "$s"/four.lmt.*of4 -o "$s/four.lmt"
check "four slices at once are one bake" cmp "$s/bake.lmt" "$s/four.lmt"
part=$(find "$s/four.lmt.shared" -name '3of4.*' | sort | sed -n 2p)
check "slices share their steps in a folder" test -s "$part"
head -c 100 "$part" >"$s/cut" && cp "$s/cut" "$part"
rm -f "$s"/four.lmt.shared/2of4.* "$s/four.lmt.2of4"
status 1 merge -q "$s"/four.lmt.*of4 -o "$s/bad.lmt"
said "of 4 slices 1 is missing: 2"
status 0 $bake --slice 2/4 -o "$s/four.lmt"
status 0 merge "$s"/four.lmt.*of4 -o "$s/again.lmt"
check "a slice that was lost, with what it had shared, is made again" cmp "$s/bake.lmt" "$s/again.lmt"
rm -rf "$s/four.lmt.shared" "$s/four.lmt.4of4"
status 0 $bake --slice 4/4 -o "$s/four.lmt"
status 0 merge "$s"/four.lmt.*of4 -o "$s/again.lmt"
check "a slice alone makes what no other has shared" cmp "$s/bake.lmt" "$s/again.lmt"
status 0 $bake --division 0.1 --slice 1/4 -o "$s/four.lmt"
status 1 merge -q "$s"/four.lmt.*of4 -o "$s/bad.lmt"
said "of another job"
status 0 $bake --slice 1/4 -o "$s/four.lmt"
status 0 merge "$s"/four.lmt.*of4 -o "$s/again.lmt"
check "what another job has shared does not count" cmp "$s/bake.lmt" "$s/again.lmt"
status 1 merge -q "$s"/four.lmt.*of4 -o "$s/bad.glb"
said "the slices were made for a *.lmt"
for form in "vertex-colours c.glb" "lightmap l.glb --texels 1024" "probes p.json --step 0.8"; do
    set -- $form
    to=$1 name=$2
    shift 2
    status 0 $bake --to $to "$@" -o "$s/$name"
    cp "$s/$name" "$s/whole-$name"
    [ $to != probes ] || mv "$s/p.bin" "$s/whole-p.bin"
    rm "$s/$name"
    at_once 2 $name $bake --to $to "$@"
    status 0 merge "$s/$name".?of2 -o "$s/$name"
    check "two slices are one bake to $to" cmp "$s/whole-$name" "$s/$name"
done
check "and its numbers" cmp "$s/whole-p.bin" "$s/p.bin"
status 1 merge -q "$s"/p.json.?of2 -o "$s/bad.json"
said "name a file beside it"
status 2 bake demo --slice 3/2 -o "$s/bad.lmt"
check "nothing bad was joined of a bake" sh -c '! ls "$1"/bad* 2>/dev/null | grep -q .' sh "$s"

# Light for other engines, read back and drawn, is the light it was baked from.
light="--elements 256 --receivers 700"
trim() { sed -n 's/.* trim \([0-9.]*\),.*/\1/p' "$dir/out.txt"; }
under() { awk -v is="$(trim)" -v bar="$1" 'BEGIN { exit !(is != "" && is < bar) }'; }
status 0 bake demo $light --to vertex-colours -o "$s/colours.glb"
check "vertex colours are that light: $(trim)" under 0.02
status 0 bake demo $light --to lightmap --texels 1024 -o "$s/map.glb"
check "a lightmap is that light: $(trim)" under 0.02
status 2 bake demo $light --to probes --step 0.000001 -o "$s/never.json"
said "give a larger one"
status 0 bake demo $light --to probes --step 0.8 -o "$s/air.json"
check "probes say how far they are from it: $(trim)" under 0.2
check "they have their numbers beside them" test -s "$s/air.bin"
for name in colours map; do
    status 0 render "$s/$name.glb" --size 48x32 -q -o "$s/$name.png"
done
status 2 bake demo $light --to lightmap -o "$s/bad.png"
said "--to lightmap writes a .glb"
status 2 bake demo $light --bounces 2 -o "$s/bad.lmt"
status 2 bake demo $light --to probes --moving 0 -o "$s/bad.json"
