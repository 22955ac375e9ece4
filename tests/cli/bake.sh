# bake.sh: bake: checks that baked light of a box is as bright as gathered light; files and refusals.
. tests/cli/common.sh

box
block

# Baked light of the box, empty and with a block in it, is as bright as gathered light, and the same for any threads.
for room in box:256:200 block:256:500; do
    name=${room%%:*} receivers=${room##*:} elements=${room#*:}
    elements=${elements%:*}
    for threads in 1 2; do
        status 0 bake "$name.obj" -o "$name-$threads.lmt" --elements $elements --receivers $receivers --threads $threads
    done
    check "bake tells what it made" grep -q "$name-2.lmt: .* elements, .* receivers, .* MB" out.txt
    check "bakes of $name by one and two threads are equal" cmp -s "$name-1.lmt" "$name-2.lmt"
    status 0 render "$name.obj" $inside --quality draft --gather full -o "$name-draft.pfm"
    status 0 render "$name.obj" $inside --transfer "$name-1.lmt" -o "$name-baked.pfm"
    status 0 compare "$name-baked.pfm" "$name-draft.pfm" --max lo=0.95,hi=1.05,trim=0.06
    status 0 render "$name.obj" $inside --transfer "$name-1.lmt" --threads 1 -o "$name-again.pfm"
    check "baked light by any threads is equal" cmp -s "$name-baked.pfm" "$name-again.pfm"
done
# If no light or camera of the scene sees into a closed room, the room is dark unless --eye is in it.
status 0 bake box.obj -o eye.lmt --elements 256 --receivers 200 --eye 5,0,0
status 0 render box.obj $inside --transfer eye.lmt -o dark.pfm
check "a closed room that nothing sees into is dark" sh -c '! "$1" compare "$2" "$3" --max lo=0.01 >/dev/null' sh "$TOOL" \
    dark.pfm box-draft.pfm
status 0 bake box.obj -o eye.lmt --elements 256 --receivers 200 --eye 5,0,0 --eye 0.2,0.5,0
status 0 render box.obj $inside --transfer eye.lmt -o lit.pfm
status 0 compare lit.pfm box-draft.pfm --max lo=0.95,hi=1.05,trim=0.06
status 2 bake box.obj -o bad.lmt --eye 5,0
status 0 render box.obj $inside --transfer box-1.lmt --bounces 4 --threads 1 -o box-four.pfm
check "a transfer reflects light again" differ box-baked.pfm box-four.pfm
status 0 render box.obj $inside --transfer box-1.lmt --bounces 4 --threads 2 -o box-again.pfm
check "so it does by two threads" cmp -s box-four.pfm box-again.pfm
# Forty lights go into a tree, light the elements and are reflected.
forty=$(awk 'BEGIN { for (i = 0; i < 40; ++i) printf " --light point:%g,%g,%g:0,-1,0:0.3,0.2,0.1", i % 5 / 4 - 0.5, i % 7 / 6 - 0.5, i % 11 / 10 - 0.5 }')
among="--eye -0.8,0.6,-0.8 --target 0.3,-0.6,0.3 --size 32x24 --show indirect $forty"
status 0 render box.obj $among --quality draft --gather full -o forty.pfm
status 0 render box.obj $among --transfer box-1.lmt --threads 1 -o box-forty.pfm
check "render says what it does with lights and a transfer" grep -q '40 lights in .* cells' err.txt
status 0 compare box-forty.pfm forty.pfm --max lo=0.95,hi=1.05,trim=0.06
status 0 render box.obj $among --transfer box-1.lmt --threads 3 -o box-again.pfm
check "so they are by three threads" cmp -s box-forty.pfm box-again.pfm
status 0 render box.obj $inside --bounces 4 -o box-draft.pfm
status 0 compare box-four.pfm box-draft.pfm --max lo=0.95,hi=1.05,trim=0.06
status 1 bake block.obj -o bad.lmt --elements 256 --moving 0
said "no surface to light"
for list in 1 0,0 0, x -1; do
    status 2 bake block.obj -o bad.lmt --elements 256 --moving=$list
done
head -c 5000 box-1.lmt >cut.lmt
status 1 render box.obj $inside --transfer cut.lmt -o bad.pfm
said "cut.lmt: a damaged light transfer"
status 0 bake box.obj -o little.lmt --elements 256 --receivers 200 --endian little --report
check "bake tells the bytes of each part" grep -q '  links  *[0-9]* bytes' out.txt
status 0 info little.lmt
check "info knows baked light" sh -c 'grep -q "little.lmt: baked light, version 3, [1-9][0-9]* bytes$" "$1" && grep -q "^elements  *256$" "$1"' sh out.txt
status 0 info little.lmt --json
check "and as JSON" grep -q '^{.*"kind":"transfer".*"elements":256,.*"scene":"[0-9a-f]*"}$' out.txt
status 0 bake box.obj -o big.lmt --elements 256 --receivers 200 --endian big
check "the other byte order has the same bytes but the checksum, turned round" sh -c '
    od -An -v -tx1 -w4 "$1" | sed "1d;24d" >"$1.txt"; od -An -v -tx1 -w4 "$2" | sed "1d;24d" | awk "{ print \" \" \$4, \$3, \$2, \$1 }" |
    cmp -s - "$1.txt"' sh little.lmt big.lmt
check "the byte order is that of this machine" sh -c 'cmp -s "$1" "$3" || cmp -s "$2" "$3"' sh little.lmt big.lmt box-1.lmt
cmp -s little.lmt box-1.lmt && other=big || other=little
status 1 render box.obj $inside --transfer "$other.lmt" -o bad.pfm
said "$other.lmt: baked for $other-endian machines, unlike this one"
{ printf 'LMT\001'; tail -c +5 box-1.lmt; } >old.lmt
status 1 render box.obj $inside --transfer old.lmt -o bad.pfm
said "old.lmt: a light transfer of version 1, and this reads version 3"
budget=$(($(wc -c <box-1.lmt) * 3 / 4))
status 0 bake box.obj -o less.lmt --elements 256 --receivers 200 --budget-bytes $budget
check "bake says by which error a file fits" grep -q "by --error .*, which fits into $budget bytes" out.txt
check "a file with a budget is within it" sh -c 'test $(wc -c <"$1") -le '$budget sh less.lmt
status 1 bake box.obj -o bad.lmt --elements 256 --receivers 200 --budget-bytes 1000
said "without any link it is"
status 2 bake box.obj -o bad.lmt --endian middle
status 1 render box.obj $inside --transfer box.obj -o bad.pfm
status 1 render box.obj $inside --transfer nowhere.lmt -o bad.pfm
status 1 render box.obj $inside --transfer block-1.lmt -o bad.pfm
said "block-1.lmt: baked from another scene than"
status 1 bake nowhere.obj -o bad.lmt
status 1 bake box.obj -o nowhere/bad.lmt
status 2 bake
status 2 bake box.obj
said "no output given"
status 0 bake box.obj --quality draft --once -o draft.lmt
status 0 info draft.lmt
check "--quality draft has 1024 elements" grep -q "^elements  *1024$" out.txt
status 0 bake box.obj --quality draft --elements 256 --receivers 200 -o own.lmt
check "--elements and --receivers count before --quality" cmp own.lmt box-1.lmt
status 2 bake box.obj --quality good -o bad.lmt
printf 'v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 3 2\n' >lone.obj
for form in vertex-colours:glb lightmap:glb probes:json; do
    status 0 bake lone.obj --elements 64 --light sun:0,0,0:0,-1,0:2,2,2 --to ${form%:*} -o lone.${form#*:}
    check "bake --to ${form%:*} reports that no light bounces" grep -q "without light: no light bounces onto" out.txt
done
for elements in 32 128 1000 512 65536; do
    status 2 bake box.obj -o bad.lmt --elements $elements
done
check "nothing bad was drawn or baked" none bad*
status 0 bake --help
check "bake --help has under 100 columns" awk 'length($0) > 99 { exit 1 }' out.txt
status 0 bake -V

finish
