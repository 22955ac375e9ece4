# fuzz.sh: runs each fuzz target for some CPU minutes: fuzz.sh FUZZER FOLDER MINUTES TARGET...
#
# MINUTES 0 are three seconds, and ten of the library's calls and stages, whose inputs take the longest to grow.
# Starts from tests/fuzz/corpus and the sample data where that is; what is found to be of use is kept in FOLDER/TARGET
# for the next run, findings in FOLDER/TARGET-crash-* and the like. Goes in slices, because the engine's own limit
# counts time on the wall; so does its limit for one input, and a busy machine takes 25 s for what needs one. Says how
# many inputs were executed, by target and in all (those that a slice begins with count each time). Ends with a line
# `N passed, N failed, N skipped`.
fuzzer=$1 folder=$2 minutes=$3
shift 3
shared=${LMB_SHARED:-../shared}

# seconds: what the finished children of this shell took, and the system for them (the memory of large pictures is most
# of some targets). A pipe or $(...) would ask a shell of its own.
count() {
    times >"$folder/$1.times"
    seconds=$(awk 'NR == 2 { split($1 $2, t, /[ms]/); print int(60 * (t[1] + t[3]) + t[2] + t[4]) }' "$folder/$1.times")
}

# What the engine says that a slice executed, by a finding's end too.
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
    mkdir -p "$folder/$1" "$folder/samples/$1"
    for file in $(samples "$1"); do
        [ "$(wc -c <"$file")" -gt 65536 ] || cp "$file" "$folder/samples/$1/"
    done
    count "$1"
    begun=$seconds executions=0
    case $minutes/$1 in
    0/calls | 0/stages) slice=10 ;;
    0/*) slice=3 ;;
    *) slice=120 ;;
    esac
    while
        "$fuzzer" "$1" $options -max_total_time=$slice -artifact_prefix="$folder/$1-" "$folder/$1" \
            "tests/fuzz/corpus/$1" "$folder/samples/$1" >"$folder/$1.log" 2>&1
        status=$?
        executed "$1"
        [ "$status" = 0 ] || return 1
        count "$1"
        [ $((seconds - begun)) -lt $((minutes * 60)) ]
    do :; done
}

# tell TARGET: it is run, and a line says what came of it.
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

# Seconds each: two at a time.
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
