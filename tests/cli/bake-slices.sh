# bake-slices.sh: a bake in slices: at once, one after the other, and with files that are damaged or from another job.
. tests/cli/common.sh

# Bakes slices at once, one after the other, with a folder that is half full or damaged, and without a folder.
box
block
bake="bake block.obj --elements 256 --receivers 200 --cluster 0.6 --threads 1"
status 0 $bake -o bake.lmt
at_once() { # at_once COUNT NAME WORD...: runs each slice in its own process
    of=$1 name=$2
    shift 2
    for i in $(seq "$of"); do
        "$TOOL" "$@" --slice "$i/$of" -o "$name" -q 2>"said.$i" || echo "failed: $i" >>failed.txt &
    done
    wait
}
rm -f failed.txt
at_once 4 four.lmt $bake
check "four slices at once have no failure" test ! -e failed.txt
status 0 merge four.lmt.*of4 -o four.lmt
check "four slices at once are one bake" cmp bake.lmt four.lmt
step=$(find four.lmt.shared -name '3of4.*' | sort | sed -n 2p)
check "slices share their steps in a folder" test -s "$step"
head -c 100 "$part" >cut && cp cut "$step"
rm -f four.lmt.shared/2of4.* four.lmt.2of4
status 1 merge -q four.lmt.*of4 -o bad.lmt
said "of 4 slices 1 is missing: 2"
status 0 $bake --slice 2/4 -o four.lmt
status 0 merge four.lmt.*of4 -o again.lmt
check "a slice that was lost, with what it had shared, is made again" cmp bake.lmt again.lmt
rm -rf four.lmt.shared four.lmt.4of4
status 0 $bake --slice 4/4 -o four.lmt
status 0 merge four.lmt.*of4 -o again.lmt
check "a slice alone makes what no other has shared" cmp bake.lmt again.lmt
status 0 $bake --division 0.1 --slice 1/4 -o four.lmt
status 1 merge -q four.lmt.*of4 -o bad.lmt
said "of another job"
status 0 $bake --slice 1/4 -o four.lmt
status 0 merge four.lmt.*of4 -o again.lmt
check "what another job has shared does not count" cmp bake.lmt again.lmt
status 1 merge -q four.lmt.*of4 -o bad.glb
said "the slices were made for a *.lmt"
lamp="--light point:0.2,0.5,0:0,-1,0:5,4,3"
for form in "vertex-colours c.glb" "lightmap l.glb --texels 64" "probes p.json --step 0.5"; do
    set -- $form
    to=$1 name=$2
    shift 2
    status 0 $bake $lamp --to $to "$@" -o "$name"
    cp "$name" "whole-$name"
    [ $to != probes ] || mv p.bin whole-p.bin
    rm "$name"
    at_once 2 $name $bake $lamp --to $to "$@"
    status 0 merge "$name".?of2 -o "$name"
    check "two slices are one bake to $to" cmp "whole-$name" "$name"
done
check "and its numbers" cmp whole-p.bin p.bin
status 1 merge -q p.json.?of2 -o bad.json
said "name a file beside it"
status 2 bake demo --slice 3/2 -o bad.lmt
check "nothing bad was joined of a bake" none bad*

finish
