# hostile.sh: damaged copies of files through every parser: hostile.sh PROGRAM PREFIXES MUTATIONS [FILE...]
#
# Without files: the fuzzers' corpus and, where it is, the sample data. Ends with the program's line `N passed, N
# failed, N skipped`.
program=$1 prefixes=$2 mutations=$3
shift 3
shared=${LMB_SHARED:-../shared}
if [ $# -eq 0 ]; then
    for file in tests/fuzz/corpus/*/* "$shared"/data/gltf/* "$shared"/data/meshes/* "$shared"/data/scenes/* \
        "$shared"/data/env/* "$shared"/data/textures/* "$shared"/truth/*.jpg "$shared"/truth/*/*.gltf; do
        [ ! -f "$file" ] || set -- "$@" "$file"
    done
fi
ASAN_OPTIONS=abort_on_error=1:$ASAN_OPTIONS UBSAN_OPTIONS=print_stacktrace=1:$UBSAN_OPTIONS
export ASAN_OPTIONS UBSAN_OPTIONS
exec "$program" "$prefixes" "$mutations" "$@"
