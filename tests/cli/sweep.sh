# sweep.sh: lambent-bench: speed against error, as table, CSV, JSON, SVG and one page.
. tests/cli/common.sh

pit
photo
status 0 mix $seen $tent --light sun:0,0,0:0.6,-0.2,-1:2,2,2 -o mixed.pfm

# Speed against error: a sweep as table, CSV, JSON, SVG and one page.
sweep="demo --size 6x4 --runs 1 --cache kept"
status 0 lambent-bench $sweep --sweep tree=8,16,32 --shadow-map 64 --breakdown 1 -o swept --svg swept.svg
check "lambent-bench prints a line a setting" test "$(grep -cE '^(front|knee|     ) .*--tree (8|16|32) ' out.txt)" -eq 3
check "lambent-bench prints the breakdown" grep -q '^error breakdown of --tree 8' out.txt
check "CSV: a head and three lines of as many columns" sh -c 'awk -F, "NR == 1 { n = NF } NF != n { exit 1 } END { exit NR != 4 }" "$1"' sh swept.csv
check "JSON has the settings" grep -q '"setting": "--tree 32", .*"same_bytes": null' swept.json
check "the page is whole, with pictures in it" sh -c 'tail -n 1 "$1" | grep -q "</html>$" && grep -q "src=\"data:image/png;base64,iVBOR" "$1"' sh swept.html
check "the page asks for nothing else" sh -c '! grep -qE "<script|<link|url\(|src=\"[^d]" "$1"' sh swept.html
check "SVG is whole" sh -c 'head -c 5 "$1" | grep -q "<svg " && tail -n 1 "$1" | grep -q "</svg>$"' sh swept.svg
check "each setting has its command" grep -q '<pre>lambent render --show indirect --threads 1 demo --size 6x4 --shadow-map 64 -o picture.pfm --tree 8$' swept.html
check "the truth is kept, once" test "$(ls kept | wc -l)" -eq 1
cp kept/*.pfm truth24.pfm
status 0 lambent-bench $sweep --sweep tree=64 --shadow-map 64 --breakdown 0
check "by the scene and its settings" test "$(ls kept | wc -l)" -eq 1
status 0 lambent-bench demo --runs 1 --shadow-map 64 --truth truth24.pfm --sweep tree=8 --breakdown 0
check "a truth of one's own gives the size" grep -q -- '--size 6x4' out.txt
# A triangle whose pixels get no bounced light: no setting has a breakdown.
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >triangle.obj
status 0 lambent-bench triangle.obj --size 8x8 --runs 1 --shadow-map 64 --sweep tree=16,32
check "no breakdown without light" lacks "^error breakdown" out.txt
# Refused before the work: completely or not at all.
status 1 lambent-bench demo --size 4000x4000 -o no/such/folder
status 1 lambent-bench demo --size 12x8 --truth nothing.pfm
status 1 lambent-bench demo --size 16x8 --shadow-map 64 --truth truth24.pfm --sweep tree=8 -o unequal
absent unequal.html
status 1 lambent-bench nowhere.glb -o unequal
absent unequal.csv
status 2 lambent-bench demo --shadow-map 64 --sweep tree=8,3
status 2 lambent-bench demo --sweep tree
status 2 lambent-bench demo --runs 0
status 2 lambent-bench demo --stats x.json
status 2 lambent-bench demo --tree
for ask in demo relight relief mix; do
    status 0 lambent-bench $ask --help
    check "lambent-bench $ask --help says something, once" test "$(grep -c '^usage:' out.txt)" -eq 1
done
status 0 lambent-bench relight --world demo --runs 1 --sweep filter=cosine,sh9,blur --csv filters.csv
check "filters in their order" sh -c 'awk -F, "NR == 1 { for (i = 1; \$i != \"trim\"; ++i); next } { e[NR] = \$i } END { exit !(e[2] < e[3] && e[3] < e[4]) }" "$1"' sh filters.csv
status 1 lambent-bench relight --world nowhere.pfm --runs 1
status 0 lambent-bench relight --world demo --object demo --at 0,0,0 --size 12x8 --runs 1 --sweep samples=1,4 --csv objects.csv
check "objects by samples: more are nearer to the truth" sh -c 'awk -F, "NR == 1 { for (i = 1; \$i != \"trim\"; ++i); next } { e[NR] = \$i } END { exit !(e[2] > e[3]) }" "$1"' sh objects.csv
status 0 lambent-bench relief pit.obj --runs 1 --size 16 --triangles 20 --sweep views=6,14
check "reliefs by views" test "$(grep -c -- '--views' out.txt)" -eq 2
status 0 lambent-bench mix $seen --object tent.obj --light sun:0,0,0:0.6,-0.2,-1:2,2,2 --runs 1 --sweep voxels=4,5 --truth mixed.pfm
status 2 lambent-bench mix $seen --show planes

finish
