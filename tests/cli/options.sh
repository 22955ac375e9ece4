# options.sh: the parser of all command lines: unknown, repeated and wrong options, and -q.
. tests/cli/common.sh

status 0 render demo $small -o demo.pfm
status 0 render demo $small --show depth -o depth.pfm
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >one.obj

# The parser of all command lines: `--name=value`, repeated options, suggestions, and the end of options.
status 0 render demo --size=32x24 --shadow-map=64 --exposure=0 -o inside.pfm
check "--name=value is --name value" cmp demo.pfm inside.pfm
cp one.obj ./-q.obj
"$TOOL" info -- -q.obj >out.txt 2>err.txt
check "behind -- a word that begins with - is no option" grep -q '^triangles' out.txt
status 2 render demo --visibilty 0.1 -o bad.png
said "unknown option --visibilty; did you mean --visibility?"
status 2 render demo --vis=0.1 -o bad.png
said "unknown option --vis; did you mean --visibility?"
status 2 render demo --nonsense -o bad.png
said "unknown option --nonsense; lambent render --help lists them"
# Keys: lists, repetition, mistakes, and the names that were options of their own.
status 0 render demo $small --group method=zones,groups=40,thin=4 -o list.pfm
status 0 render demo $small --group thin=4 --group=groups=40 --group method=zones -o apart.pfm
check "a list of keys is the same as one option for each" cmp list.pfm apart.pfm
check "keys are stored" differ list.pfm demo.pfm
status 2 render demo --group blok=2 -o bad.png
said "--group: \`blok\` is no key, did you mean block?; lambent render --help lists them"
status 2 render demo --group block -o bad.png
said "--group block=VALUE wants a value: 1, 2, 4 or 8"
status 2 render demo --group block=9 -o bad.png
said "--group block: \`9\` is not 1, 2, 4 or 8"
status 2 render demo --group block=2,block=4 -o bad.png
said "--group block is given twice, 2 and 4; leave one out"
status 2 render demo --group groups=4, -o bad.png
status 2 render demo --block 4 -o bad.png
said "unknown option --block; did you mean --group block=...?"
status 2 render demo --budget-ms 4 -o bad.png
said "unknown option --budget-ms; did you mean --budget ms=...?"
status 2 render demo "--group block" 4 -o bad.png
status 2 render demo --group "thin=$(awk 'BEGIN { while (i++ < 2000) printf 1 }')" -o bad.png
said "--group: the list is too long"
status 2 lambent-bench demo --swep tree=8
said "did you mean --sweep?"
status 2 lambent-bench demo --shadwo-map 64
said "did you mean --shadow-map?"
status 2 render demo -o=bad.png
said "write \`-o bad.png\`"
status 2 render demo --o=x.png
said "unknown option --o; did you mean -o?"
status 2 render demo -h=1
said "-h takes no value"
status 2 relief baek
said "there is no \`relief baek\`; did you mean relief bake?"
status 2 lambent-bench rastr
said "there is no file \`rastr\`; did you mean lambent-bench raster?"
status 2 render demo --quality drfat -o bad.png
said "did you mean draft?"
status 2 render demo --light spot:0,0,0:0,-1:1,1,1 -o bad.png
said "[:SIZE] with angles up to 89: its DX,DY,DZ is wrong"
status 2 render demo --samples 3 -o bad.png
said "--samples: \`3\` is not 1, 4, 8 or 16"
check "numbers are not spelling mistakes" lacks 'did you mean' err.txt
for show in depth normal albedo eye-distance light-distance groups occlusion; do
    status 2 render demo --show $show --samples 4 -o bad.png
    said "--samples 4: only light has a mean over a pixel; --show $show takes one sample"
done
status 0 render demo $small --show depth --samples 1 -o sampled.pfm
check "--samples 1 is what --show depth takes" cmp sampled.pfm depth.pfm
status 2 rendr demo
said "did you mean render?"
status 2 render demo --size 64x48 --size 32x24 -o bad.png
said "--size is given twice, 64x48 and 32x24; leave one out"
status 2 render demo --glossy --glossy -o bad.png
said "--glossy is given twice"
status 2 lambent-bench demo --tree 8 --tree=16
said "--tree is given twice"
status 2 render demo --error 0.1 --error-bound 0.1 -o bad.png
said "--error and --error-bound exclude each other"
status 2 render demo -q -v -o bad.png
said "--quiet and --verbose exclude each other"
status 2 render demo --glossy=1 -o bad.png
said "--glossy takes no value"
status 2 render demo --tree=12 -o bad.png
said "--tree: \`12\` is not a power of two, 8 .. 4096"
status 2 render demo --threads -1 -o bad.png
said "--threads: \`-1\` is out of range; give a whole number, 1 .. 64"
status 2 render demo --error=11 -o bad.png
said "--error: \`11\` is out of range; give a number, 0.0001 .. 10"
status 2 render demo --fov 1e99 -o bad.png
said "--fov: \`1e99\` is out of range; give a number, over 0, at most 178.999"
status 2 render demo --stereo 0 -o bad.png
said "--stereo: \`0\` is out of range; give a number, over 0"
status 2 render demo --tree 4 -o bad.png
said "--tree: \`4\` is out of range; give a power of two, 8 .. 4096"
status 2 render demo --threads 99999999999999999999 -o bad.png
said "--threads: \`99999999999999999999\` is out of range; give a whole number, 1 .. 64"
status 2 render demo --threads 1.5 -o bad.png
said "--threads: \`1.5\` is not a whole number, 1 .. 64"
status 2 render demo --error 1x -o bad.png
said "--error: \`1x\` is not a number, 0.0001 .. 10"
status 2 render demo --tree
said "--tree wants a value: a power of two, 8 .. 4096"
status 2 render demo demo -o bad.png
said "one word too many: SCENE is \`demo\`"
status 2 render demo -o=bad.png
absent bad.png
# Quiet prints nothing, verbose prints more; both draw the same.
status 0 render demo --size 32x24 --shadow-map 64 -o loud.png
status 0 render demo --size 32x24 --shadow-map 64 -q -o hushed.png
check "-q says nothing" empty out.txt err.txt
status 0 render demo --size 32x24 --shadow-map 64 -v -o told.png
check "-v says how long what took" grep -q '^lambent: bands .* ms$' err.txt
"$TOOL" render demo --size 32x24 --shadow-map 64 -v -o - >told.ppm 2>err.txt
check "-v -o - prints each time once" test "$(grep -c 'bands .* ms$' err.txt)" = 1
check "what is said changes no byte" sh -c 'cmp "$1" "$2" && cmp "$1" "$3"' sh loud.png hushed.png told.png
# Bad usage.
status 2
status 2 paint
status 2 render
status 2 render demo
status 2 render demo -o bad.png --no-such-flag
status 2 render demo -o bad.png --size 64
status 2 render demo -o bad.png --size 0x48
status 2 render demo -o bad.png --show nonsense
status 2 render demo -o bad.png --show groups --stereo 0.1
status 2 render demo -o bad.png --show occlusion --occlusion none
status 2 render demo -o bad.png --stereo 0
status 2 render demo -o bad.png --group thin=65
status 2 render demo -o bad.png --group neighbourhood=none
status 2 render demo -o bad.png --size
status 2 render demo -o bad.tiff
status 2 compare demo.pfm
status 2 info
status 2 info demo.pfm demo.png
status 2 info demo.pfm --no-such-flag
check "nothing bad was drawn" none bad*

finish
