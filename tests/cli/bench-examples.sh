# bench-examples.sh: checks that the examples in bench's help work when pasted.
. tests/cli/common.sh

pasted bench "bench raster" "bench gather" "bench threads" "bench hard" "bench --calibrate" "bench demo" "bench relight" \
    "bench relief" "bench mix"
# One of the examples needs a measured rate.
if [ -n "$SHORT" ]; then
    status 0 bench --calibrate --threads 1
    cp out.txt paste/said---calibrate.txt
fi
check "calibrating gives a rate" grep -q "^[0-9.e+]* units of work a second, threads: 1 " paste/said---calibrate.txt

finish
