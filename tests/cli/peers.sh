# peers.sh: lambent-bench raster --peers: compares with programs of other rasterizers.
. tests/cli/common.sh

# Scripts stand in for the programs of other rasterizers.
peer() {
    mkdir -p "peers_$1"
    printf '#!/bin/sh\n%s\n' "$2" >"peers_$1/$1"
    chmod +x "peers_$1/$1"
}
quad="lambent-bench raster fill-depth-pass --seconds 0.01"
peer good 'echo "#cov 1"; echo "x,$1-cull,cpu_min_ms=9"; echo "x,$1,tris=64,cpu_min_ms=1e3,n=8"; echo "$BENCH_SEC" >"$0.txt"'
status 0 $quad --peers peers_good
check "lambent-bench raster --peers prints theirs beside ours" sh -c 'sed 1d "$1" | grep -qx "good,fill-depth-pass-1024,cpu_min_ms=1000.0000,times=[1-9][0-9.]*"' sh out.txt
check "and a table at the end" sh -c 'tail -1 "$1" | grep -qx "| fill-depth-pass-1024 | [0-9.]* | 1e+03 ([0-9.e+]*) |"' sh out.txt
check "it tells them how long to measure" grep -qx 0.01 peers_good/good.txt
status 0 $quad --json --peers peers_good
[ -n "$SHORT" ] || check "lambent-bench raster holds filling against a peak" grep -q ",.pixels_per_s.:[1-9][^,]*,.peak.:[1-9][^,]*,.*.share.:[0-9.]*}$" out.txt
check "lambent-bench raster --peers prints JSON" grep -q '^{"peer":"good","case":"fill-depth-pass-1024","cpu_min_ms":1000.0000,"times":[1-9][0-9.]*}$' out.txt
mkdir -p peers_two && cp peers_good/good peers_two/good && printf '#!/bin/sh\n' >peers_two/absent && chmod +x peers_two/absent
status 0 $quad --peers peers_two
check "a peer that prints nothing does not draw the case" sh -c 'tail -1 "$1" | grep -q "| - | 1e+03 ("' sh out.txt
check "and has no line" sh -c '! grep -q "^absent," "$1"' sh out.txt
peer crash 'kill -SEGV $$'
peer fails 'echo "x,$1,cpu_min_ms=1"; exit 3'
peer rubbish 'head -c 100000 /dev/urandom; echo; echo "x,$1,cpu_min_ms=fast"'
peer missing "" && echo '#!/nowhere' >peers_missing/missing
for case in "crash: ended by signal 11 at" "fails: exit status 3 at" "rubbish: printed no line" "missing: it cannot be run"; do
    tool $quad --peers "peers_${case%%:*}" >out.txt 2>err.txt
    check "lambent-bench raster --peers refuses one: $case" test $? -eq 1
    check "and says so in a line" sh -c 'test "$(grep -c . "$1")" -eq 1 && grep -q "$2" "$1"' sh err.txt "$case"
done
status 1 $quad --peers nowhere
mkdir -p peers_none
echo "no program" >peers_none/readme.txt
status 1 $quad --peers peers_none
status 1 $quad --peers peers_good/good
status 2 $quad --peers

finish
