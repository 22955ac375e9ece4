# bench.sh: lambent-bench raster, draw, threads, gather and hard.
. tests/cli/common.sh

# The fixed workload generates quads, so it needs no files.
if [ -z "$SHORT" ]; then
    status 0 lambent-bench raster fill-gouraud --seconds 0.01 --json
    check "lambent-bench raster prints JSON" grep -q "^{.case.:.fill-gouraud-1280x720.," out.txt
    status 0 lambent-bench raster fill-depth --seconds 0.01 --html shares.html
    check "lambent-bench raster draws the quads" test "$(grep -c "^lambent,fill-depth-.*,tris=64,cpu_min_ms=[0-9]" out.txt)" = 2
    check "lambent-bench raster --html has a bar a case" sh -c 'grep -o "<rect class=.on.[^>]*>" "$1" | grep -c "width=.[1-9]" | grep -qx 2' sh shares.html
fi
status 0 lambent-bench raster fill-depth-pass --seconds 0.01 -q
check "lambent-bench raster -q prints nothing" empty out.txt
status 2 lambent-bench raster nonsense
status 1 lambent-bench raster fill-depth --seconds 0.01 --html none/shares.html
status 2 lambent-bench raster fill-depth --seconds 1x
status 2 lambent-bench raster fill-depth --seconds 0.01 --threads 2
mkdir -p flat # one vertex at 0 and no triangle
printf '\001\000\000\000' >flat/bunny.mesh
head -c 36 /dev/zero >>flat/bunny.mesh
status 1 lambent-bench raster bunny-depth-1024 --data flat --seconds 0.01
# Draws: cases with meshes are left out if the files are missing.
BENCH_DATA= status 0 lambent-bench draw fill bunny --seconds 0.01
check "lambent-bench draw says what a case is, and its store bound" grep -q "^fill .* an opaque rectangle .*: [0-9.]* ms, .*, store bound [0-9.]* ms, share [0-9.]*, copy bound [0-9.]* ms, share [0-9.]*$" out.txt
check "lambent-bench draw without files has no bunny" test "$(grep -c . out.txt)" = 1
status 0 lambent-bench draw glass clear --seconds 0.01 --plain --json
check "lambent-bench draw --json prints one object a line" test "$(grep -c '^{"case":"[a-z]*","what":".*","cpu_min_ms":[0-9.]*,"frames":[0-9]*,"backend":"plain","store_ms":[0-9.]*,"share":[0-9.]*,"copy_ms":[0-9.]*,"copy_share":[0-9.]*}$' out.txt)" = 2
status 2 lambent-bench draw nonsense
status 1 lambent-bench draw bunny-gouraud --data flat --seconds 0.01
# Threads against processes: needs more than one thread, and sponza.
status 2 lambent-bench threads --threads 1
status 2 lambent-bench threads gather
status 2 lambent-bench threads --threads 2x
status 2 lambent-bench threads --json
BENCH_DATA= status 1 lambent-bench threads --seconds 0.01
# The gather prints a line for each available backend; the speed is not checked.
n='[0-9.]*(e[+-][0-9]*)?' # a number
ops="\\{(\"[a-z]+\":$n,?){7}\\}"
line="^\\{\"case\":\"gather\",\"backend\":\"[a-z0-9]+\",\"pairs_per_s\":$n,\"cycles_per_pair\":$n,\"bound_cycles\":$n,\"share\":$n"
line="$line,\"unit\":\"[a-z]+\",\"ghz\":$n,\"ops_per_vector\":$ops,\"cycles_per_op\":$ops,\"load_per_op\":$ops\\}\$"
status 0 lambent-bench gather --seconds 0.01 --json
backends=$(grep -c . out.txt)
check "lambent-bench gather prints one object a line" test "$backends" -eq "$(grep -cE "$line" out.txt)"
check "lambent-bench gather ends with the scalar lanes" sh -c 'tail -n 1 "$1" | grep -q "\"backend\":\"scalar\""' sh out.txt
check "the gather's operations are counted" test "$backends" -eq "$(grep -c '"ops_per_vector":{"mul":[1-9][0-9.]*,"add":[1-9][0-9.]*,"max":[1-9][0-9.]*,"div":2[.0-9]*,"cmp":[1-9].*"sqrt":1[.0-9]*}' out.txt)"
status 0 lambent-bench gather --backend scalar --seconds 0.01
check "lambent-bench gather --backend measures that one" grep -q '^lambent,gather,backend=scalar,pairs_per_s=[1-9].*,share=[0-9.]*,unit=[a-z]*,ghz=' out.txt
check "and no other" test "$(grep -c . out.txt)" -eq 1
# Prints every figure of a group of cases on a line, and checks its bound.
status 0 lambent-bench hard raster
check "lambent-bench hard prints a line a case" test "$(grep -c '^raster ' out.txt)" -ge 20
status 0 lambent-bench hard mixed --json --backend scalar
check "lambent-bench hard --json says which hold" test "$(grep -c ',"holds":true}$' out.txt)" -ge 8
status 2 lambent-bench hard nowhere
said "CASES: \`nowhere\` is not raster, shadow, bounce, probe, relief, mixed, far, whole, baked, cliff, sheet, pillar, room or slit"
status 2 lambent-bench hard rastr
said "did you mean raster?"
status 2 lambent-bench hard raster shadow
status 2 lambent-bench hard --seconds 1
status 0 lambent-bench hard probe -q
check "lambent-bench hard -q is its exit status" empty out.txt err.txt
status 0 lambent-bench hard probe -v
check "lambent-bench hard -v says how long it took" grep -q '^lambent-bench: hard took .* s$' err.txt
status 0 lambent-bench gather --backend scalar --seconds 0.01 --quiet
check "lambent-bench gather -q prints nothing" empty out.txt
status 2 lambent-bench gather -q -v
said "--quiet and --verbose exclude each other"

status 2 lambent-bench gather --backend nothing
status 2 lambent-bench gather bunny
status 2 lambent-bench gather --linear

finish
