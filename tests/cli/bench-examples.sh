# bench-examples.sh: the examples of bench's helps work when pasted.
. tests/cli/common.sh

pasted bench "bench raster" "bench gather" "bench threads" "bench hard" "bench --calibrate" "bench demo" "bench relight" \
    "bench relief" "bench mix"
# One of them has measured a rate.
if [ -n "$SHORT" ]; then
    status 0 bench --calibrate --threads 1
    cp out.txt paste/said---calibrate.txt
fi
check "calibrating gives a rate" grep -q "^[0-9.e+]* units of work a second, threads: 1 " paste/said---calibrate.txt

finish
