# plan.sh: plan: stages that are left out, with reasons; budgets.
. tests/cli/common.sh

# --- stages that are left out, with reasons; budgets ---

plan="--size 32x24 --shadow-map 64 --threads 1"
status 0 plan demo $plan
check "a plan says that nothing is glossy" grep -q "^lobes .*left out (exact): nothing that is drawn is glossy" out.txt
check "a plan counts bounced light" grep -q "^bounced light .*tiles' cuts, .* pairs" out.txt
status 0 plan demo $plan --light point:0,1,0:0,-1,0:0,0,0
check "a plan says that a light of 0 W gives nothing" grep -q "^bounced light .*(exact): no light meets a triangle" out.txt
status 0 plan demo $plan --show direct --json
check "a plan's JSON says what is not shown" \
    grep -q '"stage": "bounced light", "runs": false, "why": "the picture does not show it", "proof": "exact"' out.txt
printf '%s\n' 'v -1 0 -1' 'v 1 0 -1' 'v 1 0 1' 'v -1 0 1' 'v -1 1 -1' 'v 1 1 -1' 'f 4 3 2 1' 'f 1 2 6 5' >corner.obj
corner="corner.obj --size 32x24 --threads 1 --eye 1,2,4 --target 0,0.4,0 --light point:0.3,1.5,0.2:0,-1,0:9,9,9"
status 0 plan $corner --budget bytes=100KiB
check "100 KiB are too few, and by how much" grep -q "no setting meets the budget; the nearest takes [0-9.]* x the bytes" out.txt
# Sampling is part of the planned work: the share is printed, and is at most a quarter.
status 0 plan demo --size 240x180 --threads 1 --budget error=0.2 --json
check "a look takes at most a quarter of what it plans" awk -F '"look_work": |"estimated_work": ' '
    /"look_work"/ { look = $3 + 0; work = $2 + 0 } END { exit !(look > 0 && look <= 0.25 * work) }' out.txt
check "what is chosen for an error is checked" grep -q '"checked": true' out.txt
if [ -z "$SHORT" ]; then
    status 0 plan demo --size 64x48 --threads 1 --budget error=0.00001
    check "an error that no setting has is said" grep -q "^no setting .*the budget" out.txt
fi
status 0 plan $corner --budget ms=16 --budget rate=1e4
check "so are 160 units" grep -q "no setting meets the budget; the nearest takes [0-9.e+]* x the work" out.txt
status 0 plan --help
check "plan --help has budgets and examples" sh -c 'grep -q -- "--budget KEY" "$1" && grep -q "lambent plan demo" "$1"' sh out.txt
# Live light has a second tree beside that of the cuts. plan does not predict the work of live light.
kib() { sed -n 's/^first points  *[0-9.kMG-]*  *[0-9.]*  *\([0-9]*\)\..*/\1/p' out.txt; }
status 0 plan demo --size 32x24 --threads 1 --gather full
full=$(kib)
check "cuts are planned as cuts" lacks "live light" out.txt
status 0 plan demo --size 32x24 --threads 1 --gather live
live=$(kib)
check "a plan counts the memory of live light: $live KiB, not $full" test "$live" -gt "$full"
check "a plan of live light says that it is planned as cuts" grep -q "^live light is planned as the cuts" out.txt
# A plan reports the memory that the picture takes.
for how in "--gather live" "--gather full" "--samples 4 --bounces 2" "--show direct" "--group method=zones" "--many-lights 64"; do
    how="$how --size 32x24 --threads 2 --shadow-map 128 --tree 64 --elements 256"
    status 0 plan demo $how
    all=$(awk '/^all / { print $3 }' out.txt)
    status 0 render demo $how -q --stats memory.json -o memory.pfm
    check "plan $how: $all KiB" awk -F '"bytes": ' -v kib="$all" '/"bytes": / { split($2, n, ","); share = kib * 1024 / n[1] }
        END { exit !(share > 0.98 && share < 1.02) }' memory.json
done
status 2 plan
status 2 plan demo -o plan.png
status 2 plan demo --stats plan.json
said "--stats: plan draws no picture"
check "no file is left" test ! -e plan.json
status 2 plan demo --show depth
status 2 plan demo --budget error=0.1 --group method=zones
status 2 plan demo --budget ms=16 --budget work=1e6
status 2 plan demo --budget work=1e6,rate=1e9
said "--budget rate: a speed goes only with ms"
status 2 plan demo --budget bytes=100kB
status 2 render demo --json -o plan.png
status 2 render demo --budget error=0.1 --show direct -o plan.png
status 1 plan nowhere.gltf
absent plan.png

# The settings chosen for a budget are printed as options that draw the same picture.
status 0 render demo --size 240x180 --threads 1 --exposure 0 --budget error=0.2 -o budget.pfm
check "an easy budget is met" grep -q "^lambent: the budget is met" err.txt
cp err.txt budget.txt
chosen=$(sed -n 's/^lambent: chosen: \(.*\): error about.*/\1/p' err.txt)
status 0 render demo --size 240x180 --threads 1 --exposure 0 $chosen -o chosen.pfm
check "the chosen settings draw the same: $chosen" cmp -s budget.pfm chosen.pfm
check "memory beside the budget is printed" grep -q "^lambent: chosen: .* KiB, and [1-9][0-9]* KiB of state and scratch of threads$" budget.txt
status 2 lambent-bench --calibrate demo

finish
