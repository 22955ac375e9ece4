# bench-examples.sh: checks that the examples in lambent-bench's help work when pasted.
. tests/cli/common.sh

pasted lambent-bench "lambent-bench raster" "lambent-bench gather" "lambent-bench threads" "lambent-bench hard" \
    "lambent-bench --calibrate" "lambent-bench demo" "lambent-bench relight" "lambent-bench relief" "lambent-bench mix" \
    "lambent-bench merge"
# One of the examples needs a measured rate.
if [ -n "$SHORT" ]; then
    status 0 lambent-bench --calibrate --threads 1
    cp out.txt paste/said---calibrate.txt
fi
check "calibrating gives a rate" grep -q "^[0-9.e+]* units of work a second, threads: 1 " paste/said---calibrate.txt

finish
