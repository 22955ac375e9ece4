# fuzz.sh: runs each fuzz target for some CPU minutes: fuzz.sh FUZZER FOLDER MINUTES TARGET...
#
# MINUTES=0 runs each target for three seconds, but calls, stages and gl for ten, because their inputs grow slowest. Inputs
# are tests/fuzz/corpus and, if present, the sample data. New useful inputs go to FOLDER/TARGET for the next run,
# findings to FOLDER/TARGET-crash-* and similar names. A target runs in slices, because libFuzzer limits wall time, not
# CPU time. The limit for one input is wall time too, and high, because a busy machine takes 25 s for an input of one
# second. Prints the number of executed inputs by target and in all (each slice counts its first inputs again). Ends
# with a line `N passed, N failed, N skipped`.
fuzzer=$1 folder=$2 minutes=$3
shift 3
shared=${LMB_SHARED:-../shared}

# seconds: user and system time of this shell's finished children (some targets spend most time on the memory of large
# pictures). No pipe or $(...), because a subshell would count separately.
count() {
    times >"$folder/$1.times"
    seconds=$(awk 'NR == 2 { split($1 $2, t, /[ms]/); print int(60 * (t[1] + t[3]) + t[2] + t[4]) }' "$folder/$1.times")
}

# Adds libFuzzer's number of executed inputs of a slice, even if the slice ended with a finding.
executed() {
    units=$(awk '/^stat::number_of_executed_units:/ { n = $2 } END { print n + 0 }' "$folder/$1.log")
    executions=$((executions + units))
}

# Sample files that the target reads.
samples() {
    case $1 in
    png) ls "$shared"/data/textures/*.png "$shared"/data/meshes/*.png ;;
    picture) ls "$shared"/data/textures/* "$shared"/data/env/* ;;
    hdr | pfm) ls "$shared"/data/env/*."$1" ;;
    gltf) ls "$shared"/data/gltf/*.glb "$shared"/data/scenes/*.glb "$shared"/truth/*/*.gltf ;;
    obj | mtl) ls "$shared"/data/scenes/*."$1" ;;
    esac 2>/dev/null
}

run() {
    options="-timeout=100 -rss_limit_mb=4000 -max_len=$((1 << 16)) -print_final_stats=1 -verbosity=0"
    [ ! -f "tests/fuzz/$1.dict" ] || options="$options -dict=tests/fuzz/$1.dict"
    corpus=tests/fuzz/corpus/$1
    [ -d "$corpus" ] || corpus=
    mkdir -p "$folder/$1" "$folder/samples/$1"
    for file in $(samples "$1"); do
        [ "$(wc -c <"$file")" -gt 65536 ] || cp "$file" "$folder/samples/$1/"
    done
    count "$1"
    begun=$seconds executions=0
    case $minutes/$1 in
    0/calls | 0/stages | 0/gl) slice=10 ;;
    0/*) slice=3 ;;
    *) slice=120 ;;
    esac
    while
        "$fuzzer" "$1" $options -max_total_time=$slice -artifact_prefix="$folder/$1-" "$folder/$1" \
            $corpus "$folder/samples/$1" >"$folder/$1.log" 2>&1
        status=$?
        executed "$1"
        [ "$status" = 0 ] || return 1
        count "$1"
        [ $((seconds - begun)) -lt $((minutes * 60)) ]
    do :; done
}

# tell TARGET: runs the target and prints one line with the result.
tell() {
    if run "$1"; then
        verdict="no finding"
    else
        verdict="$(grep -m 1 -E 'SUMMARY|does not hold' "$folder/$1.log") (finding)"
    fi
    count "$1"
    echo "$1: $executions executions, $((seconds - begun)) s of CPU," \
        "$(ls "$folder/$1" | wc -l) inputs kept: $verdict" | tee "$folder/$1.said"
}

# If each target takes only seconds, runs two at a time.
[ "$minutes" -gt 0 ] && at_once=1 || at_once=2
running=0
for target in "$@"; do
    rm -f "$folder/$target.said"
    tell "$target" &
    running=$((running + 1))
    [ $((running % at_once)) != 0 ] || wait
done
wait
for target in "$@"; do
    cat "$folder/$target.said"
done | awk '
    { executions += $2; seconds += $4; if (/: no finding$/) ++passed }
    END {
        print "in all: " executions + 0 " executions, " seconds + 0 " s of CPU"
        print passed + 0 " passed, " NR - passed " failed, 0 skipped"
        exit passed != NR
    }'
